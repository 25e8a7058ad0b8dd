"""Parameters of rasters: cell size, light, pictures of the relief, surface and gaps."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...core.parameters import ParameterSet, parameter, parameter_of
from ...rasters.cell_grid import CellGrid

# The largest number that rounds to one of 32 bits.
_LARGEST = 3.4028235e38


@dataclass(frozen=True)
class TerrainModel(ParameterSet):
    """Cell size and light of rasters of the terrain, and pictures of its relief."""

    dtm_cell_size: float = parameter(
        1.0,
        label="Cell size of the terrain model",
        unit="m",
        minimum=0.01,
        maximum=1000.0,
        help="Side of a cell of the terrain model and of its hillshade. Choose about the distance"
        " between ground points; smaller cells only make the file larger.",
    )
    dtm_cell_unit: str = parameter(
        "m",
        label="Unit of the cell size",
        choices={"m": "Metres", "crs": "Units of the CRS, such as its feet"},
        advanced=True,
        help="In a CRS in feet, a size of 3 in units of the CRS gives cells of exactly 3 feet that"
        " begin at whole multiples of 3 feet.",
    )
    raster_nodata: float | None = parameter(
        -9999.0,
        label="No-data value of the rasters",
        kind="number",
        minimum=-_LARGEST,
        maximum=_LARGEST,
        optional=True,
        advanced=True,
        empty="NaN",
        help="The value of cells without data. Choose one that no height has. Empty: NaN. The"
        " hillshade has 0.",
    )
    hillshade_light: str = parameter(
        "one",
        label="Light of the hillshade",
        choices={
            "one": "One light",
            "multidirectional": "Four lights, from southwest to north",
        },
        advanced=True,
        help="One light shows best the landforms that lie across it, but slopes that face away are"
        " dark. Four lights show landforms of any direction.",
    )
    hillshade_azimuth: float = parameter(
        315.0,
        label="Hillshade azimuth",
        unit="deg",
        minimum=0.0,
        maximum=360.0,
        advanced=True,
        help="Direction from which the light comes, clockwise from north. Four lights have their"
        " own directions.",
    )
    hillshade_altitude: float = parameter(
        45.0,
        label="Hillshade altitude",
        unit="deg",
        minimum=0.0,
        maximum=90.0,
        advanced=True,
        help="Angle of the light above the horizon.",
    )
    relief_smoothing: str = parameter(
        "automatic",
        label="Smoothing of pictures of the relief",
        choices={"automatic": "Automatic", "none": "None"},
        advanced=True,
        help="Automatic: for the pictures, heights are smoothed as much as they are noisy, so that"
        " low plants in a forest do not speckle them. Banks, ditches and walls stay sharp, and so"
        " does open ground. The terrain model does not change.",
    )
    relief_radius: float = parameter(
        10.0,
        label="Radius of the relief",
        unit="m",
        minimum=0.1,
        maximum=1000.0,
        advanced=True,
        help="Local relief, openness, sky view and the like compare a place with its surroundings"
        " up to this distance. Choose about the width of the features that you want to see; larger"
        " landforms disappear.",
    )
    error_factor: float = parameter(
        1.0,
        label="Factor of the expected error",
        minimum=0.05,
        maximum=20.0,
        advanced=True,
        help="The expected error is multiplied by this. A check against 30 checkpoints or more"
        " tells the factor with which it holds 95 % of the errors.",
    )

    def cells(self, unit: float) -> CellGrid:
        """Return the cells of rasters, given the metres in a unit of the CRS."""
        size = self.dtm_cell_size
        if self.dtm_cell_unit == "crs":
            return CellGrid(size * unit, size)  # 3 feet are exactly 3 feet
        return CellGrid(size, size / unit)

    @property
    def nodata(self) -> float:
        """The value of cells without data, as 32 bits hold it; NaN if it is empty."""
        return math.nan if self.raster_nodata is None else float(np.float32(self.raster_nodata))


@dataclass(frozen=True)
class MapTerrain(TerrainModel):
    """A terrain model with four lights by default, since landforms can run in any direction."""

    hillshade_light: str = parameter_of(TerrainModel, "hillshade_light", default="multidirectional")


@dataclass(frozen=True)
class Gaps(ParameterSet):
    """Which gaps of rasters stay open."""

    max_edge: float | None = parameter(
        None,
        kind="number",
        label="Maximum edge",
        unit="m",
        minimum=0.1,
        maximum=100_000.0,
        advanced=True,
        help="Gaps inside the survey are filled by triangles. A triangle with a longer edge than"
        " this has no data, for example over water. Empty: all gaps inside are filled. Beyond the"
        " outline of the points no raster has data in any case.",
    )


@dataclass(frozen=True)
class SurfaceModel(ParameterSet):
    """Which points form the surface, which gaps stay open, and whether pits are filled."""

    surface_returns: str = parameter(
        "first",
        label="Returns of the surface model",
        choices={"first": "First and single returns", "all": "All returns"},
        help="First returns hit the tops of trees and buildings. Take all returns if the return"
        " numbers of the file are wrong.",
    )
    surface_classes: tuple[int, ...] | None = parameter(
        None,
        kind="integers",
        label="Classes of the surface model",
        minimum=0,
        maximum=255,
        advanced=True,
        empty="all but noise",
        help="Only points of these classes make the surface, such as 41 for a water surface, or 2"
        " and 6 for terrain with buildings. Empty: all classes but low and high noise (7 and 18)"
        " and what lies in water (43 to 45); if the bottom of waters (40) is ground, their surfaces"
        " (41 and 42) are left out, too. So are 27 to 31 if 26 is ground in point formats 0 to 5,"
        " as NOAA writes.",
    )
    max_edge: float | None = parameter_of(Gaps, "max_edge", advanced=False)
    pit_free: bool = parameter(
        False,
        label="Fill pits of the canopy",
        advanced=True,
        help="Where a pulse passed between the branches, the canopy height has pits. This raises"
        " cells that lie over 2 m below the mean of their neighbours to the median of them, as"
        " crowns and trees are easier to find without pits. The surface model keeps them.",
    )


@dataclass(frozen=True)
class RasterOutput(ParameterSet):
    """How the rasters of many files are cut."""

    only_for_many = True

    raster_per_file: bool = parameter(
        False,
        label="One raster for each file",
        advanced=True,
        help="Cuts each raster of many files into one GeoTIFF for each file. They get the names of"
        " the files, in a folder with the name of the raster. A virtual raster (.vrt) beside this"
        " folder shows them as one.",
    )
