"""Other classes in a LAZ file all of whose other bytes stay as they are.

Point formats 6 to 10 are compressed by chunks and in layers: a chunk holds its first point as it
is, the number of its points, the length of each layer, and the layers, of which the third is that
of the classes. How that one is coded depends on nothing but classes, scanner channels, and which
points are the only return of their pulse. So points that share these, and are zero otherwise, are
compressed, and their layer takes the place of the former one: nothing else is decompressed or
compressed again.

Source: Isenburg, "LASzip for LAS 1.4 (native extension)", specification, "Chunk layout" and
"Compression of classification layer", where the context is said to be the previous point; that it
is the point itself, which its implementation has, makes no difference here.
"""

from __future__ import annotations

import io
import struct
from typing import BinaryIO, Iterable, Iterator, NamedTuple, Sequence

import numpy as np

from .cloud import PointCloud
from .lasfile import RECORD_LENGTHS, LasFile
from .laszip import CLASSES, LAYERS, POINT_14, ChunkHead
from .records import LazRecordWriter, laszip_vlr, named, read_records
from .sources import damaged, open_source

# What of a point decides how its class is coded.
_DECISIVE = ("return_number", "number_of_returns", "scanner_channel")
_FORMAT, _RETURNS, _CHANNEL, _CLASS = 6, 14, 15, 16
# Returns of a pulse that has one, and that has more: as small as can be.
_ONLY, _FIRST_OF_TWO = 0x11, 0x21
# Points whose layers are made at a time.
_POINTS_A_GROUP = 1_000_000


class Chunk(NamedTuple):
    """Points that are compressed together.

    Attributes
    ----------
    start, end : int
        Which of the points of the file they are.
    place, size : int
        Where their bytes begin in the file, and how many they are.
    """

    start: int
    end: int
    place: int
    size: int


def class_layers(layout: LasFile) -> ClassLayers | None:
    """Return the layers of the classes of a file; None if it has none that can be replaced.

    Raises
    ------
    BareEarthError
        If it cannot be read.
    """
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
    """The layers of the classes in a file, which can be replaced.

    Parameters
    ----------
    layout : LasFile
        The file.
    chunks : list of Chunk
        All of its chunks, in order.

    Attributes
    ----------
    chunks : list of Chunk
        As given.
    moved : dict of int to tuple of int
        Where each that was written begins in the output, and its bytes there, by its `place`.
    """

    def __init__(self, layout: LasFile, chunks: list[Chunk]) -> None:
        self._layout, self.chunks = layout, chunks
        self.moved: dict[int, tuple[int, int]] = {}

    def write(
        self, file: BinaryIO, classes: np.ndarray, cloud: PointCloud | None = None
    ) -> Iterator[float]:
        """Write the points with other classes, from where the file stands.

        Parameters
        ----------
        file : file object
            The output, after header and VLRs, which say the same of the compression.
        classes : numpy.ndarray of uint8, shape (n,)
            The class of each point.
        cloud : PointCloud, optional
            The points; if it is not given or holds but some of them, the returns are read again.

        Yields
        ------
        float
            Share of the points that are written.

        Raises
        ------
        BareEarthError
            If the file is damaged.
        OSError
            If nothing more can be written.
        """
        import lazrs

        table, layout = file.tell(), self._layout
        file.write(struct.pack("<q", -1))
        groups = self._groups()
        with open_source(layout.path) as source:
            source.seek(layout.points_start + 8)
            for group, returns in zip(groups, _returns(layout, groups, cloud)):
                first = group[0].start
                new = _new_layers(
                    *returns,
                    classes[first : group[-1].end],
                    [slice(each.start - first, each.end - first) for each in group],
                )
                for chunk, layer in zip(group, new):
                    start = file.tell()
                    self._write_chunk(source, file, chunk, int(classes[chunk.start]), layer)
                    self.moved[chunk.place] = start, file.tell() - start
                yield group[-1].end / layout.count
        end = file.tell()
        sizes = [(each.end - each.start, self.moved[each.place][1]) for each in self.chunks]
        lazrs.write_chunk_table(file, sizes, lazrs.LazVlr(layout.laszip))
        file.seek(table)
        file.write(struct.pack("<q", end))
        file.seek(0, io.SEEK_END)

    def _groups(self) -> list[list[Chunk]]:
        """Return the chunks whose layers are made together."""
        groups: list[list[Chunk]] = []
        for chunk in self.chunks:
            if not groups or chunk.end - groups[-1][0].start > _POINTS_A_GROUP:
                groups.append([])
            groups[-1].append(chunk)
        return groups

    def _write_chunk(
        self, source: BinaryIO, file: BinaryIO, chunk: Chunk, first_class: int, layer: bytes
    ) -> None:
        """Copy a chunk with another layer of classes."""
        data = source.read(chunk.size)
        if len(data) != chunk.size:
            raise damaged(self._layout.path)
        head = self._layout.chunk_head
        former, start = head.layer(CLASSES, data), bytearray(data[: head.size])
        start[_CLASS] = first_class
        # The lengths of the layers follow the number of points.
        struct.pack_into("<I", start, head.record_length + 4 + 4 * CLASSES, len(layer))
        data = memoryview(data)
        for part in (start, data[head.size : former.start], layer, data[former.stop :]):
            file.write(part)


def _returns(
    layout: LasFile, groups: Iterable[Sequence[Chunk]], cloud: PointCloud | None
) -> Iterator[tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """Yield, for each group of chunks, what of the points decides how classes are coded.

    Yields
    ------
    return_number, number_of_returns, scanner_channel : numpy.ndarray of uint8, shape (k,)
    """
    pieces = [slice(group[0].start, group[-1].end) for group in groups]
    if cloud is None or cloud.count != layout.count or cloud.scanner_channel is None:
        most = max(piece.stop - piece.start for piece in pieces)
        for records in read_records(layout, most, columns=(), pieces=pieces):
            points = named(layout, records)
            yield tuple(np.asarray(points[name]) for name in _DECISIVE)
        return
    columns = [getattr(cloud, name) for name in _DECISIVE]
    for piece in pieces:
        yield tuple(column[piece] for column in columns)


def _new_layers(
    return_number: np.ndarray,
    number_of_returns: np.ndarray,
    scanner_channel: np.ndarray,
    classes: np.ndarray,
    chunks: Sequence[slice],
) -> Iterator[bytes]:
    """Yield the layer of the classes for each chunk of some points."""
    head = ChunkHead(RECORD_LENGTHS[_FORMAT], LAYERS[POINT_14])
    points = np.zeros((len(classes), head.record_length), dtype=np.uint8)
    is_only = (return_number == 1) & (number_of_returns <= 1)
    points[:, _RETURNS] = np.where(is_only, _ONLY, _FIRST_OF_TWO)
    points[:, _CHANNEL] = scanner_channel << 4
    points[:, _CLASS] = classes
    file = io.BytesIO()
    writer = LazRecordWriter(file, laszip_vlr(_FORMAT, 0, variable_chunks=True))
    writer.write_chunks([points[chunk] for chunk in chunks])
    writer.finish()
    file.seek(0)
    sizes = writer.chunk_sizes(file)
    data, start = file.getbuffer(), 8
    for size in sizes:
        yield bytes(data[head.layer(CLASSES, data, start)])
        start += size
