"""The pieces of a survey that lie far apart, and points that lie far from all others."""

from __future__ import annotations

import itertools
import math
from typing import Iterable, NamedTuple

import numpy as np

from ..core.errors import BareEarthError
from ..core.points import Box, box_round, scaled
from ..core.progress import SILENT, Progress
from ..core.words import counted
from ..las.lasfile import LasFile
from ..las.reading import read_parts

# Metres: pieces lie apart if a row of empty squares of this side separates them.
_SQUARE = 1000.0
# Metres: side of the squares that tell the area of a piece, a part of the others.
_FINE = 20.0
# A file has room for stray points if its extent is wider than this, in metres, and has more square
# metres for each point: only then are its points read to see where they lie.
_WIDE = 2000.0
_SPARSE = 4.0
# An extent is that of a piece unless the squares with points cover less than this share of it.
_FULL = 0.25
# Stray points: at most this number, and at most this share of the points, this many times farther
# from all others than they are apart.
_MOST_STRAY = 100
_SHARE_STRAY = 1e-3
_TIMES_APART = 10.0
_HALF = 1 << 31  # makes column numbers positive
_MOST_TOLD = 3  # groups of stray points that are named


class FilePiece(NamedTuple):
    """Points of a survey that lie together."""

    box: Box  # smallest x and y, largest x and y, in units of the CRS
    box_in_metres: Box
    points: int
    area: float  # square metres with points
    strays_from: float = math.nan  # metres to all others, if it is only stray points

    @property
    def is_stray(self) -> bool:
        """Whether it is no part of the survey, but a few points with wrong coordinates."""
        return not math.isnan(self.strays_from)


class _Held(NamedTuple):
    """Squares of `_SQUARE` metres that hold points; arrays of equal length."""

    place: np.ndarray  # int64 (n, 2): row and column
    points: np.ndarray  # float64: their number
    area: np.ndarray  # float64: square metres with points
    box: np.ndarray  # float64 (n, 4): extent of the points, in units of the CRS


def pieces_of(
    tiles: Iterable[LasFile], unit: float, progress: Progress = SILENT
) -> list[FilePiece]:
    """Return the pieces of a survey, the one with the most points first, given the metres in a unit
    of the CRS; the points of files are read only where the extent leaves room for stray ones.
    """
    held = [_held_by(tile, unit, progress) for tile in tiles]
    place, count, area, box = (np.concatenate(columns) for columns in zip(*held))
    group = _groups(place)
    points = np.rint(np.bincount(group, weights=count)).astype(np.int64)
    is_few = points <= min(_MOST_STRAY, _SHARE_STRAY * points.sum())
    pieces = []
    for number, of_piece in enumerate(points.tolist()):
        own = group == number
        extent = box_round(box[own])
        width, height = (extent[2] - extent[0]) * unit, (extent[3] - extent[1]) * unit
        filled = float(area[own].sum())
        is_full = filled >= _FULL * width * height
        apart = _distance(box[own], box[~is_few[group]]) * unit if is_few[number] else 0.0
        is_stray = apart > _TIMES_APART * max(width, height) and math.isfinite(apart)
        pieces.append(
            FilePiece(
                extent, scaled(extent, unit), of_piece, width * height if is_full else filled,
                apart if is_stray else math.nan,
            )
        )  # fmt: skip
    return sorted(pieces, key=lambda piece: -piece.points)


def _groups(place: np.ndarray) -> np.ndarray:
    """Return the group of each square, (n,): squares with a common side or corner are in one."""
    # Few squares: to import what labels grids would take longer.
    left = dict.fromkeys(map(tuple, place.tolist()), -1)
    for group, start in enumerate(left):
        waiting = [start] if left[start] < 0 else []
        while waiting:
            row, column = square = waiting.pop()
            if left.get(square, 0) >= 0:  # it holds no points, or has its group
                continue
            left[square] = group
            beside = itertools.product((row - 1, row, row + 1), (column - 1, column, column + 1))
            waiting += beside
    groups = [left[square] for square in map(tuple, place.tolist())]
    return np.unique(groups, return_inverse=True)[1]


def _distance(boxes: np.ndarray, others: np.ndarray) -> float:
    """Return the least distance between boxes and other ones; infinite without other ones."""
    least = math.inf
    for west, south, east, north in boxes.tolist():
        across = np.maximum(np.maximum(others[:, 0] - east, west - others[:, 2]), 0.0)
        up = np.maximum(np.maximum(others[:, 1] - north, south - others[:, 3]), 0.0)
        least = min(least, float(np.hypot(across, up).min(initial=math.inf)))
    return least


def report_strays(pieces: Iterable[FilePiece], progress: Progress) -> None:
    """Warn of points that lie far from all others."""
    stray = [piece for piece in pieces if piece.is_stray]
    for piece in stray[:_MOST_TOLD]:
        west, south, east, north = piece.box
        middle = f"x {(west + east) / 2.0:.10g}, y {(south + north) / 2.0:.10g}"
        progress.warning(
            f"{counted(piece.points, 'point lies', 'points lie')} {_far(piece.strays_from)} from"
            f" all others ({middle}). Check the coordinates there: if they are wrong, remove such"
            " points, or give the extent of the land that you need."
        )
    more = sum(piece.points for piece in stray[_MOST_TOLD:])
    if more:
        words = "more point lies", "more points lie"
        progress.warning(f"{counted(more, *words)} far from all others at other places.")


def _far(metres: float) -> str:
    return f"{metres / 1000.0:,.1f} km" if metres < 10_000.0 else f"{metres / 1000.0:,.0f} km"


def _held_by(tile: LasFile, unit: float, progress: Progress) -> _Held:
    """Return the squares that hold the points of a file."""
    if not _has_room(tile, unit):
        return _of_extent(tile, unit)
    try:
        return _of_points(tile, unit, progress)
    except BareEarthError:  # whoever needs its points says what is wrong with it
        nothing, box = np.zeros((1, 2), dtype=np.int64), np.array([tile.outer_box])
        return _Held(nothing, np.array([float(tile.count)]), np.ones(1), box)


def _has_room(tile: LasFile, unit: float) -> bool:
    """Return whether the extent of a file is so large for its points that some can be stray."""
    west, south, east, north = (side * unit for side in tile.outer_box)
    width, height = east - west, north - south
    return max(width, height) > _WIDE and width * height > _SPARSE * tile.count


def _of_extent(tile: LasFile, unit: float) -> _Held:
    """Return the squares that the extent of a file touches, with their shares of its points."""
    west, south, east, north = tile.outer_box
    sides = []
    for low, high in ((south, north), (west, east)):
        edges = np.arange(math.floor(low * unit / _SQUARE), math.floor(high * unit / _SQUARE) + 1)
        ends = np.clip(np.array((edges, edges + 1)) * _SQUARE / unit, low, high)
        sides.append((edges, *ends))
    (rows, south_of, north_of), (columns, west_of, east_of) = sides
    shape = len(rows), len(columns)
    grids = np.broadcast_arrays(
        rows[:, None], columns, west_of, south_of[:, None], east_of, north_of[:, None]
    )
    row, column, *box = (grid.ravel() for grid in grids)
    area = (box[2] - box[0]) * (box[3] - box[1]) * unit**2
    share = area / area.sum() if area.sum() else np.full(math.prod(shape), 1.0 / math.prod(shape))
    return _Held(np.column_stack((row, column)), share * tile.count, area, np.column_stack(box))


def _of_points(tile: LasFile, unit: float, progress: Progress) -> _Held:
    """Return the squares that the points of a file touch."""
    held: dict[tuple[int, int], np.ndarray] = {}  # count, and extent
    fine: set[int] = set()
    ratio = round(_SQUARE / _FINE)
    for part in read_parts(tile, progress.quiet()):
        x, y = part.coordinates()
        row, column = (np.floor(axis * unit / _FINE).astype(np.int64) for axis in (y, x))
        fine.update(np.unique((row << 32) + column + _HALF).tolist())
        places, back, counts = np.unique(
            np.column_stack((row // ratio, column // ratio)), axis=0, return_inverse=True,
            return_counts=True,
        )  # fmt: skip
        box = np.full((4, len(places)), -np.inf)
        for found, values in zip(box, (-x, -y, x, y)):
            np.maximum.at(found, back.ravel(), values)
        for place, count, extent in zip(places.tolist(), counts, box.T):
            known = held.get(tuple(place), np.array([0.0, *[-np.inf] * 4]))
            held[tuple(place)] = np.append(known[0] + count, np.maximum(known[1:], extent))
    numbers = np.array(sorted(fine))
    row, column = numbers >> 32, (numbers & (2 * _HALF - 1)) - _HALF
    own, covered = np.unique(
        np.column_stack((row // ratio, column // ratio)), axis=0, return_counts=True
    )
    values = np.array([held[tuple(place)] for place in own.tolist()])
    # As the extent in a header, which is rounded.
    box = (values[:, 1:] + np.tile(tile.scale[:2], 2)) * (-1.0, -1.0, 1.0, 1.0)
    return _Held(own, values[:, 0], covered * _FINE**2, box)
