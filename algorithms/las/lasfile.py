"""An opened LAS, LAZ or COPC file: everything but its points.

laspy reads headers and records as well, but when it writes them it drops unknown data. Here
every byte of header and records is kept.
"""

from __future__ import annotations

import math
import struct
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import BinaryIO, Iterator, NamedTuple, Sequence

from ..core.errors import BareEarthError
from ..core.points import Box
from ..core.progress import Progress
from . import header as fields
from .laszip import ChunkHead, Compression
from .sources import FileState, changed, damage_told, damaged, open_source

# Bytes.
VLR_HEADER = 54
EVLR_HEADER = 60
LARGEST_VLR = 65535
LASZIP = ("laszip encoded", 22204)
COPC_INFO = ("copc", 1)
COPC_HIERARCHY = ("copc", 1000)
COPC_EXTENTS = ("copc", 10000)
WAVEFORM_PACKETS = ("LASF_Spec", 65535)

# Record length of each point format, without extra bytes.
RECORD_LENGTHS = (20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67)
# From this point format on, points can have more classes and returns.
FIRST_EXTENDED_FORMAT = 6
_WITHOUT_TIMES = (0, 2)
# Integers of coordinates that are at the limits of 32 bits lie beyond this.
_INTEGERS = (1 << 31) - 2.5
_CUT_OFF = (
    ", the limit of the integers that LAS holds: the program that wrote it cut the coordinates off."
    " Write it again with an offset near the points, or a larger scale."
)
# The integers of points have 32 bits. Slightly larger numbers are allowed, since extents are
# rounded.
_MOST_STEPS = (1 << 31) + 16


@dataclass(frozen=True)
class Vlr:
    """A variable length record; `raw` are all its bytes, including the header."""

    raw: bytes

    @property
    def key(self) -> tuple[str, int]:
        """User id and record id, which identify the kind of record."""
        user, number = struct.unpack_from("<16sH", self.raw, 2)
        return text_of(user), number

    @property
    def description(self) -> str:
        """The description in the record."""
        return text_of(self.raw[22:54])

    @property
    def data(self) -> bytes:
        """The bytes after the record's header."""
        return self.raw[VLR_HEADER:]


@dataclass(frozen=True)
class Evlr:
    """An extended variable length record; `data` is None if it was not read."""

    key: tuple[str, int]  # user id and record id
    description: str
    start: int  # in the file
    length: int  # with its header
    data: bytes | None


class Unpacked(NamedTuple):
    """The uncompressed records of a file, as `unpack` writes them."""

    file: Path | BinaryIO  # an open file is not closed
    columns: tuple[str, ...] | None = None  # as for `read_records`; None for all

    def has(self, columns: Sequence[str] | None) -> bool:
        """Return whether the file has some layers, or all if they are None."""
        if self.columns is None:
            return True
        return columns is not None and set(columns) <= set(self.columns)


@dataclass(frozen=True)
class LasFile:
    """A LAS, LAZ or COPC file: its header, its records and the position of its points."""

    path: Path
    size: int  # bytes
    header: bytes  # with any bytes that users added
    vlrs: tuple[Vlr, ...]
    padding: bytes  # between the last VLR and the points
    evlrs: tuple[Evlr, ...]  # LAS 1.4
    waveform_record: int  # position of waveform packets in this file; 0 for none
    state: FileState  # when it was opened, to notice later changes
    stated: str | None = None  # the CRS that the user states in place of its records
    # A file with the same records uncompressed.
    unpacked: Unpacked | None = field(default=None, compare=False)

    @property
    def minor_version(self) -> int:
        """The y of LAS 1.y."""
        return fields.VERSION.get(self.header)[1]

    @property
    def source_id(self) -> int:
        """The flight strip or other source of the points that state none; 0 if it is not known."""
        return fields.FILE_SOURCE_ID.get(self.header) if self.minor_version else 0

    @property
    def global_encoding(self) -> int:
        """Bit 0 GPS time type, 1 and 2 waveforms inside or outside, 4 CRS as WKT."""
        return fields.GLOBAL_ENCODING.get(self.header)

    @property
    def system_identifier(self) -> str:
        """Hardware or operation that made the points."""
        return text_of(fields.SYSTEM.get(self.header))

    @property
    def software(self) -> str:
        """Software that wrote the file."""
        return text_of(fields.SOFTWARE.get(self.header))

    @property
    def point_format(self) -> int:
        """Point data record format, 0 to 10, without the bits by which LAZ marks compression."""
        return fields.POINT_FORMAT.get(self.header) & 0x3F

    @property
    def is_compressed(self) -> bool:
        """Whether the points are LAZ."""
        return bool(fields.POINT_FORMAT.get(self.header) & 0xC0)

    @property
    def is_copc(self) -> bool:
        """Whether the points are in the octree order of COPC."""
        return any(vlr.key == COPC_INFO for vlr in self.vlrs)

    @property
    def record_length(self) -> int:
        """Bytes of one point, extra bytes included."""
        return fields.RECORD_LENGTH.get(self.header)

    @property
    def extra_bytes(self) -> int:
        """Bytes of one point beyond its format."""
        return self.record_length - RECORD_LENGTHS[self.point_format]

    @property
    def count(self) -> int:
        """Number of points."""
        count = fields.COUNT.get(self.header) if self.minor_version >= 4 else 0
        return count or fields.LEGACY_COUNT.get(self.header)

    @property
    def scale(self) -> tuple[float, float, float]:
        """Factors of the integers of x, y and z."""
        return fields.SCALE.get(self.header)

    @property
    def offset(self) -> tuple[float, float, float]:
        """Values that are added to the scaled integers of x, y and z."""
        return fields.OFFSET.get(self.header)

    @property
    def minimum(self) -> tuple[float, float, float]:
        """Smallest x, y and z in units of the CRS as in the header, which can be wrong."""
        return fields.EXTENT.get(self.header)[1::2]

    @property
    def maximum(self) -> tuple[float, float, float]:
        """Largest x, y and z in units of the CRS as in the header, which can be wrong."""
        return fields.EXTENT.get(self.header)[0::2]

    @property
    def box(self) -> Box:
        """Smallest x and y, largest x and y in the header, in units of the CRS."""
        return (*self.minimum[:2], *self.maximum[:2])

    @property
    def has_gps_times(self) -> bool:
        """Whether points have GPS times."""
        return self.point_format not in _WITHOUT_TIMES

    @property
    def outer_box(self) -> Box:
        """The box, wider by one step of the coordinates, since headers are rounded."""
        (west, south, east, north), (x, y) = self.box, self.scale[:2]
        return west - x, south - y, east + x, north + y

    @property
    def states_extent(self) -> bool:
        """Whether integers of points can have the extent in the header, with finite heights."""
        corners = self.minimum, self.maximum
        return all(math.isfinite(corner[2]) for corner in corners) and all(
            abs(corner[axis] - self.offset[axis]) <= _MOST_STEPS * self.scale[axis]
            for corner in corners
            for axis in (0, 1)
        )

    @property
    def points_start(self) -> int:
        """Position of the points."""
        return fields.POINTS_START.get(self.header)

    @property
    def points_end(self) -> int:
        """End of the points, if they are not compressed."""
        return self.points_start + self.count * self.record_length

    @cached_property
    def tail_start(self) -> int:
        """Position of the first byte after the points that outputs keep."""
        # In LAS, it is the end of the points. In LAZ, it is the first EVLR or waveform packet,
        # since the length of the chunk table before them is not known.
        if not self.is_compressed:
            return self.points_end
        starts = [evlr.start for evlr in self.evlrs[:1]]
        return min([*starts, self.waveform_record or self.size, self.size])

    @property
    def laszip(self) -> bytes | None:
        """The record with the compression of the points; None if they are not compressed."""
        return next((vlr.data for vlr in self.vlrs if vlr.key == LASZIP), None)

    def vlr(self, *key: tuple[str, int]) -> Vlr | Evlr | None:
        """Return the first VLR or EVLR that has one of the keys."""
        records: tuple[Vlr | Evlr, ...] = (*self.vlrs, *self.evlrs)
        return next((record for record in records if record.key in key), None)

    def check_limits(self) -> None:
        """Refuse points whose x, y or z are all cut off at the limit of 32 bits."""
        for name, value, are_all in self._cut_off:
            if are_all:
                raise BareEarthError(f"{name} of all points of {self.path} is {value}{_CUT_OFF}")

    def report_limits(self, progress: Progress) -> None:
        """Warn of points some of whose coordinates are cut off at the limit of 32 bits."""
        for name, value, are_all in self._cut_off:
            if not are_all:
                progress.warning(f"{name} of some points of {self.path.name} is {value}{_CUT_OFF}")

    @property
    def _cut_off(self) -> Iterator[tuple[str, str, bool]]:
        """The axes whose extent in the header ends at the limit of 32 bits, the value there, and
        whether all points have it.
        """
        for axis, low, high, scale, offset in zip(
            "xyz", self.minimum, self.maximum, self.scale, self.offset
        ):
            for value in (low, high) if self.states_extent and scale else ():
                if abs((value - offset) / scale) > _INTEGERS:
                    yield axis, f"{value:.10g}", low == high

    def check_unchanged(self) -> None:
        """Refuse a file whose size, time, place on the disk, or bytes before the points have
        changed since it was opened.
        """
        with open_source(self.path) as file:
            before = b"".join((self.header, *(vlr.raw for vlr in self.vlrs), self.padding))
            if not self.state.is_same(FileState.of(file)) or file.read(len(before)) != before:
                raise changed(self.path)

    @property
    def layers(self) -> int:
        """Number of layers of each chunk of compressed points; 0 if there are none."""
        compression = Compression.of(self.laszip or b"") if self.is_compressed else None
        return compression.layers if compression else 0

    @property
    def chunk_head(self) -> ChunkHead:
        """The head of the chunks of compressed points, if they have layers."""
        return ChunkHead(self.record_length, self.layers)

    @cached_property
    def chunk_table(self) -> list[tuple[int, int]]:
        """Points and bytes of each chunk of a compressed file, from its chunk table; refuse
        impossible ones.
        """
        import lazrs

        with open_source(self.path) as file, damage_told(self.path):
            file.seek(self.points_start)
            table = lazrs.read_chunk_table(file, lazrs.LazVlr(self.laszip))
            compression, place = Compression.of(self.laszip or b""), self.points_start + 8
            if compression is None or not compression.table_fits(table, self.count, self._room):
                raise damaged(self.path)
            head = self.chunk_head
            for _, size in table if head.layers else ():
                file.seek(place)
                if size and not head.fits(file.read(head.size), size):
                    raise damaged(self.path)
                place += size
        return table

    @property
    def _room(self) -> int:
        """Largest possible size of the compressed points."""
        return self.size - self.points_start - 8

    def prefix(self, vlrs: tuple[Vlr, ...], compressed: bool) -> bytearray:
        """Return header, the given VLRs and padding, with consistent counts and positions."""
        records = b"".join(vlr.raw for vlr in vlrs)
        prefix = bytearray(self.header + records + self.padding)
        fields.POINTS_START.put(prefix, len(prefix))
        fields.VLR_COUNT.put(prefix, len(vlrs))
        fields.POINT_FORMAT.put(prefix, self.point_format | (0x80 if compressed else 0))
        return prefix

    def kept_tail(self, *dropped: tuple[str, int]) -> list[tuple[int, int]]:
        """Return the ranges of bytes after the points, without EVLRs that have one of the keys."""
        ranges, start = [], self.tail_start
        for evlr in self.evlrs:
            if evlr.key in dropped and evlr.start >= start:
                ranges.append((start, evlr.start))
                start = evlr.start + evlr.length
        return [*ranges, (start, self.size)]

    def pointers(self, tail: list[tuple[int, int]], new_start: int) -> dict[int, int]:
        """Return the pointer to write at each position in the header, after the ranges of
        `kept_tail` were moved to a new start.
        """
        # Stale pointers, which some writers leave, are left out.
        known = [fields.WAVEFORM_START, fields.EVLR_START][: max(self.minor_version - 2, 0)]
        pointers = {field.start: field.get(self.header) for field in known}
        return {
            place: new_start + sum(min(max(old - start, 0), end - start) for start, end in tail)
            for place, old in pointers.items()
            if self.tail_start <= old <= self.size
        }


def new_vlr(key: tuple[str, int], data: bytes, description: str) -> Vlr:
    """Return a variable length record."""
    user, number = key
    head = struct.pack("<H16sHH32s", 0, user.encode(), number, len(data), description.encode())
    return Vlr(head + data)


def text_of(field: bytes) -> str:
    """Return the text in a field, up to the first zero."""
    return field.split(b"\0")[0].decode("utf-8", "replace").strip()
