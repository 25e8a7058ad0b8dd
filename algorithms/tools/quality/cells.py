"""Cells of a survey of any size, to which points are added part by part.

All files are read twice: once to add up the ground and to find points that repeat, and once to
count the others, and to compare them with planes through the ground of their surroundings. Cells do
not depend on the files or on their order, so there are no seams.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Callable, Iterator, NamedTuple, Tuple

import numpy as np

from ...classes.ground_classes import GroundClasses
from ...classes.kept_classes import NOISE, overlapping
from ...core.errors import BareEarthError
from ...core.points import Frame
from ...core.progress import SILENT, Progress
from ...grids.parts import parts_with
from ...las.cloud import PointCloud
from ...rasters.cell_grid import MOST_CELLS
from ...report.pictures import reduced
from ...survey.repeated_points import RepeatedPoints
from ...survey.scratch import ScratchArrays
from .grids import SQUARE, Grids
from .made_points import WATER, MadePoints
from .planes import WINDOWS, planes

# Bits of cells.
PULSE = 1  # a first return that counts as a pulse
WET = 2  # water
FLAGGED = 4  # a first return with the flag of overlap
ROUGH = 8  # a pulse with several returns
BUILT = 16  # a building
_BUILDING = 6  # the class
# Most flight strips that are distinguished in a cell.
STRIPS = 4
_BYTES = 72  # for a cell
_BYTES_A_POINT = 9
# Most cells, and most points, that are in memory, where they take 1.5 GB; more are on disk.
_MOST_IN_MEMORY = 18_000_000
# Cells: side of the squares whose planes are made together, an even number.
_TILE = 1024
# Heights above the ground of low vegetation. Points are compared up to this height, in metres,
# above the lowest of their strip in the cell.
LOW = (0.2, 2.0)
_NEAR = 0.5


class QualityArrays(ScratchArrays):
    """Creates arrays in memory, or in files of a temporary folder if cells or points are many; an
    error says if there are too many cells, or too little space on the disk.
    """

    def __init__(self, folder: Path, cells: int, points: int) -> None:
        super().__init__(None if max(cells, points) <= _MOST_IN_MEMORY else folder)
        size = _BYTES * cells + _BYTES_A_POINT * points
        if cells > MOST_CELLS:
            raise BareEarthError(
                f"The rasters would have {cells:,} cells. Choose a larger cell size, or give fewer"
                " files."
            )
        if not self.has_room(size):
            raise BareEarthError(
                f"{cells:,} cells and {points:,} points need {size / 1e9:.0f} GB on the disk of"
                f" {folder.parent} while they are counted. Free some space, or choose a larger cell"
                " size."
            )


@dataclass
class Counts:
    """Numbers of points; only `points` and `withheld` include withheld points."""

    points: int = 0
    withheld: int = 0  # excluded by the producer
    shared: int = 0  # points that another file contains as well
    duplicates: int = 0  # other points that repeat a point of their file
    synthetic: int = 0  # not measured, according to their flag
    infilled: int = 0  # not measured, according to return number, time or class
    flagged: int = 0  # of overlap, by the flag, or by class 12 in point formats 0 to 5
    classes: np.ndarray = field(default_factory=lambda: np.zeros(256, dtype=np.int64))
    returns: np.ndarray = field(default_factory=lambda: np.zeros(256, dtype=np.int64))
    strips: set[int] = field(default_factory=set)  # point source ids

    def add(self, part: PointCloud, used: np.ndarray, is_made: np.ndarray) -> None:
        """Count the points of a part; `used` are not withheld, and `is_made` are not measured."""
        self.points += part.count
        self.withheld += int(np.count_nonzero(part.withheld))
        if part.synthetic is not None:
            self.synthetic += int(np.count_nonzero(part.synthetic & used))
        self.flagged += int(np.count_nonzero(overlapping(part) & used))
        self.classes += np.bincount(part.classification[used], minlength=256)
        self.returns += np.bincount(part.return_number[used], minlength=256)
        if part.strip is not None:
            self.strips.update(np.unique(part.strip[used & ~is_made]).tolist())


# Slices of rows and of columns.
Rectangle = Tuple[slice, ...]


class Extent(NamedTuple):
    """Where the survey lies, in its coarse cells; boolean."""

    inside: np.ndarray  # all cells of the survey, with gaps that it encloses
    inner: np.ndarray  # those for figures: without squares of 10 m along the edge, partly filled
    dry: np.ndarray  # those of `inner` in squares of 10 m without points of water
    # those of `inner` without squares in which all first returns have the flag of overlap. Where
    # this flag marks all points of an overlap, not only those of one strip, nothing would be left
    # to count.
    pulses: np.ndarray


class QualityCells:
    """The cells of a survey, without points that were not measured."""

    # points, first, ground_points, low: uint32 (rows, columns), numbers of points, first returns,
    # ground points and points of low vegetation in each cell; rows from south to north, as
    # everywhere here. Noise, withheld and made points are left out, and points that repeat
    # others. Points of overlap are left out of points and first returns.
    # highest: float32 (rows / 2, columns / 2), height of the highest point in metres that is not
    # withheld, minus infinity for none.
    # filled: uint8, `PULSE`, `WET` and `FLAGGED`, in the cells of `Grids.spaced`. marks: uint8
    # (rows / 2, columns / 2), `PULSE`, `WET`, `FLAGGED`, `ROUGH` and `BUILT`.
    # strip, strip_low, strip_points, strip_sum: (4, rows / 2, columns / 2), up to four strips of a
    # cell (point source id + 1, 0 for none), with the height of their lowest last return, and with
    # number and sum of the heights of last returns near to it, in metres above the common plane of
    # the ground.

    def __init__(
        self,
        grids: Grids,
        void: float,
        store: QualityArrays,
        ground: GroundClasses,
        repeated: RepeatedPoints,
        made: MadePoints,
    ) -> None:
        self.grids, self._ground, self._repeated, self._made = grids, ground, repeated, made
        self.void = void  # distance in metres from which on ground is missing
        self._no_strips = np.zeros(0, dtype=np.uint16)
        self.counts = Counts()
        fine, coarse = grids.fine.window.shape, grids.coarse.window.shape
        make = store.array
        self.points, self.first, self.ground_points, self.low, self._number = (
            make(name, fine, "u4") for name in ("points", "first", "ground", "low", "number")
        )
        # Sums of x and y of ground points from the centre of their cell, and of their heights.
        self._x, self._y = (make(name, fine, "f4") for name in ("x", "y"))
        self._z, self._height = (make(name, fine, "f8") for name in ("z", "height"))
        self._rise_x, self._rise_y = (make(name, fine, "f4") for name in ("rise_x", "rise_y"))
        self.highest = make("highest", coarse, "f4")
        self.highest[:] = -np.inf
        self.marks = make("marks", coarse, "u1")
        self.filled = make("filled", grids.spaced.window.shape, "u1")
        self.strip, self.strip_points = (
            make(name, (STRIPS, *coarse), "u4") for name in ("strip", "strip_points")
        )
        self.strip_low, self.strip_sum = (
            make(name, (STRIPS, *coarse), "f4") for name in ("strip_low", "strip_sum")
        )

    def add(self, part: PointCloud, frame: Frame) -> None:
        """Add a part of the points, before the planes are made."""
        used, is_made = ~part.withheld, self._made.made(part)
        self.counts.add(part, used, is_made)
        self._made.add(part, used)
        self._repeated.add(part)
        x, y, z = part.points(used, frame)
        place, row, column = self.grids.fine.places(x, y)
        coarse = self._coarse(row, column)
        np.maximum.at(self.highest.reshape(-1), coarse, z.astype(np.float32))
        is_water = ((part.classification == WATER) & ~is_made)[used]
        _mark(self.marks, coarse[is_water], WET)
        _mark(self.filled, self.grids.spaced.places(x[is_water], y[is_water])[0], WET)
        _mark(self.marks, coarse[(part.classification == _BUILDING)[used]], BUILT)
        real = _real(part, is_made)[used]
        if part.strip is not None:
            last = (part.return_number >= part.number_of_returns)[used]
            heights = np.where(last, z, np.inf)[real]
            self._add_strips(coarse[real], part.strip[used][real], heights)
        ground = real & self._ground.points_of(part, self._ground.ground_classes)[used]
        east, north = self.grids.fine.from_centres(x, y, row, column)
        sums = ((self._x, east), (self._y, north), (self._z, z))
        values = ((cells, value[ground]) for cells, value in sums)
        _add(place[ground], (self._number, None), *values)

    def _add_strips(self, coarse: np.ndarray, strip: np.ndarray, heights: np.ndarray) -> None:
        """Add strips to the cells of their points, with their lowest points."""
        pairs, of_pair = np.unique(coarse << 16 | strip, return_inverse=True)
        lowest = np.full(len(pairs), np.inf)
        np.minimum.at(lowest, of_pair, heights)
        cells, names = pairs >> 16, (pairs & 0xFFFF).astype(np.uint32) + 1
        for slot in range(STRIPS):
            strips, low = self.strip[slot].reshape(-1), self.strip_low[slot].reshape(-1)
            free = np.flatnonzero(strips[cells] == 0)
            # The first of several strips of a cell takes it.
            _, first = np.unique(cells[free], return_index=True)
            new = free[first]
            strips[cells[new]], low[cells[new]] = names[new], np.inf
            mine = strips[cells] == names
            low[cells[mine]] = np.minimum(low[cells[mine]], lowest[mine])
            cells, names, lowest = cells[~mine], names[~mine], lowest[~mine]

    def make_planes(self, progress: Progress = SILENT) -> None:
        """Make planes of the ground round the cells with points, when all points are added."""
        self._repeated.find()
        self._leave_out_strips()
        self.counts.shared = self._repeated.shared
        self.counts.duplicates = self._repeated.duplicates
        (rows, columns), size = self.grids.fine.window.shape, self.grids.fine.size
        planes_of = self._height, self._rise_x, self._rise_y
        for south, west in itertools.product(range(0, rows, _TILE), range(0, columns, _TILE)):
            low, left = (max(start - WINDOWS[-1], 0) for start in (south, west))
            high, right = south + _TILE + WINDOWS[-1], west + _TILE + WINDOWS[-1]
            around = slice(low, min(high, rows)), slice(left, min(right, columns))
            filled = twice(self._has_points, around)
            wanted = np.zeros(filled.shape, dtype=bool)
            own = slice(south - low, south - low + _TILE), slice(west - left, west - left + _TILE)
            wanted[own] = filled[own]
            if wanted.any():
                sums = (self._number, self._x, self._y, self._z)
                number, *totals = (values[around] for values in sums)
                row, column, found = planes(number, totals, size, filled, wanted)
                for values, array in zip(found, planes_of):
                    array[row + low, column + left] = values
            progress(min(south + _TILE, rows) / rows)

    def _leave_out_strips(self) -> None:
        """Leave out source ids that only points have that were not measured."""
        self._no_strips = self._made.sources()
        self.counts.strips.difference_update(self._no_strips.tolist())
        for rows in self.grids.coarse.parts():
            strips = self.strip[:, rows]
            strips[np.isin(strips, self._no_strips + 1)] = 0

    def compare(self, part: PointCloud, frame: Frame) -> None:
        """Count a part of the points, and compare it with the planes."""
        is_made = self._made.made(part)
        if part.strip is not None:
            is_made |= np.isin(part.strip, self._no_strips)
        is_infilled = is_made & ~np.asarray(part.synthetic) & ~part.withheld
        self.counts.infilled += int(np.count_nonzero(is_infilled))
        used = _real(part, is_made) & ~self._repeated.among(part)
        x, y, z = part.points(used, frame)
        number, flagged = part.return_number[used], overlapping(part)[used]
        place, row, column = self.grids.fine.places(x, y)
        coarse = self._coarse(row, column)
        is_first = number <= 1
        spaced, _, _ = self.grids.spaced.places(x, y)
        for cells, where in ((self.marks, coarse), (self.filled, spaced)):
            _mark(cells, where[is_first & ~flagged], PULSE)
            _mark(cells, where[is_first & flagged], FLAGGED)
        ground = self._ground.points_of(part, self._ground.ground_classes)[used]
        rise_x, rise_y, height = (
            values.reshape(-1)[place] for values in (self._rise_x, self._rise_y, self._height)
        )
        east, north = self.grids.fine.from_centres(x, y, row, column)
        above = z - (height + rise_x * east) - rise_y * north
        _add(
            place, (self.points, ~flagged), (self.first, is_first & ~flagged),
            (self.ground_points, ground), (self.low, (above >= LOW[0]) & (above <= LOW[1])),
        )  # fmt: skip
        if part.strip is not None:
            # Some files have return numbers, but no numbers of returns.
            of = np.maximum(part.number_of_returns[used], number)
            _mark(self.marks, coarse[of > 1], ROUGH)
            last = (number >= of) & ~np.isnan(above)
            reach = _NEAR + (np.abs(rise_x) + np.abs(rise_y)) * self.grids.coarse.size
            columns = (values[last] for values in (coarse, part.strip[used], z - reach, above))
            self._sum_strips(*columns)

    def _sum_strips(
        self, coarse: np.ndarray, strip: np.ndarray, bottom: np.ndarray, above: np.ndarray
    ) -> None:
        """Add points to their strips, if the lowest of the strip is not below their `bottom`."""
        names = strip.astype(np.uint32) + 1
        for slot in range(STRIPS):
            mine = self.strip[slot].reshape(-1)[coarse] == names
            near = mine & (bottom <= self.strip_low[slot].reshape(-1)[coarse])
            sums = (self.strip_points[slot], None), (self.strip_sum[slot], above[near])
            _add(coarse[near], *sums)

    def surveyed(self, rows: slice, is_coarse: bool) -> Iterator[Rectangle]:
        """Yield rectangles that hold the survey in some rows; the first row is even."""
        scale = 1 if is_coarse else 2
        for part in parts_with(self.extent.inside[rows.start // scale : rows.stop // scale], 0):
            row, column = part.core
            yield (
                slice(rows.start + scale * row.start, rows.start + scale * row.stop),
                slice(scale * column.start, scale * column.stop),
            )

    def values(self, make: Make, there: Rectangle, is_coarse: bool) -> np.ndarray:
        """Return values that `make` computes of a rectangle of cells; NaN outside the survey."""
        inside = self.extent.inside
        inside = inside[there] if is_coarse else twice(inside, there)
        return np.where(inside, make(self, there), np.nan)

    def rows_of(self, make: Make, rows: slice, is_coarse: bool) -> np.ndarray:
        """Return values that `make` computes of some rows; NaN outside the survey."""
        grid = self.grids.coarse if is_coarse else self.grids.fine
        found = np.full((rows.stop - rows.start, grid.window.columns), np.nan)
        for there in self.surveyed(rows, is_coarse):
            own = slice(there[0].start - rows.start, there[0].stop - rows.start)
            found[own, there[1]] = self.values(make, there, is_coarse)
        return found

    def reduced(
        self, make: Make, step: int, is_coarse: bool = False, greatest: bool = False
    ) -> np.ndarray:
        """Return the means, or the greatest, of values that `make` computes in squares of `step`
        cells, from south to north; NaN for no value.
        """
        grid = self.grids.coarse if is_coarse else self.grids.fine
        found = np.full([-(-count // step) for count in grid.window.shape], np.nan)
        for rows in grid.parts(2 * step):
            for there in self.surveyed(rows, is_coarse):
                squares = tuple(slice(side.start // step, -(-side.stop // step)) for side in there)
                whole = tuple(
                    slice(step * side.start, min(step * side.stop, count))
                    for side, count in zip(squares, grid.window.shape)
                )
                values = self.values(make, whole, is_coarse)
                found[squares] = reduced(values, step, greatest)
        return found

    def _coarse(self, row: np.ndarray, column: np.ndarray) -> np.ndarray:
        return (row >> 1) * self.grids.coarse.window.columns + (column >> 1)

    @cached_property
    def _has_points(self) -> np.ndarray:
        """Which coarse cells have points, when all are added."""
        return self.highest > -np.inf

    @cached_property
    def extent(self) -> Extent:
        """Where the survey lies, when all points are compared."""
        from scipy import ndimage

        window = self.grids.coarse.window
        side = max(round(SQUARE / self.grids.coarse.size), 1)
        # Squares are counted from (0, 0), too: the first may begin before the first cell.
        before = window.row % side, window.column % side
        margins = [(start, -(start + count) % side) for start, count in zip(before, window.shape)]
        own = tuple(slice(start, start + count) for start, count in zip(before, window.shape))

        def in_squares(values: np.ndarray) -> np.ndarray:
            """Return whether any value in squares of cells is true."""
            padded = np.pad(values, margins)
            squares = padded.reshape(padded.shape[0] // side, side, -1, side)
            return np.logical_or.reduce(squares, axis=(1, 3))

        inside = ndimage.binary_fill_holes(in_squares(self._has_points))
        wet, flagged, pulses = (in_squares(self.marks & bit > 0) for bit in (WET, FLAGGED, PULSE))
        inner = ndimage.binary_erosion(inside, np.ones((3, 3)))
        if not inner.any():
            inner = inside
        return Extent(
            *(
                squares.repeat(side, axis=0).repeat(side, axis=1)[own]
                for squares in (inside, inner, inner & ~wet, inner & ~(flagged & ~pulses))
            )
        )


# Computes values of a rectangle of cells.
Make = Callable[[QualityCells, Rectangle], np.ndarray]


def _real(part: PointCloud, is_made: np.ndarray) -> np.ndarray:
    """Return the points that count: measured ones that are neither withheld nor noise."""
    return ~(part.withheld | is_made | np.isin(part.classification, NOISE))


def _add(place: np.ndarray, *sums: tuple[np.ndarray, np.ndarray | None]) -> None:
    """Add values, or 1 for None, to cells, which can occur several times in `place`."""
    places, back = np.unique(place, return_inverse=True)
    for cells, values in sums:
        total = np.bincount(back, weights=values, minlength=len(places))
        cells.reshape(-1)[places] += total.astype(cells.dtype)


def _mark(cells: np.ndarray, place: np.ndarray, bit: int) -> None:
    """Set a bit of cells."""
    cells.reshape(-1)[place] |= bit


def twice(values: np.ndarray, there: Rectangle) -> np.ndarray:
    """Return values of coarse cells for a rectangle of fine cells."""
    coarse = values[tuple(slice(side.start // 2, -(-side.stop // 2)) for side in there)]
    inner = (slice(side.start % 2, side.start % 2 + side.stop - side.start) for side in there)
    return coarse.repeat(2, axis=0).repeat(2, axis=1)[tuple(inner)]
