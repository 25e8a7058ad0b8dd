"""A rectangular window of square cells that are anchored at (0, 0)."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

# Rounding error of a coordinate on the border of a cell, as a share of the cell.
_ROUNDING = 1e-6


class CellWindow(NamedTuple):
    """A rectangle of square cells, which are counted from (0, 0) to the north and to the east."""

    row: int  # of the first cell, in the southwest
    column: int  # of the first cell
    rows: int
    columns: int

    @classmethod
    def with_centres_in(cls, box: tuple[float, float, float, float], cell: float) -> CellWindow:
        """Return the cells whose centres lie in a box, without its largest x and y."""
        west, south, east, north = (math.ceil(side / cell - 0.5) for side in box)
        return cls(south, west, max(north - south, 0), max(east - west, 0))

    @classmethod
    def around(cls, box: tuple[float, float, float, float], cell: float) -> CellWindow:
        """Return the cells that cover a box."""
        west, south = (math.floor(side / cell + _ROUNDING) for side in box[:2])
        east, north = (math.ceil(side / cell - _ROUNDING) for side in box[2:])
        return cls(south, west, max(north - south, 1), max(east - west, 1))

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns."""
        return self.rows, self.columns

    @property
    def is_empty(self) -> bool:
        """Whether it has no cells, as what windows share that are apart."""
        return self.rows <= 0 or self.columns <= 0

    def slices(self, part: CellWindow) -> tuple[slice, slice]:
        """Return the rows and columns of a part of it."""
        row, column = part.row - self.row, part.column - self.column
        return slice(row, row + part.rows), slice(column, column + part.columns)

    def corner(self, cell: float) -> tuple[float, float]:
        """Return x and y of the southwestern corner."""
        return self.column * cell, self.row * cell

    def centres(self, cell: float) -> tuple[np.ndarray, np.ndarray]:
        """Return x of the columns and y of the rows, at the centres of the cells."""
        x, y = (self.column + np.arange(self.columns), self.row + np.arange(self.rows))
        return (x + 0.5) * cell, (y + 0.5) * cell

    def wider(self, cells: int) -> CellWindow:
        """Return the window with a margin."""
        margins = 2 * cells
        return CellWindow(
            self.row - cells, self.column - cells, self.rows + margins, self.columns + margins
        )

    def part(self, start: int, end: int, first: int, last: int) -> CellWindow:
        """Return the cells of some rows, counted from the north, and of some columns; they can lie
        beyond the window.
        """
        return CellWindow(
            self.row + self.rows - end, self.column + first, end - start, last - first
        )

    def within(self, window: CellWindow) -> CellWindow:
        """Return the cells that both windows share; it is empty if they are apart."""
        row, column = max(self.row, window.row), max(self.column, window.column)
        north = min(self.row + self.rows, window.row + window.rows)
        east = min(self.column + self.columns, window.column + window.columns)
        return CellWindow(row, column, north - row, east - column)

    def places(
        self, x: np.ndarray, y: np.ndarray, corner: tuple[float, float], cell: float
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return row and column, int64 (n,), in the window of the cells that hold places in metres
        from a corner in metres; negative or too large outside the window.
        """
        start_x, start_y = (place - start for place, start in zip(self.corner(cell), corner))
        rows = np.floor((y - start_y) / cell + _ROUNDING).astype(np.int64)
        return rows, np.floor((x - start_x) / cell + _ROUNDING).astype(np.int64)
