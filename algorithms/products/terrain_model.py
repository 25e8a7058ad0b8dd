"""Parameters of rasters of the terrain: cell size, light, and pictures of the relief."""

from __future__ import annotations

from dataclasses import dataclass

from ..core.parameters import ParameterSet, parameter, parameter_of
from .local_relief import LocalRelief


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
    def smooths(self) -> bool:
        """Whether heights are smoothed for pictures."""
        return self.relief_smoothing == "automatic"


@dataclass(frozen=True)
class MapTerrain(TerrainModel):
    """The same with four lights by default, since landforms can run in any direction."""

    hillshade_light: str = parameter_of(TerrainModel, "hillshade_light", default="multidirectional")
