"""Heights on the TIN of thinned points are those of all its vertices, whatever else is asked."""

import numpy as np
import pytest
import scipy.interpolate

from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.tin.dense_surface import DenseSurface

SIDE, MIDDLE = 200.0, 100.0  # metres


def hills_round(radius, count, reach=SIDE):
    """Return points of hilly land in a square, with a lake in the middle that has none."""
    x, y = np.random.default_rng(1).uniform(0.0, reach, (2, count))
    dry = np.hypot(x - MIDDLE, y - MIDDLE) > radius
    x, y = x[dry], y[dry]
    return Points(x, y, 20.0 * np.cos(x / 40.0) * np.cos(y / 40.0))


def exact(surface, points, x, y):
    """Return heights on a single triangulation of all vertices."""
    vertices = points.take(surface.vertices)
    return scipy.interpolate.LinearNDInterpolator(np.column_stack(vertices[:2]), vertices.z)(x, y)


@pytest.mark.parametrize("across", [0.0, 0.5, 0.95])
@pytest.mark.parametrize("radius", [6.0, 12.0, 30.0, 80.0])
def test_a_single_point_above_a_lake_is_above_the_land_round_it(radius, across):
    points = hills_round(radius, 30_000)
    surface = DenseSurface(points, 1.0)
    x, y = np.array([MIDDLE]), np.array([MIDDLE + across * radius])
    assert surface.heights(x, y) == pytest.approx(exact(surface, points, x, y), abs=1e-6)


def test_few_points_far_apart_have_the_heights_of_all():
    points = hills_round(30.0, 500, reach=3_000.0)
    surface = DenseSurface(points, 1.0)
    x, y = np.random.default_rng(2).uniform(500.0, 2_500.0, (2, 50))
    assert surface.heights(x, y) == pytest.approx(exact(surface, points, x, y), abs=1e-6)


@pytest.mark.parametrize("max_edge", [None, 90.0])
def test_a_raster_that_ends_in_a_lake_is_part_of_one_that_does_not(max_edge):
    surface = DenseSurface(hills_round(40.0, 30_000), 1.0)
    rows, half = int(SIDE), int(MIDDLE)
    whole, west = (surface.raster((rows, columns), max_edge) for columns in (rows, half))
    np.testing.assert_allclose(west, whole[:, :half], atol=1e-6)
