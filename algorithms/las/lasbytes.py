"""The bytes of a LAS or LAZ file around its points: header, VLRs and EVLRs.

Page numbers are not cited, since offsets differ in nothing but what a version adds: see the tables
"Public Header Block", "Variable Length Record Header" and "Extended Variable Length Record Header"
of the LAS 1.0 to 1.4 specifications.
"""

from __future__ import annotations

import math
import struct
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import BinaryIO, Sequence

from ..core.errors import BareEarthError
from .laszip import ChunkHead, Compression
from .sources import FileState, changed, damage_told, damaged, open_source

VLR_HEADER, EVLR_HEADER, LARGEST_VLR = 54, 60, 65535
LASZIP = ("laszip encoded", 22204)
COPC_INFO = ("copc", 1)
COPC_HIERARCHY = ("copc", 1000)
COPC_EXTENTS = ("copc", 10000)
WAVEFORM_PACKETS = ("LASF_Spec", 65535)
EVLR_COUNT = 243

# Bytes of a record of each point format, before extra bytes.
RECORD_LENGTHS = (20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67)
HEADER_SIZES = {0: 227, 1: 227, 2: 227, 3: 235, 4: 375}
_MOST_EVLRS = 1_000_000
_LARGEST_KEPT = 1 << 20
# Integers of points have 32 bits; a few more, since extents are rounded.
_MOST_STEPS = (1 << 31) + 16
# In units of the CRS: beyond these, coordinates are no numbers that can be calculated with.
_SMALLEST_SCALE, _LARGEST_SCALE, _LARGEST_OFFSET = 1e-12, 1e6, 1e12

_ENCODING, _VERSION, _SYSTEM, _SOFTWARE, _HEADER_SIZE = 6, 24, 26, 58, 94
_POINTS_START, _VLR_COUNT, _FORMAT, _RECORD_LENGTH, _LEGACY_COUNT = 96, 100, 104, 105, 107
_SCALE, _OFFSET, _EXTENT, _WAVEFORM_START, _EVLR_START, _COUNT = 131, 155, 179, 227, 235, 247
_Z_RANGE, _LEGACY_RETURNS, _RETURNS = 211, 111, 255
_LEGACY_RETURN_COUNT, _RETURN_COUNT = 5, 15
_LAST_LEGACY_FORMAT = 5


@dataclass(frozen=True)
class Vlr:
    """A variable length record; `raw` are all its bytes, header included."""

    raw: bytes

    @property
    def key(self) -> tuple[str, int]:
        """User id and record id, which together say what the record is."""
        user, number = struct.unpack_from("<16sH", self.raw, 2)
        return _text(user), number

    @property
    def description(self) -> str:
        """What the writer of the record says of it."""
        return _text(self.raw[22:54])

    @property
    def data(self) -> bytes:
        """The bytes after the record's header."""
        return self.raw[VLR_HEADER:]


@dataclass(frozen=True)
class Evlr:
    """An extended variable length record; `data` is None where it is large.

    Attributes
    ----------
    key : tuple of (str, int)
        User id and record id.
    start, length : int
        Where the record begins in the file, and its bytes, header included.
    """

    key: tuple[str, int]
    description: str
    start: int
    length: int
    data: bytes | None


@dataclass(frozen=True)
class LasLayout:
    """What lies where in a LAS or LAZ file.

    Attributes
    ----------
    path : Path
        The file.
    size : int
        Its bytes.
    header : bytes
        The header, with the bytes that users may have added to it.
    vlrs : tuple of Vlr
        The records after it.
    padding : bytes
        What lies between the last VLR and the points.
    evlrs : tuple of Evlr
        The records after the points (LAS 1.4).
    waveform_record : int
        Where the waveform packets lie inside this file (LAS 1.3 and 1.4); 0 if they do not.
    state : FileState
        By what it is seen that the file changed since.
    """

    path: Path
    size: int
    header: bytes
    vlrs: tuple[Vlr, ...]
    padding: bytes
    evlrs: tuple[Evlr, ...]
    waveform_record: int
    state: FileState

    def _get(self, layout: str, start: int):
        values = struct.unpack_from("<" + layout, self.header, start)
        return values if len(values) > 1 else values[0]

    @property
    def minor_version(self) -> int:
        """The y of LAS 1.y."""
        return self.header[_VERSION + 1]

    @property
    def global_encoding(self) -> int:
        """Bit 0 GPS time type, 1 and 2 waveforms inside or outside, 4 CRS as WKT."""
        return self._get("H", _ENCODING)

    @property
    def system_identifier(self) -> str:
        """Hardware or operation that made the points."""
        return _text(self.header[_SYSTEM : _SYSTEM + 32])

    @property
    def software(self) -> str:
        """Software that wrote the file."""
        return _text(self.header[_SOFTWARE : _SOFTWARE + 32])

    @property
    def point_format(self) -> int:
        """Point data record format, 0 to 10, without the bits by which LAZ marks compression."""
        return self.header[_FORMAT] & 0x3F

    @property
    def is_compressed(self) -> bool:
        """Whether the points are LAZ."""
        return bool(self.header[_FORMAT] & 0xC0)

    @property
    def is_copc(self) -> bool:
        """Whether the points are in the octree order of COPC."""
        return any(vlr.key == COPC_INFO for vlr in self.vlrs)

    @property
    def record_length(self) -> int:
        """Bytes of one point, extra bytes included."""
        return self._get("H", _RECORD_LENGTH)

    @property
    def extra_bytes(self) -> int:
        """Bytes of one point that its format does not define."""
        return self.record_length - RECORD_LENGTHS[self.point_format]

    @property
    def count(self) -> int:
        """Number of points."""
        count = self._get("Q", _COUNT) if self.minor_version >= 4 else 0
        return count or self._get("I", _LEGACY_COUNT)

    @property
    def scale(self) -> tuple[float, float, float]:
        """By what the integers of x, y and z are multiplied."""
        return self._get("3d", _SCALE)

    @property
    def offset(self) -> tuple[float, float, float]:
        """What is then added to them."""
        return self._get("3d", _OFFSET)

    @property
    def minimum(self) -> tuple[float, float, float]:
        """Smallest x, y and z in units of the CRS, as the header has them: it may be wrong."""
        return self._get("6d", _EXTENT)[1::2]

    @property
    def maximum(self) -> tuple[float, float, float]:
        """Largest x, y and z in units of the CRS, as the header has them: it may be wrong."""
        return self._get("6d", _EXTENT)[0::2]

    @property
    def states_extent(self) -> bool:
        """Whether the extent in the header is one that the integers of points can have.

        Heights only have to be numbers.
        """
        corners = self.minimum, self.maximum
        return all(math.isfinite(corner[2]) for corner in corners) and all(
            abs(corner[axis] - self.offset[axis]) <= _MOST_STEPS * self.scale[axis]
            for corner in corners
            for axis in (0, 1)
        )

    @property
    def points_start(self) -> int:
        """Where the points begin."""
        return self._get("I", _POINTS_START)

    @property
    def points_end(self) -> int:
        """Where the points end, if they are not compressed."""
        return self.points_start + self.count * self.record_length

    @cached_property
    def tail_start(self) -> int:
        """Where the first byte after the points lies that is to be kept.

        LAS: whatever follows the points. LAZ: the first of the EVLRs and the waveform packets, for
        the length of the chunk table before them is not known.
        """
        if not self.is_compressed:
            return self.points_end
        starts = [evlr.start for evlr in self.evlrs[:1]]
        return min([*starts, self.waveform_record or self.size, self.size])

    @property
    def laszip(self) -> bytes | None:
        """What the record before the points says of their compression; None if there is none."""
        return next((vlr.data for vlr in self.vlrs if vlr.key == LASZIP), None)

    def vlr(self, *key: tuple[str, int]) -> Vlr | Evlr | None:
        """Return the first VLR or EVLR that has one of the keys."""
        return next((each for each in (*self.vlrs, *self.evlrs) if each.key in key), None)

    def check_unchanged(self) -> None:
        """Refuse a file that is another one than when it was opened.

        Raises
        ------
        BareEarthError
            If its size, time, place on the disk, or what lies before its points differs.
        """
        with open_source(self.path) as file:
            before = b"".join((self.header, *(vlr.raw for vlr in self.vlrs), self.padding))
            if FileState.of(file) != self.state or file.read(len(before)) != before:
                raise changed(self.path)

    @cached_property
    def chunk_table(self) -> list[tuple[int, int]]:
        """Points and bytes of each chunk of a compressed file, as its chunk table says.

        Raises
        ------
        BareEarthError
            If the file cannot have such chunks.
        """
        import lazrs

        with open_source(self.path) as file, damage_told(self.path):
            file.seek(self.points_start)
            table = lazrs.read_chunk_table(file, lazrs.LazVlr(self.laszip))
            compression, place = Compression.of(self.laszip), self.points_start + 8
            if not compression.table_fits(table, self.count, self._room):
                raise damaged(self.path)
            head = ChunkHead(self.record_length, compression.layers)
            for _, size in table if head.layers else ():
                file.seek(place)
                if size and not head.fits(file.read(head.size), size):
                    raise damaged(self.path)
                place += size
        return table

    @property
    def _room(self) -> int:
        """Most bytes that compressed points can have."""
        return self.size - self.points_start - 8

    def prefix(self, vlrs: tuple[Vlr, ...], compressed: bool) -> bytearray:
        """Return header, the given VLRs and padding, with what follows from them mended."""
        records = b"".join(vlr.raw for vlr in vlrs)
        prefix = bytearray(self.header + records + self.padding)
        struct.pack_into("<II", prefix, _POINTS_START, len(prefix), len(vlrs))
        prefix[_FORMAT] = self.point_format | (0x80 if compressed else 0)
        return prefix

    def kept_tail(self, *dropped: tuple[str, int]) -> list[tuple[int, int]]:
        """Return the ranges of bytes after the points, without the EVLRs that have such a key."""
        ranges, start = [], self.tail_start
        for evlr in self.evlrs:
            if evlr.key in dropped and evlr.start >= start:
                ranges.append((start, evlr.start))
                start = evlr.start + evlr.length
        return [*ranges, (start, self.size)]

    def pointers(self, tail: list[tuple[int, int]], new_start: int) -> dict[int, int]:
        """Return what the header is to say of what follows the points, now that it has moved.

        Parameters
        ----------
        tail : list of tuple of int
            Ranges that are kept, as from `kept_tail`.
        new_start : int
            Where the first of them begins now.

        Returns
        -------
        dict of int to int
            The pointer to write at each place of the header. One that did not lead behind the
            points (some writers leave stale ones) is not among them.
        """
        places = {3: [_WAVEFORM_START], 4: [_WAVEFORM_START, _EVLR_START]}
        found = {place: self._get("Q", place) for place in places.get(self.minor_version, [])}
        return {
            place: new_start + sum(min(max(at - start, 0), end - start) for start, end in tail)
            for place, at in found.items()
            if self.tail_start <= at <= self.size
        }


def new_vlr(key: tuple[str, int], data: bytes, description: str) -> Vlr:
    """Return a variable length record."""
    user, number = key
    head = struct.pack("<H16sHH32s", 0, user.encode(), number, len(data), description.encode())
    return Vlr(head + data)


def with_record_length(layout: LasLayout, length: int) -> LasLayout:
    """Return the layout with another number of bytes for each point."""
    header = bytearray(layout.header)
    struct.pack_into("<H", header, _RECORD_LENGTH, length)
    return replace(layout, header=bytes(header))


def with_z_range(layout: LasLayout, lowest: int, highest: int) -> LasLayout:
    """Return the layout with another extent of the heights, which are given as integers."""
    header, scale, offset = bytearray(layout.header), layout.scale[2], layout.offset[2]
    extent = highest * scale + offset, lowest * scale + offset
    struct.pack_into("<2d", header, _Z_RANGE, *extent)
    return replace(layout, header=bytes(header))


def with_count(layout: LasLayout, count: int) -> LasLayout:
    """Return the layout with another number of points; see `with_statistics` for the rest."""
    header = bytearray(layout.header)
    legacy = layout.minor_version < 4 or layout.point_format <= _LAST_LEGACY_FORMAT
    struct.pack_into("<I", header, _LEGACY_COUNT, count if legacy and count < 1 << 32 else 0)
    if layout.minor_version >= 4:
        struct.pack_into("<Q", header, _COUNT, count)
    return replace(layout, header=bytes(header))


def with_statistics(
    layout: LasLayout, lowest: Sequence[int], highest: Sequence[int], returns: Sequence[int]
) -> LasLayout:
    """Return the layout with another extent, and other numbers of points of each return.

    Parameters
    ----------
    lowest, highest : sequence of int
        Smallest and largest x, y and z as integers.
    returns : sequence of int
        How many first, second, ... returns there are; fifteen numbers.
    """
    header = bytearray(layout.header)
    for axis, (scale, offset) in enumerate(zip(layout.scale, layout.offset)):
        extent = highest[axis] * scale + offset, lowest[axis] * scale + offset
        struct.pack_into("<2d", header, _EXTENT + 16 * axis, *extent)
    legacy = layout.minor_version < 4 or layout.point_format <= _LAST_LEGACY_FORMAT
    old = [each if legacy and each < 1 << 32 else 0 for each in returns[:_LEGACY_RETURN_COUNT]]
    struct.pack_into(f"<{_LEGACY_RETURN_COUNT}I", header, _LEGACY_RETURNS, *old)
    if layout.minor_version >= 4:
        struct.pack_into(f"<{_RETURN_COUNT}Q", header, _RETURNS, *returns)
    return replace(layout, header=bytes(header))


def read_layout(path: Path | LasLayout) -> LasLayout:
    """Read what lies around the points of a file; what was read already is given back.

    Raises
    ------
    BareEarthError
        If it cannot be opened, is not LAS or LAZ, is cut off, or has no points.
    """
    if isinstance(path, LasLayout):
        return path
    path = Path(path)
    with open_source(path) as file:
        state = FileState.of(file)
        size = state.size
        header = _read_header(path, file, size)
        points_start, vlr_count = struct.unpack_from("<II", header, _POINTS_START)
        vlrs, padding = _split_vlrs(file.read(points_start - len(header)), vlr_count)
        evlrs, waveforms = _read_evlrs(file, size, header)
    layout = LasLayout(path, size, header, vlrs, padding, evlrs, waveforms, state)
    _check_points(layout)
    return layout


def _read_header(path: Path, file: BinaryIO, size: int) -> bytes:
    start = file.read(375)
    if start[:4] != b"LASF":
        raise BareEarthError(
            f"{path} is not a LAS or LAZ file. Give a .las, .laz or .copc.laz file."
        )
    if len(start) < HEADER_SIZES[0]:
        raise damaged(path)
    major, minor = start[_VERSION], start[_VERSION + 1]
    if major != 1 or minor not in HEADER_SIZES:
        raise BareEarthError(
            f"{path} is LAS {major}.{minor}; LAS 1.0 to 1.4 can be read. Convert it first."
        )
    header_size, points_start = struct.unpack_from("<HI", start, _HEADER_SIZE)
    if not HEADER_SIZES[minor] <= header_size <= points_start or points_start > size:
        raise damaged(path)
    file.seek(0)
    return file.read(header_size)


def _split_vlrs(block: bytes, count: int) -> tuple[tuple[Vlr, ...], bytes]:
    """Split what lies between header and points into VLRs and padding.

    A record that does not fit, or more records announced than there are, end the list: points can
    be read all the same.
    """
    vlrs, start = [], 0
    while len(vlrs) < count and start + VLR_HEADER <= len(block):
        end = start + VLR_HEADER + struct.unpack_from("<H", block, start + 20)[0]
        if end > len(block):
            break
        vlrs.append(Vlr(block[start:end]))
        start = end
    return tuple(vlrs), block[start:]


def _read_evlrs(file: BinaryIO, size: int, header: bytes) -> tuple[tuple[Evlr, ...], int]:
    minor = header[_VERSION + 1]
    evlrs, waveforms = [], 0
    if minor >= 4:
        start, count = struct.unpack_from("<QI", header, _EVLR_START)
        while len(evlrs) < min(count, _MOST_EVLRS):
            evlr = _read_evlr(file, size, start)
            if evlr is None:
                break
            evlrs.append(evlr)
            start += evlr.length
    if minor >= 3:
        # Some writers leave a stale pointer: only what is such a record at that place counts.
        start = struct.unpack_from("<Q", header, _WAVEFORM_START)[0]
        evlr = _read_evlr(file, size, start) if start else None
        if evlr is not None and evlr.key == WAVEFORM_PACKETS:
            waveforms = start
    return tuple(evlrs), waveforms


def _read_evlr(file: BinaryIO, size: int, start: int) -> Evlr | None:
    if start + EVLR_HEADER > size:
        return None
    file.seek(start)
    head = file.read(EVLR_HEADER)
    user, number, length = struct.unpack_from("<16sHQ", head, 2)
    if start + EVLR_HEADER + length > size:
        return None
    data = file.read(length) if length <= _LARGEST_KEPT else None
    key = (_text(user), number)
    return Evlr(key, _text(head[28:60]), start, EVLR_HEADER + length, data)


def _check_points(layout: LasLayout) -> None:
    """Refuse what no points can be read of, or what would ask native code for the impossible."""
    path = layout.path
    if layout.point_format >= len(RECORD_LENGTHS):
        raise BareEarthError(
            f"{path} has point format {layout.point_format}; 0 to 10 can be read. Convert it first."
        )
    is_sound = all(_SMALLEST_SCALE <= each <= _LARGEST_SCALE for each in layout.scale)
    is_sound &= all(abs(each) <= _LARGEST_OFFSET for each in layout.offset)
    if layout.extra_bytes < 0 or not is_sound:
        raise BareEarthError(f"The header of {path} is damaged. Copy or download it again.")
    if layout.count == 0:
        raise BareEarthError(f"{path} holds no points. Give a file that has some.")
    if layout.is_compressed:
        _check_compressed(layout)
    elif layout.points_end > layout.size:
        raise damaged(path)


def _check_compressed(layout: LasLayout) -> None:
    """Check what tells a damaged LAZ file before any of it is decompressed.

    The first eight bytes of the points say where the chunk table lies, behind the points; writers
    that could not go back leave -1 there, and say it in the last eight bytes of the file.
    """
    if layout.laszip is None:
        raise BareEarthError(
            f"{layout.path} has compressed points but no word on how. Copy or download it again."
        )
    compression = Compression.of(layout.laszip)
    if compression is None or compression.record_length != layout.record_length:
        raise damaged(layout.path)
    if not compression.is_known:
        raise BareEarthError(
            f"{layout.path} is compressed in a way that cannot be read here (LASzip compressor"
            f" {compression.kind}). Write it anew with LASzip."
        )
    with open_source(layout.path) as file:
        file.seek(layout.points_start)
        place = file.read(8)
        if place == b"\xff" * 8:
            file.seek(-8, 2)
            place = file.read(8)
        table = struct.unpack("<q", place)[0] if len(place) == 8 else 0
        if not layout.points_start + 8 <= table <= layout.size - 8:
            raise damaged(layout.path)
        file.seek(table)
        _, chunks = struct.unpack("<II", file.read(8))
    if not compression.chunk_count_fits(chunks, layout.count, table - layout.points_start - 8):
        raise damaged(layout.path)


def _text(field: bytes) -> str:
    return field.split(b"\0")[0].decode("utf-8", "replace").strip()
