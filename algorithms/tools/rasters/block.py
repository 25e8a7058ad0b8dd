"""Makes the layers of a block of a survey, of which rasters are made."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial
from typing import Any, Callable, Mapping, NamedTuple, Optional, Tuple

import numpy as np

from ...core.points import Box, Points, box_round
from ...core.progress import SILENT, Progress
from ...core.threads import over_parts, parts_of
from ...grids.cell_window import CellWindow
from ...grids.cells import Cells, are_inside, first_of_each
from ...grids.expected_error import CELL, causes_of, error_of, evidence, factor_of_looks
from ...grids.high_groups import HighGroups
from ...grids.morphology import within_square
from ...tin.dense_surface import VERTICES_A_SIDE, DenseSurface
from ...tin.lattice_sample import LatticeSample
from .terrain_edges import follow_edges

# Longest edge of the triangles in a block, in metres and in cells. Triangles across wider gaps need
# points from farther away than a block sees, so they are made when all blocks are done.
_LONGEST_EDGE = 50.0
_LONGEST_CELLS = 20.0
# Reach of a triangle in longest edges. Its circumcircle hardly ever reaches farther.
_EDGES = 2.0
# The layer that tells what each cell contains: bits for ground points in its four quarters, from
# southwest to northeast, a bit for any points, and one for points of the surface.
CONTENTS = "contents"
QUARTERS = 4
ANY = 16
TOP = 32
# Rounding error of coordinates in metres.
_ROUNDING = 1e-6
_POINTS_A_PART = 1 << 20  # least number of points that are processed together
_POINTS_SEEN = 1 << 16  # points whose arrays stay in the cache


class BlockRasters(NamedTuple):
    """The layers of a block, with rows from south to north."""

    window: CellWindow  # the cells of the block
    # float32, (rows, columns), NaN for no value, by names in `LAYERS`; also `CONTENTS`, of uint8;
    # arrays or `RowsOnDisk`
    layers: Mapping[str, Any]
    # float64, (n, 3): for layers with filled gaps, the points of the block that are needed across
    # wide gaps, corners of the convex hull and points beside cells without a height
    loose: Mapping[str, np.ndarray]
    box: np.ndarray  # float64, (4,): extent of the points in the block; NaN if it has none
    counts: np.ndarray  # int64, (2,): points of terrain and of surface in the block


class BlockView(NamedTuple):
    """The points that a block sees, in it and in its surroundings."""

    points: Points  # relative to `corner`
    ground: np.ndarray  # bool, (n,)
    top: np.ndarray  # bool, (n,): which belong to the surface
    core: np.ndarray  # bool, (n,): which lie in the block
    corner: tuple[float, float]  # origin of `points` in the frame of the survey
    edges: np.ndarray | None = None  # bool, (n,): ground on lines that no triangle may cross
    # the ground as another step has thinned it, and which of its points lie in the block
    thinned: tuple[LatticeSample, np.ndarray] | None = None
    lacks_ground: bool = False  # that ground is not among the points
    looks: tuple[np.ndarray, ...] = ()  # bool, (n,): the ground of several looks, if there were any

    @property
    def parts(self) -> list[tuple[Points, np.ndarray, np.ndarray, np.ndarray]]:
        """All points in one or two parts, with `ground`, `top` and `core` of each."""
        parts = [(self.points, self.ground, self.top, self.core)]
        if self.thinned is not None and self.lacks_ground:
            points, core = self.thinned[0].points, self.thinned[1]
            parts.append((points, *np.broadcast_to([[True], [False]], (2, points.count)), core))
        return parts

    def window(self, box: Box, cell: float) -> CellWindow:
        """Return the cells whose centres lie in a box, and not a cell beyond the points."""
        west, south, east, north = box
        boxes = [points.box for points, *_ in self.parts if points.count]
        if not boxes:
            return CellWindow.with_centres_in((west, south, west, south), cell)
        whole = box_round(np.array(boxes))
        low_x, low_y, high_x, high_y = np.add(whole, np.tile(self.corner, 2)).tolist()
        west, south = max(west, low_x - cell), max(south, low_y - cell)
        east, north = min(east, high_x + cell), min(north, high_y + cell)
        return CellWindow.with_centres_in((west, south, max(east, west), max(north, south)), cell)

    def in_survey(self, points: Points) -> np.ndarray:
        """Return points in the frame of the survey, shape (n, 3)."""
        return np.add(np.column_stack(points), (*self.corner, 0.0))

    def start(self, window: CellWindow, cell: float) -> tuple[float, float]:
        """Return the corner of a window in the frame of the points."""
        (x, y), (west, south) = self.corner, window.corner(cell)
        return west - x, south - y


@dataclass(frozen=True)
class RasterStep:
    """Makes the layers of a block."""

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

    def of(self, view: BlockView, box: Box, progress: Progress = SILENT) -> BlockRasters:
        """Return the layers of a block, a box in the frame of the survey."""
        window = view.window(box, self.cell)
        layers, loose = {CONTENTS: _contents(self, view, window)}, {}
        parts = progress.shares(*(LAYERS[name].cost for name in self.layers))
        for name, part in zip(self.layers, parts):
            if name in layers:  # made together with another one
                continue
            found, points_at_gaps = LAYERS[name].make(self, view, window, part)
            layers.update(found)
            if points_at_gaps is not None:
                loose[name] = points_at_gaps
        counts, boxes, extent = np.zeros(2, dtype=np.int64), [], np.full(4, np.nan)
        for points, ground, top, core in view.parts:
            counts += [np.count_nonzero(flags & core) for flags in (ground, top)]
            if core.any():
                low, high = (
                    [of(axis, where=core, initial=start) for axis in points[:2]]
                    for of, start in ((np.min, np.inf), (np.max, -np.inf))
                )
                boxes.append([*low, *high])
        if boxes:
            extent = box_round(np.array(boxes)) + np.tile(view.corner, 2)
        progress(1.0)
        return BlockRasters(window, layers, loose, extent, counts)


# The cells of layers by their names, and the points needed across wide gaps; None if these stay
# open.
_LayerCells = Tuple[Mapping[str, np.ndarray], Optional[np.ndarray]]


def _contents(step: RasterStep, view: BlockView, window: CellWindow) -> np.ndarray:
    """Return what each cell contains, as `CONTENTS` says."""
    quarters = CellWindow(*(2 * number for number in window))
    any_points, ground, top = np.zeros((3, quarters.rows * quarters.columns), dtype=bool)

    def see(points: Points, are_ground: np.ndarray, are_top: np.ndarray, part: slice) -> None:
        x, y = points.x[part], points.y[part]
        row, column = quarters.places(x, y, view.corner, step.cell / 2.0)
        inside = are_inside(row, column, quarters.shape)
        index = row * quarters.columns + column
        any_points[index[inside]] = True
        top[index[inside & are_top[part]]] = True
        inside &= are_ground[part]
        ground[index[inside]] = True
        # A point on the middle line of a cell lies in the quarters on both sides.
        before = quarters.places(x - _ROUNDING, y - _ROUNDING, view.corner, step.cell / 2.0)
        is_south, is_west = (
            inside & (low < own) & (own % 2 > 0) for own, low in zip((row, column), before)
        )
        for on_border, cells in ((is_south, quarters.columns), (is_west, 1)):
            ground[index[on_border] - cells] = True
        ground[index[is_south & is_west] - quarters.columns - 1] = True

    for points, are_ground, are_top, _ in view.parts:
        over_parts(partial(see, points, are_ground, are_top), points.count, _POINTS_SEEN, SILENT)
    any_points, ground, top = (flags.reshape(quarters.shape) for flags in (any_points, ground, top))
    contents = np.zeros(window.shape, dtype=np.uint8)
    for number in range(QUARTERS):
        quarter = slice(number // 2, None, 2), slice(number % 2, None, 2)
        contents |= ground[quarter].view(np.uint8) << number
        contents |= any_points[quarter].view(np.uint8) * np.uint8(ANY)
        contents |= top[quarter].view(np.uint8) * np.uint8(TOP)
    return contents


def _terrain(
    step: RasterStep, view: BlockView, window: CellWindow, progress: Progress
) -> _LayerCells:
    """Return heights of the terrain."""
    known, core = view.thinned or (None, view.core[view.ground])
    points = view.points.take(view.ground) if known is None else known.points
    if not points.count or window.is_empty:
        nothing = np.full(window.shape, np.nan, dtype=np.float32)
        return {"terrain": nothing}, view.in_survey(points.take(core))
    start = view.start(window, step.cell)
    surface = DenseSurface(points, step.cell, start, progress.part(0.05, 0.3), known)
    heights = surface.raster(window.shape, step.longest_edge, progress.part(0.3, 0.95))
    loose = np.zeros(points.count, dtype=bool)
    if step.max_edge is None:
        missing = np.isnan(heights)
        if missing.any():
            vertices = surface.vertices
            places = window.places(*points.take(vertices)[:2], view.corner, step.cell)
            cells = (np.clip(place, 0, most - 1) for place, most in zip(places, window.shape))
            loose[vertices[within_square(np.maximum, missing, 1)[tuple(cells)]]] = True
        loose[surface.hull] = True
    heights = heights.astype(np.float32)
    if view.edges is not None and view.edges.any():
        follow_edges(heights, window, step.cell, points, view.edges[view.ground], view.corner)
    return {"terrain": heights}, view.in_survey(points.take(loose & core))


def _surface(
    step: RasterStep, view: BlockView, window: CellWindow, progress: Progress
) -> _LayerCells:
    """Return the height of the highest point of each cell, but for points that hang in the air,
    such as birds; in empty cells, of their TIN.
    """
    chosen, cell = view.top, step.cell
    if chosen.any():
        chosen = chosen & ~HighGroups().find(view.points)
    points = view.points.take(chosen)
    if not points.count or window.is_empty:
        nothing = np.full(window.shape, np.nan, dtype=np.float32)
        return {"surface": nothing}, view.in_survey(points.take(view.core[chosen]))
    margin = math.ceil(step.reach / cell)
    wide = window.wider(margin)
    top, row, column = _highest(points, wide, view.corner, cell, progress.part(0.0, 0.35))
    heights = np.full(wide.shape, np.nan)
    heights[row, column] = points.z[top]
    inner = slice(margin, margin + window.rows), slice(margin, margin + window.columns)
    # No cell farther from all vertices lies in a triangle that counts.
    reach = math.ceil(step.longest_edge / math.sqrt(3.0) / cell) + 1
    near = within_square(np.maximum, np.isfinite(heights), reach)[inner]
    heights = heights[inner]
    progress(0.4)
    row, column = np.nonzero(np.isnan(heights) & near)
    start, part = view.start(window, cell), progress.part(0.4, 0.6)
    surface = DenseSurface(points.take(top), VERTICES_A_SIDE * cell, start, part)
    if len(row):
        x, y = start[0] + (column + 0.5) * cell, start[1] + (row + 0.5) * cell
        part = progress.part(0.6, 1.0)
        heights[row, column] = surface.heights(x, y, step.longest_edge, part)
    loose = np.zeros(points.count, dtype=bool)
    if step.max_edge is None:
        loose[top[surface.hull]] = True
    loose &= view.core[chosen]
    return {"surface": heights.astype(np.float32)}, view.in_survey(points.take(loose))


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

    def places(indices: np.ndarray | slice) -> tuple[np.ndarray, np.ndarray]:
        return window.places(points.x[indices], points.y[indices], corner, cell)

    for part in parts_of(points.count, max(size // 2, _POINTS_A_PART)):
        inside = np.flatnonzero(are_inside(*places(part), window.shape)) + part.start
        # The highest points so far, and the points of this part.
        indices = np.concatenate((top, inside))
        row, column = places(indices)
        keys = -points.z[indices], points.x[indices], points.y[indices]
        top = indices[first_of_each(row * window.columns + column, size, *keys)]
        progress(part.stop / points.count)
    return (top, *places(top))


# What the evidence for errors tells, by the layers.
_OF_EVIDENCE = {"expected_error": error_of, "error_cause": causes_of}


def _errors(
    step: RasterStep, view: BlockView, window: CellWindow, progress: Progress
) -> _LayerCells:
    """Return the expected error and its cause, those that are wanted, at the centre of each cell;
    their evidence is found once, in cells of 1 m.
    """
    found = {
        name: np.full(window.shape, np.nan, dtype=np.float32)
        for name in _OF_EVIDENCE
        if name in step.layers
    }
    if not view.points.count or window.is_empty:
        return found, None
    cells = Cells.over(view.points, CELL)
    x, y = (centres - start for centres, start in zip(window.centres(step.cell), view.corner))
    row, column = (
        np.floor(centres / cells.size).astype(np.int64) - first
        for centres, first in zip((y, x), cells.first)
    )
    inside = [(places >= 0) & (places < count) for places, count in zip((row, column), cells.shape)]
    # Several small cells can lie in one of 1 m.
    (rows, of_rows), (columns, of_columns) = (
        np.unique(places[mask], return_inverse=True) for places, mask in zip((row, column), inside)
    )
    pieces = evidence(cells, view.points.z, view.ground, rows, columns)
    for name, values in found.items():
        made = _OF_EVIDENCE[name](pieces)
        if view.looks and name == "expected_error":
            made *= factor_of_looks(cells, view.points.z, view.looks, rows, columns)
        values[np.ix_(*inside)] = made[np.ix_(of_rows, of_columns)]
    return found, None


class Layer(NamedTuple):
    """A layer from which rasters are made."""

    # returns its cells, perhaps with those of others, and the points needed across wide gaps
    make: Callable[[RasterStep, BlockView, CellWindow, Progress], _LayerCells]
    cost: float  # time that it takes, in relation to the other layers
    of_ground: bool  # needs ground points
    of_all: bool  # needs points that are not ground


LAYERS = {
    "terrain": Layer(_terrain, 3.0, of_ground=True, of_all=False),
    "surface": Layer(_surface, 4.0, of_ground=False, of_all=True),
    **dict.fromkeys(_OF_EVIDENCE, Layer(_errors, 1.5, of_ground=True, of_all=True)),
}
