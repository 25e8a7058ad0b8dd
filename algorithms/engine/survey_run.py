"""A run on many files as one survey, without seams."""

from __future__ import annotations

import contextlib
from pathlib import Path
from typing import Iterator, Sequence

from ..core.errors import BareEarthError, Cancelled, FinishedFilesStay
from ..core.files import (
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
from ..las.unpacked import has_room
from ..las.writing import write_without_points
from ..survey.files import Inputs, Survey, open_survey
from ..survey.shapes import outside
from ..survey.vpc import write_vpc
from .execution import Execution
from .job_queue import JobQueue
from .manifest import folders_of, remove_record
from .plan import Plan
from .results import Results
from .sinks import run_sink
from .step import PointStep, Sink, steps_in_crs
from .summary import SurveySummary
from .targets import check_step_outputs, check_survey, targets_of
from .unpacking import Unpacking
from .workers import Threads, Workers


@contextlib.contextmanager
def _finished_files_stay() -> Iterator[None]:
    """Turn a cancel into `FinishedFilesStay`, which says that the run can be continued."""
    try:
        yield
    except (Cancelled, KeyboardInterrupt) as error:
        raise FinishedFilesStay from error


class ManyFiles(Execution):
    """A run on many files as one survey; if points are written, the outputs are in one folder, with
    the names of the inputs.
    """

    # The results are those of one file with all points. A file that cannot be processed does not
    # stop the others; if no file can be processed, that is an error. If the user asks to stop,
    # `FinishedFilesStay` is raised.

    _is_refused = False  # all files together

    def open(self, inputs: Inputs) -> None:
        """Open the files, and refuse now what would fail at the end."""
        self._searched = inputs if inputs.recursive else ()
        if self.target is not None:
            self.opened.enter_context(_finished_files_stay())
        for source in inputs:
            if self.vpc is not None and is_same_file(source, self.vpc):
                raise BareEarthError(
                    f"Input and output are the same file, {source}. Choose another output."
                )
        self._survey = survey = open_survey(inputs, self.progress.part(0.0, 0.02))
        require_measurable("The survey", survey.crs, survey.box)
        others: Sequence[Path] = [tile.path for tile in survey.tiles]
        if self.target is not None:
            self._choose_targets(self.target)
            others = [self.vpc, *self._targets, *self._targets.values()]
        steps = sorted(self.steps, key=lambda step: not isinstance(step, PointStep))
        steps = steps_in_crs(steps, survey.place, self.progress)
        self._point_steps = [step for step in steps if isinstance(step, PointStep)]
        self._sinks = [step for step in steps if isinstance(step, Sink)]
        for step in self._point_steps:
            if step.area is not None and not step.area.may_touch(survey.box):
                raise outside("the area", step.area.bounds, "the files", survey.box)
        outputs = [output for step in self._sinks for output in step.outputs]
        check_step_outputs(outputs, survey, others, self.target)
        self._inputs = {tile.path.name: tile.path for tile in survey.tiles}
        # The paths of files that cannot be processed, with the reasons, by the names of the files.
        self._failures = {tile.path.name: (tile.path, tile.reason) for tile in survey.broken}

    def _choose_targets(self, folder: Path) -> None:
        check_survey(self._survey, folder, self.vpc, self._searched)
        self._targets = targets_of(self._survey, folder, self.output.format)

    def copy_empty(self, layouts: Sequence[LasFile], target: Path) -> SurveySummary:
        """Write the files unchanged, and no virtual point cloud, since they have no extent."""
        self._survey = Survey((), (), Crs(), None, tuple(layouts))
        self._choose_targets(target)
        with write_errors_told(target):
            target.mkdir(parents=True, exist_ok=True)
        self._copy_empty_files()
        count = len(layouts)
        return SurveySummary(count, count, 0, 0, 0, {}, "")

    def _copy_empty_files(self) -> None:
        for layout in self._survey.empty:
            write_without_points(layout, self._targets[layout.path])
            self.progress.info(f"{layout.path.name} is written as it is, since it holds no points.")

    def work(self) -> None:
        """Let the point steps work, in a folder that no other run uses, and then the sinks."""
        workers = self.workers or Threads(self.resources)
        if self.target is not None:
            self._work_on_points(self.target, workers)
            return
        self._report_failures()
        with temporary_folder(self._sinks[0].outputs[0][1].parent) as waiting:
            unpacking = _unpacking(waiting, self._survey, workers, is_whole=False)
            progress = self.progress.part(0.02, 1.0)
            self._run_sinks(self._survey, waiting, workers, progress, None, unpacking)

    def _work_on_points(self, folder: Path, workers: Workers) -> None:
        """Compute and write what is missing in the folder of the outputs, and run the sinks."""
        progress = self.progress.part(0.02, 0.98)
        resume, (_, records, waiting) = self.output.resume, folders_of(folder)
        plan = Plan(
            self._survey, self._targets, self._point_steps, waiting, progress.part(0.0, 0.02),
            has_sinks=bool(self._sinks),
        )  # fmt: skip
        is_new = not folder.exists()
        with write_errors_told(folder):
            folder.mkdir(parents=True, exist_ok=True)
            make_work_folder(records)
        with contextlib.ExitStack() as ends:
            if is_new:
                ends.callback(self._leave_nothing, folder, records)  # after the lock
            ends.enter_context(alone_in(records))
            _clear(folder, results=not resume)
            with write_errors_told(folder):
                make_work_folder(waiting)
            plan.keep_finished(resume, progress)
            self._run(plan, folder, waiting, workers, progress.part(0.02, 1.0))
            _clear(folder, results=True)

    def _leave_nothing(self, folder: Path, records: Path) -> None:
        """Remove the folder that was made for a survey that is refused."""
        if self._is_refused:
            remove(records)
            with contextlib.suppress(OSError):  # it holds something else
                folder.rmdir()

    def _run(
        self, plan: Plan, folder: Path, waiting: Path, workers: Workers, progress: Progress
    ) -> None:
        kept = plan.files_for_sinks() if self._sinks else []
        unpacking = _unpacking(waiting, self._survey, workers, is_whole=True)
        blocks, tiles = plan.jobs(workers, folder, unpacking)
        end = 0.8 if self._sinks else 1.0
        queue = JobQueue(blocks, tiles, workers, progress.part(0.0, end), kept)
        queue.work()
        # The summaries of the finished files.
        self._done = sorted([*plan.kept, *queue.done], key=lambda summary: summary.name)
        self._kept_count = len(plan.kept)
        empty = [*plan.empty, *queue.empty]
        self._empty_count = len(empty)
        self._jobs = queue.costs
        for path, reason in {**plan.failures, **queue.failures}.items():
            self._failures[path.name] = path, reason
        if self._done or empty:
            try:
                self._point_steps[0].report_survey(self._done, empty, progress)
            except BareEarthError:  # it refuses all files together
                self._is_refused = True
                for path in (folder / summary.name for summary in queue.done):
                    remove(path)
                    remove_record(path)
                raise
        if self._done and self._sinks:
            paths = [folder / summary.name for summary in self._done]
            written = open_survey(Inputs(paths).read_as(self._survey.stated), progress.quiet())
            results, part = plan.results(written, empty), progress.part(end, 1.0)
            self._run_sinks(written, waiting, workers, part, results, unpacking)

    def _run_sinks(
        self,
        survey: Survey,
        waiting: Path,  # the folder for the results of blocks
        workers: Workers,
        progress: Progress,
        results: Results | None,
        unpacking: Unpacking | None,
    ) -> None:
        for sink, part in zip(self._sinks, progress.shares(*(s.weight for s in self._sinks))):
            summary = run_sink(
                survey, waiting, sink, workers, part, results, unpacking, self.outputs
            )
            self.step_summaries.append(summary)

    def _report_failures(self) -> dict[str, str]:
        """Report the files that are left out; return the reasons by path."""
        reasons = {str(path): reason for path, reason in sorted(self._failures.values())}
        for path, reason in reasons.items():
            self.progress.warning(f"{path} is left out. {reason}")
        return reasons

    def write(self, target: Path) -> SurveySummary:
        """Report on the files, copy the empty ones, and write the virtual point cloud."""
        progress, reasons = self.progress, self._report_failures()
        if not self._done:
            raise BareEarthError(
                f"None of the {len(reasons):,} files could be done."
                if reasons
                else "None of the files has points to write in the area."
            )
        self._copy_empty_files()
        paths = [target / summary.name for summary in self._done]
        part, stated = progress.part(0.98, 1.0), self._survey.stated
        write_vpc(self.vpc, paths, part, stated)
        copied = len(self._survey.empty)
        unreadable = self._failures.keys() - self._inputs.keys()
        return SurveySummary(
            tile_count=len(self._inputs) - self._empty_count + len(unreadable) + copied,
            done_count=len(self._done) + copied,
            kept_count=self._kept_count,
            point_count=sum(sum(summary.class_counts.values()) for summary in self._done),
            ground_count=sum(getattr(summary, "ground_count", 0) for summary in self._done),
            failures=reasons,
            vpc=str(self.vpc),
            tiles=tuple(self._done),
            jobs=tuple(self._jobs),
        )


def _clear(target: Path, results: bool) -> None:
    """Remove what killed runs left in the folders of a run, and the `results` of blocks."""
    folders = folders_of(target)
    if results:
        remove(folders[2])
    for folder in folders:
        remove_leftovers(folder)


def _unpacking(folder: Path, survey: Survey, workers: Workers, is_whole: bool) -> Unpacking | None:
    """Return where files wait uncompressed, if the workers are local and the disk has room."""
    if not workers.are_local:
        return None
    unpacked = survey.tiles[0].unpacked
    if unpacked is not None and isinstance(unpacked.file, Path):  # they do already
        return Unpacking(unpacked.file.parent, is_whole=True)
    return Unpacking(folder, is_whole) if has_room(folder, survey.count) else None
