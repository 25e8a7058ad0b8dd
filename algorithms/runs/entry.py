"""The entry to all runs, for the library, the command line and the dialogs.

Here it is decided whether a run works on one file, or on many files as one survey.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, Iterable, Union

from ..core.errors import BareEarthError
from ..core.progress import SILENT, Progress
from ..survey.files import is_one_file
from ..survey.outputs import check_outputs
from ..tools.rasters.output import RasterSize
from .one_file import classify_file, rasters_of_file, write_points
from .requests import ClassifyRequest, PointRequest, TerrainRequest

if TYPE_CHECKING:
    from ..engine.workers import Workers

Sources = Union[str, Path, Iterable[Union[str, Path]]]


def classify(
    sources: Sources,
    output: str | Path,
    request: ClassifyRequest = ClassifyRequest(),
    progress: Progress = SILENT,
    workers: Workers | None = None,
    vpc: Path | None = None,
    as_survey: bool | None = None,
) -> Any:
    """Classify the ground points of a file, or of many files as one survey."""
    paths, target = _paths(sources), Path(output)
    if _is_one(paths, as_survey):
        return classify_file(paths[0], target, request, progress)
    from .many_files import classify_files

    return classify_files(paths, target, request, progress, workers, vpc)


def terrain(
    sources: Sources,
    request: TerrainRequest,
    progress: Progress = SILENT,
    workers: Workers | None = None,
) -> RasterSize:
    """Write rasters of the terrain and of the objects on it; all of them or none."""
    paths = _paths(sources)
    if not request.rasters.wanted:
        raise BareEarthError("Choose at least one raster to make.")
    if not request.ground.ground_classes:
        raise BareEarthError("Choose at least one ground class.")
    check_outputs(request.rasters.outputs(), paths)
    if _is_one(paths):
        return rasters_of_file(paths[0], request, progress)
    from .many_files import rasters_of_files

    return rasters_of_files(paths, request, progress, workers)


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
    paths, target = _paths(sources), Path(output)
    if _is_one(paths, as_survey):
        return write_points(paths[0], target, request, progress)
    from .many_files import write_files

    return write_files(paths, target, [request.step], request, progress, workers, vpc)


def _is_one(paths: list[Path], as_survey: bool | None = None) -> bool:
    """Return whether a run works on one file."""
    return is_one_file(paths) if as_survey is None else not as_survey


def _paths(sources: Sources) -> list[Path]:
    if isinstance(sources, (str, Path)):
        return [Path(sources)]
    return [*map(Path, sources)]
