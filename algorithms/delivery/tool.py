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
    CLOUD_OUTPUT,
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
from .summary import DeliverySummary

# The parameters of deliveries alone.
OF_DELIVERIES = DeliveryOptions, DeliveryWater, Accuracy


def _deliver(*given: Any) -> DeliverySummary:
    from .running import deliver

    return deliver(*given)


_CHECKPOINTS = Input("checkpoints", "checkpoints", advanced=True, is_last=True)
_CORRECTIONS = Input("corrections", "corrections", is_last=True)
_AREA = Input(
    "area",
    "area",
    help="Only points in {area} are mapped and written. Points nearby help to judge. Empty: all"
    " points.",
)
_FOLDER = Output(
    "output",
    "folder",
    help="The folder for all outputs of a delivery: an empty or new one, or that of an earlier"
    " delivery, which is replaced.",
    label="Folder of the delivery",
    named="DELIVERY_FOLDER",
    is_main=True,
    by_default=False,
    page="Page of the delivery",
)
# Rasters that the dialog makes unless the user says no.
_USUAL = ("dtm", "hillshade", "dsm", "chm")
# Those of the relief that it has.
_RELIEFS = ("hillshade", "relief")


def _in_dialog() -> tuple[Output, ...]:
    """Return the folder of a delivery, and the outputs without one."""
    single = []
    for output in maps():
        row = RASTERS.get(output.name)
        if row is not None and row.is_relief and output.name not in _RELIEFS:
            continue
        if output.name == "contours":
            output = replace(output, label="Contour lines")
        is_folded = output.advanced and row is not None
        output = replace(output, by_default=output.name in _USUAL, advanced=is_folded)
        single.append(output)
    cloud = replace(CLOUD_OUTPUT, name="cloud", named="OUTPUT", is_main=False)
    return replace(_FOLDER, is_main=False), cloud, *single


TOOL = Composition(
    work=_deliver,
    tables=DELIVERIES,
    chosen="delivery",
    chosen_help="What to deliver.",
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
    identifier="pointcloudtoterrain",
    title="Point cloud to terrain",
    section="All in one",
    about="A delivery puts all of it into one folder: points, rasters, lines, figures of quality"
    " and accuracy, and a page that lists them (index.html). There are deliveries for a survey,"
    " archaeology, forestry, floods and a drone site. Each has settings of its own; your own"
    " settings override them. Lengths are metres.",
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
