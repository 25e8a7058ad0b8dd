"""Between which heights points are ground: the surface through its vertices, and a tolerance."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...core.points import Points
from ...grids.cells import Cells
from ...grids.gradient import gradient, length, steepness
from ...grids.inpaint import inpaint
from ...grids.morphology import within_square
from .noise import below_middle, from_middle, middle_of_noise, noise_of_squares

# Metres over which the surface is smoothed for the slope along which vertices are moved, how often
# they are moved, and the steepest slope (rise over run).
_SLOPE_SMOOTHING, _MOVES, _STEEPEST = 1.5, 2, 1.5
# Metres over which it is smoothed for the slope that adds to the tolerances.
_FACET_SMOOTHING = 0.7
# The tolerance on slopes follows the distance between points between these two, in metres.
_SPARSE, _DENSE = 1.0, 0.25
# Metres between points up to which their noise is measured: the lowest of many in a cell is biased.
NOISE_SPACING = 0.36
# Metres between points up to which narrow cells hold enough of them, and show breaks by themselves.
DENSE_SPACING = 0.17
# Metres of curvature over a cell from which on there is a break, and what each more adds.
_BREAK, _BREAK_FACTOR = 0.25, 1.5
# Metres above a surface through the middle of the noise, and how often the noise adds to them.
_ABOVE, _ABOVE_FACTOR = 0.05, 3.0
# The same where few points lie in a cell, and metres by which less is needed: plants that are lower
# than the noise can't be told.
_SPARSE_FACTOR, _USUAL_NOISE = 2.5, 0.07
# Metres, and at most which share, that the tolerance above is less where the ground is even.
_EVEN_LESS, _EVEN_SHARE = 0.07, 0.4
# Ground is even up to so many metres of curvature, where this share of the cells round about is
# known.
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
        Metres in level terrain; more than above, as the surface is smooth where points are not.
    """

    above: float
    on_slopes: float
    below: float = 0.6


def plain_limits(
    points: Points, vertices: np.ndarray, cells: Cells, tolerance: Tolerance
) -> np.ndarray:
    """Return the limits for the surface through the lowest vertex of each cell, as it lies.

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
    """Return between which heights points are ground.

    Each vertex is moved to the middle of its cell along the slope: the lowest point of a cell lies
    on its lower side. Where points are dense, the surface between them is known better, and the
    tolerance on slopes is less in proportion. At breaks the surface of cells is too smooth, and
    more is tolerated. Where the ground is even, however steep, low plants stand out, and less is
    tolerated above it. Where many points lie in a cell, the lowest lies far below the ground: the
    surface is laid through the middle of their noise. The tolerance above grows with the noise that
    is measured.

    Parameters
    ----------
    points : Points
        All points.
    vertices : numpy.ndarray of int
        Indices of those of the ground that the surface goes through.
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
        # The surface goes through the lowest of so many points.
        number = np.asarray(max(cells.size / spacing, 1.0) ** 2)
        least = (_SPARSE_FACTOR + float(below_middle(number))) * noise - _USUAL_NOISE
        above, on_even = max(above, least), max(on_even, least)
    factor = tolerance.on_slopes * min(max(spacing, _DENSE), _SPARSE) / _SPARSE
    slope, curvature = _smooth_steepness(surface, cells), _curvature(surface)
    rise = factor * slope
    if spacing < _SPARSE:
        rise += _BREAK_FACTOR * np.maximum(curvature - _BREAK, 0.0)
    # Steeper than vertices are moved along, the middle of a cell is not known that well.
    uneven = np.where(slope <= _STEEPEST, _unevenness(curvature, known), np.inf)
    highest = np.minimum(above + rise, on_even + uneven)
    return np.stack((surface - tolerance.below - rise, surface + highest), axis=-1)


def _unevenness(curvature: np.ndarray, known: np.ndarray) -> np.ndarray:
    """Return by how many metres the ground round each cell is uneven; infinity if by too much."""
    from scipy import ndimage

    between = ndimage.binary_erosion(known, border_value=1)
    most = within_square(np.maximum, np.where(between, curvature, 0.0), 1)
    share = ndimage.uniform_filter(between.astype(np.float32), 3, mode="nearest")
    return np.where((share >= _EVEN_KNOWN) & (most <= _EVEN_CURVATURE), most, np.inf)


def _smooth(surface: np.ndarray, metres: float, cells: Cells) -> np.ndarray:
    from scipy import ndimage

    return ndimage.gaussian_filter(surface, metres / cells.size, mode="nearest")


def _smooth_steepness(surface: np.ndarray, cells: Cells) -> np.ndarray:
    """Return the slope of the smoothed surface: between single points it is too uneven."""
    return steepness(_smooth(surface, _FACET_SMOOTHING, cells), cells.size)


def _curvature(surface: np.ndarray) -> np.ndarray:
    """Return by how many metres each cell departs from the line between its neighbours."""
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
