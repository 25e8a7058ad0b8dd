"""Heights on the TIN of thinned points at places in a tile, from the few vertices near each."""

from __future__ import annotations

from typing import Iterator, NamedTuple

import numpy as np

from ..core.threads import parts_of
from .delaunay_walk import (
    NOWHERE,
    enclosing_triangles,
    heights_of_four,
    interpolated,
    listed,
    longest_edge,
    picked,
)
from .lattice_sample import LatticeSample

# Widths in cells of the windows in which triangles are searched, one after the other. With each,
# the number of queries for each vertex of the tile above which a triangulation takes less time.
_WINDOWS = ((2, 6.0), (4, 5.0), (6, 3.0), (8, 2.0), (12, 0.5), (16, 0.5))
WIDEST = _WINDOWS[-1][0]
_MARGIN = WIDEST // 2 + 1
# The vertices of windows this wide are listed first, because many of their cells are empty.
_LEAST_LISTED = 6
# Vertices of the queries that are computed at a time. Fewer make short arrays, too (see `TILE`);
# more take memory in each thread.
_TOGETHER = 1 << 17
# Queries whose windows are counted at a time.
_QUERIES = 1 << 16


class Queries(NamedTuple):
    """Places in a tile at which heights are wanted."""

    x: np.ndarray  # float64 (q,), in cells of the lattice, from the corner of the tile
    y: np.ndarray  # float64 (q,)
    column: np.ndarray  # intp (q,), the corner of cells nearest to each query
    row: np.ndarray  # intp (q,)

    def take(self, indices: np.ndarray | slice) -> Queries:
        """Return the selected queries."""
        return Queries(*(column[indices] for column in self))


class LocalDelaunay:
    """The vertices of a tile (row and column), which give heights at queries from those near each;
    triangles with an edge longer than `max_edge` cells are gaps.
    """

    # If queries lie on corners of cells (`are_corners`), each quarter of a window is a quarter of
    # the plane round the query.

    def __init__(
        self,
        thinned: LatticeSample,
        place: tuple[int, int],
        are_corners: bool,
        max_edge: float = np.inf,
    ) -> None:
        window = thinned.window(place, _MARGIN)
        # Row by row, so that the vertices of cells in a row follow one another. Empty cells have
        # the number -1: it is the index of the last element, which is no vertex.
        occupied = window.lattice >= 0
        order = window.lattice[occupied]
        self._x, self._y = (np.append(axis[order], NOWHERE) for axis in window[1:3])
        self._z = np.append(thinned.points.z[window.source[order]], 0.0)
        self._before = np.concatenate(([0], np.cumsum(occupied)))
        # Number of vertices southwest of each corner of cells.
        self._counts = np.zeros(np.add(window.lattice.shape, 1), dtype=np.intp)
        self._counts[1:, 1:] = occupied.cumsum(axis=0).cumsum(axis=1)
        self._lattice = np.where(occupied.ravel(), self._before[:-1], -1)
        self._columns = window.lattice.shape[1]
        # Whether the 2 x 2 cells from each one on all have a vertex.
        padded = np.pad(occupied, ((0, 1), (0, 1)))
        rows = padded[1:] & padded[:-1]
        self._are_full = rows[:, 1:] & rows[:, :-1]
        self._are_corners, self._max_edge = are_corners, max_edge

    def heights(self, queries: Queries) -> tuple[np.ndarray, np.ndarray]:
        """Return heights at queries, NaN outside of triangles, and which of them are certain."""
        heights = np.full(len(queries.x), np.nan)
        sure = np.zeros(len(queries.x), dtype=bool)
        left = np.arange(len(queries.x))
        for width, most in _WINDOWS:
            if len(left) > most * (len(self._x) - 1):
                break
            for part in parts_of(len(left), _QUERIES):
                for likely in self._promising(queries, left[part], width):
                    heights[likely], sure[likely] = self._in_windows(queries.take(likely), width)
            left = left[~sure[left]]
        return heights, sure

    def _promising(self, queries: Queries, left: np.ndarray, width: int) -> Iterator[np.ndarray]:
        """Yield, part by part, the queries with vertices in all quarters of their window."""
        chosen = queries.take(left)
        if width == 2:
            left = left[self._are_full.take(self._start(chosen, 1))]
        else:
            west, middle, east = (
                self._counts_southwest(chosen, width // 2, across) for across in (-1, 0, 1)
            )
            columns = middle - west, east - middle
            quarters = [part for half in columns for part in (half[1] - half[0], half[2] - half[1])]
            kept = np.flatnonzero(np.min(quarters, axis=0) > 0)
            left, counts = left[kept], np.sum(quarters, axis=0)[kept]
        if width < _LEAST_LISTED:
            counts = np.full(len(left), width * width)
        else:
            order = np.argsort(counts, kind="stable")
            left, counts = left[order], counts[order]
        start = 0
        while start < len(left):
            # Queries are sorted by their vertices: none of the part has more than this one.
            most = min(start + _TOGETHER // int(counts[start]), len(left)) - 1
            stop = start + max(_TOGETHER // int(counts[most]), 1)
            yield left[start:stop]
            start = stop

    def _counts_southwest(self, queries: Queries, half: int, across: int) -> np.ndarray:
        """Return the number of vertices southwest of three corners of windows, (3, q): south,
        middle and north, in the west (`across` -1), in the middle (0) or in the east (1).
        """
        start = queries.column + across * half + _MARGIN
        rows = queries.row + _MARGIN + np.array([[-half], [0], [half]])
        return self._counts.take(rows * (self._columns + 1) + start)

    def _in_windows(self, queries: Queries, width: int) -> tuple[np.ndarray, np.ndarray]:
        """Return heights from windows of `width` cells, and which of them are certain."""
        half, quarters = width // 2, None
        if width < _LEAST_LISTED:
            across = np.arange(width)
            cells = (across[:, None] * self._columns + across).ravel()
            vertices = self._lattice.take(self._start(queries, half) + cells[:, None])
            quarters = _quarters(width) if self._are_corners else None
        else:
            vertices = listed(*self._runs(queries, width))
        x, y = self._x.take(vertices) - queries.x, self._y.take(vertices) - queries.y
        if width == 2:
            in_turn, z = [0, 1, 3, 2], self._z.take(vertices)
            return heights_of_four(x[in_turn], y[in_turn], z[in_turn], self._max_edge)
        by = queries.column - queries.x, queries.row - queries.y
        borders = np.array([half - by[0], half - by[1], half + by[0], half + by[1]])
        corners, found, sure = enclosing_triangles(x, y, borders, quarters)
        a, b, z = picked(x, corners), picked(y, corners), self._z.take(picked(vertices, corners))
        heights = interpolated(a, b, z)
        heights[~found | (longest_edge(a, b) > self._max_edge)] = np.nan
        return heights, sure

    def _start(self, queries: Queries, half: int) -> np.ndarray:
        """Return the cell in the southwestern corner of the window of each query."""
        return (queries.row - half + _MARGIN) * self._columns + queries.column - half + _MARGIN

    def _runs(self, queries: Queries, width: int) -> tuple[np.ndarray, np.ndarray]:
        """Return the first vertex in each row of each query's window, and how many are there."""
        start = self._start(queries, width // 2) + np.arange(width)[:, None] * self._columns
        first = self._before.take(start)
        return first, self._before.take(start + width) - first


def _quarters(width: int) -> list[np.ndarray]:
    """Return which cells of a window lie southwest, southeast, northeast and northwest."""
    numbers, half = np.arange(width * width).reshape(width, width), width // 2
    low, high = slice(None, half), slice(half, None)
    return [
        numbers[rows, columns].ravel()
        for rows, columns in ((low, low), (low, high), (high, high), (high, low))
    ]
