"""Which blocks the files of a survey touch, and which files a block needs.

The blocks belong to the whole survey, not to its files. So the files get the same labels as one
file with all their points, without seams.
"""

from __future__ import annotations

import math
from collections import defaultdict
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, Iterable, NamedTuple, Sequence

import numpy as np

from ..core.points import Box, Frame
from ..las.cloud import PointCloud
from ..las.lasfile import LasFile
from ..las.reading import read_cloud
from ..survey.files import Survey
from .blocks import Blocks, PlaneBlock
from .store import code_of, row_and_column

# Metres by which boxes are read wider on each side. Later the points are chosen exactly.
_MARGIN = 0.1
# A tile that touches more blocks than this has stray points. Then its points are read to find the
# blocks that hold them.
_MOST_PLACES = 400
# Bytes that a point takes in memory while it waits for its block.
_BYTES_WAITING = 48
# Bytes that a point of a file takes while the file is read.
_BYTES_READ = 40
# Least number of groups of blocks for each worker, so that no worker is idle for long.
_GROUPS_A_WORKER = 4
_LARGEST_GROUP = 16
_STEP = 1 << 20


class BlockIndex(NamedTuple):
    """Column and row of a block of the survey."""

    column: int
    row: int


@dataclass(frozen=True)
class BlockGrid:
    """A step, and the blocks of a survey in which it works; it has no files, so that jobs that get
    it stay small.
    """

    frame: Frame  # of all files, with its origin at (0, 0) of the CRS
    step: Any  # a `Step`, whose module imports this one
    stated: str | None = None  # the CRS that the user states for all files, as for `open_las`

    @cached_property
    def blocks(self) -> Blocks:
        return self.step.blocks

    def window(self, places: Iterable[BlockIndex]) -> Box:
        """Return the box that holds all points that the blocks need, in units of the CRS."""
        boxes = np.array([self.blocks.window(self.blocks.block(*place)) for place in places])
        low, high = boxes[:, :2].min(axis=0) - _MARGIN, boxes[:, 2:].max(axis=0) + _MARGIN
        return self.in_crs((*low, *high))

    def in_crs(self, metres: Box) -> Box:
        """Return a box in metres of the frame in units of the CRS."""
        box = np.array(metres) / self.frame.horizontal_unit + np.tile(self.frame.origin, 2)
        west, south, east, north = box.tolist()
        return west, south, east, north

    def places_in(self, box: Box) -> tuple[range, range]:
        """Return the columns and rows of the blocks that a box in units of the CRS touches."""
        metres = (np.array(box) - np.tile(self.frame.origin, 2)) * self.frame.horizontal_unit
        west, south, east, north = self.blocks.number(metres).astype(int).tolist()
        return range(west, east + 1), range(south, north + 1)

    def touching(self, box: Box) -> list[BlockIndex]:
        """Return the blocks that a box in units of the CRS touches, from south to north."""
        columns, rows = self.places_in(box)
        return [BlockIndex(column, row) for row in rows for column in columns]

    def holding(self, block: PlaneBlock) -> BlockIndex:
        """Return the index of the block that a block is a part of, or equal to."""
        share = round(self.blocks.side / block.side)
        return BlockIndex(block.column // share, block.row // share)

    def among(self, places: Iterable[BlockIndex], box: Box) -> list[BlockIndex]:
        """Return the blocks, among some, that a box in units of the CRS touches."""
        columns, rows = self.places_in(box)
        return [place for place in places if place.column in columns and place.row in rows]

    def codes(self, cloud: PointCloud) -> np.ndarray:
        """Return the `code` of the block of each point, int64 of shape (n,)."""
        codes = np.empty(cloud.count, dtype=np.int64)
        for first in range(0, cloud.count, _STEP):
            part = slice(first, first + _STEP)
            places = cloud.places(part, self.frame)
            # From the same numbers and by the same steps as in `Block.holds`.
            column, row = map(self.blocks.number, places)
            codes[part] = code_of(row, column)
        return codes

    def numbers(self, cloud: PointCloud, places: Iterable[BlockIndex]) -> np.ndarray:
        """Return for each point the number of its block among some, from 1; 0 for other blocks."""
        codes, numbers = self.codes(cloud), np.zeros(cloud.count, dtype=np.uint8)
        for number, place in enumerate(places, start=1):
            numbers[codes == code(place)] = number
        return numbers


def code(place: BlockIndex) -> int:
    """Return the number of a block, as in `BlockGrid.codes`."""
    return int(code_of(np.array(place.row), np.array(place.column)))


def places_of(grid: BlockGrid, tile: LasFile) -> list[BlockIndex]:
    """Return the blocks that may hold points of a tile, from south to north; if the tile has stray
    points, it is read.
    """
    columns, rows = grid.places_in(tile.outer_box)
    if len(columns) * len(rows) <= _MOST_PLACES:
        return grid.touching(tile.outer_box)
    row, column = row_and_column(np.unique(grid.codes(read_cloud(tile))))
    return [BlockIndex(*index) for index in zip(column.tolist(), row.tolist())]


def sources_of(grid: BlockGrid, survey: Survey, place: BlockIndex) -> list[Path]:
    """Return the files that may have points for a block."""
    return [tile.path for tile in survey.touching(grid.window([place]))]


def memory_of(grid: BlockGrid, count: float) -> int:
    """Estimate the bytes of memory that blocks with `count` points take if all points wait in
    memory.
    """
    return int(_BYTES_WAITING * count) + grid.blocks.memory(count)


def least_memory(grid: BlockGrid, survey: Survey, place: BlockIndex) -> int:
    """Estimate the bytes of memory that a block takes if its points wait on disk."""
    window = grid.window([place])
    largest = max((tile.count for tile in survey.touching(window)), default=0)
    return int(_BYTES_READ * largest) + grid.blocks.memory(points_in(survey, window))


def points_in(survey: Survey, box: Box) -> float:
    """Estimate from the headers of the files how many points lie in a box."""
    count = 0.0
    for tile in survey.touching(box):
        shares = (
            _share(tile.box[axis], tile.box[axis + 2], box[axis], box[axis + 2]) for axis in (0, 1)
        )
        count += tile.count * math.prod(shares)
    return count


def _share(low: float, high: float, start: float, end: float) -> float:
    """Return the share of the range from low to high that lies between start and end."""
    if high <= low:
        return 1.0
    return max(0.0, min(high, end) - max(low, start)) / (high - low)


def grouped(
    grid: BlockGrid, survey: Survey, places: Sequence[BlockIndex], workers: int, memory: int
) -> list[list[BlockIndex]]:
    """Return blocks in groups whose files are read together, from south to north; a group takes at
    most `memory` bytes, except for a group of one block, and each worker gets several groups.
    """
    groups, width = _squares(places, 1), 2
    while width <= _LARGEST_GROUP:
        wider = _squares(places, width)
        if len(wider) < _GROUPS_A_WORKER * workers:
            break
        counts = (points_in(survey, grid.window(group)) for group in wider)
        if memory_of(grid, max(counts)) > memory:
            break
        groups, width = wider, 2 * width
    return groups


def _squares(places: Iterable[BlockIndex], width: int) -> list[list[BlockIndex]]:
    squares = defaultdict(list)
    for row, column in sorted((place.row, place.column) for place in places):
        squares[row // width, column // width].append(BlockIndex(column, row))
    return [squares[square] for square in sorted(squares)]
