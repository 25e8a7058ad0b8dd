"""Reading vector files by a library: pyogrio, or GDAL in QGIS, which pass on geometries as WKB.

References
----------
OGC 06-103r4, Simple feature access, part 1, section 8: the types, with 1000 added for z, 2000 for m
and 3000 for both. Extended WKB marks the same by the highest bits.
"""

from __future__ import annotations

import importlib.util
import struct
import warnings
from pathlib import Path
from typing import Any, Iterator, NamedTuple, Sequence

import numpy as np

from ..core.errors import BareEarthError
from ..las.sources import open_source

# Between a file and the name of a layer, as QGIS writes it.
_LAYER = "|layername="
_FOLDERS = (".gdb",)
# XML that the library may read. Other XML can tell it to fetch files from other computers.
_XML = (".kml", ".gpx")
_POINT, _LINE, _POLYGON, _COLLECTIONS = 1, 2, 3, (4, 5, 6, 7)
_HAS_Z, _HAS_M, _HAS_SRID = 1 << 31, 1 << 30, 1 << 29
# Collections in collections; data with more is not valid.
_MOST_LEVELS = 20


class _Layer(NamedTuple):
    """A layer: its name, its CRS, and the WKB and attributes of its features."""

    name: str
    crs: str | None
    features: Sequence[tuple[bytes | None, dict[str, Any]]]


def read_features(
    path: Path | str, kind: str, attribute: str | None
) -> tuple[list[tuple[Any, dict[str, Any]]], str | None]:
    """Read the geometries of a kind ("Polygon", "LineString" or "Point") with attributes, None for
    all, and the CRS of the layer as code or WKT.
    """
    # Coordinates are as in GeoJSON; ``FILE|layername=NAME`` is one layer of a file, without which
    # several layers with such geometries are refused.
    name, _, wanted = str(path).partition(_LAYER)
    _check(Path(name))
    reads = _library(name)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # on what is left out of geometries, such as M
            layers = [layer for layer in reads(name, attribute) if wanted in ("", layer.name)]
        found = {layer.name: (list(_of_kind(layer, kind)), layer.crs) for layer in layers}
    except (BareEarthError, MemoryError):
        raise
    except ValueError as error:  # of a geometry
        raise BareEarthError(f"Cannot read {name}: {error}.") from error
    except Exception as error:  # the errors of the libraries have many types
        raise BareEarthError(
            f"Cannot read {name}: it is damaged, or no vector file. Give GeoJSON, WKT, GeoPackage"
            " or a shapefile."
        ) from error
    if wanted and not found:
        raise BareEarthError(f"{name} has no layer {wanted}. Check its name.")
    filled = [layer for layer in found if found[layer][0]]
    if len(filled) > 1:
        what = {"Polygon": "polygons", "Point": "points"}.get(kind, "lines")
        raise BareEarthError(
            f"{name} has {what} in the layers {', '.join(filled)}. Give one of them:"
            f" '{name}{_LAYER}{filled[0]}'."
        )
    return found[filled[0]] if filled else ([], None)


def _check(path: Path) -> None:
    """Refuse what is no file, and files that could refer to others."""
    if path.suffix.lower() in _FOLDERS and path.is_dir():
        return
    with open_source(path) as file:
        is_xml = file.read(256).lstrip(b"\xef\xbb\xbf \t\r\n").startswith(b"<")
    if is_xml and path.suffix.lower() not in _XML:
        raise BareEarthError(f"{path} is XML, which is not read. Save it as GeoPackage or GeoJSON.")


def _library(name: str) -> Any:
    """Return the function that reads with the installed library."""
    if importlib.util.find_spec("pyogrio") is not None:
        return _by_pyogrio
    if importlib.util.find_spec("osgeo") is not None:
        return _by_gdal
    raise BareEarthError(
        f"{name} needs pyogrio to be read: pip install pyogrio. GeoJSON (.geojson, .json) and WKT"
        " (.wkt) are read without it."
    )


def _by_pyogrio(name: str, attribute: str | None) -> Iterator[_Layer]:
    import pyogrio

    for layer, kind in pyogrio.list_layers(name):
        if kind is None:  # a table
            continue
        fields = pyogrio.read_info(name, layer)["fields"].tolist()
        columns = [field for field in fields if attribute in (None, field)]
        about, _, shapes, values = pyogrio.raw.read(name, layer, columns=columns)
        # Before 0.13 the fields come in alphabetical order, not in that of the file.
        names = about["fields"].tolist()
        rows = zip(*(column.tolist() for column in values)) if names else [()] * len(shapes)
        features = [(shape, dict(zip(names, row))) for shape, row in zip(shapes, rows)]
        yield _Layer(layer, about["crs"], features)


def _by_gdal(name: str, attribute: str | None) -> Iterator[_Layer]:
    from osgeo import gdal

    gdal.PushErrorHandler("CPLQuietErrorHandler")
    try:
        source = gdal.OpenEx(name, gdal.OF_VECTOR | gdal.OF_READONLY)
        if source is None:
            raise OSError(f"{name} is no vector file")
        for number in range(source.GetLayerCount()):
            layer, features = source.GetLayer(number), []
            known = layer.GetLayerDefn()
            fields = [known.GetFieldDefn(place).GetName() for place in range(known.GetFieldCount())]
            columns = [field for field in fields if attribute in (None, field)]
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
    """Yield coordinates and attributes of the geometries of a kind in a layer."""
    for data, attributes in layer.features:
        for name, coordinates in _geometries_of(data) if data else ():
            if name == kind:
                yield coordinates, attributes


def _geometries_of(data: bytes) -> Iterator[tuple[str, Any]]:
    """Yield the points, float64 (2,) or (3,), lines (n, 2) or (n, 3), and polygons (lists of rings)
    of a geometry, also of collections; ValueError for others, such as arcs.
    """
    # m is left out, and so are empty points.
    try:
        found: list[tuple[str, Any]] = []
        _read_wkb(data, 0, found, 0)
    except struct.error as error:
        raise ValueError("a geometry is cut off") from error
    yield from found


def _read_wkb(data: bytes, start: int, found: list[tuple[str, Any]], level: int) -> int:
    """Add the geometry that starts at a byte; return where it ends."""
    order = "<" if data[start : start + 1] == b"\x01" else ">"
    (code,) = struct.unpack_from(f"{order}I", data, start + 1)
    start += 9 if code & _HAS_SRID else 5
    plain = code & 0xFFFF
    kind, flags = plain % 1000, plain // 1000
    has_z = flags in (1, 3) or bool(code & _HAS_Z)
    width = 2 + has_z + (flags in (2, 3) or bool(code & _HAS_M))
    if kind == _POINT:
        corners, start = _corners(data, start, order, 1, width, has_z)
        if not np.isnan(corners[0, :2]).all():  # an empty point
            found.append(("Point", corners[0]))
        return start
    (count,) = struct.unpack_from(f"{order}I", data, start)
    start += 4
    if kind == _LINE:
        corners, start = _corners(data, start, order, count, width, has_z)
        found.append(("LineString", corners))
    elif kind == _POLYGON:
        rings = []
        for _ in range(count):
            (length,) = struct.unpack_from(f"{order}I", data, start)
            ring, start = _corners(data, start + 4, order, length, width, has_z)
            rings.append(ring)
        found.append(("Polygon", rings))
    elif kind in _COLLECTIONS and level < _MOST_LEVELS:
        for _ in range(count):
            start = _read_wkb(data, start, found, level + 1)
    else:
        raise ValueError(f"a geometry has a type that is not read ({plain}), such as an arc")
    return start


def _corners(
    data: bytes, start: int, order: str, count: int, width: int, has_z: bool
) -> tuple[np.ndarray, int]:
    """Return the corners that start at a byte, without m, and where they end."""
    end = start + 8 * count * width
    if end > len(data):
        raise ValueError("a geometry is cut off")
    values = np.frombuffer(data[start:end], dtype=f"{order}f8").reshape(count, width)
    return values[:, : 2 + has_z].astype(np.float64), end
