"""Writing COPC: LAZ whose points are sorted into an octree, so that a viewer reads what it shows.

lazrs compresses the nodes, and the few records that make a LAZ file a COPC file are written here.
copclib is not used: on a full disk it ends the whole process, QGIS included (`std::terminate` from
a destructor, version 2.6.3), and it keeps no records that it does not know.

References
----------
COPC specification 1.0, https://copc.io
"""

from __future__ import annotations

import struct
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO, Iterator, NamedTuple

import numpy as np

from ..core.progress import SILENT, Progress
from ..crs.system import compound_wkt
from . import header as fields
from .crs_records import GEOKEY_RECORDS, WKT_RECORD, read_crs, wkt_text
from .edits import EditedFile
from .lasfile import (
    COPC_EXTENTS,
    COPC_HIERARCHY,
    COPC_INFO,
    LARGEST_VLR,
    LASZIP,
    RECORD_LENGTHS,
    WAVEFORM_PACKETS,
    Evlr,
    LasFile,
    Vlr,
    new_vlr,
)
from .records import LazRecordWriter, column, copy_range, laszip_vlr
from .sources import open_source

# A node takes one point for each cell of a grid of so many cells along each side, ...
_GRID_BITS = 7
# ... or all of its points, where they are no more than these.
_LEAF_POINTS = 100_000
# So few points are not worth a node: they stay with the node above.
_SMALL_NODE = 500
# Cells along a side of the whole cube, the finest that are told apart; three times so many bits
# have to fit into 64.
_CUBE_BITS = 21
_DEEPEST = _CUBE_BITS - _GRID_BITS
# Points compressed between two looks at the progress.
_BATCH = 1_000_000

# A row of the hierarchy: depth, x, y and z of a node, then where its points begin, how many bytes
# they take and how many they are; -1 points where the rest of the branch stands on another page.
HIERARCHY_ENTRY = np.dtype([("key", "<i4", 4), ("start", "<u8"), ("size", "<i4"), ("count", "<i4")])
_GPS_TIME_TYPE, _SYNTHETIC_RETURNS, _WKT = 0x01, 0x08, 0x10
_WAVEFORM_DESCRIPTORS = range(100, 355)

# Where a record has its GPS time, its colours and its near infrared, by point format.
_GPS_TIMES = {1: 20, 3: 20, 4: 20, 5: 20}
_COLOURS = {2: 20, 3: 28, 5: 28}
_WITH_WAVEFORMS = (4, 5, 9, 10)
_NEW_FORMATS = (6, 6, 7, 7, 6, 7, 6, 7, 8, 6, 8)
# Degrees to the unit of scan angles since LAS 1.4.
_ANGLE_UNIT = 0.006


@dataclass(frozen=True)
class Octree:
    """A cube around the points, and the node of each.

    Attributes
    ----------
    corner : numpy.ndarray of float64, shape (3,)
        The smallest x, y and z of the cube.
    side : float
        Its edge.
    keys : numpy.ndarray of int32, shape (nodes, 4)
        Depth, x, y and z of each node; a node never comes before the one above it.
    node : numpy.ndarray of unsigned integers, shape (points,)
        Row of `keys` to which each point belongs.
    """

    corner: np.ndarray
    side: float
    keys: np.ndarray
    node: np.ndarray

    @property
    def spacing(self) -> float:
        """Distance between the points of the topmost node."""
        return self.side / (1 << _GRID_BITS)


class _Statistics(NamedTuple):
    """What header and info record say of the points."""

    minimum: np.ndarray
    maximum: np.ndarray
    returns: np.ndarray
    gps_time: tuple[float, float]


def write_copc(rewriting: EditedFile, target: Path, progress: Progress = SILENT) -> None:
    """Write a file as COPC, with other values of its points.

    All points are in memory at once, as their bytes. The order of the points changes; scale,
    offset, integers, extra bytes and the records stay, but for what is to change.

    Parameters
    ----------
    rewriting : EditedFile
        The input, and what changes in it.
    target : Path
        The file to make.
    progress : Progress
        Told what COPC cannot hold.

    Raises
    ------
    BareEarthError
        If the input is damaged.
    OSError
        If the output cannot be written.
    Cancelled
        If the user asked to stop; a half written file is left to the caller.
    """
    layout = rewriting.target
    point_format = _NEW_FORMATS[layout.point_format]
    _tell_of_format(layout, point_format, progress)
    records = _read(rewriting, point_format, progress.part(0.0, 0.3))
    octree = build_octree(records, layout.scale, layout.offset, progress.part(0.3, 0.4))
    vlrs, evlrs = _vlrs(layout, point_format, progress), _evlrs(layout)
    with open(target, "w+b") as file:
        start = fields.HEADER_SIZES[4] + sum(len(vlr.raw) for vlr in vlrs)
        file.write(bytes(start))
        entries = _write_nodes(file, vlrs[1], records, octree, progress.part(0.4, 1.0))
        end = file.seek(0, 2)
        _write_hierarchy(file, entries)
        with open_source(layout.path) as source:
            for evlr in evlrs:
                copy_range(source, file, evlr.start, evlr.start + evlr.length)
        statistics = _statistics(layout, records)
        vlrs[0] = _info(octree, statistics.gps_time, end, len(entries) * 32)
        header = _header(layout, point_format, records.shape, statistics)
        fields.POINTS_START.put(header, start)
        fields.VLR_COUNT.put(header, len(vlrs))
        # One record more behind the points, for the hierarchy.
        fields.EVLR_START.put(header, end)
        fields.EVLR_COUNT.put(header, len(evlrs) + 1)
        file.seek(0)
        file.write(header)
        file.write(b"".join(vlr.raw for vlr in vlrs))


def build_octree(
    records: np.ndarray,
    scale: tuple[float, float, float],
    offset: tuple[float, float, float],
    progress: Progress = SILENT,
) -> Octree:
    """Sort points into the nodes of an octree.

    Each node takes, of the points that the nodes above it left, the first in file order of each
    cell of its grid, and leaves the rest to its eight children.

    Parameters
    ----------
    records : numpy.ndarray of uint8, shape (n, record length)
        The points.
    scale, offset : tuple of float
        What makes coordinates of their integers.
    progress : Progress
        Receives progress.
    """
    coordinates = [_integers(records, axis) for axis in range(3)]
    minimum, maximum = _extent(coordinates, scale, offset)
    side = max(float((maximum - minimum).max()), *scale)
    # Some readers take the smallest coordinates in the header for the corner of the cube, whatever
    # the info record says: here they are.
    corner = minimum
    codes = np.zeros(len(records), dtype=np.uint64)
    for axis, integers in enumerate(coordinates):
        cells = integers * scale[axis]
        cells += offset[axis] - corner[axis]
        cells *= (1 << _CUBE_BITS) / side
        np.clip(cells, 0, (1 << _CUBE_BITS) - 1, out=cells)
        codes |= _spread(cells.astype(np.uint64)) << np.uint64(axis)
        progress(0.1 * (axis + 1))
    # Sorted by these codes, the points of any cell of any depth lie side by side.
    order = np.argsort(codes, kind="stable")
    keys, node = _sort_into_nodes(codes[order], order, progress.part(0.6, 1.0))
    return Octree(corner, side, keys, node)


def _sort_into_nodes(
    codes: np.ndarray, order: np.ndarray, progress: Progress
) -> tuple[np.ndarray, np.ndarray]:
    """Return the keys of the nodes, and the node of each point in file order.

    Parameters
    ----------
    codes : numpy.ndarray of uint64
        Codes of the points, ascending.
    order : numpy.ndarray of intp
        Place in the file of each of them.
    progress : Progress
        Receives progress.
    """
    node = np.zeros(len(codes), dtype=np.int64)
    keys: list[np.ndarray] = []
    count = 0
    for depth in range(_DEEPEST + 1):
        inside = codes >> np.uint64(3 * (_CUBE_BITS - depth))
        starts = _starts(inside)
        sizes = np.diff(starts, append=len(codes))
        number = np.repeat(np.arange(len(starts)), sizes)
        stays = np.repeat(sizes <= _LEAF_POINTS, sizes)
        if depth == _DEEPEST:
            stays[:] = True
        if not stays.all():
            # The first of each cell, in the order of the file.
            cells = _starts(codes >> np.uint64(3 * (_DEEPEST - depth)))
            first = np.minimum.reduceat(order, cells)
            stays |= order == np.repeat(first, np.diff(cells, append=len(codes)))
            stays[~stays] = _is_small_child(codes[~stays], depth)
        node[order[stays]] = count + number[stays]
        keys.append(_keys(depth, inside[starts]))
        count += len(starts)
        codes, order = codes[~stays], order[~stays]
        progress(1 - len(codes) / len(node))
        if len(codes) == 0:
            break
    return np.concatenate(keys), node.astype(np.min_scalar_type(count))


def _is_small_child(codes: np.ndarray, depth: int) -> np.ndarray:
    """Return which of the points that are left would make but a small node one deeper."""
    starts = _starts(codes >> np.uint64(3 * (_CUBE_BITS - depth - 1)))
    sizes = np.diff(starts, append=len(codes))
    return np.repeat(sizes < _SMALL_NODE, sizes)


def _starts(ascending: np.ndarray) -> np.ndarray:
    """Return where each run of equal values begins."""
    return np.flatnonzero(np.concatenate(([True], ascending[1:] != ascending[:-1])))


def _keys(depth: int, codes: np.ndarray) -> np.ndarray:
    axes = [_gather(codes >> np.uint64(axis)) for axis in range(3)]
    return np.column_stack([np.full(len(codes), depth), *axes]).astype(np.int32)


# The steps that put two zero bits between the 21 bits of a number; known as Morton or z-order.
_SPREAD = (
    (32, 0x001F00000000FFFF),
    (16, 0x001F0000FF0000FF),
    (8, 0x100F00F00F00F00F),
    (4, 0x10C30C30C30C30C3),
    (2, 0x1249249249249249),
)


def _spread(numbers: np.ndarray) -> np.ndarray:
    for shift, mask in _SPREAD:
        numbers = (numbers | (numbers << np.uint64(shift))) & np.uint64(mask)
    return numbers


def _gather(numbers: np.ndarray) -> np.ndarray:
    """Undo `_spread`."""
    numbers = numbers & np.uint64(_SPREAD[-1][1])
    masks = [mask for _, mask in _SPREAD[-2::-1]] + [(1 << _CUBE_BITS) - 1]
    for (shift, _), mask in zip(_SPREAD[::-1], masks):
        numbers = (numbers | (numbers >> np.uint64(shift))) & np.uint64(mask)
    return numbers


def _integers(records: np.ndarray, axis: int) -> np.ndarray:
    return column(records, 4 * axis, "<i4")


def _extent(
    coordinates: list[np.ndarray],
    scale: tuple[float, float, float],
    offset: tuple[float, float, float],
) -> tuple[np.ndarray, np.ndarray]:
    """Return the smallest and the largest coordinates from their integers."""
    factors, shifts = np.array(scale), np.array(offset)
    return tuple(
        np.array([pick(each) for each in coordinates]) * factors + shifts
        for pick in (np.min, np.max)
    )


def _read(rewriting: EditedFile, point_format: int, progress: Progress) -> np.ndarray:
    """Return the bytes of all points as they are to be, in a format that COPC takes."""
    layout = rewriting.target
    length = RECORD_LENGTHS[point_format]
    records = np.zeros((layout.count, length + layout.extra_bytes), dtype=np.uint8)
    start = 0
    for old, classes, done in rewriting.points():
        new = records[start : start + len(old)]
        if layout.point_format >= 6:
            # 9 and 10 are 6 and 8 with waveforms behind.
            new[:, :length] = old[:, :length]
        else:
            _modernise(old, new, layout.point_format)
        new[:, length:] = old[:, RECORD_LENGTHS[layout.point_format] :]
        new[:, 16] = classes
        start += len(old)
        progress(done)
    return records


def _modernise(old: np.ndarray, new: np.ndarray, point_format: int) -> None:
    """Put points of the formats 0 to 5 into records of the formats 6 and 7, but for the class."""
    new[:, :14] = old[:, :14]  # x, y, z, intensity
    bits = old[:, 14]
    new[:, 14] = (bits & 0x07) | ((bits & 0x38) << 1)  # return number, number of returns
    # Synthetic, key point, withheld; scan direction and edge of flight line.
    new[:, 15] = (old[:, 15] >> 5) | (bits & 0xC0)
    new[:, 17] = old[:, 17]  # user data
    angles = old[:, 16].view(np.int8) / _ANGLE_UNIT
    column(new, 18, "<i2")[:] = np.rint(angles)
    new[:, 20:22] = old[:, 18:20]  # point source
    if point_format in _GPS_TIMES:
        start = _GPS_TIMES[point_format]
        new[:, 22:30] = old[:, start : start + 8]
    if point_format in _COLOURS:
        start = _COLOURS[point_format]
        new[:, 30:36] = old[:, start : start + 6]


def _write_nodes(
    file: BinaryIO, laszip: Vlr, records: np.ndarray, octree: Octree, progress: Progress
) -> np.ndarray:
    """Compress each node as a chunk of its own, and return the entries of the hierarchy."""
    start = file.tell()
    # Inside a node in file order, which compresses well.
    order = np.argsort(octree.node, kind="stable")
    counts = np.bincount(octree.node, minlength=len(octree.keys))
    writer = LazRecordWriter(file, laszip)
    done = 0
    for batch in _batches(counts):
        chunks = []
        for count in batch:
            chunks.append(records[order[done : done + count]])
            done += count
        writer.write_chunks(chunks)
        progress(done / len(records))
    writer.finish()
    file.seek(start)
    sizes = np.array(writer.chunk_sizes(file), dtype=np.int64)
    entries = np.zeros(len(counts), dtype=HIERARCHY_ENTRY)
    entries["key"] = octree.keys
    entries["start"] = start + 8 + np.cumsum(sizes) - sizes
    entries["size"], entries["count"] = sizes, counts
    return entries


def _batches(counts: np.ndarray) -> Iterator[np.ndarray]:
    """Yield runs of nodes that have about `_BATCH` points together."""
    numbers = (np.cumsum(counts) - counts) // _BATCH
    return iter(np.split(counts, _starts(numbers)[1:]))


def _write_hierarchy(file: BinaryIO, entries: np.ndarray) -> None:
    """Append the hierarchy: one page, which holds 32 bytes for each node."""
    user, number = COPC_HIERARCHY
    file.write(
        struct.pack(
            "<H16sHQ32s", 0, user.encode(), number, entries.nbytes, b"EPT Hierarchy from bare_earth"
        )
    )
    file.write(entries.tobytes())


def _info(octree: Octree, gps_time: tuple[float, float], evlr_start: int, size: int) -> Vlr:
    half = octree.side / 2
    centre = octree.corner + half
    data = struct.pack(
        "<5d2Q2d88x", *centre, half, octree.spacing, evlr_start + 60, size, *gps_time
    )
    return new_vlr(COPC_INFO, data, "COPC info VLR")


def _header(
    layout: LasFile, point_format: int, shape: tuple[int, int], statistics: _Statistics
) -> bytearray:
    """Return a header of LAS 1.4 that says what that of the input said, but not what lies where."""
    header = bytearray(fields.HEADER_SIZES[4])
    until = fields.EXTENT.start
    header[:until] = layout.header[:until]
    encoding = layout.global_encoding if layout.minor_version >= 2 else 0
    encoding = (encoding & (_GPS_TIME_TYPE | _SYNTHETIC_RETURNS)) | _WKT
    fields.GLOBAL_ENCODING.put(header, encoding)
    fields.VERSION.put(header, 1, 4)
    fields.HEADER_SIZE.put(header, len(header))
    # The old fields for numbers of points, of 32 bits, stay empty since the formats from 6 on.
    fields.LEGACY_COUNT.put(header, 0)
    fields.LEGACY_RETURNS.put(header, *[0] * 5)
    fields.POINT_FORMAT.put(header, point_format | 0x80)
    fields.RECORD_LENGTH.put(header, shape[1])
    corners = np.column_stack((statistics.maximum, statistics.minimum)).ravel()
    fields.EXTENT.put(header, *corners)
    fields.COUNT.put(header, shape[0])
    fields.RETURNS.put(header, *statistics.returns.tolist())
    return header


def _statistics(layout: LasFile, records: np.ndarray) -> _Statistics:
    coordinates = [_integers(records, axis) for axis in range(3)]
    returns = np.bincount(records[:, 14] & 0x0F, minlength=16)[1:16]
    times = column(records, 22, "<f8")
    # Damaged times must not make the whole range useless.
    smallest = float(times.min(where=np.isfinite(times), initial=np.inf))
    largest = float(times.max(where=np.isfinite(times), initial=-np.inf))
    known = (smallest, largest) if smallest <= largest else (0.0, 0.0)
    return _Statistics(*_extent(coordinates, layout.scale, layout.offset), returns, known)


def _vlrs(layout: LasFile, point_format: int, progress: Progress) -> list[Vlr]:
    """Return the records before the points; the first is the info record, to be filled in."""
    kept = [vlr for vlr in layout.vlrs if _is_kept(vlr)]
    wkt = _wkt(layout, progress)
    if wkt is not None:
        kept = [vlr for vlr in kept if vlr.key not in (*GEOKEY_RECORDS, WKT_RECORD)]
        kept.insert(0, wkt)
    laszip = laszip_vlr(point_format, layout.extra_bytes, variable_chunks=True)
    return [new_vlr(COPC_INFO, bytes(160), ""), laszip, *kept]


def _evlrs(layout: LasFile) -> list[Evlr]:
    return [evlr for evlr in layout.evlrs if _is_kept(evlr)]


def _is_kept(record: Vlr | Evlr) -> bool:
    """Return whether a record still holds; those of COPC and LAZ are made anew."""
    user, number = record.key
    if user == "LASF_Spec" and number in _WAVEFORM_DESCRIPTORS:
        return False
    return record.key not in (LASZIP, COPC_INFO, COPC_HIERARCHY, COPC_EXTENTS, WAVEFORM_PACKETS)


def _wkt(layout: LasFile, progress: Progress) -> Vlr | None:
    """Return the record of the CRS as well-known text, the only way that COPC has for it."""
    crs = read_crs(layout)
    text = compound_wkt(crs)
    if text is None:
        if layout.vlr(*GEOKEY_RECORDS) is not None:
            progress.warning(
                "The CRS of the input is not known as well-known text, as COPC wants it: it stays"
                " in GeoTIFF keys, which not every program will read."
            )
        return None
    if len(text.encode()) >= LARGEST_VLR:
        progress.warning(
            "The well-known text of the CRS is too long for a record of COPC: its records stay as"
            " they are, which not every program will read."
        )
        return None
    for vlr in layout.vlrs:
        if vlr.key == WKT_RECORD and wkt_text(vlr.data) == text:
            return vlr
    if layout.vlr(*GEOKEY_RECORDS) is not None:
        progress.info("The CRS, given as GeoTIFF keys, becomes well-known text, as COPC wants it.")
    return new_vlr(WKT_RECORD, text.encode() + b"\0", "OGC WKT Coordinate System")


def _tell_of_format(layout: LasFile, point_format: int, progress: Progress) -> None:
    if layout.point_format in _WITH_WAVEFORMS:
        progress.warning(
            f"COPC cannot hold the waveforms of point format {layout.point_format}: they are left"
            f" out, and the points become point format {point_format}."
        )
    elif point_format != layout.point_format:
        progress.info(
            f"Point format {layout.point_format} becomes {point_format}, as COPC wants it."
        )
    if len(layout.header) > fields.HEADER_SIZES[layout.minor_version]:
        progress.warning("COPC cannot hold the bytes that were added to the header: left out.")
