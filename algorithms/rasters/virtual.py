"""Virtual rasters (.vrt): many rasters on a common grid, which programs show as one raster."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Mapping

from ..crs.wkt import with_unit_of_heights
from .geotiff import RasterGrid
from .writing import BLOCK_SIDE, Band

_TYPES = {"float32": "Float32", "uint8": "Byte"}


def folder_of(raster: Path) -> Path:
    """Return the folder of the rasters of single files, which has the name of the raster."""
    return raster.with_suffix("")


def virtual_of(raster: Path) -> Path:
    """Return the virtual raster that joins the rasters of single files."""
    return raster.with_suffix(".vrt")


def write_virtual(
    target: Path,
    folder: Path,
    grid: RasterGrid,
    parts: Mapping[Path, RasterGrid],  # equal where they overlap
    kind: str,  # "float32" or "uint8"
    band: Band,  # of the parts, or their bands
) -> None:
    """Write a virtual raster of parts that need not exist yet, as ``gdalbuildvrt`` does, with paths
    relative to the folder in which it will lie.
    """
    from html import escape

    transform = ", ".join(repr(float(number)) for number in grid.geotransform)
    lines = [
        f'<VRTDataset rasterXSize="{grid.columns}" rasterYSize="{grid.rows}">',
        f"<SRS>{escape(with_unit_of_heights(band.wkt))}</SRS>" if band.wkt else "",
        f"<GeoTransform>{transform}</GeoTransform>",
    ]
    for number, colour in enumerate(band.colours, 1):
        lines += [
            f'<VRTRasterBand dataType="{_TYPES[kind]}" band="{number}">',
            f"<Description>{escape(band.description)}</Description>",
            f"<UnitType>{escape(band.unit)}</UnitType>" if band.unit else "",
            f"<NoDataValue>{band.nodata}</NoDataValue>",
            f"<ColorInterp>{colour}</ColorInterp>" if len(band.colours) > 1 else "",
        ]
        for path, part in parts.items():
            name = escape(Path(os.path.relpath(path, folder)).as_posix())
            lines += _source(name, number, grid, part, kind)
        lines.append("</VRTRasterBand>")
    lines.append("</VRTDataset>")
    target.write_text(
        "\n".join(filter(None, lines)) + "\n", encoding="utf-8", errors="surrogateescape"
    )


def _source(name: str, number: int, grid: RasterGrid, part: RasterGrid, kind: str) -> list[str]:
    """Return the lines for a band of a part, given its escaped name."""
    column = round((part.west - grid.west) / grid.cell_size)
    row = round((grid.north - part.north) / grid.cell_size)
    size = f'xSize="{part.columns}" ySize="{part.rows}"'
    return [
        f'<SimpleSource><SourceFilename relativeToVRT="1">{name}</SourceFilename>',
        f"<SourceBand>{number}</SourceBand>" if number > 1 else "",
        # With these properties, GDAL opens a part only when its cells are needed.
        f'<SourceProperties RasterXSize="{part.columns}" RasterYSize="{part.rows}"'
        f' DataType="{_TYPES[kind]}" BlockXSize="{BLOCK_SIDE}" BlockYSize="{BLOCK_SIDE}"/>',
        f'<SrcRect xOff="0" yOff="0" {size}/><DstRect xOff="{column}" yOff="{row}" {size}/>',
        "</SimpleSource>",
    ]
