"""Rasters of the blocks of a survey, as dask arrays whose chunks are blocks."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from itertools import chain
from typing import Any, Sequence

import numpy as np

from ..core.errors import BareEarthError
from ..core.files import Outputs
from ..core.points import Box, box_round
from ..core.progress import SILENT
from ..core.threads import SharedThreads
from ..engine.block_grid import BlockGrid, BlockIndex
from ..engine.step import AROUND_AREA, steps_in_crs
from ..engine.visits import values_of
from ..grids.cell_window import CellWindow
from ..las.cloud import PointCloud, survey_frame
from ..rasters.writing import Band
from ..survey.area import Area
from ..survey.shapes import Place
from ..tools.rasters.block import BlockRasters
from ..tools.rasters.output import no_point_in, write_rasters
from ..tools.rasters.rows import RASTERS, How
from ..tools.rasters.step import MakeRasters
from .blocks import ONE_THREAD, Block, points_of, shared_by
from .rasters import Collected, Raster


def lazy_rasters(blocks: Sequence[Block], step: MakeRasters) -> dict[str, Raster]:
    """Return rasters by their names, with dask arrays as values: each chunk has the cells of a run
    on all files with the extent of the chunk.
    """
    try:
        import dask.array
        from dask.delayed import delayed
    except ImportError:
        raise BareEarthError("Rasters of blocks need Dask: pip install dask.") from None
    array: Any = dask.array
    work, box = blocks[0].work, box_round(np.array([block.work.box for block in blocks]))
    place = Place("the files", work.crs, box)
    (step,) = steps_in_crs([step], place)
    grid = BlockGrid(survey_frame(work.crs, step.blocks.origin), step, work.grid.stated)
    window = _window_of(grid, box)
    how = How((step.cell, step.cell), step.model, step.surface)
    reach = step.cell * (1 + max(RASTERS[name].margin(how) for name in step.files.wanted))
    once = partial(delayed, pure=False, traverse=False)
    shared = once(grid)
    points = {block.work.place: delayed(points_of)(once(block), SILENT) for block in blocks}
    layers: dict[BlockIndex, Any] = {}
    rows: dict[int, list[Any]] = {}
    for index in grid.touching(grid.in_crs(_box_of(window, step.cell))):
        cells = CellWindow.with_centres_in(grid.blocks.block(*index).box, step.cell).within(window)
        if cells.is_empty:
            continue
        near: list[Any] = []
        for around in grid.touching(grid.in_crs(_box_of(cells, step.cell, reach + AROUND_AREA))):
            if around not in layers:
                places = work.grid.touching(grid.window([around]))
                needed = [points[place] for place in places if place in points]
                layers[around] = delayed(_layers_of)(shared, around, needed) if needed else None
            near += [layers[around]] * (layers[around] is not None)
        made = delayed(_cells_of)(shared, cells, reach, near)
        rows.setdefault(index.row, []).append((cells, made))
    rasters = {}
    for name in step.files.wanted:
        row = RASTERS[name]
        chunks = [
            [
                array.from_delayed(made[name], _shape(name, cells), np.dtype(row.kind))
                for cells, made in rows[number]
            ]
            for number in sorted(rows, reverse=True)
        ]
        where, nodata = step.cells.of(window, grid.frame), row.nodata(step.model.nodata)
        about = Band.of(where, nodata, row.shows, row.bands)
        transform = (where.cell_size, 0.0, where.west, 0.0, -where.cell_size, where.north)
        values = array.block(chunks)
        rasters[name] = Raster(values, transform, about.wkt, nodata, name, about.description)
    return rasters


def _window_of(grid: BlockGrid, box: Box) -> CellWindow:
    """Return the cells of the rasters of points in a box in units of the CRS."""
    step, unit = grid.step, grid.frame.horizontal_unit
    if step.cells.window is not None:
        return step.cells.window
    metres = (np.array(box) - np.tile(grid.frame.origin, 2)) * unit
    window = CellWindow.around(tuple(metres.tolist()), step.cell)
    if step.area is not None:
        bounds = step.area.scaled(unit, grid.frame.origin).bounds
        window = CellWindow.around(bounds, step.cell).within(window)
        if window.is_empty:
            raise no_point_in(step.area)
    return window


def _box_of(window: CellWindow, cell: float, more: float = 0.0) -> Box:
    """Return the box of cells in metres, wider by some more on each side."""
    (west, south), (rows, columns) = window.corner(cell), window.shape
    return west - more, south - more, west + columns * cell + more, south + rows * cell + more


def _shape(name: str, window: CellWindow) -> tuple[int, ...]:
    return window.shape if RASTERS[name].bands == 1 else (RASTERS[name].bands, *window.shape)


def _layers_of(
    grid: BlockGrid, index: BlockIndex, points: Sequence[Sequence[tuple[int, PointCloud]]]
) -> list[BlockRasters]:
    """Return the layers of a block, or of its parts, given the points of blocks round it."""
    area = Area(grid.window([index]))
    near = (cloud.take(np.flatnonzero(area.of(cloud))) for _, cloud in chain(*points))
    with SharedThreads(1).used():
        clouds = (cloud for cloud in near if cloud.count)
        work = values_of(grid, clouds, ONE_THREAD, places=[index])
    return [BlockRasters.of(arrays) for _, arrays in work.arrays]


def _cells_of(
    grid: BlockGrid, cells: CellWindow, reach: float, layers: Sequence[Sequence[BlockRasters]]
) -> dict[str, np.ndarray]:
    """Return the cells of a chunk of each raster, given how many metres away heights matter, and
    the layers of blocks round it.
    """
    step, unit, blocks = grid.step, grid.frame.horizontal_unit, [*chain(*layers)]
    empty = {
        name: np.full(
            _shape(name, cells), RASTERS[name].nodata(step.model.nodata), RASTERS[name].kind
        )
        for name in step.files.wanted
    }
    boxes = np.array([block.box for block in blocks]).reshape(-1, 4)
    boxes = boxes[~np.isnan(boxes).any(axis=1)]
    box, polygons = grid.in_crs(_box_of(cells, step.cell, reach)), ()
    if step.area is not None:
        box, polygons = shared_by(box, step.area.bounds), step.area.polygons
    if not len(boxes) or box[0] >= box[2] or box[1] >= box[3]:
        return empty
    area = Area(box, polygons)
    inside = CellWindow.around(area.scaled(unit, grid.frame.origin).bounds, step.cell)
    if inside.within(cells).within(CellWindow.around(box_round(boxes), step.cell)).is_empty:
        return empty
    collected = Collected()
    step = replace(step, area=area, placed_cells=replace(step.cells, window=cells))
    with SharedThreads(1).used(), Outputs() as outputs:
        write_rasters(blocks, grid.frame, step, outputs, write_cells=collected.add)
    return {name: raster.values for name, raster in collected.rasters.items()}
