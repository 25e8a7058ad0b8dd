"""The square blocks in which a survey is filtered, and the points that each of them needs.

The blocks are fixed by the method and the CRS. A point gets its label in the block that holds it,
from all points in that block and in a buffer round it. So the labels do not depend on the extent of
the survey, on its files, on threads or memory, or on the order of the points.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from typing import Any, Hashable, Iterator, NamedTuple

import numpy as np

from ..core.points import Box, Points
from ..core.progress import SILENT, Progress
from ..core.threads import parts_of
from .memory import Cost
from .store import BlockPoints, Corner, Store

# Metres: least side of a block.
_SIDE = 2000.0
# A block is at least this many times as wide as a step reaches: points in buffers are read for
# several blocks, and should be few.
_REACHES = 4.0
# Metres: the side of a block is a multiple of this.
_STEP = 100.0
# Metres from the multiples of the side to the borders of the blocks. Most tiles begin and end at
# whole kilometres. A border just inside a tile would make a narrow strip, whose buffer costs as
# much as that of a whole block. No coordinate lies exactly on such a border, so rounding does not
# matter.
_START = -0.00005
_MOST_POINTS = 10_000_000
# The memory that the filters take.
_COST = Cost()
# Rounding error, in metres, of the borders of leaves.
_ROUNDING = 1e-5
# Few enough for intermediate arrays to stay in the processor's cache.
_POINTS_A_PART = 1 << 15
# How often a block can be quartered: leaves have a sixteenth of its side.
_LEVELS = 4


class PlaneBlock(NamedTuple):
    """A square block of the plane, with its position counted to the east and to the north."""

    column: int
    row: int
    side: float  # metres
    start: float = 0.0  # metres from the multiples of the side to the borders of the blocks

    @property
    def box(self) -> Box:
        """Smallest x and y, largest x and y in metres; the largest are outside."""
        west, south = (number * self.side + self.start for number in (self.column, self.row))
        return west, south, west + self.side, south + self.side

    def holds(self, points: Points, corner: Corner = (0.0, 0.0)) -> np.ndarray:
        """Return which points lie in the block; their coordinates are relative to a corner."""
        holds = np.empty(points.count, dtype=bool)
        west, south = (edge - self.start for edge in corner)
        for part in parts_of(points.count, _POINTS_A_PART):
            holds[part] = np.floor((points.x[part] + west) / self.side) == self.column
            holds[part] &= np.floor((points.y[part] + south) / self.side) == self.row
        return holds

    def quarters(self) -> list[PlaneBlock]:
        column, row, side = 2 * self.column, 2 * self.row, self.side / 2.0
        places = itertools.product((0, 1), (0, 1))
        return [PlaneBlock(column + i, row + k, side, self.start) for k, i in places]


@dataclass(frozen=True)
class Blocks:
    """How the plane is cut into blocks, from an origin."""

    side: float  # metres
    buffer: float  # metres
    # A block with more points is quartered, down to the width of the buffer.
    most_points: int = _MOST_POINTS
    start: float = 0.0  # as in `PlaneBlock`
    cost: Cost = _COST
    origin: tuple[float, float] = (0.0, 0.0)  # of the frame, in units of the CRS

    @classmethod
    def of(
        cls, reach: float, cost: Cost = _COST, origin: tuple[float, float] = (0.0, 0.0)
    ) -> Blocks:
        """Return the blocks for a step that uses points up to `reach` metres away."""
        side = max(_SIDE, _STEP * math.ceil(_REACHES * reach / _STEP))
        return cls(side, reach, start=_START, cost=cost, origin=origin)

    def memory(self, count: float, area: float = math.inf) -> int:
        """Estimate the bytes of memory that a block, or the largest of its parts, takes, given its
        number of points and its area in m², both with the buffer.
        """
        area = min(area, (self.side + 2.0 * self.buffer) ** 2)
        share = min(1.0, self.most_points / max(count, 1.0))
        return int(self.cost.a_point * count * share + self.cost.a_square_metre * area * share)

    def number(self, places: np.ndarray | float) -> np.ndarray:
        """Return the columns of the blocks at x coordinates, or the rows at y, as floats."""
        return np.floor((places - self.start) / self.side)

    def block(self, column: int, row: int) -> PlaneBlock:
        return PlaneBlock(column, row, self.side, self.start)

    @property
    def leaf_side(self) -> float:
        """Side of the smallest possible blocks."""
        levels = int(math.log2(max(self.side / max(self.buffer, 1e-9), 1.0)))
        return self.side / 2.0 ** min(levels, _LEVELS)

    def window(self, block: PlaneBlock) -> Box:
        west, south, east, north = block.box
        buffer = self.buffer
        return west - buffer, south - buffer, east + buffer, north + buffer

    def over(self, store: Store) -> Iterator[PlaneBlock]:
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

    def _divided(self, block: PlaneBlock, store: Store) -> Iterator[PlaneBlock]:
        """Yield a block, or smaller blocks if it has too many points."""
        most = store.leaves.counts[store.leaves.within(block.box)].sum()
        if most <= self.most_points:
            yield block
            return
        counts = self._counts(block, store)
        todo = [(block, counts)]
        while todo:
            part, counts = todo.pop(0)
            if counts.sum() <= self.most_points or len(counts) == 1:
                yield part
                continue
            half = len(counts) // 2
            parts = (counts[r : r + half, c : c + half] for r in (0, half) for c in (0, half))
            todo[:0] = zip(part.quarters(), parts)

    def _counts(self, block: PlaneBlock, store: Store) -> np.ndarray:
        """Return the number of points in each of the smallest blocks of a block."""
        width = round(block.side / self.leaf_side)
        counts = np.zeros((width, width), dtype=np.int64)
        for leaf in store.leaves.within(block.box):
            points = store.read(np.array([leaf])).points
            points = points.take(block.holds(points))
            row, column = (
                np.floor((places - self.start) / self.leaf_side).astype(np.intp) - number * width
                for places, number in ((points.y, block.row), (points.x, block.column))
            )
            counts += np.bincount(row * width + column, minlength=width**2).reshape(counts.shape)
        return counts


class Visit(NamedTuple):
    """A block while a step works on it."""

    block: PlaneBlock
    blocks: Blocks
    store: Store  # with the points that the step needs
    is_only: bool  # whether the block holds all points of the store
    findings: dict[Hashable, Any]  # what earlier steps have found out about the block

    @property
    def corner(self) -> Corner:
        """The place that is (0, 0) in `contents`."""
        # The corner is near the block, so that large coordinates do not lose digits. It does not
        # depend on the extent of the survey, so results do not depend on it either.
        share, side = round(self.blocks.side / self.block.side), self.blocks.side
        return self.block.column // share * side, self.block.row // share * side

    def contents(self, progress: Progress = SILENT, only: str | None = None) -> BlockPoints:
        """Return the points of the block and its buffer; for `only`, see `Store.read`."""
        box, leaves = self.blocks.window(self.block), self.store.leaves
        west, south, east, north = (side - start for side, start in zip(box, self.corner * 2))
        touched = leaves.within(box)
        part = None if leaves.are_inside(touched, box) else (west, south, east, north)
        return self.store.read(touched, part, self.corner, progress, only)

    def core(self, contents: BlockPoints) -> np.ndarray:
        """Return which points get a value in this block, bool (n,)."""
        if self.is_only:
            return contents.wanted
        return contents.wanted & self.block.holds(contents.points, self.corner)

    @property
    def size(self) -> tuple[int, int]:
        """How many points the block has with its buffer, and how many bytes it takes."""
        leaves = self.store.leaves
        touched = leaves.within(self.blocks.window(self.block))
        count = int(leaves.counts[touched].sum())
        return count, self.blocks.memory(count, len(touched) * leaves.side**2)
