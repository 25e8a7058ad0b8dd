"""Replaces the classes in a LAZ file and copies all other bytes.

Point formats 6 to 10 are compressed in chunks and layers. A chunk holds its first point
uncompressed, the number of its points, the length of each layer, and the layers. The third layer
holds the classes. It depends only on the classes, the scanner channels, and which points are single
returns. So new points with the same values, and zeros otherwise, are compressed, and their layer of
classes replaces the old one. Nothing else is decompressed or compressed.

Source: Isenburg, "LASzip for LAS 1.4 (native extension)", specification, "Chunk layout" and
"Compression of classification layer". It says that the context is the previous point. In its
implementation it is the point itself, which makes no difference here.
"""

from __future__ import annotations

import struct
from typing import BinaryIO, Iterable, Iterator, NamedTuple, Sequence

import numpy as np

from .chunk_file import ChunkFile, compressed
from .cloud import PointCloud
from .lasfile import RECORD_LENGTHS, LasFile
from .laszip import CLASSES, LAYERS, POINT_14, ChunkHead
from .records import laszip_vlr, named, read_records
from .sources import damaged, open_source

# The fields of a point that decide how its class is coded.
_DECISIVE = ("return_number", "number_of_returns", "scanner_channel")
_FORMAT = 6  # the shortest with such layers
# Places of bytes in a record of it.
_RETURNS = 14
_CHANNEL = 15
_CLASS = 16
# Numbers of returns that are used for single returns and for all others, as small as possible.
_ONLY = 0x11
_FIRST_OF_TWO = 0x21
# Points whose layers are compressed at a time.
_POINTS_A_GROUP = 1_000_000


class Chunk(NamedTuple):
    """Points that are compressed together."""

    start: int  # index of its first point in the file
    end: int  # index after its last point
    place: int  # position of its bytes in the file
    size: int  # bytes


def class_layers(layout: LasFile) -> ClassLayers | None:
    """Return the layers of the classes of a file; None if they cannot be replaced."""
    if not layout.layers:
        return None
    head, chunks, start, place = layout.chunk_head, [], 0, layout.points_start + 8
    with open_source(layout.path) as file:
        for _, size in layout.chunk_table:
            file.seek(place)
            data = file.read(head.size)
            if len(data) != head.size:
                return None
            count, *lengths = head.numbers(data)
            if not count or head.size + sum(lengths) != size:
                return None
            chunks.append(Chunk(start, start + count, place, size))
            start, place = start + count, place + size
    return ClassLayers(layout, chunks) if start == layout.count else None


class ClassLayers:
    """The layers of classes in all chunks of a file, in order, which can be replaced."""

    def __init__(self, layout: LasFile, chunks: list[Chunk]) -> None:
        self._layout, self.chunks = layout, chunks
        self.moved: dict[int, tuple[int, int]] = {}  # position and size in the output, by `place`

    def write(
        self, file: BinaryIO, classes: np.ndarray, cloud: PointCloud | None = None
    ) -> Iterator[float]:
        """Write the points with new classes, uint8 (n,), at the position of the file after header
        and VLRs; yield the share written so far.
        """
        # The header describes the same compression. If no cloud is given, or one with only some
        # points, the returns are read again.
        layout, groups = self._layout, self._groups()
        chunks = ChunkFile(file, layout.laszip or b"")
        with open_source(layout.path) as source:
            source.seek(layout.points_start + 8)
            for group, returns in zip(groups, _returns(layout, groups, cloud)):
                first = group[0].start
                new = _new_layers(
                    *returns,
                    classes[first : group[-1].end],
                    [slice(chunk.start - first, chunk.end - first) for chunk in group],
                )
                for chunk, layer in zip(group, new):
                    data = self._changed(source, chunk, int(classes[chunk.start]), layer)
                    self.moved[chunk.place] = chunks.add(data, chunk.end - chunk.start)
                yield group[-1].end / layout.count
        chunks.finish()

    def _groups(self) -> list[list[Chunk]]:
        """Return chunks in groups whose layers are compressed together."""
        groups: list[list[Chunk]] = []
        for chunk in self.chunks:
            if not groups or chunk.end - groups[-1][0].start > _POINTS_A_GROUP:
                groups.append([])
            groups[-1].append(chunk)
        return groups

    def _changed(
        self, source: BinaryIO, chunk: Chunk, first_class: int, layer: memoryview
    ) -> bytes:
        """Return the next chunk of the source with a new layer of classes."""
        data = source.read(chunk.size)
        if len(data) != chunk.size:
            raise damaged(self._layout.path)
        head = self._layout.chunk_head
        former, start = head.layer(CLASSES, data), bytearray(data[: head.size])
        start[_CLASS] = first_class
        # The lengths of the layers stand after the number of points.
        struct.pack_into("<I", start, head.record_length + 4 + 4 * CLASSES, len(layer))
        view = memoryview(data)
        return b"".join((start, view[head.size : former.start], layer, view[former.stop :]))


def _returns(
    layout: LasFile, groups: Iterable[Sequence[Chunk]], cloud: PointCloud | None
) -> Iterator[tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """Yield for each group of chunks the values that decide how classes are coded: return number,
    number of returns and scanner channel, uint8 (k,) each.
    """
    pieces = [slice(group[0].start, group[-1].end) for group in groups]
    has_them = cloud is not None and cloud.count == layout.count and not cloud.from_zero
    if cloud is None or not has_them or cloud.scanner_channel is None:
        most = max(piece.stop - piece.start for piece in pieces)
        for records in read_records(layout, most, columns=(), pieces=pieces):
            points = named(layout, records)
            first, second, third = (np.asarray(points[name]) for name in _DECISIVE)
            yield first, second, third
        return
    for piece in pieces:
        first, second, third = (getattr(cloud, name)[piece] for name in _DECISIVE)
        yield first, second, third


def _new_layers(
    return_number: np.ndarray,
    number_of_returns: np.ndarray,
    scanner_channel: np.ndarray,
    classes: np.ndarray,
    chunks: Sequence[slice],
) -> Iterator[memoryview]:
    head = ChunkHead(RECORD_LENGTHS[_FORMAT], LAYERS[POINT_14])
    points = np.zeros((len(classes), head.record_length), dtype=np.uint8)
    is_only = (return_number == 1) & (number_of_returns <= 1)
    points[:, _RETURNS] = np.where(is_only, _ONLY, _FIRST_OF_TWO)
    points[:, _CHANNEL] = scanner_channel << 4
    points[:, _CLASS] = classes
    laszip = laszip_vlr(_FORMAT, 0, variable_chunks=True)
    for data in compressed(laszip, [points[chunk] for chunk in chunks]):
        yield data[head.layer(CLASSES, data)]
