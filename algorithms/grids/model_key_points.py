"""Model key points: the few ground points whose TIN is as good as that of all of them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Iterator

import numpy as np

from ..core.parameters import ParameterSet, parameter
from ..core.points import Points
from ..core.progress import SILENT, Progress
from ..core.threads import in_threads, over_parts
from .cells import Cells, first_of_each
from .growing_tin import GrowingTin
from .tin import hull_corners, lowest_of_duplicates

# Metres by which a point may lie beyond the tolerance, or in another cell: rounding.
_ROUNDING = 1e-6
# First one point of each cell of the first of these sizes in metres is looked at, then one of each
# of the second, then every point.
_LEVELS = (4.0, 1.0)
_MOST_CELLS = 1e8
# Distances to the centre of a cell are told apart to this share of its squared side.
_DECIMALS = 6
# Factors that mix the bits of numbers.
_MIX = np.array([0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F], dtype=np.uint64)
_TURNS = 8
_BITS = 20
_SHIFT = np.uint64(64 - _BITS)
# Reach: cells of the grid, and at least so many metres.
_REACH, _LEAST_REACH = 4.0, 40.0
# Points whose arrays stay in the processor's cache.
_POINTS_A_PART = 1 << 16


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
    order = _lowest_of_places(points)
    points = _near_origin(points.take(order), parameters.grid_size, anchor)
    hull = _hull_corners(points)
    if len(hull) < 3:
        # Points on one line: no TIN can stand for them.
        chosen[order] = True
        return chosen
    cells = Cells.over(points, parameters.grid_size)
    seeds = cells.lowest_points(points)
    progress(0.05)
    border = _outermost(points, cells)
    keys = _Keys(points, np.unique(np.concatenate((seeds, hull, border))), parameters)
    for level in _levels(points, seeds, parameters.grid_size):
        keys.densify(*level)
    chosen[order[keys.are_keys]] = True
    progress(1.0)
    return chosen


def _lowest_of_places(points: Points) -> np.ndarray:
    """Return the indices of the points below which there is no other at the same place."""
    # Numbers that are the same for the same place, and hardly ever for two.
    number = np.empty(points.count, dtype=np.uint64)

    def mix(part: slice) -> None:
        mixed = (points.x[part] + 0.0).view(np.uint64) * _MIX[0]
        mixed ^= mixed >> np.uint64(31)
        mixed += (points.y[part] + 0.0).view(np.uint64)
        number[part] = mixed * _MIX[1]

    over_parts(mix, points.count, _POINTS_A_PART, SILENT)
    ordered = np.sort(number)
    ordered = ordered[1:][ordered[1:] == ordered[:-1]]
    is_several = np.zeros(1 << _BITS, dtype=bool)
    is_several[ordered >> _SHIFT] = True
    some = np.flatnonzero(is_several[number >> _SHIFT])
    kept = np.ones(points.count, dtype=bool)
    kept[some] = False
    kept[some[lowest_of_duplicates(*points.take(some))]] = True
    return np.flatnonzero(kept)


def _hull_corners(points: Points) -> np.ndarray:
    """Return which points are the corners of the convex hull, or the two ends of a line."""
    directions = [(np.cos(turn), np.sin(turn)) for turn in np.arange(_TURNS) * np.pi / _TURNS]

    def ends(direction: tuple[float, float]) -> list[int]:
        along = points.x * direction[0]
        along += points.y * direction[1]
        return [along.argmin(), along.argmax()]

    corners = np.unique(in_threads(ends, directions))
    corners = corners[hull_corners(points.x[corners], points.y[corners])]
    is_outer = np.ones(points.count, dtype=bool)
    if len(corners) > 2:
        x, y = points.x[corners], points.y[corners]
        edges = list(zip(x, y, np.roll(x, -1) - x, np.roll(y, -1) - y))

        def look(part: slice) -> None:
            outer = is_outer[part]
            outer[:] = False
            for at_x, at_y, to_x, to_y in edges:
                outer |= (points.y[part] - at_y) * to_x - (points.x[part] - at_x) * to_y <= 0.0

        over_parts(look, points.count, _POINTS_A_PART, SILENT)
    outer = np.flatnonzero(is_outer)
    return outer[hull_corners(points.x[outer], points.y[outer])]


def _outermost(points: Points, cells: Cells) -> np.ndarray:
    """Return of each cell beside an empty one the point that is the nearest to that."""
    occupied = np.pad(cells.occupied, 1)
    found = []
    for axis, values in ((1, points.x), (0, points.y)):
        for sign in (1, -1):
            beside = np.roll(occupied, sign, axis)[1:-1, 1:-1]
            some = np.flatnonzero(~beside.ravel()[cells.index])
            other = points[axis]
            found.append(some[first_of_each(cells.index[some], beside.size, sign * values[some], other[some])])
    return np.concatenate(found)


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
    spread = float(np.ptp(points.x)) * float(np.ptp(points.y))
    for size in _LEVELS:
        if size < grid_size and spread < _MOST_CELLS * size**2:
            finer = Cells.over(points, size)
            centred = _most_central(points, finer)
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
    index, count = cells.index, cells.rows * cells.columns
    if count > points.count:
        # Mostly empty: only those with points get a number.
        occupied, index = np.unique(index, return_inverse=True)
        count = len(occupied)
    return first_of_each(index, count, distance, points.z, points.x, points.y)


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
            if not len(violating) and len(pending) == points.count:
                violating = self._ambiguous(pending)
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

    def _ambiguous(self, pending: np.ndarray) -> np.ndarray:
        """Return which points lie beyond the tolerance of a TIN that is as good."""
        edges = self._tin.ambiguous_edges()
        some = pending[edges.reshape(-1, 3).any(axis=1)[self._triangle[pending]]]
        for k in range(3):
            beside = some[edges[3 * self._triangle[some] + k]]
            at = self._points.x[beside], self._points.y[beside]
            height = self._tin.flipped_heights(*at, 3 * self._triangle[beside] + k)
            beyond = self._over(self._points.z[beside] - height)
            self._beyond[beside] = np.maximum(self._beyond[beside], beyond)
        return some[self._beyond[some] > _ROUNDING]

    def _over(self, above: np.ndarray) -> np.ndarray:
        """Return how far beyond the tolerance points are that lie above the TIN."""
        lowest, highest = self._parameters.tolerance_below, self._parameters.tolerance_above
        return np.maximum(above - highest, -above - lowest)

    def _look_at(self, which: np.ndarray) -> None:
        """Find triangle and distance beyond the tolerance of points."""

        while len(which):
            self._walk(which)
            which = which[np.isnan(self._beyond[which])]

    def _walk(self, which):
        def look(part: slice) -> None:
            some = which[part]
            triangle = self._triangle[some]
            height = self._tin.heights(self._points.x[some], self._points.y[some], triangle)
            self._triangle[some] = triangle
            self._beyond[some] = self._over(self._points.z[some] - height)

        over_parts(look, len(which), _POINTS_A_PART, SILENT)
DEBUG=False
