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
from ...grids.cells import Cells, usual_count
from ...grids.gradient import steepness
from ...grids.inpaint import inpaint
from ...grids.morphology import in_steps, opening, within_square
from ..cell_blocks import CellBlocks
from ..height_grid import HeightGrid
from ..pipeline import GridRule, PointRule, Stage
from ..state import GridState, State, covered
from .height_steps import HeightSteps
from .outliers import NarrowPits
from .regions import Regions

# Least side in metres of the blocks in which the density is measured.
_DENSITY_BLOCK = 10.0
_STEEPEST = 5.0  # rise over run: largest slope of the surface that counts
_RELAXATIONS = 2  # across its gaps
# Metres beyond an object within which a cell as high is of its rim.
_RIM = 2.0


class Objects(NamedTuple):
    """Cells that stand out on all sides; grids of shape (rows, columns)."""

    raised: np.ndarray  # bool: Cells of objects
    # bool: Cells of regions that are too low for their width to be objects for certain: a roof, or
    # a mound.
    plateaus: np.ndarray


@dataclass(frozen=True)
class RaisedObjects(GridRule):
    """A region with drops all round is an object."""

    # More than half of the border must be a drop, also of the whole border with that of the survey:
    # the one drop of a topmost terrace tread winds, and the survey ends on its other side.

    stage: ClassVar = Stage.OBJECTS
    writes: ClassVar = ("objects", "plateaus", "raised")

    max_size: float  # largest width (shorter side) of an object in metres
    # Least heights in metres of the drops that bound an object, one for each pass, the largest
    # first. Objects that one pass finds are removed before the next.
    heights: tuple[float, ...] = (5.0, 2.0)
    # Least share of the known border, and of the whole border, that must be a drop.
    share: float = 0.65
    whole_share: float = 0.55
    # Least mean height of the drop over the width of the region. Lower and wider regions are
    # terrain, or plateaus.
    steepness: float = 0.15
    # Where points are closer than `dense` metres, objects are searched on cells of `wide` metres:
    # in narrower ones gaps in crowns and roofs break the rims, in wider ones plazas and terraces
    # become plateaus. Where points are farther apart, cells as wide as their spacing do. None for
    # the cells of the grid everywhere.
    wide: float | None = 2.0
    dense: float = 0.8
    # Least height in metres of the drops round a plateau: a hall may be so low above the ground
    # uphill. The cells must be so wide that most points on its walls share a cell with the ground.
    # None for no plateaus.
    plateau_height: float | None = 1.2
    # A plateau is a roof, however wide, if such shares of its known and of its whole border drop by
    # a mean of at least the last of `heights`, and no ramp leads to it. Banks are not so steep.
    sheer_shares: tuple[float, float] = (0.85, 0.75)
    ramp: float = 5.0  # least width of a ramp in metres
    # Least share of the height of a wide object's sides that falls at once: those of a table
    # mountain take some metres. 0 for any sides.
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
        """Return the cells beside objects that are as high, and higher than others beside them."""
        # Blocks of cells along the border of a roof hold ground as well.
        heights = grid.heights.values
        low = np.where(grid.objects, np.nan_to_num(heights, nan=-np.inf), -np.inf)
        reach = math.ceil(_RIM / grid.cells.size)
        top = within_square(np.maximum, low, reach)
        foot = within_square(np.minimum, np.nan_to_num(heights, nan=np.inf), 1)
        return np.isfinite(top) & (heights > top - least) & (heights > foot + least)

    def _without_gaps(self, grid: GridState) -> tuple[Cells, HeightGrid]:
        """Return cells so wide that hardly one is empty, which would break the rims of objects."""
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
        """Return the cells of the regions that drop all round, also of those that drop little."""
        return regions.bounded(self.max_size, self.share, self.whole_share, wall=self.wall)


@dataclass(frozen=True)
class TallObjects(GridRule):
    """Objects are removed by passes over the lowest points of blocks, the tall ones first."""

    # In blocks, gaps in a tree's crown and points half-way down a wall hide no rim. Single cells
    # far above the ground of their block are objects as well.

    stage: ClassVar = Stage.OBJECTS
    writes: ClassVar = ("objects", "plateaus", "raised")

    objects: RaisedObjects  # the rule for a region
    above: float  # metres: single cells this far above the ground of their block are objects, too
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


def density(cells: Cells) -> float:
    """Return the median number of points per square metre, of blocks within the survey."""
    blocks = CellBlocks.over(cells, _DENSITY_BLOCK, least=1)
    return usual_count(blocks.total(cells.counts)) / blocks.size**2


@dataclass(frozen=True)
class BlockPits(GridRule):
    """A narrow pit far below the usual lowest points around holds low outliers."""

    # It is the rule of the paper's preset: a gap in the canopy, a yard or a street between roofs is
    # such a pit, too.

    stage: ClassVar = Stage.OUTLIERS
    writes: ClassVar = ("heights",)

    # Metres that low noise is below the usual lowest points round it, and its greatest width.
    depth: float = 2.0
    width: float = 10.0
    block: float = 1.0  # side in metres of the blocks in which it is searched

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
    """The rims of low objects, and what they enclose, are no ground."""

    # Removed cells grow back if they are level with the ground beside them.

    stage: ClassVar = Stage.OPENING
    writes: ClassVar = ("raised",)

    objects: RaisedObjects  # the rule for a region
    height: float  # whatever stands this far above the ground beside it is removed, in metres
    passes: int = 2  # the first removal uncovers more
    # Multiple of the unevenness of the terrain that is added to the height of rims.
    roughness: float = 2.0
    objects_grow_back: bool = False  # whether cells of tall objects may grow back, too
    # Metres: only what an opening of this width cuts off has rims, as the sides of hollows are no
    # objects. Regions are wider ones. None for all rims.
    width: float | None = 8.0

    def apply(self, grid: GridState, progress: Progress = SILENT) -> None:
        """Raise the cells of low objects."""
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
    """Rims need cells without gaps, but the surface can have finer cells."""

    # The lowest point of a fine cell is a seed if its wide cell is ground and the point is near the
    # surface of the wide cells.

    stage: ClassVar = Stage.SEEDS
    writes: ClassVar = ("grids", "seeds", "waiting")

    height: float  # metres: farthest that the point is from the surface
    size: float = 1.0  # side of a fine cell in metres
    # It may lie off the surface by this share of the rise over a wide cell in addition.
    unevenness: float = 0.6

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
        state.seeds, state.waiting = fine.lowest[near], fine.lowest[known & ~near]
        state.grids = [fine]


@dataclass(frozen=True)
class PaperSurface(PointRule):
    """Points close to the surface through the lowest points of ground cells are ground."""

    stage: ClassVar = Stage.ACCEPTED
    writes: ClassVar = ("limits",)

    tolerance: float  # metres in level terrain
    slope_tolerance: float  # share of the rise of the surface over one cell that is added

    def apply(self, state: State) -> None:
        """Set the limits of the heights of ground points."""
        grid = state.grids[0]
        heights = grid.heights.where(~grid.raised)
        surface = inpaint(heights.values, _RELAXATIONS, heights.origin)
        tolerance = np.minimum(steepness(surface, heights.size), _STEEPEST)
        tolerance *= self.slope_tolerance * heights.size
        tolerance += self.tolerance
        state.limits = np.stack((surface - tolerance, surface + tolerance), axis=-1)
