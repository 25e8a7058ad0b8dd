"""Reading vector files by a library: pyogrio, or GDAL in QGIS."""

from __future__ import annotations

import importlib.util
import re
import warnings
from pathlib import Path
from typing import Any, Callable, Iterator, NamedTuple, Sequence

from ..core.errors import BareEarthError
from ..las.sources import open_source
from .wkb import geometries_of

_WGS84 = re.compile(r'EPSG:(4326|4979)$|OGC:CRS84$|GEOG[A-Z]*\["WGS 84(?! /)', re.IGNORECASE)

# Between a file and the name of a layer, as QGIS writes it.
_LAYER = "|layername="
_FOLDERS = (".gdb",)
_GEOJSON = (".geojson", ".json")
_STATED = re.compile(rb'"crs"\s*:\s*\{[^{}]*(\{[^{}]*\})?')
_DEGREES = re.compile(rb"4326|CRS84")
# XML that the library may read. Other XML can tell it to fetch files from other computers.
_XML = (".kml", ".gpx")


class _Layer(NamedTuple):
    """A layer, with the WKB and the attributes of its features."""

    name: str
    crs: str | None
    features: Sequence[tuple[bytes | None, dict[str, Any]]]


def read_features(
    path: Path | str, kind: str, has_attributes: bool
) -> tuple[list[tuple[Any, dict[str, Any]]], str | None]:
    """Read the geometries of a kind ("Polygon", "LineString" or "Point") with their attributes, if
    these are wanted, and the CRS of the layer as code or WKT.
    """
    # Coordinates are as in GeoJSON. A path can be ``FILE|layername=NAME``. A file with such
    # geometries in several layers is refused if no layer is named.
    name, _, wanted = str(path).partition(_LAYER)
    _check(Path(name))
    reads = _library(name)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # on what is left out of geometries, such as M
            layers = [layer for layer in reads(name, has_attributes) if wanted in ("", layer.name)]
        by_layer = {layer.name: (list(_of_kind(layer, kind)), layer.crs) for layer in layers}
    except (BareEarthError, MemoryError):
        raise
    except ValueError as error:  # of a geometry
        raise BareEarthError(f"Cannot read {name}: {error}.") from error
    except Exception as error:  # the errors of the libraries have many types
        raise BareEarthError(
            f"Cannot read {name}: it is damaged, or no vector file. Give GeoPackage, GeoJSON or a"
            " shapefile."
        ) from error
    if wanted and not by_layer:
        raise BareEarthError(f"{name} has no layer {wanted}. Check its name.")
    filled = [layer for layer in by_layer if by_layer[layer][0]]
    if len(filled) > 1:
        word = {"Polygon": "polygons", "Point": "points"}.get(kind, "lines")
        raise BareEarthError(
            f"{name} has {word} in the layers {', '.join(filled)}. Give one of them:"
            f" '{name}{_LAYER}{filled[0]}'."
        )
    features, crs = by_layer[filled[0]] if filled else ([], None)
    if Path(name).suffix.lower() not in _GEOJSON or not _WGS84.match(crs or ""):
        return features, crs
    # The library takes coordinates as degrees if GeoJSON states no CRS, or an unknown one.
    with open_source(Path(name)) as file:
        stated = _STATED.search(file.read())
    if stated and not _DEGREES.search(stated[0]):
        raise BareEarthError(
            f"The CRS that {name} states is not known. Save it in the CRS of the points."
        )
    return features, None


def _check(path: Path) -> None:
    """Refuse a path that is not a file, and formats that could refer to other files."""
    if path.suffix.lower() in _FOLDERS and path.is_dir():
        return
    if path.suffix.lower() == ".wkt":
        raise BareEarthError(f"{path} is WKT, which is not read. Save it as GeoPackage or GeoJSON.")
    with open_source(path) as file:
        is_xml = file.read(256).lstrip(b"\xef\xbb\xbf \t\r\n").startswith(b"<")
    if is_xml and path.suffix.lower() not in _XML:
        raise BareEarthError(f"{path} is XML, which is not read. Save it as GeoPackage or GeoJSON.")


def _library(name: str) -> Callable[[str, bool], Iterator[_Layer]]:
    """Return the function that reads layers with the installed library."""
    if importlib.util.find_spec("pyogrio") is not None:
        return _by_pyogrio
    if importlib.util.find_spec("osgeo") is not None:
        return _by_gdal
    raise BareEarthError(f"{name} needs pyogrio to be read: pip install pyogrio.")


def _by_pyogrio(name: str, has_attributes: bool) -> Iterator[_Layer]:
    import pyogrio

    for layer, kind in pyogrio.list_layers(name):
        if kind is None:  # a table
            continue
        columns: list[str] | None = None if has_attributes else []  # all, or none
        about, _, shapes, values = pyogrio.raw.read(name, layer, columns=columns)
        # Before 0.13 the fields come in alphabetical order, not in that of the file.
        names = about["fields"].tolist()
        rows = zip(*(column.tolist() for column in values)) if names else [()] * len(shapes)
        features = [(shape, dict(zip(names, row))) for shape, row in zip(shapes, rows)]
        yield _Layer(layer, about["crs"], features)


def _by_gdal(name: str, has_attributes: bool) -> Iterator[_Layer]:
    from osgeo import gdal

    gdal.PushErrorHandler("CPLQuietErrorHandler")
    try:
        source = gdal.OpenEx(name, gdal.OF_VECTOR | gdal.OF_READONLY)
        if source is None:
            raise OSError(f"{name} is no vector file")
        for number in range(source.GetLayerCount()):
            layer, features = source.GetLayer(number), []
            known = layer.GetLayerDefn()
            places = range(known.GetFieldCount() if has_attributes else 0)
            columns = [known.GetFieldDefn(place).GetName() for place in places]
            for feature in layer:
                shape = feature.GetGeometryRef()
                shape = shape.GetLinearGeometry() if shape is not None else None
                values = {column: feature.GetField(column) for column in columns}
                features.append((bytes(shape.ExportToIsoWkb()) if shape else None, values))
            reference = layer.GetSpatialRef()
            yield _Layer(layer.GetName(), reference and reference.ExportToWkt(), features)
    finally:
        gdal.PopErrorHandler()


def _of_kind(layer: _Layer, kind: str) -> Iterator[tuple[Any, dict[str, Any]]]:
    for data, attributes in layer.features:
        for name, coordinates in geometries_of(data) if data else ():
            if name == kind:
                yield coordinates, attributes
