"""Reading polygons, lines and points: GeoJSON and WKT here, other formats by a library."""

from __future__ import annotations

import itertools
import json
import re
from os import PathLike
from pathlib import Path
from typing import Any, Callable, Iterator

import numpy as np

from ..core.errors import BareEarthError
from ..crs.provider import LONGITUDE_LATITUDE
from ..las.sources import read_text
from .area import Polygon
from .corrections import CLASS_FIELD, Corrections
from .shapes import Shapes
from .vector_library import read_features
from .wkb import geometries_of

_WKT_PART = re.compile(r"[()]|[^()]+")
# Errors while reading a text that is not valid GeoJSON or WKT.
_INVALID = (
    ValueError, TypeError, KeyError, IndexError, AttributeError, RecursionError, OverflowError
)  # fmt: skip
# Formats that are read here, without a library.
_TEXTS = {".geojson": "GeoJSON", ".json": "GeoJSON", ".wkt": "WKT"}
# For the help of options.
FORMATS = (
    "GeoJSON, WKT, or with pyogrio GeoPackage, shapefile and others; if the file states its CRS, it"
    " is transformed to that of the points"
)
# A CRS in GeoJSON: EPSG:25832, urn:ogc:def:crs:EPSG::25832, or a URL that ends with EPSG/0/25832.
_CRS_NAME = re.compile(r"(EPSG|ESRI|IGNF|OGC|CRS)[:/](?:[\w.]*[:/])?(\w+)$", re.IGNORECASE)
_SRID = re.compile(r"\s*SRID\s*=\s*(\d+)\s*;", re.IGNORECASE)
# Levels of lists: a line is a list of corners, a polygon a list of rings.
_DEPTHS = {"LineString": 1, "Polygon": 2}
# How messages name a table of geopandas, and GeoJSON and objects that know it.
FRAME, _GEOMETRY = "The GeoDataFrame", "The geometry"
# The attribute of objects that know their GeoJSON.
_KNOWS = "__geo_interface__"
_WORDS = {"LineString": "line", "Polygon": "polygon", "Point": "point"}


def is_frame(given: Any) -> bool:
    """Return whether a user gives a GeoDataFrame or a GeoSeries of geopandas."""
    return hasattr(given, "geometry") and hasattr(given, "to_crs")


def is_source(given: Any) -> bool:
    """Return whether a user gives a file, GeoJSON, or objects of a library as geometries."""
    return isinstance(given, (str, PathLike)) or is_frame(given) or _geojson_of(given) is not None


def read_boundary(source: Any) -> tuple[Polygon, ...]:
    """Read the polygons of a file, of a GeoDataFrame, of GeoJSON or objects that can become it, or
    of arrays of rings, and nothing else.
    """
    return _shapes(source, "Polygon", lambda rings, _: _polygon(rings))


def read_corrections(source: Any) -> Corrections:
    """Read the polygons of the same with their classes, and nothing else."""
    if isinstance(source, (str, PathLike)) and Path(source).suffix.lower() == ".wkt":
        raise BareEarthError(f"{source} holds no classes. Give the corrections as GeoJSON.")
    found = _shapes(source, "Polygon", _polygon_with_class)
    polygons, classes = zip(*found)
    return Corrections(Shapes(polygons, found.crs, found.source), classes)


def read_lines(source: Any) -> tuple[np.ndarray, ...]:
    """Read the lines of the same, and nothing else."""
    return _shapes(source, "LineString", lambda corners, _: _line(corners))


def read_points(source: Any) -> tuple[tuple[np.ndarray, dict[str, Any]], ...]:
    """Read x, y and z of the points of the same, but no .wkt, float64 (3,), NaN for z where there
    is none, and all of their attributes.
    """
    return _shapes(source, "Point", lambda place, attributes: (_line([place])[0], attributes))


def _shapes(source: Any, kind: str, shape_of: Callable[[Any, dict], Any]) -> Shapes:
    """Return what `shape_of` returns for coordinates and attributes of each geometry of a kind."""
    what, name, crs = _WORDS[kind], "", None
    try:
        if is_frame(source):
            label, (found, crs) = FRAME, _of_frame(source, kind)
        elif isinstance(source, (str, PathLike)):
            label, name = str(source), _TEXTS.get(Path(source).suffix.lower(), "")
            if name:
                text = _text_of(source)
                read = _of_wkt if name == "WKT" else _of_geojson
                found, crs = read(text if name == "WKT" else json.loads(text), kind)
            else:
                found, crs = read_features(source, kind, None if kind == "Point" else CLASS_FIELD)
        elif (content := _geojson_of(source)) is not None:
            label, (found, crs) = _GEOMETRY, _of_geojson(content, kind)
        else:
            label, found = f"The {what}", _of_arrays(source, kind)
        shapes = tuple(shape_of(*feature) for feature in found)
    except _INVALID as error:
        as_what = f" {name}" if name else ""
        raise BareEarthError(f"{label} is not valid{as_what}: {_one_line(error)}.") from error
    if not any(map(len, shapes)):
        raise BareEarthError(f"{label} holds no {what}. Give one that does.")
    return Shapes(shapes, crs, label)


def shapes_of(given: Any, kind: str) -> tuple[Any, ...]:
    """Return polygons or lines, given as a source or as arrays of corners; perhaps none."""
    if given is None or isinstance(given, Shapes):
        return given or ()
    if hasattr(given, "__next__"):
        given = [*given]
    read = {"Polygon": read_boundary, "LineString": read_lines}[kind]
    if is_source(given):
        return read(given)
    # Corners in arrays are in the CRS of the points.
    return () if isinstance(given, (list, tuple)) and not given else tuple(read(given))


def _geojson_of(given: Any) -> Any:
    """Return geometries in memory as GeoJSON: a dict of it, or an object with `__geo_interface__`
    as shapely has, one or several; None for anything else.
    """
    if isinstance(given, dict):
        return given
    if hasattr(given, _KNOWS):
        return given.__geo_interface__
    if isinstance(given, (str, PathLike)) or not hasattr(given, "__len__"):
        return None
    some = [_geojson_of(one) for one in given if isinstance(one, dict) or hasattr(one, _KNOWS)]
    if not some:
        return None
    if len(some) < len(given):
        raise BareEarthError(
            "A list of geometries must hold nothing but GeoJSON and geometries as shapely has."
        )
    return {"type": "GeometryCollection", "geometries": some}


def _of_arrays(given: Any, kind: str) -> Iterator[tuple[Any, dict]]:
    """Yield corners, or rings of corners, of lists or of one alone; no attributes."""
    depth, first = 0, given
    while isinstance(first, (list, tuple, np.ndarray)) and len(first):
        depth, first = depth + 1, first[0]
    for _ in range(depth, _DEPTHS[kind] + 2):
        given = [given]
    yield from ((one, {}) for one in given)


def _of_frame(frame: Any, kind: str) -> tuple[Iterator[tuple[Any, dict]], str | None]:
    """Return coordinates and attributes of each geometry of a kind, and the CRS of a frame."""
    shapes, rows = frame.geometry, itertools.repeat({})
    # Of a frame without other columns, older pandas returns no records.
    if len(getattr(frame, "columns", ())) > 1:
        rows = frame.drop(columns=shapes.name).to_dict("records")
    found = (
        (coordinates, attributes)
        for data, attributes in zip(shapes.to_wkb(), rows)
        for name, coordinates in (geometries_of(data) if data else ())
        if name == kind
    )
    if shapes.crs is None:
        return found, None
    return found, ":".join(shapes.crs.to_authority() or ()) or shapes.crs.to_wkt()


def _text_of(path: Path) -> str:
    try:
        return read_text(path)
    except UnicodeDecodeError:
        raise BareEarthError(f"{path} is not a text file. Give GeoJSON or WKT.") from None


def _one_line(error: Exception) -> str:
    return " ".join(str(error).split()).rstrip(".") or type(error).__name__


def _polygon(rings: Any) -> Polygon:
    polygon = []
    for ring in rings:
        corners = np.array([(float(corner[0]), float(corner[1])) for corner in ring])
        if len(corners):
            polygon.append(_finite(corners))
    return tuple(polygon)


def _polygon_with_class(rings: Any, attributes: dict) -> tuple[Polygon, Any]:
    return _polygon(rings), attributes.get(CLASS_FIELD)


def _line(corners: Any) -> np.ndarray:
    rows = [[float(number) for number in corner[:3]] for corner in corners]
    return _finite(np.array([row + [np.nan] * (3 - len(row)) for row in rows]).reshape(-1, 3))


def _finite(corners: np.ndarray) -> np.ndarray:
    """Return corners; refuse those that are not finite."""
    if not np.isfinite(corners[:, :2]).all():
        raise ValueError("a corner is not a finite number")
    return corners


def _of_geojson(content: Any, kind: str) -> tuple[Iterator[tuple[Any, dict]], str | None]:
    """Return coordinates and attributes of each geometry of a kind, and the CRS that is stated."""
    crs = content.get("crs")
    if crs is None:
        return _nodes_of(content, kind), None
    named = _CRS_NAME.search(str(crs["properties"]["name"]))
    if named is None:
        raise ValueError(f"its CRS, {crs['properties']['name']}, is not a code such as EPSG:25832")
    authority, code = named[1].upper(), named[2].upper()
    is_degrees = authority in ("OGC", "CRS") and code in ("CRS84", "84", "CRS84H")
    return _nodes_of(content, kind), LONGITUDE_LATITUDE if is_degrees else f"{authority}:{code}"


def _nodes_of(content: Any, kind: str) -> Iterator[tuple[Any, dict]]:
    """Yield coordinates and attributes of each geometry of a kind in GeoJSON, in order."""
    nodes = [(content, {})]
    while nodes:
        node, attributes = nodes.pop()
        if node is None:  # a feature without geometry
            continue
        name = node["type"]
        if name == kind:
            yield node["coordinates"], attributes
        elif name == f"Multi{kind}":
            yield from ((coordinates, attributes) for coordinates in node["coordinates"])
        elif name == "Feature":
            nodes.append((node["geometry"], node.get("properties") or {}))
        elif name in ("FeatureCollection", "GeometryCollection"):
            some = node["features" if name == "FeatureCollection" else "geometries"]
            nodes += [(child, attributes) for child in reversed(some)]


def _of_wkt(text: str, kind: str) -> tuple[Iterator[tuple[Any, dict]], str | None]:
    """Return the coordinates of each geometry of a kind, and the CRS of extended WKT."""
    stated = _SRID.match(text)
    return _wkt_of(text, kind), f"EPSG:{stated[1]}" if stated else None


def _wkt_of(text: str, kind: str) -> Iterator[tuple[Any, dict]]:
    """Yield the coordinates of each geometry of a kind in a text that holds WKT; no attributes."""
    name = rf"\b(MULTI)?{kind.upper()}\s*(?:ZM|Z|M)?\s*(?=\()"
    for match in re.finditer(name, text, re.IGNORECASE):
        # Depths of parentheses at the corners, and at a whole geometry.
        corners_at = _DEPTHS[kind] + bool(match[1])
        whole_at = corners_at - _DEPTHS[kind]
        depth, runs = 0, []
        for part in map(re.Match.group, _WKT_PART.finditer(text, match.end())):
            depth += {"(": 1, ")": -1}.get(part, 0)
            if depth == corners_at and part not in "()":
                runs.append([corner.split() for corner in part.split(",")])
            elif part == ")" and depth == whole_at and runs:
                yield (runs if kind == "Polygon" else runs[0]), {}
                runs = []
            if depth == 0:
                break
        if depth:
            raise ValueError("a parenthesis is not closed")
