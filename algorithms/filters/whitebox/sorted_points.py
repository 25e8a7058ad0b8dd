"""Points in the order of the cells of a grid, to find the lowest points near a point.

Heights are also kept in small whole steps: a grid of the lowest step of each cell takes two bytes a
cell, and its morphology is fast.
"""

from __future__ import annotations

import math
from typing import Callable, NamedTuple

import numpy as np

from ...core.points import Points
from ...core.threads import parts_of
from ...grids.cells import Cells, lower_at
from ...grids.morphology import erosion, within_square

# A cell is so small that it holds one point, but there are at most so many cells along a radius,
# and so many for each point.
_MOST_CELLS_A_RADIUS, _MOST_CELLS_A_POINT = 48, 4
# Offsets of cells that are searched at a time.
OFFSETS_A_STEP = 8
# Size of a step in metres, and the most steps: the sum of two must fit into 16 bits. If there were
# more steps, they are larger.
_STEP, MOST_STEPS = 0.01, 32_000
# The step of cells without points.
EMPTY = 32_767
# Bounds are widened by this, in cells, steps or metres, so that rounding never decides. Points are
# compared without it.
ROUNDING = 1e-5


class Table(NamedTuple):
    """Values in the order of their cells and, within a cell, ascending.

    Attributes
    ----------
    start : numpy.ndarray of int32, shape (cells + 1,)
        Where the values of each cell begin.
    lowest : numpy.ndarray of int16, shape (cells,)
        The first value of each cell in steps; `EMPTY` in empty cells.
    values : numpy.ndarray of float, shape (m,)
        The values in metres.
    point : numpy.ndarray of int, shape (m,), optional
        The points that have these values, if not all have one.
    """

    start: np.ndarray
    lowest: np.ndarray
    values: np.ndarray
    point: np.ndarray | None = None


class SortedPoints:
    """Points in the order of their cells and, within a cell, of their heights.

    Points are given by their indices in this order, cells by their indices in the flattened grid.

    Parameters
    ----------
    points : Points
        The points.
    radius : float
        Metres, greater than 0; points at exactly this distance are neighbours.

    Attributes
    ----------
    x, y, z : numpy.ndarray of float, shape (n,)
        Coordinates in metres.
    cell : numpy.ndarray of int, shape (n,)
        The cell of each point.
    level : numpy.ndarray of int16, shape (n,)
        The step in which each point lies.
    table : Table
        The heights of all points.
    size, inner : float
        Side of a cell in metres. Cells whose centres are at most `inner` cells apart lie wholly
        within the radius (none do if this is negative).
    base, step : float
        The height at which the steps begin, and the size of a step, in metres.
    shape : tuple of int
        Rows and columns of the grid. It has a margin: no offset leaves it.
    offsets, nearest : numpy.ndarray, shape (m,)
        From a cell to the cells that a disc round any place in it can touch, and the least
        distances of these in metres, ascending.
    rim : numpy.ndarray of int, shape (l,)
        The offsets that `inner` does not cover.
    """

    def __init__(self, points: Points, radius: float) -> None:
        self._radius = radius
        self.size = _cell_size(points, radius)
        self.inner = radius / self.size - math.sqrt(2.0) - ROUNDING
        self._reach = math.ceil(radius / self.size + ROUNDING)
        self._sort(points)
        self._set_offsets()

    def as_given(self, values: np.ndarray) -> np.ndarray:
        """Return values (n,) of the points, in the order in which the points were given."""
        result = np.empty_like(values)
        result[self._order] = values
        return result

    def as_sorted(self, values: np.ndarray) -> np.ndarray:
        """Return values (n,) of the points as they were given, in the order of this class."""
        return values[self._order]

    def tabulated(
        self,
        cell: np.ndarray,
        steps: np.ndarray,
        values: np.ndarray,
        point: np.ndarray | None = None,
    ) -> Table:
        """Return the table of values in metres (m,), ascending within a cell.

        `cell` are the cells of the values, ascending; `steps` are the values in steps, int16;
        `point` are the points that have them, if not all do.
        """
        cells = self.shape[0] * self.shape[1]
        start = np.zeros(cells + 1, dtype=np.int32)
        np.cumsum(np.bincount(cell, minlength=cells), out=start[1:])
        first = np.flatnonzero(np.diff(cell, prepend=-1))
        lowest = np.full(cells, EMPTY, dtype=np.int16)
        lowest[cell[first]] = steps[first]
        return Table(start, lowest, values, point)

    def lowest_within(self, table: Table) -> np.ndarray:
        """Return the least value in the cells that lie wholly within the radius.

        Metres, shape (rows, columns); inf where there is none.
        """
        least = np.full(self.shape, np.inf)
        occupied = np.flatnonzero(table.lowest != EMPTY)
        least.ravel()[occupied] = table.values[table.start[occupied]]
        return erosion(least, self.inner)

    def lower(
        self,
        table: Table,
        at: np.ndarray,
        best: np.ndarray,
        offsets: np.ndarray,
        sign: int = 1,
        alive: Callable[[], None] = lambda: None,
    ) -> None:
        """Lower `best` (k,), in place, to the least value that a neighbour has in a table.

        `at` (k,) are the points, ascending; `offsets` lead from the cell of a point to the cells
        that are searched. The sign is -1 if the values are negated heights. `alive` is called
        several times a second; an exception that it raises ends the work.
        """
        cell, limit = self.cell[at], sign * self.steps(sign * best)
        for group in parts_of(len(offsets), OFFSETS_A_STEP):
            alive()
            hits, others = [], []
            for offset in offsets[group]:
                other = cell + offset
                hit = np.flatnonzero(table.lowest.take(other) <= limit)
                hits.append(hit)
                others.append(other[hit])
            which, other = np.concatenate(hits), np.concatenate(others)
            neighbour, last = table.start[other], table.start[other + 1]
            # From the lowest value of the other cell upwards, until one lies within the radius.
            while len(which):
                value = table.values[neighbour]
                left = np.flatnonzero(value < best[which])
                which, neighbour, last, value = (
                    each[left] for each in (which, neighbour, last, value)
                )
                near = self.distance(
                    at[which], neighbour if table.point is None else table.point[neighbour]
                )
                near = near <= self._radius
                lower = which[near]
                lower_at(best, lower, value[near])
                limit[lower] = sign * self.steps(sign * best[lower])
                neighbour = neighbour + 1
                left = np.flatnonzero(~near & (neighbour < last))
                which, neighbour, last = which[left], neighbour[left], last[left]

    def around(self, grid: np.ndarray, radius: float | None = None) -> np.ndarray:
        """Return the minimum of a grid over the cells that a disc round each cell can touch.

        The radius is in metres; by default it is the radius of the neighbours.
        """
        radius = self._radius if radius is None else radius
        return within_square(np.minimum, erosion(grid, radius / self.size + ROUNDING), 1)

    def distance(self, point: np.ndarray, other: np.ndarray) -> np.ndarray:
        """Return the distances of some points (k,) from as many others in the plane, in metres."""
        x, y = self.x[point] - self.x[other], self.y[point] - self.y[other]
        return np.sqrt(x * x + y * y)

    def metres(self, steps: np.ndarray) -> np.ndarray:
        """Return the heights in metres at which steps (k,) begin."""
        return self.base + self.step * steps

    def steps(self, heights: np.ndarray) -> np.ndarray:
        """Return the steps (int16) of heights in metres (k,); heights beyond all are clipped."""
        steps = np.floor((heights - self.base) / self.step)
        return np.clip(steps, -1, MOST_STEPS + 1).astype(np.int16)

    def _sort(self, points: Points) -> None:
        x, y, z = points
        reach = self._reach
        cell = ((y - y.min()) / self.size).astype(np.int64) + reach
        column = ((x - x.min()) / self.size).astype(np.int64) + reach
        self.shape = int(cell.max()) + 1 + reach, int(column.max()) + 1 + reach
        cell *= self.shape[1]
        cell += column
        self.base, range_ = float(z.min()), float(np.ptp(z))
        height = z - self.base
        fine = (height * ((2**32 - 1) / max(range_, 1.0))).astype(np.int64)
        order = np.argsort((cell << 32) + fine)
        sorted_cell, sorted_z = cell[order], z[order]
        if np.any((np.diff(sorted_z) < 0.0) & (np.diff(sorted_cell) == 0)):
            order = np.lexsort((z, cell))  # some heights are all but equal
            sorted_cell, sorted_z = cell[order], z[order]
        self._order, self.cell = order, sorted_cell
        self.x, self.y, self.z = x[order], y[order], sorted_z
        self.step = max(_STEP, range_ / MOST_STEPS)
        self.level = (height[order] / self.step).astype(np.int16)
        self.table = self.tabulated(self.cell, self.level, self.z)

    def _set_offsets(self) -> None:
        """Find which cells a disc round any place in a cell can touch."""
        side = np.arange(-self._reach, self._reach + 1)
        row, column = np.repeat(side, len(side)), np.tile(side, len(side))
        nearest = np.hypot(*(np.maximum(np.abs(each) - 1, 0) for each in (row, column)))
        nearest *= self.size
        touched = np.flatnonzero(nearest <= self._radius + ROUNDING * self.size)
        touched = touched[np.argsort(nearest[touched], kind="stable")]
        offset = row * self.shape[1] + column
        self.offsets, self.nearest = offset[touched], nearest[touched]
        # The lowest is most likely found first where the disc ends.
        between = np.hypot(row, column)[touched]
        rim = np.flatnonzero(between > self.inner)
        outermost = np.abs(between[rim] - self._radius / self.size + 0.5)
        self.rim = self.offsets[rim[np.argsort(outermost, kind="stable")]]


def _cell_size(points: Points, radius: float) -> float:
    """Return the side of cells that hold about one point, but are not too many along a radius."""
    coarse = Cells.over(points, max(radius, 1.0))
    density = points.count / (np.count_nonzero(coarse.occupied) * coarse.size**2)
    most = max(_MOST_CELLS_A_POINT * points.count, 1_000_000)
    least = math.sqrt(coarse.rows * coarse.columns / most) * coarse.size
    return max(min(math.sqrt(1.0 / density), radius), radius / _MOST_CELLS_A_RADIUS, least)
