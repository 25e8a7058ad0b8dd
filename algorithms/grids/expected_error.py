"""The expected error of a terrain model: 95 of 100 errors are not larger.

It follows from points with a mask of ground, by any method: seven pieces of evidence are found for
each cell, and each makes the error larger by a factor from a table. ``python -m
benchmarks.expected_error`` fits the table and measures how often the errors of real terrain models
lie within what is expected; docs/expected-error.md has the figures.
"""

from __future__ import annotations

from typing import Iterator, Mapping, NamedTuple

import numpy as np

from ..core.points import Points
from .cells import Cells
from .gradient import length, steepness
from .inpaint import inpaint
from .morphology import within_square
from .parts import parts_with

CELL = 1.0  # side of the cells in metres, for which all values below were fitted
# Cells to each side of a cell that are near it, and that are round it.
_NEAR = 2
_AROUND = 8
# Weight of the cells round a cell in its roughness, in relation to that of the cells near it.
_AROUND_SHARE = 0.05
# Largest height in metres above the ground of points that are not ground but may be.
_DOUBTFUL_HEIGHT = 1.0
# Heights in metres above the ground between which points that are not ground are low plants: the
# ground may be too high there.
_LOW_PLANTS = (0.1, 0.3)
RELAXATIONS = 2
_ROUGHEST = 2.0  # largest roughness that counts in metres
_STEEPEST = 8.0  # steepest rise over run that counts
_TINY = 1e-6

LEAST = 0.0792  # the expected error in metres where no evidence makes it larger


class Evidence(NamedTuple):
    """The evidence for the error of each cell; grids of float32, shape (rows, columns)."""

    holes: np.ndarray  # share of cells without ground among those with points within 2 m
    roughness: np.ndarray  # mean distance in metres of ground near it from means of 3 x 3 cells
    slope: np.ndarray  # rise over run of the ground, at most 8
    gap: np.ndarray  # distance to the nearest ground cell in metres
    gap_at_step: np.ndarray  # log(1 + gap) times the steepest slope of the ground within 8 m
    # Share of cells, among those with points within 8 m, that have no ground, although their lowest
    # point lies at most 1 m above the ground.
    doubtful: np.ndarray
    low_plants: np.ndarray  # share of the points within 8 m that are low plants


# Values of each piece of evidence, and the factors by which they make the error larger. Between two
# values the logarithm of the factor is linear.
Table = Mapping[str, "tuple[tuple[float, float], ...]"]
FACTORS: Table = {
    "holes": ((0.0, 1.0), (0.25, 1.18), (0.5, 1.42), (0.75, 1.7), (1.0, 2.03)),
    "roughness": (
        (0.01, 1.0), (0.02, 1.18), (0.04, 1.54), (0.08, 1.99), (0.16, 2.58), (0.32, 3.37),
        (0.64, 4.26),
    ),
    "slope": ((0.0, 1.0), (0.1, 1.23), (0.3, 1.46), (0.7, 1.74), (1.5, 2.11)),
    "gap": (
        (0.0, 1.0), (1.0, 1.07), (2.0, 1.26), (4.0, 1.5), (8.0, 1.77), (16.0, 2.07), (32.0, 2.4),
    ),
    "gap_at_step": (
        (0.0, 1.0), (0.25, 1.14), (0.5, 1.37), (1.0, 1.67), (2.0, 2.05), (4.0, 2.45), (8.0, 2.86),
    ),
    "doubtful": ((0.0, 1.0), (0.02, 1.17), (0.05, 1.35), (0.1, 1.53), (0.2, 1.69)),
    "low_plants": ((0.0, 1.0), (0.02, 1.2), (0.05, 1.36), (0.1, 1.58), (0.2, 1.9)),
}  # fmt: skip
# The usual factor of each piece of evidence in the benchmark: a larger one is a cause of the error.
_USUAL = (1.25, 1.74, 1.22, 1.1, 1.14, 1.16, 1.11)
# By the benchmark: the ratio of the RMSE of a tile to the root mean square of its expected errors.
RMSE_SHARE = 0.35
LARGE = 0.3  # metres from which on an expected error is reported as large


class ExpectedError(NamedTuple):
    """The expected error of a terrain model."""

    cells: Cells  # of 1 m over all points
    values: np.ndarray  # float32, (rows, columns): metres


def expected_error(points: Points, ground: np.ndarray) -> ExpectedError:
    """Return the expected error of the terrain made of ground points, for cells of 1 m over all
    points that took part.
    """
    cells = Cells.over(points, CELL)
    pieces = evidence(cells, points.z, ground, *map(np.arange, cells.shape))
    return ExpectedError(cells, error_of(pieces))


def error_of(pieces: Evidence, factors: Table = FACTORS, least: float = LEAST) -> np.ndarray:
    """Return the expected error of each cell in metres, float32, given its evidence."""
    logarithm = np.full(pieces.holes.shape, np.log(least), dtype=np.float32)
    for one in _logarithms(pieces, factors):
        logarithm += one
    return np.exp(logarithm)


def causes_of(pieces: Evidence) -> np.ndarray:
    """Return the piece of evidence whose factor exceeds its usual one most in each cell, uint8: its
    number in `Evidence` from 1; 0 where no factor is larger than usual.
    """
    causes = np.zeros(pieces.holes.shape, dtype=np.uint8)
    most = np.zeros(pieces.holes.shape, dtype=np.float32)
    for number, one in enumerate(_logarithms(pieces, FACTORS), start=1):
        more = one - np.float32(np.log(_USUAL[number - 1]))
        causes[more > most] = number
        most = np.maximum(most, more)
    return causes


def _logarithms(pieces: Evidence, factors: Table) -> Iterator[np.ndarray]:
    """Yield the logarithm of the factor of each piece of evidence."""
    for name, values in pieces._asdict().items():
        start, factor = np.array(factors[name]).T
        yield np.interp(values, start, np.log(factor)).astype(np.float32)


class ExpectedAccuracy:
    """The expected accuracy of a terrain model, from the expected errors of its cells, by parts."""

    def __init__(self) -> None:
        self.count = 0  # number of cells with an expected error
        self.large = 0  # number of cells whose expected error is large
        self._squares = 0.0

    def add(self, error: np.ndarray) -> None:
        """Add the expected errors of cells in metres, without NaN."""
        known = error[np.isfinite(error)].astype(np.float64)
        self.count += len(known)
        self.large += int(np.count_nonzero(known > LARGE))
        self._squares += float(np.sum(known**2))

    @property
    def rmse(self) -> float:
        """The RMSE of the terrain model in metres; NaN without cells."""
        return RMSE_SHARE * (self._squares / self.count) ** 0.5 if self.count else float("nan")

    @property
    def text(self) -> str:
        """The expected accuracy in words."""
        return (
            f"The expected RMSE of the terrain model is {self.rmse:.2f} m, by its points alone and"
            f" not measured. {self.large / max(self.count, 1):.1%} of its cells have an expected"
            f" error over {LARGE} m."
        )


def expected_rmse(error: np.ndarray) -> float:
    """Return the expected RMSE of a terrain model in metres, from the expected errors of its cells
    that are not NaN; NaN if all are.
    """
    expected = ExpectedAccuracy()
    expected.add(error)
    return expected.rmse


def evidence(
    cells: Cells, z: np.ndarray, ground: np.ndarray, rows: np.ndarray, columns: np.ndarray
) -> Evidence:
    """Return the evidence in some rows and columns of cells of 1 m, both ascending, given the
    heights of all points in metres and which of them are ground.
    """
    from scipy import ndimage

    if not ground.any():
        # The nearest ground lies beyond the block.
        nothing = np.zeros((len(rows), len(columns)), dtype=np.float32)
        far = np.full_like(nothing, np.inf)
        return Evidence(far, nothing, nothing, far, nothing, nothing, nothing)
    lowest, heights = cells.minimum(z), cells.minimum(z, np.flatnonzero(ground))
    occupied, has_ground = np.isfinite(lowest), np.isfinite(heights)
    surface = inpaint(heights, RELAXATIONS, cells.first).astype(np.float32)
    doubtful = occupied & ~has_ground & (lowest - surface < _DOUBTFUL_HEIGHT)
    low_plants = _low_plants(cells, z, ground, surface)
    gap = (_distances(has_ground, rows, columns) * cells.size).astype(np.float32)
    holes, rough, doubts, plants = np.zeros((4, len(rows), len(columns)), dtype=np.float32)
    holes[:] = 1.0
    # Cells far from all points have no means.
    near_points = within_square(np.maximum, occupied.view(np.uint8), _AROUND).view(bool)
    for part in parts_with(near_points, _AROUND + 1):
        (some_rows, inner_rows), (some_columns, inner_columns) = (
            _places_in(places, *sides)
            for places, *sides in zip((rows, columns), part.core, part.inner)
        )
        there, has = part.around, has_ground[part.around]
        near, around = (_mean(occupied[there], reach) for reach in (_NEAR, _AROUND))
        points = _mean(cells.counts[there], _AROUND)
        for grid, values in (
            (holes, np.clip(1.0 - _mean(has, _NEAR) / np.maximum(near, _TINY), 0.0, 1.0)),
            (rough, _roughness(surface[there], has)),
            (doubts, _mean(doubtful[there], _AROUND) / np.maximum(around, _TINY)),
            (plants, _mean(low_plants[there], _AROUND) / np.maximum(points, _TINY)),
        ):
            of_rows = values.take(inner_rows, axis=0)
            grid[some_rows, some_columns] = of_rows.take(inner_columns, axis=1)
    rise = np.minimum(steepness(surface, cells.size), np.float32(_STEEPEST))
    slope = rise.take(rows, axis=0).take(columns, axis=1)
    for axis, places in enumerate((rows, columns)):
        steepest = ndimage.maximum_filter1d(rise, 2 * _AROUND + 1, axis, mode="nearest")
        rise = steepest.take(places, axis)
    return Evidence(holes, rough, slope, gap, np.log1p(gap) * rise, doubts, plants)


def _low_plants(cells: Cells, z: np.ndarray, ground: np.ndarray, surface: np.ndarray) -> np.ndarray:
    """Return the number of points on low plants in each cell."""
    low, high = _LOW_PLANTS
    above = z - surface.ravel().take(cells.index)
    return cells.counts_of(~ground & (above > low) & (above <= high))


def _distances(targets: np.ndarray, rows: np.ndarray, columns: np.ndarray) -> np.ndarray:
    """Return the distances in cells from cells of some rows and columns to the nearest target."""
    from scipy import ndimage

    # The distances are computed here, because scipy needs several arrays of all cells for them.
    nearest = ndimage.distance_transform_edt(~targets, return_distances=False, return_indices=True)
    row, column = nearest.take(rows, axis=1).take(columns, axis=2)
    north = np.subtract(row, rows[:, None], dtype=np.float64)
    east = np.subtract(column, columns, dtype=np.float64)
    return length(north, east)


def _places_in(places: np.ndarray, core: slice, inner: slice) -> tuple[slice, np.ndarray]:
    """Return which of ascending places lie in a part of the grid, and where within its margin."""
    inside = slice(*np.searchsorted(places, (core.start, core.stop)).tolist())
    return inside, places[inside] - core.start + inner.start


def _roughness(surface: np.ndarray, has_ground: np.ndarray) -> np.ndarray:
    """Return the mean distance of the ground near each cell, and a little round it, from a smoothed
    surface.
    """
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
