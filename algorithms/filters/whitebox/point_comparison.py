"""Find points that stand far above a neighbour, where the cells of a grid do not show it.

They are compared point by point, in full precision, only with neighbours that can still matter.
"""

from __future__ import annotations

from typing import Callable, Iterator

import numpy as np

from ...core.threads import parts_of
from ...grids.cells import lower_at
from .cell_bounds import CellBounds
from .sorted_points import EMPTY, OFFSETS_A_STEP, ROUNDING, Table

# If the cells asked for are more than this share of all cells, divided by the radius in cells, it
# is faster to find the lowest values in the discs of all cells.
_MANY = 0.5


class PointComparison:
    """The erosion and the opening at points, exactly, and which of them stand above a neighbour.

    Points are known by their indices in `CellBounds.points`.

    Parameters
    ----------
    bounds : CellBounds
        The points, the rule, and the bounds of the cells.
    alive : callable
        Called several times a second. An exception that it raises ends the work.
    """

    def __init__(self, bounds: CellBounds, alive: Callable[[], None] = lambda: None) -> None:
        self._bounds, self._points, self._rule = bounds, bounds.points, bounds.rule
        self._alive = alive
        # Without top-hat, heights are compared as they are; their steps begin at the base.
        self._zero = 0.0 if self._rule.top_hat else self._points.base
        # In metres for each point; NaN where it is not known, or does not matter.
        count = len(bounds.points.z)
        self._eroded = np.full(count, np.nan)
        self._opened = np.full(count, np.nan if bounds.rule.top_hat else 0.0)

    def stands_above(self, at: np.ndarray) -> np.ndarray:
        """Return which of some points stand far above a neighbour.

        Parameters
        ----------
        at : numpy.ndarray of int, shape (k,)
            The points that `CellBounds.decide` leaves in doubt, ascending.

        Returns
        -------
        numpy.ndarray of bool, shape (k,)
        """
        bounds, points = self._bounds, self._points
        found = np.zeros(len(at), dtype=bool)
        if not self._rule.top_hat:
            self._compare(at, np.arange(len(at)), found)
            return found
        needed, certain = bounds.heights_in_doubt(points.cell[at])
        low = self._not_below(at)
        left = np.flatnonzero(points.z[at] - low >= needed)
        needed, certain, point = needed[left], certain[left], at[left]
        # If the opening is lower than this, its height does not matter.
        self._open(point, np.maximum(low[left], points.z[point] - certain))
        own = points.z[point] - self._opened[point]
        found[left] = ~(own < certain)
        asked = left[(own < certain) & (own >= needed)]
        asked, matters, enough = self._compare(at, asked, found)
        if len(asked):
            low = bounds.lowest_opening(points.cell[matters])
            self._open(matters, np.maximum(low, enough))
            self._compare(at, asked, found)
        return found

    def _not_below(self, at: np.ndarray) -> np.ndarray:
        """Return a lower bound of the opening at some points (k,), from the cells of neighbours."""
        points, eroded = self._points, self._bounds.eroded_low.ravel()
        values = -(points.metres(eroded.take(points.cell)) - ROUNDING)
        table = Table(points.table.start, -eroded, values)
        best = -self._bounds.lowest_opening(points.cell[at])
        self._lower(table, at, best, -1)
        return -best

    def _open(self, at: np.ndarray, enough: np.ndarray) -> None:
        """Find the opening at some points (k,), unless it does not exceed `enough` (k,)."""
        bounds, points = self._bounds, self._points
        # The erosion of a neighbour matters if it exceeds that.
        least = np.full(points.shape[0] * points.shape[1], EMPTY, dtype=np.int16)
        lower_at(least, points.cell[at], points.steps(enough))
        least = points.around(least.reshape(points.shape))
        self._alive()
        which = np.flatnonzero((bounds.eroded_high >= least).take(points.cell))
        self._erode(which)
        self._alive()
        steps = points.steps(self._eroded[which])
        left = np.flatnonzero(steps >= least.take(points.cell[which]))
        which, steps = which[left], steps[left]
        order = np.lexsort((-self._eroded[which], points.cell[which]))
        which, steps = which[order], steps[order]
        table = points.tabulated(points.cell[which], -steps, -self._eroded[which], which)
        lowest = -enough
        self._lower(table, at, lowest, -1)
        raised = np.flatnonzero(lowest < -enough)
        self._opened[at[raised]] = -lowest[raised]

    def _erode(self, at: np.ndarray) -> None:
        """Find the erosion at some points, in ascending order, where it is not known yet."""
        at = at[np.isnan(self._eroded[at])]
        best = self._points.z[at]
        self._lower(self._points.table, at, best)
        self._eroded[at] = best

    def _lower(self, table: Table, at: np.ndarray, best: np.ndarray, sign: int = 1) -> None:
        """Lower `best` (k,) to the least value of a neighbour; see `SortedPoints.lower`."""
        if not len(at):
            return
        points, offsets = self._points, self._points.offsets
        if len(at) * points.inner > _MANY * len(table.lowest):
            offsets = points.rim
            np.minimum(best, points.lowest_within(table).take(points.cell[at]), out=best)
        points.lower(table, at, best, offsets, sign, self._alive)

    def _compare(
        self, at: np.ndarray, asked: np.ndarray, found: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Find which of some points `at` (k,), whose opening is known, stand above a neighbour.

        `asked` selects the points to test. Sets `found` (k,) for the points that certainly do.
        Returns the points that may do so, depending on the opening at other points; these other
        points, ascending; and how high the opening must be there to matter.
        """
        point = at[asked]
        own = self._points.z[point] - self._opened[point]
        sure = np.zeros(len(point), dtype=bool)
        maybe = []
        for candidates in self._candidates(point, own, sure):
            maybe.extend(self._upwards(point, own, sure, *candidates))
        found[asked[sure]] = True
        possible = np.zeros(len(point), dtype=bool)
        enough = np.full(len(self._points.z), np.inf)
        for which, neighbour, least in maybe:
            left = ~sure[which]
            possible[which[left]] = True
            lower_at(enough, neighbour[left], least[left])
        matters = np.flatnonzero(enough < np.inf)
        return asked[possible], matters, enough[matters]

    def _candidates(
        self, point: np.ndarray, own: np.ndarray, sure: np.ndarray
    ) -> Iterator[tuple[np.ndarray, np.ndarray, np.ndarray]]:
        """Yield points (j,), cells in which they may have a lower neighbour, and the least rise.

        `own` (k,) are the heights of the points above their opening. `sure` (k,) marks the points
        that need no other neighbour; it is read anew each time.
        """
        points, rule, least = self._points, self._rule, self._bounds.least
        allowed = np.maximum(rule.height, rule.slope * points.nearest)
        fewest = np.floor(np.minimum(allowed / points.step, 32_000.0) - ROUNDING).astype(np.int16)
        most = (np.floor((own - self._zero) / points.step) + 1.0).astype(np.int16)
        allowed -= ROUNDING
        left = np.arange(len(point))
        for part in parts_of(len(points.offsets), OFFSETS_A_STEP):
            self._alive()
            left = left[~sure[left]]
            cell = points.cell[point[left], None] + points.offsets[part]
            hit = np.flatnonzero(least.take(cell) <= most[left, None] - fewest[part])
            if len(hit):
                which, offset = np.divmod(hit, cell.shape[1])
                yield left[which], cell.ravel()[hit], allowed[part][offset]

    def _upwards(
        self,
        point: np.ndarray,
        own: np.ndarray,
        sure: np.ndarray,
        which: np.ndarray,
        other: np.ndarray,
        least: np.ndarray,
    ) -> Iterator[tuple[np.ndarray, np.ndarray, np.ndarray]]:
        """Compare points with those of other cells, from the lowest of each cell upwards.

        `point`, `own` and `sure` (k,) are as for `_candidates`; the others (j,) are what it yields.
        Sets `sure` where a point stands above a neighbour. Yields points, the neighbours that they
        may stand above, and how high the opening must be there.
        """
        bounds, points, rule = self._bounds, self._points, self._rule
        neighbour, last = points.table.start[other], points.table.start[other + 1]
        low, high = bounds.lowest_opening(other), bounds.highest_opening(other)
        while len(which):
            z, opened, mine = points.z[neighbour], self._opened[neighbour], own[which]
            distance = points.distance(point[which], neighbour)
            far = np.where(distance <= rule.radius, rule.slope * distance, np.inf)
            unknown = np.isnan(opened)
            rise = mine - (z - np.where(unknown, low, opened))
            sure[which[(rise >= rule.height) & (rise > far)]] = True
            rise = mine - np.maximum(z - high, 0.0)
            may = unknown & (rise >= rule.height) & (rise > far) & ~sure[which]
            needed = z[may] - mine[may] + np.maximum(rule.height, far[may]) - ROUNDING
            yield which[may], neighbour[may], needed
            neighbour = neighbour + 1
            go = np.flatnonzero(~sure[which] & (neighbour < last) & (rise - self._zero >= least))
            which, neighbour, last, high, low, least = (
                each[go] for each in (which, neighbour, last, high, low, least)
            )
