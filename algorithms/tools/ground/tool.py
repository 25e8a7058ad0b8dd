"""The declaration of the tool that classifies the ground; each filter has texts of its own."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Iterable

from ...core.parameters import ParameterSet, parameter_of
from ...engine.memory import Resources
from ...engine.options import TileInput, TileOutput
from ...survey.selection import Selection
from ..above_ground.classes import ThenAboveGround
from ..contours import Contours
from ..declaration import CLOUD, GROUND, TERRAIN, TILES, Input, MapTool, Output
from ..rasters.parameters import Gaps, RasterOutput, SurfaceModel, TerrainModel
from ..rasters.tool import maps
from .method import TileMethod
from .output import Output as Written


@dataclass(frozen=True)
class ShownTiles(TileOutput):
    """The same with an overview by default, since QGIS shows the tiles at once."""

    overview: bool = parameter_of(TileOutput, "overview", default=True)


def as_command(sets: Iterable[ParameterSet]) -> list[ParameterSet]:
    """Return parameter sets of a dialog as those of the command, whose defaults differ."""
    return [
        TileOutput(**vars(values)) if isinstance(values, ShownTiles) else values for values in sets
    ]


_EXPLANATION = Output(
    "explain",
    "raster",
    "of one file: write a GeoTIFF of the rule that decided each cell; its band lists the rules",
    label="Rule that decided each cell",
    field_help="A raster that tells why a place is ground or not: the rule of the filter that"
    " decided the cell. Its legend names the rules. Presets that decide points, not cells, cannot"
    " make it.",
    named="EXPLANATION",
    by_default=False,
    advanced=True,
)


def _outputs() -> tuple[Output, ...]:
    """Return rasters, contour lines, and the raster of rules."""
    return *maps(), _EXPLANATION


_ABOUT = (
    " Many files, folders and virtual point clouds are one survey: each point gets the class that"
    " it would get if all were one file, so there are no seams. A file that cannot be classified"
    " is reported at the end. To see the parameters of a method, give --method before --help."
)
TOOL = MapTool(
    # Behind the parameters of the method.
    sets=(
        Selection, ThenAboveGround, TerrainModel, SurfaceModel, Contours, Written, TileInput,
        TileOutput, RasterOutput, Resources,
    ),
    titles=(
        "Which points, which classes", "Above the ground", "Terrain model",
        "Surface model and gaps", "Contour lines", "Output", "Files", "Output of many files",
        "Rasters of many files", "Threads and memory",
    ),
    json="the counts",
    inputs=(
        Input("raster_target", "target"),
        Input("constraints", "constraints"),
        Input(
            "area",
            "area",
            help="classify only points in",
            more="; points outside are written too, with the class that they have, unless"
            " `area_only` is given; rasters end at its border",
        ),
        Input("corrections", "corrections"),
    ),
    outputs=_outputs,
    classifies=True,
    command="classify",
    command_about="Classifies the ground points of LAS, LAZ and COPC files. Only the classification"
    f" changes in the output.{_ABOUT}",
    function_about="Classify the ground points of a file, or of many files as one survey, and make"
    " products of them.",
)  # fmt: skip
TILES_TOOL = replace(
    TOOL,
    is_survey=True,
    command="classify-tiles",
    command_about="Classifies the ground points of LAS, LAZ and COPC files, and writes each into a"
    f" folder.{_ABOUT}",
    dialog_sets=(
        TileMethod, Selection, TileInput, ShownTiles, Written, ThenAboveGround, TerrainModel, Gaps,
        RasterOutput, Resources,
    ),
    identifier="classifytiles",
    title="Classify ground (many files)",
    section="Ground classification",
    summary="Finds the ground points of the many files of a survey, without seams between them.",
    about="Classifies the ground points of many files as if they were one file, and writes each"
    " file under its name into the output folder. A virtual point cloud (.vpc) lists the results.",
    page="classify-tiles",
    run_name="classified files",
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
