"""Positions of the fields in the header of a LAS file.

References
----------
ASPRS LAS specifications 1.0 to 1.4, table "Public Header Block". Each version only adds fields at
the end.
"""

from __future__ import annotations

import struct
from typing import Any, NamedTuple


class Field(NamedTuple):
    """A field of the header."""

    start: int  # its first byte
    layout: str  # for `struct`

    def get(self, header: bytes | bytearray) -> Any:
        """Return the value in a header; a tuple if there are several."""
        values = struct.unpack_from(f"<{self.layout}", header, self.start)
        return values if len(values) > 1 else values[0]

    def put(self, header: bytearray, *values: float | bytes) -> None:
        """Write the values into a header."""
        struct.pack_into(f"<{self.layout}", header, self.start, *values)


FILE_SOURCE_ID = Field(4, "H")  # since LAS 1.1
GLOBAL_ENCODING = Field(6, "H")
VERSION = Field(24, "2B")
SYSTEM = Field(26, "32s")
SOFTWARE = Field(58, "32s")
# The day of the year, and the year.
CREATION = Field(90, "2H")
HEADER_SIZE = Field(94, "H")
POINTS_START = Field(96, "I")
VLR_COUNT = Field(100, "I")
POINT_FORMAT = Field(104, "B")
RECORD_LENGTH = Field(105, "H")
LEGACY_COUNT = Field(107, "I")
LEGACY_RETURNS = Field(111, "5I")
SCALE = Field(131, "3d")
OFFSET = Field(155, "3d")
# Largest and smallest x, largest and smallest y, largest and smallest z.
EXTENT = Field(179, "6d")
Z_EXTENT = Field(211, "2d")
# Since LAS 1.3, and since LAS 1.4.
WAVEFORM_START = Field(227, "Q")
EVLR_START = Field(235, "Q")
EVLR_COUNT = Field(243, "I")
COUNT = Field(247, "Q")
RETURNS = Field(255, "15Q")
# Bytes of a header of LAS 1.0 to 1.4.
HEADER_SIZES = {0: 227, 1: 227, 2: 227, 3: 235, 4: 375}
