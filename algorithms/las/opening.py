"""Opens LAS, LAZ and COPC files: reads and checks header and records, but no points."""

from __future__ import annotations

import struct
from pathlib import Path
from typing import BinaryIO

from ..core.errors import BareEarthError
from ..crs.stated import stated_wkt
from . import header as fields
from .lasfile import (
    EVLR_HEADER,
    FIRST_EXTENDED_FORMAT,
    RECORD_LENGTHS,
    VLR_HEADER,
    WAVEFORM_PACKETS,
    Evlr,
    LasFile,
    Vlr,
    text_of,
)
from .laszip import Compression
from .sources import FileState, damaged, open_source

_MOST_EVLRS = 1_000_000
# User ids of the records behind the points that are kept in memory.
_KEPT = ("LASF_Projection", "LASF_Spec")
# Most bytes of a record that is kept: a survey can have thousands of files.
_LARGEST_KEPT = 1 << 20
# Most bytes that a file without points may have between its records, such as those of compression.
_MOST_WITHOUT_POINTS = 256
# Units of the CRS: limits of scales and offsets with which calculations make sense.
_SMALLEST_SCALE = 1e-12
_LARGEST_SCALE = 1e6
_LARGEST_OFFSET = 1e12


class NoPoints(BareEarthError):
    """Files are valid, but hold no points; a run that writes points copies them unchanged."""

    def __init__(self, text: str, layouts: tuple[LasFile, ...] = ()) -> None:
        super().__init__(text)
        self.layouts = layouts


def open_las(path: Path | LasFile, stated: str | None = None) -> LasFile:
    """Open a file, or return an opened one, and read everything but its points; refuse a file that
    is not LAS or LAZ, or damaged, or, by `NoPoints`, empty.
    """
    # `stated` is the CRS that a user states in place of that of the file.
    if isinstance(path, LasFile):
        return path
    path = Path(path)
    with open_source(path) as file:
        return read_layout(path, file, FileState.of(file), stated)


def read_layout(path: Path, file: BinaryIO, state: FileState, stated: str | None = None) -> LasFile:
    """Read everything but the points of an open file, as `open_las`; messages name the path."""
    size = state.size
    header = _read_header(path, file, size)
    points_start, vlr_count = fields.POINTS_START.get(header), fields.VLR_COUNT.get(header)
    vlrs, padding = _split_vlrs(file.read(points_start - len(header)), vlr_count)
    evlrs, waveforms = _read_evlrs(file, size, header)
    layout = LasFile(path, size, header, vlrs, padding, evlrs, waveforms, state, stated_wkt(stated))
    _check_points(layout, file)
    return layout


def _read_header(path: Path, file: BinaryIO, size: int) -> bytes:
    start = file.read(375)
    if start[:4] != b"LASF":
        raise BareEarthError(
            f"{path} is not a LAS or LAZ file. Give a .las, .laz or .copc.laz file."
        )
    if len(start) < fields.HEADER_SIZES[0]:
        raise damaged(path)
    major, minor = fields.VERSION.get(start)
    if major != 1 or minor not in fields.HEADER_SIZES:
        raise BareEarthError(
            f"{path} is LAS {major}.{minor}; LAS 1.0 to 1.4 can be read. Convert it first."
        )
    header_size, points_start = (fields.HEADER_SIZE.get(start), fields.POINTS_START.get(start))
    if not fields.HEADER_SIZES[minor] <= header_size <= points_start or points_start > size:
        raise damaged(path)
    file.seek(0)
    return file.read(header_size)


def _split_vlrs(block: bytes, count: int) -> tuple[tuple[Vlr, ...], bytes]:
    # The list ends at a record that does not fit, or if there are fewer records than announced. The
    # points can be read in spite of this.
    vlrs: list[Vlr] = []
    start = 0
    while len(vlrs) < count and start + VLR_HEADER <= len(block):
        end = start + VLR_HEADER + struct.unpack_from("<H", block, start + 20)[0]
        if end > len(block):
            break
        vlrs.append(Vlr(block[start:end]))
        start = end
    return tuple(vlrs), block[start:]


def _read_evlrs(file: BinaryIO, size: int, header: bytes) -> tuple[tuple[Evlr, ...], int]:
    _, minor = fields.VERSION.get(header)
    evlrs: list[Evlr] = []
    waveforms = 0
    if minor >= 4:
        start, count = fields.EVLR_START.get(header), fields.EVLR_COUNT.get(header)
        while len(evlrs) < min(count, _MOST_EVLRS):
            evlr = _read_evlr(file, size, start)
            if evlr is None:
                break
            evlrs.append(evlr)
            start += evlr.length
    if minor >= 3:
        # Some writers leave a stale pointer, so the record there must be of the right kind.
        start = fields.WAVEFORM_START.get(header)
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
    key = (text_of(user), number)
    is_kept = key[0] in _KEPT and length <= _LARGEST_KEPT
    data = file.read(length) if is_kept else None
    return Evlr(key, text_of(head[28:60]), start, EVLR_HEADER + length, data)


def _check_points(layout: LasFile, file: BinaryIO) -> None:
    """Refuse files whose points cannot be read, or would crash native code."""
    path = layout.path
    if layout.point_format >= len(RECORD_LENGTHS):
        raise BareEarthError(
            f"{path} has point format {layout.point_format}; 0 to 10 can be read. Convert it first."
        )
    is_sound = all(_SMALLEST_SCALE <= value <= _LARGEST_SCALE for value in layout.scale)
    is_sound &= all(abs(value) <= _LARGEST_OFFSET for value in layout.offset)
    if layout.extra_bytes < 0 or not is_sound:
        raise BareEarthError(f"The header of {path} is damaged. Copy or download it again.")
    if layout.count == 0:
        end_of_points = min([layout.size, *(evlr.start for evlr in layout.evlrs)])
        most = _MOST_WITHOUT_POINTS + layout.record_length
        if end_of_points - layout.points_start > most:
            raise BareEarthError(
                f"{path} was not written to its end: it holds no points by its header, but bytes of"
                " some. Write it again."
            )
        raise NoPoints(f"{path} holds no points. Give a file that has some.", (layout,))
    if layout.is_compressed:
        _check_compressed(layout, file)
    elif layout.points_end > layout.size:
        raise damaged(path)


def _check_compressed(layout: LasFile, file: BinaryIO) -> None:
    """Refuse damaged LAZ files before anything is decompressed."""
    # The first eight bytes of the points are the position of the chunk table behind the points.
    # Writers that cannot seek write -1 there, and the position in the last eight bytes of the file.
    if layout.laszip is None:
        raise BareEarthError(
            f"{layout.path} has compressed points but does not say how they are compressed. Copy"
            " or download it again."
        )
    compression = Compression.of(layout.laszip)
    if compression is None or compression.record_length != layout.record_length:
        raise damaged(layout.path)
    if not compression.is_known:
        raise BareEarthError(
            f"{layout.path} is compressed in a way that cannot be read here (LASzip compressor"
            f" {compression.kind}). Write it again with LASzip."
        )
    is_layered = layout.point_format >= FIRST_EXTENDED_FORMAT
    if (compression.layers > 0) != is_layered or not compression.is_of(layout.point_format):
        raise damaged(layout.path)
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
