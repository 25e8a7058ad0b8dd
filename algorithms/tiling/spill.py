"""Points on disk that wait for their block."""

from __future__ import annotations

import contextlib
import dataclasses
import tempfile
import threading
from pathlib import Path
from typing import BinaryIO, Iterator

import numpy as np

from ..files import describe_write_error
from ..pointcloud.cloud import PointCloud
from ..points import Frame
from .blocks import Contents, Leaves

_RECORD = np.dtype([("x", "<i4"), ("y", "<i4"), ("z", "<i4"), ("flags", "u1")])
_KNOWN, _WANTED = 1, 2
# Rows and columns of leaves as one number: half of those that fit are below 0.
_SHIFT, _HALF = 32, 1 << 30
# Metres by which a leaf is taken to be larger than it is: its corners are rounded.
_MARGIN = 1e-3
# Points between two that are labelled, up to which one access to the file is cheaper than two.
_GAP = 1 << 16


class Spill:
    """The points that take part, in temporary files without a name.

    They are gone as soon as they are closed, or the process ends, however that may be.

    Parameters
    ----------
    target : Path
        The output, in whose folder the files are.
    leaf_side : float
        Metres; the points are sorted by squares of this side, part by part.

    Attributes
    ----------
    count : int
        Points so far.
    cloud : PointCloud
        The file without its points.
    leaves, has_known
        As `Store` says; `leaves` after `finish` only.
    """

    def __init__(self, target: Path, leaf_side: float) -> None:
        self.count, self.has_known, self.leaves = 0, False, None
        self._target, self._side = Path(target), leaf_side
        self._lock, self._files = threading.Lock(), contextlib.ExitStack()
        with self._told():
            self._records, self._labels = self._file(), self._file()
        self.cloud: PointCloud | None = None
        self._frame: Frame | None = None
        self._first = np.zeros(2, dtype=np.int64)
        self._numbers: dict[int, int] = {}
        self._extents: list[np.ndarray] = []

    def _file(self) -> BinaryIO:
        return self._files.enter_context(tempfile.TemporaryFile(dir=self._target.parent))

    def __enter__(self) -> Spill:
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
        codes, order = self._sorted(part, selected)
        which = np.flatnonzero(selected)[order]
        records = np.empty(len(which), dtype=_RECORD)
        for name in ("x", "y", "z"):
            records[name] = getattr(part, name)[which]
        records["flags"] = _KNOWN * known[which] + _WANTED * wanted[which]
        self.has_known |= bool(known[which].any())
        with self._told():
            self._records.write(records.tobytes())
        codes, counts = codes
        numbers = [self._numbers.setdefault(each, len(self._numbers)) for each in codes.tolist()]
        starts = self.count + np.cumsum(counts) - counts
        self._extents.append(np.column_stack((numbers, starts, counts)).astype(np.int64))
        self.count += len(which)

    def _sorted(
        self, part: PointCloud, selected: np.ndarray
    ) -> tuple[tuple[np.ndarray, np.ndarray], np.ndarray]:
        """Return the leaves of selected points with their counts, and the order by leaves."""
        x, y = (
            np.floor((values[selected] - first) * (scale * part.crs.horizontal_unit / self._side))
            for values, first, scale in zip((part.x, part.y), self._first, part.scale)
        )
        code = (y.astype(np.int64) + _HALF << _SHIFT) + x.astype(np.int64) + _HALF
        codes, inverse, counts = np.unique(code, return_inverse=True, return_counts=True)
        return (codes, counts), np.argsort(inverse.ravel(), kind="stable")

    def finish(self, lowest: tuple[int, int]) -> Frame:
        """End the points; return the frame, whose origin is the smallest x and y of the file.

        Parameters
        ----------
        lowest : tuple of int
            These as integers.
        """
        cloud = self.cloud
        corner = {name: np.array([value]) for name, value in zip("xyz", (*lowest, 0))}
        self._frame = dataclasses.replace(cloud, **corner).frame
        extents = np.concatenate(self._extents)
        self._extents = []
        # Of each leaf, in the order of the file.
        extents = extents[np.argsort(extents[:, 0], kind="stable")]
        every = np.arange(len(self._numbers))
        self._bounds = np.searchsorted(extents[:, 0], [every, every + 1])
        self._starts, self._counts = extents[:, 1].copy(), extents[:, 2].copy()
        codes = np.array(list(self._numbers), dtype=np.int64)
        columns, rows = (codes & ((1 << _SHIFT) - 1)) - _HALF, (codes >> _SHIFT) - _HALF
        x, y = (
            number * self._side + (first - low) * scale * cloud.crs.horizontal_unit - _MARGIN
            for number, first, low, scale in zip((columns, rows), self._first, lowest, cloud.scale)
        )
        totals = np.add.reduceat(self._counts, self._bounds[0])
        self.leaves = Leaves(x, y, self._side + 2.0 * _MARGIN, totals)
        with self._told():
            self._records.flush()
            self._labels.truncate(self.count)
        return self._frame

    def read(self, leaves: np.ndarray) -> Contents:
        """Return the points of some leaves, in the order of the file."""
        runs = [np.arange(*self._bounds[:, leaf]) for leaf in leaves]
        runs = np.sort(np.concatenate([np.zeros(0, np.intp), *runs]))
        runs = runs[np.argsort(self._starts[runs], kind="stable")]
        starts, counts = self._starts[runs], self._counts[runs]
        records = np.empty(int(counts.sum()), dtype=_RECORD)
        positions = np.empty(len(records), dtype=np.int64)
        at = 0
        for start, end in _joined(starts, counts):
            part = slice(at, at + end - start)
            records[part] = self._read(start, end)
            positions[part] = np.arange(start, end)
            at = part.stop
        columns = {name: records[name] for name in "xyz"}
        points = dataclasses.replace(self.cloud, **columns).points(slice(None), self._frame)
        flags = records["flags"]
        return Contents(points, flags & _KNOWN > 0, flags & _WANTED > 0, positions)

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
            held = np.frombuffer(self._labels_at(first, last), dtype=np.uint8).copy()
            held[where - first] = values
            with self._told():
                self._labels.seek(first)
                self._labels.write(held.tobytes())

    def _labels_at(self, first: int, last: int) -> bytes:
        self._labels.seek(first)
        return self._labels.read(last - first)

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
        numpy.ndarray of uint8, shape (n,)
            0 for those that are not selected.
        """
        _, order = self._sorted(part, selected)
        labels = np.zeros(part.count, dtype=np.uint8)
        held = self._labels_at(start, start + len(order))
        labels[np.flatnonzero(selected)[order]] = np.frombuffer(held, dtype=np.uint8)
        return labels


def _joined(starts: np.ndarray, counts: np.ndarray) -> Iterator[tuple[int, int]]:
    """Yield start and end of runs that follow one another as one."""
    if not len(starts):
        return
    ends = starts + counts
    breaks = np.flatnonzero(starts[1:] != ends[:-1])
    firsts, lasts = np.r_[0, breaks + 1], np.r_[breaks, len(starts) - 1]
    yield from zip(starts[firsts].tolist(), ends[lasts].tolist())
