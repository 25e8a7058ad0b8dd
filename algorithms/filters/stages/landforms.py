"""Land that looks like objects: steps on slopes, rocks and low banks."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...grids.cell_blocks import CellBlocks
from ...grids.height_grid import HeightGrid
from ...grids.morphology import within_square
from ..pipeline import Rule
from .regions import RaisedRegions


@dataclass(frozen=True)
class OnSlope(Rule):
    """An exception: a step with two more alike steps before or after it is part of a slope."""

    # Cells without a point do not count, except one among wide cells: their filling makes a slope
    # of any wall. Where narrow cells have no point, blocks of them are tested as well.

    # Steps are alike if the smallest is at least this share of the largest. The second is for steps
    # that cross a cell without a point, or are between blocks of cells.
    alike: float = 0.4
    alike_across: float = 0.55
    # Least side in metres of wide cells. Of four wide cells on a slope one may have no point: its
    # filling spreads the drop at a wall over two cells, not over three.
    wide: float = 2.0
    # Cells along the side of the blocks that are tested where narrow cells have no point.
    block: int = 2
    # In cells narrower than this, in metres, no step is part of a slope: in points from images
    # three steps of half a metre can be the side of a machine.
    narrowest: float = 1.0

    def spared(
        self, grid: HeightGrid, filled: np.ndarray, one: np.ndarray, axis: int
    ) -> np.ndarray:
        """Return which steps, from cells `one` of the flattened grid north (axis 0) or east (1),
        are part of a slope.
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
        """Return which steps have two more that are alike by at least a share, and which are near a
        cell without a point.
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


@dataclass(frozen=True)
class Rocks(Rule):
    """A region that rises more unevenly than roofs, bridges and woods is a rock."""

    # A roof or a bridge is level; a wood on a slope is equally high above the ground everywhere.

    area: float = 200.0  # least area in square metres
    # Least standard deviation in metres of its heights, and of its heights above the ground.
    deviation: float = 5.0
    # A roof is lower, or level: then a band of so many metres holds more than this share of its
    # cells.
    band: float = 3.0
    band_share: float = 1.0 / 3.0

    def fits(self, regions: RaisedRegions) -> np.ndarray:
        """Return which regions are rocks; boolean, shape (regions,)."""
        number, count = regions.number, np.bincount(regions.number)
        is_rock = regions.area >= self.area
        for values in (regions.heights, regions.heights_above):
            mean = np.bincount(number, values) / count
            square = (values - mean[number]) * values
            is_rock &= np.bincount(number, square) >= self.deviation**2 * count
        for rock in np.flatnonzero(is_rock):
            z = np.sort(regions.heights[number == rock])
            in_band = np.searchsorted(z, z + self.band) - np.arange(len(z))
            is_rock[rock] = in_band.max() <= self.band_share * len(z)
        return is_rock


@dataclass(frozen=True)
class LowBanks(Rule):
    """A low, narrow and even strip is a bank of a field, a dyke or the rim of a ditch."""

    # Of a hedge or a wall, cells have points on the ground beside it; of a row of cars, they are
    # not even. Platforms of ISPRS sample 42 need it.

    area: float = 20.0  # least area in square metres
    height: float = 1.2  # largest mean height above the ground in metres
    width: float = 6.0  # largest mean width in metres
    even_share: float = 0.7  # least share of the cells that are even
    # On a larger share of its border than this, another strip as high is beside it: it is one of a
    # row, as of panels or planters. 1 if that does not matter.
    most_in_row: float = 0.8
    beyond: float = 0.35  # the strip beside it may be lower by this share of the drop between them

    def fits(self, regions: RaisedRegions) -> np.ndarray:
        """Return which regions are banks; boolean, shape (regions,)."""
        count = len(regions.area)
        sides = np.zeros(count)
        for kinds in regions.borders:
            for first, _ in kinds:
                sides += np.bincount(first, minlength=count)
        width = 2.0 * regions.area / np.maximum(sides * regions.size, regions.size)
        region = regions.number
        share = np.bincount(region, regions.even, count) / np.bincount(region, minlength=count)
        is_bank = (regions.area >= self.area) & (width <= self.width)
        if self.most_in_row < 1.0:
            is_bank &= ~self._in_rows(regions)
        return is_bank & (regions.above <= self.height) & (share >= self.even_share)

    def _in_rows(self, regions: RaisedRegions) -> np.ndarray:
        """Return which regions have another as high beside them on most of their border."""
        number = np.zeros(regions.shape, dtype=np.int32)
        number.ravel()[regions.cells] = regions.number + 1
        filled, reach = regions.filled, max(round(self.width / regions.size / 2.0), 1)
        closed = within_square(np.minimum, within_square(np.maximum, filled, reach), reach)
        into, border = np.zeros((2, len(regions.area) + 1))
        for ahead, behind in ((np.s_[1:], np.s_[:-1]), (np.s_[:, 1:], np.s_[:, :-1])):
            for here, there in ((ahead, behind), (behind, ahead)):
                beside = (number[here] > 0) & (number[here] != number[there])
                of, drop = number[here][beside], (filled[here] - filled[there])[beside]
                # Of the gap to the other, the closing fills all but a share of the drop.
                is_gap = (number[there][beside] == 0) & (drop > 0.0)
                is_gap &= closed[there][beside] >= filled[here][beside] - self.beyond * drop
                border += np.bincount(of, minlength=len(border))
                into += np.bincount(of, is_gap, len(border))
        return (into > self.most_in_row * border)[1:]
