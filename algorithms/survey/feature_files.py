"""Writes lines, points or polygons: GeoJSON and DXF here, others by pyogrio, or GDAL in QGIS."""

from __future__ import annotations

import importlib.util
import json
import math
import struct
import warnings
from itertools import islice
from pathlib import Path
from typing import Any, Callable, Iterable, Iterator, Mapping, NamedTuple, Sequence, Union

import numpy as np

from ..core.errors import BareEarthError
from ..core.progress import SILENT, Progress
from ..core.temporary import shown
from ..rasters.libraries import GdalErrors
from .dxf import Drawn, write_dxf

# The formats, and their names in GDAL.
FORMATS = {
    ".gpkg": "GPKG", ".geojson": "GeoJSON", ".shp": "ESRI Shapefile", ".fgb": "FlatGeobuf",
    ".dxf": "DXF",
}  # fmt: skip
OWN_FORMATS = ".geojson", ".dxf"  # without a library
# Further files of these formats: indices and journals.
_BESIDE = {
    ".shp": (".dbf", ".shx", ".prj", ".cpg", ".qpj", ".qix", ".sbn", ".sbx"),
    ".gpkg": (".gpkg-wal", ".gpkg-shm", ".gpkg-journal"),
}
# Formats to which features cannot be added later.
_AT_ONCE = (".fgb",)
_FEATURES_A_STEP = 20_000
# Numbers of the kinds in well-known binary; kinds with z are 1000 higher.
_KINDS = {"Point Z": 1001, "LineString": 2, "LineString Z": 1002, "Polygon": 3}


# Of a line or point; or the rings of a polygon.
Corners = Union[np.ndarray, Sequence[np.ndarray]]


class DxfLayers(NamedTuple):
    """The layers of a drawing (DXF), which has no fields."""

    colours: Mapping[str, int]  # the layers, and the numbers of their colours
    # Returns the layer of a feature, and its height if its corners have none, from its values.
    place: Callable[[tuple[Any, ...]], tuple[str, float]]


class FeatureLayer(NamedTuple):
    """What the features of a file have in common."""

    name: str  # in formats with several layers
    kind: str  # "LineString", "LineString Z", "Polygon" or "Point Z"
    fields: Mapping[str, type]  # names, and types of the values: int, float or str
    wkt: str | None
    epsg: int | None
    drawing: DxfLayers | None = None  # by default one layer with the name


class Feature(NamedTuple):
    """A line, a point or a polygon to write."""

    values: tuple[object, ...]  # one for each field; NaN and None for no value
    # float64, (n, 2) or (n, 3): x, y, and z if the kind has it; (1, 3) for a point; for a polygon
    # its closed rings (x and y), the outer ring first
    corners: Corners


def feature_writer(target: Path) -> Callable[..., int]:
    """Return the function ``write(target, features, layer, progress)`` that writes features and
    returns their number; refuse a format that no library can write.
    """
    suffix = target.suffix.lower()
    if suffix not in FORMATS:
        raise BareEarthError(
            f"Cannot write {target}: vector layers are written as {', '.join(FORMATS)}. Name it so."
        )
    if suffix == ".dxf":
        return _dxf
    if importlib.util.find_spec("osgeo") is not None:
        return _by_gdal
    if suffix == ".geojson":
        return _geojson
    if importlib.util.find_spec("pyogrio") is not None:
        return _by_pyogrio
    raise BareEarthError(
        f"{target} needs pyogrio to be written: pip install pyogrio. GeoJSON (.geojson) and DXF"
        " (.dxf) are written without it."
    )


def _geojson(
    target: Path, features: Iterable[Feature], layer: FeatureLayer, progress: Progress = SILENT
) -> int:
    crs, count = f"urn:ogc:def:crs:EPSG::{layer.epsg}" if layer.epsg else None, 0
    if crs is None:
        progress.warning(
            f"{target.name} states no CRS, since GeoJSON can hold only EPSG codes. Write .gpkg to"
            " keep it."
        )
    stated = {"crs": {"type": "name", "properties": {"name": crs}}} if crs else {}
    head = json.dumps({"type": "FeatureCollection", "name": layer.name, **stated})
    with target.open("w", encoding="utf-8", newline="\n") as file:
        file.write(f'{head[:-1]}, "features": [')
        for feature in features:
            values = dict(zip(layer.fields, map(_or_none, feature.values)))
            places = _lists(layer.kind, feature.corners)
            shape = {"type": layer.kind.split()[0], "coordinates": places}
            whole = {"type": "Feature", "properties": values, "geometry": shape}
            file.write(f"{',' if count else ''}\n{json.dumps(whole)}")
            count += 1
        file.write("\n]}\n")
    return count


def _dxf(
    target: Path, features: Iterable[Feature], layer: FeatureLayer, progress: Progress = SILENT
) -> int:
    name = layer.name.upper()
    drawing = layer.drawing or DxfLayers({name: 7}, lambda values: (name, 0.0))
    stated = f"EPSG:{layer.epsg}" if layer.epsg else "the CRS of the input"
    progress.info(f"{target.name} cannot state its CRS: its coordinates are in {stated}.")
    shapes = (shape for feature in features for shape in _drawn(feature, layer.kind, drawing))
    return write_dxf(target, shapes, drawing.colours, f"Bare Earth, {layer.name}, {stated}")


def _drawn(feature: Feature, kind: str, drawing: DxfLayers) -> Iterator[Drawn]:
    """Yield a feature as a drawing has it: a polygon as the lines of its rings."""
    layer, height = drawing.place(feature.values)
    for corners in feature.corners if kind == "Polygon" else [feature.corners]:
        places = np.asarray(corners, dtype=np.float64)
        if places.shape[1] < 3:
            places = np.column_stack((places, np.full(len(places), height)))
        yield Drawn(layer, np.nan_to_num(places, nan=height))


def _by_pyogrio(
    target: Path, features: Iterable[Feature], layer: FeatureLayer, progress: Progress = SILENT
) -> int:
    import pyogrio

    count, kinds = 0, {int: np.int32, float: np.float64, str: object}
    most = None if target.suffix.lower() in _AT_ONCE else _FEATURES_A_STEP
    try:
        for step in _in_steps(features, most):
            columns = [
                [feature.values[place] for feature in step] for place in range(len(layer.fields))
            ]
            fields = [
                np.array(
                    [0 if kind is int and value is None else value for value in values], kinds[kind]
                )
                for values, kind in zip(columns, layer.fields.values())
            ]
            masks = [np.array([cell is None for cell in values], dtype=bool) for values in columns]
            shapes = np.empty(len(step), dtype=object)
            shapes[:] = [wkb_of(layer.kind, feature.corners) for feature in step]
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")  # if there is no CRS
                pyogrio.raw.write(
                    str(target), shapes, fields, list(layer.fields), crs=layer.wkt,
                    layer=_layer_of(target, layer), driver=FORMATS[target.suffix.lower()],
                    geometry_type=layer.kind, append=count > 0, field_mask=masks,
                )  # fmt: skip
            count += len(step)
    except (BareEarthError, MemoryError):
        raise
    except RuntimeError as error:  # the base of the errors of pyogrio
        raise BareEarthError(f"Cannot write {target.name}: {shown(error).rstrip('.')}.") from error
    return count


def _by_gdal(
    target: Path, features: Iterable[Feature], layer: FeatureLayer, progress: Progress = SILENT
) -> int:
    from osgeo import gdal, ogr, osr

    count = 0
    kinds = {int: ogr.OFTInteger, float: ogr.OFTReal, str: ogr.OFTString}
    shapes = {
        "Point Z": ogr.wkbPoint25D, "LineString": ogr.wkbLineString,
        "LineString Z": ogr.wkbLineString25D, "Polygon": ogr.wkbPolygon,
    }  # fmt: skip
    with GdalErrors(gdal, "write") as errors:
        driver = ogr.GetDriverByName(FORMATS[target.suffix.lower()])
        source = driver.CreateDataSource(str(target))
        errors.check(target)
        reference = osr.SpatialReference(layer.wkt) if layer.wkt else None
        if reference is not None:
            reference.SetAxisMappingStrategy(osr.OAMS_TRADITIONAL_GIS_ORDER)
        into = source.CreateLayer(_layer_of(target, layer), reference, shapes[layer.kind])
        for name, kind in layer.fields.items():
            into.CreateField(ogr.FieldDefn(name, kinds[kind]))
        errors.check(target)
        # One transaction, since a GeoPackage would otherwise commit each feature.
        into.StartTransaction()
        for feature in features:
            record = ogr.Feature(into.GetLayerDefn())
            for place, value in enumerate(map(_or_none, feature.values)):
                if value is not None:
                    record.SetField(place, value)
            record.SetGeometry(ogr.CreateGeometryFromWkb(wkb_of(layer.kind, feature.corners)))
            into.CreateFeature(record)
            count += 1
        into.CommitTransaction()
        del into, source
        errors.check(target)
    return count


def _layer_of(target: Path, layer: FeatureLayer) -> str:
    """Return the name of the layer; in formats with one layer it is the name of the file."""
    return layer.name if target.suffix.lower() == ".gpkg" else target.stem


def _or_none(value: object) -> object:
    return None if isinstance(value, float) and math.isnan(value) else value


def _lists(kind: str, corners: Corners) -> list[object]:
    """Return the coordinates of a feature as in GeoJSON."""
    if kind == "Polygon":
        return [np.round(ring, 3).tolist() for ring in corners]
    places = np.round(corners, 3).tolist()
    return places[0] if kind == "Point Z" else places


def wkb_of(kind: str, corners: Corners) -> bytes:
    """Return a feature as well-known binary."""
    head = struct.pack("<BI", 1, _KINDS[kind])
    if kind == "Point Z":
        return head + _coordinates(corners)
    if kind != "Polygon":
        return head + struct.pack("<I", len(corners)) + _coordinates(corners)
    rings = (struct.pack("<I", len(ring)) + _coordinates(ring) for ring in corners)
    return head + struct.pack("<I", len(corners)) + b"".join(rings)


def _coordinates(corners: Corners) -> bytes:
    return np.ascontiguousarray(corners, "<f8").tobytes()


def _in_steps(features: Iterable[Feature], most: int | None) -> Iterator[list[Feature]]:
    """Yield lists of features; one empty list if there are none."""
    features = iter(features)
    yield list(islice(features, most))
    while step := list(islice(features, most)):
        yield step


def files_beside(path: Path) -> list[str]:
    """Return the names of the other files of a format, which describe the old features."""
    return [f"{path.stem}{ending}" for ending in _BESIDE.get(path.suffix.lower(), ())]
