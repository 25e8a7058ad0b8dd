"""The declaration of the tool that classifies the ground; each filter has texts of its own."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Iterable

from ...core.parameters import ParameterSet, parameter, parameter_of
from ...engine.memory import Resources
from ...engine.options import TileInput, TileOutput
from ...filters import DEFAULT_METHOD, METHODS
from ...filters.method import TERRAINS
from ...survey.selection import Selection
from ..above_ground.classes import ThenAboveGround
from ..contours import Contours
from ..declaration import Tool
from ..rasters.parameters import Gaps, RasterOutput, SurfaceModel, TerrainModel
from .output import Output


@dataclass(frozen=True)
class TileMethod(ParameterSet):
    """The ground filter, by its name and a preset."""

    method: str = parameter(
        DEFAULT_METHOD,
        label="Method",
        choices={name: method.label for name, method in METHODS.items()},
        help="The ground filter. TIN densification is the most accurate.",
    )
    preset: str = parameter(
        "automatic",
        label="Preset",
        choices=TERRAINS,
        help="The values of the method for a kind of terrain. For other values, use the command"
        " line or the algorithm of the method.",
    )

    @property
    def parameters(self) -> ParameterSet:
        """The parameters of the method."""
        return METHODS[self.method].parameters(preset=self.preset)


@dataclass(frozen=True)
class ShownTiles(TileOutput):
    """The same with an overview by default, since QGIS shows the tiles at once."""

    overview: bool = parameter_of(TileOutput, "overview", default=True)


def as_command(sets: Iterable[ParameterSet]) -> list[ParameterSet]:
    """Return parameter sets of a dialog as those of the command, whose defaults differ."""
    return [TileOutput(**vars(each)) if isinstance(each, ShownTiles) else each for each in sets]


TOOL = Tool(
    # Behind the parameters of the method.
    sets=(
        Selection, ThenAboveGround, TerrainModel, SurfaceModel, Contours, Output, TileInput,
        TileOutput, RasterOutput, Resources,
    ),
    dialog_sets=(
        TileMethod, Selection, TileInput, ShownTiles, Output, ThenAboveGround, TerrainModel, Gaps,
        RasterOutput, Resources,
    ),
    command="classify",
    command_about="Classifies the ground points of LAS, LAZ and COPC files. Only the classification"
    " changes in the output.",
    identifier="classifytiles",
    title="Classify ground (many files)",
    section="Ground classification",
    summary="Finds the ground points of the many files of a survey, without seams between them.",
    about="Classifies the ground points of many files as if they were one file, and writes each"
    " file under its name into the output folder. A virtual point cloud (.vpc) lists the results.",
    page="classify-tiles",
    shown=("method", "preset"),
    numbers=(
        ("TILE_COUNT", "Tiles"),
        ("DONE_COUNT", "Classified tiles"),
        ("KEPT_COUNT", "Tiles kept"),
        ("POINT_COUNT", "Points"),
        ("GROUND_COUNT", "Ground points"),
    ),
)  # fmt: skip
