"""The outline of a survey on a raster: which cells lie inside, found strip by strip."""

from __future__ import annotations

import itertools
import math
import zlib
from functools import cached_property
from typing import Callable, Iterator, NamedTuple

import numpy as np

from ..core.progress import SILENT, Progress
from .morphology import closing, dilation

# Rows and columns of a part of the cells. Blocks of files have as many rows.
_ROWS = 256
_COLUMNS = 1024
_CELLS_A_SPAN = 4_000_000  # cells that are worked on at a time, in a raster that is not wide
_WIDE = 4096  # columns from which on spans are squares, so that empty land can be left out
_SIDE = 1024  # of these squares, a multiple of both sides of a part
MOST_CELLS = 32  # largest radius in cells; for larger ones, groups of cells are used
_OUTSIDE = 0  # number of the gap that reaches the border of the raster


class Span(NamedTuple):
    """A rectangle of a raster, possibly beyond it: rows from `start` to before `end`, counted from
    north, and columns from `first` to before `last`.
    """

    start: int
    end: int
    first: int
    last: int

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns."""
        return self.end - self.start, self.last - self.first

    def wider(self, cells: int) -> Span:
        """Return the span with a margin."""
        return Span(self.start - cells, self.end + cells, self.first - cells, self.last + cells)

    def within(self, shape: tuple[int, int]) -> Span:
        """Return the part of it that lies in a raster."""
        (rows, columns), (start, end, first, last) = shape, self
        return Span(max(start, 0), min(end, rows), max(first, 0), min(last, columns))


# Returns the cells of a span, bool; cells beyond the raster do not count.
Read = Callable[[Span], np.ndarray]


def spans(shape: tuple[int, int]) -> Iterator[Span]:
    """Yield the spans of a raster, row by row: strips, or squares of a wide raster."""
    rows, columns = shape
    is_wide = columns > _WIDE
    step = _SIDE if is_wide else max(_CELLS_A_SPAN // max(columns, 1) // _ROWS, 1) * _ROWS
    across = _SIDE if is_wide else max(columns, 1)
    for start in range(0, rows, step):
        for first in range(0, columns, across):
            yield Span(start, min(start + step, rows), first, min(first + across, columns))


class Outline:
    """Which cells of a raster (rows from north) lie inside, compressed so that any raster fits into
    memory.
    """

    def __init__(self, shape: tuple[int, int]) -> None:
        self.shape = shape
        # Parts that are not here are outside.
        self._parts: dict[tuple[int, int], bool | bytes] = {}

    def set(self, span: Span, cells: np.ndarray) -> None:
        """Set the cells of one of the `spans`; bool."""
        if _is_plainly_empty(cells):
            return
        for row in range(0, cells.shape[0], _ROWS):
            for column in range(0, cells.shape[1], _COLUMNS):
                part = cells[row : row + _ROWS, column : column + _COLUMNS]
                if part.any():
                    place = (span.start + row) // _ROWS, (span.first + column) // _COLUMNS
                    self._parts[place] = (
                        True if part.all() else zlib.compress(np.packbits(part).tobytes(), 1)
                    )

    def meets(self, span: Span) -> bool:
        """Return whether any part that the span touches has cells inside."""
        return any(place in self._parts for place in self._places(span))

    def cells(self, span: Span) -> np.ndarray:
        """Return the cells of a span; those beyond the raster are outside."""
        cells = np.zeros(span.shape, dtype=bool)
        start, end, first, last = span.within(self.shape)
        for i, k in self._places(span):
            if (i, k) in self._parts:
                low, high = max(i * _ROWS, start), min((i + 1) * _ROWS, end)
                west, east = max(k * _COLUMNS, first), min((k + 1) * _COLUMNS, last)
                part = self._part(i, k)[low - i * _ROWS : high - i * _ROWS]
                cells[
                    low - span.start : high - span.start, west - span.first : east - span.first
                ] = part[:, west - k * _COLUMNS : east - k * _COLUMNS]
        return cells

    def _places(self, span: Span) -> Iterator[tuple[int, int]]:
        """Return the places of the parts that a span touches."""
        start, end, first, last = span.within(self.shape)
        rows, columns = (
            range(start // _ROWS, -(-end // _ROWS)),
            range(first // _COLUMNS, -(-last // _COLUMNS)),
        )
        return itertools.product(rows, columns)

    def _part(self, i: int, k: int) -> np.ndarray:
        shape = min(_ROWS, self.shape[0] - i * _ROWS), min(_COLUMNS, self.shape[1] - k * _COLUMNS)
        kept = self._parts[i, k]
        if isinstance(kept, bool):
            return np.broadcast_to(np.bool_(kept), shape)
        bits = np.frombuffer(zlib.decompress(kept), dtype=np.uint8)
        return np.unpackbits(bits, count=shape[0] * shape[1]).reshape(shape).astype(bool)


class Discs:
    """Morphology by discs on a raster, span by span, each read with the margin that this needs."""

    # Cells are dilated by a disc of radius `grow`, then eroded by one of radius `shrink`, both in
    # cells; 0 for no erosion. Wide discs are applied to groups of cells, which are fixed in the
    # CRS: `corner` is the row above the northernmost one, and the westernmost column, both counted
    # from its (0, 0).

    def __init__(self, read: Read, corner: tuple[int, int], grow: float, shrink: float) -> None:
        self._read = read
        self.group = max(1, math.ceil(max(grow, shrink) / MOST_CELLS))
        self._grow, self._shrink = grow / self.group, shrink / self.group
        if self.group > 1 and shrink:
            # Groups reach beyond the cells in them, which would make the result too wide.
            self._shrink += 1.0
        self._before = -corner[0] % self.group, corner[1] % self.group

    @property
    def most_at_once(self) -> int:
        """How many cells are read for a square span of the largest kind."""
        return (_SIDE + 2 * self.margin) ** 2

    @property
    def margin(self) -> int:
        """How many cells beyond a span can matter."""
        return (math.ceil(self._grow) + math.ceil(self._shrink) + 1) * self.group

    def cells(self, span: Span) -> np.ndarray:
        """Return the cells of a span after growing and shrinking."""
        group = self.group
        (start, end), (first, last) = (
            self._in_groups(*ends, before)
            for ends, before in zip((span[:2], span[2:]), self._before)
        )
        cells = self._read(Span(start, end, first, last))
        if group > 1:
            grouped = cells.reshape(len(cells) // group, group, -1, group)
            cells = np.logical_or.reduce(grouped, axis=(1, 3))
        if self._shrink:
            cells = closing(cells, self._grow, self._shrink)
        else:
            cells = dilation(cells, self._grow)
        if group > 1:
            cells = cells.repeat(group, axis=0).repeat(group, axis=1)
        return cells[span.start - start : span.end - start, span.first - first : span.last - first]

    def _in_groups(self, start: int, end: int, before: int) -> tuple[int, int]:
        """Return the ends of rows or columns with the margin, which begin and end with groups."""
        margin = (math.ceil(self._grow) + math.ceil(self._shrink)) * self.group
        start, end = start - margin, end + margin
        return start - (start + before) % self.group, end + -(end + before) % self.group


def with_gaps_inside(
    read: Read,
    shape: tuple[int, int],
    progress: Progress = SILENT,
    holds: Callable[[Span], bool] = lambda span: True,
) -> Outline:
    """Return the outline of cells: these cells and the gaps inside; `holds` tells which spans can
    have cells, and no other is read.
    """
    # A gap is inside if no path over cells with a common side leads from it to the border of the
    # raster. The gaps of spans are joined where they touch, so that the result is the same as for
    # the whole raster at once.
    cells, joined = Outline(shape), _JoinedGaps(shape)
    for span in spans(shape):
        part = read(span) if holds(span) else np.broadcast_to(False, span.shape)
        cells.set(span, part)
        joined.add(span, part)
        progress(0.7 * span.end / shape[0])
    filled = Outline(shape)
    for span in spans(shape):
        filled.set(span, joined.filled(span, cells))
        progress(0.7 + 0.3 * span.end / shape[0])
    return filled


class _JoinedGaps:
    """The gaps of spans, row by row from north to south, joined where they touch."""

    def __init__(self, shape: tuple[int, int]) -> None:
        # The gaps that touch the border of their span are numbered; the first is the outside.
        self._count = _OUTSIDE + 1
        self._pairs: list[np.ndarray] = []  # which of them touch
        self._spans: dict[Span, dict[int, int]] = {}
        self._shape = shape
        # Of the last rows of the spans above, and of the last columns of that to the west: the
        # number of the gap of each cell, -1 for none; beyond the raster all are outside.
        self._above = np.full(shape[1], _OUTSIDE)
        self._west = np.zeros(0, dtype=np.int64)

    def add(self, span: Span, cells: np.ndarray) -> None:
        """Add the cells of the next span; cells that are False are gaps."""
        north, south, west, east = self._numbered(span, cells)
        beside = self._west if span.first else np.full(len(west), _OUTSIDE)
        across = slice(span.first, span.last)
        touching = [(self._above[across], north), (beside, west)]
        if span.end == self._shape[0]:
            touching.append((np.full(len(south), _OUTSIDE), south))
        if span.last == self._shape[1]:
            touching.append((np.full(len(east), _OUTSIDE), east))
        for first, second in touching:
            # Along a border the same two gaps touch in many cells.
            changes = (np.diff(first) != 0) | (np.diff(second) != 0)
            kept = np.append(True, changes) & (first >= 0) & (second >= 0)
            self._pairs.append(np.column_stack((first[kept], second[kept])))
        self._above[across], self._west = south, east

    def _numbered(self, span: Span, cells: np.ndarray) -> list[np.ndarray]:
        """Number the gaps along the border of a span; return these of the cells along its northern,
        southern, western and eastern side, and -1 for no gap.
        """
        if _is_plainly_empty(cells):
            number, self._count = self._count, self._count + 1
            self._spans[span] = {1: number}
            rows, columns = (np.full(count, number) for count in span.shape)
            return [columns, columns, rows, rows]
        labels, _ = _labelled(cells)
        sides = labels[0], labels[-1], labels[:, 0], labels[:, -1]
        found = np.unique(np.concatenate([np.unique(side) for side in sides]))
        numbers = {int(label): self._count + k for k, label in enumerate(found[found > 0])}
        self._count += len(numbers)
        self._spans[span] = numbers
        table = np.full(int(found.max()) + 1, -1)
        table[list(numbers)] = list(numbers.values())
        return [table[side] for side in sides]

    @cached_property
    def _is_outside(self) -> np.ndarray:
        """Which of the numbered gaps reach the outside."""
        from scipy.sparse import coo_matrix
        from scipy.sparse.csgraph import connected_components

        first, second = np.concatenate(self._pairs).T
        shape = self._count, self._count
        links = coo_matrix((np.ones(len(first), dtype=bool), (first, second)), shape=shape)
        groups = connected_components(links, directed=False)[1]
        return groups == groups[_OUTSIDE]

    def filled(self, span: Span, cells: Outline) -> np.ndarray:
        """Return the cells of a span, and those in gaps that are inside; bool."""
        numbers = self._spans[span]
        are_outside = self._is_outside[list(numbers.values())]
        if not cells.meets(span):  # it is a single gap
            return np.broadcast_to(~are_outside, span.shape)
        labels, count = _labelled(cells.cells(span))
        is_outside = np.zeros(count + 1, dtype=bool)
        is_outside[list(numbers)] = are_outside
        return ~np.take(is_outside, labels)


def _labelled(cells: np.ndarray) -> tuple[np.ndarray, int]:
    """Return the number of the gap of each cell, 0 for none, and the number of gaps."""
    from scipy import ndimage

    return ndimage.label(~cells)


def _is_plainly_empty(cells: np.ndarray) -> bool:
    """Return whether cells are those a single False for all, which costs nothing."""
    return cells.strides == (0, 0) and not cells.flat[0]
