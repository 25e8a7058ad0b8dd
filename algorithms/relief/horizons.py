"""Sky-view factor, openness and local dominance.

These are measures of how much of the sky the land round a place hides, and of how steeply one looks
down on it.

References
----------
Zaksek, K., Ostir, K., Kokalj, Z. (2011): Sky-View Factor as a Relief Visualization Technique.
Remote Sensing 3(2), 398-415.
Yokoyama, R., Shirasawa, M., Pike, R. J. (2002): Visualizing Topography by Openness. Photogrammetric
Engineering & Remote Sensing 68(3), 257-265.
Hesse, R. (2016): Visualisierung hochaufloesender Digitaler Gelaendemodelle mit LiVT. In:
Lieberwirth, U. and Herzog, I. (eds.): 3D-Anwendungen in der Archaeologie. Edition Topoi, Berlin,
109-128. The local dominance.
"""

from __future__ import annotations

import math
from functools import cached_property
from typing import Callable, Iterator, NamedTuple

import numpy as np

from ..core.progress import SILENT
from ..core.threads import over_parts, parts_of
from .local_relief import TRUNCATE, trend_slopes

# Sides of a cell in metres: along a row, and along a column.
Cells = tuple[float, float]

# Horizon: number of directions; distance in cells of the places along a direction; and, for places
# farther away than this number of cells, their distance as a share of that from the centre.
_DIRECTIONS = 16
_STEP = 1 / 3
_EVERY = 64.0
_FARTHER = 1 / 96
# Local dominance: height of the eyes in metres, number of directions, and number of distances in a
# direction, which is smaller if these would be less than a cell apart.
_EYES = 1.7
_VIEWS = 24
_DISTANCES = 10
_ROUNDING = 1e-6  # share of a step, so that rounding omits no distance
PIECE = 40_000  # cells of a piece, so few that they stay in the processor's cache


class Neighbour(NamedTuple):
    """The offset of a neighbour in rows and columns, and its distance in metres."""

    row: int
    column: int
    distance: float


class ObserverArea:
    """Heights in metres (NaN for none), with neighbours up to `reach` rows and columns from each
    cell, also beyond the border of the data.
    """

    # Beyond the border, heights are those of the plane that fits the surroundings of a cell best.
    # Without them, the number of neighbours would change towards a border in visible steps.

    def __init__(self, heights: np.ndarray, reach: tuple[int, int]) -> None:
        (rows, columns), (down, right) = heights.shape, reach
        self.shape, self._reach = heights.shape, reach
        self._wide = np.full((rows + 2 * down, columns + 2 * right), np.nan, dtype=np.float32)
        self._wide[down : down + rows, right : right + columns] = heights

    def over_pieces(self, work: Callable[[HorizonPiece], None]) -> None:
        """Call a function for the pieces of the heights that hold any, in threads."""
        side = math.isqrt(PIECE)
        rows, columns = (parts_of(count, side) for count in self.shape)
        places = [(row, column) for row in rows for column in columns]

        def work_at(part: slice) -> None:
            piece = HorizonPiece(self._wide, self._reach, *places[part.start])
            if piece.known.any():
                work(piece)

        over_parts(work_at, len(places), 1, SILENT)


class HorizonPiece:
    """Cells whose neighbours are looked at together, so that they stay in the processor's cache."""

    def __init__(
        self, wide: np.ndarray, reach: tuple[int, int], rows: slice, columns: slice
    ) -> None:
        self.place, self._reach = (rows, columns), reach
        ends = (cells.stop + 2 * by for cells, by in zip(self.place, reach))
        self._wide = wide[tuple(slice(cells.start, end) for cells, end in zip(self.place, ends))]
        own = self._shifted(0, 0)
        self.known = np.isfinite(own)  # bool (rows, columns), cells with a height
        # float32 (rows, columns), heights; 0 in voids.
        self.own = np.where(self.known, own, np.float32(0.0))

    def _shifted(self, row: int, column: int) -> np.ndarray:
        rows, columns = (cells.stop - cells.start for cells in self.place)
        row, column = row + self._reach[0], column + self._reach[1]
        return self._wide[row : row + rows, column : column + columns]

    def heights_of(self, neighbour: Neighbour) -> np.ndarray:
        """Return the heights of one neighbour of each cell; beyond the border those of planes."""
        there = self._shifted(neighbour.row, neighbour.column)
        if self._planes is None:
            return there
        beyond = np.isnan(there)
        if beyond.any():
            there, (own, down, right) = there.copy(), (values[beyond] for values in self._planes)
            there[beyond] = (
                own + down * np.float32(neighbour.row) + right * np.float32(neighbour.column)
            )
        return there

    @cached_property
    def _planes(self) -> list[np.ndarray] | None:
        """Heights of the planes at each cell, and their rises to the next row and column; None if
        all neighbours have a height.
        """
        if np.isfinite(self._wide).all():
            return None
        sigma = self._reach[0] / TRUNCATE, self._reach[1] / TRUNCATE
        inside = tuple(
            slice(by, by + cells.stop - cells.start) for cells, by in zip(self.place, self._reach)
        )
        slopes = trend_slopes(self._wide, sigma)
        return [self.own, *(slope[inside].astype(np.float32) for slope in slopes)]


def horizon_reach(radius: float, cells: Cells) -> tuple[int, int]:
    """Return the distance in rows and columns up to which cells affect the horizon."""
    farthest = _farthest(radius, cells)
    return math.ceil(farthest / cells[1]), math.ceil(farthest / cells[0])


def _farthest(radius: float, cells: Cells) -> float:
    """Return a radius as a whole number of the shorter sides of cells, at least the longer one."""
    return max(round(radius / min(cells)) * min(cells), max(cells))


def sky_view(heights: np.ndarray, cells: Cells, radius: float) -> np.ndarray:
    """Return the sky-view factor, the visible share of the sky as a mean of directions: float32, 1
    on level land and on summits, NaN without a height.
    """
    # Terrain up to `radius` metres away, at least one cell, can hide the sky. Beyond the border of
    # the data, the land continues as a plane. A cell depends on others up to `horizon_reach`.
    return _means(heights, cells, (0.0, radius), _sky)[0]


def openness(heights: np.ndarray, cells: Cells, radius: float) -> np.ndarray:
    """Return the positive openness: the mean angle between the zenith and the horizon, in
    degrees.
    """
    # Negative openness is that of the heights upside down (``-heights``): the mean angle between
    # the nadir and the surface. Arguments and result are as for `sky_view`. Both are 90 degrees on
    # level land and on even slopes. Positive openness is greater on ridges, negative openness in
    # hollows.
    return _means(heights, cells, (0.0, radius), _zenith)[0]


def sky_view_and_openness(
    heights: np.ndarray, cells: Cells, radii: tuple[float, float]
) -> tuple[np.ndarray, np.ndarray]:
    """Return both measures; terrain nearer than the first of two radii hides nothing."""
    sky, zenith = _means(heights, cells, radii, _sky, _zenith)
    return sky, zenith


def _sky(tangent: np.ndarray) -> np.ndarray:
    """Return the share of the sky above a horizon: 1 minus the sine of its angle."""
    up = np.maximum(tangent, np.float32(0.0))
    return np.float32(1.0) - up / np.sqrt(np.float32(1.0) + up * up)


def _zenith(tangent: np.ndarray) -> np.ndarray:
    """Return the angle between zenith and horizon in degrees."""
    return np.float32(90.0) - np.degrees(np.arctan(tangent))


def _means(
    heights: np.ndarray,
    cells: Cells,
    radii: tuple[float, float],
    *functions: Callable[[np.ndarray], np.ndarray],
) -> list[np.ndarray]:
    """Return the means over all directions of functions of the tangent of the horizon."""
    around = ObserverArea(heights, horizon_reach(radii[1], cells))
    lines = list(_lines(cells, radii))
    means = [np.full(heights.shape, np.nan, dtype=np.float32) for _ in functions]

    def work(piece: HorizonPiece) -> None:
        sums = np.zeros((len(functions), *piece.own.shape), dtype=np.float32)
        for line in lines:
            tangent = _horizon(piece, line)
            for number, function in enumerate(functions):
                sums[number] += function(tangent)
        for mean, total in zip(means, sums):
            np.divide(total, np.float32(len(lines)), out=mean[piece.place], where=piece.known)

    around.over_pieces(work)
    return means


def _horizon(piece: HorizonPiece, line: list[Neighbour]) -> np.ndarray:
    """Return the tangent of the angle of the horizon along a line."""
    tangent = np.full(piece.own.shape, -np.inf, dtype=np.float32)
    rise = np.empty_like(tangent)
    for neighbour in line:
        np.subtract(piece.heights_of(neighbour), piece.own, out=rise)
        rise *= np.float32(1.0 / neighbour.distance)
        np.maximum(tangent, rise, out=tangent)
    return tangent


def _lines(cells: Cells, radii: tuple[float, float]) -> Iterator[list[Neighbour]]:
    """Yield the neighbours in each direction, from one radius to another, each once."""
    least = min(cells)
    nearest, farthest = max(radii[0] / least, 1.0), _farthest(radii[1], cells) / least
    along = [nearest]
    while along[-1] + _STEP / 2 < farthest:
        step = _STEP if along[-1] < _EVERY else max(_STEP, along[-1] * _FARTHER)
        along.append(min(along[-1] + step, farthest))
    distance = np.array(along) * least
    for number in range(_DIRECTIONS):
        angle = 2.0 * math.pi * number / _DIRECTIONS
        row = np.round(np.sin(angle) * distance / cells[1]).astype(int).tolist()
        column = np.round(np.cos(angle) * distance / cells[0]).astype(int).tolist()
        places = [place for place in dict.fromkeys(zip(row, column)) if place != (0, 0)]
        yield [Neighbour(r, c, math.hypot(r * cells[1], c * cells[0])) for r, c in places]


def dominance_reach(radius: float, cells: Cells) -> tuple[int, int]:
    """Return the distance in rows and columns up to which cells affect the dominance."""
    farthest = 2.0 * max(radius, max(cells))
    return math.ceil(farthest / cells[1]), math.ceil(farthest / cells[0])


def local_dominance(heights: np.ndarray, cells: Cells, radius: float) -> np.ndarray:
    """Return the local dominance, how steeply an observer looks down on the land around: float32, 1
    on level land, more on rises, less in hollows, NaN without a height.
    """
    # The observer looks at land from `radius` metres, at least one cell, up to twice as far away.
    # Beyond the border of the data, the land continues as a plane. A cell depends on others up to
    # `dominance_reach`.
    around = ObserverArea(heights, dominance_reach(radius, cells))
    seen = list(_seen(radius, cells))
    level = np.float32(sum(weight * _EYES for _, weight in seen))
    dominance = np.full(heights.shape, np.nan, dtype=np.float32)

    def work(piece: HorizonPiece) -> None:
        eyes = piece.own + np.float32(_EYES)
        total, down = np.zeros_like(eyes), np.empty_like(eyes)
        for neighbour, weight in seen:
            np.subtract(eyes, piece.heights_of(neighbour), out=down)
            np.maximum(down, np.float32(0.0), out=down)
            down *= np.float32(weight)
            total += down
        np.divide(total, level, out=dominance[piece.place], where=piece.known)

    around.over_pieces(work)
    return dominance


def _seen(radius: float, cells: Cells) -> Iterator[tuple[Neighbour, float]]:
    """Yield the places at which the observer looks, with their weights."""
    # The weight is the angle at which a metre is seen, times the area of the place.
    least = min(cells)
    radius = max(radius, max(cells))
    step = max(radius / _DISTANCES, least)
    for number in range(_VIEWS):
        angle = math.radians(number * 360.0 / _VIEWS)
        for distance in np.arange(radius, 2.0 * radius + step * _ROUNDING, step).tolist():
            row = round(math.sin(angle) * distance / cells[1])
            column = round(math.cos(angle) * distance / cells[0])
            weight = (2.0 * distance + step) / distance
            yield Neighbour(-row, -column, distance), weight
