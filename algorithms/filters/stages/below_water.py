"""Returns below a water surface: noise of the sensor, and light that was reflected twice."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...core.points import Points
from ...grids.cells import Cells, first_of_each
from ...grids.morphology import within_square
from ..pipeline import PointRule, Stage
from ..state import State
from .surroundings import LowestOfCells, Surroundings

# Least side in metres of the cells of which the lowest points are looked at.
_FINE = 1.0
# Fewest heights on a water surface that show its level.
_LEAST_HEIGHTS = 6


@dataclass(frozen=True)
class BelowWater(PointRule):
    """Points scattered below a level water surface are low noise."""

    # Water returns few pulses. Where points are sparse and many of them lie at one level, with land
    # as high or higher round them, nothing below is terrain. Terrain that is lower, as behind a
    # dam, has as many points as other land.

    stage: ClassVar = Stage.LOW_NOISE
    reads: ClassVar = ("points", "grids", "known_ground")
    writes: ClassVar = ("points", "grids", "low_noise")

    # Sides of the cells that are looked at, one after the other, in metres, or as multiples of the
    # usual distance between points if that is larger. The wider ones are for few returns.
    sizes: tuple[float, ...] = (4.0, 8.0)
    reach: int = 4  # radius of the surroundings in cells
    sparse: float = 0.5  # water has less than this share of the usual number of points
    # At least this share of the heights lie within so many metres of each other.
    band: float = 0.1
    least_share: float = 0.4
    # Other heights may be lower than the water by so many metres without being below it.
    shore: float = 0.25
    sides: int = 6  # on so many of eight sides, half of the heights must not be below the water
    depth: float = 0.4  # least depth in metres of noise below the water
    most: float = 0.1  # noise has less than this share of the usual number of points

    def apply(self, state: State) -> None:
        """Add the points below water to the low noise."""
        for size in self.sizes:
            lowest, points = state.grids[0].lowest, state.points
            lowest = lowest[np.isfinite(points.z[lowest])]
            state.add_low_noise(self.find(points, lowest, state.spacing, size))

    def find(self, points: Points, lowest: np.ndarray, spacing: float, size: float) -> np.ndarray:
        """Return which points (n,) lie below water, in wide cells of so many metres, or spacings if
        that is more; infinitely high points do not count.
        """
        # The highest of the lowest points of narrow cells in each wide cell is one of the surface;
        # the level of the water is where most of these are close together.
        from scipy import ndimage

        cells = Cells.over(points, size * max(_FINE, spacing))

        def density(which: np.ndarray) -> np.ndarray:
            """Return the share of the usual number of points in each cell and those round it."""
            count = np.bincount(cells.index[which], minlength=cells.rows * cells.columns)
            share = count.reshape(cells.shape) * (spacing / cells.size) ** 2
            return ndimage.uniform_filter(share, 3, mode="nearest")

        looked_at = density(np.isfinite(points.z)) < self.sparse
        looked_at &= self._deep(points, cells, lowest)
        if not looked_at.any():
            return np.zeros(points.count, dtype=bool)
        z, x, y = (-points.z[lowest], points.x[lowest], points.y[lowest])
        upper = lowest[first_of_each(cells.index[lowest], looked_at.size, z, x, y)]
        grids = LowestOfCells.of(points, cells, self.reach, upper)
        limit = np.full(cells.shape, -np.inf)
        limit[looked_at] = np.concatenate(
            [self._limits(around) for around in grids.around(grids.places(looked_at), 0.0)]
        )
        # Cells along the shore have too few points of the water to show its level.
        near, far = (
            np.where(np.isfinite(limit), limit, within_square(np.maximum, limit, cells_away))
            for cells_away in (1, 2)
        )
        below, wider = (points.z < each.ravel().take(cells.index) for each in (near, far))
        return below & (density(wider) < self.most).ravel().take(cells.index)

    def _deep(self, points: Points, cells: Cells, lowest: np.ndarray) -> np.ndarray:
        """Return the cells with points that lie below the highest beside; shape (rows, columns)."""
        z, index = points.z[lowest], cells.index[lowest]
        deepest, highest = (np.full(cells.rows * cells.columns, sign * np.inf) for sign in (1, -1))
        np.minimum.at(deepest, index, z)
        np.maximum.at(highest, index, z)
        beside = within_square(np.maximum, highest.reshape(cells.shape), 1)
        return deepest.reshape(cells.shape) < beside - self.depth

    def _limits(self, around: Surroundings) -> np.ndarray:
        """Return the height below which points are noise in each place; -inf where no water is."""
        z = np.sort(np.where(around.known, around.z, np.inf), axis=1)
        known = np.count_nonzero(around.known, axis=1)
        needed = np.maximum(np.ceil(self.least_share * known).astype(np.intp), _LEAST_HEIGHTS)
        last = np.arange(z.shape[1]) + needed[:, None] - 1
        top = np.take_along_axis(z, np.minimum(last, z.shape[1] - 1), axis=1)
        with np.errstate(invalid="ignore"):
            width = np.where(last < known[:, None], top - z, np.inf)
        first = width.argmin(axis=1)[:, None]
        narrowest = np.take_along_axis(width, first, axis=1)
        is_level = narrowest[:, 0] <= self.band
        level = np.where(is_level[:, None], np.take_along_axis(z, first, axis=1) + narrowest / 2, 0)
        fits = around.known & (around.z >= level - self.shore)
        is_water = is_level & (around.sides_with(fits) >= self.sides)
        return np.where(is_water, around.centre[2] + level[:, 0] - self.depth, -np.inf)
