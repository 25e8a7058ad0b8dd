"""The square blocks that a survey is filtered in, and what each of them needs of the points round.

The blocks belong to the method and to the CRS, not to the run: what a point is, the filter says in
the one block that holds it, with all points of a buffer round the block. So the labels depend
neither on how far the survey reaches and how it is cut into files, nor on threads, memory and the
order of the points.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from typing import Callable, Iterator, NamedTuple, Protocol, Sequence

import numpy as np

from ..core.points import Box, Points
from ..core.progress import SILENT, Progress
from ..core.threads import in_threads, parts_of
from .memory import Cost

_SIDE, _STEP, _REACHES = 2000.0, 100.0, 4.0
# Metres from the multiples of the side to the borders of the blocks. The tiles of a survey mostly
# begin at whole kilometres and end before the next: a border that leaves a narrow strip of them
# costs as much as the buffer of that strip. No coordinate lies on such a border, so that rounding
# never decides.
_START = -0.00005
_MOST_POINTS = 10_000_000
# What the filters take.
_COST = Cost()
# Metres by which a border of a leaf may be wrong that is one of a block.
_ROUNDING = 1e-5
# Few enough that what is computed of them stays in the processor's cache.
_POINTS_A_PART = 1 << 15
# How often a block may be quartered: leaves of a sixteenth of a block are also how points are kept.
_LEVELS = 4

# What a point is labelled; 0 where it is neither.
GROUND, LOW, BRIDGE = 1, 2, 3

# x and y in metres.
Corner = tuple[float, float]


class Block(NamedTuple):
    """A square of the plane: block `column`, `row` of the side that it has.

    Attributes
    ----------
    column, row : int
        Its number from west and from south.
    side : float
        Metres.
    start : float
        Metres from the multiples of the side to the borders of the blocks.
    """

    column: int
    row: int
    side: float
    start: float = 0.0

    @property
    def box(self) -> Box:
        """Smallest x and y, largest x and y in metres; the largest belong to the next block."""
        west, south = (each * self.side + self.start for each in (self.column, self.row))
        return west, south, west + self.side, south + self.side

    def holds(self, points: Points, corner: Corner = (0.0, 0.0)) -> np.ndarray:
        """Return which points lie in the block; their coordinates are relative to a corner."""
        holds = np.empty(points.count, dtype=bool)
        west, south = (each - self.start for each in corner)
        for part in parts_of(points.count, _POINTS_A_PART):
            holds[part] = np.floor((points.x[part] + west) / self.side) == self.column
            holds[part] &= np.floor((points.y[part] + south) / self.side) == self.row
        return holds

    def quarters(self) -> list[Block]:
        """Return the four blocks of half the side."""
        column, row, side = 2 * self.column, 2 * self.row, self.side / 2.0
        places = itertools.product((0, 1), (0, 1))
        return [Block(column + i, row + k, side, self.start) for k, i in places]


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

    def read(
        self,
        leaves: np.ndarray,
        box: Box | None = None,
        corner: Corner = (0.0, 0.0),
        progress: Progress = SILENT,
    ) -> BlockPoints:
        """Return the points of some leaves, or those of them in a box.

        Coordinates, and the box, are relative to a corner. May be called from several threads.
        """

    def put(self, positions: np.ndarray, labels: np.ndarray) -> None:
        """Keep the labels of points; called from one thread."""


class BlockPoints(NamedTuple):
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
    def empty(cls, count: int, kind: type) -> BlockPoints:
        """Return room for so many points, and for their places as integers of a type."""
        known, wanted = np.zeros(count, dtype=bool), np.zeros(count, dtype=bool)
        return cls(Points(*np.empty((3, count))), known, wanted, np.empty(count, dtype=kind))

    def put(self, start: int, some: BlockPoints) -> None:
        """Put others in the place of these from `start` on."""
        where = slice(start, start + some.points.count)
        for mine, others in zip((*self.points, *self[1:]), (*some.points, *some[1:])):
            mine[where] = others

    def take(self, which: np.ndarray | slice) -> BlockPoints:
        """Return what a mask or a slice names."""
        return BlockPoints(self.points.take(which), *(each[which] for each in self[1:]))

    def within(self, box: Box) -> BlockPoints:
        """Return those in a box; on its largest x and y they are outside."""
        west, south, east, north = box
        x, y = self.points.x, self.points.y
        inside = (x >= west) & (x < east) & (y >= south) & (y < north)
        return self if inside.all() else self.take(inside)


def gathered(
    counts: Sequence[int],
    read: Callable[[int], BlockPoints],
    box: Box | None = None,
    kind: type = np.int64,
    progress: Progress = SILENT,
) -> BlockPoints:
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
    progress : Progress
        Receives progress.
    """
    starts = np.concatenate(([0], np.cumsum(counts, dtype=np.int64))).tolist()
    whole = BlockPoints.empty(starts[-1], kind)
    if box is None:
        in_threads(
            lambda number: whole.put(starts[number], read(number)), range(len(counts)), progress
        )
        return whole
    end = 0
    for number in range(len(counts)):
        some = read(number).within(box)
        whole.put(end, some)
        end += some.points.count
        progress(starts[number + 1] / starts[-1])
    return whole.take(slice(end))


@dataclass(frozen=True)
class Blocks:
    """How the plane is cut, anchored at (0, 0) of the frame: in a survey that of its CRS.

    Attributes
    ----------
    side, buffer : float
        Metres.
    most_points : int
        A block with more is quartered, again and again, as long as it is no narrower than its
        buffer.
    start : float
        As that of `Block`.
    cost : Cost
        Memory that it takes to work on one.
    """

    side: float
    buffer: float
    most_points: int = _MOST_POINTS
    start: float = 0.0
    cost: Cost = _COST

    @classmethod
    def of(cls, reach: float, cost: Cost = _COST) -> Blocks:
        """Return the blocks for a step to which points within `reach` metres matter."""
        side = max(_SIDE, _STEP * math.ceil(_REACHES * reach / _STEP))
        return cls(side, reach, start=_START, cost=cost)

    def memory(self, count: float, area: float = math.inf) -> int:
        """Return about how many bytes it takes to work on a block.

        Parameters
        ----------
        count : float
            Points that the step sees.
        area : float
            Square metres in which they lie; those of a whole block count at most.
        """
        most = (self.side + 2.0 * self.buffer) ** 2
        return int(self.cost.a_point * count + self.cost.a_square_metre * min(area, most))

    def number(self, places: np.ndarray | float) -> np.ndarray:
        """Return the columns of blocks that hold some x, or the rows of some y, as floats."""
        return np.floor((places - self.start) / self.side)

    def block(self, column: int, row: int) -> Block:
        """Return a block."""
        return Block(column, row, self.side, self.start)

    def corner(self, block: Block) -> Corner:
        """Return the corner that the filter takes for (0, 0) in a block, or a part of one.

        Near the block no digit is lost to the size of the coordinates, and what the filter sees
        does not depend on where the survey begins.
        """
        share = round(self.side / block.side)
        return block.column // share * self.side, block.row // share * self.side

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

    def over(self, store: Store) -> Iterator[Block]:
        """Yield the blocks that may hold points of a store, from south to north."""
        leaves = store.leaves
        rows, columns = (
            (self.number(low + _ROUNDING), self.number(low + leaves.side - _ROUNDING))
            for low in (leaves.y, leaves.x)
        )
        places = set()
        for row, column in itertools.product(rows, columns):
            places |= set(zip(row.astype(int).tolist(), column.astype(int).tolist()))
        for row, column in sorted(places):
            yield from self._divided(self.block(column, row), store)

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
            row, column = (
                np.floor((each - self.start) / self.leaf_side).astype(np.intp) - number * width
                for each, number in ((points.y, block.row), (points.x, block.column))
            )
            counts += np.bincount(row * width + column, minlength=width**2).reshape(counts.shape)
        return counts

    def contents(self, block: Block, store: Store, progress: Progress = SILENT) -> BlockPoints:
        """Return what the filter sees for a block, relative to its `corner`."""
        box, corner = self.window(block), self.corner(block)
        leaves = store.leaves.within(box)
        local = tuple(each - at for each, at in zip(box, corner * 2))
        part = None if store.leaves.are_inside(leaves, box) else local
        return store.read(leaves, part, corner, progress)

    def core(self, block: Block, contents: BlockPoints, is_only: bool) -> np.ndarray:
        """Return which points of its contents a block is to say something of; boolean, (n,).

        The only block holds them all.
        """
        if is_only:
            return contents.wanted
        return contents.wanted & block.holds(contents.points, self.corner(block))
