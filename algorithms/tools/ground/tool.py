"""The declaration of the tool that classifies the ground."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any, Mapping, Sequence

from ...classes.corrections import NO_CORRECTIONS
from ...classes.ground_classes import GroundClasses
from ...classes.selection import Selection
from ...core.errors import BareEarthError
from ...core.parameters import ParameterSet
from ...engine.memory import Resources
from ...engine.options import TileInput, TileOutput
from ...engine.step import Step
from ...filters import METHODS
from ...survey.area import Area
from ..above_ground import ClassifyAboveGround
from ..above_ground.classes import ThenAboveGround
from ..contours import Contours
from ..declaration import Input, MapTool
from ..heights import MeasureHeights
from ..rasters.parameters import RasterOutput, SurfaceModel, TerrainModel
from ..rasters.step import MakeRasters
from ..rasters.tool import TARGET, maps, rasters_of
from .method import TileMethod
from .output import PointOutput as Written
from .step import LabelGround


def _steps(
    sets: Sequence[ParameterSet], inputs: Mapping[str, Any], outputs: Mapping[str, Path]
) -> tuple[Step, ...]:
    """Return the steps for the ground, for what is above it, for rasters, and for heights."""
    selection, written, above = (
        Selection.among(sets), Written.among(sets), ThenAboveGround.among(sets),
    )  # fmt: skip
    area, corrections = inputs.get("area"), inputs.get("corrections") or NO_CORRECTIONS
    ground = GroundClasses.of_selection(selection)
    rasters = rasters_of(sets, inputs, outputs, ground, selection.roads)
    rasters = replace(rasters, covers_ground=written.ground_only and not rasters.needs_all)
    _check(written, area, above, rasters)
    points = inputs.get("input")
    if points is not None and points.is_survey and rasters.needs_all and written.ground_only:
        # A run that goes on later makes them of what was written.
        raise BareEarthError(
            "The surface model, the canopy height and the expected error need all points."
            " Write all points, not only the ground."
        )
    steps: list[Step] = [LabelGround(_method(sets), selection, area, written, None, corrections)]
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
    """Refuse options that contradict each other."""
    written.check_area(area is not None)
    if above.wanted and written.ground_only:
        raise BareEarthError(
            "Classes above the ground need all points. Write all points, not only the ground."
        )
    if rasters.constraints.any and not rasters.files.wanted:
        raise BareEarthError(
            "Breaklines, water, rivers and places without ground only change rasters. Choose a"
            " raster to make, such as the terrain model."
        )


_CONSTRAINTS = Input("constraints", "constraints", is_last=True)
_CORRECTIONS = Input("corrections", "corrections", is_last=True)
_AREA = Input(
    "area",
    "area",
    help="Only points in {area} are classified, and rasters have data only there. Points outside"
    " keep their class, but those nearby help to judge, and their ground helps along the border of"
    " rasters. Empty: all points.",
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
    inputs=(TARGET, _CONSTRAINTS, _AREA, _CORRECTIONS),
    dialog_inputs=(_AREA, _CORRECTIONS, _CONSTRAINTS, TARGET),
    outputs=maps,
    steps=_steps,
    classifies=True,
    command="classify",
    about="Only the classification changes in the output. A point of many files gets the class that"
    " it would get if all were one file, so there are no seams. A file that cannot be read is"
    " reported at the end. The same run can make rasters and contour lines of the terrain.",
)  # fmt: skip
