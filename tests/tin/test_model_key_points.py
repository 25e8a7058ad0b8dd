"""Model key points: every ground point within the tolerance of their TIN, with few of them."""

import itertools

import numpy as np
import pytest
from matrices import quick
from runs import Heard

from bare_earth import BareEarthError
from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.core.threads import may_use
from bare_earth.algorithms.tin.model_key_points import ModelKeyPoints, model_key_points, reach
from bare_earth.algorithms.tin.triangulation import Tin
from benchmarks.scenes.simple import scatter


def _hills(size=100.0, density=1.5, noise=0.02):
    x, y = scatter(size, density, seed=3)
    random = np.random.default_rng(1)
    z = 5 * np.sin(x / 20) + 3 * np.cos(y / 13) + np.where(x > 60, 4.0, 0.0)
    return Points(x, y, z + random.normal(0.0, noise, len(x)))


def _residuals(points, keys):
    return points.z - Tin(*points.take(keys)).interpolate(points.x, points.y)


@pytest.mark.rest(but="0.5-0.05")
@pytest.mark.parametrize("above, below", [(0.15, 0.15), (0.5, 0.05), (0.05, 1.0), (0.0, 0.0)])
def test_every_ground_point_is_within_the_tolerance(above, below):
    points = _hills()
    keys = model_key_points(points, ModelKeyPoints(tolerance_above=above, tolerance_below=below))
    residuals = _residuals(points, keys)
    assert not np.isnan(residuals).any()
    assert residuals.max() <= above + 1e-6 and residuals.min() >= -below - 1e-6
    if above and below:
        assert np.count_nonzero(keys) < 0.6 * points.count


def test_progress_never_goes_back():
    progress = Heard()
    model_key_points(_hills(), progress=progress)
    assert len(progress.fractions) > 5 and np.diff(progress.fractions).min() >= 0.0


def test_a_plane_needs_no_more_than_the_grid_and_the_hull():
    x, y = scatter(100.0, 4.0)
    points = Points(x, y, 50.0 + 0.1 * x - 0.2 * y)
    keys = model_key_points(points, ModelKeyPoints(grid_size=20.0))
    assert 25 <= np.count_nonzero(keys) < 25 + 60
    sparse = model_key_points(points, ModelKeyPoints(grid_size=200.0))
    assert np.count_nonzero(sparse) < 60


def test_every_cell_of_the_grid_keeps_a_point():
    points = _hills()
    loose = ModelKeyPoints(tolerance_above=50.0, tolerance_below=50.0, grid_size=10.0)
    kept = points.take(model_key_points(points, loose))
    assert len(np.unique(np.floor(kept.x / 10) * 1000 + np.floor(kept.y / 10))) == 10 * 10


@pytest.mark.rest
def test_a_looser_tolerance_keeps_fewer():
    points = _hills()
    counts = [
        np.count_nonzero(
            model_key_points(points, ModelKeyPoints(tolerance_above=number, tolerance_below=number))
        )
        for number in (0.05, 0.1, 0.2, 0.5, 1.0)
    ]
    assert counts == sorted(counts, reverse=True) and counts[0] > 4 * counts[-1]


def test_neither_the_order_of_the_points_nor_the_threads_matter():
    points = _hills(60.0)
    mixed = np.random.default_rng(2).permutation(points.count)
    keys = model_key_points(points)
    assert np.array_equal(model_key_points(points.take(mixed)), keys[mixed])
    with may_use(3):
        assert np.array_equal(model_key_points(points), keys)


def test_points_on_a_regular_grid_with_straight_borders():
    x, y = (axis.ravel() for axis in np.meshgrid(np.arange(0.0, 60.0), np.arange(0.0, 40.0)))
    points = Points(x + 0.1, y + 0.3, np.sin(x / 5) + np.where(y == 0, 0.4, 0.0))
    keys = model_key_points(points)
    assert np.abs(_residuals(points, keys)).max() <= 0.15 + 1e-6
    assert np.count_nonzero(keys) < points.count / 2


def test_on_a_lattice_it_does_not_matter_which_diagonals_the_tin_has():
    x, y = (axis.ravel() for axis in np.meshgrid(np.arange(0.0, 50.0, 0.5), np.arange(80.0)))
    noise = np.random.default_rng(4).normal(0.0, 0.05, len(x))
    points = Points(x, y, 5.0 * np.sin(x / 20.0) + 3.0 * np.cos(y / 13.0) + noise)
    keys = model_key_points(points)
    for east, north in itertools.product((1.0, -1.0), (1.0, -1.0)):
        turned = Points(east * x, north * y, points.z)
        assert np.abs(_residuals(turned, keys)).max() <= 0.15 + 1e-6


def _parts(points, side, parameters):
    """Return the key points of square parts, each chosen with its surroundings and origin."""
    keys, width = np.zeros(points.count, dtype=bool), reach(parameters)
    for row, column in itertools.product(range(3), range(3)):
        west, south = column * side, row * side
        x, y = points.x - west, points.y - south
        seen = np.flatnonzero(np.maximum(abs(x - side / 2), abs(y - side / 2)) < side / 2 + width)
        own = (np.floor(x[seen] / side) == 0) & (np.floor(y[seen] / side) == 0)
        part = Points(x[seen], y[seen], points.z[seen])
        chosen = model_key_points(part, parameters, anchor=(-west, -south))
        keys[seen[own & chosen]] = True
    return keys


@pytest.mark.rest
@pytest.mark.parametrize("grid_size", quick([7.0, 10.0], 7.0))
def test_a_part_with_its_surroundings_has_the_key_points_of_the_whole(grid_size):
    points, parameters = _hills(300.0), ModelKeyPoints(grid_size=grid_size)
    whole, parts = model_key_points(points, parameters), _parts(points, 100.0, parameters)
    differ = np.flatnonzero(whole != parts)
    assert len(differ) <= 0.001 * np.count_nonzero(whole)
    # What differs lies at the border of the survey.
    inwards = np.minimum(points.x, points.y), 300.0 - np.maximum(points.x, points.y)
    assert np.minimum(*inwards)[differ].max(initial=0.0) < grid_size


@pytest.mark.rest
def test_key_points_of_parts_keep_the_tolerance_together():
    points, parameters = _hills(300.0), ModelKeyPoints()
    residuals = _residuals(points, _parts(points, 100.0, parameters))
    assert np.count_nonzero(np.isnan(residuals)) == 0
    assert np.abs(residuals).max() <= 0.15 + 1e-6


def test_the_grid_begins_where_it_is_said_to():
    points, parameters = _hills(60.0), ModelKeyPoints(50.0, 50.0, 10.0)
    keys = model_key_points(points, parameters, anchor=(1234.0, -3.0))
    moved = Points(points.x - 4.0, points.y + 3.0, points.z)
    assert np.array_equal(model_key_points(moved, parameters), keys)
    assert not np.array_equal(model_key_points(points, parameters), keys)


def test_a_gap_wider_than_the_grid_keeps_the_tolerance():
    points = _hills(200.0, density=0.5)
    points = points.take(np.hypot(points.x - 100.0, points.y - 80.0) > 60.0)
    keys = model_key_points(points)
    assert np.abs(_residuals(points, keys)).max() <= 0.15 + 1e-6


def test_of_points_at_one_place_the_lowest_counts():
    points = _hills(40.0)
    points = Points(*(np.append(point, point[:50]) for point in points))
    points.z[-50:] += 3.0
    keys = model_key_points(points)
    assert not keys[-50:].any()
    assert np.abs(_residuals(points, keys)[:-50]).max() <= 0.15 + 1e-6


def test_points_on_lines_that_are_straight_but_for_rounding_come_to_an_end():
    random = np.random.default_rng(18)
    x = random.uniform(0.0, 10.0, 360)
    y = 2.0 * x + 5.0 * random.integers(0, 2, len(x))
    keys = model_key_points(
        Points(x + 5e5, y, random.normal(size=len(x))),
        ModelKeyPoints(tolerance_above=0.0, tolerance_below=0.0, grid_size=100.0),
    )
    assert 0.9 * len(keys) < np.count_nonzero(keys) <= len(keys)


@pytest.mark.parametrize("count", [0, 1, 2, 3, 40])
def test_points_on_one_line_are_all_kept(count):
    line = np.arange(count, dtype=float)
    assert model_key_points(Points(line, 2 * line, line)).all()


def test_a_negative_tolerance_is_refused():
    with pytest.raises(BareEarthError, match=r"Tolerance above .* at least 0 m"):
        ModelKeyPoints(tolerance_above=-0.1)
