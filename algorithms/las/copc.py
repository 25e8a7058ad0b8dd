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
from pathlib import Path
from typing import BinaryIO, Iterator

import numpy as np

from ..core.progress import SILENT, Progress
from . import header as fields
from .copc_format import (
    NEW_FORMATS,
    Statistics,
    kept_evlrs,
    modernise,
    new_header,
    new_vlrs,
    tell_of_format,
)
from .copc_octree import Octree, build_octree, extent, integers, starts_of
from .edits import EditedFile
from .lasfile import COPC_HIERARCHY, COPC_INFO, RECORD_LENGTHS, LasFile, Vlr, new_vlr
from .records import LazRecordWriter, column, copy_range
from .sources import open_source

# Points compressed between two looks at the progress.
_BATCH = 1_000_000

# A row of the hierarchy: depth, x, y and z of a node, then where its points begin, how many bytes
# they take and how many they are; -1 points where the rest of the branch stands on another page.
HIERARCHY_ENTRY = np.dtype([("key", "<i4", 4), ("start", "<u8"), ("size", "<i4"), ("count", "<i4")])


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
    point_format = NEW_FORMATS[layout.point_format]
    tell_of_format(layout, point_format, progress)
    records = _read(rewriting, point_format, progress.part(0.0, 0.3))
    octree = build_octree(records, layout.scale, layout.offset, progress.part(0.3, 0.4))
    vlrs, evlrs = new_vlrs(layout, point_format, progress), kept_evlrs(layout)
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
        header = new_header(layout, point_format, records.shape, statistics)
        fields.POINTS_START.put(header, start)
        fields.VLR_COUNT.put(header, len(vlrs))
        # One record more behind the points, for the hierarchy.
        fields.EVLR_START.put(header, end)
        fields.EVLR_COUNT.put(header, len(evlrs) + 1)
        file.seek(0)
        file.write(header)
        file.write(b"".join(vlr.raw for vlr in vlrs))


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
            modernise(old, new, layout.point_format)
        new[:, length:] = old[:, RECORD_LENGTHS[layout.point_format] :]
        new[:, 16] = classes
        start += len(old)
        progress(done)
    return records


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
    return iter(np.split(counts, starts_of(numbers)[1:]))


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


def _statistics(layout: LasFile, records: np.ndarray) -> Statistics:
    coordinates = [integers(records, axis) for axis in range(3)]
    returns = np.bincount(records[:, 14] & 0x0F, minlength=16)[1:16]
    times = column(records, 22, "<f8")
    # Damaged times must not make the whole range useless.
    smallest = float(times.min(where=np.isfinite(times), initial=np.inf))
    largest = float(times.max(where=np.isfinite(times), initial=-np.inf))
    known = (smallest, largest) if smallest <= largest else (0.0, 0.0)
    return Statistics(*extent(coordinates, layout.scale, layout.offset), returns, known)
