"""The declaration of the tool that classifies the ground; each filter has texts of its own."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Iterable, Mapping, Sequence

from ...classes.corrections import NO_CORRECTIONS
from ...classes.ground_classes import GroundClasses
from ...classes.selection import Selection
from ...core.errors import BareEarthError
from ...core.parameters import ParameterSet, parameter_of
from ...engine.memory import Resources
from ...engine.options import TileInput, TileOutput
from ...engine.step import Step
from ...filters import METHODS
from ...survey.area import Area
from ..above_ground import ClassifyAboveGround
from ..above_ground.classes import ThenAboveGround
from ..contours import Contours
from ..declaration import CLOUD, GROUND, TERRAIN, TILES, Input, MapTool, Output
from ..heights import MeasureHeights
from ..rasters.parameters import Gaps, RasterOutput, SurfaceModel, TerrainModel
from ..rasters.step import MakeRasters
from ..rasters.tool import maps, rasters_of
from .method import TileMethod
from .output import Output as Written
from .step import LabelGround


@dataclass(frozen=True)
class ShownTiles(TileOutput):
    """How tiles are written, with an overview by default, since QGIS shows them at once."""

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


_CLOUD = Output(
    "output",
    "cloud",
    "",
    label="Classified point cloud",
    field_help="The same points with their new classes.",
    is_main=True,
)
_FOLDER = Output(
    "output",
    "folder",
    "",
    label="Folder of the classified point clouds",
    field_help="The folder for the classified files. Each keeps its name.",
    named="OUTPUT_FOLDER",
    is_main=True,
)
_LIST = Output(
    "vpc",
    "list",
    "",
    label="Virtual point cloud",
    field_help="A list of the classified files, which QGIS 3.32 and newer shows as one layer."
    " Without a name it is classified.vpc in their folder.",
    named="OUTPUT_VPC",
    by_default=False,
)


def _outputs() -> tuple[Output, ...]:
    """Return rasters, contour lines, and the raster of rules."""
    return *maps(), _EXPLANATION


def _of_file() -> tuple[Output, ...]:
    """Return the outputs in the dialogs of one file."""
    return _CLOUD, *_usual_maps(), _EXPLANATION


def _of_tiles() -> tuple[Output, ...]:
    """Return the outputs in the dialog of many files."""
    return _FOLDER, _LIST, *_usual_maps()


def _usual_maps() -> list[Output]:
    named = {output.name: output for output in maps()}
    error = replace(named["expected_error"], by_default=False, advanced=True)
    return [named["dtm"], named["hillshade"], error]


def _steps(
    sets: Sequence[ParameterSet], inputs: Mapping[str, Any], outputs: Mapping[str, Path]
) -> tuple[Step, ...]:
    """Return the steps for the ground, for what is above it, for rasters, and for heights."""
    selection, written, above = (
        Selection.among(sets), Written.among(sets), ThenAboveGround.among(sets),
    )  # fmt: skip
    area, corrections = inputs.get("area"), inputs.get("corrections") or NO_CORRECTIONS
    explain, ground = outputs.get("explain"), GroundClasses.of_selection(selection)
    rasters = rasters_of(sets, inputs, outputs, ground, selection.roads)
    rasters = replace(rasters, covers_ground=written.ground_only and not rasters.needs_all)
    _check(written, area, above, rasters)
    steps: list[Step] = [
        LabelGround(_method(sets), selection, area, written, None, corrections, explain)
    ]
    if above.wanted:
        steps.append(ClassifyAboveGround(above, ground, area, corrections))
    if written.height_above_ground:
        within = area if written.area_only else None
        steps.append(MeasureHeights(ground, area=within, roads=selection.roads))
    if rasters.files.wanted:
        steps.append(rasters)
    return tuple(steps)


def _method(sets: Sequence[ParameterSet]) -> ParameterSet:
    """Return the parameters of the ground filter."""
    kinds = tuple(method.parameters for method in METHODS.values())
    chosen = next((values for values in sets if isinstance(values, kinds)), None)
    return chosen or TileMethod.among(sets).parameters


def _check(
    written: Written,
    area: Area | None,
    above: ThenAboveGround,
    rasters: MakeRasters,
) -> None:
    """Refuse what does not fit together."""
    written.check_area(area is not None)
    if above.wanted and written.ground_only:
        raise BareEarthError(
            "Classes above the ground need all points. Write all points, not only the ground."
        )
    if written.looks != "1" and "expected_error" not in rasters.files.layers:
        raise BareEarthError(
            "Several looks at the ground make only the expected error more certain. Make its"
            " raster, or look once."
        )
    if rasters.constraints.any and not rasters.files.wanted:
        raise BareEarthError(
            "Breaklines, water, rivers and places without ground only change rasters. Choose a"
            " raster to make, such as the terrain model."
        )


_ABOUT = (
    " Many files, folders and virtual point clouds are one survey: each point gets the class that"
    " it would get if all were one file, so there are no seams. A file that cannot be classified"
    " is reported at the end. To see the parameters of a method, name it before you ask for help."
)
_TARGET = Input("raster_target", "target", is_last=True)
_CONSTRAINTS = Input("constraints", "constraints", is_last=True)
_CORRECTIONS = Input("corrections", "corrections", is_last=True)
_AREA = Input(
    "area",
    "area",
    help="classify only points in",
    more="; points outside are written too, with the class that they have, unless `area_only` is"
    " given; rasters end at its border",
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
    inputs=(_TARGET, _CONSTRAINTS, _AREA, _CORRECTIONS),
    dialog_inputs=(_AREA, _CORRECTIONS, _CONSTRAINTS, _TARGET),
    outputs=_outputs,
    steps=_steps,
    classifies=True,
    command="classify",
    command_about="Classifies the ground points of LAS, LAZ and COPC files. Only the classification"
    f" changes in the output.{_ABOUT}",
    function_about="Classify the ground points of a file, or of many files as one survey, and make"
    " products of them.",
)  # fmt: skip
TILES_TOOL = replace(
    TOOL,
    points=Input("input", "files", label="Point clouds"),
    dialog_inputs=(replace(_AREA, advanced=True), _CORRECTIONS, _CONSTRAINTS, _TARGET),
    dialog_outputs=_of_tiles,
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
    page="many-files",
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
# The dialogs of one file, one for each method.
METHOD_TOOLS = tuple(
    replace(
        TOOL,
        method=method.name,
        points=Input("input", "cloud", label="Point cloud"),
        dialog_outputs=_of_file,
        dialog_sets=(
            method.parameters, Selection, TerrainModel, Gaps, Written, ThenAboveGround, Resources,
        ),
        section="Ground classification",
        identifier=method.toolbox.identifier,
        title=method.toolbox.title,
        summary=method.toolbox.summary,
        about=method.toolbox.about,
        page=method.toolbox.page,
        run_name=method.label,
        words=(CLOUD, GROUND, TERRAIN, *method.toolbox.words),
        shown=("preset", method.size_parameter, "dtm_cell_size"),
        numbers=(
            ("POINT_COUNT", "Points"),
            ("AREA_COUNT", "Points in the area"),
            ("SELECTED_COUNT", "Points that took part"),
            ("GROUND_COUNT", "Ground points"),
        ),
    )
    for method in METHODS.values()
)  # fmt: skip
