"""Reads the cells of raster files, and what the files state about them."""

from __future__ import annotations

import os
import re
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Callable, Iterator, NamedTuple, Union

import numpy as np

from ..core.errors import BareEarthError
from ..core.progress import Progress
from .libraries import GdalErrors, library
from .undeclared import Undeclared, suspects, undeclared_in

MOST_CELLS = 400_000_000  # most cells of a raster in memory
MOST_WITH_EMPTY = 100 * MOST_CELLS  # of rasters that are empty for the most part
# Names of files that GDAL would download, and names of parts of a file.
_REMOTE = re.compile(r"[a-z][a-z0-9+.-]+://|/vsi", re.IGNORECASE)
_PART = re.compile(r'[A-Z][A-Z0-9_]+:"?(?P<file>.+?)"?(:[^:\\/]*)?$')
_DESCRIPTION = 1 << 20  # bytes of a file that are searched for such names
# First column and row, and numbers of columns and rows.
Window = tuple[int, int, int, int]
NO_CELLS: Window = (0, 0, 0, 0)  # to read what a file states, but none of its cells
_CELLS = 4_000_000  # cells that are read at a time to search values for no data
# The undeclared values of the last files in which a usual value for no data occurred.
_FOUND: dict[tuple[object, ...], Undeclared] = {}
_MOST_FOUND = 64


class Content(NamedTuple):
    """Cells of a band, and what the file states about them; texts are empty without a statement."""

    values: np.ndarray
    valid: np.ndarray  # bool, in the shape of the values
    geotransform: tuple[float, ...]  # as of GDAL
    wkt: str
    unit: str  # of the band
    scale: float
    offset: float
    shape: tuple[int, int]  # rows and columns of the whole file
    description: str  # of the band
    colour: str  # what a band of bytes shows, as GDAL names it


@dataclass(frozen=True, eq=False)
class MemoryRaster:
    """A raster in memory, which tools read like a file."""

    content: Content  # with values and `valid` of shape (bands, rows, columns)
    name: str
    undeclared: Undeclared  # values that are no terrain, whose cells are not valid

    @classmethod
    def of(cls, content: Content, name: str) -> MemoryRaster:
        """Return a raster, in which cells with an undeclared value for no data are not valid."""
        found = undeclared_in(zip(content.values, content.valid))
        valid = content.valid
        if found.counts:
            valid = valid & ~found.among(content.values, valid)
        return cls(content._replace(valid=valid), name, found)

    def __str__(self) -> str:
        """Return the name, for messages."""
        return self.name

    def read(self, band: int, window: Window | None) -> Content:
        """Return a band, as `read_content`."""
        content = self.content
        _check_size(self.name, band, len(content.values), content.shape, window)
        column, row, columns, rows = window or (0, 0, *content.shape[::-1])
        part = band - 1, slice(row, row + rows), slice(column, column + columns)
        return content._replace(values=content.values[part], valid=content.valid[part])


Source = Union[str, Path, MemoryRaster]


def read_content(source: Source, band: int = 1, window: Window | None = None) -> Content:
    """Read a band as `read_raster`, but as it is and in any CRS; cells with a value for no data,
    declared or not, are not valid.
    """
    if isinstance(source, MemoryRaster):
        return source.read(band, window)
    read = partial(library(_read_with_gdal, _read_with_rasterio, "Reading"), str(source), band)
    _check_local(str(source))
    content = read(window)
    suspect = suspects(content.values, content.valid)
    if suspect.any():
        key = _key(source, band)
        if key not in _FOUND:
            while len(_FOUND) >= _MOST_FOUND:
                _FOUND.pop(next(iter(_FOUND)), None)
            _FOUND[key] = undeclared_in(_parts(read, content.shape))
        content.valid[_FOUND[key].among(content.values, suspect)] = False
    return content


def report_undeclared(source: Source, band: int, progress: Progress) -> None:
    """Warn of undeclared values for no data that occurred in a raster."""
    if isinstance(source, MemoryRaster):
        found: Undeclared | None = source.undeclared
    else:
        found = _FOUND.get(_key(source, band))
    if found and found.counts:
        progress.warning(found.text(source))


def _key(source: Source, band: int) -> tuple[object, ...]:
    """Return a key for a band of a file, which differs after the file has changed."""
    state = os.stat(str(source)) if os.path.exists(str(source)) else None
    return str(source), band, state and (state.st_size, state.st_mtime_ns)


def _parts(
    read: Callable[[Window], Content], shape: tuple[int, int]
) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Yield the cells of a whole raster, some rows at a time, and which of them are valid."""
    rows, columns = shape
    step = max(_CELLS // columns, 1)
    for start in range(0, rows, step):
        content = read((0, start, columns, min(step, rows - start)))
        yield content.values, content.valid


def _check_local(source: str) -> None:
    """Refuse a URL, and files such as VRT that contain one, because GDAL would download it."""
    if any("\ud800" <= character <= "\udfff" for character in source):
        raise BareEarthError(f"The name of {source} is not UTF-8, which GDAL needs. Rename it.")
    part = _PART.match(source)
    path = Path(source if os.path.exists(source) or part is None else part["file"])
    is_remote = _REMOTE.search(source) is not None
    if not is_remote and path.is_file():
        with open(path, "rb") as file:
            # Rasters are binary; descriptions of rasters for GDAL are XML or JSON.
            start = file.read(_DESCRIPTION)
        if start.startswith(b"LASF"):
            raise BareEarthError(
                f"{source} is a point cloud, and this reads a raster. Make a terrain model of the"
                " points first."
            )
        text = start.decode("utf-8", "replace")
        is_description = text.lstrip("\ufeff \t\r\n")[:1] in ("<", "{")
        is_remote = is_description and _REMOTE.search(text) is not None
    if is_remote:
        raise BareEarthError(
            f"{source} is not on this computer, or refers to files that are not. Download it first."
        )
    if not path.exists():
        raise BareEarthError(f"Cannot read {source}: it does not exist. Check the path.")


def _read_with_gdal(source: str, band: int, window: Window | None) -> Content:
    from osgeo import gdal

    with GdalErrors(gdal, "read") as errors:
        dataset = gdal.Open(source, gdal.GA_ReadOnly)
        errors.check(source)
        if dataset is None:
            raise BareEarthError(f"Cannot read {source}: it is not a raster that GDAL can read.")
        shape = dataset.RasterYSize, dataset.RasterXSize
        _check_size(source, band, dataset.RasterCount, shape, window)
        layer, part = dataset.GetRasterBand(band), window or (0, 0, *shape[::-1])
        values, valid = np.zeros((0, 0)), np.zeros((0, 0), dtype=bool)
        if part != NO_CELLS:
            values = layer.ReadAsArray(*part)
            errors.check(source)
            valid = layer.GetMaskBand().ReadAsArray(*part) != 0
            errors.check(source)
        scale, offset = layer.GetScale(), layer.GetOffset()
        return Content(
            values,
            valid,
            tuple(dataset.GetGeoTransform()),
            dataset.GetProjection(),
            layer.GetUnitType() or "",
            1.0 if scale is None else scale,
            0.0 if offset is None else offset,
            shape,
            layer.GetDescription() or "",
            gdal.GetColorInterpretationName(layer.GetColorInterpretation())
            if layer.DataType == gdal.GDT_Byte
            else "",
        )


def _read_with_rasterio(source: str, band: int, window: Window | None) -> Content:
    import rasterio
    import rasterio.windows
    from rasterio.errors import RasterioError

    try:
        with rasterio.open(source) as dataset:
            _check_size(source, band, dataset.count, dataset.shape, window)
            part = None if window is None else rasterio.windows.Window(*window)
            values, valid = np.zeros((0, 0)), np.zeros((0, 0), dtype=bool)
            if window != NO_CELLS:
                values = dataset.read(band, window=part)
                valid = dataset.read_masks(band, window=part) != 0
            return Content(
                values,
                valid,
                dataset.transform.to_gdal(),
                dataset.crs.to_wkt() if dataset.crs else "",
                dataset.units[band - 1] or "",
                dataset.scales[band - 1],
                dataset.offsets[band - 1],
                dataset.shape,
                dataset.descriptions[band - 1] or "",
                dataset.colorinterp[band - 1].name if dataset.dtypes[band - 1] == "uint8" else "",
            )
    except RasterioError as error:
        raise BareEarthError(f"Cannot read {source}: {str(error).rstrip('.')}.") from error


def _check_size(
    source: str, band: int, bands: int, shape: tuple[int, int], window: Window | None
) -> None:
    if band > bands:
        raise BareEarthError(f"{source} has no band {band}: it has {bands}.")
    if window is None and shape[0] * shape[1] > MOST_CELLS:
        raise BareEarthError(
            f"{source} has {shape[1]:,} x {shape[0]:,} cells, too many to be held in memory. Cut"
            " it into parts that overlap."
        )
