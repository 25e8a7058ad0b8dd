"""The TIN: exact location, linear interpolation, and odd inputs."""

import time

import numpy as np
import pytest
from scipy.spatial import Delaunay

from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.filters.triangles_round import CellVertices
from bare_earth.algorithms.grids.cells import Cells
from bare_earth.algorithms.tin.triangulation import Tin, lost_triangles


def _scatter(count=2000, seed=1, size=100.0):
    random = np.random.default_rng(seed)
    x, y = random.uniform(0.0, size, (2, count))
    return x, y, random.normal(0.0, 1.0, count)


@pytest.mark.rest
def test_every_query_inside_lies_in_the_triangle_it_is_located_in():
    tin = Tin(*_scatter())
    x, y, _ = _scatter(5000, seed=2)
    found = tin.locate(x, y)
    reference = Delaunay(np.column_stack((tin.x, tin.y)))
    expected = reference.find_simplex(np.column_stack((x, y)))
    assert np.array_equal(found >= 0, expected >= 0)
    inside = found >= 0
    assert np.array_equal(
        np.sort(tin.triangles[found[inside]], axis=1),
        np.sort(reference.simplices[expected[inside]], axis=1),
    )


def test_a_plane_is_interpolated_exactly_and_outside_the_hull_is_nan():
    x, y, _ = _scatter()
    tin = Tin(x, y, 3.0 + 0.2 * x - 0.1 * y)
    at_x, at_y = np.array([50.0, 20.0, -5.0, 500.0]), np.array([50.0, 70.0, 50.0, 500.0])
    height = tin.interpolate(at_x, at_y)
    assert np.allclose(height[:2], 3.0 + 0.2 * at_x[:2] - 0.1 * at_y[:2], atol=1e-9)
    assert np.isnan(height[2:]).all()


def test_vertices_have_their_own_heights():
    x, y, z = _scatter()
    tin = Tin(x, y, z)
    assert np.allclose(tin.interpolate(x, y), z, atol=1e-6)
    assert np.array_equal(z[tin.source], tin.z)


def test_of_points_at_one_place_the_lowest_is_the_vertex():
    x, y = np.array([0.0, 0.0, 10.0, 0.0]), np.array([0.0, 0.0, 0.0, 10.0])
    tin = Tin(x, y, np.array([5.0, 2.0, 2.0, 2.0]))
    assert len(tin.z) == 3
    assert np.allclose(tin.interpolate(np.array([2.0]), np.array([2.0])), 2.0)


def test_the_order_of_the_vertices_does_not_matter():
    x, y, z = _scatter()
    mixed = np.random.default_rng(3).permutation(len(x))
    at_x, at_y, _ = _scatter(500, seed=4)
    one = Tin(x, y, z).interpolate(at_x, at_y)
    other = Tin(x[mixed], y[mixed], z[mixed]).interpolate(at_x, at_y)
    assert np.array_equal(one, other, equal_nan=True)


def test_a_regular_grid_far_from_the_origin_is_covered_to_its_border():
    x, y = (axis.ravel() for axis in np.meshgrid(np.arange(40.0), np.arange(30.0)))
    x, y = x + 4.0e6, y + 5.0e6
    tin = Tin(x, y, x - 4.0e6)
    assert np.allclose(tin.interpolate(x, y), x - 4.0e6, atol=1e-6)


@pytest.mark.parametrize("count", [0, 1, 2, 3, 50])
def test_points_that_span_no_triangle_give_a_surface_without_heights(count):
    line = np.arange(count, dtype=float)
    tin = Tin(line, 2.0 * line, line)
    assert len(tin.triangles) == 0
    assert np.isnan(tin.interpolate(np.array([1.0]), np.array([2.0]))).all()


@pytest.mark.rest
def test_a_stray_vertex_far_away_does_not_slow_the_walk():
    def seconds(tin):
        begun = time.process_time()
        assert (tin.locate(x, y) >= 0).all()
        return time.process_time() - begun

    x, y, z = _scatter(20_000)
    without = Tin(x, y, z)
    tin = Tin(np.append(x, 1.0e6), np.append(y, 1.0e6), np.append(z, 0.0))
    least = [min(seconds(value) for _ in range(3)) for value in (without, tin)]
    assert least[1] < 4 * least[0]


def test_the_triangles_lost_to_new_vertices_are_those_that_a_new_triangulation_does_not_have():
    random = np.random.default_rng(4)
    x, y = random.uniform(0.0, 100.0, (2, 400))
    new_x, new_y = random.uniform(10.0, 90.0, (2, 15))
    tin = Tin(x, y, np.zeros(400))
    more = Tin(np.append(x, new_x), np.append(y, new_y), np.zeros(415))

    def corners(tin):
        return [frozenset(zip(tin.x[three], tin.y[three])) for three in tin.triangles]

    left = set(corners(more))
    expected = [three not in left for three in corners(tin)]
    assert 15 < sum(expected) < 200
    assert (
        lost_triangles(tin.x[tin.triangles], tin.y[tin.triangles], new_x, new_y).tolist()
        == expected
    )


def test_triangles_from_the_vertices_near_places_are_those_of_a_triangulation():
    random = np.random.default_rng(1)
    points = Points(*np.round(random.uniform(0.0, 120.0, (2, 5000)), 2), random.random(5000))
    cells = Cells.over(points, 1.5)
    vertices = np.flatnonzero((random.random(5000) < 0.4) & (np.abs(points.x - 60.0) > 8.0))
    places = random.uniform(0.0, 120.0, (2, 1500))
    found = CellVertices(points, vertices, cells).triangles(*places)
    tin = Tin(*points.take(vertices))
    triangle = tin.locate(*places)
    expected = np.sort(vertices[tin.source[tin.triangles[triangle]]], axis=1)
    sure = found[:, 0] >= 0
    assert 0.6 < sure.mean() < 0.95
    assert (triangle[sure] >= 0).all()
    assert np.array_equal(found[sure], expected[sure])
