"""Heights on the TIN of thinned points, mostly without a triangulation.

Where most cells of the lattice hold a point, the few vertices near a query give its triangle
(`enclosing_triangles`). For queries near gaps, the vertices round the gaps are triangulated. The
heights are those of the Delaunay triangulation of all vertices, except where only the four vertices
round a query are used (`heights_of_four`).
"""

from __future__ import annotations

import itertools
import math
from functools import cached_property
from typing import Callable

import numpy as np

from ..core.points import Points
from ..core.progress import SILENT, Progress
from ..core.threads import in_threads
from ..grids.morphology import within_square
from .gaps import CellsOfTiles, Gaps
from .lattice_sample import TILE, LatticeSample, TilePlace
from .local_delaunay import LocalDelaunay, Queries
from .surface import CellLattice, Surface

# Cells of the lattice along the side of a raster cell: the centre of a raster cell is a corner of
# four of them.
VERTICES_A_SIDE = 2
# Distance in lattice cells from the queries near gaps within which vertices are triangulated at
# first. Others are added if a circle holds any.
_RIM = 2
_A_LITTLE = 0.01  # rounding error of a vertex at the border of a tile, in lattice cells
_ROUNDING = 1e-6  # rounding error of an anchor, as a share of a cell


class DenseSurface:
    """The TIN of thinned points: the point nearest to the centre of each lattice cell, half a
    raster cell wide, and the corners of the convex hull.
    """

    def __init__(
        self,
        points: Points,
        cell: float,  # metres
        anchor: tuple[float, float] = (0.0, 0.0),  # a corner of cells, in metres
        progress: Progress = SILENT,
        known: LatticeSample | None = None,  # of the same points, used if the cells are the same
    ) -> None:
        # The lattice begins near (0, 0), whatever the anchor, so that others can use it.
        counted = [math.floor(place / cell + _ROUNDING) for place in anchor]
        rests = [place - number * cell for place, number in zip(anchor, counted)]
        x, y = (0.0 if abs(rest) < _ROUNDING * cell else rest for rest in rests)
        # Row and column of the cell at the anchor.
        self._first, self._cell = counted[::-1], cell
        if known is None or (known.side, known.anchor) != (cell / VERTICES_A_SIDE, (x, y)):
            known = LatticeSample(points, cell / VERTICES_A_SIDE, (x, y), progress)
        self.thinned, self._points = known, known.points

    def raster(
        self,
        shape: tuple[int, int],
        max_edge: float | None = None,
        progress: Progress = SILENT,
    ) -> np.ndarray:
        """Return the heights at the centres of the cells north and east of the anchor, float64
        (rows, columns) from south; NaN outside the hull and in triangles with an edge longer than
        `max_edge`.
        """
        heights, sure = np.full(shape, np.nan), np.zeros(shape, dtype=bool)
        side = TILE // VERTICES_A_SIDE
        rows, columns = (
            range(first // side, -(-(first + count) // side))
            for first, count in zip(self._first, shape)
        )

        far = self._far_tiles(max_edge)

        def fill(place: tuple[int, int]) -> None:
            starts = [number * side - first for number, first in zip(place, self._first)]
            cells = tuple(
                slice(max(start, 0), min(start + side, count))
                for start, count in zip(starts, shape)
            )
            if far(place):
                sure[cells] = True
                return
            row, column = (
                np.arange(part.start - start, part.stop - start) * VERTICES_A_SIDE + 1
                for part, start in zip(cells, starts)
            )
            row, column = np.repeat(row, len(column)), np.tile(column, len(row))
            queries = Queries(column.astype(float), row.astype(float), column, row)
            found = self._in_tile(place, queries, True, max_edge)
            for whole, part in zip((heights, sure), found):
                whole[cells] = part.reshape(whole[cells].shape)

        in_threads(fill, itertools.product(rows, columns), progress.part(0.0, 0.5))
        left = np.flatnonzero(~sure)
        if max_edge is not None and len(left) > self._points.count:
            left = left[self._near(shape, max_edge / math.sqrt(3.0)).ravel()[left]]
        if len(left):
            row, column = np.divmod(left, shape[1])
            x, y = (
                (first + cell + 0.5) * self._cell + start
                for first, cell, start in zip(self._first[::-1], (column, row), self.thinned.anchor)
            )
            cells, part = CellLattice(self.thinned.anchor, self._cell), progress.part(0.5, 1.0)
            heights.ravel()[left] = self._rest(x, y, max_edge, part, cells)
        progress(1.0)
        return heights

    def heights(
        self,
        x: np.ndarray,
        y: np.ndarray,
        max_edge: float | None = None,
        progress: Progress = SILENT,
    ) -> np.ndarray:
        """Return the height at each query, float64 (q,), all in metres; NaN outside the hull and in
        triangles with an edge longer than `max_edge`.
        """
        heights, sure = np.full(len(x), np.nan), np.zeros(len(x), dtype=bool)

        def fill(group: tuple[tuple[int, int], np.ndarray]) -> None:
            place, indices = group
            at_x, at_y = (
                self.thinned.cells(places[indices], axis) - place[1 - axis] * TILE
                for axis, places in enumerate((x, y))
            )
            corners = (np.rint(places).astype(np.intp) for places in (at_x, at_y))
            queries = Queries(at_x, at_y, *corners)
            heights[indices], sure[indices] = self._in_tile(place, queries, False, max_edge)

        groups = self.thinned.by_tile(x, y, progress.part(0.0, 0.1))
        in_threads(fill, groups, progress.part(0.1, 0.7))
        left = np.flatnonzero(~sure)
        if len(left):
            heights[left] = self._rest(x[left], y[left], max_edge, progress.part(0.7, 1.0))
        progress(1.0)
        return heights

    def nearest(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Return the height of the vertex nearest to each query."""
        # Only the tiles that may hold it are searched. No query is farther from it than from the
        # nearest corner of the hull.
        from scipy.spatial import cKDTree

        def tree(vertices: np.ndarray) -> cKDTree:
            places = np.column_stack(self._points.take(vertices)[:2])
            # A balanced tree takes longer to build than it saves.
            return cKDTree(places, balanced_tree=False, compact_nodes=False)

        thinned, queries = self.thinned, np.column_stack((x, y))
        farthest = tree(self.hull).query(queries)[0] / thinned.side + _A_LITTLE
        row, column = thinned.cells(y, 1), thinned.cells(x, 0)
        near = [self.hull]
        for place, tile in thinned.tiles.items():
            beyond = (
                np.maximum(np.abs(places - (number + 0.5) * TILE) - 0.5 * TILE, 0.0)
                for places, number in zip((row, column), place)
            )
            if (np.hypot(*beyond) <= farthest).any():
                near.append(tile.source)
        vertices = np.concatenate(near)
        return self._points.z[vertices[tree(vertices).query(queries)[1]]]

    @property
    def vertices(self) -> np.ndarray:
        """Indices of the points that are vertices, ascending."""
        return np.flatnonzero(self._are_vertices())

    @property
    def hull(self) -> np.ndarray:
        """Indices of the points that are corners of the convex hull."""
        return self.thinned.hull

    def _in_tile(
        self, place: tuple[int, int], queries: Queries, are_corners: bool, max_edge: float | None
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return the heights of the queries in a tile, and which of them are certain."""
        longest = np.inf if max_edge is None else max_edge / self.thinned.side
        return LocalDelaunay(self.thinned, place, are_corners, longest).heights(queries)

    def _near(self, shape: tuple[int, int], reach: float) -> np.ndarray:
        """Return which cells, in squares of half the reach, can lie within it of a point."""
        side = reach / 2.0
        places = [np.floor(axis / side).astype(np.int64) for axis in self._points[1::-1]]
        first = [place.min() - 4 for place in places]
        held = np.zeros([np.ptp(place) + 9 for place in places], dtype=bool)
        held[tuple(place - start for place, start in zip(places, first))] = True
        held = within_square(np.maximum, held, 3)
        anchor, found = self.thinned.anchor[::-1], []
        for axis, count in enumerate(shape):
            centres = (self._first[axis] + np.arange(count) + 0.5) * self._cell + anchor[axis]
            square = np.floor(centres / side).astype(np.int64) - first[axis]
            found.append(np.where((square >= 0) & (square < held.shape[axis]), square, 0))
        return held[np.ix_(*found)]

    def _far_tiles(self, max_edge: float | None) -> Callable[[tuple[int, int]], bool]:
        """Return a function that tells which tiles no triangle that counts can reach."""
        if max_edge is None:
            return lambda place: False
        # A place in a triangle is nearer to one of its corners.
        reach = math.ceil(max_edge / math.sqrt(3.0) / (TILE * self.thinned.side)) + 1
        across = range(-reach, reach + 1)
        near = {
            (row + i, column + k)
            for row, column in self.thinned.tiles
            for i, k in itertools.product(across, across)
        }
        return lambda place: place not in near

    def _rest(
        self,
        x: np.ndarray,
        y: np.ndarray,
        max_edge: float | None,
        progress: Progress,
        cells: CellLattice | None = None,
    ) -> np.ndarray:
        """Return heights of the remaining queries, on a triangulation of the vertices near them."""
        near = _cells_of(self.thinned, x, y)
        are_meshed = self._are_vertices(near, _RIM)
        gaps = self._gaps
        are_used = self._are_vertices() if gaps is None else gaps.are_round(near)
        vertices = np.flatnonzero(are_meshed | are_used)
        meshed = are_meshed[vertices]
        progress(0.15)
        surface = Surface(self._points.take(vertices), meshed)
        progress(0.2)
        return surface.heights(x, y, max_edge, progress.part(0.2, 1.0), cells)

    @cached_property
    def _gaps(self) -> Gaps | None:
        return Gaps(self.thinned) if Gaps.can_be_found(self.thinned) else None

    def _are_vertices(self, near: CellsOfTiles | None = None, rim: int = 0) -> np.ndarray:
        """Return a mask (n,) of the vertices, or only of the vertices near some cells."""
        is_vertex = np.zeros(self._points.count, dtype=bool)
        is_vertex[self.thinned.hull] = True
        marked = None if near is None else _marked(near, rim)
        for place, tile in self.thinned.tiles.items():
            if marked is None:
                is_vertex[tile.source] = True
            elif place in marked:
                is_vertex[tile.source[marked[place][tile.slots]]] = True
        return is_vertex


def _cells_of(thinned: LatticeSample, x: np.ndarray, y: np.ndarray) -> CellsOfTiles:
    """Return a mask (TILE, TILE) of the cells with places for each tile that has any."""
    found = {}
    for place, indices in thinned.by_tile(x, y):
        row, column = (
            np.floor(thinned.cells(places[indices], axis)).astype(np.intp) - number * TILE
            for axis, places, number in ((1, y, place[0]), (0, x, place[1]))
        )
        found[place] = np.zeros((TILE, TILE), dtype=bool)
        found[place][row, column] = True
    return found


def _marked(cells: CellsOfTiles, rim: int) -> dict[TilePlace, np.ndarray]:
    """Return a mask (TILE * TILE,) of the cells near some cells for each tile that has any."""
    marked: dict[TilePlace, np.ndarray] = {}
    for place, held in cells.items():
        near = np.pad(held.view(np.uint8), rim)
        near = within_square(np.maximum, near, rim)
        padded = np.zeros((3 * TILE,) * 2, dtype=bool)
        padded[TILE - rim : 2 * TILE + rim, TILE - rim : 2 * TILE + rim] = near
        for i in (-1, 0, 1):
            for k in (-1, 0, 1):
                part = padded[(1 + i) * TILE : (2 + i) * TILE, (1 + k) * TILE : (2 + k) * TILE]
                if part.any():
                    beside = place[0] + i, place[1] + k
                    flat = part.ravel()
                    marked[beside] = marked[beside] | flat if beside in marked else flat.copy()
    return marked
