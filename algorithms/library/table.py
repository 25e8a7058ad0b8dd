"""The functions of the library: what is declared of each, imported when it is asked for."""

from __future__ import annotations

import contextlib
from functools import cache
from types import SimpleNamespace
from typing import Any, Callable, Iterator

from ..core.progress import Progress
from ..engine.memory import Resources
from ..engine.options import TileInput, TileOutput
from ..survey.ground_classes import GroundClasses
from ..survey.selection import Selection
from ..tools.contours import Contours
from ..tools.rasters.parameters import RasterOutput, SurfaceModel, TerrainModel
from . import arguments, tool_commands
from .arguments import REQUIRED, Argument, path
from .functions import Function
from .given import (
    area_of,
    checkpoints_of,
    constraints_of,
    corrections_of,
    is_automatic,
    path_of,
    paths_of,
    progress_of,
    rasters_of,
    run_on,
    target_of,
)
from .tools import CLASSIFIED, of_tool

_REACHES = (arguments.SCHEDULER, arguments.PROGRESS)


@contextlib.contextmanager
def _contours_after(
    values: SimpleNamespace, sets: list[Any]
) -> Iterator[tuple[Any, list[Any], Progress]]:
    """Yield the rasters to make, the sets and the progress of their run, and then draw the contour
    lines, if these are wanted; without `dtm`, their terrain model is a temporary file.
    """
    from ..core.files import temporary_folder
    from ..rasters.virtual import virtual_of
    from ..survey.outputs import check_outputs
    from ..tools.contours import write_contours
    from ..tools.rasters.rows import RasterFiles

    rasters, how, progress = rasters_of(values), Contours.among(sets), progress_of(values.progress)
    rest, target = [each for each in sets if each is not how], path_of(values.contours)
    if target is None:
        yield rasters, rest, progress
        return
    check_outputs([("features", target)], paths_of(values.sources))
    with temporary_folder(target.parent) as folder:
        dtm = rasters.wanted.get("dtm", folder / "dtm.tif")
        yield RasterFiles(**{**rasters.wanted, "dtm": dtm}), rest, progress.part(0.0, 0.9)
        per_file = RasterOutput.among(sets).raster_per_file
        source = virtual_of(dtm) if per_file and virtual_of(dtm).exists() else dtm
        write_contours(source, target, how, progress.part(0.9, 1.0))


def _classify() -> Function:
    from ..runs.one_file import Summary
    from ..tools.ground.tool import TOOL

    def run(values: SimpleNamespace, sets: list[Any]) -> Any:
        from ..runs.entry import classify
        from ..runs.requests import ClassifyRequest

        with _contours_after(values, sets) as (rasters, rest, progress):
            request = ClassifyRequest.of(
                rest, rasters=rasters, area=area_of(values), corrections=corrections_of(values),
                constraints=constraints_of(values), crs=values.crs,
                raster_target=target_of(values), explain=path_of(values.explain),
            )  # fmt: skip
            workers, as_survey = run_on(values, request.resources)
            return classify(
                values.sources, values.output, request, progress, workers, path_of(values.vpc),
                as_survey,
            )  # fmt: skip

    explain = path(
        "explain",
        "of one file: write a GeoTIFF of the rule that decided each cell; its band lists the rules",
    )
    area = arguments.area(
        "classify only points in", "; points outside are written too, with the class that they"
        " have, unless `area_only` is given; rasters end at its border",
    )  # fmt: skip
    return Function(
        "classify",
        "Classify the ground points of a file, or of many files as one survey, and make products of"
        " them.",
        (arguments.SOURCES, arguments.OUTPUT),
        (
            arguments.CRS_OF_OUTPUT, *arguments.rasters(), arguments.CONTOURS, *arguments.TARGET,
            *arguments.CONSTRAINTS, *area, arguments.CORRECTIONS, explain, arguments.VPC, *_REACHES,
        ),
        TOOL.sets,
        run,
        Summary,
        is_survey_if_many=True,
        has_method=True,
    )  # fmt: skip


def _terrain() -> Function:
    from ..tools.rasters.output import RasterSize

    def run(values: SimpleNamespace, sets: list[Any]) -> Any:
        from ..runs.entry import terrain
        from ..runs.requests import TerrainRequest

        with _contours_after(values, sets) as (rasters, rest, progress):
            constraints, progress = _with_found_water(values, sets, progress)
            request = TerrainRequest.of(
                rest, rasters=rasters, area=area_of(values), constraints=constraints,
                crs=values.crs, raster_target=target_of(values),
            )  # fmt: skip
            workers, _ = run_on(values, request.resources)
            return terrain(values.sources, request, progress, workers)

    area = arguments.area(
        "make the rasters only in", "; points outside still help along its border"
    )
    return Function(
        "terrain",
        "Make rasters of the terrain and of what stands on it, and contour lines, of classified"
        " points; all files together are one survey.",
        (CLASSIFIED,),
        (
            arguments.CRS, *arguments.rasters(), arguments.CONTOURS, *arguments.TARGET, *area,
            *arguments.WITH_AUTOMATIC_WATER, *_REACHES,
        ),
        (
            GroundClasses, TerrainModel, SurfaceModel, Contours, TileInput, RasterOutput,
            Resources,
        ),
        run,
        RasterSize,
    )  # fmt: skip


def _with_found_water(
    values: SimpleNamespace, sets: list[Any], progress: Progress
) -> tuple[Any, Progress]:
    """Return the constraints with the water of the points, if that is automatic, and what is left
    of the progress.
    """
    from ..tools.water.tool import found_water

    constraints = constraints_of(values)
    if not is_automatic(values.water):
        return constraints, progress
    finding, rest = progress.part(0.0, 0.4), progress.part(0.4, 1.0)
    ground, paths = GroundClasses.among(sets), paths_of(values.sources)
    water, _ = found_water(paths, ground, values.crs, finding)
    return constraints.with_water(water.constraints, finding), rest


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
        workers, _ = run_on(values, request.resources)
        progress = progress_of(values.progress)
        return deliver(values.sources, values.output, request, progress, workers)

    kinds = " ".join(f"{name}: {each.about}" for name, each in DELIVERIES.items()).rstrip(".")
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


_DECLARED: dict[str, Callable[[], Function]] = {
    "classify": _classify,
    "deliver": _deliver,
    "terrain": _terrain,
}


@cache
def declared(name: str) -> Function:
    """Return what is declared of a function, given its name."""
    commands = tool_commands()
    return of_tool(commands[name]) if name in commands else _DECLARED[name]()


@cache
def function(name: str) -> Callable[..., Any]:
    """Return a function, given its name."""
    return declared(name).made()
