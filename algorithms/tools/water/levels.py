"""The level of water from the ground along its shore: one for a lake, a falling one for a river,
which is cut in two where it steps, at dams, weirs and locks.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ...grids.morphology import dilation, erosion
from .descent import descent
from .grid import regions_of
from .reaches import Reaches, reaches_of

_SHORE = 2  # cells round the water whose ground is its shore
_BEYOND = 6  # cells round it that show whether the land rises from it
MARGIN = _BEYOND + 1  # cells round a region that are needed
# Rows of cells farther out whose lowest ground is compared with that of a segment.
_ROWS = 2
# Height in metres of an embankment.
_EMBANKMENT = 0.5
_SEGMENT = 20.0  # length of the segments of a shore, m
_SEGMENT_CELLS = 8.0  # their least length, cells
_SEGMENTS = 12  # fewest of a small shore
# Share of the shore that is below its level: banks are higher.
_PERCENTILE = 10.0
# Metres by which the lowest ground of a segment is lower than the level, because of noise.
_NOISE = 0.1
# Standard deviations in the distance between the 10th and the 90th percentile.
_DEVIATIONS = 2.563
# Segments that lie together, whose median must be near the level too.
_TOGETHER = 7
_SURFACE = 0.5  # largest distance of returns of the surface from the level of the shore, m
FEW_RETURNS = 8  # fewest of these that decide the level
_MOST_RETURNS = 0.6  # and their least share of all returns inside
# Share of the reaches of each branch between the first and the last point of class 9 from which
# these show that all of it is level.
_SHOWN = 0.5
_FALL = 0.15  # least fall of a river, m
_ELONGATED = 3.0  # least length of a river, widths
# Largest spread of the shore of a river from a falling level, as a share of that from one level.
_BETTER = 0.8
STEP = 0.4  # least height of a step, m: more than noise and waves
_WITHIN = 3  # most reaches over which a step goes
# A step is at least this many times the fall of the water in as many reaches on either side of it.
_STEEPER = 4.0
_BESIDE = 4  # reaches that count on either side
_LEVEL_REACHES = 1  # fewest of these
# Metres that a drop counts less for each reach over which it goes: a short one is located better.
_BLURRED = 0.1
_GAP = 1.0  # distance of both parts from where the land says that the step is, cells
_BANK = 2.0  # width of the banks, cells
# A step goes straight across if its ends differ by fewer cells than this along the water, which
# single high cells of a bank explain.
_SLANTED = 8.0
# Cells this near to the other part are no shore: they may be its banks.
_HIDDEN = 4.0


class Shore(NamedTuple):
    """The shore of a region of water, or its surface, in segments."""

    # float64, (n, 2): row and column of the middle of segments that touch the water
    places: np.ndarray
    lowest: np.ndarray  # float64, (n,): their lowest ground, in which the bank hardly counts
    # float64, (n,): metres by which the lowest ground a few cells farther out, or an embankment, is
    # higher; NaN in other cells
    rises: np.ndarray
    heights: np.ndarray  # float64, (m,): the ground of all cells of the shore
    known: float  # share of the squares along the shore that have ground
    side: int  # length of the segments in cells
    percentile: float  # of the heights that is the level of a lake


class Levels(NamedTuple):
    """The level of a region of water."""

    heights: np.ndarray  # float64, (n,): at the reaches of a river; one for a lake
    spread: float  # robust standard deviation of lowest ground of segments from it, metres
    misfit: float  # largest distance from segments of the shore that lie together, metres
    width: float  # mean, in cells
    reaches: Reaches | None = None  # None for a lake
    # int64: reaches of each branch, downstream, where no level rises
    chains: tuple[np.ndarray, ...] = ()

    def level_at(self, places: np.ndarray) -> np.ndarray:
        """Return the level at rows and columns, shape (k, 2)."""
        if self.reaches is None:
            return np.full(len(places), self.heights[0])
        return self.reaches.between(self.heights, places)

    def lines(self) -> list[np.ndarray]:
        """Return row, column and level along the middle of each branch, downstream."""
        if self.reaches is None:
            return []
        along = np.column_stack((self.reaches.places, self.heights))
        return [along[chain] for chain in self.chains if len(chain) > 1]


def shore_of(
    water: np.ndarray, ground: np.ndarray, cell: float, hidden: np.ndarray
) -> Shore | None:
    """Return the shore of a region with a margin of `MARGIN` cells, without `hidden` cells such as
    abutments of bridges; None if no cell of it has ground.
    """
    # `ground` is infinite in cells without ground, and the side of a cell is in metres.
    from scipy.ndimage import distance_transform_cdt

    # 0 is a cell of the water at its edge: in sparse points the bank begins in it.
    away = distance_transform_cdt(~erosion(water, 1.0), metric="chessboard") - 1
    is_shore = (away >= 0) & (away <= _SHORE) & ~hidden
    has_ground = np.isfinite(ground) & ~hidden
    rows, columns = np.nonzero(is_shore & has_ground)
    if not len(rows):
        return None
    side = _side(water, cell)
    heights = ground[rows, columns].astype(np.float64)
    places, lowest, median = _segments(rows, columns, heights, side)
    outer = _beyond((away > _SHORE + 1) & (away <= _BEYOND) & has_ground, ground, places, side)
    # Land behind an embankment can be lower than the water.
    outer = np.where(median - lowest > _EMBANKMENT, np.fmax(outer, median), outer)
    squares = _squares(rows, columns, side)
    known = np.unique(squares)
    shore_rows, shore_columns = np.nonzero(is_shore)
    share = len(known) / len(np.unique(_squares(shore_rows, shore_columns, side)))
    # The lowest ground of a square without cells right at the water is that of the bank.
    near = np.isin(known, squares[away[rows, columns] <= 1])
    rises = (outer - lowest)[near]
    return Shore(places[near], lowest[near], rises, heights, share, side, _PERCENTILE)


def surface_of(water: np.ndarray, heights: np.ndarray, cell: float) -> Shore:
    """Return the surface of water as a shore, from the cells with points of water, their heights,
    and the side of a cell in metres.
    """
    rows, columns = np.nonzero(water & np.isfinite(heights))
    heights = heights[rows, columns].astype(np.float64)
    side = _side(water, cell)
    places, _, median = _segments(rows, columns, heights, side)
    return Shore(places, median, np.full(len(median), np.nan), heights, 1.0, side, 50.0)


def _side(water: np.ndarray, cell: float) -> int:
    """Return the length of a segment in cells."""
    length = max(_SEGMENT / cell, _SEGMENT_CELLS)
    return max(round(min(length, math.sqrt(water.sum()) * 4.0 / _SEGMENTS)), 3)


def _squares(rows: np.ndarray, columns: np.ndarray, side: int) -> np.ndarray:
    """Return a number for the square of each cell."""
    return (rows // side << 32) + columns // side


def _segments(
    rows: np.ndarray, columns: np.ndarray, heights: np.ndarray, side: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the middle, the lowest and the median height of the cells in each square."""
    _, group, counts = np.unique(
        _squares(rows, columns, side), return_inverse=True, return_counts=True
    )
    heights = heights[np.lexsort((heights, group))]
    starts = np.cumsum(counts) - counts
    places = np.column_stack([np.bincount(group, axis) / counts for axis in (rows, columns)])
    return places, heights[starts], heights[starts + counts // 2]


def _beyond(among: np.ndarray, ground: np.ndarray, places: np.ndarray, side: int) -> np.ndarray:
    """Return the lowest ground of the nearest cells of a mask; NaN where none is near."""
    from scipy.spatial import cKDTree

    cells = np.argwhere(among)
    if not len(cells):
        return np.full(len(places), np.nan)
    nearest = np.arange(1, min(_ROWS * side, len(cells)) + 1)
    _, near = cKDTree(cells).query(places, nearest, distance_upper_bound=side + _BEYOND)
    # A missing one has the number behind the last.
    lowest = np.append(ground[among], np.inf)[near].min(axis=1)
    return np.where(np.isfinite(lowest), lowest, np.nan)


def levels_of(
    water: np.ndarray, shore: Shore, surface: np.ndarray, most: float, points: np.ndarray
) -> Levels:
    """Return the level of a lake or of a river with a shore up to `most` metres from it; `surface`
    and `points`, (k, 3), are row, column and height of returns inside and of class 9.
    """
    # Banks are higher than the water, and all else can be a bridge or a boat: class 9 decides.
    is_sure = len(points) >= FEW_RETURNS
    surface = points if is_sure else surface
    flat = _lake_level(water, shore, surface, is_sure)
    river = _river_level(water, shore, surface, is_sure)
    if river is None or river.reaches is None:
        return flat
    is_long = river.reaches.length >= _ELONGATED * river.width
    fits = river.spread < _BETTER * flat.spread
    if is_sure and _is_shown_level(river, points):
        fits = False
    elif is_sure:
        off = [points[:, 2] - levels.level_at(points[:, :2]) for levels in (river, flat)]
        fits = spread_of(off[0]) < _BETTER * spread_of(off[1])
    elif not is_long:
        # A river that flows into a wide lake is a small part of the shore.
        fits = flat.misfit > most and river.misfit < flat.misfit / 2.0
    if fits and np.ptp(river.heights) >= _FALL:
        return river
    # A long region with one level is a river that hardly falls, or a long lake: both are flat.
    return flat._replace(width=river.width) if is_long else flat


def _is_shown_level(river: Levels, points: np.ndarray) -> bool:
    """Return whether points of the water along most of a river show that it does not fall."""
    seen = np.zeros(len(river.heights), dtype=bool)
    if river.reaches is not None:
        seen[river.reaches.of(points[:, :2])] = True
    if np.ptp(river.heights[seen]) >= _FALL:
        return False
    for chain in river.chains:
        # Upstream or downstream of these points there may still be a step, as at a weir.
        places = np.flatnonzero(seen[chain])
        if not len(places) or np.ptp(places) + 1 < _SHOWN * len(chain):
            return False
        if _steps(river.heights, chain):
            return False
    return True


def _lake_level(water: np.ndarray, shore: Shore, surface: np.ndarray, is_sure: bool) -> Levels:
    """Return one level: a low percentile of the ground along the shore, or that of the surface."""
    level = float(np.percentile(shore.heights, shore.percentile))
    level = min(level, float(np.median(shore.lowest)) + _NOISE)
    off = _off_surface(np.full(len(surface), level), surface[:, 2], is_sure)
    if off is not None:
        level += float(np.median(off[~np.isnan(off)]))
    spread, misfit = _fit(shore, np.full(len(shore.lowest), level))
    return Levels(np.array([level]), spread, misfit, math.sqrt(np.count_nonzero(water)))


def _river_level(
    water: np.ndarray, shore: Shore, surface: np.ndarray, is_sure: bool
) -> Levels | None:
    """Return levels that fall along a region and its branches, or None if it has no length."""
    # The level of a reach is that of the lowest ground of the segments of the shore beside it, by
    # isotonic regression along the branches, and of returns from the surface.
    reaches = reaches_of(water, shore.side)
    if reaches.network.size < 3:
        return None
    station, heights = reaches.of(shore.places), shore.lowest
    falling = descent(reaches.network, station, heights)
    off = _off_surface(reaches.between(falling.levels, surface[:, :2]), surface[:, 2], is_sure)
    if off is not None:
        # Banks are higher than the water: they count for the shape of the fall only.
        near = ~np.isnan(off)
        seen = reaches.of(surface[near, :2])
        beside = ~np.isin(station, seen) if is_sure else np.ones(len(station), dtype=bool)
        station = np.concatenate((station[beside], seen))
        heights = np.concatenate((heights[beside] + np.median(off[near]), surface[near, 2]))
        falling = descent(reaches.network, station, heights)
    spread, misfit = _fit(shore, reaches.between(falling.levels, shore.places))
    return Levels(falling.levels, spread, misfit, reaches.width, reaches, tuple(falling.chains))


def _off_surface(levels: np.ndarray, heights: np.ndarray, is_sure: bool) -> np.ndarray | None:
    """Return how far returns of the surface lie above levels, NaN for others; None for too few."""
    off = heights - levels
    if is_sure:
        return off
    near = np.abs(off) <= _SURFACE
    if near.sum() < max(FEW_RETURNS, _MOST_RETURNS * np.count_nonzero(~np.isnan(off))):
        return None
    return np.where(near, off, np.nan)


def _fit(shore: Shore, levels: np.ndarray) -> tuple[float, float]:
    """Return the spread of segments of a shore round levels, and the largest local misfit."""
    from scipy.spatial import cKDTree

    off = shore.lowest - levels
    nearest = np.arange(1, min(_TOGETHER, len(off)) + 1)
    near = cKDTree(shore.places).query(shore.places, nearest)[1]
    together = np.median(off[near], axis=1) - np.median(off)
    return spread_of(off), float(np.abs(together).max())


def spread_of(values: np.ndarray) -> float:
    """Return a robust standard deviation, from the 10th and the 90th percentile."""
    low, high = np.percentile(values, (10.0, 90.0))
    return float(high - low) / _DEVIATIONS


class _LevelDrop(NamedTuple):
    """A step of the level, from the first to the last of some reaches."""

    sharpness: float  # the drop, less for each reach
    before: np.ndarray  # the reaches upstream, with those at the step
    after: np.ndarray  # the reaches downstream, with those at the step
    middle: float  # height


def parts_of_step(
    water: np.ndarray, levels: Levels, ground: np.ndarray
) -> list[tuple[np.ndarray, np.ndarray]]:
    """Return the parts of a river above and below its highest step, as their cells and the cells
    off their shore: none without a step, one if water flows round it.
    """
    # `ground` is infinite in cells without ground.
    reaches = levels.reaches
    steps = [step for chain in levels.chains for step in _steps(levels.heights, chain)]
    if reaches is None or not steps:
        return []
    gap = _gap(water, reaches, max(steps, key=lambda step: step.sharpness), ground)
    # Only side by side: a corner is no passage for a gap that is one cell wide.
    parts = [part for _, part in regions_of(water & ~gap)]
    if len(parts) < 2:
        return [(water, np.zeros_like(water))]
    return [(part, dilation(water & ~part, _HIDDEN)) for part in parts]


def _steps(levels: np.ndarray, chain: np.ndarray) -> list[_LevelDrop]:
    """Return all steps of a chain of reaches."""
    heights, count, steps = levels[chain], len(chain), []
    for first in range(_LEVEL_REACHES, count - _LEVEL_REACHES):
        for last in range(first + 1, min(first + _WITHIN, count - _LEVEL_REACHES - 1) + 1):
            drop, length = float(heights[first] - heights[last]), last - first
            usual = max(_slope(heights[first::-1]), _slope(heights[last:])) * length
            if drop >= max(STEP, _STEEPER * usual):
                before, after = chain[max(first - 2, 0) : first + 1], chain[last : last + 3]
                middle = float(heights[first] + heights[last]) / 2.0
                steps.append(_LevelDrop(drop - _BLURRED * length, before, after, middle))
    return steps


def _slope(heights: np.ndarray) -> float:
    """Return how far the level changes beside a step at most, for each reach."""
    changes = np.abs(heights[1 : _BESIDE + 1] - heights[0])
    return float((changes / np.arange(1, len(changes) + 1)).max())


def _gap(water: np.ndarray, reaches: Reaches, step: _LevelDrop, ground: np.ndarray) -> np.ndarray:
    """Return the cells across a region at a step."""
    # No land beside the upper water is lower than the middle of the step. So it begins where the
    # first such land is, on either bank.
    last, first = step.before[-1], step.after[0]
    near = np.isin(np.arange(reaches.network.size), (last, first))
    for _ in range(_WITHIN - 1):
        near |= reaches.network.matrix() @ near.astype(float) > 0
    cells = np.argwhere(water)
    numbers = reaches.of(cells)
    # Where the water is narrow, the direction in which it flows is sure.
    sizes = np.bincount(numbers, minlength=len(near))
    pairs = [pair for side in (step.before, step.after) for pair in zip(side[:-1], side[1:])]
    start, end = reaches.places[list(min(pairs, key=lambda pair: sizes[list(pair)].sum()))]
    down = (end - start) / max(float(np.hypot(*(end - start))), 1e-9)
    turned = np.array((-down[1], down[0]))
    middle = (reaches.places[last] + reaches.places[first]) / 2.0
    land = np.argwhere(
        dilation(water, _BANK) & ~water & np.isfinite(ground) & (ground < step.middle)
    )
    land = land[near[reaches.of(land)]] - middle
    cells = cells[near[numbers]]
    along, across = (cells - middle) @ down, (cells - middle) @ turned
    # Where the low land of each bank begins, along and across; a single cell does not count.
    firsts = []
    for bank in (land[land @ turned <= 0], land[land @ turned > 0]):
        if len(bank) > 1:
            place = bank[np.argsort(bank @ down)[1]]
            firsts.append((float(place @ down) - 1.0, float(place @ turned)))
    cut = np.zeros(len(cells))
    if firsts:
        begins, beside = np.array(sorted(firsts, key=lambda first: first[1])).T
        if np.ptp(begins) < _SLANTED:
            begins[:] = begins.min()
        cut = np.interp(across, beside, begins)
    gap = np.zeros(water.shape, dtype=bool)
    gap[tuple(cells[np.abs(along - cut) <= _GAP].T)] = True
    return gap
