"""Points in memory that wait for their block."""

from __future__ import annotations

from typing import NamedTuple, Sequence

import numpy as np

from ..pointcloud.cloud import PointCloud
from ..points import Frame
from ..progress import SILENT, Progress
from .blocks import Blocks, Contents, Leaves

_CHUNK = 1 << 20
_SHIFT = 32


class Part(NamedTuple):
    """The points of one file, in its order.

    Attributes
    ----------
    cloud : PointCloud
        All points of the file.
    selected : numpy.ndarray of bool, shape (n,)
        Which take part.
    known : numpy.ndarray of bool, shape (n,), optional
        Which of them are surely ground.
    wanted : numpy.ndarray of bool, shape (n,), optional
        Which of them are to be labelled; all, if it is not given.
    """

    cloud: PointCloud
    selected: np.ndarray
    known: np.ndarray | None = None
    wanted: np.ndarray | None = None


class CloudStore:
    """The points of one or more files.

    Parameters
    ----------
    parts : sequence of Part
        The files.
    frame : Frame
        That of the survey.
    blocks : Blocks
        How it will be cut.
    progress : Progress
        Receives progress.

    Attributes
    ----------
    labels : list of numpy.ndarray of uint8, shape (n,)
        For each file `GROUND`, `LOW` (far below it) or 0 for each point.
    leaves, has_known
        As `Store` says.
    """

    def __init__(
        self, parts: Sequence[Part], frame: Frame, blocks: Blocks, progress: Progress = SILENT
    ) -> None:
        self._parts, self._frame = list(parts), frame
        self.labels = [np.zeros(part.cloud.count, dtype=np.uint8) for part in self._parts]
        self.has_known = any(part.known is not None and part.known.any() for part in self._parts)
        counts = [part.cloud.count for part in self._parts]
        self._starts = np.concatenate(([0], np.cumsum(counts)))
        if self._is_one_block(blocks):
            side = blocks.side
            orders = [np.flatnonzero(part.selected).astype(_kind(part)) for part in self._parts]
            self._runs = [([0], [len(order)]) for order in orders]
            self._orders, codes = orders, np.array([_code(np.zeros(1), np.zeros(1))[0]])
        else:
            side, codes = blocks.leaf_side, self._sort(blocks.leaf_side, progress)
        sizes = np.sum([np.subtract(ends, starts) for starts, ends in self._runs], axis=0)
        x, y = (codes & ((1 << _SHIFT) - 1)) - 1, (codes >> _SHIFT) - 1
        self.leaves = Leaves(x * side, y * side, side, sizes)

    def _is_one_block(self, blocks: Blocks) -> bool:
        count = sum(int(np.count_nonzero(part.selected)) for part in self._parts)
        if count > blocks.most_points:
            return False
        bounds = np.array([part.cloud.bounds(self._frame) for part in self._parts])
        return bool(bounds.min() >= 0.0 and bounds.max() < blocks.side)

    def _sort(self, side: float, progress: Progress) -> np.ndarray:
        """Sort the points of each file by leaves; return the codes of all leaves."""
        numbers: dict[int, int] = {}
        leaf_of = []
        for part in self._parts:
            leaf = np.empty(int(np.count_nonzero(part.selected)), dtype=np.int32)
            end = 0
            for first in range(0, part.cloud.count, _CHUNK):
                which = first + np.flatnonzero(part.selected[first : first + _CHUNK])
                points = part.cloud.points(which, self._frame)
                codes, inverse = np.unique(
                    _code(np.floor(points.y / side), np.floor(points.x / side)),
                    return_inverse=True,
                )
                of_codes = [numbers.setdefault(each, len(numbers)) for each in codes.tolist()]
                leaf[end : end + len(which)] = np.array(of_codes, np.int32)[inverse.ravel()]
                end += len(which)
                progress(end / max(len(leaf), 1))
            leaf_of.append(leaf)
        self._orders, self._runs = [], []
        every = np.arange(len(numbers))
        for part, leaf in zip(self._parts, leaf_of):
            # So few that they fit into 16 bits are sorted much faster.
            leaf = leaf.astype(np.uint16) if len(numbers) <= 1 << 16 else leaf
            order = np.argsort(leaf, kind="stable").astype(_kind(part))
            leaf = leaf[order]
            runs = [np.searchsorted(leaf, every, side) for side in ("left", "right")]
            self._runs.append(tuple(runs))
            self._orders.append(np.flatnonzero(part.selected).astype(order.dtype)[order])
        return np.array(list(numbers), dtype=np.int64)

    def read(self, leaves: np.ndarray) -> Contents:
        """Return the points of some leaves."""
        found = []
        for number, part in enumerate(self._parts):
            starts, ends = self._runs[number]
            order = self._orders[number]
            runs = [order[starts[leaf] : ends[leaf]] for leaf in leaves]
            which = runs[0] if len(runs) == 1 else np.concatenate([order[:0], *runs])
            known = np.zeros(len(which), bool) if part.known is None else part.known[which]
            wanted = np.ones(len(which), bool) if part.wanted is None else part.wanted[which]
            start = self._starts[number]
            positions = which if start == 0 else which + start
            found.append(Contents(part.cloud.points(which, self._frame), known, wanted, positions))
        return Contents.joined(found)

    def put(self, positions: np.ndarray, labels: np.ndarray) -> None:
        """Keep the labels of points."""
        for number, mine in enumerate(self.labels):
            start, end = self._starts[number], self._starts[number + 1]
            if len(self.labels) == 1:
                mine[positions] = labels
                continue
            here = (positions >= start) & (positions < end)
            mine[positions[here] - start] = labels[here]


def _kind(part: Part) -> type:
    """Return the smallest type that holds the index of every point."""
    return np.int32 if part.cloud.count < 1 << 31 else np.int64


def _code(row: np.ndarray, column: np.ndarray) -> np.ndarray:
    """Return one number for row and column, neither below -1."""
    return (row.astype(np.int64) + 1 << _SHIFT) + column.astype(np.int64) + 1
