"""Classification, heights, key points and rasters of many files as one survey, without seams."""

from __future__ import annotations

import contextlib
import os
import shutil
from collections import Counter
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Iterable, Iterator, Sequence

from ..core.errors import BareEarthError, Cancelled, FinishedFilesStay
from ..core.files import check_output, is_same_file, split_name, temporary_folder
from ..core.progress import SILENT, Progress
from ..crs.measurable import require_measurable
from ..las.writing import check_writable
from ..products.raster_files import RasterFiles
from ..survey.files import Survey, open_survey
from ..survey.shapes import Place
from ..survey.vpc import check_vpc, write_vpc
from .blocks import Blocks
from .jobs import Taken
from .manifest import folders_of
from .output import Output
from .raster_jobs import make_rasters
from .rasters import MakeRasters, RasterSize
from .requests import ClassifyRequest, Request, TerrainRequest
from .steps import PointStep, located
from .tile_run import TileRun, tasks_of
from .workers import Threads, Workers

# Folder of files that a further step will read.
_WAITING = "waiting"


@dataclass(frozen=True)
class SurveySummary:
    """The result of a run on a survey.

    Attributes
    ----------
    tile_count : int
        Number of files in the survey.
    done_count : int
        Number of finished files, of this run and of earlier ones.
    kept_count : int
        How many of them an earlier run finished.
    point_count, ground_count : int
        Numbers of all points and of ground points in the finished files.
    failures : dict of str to str
        Why other files could not be done, by their paths.
    vpc : str
        The virtual point cloud of the finished files.
    tiles : tuple
        The summary of each finished file.
    jobs : tuple of Taken
        What each job took: seconds, and bytes of memory as measured and as planned.
    """

    tile_count: int
    done_count: int
    kept_count: int
    point_count: int
    ground_count: int
    failures: dict[str, str]
    vpc: str
    tiles: tuple[Any, ...] = field(default=(), repr=False)
    jobs: tuple[Taken, ...] = field(default=(), repr=False)

    @property
    def class_counts(self) -> dict[int, int]:
        """Points of each class in the finished files; empty if a step does not count them."""
        counts: Counter[int] = Counter()
        for each in self.tiles:
            counts.update(getattr(each, "class_counts", {}))
        return dict(sorted(counts.items()))

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
    """Classify the ground points of many files as one survey, and write each with its new classes.

    Parameters
    ----------
    request : ClassifyRequest
        What to do.
    blocks : Blocks, optional
        The blocks, if they are not those of the method.
    sources, folder, progress, workers, vpc
        As for `write_files`.

    Raises
    ------
    BareEarthError
        If no file can be classified, or the outputs cannot be written.
    FinishedFilesStay
        If the user asked to stop; no file is incomplete.
    """
    if request.explain is not None:
        raise BareEarthError("The raster of rules (explain) is made of one file, not of many.")
    steps: list[PointStep] = [replace(request.step, cut=blocks)]
    if request.above_ground.wanted:
        steps.append(request.above_ground_step)
    if request.output.height_above_ground:
        steps[0] = replace(
            request.step, cut=blocks, output=Output(area_only=request.output.area_only)
        )
        steps.append(replace(request.height_step, ground_only=request.output.ground_only))
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
    """Run steps on many files as one survey, and write each file with the results.

    The results are those of one file with all points. A file that cannot be processed does not stop
    the others.

    Parameters
    ----------
    sources : iterable of Path
        Files, folders, virtual point clouds and lists, as for `open_survey`.
    folder : Path
        The folder for the outputs, which get the names of the inputs. It is made if it is missing.
    steps : sequence of PointStep
        Each reads the outputs of the one before.
    request : Request
        Options for files, format, resuming, threads and memory.
    progress : Progress
        Receives progress, and a line on each finished file.
    workers : Workers, optional
        The workers; by default threads of this process.
    vpc : Path, optional
        The virtual point cloud of the results; by default in the folder.
    rasters : MakeRasters, optional
        Rasters to make from the outputs of the last step.

    Raises
    ------
    BareEarthError
        If no file can be processed, or the outputs cannot be written.
    FinishedFilesStay
        If the user asked to stop; no file is incomplete.
    """
    run = _SurveyRun(folder, steps, request, rasters, vpc)
    with _finished_files_stay():
        run.open([Path(each) for each in sources], progress)
        run.work(workers or Threads(request.resources), progress.part(0.02, 0.98))
        return run.finish(progress)


@contextlib.contextmanager
def _finished_files_stay() -> Iterator[None]:
    """Say after a cancel that the run can be continued."""
    try:
        yield
    except (Cancelled, KeyboardInterrupt) as error:
        raise FinishedFilesStay from error


class _SurveyRun:
    """A run of steps on many files; the parameters are those of `write_files`."""

    def __init__(
        self,
        folder: Path,
        steps: Sequence[PointStep],
        request: Request,
        rasters: MakeRasters | None,
        vpc: Path | None,
    ) -> None:
        self._folder, self._steps, self._request = Path(folder), list(steps), request
        self._rasters = rasters
        self._vpc = self._folder / steps[0].vpc_name if vpc is None else Path(vpc)
        # Inputs that cannot be done, and why, by their names.
        self._failures: dict[str, tuple[Path, str]] = {}
        self._empty_count, self._jobs = 0, list[Taken]()

    def open(self, sources: Sequence[Path], progress: Progress) -> None:
        """Open the inputs, and refuse now what would fail at the end."""
        for source in sources:
            if is_same_file(source, self._vpc):
                raise BareEarthError(
                    f"Input and output are the same file, {source}. Choose another output."
                )
        recursive, stated = self._request.files.recursive, self._request.stated
        survey = open_survey(sources, recursive, progress.part(0.0, 0.02), stated)
        _check_survey(survey, self._folder, self._vpc, sources if recursive else [])
        made = [] if self._rasters is None else [self._rasters]
        self._steps = located([*self._steps, *made], _place_of(survey), progress)
        self._rasters = self._steps.pop() if made else None
        self._steps[0].check_survey(survey.box)
        targets = _targets_of(survey, self._folder, self._request.tiles.format)
        if self._rasters is not None:
            self._rasters.placed(survey.crs, survey.box)
            others = self._vpc, *targets, *targets.values()
            _check_rasters(self._rasters, survey, self._folder, others)
        self._survey = survey
        self._inputs = {each.path.name: each.path for each in survey.tiles}
        self._failures = {each.path.name: (each.path, each.reason) for each in survey.broken}

    @property
    def _places(self) -> list[Path]:
        """The folder for the outputs of each step."""
        beside = folders_of(self._folder)[1]
        waiting = [beside / f"{_WAITING}-{number}" for number in range(len(self._steps) - 1)]
        return [*waiting, self._folder]

    def _targets(self, survey: Survey, place: Path) -> dict[Path, Path]:
        """Return the output of each file in a folder."""
        kind = self._request.tiles.format if place is self._folder else "same"
        return _targets_of(survey, place, kind)

    def work(self, workers: Workers, progress: Progress) -> None:
        """Run one step after the other; each reads the outputs of the one before."""
        resume, survey, places = self._request.tiles.resume, self._survey, self._places
        of_steps = [self._targets(survey, place) for place in places]
        tasks = tasks_of(survey, self._steps, of_steps, resume)
        parts = progress.shares(*[1.0] * len(self._steps))
        for number, (step, place, part) in enumerate(zip(self._steps, places, parts)):
            is_last = place is self._folder
            run = TileRun(survey, place, self._targets(survey, place), step, part, tasks[number])
            run.work(workers, resume, self._rasters if is_last else None)
            self._last = run
            self._jobs += run.taken
            for path, reason in run.failures.items():
                self._failures[path.name] = self._inputs[path.name], reason
            if not number:
                self._empty_count = run.empty_count
                if (run.done or run.empty_count) and not tasks[-1].kept:
                    step.tell_of_survey(run.done, progress)
            if is_last:
                return
            if run.done:
                made = [place / each.name for each in run.done]
                survey = open_survey(made, progress=SILENT, stated=self._request.stated)
            elif tasks[-1].kept:  # all that was left to do has failed
                tasks = [replace(each, only=frozenset()) for each in tasks]
            else:
                return

    def finish(self, progress: Progress) -> SurveySummary:
        """Report the files that are left out, and list the others in a virtual point cloud."""
        run, request = self._last, self._request
        reasons = {str(path): reason for path, reason in sorted(self._failures.values())}
        for path, reason in reasons.items():
            progress.warning(f"{path} is left out. {reason}")
        if not run.done:
            raise BareEarthError(
                f"None of the {len(reasons):,} files could be done."
                if reasons
                else "None of the files has points to write in the area."
            )
        if self._empty_count:
            progress.info(
                f"{self._empty_count:,} files are not written: they have no points to write in the"
                " area."
            )
        for place in self._places[:-1]:
            shutil.rmtree(place, ignore_errors=True)
        made, part = [self._folder / each.name for each in run.done], progress.part(0.98, 1.0)
        write_vpc(self._vpc, made, part, request.tiles.overview, request.stated)
        unknown = self._failures.keys() - self._inputs.keys()
        return SurveySummary(
            tile_count=len(self._inputs) - self._empty_count + len(unknown),
            done_count=len(run.done),
            kept_count=run.kept_count,
            point_count=sum(each.point_count for each in run.done),
            ground_count=sum(getattr(each, "ground_count", 0) for each in run.done),
            failures=reasons,
            vpc=str(self._vpc),
            tiles=tuple(run.done),
            jobs=tuple(self._jobs),
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
        The workers; by default threads of this process.

    Raises
    ------
    BareEarthError
        If there is no ground, or a raster cannot be written.
    Cancelled
        If the user asked to stop; no output is left behind.
    """
    recursive = request.files.recursive
    survey = open_survey(sources, recursive, progress.part(0.0, 0.05), request.stated)
    require_measurable("The survey", survey.crs, survey.box)
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
        (step,) = located([request.raster_step], _place_of(survey), progress)
        return make_rasters(survey, folder, step, workers, part)


def _place_of(survey: Survey) -> Place:
    return Place("the files", survey.crs, survey.box)


def _check_survey(survey: Survey, folder: Path, vpc: Path, searched: Sequence[Path]) -> None:
    """Refuse, before any work, a survey and outputs that would fail or overwrite something."""
    require_measurable("The survey", survey.crs, survey.box)
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
    check_vpc(vpc)
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
