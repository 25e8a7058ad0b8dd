"""The functions of the library: what is declared of each, imported when it is asked for."""

from __future__ import annotations

import contextlib
from functools import cache
from pathlib import Path
from types import SimpleNamespace
from typing import Any, Callable, Iterator

from ..core.progress import Progress
from ..engine.memory import Resources
from ..runs.options import RasterOutput, TileInput, TileOutput
from ..survey.ground_classes import GroundClasses
from ..survey.selection import Selection
from ..tools.contours import Contours
from ..tools.rasters.parameters import SurfaceModel, TerrainModel
from . import arguments, tool_commands
from .arguments import KINDS, REQUIRED, Argument, path
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
    from ..tools.above_ground.classes import ThenAboveGround
    from ..tools.ground.output import Output

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
        (
            Selection, ThenAboveGround, TerrainModel, SurfaceModel, Contours, Output, TileInput,
            TileOutput, RasterOutput, Resources,
        ),
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


def _check() -> Function:
    from ..survey.feature_files import FORMATS
    from ..tools.check.accuracy import Accuracy
    from ..tools.check.checking import CheckOptions
    from ..tools.check.results import Check

    def run(values: SimpleNamespace, sets: list[Any]) -> Any:
        from ..tools import running
        from ..tools.check.checking import TOOL

        inputs = {
            "sources": paths_of(values.sources), "checkpoints": checkpoints_of(values),
            "dtm": values.dtm, "crs": values.crs, "vegetated": tuple(values.vegetated or ()),
            "confidence": values.confidence,
        }  # fmt: skip
        outputs = {output.name: path_of(getattr(values, output.name)) for output in TOOL.outputs}
        return running.run(TOOL, inputs, outputs, sets, progress_of(values.progress))

    return Function(
        "check",
        "Compare the ground, and a terrain model, with checkpoints, or with points that are held"
        " out.",
        (CLASSIFIED,),
        (
            *arguments.CHECKPOINTS,
            Argument(
                "vegetated", KINDS["words"],
                "land covers with one of these words are vegetated, and no others; without it,"
                " those with words such as forest, crops and brush in several languages",
            ),
            path("dtm", "check this terrain model as well, in the CRS of the points"),
            path(
                "confidence", "the confidence of the terrain model, 0 to 1, as `terrain` makes it;"
                " checkpoints where it is low are not counted",
            ),
            path("report", "write a page (.html)"),
            path("table", "write the checkpoints and their errors (.csv)"),
            path(
                "residuals",
                f"write the checkpoints and their errors as points ({', '.join(FORMATS)}); all but"
                " .geojson need pyogrio",
            ),
            arguments.CRS, arguments.PROGRESS,
        ),
        (Accuracy, CheckOptions, GroundClasses),
        run,
        Check,
    )  # fmt: skip


def _quality() -> Function:
    from ..tools.quality import QualityOptions
    from ..tools.quality.figures import Quality

    def run(values: SimpleNamespace, sets: list[Any]) -> Any:
        from ..tools.quality import QualityRequest, survey_quality

        request = QualityRequest.of(
            sets, page=path_of(values.page), folder=path_of(values.folder), crs=values.crs
        )
        return survey_quality(paths_of(values.sources), request, progress_of(values.progress))

    return Function(
        "quality",
        "Measure density, voids and overlap of a classified survey, and compare it with a"
        " specification.",
        (CLASSIFIED,),
        (
            path("page", "write a page (.html)"),
            path(
                "folder",
                "write rasters (.tif) into this folder, which is made if need be: densities, voids,"
                " low vegetation, overlap of strips, differences between strips, maximum surface"
                " height",
            ),
            arguments.CRS, arguments.PROGRESS,
        ),
        (QualityOptions, GroundClasses),
        run,
        Quality,
    )  # fmt: skip


def _assess() -> Function:
    from ..tools.assess import Assessment, AssessmentOptions

    def run(values: SimpleNamespace, sets: list[Any]) -> Any:
        from ..tools.assess import assess_files

        return assess_files(
            Path(values.classified), Path(values.reference), sets[0], path_of(values.report),
            path_of(values.error_map), progress_of(values.progress), values.crs,
        )  # fmt: skip

    return Function(
        "assess",
        "Compare the ground of a classified file with a reference that holds the same points, or a"
        " part of them.",
        (
            path("classified", "the file to check", REQUIRED),
            path("reference", "a file with the same points and their true classes", REQUIRED),
        ),
        (
            path("report", "write a report (.html)"),
            path("error_map", "write the share of wrong points in each cell, 0 to 1 (.tif)"),
            arguments.CRS, arguments.PROGRESS,
        ),
        (AssessmentOptions,),
        run,
        Assessment,
    )  # fmt: skip


def _compare_settings() -> Function:
    from ..tools.compare_settings import TrialSummary
    from ..tools.compare_settings.settings import TrialOptions

    def run(values: SimpleNamespace, sets: list[Any]) -> Any:
        from ..tools.compare_settings import compare_settings

        return compare_settings(
            paths_of(values.sources), Path(values.page), values.extent, sets[0], sets[1],
            progress_of(values.progress), values.crs,
        )  # fmt: skip

    window = "xmin, ymin, xmax, ymax: the window, in the CRS of the points; without it, 250 x 250"
    return Function(
        "compare_settings",
        "Try methods and presets on a window, and show them side by side on a page. No point cloud"
        " is written.",
        (arguments.SOURCES, path("page", "the page to write (.html)", REQUIRED)),
        (
            Argument("extent", KINDS["extent"], f"{window} m in the middle of the points"),
            arguments.CRS, arguments.PROGRESS,
        ),
        (TrialOptions, Resources),
        run,
        TrialSummary,
    )  # fmt: skip


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
    "assess": _assess,
    "check": _check,
    "classify": _classify,
    "compare_settings": _compare_settings,
    "deliver": _deliver,
    "quality": _quality,
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
