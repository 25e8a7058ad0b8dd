"""Virtual rasters (.vrt): many rasters on a common grid, which programs show as one raster."""

from __future__ import annotations

import os
from html import escape
from pathlib import Path
from typing import Mapping

from .geotiff import RasterGrid
from .writing import BLOCK_SIDE, Band

_TYPES = {"float32": "Float32", "uint8": "Byte"}


def write_virtual(
    target: Path,
    folder: Path,
    grid: RasterGrid,
    parts: Mapping[Path, RasterGrid],
    kind: str,
    band: Band,
) -> None:
    """Write a virtual raster, as ``gdalbuildvrt`` does. Its parts need not exist yet.

    Parameters
    ----------
    target : Path
        The file to write.
    folder : Path
        The folder in which it will lie. The paths of its parts are relative to this folder.
    grid : RasterGrid
        The grid of the virtual raster.
    parts : mapping of Path to RasterGrid
        The rasters and their grids. Where they overlap, their cells must be equal.
    kind : str
        Type of the cells, "float32" or "uint8".
    band : Band
        The band of the parts.
    """
    transform = ", ".join(repr(float(each)) for each in grid.geotransform)
    lines = [
        f'<VRTDataset rasterXSize="{grid.columns}" rasterYSize="{grid.rows}">',
        f"<SRS>{escape(grid.frame.wkt)}</SRS>" if grid.frame.wkt else "",
        f"<GeoTransform>{transform}</GeoTransform>",
        f'<VRTRasterBand dataType="{_TYPES[kind]}" band="1">',
        f"<Description>{escape(band.description)}</Description>",
        f"<NoDataValue>{band.nodata}</NoDataValue>",
    ]
    for path, part in parts.items():
        column = round((part.west - grid.west) / grid.cell_size)
        row = round((grid.north - part.north) / grid.cell_size)
        name = escape(Path(os.path.relpath(path, folder)).as_posix())
        size = f'xSize="{part.columns}" ySize="{part.rows}"'
        lines += [
            f'<SimpleSource><SourceFilename relativeToVRT="1">{name}</SourceFilename>',
            # With these properties, GDAL opens a part only when its cells are needed.
            f'<SourceProperties RasterXSize="{part.columns}" RasterYSize="{part.rows}"'
            f' DataType="{_TYPES[kind]}" BlockXSize="{BLOCK_SIDE}" BlockYSize="{BLOCK_SIDE}"/>',
            f'<SrcRect xOff="0" yOff="0" {size}/><DstRect xOff="{column}" yOff="{row}" {size}/>',
            "</SimpleSource>",
        ]
    lines += ["</VRTRasterBand>", "</VRTDataset>"]
    target.write_text(
        "\n".join(filter(None, lines)) + "\n", encoding="utf-8", errors="surrogateescape"
    )
