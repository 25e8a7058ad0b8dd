"""The neighbours of every point in the plane: their minimum, and whether one lies far below.

Exact, without looking at every pair. The lowest value of each cell of a grid decides most
questions: cells wholly within the radius are settled by one erosion of the grid, and of the cells
on the rim only those are opened that could still change the answer.
"""

from __future__ import annotations

import math
from typing import Iterator

import numpy as np

from ..points import Points
from ..progress import SILENT, Progress
from .cells import Cells
from .morphology import erosion

# Few enough to look through, many enough that a disc does not have many more cells than points.
_POINTS_A_CELL = 2.0
_MOST_CELLS_A_RADIUS = 16
_MOST_CELLS_A_POINT = 4
# Work on this many points at a time: their arrays fit into the processor's cache.
_POINTS_A_STEP = 200_000
_PAIRS_A_STEP = 2_000_000
_GROWN_A_STEP = 20_000
# Bounds of cells are widened by this much, so that rounding never skips a point; points themselves
# are compared without it.
_ROUNDING = 1e-6


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
        cells = Cells.over(points, _cell_size(points, radius))
        self._reach = math.ceil(radius / cells.size + _ROUNDING)
        # A margin as wide as the reach: no offset from a cell leaves the grid.
        self._shape = cells.rows + 2 * self._reach, cells.columns + 2 * self._reach
        row, self._cell = np.divmod(cells.index, cells.columns)
        self._cell += (row + self._reach) * self._shape[1] + self._reach
        counts = np.bincount(self._cell, minlength=self._shape[0] * self._shape[1])
        self._occupied = np.flatnonzero(counts)
        self._start = np.concatenate(((0), np.cumsum(counts)), axis=None)
        self._set_offsets(radius / cells.size, cells.size)
        self._grown, self._grown_radius = self._find_grown(counts, at_least)

    def minimum(self, values: np.ndarray, progress: Progress = SILENT) -> np.ndarray:
        """Return the lowest of `values` (n,) among each point and its neighbours, shape (n,)."""
        table = _Table(self, values)
        inner = np.full(len(table.lowest), np.inf)
        if self._inner >= 0.0:
            inner = erosion(table.lowest.reshape(self._shape), self._inner).ravel()
        best = np.minimum(table.values, inner[self._cell[table.order]])
        for cells in self._bands(progress):
            for offset in self._rim:
                lower = cells[table.lowest[cells + offset] < inner[cells]]
                if len(lower):
                    self._lower(table, lower, lower + offset, best)
        result = np.empty_like(best)
        result[table.order] = best
        for point, neighbour in self._grown_pairs():
            np.minimum.at(result, point, values[neighbour])
        return result

    def maximum(self, values: np.ndarray, progress: Progress = SILENT) -> np.ndarray:
        """Return the highest of `values` (n,) among each point and its neighbours, shape (n,)."""
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

        Returns
        -------
        numpy.ndarray of bool, shape (n,)
        """
        table = _Table(self, values)
        reach = self._reach + math.sqrt(2.0)
        around = erosion(table.lowest.reshape(self._shape), reach).ravel()
        least = height - _ROUNDING
        found = np.zeros(len(values), dtype=bool)
        active = np.flatnonzero(table.values - around[self._cell[table.order]] >= least)
        for first in range(0, len(active), _POINTS_A_STEP):
            point = active[first : first + _POINTS_A_STEP]
            cell = self._cell[table.order[point]]
            for offset, nearest in zip(self._offsets, self._nearest):
                allowed = max(height, slope * nearest) - _ROUNDING
                high = table.values[point] - table.lowest[cell + offset] >= allowed
                if high.any():
                    limits = height, slope, allowed
                    self._above(table, point[high], cell[high] + offset, limits, found)
                    left = ~found[point]
                    point, cell = point[left], cell[left]
            progress(first / len(active))
        result = np.empty_like(found)
        result[table.order] = found
        for point, neighbour in self._grown_pairs():
            rise = values[point] - values[neighbour]
            far = rise > slope * self._distance(point, neighbour)
            result[point[far & (rise >= height)]] = True
        return result

    def _set_offsets(self, radius: float, size: float) -> None:
        """Find which cells a disc round any place in a cell can touch; `radius` is in cells."""
        row, column = np.mgrid[-self._reach : self._reach + 1, -self._reach : self._reach + 1]
        row, column = row.ravel(), column.ravel()
        nearest = np.hypot(*(np.maximum(np.abs(each) - 1, 0) for each in (row, column)))
        touched = np.flatnonzero(nearest <= radius + _ROUNDING)
        touched = touched[np.lexsort((np.hypot(row, column)[touched], nearest[touched]))]
        offset = row * self._shape[1] + column
        # Two cells whose centres are closer than this are within the radius from end to end.
        self._inner = math.floor((radius - math.sqrt(2.0)) / _ROUNDING - 1.0) * _ROUNDING
        rim = touched[np.hypot(row, column)[touched] >= self._inner - _ROUNDING]
        self._offsets, self._nearest = offset[touched], nearest[touched] * size
        self._rim = offset[rim]

    def _bands(self, progress: Progress) -> Iterator[np.ndarray]:
        """Yield the occupied cells in parts that hold about as many points as a step."""
        done = self._start[self._occupied]
        for first in range(0, len(self._x), _POINTS_A_STEP):
            progress(first / len(self._x))
            edges = np.searchsorted(done, (first, first + _POINTS_A_STEP))
            yield self._occupied[edges[0] : edges[1]]

    def _lower(
        self, table: _Table, cells: np.ndarray, others: np.ndarray, best: np.ndarray
    ) -> None:
        """Lower `best` of the points in each of `cells` by what lies in the cell in `others`."""
        count = self._start[cells + 1] - self._start[cells]
        point = _ranges(self._start[cells], count)
        other = np.repeat(others, count)
        closer = table.lowest[other] < best[point]
        point, other = point[closer], other[closer]
        neighbour, end = self._start[other], self._start[other + 1]
        # From the lowest point of the other cell upwards, until one lies within the radius.
        while len(point):
            inside = table.distance(point, neighbour) <= self._radius
            best[point[inside]] = table.values[neighbour[inside]]
            neighbour = neighbour + 1
            left = np.flatnonzero(~inside & (neighbour < end))
            left = left[table.values[neighbour[left]] < best[point[left]]]
            point, neighbour, end = point[left], neighbour[left], end[left]

    def _above(
        self,
        table: _Table,
        point: np.ndarray,
        other: np.ndarray,
        limits: tuple[float, float, float],
        found: np.ndarray,
    ) -> None:
        """Mark in `found` the points that stand above one in their cell of `other`."""
        height, slope, allowed = limits
        neighbour, end = self._start[other], self._start[other + 1]
        while len(point):
            rise = table.values[point] - table.values[neighbour]
            distance = table.distance(point, neighbour)
            above = (distance <= self._radius) & (rise >= height) & (rise > slope * distance)
            found[point[above]] = True
            neighbour = neighbour + 1
            left = np.flatnonzero(~above & (neighbour < end) & (rise >= allowed))
            point, neighbour, end = point[left], neighbour[left], end[left]

    def _find_grown(self, counts: np.ndarray, at_least: int) -> tuple[np.ndarray, np.ndarray]:
        """Return the points with too few neighbours, and the radius of each that has enough."""

        from scipy.spatial import cKDTree

        at_least = min(at_least, len(self._x) - 1)
        nothing = np.empty(0, dtype=np.intp), np.empty(0)
        if at_least < 1:
            return nothing
        doubtful = np.flatnonzero(counts[self._cell] <= at_least)
        if self._inner < 0.0:
            doubtful = np.arange(len(self._x))
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
                np.column_stack((self._x[point], self._y[point])), radius * (1.0 + _ROUNDING)
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
        self.order = np.lexsort((values, neighbourhood._cell))
        self.x, self.y = neighbourhood._x[self.order], neighbourhood._y[self.order]
        self.values = values[self.order]
        self.lowest = np.full(len(neighbourhood._start) - 1, np.inf)
        occupied = neighbourhood._occupied
        self.lowest[occupied] = self.values[neighbourhood._start[occupied]]

    def distance(self, point: np.ndarray, other: np.ndarray) -> np.ndarray:
        return _length(self.x[point] - self.x[other], self.y[point] - self.y[other])


def _length(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    return np.sqrt(x * x + y * y)


def _ranges(start: np.ndarray, count: np.ndarray) -> np.ndarray:
    """Return start[0], start[0] + 1, ... (count[0] of them), start[1], ... in one array."""
    before = np.cumsum(count) - count
    return np.arange(int(count.sum())) + np.repeat(start - before, count)


def _cell_size(points: Points, radius: float) -> float:
    """Return a size of cells that hold a few points each, neither too many nor too few a disc."""
    coarse = Cells.over(points, max(radius, 1.0))
    density = points.count / (np.count_nonzero(coarse.occupied) * coarse.size**2)
    wanted = min(math.sqrt(_POINTS_A_CELL / density), radius)
    most = max(_MOST_CELLS_A_POINT * points.count, 1_000_000)
    least = math.sqrt(coarse.rows * coarse.columns / most) * coarse.size
    return max(wanted, radius / _MOST_CELLS_A_RADIUS, least)
