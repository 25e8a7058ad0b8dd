"""The cells of rasters that may be too large for the memory, read window by window."""

from __future__ import annotations

from typing import Any, Iterator, Protocol, Tuple

import numpy as np

from .content import Source
from .geotiff import HeightBand
from .sampling import HeightRaster, HeightSampler
from .stored import Stored

# Cells that are read at a time, and that stay until others are looked at.
_CELLS = 16_000_000
# Difference of two geotransforms, in cells, up to which the grids are the same.
_SAME = 1e-3
Window = Tuple[slice, slice]


class Windows(Protocol):
    """Cells that can be read by windows: a `RasterWindows`, or an array."""

    @property
    def shape(self) -> Any:
        """Numbers of rows and columns."""

    def __getitem__(self, window: Any, /) -> Any:
        """Return the cells of a window of rows and columns within the raster."""


class RasterWindows:
    """The cells of a raster file in the order of the file, times a factor; NaN without value."""

    def __init__(self, raster: HeightBand, factor: float = 1.0) -> None:
        self.shape, self.raster, self.stored = raster.whole, raster, raster.stored
        self._factor, self._first = np.float32(factor), 0
        self._held = np.zeros((0, raster.whole[1]), dtype=np.float32)

    def __getitem__(self, window: Window) -> np.ndarray:
        """Return the cells of a window within the raster; float32 (rows, columns)."""
        rows, columns = window
        start, end = max(rows.start, 0), min(rows.stop, self.shape[0])
        if start >= end:
            return self._held[:0, columns]
        if start < self._first or end > self._first + len(self._held):
            # Windows are mostly looked at from north to south.
            more = max(_CELLS // max(self.shape[1], 1), 1)
            first = max(start - more // 16, 0)
            self._first, self._held = first, self._read(first, max(end, first + more))
        held = slice(start - self._first, end - self._first)
        return self._held[held, slice(max(columns.start, 0), max(columns.stop, 0))]

    def _read(self, start: int, end: int) -> np.ndarray:
        end = min(end, self.shape[0])
        cells = np.full((end - start, self.shape[1]), np.nan, dtype=np.float32)
        for first, last in self.stored.runs(start, end):
            cells[:, first:last] = self.raster.rows(start, end, first, last)
        cells *= self._factor
        return cells


class SampledWindows:
    """Heights of a raster at the cells of another one, times a factor; NaN without value."""

    def __init__(
        self,
        source: Source,
        grid: HeightBand,
        factor: float,
        move: tuple[float, float] = (0.0, 0.0),
    ) -> None:
        self.shape, self.source = grid.whole, source
        self._grid, self._factor, self._move = grid, factor, move
        self._heights = HeightSampler(HeightRaster.of(source))

    def moved(self, move: tuple[float, float]) -> SampledWindows:
        """Return the same heights, moved on by units of the CRS."""
        east, north = self._move[0] + move[0], self._move[1] + move[1]
        return SampledWindows(self.source, self._grid, self._factor, (east, north))

    def __getitem__(self, window: Window) -> np.ndarray:
        """Return the cells of a window within the raster; float64 (rows, columns)."""
        rows, columns = (
            np.arange(max(part.start, 0), min(part.stop, count))
            for part, count in zip(window, self.shape)
        )
        column, row = np.meshgrid(columns + 0.5, rows + 0.5)
        x, a, b, y, c, d = self._grid.geotransform
        east, north = self._move
        places = x + a * column + b * row - east, y + c * column + d * row - north
        return self._heights.heights(*map(np.ravel, places)).reshape(column.shape) * self._factor


def is_same_grid(one: HeightBand, other: HeightBand) -> bool:
    """Return whether two rasters have the same cells."""
    size = abs(one.geotransform[1]) + abs(one.geotransform[2])
    # Differences of the sides of cells add up over the raster.
    scale = np.array([1.0, *[max(one.whole)] * 2] * 2)
    off = np.abs(np.subtract(one.geotransform, other.geotransform)) * scale
    return one.whole == other.whole and bool((off <= _SAME * size).all())


def stored_of(cells: Windows) -> Stored:
    """Return which parts of a raster are stored: the others have no data."""
    return cells.stored if isinstance(cells, RasterWindows) else Stored(cells.shape)


def parts_of(cells: Windows) -> Iterator[Window]:
    """Yield the windows of a raster that are stored, from north to south."""
    stored = stored_of(cells)
    for start, end in stored.strips(_CELLS // 2):
        for first, last in stored.runs(start, end):
            yield slice(start, end), slice(first, last)
