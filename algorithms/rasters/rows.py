"""Rows of a raster file, read some at a time."""

from __future__ import annotations

import contextlib
from pathlib import Path
from typing import Any, Callable, Iterator, NamedTuple

import numpy as np

from ..core.errors import BareEarthError
from ..core.points import Frame
from ..crs.system import unit_symbol
from ..crs.wkt import read_wkt
from .geotiff import Content, check_local, frame_of
from .libraries import GdalErrors, library


class RowsOfRaster(NamedTuple):
    """A band of an opened raster file.

    Attributes
    ----------
    shape : tuple of int
        Rows and columns.
    geotransform : tuple of float
        Geotransform of GDAL.
    frame : Frame
        The CRS and its units.
    unit : str
        Symbol of the unit of heights; empty if the file states neither unit nor CRS.
    epsg : int or None
        EPSG code of the CRS.
    read : callable
        ``read(start, end)`` returns rows as heights: float32, NaN where there is none.
    """

    shape: tuple[int, int]
    geotransform: tuple[float, ...]
    frame: Frame
    unit: str
    epsg: int | None
    read: Callable[[int, int], np.ndarray]


@contextlib.contextmanager
def raster_rows(source: str | Path) -> Iterator[RowsOfRaster]:
    """Open the first band of a raster file, to read some rows at a time.

    Raises
    ------
    BareEarthError
        As for `read_raster`, but a raster of any size can be read.
    """
    check_local(str(source))
    opened = library(_by_gdal, _by_rasterio, "Reading")
    with opened(str(source)) as (content, shape, description, read):
        frame = frame_of(source, content)

        def rows(start: int, end: int) -> np.ndarray:
            values, valid = read(start, min(end, shape[0]))
            heights = (values * content.scale + content.offset).astype(np.float32)
            heights[~(valid & np.isfinite(values))] = np.nan
            return heights

        facts = read_wkt(content.wkt) if content.wkt else None
        # The description that `write_geotiff` gives to bands of terrain models.
        unit = description.partition(", ")[2]
        if not unit and facts is not None:
            unit = unit_symbol(frame.vertical_unit)
        epsg = facts.epsg if facts is not None else None
        yield RowsOfRaster(shape, content.geotransform, frame, unit, epsg, rows)


@contextlib.contextmanager
def _by_gdal(source: str) -> Iterator[Any]:
    from osgeo import gdal

    with GdalErrors(gdal, "read") as errors:
        dataset = gdal.Open(source, gdal.GA_ReadOnly)
        errors.check(source)
        if dataset is None:
            raise BareEarthError(f"Cannot read {source}: it is not a raster that GDAL can read.")
        band, columns = dataset.GetRasterBand(1), dataset.RasterXSize
        scale, offset = band.GetScale(), band.GetOffset()
        content = Content(
            np.zeros(0), np.zeros(0), tuple(dataset.GetGeoTransform()), dataset.GetProjection(),
            band.GetUnitType() or "", 1.0 if scale is None else scale, offset or 0.0,
            (dataset.RasterYSize, columns),
        )  # fmt: skip

        def read(start: int, end: int) -> tuple[np.ndarray, np.ndarray]:
            window = 0, start, columns, end - start
            values, valid = (each.ReadAsArray(*window) for each in (band, band.GetMaskBand()))
            errors.check(source)
            return values, valid != 0

        yield content, content.shape, band.GetDescription() or "", read


@contextlib.contextmanager
def _by_rasterio(source: str) -> Iterator[Any]:
    import rasterio
    from rasterio.errors import RasterioError
    from rasterio.windows import Window

    try:
        with rasterio.open(source) as dataset:
            content = Content(
                np.zeros(0), np.zeros(0), dataset.transform.to_gdal(),
                dataset.crs.to_wkt() if dataset.crs else "", dataset.units[0] or "",
                dataset.scales[0], dataset.offsets[0], dataset.shape,
            )  # fmt: skip

            def read(start: int, end: int) -> tuple[np.ndarray, np.ndarray]:
                window = Window(0, start, dataset.width, end - start)
                return dataset.read(1, window=window), dataset.read_masks(1, window=window) != 0

            yield content, content.shape, dataset.descriptions[0] or "", read
    except RasterioError as error:
        raise BareEarthError(f"Cannot read {source}: {str(error).rstrip('.')}.") from error
