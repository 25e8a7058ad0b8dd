"""Heights of points above the TIN of the ground points."""

from __future__ import annotations

import numpy as np

from ..core.points import Points
from ..core.progress import SILENT, Progress
from ..grids.cells import spacing
from ..grids.dense_surface import VERTICES_A_SIDE, DenseSurface

# Distance of the vertices of the TIN, in mean distances of ground points, and its limits in metres.
# Where points are dense, more vertices change the heights by only a centimetre or two.
_SPACINGS, _LEAST, _MOST = 2.0, 0.1, 0.5
# A road lies on the ground if it is so near to the TIN of the ground points, in metres: far more
# than a kerb or the crown of a road, and less than the clearance below a bridge.
_ON_GROUND = 1.0


def with_roads(
    points: Points, ground: np.ndarray, roads: np.ndarray, progress: Progress = SILENT
) -> np.ndarray:
    """Return which points are ground, with the points of roads that lie on it.

    Parameters
    ----------
    points : Points
        All points.
    ground, roads : numpy.ndarray of bool, shape (n,)
        Which points are ground, and which lie on roads and rails, also on those of bridges.
    progress : Progress
        Receives progress.

    Returns
    -------
    numpy.ndarray of bool, shape (n,)
        The ground, and points of roads that are at most 1 m above or below the TIN of the ground.
    """
    if not (roads.any() and ground.any()):
        return ground
    heights = height_above_ground(points, ground, progress, roads)
    return ground | (roads & (np.abs(heights) <= _ON_GROUND))


def height_above_ground(
    points: Points,
    ground: np.ndarray,
    progress: Progress = SILENT,
    wanted: np.ndarray | None = None,
) -> np.ndarray:
    """Return the height of each point above the ground.

    Parameters
    ----------
    points : Points
        All points.
    ground : numpy.ndarray of bool, shape (n,)
        Which points are ground; at least one.
    progress : Progress
        Receives progress.
    wanted : numpy.ndarray of bool, shape (n,), optional
        Which heights are wanted; the others are 0. By default, all.

    Returns
    -------
    numpy.ndarray of float64, shape (n,)
        0 for ground points. For other points, metres above the TIN of the ground points, negative
        below it. Outside the convex hull, metres above the nearest ground point. The TIN has one
        vertex in each square of 0.5 m, or in smaller squares where ground points are dense.

    Examples
    --------
    >>> x, y = np.array([0.0, 4.0, 0.0, 1.0]), np.array([0.0, 0.0, 4.0, 1.0])
    >>> points = Points(x, y, np.array([10.0, 10.0, 10.0, 12.5]))
    >>> float(height_above_ground(points, np.array([True, True, True, False]))[3])
    2.5
    """
    terrain, heights = points.take(ground), np.zeros(points.count)
    apart = min(_SPACINGS * spacing(terrain, _LEAST / _SPACINGS), _MOST)
    progress(0.05)
    surface = DenseSurface(terrain, VERTICES_A_SIDE * apart, progress=progress.part(0.05, 0.2))
    which = np.flatnonzero(~ground if wanted is None else ~ground & wanted)
    x, y = points.x[which], points.y[which]
    below = surface.heights(x, y, progress=progress.part(0.2, 0.95))
    outside = np.flatnonzero(np.isnan(below))
    if len(outside):
        below[outside] = surface.nearest(x[outside], y[outside])
    heights[which] = points.z[which] - below
    progress(1.0)
    return heights
