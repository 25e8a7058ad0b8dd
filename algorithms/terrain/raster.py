"""Rasters of the terrain: their grid, and GeoTIFF files by GDAL (in QGIS) or rasterio (outside)."""

from __future__ import annotations

import importlib.util
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..errors import BareEarthError
from ..files import check_output, replacing, shown
from ..points import Frame, Points
from ..progress import Progress

NODATA = -9999.0
_MOST_CELLS = 400_000_000
_BLOCK = 256


@dataclass(frozen=True)
class RasterGrid:
    """A north-up grid of square cells in the CRS of the survey.

    Attributes
    ----------
    west, north : float
        Upper left corner, in units of the CRS; a multiple of the cell size, so that the rasters of
        neighbouring tiles fit together.
    cell_size : float
        Side of a cell, in units of the CRS.
    columns, rows : int
        Size of the raster.
    frame : Frame
        The local metres that belong to the CRS.
    """

    west: float
    north: float
    cell_size: float
    columns: int
    rows: int
    frame: Frame

    @classmethod
    def over(cls, points: Points, frame: Frame, cell_size: float) -> RasterGrid:
        """Return the grid that covers `points`, with cells of `cell_size` metres.

        Raises
        ------
        BareEarthError
            If there are no points, or the grid would not fit into memory.
        """
        if points.count == 0:
            raise BareEarthError(
                "There is no ground point to make a terrain model of. Check the selection of points"
                " and the parameters."
            )
        cell = cell_size / frame.horizontal_unit
        x0, x1, y0, y1 = (
            value / frame.horizontal_unit
            for value in (points.x.min(), points.x.max(), points.y.min(), points.y.max())
        )
        west, north = (
            math.floor((frame.origin[0] + x0) / cell),
            math.ceil((frame.origin[1] + y1) / cell),
        )
        columns = max(math.ceil((frame.origin[0] + x1) / cell) - west, 1)
        rows = max(north - math.floor((frame.origin[1] + y0) / cell), 1)
        if columns * rows > _MOST_CELLS:
            raise BareEarthError(
                f"The raster would have {columns:,} x {rows:,} cells of {cell_size:g} m. Choose a"
                " larger cell size, or remove points with stray coordinates."
            )
        return cls(west * cell, north * cell, cell, columns, rows, frame)

    @property
    def cell_metres(self) -> float:
        """Side of a cell in metres."""
        return self.cell_size * self.frame.horizontal_unit

    @property
    def x(self) -> np.ndarray:
        """Cell centres from west to east, in local metres."""
        centres = (
            self.west - self.frame.origin[0] + (np.arange(self.columns) + 0.5) * self.cell_size
        )
        return centres * self.frame.horizontal_unit

    @property
    def y(self) -> np.ndarray:
        """Cell centres from north to south, in local metres."""
        centres = self.north - self.frame.origin[1] - (np.arange(self.rows) + 0.5) * self.cell_size
        return centres * self.frame.horizontal_unit


def write_geotiff(
    target: Path, values: np.ndarray, grid: RasterGrid, nodata: float, progress: Progress
) -> None:
    """Write a tiled, deflated, single-band GeoTIFF.

    Parameters
    ----------
    target : Path
        The file to make.
    values : numpy.ndarray of float32 or uint8, shape (rows, columns)
        The cells from north to south; `nodata` where there is no value.
    grid : RasterGrid
        Where the cells lie.
    nodata : float
        The value that stands for none.
    progress : Progress
        Warned if the file has to go without its CRS.

    Raises
    ------
    BareEarthError
        If there is no library to write rasters with, or the file cannot be written.
    """
    check_output(target)
    with replacing(target) as temporary:
        _writer()(temporary, values, grid, nodata, progress)


def check_raster_output(target: Path, sources: tuple[Path, ...] = ()) -> None:
    """Refuse, before any work is done, a raster that could not be written at the end."""
    check_output(target, sources)
    if target.suffix.lower() not in (".tif", ".tiff"):
        raise BareEarthError(
            f"Cannot write {target}: rasters are written as GeoTIFF, name it .tif."
        )
    _writer()


def _writer():
    """Return the function that writes with the library that is there; GDAL first, for QGIS."""
    if importlib.util.find_spec("osgeo") is not None:
        return _write_with_gdal
    if importlib.util.find_spec("rasterio") is not None:
        return _write_with_rasterio
    raise BareEarthError("Writing a raster needs rasterio: pip install rasterio.")


def _write_with_gdal(
    path: Path, values: np.ndarray, grid: RasterGrid, nodata: float, progress: Progress
) -> None:
    from osgeo import gdal, osr

    rows, columns = values.shape
    is_float = values.dtype.kind == "f"
    options = [
        "TILED=YES",
        "COMPRESS=DEFLATE",
        "BIGTIFF=IF_SAFER",
        f"PREDICTOR={3 if is_float else 2}",
    ]
    options += [f"BLOCKXSIZE={_BLOCK}", f"BLOCKYSIZE={_BLOCK}"]
    kind = gdal.GDT_Float32 if is_float else gdal.GDT_Byte
    with _GdalErrors(gdal) as errors:
        dataset = gdal.GetDriverByName("GTiff").Create(str(path), columns, rows, 1, kind, options)
        errors.check(path)
        dataset.SetGeoTransform((grid.west, grid.cell_size, 0.0, grid.north, 0.0, -grid.cell_size))
        if grid.frame.wkt:
            reference = osr.SpatialReference()
            if reference.ImportFromWkt(grid.frame.wkt) == 0:
                dataset.SetProjection(reference.ExportToWkt())
            else:
                _warn_without_crs(progress)
            errors.clear()
        band = dataset.GetRasterBand(1)
        band.SetNoDataValue(nodata)
        band.WriteArray(values)
        band.FlushCache()
        dataset.FlushCache()
        del band, dataset
        errors.check(path)


class _GdalErrors:
    """Collects GDAL's error messages, whichever of its error modes the application chose."""

    def __init__(self, gdal) -> None:
        self._gdal, self._texts = gdal, []

    def __enter__(self) -> _GdalErrors:
        self._gdal.PushErrorHandler(self._receive)
        return self

    def __exit__(self, kind: object, error: BaseException | None, trace: object) -> None:
        self._gdal.PopErrorHandler()
        if isinstance(error, RuntimeError):  # the application made GDAL raise its errors
            raise BareEarthError(f"Cannot write the raster: {shown(error)}") from error

    def _receive(self, severity: int, number: int, text: str) -> None:
        if severity >= self._gdal.CE_Failure:
            self._texts.append(text)

    def clear(self) -> None:
        self._texts.clear()

    def check(self, path: Path) -> None:
        if self._texts:
            reason = shown(self._texts[0]).rstrip(".")
            raise BareEarthError(f"Cannot write {shown(path)}: {reason}.")


def _write_with_rasterio(
    path: Path, values: np.ndarray, grid: RasterGrid, nodata: float, progress: Progress
) -> None:
    import rasterio
    from rasterio.errors import CRSError, RasterioError
    from rasterio.transform import from_origin

    crs = None
    if grid.frame.wkt:
        try:
            crs = rasterio.crs.CRS.from_wkt(grid.frame.wkt)
        except CRSError:
            _warn_without_crs(progress)
    try:
        with rasterio.open(
            path, "w", driver="GTiff", width=values.shape[1], height=values.shape[0], count=1,
            dtype=values.dtype.name, nodata=nodata, crs=crs, tiled=True, compress="deflate",
            predictor=3 if values.dtype.kind == "f" else 2, blockxsize=_BLOCK, blockysize=_BLOCK,
            transform=from_origin(grid.west, grid.north, grid.cell_size, grid.cell_size),
            BIGTIFF="IF_SAFER",
        ) as dataset:  # fmt: skip
            dataset.write(values, 1)
    except RasterioError as error:
        raise BareEarthError(f"Cannot write {shown(path)}: {shown(error)}.") from error


def _warn_without_crs(progress: Progress) -> None:
    progress.warning(
        "The raster is written without a CRS, since that of the cloud is not understood."
    )
