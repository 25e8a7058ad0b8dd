"""A run: steps that work on the points of a file, or of many files as one survey."""

from __future__ import annotations

import contextlib
from dataclasses import MISSING, dataclass, field, fields
from pathlib import Path
from typing import TYPE_CHECKING, Any, Iterator, Sequence

from ..core.files import Outputs
from ..core.imports import import_early
from ..core.progress import SILENT, Progress
from ..core.threads import may_use
from ..las.cloud import PointCloud, survey_frame
from ..las.lasfile import LasFile
from ..las.opening import NoPoints
from ..las.writing import write_without_points
from ..survey.files import Inputs
from .file_points import FilePoints, TileResult, copies_all_else, place_of
from .memory import Resources
from .options import TileOutput
from .step import PointStep, Step, placed
from .values import PointValues, with_values
from .visits import Work, visited

if TYPE_CHECKING:
    from .workers import Workers

# Share of reading in the progress, as the `weight` of steps, and of all before points are written.
_READING = 1.5
_BEFORE_WRITING = 0.92


@dataclass(frozen=True)
class Run:
    """Steps, each of which sees the points with what those before it have found."""

    steps: tuple[Step, ...]
    output: TileOutput = field(default_factory=TileOutput)  # of many files
    resources: Resources = field(default_factory=Resources)

    def work(
        self,
        inputs: Inputs,
        target: Path | None = None,
        progress: Progress = SILENT,
        workers: Workers | None = None,
        vpc: Path | None = None,
        outputs: Outputs | None = None,
    ) -> Any:
        """Let the steps work, and write the points into a file, those of a survey into a folder;
        return the summary.
        """
        # `target`, and the virtual point cloud of a survey, are None if no step finds a value for
        # each point. The workers are by default threads of this process. All but the files of a
        # survey get their names when `outputs` ends, or else at the end of the run.
        if inputs.is_survey:
            from .survey_run import work_on_survey
            from .workers import Threads

            workers = workers or Threads(self.resources)
            return work_on_survey(
                self.steps, inputs, target, self.output, progress, workers, vpc, outputs
            )
        try:
            (las,) = inputs.open().tiles
        except NoPoints as empty:
            if target is None:
                raise
            return self._write_without_points(empty.layouts[0], target, progress)
        return self._work_on_file(las, target, progress, outputs)

    def _work_on_file(
        self, las: LasFile, target: Path | None, progress: Progress, outputs: Outputs | None
    ) -> Any:
        """Write the points of a file with what the steps find, and nothing else changed; all
        outputs or none.
        """
        steps, resources = self.steps, self.resources.now()
        for step in steps:
            # Refuses, before any reading, what the header shows to be unsuitable.
            step.placed(place_of(las))
        import_early(*(name for step in steps for name in step.imports))
        for_points = [step for step in steps if isinstance(step, PointStep)]
        beside = target or next(path for _, path in self._outputs)
        needs_records = bool(for_points) and not copies_all_else(las, beside, for_points)
        before = progress.part(0.0, _BEFORE_WRITING) if target else progress
        reading, working = before.shares(_READING, sum(step.weight for step in steps))
        with contextlib.ExitStack() as opened:
            outputs = outputs or opened.enter_context(Outputs())
            opened.enter_context(may_use(resources.thread_count))
            points = FilePoints.opened(las, beside, resources, needs_records, reading)
            run = FileRun(opened.enter_context(points), steps, progress, outputs)
            run.work(working)
            if target is None:
                return run.told[-1]
            writing = progress.part(_BEFORE_WRITING, 1.0)
            result = run.found(writing.part(0.0, 0.2))
            result.write(outputs.file(target), writing.part(0.2, 1.0))
        return result.summary(target.name)

    def _write_without_points(self, layout: LasFile, target: Path, progress: Progress) -> Any:
        """Write a file without points as it is, and nothing of what is made of points."""
        write_without_points(layout, target)
        names = ", ".join(path.name for _, path in self._outputs)
        more = f" {names} cannot be made of it." if names else ""
        progress.warning(f"{layout.path} holds no points: {target.name} is written as it is.{more}")
        kind = next(step for step in self.steps if isinstance(step, PointStep)).summary_type
        lacking = (one for one in fields(kind) if one.default is one.default_factory is MISSING)
        return kind(**{one.name: target.name if one.name == "name" else 0 for one in lacking})

    @property
    def _outputs(self) -> list[tuple[str, Path]]:
        """The kinds and paths of the files that the steps write beside points."""
        return [output for step in self.steps for output in step.outputs]


class FileRun:
    """Steps that work on the points of one file, one after the other; their own outputs get their
    names when `outputs` is closed.
    """

    def __init__(
        self,
        points: FilePoints,
        steps: Sequence[Step],
        progress: Progress,
        outputs: Outputs | None = None,
    ) -> None:
        self.steps: list[Any] = placed(steps, points.place, progress)
        self.points, self.outputs = points, outputs or Outputs()
        self.told: list[Any] = []  # what `finish` of the steps returned
        self._values: list[PointValues] = []

    def work(self, progress: Progress) -> None:
        """Run the steps, each of which sees what those before it have found."""
        start, weights = 0, [step.weight for step in self.steps]
        total = sum(weights)
        while start < len(self.steps):
            end = self._end_of_group(start)
            part = progress.part(sum(weights[:start]) / total, sum(weights[:end]) / total)
            self._work_group(slice(start, end), part)
            start = end

    def _end_of_group(self, start: int) -> int:
        """Return the end of the steps that see the same points, so that these are read once."""
        ends = (n + 1 for n in range(start, len(self.steps)) if self.steps[n].gives_classes)
        return next(ends, len(self.steps))

    def _work_group(self, group: slice, progress: Progress) -> None:
        """Run steps that see the same points."""
        points = self.points
        works = [Work(step, points.store_for(step)) for step in self.steps[group]]
        reading = points.sparing(progress.part(0.0, 0.08))
        for where, part in with_values(points.parts(reading, self._reads_once), self._values):
            stored = points.as_stored(where, part)
            for work in works:
                work.add(part, stored)
        shares = progress.part(0.08, 0.12).shares(*[1.0] * len(works))
        for work, share in zip(works, shares):
            work.step.tell(work.counts, points.path, progress)
            work.store.finish(share)
        weights = [work.step.weight for work in works]
        rests = [work.step.weight * work.step.weight_of_outputs for work in works]
        working, *writing = progress.part(0.12, 1.0).shares(sum(weights), *rests)
        for work in works:
            work.step = self._seeing(work.step, working)
        results = visited(works, points.resources, working)
        for work, result, rest in zip(works, results, writing):
            step = work.step
            if isinstance(step, PointStep):
                self._values.append(PointValues(step, work.store))
            else:
                result = [found for _, found in result]
            frame = survey_frame(points.cloud.crs, step.origin)
            self.told.append(step.finish(result, frame, self.outputs, rest))

    @property
    def _reads_once(self) -> bool:
        """Whether the points are read only once, as no step gives values or looks at them first."""
        return not any(isinstance(step, PointStep) or step.looks_first for step in self.steps)

    def _seeing(self, step: Any, progress: Progress) -> Any:
        """Return a step after a look at the points."""
        frame = survey_frame(self.points.cloud.crs, step.origin)
        return step.seeing(self._look, frame, progress)

    def _look(self) -> Iterator[PointCloud]:
        """Yield the points with what was found for them by now, part by part."""
        return (part for _, part in with_values(self.points.parts(), self._values))

    def found(self, progress: Progress) -> TileResult:
        """Return what the steps found for each point."""
        result = TileResult.found(self.points, self._values, progress)
        result.tell(progress)
        return result
