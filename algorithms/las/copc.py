"""Writes COPC: LAZ with the points sorted into an octree, so that viewers read only what they show.

lazrs compresses the nodes. The few records that make a LAZ file a COPC file are written here.
copclib is not used: on a full disk it ends the whole process, QGIS included (`std::terminate` from
a destructor, version 2.6.3), and it drops records that it does not know.

References
----------
COPC specification 1.0, https://copc.io
"""

from __future__ import annotations

import struct
from pathlib import Path
from typing import BinaryIO, Iterable, Iterator

import numpy as np

from ..core.progress import SILENT, Progress
from ..core.threads import parts_of
from . import header as fields
from .copc_format import (
    NEW_FORMATS,
    Statistics,
    convert,
    kept_evlrs,
    new_header,
    new_vlrs,
    record_length,
    report_format,
    stated_cube,
)
from .copc_octree import (
    TOP,
    Branch,
    BranchPoints,
    Cube,
    SortedPoints,
    keys_of,
    most_in_memory,
    nodes_of,
)
from .copc_points import Room, WaitingPoints
from .edits import EditedFile
from .lasfile import COPC_HIERARCHY, COPC_INFO, Vlr, new_vlr
from .records import LazRecordWriter, copy_range
from .sources import open_source

# Most points compressed at a time.
_BATCH = 1_000_000

# An entry of the hierarchy: depth, x, y and z of a node, then the position, size in bytes and
# number of its points. If the number is -1, the rest of the branch is on another page.
HIERARCHY_ENTRY = np.dtype([("key", "<i4", 4), ("start", "<u8"), ("size", "<i4"), ("count", "<i4")])


def write_copc(
    rewriting: EditedFile,
    target: Path,
    progress: Progress = SILENT,
    memory: int | None = None,
) -> None:
    """Write a file with its changes as COPC, with about `memory` bytes, by default with all points
    in memory; after an error or a cancel, the caller removes the incomplete file.
    """
    # The order of the points changes. Scale, offset, integers, extra bytes and records stay, except
    # for the changes. Points that do not fit into memory wait in a temporary file beside the
    # target; the output does not depend on that.
    layout = rewriting.target
    point_format = NEW_FORMATS[layout.point_format]
    report_format(layout, point_format, progress)
    vlrs, evlrs = new_vlrs(layout, point_format, progress), kept_evlrs(layout)
    statistics, length = Statistics(layout), record_length(layout)
    most = layout.count if memory is None else most_in_memory(memory, length)
    with Room(target.parent, most, progress) as room, open(target, "w+b") as file:
        points = _sorted(rewriting, statistics, room)
        start = fields.HEADER_SIZES[4] + sum(len(vlr.raw) for vlr in vlrs)
        file.write(bytes(start))
        entries = _write_nodes(file, vlrs[1], points, room)
        end = file.seek(0, 2)
        write_hierarchy(file, entries)
        with open_source(layout.path) as source:
            for evlr in evlrs:
                copy_range(source, file, evlr.start, evlr.start + evlr.length)
        vlrs[0] = _info(statistics.cube, statistics.gps_time, end, len(entries) * 32)
        header = new_header(layout, point_format, statistics)
        fields.POINTS_START.put(header, start)
        fields.VLR_COUNT.put(header, len(vlrs))
        # One more record behind the points, for the hierarchy.
        fields.EVLR_START.put(header, end)
        fields.EVLR_COUNT.put(header, len(evlrs) + 1)
        file.seek(0)
        file.write(header)
        file.write(b"".join(vlr.raw for vlr in vlrs))


def _sorted(rewriting: EditedFile, statistics: Statistics, room: Room) -> BranchPoints:
    """Return the changed points in a format of COPC, sorted for the octree."""
    layout, start = rewriting.target, 0
    if layout.count <= room.most:
        records = np.zeros((layout.count, record_length(layout)), dtype=np.uint8)
        for old, classes, done in rewriting.points():
            convert(layout, old, classes, records[start : start + len(old)])
            statistics.add(old)
            start += len(old)
            room.progress.move(0.3 * done)
        room.progress.move(0.3, 0.4)
        return SortedPoints.of(TOP, records, statistics.cube, progress=room.progress)
    # If the extent in the header is right, the points are read only once.
    room.cube = stated_cube(layout)
    points = WaitingPoints(TOP, _parts(rewriting, room, (0.0, 0.3), statistics), room)
    if statistics.cube != room.cube:
        room.clear(statistics.cube)
        points = WaitingPoints(TOP, _parts(rewriting, room, (0.3, 0.4)), room)
    return points


def _parts(
    rewriting: EditedFile,
    room: Room,
    share: tuple[float, float],
    statistics: Statistics | None = None,
) -> Iterator[np.ndarray]:
    """Yield the changed points part by part, and count them if wanted."""
    layout, (start, end) = rewriting.target, share
    for old, classes, done in rewriting.points():
        if statistics is not None:
            statistics.add(old)
        for piece in parts_of(len(old), room.most_at_once):
            new = np.zeros((piece.stop - piece.start, record_length(layout)), dtype=np.uint8)
            convert(layout, old[piece], classes[piece], new)
            yield new
        room.progress.move(start + (end - start) * done)


def _write_nodes(file: BinaryIO, laszip: Vlr, points: BranchPoints, room: Room) -> np.ndarray:
    """Compress each node as a chunk of its own, and return the entries of the hierarchy."""
    start, total = file.tell(), points.counts.sum()
    writer = LazRecordWriter(file, laszip)
    nodes, counts = [], []
    for batch in _batches(nodes_of(points), min(_BATCH, room.most)):
        writer.write_chunks([records for _, records in batch])
        nodes += [node for node, _ in batch]
        counts += [len(records) for _, records in batch]
        room.progress.move(0.4 + 0.6 * sum(counts) / total)
    writer.finish()
    file.seek(start)
    sizes = np.array(writer.chunk_sizes(file), dtype=np.int64)
    entries = np.zeros(len(counts), dtype=HIERARCHY_ENTRY)
    entries["key"] = keys_of(nodes)
    entries["start"] = start + 8 + np.cumsum(sizes) - sizes
    entries["size"], entries["count"] = sizes, counts
    return entries


def _batches(
    nodes: Iterable[tuple[Branch, np.ndarray]], least: int
) -> Iterator[list[tuple[Branch, np.ndarray]]]:
    """Yield nodes in batches of about the same number of points."""
    batch, count = [], 0
    for node in nodes:
        batch.append(node)
        count += len(node[1])
        if count >= least:
            yield batch
            batch, count = [], 0
    if batch:
        yield batch


def write_hierarchy(file: BinaryIO, entries: np.ndarray) -> None:
    """Append the hierarchy: one page, which holds 32 bytes for each node."""
    user, number = COPC_HIERARCHY
    file.write(
        struct.pack(
            "<H16sHQ32s", 0, user.encode(), number, entries.nbytes, b"EPT Hierarchy from bare_earth"
        )
    )
    file.write(entries.tobytes())


def _info(cube: Cube, gps_time: tuple[float, float], evlr_start: int, size: int) -> Vlr:
    half = cube.side / 2
    centre = (value + half for value in cube.corner)
    data = struct.pack("<5d2Q2d88x", *centre, half, cube.spacing, evlr_start + 60, size, *gps_time)
    return new_vlr(COPC_INFO, data, "COPC info VLR")
