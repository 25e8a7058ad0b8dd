"""Lines of equal height of a raster, by marching squares, from strips of rows."""

from __future__ import annotations

from typing import Iterator, NamedTuple

import numpy as np

from .cells import numbered

# A node is a point where a line crosses an edge between two cells. Its number is that of the edge,
# times this, plus that of the level.
_LEVELS = 1 << 24
# Edges of a square of four cells. For each set of corners that are at or above the level (sum of 1
# northwest, 2 northeast, 4 southeast, 8 southwest), the edges where a line enters and leaves the
# square; higher ground is on its left. For two opposite corners, there is a second line.
_NORTH = 0
_EAST = 1
_SOUTH = 2
_WEST = 3
_NONE = -1
_LINES = {
    1: (_WEST, _NORTH), 2: (_NORTH, _EAST), 4: (_EAST, _SOUTH), 8: (_SOUTH, _WEST),
    3: (_WEST, _EAST), 6: (_NORTH, _SOUTH), 12: (_EAST, _WEST), 9: (_SOUTH, _NORTH),
    7: (_WEST, _SOUTH), 14: (_NORTH, _WEST), 13: (_EAST, _NORTH), 11: (_SOUTH, _EAST),
}  # fmt: skip
# The two lines for opposite corners, if the middle of the square is below the level, and if not.
_SADDLES = {
    5: (((_WEST, _NORTH), (_EAST, _SOUTH)), ((_EAST, _NORTH), (_WEST, _SOUTH))),
    10: (((_NORTH, _EAST), (_SOUTH, _WEST)), ((_NORTH, _WEST), (_SOUTH, _EAST))),
}


class Isoline(NamedTuple):
    """A line of equal height."""

    level: int  # its height in intervals
    # float64 (n, 2), row and column of its corners; whole numbers are centres of cells.
    places: np.ndarray

    @property
    def is_closed(self) -> bool:
        """Whether the line ends where it begins."""
        return bool((self.places[0] == self.places[-1]).all())

    @property
    def is_depression(self) -> bool:
        """Whether the line is closed and the land inside is lower."""
        return self.is_closed and _area(self.places) < 0.0  # higher ground is on the left


class _Piece(NamedTuple):
    """A part of a line: the nodes at its ends, and the places of its parts in order."""

    first: int
    last: int
    parts: list[np.ndarray]


class Isolines:
    """Finds the lines of equal height, an interval apart, of a raster, strip by strip; only lines
    that cross the last row of a strip are kept in memory.
    """

    def __init__(self, interval: float, columns: int) -> None:
        self._interval, self._columns = interval, columns
        self._by_first: dict[int, _Piece] = {}
        self._by_last: dict[int, _Piece] = {}

    def add(
        self, heights: np.ndarray, row: int, is_last: bool, column: int = 0
    ) -> Iterator[Isoline]:
        """Add a strip of heights (NaN for none) from a `row` of the raster on, and yield the lines
        that are complete; this row must be the last one of the strip before.
        """
        # The strip begins at a column; beyond it, there is no height.
        found = _segments(heights, self._interval, (row, column), self._columns)
        seam = np.iinfo(np.int64).max if is_last else 2 * (row + len(heights) - 1) * self._columns
        done = []
        for piece in _chains(*found):
            whole = self._joined(piece)
            if whole.first == whole.last:
                done.append(whole)
            else:
                self._by_first[whole.first] = self._by_last[whole.last] = whole
        for piece in list(self._by_first.values()):
            if max(piece.first, piece.last) // _LEVELS < seam:
                del self._by_first[piece.first], self._by_last[piece.last]
                done.append(piece)
        for piece in done:
            places = _distinct(piece.parts)
            if len(places) > 1:  # not a single cell at the height of a line
                yield Isoline(piece.first % _LEVELS - _LEVELS // 2, places)

    def _joined(self, piece: _Piece) -> _Piece:
        """Return a piece with the pieces that end where it begins, and begin where it ends."""
        before = self._by_last.pop(piece.first, None)
        if before is not None:
            del self._by_first[before.first]
            piece = _Piece(before.first, piece.last, before.parts + piece.parts)
        after = self._by_first.pop(piece.last, None)
        if after is not None:
            del self._by_last[after.last]
            piece = _Piece(piece.first, after.last, piece.parts + after.parts)
        return piece


def _distinct(parts: list[np.ndarray]) -> np.ndarray:
    """Return the places of all parts without repetitions."""
    places = np.concatenate(parts)
    return places[np.append(True, (places[1:] != places[:-1]).any(axis=1))]


def _segments(
    heights: np.ndarray, interval: float, corner: tuple[int, int], width: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Return the nodes at which the segments of all lines begin and end, and the places of both."""
    heights = heights.astype(np.float64)
    valid = np.isfinite(heights)
    levels = np.floor(np.where(valid, heights, 0.0) / interval).astype(np.int64)
    corners = [levels[:-1, :-1], levels[:-1, 1:], levels[1:, 1:], levels[1:, :-1]]
    low, high = np.minimum.reduce(corners), np.maximum.reduce(corners)
    crossed = high - low
    crossed[~(valid[:-1, :-1] & valid[:-1, 1:] & valid[1:, 1:] & valid[1:, :-1])] = 0
    rows, columns = np.nonzero(crossed)
    counts = crossed[rows, columns]
    level = np.repeat(low[rows, columns] + 1, counts)
    level += numbered(counts)
    rows, columns = np.repeat(rows, counts), np.repeat(columns, counts)
    case = sum((corner[rows, columns] >= level) << bit for bit, corner in enumerate(corners))
    squares = (
        heights[rows + down, columns + right] for down, right in ((0, 0), (0, 1), (1, 1), (1, 0))
    )
    middle = sum(squares) / 4.0 >= level * interval
    crossing, starts, ends = [], [], []
    for number in range(2):
        start, end = (_table(number, side)[case, middle.astype(int)] for side in (0, 1))
        lines = np.flatnonzero(start != _NONE)
        crossing.append(lines)
        starts.append(start[lines])
        ends.append(end[lines])
    index = np.concatenate(crossing)
    level, rows, columns = level[index], rows[index], columns[index]
    nodes_and_places = [
        _nodes(heights, level, rows, columns, np.concatenate(edges), interval, corner, width)
        for edges in (starts, ends)
    ]
    (first, begin), (last, end) = nodes_and_places
    return first, last, begin, end


def _table(number: int, side: int) -> np.ndarray:
    """Return the edges at which the first or second line begins or ends, by case and middle."""
    table = np.full((16, 2), _NONE)
    if number == 0:
        for case, line in _LINES.items():
            table[case] = line[side]
    for case, by_middle in _SADDLES.items():
        table[case] = [lines[number][side] for lines in by_middle]
    return table


def _nodes(
    heights: np.ndarray,
    level: np.ndarray,
    rows: np.ndarray,
    columns: np.ndarray,
    edges: np.ndarray,
    interval: float,
    corner: tuple[int, int],  # row and column of the first height
    width: int,  # columns of the raster
) -> tuple[np.ndarray, np.ndarray]:
    """Return numbers and places of the points where lines cross edges of squares."""
    rows, columns = rows + (edges == _SOUTH), columns + (edges == _EAST)
    is_vertical = (edges == _EAST) | (edges == _WEST)
    start = heights[rows, columns]
    end = heights[rows + is_vertical, columns + ~is_vertical]
    share = np.clip((level * interval - start) / (end - start), 0.0, 1.0)
    rows, columns = rows + corner[0], columns + corner[1]
    edge = 2 * (rows * width + columns) + is_vertical
    places = np.column_stack((rows + share * is_vertical, columns + share * ~is_vertical))
    return edge * _LEVELS + level + _LEVELS // 2, places


def _chains(
    first: np.ndarray, last: np.ndarray, begin: np.ndarray, end: np.ndarray
) -> Iterator[_Piece]:
    """Yield the segments, joined to lines within the strip."""
    order = np.argsort(first)
    place = np.searchsorted(first, last, sorter=order)
    following = order[np.minimum(place, len(order) - 1)] if len(order) else order
    following = np.where(first[following] == last, following, -1)
    heads = np.ones(len(first), dtype=bool)
    heads[following[following >= 0]] = False
    steps, seen = following.tolist(), bytearray(len(first))
    # Open lines begin at heads; what is left afterwards are rings.
    for start in (*np.flatnonzero(heads).tolist(), *range(len(first))):
        if seen[start]:
            continue
        line, now = [], start
        while now >= 0 and not seen[now]:
            seen[now] = 1
            line.append(now)
            now = steps[now]
        places = np.concatenate((begin[line], end[line[-1:]]))
        yield _Piece(int(first[start]), int(last[line[-1]]), [places])


def rings_of(cells: np.ndarray) -> list[np.ndarray]:
    """Return the outline of a connected region of cells, and then those of its holes, as closed
    rings of row and column, float64 (n, 2), whose corners are cut; whole numbers are centres.
    """
    heights = np.pad(cells, 1) + 0.5
    lines = [line.places - 1.0 for line in Isolines(1.0, heights.shape[1]).add(heights, 0, True)]
    rings: list[np.ndarray] = []
    for line in sorted(lines, key=lambda line: -abs(_area(line))):
        # Corners that lie on straight lines are left out.
        on = np.diff(line, axis=0)
        back = np.roll(on, 1, axis=0)
        corners = line[:-1][back[:, 0] * on[:, 1] != back[:, 1] * on[:, 0]]
        rings.append(np.concatenate((corners, corners[:1])))
    return rings


def _area(ring: np.ndarray) -> float:
    row, column = ring.T
    return float((row[:-1] * column[1:] - row[1:] * column[:-1]).sum() / 2.0)
