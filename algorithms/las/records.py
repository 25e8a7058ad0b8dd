"""Points as raw bytes, in and out of LAS and LAZ, by chunks."""

from __future__ import annotations

from typing import TYPE_CHECKING, BinaryIO, Iterable, Iterator, Sequence

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

_NEEDED, _REMEMBERED = ("Z", "CLASSIFICATION", "FLAGS"), "ALL_EXTRA_BYTES"
# Most points at a time: where they go through a buffer, and where all of them are in memory.
_MOST, MOST_KEPT = 1_000_000, 8_000_000
_BLOCK = 1 << 24
_LARGEST_LEGACY_CLASS = 31


def check_class(path: object, point_format: int, value: int, what: str) -> None:
    """Refuse a class that the point format of a file has no room for.

    Parameters
    ----------
    path : path-like
        The file.
    point_format : int
        Its point format; 0 to 5 have five bits for the class.
    value : int
        The class.
    what : str
        Whose class it is, as "the ground".

    Raises
    ------
    BareEarthError
        If the class does not fit.
    """
    if point_format < FIRST_EXTENDED_FORMAT and value > _LARGEST_LEGACY_CLASS:
        raise BareEarthError(
            f"Point format {point_format} holds classes up to {_LARGEST_LEGACY_CLASS}, not {value}."
            f" Choose another class for {what} of {path}."
        )


def needed(layout: LasFile) -> tuple[str, ...]:
    """Return what a `PointCloud` has of points that are compressed by columns (formats 6 to 10).

    x, y, returns and scanner channel are not among it.
    """
    return (*_NEEDED, _REMEMBERED) if remembers(layout) else _NEEDED


def selection_of(columns: Sequence[str]) -> lazrs.DecompressionSelection:
    """Return what lazrs calls these columns of points, with those that are always decompressed."""
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
    """Yield the points of a file as their bytes.

    Parameters
    ----------
    layout : LasFile
        The file.
    most : int
        Most points to read at a time; fewer where that takes long.
    into : numpy.ndarray of uint8, shape (n, record length), optional
        Where to keep all of them.
    columns : sequence of str, optional
        Which columns are wanted of point formats that are compressed by columns, by their names in
        `laspy.DecompressionSelection`, as `needed`; x, y, returns and the scanner channel always
        are. All, if it is not given. What is in the others is not said.
    pieces : iterable of slice, optional
        Which points to read at a time, one piece after the other, none longer than `most`. As
        many as are read in half a second or so, if it is not given.

    Yields
    ------
    numpy.ndarray of uint8, shape (up to `most`, record length)
        A writable array: a part of `into`, or one whose memory the next may reuse.

    Raises
    ------
    BareEarthError
        If the file is damaged.
    """
    with open_source(layout.path) as file:
        file.seek(layout.points_start)
        decompressor = _decompressor(layout, file, columns) if layout.is_compressed else None
        if into is None:
            buffer = np.empty((min(most, layout.count), layout.record_length), dtype=np.uint8)
        for piece in paced(layout.count, most) if pieces is None else pieces:
            records = buffer[: piece.stop - piece.start] if into is None else into[piece]
            with damage_told(layout.path):
                if decompressor is not None:
                    decompressor.decompress_many(records.reshape(-1))
                elif file.readinto(records.reshape(-1)) != records.size:
                    raise damaged(layout.path)
            yield records


def named(layout: LasFile, records: np.ndarray) -> laspy.PackedPointRecord:
    """Return points, given as their bytes, by the names that laspy has for their columns."""
    return as_points(layout.point_format, runs_of_bytes(layout), records)


def as_points(
    point_format: int, extra: Iterable[tuple[str, int]], records: np.ndarray
) -> laspy.PackedPointRecord:
    """Return the same, given the point format, and name and size of the extra bytes."""
    import laspy

    point_type = laspy.PointFormat(point_format)
    for name, size in extra:
        if size:
            point_type.add_extra_dimension(laspy.ExtraBytesParams(name, f"{size}u1"))
    return laspy.PackedPointRecord.from_buffer(records, point_type)


def column(records: np.ndarray, start: int, kind: str | np.dtype) -> np.ndarray:
    """Return the field at a byte of each record, as a view that may be written to."""
    # numpy before 1.23 cannot view a few columns in another type, but it can view whole rows.
    row = {"names": ["field"], "formats": [kind], "offsets": [start]}
    return records.view(np.dtype({**row, "itemsize": records.shape[1]}))["field"][:, 0]


class Tally:
    """Counts what a header says of points, as they are written.

    Attributes
    ----------
    lowest, highest : numpy.ndarray of int64, shape (3,)
        Smallest and largest x, y and z as integers.
    returns : numpy.ndarray of int64, shape (15,)
        How many first, second, ... returns there were.
    """

    def __init__(self, layout: LasFile) -> None:
        self._layout = layout
        limits = np.iinfo(np.int64)
        self.lowest = np.full(3, limits.max)
        self.highest = np.full(3, limits.min)
        self.returns = np.zeros(15, dtype=np.int64)

    def add(self, records: np.ndarray) -> None:
        """Count points, given as their bytes."""
        if not len(records):
            return
        points = named(self._layout, records)
        xyz = [points[name] for name in "XYZ"]
        self.lowest = np.minimum(self.lowest, [each.min() for each in xyz])
        self.highest = np.maximum(self.highest, [each.max() for each in xyz])
        numbers = np.bincount(np.asarray(points["return_number"]), minlength=16)
        self.returns += numbers[1:16]


class LasRecordWriter:
    """Writes the bytes of points as they are."""

    def __init__(self, file: BinaryIO) -> None:
        self._file = file

    def write(self, records: np.ndarray) -> None:
        """Append points."""
        self._file.write(records.data)

    def finish(self) -> None:
        """End the points."""


class LazRecordWriter:
    """Compresses the bytes of points with lazrs."""

    def __init__(self, file: BinaryIO, laszip_vlr: Vlr) -> None:
        import lazrs

        self._file = _ErrorKeeper(file)
        self._vlr = lazrs.LazVlr(laszip_vlr.data)
        self._compressor = self._call(lazrs.ParLasZipCompressor, self._file, self._vlr)

    def write(self, records: np.ndarray) -> None:
        """Append points."""
        self._call(self._compressor.compress_many, records.reshape(-1))

    def write_chunks(self, chunks: list[np.ndarray]) -> None:
        """Append points, each array as a chunk; only where chunks may differ in size."""
        self._call(self._compressor.compress_chunks, [chunk.reshape(-1) for chunk in chunks])

    def finish(self) -> None:
        """Write the last chunk and the chunk table."""
        self._call(self._compressor.done)

    def chunk_sizes(self, file: BinaryIO) -> list[int]:
        """Return the bytes of each chunk in a finished file, which stands at its points."""
        import lazrs

        return [size for _, size in lazrs.read_chunk_table(file, self._vlr)]

    def _call(self, function, *arguments):
        """Call lazrs; raise what the file raised instead of what lazrs makes of it."""
        import lazrs

        try:
            return function(*arguments)
        except (lazrs.LazrsError, OSError) as error:
            if self._file.error is not None:
                raise self._file.error from error
            raise


class _ErrorKeeper:
    """A file that remembers its error, since lazrs passes on neither its kind nor its number."""

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

    def _keep(self, function, *arguments):
        try:
            return function(*arguments)
        except OSError as error:
            self.error = error
            raise


def laszip_vlr(point_format: int, extra_bytes: int, variable_chunks: bool = False) -> Vlr:
    """Return the record that tells how lazrs compresses points.

    Parameters
    ----------
    point_format, extra_bytes : int
        Format of the points, and the bytes of each that it does not define.
    variable_chunks : bool
        Whether chunks may differ in their number of points.

    Raises
    ------
    BareEarthError
        If the lazrs at hand does not know the format: 0.5 does not know those with waveforms.
    """
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
    """Append the bytes of `source` from `start` to `end` to `target`.

    Raises
    ------
    BareEarthError
        If there are not so many.
    """
    source.seek(start)
    while start < end:
        block = source.read(min(_BLOCK, end - start))
        if not block:
            raise changed(source.name)
        target.write(block)
        start += len(block)


def _decompressor(layout: LasFile, file: BinaryIO, columns: Sequence[str] | None):
    import lazrs

    if columns is None or layout.point_format < FIRST_EXTENDED_FORMAT:
        check_gps_times(layout)
    record, points = layout.laszip, layout.chunk_table[0][0]
    if points > layout.count:
        # Room for a whole chunk is made, however few points there are.
        record = with_chunk_size(record, layout.count)
    selection = None if columns is None else selection_of(columns)
    with damage_told(layout.path):
        return lazrs.ParLasZipDecompressor(file, record, selection)
