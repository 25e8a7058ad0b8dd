"""Counts and lowest heights of the points in the cells of a survey, from which water is found."""

from __future__ import annotations

import math
from typing import Iterator, Sequence

import numpy as np

from ...core.errors import BareEarthError
from ...core.points import Box, Points
from ...core.progress import SILENT, Progress
from ...grids.cells import are_inside, cells_at, lower_at

# Rows and columns of a part of a grid.
Window = tuple[slice, slice]
# Most cells of a survey, at 13 bytes each; up to 2 GB while water is found.
_MOST_CELLS = 60_000_000
# The rest of them is for cells that only touch the extent.
_SHARE_FOR_BORDERS = 0.99
# Cells that become larger in a large survey stay so small that the narrowest river of the Lidar
# Base Specification, 30 m, is six cells wide.
_LARGEST_CELL = 5.0
_MOST_COUNT = np.iinfo(np.uint16).max
# Side of a cell in spacings of the points: with four last returns, an empty one is hardly chance.
_CELL_IN_SPACINGS = 2.0
_LEAST_CELL = 1.0  # m
_STEP = 0.5  # step to which the side is rounded, m
_SQUARE = 32  # side of the squares in which the usual count is found, cells
_SQUARES = 8  # squares on each side of one that take part
# The usual count is at least this share of that of the whole survey.
_OF_SURVEY = 0.35
_SPARSE = 0.25  # largest share of the usual count of a sparse cell
# The same of the nine cells round it on average: along a straight shore six of nine are land.
_SPARSE_ROUND = 0.6
# Share of class 9 among the last returns from which a cell is water.
_CLASS_SHARE = 0.5


def cell_for(area: float, count: int, size: float | None = None, extent: float = 0.0) -> float:
    """Return the side in metres of the cells for a survey: `size`, or by the spacing of the points
    on an area in square metres; with a large extent they are larger, to fit into memory.
    """
    if size is not None:
        return size
    spacing = math.sqrt(area / max(count, 1))
    fine = max(_LEAST_CELL, math.ceil(_CELL_IN_SPACINGS * spacing / _STEP) * _STEP)
    return max(fine, min(_smallest_cell(extent), _LARGEST_CELL))


def _smallest_cell(extent: float) -> float:
    """Return the smallest side of cells that are not too many in an area of square metres."""
    return math.ceil(math.sqrt(extent / (_SHARE_FOR_BORDERS * _MOST_CELLS)) / _STEP) * _STEP


class WaterGrid:
    """The cells of a piece of a survey with a box in metres, counted from (0, 0) of its frame, with
    rows from south to north.
    """

    def __init__(self, box: Box, cell: float) -> None:
        west, south, east, north = (math.floor(side / cell) for side in box)
        self.cell, self.row, self.column = cell, south, west
        self.shape = north - south + 1, east - west + 1
        # Lowest last return and lowest ground point in metres; infinite without such points.
        self.lowest, self.ground = (np.full(self.shape, np.inf, np.float32) for _ in range(2))
        # Last returns, and those of class 9.
        self.counts, self.water = (np.zeros(self.shape, np.uint16) for _ in range(2))
        self.decks = np.zeros(self.shape, dtype=bool)  # cells with points of decks of bridges

    def add(
        self,
        points: Points,
        ground: np.ndarray,
        water: np.ndarray,
        last: np.ndarray,
        decks: np.ndarray,
    ) -> None:
        """Add points, in the frame of the survey, and which are ground, of class 9, last returns,
        and on the decks of bridges; bool (n,).
        """
        row, column = cells_at(points.x, points.y, self.cell)
        row, column = row - self.row, column - self.column
        # An extent in a header can be a little too small.
        inside = are_inside(row, column, self.shape)
        cells = np.where(inside, row * self.shape[1] + column, -1)
        for counts, mask in ((self.counts.ravel(), last), (self.water.ravel(), last & water)):
            places, more = np.unique(cells[mask & inside], return_counts=True)
            counts[places] = np.minimum(counts[places] + more, _MOST_COUNT)
        for heights, mask in ((self.lowest.ravel(), last), (self.ground.ravel(), ground)):
            lower_at(heights, cells[mask & inside], points.z[mask & inside].astype(np.float32))
        self.decks.ravel()[cells[decks & inside]] = True

    def meets(self, box: Box) -> bool:
        """Return whether a box in metres touches the cells."""
        west, south, east, north = np.divide(box, self.cell)
        return bool(
            west <= self.column + self.shape[1]
            and east >= self.column
            and south <= self.row + self.shape[0]
            and north >= self.row
        )

    def class_in(self, window: Window = (slice(None), slice(None))) -> np.ndarray:
        """Return which cells of a window have mostly points of class 9; bool."""
        water, counts = self.water[window], self.counts[window]
        return (water > 0) & (water >= _CLASS_SHARE * counts)

    def usual(self) -> np.ndarray:
        """Return the usual count of last returns round each square of cells; float64."""
        # It is the mean over squares, each weighted by its own count: voids do not lower it.
        from scipy.ndimage import uniform_filter

        starts = [np.arange(0, side, _SQUARE) for side in self.shape]
        sums = np.add.reduceat(self.counts, starts[0], axis=0, dtype=np.int64)
        sums = np.add.reduceat(sums, starts[1], axis=1)
        sides = [np.diff(np.append(first, side)) for first, side in zip(starts, self.shape)]
        means = sums / np.multiply.outer(*sides)
        size = 2 * _SQUARES + 1
        squared, plain = (
            uniform_filter(values, size, mode="constant") for values in (means**2, means)
        )
        everywhere = float((means**2).sum() / max(means.sum(), 1e-9))
        return np.maximum(squared / np.maximum(plain, 1e-9), _OF_SURVEY * everywhere)

    def candidates(self) -> np.ndarray:
        """Return which cells may be water: sparse ones, and those of class 9."""
        from scipy.ndimage import uniform_filter

        counts = self.counts.astype(np.float32)
        of_nine = uniform_filter(counts, 3, mode="nearest")
        whole = slice(0, self.shape[0]), slice(0, self.shape[1])
        usual = self.by_cell(self.usual().astype(np.float32), whole)
        return ((counts <= _SPARSE * usual) & (of_nine <= _SPARSE_ROUND * usual)) | self.class_in()

    def by_cell(self, squares: np.ndarray, window: Window) -> np.ndarray:
        """Return values of squares, as `usual` returns them, for the cells of a window."""
        return squares[np.ix_(*(np.arange(side.start, side.stop) // _SQUARE for side in window))]

    def surveyed(self) -> np.ndarray:
        """Return which cells lie within the survey, the convex hull of the cells with points."""
        from scipy.spatial import ConvexHull

        full = self.counts > 0
        rows = np.flatnonzero(full.any(axis=1))
        if not len(rows):
            return ~full
        first = full[rows].argmax(axis=1)
        last = full.shape[1] - full[rows, ::-1].argmax(axis=1)
        corners = [np.column_stack((rows + up, side)) for up in (0, 1) for side in (first, last)]
        hull = ConvexHull(np.concatenate(corners))
        ring = hull.points[hull.vertices]
        ring = np.roll(ring, -ring[:, 0].argmin(), axis=0)
        ring = np.concatenate((ring, ring[:1]))
        top = ring[:, 0].argmax()
        middles = np.arange(len(full)) + 0.5
        sides = [
            np.interp(middles, side[:, 0], side[:, 1], left=np.nan, right=np.nan)
            for side in (ring[: top + 1], ring[top:][::-1])
        ]
        low, high = np.minimum(*sides), np.maximum(*sides)
        centres = np.arange(full.shape[1]) + 0.5
        return (centres >= low[:, None]) & (centres <= high[:, None])


def grids_of(boxes: Sequence[Box], cell: float) -> list[WaterGrid]:
    """Return the grids of the pieces of a survey, boxes in metres; refuse too many cells."""
    sides = (np.floor(np.divide(box, cell)) for box in boxes)
    count = sum(int((north - south + 1) * (east - west + 1)) for west, south, east, north in sides)
    if count > _MOST_CELLS:
        least = _smallest_cell(count * cell**2)
        raise BareEarthError(
            f"Cells of {cell:g} m would be {count:,} in this survey, and"
            f" {_MOST_CELLS:,} is the most. Choose cells of {least:g} m, or give fewer files."
        )
    return [WaterGrid(box, cell) for box in boxes]


def regions_of(
    cells: np.ndarray, least: float = 1.0, reach: float = math.inf, progress: Progress = SILENT
) -> Iterator[tuple[Window, np.ndarray]]:
    """Yield the connected regions of at least `least` cells, bool, each in a window that goes
    `reach` cells beyond it.
    """
    from scipy.ndimage import find_objects, label

    labels, count = label(cells)
    sizes = np.bincount(labels.ravel())
    for number, box in enumerate(find_objects(labels), start=1):
        progress(number / count)
        if sizes[number] >= least:
            rows, columns = (
                slice(int(max(side.start - reach, 0)), int(min(side.stop + reach, end)))
                for side, end in zip(box, cells.shape)
            )
            yield (rows, columns), labels[rows, columns] == number
