"""Parameters of rasters of the terrain: cell size, light, and pictures of the relief."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...core.parameters import ParameterSet, parameter, parameter_of

# The largest number that rounds to one of 32 bits.
_LARGEST = 3.4028235e38


@dataclass(frozen=True)
class LocalRelief(ParameterSet):
    """The size of the features that pictures of the relief show, and their smoothing."""

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
    relief_smoothing: str = parameter(
        "automatic",
        label="Smoothing of pictures of the relief",
        choices={"automatic": "Automatic", "none": "None"},
        advanced=True,
        help="Automatic: for the pictures, heights are smoothed as much as they are noisy, so that"
        " low plants in a forest do not speckle them. Banks, ditches and walls stay sharp, and so"
        " does open ground. The terrain model does not change.",
    )

    @property
    def smooths(self) -> bool:
        """Whether heights are smoothed for pictures."""
        return self.relief_smoothing == "automatic"


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
    relief_smoothing: str = parameter_of(LocalRelief, "relief_smoothing")
    relief_radius: float = parameter_of(LocalRelief, "relief_radius")

    @property
    def relief(self) -> LocalRelief:
        """The parameters of pictures of the relief."""
        return LocalRelief(self.relief_radius, self.relief_smoothing)

    def cell_metres(self, unit: float) -> float:
        """Return the side of a cell in metres, given the metres in a unit of the CRS."""
        return self.dtm_cell_size * (unit if self.dtm_cell_unit == "crs" else 1.0)

    def cell_in_units(self, unit: float) -> float:
        """Return the side of a cell in units of the CRS, given the metres in one."""
        return self.dtm_cell_size / (1.0 if self.dtm_cell_unit == "crs" else unit)

    @property
    def nodata(self) -> float:
        """The value of cells without data, as 32 bits hold it; NaN if it is empty."""
        return math.nan if self.raster_nodata is None else float(np.float32(self.raster_nodata))


@dataclass(frozen=True)
class MapTerrain(TerrainModel):
    """The same with four lights by default, since landforms can run in any direction."""

    hillshade_light: str = parameter_of(TerrainModel, "hillshade_light", default="multidirectional")
