"""A raster of the classes of point clouds, shown where QGIS cannot show the points."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from ...classes.kept_classes import GROUND
from ...core.points import Box, Frame, box_round
from ...core.progress import SILENT, Progress
from ...grids.cell_window import CellWindow
from ...grids.piece_grid import PieceGrid
from ...las.cloud import PointCloud, survey_frame
from ...las.reading import read_parts
from ...rasters.geotiff import RasterGrid
from ...rasters.sparse import RasterPart
from ...rasters.writing import RasterCells, write_geotiff
from ...survey.files import Inputs, open_survey

NO_CLASS = 255
# More cells are not needed to look at.
_MOST_CELLS = 4_000_000


class ClassCells:
    """Classes of cells, to which points can be added in parts."""

    # A cell is ground if at least half of its points are ground. Otherwise it has the highest class
    # of its other points, so that classes with a meaning are shown rather than unclassified points.

    def __init__(self, cell_count: int, ground_class: int = GROUND) -> None:
        self._ground_class = ground_class
        self._points = np.zeros(cell_count, dtype=np.int64)
        self._ground = np.zeros(cell_count, dtype=np.int64)
        self._highest = np.zeros(cell_count, dtype=np.uint8)

    def add(self, cells: np.ndarray, classes: np.ndarray) -> None:
        """Add points, by the number of their cell, int64 (n,), and their class, uint8 (n,)."""
        is_ground = classes == self._ground_class
        for counts, those in ((self._points, cells), (self._ground, cells[is_ground])):
            if len(those):
                # A file of a survey fills few of the cells.
                found = np.bincount(those - (first := those.min()))
                counts[first : first + len(found)] += found
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
    crs: str | None = None,
    in_units: bool = False,
) -> list[int]:
    """Write the classes of a point cloud, or of a virtual one, as a GeoTIFF with `NO_CLASS` in
    cells without points, and return its classes, sorted.
    """
    # The side of a cell is in metres, or in units of the CRS with `in_units`; it is larger if there
    # would be too many cells. `crs` is as for `open_las`.
    survey = open_survey(Inputs([source]).read_as(crs))
    cell_size *= survey.crs.horizontal_unit if in_units else 1.0
    frame = survey_frame(survey.crs)
    extent = box_round(np.array([tile.box for tile in survey.tiles]))
    boxes = [_shared(piece.box, extent) for piece in survey.pieces]
    area = sum((east - west) * (north - south) for west, south, east, north in boxes)
    least = math.sqrt(area * frame.horizontal_unit**2 / _MOST_CELLS)
    cell = max(cell_size, least) / frame.horizontal_unit
    grid = PieceGrid.of([_window_of(box, cell) for box in boxes], cell)
    cells = ClassCells(math.prod(grid.window.shape), ground_class)
    parts = progress.part(0.0, 0.9).shares(*(max(tile.count, 1) for tile in survey.tiles))
    for tile, part in zip(survey.tiles, parts):
        for points in read_parts(tile, part):
            cells.add(_cells_of(points, grid), points.classification)
    values = cells.values().reshape(grid.window.shape)
    _write(target, values, grid, frame, progress)
    return [int(number) for number in np.unique(values) if number != NO_CLASS]


def _shared(box: Box, other: Box) -> Box:
    """Return what two boxes share."""
    (west, south), (east, north) = map(max, box[:2], other[:2]), map(min, box[2:], other[2:])
    return west, south, east, north


def _window_of(box: Box, cell: float) -> CellWindow:
    """Return the cells of a piece; points on its southern and eastern border have cells, too."""
    west, south, east, north = (side / cell for side in box)
    row, column = math.ceil(south) - 1, math.floor(west)
    return CellWindow(row, column, math.ceil(north) - row, math.floor(east) - column + 1)


def _cells_of(part: PointCloud, grid: PieceGrid) -> np.ndarray:
    x, y = part.coordinates()
    column = np.floor(x / grid.size).astype(np.int64) - grid.window.column
    row = np.ceil(y / grid.size).astype(np.int64) - 1 - grid.window.row
    return grid.moved(row, column)[0]


def _write(
    target: Path, values: np.ndarray, grid: PieceGrid, frame: Frame, progress: Progress
) -> None:
    """Write classes, rows from the south, where their cells lie."""
    whole = grid.whole
    north = (whole.row + whole.rows) * grid.size
    where = RasterGrid(whole.column * grid.size, north, grid.size, whole.columns, whole.rows, frame)
    parts = (
        RasterPart(row, column, values[there][::-1])
        for row, column, there in grid.bands(max(whole.rows, 1))
    )
    made = sum(math.prod(piece.window.shape) for piece in grid.pieces)
    cells = RasterCells(whole.shape, "uint8", parts, made=made)
    write_geotiff(target, cells, where, NO_CLASS, progress, "Class")
