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

from ...core.progress import SILENT, Progress
from ...grids.inpaint import First, inpaint
from ...grids.morphology import in_steps, opening, within_square

# A first, strict opening (rise over run) gives the surface from which the terrain's slope is taken.
_FIRST_SLOPE = 0.12
# Cells that are taken together for the largest windows, and radii in cells from which on so many
# are: what is cut off then is large.
_TOGETHER = 4
_RADII = ((1, 1, 24), (2, 26, 48), (4, 52, 10_000))
# How often regions join the ground that others have joined before.
_JOINING_PASSES = 4
# Steps are alike if the least is at least this share of the largest.
_ALIKE = 0.4
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
    wide_share, wide_area : float
        The share that suffices for regions of so many square metres or more: a plateau that a
        ramp joins with the ground. No building is as wide.
    usual_window : float
        Radius in metres of windows up to which all of this holds; larger ones are for halls.
    hall_height : float
        Larger windows cut off only what is higher by so many metres.
    rise_counts : bool
        Whether a border that rises to the ground counts as a gentle one: the tread of a terrace.
    follows_slopes : bool
        Whether a step between cells is no edge where those before or after it are as high: a
        steep slope, or a cliff, of which points lie on the face.
    """

    base: float = 0.15
    per_radius: float = 0.04
    per_slope: float = 0.2
    largest: float = 1.5
    gentle_step: float = 0.3
    gentle_share: float = 0.35
    gentle_area: float = 20.0
    wide_share: float = 0.12
    wide_area: float = 2000.0
    usual_window: float = 24.0
    hall_height: float = 2.5
    rise_counts: bool = True
    follows_slopes: bool = True


# As it was before large windows and slopes were told apart: for presets of other programs.
CLASSIC = Allowance(
    gentle_share=0.5, wide_share=0.5, usual_window=1e9, rise_counts=False, follows_slopes=False
)


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
    gentle = _gentle_regions(filled, known, raised, surface, size, allowance)
    raised &= objects | ~gentle
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
        cut, last = last.view(np.uint16), opened
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
        if metres <= allowance.usual_window:
            slope[lost > allowance.largest] = np.inf
        else:
            slope = np.where(lost > allowance.hall_height, np.inf, -np.inf)
        limit.ravel()[which] = np.maximum(limit.ravel()[which], slope)
        progress(done / len(radii))
    return first, limit


def _radii(largest: float) -> list[tuple[int, int]]:
    """Return the radii of windows in cells, and how many cells are taken together for each."""
    largest = max(round(largest), 1)
    return [
        (radius, together)
        for together, first, last in _RADII
        for radius in range(first, min(last, largest) + 1, together)
    ]


def _lowest_of_blocks(grid: np.ndarray, width: int) -> np.ndarray:
    """Return the lowest of each square of so many cells."""
    rows, columns = grid.shape
    padded = np.pad(grid, ((0, -rows % width), (0, -columns % width)), mode="edge")
    rows = np.minimum.reduce([padded[k::width] for k in range(width)])
    return np.minimum.reduce([rows[:, k::width] for k in range(width)])


def _finer(grid: np.ndarray, zoom: int, shape: tuple[int, int]) -> np.ndarray:
    """Return the value of its square for each cell of a grid of some shape."""
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
    filled: np.ndarray,
    known: np.ndarray,
    raised: np.ndarray,
    surface: np.ndarray,
    size: float,
    allowance: Allowance,
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
    borders = [
        _border(region, up, from_, to, (sign == 0, drop, rise))
        for from_, to, drop, rise in (
            (one, other, sign == -1, sign == 1),
            (other, one, sign == 1, sign == -1),
        )
    ]
    is_terrain = _joined(borders, area, allowance)
    result = np.zeros(up.size, dtype=bool)
    result[cells] = is_terrain[region[cells]]
    return result.reshape(raised.shape)


# Regions of the cells on either side of some pairs of cells; -1 for what is not raised.
_Pairs = tuple[np.ndarray, np.ndarray]


def _border(
    region: np.ndarray, up: np.ndarray, from_: np.ndarray, to: np.ndarray, kinds: tuple
) -> list[_Pairs]:
    """Return, for each kind of step, the pairs of regions that it leads from and to."""
    differ = up[from_] & (region[from_] != region[to])
    return [(region[from_[differ & each]], region[to[differ & each]]) for each in kinds]


def _joined(borders: list[list[_Pairs]], area: np.ndarray, allowance: Allowance) -> np.ndarray:
    """Return which regions pass into the ground, or into others that do.

    Parameters
    ----------
    borders : list of list of pairs
        Level pairs, drops and rises of each region, for both directions.
    area : numpy.ndarray of float, shape (regions,)
        Square metres.
    allowance : Allowance
        Which share of the border must be gentle.

    Returns
    -------
    numpy.ndarray of bool, shape (regions,)
    """
    count = len(area)
    share = np.where(area >= allowance.wide_area, allowance.wide_share, allowance.gentle_share)
    sharp = sum(np.bincount(drop[0], minlength=count) for _, drop, _ in borders)
    joined = np.zeros(count, dtype=bool)
    for _ in range(_JOINING_PASSES):
        ground = np.append(joined, True)  # the last one is what is not raised
        gentle = np.zeros(count)
        for level, _, rise in borders:
            for from_, to in (level, rise) if allowance.rise_counts else (level,):
                gentle += np.bincount(from_[ground[to]], minlength=count)
        new = (gentle > 0) & (gentle >= share * (gentle + sharp)) & (area >= allowance.gentle_area)
        if not (new & ~joined).any():
            break
        joined |= new
    return joined


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
    if allowance.follows_slopes:
        stepped = np.flatnonzero(sign)
        sign[stepped[_on_slope(filled, known, one[stepped], axis)]] = 0
    return one, other, sign


def _on_slope(filled: np.ndarray, known: np.ndarray, one: np.ndarray, axis: int) -> np.ndarray:
    """Return which steps from cells to the next ones are part of a slope: two more are alike.

    Cells without a point do not count: what fills them makes a slope of any wall.
    """
    flat = np.where(known, filled, np.nan).ravel()
    offset = filled.shape[1] if axis == 0 else 1
    place, count = np.divmod(one, filled.shape[1])[axis], filled.shape[axis]
    at = [flat[one + offset * (np.clip(place + k, 0, count - 1) - place)] for k in range(-2, 4)]
    rises = [after - before for before, after in zip(at, at[1:])]  # the third is that of the step
    on = np.zeros(len(one), dtype=bool)
    for first in range(3):
        three = np.stack(rises[first : first + 3])
        same = (three > 0).all(axis=0) | (three < 0).all(axis=0)
        three = np.abs(three)
        on |= same & (three.min(axis=0) >= _ALIKE * three.max(axis=0))
    return on
