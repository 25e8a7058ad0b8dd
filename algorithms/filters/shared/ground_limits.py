"""The limits of the heights of ground points: a surface through vertices, and a tolerance."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...core.points import Points
from ...grids.cells import Cells
from ...grids.gradient import gradient, length, steepness
from ...grids.inpaint import inpaint
from ...grids.morphology import within_square
from .noise import below_middle, from_middle, middle_of_noise, noise_of_squares

# Metres over which the surface is smoothed to move vertices along its slope, how often they are
# moved, and the steepest slope for this (rise over run).
_SLOPE_SMOOTHING, _MOVES, _STEEPEST = 1.5, 2, 1.5
# Metres over which the surface is smoothed for the slope that is added to the tolerances.
_FACET_SMOOTHING = 0.7
# The tolerance on slopes is proportional to the spacing of the points, between these two spacings
# in metres.
_SPARSE, _DENSE = 1.0, 0.25
# Largest spacing in metres at which the noise is measured in each cell, because the lowest of many
# points in a cell lies below the ground.
NOISE_SPACING = 0.36
# Largest spacing in metres at which narrow cells hold enough points, and show breaks by themselves.
DENSE_SPACING = 0.17
# Curvature over a cell, in metres, above which there is a break, and the tolerance that each metre
# above it adds.
_BREAK, _BREAK_FACTOR = 0.25, 1.5
# Tolerance in metres above a surface through the middle of the noise, and the multiple of the noise
# that is added to it.
_ABOVE, _ABOVE_FACTOR = 0.05, 3.0
# The same multiple where few points lie in a cell, and metres that are subtracted: plants lower
# than the noise cannot be recognised.
_SPARSE_FACTOR, _USUAL_NOISE = 2.5, 0.07
# Where the ground is even, the tolerance above is smaller by so many metres, but at most by this
# share.
_EVEN_LESS, _EVEN_SHARE = 0.07, 0.4
# Ground is even if its curvature is at most so many metres, and at least this share of the cells
# round about is known.
_EVEN_CURVATURE, _EVEN_KNOWN = 0.45, 0.6


class Tolerance(NamedTuple):
    """How far from the surface points are ground.

    Attributes
    ----------
    above : float
        Metres in level terrain.
    on_slopes : float
        Metres that a slope of 45 degrees adds, where points are a metre apart or more.
    below : float
        Metres in level terrain; more than above, because the surface is smoother than the ground.
    """

    above: float
    on_slopes: float
    below: float = 0.6


def plain_limits(
    points: Points, vertices: np.ndarray, cells: Cells, tolerance: Tolerance
) -> np.ndarray:
    """Return the limits for a surface through the lowest vertex of each cell, without moving it.

    Parameters, returns
        As for `ground_limits`.
    """
    surface = inpaint(cells.minimum(points.z, vertices), first=cells.first)
    rise = tolerance.on_slopes * _smooth_steepness(surface, cells)
    return np.stack((surface - tolerance.below - rise, surface + tolerance.above + rise), axis=-1)


def ground_limits(
    points: Points,
    vertices: np.ndarray,
    cells: Cells,
    spacing: float,
    tolerance: Tolerance,
) -> np.ndarray:
    """Return the lowest and the highest height of ground points.

    Each vertex is moved to the middle of its cell along the slope, because the lowest point of a
    cell lies on its lower side. Where points are dense, the surface between them is known better,
    so the tolerance on slopes is smaller in proportion. At breaks the surface is too smooth, so the
    tolerance is larger. On even ground, level or sloping, low plants stand out, so the tolerance
    above is smaller. Where many points lie in a cell, the lowest lies far below the ground, so the
    surface goes through the middle of their noise. The tolerance above grows with the measured
    noise.

    Parameters
    ----------
    points : Points
        All points.
    vertices : numpy.ndarray of int
        Indices of the ground points that the surface goes through.
    cells : Cells
        A grid over the points.
    spacing : float
        Usual distance between points in metres.
    tolerance : Tolerance
        How far from the surface points are ground.

    Returns
    -------
    numpy.ndarray of float64, shape (rows, columns, 2)
        Heights in metres of the lower and of the upper surface.
    """
    surface, slopes, known = _centred(points, vertices, cells)
    above = tolerance.above
    on_even = above - min(_EVEN_LESS, _EVEN_SHARE * above)
    if spacing <= NOISE_SPACING:
        level, noise = middle_of_noise(points, cells, surface, slopes)
        surface = surface + level.reshape(surface.shape)
        on_even = max(on_even, _ABOVE + _ABOVE_FACTOR * noise)
        above = on_even if spacing <= DENSE_SPACING else max(above, on_even)
    elif spacing <= _SPARSE:
        noise = noise_of_squares(points, cells, surface, slopes)
        # The surface goes through the lowest point of a cell, which has about so many.
        number = np.asarray(max(cells.size / spacing, 1.0) ** 2)
        least = (_SPARSE_FACTOR + float(below_middle(number))) * noise - _USUAL_NOISE
        above, on_even = max(above, least), max(on_even, least)
    factor = tolerance.on_slopes * min(max(spacing, _DENSE), _SPARSE) / _SPARSE
    slope, curvature = _smooth_steepness(surface, cells), _curvature(surface)
    rise = factor * slope
    if spacing < _SPARSE:
        rise += _BREAK_FACTOR * np.maximum(curvature - _BREAK, 0.0)
    # On slopes too steep to move vertices along, the middle of a cell is not known well enough.
    uneven = np.where(slope <= _STEEPEST, _unevenness(curvature, known), np.inf)
    highest = np.minimum(above + rise, on_even + uneven)
    return np.stack((surface - tolerance.below - rise, surface + highest), axis=-1)


def _unevenness(curvature: np.ndarray, known: np.ndarray) -> np.ndarray:
    """Return the unevenness of the ground round each cell in metres; infinity if too large."""
    from scipy import ndimage

    between = ndimage.binary_erosion(known, border_value=1)
    most = within_square(np.maximum, np.where(between, curvature, 0.0), 1)
    share = ndimage.uniform_filter(between.astype(np.float32), 3, mode="nearest")
    return np.where((share >= _EVEN_KNOWN) & (most <= _EVEN_CURVATURE), most, np.inf)


def _smooth(surface: np.ndarray, metres: float, cells: Cells) -> np.ndarray:
    from scipy import ndimage

    return ndimage.gaussian_filter(surface, metres / cells.size, mode="nearest")


def _smooth_steepness(surface: np.ndarray, cells: Cells) -> np.ndarray:
    """Return the slope of the smoothed surface; between single points the slope is too uneven."""
    return steepness(_smooth(surface, _FACET_SMOOTHING, cells), cells.size)


def _curvature(surface: np.ndarray) -> np.ndarray:
    """Return how many metres each cell lies off the lines between opposite neighbours."""
    around = np.pad(surface, 1, mode="edge")
    north = around[2:, 1:-1] + around[:-2, 1:-1]
    east = around[1:-1, 2:] + around[1:-1, :-2]
    return np.maximum(np.abs(0.5 * north - surface), np.abs(0.5 * east - surface))


def _centred(
    points: Points, vertices: np.ndarray, cells: Cells
) -> tuple[np.ndarray, tuple[np.ndarray, np.ndarray], np.ndarray]:
    """Return the surface at the middles of cells, its slopes, and which cells have vertices."""
    cell, z = cells.index[vertices], points.z[vertices]
    north, east = from_middle(points.take(vertices), cells, cell)
    count = np.bincount(cell, minlength=cells.rows * cells.columns)
    moved = z
    for _ in range(_MOVES + 1):
        total = np.bincount(cell, moved, minlength=count.size)
        heights = np.where(count > 0, total / np.maximum(count, 1), np.nan)
        surface = inpaint(heights.reshape(cells.shape), first=cells.first)
        slopes = _slopes(surface, cells)
        moved = z - slopes[0].ravel()[cell] * north - slopes[1].ravel()[cell] * east
    return surface, slopes, (count > 0).reshape(cells.shape)


def _slopes(surface: np.ndarray, cells: Cells) -> tuple[np.ndarray, np.ndarray]:
    """Return the slope towards north and east, nowhere steeper than is usual for terrain."""
    north, east = gradient(_smooth(surface, _SLOPE_SMOOTHING, cells), cells.size)
    share = _STEEPEST / np.maximum(length(north, east), _STEEPEST)
    return north * share, east * share
