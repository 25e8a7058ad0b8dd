"""The octree of COPC: finds the node of each point.

Each node has a grid. In each cell it takes the first point in file order that no node above it has
taken, and leaves all other points to its eight children. Each cell lies within one child. So the
points of several depths can be found before it is known which nodes exist. Only the counts decide
that, see `nodes_of`.

References
----------
COPC specification 1.0, https://copc.io
"""

from __future__ import annotations

from typing import Iterator, NamedTuple, Protocol, Sequence

import numpy as np

from ..core.progress import SILENT, Progress
from ..core.threads import parts_of
from .records import column

# The grid of a node has 2 to the power of this cells along each side.
_GRID_BITS = 7
# Most points that a node takes together with all points that would be below it.
_LEAF_POINTS = 100_000
# If fewer points are left for a node, they stay with the node above.
_SMALL_NODE = 500
# The cube has 2 to the power of this cells along each side: the bits of all three fit into 64.
_CUBE_BITS = 21
_DEEPEST = _CUBE_BITS - _GRID_BITS
# Number of depths for which points are taken at a time. With more than `_GRID_BITS`, the cells of
# the first depth would be larger than the nodes below the last.
_DEPTHS = 3
# Points whose codes are computed at a time.
_CODED = 1_000_000
# Bytes for sorting a point, beside its record.
_BYTES_TO_SORT = 60


class Cube(NamedTuple):
    """The cube of the topmost node."""

    corner: tuple[float, float, float]  # the smallest x, y and z
    side: float
    scale: tuple[float, float, float]  # of the integers of the points
    offset: tuple[float, float, float]  # of the integers of the points

    @property
    def spacing(self) -> float:
        """Distance between the points of the topmost node."""
        return self.side / (1 << _GRID_BITS)

    def codes(self, records: np.ndarray, progress: Progress = SILENT) -> np.ndarray:
        """Return the Morton codes of points, uint64 (n,), given their records, uint8 (n, record
        length).
        """
        # When sorted by them, the points of each cell of each depth are consecutive.
        codes = np.zeros(len(records), dtype=np.uint64)
        for piece in parts_of(len(records), _CODED):
            for axis in range(3):
                cells = column(records[piece], 4 * axis, "<i4") * self.scale[axis]
                cells += self.offset[axis] - self.corner[axis]
                cells *= (1 << _CUBE_BITS) / self.side
                np.clip(cells, 0, (1 << _CUBE_BITS) - 1, out=cells)
                codes[piece] |= _spread(cells.astype(np.uint64)) << np.uint64(axis)
            progress(piece.stop / len(records))
        return codes


class Branch(NamedTuple):
    """A node with all nodes below it, by its depth and its number among the nodes of this depth."""

    depth: int
    number: int

    @property
    def depths(self) -> int:
        """Number of depths for which its points are taken at a time."""
        return min(_DEPTHS, _DEEPEST - self.depth)

    @property
    def cell_count(self) -> int:
        """Number of branches below the last of these depths."""
        return 1 << 3 * self.depths

    def below(self, cell: int) -> Branch:
        """Return one of these branches."""
        return Branch(self.depth + self.depths, self.number * self.cell_count + cell)


TOP = Branch(0, 0)


class BranchPoints(Protocol):
    """The points of a branch, in memory or on disk."""

    branch: Branch
    # int64 (depths + 1, cells): points that each depth takes in each branch below, if no node above
    # ends the branch; the last row counts the points that no depth takes.
    counts: np.ndarray

    def records(self, groups: np.ndarray) -> np.ndarray:
        """Return the points of some depths and branches, as in `counts`, in file order."""

    def below(self, cell: int) -> BranchPoints:
        """Return the points that are left for a branch below."""


def nodes_of(
    points: BranchPoints, depth: int = 0, cell: int = 0
) -> Iterator[tuple[Branch, np.ndarray]]:
    """Yield the nodes of a branch with their points, from one of its cells downwards; a node comes
    before the nodes below it.
    """
    branch = points.branch
    width = 3 * (branch.depths - depth)
    cells = slice(cell << width, (cell + 1) << width)
    counts, groups = points.counts[depth:, cells], np.zeros(points.counts.shape, dtype=bool)
    node = Branch(branch.depth + depth, (branch.number << 3 * depth) + cell)
    if counts.sum() <= _LEAF_POINTS or node.depth == _DEEPEST:
        groups[depth:, cells] = True
        yield node, points.records(groups)
    elif depth == branch.depths:
        yield from nodes_of(points.below(cell))
    else:
        remaining = counts[1:].sum(axis=0).reshape(8, -1).sum(axis=1)
        groups[depth, cells] = True
        groups[depth + 1 :, cells] = np.repeat(remaining < _SMALL_NODE, counts.shape[1] // 8)
        yield node, points.records(groups)
        for child in np.flatnonzero(remaining >= _SMALL_NODE).tolist():
            yield from nodes_of(points, depth + 1, 8 * cell + child)


class SortedPoints:
    """The points of a branch in memory, sorted by the depths that take them, and by the branches
    below.
    """

    def __init__(
        self,
        branch: Branch,
        records: np.ndarray,  # uint8 (n, record length), in file order, also of others
        codes: np.ndarray,  # uint64 (k,), of the points of the branch, ascending
        order: np.ndarray,  # unsigned integers (k,), their rows in `records`
        taken_cells: Sequence[TakenCells] = (),  # cells of each depth that earlier points took
        progress: Progress = SILENT,
    ) -> None:
        self.branch, self._records = branch, records
        finest = np.uint64(3 * (_CUBE_BITS - branch.depth - branch.depths))
        cells = (codes >> finest & np.uint64(branch.cell_count - 1)).astype(np.uint16)
        cells += np.uint16(branch.cell_count) * _depths(branch, codes, order, taken_cells, progress)
        self.counts = np.bincount(cells, minlength=(branch.depths + 1) * branch.cell_count)
        self.counts = self.counts.reshape(-1, branch.cell_count)
        by_group = np.argsort(cells, kind="stable")
        self._codes, self.order = codes[by_group], order[by_group]

    @classmethod
    def of(
        cls,
        branch: Branch,
        records: np.ndarray,
        cube: Cube,
        taken_cells: Sequence[TakenCells] = (),
        progress: Progress = SILENT,
    ) -> SortedPoints:
        """Sort points that are in file order."""
        codes = cube.codes(records, progress.part(0.0, 0.4))
        order = np.argsort(codes, kind="stable").astype(np.min_scalar_type(len(codes)))
        progress(0.7)
        codes = codes[order]
        return cls(branch, records, codes, order, taken_cells, progress.part(0.75, 1.0))

    def records(self, groups: np.ndarray) -> np.ndarray:
        """Return the points of some depths and branches in file order."""
        rows = np.concatenate([self.order[start:end] for start, end in runs(self.counts, groups)])
        rows.sort()
        return self._records[rows]

    def below(self, cell: int) -> SortedPoints:
        """Return the points that are left for a branch below."""
        start = self.counts[:-1].sum() + self.counts[-1, :cell].sum()
        end = start + self.counts[-1, cell]
        branch = self.branch.below(cell)
        return SortedPoints(branch, self._records, self._codes[start:end], self.order[start:end])


def most_in_memory(memory: int, record_length: int) -> int:
    """Return how many points can be sorted in `memory` bytes; at least those of a node."""
    return max(memory // (record_length + _BYTES_TO_SORT), _LEAF_POINTS)


class TakenCells:
    """The cells of a depth below that of the branch from which points were taken, as bits."""

    def __init__(self, depth: int) -> None:
        bits = 3 * (depth + _GRID_BITS)
        self._last, self._bits = np.uint64((1 << bits) - 1), np.zeros((1 << bits) // 8, np.uint8)

    def add(self, cells: np.ndarray) -> np.ndarray:
        """Add distinct cells; return which of them are new."""
        cells = cells & self._last
        byte, bit = (cells >> np.uint64(3)).astype(np.intp), (cells & np.uint64(7)).astype(np.uint8)
        bit = np.left_shift(np.uint8(1), bit)
        new = self._bits[byte] & bit == 0
        np.bitwise_or.at(self._bits, byte[new], bit[new])
        return new


def _depths(
    branch: Branch,
    codes: np.ndarray,
    order: np.ndarray,
    taken_cells: Sequence[TakenCells],
    progress: Progress,
) -> np.ndarray:
    """Return for each point the depth below the branch that takes it if no node above ends the
    branch, uint16 (n,); the number of depths if no depth takes the point.
    """
    depths = np.full(len(codes), branch.depths, dtype=np.uint16)
    remaining = np.arange(len(codes), dtype=order.dtype)
    for depth in range(branch.depths):
        cells = codes[remaining] >> np.uint64(3 * (_DEEPEST - branch.depth - depth))
        starts = np.flatnonzero(np.concatenate(([True], cells[1:] != cells[:-1])))
        sizes, rows = np.diff(starts, append=len(cells)), order[remaining]
        # The first point of each cell in file order.
        takes = rows == np.repeat(np.minimum.reduceat(rows, starts), sizes)
        if taken_cells:
            takes &= np.repeat(taken_cells[depth].add(cells[starts]), sizes)
        depths[remaining[takes]] = depth
        remaining = remaining[~takes]
        progress((depth + 1) / branch.depths)
        if not len(remaining):
            break
    return depths


def runs(counts: np.ndarray, groups: np.ndarray) -> np.ndarray:
    """Return start and end of groups among sorted points; adjacent groups are joined."""
    edges = np.flatnonzero(np.diff(groups.ravel(), prepend=False, append=False))
    return np.concatenate(([0], np.cumsum(counts, dtype=np.int64)))[edges].reshape(-1, 2)


def keys_of(nodes: Sequence[Branch]) -> np.ndarray:
    """Return depth, x, y and z of nodes, an array of int32 of shape (n, 4)."""
    depths, numbers = np.array(nodes, dtype=np.uint64).T
    axes = [_gather(numbers >> np.uint64(axis)) for axis in range(3)]
    return np.column_stack([depths, *axes]).astype(np.int32)


# Steps that put two zero bits between the 21 bits of a number (Morton order).
_SPREAD = (
    (32, 0x001F00000000FFFF),
    (16, 0x001F0000FF0000FF),
    (8, 0x100F00F00F00F00F),
    (4, 0x10C30C30C30C30C3),
    (2, 0x1249249249249249),
)


def _spread(numbers: np.ndarray) -> np.ndarray:
    for shift, mask in _SPREAD:
        numbers = (numbers | (numbers << np.uint64(shift))) & np.uint64(mask)
    return numbers


def _gather(numbers: np.ndarray) -> np.ndarray:
    """Undo `_spread`."""
    numbers = numbers & np.uint64(_SPREAD[-1][1])
    masks = [mask for _, mask in _SPREAD[-2::-1]] + [(1 << _CUBE_BITS) - 1]
    for (shift, _), mask in zip(_SPREAD[::-1], masks):
        numbers = (numbers | (numbers >> np.uint64(shift))) & np.uint64(mask)
    return numbers
