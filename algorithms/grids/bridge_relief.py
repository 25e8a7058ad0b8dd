"""The heights of cells from which bridge decks are found, with small gaps filled."""

from __future__ import annotations

import itertools
import math
from typing import NamedTuple

import numpy as np

from ..core.points import Points
from .cells import Cells, spacing

# Least side of a cell in metres. Where points are sparse, it is half of their spacing, rounded to
# the step in metres.
_CELL = 1.0
_CELL_STEP = 0.5
# Step in metres to which the spacing is rounded. It is small, because the largest rise of a surface
# depends on the spacing.
_SPACING_STEP = 0.25
# Distance in spacings up to which an empty cell gets the height of the nearest one with a point.
_FILLED = 1.5
# Largest rise of a surface from point to point in metres, and what each metre between them adds.
STEP = 0.2
STEP_SLOPE = 0.2
# Width of the border in metres, beside the spacing: the distance up to which cells are tested.
BORDER = 15.0


class BridgeRelief(NamedTuple):
    """Heights on a grid, with a border of unknown cells."""

    cell: float  # side of a cell in metres
    spacing: float  # spacing of the points in metres, at least a cell
    border: int  # width of the border in cells
    # 0 or 1: added to row and column, so that the same cells are even wherever the grid begins.
    parity: int
    level: float  # metres to add to the heights
    # float32 (rows, columns): Height of the lowest ground point, or else of the lowest point; NaN
    # if none is near.
    heights: np.ndarray
    is_ground: np.ndarray  # bool (rows, columns): Whether this is the height of ground
    # Whether decks may have been removed from the ground before. Then the height of cells without
    # ground is the median, because the lowest points at the sides of a deck lie below it.
    is_cleared: bool = False

    @classmethod
    def over(
        cls, points: Points, ground: np.ndarray, is_cleared: bool = False
    ) -> tuple[BridgeRelief, Cells]:
        """Return the relief of ground and other points, and their cells."""
        apart = spacing(points, step=_SPACING_STEP)
        cells = Cells.over(points, max(_CELL, _CELL_STEP * round(apart / 2.0 / _CELL_STEP)))
        lowest = cells.minimum(points.z, np.flatnonzero(ground))
        is_ground = np.isfinite(lowest)
        # Other points count only in cells without ground.
        others = np.flatnonzero(~ground)
        others = others[~is_ground.ravel()[cells.index[others]]]
        height_of = _medians if is_cleared else Cells.minimum
        lowest = np.fmin(lowest, height_of(cells, points.z, others))
        level = float(np.floor(np.nanmin(lowest)))
        heights = (lowest - level).astype(np.float32)
        apart = max(apart, cells.size)
        border = math.ceil((BORDER + apart) / cells.size) + 2
        heights = np.pad(heights, border, constant_values=np.nan)
        parity = (cells.first_row + cells.first_column) % 2
        is_ground = np.pad(is_ground, border)
        relief = cls(cells.size, apart, border, parity, level, heights, is_ground, is_cleared)
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


def _medians(cells: Cells, z: np.ndarray, indices: np.ndarray) -> np.ndarray:
    """Return the median of some points in each cell, the lower one of two; NaN without any."""
    heights = np.full(cells.rows * cells.columns, np.nan)
    index = cells.index[indices]
    order = np.lexsort((z[indices], index))
    codes, starts, counts = np.unique(index[order], return_index=True, return_counts=True)
    heights[codes] = z[indices[order[starts + (counts - 1) // 2]]]
    return heights.reshape(cells.shape)


def _filled(relief: BridgeRelief, farthest: float) -> BridgeRelief:
    """Return a relief with unknown cells filled from the nearest known one, if it is near."""
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
