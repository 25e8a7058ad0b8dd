"""Sky-view factor and openness: how much the surroundings of a place hide of its sky.

References
----------
Zaksek, K., Ostir, K., Kokalj, Z. (2011): Sky-View Factor as a Relief Visualization Technique.
Remote Sensing 3(2), 398-415.
Yokoyama, R., Shirasawa, M., Pike, R. J. (2002): Visualizing Topography by Openness. Photogrammetric
Engineering & Remote Sensing 68(3), 257-265.
"""

from __future__ import annotations

import math
from functools import cached_property
from typing import Callable, Iterator, NamedTuple

import numpy as np

from ..core.progress import SILENT
from ..core.threads import over_parts, parts_of
from .local_trend import TRUNCATE, trend_slopes

# Sides of a cell in metres: along a row, and along a column.
Cells = tuple[float, float]

_DIRECTIONS = 16
# Places along a direction are this far apart, in cells; beyond `_EVERY` cells, in this proportion
# to their distance.
_STEP, _EVERY, _FARTHER = 1 / 3, 64.0, 1 / 96
# Cells that are worked on together: they stay in the cache of a processor.
PIECE = 40_000


class Neighbour(NamedTuple):
    """Where a neighbour lies, in rows and columns, and how far away, in metres."""

    row: int
    column: int
    distance: float


class Surroundings:
    """Heights in metres (NaN for none) and what lies up to `reach` rows and columns round each
    cell, also beyond the border of the data.
    """

    # There the land goes on as the plane that fits the surroundings of a cell best. If such places
    # were left out, directions would end one after the other towards a border, in visible steps.

    def __init__(self, heights: np.ndarray, reach: tuple[int, int]) -> None:
        (rows, columns), (down, right) = heights.shape, reach
        self.shape, self._reach = heights.shape, reach
        self._wide = np.full((rows + 2 * down, columns + 2 * right), np.nan, dtype=np.float32)
        self._wide[down : down + rows, right : right + columns] = heights

    def over_pieces(self, work: Callable[[Piece], None]) -> None:
        """Call a function for the pieces of the heights that hold any, in threads."""
        side = math.isqrt(PIECE)
        rows, columns = (parts_of(count, side) for count in self.shape)
        places = [(one, other) for one in rows for other in columns]

        def work_at(part: slice) -> None:
            piece = Piece(self._wide, self._reach, *places[part.start])
            if piece.known.any():
                work(piece)

        over_parts(work_at, len(places), 1, SILENT)


class Piece:
    """Cells whose neighbours are looked at together, so that they stay in the processor's cache."""

    def __init__(
        self, wide: np.ndarray, reach: tuple[int, int], rows: slice, columns: slice
    ) -> None:
        self.place, self._reach = (rows, columns), reach
        ends = (each.stop + 2 * by for each, by in zip(self.place, reach))
        self._wide = wide[tuple(slice(each.start, end) for each, end in zip(self.place, ends))]
        own = self._at(0, 0)
        self.known = np.isfinite(own)  # bool (rows, columns), cells with a height
        # float32 (rows, columns), heights; 0 where there is none.
        self.own = np.where(self.known, own, np.float32(0.0))

    def _at(self, row: int, column: int) -> np.ndarray:
        rows, columns = (each.stop - each.start for each in self.place)
        row, column = row + self._reach[0], column + self._reach[1]
        return self._wide[row : row + rows, column : column + columns]

    def heights_of(self, neighbour: Neighbour) -> np.ndarray:
        """Return the heights of a neighbour of each cell; beyond the border those of a plane."""
        there = self._at(neighbour.row, neighbour.column)
        if self._planes is None:
            return there
        beyond = np.isnan(there)
        if beyond.any():
            there, (own, down, right) = there.copy(), (each[beyond] for each in self._planes)
            there[beyond] = (
                own + down * np.float32(neighbour.row) + right * np.float32(neighbour.column)
            )
        return there

    @cached_property
    def _planes(self) -> list[np.ndarray] | None:
        """Heights of the planes, and their rises to the next row and to the next column, None if
        all neighbours have a height.
        """
        if np.isfinite(self._wide).all():
            return None
        sigma = self._reach[0] / TRUNCATE, self._reach[1] / TRUNCATE
        inside = tuple(
            slice(by, by + each.stop - each.start) for each, by in zip(self.place, self._reach)
        )
        slopes = trend_slopes(self._wide, sigma)
        return [self.own, *(each[inside].astype(np.float32) for each in slopes)]


def horizon_reach(radius: float, cells: Cells) -> tuple[int, int]:
    """Return up to how many rows and columns away cells matter to the horizon."""
    farthest = _farthest(radius, cells)
    return math.ceil(farthest / cells[1]), math.ceil(farthest / cells[0])


def _farthest(radius: float, cells: Cells) -> float:
    """Return a radius as a whole number of the shorter sides of cells, at least the longer one."""
    return max(round(radius / min(cells)) * min(cells), max(cells))


def sky_view(heights: np.ndarray, cells: Cells, radius: float) -> np.ndarray:
    """Return the sky-view factor: the share of the sky that can be seen, as a mean of directions,
    float32, 1 on level land and on summits; NaN where there is no height.
    """
    # Up to `radius` metres, at least one cell, the terrain can hide the sky. Beyond the border of
    # the data the land goes on as a plane. A cell depends on others up to `horizon_reach`.
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
    """Return both in one pass; terrain nearer than the first of two radii hides nothing."""
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
    around = Surroundings(heights, horizon_reach(radii[1], cells))
    lines = list(_lines(cells, radii))
    means = [np.full(heights.shape, np.nan, dtype=np.float32) for _ in functions]

    def work(piece: Piece) -> None:
        sums = np.zeros((len(functions), *piece.own.shape), dtype=np.float32)
        for line in lines:
            tangent = _horizon(piece, line)
            for number, function in enumerate(functions):
                sums[number] += function(tangent)
        for mean, total in zip(means, sums):
            np.divide(total, np.float32(len(lines)), out=mean[piece.place], where=piece.known)

    around.over_pieces(work)
    return means


def _horizon(piece: Piece, line: list[Neighbour]) -> np.ndarray:
    """Return the tangent of the angle of the horizon along a line."""
    tangent = np.full(piece.own.shape, -np.inf, dtype=np.float32)
    rise = np.empty_like(tangent)
    for each in line:
        np.subtract(piece.heights_of(each), piece.own, out=rise)
        rise *= np.float32(1.0 / each.distance)
        np.maximum(tangent, rise, out=tangent)
    return tangent


def _lines(cells: Cells, radii: tuple[float, float]) -> Iterator[list[Neighbour]]:
    """Yield the neighbours in each direction, from one radius to another, without doubles."""
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
        places = [each for each in dict.fromkeys(zip(row, column)) if each != (0, 0)]
        yield [Neighbour(r, c, math.hypot(r * cells[1], c * cells[0])) for r, c in places]
