"""The square blocks that a survey is filtered in, and what each of them needs of the points round.

The blocks belong to the method, not to the run: what a point is, the filter says in the one block
that holds it, with all points of a buffer round the block. So the labels depend neither on how the
survey is cut into files nor on threads, memory and the order of the points.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from typing import Callable, Iterator, NamedTuple, Protocol, Sequence

import numpy as np

from ..points import Points
from ..threads import in_threads, parts_of

_SIDE, _STEP, _REACHES = 1000.0, 100.0, 4.0
_MOST_POINTS = 10_000_000
# Few enough that what is computed of them stays in the processor's cache.
_POINTS_A_PART = 1 << 15
# A survey of up to so many blocks across, each larger than else by this factor at most, is cut
# evenly: a narrow rest would cost as much as its buffer. Sides are multiples of ten metres.
_FEW, _LARGER, _ROUND = 3, 1.125, 10.0
# An extent may be wrong by so much of the ten metres.
_WRONG = 0.01
# How often a block may be quartered: leaves of an eighth of a block are also how points are kept.
_LEVELS = 3

# What a point is labelled; 0 where it is neither.
GROUND, LOW, BRIDGE = 1, 2, 3

Box = tuple[float, float, float, float]


class Block(NamedTuple):
    """A square of the plane: block `column`, `row` of the side that it has."""

    column: int
    row: int
    side: float

    @property
    def box(self) -> Box:
        """Smallest x and y, largest x and y in metres; the largest belong to the next block."""
        west, south = self.column * self.side, self.row * self.side
        return west, south, west + self.side, south + self.side

    def holds(self, points: Points) -> np.ndarray:
        """Return which points lie in the block."""
        holds = np.empty(points.count, dtype=bool)
        for part in parts_of(points.count, _POINTS_A_PART):
            holds[part] = np.floor(points.x[part] / self.side) == self.column
            holds[part] &= np.floor(points.y[part] / self.side) == self.row
        return holds

    def quarters(self) -> list[Block]:
        """Return the four blocks of half the side."""
        column, row, side = 2 * self.column, 2 * self.row, self.side / 2.0
        return [Block(column + i, row + k, side) for k, i in itertools.product((0, 1), (0, 1))]


class Leaves(NamedTuple):
    """Where the points of a store lie, roughly: squares that need not be those of the blocks.

    Attributes
    ----------
    x, y : numpy.ndarray of float64, shape (n,)
        Lower left corners in metres.
    side : float
        Side in metres.
    counts : numpy.ndarray of int64, shape (n,)
        How many points each holds.
    """

    x: np.ndarray
    y: np.ndarray
    side: float
    counts: np.ndarray

    def within(self, box: Box) -> np.ndarray:
        """Return the indices of the leaves that a box touches."""
        west, south, east, north = box
        # Where a border of both is one, rounding must not decide.
        touch = (self.x <= east) & (self.x + self.side >= west)
        return np.flatnonzero(touch & (self.y <= north) & (self.y + self.side >= south))

    def are_inside(self, leaves: np.ndarray, box: Box) -> bool:
        """Return whether some leaves lie in a box and touch none of its sides."""
        west, south, east, north = box
        x, y = self.x[leaves], self.y[leaves]
        inside = (x > west) & (x + self.side < east) & (y > south) & (y + self.side < north)
        return bool(inside.all())


class Store(Protocol):
    """Where points wait for their block: in memory or on disk.

    Attributes
    ----------
    leaves : Leaves
        Where they lie.
    has_known : bool
        Whether any of them are surely ground.
    """

    leaves: Leaves
    has_known: bool

    def read(self, leaves: np.ndarray, box: Box | None = None) -> Contents:
        """Return the points of some leaves, or those of them in a box.

        May be called from several threads.
        """

    def put(self, positions: np.ndarray, labels: np.ndarray) -> None:
        """Keep the labels of points; called from one thread."""


class Contents(NamedTuple):
    """Points of a store.

    Attributes
    ----------
    points : Points
        Where they lie.
    known : numpy.ndarray of bool, shape (n,)
        Which are surely ground.
    wanted : numpy.ndarray of bool, shape (n,)
        Which are to be labelled; the others are context.
    positions : numpy.ndarray of int, shape (n,)
        Their places in the store.
    """

    points: Points
    known: np.ndarray
    wanted: np.ndarray
    positions: np.ndarray

    @classmethod
    def empty(cls, count: int, kind: type) -> Contents:
        """Return room for so many points, and for their places as integers of a type."""
        known, wanted = np.zeros(count, dtype=bool), np.zeros(count, dtype=bool)
        return cls(Points(*np.empty((3, count))), known, wanted, np.empty(count, dtype=kind))

    def put(self, start: int, some: Contents) -> None:
        """Put others in the place of these from `start` on."""
        where = slice(start, start + some.points.count)
        for mine, others in zip((*self.points, *self[1:]), (*some.points, *some[1:])):
            mine[where] = others

    def take(self, which: np.ndarray | slice) -> Contents:
        """Return what a mask or a slice names."""
        return Contents(self.points.take(which), *(each[which] for each in self[1:]))

    def within(self, box: Box) -> Contents:
        """Return those in a box; on its largest x and y they are outside."""
        west, south, east, north = box
        x, y = self.points.x, self.points.y
        inside = (x >= west) & (x < east) & (y >= south) & (y < north)
        return self if inside.all() else self.take(inside)


def gathered(
    counts: Sequence[int],
    read: Callable[[int], Contents],
    box: Box | None = None,
    kind: type = np.int64,
) -> Contents:
    """Return contents that are read piece by piece: small ones stay in the processor's cache.

    Parameters
    ----------
    counts : sequence of int
        Points of each piece.
    read : callable
        Returns the contents of a piece, given its number; may be called from several threads.
    box : tuple of float, optional
        Points outside are left out.
    kind : type
        Integers that hold the place of any point.
    """
    starts = np.concatenate(([0], np.cumsum(counts, dtype=np.int64))).tolist()
    whole = Contents.empty(starts[-1], kind)
    if box is None:
        in_threads(lambda number: whole.put(starts[number], read(number)), range(len(counts)))
        return whole
    end = 0
    for number in range(len(counts)):
        some = read(number).within(box)
        whole.put(end, some)
        end += some.points.count
    return whole.take(slice(end))


@dataclass(frozen=True)
class Blocks:
    """How a survey is cut, anchored at (0, 0) of its frame.

    Attributes
    ----------
    side, buffer : float
        Metres.
    most_points : int
        A block with more is quartered, again and again, as long as it is no narrower than its
        buffer.
    """

    side: float
    buffer: float
    most_points: int = _MOST_POINTS

    @classmethod
    def of(cls, reach: float, extent: float = math.inf) -> Blocks:
        """Return the blocks for a filter to which points within `reach` metres matter.

        Parameters
        ----------
        reach : float
            Metres.
        extent : float
            Larger of the two sides of the survey, in metres.
        """
        side = max(_SIDE, _STEP * math.ceil(_REACHES * reach / _STEP))
        if side - _WRONG * _ROUND <= extent <= _FEW * _LARGER * side:
            fitting = extent / math.ceil(extent / (_LARGER * side))
            side = _ROUND * (math.floor(fitting / _ROUND + _WRONG) + 1)
        return cls(side, reach)

    @property
    def leaf_side(self) -> float:
        """Side of the smallest blocks that there can be."""
        levels = int(math.log2(max(self.side / max(self.buffer, 1e-9), 1.0)))
        return self.side / 2.0 ** min(levels, _LEVELS)

    def window(self, block: Block) -> Box:
        """Return the box of all points that the filter sees for a block."""
        west, south, east, north = block.box
        buffer = self.buffer
        return west - buffer, south - buffer, east + buffer, north + buffer

    def needed(self, box: Box) -> Box:
        """Return the box of the points without which those in a box cannot be labelled.

        Parameters
        ----------
        box : tuple of float
            Smallest x and y, largest x and y, in metres of the frame.
        """
        low = (math.floor(each / self.side) * self.side - self.buffer for each in box[:2])
        high = ((math.floor(each / self.side) + 1) * self.side + self.buffer for each in box[2:])
        return (*low, *high)

    def over(self, store: Store) -> Iterator[Block]:
        """Yield the blocks that may hold points of a store, from south to north."""
        leaves = store.leaves
        rows, columns = (
            (np.floor(low / self.side), np.ceil((low + leaves.side) / self.side) - 1.0)
            for low in (leaves.y, leaves.x)
        )
        places = set()
        for row, column in itertools.product(rows, columns):
            places |= set(zip(row.astype(int).tolist(), column.astype(int).tolist()))
        for row, column in sorted(places):
            yield from self._divided(Block(column, row, self.side), store)

    def _divided(self, block: Block, store: Store) -> Iterator[Block]:
        """Yield a block, or the smaller ones that it is cut into."""
        if store.leaves.counts[store.leaves.within(block.box)].sum() <= self.most_points:
            yield block
            return
        counts = self._counts(block, store)
        todo = [(block, counts)]
        while todo:
            each, counts = todo.pop(0)
            if counts.sum() <= self.most_points or len(counts) == 1:
                yield each
                continue
            half = len(counts) // 2
            parts = (counts[r : r + half, c : c + half] for r in (0, half) for c in (0, half))
            todo[:0] = zip(each.quarters(), parts)

    def _counts(self, block: Block, store: Store) -> np.ndarray:
        """Return the number of points of a block in each of the smallest blocks in it."""
        width = round(block.side / self.leaf_side)
        counts = np.zeros((width, width), dtype=np.int64)
        for leaf in store.leaves.within(block.box):
            points = store.read(np.array([leaf])).points
            points = points.take(block.holds(points))
            row = np.floor(points.y / self.leaf_side).astype(np.intp) - block.row * width
            column = np.floor(points.x / self.leaf_side).astype(np.intp) - block.column * width
            counts += np.bincount(row * width + column, minlength=width**2).reshape(counts.shape)
        return counts

    def contents(self, block: Block, store: Store) -> Contents:
        """Return what the filter sees for a block."""
        box = self.window(block)
        leaves = store.leaves.within(box)
        return store.read(leaves, None if store.leaves.are_inside(leaves, box) else box)
