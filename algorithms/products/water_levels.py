"""The level of water from the ground along its shore: one for a lake, a falling one for a river."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

# Cells round the water whose ground is its shore, and cells farther out that show whether the land
# rises from it.
_SHORE, _BEYOND = 2, 6
# Length of the segments of a shore in metres, and least in cells; fewest segments of a small shore.
_SEGMENT, _SEGMENT_CELLS, _SEGMENTS = 20.0, 8.0, 12
# Share of the shore that is below its level: banks are higher.
LEVEL_PERCENTILE = 10.0
# Most cells in which the way along a river is searched.
_MOST_CELLS = 40_000
# Stations that are left out from each end of a long line; four are as long as half the width.
_ENDS = 3
# Standard deviations in the distance between the 10th and the 90th percentile.
_DEVIATIONS = 2.563


class Shore(NamedTuple):
    """The shore of a region of water, or its surface, in segments.

    Attributes
    ----------
    places : numpy.ndarray of float64, shape (n, 2)
        Row and column of the middle of each segment that touches the water.
    lowest : numpy.ndarray of float64, shape (n,)
        Its lowest ground: the bank hardly counts in it.
    rises : numpy.ndarray of float64, shape (k,)
        How far the ground a few cells farther out is higher than the shore, in metres, for all
        segments, also those of the bank alone; NaN where there is none.
    heights : numpy.ndarray of float64, shape (m,)
        The ground of all cells of the shore.
    known : float
        Share of the cells of the shore that have ground.
    percentile : float
        The level of a lake is this percentile of the heights.
    """

    places: np.ndarray
    lowest: np.ndarray
    rises: np.ndarray
    heights: np.ndarray
    known: float
    percentile: float = LEVEL_PERCENTILE


class Levels(NamedTuple):
    """The level of a region of water.

    Attributes
    ----------
    line : numpy.ndarray of float64, shape (n, 2)
        Row and column of stations down a river; one place for a lake.
    heights : numpy.ndarray of float64, shape (n,)
        The level at the stations, which never rises.
    spread : float
        Robust standard deviation in metres of the lowest ground of segments of the shore from it.
    width, length : float
        Mean width, and length along the middle, in cells.
    """

    line: np.ndarray
    heights: np.ndarray
    spread: float
    width: float
    length: float

    def at(self, places: np.ndarray) -> np.ndarray:
        """Return the level at rows and columns, shape (k, 2)."""
        from scipy.spatial import cKDTree

        if len(self.heights) == 1:
            return np.full(len(places), self.heights[0])
        distance, nearest = cKDTree(self.line).query(places, min(2, len(self.line)))
        weight = 1.0 / np.maximum(distance, 1e-6)
        return (self.heights[nearest] * weight).sum(axis=1) / weight.sum(axis=1)


def shore_of(
    water: np.ndarray, ground: np.ndarray, cell: float, hidden: np.ndarray | None = None
) -> Shore | None:
    """Return the shore of a region.

    Parameters
    ----------
    water : numpy.ndarray of bool, shape (rows, columns)
        The cells of the region, with a margin of `margin` cells round them.
    ground : numpy.ndarray of float, shape (rows, columns)
        Lowest ground of each cell; infinite where there is none.
    cell : float
        Side of a cell in metres.
    hidden : numpy.ndarray of bool, shape (rows, columns), optional
        Cells that are not part of the shore, such as abutments of bridges.

    Returns
    -------
    Shore or None
        None if no cell of the shore has ground.
    """
    from scipy.ndimage import distance_transform_cdt

    away = distance_transform_cdt(~water, metric="chessboard")
    is_shore = (away > 0) & (away <= _SHORE)
    has_ground = np.isfinite(ground)
    if hidden is not None:
        is_shore &= ~hidden
        has_ground &= ~hidden
    rows, columns = np.nonzero(is_shore & has_ground)
    if not len(rows):
        return None
    side = _side(water, cell)
    heights = ground[rows, columns].astype(np.float64)
    places, _, median = _segments(rows, columns, heights, side)
    outer = _beyond((away > _SHORE + 1) & (away <= _BEYOND) & has_ground, ground, places, side)
    # The lowest ground of a square without cells right at the water is that of the bank.
    squares = _squares(rows, columns, side)
    beside = np.isin(squares, squares[away[rows, columns] == 1])
    places, lowest, _ = _segments(rows[beside], columns[beside], heights[beside], side)
    known = len(rows) / int(is_shore.sum())
    return Shore(places, lowest, outer - median, heights, known)


def surface_of(water: np.ndarray, heights: np.ndarray, cell: float) -> Shore:
    """Return what is known of the level from points of water, as a shore.

    Parameters
    ----------
    water : numpy.ndarray of bool, shape (rows, columns)
        The cells with such points.
    heights : numpy.ndarray of float, shape (rows, columns)
        Their heights.
    cell : float
        Side of a cell in metres.
    """
    rows, columns = np.nonzero(water & np.isfinite(heights))
    heights = heights[rows, columns].astype(np.float64)
    places, _, median = _segments(rows, columns, heights, _side(water, cell))
    return Shore(places, median, np.full(len(median), np.nan), heights, 1.0, 50.0)


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
    """Return the median ground of the nearest cells among some; NaN where none is near."""
    from scipy.spatial import cKDTree

    rows, columns = np.nonzero(which)
    found = np.full(len(places), np.nan)
    if len(rows):
        count = min(side, len(rows))
        far, near = cKDTree(np.column_stack((rows, columns))).query(
            places, list(range(1, count + 1)), distance_upper_bound=side + _BEYOND
        )
        heights = ground[rows, columns][np.minimum(near, len(rows) - 1)]
        heights = np.where(np.isfinite(far), heights, np.nan)
        some = np.isfinite(far).any(axis=1)
        found[some] = np.nanmedian(heights[some], axis=1)
    return found


def lake_level(water: np.ndarray, shore: Shore) -> Levels:
    """Return one level: a low percentile of the ground along the shore, or that of the surface."""
    level = float(np.percentile(shore.heights, shore.percentile))
    middle = np.argwhere(water).mean(axis=0)[None]
    return Levels(middle, np.array([level]), _spread(shore.lowest), math.sqrt(water.sum()), 0.0)


def river_level(water: np.ndarray, shore: Shore) -> Levels | None:
    """Return levels that fall along the middle of a region, or None if it has no length.

    The level at a station is that of the lowest ground of the segments of the shore beside it, by
    isotonic regression along the line.
    """
    line = middle_line(water)
    if len(line) < 3:
        return None
    from scipy.spatial import cKDTree

    length = float(np.hypot(*np.diff(line, axis=0).T).sum())
    # The ends of the way run into corners. They count for the length, not for the direction.
    line = line[_ENDS:-_ENDS] if len(line) > 5 * _ENDS else line
    station = cKDTree(line).query(shore.places)[1]
    order = np.argsort(station, kind="stable")
    values = shore.lowest[order]
    both = [sign * isotonic(sign * values) for sign in (-1.0, 1.0)]
    fitted = min(both, key=lambda each: float(np.abs(each - values).sum()))
    spread = _spread(values - fitted)
    at, where = np.unique(station[order], return_index=True)
    heights = np.interp(np.arange(len(line)), at, fitted[where])
    if heights[0] < heights[-1]:
        line, heights = line[::-1], heights[::-1]
    return Levels(line, heights, spread, water.sum() / max(length, 1.0), length)


def isotonic(values: np.ndarray) -> np.ndarray:
    """Return the non-decreasing values with the least squared distance, shape (n,).

    Neighbours that violate the order are pooled (Ayer et al. 1955).

    >>> isotonic(np.array([1.0, 3.0, 2.0, 4.0])).tolist()
    [1.0, 2.5, 2.5, 4.0]
    """
    pools: list[tuple[float, int]] = []
    for value in np.asarray(values, dtype=np.float64).tolist():
        mean, count = value, 1
        while pools and pools[-1][0] > mean:
            before, more = pools.pop()
            mean = (mean * count + before * more) / (count + more)
            count += more
        pools.append((mean, count))
    means, counts = zip(*pools) if pools else ((), ())
    return np.repeat(np.array(means, dtype=np.float64), np.array(counts, dtype=np.int64))


def middle_line(water: np.ndarray) -> np.ndarray:
    """Return the longest way through a region along its middle: its skeleton without branches.

    Parameters
    ----------
    water : numpy.ndarray of bool, shape (rows, columns)
        A connected region.

    Returns
    -------
    numpy.ndarray of float64, shape (n, 2)
        Row and column of places along the way.
    """
    from scipy.ndimage import distance_transform_edt

    group = max(1, math.ceil(math.sqrt(water.sum() / _MOST_CELLS)))
    rows, columns = (-(-side // group) * group for side in water.shape)
    cells = np.pad(water, ((0, rows - water.shape[0]), (0, columns - water.shape[1])))
    cells = cells.reshape(rows // group, group, columns // group, group).max(axis=(1, 3))
    deep = distance_transform_edt(np.pad(cells, 1))[1:-1, 1:-1]
    # A way along the middle is cheap.
    cost = (deep.max() / np.maximum(deep, 1.0)) ** 2
    plain, costly = _graph(cells, np.ones(cells.shape)), _graph(cells, cost)
    places = np.argwhere(cells)
    start = _farthest(plain, 0)
    end = _farthest(plain, start)
    way = _way(costly, start, end)
    line = (places[way] + 0.5) * group - 0.5
    step = max(1, round(float(deep.max()) / 2.0))
    return _smoothed(line, step)[::step]


def _graph(cells: np.ndarray, cost: np.ndarray) -> Any:
    """Return the graph of neighbouring cells, weighted by distance and mean cost."""
    from scipy.sparse import coo_matrix

    number = np.full(cells.shape, -1)
    number[cells] = np.arange(int(cells.sum()))
    starts, ends, weights = [], [], []
    for down, right in ((0, 1), (1, 0), (1, 1), (1, -1)):
        left = max(-right, 0)
        one = (slice(0, cells.shape[0] - down), slice(left, cells.shape[1] - max(right, 0)))
        other = (slice(down, None), slice(left + right, cells.shape[1] - left))
        both = np.logical_and(cells[one], cells[other])
        starts.append(number[one][both])
        ends.append(number[other][both])
        weights.append((cost[one] + cost[other])[both] / 2.0 * math.hypot(down, right))
    size = int(cells.sum())
    edges = np.concatenate(starts), np.concatenate(ends)
    return coo_matrix((np.concatenate(weights), edges), shape=(size, size)).tocsr()


def _farthest(graph: Any, start: int) -> int:
    from scipy.sparse.csgraph import dijkstra

    far = dijkstra(graph, directed=False, indices=start)
    return int(np.argmax(np.where(np.isfinite(far), far, -1.0)))


def _way(graph: Any, start: int, end: int) -> list[int]:
    """Return the nodes of the cheapest way."""
    from scipy.sparse.csgraph import dijkstra

    before = dijkstra(graph, directed=False, indices=start, return_predecessors=True)[1]
    way = [end]
    while way[-1] != start and before[way[-1]] >= 0:
        way.append(int(before[way[-1]]))
    return way[::-1]


def _smoothed(line: np.ndarray, half: int) -> np.ndarray:
    """Return the running mean of a line; its ends stay."""
    from scipy.ndimage import uniform_filter1d

    if len(line) < 3:
        return line
    smooth = uniform_filter1d(line, 2 * half + 1, axis=0, mode="nearest")
    smooth[0], smooth[-1] = line[0], line[-1]
    return smooth


def _spread(values: np.ndarray) -> float:
    low, high = np.percentile(values, (10.0, 90.0))
    return float(high - low) / _DEVIATIONS
