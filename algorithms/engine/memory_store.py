"""Points in memory, until their block is computed, and their values."""

from __future__ import annotations

from typing import Callable

import numpy as np

from ..core.points import Frame
from ..core.progress import SILENT, Progress
from ..core.threads import in_threads, parts_of
from ..las.cloud import PointCloud
from .blocks import Blocks
from .store import OTHERS, BlockPoints, Corner, LeafIndex, Marks, Store, code_of, smallest_integers

# Points whose flags are read between two calls of the progress.
_CHOSEN = 1 << 19
# Points that are sorted by leaves at a time; their arrays stay in the processor's cache.
_SORTED = 1 << 16
# Points of a piece that is read, for the same reason.
_READ = 1 << 15


class MemoryStore(Store):
    """A store that refers to the points of clouds in memory; `kind` is the type of the values."""

    def __init__(self, frame: Frame, blocks: Blocks, kind: type = np.uint8) -> None:
        super().__init__(frame, kind)
        self._blocks = blocks
        # The clouds, with None for flags that are equal for all of their points.
        self._parts: list[tuple[PointCloud, Marks]] = []

    def append(self, part: PointCloud, marks: Marks) -> None:
        super().append(part, marks)
        selected, known, wanted, flags = marks
        known = known if known is not None and known.any() else None
        wanted = wanted if wanted is not None and not wanted.all() else None
        not_empty = {
            name: flag
            for name, flag in flags.items()
            if not isinstance(flag, np.ndarray) or flag.any()
        }
        self._parts.append((part, Marks(selected, known, wanted, not_empty)))
        self.has_known |= known is not None

    def finish(self, progress: Progress = SILENT) -> None:
        self._values = np.zeros(self.count, dtype=self._value_kind)
        choosing = progress.part(0.0, 0.3).shares(*[1.0] * len(self._parts))
        # The indices of the selected points of each part, sorted by leaves. Positions in the leaf
        # index are counted through all parts.
        self._orders = [
            _indices(cloud, marks.selected, share)
            for (cloud, marks), share in zip(self._parts, choosing)
        ]
        self._ends = np.cumsum([len(order) for order in self._orders], dtype=np.int64)
        # A single block is a single leaf.
        only, blocks = self._only_block(), self._blocks
        self._runs = LeafIndex(blocks.leaf_side if only is None else blocks.side, blocks.start)
        if only is None:
            # Piece by piece, so that the points of a leaf are later read nearly in file order.
            pieces = [
                (number, piece)
                for number, order in enumerate(self._orders)
                for piece in parts_of(len(order), _SORTED)
            ]
            in_threads(lambda piece: self._sort(*piece), pieces, progress.part(0.3, 1.0))
        else:
            for end, order in zip(self._ends, self._orders):
                self._runs.add(code_of(*only[::-1]), end - len(order), len(order))
        self.leaves = self._runs.finish()

    def _only_block(self) -> np.ndarray | None:
        """Return column and row of the block that holds all points; None if there are several."""
        if not self._parts or not 0 < self._ends[-1] <= self._blocks.most_points:
            return None
        corners = np.array([cloud.bounds(self.frame) for cloud, _ in self._parts]).reshape(-1, 2)
        numbers = self._blocks.number(corners)
        return numbers[0] if (numbers == numbers[:1]).all() else None

    def _sort(self, number: int, piece: slice) -> None:
        """Sort some of the selected points of a part by leaves."""
        order = self._orders[number]
        places = self._parts[number][0].places(order[piece], self.frame)
        first = int(self._ends[number]) - len(order) + piece.start
        order[piece] = order[piece][self._runs.sort(places, first)]

    def pieces(
        self, leaves: np.ndarray, corner: Corner, only: str | None = None
    ) -> tuple[list[int], Callable[[int], BlockPoints]]:
        """Return the numbers of points of pieces of some leaves, and what reads a piece."""
        starts, counts = self._runs.of(leaves)
        bounds = np.searchsorted(starts, np.concatenate(([0], self._ends)))
        pieces: list[tuple[int, np.ndarray]] = []
        for number, order in enumerate(self._orders):
            runs = slice(bounds[number], bounds[number + 1])
            firsts = starts[runs] - (self._ends[number] - len(order))
            spans = zip(firsts.tolist(), counts[runs].tolist())
            found = [order[first : first + n] for first, n in spans]
            indices = found[0] if len(found) == 1 else np.concatenate([order[:0], *found])
            if only is not None:
                indices = self._chosen(number, indices, only)
            pieces += [(number, indices[piece]) for piece in parts_of(len(indices), _READ)]
        frame = self.frame.moved(corner)
        return (
            [len(indices) for _, indices in pieces],
            lambda number: self._contents(*pieces[number], frame),
        )

    def _chosen(self, number: int, indices: np.ndarray, only: str) -> np.ndarray:
        """Return the points of a part, among some, that `only` asks for; see `Store.read`."""
        _, marks = self._parts[number]
        if only == OTHERS:
            return indices if marks.known is None else indices[~marks.known[indices]]
        masks = marks.known, marks.flags.get(only)
        flags = [mask[indices] for mask in masks if mask is not None]
        return indices[np.logical_or.reduce(flags)] if flags else indices[:0]

    def _contents(self, number: int, indices: np.ndarray, frame: Frame) -> BlockPoints:
        (cloud, marks), count = self._parts[number], len(indices)
        known = np.zeros(count, bool) if marks.known is None else marks.known[indices]
        wanted = np.ones(count, bool) if marks.wanted is None else marks.wanted[indices]
        flags = {
            name: marks.flags[name][indices] if name in marks.flags else np.zeros(count, bool)
            for name in self.flags
        }
        positions = np.add(indices, self.starts[number], dtype=smallest_integers(self.count))
        points = cloud.points(indices, frame)
        return BlockPoints(points, known, wanted, positions, flags)

    def put(self, positions: np.ndarray, values: np.ndarray) -> None:
        self._values[positions] = values

    def values(self, number: int) -> np.ndarray:
        start = self.starts[number]
        return self._values[start : start + self._parts[number][0].count]


def _indices(cloud: PointCloud, selected: np.ndarray, progress: Progress) -> np.ndarray:
    """Return the indices of the selected points of a part, in the smallest integer type."""
    count = np.count_nonzero(selected)
    indices: np.ndarray = np.empty(count, dtype=smallest_integers(cloud.count))
    end = 0
    for part in parts_of(cloud.count, _CHOSEN):
        found = np.flatnonzero(selected[part])
        indices[end : end + len(found)] = found
        indices[end : end + len(found)] += part.start
        end += len(found)
        progress(part.stop / cloud.count)
    return indices
