"""Classification, heights, key points and rasters of many files as one survey, without seams."""

from __future__ import annotations

import contextlib
from collections import Counter
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Iterable, Iterator, Sequence

from ..core.errors import BareEarthError, Cancelled, FinishedFilesStay
from ..core.files import (
    is_same_file,
    make_work_folder,
    temporary_folder,
    write_errors_told,
)
from ..core.locks import alone_in
from ..core.progress import SILENT, Progress
from ..core.temporary import remove, remove_leftovers
from ..crs.measurable import require_measurable
from ..engine.blocks import Blocks
from ..engine.job_queue import JobQueue
from ..engine.jobs import JobCost
from ..engine.manifest import folders_of, remove_record
from ..engine.options import RunOptions
from ..engine.plan import Plan
from ..engine.sinks import run_sink
from ..engine.step import PointStep, located
from ..engine.unpacking import Unpacking
from ..engine.workers import Threads, Workers
from ..las.unpacked import has_room
from ..survey.files import Survey, open_survey
from ..survey.outputs import check_outputs
from ..survey.shapes import Place
from ..survey.vpc import write_vpc
from ..tools.rasters.output import RasterSize
from ..tools.rasters.step import MakeRasters
from .requests import ClassifyRequest, TerrainRequest
from .survey_checks import check_rasters, check_stems, check_survey, targets_of


@dataclass(frozen=True)
class SurveySummary:
    """The result of a run on a survey."""

    tile_count: int  # files in the survey
    done_count: int  # finished files, of this run and of earlier ones
    kept_count: int  # those that an earlier run finished
    point_count: int  # in the finished files
    ground_count: int  # as point_count
    failures: dict[str, str]  # why other files could not be done, by their paths
    vpc: str  # the virtual point cloud of the finished files
    tiles: tuple[Any, ...] = field(default=(), repr=False)  # their summaries
    jobs: tuple[JobCost, ...] = field(default=(), repr=False)

    @property
    def class_counts(self) -> dict[int, int]:
        """Points of each class in the finished files; empty if a step does not count them."""
        counts: Counter[int] = Counter()
        for tile in self.tiles:
            counts.update(getattr(tile, "class_counts", {}))
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
    """Classify the ground points of many files as one survey, in blocks of the method if none are
    given, and write each with its new classes, as `write_files`.
    """
    if request.explain is not None:
        raise BareEarthError("The raster of rules (explain) is made of one file, not of many.")
    first, *others = request.steps
    steps: list[PointStep] = [replace(first, cut=blocks), *others]
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
    request: RunOptions = RunOptions(),
    progress: Progress = SILENT,
    workers: Workers | None = None,
    vpc: Path | None = None,
    rasters: MakeRasters | None = None,
) -> SurveySummary:
    """Run steps on many files as one survey, each step on what those before it found, and write the
    files with the results into a folder, with the names of the inputs.
    """
    # The results are those of one file with all points. A file that cannot be processed does not
    # stop the others, but an error says if none can be processed, and `FinishedFilesStay` if the
    # user asked to stop. Sources are as for `open_survey`, the workers by default threads of this
    # process, and the virtual point cloud by default in the folder.
    run = _SurveyRun(folder, steps, request, rasters, vpc)
    with _finished_files_stay():
        run.open([*map(Path, sources)], progress)
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
        request: RunOptions,
        rasters: MakeRasters | None,
        vpc: Path | None,
    ) -> None:
        self._folder, self._steps, self._request = Path(folder), list(steps), request
        self._rasters = rasters
        self._vpc = self._folder / steps[0].vpc_name if vpc is None else Path(vpc)
        # Inputs that cannot be done, and why, by their names.
        self._failures: dict[str, tuple[Path, str]] = {}
        # Summaries of the finished files, sorted by their names.
        self._done: list[Any] = []
        self._kept_count = self._empty_count = 0
        self._jobs: list[JobCost] = []

    def open(self, sources: Sequence[Path], progress: Progress) -> None:
        """Open the inputs, and refuse now what would fail at the end."""
        for source in sources:
            if is_same_file(source, self._vpc):
                raise BareEarthError(
                    f"Input and output are the same file, {source}. Choose another output."
                )
        recursive, stated = self._request.files.recursive, self._request.stated
        survey = open_survey(sources, recursive, progress.part(0.0, 0.02), stated)
        check_survey(survey, self._folder, self._vpc, sources if recursive else [])
        rasters = [] if self._rasters is None else [self._rasters]
        self._steps = located([*self._steps, *rasters], _place_of(survey), progress)
        self._rasters = self._steps.pop() if rasters else None
        self._steps[0].check_survey(survey.box)
        self._targets = targets_of(survey, self._folder, self._request.tiles.format)
        if self._rasters is not None:
            self._rasters.placed(survey.crs, survey.box)
            others = self._vpc, *self._targets, *self._targets.values()
            check_rasters(self._rasters, survey, self._folder, others)
        self._survey = survey
        self._inputs = {tile.path.name: tile.path for tile in survey.tiles}
        self._failures = {tile.path.name: (tile.path, tile.reason) for tile in survey.broken}

    def work(self, workers: Workers, progress: Progress) -> None:
        """Do what is to be done, in a folder of which no other run makes use meanwhile."""
        resume, (_, records, waiting) = self._request.tiles.resume, folders_of(self._folder)
        plan = Plan(self._survey, self._targets, self._steps, waiting, progress.part(0.0, 0.02))
        with write_errors_told(self._folder):
            self._folder.mkdir(parents=True, exist_ok=True)
            make_work_folder(records)
        with alone_in(records):
            self._clear(results=not resume)
            with write_errors_told(self._folder):
                make_work_folder(waiting)
            plan.keep_finished(resume, progress)
            self._run(plan, waiting, workers, progress.part(0.02, 1.0))
            self._clear(results=True)

    def _run(self, plan: Plan, waiting: Path, workers: Workers, progress: Progress) -> None:
        """Run the jobs of a plan, and make the rasters."""
        kept = plan.files_kept() if self._rasters is not None else []
        unpacking = _unpacking(waiting, self._survey, workers, is_whole=True)
        blocks, tiles = plan.jobs(workers, self._folder, unpacking)
        end = 0.8 if self._rasters else 1.0
        queue = JobQueue(blocks, tiles, workers, progress.part(0.0, end), kept)
        queue.work()
        self._done, self._kept_count = sorted([*plan.kept, *queue.done]), len(plan.kept)
        self._empty_count = plan.empty_count + queue.empty_count
        self._jobs = queue.costs
        for path, reason in {**plan.failures, **queue.failures}.items():
            self._failures[path.name] = path, reason
        if self._done or self._empty_count:
            self._tell(queue.done, progress)
        if self._done and self._rasters is not None:
            paths = [self._folder / summary.name for summary in self._done]
            classified = open_survey(paths, progress=progress.quiet(), stated=self._survey.stated)
            results, part = plan.results(classified), progress.part(end, 1.0)
            run_sink(classified, waiting, self._rasters, workers, part, results, unpacking)

    def _tell(self, done: Sequence[Any], progress: Progress) -> None:
        """Report on all files; remove the outputs of this run if they are refused together."""
        try:
            self._steps[0].tell_of_survey(self._done, progress)
        except BareEarthError:
            for summary in done:
                remove(self._folder / summary.name)
                remove_record(self._folder / summary.name)
            raise

    def _clear(self, results: bool) -> None:
        """Remove what killed runs left, and the results of blocks if `results`."""
        folders = folders_of(self._folder)
        if results:
            remove(folders[2])
        for folder in folders:
            remove_leftovers(folder)

    def finish(self, progress: Progress) -> SurveySummary:
        """Report the files that are left out, and list the others in a virtual point cloud."""
        request = self._request
        reasons = {str(path): reason for path, reason in sorted(self._failures.values())}
        for path, reason in reasons.items():
            progress.warning(f"{path} is left out. {reason}")
        if not self._done:
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
        paths = [self._folder / summary.name for summary in self._done]
        part = progress.part(0.98, 1.0)
        write_vpc(self._vpc, paths, part, request.tiles.overview, request.stated)
        unknown = self._failures.keys() - self._inputs.keys()
        return SurveySummary(
            tile_count=len(self._inputs) - self._empty_count + len(unknown),
            done_count=len(self._done),
            kept_count=self._kept_count,
            point_count=sum(summary.point_count for summary in self._done),
            ground_count=sum(getattr(summary, "ground_count", 0) for summary in self._done),
            failures=reasons,
            vpc=str(self._vpc),
            tiles=tuple(self._done),
            jobs=tuple(self._jobs),
        )


def rasters_of_files(
    sources: Iterable[Path],
    request: TerrainRequest,
    progress: Progress = SILENT,
    workers: Workers | None = None,
) -> RasterSize:
    """Write rasters of many classified files, given as for `open_survey`, as one survey, in threads
    by default; all of them or none.
    """
    recursive = request.files.recursive
    survey = open_survey(sources, recursive, progress.part(0.0, 0.05), request.stated)
    require_measurable("The survey", survey.crs, survey.box)
    per_file = request.raster_output.raster_per_file
    check_outputs(request.rasters.outputs(per_file), [tile.path for tile in survey.tiles])
    if per_file:
        check_stems(survey)
    for tile in survey.broken:
        progress.warning(f"{tile.path} is left out. {tile.reason}")
    beside = next(iter(request.rasters.wanted.values())).parent
    workers = workers or Threads(request.resources)
    with temporary_folder(beside) as folder:
        part = progress.part(0.05, 1.0)
        (step,) = located([request.raster_step], _place_of(survey), progress)
        unpacking = _unpacking(folder, survey, workers, is_whole=False)
        return run_sink(survey, folder, step, workers, part, unpacking=unpacking)


def _unpacking(folder: Path, survey: Survey, workers: Workers, is_whole: bool) -> Unpacking | None:
    """Return where files wait uncompressed: on this computer, if there is room."""
    fits = workers.are_local and has_room(folder, survey.count)
    return Unpacking(folder, is_whole) if fits else None


def _place_of(survey: Survey) -> Place:
    return Place("the files", survey.crs, survey.box)
