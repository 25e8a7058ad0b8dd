"""Cells, filling of gaps, opening and low outliers."""

import numpy as np
import pytest
from scipy import ndimage

from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.core.threads import may_use
from bare_earth.algorithms.filters.height_grid import HeightGrid
from bare_earth.algorithms.filters.stages.outliers import NarrowPits
from bare_earth.algorithms.filters.trend import between_blocks
from bare_earth.algorithms.grids import cells as cells_module
from bare_earth.algorithms.grids import morphology
from bare_earth.algorithms.grids.cells import Cells, lower_at, spacing
from bare_earth.algorithms.grids.inpaint import inpaint
from bare_earth.algorithms.grids.morphology import (
    erosion,
    in_steps,
    median_of_nine,
    opening,
    within_square,
)
from bare_earth.algorithms.grids.parts import apart


def _points(count=500, seed=0):
    random = np.random.default_rng(seed)
    return Points(*random.uniform(-20.0, 30.0, (2, count)), random.normal(size=count))


def test_the_minimum_of_each_cell_and_its_point_agree_with_a_loop():
    points = _points()
    cells = Cells.over(points, 2.5)
    expected = {}
    for x, y, z in zip(*points):
        cell = int(np.floor(y / 2.5)) - cells.first_row, int(np.floor(x / 2.5)) - cells.first_column
        expected[cell] = min(expected.get(cell, np.inf), z)
    minimum = cells.minimum(points.z)
    assert {tuple(cell): minimum[tuple(cell)] for cell in np.argwhere(cells.occupied)} == expected
    lowest = cells.lowest_points(points)
    assert sorted(points.z[lowest]) == sorted(expected.values())


@pytest.mark.parametrize("rounds", [0, 1, 100])
@pytest.mark.parametrize("part", [7, 10_000])
def test_the_least_of_many_values_stays_at_each_place(monkeypatch, rounds, part):
    monkeypatch.setattr(cells_module, "_ROUNDS", rounds)
    monkeypatch.setattr(cells_module, "_VALUES_A_PART", part)
    random = np.random.default_rng(4)
    index, values = random.integers(0, 40, 3000), random.integers(-9, 9, 3000) / 4.0
    target = np.where(np.arange(50) % 2, np.inf, -1.5)
    expected = [min([target[at], *values[index == at]]) for at in range(50)]
    lower_at(target, index, values)
    assert np.array_equal(target, expected)


def test_points_are_counted_and_found_by_their_cells(monkeypatch):
    monkeypatch.setattr(cells_module, "_POINTS_A_PART", 7)
    monkeypatch.setattr(cells_module, "_POINTS_A_COUNT", 11)
    random = np.random.default_rng(5)
    points = Points(*random.uniform(0.0, 6.0, (3, 100)))
    cells, chosen = Cells.over(points, 2.0), random.random(100) < 0.3
    marked = np.zeros(cells.shape, dtype=bool)
    marked[1, ::2] = True
    inside = marked.ravel()[cells.index]
    assert np.array_equal(cells.points_in(marked), np.flatnonzero(inside))
    assert np.array_equal(cells.counts.ravel(), np.bincount(cells.index))
    assert cells.counts_of(chosen)[marked].sum() == np.count_nonzero(chosen & inside)


def test_of_points_equally_low_the_choice_does_not_depend_on_their_order():
    points = Points(np.array([0.7, 0.2, 0.5]), np.array([0.1, 0.9, 0.3]), np.zeros(3))
    back = points.take(np.array([2, 1, 0]))
    for cloud in (points, back):
        chosen = Cells.over(cloud, 1.0).lowest_points(cloud)
        assert cloud.x[chosen] == 0.2


def test_of_points_equally_low_those_with_the_smallest_x_then_y_are_chosen():
    random = np.random.default_rng(3)
    x, y = random.integers(0, 30, (2, 4000)) / 10.0  # several at one place
    points = Points(x, y, random.integers(0, 3, 4000) / 10.0)
    cells = Cells.over(points, 1.0)
    first = {}
    for place in np.lexsort((points.y, points.x, points.z)):
        first.setdefault(cells.index[place], place)
    chosen, expected = (
        points.take(places) for places in (cells.lowest_points(points), list(first.values()))
    )
    assert sorted(zip(*chosen)) == sorted(zip(*expected))


@pytest.mark.parametrize("size", [2.0, 2.5, 3.0])
def test_wider_cells_are_those_over_the_points(size):
    points = _points()
    wider, expected = Cells.over(points, 0.5).wider(points, size), Cells.over(points, size)
    assert (wider.shape, wider.first, wider.size) == (expected.shape, expected.first, size)
    assert np.array_equal(wider.index, expected.index)
    assert np.array_equal(wider.counts, expected.counts)
    other = Cells.over(points, 0.7).wider(points, size)
    assert np.array_equal(other.index, expected.index)


def test_a_grid_is_interpolated_exactly_where_it_is_a_plane():
    points = _points()
    cells = Cells.over(points, 1.0)
    rows, columns = np.indices(cells.shape)
    plane = 2.0 * (columns + cells.first_column + 0.5) - (rows + cells.first_row + 0.5)
    x, y = np.array([0.3, 5.7]), np.array([1.9, -3.2])
    assert np.allclose(cells.interpolated(plane, x, y), 2.0 * x - y)


@pytest.mark.parametrize("radius", [1, 1.5, 2, 3, 4.5, 7, 12])
def test_the_opening_agrees_with_that_of_scipy(radius):
    grid = np.random.default_rng(1).normal(size=(37, 52))
    reach = np.arange(-int(radius), int(radius) + 1)
    disc = reach[:, None] ** 2 + reach**2 <= radius**2
    eroded = ndimage.grey_erosion(grid, footprint=disc, mode="nearest")
    assert np.array_equal(erosion(grid, radius), eroded)
    inside = (slice(int(radius), -int(radius)),) * 2
    opened = ndimage.grey_opening(np.pad(grid, int(radius), mode="edge"), footprint=disc)
    assert np.array_equal(opening(grid, radius)[inside], opened[inside][inside])


@pytest.mark.parametrize("shape", [(1, 1), (1, 9), (9, 1), (37, 52)])
@pytest.mark.parametrize("reach", [1, 2, 3, 6, 7])
def test_the_extreme_within_a_square_agrees_with_that_of_scipy(shape, reach):
    grid = np.random.default_rng(1).normal(size=shape)
    side = 2 * reach + 1
    lowest = ndimage.minimum_filter(grid, side, mode="nearest")
    assert np.array_equal(within_square(np.minimum, grid, reach), lowest)
    spread = ndimage.maximum_filter((grid > 1.5).astype(np.uint8), side, mode="constant")
    assert np.array_equal(within_square(np.maximum, grid > 1.5, reach), spread)


@pytest.mark.parametrize("shape", [(1, 1), (1, 5), (2, 2), (30, 40)])
def test_the_median_of_nine_is_that_of_a_slower_filter(shape):
    grid = np.random.default_rng(3).integers(0, 9, shape).astype(np.float32)
    assert np.array_equal(median_of_nine(grid), ndimage.median_filter(grid, 3, mode="nearest"))


def test_strips_and_threads_do_not_change_the_extremes(monkeypatch):
    grid = np.random.default_rng(1).normal(size=(90, 40))
    expected = opening(grid, 4), within_square(np.maximum, grid, 3)
    monkeypatch.setattr(morphology, "_CELLS_A_STRIP", 500)
    with may_use(2):
        assert np.array_equal(opening(grid, 4), expected[0])
        assert np.array_equal(within_square(np.maximum, grid, 3), expected[1])


def test_a_radius_whole_but_for_rounding_is_whole():
    grid = np.random.default_rng(1).normal(size=(30, 30))
    assert np.array_equal(erosion(grid, 9.0 - 1e-12), erosion(grid, 9))


def test_the_opening_leaves_a_slope_as_it_is_up_to_its_borders():
    plane = np.tile(0.7 * np.arange(50), (40, 1))
    assert np.allclose(opening(plane, 9), plane)


def test_filled_gaps_lie_between_their_borders_and_follow_a_plane():
    rows, columns = np.indices((60, 70))
    plane = 0.3 * columns - 0.2 * rows
    holed = plane.copy()
    holed[20:40, 25:45] = np.nan
    filled = inpaint(holed)
    known = np.isfinite(holed)
    assert np.array_equal(filled[known], plane[known])
    assert np.abs(filled - plane).max() < 0.5
    assert filled.min() >= plane.min()
    assert filled.max() <= plane.max()


@pytest.mark.parametrize("shape", [(1, 1), (1, 7), (3, 2), (17, 33)])
def test_a_single_known_cell_fills_any_grid(shape):
    grid = np.full(shape, np.nan)
    grid[0, -1] = 4.0
    assert np.allclose(inpaint(grid), 4.0)
    assert not inpaint(np.full(shape, np.nan)).any()


def test_a_pit_is_an_outlier_and_a_ditch_is_not():
    grid = np.zeros((30, 30))
    grid[10, 10] = -8.0
    grid[20] = -3.0
    found = NarrowPits(under_canopy=None).find(HeightGrid(grid, 1.0), None, None)
    assert np.argwhere(found).tolist() == [[10, 10]]


# The same wherever the grid begins


@pytest.mark.parametrize(("south", "west"), [(1, 0), (2, 3), (5, 8), (7, 1)])
@pytest.mark.parametrize("share", [0.05, 0.6])
def test_gaps_are_filled_alike_wherever_the_grid_begins(south, west, share):
    random = np.random.default_rng(4)
    grid = random.normal(300.0, 2.0, (96, 96))
    grid[:32, :32] = np.where(random.random((32, 32)) < share, np.nan, grid[:32, :32])
    grid[8:14, 9:13] = np.nan
    whole = inpaint(grid, first=(-64, 4096))
    part = inpaint(grid[south:, west:], first=(-64 + south, 4096 + west))
    # Not so near the border that it matters.
    assert np.array_equal(part[32 - south :, 32 - west :], whole[32:, 32:])
    different = np.abs(part - whole[south:, west:])[40 - south - 24 : 32, 40 - west - 24 : 32]
    assert different.max() < 1e-4
    assert not np.array_equal(inpaint(grid[1:], first=(0, 0)), whole[1:])


def test_gaps_of_a_large_grid_are_filled_as_those_of_a_small_one():
    random = np.random.default_rng(1)
    grid = np.where(random.random((500, 400)) < 0.5, random.normal(100.0, 3.0, (500, 400)), np.nan)
    part = slice(100, 300), slice(100, 300)
    assert np.array_equal(
        inpaint(grid)[150:250, 150:250], inpaint(grid[part], first=(100, 100))[50:150, 50:150]
    )


def test_heights_beside_land_do_not_depend_on_the_void_beyond():
    random = np.random.default_rng(2)
    grid = np.full((900, 900), np.nan)
    grid[300:420, 250:400] = random.normal(100.0, 3.0, (120, 150))
    grid[350:370, 300:340] = np.nan
    near = slice(295, 425), slice(245, 405)
    smaller = inpaint(grid[100:700, 100:700], first=(100, 100))
    assert np.allclose(inpaint(grid)[near], smaller[195:325, 145:305], atol=1e-4)


def test_the_smallest_grids_are_filled_wherever_they_begin():
    grid = np.array([[1.0, np.nan], [np.nan, np.nan]])
    for row in (-1, 0, 2**20 - 1):
        assert np.allclose(inpaint(grid, first=(row, -1)), 1.0)
        assert np.allclose(inpaint(grid[:, :1], first=(row, -1)), 1.0)


def test_heights_become_the_same_steps_whatever_the_other_heights():
    heights = np.round(np.random.default_rng(2).uniform(40.0, 90.0, (20, 30)), 3)
    steps, step = in_steps(heights)
    for other in (20.0, 130.0, 95.004):
        more, same = in_steps(np.append(heights, np.full((1, 30), other), axis=0))
        assert same == step == 0.01
        # They may begin elsewhere, all of them together.
        assert len(np.unique(more[:-1].astype(int) - steps)) == 1


@pytest.mark.parametrize("high", [400.0, 3000.0])
def test_heights_far_apart_are_steps_that_fit(high):
    heights = np.linspace(-100.0, high, 5000).reshape(50, 100)
    steps, step = in_steps(heights)
    assert step <= 0.01 * max(1.0, 2.0 * (high + 100.0) / 500.0)
    rises = np.diff(steps.ravel().astype(int)) * step
    assert np.allclose(rises, np.diff(heights.ravel()), atol=1.01 * step)


def test_the_spacing_of_a_survey_is_that_of_any_part_of_it():
    x, y = np.random.default_rng(5).uniform(0.0, 400.0, (2, 40_000))
    points = Points(x, y, x)
    assert spacing(points) == 2.0
    far = Points(*(np.append(values, 900.0) for values in points))
    for part in (points.take(x < 200), points.take((x < 90) | (x > 300)), far):
        assert spacing(part) == 2.0
    assert spacing(points, dense=2.5) == 2.5
    assert spacing(Points(x / 8, y / 8, x)) == 1.0


def test_cells_that_begin_elsewhere_are_those_of_moved_points():
    x, y = np.random.default_rng(5).uniform(-20.0, 20.0, (2, 200))
    shifted = Cells.over(Points(x, y, x), 2.0, shift=1.0)
    moved = Cells.over(Points(x + 1.0, y + 1.0, x), 2.0)
    assert (shifted.first, shifted.shape) == (moved.first, moved.shape)
    assert np.array_equal(shifted.index, moved.index)


def test_points_with_a_gap_between_them_are_apart():
    x, y = np.random.default_rng(6).uniform(0.0, 60.0, (2, 500))
    for gap, count in ((99.0, 1), (126.0, 2), (3000.0, 2)):
        both = Points(np.r_[x, x + 60.0 + gap], np.r_[y, y], np.r_[x, x])
        groups, found = apart(both, 100.0)
        assert found == count
        if count == 2:
            assert len(set(groups[:500])) == len(set(groups[500:])) == 1
            assert groups[0] != groups[-1] and {groups[0], groups[-1]} == {0, 1}


def test_values_of_blocks_are_interpolated_alike_in_a_stack():
    stack = np.random.default_rng(3).normal(size=(5, 3, 4))
    rows, columns = np.arange(30), np.arange(40)
    found = between_blocks(stack, 10, rows, columns)
    assert found.shape == (5, 30, 40)
    assert np.array_equal(found, [between_blocks(layer, 10, rows, columns) for layer in stack])
    place = ((np.arange(3) + 0.5) * 10 - 0.5, (np.arange(4) + 0.5) * 10 - 0.5)
    plane = 2.0 * place[0][:, None] - place[1]
    inner = between_blocks(plane, 10, np.arange(5, 25), np.arange(5, 35))
    assert np.allclose(inner, 2.0 * np.arange(5, 25)[:, None] - np.arange(5, 35))
