"""Reading polygons, lines and points: files by a library, geometries in memory here."""

from __future__ import annotations

import itertools
import re
from os import PathLike
from typing import Any, Callable, Dict, Iterable, Iterator, Mapping, Sized, Tuple

import numpy as np

from ..core.errors import BareEarthError
from ..crs.provider import LONGITUDE_LATITUDE
from .area import Polygon
from .shapes import Shapes
from .vector_library import read_features
from .wkb import geometries_of

# The attributes of a geometry, and its coordinates with these.
_Attributes = Dict[str, Any]
_Feature = Tuple[Any, _Attributes]
# Errors while reading what is not valid GeoJSON.
_INVALID = (
    ValueError, TypeError, KeyError, IndexError, AttributeError, RecursionError, OverflowError
)  # fmt: skip
# The attributes of a polygon that hold its class, and the answer of who looked at it.
CLASS_FIELD = "class"
ANSWER_FIELD = "answer"
# For the help of options.
FORMATS = (
    "GeoPackage, GeoJSON, shapefile and others, which pyogrio reads; if the file states its CRS, it"
    " is transformed to that of the points"
)
# A CRS in GeoJSON: EPSG:25832, urn:ogc:def:crs:EPSG::25832, or a URL that ends with EPSG/0/25832.
_CRS_NAME = re.compile(r"(EPSG|ESRI|IGNF|OGC|CRS)[:/](?:[\w.]*[:/])?(\w+)$", re.IGNORECASE)
# Levels of lists: a line is a list of corners, a polygon a list of rings.
_DEPTHS = {"LineString": 1, "Polygon": 2}
FRAME = "The GeoDataFrame"  # how messages name a table of geopandas
_GEOMETRY = "The geometry"  # how they name GeoJSON, and objects that know theirs
# The attribute of objects that know their GeoJSON.
_KNOWS = "__geo_interface__"
# Units of any CRS; libraries read numbers that are too large as large ones.
_FARTHEST = 1e12
_WORDS = {"LineString": "line", "Polygon": "polygon", "Point": "point"}


def is_frame(given: object) -> bool:
    """Return whether an input is a GeoDataFrame or a GeoSeries of geopandas."""
    return hasattr(given, "geometry") and hasattr(given, "to_crs")


def is_source(given: object) -> bool:
    """Return whether an input is a file, GeoJSON, or geometries of a library."""
    return isinstance(given, (str, PathLike)) or is_frame(given) or _geojson_of(given) is not None


def read_boundary(source: object, may_be_empty: bool = False) -> tuple[Polygon, ...]:
    """Read the polygons, and no other geometries, of a file, a GeoDataFrame, GeoJSON, objects with
    `__geo_interface__`, or arrays of rings.
    """
    return _shapes(source, "Polygon", lambda rings, _: _polygon(rings), may_be_empty)


def read_polygons_with_attributes(source: object) -> tuple[Shapes, tuple[_Attributes, ...]]:
    """Read the polygons of a source with all of their attributes, and no other geometries."""
    pairs = _shapes(
        source, "Polygon", lambda rings, values: (_polygon(rings), values), has_attributes=True
    )
    polygons, attributes = zip(*pairs)
    return Shapes(polygons, pairs.crs, pairs.source), attributes


def read_lines(source: object, may_be_empty: bool = False) -> tuple[np.ndarray, ...]:
    """Read the lines of a source, and no other geometries."""
    return _shapes(source, "LineString", lambda corners, _: _line(corners), may_be_empty)


def read_points(source: object) -> tuple[tuple[np.ndarray, dict[str, Any]], ...]:
    """Read x, y and z of the points of a source, float64 (3,) with NaN for a missing z, and all of
    their attributes.
    """
    return _shapes(
        source, "Point", lambda place, values: (_line([place])[0], values), has_attributes=True
    )


def name_among(names: Iterable[str], wanted: str) -> str | None:
    """Return the name of an attribute, the exact one or else in any case; None for none."""
    # Formats and databases write names in upper or lower case as they like.
    names = list(names)
    if wanted in names:
        return wanted
    key = _key(wanted)
    return next((name for name in names if _key(name) == key), None)


def value_of(attributes: Mapping[str, Any], wanted: str) -> Any:
    """Return the value of an attribute by its name in any case; None if it is missing."""
    # Where features of a file write it differently, each of them has all names.
    found = attributes.get(wanted)
    if not _is_none(found):
        return found
    key = _key(wanted)
    others = (one for name, one in attributes.items() if _key(name) == key and not _is_none(one))
    return next(others, found)


def _is_none(value: object) -> bool:
    return value is None or value == "" or value != value


def _key(name: object) -> str:
    return str(name).strip().lower()


def _shapes(
    source: object,
    kind: str,
    shape_of: Callable[[Any, _Attributes], Sized],
    may_be_empty: bool = False,
    has_attributes: bool = False,  # whether those of a file are read
) -> Shapes:
    """Return what `shape_of` makes of coordinates and attributes of geometries of a kind."""
    word, crs = _WORDS[kind], None
    features: Iterable[_Feature]
    try:
        if is_frame(source):
            label, (features, crs) = FRAME, _of_frame(source, kind)
        elif isinstance(source, (str, PathLike)):
            label = str(source)
            features, crs = read_features(label, kind, has_attributes)
        elif (content := _geojson_of(source)) is not None:
            label, (features, crs) = _GEOMETRY, _of_geojson(content, kind)
        else:
            label, features = f"The {word}", _of_arrays(source, kind)
            if kind == "Polygon":
                # Corners in arrays keep their heights. Those of polygons in files are mostly zero.
                shape_of = _polygon_with_heights
        shapes = tuple(shape_of(*feature) for feature in features)
    except _INVALID as error:
        raise BareEarthError(f"{label} is not valid: {_one_line(error)}.") from error
    if not any(map(len, shapes)) and not may_be_empty:
        raise BareEarthError(f"{label} holds no {word}. Give one that does.")
    return Shapes(shapes, crs, label)


def shapes_of(given: Any, kind: str, may_be_empty: bool = False) -> tuple[Any, ...]:
    """Return polygons or lines, given as a source or as arrays of corners; a source without any is
    refused unless it `may_be_empty`.
    """
    if given is None or isinstance(given, Shapes):
        return given or ()
    if hasattr(given, "__next__"):
        given = [*given]
    read = {"Polygon": read_boundary, "LineString": read_lines}[kind]
    if is_source(given):
        return read(given, may_be_empty)
    # Corners in arrays are in the CRS of the points.
    return () if isinstance(given, (list, tuple)) and not given else tuple(read(given))


def _geojson_of(given: Any) -> Any:
    """Return geometries in memory as GeoJSON: a dict, or one or several objects with
    `__geo_interface__`, as of shapely; None for anything else.
    """
    if isinstance(given, dict):
        return given
    if hasattr(given, _KNOWS):
        return given.__geo_interface__
    if isinstance(given, (str, PathLike)) or not hasattr(given, "__len__"):
        return None
    geometries = [
        _geojson_of(item) for item in given if isinstance(item, dict) or hasattr(item, _KNOWS)
    ]
    if not geometries:
        return None
    if len(geometries) < len(given):
        raise BareEarthError(
            "A list of geometries must hold nothing but GeoJSON and geometries as shapely has."
        )
    return {"type": "GeometryCollection", "geometries": geometries}


def _of_arrays(given: Any, kind: str) -> Iterator[_Feature]:
    """Yield the corners of one or several lines, or the rings of polygons, without attributes."""
    depth, first = 0, given
    while isinstance(first, (list, tuple, np.ndarray)) and len(first):
        depth, first = depth + 1, first[0]
    for _ in range(depth, _DEPTHS[kind] + 2):
        given = [given]
    yield from ((corners, {}) for corners in given)


def _of_frame(frame: Any, kind: str) -> tuple[Iterable[_Feature], str | None]:
    """Return coordinates and attributes of each geometry of a kind, and the CRS of a frame."""
    shapes = frame.geometry
    rows: Iterable[_Attributes] = itertools.repeat({})
    # For a frame without other columns, older versions of pandas return no records.
    if len(getattr(frame, "columns", ())) > 1:
        rows = frame.drop(columns=shapes.name).to_dict("records")
    features = (
        (coordinates, attributes)
        for data, attributes in zip(shapes.to_wkb(), rows)
        for name, coordinates in (geometries_of(data) if data else ())
        if name == kind
    )
    if shapes.crs is None:
        return features, None
    return features, ":".join(shapes.crs.to_authority() or ()) or shapes.crs.to_wkt()


def _one_line(error: Exception) -> str:
    return " ".join(str(error).split()).rstrip(".") or type(error).__name__


def _polygon(rings: Any, columns: int = 2) -> Polygon:
    polygon = []
    for ring in rings:
        corners = np.array(
            [list(map(float, (corner[0], corner[1], *corner[2:columns]))) for corner in ring]
        )
        if len(corners):
            polygon.append(_finite(corners))
    return tuple(polygon)


def _polygon_with_heights(rings: Any, _: _Attributes) -> Polygon:
    return _polygon(rings, 3)


def _line(corners: Any) -> np.ndarray:
    rows = [[float(number) for number in corner[:3]] for corner in corners]
    return _finite(np.array([row + [np.nan] * (3 - len(row)) for row in rows]).reshape(-1, 3))


def _finite(corners: np.ndarray) -> np.ndarray:
    """Return corners; refuse values that are not finite."""
    if not (np.abs(corners[:, :2]) <= _FARTHEST).all():
        raise ValueError("a corner is not a finite number, or not on this planet")
    return corners


def _of_geojson(content: Any, kind: str) -> tuple[Iterable[_Feature], str | None]:
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


def _nodes_of(content: Any, kind: str) -> Iterator[_Feature]:
    """Yield coordinates and attributes of each geometry of a kind in GeoJSON, in order."""
    nodes: list[_Feature] = [(content, {})]
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
            children = node["features" if name == "FeatureCollection" else "geometries"]
            nodes += [(child, attributes) for child in reversed(children)]
