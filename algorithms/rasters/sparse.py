"""Writes a cloud-optimised GeoTIFF that is mostly voids, in the time and space of those
that have: tiles without data are left out, and the overviews are made of the others.

References
----------
Adobe (1992): TIFF, revision 6.0. Adobe (2005): TIFF Technical Note 3. Aware Systems: BigTIFF.
https://gdal.org/drivers/raster/cog.html#file-format
"""

from __future__ import annotations

import math
import shutil
import struct
import zlib
from pathlib import Path
from typing import BinaryIO, Iterable, NamedTuple

import numpy as np

from ..core.temporary import remove
from ..core.threads import in_threads

SIDE = 256  # cells along a side of a tile
# Entries of a directory of the file.
_SUBFILE, _WIDTH, _LENGTH, _OFFSETS, _SIZES = 254, 256, 257, 324, 325
# Entries that overviews share with the raster: how cells are stored, and the value for no data.
_SHARED = (258, 259, 262, 277, 284, 317, 322, 323, 338, 339, 42113)
_BYTES = {1: 1, 2: 1, 3: 2, 4: 4, 5: 8, 7: 1, 11: 4, 12: 8, 16: 8}  # by the type of an entry
_LONG, _LONG8 = 4, 16  # types
_IN_PLACE = 8  # most bytes of an entry that are in the directory itself
_HEADER = struct.Struct("<2sHHHQ")  # of a BigTIFF; the last is the place of the first directory

_Place = tuple[int, int]  # row and column of a tile
# Type and bytes of the entries of a directory.
_Directory = dict[int, tuple[int, bytes]]


class _Level(NamedTuple):
    """The raster, or an overview of half the size of the level before."""

    shape: tuple[int, int]  # rows and columns
    offsets: np.ndarray  # uint64 (rows, columns) of tiles: where each begins in its file
    sizes: np.ndarray  # uint64: its bytes, 0 for none
    # Tiles that wait for the rest of their cells, (rows, columns, bands).
    waiting: dict[_Place, np.ndarray]

    @classmethod
    def of(cls, shape: tuple[int, int]) -> _Level:
        """Return a level without any tile."""
        tiles = [-(-side // SIDE) for side in shape]
        offsets, sizes = np.zeros((2, *tiles), dtype=np.uint64)
        return cls(shape, offsets, sizes, {})


class RasterPart(NamedTuple):
    """Some cells of a raster."""

    row: int  # of the first cell, from north
    column: int  # of the first cell
    cells: np.ndarray  # (rows, columns) or (bands, rows, columns), from north to south


def write_sparse(path: Path, template: Path, parts: Iterable[RasterPart], nodata: float) -> None:
    """Write a raster of parts; for these and for the template, see `SparseFile`."""
    waiting = [path.with_name(f"{path.name}.{name}") for name in ("cells", "overviews")]
    try:
        with open(waiting[0], "w+b") as cells, open(waiting[1], "w+b") as overviews:
            raster = SparseFile(template, cells, overviews, nodata)
            for part in parts:
                raster.add(*part)
            with open(path, "wb") as file:
                raster.save(file)
    finally:
        for file_of_tiles in waiting:
            remove(file_of_tiles)


class SparseFile:
    """A raster to which parts are added from north to south."""

    # `template` is a BigTIFF of the same size without any tile, compressed by DEFLATE with the
    # predictor for the kind of its cells, as the libraries make it. Tiles wait in the files
    # `cells`, those of the raster, and `overviews`.

    def __init__(self, template: Path, cells: BinaryIO, overviews: BinaryIO, nodata: float) -> None:
        self._entries, self._nodata = _directory_of(template), nodata
        self._files = cells, overviews
        shape = self._number(_LENGTH), self._number(_WIDTH)
        self._levels = [_Level.of(shape)]
        while max(shape) > SIDE:
            shape = -(-shape[0] // 2), -(-shape[1] // 2)
            self._levels.append(_Level.of(shape))

    def _number(self, entry: int) -> int:
        kind, content = self._entries[entry]
        return int.from_bytes(content[: _BYTES[kind]], "little")

    def add(self, row: int, column: int, cells: np.ndarray) -> None:
        """Add cells, (rows, columns) or (bands, rows, columns), that begin at a row and a column;
        no later part lies farther north.
        """
        self._finish(row)
        values = np.moveaxis(cells, 0, -1) if cells.ndim == 3 else cells[..., np.newaxis]
        rows, columns = values.shape[:2]
        waiting = self._levels[0].waiting
        for i in range(row // SIDE, -(-(row + rows) // SIDE)):
            for k in range(column // SIDE, -(-(column + columns) // SIDE)):
                south, west = i * SIDE - row, k * SIDE - column
                part = values[max(south, 0) : south + SIDE, max(west, 0) : west + SIDE]
                tile = waiting.setdefault((i, k), self._empty(values))
                own = tile[max(-south, 0) :, max(-west, 0) :][: part.shape[0], : part.shape[1]]
                own[...] = part

    def _empty(self, like: np.ndarray) -> np.ndarray:
        return np.full((SIDE, SIDE, like.shape[-1]), self._nodata, dtype=like.dtype)

    def _finish(self, row: float) -> None:
        """Write the tiles that lie north of a row of the raster."""
        for number, level in enumerate(self._levels):
            north = [place for place in level.waiting if (place[0] + 1) * SIDE << number <= row]
            self._write(number, {place: level.waiting.pop(place) for place in north})

    def _write(self, number: int, tiles: dict[_Place, np.ndarray]) -> None:
        """Write those of the complete tiles of a level that have data, and add them to the next."""
        level, file = self._levels[number], self._files[number > 0]
        filled = {place: tile for place, tile in tiles.items() if self._has_data(tile).any()}
        packed = in_threads(_packed, filled.values())
        halved = in_threads(self._halved, filled.values()) if level.shape != self._smallest else []
        for place, data in zip(filled, packed):
            level.offsets[place], level.sizes[place] = file.tell(), len(data)
            file.write(data)
        for (i, k), cells in zip(filled, halved):
            above = self._levels[number + 1].waiting.setdefault(
                (i // 2, k // 2), self._empty(cells)
            )
            half = SIDE // 2
            above[i % 2 * half :, k % 2 * half :][:half, :half] = cells

    @property
    def _smallest(self) -> tuple[int, int]:
        return self._levels[-1].shape

    def _has_data(self, values: np.ndarray) -> np.ndarray:
        """Return which values are no value for no data; bool."""
        return ~np.isnan(values) if math.isnan(self._nodata) else values != self._nodata

    def _halved(self, tile: np.ndarray) -> np.ndarray:
        """Return the means of squares of 2 x 2 cells, without voids."""
        squares = tile.reshape(SIDE // 2, 2, SIDE // 2, 2, -1)
        has = self._has_data(squares)
        count = has.sum(axis=(1, 3))
        total = np.where(has, squares, 0).sum(axis=(1, 3), dtype=np.float64)
        means = total / np.maximum(count, 1)
        if tile.dtype.kind == "u":
            means = np.floor(means + 0.5)
        return np.where(count > 0, means, self._nodata).astype(tile.dtype)

    def save(self, file: BinaryIO) -> None:
        """Write all parts that were added as a file, the overviews first."""
        self._finish(math.inf)
        directories = [self._directory(number) for number in range(len(self._levels))]
        lengths = [_length(directory) for directory in directories]
        starts = np.cumsum([_HEADER.size, *lengths], dtype=np.int64).tolist()
        self._place_tiles(starts[-1])
        file.write(_HEADER.pack(b"II", 43, 8, 0, starts[0]))
        for number, (start, after) in enumerate(zip(starts, [*starts[1:-1], 0])):
            file.write(_written(self._directory(number), start, after))
        for waiting in reversed(self._files):
            waiting.seek(0)
            shutil.copyfileobj(waiting, file)

    def _place_tiles(self, start: int) -> None:
        """Let the offsets of tiles count from the start of the file."""
        overviews = self._files[1].tell()
        for number, level in enumerate(self._levels):
            level.offsets[level.sizes > 0] += np.uint64(start if number else start + overviews)

    def _directory(self, number: int) -> _Directory:
        """Return the entries of a level."""
        entries, level = dict(self._entries), self._levels[number]
        if number:
            entries = {entry: entries[entry] for entry in _SHARED if entry in entries}
            entries[_SUBFILE] = _LONG, struct.pack("<I", 1)
        for entry, side in zip((_LENGTH, _WIDTH), level.shape):
            entries[entry] = _LONG, struct.pack("<I", side)
        entries[_OFFSETS], entries[_SIZES] = (
            (_LONG8, numbers.astype("<u8").tobytes()) for numbers in (level.offsets, level.sizes)
        )
        return entries


def _packed(tile: np.ndarray) -> bytes:
    """Return a tile as it is stored: differences along its rows, compressed."""
    rows, columns, bands = tile.shape
    if tile.dtype.kind == "f":
        # The bytes of floats are sorted by their weight first, as Technical Note 3 says.
        values = tile.astype(">f4").view(np.uint8).reshape(rows, columns * bands, 4)
        values = values.transpose(0, 2, 1).reshape(rows, -1, bands)
    else:
        values = tile
    differences = values.copy()
    differences[:, 1:] -= values[:, :-1]
    return zlib.compress(differences.tobytes(), 6)


def _directory_of(path: Path) -> _Directory:
    """Return the entries of the first directory of a BigTIFF."""
    entries: _Directory = {}
    with open(path, "rb") as file:
        file.seek(_HEADER.unpack(file.read(_HEADER.size))[-1])
        (count,) = struct.unpack("<Q", file.read(8))
        for entry in struct.iter_unpack("<HHQ8s", file.read(20 * count)):
            number, kind, values, content = entry
            size = _BYTES[kind] * values
            if number not in (_OFFSETS, _SIZES):
                if size > _IN_PLACE:
                    file.seek(struct.unpack("<Q", content)[0])
                    content = file.read(size)
                entries[number] = kind, content[:size]
    return entries


def _length(directory: _Directory) -> int:
    """Return the number of bytes of a directory with its contents, a multiple of 8."""
    return len(_written(directory, 0, 0))


def _written(directory: _Directory, start: int, after: int) -> bytes:
    """Return a directory that begins at a place of the file, and the place of the one after it."""
    entries, contents = [], b""
    place = start + 8 + 20 * len(directory) + 8
    place += -place % 8
    gap = b"\0" * (place - (start + 16 + 20 * len(directory)))
    for number, (kind, content) in sorted(directory.items()):
        count = len(content) // _BYTES[kind]
        if len(content) > _IN_PLACE:
            value = struct.pack("<Q", place + len(contents))
            contents += content + b"\0" * (-len(content) % 8)
        else:
            value = content.ljust(_IN_PLACE, b"\0")
        entries.append(struct.pack("<HHQ8s", number, kind, count, value))
    head = struct.pack("<Q", len(directory)) + b"".join(entries) + struct.pack("<Q", after)
    return head + gap + contents
