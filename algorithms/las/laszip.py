"""The compression of points: the LASzip record and the chunk table.

The decompressor is native code and allocates memory according to these numbers. If they are wrong,
it ends the whole process, QGIS included. So they are checked against the size of the file first.

References
----------
Isenburg, M. (2013): LASzip: lossless compression of lidar data. Photogrammetric Engineering &
Remote Sensing 79 (2). The record is described in the LASzip specification, "LASzip VLR".
"""

from __future__ import annotations

import struct
from typing import NamedTuple, Sequence

# Numbers of kinds of items.
POINT_14 = 10
_EXTRA_BYTES_14 = 14
_WAVE_PACKET_13 = 9
# Indices of layers.
CLASSES = 2
GPS_TIMES = 8
# Numbers of layers: of a point, of colours, of colours with near infrared, of a wave packet.
LAYERS = {POINT_14: 9, 11: 1, 12: 2, 13: 1}
# Bytes of each part of a point, without extra bytes, and the parts of each point format.
_SIZES = {6: 20, 7: 8, 8: 6, 9: 29, 10: 30, 11: 6, 12: 8, 13: 29}
_PARTS = (
    (6,), (6, 7), (6, 8), (6, 7, 8), (6, 7, 9), (6, 7, 8, 9),
    (10,), (10, 11), (10, 12), (10, 13), (10, 12, 13),
)  # fmt: skip
_EXTRA_BYTES = 0
# Kinds of compression.
_CHUNKED = 2  # chunks of single points
_LAYERED = 3  # chunks of layers
_HEAD = struct.Struct("<HHBBHIIqqH")
_ITEM = struct.Struct("<HHH")
_CHUNK_SIZE = 12
_VARIABLE = 0xFFFFFFFF
# Of ten million equal points, 630 take one byte.
_MOST_POINTS_A_BYTE = 4096
# A chunk is decompressed as a whole. Usual chunks have 50,000 points.
_LARGEST_CHUNK = 1 << 30


class Compression(NamedTuple):
    """The contents of a LASzip record."""

    kind: int  # 2 for single points (formats 0 to 5), 3 for layers (formats 6 to 10)
    chunk_size: int | None  # points; None if chunks differ
    items: tuple[tuple[int, int, int], ...]  # type, bytes and version of each part of a point

    @classmethod
    def of(cls, record: bytes) -> Compression | None:
        """Return the contents of a record; None if it is truncated or impossible."""
        if len(record) < _HEAD.size:
            return None
        kind, *_, chunk_size, _, _, count = _HEAD.unpack_from(record)
        if len(record) < _HEAD.size + count * _ITEM.size or chunk_size == 0 or count == 0:
            return None
        items = [
            _ITEM.unpack_from(record, _HEAD.size + _ITEM.size * number) for number in range(count)
        ]
        return cls(kind, None if chunk_size == _VARIABLE else chunk_size, tuple(items))

    @property
    def is_known(self) -> bool:
        """Whether the kind of compression is known here."""
        return self.kind == _CHUNKED or self.layers > 0

    @property
    def layers(self) -> int:
        """Number of layers of a chunk; 0 if there are none, or the number is unknown."""
        if self.kind != _LAYERED or self.items[0][0] != POINT_14:
            return 0
        # Each extra byte is one layer.
        layers = [
            size if kind == _EXTRA_BYTES_14 else LAYERS.get(kind) for kind, size, _ in self.items
        ]
        known = [layer for layer in layers if layer is not None]
        return sum(known) if len(known) == len(layers) else 0

    @property
    def record_length(self) -> int:
        """Bytes of a point."""
        return sum(size for _, size, _ in self.items)

    def is_of(self, point_format: int) -> bool:
        """Return whether the parts are those of points of a format."""
        # The decompressor takes the length of a part from its type, not from the record.
        parts = self.items
        if parts[-1][0] in (_EXTRA_BYTES, _EXTRA_BYTES_14):
            parts = parts[:-1]
        return tuple(kind for kind, _, _ in parts) == _PARTS[point_format] and all(
            size == _SIZES[kind] for kind, size, _ in parts
        )

    def chunk_count_fits(self, chunks: int, count: int, size: int) -> bool:
        """Return whether chunks, which all begin with an uncompressed point, can hold `count`
        points in `size` bytes.
        """
        most = 1 + size // self.record_length
        capacity = chunks * self.chunk_size if self.chunk_size else size * _MOST_POINTS_A_BYTE
        return chunks <= most and count <= min(capacity, size * _MOST_POINTS_A_BYTE)

    def table_fits(self, table: Sequence[tuple[int, int]], count: int, size: int) -> bool:
        """Return whether the numbers of points and bytes in a chunk table are possible."""
        # If all chunks have the same size, the last one can have fewer points than the table
        # states.
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
    """The head of a chunk of layers: a point, the number of points, and the lengths of
    the layers.
    """

    record_length: int  # bytes of a point
    layers: int  # number of layers

    @property
    def size(self) -> int:
        """Bytes before the first layer."""
        return self.record_length + 4 + 4 * self.layers

    def numbers(self, data: bytes | bytearray | memoryview, start: int = 0) -> tuple[int, ...]:
        """Return the number of points and the lengths of the layers of the chunk at `start`."""
        return struct.unpack_from(f"<{1 + self.layers}I", data, start + self.record_length)

    def fits(self, data: bytes | bytearray | memoryview, size: int, start: int = 0) -> bool:
        """Return whether the layers fit into the chunk at `start`."""
        if min(size, len(data) - start) < self.size:
            return False
        return self.size + sum(self.numbers(data, start)[1:]) <= size

    def layer(self, number: int, data: bytes | memoryview, start: int = 0) -> slice:
        """Return the position of a layer of the chunk at `start`."""
        _, *lengths = self.numbers(data, start)
        place = start + self.size + sum(lengths[:number])
        return slice(place, place + lengths[number])


def with_chunk_size(record: bytes, points: int) -> bytes:
    """Return a LASzip record with another chunk size."""
    return record[:_CHUNK_SIZE] + struct.pack("<I", points) + record[_CHUNK_SIZE + 4 :]


def with_wave_packets_of_1(record: bytes) -> bytes:
    """Return a LASzip record whose wave packets have version 1."""
    # lazrs writes the same bytes as version 2, which LASzip 3.5 refuses to read.
    changed = bytearray(record)
    for start in range(_HEAD.size, len(record) - _ITEM.size + 1, _ITEM.size):
        kind, size, version = _ITEM.unpack_from(record, start)
        if kind == _WAVE_PACKET_13 and version == 2:
            _ITEM.pack_into(changed, start, kind, size, 1)
    return bytes(changed)
