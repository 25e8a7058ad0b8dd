"""The surface in blocks is that of one triangulation."""

import numpy as np
import pytest
import scipy.interpolate
import scipy.spatial
from matrices import covering

from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.tin import surface as module
from bare_earth.algorithms.tin.surface import Surface
from bare_earth.algorithms.tin.triangulation import Tin, hull_corners


def _scatter(count=3000, seed=1, size=100.0):
    random = np.random.default_rng(seed)
    x, y = random.uniform(0.0, size, (2, count))
    return Points(x, y, random.normal(0.0, 1.0, count))


def _with_lake(points):
    return points.take(np.hypot(points.x - 45, points.y - 50) > 30)


def _villages(points):
    return points.take((np.abs(points.x - 50) > 30) & (np.abs(points.y - 50) < 30))


def _with_corners(points):
    """Return points within a large square, of which only the corners are there."""
    corners = [-110, 110, 110, -110], [-10, -10, 210, 210], [0, 1, 4, 2]
    return Points(*map(np.append, points, corners))


def _rotated(points):
    return Points(points.x - points.y, points.x + points.y, points.z)


CLOUDS = {
    "even": _scatter(),
    "lake": _with_lake(_scatter()),
    "rotated": _rotated(_scatter()),
    "stray": Points(*(np.append(axis, 5e3) for axis in _scatter())),
    "villages": _with_corners(_villages(_scatter())),
    "uneven": Points(_scatter().x ** 3 / 1e4, _scatter().y, _scatter().z),
}


@pytest.fixture
def small_blocks(monkeypatch):
    monkeypatch.setattr(module, "_VERTICES_A_BLOCK", 300)


@pytest.mark.rest(but="villages-None")
@pytest.mark.parametrize(("name", "max_edge"), covering(list(CLOUDS), [None, 8.0]))
def test_blocks_give_the_heights_of_one_triangulation(small_blocks, name, max_edge):
    points = CLOUDS[name]
    random = np.random.default_rng(7)
    x, y = random.uniform(-120.0, 120.0, 2500), random.uniform(-20.0, 220.0, 2500)
    if max_edge is None:  # at a vertex, one triangle may be a gap and the next none
        x, y = np.append(x, points.x[::5]), np.append(y, points.y[::5])
    tin = Tin(*points)
    corners, triangle = np.column_stack((tin.x, tin.y))[tin.triangles], tin.locate(x, y)
    longest = np.hypot(*(corners - np.roll(corners, 1, axis=1)).transpose(2, 0, 1)).max(axis=1)
    if max_edge is not None:
        triangle[longest[triangle] > max_edge] = -1
    expected = tin.interpolate(x, y, triangle)
    found = Surface(points).heights(x, y, max_edge)
    assert np.array_equal(np.isnan(found), np.isnan(expected))
    # Among triangles kilometres long the two may round differently.
    wrong = np.abs(found - expected) > 1e-9
    assert np.count_nonzero(wrong) <= (5 if name == "stray" else 0)
    assert np.isnan(found).any() and not np.isnan(found).all()


@pytest.mark.rest(but="scattered")
@pytest.mark.parametrize("shore", [0, 400], ids=["scattered", "all on one circle"])
def test_a_lake_costs_as_its_shore_and_not_as_its_cells(small_blocks, monkeypatch, shore):
    """In the middle of a lake, the nearest vertex takes a search of the whole shore."""
    asked = []

    class Counting(scipy.spatial.cKDTree):
        def query(self, places, *rest, **more):
            asked.append(len(places))
            return super().query(places, *rest, **more)

    monkeypatch.setattr(scipy.spatial, "cKDTree", Counting)
    angle = np.arange(shore) * 2.0 * np.pi / max(shore, 1)
    x, y, _ = _with_lake(_scatter(20_000))
    x, y = np.append(x, 45.0 + 30.0 * np.cos(angle)), np.append(y, 50.0 + 30.0 * np.sin(angle))
    at_x, at_y = (axis.ravel() for axis in np.meshgrid(*(np.arange(20.0, 75.0, 0.2),) * 2))
    heights = Surface(Points(x, y, 3.0 + 0.2 * x - 0.1 * y)).heights(at_x, at_y)
    assert np.allclose(heights, 3.0 + 0.2 * at_x - 0.1 * at_y, atol=1e-6)
    assert sum(asked) < len(at_x) / 10


@pytest.mark.parametrize("seed", [5, 10])
def test_queries_on_the_straight_shore_of_a_lake_do_not_search_without_end(
    small_blocks, monkeypatch, seed
):
    """Such a query lies on an edge, and each of both triangles may ask for another vertex."""
    tins = []
    monkeypatch.setattr(module, "Tin", lambda *points: tins.append(Tin(*points)) or tins[-1])
    x, y = np.round(_scatter(1500, seed)[:2], 3)
    dry = (np.abs(x - 50.0) > 30.0) | (np.abs(y - 50.0) > 30.0)
    along, low = np.arange(20.5, 80.0), np.full(60, 20.0)
    x = np.concatenate((x[dry], along, along, low, low + 60.0))
    y = np.concatenate((y[dry], low, low + 60.0, along, along))
    at_x, at_y = (axis.ravel() for axis in np.meshgrid(*(np.arange(15.0, 86.0),) * 2))
    heights = Surface(Points(x, y, 3.0 + 0.2 * x - 0.1 * y)).heights(at_x, at_y)
    assert np.allclose(heights, 3.0 + 0.2 * at_x - 0.1 * at_y, atol=1e-6)
    assert len(tins) < 60


def test_a_plane_on_a_regular_grid_is_exact_to_its_border(small_blocks):
    x, y = (axis.ravel() for axis in np.meshgrid(np.arange(60.0), np.arange(50.0)))
    surface = Surface(Points(x, y, 3.0 + 0.2 * x - 0.1 * y))
    at_x, at_y = np.random.default_rng(1).uniform(0.0, 49.0, (2, 3000))
    at_x, at_y = np.append(at_x, x), np.append(at_y, y)
    assert np.allclose(surface.heights(at_x, at_y), 3.0 + 0.2 * at_x - 0.1 * at_y, atol=1e-9)


@pytest.mark.rest
@pytest.mark.parametrize("is_thinned", [False, True])
def test_slivers_along_a_border_that_is_straight_but_for_centimetres(monkeypatch, is_thinned):
    random = np.random.default_rng(4)
    x, y = np.round(random.uniform(0.0, (20.0, 400.0), (1500, 2)), 2).T
    x[:200] = np.round(random.uniform(0.0, 0.03, 200), 2)
    # Over a paraboloid, it does not matter which diagonal divides four vertices on a circle.
    z, meshed = x**2 + (y - 200.0) ** 2, None
    at_x, at_y = (
        np.round(random.uniform(0.0, 0.03, 400), 2),
        np.round(random.uniform(1.0, 399.0, 400), 2),
    )
    if is_thinned:
        meshed = random.random(1500) < 0.3
        meshed[hull_corners(x, y)] = True
    else:
        monkeypatch.setattr(module, "_VERTICES_A_BLOCK", 300)
    found = Surface(Points(x, y, z), meshed).heights(at_x, at_y)
    all_together = scipy.interpolate.LinearNDInterpolator(np.column_stack((x, y)), z)
    expected = all_together(at_x, at_y)
    inside = np.isfinite(expected)
    assert np.count_nonzero(inside) > 300
    np.testing.assert_allclose(found[inside], expected[inside], atol=1e-3)


def test_the_order_of_the_points_does_not_matter(small_blocks):
    points = CLOUDS["lake"]
    mixed = points.take(np.random.default_rng(3).permutation(points.count))
    x, y = np.random.default_rng(4).uniform(0.0, 100.0, (2, 500))
    one, other = Surface(points), Surface(mixed)
    assert np.array_equal(one.heights(x, y), other.heights(x, y), equal_nan=True)
    assert np.array_equal(one.nearest(x, y), other.nearest(x, y))


@pytest.mark.parametrize("turn", range(0, 360, 30))
def test_a_triangle_is_a_gap_whichever_of_its_edges_is_too_long(turn):
    angle = np.radians(turn)
    x, y = np.array([0.0, 6.0, 12.0, 6.0]), np.array([0.0, 1.0, 0.0, 0.5])  # the last is a query
    x, y = x * np.cos(angle) - y * np.sin(angle), x * np.sin(angle) + y * np.cos(angle)
    surface = Surface(Points(x[:3], y[:3], np.full(3, 5.0)))
    assert np.allclose(surface.heights(x[3:], y[3:], 12.1), 5.0)
    assert np.isnan(surface.heights(x[3:], y[3:], 11.9))


@pytest.mark.parametrize("count", [1, 2, 50])
def test_points_on_one_line_have_no_heights_but_a_nearest_point(count):
    line = np.arange(count, dtype=float)
    surface = Surface(Points(line, line, line))
    assert np.isnan(surface.heights(line, line + 0.5)).all()
    assert np.array_equal(surface.nearest(line, line), line)


def test_many_points_on_one_line_have_no_heights(small_blocks):
    line = np.arange(1000, dtype=float)
    surface = Surface(Points(line, 2 * line, line))
    assert np.isnan(surface.heights(line, line)).all()
