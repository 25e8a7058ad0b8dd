"""Raised regions that are terrain after all.

A region that an opening cuts off is terrain if it continues gently into the ground round it (a
dike, a terrace, a plateau with a ramp), or if it has the shape of a landform.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...core.progress import SILENT, Progress
from ..cell_blocks import CellBlocks
from ..height_grid import HeightGrid
from ..pipeline import GridRule, Rule, Stage
from ..state import GridState
from .raised_regions import LowBanks, RaisedRegions, Rocks, raised_regions


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

    def on_slope(
        self, grid: HeightGrid, filled: np.ndarray, cells: np.ndarray, axis: int
    ) -> np.ndarray:
        """Return which steps, from `cells` of the flattened grid north (axis 0) or east (1),
        are part of a slope.
        """
        known, size, first = grid.known, grid.size, grid.origin
        on, beside_gap = self._among_alike(filled, known, cells, axis, size, self.alike)
        left = np.flatnonzero(beside_gap & ~on)
        if size >= self.wide or not len(left):
            return on
        number, within = zip(*(divmod(number, self.block) for number in first))
        blocks = CellBlocks(self.block * size, self.block, within, number)
        lowest = blocks.lowest(np.where(known, filled, np.nan))
        is_known = np.isfinite(lowest)
        lowest = np.where(is_known, lowest, blocks.lowest(filled))
        cell = np.divmod(cells[left], filled.shape[1])
        row, column = ((number + lead) // self.block for number, lead in zip(cell, within))
        block = row * lowest.shape[1] + column
        at_end = (cell[axis] + within[axis]) % self.block == self.block - 1
        # A step within a block is part of the step to the block or of the step from it.
        before = np.where(
            at_end | ((row, column)[axis] == 0), 0, lowest.shape[1] if axis == 0 else 1
        )
        for start in (block, block - before):
            alike = self._among_alike(lowest, is_known, start, axis, blocks.size, self.alike_across)
            on[left] |= alike[0]
        return on

    def _among_alike(
        self,
        filled: np.ndarray,
        known: np.ndarray,
        cells: np.ndarray,
        axis: int,
        size: float,
        least: float,
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return which steps have two more that are alike by at least a share, and which are near a
        cell without a point.
        """
        offset = filled.shape[1] if axis == 0 else 1
        place, count = np.divmod(cells, filled.shape[1])[axis], filled.shape[axis]
        across = np.stack(
            [cells + offset * (np.clip(place + k, 0, count - 1) - place) for k in range(-2, 4)]
        )
        empty = ~known.ravel()[across]
        rises = np.diff(filled.ravel()[across], axis=0)  # the third is the step itself
        on = np.zeros(len(cells), dtype=bool)
        for first in range(3):
            three, gaps = rises[first : first + 3], empty[first : first + 4]
            one_way = (three > 0).all(axis=0) | (three < 0).all(axis=0)
            one_way &= gaps.sum(axis=0) <= int(size >= self.wide)
            alike = np.where(gaps[1:3].any(axis=0), self.alike_across, least)
            three = np.abs(three)
            on |= one_way & (three.min(axis=0) >= alike * three.max(axis=0))
        return on, empty.any(axis=0)


@dataclass(frozen=True)
class GentleBorder(Rule):
    """A region is terrain if a large share of its border is level with the ground, or less in one
    place: a plateau with a ramp.
    """

    # A region of the first area (m2) needs the first share of the border that is level or drops,
    # one of the second area the second; between them it falls with the logarithm of the area.
    areas: tuple[float, float] = (400.0, 3000.0)
    shares: tuple[float, float] = (0.3, 0.2)
    # With a smaller share, this one at the second area, a region is terrain only if its border is
    # level over `width` metres in one place: points on walls make some of the border of a roof
    # level, here and there.
    in_one_place: float = 0.05
    width: float = 4.0
    least_area: float = 100.0  # square metres: crowns and sheds are smaller
    # If the survey ends along a larger share of the border, the first share is needed: the rest of
    # a roof or of a closed canopy may lie beyond it.
    most_cut: float = 0.1
    # A region of up to `small` square metres is an object, as an A-frame or a polytunnel is, if its
    # mean height is more than `tall` metres, and more than this share of its mean width. Regions
    # that `SteepRises` or `Rims` raise are whole rocks, so only TIN densification asks for it.
    small: float = 0.0
    tall: float = 2.0
    steep: float = 0.45

    def fits(
        self, regions: RaisedRegions, ground: np.ndarray, level: np.ndarray, sharp: np.ndarray
    ) -> np.ndarray:
        """Return which regions are terrain, given which are ground, and the sides that are level or
        drop, (regions,).
        """
        area, border = regions.area, level + sharp
        cut = regions.cut > self.most_cut * (border + regions.cut)
        shares = self.shares[0], self.in_one_place
        few = np.where(cut, shares[0], np.interp(np.log(area), np.log(self.areas), shares))
        many = np.where(cut, shares[0], np.interp(np.log(area), np.log(self.areas), self.shares))
        found = (level > 0) & (level >= few * border) & (area >= self.least_area)
        tall = (area <= self.small) & (regions.above > self.tall)
        if tall.any():
            found &= ~(tall & (regions.above > self.steep * regions.mean_width))
        doubtful = found & (level < many * border)
        if doubtful.any():
            found &= ~doubtful | (regions.widths(ground) >= self.width)
        return found


@dataclass(frozen=True)
class GentleRegions(GridRule):
    """A raised region that continues gently into the ground is terrain."""

    # A region is a group of raised cells without steps between them. Its border is gentle where it
    # touches the ground without a step, and sharp where it drops.

    stage: ClassVar = Stage.TERRAIN
    writes: ClassVar = ("raised",)

    # Largest step between cells, in metres beyond the terrain's own rise, that is not an edge. It
    # is for cells of up to 1 m, and in proportion larger for larger cells.
    step: float = 0.3
    # Metres over which the surface is smoothed for the terrain's own rise, which is no step.
    smoothing: float = 2.0
    area: float = 20.0  # least area of a region in square metres
    passes: int = 4  # passes in which regions join the ground or regions that have joined it
    # Whether cells without a point are judged as well. They are raised if their filled height is,
    # and outside the survey they are no border.
    judges_gaps: bool = True
    # Whether borders show that a region is terrain in clouds from images as well, in which walls
    # are slopes.
    in_images: bool = False
    on_slope: OnSlope | None = OnSlope()
    gentle_border: GentleBorder | None = GentleBorder()
    rocks: Rocks | None = Rocks()
    low_banks: LowBanks | None = LowBanks()

    def apply(self, grid: GridState, progress: Progress = SILENT) -> None:
        """Let regions be ground that are terrain; objects only where they are landforms."""
        regions = self.regions(grid)
        landforms = np.zeros(len(regions.area), dtype=bool)
        for rule in (self.rocks, self.low_banks):
            if rule:
                landforms |= rule.fits(regions)
        terrain = landforms
        if self.in_images or not grid.from_images:
            terrain = self._joined(regions, landforms)
        found, special = (regions.spread(which) for which in (terrain, landforms))
        grid.raised &= ~special & (grid.objects | ~found)

    def regions(self, grid: GridState) -> RaisedRegions:
        """Return the raised regions of a grid."""
        smooth = smoothed(grid.surface, grid.cells.size, self.smoothing)
        raised, step = grid.raised, self.step * max(grid.cells.size, 1.0)
        if self.judges_gaps:
            # A gap in a roof must not count as ground beside the roof.
            raised = raised | (~grid.heights.known & (grid.filled - grid.surface > step))
            # The filling of a gap in the survey, or beside a wall, slopes down gently from any
            # roof.
            raised &= grid.surveyed
        sides = [self._steps(grid, raised, smooth, axis, step) for axis in (0, 1)]
        cell, neighbour, sign = (np.concatenate(parts) for parts in zip(*sides))
        return raised_regions(grid, raised, (cell, neighbour, sign), self.judges_gaps)

    def _steps(
        self, grid: GridState, raised: np.ndarray, smooth: np.ndarray, axis: int, step: float
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return pairs of neighbours along an axis, of which at least one is raised, and 1 where
        the other is higher by a step, -1 where it is lower, else 0.
        """
        filled, size = grid.filled, grid.cells.size
        ahead = tuple(slice(1, None) if side == axis else slice(None) for side in (0, 1))
        behind = tuple(slice(None, -1) if side == axis else slice(None) for side in (0, 1))
        matters = np.zeros(filled.shape, dtype=bool)
        np.logical_or(raised[ahead], raised[behind], out=matters[behind])
        if self.judges_gaps:
            matters[behind] &= grid.surveyed[ahead] & grid.surveyed[behind]
        cell = np.flatnonzero(matters)
        neighbour = cell + (filled.shape[1] if axis == 0 else 1)
        rise = filled.ravel()[neighbour] - filled.ravel()[cell]
        usual = slope_at(smooth, axis, cell, size) * size
        allowed = step + np.abs(usual)
        rise -= usual
        sign = (rise > allowed).astype(np.int8) - (rise < -allowed).astype(np.int8)
        if self.on_slope and size >= self.on_slope.narrowest:
            stepped = np.flatnonzero(sign)
            sign[stepped[self.on_slope.on_slope(grid.heights, filled, cell[stepped], axis)]] = 0
        return cell, neighbour, sign

    def _joined(self, regions: RaisedRegions, landforms: np.ndarray) -> np.ndarray:
        """Return which regions pass into the ground, or into others that do."""
        joined, count = landforms.copy(), len(regions.area)
        if not self.gentle_border:
            return joined
        sharp = np.sum(
            [np.bincount(drop[0], minlength=count) for _, drop, _ in regions.borders], axis=0
        )
        for _ in range(self.passes):
            ground = np.append(joined, True)  # the last one stands for cells that are not raised
            level = np.zeros(count)
            for flat, _, _ in regions.borders:
                level += np.bincount(flat[0][ground[flat[1]]], minlength=count)
            new = self.gentle_border.fits(regions, ground, level, sharp)
            new &= regions.area >= self.area
            if not (new & ~joined).any():
                break
            joined |= new
        return joined


# Where earth is moved, also low berms and stockpiles without a sharp edge are wanted.
SITE = GentleRegions(in_images=True, gentle_border=GentleBorder(least_area=0.0, most_cut=1.0))


def smoothed(surface: np.ndarray, size: float, smoothing: float) -> np.ndarray:
    """Return a surface smoothed over `smoothing` metres."""
    from scipy import ndimage

    return ndimage.gaussian_filter(surface, smoothing / size, mode="nearest")


def slope_at(surface: np.ndarray, axis: int, cells: np.ndarray, size: float) -> np.ndarray:
    """Return the rise over run of a surface at some cells of the flattened grid, towards north
    (axis 0) or east (1), one-sided at the border.
    """
    place = np.divmod(cells, surface.shape[1])[axis]
    ahead, back = place < surface.shape[axis] - 1, place > 0
    offset = surface.shape[1] if axis == 0 else 1
    flat = surface.ravel()
    rise = flat[cells + offset * ahead] - flat[cells - offset * back]
    return rise / (np.maximum(ahead.astype(np.int8) + back, 1) * size)
