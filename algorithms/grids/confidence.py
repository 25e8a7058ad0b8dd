"""The confidence of a terrain model: the probability that it is right, for each cell.

It follows from labelled points alone, labelled by any method. The weights are fitted by ``python -m
benchmarks.confidence``, which also prints how often the terrain is right at each level of
confidence; docs/check.md has the figures.
"""

from __future__ import annotations

from typing import NamedTuple, Sequence

import numpy as np

from ..core.points import Points
from .cells import Cells
from .gradient import length, steepness
from .inpaint import inpaint
from .morphology import within_square
from .parts import parts_with

# Side of the cells in metres. All values below were fitted with it.
CELL = 1.0
TOLERANCE = 0.3  # distance from the true terrain up to which a cell is right, m
# Share of the terrain's rise over the cell that is added, because the height is that of its middle.
RISE_SHARE = 0.5
_NEAR = 2  # cells to each side that are near a cell
_AROUND = 8  # cells to each side that are round it
# Weight of the cells round a cell, where the weight of those near it is 1.
_AROUND_SHARE = 0.05
# Height in metres above the ground up to which a rejected point may be ground.
_DOUBTFUL_HEIGHT = 1.0
_RELAXATIONS = 2
_ROUGHEST = 2.0  # largest roughness that counts, m
_STEEPEST = 8.0  # steepest step that counts, rise over run
_TINY = 1e-6


class Weights(NamedTuple):
    """The weight of each piece of `Evidence` in the logit of the confidence."""

    level: float = 5.7  # the logit on smooth ground without a gap
    holes: float = -2.4
    roughness: float = -4.2
    gap: float = -0.33
    gap_at_step: float = -0.43
    doubtful: float = -10.0


class Evidence(NamedTuple):
    """The evidence for the confidence of each cell; grids of float32, shape (rows, columns)."""

    holes: np.ndarray  # share of the cells with points within 2 m that have no ground
    # mean distance, metres, of ground near the cell from means of 3 x 3 cells
    roughness: np.ndarray
    gap: np.ndarray  # square of log(1 + d) with the distance d to the nearest ground cell in metres
    gap_at_step: np.ndarray  # log(1 + d) times the steepest rise over run of the ground within 8 m
    # share of the cells with points within 8 m whose lowest point is not ground, although it lies
    # below the ground or at most 1 m above it
    doubtful: np.ndarray


class Confidence(NamedTuple):
    """The confidence of a terrain model."""

    cells: Cells  # of 1 m over all points
    values: np.ndarray  # float32, (rows, columns): probability from 0 to 1


def confidence(points: Points, ground: np.ndarray) -> Confidence:
    """Return the probability that the terrain made of ground points is right, 0 everywhere without
    any, for cells of 1 m over all points that took part.
    """
    cells = Cells.over(points, CELL)
    return Confidence(cells, confidence_in(cells, points.z, ground, *map(np.arange, cells.shape)))


def confidence_in(
    cells: Cells, z: np.ndarray, ground: np.ndarray, rows: np.ndarray, columns: np.ndarray
) -> np.ndarray:
    """Return the same for some rows and columns of the cells, both in ascending order."""
    # It is right if the TIN of the ground points, at the middle of a cell, differs from the true
    # terrain by at most 0.3 m plus half of the terrain's rise over the cell.
    if not ground.any():
        return np.zeros((len(rows), len(columns)), dtype=np.float32)
    return probability(evidence(cells, z, ground, rows, columns))


def probability(pieces: Sequence[np.ndarray], weights: Weights = Weights()) -> np.ndarray:
    """Return the confidence, the logistic function of the weighted sum of pieces of evidence in the
    order of `Evidence`, as float32 in their shape.
    """
    logit = np.full(pieces[0].shape, weights.level, dtype=np.float32)
    for weight, values in zip(weights[1:], pieces):
        logit += np.float32(weight) * values
    return 1.0 / (1.0 + np.exp(-logit))


def evidence(
    cells: Cells, z: np.ndarray, ground: np.ndarray, rows: np.ndarray, columns: np.ndarray
) -> Evidence:
    """Return the evidence for the confidence of some rows and columns of cells of 1 m, from the
    heights in metres of all points, and which are ground, at least one.
    """
    from scipy import ndimage

    lowest, heights = cells.minimum(z), cells.minimum(z, np.flatnonzero(ground))
    occupied, has_ground = np.isfinite(lowest), np.isfinite(heights)
    surface = inpaint(heights, _RELAXATIONS, cells.first).astype(np.float32)
    doubtful = occupied & ~has_ground & (lowest - surface < _DOUBTFUL_HEIGHT)
    gap = np.log1p(_distances(has_ground, rows, columns) * cells.size).astype(np.float32)
    holes, rough, doubts = np.zeros((3, len(rows), len(columns)), dtype=np.float32)
    holes[:] = 1.0
    # Far from all points there are no means.
    near_points = within_square(np.maximum, occupied.view(np.uint8), _AROUND).view(bool)
    for part in parts_with(near_points, _AROUND + 1):
        (some_rows, inner_rows), (some_columns, inner_columns) = (
            _places_in(places, *sides)
            for places, *sides in zip((rows, columns), part.core, part.inner)
        )
        there, has = part.around, has_ground[part.around]
        near, around = (_mean(occupied[there], reach) for reach in (_NEAR, _AROUND))
        for grid, values in (
            (holes, np.clip(1.0 - _mean(has, _NEAR) / np.maximum(near, _TINY), 0.0, 1.0)),
            (rough, _roughness(surface[there], has)),
            (doubts, _mean(doubtful[there], _AROUND) / np.maximum(around, _TINY)),
        ):
            of_rows = values.take(inner_rows, axis=0)
            grid[some_rows, some_columns] = of_rows.take(inner_columns, axis=1)
    rise = np.minimum(steepness(surface, cells.size), np.float32(_STEEPEST))
    for axis, places in enumerate((rows, columns)):
        steepest = ndimage.maximum_filter1d(rise, 2 * _AROUND + 1, axis, mode="nearest")
        rise = steepest.take(places, axis)
    return Evidence(holes, rough, gap**2, gap * rise, doubts)


def _distances(which: np.ndarray, rows: np.ndarray, columns: np.ndarray) -> np.ndarray:
    """Return the distances in cells of some rows and columns to the nearest of some cells."""
    from scipy import ndimage

    # Of distances, scipy makes several planes of all cells.
    nearest = ndimage.distance_transform_edt(~which, return_distances=False, return_indices=True)
    row, column = nearest.take(rows, axis=1).take(columns, axis=2)
    north = np.subtract(row, rows[:, None], dtype=np.float64)
    east = np.subtract(column, columns, dtype=np.float64)
    return length(north, east)


def _places_in(places: np.ndarray, core: slice, inner: slice) -> tuple[slice, np.ndarray]:
    """Return which of ascending places lie in a part of the grid, and where in its margin."""
    some = slice(*np.searchsorted(places, (core.start, core.stop)).tolist())
    return some, places[some] - core.start + inner.start


def _roughness(surface: np.ndarray, has_ground: np.ndarray) -> np.ndarray:
    """Return how far the ground near each cell, or else round it, is from a smoothed surface."""
    from scipy import ndimage

    apart = np.abs(surface - ndimage.uniform_filter(surface, 3, mode="nearest"))
    apart = np.where(has_ground, np.minimum(apart, np.float32(_ROUGHEST)), np.float32(0.0))
    total = _mean(apart, _NEAR) + np.float32(_AROUND_SHARE) * _mean(apart, _AROUND)
    count = _mean(has_ground, _NEAR) + np.float32(_AROUND_SHARE) * _mean(has_ground, _AROUND)
    return total / np.maximum(count, np.float32(_TINY))


def _mean(values: np.ndarray, reach: int) -> np.ndarray:
    """Return the mean of the cells up to `reach` to each side; cells beyond the grid are 0."""
    from scipy import ndimage

    return ndimage.uniform_filter(values.astype(np.float32), 2 * reach + 1, mode="constant")
