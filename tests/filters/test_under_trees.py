"""The ground under trees: seen through gaps of a canopy, or hidden by plants that are level."""

import numpy as np
import pytest
from realdata import real

from bare_earth import Progress
from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.filters.height_grid import HeightGrid
from bare_earth.algorithms.filters.stages.breaks import LevelSeeds, Plants
from bare_earth.algorithms.filters.stages.opening import ProgressiveOpening
from bare_earth.algorithms.filters.stages.outliers import NarrowPits, UnderCanopy
from bare_earth.algorithms.filters.stages.seeds import Woods, openness
from bare_earth.algorithms.filters.stages.shrubs import Shrubs
from bare_earth.algorithms.filters.state import GridState, State
from bare_earth.algorithms.grids.cells import Cells
from benchmarks import data
from benchmarks.measure import Filter, ReferenceModel


def seen_through_gaps(rough, side=60.0, density=6.0, seed=0):
    """Return points on a canopy 20 m above ground, 1 % of them below it, and which these are."""
    random = np.random.default_rng(seed)
    count = int(density * side**2)
    x, y = random.uniform(0.0, side, (2, count))
    ground = random.random(count) < 0.01
    canopy = 20.0 + rough * random.uniform(-1.0, 1.0, count)
    return Points(x, y, 100.0 + 0.3 * x + np.where(ground, 0.0, canopy)), ground


def pits_of(points):
    cells = Cells.over(points, 1.0)
    heights = HeightGrid(cells.minimum(points.z), 1.0, cells.first)
    # As where hardly any other pit is as low.
    rule = NarrowPits(corroborated=None, under_canopy=None)
    return rule.find(heights, points, cells), cells


def test_pits_in_a_rough_canopy_are_ground():
    points, ground = seen_through_gaps(rough=12.0, density=1.5)
    pits, cells = pits_of(points)
    stays = pits & UnderCanopy().of_ground(pits, points, cells)
    of_ground = cells.holding(ground)
    assert (pits & of_ground).sum() > 10 and stays[pits & of_ground].mean() > 0.8


def test_pits_in_an_even_surface_are_outliers_however_deep():
    points, _ = seen_through_gaps(rough=0.1)
    pits, cells = pits_of(points)
    assert pits.sum() > 50
    assert not UnderCanopy().of_ground(pits, points, cells).any()


def test_nothing_is_spared_where_there_is_no_pit():
    points, _ = seen_through_gaps(rough=0.1)
    cells = Cells.over(points, 1.0)
    assert not UnderCanopy().of_ground(np.zeros(cells.shape, dtype=bool), points, cells).any()


@pytest.mark.parametrize("slope", [0.1, 2.0])
def test_openness_is_one_on_open_ground_and_low_under_trees(slope):
    random = np.random.default_rng(1)
    x, y = random.uniform(0.0, 60.0, (2, 40_000))
    wood = x > 30.0
    z = 5.0 + slope * x + np.where(wood & (random.random(len(x)) < 0.7), 8.0, 0.0)
    points = Points(x, y, z)

    def share(points):
        cells = Cells.over(points, 1.0)
        rise = np.full(cells.shape, slope * cells.size)
        return openness(points, cells, cells.lowest_points(points), rise)

    assert share(points)[:, 4:26].min() > 0.99 and share(points)[:, 34:56].max() < 0.5
    assert share(points.take(slice(None, None, 50)))[:, :26].min() > 0.95


@pytest.mark.parametrize(("thick", "joins"), [(False, True), (True, False)])
def test_points_join_at_a_break_only_where_it_is_open(thick, joins):
    # A terrace whose edge the seeds leave out; with crowns above it, its points are plants.
    random = np.random.default_rng(2)
    x, y = random.uniform(0.0, 40.0, (2, 8000))
    z = np.where(x < 20.0, 10.0, 12.0)
    crown = np.full(len(x), thick) & (random.random(len(x)) < 0.6)
    points = Points(x, y, z + np.where(crown, 9.0, 0.0))
    cells = Cells.over(points, 1.0)
    lowest = cells.lowest_points(points)
    edge = (points.x[lowest] > 20.0) & (points.x[lowest] < 22.0) & ~crown[lowest]
    seeds, candidates = lowest[~edge & ~crown[lowest]], lowest[edge]
    state = State(points, Progress(), seeds=seeds, candidates=candidates)
    state.grids = [GridState.of(points, 1.0, 1.0)]
    for rule in (Plants(), LevelSeeds()):
        rule.apply(state)
    assert np.isin(candidates, state.seeds).mean() == pytest.approx(float(joins), abs=0.1)


def wood(count=20_000, side=60.0):
    """Return points of which those in the east are of pulses that trees split, and which."""
    random = np.random.default_rng(6)
    x, y = random.uniform(0.0, side, (2, count))
    in_wood = x > side / 2.0
    of_several = in_wood & (random.random(count) < 0.5)
    crown = in_wood & (random.random(count) < 0.6)
    shrub = in_wood & ~crown & (random.random(count) < 0.3)
    z = 50.0 + 0.2 * x + random.normal(0.0, 0.02, count)
    z += np.where(crown, 12.0, 0.0) + np.where(shrub, random.uniform(0.2, 0.6, count), 0.0)
    return Points(x, y, z), of_several, shrub


def test_split_pulses_tell_woods():
    points, of_several, _ = wood()
    state = State(points, Progress(), multi_return=of_several)
    state.grids = [GridState.of(points, 0.5, 1.0)]
    Woods().apply(state)
    woods = state.grids[0].woods
    assert woods[:, 34:].all() and not woods[:, :26].any()
    state.multi_return = None
    state.grids = [GridState.of(points, 0.5, 1.0)]
    Woods().apply(state)
    assert not state.grids[0].woods.any()


@pytest.mark.rest(but="tin-densification")
@pytest.mark.parametrize("method", METHODS)
def test_shrubs_in_woods_are_less_often_ground_where_returns_are_known(method):
    points, of_several, shrub = wood()
    parameters = METHODS[method].parameters()
    known = METHODS[method].ground(points, parameters, multi_return=of_several).ground
    unknown = METHODS[method].ground(points, parameters).ground
    assert known[shrub].mean() < 0.7 * unknown[shrub].mean()
    open_land = points.x < 25.0
    assert np.array_equal(known[open_land], unknown[open_land])


@pytest.mark.parametrize(("is_wood", "is_kept"), [(True, True), (False, False)])
def test_windows_in_woods_are_no_larger_than_crowns(is_wood, is_kept):
    # A ridge with a crest of 24 m, and the same without trees.
    columns = np.indices((120, 120))[1] - 60.0
    heights = 20.0 * np.clip((30.0 - np.abs(columns)) / 18.0, 0.0, 1.0)
    grid = GridState.of(*_on_cells(heights))
    grid.woods[:] = is_wood
    ProgressiveOpening(50.0).apply(grid)
    assert (~grid.raised)[20:-20, 58:63].all() == is_kept


def _on_cells(heights):
    """Return points in the middles of cells of 1 m, their spacing, and the size of the cells."""
    rows, columns = np.indices(heights.shape) + 0.5
    return Points(columns.ravel(), rows.ravel(), heights.ravel().copy()), 1.0, 1.0


@pytest.mark.rest
@pytest.mark.parametrize(
    ("tile", "most"),
    [
        ("rainforest_ridge.laz", 1.2),
        pytest.param("conifer_1.laz", 0.17, marks=pytest.mark.long),
        pytest.param("megaplot.laz", 0.11, marks=pytest.mark.long),
    ],
)
def test_terrain_models_of_forests_come_out_as_measured(tile, most):
    cloud, reference = data.load(real(f"real/{tile}"))
    model = ReferenceModel(cloud, reference)
    assert model.error(Filter("tin-densification").ground(cloud)).rmse < most


def hillside(shrub, slope=0.3, side=60.0):
    """Return the state of points a metre apart on a slope, all seeds, and which are on a shrub."""
    random = np.random.default_rng(3)
    x, y = random.uniform(0.0, side, (2, int(side**2)))
    z = slope * x + random.normal(0.0, 0.03, len(x))
    points = Points(x, y, z + shrub(x, y))
    state = State(points, Progress(), seeds=np.arange(len(x)))
    state.grids = [GridState.of(points, 1.0, 1.0)]
    return state, shrub(x, y) > 0.0


def mound(x, y):
    return np.where(np.hypot(x - 30.0, y - 30.0) < 2.5, 1.5, 0.0)


def test_a_shrub_wider_than_the_nearest_seeds_is_no_ground():
    state, of_shrub = hillside(mound)
    Plants().apply(state)
    assert np.isin(np.flatnonzero(of_shrub), state.seeds).mean() > 0.3
    Shrubs().apply(state)
    left = np.isin(np.arange(len(of_shrub)), state.seeds)
    assert left[of_shrub].mean() < 0.2 and left[~of_shrub].mean() > 0.99
    assert np.array_equal(np.sort(np.append(state.seeds, state.candidates)), np.arange(len(left)))


@pytest.mark.parametrize("slope", [0.0, 0.5])
def test_a_long_ridge_stays(slope):
    # Narrower than blocks, so that the lowest seeds of all blocks lie beside it.
    def ridge(x, y):
        return np.clip(1.2 - 0.6 * np.abs(y - 0.4 * x - 15.0), 0.0, None)

    state, of_ridge = hillside(ridge, slope)
    Shrubs().apply(state)
    assert np.isin(np.flatnonzero(of_ridge), state.seeds).mean() > 0.9
    state.seeds = np.arange(len(of_ridge))
    Shrubs(longest=np.inf).apply(state)
    assert np.isin(np.flatnonzero(of_ridge), state.seeds).mean() < 0.8


@pytest.mark.parametrize("slope", [0.0, 0.5, 1.5])
def test_a_dyke_is_no_shrub(slope):
    state, of_dyke = hillside(lambda x, y: np.clip(1.5 - 0.5 * np.abs(y - 30.0), 0.0, None), slope)
    for rule in (Shrubs(), LevelSeeds()):
        rule.apply(state)
    assert np.isin(np.flatnonzero(of_dyke), state.seeds).mean() > 0.95


def test_under_trees_lower_shrubs_are_no_ground():
    state, of_shrub = hillside(lambda x, y: 0.25 * (mound(x, y) > 0.0), slope=0.1)
    kept = []
    for wood in (False, True):
        state.seeds = np.arange(len(of_shrub))
        state.grids[0].woods[:] = wood
        Shrubs().apply(state)
        kept.append(np.isin(np.flatnonzero(of_shrub), state.seeds).mean())
    assert kept[0] > 0.9 and kept[1] < 0.75


@pytest.mark.parametrize(
    ("height", "wood", "stays"), [(1.5, False, False), (9.0, False, True), (9.0, True, False)]
)
def test_a_lone_seed_above_those_round_a_gap_is_ground_only_if_it_is_a_rock(height, wood, stays):
    x, y, z = hillside(lambda x, y: 0.0 * x, slope=0.1)[0].points
    away = np.hypot(x - 30.0, y - 30.0) > 10.0
    lone = 30.0, 30.0, 3.0 + height
    points = Points(*(np.append(of[away], at) for of, at in zip((x, y, z), lone)))
    state = State(points, Progress(), seeds=np.arange(points.count))
    state.grids = [GridState.of(points, 1.0, 1.0)]
    state.grids[0].woods[:] = wood
    Plants().apply(state)
    assert points.count - 1 in state.seeds
    Shrubs().apply(state)
    assert (points.count - 1 in state.seeds) == stays


def test_shrubs_can_stay_where_it_is_open():
    state, of_shrub = hillside(mound)
    Shrubs(most_open=0.3).apply(state)
    assert len(state.seeds) == len(of_shrub) and not len(state.candidates)
    Shrubs(most_open=0.99).apply(state)
    assert np.isin(np.flatnonzero(of_shrub), state.seeds).mean() < 0.2


@pytest.mark.rest
def test_shrubs_are_not_looked_for_where_seeds_are_far_apart():
    # Blocks of a few metres over as much land would be refused for want of memory.
    random = np.random.default_rng(7)
    x, y = random.uniform(0.0, 80_000.0, (2, 300))
    points = Points(x, y, 0.01 * x)
    state = State(points, Progress(), seeds=np.arange(points.count))
    state.grids = [GridState.of(points, 100.0, 100.0)]
    Shrubs().apply(state)
    assert len(state.seeds) == points.count
