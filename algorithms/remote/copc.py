"""The part of a COPC file that an area and a resolution need, as a new file.

Nodes whose points are all in the area are copied as they are. Only nodes at its border are
compressed anew. All nodes are decompressed and checked first.
"""

from __future__ import annotations

import math
import struct
from dataclasses import replace
from pathlib import Path
from typing import BinaryIO, Iterator, cast

import numpy as np

from ..core.errors import BareEarthError
from ..core.points import Box
from ..core.progress import SILENT, Progress
from ..core.words import tool
from ..crs.measurable import length_scale
from ..crs.system import Crs
from ..las import header as fields
from ..las.chunk_file import ChunkFile, compressed
from ..las.copc import HIERARCHY_ENTRY, write_hierarchy
from ..las.copc_format import Statistics
from ..las.copc_nodes import find_nodes, read_compressed, read_hierarchy
from ..las.crs_records import read_crs
from ..las.header_edits import with_count, with_statistics
from ..las.lasfile import (
    COPC_EXTENTS,
    COPC_HIERARCHY,
    COPC_INFO,
    EVLR_HEADER,
    LASZIP,
    VLR_HEADER,
    Evlr,
    Vlr,
)
from ..las.laszip import Compression
from ..las.opening import read_layout
from ..las.records import named
from ..las.sources import FileState, damaged
from ..survey.area import Area
from ..survey.shapes import Outside, Place
from ..survey.window import are_inside
from .files import RangeFile
from .parts import Range

SUFFIX = ".copc.laz"
# Position of the offset of the first page, which the GPS times follow, in the info record.
_ROOT = 40
# Most bytes of the first page, which is requested before its size is checked, and of all pages.
_LARGEST = 1 << 20
_LARGEST_PAGES = 1 << 26
# Most bytes of the points of a node, and bytes by which a compressed node may exceed twice those of
# its points.
_LARGEST_NODE = 1 << 28
_LEAST = 1 << 12
_PIECE = 1 << 23  # bytes that are copied at a time
# Metres in a degree of latitude.
_DEGREE = 111_000.0
EVERYWHERE = (-math.inf, -math.inf, math.inf, math.inf)


class CopcPart:
    """The part of a COPC file that an area and a resolution need: nodes, and requests for them."""

    is_exact, is_whole, missing_count = True, False, 0

    def __init__(
        self,
        file: RangeFile,
        area: Area | None = None,
        resolution: float | None = None,
        progress: Progress = SILENT,
    ) -> None:
        self.file, self.name, self._bytes = file, file.name, cast(BinaryIO, file)
        file.twice(lambda: self._read(area, resolution, progress))

    def _read(self, area: Area | None, resolution: float | None, progress: Progress) -> None:
        """Read the header and the pages of the octree that are needed."""
        file, self._paged = self.file, 0
        file.fetch(file.plan(_first_pieces(self._bytes, file.size)), progress.quiet())
        file.seek(0)
        path = Path(file.name)
        self.layout = read_layout(path, self._bytes, FileState(file.size, 0, 0, 0))
        compression = Compression.of(self.layout.laszip or b"")
        if not self.layout.is_copc or compression is None or compression.chunk_size:
            raise BareEarthError(
                f"{file.name} is not COPC, so that no part of it can be found. Give it to the"
                f" tool that is to use it, such as {tool('classify')}, which reads all of it."
            )
        self.crs, self.box = read_crs(self.layout), self.layout.box
        self.area = area_of(area, Place(file.name, self.crs, self.box), progress)
        self._hierarchy = read_hierarchy(self.layout)
        # The extent in the header may be wrong, so only the cube of the octree is used.
        self.nodes = find_nodes(
            self._hierarchy,
            EVERYWHERE if self.area is None else self.area.bounds,
            levels_of(self._hierarchy.spacing, resolution, self.crs, self.box),
            self._bytes,
            lambda pages: self._get_pages(pages, progress.quiet()),
        )
        sizes = self.nodes["count"].astype(np.int64) * self.layout.record_length
        if (sizes > _LARGEST_NODE).any() or (self.nodes["size"] > 2 * sizes + _LEAST).any():
            raise damaged(self.layout.path)
        self._plan = file.plan(self._pieces()) if len(self.nodes) else file.plan([])
        self.size, self.request_count = self._plan.size, len(self._plan.requests)
        self.point_count = int(self.nodes["count"].sum(dtype=np.int64))

    def _get_pages(self, pages: list[Range], progress: Progress) -> None:
        self._paged += sum(stop - start for start, stop in pages)
        if self._paged > _LARGEST_PAGES:
            raise BareEarthError(
                f"The octree of {self.name} is damaged: its pages would have {self._paged:,} bytes."
            )
        self.file.fetch(self.file.plan(pages), progress)

    def fetch(self, progress: Progress) -> None:
        """Get what was planned."""
        self.file.fetch(self._plan, progress)

    def _pieces(self) -> Iterator[Range]:
        for evlr in self._kept_evlrs:
            yield evlr.start, evlr.start + evlr.length
        for start, size in zip(self.nodes["start"].tolist(), self.nodes["size"].tolist()):
            yield start, start + size

    @property
    def _kept_evlrs(self) -> list[Evlr]:
        dropped = COPC_HIERARCHY, COPC_EXTENTS
        return [evlr for evlr in self.layout.evlrs if evlr.key not in dropped]

    def write(self, target: Path, progress: Progress = SILENT) -> int:
        """Write the points as LAZ, or as COPC if the name says so, after they have been fetched;
        return their number, 0 if none lies in the area.
        """
        return self.file.twice(lambda: self._write(target, progress))

    def _write(self, target: Path, progress: Progress) -> int:
        is_copc = target.name.lower().endswith(SUFFIX)
        layout, statistics = self.layout, Statistics(self.layout)
        # The extents record states values of points that may be left out.
        dropped = (COPC_EXTENTS,) if is_copc else (COPC_EXTENTS, COPC_INFO)
        vlrs = [vlr for vlr in layout.vlrs if vlr.key not in dropped]
        with open(target, "w+b") as file:
            file.write(layout.prefix(tuple(vlrs), compressed=True))
            entries = self._write_chunks(file, statistics, progress)
            count = int(entries["count"].sum(dtype=np.int64))
            if not count:
                return 0
            end, kept = file.tell(), self._kept_evlrs
            if is_copc:
                entries = _with_branches(entries)
                write_hierarchy(file, entries)
                place = next(i for i, vlr in enumerate(vlrs) if vlr.key == COPC_INFO)
                root = end + EVLR_HEADER, entries.nbytes, *statistics.gps_time
                vlrs[place] = _with_root(vlrs[place], *root)
            for evlr in kept:
                for start in range(evlr.start, evlr.start + evlr.length, _PIECE):
                    self._bytes.seek(start)
                    file.write(self._bytes.read(min(_PIECE, evlr.start + evlr.length - start)))
            layout = with_statistics(
                with_count(layout, count),
                statistics.lowest.tolist(),
                statistics.highest.tolist(),
                statistics.returns.tolist(),
            )
            prefix = layout.prefix(tuple(vlrs), compressed=True)
            evlr_count = len(kept) + is_copc
            fields.EVLR_START.put(prefix, end if evlr_count else 0)
            fields.EVLR_COUNT.put(prefix, evlr_count)
            file.seek(0)
            file.write(prefix)
        return count

    def _write_chunks(
        self, file: BinaryIO, statistics: Statistics, progress: Progress
    ) -> np.ndarray:
        """Write the nodes, without points outside of the area; return their new entries."""
        layout, done = self.layout, 0
        laszip = next(vlr for vlr in layout.vlrs if vlr.key == LASZIP)
        chunks, written = ChunkFile(file, laszip.data), []
        for nodes, data, records in read_compressed(self._hierarchy, self.nodes, self._bytes):
            self.file.checked()
            inside = self._inside(records)
            statistics.add(records if inside.all() else records[inside])
            stops, ends = (np.cumsum(nodes[name], dtype=np.int64) for name in ("count", "size"))
            counts = np.add.reduceat(inside, stops - nodes["count"], dtype=np.int64)
            are_cut = (counts > 0) & (counts < nodes["count"])
            parts = [
                records[stop - count : stop][inside[stop - count : stop]]
                for stop, count in zip(stops[are_cut].tolist(), nodes["count"][are_cut].tolist())
            ]
            anew = iter(compressed(laszip, parts) if parts else ())
            for node, count, end, is_cut in zip(
                nodes.copy(), counts.tolist(), ends.tolist(), are_cut
            ):
                if count:
                    whole = memoryview(data)[end - int(node["size"]) : end]
                    place = chunks.add(next(anew) if is_cut else whole, count)
                    node["start"], node["size"], node["count"] = *place, count
                    written.append(node)
            done += len(records)
            progress(done / self.point_count)
        chunks.finish()
        return np.array(written, dtype=HIERARCHY_ENTRY)

    def _inside(self, records: np.ndarray) -> np.ndarray:
        """Return which points lie in the area."""
        if self.area is None:
            return np.ones(len(records), dtype=bool)
        points = named(self.layout, records)
        return are_inside(self.layout, self.area, points["X"], points["Y"])


def area_of(area: Area | None, place: Place, progress: Progress = SILENT) -> Area | None:
    """Return an area in the CRS of the points, even if no point of the cloud is in it."""
    try:
        return None if area is None else area.located(place, progress)
    except Outside:
        return None if area is None else area.located(place._replace(box=None))


def levels_of(spacing: float, resolution: float | None, crs: Crs, box: Box) -> int:
    """Return how many levels of an octree are needed for points `resolution` metres apart; each has
    half the spacing of the one above.
    """
    if not resolution or not spacing > 0:
        return 64
    unit = _DEGREE if crs.is_geographic else crs.horizontal_unit
    units = resolution / unit * length_scale(crs, box)
    return max(1, math.ceil(math.log2(spacing / units)) + 1)


def _first_pieces(file: BinaryIO, size: int) -> list[Range]:
    """Return what will be read first behind the points, as far as the header says: the table of the
    chunks, the records, and the first page of the hierarchy.
    """
    # Only to ask for all of it at once; what it says is checked later.
    file.seek(0)
    head = file.read(min(1 << 15, size))
    if len(head) < fields.HEADER_SIZES[4] + VLR_HEADER + 160 or head[:4] != b"LASF":
        return []
    points, evlrs = fields.POINTS_START.get(head), fields.EVLR_START.get(head)
    root, length = struct.unpack_from("<2Q", head, fields.HEADER_SIZES[4] + VLR_HEADER + _ROOT)
    file.seek(points)
    table = struct.unpack("<q", file.read(8))[0] if points + 8 <= size else -1
    pieces = [(table, table + 8), (root, root + min(length, _LARGEST)), (evlrs, evlrs + (1 << 12))]
    pieces = [(start, min(stop, size)) for start, stop in pieces]
    return [(start, stop) for start, stop in pieces if 0 < start < stop]


def _with_root(info: Vlr, start: int, size: int, first: float, last: float) -> Vlr:
    """Return the info record with the place of the hierarchy and the range of GPS times."""
    raw = bytearray(info.raw)
    struct.pack_into("<2Q2d", raw, VLR_HEADER + _ROOT, start, size, first, last)
    return replace(info, raw=bytes(raw))


def _with_branches(entries: np.ndarray) -> np.ndarray:
    """Return the entries of nodes and, without points, of all nodes above them that have none."""
    known = {tuple(key) for key in entries["key"].tolist()}
    above: set[tuple[int, ...]] = set()
    for depth, *place in known:
        while depth > 0:
            depth, place = depth - 1, [number >> 1 for number in place]
            above.add((depth, *place))
    empty = np.zeros(len(above - known), dtype=HIERARCHY_ENTRY)
    for entry, key in zip(empty, sorted(above - known)):
        entry["key"] = key
    return np.concatenate([empty, entries])
