"""Plain things that come out right stay so: some of the matrix each day, all of it is long."""

import numpy as np
import pytest
from matrices import quick

from bare_earth.algorithms.filters import METHODS
from benchmarks import plain, work
from benchmarks.measure import Filter
from benchmarks.rules import changed, pipeline_of
from benchmarks.scenes.plain import KINDS, rows

# Rows that are held: each day by the method at its place in turn, and by all of them in long tests.
HELD = (
    "pit-8x6-slope0-8pm2-a",
    "funnel-10x5-slope0-2pm2-a",
    "cellar-8x3x12-slope5-4pm2-b",
    "ditch-5x2-slope5-2pm2-a",
    "hollow-way-6x3-slope20-4pm2-b",
    "cutting-10x8-slope0-2pm2-a",
    "dyke-3x3-slope0-2pm2-b",
    "embankment-12x6-slope5-1pm2-a",
    "levee-4x3-slope0-1pm2-b",
    "scarp-6x12-slope10-2pm2-a",
    "mound-25x4-slope0-1pm2-b",
    "heap-15x4-slope0-4pm2-b",
    "butte-75x13-slope0-4pm2-b",
    "terrace-by-house-0.3x2.5-slope5-4pm2-b",
    "flat-roof-40x25x3-slope0-2pm2-a",
    "gable-roof-12x9x4-slope15-1pm2-b",
    "drum-12x6-slope0-4pm2-b",
    "court-roof-70x60x4-slope0-2pm2-a",
    "low-clumps-0.5x2x8-slope0-4pm2-b",
    "numbered-grass-0.5x60-slope5-8pm2-a",
    "low-points-0.1x8x1-slope10-2pm2-a",
    "high-points-0.1x-8x1-slope0-4pm2-b",
    "crater-5x1.5-slope0-8pm2-a",
    "ramp-3x3-slope0-8pm2-b",
    "hall-100x60x3.2-slope0-4pm2-a",
    "grass-0.8x30-slope0-5pm2-b",
)
# Those that TIN densification alone holds.
HELD_BY_TIN = "a-frame-16x10x8-slope0-8pm2-b", "polytunnels-60x8x3.5x1x8-slope3-4pm2-a"
# How many rows of the matrix each method holds at least.
LEAST = {"tin-densification": 362, "grid-minimum": 357, "slope": 355}
ROWS = {row.name: row for row in rows()}


def test_names_tell_rows_apart_and_scenes_do_not_change():
    assert len(ROWS) == len(rows()) == 2 * sum(len(kind.rows) for kind in KINDS)
    row = ROWS["bowl-3x0.5-slope0-8pm2-a"]
    one, again = row.make(), row.make()
    for first, second in zip((*one.scene.points, one.thing), (*again.scene.points, again.thing)):
        np.testing.assert_array_equal(first, second)
    assert row.sizes == (3.0, 0.5)


@pytest.mark.rest(but="bowl")
@pytest.mark.parametrize("name", quick([kind.name for kind in KINDS], "bowl", "low-clumps"))
def test_the_truth_of_a_kind_is_held_and_its_opposite_is_not(name):
    row = next(row for row in rows() if row.kind.name == name)
    judge, stays = plain.Judge(row), row.kind.stays
    truth, thing = judge.plain.scene.ground, judge.plain.thing
    assert thing.sum() >= 16 and (truth[thing] == stays).all()
    assert judge.judged(truth) == (True, 100.0 * stays, 0.0, 100.0)
    assert not judge.judged(truth ^ thing).held
    assert not judge.judged(np.zeros(len(truth), dtype=bool)).held


def _in_turn(methods):
    """Return all rows with all methods, of which one method for each row is quick."""
    return [
        pytest.param(name, method, marks=() if (number + place) % 3 == 0 else pytest.mark.long)
        for number, name in enumerate(HELD)
        for place, method in enumerate(methods)
    ]


@pytest.mark.rest(but="roof")
@pytest.mark.parametrize("name, method", _in_turn(METHODS))
def test_what_came_out_right_still_does(name, method):
    judge = plain.Judge(ROWS[name])
    assert judge.judged(judge.ground(Filter(method))).held


@pytest.mark.rest
@pytest.mark.parametrize("name", quick(HELD_BY_TIN, HELD_BY_TIN[0]))
def test_roofs_down_to_the_ground_go(name):
    judge = plain.Judge(ROWS[name])
    assert judge.judged(judge.ground(Filter("tin-densification"))).held


@pytest.mark.long
def test_no_fewer_rows_are_held_in_all():
    jobs = [plain.Job(name, tuple(METHODS)) for name in ROWS]
    found = list(work.side_by_side(plain.run, jobs))
    held = {method: sum(one[method].held for one in found) for method in METHODS}
    assert all(held[method] >= least for method, least in LEAST.items()), held


@pytest.mark.rest
def test_the_command_prints_rows_and_sums_and_draws_what_fails(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(work, "PROCESSES", 1)
    few = ["--only", "0.5x60-slope5-8pm2-a", "--kind", "numbered-grass", "--method", "slope"]
    few += ["--picture", str(tmp_path)]
    plain.main(few)
    assert "| held   0." in capsys.readouterr().out and not list(tmp_path.iterdir())
    plain.main([*few, "--without", "low points", "--set", "ground_tolerance=1"])
    printed = capsys.readouterr().out
    assert "| NOT " in printed and "| numbered-grass | goes |    1 |     0 |" in printed
    (picture,) = tmp_path.iterdir()
    assert picture.read_bytes().startswith(b"\x89PNG")
    with pytest.raises(SystemExit):
        plain.main([*few, "--without", "no-such-rule"])


def test_a_rule_can_be_given_a_value():
    usual = pipeline_of("slope")
    given = changed(usual, "gentle-border.least_area=50")
    areas = [
        part.least_area
        for rule in given.rules for part in rule.parts() if part.name == "gentle-border"
    ]  # fmt: skip
    assert areas == [50] and changed(usual, "rims.no_such=1") == usual  # of another method
