"""Writes compressed points chunk by chunk, so that chunks of other files can be copied."""

from __future__ import annotations

import io
import struct
from typing import BinaryIO, Sequence

import numpy as np

from .lasfile import Vlr
from .records import LazRecordWriter


class ChunkFile:
    """Writes chunks of any size into a file, from the position of the file on."""

    def __init__(self, file: BinaryIO, laszip: bytes) -> None:
        self._file, self._laszip, self._start = file, laszip, file.tell()
        self._table: list[tuple[int, int]] = []  # points and bytes of each chunk
        file.write(struct.pack("<q", -1))

    def add(self, data: bytes | memoryview, count: int) -> tuple[int, int]:
        """Append a chunk with a number of points; return its position and size."""
        start = self._file.tell()
        self._file.write(data)
        self._table.append((count, len(data)))
        return start, len(data)

    def finish(self) -> None:
        """Write the table of the chunks behind them; the file is then at its end."""
        import lazrs

        end = self._file.tell()
        lazrs.write_chunk_table(self._file, self._table, lazrs.LazVlr(self._laszip))
        self._file.seek(self._start)
        self._file.write(struct.pack("<q", end))
        self._file.seek(0, io.SEEK_END)


def compressed(laszip: Vlr, chunks: Sequence[np.ndarray]) -> list[memoryview]:
    """Return the bytes of chunks, given their records, uint8 (n, record length) each."""
    file = io.BytesIO()
    writer = LazRecordWriter(file, laszip)
    writer.write_chunks(list(chunks))
    writer.finish()
    file.seek(0)
    compressed, data, start = [], file.getbuffer(), 8
    for size in writer.chunk_sizes(file):
        compressed.append(data[start : start + size])
        start += size
    return compressed
