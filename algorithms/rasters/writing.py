"""Writes rasters as cloud-optimised GeoTIFF: tiled, compressed, with overviews."""

from __future__ import annotations

import errno
import math
import os
import shutil
from pathlib import Path
from typing import TYPE_CHECKING, Any, Callable, Iterable, NamedTuple

import numpy as np

from ..core.errors import BareEarthError
from ..core.files import Outputs
from ..core.progress import Progress
from ..core.temporary import remove, shown
from ..core.version import __version__
from ..crs.system import unit_name, unit_symbol
from ..crs.wkt import of_map, read_wkt, with_unit_of_heights
from .geotiff import HeightBand, RasterGrid
from .libraries import GdalErrors, library
from .sparse import SIDE, RasterPart, write_sparse

if TYPE_CHECKING:
    from rasterio.crs import CRS

# Most cells that are collected in memory, which is faster than in a temporary file.
_MOST_IN_MEMORY = 64_000_000
BLOCK_SIDE = SIDE  # cells along a side of a block of the file
_OPTIONS = {
    "COMPRESS": "DEFLATE", "PREDICTOR": "YES", "BLOCKSIZE": str(BLOCK_SIDE), "BIGTIFF": "IF_SAFER",
    "OVERVIEW_RESAMPLING": "AVERAGE", "NUM_THREADS": "ALL_CPUS",
}  # fmt: skip
# Of the temporary file: cells along the side of a tile, and bytes for the index of a tile.
_TILE = 256
_BYTES_ABOUT_A_TILE = 512
_WAITING = {"TILED": "YES", "BIGTIFF": "IF_SAFER", "SPARSE_OK": "TRUE"}
_SPARSE = {
    **_WAITING, "BIGTIFF": "YES", "ENDIANNESS": "LITTLE", "COMPRESS": "DEFLATE",
    "BLOCKXSIZE": str(BLOCK_SIDE), "BLOCKYSIZE": str(BLOCK_SIDE), "INTERLEAVE": "PIXEL",
}  # fmt: skip


def raster_file(outputs: Outputs, path: Path) -> Path:
    """Return a temporary file for a raster; the .aux.xml file of an old raster will be removed."""
    # QGIS would stretch the colours by the statistics of the old cells in it.
    return outputs.file(path, [f"{path.name}.aux.xml"])


class RasterCells(NamedTuple):
    """The cells of a raster, in parts; those of no part have no data."""

    shape: tuple[int, int]  # rows and columns of the raster
    kind: str  # "float32" or "uint8"
    parts: Iterable[RasterPart]
    bands: int = 1  # 1, or 3 for red, green and blue
    made: int | None = None  # cells in all parts; None for all of the raster

    @classmethod
    def of(cls, values: np.ndarray) -> RasterCells:
        """Return the cells of an array, (rows, columns) from north to south."""
        return cls(values.shape, values.dtype.name, [RasterPart(0, 0, values)])

    @property
    def are_sparse(self) -> bool:
        """Whether most of a large raster has no data, so that it costs what has data."""
        size = math.prod(self.shape)
        return self.made is not None and 2 * self.made < size and size > _MOST_IN_MEMORY


class Band(NamedTuple):
    """Properties of the bands of a raster."""

    nodata: float
    description: str
    unit: str
    bands: int = 1  # number of bands
    wkt: str | None = None  # CRS, with a vertical one only if the cells are heights

    @classmethod
    def of(cls, grid: RasterGrid | HeightBand, nodata: float, shows: str, bands: int = 1) -> Band:
        """Return the bands that `write_geotiff` writes; see there for `shows`."""
        metres, unit = grid.frame.vertical_unit, ""
        wkt = _wkt_of(grid.frame.wkt, "{unit}" in shows)
        if isinstance(grid, HeightBand) and not grid.states_unit:
            shows = shows.replace(", {unit}", "")  # what is assumed is not stated
        elif "{unit}" in shows:
            unit = (grid.unit if isinstance(grid, HeightBand) else "") or unit_name(metres)
        elif shows.endswith(", degrees"):
            unit = "degree"
        return cls(nodata, shows.format(unit=unit_symbol(metres)), unit, bands, wkt)

    @property
    def colours(self) -> tuple[str, ...]:
        """What each band shows, as GDAL names it."""
        return ("Gray",) if self.bands == 1 else ("Red", "Green", "Blue")


def _wkt_of(wkt: str | None, is_height: bool) -> str | None:
    """Return the CRS of a raster, without a vertical one if its cells are not heights."""
    facts = read_wkt(wkt) if wkt else None
    if wkt is None or facts is None or not facts.has_vertical:
        return wkt
    # GeoTIFF has no vertical CRS for heights above an ellipsoid.
    is_above_ellipsoid = facts.datum is not None and facts.datum.is_ellipsoid
    return wkt if is_height and not is_above_ellipsoid else of_map(wkt)


def write_geotiff(
    target: Path,
    values: np.ndarray | RasterCells,  # (rows, columns) from north to south
    grid: RasterGrid | HeightBand,
    nodata: float,  # for cells without a value
    progress: Progress,
    shows: str,  # name of the band; {unit} becomes the vertical unit
) -> None:
    """Write a cloud-optimised GeoTIFF of float32 or uint8, of one band, or of three for red, green
    and blue.
    """
    if isinstance(values, np.ndarray):
        values = RasterCells.of(values)
    band = Band.of(grid, nodata, shows, values.bands)
    if "{unit}" in shows and band.wkt != grid.frame.wkt:
        _report_heights(progress)
    with Outputs() as outputs:
        _writer()(raster_file(outputs, target), values, grid, band, progress)


def check_raster(target: Path) -> None:
    """Refuse a raster that has the name of another format, or that no library writes."""
    if target.suffix.lower() not in (".tif", ".tiff"):
        raise BareEarthError(
            f"Cannot write {target}: rasters are written as GeoTIFF, name it .tif."
        )
    _writer()


def _writer() -> Callable[[Path, RasterCells, RasterGrid | HeightBand, Band, Progress], None]:
    """Return the function that writes with the installed library."""
    return library(_write_with_gdal, _write_with_rasterio, "Writing")


def _waiting_file(path: Path, cells: RasterCells) -> Path | None:
    """Return the file in which the cells are collected, or None for memory; OSError if the disk has
    too little space for it.
    """
    # If the disk becomes full later, rasterio raises no error, or an unexpected one.
    if math.prod(cells.shape) * cells.bands <= _MOST_IN_MEMORY:
        return None
    tiles = math.prod(-(-count // _TILE) for count in cells.shape)
    needed = tiles * cells.bands * _BYTES_ABOUT_A_TILE
    made = tiles * _TILE**2 if cells.made is None else cells.made
    needed += made * cells.bands * np.dtype(cells.kind).itemsize
    if shutil.disk_usage(path.parent).free < needed:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
    return path.with_name(f"{path.name}.cells.tif")


def _waiting_options(cells: RasterCells) -> dict[str, str]:
    """Return the options of the file in which the cells are collected; that of a sparse raster has
    all but the cells.
    """
    if not cells.are_sparse:
        return _WAITING
    predictor = "3" if cells.kind == "float32" else "2"
    return {**_SPARSE, "PREDICTOR": predictor}


def _write_with_gdal(
    path: Path, cells: RasterCells, grid: RasterGrid | HeightBand, about: Band, progress: Progress
) -> None:
    from osgeo import gdal

    waiting = _waiting_file(path, cells)
    driver, options = ("GTiff", _words(_waiting_options(cells))) if waiting else ("MEM", [])
    kind = gdal.GDT_Float32 if cells.kind == "float32" else gdal.GDT_Byte
    copy = dataset = None
    try:
        with GdalErrors(gdal, "write") as errors:
            dataset = gdal.GetDriverByName(driver).Create(
                str(waiting or ""), *cells.shape[::-1], cells.bands, kind, options
            )
            errors.check(path)
            _describe(dataset, grid, about, progress, errors)
            if waiting and cells.are_sparse:
                dataset.FlushCache()
                dataset = None
                errors.check(path)
                write_sparse(path, waiting, cells.parts, about.nodata)
                return
            if not waiting:
                for number in range(1, cells.bands + 1):
                    dataset.GetRasterBand(number).Fill(about.nodata)
            for row, column, values in cells.parts:
                for number, part in enumerate(values.reshape(-1, *values.shape[-2:]), 1):
                    dataset.GetRasterBand(number).WriteArray(part, column, row)
                    errors.check(path)
            dataset.FlushCache()
            copy = gdal.GetDriverByName("COG").CreateCopy(str(path), dataset, 0, _words(_OPTIONS))
            errors.check(path)
            copy.FlushCache()
            copy = dataset = None
            errors.check(path)
    finally:
        # Windows does not remove open files.
        copy = dataset = None
        if waiting:
            remove(waiting)


def _describe(
    dataset: Any, grid: RasterGrid | HeightBand, about: Band, progress: Progress, errors: GdalErrors
) -> None:
    """Set what a data set of GDAL states about its cells."""
    from osgeo import gdal, osr

    dataset.SetGeoTransform(grid.geotransform)
    if about.wkt:
        reference = osr.SpatialReference()
        if reference.ImportFromWkt(about.wkt) == 0:
            dataset.SetProjection(with_unit_of_heights(reference.ExportToWkt()))
        elif reference.ImportFromWkt(of_map(about.wkt)) == 0:
            dataset.SetProjection(reference.ExportToWkt())
            _report_heights(progress)
        else:
            _warn_without_crs(progress)
        errors.clear()
    dataset.SetMetadata(_tags(about))
    for number, colour in enumerate(about.colours, 1):
        band = dataset.GetRasterBand(number)
        band.SetNoDataValue(about.nodata)
        band.SetDescription(about.description)
        if len(about.colours) > 1:
            band.SetColorInterpretation(getattr(gdal, f"GCI_{colour}Band"))
        if about.unit:
            band.SetUnitType(about.unit)


def _tags(about: Band) -> dict[str, str]:
    """Return the metadata of the file, without a time, so that equal runs make equal files."""
    return {
        "TIFFTAG_SOFTWARE": f"Bare Earth {__version__}",
        "TIFFTAG_IMAGEDESCRIPTION": about.description,
    }


def _words(options: dict[str, str]) -> list[str]:
    return [f"{name}={value}" for name, value in options.items()]


def _write_with_rasterio(
    path: Path, cells: RasterCells, grid: RasterGrid | HeightBand, about: Band, progress: Progress
) -> None:
    import rasterio
    import rasterio.shutil
    from rasterio.errors import RasterioError
    from rasterio.io import MemoryFile
    from rasterio.transform import Affine
    from rasterio.windows import Window

    crs = _crs_of(about.wkt, progress)
    waiting = _waiting_file(path, cells)
    profile: dict[str, object] = dict(
        driver="GTiff", width=cells.shape[1], height=cells.shape[0], count=cells.bands,
        dtype=cells.kind, nodata=about.nodata, crs=crs,
        transform=Affine.from_gdal(*grid.geotransform), **_waiting_options(cells),
    )  # fmt: skip
    if cells.bands > 1:
        profile["photometric"] = "RGB"
    parts = () if cells.are_sparse else cells.parts
    try:
        # No .aux.xml file is written, because it would keep the temporary name.
        with rasterio.Env(GDAL_PAM_ENABLED="NO"), MemoryFile() as memory, MemoryFile() as copy:
            name = str(waiting or memory.name)
            with rasterio.open(name, "w", **profile) as dataset:
                for row, column, values in parts:
                    window = Window(column, row, values.shape[-1], values.shape[-2])
                    dataset.write(values.reshape(-1, *values.shape[-2:]), window=window)
                dataset.descriptions = (about.description,) * cells.bands
                dataset.update_tags(**_tags(about))
                if about.unit:
                    dataset.units = (about.unit,) * cells.bands
            if waiting and cells.are_sparse:
                write_sparse(path, waiting, cells.parts, about.nodata)
            else:
                # In memory first, since rasterio raises no error if the disk is full at the close.
                rasterio.shutil.copy(name, copy.name, driver="COG", **_OPTIONS)
                path.write_bytes(copy.getbuffer())
            with rasterio.open(path) as dataset:
                if crs is not None and dataset.crs is None:
                    _warn_without_crs(progress)
    except RasterioError as error:
        raise BareEarthError(f"Cannot write {shown(path)}: {shown(error)}.") from error
    finally:
        if waiting:
            remove(waiting)


def _crs_of(wkt: str | None, progress: Progress) -> CRS | None:
    """Return the CRS as rasterio knows it; None, with a warning, if rasterio does not."""
    import rasterio
    from rasterio.crs import CRS
    from rasterio.errors import CRSError

    if not wkt:
        return None
    try:
        with rasterio.Env():  # without it, GDAL prints its errors
            crs = CRS.from_wkt(wkt)
            text = crs.to_wkt()
            changed = with_unit_of_heights(text)
            return crs if changed == text else CRS.from_wkt(changed)
    except CRSError:
        if wkt != of_map(wkt):
            _report_heights(progress)
            return _crs_of(of_map(wkt), progress)
        _warn_without_crs(progress)
        return None


def _report_heights(progress: Progress) -> None:
    progress.warning(
        "The raster states the CRS of x and y, but not that of its heights, which GeoTIFF cannot"
        " state, such as heights above the ellipsoid."
    )


def _warn_without_crs(progress: Progress) -> None:
    progress.warning(
        "The raster is written without a CRS, since that of the cloud is not understood."
    )
