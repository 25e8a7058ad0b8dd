"""Heights of points above the TIN of the ground points."""

from __future__ import annotations

import numpy as np

from ..core.points import Points
from ..core.progress import SILENT, Progress
from ..grids.cells import spacing
from .dense_surface import VERTICES_A_SIDE, DenseSurface

# Distance of the vertices of the TIN, in mean distances of ground points, and its limits in metres.
# Where points are dense, more vertices change the heights by only a centimetre or two.
_SPACINGS = 2.0
_LEAST = 0.1
_MOST = 0.5
# Metres from the TIN of the ground points up to which a road lies on the ground: far more than a
# kerb or the crown of a road, and less than the clearance below a bridge.
_ON_GROUND = 1.0


def with_roads(
    points: Points, ground: np.ndarray, roads: np.ndarray, progress: Progress = SILENT
) -> np.ndarray:
    """Return which points are ground, with those on roads and rails, also of bridges, that are at
    most 1 m above or below the TIN of the ground; bool (n,).
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
    """Return the height in metres above the TIN of the ground points, float64 (n,): 0 for ground
    and for points that are not wanted, negative below the TIN.
    """
    # There must be a ground point. Outside of their convex hull, heights are above the nearest one.
    # The TIN has one vertex in each square of 0.5 m, or in smaller squares where ground points are
    # dense.
    heights = np.zeros(points.count)
    surface = GroundSurface(points.take(ground), progress.part(0.0, 0.2))
    above = np.flatnonzero(~ground if wanted is None else ~ground & wanted)
    heights[above] = surface.heights_above(points.take(above), progress.part(0.2, 1.0))
    return heights


class GroundSurface:
    """The TIN of ground points, at least one, as `height_above_ground` uses it."""

    def __init__(self, ground: Points, progress: Progress = SILENT) -> None:
        apart = min(_SPACINGS * spacing(ground, _LEAST / _SPACINGS), _MOST)
        progress(0.25)
        part = progress.part(0.25, 1.0)
        self._surface = DenseSurface(ground, VERTICES_A_SIDE * apart, progress=part)
        self.thinned = self._surface.thinned

    def heights_above(self, points: Points, progress: Progress = SILENT) -> np.ndarray:
        """Return the height of points above the surface; float64, shape (n,)."""
        return points.z - self.heights(points.x, points.y, progress)

    def heights(self, x: np.ndarray, y: np.ndarray, progress: Progress = SILENT) -> np.ndarray:
        """Return the height of the surface at places; float64, shape (n,)."""
        below = self._surface.heights(x, y, progress=progress.part(0.0, 0.95))
        outside = np.flatnonzero(np.isnan(below))
        if len(outside):
            below[outside] = self._surface.nearest(x[outside], y[outside])
        progress(1.0)
        return below
