"""Model key points: the few ground points whose TIN is as good as that of all of them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Iterator

import numpy as np

from ..core.parameters import ParameterSet, parameter
from ..core.points import Points
from ..core.progress import SILENT, Progress
from ..core.threads import over_parts
from .cells import Cells, first_of_each
from .growing_tin import GrowingTin
from .tin import hull_corners, lowest_of_duplicates

# Metres by which a point may lie beyond the tolerance, or in another cell: rounding.
_ROUNDING = 1e-6
# First one point of each cell of the first of these shares of the grid size is looked at, then one
# of each of the second and so on, then every point.
_LEVELS = (0.2, 0.05)
# Points a cell below which it is as well to look at all.
_FEW = 4.0
# Distances to the centre of a cell are told apart to this share of its squared side.
_DECIMALS = 6
# Points whose arrays stay in the processor's cache.
_POINTS_A_PART = 1 << 14


@dataclass(frozen=True)
class ModelKeyPoints(ParameterSet):
    """How closely the TIN of the key points follows the ground points."""

    tolerance_above: float = parameter(
        0.15,
        label="Tolerance above",
        unit="m",
        minimum=0.0,
        maximum=100.0,
        help="How far a ground point may lie above the TIN of the key points. About the accuracy of"
        " the heights, or half the interval of the contour lines to be made.",
    )
    tolerance_below: float = parameter(
        0.15,
        label="Tolerance below",
        unit="m",
        minimum=0.0,
        maximum=100.0,
        help="How far a ground point may lie below the TIN of the key points.",
    )
    grid_size: float = parameter(
        20.0,
        label="Grid size",
        unit="m",
        minimum=0.1,
        maximum=10000.0,
        help="Every cell of this size that has ground points keeps at least one, its lowest,"
        " however flat the ground is.",
    )


def model_key_points(
    points: Points,
    parameters: ModelKeyPoints = ModelKeyPoints(),
    progress: Progress = SILENT,
    anchor: tuple[float, float] = (0.0, 0.0),
) -> np.ndarray:
    """Choose the ground points that a terrain model needs.

    It starts with the lowest point of each cell of a grid and the corners of the convex hull. In
    rounds, every triangle of their TIN takes the point that lies farthest beyond the tolerance.
    Then every ground point lies within the tolerance of the TIN of the chosen ones; but of points
    at one place the lowest alone is looked at.

    Parameters
    ----------
    points : Points
        The ground points.
    parameters : ModelKeyPoints
        Tolerances and size of the grid.
    progress : Progress
        Receives progress.
    anchor : tuple of float
        x and y of a corner of cells of the grid in metres.

    Returns
    -------
    numpy.ndarray of bool, shape (n,)
        Which points were chosen; whatever their order, the same.
    """
    chosen = np.zeros(points.count, dtype=bool)
    if not points.count:
        return chosen
    # From here on in an order of their own.
    order = lowest_of_duplicates(*points)
    points = _near_origin(points.take(order), parameters.grid_size, anchor)
    hull = hull_corners(points.x, points.y)
    if len(hull) < 3:
        # Points on one line: no TIN can stand for them.
        chosen[order] = True
        return chosen
    seeds = Cells.over(points, parameters.grid_size).lowest_points(points)
    progress(0.05)
    keys = _Keys(points, np.union1d(seeds, hull), parameters)
    for level in _levels(points, seeds, parameters.grid_size):
        keys.densify(*level)
    chosen[order[keys.are_keys]] = True
    progress(1.0)
    return chosen


def _near_origin(points: Points, grid_size: float, anchor: tuple[float, float]) -> Points:
    """Return points moved by whole cells of the grid."""
    x, y = (
        values - (at + grid_size * np.round((np.median(values) - at) / grid_size)) + _ROUNDING
        for values, at in zip(points, anchor)
    )
    return Points(x, y, points.z)


def _levels(
    points: Points, seeds: np.ndarray, grid_size: float
) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Yield which points to look at, and for each a point near it that has been looked at."""
    known, cells = seeds, Cells.over(points, grid_size)
    for share in _LEVELS:
        finer = Cells.over(points, grid_size * share)
        centred = _most_central(points, finer)
        if points.count < _FEW * len(centred):
            break
        yield centred, _of_cells(cells, known)[cells.index[centred]]
        known, cells = centred, finer
    yield np.arange(points.count), _of_cells(cells, known)[cells.index]


def _of_cells(cells: Cells, points: np.ndarray) -> np.ndarray:
    """Return for each cell the one of some points that lies in it."""
    found = np.zeros(cells.rows * cells.columns, dtype=np.int32)
    found[cells.index[points]] = points
    return found


def _most_central(points: Points, cells: Cells) -> np.ndarray:
    """Return which point of each cell is the nearest to its centre."""
    x, y = ((each / cells.size) % 1.0 - 0.5 for each in points[:2])
    distance = np.round(x * x + y * y, _DECIMALS)
    return first_of_each(
        cells.index, cells.rows * cells.columns, distance, points.z, points.x, points.y
    )


class _Keys:
    """Chosen points and their TIN."""

    def __init__(self, points: Points, seeds: np.ndarray, parameters: ModelKeyPoints) -> None:
        self._points, self._parameters = points, parameters
        self._tin = GrowingTin(points.take(seeds))
        self.are_keys = np.zeros(points.count, dtype=bool)
        self.are_keys[seeds] = True
        # Of each point that has been looked at.
        self._triangle = np.zeros(points.count, dtype=np.int32)
        self._triangle[seeds] = self._tin.triangles_of_vertices()
        self._beyond = np.zeros(points.count, dtype=np.float32)

    def densify(self, pending: np.ndarray, near: np.ndarray) -> None:
        """Choose points until none of the pending lies beyond the tolerance."""
        points, triangle = self._points, self._triangle
        triangle[pending] = triangle[near]
        look = pending
        rounds = 0
        while True:
            self._look_at(look)
            violating = pending[self._beyond[pending] > _ROUNDING]
            rounds += 1
            if DEBUG: print(rounds, len(look), len(violating), self._tin.vertices.count)
            if not len(violating):
                return
            x, y = points.x[violating], points.y[violating]
            worst = violating[
                first_of_each(
                    triangle[violating], self._tin.count, -self._beyond[violating], x, y
                )
            ]
            added, changed = self._tin.add(
                points.take(worst), triangle[worst], self._beyond[worst]
            )
            self.are_keys[worst[added]] = True
            look = pending[changed[triangle[pending]]]

    def _look_at(self, which: np.ndarray) -> None:
        """Find triangle and distance beyond the tolerance of points."""

        def look(part: slice) -> None:
            some = which[part]
            triangle = self._triangle[some]
            height = self._tin.heights(self._points.x[some], self._points.y[some], triangle)
            above = self._points.z[some] - height
            self._triangle[some] = triangle
            self._beyond[some] = np.fmax(
                above - self._parameters.tolerance_above,
                -above - self._parameters.tolerance_below,
            )

        over_parts(look, len(which), _POINTS_A_PART, SILENT)
DEBUG=False
