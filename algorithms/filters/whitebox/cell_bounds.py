"""Find points that stand far above a neighbour, as far as the cells of a grid show it.

Bounds from the lowest step of each cell decide nearly all points, at the cost of a few erosions of
a grid.
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
        Least difference in height in metres.
    slope : float
        The rise over run must be more than this. The same neighbour must meet height and slope.
    top_hat : bool
        Whether heights above the opening are compared (white top-hat). The opening is the highest
        erosion among the neighbours.
    """

    radius: float
    height: float
    slope: float
    top_hat: bool


class CellBounds:
    """Bounds for all points of a cell: of their opening, and of heights that decide.

    Without `Rule.top_hat` there is no erosion, and the height at which the steps begin is used as
    the opening of all points.

    Parameters
    ----------
    points : Points
        The points asked for, and their neighbours of the first, second and third degree.
    rule : Rule
        When a point stands far above a neighbour.
    alive : callable
        Called several times a second. An exception that it raises ends the work.

    Attributes
    ----------
    points : SortedPoints
        The points, in the order of this class.
    rule : Rule
        When a point stands far above a neighbour.
    least : numpy.ndarray of int16, shape (rows, columns)
        Least number of steps by which the lowest point of each cell lies above the opening.
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
        """Return which points asked for certainly stand far above a neighbour, and which may.

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
        """Return a lower bound, in metres, of the opening at the points of cells (k,)."""
        return self.points.metres(self._low.take(cell)) - ROUNDING

    def highest_opening(self, cell: np.ndarray) -> np.ndarray:
        """Return an upper bound, in metres, of the opening at the points of cells (k,)."""
        return self.points.metres(self._high.take(cell) + 1.0) + ROUNDING

    def heights_in_doubt(self, cell: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the heights above the opening, in metres, between which points are in doubt.

        For points in cells (k,): a point lower than the first stands above no neighbour; a point as
        high as the second, or higher, stands above one.
        """
        needed = self._too_little.take(cell) - self._low.take(cell) + 1
        certain = self._enough.take(cell) - self._high.take(cell) - 1
        step = self.points.step
        return needed * step - ROUNDING, certain * step + ROUNDING

    def _bound_opening(self) -> None:
        """Find the lowest and the highest step of the erosion and of the opening of cells."""
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
        """Find the steps from which on points certainly stand above others, and up to which not."""
        lowest = self.points.table.lowest.reshape(self.points.shape)
        empty = lowest == EMPTY
        # The lowest point of a cell lies at least `least` steps above the opening, but less than
        # `most`.
        self.least = np.maximum(lowest - self._high - 1, 0)
        most = lowest - self._low + 1
        self.least[empty] = most[empty] = EMPTY
        self._too_little = self._impossible() + self._low - 1
        self._enough = self._certain(most) + self._high + 1

    def _impossible(self) -> np.ndarray:
        """Return the steps above the opening up to which no point of a cell stands above others."""
        points, rule, radius = self.points, self.rule, self.rule.radius
        impossible = np.full(points.shape, 2 * EMPTY, dtype=np.int32)
        while True:
            # Nearer neighbours are tested with smaller discs.
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
        """Return the steps above the opening from which on all points of a cell stand above one."""
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
