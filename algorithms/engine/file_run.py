"""A run on one file: its points, and the results of steps, stay in memory if they fit."""

from __future__ import annotations

from dataclasses import MISSING, fields
from functools import partial
from pathlib import Path
from typing import Iterator, Sequence

from ..core.files import Outputs
from ..core.imports import import_early
from ..core.progress import Progress
from ..core.threads import may_use
from ..las.cloud import PointCloud
from ..las.lasfile import LasFile
from ..las.writing import write_without_points
from ..survey.files import Inputs
from .execution import Execution
from .file_points import FilePoints, TileResult, copies_all_else, place_of
from .memory import Resources
from .step import PointStep, Sink, Step, steps_in_crs
from .summary import RunSummary
from .values import PointValues, with_values
from .visits import Work, visited

# The weight of reading in the progress, in the unit of `Step.weight`.
_READING = 1.5
# The weight of writing the outputs of a sink, as a share of `Step.weight`.
_OUTPUTS = 0.25
# The share of the progress before points are written.
_BEFORE_WRITING = 0.92


class OneFile(Execution):
    """A run on one file, which writes a copy of it with the results of the steps, and all outputs
    or none; or on points in memory (`work_on`).
    """

    def open(self, inputs: Inputs) -> None:
        """Open the file, and refuse before any reading what its header shows to be unsuitable."""
        (self._las,) = inputs.open(self.progress).tiles
        for step in self.steps:
            step.in_crs(place_of(self._las))

    def copy_empty(self, layouts: Sequence[LasFile], target: Path) -> RunSummary:
        """Write the file unchanged, and no other output, since other outputs are made of points."""
        (layout,) = layouts
        write_without_points(layout, target)
        names = ", ".join(path.name for path in self._other_outputs)
        more = f" {names} cannot be made of it." if names else ""
        self.progress.warning(
            f"{layout.path} holds no points: {target.name} is written as it is.{more}"
        )
        kind = next(step for step in self.steps if isinstance(step, PointStep)).summary_type
        needed = (item for item in fields(kind) if item.default is item.default_factory is MISSING)
        return kind(**{item.name: target.name if item.name == "name" else 0 for item in needed})

    def work(self) -> None:
        las, steps = self._las, self.steps
        resources, opened = self.resources.now(), self.opened
        import_early(*(name for step in steps for name in step.imports))
        for_points = [step for step in steps if isinstance(step, PointStep)]
        main_output = self.target or self._other_outputs[0]
        needs_records = bool(for_points) and not copies_all_else(las, main_output, for_points)
        before = self.progress.part(0.0, _BEFORE_WRITING) if self.target else self.progress
        reading, working = before.shares(_READING, sum(step.weight for step in steps))
        self._files = self.outputs or opened.enter_context(Outputs())
        opened.enter_context(may_use(resources.thread_count))
        points = FilePoints.opened(las, main_output, resources, needs_records, reading)
        opened.enter_context(points)
        self.work_on(points, working, self._files)

    def write(self, target: Path) -> RunSummary:
        writing = self.progress.part(_BEFORE_WRITING, 1.0)
        result = self.result(writing.part(0.0, 0.2))
        result.write(self._files.file(target), writing.part(0.2, 1.0))
        return result.summary(target.name)

    @property
    def _other_outputs(self) -> list[Path]:
        return [path for step in self.steps for _, path in step.outputs]

    def work_on(
        self, points: FilePoints, progress: Progress, outputs: Outputs | None = None
    ) -> None:
        """Let the steps work on points; `outputs` are needed if steps write files."""
        self._points, self._values = points, list[PointValues]()
        self.steps = steps_in_crs(self.steps, points.place, self.progress)
        # Steps up to one that gives classes see the same classes, and share a reading.
        groups: list[list[Step]] = [[]]
        for step in self.steps:
            groups[-1].append(step)
            if step.gives_classes:
                groups.append([])
        groups = [group for group in groups if group]
        shares = progress.shares(*(sum(step.weight for step in group) for group in groups))
        for group, share in zip(groups, shares):
            self._work_group(group, share, outputs or Outputs())

    @classmethod
    def on_cloud(
        cls, steps: Sequence[Step], cloud: PointCloud, resources: Resources, progress: Progress
    ) -> OneFile:
        """Let steps work on points in memory; return the run, which has what they found."""
        run = cls(steps, resources, progress)
        with may_use(resources.thread_count):
            run.work_on(FilePoints(cloud, resources), progress)
        return run

    def _work_group(self, group: Sequence[Step], progress: Progress, outputs: Outputs) -> None:
        points, works = self._points, []
        first = points.freeing_memory(progress.part(0.0, 0.03))
        for step in group:
            if isinstance(step, Sink):
                read, frame = partial(self._read, first), points.frame_of(step)
                step = step.with_all_points(read, frame, progress.part(0.03, 0.04))
            works.append(Work(step, points.store_for(step)))
        reading = points.freeing_memory(progress.part(0.04, 0.08))
        is_last = not any(isinstance(step, PointStep) for step in self.steps)
        for where, part in with_values(points.parts(reading, is_last), self._values):
            stored = points.as_stored(where, part)
            for work in works:
                work.add(part, stored)
        shares = progress.part(0.08, 0.12).shares(*[1.0] * len(works))
        for work, share in zip(works, shares):
            work.step.report_counts(work.counts, points.path, progress)
            work.store.finish(share)
        weights = [work.step.weight for work in works]
        sinks = [work.step for work in works if isinstance(work.step, Sink)]
        output_weights = [step.weight * _OUTPUTS for step in sinks]
        working, *writing = progress.part(0.12, 1.0).shares(sum(weights), *output_weights)
        results = visited(works, points.resources, working)
        for work, result in zip(works, results):
            if isinstance(work.step, PointStep):
                self._values.append(PointValues(work.step, work.store))
            elif isinstance(work.step, Sink):
                arrays = [of_block for _, of_block in result]
                frame, share = points.frame_of(work.step), writing.pop(0)
                self.step_summaries.append(work.step.finish(arrays, frame, outputs, share))

    def _read(self, progress: Progress) -> Iterator[PointCloud]:
        """Yield the points with the values of the steps that have worked, part by part."""
        return (part for _, part in with_values(self._points.parts(progress), self._values))

    def result(self, progress: Progress) -> TileResult:
        result = TileResult.collected(self._points, self._values, progress)
        result.report(progress)
        return result
