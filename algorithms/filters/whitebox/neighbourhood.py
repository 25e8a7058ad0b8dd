"""The neighbours of every point in the plane, with a least number of them for each."""

from __future__ import annotations

import math
from typing import Iterator

import numpy as np

from ...core.points import Points
from ...core.progress import SILENT, Progress
from ...core.threads import over_parts, parts_of
from ...grids.cells import Cells, lower_at
from .sorted_points import SortedPoints

# Points that are computed at a time, so few that their arrays fit into the processor's cache.
_POINTS_A_STEP = 50_000
_PAIRS_A_STEP = 2_000_000
_GROWN_A_STEP = 20_000
# Most cells in which points are counted: so many for each point, or so many in all if that is more.
_CELLS_A_POINT, _MOST_CELLS = 4, 1_000_000
# Share by which a radius is widened, so that rounding never skips a point. Points are compared
# without it.
_ROUNDING = 1e-6


class Neighbourhood:
    """The points within a radius of each point, or its nearest points if those are too few.

    Parameters
    ----------
    points : Points
        Only x and y count.
    radius : float
        Radius in metres, greater than 0; points at exactly this distance are neighbours.
    at_least : int
        If a point has fewer other points within the radius, the radius of this point grows until it
        has so many.
    """

    def __init__(self, points: Points, radius: float, at_least: int) -> None:
        self._points, self._radius = points, radius
        self._grown, self._grown_radius = self._find_grown(min(at_least, points.count - 1))

    @property
    def same_radius(self) -> bool:
        """Whether the radius is the same for all points: none had too few neighbours."""
        return not len(self._grown)

    def minimum(self, values: np.ndarray, progress: Progress = SILENT) -> np.ndarray:
        """Return the lowest value among each point and its neighbours.

        Parameters
        ----------
        values : numpy.ndarray of float, shape (n,)
            One for each point.
        progress : Progress
            Receives progress.

        Returns
        -------
        numpy.ndarray of float, shape (n,)
        """
        points = SortedPoints(self._points._replace(z=values), self._radius)
        best, every = points.z.copy(), np.arange(len(values))
        if points.inner >= 0.0:
            np.minimum(best, points.lowest_within(points.table).take(points.cell), out=best)

        def fill(part: slice) -> None:
            points.lower(points.table, every[part], best[part], points.rim)

        over_parts(fill, len(best), _POINTS_A_STEP, progress)
        result = points.as_given(best)
        for point, neighbour, _ in self.grown_pairs():
            lower_at(result, point, values[neighbour])
        return result

    def maximum(self, values: np.ndarray, progress: Progress = SILENT) -> np.ndarray:
        """Return the highest value among each point and its neighbours; see `minimum`."""
        return -self.minimum(-values, progress)

    def grown_pairs(self) -> Iterator[tuple[np.ndarray, np.ndarray, np.ndarray]]:
        """Yield the points whose radius grew, their neighbours, and the distances between, (k,)."""
        for part in parts_of(len(self._grown), _GROWN_A_STEP):
            point, radius = self._grown[part], self._grown_radius[part]
            places = np.column_stack(self._points.take(point)[:2])
            neighbours = self._tree.query_ball_point(places, radius * (1.0 + _ROUNDING))
            count = np.fromiter(map(len, neighbours), dtype=np.intp, count=len(point))
            neighbour = np.concatenate([np.asarray(each, dtype=np.intp) for each in neighbours])
            point, radius = np.repeat(point, count), np.repeat(radius, count)
            distance = self._distance(point, neighbour)
            near = distance <= radius
            yield point[near], neighbour[near], distance[near]

    def _find_grown(self, at_least: int) -> tuple[np.ndarray, np.ndarray]:
        """Return the points with too few neighbours, and the radius of each that has enough."""
        nothing = np.empty(0, dtype=np.intp), np.empty(0)
        if at_least < 1:
            return nothing
        # Imported here, because this takes longer than to classify a million points.
        from scipy.spatial import cKDTree

        points, doubtful = self._points, np.arange(self._points.count)
        # Points of one such cell are within the radius of each other.
        side = self._radius * (1.0 - _ROUNDING) / math.sqrt(2.0)
        most = max(_CELLS_A_POINT * points.count, _MOST_CELLS)
        if math.prod(points.sides) < most * side**2:
            cells = Cells.over(points, side)
            doubtful = np.flatnonzero(cells.counts().ravel()[cells.index] <= at_least)
        if not len(doubtful):
            return nothing
        self._tree = cKDTree(np.column_stack(self._points[:2]))
        radius = np.empty(len(doubtful))
        for part in parts_of(len(doubtful), max(_PAIRS_A_STEP // (at_least + 1), 1)):
            point = doubtful[part]
            _, nearest = self._tree.query(
                np.column_stack(self._points.take(point)[:2]), at_least + 1
            )
            distance = self._distance(np.repeat(point, at_least + 1), nearest.ravel())
            radius[part] = distance.reshape(nearest.shape).max(axis=1)
        grown = radius > self._radius
        return doubtful[grown], radius[grown]

    def _distance(self, point: np.ndarray, other: np.ndarray) -> np.ndarray:
        x, y = (each[point] - each[other] for each in self._points[:2])
        return np.sqrt(x * x + y * y)
