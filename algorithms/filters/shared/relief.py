"""Heights on a grid: of the ground where there is any, else of what is lowest; gaps filled."""

from __future__ import annotations

import itertools
import math
from typing import NamedTuple

import numpy as np

from ...core.points import Points
from ...grids.cells import Cells, spacing

# Least side of a cell in metres; half the spacing of the points where they are sparse, in steps.
_CELL, _CELL_STEP = 1.0, 0.5
# Steps of the spacing in metres: finer than elsewhere, as it tells how far a surface may rise.
_SPACING_STEP = 0.25
# A cell has the height of the nearest one that has a point, up to so many spacings off.
_FILLED = 1.5
# A surface may rise so much from point to point (m, and m a metre) to be one.
STEP, STEP_SLOPE = 0.2, 0.2
# Cells of the border, in metres beyond the spacing: what is looked at round a cell.
BORDER = 10.0


class Relief(NamedTuple):
    """Heights on a grid, with a border of unknown cells.

    Attributes
    ----------
    cell, spacing : float
        Side of a cell, and the distance between points if that is larger, in metres.
    border : int
        Cells of the border.
    parity : int
        0 or 1, so that a cell is even or odd wherever the grid begins.
    level : float
        What is to be added to the heights, in metres.
    heights : numpy.ndarray of float32, shape (rows, columns)
        Of the lowest ground, else of the lowest point; NaN where there is none near.
    is_ground : numpy.ndarray of bool, shape (rows, columns)
        Whether it is ground.
    """

    cell: float
    spacing: float
    border: int
    parity: int
    level: float
    heights: np.ndarray
    is_ground: np.ndarray

    @classmethod
    def over(cls, points: Points, ground: np.ndarray) -> tuple[Relief, Cells]:
        """Return the relief of some points, of which some are ground, and their cells."""
        apart = spacing(points, step=_SPACING_STEP)
        cells = Cells.over(points, max(_CELL, _CELL_STEP * round(apart / 2.0 / _CELL_STEP)))
        lowest = cells.minimum(points.z, np.flatnonzero(ground))
        is_ground = np.isfinite(lowest)
        # Other points count only where there is no ground.
        others = np.flatnonzero(~ground)
        others = others[~is_ground.ravel()[cells.index[others]]]
        lowest = np.fmin(lowest, cells.minimum(points.z, others))
        level = float(np.floor(np.nanmin(lowest)))
        heights = (lowest - level).astype(np.float32)
        apart = max(apart, cells.size)
        border = math.ceil((BORDER + apart) / cells.size) + 2
        heights = np.pad(heights, border, constant_values=np.nan)
        parity = (cells.first_row + cells.first_column) % 2
        is_ground = np.pad(is_ground, border)
        relief = cls(cells.size, apart, border, parity, level, heights, is_ground)
        return _filled(relief, _FILLED * apart / cells.size), cells

    @property
    def apart(self) -> int:
        """The spacing in cells."""
        return round(self.spacing / self.cell)

    @property
    def step(self) -> float:
        """How much a surface may rise from point to point, in metres."""
        return STEP + STEP_SLOPE * self.spacing

    def inside(self, grid: np.ndarray) -> np.ndarray:
        """Return a grid of the same shape without the border."""
        return grid[self.border : -self.border, self.border : -self.border]

    def is_outside(self, row: np.ndarray, column: np.ndarray) -> np.ndarray:
        """Return which cells lie in the border or beyond."""
        rows, columns = (side - self.border for side in self.heights.shape)
        outside = (row < self.border) | (row >= rows)
        return outside | (column < self.border) | (column >= columns)


def _filled(relief: Relief, farthest: float) -> Relief:
    """Return a relief whose unknown cells are as the nearest known one, up to so many cells off."""
    heights, is_ground = relief.heights.ravel().copy(), relief.is_ground.ravel().copy()
    rows, columns = relief.heights.shape
    reach = int(farthest)
    offsets = [
        (math.hypot(up, right), up * columns + right)
        for up, right in itertools.product(range(-reach, reach + 1), repeat=2)
    ]
    inner = np.zeros(relief.heights.shape, dtype=bool)
    relief.inside(inner)[:] = True
    left = np.flatnonzero(np.isnan(heights) & inner.ravel())
    for distance, offset in sorted(offsets)[1:]:
        if distance > farthest or not len(left):
            break
        there = relief.heights.ravel()[left + offset]
        found = np.isfinite(there)
        heights[left[found]] = there[found]
        is_ground[left[found]] = relief.is_ground.ravel()[left[found] + offset]
        left = left[~found]
    return relief._replace(
        heights=heights.reshape(rows, columns), is_ground=is_ground.reshape(rows, columns)
    )
