"""Which points of some stand far above a neighbour, as far as the cells of a grid tell.

What the lowest step of each cell says of all points of a cell decides nearly all of them, at the
cost of a few erosions of a grid.
"""

from __future__ import annotations

import math
from typing import Callable, NamedTuple

import numpy as np

from ...core.points import Points
from ...grids.morphology import erosion
from .sorted_points import EMPTY, MOST_STEPS, ROUNDING, SortedPoints

# Discs whose lowest cell is compared grow by this factor.
_DISC_STEP = math.sqrt(2.0)


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


class CellBounds:
    """What the points of a cell have in common: bounds of their opening, and what follows.

    Without `Rule.top_hat` the height at which the steps begin stands for the opening of all points,
    and there is no erosion.

    Parameters
    ----------
    points : Points
        Those asked for, their neighbours, the neighbours of these and theirs.
    rule : Rule
        What is asked.
    alive : callable
        Is called several times a second; what it raises ends the work.

    Attributes
    ----------
    points : SortedPoints
        The points in the order in which they are known here.
    rule : Rule
        What is asked.
    least : numpy.ndarray of int16, shape (rows, columns)
        So many steps the lowest point of each cell lies above the opening or more.
    eroded_low, eroded_high : numpy.ndarray of int16, shape (rows, columns)
        The erosion at any point of a cell lies within the steps from low to high. Less than any
        step where there is no point.
    """

    def __init__(
        self, points: Points, rule: Rule, alive: Callable[[], None] = lambda: None
    ) -> None:
        self.rule, self._alive = rule, alive
        self.points = SortedPoints(points, rule.radius)
        alive()
        self._bound_opening()
        self._bound_rises()

    def decide(self, asked: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return which points asked for certainly stand far above a neighbour, and who may do so.

        Parameters
        ----------
        asked : numpy.ndarray of bool, shape (n,)
            In the order in which the points were given.

        Returns
        -------
        above : numpy.ndarray of bool, shape (n,)
            In the order of `points`.
        doubtful : numpy.ndarray of int, shape (k,)
            Indices in `points`, ascending.
        """
        points, asked = self.points, self.points.as_sorted(asked)
        above = asked & (points.level >= self._enough.take(points.cell))
        possible = points.level > self._too_little.take(points.cell)
        return above, np.flatnonzero(asked & ~above & possible)

    def lowest_opening(self, cell: np.ndarray) -> np.ndarray:
        """Return which height in metres the opening is not below at the points of cells (k,)."""
        return self.points.metres(self._low.take(cell)) - ROUNDING

    def highest_opening(self, cell: np.ndarray) -> np.ndarray:
        """Return which height in metres the opening is not above at the points of cells (k,)."""
        return self.points.metres(self._high.take(cell) + 1.0) + ROUNDING

    def heights_in_doubt(self, cell: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return between which heights above the opening it is in doubt who stands above another.

        Metres, for points in cells (k,): those less high stand above no neighbour, and those as
        high as the second, or higher, above one.
        """
        needed = self._too_little.take(cell) - self._low.take(cell) + 1
        certain = self._enough.take(cell) - self._high.take(cell) - 1
        step = self.points.step
        return needed * step - ROUNDING, certain * step + ROUNDING

    def _bound_opening(self) -> None:
        """Find between which steps, low and high, the erosion and the opening of cells lie."""
        points = self.points
        if not self.rule.top_hat:
            self._low = np.zeros(points.shape, dtype=np.int16)
            self._high = np.full(points.shape, -1, dtype=np.int16)
            return
        lowest = points.table.lowest.reshape(points.shape)
        empty = lowest == EMPTY
        eroded = points.around(lowest)
        self.eroded_high = np.full(points.shape, MOST_STEPS, dtype=np.int16)
        self._low = eroded.copy()
        if points.inner >= 0.0:
            self.eroded_high = erosion(lowest, points.inner)
            negative = -eroded
            negative[empty] = EMPTY
            self._low = -erosion(negative, points.inner)
        negative = -self.eroded_high
        negative[empty] = EMPTY
        self._high = -points.around(negative)
        self.eroded_high[empty] = -1
        eroded[empty] = -EMPTY
        self.eroded_low = eroded

    def _bound_rises(self) -> None:
        """Find from which steps on it is certain that a point stands above, and up to which not."""
        lowest = self.points.table.lowest.reshape(self.points.shape)
        empty = lowest == EMPTY
        # The lowest point of a cell lies `least` steps above the opening or more, but not `most`.
        self.least = np.maximum(lowest - self._high - 1, 0)
        most = lowest - self._low + 1
        self.least[empty] = most[empty] = EMPTY
        self._too_little = self._impossible() + self._low - 1
        self._enough = self._certain(most) + self._high + 1

    def _impossible(self) -> np.ndarray:
        """Return up to which steps above the opening no point of a cell stands above another."""
        points, rule, radius = self.points, self.rule, self.rule.radius
        impossible = np.full(points.shape, 2 * EMPTY, dtype=np.int32)
        while True:
            # Nearer neighbours are looked at with smaller discs.
            nearest = radius / _DISC_STEP if radius > points.size else 0.0
            allowed = max(rule.height, rule.slope * nearest)
            steps = min(math.ceil(allowed / points.step - ROUNDING), 2 * EMPTY)
            least = points.around(self.least, radius)
            np.minimum(impossible, least + np.int32(steps - 1), out=impossible)
            if allowed == rule.height:
                return impossible
            radius = nearest
            self._alive()

    def _certain(self, most: np.ndarray) -> np.ndarray:
        """Return from which steps above the opening on any point of a cell stands above another."""
        points, rule, radius = self.points, self.rule, self.points.inner
        certain = np.full(points.shape, 2 * EMPTY, dtype=np.int32)
        while radius >= 0.0:
            # Two points lie at most a diagonal farther apart than the centres of their cells.
            farthest = (radius + math.sqrt(2.0)) * points.size
            allowed = max(rule.height, rule.slope * farthest)
            steps = min(math.ceil(allowed / points.step + ROUNDING), 2 * EMPTY)
            np.minimum(certain, erosion(most, radius) + np.int32(steps), out=certain)
            if allowed == rule.height:
                break  # smaller discs allow no less
            radius = (radius + math.sqrt(2.0)) / _DISC_STEP - math.sqrt(2.0)
            self._alive()
        return certain
