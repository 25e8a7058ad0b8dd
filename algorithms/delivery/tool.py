"""The declaration of deliveries."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from ..classes.selection import Selection
from ..engine.memory import Resources
from ..engine.options import TileInput, TileOutput
from ..tools.check.accuracy import Accuracy
from ..tools.contours import Contours
from ..tools.declaration import (
    CANOPY,
    CLOUD,
    CRS,
    GROUND,
    TERRAIN,
    TILES,
    Composition,
    Input,
    Output,
)
from ..tools.ground.method import TileMethod
from ..tools.rasters.parameters import SurfaceModel
from ..tools.rasters.rows import RASTERS
from ..tools.rasters.tool import CONSTRAINTS, TARGET, maps
from .deliveries import DEFAULT_DELIVERY, DELIVERIES
from .parameters import DeliveryChoice, DeliveryOptions, DeliveryTerrain, DeliveryWater

# The parameters of deliveries alone.
OF_DELIVERIES = DeliveryOptions, DeliveryWater, Accuracy


def _deliver(*given: Any) -> Any:
    from .running import deliver

    return deliver(*given)


_CHECKPOINTS = Input("checkpoints", "checkpoints", advanced=True, is_last=True)
_CORRECTIONS = Input("corrections", "corrections", is_last=True)
_AREA = Input(
    "area",
    "area",
    help="deliver only",
    more="; points nearby help to judge",
    area_help=(
        "Only points in this rectangle are mapped and written. Points nearby help to judge. Empty:"
        " all points.",
        "Only points in these polygons are mapped and written; with an extent, only points in both."
        " Points nearby help to judge. Empty: all points.",
    ),
)
_FOLDER = Output(
    "output",
    "folder",
    help="the folder for all outputs: a new or empty one, or that of an earlier delivery, which is"
    " replaced",
    label="Folder of the delivery",
    field_help="The folder for all outputs of a delivery: an empty or new one, or that of an"
    " earlier delivery, which is replaced.",
    named="DELIVERY_FOLDER",
    is_main=True,
    by_default=False,
    page="Page of the delivery",
)
_CLOUD = Output(
    "cloud",
    "cloud",
    "",
    label="Classified point cloud",
    field_help="The same points with their new classes.",
    named="OUTPUT",
)
_CONTOURS = (
    "Lines of equal height of the terrain model, with the field ELEV. They are smoothed, so that"
    " they do not show noise. Every fifth line has its height as a label."
)
# Rasters that the dialog makes unless the user says no.
_USUAL = ("dtm", "hillshade", "dsm", "chm")
# Those of the relief that it has.
_RELIEFS = ("hillshade", "relief")


def _in_dialog() -> tuple[Output, ...]:
    """Return the folder of a delivery, and the outputs without one."""
    single = []
    for output in maps():
        if output.name == "contours":
            output = replace(output, label="Contour lines", field_help=_CONTOURS)
        elif RASTERS[output.name].is_relief and output.name not in _RELIEFS:
            continue
        single.append(replace(output, by_default=output.name in _USUAL))
    return replace(_FOLDER, is_main=False), _CLOUD, *single


TOOL = Composition(
    work=_deliver,
    tables=DELIVERIES,
    chosen="delivery",
    chosen_help="what to deliver",
    default=DEFAULT_DELIVERY,
    sets=(
        DeliveryOptions, Selection, DeliveryTerrain, SurfaceModel, Contours, DeliveryWater,
        Accuracy, TileInput, TileOutput, Resources,
    ),
    titles=(
        "Delivery", "Which points, which classes", "Terrain model", "Surface model and gaps",
        "Contour lines", "Water", "Checkpoints", "Files", "Output of many files",
        "Threads and memory",
    ),
    inputs=(_CHECKPOINTS, _CORRECTIONS, _AREA, CONSTRAINTS, TARGET),
    outputs=(_FOLDER,),
    json="the figures",
    command="deliver",
    command_about="Classifies raw points and makes all outputs that a job hands over, in one"
    " folder: points, rasters, lines, figures of quality and accuracy, and a page that lists them"
    " (index.html). Each delivery has settings of its own. The options replace them.",
    function_about="Classify raw points and make everything that a job hands over, in one folder.",
    identifier="pointcloudtoterrain",
    title="Point cloud to terrain",
    section="All in one",
    summary="Makes a map of the terrain of a raw point cloud: classes, models, contours.",
    about="Finds the ground of a raw lidar point cloud and makes maps of it. Each output is"
    " optional. A delivery makes all that a job hands over, in one folder: for a survey,"
    " archaeology, forestry, floods or a drone site. Lengths are metres.",
    page="terrain-model#point-cloud-to-terrain",
    words=(
        CLOUD, GROUND, TERRAIN, CANOPY, TILES, "contours,workflow",
        "deliverables,archaeology,forestry,flood,drone,stockpile",
    ),
    shown=("delivery", "method", "preset", "dtm_cell_size", "contour_interval"),
    dialog_sets=(
        DeliveryChoice, TileMethod, DeliveryTerrain, Contours, Selection, SurfaceModel, Resources,
        *OF_DELIVERIES,
    ),
    dialog_inputs=(
        Input("sources", "survey", label="Point cloud"), CRS, _AREA, _CORRECTIONS, CONSTRAINTS,
        TARGET, _CHECKPOINTS,
    ),
    dialog_outputs=_in_dialog,
    numbers=(("POINT_COUNT", "Points"), ("GROUND_COUNT", "Ground points")),
    texts=(("VERDICT", "Verdict"),),
)  # fmt: skip
