"""Which cells of a grid of lowest points are taken for ground."""

import numpy as np
import pytest

from bare_earth import Progress
from bare_earth.algorithms.filters.height_grid import HeightGrid
from bare_earth.algorithms.filters.stages.opening import ProgressiveOpening
from bare_earth.algorithms.filters.stages.terrain import GentleBorder, GentleRegions
from bare_earth.algorithms.filters.state import GridState
from bare_earth.algorithms.grids.cells import Cells

NOTHING = np.zeros(0, dtype=np.intp)


def grid_of(heights, size=1.0, objects=None, plateaus=None):
    """Return the state of a grid of which only heights and objects are known."""
    rows, columns = heights.shape
    none = np.zeros(heights.shape, dtype=bool)
    raised = none if objects is None else objects
    return GridState(
        None, 1.0, Cells(size, 0, 0, rows, columns, NOTHING), 0.0, NOTHING,
        HeightGrid(heights, size), none, raised.copy(), raised,
        none if plateaus is None else plateaus,
    )  # fmt: skip


def ground_of(grid, window=20.0, opening=None, regions=None):
    """Return the cells that openings and the rules of regions take for ground."""
    rules = (
        opening or ProgressiveOpening(window),
        regions or GentleRegions(),
    )
    for rule in rules:
        rule.apply(grid, Progress())
    return grid.is_ground


def _ground(heights, objects=None, window=20.0, **changes):
    return ground_of(grid_of(heights, objects=objects), window, regions=GentleRegions(**changes))


def test_a_slope_is_ground_and_a_house_on_it_is_not():
    heights = np.tile(0.5 * np.arange(100.0), (90, 1))
    heights[40:52, 45:60] = heights[46, 45] + 9.0
    ground = _ground(heights)
    assert not ground[40:52, 45:60].any()
    assert ground[:, 70:].all()
    assert ground[60:].all()


def test_a_platform_with_walls_on_three_sides_and_a_ramp_on_the_fourth_is_ground():
    rows, columns = np.indices((120, 120))
    ramp = 2.4 * np.clip((74 - rows) / 14.0, 0.0, 1.0)
    heights = np.where((rows >= 50) & (np.abs(columns - 60) < 15), ramp, 0.0)
    assert _ground(heights, gentle_border=GentleBorder(least_area=0.0)).all()
    assert not _ground(heights, gentle_border=GentleBorder(shares=(1.1, 1.1))).all()


@pytest.mark.parametrize("width, is_ground", [(12.0, False), (30.0, True)])
def test_the_wider_a_plateau_the_less_of_its_border_a_ramp_has_to_be(width, is_ground):
    rows, columns = np.indices((160, 160)) - 80.0
    plateau = (np.abs(rows) < width / 2) & (np.abs(columns) < width / 2)
    ramp = 4.0 * np.clip((width / 2 + 14 - rows) / 14.0, 0.0, 1.0)
    ramp[(np.abs(columns) > 0.4 * width) | (rows < 0)] = 0.0
    heights = np.where(plateau, 4.0, ramp)
    assert _ground(heights, window=60.0)[plateau].all() == is_ground


def test_a_building_in_a_corner_of_the_survey_is_not_ground():
    rows, columns = np.indices((120, 120))
    roof = (rows < 40) & (columns < 40)
    found = _ground(12.0 * roof, window=60.0)
    assert not found[roof].any() and found[~roof].all()


def test_beyond_the_survey_a_roof_goes_on_where_gaps_are_judged():
    heights = np.zeros((40, 70))
    heights[13:27, 26:40] = 6.0
    heights[:, 40:] = np.nan
    # A window of 6 m cuts off the corners of what is 14 m wide, but not where it goes on.
    corners = [13, 26], [39, 39]
    assert _ground(heights, window=6.0)[corners].all()
    opening = ProgressiveOpening(6.0, level_beyond=False)
    found = ground_of(grid_of(heights), opening=opening, regions=GentleRegions(judges_gaps=False))
    assert not found[corners].any()


def test_a_rock_with_walls_all_round_is_ground_and_buildings_as_high_are_not():
    rows, columns = np.indices((60, 60)) - 30.0
    inside = np.hypot(rows, columns) < 12.0
    rock = np.where(inside, 28.0 + columns, 0.0)
    assert _ground(rock, inside).all()
    assert not _ground(rock, inside, rocks=None)[inside].any()
    # Two roofs one above the other, joined by what fills a gap between them.
    stairs = np.interp(columns, (-2.0, 2.0), (8.0, 24.0))
    assert not _ground(np.where(inside, stairs, 0.0), inside)[inside].any()


def test_a_dam_is_ground_where_cells_are_wide_and_some_of_its_sides_empty():
    rows, columns = np.indices((60, 60)) - 30.0
    dam = np.clip(11.0 - 1.7 * np.abs(columns), 0.0, 6.0)
    dam[np.abs(columns) == 4 + rows % 3] = np.nan
    ground = ground_of(grid_of(dam, 2.4), 60.0)
    assert ground[np.isfinite(dam)].all()


@pytest.mark.parametrize("has_points, is_terrain", [(True, True), (False, False)])
def test_what_fills_a_gap_round_a_roof_joins_it_with_no_ground(has_points, is_terrain):
    rows, columns = np.indices((60, 60)) - 30.0
    farthest = np.maximum(np.abs(rows), np.abs(columns))
    roof = farthest < 11
    filled = 3.0 * np.clip((16.0 - farthest) / 6.0, 0.0, 1.0)
    known = roof | (farthest >= 16) | has_points
    grid = grid_of(np.where(known, filled, np.nan), 2.0)
    grid.filled, grid.surface = filled.astype(np.float32), np.zeros(filled.shape)
    grid.surveyed, grid.raised = np.ones(known.shape, dtype=bool), filled > 0.6
    GentleRegions().apply(grid)
    assert (~grid.raised)[roof].all() == is_terrain and (~grid.raised)[roof].any() == is_terrain


def test_a_plateau_goes_as_a_whole_where_a_window_cuts_off_part_of_it():
    heights = np.tile(0.08 * np.arange(160.0), (160, 1))
    roof = np.zeros(heights.shape, dtype=bool)
    roof[40:120, 40:120] = True
    heights[roof] = 0.08 * 120 + 1.5
    with_plateau = ground_of(grid_of(heights, plateaus=roof), 75.0)
    without = ground_of(grid_of(heights), 75.0)
    assert without[roof].any()
    assert not with_plateau[roof].any()
    assert with_plateau[~roof].mean() > 0.99


def test_a_spur_is_ground_and_a_hall_on_a_gentle_slope_is_not():
    rows, columns = np.indices((160, 160)) - 80.0
    spur = 0.7 * (columns - 0.5 * np.abs(rows))
    uncut = _ground(spur, window=75.0, area=1e9, rocks=None)
    assert uncut[20:-20, 20:-20].mean() > 0.99
    opening = ProgressiveOpening(75.0, hall_per_slope=0.0)
    regions = GentleRegions(area=1e9, rocks=None)
    cut = ground_of(grid_of(spur), opening=opening, regions=regions)
    assert cut[20:-20, 20:-20].mean() < 0.9
    heights = 0.08 * columns
    hall = (np.abs(rows) < 35) & (np.abs(columns) < 35)
    heights[hall] = 8.0
    assert not _ground(heights, window=75.0)[hall].any()


def test_known_objects_and_empty_cells_are_never_ground():
    heights = np.zeros((40, 40))
    heights[3, 4] = np.nan
    objects = np.zeros((40, 40), dtype=bool)
    objects[10:12, 10:12] = True
    heights[objects] = 6.0
    ground = _ground(heights, objects)
    assert not ground[3, 4]
    assert not ground[objects].any()


def test_low_bumps_are_ground_on_a_slope_and_not_in_the_plain():
    bumps = np.zeros((60, 60))
    bumps[20:24, 20:24] = bumps[40:43, 30:34] = 0.45
    slope = np.tile(0.6 * np.arange(60.0), (60, 1))
    assert not _ground(bumps)[bumps > 0].any()
    assert _ground(slope + bumps)[bumps > 0].mean() > 0.5


def test_a_grid_of_one_row_is_classified():
    assert _ground(np.zeros((1, 30))).all()
