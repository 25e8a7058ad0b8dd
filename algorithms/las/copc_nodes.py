"""Reads the nodes of a COPC octree that a window touches.

The COPC reader of laspy is not used: it decompresses the whole window at once, does not notice a
truncated file, and never ends if a page of the hierarchy refers to itself.

References
----------
COPC specification 1.0, https://copc.io
"""

from __future__ import annotations

import contextlib
import itertools
import struct
from dataclasses import dataclass
from typing import TYPE_CHECKING, BinaryIO, Callable, Iterator

import numpy as np

from ..core.errors import BareEarthError
from ..core.points import Box
from .copc import HIERARCHY_ENTRY
from .gps_times import are_impossible
from .lasfile import COPC_INFO, LasFile
from .laszip import Compression
from .records import named, needed, selection_of
from .sources import damage_told, damaged, open_source

if TYPE_CHECKING:
    import laspy
    import lazrs

# Points decompressed at once.
_BATCH = 1_000_000
# Steps of the scale by which a point may lie outside its cube: writers round coordinates after
# they have sorted the points into nodes.
_ROUNDING_STEPS = 2
_DEEPEST = 30


class OctreeError(BareEarthError):
    """The octree is damaged, but the points can perhaps still be read as LAZ."""


@dataclass(frozen=True)
class Hierarchy:
    """The cube of an octree, and the position of its first page."""

    layout: LasFile
    corner: tuple[float, float]  # smallest x and y of the cube
    side: float
    spacing: float  # distance between the points of the topmost node
    root: tuple[int, int]  # start and size of the first page

    @property
    def tolerance(self) -> float:
        """How far a point may lie outside the cube of its node."""
        return _ROUNDING_STEPS * max(self.layout.scale[:2])

    def squares(self, keys: np.ndarray) -> np.ndarray:
        """Return smallest x and y, largest x and y of nodes, with a tolerance, float64 (4, n),
        given depth, x, y and z, int32 (n, 4).
        """
        sides = self.side / np.exp2(keys[:, 0])
        west = self.corner[0] + keys[:, 1] * sides
        south = self.corner[1] + keys[:, 2] * sides
        more = self.tolerance
        return np.array([west - more, south - more, west + sides + more, south + sides + more])


def read_hierarchy(layout: LasFile) -> Hierarchy:
    """Read the cube and the position of the octree of a COPC file; `OctreeError` if they are
    missing or do not agree with the header.
    """
    info = layout.vlr(COPC_INFO)
    data = (info.data if info else None) or b""
    if len(data) < 56:
        raise _octree_error(layout, "its description is cut off")
    x, y, z, half, spacing, start, size = struct.unpack_from("<5d2Q", data)
    if not (np.isfinite([x, y, z, half]).all() and half > 0):
        raise _octree_error(layout, "its cube has no valid centre or size")
    hierarchy = Hierarchy(layout, (x - half, y - half), 2 * half, spacing, (start, size))
    west, south, east, north = hierarchy.squares(np.zeros((1, 4), dtype=np.int32))[:, 0]
    minimum, maximum = layout.minimum, layout.maximum
    if not (west <= minimum[0] and south <= minimum[1]) or not (
        maximum[0] <= east and maximum[1] <= north
    ):
        raise _octree_error(layout, "its cube does not hold the extent that the header states")
    return hierarchy


def find_nodes(
    hierarchy: Hierarchy,
    box: Box,
    levels: int = _DEEPEST + 1,
    file: BinaryIO | None = None,
    get_ready: Callable[[list[tuple[int, int]]], object] = lambda pages: None,
) -> np.ndarray:
    """Return the nodes of the uppermost levels whose cubes touch a box in the CRS, HIERARCHY_ENTRY
    (n,) in file order; raise `OctreeError` if the hierarchy is damaged.
    """
    # Only pages whose branches touch the box are read, from a file that may be open; before that,
    # `get_ready` is called with the start and the end of the pages.
    layout = hierarchy.layout
    selected, total, is_whole = [], 0, True

    def wanted(keys: np.ndarray) -> np.ndarray:
        return _touching(hierarchy, keys, box) & (keys[:, 0] < levels)

    for _, entries, touch in _pages(hierarchy, wanted, file, get_ready):
        # The points of all nodes on these pages count, not only those of the wanted nodes.
        total += int(np.maximum(entries["count"], 0).sum(dtype=np.int64))
        is_whole &= not (entries["count"][~touch] == -1).any()
        selected.append(entries[touch & (entries["count"] > 0)])
    if total > layout.count or (is_whole and total != layout.count):
        raise _uncounted(layout)
    nodes = np.concatenate(selected)
    nodes = nodes[np.argsort(nodes["start"], kind="stable")]
    if (nodes["start"][1:] < nodes["start"][:-1] + nodes["size"][:-1].astype(np.uint64)).any():
        raise _octree_error(layout, "its nodes overlap in the file")
    return nodes


def read_pages(hierarchy: Hierarchy) -> dict[int, np.ndarray]:
    """Return the entries of each page of the hierarchy, by its position; `OctreeError` if it is
    damaged.
    """
    every = _pages(hierarchy, lambda keys: np.ones(len(keys), dtype=bool))
    pages = {start: entries for start, entries, _ in every}
    total = sum(int(np.maximum(page["count"], 0).sum(dtype=np.int64)) for page in pages.values())
    if total != hierarchy.layout.count:
        raise _uncounted(hierarchy.layout)
    return pages


def read_nodes(
    hierarchy: Hierarchy, nodes: np.ndarray, times: bool = False
) -> Iterator[laspy.PackedPointRecord]:
    """Yield the points of nodes, about a million at once, with the layers that a `PointCloud`
    needs; GPS times are undefined unless wanted.
    """
    # If points lie outside the cubes of their nodes (an OctreeError), others may be missing.
    layout = hierarchy.layout
    selection = selection_of(needed(layout, times))
    with open_source(layout.path) as file:
        for batch, compressed in _batches(layout, nodes, file):
            records = _decompress(hierarchy, compressed, batch, selection, times)
            yield named(layout, records)


def read_compressed(
    hierarchy: Hierarchy, nodes: np.ndarray, file: BinaryIO
) -> Iterator[tuple[np.ndarray, bytearray, np.ndarray]]:
    """Yield batches of nodes of an open file, with their compressed bytes one after the other, and
    their whole records; raise the errors of `read_nodes`.
    """
    import lazrs

    every = lazrs.DecompressionSelection(lazrs.SELECTIVE_DECOMPRESS_ALL)
    for batch, compressed in _batches(hierarchy.layout, nodes, file):
        yield batch, compressed, _decompress(hierarchy, compressed, batch, every)


def _pages(
    hierarchy: Hierarchy,
    wanted: Callable[[np.ndarray], np.ndarray],
    opened: BinaryIO | None = None,
    get_ready: Callable[[list[tuple[int, int]]], object] = lambda pages: None,
) -> Iterator[tuple[int, np.ndarray, np.ndarray]]:
    """Yield the positions of pages, their entries, and which of these are wanted; pages of unwanted
    branches are not read.
    """
    layout, pages, seen = hierarchy.layout, [hierarchy.root], set()
    with open_source(layout.path) if opened is None else contextlib.nullcontext(opened) as file:
        while pages:
            for start, size in pages:
                if (start, size) in seen:
                    raise _octree_error(layout, "one of its pages names itself")
                seen.add((start, size))
                if start + size > layout.size:
                    raise _octree_error(layout, "one of its pages lies outside of the file")
            get_ready([(start, start + size) for start, size in pages])
            below = []
            for start, size in pages:
                entries = _read_page(layout, file, start, size)
                are_wanted = wanted(entries["key"])
                branches = entries[are_wanted & (entries["count"] == -1)]
                below += [(int(branch["start"]), int(branch["size"])) for branch in branches]
                yield start, entries, are_wanted
            pages = below


def _read_page(layout: LasFile, file: BinaryIO, start: int, size: int) -> np.ndarray:
    """Return the checked entries of a page of the hierarchy."""
    length = HIERARCHY_ENTRY.itemsize
    if size < length or size % length:
        raise _octree_error(layout, "one of its pages lies outside of the file")
    file.seek(start)
    data = file.read(size)
    if len(data) != size:
        raise damaged(layout.path)
    entries = np.frombuffer(data, dtype=HIERARCHY_ENTRY)
    depth, places = entries["key"][:, 0], entries["key"][:, 1:]
    makes_sense = (depth >= 0) & (depth <= _DEEPEST) & (entries["count"] >= -1)
    makes_sense &= (places >= 0).all(axis=1)
    makes_sense &= (places < np.exp2(np.clip(depth, 0, _DEEPEST))[:, None]).all(axis=1)
    filled = entries["count"] != 0
    end = entries["start"] + np.maximum(entries["size"], 0).astype(np.uint64)
    in_file = (entries["size"] > 0) & (entries["start"] < layout.size) & (end <= layout.size)
    makes_sense &= in_file | ~filled
    if not makes_sense.all():
        raise _octree_error(layout, "one of its pages holds impossible values")
    return entries


def _touching(hierarchy: Hierarchy, keys: np.ndarray, box: Box) -> np.ndarray:
    west, south, east, north = hierarchy.squares(keys)
    return (west <= box[2]) & (east >= box[0]) & (south <= box[3]) & (north >= box[1])


def _batches(
    layout: LasFile, nodes: np.ndarray, file: BinaryIO
) -> Iterator[tuple[np.ndarray, bytearray]]:
    """Yield nodes in batches of about `_BATCH` points, with their compressed bytes."""
    counts = nodes["count"].astype(np.int64)
    numbers = (np.cumsum(counts) - counts) // _BATCH
    for batch in np.split(nodes, np.flatnonzero(np.diff(numbers)) + 1):
        compressed = bytearray()
        for node in batch:
            file.seek(int(node["start"]))
            compressed += file.read(int(node["size"]))
        if len(compressed) != int(batch["size"].sum(dtype=np.int64)):
            raise damaged(layout.path)
        if len(batch):
            yield batch, compressed


def _decompress(
    hierarchy: Hierarchy,
    compressed: bytearray,
    nodes: np.ndarray,
    selection: lazrs.DecompressionSelection,
    has_times: bool = True,  # whether GPS times are decompressed
) -> np.ndarray:
    """Return the records of nodes, uint8 (n, record length), after checks of each chunk."""
    import lazrs

    layout = hierarchy.layout
    counts, sizes, head = nodes["count"].tolist(), nodes["size"].tolist(), layout.chunk_head
    compression = Compression.of(layout.laszip or b"")
    table = list(zip(counts, sizes))
    if compression is None or not compression.table_fits(table, sum(counts), sum(sizes)):
        raise damaged(layout.path)
    for count, size, start in zip(counts, sizes, itertools.accumulate(sizes, initial=0)):
        is_sound = head.fits(compressed, size, start)
        if not is_sound or head.numbers(compressed, start)[0] != count:
            raise damaged(layout.path)
        if has_times and are_impossible(layout, compressed, start):
            raise damaged(layout.path)
    records = np.zeros((sum(counts), layout.record_length), dtype=np.uint8)
    with damage_told(layout.path):
        lazrs.decompress_points_with_chunk_table(
            compressed, layout.laszip, records.reshape(-1), table, selection
        )
    _check_places(hierarchy, nodes, named(layout, records))
    return records


def _check_places(hierarchy: Hierarchy, nodes: np.ndarray, chunk: laspy.PackedPointRecord) -> None:
    """Check that the points of nodes lie in their cubes."""
    layout = hierarchy.layout
    starts = np.cumsum(nodes["count"], dtype=np.int64) - nodes["count"]
    squares = hierarchy.squares(nodes["key"])
    for axis, name in enumerate("XY"):
        integers = np.asarray(chunk[name])
        lowest = np.minimum.reduceat(integers, starts) * layout.scale[axis] + layout.offset[axis]
        highest = np.maximum.reduceat(integers, starts) * layout.scale[axis] + layout.offset[axis]
        if (lowest < squares[axis]).any() or (highest > squares[axis + 2]).any():
            raise _octree_error(layout, "points lie outside of their nodes")


def _uncounted(layout: LasFile) -> OctreeError:
    return _octree_error(layout, "its numbers of points do not add up to that of the file")


def _octree_error(layout: LasFile, damage: str) -> OctreeError:
    return OctreeError(f"The octree of {layout.path} is damaged: {damage}.")
