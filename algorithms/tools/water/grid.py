"""Counts and lowest heights of the points in the cells of a survey, from which water is found."""

from __future__ import annotations

import math

import numpy as np

from ...core.errors import BareEarthError
from ...core.points import Box, Points
from ...grids.cells import lower_at

# Most cells of a survey, at 12 bytes each; up to 2 GB while water is found.
_MOST_CELLS = 60_000_000
# The rest is for cells that only touch the extent.
_SHARE_FOR_BORDERS = 0.99
# Cells that become larger in a large survey stay so small that the narrowest river of the Lidar
# Base Specification, 30 m, is six cells wide.
_LARGEST_CELL = 5.0
_MOST_COUNT = np.iinfo(np.uint16).max
# A cell has about so many last returns on open land: an empty one is then hardly chance.
_CELL_IN_SPACINGS, _LEAST_CELL, _STEP = 2.0, 1.0, 0.5
# Side in cells of the squares in which the usual count is found, and how many squares on each side
# of one take part.
_SQUARE, _SQUARES = 32, 8
# The usual count is at least this share of that of the whole survey.
_OF_SURVEY = 0.35
# A cell is sparse if it has at most the first share of the usual count, and the nine cells round it
# have on average at most the second one: along a straight shore six of nine are land.
_SPARSE, _SPARSE_ROUND = 0.25, 0.6
# Share of class 9 among the last returns from which a cell is water.
_CLASS_SHARE = 0.5


def cell_for(area: float, count: int, size: float | None = None, extent: float = 0.0) -> float:
    """Return the side in metres of the cells for a survey, of an area and an extent in square
    metres; a large one gets larger cells than the user wants, to fit into memory.
    """
    if size is not None:
        return size
    spacing = math.sqrt(area / max(count, 1))
    fine = max(_LEAST_CELL, math.ceil(_CELL_IN_SPACINGS * spacing / _STEP) * _STEP)
    return max(fine, min(_smallest_cell(extent), _LARGEST_CELL))


def _smallest_cell(extent: float) -> float:
    """Return the smallest side of cells that are not too many in so many square metres."""
    return math.ceil(math.sqrt(extent / (_SHARE_FOR_BORDERS * _MOST_CELLS)) / _STEP) * _STEP


class WaterGrid:
    """The cells of a survey with a box in metres, from (0, 0) of its frame, whatever the files,
    with rows from south to north; too many are refused.
    """

    def __init__(self, box: Box, cell: float) -> None:
        west, south, east, north = (math.floor(each / cell) for each in box)
        self.cell, self.row, self.column = cell, south, west
        self.shape = north - south + 1, east - west + 1
        count = self.shape[0] * self.shape[1]
        if count > _MOST_CELLS:
            least = _smallest_cell(count * cell**2)
            raise BareEarthError(
                f"Cells of {cell:g} m would be {count:,} in this survey, and"
                f" {_MOST_CELLS:,} is the most. Choose cells of {least:g} m, or give fewer files."
            )
        # Lowest last return and lowest ground point in metres; infinite where there is none.
        self.lowest, self.ground = (np.full(self.shape, np.inf, np.float32) for _ in range(2))
        # Last returns, and those of class 9.
        self.counts, self.water = (np.zeros(self.shape, np.uint16) for _ in range(2))
        self.decks: np.ndarray | None = None  # cells with points of decks of bridges, if any

    def add(
        self,
        points: Points,
        ground: np.ndarray,
        water: np.ndarray,
        last: np.ndarray,
        decks: np.ndarray | None = None,
    ) -> None:
        """Add points, in the frame of the survey, and which are ground, of class 9, last returns,
        and on the decks of bridges; bool (n,).
        """
        row = np.floor(points.y / self.cell).astype(np.int64) - self.row
        column = np.floor(points.x / self.cell).astype(np.int64) - self.column
        # An extent in a header can be a little too small.
        inside = (row >= 0) & (row < self.shape[0]) & (column >= 0) & (column < self.shape[1])
        code = np.where(inside, row * self.shape[1] + column, -1)
        for counts, which in ((self.counts, last), (self.water, last & water)):
            places, some = np.unique(code[which & inside], return_counts=True)
            flat = counts.reshape(-1)
            flat[places] = np.minimum(flat[places] + some, _MOST_COUNT)
        for heights, which in ((self.lowest, last), (self.ground, ground)):
            which = which & inside
            lower_at(heights.reshape(-1), code[which], points.z[which].astype(np.float32))
        if decks is not None and (decks & inside).any():
            if self.decks is None:
                self.decks = np.zeros(self.shape, dtype=bool)
            self.decks.reshape(-1)[code[decks & inside]] = True

    def class_in(self, rows: slice = slice(None), columns: slice = slice(None)) -> np.ndarray:
        """Return which cells of a window have mostly points of class 9; bool."""
        water, counts = self.water[rows, columns], self.counts[rows, columns]
        return (water > 0) & (water >= _CLASS_SHARE * counts)

    def usual(self) -> np.ndarray:
        """Return the usual count of last returns round each square of cells; float64."""
        # It is the mean over squares, each weighted by its own count: voids do not lower it.
        from scipy.ndimage import uniform_filter

        starts = [np.arange(0, length, _SQUARE) for length in self.shape]
        sums = np.add.reduceat(self.counts, starts[0], axis=0, dtype=np.int64)
        sums = np.add.reduceat(sums, starts[1], axis=1)
        sides = [np.diff(np.append(each, side)) for each, side in zip(starts, self.shape)]
        means = sums / np.multiply.outer(*sides)
        size = 2 * _SQUARES + 1
        squared, plain = (uniform_filter(each, size, mode="constant") for each in (means**2, means))
        everywhere = float((means**2).sum() / max(means.sum(), 1e-9))
        return np.maximum(squared / np.maximum(plain, 1e-9), _OF_SURVEY * everywhere)

    def candidates(self) -> np.ndarray:
        """Return which cells may be water: sparse ones, and those of class 9."""
        from scipy.ndimage import uniform_filter

        counts = self.counts.astype(np.float32)
        round_each = uniform_filter(counts, 3, mode="nearest")
        rows, columns = (slice(0, side) for side in self.shape)
        usual = self.by_cell(self.usual().astype(np.float32), rows, columns)
        found = (counts <= _SPARSE * usual) & (round_each <= _SPARSE_ROUND * usual)
        return found | self.class_in()

    def by_cell(self, squares: np.ndarray, rows: slice, columns: slice) -> np.ndarray:
        """Return values of squares, as `usual` returns them, for the cells of a window."""
        along = [np.arange(each.start, each.stop) // _SQUARE for each in (rows, columns)]
        return squares[np.ix_(*along)]
