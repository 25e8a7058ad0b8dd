"""Check the seeds of the ground against the ground on each side of them.

The lowest point of a cell may be a plant, or lie below the ground. And at a break (the edge of a
terrace, a ridge, the top of a wall) morphology cuts off ground. The planes through the ground on
each side show both.
"""

from __future__ import annotations

import numpy as np

from ...core.points import Points
from ...core.threads import in_threads
from ...grids.cells import Cells, lower_at
from ...grids.gradient import steepness
from ...grids.inpaint import inpaint
from ...grids.morphology import within_square
from .half_planes import Sides
from .openness import openness

# Seeds are neighbours within so many times their spacing, and within at least so many metres.
_SPACINGS, _LEAST_REACH = 5.0, 6.0
# A seed more than so many metres above the planes of all sides is a plant, and so far below all of
# them an outlier. The misfit of the plane is added.
_PLANT, _FAULT = 0.2, 0.7
# Half the width, in spacings, of the windows of a mean surface. Only seeds far from it are checked.
_MEAN_SPACINGS = 1.5
# Metres from the plane of one side within which a point joins the ground, and the largest misfit
# of that plane.
_LEVEL, _LARGEST_MISFIT = 0.25, 0.3
# Points join only where the openness is at least so large: under trees, plants are level with
# something too.
_OPEN = 0.8
# How often points join the ground, each time within so many spacings of it.
_PASSES, _STEP_SPACINGS = 2, 1.5
# Largest rise over run from the seeds within that distance to a point that joins.
_STEEPEST = 1.5


def checked_seeds(
    points: Points,
    seeds: np.ndarray,
    waiting: np.ndarray,
    cells: Cells,
    spacing: float,
    has_gaps: bool = True,
) -> tuple[np.ndarray, np.ndarray]:
    """Return seeds without plants and outliers, and with the ground at breaks.

    Parameters
    ----------
    points : Points
        All points.
    seeds, waiting : numpy.ndarray of int
        Indices of the points taken for ground, and of other points that may be ground.
    cells : Cells
        A grid over the points.
    spacing : float
        Usual distance between points in metres, at least the side of a cell.
    has_gaps : bool
        Whether there are gaps between the seeds in which breaks may be lost. Only then breaks are
        searched.

    Returns
    -------
    seeds, waiting : numpy.ndarray of int
        The same after the check.
    """
    reach = max(_LEAST_REACH, _SPACINGS * spacing)
    mean = _mean_surface(points, seeds, cells, spacing)
    rise = steepness(mean, cells.size) * cells.size
    wrong = _wrong(points, seeds, cells, mean, rise, reach)
    waiting, seeds = np.append(waiting, seeds[wrong]), seeds[~wrong]
    if not has_gaps:
        return seeds, waiting
    is_open = (openness(points, cells, rise) >= _OPEN).ravel()[cells.index[waiting]]
    waiting, never = waiting[is_open], waiting[~is_open]
    for _ in range(_PASSES):
        joins = _level(points, seeds, waiting, cells, spacing, reach)
        seeds, waiting = np.append(seeds, waiting[joins]), waiting[~joins]
    return seeds, np.append(waiting, never)


def _mean_surface(points: Points, seeds: np.ndarray, cells: Cells, spacing: float) -> np.ndarray:
    """Return a smooth surface through the lowest seeds."""
    from scipy import ndimage

    lowest = _extreme(cells, points, seeds)
    surface = inpaint(np.where(np.isfinite(lowest), lowest, np.nan), 2, cells.first)
    width = 2 * int(np.ceil(_MEAN_SPACINGS * spacing / cells.size)) + 1
    return ndimage.uniform_filter(surface, width, mode="nearest")


def _wrong(
    points: Points,
    seeds: np.ndarray,
    cells: Cells,
    mean: np.ndarray,
    allowed: np.ndarray,
    reach: float,
) -> np.ndarray:
    """Return which seeds lie above the planes of all sides, or below all.

    On a slope, the height of a seed above the mean depends on its place in the cell: `allowed`.
    """
    cell, z = cells.index[seeds], points.z[seeds]
    above, allowed = z - mean.ravel()[cell], allowed.ravel()[cell]
    doubtful = np.flatnonzero((above - allowed > _PLANT) | (above + allowed < -_FAULT))
    near = _near(cells, seeds, seeds[doubtful], reach)
    rise, misfit = Sides(points.take(seeds[near]), reach).rises(
        points.take(seeds[doubtful]), own=True
    )
    # Seeds without neighbours on any side have no rise, and stay.
    plant = np.fmin.reduce(rise - misfit, axis=1) > _PLANT
    fault = np.fmax.reduce(rise + misfit, axis=1) < -_FAULT
    wrong = np.zeros(len(seeds), dtype=bool)
    wrong[doubtful] = plant | fault
    return wrong


def _level(
    points: Points,
    seeds: np.ndarray,
    waiting: np.ndarray,
    cells: Cells,
    spacing: float,
    reach: float,
) -> np.ndarray:
    """Return which waiting points lie on the plane of the seeds on one side."""
    step = int(np.ceil(_STEP_SPACINGS * spacing / cells.size))
    margin = _LEVEL + _STEEPEST * step * cells.size
    cell, z = cells.index[waiting], points.z[waiting]

    def extreme(sign: float) -> np.ndarray:
        nearest = within_square(np.minimum, _extreme(cells, points, seeds, sign), step)
        return sign * nearest.ravel()[cell]

    low, high = in_threads(extreme, (1.0, -1.0))
    candidates = np.flatnonzero((z >= low - margin) & (z <= high + margin))
    near = _near(cells, seeds, waiting[candidates], reach)
    rise, misfit = Sides(points.take(seeds[near]), reach).rises(
        points.take(waiting[candidates]), own=False
    )
    joins = np.zeros(len(waiting), dtype=bool)
    fits = (misfit <= _LARGEST_MISFIT) & (np.abs(rise) <= _LEVEL)
    joins[candidates] = fits.any(axis=1)
    return joins


def _extreme(cells: Cells, points: Points, which: np.ndarray, sign: float = 1.0) -> np.ndarray:
    """Return the lowest of some points in each cell; infinite where there is none.

    With a sign of -1, return the highest, as the lowest of the negative heights.
    """
    lowest = np.full(cells.rows * cells.columns, np.inf, dtype=np.float32)
    lower_at(lowest, cells.index[which], (sign * points.z[which]).astype(np.float32))
    return lowest.reshape(cells.shape)


def _near(cells: Cells, seeds: np.ndarray, judged: np.ndarray, reach: float) -> np.ndarray:
    """Return which seeds may be neighbours of the judged points; most are not."""
    steps = int(np.ceil(reach / cells.size)) + 1
    around = within_square(np.maximum, cells.holding(judged), steps)
    return around.ravel()[cells.index[seeds]]
