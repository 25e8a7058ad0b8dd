"""Layers of points below land: from range ambiguity, reflections, rooms and tunnels."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...core.points import Points
from ...grids.cells import Cells
from ...grids.morphology import closing_by_square, within_square
from ..height_grid import HeightGrid
from ..pipeline import PointRule, Stage, warn_of_outliers
from ..state import State
from .low_noise import nearest_and_apart


@dataclass(frozen=True)
class BelowLand(PointRule):
    """Points below land are low noise if the land round them goes on above them."""

    # Above a real pit there is nothing at the height of the land, or leaves, and no level of
    # leaves has as many points as the land.

    stage: ClassVar = Stage.LOW_NOISE
    writes: ClassVar = ("points", "grids", "low_noise")

    # Least side of the cells whose lowest points are compared, in metres and in spacings of the
    # points.
    cell: float = 2.0
    spacings: float = 3.0
    width: float = 60.0  # largest width of a layer in metres
    depth: float = 1.5  # least depth in metres below the land
    level: float = 0.3  # largest distance in metres of a point of the land from its surface
    # Least number of points of the land in a cell, as a share of the usual number of points.
    dense: float = 0.4
    covered: float = 0.8  # least share of the cells of a layer that have as many
    beside: int = 3  # distance in cells up to which cells belong to one layer
    # Largest median distance of its points from the nearest point of the land above, in median
    # distances of the land's points: above a real pit, the nearest points are beside it.
    nearest: float = 1.65

    def apply(self, state: State) -> None:
        """Add the layers to the low noise."""
        side = max(self.cell, self.spacings * state.spacing)
        cells = state.grids[0].cells.wider(state.points, side)
        found = self.find(state.points, cells)
        if found.any():
            low = int(np.count_nonzero(cells.holding(found)))
            warn_of_outliers(int(np.count_nonzero(cells.occupied)), low, state.progress)
        state.add_low_noise(found)

    def find(self, points: Points, cells: Cells) -> np.ndarray:
        """Return which points (n,) belong to a layer, given wide cells."""
        from scipy import ndimage

        found = np.zeros(points.count, dtype=bool)
        grid = HeightGrid(cells.minimum(points.z), cells.size, cells.first)
        low, land, usual = self._low(grid, cells.counts)
        if not low.any():
            return found
        which = cells.points_in(low)
        which = which[np.isfinite(points.z[which])]
        index = cells.index[which]
        above = points.z[which] - cells.interpolated(land, points.x[which], points.y[which])
        on_land = np.abs(above) <= self.level
        counts = np.bincount(index[on_land], minlength=low.size).reshape(low.shape)
        number, layers = ndimage.label(within_square(np.maximum, low, self.beside))
        total, covered = (
            np.bincount(number[some], minlength=layers + 1)
            for some in (low, low & (counts >= self.dense * usual))
        )
        layer = number.ravel()[index]
        for each in np.flatnonzero((covered >= self.covered * total) & (total > 0)):
            here = layer == each
            below = which[here & (above < -0.5 * self.depth)]
            found[below] = self._is_above(points, which[here & on_land], below)
        return found

    def _low(self, grid: HeightGrid, counts: np.ndarray) -> tuple[np.ndarray, np.ndarray, float]:
        """Return the cells whose lowest point is far below the land round them, the heights of the
        land, and the usual number of points in a cell of it.
        """
        filled = grid.filled()
        reach = max(math.ceil(self.width / grid.size / 2.0), 1)
        deep = closing_by_square(filled, reach) - filled > self.depth
        if not deep.any() or not (grid.known & ~deep).any():
            return np.zeros(deep.shape, dtype=bool), filled, 0.0
        land = grid.where(~within_square(np.maximum, deep, 1)).filled()
        low = deep & grid.known & (filled < land - self.depth)
        return low, land, float(np.median(counts[grid.known & ~deep]))

    def _is_above(self, points: Points, land: np.ndarray, low: np.ndarray) -> bool:
        """Return whether points of the land lie above low points, and not beside them."""
        if len(land) < 2 or not len(low):
            return False
        ground, below = (np.column_stack((points.x[some], points.y[some])) for some in (land, low))
        nearest, apart = nearest_and_apart(below, ground)
        return nearest <= self.nearest * apart
