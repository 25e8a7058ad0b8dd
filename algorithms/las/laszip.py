"""How points are compressed, as the LASzip record and the chunk table of a file say.

The decompressor is native code and asks for memory as these numbers tell it to. Where they lie, it
ends the whole process, QGIS included. So they are compared with the length of the file before.

References
----------
Isenburg, M. (2013): LASzip: lossless compression of lidar data. Photogrammetric Engineering &
Remote Sensing 79 (2). The record is described in the LASzip specification, "LASzip VLR".
"""

from __future__ import annotations

import struct
from typing import NamedTuple, Sequence

POINT_14, _EXTRA_BYTES_14, _WAVE_PACKET_13 = 10, 14, 9
# Which of the layers of a point have its class and its GPS time.
CLASSES, GPS_TIMES = 2, 8
# Layers of a point, its colours, those with near infrared, and its wave packet.
LAYERS = {POINT_14: 9, 11: 1, 12: 2, 13: 1}
# Bytes of each part of a point but of its extra bytes, and the parts of each point format.
_SIZES = {6: 20, 7: 8, 8: 6, 9: 29, 10: 30, 11: 6, 12: 8, 13: 29}
_PARTS = (
    (6,), (6, 7), (6, 8), (6, 7, 8), (6, 7, 9), (6, 7, 8, 9),
    (10,), (10, 11), (10, 12), (10, 13), (10, 12, 13),
)  # fmt: skip
_EXTRA_BYTES = 0
# Kinds of compression: points one by one in chunks, and columns of points in chunks.
_CHUNKED, _LAYERED = 2, 3
_HEAD, _ITEM = struct.Struct("<HHBBHIIqqH"), struct.Struct("<HHH")
_CHUNK_SIZE = 12
_VARIABLE = 0xFFFFFFFF
# Ten million points that are all the same take one byte for 630 of them.
_MOST_POINTS_A_BYTE = 4096
# A chunk is decompressed as a whole. Writers put some 50,000 points into one.
_LARGEST_CHUNK = 1 << 30


class Compression(NamedTuple):
    """What the LASzip record says.

    Attributes
    ----------
    kind : int
        2 for points one by one (formats 0 to 5), 3 for layers (6 to 10).
    chunk_size : int or None
        Points of a chunk; None where each chunk has its own number.
    items : tuple of tuple of int
        Type, bytes and version of each part of a point.
    """

    kind: int
    chunk_size: int | None
    items: tuple[tuple[int, int, int], ...]

    @classmethod
    def of(cls, record: bytes) -> Compression | None:
        """Return what a record says; None if it is cut off, or says what cannot be."""
        if len(record) < _HEAD.size:
            return None
        kind, *_, chunk_size, _, _, count = _HEAD.unpack_from(record)
        if len(record) < _HEAD.size + count * _ITEM.size or chunk_size == 0 or count == 0:
            return None
        items = [_ITEM.unpack_from(record, _HEAD.size + _ITEM.size * each) for each in range(count)]
        return cls(kind, None if chunk_size == _VARIABLE else chunk_size, tuple(items))

    @property
    def is_known(self) -> bool:
        """Whether it is one of the two kinds in chunks."""
        return self.kind == _CHUNKED or self.layers > 0

    @property
    def layers(self) -> int:
        """How many layers a chunk has; 0 if it has none, or that is not known."""
        if self.kind != _LAYERED or self.items[0][0] != POINT_14:
            return 0
        # Each extra byte is a layer of its own.
        layers = [
            size if kind == _EXTRA_BYTES_14 else LAYERS.get(kind) for kind, size, _ in self.items
        ]
        known = [each for each in layers if each is not None]
        return sum(known) if len(known) == len(layers) else 0

    @property
    def record_length(self) -> int:
        """Bytes of a point."""
        return sum(size for _, size, _ in self.items)

    def is_of(self, point_format: int) -> bool:
        """Return whether these are the parts of points of a format.

        The decompressor takes the length of a part from its type, and not from what is said here.
        """
        parts = self.items
        if parts[-1][0] in (_EXTRA_BYTES, _EXTRA_BYTES_14):
            parts = parts[:-1]
        return tuple(kind for kind, _, _ in parts) == _PARTS[point_format] and all(
            size == _SIZES[kind] for kind, size, _ in parts
        )

    def chunk_count_fits(self, chunks: int, count: int, size: int) -> bool:
        """Return whether so many chunks can hold so many points in so many bytes.

        Each chunk begins with a point that is not compressed.
        """
        most = 1 + size // self.record_length
        capacity = chunks * self.chunk_size if self.chunk_size else size * _MOST_POINTS_A_BYTE
        return chunks <= most and count <= min(capacity, size * _MOST_POINTS_A_BYTE)

    def table_fits(self, table: Sequence[tuple[int, int]], count: int, size: int) -> bool:
        """Return whether a chunk table, of points and bytes, is that of so many points and bytes.

        The last chunk may have fewer points than the table says where all have the same.
        """
        points = 0
        for chunk_points, chunk_bytes in table:
            if self.chunk_size:
                chunk_points = min(chunk_points, max(count - points, 0))
            points += chunk_points
            size -= chunk_bytes
            too_many = chunk_points > chunk_bytes * _MOST_POINTS_A_BYTE
            if size < 0 or too_many or chunk_points * self.record_length > _LARGEST_CHUNK:
                return False
        return points >= count


class ChunkHead(NamedTuple):
    """What a chunk of layers begins with: a point, how many there are, the length of each layer.

    Attributes
    ----------
    record_length : int
        Bytes of a point.
    layers : int
        How many layers there are.
    """

    record_length: int
    layers: int

    @property
    def size(self) -> int:
        """Bytes before the first layer."""
        return self.record_length + 4 + 4 * self.layers

    def numbers(self, data: bytes | memoryview, start: int = 0) -> tuple[int, ...]:
        """Return the number of points, and the lengths of the layers, of the chunk at `start`."""
        return struct.unpack_from(f"<{1 + self.layers}I", data, start + self.record_length)

    def fits(self, data: bytes | memoryview, size: int, start: int = 0) -> bool:
        """Return whether the layers of the chunk at `start` are no longer than the chunk."""
        if min(size, len(data) - start) < self.size:
            return False
        return self.size + sum(self.numbers(data, start)[1:]) <= size

    def layer(self, number: int, data: bytes | memoryview, start: int = 0) -> slice:
        """Return where a layer stands of the chunk at `start`."""
        _, *lengths = self.numbers(data, start)
        place = start + self.size + sum(lengths[:number])
        return slice(place, place + lengths[number])


def with_chunk_size(record: bytes, points: int) -> bytes:
    """Return a LASzip record that states another number of points for each chunk."""
    return record[:_CHUNK_SIZE] + struct.pack("<I", points) + record[_CHUNK_SIZE + 4 :]


def with_wave_packets_of_1(record: bytes) -> bytes:
    """Return a LASzip record whose wave packets have version 1, the only one that LASzip knows.

    lazrs calls the same bytes version 2, which LASzip 3.5 refuses to read.
    """
    changed = bytearray(record)
    for start in range(_HEAD.size, len(record) - _ITEM.size + 1, _ITEM.size):
        kind, size, version = _ITEM.unpack_from(record, start)
        if kind == _WAVE_PACKET_13 and version == 2:
            _ITEM.pack_into(changed, start, kind, size, 1)
    return bytes(changed)
