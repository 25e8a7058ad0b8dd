"""Low outliers: single points far below all others round them, as by multipath or faults.

References
----------
Pingel, T., Clarke, K., McBride, W. (2013): An improved simple morphological filter for the terrain
classification of airborne LIDAR data. ISPRS Journal 77, section 2.2.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...core.points import Points
from ...core.progress import SILENT, Progress
from ...core.threads import over_parts
from ...grids.cells import Cells, spacing
from ...grids.gradient import steepness
from ...grids.inpaint import inpaint
from ...grids.morphology import closing_by_square, median_of_nine
from ..height_grid import HeightGrid
from ..lowest_planes import LowestOfCells
from ..pipeline import GridRule, PointRule, Rule, Stage
from ..state import GridState, State
from .seeds import DENSE_SPACING

# Largest distance in metres of a cell of an even surface from the median of the 3 x 3 cells round
# it.
_EVEN = 0.3
# `below_ground`: side in metres of the cells of the ground, and points that are compared at a time.
_CELL = 1.0
_CHUNK = 1 << 20


@dataclass(frozen=True)
class Corroborated(Rule):
    """An exception: a pit is ground if enough other cells some metres away are as low."""

    # Under dense canopy the few cells with ground points are pits, but they lie on one surface.
    # Faults are scattered: no cells, or far fewer than on the even surface above, are as low.

    # Distances in metres from the pit between which other cells are its witnesses; nearer ones may
    # belong to the same fault.
    nearest: float = 3.0
    farthest: float = 10.0
    apart: float = 0.5  # metres between witnesses
    # Largest difference in height of a witness that is as low as the pit: `level` metres, and
    # `level_slope` for each metre of distance, but at most this share of the depth of the pit.
    level: float = 0.5
    level_slope: float = 0.2
    depth_share: float = 0.33
    least: int = 4  # least number of witnesses that are as low
    least_share: float = 0.15  # their least number as a share of even witnesses above the pit

    def of_ground(
        self,
        grid: HeightGrid,
        pits: np.ndarray,
        depth: np.ndarray,
        even: np.ndarray | None = None,
    ) -> np.ndarray:
        """Return the pits that are ground, bool (rows, columns), given their depths in metres, and
        the cells on an even surface if they are known already.
        """
        result = np.zeros(pits.shape, dtype=bool)
        row, column = np.nonzero(pits)
        if not len(row):
            return result
        rows, columns, level = self._witnesses(grid.size)
        reach = int(np.ceil(self.farthest / grid.size))
        heights = np.pad(grid.values.astype(np.float32), reach, constant_values=np.nan)
        even = np.pad(even_cells(grid) if even is None else even, reach)
        width = heights.shape[1]
        centre = (row + reach) * width + column + reach
        of_pit, heights, even = heights.take(centre), heights.ravel(), even.ravel()
        as_low, above, below = np.zeros((3, len(row)), dtype=np.int32)
        most = (self.depth_share * depth[row, column]).astype(np.float32)
        for offset, at_most in zip((rows * width + columns).tolist(), level.tolist()):
            allowed = np.minimum(most, np.float32(at_most))
            there = centre + offset
            rise = heights.take(there) - of_pit
            as_low += np.abs(rise) <= allowed
            above += (rise > allowed) & even.take(there)
            below += rise < -allowed
        enough = np.maximum(self.least, np.maximum(self.least_share * above, below))
        result[row, column] = as_low >= enough
        return result

    def _witnesses(self, size: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return the offsets of witnesses in rows and columns, and their largest differences."""
        reach = int(np.ceil(self.farthest / size))
        # Of narrow cells only some are witnesses, so that their number is that of wide cells.
        stride = max(round(self.apart / size), 1)
        steps = np.arange(-(reach // stride), reach // stride + 1) * stride
        rows, columns = (axis.ravel() for axis in np.meshgrid(steps, steps, indexing="ij"))
        distance = np.hypot(rows, columns) * size
        ring = (distance >= self.nearest) & (distance <= self.farthest)
        return rows[ring], columns[ring], self.level + self.level_slope * distance[ring]


@dataclass(frozen=True)
class UnderCanopy(Rule):
    """An exception: a pit is ground if the lowest points round it are those of a canopy."""

    # Where hardly a pulse gets through, as in rain forest, hardly any other point is as low, so
    # that no pit is `Corroborated`. But outliers lie below a surface, and a canopy has none.

    # Least median distance in metres of the lowest points of a canopy from a plane through them.
    roughness: float = 2.5
    # Radius of the surroundings, the larger one of metres and cells.
    reach: float = 6.0
    reach_cells: int = 4
    depth: float = 6.0  # largest depth of a pit that is ground, in such median distances
    pit: float = 2.0  # radius in metres round the pit of points that do not count for the plane

    def of_ground(
        self, pits: np.ndarray, points: Points, cells: Cells, lowest: np.ndarray | None = None
    ) -> np.ndarray:
        """Return the pits that are ground; `lowest` is the lowest point of each cell, if known."""
        ground = np.zeros(pits.shape, dtype=bool)
        if not pits.any():
            return ground
        margin = math.ceil(max(self.reach / cells.size, self.reach_cells))
        grids = LowestOfCells.of(points, cells, margin, lowest)
        rough = []
        for around in grids.around(grids.places(pits), self.pit):
            plane, above = around.plane()
            distance = around.median(np.abs(above))
            rough.append((distance > self.roughness) & (plane[:, 2] <= self.depth * distance))
        ground[pits] = np.concatenate(rough)
        return ground


@dataclass(frozen=True)
class NarrowPits(GridRule):
    """The lowest point of a cell is a low outlier if the cell is too deep a pit for terrain."""

    # Pits are cells that a closing of the grid by 3 x 3 cells raises (Pingel et al. 2013: an
    # opening of -z).

    stage: ClassVar = Stage.OUTLIERS
    writes: ClassVar = ("heights",)

    # Least ratio of the depth of a pit to the side of a cell, far above the slope of any terrain.
    slope: float = 5.0
    corroborated: Corroborated | None = Corroborated()
    under_canopy: UnderCanopy | None = UnderCanopy()

    def apply(self, grid: GridState, progress: Progress = SILENT) -> None:
        """Remove the pits."""
        grid.remove(self.find(grid.heights, grid.points, grid.cells, grid.lowest))

    def find(
        self, heights: HeightGrid, points: Points, cells: Cells, lowest: np.ndarray | None = None
    ) -> np.ndarray:
        """Return the cells of pits; boolean, shape (rows, columns)."""
        depth = depth_of_pits(heights)
        pits = depth > self.slope * heights.size
        if self.corroborated:
            pits &= ~self.corroborated.of_ground(heights, pits, depth)
        if self.under_canopy:
            pits &= ~self.under_canopy.of_ground(pits, points, cells, lowest)
        return pits


@dataclass(frozen=True)
class IsolatedLowPoints(GridRule):
    """The lowest point of a cell is a low outlier if it lies alone below an even surface."""

    # Such points occur in clouds from images. The other points of the cell and most of the cells
    # next to it lie on the surface, and hardly any cell some metres away is as low.

    stage: ClassVar = Stage.OUTLIERS
    writes: ClassVar = ("heights",)

    depth: float = 0.6  # least depth in metres below the cells round it
    least_even: int = 6  # least number of even cells in the 3 x 3 cells round it
    least_points: int = 4  # least number of points in its cell
    gap: float = 0.7  # least height of the next point of the cell above it, as a share of the depth
    corroborated: Corroborated | None = Corroborated()

    def apply(self, grid: GridState, progress: Progress = SILENT) -> None:
        """Remove the lone points."""
        from scipy import ndimage

        heights, cells, z = grid.heights, grid.cells, grid.points.z
        depth = depth_of_pits(heights)
        even = even_cells(heights)
        around = ndimage.uniform_filter(even.astype(np.float32), 3, mode="nearest")
        doubtful = (depth > self.depth) & (9.0 * around > self.least_even - 0.5)
        which = cells.points_in(doubtful)
        which = which[np.lexsort((z[which], cells.index[which]))]
        cell, first, count = np.unique(cells.index[which], return_index=True, return_counts=True)
        several = count >= self.least_points
        cell, first = cell[several], first[several]
        gap = z[which[first + 1]] - z[which[first]]
        pits = np.zeros(depth.shape, dtype=bool)
        pits.ravel()[cell] = gap >= self.gap * depth.ravel()[cell]
        if self.corroborated:
            pits &= ~self.corroborated.of_ground(heights, pits, depth, even)
        grid.remove(pits)


@dataclass(frozen=True)
class DenseOutliers(PointRule):
    """In a dense cloud of a laser, a point far below all others round it is low noise."""

    # Most cells of half a metre or a metre may have such a point, but few of the narrow ones that
    # are used here. In clouds from images such points are ground beside crowns and roofs, where the
    # surface sags.

    stage: ClassVar = Stage.LOW_NOISE
    writes: ClassVar = ("points", "grids", "low_noise")

    # Side of the cells in spacings of the points: so narrow that hardly any has an outlier, and so
    # wide that hardly any is empty.
    spacings: float = 3.0
    least_spacing: float = 0.02  # least spacing in metres; a smaller one counts as this
    depth: float = 1.0  # least depth in metres below the cells round it
    passes: int = 3  # each finds the lowest of the outliers in a cell
    many: float = 1e-4  # share of outliers among the points from which on the log tells of them
    corroborated: Corroborated | None = Corroborated()

    def apply(self, state: State) -> None:
        """Add the outliers to the low noise."""
        if state.from_images:
            return
        found = self.find(state.points)
        if np.count_nonzero(found) > self.many * state.points.count:
            state.progress.info(
                "Low outliers are scattered all over the points. They are left out, and are not"
                " ground."
            )
        state.add_low_noise(found)

    def find(self, points: Points) -> np.ndarray:
        """Return which points are outliers; none in a cloud that is not dense."""
        outliers = np.zeros(points.count, dtype=bool)
        apart = spacing(points, self.least_spacing)
        if apart > DENSE_SPACING:
            return outliers
        cells = Cells.over(points, self.spacings * apart)
        for number in range(self.passes):
            heights = cells.minimum(points.z, ~outliers if number else slice(None))
            grid = HeightGrid(heights, cells.size, cells.first)
            depth = depth_of_pits(grid)
            pits = depth > self.depth
            if self.corroborated:
                pits &= ~self.corroborated.of_ground(grid, pits, depth)
            if not pits.any():
                break
            # Points in the lower half of the pit are outliers.
            limit = np.where(pits, heights + 0.5 * depth, -np.inf).ravel()
            outliers |= points.z < limit.take(cells.index)
        return outliers


def depth_of_pits(grid: HeightGrid) -> np.ndarray:
    """Return how many metres a closing by 3 x 3 cells raises each cell; 0 without a height."""
    filled = grid.filled()
    return np.where(grid.known, closing_by_square(filled, 1) - filled, 0.0)


def even_cells(grid: HeightGrid) -> np.ndarray:
    """Return which cells lie on an even surface; boolean, shape (rows, columns)."""
    middle = median_of_nine(grid.filled(2).astype(np.float32))
    return np.abs(grid.values - middle) <= _EVEN


def below_ground(
    points: Points, ground: np.ndarray, depth: float, progress: Progress = SILENT
) -> np.ndarray:
    """Return which points (n,) that are not ground lie more than `depth` metres, plus the rise of
    the ground over a cell, below the lowest ground points of cells of 1 m.
    """
    below = np.zeros(points.count, dtype=bool)
    if not ground.any():
        return below
    cells = Cells.over(points, _CELL)
    surface = inpaint(cells.minimum(np.where(ground, points.z, np.inf)), first=cells.first)
    limit = surface - depth - _rise_round(surface)
    progress(0.5)

    def fill(part: slice) -> None:
        below[part] = points.z[part] < cells.interpolated(limit, points.x[part], points.y[part])

    over_parts(fill, points.count, _CHUNK, progress.part(0.5, 1.0))
    return below & ~ground


def _rise_round(surface: np.ndarray) -> np.ndarray:
    """Return the largest rise of a surface over a cell, at each cell and those round it."""
    from scipy import ndimage

    return ndimage.maximum_filter(steepness(surface, 1.0), 3, mode="nearest")
