"""The rasters of the quality of a survey, made from its cells."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Callable, Iterator, NamedTuple

import numpy as np

from ...core.files import Outputs
from ...core.points import Frame
from ...core.progress import SILENT, Progress
from ...grids.cell_window import CellWindow
from ...rasters import looks
from ...rasters.geotiff import NODATA, RasterGrid
from ...rasters.looks import Categories, Look, Ramp, Steps
from ...rasters.writing import Rows, check_raster_output, raster_file, write_geotiff
from .cells import STRIPS, QualityCells, twice
from .planes import plane_of

# Value of bytes without data, and least number of points of a strip in a cell that is compared.
NO_BYTE, _LEAST_POINTS = 255, 3
# A strip is even where its lowest points lie so near to a plane through those of the cells around,
# in metres. Edges of roofs, cars and single trees are not; a strip that is off as a whole is.
_UNEVEN = 0.25
# A difference that is farther than so many metres from the median of those of the 5 x 5 cells
# around is that of the edge of a roof or of a crown. Strips that do not fit do so in many cells.
_FROM_AROUND, _AROUND = 0.25, 2
# Cells whose surroundings are looked at together.
_LOOKED_AT = 1 << 18
# Cells that are made together.
_TOGETHER = 1 << 21
# Limits of the classes of differences between strips, in metres.
LIMITS = (0.08, 0.16)


class QualityRaster(NamedTuple):
    """The declaration of a raster."""

    title: str
    shows: str  # what its cells mean
    # ``make(cells, rows, inside, void)`` returns some rows, as floats with NaN for no value: `rows`
    # is a slice of rows, `inside` says which of all cells lie in the survey, and `void` is the
    # distance in metres from which on ground is missing.
    make: Callable[[QualityCells, slice, np.ndarray, float], np.ndarray]
    look: Look
    is_coarse: bool = False  # its cells have twice the size
    kind: str = "float32"  # "float32" or "uint8"
    is_height: bool = False  # written in the vertical unit of the CRS; made in metres
    label: str = ""  # on the page, where that is not the title


def _density(name: str) -> Callable[[QualityCells, slice, np.ndarray, float], np.ndarray]:
    def make(cells: QualityCells, rows: slice, inside: np.ndarray, void: float) -> np.ndarray:
        values = getattr(cells, name)[rows] / cells.sizes.cell**2
        return np.where(twice(inside, rows), values, np.nan)

    return make


def _voids(cells: QualityCells, rows: slice, inside: np.ndarray, void: float) -> np.ndarray:
    """Return 1 in cells that are farther from the next cell with ground than allowed."""
    from scipy import ndimage

    size, last = cells.sizes.cell, cells.sizes.fine.rows
    margin = math.ceil(void / size) + 1
    low, high = max(rows.start - margin, 0), min(rows.stop + margin, last)
    empty = cells.ground_points[low:high] == 0
    far = np.ones(empty.shape, dtype=bool)
    if not empty.all():
        far = ndimage.distance_transform_edt(empty, sampling=size) > void
    far = far[rows.start - low : rows.stop - low].astype(np.float32)
    return np.where(twice(inside, rows), far, np.nan)


def overlap(cells: QualityCells, rows: slice, inside: np.ndarray, void: float) -> np.ndarray:
    """Return the number of strips in cells."""
    number = np.count_nonzero(cells.strip[:, rows], axis=0).astype(np.float32)
    return np.where(inside[rows], number, np.nan)


def differences(cells: QualityCells, rows: slice, inside: np.ndarray, void: float) -> np.ndarray:
    """Return the range of the mean heights of strips in metres; NaN without two even ones."""
    return strip_differences(cells, rows, 45.0)


def strip_differences(cells: QualityCells, rows: slice, steepest: float) -> np.ndarray:
    """Return the differences on ground that is not steeper than some degrees."""
    low, high = max(rows.start - _AROUND, 0), min(rows.stop + _AROUND, cells.sizes.coarse.rows)
    found = _of_even_strips(cells, slice(low, high), steepest)
    wide = np.pad(found, _AROUND, constant_values=np.nan)
    places = np.flatnonzero(~np.isnan(found))
    side = np.arange(2 * _AROUND + 1)
    around = (side[:, None] * wide.shape[1] + side).ravel()
    lonely = np.zeros(len(places), dtype=bool)
    for start in range(0, len(places), _LOOKED_AT):
        part = slice(start, start + _LOOKED_AT)
        row, column = np.divmod(places[part], found.shape[1])
        values = wide.ravel()[(row * wide.shape[1] + column)[:, None] + around]
        off = np.abs(found.ravel()[places[part]] - np.nanmedian(values, axis=1))
        lonely[part] = off > _FROM_AROUND
    found.ravel()[places[lonely]] = np.nan
    return found[rows.start - low : rows.stop - low]


def _of_even_strips(cells: QualityCells, rows: slice, steepest: float) -> np.ndarray:
    """Return the range of the means of the strips that are even; NaN where fewer than two are."""
    number = cells.strip_points[:, rows]
    enough = number >= _LEAST_POINTS
    found = np.full(number.shape[1:], np.nan)
    places = np.flatnonzero(enough.sum(axis=0) > 1)
    for start in range(0, len(places), _LOOKED_AT):
        some = places[start : start + _LOOKED_AT]
        row, column = np.divmod(some, number.shape[2])
        is_known = enough[:, row, column] & _is_even(cells, row + rows.start, column, steepest)
        sums = cells.strip_sum[:, rows][:, row, column]
        means = sums / np.maximum(number[:, row, column], 1)
        lowest = np.where(is_known, means, np.inf).min(axis=0)
        highest = np.where(is_known, means, -np.inf).max(axis=0)
        several = is_known.sum(axis=0) > 1
        found.ravel()[some[several]] = (highest - lowest)[several]
    return found


def _is_even(
    cells: QualityCells, row: np.ndarray, column: np.ndarray, steepest: float
) -> np.ndarray:
    """Return where each strip of some cells is even; boolean, shape (4, n)."""
    # A plane through the lowest points of the strip itself, in the 3 x 3 cells around, tells. So
    # strips that are far apart count as even, and what rises in single cells does not.
    rows, columns = cells.sizes.coarse.shape
    size = 2 * cells.sizes.cell
    names, own = cells.strip[:, row, column], cells.strip_low[:, row, column]
    sums = np.zeros((STRIPS, 9, len(row)))
    for down in (-1, 0, 1):
        for right in (-1, 0, 1):
            there = (row + down >= 0) & (row + down < rows)
            there &= (column + right >= 0) & (column + right < columns)
            beside = np.clip(row + down, 0, rows - 1), np.clip(column + right, 0, columns - 1)
            for slot in range(STRIPS):
                strip, low = cells.strip[slot][beside], cells.strip_low[slot][beside]
                # The same strip can be in another slot there.
                n = (strip == names) & (names > 0) & there & np.isfinite(low)
                z = np.where(n, low - own, 0.0)
                x, y = right * size, down * size
                products = (1.0, x, y, z, x * x, x * y, y * y, x * z, y * z)
                for total, product in zip(sums.swapaxes(0, 1), products):
                    total += n * product
    found = [plane_of(each) for each in sums]
    is_good, values = np.stack([each[0] for each in found]), np.stack([each[1] for each in found])
    slope = np.hypot(values[:, 1], values[:, 2])
    near = np.abs(values[:, 0]) <= _UNEVEN
    return is_good & near & (slope <= math.tan(math.radians(steepest)))


def _highest(cells: QualityCells, rows: slice, inside: np.ndarray, void: float) -> np.ndarray:
    heights = cells.highest[rows]
    return np.where(np.isfinite(heights), heights, np.nan)


_DENSITY = Ramp(looks.DENSITY, low=0.0)
# From none to all of the strips of a cell.
_NUMBERS = tuple((number, str(number), colour) for number, (_, colour) in enumerate(looks.DENSITY))

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
        "Voids of the ground", "1 where ground points are far away", _voids,
        Look(Categories(((1, "No ground near", "#c0262d"),)), 7), kind="uint8",
    ),
    "low_vegetation": QualityRaster(
        "Density of low vegetation", "Points 0.2 to 2 m above the ground, 1/m2", _density("low"),
        Look(Ramp(looks.CANOPY, low=0.0), 2, hides=1),
    ),
    "overlap": QualityRaster(
        "Overlap of strips", "Number of strips", overlap, Look(Categories(_NUMBERS), 5, hides=1),
        True, "uint8", label=f"Overlap of strips (up to {STRIPS})",
    ),
    "strip_differences": QualityRaster(
        "Differences between strips", "Difference between strips, {unit}", differences,
        Look(Steps(LIMITS, ("#3a9d5d", "#f0c93a", "#c0262d")), 6), True, is_height=True,
    ),
    "surface_height": QualityRaster(
        "Maximum surface height", "Height, {unit}", _highest,
        Look(Ramp(looks.SURFACE, line="#2a9d8f"), 1, hides=1), True, is_height=True,
    ),
}  # fmt: skip


def rows_of(window: CellWindow) -> list[slice]:
    """Return slices of rows, of an even number and from south to north, that fit into memory."""
    step = max(_TOGETHER // window.columns // 2 * 2, 2)
    starts = range(0, window.rows, step)
    return [slice(start, min(start + step, window.rows)) for start in starts]


def raster_paths(folder: Path) -> dict[str, Path]:
    """Return the paths of the rasters in a folder, by their names."""
    return {name: folder / f"{name}.tif" for name in QUALITY_RASTERS}


def check_rasters(folder: Path, sources: tuple[Path, ...]) -> None:
    """Refuse, before any work is done, rasters that could not be written at the end."""
    for path in raster_paths(folder).values():
        check_raster_output(path, sources)


def write_rasters(
    folder: Path,
    cells: QualityCells,
    inside: np.ndarray,
    void: float,
    frame: Frame,
    outputs: Outputs,
    progress: Progress = SILENT,
) -> None:
    """Write all rasters into a folder, with names when `outputs` is closed, of coarse cells
    `inside` the survey; ground is missing from `void` metres on.
    """
    paths = raster_paths(folder)
    for number, (name, path) in enumerate(paths.items(), start=1):
        raster = QUALITY_RASTERS[name]
        window = cells.sizes.coarse if raster.is_coarse else cells.sizes.fine
        size = cells.sizes.cell * (2 if raster.is_coarse else 1) / frame.horizontal_unit
        north = (window.row + window.rows) * size
        grid = RasterGrid(window.column * size, north, size, window.columns, window.rows, frame)
        nodata = NO_BYTE if raster.kind == "uint8" else NODATA
        strips = _strips(raster, window, cells, inside, void, frame, nodata)
        rows = Rows(window.shape, raster.kind, strips)
        waiting = raster_file(outputs, path)
        write_geotiff(waiting, rows, grid, nodata, progress, raster.shows)
        progress(number / len(paths))


def _strips(
    raster: QualityRaster,
    window: CellWindow,
    cells: QualityCells,
    inside: np.ndarray,
    void: float,
    frame: Frame,
    nodata: float,
) -> Iterator[np.ndarray]:
    """Yield rows of a raster from north to south."""
    for rows in reversed(rows_of(window)):
        values = raster.make(cells, rows, inside, void)
        if raster.is_height:
            values = values / frame.vertical_unit
        yield np.where(np.isnan(values), nodata, values).astype(raster.kind)[::-1]
