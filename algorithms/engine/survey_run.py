"""Steps on many files as one survey, without seams."""

from __future__ import annotations

import contextlib
from pathlib import Path
from typing import Any, Iterator, Mapping, Sequence

from ..core.errors import BareEarthError, Cancelled, FinishedFilesStay
from ..core.files import (
    Outputs,
    is_same_file,
    make_work_folder,
    temporary_folder,
    write_errors_told,
)
from ..core.locks import alone_in
from ..core.progress import Progress
from ..core.temporary import remove, remove_leftovers
from ..crs.measurable import require_measurable
from ..crs.system import Crs
from ..las.lasfile import LasFile
from ..las.opening import NoPoints
from ..las.unpacked import has_room
from ..las.writing import write_without_points
from ..survey.files import Inputs, Survey, open_survey
from ..survey.vpc import write_vpc
from .job_queue import JobQueue
from .manifest import folders_of, remove_record
from .options import TileOutput
from .plan import Plan
from .sinks import run_sink
from .step import PointStep, Step, placed
from .summary import JobCost, SurveySummary
from .targets import check_own, check_survey, targets_of
from .unpacking import Unpacking
from .workers import Workers


def work_on_survey(
    steps: Sequence[Step],
    inputs: Inputs,
    folder: Path | None,
    output: TileOutput,
    progress: Progress,
    workers: Workers,
    vpc: Path | None,
    outputs: Outputs | None = None,
) -> Any:
    """Let steps work on many files as one survey, each on what those before it found, and write the
    files with the results into a folder, with the names of the inputs.
    """
    # The results are those of one file with all points. A file that cannot be processed does not
    # stop the others, but an error says if none can be processed, and `FinishedFilesStay` if the
    # user asked to stop.
    if folder is None or vpc is None:
        return _work_sinks(steps, inputs, progress, workers, outputs)
    run = _SurveyRun(folder, steps, output, vpc, outputs)
    with _finished_files_stay():
        try:
            run.open(inputs, progress)
        except NoPoints as empty:
            return _written_without_points(empty.layouts, inputs, folder, output, progress, vpc)
        run.work(workers, progress.part(0.02, 0.98))
        return run.finish(progress)


def _work_sinks(
    steps: Sequence[Any],
    inputs: Inputs,
    progress: Progress,
    workers: Workers,
    outputs: Outputs | None,
) -> Any:
    """Let sinks work on many files, each of which writes all of its outputs or none; return what
    the last tells.
    """
    own = [output for step in steps for output in step.outputs]
    survey = open_survey(inputs, progress.part(0.0, 0.05))
    require_measurable("The survey", survey.crs, survey.box)
    check_own(own, survey, [tile.path for tile in survey.tiles])
    for tile in survey.broken:
        progress.warning(f"{tile.path} is left out. {tile.reason}")
    told, parts = None, progress.part(0.05, 1.0).shares(*(step.weight for step in steps))
    with temporary_folder(own[0][1].parent) as working:
        unpacking = _unpacking(working, survey, workers, is_whole=False)
        for step, part in zip(placed(steps, survey.place, progress), parts):
            told = run_sink(
                survey, working, step, workers, part, unpacking=unpacking, outputs=outputs
            )
    return told


def _written_without_points(
    layouts: tuple[LasFile, ...],
    inputs: Inputs,
    folder: Path,
    output: TileOutput,
    progress: Progress,
    vpc: Path,
) -> SurveySummary:
    """Write files, none of which holds a point, as they are; no list of them has an extent."""
    survey = Survey((), (), Crs(), None, layouts)
    check_survey(survey, folder, vpc, inputs if inputs.recursive else [])
    targets = targets_of(survey, folder, output.format)
    with write_errors_told(folder):
        folder.mkdir(parents=True, exist_ok=True)
    _write_empty(survey, targets, progress)
    count = len(layouts)
    return SurveySummary(count, count, 0, 0, 0, {}, "")


def _write_empty(survey: Survey, targets: Mapping[Path, Path], progress: Progress) -> None:
    """Write the files of a survey that hold no points."""
    for layout in survey.empty:
        write_without_points(layout, targets[layout.path])
        progress.info(f"{layout.path.name} is written as it is, since it holds no points.")


@contextlib.contextmanager
def _finished_files_stay() -> Iterator[None]:
    """Say after a cancel that the run can be continued."""
    try:
        yield
    except (Cancelled, KeyboardInterrupt) as error:
        raise FinishedFilesStay from error


class _SurveyRun:
    """A run of steps on many files; the parameters are those of `work_on_survey`."""

    def __init__(
        self,
        folder: Path,
        steps: Sequence[Step],
        output: TileOutput,
        vpc: Path,
        outputs: Outputs | None,
    ) -> None:
        self._folder, self._output, self._outputs = folder, output, outputs
        # Steps that find values for points, and then what is made of these.
        self._steps: list[Any] = [step for step in steps if isinstance(step, PointStep)]
        self._sinks: list[Any] = [step for step in steps if not isinstance(step, PointStep)]
        self._vpc = vpc
        # Inputs that cannot be done, and why, by their names.
        self._failures: dict[str, tuple[Path, str]] = {}
        # Summaries of the finished files, sorted by their names.
        self._done: list[Any] = []
        self._kept_count = self._empty_count = 0
        self._jobs: list[JobCost] = []

    def open(self, inputs: Inputs, progress: Progress) -> None:
        """Open the inputs, and refuse now what would fail at the end."""
        for source in inputs:
            if is_same_file(source, self._vpc):
                raise BareEarthError(
                    f"Input and output are the same file, {source}. Choose another output."
                )
        self._survey = survey = open_survey(inputs, progress.part(0.0, 0.02))
        require_measurable("The survey", survey.crs, survey.box)
        check_survey(survey, self._folder, self._vpc, inputs if inputs.recursive else [])
        count = len(self._steps)
        steps = placed([*self._steps, *self._sinks], survey.place, progress)
        self._steps, self._sinks = steps[:count], steps[count:]
        for step in steps:
            step.check_survey(survey.box, steps)
        self._targets = targets_of(survey, self._folder, self._output.format)
        for step in self._sinks:
            others = self._vpc, *self._targets, *self._targets.values()
            check_own(step.outputs, survey, others, self._folder)
        self._inputs = {tile.path.name: tile.path for tile in survey.tiles}
        self._failures = {tile.path.name: (tile.path, tile.reason) for tile in survey.broken}

    def work(self, workers: Workers, progress: Progress) -> None:
        """Do what is to be done, in a folder of which no other run makes use meanwhile."""
        resume, (_, records, waiting) = self._output.resume, folders_of(self._folder)
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
        """Run the jobs of a plan, and then the sinks."""
        kept = plan.files_kept() if self._sinks else []
        unpacking = _unpacking(waiting, self._survey, workers, is_whole=True)
        blocks, tiles = plan.jobs(workers, self._folder, unpacking)
        end = 0.8 if self._sinks else 1.0
        queue = JobQueue(blocks, tiles, workers, progress.part(0.0, end), kept)
        queue.work()
        self._done, self._kept_count = sorted([*plan.kept, *queue.done]), len(plan.kept)
        self._empty_count = plan.empty_count + queue.empty_count
        self._jobs = queue.costs
        for path, reason in {**plan.failures, **queue.failures}.items():
            self._failures[path.name] = path, reason
        if self._done or self._empty_count:
            self._tell(queue.done, progress)
        if self._done and self._sinks:
            paths = [self._folder / summary.name for summary in self._done]
            written = open_survey(Inputs(paths).read_as(self._survey.stated), progress.quiet())
            results, rest = plan.results(written), progress.part(end, 1.0)
            for step, part in zip(self._sinks, rest.shares(*(s.weight for s in self._sinks))):
                run_sink(written, waiting, step, workers, part, results, unpacking, self._outputs)

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
        reasons = {str(path): reason for path, reason in sorted(self._failures.values())}
        for path, reason in reasons.items():
            progress.warning(f"{path} is left out. {reason}")
        if not self._done:
            raise BareEarthError(
                f"None of the {len(reasons):,} files could be done."
                if reasons
                else "None of the files has points to write in the area."
            )
        _write_empty(self._survey, self._targets, progress)
        if self._empty_count:
            progress.info(
                f"{self._empty_count:,} files are not written: they have no points to write in the"
                " area."
            )
        paths = [self._folder / summary.name for summary in self._done]
        part, stated = progress.part(0.98, 1.0), self._survey.stated
        write_vpc(self._vpc, paths, part, self._output.overview, stated)
        without = len(self._survey.empty)
        unknown = self._failures.keys() - self._inputs.keys()
        return SurveySummary(
            tile_count=len(self._inputs) - self._empty_count + len(unknown) + without,
            done_count=len(self._done) + without,
            kept_count=self._kept_count,
            point_count=sum(sum(summary.class_counts.values()) for summary in self._done),
            ground_count=sum(getattr(summary, "ground_count", 0) for summary in self._done),
            failures=reasons,
            vpc=str(self._vpc),
            tiles=tuple(self._done),
            jobs=tuple(self._jobs),
        )


def _unpacking(folder: Path, survey: Survey, workers: Workers, is_whole: bool) -> Unpacking | None:
    """Return where files wait uncompressed: on this computer, if there is room."""
    if not workers.are_local:
        return None
    unpacked = survey.tiles[0].unpacked
    if unpacked is not None and isinstance(unpacked.file, Path):  # they do already
        return Unpacking(unpacked.file.parent, is_whole=True)
    return Unpacking(folder, is_whole) if has_room(folder, survey.count) else None
