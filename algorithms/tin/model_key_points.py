"""Model key points: few ground points whose TIN is as good as the TIN of all ground points."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from ..core.parameters import ParameterSet, parameter
from ..core.points import Points
from ..core.progress import SILENT, Progress
from ..core.threads import in_threads, over_parts, parts_of
from ..grids.cells import Cells, first_of_each
from .growing_tin import GrowingTin
from .triangulation import hull_corners, lowest_of_duplicates

_ROUNDING = 1e-6  # rounding error in metres, at the tolerance and at the borders of cells
# First one point of each cell is tested, in wide and then in narrow cells: approximate sides of
# these cells in metres, and the largest number of cells for which this is done.
_LEVELS = (4.0, 1.0)
_MOST_CELLS = 1e8
# Squared distances to the centre of a cell are rounded to this share of its squared side.
_CENTRAL = 1e-6
# Distance beyond which points have no effect, in cells of the grid, and its least value in metres.
_REACH = 4.0
_LEAST_REACH = 40.0
# Factors of a hash of x and y, and the number of its bits that are used.
_MIX = np.array([0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F], dtype=np.uint64)
_BITS = 20
_MOST_SMALL = 1 << 16  # NumPy sorts integers of 16 bits fastest
_POINTS_A_PART = 1 << 16  # points of a part, whose arrays stay in the processor's cache
# Most calls of the walk through the TIN. Far fewer are enough, unless rounding makes it endless.
_MOST_WALKS = 1000


@dataclass(frozen=True)
class ModelKeyPoints(ParameterSet):
    """How closely the TIN of the key points follows the ground points."""

    tolerance_above: float = parameter(
        0.15,
        label="Tolerance above",
        unit="m",
        minimum=0.0,
        maximum=100.0,
        help="How far a ground point may lie above the TIN of the key points. Choose about the"
        " accuracy of the heights, or half the contour interval that you want.",
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
        help="In each cell of this size that has ground points, at least the lowest one is a key"
        " point, however flat the ground is.",
    )


def reach(parameters: ModelKeyPoints) -> float:
    """Return the distance in metres within which a ground point affects the choice."""
    # Measured: with a buffer of this width, a part of a survey gets the same key points as in the
    # whole survey, except for about one of a thousand at the border of the survey and beside wide
    # gaps.
    return max(_REACH * parameters.grid_size, _LEAST_REACH)


def model_key_points(
    points: Points,
    parameters: ModelKeyPoints = ModelKeyPoints(),
    progress: Progress = SILENT,
    anchor: tuple[float, float] = (0.0, 0.0),
) -> np.ndarray:
    """Return which ground points are key points, bool (n,), whatever the order of the points; cells
    of the grid have a corner at `anchor` (metres), which is the same for all parts of a survey.
    """
    # The first key points are the lowest point of each cell of a grid, the outermost point of each
    # cell beside an empty one, and the corners of the convex hull. In rounds, every triangle of
    # their TIN takes the point that lies farthest beyond the tolerance. The first rounds test few
    # points, the last ones all. In the end all ground points lie within the tolerance of the TIN.
    # Of several points at one place, only the lowest is used.
    # If four key points lie on one circle, this is true for either diagonal. If more than four do,
    # as on a regular lattice, a few of ten thousand ground points may lie some centimetres beyond.
    chosen = np.zeros(points.count, dtype=bool)
    if not points.count:
        return chosen
    points, cells, order = _sorted(points, parameters.grid_size, anchor, progress.part(0.0, 0.2))
    hull = _hull_corners(points, cells)
    if len(hull) < 3:
        # Points on one line have no TIN.
        chosen[order] = True
        return chosen
    lowest = cells.lowest_points(points)
    seeds = np.unique(np.concatenate((lowest, hull, _outermost(points, cells))))
    near = _of_cells(cells, lowest)[cells.index]
    keys = _Keys(points, seeds, parameters)
    progress(0.22)
    levels = _levels(points, parameters.grid_size)
    progress(0.25)
    for number, (tested, cells) in enumerate(levels):
        start = 0.25 + 0.1 * number
        keys.densify(tested, near[tested], progress.part(start, start + 0.1))
        near = _of_cells(cells, tested)[cells.index]
    everyone = np.arange(points.count, dtype=np.int32)
    keys.densify(everyone, near, progress.part(0.45, 1.0), is_last=True)
    chosen[order[keys.are_keys]] = True
    progress(1.0)
    return chosen


def _sorted(
    points: Points, grid_size: float, anchor: tuple[float, float], progress: Progress
) -> tuple[Points, Cells, np.ndarray]:
    """Return the lowest points of all places, sorted by cell and relative to a corner of cells, the
    cells, and the indices of these points.
    """
    kept = _lowest_of_places(points)
    progress(0.4)
    x, y = (
        values
        - (corner + grid_size * np.floor(((values.min() + values.max()) / 2 - corner) / grid_size))
        for values, corner in zip(points, anchor)
    )
    # A coordinate on the border of a cell must not be rounded to the wrong side.
    points = Points(x + _ROUNDING, y + _ROUNDING, points.z)
    cells = Cells.over(points, grid_size)
    progress(0.6)
    index = cells.index[kept]
    order = np.argsort((index // (index.max() // _MOST_SMALL + 1)).astype(np.uint16), kind="stable")
    progress(0.8)
    kept, index = kept[order], index[order]
    return points.take(kept), replace(cells, index=index), kept


def _lowest_of_places(points: Points) -> np.ndarray:
    """Return the indices of the lowest point at each place, ascending."""
    # A hash is equal for points at one place, and hardly ever for others.
    number = np.empty(points.count, dtype=np.uint64)
    shift = np.uint64(64 - _BITS)

    def mix(part: slice) -> None:
        mixed = (points.x[part] + 0.0).view(np.uint64) * _MIX[0]
        mixed ^= mixed >> np.uint64(31)
        mixed += (points.y[part] + 0.0).view(np.uint64)
        number[part] = mixed * _MIX[1]

    over_parts(mix, points.count, _POINTS_A_PART, SILENT)
    ordered = np.sort(number)
    is_several = np.zeros(1 << _BITS, dtype=bool)
    is_several[ordered[1:][ordered[1:] == ordered[:-1]] >> shift] = True
    del ordered
    several = np.flatnonzero(is_several[number >> shift])
    kept = np.ones(points.count, dtype=bool)
    kept[several] = False
    kept[several[lowest_of_duplicates(*points.take(several))]] = True
    return np.flatnonzero(kept)


def _hull_corners(points: Points, cells: Cells) -> np.ndarray:
    """Return the indices of the corners of the convex hull, or of the two ends of a line."""
    from scipy import ndimage

    # A point is no corner if all eight cells round its own hold points.
    inner = ndimage.binary_erosion(cells.occupied, np.ones((3, 3)))
    outer = np.flatnonzero(~inner.ravel()[cells.index])
    return outer[hull_corners(points.x[outer], points.y[outer])]


def _outermost(points: Points, cells: Cells) -> np.ndarray:
    """Return the point nearest to the empty cell, for each cell beside an empty one."""
    # Without these points, triangles along a border reach from one corner of the hull to the next.
    occupied, found = np.pad(cells.occupied, 1), []
    for axis, along, across in ((1, points.x, points.y), (0, points.y, points.x)):
        for step in (1, -1):
            beside = np.roll(occupied, step, axis)[1:-1, 1:-1].ravel()
            bordering = np.flatnonzero(~beside[cells.index])
            keys = step * along[bordering], across[bordering]
            found.append(bordering[first_of_each(cells.index[bordering], beside.size, *keys)])
    return np.concatenate(found)


def _levels(points: Points, grid_size: float) -> list[tuple[np.ndarray, Cells]]:
    """Return the points to test at each level, from wide to narrow cells, and these cells."""
    levels: list[tuple[np.ndarray, Cells]] = []
    spread = math.prod(points.sides)
    tested, left = np.arange(points.count, dtype=np.int32), points
    for about in _LEVELS[::-1]:
        # Each cell of the grid is cut into whole cells.
        size = grid_size / max(round(grid_size / about), 1)
        if size < grid_size and spread < _MOST_CELLS * size**2:
            cells = Cells.over(points, size)
            tested = tested[_most_central(left, size, cells.index[tested])]
            left = points.take(tested)
            levels.insert(0, (tested, cells))
    return levels


def _most_central(points: Points, size: float, index: np.ndarray) -> np.ndarray:
    """Return the index of the point nearest to the centre of each cell."""
    distance = np.empty(points.count)

    def measure(part: slice) -> None:
        x, y = (values[part] / size for values in points[:2])
        x -= np.floor(x) + 0.5
        y -= np.floor(y) + 0.5
        distance[part] = np.rint((x * x + y * y) / _CENTRAL)

    over_parts(measure, points.count, _POINTS_A_PART, SILENT)
    if index.max() >= points.count:
        # Most cells are empty: only cells with points are numbered.
        index = np.unique(index, return_inverse=True)[1]
    return first_of_each(index, int(index.max()) + 1, distance, points.z, points.x, points.y)


def _of_cells(cells: Cells, points: np.ndarray) -> np.ndarray:
    """Return the index of the point in each cell, given at most one point of each."""
    found = np.zeros(cells.rows * cells.columns, dtype=np.int32)
    found[cells.index[points]] = points
    return found


class _Keys:
    """The points chosen so far (`are_keys`, a mask), and their TIN."""

    # No two points may be at the same place. The seeds must include the corners of the convex hull.

    def __init__(self, points: Points, seeds: np.ndarray, parameters: ModelKeyPoints) -> None:
        self._points, self._parameters = points, parameters
        self._tin = GrowingTin(points.take(seeds))
        self.are_keys = np.zeros(points.count, dtype=bool)
        self.are_keys[seeds] = True
        # The triangle of each point that has been tested.
        self._triangle = np.zeros(points.count, dtype=np.int32)
        self._triangle[seeds] = self._tin.triangles_of_vertices()
        self._beyond = np.zeros(points.count, dtype=np.float32)

    def densify(
        self, pending: np.ndarray, near: np.ndarray, progress: Progress, is_last: bool = False
    ) -> None:
        """Choose points until none of the pending ones (k,) lies beyond the tolerance; `near` (k,)
        are points near these that were tested before.
        """
        points, triangle, beyond = self._points, self._triangle, self._beyond
        triangle[pending] = triangle[near]
        look, waiting = pending, pending[:0]
        for number in itertools.count():
            self._look_at(look, progress.part(1.0 - 0.5**number, 1.0 - 0.5 ** (number + 1)))
            violating = np.concatenate((waiting, self._violating(look)))
            if is_last and not len(violating):
                violating = self._violating(self._ambiguous(pending))
            if not len(violating):
                return
            keys = -beyond[violating], points.x[violating], points.y[violating]
            worst = violating[first_of_each(triangle[violating], self._tin.count, *keys)]
            added, changed = self._tin.add(points.take(worst), triangle[worst], beyond[worst])
            self.are_keys[worst[added]] = True
            waiting = violating[~changed[triangle[violating]]]
            look = self._within(changed, pending)

    def _look_at(self, tested: np.ndarray, progress: Progress) -> None:
        """Find the triangle of each point, and how far the point lies beyond the tolerance."""
        for _ in range(_MOST_WALKS):
            over_parts(partial(self._walk, tested), len(tested), _POINTS_A_PART, progress)
            tested, progress = tested[np.isnan(self._beyond[tested])], SILENT
            if not len(tested):
                return

    def _walk(self, tested: np.ndarray, part: slice) -> None:
        walking = tested[part]
        x, y, z = (axis.take(walking) for axis in self._points)
        triangle = self._triangle.take(walking)
        self._beyond[walking] = self._over(z - self._tin.heights(x, y, triangle))
        self._triangle[walking] = triangle

    def _over(self, above: np.ndarray) -> np.ndarray:
        """Return how far points lie beyond the tolerance, from their heights above the TIN."""
        parameters = self._parameters
        return np.maximum(above - parameters.tolerance_above, -above - parameters.tolerance_below)

    def _violating(self, tested: np.ndarray) -> np.ndarray:
        """Return which of some points lie beyond the tolerance."""
        # Rounding may put a vertex into a triangle without area.
        return tested[(self._beyond[tested] > _ROUNDING) & ~self.are_keys[tested]]

    def _within(self, triangles: np.ndarray, pending: np.ndarray) -> np.ndarray:
        """Return the pending points that lie in the triangles of a mask (t,)."""

        def within(part: slice) -> np.ndarray:
            points = pending[part]
            return points[triangles.take(self._triangle.take(points))]

        return np.concatenate(in_threads(within, parts_of(len(pending), _POINTS_A_PART)))

    def _ambiguous(self, pending: np.ndarray) -> np.ndarray:
        """Return the pending points in triangles with four vertices on one circle, after a test
        against the other diagonal.
        """
        edges = self._tin.ambiguous_edges()
        ambiguous = self._within(edges.reshape(-1, 3).max(axis=1), pending)
        for k in range(3):
            edge = 3 * self._triangle[ambiguous] + k
            beside, edge = ambiguous[edges[edge]], edge[edges[edge]]
            places = self._points.take(beside)
            beyond = self._over(places.z - self._tin.flipped_heights(places.x, places.y, edge))
            self._beyond[beside] = np.maximum(self._beyond[beside], beyond)
        return ambiguous
