"""Raised objects and their rims on grids with known truth."""

import numpy as np
import pytest

from bare_earth.algorithms.filters.height_grid import HeightGrid
from bare_earth.algorithms.filters.stages.height_steps import HeightSteps
from bare_earth.algorithms.filters.stages.objects import RaisedObjects
from bare_earth.algorithms.filters.state import covered
from bare_earth.algorithms.filters.trend import Trend, between_blocks

# Low drops are not searched, nor what they bound.
PLATEAU_HEIGHT = np.inf


def plain(side: int = 60, slope: float = 0.0) -> np.ndarray:
    """Return a grid of 1 m cells that rises towards the east, with a little unevenness."""
    noise = np.random.default_rng(3).normal(0.0, 0.02, (side, side))
    return 100.0 + slope * np.arange(side) + noise


def steps(heights: np.ndarray) -> HeightSteps:
    return HeightSteps(HeightGrid(heights, 1.0), covered(np.isfinite(heights)))


def raised_objects(heights, size, thresholds, max_size, **values):
    """Return the objects on a grid; plateaus only of the drops given."""
    rule = RaisedObjects(max_size, thresholds, **{"plateau_height": PLATEAU_HEIGHT, **values})
    return rule.find(HeightGrid(heights, size))


@pytest.mark.parametrize("slope", [0.0, 0.5])
def test_a_roof_inside_its_walls_is_an_object_and_nothing_else_is(slope):
    heights = plain(slope=slope)
    roof = np.zeros(heights.shape, dtype=bool)
    roof[20:32, 25:45] = True
    heights[roof] = heights[roof].mean() + 8.0
    assert np.array_equal(raised_objects(heights, 1.0, (5.0, 4.5, 2.0), 40.0).raised, roof)


def test_a_house_with_a_tower_goes_as_a_whole():
    heights = plain()
    heights[20:32, 25:45] += 6.0
    heights[24:28, 30:34] += 9.0
    objects = raised_objects(heights, 1.0, (5.0, 2.0), 40.0).raised
    assert objects.sum() == 12 * 20


def test_a_hill_without_a_rim_is_kept():
    east, north = np.meshgrid(np.arange(60) - 30.0, np.arange(60) - 30.0)
    heights = plain() + 15.0 * np.exp(-(east**2 + north**2) / 200.0)
    assert not raised_objects(heights, 1.0, (5.0, 2.0), 60.0).raised.any()


def test_a_terrace_is_kept_because_it_drops_on_one_side_only():
    heights = plain()
    heights[:, 30:] += 6.0
    assert not raised_objects(heights, 1.0, (5.0, 2.0), 60.0).raised.any()


def test_what_is_wider_than_the_largest_size_is_terrain():
    heights = plain()
    heights[15:45, 15:45] += 8.0
    assert raised_objects(heights, 1.0, (5.0,), 40.0).raised.sum() == 900
    assert not raised_objects(heights, 1.0, (5.0,), 20.0).raised.any()


def test_a_tower_is_an_object():
    east, north = np.meshgrid(np.arange(60) - 30.0, np.arange(60) - 30.0)
    out = np.hypot(east, north)
    tower = plain() + 20.0 * (out < 12.0)
    assert np.array_equal(raised_objects(tower, 1.0, (5.0, 2.0), 60.0).raised, out < 12.0)


@pytest.mark.parametrize(
    ("sides", "rough", "is_object"),
    [(0.1, 0.0, True), (0.1, 0.2, True), (4.0, 0.0, True), (4.0, 0.2, False)],
)
def test_a_wide_rough_region_whose_sides_are_no_walls_is_a_table_mountain(sides, rough, is_object):
    east, north = np.meshgrid(np.arange(60) - 30.0, np.arange(60) - 30.0)
    out = np.hypot(east, north)
    heights = plain() + 13.0 * np.clip((22.0 - out) / sides, 0.0, 1.0)
    heights += np.random.default_rng(5).normal(0.0, rough, heights.shape)
    found = raised_objects(heights, 1.0, (5.0, 2.0), 60.0, plateau_height=1.2)
    assert ((found.raised | found.plateaus)[out < 18.0] == is_object).all()


def test_what_is_low_for_its_width_is_a_plateau():
    heights = plain()
    heights[15:45, 15:45] += 3.0
    objects = raised_objects(heights, 1.0, (5.0, 2.0), 40.0)
    assert not objects.raised.any()
    assert objects.plateaus.sum() == 900


def test_what_lies_beyond_the_survey_is_no_drop():
    heights = plain()
    heights[20:40, :10] += 8.0
    heights[:, :2] = np.nan
    objects = raised_objects(heights, 1.0, (5.0,), 40.0).raised
    assert np.array_equal(np.argwhere(objects).min(axis=0), (20, 2))
    assert objects.sum() == 20 * 8


def test_gaps_in_the_grid_do_not_break_a_rim():
    heights = plain()
    roof = np.zeros(heights.shape, dtype=bool)
    roof[20:32, 25:45] = True
    heights[roof] += 8.0
    heights[np.random.default_rng(4).random(heights.shape) < 0.2] = np.nan
    objects = raised_objects(heights, 1.0, (5.0, 2.0), 40.0).raised
    known = np.isfinite(heights)
    assert not objects[~roof & known].any()
    assert objects[roof & known].mean() > 0.95
    # Gaps within the roof belong to it, so that a finer grid finds no ground there.
    assert objects[26, 30:40].all()


def test_a_pit_is_sunken_and_a_channel_that_leads_out_is_not():
    heights = plain()
    heights[10:14, 10:14] -= 9.0
    heights[30:34, :40] -= 9.0
    heights[30:34, 40:] -= np.linspace(9.0, 0.0, 20)
    pits = steps(heights).regions(2.0).sunken(10.0)
    assert pits[10:14, 10:14].all()
    assert pits.sum() == 16


def test_touching_candidates_are_one_pit_however_uneven():
    heights = plain()
    depths = np.random.default_rng(5).uniform(5.0, 20.0, (4, 4))
    heights[10:14, 10:14] -= depths
    heights[40:, 40:] -= 9.0
    pits = steps(heights).pits(heights < 97.0, 2.0, 10.0)
    assert pits[10:14, 10:14].all()
    assert pits.sum() == 16


def test_a_rim_is_the_higher_of_two_cells_that_differ_by_more_than_slope_and_threshold():
    heights = plain(slope=0.5)
    heights[:, 30:] += 2.0
    rims = steps(heights).regions_and_rims(1.0, 1.0)[1]
    assert np.array_equal(np.flatnonzero(rims.all(axis=0)), [30])
    assert rims.sum() == 60
    assert not steps(heights).regions_and_rims(3.0, 1.0)[1].any()


def test_cells_level_with_the_ground_grow_back_and_others_do_not():
    heights = plain()
    heights[20:24, 20:24] += 1.5
    kept = np.ones(heights.shape, dtype=bool)
    kept[18:26, 18:26] = False
    grown = steps(np.where(kept, heights, np.nan)).regrown(kept, heights, 0.3)
    assert np.array_equal(np.argwhere(~grown), np.argwhere(heights > 101.0))


def test_level_cells_grow_back_four_cells_far_on_any_side_of_a_slope():
    heights = plain(slope=1.0)
    inside = np.zeros(heights.shape, dtype=bool)
    inside[10:50, 10:50] = True
    grown = steps(np.where(inside, np.nan, heights)).regrown(~inside, heights, 0.3)
    inside[14:46, 14:46] = False
    assert grown[inside].all()
    assert np.count_nonzero(~grown) == 32 * 32


@pytest.mark.parametrize("side", ["last row", "last column"])
@pytest.mark.parametrize("rise, is_level", [(2.35, True), (2.39, False)])
def test_the_last_cells_are_judged_by_the_slope_of_the_terrain_there(rise, is_level, side):
    # It becomes steeper row by row; by the slope of the row before, 2.32 m would be too much.
    heights = np.tile(0.025 * np.arange(52.0)[:, None] ** 2, (1, 40))
    kept = np.ones(heights.shape, dtype=bool)
    heights[-1] += rise
    kept[-1] = False
    if side == "last column":
        heights, kept = heights.T, kept.T
    grown = steps(np.where(kept, heights, np.nan)).regrown(kept, heights, 0.3)
    assert (grown[~kept] == is_level).all()


def test_cells_finer_than_a_metre_find_the_same_object():
    heights = plain(120)
    heights[40:64, 50:90] += 8.0
    heights[39, 50:90] += 4.0  # hits half-way up a wall
    objects = raised_objects(heights, 0.5, (5.0, 2.0), 40.0).raised
    assert objects[40:64, 50:90].all()
    assert objects.sum() <= 25 * 40


def test_only_small_gaps_count_as_covered():
    known = np.zeros((40, 40), dtype=bool)
    known[5:35, 5:35] = True
    known[18:21, 18:21] = False
    assert covered(known)[18:21, 18:21].all()
    assert covered(known).sum() == 900


def test_values_of_blocks_are_interpolated_between_their_middles():
    cells = between_blocks(np.array([[0.0, 10.0], [0.0, 10.0]]), 5, np.arange(10), np.arange(10))
    assert cells[0, 2] == 0.0 and cells[9, 7] == 10.0
    assert np.allclose(cells[:, 4], 4.0)


def test_the_trend_is_the_same_at_single_cells_and_over_rows():
    heights = plain(70, slope=0.3).astype(np.float32)
    heights[20:30, 20:30] += 8.0
    trend = Trend(heights, 1.0)
    row, column = np.divmod(np.arange(heights.size), heights.shape[1])
    for whole, single in zip(trend.of_rows(0, 70), trend.of_cells(row, column)):
        assert np.array_equal(whole.ravel(), single)
    rises = trend.of_rows(0, 70)
    assert np.allclose(rises.east, 0.3, atol=0.02) and np.allclose(rises.north, 0.0, atol=0.02)
    along = trend.along(row, column, 1, -1)
    assert np.allclose(along, rises.north.ravel() - rises.east.ravel())


def test_the_trend_of_a_place_does_not_depend_on_where_the_grid_begins():
    random = np.random.default_rng(3)
    heights = (plain(120, slope=0.3) + random.normal(0, 0.3, (120, 120))).astype(np.float32)
    whole = Trend(heights, 1.0, (-31, 77))
    part = Trend(heights[11:, 8:], 1.0, (-31 + 11, 77 + 8))
    # Three blocks from the new border: the medians of their neighbours matter.
    for one, other in zip(whole.of_rows(60, 120), part.of_rows(60 - 11, 120 - 11)):
        assert np.array_equal(one[:, 60:], other[:, 60 - 8 :])
    row, column = (axis.ravel() for axis in np.mgrid[60:119, 60:119])
    expected = whole.along(row, column, 1, 1)
    assert np.array_equal(part.along(row - 11, column - 8, 1, 1), expected)
    unanchored = Trend(heights[11:, 8:], 1.0).of_rows(49, 109)
    assert not np.array_equal(unanchored.east[:, 52:], whole.of_rows(60, 120).east[:, 60:])


@pytest.mark.parametrize("shape", [(1, 1), (1, 7), (7, 1), (2, 2)])
def test_the_smallest_grids_have_no_objects(shape):
    assert not raised_objects(np.zeros(shape), 1.0, (5.0,), 40.0).raised.any()
