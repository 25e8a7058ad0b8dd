"""What is made of many files as one survey, without a seam: classified ones, heights, rasters."""

from __future__ import annotations

import os
import shutil
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Iterable, Sequence

from ..core.errors import BareEarthError
from ..core.files import check_output, is_same_file, split_name, temporary_folder
from ..core.progress import SILENT, Progress
from ..las.writing import check_writable
from ..survey.files import Survey, open_survey
from ..survey.vpc import SUFFIX as VPC_SUFFIX
from ..survey.vpc import write_vpc
from .blocks import Blocks
from .output import Output
from .raster_files import RasterFiles
from .raster_jobs import make_rasters
from .rasters import MakeRasters, RasterSize
from .record import folders_of
from .requests import ClassifyRequest, Request, TerrainRequest
from .steps import PointStep
from .tile_run import TileRun, tasks_of
from .workers import Threads, Workers

# Where the files wait of which more is to be made.
_WAITING = "waiting"


@dataclass(frozen=True)
class SurveySummary:
    """What became of a survey.

    Attributes
    ----------
    tile_count : int
        Files of the survey.
    done_count : int
        Those that are done, in this run or before it.
    kept_count : int
        Those that a run before had done.
    point_count, ground_count : int
        Points of the files that are done, and those of them that are ground.
    failures : dict of str to str
        Why the others are not done, by their paths.
    vpc : str
        The virtual point cloud of all that are.
    tiles : tuple
        What became of each file that is done, as the step says it.
    """

    tile_count: int
    done_count: int
    kept_count: int
    point_count: int
    ground_count: int
    failures: dict[str, str]
    vpc: str
    tiles: tuple[Any, ...] = field(default=(), repr=False)

    @property
    def text(self) -> str:
        """The counts in words."""
        kept = f" ({self.kept_count:,} of them in an earlier run)" if self.kept_count else ""
        text = f"{self.done_count:,} of {self.tile_count:,} files are done{kept}"
        if not self.ground_count:
            return f"{text}: {self.point_count:,} points"
        share = self.ground_count / max(self.point_count, 1)
        return (
            f"{text}: {self.ground_count:,} of {self.point_count:,} points are ground ({share:.1%})"
        )


def classify_files(
    sources: Iterable[Path],
    folder: Path,
    request: ClassifyRequest = ClassifyRequest(),
    progress: Progress = SILENT,
    workers: Workers | None = None,
    vpc: Path | None = None,
    blocks: Blocks | None = None,
) -> SurveySummary:
    """Classify the ground points of many files as one survey, and write each anew.

    Parameters
    ----------
    request : ClassifyRequest
        What to do.
    blocks : Blocks, optional
        How the survey is cut, if not as the method has it.
    sources, folder, progress, workers, vpc
        As for `write_files`.

    Raises
    ------
    BareEarthError
        If no file can be classified, or the outputs cannot be written.
    Cancelled
        If the user asked to stop; finished files stay, and nothing is half written.
    """
    steps: list[PointStep] = [replace(request.step, cut=blocks)]
    if request.output.height_above_ground:
        heights = replace(request.height_step, ground_only=request.output.ground_only)
        steps = [replace(steps[0], output=Output(area_only=request.output.area_only)), heights]
    rasters = request.raster_step if request.rasters.wanted else None
    if request.output.ground_only and rasters is not None and not rasters.covers_ground:
        raise BareEarthError(
            "The surface model, the canopy height and the confidence need all points. Write all"
            " points, not only the ground."
        )
    return write_files(sources, folder, steps, request, progress, workers, vpc, rasters)


def write_files(
    sources: Iterable[Path],
    folder: Path,
    steps: Sequence[PointStep],
    request: Request = Request(),
    progress: Progress = SILENT,
    workers: Workers | None = None,
    vpc: Path | None = None,
    rasters: MakeRasters | None = None,
) -> SurveySummary:
    """Write many files anew, as one survey, with what steps find of their points.

    The results are those that one file with all the points would get. A file that cannot be worked
    on does not stop the others.

    Parameters
    ----------
    sources : iterable of Path
        Files, folders, virtual point clouds and lists, as for `open_survey`.
    folder : Path
        Where the outputs go, under the names of the inputs; made if it is not there.
    steps : sequence of PointStep
        What to find, each in the files that the one before wrote.
    request : Request
        Which files, in what format, whether files that are done stay, threads and memory.
    progress : Progress
        Receives progress, and a line on each finished file.
    workers : Workers, optional
        Who does the work; threads of this process if not given.
    vpc : Path, optional
        The virtual point cloud of the results; in the folder if not given.
    rasters : MakeRasters, optional
        Rasters to make of what the last step wrote.

    Raises
    ------
    BareEarthError
        If no file can be done, or the outputs cannot be written.
    Cancelled
        If the user asked to stop; finished files stay, and nothing is half written.
    """
    folder, sources = Path(folder), [Path(each) for each in sources]
    workers = workers or Threads(request.resources)
    vpc = folder / steps[0].vpc_name if vpc is None else Path(vpc)
    for source in sources:
        if is_same_file(source, vpc):
            raise BareEarthError(
                f"Input and output are the same file, {source}. Choose another output."
            )
    recursive = request.files.recursive
    survey = open_survey(sources, recursive, progress.part(0.0, 0.02))
    _check_survey(survey, folder, vpc, sources if recursive else [])
    steps[0].check_survey(survey.box)
    targets = _targets_of(survey, folder, request.tiles.format)
    if rasters is not None:
        _check_rasters(rasters, survey, folder, (vpc, *targets, *targets.values()))
    failures = {each.path.name: (each.path, each.reason) for each in survey.broken}
    inputs = {each.path.name: each.path for each in survey.tiles}
    waiting = [folders_of(folder)[1] / f"{_WAITING}-{each}" for each in range(len(steps) - 1)]
    parts = progress.part(0.02, 0.98).shares(*[1.0] * len(steps))
    places = [*waiting, folder]
    formats = [*["same"] * len(waiting), request.tiles.format]
    of_steps = [_targets_of(survey, *each) for each in zip(places, formats)]
    tasks = tasks_of(survey, steps, of_steps, request.tiles.resume)
    for number, (step, place, task, part) in enumerate(zip(steps, places, tasks, parts)):
        is_last = place is folder
        targets = _targets_of(survey, place, formats[number])
        run = TileRun(survey, place, targets, step, part, task)
        run.work(workers, request.tiles.resume, rasters if is_last else None)
        for path, reason in run.failures.items():
            failures[path.name] = inputs[path.name], reason
        if not number:
            empty_count = run.empty_count
            if (run.done or empty_count) and not tasks[-1].kept:
                step.tell_of_survey(run.done, progress)
        if not is_last and run.done:
            done = [place / each.name for each in run.done]
            survey = open_survey(done, progress=SILENT)
        elif not run.done and not tasks[-1].kept:
            break
    reasons = {str(path): reason for path, reason in sorted(failures.values())}
    for path, reason in reasons.items():
        progress.warning(f"{path} is left out. {reason}")
    if not run.done:
        raise BareEarthError(
            f"None of the {len(reasons):,} files could be done."
            if reasons
            else "None of the files has points to write in the area."
        )
    if empty_count:
        progress.info(
            f"{empty_count:,} files are not written: they have no points to write in the area."
        )
    for each in waiting:
        shutil.rmtree(each, ignore_errors=True)
    write_vpc(vpc, [folder / each.name for each in run.done], progress.part(0.98, 1.0))
    return SurveySummary(
        tile_count=len(inputs) - empty_count + len(failures.keys() - inputs.keys()),
        done_count=len(run.done),
        kept_count=run.kept_count,
        point_count=sum(each.point_count for each in run.done),
        ground_count=sum(getattr(each, "ground_count", 0) for each in run.done),
        failures=reasons,
        vpc=str(vpc),
        tiles=tuple(run.done),
    )


def rasters_of_files(
    sources: Iterable[Path],
    request: TerrainRequest,
    progress: Progress = SILENT,
    workers: Workers | None = None,
) -> RasterSize:
    """Write rasters of many classified files as one survey; all of them or none.

    Parameters
    ----------
    sources : iterable of Path
        Files, folders, virtual point clouds and lists, as for `open_survey`.
    request : TerrainRequest
        What to make.
    progress : Progress
        Receives progress and messages.
    workers : Workers, optional
        Who does the work; threads of this process if not given.

    Raises
    ------
    BareEarthError
        If there is no ground, or a raster cannot be written.
    Cancelled
        If the user asked to stop; no output is left behind.
    """
    recursive = request.files.recursive
    survey = open_survey(sources, recursive, progress.part(0.0, 0.05))
    per_file = request.raster_output.raster_per_file
    request.rasters.check(tuple(each.path for each in survey.tiles), per_file)
    if per_file:
        _check_stems(survey)
    for each in survey.broken:
        progress.warning(f"{each.path} is left out. {each.reason}")
    beside = next(iter(request.rasters.wanted.values())).parent
    workers = workers or Threads(request.resources)
    with temporary_folder(beside) as folder:
        part = progress.part(0.05, 1.0)
        return make_rasters(survey, folder, request.raster_step, workers, part)


def _check_survey(survey: Survey, folder: Path, vpc: Path, searched: Sequence[Path]) -> None:
    """Refuse what could not be done or would do harm, before any work."""
    if survey.crs.is_geographic:
        raise BareEarthError(
            f"The files are not in a projected CRS ({survey.crs.name}), so that nothing can be"
            " measured in them. Reproject them first."
        )
    if folder.exists() and not folder.is_dir():
        raise BareEarthError(f"Cannot write into {folder}: it is a file. Give a folder.")
    if not folder.exists():
        check_output(folder)
    here = folder.resolve()
    for path in [each.path for each in (*survey.tiles, *survey.broken)]:
        if path.parent.resolve() == here:
            raise BareEarthError(
                f"Input and output are in the same folder, {folder}. Choose another output."
            )
    for each in filter(Path.is_dir, searched):
        if each.resolve() in here.parents:
            raise BareEarthError(
                f"The output {folder} is in the folder {each}, which is searched for inputs with"
                " all its subfolders. Choose another output."
            )
    if vpc.suffix.lower() != VPC_SUFFIX:
        raise BareEarthError(f"Cannot write {vpc}: name it {VPC_SUFFIX}.")
    if vpc.parent.resolve() != here:
        check_output(vpc)


def _check_rasters(
    step: MakeRasters, survey: Survey, folder: Path, others: tuple[Path, ...]
) -> None:
    """Refuse rasters that could not be written; the folder of the output may not be there yet."""
    rasters = step.files
    if not folder.exists():
        paths = rasters.wanted.items()
        rasters = RasterFiles(**{name: path for name, path in paths if path.parent != folder})
    rasters.check(others, step.per_file)
    if step.per_file:
        _check_stems(survey)


def _check_stems(survey: Survey) -> None:
    """Refuse files whose rasters would get the same name."""
    stems: dict[str, Path] = {}
    for tile in survey.tiles:
        stem = split_name(tile.path)[0]
        other = stems.setdefault(os.path.normcase(stem).lower(), tile.path)
        if other is not tile.path:
            raise BareEarthError(
                f"The rasters of {other} and of {tile.path} would both become {stem}.tif. Rename"
                " one of the files, or make one raster of all."
            )


def _targets_of(survey: Survey, folder: Path, format: str = "same") -> dict[Path, Path]:
    """Return the output of each input; refuse those that would get the same name."""
    targets, inputs = {}, {}
    for tile in (*survey.tiles, *survey.broken):
        name = tile.path.name
        if format != "same":
            name = f"{split_name(tile.path)[0]}.{format}"
        other = inputs.setdefault(os.path.normcase(name).lower(), tile.path)
        if other is not tile.path:
            raise BareEarthError(
                f"{other} and {tile.path} would both become {folder / name}. Rename one of them, or"
                " write them into different folders."
            )
        targets[tile.path] = folder / name
        check_writable(targets[tile.path])
    return targets
