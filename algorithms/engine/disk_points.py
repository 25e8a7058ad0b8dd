"""Points on disk that wait for their block."""

from __future__ import annotations

import contextlib
import dataclasses
import tempfile
import threading
from pathlib import Path
from typing import BinaryIO, Iterator

import numpy as np

from ..core.files import describe_write_error
from ..core.points import Frame
from ..las.cloud import PointCloud, survey_frame
from .blocks import BlockPoints, Box, Corner, Leaves, gathered
from .leaf_index import LeafIndex, Sorted

_RECORD = np.dtype([("x", "<i4"), ("y", "<i4"), ("z", "<i4"), ("flags", "u1")])
_KNOWN, _WANTED = 1, 2
# Metres by which a leaf is taken to be larger than it is: its corners are rounded.
_MARGIN = 1e-3
# Points between two that are labelled, up to which one access to the file is cheaper than two.
_GAP = 1 << 16
# Points that are read at a time.
_MOST_READ = 1 << 15


class DiskPoints:
    """The points that take part, in temporary files without a name.

    They are gone as soon as they are closed, or the process ends, however that may be.

    Parameters
    ----------
    target : Path
        The output, in whose folder the files are.
    leaf_side : float
        Metres; the points are sorted by squares of this side, part by part.
    kind : type
        Of what is kept of each point.

    Attributes
    ----------
    count : int
        Points so far.
    cloud : PointCloud
        The file without its points.
    leaves, has_known
        As `Store` says; `leaves` after `finish` only.
    """

    def __init__(self, target: Path, leaf_side: float, kind: type = np.uint8) -> None:
        self._kind = np.dtype(kind)
        self.count, self.has_known, self.leaves = 0, False, None
        self._target, self._side = Path(target), leaf_side
        self._lock, self._files = threading.Lock(), contextlib.ExitStack()
        with self._told():
            self._records, self._labels = self._file(), self._file()
        self.cloud: PointCloud | None = None
        self._frame = Frame()
        self._first = np.zeros(2, dtype=np.int64)
        self._runs = LeafIndex()

    def _file(self) -> BinaryIO:
        return self._files.enter_context(tempfile.TemporaryFile(dir=self._target.parent))

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
        self, part: PointCloud, selected: np.ndarray, known: np.ndarray, wanted: np.ndarray
    ) -> None:
        """Add the selected points of the next part of a file.

        Parameters
        ----------
        part : PointCloud
            Points in file order.
        selected, known, wanted : numpy.ndarray of bool, shape (n,)
            Which take part, which are surely ground, and which are to be labelled.
        """
        if self.cloud is None:
            self._first = np.array([part.x[0], part.y[0]], dtype=np.int64)
            names = ("x", "y", "z", "classification", "return_number", "number_of_returns")
            nothing = {name: getattr(part, name)[:0] for name in (*names, "withheld")}
            self.cloud = dataclasses.replace(part, **nothing)
            self._frame = survey_frame(part.crs)
        found = self._sorted(part, selected)
        which = np.flatnonzero(selected)[found.order]
        records = np.empty(len(which), dtype=_RECORD)
        for name in ("x", "y", "z"):
            records[name] = getattr(part, name)[which]
        records["flags"] = _KNOWN * known[which] + _WANTED * wanted[which]
        self.has_known |= bool(known[which].any())
        with self._told():
            self._records.write(records.tobytes())
        self._runs.add(found.codes, found.counts, self.count)
        self.count += len(which)

    def _sorted(self, part: PointCloud, selected: np.ndarray) -> Sorted:
        """Return the selected points sorted by leaves."""
        x, y = (
            np.floor((values[selected] - first) * (scale * part.crs.horizontal_unit / self._side))
            for values, first, scale in zip((part.x, part.y), self._first, part.scale)
        )
        return Sorted.of(y, x)

    def finish(self, lowest: tuple[int, int]) -> Frame:
        """End the points; return the frame of the cloud itself, as `PointCloud.frame`.

        Parameters
        ----------
        lowest : tuple of int
            The smallest x and y of the file, as integers.
        """
        cloud = self.cloud
        corner = {name: np.array([value]) for name, value in zip("xyz", (*lowest, 0))}
        rows, columns, totals = self._runs.finish()
        x, y = (
            number * self._side + (first * scale + offset) * cloud.crs.horizontal_unit - _MARGIN
            for number, first, scale, offset in zip(
                (columns, rows), self._first, cloud.scale, cloud.offset
            )
        )
        self.leaves = Leaves(x, y, self._side + 2.0 * _MARGIN, totals)
        with self._told():
            self._records.flush()
            self._labels.truncate(self.count * self._kind.itemsize)
        return dataclasses.replace(cloud, **corner).frame

    def read(
        self, leaves: np.ndarray, box: Box | None = None, corner: Corner = (0.0, 0.0)
    ) -> BlockPoints:
        """Return the points of some leaves, in the order of the file, or those of them in a box."""
        runs, frame = list(_joined(*self._runs.of(leaves))), self._frame.moved(corner)

        def read(number: int) -> BlockPoints:
            start, end = runs[number]
            records = self._read(start, end)
            columns = {name: records[name] for name in "xyz"}
            points = dataclasses.replace(self.cloud, **columns).points(slice(None), frame)
            flags = records["flags"]
            positions = np.arange(start, end)
            return BlockPoints(points, flags & _KNOWN > 0, flags & _WANTED > 0, positions)

        return gathered([end - start for start, end in runs], read, box)

    def _read(self, start: int, end: int) -> np.ndarray:
        with self._lock:
            self._records.seek(start * _RECORD.itemsize)
            data = self._records.read((end - start) * _RECORD.itemsize)
        return np.frombuffer(data, dtype=_RECORD)

    def put(self, positions: np.ndarray, labels: np.ndarray) -> None:
        """Keep the labels of points; their positions ascend."""
        if not len(positions):
            return
        cuts = np.flatnonzero(np.diff(positions) > _GAP) + 1
        for where, values in zip(np.split(positions, cuts), np.split(labels, cuts)):
            first, last = int(where[0]), int(where[-1]) + 1
            held = self._labels_at(first, last).copy()
            held[where - first] = values
            with self._told():
                self._labels.seek(first * self._kind.itemsize)
                self._labels.write(held.tobytes())

    def _labels_at(self, first: int, last: int) -> np.ndarray:
        self._labels.seek(first * self._kind.itemsize)
        data = self._labels.read((last - first) * self._kind.itemsize)
        return np.frombuffer(data, dtype=self._kind)

    def labels_of(self, part: PointCloud, selected: np.ndarray, start: int) -> np.ndarray:
        """Return the labels of the points of a part, as it was appended.

        Parameters
        ----------
        part, selected
            As for `append`.
        start : int
            Points that were appended before it.

        Returns
        -------
        numpy.ndarray, shape (n,)
            0 for those that are not selected.
        """
        order = self._sorted(part, selected).order
        labels = np.zeros(part.count, dtype=self._kind)
        labels[np.flatnonzero(selected)[order]] = self._labels_at(start, start + len(order))
        return labels


def _joined(starts: np.ndarray, counts: np.ndarray) -> Iterator[tuple[int, int]]:
    """Yield start and end of runs, such as follow one another as one, and none too long."""
    if not len(starts):
        return
    ends = starts + counts
    breaks = np.flatnonzero(starts[1:] != ends[:-1])
    firsts, lasts = np.r_[0, breaks + 1], np.r_[breaks, len(starts) - 1]
    for start, end in zip(starts[firsts].tolist(), ends[lasts].tolist()):
        for first in range(start, end, _MOST_READ):
            yield first, min(first + _MOST_READ, end)
