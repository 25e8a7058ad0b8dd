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
from .lasbytes import LASZIP, LasLayout
from .records import LazRecordWriter, laszip_vlr, read_records
from .sources import damage_told, damaged, open_source

# What the record of the compression says: its kind, and of what a point is put together.
_LAYERED_CHUNKS, _POINT, _EXTRA_BYTES = 3, 10, 14
_KIND, _ITEM_COUNT, _ITEMS = "<H", 32, 34
# Layers of a point, its colours, those with near infrared, and its wave packet.
_LAYERS = {_POINT: 9, 11: 1, 12: 2, 13: 1}
_FORMAT, _RETURNS, _CHANNEL, _CLASS, _CLASS_LAYER = 6, 14, 15, 16, 2
_CHANNEL_BITS = 0x30
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


def class_layers(layout: LasLayout) -> ClassLayers | None:
    """Return the layers of the classes of a file; None if it has none that can be replaced.

    Raises
    ------
    BareEarthError
        If it cannot be read.
    """
    record = layout.vlr(LASZIP) if layout.is_compressed else None
    layers = 0 if record is None else _layers_of(record.data)
    if not layers:
        return None
    chunks = _chunks(layout, layers)
    return None if chunks is None else ClassLayers(layout, chunks, layers)


def _layers_of(record: bytes) -> int:
    """Return how many layers the compressed points have; 0 if it is not known."""
    if len(record) < _ITEMS or struct.unpack_from(_KIND, record)[0] != _LAYERED_CHUNKS:
        return 0
    (count,) = struct.unpack_from("<H", record, _ITEM_COUNT)
    if len(record) < _ITEMS + 6 * count:
        return 0
    items = [struct.unpack_from("<HH", record, _ITEMS + 6 * number) for number in range(count)]
    kinds = [kind for kind, _ in items]
    if kinds[:1] != [_POINT] or not set(kinds) <= {*_LAYERS, _EXTRA_BYTES}:
        return 0
    return sum(size if kind == _EXTRA_BYTES else _LAYERS[kind] for kind, size in items)


def _chunks(layout: LasLayout, layers: int) -> list[Chunk] | None:
    """Return the chunks of a file; None if they are not made as they should be."""
    import lazrs

    chunks, start = [], 0
    with open_source(layout.path) as file:
        file.seek(layout.points_start)
        with damage_told(layout.path):
            sizes = [
                size
                for _, size in lazrs.read_chunk_table(file, lazrs.LazVlr(layout.vlr(LASZIP).data))
            ]
        place = layout.points_start + 8
        for size in sizes:
            file.seek(place)
            head = file.read(layout.record_length + 4 + 4 * layers)
            if len(head) != layout.record_length + 4 + 4 * layers:
                return None
            count, *lengths = struct.unpack_from(f"<{1 + layers}I", head, layout.record_length)
            if not count or len(head) + sum(lengths) != size:
                return None
            chunks.append(Chunk(start, start + count, place, size))
            start, place = start + count, place + size
    return chunks if start == layout.count else None


class ClassLayers:
    """The layers of the classes in a file, which can be replaced.

    Parameters
    ----------
    layout : LasLayout
        The file.
    chunks : list of Chunk
        All of its chunks, in order.
    layers : int
        How many layers each has.

    Attributes
    ----------
    chunks : dict of int to tuple of int
        Bytes and points of each chunk, by where it begins in the file.
    moved : dict of int to tuple of int
        Where each that was written begins in the output, and its bytes there, by the same.
    """

    def __init__(self, layout: LasLayout, chunks: list[Chunk], layers: int) -> None:
        self._layout, self._chunks, self._layers = layout, chunks, layers
        self.chunks = {each.place: (each.size, each.end - each.start) for each in chunks}
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
                    returns,
                    classes[first : group[-1].end],
                    [slice(each.start - first, each.end - first) for each in group],
                )
                for chunk, layer in zip(group, new):
                    start = file.tell()
                    self._write_chunk(source, file, chunk, int(classes[chunk.start]), layer)
                    self.moved[chunk.place] = start, file.tell() - start
                yield group[-1].end / layout.count
        end = file.tell()
        sizes = [(each.end - each.start, self.moved[each.place][1]) for each in self._chunks]
        lazrs.write_chunk_table(file, sizes, lazrs.LazVlr(layout.vlr(LASZIP).data))
        file.seek(table)
        file.write(struct.pack("<q", end))
        file.seek(0, io.SEEK_END)

    def _groups(self) -> list[list[Chunk]]:
        """Return the chunks whose layers are made together."""
        groups: list[list[Chunk]] = []
        for chunk in self._chunks:
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
        places = self._layout.record_length + 4
        sizes = list(struct.unpack_from(f"<{self._layers}I", data, places))
        start = places + 4 * self._layers + sum(sizes[:_CLASS_LAYER])
        rest = start + sizes[_CLASS_LAYER]
        sizes[_CLASS_LAYER] = len(layer)
        head = bytearray(data[:places])
        head[_CLASS] = first_class
        parts = (
            head,
            struct.pack(f"<{self._layers}I", *sizes),
            memoryview(data)[places + 4 * self._layers : start],
            layer,
            memoryview(data)[rest:],
        )
        for part in parts:
            file.write(part)


def _returns(
    layout: LasLayout, groups: Iterable[Sequence[Chunk]], cloud: PointCloud | None
) -> Iterator[np.ndarray]:
    """Yield, for each group of chunks, what of the points decides how classes are coded.

    Yields
    ------
    numpy.ndarray of uint8, shape (k, 2)
        Return number and number of returns in one byte, and the scanner channel where it stands in
        a byte with others.
    """
    pieces = [slice(group[0].start, group[-1].end) for group in groups]
    if cloud is None or cloud.count != layout.count or cloud.scanner_channel is None:
        most = max(piece.stop - piece.start for piece in pieces)
        for records in read_records(layout, most, columns=(), pieces=pieces):
            yield records[:, [_RETURNS, _CHANNEL]]
        return
    for piece in pieces:
        number, of = cloud.return_number[piece], cloud.number_of_returns[piece]
        yield np.column_stack((number | of << 4, cloud.scanner_channel[piece] << 4))


def _new_layers(
    returns: np.ndarray, classes: np.ndarray, chunks: Sequence[slice]
) -> Iterator[bytes]:
    """Yield the layer of the classes for each chunk of some points."""
    points = np.zeros((len(classes), 30), dtype=np.uint8)
    number, of = returns[:, 0] & 0x0F, returns[:, 0] >> 4
    points[:, _RETURNS] = np.where((number == 1) & (of <= 1), _ONLY, _FIRST_OF_TWO)
    points[:, _CHANNEL] = returns[:, 1] & _CHANNEL_BITS
    points[:, _CLASS] = classes
    file = io.BytesIO()
    writer = LazRecordWriter(file, laszip_vlr(_FORMAT, 0, variable_chunks=True))
    writer.write_chunks([points[chunk] for chunk in chunks])
    writer.finish()
    file.seek(0)
    sizes = writer.chunk_sizes(file)
    data, start = file.getbuffer(), 8
    for size in sizes:
        lengths = struct.unpack_from(f"<{_LAYERS[_POINT]}I", data, start + points.shape[1] + 4)
        place = start + points.shape[1] + 4 + 4 * len(lengths) + sum(lengths[:_CLASS_LAYER])
        yield bytes(data[place : place + lengths[_CLASS_LAYER]])
        start += size
