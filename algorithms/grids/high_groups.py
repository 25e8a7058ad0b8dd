"""Small groups of points far above everything round them: birds, clouds, faults of the sensor."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core.points import Points
from .cells import Cells, lower_at, spacing
from .morphology import within_square

_SPACINGS = 5.0  # least side of a cell in spacings of the points
_ROW_RISE = 2.0  # metres by which neighbouring groups of a row may differ in height at any distance
_MOST_ROUNDS = 8  # largest number of groups above one another in one place


@dataclass(frozen=True)
class HighGroups:
    """A small group of points is high noise if it lies far above all others round it."""

    # Trees, masts and towers have points further down. Wires do not, but several of their groups
    # lie in a row.

    height: float = 10.0  # least height in metres above all other points, and between two groups
    points: int = 20  # largest number of points of a group
    width: float = 5.0  # largest width of a group in metres
    reach: float = 10.0  # least radius in metres of the surroundings of a group
    row: float = 25.0  # largest distance in metres of neighbouring groups of a row, such as a wire
    row_climb: float = 0.2  # largest slope between them, beyond a rise of 2 m
    row_share: float = 0.35  # largest ratio of width to length of a row, as standard deviations
    most: int = 3  # largest number of groups in a row: a row of more is an object

    def find(self, points: Points) -> np.ndarray:
        """Return which points (at least one) are high noise, bool (n,)."""
        cells = Cells.over(points, max(self.reach, _SPACINGS * spacing(points)))
        found = np.zeros(points.count, dtype=bool)
        left, near = np.arange(points.count), np.ones(cells.shape, dtype=bool)
        for _ in range(_MOST_ROUNDS):
            hanging = left[self._hanging(cells, cells.index[left], points.z[left])]
            hanging = hanging[near.ravel()[cells.index[hanging]]]
            if not len(hanging):
                break
            found[hanging] = True
            # In the next round, other groups can be found only in and beside these cells.
            near = within_square(np.maximum, cells.holding(hanging), 1)
            left = cells.points_in(within_square(np.maximum, near, 1))
            left = left[~found[left]]
        indices = np.flatnonzero(found)
        found[indices] = self._are_small(points.take(indices))
        return found

    def _hanging(self, cells: Cells, cell: np.ndarray, z: np.ndarray) -> np.ndarray:
        """Return the indices of the topmost points of cells, if they are few and lie far above all
        others round them.
        """
        top = self._highest(cells, cell, z)
        # The topmost points of a cell, and the highest of the others.
        is_topmost = z > (top - self.height).ravel()[cell]
        count = np.bincount(cell[is_topmost], minlength=top.size).reshape(top.shape)
        lowest = np.full(top.size, np.inf)
        lower_at(lowest, cell[is_topmost], z[is_topmost])
        bottom = lowest.reshape(top.shape)
        below = self._highest(cells, cell[~is_topmost], z[~is_topmost])
        few = (count > 0) & (count <= self.points) & (bottom - below >= self.height)
        # A group can lie in several cells.
        around = within_square(np.maximum, np.where(few, below, top), 1)
        few &= np.isfinite(around) & (bottom - around >= self.height)
        return np.flatnonzero(is_topmost & few.ravel()[cell])

    def _highest(self, cells: Cells, cell: np.ndarray, z: np.ndarray) -> np.ndarray:
        """Return the greatest height in each cell; minus infinity in empty cells."""
        lowest = np.full(cells.rows * cells.columns, np.inf)
        lower_at(lowest, cell, -z)
        return -lowest.reshape(cells.shape)

    def _are_small(self, points: Points) -> np.ndarray:
        """Return which points belong to small groups that are no parts of longer objects."""
        from scipy.sparse import coo_matrix
        from scipy.sparse.csgraph import connected_components
        from scipy.spatial import cKDTree

        if not points.count:
            return np.zeros(0, dtype=bool)

        def linked(places: np.ndarray, distance: float, rise: float, climb: float) -> np.ndarray:
            first, second = (
                cKDTree(places[:, :2]).query_pairs(distance, output_type="ndarray").reshape(-1, 2).T
            )
            steps = places[first] - places[second]
            along = np.hypot(steps[:, 0], steps[:, 1])
            near = np.abs(steps[:, 2]) <= rise + climb * along
            shape = (len(places),) * 2
            links = coo_matrix((np.ones(near.sum()), (first[near], second[near])), shape=shape)
            return connected_components(links, directed=False)[1]

        places = np.column_stack(points)
        group = linked(places, self.width, self.width, 0.0)
        sizes = np.bincount(group)
        low, high = (np.full((len(sizes), 2), np.inf) for _ in range(2))
        for axis in (0, 1):
            lower_at(low[:, axis], group, places[:, axis])
            lower_at(high[:, axis], group, -places[:, axis])
        small = (sizes <= self.points) & ((-high - low).max(axis=1) <= self.width)
        middles = np.column_stack([np.bincount(group, axis) / sizes for axis in places.T])
        row = linked(middles, self.row, _ROW_RISE, self.row_climb)
        for number in np.flatnonzero(np.bincount(row) > self.most):
            of_row = row == number
            across, along = np.linalg.eigvalsh(np.cov(middles[of_row, :2].T))
            small[of_row] &= across > self.row_share**2 * along
        return small[group]
