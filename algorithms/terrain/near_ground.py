"""Which points are ground, from lowest points that were found to be: the last steps of a filter."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..points import Points
from ..progress import SILENT, Progress
from .breaks import at_breaks
from .cells import Cells, lower_at, spacing
from .gradient import gradient, steepness
from .inpaint import inpaint
from .near_surface import near_surface

# Metres over which the surface is smoothed to move heights along it, and to take its slope.
_TREND, _FACET = 1.5, 0.7
# No height is moved along a steeper slope (rise over run).
_STEEPEST = 1.5
# The usual distance in metres between points, beyond which the tolerance on slopes is no other.
_CLOSEST, _FARTHEST = 0.25, 1.0
# Points that lie closer (metres) leave no gaps in which breaks would be lost.
_GAPLESS = 0.4
# Metres below the surface that are ground as well: it lies through the lowest points, and is
# smooth where they are not.
_BELOW = 0.6


class Candidates(NamedTuple):
    """Lowest points of cells that may be ground.

    Attributes
    ----------
    lowest : numpy.ndarray of intp, shape (n,)
        Indices of the points.
    ground : numpy.ndarray of bool, shape (n,)
        Those that a filter takes for ground.
    free : numpy.ndarray of bool, shape (n,)
        Those that may be ground nevertheless: no outliers, no parts of a large object.
    """

    lowest: np.ndarray
    ground: np.ndarray
    free: np.ndarray

    @classmethod
    def of_cells(
        cls, lowest: np.ndarray, cell: np.ndarray, ground: np.ndarray, free: np.ndarray
    ) -> Candidates:
        """Return candidates from grids (rows, columns) and the cell of each lowest point."""
        return cls(lowest, ground.ravel()[cell], free.ravel()[cell])


class Tolerance(NamedTuple):
    """How far above the surface a point may lie and be ground.

    Attributes
    ----------
    level : float
        Metres in level terrain.
    on_slopes : float
        Metres that a slope of 45 degrees adds where points are a metre apart; less in proportion
        on gentler slopes, and where points are closer.
    """

    level: float
    on_slopes: float


def near_ground(
    points: Points,
    cells: Cells,
    candidates: Candidates,
    tolerance: Tolerance,
    progress: Progress = SILENT,
) -> np.ndarray:
    """Return which points lie close to the surface through the ground.

    Where points are sparse, the candidates are first looked at from each side: those above the
    ground on every side go, and those level with the ground of one side, at a break, come back.

    Parameters
    ----------
    points : Points
        All points that take part.
    cells : Cells
        Those of the surface.
    candidates : Candidates
        Lowest points of cells.
    tolerance : Tolerance
        How far from the surface ground may lie.
    progress : Progress
        Receives progress.

    Returns
    -------
    numpy.ndarray of bool, shape (n,)
        True for ground.
    """
    apart = spacing(points, _CLOSEST)
    ground = candidates.ground
    if apart > _GAPLESS:
        ground = at_breaks(points, candidates.lowest, ground, candidates.free, apart, cells)
    progress(0.5)
    surface = _surface(points, candidates.lowest[ground], cells)
    limits = _limits(surface, cells, tolerance, apart)
    return near_surface(points, cells, limits, progress.part(0.6, 1.0))


def _surface(points: Points, which: np.ndarray, cells: Cells) -> np.ndarray:
    """Return the height at the centre of each cell.

    A lowest point lies downhill from the centre of its cell, and hence below the ground there; it
    is moved to the centre along the slope of the surface.
    """
    from scipy import ndimage

    x, y, z = points.take(which)
    cell = cells.index[which]
    row, column = np.divmod(cell, cells.columns)
    north = (row + cells.first_row + 0.5) * cells.size - y
    east = (column + cells.first_column + 0.5) * cells.size - x
    moved = z
    for _ in range(2):
        surface = _through(moved, cell, cells)
        smooth = ndimage.gaussian_filter(surface, _TREND / cells.size, mode="nearest")
        rises = (each.ravel()[cell] for each in gradient(smooth, cells.size))
        north_rise, east_rise = (np.clip(each, -_STEEPEST, _STEEPEST) for each in rises)
        moved = z + north * north_rise + east * east_rise
    return _through(moved, cell, cells)


def _through(z: np.ndarray, cell: np.ndarray, cells: Cells) -> np.ndarray:
    lowest = np.full(cells.rows * cells.columns, np.inf)
    lower_at(lowest, cell, z)
    lowest[np.isinf(lowest)] = np.nan
    return inpaint(lowest.reshape(cells.shape), first=cells.first)


def _limits(surface: np.ndarray, cells: Cells, tolerance: Tolerance, apart: float) -> np.ndarray:
    """Return between which heights points are ground, shape (rows, columns, 2).

    The slope that adds to the tolerance is that of the smoothed surface: between single lowest
    points it is too uneven. Where points are dense the surface is known better.
    """
    from scipy import ndimage

    smooth = ndimage.gaussian_filter(surface, _FACET / cells.size, mode="nearest")
    share = min(max(apart, _CLOSEST), _FARTHEST) / _FARTHEST
    rise = tolerance.on_slopes * share * steepness(smooth, cells.size)
    below = max(_BELOW, tolerance.level)
    return np.stack((surface - below - rise, surface + tolerance.level + rise), axis=-1)
