"""Writes the rasters of all blocks as one, or cut by file."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any, Callable, Mapping, Sequence

import numpy as np

from ...core.errors import BareEarthError
from ...core.files import Outputs, new_folder
from ...core.points import Box, Frame, box_in_words, box_round
from ...core.progress import SILENT, Progress
from ...core.words import option
from ...engine.step import AROUND_AREA
from ...engine.summary import RunSummary
from ...grids.cell_window import CellWindow
from ...grids.expected_error import ExpectedAccuracy
from ...rasters.cell_grid import ANYWHERE, MOST_CELLS, CellGrid, RasterTarget, no_points
from ...rasters.content import MOST_WITH_EMPTY
from ...rasters.geotiff import NO_GROUND, RasterGrid
from ...rasters.virtual import folder_of, virtual_of, write_virtual
from ...rasters.writing import Band, RasterCells, raster_file, write_geotiff
from ...survey.area import Area
from .block import BlockRasters, LayerMaker
from .fixed_terrain import FixedTerrain
from .level_water import WaterCells
from .mosaic import Mosaic, made_parts
from .outlines import CellContents, Outlines, mosaics_of
from .parameters import SurfaceModel, TerrainModel
from .rows import How, RasterFiles, RasterRow, row_of

# Writes a raster, given what `write_geotiff` is given.
WriteCells = Callable[[Path, RasterCells, RasterGrid, float, Progress, str], None]


@dataclass(frozen=True)
class RasterJob:
    """The rasters to make, and everything else that their cells depend on."""

    files: RasterFiles = field(default_factory=RasterFiles)
    model: TerrainModel = field(default_factory=TerrainModel)
    surface: SurfaceModel = field(default_factory=SurfaceModel)
    per_file: bool = False  # each of many files gets its own rasters
    fixed: FixedTerrain | None = None  # the vertices of the constraints, once they are found
    target: RasterTarget = ANYWHERE  # a grid or an extent that the rasters must have
    placed_cells: CellGrid | None = None  # where the cells lie, once the CRS is known
    area: Area | None = None  # without values outside, where points still take part

    @property
    def cells(self) -> CellGrid:
        """Where the cells lie; before that is known, as in metres."""
        return self.placed_cells or self.model.cells(1.0)

    @property
    def cell(self) -> float:
        """Side of a cell in metres."""
        return self.cells.metres

    @property
    def of_block(self) -> LayerMaker:
        """Makes the rasters of a single block."""
        return LayerMaker(self.cell, self.files.layers, self.surface.max_edge)


@dataclass(frozen=True)
class RasterSize(RunSummary):
    """The size of rasters, and the points that terrain and surface were made from."""

    ground_count: int
    surface_count: int
    columns: int
    rows: int

    @property
    def text(self) -> str:
        """The size in words."""
        return f"{self.columns:,} x {self.rows:,} cells of {self.ground_count:,} ground points"


@dataclass
class Known:
    """Whether any cell of a raster has a value."""

    any: bool = False

    def seeing(
        self, make: Callable[..., np.ndarray], nodata: float, *layers: np.ndarray
    ) -> np.ndarray:
        """Return rows of a raster, and look for values in them."""
        rows = make(*layers)
        self.any = self.any or bool((np.isfinite(rows) & (rows != nodata)).any())
        return rows


def write_rasters(
    blocks: Sequence[BlockRasters],
    frame: Frame,
    step: RasterJob,
    outputs: Outputs,
    progress: Progress = SILENT,
    files: Mapping[str, Box] | None = None,
    write_cells: WriteCells | None = None,
) -> RasterSize:
    """Write the rasters of the blocks of a survey, or of `files` with extents in units of the CRS,
    with names when `outputs` is closed, or with a function of the caller; refuse no points.
    """
    write_cells = write_cells or partial(_write_geotiff, outputs)
    area = step.area and step.area.scaled(frame.horizontal_unit, frame.origin)
    window, whole = _windows(blocks, step, frame, area)
    water = WaterCells(step.fixed.waters if step.fixed else (), whole, step.cell)
    outlines = Outlines(CellContents(blocks, whole, water), step.of_block)
    mosaics = mosaics_of(blocks, whole, step.of_block, outlines, progress.part(0.0, 0.3))
    windows = None if files is None else _windows_of(files, window, step.cell, frame)
    parts = progress.part(0.3, 1.0).shares(*[1.0] * len(step.files.wanted))
    expected = ExpectedAccuracy()
    known: dict[str, Known] = {}
    for (name, path), part in zip(step.files.wanted.items(), parts):
        raster = row_of(name)
        measured = outlines.canopy() if raster.needs_both else None
        layers = [mosaics[layer].limited(measured, area) for layer in raster.layers]
        told = expected if name == "expected_error" else None
        known[raster.label] = Known(raster.kind == "uint8")  # where 0 is a value as well
        write = partial(_write, raster, layers, frame, step, write_cells, told, known[raster.label])
        if windows is None:
            write(path, window, part)
            continue
        folder = outputs.enter_context(new_folder(folder_of(path)))
        names = [folder / f"{name}.tif" for name in windows]
        shares = part.shares(*[1.0] * len(windows))
        grids = dict(zip(names, map(write, names, windows.values(), shares)))
        virtual, grid = virtual_of(path), step.cells.of(window, frame)
        band = Band.of(grid, raster.nodata(step.model.nodata), raster.shows, raster.bands)
        write_virtual(outputs.file(virtual), virtual.parent, grid, grids, raster.kind, band)
    empty = [label for label, seen in known.items() if not seen.any]
    if empty:
        progress.warning(
            f"No cell has a value: {', '.join(empty)}. The points lie too far apart or in a line."
            " Check their coordinates and units, and whether y is up in the file."
        )
    if expected.count:
        progress.info(expected.text)
    ground, top = np.sum([block.counts for block in blocks], axis=0).tolist()
    return RasterSize(ground, top, window.columns, window.rows)


def _write(
    raster: RasterRow,
    layers: Sequence[Mosaic],
    frame: Frame,
    step: RasterJob,
    write_cells: WriteCells,
    expected: ExpectedAccuracy | None,
    known: Known,
    path: Path,
    window: CellWindow,
    progress: Progress,
) -> RasterGrid:
    """Write some cells of a raster; return where they lie."""
    grid, nodata = step.cells.of(window, frame), raster.nodata(step.model.nodata)
    how = How((grid.cell_metres, grid.cell_metres), step.model, step.surface)
    make = partial(raster.rows, how=how, unit=frame.vertical_unit, nodata=nodata)
    if expected is not None:
        make = partial(_telling, make, expected, step.model.error_factor)
    make = partial(known.seeing, make, nodata)
    parts, count = made_parts(layers, window, make, raster.margin(how), progress)
    cells = RasterCells(window.shape, raster.kind, parts, raster.bands, count)
    write_cells(path, cells, grid, nodata, progress, raster.shows)
    return grid


def _telling(
    make: Callable[..., np.ndarray],
    expected: ExpectedAccuracy,
    factor: float,
    error: np.ndarray,
    terrain: np.ndarray,
) -> np.ndarray:
    """Return rows of the expected error, and add those where there is a terrain."""
    expected.add(np.where(np.isnan(terrain), np.nan, error * factor))
    return make(error, terrain)


def _write_geotiff(outputs: Outputs, path: Path, *cells: Any) -> None:
    write_geotiff(raster_file(outputs, path), *cells)


def _windows_of(
    files: Mapping[str, Box], whole: CellWindow, cell: float, frame: Frame
) -> dict[str, CellWindow]:
    """Return the cells of each file, without files that lie outside of all cells."""
    windows = {}
    for name, box in files.items():
        metres = (np.array(box) - np.tile(frame.origin, 2)) * frame.horizontal_unit
        window = CellWindow.around(tuple(metres.tolist()), cell).within(whole)
        if not window.is_empty:
            windows[name] = window
    return windows


def _window_of(blocks: Sequence[BlockRasters], cell: float) -> CellWindow:
    """Return the cells that cover all points."""
    boxes = np.array([block.box for block in blocks]).reshape(-1, 4)
    boxes = boxes[~np.isnan(boxes).any(axis=1)]
    if not len(boxes):
        raise BareEarthError(NO_GROUND)
    window = CellWindow.around(box_round(boxes), cell)
    return window


def _windows(
    blocks: Sequence[BlockRasters], step: RasterJob, frame: Frame, area: Area | None
) -> tuple[CellWindow, CellWindow]:
    """Return the cells of the rasters, and the cells computed for them, given the area in metres;
    refuse rasters without points or with too many cells.
    """
    whole = window = _window_of(blocks, step.cell)
    wanted = step.cells.window
    if area is not None and step.area is not None:
        whole = CellWindow.around(area.buffered_box(AROUND_AREA), step.cell).within(window)
        window = CellWindow.around(area.bounds, step.cell).within(window)
        if window.is_empty:
            raise no_point_in(step.area)
    if wanted is not None:
        if wanted.within(window).is_empty:
            raise no_points(*(step.cells.of(cells, frame).box for cells in (wanted, window)))
        whole = whole.within(wanted.wider(math.ceil(AROUND_AREA / step.cell)))
    shared = (block.window.within(whole) for block in blocks)
    filled = sum(math.prod(part.shape) for part in shared if not part.is_empty)
    if math.prod(whole.shape) > MOST_WITH_EMPTY or filled > MOST_CELLS:
        raise BareEarthError(
            f"The rasters would have {whole.columns:,} x {whole.rows:,} cells of {step.cell:g} m."
            f" Choose a larger cell size, or give the extent of the rasters"
            f" ({option('raster_extent')})."
        )
    return wanted or window, whole


def no_point_in(area: Area) -> BareEarthError:
    """Return the error for an area, in units of the CRS, without any point."""
    return BareEarthError(
        f"No point lies in the area ({box_in_words(area.bounds)}), so that no raster can be made."
        " Give the area in the CRS of the points."
    )
