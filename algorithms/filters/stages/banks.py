"""Low banks, dykes of fields and rims of ditches: narrow, as hedges and rows of plants are.

Morphology cuts off banks, because they are narrow and higher than the tolerance of the ground. A
cross-section tells a bank from a plant: on a bank it stays the same for some metres, its points do
not scatter, and at least one side is no wall. It is measured in squares, along the middle line of
the points that stand out. This line may be bent.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, NamedTuple

import numpy as np

from ...core.points import Points
from ...core.progress import SILENT
from ...core.threads import in_threads, over_parts
from ...grids.cells import Cells
from ..pipeline import PointRule, Stage
from ..state import State
from .bank_sections import Strip, on_banks

# Side of a tile in metres. A square has 2 x 2 tiles, and squares overlap by one tile.
_TILE = 4.0
# Points up to so many metres above the tolerance of the ground are tested.
_LOOK_UP = 1.8
# Least number of points of a square that stand out; and at least as many as usually lie on so many
# square metres.
_LEAST_POINTS, _LEAST_AREA = 8, 2.0
# Points that stand out are tested if they are at least this share of the points within so many
# metres. Where fewer stand out, they are plants.
_SHARE, _AROUND = 0.15, 1.0
# Least standard deviation in metres of the points along the middle line, largest one across it, and
# least ratio of the variances.
_LEAST_LENGTH, _LARGEST_WIDTH, _LONG = 1.6, 1.6, 2.5
# Half of the sharpest curvature of the middle line in 1 / metres; how often the line is fitted; and
# the standard deviations from it within which points count in the second fit.
_SHARPEST, _FITS, _NEAR_LINE = 0.12, 2, 1.8
# Steps of a cross-section are half of the spacing, but at least so many metres.
_LEAST_STEP = 0.25
# Least spacing of points in metres; a smaller one counts as this.
_CLOSEST = 0.01
_POINTS_AT_ONCE = 1 << 18
_POINTS_A_PART = 1 << 16


@dataclass(frozen=True)
class Banks(PointRule):
    """Points on low banks, dykes of fields and rims of ditches are ground."""

    stage: ClassVar = Stage.ACCEPTED
    reads: ClassVar = ("points", "grids", "limits", "ground")
    writes: ClassVar = ("ground",)

    def apply(self, state: State) -> None:
        """Accept the points on banks."""
        state.ground |= banks(state.points, state.ground, state.grids[0].cells, state.limits)


def banks(points: Points, ground: np.ndarray, cells: Cells, limits: np.ndarray) -> np.ndarray:
    """Return which other points lie on low banks.

    Parameters
    ----------
    points : Points
        All points.
    ground : numpy.ndarray of bool, shape (n,)
        Which of them are ground already.
    cells : Cells
        A grid over the points.
    limits : numpy.ndarray of float64, shape (rows, columns, 2)
        Heights in metres between which the ground of each cell lies.

    Returns
    -------
    numpy.ndarray of bool, shape (n,)
    """
    found = np.zeros(points.count, dtype=bool)
    if cells.size > _TILE:
        return found  # a square has too few points
    stands_out = _stands_out(points, ground, cells, limits)
    raised, level = (
        np.bincount(cells.index[which], minlength=cells.rows * cells.columns).reshape(cells.shape)
        for which in (stands_out, ground)
    )
    # Under trees, points near the ground are farther apart than others.
    spacing = cells.spacing(raised + level, _CLOSEST)
    least = max(_LEAST_POINTS, _LEAST_AREA / spacing**2)
    many = stands_out & _among_others(raised, level, cells)
    squares = _Squares.where(points.take(np.flatnonzero(many)), least)
    if not len(squares.row):
        return found
    step = max(_LEAST_STEP, 0.5 * spacing)

    def search(part: tuple[np.ndarray, np.ndarray]) -> np.ndarray:
        which, square = part
        strip = _strip(points.take(which), stands_out[which], square, squares)
        return which[on_banks(strip, step)]

    for which in in_threads(search, squares.members(points, ground | stands_out, cells)):
        found[which] = True
    return found


def _stands_out(points: Points, ground: np.ndarray, cells: Cells, limits: np.ndarray) -> np.ndarray:
    """Return which points lie a little above the ground."""
    low, high = (each.ravel().astype(np.float32) for each in np.moveaxis(limits, -1, 0))
    high += np.float32(_LOOK_UP)
    stands_out = ~ground

    def judge(part: slice) -> None:
        cell, z = cells.index[part], points.z[part]
        stands_out[part] &= (z >= low[cell]) & (z <= high[cell])

    over_parts(judge, points.count, _POINTS_A_PART, SILENT)
    return stands_out


def _among_others(raised: np.ndarray, level: np.ndarray, cells: Cells) -> np.ndarray:
    """Return which points lie where many points stand out, unlike under trees."""
    from scipy import ndimage

    width = 2 * round(_AROUND / cells.size) + 1
    raised, level = (
        ndimage.uniform_filter(each.astype(np.float32), width) for each in (raised, level)
    )
    return (raised >= _SHARE * (raised + level)).ravel()[cells.index]


class _Squares(NamedTuple):
    """Squares in which the points that stand out form a long, narrow band.

    Attributes
    ----------
    first : tuple of int
        Row and column of the first tile, counted from (0, 0) of the frame.
    shape : tuple of int
        Rows and columns of tiles.
    row, column : numpy.ndarray of int, shape (squares,)
        The tile in the south-west of each square.
    x, y, angle : numpy.ndarray of float64, shape (squares,)
        Centre and direction (radians from east) of the points that stand out.
    """

    first: tuple[int, int]
    shape: tuple[int, int]
    row: np.ndarray
    column: np.ndarray
    x: np.ndarray
    y: np.ndarray
    angle: np.ndarray

    @classmethod
    def where(cls, raised: Points, least: float) -> _Squares:
        """Return the squares in which at least `least` points stand out in a band."""
        none = np.zeros(0)
        if not raised.count:
            return cls((0, 0), (0, 0), none, none, none, none, none)
        row, column = _tiles(raised)
        first = int(row.min()) - 1, int(column.min()) - 1
        shape = int(row.max()) - first[0] + 2, int(column.max()) - first[1] + 2
        tile = (row - first[0]) * shape[1] + column - first[1]

        def total(weights: np.ndarray | None = None) -> np.ndarray:
            tiles = np.bincount(tile, weights, shape[0] * shape[1]).reshape(shape)
            return tiles[:-1, :-1] + tiles[1:, :-1] + tiles[:-1, 1:] + tiles[1:, 1:]

        x, y, count = raised.x, raised.y, np.maximum(total(), 1)
        middle_x, middle_y = total(x) / count, total(y) / count
        xx = total(x * x) / count - middle_x**2
        yy = total(y * y) / count - middle_y**2
        xy = total(x * y) / count - middle_x * middle_y
        half, apart = (xx + yy) / 2.0, np.hypot((xx - yy) / 2.0, xy)
        along, across = half + apart, np.maximum(half - apart, 0.0)
        is_narrow = (across <= _LARGEST_WIDTH**2) & (along >= _LONG * across)
        is_long = (count >= least) & (along >= _LEAST_LENGTH**2)
        where = np.nonzero(is_narrow & is_long)
        angle = 0.5 * np.arctan2(2.0 * xy[where], (xx - yy)[where])
        return cls(first, shape, where[0], where[1], middle_x[where], middle_y[where], angle)

    def members(
        self, points: Points, wanted: np.ndarray, cells: Cells
    ) -> list[tuple[np.ndarray, np.ndarray]]:
        """Return the indices of the wanted points and the squares that hold them, in parts.

        A part holds whole squares. A point is in several squares.
        """
        corners = np.stack(
            [
                (self.row + up) * self.shape[1] + self.column + right
                for up in (0, 1)
                for right in (0, 1)
            ],
            axis=1,
        )
        is_needed = np.zeros(self.shape, dtype=bool)
        is_needed.ravel()[corners] = True
        which = np.flatnonzero(wanted & self._touching(is_needed, cells).ravel()[cells.index])
        row, column = (each - first for each, first in zip(_tiles(points.take(which)), self.first))
        inside = (row >= 0) & (row < self.shape[0]) & (column >= 0) & (column < self.shape[1])
        tile = (row * self.shape[1] + column)[inside]
        order = np.argsort(tile, kind="stable")
        which, first = (
            which[inside][order],
            np.searchsorted(tile[order], np.arange(is_needed.size + 1)),
        )
        counts = first[corners + 1] - first[corners]
        part_of = np.cumsum(counts.sum(axis=1)) // _POINTS_AT_ONCE
        parts = []
        for squares in np.split(np.arange(len(corners)), np.flatnonzero(np.diff(part_of)) + 1):
            count = counts[squares].ravel()
            skipped = first[corners[squares]].ravel() - (np.cumsum(count) - count)
            places = np.repeat(skipped, count) + np.arange(count.sum())
            parts.append((which[places], np.repeat(squares, counts[squares].sum(axis=1))))
        return parts

    def _touching(self, tiles: np.ndarray, cells: Cells) -> np.ndarray:
        """Return which cells, no larger than tiles, may touch some tiles."""

        def ends(first: int, count: int, axis: int) -> list[np.ndarray]:
            sides = (np.arange(count)[:, None] + first + np.array((0.0, 1.0))) * cells.size / _TILE
            tile = np.floor(sides).astype(np.int64) - self.first[axis]
            return list(np.clip(tile, 0, self.shape[axis] - 1).T)

        touching = np.zeros(cells.shape, dtype=bool)
        for row in ends(cells.first_row, cells.rows, 0):
            for column in ends(cells.first_column, cells.columns, 1):
                touching |= tiles[np.ix_(row, column)]
        return touching


def _tiles(points: Points) -> tuple[np.ndarray, np.ndarray]:
    """Return the row and the column of the tile of each point."""
    row, column = (np.floor(each / _TILE).astype(np.int64) for each in (points.y, points.x))
    return row, column


def _strip(points: Points, stands_out: np.ndarray, square: np.ndarray, squares: _Squares) -> Strip:
    """Return points along and across the middle lines of their squares."""
    cosine, sine = np.cos(squares.angle)[square], np.sin(squares.angle)[square]
    east, north = points.x - squares.x[square], points.y - squares.y[square]
    along, across = east * cosine + north * sine, north * cosine - east * sine
    square = square - square[0]
    strip = Strip(square, along, across, points.z, stands_out, int(square[-1]) + 1)
    return strip._replace(across=across - _off(_line(strip), strip))


def _line(strip: Strip) -> np.ndarray:
    """Return the parabola through the points of each square that stand out, shape (3, squares)."""
    strip = strip.take(np.flatnonzero(strip.stands_out))
    line, most = np.zeros((3, strip.number)), np.full(strip.number, 2.0 * _LARGEST_WIDTH)
    for _ in range(_FITS):
        near = np.abs(strip.across) <= most[strip.square]
        more = _parabola(strip.take(near))
        line, strip = line + more, strip._replace(across=strip.across - _off(more, strip))
        near = np.abs(strip.across) <= 2.0 * _LARGEST_WIDTH
        count = np.maximum(strip.total(near.astype(float)), 1.0)
        most = _NEAR_LINE * np.sqrt(strip.total(np.where(near, strip.across**2, 0.0)) / count)
    return line


def _parabola(strip: Strip) -> np.ndarray:
    """Return the parabola through the points of each square, shape (3, squares)."""
    powers = [strip.along**power for power in range(5)]
    totals = [strip.total(each) for each in powers]
    matrix = np.stack([np.stack(totals[row : row + 3], axis=-1) for row in range(3)], axis=-2)
    right = np.stack([strip.total(powers[row] * strip.across) for row in range(3)], axis=-1)
    # A small term on the diagonal, because a square may have no point.
    line = np.linalg.solve(matrix + 1e-6 * np.eye(3), right[..., None])[..., 0].T
    line[2] = np.clip(line[2], -_SHARPEST, _SHARPEST)
    return line


def _off(line: np.ndarray, strip: Strip) -> np.ndarray:
    """Return how far across the parabola lies at each point."""
    start, turn, bend = line[:, strip.square]
    return start + (turn + bend * strip.along) * strip.along
