"""A change of the filters is judged against a commit."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from benchmarks import cache, judge
from benchmarks.judge import Figures, Place

ROOT = Path(judge.__file__).parents[1]
HELD = Place("plain", "bowl-3x0.5-slope0-8pm2-a")


def by_method(**figures):
    return {method: Figures(**figures) for method in judge.METHODS}


def test_the_quick_form_has_a_row_of_each_kind_and_the_tiles_of_the_repository():
    quick, full = judge.places(False), judge.places(True)
    kinds = {place.name.split("-")[0] for place in quick if place.kind == "plain"}
    assert len(kinds) > 50 and {*quick} < {*full}
    assert {place.name for place in quick if place.kind == "tile"} == {*judge._COMMITTED}


def test_what_is_protected_and_taken_is_named():
    before = {"plain hall": by_method(held=True), "plain bank": by_method(held=False)}
    after = {"plain hall": by_method(held=False), "plain bank": by_method(held=True)}
    gained, lost = judge.changes(before, after)
    assert gained == [f"bank ({method})" for method in judge.METHODS]
    assert lost == [f"hall ({method})" for method in judge.METHODS]


def test_the_table_has_means_of_the_places_where_a_figure_is_known():
    before = {
        "tile a": by_method(total=2.0, rmse=0.1, off=1), "tile b": by_method(rmse=0.3, off=2),
        "plain hall": by_method(held=True),
    }  # fmt: skip
    after = {**before, "tile a": by_method(total=1.0, rmse=0.1, off=0)}
    lines = judge.table(before, after)
    assert any("mean of 1 tiles" in line and "2.00 -> 1.00" in line for line in lines)
    assert any("DTM RMSE" in line and "0.200 -> 0.200" in line for line in lines)
    assert any("Spikes and pits, 2 tiles" in line and "3 -> 2" in line for line in lines)
    assert any("Plain things held, of 1" in line and "1 -> 1" in line for line in lines)


@pytest.mark.rest
def test_places_are_measured_in_a_process_and_kept(tmp_path, monkeypatch):
    monkeypatch.setattr(cache, "FOLDER", tmp_path)
    monkeypatch.setattr(judge, "places", lambda is_full: [HELD])
    first = judge.results(ROOT, False)
    assert all(first[" ".join(HELD)][method].held is not None for method in judge.METHODS)
    (kept,) = (tmp_path / "judge").glob("*.json")
    stated = json.loads(kept.read_text("utf-8"))
    stated[" ".join(HELD)]["slope"][3] = "kept"
    kept.write_text(json.dumps(stated), "utf-8")
    assert judge.results(ROOT, False)[" ".join(HELD)]["slope"].held == "kept"


def test_another_commit_brings_its_own_package(tmp_path, monkeypatch):
    if subprocess.run(["git", "-C", str(ROOT), "rev-parse"], capture_output=True).returncode:
        pytest.skip("this is no repository")
    folder = judge.committed("HEAD", tmp_path / "bare_earth")
    seen = subprocess.run(
        [sys.executable, "-c", "import bare_earth; print(bare_earth.__file__)"],
        cwd=ROOT, env={"PYTHONPATH": str(tmp_path)}, capture_output=True, text=True,
    ).stdout  # fmt: skip
    assert Path(seen.strip()) == folder / "__init__.py"
    with pytest.raises(SystemExit):
        judge.committed("no-such-commit", tmp_path / "other")


def test_equal_filters_are_not_measured(monkeypatch, capsys, tmp_path):
    monkeypatch.setattr(judge, "committed", lambda revision, folder: ROOT)
    assert judge.main([]) == 0
    assert "nothing to judge" in capsys.readouterr().out
