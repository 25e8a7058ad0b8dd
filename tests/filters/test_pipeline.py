"""Rules and pipelines: each rule can be left out, and changes only what it says."""

import dataclasses
import functools

import numpy as np
import pytest

from bare_earth import Progress
from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.filters.pipeline import GridRule, Pipeline, Rule, Stage
from bare_earth.algorithms.filters.state import GridState, State
from benchmarks.scenes import make

PRESETS = [
    (name, preset) for name, method in METHODS.items() for preset in ("automatic", method.classic)
]


@functools.lru_cache
def village():
    return make("sparse_village", seed=11, density=1.0, size=60.0).points


def pipeline_of(method, preset, points):
    return METHODS[method].pipeline(points, METHODS[method].parameters(preset=preset), Progress())


@pytest.mark.parametrize(("method", "preset"), PRESETS)
def test_rules_run_in_the_order_of_their_stages(method, preset):
    stages = [rule.stage for rule in pipeline_of(method, preset, village()).rules]
    assert stages == sorted(stages, key=list(Stage).index)


@pytest.mark.parametrize(("method", "preset"), PRESETS)
def test_rules_have_names_texts_and_known_fields(method, preset):
    pipeline = pipeline_of(method, preset, village())
    rules = [part for rule in pipeline.rules for part in rule.parts()]
    for rule in rules:
        state = GridState if isinstance(rule, GridRule) else State
        fields = {field.name for field in dataclasses.fields(state)} | {"filled"}
        assert set(rule.writes) <= fields, rule.name
        assert rule.__doc__ and not rule.__doc__.startswith(type(rule).__name__), rule.name
    assert len({rule.name for rule in rules}) == len({type(rule) for rule in rules})


def arrays_of(state):
    """Return copies of the arrays of a state."""
    values = {field.name: getattr(state, field.name) for field in dataclasses.fields(state)}
    if isinstance(state, GridState):
        values["heights"] = state.heights.values
    return {name: value.copy() for name, value in values.items() if isinstance(value, np.ndarray)}


def changed(before, state):
    """Return the names of the arrays that differ."""
    return {
        name
        for name, value in arrays_of(state).items()
        if name not in before
        or not np.array_equal(value, before[name], equal_nan=value.dtype.kind == "f")
    }


@pytest.mark.parametrize(("method", "preset"), PRESETS)
def test_a_rule_changes_only_what_it_says(method, preset):
    state = State(village(), Progress())
    for rule in pipeline_of(method, preset, state.points).rules:
        if isinstance(rule, GridRule):
            for grid in state.grids:
                before = arrays_of(grid)
                rule.apply(grid, Progress())
                assert changed(before, grid) <= set(rule.writes), rule.name
        else:
            before = arrays_of(state)
            rule.apply(state)
            assert changed(before, state) <= set(rule.writes), rule.name
    assert 0.2 < state.ground.mean() < 1.0


# What a method shares with another one is left out of one of them, of all in the long tests.
@pytest.mark.rest
@pytest.mark.parametrize(
    ("method", "shared"),
    [
        ("grid-minimum", False),
        ("slope", True),
        *(
            pytest.param(name, True, marks=pytest.mark.long)
            for name in ("grid-minimum", "tin-densification")
        ),
    ],
)
def test_a_pipeline_works_without_any_of_its_rules(method, shared):
    points = make("plaza", seed=11, density=1.0, size=80.0).points
    pipeline = pipeline_of(method, "automatic", points)
    usual = pipeline.run(points).ground
    needed = {"lowest-points", "seeds", "tolerance-surface", "near-surface"}
    known = pipeline_of("tin-densification", "automatic", points).names
    differing = 0
    for name in pipeline.names:
        if name not in needed and (shared or name not in known):
            shorter = pipeline.without(name)
            assert name not in shorter.names
            found = shorter.run(points).ground
            assert found.any()
            differing += not np.array_equal(found, usual)
    assert differing > (2 if shared else 0)


def test_a_rule_that_is_not_there_cannot_be_left_out():
    with pytest.raises(ValueError, match="wings"):
        pipeline_of("slope", "automatic", village()).without("plants", "wings")


def test_an_exception_is_left_out_wherever_it_is_a_field():
    pipeline = pipeline_of("tin-densification", "automatic", village()).without("corroborated")
    assert "corroborated" not in pipeline.names and "narrow-pits" in pipeline.names


def test_times_and_decisions_are_noted():
    points = village()
    pipeline = pipeline_of("tin-densification", "automatic", points)
    state = pipeline.run(points, explains=True)
    assert [time.name for time in state.times] == [rule.name for rule in pipeline.rules]
    assert min(time.seconds for time in state.times) >= 0.0
    cells = state.grids[0].cells
    decided = state.decided
    assert np.array_equal(decided != 0, cells.occupied)
    assert np.array_equal(decided > 0, cells.holding(state.ground))
    names = {pipeline.rules[number - 1].name for number in np.unique(np.abs(decided)) if number}
    assert {"lowest-points", "raised-objects", "near-surface"} <= names


def test_decisions_go_over_to_finer_cells():
    """Where points are sparse, the minimum-Z grid filter goes on with finer cells."""
    points = make("sparse_village", seed=11, density=0.3, size=80.0).points
    pipeline = pipeline_of("grid-minimum", "automatic", points)
    assert pipeline.through(Stage.OPENING).run(points).grids[0].cells.size > 1.0
    state = pipeline.run(points, explains=True)
    cells = state.grids[0].cells
    assert cells.size == 1.0
    assert np.array_equal(state.decided != 0, cells.occupied)
    assert np.array_equal(state.decided > 0, cells.holding(state.ground))


def test_a_name_follows_from_the_class():
    class SteepThing(Rule):
        stage = Stage.OPENING

    assert SteepThing.name == "steep-thing"
    assert Pipeline((SteepThing(),)).names == ("steep-thing",)


def test_a_single_cell_is_classified():
    points = Points(np.array([0.2, 0.4]), np.array([0.1, 0.3]), np.array([5.0, 5.1]))
    for method in METHODS:
        assert pipeline_of(method, "automatic", points).run(points).ground.any()
