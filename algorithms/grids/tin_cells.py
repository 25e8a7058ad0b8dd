"""The triangle of a TIN that holds the centre of each cell, found row by row of each triangle."""

from __future__ import annotations

import numpy as np

from .cells import numbered
from .tin import Tin

# Rounding: a centre outside an edge by less than this share of a cell counts as inside.
_ON_EDGE = 1e-9
# Pairs of a triangle and a row that are computed at a time.
_PAIRS = 1 << 18


def triangles_of_cells(
    tin: Tin, corner: tuple[float, float], cell: float, shape: tuple[int, int]
) -> np.ndarray:
    """Return the triangle that holds the centre of each cell, int32 (rows, columns) from south,
    rows of `tin.triangles`; -1 for none, on an edge one of the two.
    """
    # The southwestern corner and the side of the cells are in metres.
    found = np.full(shape, -1, dtype=np.int32)
    # In cells, from the centre of the first cell.
    x, y = ((each - at) / cell - 0.5 for each, at in zip((tin.x, tin.y), corner))
    corners_y = y[tin.triangles]
    first = np.maximum(np.ceil(corners_y.min(axis=1) - _ON_EDGE), 0).astype(np.int64)
    last = np.minimum(np.floor(corners_y.max(axis=1) + _ON_EDGE), shape[0] - 1).astype(np.int64)
    held = np.flatnonzero(first <= last)
    counts = last[held] - first[held] + 1
    for some in _parts(counts):
        triangle = np.repeat(held[some], counts[some])
        row = first[triangle] + numbered(counts[some])
        west, east = _crossed(x, y, tin.triangles[triangle], row)
        left = np.maximum(np.ceil(west - _ON_EDGE), 0).astype(np.int64)
        right = np.minimum(np.floor(east + _ON_EDGE), shape[1] - 1).astype(np.int64)
        across = np.maximum(right - left + 1, 0)
        place = np.repeat(row * shape[1] + left, across) + numbered(across)
        found.ravel()[place] = np.repeat(triangle, across)
    return found


def _crossed(
    x: np.ndarray, y: np.ndarray, corners: np.ndarray, row: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return the smallest and the largest x of triangles (k, 3) on rows (k,)."""
    west, east = np.full(len(row), np.inf), np.full(len(row), -np.inf)
    for one, other in ((0, 1), (1, 2), (2, 0)):
        start_x, start_y = x[corners[:, one]], y[corners[:, one]]
        end_x, end_y = x[corners[:, other]], y[corners[:, other]]
        with np.errstate(divide="ignore", invalid="ignore"):
            share = np.where(end_y == start_y, 0.0, (row - start_y) / (end_y - start_y))
        meets = (share >= -_ON_EDGE) & (share <= 1.0 + _ON_EDGE)
        # An edge parallel to the row counts if it lies on the row.
        meets &= (end_y != start_y) | (np.abs(row - start_y) <= _ON_EDGE)
        at = start_x + np.clip(share, 0.0, 1.0) * (end_x - start_x)
        np.minimum(west, at, out=west, where=meets)
        np.maximum(east, at, out=east, where=meets)
    # If no edge meets the row because of rounding, no cell is inside.
    none = west > east
    west[none], east[none] = 0.0, -1.0
    return west, east


def _parts(counts: np.ndarray) -> list[slice]:
    """Divide triangles into parts with about equally many pairs of triangle and row."""
    if not len(counts):
        return []
    part = np.cumsum(counts) // _PAIRS
    starts = np.flatnonzero(np.diff(part, prepend=-1))
    return [slice(a, b) for a, b in zip(starts, [*starts[1:], len(counts)])]
