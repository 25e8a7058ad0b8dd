"""Digests of vector files and of JSON."""

from __future__ import annotations

import contextlib
import json
import sqlite3
import struct
from pathlib import Path

import numpy as np

from . import numbers

# Features are sorted by their numbers in steps. The borders between two steps lie at no simple
# fraction, where numbers are frequent that are equal but for their last bits.
_SHIFT = 0.3183
# What JSON says of this run, and not of its result.
_OF_THE_RUN = {"jobs", "seconds", "memory"}
_PLACES = "coordinates"


def of_json(known: object) -> dict[str, str]:
    """Return digests of JSON, whatever the order of its features."""
    return _of_values(_in_order(known))


def _of_values(known: object, name: str = "") -> dict[str, str]:
    """Return digests of all that is no measured number, of the numbers, and of coordinates."""
    found: list[float] = []
    coordinates: list[float] = []
    words = json.dumps(_without_numbers(known, found, coordinates), sort_keys=True)
    drawn = numbers.in_groups(coordinates, numbers.COORDINATES, numbers.STEP)
    begin = f"{name}." if name else ""
    return {
        name: numbers.exactly([words.encode()]),
        f"{begin}values": numbers.rounded(found),
        f"{begin}coordinates": drawn if coordinates else "",
    }


def _without_numbers(known: object, found: list[float], coordinates: list[float]) -> object:
    """Return JSON without its measured numbers, which are put into the lists."""
    if isinstance(known, dict):
        return {
            name: _without_numbers(known[name], coordinates, coordinates)
            if name == _PLACES
            else _without_numbers(known[name], found, coordinates)
            for name in sorted(known)
        }
    if isinstance(known, list):
        return [_without_numbers(item, found, coordinates) for item in known]
    if isinstance(known, float):
        found.append(known)
        return "#"
    return known


def _in_order(value: object) -> object:
    """Return JSON without what is of the run, and with features in one order."""
    if isinstance(value, dict):
        found = {name: _in_order(item) for name, item in value.items() if name not in _OF_THE_RUN}
        if isinstance(found.get("features"), list):
            found["features"] = sorted(found["features"], key=_rank)
        return found
    return [_in_order(item) for item in value] if isinstance(value, list) else value


def _rank(feature: object) -> str:
    return json.dumps(_rounded(feature), sort_keys=True)


def _rounded(value: object) -> object:
    if isinstance(value, dict):
        return {name: _rounded(item) for name, item in value.items()}
    if isinstance(value, list):
        return [_rounded(item) for item in value]
    return _step(value) if isinstance(value, float) else value


def _step(value: float) -> object:
    return int(np.floor(value / numbers.STEP + _SHIFT)) if abs(value) < 1e15 else str(value)


def of_layers(path: Path) -> dict[str, str]:
    """Return digests of each layer of a GeoPackage, its features in one order."""
    found = {}
    with contextlib.closing(sqlite3.connect(path)) as base:
        layers = base.execute(
            "SELECT table_name, column_name, srs_id, geometry_type_name FROM gpkg_geometry_columns"
        )
        for layer, column, *about in layers.fetchall():
            rows = base.execute(f'SELECT * FROM "{layer}"')
            names = [name for name, *_ in rows.description]
            features = [dict(zip(names, row)) for row in rows]
            for feature in features:
                feature.pop("fid", None)
                feature[_PLACES] = _places(feature.pop(column))
            found.update(_of_values([about, *sorted(features, key=_rank)], layer))
    return found


def _places(blob: bytes) -> list[object]:
    """Return the types and coordinates of a geometry of a GeoPackage, as one list."""
    envelope = (0, 32, 48, 48, 64)[blob[3] >> 1 & 7]
    data, found, start = blob[8 + envelope :], [], 0

    def geometry(start: int) -> int:
        (kind,) = struct.unpack_from("<I", data, start + 1)
        kind, depth = kind % 1000 & 0xFF, 3 if kind >= 1000 or kind & 0x80000000 else 2
        found.append(kind)
        start += 5
        if kind == 1:
            return points(start, 1, depth)
        (count,) = struct.unpack_from("<I", data, start)
        start += 4
        if kind == 2:
            return points(start, count, depth)
        for _ in range(count):
            if kind == 3:
                (length,) = struct.unpack_from("<I", data, start)
                start = points(start + 4, length, depth)
            else:
                start = geometry(start)
        return start

    def points(start: int, count: int, depth: int) -> int:
        found.extend(struct.unpack_from(f"<{count * depth}d", data, start))
        return start + 8 * count * depth

    geometry(start)
    return found
