"""Points in memory, until their block is computed, and their values."""

from __future__ import annotations

from typing import Any, Callable, Iterator, NamedTuple

import numpy as np

from ..core.points import Box, Frame
from ..core.progress import SILENT, Progress
from ..core.threads import in_threads, over_parts, parts_of
from ..las.cloud import PointCloud
from .blocks import Blocks
from .store import (
    BlockPoints,
    Corner,
    LeafIndex,
    Leaves,
    Marks,
    Sorted,
    code_of,
    gathered,
    smallest_integers,
)

# Points that are sorted and read together.
_CHOSEN, _SORTED, _READ = 1 << 19, 1 << 16, 1 << 15


class _MarkedCloud(NamedTuple):
    """The points of a part with their flags."""

    cloud: PointCloud
    selected: np.ndarray
    known: np.ndarray | None
    wanted: np.ndarray | None
    roads: np.ndarray | None


class MemoryStore:
    """A `Store` whose points are those of clouds in memory; `kind` is the type of the values."""

    leaves: Leaves

    def __init__(self, frame: Frame, blocks: Blocks, kind: type = np.uint8) -> None:
        self._frame, self._blocks, self._value_kind = frame, blocks, kind
        self._parts: list[_MarkedCloud] = []
        self.has_known = False

    def append(self, part: PointCloud, marks: Marks) -> None:
        """Add the selected points of the next part."""
        known, wanted, roads = marks.known, marks.wanted, marks.roads
        # Without flags that are equal for all points.
        known = known if known is not None and known.any() else None
        wanted = wanted if wanted is not None and not wanted.all() else None
        roads = roads if roads is not None and roads.any() else None
        self._parts.append(_MarkedCloud(part, marks.selected, known, wanted, roads))
        self.has_known |= known is not None

    def finish(self, progress: Progress = SILENT) -> None:
        """Finish adding points."""
        counts = [part.cloud.count for part in self._parts]
        self._values: list[np.ndarray] = [np.zeros(n, dtype=self._value_kind) for n in counts]
        self._starts = np.concatenate(([0], np.cumsum(counts, dtype=np.int64)))
        self._kind = smallest_integers(self._starts[-1])
        # Selected points of each part. Indices of runs count through all parts.
        self._orders = [_indices(part, progress.part(0.0, 0.3)) for part in self._parts]
        self._ends = np.cumsum([len(order) for order in self._orders], dtype=np.int64)
        self._runs = LeafIndex()
        only, blocks = self._only_block(), self._blocks
        side = blocks.leaf_side if only is None else blocks.side
        self._start = blocks.start
        self._sort(side if only is None else None, progress.part(0.3, 1.0))
        row, column, totals = self._runs.finish()
        x, y = ((n + by) * side + blocks.start for n, by in zip((column, row), only or (0, 0)))
        self.leaves = Leaves(x, y, side, totals)

    def _only_block(self) -> tuple[float, float] | None:
        """Return column and row of the block if one holds all points, otherwise None."""
        blocks = self._blocks
        if not self._parts or self._ends[-1] > blocks.most_points:
            return None
        corners = np.array([part.cloud.bounds(self._frame) for part in self._parts]).reshape(-1, 2)
        numbers = blocks.number(corners)
        return tuple(numbers[0].tolist()) if (numbers == numbers[:1]).all() else None

    def _sort(self, side: float | None, progress: Progress) -> None:
        """Sort the points of each file by leaves; if `side` is None, all are in one leaf."""
        start = 0
        for number, order in enumerate(self._orders):
            if side is None:
                found = [(code_of(np.zeros(1), np.zeros(1)), np.array([len(order)]))]
            else:
                found = self._sorted(number, side, progress)
            for codes, counts in found:
                self._runs.add(codes, counts, start)
                start += int(counts.sum())

    def _sorted(
        self, number: int, side: float, progress: Progress
    ) -> list[tuple[np.ndarray, np.ndarray]]:
        """Sort the points of a file part by part, so that those of a leaf are later read nearly in
        file order, and return the leaves of each part with their counts.
        """
        cloud, order = self._parts[number].cloud, self._orders[number]
        found: list[Any] = [None] * len(parts_of(len(order), _SORTED))

        def sort(piece: slice) -> None:
            places = cloud.places(order[piece], self._frame)
            result = Sorted.of(*(np.floor((axis - self._start) / side) for axis in places[::-1]))
            order[piece] = order[piece][result.order]
            found[piece.start // _SORTED] = result.codes, result.counts

        over_parts(sort, len(order), _SORTED, progress)
        return found

    def read(
        self,
        leaves: np.ndarray,
        box: Box | None = None,
        corner: Corner = (0.0, 0.0),
        progress: Progress = SILENT,
        ground_only: bool = False,
    ) -> BlockPoints:
        """Return the points of some leaves, relative to a corner; only those in a box, if given."""
        pieces, frame = list(self._pieces(leaves, ground_only)), self._frame.moved(corner)

        def read(number: int) -> BlockPoints:
            return self._contents(*pieces[number], frame)

        return gathered([len(which) for _, which in pieces], read, box, self._kind, progress)

    def over_pieces(
        self,
        leaves: np.ndarray,
        work: Callable[[BlockPoints], Any],
        corner: Corner = (0.0, 0.0),
        progress: Progress = SILENT,
    ) -> list[Any]:
        """Return the results of a function of the points of some leaves, piece by piece."""
        frame = self._frame.moved(corner)
        pieces = list(self._pieces(leaves))
        return in_threads(lambda piece: work(self._contents(*piece, frame)), pieces, progress)

    def _pieces(
        self, leaves: np.ndarray, ground_only: bool = False
    ) -> Iterator[tuple[int, np.ndarray]]:
        """Yield the number of a file and the indices of some of its points."""
        starts, counts = self._runs.of(leaves)
        bounds = np.searchsorted(starts, np.concatenate(([0], self._ends)))
        for number, order in enumerate(self._orders):
            runs = slice(bounds[number], bounds[number + 1])
            firsts = starts[runs] - (self._ends[number] - len(order))
            spans = zip(firsts.tolist(), counts[runs].tolist())
            found = [order[first : first + n] for first, n in spans]
            which = found[0] if len(found) == 1 else np.concatenate([order[:0], *found])
            if ground_only:
                which = self._ground_of(number, which)
            for piece in parts_of(len(which), _READ):
                yield number, which[piece]

    def _ground_of(self, number: int, which: np.ndarray) -> np.ndarray:
        """Return those of some points of a file that are ground, or are where they lie on it."""
        part = self._parts[number]
        flags = [mask[which] for mask in (part.known, part.roads) if mask is not None]
        return which[np.logical_or.reduce(flags)] if flags else which[:0]

    def _contents(self, number: int, which: np.ndarray, frame: Frame) -> BlockPoints:
        part, start = self._parts[number], self._starts[number]
        known = np.zeros(len(which), bool) if part.known is None else part.known[which]
        wanted = np.ones(len(which), bool) if part.wanted is None else part.wanted[which]
        roads = np.zeros(len(which), bool) if part.roads is None else part.roads[which]
        positions = np.add(which, start, dtype=self._kind)
        several = part.cloud.number_of_returns[which] > 1
        points = part.cloud.points(which, frame)
        return BlockPoints(points, known, wanted, positions, roads, several)

    def put(self, positions: np.ndarray, values: np.ndarray) -> None:
        """Store the values of points."""
        for number, mine in enumerate(self._values):
            start, end = self._starts[number], self._starts[number + 1]
            if len(self._values) == 1:
                mine[positions] = values
                continue
            here = (positions >= start) & (positions < end)
            mine[positions[here] - start] = values[here]

    def values(self, number: int) -> np.ndarray:
        """Return the values of all points of a part."""
        return self._values[number]


def _indices(part: _MarkedCloud, progress: Progress) -> np.ndarray:
    """Return the indices of the selected points of a part, in the smallest integer type."""
    count = np.count_nonzero(part.selected)
    indices: np.ndarray = np.empty(count, dtype=smallest_integers(part.cloud.count))
    end = 0
    for some in parts_of(part.cloud.count, _CHOSEN):
        found = np.flatnonzero(part.selected[some])
        indices[end : end + len(found)] = found
        indices[end : end + len(found)] += some.start
        end += len(found)
        progress(some.stop / part.cloud.count)
    return indices
