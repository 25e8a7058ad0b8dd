"""The grid of a raster file, without its cells."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

from ..core.errors import BareEarthError
from .geotiff import NO_CELLS, read_content

# Sides of cells, and corners, may be off by this share of a cell over the whole raster.
_ROUNDING = 0.01


class GivenGrid(NamedTuple):
    """The grid of a raster whose cells are square, with north up."""

    west: float  # in units of the CRS
    north: float  # in units of the CRS
    cell_size: float  # in units of the CRS
    columns: int
    rows: int
    wkt: str  # empty if the raster states no CRS


def read_grid(source: str | Path) -> GivenGrid:
    """Read the grid of a raster file, or of a part as GDAL names it; refuse cells that are not
    square with north up.
    """
    content = read_content(source, window=NO_CELLS)
    (rows, columns), (west, width, tilt, north, lean, height) = content.shape, content.geotransform
    if height > 0.0 and width > 0.0 and not tilt and not lean:
        raise BareEarthError(
            f"{source} states no place on the map, or has south up. Give a raster with north up."
        )
    most = max(columns, rows)
    if max(abs(tilt), abs(lean)) * most > _ROUNDING * abs(width):
        raise BareEarthError(
            f"The cells of {source} are rotated. Give a raster with north up, such as gdalwarp"
            " makes."
        )
    if width <= 0.0 or abs(width + height) * most > _ROUNDING * width:
        raise BareEarthError(
            f"The cells of {source} are not square ({width:.10g} x {abs(height):.10g}). Give a"
            " raster with square cells, such as gdalwarp -tr makes."
        )
    return GivenGrid(west, north, width, columns, rows, content.wkt)
