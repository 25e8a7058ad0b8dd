"""The neighbours of every point in the plane: their minimum, and whether one lies far below.

Exact, without looking at every pair. The lowest value of each cell of a grid decides most
questions: cells wholly within the radius are settled by one erosion of the grid, and of the cells
on the rim only those are opened that could still change the answer.
"""

from __future__ import annotations

import math
from typing import Iterator

import numpy as np

from ...core.points import Points
from ...core.progress import SILENT, Progress
from ...core.threads import over_parts
from ...grids.cells import Cells, lower_at
from ...grids.morphology import erosion

# Few enough to look through, many enough that a disc does not have many more cells than points.
_POINTS_A_CELL = 2.0
_MOST_CELLS_A_RADIUS = 16
_MOST_CELLS_A_POINT = 4
# Work on this many points at a time: their arrays fit into the processor's cache.
_POINTS_A_STEP = 50_000
_PAIRS_A_STEP = 2_000_000
_GROWN_A_STEP = 20_000
# Bounds of cells are widened by this much, so that rounding never skips a point; points themselves
# are compared without it.
ROUNDING = 1e-6


class Neighbourhood:
    """The points within a radius of each point, or its nearest ones where those are too few.

    Parameters
    ----------
    points : Points
        Only x and y count.
    radius : float
        Radius in metres, greater than 0; points at exactly this distance are neighbours.
    at_least : int
        Where a point has fewer other points within the radius, the radius grows to the distance of
        the other point that is the so many-th nearest, for this point only.
    """

    def __init__(self, points: Points, radius: float, at_least: int = 0) -> None:
        self._x, self._y, self._radius = points.x, points.y, radius
        size = cell_size(points, radius, _POINTS_A_CELL, _MOST_CELLS_A_RADIUS)
        cells = Cells.over(points, size)
        self._reach = math.ceil(radius / cells.size + ROUNDING)
        # A margin as wide as the reach: no offset from a cell leaves the grid.
        self.shape = cells.rows + 2 * self._reach, cells.columns + 2 * self._reach
        row, self.cell = np.divmod(cells.index, cells.columns)
        self.cell += (row + self._reach) * self.shape[1] + self._reach
        self.cell_size = cells.size
        self._set_offsets(radius / cells.size, cells.size)
        self._grown, self._grown_radius = self._find_grown(at_least)

    @property
    def same_radius(self) -> bool:
        """Whether the radius is the same for all points: none had too few neighbours."""
        return not len(self._grown)

    def minimum(self, values: np.ndarray, progress: Progress = SILENT) -> np.ndarray:
        """Return the lowest value among each point and its neighbours.

        Parameters
        ----------
        values : numpy.ndarray of float, shape (n,)
            One for each point.
        progress : Progress
            Receives progress.

        Returns
        -------
        numpy.ndarray of float, shape (n,)
        """
        table = _Table(self, values)
        order = np.argsort(self.cell, kind="stable")
        best = values[order]
        if self.inner >= 0.0:
            lowest = erosion(table.lowest.reshape(self.shape), self.inner).ravel()
            best = np.minimum(best, lowest[self.cell[order]])

        def fill(part: slice) -> None:
            self._lower(table, order[part], best[part])

        over_parts(fill, len(order), _POINTS_A_STEP, progress)
        result = np.empty_like(best)
        result[order] = best
        for point, neighbour in self._grown_pairs():
            lower_at(result, point, values[neighbour])
        return result

    def maximum(self, values: np.ndarray, progress: Progress = SILENT) -> np.ndarray:
        """Return the highest value among each point and its neighbours; see `minimum`."""
        return -self.minimum(-values, progress)

    def stands_above(
        self, values: np.ndarray, height: float, slope: float, progress: Progress = SILENT
    ) -> np.ndarray:
        """Return which points stand far above one of their neighbours.

        Parameters
        ----------
        values : numpy.ndarray of float, shape (n,)
            Heights in metres.
        height : float
            The difference of height that counts: this or more.
        slope : float
            The rise over run that counts: more than this. Both must be met by one neighbour.
        progress : Progress
            Receives progress.

        Returns
        -------
        numpy.ndarray of bool, shape (n,)
        """
        table = _Table(self, values)
        around = erosion(table.lowest.reshape(self.shape), self.outer).ravel()
        active = np.flatnonzero(values - around[self.cell] >= height - ROUNDING)
        active = active[np.argsort(self.cell[active], kind="stable")]
        found = np.zeros(len(values), dtype=bool)

        def fill(part: slice) -> None:
            which = active[part]
            found[which] = self._above(table, which, values[which], height, slope)

        over_parts(fill, len(active), _POINTS_A_STEP, progress)
        for point, neighbour in self._grown_pairs():
            rise = values[point] - values[neighbour]
            far = rise > slope * self._distance(point, neighbour)
            found[point[far & (rise >= height)]] = True
        return found

    def _set_offsets(self, radius: float, size: float) -> None:
        """Find which cells a disc round any place in a cell can touch; `radius` is in cells."""
        row, column = np.mgrid[-self._reach : self._reach + 1, -self._reach : self._reach + 1]
        row, column = row.ravel(), column.ravel()
        nearest = np.hypot(*(np.maximum(np.abs(each) - 1, 0) for each in (row, column)))
        touched = np.flatnonzero(nearest <= radius + ROUNDING)
        touched = touched[np.lexsort((np.hypot(row, column)[touched], nearest[touched]))]
        offset = row * self.shape[1] + column
        # Two cells whose centres are closer than this are within the radius from end to end, and
        # two whose centres are farther apart than that nowhere.
        self.inner = math.floor((radius - math.sqrt(2.0)) / ROUNDING - 1.0) * ROUNDING
        self.outer = self._reach + math.sqrt(2.0)
        rim = touched[np.hypot(row, column)[touched] >= self.inner - ROUNDING]
        self._offsets, self._nearest = offset[touched], nearest[touched] * size
        self._rim = offset[rim]

    def _lower(self, table: _Table, point: np.ndarray, best: np.ndarray) -> None:
        """Lower `best` of some points by what lies within the radius in the cells on the rim.

        The points come in the order of their cells.
        """
        x, y, cell = self._x[point], self._y[point], self.cell[point]
        first = np.flatnonzero(np.diff(cell, prepend=-1))
        cells, count = cell[first], np.diff(first, append=len(cell))
        highest = np.maximum.reduceat(best, first)
        for offset in self._rim:
            lower = np.flatnonzero(table.lowest[cells + offset] < highest)
            which = _ranges(first[lower], count[lower])
            other = np.repeat(cells[lower] + offset, count[lower])
            closer = table.lowest[other] < best[which]
            which, other = which[closer], other[closer]
            neighbour, end = table.start[other], table.start[other + 1]
            # From the lowest point of the other cell upwards, until one lies within the radius.
            while len(which):
                distance = _length(x[which] - table.x[neighbour], y[which] - table.y[neighbour])
                inside = distance <= self._radius
                best[which[inside]] = table.values[neighbour[inside]]
                neighbour = neighbour + 1
                left = np.flatnonzero(~inside & (neighbour < end))
                left = left[table.values[neighbour[left]] < best[which[left]]]
                which, neighbour, end = which[left], neighbour[left], end[left]

    def _above(
        self,
        table: _Table,
        point: np.ndarray,
        own: np.ndarray,
        height: float,
        slope: float,
    ) -> np.ndarray:
        """Return which of some points stand above a neighbour."""
        x, y, cell = self._x[point], self._y[point], self.cell[point]
        found = np.zeros(len(point), dtype=bool)
        asked = np.arange(len(point))
        for offset, nearest in zip(self._offsets, self._nearest):
            allowed = max(height, slope * nearest) - ROUNDING
            other = cell[asked] + offset
            high = np.flatnonzero(own[asked] - table.lowest[other] >= allowed)
            if not len(high):
                continue
            which, other = asked[high], other[high]
            neighbour, end = table.start[other], table.start[other + 1]
            while len(which):
                rise = own[which] - table.values[neighbour]
                distance = _length(x[which] - table.x[neighbour], y[which] - table.y[neighbour])
                above = (distance <= self._radius) & (rise >= height) & (rise > slope * distance)
                found[which[above]] = True
                neighbour = neighbour + 1
                left = np.flatnonzero(~above & (neighbour < end) & (rise >= allowed))
                which, neighbour, end = which[left], neighbour[left], end[left]
            asked = asked[~found[asked]]
        return found

    def _find_grown(self, at_least: int) -> tuple[np.ndarray, np.ndarray]:
        """Return the points with too few neighbours, and the radius of each that has enough."""
        at_least = min(at_least, len(self._x) - 1)
        nothing = np.empty(0, dtype=np.intp), np.empty(0)
        if at_least < 1:
            return nothing
        # Here, as it takes longer to load than a million points to classify.
        from scipy.spatial import cKDTree

        doubtful = np.arange(len(self._x))
        if self.inner >= 0.0:
            doubtful = np.flatnonzero(np.bincount(self.cell)[self.cell] <= at_least)
        if not len(doubtful):
            return nothing
        self._tree = cKDTree(np.column_stack((self._x, self._y)))
        radius = np.empty(len(doubtful))
        step = max(_PAIRS_A_STEP // (at_least + 1), 1)
        for first in range(0, len(doubtful), step):
            point = doubtful[first : first + step]
            _, nearest = self._tree.query(
                np.column_stack((self._x[point], self._y[point])), at_least + 1
            )
            distance = self._distance(np.repeat(point, at_least + 1), nearest.ravel())
            radius[first : first + step] = distance.reshape(nearest.shape).max(axis=1)
        grown = radius > self._radius
        return doubtful[grown], radius[grown]

    def _grown_pairs(self) -> Iterator[tuple[np.ndarray, np.ndarray]]:
        """Yield the points whose radius grew and their neighbours, as pairs of index arrays."""
        if not len(self._grown):
            return
        for first in range(0, len(self._grown), _GROWN_A_STEP):
            part = slice(first, first + _GROWN_A_STEP)
            point, radius = self._grown[part], self._grown_radius[part]
            neighbours = self._tree.query_ball_point(
                np.column_stack((self._x[point], self._y[point])), radius * (1.0 + ROUNDING)
            )
            count = np.fromiter(map(len, neighbours), dtype=np.intp, count=len(point))
            neighbour = np.concatenate([np.asarray(each, dtype=np.intp) for each in neighbours])
            point, radius = np.repeat(point, count), np.repeat(radius, count)
            near = self._distance(point, neighbour) <= radius
            yield point[near], neighbour[near]

    def _distance(self, point: np.ndarray, other: np.ndarray) -> np.ndarray:
        return _length(self._x[point] - self._x[other], self._y[point] - self._y[other])


class _Table:
    """Points in the order of their cells and, within a cell, of their values."""

    def __init__(self, neighbourhood: Neighbourhood, values: np.ndarray) -> None:
        cell, x, y = neighbourhood.cell, neighbourhood._x, neighbourhood._y
        order = np.lexsort((values, cell))
        self.x, self.y, self.values = x[order], y[order], values[order]
        cells = neighbourhood.shape[0] * neighbourhood.shape[1]
        counts = np.bincount(cell, minlength=cells)
        self.start = np.concatenate(((0), np.cumsum(counts)), axis=None)
        occupied = np.flatnonzero(counts)
        self.lowest = np.full(cells, np.inf)
        self.lowest[occupied] = self.values[self.start[occupied]]


def _length(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    return np.sqrt(x * x + y * y)


def _ranges(start: np.ndarray, count: np.ndarray) -> np.ndarray:
    """Return start[0], start[0] + 1, ... (count[0] of them), start[1], ... in one array."""
    before = np.cumsum(count) - count
    return np.arange(int(count.sum())) + np.repeat(start - before, count)


def cell_size(points: Points, radius: float, wanted: float, most_a_radius: int) -> float:
    """Return a size of cells that hold `wanted` points each, but are not too many a radius."""
    coarse = Cells.over(points, max(radius, 1.0))
    density = points.count / (np.count_nonzero(coarse.occupied) * coarse.size**2)
    size = min(math.sqrt(wanted / density), radius)
    most = max(_MOST_CELLS_A_POINT * points.count, 1_000_000)
    least = math.sqrt(coarse.rows * coarse.columns / most) * coarse.size
    return max(size, radius / most_a_radius, least)
