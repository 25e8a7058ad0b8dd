"""How high points stand above the TIN of the ground points."""

from __future__ import annotations

import numpy as np

from ..core.points import Points
from ..core.progress import SILENT, Progress
from ..grids.surface import Surface


def height_above_ground(
    points: Points, ground: np.ndarray, progress: Progress = SILENT
) -> np.ndarray:
    """Return how high each point stands above the ground below it.

    Parameters
    ----------
    points : Points
        All points.
    ground : numpy.ndarray of bool, shape (n,)
        Which of them are ground; at least one is.
    progress : Progress
        Receives progress.

    Returns
    -------
    numpy.ndarray of float64, shape (n,)
        Metres above the TIN of the ground points, negative below it; outside its convex hull,
        metres above the nearest ground point.

    Examples
    --------
    >>> x, y = np.array([0.0, 4.0, 0.0, 1.0]), np.array([0.0, 0.0, 4.0, 1.0])
    >>> points = Points(x, y, np.array([10.0, 10.0, 10.0, 12.5]))
    >>> float(height_above_ground(points, np.array([True, True, True, False]))[3])
    2.5
    """
    surface = Surface(points.take(ground))
    progress(0.1)
    below = surface.heights(points.x, points.y, progress=progress.part(0.1, 0.95))
    outside = np.flatnonzero(np.isnan(below))
    if len(outside):
        below[outside] = surface.nearest(points.x[outside], points.y[outside])
    progress(1.0)
    return points.z - below
