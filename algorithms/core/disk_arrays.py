"""Arrays in files, of which parts are in memory."""

from __future__ import annotations

import contextlib
import math
import mmap
import os
import struct
import threading
import zipfile
from pathlib import Path
from typing import BinaryIO

import numpy as np

from .files import write_errors_told
from .unnamed import unnamed_file

# Bytes that are written at a time to allocate a file.
_STEP = 1 << 24
# Bytes of the header of an entry of a zip file, without its name and extra bytes.
_ZIP_HEADER = 30
# Python 3.11 and older raise a SystemError when two threads parse at once (CPython issue 106905),
# and NumPy parses the header of an array.
_one_parser = threading.Lock()


class RowsOnDisk:
    """An array in a file, shape (rows, ...), that is read by slices; a file given by its path is
    opened for each slice, and an open file is read by one thread only.
    """

    def __init__(
        self, file: BinaryIO | Path, start: int, shape: tuple[int, ...], kind: np.dtype
    ) -> None:
        self._file, self._start, self.shape, self._kind = file, start, shape, kind

    def __getitem__(self, where: slice | tuple[slice, ...]) -> np.ndarray:
        rows, *columns = where if isinstance(where, tuple) else (where,)
        (first, last, _), shape_of_row = rows.indices(self.shape[0]), self.shape[1:]
        size = math.prod(shape_of_row) * self._kind.itemsize
        source = self._file
        opened = source.open("rb") if isinstance(source, Path) else contextlib.nullcontext(source)
        with opened as file:
            file.seek(self._start + first * size)
            content = file.read((last - first) * size)
        values = np.frombuffer(content, self._kind).reshape(last - first, *shape_of_row)
        return values[(slice(None), *columns)]

    def __array__(self, *arguments: object, **options: object) -> np.ndarray:
        return self[:]


def rows_in(file: Path) -> dict[str, RowsOnDisk]:
    """Return the arrays in a file of `numpy.savez`, by their names."""
    found = {}
    with zipfile.ZipFile(file) as entries, file.open("rb") as content:
        for entry in entries.infolist():
            # The entries are not compressed. Their headers end with a name and extra bytes.
            content.seek(entry.header_offset + _ZIP_HEADER - 4)
            content.seek(sum(struct.unpack("<HH", content.read(4))), os.SEEK_CUR)
            with _one_parser:
                np.lib.format.read_magic(content)
                shape, _, kind = np.lib.format.read_array_header_1_0(content)
            name = entry.filename[: -len(".npy")]
            found[name] = RowsOnDisk(file, content.tell(), shape, kind)
    return found


class ValuesOnDisk:
    """Values of points, shape (count,), mapped into memory from a temporary file without a name in
    the folder of `target`; an error says if the disk is full.
    """

    # The file is allocated first: if the disk were full when the mapped file is written, the
    # process would end.

    def __init__(self, target: Path, kind: type, count: int) -> None:
        size = max(count, 1) * np.dtype(kind).itemsize
        with write_errors_told(target), unnamed_file(target.parent) as file:
            if hasattr(os, "posix_fallocate"):
                os.posix_fallocate(file.fileno(), 0, size)
            else:
                for start in range(0, size, _STEP):
                    file.write(bytes(min(_STEP, size - start)))
                file.flush()
            self._map = mmap.mmap(file.fileno(), size)
        self.values: np.ndarray = np.frombuffer(self._map, kind, count)

    def leave_memory(self) -> None:
        """Let the values be on disk only, until they are used again."""
        # The file keeps them, including values that have not reached the disk yet.
        if hasattr(mmap, "MADV_DONTNEED"):
            self._map.madvise(mmap.MADV_DONTNEED)
