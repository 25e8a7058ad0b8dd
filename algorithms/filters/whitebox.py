"""The rule of LidarGroundPointFilter of WhiteboxTools, which compares points with their neighbours.

Neighbours are found by cells that hold about one point each. Of cells that lie wholly within the
radius, an erosion of their lowest heights is enough. The points of cells that lie partly within it
are compared, from the lowest upwards, only as long as they can change the result.
"""

from __future__ import annotations

import math
import threading
from dataclasses import dataclass
from typing import Callable, ClassVar, Iterator, NamedTuple

import numpy as np

from ..core.points import Points
from ..core.progress import SILENT, Progress
from ..core.threads import in_threads, parts_of
from ..grids.cells import Cells, lower_at
from ..grids.morphology import erosion
from .pipeline import PointRule, Stage
from .state import State

_POINTS_A_STRIP = 150_000  # points of a strip, whose arrays fit into the processor's cache
# Least width of a strip in radii, because the points within a radius of it are read as well.
_LEAST_WIDTH = 8.0
_MOST_CELLS_A_RADIUS = 48  # most cells along a radius
# Most cells for each point, and the number of cells that is allowed for few points.
_MOST_CELLS_A_POINT = 4
_ALWAYS_ALLOWED = 1_000_000
# Bounds are wider by this, in cells, metres or radii, so that rounding loses no neighbour. Points
# are compared without it.
_ROUNDING = 1e-5
_PAIRS_A_STEP = 2_000_000  # pairs of points and their nearest ones that are searched at a time
_GROWN_A_STEP = 20_000  # points with a grown radius that are compared at a time


@dataclass(frozen=True)
class StandsAbove(PointRule):
    """A point is ground unless it stands above a neighbour by a least height and slope."""

    stage: ClassVar = Stage.ACCEPTED
    writes: ClassVar = ("ground",)

    radius: float  # search radius in metres
    slope: float  # slope threshold in degrees
    height: float  # height threshold in metres
    # Whether heights above a surface that follows the terrain are compared (white top-hat).
    top_hat: bool = True
    # Least number of neighbours: the radius of a point with fewer grows until it has this number.
    min_neighbours: int = 0

    def apply(self, state: State) -> None:
        """Accept the points that do not stand above a neighbour."""
        slope = math.tan(math.radians(self.slope))
        rule = Neighbours(self.radius, self.height, slope, self.top_hat)
        above = stands_above(state.points, rule, self.min_neighbours, state.progress)
        state.ground = ~above


class Neighbours(NamedTuple):
    """What neighbours are, and when a point stands far above one of them."""

    radius: float  # largest distance of a neighbour in metres
    height: float  # least difference in height in metres
    slope: float  # rise over run that must be exceeded, by the same neighbour
    # Whether heights above the opening are compared (white top-hat). The erosion at a point is the
    # lowest height among its neighbours, the opening the highest erosion among them.
    top_hat: bool

    def is_broken(self, rise: np.ndarray, distance: np.ndarray | float) -> np.ndarray:
        """Return which rises in metres (k,) are too high for their distance in metres (k,)."""
        return (rise >= self.height) & (rise > self.slope * distance)


def stands_above(
    points: Points, rule: Neighbours, at_least: int = 0, progress: Progress = SILENT
) -> np.ndarray:
    """Return which points (n,) stand far above a neighbour; those with fewer than `at_least`
    neighbours are compared with the nearest points, and with others that are as near.
    """
    neighbourhood, heights = _Neighbourhood(points, rule.radius, at_least), points.z
    if rule.top_hat:
        eroded = neighbourhood.lowest(heights, 1.0, progress.part(0.0, 0.4))
        opened = neighbourhood.lowest(eroded, -1.0, progress.part(0.4, 0.8))
        del eroded
        # In neighbourhoods that grew, a point need not be a neighbour of its neighbours, so the
        # opening can be higher than the point.
        heights = np.subtract(heights, np.minimum(opened, heights, out=opened), out=opened)
    return neighbourhood.rises(heights, rule, progress.part(0.8, 1.0))


class _Neighbourhood:
    """The points within a radius of each point, or its nearest points if there are too few."""

    # The radius of a point with fewer than `at_least` other points within it grows until it has so
    # many. Points are worked on in strips, from south to north, to limit the memory.

    def __init__(self, points: Points, radius: float, at_least: int) -> None:
        self._points, self._radius = points, radius
        order = np.argsort(points.y)
        y, self._northwards = points.y[order], order.astype(np.int32)
        share = _LEAST_WIDTH * radius / max(y[-1] - y[0], radius)
        most, reach = math.ceil(max(_POINTS_A_STRIP, share * len(y))), radius * (1.0 + _ROUNDING)
        self._strips = [
            (part, slice(*np.searchsorted(y, (y[part][0] - reach, y[part][-1] + reach)).tolist()))
            for part in parts_of(len(y), most)
        ]
        self._grown, self._grown_radius = self._find_grown(min(at_least, points.count - 1))

    def lowest(self, values: np.ndarray, sign: float, progress: Progress) -> np.ndarray:
        """Return the lowest value of a point and its neighbours; the highest if sign is -1."""
        lowest = np.empty(len(values))
        self._fill(lowest, lambda strip: strip.lowest(), values, sign, progress)
        for point, neighbour, _ in self._grown_pairs():
            lower_at(lowest, point, sign * values[neighbour])
        return np.multiply(lowest, sign, out=lowest)

    def rises(self, heights: np.ndarray, rule: Neighbours, progress: Progress) -> np.ndarray:
        """Return which points, with these heights, rise far above a neighbour."""
        above = np.empty(len(heights), dtype=bool)
        self._fill(above, lambda strip: strip.rises(rule), heights, 1.0, progress)
        for point, neighbour, distance in self._grown_pairs():
            above[point[rule.is_broken(heights[point] - heights[neighbour], distance)]] = True
        return above

    def _fill(
        self,
        result: np.ndarray,
        find: Callable[[_Strip], np.ndarray],
        values: np.ndarray,
        sign: float,
        progress: Progress,
    ) -> None:
        """Fill in the results of points (n,), with the values times a sign as heights."""
        caller = threading.get_ident()

        def call(parts: tuple[slice, slice]) -> None:
            def alive() -> None:
                # Progress is for the calling thread only.
                if threading.get_ident() == caller:
                    progress(parts[0].start / len(values))

            asked, near = (self._northwards[part] for part in parts)
            points = Points(self._points.x[near], self._points.y[near], sign * values[near])
            strip = _Strip(points, self._radius, parts[0].start - parts[1].start, len(asked), alive)
            result[asked[strip.asked]] = find(strip)

        in_threads(call, self._strips, progress)

    def _find_grown(self, at_least: int) -> tuple[np.ndarray, np.ndarray]:
        """Return the points with too few neighbours, and the radius of each that has enough."""
        if at_least < 1:
            return np.empty(0, dtype=np.intp), np.empty(0)
        # Imported only here, because that takes longer than to classify a million points.
        from scipy.spatial import cKDTree

        points, doubtful = self._points, np.arange(self._points.count)
        # All points of a cell with this side are within the radius of each other.
        side = self._radius * (1.0 - _ROUNDING) / math.sqrt(2.0)
        if math.prod(points.sides) < _most_cells(points) * side**2:
            cells = Cells.over(points, side)
            doubtful = np.flatnonzero(cells.counts.ravel()[cells.index] <= at_least)
        radius = np.empty(len(doubtful))
        if len(doubtful):
            self._tree = cKDTree(np.column_stack(points[:2]))
        for part in parts_of(len(doubtful), max(_PAIRS_A_STEP // (at_least + 1), 1)):
            point = doubtful[part]
            places = np.column_stack(points.take(point)[:2])
            nearest = self._tree.query(places, at_least + 1)[1]
            distance = _distance(points, np.repeat(point, at_least + 1), nearest.ravel())
            radius[part] = distance.reshape(nearest.shape).max(axis=1)
        grown = radius > self._radius
        return doubtful[grown], radius[grown]

    def _grown_pairs(self) -> Iterator[tuple[np.ndarray, np.ndarray, np.ndarray]]:
        """Yield points whose radius grew, their neighbours, and the distances of these, (k,)."""
        for part in parts_of(len(self._grown), _GROWN_A_STEP):
            point, radius = self._grown[part], self._grown_radius[part]
            places = np.column_stack(self._points.take(point)[:2])
            neighbours = self._tree.query_ball_point(places, radius * (1.0 + _ROUNDING))
            count = np.fromiter(map(len, neighbours), dtype=np.intp, count=len(point))
            neighbour = np.concatenate([np.asarray(found, dtype=np.intp) for found in neighbours])
            point, radius = np.repeat(point, count), np.repeat(radius, count)
            distance = _distance(self._points, point, neighbour)
            near = distance <= radius
            yield point[near], neighbour[near], distance[near]


class _Strip:
    """Points in the order of their cells and, within a cell, of their heights."""

    # Results are wanted for `count` points from `first` on. `asked` (count,) is the number, from
    # `first`, of the point of each result. `alive` is called several times a second.

    def __init__(
        self, points: Points, radius: float, first: int, count: int, alive: Callable[[], None]
    ) -> None:
        size = _cell_size(points, radius)
        cells, reach = Cells.over(points, size), math.ceil(radius / size + _ROUNDING)
        # The grid has a margin, so that each offset leads to a cell of it.
        shape = cells.rows + 2 * reach, cells.columns + 2 * reach
        cell = cells.index + reach * (1 + shape[1] + 2 * (cells.index // cells.columns))
        order = np.lexsort((points.z, cell))
        self._own = np.flatnonzero((order >= first) & (order < first + count))
        self.asked = order[self._own] - first
        self._points, self._radius, self._alive = points.take(order), radius, alive
        self._cell = cell[order[self._own]]
        self._start = np.zeros(math.prod(shape) + 1, dtype=np.int64)
        np.cumsum(np.bincount(cell, minlength=math.prod(shape)), out=self._start[1:])
        self._heights = np.append(self._points.z, np.inf)
        is_empty = self._start[:-1] == self._start[1:]
        self._lowest = np.where(is_empty, np.inf, self._heights[self._start[:-1]])
        side = np.arange(-reach, reach + 1)
        row, column = np.repeat(side, len(side)), np.tile(side, len(side))
        gap = size * np.hypot(np.maximum(np.abs(row) - 1, 0), np.maximum(np.abs(column) - 1, 0))
        touched = np.argsort(gap, kind="stable")[: np.count_nonzero(gap <= radius + _ROUNDING)]
        self._gaps, self._offsets = gap[touched], (row * shape[1] + column)[touched]
        # The lowest height in the cells that lie wholly within the radius, and in every cell that
        # it touches.
        grid, inner = self._lowest.reshape(shape), radius / size - math.sqrt(2.0) - _ROUNDING
        self._is_inner = np.hypot(row, column)[touched] <= inner
        self._inner = self._points.z[self._own]
        if inner >= 0.0:
            np.minimum(self._inner, erosion(grid, inner).take(self._cell), out=self._inner)
        outer = erosion(grid, radius / size + math.sqrt(2.0) + _ROUNDING)
        self._outer = outer.take(self._cell)

    def lowest(self) -> np.ndarray:
        """Return the lowest height among each point asked for and its neighbours."""
        unsure = np.flatnonzero(self._inner > self._outer)
        limit, rim = self._inner[unsure], self._offsets[~self._is_inner]
        for found, neighbour, _ in self._below(unsure, limit, rim, np.zeros(len(rim))):
            limit[found] = self._heights[neighbour]
        lowest = self._inner.copy()
        lowest[unsure] = limit
        return lowest

    def rises(self, rule: Neighbours) -> np.ndarray:
        """Return which points asked for rise far above a neighbour."""
        own = self._points.z[self._own]
        above = rule.is_broken(own - self._inner, self._radius)
        unsure = np.flatnonzero(rule.is_broken(own - self._outer, 0.0) & ~above)
        own = own[unsure]
        limit = own - rule.height + _ROUNDING
        fall = np.maximum(rule.slope * self._gaps - rule.height, 0.0)
        for found, neighbour, distance in self._below(unsure, limit, self._offsets, fall):
            is_above = rule.is_broken(own[found] - self._heights[neighbour], distance)
            limit[found[is_above]] = -np.inf
        above[unsure] = limit == -np.inf
        return above

    def _below(
        self, asked: np.ndarray, limit: np.ndarray, offsets: np.ndarray, fall: np.ndarray
    ) -> Iterator[tuple[np.ndarray, np.ndarray, np.ndarray]]:
        """Yield which of the `asked` points (k,) have a neighbour below their `limit` (k,), this
        neighbour, and its distance.
        """
        # The caller lowers the limits meanwhile. A cell is searched if its lowest point lies below
        # the limit by more than the `fall` of its offset.
        cell, point = self._cell[asked], self._own[asked]
        for offset, least in zip(offsets, fall):
            self._alive()
            near = cell + offset
            found = np.flatnonzero(self._lowest.take(near) < limit - least)
            neighbour, end = self._start[near[found]], self._start[near[found] + 1]
            while len(found):
                distance = _distance(self._points, point[found], neighbour)
                close = distance <= self._radius
                yield found[close], neighbour[close], distance[close]
                neighbour += 1
                is_below = self._heights[neighbour] < limit[found]
                left = np.flatnonzero(is_below & (neighbour < end))
                found, neighbour, end = found[left], neighbour[left], end[left]


def _cell_size(points: Points, radius: float) -> float:
    """Return the side of cells that hold about one point each, if they are not too many."""
    coarse = Cells.over(points, max(radius, 1.0))
    apart = math.sqrt(np.count_nonzero(coarse.occupied) / points.count) * coarse.size
    least = math.sqrt(coarse.rows * coarse.columns / _most_cells(points)) * coarse.size
    return max(min(apart, radius), radius / _MOST_CELLS_A_RADIUS, least)


def _most_cells(points: Points) -> int:
    return max(_MOST_CELLS_A_POINT * points.count, _ALWAYS_ALLOWED)


def _distance(points: Points, first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Return the horizontal distances in metres between pairs of points, given by indices (k,)."""
    x, y = points.x[first] - points.x[second], points.y[first] - points.y[second]
    return np.sqrt(x * x + y * y)
