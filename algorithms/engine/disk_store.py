"""Points on disk, until their block is computed, and their values."""

from __future__ import annotations

import bisect
import contextlib
import dataclasses
import os
import threading
from pathlib import Path
from typing import BinaryIO, Callable, Iterator, Sequence

import numpy as np

from ..core.disk_arrays import RowsOnDisk
from ..core.files import write_errors_told
from ..core.points import Frame
from ..core.progress import SILENT, Progress
from ..core.unnamed import reach_disk, unnamed_file
from ..las.cloud import PointCloud
from .blocks import Blocks
from .store import OTHERS, BlockPoints, Corner, LeafIndex, Marks, Store, smallest_integers

_RECORD = np.dtype([("x", "<i4"), ("y", "<i4"), ("z", "<i4"), ("flags", "u1")])
_INDEX = np.dtype("<i4")
# Bits of flags; the flags with names have the third bit and those after it.
_KNOWN = 1
_WANTED = 2
_FIRST_NAMED = 4
# If fewer points than this lie between two labelled ones, one access to the file is cheaper.
_GAP = 1 << 16
# Points that are read at a time.
_MOST_READ = 1 << 15


class DiskStore(Store):
    """A store whose points, sorted by leaves part by part, are in temporary files without a name in
    the folder of `target`; `kind` is the type of the values.
    """

    # The system removes the files when they are closed, or when the process ends or is killed.

    reads_all = True

    def __init__(self, target: Path, frame: Frame, blocks: Blocks, kind: type = np.uint8) -> None:
        super().__init__(frame, kind)
        self._stored = 0  # selected points
        self._target = Path(target)
        self._lock, self._files = threading.Lock(), contextlib.ExitStack()
        with write_errors_told(self._target):
            self._records, self._orders, self._values, self._cells = (
                self._files.enter_context(unnamed_file(self._target.parent)) for _ in range(4)
            )
        # For each part: the cloud without its points, its number of points, and the position of its
        # first stored point.
        self._clouds: list[PointCloud] = []
        self._sizes: list[int] = []
        self._firsts: list[int] = []
        self._runs = LeafIndex(blocks.leaf_side, blocks.start)

    def __enter__(self) -> DiskStore:
        return self

    def __exit__(self, *exception: object) -> None:
        with self._lock:
            self._files.close()

    def append(self, part: PointCloud, marks: Marks) -> None:
        super().append(part, marks)
        indices = np.flatnonzero(marks.selected)
        indices = indices[self._runs.sort(part.places(indices, self.frame), self._stored)]
        records = np.empty(len(indices), dtype=_RECORD)
        for name in ("x", "y", "z"):
            records[name] = getattr(part, name)[indices]
        records["flags"] = _flags(marks, indices)
        self.has_known |= bool((records["flags"] & _KNOWN).any())
        with write_errors_told(self._target):
            self._records.write(records.tobytes())
            self._orders.write(indices.astype(_INDEX).tobytes())
        # An empty array of indices, since an empty slice would keep the points in memory.
        self._clouds.append(part.take(np.zeros(0, dtype=np.intp)))
        self._sizes.append(part.count)
        self._firsts.append(self._stored)
        self._stored += len(indices)

    def finish(self, progress: Progress = SILENT) -> None:
        self.leaves = self._runs.finish()
        with write_errors_told(self._target):
            reach_disk(self._records)
            reach_disk(self._orders)
            self._values.truncate(self._stored * self._value_kind.itemsize)

    def pieces(
        self, leaves: np.ndarray, corner: Corner, only: str | None = None
    ) -> tuple[list[int], Callable[[int], BlockPoints]]:
        """Return the numbers of points of the runs of some leaves, and a function to read a run."""
        starts, kind = self._firsts, smallest_integers(self.count)
        frame, runs = self.frame.moved(corner), list(_joined(*self._runs.of(leaves), starts))
        named = _bits(self.flags)

        def read(number: int) -> BlockPoints:
            run = runs[number]
            with self._lock:
                records = _read(self._records, _RECORD, *run)
            positions: np.ndarray = np.arange(*run, dtype=kind)
            if only is not None:
                bits = records["flags"] & (_KNOWN | named.get(only, 0))
                chosen = np.flatnonzero(bits == 0 if only == OTHERS else bits)
                records, positions = records[chosen], positions[chosen]
            x, y, z = (records[name] for name in "xyz")
            # Files can differ in scale and offset.
            cloud = self._clouds[bisect.bisect_right(starts, run[0]) - 1]
            points = dataclasses.replace(cloud, x=x, y=y, z=z).points(slice(None), frame)
            known, wanted = (records["flags"] & bit > 0 for bit in (_KNOWN, _WANTED))
            flags = {name: records["flags"] & bit > 0 for name, bit in named.items()}
            return BlockPoints(points, known, wanted, positions, flags)

        return [end - start for start, end in runs], read

    def put(self, positions: np.ndarray, values: np.ndarray) -> None:
        if not len(positions):
            return
        kind, cuts = self._value_kind, np.flatnonzero(np.diff(positions) > _GAP) + 1
        with write_errors_told(self._target):
            for where, new in zip(np.split(positions, cuts), np.split(values, cuts)):
                first, last = int(where[0]), int(where[-1]) + 1
                stored = _read(self._values, kind, first, last).copy()
                stored[where - first] = new
                self._values.seek(first * kind.itemsize)
                self._values.write(stored.tobytes())
            reach_disk(self._values)

    def keep(self, cells: np.ndarray) -> RowsOnDisk:
        """Write cells to the disk."""
        with self._lock, write_errors_told(self._target):
            start = self._cells.seek(0, os.SEEK_END)
            self._cells.write(np.ascontiguousarray(cells).data)
            reach_disk(self._cells)
        return RowsOnDisk(self._cells, start, cells.shape, cells.dtype)

    def values(self, number: int) -> np.ndarray:
        values = np.zeros(self._sizes[number], dtype=self._value_kind)
        start, end, *_ = *self._firsts[number:], self._stored
        indices = _read(self._orders, _INDEX, start, end)
        values[indices] = _read(self._values, self._value_kind, start, end)
        return values


def _bits(names: Sequence[str]) -> dict[str, int]:
    return {name: _FIRST_NAMED << number for number, name in enumerate(names)}


def _flags(marks: Marks, indices: np.ndarray) -> np.ndarray:
    """Return the flags of some points as the bits of an integer."""
    flags = np.full(len(indices), 0 if marks.wanted is not None else _WANTED, dtype=np.uint8)
    named = [(bit, marks.flags[name]) for name, bit in _bits(tuple(marks.flags)).items()]
    for bit, mask in ((_KNOWN, marks.known), (_WANTED, marks.wanted), *named):
        if mask is not None:
            flags |= (bit * mask[indices]).astype(np.uint8)
    return flags


def _read(file: BinaryIO, kind: np.dtype, start: int, end: int) -> np.ndarray:
    """Return the values from start to end in a file of values of one type."""
    file.seek(start * kind.itemsize)
    return np.frombuffer(file.read((end - start) * kind.itemsize), dtype=kind)


def _joined(
    starts: np.ndarray, counts: np.ndarray, parts: Sequence[int]
) -> Iterator[tuple[int, int]]:
    """Yield start and end of runs; adjacent runs of a part are joined, and long runs are split."""
    if not len(starts):
        return
    ends = starts + counts
    breaks = np.flatnonzero((starts[1:] != ends[:-1]) | np.isin(starts[1:], parts))
    firsts, lasts = np.r_[0, breaks + 1], np.r_[breaks, len(starts) - 1]
    for start, end in zip(starts[firsts].tolist(), ends[lasts].tolist()):
        for first in range(start, end, _MOST_READ):
            yield first, min(first + _MOST_READ, end)
