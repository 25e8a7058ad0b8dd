"""The ground points of a survey of any size, and their TIN at a few thousand places."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Callable, Iterator, NamedTuple

import numpy as np

from ...classes.ground_classes import GroundClasses, GroundCounts
from ...core.errors import BareEarthError
from ...core.points import Frame, Points
from ...core.progress import SILENT, Progress
from ...grids.lines import NearPlaces
from ...las.cloud import PointCloud, survey_frame
from ...las.lasfile import LasFile
from ...survey.files import Sources, Survey, open_survey
from ...survey.shapes import Place
from ...tin.delaunay_walk import (
    NOWHERE,
    circumcircles,
    enclosing_triangles,
    interpolated,
    longest_edge,
    picked,
)
from ...tin.triangulation import Tin

# Points near a place that are kept in each round. Later rounds are only for places that are not
# certain yet; in dense land the first is enough.
_ROUNDS = (64, 1024, 65_536)
# Most points that are kept at a time, at about 60 bytes each.
_MOST_KEPT = 1 << 22
# Ground points that are looked at together.
_TOGETHER = 1 << 21
# Places whose triangles are searched together.
_PLACES = 1 << 11
# Points to which the plane of the terrain is fitted.
_OF_PLANE = 64
# Factor for distances, against rounding.
_INSIDE = 1.0 - 1e-9

# Which of the ground points of a part are used, given their x and y in metres.
Chooser = Callable[[np.ndarray, np.ndarray], np.ndarray]


class TinHeights(NamedTuple):
    """Heights of the TIN of ground points at q places."""

    heights: np.ndarray  # float64, (q,): metres; NaN without a triangle with short edges
    slopes: np.ndarray  # float64, (q,): degrees, of a plane through the nearest points; NaN for few


@dataclass
class SurveyGround:
    """The ground points of the files of a survey, which are read in parts."""

    survey: Survey
    ground: GroundClasses
    counts: GroundCounts = field(default_factory=GroundCounts)  # of the points that were read last

    @classmethod
    def of(
        cls, sources: Sources, ground: GroundClasses, progress: Progress = SILENT
    ) -> SurveyGround:
        """Open the files; all must be readable, since a missing one would look like a void."""
        survey = open_survey(sources, progress)
        if survey.broken:
            raise BareEarthError(survey.broken[0].reason)
        return cls(survey, ground)

    @property
    def frame(self) -> Frame:
        """The frame of all coordinates in metres, with its origin at (0, 0) of the CRS."""
        return survey_frame(self.survey.crs)

    @property
    def place(self) -> Place:
        """Where the points lie."""
        tiles = self.survey.tiles
        name = str(tiles[0].path) if len(tiles) == 1 else "the files"
        return Place(name, self.survey.crs, self.survey.box)

    def parts(
        self, progress: Progress, near: np.ndarray | None = None, reach: float = 0.0
    ) -> Iterator[tuple[PointCloud, np.ndarray]]:
        """Yield the points of the files in parts, and which of them are ground; only of files near
        places, shape (q, 2), up to `reach`, in metres, if these are given.
        """
        self.counts = GroundCounts()
        survey = self.survey
        if near is not None and len(survey.tiles) > 1:
            tiles = (tile for tile in survey.tiles if self._is_near(tile, near, reach))
            survey = replace(survey, tiles=tuple(tiles))
        for cloud in survey.parts(progress):
            yield cloud, self.ground.of(cloud, self.counts)

    def check(self) -> None:
        """Refuse a survey without ground, after all of its parts were read."""
        has = "has" if len(self.survey.tiles) == 1 else "have"
        self.ground.check(self.counts, self.place.name, has)

    def _is_near(self, tile: LasFile, places: np.ndarray, reach: float) -> bool:
        west, south, east, north = np.multiply(tile.outer_box, self.frame.horizontal_unit).tolist()
        x, y = places.T
        inside = (x >= west - reach) & (x <= east + reach)
        return bool((inside & (y >= south - reach) & (y <= north + reach)).any())

    def heights(
        self,
        places: np.ndarray,
        max_edge: float,
        progress: Progress = SILENT,
        chooser: Chooser | None = None,
    ) -> TinHeights:
        """Return the heights of the TIN of all, or of the chosen, ground points at places in
        metres, shape (q, 2), without triangles with edges over `max_edge`.
        """
        # The corners of a triangle with edges up to `max_edge` lie that near its places. Of the
        # points that near, only the nearest are kept: enough if the circumcircle of the triangle
        # holds no place that is farther away than these. Places where it does are looked at again
        # with more points. So memory does not depend on the survey, and neither do heights depend
        # on its files.
        heights, slopes = (np.full(len(places), np.nan) for _ in range(2))
        uncertain, parts = np.arange(len(places)), iter(progress.shares(0.7, 0.2, 0.1))
        for count in _ROUNDS:
            count = min(count, max(_MOST_KEPT // max(len(uncertain), 1), 32))
            nearest = _Nearest(places[uncertain], count, max_edge)
            for points in self._near(places[uncertain], max_edge, next(parts), chooser):
                nearest.add(points)
            if len(uncertain) == len(places):
                slopes[:] = nearest.slopes()
            heights[uncertain], sure = nearest.heights()
            uncertain = uncertain[~sure]
            if not len(uncertain):
                break
        progress(1.0)
        return TinHeights(heights, slopes)

    def _near(
        self, places: np.ndarray, reach: float, progress: Progress, chooser: Chooser | None
    ) -> Iterator[Points]:
        """Yield the ground points near places, many at a time."""
        cells, frame = NearPlaces(places[:, 0], places[:, 1], reach), self.frame
        waiting: list[Points] = []
        for cloud, ground in self.parts(progress, places, reach):
            points = cloud.points(ground, frame)
            points = points.take(cells.of(points.x, points.y))
            if chooser is not None:
                points = points.take(chooser(points.x, points.y))
            waiting.append(points)
            if sum(points.count for points in waiting) >= _TOGETHER:
                yield Points(*map(np.concatenate, zip(*waiting)))
                waiting = []
        if waiting:
            yield Points(*map(np.concatenate, zip(*waiting)))


class _Nearest:
    """The `count` nearest points, at most `reach` away, of places, shape (q, 2), in metres."""

    def __init__(self, places: np.ndarray, count: int, reach: float) -> None:
        self.places, self.count, self._reach = places, count, reach
        self._distance = np.full((len(places), 0), np.inf)
        # Relative to the place.
        self._points = np.empty((3, len(places), 0))

    def add(self, points: Points) -> None:
        """Add points."""
        from scipy.spatial import cKDTree

        if not points.count:
            return
        xy = np.column_stack((points.x, points.y))
        distance, nearest = cKDTree(xy).query(
            self.places, np.arange(1, min(self.count, points.count) + 1),
            distance_upper_bound=self._reach * (1.0 + 1e-12), workers=1,
        )  # fmt: skip
        nearest = np.minimum(
            nearest, points.count - 1
        )  # a missing one has the number behind the last
        new = np.array([
            points.x[nearest] - self.places[:, :1], points.y[nearest] - self.places[:, 1:],
            points.z[nearest],
        ])  # fmt: skip
        distance = np.concatenate((self._distance, distance), axis=1)
        found = np.concatenate((self._points, new), axis=2)
        # The lowest of points at the same place comes first, and is the vertex.
        order = np.lexsort((found[2], distance), axis=1)[:, : self.count]
        self._distance = np.take_along_axis(distance, order, axis=1)
        self._points = np.take_along_axis(found, order[None], axis=2)

    @property
    def _known(self) -> np.ndarray:
        """The distance from each place up to which all points are known, shape (q,)."""
        if self._distance.shape[1] < self.count:
            return np.full(len(self.places), self._reach)
        return np.minimum(self._distance[:, -1], self._reach)

    def heights(self) -> tuple[np.ndarray, np.ndarray]:
        """Return the heights at the places, NaN for none, and which cannot change any more."""
        heights = np.full(len(self.places), np.nan)
        # All points in reach are known: more cannot be found.
        sure = self._known >= self._reach
        for start in range(0, len(heights), _PLACES):
            part = slice(start, start + _PLACES)
            found, is_sure = self._in_triangles(part)
            heights[part], sure[part] = found, sure[part] | is_sure
            alone = start + np.flatnonzero(sure[part] & ~is_sure)
            for place in alone.tolist():
                heights[place] = self._by_triangulation(place)
        return heights, sure

    def _in_triangles(self, part: slice) -> tuple[np.ndarray, np.ndarray]:
        """Return heights without a triangulation, and whether they are certain."""
        missing = ~np.isfinite(self._distance[part]).T
        x, y, z = (np.ascontiguousarray(axis[part].T) for axis in self._points)
        if len(x) < 4:
            return np.full(x.shape[1], np.nan), np.zeros(x.shape[1], dtype=bool)
        x[missing] = y[missing] = NOWHERE
        corners, found, _ = enclosing_triangles(x, y, np.full(4, NOWHERE))
        a, b, heights = picked(x, corners), picked(y, corners), picked(z, corners)
        heights = interpolated(a, b, heights)
        cx, cy, radius = circumcircles(a, b)
        with np.errstate(invalid="ignore"):
            sure = found & (np.hypot(cx, cy) + radius <= self._known[part] * _INSIDE)
        heights[~found | (longest_edge(a, b) > self._reach)] = np.nan
        return heights, sure & ~missing.all(axis=0)

    def _by_triangulation(self, place: int) -> float:
        """Return the height at a place from a triangulation of its points."""
        there = np.isfinite(self._distance[place])
        if np.count_nonzero(there) < 3:
            return float("nan")
        tin = Tin(*self._points[:, place, there])
        (triangle,) = tin.locate(np.zeros(1), np.zeros(1))
        if triangle < 0:
            return float("nan")
        x, y = (axis[tin.triangles[triangle]][:, None] for axis in (tin.x, tin.y))
        if longest_edge(x, y)[0] > self._reach:
            return float("nan")
        return float(tin.interpolate(np.zeros(1), np.zeros(1), np.array([triangle]))[0])

    def slopes(self) -> np.ndarray:
        """Return the slope in degrees of planes through the nearest points; NaN for too few."""
        x, y, z = self._points[:, :, :_OF_PLANE]
        there = np.isfinite(self._distance[:, :_OF_PLANE])
        weight, count = there.astype(np.float64), there.sum(axis=1)
        safe = np.maximum(count, 1)[:, None]
        x, y, z = (np.where(there, values, 0.0) for values in (x, y, z))
        x, y, z = ((values - values.sum(axis=1)[:, None] / safe) * weight for values in (x, y, z))
        xx, xy, yy = (x * x).sum(axis=1), (x * y).sum(axis=1), (y * y).sum(axis=1)
        xz, yz = (x * z).sum(axis=1), (y * z).sum(axis=1)
        with np.errstate(divide="ignore", invalid="ignore"):
            rises = np.hypot(yy * xz - xy * yz, xx * yz - xy * xz) / (xx * yy - xy * xy)
            return np.where(count > 3, np.degrees(np.arctan(rises)), np.nan)
