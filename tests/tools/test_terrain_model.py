"""The terrain model: exact on a plane, and without holes in the hull of the ground."""

import numpy as np
import pytest

from bare_earth.algorithms.core.points import Frame, Points
from bare_earth.algorithms.rasters.geotiff import RasterGrid
from bare_earth.algorithms.tin.dense_surface import DenseSurface
from bare_earth.algorithms.tin.triangulation import Tin

FRAME = Frame((1000.0, 2000.0))


def _points(count=4000, size=40.0, seed=0):
    x, y = np.random.default_rng(seed).uniform(0.0, size, (2, count))
    return Points(x, y, 100.0 + 0.3 * x - 0.2 * y)


def _heights(points, grid):
    surface = DenseSurface(points, grid.cell_metres, grid.corner)
    return surface.raster((grid.rows, grid.columns))[::-1]


def test_a_plane_is_met_exactly():
    points = _points()
    grid = RasterGrid.over(points, FRAME, 1.0)
    heights = _heights(points, grid)
    x, y = np.meshgrid(grid.x, grid.y)
    known = np.isfinite(heights)
    assert known.mean() > 0.95
    assert np.allclose(heights[known], (100.0 + 0.3 * x - 0.2 * y)[known], atol=1e-6)


@pytest.mark.parametrize("seed", range(5))
def test_every_cell_in_the_hull_of_the_points_has_a_height_though_they_are_thinned(seed):
    points = _points(300, seed=seed)
    grid = RasterGrid.over(points, FRAME, 3.0)
    heights = _heights(points, grid)
    x, y = np.meshgrid(grid.x, grid.y)
    inside = Tin(*points).locate(x.ravel(), y.ravel()) >= 0
    assert np.array_equal(np.isfinite(heights).ravel(), inside)


@pytest.mark.parametrize(("count", "size"), [(5, 50.0), (20000, 900.0)])
def test_the_nearest_vertex_is_found_from_outside_the_hull(count, size):
    random = np.random.default_rng(1)
    x, y = random.uniform(0.0, size, (2, count))
    points = Points(x, y, random.random(count))
    surface = DenseSurface(points, 1.0, (-3.0, -2.0))
    angle, radius = random.uniform(0.0, 2.0 * np.pi, 200), size * random.uniform(0.7, 2.0, 200)
    at_x, at_y = size / 2.0 + radius * np.cos(angle), size / 2.0 + radius * np.sin(angle)
    some = points.take(surface.vertices)
    distance = np.hypot(at_x[:, None] - some.x, at_y[:, None] - some.y)
    assert np.array_equal(surface.nearest(at_x, at_y), some.z[distance.argmin(axis=1)])
