"""Writes the rasters of all blocks as one, or cut by file."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Mapping, Sequence

import numpy as np

from ...core.errors import BareEarthError
from ...core.files import Outputs, new_folder
from ...core.points import Box, Frame, box_in_words
from ...core.progress import SILENT, Progress
from ...grids.cell_window import CellWindow
from ...rasters.cell_grid import (
    MOST_CELLS,
    CellGrid,
    no_points,
)
from ...rasters.geotiff import RasterGrid
from ...rasters.virtual import write_virtual
from ...rasters.writing import Band, Rows, raster_file, write_geotiff
from ...survey.area import Area
from .block import BlockRasters
from .level_water import WaterCells
from .mosaic import Mosaic, gathered_strips
from .outlines import Held, Outlines, mosaics_of
from .rows import RASTERS, How, Raster, folder_of, virtual_of
from .step import MakeRasters

# In a raster of more cells, blocks with points must cover this share. Otherwise it is so large
# because of a few points with stray coordinates.
_MANY_CELLS, _LEAST_COVERED = 10_000_000, 0.01
# Cells up to so many metres from the area are made as well, because the surroundings decide which
# gaps lie inside the survey.
AROUND_AREA = 1000.0


@dataclass(frozen=True)
class RasterSize:
    """The size of rasters, and the points that terrain and surface were made from."""

    ground_count: int
    surface_count: int
    columns: int
    rows: int


def write_rasters(
    made: Sequence[BlockRasters],
    frame: Frame,
    step: MakeRasters,
    outputs: Outputs,
    progress: Progress = SILENT,
    files: Mapping[str, Box] | None = None,
) -> RasterSize:
    """Write the rasters of the blocks of a survey, or of `files` with extents in units of the CRS,
    with names when `outputs` is closed; refuse no points.
    """
    cell, wanted = step.cell, step.files.wanted
    window, area = _window_of(made, cell), None
    whole = window
    if step.area is not None:
        area = step.area.scaled(frame.horizontal_unit, frame.origin)
        whole = _window_in(area.buffered_box(AROUND_AREA), window, cell, step.area)
        window = _window_in(area.bounds, window, cell, step.area)
    water = WaterCells(step.fixed.waters if step.fixed else (), whole, cell)
    outlines = Outlines(Held(made, whole, cell, water), step.of_block)
    mosaics = mosaics_of(made, whole, step.of_block, outlines, progress.part(0.0, 0.3))
    window = _covered(window, step, frame)
    parts = progress.part(0.3, 1.0).shares(*[1.0] * len(wanted))
    for (name, path), part in zip(wanted.items(), parts):
        raster = RASTERS[name]
        measured = outlines.canopy() if raster.needs_both else None
        layers = [mosaics[each].limited(measured, area) for each in raster.layers]
        write = partial(_write, raster, layers, frame, step, outputs)
        if files is None:
            write(path, window, part)
        else:
            windows = _windows_of(files, window, cell, frame)
            shares = part.shares(*[1.0] * len(windows))
            folder = outputs.enter_context(new_folder(folder_of(path)))
            names = [folder / f"{each}.tif" for each in windows]
            grids = dict(zip(names, map(write, names, windows.values(), shares)))
            virtual, grid = virtual_of(path), _grid_of(window, step, frame)
            temporary = outputs.file(virtual)
            nodata = raster.nodata(step.model.nodata)
            band = Band.of(grid, nodata, raster.shows, raster.bands)
            write_virtual(temporary, virtual.parent, grid, grids, raster.kind, band)
    counts = np.sum([each.counts for each in made], axis=0)
    return RasterSize(int(counts[0]), int(counts[1]), window.columns, window.rows)


def _write(
    raster: Raster,
    layers: Sequence[Mosaic],
    frame: Frame,
    step: MakeRasters,
    outputs: Outputs,
    path: Path,
    window: CellWindow,
    progress: Progress,
) -> RasterGrid:
    """Write some cells of a raster; return where they lie."""
    grid, nodata = _grid_of(window, step, frame), raster.nodata(step.model.nodata)
    how = How((grid.cell_metres, grid.cell_metres), step.model, step.surface)
    make = partial(raster.rows, how=how, unit=frame.vertical_unit, nodata=nodata)
    strips = gathered_strips(layers, window, make, raster.margin(how), progress)
    rows = Rows(window.shape, raster.kind, strips, raster.bands)
    write_geotiff(raster_file(outputs, path), rows, grid, nodata, progress, raster.shows)
    return grid


def _windows_of(
    files: Mapping[str, Box], whole: CellWindow, cell: float, frame: Frame
) -> dict[str, CellWindow]:
    """Return the cells of each file, without files that lie outside of all cells."""
    windows = {}
    for name, box in files.items():
        metres = (np.array(box) - np.tile(frame.origin, 2)) * frame.horizontal_unit
        window = CellWindow.around(tuple(metres.tolist()), cell).within(whole)
        if min(window.shape) > 0:
            windows[name] = window
    return windows


def _window_of(made: Sequence[BlockRasters], cell: float) -> CellWindow:
    """Return the cells that cover all points."""
    boxes = np.array([each.box for each in made if not np.isnan(each.box).any()]).reshape(-1, 4)
    if not len(boxes):
        raise BareEarthError(
            "There is no ground point to make a terrain model of. Check the selection of points"
            " and the parameters."
        )
    low, high = boxes[:, :2].min(axis=0), boxes[:, 2:].max(axis=0)
    window = CellWindow.around((*low, *high), cell)
    cells = window.rows * window.columns
    covered = np.prod(boxes[:, 2:] - boxes[:, :2] + cell, axis=1).sum() / (cells * cell**2)
    if cells > MOST_CELLS or (cells > _MANY_CELLS and covered < _LEAST_COVERED):
        raise BareEarthError(
            f"The raster would have {window.columns:,} x {window.rows:,} cells of {cell:g} m."
            " Choose a larger cell size, or remove points with stray coordinates."
        )
    return window


def _covered(window: CellWindow, step: MakeRasters, frame: Frame) -> CellWindow:
    """Return the cells of the rasters, given those that have points."""
    wanted = step.cells.window if step.cells else None
    if wanted is None:
        return window
    if min(wanted.within(window).shape) <= 0:
        raise no_points(*(_grid_of(cells, step, frame).box for cells in (wanted, window)))
    return wanted


def _window_in(box: Box, whole: CellWindow, cell: float, area: Area) -> CellWindow:
    """Return the cells that cover a box in metres; `area` is in units of the CRS."""
    window = CellWindow.around(box, cell).within(whole)
    if min(window.shape) <= 0:
        raise no_point_in(area)
    return window


def no_point_in(area: Area) -> BareEarthError:
    """Return the error for an area, in units of the CRS, without any point."""
    return BareEarthError(
        f"No point lies in the area ({box_in_words(area.bounds)}), so that no raster can be made."
        " Give the area in the CRS of the points."
    )


def _grid_of(window: CellWindow, step: MakeRasters, frame: Frame) -> RasterGrid:
    cells = step.cells or CellGrid(step.cell, step.cell / frame.horizontal_unit)
    return cells.of(window, frame)
