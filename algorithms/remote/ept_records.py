"""Tiles of EPT that are not LAZ files: rows of numbers, described by a schema.

References
----------
Entwine Point Tile specification 1.1, "schema" and "dataType"; names of dimensions: PDAL
"""

from __future__ import annotations

import contextlib
import struct
from typing import Iterable, Sequence

import numpy as np

from ..core.errors import BareEarthError
from ..crs.stated import stated_wkt
from ..las import header as fields
from ..las.extrabytes import EXTRA_BYTES
from ..las.lasfile import RECORD_LENGTHS, new_vlr
from ..las.records import as_points
from .answers import Document

_KINDS = {"unsigned": "u", "signed": "i", "float": "f", "floating": "f"}
# Types of extra bytes in LAS, by kind and size.
_TYPES = {
    "u1": 1, "i1": 2, "u2": 3, "i2": 4, "u4": 5, "i4": 6, "u8": 7, "i8": 8, "f4": 9, "f8": 10,
}  # fmt: skip
_NAMES = {
    "Intensity": "intensity", "ReturnNumber": "return_number",
    "NumberOfReturns": "number_of_returns", "ScanDirectionFlag": "scan_direction_flag",
    "EdgeOfFlightLine": "edge_of_flight_line", "Classification": "classification",
    "UserData": "user_data", "PointSourceId": "point_source_id", "GpsTime": "gps_time",
    "ScanChannel": "scanner_channel", "Synthetic": "synthetic", "KeyPoint": "key_point",
    "Withheld": "withheld", "Overlap": "overlap", "Red": "red", "Green": "green", "Blue": "blue",
    "Infrared": "nir",
}  # fmt: skip
_FLAGS = ("synthetic", "key_point", "withheld", "overlap")  # the bits of ClassFlags
_CLASS_FLAGS = "ClassFlags"
_ANGLE = "ScanAngleRank"
_ANGLE_UNIT = 0.006  # degrees, of scan angles since LAS 1.4
_OFFSETS = tuple("XYZ")
# Scales for coordinates that are not integers, in units of the CRS and in degrees.
_STEP = 0.001
_STEP_DEGREES = 1e-8


class Schema:
    """The dimensions of the points of a data set."""

    def __init__(
        self, described: Iterable[Document], cube: Sequence[float], is_geographic: bool
    ) -> None:
        """Read the schema (ValueError, TypeError or KeyError if it is wrong); coordinates that are
        not integers of 32 bits are converted to such, relative to the cube of the octree.
        """
        rows = [
            (str(row["name"]), f"<{_KINDS[row['type']]}{int(row['size'])}") for row in described
        ]
        self._row = np.dtype(rows)
        names, known = set(self._row.names or ()), {row["name"]: row for row in described}
        self._stated = {
            axis: (float(known[axis].get("scale", 1.0)), float(known[axis].get("offset", 0.0)))
            for axis in _OFFSETS
        }
        self._scale, self._offset = map(list, zip(*self._stated.values()))
        for number, axis in enumerate(_OFFSETS):
            (scale, offset), kind = self._stated[axis], self._row[axis]
            middle = (cube[number] + cube[3 + number]) / 2
            if kind.kind == "f":
                scale = _STEP_DEGREES if is_geographic and axis != "Z" else _STEP
                offset = float(np.floor(middle))
            elif kind.itemsize > 2 and kind != np.dtype("<i4"):
                offset += scale * float(np.rint((middle - offset) / scale))
            self._scale[number], self._offset[number] = scale, offset
        self._format = 8 if "Infrared" in names else 7 if "Red" in names else 6
        usual = {*_OFFSETS, *_NAMES, _ANGLE, _CLASS_FLAGS}
        self._extra = [name for name in self._row.names or () if name not in usual]
        for name in self._extra:
            _TYPES[self._row[name].str[1:]]

    def las(self, data: bytes, count: int) -> bytes:
        """Return the points of a tile as a LAS file without a CRS; ValueError if there are fewer or
        more.
        """
        size = count * self._row.itemsize
        if len(data) != size:
            raise ValueError(f"{len(data):,} bytes, not {size:,}")
        rows = np.frombuffer(data, dtype=self._row)
        extra = [(name, self._row[name].itemsize) for name in self._extra]
        length = RECORD_LENGTHS[self._format] + sum(bytes_of for _, bytes_of in extra)
        records = np.zeros((count, length), dtype=np.uint8)
        points = as_points(
            self._format, [(f"extra {n}", s) for n, (_, s) in enumerate(extra)], records
        )
        for number, axis in enumerate(_OFFSETS):
            points[axis] = self._integers(rows[axis], number)
        for name in self._row.names or ():
            if name in _NAMES:
                points[_NAMES[name]] = rows[name]
        if _ANGLE in (self._row.names or ()):
            points["scan_angle"] = np.rint(rows[_ANGLE] / _ANGLE_UNIT).astype(np.int16)
        for bit, name in enumerate(_FLAGS if _CLASS_FLAGS in (self._row.names or ()) else ()):
            points[name] = rows[_CLASS_FLAGS] >> bit & 1
        place = RECORD_LENGTHS[self._format]
        for name, bytes_of in extra:
            raw = np.ascontiguousarray(rows[name]).view(np.uint8).reshape(count, bytes_of)
            records[:, place : place + bytes_of] = raw
            place += bytes_of
        return self._header(count, length) + records.tobytes()

    def _integers(self, values: np.ndarray, axis: int) -> np.ndarray:
        """Return coordinates as the integers of the output; ValueError if they do not fit."""
        (stated_scale, stated_offset), kind = self._stated[_OFFSETS[axis]], values.dtype
        scale, offset = self._scale[axis], self._offset[axis]
        if kind.kind == "f":
            whole = np.rint((values * stated_scale + (stated_offset - offset)) / scale)
        else:
            whole = values.astype(np.int64) - np.rint((offset - stated_offset) / scale).astype(
                np.int64
            )
        if not (np.abs(whole) < 1 << 31).all():  # or no number
            raise ValueError("coordinates lie too far outside of the cube")
        return whole.astype(np.int32)

    def _header(self, count: int, length: int) -> bytes:
        descriptors = b"".join(
            struct.pack("<2xBB32s156x", _TYPES[self._row[name].str[1:]], 0, name.encode()[:32])
            for name in self._extra
        )
        vlrs = [new_vlr(EXTRA_BYTES, descriptors, "Extra bytes")] if descriptors else []
        header = bytearray(fields.HEADER_SIZES[4])
        header[:4] = b"LASF"
        fields.VERSION.put(header, 1, 4)
        fields.HEADER_SIZE.put(header, len(header))
        fields.POINTS_START.put(header, len(header) + sum(len(vlr.raw) for vlr in vlrs))
        fields.VLR_COUNT.put(header, len(vlrs))
        fields.POINT_FORMAT.put(header, self._format)
        fields.RECORD_LENGTH.put(header, length)
        fields.SCALE.put(header, *self._scale)
        fields.OFFSET.put(header, *self._offset)
        fields.COUNT.put(header, count)
        return bytes(header) + b"".join(vlr.raw for vlr in vlrs)


def wkt_of(srs: object) -> str | None:
    """Return the CRS of a description as well-known text, if it says one."""
    about, text = (srs, srs.get("wkt")) if isinstance(srs, dict) else ({}, None)
    if isinstance(text, str) and text.strip():
        return text.strip()
    text = srs if isinstance(srs, str) else ""
    if str(about.get("authority", "")).upper() == "EPSG":
        text = f"EPSG:{about.get('horizontal')}"
    with contextlib.suppress(BareEarthError):  # it is invalid, or needs a library
        return stated_wkt(text)
    return None
