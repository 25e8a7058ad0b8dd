"""The lowest points of cells, and the planes through those round a place.

If roofs or crowns are among the lowest points, the plane goes through those of the ground.
"""

from __future__ import annotations

from typing import Iterator, NamedTuple

import numpy as np

from ..core.points import Points
from ..core.threads import parts_of
from ..grids.cells import Cells
from ..grids.gradient import gradient
from ..grids.inpaint import inpaint
from ..grids.morphology import closing_by_square, median_of_nine, within_square

SIDES = 8  # number of directions into which the surroundings are divided
# Robust fit of a plane: quantile of the heights at which it starts, below roofs and crowns; number
# of rounds, and of the first ones, in which heights far from the plane still have weight.
_START = 0.3
_ROUNDS = 6
_WIDE_ROUNDS = 2
# Scale of the weights, in median misfits, in the first rounds and in the others; and the least
# scale in metres.
_WIDE = 3.0
_NARROW = 2.0
_EXACT = 0.1
_SLOPE_CELLS = 5  # side in cells of the squares over which the slope of the terrain is averaged
_PLACES_A_PART = 2048  # places whose surroundings are computed at a time


class LowestNeighbours(NamedTuple):
    """The lowest points round some places; arrays of shape (places, neighbours)."""

    centre: tuple[np.ndarray, np.ndarray, np.ndarray]  # x, y and z of the places, (places,)
    # float32: Relative to the place; 0 where no neighbour is known.
    x: np.ndarray
    y: np.ndarray
    z: np.ndarray
    distance: np.ndarray  # float32: Horizontal distance from the place
    side: np.ndarray  # int8: Direction from the place, 0 to 7
    known: np.ndarray  # bool: Where there is a point that is not too near to the place

    def plane(self) -> tuple[np.ndarray, np.ndarray]:
        """Return the plane through most of the heights round each place (slopes to east and north,
        metres above the place), and the heights of its neighbours above the plane.
        """
        # Least squares with the weights of Geman and McClure, from a level plane under most.
        count = len(self.z)
        plane = np.zeros((count, 3), dtype=np.float32)
        plane[:, 2] = np.nan_to_num(self._quantile(self.z, _START), posinf=0.0)
        for number in range(_ROUNDS):
            misfit = self._above(plane)
            scale = self.median(np.abs(misfit))
            scale *= _WIDE if number < _WIDE_ROUNDS else _NARROW
            weights = 1.0 + (misfit / np.maximum(scale, _EXACT)[:, None]) ** 2
            plane = self._fitted(np.where(self.known, weights**-2.0, 0.0))
        return plane, self._above(plane)

    def median(self, values: np.ndarray, counted: np.ndarray | None = None) -> np.ndarray:
        """Return the median of the values at neighbours of each place, the lower one of two;
        infinite without any.
        """
        return self._quantile(values, 0.5, counted)

    def sides_with(self, wanted: np.ndarray) -> np.ndarray:
        """Return the number of sides of each place on which at least half of the neighbours are
        wanted.
        """
        sides = np.zeros(len(wanted), dtype=np.int8)
        for side in range(SIDES):
            here = self.known & (self.side == side)
            known = np.count_nonzero(here, axis=1)
            sides += (2 * np.count_nonzero(here & wanted, axis=1) >= known) & (known > 0)
        return sides

    def _above(self, plane: np.ndarray) -> np.ndarray:
        east, north, height = plane.T[:, :, None]
        return self.z - (self.x * east + self.y * north + height)

    def _quantile(
        self, values: np.ndarray, share: float, counted: np.ndarray | None = None
    ) -> np.ndarray:
        """Return a quantile of the values at neighbours of each place; infinite without any."""
        counted = self.known if counted is None else counted
        ordered = np.sort(np.where(counted, values, np.inf), axis=1)
        last = np.maximum(np.count_nonzero(counted, axis=1) - 1, 0)
        return ordered[np.arange(len(ordered)), np.floor(share * last).astype(np.intp)]

    def _fitted(self, weights: np.ndarray) -> np.ndarray:
        """Return the planes of weighted least squares."""
        columns = self.x, self.y, np.ones_like(self.x)
        normal, right = np.zeros((len(weights), 3, 3)), np.zeros((len(weights), 3, 1))
        for i, column in enumerate(columns):
            weighted = weights * column
            right[:, i, 0] = np.einsum("pn,pn->p", weighted, self.z)
            for k in range(i, 3):
                normal[:, i, k] = normal[:, k, i] = np.einsum("pn,pn->p", weighted, columns[k])
        # With these terms, a place with fewer than three neighbours has a plane as well.
        normal += 1e-6 * np.eye(3)
        return np.linalg.solve(normal, right)[:, :, 0].astype(np.float32)


class LowestOfCells(NamedTuple):
    """The coordinates of the lowest point of each cell, on grids with a margin of empty cells."""

    # float64 (rows, columns): NaN in empty cells.
    x: np.ndarray
    y: np.ndarray
    z: np.ndarray
    margin: int  # cells of margin, the radius of the surroundings

    @classmethod
    def of(
        cls, points: Points, cells: Cells, margin: int, lowest: np.ndarray | None = None
    ) -> LowestOfCells:
        """Return the lowest points of cells; `lowest` are their indices, if they are known."""
        if lowest is None:
            lowest = cells.lowest_points(points)
        row, column = np.divmod(cells.index[lowest], cells.columns)
        shape = cells.rows + 2 * margin, cells.columns + 2 * margin
        x, y, z = grids = np.full((3, *shape), np.nan)
        grids[:, row + margin, column + margin] = points.take(lowest)
        return cls(x, y, z, margin)

    def pits(self, cells: Cells, depth: float, reach: int) -> np.ndarray:
        """Return the cells that a closing raises by more than a depth in metres; of those within
        `reach` cells only the deepest and the lowest.
        """
        inner = (slice(self.margin, -self.margin),) * 2
        known = np.isfinite(self.z[inner])
        filled = inpaint(self.z[inner], first=cells.first)
        filled -= self._beside_centre(cells, filled)
        raised = np.where(known, closing_by_square(filled, reach) - filled, 0.0)
        pits = raised >= within_square(np.maximum, raised, reach)
        pits |= filled <= within_square(np.minimum, filled, reach)
        return self.places(pits & (raised > depth))

    def places(self, cells: np.ndarray) -> np.ndarray:
        """Return the indices of the marked cells (rows, columns) in the flattened grids."""
        row, column = np.nonzero(cells)
        return (row + self.margin) * self.z.shape[1] + column + self.margin

    def _beside_centre(self, cells: Cells, filled: np.ndarray) -> np.ndarray:
        """Return how many metres the terrain at each lowest point is higher than at the centre of
        its cell.
        """
        # On a slope, the lowest point lies on the lower side of the cell, near its border or not.
        from scipy import ndimage

        inner = (slice(self.margin, -self.margin),) * 2
        smooth = ndimage.uniform_filter(median_of_nine(filled.astype(np.float32)), _SLOPE_CELLS)
        north, east = gradient(smooth, cells.size)
        y, x = (
            axis[inner] - (first + np.arange(count) + 0.5).reshape(shape) * cells.size
            for axis, first, count, shape in zip(
                (self.y, self.x), cells.first, cells.shape, ((-1, 1), (1, -1))
            )
        )
        return np.nan_to_num(east * x + north * y)

    def around(self, places: np.ndarray, width: float) -> Iterator[LowestNeighbours]:
        """Yield the surroundings of cells (indices as of `pits`), some cells at a time, without
        points nearer than `width` metres.
        """
        steps = np.arange(-self.margin, self.margin + 1)
        row, column = (axis.ravel() for axis in np.meshgrid(steps, steps, indexing="ij"))
        disc = (row**2 + column**2 <= self.margin**2) & ((row != 0) | (column != 0))
        offsets = (row * self.z.shape[1] + column)[disc]
        for part in parts_of(len(places), _PLACES_A_PART):
            yield self._around(places[part], offsets, width)

    def _around(self, places: np.ndarray, offsets: np.ndarray, width: float) -> LowestNeighbours:
        there = places[:, None] + offsets
        centre = tuple(grid.ravel()[places] for grid in (self.x, self.y, self.z))
        x, y, z = (
            (grid.ravel()[there] - place[:, None]).astype(np.float32)
            for grid, place in zip((self.x, self.y, self.z), centre)
        )
        distance = np.hypot(x, y)
        known = distance > width  # False for NaN
        x, y, z, distance = (np.where(known, axis, np.float32(0.0)) for axis in (x, y, z, distance))
        side = np.floor((np.arctan2(y, x) / np.pi + 1.0) * (0.5 * SIDES)).astype(np.int8) % SIDES
        return LowestNeighbours(centre, x, y, z, distance, side, known)
