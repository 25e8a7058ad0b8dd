"""Reads and writes points as raw bytes, in LAS and LAZ."""

from __future__ import annotations

import contextlib
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO, Callable, Iterable, Iterator, Sequence, TypeVar

import numpy as np

from ..core.errors import BareEarthError
from ..core.progress import paced
from .extrabytes import remembers, runs_of_bytes
from .gps_times import check_gps_times
from .lasfile import FIRST_EXTENDED_FORMAT, LASZIP, LasFile, Vlr, new_vlr
from .laszip import with_chunk_size, with_wave_packets_of_1
from .sources import changed, damage_told, damaged, open_source

if TYPE_CHECKING:
    import laspy
    import lazrs

_Result = TypeVar("_Result")

# Layers of lazrs.
_NEEDED = ("Z", "CLASSIFICATION", "FLAGS")
_REMEMBERED = "ALL_EXTRA_BYTES"
_TIMES = "GPS_TIME"
_STRIPS = "POINT_SOURCE_ID"
# Most points at a time, through a buffer, and if all of them are in memory.
_MOST = 1_000_000
MOST_KEPT = 8_000_000
_BLOCK = 1 << 24
_LARGEST_LEGACY_CLASS = 31


def check_class(path: object, point_format: int, value: int, use: str) -> None:
    """Refuse a class that does not fit into the point format of a file; the message names its use,
    such as "the ground".
    """
    # Formats 0 to 5 have five bits for the class.
    if point_format < FIRST_EXTENDED_FORMAT and value > _LARGEST_LEGACY_CLASS:
        raise BareEarthError(
            f"Point format {point_format} holds classes up to {_LARGEST_LEGACY_CLASS}, not {value}."
            f" Choose another class for {use} of {path}."
        )


def needed(layout: LasFile, times: bool = False, strips: bool = False) -> tuple[str, ...]:
    """Return the layers of points (formats 6 to 10) that a `PointCloud` needs, and if wanted the
    layers of GPS times and strips (point source ids).
    """
    # x, y, returns and scanner channel are always decompressed, and not in this list.
    layers = (*_NEEDED, _REMEMBERED) if remembers(layout) else _NEEDED
    return (*layers, *[_TIMES] * times, *[_STRIPS] * strips)


def selection_of(columns: Sequence[str]) -> lazrs.DecompressionSelection:
    """Return layers as a selection of lazrs, with the layers that are always decompressed."""
    import lazrs

    selection = lazrs.SELECTIVE_DECOMPRESS_XY_RETURNS_CHANNEL
    for name in columns:
        selection |= getattr(lazrs, f"SELECTIVE_DECOMPRESS_{name}")
    return lazrs.DecompressionSelection(selection)


def read_records(
    layout: LasFile,
    most: int = _MOST,
    into: np.ndarray | None = None,
    columns: Sequence[str] | None = None,
    pieces: Iterable[slice] | None = None,
) -> Iterator[np.ndarray]:
    """Yield the records of a file as writable arrays, uint8 (up to `most`, record length): parts of
    `into`, or arrays that use the same memory.
    """
    # `columns` are the layers to decompress (formats 6 to 10, named as in
    # `laspy.DecompressionSelection`), by default all. x, y, returns and scanner channel are always
    # decompressed; other layers are undefined.
    # `pieces` are the parts to read, without gaps, of at most `most` points; by default about as
    # many points as are read in half a second.
    with _reader(layout, columns) as read:
        if into is None:
            buffer = np.empty((min(most, layout.count), layout.record_length), dtype=np.uint8)
        for piece in paced(layout.count, most) if pieces is None else pieces:
            records = buffer[: piece.stop - piece.start] if into is None else into[piece]
            with damage_told(layout.path):
                read(records, piece.start)
            yield records


@contextlib.contextmanager
def _reader(
    layout: LasFile, columns: Sequence[str] | None
) -> Iterator[Callable[[np.ndarray, int], None]]:
    """Yield a function that fills an array with the next records, given the index of the first."""
    source: Path | BinaryIO = layout.path
    unpacked, start = layout.unpacked, layout.points_start
    if unpacked is not None and unpacked.has(columns):
        source, start = unpacked.file, 0
    else:
        unpacked = None
    opened = open_source(source) if isinstance(source, Path) else contextlib.nullcontext(source)
    with opened as file:
        if layout.laszip is not None and unpacked is None:
            file.seek(start)
            decompressor = _decompressor(layout, layout.laszip, file, columns)
            yield lambda records, _: decompressor.decompress_many(records.reshape(-1))
            return

        def read(records: np.ndarray, first: int) -> None:
            # Several readers can share an open file.
            file.seek(start + first * layout.record_length)
            # The type `BinaryIO` lacks this method, which all binary files have.
            if file.readinto(records.reshape(-1)) != records.size:  # type: ignore[attr-defined]
                raise damaged(layout.path)

        yield read


def named(layout: LasFile, records: np.ndarray) -> laspy.PackedPointRecord:
    """Return records as points of laspy, whose columns have names."""
    return as_points(layout.point_format, runs_of_bytes(layout), records)


def attributes_of(layout: LasFile) -> frozenset[str]:
    """Return the names of the attributes of a point format, without extra bytes."""
    import laspy

    return frozenset(laspy.PointFormat(layout.point_format).dimension_names)


def as_points(
    point_format: int, extra: Iterable[tuple[str, int]], records: np.ndarray
) -> laspy.PackedPointRecord:
    """Return records as points of laspy; `extra` are names and sizes of the extra bytes."""
    import laspy

    point_type = laspy.PointFormat(point_format)
    for name, size in extra:
        if size:
            point_type.add_extra_dimension(laspy.ExtraBytesParams(name, f"{size}u1"))
    return laspy.PackedPointRecord.from_buffer(records, point_type)


def column(records: np.ndarray, start: int, kind: str | np.dtype) -> np.ndarray:
    """Return the field that begins at a byte of each record, as a writable view."""
    # numpy before 1.23 can view whole rows as another type, but not some of their columns.
    row = np.dtype(
        {"names": ["field"], "formats": [kind], "offsets": [start], "itemsize": records.shape[1]}
    )
    return records.view(row)["field"][:, 0]


class HeaderCounts:
    """Collects the numbers and limits of points that a header states, while they are written."""

    def __init__(self, layout: LasFile) -> None:
        self._layout = layout
        limits = np.iinfo(np.int64)
        self.lowest = np.full(3, limits.max)  # int64 (3,), x, y and z as integers
        self.highest = np.full(3, limits.min)  # int64 (3,)
        self.returns = np.zeros(15, dtype=np.int64)  # int64 (15,), of first, second, ... returns

    def add(self, records: np.ndarray) -> None:
        """Count the points of some records."""
        if not len(records):
            return
        points = named(self._layout, records)
        xyz = [points[name] for name in "XYZ"]
        self.lowest = np.minimum(self.lowest, [axis.min() for axis in xyz])
        self.highest = np.maximum(self.highest, [axis.max() for axis in xyz])
        numbers = np.bincount(np.asarray(points["return_number"]), minlength=16)
        self.returns += numbers[1:16]


class LasRecordWriter:
    """Writes records uncompressed."""

    def __init__(self, file: BinaryIO) -> None:
        self._file = file

    def write(self, records: np.ndarray) -> None:
        """Append points."""
        self._file.write(records.data)

    def finish(self) -> None:
        """Finish writing."""


class LazRecordWriter:
    """Compresses records with lazrs."""

    def __init__(self, file: BinaryIO, laszip_vlr: Vlr) -> None:
        import lazrs

        self._file = _ErrorKeeper(file)
        self._vlr = lazrs.LazVlr(laszip_vlr.data)
        self._compressor = self._call(lazrs.ParLasZipCompressor, self._file, self._vlr)

    def write(self, records: np.ndarray) -> None:
        """Append points."""
        self._call(self._compressor.compress_many, records.reshape(-1))

    def write_chunks(self, chunks: list[np.ndarray]) -> None:
        """Append points, each array as a chunk, if chunks may have different sizes."""
        self._call(self._compressor.compress_chunks, [chunk.reshape(-1) for chunk in chunks])

    def finish(self) -> None:
        """Write the last chunk and the chunk table."""
        self._call(self._compressor.done)

    def chunk_sizes(self, file: BinaryIO) -> list[int]:
        """Return the size of each chunk of a finished file, positioned at its points."""
        import lazrs

        return [size for _, size in lazrs.read_chunk_table(file, self._vlr)]

    def _call(self, function: Callable[..., _Result], *arguments: object) -> _Result:
        """Call lazrs; raise the original error of the file instead of that of lazrs."""
        import lazrs

        try:
            return function(*arguments)
        except (lazrs.LazrsError, OSError) as error:
            if self._file.error is not None:
                raise self._file.error from error
            raise


class _ErrorKeeper:
    """A file that stores its error, since lazrs raises another error without its number."""

    def __init__(self, file: BinaryIO) -> None:
        self._file = file
        self.error: OSError | None = None

    def write(self, data: bytes) -> int:
        return self._keep(self._file.write, data)

    def flush(self) -> None:
        self._keep(self._file.flush)

    def seek(self, *where: int) -> int:
        return self._keep(self._file.seek, *where)

    def tell(self) -> int:
        return self._file.tell()

    def _keep(self, function: Callable[..., _Result], *arguments: object) -> _Result:
        try:
            return function(*arguments)
        except OSError as error:
            self.error = error
            raise


def laszip_vlr(point_format: int, extra_bytes: int, variable_chunks: bool = False) -> Vlr:
    """Return the LASzip record for compressing points; refuse a format that the installed lazrs
    does not know.
    """
    # lazrs 0.5 does not know those with waveforms.
    import lazrs

    try:
        vlr = lazrs.LazVlr.new_for_compression(point_format, extra_bytes, variable_chunks)
    except lazrs.LazrsError as error:
        raise BareEarthError(
            f"This version of lazrs cannot compress point format {point_format}. Install a newer"
            " one, or name the output .las."
        ) from error
    record = with_wave_packets_of_1(bytes(vlr.record_data()))
    return new_vlr(LASZIP, record, "by lazrs")


def copy_range(source: BinaryIO, target: BinaryIO, start: int, end: int) -> None:
    """Append the bytes of `source` from `start` to `end` to `target`; refuse a source that ends
    before.
    """
    source.seek(start)
    while start < end:
        block = source.read(min(_BLOCK, end - start))
        if not block:
            raise changed(Path(source.name))
        target.write(block)
        start += len(block)


def _decompressor(
    layout: LasFile, record: bytes, file: BinaryIO, columns: Sequence[str] | None
) -> lazrs.ParLasZipDecompressor:
    import lazrs

    if columns is None or layout.point_format < FIRST_EXTENDED_FORMAT:
        check_gps_times(layout)
    points = layout.chunk_table[0][0]
    if points > layout.count:
        # Room for a whole chunk is made, however few points there are.
        record = with_chunk_size(record, layout.count)
    selection = None if columns is None else selection_of(columns)
    with damage_told(layout.path):
        return lazrs.ParLasZipDecompressor(file, record, selection)
