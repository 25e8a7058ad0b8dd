"""A grid in which the pieces of a survey that lie far apart take no more cells than they fill."""

from __future__ import annotations

from typing import Iterator, NamedTuple, Sequence

import numpy as np

from .cell_window import CellWindow
from .cells import are_inside

# Cells of rows that are worked on together.
_TOGETHER = 1 << 21


class GridPiece(NamedTuple):
    """A piece of a survey, whose cells are moved beside those of the others."""

    window: CellWindow  # its cells, where they lie
    up: int = 0  # cells by which they are moved to the north
    right: int = 0  # and to the east

    @property
    def moved(self) -> CellWindow:
        """The cells where they are counted."""
        row, column = self.window.row + self.up, self.window.column + self.right
        return self.window._replace(row=row, column=column)

    def scaled(self, factor: int) -> GridPiece:
        """Return the piece in smaller cells."""
        window = CellWindow(*(factor * count for count in self.window))
        return GridPiece(window, factor * self.up, factor * self.right)


class PieceGrid(NamedTuple):
    """Square cells of a survey, counted from (0, 0) of the CRS."""

    window: CellWindow
    size: float  # metres
    pieces: tuple[GridPiece, ...]  # at least one; the first is not moved

    @classmethod
    def of(
        cls, windows: Sequence[CellWindow], size: float, apart: int = 1, multiple: int = 1
    ) -> PieceGrid:
        """Return the grid of pieces, which are moved to the north of each other by multiples of
        some cells, and lie this many cells apart.
        """
        first = windows[0]
        if len(windows) > 1:
            # Points can lie slightly beyond a rounded extent.
            windows = [window.wider(multiple) for window in windows]
            first = windows[0]
        pieces, north, east = (
            [GridPiece(first)],
            first.row + first.rows,
            first.column + first.columns,
        )
        for window in windows[1:]:
            start = north + apart
            start += (window.row - start) % multiple
            column = first.column + (window.column - first.column) % multiple
            pieces.append(GridPiece(window, start - window.row, column - window.column))
            north, east = start + window.rows, max(east, column + window.columns)
        window = CellWindow(first.row, first.column, north - first.row, east - first.column)
        return cls(window, size, tuple(pieces))

    def places(self, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return number, row and column of the cells of points in metres."""
        row, column = self.window.places(x, y, (0.0, 0.0), self.size)
        return self.moved(row, column)

    def moved(
        self, row: np.ndarray, column: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return number, row and column of cells that are counted from the first of the window,
        where they lie.
        """
        if len(self.pieces) > 1:
            left = np.ones(len(row), dtype=bool)
            for window, up, right in self.pieces:
                first = window.row - self.window.row, window.column - self.window.column
                own = left & are_inside(row - first[0], column - first[1], window.shape)
                left &= ~own
                row[own] += up
                column[own] += right
        # The extent in a header may be slightly smaller than that of the points.
        row = np.clip(row, 0, self.window.rows - 1)
        column = np.clip(column, 0, self.window.columns - 1)
        return row * self.window.columns + column, row, column

    def from_centres(
        self, x: np.ndarray, y: np.ndarray, row: np.ndarray, column: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return x and y of points from the centres of their cells, in metres."""
        number = self.piece_at(row)
        up, right = (np.array(moves)[number] for moves in zip(*(one[1:] for one in self.pieces)))
        east, north = self.window.column + column + 0.5, self.window.row + row + 0.5
        return x - (east - right) * self.size, y - (north - up) * self.size

    def piece_at(self, row: np.ndarray | int) -> np.ndarray:
        """Return the numbers of the pieces whose cells are in some rows, or in those above."""
        starts = [piece.moved.row - self.window.row for piece in self.pieces]
        return np.maximum(np.searchsorted(starts, row, side="right") - 1, 0)

    def parts(self, multiple: int = 2) -> list[slice]:
        """Return slices of rows that fit into memory, in multiples, from south to north."""
        rows = self.window.rows
        step = max(_TOGETHER // self.window.columns // multiple, 1) * multiple
        return [slice(start, min(start + step, rows)) for start in range(0, rows, step)]

    @property
    def whole(self) -> CellWindow:
        """The cells that hold all pieces where they lie."""
        ends = [
            (one.row, one.column, one.row + one.rows, one.column + one.columns)
            for one, *_ in self.pieces
        ]
        south, west = np.min(ends, axis=0)[:2].tolist()
        north, east = np.max(ends, axis=0)[2:].tolist()
        return CellWindow(south, west, north - south, east - west)

    def bands(self, rows: int) -> Iterator[tuple[int, int, tuple[slice, slice]]]:
        """Yield parts of pieces, of up to `rows` rows of the whole, from north to south: the first
        row from north and the first column in the whole, and the cells where they are counted.
        """
        whole = self.whole
        for start in range(0, whole.rows, rows):
            band = whole.part(start, min(start + rows, whole.rows), 0, whole.columns)
            for piece in self.pieces:
                part = piece.window.within(band)
                if not part.is_empty:
                    moved = part._replace(row=part.row + piece.up, column=part.column + piece.right)
                    north = whole.row + whole.rows - part.row - part.rows
                    yield north, part.column - whole.column, self.window.slices(moved)
