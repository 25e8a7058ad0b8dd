"""Cells that stand out of the ground round them: by openings, or by steep rises to them.

References
----------
Zhang, K. et al. (2003): A progressive morphological filter for removing nonground measurements
from airborne LIDAR data. IEEE Transactions on Geoscience and Remote Sensing 41, section II.
Pingel, T., Clarke, K., McBride, W. (2013): An improved simple morphological filter for the terrain
classification of airborne LIDAR data. ISPRS Journal 77, section 2.
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
from ...grids.morphology import erosion, in_steps, opening, within_square
from ..height_grid import HeightGrid
from ..pipeline import GridRule, Stage
from ..state import GridState
from .terrain import slope_at, smoothed

# Large windows are applied to squares of cells, because their objects are large. The side of these
# squares in cells, with the first and the last radius of their windows in cells; and the largest
# side.
_RADII = ((1, 1, 24), (2, 26, 48), (4, 52, 10_000))
_TOGETHER = 4
# Radii grow by this factor from scale to scale: the area of the disc doubles.
_SCALE_STEP = math.sqrt(2.0)


@dataclass(frozen=True)
class ProgressiveOpening(GridRule):
    """A cell is raised if an opening by one of several windows lowers it by more than allowed."""

    # The allowed height grows with the window and with the slope of the terrain.

    stage: ClassVar = Stage.OPENING
    writes: ClassVar = ("filled", "raised")

    largest_window: float  # radius in metres of the largest window
    # Allowed height in metres on level land: `base`, and `per_radius` for each metre of the radius.
    # A slope of 45 degrees adds `per_slope` for each metre of the radius, others in proportion.
    base: float = 0.15
    per_radius: float = 0.04
    per_slope: float = 0.2
    most: float = 1.5  # largest allowed height in metres
    # The slope of the terrain is that of a surface without the cells that windows lower by more
    # than this rise over run.
    first_slope: float = 0.12
    smoothing: float = 5.0  # standard deviation in metres by which this surface is smoothed
    steepest: float = 0.6  # largest slope of the terrain that counts, rise over run
    # Whether heights beyond the survey are those of its border; otherwise they are filled smoothly.
    level_beyond: bool = True
    # Windows with a larger radius in metres than houses need are for halls only. Their allowed
    # height is `hall`, and on a slope of 45 degrees `hall_per_slope` more for each metre of the
    # radius, because a wide window also lowers land whose contours bend.
    usual_window: float = 24.0
    hall: float = 2.5
    hall_per_slope: float = 0.1
    # Radius in metres of the largest windows in woods, that of crowns: where hardly a pulse reaches
    # the ground, larger ones cut ridges off. Houses may stand up to `wood_edge` metres from the
    # edge of a wood, so that all windows are used there.
    crown: float = 11.0
    wood_edge: float = 5.0
    # All of a plateau is raised if this share of it is: its uphill side may be too low.
    plateau_share: float = 0.3

    def apply(self, grid: GridState, progress: Progress = SILENT) -> None:
        """Mark the cells that stand out, and those of objects, as raised."""
        if not self.level_beyond:
            grid.filled = grid.heights.filled().astype(np.float32)
        size, filled = grid.cells.size, grid.filled
        # Squares of cells begin at multiples of their side, wherever the grid starts.
        south, west = (start % _TOGETHER for start in grid.heights.origin)
        within = within_square(np.minimum, grid.woods, math.ceil(self.wood_edge / size))
        padded, within = (
            np.pad(cells, ((south, 0), (west, 0)), mode="edge") for cells in (filled, within)
        )
        found = self._standing_out(padded, within, size, progress.part(0.0, 0.8))
        strict, limit = (mask[south:, west:].copy() for mask in found)
        surface = grid.heights.where(~(strict | grid.objects)).filled()
        smooth = smoothed(surface, size, self.smoothing)
        which = np.flatnonzero(limit > 0.0)
        slope = np.hypot(*(slope_at(smooth, axis, which, size) for axis in (0, 1)))
        grid.raised = grid.objects.copy()
        grid.raised.ravel()[which] |= np.minimum(slope, self.steepest) < limit.ravel()[which]
        self._raise_plateaus(grid)

    def _raise_plateaus(self, grid: GridState) -> None:
        from scipy import ndimage

        number, _ = ndimage.label(grid.plateaus)
        total = np.bincount(number.ravel())
        cut = np.bincount(number[grid.raised], minlength=len(total)) >= self.plateau_share * total
        cut[0] = False
        grid.raised |= cut[number]

    def _standing_out(
        self, filled: np.ndarray, within: np.ndarray, size: float, progress: Progress
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return the cells that stand out on a slope of `first_slope`, and for each cell the slope
        of the terrain below which it stands out; `within` are cells inside woods.
        """
        first = np.zeros(filled.shape, dtype=bool)
        limit = np.full(filled.shape, -np.inf, dtype=np.float32)
        steps, step = in_steps(filled)
        radii = _radii(self.largest_window / size)
        last, zoom = steps.copy(), 1
        for done, (radius, coarse) in enumerate(radii, start=1):
            if coarse != zoom:
                last, zoom = _lowest_of_blocks(last, coarse // zoom), coarse
            opened = opening(last, radius / zoom)
            last -= opened
            # As unsigned numbers, differences do not overflow.
            cut, last = last.view(np.uint16), opened
            metres = radius * size
            # Most cells lose too little to stand out on any slope.
            level = self.base + self.per_radius * metres
            least = int(min(self.first_slope * metres, level) / step)
            if zoom > 1:
                which, cut = _cut_in_blocks(steps, opened, cut, zoom, least)
            else:
                which = np.flatnonzero(cut > least)
                cut = cut.ravel().take(which)
            if metres > self.crown:
                outside = ~within.ravel().take(which)
                which, cut = which[outside], cut[outside]
            lost = cut * np.float32(step)
            first.ravel()[which[lost > self.first_slope * metres]] = True
            slope = self._limit(lost, metres)
            limit.ravel()[which] = np.maximum(limit.ravel()[which], slope)
            progress(done / len(radii))
        return first, limit

    def _limit(self, lost: np.ndarray, radius: float) -> np.ndarray:
        """Return the slope of the terrain below which cells stand out that a window lowers by
        some metres.
        """
        if radius > self.usual_window:
            slope = lost - np.float32(self.hall)
            slope /= np.float32(max(self.hall_per_slope * radius, 1e-6))
            slope[slope <= 0.0] = -np.inf
            return slope
        level = self.base + self.per_radius * radius
        slope = (lost - np.float32(level)) / np.float32(max(self.per_slope * radius, 1e-6))
        slope[lost > self.most] = np.inf
        return slope


def _radii(largest: float) -> list[tuple[int, int]]:
    """Return the radii of windows in cells, and how many cells are taken together for each."""
    largest = max(round(largest), 1)
    return [
        (radius, together)
        for together, first, last in _RADII
        for radius in range(first, min(last, largest) + 1, together)
    ]


def _lowest_of_blocks(grid: np.ndarray, width: int) -> np.ndarray:
    """Return the lowest value of each square of `width` x `width` cells."""
    rows, columns = grid.shape
    padded = np.pad(grid, ((0, -rows % width), (0, -columns % width)), mode="edge")
    rows = np.minimum.reduce([padded[k::width] for k in range(width)])
    return np.minimum.reduce([rows[:, k::width] for k in range(width)])


def _cut_in_blocks(
    steps: np.ndarray, opened: np.ndarray, cut: np.ndarray, zoom: int, least: int
) -> tuple[np.ndarray, np.ndarray]:
    """Return which cells an opening of blocks lowers by more than `least` steps, and by how many;
    `steps` are the heights of cells, `opened` those of blocks, and `cut` what blocks lose.
    """
    # What a block loses counts for its neighbours as well, because the lowest cell of these may lie
    # beside the object.
    most = within_square(np.maximum, cut, 1)
    fine = np.repeat(np.repeat(most > least, zoom, axis=0), zoom, axis=1)
    which = np.flatnonzero(fine[: steps.shape[0], : steps.shape[1]])
    row = which // steps.shape[1]
    block = (which - row * steps.shape[1]) // zoom + row // zoom * most.shape[1]
    above = steps.ravel().take(which).astype(np.int32) - opened.ravel().take(block)
    lost = np.minimum(above, most.ravel().take(block))
    stands_out = lost > least
    return which[stands_out], lost[stands_out]


@dataclass(frozen=True)
class SteepRises(GridRule):
    """A cell is raised if another one within some radius is lower by more than allowed for it."""

    # The allowed height of Vosselman grows with the distance. Here it grows in steps: all cells of
    # a disc have that of its radius. The slope of the terrain, averaged over about the largest
    # radius, is added to the slope threshold.

    stage: ClassVar = Stage.OPENING
    writes: ClassVar = ("raised",)

    radius: float  # largest distance in metres over which cells are compared
    slope: float  # slope threshold in degrees
    height: float  # height threshold in metres
    # Whether heights above a surface that follows the terrain are compared (white top-hat), in
    # place of elevations.
    top_hat: bool = True

    def apply(self, grid: GridState, progress: Progress = SILENT) -> None:
        """Mark the cells that stand out as raised."""
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
    """Return the slope of the terrain, rise over run, averaged over about the search radius."""
    # The gradient is averaged, because averaged heights would be flattened at a border.
    from scipy import ndimage

    surface = grid._replace(values=np.where(np.isfinite(eroded), eroded, np.nan)).filled()
    window = 2 * max(round(reach / 2), 1) + 1
    north, east = gradient(surface, grid.size)
    for _ in range(2):
        north, east = (
            ndimage.uniform_filter(slope, window, mode="nearest") for slope in (north, east)
        )
    return np.hypot(north, east)
