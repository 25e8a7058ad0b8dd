"""Writes lines with their heights: GeoJSON here, other formats by pyogrio, or by GDAL in QGIS."""

from __future__ import annotations

import importlib.util
import json
import struct
import warnings
from pathlib import Path
from typing import Callable, Iterable, Iterator, NamedTuple

import numpy as np

from ..core.errors import BareEarthError
from ..core.progress import SILENT, Progress
from ..core.temporary import shown
from ..rasters.libraries import GdalErrors
from ..rasters.rows import RowsOfRaster

# The formats, and their names in GDAL.
FORMATS = {".gpkg": "GPKG", ".geojson": "GeoJSON", ".shp": "ESRI Shapefile", ".fgb": "FlatGeobuf"}
# Further files of these formats: indices and journals.
_BESIDE = {
    ".shp": (".dbf", ".shx", ".prj", ".cpg", ".qpj", ".qix", ".sbn", ".sbx"),
    ".gpkg": (".gpkg-wal", ".gpkg-shm", ".gpkg-journal"),
}
# Formats to which lines cannot be added later.
_AT_ONCE = (".fgb",)
_LINES_A_STEP = 20_000
_LAYER = "contours"


class ContourLine(NamedTuple):
    """A line to write.

    Attributes
    ----------
    height : float
        In the unit of the raster.
    is_index : bool
        Whether it is an index contour, drawn thick.
    corners : numpy.ndarray of float64, shape (n, 2)
        x and y.
    """

    height: float
    is_index: bool
    corners: np.ndarray


def line_writer(target: Path) -> Callable[..., int]:
    """Return the function that writes lines: ``write(target, lines, raster, progress)``.

    It returns the number of lines. Their fields are ID, ELEV (the height) and INDEX (1 or 0).

    Raises
    ------
    BareEarthError
        If the format is not known, or there is no library to write it.
    """
    suffix = target.suffix.lower()
    if suffix not in FORMATS:
        raise BareEarthError(
            f"Cannot write {target}: contour lines are written as {', '.join(FORMATS)}. Name it so."
        )
    if importlib.util.find_spec("osgeo") is not None:
        return _by_gdal
    if suffix == ".geojson":
        return _geojson
    if importlib.util.find_spec("pyogrio") is not None:
        return _by_pyogrio
    raise BareEarthError(
        f"{target} needs pyogrio to be written: pip install pyogrio. GeoJSON (.geojson) is written"
        " without it."
    )


def _geojson(
    target: Path, lines: Iterable[ContourLine], raster: RowsOfRaster, progress: Progress = SILENT
) -> int:
    crs, count = f"urn:ogc:def:crs:EPSG::{raster.epsg}" if raster.epsg else None, 0
    if crs is None:
        progress.warning(
            f"{target.name} states no CRS, since GeoJSON can hold only EPSG codes. Write .gpkg to"
            " keep it."
        )
    stated = {"crs": {"type": "name", "properties": {"name": crs}}} if crs else {}
    head = json.dumps({"type": "FeatureCollection", "name": _LAYER, **stated})
    with target.open("w", encoding="utf-8", newline="\n") as file:
        file.write(f'{head[:-1]}, "features": [')
        for line in lines:
            places = np.round(line.corners, 3).tolist()
            values = {"ID": count, "ELEV": line.height, "INDEX": int(line.is_index)}
            shape = {"type": "LineString", "coordinates": places}
            feature = {"type": "Feature", "properties": values, "geometry": shape}
            file.write(f"{',' if count else ''}\n{json.dumps(feature)}")
            count += 1
        file.write("\n]}\n")
    return count


def _by_pyogrio(
    target: Path, lines: Iterable[ContourLine], raster: RowsOfRaster, progress: Progress = SILENT
) -> int:
    import pyogrio

    count, names = 0, ["ID", "ELEV", "INDEX"]
    most = None if target.suffix.lower() in _AT_ONCE else _LINES_A_STEP
    try:
        for some in _in_steps(lines, most):
            fields = [
                np.arange(count, count + len(some), dtype=np.int32),
                np.array([each.height for each in some], dtype=np.float64),
                np.array([each.is_index for each in some], dtype=np.int32),
            ]
            shapes = np.empty(len(some), dtype=object)
            shapes[:] = [_wkb(each.corners) for each in some]
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")  # if there is no CRS
                pyogrio.raw.write(
                    str(target), shapes, fields, names, layer=_layer_of(target),
                    driver=FORMATS[target.suffix.lower()], geometry_type="LineString",
                    crs=raster.frame.wkt, append=count > 0,
                )  # fmt: skip
            count += len(some)
    except (BareEarthError, MemoryError):
        raise
    except RuntimeError as error:  # the base of the errors of pyogrio
        raise BareEarthError(f"Cannot write {target.name}: {shown(error).rstrip('.')}.") from error
    return count


def _by_gdal(
    target: Path, lines: Iterable[ContourLine], raster: RowsOfRaster, progress: Progress = SILENT
) -> int:
    from osgeo import gdal, ogr, osr

    count = 0
    with GdalErrors(gdal, "write") as errors:
        driver = ogr.GetDriverByName(FORMATS[target.suffix.lower()])
        made = driver.CreateDataSource(str(target))
        errors.check(target)
        reference = osr.SpatialReference(raster.frame.wkt) if raster.frame.wkt else None
        if reference is not None:
            reference.SetAxisMappingStrategy(osr.OAMS_TRADITIONAL_GIS_ORDER)
        layer = made.CreateLayer(_layer_of(target), reference, ogr.wkbLineString)
        for name, kind in (
            ("ID", ogr.OFTInteger),
            ("ELEV", ogr.OFTReal),
            ("INDEX", ogr.OFTInteger),
        ):
            layer.CreateField(ogr.FieldDefn(name, kind))
        errors.check(target)
        # One transaction, since a GeoPackage would otherwise commit each line.
        layer.StartTransaction()
        for line in lines:
            feature = ogr.Feature(layer.GetLayerDefn())
            for place, value in enumerate((count, line.height, int(line.is_index))):
                feature.SetField(place, value)
            feature.SetGeometry(ogr.CreateGeometryFromWkb(_wkb(line.corners)))
            layer.CreateFeature(feature)
            count += 1
        layer.CommitTransaction()
        del layer, made
        errors.check(target)
    return count


def _layer_of(target: Path) -> str:
    """Return the name of the layer; formats with one layer have that of the file."""
    return _LAYER if target.suffix.lower() == ".gpkg" else target.stem


def _wkb(corners: np.ndarray) -> bytes:
    return struct.pack("<BII", 1, 2, len(corners)) + np.ascontiguousarray(corners, "<f8").tobytes()


def _in_steps(lines: Iterable[ContourLine], most: int | None) -> Iterator[list[ContourLine]]:
    """Yield lists of lines; one empty list if there are none."""
    some: list[ContourLine] = []
    is_first = True
    for line in lines:
        some.append(line)
        if most is not None and len(some) >= most:
            yield some
            some, is_first = [], False
    if some or is_first:
        yield some


def files_beside(path: Path) -> list[str]:
    """Return the names of further files of a format; old ones would do harm to new lines."""
    return [f"{path.stem}{each}" for each in _BESIDE.get(path.suffix.lower(), ())]
