"""The page for users of other programs: its commands and its recipe for PDAL run."""

import re
import shutil
from pathlib import Path

import laspy
import numpy as np
import pytest
from matrices import quick
from remote_server import serving
from surveys import ORIGIN, strip, write

import bare_earth
from bare_earth.algorithms import cli

PAGE = (Path(__file__).parents[2] / "docs" / "coming-from.md").read_text(encoding="utf-8")
COMMANDS = list(dict.fromkeys(re.findall(r"`bare-earth ([^`\n]+ [^`\n]+)`", PAGE)))


@pytest.fixture(scope="module")
def work(tmp_path_factory):
    """A folder with the files that the commands name."""
    folder = tmp_path_factory.mktemp("work")
    write(folder / "tile.laz", strip(count=4000, width=200.0, depth=80.0))
    (folder / "tiles").mkdir()
    for number in range(2):
        write(
            folder / "tiles" / f"{number}.laz",
            strip(count=4000, width=200.0, depth=80.0, seed=number),
        )
    for name in ("ground.laz", "reference.laz"):
        bare_earth.classify(folder / "tile.laz", folder / name)
    rows = [f"{ORIGIN[0] + x},{ORIGIN[1] + 40},{60 + 0.06 * x}" for x in range(30, 180, 30)]
    (folder / "points.csv").write_text("\n".join(["x,y,z", *rows]))
    return folder


def test_the_page_has_a_command_for_each_row():
    rows = [
        line for line in PAGE.splitlines() if line.startswith("| ") and "| Bare Earth |" not in line
    ]
    assert len(COMMANDS) > 20
    assert [row for row in rows if "`bare-earth " not in row] == []


@pytest.fixture(scope="module")
def server(work):
    """What stands for the server of the page."""
    bare_earth.classify(work / "tile.laz", work / "tile.copc.laz")
    with serving() as running:
        running.add("tile.copc.laz", (work / "tile.copc.laz").read_bytes())
        yield running


@pytest.mark.rest(but="info tile.laz")
@pytest.mark.parametrize("words", quick(COMMANDS, *COMMANDS[::4]))
def test_a_command_of_the_page_runs(words, work, server, tmp_path, monkeypatch):
    pytest.importorskip("rasterio")
    folder = tmp_path / "work"
    shutil.copytree(work, folder)
    monkeypatch.chdir(folder)
    if "dtm.tif" in words or "dsm.tif" in words:
        bare_earth.terrain("ground.laz", dtm="dtm.tif", dsm="dsm.tif")
    monkeypatch.setenv("BARE_EARTH_CACHE", str(tmp_path / "cache"))
    words = words.replace("https://data.example.org/", server.address(""))
    assert cli.main(words.split()) == 0


def as_pdal(las):
    """Return the points as PDAL passes them: `ins` and `outs`, arrays by names of dimensions."""
    names = {
        "X": "x", "Y": "y", "Z": "z", "Intensity": "intensity", "ReturnNumber": "return_number",
        "NumberOfReturns": "number_of_returns", "Classification": "classification",
        "GpsTime": "gps_time", "Withheld": "withheld", "Overlap": "overlap",
    }  # fmt: skip
    ins = {name: np.array(las[source]) for name, source in names.items()}
    return ins, {name: column.copy() for name, column in ins.items()}


@pytest.mark.rest
@pytest.mark.parametrize("options", [None, {"preset": "city"}])
def test_the_recipe_for_pdal_gives_the_labels_of_the_file(options, work, tmp_path):
    (code,) = re.findall(r"```python\n(.*?)```", PAGE, re.S)
    module = {"spatialreference": ""}  # as PDAL has it for points without a CRS
    exec(compile(code, "bare_earth_pdal.py", "exec"), module)
    if options is not None:
        module["pdalargs"] = options
    ins, outs = as_pdal(laspy.read(work / "tile.laz"))
    assert module["ground"](ins, outs) is True
    bare_earth.classify(work / "tile.laz", tmp_path / "done.laz", **(options or {}))
    assert np.array_equal(outs["Classification"], laspy.read(tmp_path / "done.laz").classification)
    assert not np.array_equal(outs["Classification"], ins["Classification"])
