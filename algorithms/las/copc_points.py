"""Points for the octree of COPC that do not fit into memory, in a temporary file.

They are written in parts. Each part is sorted as in `SortedPoints`, and each record is preceded by
its index in the part. So the points of a node, or of a branch below, are a few runs of each part,
and are put back into file order when they are read.
"""

from __future__ import annotations

import contextlib
import functools
from pathlib import Path
from typing import BinaryIO, Iterable, Iterator

import numpy as np

from ..core.progress import Progress
from ..core.unnamed import reach_disk, unnamed_file
from .copc_octree import Branch, Cube, SortedPoints, TakenCells, runs
from .records import column

# Most points that are sorted and written at a time.
_MOST_AT_ONCE = 500_000
# Bytes of the index before each record.
_NUMBER = 4


class Steady(Progress):
    """Reports the progress of the whole, also during parts whose own progress is unknown."""

    def __init__(self, whole: Progress) -> None:
        self._whole, self._start, self._end = whole, 0.0, 0.0

    def move(self, start: float, end: float | None = None) -> None:
        """Report the progress of the whole; until the next call it can rise to `end`."""
        self._start, self._end = start, start if end is None else end
        self._whole(start)

    def report(self, fraction: float) -> None:
        """Report the same progress again, which raises `Cancelled` after a cancel."""
        self._whole(self._start + fraction * (self._end - self._start))


class Room:
    """The largest number of points that may be in memory, and a temporary file for other points,
    which is removed when the block or the process ends.
    """

    cube: Cube  # of the octree, once it is known

    def __init__(self, folder: Path, most: int, progress: Progress) -> None:
        self._folder, self._files = folder, contextlib.ExitStack()
        self.most, self.progress = most, Steady(progress)
        self.most_at_once = min(most, _MOST_AT_ONCE)

    def __enter__(self) -> Room:
        return self

    def __exit__(self, *exception: object) -> None:
        self._files.close()

    @functools.cached_property
    def file(self) -> BinaryIO:
        """The file, made at its first use."""
        return self._files.enter_context(unnamed_file(self._folder))

    def clear(self, cube: Cube) -> None:
        """Discard all points, since the next points are for another cube."""
        self.file.truncate(0)
        self.cube = cube


class WaitingPoints:
    """The points of a branch in a temporary file, to which records, uint8 (k, record length), are
    added part by part in file order.
    """

    def __init__(self, branch: Branch, parts: Iterable[np.ndarray], room: Room) -> None:
        self.branch, self._room = branch, room
        shape = branch.depths + 1, branch.cell_count
        self.counts = np.zeros(shape, dtype=np.int64)
        # Position of each part in the file, and its counts.
        self._parts: list[tuple[int, np.ndarray]] = []
        taken_cells = [TakenCells(depth) for depth in range(branch.depths)]
        for records in parts:
            points = SortedPoints.of(branch, records, room.cube, taken_cells, room.progress)
            rows = np.empty((len(records), _NUMBER + records.shape[1]), dtype=np.uint8)
            column(rows, 0, "<u4")[:] = points.order
            rows[:, _NUMBER:] = records[points.order]
            self._parts.append((room.file.seek(0, 2), points.counts.astype(np.uint32)))
            room.file.write(rows.data)
            reach_disk(room.file)
            self.counts += points.counts
            self._width = rows.shape[1]

    def records(self, groups: np.ndarray) -> np.ndarray:
        """Return the points of some depths and branches in file order."""
        records = np.empty((self.counts[groups].sum(), self._width - _NUMBER), dtype=np.uint8)
        start = 0
        for points in self._read(groups):
            records[start : start + len(points)] = points
            start += len(points)
        return records

    def _read(self, groups: np.ndarray) -> Iterator[np.ndarray]:
        file, width = self._room.file, self._width
        for begin, counts in self._parts:
            rows, done = np.empty((counts[groups].sum(), width), dtype=np.uint8), 0
            if not len(rows):
                continue
            for start, end in runs(counts, groups).tolist():
                file.seek(begin + start * width)
                data = file.read((end - start) * width)
                rows[done : done + end - start] = np.frombuffer(data, np.uint8).reshape(-1, width)
                done += end - start
            yield rows[np.argsort(column(rows, 0, "<u4")), _NUMBER:]
            self._room.progress(0.0)

    def below(self, cell: int) -> SortedPoints | WaitingPoints:
        """Return the points that are left for a branch below, in memory if they fit."""
        groups, branch = np.zeros(self.counts.shape, dtype=bool), self.branch.below(cell)
        groups[-1, cell] = True
        if self.counts[-1, cell] > self._room.most:
            return WaitingPoints(branch, self._joined(groups), self._room)
        room = self._room
        return SortedPoints.of(branch, self.records(groups), room.cube, progress=room.progress)

    def _joined(self, groups: np.ndarray) -> Iterator[np.ndarray]:
        """Yield points in file order; small parts are joined."""
        waiting: list[np.ndarray] = []
        count = 0
        for part in self._read(groups):
            if count + len(part) > self._room.most_at_once:
                yield np.concatenate(waiting)
                waiting, count = [], 0
            waiting.append(part)
            count += len(part)
        yield np.concatenate(waiting)
