"""The outline of a survey on a raster: which cells lie inside, found strip by strip."""

from __future__ import annotations

import math
import zlib
from functools import cached_property
from typing import Callable, Iterator

import numpy as np

from ..core.progress import SILENT, Progress
from .morphology import closing, dilation

# Rows and columns of a part of the cells. Blocks of files have as many rows.
_ROWS = 256
_COLUMNS = 4096
_CELLS_A_STRIP = 4_000_000  # cells that are worked on at a time
MOST_CELLS = 32  # largest radius in cells; for larger ones, groups of cells are used
_OUTSIDE = 0  # number of the gap that reaches the border of the raster

# Returns cells from row `start` to row `end`, both counted from north and possibly beyond the
# raster, where no cell counts: bool, shape (end - start, columns).
ReadRows = Callable[[int, int], np.ndarray]


def strips(shape: tuple[int, int]) -> Iterator[tuple[int, int]]:
    """Yield the first row, and the row after the last, of strips of a raster."""
    rows, columns = shape
    step = max(_CELLS_A_STRIP // columns // _ROWS, 1) * _ROWS
    for start in range(0, rows, step):
        yield start, min(start + step, rows)


class Outline:
    """Which cells of a raster (rows from north) lie inside, compressed so that any raster fits into
    memory.
    """

    def __init__(self, shape: tuple[int, int]) -> None:
        self.shape = shape
        self._parts: dict[tuple[int, int], bool | bytes] = {}

    def set(self, start: int, cells: np.ndarray) -> None:
        """Set the cells of a strip, which begins at row `start`; bool, shape (rows, columns)."""
        for row in range(0, len(cells), _ROWS):
            for column in range(0, self.shape[1], _COLUMNS):
                part = cells[row : row + _ROWS, column : column + _COLUMNS]
                place = (start + row) // _ROWS, column // _COLUMNS
                is_plain = part.all() or not part.any()
                self._parts[place] = (
                    bool(part.flat[0])
                    if is_plain
                    else zlib.compress(np.packbits(part).tobytes(), 1)
                )

    def rows(self, start: int, end: int, first: int = 0, last: int | None = None) -> np.ndarray:
        """Return the cells of the rows from `start` to before `end` and the columns from `first` to
        before `last`; those beyond the raster are outside.
        """
        rows, columns = self.shape
        last = columns if last is None else last
        cells = np.zeros((end - start, last - first), dtype=bool)
        for i in range(max(start, 0) // _ROWS, -(-min(end, rows) // _ROWS)):
            low, high = max(i * _ROWS, start), min((i + 1) * _ROWS, end, rows)
            for k in range(max(first, 0) // _COLUMNS, -(-min(last, columns) // _COLUMNS)):
                west, east = max(k * _COLUMNS, first), min((k + 1) * _COLUMNS, last, columns)
                part = self._part(i, k)[low - i * _ROWS : high - i * _ROWS]
                cells[low - start : high - start, west - first : east - first] = part[
                    :, west - k * _COLUMNS : east - k * _COLUMNS
                ]
        return cells

    def _part(self, i: int, k: int) -> np.ndarray:
        shape = min(_ROWS, self.shape[0] - i * _ROWS), min(_COLUMNS, self.shape[1] - k * _COLUMNS)
        kept = self._parts[i, k]
        if isinstance(kept, bool):
            return np.broadcast_to(np.bool_(kept), shape)
        bits = np.frombuffer(zlib.decompress(kept), dtype=np.uint8)
        return np.unpackbits(bits, count=shape[0] * shape[1]).reshape(shape).astype(bool)


class Discs:
    """Morphology by discs on rows of a raster, which are read with the margin that this needs."""

    # Cells are dilated by a disc of radius `grow`, then eroded by one of radius `shrink`, both in
    # cells; 0 for no erosion. Wide discs are applied to groups of cells, which are fixed in the
    # CRS: `corner` is the row above the northernmost one, and the westernmost column, both counted
    # from its (0, 0).

    def __init__(self, read: ReadRows, corner: tuple[int, int], grow: float, shrink: float) -> None:
        self._read = read
        self.group = max(1, math.ceil(max(grow, shrink) / MOST_CELLS))
        self._grow, self._shrink = grow / self.group, shrink / self.group
        if self.group > 1 and shrink:
            # Groups reach beyond the cells in them, which would make the result too wide.
            self._shrink += 1.0
        self._before = -corner[0] % self.group, corner[1] % self.group

    def rows(self, start: int, end: int) -> np.ndarray:
        """Return the cells from row `start` to row `end` after growing and shrinking."""
        group = self.group
        margin = (math.ceil(self._grow) + math.ceil(self._shrink)) * group
        north, west = self._before
        first = start - margin
        first -= (first + north) % group
        last = end + margin
        last += -(last + north) % group
        cells = self._read(first, last)
        columns = cells.shape[1]
        if group > 1:
            cells = np.pad(cells, ((0, 0), (west, -(west + columns) % group)))
            grouped = cells.reshape(len(cells) // group, group, -1, group)
            cells = np.logical_or.reduce(grouped, axis=(1, 3))
        if self._shrink:
            cells = closing(cells, self._grow, self._shrink)
        else:
            cells = dilation(cells, self._grow)
        if group > 1:
            cells = cells.repeat(group, axis=0).repeat(group, axis=1)[:, west : west + columns]
        return cells[start - first : end - first]


def with_gaps_inside(
    read: ReadRows, shape: tuple[int, int], progress: Progress = SILENT
) -> Outline:
    """Return the outline of cells: these cells and the gaps inside."""
    # A gap is inside if no path over cells with a common side leads from it to the border of the
    # raster. The gaps of strips are joined where they touch, so that the result is the same as for
    # all rows at once.
    cells, joined = Outline(shape), _JoinedGaps()
    for start, end in strips(shape):
        part = read(start, end)
        cells.set(start, part)
        joined.add(part, start == 0, end == shape[0])
        progress(0.7 * end / shape[0])
    filled = Outline(shape)
    for number, (start, end) in enumerate(strips(shape)):
        filled.set(start, ~joined.outside(number, cells.rows(start, end)))
        progress(0.7 + 0.3 * end / shape[0])
    return filled


class _JoinedGaps:
    """The gaps of strips from north to south, joined where they touch."""

    def __init__(self) -> None:
        # The gaps that touch the border of their strip are numbered; the first is the outside.
        self._count = _OUTSIDE + 1
        self._pairs: list[np.ndarray] = []  # which of them touch
        self._strips: list[dict[int, int]] = []
        self._above: np.ndarray | None = None

    def add(self, cells: np.ndarray, is_first: bool, is_last: bool) -> None:
        """Add the cells of the next strip; cells that are False are gaps."""
        labels, _ = _labelled(cells)
        sides = np.concatenate((labels[:, 0], labels[:, -1]))
        edges = np.unique(np.concatenate((labels[0], labels[-1], sides)))
        numbers = {int(label): self._count + k for k, label in enumerate(edges[edges > 0])}
        self._count += len(numbers)
        self._strips.append(numbers)
        open_sides = [sides, *([labels[0]] if is_first else []), *([labels[-1]] if is_last else [])]
        table = np.full(int(edges.max()) + 1, -1)
        table[list(numbers)] = list(numbers.values())
        beyond = table[np.unique(np.concatenate(open_sides))]
        touching = [np.column_stack((np.full_like(beyond, _OUTSIDE), beyond))]
        if self._above is not None:
            touching.append(np.column_stack((self._above, table[labels[0]])))
        pairs = np.concatenate(touching)
        self._pairs.append(np.unique(pairs[(pairs >= 0).all(axis=1)], axis=0))
        self._above = table[labels[-1]]

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

    def outside(self, strip: int, cells: np.ndarray) -> np.ndarray:
        """Return which cells of a strip lie in gaps that are not inside; bool."""
        labels, count = _labelled(cells)
        is_outside = np.zeros(count + 1, dtype=bool)
        numbers = self._strips[strip]
        is_outside[list(numbers)] = self._is_outside[list(numbers.values())]
        return np.take(is_outside, labels)


def _labelled(cells: np.ndarray) -> tuple[np.ndarray, int]:
    """Return the number of the gap of each cell, 0 for none, and the number of gaps."""
    from scipy import ndimage

    return ndimage.label(~cells)
