"""Reading polygons and lines from GeoJSON and WKT files."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any, Callable, Iterator, TypeVar

import numpy as np

from ..core.errors import BareEarthError
from ..las.sources import read_text
from .area import Polygon
from .corrections import CLASS_FIELD, Corrections

_Shape = TypeVar("_Shape")

_WKT_PART = re.compile(r"[()]|[^()]+")
# Errors while reading a text that is not valid GeoJSON or WKT.
_INVALID = (
    ValueError, TypeError, KeyError, IndexError, AttributeError, RecursionError, OverflowError
)  # fmt: skip
# Levels of lists: a line is a list of corners, a polygon a list of rings.
_DEPTHS = {"LineString": 1, "Polygon": 2}


def read_boundary(path: Path) -> tuple[Polygon, ...]:
    """Read the polygons of a GeoJSON or WKT file, and nothing else.

    Parameters
    ----------
    path : Path
        A .geojson, .json or .wkt file.

    Returns
    -------
    tuple of tuple of numpy.ndarray of float64, shape (n, 2)
        The rings of each polygon.

    Raises
    ------
    BareEarthError
        If the file cannot be read, is not valid, or holds no polygon.
    """
    return _shapes(path, "Polygon", lambda rings, _: _polygon(rings))


def read_corrections(path: Path) -> Corrections:
    """Read the polygons of a GeoJSON file with their classes, and nothing else.

    Parameters
    ----------
    path : Path
        A .geojson or .json file whose features have the property `class`.

    Raises
    ------
    BareEarthError
        If the file cannot be read, is not valid, holds no polygon, or a polygon has no class.
    """
    if Path(path).suffix.lower() == ".wkt":
        raise BareEarthError(f"{path} holds no classes. Give the corrections as GeoJSON.")
    polygons, classes = zip(*_shapes(path, "Polygon", _polygon_with_class))
    return Corrections(polygons, classes)


def read_lines(path: Path) -> tuple[np.ndarray, ...]:
    """Read the lines of a GeoJSON or WKT file, and nothing else.

    Parameters
    ----------
    path : Path
        As for `read_boundary`, with the same errors.

    Returns
    -------
    tuple of numpy.ndarray of float64, shape (n, 3)
        x, y and z of the corners of each line; NaN for z where the file has none.
    """
    return _shapes(path, "LineString", lambda corners, _: _line(corners))


def _shapes(path: Path, kind: str, made: Callable[[Any, dict], _Shape]) -> tuple[_Shape, ...]:
    """Return what `made` returns for coordinates and attributes of each geometry of a kind."""
    path, what = Path(path), "polygon" if kind == "Polygon" else "line"
    suffix = path.suffix.lower()
    if suffix not in (".geojson", ".json", ".wkt"):
        raise BareEarthError(
            f"{path} is not a {'boundary' if what == 'polygon' else 'file of lines'} that can be"
            " read. Give GeoJSON (.geojson, .json) or WKT (.wkt); 'ogr2ogr -f GeoJSON -t_srs"
            " CRS_OF_THE_POINTS boundary.geojson FILE' converts other formats."
        )
    try:
        text = read_text(path)
    except UnicodeDecodeError:
        raise BareEarthError(f"{path} is not a text file. Give GeoJSON or WKT.") from None
    try:
        found = _of_wkt(text, kind) if suffix == ".wkt" else _of_geojson(text, kind)
        shapes = tuple(made(*each) for each in found)
    except _INVALID as error:
        name = "WKT" if suffix == ".wkt" else "GeoJSON"
        raise BareEarthError(f"{path} is not valid {name}: {_one_line(error)}.") from error
    if not any(map(len, shapes)):
        raise BareEarthError(f"{path} holds no {what}. Give one that does.")
    return shapes


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
    rows = [[float(each) for each in corner[:3]] for corner in corners]
    return _finite(np.array([row + [np.nan] * (3 - len(row)) for row in rows]).reshape(-1, 3))


def _finite(corners: np.ndarray) -> np.ndarray:
    """Return corners; refuse those that are not finite."""
    if not np.isfinite(corners[:, :2]).all():
        raise ValueError("a corner is not a finite number")
    return corners


def _of_geojson(text: str, kind: str) -> Iterator[tuple[Any, dict]]:
    """Yield coordinates and attributes of each geometry of a kind in a GeoJSON text, in order."""
    nodes = [(json.loads(text), {})]
    while nodes:
        node, attributes = nodes.pop()
        if node is None:  # a feature without geometry
            continue
        name = node["type"]
        if name == kind:
            yield node["coordinates"], attributes
        elif name == f"Multi{kind}":
            yield from ((each, attributes) for each in node["coordinates"])
        elif name == "Feature":
            nodes.append((node["geometry"], node.get("properties") or {}))
        elif name in ("FeatureCollection", "GeometryCollection"):
            some = node["features" if name == "FeatureCollection" else "geometries"]
            nodes += [(each, attributes) for each in reversed(some)]


def _of_wkt(text: str, kind: str) -> Iterator[tuple[Any, dict]]:
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
