"""Points far below everything round them: multipath, birds under bridges, sensor faults."""

from __future__ import annotations

import math

import numpy as np

from ...core.points import Points
from ...grids.cells import Cells
from ...grids.inpaint import First, inpaint
from ...grids.morphology import median_of_nine, within_square
from .surroundings import LowestOfCells

# Cells between so many metres from a pit are its witnesses; nearer ones may belong to the same
# fault.
_NEAREST, _FARTHEST = 3.0, 10.0
# Metres between witnesses.
_APART = 0.5
# A witness is as low as a pit if they differ by at most so many metres, plus so many for each metre
# of distance, and by at most this share of the depth of the pit.
_LEVEL, _LEVEL_SLOPE, _DEPTH_SHARE = 0.5, 0.2, 0.33
# A pit is ground if at least so many witnesses are as low, and at least this share of the number of
# witnesses on an even surface above it.
_LEAST_WITNESSES, _LEAST_SHARE = 4, 0.15
# A lone point is more than so many metres below the cells round it, of which at least so many are
# even. Its cell has at least so many points, and the next one is higher by at least this share of
# its depth.
_LONE_DEPTH, _LEAST_EVEN, _LEAST_POINTS, _LONE_GAP = 0.6, 6, 4, 0.7
# The lowest points round a pit are those of a canopy if their median distance from a plane is more
# than so many metres. They are looked at up to so many metres and cells away. A pit that is deeper
# than so many times this distance is an outlier all the same.
_ROUGH, _ROUGH_REACH, _ROUGH_CELLS, _ROUGH_DEPTH = 2.5, 6.0, 4, 6.0
# The plane is fitted without the points that may belong to the pit, so many metres round it.
_PIT = 2.0
# A cell of an even surface is at most so many metres off the median of the 3 x 3 cells round it.
_EVEN = 0.3


def low_outliers(
    grid: np.ndarray,
    size: float,
    slope: float,
    first: First = (0, 0),
    spares_supported: bool = True,
) -> np.ndarray:
    """Return which cells of a minimum grid lie in a narrow pit that is too deep for terrain.

    The grid is closed by 3 x 3 cells (the opening of -z). Cells that the closing raises by more
    than `slope` times the cell size are outliers, unless they are `supported`.

    Parameters
    ----------
    grid : numpy.ndarray of float, shape (rows, columns)
        Lowest height of each cell in metres; NaN where there is none.
    size : float
        Side of a cell in metres.
    slope : float
        Rise over run, far above that of any terrain.
    first : tuple of int
        Row and column of the first cell in the grid of the CRS.
    spares_supported : bool
        If False, every pit is an outlier.

    Returns
    -------
    numpy.ndarray of bool, shape (rows, columns)

    References
    ----------
    Pingel, T., Clarke, K., McBride, W. (2013): An improved simple morphological filter for the
    terrain classification of airborne LIDAR data. ISPRS Journal 77, section 2.2.
    """
    depth = depth_of_pits(grid, first)
    pits = depth > slope * size
    return pits & ~supported(grid, size, pits, depth, first) if spares_supported else pits


def under_canopy(
    pits: np.ndarray, points: Points, cells: Cells, lowest: np.ndarray | None = None
) -> np.ndarray:
    """Return which pits are ground under a canopy, where the lowest points round them are crowns.

    Where hardly a pulse gets through, as in rain forest, hardly any other point is as low, so that
    the pits are not `supported`. But an outlier lies below a surface, and the lower side of crowns
    is none.

    Parameters
    ----------
    pits : numpy.ndarray of bool, shape (rows, columns)
        Cells that lie far below the cells next to them.
    points : Points
        All points.
    cells : Cells
        Their cells.
    lowest : numpy.ndarray of int, optional
        The lowest point of each cell, if it is known: finding it takes time.

    Returns
    -------
    numpy.ndarray of bool, shape (rows, columns)
    """
    found = np.zeros(pits.shape, dtype=bool)
    if not pits.any():
        return found
    margin = math.ceil(max(_ROUGH_REACH / cells.size, _ROUGH_CELLS))
    grids = LowestOfCells.of(points, cells, margin, lowest)
    rough = []
    for around in grids.around(grids.places(pits), _PIT):
        plane, above = around.plane()
        distance = around.median(np.abs(above))
        rough.append((distance > _ROUGH) & (plane[:, 2] <= _ROUGH_DEPTH * distance))
    found[pits] = np.concatenate(rough)
    return found


def lone_points(grid: np.ndarray, cells: Cells, z: np.ndarray) -> np.ndarray:
    """Return which cells have a lone point below an even surface, as in points from images.

    The other points of its cell and most cells next to it lie on the surface. Hardly any other cell
    some metres away is as low.

    Parameters
    ----------
    grid : numpy.ndarray of float, shape (rows, columns)
        Lowest height of each cell in metres; NaN where there is none.
    cells : Cells
        Cells of the grid.
    z : numpy.ndarray of float, shape (n,)
        Heights of all points in metres.

    Returns
    -------
    numpy.ndarray of bool, shape (rows, columns)
    """
    from scipy import ndimage

    depth = depth_of_pits(grid, cells.first)
    even = _even(grid, cells.first)
    around = ndimage.uniform_filter(even.astype(np.float32), 3, mode="nearest")
    doubtful = (depth > _LONE_DEPTH) & (9.0 * around > _LEAST_EVEN - 0.5)
    which = np.flatnonzero(doubtful.ravel()[cells.index])
    which = which[np.lexsort((z[which], cells.index[which]))]
    cell, first, count = np.unique(cells.index[which], return_index=True, return_counts=True)
    several = count >= _LEAST_POINTS
    cell, first = cell[several], first[several]
    gap = z[which[first + 1]] - z[which[first]]
    pits = np.zeros(grid.shape, dtype=bool)
    pits.ravel()[cell] = gap >= _LONE_GAP * depth.ravel()[cell]
    return pits & ~supported(grid, cells.size, pits, depth, cells.first, even)


def supported(
    grid: np.ndarray,
    size: float,
    pits: np.ndarray,
    depth: np.ndarray,
    first: First = (0, 0),
    even: np.ndarray | None = None,
) -> np.ndarray:
    """Return the pits that are ground, because other cells some metres away are as low.

    Under dense canopy the few cells with ground points are pits, but they lie on one surface.
    Faults are scattered: hardly any other cell lies at their level, or far fewer than on the even
    surface above them.

    Parameters
    ----------
    grid, size, first
        As for `low_outliers`, and so is the result.
    pits : numpy.ndarray of bool, shape (rows, columns)
        Cells that lie far below the cells next to them.
    depth : numpy.ndarray of float, shape (rows, columns)
        The depth of the pits in metres.
    even : numpy.ndarray of bool, shape (rows, columns), optional
        Cells that lie on an even surface, if they are known already.
    """
    result = np.zeros(grid.shape, dtype=bool)
    row, column = np.nonzero(pits)
    if not len(row):
        return result
    rows, columns, level = _witnesses(size)
    reach = int(np.ceil(_FARTHEST / size))
    heights = np.pad(grid.astype(np.float32), reach, constant_values=np.nan)
    even = np.pad(_even(grid, first) if even is None else even, reach)
    width = heights.shape[1]
    centre = (row + reach) * width + column + reach
    own, heights, even = heights.take(centre), heights.ravel(), even.ravel()
    near, above, below = np.zeros((3, len(row)), dtype=np.int32)
    most = (_DEPTH_SHARE * depth[row, column]).astype(np.float32)
    for offset, at_most in zip((rows * width + columns).tolist(), level.tolist()):
        allowed = np.minimum(most, np.float32(at_most))
        there = centre + offset
        rise = heights.take(there) - own
        near += np.abs(rise) <= allowed
        above += (rise > allowed) & even.take(there)
        below += rise < -allowed
    enough = np.maximum(_LEAST_WITNESSES, np.maximum(_LEAST_SHARE * above, below))
    result[row, column] = near >= enough
    return result


def _witnesses(size: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the offsets of witnesses in rows and columns, and the largest height differences."""
    reach = int(np.ceil(_FARTHEST / size))
    # Not all narrow cells, but as many as there are of wide ones.
    stride = max(round(_APART / size), 1)
    steps = np.arange(-(reach // stride), reach // stride + 1) * stride
    rows, columns = (each.ravel() for each in np.meshgrid(steps, steps, indexing="ij"))
    distance = np.hypot(rows, columns) * size
    ring = (distance >= _NEAREST) & (distance <= _FARTHEST)
    return rows[ring], columns[ring], _LEVEL + _LEVEL_SLOPE * distance[ring]


def depth_of_pits(grid: np.ndarray, first: First) -> np.ndarray:
    """Return how many metres a closing by 3 x 3 cells raises each cell; 0 where there is none."""
    filled = inpaint(grid, first=first)
    closed = within_square(np.minimum, within_square(np.maximum, filled, 1), 1)
    return np.where(np.isfinite(grid), closed - filled, 0.0)


def _even(grid: np.ndarray, first: First) -> np.ndarray:
    """Return which cells of a grid lie on an even surface."""
    filled = inpaint(grid, 2, first).astype(np.float32)
    middle = median_of_nine(filled)
    return np.abs(grid - middle) <= _EVEN
