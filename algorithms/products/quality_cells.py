"""Cells of a survey of any size, to which points are added part by part.

All files are read twice: once to count points and to add up their ground, and once to compare
points with planes through the ground of their surroundings. Cells do not depend on the files or on
their order, so there are no seams.
"""

from __future__ import annotations

import math
import shutil
from dataclasses import dataclass, field
from pathlib import Path
from typing import Iterator, NamedTuple

import numpy as np

from ..core.errors import BareEarthError
from ..core.points import Frame
from ..core.progress import SILENT, Progress
from ..grids.cell_window import CellWindow
from ..las.cloud import PointCloud
from ..survey.ground_classes import GroundClasses
from .raster_grid import MOST_CELLS

NOISE, WATER = (7, 18), 9
# Bits of the cells in which first returns are looked for.
FIRST, WET = 1, 2
# Flight strips that are told apart in a cell.
STRIPS = 4
# Bytes for a cell, and up to how many cells they are held in memory.
_BYTES, _MOST_IN_MEMORY = 56, 20_000_000
# Cells round a cell whose ground makes its plane: the first that hold enough points.
_WINDOWS, _LEAST_POINTS, _LEAST_SPREAD = (1, 2, 4, 10), 6, 0.02
# Rows of cells whose planes are made together.
_ROWS_TOGETHER = 1 << 21
# Heights above the ground of low vegetation, and up to which strips are compared, in metres.
LOW = (0.2, 2.0)
_NEAR = 0.5


class Store:
    """Makes arrays, in memory or in files of a folder if they are large.

    Parameters
    ----------
    folder : Path
        A temporary folder.
    cells : int
        Number of cells of the survey.

    Raises
    ------
    BareEarthError
        If there are too many cells, or the disk has no space for them.
    """

    def __init__(self, folder: Path, cells: int) -> None:
        self._folder = None if cells <= _MOST_IN_MEMORY else folder
        if cells > MOST_CELLS:
            raise BareEarthError(
                f"The rasters would have {cells:,} cells. Choose a larger cell size, or remove"
                " points with stray coordinates."
            )
        if self._folder and shutil.disk_usage(folder).free < _BYTES * cells:
            raise BareEarthError(
                f"{cells:,} cells need {_BYTES * cells / 1e9:.0f} GB on the disk of {folder.parent}"
                " while they are counted. Free some space, or choose a larger cell size."
            )

    def array(self, name: str, shape: tuple[int, ...], kind: str) -> np.ndarray:
        """Return an array of zeros."""
        if self._folder is None:
            return np.zeros(shape, dtype=kind)
        return np.memmap(self._folder / f"{name}.cells", dtype=kind, mode="w+", shape=shape)


class Sizes(NamedTuple):
    """The grids of a survey, with cells that are counted from (0, 0) of the CRS.

    Attributes
    ----------
    cell, spacing : float
        Side in metres of a cell, and of the cells in which first returns are looked for.
    fine, coarse, filled : CellWindow
        Cells of that side; of twice that side; and the cells in which first returns are looked for.
    """

    cell: float
    spacing: float
    fine: CellWindow
    coarse: CellWindow
    filled: CellWindow

    @classmethod
    def over(cls, box: tuple[float, float, float, float], cell: float, spacing: float) -> Sizes:
        """Return the grids that cover a box in metres."""
        coarse = CellWindow.around(box, 2 * cell)
        fine = CellWindow(*(2 * each for each in coarse))
        return cls(cell, spacing, fine, coarse, CellWindow.around(box, spacing))


@dataclass
class Counts:
    """What is counted of all points.

    Attributes
    ----------
    points, withheld : int
        All points, and those that the producer excluded.
    classes, returns : numpy.ndarray of int64, shape (256,)
        Points of each class, and of each return number; withheld points left out.
    strips : set of int
        Flight strips (point source ids).
    """

    points: int = 0
    withheld: int = 0
    classes: np.ndarray = field(default_factory=lambda: np.zeros(256, dtype=np.int64))
    returns: np.ndarray = field(default_factory=lambda: np.zeros(256, dtype=np.int64))
    strips: set[int] = field(default_factory=set)

    def add(self, part: PointCloud, used: np.ndarray) -> None:
        """Count the points of a part; `used` are those that are not withheld."""
        self.points += part.count
        self.withheld += part.count - int(np.count_nonzero(used))
        self.classes += np.bincount(part.classification[used], minlength=256)
        self.returns += np.bincount(part.return_number[used], minlength=256)
        if part.strip is not None:
            self.strips.update(np.unique(part.strip[used]).tolist())


class QualityCells:
    """The cells of a survey.

    Parameters
    ----------
    sizes : Sizes
        Their grids.
    store : Store
        Makes their arrays.
    ground : GroundClasses
        Which points are ground.

    Attributes
    ----------
    counts : Counts
        What is counted of all points.
    points, first, ground_points, low : numpy.ndarray of uint32, shape (rows, columns)
        Numbers of points, first returns, ground points and points of low vegetation in each cell;
        rows from south to north, as everywhere here. Noise and withheld points are left out.
    highest : numpy.ndarray of float32, shape (rows / 2, columns / 2)
        Height of the highest point in metres, minus infinity for none; withheld points left out.
    filled : numpy.ndarray of uint8
        `FIRST` and `WET`, in the cells of `Sizes.filled`.
    wet : numpy.ndarray of uint8, shape (rows / 2, columns / 2)
        1 where a point of water lies.
    strip, strip_points, strip_sum : numpy.ndarray, shape (4, rows / 2, columns / 2)
        Up to four strips of a cell (point source id + 1, 0 for none), with number and sum of the
        heights of their last returns near the ground, in metres above it.
    rough : numpy.ndarray of uint8, shape (rows / 2, columns / 2)
        1 where strips cannot be compared well: on slopes, and where pulses have several returns.
    """

    def __init__(self, sizes: Sizes, store: Store, ground: GroundClasses) -> None:
        self.sizes, self._ground, self.counts = sizes, ground, Counts()
        fine, coarse = sizes.fine.shape, sizes.coarse.shape
        make = store.array
        self.points, self.first, self.ground_points, self.low = (
            make(name, fine, "u4") for name in ("points", "first", "ground", "low")
        )
        # Sums of x and y of ground points from the centre of their cell, and of their heights.
        self._x, self._y = (make(name, fine, "f4") for name in ("x", "y"))
        self._z = make("z", fine, "f8")
        self._rise_x, self._rise_y = (make(name, fine, "f4") for name in ("rise_x", "rise_y"))
        self.highest = make("highest", coarse, "f4")
        self.highest[:] = -np.inf
        self.wet, self.rough = (make(name, coarse, "u1") for name in ("wet", "rough"))
        self.filled = make("filled", sizes.filled.shape, "u1")
        self.strip = make("strip", (STRIPS, *coarse), "u4")
        self.strip_points = make("strip_points", (STRIPS, *coarse), "u4")
        self.strip_sum = make("strip_sum", (STRIPS, *coarse), "f4")

    def count(self, part: PointCloud, frame: Frame) -> None:
        """Add a part of the points, before the planes are made."""
        used = ~part.withheld
        self.counts.add(part, used)
        x, y, z = part.points(used, frame)
        classes, number = part.classification[used], part.return_number[used]
        place, row, column = self._places(x, y, self.sizes.fine, self.sizes.cell)
        coarse = self._coarse(row, column)
        np.maximum.at(self.highest.reshape(-1), coarse, z.astype(np.float32))
        real = ~np.isin(classes, NOISE)
        is_first = real & (number <= 1)
        _add(self.points, place[real])
        _add(self.first, place[is_first])
        self.wet.reshape(-1)[coarse[classes == WATER]] = 1
        place_filled, _, _ = self._places(x, y, self.sizes.filled, self.sizes.spacing)
        cells = self.filled.reshape(-1)
        cells[place_filled[is_first]] |= FIRST
        cells[place_filled[classes == WATER]] |= WET
        ground = self._ground.points_of(part, self._ground.ground_classes)[used]
        place, size, fine = place[ground], self.sizes.cell, self.sizes.fine
        _add(self.ground_points, place)
        _add(self._x, place, x[ground] - (fine.column + column[ground] + 0.5) * size)
        _add(self._y, place, y[ground] - (fine.row + row[ground] + 0.5) * size)
        _add(self._z, place, z[ground])

    def make_planes(self, progress: Progress = SILENT) -> None:
        """Replace the sums of the ground by a plane for each cell, when all points are counted."""
        rows, columns = self.sizes.fine.shape
        size, margin = self.sizes.cell, _WINDOWS[-1]
        step = max(_ROWS_TOGETHER // columns, 2 * margin)
        heights = self._z
        kept = np.zeros((0, columns))
        for start in range(0, rows, step):
            low, high = max(start - margin, 0), min(start + step + margin, rows)
            inner = slice(start - low, min(start + step, rows) - low)
            # The sums of the rows before were already replaced, but are still needed.
            z = np.array(heights[low:high])
            z[: start - low] = kept[len(kept) - (start - low) :]
            kept = z[: inner.stop][-margin:].copy()
            count, x, y = (each[low:high] for each in (self.ground_points, self._x, self._y))
            height, rise_x, rise_y = _planes(count, x, y, z, size)
            there = slice(start, start + inner.stop - inner.start)
            heights[there] = height[inner]
            self._rise_x[there], self._rise_y[there] = rise_x[inner], rise_y[inner]
            progress(there.stop / rows)

    def compare(self, part: PointCloud, frame: Frame) -> None:
        """Compare a part of the points with the planes."""
        used = ~part.withheld & ~np.isin(part.classification, NOISE)
        x, y, z = part.points(used, frame)
        place, row, column = self._places(x, y, self.sizes.fine, self.sizes.cell)
        coarse, size, fine = self._coarse(row, column), self.sizes.cell, self.sizes.fine
        rise_x, rise_y, height = (
            each.reshape(-1)[place] for each in (self._rise_x, self._rise_y, self._z)
        )
        height = height + rise_x * (x - (fine.column + column + 0.5) * size)
        above = z - height - rise_y * (y - (fine.row + row + 0.5) * size)
        _add(self.low, place[(above >= LOW[0]) & (above <= LOW[1])])
        if part.strip is None:
            return
        number, of = part.return_number[used], part.number_of_returns[used]
        last = (number >= of) & (np.abs(above) <= _NEAR)
        is_rough = (of > 1) | (np.hypot(rise_x, rise_y) > math.tan(math.radians(10.0)))
        self.rough.reshape(-1)[coarse[is_rough]] = 1
        self._add_strips(coarse, part.strip[used], np.where(last, above, np.nan))

    def _add_strips(self, coarse: np.ndarray, strip: np.ndarray, above: np.ndarray) -> None:
        """Add the points of strips to their cells."""
        pairs, which = np.unique(coarse << 16 | strip, return_inverse=True)
        number = np.bincount(which[~np.isnan(above)], minlength=len(pairs))
        total = np.bincount(which, weights=np.nan_to_num(above), minlength=len(pairs))
        cells, names = pairs >> 16, (pairs & 0xFFFF).astype(np.uint32) + 1
        for slot in range(STRIPS):
            strips = self.strip[slot].reshape(-1)
            free = np.flatnonzero(strips[cells] == 0)
            # The first of several strips of a cell takes it.
            _, first = np.unique(cells[free], return_index=True)
            strips[cells[free[first]]] = names[free[first]]
            mine = strips[cells] == names
            self.strip_points[slot].reshape(-1)[cells[mine]] += number[mine].astype(np.uint32)
            self.strip_sum[slot].reshape(-1)[cells[mine]] += total[mine].astype(np.float32)
            cells, names, number, total = (each[~mine] for each in (cells, names, number, total))

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


def _planes(
    count: np.ndarray, x: np.ndarray, y: np.ndarray, z: np.ndarray, size: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return planes through the ground round cells: height at their centre, and two slopes.

    Parameters
    ----------
    count, x, y, z : numpy.ndarray, shape (rows, columns)
        Number of ground points of each cell, sums of x and y from its centre, and of z.
    size : float
        Side of a cell.

    Returns
    -------
    height, rise_x, rise_y : numpy.ndarray of float64, shape (rows, columns)
        NaN where there is no ground within ten cells.
    """
    height = np.full(count.shape, np.nan)
    rises = np.zeros((2, *count.shape))
    some = np.maximum(count, 1)
    number = count.astype(np.float64)
    x, y, z = (np.where(count > 0, each / some, 0.0) for each in (x, y, z))
    base = float(z[count > 0].min()) if count.any() else 0.0
    z = np.where(count > 0, z - base, 0.0)
    for window in _WINDOWS:
        left = np.isnan(height)
        if not left.any():
            break
        sums = _window_sums(number, x, y, z, size, window)
        n, sx, sy, sz, sxx, sxy, syy, sxz, syz = (each[left] for each in sums)
        safe = np.maximum(n, 1.0)
        mx, my, mz = sx / safe, sy / safe, sz / safe
        xx, xy, yy = sxx / safe - mx * mx, sxy / safe - mx * my, syy / safe - my * my
        xz, yz = sxz / safe - mx * mz, syz / safe - my * mz
        free = xx * yy - xy * xy
        is_good = (n >= _LEAST_POINTS) & (free > _LEAST_SPREAD * (xx + yy) ** 2) & (xx + yy > 0)
        with np.errstate(divide="ignore", invalid="ignore"):
            a, b = (yy * xz - xy * yz) / free, (xx * yz - xy * xz) / free
        a, b = np.where(is_good, a, 0.0), np.where(is_good, b, 0.0)
        if window == _WINDOWS[-1]:
            is_good |= n > 0
        height[left] = np.where(is_good, mz - a * mx - b * my + base, np.nan)
        rises[0][left], rises[1][left] = a, b
    return height, rises[0], rises[1]


def _window_sums(
    number: np.ndarray, x: np.ndarray, y: np.ndarray, z: np.ndarray, size: float, window: int
) -> Iterator[np.ndarray]:
    """Yield sums over squares of cells, with x and y from the centre of the middle cell."""
    from scipy import ndimage

    ones = np.ones(2 * window + 1)
    steps = np.arange(window, -window - 1, -1) * size  # convolutions turn their weights round

    def over(values: np.ndarray, across: np.ndarray = ones, up: np.ndarray = ones) -> np.ndarray:
        once = ndimage.convolve1d(values, across, axis=1, mode="constant")
        return ndimage.convolve1d(once, up, axis=0, mode="constant")

    nx, ny, nz = number * x, number * y, number * z
    yield over(number)
    yield over(nx) + over(number, across=steps)
    yield over(ny) + over(number, up=steps)
    yield over(nz)
    yield over(nx * x) + 2 * over(nx, across=steps) + over(number, across=steps**2)
    yield over(nx * y) + over(nx, up=steps) + over(ny, across=steps) + over(number, steps, steps)
    yield over(ny * y) + 2 * over(ny, up=steps) + over(number, up=steps**2)
    yield over(nx * z) + over(nz, across=steps)
    yield over(ny * z) + over(nz, up=steps)
