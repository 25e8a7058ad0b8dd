"""The columns of records: the fields of each point, by the names that they have in laspy.

laspy is not used: its import takes as long as to read a million points.

References
----------
ASPRS LAS specifications 1.0 to 1.4, tables "Point Data Record Format".
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any, Iterable, Mapping

import numpy as np

from .extrabytes import runs_of_bytes
from .lasfile import FIRST_EXTENDED_FORMAT, LasFile

_XYZ = {"X": "<i4", "Y": "<i4", "Z": "<i4", "intensity": "<u2"}
_LEGACY = {
    **_XYZ, "returns": "u1", "class_and_flags": "u1", "scan_angle_rank": "i1", "user_data": "u1",
    "point_source_id": "<u2",
}  # fmt: skip
_EXTENDED = {
    **_XYZ, "returns": "u1", "flags": "u1", "classification": "u1", "user_data": "u1",
    "scan_angle": "<i2", "point_source_id": "<u2", "gps_time": "<f8",
}  # fmt: skip
_TIME, _COLOURS, _NIR = {"gps_time": "<f8"}, dict.fromkeys(("red", "green", "blue"), "<u2"), "<u2"
_WAVEFORMS = {
    "wavepacket_index": "u1", "wavepacket_offset": "<u8", "wavepacket_size": "<u4",
    "return_point_wave_location": "<f4", "x_t": "<f4", "y_t": "<f4", "z_t": "<f4",
}  # fmt: skip
# Names and types of the fields of each point format.
_FORMATS: tuple[Mapping[str, str], ...] = (
    _LEGACY,
    {**_LEGACY, **_TIME},
    {**_LEGACY, **_COLOURS},
    {**_LEGACY, **_TIME, **_COLOURS},
    {**_LEGACY, **_TIME, **_WAVEFORMS},
    {**_LEGACY, **_TIME, **_COLOURS, **_WAVEFORMS},
    _EXTENDED,
    {**_EXTENDED, **_COLOURS},
    {**_EXTENDED, **_COLOURS, "nir": _NIR},
    {**_EXTENDED, **_WAVEFORMS},
    {**_EXTENDED, **_COLOURS, "nir": _NIR, **_WAVEFORMS},
)
# The field, the first bit and the number of bits of what shares a byte.
_LEGACY_BITS = {
    "return_number": ("returns", 0, 3),
    "number_of_returns": ("returns", 3, 3),
    "scan_direction_flag": ("returns", 6, 1),
    "edge_of_flight_line": ("returns", 7, 1),
    "classification": ("class_and_flags", 0, 5),
    "synthetic": ("class_and_flags", 5, 1),
    "key_point": ("class_and_flags", 6, 1),
    "withheld": ("class_and_flags", 7, 1),
}
_EXTENDED_BITS = {
    "return_number": ("returns", 0, 4),
    "number_of_returns": ("returns", 4, 4),
    "synthetic": ("flags", 0, 1),
    "key_point": ("flags", 1, 1),
    "withheld": ("flags", 2, 1),
    "overlap": ("flags", 3, 1),
    "scanner_channel": ("flags", 4, 2),
    "scan_direction_flag": ("flags", 6, 1),
    "edge_of_flight_line": ("flags", 7, 1),
}


class Columns:
    """The columns of records (uint8, (n, record length)), which stay where they are."""

    def __init__(
        self, point_format: int, extra: Iterable[tuple[str, int]], records: np.ndarray
    ) -> None:
        self.records = records
        is_extended = point_format >= FIRST_EXTENDED_FORMAT
        self._bits = _EXTENDED_BITS if is_extended else _LEGACY_BITS
        self._fields = records.view(_type_of(point_format, tuple(extra)))[:, 0]

    def __len__(self) -> int:
        return len(self.records)

    def __contains__(self, name: str) -> bool:
        return name in self._bits or name in (self._fields.dtype.names or ())

    def __getitem__(self, name: str) -> np.ndarray:
        """Return a column: a view of the records, or a copy if it shares its bytes."""
        return self.part(name, slice(None))

    def __setitem__(self, name: str, values: np.ndarray) -> None:
        """Change a column; a value too large for its bits becomes the largest that fits."""
        if name not in self._bits:
            self._fields[name] = values
            return
        field, first, count = self._bits[name]
        largest, whole = (1 << count) - 1, self._fields[field]
        whole &= np.uint8(0xFF ^ (largest << first))
        whole |= np.minimum(values, largest).astype(np.uint8) << np.uint8(first)

    def part(self, name: str, part: slice) -> np.ndarray:
        """Return some points of a column."""
        if name not in self._bits:
            return self._fields[name][part]
        field, first, count = self._bits[name]
        return (self._fields[field][part] >> np.uint8(first)) & np.uint8((1 << count) - 1)

    def copy_from(self, others: Columns) -> None:
        """Copy all columns that both have, but for extra bytes of another size."""
        whole = [name for name in self._fields.dtype.names or () if name not in _SHARED]
        for name in (*whole, *self._bits):
            if name in others and others[name].shape == self[name].shape:
                self[name] = others[name]


_SHARED = {field for bits in (_LEGACY_BITS, _EXTENDED_BITS) for field, _, _ in bits.values()}


@lru_cache(maxsize=64)
def _type_of(point_format: int, extra: tuple[tuple[str, int], ...]) -> np.dtype:
    """Return the type of a record; its extra bytes are one column, or one for each name."""
    sizes = {name: "u1" if size == 1 else f"{size}u1" for name, size in extra if size}
    fields: Any = list({**_FORMATS[point_format], **sizes}.items())
    return np.dtype(fields)


def named(layout: LasFile, records: np.ndarray) -> Columns:
    """Return the columns of records of a file."""
    return Columns(layout.point_format, runs_of_bytes(layout), records)


def column(records: np.ndarray, start: int, kind: str | np.dtype) -> np.ndarray:
    """Return the field that begins at a byte of each record, as a writable view."""
    # numpy before 1.23 cannot view some columns as another type, but whole rows.
    row: Any = {"names": ["field"], "formats": [kind], "offsets": [start]}
    row["itemsize"] = records.shape[1]
    return records.view(np.dtype(row))["field"][:, 0]
