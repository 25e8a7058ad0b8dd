"""Cells of a survey of any size, to which points are added part by part.

All files are read twice: once to add up the ground and to find points that repeat, and once to
count the others, and to compare them with planes through the ground of their surroundings. Cells do
not depend on the files or on their order, so there are no seams.
"""

from __future__ import annotations

import shutil
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ...core.errors import BareEarthError
from ...core.points import Frame
from ...core.progress import SILENT, Progress
from ...grids.cell_window import CellWindow
from ...las.cloud import PointCloud
from ...rasters.cell_grid import MOST_CELLS
from ...survey.ground_classes import GroundClasses
from ...survey.kept_classes import overlapping
from ...survey.repeated_points import RepeatedPoints
from .planes import WINDOWS, Sums, planes

NOISE, WATER = (7, 18), 9
# Bits of cells: a first return that counts as a pulse; water; a first return with the flag of
# overlap; a pulse with several returns.
PULSE, WET, FLAGGED, ROUGH = 1, 2, 4, 8
# Flight strips that are told apart in a cell.
STRIPS = 4
# Bytes for a cell and a point, and up to how many of them they are held in memory.
_BYTES, _BYTES_A_POINT, _MOST_IN_MEMORY = 64, 9, 20_000_000
# Rows of cells whose planes are made together.
_ROWS_TOGETHER = 1 << 21
# Heights above the ground of low vegetation. Points are compared up to this height, in metres,
# above the lowest of their strip in the cell.
LOW = (0.2, 2.0)
_NEAR = 0.5


class Store:
    """Makes arrays, in memory or in files of a temporary folder if cells and points are many; an
    error says if there are too many, or the disk has no space for them.
    """

    def __init__(self, folder: Path, cells: int, points: int) -> None:
        self._folder = None if max(cells, points) <= _MOST_IN_MEMORY else folder
        size = _BYTES * cells + _BYTES_A_POINT * points
        if cells > MOST_CELLS:
            raise BareEarthError(
                f"The rasters would have {cells:,} cells. Choose a larger cell size, or remove"
                " points with stray coordinates."
            )
        if self._folder and shutil.disk_usage(folder).free < size:
            raise BareEarthError(
                f"{cells:,} cells and {points:,} points need {size / 1e9:.0f} GB on the disk of"
                f" {folder.parent} while they are counted. Free some space, or choose a larger cell"
                " size."
            )

    def array(self, name: str, shape: tuple[int, ...], kind: str) -> np.ndarray:
        """Return an array of zeros."""
        if self._folder is None:
            return np.zeros(shape, dtype=kind)
        return np.memmap(self._folder / f"{name}.cells", dtype=kind, mode="w+", shape=shape)


class Sizes(NamedTuple):
    """The grids of a survey, with cells that are counted from (0, 0) of the CRS."""

    cell: float  # metres
    spacing: float  # metres: side of the cells in which first returns are looked for
    fine: CellWindow  # cells of side `cell`
    coarse: CellWindow  # cells of twice that side
    filled: CellWindow  # cells of side `spacing`

    @classmethod
    def over(cls, box: tuple[float, float, float, float], cell: float, spacing: float) -> Sizes:
        """Return the grids that cover a box in metres."""
        coarse = CellWindow.around(box, 2 * cell)
        fine = CellWindow(*(2 * each for each in coarse))
        return cls(cell, spacing, fine, coarse, CellWindow.around(box, spacing))


class Marks(NamedTuple):
    """What the flags of points say; boolean arrays, shape (n,)."""

    used: np.ndarray  # not withheld
    synthetic: np.ndarray  # made and not measured; not withheld
    flagged: np.ndarray  # of overlap; not withheld
    real: np.ndarray  # measured: neither withheld nor synthetic, and no noise

    @classmethod
    def of(cls, part: PointCloud, all_synthetic: bool = False) -> Marks:
        """Return what the flags of a part of the points say; if all are synthetic, all are real."""
        used = ~part.withheld
        synthetic = np.zeros(part.count, bool) if part.synthetic is None else part.synthetic
        real = used & (all_synthetic | ~synthetic) & ~np.isin(part.classification, NOISE)
        return cls(used, used & synthetic, used & overlapping(part), real)


@dataclass
class Counts:
    """What is counted of all points, without those withheld but in `points` and `withheld`."""

    points: int = 0
    withheld: int = 0  # excluded by the producer
    synthetic: int = 0  # made and not measured
    flagged: int = 0  # of overlap, by the flag, or by class 12 in point formats 0 to 5
    shared: int = 0  # that another file holds as well
    duplicates: int = 0  # others that repeat one of their file
    classes: np.ndarray = field(default_factory=lambda: np.zeros(256, dtype=np.int64))
    returns: np.ndarray = field(default_factory=lambda: np.zeros(256, dtype=np.int64))
    strips: set[int] = field(default_factory=set)  # point source ids

    def add(self, part: PointCloud, marks: Marks) -> None:
        """Count the points of a part."""
        used = marks.used
        self.points += part.count
        self.withheld += part.count - int(np.count_nonzero(used))
        self.synthetic += int(np.count_nonzero(marks.synthetic))
        self.flagged += int(np.count_nonzero(marks.flagged))
        self.classes += np.bincount(part.classification[used], minlength=256)
        self.returns += np.bincount(part.return_number[used], minlength=256)
        if part.strip is not None:
            self.strips.update(np.unique(part.strip[used]).tolist())


class QualityCells:
    """The cells of a survey; synthetic points count only if all are, as those of images."""

    # points, first, ground_points, low: uint32 (rows, columns), numbers of points, first returns,
    # ground points and points of low vegetation in each cell; rows from south to north, as
    # everywhere here. Noise, withheld and synthetic points are left out, and points that repeat
    # others. Points of overlap are left out of points and first returns.
    # highest: float32 (rows / 2, columns / 2), height of the highest point in metres that is not
    # withheld, minus infinity for none.
    # filled: uint8, `PULSE`, `WET` and `FLAGGED`, in the cells of `Sizes.filled`. marks: uint8
    # (rows / 2, columns / 2), `PULSE`, `WET`, `FLAGGED` and `ROUGH`.
    # strip, strip_low, strip_points, strip_sum: (4, rows / 2, columns / 2), up to four strips of a
    # cell (point source id + 1, 0 for none), with the height of their lowest last return, and with
    # number and sum of the heights of last returns near to it, in metres above the common plane of
    # the ground.

    def __init__(
        self,
        sizes: Sizes,
        store: Store,
        ground: GroundClasses,
        repeated: RepeatedPoints,
        all_synthetic: bool = False,
    ) -> None:
        self.sizes, self._ground, self._repeated = sizes, ground, repeated
        self._all_synthetic = all_synthetic
        self.counts = Counts()
        fine, coarse = sizes.fine.shape, sizes.coarse.shape
        make = store.array
        self.points, self.first, self.ground_points, self.low, self._number = (
            make(name, fine, "u4") for name in ("points", "first", "ground", "low", "number")
        )
        # Sums of x and y of ground points from the centre of their cell, and of their heights.
        self._x, self._y = (make(name, fine, "f4") for name in ("x", "y"))
        self._z = make("z", fine, "f8")
        self._rise_x, self._rise_y = (make(name, fine, "f4") for name in ("rise_x", "rise_y"))
        self.highest = make("highest", coarse, "f4")
        self.highest[:] = -np.inf
        self.marks = make("marks", coarse, "u1")
        self.filled = make("filled", sizes.filled.shape, "u1")
        self.strip, self.strip_points = (
            make(name, (STRIPS, *coarse), "u4") for name in ("strip", "strip_points")
        )
        self.strip_low, self.strip_sum = (
            make(name, (STRIPS, *coarse), "f4") for name in ("strip_low", "strip_sum")
        )

    def add(self, part: PointCloud, frame: Frame) -> None:
        """Add a part of the points, before the planes are made."""
        marks = Marks.of(part, self._all_synthetic)
        self.counts.add(part, marks)
        self._repeated.add(part)
        used = marks.used
        x, y, z = part.points(used, frame)
        place, row, column = self._places(x, y, self.sizes.fine, self.sizes.cell)
        coarse = self._coarse(row, column)
        np.maximum.at(self.highest.reshape(-1), coarse, z.astype(np.float32))
        is_water = part.classification[used] == WATER
        _mark(self.marks, coarse[is_water], WET)
        _mark(
            self.filled, self._places(x, y, self.sizes.filled, self.sizes.spacing)[0][is_water], WET
        )
        real = marks.real[used]
        if part.strip is not None:
            last = (part.return_number >= part.number_of_returns)[used]
            heights = np.where(last, z, np.inf)[real]
            self._add_strips(coarse[real], part.strip[used][real], heights)
        ground = real & self._ground.points_of(part, self._ground.ground_classes)[used]
        place, size, fine = place[ground], self.sizes.cell, self.sizes.fine
        _add(self._number, place)
        _add(self._x, place, x[ground] - (fine.column + column[ground] + 0.5) * size)
        _add(self._y, place, y[ground] - (fine.row + row[ground] + 0.5) * size)
        _add(self._z, place, z[ground])

    def _add_strips(self, coarse: np.ndarray, strip: np.ndarray, heights: np.ndarray) -> None:
        """Add strips to the cells of their points, with their lowest points."""
        pairs, which = np.unique(coarse << 16 | strip, return_inverse=True)
        lowest = np.full(len(pairs), np.inf)
        np.minimum.at(lowest, which, heights)
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
            cells, names, lowest = (each[~mine] for each in (cells, names, lowest))

    def make_planes(self, progress: Progress = SILENT) -> None:
        """Replace the sums of the ground by planes of the cells with points, when all are added."""
        self._repeated.find()
        self.counts.shared, self.counts.duplicates = (
            self._repeated.shared, self._repeated.duplicates
        )  # fmt: skip
        rows, columns = self.sizes.fine.shape
        size, margin = self.sizes.cell, WINDOWS[-1]
        step = max(_ROWS_TOGETHER // columns // 2 * 2, 2 * margin)
        before = np.zeros((0, columns))
        for start in range(0, rows, step):
            low, stop = max(start - margin, 0), min(start + step, rows)
            high = min(stop + margin, rows)
            number = np.array(self._number[low:high], dtype=np.float64)
            some = np.maximum(number, 1.0)
            # The sums of the rows before were already replaced, but are still needed.
            z = np.array(self._z[low:high])
            z[: start - low] = before[len(before) - (start - low) :]
            before = z[: stop - low][-margin:].copy()
            x, y = (each[low:high] / some for each in (self._x, self._y))
            wanted = np.zeros(number.shape, dtype=bool)
            wanted[start - low : stop - low] = twice(self.highest > -np.inf, slice(start, stop))
            found = planes(Sums(number, x, y, z / some), size, wanted)
            places = np.flatnonzero(wanted) + low * columns
            for values, array in zip(found, (self._z, self._rise_x, self._rise_y)):
                array.reshape(-1)[places] = values
            progress(stop / rows)

    def compare(self, part: PointCloud, frame: Frame) -> None:
        """Count a part of the points, and compare it with the planes."""
        marks = Marks.of(part, self._all_synthetic)
        used = marks.real & ~self._repeated.among(part)
        x, y, z = part.points(used, frame)
        number, flagged = part.return_number[used], marks.flagged[used]
        place, row, column = self._places(x, y, self.sizes.fine, self.sizes.cell)
        coarse = self._coarse(row, column)
        is_first = number <= 1
        _add(self.points, place[~flagged])
        _add(self.first, place[is_first & ~flagged])
        filled = self._places(x, y, self.sizes.filled, self.sizes.spacing)[0]
        for cells, where in ((self.marks, coarse), (self.filled, filled)):
            _mark(cells, where[is_first & ~flagged], PULSE)
            _mark(cells, where[is_first & flagged], FLAGGED)
        ground = self._ground.points_of(part, self._ground.ground_classes)[used]
        _add(self.ground_points, place[ground])
        size, fine = self.sizes.cell, self.sizes.fine
        rise_x, rise_y, height = (
            each.reshape(-1)[place] for each in (self._rise_x, self._rise_y, self._z)
        )
        height = height + rise_x * (x - (fine.column + column + 0.5) * size)
        above = z - height - rise_y * (y - (fine.row + row + 0.5) * size)
        _add(self.low, place[(above >= LOW[0]) & (above <= LOW[1])])
        if part.strip is not None:
            of = part.number_of_returns[used]
            _mark(self.marks, coarse[of > 1], ROUGH)
            last = (number >= of) & ~np.isnan(above)
            reach = _NEAR + (np.abs(rise_x) + np.abs(rise_y)) * 2 * size
            some = (each[last] for each in (coarse, part.strip[used], z - reach, above))
            self._sum_strips(*some)

    def _sum_strips(
        self, coarse: np.ndarray, strip: np.ndarray, bottom: np.ndarray, above: np.ndarray
    ) -> None:
        """Add points to their strips, if the lowest of the strip is not below their `bottom`."""
        names = strip.astype(np.uint32) + 1
        for slot in range(STRIPS):
            mine = self.strip[slot].reshape(-1)[coarse] == names
            near = mine & (bottom <= self.strip_low[slot].reshape(-1)[coarse])
            _add(self.strip_points[slot], coarse[near])
            _add(self.strip_sum[slot], coarse[near], above[near])

    def _coarse(self, row: np.ndarray, column: np.ndarray) -> np.ndarray:
        return (row >> 1) * self.sizes.coarse.columns + (column >> 1)

    @staticmethod
    def _places(
        x: np.ndarray, y: np.ndarray, window: CellWindow, size: float
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return number, row and column of the cells of points."""
        row, column = window.places(x, y, (0.0, 0.0), size)
        # The extent in a header may be slightly smaller than that of the points.
        row, column = np.clip(row, 0, window.rows - 1), np.clip(column, 0, window.columns - 1)
        return row * window.columns + column, row, column


def _add(cells: np.ndarray, place: np.ndarray, values: np.ndarray | None = None) -> None:
    """Add values, or 1, to cells, of which some are given several times."""
    which, back = np.unique(place, return_inverse=True)
    sums = np.bincount(back, weights=values, minlength=len(which))
    cells.reshape(-1)[which] += sums.astype(cells.dtype)


def _mark(cells: np.ndarray, place: np.ndarray, bit: int) -> None:
    """Set a bit of cells."""
    cells.reshape(-1)[place] |= bit


def twice(inside: np.ndarray, rows: slice) -> np.ndarray:
    """Return values of coarse cells for some rows of fine cells; the first row must be even."""
    coarse = inside[rows.start // 2 : -(-rows.stop // 2)]
    return coarse.repeat(2, axis=0)[: rows.stop - rows.start].repeat(2, axis=1)
