"""Makes the rasters of a block of a survey: terrain, surface and confidence."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Callable, Mapping, NamedTuple

import numpy as np

from ...core.points import Box, Points
from ...core.progress import SILENT, Progress
from ...core.threads import parts_of
from ...grids.cell_window import CellWindow
from ...grids.cells import are_inside, first_of_each
from ...grids.confidence import confidence
from ...grids.dense_surface import VERTICES_A_SIDE, DenseSurface
from ...grids.high_groups import HighGroups
from ...grids.morphology import within_square
from ...grids.terrain_edges import follow_edges

# Longest edge of the triangles in a block, in metres and in cells. Triangles across wider gaps need
# points from farther away than a block sees, so they are made when all blocks are done.
_LONGEST_EDGE, _LONGEST_CELLS = 50.0, 20.0
# Reach of a triangle in longest edges. Its circumcircle hardly ever reaches farther.
_EDGES = 2.0
# The layer that tells what each cell holds: bits for ground points in its four quarters, from
# southwest to northeast, a bit for any points, and one for points of the surface.
HELD, QUARTERS, ANY, TOP = "held", 4, 16, 32
# Rounding error of coordinates in metres.
_ROUNDING = 1e-6
# Least number of points that are processed together.
_POINTS_A_PART = 1 << 20


class BlockRasters(NamedTuple):
    """The rasters of a block, with rows from south to north."""

    window: CellWindow  # the cells of the block
    # float32, (rows, columns), NaN for no value, by names in `LAYERS`; also `HELD`, of uint8
    layers: Mapping[str, np.ndarray]
    # float64, (n, 3): for layers with filled gaps, the points of the block that are needed across
    # wide gaps, corners of the convex hull and points beside cells without a height
    loose: Mapping[str, np.ndarray]
    box: np.ndarray  # float64, (4,): extent of the points in the block; NaN if it has none
    counts: np.ndarray  # int64, (2,): points of terrain and of surface in the block


class Seen(NamedTuple):
    """The points that a block uses, in it and in its surroundings."""

    window: CellWindow  # the cells of the block
    points: Points  # relative to `corner`
    ground: np.ndarray  # bool, (n,)
    top: np.ndarray  # bool, (n,): which belong to the surface
    core: np.ndarray  # bool, (n,): which lie in the block
    corner: tuple[float, float]  # origin of `points` in the frame of the survey
    edges: np.ndarray | None = None  # bool, (n,): ground on lines that no triangle may cross


@dataclass(frozen=True)
class RasterStep:
    """Makes the rasters of a block."""

    cell: float  # metres
    layers: tuple[str, ...] = ("terrain",)  # of `LAYERS`
    max_edge: float | None = None  # triangles with a longer edge, in metres, are gaps

    @property
    def longest_edge(self) -> float:
        """Longest edge of triangles in a block, in metres."""
        return self.max_edge or max(_LONGEST_EDGE, _LONGEST_CELLS * self.cell)

    @property
    def reach(self) -> float:
        """Distance in metres up to which points around a block are needed."""
        return _EDGES * self.longest_edge

    def of(
        self,
        points: Points,
        ground: np.ndarray,
        top: np.ndarray,
        core: np.ndarray,
        corner: tuple[float, float],
        box: Box,
        edges: np.ndarray | None = None,
        progress: Progress = SILENT,
    ) -> BlockRasters:
        """Return the rasters of a block, a box in the frame of the survey; see `Seen`."""
        window = CellWindow.with_centres_in(_within(box, points, corner, self.cell), self.cell)
        seen = Seen(window, points, ground, top, core, corner, edges)
        made, loose = {HELD: _held(self, seen)}, {}
        parts = progress.shares(*(LAYERS[name].cost for name in self.layers))
        for name, part in zip(self.layers, parts):
            made[name], points_at_gaps = LAYERS[name].make(self, seen, part)
            if points_at_gaps is not None:
                loose[name] = points_at_gaps
        counts = [np.count_nonzero(each & core) for each in (ground, top)]
        progress(1.0)
        return BlockRasters(window, made, loose, _extent(points, core, corner), np.array(counts))


# The cells of a layer, and the points needed across wide gaps; None if these stay open.
Made = tuple[np.ndarray, "np.ndarray | None"]


def _held(step: RasterStep, seen: Seen) -> np.ndarray:
    """Return what each cell holds, as `HELD` says."""
    window = CellWindow(*(2 * each for each in seen.window))
    holds_any, holds_ground, holds_top = np.zeros((3, *window.shape), dtype=bool)
    for part in parts_of(seen.points.count, _POINTS_A_PART):
        x, y = seen.points.x[part], seen.points.y[part]
        row, column = window.places(x, y, seen.corner, step.cell / 2.0)
        inside = are_inside(row, column, window.shape)
        holds_any[row[inside], column[inside]] = True
        is_top = inside & seen.top[part]
        holds_top[row[is_top], column[is_top]] = True
        inside &= seen.ground[part]
        holds_ground[row[inside], column[inside]] = True
        # A point on the middle line of a cell lies in the quarters on both sides.
        before = window.places(x - _ROUNDING, y - _ROUNDING, seen.corner, step.cell / 2.0)
        south, west = (np.where(at % 2, low, at) for at, low in zip((row, column), before))
        middle = np.flatnonzero(inside & ((south < row) | (west < column)))
        for one, two in ((south, column), (row, west), (south, west)):
            holds_ground[one[middle], two[middle]] = True
    held = np.zeros(seen.window.shape, dtype=np.uint8)
    for number in range(QUARTERS):
        quarter = slice(number // 2, None, 2), slice(number % 2, None, 2)
        held |= holds_ground[quarter].view(np.uint8) << number
        held |= holds_any[quarter].view(np.uint8) * np.uint8(ANY)
        held |= holds_top[quarter].view(np.uint8) * np.uint8(TOP)
    return held


def _terrain(step: RasterStep, seen: Seen, progress: Progress) -> Made:
    """Return heights of the terrain."""
    window, corner, cell = seen.window, seen.corner, step.cell
    points, core = seen.points.take(seen.ground), seen.core[seen.ground]
    if not points.count or not min(window.shape):
        return np.full(window.shape, np.nan, dtype=np.float32), _placed(points, corner, core)
    start_x, start_y = (at - by for at, by in zip(window.corner(cell), corner))
    surface = DenseSurface(points, cell, (start_x, start_y), progress.part(0.05, 0.3))
    part = progress.part(0.3, 0.95)
    heights = surface.raster(window.shape, step.longest_edge, part)
    loose = np.zeros(points.count, dtype=bool)
    if step.max_edge is None:
        if np.isnan(heights).any():
            vertices = surface.vertices
            row, column = window.places(*points.take(vertices)[:2], corner, cell)
            row, column = (
                np.clip(each, 0, most - 1) for each, most in zip((row, column), window.shape)
            )
            near_gap = within_square(np.maximum, np.isnan(heights), 1)
            loose[vertices[near_gap[row, column]]] = True
        loose[surface.hull] = True
    heights = heights.astype(np.float32)
    if seen.edges is not None and seen.edges.any():
        follow_edges(heights, window, cell, points, seen.edges[seen.ground], corner)
    return heights, _placed(points, corner, loose & core)


def _surface(step: RasterStep, seen: Seen, progress: Progress) -> Made:
    """Return the height of the highest point of each cell, but for points that hang in the air,
    such as birds; in empty cells, of their TIN.
    """
    window, corner, cell = seen.window, seen.corner, step.cell
    which = seen.top
    if seen.top.any():
        which = seen.top & ~HighGroups().find(seen.points)
    points, core = seen.points.take(which), seen.core[which]
    heights = np.full(window.shape, np.nan)
    if not points.count or not min(window.shape):
        return heights.astype(np.float32), _placed(points, corner, core)
    wide = window.wider(math.ceil(step.reach / cell))
    top, row, column = _highest(points, wide, corner, cell, progress.part(0.0, 0.35))
    every = np.full(wide.shape, np.nan)
    every[row, column] = points.z[top]
    margin = window.row - wide.row
    heights[:] = every[margin : margin + window.rows, margin : margin + window.columns]
    progress(0.4)
    empty_row, empty_column = np.nonzero(np.isnan(heights))
    highest = points.take(top)
    start_x, start_y = (at - by for at, by in zip(window.corner(cell), corner))
    part = progress.part(0.4, 0.6)
    surface = DenseSurface(highest, VERTICES_A_SIDE * cell, (start_x, start_y), part)
    if len(empty_row):
        heights[empty_row, empty_column] = surface.heights(
            start_x + (empty_column + 0.5) * cell,
            start_y + (empty_row + 0.5) * cell,
            step.longest_edge,
            progress.part(0.6, 1.0),
        )
    loose = np.zeros(points.count, dtype=bool)
    if step.max_edge is None:
        loose[top[surface.hull]] = True
    return heights.astype(np.float32), _placed(points, corner, loose & core)


def _highest(
    points: Points,
    window: CellWindow,
    corner: tuple[float, float],
    cell: float,
    progress: Progress,
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the highest point of each cell with points, and row and column of these cells."""
    # Points are processed in parts, since intermediate arrays take more memory than the points.
    size, top = window.rows * window.columns, np.zeros(0, dtype=np.intp)

    def places(which: np.ndarray | slice) -> tuple[np.ndarray, np.ndarray]:
        return window.places(points.x[which], points.y[which], corner, cell)

    for part in parts_of(points.count, max(size // 2, _POINTS_A_PART)):
        inside = np.flatnonzero(are_inside(*places(part), window.shape)) + part.start
        # The highest points so far, and the points of this part.
        which = np.concatenate((top, inside))
        row, column = places(which)
        keys = -points.z[which], points.x[which], points.y[which]
        top = which[first_of_each(row * window.columns + column, size, *keys)]
        progress(part.stop / points.count)
    return (top, *places(top))


def _confidence(step: RasterStep, seen: Seen, progress: Progress) -> Made:
    """Return the confidence, computed in cells of 1 m, at the centre of each cell."""
    window = seen.window
    values = np.full(window.shape, np.nan, dtype=np.float32)
    if not seen.points.count or not min(window.shape):
        return values, None
    cells, known = confidence(seen.points, seen.ground)
    x, y = (
        ((first + np.arange(count) + 0.5) * step.cell - at) / cells.size
        for first, count, at in zip(window[1::-1], window[:1:-1], seen.corner)
    )
    row = np.floor(y).astype(np.int64) - cells.first_row
    column = np.floor(x).astype(np.int64) - cells.first_column
    rows, columns = (
        np.flatnonzero((at >= 0) & (at < count))
        for at, count in ((row, cells.rows), (column, cells.columns))
    )
    values[np.ix_(rows, columns)] = known[np.ix_(row[rows], column[columns])]
    return values, None


class Layer(NamedTuple):
    """A layer from which rasters are made."""

    # returns its cells, and the points needed across wide gaps
    make: Callable[[RasterStep, Seen, Progress], Made]
    cost: float  # time that it takes, in relation to the other layers
    of_ground: bool  # needs ground points
    of_all: bool  # needs points that are not ground


LAYERS = {
    "terrain": Layer(_terrain, 3.0, of_ground=True, of_all=False),
    "surface": Layer(_surface, 4.0, of_ground=False, of_all=True),
    "confidence": Layer(_confidence, 1.5, of_ground=True, of_all=True),
}


def _within(box: Box, points: Points, corner: tuple[float, float], margin: float) -> Box:
    """Return the part of a box with points and a margin; an empty box without points."""
    if not points.count:
        return (*box[:2], *box[:2])
    low, high = (
        [getattr(each, which)() + at for each, at in zip(points[:2], corner)]
        for which in ("min", "max")
    )
    west, south = (max(a, b - margin) for a, b in zip(box[:2], low))
    east, north = (min(a, b + margin) for a, b in zip(box[2:], high))
    return west, south, max(east, west), max(north, south)


def _placed(points: Points, corner: tuple[float, float], which: np.ndarray) -> np.ndarray:
    """Return the selected points in the frame of the survey, shape (n, 3)."""
    some = points.take(which)
    return np.column_stack((some.x + corner[0], some.y + corner[1], some.z))


def _extent(points: Points, core: np.ndarray, corner: tuple[float, float]) -> np.ndarray:
    """Return smallest x and y, largest x and y of the points in the block."""
    if not core.any():
        return np.full(4, np.nan)
    x, y = points.x[core], points.y[core]
    return np.array([x.min(), y.min(), x.max(), y.max()]) + np.tile(corner, 2)
