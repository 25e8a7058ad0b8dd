"""Model key points: the few ground points whose TIN is as good as that of all of them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core.parameters import ParameterSet, parameter
from ..core.points import Points
from ..core.progress import SILENT, Progress
from .cells import Cells
from .tin import Tin, hull_corners, lowest_of_duplicates

# Where a round would add so small a share of vertices it adds all points beyond the tolerance
# instead of one a triangle: another triangulation for each few of them is not worth it.
_SMALL_ROUND = 0.005
# Share of the way to the middle of the survey by which queries on the hull are moved inside it.
_INWARDS = 1e-9
# Of triangles, factors that mix the numbers of their corners into one number.
_MIX = np.array([0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9], dtype=np.uint64)


@dataclass(frozen=True)
class ModelKeyPoints(ParameterSet):
    """How closely the TIN of the key points follows the ground points."""

    tolerance_above: float = parameter(
        0.15,
        label="Tolerance above",
        unit="m",
        minimum=0.0,
        maximum=100.0,
        help="How far a ground point may lie above the TIN of the key points. About the accuracy of"
        " the heights, or half the interval of the contour lines to be made.",
    )
    tolerance_below: float = parameter(
        0.15,
        label="Tolerance below",
        unit="m",
        minimum=0.0,
        maximum=100.0,
        help="How far a ground point may lie below the TIN of the key points.",
    )
    grid_size: float = parameter(
        20.0,
        label="Grid size",
        unit="m",
        minimum=0.1,
        maximum=10000.0,
        help="Every cell of this size that has ground points keeps at least one, its lowest,"
        " however flat the ground is.",
    )


def model_key_points(
    points: Points,
    parameters: ModelKeyPoints = ModelKeyPoints(),
    progress: Progress = SILENT,
) -> np.ndarray:
    """Choose the ground points that a terrain model needs.

    It starts with the lowest point of each cell of a grid and the corners of the convex hull. In
    rounds, every triangle of their TIN takes the point that lies farthest beyond the tolerance.
    Then every ground point lies within the tolerance of the TIN of the chosen ones; but of points
    at one place the lowest alone is looked at.

    Parameters
    ----------
    points : Points
        The ground points.
    parameters : ModelKeyPoints
        Tolerances and size of the grid.
    progress : Progress
        Receives progress.

    Returns
    -------
    numpy.ndarray of bool, shape (n,)
        Which points were chosen; whatever their order, the same.
    """
    chosen = np.zeros(points.count, dtype=bool)
    if not points.count:
        return chosen
    # From here on in an order of their own.
    order = lowest_of_duplicates(*points)
    points = points.take(order)
    keys = np.zeros(points.count, dtype=bool)
    keys[Cells.over(points, parameters.grid_size).lowest_points(points)] = True
    keys[hull_corners(points.x, points.y)] = True
    progress(0.05)
    _densify(points, keys, parameters, progress.part(0.05, 1.0))
    chosen[order[keys]] = True
    progress(1.0)
    return chosen


def _densify(
    points: Points, keys: np.ndarray, parameters: ModelKeyPoints, progress: Progress
) -> None:
    """Add to `keys`, in place, until no point lies beyond the tolerance."""
    middle = np.median(points.x), np.median(points.y)
    x, y = (each + (at - each) * _INWARDS for each, at in zip(points, middle))
    pending = np.flatnonzero(~keys)
    beyond = np.zeros(points.count)
    triangle = np.full(points.count, -1, dtype=np.int64)
    old = np.empty(0, dtype=np.uint64)
    first = None
    while True:
        vertices = np.flatnonzero(keys)
        tin = Tin(*points.take(vertices))
        if not len(tin.triangles):
            # Points on one line: no TIN can stand for them.
            keys[:] = True
            return
        names = _names(vertices[tin.source[tin.triangles]])
        pending, stayed = _moved(pending, triangle, beyond, old, names)
        triangle[stayed] = _renumbered(triangle[stayed], old, names)
        triangle[pending] = tin.locate(x[pending], y[pending])
        height = tin.interpolate(x[pending], y[pending], triangle[pending])
        above = points.z[pending] - height
        beyond[pending] = np.fmax(
            above - parameters.tolerance_above, -above - parameters.tolerance_below
        )
        # Outside the hull by more than rounding: not known to be within the tolerance.
        beyond[pending[np.isnan(height)]] = np.inf
        violating = pending[beyond[pending] > 0.0]
        if not len(violating):
            return
        added = _worst(violating, triangle, beyond)
        if len(added) < _SMALL_ROUND * len(vertices):
            added = violating
        keys[added] = True
        first = first or len(violating)
        progress(1.0 - len(violating) / (first + 1))
        old = names
        pending = np.flatnonzero(~keys)


def _worst(violating: np.ndarray, triangle: np.ndarray, beyond: np.ndarray) -> np.ndarray:
    """Return of the points in each triangle the one farthest beyond the tolerance."""
    order = np.lexsort((violating, -beyond[violating], triangle[violating]))
    inside = triangle[violating[order]]
    first = np.ones(len(order), dtype=bool)
    # Those outside of all triangles are in none together.
    first[1:] = (np.diff(inside) != 0) | (inside[1:] < 0)
    return violating[order[first]]


def _names(corners: np.ndarray) -> np.ndarray:
    """Return a number for each triangle that tells it from the others, whatever its place."""
    mixed = np.sort(corners, axis=1).astype(np.uint64) + np.uint64(1)
    names = mixed * _MIX
    names ^= names >> np.uint64(29)
    return (names * _MIX[::-1]).sum(axis=1, dtype=np.uint64)


def _moved(
    pending: np.ndarray,
    triangle: np.ndarray,
    beyond: np.ndarray,
    old: np.ndarray,
    names: np.ndarray,
) -> tuple[np.ndarray, np.ndarray]:
    """Part points into those to look at and those whose triangle is still there and was good."""
    if not len(old):
        return pending, pending[:0]
    still = np.isin(old, names)
    stays = (triangle[pending] >= 0) & (beyond[pending] <= 0.0)
    stays &= still[triangle[pending]]
    return pending[~stays], pending[stays]


def _renumbered(triangle: np.ndarray, old: np.ndarray, names: np.ndarray) -> np.ndarray:
    """Return what number triangles of the round before have now."""
    if not len(triangle):
        return triangle
    order = np.argsort(names)
    return order[np.searchsorted(names, old[triangle], sorter=order)]
