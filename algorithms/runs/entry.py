"""The entry to all runs, for the library, the command line and the dialogs.

Here it is decided whether a run works on one file, or on many files as one survey.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Callable, Mapping, Sequence, TypeVar

from ..core.errors import BareEarthError
from ..core.files import temporary_folder
from ..core.progress import SILENT, Progress
from ..rasters.virtual import virtual_of
from ..survey.files import Inputs, Sources
from ..survey.outputs import check_outputs
from ..tools.contours import Interval, write_contours
from ..tools.rasters.output import RasterSize
from ..tools.rasters.rows import RasterFiles
from .one_file import classify_file, rasters_of_file, write_points
from .requests import ClassifyRequest, PointRequest, RasterRequest, TerrainRequest

if TYPE_CHECKING:
    from ..engine.workers import Workers

_Request = TypeVar("_Request", bound=RasterRequest)


def classify(
    sources: Sources,
    output: str | Path,
    request: ClassifyRequest = ClassifyRequest(),
    progress: Progress = SILENT,
    workers: Workers | None = None,
    vpc: Path | None = None,
) -> Any:
    """Classify the ground points of a file, or of many files as one survey."""
    inputs, target = Inputs(sources), Path(output)

    def run(request: ClassifyRequest, progress: Progress) -> Any:
        if not inputs.is_survey:
            return classify_file(inputs[0], target, request, progress)
        from .many_files import classify_files

        return classify_files(inputs, target, request, progress, workers, vpc)

    return with_contours(run, inputs, request, progress)[0]


def terrain(
    sources: Sources,
    request: TerrainRequest,
    progress: Progress = SILENT,
    workers: Workers | None = None,
) -> RasterSize:
    """Write rasters of the terrain and of the objects on it; all of them or none."""
    inputs = Inputs(sources)
    if not request.rasters.wanted and request.contour_lines is None:
        raise BareEarthError("Choose at least one raster to make.")
    if not request.ground.ground_classes:
        raise BareEarthError("Choose at least one ground class.")
    check_outputs(request.rasters.outputs(), inputs)

    def run(request: TerrainRequest, progress: Progress) -> RasterSize:
        if not inputs.is_survey:
            return rasters_of_file(inputs.file, request, progress)
        from .many_files import rasters_of_files

        return rasters_of_files(inputs, request, progress, workers)

    return with_contours(run, inputs, request, progress)[0]


def make(
    sources: Sources,
    outputs: Mapping[str, Path | None],
    request: ClassifyRequest | TerrainRequest,
    progress: Progress = SILENT,
    workers: Workers | None = None,
) -> Any:
    """Write what a request of `map_request` asks for, given its outputs."""
    if isinstance(request, TerrainRequest):
        return terrain(sources, request, progress, workers)
    cloud, vpc = outputs["output"] or Path(), outputs.get("vpc")
    return classify(sources, cloud, request, progress, workers, vpc)


def with_contours(
    run: Callable[[_Request, Progress], Any],
    sources: Sequence[Path],
    request: _Request,
    progress: Progress,
) -> tuple[Any, Interval | None]:
    """Make the rasters, and then the contour lines that the request asks for; return what the run
    returns, and the interval of the lines.
    """
    target = request.contour_lines
    if target is None:
        return run(request, progress), None
    check_outputs([("features", target)], sources)
    with temporary_folder(target.parent) as folder:
        # If nobody asks for the terrain model, it is a temporary file.
        dtm = request.rasters.wanted.get("dtm", folder / "dtm.tif")
        rasters = RasterFiles(**{**request.rasters.wanted, "dtm": dtm})
        whole = replace(request, rasters=rasters, contour_lines=None)
        done = run(whole, progress.part(0.0, 0.9))
        per_file = request.raster_output.raster_per_file
        source = virtual_of(dtm) if per_file and virtual_of(dtm).exists() else dtm
        interval = write_contours(source, target, request.contours, progress.part(0.9, 1.0))
    return done, interval


def write(
    sources: Sources,
    output: str | Path,
    request: PointRequest,
    progress: Progress = SILENT,
    workers: Workers | None = None,
    as_survey: bool | None = None,
    vpc: Path | None = None,
) -> Any:
    """Write classified files with what the step of a request finds; for `vpc`, see `classify`."""
    inputs, target = Inputs(sources, as_survey), Path(output)
    if not inputs.is_survey:
        return write_points(inputs.file, target, request, progress)
    from .many_files import write_files

    return write_files(inputs, target, [request.step], request, progress, workers, vpc)
