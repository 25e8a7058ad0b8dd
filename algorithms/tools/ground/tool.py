"""The declaration of the tool that classifies the ground; each filter has texts of its own."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Iterable

from ...core.parameters import ParameterSet, parameter_of
from ...engine.memory import Resources
from ...engine.options import TileInput, TileOutput
from ...survey.selection import Selection
from ..above_ground.classes import ThenAboveGround
from ..contours import Contours
from ..declaration import CLOUD, GROUND, TERRAIN, TILES, Tool
from ..rasters.parameters import Gaps, RasterOutput, SurfaceModel, TerrainModel
from .method import TileMethod
from .output import Output


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
    words=(CLOUD, GROUND, TERRAIN, TILES),
    shown=("method", "preset"),
    numbers=(
        ("TILE_COUNT", "Tiles"),
        ("DONE_COUNT", "Classified tiles"),
        ("KEPT_COUNT", "Tiles kept"),
        ("POINT_COUNT", "Points"),
        ("GROUND_COUNT", "Ground points"),
    ),
)  # fmt: skip
