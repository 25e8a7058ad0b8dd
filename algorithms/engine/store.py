"""Stores, which hold points until their block is computed, and then their values."""

from __future__ import annotations

from types import MappingProxyType
from typing import Any, Callable, Mapping, NamedTuple, Sequence, TypeVar

import numpy as np

from ..core.points import Box, Frame, Points
from ..core.progress import SILENT, Progress
from ..core.threads import in_threads
from ..las.cloud import PointCloud

_Result = TypeVar("_Result")

# Asks for the points that are not known ground.
OTHERS = "others"
# x and y in metres.
Corner = tuple[float, float]


class Leaves(NamedTuple):
    """Squares that hold the points of a store; a block has one or several leaves."""

    x: np.ndarray  # float64, (n,): lower left corners in metres
    y: np.ndarray  # as x
    side: float  # metres
    counts: np.ndarray  # int64, (n,): points

    def within(self, box: Box) -> np.ndarray:
        """Return the indices of the leaves that a box touches."""
        west, south, east, north = box
        # Rounding must not decide where the two have a border in common.
        touch = (self.x <= east) & (self.x + self.side >= west)
        return np.flatnonzero(touch & (self.y <= north) & (self.y + self.side >= south))

    def are_inside(self, leaves: np.ndarray, box: Box) -> bool:
        """Return whether all of some leaves lie in a box without touching its sides."""
        west, south, east, north = box
        x, y = self.x[leaves], self.y[leaves]
        inside = (x > west) & (x + self.side < east) & (y > south) & (y + self.side < north)
        return bool(inside.all())


class Marks(NamedTuple):
    """Flags of points for a step, boolean arrays of shape (n,)."""

    selected: np.ndarray  # points that take part
    known: np.ndarray | None = None  # selected points that are known ground; None for none
    # Selected points that get a value, while the others are context; None for all.
    wanted: np.ndarray | None = None
    # Further flags of the step, by name: arrays, or objects that return such an array for an index.
    flags: Mapping[str, Any] = MappingProxyType({})


class BlockPoints(NamedTuple):
    """Points of a store with flags, boolean arrays of shape (n,)."""

    points: Points
    known: np.ndarray  # points that are known ground
    wanted: np.ndarray  # points that get a value; the others are context
    positions: np.ndarray  # int, (n,): indices in the store
    flags: Mapping[str, np.ndarray] = MappingProxyType({})  # as in `Marks`

    @classmethod
    def empty(cls, count: int, kind: type, names: Sequence[str]) -> BlockPoints:
        """Return arrays for `count` points that are still to be put; `kind` is the type of the
        positions, and `names` are the names of flags.
        """
        known, wanted, *flags = (np.zeros(count, dtype=bool) for _ in range(2 + len(names)))
        positions: np.ndarray = np.empty(count, dtype=kind)
        points = Points(*np.empty((3, count)))
        return cls(points, known, wanted, positions, dict(zip(names, flags)))

    def put(self, start: int, added: BlockPoints) -> None:
        where = slice(start, start + added.points.count)
        for old, new in zip(self._arrays, added._arrays):
            old[where] = new

    def take(self, selected: np.ndarray | slice) -> BlockPoints:
        if isinstance(selected, np.ndarray) and selected.dtype == bool:
            selected = np.flatnonzero(selected)  # faster than to use the mask six times
        known, wanted, positions = (array[selected] for array in self[1:4])
        flags = {name: flag[selected] for name, flag in self.flags.items()}
        return BlockPoints(self.points.take(selected), known, wanted, positions, flags)

    @property
    def _arrays(self) -> tuple[np.ndarray, ...]:
        return *self.points, *self[1:4], *self.flags.values()


class Store:
    """Points with a value each; points are added part by part from any number of files, and after
    `finish` they are read by the squares in which they lie.
    """

    leaves: Leaves  # after `finish`
    # Whether reading only some of the points reads all of them first.
    reads_all = False

    def __init__(self, frame: Frame, kind: type) -> None:
        self.frame, self._value_kind = frame, np.dtype(kind)
        self.has_known = False  # whether any point is known ground
        self.count = 0  # points of all parts
        self.starts: list[int] = []  # index of the first point of each part
        self.flags: tuple[str, ...] = ()  # names of the `flags` of all parts

    def append(self, part: PointCloud, marks: Marks) -> None:
        """Add the selected points of the next part."""
        self.starts.append(self.count)
        self.count += part.count
        self.flags = tuple(marks.flags)

    def finish(self, progress: Progress = SILENT) -> None:
        """Finish adding points."""
        raise NotImplementedError

    def pieces(
        self, leaves: np.ndarray, corner: Corner, only: str | None = None
    ) -> tuple[Sequence[int], Callable[[int], BlockPoints]]:
        """Divide leaves into pieces that are small enough for the processor's cache; return the
        numbers of points of the pieces, and a function to read a piece by its number; see `read`.
        """
        raise NotImplementedError

    def read(
        self,
        leaves: np.ndarray,
        box: Box | None = None,
        corner: Corner = (0.0, 0.0),
        progress: Progress = SILENT,
        only: str | None = None,
    ) -> BlockPoints:
        """Return the points of some leaves, and in a box if one is given, relative to a corner; if
        `only` is a flag, points with this flag and known ground; if it is `OTHERS`, all but known
        ground.
        """
        # Several threads may call this at the same time.
        counts, piece = self.pieces(leaves, corner, only)
        starts = np.concatenate(([0], np.cumsum(counts, dtype=np.int64))).tolist()
        whole = BlockPoints.empty(starts[-1], smallest_integers(self.count), self.flags)
        numbers = range(len(counts))
        if box is None and not (only and self.reads_all):
            in_threads(lambda number: whole.put(starts[number], piece(number)), numbers, progress)
            return whole
        end = 0
        for number in numbers:
            read = piece(number)
            if box is not None:
                inside = read.points.within(box)
                read = read if inside.all() else read.take(inside)
            whole.put(end, read)
            end += read.points.count
            progress(starts[number + 1] / starts[-1])
        return whole.take(slice(end))

    def over_pieces(
        self,
        leaves: np.ndarray,
        work: Callable[[BlockPoints], _Result],
        corner: Corner = (0.0, 0.0),
        progress: Progress = SILENT,
        only: str | None = None,
    ) -> list[_Result]:
        """Call a function for the points of some leaves piece by piece, so that not all points are
        in memory together, and return its results; for `corner` and `only`, see `read`.
        """
        counts, piece = self.pieces(leaves, corner, only)
        return in_threads(lambda number: work(piece(number)), range(len(counts)), progress)

    def put(self, positions: np.ndarray, values: np.ndarray) -> None:
        """Store the values of points, whose positions ascend; only one thread may call this."""
        raise NotImplementedError

    def keep(self, cells: np.ndarray) -> Any:
        """Return cells, shape (rows, columns), or if the points are on disk an object that reads
        slices of them from there.
        """
        return cells

    def values(self, number: int) -> np.ndarray:
        """Return the values of all points of a part, numbered from 0 in the order in which parts
        were added; 0 where no value was stored.
        """
        raise NotImplementedError


# Row and column of a square are packed into one number of 64 bits: the row is shifted by this many
# bits.
_SHIFT = 32
# Added to row and column, which can be negative.
_HALF = 1 << 30


def code_of(row: np.ndarray, column: np.ndarray) -> np.ndarray:
    """Return one number for the row and the column of each square."""
    return (row.astype(np.int64) + _HALF << _SHIFT) + column.astype(np.int64) + _HALF


def row_and_column(codes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the rows and columns for numbers of `code_of`."""
    return (codes >> _SHIFT) - _HALF, (codes & ((1 << _SHIFT) - 1)) - _HALF


class LeafIndex:
    """Where the points of each leaf of a store are: runs of consecutive points."""

    def __init__(self, side: float, start: float) -> None:
        # Metres: the side of a leaf, and from its multiples to the borders of leaves.
        self._side, self._start = side, start
        self._added: list[np.ndarray] = []

    def add(self, *runs: np.ndarray | int) -> None:
        """Add runs: the codes of their leaves, the indices of their first points, their lengths."""
        # Threads may add runs in any order.
        self._added.append(np.column_stack(runs))

    def sort(self, places: Sequence[np.ndarray], first: int) -> np.ndarray:
        """Add points, given x and y, which the store holds sorted by leaves from index `first` on,
        and return the order that sorts them.
        """
        column, row = (np.floor((axis - self._start) / self._side) for axis in places)
        codes = code_of(row, column)
        # Most points lie in the same leaf as the point before, and then a stable sort is fastest.
        order = np.argsort(codes, kind="stable")
        codes = codes[order]
        starts = np.flatnonzero(np.concatenate(([True], codes[1:] != codes[:-1]))[: len(codes)])
        counts = np.diff(starts, append=len(codes))
        self.add(codes[starts], starts + first, counts)
        return order

    def finish(self) -> Leaves:
        """Finish adding, and return the leaves."""
        added = np.concatenate([np.zeros((0, 3), np.int64), *self._added])
        self._added = []
        added = added[np.argsort(added[:, 0], kind="stable")]
        codes, first = np.unique(added[:, 0], return_index=True)
        # Index of the first run of each leaf, and the number of all runs.
        self._bounds = np.append(first, len(added))
        self._starts, self._counts = added[:, 1].copy(), added[:, 2].copy()
        totals = np.add.reduceat(self._counts, first) if len(codes) else codes
        row, column = row_and_column(codes)
        x, y = (number * self._side + self._start for number in (column, row))
        return Leaves(x, y, self._side, totals)

    def of(self, leaves: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the starts, ascending, and the lengths of the runs of some leaves."""
        of_each = [np.arange(*self._bounds[leaf : leaf + 2]) for leaf in leaves]
        runs = np.concatenate([np.zeros(0, np.intp), *of_each])
        runs = runs[np.argsort(self._starts[runs], kind="stable")]
        return self._starts[runs], self._counts[runs]


def smallest_integers(count: int) -> type:
    """Return the smallest integer type that holds the indices of `count` points."""
    return np.int32 if count < 1 << 31 else np.int64
