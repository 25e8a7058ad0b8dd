"""Canopy height from two rasters: a surface model minus a terrain model."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Callable, Iterator, NamedTuple

import numpy as np

from ..core.errors import BareEarthError
from ..core.parameters import ParameterSet, parameter_of
from ..core.progress import SILENT, Progress
from ..crs.matching import other_datums
from ..grids.canopy import PIT_PASSES, canopy_height, without_pits
from ..rasters.content import NO_CELLS, Source
from ..rasters.geotiff import NODATA, HeightBand, read_raster
from ..rasters.sampling import HeightRaster
from ..rasters.sparse import RasterPart
from ..rasters.windows import SampledWindows, is_same_grid
from ..rasters.writing import RasterCells, write_geotiff
from .declaration import CANOPY, RASTER, FileTool, Input, Output
from .rasters.parameters import SurfaceModel
from .rasters.rows import RASTERS

# Cells that are worked on at a time.
_CELLS = 4_000_000
# A surface that lies this far below the terrain, in metres, in most cells is not a surface model.
_BELOW = 1.0


@dataclass(frozen=True)
class CanopyModel(ParameterSet):
    """How the canopy height is made."""

    pit_free: bool = parameter_of(SurfaceModel, "pit_free", advanced=False)


@dataclass(frozen=True)
class Canopy:
    """What was found."""

    cell_count: int  # with a canopy height
    maximum: float  # the greatest height in the vertical unit of the surface model
    unit: str = ""  # symbol of that unit

    @property
    def text(self) -> str:
        """The result as a sentence."""
        highest = f"{self.maximum:.1f} {self.unit}".rstrip()
        return f"{self.cell_count:,} cells have a canopy height, up to {highest}."


class HeightBlock(NamedTuple):
    """Heights of two rasters in a block and round it, in metres."""

    first: np.ndarray
    second: np.ndarray
    inner: tuple[slice, slice]  # the cells of the block
    row: int  # of the first row and column in the raster
    column: int


class TwoHeights:
    """Heights of a raster and of another one at its cells, in metres."""

    def __init__(self, surface: HeightBand, terrain: Source, progress: Progress) -> None:
        self.surface, self.unit = surface, surface.frame.vertical_unit
        of_terrain = read_raster(terrain, window=NO_CELLS, progress=progress)
        self._terrain_unit = of_terrain.frame.vertical_unit
        _refuse_other_crs(surface, of_terrain, terrain, progress)
        self._terrain: HeightBand | SampledWindows = of_terrain
        if not is_same_grid(surface, of_terrain):
            progress.info(
                f"{terrain} is not on the grid of {surface.source}: its heights are interpolated"
                " at the centres of these cells."
            )
            self._terrain = SampledWindows(terrain, surface, self._terrain_unit)

    def rows(self, *part: int) -> tuple[np.ndarray, np.ndarray]:
        """Return some rows and columns of the surface and of the terrain, as `Raster.rows`."""
        surface = self.surface.rows(*part).astype(np.float64) * self.unit
        if isinstance(self._terrain, HeightBand):
            return surface, self._terrain.rows(*part).astype(np.float64) * self._terrain_unit
        south, north, west, east = part
        return surface, self._terrain[south:north, west:east]

    def cells(
        self, margin: int, work: Callable[[HeightBlock], np.ndarray], progress: Progress
    ) -> RasterCells:
        """Return the cells of a raster on the grid of the first one: what `work` makes of a block
        and of so many cells round it, in metres, NaN for no value.
        """

        def parts() -> Iterator[RasterPart]:
            for start, end in stored.strips(_CELLS):
                for first, last in stored.runs(start, end, margin):
                    south, west = max(start - margin, 0), max(first - margin, 0)
                    both = self.rows(south, end + margin, west, last + margin)
                    inner = slice(start - south, end - south), slice(first - west, last - west)
                    made = work(HeightBlock(*both, inner, south, west)) / self.unit
                    cells = np.where(np.isnan(made), NODATA, made).astype(np.float32)
                    yield RasterPart(start, first, cells)
                progress(end / self.surface.whole[0])

        stored = self.surface.stored
        return RasterCells(self.surface.whole, "float32", parts(), made=stored.cells_of(_CELLS))


def canopy_of_rasters(
    surface: Source,
    terrain: Source,
    output: Path,
    parameters: CanopyModel = CanopyModel(),
    progress: Progress = SILENT,
) -> Canopy:
    """Write the height of a surface model above a terrain model, on the grid of the surface."""
    raster = read_raster(surface, window=NO_CELLS, progress=progress)
    heights = TwoHeights(raster, terrain, progress)
    found = _CanopyCells()

    def canopy_of(block: HeightBlock) -> np.ndarray:
        found.add((block.first - block.second)[block.inner])
        canopy = canopy_height(block.first, block.second)
        return (without_pits(canopy) if parameters.pit_free else canopy)[block.inner]

    margin = PIT_PASSES if parameters.pit_free else 0
    cells = heights.cells(margin, canopy_of, progress.part(0.0, 0.9))
    write_geotiff(output, cells, raster, NODATA, progress.part(0.9, 1.0), RASTERS["chm"].shows)
    raster.report(progress)
    read_raster(terrain, window=NO_CELLS).report(progress)
    found.check(surface, terrain)
    return Canopy(found.count, found.maximum / heights.unit, raster.unit_symbol)


class _CanopyCells:
    """The cells with a height so far."""

    def __init__(self) -> None:
        self.count, self.below, self.maximum = 0, 0, 0.0

    def add(self, differences: np.ndarray) -> None:
        """Add cells, NaN where one of the rasters has no value."""
        self.count += int(np.count_nonzero(~np.isnan(differences)))
        self.below += int(np.count_nonzero(differences < -_BELOW))
        self.maximum = float(np.fmax.reduce(differences, axis=None, initial=self.maximum))

    def check(self, surface: Source, terrain: Source) -> None:
        """Refuse rasters that do not overlap, and those in the wrong order."""
        if not self.count:
            raise BareEarthError(
                f"No cell has a value in both {surface} and {terrain}. Give two rasters of the"
                " same place."
            )
        if self.below > self.count / 2:
            raise BareEarthError(
                f"{surface} lies more than {_BELOW:g} m below {terrain} in {self.below:,} of"
                f" {self.count:,} cells. Give the surface model first, and rasters whose heights"
                " have one unit and one vertical datum."
            )


def _refuse_other_crs(
    surface: HeightBand, terrain: HeightBand, name: Source, progress: Progress
) -> None:
    """Refuse a terrain model in another CRS, and warn of another vertical datum."""
    if not (surface.frame.wkt and terrain.frame.wkt):
        return
    HeightRaster.of(name).check(surface.crs, str(surface.source))
    if told := other_datums((surface.source, name), surface.crs, terrain.crs):
        progress.warning(f"{told} They are compared as they are.")


_raster = partial(Input, kind="raster")
TOOL = FileTool(
    work=canopy_of_rasters,
    sets=(CanopyModel,),
    inputs=(
        _raster(
            "surface",
            help="A surface model: a raster file with a band of heights.",
            label="Surface model (DSM)",
        ),
        _raster(
            "terrain",
            help="The terrain model of the same place, in the CRS of the surface model. On another"
            " grid, its heights are interpolated.",
            label="Terrain model (DTM)",
        ),
    ),
    outputs=(
        Output(
            "output",
            "raster",
            help="The height of the surface above the terrain, on the grid of the surface model.",
            label="Canopy height (CHM)",
            is_main=True,
            look="chm",
        ),
    ),
    command="canopy",
    identifier="canopyheight",
    title="Canopy height from two rasters",
    about="For the surface model and the terrain model of a survey whose points you do not have."
    " Cells are 0 where the surface lies below the terrain, and empty where either raster is.\n"
    "With points, make the canopy height of them: a cell of a surface model holds its highest"
    " point, so that on slopes the difference of two rasters is too large, by half of the rise"
    " over a cell.",
    page="terrain-model#canopy-height-from-two-rasters",
    run_name="canopy",
    words=(CANOPY, RASTER, "dsm,dtm,canopy height model,difference,subtract,raster calculator"),
    numbers=(("CELL_COUNT", "Cells with a height"), ("MAXIMUM", "Greatest height")),
)
