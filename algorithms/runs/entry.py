"""The entry to all runs, for the library, the command line and the dialogs.

Here it is decided whether a run works on one file, or on many files as one survey.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, Iterable, Union

from ..core.errors import BareEarthError
from ..core.progress import SILENT, Progress
from ..survey.files import is_one_file
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
    """Classify the ground points of a file, or of many files as one survey.

    Parameters
    ----------
    sources : path or iterable of paths
        LAS, LAZ and COPC files, folders of them, virtual point clouds (.vpc) and lists (.txt).
    output : path
        For one file, the file to write (.las, .laz or .copc.laz). Otherwise a folder, which is made
        if it is missing.
    request : ClassifyRequest
        What to do.
    progress : Progress
        Receives progress and messages.
    workers : Workers, optional
        The workers for many files; by default threads of this process.
    vpc : path, optional
        For many files, the virtual point cloud of the results; by default in the folder.
    as_survey : bool, optional
        Whether the inputs are a survey, whose outputs are in a folder, or one file. By default, one
        file is not a survey, and all else is.

    Returns
    -------
    Summary or SurveySummary
        What was done, of one file or of many.

    Raises
    ------
    BareEarthError
        If an input cannot be read or an output cannot be written.
    Cancelled
        If the user asked to stop; no output is incomplete. It is `FinishedFilesStay` if some of
        many files can be finished already.

    Examples
    --------
    >>> from bare_earth.algorithms import ClassifyRequest, TinDensification, classify
    >>> request = ClassifyRequest(parameters=TinDensification(preset="hilly"))
    >>> summary = classify("tile.laz", "classified.laz", request)  # doctest: +SKIP
    """
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
    """Write rasters of the terrain and of the objects on it; all of them or none.

    Parameters
    ----------
    request : TerrainRequest
        Which rasters, where they go, and how they are made.
    sources, progress, workers
        As for `classify`; all files together are one survey.

    Returns
    -------
    RasterSize
        The size of the rasters, and the number of points that they were made from.

    Raises
    ------
    BareEarthError
        If no raster is wanted, the input has no ground or cannot be read, or a raster cannot be
        written.
    Cancelled
        If the user asked to stop; no output is left behind.
    """
    paths = _paths(sources)
    if not request.rasters.wanted:
        raise BareEarthError("Choose at least one raster to make.")
    if not request.ground.ground_classes:
        raise BareEarthError("Choose at least one ground class.")
    request.rasters.check(tuple(paths))
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
    return [Path(each) for each in sources]
