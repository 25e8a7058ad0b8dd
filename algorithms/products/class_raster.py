"""A raster of the classes of a point cloud, shown where QGIS cannot show the points."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from ..core.progress import SILENT, Progress
from ..las.cloud import PointCloud, survey_frame
from ..las.lasfile import LasFile
from ..las.opening import open_las
from ..las.reading import read_parts
from ..rasters.geotiff import RasterGrid
from ..rasters.writing import write_geotiff
from ..survey.selection import GROUND

NO_CLASS = 255
# More cells are not needed to look at.
_MOST_CELLS = 4_000_000


class ClassCells:
    """Classes of cells; points can be added in parts.

    A cell is ground if at least half of its points are ground. Otherwise it has the highest class
    of its other points, so that classes with a meaning are shown rather than unclassified points.

    Parameters
    ----------
    cell_count : int
        Number of cells.
    ground_class : int
        The class of the ground.
    """

    def __init__(self, cell_count: int, ground_class: int = GROUND) -> None:
        self._ground_class = ground_class
        self._points = np.zeros(cell_count, dtype=np.int64)
        self._ground = np.zeros(cell_count, dtype=np.int64)
        self._highest = np.zeros(cell_count, dtype=np.uint8)

    def add(self, cells: np.ndarray, classes: np.ndarray) -> None:
        """Add points.

        Parameters
        ----------
        cells : numpy.ndarray of int64, shape (n,)
            Number of the cell of each point.
        classes : numpy.ndarray of uint8, shape (n,)
            Their classes.
        """
        is_ground = classes == self._ground_class
        self._points += np.bincount(cells, minlength=len(self._points))
        self._ground += np.bincount(cells[is_ground], minlength=len(self._points))
        cells = cells[~is_ground]
        values = np.maximum(classes[~is_ground], self._highest[cells])
        # The last value of a cell is kept, and that is the highest.
        order = np.argsort(values, kind="stable")
        self._highest[cells[order]] = values[order]

    def values(self) -> np.ndarray:
        """Return the class of each cell, `NO_CLASS` without points; uint8."""
        of_points = np.where(2 * self._ground >= self._points, self._ground_class, self._highest)
        return np.where(self._points > 0, of_points, NO_CLASS).astype(np.uint8)


def write_class_raster(
    source: Path,
    target: Path,
    cell_size: float = 1.0,
    ground_class: int = GROUND,
    progress: Progress = SILENT,
) -> None:
    """Write the classes of a point cloud as a raster.

    Parameters
    ----------
    source : Path
        A .las, .laz or .copc.laz file.
    target : Path
        The GeoTIFF to make; cells without points are `NO_CLASS`.
    cell_size : float
        Side of a cell in metres; larger if there would be too many cells.
    ground_class : int
        The class of the ground.
    progress : Progress
        Receives progress.

    Raises
    ------
    BareEarthError
        If the input cannot be read or the output cannot be written.
    """
    las, grid, cells = open_las(source), None, None
    for part in read_parts(las, progress.part(0.0, 0.9)):
        if grid is None:
            grid = _grid_of(las, part, cell_size)
            cells = ClassCells(grid.rows * grid.columns, ground_class)
        cells.add(_cells_of(part, grid), part.classification)
    values = cells.values().reshape(grid.rows, grid.columns)
    write_geotiff(target, values, grid, NO_CLASS, progress, "Class")


def _grid_of(las: LasFile, part: PointCloud, cell_size: float) -> RasterGrid:
    frame = survey_frame(part.crs)
    (west, south, _), (east, north, _) = las.minimum, las.maximum
    area = (east - west) * (north - south) * frame.horizontal_unit**2
    cell = max(cell_size, math.sqrt(area / _MOST_CELLS)) / frame.horizontal_unit
    left, top = math.floor(west / cell), math.ceil(north / cell)
    columns, rows = math.floor(east / cell) - left + 1, top - math.ceil(south / cell) + 1
    return RasterGrid(left * cell, top * cell, cell, columns, rows, frame)


def _cells_of(part: PointCloud, grid: RasterGrid) -> np.ndarray:
    x, y = (
        at * scale + offset for at, scale, offset in zip((part.x, part.y), part.scale, part.offset)
    )
    column = np.floor((x - grid.west) / grid.cell_size).astype(np.int64)
    row = np.floor((grid.north - y) / grid.cell_size).astype(np.int64)
    # The extent in the header may be slightly smaller than that of the points.
    column, row = np.clip(column, 0, grid.columns - 1), np.clip(row, 0, grid.rows - 1)
    return row * grid.columns + column
