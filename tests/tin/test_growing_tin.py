"""A TIN that grows: the Delaunay triangulation of all its vertices, whatever came when."""

import numpy as np
import pytest

from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.tin.growing_tin import GrowingTin
from bare_earth.algorithms.tin.triangulation import Tin, hull_corners


def _scattered():
    random = np.random.default_rng(0)
    return Points(*random.uniform(-50.0, 50.0, (2, 3000)), random.normal(size=3000))


def _lattice():
    x, y = (axis.ravel() for axis in np.meshgrid(np.arange(-15.0, 15.0), np.arange(-10.0, 10.0)))
    return Points(x, y, np.random.default_rng(1).normal(size=len(x)))


def _heights(tin, x, y):
    triangle, heights = np.zeros(len(x), dtype=np.int32), np.full(len(x), np.nan)
    while np.isnan(heights).any():
        heights = tin.heights(x, y, triangle)
    return heights, triangle


def _grown(points, seeds):
    """Return the TIN of some points to which all others were added, and the order of both."""
    tin, order = GrowingTin(points.take(seeds)), seeds
    left = np.setdiff1d(np.arange(points.count), seeds)
    while len(left):
        _, triangle = _heights(tin, points.x[left], points.y[left])
        triangle, first = np.unique(triangle, return_index=True)
        added, changed = tin.add(points.take(left[first]), triangle, points.z[left[first]])
        assert added.any() and len(changed) == tin.count
        order = np.append(order, left[first[added]])
        left = np.delete(left, first[added])
    return tin, order


def _areas(points, corners):
    a, b, c = corners.reshape(-1, 3).T
    x, y = points.x, points.y
    return ((x[b] - x[a]) * (y[c] - y[a]) - (y[b] - y[a]) * (x[c] - x[a])) / 2.0


def test_it_has_the_triangles_of_one_triangulation():
    points = _scattered()
    tin, order = _grown(points, hull_corners(points.x, points.y))
    once = Tin(*points)
    triangles = np.sort(order[tin.corners.reshape(-1, 3)], axis=1)
    expected = np.sort(once.source[once.triangles], axis=1)
    assert sorted(map(tuple, triangles)) == sorted(map(tuple, expected))
    x, y = np.random.default_rng(2).uniform(-45.0, 45.0, (2, 500))
    assert np.allclose(_heights(tin, x, y)[0], once.interpolate(x, y))


@pytest.mark.rest(but="_scattered")
@pytest.mark.parametrize("make", [_scattered, _lattice])
def test_each_edge_knows_its_twin(make):
    points = make()
    tin, _ = _grown(points, hull_corners(points.x, points.y))
    inner = np.flatnonzero(tin.twins >= 0)
    assert np.array_equal(tin.twins[tin.twins[inner]], inner)
    following = [inner - inner % 3 + (inner + k) % 3 for k in (1, 2)]
    twin = tin.twins[inner]
    of_twin = [twin - twin % 3 + (twin + k) % 3 for k in (2, 1)]
    for one, other in zip(following, of_twin):
        assert np.array_equal(tin.corners[one], tin.corners[other])


@pytest.mark.rest
def test_vertices_on_edges_and_on_the_hull_leave_no_flat_triangle():
    points = _lattice()
    tin, _ = _grown(points, hull_corners(points.x, points.y))
    assert np.allclose(_areas(tin.vertices, tin.corners), 0.5)
    assert tin.count == 2 * 29 * 19


@pytest.mark.rest
def test_the_diagonals_of_a_lattice_do_not_depend_on_what_came_first():
    points, random = _lattice(), np.random.default_rng(3)
    corners = hull_corners(points.x, points.y)
    found = []
    for _ in range(2):
        some = np.union1d(corners, random.choice(points.count, 50, replace=False))
        tin, order = _grown(points, some)
        found.append(set(map(tuple, np.sort(order[tin.corners.reshape(-1, 3)], axis=1))))
    assert found[0] == found[1]


def test_an_edge_between_four_vertices_on_a_circle_might_as_well_be_flipped():
    square = Points(np.array([0.0, 1.0, 1.0, 0.0]), np.array([0.0, 0.0, 1.0, 1.0]), np.arange(4.0))
    tin = GrowingTin(square)
    edges = np.flatnonzero(tin.ambiguous_edges())
    assert len(edges) == 2
    x, y = np.array([0.5, 0.5]), np.array([0.5, 0.5])
    heights = sorted((_heights(tin, x, y)[0][0], tin.flipped_heights(x, y, edges)[0]))
    assert np.allclose(heights, [1.0, 2.0])


def test_beside_a_flipped_edge_the_height_is_that_of_the_other_diagonal():
    square = Points(np.array([0.0, 1.0, 1.0, 0.0]), np.array([0.0, 0.0, 1.0, 1.0]), np.arange(4.0))
    tin = GrowingTin(square)
    x, y = np.random.default_rng(4).uniform(0.02, 0.98, (2, 60))
    rising = np.where(y <= x, x + y, 3.0 * y - x)
    falling = np.where(x + y <= 1.0, x + 3.0 * y, 2.0 - x + y)
    heights, triangle = _heights(tin, x, y)
    edges = np.flatnonzero(tin.ambiguous_edges())
    own = edges[np.argmax(edges // 3 == triangle[:, None], axis=1)]
    flipped = tin.flipped_heights(x, y, own)
    assert np.allclose(np.minimum(heights, flipped), np.minimum(rising, falling))
    assert np.allclose(np.maximum(heights, flipped), np.maximum(rising, falling))
