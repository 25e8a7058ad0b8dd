"""The confidence: as often right as it says, and less where less is known."""

import numpy as np
import pytest
from matrices import quick

from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.grids.confidence import Weights, confidence
from benchmarks.clouds import classify_cloud
from benchmarks.confidence import Seen, compared, fitted, reliability
from benchmarks.scenes import make

HOUSE = (40.0, 60.0)


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
    """Return the mean confidence of the cells of some points."""
    return float(found.values.ravel()[found.cells.index[where]].mean())


@pytest.fixture(scope="module")
def scenes():
    return [make(kind, seed=7, size=85.0) for kind in ("village", "open_forest")]


@pytest.mark.parametrize("method", quick(METHODS, "slope"))
def test_it_is_right_as_often_as_it_says(method, scenes):
    seen = []
    for scene in scenes:
        classes, takes_part = classify_cloud(scene.cloud(), METHODS[method].parameters())
        points, ground = scene.points.take(takes_part), classes[takes_part] == 2
        seen.append(compared(points, ground, scene.terrain))
    bins = [level for level in reliability(seen) if level.share > 0]
    sure = [level for level in bins if level.stated > 0.9]
    assert sum(value.share for value in sure) > 0.5
    assert all(abs(level.right - level.stated) < 0.1 for level in bins if level.share > 0.05)
    assert abs(sum(level.share * (level.right - level.stated) for level in bins)) < 0.05


def test_it_is_less_under_trees_and_where_a_house_stood_than_in_the_open():
    points, ground = flat()
    found = confidence(points, ground)
    assert found.values.dtype == np.float32 and found.values.shape == found.cells.shape
    x, y, _ = points
    middle = (np.abs(x - 50) < 5) & (np.abs(y - 50) < 5)
    open_land = mean_in(found, points, (x > 10) & (x < 30))
    trees = mean_in(found, points, x > 80)
    assert open_land > 0.97
    assert 1 - trees > 3 * (1 - open_land)
    assert mean_in(found, points, middle) < trees


def test_rejected_points_just_above_the_ground_make_it_less_sure():
    points, ground = flat()
    # Whole cells, so that the lowest point of a cell is among them.
    rejected = ground & (points.x < 30) & ((points.x // 1 + points.y // 1) % 3 == 0)
    before, after = (confidence(points, mask) for mask in (ground, ground & ~rejected))
    where = (points.x > 5) & (points.x < 25)
    assert mean_in(after, points, where) < mean_in(before, points, where) - 0.1


def test_order_and_translation_by_whole_cells_change_nothing():
    points, ground = flat()
    found = confidence(points, ground).values
    order = np.random.default_rng(1).permutation(points.count)
    assert np.array_equal(confidence(points.take(order), ground[order]).values, found)
    moved = points._replace(x=points.x + 1024, y=points.y - 512, z=points.z + 128)
    np.testing.assert_allclose(confidence(moved, ground).values, found, atol=1e-3)


def test_what_is_far_away_changes_nothing():
    points, ground = flat()
    far = points.x < 70
    found, whole = confidence(points.take(far), ground[far]), confidence(points, ground)
    near = slice(0, 40)
    np.testing.assert_allclose(found.values[:, near], whole.values[:, near], atol=1e-3)


def test_without_ground_nothing_is_sure():
    points, ground = flat()
    assert not confidence(points, np.zeros_like(ground)).values.any()


def test_the_fit_finds_the_weights_that_made_the_data():
    random = np.random.default_rng(3)
    pieces = random.uniform(0, 1, (100_000, 5)) * (1.0, 0.5, 4.0, 4.0, 0.2)
    true = np.array(Weights(2.0, -1.0, -3.0, -0.4, -0.2, -6.0))
    right = random.random(len(pieces)) < 1 / (1 + np.exp(-true[0] - pieces @ true[1:]))
    found = fitted([Seen("", False, pieces, right), Seen("", True, pieces, right)])
    np.testing.assert_allclose(found, true, rtol=0.15)
    for level in reliability([Seen("", False, pieces, right)], found):
        assert level.share < 0.01 or abs(level.right - level.stated) < 0.02
