"""The level of water from the ground along its shore: one for a lake, a falling one for a river."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ...grids.descent import descent
from ...grids.morphology import erosion
from .reaches import Reaches, reaches_of

# Cells round the water whose ground is its shore, and cells farther out that show whether the land
# rises from it.
_SHORE, _BEYOND = 2, 6
# Rows of cells farther out whose lowest ground is compared with that of a segment.
_ROWS = 2
# Height in metres of an embankment.
_EMBANKMENT = 0.5
# Length of the segments of a shore in metres, and least in cells; fewest segments of a small shore.
_SEGMENT, _SEGMENT_CELLS, _SEGMENTS = 20.0, 8.0, 12
# Share of the shore that is below its level: banks are higher.
LEVEL_PERCENTILE = 10.0
# The lowest ground of a segment is so much lower than the level, in metres, because of noise.
_NOISE = 0.1
# Standard deviations in the distance between the 10th and the 90th percentile.
_DEVIATIONS = 2.563
# Segments that lie together, whose median must be near the level too.
_TOGETHER = 7
# Returns from the surface lie at most so far from the level of the shore, in metres. At least so
# many decide the level, and so large a share of all returns inside.
_SURFACE, _FEW_RETURNS, _MOST_RETURNS = 0.5, 8, 0.6


class Shore(NamedTuple):
    """The shore of a region of water, or its surface, in segments."""

    # float64, (n, 2): row and column of the middle of segments that touch the water
    places: np.ndarray
    lowest: np.ndarray  # float64, (n,): their lowest ground, in which the bank hardly counts
    # float64, (n,): metres by which the lowest ground a few cells farther out, or an embankment, is
    # higher; NaN where there is none
    rises: np.ndarray
    heights: np.ndarray  # float64, (m,): the ground of all cells of the shore
    known: float  # share of the squares along the shore that have ground
    side: int  # length of the segments in cells
    percentile: float = LEVEL_PERCENTILE  # of the heights that is the level of a lake


class Levels(NamedTuple):
    """The level of a region of water."""

    heights: np.ndarray  # float64, (n,): at the reaches of a river; one for a lake
    spread: float  # robust standard deviation of lowest ground of segments from it, metres
    misfit: float  # largest distance from segments of the shore that lie together, metres
    width: float  # mean, in cells
    length: float = 0.0  # along the middle, in cells
    reaches: Reaches | None = None  # None for a lake
    # int64: reaches of each branch, downstream, where no level rises
    chains: tuple[np.ndarray, ...] = ()

    def at(self, places: np.ndarray) -> np.ndarray:
        """Return the level at rows and columns, shape (k, 2)."""
        if self.reaches is None:
            return np.full(len(places), self.heights[0])
        return self.reaches.between(self.heights, places)

    @property
    def lines(self) -> list[np.ndarray]:
        """Row, column and level along the middle of each branch, downstream."""
        if self.reaches is None:
            return []
        along = np.column_stack((self.reaches.places, self.heights))
        return [along[chain] for chain in self.chains if len(chain) > 1]


def shore_of(
    water: np.ndarray, ground: np.ndarray, cell: float, hidden: np.ndarray | None = None
) -> Shore | None:
    """Return the shore of a region with a margin of `margin` cells round it, but for `hidden` cells
    such as abutments of bridges; None if no cell of it has ground.
    """
    # `ground` is infinite where there is none, and the side of a cell is in metres.
    from scipy.ndimage import distance_transform_cdt

    # 0 is a cell of the water at its edge: in sparse points the bank begins in it.
    away = distance_transform_cdt(~erosion(water, 1.0), metric="chessboard") - 1
    is_shore = (away >= 0) & (away <= _SHORE)
    has_ground = np.isfinite(ground)
    if hidden is not None:
        is_shore &= ~hidden
        has_ground &= ~hidden
    rows, columns = np.nonzero(is_shore & has_ground)
    if not len(rows):
        return None
    side = _side(water, cell)
    heights = ground[rows, columns].astype(np.float64)
    places, lowest, median = _segments(rows, columns, heights, side)
    outer = _beyond((away > _SHORE + 1) & (away <= _BEYOND) & has_ground, ground, places, side)
    # Land behind an embankment can be lower than the water.
    outer = np.where(median - lowest > _EMBANKMENT, np.fmax(outer, median), outer)
    rises = outer - lowest
    squares = _squares(rows, columns, side)
    known = np.unique(squares)
    shore_row, shore_column = np.nonzero(is_shore)
    share = len(known) / len(np.unique(_squares(shore_row, shore_column, side)))
    # The lowest ground of a square without cells right at the water is that of the bank.
    near = np.isin(known, squares[away[rows, columns] <= 1])
    return Shore(places[near], lowest[near], rises[near], heights, share, side)


def surface_of(water: np.ndarray, heights: np.ndarray, cell: float) -> Shore:
    """Return what is known of the level from points of water, as a shore, from the cells with such
    points, their heights, and the side of a cell in metres.
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
    names, group = np.unique(_squares(rows, columns, side), return_inverse=True)
    order = np.lexsort((heights, group))
    starts = np.searchsorted(group[order], np.arange(len(names)))
    counts = np.bincount(group)
    places = np.column_stack([np.bincount(group, each) / counts for each in (rows, columns)])
    return places, heights[order][starts], heights[order][starts + counts // 2]


def margin() -> int:
    """Return how many cells round a region are needed."""
    return _BEYOND + 1


def _beyond(which: np.ndarray, ground: np.ndarray, places: np.ndarray, side: int) -> np.ndarray:
    """Return the lowest ground of the nearest cells among some; NaN where none is near."""
    from scipy.spatial import cKDTree

    rows, columns = np.nonzero(which)
    found = np.full(len(places), np.nan)
    if len(rows):
        count = min(_ROWS * side, len(rows))
        far, near = cKDTree(np.column_stack((rows, columns))).query(
            places, list(range(1, count + 1)), distance_upper_bound=side + _BEYOND
        )
        heights = ground[rows, columns][np.minimum(near, len(rows) - 1)]
        lowest = np.where(np.isfinite(far), heights, np.inf).min(axis=1)
        found = np.where(np.isfinite(lowest), lowest, np.nan)
    return found


def lake_level(water: np.ndarray, shore: Shore, surface: np.ndarray) -> Levels:
    """Return one level: a low percentile of the ground along the shore, or that of the surface,
    row, column and height of returns inside, shape (k, 3).
    """
    level = float(np.percentile(shore.heights, shore.percentile))
    level = min(level, float(np.median(shore.lowest)) + _NOISE)
    off = _off_surface(np.full(len(surface), level), surface[:, 2])
    if off is not None:
        level += float(np.median(off[~np.isnan(off)]))
    spread, misfit = _fit(shore, np.full(len(shore.lowest), level))
    return Levels(np.array([level]), spread, misfit, math.sqrt(np.count_nonzero(water)))


def river_level(water: np.ndarray, shore: Shore, surface: np.ndarray) -> Levels | None:
    """Return levels that fall along a region and its branches, or None if it has no length."""
    # The level of a reach is that of the lowest ground of the segments of the shore beside it, by
    # isotonic regression along the branches, and of returns from the surface.
    reaches = reaches_of(water, shore.side)
    if reaches.network.size < 3:
        return None
    station, heights = reaches.of(shore.places), shore.lowest
    found = descent(reaches.network, station, heights)
    off = _off_surface(reaches.between(found.levels, surface[:, :2]), surface[:, 2])
    if off is not None:
        # Banks are higher than the water: they count for the shape of the fall only.
        near = ~np.isnan(off)
        station = np.concatenate((station, reaches.of(surface[near, :2])))
        heights = np.concatenate((heights + np.median(off[near]), surface[near, 2]))
        found = descent(reaches.network, station, heights)
    spread, misfit = _fit(shore, reaches.between(found.levels, shore.places))
    return Levels(
        found.levels, spread, misfit, reaches.width, reaches.length, reaches, tuple(found.chains)
    )


def _off_surface(levels: np.ndarray, heights: np.ndarray) -> np.ndarray | None:
    """Return how far returns lie above levels: NaN if not from the surface, None if too few are."""
    off = heights - levels
    near = np.abs(off) <= _SURFACE
    if near.sum() < max(_FEW_RETURNS, _MOST_RETURNS * np.count_nonzero(~np.isnan(off))):
        return None
    return np.where(near, off, np.nan)


def _fit(shore: Shore, levels: np.ndarray) -> tuple[float, float]:
    """Return the spread of segments of a shore round levels, and the largest local misfit."""
    from scipy.spatial import cKDTree

    off = shore.lowest - levels
    count = min(_TOGETHER, len(off))
    near = cKDTree(shore.places).query(shore.places, list(range(1, count + 1)))[1]
    together = np.median(off[near], axis=1) - np.median(off)
    return spread_of(off), float(np.abs(together).max())


def spread_of(values: np.ndarray) -> float:
    """Return a robust standard deviation, from the 10th and the 90th percentile."""
    low, high = np.percentile(values, (10.0, 90.0))
    return float(high - low) / _DEVIATIONS
