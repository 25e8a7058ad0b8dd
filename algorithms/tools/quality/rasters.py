"""The rasters of the quality of a survey, made from its cells."""

from __future__ import annotations

import itertools
import math
from pathlib import Path
from typing import Callable, Iterator, Mapping, NamedTuple

import numpy as np

from ...core.points import Frame
from ...core.progress import Progress
from ...grids.cells import are_inside
from ...grids.parts import parts_with
from ...grids.piece_grid import PieceGrid
from ...rasters import looks
from ...rasters.geotiff import NODATA, RasterGrid, check_cells
from ...rasters.looks import Categories, ColourSteps, Look, Ramp
from ...rasters.sparse import SIDE, RasterPart
from ...rasters.writing import RasterCells, write_geotiff
from ...report.pictures import HEIGHTS
from .cells import STRIPS, Make, QualityCells, Rectangle
from .planes import moments, plane_of

# Limits of the classes of differences between strips, in metres.
LIMITS = (0.08, 0.16)
_NO_BYTE = 255  # value of bytes without data
_LEAST_POINTS = 3  # of a strip in a cell that is compared
# Largest distance in metres of the lowest points of an even strip from a plane through those of the
# cells around. Edges of roofs, cars and single trees are uneven; a strip with an offset is even.
_UNEVEN = 0.25
# A difference that is farther than this, in metres, from the median of the cells around is at the
# edge of a roof or of a crown. Strips with an offset differ in many cells.
_FROM_AROUND = 0.25
_AROUND = 2  # cells to each side: 5 x 5
# Cells whose surroundings are looked at together.
_LOOKED_AT = 1 << 18
_STEEPEST = 45.0
_TOGETHER = 1 << 21  # cells that are written together
_BLUES = tuple(colour for _, colour in looks.DENSITY)


class QualityRaster(NamedTuple):
    """The declaration of a raster."""

    title: str
    shows: str  # what its cells mean
    make: Make  # returns NaN for no value
    look: Look
    is_coarse: bool = False  # its cells have twice the size
    kind: str = "float32"  # "float32" or "uint8"
    is_height: bool = False  # written in the vertical unit of the CRS; made in metres
    label: str = ""  # on the page, where that is not the title
    # Colours of the map on the page, from the least to the greatest value, or of classes of values,
    # which are counted from 0, with what they mean.
    colours: tuple[str, ...] = _BLUES
    class_of: Callable[[np.ndarray], np.ndarray] | None = None
    words: tuple[str, ...] = ()
    shows_greatest: bool = False  # where the map has larger cells; otherwise it shows their mean

    def grid(self, cells: QualityCells) -> PieceGrid:
        """Return the cells of the raster."""
        return cells.grids.coarse if self.is_coarse else cells.grids.fine


def _density(name: str) -> Make:
    return lambda cells, there: getattr(cells, name)[there] / cells.grids.fine.size**2


def _wider(there: Rectangle, margin: int) -> tuple[Rectangle, Rectangle]:
    """Return a rectangle with a margin, and the rectangle within this."""
    wide = tuple(slice(max(side.start - margin, 0), side.stop + margin) for side in there)
    sides = zip(there, wide)
    return wide, tuple(slice(own.start - w.start, own.stop - w.start) for own, w in sides)


def voids(cells: QualityCells, there: Rectangle) -> np.ndarray:
    """Return which cells are farther from the next cell with ground than allowed; boolean."""
    from scipy import ndimage

    size = cells.grids.fine.size
    margin = math.ceil(cells.void / size) + 1
    wide, inner = _wider(there, margin)
    empty = cells.ground_points[wide] == 0
    far = np.ones(empty.shape, dtype=bool)
    for part in parts_with(~empty, margin):
        apart = ndimage.distance_transform_edt(empty[part.around], sampling=size) > cells.void
        far[part.around] &= apart
    return far[inner]


def overlap(cells: QualityCells, there: Rectangle) -> np.ndarray:
    """Return the number of strips in cells."""
    return np.count_nonzero(cells.strip[(slice(None), *there)], axis=0)


def strip_differences(
    cells: QualityCells, there: Rectangle, steepest: float = _STEEPEST
) -> np.ndarray:
    """Return the range of the mean heights of strips in metres, on ground that is not steeper than
    some degrees; NaN without two even strips.
    """
    wide, inner = _wider(there, _AROUND)
    found = _of_even_strips(cells, wide, steepest)
    padded = np.pad(found, _AROUND, constant_values=np.nan)
    around = np.lib.stride_tricks.sliding_window_view(padded, (2 * _AROUND + 1,) * 2)
    row, column = np.nonzero(~np.isnan(found))
    for start in range(0, len(row), _LOOKED_AT):
        place = row[start : start + _LOOKED_AT], column[start : start + _LOOKED_AT]
        off = np.abs(found[place] - np.nanmedian(around[place], axis=(1, 2)))
        found[place] = np.where(off > _FROM_AROUND, np.nan, found[place])
    return found[inner]


def _of_even_strips(cells: QualityCells, there: Rectangle, steepest: float) -> np.ndarray:
    """Return the range of the means of the strips that are even; NaN where fewer than two are."""
    number, sums = (
        values[(slice(None), *there)] for values in (cells.strip_points, cells.strip_sum)
    )
    enough = number >= _LEAST_POINTS
    found = np.full(number.shape[1:], np.nan)
    rows, columns = np.nonzero(enough.sum(axis=0) > 1)
    south, west = (side.start for side in there)
    for start in range(0, len(rows), _LOOKED_AT):
        row, column = (values[start : start + _LOOKED_AT] for values in (rows, columns))
        is_known = enough[:, row, column] & _is_even(cells, row + south, column + west, steepest)
        means = sums[:, row, column] / np.maximum(number[:, row, column], 1)
        lowest = np.where(is_known, means, np.inf).min(axis=0)
        highest = np.where(is_known, means, -np.inf).max(axis=0)
        found[row, column] = np.where(is_known.sum(axis=0) > 1, highest - lowest, np.nan)
    return found


def _is_even(
    cells: QualityCells, row: np.ndarray, column: np.ndarray, steepest: float
) -> np.ndarray:
    """Return where each strip of some cells is even; boolean, shape (4, n)."""
    # The plane is fitted to the lowest points of the strip itself in 3 x 3 cells. So strips with an
    # offset count as even, and objects in single cells do not.
    (rows, columns), size = cells.grids.coarse.window.shape, cells.grids.coarse.size
    names, own = cells.strip[:, row, column], cells.strip_low[:, row, column]
    known = (names > 0) & np.isfinite(own)
    sums = np.zeros((9, STRIPS, len(row)))
    for down, right in itertools.product((-1, 0, 1), repeat=2):
        there = are_inside(row + down, column + right, (rows, columns))
        beside = np.clip(row + down, 0, rows - 1), np.clip(column + right, 0, columns - 1)
        for slot in range(STRIPS):
            strip, low = cells.strip[slot][beside], cells.strip_low[slot][beside]
            # The same strip can be in another slot there.
            n = known & (strip == names) & there & np.isfinite(low)
            z = np.subtract(low, own, out=np.zeros(n.shape), where=n)
            for total, moment in zip(sums, moments(n, right * size, down * size, z)):
                total += moment
    is_good, (height, rise_x, rise_y) = plane_of(sums)
    is_flat = np.hypot(rise_x, rise_y) <= math.tan(math.radians(steepest))
    return is_good & (np.abs(height) <= _UNEVEN) & is_flat


def _highest(cells: QualityCells, there: Rectangle) -> np.ndarray:
    heights = cells.highest[there]
    return np.where(np.isfinite(heights), heights, np.nan)


_DENSITY = Ramp(looks.DENSITY, low=0.0)
# From none to all of the strips of a cell.
_NUMBERS = tuple((number, str(number), colour) for number, (_, colour) in enumerate(looks.DENSITY))
_DIFFERENCES = ("#3a9d5d", "#f0c93a", "#c0262d")

QUALITY_RASTERS = {
    "pulse_density": QualityRaster(
        "Density of first returns", "First returns, 1/m2", _density("first"),
        Look(_DENSITY, 4, hides=3),
    ),
    "ground_density": QualityRaster(
        "Density of ground points", "Ground points, 1/m2", _density("ground_points"),
        Look(_DENSITY, 3, hides=2),
    ),
    "voids": QualityRaster(
        "Voids of the ground", "1 where ground points are far away", voids,
        Look(Categories(((1, "No ground near", "#c0262d"),)), 7), kind="uint8",
        colours=("#e4ecdf", "#c0262d"), class_of=lambda values: values > 0,
        words=("ground", "void"), shows_greatest=True,
    ),
    "low_vegetation": QualityRaster(
        "Density of low vegetation", "Points 0.2 to 2 m above the ground, 1/m2", _density("low"),
        Look(Ramp(looks.CANOPY, low=0.0), 2, hides=1),
    ),
    "overlap": QualityRaster(
        "Overlap of strips", "Number of strips", overlap, Look(Categories(_NUMBERS), 5, hides=1),
        True, "uint8", label=f"Overlap of strips (up to {STRIPS})",
        colours=("#ffffff", *_BLUES[1:]), class_of=np.rint,
        words=("no strip", "1 strip", "2 strips", "3 strips", "4 strips or more"),
    ),
    "strip_differences": QualityRaster(
        "Differences between strips", "Difference between strips, {unit}", strip_differences,
        Look(ColourSteps(LIMITS, _DIFFERENCES), 6), True, is_height=True, colours=_DIFFERENCES,
        class_of=lambda values: np.searchsorted(LIMITS, values, side="right"),
        words=("below 8 cm", "to 16 cm", "above"), shows_greatest=True,
    ),
    "surface_height": QualityRaster(
        "Maximum surface height", "Height, {unit}", _highest,
        Look(Ramp(looks.SURFACE, line="#2a9d8f"), 1, hides=1), True, is_height=True,
        colours=HEIGHTS, shows_greatest=True,
    ),
}  # fmt: skip


def write_rasters(
    paths: Mapping[str, Path], cells: QualityCells, frame: Frame, progress: Progress
) -> None:
    """Write rasters, given by their names."""
    for number, (name, path) in enumerate(paths.items(), start=1):
        raster = QUALITY_RASTERS[name]
        of_cells = raster.grid(cells)
        window = of_cells.whole
        check_cells(window.columns, window.rows, of_cells.size)
        size = of_cells.size / frame.horizontal_unit
        north = (window.row + window.rows) * size
        grid = RasterGrid(window.column * size, north, size, window.columns, window.rows, frame)
        nodata = _NO_BYTE if raster.kind == "uint8" else NODATA
        parts = _parts_of(raster, cells, frame, nodata)
        filled = sum(math.prod(piece.window.shape) for piece in of_cells.pieces)
        made = RasterCells(window.shape, raster.kind, parts, made=filled)
        write_geotiff(path, made, grid, nodata, progress, raster.shows)
        progress(number / len(paths))


def _parts_of(
    raster: QualityRaster, cells: QualityCells, frame: Frame, nodata: float
) -> Iterator[RasterPart]:
    """Yield parts of a raster from north to south."""
    unit = frame.vertical_unit if raster.is_height else 1.0

    def make(cells: QualityCells, there: Rectangle) -> np.ndarray:
        return raster.make(cells, there) / unit

    grid = raster.grid(cells)
    band = max(_TOGETHER // grid.window.columns // SIDE, 1) * SIDE
    for row, column, (rows, columns) in grid.bands(band):
        values = cells.rows_of(make, rows, raster.is_coarse)[:, columns]
        made = np.where(np.isnan(values), nodata, values).astype(raster.kind)
        yield RasterPart(row, column, made[::-1])
