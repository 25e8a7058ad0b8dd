"""The expected error: it holds most errors, and is larger where less is known."""

import numpy as np
import pytest
from matrices import quick

from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.grids.cells import Cells
from bare_earth.algorithms.grids.expected_error import (
    FACTORS,
    LEAST,
    Evidence,
    causes_of,
    error_of,
    expected_error,
    expected_rmse,
)
from benchmarks.clouds import classify_cloud
from benchmarks.ensemble import further_members, spread_of
from benchmarks.expected_error import Seen, auc, compared, fitted, score, share_over, with_ensemble
from benchmarks.scenes import make

HOUSE = (40.0, 60.0)
NAMES = tuple(FACTORS)


def flat(count=20_000, side=100.0, seed=5):
    """Return level land with a house of 20 m and trees in the east, and what of it is ground."""
    random = np.random.default_rng(seed)
    x, y = random.uniform(0, side, (2, count))
    z = random.normal(0, 0.02, count)
    house = (x > HOUSE[0]) & (x < HOUSE[1]) & (y > HOUSE[0]) & (y < HOUSE[1])
    trees = (x > 75) & (random.random(count) < 0.97)
    z[house] += 6.0
    z[trees] += random.uniform(4, 15, np.count_nonzero(trees))
    return Points(x, y, z), ~house & ~trees


def mean_in(found, points, where):
    """Return the mean expected error of the cells of some points."""
    return float(found.values.ravel()[found.cells.index[where]].mean())


@pytest.fixture(scope="module")
def scenes():
    return [make(kind, seed=7, size=85.0) for kind in ("village", "open_forest")]


@pytest.mark.parametrize("method", quick(METHODS, "slope"))
def test_most_errors_lie_within_it(method, scenes):
    for scene in scenes:
        classes, takes_part = classify_cloud(scene.cloud(), METHODS[method].parameters())
        points, ground = scene.points.take(takes_part), classes[takes_part] == 2
        seen = compared(points, ground, scene.terrain)
        found = score(seen.error, error_of(seen.pieces))
        assert found.inside > 0.9
        assert found.median < 1.0  # it is not large everywhere
        if found.over[1] > 0.01:
            assert found.auc > 0.65


def test_it_is_larger_under_trees_and_where_a_house_stood_than_in_the_open():
    points, ground = flat()
    found = expected_error(points, ground)
    assert found.values.dtype == np.float32 and found.values.shape == found.cells.shape
    x, y, _ = points
    middle = (np.abs(x - 50) < 5) & (np.abs(y - 50) < 5)
    open_land = mean_in(found, points, (x > 10) & (x < 30))
    trees = mean_in(found, points, x > 80)
    assert LEAST <= open_land < 0.25
    assert trees > 1.5 * open_land
    assert mean_in(found, points, middle) > trees


def test_the_cause_of_a_gap_is_a_gap():
    gap = causes_of(evidence_of(gap=20.0, holes=0.5))
    plants = causes_of(evidence_of(low_plants=0.3))
    assert gap[0, 0] == 1 + NAMES.index("gap")
    assert plants[0, 0] == 1 + NAMES.index("low_plants")
    assert causes_of(evidence_of())[0, 0] == 0


def evidence_of(**values):
    """Return the evidence of one cell, 0 but for some pieces."""
    return Evidence(**{name: np.array([[values.get(name, 0.0)]]) for name in NAMES})


@pytest.mark.parametrize("name", NAMES)
def test_more_evidence_never_makes_it_smaller(name):
    errors = [error_of(evidence_of(**{name: value}))[0, 0] for value in (0, 0.1, 0.5, 1, 5, 50)]
    assert errors == sorted(errors) and errors[-1] > errors[0]
    assert all(factor >= 1.0 for _, factor in FACTORS[name])


def test_rejected_points_just_above_the_ground_make_it_larger():
    points, ground = flat()
    low = ground & (points.x < 30) & ((points.x // 1 + points.y // 1) % 3 == 0)
    raised = points._replace(z=points.z + np.where(low, 0.2, 0.0))
    before = expected_error(points, ground)
    after = expected_error(raised, ground & ~low)
    where = (points.x > 5) & (points.x < 25)
    assert mean_in(after, points, where) > 1.3 * mean_in(before, points, where)


def test_order_and_translation_by_whole_cells_change_nothing():
    points, ground = flat()
    found = expected_error(points, ground).values
    order = np.random.default_rng(1).permutation(points.count)
    assert np.array_equal(expected_error(points.take(order), ground[order]).values, found)
    moved = points._replace(x=points.x + 1024, y=points.y - 512, z=points.z + 128)
    np.testing.assert_allclose(expected_error(moved, ground).values, found, atol=1e-3)


def test_what_is_far_away_changes_nothing():
    points, ground = flat()
    far = points.x < 70
    found, whole = expected_error(points.take(far), ground[far]), expected_error(points, ground)
    near = slice(0, 40)
    np.testing.assert_allclose(found.values[:, near], whole.values[:, near], atol=1e-3)


def test_without_ground_it_is_that_of_a_wide_gap():
    points, ground = flat()
    nothing = expected_error(points, np.zeros_like(ground)).values
    assert nothing.min() == nothing.max() > 3 * LEAST


def test_the_share_over_a_limit_is_a_twentieth_at_the_expected_error():
    error = np.array([0.1, 0.3, 1.0])
    assert share_over(0.3, error)[1] == pytest.approx(0.05)
    assert (np.diff(share_over(0.3, error)) > 0).all()
    assert np.isnan(expected_rmse(np.full(3, np.nan)))
    assert expected_rmse(np.array([0.2, 0.2, np.nan])) < 0.2


@pytest.mark.rest
def test_the_fit_finds_the_factors_that_made_the_data():
    random = np.random.default_rng(3)
    roughness, gap = random.uniform(0, 0.6, 60_000), random.uniform(0, 30, 60_000)
    nothing = np.zeros_like(gap)
    pieces = Evidence(nothing, roughness, nothing, gap, nothing, nothing, nothing)
    expected = 0.1 * np.exp(3.0 * roughness) * np.exp(gap / 15.0)
    # Of an exponential distribution, 95 % are smaller than three times its scale.
    error = random.exponential(expected / np.log(20.0))
    fit = fitted([Seen("one", "slope", pieces, error, nothing, nothing)])
    found = fit.of(Seen("one", "slope", pieces, error, nothing, nothing))
    assert np.mean(error <= found) == pytest.approx(0.95, abs=0.01)
    assert np.median(np.abs(np.log(found / expected))) < 0.35


def test_ranks_count_pairs():
    values, which = np.array([1.0, 2.0, 3.0, 4.0]), np.array([False, True, False, True])
    assert auc(values, which) == 0.75
    assert np.isnan(auc(values, np.zeros(4, dtype=bool)))


def test_the_spread_is_the_standard_deviation_of_the_terrains():
    points, ground = flat()
    cells = Cells.over(points, 1.0)
    every = tuple(map(np.arange, cells.shape))
    grounds = [ground, ground, np.ones(points.count, dtype=bool)]
    spread = spread_of(cells, points.z, grounds, *every)
    row, column = np.indices(cells.shape)
    (low, high), open_land = HOUSE, (row < HOUSE[0] - 5) & (column < 70)
    house = (row > low) & (row < high - 1) & (column > low) & (column < high - 1)
    # In one of three runs the house of 6 m is ground.
    np.testing.assert_allclose(spread[house], np.std([0.0, 0.0, 6.0]), atol=0.1)
    assert spread[open_land].max() == 0.0
    nowhere = [*grounds, np.zeros(points.count, dtype=bool)]
    assert np.isinf(spread_of(cells, points.z, nowhere, *every)).all()


def test_all_members_of_an_ensemble_have_the_preset():
    parameters = METHODS["slope"].parameters(preset="site", ground_tolerance=0.4)
    members = list(further_members(parameters))
    assert [one.parameters.preset for one in members] == ["site"] * 4
    assert {one.parameters.ground_tolerance for one in members} == {0.4}
    classic = METHODS["slope"].parameters(preset="whitebox")
    assert [one.parameters.preset for one in further_members(classic)][2:] == ["automatic"] * 2


def test_the_fit_of_an_ensemble_finds_that_spread_tells_the_error():
    random = np.random.default_rng(3)
    nothing = Evidence(*np.zeros((7, 4000), dtype=np.float32))
    seen = []
    for name in "abcd":
        spread = random.uniform(0, 1, 4000)
        error = np.abs(random.normal(0, 0.05 + spread))
        seen.append(Seen(name, "", nothing, error, spread, spread, spread))
    one = [np.full(4000, 1.0)] * 4
    several = with_ensemble(seen, one)
    for found, before, after in zip(seen, one, several):
        usual, better = score(found.error, before), score(found.error, after)
        assert usual.auc == 0.5 < 0.7 < better.auc and 0.92 < better.inside < 0.98
