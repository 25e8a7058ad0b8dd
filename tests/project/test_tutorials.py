"""The tutorials are run as their readers do; the command line knows the commands of all pages."""

import functools
import html
import importlib
import json
import re
import shutil
import sys
from pathlib import Path

import numpy as np
import pytest
from matrices import quick

from bare_earth.algorithms import cli
from benchmarks.scenes.scene import ORIGIN

ROOT = Path(__file__).parents[2]
_JOBS_PAGE = ROOT / "docs" / "jobs.md"
JOBS = ("survey", "archaeology", "forestry", "flood", "drone-site")
PAGES = sorted((ROOT / "docs").rglob("*.md"))
_NUMBER = re.compile(r"[-+]?\d[\d,]*(?:\.\d+)?")
_FILE = re.compile(r"`([\w/.-]+\.(?:tif|gpkg|geojson|laz|csv|json|html))`")
# The same points give other sums on other processors: figures may differ by a unit of their last
# digit, and counts by so much.
_COUNTS = 0.002


@pytest.fixture(scope="module")
def pages():
    """Return the module that runs pages; it is in no installed package."""
    sys.path.insert(0, str(ROOT))
    pytest.importorskip("rasterio")
    yield importlib.import_module("demo.pages")
    sys.path.remove(str(ROOT))


def tutorials():
    """Return the sections of the page of jobs, by the names of their deliveries."""
    _, *sections = re.split(r"^## ", _JOBS_PAGE.read_text(encoding="utf-8"), flags=re.M)
    return {re.search(r"make demo JOB=(\S+)", section)[1]: section for section in sections}


def shown(folder):
    """Return the words of the pages of a delivery, or nothing without one."""
    text = " ".join(path.read_text(encoding="utf-8") for path in sorted(folder.glob("*.html")))
    text = re.sub(r"<(style|script).*?</\1>", "", text, flags=re.S)
    return " ".join(html.unescape(re.sub(r"<[^>]+>", " ", text)).split())


def agree(quoted, found):
    """Return whether two figures are the same within rounding."""
    one, two = (float(value.replace(",", "")) for value in (quoted, found))
    digits = len(quoted.partition(".")[2])
    allowed = 1.01 * 10.0**-digits if digits else _COUNTS * abs(one)
    return abs(one - two) <= allowed


def is_same(word, found):
    """Return whether two words are the same, if their figures may differ by rounding."""
    if _NUMBER.sub("#", word) != _NUMBER.sub("#", found):
        return False
    return all(map(agree, _NUMBER.findall(word), _NUMBER.findall(found)))


def is_in(line, text):
    """Return whether a text has the words of a line one after the other."""
    words, there = line.split(), text.split()
    starts = range(len(there) - len(words) + 1)
    return any(all(map(is_same, words, there[start:])) for start in starts)


def test_figures_agree_within_rounding_only():
    line = "held out RMSE 0.043 m, mean -0.001 m, of 1,739"
    assert is_in(line, f"Points {line} and more")
    assert is_in(line, line.replace("0.043", "0.044").replace("1,739", "1,741"))
    for other in (("0.043", "0.045"), ("1,739", "1,750"), ("RMSE", "mean"), ("-0.001", "+0.002")):
        assert not is_in(line, line.replace(*other))


def error_in(drawn, delivery, scene):
    """Return the mean absolute error of a terrain model where its reader draws, in metres."""
    features = importlib.import_module("rasterio.features")
    with importlib.import_module("rasterio").open(delivery / "dtm.tif") as raster:
        heights, to = raster.read(1, masked=True).filled(np.nan), raster.transform
    shapes = [feature["geometry"] for feature in json.loads(drawn.read_text())["features"]]
    inside = features.geometry_mask(shapes, heights.shape, to, invert=True)
    rows, columns = np.nonzero(inside & np.isfinite(heights))
    east, north = to.c + to.a * (columns + 0.5), to.f + to.e * (rows + 0.5)
    half = scene.settings.size / 2
    true = scene.bare_earth(east - ORIGIN[0] - half, north - ORIGIN[1] - half)
    return float(np.abs(heights[rows, columns] - true).mean())


@pytest.mark.rest
@pytest.mark.parametrize("job", quick(JOBS, "flood"))
def test_a_tutorial_runs_and_says_what_comes_out(job, pages, tmp_path, monkeypatch):
    page = tutorials()[job]
    jobs = importlib.import_module("demo.jobs")
    # The page makes its scene, which is also the truth here: once is enough.
    monkeypatch.setattr(jobs, "scene_of", functools.lru_cache(maxsize=1)(jobs.scene_of))
    scene = jobs.scene_of(job)
    wrong, quotes, named, errors = [], 0, set(), []
    for block, printed in pages.steps(page, tmp_path):
        made = Path.cwd() / "hand-over"
        if block.kind != "sh":
            text = shown(made) if block.kind == "text" else printed
            wrong += [line for line in block.text.splitlines() if not is_in(line, text)]
            quotes += 1
        elif "bare-earth deliver" in block.text:
            drawn = Path("water.geojson" if job == "flood" else "corrections.geojson")
            errors.append(error_in(drawn, made, scene))
        named |= (files := set(_FILE.findall(block.behind)))
        wrong += [name for name in files if not (Path(name).exists() or (made / name).exists())]
    assert wrong == []
    assert quotes >= 2 and len(named) >= 8
    # What the reader corrects is wrong before, and the correction helps. The river is found without
    # the reader, so that only the waves on the pond are wrong.
    least, share = (0.02, 0.9) if job == "flood" else (0.2, 0.6)
    assert errors[0] > least and errors[1] < share * errors[0], errors


@pytest.mark.rest
def test_the_first_steps_print_what_their_page_says(pages, tmp_path):
    page = (ROOT / "docs" / "tutorial.md").read_text(encoding="utf-8")
    land = importlib.import_module("demo.land")
    truth = shutil.copy(land.LANDS["campus"].path, tmp_path / "truth.laz")
    land.write_unclassified(truth, tmp_path / "campus.laz")
    wrong, quotes = [], 0
    for block, printed in pages.steps(page.partition("## 5. Many tiles")[0], tmp_path):
        if not block.kind:
            wrong += [line for line in block.text.splitlines() if not is_in(line, printed)]
            quotes += 1
    assert wrong == [] and quotes == 2


@pytest.mark.rest
def test_the_tutorial_on_change_says_what_is_found(pages, tmp_path):
    page = (ROOT / "docs" / "change-tutorial.md").read_text(encoding="utf-8")
    wrong, quotes = [], 0
    for block, printed in pages.steps(page, tmp_path):
        if block.kind != "sh":
            text = shown(Path.cwd()) if block.kind == "text" else printed
            wrong += [line for line in block.text.splitlines() if not is_in(line, text)]
            quotes += 1
    assert wrong == [] and quotes == 4
    # The table repeats the volumes of both lists.
    put, _, found, _ = (block.text for block in pages.blocks_of(page) if block.kind != "sh")
    for name in ("Cut bank", "Heap", "Pit"):
        (true, volume, error) = re.search(
            rf"^\| {name} \| (\S+) m³ \| (\S+) ± (\S+) m³, earth \|$", page, re.M
        ).groups()
        assert re.search(rf"^{name}\s+{re.escape(true)} m3$", put, re.M | re.I)
        assert f"{volume} ± {error}" in found
        assert abs(float(true) - float(volume)) < float(error)


def test_the_tutorials_are_those_of_all_deliveries():
    from bare_earth.algorithms.delivery.deliveries import DELIVERIES

    assert set(tutorials()) == set(JOBS) == set(DELIVERIES)


def test_make_hands_the_job_to_the_demo():
    assert "demo -m demo $(if $(JOB),--job $(JOB))" in (ROOT / "Makefile").read_text()


@pytest.mark.parametrize("path", PAGES, ids=lambda path: path.stem)
def test_the_command_line_knows_the_commands_of_a_page(path, pages, monkeypatch, capsys):
    def idle(command):
        return command._replace(run=lambda options: 0)

    monkeypatch.setattr(cli, "_CLEAR_CACHE", idle(cli._CLEAR_CACHE))
    command_of = cli.tool_command
    monkeypatch.setattr(cli, "tool_command", lambda name: idle(command_of(name)))
    page = path.read_text(encoding="utf-8")
    blocks = [block for block in pages.blocks_of(page) if block.kind == "sh"]
    commands = [words for block in blocks for words in pages.commands_of(block)]
    commands += [line.split() for line in re.findall(r"^ {4,}(bare-earth .*)$", page, re.M)]
    called = [words[1:] for words in commands if words[0] == "bare-earth" and "--help" not in words]
    assert [(words, cli.main(words), capsys.readouterr().err) for words in called] == [
        (words, 0, "") for words in called
    ]
