"""Square grid cells over points: the cell of each point, and the lowest point of each cell."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Sequence

import numpy as np

from ..core.errors import BareEarthError
from ..core.points import Points
from ..core.progress import SILENT
from ..core.threads import in_threads, over_parts, parts_of

_MOST_CELLS = 200_000_000  # most cells of a grid: a larger one would not fit into memory
_POINTS_A_PART = 1 << 17
_POINTS_A_COUNT = 1 << 20
_VALUES_A_PART = 1 << 16  # values whose minima are found at a time
# Rounds of `lower_at` before `numpy.minimum.at`, which takes eight times as long, finds the rest.
_ROUNDS = 6
_FEW = 16  # cells for each element from which on only the occupied cells are numbered
# Spacing: side in metres of the blocks in which points are counted. A block without points is a gap
# in the survey.
_BLOCK = 10.0
# If the bounding box of points would hold them this many times at the least spacing, this is
# returned without counting.
_SURELY = 4.0
_SPACING_STEP = 0.5  # step in metres to which the spacing is rounded by default


@dataclass(frozen=True)
class Cells:
    """A grid of square cells over points, usually with a corner at (0, 0) of the points' frame."""

    size: float  # side of a cell in metres
    first_row: int  # row of the first cell, counted from the south, where 0 begins at y = 0
    first_column: int  # its column, counted from the west, where 0 begins at x = 0
    rows: int
    columns: int
    index: np.ndarray  # int32 (n,): The cell of each point in the flattened grid

    @classmethod
    def over(cls, points: Points, size: float, shift: float = 0.0) -> Cells:
        """Return the cells of `size` metres over points (at least one), moved by `shift` metres to
        the west and south; refuse more cells than fit into memory.
        """
        first_column, first_row, last_column, last_row = (
            math.floor((extreme + shift) / size) for extreme in points.box
        )
        rows, columns = last_row - first_row + 1, last_column - first_column + 1
        if rows * columns > _MOST_CELLS:
            raise BareEarthError(
                f"The points spread over {columns * size:,.0f} x {rows * size:,.0f} m, too far for"
                f" cells of {size:g} m. Remove points with stray coordinates, or cut the file."
            )
        index = np.empty(points.count, dtype=np.int32)

        def fill(part: slice) -> None:
            row = np.floor((points.y[part] + shift) / size)
            row -= first_row
            row *= columns
            row += np.floor((points.x[part] + shift) / size) - first_column
            index[part] = row

        over_parts(fill, points.count, _POINTS_A_PART, SILENT)
        return cls(size, first_row, first_column, rows, columns, index)

    def wider(self, points: Points, size: float) -> Cells:
        """Return cells of a larger size over the same points, from cells without a shift: five
        times as fast as `over` if the size is a multiple of theirs.
        """
        side = round(size / self.size)
        if side * self.size != size:
            return Cells.over(points, size)
        (first_row, last_row), (first_column, last_column) = (
            (first // side, (first + count - 1) // side)
            for first, count in zip(self.first, self.shape)
        )
        rows, columns = last_row - first_row + 1, last_column - first_column + 1
        row = (self.first_row + np.arange(self.rows)) // side - first_row
        column = (self.first_column + np.arange(self.columns)) // side - first_column
        wide = (row[:, None] * columns + column).astype(np.int32).ravel()
        index = np.empty_like(self.index)

        def fill(part: slice) -> None:
            index[part] = wide.take(self.index[part])

        over_parts(fill, points.count, _POINTS_A_PART, SILENT)
        wider = Cells(size, first_row, first_column, rows, columns, index)
        counts = np.bincount(wide, self.counts.ravel(), minlength=rows * columns)
        wider.__dict__["counts"] = counts.astype(np.int32).reshape(rows, columns)
        return wider

    @property
    def first(self) -> tuple[int, int]:
        """Row and column of the first cell."""
        return self.first_row, self.first_column

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns."""
        return self.rows, self.columns

    def minimum(self, z: np.ndarray, selected: np.ndarray | slice = slice(None)) -> np.ndarray:
        """Return the lowest `z` (n,) of all or selected points in each cell, (rows, columns); NaN
        in cells without any.
        """
        lowest = np.full(self.rows * self.columns, np.inf)
        lower_at(lowest, self.index[selected], z[selected])
        lowest[np.isinf(lowest)] = np.nan
        return lowest.reshape(self.shape)

    def lowest_points(self, points: Points) -> np.ndarray:
        """Return the index of the lowest point of each occupied cell, in the order of the cells."""
        # Of equally low points of a cell, the one with the smallest x, then y, is taken, so that
        # the choice does not depend on the order of the points.
        keys = points.z, points.x, points.y
        found = first_of_each(self.index, self.rows * self.columns, *keys)
        return found[np.isfinite(points.z.take(found))]

    @cached_property
    def counts(self) -> np.ndarray:
        """Number of points in each cell; int32, shape (rows, columns)."""
        return self.counts_of(None)

    def counts_of(self, selected: np.ndarray | None) -> np.ndarray:
        """Return the number of selected points, a mask (n,) or None for all, in each cell."""
        counts = np.zeros(self.rows * self.columns, dtype=np.int32)
        for part in parts_of(len(self.index), _POINTS_A_COUNT):
            # Part by part, because bincount copies the indices as integers of 8 bytes.
            index = self.index[part]
            if selected is not None:
                index = index.take(np.flatnonzero(selected[part]))
            step = np.bincount(index)
            counts[: len(step)] += step
        return counts.reshape(self.shape)

    def points_in(self, cells: np.ndarray) -> np.ndarray:
        """Return the indices of the points in the marked cells (rows, columns), in their order."""
        marked = cells.ravel()

        def found(part: slice) -> np.ndarray:
            return np.flatnonzero(marked.take(self.index[part])) + part.start

        parts = parts_of(len(self.index), _POINTS_A_PART)
        return np.concatenate(in_threads(found, parts) or [np.empty(0, dtype=np.intp)])

    def spacing(self, counts: np.ndarray, dense: float = 1.0, step: float = _SPACING_STEP) -> float:
        """Return the spacing of points in metres, as the function `spacing`, from their number in
        each cell.
        """
        return _rounded(self._apart(counts), dense, step)

    def _apart(self, counts: np.ndarray) -> float:
        """Return the spacing of points in metres before it is rounded."""
        side = max(1, round(_BLOCK / self.size))
        for axis, (first, count) in enumerate(zip(self.first, self.shape)):
            starts = np.unique((first + np.arange(count)) // side, return_index=True)[1]
            counts = np.add.reduceat(counts, starts, axis=axis)
        return side * self.size / math.sqrt(usual_count(counts))

    @cached_property
    def occupied(self) -> np.ndarray:
        """Whether each cell has a point; boolean, shape (rows, columns)."""
        return self.holding(slice(None))

    def holding(self, selected: np.ndarray | slice) -> np.ndarray:
        """Return which cells hold any of the selected points; boolean, shape (rows, columns)."""
        holding = np.zeros(self.rows * self.columns, dtype=bool)
        holding[self.index[selected]] = True
        return holding.reshape(self.shape)

    def interpolated(self, grid: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Interpolate a grid (rows, columns) bilinearly between the centres of cells to places in
        metres; beyond the outermost centres, values are those of the border.
        """
        from scipy import ndimage

        row = y / self.size - (self.first_row + 0.5)
        column = x / self.size - (self.first_column + 0.5)
        return ndimage.map_coordinates(grid, (row, column), order=1, mode="nearest")

    def resampled(self, grid: np.ndarray, cells: Cells) -> np.ndarray:
        """Return a grid on other cells: at each the value of the cell that holds its centre, or of
        the border beyond this grid.
        """
        places = []
        for start, count, first, end in zip(cells.first, cells.shape, self.first, self.shape):
            centres = (start + np.arange(count) + 0.5) * cells.size / self.size
            places.append(np.clip(np.floor(centres).astype(int) - first, 0, end - 1))
        return grid[np.ix_(*places)]


def first_of_each(index: np.ndarray, size: int, *keys: np.ndarray) -> np.ndarray:
    """Return the index of the first element of each occupied cell by some keys, intp (m,), in the
    order of the `size` cells.
    """
    # The first element of a cell has the least first key. Between equal ones, the next key decides.
    if _FEW * len(index) < size:  # so that the time depends on the elements, not on the cells
        occupied, index = np.unique(index, return_inverse=True)
        size = len(occupied)
    found, least = np.full(size, -1, dtype=np.intp), np.full(size, np.inf)
    candidates, cell = None, index  # the elements between which the next key decides, None for all
    if not keys:
        found[index] = np.arange(len(index))
    for key in keys:
        values = key if candidates is None else key.take(candidates)
        lowest = lower_at(least, cell, values)
        lowest = lowest[values.take(lowest) == least.take(cell.take(lowest))]
        candidates, cell = (
            lowest if candidates is None else candidates.take(lowest),
            cell.take(lowest),
        )
        found[cell] = candidates  # of elements with equal keys, the last one
        equal = cell[found.take(cell) != candidates]
        if not len(equal):
            break
        # The next key is compared only in the few cells with several such elements.
        several = np.zeros(size, dtype=bool)
        several[equal], least[equal] = True, np.inf
        undecided = np.flatnonzero(several.take(cell))
        candidates, cell = candidates.take(undecided), cell.take(undecided)
    return found[found >= 0]


def in_order(index: np.ndarray) -> np.ndarray:
    """Return the stable order of whole numbers from 0 to 2**31, int64 (n,), five times as fast as
    `argsort`.
    """
    keys = index.astype(np.int64) << 32
    keys |= np.arange(len(index))
    keys.sort()
    keys &= 0xFFFFFFFF
    return keys


def cells_at(
    x: np.ndarray, y: np.ndarray, size: float, corner: Sequence[float] = (0.0, 0.0)
) -> tuple[np.ndarray, np.ndarray]:
    """Return row and column, int64 (n,), of the square cells that hold places, counted from a
    corner.
    """
    row, column = (
        np.floor((places - start) / size).astype(np.int64)
        for places, start in ((y, corner[1]), (x, corner[0]))
    )
    return row, column


def are_inside(row: np.ndarray, column: np.ndarray, shape: tuple[int, ...]) -> np.ndarray:
    """Return which rows and columns lie in a grid of the given shape; boolean, shape (n,)."""
    return (row >= 0) & (row < shape[0]) & (column >= 0) & (column < shape[1])


def numbered(counts: np.ndarray) -> np.ndarray:
    """Return runs of 0, 1, ... of the given lengths, one after the other: 0, 1, 0, 1, 2 for
    [2, 0, 3].
    """
    starts = np.cumsum(counts) - counts
    return np.arange(int(counts.sum())) - np.repeat(starts, counts)


def lower_at(target: np.ndarray, index: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Lower elements of an array to values (n,), given the index of each value, as
    `numpy.minimum.at`; return where in `values` the least of each element are, and some others.
    """
    found = [np.empty(0, dtype=np.intp)]
    for part in parts_of(len(index), _VALUES_A_PART):
        lower = np.flatnonzero(values[part] <= target.take(index[part]))
        left, below = index[part].take(lower), values[part].take(lower)
        cells, least = left, below
        for _ in range(_ROUNDS):
            if not len(cells):
                break
            target[cells] = least  # of several values for one element, the last one
            again = np.flatnonzero(least < target.take(cells))
            cells, least = cells.take(again), least.take(again)
        else:
            np.minimum.at(target, cells, least)
        found.append(lower[below <= target.take(left)] + part.start)
    return np.concatenate(found)


def spacing(points: Points, dense: float = 1.0, step: float = _SPACING_STEP) -> float:
    """Return the spacing of points, their usual distance in metres: at least `dense`, and rounded,
    from a metre on to `step`.
    """
    # It follows from the median number of points in blocks of 10 m within the survey. So gaps, the
    # extent and single points do not change it. Below a metre, it is rounded to densities that
    # differ by a factor of two. So a part of a survey nearly always has the same spacing.
    area = math.prod(points.sides)
    if _SURELY * area <= dense**2 * points.count:
        return dense
    if "apart" not in points.found:
        keep_spacing(points, points)
    return _rounded(points.found["apart"], dense, step)


def keep_spacing(points: Points, sample: Points) -> None:
    """Let `spacing` return for points the spacing of a sample of them."""
    blocks = Cells.over(sample, _BLOCK)
    points.found["apart"] = blocks._apart(blocks.counts)


def _rounded(apart: float, dense: float, step: float) -> float:
    """Return a spacing as a coarse step; see `spacing`."""
    if apart >= 1.0:
        return max(dense, step * round(apart / step))
    return max(dense, 2.0 ** (round(2.0 * math.log2(apart)) / 2.0))


def usual_count(counts: np.ndarray) -> float:
    """Return the median number of points in blocks within the survey, given a grid of counts."""
    from scipy import ndimage

    within = ndimage.binary_erosion(counts > 0, np.ones((3, 3)))
    return float(np.median(counts[within if within.any() else counts > 0]))
