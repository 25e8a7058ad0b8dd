"""Planes through the ground round the cells of a survey."""

from __future__ import annotations

from typing import Any, Iterable, Iterator

import numpy as np

from ...grids.planes import means_and_moments, plane_slopes

# Cells round a cell whose ground makes its plane: the first that hold enough points.
WINDOWS = (1, 2, 4, 10)
_LEAST_POINTS, _LEAST_SPREAD = 6, 0.02


def planes(
    number: np.ndarray,  # of the ground points of cells
    x: np.ndarray,  # mean of these from the centre of the cell, as y
    y: np.ndarray,
    z: np.ndarray,  # mean
    size: float,
    wanted: np.ndarray,  # boolean
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return planes through the ground round the n wanted cells of a size in metres: height at
    their centre, slope to the east and north; NaN without ground within ten cells.
    """
    from scipy import ndimage

    # From the middle of all cells: numbers are so small that no digit of their squares is lost.
    (rows, columns), place = number.shape, np.nonzero(wanted)
    north, east = (np.arange(rows) - rows // 2) * size, (np.arange(columns) - columns // 2) * size
    some = number > 0
    base = float(z[some].min()) if some.any() else 0.0
    x, y, z = x + east, y + north[:, None], np.where(some, z - base, 0.0)
    height, rise_x, rise_y = np.zeros((3, len(place[0])))
    height[:] = np.nan
    for window in WINDOWS if some.any() else ():
        left = np.flatnonzero(np.isnan(height))
        row, column = place[0][left], place[1][left]
        ones, sums = np.ones(2 * window + 1), []
        for values in moments(number, x, y, z):
            for axis in (0, 1):
                values = ndimage.convolve1d(values, ones, axis, mode="constant")
            sums.append(values[row, column])
        is_good, (level, rise_x[left], rise_y[left]) = plane_of(sums)
        if window == WINDOWS[-1]:
            is_good |= sums[0] > 0
        level += base + rise_x[left] * east[column] + rise_y[left] * north[row]
        height[left] = np.where(is_good, level, np.nan)
    return height, rise_x, rise_y


def moments(number: Any, x: Any, y: Any, z: Any) -> Iterator[np.ndarray]:
    """Yield what sums up to the plane of least squares through points, for `plane_of`."""
    yield from (number * value for value in (1.0, x, y, z, x * x, x * y, y * y, x * z, y * z))


def plane_of(sums: Iterable[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Return whether points are enough and not on a line, and their planes of least squares, of
    which the sums of `moments` are given: height at (0, 0), slopes to east and north, else level.
    """
    count, *others = sums
    x, y, z, xx, xy, yy, xz, yz = means_and_moments(np.maximum(count, 1.0), *others)
    spread = xx * yy - xy * xy
    is_good = (count >= _LEAST_POINTS) & (spread > _LEAST_SPREAD * (xx + yy) ** 2) & (xx + yy > 0)
    east, north = (np.where(is_good, rise, 0.0) for rise in plane_slopes(xx, xy, yy, xz, yz))
    return is_good, np.stack((z - east * x - north * y, east, north))
