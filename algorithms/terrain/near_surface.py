"""Which points lie close to a surface given on a grid."""

from __future__ import annotations

import numpy as np

from ..points import Points
from ..progress import SILENT, Progress
from ..threads import in_threads, over_parts
from .cells import Cells

_POINTS_A_PART = 1 << 16
# Metres by which single precision may be wrong, of heights up to 16 km: what it leaves in doubt is
# looked at again.
_IN_DOUBT = np.float32(0.005)


def near_surface(
    points: Points,
    cells: Cells,
    lower: np.ndarray,
    upper: np.ndarray,
    progress: Progress = SILENT,
) -> np.ndarray:
    """Return which points lie between two surfaces, those of the ground less and more a tolerance.

    Both are interpolated bilinearly between the centres of the cells. Most points are decided by
    the least and the greatest of both round their cell; only the others need that.

    Parameters
    ----------
    points : Points
        The points over which `cells` were made.
    cells : Cells
        The grid.
    lower, upper : numpy.ndarray of float64, shape (rows, columns)
        Heights in metres.
    progress : Progress
        Receives progress.

    Returns
    -------
    numpy.ndarray of bool, shape (n,)
    """
    bounds = _bounds(lower, upper)
    width = cells.columns + 2
    flat = np.empty(((cells.rows + 2) * width, 2))
    for column, grid in enumerate((lower, upper)):
        flat[:, column] = np.pad(grid, 1, mode="edge").ravel()
    near = np.empty(points.count, dtype=bool)

    def decide(part: slice) -> None:
        z = points.z[part].astype(np.float32)
        least, sure_least, sure_most, most = bounds.take(cells.index[part], axis=0).T
        open_ = (z >= least) & (z <= most)
        sure = (z >= sure_least) & (z <= sure_most)
        open_ = np.flatnonzero(open_ & ~sure) + part.start
        near[part] = sure
        north = points.y.take(open_) / cells.size - (cells.first_row - 0.5)
        east = points.x.take(open_) / cells.size - (cells.first_column - 0.5)
        least, most = _bilinear(flat, width, north, east)
        z = points.z.take(open_)
        near[open_] = (z >= least) & (z <= most)

    over_parts(decide, points.count, _POINTS_A_PART, progress)
    return near


def _bilinear(
    flat: np.ndarray, width: int, north: np.ndarray, east: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Interpolate two grids side by side (cells, 2) between the four cells round each place."""
    row, column = north.astype(np.intp), east.astype(np.intp)
    corner = row * width + column
    north, east = (north - row)[:, None], (east - column)[:, None]

    def between(west: np.ndarray) -> np.ndarray:
        value = flat.take(west, axis=0)
        return value + (flat.take(west + 1, axis=0) - value) * east

    south_side = between(corner)
    values = south_side + (between(corner + width) - south_side) * north
    return values[:, 0], values[:, 1]


def _bounds(lower: np.ndarray, upper: np.ndarray) -> np.ndarray:
    """Return the extremes of two grids round each cell.

    Returns
    -------
    numpy.ndarray of float32, shape (cells, 4)
        What no point near the surface is below, what it may be below only if it lies between the
        cells so, and the same two from above.
    """
    bounds = np.empty((lower.size, 4), dtype=np.float32)

    def fill(column: int) -> None:
        grid = (lower if column < 2 else upper).astype(np.float32)
        if column % 2:
            bounds[:, column] = (_extreme(np.maximum, grid) + _IN_DOUBT).ravel()
        else:
            bounds[:, column] = (_extreme(np.minimum, grid) - _IN_DOUBT).ravel()

    in_threads(fill, range(4))
    return bounds


def _extreme(which: np.ufunc, grid: np.ndarray) -> np.ndarray:
    """Return the minimum or the maximum of the 3 x 3 cells round each cell."""
    rows = grid.copy()
    which(rows[1:], grid[:-1], out=rows[1:])
    which(rows[:-1], grid[1:], out=rows[:-1])
    result = rows.copy()
    which(result[:, 1:], rows[:, :-1], out=result[:, 1:])
    which(result[:, :-1], rows[:, 1:], out=result[:, :-1])
    return result
