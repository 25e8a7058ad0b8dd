"""The rule of the slope filter: a cell that stands above another at a steep slope is no ground.

References
----------
Vosselman, G. (2000): Slope based filtering of laser altimetry data. International Archives of
Photogrammetry and Remote Sensing 33 (B3), 935-942.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...core.progress import SILENT, Progress
from ...grids.gradient import gradient
from ...grids.height_grid import HeightGrid
from ...grids.morphology import erosion
from ..pipeline import GridRule, Stage
from ..state import GridState

# Radii grow by this factor from scale to scale: the area of the disc doubles.
_SCALE_STEP = math.sqrt(2.0)


@dataclass(frozen=True)
class SteepRises(GridRule):
    """Cells stand out that are higher than another, on any scale, by more than terrain allows.

    All points in a disc have the allowance of its radius: steps along Vosselman's line. The slope
    of the terrain, averaged over about the radius, is added to the threshold.

    Attributes
    ----------
    radius : float
        Largest distance in metres over which cells are compared.
    slope : float
        Slope threshold in degrees.
    height : float
        Height threshold in metres.
    top_hat : bool
        Whether heights above a surface that follows the terrain are compared (white top-hat).
    """

    stage: ClassVar = Stage.OPENING
    reads: ClassVar = ("heights",)
    writes: ClassVar = ("raised",)

    radius: float
    slope: float
    height: float
    top_hat: bool = True

    def apply(self, grid: GridState, progress: Progress = SILENT) -> None:
        """Raise the cells that stand out."""
        known, size = grid.heights.known, grid.cells.size
        reach = max(round(self.radius / size, 6), 1.0)
        # Single precision (better than a millimetre) halves the time that the discs take.
        heights = np.where(known, grid.heights.values, np.inf).astype(np.float32)
        eroded = erosion(heights, reach)
        slope = math.tan(math.radians(self.slope)) + _slope(grid.heights, eroded, reach)
        if self.top_hat:
            opened = -erosion(np.where(np.isfinite(eroded), -eroded, np.float32(np.inf)), reach)
            heights[known] -= opened[known]
        # Rounded, because a radius that is a little less than whole cells makes a smaller disc.
        scales = range(int(2.0 * math.log2(reach)) + 1)
        radii = [round(reach / _SCALE_STEP**scale, 6) for scale in scales]
        for done, radius in enumerate(reversed(radii), start=1):
            allowed = np.maximum(slope * radius * size, self.height)
            grid.raised |= known & (heights > erosion(heights, radius) + allowed)
            progress(done / len(radii))


def _slope(grid: HeightGrid, eroded: np.ndarray, reach: float) -> np.ndarray:
    """Return the slope of the terrain, rise over run, averaged over about the search radius.

    The eroded surface has no objects. Its gradient is averaged, because averaged heights would be
    flattened at a border.
    """
    from scipy import ndimage

    surface = grid._replace(values=np.where(np.isfinite(eroded), eroded, np.nan)).filled()
    window = 2 * max(round(reach / 2), 1) + 1
    north, east = gradient(surface, grid.size)
    for _ in range(2):
        north, east = (
            ndimage.uniform_filter(slope, window, mode="nearest") for slope in (north, east)
        )
    return np.hypot(north, east)
