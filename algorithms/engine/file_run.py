"""A run on one file, whose points stay in memory if they fit, and so does what steps find."""

from __future__ import annotations

from dataclasses import MISSING, fields
from pathlib import Path
from typing import Any, Iterator, Sequence

from ..core.files import Outputs
from ..core.imports import import_early
from ..core.progress import Progress
from ..core.threads import may_use
from ..las.cloud import PointCloud, survey_frame
from ..las.lasfile import LasFile
from ..las.writing import write_without_points
from ..survey.files import Inputs
from .execution import Execution
from .file_points import FilePoints, TileResult, copies_all_else, place_of
from .step import PointStep, placed
from .values import PointValues, with_values
from .visits import Work, visited

# Share of reading in the progress, as the `weight` of steps, and of all before points are written.
_READING = 1.5
_BEFORE_WRITING = 0.92


class OneFile(Execution):
    """A run on one file, which writes its points with what the steps find, and nothing else
    changed, all outputs or none; or on points in memory (`work_on`).
    """

    def open(self, inputs: Inputs) -> None:
        """Open the file, and refuse before any reading what its header shows to be unsuitable."""
        (self._las,) = inputs.open().tiles
        for step in self.steps:
            step.placed(place_of(self._las))

    def without_points(self, layouts: Sequence[LasFile]) -> Any:
        """Write the file as it is, and nothing of what is made of points."""
        (layout,), target = layouts, self.target
        write_without_points(layout, target)
        names = ", ".join(path.name for path in self._beside)
        more = f" {names} cannot be made of it." if names else ""
        self.progress.warning(
            f"{layout.path} holds no points: {target.name} is written as it is.{more}"
        )
        kind = next(step for step in self.steps if isinstance(step, PointStep)).summary_type
        lacking = (item for item in fields(kind) if item.default is item.default_factory is MISSING)
        return kind(**{item.name: target.name if item.name == "name" else 0 for item in lacking})

    def work(self) -> None:
        """Read the points, and let the steps work."""
        las, target, steps = self._las, self.target, self.steps
        resources, opened = self.resources.now(), self.opened
        import_early(*(name for step in steps for name in step.imports))
        for_points = [step for step in steps if isinstance(step, PointStep)]
        beside = target or self._beside[0]
        needs_records = bool(for_points) and not copies_all_else(las, beside, for_points)
        before = self.progress.part(0.0, _BEFORE_WRITING) if target else self.progress
        reading, working = before.shares(_READING, sum(step.weight for step in steps))
        self.outputs = self._files = self.outputs or opened.enter_context(Outputs())
        opened.enter_context(may_use(resources.thread_count))
        points = FilePoints.opened(las, beside, resources, needs_records, reading)
        opened.enter_context(points)
        self.work_on(points, working)

    def finish(self) -> Any:
        """Write the points, if any step finds values for them; else return what the last tells."""
        if self.target is None:
            return self.told[-1]
        writing = self.progress.part(_BEFORE_WRITING, 1.0)
        result = self.found(writing.part(0.0, 0.2))
        result.write(self._files.file(self.target), writing.part(0.2, 1.0))
        return result.summary(self.target.name)

    @property
    def _beside(self) -> list[Path]:
        """The files that the steps write beside points."""
        return [path for step in self.steps for _, path in step.outputs]

    def work_on(self, points: FilePoints, progress: Progress) -> None:
        """Let the steps work on points, each of which sees what those before it have found."""
        self._points, self._values = points, list[PointValues]()
        self.told: list[Any] = []  # what `finish` of the steps returned
        self.steps = placed(self.steps, points.place, self.progress)
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
        points = self._points
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
            self.told.append(step.finish(result, frame, self.outputs or Outputs(), rest))

    @property
    def _reads_once(self) -> bool:
        """Whether the points are read only once, as no step gives values or looks at them first."""
        return not any(isinstance(step, PointStep) or step.looks_first for step in self.steps)

    def _seeing(self, step: Any, progress: Progress) -> Any:
        """Return a step after a look at the points."""
        frame = survey_frame(self._points.cloud.crs, step.origin)
        return step.seeing(self._look, frame, progress)

    def _look(self) -> Iterator[PointCloud]:
        """Yield the points with what was found for them by now, part by part."""
        return (part for _, part in with_values(self._points.parts(), self._values))

    def found(self, progress: Progress) -> TileResult:
        """Return what the steps found for each point."""
        result = TileResult.found(self._points, self._values, progress)
        result.tell(progress)
        return result
