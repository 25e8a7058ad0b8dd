"""The highest point of each cell, by its elevation for the surface and by its height above the
ground for the canopy.
"""

from __future__ import annotations

import math

import numpy as np

from ...core.points import Points
from ...core.progress import SILENT, Progress
from ...core.threads import parts_of
from ...grids.cell_window import CellWindow
from ...grids.cells import are_inside, first_of_each
from ...grids.high_groups import HighGroups
from ...grids.morphology import within_square
from ...tin.dense_surface import VERTICES_A_SIDE, DenseSurface
from ...tin.height_above_ground import GroundSurface
from .block_view import BlockView, LayerCells, LayerSizes, Made
from .terrain_edges import TerrainAtEdges

_POINTS_A_PART = 1 << 20  # least number of points that are processed together
_SURFACES = "surface", "canopy"


def surfaces(
    sizes: LayerSizes,
    view: BlockView,
    window: CellWindow,
    made: Made,  # with the terrain, if the canopy is wanted
    progress: Progress,
) -> LayerCells:
    """Return the surface and the canopy, if wanted, without points that hang in the
    air, such as birds.
    """
    chosen = view.top
    if chosen.any():
        chosen = chosen & ~HighGroups().find(view.points)
    points, core = view.points.take(chosen), view.core[chosen]
    names = [name for name in _SURFACES if name in sizes.layers]
    if not points.count or window.is_empty:
        nothing = np.full(window.shape, np.nan, dtype=np.float32)
        alone = view.in_survey(points.take(core))
        return dict.fromkeys(names, nothing), dict.fromkeys(names, alone)
    cells, at_gaps = {}, {}
    for name, part in zip(names, progress.shares(*[1.0] * len(names))):
        if name == "canopy" and view.ground.any():
            is_above = ~view.ground[chosen]
            heights, loose = _canopy(sizes, view, window, made["terrain"], points, is_above, part)
        else:
            heights, loose = _highest_points(sizes, points, view, window, part)
        cells[name] = heights.astype(np.float32)
        at_gaps[name] = view.in_survey(points.take(loose & core))
    return cells, at_gaps


def _canopy(
    sizes: LayerSizes,
    view: BlockView,
    window: CellWindow,
    terrain: np.ndarray,
    points: Points,
    is_above: np.ndarray,
    progress: Progress,
) -> tuple[np.ndarray, np.ndarray]:
    """Return the greatest height above the ground of each cell, on top of the terrain in the
    middle of the cell, and which points wide gaps need, given those that are not ground.
    """
    # A surface that leans on the terrain: minus the terrain of the cell, which across wide gaps is
    # not known in a block, it is the height above the ground under the point.
    ground = _Ground(sizes, view, progress.part(0.0, 0.2))
    above = np.zeros(points.count)
    above[is_above] = points.z[is_above] - ground.below(
        points.x[is_above], points.y[is_above], progress.part(0.2, 0.5)
    )
    points = Points(points.x, points.y, above)
    heights, loose = _highest_points(sizes, points, view, window, progress.part(0.5, 1.0))
    below = terrain.astype(np.float64)
    row, column = np.nonzero(np.isnan(terrain) & ~np.isnan(heights))
    if len(row):
        west, south = view.start(window, sizes.cell)
        x, y = west + (column + 0.5) * sizes.cell, south + (row + 0.5) * sizes.cell
        below[row, column] = ground.below(x, y)
    return heights + below, loose


class _Ground:
    """The TIN of the ground that a block sees, for heights above it."""

    def __init__(self, sizes: LayerSizes, view: BlockView, progress: Progress) -> None:
        points = view.points.take(view.ground)
        self._surface, self._edges = GroundSurface(points, progress), None
        if view.edges is not None and view.edges.any():
            self._edges = TerrainAtEdges(points, view.edges[view.ground], sizes.cell)

    def below(self, x: np.ndarray, y: np.ndarray, progress: Progress = SILENT) -> np.ndarray:
        """Return the ground under places, float64 (n,)."""
        heights = self._surface.heights(x, y, progress)
        if self._edges is not None:
            self._edges.follow(heights, x, y)
        return heights


def _highest_points(
    sizes: LayerSizes,
    points: Points,
    view: BlockView,
    window: CellWindow,
    progress: Progress,
) -> tuple[np.ndarray, np.ndarray]:
    """Return the z of the highest point of each cell, in empty cells of the TIN of these points,
    and which points wide gaps need.
    """
    cell = sizes.cell
    margin = math.ceil(sizes.reach / cell)
    wide = window.wider(margin)
    top, row, column = _highest(points, wide, view.corner, cell, progress.part(0.0, 0.35))
    heights = np.full(wide.shape, np.nan)
    heights[row, column] = points.z[top]
    inner = slice(margin, margin + window.rows), slice(margin, margin + window.columns)
    # No cell farther from all vertices lies in a triangle that counts.
    reach = math.ceil(sizes.longest_edge / math.sqrt(3.0) / cell) + 1
    near = within_square(np.maximum, np.isfinite(heights), reach)[inner]
    heights = heights[inner]
    progress(0.4)
    row, column = np.nonzero(np.isnan(heights) & near)
    start, part = view.start(window, cell), progress.part(0.4, 0.6)
    surface = DenseSurface(points.take(top), VERTICES_A_SIDE * cell, start, part)
    if len(row):
        x, y = start[0] + (column + 0.5) * cell, start[1] + (row + 0.5) * cell
        part = progress.part(0.6, 1.0)
        heights[row, column] = surface.heights(x, y, sizes.longest_edge, part)
    loose = np.zeros(points.count, dtype=bool)
    if sizes.max_edge is None:
        loose[top[surface.hull]] = True
    return heights, loose


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
