"""Which points lie close to a surface given on a grid."""

from __future__ import annotations

import numpy as np

from ..points import Points
from ..progress import SILENT, Progress
from ..threads import over_parts
from .cells import Cells

_POINTS_A_PART = 1 << 17


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
        z = points.z[part]
        least, sure_least, sure_most, most = bounds[cells.index[part]].T
        sure = (z >= sure_least) & (z <= sure_most)
        open_ = np.flatnonzero(~sure & (z >= least) & (z <= most))
        north = points.y[part][open_] / cells.size - (cells.first_row - 0.5)
        east = points.x[part][open_] / cells.size - (cells.first_column - 0.5)
        least, most = _bilinear(flat, width, north, east)
        sure[open_] = (z[open_] >= least) & (z[open_] <= most)
        near[part] = sure

    over_parts(decide, points.count, _POINTS_A_PART, progress)
    return near


def _bilinear(
    flat: np.ndarray, width: int, north: np.ndarray, east: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Interpolate two grids side by side (cells, 2) between the four cells round each place."""
    row, column = north.astype(np.intp), east.astype(np.intp)
    corner = row * width + column
    north, east = (north - row)[:, None], (east - column)[:, None]
    west = flat[corner]
    south_side = west + (flat[corner + 1] - west) * east
    west = flat[corner + width]
    north_side = west + (flat[corner + width + 1] - west) * east
    values = south_side + (north_side - south_side) * north
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
    for column, (which, grid, towards) in enumerate(
        (
            (np.minimum, lower, -np.inf),
            (np.maximum, lower, np.inf),
            (np.minimum, upper, -np.inf),
            (np.maximum, upper, np.inf),
        )
    ):
        # Rounded away from what it bounds, single precision decides nothing wrongly.
        rounded = np.nextafter(grid.astype(np.float32), np.float32(towards))
        bounds[:, column] = _extreme(which, rounded).ravel()
    return bounds


def _extreme(which: np.ufunc, grid: np.ndarray) -> np.ndarray:
    """Return the minimum or the maximum of the 3 x 3 cells round each cell."""
    result = grid
    for axis in (0, 1):
        inner = np.swapaxes(result, 0, axis)
        spread = inner.copy()
        which(spread[1:], inner[:-1], out=spread[1:])
        which(spread[:-1], inner[1:], out=spread[:-1])
        result = np.swapaxes(spread, 0, axis)
    return result
