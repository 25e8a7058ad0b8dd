"""How sure the terrain is that ground points make: a probability for each cell.

It is told from labelled points alone, whatever labelled them. The weights are fitted by
``python -m benchmarks.confidence``, which also prints how often the terrain is right where so
much confidence is stated; docs/confidence.md has the figures.
"""

from __future__ import annotations

from typing import NamedTuple, Sequence

import numpy as np

from ...core.points import Points
from ...grids.cells import Cells
from ...grids.gradient import steepness
from ...grids.inpaint import inpaint

# Metres: side of the cells. All that follows was fitted with it.
CELL = 1.0
# Metres within which a cell's terrain counts as right, and the share of the terrain's rise over a
# cell that is added: the height is meant for the middle of the cell.
TOLERANCE, RISE_SHARE = 0.3, 0.5
# Cells to each side of a cell that are near it, and that are round it.
_NEAR, _AROUND = 2, 8
# Weight of the cells round a cell, where the weight of those near it is 1.
_AROUND_SHARE = 0.05
# Metres above the ground up to which a rejected point may well be ground.
_DOUBTFUL_HEIGHT = 1.0
_RELAXATIONS = 2
# Roughness and steps do not count beyond.
_ROUGHEST, _STEEPEST = 2.0, 8.0
_TINY = 1e-6


class Weights(NamedTuple):
    """What each piece of `Evidence` adds to the logit of the confidence.

    Attributes
    ----------
    level : float
        The logit on smooth ground without a gap.
    holes, roughness, gap, gap_at_step, doubtful : float
        Times the piece of evidence of this name.
    """

    level: float = 5.7
    holes: float = -2.4
    roughness: float = -4.2
    gap: float = -0.33
    gap_at_step: float = -0.43
    doubtful: float = -10.0


class Evidence(NamedTuple):
    """What tells how sure the terrain of a cell is; each a grid of float32, (rows, columns).

    Attributes
    ----------
    holes : numpy.ndarray
        Share of the cells with points within 2 m that have no ground.
    roughness : numpy.ndarray
        Mean distance in metres of the ground near the cell from the mean of the 3 x 3 cells round
        it.
    gap : numpy.ndarray
        Square of log(1 + d), d being the distance in metres to the nearest cell with ground.
    gap_at_step : numpy.ndarray
        log(1 + d) times the steepest rise over run of the ground within 8 m.
    doubtful : numpy.ndarray
        Share of the cells with points within 8 m whose lowest point is no more than 1 m above the
        ground, or below it, and is not ground.
    """

    holes: np.ndarray
    roughness: np.ndarray
    gap: np.ndarray
    gap_at_step: np.ndarray
    doubtful: np.ndarray


class Confidence(NamedTuple):
    """How sure the terrain is.

    Attributes
    ----------
    cells : Cells
        Cells of 1 m over all points.
    values : numpy.ndarray of float32, shape (rows, columns)
        Probability from 0 to 1.
    """

    cells: Cells
    values: np.ndarray


def confidence(points: Points, ground: np.ndarray) -> Confidence:
    """Return the probability that the terrain made of ground points is right, for cells of 1 m.

    It is right where the height of the TIN of the ground points at the middle of a cell lies within
    0.3 m, and half of the terrain's rise over the cell, of the true terrain.

    Parameters
    ----------
    points : Points
        All points that took part, at least one.
    ground : numpy.ndarray of bool, shape (n,)
        Which of them were taken for ground, by any method.

    Returns
    -------
    Confidence
        0 everywhere if there is no ground.

    Raises
    ------
    BareEarthError
        If the points spread too far for a grid.
    """
    cells = Cells.over(points, CELL)
    if not ground.any():
        return Confidence(cells, np.zeros(cells.shape, dtype=np.float32))
    return Confidence(cells, probability(evidence(cells, points.z, ground)))


def probability(pieces: Sequence[np.ndarray], weights: Weights = Weights()) -> np.ndarray:
    """Return the confidence that pieces of evidence give, in the order of `Evidence`.

    Parameters
    ----------
    pieces : sequence of numpy.ndarray of float
        All of the same shape.
    weights : Weights
        Those that were fitted.

    Returns
    -------
    numpy.ndarray of float32
        Of that shape; the logistic function of the weighted sum.
    """
    logit = np.full(pieces[0].shape, weights.level, dtype=np.float32)
    for weight, values in zip(weights[1:], pieces):
        logit += np.float32(weight) * values
    return 1.0 / (1.0 + np.exp(-logit))


def evidence(cells: Cells, z: np.ndarray, ground: np.ndarray) -> Evidence:
    """Return what tells how sure the terrain of each cell is.

    Parameters
    ----------
    cells : Cells
        Cells of 1 m over all points.
    z : numpy.ndarray of float, shape (n,)
        Their heights in metres.
    ground : numpy.ndarray of bool, shape (n,)
        Which are ground, at least one.
    """
    from scipy import ndimage

    lowest, heights = cells.minimum(z), cells.minimum(np.where(ground, z, np.inf))
    occupied, has_ground = np.isfinite(lowest), np.isfinite(heights)
    surface = inpaint(heights, _RELAXATIONS, cells.first).astype(np.float32)
    doubtful = occupied & ~has_ground & (lowest - surface < _DOUBTFUL_HEIGHT)
    gap = np.log1p(ndimage.distance_transform_edt(~has_ground) * cells.size).astype(np.float32)
    rise = np.minimum(steepness(surface, cells.size), np.float32(_STEEPEST))
    near, around = (_mean(occupied, reach) for reach in (_NEAR, _AROUND))
    return Evidence(
        np.clip(1.0 - _mean(has_ground, _NEAR) / np.maximum(near, _TINY), 0.0, 1.0),
        _roughness(surface, has_ground),
        gap**2,
        gap * ndimage.maximum_filter(rise, 2 * _AROUND + 1, mode="nearest"),
        _mean(doubtful, _AROUND) / np.maximum(around, _TINY),
    )


def _roughness(surface: np.ndarray, has_ground: np.ndarray) -> np.ndarray:
    """Return how far the ground near each cell, or else round it, is from a smoother one."""
    from scipy import ndimage

    apart = np.abs(surface - ndimage.uniform_filter(surface, 3, mode="nearest"))
    apart = np.where(has_ground, np.minimum(apart, np.float32(_ROUGHEST)), np.float32(0.0))
    total = _mean(apart, _NEAR) + np.float32(_AROUND_SHARE) * _mean(apart, _AROUND)
    count = _mean(has_ground, _NEAR) + np.float32(_AROUND_SHARE) * _mean(has_ground, _AROUND)
    return total / np.maximum(count, np.float32(_TINY))


def _mean(values: np.ndarray, reach: int) -> np.ndarray:
    """Return the mean of the cells up to so many to each side; beyond the grid it is 0."""
    from scipy import ndimage

    return ndimage.uniform_filter(values.astype(np.float32), 2 * reach + 1, mode="constant")
