"""The declaration of the tool that makes rasters of the terrain, and of what stands on it."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Mapping, Sequence

from ...classes.ground_classes import GroundClasses
from ...core.errors import BareEarthError
from ...core.parameters import ParameterSet
from ...core.progress import Progress
from ...engine.memory import Resources
from ...engine.options import TileInput
from ...rasters.cell_grid import ANYWHERE
from ...survey.files import Inputs
from ..contours import CONTOUR_HELP, Contours
from ..declaration import CANOPY, CLOUD, RASTER, TERRAIN, TIN, Input, MapTool, Output
from ..water.tool import found_water
from .constraints import NO_CONSTRAINTS, Constraints
from .parameters import Gaps, RasterOutput, SurfaceModel, TerrainModel
from .rows import RASTERS, RasterFiles
from .step import MakeRasters

# The rasters that the dialog folds away.
_FOLDED = ("error_cause",)


PLACES = Output(
    "places",
    "features",
    "The places to review, where the expected error is large: polygons with the reason, for which"
    " terrain model, expected error and its cause are made too. With corrections, their answers are"
    " carried over.",
    label="Places to review",
    advanced=True,
    by_default=False,
    drawn_by="review",
    drawn_of={"source": "expected_error", "dtm": "dtm", "cause": "error_cause"},
)


def maps() -> tuple[Output, ...]:
    """Return the outputs of all runs that make rasters."""
    rasters = (
        Output(
            name, "raster", row.help, label=row.label, by_default=name in ("dtm", "hillshade"),
            advanced=name in _FOLDED,
        )
        for name, row in RASTERS.items()
    )  # fmt: skip
    lines = Output(
        "contours", "features", CONTOUR_HELP, drawn_by="contours", drawn_of={"source": "dtm"}
    )
    return *rasters, lines, PLACES


def rasters_of(
    sets: Sequence[ParameterSet],
    inputs: Mapping[str, Any],
    outputs: Mapping[str, Path],
    ground: GroundClasses,
    roads: tuple[int, ...] = (),
) -> MakeRasters:
    """Return the step that makes the wanted rasters, given which points are ground."""
    gaps = next((values.max_edge for values in sets if isinstance(values, Gaps)), None)
    surface = SurfaceModel.among(sets) if gaps is None else SurfaceModel(max_edge=gaps)
    return MakeRasters(
        files=RasterFiles(**{name: outputs.get(name) for name in RASTERS}),
        model=TerrainModel.among(sets), surface=surface, ground=ground, roads=roads,
        constraints=inputs.get("constraints") or NO_CONSTRAINTS, area=inputs.get("area"),
        per_file=RasterOutput.among(sets).raster_per_file,
        target=inputs.get("raster_target") or ANYWHERE,
    )  # fmt: skip


def _steps(
    sets: Sequence[ParameterSet], inputs: Mapping[str, Any], outputs: Mapping[str, Path]
) -> tuple[MakeRasters]:
    """Return the step for points that are classified."""
    ground = GroundClasses.among(sets)
    step = rasters_of(sets, inputs, outputs, ground, inputs.get("roads") or ())
    if not step.files.wanted:
        raise BareEarthError("Choose at least one raster to make.")
    if not ground.ground_classes:
        raise BareEarthError("Choose at least one ground class.")
    return (step,)


def _found(sources: Inputs, ground: GroundClasses, progress: Progress) -> Constraints:
    """Return the water of classified files."""
    water, _ = found_water(sources, ground, progress)
    return water.constraints


def _in_dialog() -> tuple[Output, ...]:
    """Return the rasters in the dialog, without the ones that the tool for reliefs makes."""
    names = [name for name, row in RASTERS.items() if not row.is_relief or name == "hillshade"]
    return tuple(output for output in maps() if output.name in names)


TARGET = Input("raster_target", "target", is_last=True)
_AREA = Input(
    "area",
    "area",
    help="The rasters have data only in {area}. Points outside still help along the border. Empty:"
    " the rasters cover all points.",
    advanced=True,
    is_last=True,
)
CONSTRAINTS = Input("constraints", "constraints", found=_found, is_last=True)
TOOL = MapTool(
    sets=(
        GroundClasses, TerrainModel, SurfaceModel, Contours, TileInput, RasterOutput, Resources,
    ),
    dialog_sets=(GroundClasses, TerrainModel, SurfaceModel, RasterOutput, Resources),
    inputs=(TARGET, _AREA, CONSTRAINTS),
    dialog_inputs=(_AREA, CONSTRAINTS, TARGET),
    outputs=maps,
    steps=_steps,
    dialog_outputs=_in_dialog,
    command="terrain",
    identifier="terrainmodel",
    title="Terrain, surface and canopy height models",
    about="The terrain is interpolated on the triangulation (TIN) of the ground points. The surface"
    " is the highest point of each cell without noise, and canopy height is the difference of the"
    " two. All rasters (GeoTIFF) lie on the same grid. Heights are in the vertical unit of the CRS."
    " Only the rasters that you ask for are made; ask for at least one.",
    words=(CLOUD, TERRAIN, CANOPY, TIN, RASTER),
    page="terrain-model",
    run_name="terrain and surface",
    shown=("dtm_cell_size", "max_edge"),
    numbers=(("GROUND_COUNT", "Ground points"), ("SURFACE_COUNT", "Points of the surface")),
)  # fmt: skip
