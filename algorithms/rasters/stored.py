"""Which parts of a large raster hold tiles: a sparse GeoTIFF leaves out those without data."""

from __future__ import annotations

import math
from typing import Any, Callable, Iterator, NamedTuple

import numpy as np

from .content import MemoryRaster, Source
from .libraries import library

# Rasters with fewer cells are read as a whole anyway.
_MANY = 64_000_000
# Cells: parts that tools make of a raster begin at multiples of this, as tiles that are written.
_STEP = 256
# Rows of a strip of a raster that leaves out tiles.
_ROWS = 512


class Stored(NamedTuple):
    """The tiles of a band that are stored; all, if `held` is None."""

    shape: tuple[int, int]  # rows and columns of the raster
    tile: tuple[int, int] = (1, 1)  # rows and columns of a tile
    held: np.ndarray | None = None  # bool (rows, columns) of tiles

    def step(self, cells: int) -> int:
        """Return the rows of strips, of about this many cells if all tiles are stored."""
        return _ROWS if self.held is not None else max(cells // max(self.shape[1], 1), 1)

    def strips(self, cells: int) -> Iterator[tuple[int, int]]:
        """Yield the first row of each strip, and that after its last."""
        rows, step = self.shape[0], self.step(cells)
        for start in range(0, rows, step):
            yield start, min(start + step, rows)

    def runs(self, start: int, end: int, margin: int = 0) -> list[tuple[int, int]]:
        """Return the columns, from first to before last, of the parts of some rows that are within
        a margin of tiles; the others have no data.
        """
        rows, columns = self.shape
        if self.held is None:
            return [(0, columns)]
        high, wide = self.tile
        low, top = max(start - margin, 0) // high, -(-min(end + margin, rows) // high)
        found: list[tuple[int, int]] = []
        for column in np.flatnonzero(self.held[low:top].any(axis=0)).tolist():
            first = max(column * wide - margin, 0) // _STEP * _STEP
            last = min(-(-((column + 1) * wide + margin) // _STEP) * _STEP, columns)
            if found and first <= found[-1][1]:
                found[-1] = found[-1][0], last
            else:
                found.append((first, last))
        return found

    def cells_of(self, cells: int, margin: int = 0) -> int | None:
        """Return the number of cells of all runs of all strips; None if all tiles are stored."""
        if self.held is None:
            return None
        return sum(
            (end - start) * (last - first)
            for start, end in self.strips(cells)
            for first, last in self.runs(start, end, margin)
        )


def stored_in(source: Source, band: int, shape: tuple[int, int]) -> Stored:
    """Return which tiles of a band of a raster are stored."""
    if isinstance(source, MemoryRaster) or math.prod(shape) < _MANY:
        return Stored(shape)
    tile, held = library(_held_by_gdal, _held_by_rasterio, "Reading")(str(source), band)
    return Stored(shape) if held is None or held.all() else Stored(shape, tile, held)


def _held_by_gdal(source: str, band: int) -> tuple[tuple[int, int], np.ndarray | None]:
    from osgeo import gdal

    dataset = gdal.Open(source, gdal.GA_ReadOnly)
    layer = dataset.GetRasterBand(band)
    wide, high = layer.GetBlockSize()
    if dataset.GetDriver().ShortName != "GTiff" or layer.GetNoDataValue() is None:
        return (high, wide), None
    shape = dataset.RasterYSize, dataset.RasterXSize
    return (high, wide), _held(
        lambda name: layer.GetMetadataItem(name, "TIFF"), shape, (high, wide)
    )


def _held_by_rasterio(source: str, band: int) -> tuple[tuple[int, int], np.ndarray | None]:
    import rasterio

    with rasterio.open(source) as dataset:
        tile: tuple[int, int] = dataset.block_shapes[band - 1]
        if dataset.driver != "GTiff" or dataset.nodatavals[band - 1] is None:
            return tile, None
        return tile, _held(
            lambda name: dataset.get_tag_item(name, "TIFF", band), dataset.shape, tile
        )


def _held(item: Callable[[str], Any], shape: tuple[int, int], tile: tuple[int, int]) -> np.ndarray:
    """Return which tiles have a place in the file, given its metadata by their names."""
    rows, columns = (-(-side // of_tile) for side, of_tile in zip(shape, tile))
    return np.array(
        [
            [item(f"BLOCK_OFFSET_{column}_{row}") is not None for column in range(columns)]
            for row in range(rows)
        ],
        dtype=bool,
    )
