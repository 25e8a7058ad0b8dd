"""The profile of a place to review: the line that shows its error best, and the points along it."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ...core.points import Box
from ...core.progress import SILENT, Progress
from ...grids.cells import are_inside
from ...grids.lines import NearPlaces
from ...las.cloud import PointCloud
from ...survey.files import Inputs
from ...survey.window import taken_near
from .places import PlaceToReview, Rasters

_DIRECTIONS = 12
# Metres: how far a line reaches beyond its place, and its least length.
_BEYOND = 15.0
_SHORTEST = 30.0
# Lines whose terrain departs from a straight slope by at least this share of the largest departure
# are as good: the shortest of them is taken, which is the one with ground nearest on both sides.
_AS_GOOD = 0.8
_WIDTH = 2.0  # metres, of the strip whose points a profile shows
_SIDE = 10.0  # metres, of the squares by which points near lines are found
_MOST_SHOWN = 50_000  # points of a profile; of more, only one at each spot of a drawing
# Metres: spots along the line and in height.
_SPOT = (0.1, 0.02)


class ProfilePoints(NamedTuple):
    """The points of a strip along a line, all (n,)."""

    along: np.ndarray  # float32, distance from the first end, in units of the CRS
    heights: np.ndarray  # float32, in units of the CRS
    classes: np.ndarray  # uint8


def line_of(rasters: Rasters, place: PlaceToReview) -> np.ndarray:
    """Return the ends of the profile line of a place, row and column, float64 (2, 2): the line
    through its worst cell along which the terrain steps or bends most.
    """
    inside = np.argwhere(place.cells) + [part.start for part in place.window]
    offsets = (inside - place.worst).astype(np.float64)
    angles = np.arange(_DIRECTIONS) * np.pi / _DIRECTIONS - np.pi / 2.0  # from west to east
    ways = np.column_stack((-np.sin(angles), np.cos(angles)))
    every = [_ends(offsets, way, rasters.cell) for way in ways]
    reach = math.ceil(np.abs(every).max()) + 1
    first = [max(middle - reach, 0) for middle in place.worst]
    near = None
    if rasters.terrain is not None:
        window = (slice(start, middle + reach + 1) for start, middle in zip(first, place.worst))
        near = rasters.terrain[tuple(window)]
    lines = []
    for way, ends in zip(ways, every):
        # Rounded, so that no last bit of a number decides.
        departure = round(_departure(near, np.subtract(place.worst, first), way, ends), 2)
        lines.append((departure, round(ends[1] - ends[0], 2), way, ends))
    most = max(line[0] for line in lines)
    good = (line for line in lines if line[0] >= round(_AS_GOOD * most, 2))
    _, _, way, ends = min(good, key=lambda line: (line[1], -line[0]))
    return np.array(place.worst) + np.outer(ends, way)


def _ends(offsets: np.ndarray, way: np.ndarray, cell: float) -> tuple[float, float]:
    """Return where a line through a place begins and ends, in cells from the worst cell."""
    beside = np.abs(offsets @ np.array((way[1], -way[0]))) <= 1.0
    along = offsets[beside] @ way
    low, high = float(along.min()) - _BEYOND / cell, float(along.max()) + _BEYOND / cell
    more = max(_SHORTEST / cell - (high - low), 0.0) / 2.0
    return low - more, high + more


def _departure(
    terrain: np.ndarray | None, worst: np.ndarray, way: np.ndarray, ends: tuple[float, float]
) -> float:
    """Return how far the terrain along a line departs from a straight slope, in metres."""
    if terrain is None:
        return 0.0
    steps = np.arange(np.ceil(ends[0]), ends[1])
    # Halves go to even numbers: of cells from the worst one, wherever the raster begins.
    cells = np.rint(np.round(np.outer(way, steps), 6)).astype(np.intp)
    rows, columns = worst[:, None] + cells
    there = are_inside(rows, columns, terrain.shape)
    heights = terrain[rows[there], columns[there]].astype(np.float64)
    known = np.isfinite(heights)
    steps, heights = steps[there][known], heights[known]
    if len(steps) < 3:
        return 0.0
    return float(np.ptp(heights - np.polyval(np.polyfit(steps, heights, 1), steps)))


def points_along(
    sources: Inputs, lines: np.ndarray, width: float = _WIDTH, progress: Progress = SILENT
) -> list[ProfilePoints]:
    """Return the points of files in a strip `width` metres wide along each line (x and y of both
    ends in the CRS of the points, (n, 4)); each file is read once.
    """
    lines = np.asarray(lines, dtype=np.float64).reshape(-1, 4)
    survey = sources.open(progress.part(0.0, 0.05))
    if not len(lines):
        return []
    strips = _Strips(lines, width, survey.crs.horizontal_unit)
    parts: list[list[ProfilePoints]] = []
    shares = progress.part(0.05, 1.0).shares(*(max(tile.count, 1) for tile in survey.tiles))
    for tile, share in zip(survey.tiles, shares):
        parts += taken_near(tile, strips.boxes, strips.points_of, share)
        share(1.0)
    spots = np.array(_SPOT) / (survey.crs.horizontal_unit, survey.crs.vertical_unit)
    empty = ProfilePoints(*(np.zeros(0, kind) for kind in (np.float32, np.float32, np.uint8)))
    found = [[part[number] for part in parts] or [empty] for number in range(len(lines))]
    return [_shown(ProfilePoints(*map(np.concatenate, zip(*some))), spots) for some in found]


class _Strips:
    """The strips along lines, which find their points among those of a part of a file."""

    def __init__(self, lines: np.ndarray, width: float, unit: float) -> None:
        self._starts, ways = lines[:, :2], lines[:, 2:] - lines[:, :2]
        self._lengths = np.maximum(np.hypot(*ways.T), 1e-9)
        self._ways, self._half = ways / self._lengths[:, None], width / 2.0 / unit
        low, high = (pick(lines[:, :2], lines[:, 2:]) for pick in (np.minimum, np.maximum))
        self.boxes: list[Box] = [
            tuple(box) for box in np.hstack((low - self._half, high + self._half)).tolist()
        ]
        side = max(_SIDE / unit, self._half)
        shares = (np.linspace(0.0, 1.0, int(length / side) + 2) for length in self._lengths)
        some = [a + np.outer(share, b) for a, b, share in zip(self._starts, ways, shares)]
        x, y = np.concatenate(some).T
        self._near = NearPlaces(x, y, side)

    def points_of(self, part: PointCloud) -> list[ProfilePoints]:
        """Return the points of a part of a file in each strip, without withheld points."""
        x, y = part.coordinates()
        near = np.flatnonzero(self._near.of(x, y) & ~part.withheld)
        near = near[np.argsort(x[near], kind="stable")]  # so that a box holds a slice of them
        places, classes = np.column_stack((x[near], y[near])), part.classification[near]
        heights = (part.z[near] * part.scale[2] + part.offset[2]).astype(np.float32)
        found = []
        for (west, _, east, _), *line in zip(self.boxes, self._starts, self._ways, self._lengths):
            start, way, length = line
            some = slice(*np.searchsorted(places[:, 0], (west, east)))
            along = (places[some] - start) @ way
            beside = np.abs((places[some] - start) @ np.array((-way[1], way[0])))
            inside = (along >= 0.0) & (along <= length) & (beside <= self._half)
            values = along[inside].astype(np.float32), heights[some][inside]
            found.append(ProfilePoints(*values, classes[some][inside]))
        return found


def _shown(points: ProfilePoints, spots: np.ndarray) -> ProfilePoints:
    """Return points in the order along the line; of very many, one of each class at each spot."""
    order = np.lexsort((points.classes, points.heights, points.along))
    points = ProfilePoints(*(column[order] for column in points))
    if len(order) <= _MOST_SHOWN:
        return points
    place = np.floor(np.column_stack(points[:2]) / spots).astype(np.int64)
    _, firsts = np.unique(np.column_stack((place, points.classes)), axis=0, return_index=True)
    return ProfilePoints(*(column[np.sort(firsts)] for column in points))
