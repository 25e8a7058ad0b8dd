"""What the rules are worth: every rule can be left out, and what was measured is kept."""

import numpy as np
import pytest
from matrices import quick

from bare_earth.algorithms.filters import METHODS
from benchmarks import ablation, ablation_page, cache, data, work
from benchmarks.measure import Filter
from benchmarks.replay import Kept
from benchmarks.rules import (
    BASE,
    GROUPS,
    VALUES,
    changed,
    lines,
    pipeline_of,
    switched_off,
    variants,
)
from benchmarks.scenes import make
from benchmarks.tests.test_accuracy import write_labelled

SCENE = "hillside_village"


@pytest.fixture
def kept(tmp_path, monkeypatch):
    """A cache of its own, and a generated scene as the only sample."""
    monkeypatch.setattr(cache, "FOLDER", tmp_path / "cache")
    monkeypatch.setattr(data, "FOLDER", tmp_path / "data")
    monkeypatch.setattr(work, "PROCESSES", 1)
    scene = make(SCENE, 101, size=60.0, density=1.0)
    write_labelled(tmp_path / "data" / "isprs" / "samp11.laz", scene.points, scene.ground)
    monkeypatch.setattr(ablation, "PHASES", ((0.0, 0.0),))
    monkeypatch.setattr(ablation_page, "PAGE", tmp_path / "rules.md")
    return tmp_path


@pytest.mark.rest
@pytest.mark.parametrize("method", quick(METHODS, "slope"))
def test_every_variant_but_the_base_changes_the_pipeline(method):
    usual = pipeline_of(method)
    base, *changes = variants(method)
    assert changed(usual, base) == usual
    assert len(changes) > 20
    for name in changes:
        assert changed(usual, name) != usual, name
        assert (lines(method, name) == 0) == (name in VALUES), name


def test_groups_and_values_are_of_rules_that_some_method_has():
    names = {name for method in METHODS for name in variants(method)}
    assert set(GROUPS) | set(VALUES) <= names
    assert {rule for rules in GROUPS.values() for rule in rules} <= names


def test_values_are_changed_wherever_the_rule_is_a_field():
    pipeline = changed(pipeline_of("grid-minimum"), "objects on the cells of the filter")
    parts = [part for rule in pipeline.rules for part in rule.parts()]
    assert [part.wide for part in parts if part.name == "raised-objects"] == [None, None]


@pytest.mark.rest
def test_a_rule_is_off_only_within():
    cloud = make(SCENE, 101, size=60.0, density=1.0).cloud()
    slope = Filter("slope")
    before = slope.ground(cloud)
    with switched_off("progressive-opening"):
        without = slope.ground(cloud)
    assert without.sum() > before.sum()
    with switched_off("rims"):  # of another method
        np.testing.assert_array_equal(slope.ground(cloud), before)
    np.testing.assert_array_equal(slope.ground(cloud), before)


@pytest.mark.rest
@pytest.mark.parametrize("method", quick(METHODS, "tin-densification"))
def test_a_replay_finds_what_a_whole_run_finds(method):
    cloud, found = make(SCENE, 101, size=60.0, density=2.0).cloud(), Filter(method)
    kept, differing = Kept(), 0
    with switched_off(BASE, kept):
        usual = found.ground(cloud)
    for variant in variants(method)[1::4]:
        with switched_off(variant, kept):
            replayed = found.ground(cloud)
        with switched_off(variant):
            np.testing.assert_array_equal(replayed, found.ground(cloud), variant)
        differing += not np.array_equal(replayed, usual)
    assert differing > 1


@pytest.mark.rest
def test_what_was_measured_is_kept(kept, monkeypatch, capsys):
    arguments = ["--quick", "--method", "slope", "--rules", "progressive-opening", "rocks"]
    arguments += ["--on", "isprs", "real"]
    ablation.main([*arguments, "--write"])
    printed = capsys.readouterr().out
    page = (kept / "rules.md").read_text("utf-8")
    assert "## Slope filter" in page and "| rocks " in page and "Grid minimum" not in page
    monkeypatch.setattr(ablation, "Filter", None)  # nothing is measured again
    ablation.main([*arguments, "--kept"])
    assert capsys.readouterr().out == printed
    place = ablation.places(True)[0]
    job = ablation.Job("slope", place, ("base", "progressive-opening", "rocks"))
    base, without_opening, without_rocks = ablation.run(job).values()
    assert without_opening["total"] > base["total"] and without_rocks == base


@pytest.mark.rest
def test_plain_things_that_a_rule_protects_and_takes_are_counted(kept, monkeypatch, capsys):
    some = [kind for kind in ablation.KINDS if kind.name in ("bowl", "low-clumps")]
    chosen = [
        scene for scene in ablation.rows()
        if scene.kind in some and scene.text in ("5x1.5/0/4", "0.5x2x8/0/4")
    ]  # fmt: skip
    monkeypatch.setattr(ablation, "KINDS", some)
    monkeypatch.setattr(ablation, "rows", lambda: chosen)

    def ground(method, cloud):  # bowls come out right without a rule, low points with it
        without = "rocks" not in pipeline_of(method.name).names
        (scene,) = [scene for scene in chosen if scene.name in cloud.path.name]
        truth, is_bowl = scene.make().scene.ground, scene.kind.stays
        return truth if without == is_bowl else ~truth

    monkeypatch.setattr(Filter, "ground", ground)
    ablation.main(["--quick", "--method", "slope", "--rules", "rocks", "--on", "plain", "--write"])
    (line,) = [line for line in capsys.readouterr().out.splitlines() if "| rocks" in line]
    assert [cell.strip() for cell in line.split("|")[-3:-1]] == ["1", "1"]
    assert ", 2 rows)" in (kept / "rules.md").read_text("utf-8")


@pytest.mark.rest
def test_labels_and_terrain_models_are_measured(kept, monkeypatch):
    scene = make(SCENE, 101, size=60.0, density=1.0)
    monkeypatch.setattr(data, "load", lambda path: (scene.cloud(), np.where(scene.ground, 2, 1)))
    tiles = {tile.is_trusted: tile.title for tile in data.REAL}
    figures = {
        trusted: ablation._Scorer(
            ablation.Job("grid-minimum", ablation.Place("real", title), ())
        ).figures("rims")
        for trusted, title in tiles.items()
    }
    assert figures[True]["total"] > 0.0 and figures[False]["rmse"] >= 0.0
