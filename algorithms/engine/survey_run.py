"""Steps on many files as one survey, without seams."""

from __future__ import annotations

import contextlib
from pathlib import Path
from typing import Any, Iterator, Sequence

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
from ..survey.vpc import write_vpc
from .execution import Execution
from .job_queue import JobQueue
from .manifest import folders_of, remove_record
from .plan import Plan, Results
from .sinks import run_sink
from .step import PointStep, placed
from .summary import SurveySummary
from .targets import check_own, check_survey, targets_of
from .unpacking import Unpacking
from .workers import Threads, Workers


@contextlib.contextmanager
def _finished_files_stay() -> Iterator[None]:
    """Say after a cancel that the run can be continued."""
    try:
        yield
    except (Cancelled, KeyboardInterrupt) as error:
        raise FinishedFilesStay from error


class ManyFiles(Execution):
    """Steps that work on many files as one survey, which are written into a folder with the names
    of the inputs, if any step finds values for their points.
    """

    # The results are those of one file with all points. A file that cannot be processed does not
    # stop the others, but an error says if none can be processed, and `FinishedFilesStay` if the
    # user asked to stop.

    def open(self, inputs: Inputs) -> None:
        """Open the files, and refuse now what would fail at the end."""
        self._searched = inputs if inputs.recursive else ()
        self.workers = self.workers or Threads(self.resources)
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
            self._choose_targets()
            others = [self.vpc, *self._targets, *self._targets.values()]
        # Steps that find values for points, and then what is made of these.
        steps = sorted(self.steps, key=lambda step: not isinstance(step, PointStep))
        steps = placed(steps, survey.place, self.progress)
        self._steps: list[Any] = [step for step in steps if isinstance(step, PointStep)]
        self._sinks: list[Any] = steps[len(self._steps) :]
        for step in steps:
            step.check_survey(survey.box, steps)
        own = [output for step in self._sinks for output in step.outputs]
        check_own(own, survey, others, self.target)
        self._inputs = {tile.path.name: tile.path for tile in survey.tiles}
        # Inputs that cannot be done, and why, by their names.
        self._failures = {tile.path.name: (tile.path, tile.reason) for tile in survey.broken}

    def _choose_targets(self) -> None:
        """Find the output of each file, and refuse a folder that is not suitable."""
        check_survey(self._survey, self.target, self.vpc, self._searched)
        self._targets = targets_of(self._survey, self.target, self.output.format)

    def without_points(self, layouts: Sequence[LasFile]) -> SurveySummary:
        """Write the files as they are; no list of them has an extent."""
        self._survey = Survey((), (), Crs(), None, tuple(layouts))
        self._choose_targets()
        with write_errors_told(self.target):
            self.target.mkdir(parents=True, exist_ok=True)
        self._write_empty()
        count = len(layouts)
        return SurveySummary(count, count, 0, 0, 0, {}, "")

    def _write_empty(self) -> None:
        """Write the files that hold no points."""
        for layout in self._survey.empty:
            write_without_points(layout, self._targets[layout.path])
            self.progress.info(f"{layout.path.name} is written as it is, since it holds no points.")

    def work(self) -> None:
        """Do what is to be done, in a folder of which no other run makes use meanwhile."""
        if self.target is None:
            progress = self.progress.part(0.02, 1.0)
            self._tell_of_failures()
            with temporary_folder(self._sinks[0].outputs[0][1].parent) as waiting:
                unpacking = _unpacking(waiting, self._survey, self.workers, is_whole=False)
                self._make(self._survey, waiting, progress, None, unpacking)
            return
        progress = self.progress.part(0.02, 0.98)
        resume, (_, records, waiting) = self.output.resume, folders_of(self.target)
        plan = Plan(self._survey, self._targets, self._steps, waiting, progress.part(0.0, 0.02))
        with write_errors_told(self.target):
            self.target.mkdir(parents=True, exist_ok=True)
            make_work_folder(records)
        with alone_in(records):
            self._clear(results=not resume)
            with write_errors_told(self.target):
                make_work_folder(waiting)
            plan.keep_finished(resume, progress)
            self._run(plan, waiting, progress.part(0.02, 1.0))
            self._clear(results=True)

    def _run(self, plan: Plan, waiting: Path, progress: Progress) -> None:
        """Run the jobs of a plan, and then the sinks."""
        workers = self.workers
        kept = plan.files_kept() if self._sinks else []
        unpacking = _unpacking(waiting, self._survey, workers, is_whole=True)
        blocks, tiles = plan.jobs(workers, self.target, unpacking)
        end = 0.8 if self._sinks else 1.0
        queue = JobQueue(blocks, tiles, workers, progress.part(0.0, end), kept)
        queue.work()
        # Summaries of the finished files, sorted by their names.
        self._done: list[Any] = sorted([*plan.kept, *queue.done])
        self._kept_count = len(plan.kept)
        self._empty_count = plan.empty_count + queue.empty_count
        self._jobs = queue.costs
        for path, reason in {**plan.failures, **queue.failures}.items():
            self._failures[path.name] = path, reason
        if self._done or self._empty_count:
            self._tell(queue.done, progress)
        if self._done and self._sinks:
            paths = [self.target / summary.name for summary in self._done]
            written = open_survey(Inputs(paths).read_as(self._survey.stated), progress.quiet())
            results, rest = plan.results(written), progress.part(end, 1.0)
            self._make(written, waiting, rest, results, unpacking)

    def _make(
        self,
        survey: Survey,
        waiting: Path,
        progress: Progress,
        results: Results | None,
        unpacking: Unpacking | None,
    ) -> None:
        """Let the sinks work, whose results wait in a folder."""
        for step, part in zip(self._sinks, progress.shares(*(s.weight for s in self._sinks))):
            self._told = run_sink(
                survey, waiting, step, self.workers, part, results, unpacking, self.outputs
            )

    def _tell(self, done: Sequence[Any], progress: Progress) -> None:
        """Report on all files; remove the outputs of this run if they are refused together."""
        try:
            self._steps[0].tell_of_survey(self._done, progress)
        except BareEarthError:
            for summary in done:
                remove(self.target / summary.name)
                remove_record(self.target / summary.name)
            raise

    def _clear(self, results: bool) -> None:
        """Remove what killed runs left, and the results of blocks if `results`."""
        folders = folders_of(self.target)
        if results:
            remove(folders[2])
        for folder in folders:
            remove_leftovers(folder)

    def _tell_of_failures(self) -> dict[str, str]:
        """Report the files that are left out; return why, by their paths."""
        reasons = {str(path): reason for path, reason in sorted(self._failures.values())}
        for path, reason in reasons.items():
            self.progress.warning(f"{path} is left out. {reason}")
        return reasons

    def finish(self) -> Any:
        """Report on the files, and list them in a virtual point cloud; or tell what the last sink
        does, if no points are written.
        """
        if self.target is None:
            return self._told
        progress, reasons = self.progress, self._tell_of_failures()
        if not self._done:
            raise BareEarthError(
                f"None of the {len(reasons):,} files could be done."
                if reasons
                else "None of the files has points to write in the area."
            )
        self._write_empty()
        if self._empty_count:
            progress.info(
                f"{self._empty_count:,} files are not written: they have no points to write in the"
                " area."
            )
        paths = [self.target / summary.name for summary in self._done]
        part, stated = progress.part(0.98, 1.0), self._survey.stated
        write_vpc(self.vpc, paths, part, self.output.overview, stated)
        without = len(self._survey.empty)
        unknown = self._failures.keys() - self._inputs.keys()
        return SurveySummary(
            tile_count=len(self._inputs) - self._empty_count + len(unknown) + without,
            done_count=len(self._done) + without,
            kept_count=self._kept_count,
            point_count=sum(sum(summary.class_counts.values()) for summary in self._done),
            ground_count=sum(getattr(summary, "ground_count", 0) for summary in self._done),
            failures=reasons,
            vpc=str(self.vpc),
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
