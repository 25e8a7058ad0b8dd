"""Raised regions that are terrain after all.

A region that an opening cuts off is terrain if it continues gently into the ground round it (a
dike, a terrace, a plateau with a ramp), or if it has the shape of a landform.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from ...core.progress import SILENT, Progress
from ..cell_blocks import CellBlocks
from ..height_grid import HeightGrid
from ..pipeline import GridRule, Rule, Stage
from ..state import GridState
from .landforms import LevelAcross, Ramps
from .raised_regions import LowBanks, RaisedRegions, Rocks, raised_regions


@dataclass(frozen=True)
class OnSlope(Rule):
    """An exception: a step that is one of three similar steps in a row is part of a slope."""

    # The filling of cells without a point makes a slope of any wall, so steps to such cells do not
    # count, except one among wide cells. Where narrow cells have no point, blocks of cells are
    # tested as well.

    # Steps are similar if the smallest is at least this share of the largest. `alike_across` is for
    # steps across a cell without a point, and for those between blocks of cells.
    alike: float = 0.4
    alike_across: float = 0.55
    # Least side of wide cells in metres. One of four wide cells on a slope may have no point: its
    # filling spreads the drop at a wall over two cells, not over three.
    wide: float = 2.0
    block: int = 2  # side of the blocks that are tested where narrow cells have no point, in cells
    # Least side in metres of cells in which a step can be part of a slope. In clouds from images,
    # three steps of narrower cells can be the side of a machine.
    narrowest: float = 1.0

    def on_slope(
        self, grid: HeightGrid, filled: np.ndarray, cells: np.ndarray, axis: int
    ) -> np.ndarray:
        """Return which steps, from `cells` of the flattened grid to their neighbours in the north
        (axis 0) or east (1), are part of a slope.
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
        """Return which steps are among three similar ones, whose smallest is at least a share of
        the largest, and which are near a cell without a point.
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
    """A region is terrain if a large share of its border is level with the ground, or a small share
    in one place, as at the ramp of a plateau.
    """

    # Least share of the border, of what is level or drops, that must be level. A region of the
    # first area, in square metres, needs the first share, one of the second area the second.
    # Between them, the share falls with the logarithm of the area.
    areas: tuple[float, float] = (400.0, 3000.0)
    shares: tuple[float, float] = (0.3, 0.2)
    # A region with a smaller share, down to this one at the second area, is terrain only if its
    # border is level over `width` metres in one place. The border of a roof is level in many short
    # pieces, where there are points on walls.
    in_one_place: float = 0.05
    width: float = 4.0
    least_area: float = 100.0  # square metres: crowns and sheds are smaller
    # If the border of the survey is a larger share of the border of a region, it needs the first
    # share, because the rest of a roof or of a closed canopy may lie beyond the survey.
    most_cut: float = 0.1
    # A region of up to `small` square metres is an object, such as an A-frame or a polytunnel, if
    # its mean height is more than `tall` metres and more than the share `steep` of its mean width.
    # Only TIN densification uses it: regions that `SteepRises` or `Rims` raise are whole rocks.
    # Half of the level border of a narrow region whose border drops along this share must be in one
    # place: the low edge of a row of panels is level with the ground here and there.
    row_width: float = 5.0  # largest mean width in metres
    row_spacing: float = 0.6  # largest spacing of the points in metres: else dykes look like it
    row_above: float = 0.5  # least mean height above the ground in metres
    row_sharp: float = 0.4
    row_piece: float = 0.5
    # A tall region that is a vault is no terrain if less than this share of its border is level.
    vault_level: float = 0.5
    small: float = 0.0
    tall: float = 2.0
    steep: float = 0.45

    def fits(
        self, regions: RaisedRegions, ground: np.ndarray, level: np.ndarray, sharp: np.ndarray
    ) -> np.ndarray:
        """Return which regions are terrain, given which are ground (see `RaisedRegions.widths`),
        and how many sides of cells on the border of each are `level` and `sharp`.
        """
        area, border = regions.area, level + sharp
        cut = regions.cut > self.most_cut * (border + regions.cut)
        shares = self.shares[0], self.in_one_place
        in_one_place, anywhere = (
            np.where(cut, shares[0], np.interp(np.log(area), np.log(self.areas), needed))
            for needed in (shares, self.shares)
        )
        gentle = (level > 0) & (level >= in_one_place * border) & (area >= self.least_area)
        tall = (area <= self.small) & (regions.above > self.tall)
        if tall.any():
            gentle &= ~(tall & (regions.above > self.steep * regions.mean_width))
        doubtful = gentle & (level < anywhere * border)
        row = gentle & (regions.mean_width <= self.row_width) & (regions.above > self.row_above)
        row &= sharp >= self.row_sharp * border
        if doubtful.any() or row.any():
            widths = regions.widths(ground)
            gentle &= ~doubtful | (widths >= self.width)
            gentle &= ~row | (widths >= self.row_piece * level * regions.size)
        tall = gentle & (regions.above > self.tall) & (level < self.vault_level * border)
        return gentle & ~(tall & regions.vaults) if tall.any() else gentle


@dataclass(frozen=True)
class GentleRegions(GridRule):
    """A raised region that continues gently into the ground is terrain."""

    # A region is a group of raised cells without steps between them. Its border is gentle where it
    # touches the ground without a step, and sharp where it drops.

    stage: ClassVar = Stage.TERRAIN
    writes: ClassVar = ("raised",)

    # Largest step in metres between neighbouring cells of up to 1 m that is no edge, beyond the
    # rise of the terrain. It grows in proportion to the side of larger cells.
    step: float = 0.3
    # Standard deviation in metres by which the surface is smoothed to find the rise of the terrain.
    smoothing: float = 2.0
    area: float = 20.0  # least area of a region in square metres
    passes: int = 4  # passes in which regions join the ground, or regions that joined it before
    # Whether cells without a point are judged as well: they are raised if their filled height is,
    # and those outside the survey are no border.
    judges_gaps: bool = True
    # Whether borders are judged in clouds from images as well, although walls are slopes there.
    in_images: bool = False
    on_slope: OnSlope | None = OnSlope()
    gentle_border: GentleBorder | None = GentleBorder()
    rocks: Rocks | None = Rocks()
    low_banks: LowBanks | None = LowBanks()
    level_across: LevelAcross | None = LevelAcross()
    ramps: Ramps | None = Ramps()

    def apply(self, grid: GridState, progress: Progress = SILENT) -> None:
        """Take the regions that are terrain for ground; cells of objects only in landforms."""
        regions = self.regions(grid)
        landforms = np.zeros(len(regions.area), dtype=bool)
        if self.rocks:
            landforms |= self.rocks.fits(regions)
        is_sparse = self.low_banks and grid.spacing >= self.low_banks.sparse
        if self.low_banks and (is_sparse or grid.from_images):
            landforms |= self.low_banks.fits(regions)
        terrain = landforms
        if self.in_images or not grid.from_images:
            terrain, islands = self._joined(regions, landforms, grid)
            landforms |= islands
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
        """Return pairs of neighbouring cells along an axis with at least one raised cell, and the
        sign of the step to the second: 1 up, -1 down, 0 for none.
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

    def _joined(
        self, regions: RaisedRegions, landforms: np.ndarray, grid: GridState
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return which regions continue gently into the ground, or into others that do, and which
        are land beyond gaps or ramps.
        """
        joined, count = landforms.copy(), len(regions.area)
        islands = np.zeros(count, dtype=bool)
        gentle = self.gentle_border
        if not gentle:
            return joined, islands
        if grid.spacing > gentle.row_spacing:
            gentle = replace(gentle, row_width=0.0)
        across = self.level_across.look(regions, grid) if self.level_across else None
        sharp = np.sum(
            [np.bincount(drop[0], minlength=count) for _, drop, _ in regions.borders], axis=0
        )
        for _ in range(self.passes):
            ground = np.append(joined, True)  # the last one stands for cells that are not raised
            level = np.zeros(count)
            for flat, _, _ in regions.borders:
                level += np.bincount(flat[0][ground[flat[1]]], minlength=count)
            new = gentle.fits(regions, ground, level, sharp)
            new &= regions.area >= self.area
            if across:
                level_across = across.fits(ground)
                islands |= level_across
                new |= level_across
            if not (new & ~joined).any():
                break
            joined |= new
        if self.ramps:
            found = self.ramps.fits(regions, np.append(joined, True))
            joined |= found
            islands |= found
        return joined, islands


# For sites where earth is moved: low berms and stockpiles without a sharp edge are terrain.
SITE = GentleRegions(
    in_images=True,
    gentle_border=GentleBorder(least_area=0.0, most_cut=1.0, row_width=0.0, vault_level=0.0),
    low_banks=LowBanks(sparse=0.0),
)


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
