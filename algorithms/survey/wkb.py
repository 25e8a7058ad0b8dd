"""Well-known binary (WKB), in which libraries pass on geometries.

References
----------
OGC 06-103r4, Simple feature access, part 1, section 8: the types, with 1000 added for z, 2000 for m
and 3000 for both. Extended WKB marks the same by the highest bits.
"""

from __future__ import annotations

import struct
from typing import Iterator, List, Tuple, Union

import numpy as np

# Numbers of the types of geometries.
_POINT = 1
_LINE = 2
_POLYGON = 3
_COLLECTIONS = (4, 5, 6, 7)
# Bits of the type in extended well-known binary, as PostGIS writes it.
_HAS_Z = 1 << 31
_HAS_M = 1 << 30
_HAS_SRID = 1 << 29
# Collections in collections; data with more is not valid.
_MOST_LEVELS = 20


# The name of its type in GeoJSON, and its coordinates; of a polygon, those of each ring.
_Geometry = Tuple[str, Union[np.ndarray, List[np.ndarray]]]


def geometries_of(data: bytes) -> Iterator[_Geometry]:
    """Yield the points, float64 (2,) or (3,), lines (n, 2) or (n, 3), and polygons (lists of rings)
    of a geometry or a collection; ValueError for other types, such as arcs.
    """
    # Values of m and empty points are left out.
    try:
        geometries: list[_Geometry] = []
        _read(data, 0, geometries, 0)
    except struct.error as error:
        raise ValueError("a geometry is cut off") from error
    yield from geometries


def _read(data: bytes, start: int, geometries: list[_Geometry], level: int) -> int:
    """Add the geometry that starts at a byte to a list; return where the geometry ends."""
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
            geometries.append(("Point", corners[0]))
        return start
    (count,) = struct.unpack_from(f"{order}I", data, start)
    start += 4
    if kind == _LINE:
        corners, start = _corners(data, start, order, count, width, has_z)
        geometries.append(("LineString", corners))
    elif kind == _POLYGON:
        rings = []
        for _ in range(count):
            (length,) = struct.unpack_from(f"{order}I", data, start)
            ring, start = _corners(data, start + 4, order, length, width, has_z)
            rings.append(ring)
        geometries.append(("Polygon", rings))
    elif kind in _COLLECTIONS and level < _MOST_LEVELS:
        for _ in range(count):
            start = _read(data, start, geometries, level + 1)
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
