"""Which cells of a grid of lowest points are ground: the seeds of a terrain surface.

Three views of the same grid are combined. A progressive opening cuts off whatever is narrower than
a window and higher than an allowance, which grows with the window and with the slope of the
terrain. Regions bounded by drops all round are objects whatever their size. And what the opening
cut off, but passes gently into the ground round it, is ground after all: a dike, a terrace.

References
----------
Zhang, K. et al. (2003): A progressive morphological filter for removing nonground measurements
from airborne LIDAR data. IEEE Transactions on Geoscience and Remote Sensing 41, section II.
Pingel, T., Clarke, K., McBride, W. (2013): An improved simple morphological filter for the terrain
classification of airborne LIDAR data. ISPRS Journal 77, section 2.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..progress import SILENT, Progress
from .inpaint import First, inpaint
from .morphology import in_steps, opening

# A first, strict opening (rise over run) gives the surface from which the terrain's slope is taken.
_FIRST_SLOPE = 0.12
# Metres over which that slope is smoothed, and the most of it that counts.
_SLOPE_SMOOTHING, _LARGEST_SLOPE = 5.0, 0.6
# Metres over which the surface is smoothed to tell a step from the terrain's own rise.
_TREND_SMOOTHING = 2.0


@dataclass(frozen=True)
class Allowance:
    """How high something may stand out of an opening's window and still be terrain.

    Attributes
    ----------
    base : float
        Height in metres, whatever the window.
    per_radius : float
        What each metre of the window's radius adds, in metres.
    per_slope : float
        What each metre of the radius adds on a slope of 45 degrees (in proportion on others).
    largest : float
        No allowance is larger, in metres.
    gentle_step : float
        A step between cells that is not an edge, in metres, on top of the terrain's own rise.
    gentle_share : float
        Share of the border of a region that must be gentle for it to be terrain.
    gentle_area : float
        Smallest region, in square metres, that may be terrain for that reason.
    """

    base: float = 0.15
    per_radius: float = 0.04
    per_slope: float = 0.2
    largest: float = 1.5
    gentle_step: float = 0.3
    gentle_share: float = 0.5
    gentle_area: float = 20.0


def ground_cells(
    heights: np.ndarray,
    size: float,
    objects: np.ndarray,
    largest_window: float,
    allowance: Allowance = Allowance(),
    progress: Progress = SILENT,
    first: First = (0, 0),
) -> np.ndarray:
    """Return which cells of a minimum grid are ground.

    Parameters
    ----------
    heights : numpy.ndarray of float, shape (rows, columns)
        Lowest height of each cell in metres, without low outliers; NaN where there is none.
    size : float
        Side of a cell in metres.
    objects : numpy.ndarray of bool, shape (rows, columns)
        Cells that are known to be objects.
    largest_window : float
        Radius in metres of the largest window.
    allowance : Allowance
        What may stand out and still be terrain.
    progress : Progress
        Receives progress.
    first : tuple of int
        Row and column of the first cell in the grid of the CRS.

    Returns
    -------
    numpy.ndarray of bool, shape (rows, columns)
        False also where there is no height.
    """
    known = np.isfinite(heights)
    filled = inpaint(heights, first=first).astype(np.float32)
    strict, limit = _standing_out(filled, size, largest_window, allowance, progress.part(0.0, 0.7))
    surface = inpaint(np.where(known & ~strict & ~objects, heights, np.nan), first=first)
    smooth, which = _smooth(surface, size, _SLOPE_SMOOTHING), np.flatnonzero(limit > 0.0)
    slope = np.hypot(*(_slope_at(smooth, axis, which, size) for axis in (0, 1)))
    raised = objects.copy()
    raised.ravel()[which] |= np.minimum(slope, _LARGEST_SLOPE) < limit.ravel()[which]
    progress(0.8)
    surface = inpaint(np.where(known & ~raised, heights, np.nan), first=first)
    progress(0.85)
    raised &= objects | ~_gentle_regions(filled, raised, surface, size, allowance)
    progress(1.0)
    return known & ~raised


def _standing_out(
    filled: np.ndarray, size: float, largest_window: float, allowance: Allowance, progress: Progress
) -> tuple[np.ndarray, np.ndarray]:
    """Open the grid with growing windows.

    Returns
    -------
    first : numpy.ndarray of bool, shape (rows, columns)
        What stands out by the strict slope of the first look.
    limit : numpy.ndarray of float32, shape (rows, columns)
        The terrain's slope (rise over run) below which a cell stands out by the allowance.
    """
    first = np.zeros(filled.size, dtype=bool)
    limit = np.full(filled.size, -np.inf, dtype=np.float32)
    last, step = in_steps(filled)
    largest = max(round(largest_window / size), 1)
    for radius in range(1, largest + 1):
        opened = opening(last, radius)
        last -= opened
        # As unsigned numbers, differences do not overflow.
        cut, last = last.view(np.uint16).ravel(), opened
        metres = radius * size
        level = allowance.base + allowance.per_radius * metres
        # Most cells lose too little to stand out on any slope.
        which = np.flatnonzero(cut > int(min(_FIRST_SLOPE * metres, level) / step))
        lost = cut[which] * np.float32(step)
        first[which[lost > _FIRST_SLOPE * metres]] = True
        slope = (lost - np.float32(level)) / np.float32(max(allowance.per_slope * metres, 1e-6))
        slope[lost > allowance.largest] = np.inf
        limit[which] = np.maximum(limit[which], slope)
        progress(radius / largest)
    return first.reshape(filled.shape), limit.reshape(filled.shape)


def _smooth(surface: np.ndarray, size: float, smoothing: float) -> np.ndarray:
    """Return a surface smoothed over so many metres."""
    from scipy import ndimage

    return ndimage.gaussian_filter(surface, smoothing / size, mode="nearest")


def _slope_at(surface: np.ndarray, axis: int, cells: np.ndarray, size: float) -> np.ndarray:
    """Return the slope of a surface along an axis, rise over run, at some cells.

    Parameters
    ----------
    surface : numpy.ndarray of float, shape (rows, columns)
        Heights in metres without NaN.
    axis : int
        0 towards north, 1 towards east.
    cells : numpy.ndarray of intp
        Indices into the flattened grid.
    size : float
        Side of a cell in metres.

    Returns
    -------
    numpy.ndarray of float64, shape (cells,)
        Central differences, one-sided at the border.
    """
    place = np.divmod(cells, surface.shape[1])[axis]
    ahead, back = place < surface.shape[axis] - 1, place > 0
    offset = surface.shape[1] if axis == 0 else 1
    flat = surface.ravel()
    rise = flat[cells + offset * ahead] - flat[cells - offset * back]
    return rise / (np.maximum(ahead.astype(np.int8) + back, 1) * size)


def _gentle_regions(
    filled: np.ndarray, raised: np.ndarray, surface: np.ndarray, size: float, allowance: Allowance
) -> np.ndarray:
    """Return the raised cells whose region passes into the ground without an edge.

    A region is what hangs together without a step. Its border is gentle where it touches the
    ground without a step, and sharp where it drops to anything; where it rises does not count.
    """
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    smooth = _smooth(surface, size, _TREND_SMOOTHING)
    sides = [_steps(filled, raised, smooth, axis, size, allowance) for axis in (0, 1)]
    one, other, sign = (np.concatenate(each) for each in zip(*sides))
    up = raised.ravel()
    cells = np.flatnonzero(up)
    region = np.full(up.size, -1, dtype=np.int64)
    region[cells] = np.arange(len(cells))
    inside = (sign == 0) & up[one] & up[other]
    pairs = (region[one[inside]], region[other[inside]])
    graph = coo_matrix((np.ones(len(pairs[0]), dtype=bool), pairs), shape=(len(cells),) * 2)
    count, region[cells] = connected_components(graph, directed=False)
    gentle, sharp = np.zeros(count), np.zeros(count)
    for from_, to, drop in ((one, other, sign == -1), (other, one, sign == 1)):
        at_ground = up[from_] & ~up[to] & (sign == 0)
        gentle += np.bincount(region[from_[at_ground]], minlength=count)
        at_drop = up[from_] & drop & (region[from_] != region[to])
        sharp += np.bincount(region[from_[at_drop]], minlength=count)
    area = np.bincount(region[cells], minlength=count) * size**2
    is_terrain = (gentle > 0) & (gentle >= allowance.gentle_share * (gentle + sharp))
    is_terrain &= area >= allowance.gentle_area
    result = np.zeros(up.size, dtype=bool)
    result[cells] = is_terrain[region[cells]]
    return result.reshape(raised.shape)


def _steps(
    filled: np.ndarray,
    raised: np.ndarray,
    smooth: np.ndarray,
    axis: int,
    size: float,
    allowance: Allowance,
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Compare neighbouring cells along an axis, of which one at least is raised.

    Returns
    -------
    one, other : numpy.ndarray of intp
        The pairs, as indices into the flattened grid.
    sign : numpy.ndarray of int8
        1 where the other is higher by a step, -1 where it is lower, else 0.
    """
    ahead = tuple(slice(1, None) if each == axis else slice(None) for each in (0, 1))
    behind = tuple(slice(None, -1) if each == axis else slice(None) for each in (0, 1))
    matters = np.zeros(filled.shape, dtype=bool)
    np.logical_or(raised[ahead], raised[behind], out=matters[behind])
    one = np.flatnonzero(matters)
    other = one + (filled.shape[1] if axis == 0 else 1)
    trend = _slope_at(smooth, axis, one, size) * size
    rise = filled.ravel()[other] - filled.ravel()[one] - trend
    allowed = allowance.gentle_step + np.abs(trend)
    sign = (rise > allowed).astype(np.int8) - (rise < -allowed).astype(np.int8)
    return one, other, sign
