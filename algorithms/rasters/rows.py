"""Rows of a raster file, read some at a time."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np

from ..core.points import Frame
from ..crs.system import unit_symbol
from ..crs.wkt import read_wkt
from .geotiff import NO_CELLS, frame_of, read_content, read_raster, stated_units


class RowsOfRaster(NamedTuple):
    """The first band of a raster file, of any size."""

    source: str | Path
    shape: tuple[int, int]  # rows and columns
    geotransform: tuple[float, ...]  # as of GDAL
    frame: Frame
    unit: str  # symbol of the unit of heights; empty if the file states neither unit nor CRS
    epsg: int | None

    @classmethod
    def of(cls, source: str | Path) -> RowsOfRaster:
        """Return a raster, of which no cell is read yet; errors are as for `read_raster`."""
        content = read_content(source, window=NO_CELLS)
        frame = frame_of(source, content)
        facts = read_wkt(content.wkt) if content.wkt else None
        is_stated = facts is not None or any(stated_units(content))
        unit = unit_symbol(frame.vertical_unit) if is_stated else ""
        epsg = facts.epsg if facts is not None else None
        return cls(source, content.shape, content.geotransform, frame, unit, epsg)

    def read(self, start: int, end: int) -> np.ndarray:
        """Return rows up to `end` or the last one as heights; float32, NaN where there is none."""
        rows, columns = self.shape
        window = 0, start, columns, min(end, rows) - start
        return read_raster(self.source, window=window).heights
