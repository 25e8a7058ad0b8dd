"""Points on disk, until their block is computed."""

from __future__ import annotations

import contextlib
import dataclasses
import os
import threading
from pathlib import Path
from typing import BinaryIO, Iterator

import numpy as np

from ..core.files import describe_write_error, reach_disk, unnamed_file
from ..core.points import Box, Frame
from ..core.progress import SILENT, Progress
from ..las.cloud import PointCloud, survey_frame
from .blocks import BlockPoints, Blocks, Corner, Leaves, gathered
from .leaf_index import LeafIndex, Sorted, smallest_integers

_RECORD = np.dtype([("x", "<i4"), ("y", "<i4"), ("z", "<i4"), ("flags", "u1")])
_KNOWN, _WANTED, _ROAD, _MULTI_RETURN = 1, 2, 4, 8
# If fewer points than this lie between two labelled ones, one access to the file is cheaper.
_GAP = 1 << 16
# Points that are read at a time.
_MOST_READ = 1 << 15
# Bytes that are written at a time to allocate a file.
_STEP = 1 << 24


class DiskPoints:
    """The selected points, in temporary files without a name.

    The system removes the files when they are closed or the process ends, even if it is killed.

    Parameters
    ----------
    target : Path
        The output. The files are in its folder.
    blocks : Blocks
        The points are sorted by their leaves, part by part.
    kind : type
        Type of the value that is stored for each point.
    origin : tuple of float
        Origin of the frame of the blocks, in units of the CRS.

    Attributes
    ----------
    count : int
        Number of points so far.
    cloud : PointCloud
        The file without its points.
    leaves, has_known
        As `Store` says; `leaves` after `finish` only.
    """

    def __init__(
        self,
        target: Path,
        blocks: Blocks,
        kind: type = np.uint8,
        origin: tuple[float, float] = (0.0, 0.0),
    ) -> None:
        self._kind = np.dtype(kind)
        self.count, self.has_known, self.leaves = 0, False, None
        self._target = Path(target)
        self._side, self._start = blocks.leaf_side, blocks.start
        self._lock, self._files = threading.Lock(), contextlib.ExitStack()
        with self._told():
            self._records, self._labels = self._file(), self._file()
        self.cloud: PointCloud | None = None
        self._frame, self._origin = Frame(), origin
        # For each part the index of its first point here, and a mask of its points, as bits.
        self._parts: list[tuple[int, np.ndarray]] = []
        self._runs = LeafIndex()

    def _file(self) -> BinaryIO:
        return self._files.enter_context(unnamed_file(self._target.parent))

    def __enter__(self) -> DiskPoints:
        return self

    def __exit__(self, *exception: object) -> None:
        with self._lock:
            self._files.close()

    @contextlib.contextmanager
    def _told(self) -> Iterator[None]:
        try:
            yield
        except OSError as error:
            raise describe_write_error(self._target, error) from error

    def append(
        self,
        part: PointCloud,
        selected: np.ndarray,
        known: np.ndarray,
        wanted: np.ndarray,
        roads: np.ndarray | None = None,
    ) -> None:
        """Add the selected points of the next part of a file.

        Parameters
        ----------
        part : PointCloud
            Points in file order.
        selected, known, wanted : numpy.ndarray of bool, shape (n,)
            Which take part, which are known ground, and which are to be labelled.
        roads : numpy.ndarray of bool, shape (n,), optional
            Which are ground where they lie on it.
        """
        if self.cloud is None:
            names = ("x", "y", "z", "classification", "return_number", "number_of_returns")
            nothing = {name: getattr(part, name)[:0] for name in (*names, "withheld")}
            self.cloud = dataclasses.replace(part, **nothing)
            self._frame = survey_frame(part.crs, self._origin)
        which, found = self._sorted(part, selected)
        records = np.empty(len(which), dtype=_RECORD)
        for name in ("x", "y", "z"):
            records[name] = getattr(part, name)[which]
        records["flags"] = _KNOWN * known[which] + _WANTED * wanted[which]
        records["flags"] |= (_MULTI_RETURN * (part.number_of_returns[which] > 1)).astype(np.uint8)
        if roads is not None:
            records["flags"] |= (_ROAD * roads[which]).astype(np.uint8)
        self.has_known |= bool(known[which].any())
        with self._told():
            self._records.write(records.tobytes())
        self._runs.add(found.codes, found.counts, self.count)
        self._parts.append((self.count, np.packbits(selected)))
        self.count += len(which)

    def _sorted(self, part: PointCloud, selected: np.ndarray) -> tuple[np.ndarray, Sorted]:
        """Return which points are selected, sorted by leaves, and how they were sorted."""
        which = np.flatnonzero(selected)
        places = part.places(which, self._frame)
        found = Sorted.of(*(np.floor((each - self._start) / self._side) for each in places[::-1]))
        return which[found.order], found

    def finish(self) -> None:
        """Finish adding points."""
        rows, columns, totals = self._runs.finish()
        x, y = (number * self._side + self._start for number in (columns, rows))
        self.leaves = Leaves(x, y, self._side, totals)
        with self._told():
            reach_disk(self._records)
            self._labels.truncate(self.count * self._kind.itemsize)

    def read(
        self,
        leaves: np.ndarray,
        box: Box | None = None,
        corner: Corner = (0.0, 0.0),
        progress: Progress = SILENT,
    ) -> BlockPoints:
        """Return the points of some leaves in file order; only those in a box, if given."""
        runs, frame = list(_joined(*self._runs.of(leaves))), self._frame.moved(corner)
        kind = smallest_integers(self.count)

        def read(number: int) -> BlockPoints:
            start, end = runs[number]
            with self._lock:
                records = _read(self._records, _RECORD, start, end)
            columns = {name: records[name] for name in "xyz"}
            points = dataclasses.replace(self.cloud, **columns).points(slice(None), frame)
            flags = records["flags"]
            positions = np.arange(start, end, dtype=kind)
            kinds = _KNOWN, _WANTED, _ROAD, _MULTI_RETURN
            known, wanted, roads, several = (flags & each > 0 for each in kinds)
            return BlockPoints(points, known, wanted, positions, roads, several)

        return gathered([end - start for start, end in runs], read, box, kind, progress)

    def put(self, positions: np.ndarray, labels: np.ndarray) -> None:
        """Store the labels of points, whose positions must ascend."""
        if not len(positions):
            return
        cuts = np.flatnonzero(np.diff(positions) > _GAP) + 1
        with self._told():
            for where, values in zip(np.split(positions, cuts), np.split(labels, cuts)):
                first, last = int(where[0]), int(where[-1]) + 1
                held = _read(self._labels, self._kind, first, last).copy()
                held[where - first] = values
                self._labels.seek(first * self._kind.itemsize)
                self._labels.write(held.tobytes())
            reach_disk(self._labels)

    def values_of(self, number: int, part: PointCloud) -> np.ndarray:
        """Return the values that are stored for the points of a part.

        Parameters
        ----------
        number : int
            How many parts were appended before this one.
        part : PointCloud
            Its points.

        Returns
        -------
        numpy.ndarray, shape (n,)
            0 for those that are not selected.
        """
        start, bits = self._parts[number]
        selected = np.unpackbits(bits, count=part.count).astype(bool)
        which, _ = self._sorted(part, selected)
        values, end = np.zeros(part.count, dtype=self._kind), start + len(which)
        values[which] = _read(self._labels, self._kind, start, end)
        return values


def _read(file: BinaryIO, kind: np.dtype, start: int, end: int) -> np.ndarray:
    """Return some of the values in a file, all of which are of one type."""
    file.seek(start * kind.itemsize)
    return np.frombuffer(file.read((end - start) * kind.itemsize), dtype=kind)


def room_on_disk(target: Path, kind: type, count: int) -> np.ndarray:
    """Return room for values of points in a temporary file without a name.

    Parameters
    ----------
    target : Path
        The output. The file is in its folder.
    kind : type
        Type of the values.
    count : int
        Number of values.

    Raises
    ------
    BareEarthError
        If the disk is full. Without this check, writing to the mapped file would end the process.
    """
    try:
        with unnamed_file(target.parent) as file:
            size = max(count, 1) * np.dtype(kind).itemsize
            if hasattr(os, "posix_fallocate"):
                os.posix_fallocate(file.fileno(), 0, size)
            else:
                for start in range(0, size, _STEP):
                    file.write(bytes(min(_STEP, size - start)))
                file.flush()
            return np.memmap(file, kind, "r+", shape=(count,))
    except OSError as error:
        raise describe_write_error(target, error) from error


def _joined(starts: np.ndarray, counts: np.ndarray) -> Iterator[tuple[int, int]]:
    """Yield start and end of runs; adjacent ones are joined, and long ones are split."""
    if not len(starts):
        return
    ends = starts + counts
    breaks = np.flatnonzero(starts[1:] != ends[:-1])
    firsts, lasts = np.r_[0, breaks + 1], np.r_[breaks, len(starts) - 1]
    for start, end in zip(starts[firsts].tolist(), ends[lasts].tolist()):
        for first in range(start, end, _MOST_READ):
            yield first, min(first + _MOST_READ, end)
