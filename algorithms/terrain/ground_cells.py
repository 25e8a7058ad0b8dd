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
from .morphology import in_steps, opening, within_square

# A first, strict opening (rise over run) gives the surface from which the terrain's slope is taken.
_FIRST_SLOPE = 0.12
_TOGETHER = 4
# Metres over which that slope is smoothed, and the most of it that counts.
_SLOPE_SMOOTHING, _LARGEST_SLOPE = 5.0, 0.6
# Metres over which the surface is smoothed to tell a step from the terrain's own rise.
_TREND_SMOOTHING = 2.0


OPT = dict(share=0.3, wide=500.0, wide_share=0.12, passes=4, rise=1.0, run=0.4, rescue_objects=False)


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
    suspects: np.ndarray | None = None,
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
    suspects : numpy.ndarray of bool, shape (rows, columns), optional
        Cells that stand out by another rule: like those that an opening cut off, they are ground
        if they pass gently into it.

    Returns
    -------
    numpy.ndarray of bool, shape (rows, columns)
        False also where there is no height.
    """
    known = np.isfinite(heights)
    filled = inpaint(heights, first=first).astype(np.float32)
    # Cells are taken together in fours, wherever the grid starts.
    lead = tuple((each % _TOGETHER, 0) for each in first)
    part = progress.part(0.0, 0.7)
    padded = np.pad(filled, lead, mode="edge")
    strict, limit = (
        each[lead[0][0] :, lead[1][0] :].copy()
        for each in _standing_out(padded, size, largest_window, allowance, part)
    )
    surface = inpaint(np.where(known & ~strict & ~objects, heights, np.nan), first=first)
    smooth, which = _smooth(surface, size, _SLOPE_SMOOTHING), np.flatnonzero(limit > 0.0)
    slope = np.hypot(*(_slope_at(smooth, axis, which, size) for axis in (0, 1)))
    raised = objects.copy()
    raised.ravel()[which] |= np.minimum(slope, _LARGEST_SLOPE) < limit.ravel()[which]
    if suspects is not None:
        raised |= suspects & known
    progress(0.8)
    surface = inpaint(np.where(known & ~raised, heights, np.nan), first=first)
    progress(0.85)
    raised &= (objects & ~np.array(OPT['rescue_objects'])) | ~_gentle_regions(filled, known, raised, surface, size, allowance)
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
    first = np.zeros(filled.shape, dtype=bool)
    limit = np.full(filled.shape, -np.inf, dtype=np.float32)
    steps, step = in_steps(filled)
    radii = _radii(largest_window / size)
    last, zoom = steps.copy(), 1
    for done, (radius, coarse) in enumerate(radii, start=1):
        if coarse != zoom:
            last, zoom = _lowest_of_blocks(last, coarse // zoom), coarse
        opened = opening(last, radius / zoom)
        last -= opened
        # As unsigned numbers, differences do not overflow.
        cut, last = last.view(np.uint16).astype(np.int32), opened
        metres = radius * size
        level = allowance.base + allowance.per_radius * metres
        if zoom > 1:
            # What is cut off a block tells of its neighbours as well, whose lowest cell may lie
            # beside the object.
            most = _finer(within_square(np.maximum, cut, 1), zoom, filled.shape)
            own = steps.astype(np.int32) - _finer(opened, zoom, filled.shape)
            cut = np.clip(own, 0, most)
        cut = cut.ravel()
        # Most cells lose too little to stand out on any slope.
        which = np.flatnonzero(cut > int(min(_FIRST_SLOPE * metres, level) / step))
        lost = cut[which] * np.float32(step)
        first.ravel()[which[lost > _FIRST_SLOPE * metres]] = True
        slope = (lost - np.float32(level)) / np.float32(max(allowance.per_slope * metres, 1e-6))
        slope[lost > allowance.largest] = np.inf
        limit.ravel()[which] = np.maximum(limit.ravel()[which], slope)
        progress(done / len(radii))
    return first, limit


def _radii(largest: float) -> list[tuple[int, int]]:
    """Return radii in cells that grow by a tenth or so, and how many cells are taken together."""
    radii = []
    for zoom, first, last in ((1, 1, 24), (2, 26, 48), (4, 52, 10_000)):
        radii += [(r, zoom) for r in range(first, min(last, max(round(largest), 1)) + 1, zoom)]
    return radii


def _lowest_of_blocks(grid: np.ndarray, width: int) -> np.ndarray:
    rows, columns = grid.shape
    padded = np.pad(grid, ((0, -rows % width), (0, -columns % width)), mode="edge")
    rows = np.minimum.reduce([padded[k::width] for k in range(width)])
    return np.minimum.reduce([rows[:, k::width] for k in range(width)])


def _finer(grid: np.ndarray, zoom: int, shape: tuple[int, int]) -> np.ndarray:
    fine = np.repeat(np.repeat(grid, zoom, axis=0), zoom, axis=1)
    return fine[: shape[0], : shape[1]].astype(np.int32)


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
    filled: np.ndarray, known: np.ndarray, raised: np.ndarray, surface: np.ndarray, size: float, allowance: Allowance
) -> np.ndarray:
    """Return the raised cells whose region passes into the ground without an edge.

    A region is what hangs together without a step. Its border is gentle where it touches the
    ground without a step, and sharp where it drops to anything; where it rises does not count.
    """
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    smooth = _smooth(surface, size, _TREND_SMOOTHING)
    sides = [_steps(filled, known, raised, smooth, axis, size, allowance) for axis in (0, 1)]
    one, other, sign = (np.concatenate(each) for each in zip(*sides))
    up = raised.ravel()
    cells = np.flatnonzero(up)
    region = np.full(up.size, -1, dtype=np.int64)
    region[cells] = np.arange(len(cells))
    inside = (sign == 0) & up[one] & up[other]
    pairs = (region[one[inside]], region[other[inside]])
    graph = coo_matrix((np.ones(len(pairs[0]), dtype=bool), pairs), shape=(len(cells),) * 2)
    count, region[cells] = connected_components(graph, directed=False)
    area = np.bincount(region[cells], minlength=count) * size**2
    share = np.where(area >= OPT["wide"], OPT["wide_share"], OPT["share"])
    is_terrain = np.zeros(count, dtype=bool)
    pairs = []
    for from_, to, drop, rise in (
        (one, other, sign == -1, sign == 1),
        (other, one, sign == 1, sign == -1),
    ):
        differ = up[from_] & (region[from_] != region[to])
        pairs.append(tuple(
            (region[from_[differ & each]], region[to[differ & each]])
            for each in (sign == 0, drop, rise)
        ))
    for _ in range(OPT["passes"]):
        ground = np.append(is_terrain, True)  # the last: what is not raised
        gentle, sharp, rises = np.zeros(count), np.zeros(count), np.zeros(count)
        for level, drop, rise in pairs:
            gentle += np.bincount(level[0][ground[level[1]]], minlength=count)
            sharp += np.bincount(drop[0], minlength=count)
            rises += np.bincount(rise[0][ground[rise[1]]], minlength=count)
        gentle += OPT["rise"] * rises
        new = (gentle > 0) & (gentle >= share * (gentle + sharp)) & (area >= allowance.gentle_area)
        if not (new & ~is_terrain).any():
            break
        is_terrain |= new
    result = np.zeros(up.size, dtype=bool)
    result[cells] = is_terrain[region[cells]]
    return result.reshape(raised.shape)


def _steps(
    filled: np.ndarray,
    known: np.ndarray,
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
    if OPT["run"]:
        stepped = np.flatnonzero(sign)
        sign[stepped[_on_slope(filled, known, one[stepped], axis)]] = 0
    return one, other, sign


def _on_slope(filled: np.ndarray, known: np.ndarray, one: np.ndarray, axis: int) -> np.ndarray:
    """Return which steps from cells to the next ones are part of a slope: two more follow suit."""
    flat = np.where(known, filled, np.nan).ravel()
    offset = filled.shape[1] if axis == 0 else 1
    place = np.divmod(one, filled.shape[1])[axis]
    count = filled.shape[axis]
    at = [flat[one + offset * (np.clip(place + k, 0, count - 1) - place)] for k in range(-2, 4)]
    rises = [after - before for before, after in zip(at, at[1:])]  # steps -2..2, own is [2]
    on = np.zeros(len(one), dtype=bool)
    for first in range(3):
        three = np.stack(rises[first : first + 3])
        same = (three > 0).all(axis=0) | (three < 0).all(axis=0)
        three = np.abs(three)
        on |= same & (three.min(axis=0) >= OPT["run"] * three.max(axis=0))
    return on
