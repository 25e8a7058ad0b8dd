"""Points in memory, until their block is computed."""

from __future__ import annotations

from typing import Iterator, NamedTuple, Sequence

import numpy as np

from ..core.points import Box, Frame
from ..core.progress import SILENT, Progress
from ..core.threads import over_parts, parts_of
from ..las.cloud import PointCloud
from .blocks import BlockPoints, Blocks, Corner, Leaves, gathered
from .leaf_index import LeafIndex, Sorted, code_of, smallest_integers

# Points that are sorted and read together.
_CHOSEN, _SORTED, _READ = 1 << 19, 1 << 16, 1 << 15


class SurveyFile(NamedTuple):
    """The points of one file, in file order.

    Attributes
    ----------
    cloud : PointCloud
        All points of the file.
    selected : numpy.ndarray of bool, shape (n,)
        Which take part.
    known : numpy.ndarray of bool, shape (n,), optional
        Which of them are known ground.
    wanted : numpy.ndarray of bool, shape (n,), optional
        Which of them are to be labelled. By default all are.
    roads : numpy.ndarray of bool, shape (n,), optional
        Which of them are ground where they lie on it.
    """

    cloud: PointCloud
    selected: np.ndarray
    known: np.ndarray | None = None
    wanted: np.ndarray | None = None
    roads: np.ndarray | None = None


class MemoryPoints:
    """The points of one or more files.

    Parameters
    ----------
    parts : sequence of SurveyFile
        The files.
    frame : Frame
        Frame of the survey.
    blocks : Blocks
        The blocks in which the points will be read.
    progress : Progress
        Receives progress.
    kind : type
        Type of the value that is stored for each point.

    Attributes
    ----------
    labels : list of numpy.ndarray, shape (n,)
        For each file the values of its points; 0 if none was stored. For `LabelGround` they are
        `GROUND`, `LOW`, `BRIDGE` or `HIGH`.
    leaves, has_known
        As `Store` says.
    """

    def __init__(
        self,
        parts: Sequence[SurveyFile],
        frame: Frame,
        blocks: Blocks,
        progress: Progress = SILENT,
        kind: type = np.uint8,
    ) -> None:
        self._parts, self._frame = [_as_needed(part) for part in parts], frame
        self.labels = [np.zeros(part.cloud.count, dtype=kind) for part in self._parts]
        self.has_known = any(part.known is not None for part in self._parts)
        counts = [part.cloud.count for part in self._parts]
        self._starts = np.concatenate(([0], np.cumsum(counts)))
        self._kind = smallest_integers(self._starts[-1])
        # Selected points of each file. Indices of runs count through all files.
        self._orders = [_indices(part, progress.part(0.0, 0.3)) for part in self._parts]
        self._ends = np.cumsum([len(order) for order in self._orders])
        self._runs = LeafIndex()
        only = self._only_block(blocks)
        side = blocks.leaf_side if only is None else blocks.side
        self._start = blocks.start
        self._sort(side if only is None else None, progress.part(0.3, 1.0))
        row, column, totals = self._runs.finish()
        x, y = ((n + by) * side + blocks.start for n, by in zip((column, row), only or (0, 0)))
        self.leaves = Leaves(x, y, side, totals)

    def _only_block(self, blocks: Blocks) -> tuple[float, float] | None:
        """Return column and row of the block if one holds all points, otherwise None."""
        if self._ends[-1] > blocks.most_points:
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
        """Sort the points of a file part by part. Return the leaves of each part with their counts.

        So the points of a leaf are later read nearly in file order.
        """
        cloud, order = self._parts[number].cloud, self._orders[number]
        found: list = [None] * len(parts_of(len(order), _SORTED))

        def sort(piece: slice) -> None:
            places = cloud.places(order[piece], self._frame)
            result = Sorted.of(*(np.floor((each - self._start) / side) for each in places[::-1]))
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
    ) -> BlockPoints:
        """Return the points of some leaves, relative to a corner; only those in a box, if given."""
        pieces, frame = list(self._pieces(leaves)), self._frame.moved(corner)

        def read(number: int) -> BlockPoints:
            return self._contents(*pieces[number], frame)

        return gathered([len(which) for _, which in pieces], read, box, self._kind, progress)

    def _pieces(self, leaves: np.ndarray) -> Iterator[tuple[int, np.ndarray]]:
        """Yield the number of a file and the indices of some of its points."""
        starts, counts = self._runs.of(leaves)
        bounds = np.searchsorted(starts, np.concatenate(([0], self._ends)))
        for number, order in enumerate(self._orders):
            runs = slice(bounds[number], bounds[number + 1])
            firsts = starts[runs] - (self._ends[number] - len(order))
            spans = zip(firsts.tolist(), counts[runs].tolist())
            found = [order[first : first + n] for first, n in spans]
            which = found[0] if len(found) == 1 else np.concatenate([order[:0], *found])
            for piece in parts_of(len(which), _READ):
                yield number, which[piece]

    def _contents(self, number: int, which: np.ndarray, frame: Frame) -> BlockPoints:
        part, start = self._parts[number], self._starts[number]
        known = np.zeros(len(which), bool) if part.known is None else part.known[which]
        wanted = np.ones(len(which), bool) if part.wanted is None else part.wanted[which]
        roads = np.zeros(len(which), bool) if part.roads is None else part.roads[which]
        positions = np.add(which, start, dtype=self._kind)
        several = part.cloud.number_of_returns[which] > 1
        points = part.cloud.points(which, frame)
        return BlockPoints(points, known, wanted, positions, roads, several)

    def put(self, positions: np.ndarray, labels: np.ndarray) -> None:
        """Store the labels of points."""
        for number, mine in enumerate(self.labels):
            start, end = self._starts[number], self._starts[number + 1]
            if len(self.labels) == 1:
                mine[positions] = labels
                continue
            here = (positions >= start) & (positions < end)
            mine[positions[here] - start] = labels[here]


def _as_needed(part: SurveyFile) -> SurveyFile:
    """Return a part without flags that are equal for all points."""
    known = part.known if part.known is not None and part.known.any() else None
    wanted = part.wanted if part.wanted is not None and not part.wanted.all() else None
    roads = part.roads if part.roads is not None and part.roads.any() else None
    return part._replace(known=known, wanted=wanted, roads=roads)


def _indices(part: SurveyFile, progress: Progress) -> np.ndarray:
    """Return the indices of the selected points of a part, in the smallest integer type."""
    count = np.count_nonzero(part.selected)
    indices, end = np.empty(count, dtype=smallest_integers(part.cloud.count)), 0
    for some in parts_of(part.cloud.count, _CHOSEN):
        found = np.flatnonzero(part.selected[some])
        indices[end : end + len(found)] = found
        indices[end : end + len(found)] += some.start
        end += len(found)
        progress(some.stop / part.cloud.count)
    return indices
