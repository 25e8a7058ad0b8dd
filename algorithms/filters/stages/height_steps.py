"""The steps between the cells of a height grid, and the rims and regions that they make."""

from __future__ import annotations

from typing import NamedTuple, Sequence

import numpy as np

from ...core.threads import in_threads
from ..height_grid import HeightGrid
from ..trend import Rises, Trend
from .regions import Border, Regions

# East, north and the two diagonals: with their opposites, the eight neighbours of a cell.
_DIRECTIONS = ((0, 1), (1, 0), (1, 1), (1, -1))
# Distance in metres over which heights are compared, or the side of a cell if that is larger. Over
# a shorter one, a point half-way up a wall, or a filled gap between roof and ground, makes a
# staircase of low steps.
_STEP = 1.0
# Cells whose steps are computed at a time, so that they stay in the processor's cache.
_CELLS_A_STRIP = 1 << 15
# Passes in which rim cells join a region beside them that is level with them.
_JOINING_PASSES = 2
# Passes in which cells that are level with the ground beside them become ground again.
_GROWING_PASSES = 4
# Relaxations of the surface across gaps. Few are enough, because objects end at rims, whatever the
# filling of gaps.
_RELAXATIONS = 2


class HeightSteps:
    """The steps between cells of a height grid that are higher than the trend of the terrain."""

    # `grid`: Lowest height of each cell.
    # `inside`: bool (rows, columns): Cells that were surveyed (see `covered`); nothing is known of
    # the others.

    def __init__(self, grid: HeightGrid, inside: np.ndarray) -> None:
        size, surface = grid.size, grid.filled(_RELAXATIONS).astype(np.float32)
        self._known_heights = grid.values
        self._trend = Trend(surface, size, grid.origin)
        self._size, self._step = size, max(round(_STEP / size), 1)
        # A frame without heights round the grid, so that each neighbour is at a fixed offset.
        self._inside = np.pad(inside, self._step)
        self._heights = np.pad(surface, self._step, constant_values=np.nan).ravel()

    @property
    def filled(self) -> np.ndarray:
        """The heights with gaps filled; float32, shape (rows, columns)."""
        return self._unframed(self._heights.reshape(self._inside.shape))

    def regions(self, threshold: float) -> Regions:
        """Return the regions between rims: cells that are higher than a neighbour by more than a
        threshold in metres, plus the rise of the terrain and its usual unevenness.
        """
        # A rim cell belongs to the region beside it that is level with it, as the edge of a roof
        # does. Rim cells without such a region, as those of a thin tree, are regions of their own.
        (steps,) = self._steps(threshold)
        return self._regions(steps)

    def regions_and_rims(
        self, threshold: float, roughness_factor: float
    ) -> tuple[Regions, np.ndarray]:
        """Return the `regions`, and the cells that are rims with `roughness_factor` times the usual
        unevenness of the terrain.
        """
        steps, large = self._steps(threshold, (1.0, roughness_factor))
        return self._regions(steps), self._unframed(self._rims(large))

    def _regions(self, steps: list[_Steps]) -> Regions:
        from scipy import ndimage

        rim = self._rims(steps)
        regions, count = ndimage.label(self._inside & ~rim)
        flat = regions.ravel()
        cells = np.flatnonzero(rim)
        for _ in range(_JOINING_PASSES):
            self._join(flat, cells, steps)
            cells = cells[flat[cells] == 0]
        rest = np.zeros(flat.size, dtype=bool)
        rest[cells] = True
        rest_regions, rest_count = ndimage.label(rest.reshape(rim.shape), np.ones((3, 3)))
        flat[cells] = rest_regions.ravel()[cells] + count
        border = self._border(flat, count + rest_count + 1, steps)
        return self._regions_of(regions, border)

    def pits(self, candidates: np.ndarray, threshold: float, max_size: float) -> np.ndarray:
        """Return the candidates in pits: in patches of candidates, at most `max_size` metres wide,
        whose border rises by more than a threshold in metres nearly all round.
        """
        from scipy import ndimage

        patches, count = ndimage.label(np.pad(candidates, self._step), np.ones((3, 3)))
        patches[(patches == 0) & self._inside] = count + 1
        border = self._border(patches.ravel(), count + 2, *self._steps(threshold))
        return self._regions_of(patches, border).sunken(max_size) & candidates

    def _regions_of(self, number: np.ndarray, border: Border) -> Regions:
        """Return regions, given their numbers on the grid with its frame, and their borders."""
        return Regions(self._unframed(number), border, self._size, self._step, self._known_heights)

    def regrown(self, kept: np.ndarray, heights: np.ndarray, threshold: float) -> np.ndarray:
        """Return the kept cells of ground, and those with a height that are level with the mean of
        the kept ones beside them.
        """
        kept = np.pad(kept, self._step).ravel()
        grid = np.pad(heights.astype(np.float32), self._step, constant_values=np.nan).ravel()
        cells = np.flatnonzero(np.isfinite(grid) & ~kept)
        trend = self._trend.of_cells(*self._places(cells))
        for _ in range(_GROWING_PASSES):
            rises, count = np.zeros(len(cells), np.float32), np.zeros(len(cells), np.float32)
            for row, column in _DIRECTIONS:
                offset = row * self._inside.shape[1] + column
                ahead = row * trend.north + column * trend.east
                for neighbour, expected in ((cells + offset, ahead), (cells - offset, -ahead)):
                    rise = grid[neighbour] - grid[cells] - expected
                    rises += np.where(kept[neighbour], rise, 0)
                    count += kept[neighbour]
            allowed = threshold + trend.steepest + trend.roughness
            level = (count > 0) & (np.abs(rises) <= allowed * count)
            kept[cells[level]] = True
            cells = cells[~level]
            trend = Rises(*(values[~level] for values in trend))
        return self._unframed(kept.reshape(self._inside.shape))

    def _unframed(self, grid: np.ndarray) -> np.ndarray:
        return grid[self._step : -self._step, self._step : -self._step]

    def _steps(
        self, threshold: float, roughness_factors: Sequence[float] = (1.0,)
    ) -> list[list[_Steps]]:
        """Return the steps in each of the four directions, for each factor of the unevenness."""
        width = self._inside.shape[1]
        directions = [(row * self._step, column * self._step) for row, column in _DIRECTIONS]
        offsets = [row * width + column for row, column in directions]
        steps = [
            [
                _Steps(*direction, offset, np.empty(self._heights.size - offset, dtype=np.int8))
                for direction, offset in zip(directions, offsets)
            ]
            for _ in roughness_factors
        ]
        strip = max(_CELLS_A_STRIP // width, 1)

        def fill(first: int) -> None:
            trend = self._trend_of_rows(first, min(first + strip, len(self._inside)))
            for same_direction in zip(*steps):
                self._compare(same_direction, first * width, trend, threshold, roughness_factors)

        in_threads(fill, range(0, len(self._inside), strip))
        return steps

    def _compare(
        self,
        steps: Sequence[_Steps],
        start: int,
        trend: Rises,
        threshold: float,
        roughness_factors: Sequence[float],
    ) -> None:
        """Fill in the signs of one direction for the cells of `trend`, from cell `start` on."""
        step = steps[0]
        end = min(start + trend.north.size, step.sign.size)
        if end <= start:
            return
        rise = self._heights[start + step.offset : end + step.offset] - self._heights[start:end]
        north, east, steepest, roughness = (values[: end - start] for values in trend)
        if step.row:
            rise -= np.float32(step.row) * north
        if step.column:
            rise -= np.float32(step.column) * east
        for signs, factor in zip(steps, roughness_factors):
            allowed = steepest + np.float32(factor) * roughness
            allowed *= np.float32(np.hypot(step.row, step.column))
            allowed += np.float32(threshold)
            higher = (rise > allowed).view(np.int8)
            np.subtract(higher, (rise < -allowed).view(np.int8), out=signs.sign[start:end])

    def _trend_of_rows(self, first: int, last: int) -> Rises:
        """Return the trend at each cell of some rows with their frame, where it is 0."""
        inner = slice(max(first - self._step, 0), max(last - self._step, 0))
        rows = self._inside.shape[0] - 2 * self._step
        rises = self._trend.of_rows(inner.start, min(inner.stop, rows))
        above = inner.start + self._step - first
        framed = []
        for rise in rises:
            grid = np.zeros((last - first, self._inside.shape[1]), dtype=np.float32)
            height = min(inner.stop, rows) - inner.start
            if height > 0:
                grid[above : above + height, self._step : -self._step] = rise
            framed.append(grid.ravel())
        return Rises(*framed)

    def _places(self, cells: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return row and column of cells; a cell of the frame has those of the cell beside it."""
        rows, columns = (side - 2 * self._step for side in self._inside.shape)
        row, column = np.divmod(cells, self._inside.shape[1])
        row, column = row - self._step, column - self._step
        return np.clip(row, 0, rows - 1), np.clip(column, 0, columns - 1)

    def _rise(self, cells: np.ndarray, step: _Steps, backward: bool = False) -> np.ndarray:
        """Return the rise from some cells to their neighbours in one direction, or its opposite."""
        first = cells - step.offset if backward else cells
        rise = self._heights[first + step.offset] - self._heights[first]
        rise -= self._trend.along(*self._places(first), step.row, step.column)
        return -rise if backward else rise

    def _rims(self, steps: list[_Steps]) -> np.ndarray:
        rim = np.zeros(self._inside.size, dtype=bool)
        for step in steps:
            rim[: -step.offset] |= step.sign < 0
            rim[step.offset :] |= step.sign > 0
        return rim.reshape(self._inside.shape) & self._inside

    def _join(self, regions: np.ndarray, cells: np.ndarray, steps: list[_Steps]) -> None:
        """Let cells without a region join the region of the neighbour that is nearest in height."""
        least = np.full(len(cells), np.inf, dtype=np.float32)
        joined = np.zeros(len(cells), dtype=regions.dtype)
        for step in steps:
            for backward in (False, True):
                neighbour = cells - step.offset if backward else cells + step.offset
                level = step.sign[neighbour if backward else cells] == 0
                joining = np.flatnonzero(level & (regions[neighbour] > 0))
                rise = np.abs(self._rise(cells[joining], step, backward))
                better = rise < least[joining]
                joining = joining[better]
                least[joining] = rise[better]
                joined[joining] = regions[neighbour[joining]]
        regions[cells] = joined

    def _border(self, regions: np.ndarray, count: int, steps: list[_Steps]) -> Border:
        parts = []
        for step in steps:
            cells = np.flatnonzero(regions[: -step.offset] != regions[step.offset :])
            sign = step.sign[cells]
            rise = np.zeros(len(cells), dtype=np.float32)
            stepped = np.flatnonzero(sign)
            rise[stepped] = self._rise(cells[stepped], step)
            pairs = np.stack((cells, cells + step.offset), axis=1).astype(np.int32)
            parts.append((regions[cells], regions[cells + step.offset], sign, rise, pairs))
        return Border(count, *(np.concatenate(values) for values in zip(*parts)))


class _Steps(NamedTuple):
    """The steps between cells and their neighbours in one direction."""

    row: int  # rows from a cell to its neighbour
    column: int  # columns
    offset: int  # from a cell to its neighbour, in the flattened grid
    # int8: 1 where the neighbour is higher by more than is allowed, -1 where it is lower, else 0.
    sign: np.ndarray
