"""Rules of the minimum-Z grid filter: noise in blocks, rims of low objects, seeds on fine cells."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...core.progress import SILENT, Progress
from ...grids.cell_blocks import CellBlocks
from ...grids.cells import Cells, usual_count
from ...grids.gradient import steepness
from ...grids.inpaint import inpaint
from ..pipeline import GridRule, PointRule, Stage
from ..state import GridState, State, covered
from .height_steps import HeightSteps
from .objects import RaisedObjects

# Least side in metres of the blocks in which the density is measured.
_DENSITY_BLOCK = 10.0
# Largest slope (rise over run) of the surface that counts, and relaxations across its gaps.
_STEEPEST, _RELAXATIONS = 5.0, 2


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
    reads: ClassVar = ("heights",)
    writes: ClassVar = ("heights",)

    # Low noise is so many metres below the usual lowest points round it, and narrower than this.
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
    reads: ClassVar = ("heights", "objects", "raised")
    writes: ClassVar = ("raised",)

    objects: RaisedObjects  # the rule for a region
    height: float  # whatever stands this far above the ground beside it is removed, in metres
    passes: int = 2  # the first removal uncovers more
    # The unevenness of the terrain is added so many times to the height of rims.
    roughness: float = 2.0
    objects_grow_back: bool = False  # whether cells of tall objects may grow back, too

    def apply(self, grid: GridState, progress: Progress = SILENT) -> None:
        """Raise the cells of low objects."""
        ground, inside = grid.heights.where(~grid.objects), grid.surveyed
        for done in range(self.passes):
            steps = HeightSteps(ground, inside)
            regions, rims = steps.regions_and_rims(self.height, self.roughness)
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
    reads: ClassVar = ("points", "grids", "seeds")
    writes: ClassVar = ("grids", "seeds", "waiting")

    height: float  # the point is at most so many metres from the surface
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
        allowed = self.height + self.unevenness * cells.at(rise, x, y)
        near = np.abs(z - cells.at(surface, x, y)) <= allowed
        of_wide = cells.index[fine.lowest]
        near &= wide.is_ground.ravel()[of_wide]
        known = wide.heights.known.ravel()[of_wide]
        state.seeds, state.waiting = fine.lowest[near], fine.lowest[known & ~near]
        state.grids = [fine]


@dataclass(frozen=True)
class PaperSurface(PointRule):
    """Points close to the surface through the lowest points of ground cells are ground."""

    stage: ClassVar = Stage.ACCEPTED
    reads: ClassVar = ("grids",)
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
