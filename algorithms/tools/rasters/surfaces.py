"""The highest point of each cell, by its elevation for the surface and by its height above the
ground for the canopy.
"""

from __future__ import annotations

import math
from typing import Iterator

import numpy as np

from ...core.points import Points
from ...core.progress import Progress
from ...grids.cell_window import CellWindow
from ...grids.cells import are_inside, first_of_each
from ...grids.high_groups import HighGroups
from ...grids.morphology import within_square
from ...tin.dense_surface import VERTICES_A_SIDE, DenseSurface
from ...tin.height_above_ground import GroundSurface
from ...tin.lattice_sample import TILE
from .block_view import BlockView, LayerCells, LayerSizes, Made
from .terrain_edges import TerrainAtEdges

_POINTS_A_STRIP = 1 << 20  # points of a block that are looked at together, on average
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
    names = [name for name in _SURFACES if name in sizes.layers]
    if not chosen.any() or window.is_empty:
        nothing = np.full(window.shape, np.nan, dtype=np.float32)
        alone = view.in_survey(view.points.take(chosen & view.core))
        return dict.fromkeys(names, nothing), dict.fromkeys(names, alone)
    cells, at_gaps = {}, {}
    for name, part in zip(names, progress.shares(*[1.0] * len(names))):
        if name == "canopy" and view.ground.any():
            heights, loose = _canopy(sizes, view, window, made["terrain"], chosen, part)
        else:
            heights, loose = _highest_points(sizes, view, window, chosen, None, part)
        cells[name] = heights.astype(np.float32)
        at_gaps[name] = view.in_survey(loose)
    return cells, at_gaps


def _canopy(
    sizes: LayerSizes,
    view: BlockView,
    window: CellWindow,
    terrain: np.ndarray,
    chosen: np.ndarray,
    progress: Progress,
) -> tuple[np.ndarray, Points]:
    """Return the greatest height above the ground of each cell, on top of the terrain in the
    middle of the cell, and the points that wide gaps need.
    """
    # A surface that leans on the terrain: minus the terrain of the cell, which across wide gaps is
    # not known in a block, it is the height above the ground under the point.
    ground = _Ground(sizes, view, progress.part(0.0, 0.2))
    heights, loose = _highest_points(sizes, view, window, chosen, ground, progress.part(0.2, 1.0))
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

    @property
    def tile(self) -> float:
        """Side in metres of the tiles of the TIN, which take less time when asked as a whole."""
        return TILE * self._surface.thinned.side

    def below(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Return the ground under places, float64 (n,)."""
        heights = self._surface.heights(x, y)
        if self._edges is not None:
            self._edges.follow(heights, x, y)
        return heights


def _highest_points(
    sizes: LayerSizes,
    view: BlockView,
    window: CellWindow,
    chosen: np.ndarray,
    ground: _Ground | None,
    progress: Progress,
) -> tuple[np.ndarray, Points]:
    """Return the z of the highest point of each cell, or its height above the ground, in empty
    cells of the TIN of these points, and the points that wide gaps need.
    """
    cell = sizes.cell
    margin = math.ceil(sizes.reach / cell)
    wide = window.wider(margin)
    top, points = _highest(view, chosen, ground, wide, cell, progress.part(0.0, 0.35))
    row, column = wide.places(points.x, points.y, view.corner, cell)
    heights = np.full(wide.shape, np.nan)
    heights[row, column] = points.z
    inner = slice(margin, margin + window.rows), slice(margin, margin + window.columns)
    # No cell farther from all vertices lies in a triangle that counts.
    reach = math.ceil(sizes.longest_edge / math.sqrt(3.0) / cell) + 1
    near = within_square(np.maximum, np.isfinite(heights), reach)[inner]
    heights = heights[inner]
    progress(0.4)
    row, column = np.nonzero(np.isnan(heights) & near)
    start, part = view.start(window, cell), progress.part(0.4, 0.6)
    surface = DenseSurface(points, VERTICES_A_SIDE * cell, start, part)
    if len(row):
        x, y = start[0] + (column + 0.5) * cell, start[1] + (row + 0.5) * cell
        part = progress.part(0.6, 1.0)
        heights[row, column] = surface.heights(x, y, sizes.longest_edge, part)
    loose = np.zeros(points.count, dtype=bool)
    if sizes.max_edge is None:
        loose[surface.hull] = True
    return heights, points.take(loose & view.core[top])


def _highest(
    view: BlockView,
    chosen: np.ndarray,
    ground: _Ground | None,
    window: CellWindow,
    cell: float,
    progress: Progress,
) -> tuple[np.ndarray, Points]:
    """Return the index of the highest of the chosen points in each cell that has any, ascending,
    and these points, with heights above the ground if it is given.
    """
    size, found = window.rows * window.columns, []

    def highest(points: Points) -> np.ndarray:
        row, column = window.places(points.x, points.y, view.corner, cell)
        inside = np.flatnonzero(are_inside(row, column, window.shape))
        keys = (key[inside] for key in (-points.z, points.x, points.y))
        return inside[first_of_each((row * window.columns + column)[inside], size, *keys)]

    for done, indices in _strips(view.points, chosen, ground.tile if ground else 1.0):
        points = view.points.take(indices)
        if ground is not None:
            is_above = ~view.ground[indices]
            points.z[~is_above] = 0.0
            points.z[is_above] -= ground.below(points.x[is_above], points.y[is_above])
        best = highest(points)
        found.append((indices[best], points.take(best)))
        progress(done)
    top = np.concatenate([indices for indices, _ in found])
    points = Points(*map(np.concatenate, zip(*(points for _, points in found))))
    # A cell can lie in two strips.
    best = highest(points)
    best = best[np.argsort(top[best])]
    return top[best], points.take(best)


def _strips(points: Points, chosen: np.ndarray, apart: float) -> Iterator[tuple[float, np.ndarray]]:
    """Yield the indices of the chosen points in each strip from south to north, whose limits are
    multiples of `apart` metres, and the share of the strips that are done with it.
    """
    # What is made of a point on the way takes several times the memory of the point.
    _, south, _, north = points.box
    count = -(-points.count // _POINTS_A_STRIP)
    first, last = (math.floor(limit / apart) for limit in (south, north))
    steps = range(first, last + 1, -(-(last + 1 - first) // count))
    for number, step in enumerate(steps):
        inside = chosen & (points.y >= step * apart) & (points.y < (step + steps.step) * apart)
        if inside.any():
            yield (number + 1) / len(steps), np.flatnonzero(inside)
