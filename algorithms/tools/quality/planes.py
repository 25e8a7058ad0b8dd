"""Planes through the ground round the cells of a survey."""

from __future__ import annotations

from typing import Iterator, NamedTuple

import numpy as np

from ...grids.cells import are_inside
from ...grids.planes import means_and_moments, plane_slopes

# Cells round a cell whose ground makes its plane: the first that hold enough points.
WINDOWS = (1, 2, 4, 10)
_LEAST_POINTS, _LEAST_SPREAD = 6, 0.02
# Where fewer cells than this share want a plane, they are computed one by one.
_FEW = 0.02
# Values that are gathered together.
_GATHERED = 1 << 22


class Sums(NamedTuple):
    """Number of points of cells, and the means of their x and y from the centre, and of z."""

    number: np.ndarray
    x: np.ndarray
    y: np.ndarray
    z: np.ndarray


def planes(
    sums: Sums, size: float, wanted: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return planes through the ground round the n wanted cells of a size in metres: height at
    their centre, slope to the east and north; NaN without ground within ten cells.
    """
    places = np.flatnonzero(wanted)
    height = np.full(len(places), np.nan)
    rises = np.zeros((2, len(places)))
    some = sums.number > 0
    base = float(sums.z[some].min()) if some.any() else 0.0
    sums = sums._replace(z=np.where(some, sums.z - base, 0.0))
    for window in WINDOWS:
        left = np.flatnonzero(np.isnan(height))
        if not len(left) or not some.any():
            break
        found = np.column_stack(list(_sums_at(sums, size, window, places[left])))
        is_good, values = plane_of(found.T)
        if window == WINDOWS[-1]:
            is_good |= found[:, 0] > 0
        height[left] = np.where(is_good, values[0] + base, np.nan)
        rises[:, left] = values[1:]
    return height, rises[0], rises[1]


def plane_of(sums: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return whether points are enough and not on a line, bool (n,), and their planes of least
    squares: height at (0, 0), slopes to the east and north, (3, n), else level.
    """
    # `sums`, shape (9, n), are n, and the sums of x, y, z, x x, x y, y y, x z and y z.
    count = sums[0]
    x, y, z, xx, xy, yy, xz, yz = means_and_moments(np.maximum(count, 1.0), *sums[1:])
    spread = xx * yy - xy * xy
    is_good = (count >= _LEAST_POINTS) & (spread > _LEAST_SPREAD * (xx + yy) ** 2) & (xx + yy > 0)
    east, north = (np.where(is_good, rise, 0.0) for rise in plane_slopes(xx, xy, yy, xz, yz))
    return is_good, np.stack((z - east * x - north * y, east, north))


def _sums_at(sums: Sums, size: float, window: int, places: np.ndarray) -> Iterator[np.ndarray]:
    """Yield the sums over the squares round some cells, by whichever way takes less work."""
    if len(places) < _FEW * sums.number.size:
        return iter(_gathered(sums, size, window, places))
    return (each.ravel()[places] for each in _window_sums(sums, size, window))


def _gathered(sums: Sums, size: float, window: int, places: np.ndarray) -> np.ndarray:
    """Return the sums over the squares round some cells, shape (9, k)."""
    rows, columns = sums.number.shape
    side = 2 * window + 1
    row, column = np.divmod(places, columns)
    down, right = np.divmod(np.arange(side * side), side) - np.full((2, 1), window)
    found = np.empty((9, len(places)))
    step = max(_GATHERED // (side * side), 1)
    for start in range(0, len(places), step):
        part = slice(start, start + step)
        there = row[part, None] + down, column[part, None] + right
        inside = are_inside(*there, sums.number.shape)
        there = np.clip(there[0], 0, rows - 1), np.clip(there[1], 0, columns - 1)
        n, x, y, z = (each[there] for each in sums)
        n, x, y = n * inside, x + right * size, y + down * size
        products = (1.0, x, y, z, x * x, x * y, y * y, x * z, y * z)
        found[:, part] = [(n * each).sum(axis=1) for each in products]
    return found


def _window_sums(sums: Sums, size: float, window: int) -> Iterator[np.ndarray]:
    """Yield sums over squares of cells, with x and y from the centre of the middle cell."""
    from scipy import ndimage

    number, x, y, z = sums
    ones = np.ones(2 * window + 1)
    steps = np.arange(window, -window - 1, -1) * size  # convolutions turn their weights round

    def over(values: np.ndarray, across: np.ndarray = ones, up: np.ndarray = ones) -> np.ndarray:
        once = ndimage.convolve1d(values, across, axis=1, mode="constant")
        return ndimage.convolve1d(once, up, axis=0, mode="constant")

    nx, ny, nz = number * x, number * y, number * z
    yield over(number)
    yield over(nx) + over(number, across=steps)
    yield over(ny) + over(number, up=steps)
    yield over(nz)
    yield over(nx * x) + 2 * over(nx, across=steps) + over(number, across=steps**2)
    yield over(nx * y) + over(nx, up=steps) + over(ny, across=steps) + over(number, steps, steps)
    yield over(ny * y) + 2 * over(ny, up=steps) + over(number, up=steps**2)
    yield over(nx * z) + over(nz, across=steps)
    yield over(ny * z) + over(nz, up=steps)
