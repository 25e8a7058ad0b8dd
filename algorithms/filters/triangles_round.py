"""The Delaunay triangles that hold places, from the vertices in the cells near each place."""

from __future__ import annotations

from typing import Iterator

import numpy as np

from ..core.points import Points
from ..core.progress import SILENT
from ..core.threads import over_parts
from ..grids.cells import Cells
from ..tin.delaunay_walk import NOWHERE, enclosing_triangles, listed, picked

# Rows and columns to each side of a place whose vertices are searched for its triangle, in turn.
_WINDOWS = (2, 4, 8)
WIDEST = _WINDOWS[-1]
_PLACES_A_PART = 1 << 14  # places of a part, which one thread computes
_TOGETHER = 1 << 17  # vertices near places that are searched at a time
_LEAST = 3  # least number of vertices that can surround a place


class CellVertices:
    """Vertices, given by their indices in points, by the cells that hold them."""

    # For few places, this takes a tenth of the time of a triangulation of all vertices. The cells
    # must begin at multiples of their side.

    def __init__(self, points: Points, vertices: np.ndarray, cells: Cells) -> None:
        cell = cells.index[vertices]
        x, y, z = points.take(vertices)
        order = np.argsort(cell, kind="stable")
        cell = cell[order]
        # In the few cells with several vertices, these are sorted by their places.
        equal = np.flatnonzero(cell[1:] == cell[:-1])
        shared = np.union1d(equal, equal + 1)
        in_shared = order[shared]
        order[shared] = in_shared[
            np.lexsort((z[in_shared], y[in_shared], x[in_shared], cell[shared]))
        ]
        x, y, self._vertex = x[order], y[order], vertices[order]
        # Of several vertices at one place, only the lowest is kept.
        first = np.ones(len(order), dtype=bool)
        first[1:] = (np.diff(x) != 0.0) | (np.diff(y) != 0.0)
        cell, self._vertex = cell[first], self._vertex[first]
        # The last element stands for a missing vertex.
        self._x, self._y = (np.append(axis[first], NOWHERE) for axis in (x, y))
        self._before = np.zeros(cells.rows * cells.columns + 1, dtype=np.intp)
        np.cumsum(np.bincount(cell, minlength=cells.rows * cells.columns), out=self._before[1:])
        self._cells = cells

    def triangles(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Return the corners of the triangle that holds each place, intp (q, 3), ascending; -1 if
        they depend on vertices farther away, or beyond the cells.
        """
        corners = np.full((len(x), 3), -1, dtype=np.intp)
        row, column = (
            np.floor(places / self._cells.size).astype(np.intp) - first
            for places, first in zip((y, x), self._cells.first)
        )
        rows, columns = self._cells.shape

        def search(part: slice) -> None:
            for reach in _WINDOWS:
                inside = (row[part] >= reach) & (row[part] < rows - reach)
                inside &= (column[part] >= reach) & (column[part] < columns - reach)
                left = np.flatnonzero(inside & (corners[part, 0] < 0)) + part.start
                for near, vertices in self._near(left, row, column, reach):
                    corners[near] = self._found(x[near], y[near], vertices, reach)

        over_parts(search, len(x), _PLACES_A_PART, SILENT)
        return corners

    def _near(
        self, asked: np.ndarray, row: np.ndarray, column: np.ndarray, reach: int
    ) -> Iterator[tuple[np.ndarray, np.ndarray]]:
        """Yield some places (q,) at a time, with the vertices within `reach` cells, (k, q)."""
        width, lines = 2 * reach + 1, np.arange(-reach, reach + 1)[:, None]
        start = (row[asked] + lines) * self._cells.columns + column[asked] - reach
        first = self._before.take(start)
        count = self._before.take(start + width) - first
        total = count.sum(axis=0)
        order = np.argsort(total, kind="stable")
        order = order[np.searchsorted(total[order], _LEAST) :]
        while len(order):
            # Places are sorted by their vertices: none of the part has more than the last.
            most = total[order[: _TOGETHER // int(total[order[0]])]][-1]
            part, order = np.split(order, [max(_TOGETHER // int(most), 1)])
            yield asked[part], listed(first[:, part], count[:, part])

    def _found(self, x: np.ndarray, y: np.ndarray, vertices: np.ndarray, reach: int) -> np.ndarray:
        """Return the corners (q, 3) of triangles of the vertices (k, q) within `reach` cells."""
        size = self._cells.size
        from_west, from_south = (places - np.floor(places / size) * size for places in (x, y))
        more = reach * size
        window = np.stack(
            (more + from_west, more + from_south, more + size - from_west, more + size - from_south)
        )
        beside_x, beside_y = self._x.take(vertices) - x, self._y.take(vertices) - y
        triangle, found, sure = enclosing_triangles(beside_x, beside_y, window)
        corners = self._vertex[picked(vertices, triangle)].T
        corners = np.sort(corners, axis=1)
        corners[~(found & sure)] = -1
        return corners
