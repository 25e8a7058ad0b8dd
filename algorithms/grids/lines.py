"""Places along and beside lines, and heights of points near places."""

from __future__ import annotations

from typing import Iterable

import numpy as np

from ..core.points import Box
from .cells import are_inside, cells_at, numbered

_SHIFT = 32
_NEAREST = 16  # number of nearest points among which those on each side of a line are searched
_BESIDE = 0.01  # distance in metres of places beside a line from it


class NearPlaces:
    """The squares that hold some places, and the squares round these: they cover all places within
    the side of a square.
    """

    def __init__(self, x: np.ndarray, y: np.ndarray, side: float) -> None:
        row, column = cells_at(x, y, side)
        self._side, round_each = side, np.arange(-1, 2)
        rows, columns = np.add.outer(row, round_each), np.add.outer(column, round_each)
        self._codes = np.unique(_numbers(rows[:, :, None], columns[:, None]))
        self._first = rows.min(), columns.min()
        self._shape = np.ptp(rows) + 1, np.ptp(columns) + 1

    def of(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Return which places lie in the squares; boolean, shape (q,)."""
        row, column = cells_at(x, y, self._side)
        # Most places lie outside of the box round the squares.
        near = are_inside(row - self._first[0], column - self._first[1], self._shape)
        near[near] = np.isin(_numbers(row[near], column[near]), self._codes)
        return near


def squares(x: np.ndarray, y: np.ndarray, side: float) -> np.ndarray:
    """Return the number of the square that holds each place; int64, shape (n,)."""
    return _numbers(*cells_at(x, y, side))


def _numbers(row: np.ndarray, column: np.ndarray) -> np.ndarray:
    return (row << _SHIFT) + column


def along(line: np.ndarray, step: float, is_closed: bool = False) -> np.ndarray:
    """Return places along a line (n, 3), at most a step apart, including its corners, (m, 3); z is
    interpolated, and NaN beside corners without z.
    """
    if is_closed and len(line) and not np.array_equal(line[0, :2], line[-1, :2]):
        line = np.concatenate((line, line[:1]))
    if len(line) < 2:
        return line
    lengths = np.hypot(*np.diff(line[:, :2], axis=0).T)
    counts = np.maximum(np.ceil(lengths / step), 1).astype(np.int64)
    segment = np.repeat(np.arange(len(counts)), counts)
    share = numbered(counts) / counts[segment]
    start, end = line[segment], line[segment + 1]
    return np.concatenate((start + share[:, None] * (end - start), line[-1:]))


def near_rings(
    x: np.ndarray, y: np.ndarray, rings: Iterable[np.ndarray], distance: float
) -> np.ndarray:
    """Return which places lie within a distance, in the unit of x and y, of closed lines (m, 2),
    bool (n,).
    """
    result = np.zeros(len(x), dtype=bool)
    # Of places that are sorted by y, those near an edge are in one slice.
    order = np.argsort(y, kind="stable")
    x, y, near = x[order], y[order], result.copy()
    west, east = (x.min(), x.max()) if len(x) else (np.inf, -np.inf)
    for ring in rings:
        following = np.roll(ring, -1, axis=0)
        low, high = np.minimum(ring, following) - distance, np.maximum(ring, following) + distance
        firsts = np.searchsorted(y, low[:, 1])
        lasts = np.searchsorted(y, high[:, 1], side="right")
        touches = (firsts < lasts) & (low[:, 0] <= east) & (high[:, 0] >= west)
        for edge in np.flatnonzero(touches):
            beside = x[firsts[edge] : lasts[edge]]
            places = firsts[edge] + np.flatnonzero(
                (beside >= low[edge, 0]) & (beside <= high[edge, 0])
            )
            near[places] |= (
                _from_edge(x[places], y[places], ring[edge], following[edge]) <= distance
            )
    result[order] = near
    return result


def _from_edge(x: np.ndarray, y: np.ndarray, start: np.ndarray, end: np.ndarray) -> np.ndarray:
    """Return the distances of places from a straight line between two corners."""
    (run, rise), east, north = end - start, x - start[0], y - start[1]
    length = float(run * run + rise * rise)
    share = np.clip((east * run + north * rise) / length, 0.0, 1.0) if length else 0.0
    return np.hypot(east - share * run, north - share * rise)


class NearestHeights:
    """The heights of the points (m, 3) nearest to places, within a reach in the unit of x and y."""

    def __init__(self, points: np.ndarray, reach: float) -> None:
        from scipy.spatial import cKDTree

        self._points, self._reach = points, reach
        self._tree = cKDTree(points[:, :2]) if len(points) else None

    def near(self, places: np.ndarray) -> np.ndarray:
        """Return the height of the nearest point to each place (n, 2); NaN where none is near."""
        heights = np.full(len(places), np.nan)
        if self._tree is not None and len(places):
            far, nearest = self._tree.query(places, distance_upper_bound=self._reach)
            found = np.isfinite(far)
            heights[found] = self._points[nearest[found], 2]
        return heights

    def beside(self, line: np.ndarray) -> np.ndarray:
        """Return the places on the left of the corners of a line (n, 3), then those on the right,
        (2 n, 3), with the height of the nearest point on the same side, else on the other; z can
        be NaN.
        """
        across = np.zeros((len(line), 2))
        if len(line) > 1:
            along_x, along_y = (np.gradient(line[:, axis]) for axis in (0, 1))
            length = np.maximum(np.hypot(along_x, along_y), 1e-12)
            across = np.column_stack((-along_y, along_x)) / length[:, None]
        heights = np.full((2, len(line)), np.nan)
        if self._tree is not None and len(line):
            points, count = self._points, min(_NEAREST, len(self._points))
            far, nearest = self._tree.query(
                line[:, :2], list(range(1, count + 1)), distance_upper_bound=self._reach
            )
            near = np.isfinite(far)
            nearest = np.where(near, nearest, 0)
            side = ((points[nearest, :2] - line[:, None, :2]) * across[:, None]).sum(axis=2)
            for number, there in enumerate((near & (side > 0.0), near & (side <= 0.0))):
                first = np.argmax(there, axis=1)
                found = points[nearest[np.arange(len(line)), first], 2]
                heights[number] = np.where(there.any(axis=1), found, np.nan)
            heights = np.where(np.isnan(heights), heights[::-1], heights)
        places = [line[:, :2] + sign * _BESIDE * across for sign in (1.0, -1.0)]
        return np.column_stack((np.concatenate(places), heights.ravel()))


def inside_grid(box: Box, step: float) -> np.ndarray:
    """Return the places in a box whose x and y are multiples of a step, shape (n, 2)."""
    west, south, east, north = box
    x, y = (
        np.arange(np.ceil(low / step), np.floor(high / step) + 1) * step
        for low, high in ((west, east), (south, north))
    )
    return np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
