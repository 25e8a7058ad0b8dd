"""No rule without evidence: each rule and each of its numbers has a row that says what it is."""

import gc
from dataclasses import dataclass
from types import SimpleNamespace

import pytest

from bare_earth.algorithms.filters.pipeline import GridRule
from bare_earth.algorithms.filters.stages import terrain
from benchmarks import cache, judge, marked, rule_numbers, rule_values, work
from benchmarks import rule_values_page as page
from benchmarks.rule_numbers import Value, scaled, values


def test_each_value_of_a_rule_has_a_row_with_what_it_is_and_how_it_was_found():
    assert page.problems(values()) == []


def test_a_rule_or_a_number_that_is_added_changed_or_removed_has_no_evidence():
    @dataclass(frozen=True)
    class MadeUp(GridRule):
        __module__ = terrain.__name__
        width: float = 2.0

    with_it = values()
    del MadeUp
    gc.collect()
    assert page.problems(with_it) == ["made-up.rule has no row.", "made-up.width has no row."]
    some = [one for one in values() if one.title != "shrubs.height"]
    assert page.problems(some) == ["shrubs.height is gone, but not its row."]
    other = [*some, Value("shrubs", "height", (0.4,))]
    assert page.problems(other) == ["shrubs.height is 0.4, not 0.3: measure it again."]


def test_numbers_that_have_a_name_in_a_file_are_values(tmp_path, monkeypatch):
    assert Value("shrubs.py", "_REACH", (5.0,)) in values()
    file = tmp_path / "made_up.py"
    file.write_text("_MOST: float = 3.0\n_WORDS = 'no number'\n", "utf-8")
    module = SimpleNamespace(__file__=str(file), _MOST=3.0, _WORDS="no number")
    monkeypatch.setitem(rule_numbers.FILES, "made_up", module)
    assert page.problems(values()) == ["made_up.py._MOST has no row."]


def test_a_row_without_its_texts_is_no_evidence(tmp_path):
    written = tmp_path / "page.md"
    written.write_text("<!-- values -->\n<!-- end -->\n", "utf-8")
    value = Value("shrubs", "height", (0.3,))
    page.write([value], {}, written)
    assert page.problems([value], written) == [
        "shrubs.height: what it protects, what it takes, or how it was found?"
    ]
    lines = [line.replace("|  |", "| by hand |") for line in marked.held(written, page.NAME)]
    marked.fill(written, page.NAME, lines)
    assert page.problems([value], written) == []
    # What was measured takes its place, and what was written by hand stays.
    figures = {"shrubs.height": {("slope", 0.7): {"hedges-1x2": (2.0, None, (True, False))}}}
    page.write([value], figures, written)
    assert [row[2:] for row in page.read(written)] == [("x0.7: hedges", "nothing", "by hand")]


@pytest.mark.parametrize(
    "value, less, more",
    [
        (2.0, 1.4, 2.8),
        (2, 1, 3),
        (1, 0, 2),
        (10, 7, 14),
        (True, False, False),
        ((2.0, 4), (1.4, 2), (2.8, 5)),
    ],
)
def test_values_are_scaled(value, less, more):
    assert scaled(value, 0.7) == pytest.approx(less)
    assert scaled(value, 1.4) == pytest.approx(more)


@pytest.mark.rest
def test_values_are_measured_and_what_was_measured_is_kept(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(cache, "FOLDER", tmp_path)
    monkeypatch.setattr(work, "PROCESSES", 1)
    row = "low-clumps-0.5x2x8-slope0-4pm2-a"
    monkeypatch.setattr(judge, "places", lambda is_full: [judge.Place("plain", row)])
    for name, told in (
        ("low-groups.dep", "low-groups.depth"),
        ("shrubs.py._AT", "shrubs.py._AT_ONCE"),
    ):
        rule_values.main(["--values", name])
        printed = capsys.readouterr().out
        rule_values.main(["--values", name, "--kept"])
        assert capsys.readouterr().out == printed
        assert printed.startswith(f"{told} | ")
    assert printed == "shrubs.py._AT_ONCE | no label | nothing\n"
    rule_values.main(["--values", "below-land.width", "--kept"])
    assert capsys.readouterr().out == ""
