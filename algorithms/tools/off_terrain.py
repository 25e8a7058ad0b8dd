"""Removes buildings, trees and other objects from the raster of a surface.

Lindsay, J. B. (2018): A new method for the removal of off-terrain objects from LiDAR-derived raster
surface models. doi:10.13140/RG.2.2.21226.62401. WhiteboxTools: RemoveOffTerrainObjects.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Callable

import numpy as np

from ..core.errors import BareEarthError
from ..core.memory import GIGABYTE, free_memory
from ..core.parameters import ParameterSet, parameter
from ..core.progress import SILENT, Progress
from ..grids.inpaint import inpaint
from ..grids.morphology import opening
from ..rasters.content import NO_CELLS, Source
from ..rasters.geotiff import NODATA, read_raster
from ..rasters.writing import write_geotiff
from .declaration import RASTER, TERRAIN, FileTool, Input, Output

# One direction of each opposite pair to the eight neighbours.
_DIRECTIONS = ((0, 1), (1, -1), (1, 0), (1, 1))
_RELAXATIONS = 40
# Number of neighbours from which a cell must rise gently. A way one cell wide is no hillside.
_WAYS = 2
_A_CELL = 50.0  # bytes of memory


@dataclass(frozen=True)
class OffTerrain(ParameterSet):
    """What counts as an object, and what as a hill."""

    max_object_size: float = parameter(
        40.0,
        label="Maximum object size",
        unit="m",
        minimum=0.1,
        maximum=1000.0,
        help="Shorter side of the largest building. A larger value takes longer, and may remove"
        " steep hilltops as objects.",
    )
    slope_threshold: float = parameter(
        15.0,
        label="Slope threshold",
        unit="deg",
        minimum=0.1,
        maximum=88.0,
        help="Objects have edges steeper than this on all sides. What rises more gently on some"
        " side is a hill. The slopes of the terrain below do not count.",
    )
    band: int = parameter(
        1,
        label="Band",
        minimum=1,
        maximum=65535,
        advanced=True,
        help="Number of the raster's band that holds the heights.",
    )


@dataclass(frozen=True)
class Removal:
    """Numbers of cells."""

    cell_count: int  # with a height
    removed_count: int  # of removed objects

    @property
    def text(self) -> str:
        """The counts in a sentence."""
        share = self.removed_count / self.cell_count
        return f"{self.removed_count:,} of {self.cell_count:,} cells were objects ({share:.1%})."


def remove_objects_file(
    source: Source,
    output: Path,
    parameters: OffTerrain = OffTerrain(),
    progress: Progress = SILENT,
    write: Callable[..., None] = write_geotiff,
    no_data: float = NODATA,
) -> Removal:
    """Write the raster of a surface, one that GDAL can read, without the objects on it, as a
    GeoTIFF of float32 with the same grid, CRS and unit.
    """
    _check_memory(source, parameters.band)
    # An error says if the raster has no heights, or its CRS is geographic.
    raster = read_raster(source, parameters.band, progress)
    raster.report(progress)
    progress(0.1)
    known = ~np.isnan(raster.heights)
    if not known.any():
        raise BareEarthError(f"{source} has no height in band {parameters.band}.")
    unit = raster.frame.vertical_unit
    heights, removed = remove_objects(
        raster.heights * np.float32(unit), raster.cell_metres, parameters, progress.part(0.1, 0.9)
    )
    # Other heights are written as they were, not converted back and forth.
    heights = np.where(removed, heights / unit, raster.heights)
    values = np.where(known, heights, no_data).astype(np.float32)
    write(output, values, raster, no_data, progress, "Height, {unit}")
    return Removal(int(np.count_nonzero(known)), int(np.count_nonzero(removed)))


def _check_memory(source: Source, band: int) -> None:
    """Refuse a raster whose cells take more memory than is free."""
    rows, columns = read_raster(source, band, window=NO_CELLS).whole
    needed, free = rows * columns * _A_CELL, free_memory()
    if needed > free:
        raise BareEarthError(
            f"{source} has {columns:,} x {rows:,} cells, which take {needed / GIGABYTE:.1f} GB of"
            f" memory; {free / GIGABYTE:.1f} GB are free. Cut it into parts that overlap."
        )


def remove_objects(
    heights: np.ndarray,
    cell_metres: tuple[float, float],
    parameters: OffTerrain = OffTerrain(),
    progress: Progress = SILENT,
) -> tuple[np.ndarray, np.ndarray]:
    """Return heights in metres without the objects with steep edges as float32, NaN where they
    were, and which cells belong to objects, bool (rows, columns).
    """
    # The white top-hat (heights above the opening with a disc as wide as the largest object) is
    # compared between neighbours. Cells that gentle steps reach from the terrain belong to hills;
    # the rest are objects. Cells of objects are filled smoothly from the cells around them.
    known = np.isfinite(heights)
    if not known.any():
        return heights.astype(np.float32), np.zeros(heights.shape, dtype=bool)
    radius = parameters.max_object_size / 2 / min(cell_metres)
    # A disc wider than the grid would only cost time.
    radius = min(radius, float(max(heights.shape)))
    filled = inpaint(heights).astype(np.float32)
    progress(0.1)
    above = filled - opening(filled, radius)
    progress(0.6)
    removed = known & ~_grown_back(above, known, cell_metres, parameters.slope_threshold, progress)
    progress(0.8)
    gaps = np.where(removed | ~known, np.float32(np.nan), heights)
    bare = inpaint(gaps, _RELAXATIONS).astype(np.float32)
    progress(1.0)
    return np.where(known, bare, np.float32(np.nan)), removed


def _grown_back(
    above: np.ndarray,
    known: np.ndarray,
    cell_metres: tuple[float, float],
    slope_threshold: float,
    progress: Progress,
) -> np.ndarray:
    """Return the cells that can be reached from the terrain by gentle or downward steps."""
    slope = math.tan(math.radians(slope_threshold))
    rows, columns = above.shape
    # With a border of unknown cells, so that each cell has eight neighbours.
    heights = np.pad(above, 1).ravel()
    free = np.pad(known, 1).ravel()
    ground = free & (heights <= slope * cell_metres[0])
    free &= ~ground
    ways = np.zeros(len(heights), dtype=np.uint8)
    front = np.flatnonzero(ground)
    steps = [
        (
            sign * (row * (columns + 2) + column),
            np.hypot(row * cell_metres[1], column * cell_metres[0]),
        )
        for row, column in _DIRECTIONS
        for sign in (1, -1)
    ]
    while len(front):
        reached = []
        for offset, length in steps:
            cells = front + offset
            gentle = free[cells]
            cells, origin = cells[gentle], front[gentle]
            cells = cells[heights[cells] - heights[origin] < slope * length]
            ways[cells] += 1
            cells = cells[ways[cells] == _WAYS]
            free[cells] = False
            reached.append(cells)
        front = np.concatenate(reached)
        ground[front] = True
        progress(0.6)
    return ground.reshape(rows + 2, columns + 2)[1:-1, 1:-1]


TOOL = FileTool(
    work=remove_objects_file,
    sets=(OffTerrain,),
    inputs=(
        Input(
            "source",
            "raster",
            help="A surface model: a raster file with a band of heights.",
            label="Elevation raster",
            named="INPUT",
        ),
    ),
    outputs=(
        Output(
            "output",
            "raster",
            help="The same raster, with the terrain in place of the objects.",
            label="Without objects",
            is_main=True,
            look="without objects",
        ),
    ),
    command="remove-off-terrain-objects",
    identifier="removeoffterrainobjects",
    title="Remove off-terrain objects",
    about="So a surface model becomes a terrain model, if there is no point cloud. An object stands"
    " above the terrain around it, has steep edges on all sides and is not wider than the maximum"
    " object size. The gaps are filled smoothly. Hills and slopes stay.\n"
    "The output has the same grid, CRS and unit. Lengths are metres, whatever the unit of the CRS.",
    page="relief#remove-off-terrain-objects",
    words=(
        TERRAIN,
        RASTER,
        "bare earth,surface,buildings,trees,vegetation,off-terrain objects,oto,whitebox,"
        "lindsay,top-hat",
    ),
    numbers=(("CELL_COUNT", "Cells with a height"), ("REMOVED_COUNT", "Cells of objects")),
)
