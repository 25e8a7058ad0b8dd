"""What the rules are worth: every rule can be switched off, and what was measured is kept."""

import json

import numpy as np
import pytest

from bare_earth.algorithms.filters import METHODS
from benchmarks import ablation, ablation_page, cache, data, work
from benchmarks.measure import Filter
from benchmarks.rules import GROUPS, RULES, acting, switched_off
from benchmarks.scenes import make

SCENE = "hillside_village"


@pytest.fixture(scope="module")
def cloud():
    return make(SCENE, 101, size=60.0, density=1.0).cloud()


@pytest.fixture
def kept(tmp_path, monkeypatch):
    """A cache of its own, no data, and the scene alone."""
    monkeypatch.setattr(cache, "FOLDER", tmp_path / "cache")
    monkeypatch.setattr(data, "FOLDER", tmp_path / "data")
    monkeypatch.setattr(work, "PROCESSES", 1)
    monkeypatch.setattr(ablation, "KINDS", {SCENE: ablation.KINDS[SCENE]})
    monkeypatch.setattr(ablation_page, "PAGE", tmp_path / "rules.md")
    return tmp_path


@pytest.mark.parametrize("name", RULES)
def test_what_a_rule_replaces_is_there(name):
    rule = RULES[name]
    for change in rule.changes:
        owner, attribute = change.owner()
        assert hasattr(owner, attribute)
    assert rule.lines() >= 0
    assert any(rule.serves(method) for method in METHODS)


@pytest.mark.parametrize("name", GROUPS)
def test_a_group_has_rules(name):
    assert set(GROUPS[name]) <= set(RULES)


def test_a_rule_is_off_only_within(cloud):
    slope = Filter("slope")
    before = slope.ground(cloud)
    with switched_off(["openings"]):
        without = slope.ground(cloud)
    assert without.sum() > before.sum()
    np.testing.assert_array_equal(slope.ground(cloud), before)


def test_rules_that_do_not_act_change_nothing(cloud):
    grid = Filter("grid-minimum")
    before = grid.ground(cloud)
    with acting() as acted:
        np.testing.assert_array_equal(grid.ground(cloud), before)
    assert "openings" in acted and "halls" not in acted
    idle = set(RULES) - acted
    with switched_off(idle):
        np.testing.assert_array_equal(grid.ground(cloud), before)


def test_what_was_measured_is_kept(kept, monkeypatch, capsys):
    arguments = ["--quick", "--method", "slope", "--rules", "openings", "halls", "--write"]
    ablation.main([*arguments, "--json", str(kept / "one.json")])
    assert "| openings " in capsys.readouterr().out
    page = (kept / "rules.md").read_text("utf-8")
    assert "## Slope filter" in page and "| halls " in page and "Grid minimum" not in page
    monkeypatch.setattr(ablation, "Filter", None)  # nothing is measured again
    ablation.main([*arguments, "--kept", "--json", str(kept / "other.json")])
    one, other = (
        json.loads((kept / f"{each}.json").read_text("utf-8")) for each in ("one", "other")
    )
    assert one == other
    (figures,) = one["slope"].values()
    assert figures["openings"]["type_2"] > figures["base"]["type_2"]
    assert figures["halls"] == figures["base"]
