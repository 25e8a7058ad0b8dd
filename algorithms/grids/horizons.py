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
from typing import Callable, Iterator, NamedTuple

import numpy as np

from ..core.progress import SILENT
from ..core.threads import over_parts

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
    """Heights with a border without heights, so that all cells have all neighbours.

    Parameters
    ----------
    heights : numpy.ndarray of float, shape (rows, columns)
        Heights in metres; NaN where there is none.
    reach : tuple of int
        Rows and columns up to which neighbours lie.
    missing : float
        The height of places without one, such as -inf.
    """

    def __init__(self, heights: np.ndarray, reach: tuple[int, int], missing: float) -> None:
        (rows, columns), (down, right) = heights.shape, reach
        size = rows + 2 * down, columns + 2 * right
        self.shape, self._reach = heights.shape, reach
        self._wide = np.full(size, missing, dtype=np.float32)
        known = np.isfinite(heights)
        inside = self._wide[down : down + rows, right : right + columns]
        np.copyto(inside, heights, where=known, casting="same_kind")
        self.own = np.where(known, heights, 0.0).astype(np.float32)
        self.known = known

    def at(self, rows: slice, neighbour: Neighbour) -> np.ndarray:
        """Return the heights of a neighbour of the cells of some rows."""
        row, column = self._reach[0] + neighbour.row, self._reach[1] + neighbour.column
        return self._wide[rows.start + row : rows.stop + row, column : column + self.shape[1]]

    def is_whole(self, rows: slice) -> bool:
        """Return whether all neighbours of the cells of some rows have a height."""
        return bool(np.isfinite(self._wide[rows.start : rows.stop + 2 * self._reach[0]]).all())

    def over_rows(self, work: Callable[[slice], None]) -> None:
        """Call a function for some rows at a time, in threads."""
        over_parts(work, self.shape[0], max(PIECE // max(self.shape[1], 1), 1), SILENT)


def horizon_reach(radius: float, cells: Cells) -> tuple[int, int]:
    """Return up to how many rows and columns away cells matter to the horizon."""
    farthest = _farthest(radius, cells)
    return math.ceil(farthest / cells[1]), math.ceil(farthest / cells[0])


def _farthest(radius: float, cells: Cells) -> float:
    """Return a radius as a whole number of the shorter sides of cells, at least the longer one."""
    return max(round(radius / min(cells)) * min(cells), max(cells))


def sky_view(heights: np.ndarray, cells: Cells, radius: float) -> np.ndarray:
    """Return the sky-view factor: the share of the sky that can be seen, as a mean of directions.

    Parameters
    ----------
    heights : numpy.ndarray of float, shape (rows, columns)
        Heights in metres; NaN where there is none.
    cells : tuple of float
        Distance in metres between neighbours in a row, and in a column.
    radius : float
        Up to this distance in metres the terrain can hide the sky; at least one cell.

    Returns
    -------
    numpy.ndarray of float32, shape (rows, columns)
        1 on level land and on summits, less in hollows; NaN where there is no height. A direction
        in which no height is known does not count. A cell depends on others up to `horizon_reach`.
    """
    return _means(heights, cells, (0.0, radius), _sky)[0]


def openness(heights: np.ndarray, cells: Cells, radius: float) -> np.ndarray:
    """Return the positive openness: the mean angle between the zenith and the horizon, in degrees.

    Negative openness is that of the heights upside down (``-heights``): the mean angle between the
    nadir and the surface. Arguments and result are as for `sky_view`. Both are 90 degrees on level
    land and on even slopes. Positive openness is greater on ridges, negative openness in hollows.
    """
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
    around = Surroundings(heights, horizon_reach(radii[1], cells), -np.inf)
    lines = list(_lines(cells, radii))
    means = [np.full(heights.shape, np.nan, dtype=np.float32) for _ in functions]

    def work(rows: slice) -> None:
        own, known, is_whole = around.own[rows], around.known[rows], around.is_whole(rows)
        sums = np.zeros((len(functions), *own.shape), dtype=np.float32)
        count = np.zeros(own.shape, dtype=np.float32)
        for line in lines:
            tangent = _horizon(around, rows, own, line)
            seen = np.isfinite(tangent)
            count += seen
            for number, function in enumerate(functions):
                value = function(tangent)
                sums[number] += value if is_whole else np.where(seen, value, np.float32(0.0))
        known = known & (count > 0)
        for mean, total in zip(means, sums):
            np.divide(total, count, out=mean[rows], where=known)

    around.over_rows(work)
    return means


def _horizon(
    around: Surroundings, rows: slice, own: np.ndarray, line: list[Neighbour]
) -> np.ndarray:
    """Return the tangent of the angle of the horizon along a line; -inf where nothing is known."""
    tangent = np.full(own.shape, -np.inf, dtype=np.float32)
    rise = np.empty_like(tangent)
    for each in line:
        np.subtract(around.at(rows, each), own, out=rise)
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
