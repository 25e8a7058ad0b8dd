"""The rasters of the quality of a survey, made from its cells."""

from __future__ import annotations

import contextlib
import math
from pathlib import Path
from typing import Callable, Iterator, NamedTuple

import numpy as np

from ..core.points import Frame
from ..core.progress import SILENT, Progress
from ..grids.cell_window import CellWindow
from ..rasters.geotiff import NODATA, RasterGrid
from ..rasters.writing import Rows, check_raster_output, replacing_raster, write_geotiff
from .quality_cells import STRIPS, QualityCells

# Value of bytes without data, and least number of points of a strip in a cell that is compared.
NO_BYTE, _LEAST_POINTS = 255, 3
# Cells that are made together.
_TOGETHER = 1 << 21


class QualityRaster(NamedTuple):
    """The declaration of a raster.

    Attributes
    ----------
    label, shows : str
        Its title, and what its cells mean.
    make : callable
        ``make(cells, rows, inside, void)`` returns some rows, as floats with NaN for no value:
        `rows` is a slice of rows, `inside` says which of all cells lie in the survey, and `void` is
        the distance in metres from which on ground is missing.
    is_coarse : bool
        Whether its cells have twice the size.
    kind : str
        "float32" or "uint8".
    is_height : bool
        Whether its values are written in the vertical unit of the CRS; they are made in metres.
    """

    label: str
    shows: str
    make: Callable[[QualityCells, slice, np.ndarray, float], np.ndarray]
    is_coarse: bool = False
    kind: str = "float32"
    is_height: bool = False


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
    """Return the range of the mean heights of strips in metres; NaN in cells with one strip."""
    number = cells.strip_points[:, rows]
    means = np.full(number.shape, np.nan)
    np.divide(cells.strip_sum[:, rows], number, out=means, where=number >= _LEAST_POINTS)
    is_known = ~np.isnan(means)
    lowest = np.where(is_known, means, np.inf).min(axis=0)
    highest = np.where(is_known, means, -np.inf).max(axis=0)
    return np.where(is_known.sum(axis=0) > 1, highest - lowest, np.nan)


def _highest(cells: QualityCells, rows: slice, inside: np.ndarray, void: float) -> np.ndarray:
    heights = cells.highest[rows]
    return np.where(np.isfinite(heights), heights, np.nan)


QUALITY_RASTERS = {
    "pulse_density": QualityRaster(
        "Density of first returns", "First returns, 1/m2", _density("first")
    ),
    "ground_density": QualityRaster(
        "Density of ground points", "Ground points, 1/m2", _density("ground_points")
    ),
    "voids": QualityRaster(
        "Voids of the ground", "1 where ground points are far away", _voids, kind="uint8"
    ),
    "low_vegetation": QualityRaster(
        "Density of low vegetation", "Points 0.2 to 2 m above the ground, 1/m2", _density("low")
    ),
    "overlap": QualityRaster(
        f"Overlap of strips (up to {STRIPS})", "Number of strips", overlap, True, "uint8"
    ),
    "strip_differences": QualityRaster(
        "Differences between strips", "Difference between strips, {unit}", differences, True,
        is_height=True,
    ),
    "surface_height": QualityRaster(
        "Maximum surface height", "Height, {unit}", _highest, True, is_height=True
    ),
}  # fmt: skip


def twice(inside: np.ndarray, rows: slice) -> np.ndarray:
    """Return values of coarse cells for some rows of fine cells; the first row must be even."""
    coarse = inside[rows.start // 2 : -(-rows.stop // 2)]
    return coarse.repeat(2, axis=0)[: rows.stop - rows.start].repeat(2, axis=1)


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
    outputs: contextlib.ExitStack,
    progress: Progress = SILENT,
) -> None:
    """Write all rasters; they get their names when `outputs` is closed.

    Parameters
    ----------
    folder : Path
        Where they are written.
    cells : QualityCells
        The counted cells.
    inside : numpy.ndarray of bool
        Which of the coarse cells lie in the survey.
    void : float
        Distance in metres from which on ground is missing.
    frame : Frame
        The frame of the survey.
    outputs : contextlib.ExitStack
        Receives the files.
    progress : Progress
        Receives progress and messages.

    Raises
    ------
    BareEarthError
        If a raster cannot be written.
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
        waiting = outputs.enter_context(replacing_raster(path))
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
