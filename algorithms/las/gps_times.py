"""Refuses damaged GPS times that would crash the decompressor.

When times jump between series, the decompressor of lazrs calls itself once for each jump. Sound
files have one jump at a time. From a block of bytes 0xFF, which broken disks can give, it reads
thousands of jumps until its stack overflows. This cannot be caught, and would end QGIS as well. No
sound file has such a block, because compressed bytes are nearly random.

References
----------
lazrs 0.8.2, laz-rs 0.12.2, `src/las/gps.rs`, `decompress_with`, which follows Isenburg's
`LASreadItemCompressed_GPSTIME11_v2` and `LASreadItemCompressed_POINT14_v3`.
"""

from __future__ import annotations

from typing import BinaryIO, Iterator

from .lasfile import LasFile
from .laszip import GPS_TIMES
from .sources import damaged, open_source

# With the stack size of `algorithms.las`, 32 of these bytes do no harm, and 64 do.
_RUN = b"\xff" * 32
_BLOCK = 1 << 24


def check_gps_times(layout: LasFile) -> None:
    """Refuse a compressed file whose GPS times would crash the decompressor."""
    if not layout.laszip or not layout.has_gps_times:
        return
    with open_source(layout.path) as file:
        pieces = _layers(layout, file) if layout.layers else _blocks(layout, file)
        if any(_RUN in piece for piece in pieces):
            raise damaged(layout.path)


def are_impossible(layout: LasFile, data: bytes | bytearray, start: int) -> bool:
    """Return whether the GPS times of a chunk of layers would crash the decompressor."""
    layer = layout.chunk_head.layer(GPS_TIMES, memoryview(data), start)
    return data.find(_RUN, layer.start, layer.stop) >= 0


def _layers(layout: LasFile, file: BinaryIO) -> Iterator[bytes]:
    head, place = layout.chunk_head, layout.points_start + 8
    for _, size in layout.chunk_table:
        if size:
            file.seek(place)
            layer = head.layer(GPS_TIMES, file.read(head.size))
            file.seek(place + layer.start)
            yield file.read(layer.stop - layer.start)
        place += size


def _blocks(layout: LasFile, file: BinaryIO) -> Iterator[bytes]:
    """Yield the bytes of points that are compressed one by one."""
    file.seek(layout.points_start + 8)
    remaining, before = sum(size for _, size in layout.chunk_table), b""
    while remaining > 0 and (block := file.read(min(_BLOCK, remaining))):
        yield before + block
        remaining, before = remaining - len(block), block[1 - len(_RUN) :]
