"""Regions of a height grid that pass into the ground without an edge.

A region that an opening cuts off is terrain after all if it continues gently into the ground round
it: a dike, a terrace, a plateau with a ramp.
"""

from __future__ import annotations

import numpy as np

from ...grids.inpaint import First
from .allowance import Allowance
from .landforms import RaisedCells, landforms
from .slopes import on_slope

# Passes in which regions join the ground or regions that have joined it.
_JOINING_PASSES = 4
# Metres over which the surface is smoothed for the terrain's own rise, which is no step.
_TREND_SMOOTHING = 2.0
# If more than this share of a large region's border is the border of the survey, too little is
# known of the region. The share is less than half, because the sides of cells make a slanted edge
# longer than it is.
_OPEN_SHARE = 0.45
# A region may be a house if it is smaller (m2) and higher (m) than this. Then at least this share
# of its border must be gentle: on a slope one side of a roof may be level with the ground.
_HOUSE_AREA, _HOUSE_HEIGHT, _HOUSE_SHARE = 400.0, 2.5, 0.5


def gentle_regions(
    filled: np.ndarray,
    known: np.ndarray,
    surveyed: np.ndarray,
    raised: np.ndarray,
    surface: np.ndarray,
    size: float,
    allowance: Allowance,
    first: First = (0, 0),
) -> tuple[np.ndarray, np.ndarray]:
    """Find the raised cells whose region passes into the ground without an edge.

    A region is a group of raised cells without steps between them. Its border is gentle where it
    touches the ground without a step, and sharp where it drops. Rocks and ramps are ground with
    any border.

    Parameters
    ----------
    filled : numpy.ndarray of float, shape (rows, columns)
        Heights in metres without NaN.
    known : numpy.ndarray of bool, shape (rows, columns)
        Cells with a point.
    surveyed : numpy.ndarray of bool, shape (rows, columns)
        Cells with a point, and small gaps between them.
    raised : numpy.ndarray of bool, shape (rows, columns)
        Cells that are judged.
    surface : numpy.ndarray of float, shape (rows, columns)
        Heights of the ground in metres, gaps filled.
    size : float
        Side of a cell in metres.
    allowance : Allowance
        What is an edge, and how much of the border must be gentle.
    first : tuple of int
        Row and column of the first cell in the grid of the CRS.

    Returns
    -------
    terrain, landforms : numpy.ndarray of bool, shape (rows, columns)
        Raised cells that are ground after all, and those of them that are rocks or ramps.
    """
    allowance = allowance.for_cells(size)
    seen = np.ones(known.size, dtype=bool)
    if allowance.judges_gaps:
        # A gap in a roof must not count as ground beside the roof.
        raised = raised | (~known & (filled - surface > allowance.gentle_step))
    smooth = smoothed(surface, size, _TREND_SMOOTHING)
    sides = [
        _steps(filled, known, raised, smooth, axis, size, allowance, first) for axis in (0, 1)
    ]
    one, other, sign = (np.concatenate(each) for each in zip(*sides))
    if allowance.judges_gaps:
        # The filling of a gap in the survey, or beside a wall, slopes down gently from any roof.
        both = surveyed.ravel()[one] & surveyed.ravel()[other]
        one, other, sign = one[both], other[both], sign[both]
        seen = known.ravel()
    up = raised.ravel()
    inside = (sign == 0) & up[one] & up[other]
    region, count = _numbered(up, one[inside], other[inside])
    borders = _borders(region, up, (one, other, sign), seen)
    cells = np.flatnonzero(up)
    number = region[cells]
    area = np.bincount(number, minlength=count) * size**2
    open_ = np.bincount(number, _unsurveyed(surveyed).ravel()[cells], count)
    heights = filled.ravel()[cells]
    above = heights - surface.ravel()[cells]
    row, column = np.divmod(cells, raised.shape[1])
    up_cells = RaisedCells(number, size * row, size * column, heights, above)
    feet = np.where(up[one], one, other)[(sign == 0) & (up[one] != up[other])]
    feet = np.searchsorted(cells, feet[seen[feet]])
    special = landforms(up_cells, feet, size, allowance)
    above = np.bincount(number, above, count) * size**2 / area
    joined = _joined(borders, area, above, open_, special, allowance)
    result = np.zeros((2, up.size), dtype=bool)
    for which, grid in zip((joined, special), result):
        grid[cells] = which[number]
    return tuple(result.reshape(2, *raised.shape))


def _numbered(up: np.ndarray, one: np.ndarray, other: np.ndarray) -> tuple[np.ndarray, int]:
    """Return the region of each cell, -1 where none is raised, and how many there are.

    Parameters
    ----------
    up : numpy.ndarray of bool, shape (cells,)
        Raised cells.
    one, other : numpy.ndarray of intp, shape (pairs,)
        Pairs of raised cells without a step between them.
    """
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    cells = np.flatnonzero(up)
    region = np.full(up.size, -1, dtype=np.int64)
    region[cells] = np.arange(len(cells))
    pairs = region[one], region[other]
    graph = coo_matrix((np.ones(len(one), dtype=bool), pairs), shape=(len(cells),) * 2)
    count, region[cells] = connected_components(graph, directed=False)
    return region, count


def _unsurveyed(surveyed: np.ndarray) -> np.ndarray:
    """Return how many of the four neighbours of each cell lie outside the survey."""
    beyond = np.pad(~surveyed, 1, constant_values=True).astype(np.int8)
    rows = beyond[:-2, 1:-1] + beyond[2:, 1:-1]
    return rows + beyond[1:-1, :-2] + beyond[1:-1, 2:]


# Regions of the first and of the second cell of pairs of cells; -1 for cells that are not raised.
_Pairs = tuple[np.ndarray, np.ndarray]


def _borders(
    region: np.ndarray,
    up: np.ndarray,
    steps: tuple[np.ndarray, np.ndarray, np.ndarray],
    seen: np.ndarray,
) -> list[list[_Pairs]]:
    """Return the pairs of regions between which there are level steps, drops and rises.

    The two directions are separate.
    """
    one, other, sign = steps
    borders = []
    for from_, to, drop in ((one, other, -1), (other, one, 1)):
        differ = up[from_] & (region[from_] != region[to])
        kinds = (sign == 0) & seen[from_], sign == drop, sign == -drop
        borders.append(
            [(region[from_[differ & each]], region[to[differ & each]]) for each in kinds]
        )
    return borders


def _joined(
    borders: list[list[_Pairs]],
    area: np.ndarray,
    above: np.ndarray,
    open_: np.ndarray,
    terrain: np.ndarray,
    allowance: Allowance,
) -> np.ndarray:
    """Return which regions pass into the ground, or into others that do.

    Parameters
    ----------
    borders : list of list of pairs
        Level pairs, drops and rises of each region, for both directions.
    area : numpy.ndarray of float, shape (regions,)
        Square metres.
    above : numpy.ndarray of float, shape (regions,)
        Mean height above the ground in metres.
    open_ : numpy.ndarray of float, shape (regions,)
        Sides of cells at the border of the survey.
    terrain : numpy.ndarray of bool, shape (regions,)
        Which are ground with any border.
    allowance : Allowance
        Which share of the border must be gentle.

    Returns
    -------
    numpy.ndarray of bool, shape (regions,)
    """
    count = len(area)
    sharp = sum(np.bincount(drop[0], minlength=count) for _, drop, _ in borders)
    # A higher region may be a building cut by the border of the survey.
    is_open = (area >= allowance.border_area) & (above <= allowance.border_height)
    open_ = np.where(is_open, open_, 0.0)
    is_house = (area < _HOUSE_AREA) & (above > _HOUSE_HEIGHT)
    share = np.where(is_house, max(_HOUSE_SHARE, allowance.gentle_share), allowance.gentle_share)
    level_share = np.interp(
        np.log(area),
        np.log((_HOUSE_AREA, allowance.wide_area)),
        (allowance.gentle_share, allowance.wide_share),
    )
    joined = terrain.copy()
    for _ in range(_JOINING_PASSES):
        ground = np.append(joined, True)  # the last one stands for cells that are not raised
        level, rising = np.zeros((2, count))
        for flat, _, rise in borders:
            level += np.bincount(flat[0][ground[flat[1]]], minlength=count)
            rising += np.bincount(rise[0][ground[rise[1]]], minlength=count)
        gentle = level + rising if allowance.rise_counts else level
        bounded = gentle + sharp
        new = gentle >= share * bounded
        # A ramp is level with the ground. Rises do not count: a roof rises to the next roof.
        new |= (level >= level_share * bounded) & (area >= _HOUSE_AREA)
        new &= gentle > 0
        new |= open_ > _OPEN_SHARE * (bounded + open_)
        new &= area >= allowance.gentle_area
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
    first: First,
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Compare neighbouring cells along an axis if at least one of them is raised.

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
    rise = filled.ravel()[other] - filled.ravel()[one]
    usual = slope_at(smooth, axis, one, size) * size
    allowed = allowance.gentle_step + np.abs(usual)
    rise -= usual
    sign = (rise > allowed).astype(np.int8) - (rise < -allowed).astype(np.int8)
    if allowance.follows_slopes:
        stepped = np.flatnonzero(sign)
        sign[stepped[on_slope(filled, known, one[stepped], axis, size, first)]] = 0
    return one, other, sign


def smoothed(surface: np.ndarray, size: float, smoothing: float) -> np.ndarray:
    """Return a surface smoothed over `smoothing` metres."""
    from scipy import ndimage

    return ndimage.gaussian_filter(surface, smoothing / size, mode="nearest")


def slope_at(surface: np.ndarray, axis: int, cells: np.ndarray, size: float) -> np.ndarray:
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
