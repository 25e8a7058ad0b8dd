"""Which points of a block stand far above a neighbour: by cell, and exactly where that is in doubt.

Heights are counted in small whole steps first. What the lowest step of each cell says of all points
of a cell decides nearly all of them, at the cost of a few erosions of a grid. The others are
compared point by point, in full precision, with those neighbours only that can still matter.
"""

from __future__ import annotations

import math
from typing import Callable, NamedTuple

import numpy as np

from ..points import Points
from .morphology import erosion, within_square
from .neighbourhood import cell_size

# So small that a cell holds few points, unless a disc or the plane had too many of them.
_POINTS_A_CELL = 1.0
_MOST_CELLS_A_RADIUS = 48
# Metres of a step, unless that makes more than fit into 16 bits with room for sums of two.
_STEP, _MOST_STEPS = 0.01, 32_000
_EMPTY = 32_767
# Discs whose lowest cell is compared grow by this factor.
_DISC_STEP = math.sqrt(2.0)
# Offsets of cells that are looked up at a time.
_OFFSETS_A_STEP = 8
# If more than so many of all cells divided by the radius in cells are asked for, it costs less to
# find what is lowest in the discs of all cells.
_MANY = 0.5
# Cells, steps and metres by which bounds are widened, so that rounding never decides; points
# themselves are compared without it.
_ROUNDING = 1e-5


class Rule(NamedTuple):
    """When a point stands far above a neighbour.

    Attributes
    ----------
    radius : float
        Metres; points at exactly this distance are neighbours.
    height : float
        The difference of height in metres that counts: this or more.
    slope : float
        The rise over run that counts: more than this. Both must be met by one neighbour.
    top_hat : bool
        Whether heights are compared above the opening of the heights by the neighbourhood, that
        is the highest erosion among the neighbours (white top-hat).
    """

    radius: float
    height: float
    slope: float
    top_hat: bool


class Block:
    """Points in the order of their cells and, within a cell, of their heights.

    Parameters
    ----------
    points : Points
        Those asked for, their neighbours, the neighbours of these and theirs.
    rule : Rule
        What is asked.
    alive : callable
        Is called several times a second; what it raises ends the work.
    """

    def __init__(
        self, points: Points, rule: Rule, alive: Callable[[], None] = lambda: None
    ) -> None:
        self._alive = alive
        self._rule = rule
        self._size = cell_size(points, rule.radius, _POINTS_A_CELL, _MOST_CELLS_A_RADIUS)
        # Cells whose centres are closer than this are within the radius from end to end.
        self._inner = rule.radius / self._size - math.sqrt(2.0) - _ROUNDING
        self._sort(points)
        alive()
        self._set_offsets()
        self._set_bounds()

    def stands_above(self, asked: np.ndarray) -> np.ndarray:
        """Return which points stand far above a neighbour.

        Parameters
        ----------
        asked : numpy.ndarray of bool, shape (n,)
            The points asked for.

        Returns
        -------
        numpy.ndarray of bool, shape (n,)
            False where it is not asked.
        """
        asked = asked[self._order]
        above = asked & (self._level >= self._enough.take(self._cell))
        doubtful = np.flatnonzero(
            asked & ~above & (self._level > self._too_little.take(self._cell))
        )
        if len(doubtful):
            above[doubtful] = self._exactly(doubtful)
        result = np.empty_like(above)
        result[self._order] = above
        return result

    def _sort(self, points: Points) -> None:
        x, y, z = points
        self._reach = reach = math.ceil(self._rule.radius / self._size + _ROUNDING)
        cell = ((y - y.min()) / self._size).astype(np.int64) + reach
        column = ((x - x.min()) / self._size).astype(np.int64) + reach
        # A margin as wide as the reach: no offset from a cell leaves the grid.
        self._shape = int(cell.max()) + 1 + reach, int(column.max()) + 1 + reach
        cell *= self._shape[1]
        cell += column
        self._base, range_ = float(z.min()), float(np.ptp(z))
        height = z - self._base
        fine = (height * ((2**32 - 1) / max(range_, 1.0))).astype(np.int64)
        order = np.argsort((cell << 32) + fine)
        sorted_cell, sorted_z = cell[order], z[order]
        if np.any((np.diff(sorted_z) < 0.0) & (np.diff(sorted_cell) == 0)):
            order = np.lexsort((z, cell))  # some heights are all but equal
            sorted_cell, sorted_z = cell[order], z[order]
        self._order, self._cell = order, sorted_cell
        self._x, self._y, self._z = x[order], y[order], sorted_z
        self._step = max(_STEP, range_ / _MOST_STEPS)
        self._level = (height[order] / self._step).astype(np.int16)
        self._table = self._tabulated(self._cell, self._level, self._z)

    def _set_offsets(self) -> None:
        """Find which cells a disc round any place in a cell can touch."""
        side = np.arange(-self._reach, self._reach + 1)
        row, column = np.repeat(side, len(side)), np.tile(side, len(side))
        nearest = np.hypot(*(np.maximum(np.abs(each) - 1, 0) for each in (row, column)))
        nearest *= self._size
        touched = np.flatnonzero(nearest <= self._rule.radius + _ROUNDING * self._size)
        touched = touched[np.argsort(nearest[touched], kind="stable")]
        offset = row * self._shape[1] + column
        self._offsets, self._nearest = offset[touched], nearest[touched]
        # What is lowest is most likely found first where the disc ends.
        between = np.hypot(row, column)[touched]
        rim = np.flatnonzero(between > self._inner)
        outermost = np.abs(between[rim] - self._rule.radius / self._size + 0.5)
        self._rim = self._offsets[rim[np.argsort(outermost, kind="stable")]]

    def _set_bounds(self) -> None:
        """Find from which steps on it is certain that a point stands above, and up to which not.

        The erosion and the opening at any point of a cell lie within the steps from low to high.
        """
        rule, lowest = self._rule, self._table.lowest.reshape(self._shape)
        empty = lowest == _EMPTY
        if rule.top_hat:
            eroded = self._around(lowest)
            self._eroded_high = np.full(self._shape, _MOST_STEPS, dtype=np.int16)
            self._low = eroded.copy()
            if self._inner >= 0.0:
                self._eroded_high = erosion(lowest, self._inner)
                negative = -eroded
                negative[empty] = _EMPTY
                self._low = -erosion(negative, self._inner)
            negative = -self._eroded_high
            negative[empty] = _EMPTY
            self._high = -self._around(negative)
            self._eroded_high[empty] = -1
            eroded[empty] = -_EMPTY
            self._eroded_low = eroded
        else:
            self._low = np.zeros(self._shape, dtype=np.int16)
            self._high = np.full(self._shape, -1, dtype=np.int16)
        # Of the lowest point of a cell: so many steps above the opening or more, and fewer than.
        self._least = np.maximum(lowest - self._high - 1, 0)
        most = lowest - self._low + 1
        self._least[empty] = most[empty] = _EMPTY
        self._too_little = self._impossible() + self._low - 1
        self._enough = self._certain(most) + self._high + 1

    def _impossible(self) -> np.ndarray:
        """Return up to which steps above the opening no point of a cell stands above another."""
        impossible = np.full(self._shape, 2 * _EMPTY, dtype=np.int32)
        radius, rule = self._rule.radius, self._rule
        while True:
            # Nearer neighbours are looked at with smaller discs.
            nearest = radius / _DISC_STEP if radius > self._size else 0.0
            allowed = max(rule.height, rule.slope * nearest)
            steps = min(math.ceil(allowed / self._step - _ROUNDING), 2 * _EMPTY)
            least = self._around(self._least, radius)
            np.minimum(impossible, least + np.int32(steps - 1), out=impossible)
            if allowed == rule.height:
                return impossible
            radius = nearest
            self._alive()

    def _certain(self, most: np.ndarray) -> np.ndarray:
        """Return from which steps above the opening on any point of a cell stands above another."""
        certain = np.full(self._shape, 2 * _EMPTY, dtype=np.int32)
        radius, rule = self._inner, self._rule
        while radius >= 0.0:
            # Between centres; two points of the cells lie at most a diagonal farther apart.
            farthest = (radius + math.sqrt(2.0)) * self._size
            allowed = max(rule.height, rule.slope * farthest)
            steps = min(math.ceil(allowed / self._step + _ROUNDING), 2 * _EMPTY)
            np.minimum(certain, erosion(most, radius) + np.int32(steps), out=certain)
            if allowed == rule.height:
                break  # smaller discs allow no less
            radius = (radius + math.sqrt(2.0)) / _DISC_STEP - math.sqrt(2.0)
            self._alive()
        return certain

    def _exactly(self, at: np.ndarray) -> np.ndarray:
        """Return the answer for some points (k,), in ascending order."""
        found = np.zeros(len(at), dtype=bool)
        asked = np.arange(len(at))
        if not self._rule.top_hat:
            self._opened = np.zeros(len(self._z))
            self._compare(at, asked, found)
            return found
        self._eroded, self._opened = (np.full(len(self._z), np.nan) for _ in range(2))
        cell = self._cell[at]
        certain = (self._enough.take(cell) - self._high.take(cell) - 1) * self._step + _ROUNDING
        needed = (self._too_little.take(cell) - self._low.take(cell) + 1) * self._step - _ROUNDING
        low = self._not_below(at)
        left = np.flatnonzero(self._z[at] - low >= needed)
        certain, needed, point = certain[left], needed[left], at[left]
        # Where the opening is lower than this, it does not matter by how much.
        self._open(point, np.maximum(low[left], self._z[point] - certain))
        own = self._z[point] - self._opened[point]
        found[left] = ~(own < certain)
        asked = left[(own < certain) & (own >= needed)]
        asked, matters, enough = self._compare(at, asked, found)
        if len(asked):
            cell = self._cell[matters]
            self._open(matters, np.maximum(self._metres(self._low.take(cell)) - _ROUNDING, enough))
            self._compare(at, asked, found)
        return found

    def _not_below(self, at: np.ndarray) -> np.ndarray:
        """Return what the opening at some points (k,) is not below, by the cells of neighbours."""
        eroded = self._eroded_low.ravel()
        values = -(self._metres(eroded.take(self._cell)) - _ROUNDING)
        table = _Table(self._table.start, -eroded, values)
        best = _ROUNDING - self._metres(self._low.take(self._cell[at]))
        self._lower(table, at, best, -1)
        return -best

    def _open(self, at: np.ndarray, enough: np.ndarray) -> None:
        """Find the opening at some points (k,), unless it does not exceed `enough` (k,)."""
        cell = self._cell[at]
        # The erosion of a neighbour matters if it exceeds that.
        least = np.full(self._shape[0] * self._shape[1], _EMPTY, dtype=np.int16)
        np.minimum.at(least, cell, self._steps(enough))
        least = self._around(least.reshape(self._shape))
        self._alive()
        which = np.flatnonzero((self._eroded_high >= least).take(self._cell))
        self._erode(which)
        self._alive()
        steps = self._steps(self._eroded[which])
        left = np.flatnonzero(steps >= least.take(self._cell[which]))
        which, steps = which[left], steps[left]
        order = np.lexsort((-self._eroded[which], self._cell[which]))
        which, steps = which[order], steps[order]
        table = self._tabulated(self._cell[which], -steps, -self._eroded[which], which)
        lowest = -enough
        self._lower(table, at, lowest, -1)
        raised = np.flatnonzero(lowest < -enough)
        self._opened[at[raised]] = -lowest[raised]

    def _erode(self, at: np.ndarray) -> None:
        """Find the erosion at some points, in ascending order, where it is not known yet."""
        at = at[np.isnan(self._eroded[at])]
        best = self._z[at]
        self._lower(self._table, at, best)
        self._eroded[at] = best

    def _lower(self, table: _Table, at: np.ndarray, best: np.ndarray, sign: int = 1) -> None:
        """Lower `best` (k,) to the least value of a neighbour.

        Parameters
        ----------
        table : _Table
            The values.
        at : numpy.ndarray of int, shape (k,)
            For which points, in ascending order.
        best : numpy.ndarray of float, shape (k,)
            What is known to be the least.
        sign : int
            1 if the values are heights, -1 if they are heights negated.
        """
        if not len(at):
            return
        cell, offsets = self._cell[at], self._offsets
        if len(at) * self._inner > _MANY * len(table.lowest):
            offsets = self._rim
            np.minimum(best, self._within(table).take(cell), out=best)
        limit = sign * self._steps(sign * best)
        for group in range(0, len(offsets), _OFFSETS_A_STEP):
            self._alive()
            hits, others = [], []
            for offset in offsets[group : group + _OFFSETS_A_STEP]:
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
                near = self._distance(
                    at[which], neighbour if table.point is None else table.point[neighbour]
                )
                near = near <= self._rule.radius
                lower = which[near]
                np.minimum.at(best, lower, value[near])
                limit[lower] = sign * self._steps(sign * best[lower])
                neighbour = neighbour + 1
                left = np.flatnonzero(~near & (neighbour < last))
                which, neighbour, last = which[left], neighbour[left], last[left]

    def _compare(
        self, at: np.ndarray, asked: np.ndarray, found: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Find which points whose opening is known stand above a neighbour.

        Parameters
        ----------
        at : numpy.ndarray of int, shape (k,)
            The points.
        asked : numpy.ndarray of int
            For which of them to find out.
        found : numpy.ndarray of bool, shape (k,)
            Receives True for those that certainly do.

        Returns
        -------
        asked : numpy.ndarray of int
            Those that may do so, depending on the opening at other points.
        matters : numpy.ndarray of int
            These other points, in ascending order.
        enough : numpy.ndarray of float
            How high the opening must be there to matter.
        """
        rule = self._rule
        zero = 0.0 if rule.top_hat else self._base
        point = at[asked]
        own = self._z[point] - self._opened[point]
        allowed = np.maximum(rule.height, rule.slope * self._nearest)
        fewest = np.floor(np.minimum(allowed / self._step, 32_000.0) - _ROUNDING).astype(np.int16)
        most = (np.floor((own - zero) / self._step) + 1.0).astype(np.int16)
        allowed -= _ROUNDING
        sure = np.zeros(len(point), dtype=bool)
        left = np.arange(len(point))
        maybe = []
        for group in range(0, len(self._offsets), _OFFSETS_A_STEP):
            self._alive()
            part = slice(group, group + _OFFSETS_A_STEP)
            left = left[~sure[left]]
            cell = self._cell[point[left], None] + self._offsets[part]
            hit = np.flatnonzero(self._least.take(cell) <= most[left, None] - fewest[part])
            if not len(hit):
                continue
            which, offset = np.divmod(hit, cell.shape[1])
            which, other, least = left[which], cell.ravel()[hit], allowed[part][offset]
            neighbour, last = self._table.start[other], self._table.start[other + 1]
            high = self._metres(self._high.take(other) + 1.0) + _ROUNDING
            low = self._metres(self._low.take(other)) - _ROUNDING
            while len(which):
                z, opened, mine = self._z[neighbour], self._opened[neighbour], own[which]
                distance = self._distance(point[which], neighbour)
                far = np.where(distance <= rule.radius, rule.slope * distance, np.inf)
                unknown = np.isnan(opened)
                rise = mine - (z - np.where(unknown, low, opened))
                sure[which[(rise >= rule.height) & (rise > far)]] = True
                rise = mine - np.maximum(z - high, 0.0)
                may = unknown & (rise >= rule.height) & (rise > far) & ~sure[which]
                needed = z[may] - mine[may] + np.maximum(rule.height, far[may]) - _ROUNDING
                maybe.append((which[may], neighbour[may], needed))
                neighbour = neighbour + 1
                go = np.flatnonzero(~sure[which] & (neighbour < last) & (rise - zero >= least))
                which, neighbour, last, high, low, least = (
                    each[go] for each in (which, neighbour, last, high, low, least)
                )
        found[asked[sure]] = True
        possible = np.zeros(len(point), dtype=bool)
        enough = np.full(len(self._z), np.inf)
        for which, neighbour, least in maybe:
            left = ~sure[which]
            possible[which[left]] = True
            np.minimum.at(enough, neighbour[left], least[left])
        matters = np.flatnonzero(enough < np.inf)
        return asked[possible], matters, enough[matters]

    def _tabulated(
        self,
        cell: np.ndarray,
        steps: np.ndarray,
        values: np.ndarray,
        point: np.ndarray | None = None,
    ) -> _Table:
        cells = self._shape[0] * self._shape[1]
        start = np.zeros(cells + 1, dtype=np.int32)
        np.cumsum(np.bincount(cell, minlength=cells), out=start[1:])
        first = np.flatnonzero(np.diff(cell, prepend=-1))
        lowest = np.full(cells, _EMPTY, dtype=np.int16)
        lowest[cell[first]] = steps[first]
        return _Table(start, lowest, values, point)

    def _within(self, table: _Table) -> np.ndarray:
        """Return the least value in the cells that are within the radius from end to end."""
        least = np.full(self._shape, np.inf)
        occupied = np.flatnonzero(table.lowest != _EMPTY)
        least.ravel()[occupied] = table.values[table.start[occupied]]
        return erosion(least, self._inner)

    def _around(self, grid: np.ndarray, radius: float | None = None) -> np.ndarray:
        """Return the minimum of a grid over the cells that a disc round each cell can touch."""
        radius = self._rule.radius if radius is None else radius
        return within_square(np.minimum, erosion(grid, radius / self._size + _ROUNDING), 1)

    def _distance(self, point: np.ndarray, other: np.ndarray) -> np.ndarray:
        x, y = self._x[point] - self._x[other], self._y[point] - self._y[other]
        return np.sqrt(x * x + y * y)

    def _metres(self, steps: np.ndarray) -> np.ndarray:
        return self._base + self._step * steps

    def _steps(self, heights: np.ndarray) -> np.ndarray:
        """Return in which step heights lie."""
        steps = np.floor((heights - self._base) / self._step)
        return np.clip(steps, -1, _MOST_STEPS + 1).astype(np.int16)


class _Table(NamedTuple):
    """Values in the order of their cells and, within a cell, ascending.

    Attributes
    ----------
    start : numpy.ndarray of int, shape (cells + 1,)
        Where those of each cell begin.
    lowest : numpy.ndarray of int16, shape (cells,)
        How low the first one of each cell is in steps.
    values : numpy.ndarray of float, shape (m,)
        The values.
    point : numpy.ndarray of int, shape (m,), optional
        Which points have them, if not all.
    """

    start: np.ndarray
    lowest: np.ndarray
    values: np.ndarray
    point: np.ndarray | None = None
