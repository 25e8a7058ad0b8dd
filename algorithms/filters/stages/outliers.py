"""Low outliers: points far below everything round them. Multipath, birds under bridges, faults.

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

# Metres that a cell of an even surface is off the median of the 3 x 3 cells round it, at most.
_EVEN = 0.3

_CELL = 1.0  # metres: side of the cells of the ground below which points are searched
_CHUNK = 1 << 20  # points that are searched at a time


@dataclass(frozen=True)
class Corroborated(Rule):
    """An exception: pits that other cells some metres away are as low as are ground."""

    # Under dense canopy the few cells with ground points are pits, but they lie on one surface.
    # Faults are scattered: hardly any other cell lies at their level, or far fewer than on the even
    # surface above them.

    # The witnesses of a pit are the cells between these distances from it, in metres; nearer ones
    # may belong to the same fault.
    nearest: float = 3.0
    farthest: float = 10.0
    apart: float = 0.5  # metres between witnesses
    # A witness is as low as a pit if they differ by at most `level` metres, plus `level_slope` for
    # each metre of distance, and by at most this share of the depth of the pit.
    level: float = 0.5
    level_slope: float = 0.2
    depth_share: float = 0.33
    # Least number of witnesses that are as low, and their least share of the number of witnesses on
    # an even surface above the pit.
    least: int = 4
    least_share: float = 0.15

    def of_ground(
        self,
        grid: HeightGrid,
        pits: np.ndarray,
        depth: np.ndarray,
        even: np.ndarray | None = None,
    ) -> np.ndarray:
        """Return the pits that are ground; boolean, shape (rows, columns)."""
        # `pits` are cells far below those next to them, `depth` is their depth in metres, and
        # `even` marks the cells that lie on an even surface, if they are known already.
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
        own, heights, even = heights.take(centre), heights.ravel(), even.ravel()
        near, above, below = np.zeros((3, len(row)), dtype=np.int32)
        most = (self.depth_share * depth[row, column]).astype(np.float32)
        for offset, at_most in zip((rows * width + columns).tolist(), level.tolist()):
            allowed = np.minimum(most, np.float32(at_most))
            there = centre + offset
            rise = heights.take(there) - own
            near += np.abs(rise) <= allowed
            above += (rise > allowed) & even.take(there)
            below += rise < -allowed
        enough = np.maximum(self.least, np.maximum(self.least_share * above, below))
        result[row, column] = near >= enough
        return result

    def _witnesses(self, size: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return the offsets of witnesses in rows and columns, and how far off they may be."""
        reach = int(np.ceil(self.farthest / size))
        # Not all narrow cells, but as many as there are of wide ones.
        stride = max(round(self.apart / size), 1)
        steps = np.arange(-(reach // stride), reach // stride + 1) * stride
        rows, columns = (axis.ravel() for axis in np.meshgrid(steps, steps, indexing="ij"))
        distance = np.hypot(rows, columns) * size
        ring = (distance >= self.nearest) & (distance <= self.farthest)
        return rows[ring], columns[ring], self.level + self.level_slope * distance[ring]


@dataclass(frozen=True)
class UnderCanopy(Rule):
    """An exception: pits are ground where the lowest points round them are crowns."""

    # Where hardly a pulse gets through, as in rain forest, hardly any other point is as low, so
    # that the pits are not `Corroborated`. But an outlier lies below a surface, and the lower side
    # of crowns is none.

    # The lowest points are those of a canopy if their median distance from a plane is more than so
    # many metres.
    roughness: float = 2.5
    # Distance up to which they are looked at, in metres and in cells.
    reach: float = 6.0
    reach_cells: int = 4
    # A pit that is deeper than this multiple of the distance is an outlier all the same.
    depth: float = 6.0
    # Metres round the pit: the plane is fitted without the points there, which may belong to it.
    pit: float = 2.0

    def of_ground(
        self, pits: np.ndarray, points: Points, cells: Cells, lowest: np.ndarray | None = None
    ) -> np.ndarray:
        """Return the pits that are ground; `lowest` is the lowest point of each cell, if known."""
        found = np.zeros(pits.shape, dtype=bool)
        if not pits.any():
            return found
        margin = math.ceil(max(self.reach / cells.size, self.reach_cells))
        grids = LowestOfCells.of(points, cells, margin, lowest)
        rough = []
        for around in grids.around(grids.places(pits), self.pit):
            plane, above = around.plane()
            distance = around.median(np.abs(above))
            rough.append((distance > self.roughness) & (plane[:, 2] <= self.depth * distance))
        found[pits] = np.concatenate(rough)
        return found


@dataclass(frozen=True)
class NarrowPits(GridRule):
    """A cell in a narrow pit that is too deep for terrain is a low outlier."""

    # The grid is closed by 3 x 3 cells (the opening of -z). Cells that the closing raises by more
    # than `slope` times their size are outliers (Pingel et al. 2013).

    stage: ClassVar = Stage.OUTLIERS
    writes: ClassVar = ("heights",)

    slope: float = 5.0  # rise over run, far above that of any terrain
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
    """A lone point below an even surface is a low outlier, as in points from images."""

    # The other points of its cell and most cells next to it lie on the surface. Hardly any other
    # cell some metres away is as low.

    stage: ClassVar = Stage.OUTLIERS
    writes: ClassVar = ("heights",)

    depth: float = 0.6  # least depth in metres below the cells round it
    least_even: int = 6  # of the eight cells round it
    least_points: int = 4  # of its cell
    gap: float = 0.7  # the next point of the cell is higher by at least this share of the depth
    corroborated: Corroborated | None = Corroborated()

    def apply(self, grid: GridState, progress: Progress = SILENT) -> None:
        """Remove the cells of lone points."""
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
    """In a dense cloud of a laser, points far below all others round them are low noise."""

    # Most cells of half a metre or a metre may have such a point. Here cells are so narrow that few
    # have one. In clouds from images such points are parts of the ground beside crowns and roofs,
    # where the surface sags.

    stage: ClassVar = Stage.LOW_NOISE
    writes: ClassVar = ("points", "grids", "low_noise")

    # Side of the cells as a multiple of the usual distance between points. With so few points
    # hardly any cell has an outlier, and hardly any is empty.
    spacings: float = 3.0
    least_spacing: float = 0.02  # a smaller distance between points counts as this, in metres
    depth: float = 1.0  # least depth in metres below the cells round it
    passes: int = 3  # of several outliers in one cell, each pass finds the lowest
    many: float = 1e-4  # if more than this share of the points are such outliers, the log says so
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
        """Return which points are outliers; all False if points are farther apart than 0.17 m."""
        lows = np.zeros(points.count, dtype=bool)
        apart = spacing(points, self.least_spacing)
        if apart > DENSE_SPACING:
            return lows
        cells = Cells.over(points, self.spacings * apart)
        for number in range(self.passes):
            heights = cells.minimum(points.z, ~lows if number else slice(None))
            grid = HeightGrid(heights, cells.size, cells.first)
            depth = depth_of_pits(grid)
            pits = depth > self.depth
            if self.corroborated:
                pits &= ~self.corroborated.of_ground(grid, pits, depth)
            if not pits.any():
                break
            # The lower half of the pit.
            limit = np.where(pits, heights + 0.5 * depth, -np.inf).ravel()
            lows |= points.z < limit.take(cells.index)
        return lows


def depth_of_pits(grid: HeightGrid) -> np.ndarray:
    """Return how many metres a closing by 3 x 3 cells raises each cell; 0 where there is none."""
    filled = grid.filled()
    return np.where(grid.known, closing_by_square(filled, 1) - filled, 0.0)


def even_cells(grid: HeightGrid) -> np.ndarray:
    """Return which cells lie on an even surface; boolean, shape (rows, columns)."""
    middle = median_of_nine(grid.filled(2).astype(np.float32))
    return np.abs(grid.values - middle) <= _EVEN


def below_ground(
    points: Points, ground: np.ndarray, depth: float, progress: Progress = SILENT
) -> np.ndarray:
    """Return which points (n,), never ground, lie `depth` metres, and the rise over a cell, below
    the lowest ground points of cells of 1 m; none where there is no ground.
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
