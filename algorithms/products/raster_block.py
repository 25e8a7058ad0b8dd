"""What a block of a survey adds to the rasters of terrain and surface."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..core.points import Points
from ..core.progress import SILENT, Progress
from ..filters.shared.confidence import confidence
from ..grids.cell_window import CellWindow
from ..grids.cells import first_of_each
from ..grids.dense_surface import VERTICES_A_SIDE, DenseSurface
from ..grids.morphology import within_square
from .terrain_edges import follow_edges

# Edges of the triangles that a block makes itself, in metres and in cells: those over wider gaps
# need points from farther away than a block sees, and are made when all blocks are there.
_LONGEST_EDGE, _LONGEST_CELLS = 50.0, 20.0
# Reach of a triangle in longest edges: the circle round it hardly ever reaches farther.
_EDGES = 2.0

Box = tuple[float, float, float, float]


class BlockRasters(NamedTuple):
    """The rasters of a block.

    Attributes
    ----------
    window : CellWindow
        Its cells.
    terrain, surface : numpy.ndarray of float32, shape (rows, columns)
        Metres, rows from south to north, NaN where there is none; of shape (0, 0) if not wanted.
    confidence : numpy.ndarray of float32, shape (rows, columns)
        Probability from 0 to 1 that the terrain is right; else as the others.
    terrain_points, surface_points : numpy.ndarray of float64, shape (n, 3)
        Points of the block that matter for wide gaps: corners of the convex hull, and those in
        cells without a height.
    box : numpy.ndarray of float64, shape (4,)
        Smallest x and y, largest x and y of the points in the block; NaN if it has none.
    counts : numpy.ndarray of int64, shape (2,)
        Points of terrain and of surface in the block.
    """

    window: CellWindow
    terrain: np.ndarray
    surface: np.ndarray
    confidence: np.ndarray
    terrain_points: np.ndarray
    surface_points: np.ndarray
    box: np.ndarray
    counts: np.ndarray


@dataclass(frozen=True)
class RasterStep:
    """Makes the rasters of a block.

    Attributes
    ----------
    cell : float
        Side of a cell in metres.
    terrain, surface, confidence : bool
        Which are wanted.
    max_edge : float or None
        Triangles with a longer edge, in metres, are gaps; none are, if it is None.
    """

    cell: float
    terrain: bool = True
    surface: bool = False
    confidence: bool = False
    max_edge: float | None = None

    @property
    def longest_edge(self) -> float:
        """Longest edge in metres of the triangles that are made of a block."""
        return self.max_edge or max(_LONGEST_EDGE, _LONGEST_CELLS * self.cell)

    @property
    def reach(self) -> float:
        """Metres round a block in which points matter for it."""
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
        """Return the rasters of a block.

        Parameters
        ----------
        points : Points
            Those of the block and round it, relative to `corner`.
        ground, top, core : numpy.ndarray of bool, shape (n,)
            Which are ground, which belong to the surface, and which lie in the block.
        corner : tuple of float
            x and y in the frame of the survey.
        box : tuple of float
            The block, in the frame of the survey.
        edges : numpy.ndarray of bool, shape (n,), optional
            Which ground points lie on lines that no triangle may cross.
        progress : Progress
            Receives progress.
        """
        window = CellWindow.with_centres_in(_within(box, points, corner, self.cell), self.cell)
        wanted = 3.0 * self.terrain, 4.0 * self.surface, 1.5 * self.confidence
        parts = progress.shares(*wanted)
        none = np.zeros((0, 0), dtype=np.float32), np.zeros((0, 3))
        terrain = surface = none
        if self.terrain:
            inside = core[ground]
            terrain = self._terrain(points.take(ground), inside, window, corner, parts[0])
            if edges is not None and edges.any() and terrain[0].size:
                some = points.take(ground), edges[ground]
                follow_edges(terrain[0], window, self.cell, *some, corner)
        if self.surface:
            surface = self._surface(points.take(top), core[top], window, corner, parts[1])
        sure = none[0]
        if self.confidence:
            sure = self._confidence(points, ground, window, corner)
        counts = [np.count_nonzero(each & core) for each in (ground, top)]
        progress(1.0)
        return BlockRasters(
            window, terrain[0], surface[0], sure, terrain[1], surface[1],
            _extent(points, core, corner), np.array(counts),
        )  # fmt: skip

    def _terrain(
        self,
        points: Points,
        core: np.ndarray,
        window: CellWindow,
        corner: tuple[float, float],
        progress: Progress,
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return heights of the terrain, and the points that matter for wide gaps."""
        if not points.count or not min(window.shape):
            return np.full(window.shape, np.nan, dtype=np.float32), _placed(points, corner, core)
        anchor = tuple(at - by for at, by in zip(window.corner(self.cell), corner))
        surface = DenseSurface(points, self.cell, anchor, progress.part(0.05, 0.3))
        part = progress.part(0.3, 0.95)
        heights = surface.raster((0, 0), window.shape, self.longest_edge, part)
        loose = np.zeros(points.count, dtype=bool)
        if self.max_edge is None:
            if np.isnan(heights).any():
                vertices = surface.vertices
                row, column = window.places(*points.take(vertices)[:2], corner, self.cell)
                row, column = (
                    np.clip(each, 0, most - 1) for each, most in zip((row, column), window.shape)
                )
                near_gap = within_square(np.maximum, np.isnan(heights), 1)
                loose[vertices[near_gap[row, column]]] = True
            loose[surface.hull] = True
        return heights.astype(np.float32), _placed(points, corner, loose & core)

    def _surface(
        self,
        points: Points,
        core: np.ndarray,
        window: CellWindow,
        corner: tuple[float, float],
        progress: Progress,
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return the highest point of each cell, between them heights on the TIN of these."""
        heights = np.full(window.shape, np.nan)
        if not points.count or not min(window.shape):
            return heights.astype(np.float32), _placed(points, corner, core)
        wide = window.wider(math.ceil(self.reach / self.cell))
        row, column = wide.places(points.x, points.y, corner, self.cell)
        inside = np.flatnonzero(
            (row >= 0) & (row < wide.rows) & (column >= 0) & (column < wide.columns)
        )
        progress(0.1)
        index = row[inside] * wide.columns + column[inside]
        keys = -points.z[inside], points.x[inside], points.y[inside]
        progress(0.25)
        top = inside[first_of_each(index, wide.rows * wide.columns, *keys)]
        every = np.full(wide.shape, np.nan)
        every[row[top], column[top]] = points.z[top]
        margin = window.row - wide.row
        heights[:] = every[margin : margin + window.rows, margin : margin + window.columns]
        progress(0.4)
        empty_row, empty_column = np.nonzero(np.isnan(heights))
        highest = points.take(top)
        start_x, start_y = (at - by for at, by in zip(window.corner(self.cell), corner))
        part = progress.part(0.4, 0.6)
        surface = DenseSurface(highest, VERTICES_A_SIDE * self.cell, (start_x, start_y), part)
        if len(empty_row):
            heights[empty_row, empty_column] = surface.heights(
                start_x + (empty_column + 0.5) * self.cell,
                start_y + (empty_row + 0.5) * self.cell,
                self.longest_edge,
                progress.part(0.6, 1.0),
            )
        loose = np.zeros(points.count, dtype=bool)
        if self.max_edge is None:
            loose[top[surface.hull]] = True
        return heights.astype(np.float32), _placed(points, corner, loose & core)

    def _confidence(
        self,
        points: Points,
        ground: np.ndarray,
        window: CellWindow,
        corner: tuple[float, float],
    ) -> np.ndarray:
        """Return the confidence of the cell of 1 m in which the centre of each cell lies."""
        values = np.full(window.shape, np.nan, dtype=np.float32)
        if not points.count or not min(window.shape):
            return values
        cells, known = confidence(points, ground)
        x, y = (
            ((first + np.arange(count) + 0.5) * self.cell - at) / cells.size
            for first, count, at in zip(window[1::-1], window[:1:-1], corner)
        )
        row = np.floor(y).astype(np.int64) - cells.first_row
        column = np.floor(x).astype(np.int64) - cells.first_column
        rows, columns = (
            np.flatnonzero((at >= 0) & (at < count))
            for at, count in ((row, cells.rows), (column, cells.columns))
        )
        values[np.ix_(rows, columns)] = known[np.ix_(row[rows], column[columns])]
        return values


def _within(box: Box, points: Points, corner: tuple[float, float], margin: float) -> Box:
    """Return the part of a box in which points lie, or nothing."""
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
    """Return some points in the frame of the survey, shape (n, 3)."""
    some = points.take(which)
    return np.column_stack((some.x + corner[0], some.y + corner[1], some.z))


def _extent(points: Points, core: np.ndarray, corner: tuple[float, float]) -> np.ndarray:
    """Return smallest x and y, largest x and y of the points in the block."""
    if not core.any():
        return np.full(4, np.nan)
    x, y = points.x[core], points.y[core]
    return np.array([x.min(), y.min(), x.max(), y.max()]) + np.tile(corner, 2)
