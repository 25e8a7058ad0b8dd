"""Square blocks of cells: values of blocks from those of cells, and of cells from blocks."""

from __future__ import annotations

import functools
from typing import NamedTuple

import numpy as np

from ..grids.cells import Cells
from .height_grid import HeightGrid
from .trend import between_blocks


class CellBlocks(NamedTuple):
    """Square blocks of cells, with a corner at (0, 0) of the points' frame."""

    size: float  # side in metres
    side: int  # in cells
    first: tuple[int, int]  # row and column of the first cell, within its block
    first_block: tuple[int, int]  # row and column of this block in the grid of blocks

    @classmethod
    def over(cls, cells: Cells, size: float, least: int = 2) -> CellBlocks:
        """Return blocks of about `size` metres that are at least `least` cells wide."""
        side = max(round(size / cells.size), least)
        blocks, within = zip(*(divmod(first, side) for first in cells.first))
        return cls(side * cells.size, side, within, blocks)

    def grid(self, heights: HeightGrid) -> HeightGrid:
        """Return the lowest height in each block."""
        return HeightGrid(self.lowest(heights.values), self.size, self.first_block)

    def lowest(self, heights: np.ndarray) -> np.ndarray:
        """Return the lowest height in each block; NaN in empty blocks."""
        lowest = self._reduced(np.minimum, np.where(np.isnan(heights), np.inf, heights), np.inf)
        lowest[np.isinf(lowest)] = np.nan
        return lowest

    def total(self, counts: np.ndarray) -> np.ndarray:
        """Return the sum of the cells' counts in each block."""
        return self._reduced(np.add, counts, 0)

    def repeated(self, values: np.ndarray, shape: tuple[int, int]) -> np.ndarray:
        """Return a grid of the given shape in which each cell has the value of its block."""
        repeated = np.repeat(np.repeat(values, self.side, axis=0), self.side, axis=1)
        return repeated[self._cells(shape)]

    def interpolated(self, values: np.ndarray, shape: tuple[int, int]) -> np.ndarray:
        """Return a grid of the given shape, interpolated between the middles of the blocks."""
        rows, columns = (np.arange(first, first + count) for first, count in zip(self.first, shape))
        return between_blocks(values, self.side, rows, columns)

    def _reduced(self, function: np.ufunc, grid: np.ndarray, neutral: float) -> np.ndarray:
        """Reduce the cells of each block to one value."""
        shape = [
            -(-(first + count) // self.side) * self.side
            for first, count in zip(self.first, grid.shape)
        ]
        padded = np.full(shape, neutral, dtype=grid.dtype)
        padded[self._cells(grid.shape)] = grid
        # By slices, because NumPy is slow at reducing short axes.
        rows = functools.reduce(
            function, (padded[start :: self.side] for start in range(self.side))
        )
        return functools.reduce(
            function, (rows[:, start :: self.side] for start in range(self.side))
        )

    def _cells(self, shape: tuple[int, int]) -> tuple[slice, ...]:
        return tuple(slice(first, first + count) for first, count in zip(self.first, shape))
