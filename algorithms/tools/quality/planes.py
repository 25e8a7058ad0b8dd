"""Planes through the ground round the cells of a survey."""

from __future__ import annotations

from typing import Iterable, Iterator, Sequence

import numpy as np

from ...grids.parts import parts_with
from ...grids.planes import means_and_moments, plane_slopes

# Cells to each side of a cell whose ground makes its plane: the first with enough points.
WINDOWS = (1, 2, 4, 10)
# Fewest points of a plane; three would fit any.
_LEAST_POINTS = 6
# The determinant of the moments of their places, as a share of the square of their sum, is larger
# than this: points in a line have 0 and say nothing of the slope across it, a square has 0.25.
_LEAST_SPREAD = 0.02


def planes(
    number: np.ndarray,  # of the ground points of cells
    totals: Sequence[np.ndarray],  # of their x and y from the centre of the cell, and of their z
    size: float,
    filled: np.ndarray,  # boolean: cells with points; no others have ground
    wanted: np.ndarray,  # boolean
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return row and column of the n wanted cells of a size in metres, and planes through the
    ground round them, (3, n): height at the centre, slopes to east and north; NaN for none.
    """
    # From the middle of all cells: numbers are so small that no digit of their squares is lost.
    (rows, columns), (x, y, z) = number.shape, totals
    north, east = (np.arange(rows) - rows // 2) * size, (np.arange(columns) - columns // 2) * size
    occupied = np.nonzero(filled)
    ground = tuple(sides[number[occupied] > 0] for sides in occupied)
    base = float((z[ground] / number[ground]).min()) if len(ground[0]) else 0.0
    cells, left = np.flatnonzero(wanted), wanted.copy()
    found = np.full((3, len(cells)), np.nan)
    for window in WINDOWS:
        least = 1 if window == WINDOWS[-1] else _LEAST_POINTS
        for part in parts_with(left, window):
            there, count = part.around, number[part.around].astype(np.float64)
            place = np.nonzero(left[part.core])
            near = _summed(count, window)[part.inner][place]
            place, near = tuple(sides[near >= least] for sides in place), near[near >= least]
            if not len(near):
                continue
            mean_x, mean_y, mean_z = (total[there] / np.maximum(count, 1.0) for total in (x, y, z))
            mean_x, mean_y = mean_x + east[there[1]], mean_y + north[there[0], None]
            mean_z = np.where(count > 0, mean_z - base, 0.0)
            _, *values = moments(count, mean_x, mean_y, mean_z)
            sums = (_summed(moment, window)[part.inner][place] for moment in values)
            is_good, plane = plane_of((near, *sums))
            is_good |= least == 1
            row, column = (side.start + sides for side, sides in zip(part.core, place))
            plane[0] += base + plane[1] * east[column] + plane[2] * north[row]
            left[row[is_good], column[is_good]] = False
            found[:, np.searchsorted(cells, row * columns + column)[is_good]] = plane[:, is_good]
    return (*np.divmod(cells, columns), found)


def _summed(values: np.ndarray, window: int) -> np.ndarray:
    """Return the sums over the cells up to `window` cells to each side."""
    from scipy import ndimage

    for axis in (0, 1):
        values = ndimage.convolve1d(values, np.ones(2 * window + 1), axis, mode="constant")
    return values


def moments(
    number: np.ndarray, x: np.ndarray | float, y: np.ndarray | float, z: np.ndarray
) -> Iterator[np.ndarray]:
    """Yield what sums up to the plane of least squares through points, for `plane_of`."""
    yield from (number * value for value in (1.0, x, y, z, x * x, x * y, y * y, x * z, y * z))


def plane_of(sums: Iterable[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Return whether points are enough and not on a line, and their planes of least squares, from
    sums of `moments`: height at (0, 0) and slopes to east and north, 0 for too few points.
    """
    count, *others = sums
    x, y, z, xx, xy, yy, xz, yz = means_and_moments(np.maximum(count, 1.0), *others)
    spread = xx * yy - xy * xy
    is_good = (count >= _LEAST_POINTS) & (spread > _LEAST_SPREAD * (xx + yy) ** 2) & (xx + yy > 0)
    east, north = (np.where(is_good, rise, 0.0) for rise in plane_slopes(xx, xy, yy, xz, yz))
    return is_good, np.stack((z - east * x - north * y, east, north))
