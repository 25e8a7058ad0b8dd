"""The declaration of deliveries."""

from __future__ import annotations

from typing import Any

from ..engine.memory import Resources
from ..engine.options import TileInput, TileOutput
from ..survey.selection import Selection
from ..tools.check.accuracy import Accuracy
from ..tools.contours import Contours
from ..tools.declaration import Composition, Input, Output
from ..tools.rasters.parameters import SurfaceModel
from ..tools.rasters.tool import CONSTRAINTS, TARGET
from .deliveries import DEFAULT_DELIVERY, DELIVERIES
from .parameters import DeliveryOptions, DeliveryTerrain, DeliveryWater


def _deliver(*given: Any) -> Any:
    from .running import deliver

    return deliver(*given)


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
    inputs=(
        Input("checkpoints", "checkpoints"),
        Input("corrections", "corrections"),
        Input("area", "area", help="deliver only", more="; points nearby help to judge"),
        CONSTRAINTS,
        TARGET,
    ),
    outputs=(
        Output(
            "output",
            "folder",
            help="the folder for all outputs: a new or empty one, or that of an earlier delivery,"
            " which is replaced",
            is_main=True,
        ),
    ),
    json="the figures",
    command="deliver",
    command_about="Classifies raw points and makes all outputs that a job hands over, in one"
    " folder: points, rasters, lines, figures of quality and accuracy, and a page that lists them"
    " (index.html). Each delivery has settings of its own. The options replace them.",
    function_about="Classify raw points and make everything that a job hands over, in one folder.",
)  # fmt: skip
