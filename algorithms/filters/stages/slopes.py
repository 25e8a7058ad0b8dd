"""Steps of a height grid that are part of a slope."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...grids.cell_blocks import CellBlocks
from ...grids.height_grid import HeightGrid
from ..pipeline import Rule, Stage


@dataclass(frozen=True)
class OnSlope(Rule):
    """An exception: a step with two more alike steps before or after it is part of a slope.

    Cells without a point do not count, except one among wide cells: their filling makes a slope of
    any wall. Where narrow cells have no point, blocks of them are tested as well.

    Attributes
    ----------
    alike, alike_across : float
        Steps are alike if the smallest is at least this share of the largest. The second is for
        steps that cross a cell without a point, or are between blocks of cells.
    wide : float
        Least side in metres of wide cells. Of four wide cells on a slope one may have no point: its
        filling spreads the drop at a wall over two cells, not over three.
    block : int
        Cells along the side of the blocks that are tested where narrow cells have no point.
    """

    stage: ClassVar = Stage.TERRAIN

    alike: float = 0.4
    alike_across: float = 0.55
    wide: float = 2.0
    block: int = 2

    def spared(
        self, grid: HeightGrid, filled: np.ndarray, one: np.ndarray, axis: int
    ) -> np.ndarray:
        """Return which steps are part of a slope.

        Parameters
        ----------
        grid : HeightGrid
            Lowest heights.
        filled : numpy.ndarray of float, shape (rows, columns)
            The same with gaps filled.
        one : numpy.ndarray of intp, shape (steps,)
            Cells from which the steps lead, as indices into the flattened grid.
        axis : int
            0 if the steps lead north, 1 if they lead east.

        Returns
        -------
        numpy.ndarray of bool, shape (steps,)
        """
        known, size, first = grid.known, grid.size, grid.origin
        on, beside_gap = self._among_alike(filled, known, one, axis, size, self.alike)
        left = np.flatnonzero(beside_gap & ~on)
        if size >= self.wide or not len(left):
            return on
        number, within = zip(*(divmod(each, self.block) for each in first))
        blocks = CellBlocks(self.block * size, self.block, within, number)
        lowest = blocks.lowest(np.where(known, filled, np.nan))
        is_known = np.isfinite(lowest)
        lowest = np.where(is_known, lowest, blocks.lowest(filled))
        cell = np.divmod(one[left], filled.shape[1])
        row, column = ((each + lead) // self.block for each, lead in zip(cell, within))
        block = row * lowest.shape[1] + column
        at_end = (cell[axis] + within[axis]) % self.block == self.block - 1
        # A step within a block is part of the step to the block or of the step from it.
        before = np.where(
            at_end | ((row, column)[axis] == 0), 0, lowest.shape[1] if axis == 0 else 1
        )
        for each in (block, block - before):
            alike = self._among_alike(lowest, is_known, each, axis, blocks.size, self.alike_across)
            on[left] |= alike[0]
        return on

    def _among_alike(
        self,
        filled: np.ndarray,
        known: np.ndarray,
        one: np.ndarray,
        axis: int,
        size: float,
        least: float,
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return which steps have two more alike steps, and which are near a cell without a point.

        `least` is the share from which on steps are alike.
        """
        offset = filled.shape[1] if axis == 0 else 1
        place, count = np.divmod(one, filled.shape[1])[axis], filled.shape[axis]
        across = np.stack(
            [one + offset * (np.clip(place + k, 0, count - 1) - place) for k in range(-2, 4)]
        )
        empty = ~known.ravel()[across]
        rises = np.diff(filled.ravel()[across], axis=0)  # the third is the step itself
        on = np.zeros(len(one), dtype=bool)
        for first in range(3):
            three, gaps = rises[first : first + 3], empty[first : first + 4]
            one_way = (three > 0).all(axis=0) | (three < 0).all(axis=0)
            one_way &= gaps.sum(axis=0) <= int(size >= self.wide)
            alike = np.where(gaps[1:3].any(axis=0), self.alike_across, least)
            three = np.abs(three)
            on |= one_way & (three.min(axis=0) >= alike * three.max(axis=0))
        return on, empty.any(axis=0)
