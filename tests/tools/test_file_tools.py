"""The tools that read files and write others: all follows from the declaration of each."""

import dataclasses
import inspect
import json

import numpy as np
import pytest
from runs import said
from toy_file_tool import TOOL, Lift, add_toy

import bare_earth
from bare_earth import BareEarthError
from bare_earth.algorithms.tools import file_tool
from bare_earth.algorithms.tools.check.checking import CheckInputs
from bare_earth.algorithms.tools.listing import FILE_TOOLS
from bare_earth.algorithms.tools.running import run

rasterio = pytest.importorskip("rasterio")


@pytest.fixture
def toy(monkeypatch):
    add_toy(monkeypatch)
    return TOOL


@pytest.fixture
def land(tmp_path):
    (tmp_path / "in").mkdir()
    path = tmp_path / "in" / "dtm.tif"
    with rasterio.open(
        path, "w", driver="GTiff", width=4, height=3, count=1, dtype="float32", crs="EPSG:25832",
        transform=rasterio.Affine(1, 0, 500_000, 0, -1, 5_700_000),
    ) as raster:  # fmt: skip
        raster.write(np.full((1, 3, 4), 100.0, np.float32))
    return path


def heights(path):
    with rasterio.open(path) as raster:
        return raster.read(1)


def test_a_new_tool_is_found_in_the_command_line(toy, land, tmp_path):
    _, listed, _ = said("--help")
    assert toy.line in listed
    code, shown, _ = said(toy.command, "--help")
    assert code == 0 and f"{toy.line} {toy.about}" in shown
    assert "--lift m" in shown and "--table" in shown
    target, table = tmp_path / "high.tif", tmp_path / "cells.csv"
    words = "--lift", "5", "--table", table
    code, told, _ = said(toy.command, land, target, *words, "--json")
    assert code == 0 and json.loads(told) == {"cell_count": 12}
    assert np.all(heights(target) == 105.0) and table.read_text(encoding="utf-8") == "cells\n12\n"
    _, told, _ = said(toy.command, land, target, "--verbose")
    assert told == f"{target}: 12 cells are higher\n" and np.all(heights(target) == 102.0)


def test_a_new_tool_is_a_function_of_the_library(toy, land, tmp_path):
    done = bare_earth.lift(land, tmp_path / "high.tif", lift=3, table=tmp_path / "cells.csv")
    assert done.cell_count > 0 and (tmp_path / "cells.csv").read_text().startswith("cells")
    assert f"{toy.line}\n\n{toy.about}" in bare_earth.lift.__doc__
    with pytest.raises(TypeError, match=r"lift\(\) .*lifted\b.* lift\b"):
        bare_earth.lift(land, tmp_path / "high.tif", lifted=3)


@pytest.mark.parametrize(
    ("output", "table", "words"),
    [
        ("in/dtm.tif", None, "same file"),
        ("high.png", None, r"high\.png: .*\.tif"),
        ("none/high.tif", None, "does not exist"),
        ("high.tif", "cells.txt", r"cells\.txt: .*\.csv"),
        ("high.csv", "high.csv", "outputs .*same file"),
    ],
)
def test_outputs_are_checked_before_the_work(toy, land, tmp_path, output, table, words):
    given = {"output": tmp_path / output, "table": table and tmp_path / table}
    with pytest.raises(BareEarthError, match=words):
        run(toy, {"source": str(land)}, given, [Lift()])
    assert [path.name for path in tmp_path.iterdir()] == ["in"]


def test_a_failure_leaves_no_output(toy, land, tmp_path):
    given = {"output": tmp_path / "high.tif", "table": tmp_path / "cells.csv"}
    (tmp_path / "in" / "dtm.tif").write_bytes(b"no raster")
    with pytest.raises(BareEarthError, match="Cannot read"):
        run(toy, {"source": str(land)}, given)
    assert [path.name for path in tmp_path.iterdir()] == ["in"]


@pytest.mark.parametrize("command", FILE_TOOLS)
def test_the_work_of_a_tool_takes_what_it_declares(command):
    tool = file_tool(command)
    taken = inspect.signature(tool.work).parameters
    names = {declared.name for declared in (*tool.inputs, *tool.outputs)}
    if any(declared.kind == "clouds" for declared in tool.inputs):
        names.discard("crs")  # the files know it
    sets = {name for name, value in taken.items() if isinstance(value.default, tool.sets)}
    # Who writes a raster, and what its cells without data hold: functions on arrays say it.
    said = set(taken) - {"write", "no_data"}
    if command == "check":  # the others in one value
        said = said - {"given"} | {one.name for one in dataclasses.fields(CheckInputs)}
    assert tool.command == command and said == {*names, *sets, "progress"}
    assert not tool.titles or len(tool.titles) == len(tool.sets)
