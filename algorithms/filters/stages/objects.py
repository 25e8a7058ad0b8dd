"""Objects that stand on the ground, found in a grid of lowest points by the rims round them.

A roof, a tree or a car ends in a drop on all sides; a hill, a terrace or a bank does not. The drop
is at a *rim*: the higher of two neighbouring cells that differ by more than a threshold. Rims cut
the grid into *regions*, and a region whose border is mostly a drop is a raised object.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, NamedTuple

import numpy as np

from ...core.progress import SILENT, Progress
from ...grids.cells import Cells
from ...grids.gradient import steepness
from ...grids.morphology import in_steps, opening, within_square
from ..cell_blocks import CellBlocks
from ..height_grid import HeightGrid
from ..pipeline import GridRule, PointRule, Stage
from ..state import GridState, State, covered
from .height_steps import HeightSteps
from .outliers import NarrowPits
from .regions import Regions

_STEEPEST = 5.0  # rise over run: largest slope of the surface that counts
_RELAXATIONS = 2  # across its gaps
# Metres beyond an object within which cells that are as high belong to its rim.
_RIM = 2.0


class Objects(NamedTuple):
    """Cells that stand out on all sides."""

    raised: np.ndarray  # bool (rows, columns): Cells of objects
    # bool (rows, columns): Cells of regions that are too low for their width to be objects for
    # certain: they may be roofs or mounds.
    plateaus: np.ndarray


@dataclass(frozen=True)
class RaisedObjects(GridRule):
    """A region between rims is an object if most of its border is a drop."""

    # More than half of the border must be a drop even if the border of the survey is counted as
    # level: the topmost tread of a terrace drops on one side, and the survey ends on the other.

    stage: ClassVar = Stage.OBJECTS
    writes: ClassVar = ("objects", "plateaus", "raised")

    max_size: float  # largest width (shorter side) of an object in metres
    # Least heights in metres of the drops round objects, one for each pass, in descending order.
    # Objects of one pass are removed before the next.
    heights: tuple[float, ...] = (5.0, 2.0)
    share: float = 0.65  # least share of drops in the border with cells that have a height
    whole_share: float = 0.55  # least share of drops in the whole border
    # Least ratio of the mean drop to the width of the region. Lower or wider regions are terrain or
    # plateaus.
    steepness: float = 0.15
    # In clouds with a spacing below `dense` metres, objects are searched on cells of `wide` metres:
    # in narrower cells gaps in crowns and roofs break the rims, and in wider ones plazas and
    # terraces look like plateaus. In other clouds, cells as wide as the spacing are enough. None
    # for the cells of the grid in all clouds.
    wide: float | None = 2.0
    dense: float = 0.8
    # Least height in metres of the drops round a plateau, that of a hall above the ground uphill.
    # Cells must be so wide that most points on its walls share one with the ground. None for no
    # plateaus.
    plateau_height: float | None = 1.2
    # A plateau is a roof, however wide, if at least these shares of its known and of its whole
    # border drop, on average by the last of `heights`, and no ramp leads to it. Banks are less
    # steep.
    sheer_shares: tuple[float, float] = (0.85, 0.75)
    ramp: float = 5.0  # least width of a ramp in metres
    # Least share of the drop at the sides of a wide object that is a wall (see `Regions`): the
    # sides of a table mountain are less steep. 0 for no limit.
    wall: float = 0.88
    narrow_pits: NarrowPits | None = NarrowPits()

    def apply(self, grid: GridState, progress: Progress = SILENT) -> None:
        """Find the cells of objects and plateaus."""
        cells, heights = self._without_gaps(grid)
        if self.wide is None:
            found = self.find(heights, progress)
        else:
            blocks = CellBlocks.over(
                cells, self.wide if grid.spacing < self.dense else cells.size, 1
            )
            found = self.find(blocks.grid(heights), progress)
            found = Objects(*(blocks.repeated(mask, heights.values.shape) for mask in found))
        found = Objects(*(cells.resampled(mask, grid.cells) for mask in found))
        grid.objects, grid.plateaus = found
        if self.plateau_height is not None:
            grid.objects |= self._rims(grid, self.plateau_height)
        grid.raised = grid.objects.copy()

    def _rims(self, grid: GridState, least: float) -> np.ndarray:
        """Return the cells as high as an object beside them, and higher than others beside them."""
        # The blocks of cells along the border of a roof hold ground as well, so that they are not
        # part of the object that was found on them.
        heights = grid.heights.values
        of_objects = np.where(grid.objects, np.nan_to_num(heights, nan=-np.inf), -np.inf)
        reach = math.ceil(_RIM / grid.cells.size)
        top = within_square(np.maximum, of_objects, reach)
        foot = within_square(np.minimum, np.nan_to_num(heights, nan=np.inf), 1)
        return np.isfinite(top) & (heights > top - least) & (heights > foot + least)

    def _without_gaps(self, grid: GridState) -> tuple[Cells, HeightGrid]:
        """Return cells so wide that hardly one is empty, since empty ones break rims."""
        apart = max(grid.spacing, 1.0)
        if apart <= grid.cells.size:
            return grid.cells, grid.heights
        cells = Cells.over(grid.points, apart, grid.shift)
        wide = HeightGrid(cells.minimum(grid.points.z), cells.size, cells.first)
        if self.narrow_pits:
            wide.values[self.narrow_pits.find(wide, grid.points, cells)] = np.nan
        return cells, wide

    def find(self, grid: HeightGrid, progress: Progress = SILENT) -> Objects:
        """Return the cells of objects on a grid of lowest heights without low outliers."""
        inside = covered(grid.known)
        rest = grid._replace(values=grid.values.copy())
        objects, plateaus = np.zeros((2, *grid.values.shape), dtype=bool)
        for done, height in enumerate(self.heights, start=1):
            regions = HeightSteps(rest, inside).regions(height)
            found = self.bounded(regions)
            if self.plateau_height is not None:
                plateaus |= self.plateaus_of(regions)
            rest.values[found] = np.nan
            objects |= found
            progress(done / len(self.heights))
        if self.plateau_height is not None:
            regions = HeightSteps(rest, inside).regions(self.plateau_height)
            plateaus |= self.plateaus_of(regions)
            roofs = regions.bounded(
                self.max_size, *self.sheer_shares, height=self.heights[-1], wall=self.wall
            )
            if roofs.any():
                objects |= regions.without_ramps(roofs, self.ramp)
        return Objects(objects, plateaus & ~objects)

    def bounded(self, regions: Regions) -> np.ndarray:
        """Return the cells of the regions that are objects."""
        return regions.bounded(
            self.max_size, self.share, self.whole_share, self.steepness, wall=self.wall
        )

    def plateaus_of(self, regions: Regions) -> np.ndarray:
        """Return the cells of the regions that drop all round, however wide for their height."""
        return regions.bounded(self.max_size, self.share, self.whole_share, wall=self.wall)


@dataclass(frozen=True)
class TallObjects(GridRule):
    """A cell is part of an object if its block of cells is, or if it lies far above the ground."""

    # Objects are searched among the lowest points of blocks, in which gaps in a crown and points
    # half-way down a wall do not hide rims.

    stage: ClassVar = Stage.OBJECTS
    writes: ClassVar = ("objects", "plateaus", "raised")

    objects: RaisedObjects  # the rule for a region
    above: float  # metres above the ground from which on a single cell is part of an object
    block: float = 1.0  # side of a block in metres; a block has at least 2 x 2 cells
    steepest: float = 5.0  # largest slope (rise over run) of the ground that counts

    def apply(self, grid: GridState, progress: Progress = SILENT) -> None:
        """Find the cells of objects and plateaus."""
        blocks = CellBlocks.over(grid.cells, self.block)
        lowest, shape = blocks.grid(grid.heights), grid.cells.shape
        if self.objects:
            found = self.objects.find(lowest, progress)
        else:
            found = Objects(*np.zeros((2, *lowest.values.shape), dtype=bool))
        surface = lowest.where(~found.raised).filled(2)
        rise = lowest.size * np.minimum(steepness(surface, lowest.size), self.steepest)
        highest = surface + self.above + rise
        above = grid.heights.values > blocks.interpolated(highest, shape)
        found = Objects(*(blocks.repeated(mask, shape) for mask in found))
        grid.objects = above | found.raised
        grid.plateaus = found.plateaus
        grid.raised = grid.objects.copy()


@dataclass(frozen=True)
class BlockPits(GridRule):
    """The lowest point of a cell in a narrow pit far below the usual ones is a low outlier."""

    # Only the paper's preset has this rule, because gaps in the canopy, yards and streets between
    # roofs are such pits as well.

    stage: ClassVar = Stage.OUTLIERS
    writes: ClassVar = ("heights",)

    depth: float = 2.0  # least depth of a pit in metres below the usual lowest points round it
    width: float = 10.0  # largest width of a pit in metres
    block: float = 1.0  # side in metres of the blocks in which pits are searched

    def apply(self, grid: GridState, progress: Progress = SILENT) -> None:
        """Remove the cells of noise."""
        from scipy import ndimage

        heights, blocks = grid.heights.values, CellBlocks.over(grid.cells, self.block)
        around = CellBlocks.over(grid.cells, self.width)
        usual = ndimage.median_filter(around.grid(grid.heights).filled(), 5, mode="nearest")
        usual = around.interpolated(usual, heights.shape)
        below = heights < usual - self.depth
        if not below.any():
            return
        lowest = blocks.grid(grid.heights)
        candidates = blocks.grid(grid.heights.where(below)).known
        steps = HeightSteps(lowest, covered(lowest.known))
        pits = steps.pits(candidates, self.depth, self.width)
        grid.remove(below & blocks.repeated(pits, heights.shape))


@dataclass(frozen=True)
class Rims(GridRule):
    """Cells at the rims of low objects, and the regions that these enclose, are raised."""

    # Raised cells that are level with the ground beside them become ground again.

    stage: ClassVar = Stage.OPENING
    writes: ClassVar = ("raised",)

    objects: RaisedObjects  # the rule for a region
    height: float  # least height in metres of a rim above the cells beside it
    passes: int = 2  # the second one finds what the first uncovers
    # Multiple of the unevenness of the terrain that is added to the height of a rim.
    roughness: float = 2.0
    objects_grow_back: bool = False  # whether cells of tall objects may become ground again
    # Width in metres of an opening that must cut off a cell for it to be a rim, because the sides
    # of hollows have rims as well. None if any cell can be a rim.
    width: float | None = 20.0

    def apply(self, grid: GridState, progress: Progress = SILENT) -> None:
        """Mark the cells of low objects as raised."""
        ground = grid.heights.where(~grid.objects)
        stands_out = grid.surveyed
        for done in range(self.passes):
            steps = HeightSteps(ground, grid.surveyed)
            if self.width is not None and done == 0:
                cut, step = in_steps(steps.filled)
                cut -= opening(cut, max(self.width / 2.0 / ground.size, 1.0))
                # As unsigned numbers, differences do not overflow.
                stands_out = cut.view(np.uint16) * step > self.height
            regions, rims = steps.regions_and_rims(self.height, self.roughness)
            rims &= stands_out
            if self.objects:
                rims |= self.objects.bounded(regions)
            ground.values[rims] = np.nan
            progress((done + 1) / (self.passes + 1))
        kept = steps.regrown(ground.known, grid.heights.values, self.height)
        low = grid.heights.known & ~kept
        grid.raised = low if self.objects_grow_back else grid.raised | low


@dataclass(frozen=True)
class FineSeeds(PointRule):
    """The lowest point of a fine cell is a seed if its wide cell is ground and it lies near the
    surface through these.
    """

    # Only rims need wide cells, which have no gaps.

    stage: ClassVar = Stage.SEEDS
    writes: ClassVar = ("grids", "seeds", "candidates")

    height: float  # largest distance in metres of a seed from the surface in level terrain
    size: float = 1.0  # side of a fine cell in metres
    unevenness: float = 0.6  # share of the rise over a wide cell that is added to this distance

    def apply(self, state: State) -> None:
        """Replace the grid by a finer one, and take the seeds from it."""
        (wide,) = state.grids
        cells = wide.cells
        if cells.size <= self.size:
            return
        fine = GridState.of(state.points, state.spacing, self.size)
        fine.woods = cells.resampled(wide.woods, fine.cells)
        x, y, z = state.points.take(fine.lowest)
        surface = wide.heights.where(~wide.raised).filled(_RELAXATIONS)
        rise = cells.size * np.minimum(steepness(surface, cells.size), _STEEPEST)
        allowed = self.height + self.unevenness * cells.interpolated(rise, x, y)
        near = np.abs(z - cells.interpolated(surface, x, y)) <= allowed
        of_wide = cells.index[fine.lowest]
        near &= wide.is_ground.ravel()[of_wide]
        known = wide.heights.known.ravel()[of_wide]
        state.seeds, state.candidates = fine.lowest[near], fine.lowest[known & ~near]
        state.grids = [fine]
