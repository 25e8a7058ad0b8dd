"""The square blocks in which a survey is filtered, and the points that each of them needs.

The blocks are fixed by the method and the CRS. A point gets its label in the block that holds it,
from all points in that block and in a buffer round it. So the labels do not depend on the extent of
the survey, on its files, on threads or memory, or on the order of the points.
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
# Metres from the multiples of the side to the borders of the blocks. Most tiles begin and end at
# whole kilometres. A border just inside a tile would make a narrow strip, whose buffer costs as
# much as that of a whole block. No coordinate lies exactly on such a border, so rounding does not
# matter.
_START = -0.00005
_MOST_POINTS = 10_000_000
# What the filters take.
_COST = Cost()
# Rounding error, in metres, of the borders of leaves.
_ROUNDING = 1e-5
# So few that intermediate arrays stay in the processor's cache.
_POINTS_A_PART = 1 << 15
# How often a block can be quartered. Points are stored in leaves with a sixteenth of its side.
_LEVELS = 4

# Labels of points; 0 is none of these.
GROUND, LOW, BRIDGE, HIGH = 1, 2, 3, 4

# x and y in metres.
Corner = tuple[float, float]


class Block(NamedTuple):
    """A square block of the plane.

    Attributes
    ----------
    column, row : int
        Position, counted to the east and to the north.
    side : float
        Side in metres.
    start : float
        Metres from the multiples of the side to the borders of the blocks.
    """

    column: int
    row: int
    side: float
    start: float = 0.0

    @property
    def box(self) -> Box:
        """Smallest x and y, largest x and y in metres; the largest belong to the next blocks."""
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
    """Squares that hold the points of a store; smaller than blocks or equal to them.

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
        # Rounding must not decide where the two have a border in common.
        touch = (self.x <= east) & (self.x + self.side >= west)
        return np.flatnonzero(touch & (self.y <= north) & (self.y + self.side >= south))

    def are_inside(self, leaves: np.ndarray, box: Box) -> bool:
        """Return whether some leaves lie in a box and touch none of its sides."""
        west, south, east, north = box
        x, y = self.x[leaves], self.y[leaves]
        inside = (x > west) & (x + self.side < east) & (y > south) & (y + self.side < north)
        return bool(inside.all())


class Store(Protocol):
    """Holds points, in memory or on disk, until their block is computed.

    Attributes
    ----------
    leaves : Leaves
        The squares in which the points lie.
    has_known : bool
        Whether any of them are known ground.
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
        """Return the points of some leaves; only those in a box, if there is one.

        Coordinates and box are relative to a corner. Several threads may call this.
        """

    def put(self, positions: np.ndarray, labels: np.ndarray) -> None:
        """Store the labels of points. Only one thread may call this."""


class BlockPoints(NamedTuple):
    """Points of a store.

    Attributes
    ----------
    points : Points
        Their coordinates.
    known : numpy.ndarray of bool, shape (n,)
        Which are known ground.
    wanted : numpy.ndarray of bool, shape (n,)
        Which are to be labelled; the others are context.
    positions : numpy.ndarray of int, shape (n,)
        Their indices in the store.
    roads : numpy.ndarray of bool, shape (n,)
        Which are ground where they lie on it.
    multi_return : numpy.ndarray of bool, shape (n,)
        Which are of pulses with several returns.
    """

    points: Points
    known: np.ndarray
    wanted: np.ndarray
    positions: np.ndarray
    roads: np.ndarray
    multi_return: np.ndarray

    @classmethod
    def empty(cls, count: int, kind: type) -> BlockPoints:
        """Return uninitialised arrays for `count` points; `kind` is the type of the positions."""
        known, wanted, roads, several = (np.zeros(count, dtype=bool) for _ in range(4))
        points = Points(*np.empty((3, count)))
        return cls(points, known, wanted, np.empty(count, dtype=kind), roads, several)

    def put(self, start: int, some: BlockPoints) -> None:
        """Overwrite points from index `start` on with other points."""
        where = slice(start, start + some.points.count)
        for mine, others in zip((*self.points, *self[1:]), (*some.points, *some[1:])):
            mine[where] = others

    def take(self, which: np.ndarray | slice) -> BlockPoints:
        """Return the points that a mask or a slice selects."""
        return BlockPoints(self.points.take(which), *(each[which] for each in self[1:]))

    def within(self, box: Box) -> BlockPoints:
        """Return the points in a box, without those on its largest x and y."""
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
    """Return points that are read in pieces, which are small enough for the processor's cache.

    Parameters
    ----------
    counts : sequence of int
        Points of each piece.
    read : callable
        Returns the points of a piece, given its number. Several threads may call it.
    box : tuple of float, optional
        Only points in this box are returned.
    kind : type
        Type of integer for the positions.
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
    """How the plane is cut into blocks, from (0, 0) of the frame; in a survey, of the CRS.

    Attributes
    ----------
    side, buffer : float
        Metres.
    most_points : int
        A block with more points is quartered repeatedly, unless its parts would be narrower than
        the buffer.
    start : float
        As in `Block`.
    cost : Cost
        Memory that a block takes.
    """

    side: float
    buffer: float
    most_points: int = _MOST_POINTS
    start: float = 0.0
    cost: Cost = _COST

    @classmethod
    def of(cls, reach: float, cost: Cost = _COST) -> Blocks:
        """Return the blocks for a step that uses points up to `reach` metres away."""
        side = max(_SIDE, _STEP * math.ceil(_REACHES * reach / _STEP))
        return cls(side, reach, start=_START, cost=cost)

    def memory(self, count: float, area: float = math.inf) -> int:
        """Return about how many bytes of memory a block takes.

        Parameters
        ----------
        count : float
            Points in the block and its buffer.
        area : float
            Square metres in which they lie; at most the area of a whole block counts.
        """
        most = (self.side + 2.0 * self.buffer) ** 2
        return int(self.cost.a_point * count + self.cost.a_square_metre * min(area, most))

    def number(self, places: np.ndarray | float) -> np.ndarray:
        """Return the columns of the blocks that hold some x, or the rows for some y, as floats."""
        return np.floor((places - self.start) / self.side)

    def block(self, column: int, row: int) -> Block:
        """Return a block."""
        return Block(column, row, self.side, self.start)

    def corner(self, block: Block) -> Corner:
        """Return the place that becomes (0, 0) while a block, or a part of one, is computed.

        It is near the block, so that no digits are lost to large coordinates. It does not depend
        on the extent of the survey, so that the results do not either.
        """
        share = round(self.side / block.side)
        return block.column // share * self.side, block.row // share * self.side

    @property
    def leaf_side(self) -> float:
        """Side of the smallest possible blocks."""
        levels = int(math.log2(max(self.side / max(self.buffer, 1e-9), 1.0)))
        return self.side / 2.0 ** min(levels, _LEVELS)

    def window(self, block: Block) -> Box:
        """Return the box of a block with its buffer."""
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
        """Yield a block, or the smaller blocks into which it is cut."""
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
        """Return the number of points in each of the smallest blocks of a block."""
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
        """Return the points of a block and its buffer, relative to its `corner`."""
        box, corner = self.window(block), self.corner(block)
        leaves = store.leaves.within(box)
        west, south, east, north = (each - at for each, at in zip(box, corner * 2))
        is_inside = store.leaves.are_inside(leaves, box)
        part = None if is_inside else (west, south, east, north)
        return store.read(leaves, part, corner, progress)

    def core(self, block: Block, contents: BlockPoints, is_only: bool) -> np.ndarray:
        """Return which points of its contents a block is to say something of; boolean, (n,).

        The only block holds them all.
        """
        if is_only:
            return contents.wanted
        return contents.wanted & block.holds(contents.points, self.corner(block))
