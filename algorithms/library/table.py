"""The functions of the library: what is declared of each, imported when it is asked for."""

from __future__ import annotations

from functools import cache
from types import SimpleNamespace
from typing import Any, Callable

from ..engine.memory import Resources
from ..engine.options import TileInput, TileOutput
from ..survey.selection import Selection
from ..tools.contours import Contours
from ..tools.rasters.parameters import SurfaceModel
from . import arguments, tool_commands
from .arguments import REQUIRED, Argument, path
from .functions import Function
from .given import (
    area_of,
    checkpoints_of,
    constraints_of,
    corrections_of,
    progress_of,
    target_of,
    workers_of,
)
from .tools import of_tool

_REACHES = (arguments.SCHEDULER, arguments.PROGRESS)


def _deliver() -> Function:
    from ..delivery.deliveries import DEFAULT_DELIVERY, DELIVERIES
    from ..delivery.request import DeliveryOptions, DeliveryTerrain, DeliveryWater
    from ..delivery.summary import DeliverySummary
    from ..tools.check.accuracy import Accuracy

    def run(values: SimpleNamespace, sets: list[Any]) -> Any:
        from ..delivery.delivering import deliver
        from ..delivery.request import DeliveryRequest

        request = DeliveryRequest.of(
            sets, delivery=values.delivery, checkpoints=checkpoints_of(values), crs=values.crs,
            corrections=corrections_of(values), area=area_of(values),
            constraints=constraints_of(values), raster_target=target_of(values),
        )  # fmt: skip
        workers = workers_of(values, request.resources)
        progress = progress_of(values.progress)
        return deliver(values.sources, values.output, request, progress, workers)

    kinds = " ".join(f"{name}: {delivery.about}" for name, delivery in DELIVERIES.items()).rstrip(
        "."
    )
    folder = (
        "the folder for all outputs: a new or empty one, or that of an earlier delivery, which is"
        " replaced"
    )
    return Function(
        "deliver",
        "Classify raw points and make everything that a job hands over, in one folder.",
        (arguments.SOURCES, path("output", folder, REQUIRED)),
        (
            Argument.choice("delivery", DELIVERIES, DEFAULT_DELIVERY, f"what to deliver. {kinds}"),
            *arguments.CHECKPOINTS, arguments.CORRECTIONS,
            *arguments.area("deliver only", "; points nearby help to judge"),
            *arguments.WITH_AUTOMATIC_WATER, *arguments.TARGET, arguments.CRS_OF_OUTPUT, *_REACHES,
        ),
        (
            DeliveryOptions, Selection, DeliveryTerrain, SurfaceModel, Contours, DeliveryWater,
            Accuracy, TileInput, TileOutput, Resources,
        ),
        run,
        DeliverySummary,
        has_method=True,
    )  # fmt: skip


@cache
def declared(name: str) -> Function:
    """Return what is declared of a function, given its name."""
    commands = tool_commands()
    return of_tool(commands[name]) if name in commands else _deliver()


@cache
def function(name: str) -> Callable[..., Any]:
    """Return a function, given its name."""
    return declared(name).callable()
