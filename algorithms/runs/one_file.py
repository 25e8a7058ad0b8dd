"""Classification, heights, key points and rasters of one file.

It is a survey of one tile, whose values stay in the stores of this process.
"""

from __future__ import annotations

import contextlib
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Iterator, Sequence

import numpy as np

from ..core.files import Outputs
from ..core.parameters import ParameterSet
from ..core.progress import SILENT, Progress
from ..core.threads import import_early, may_use
from ..crs.measurable import require_measurable
from ..engine.file_points import FilePoints, TileResult, copies_all_else
from ..engine.memory import Resources
from ..engine.step import PointStep, Step, located
from ..engine.store import Store
from ..engine.values import PointValues, StoreValues, with_values
from ..las.cloud import PointCloud, survey_frame
from ..las.crs_records import read_crs
from ..las.lasfile import LasFile
from ..las.opening import open_las
from ..survey.area import Area
from ..survey.corrections import NO_CORRECTIONS, Corrections
from ..survey.outputs import check_outputs
from ..survey.selection import Selection
from ..tools.ground.step import LabelGround
from ..tools.rasters.output import RasterSize
from .requests import ClassifyRequest, PointRequest, TerrainRequest

# Share of reading in the progress, as the `weight` of steps.
_READING = 1.5


@dataclass(frozen=True)
class Summary:
    """The result of a classification; without an area, all points are in it."""

    point_count: int
    area_count: int
    selected_count: int  # in the area, took part in the filter
    ground_count: int  # of the target class in the output, also outside
    area_ground_count: int  # of the target class in the area
    class_counts: dict[int, int] = field(default_factory=dict)  # in the output, also outside


def classify_cloud(
    cloud: PointCloud,
    parameters: ParameterSet,
    selection: Selection = Selection(),
    progress: Progress = SILENT,
    area: Area | None = None,
    resources: Resources = Resources(),
    corrections: Corrections = NO_CORRECTIONS,
) -> tuple[np.ndarray, np.ndarray]:
    """Return the new class of every point of a cloud, uint8 (n,), and which points in the area took
    part, bool (n,); points outside keep their class, and those near it are context.
    """
    # An error says if no point is left to classify, or the CRS is geographic.
    step = LabelGround(parameters, selection, area, corrections=corrections)
    with may_use(resources.thread_count):
        run = _FileRun(FilePoints(cloud, resources), [step], progress)
        run.work(progress.part(0.0, 0.97))
        result = run.found(progress.part(0.97, 1.0))
        inside, selected, _ = run.steps[0].chooser.choose(cloud, step.counts())
    return result.classification, selected & inside


class _FileRun:
    """Steps that work on the points of one file, one after the other, and rasters, which get their
    names when `outputs` is closed.
    """

    def __init__(
        self,
        points: FilePoints,
        steps: Sequence[Step],
        progress: Progress,
        outputs: Outputs | None = None,
    ) -> None:
        self.steps: list[Any] = located(steps, points.place, progress)  # in the CRS of the points
        self.counts = [step.counts() for step in self.steps]  # by the steps, among the points
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
        points, steps = self.points, list(zip(self.steps[group], self.counts[group]))
        reading = points.sparing(progress.part(0.0, 0.08))
        parts = with_values(points.parts(reading, self._reads_once), self._values)
        stores = points.gathered(steps, parts, progress.part(0.08, 0.12))
        shares = progress.part(0.12, 1.0).shares(*(step.weight for step, _ in steps))
        for (step, _), share in zip(steps, shares):
            self._work_step(step, stores.pop(0), share)

    @property
    def _reads_once(self) -> bool:
        """Whether the points are read only once, as no step gives values or looks at them first."""
        return not any(isinstance(step, PointStep) or step.looks_first for step in self.steps)

    def _work_step(self, step: Any, store: Store, progress: Progress) -> None:
        """Run a step on the points of a store, and let it write its own outputs."""
        working, writing = progress.shares(1.0, step.weight_of_outputs)
        frame = survey_frame(self.points.cloud.crs, step.origin)
        seen = with_values(self.points.parts(), self._values)
        step = step.seeing((part for _, part in seen), frame, progress)
        result = step.work(store, self.points.resources, working)
        if isinstance(step, PointStep):
            self._values.append(StoreValues(step, store))
        else:
            result = [found for _, found in result]
        self.told.append(step.finish(result, frame, self.outputs, writing))

    def found(self, progress: Progress) -> TileResult:
        """Return what the steps found for each point."""
        counts = [
            counted for step, counted in zip(self.steps, self.counts) if isinstance(step, PointStep)
        ]
        result = TileResult(self.points, self._values, counts)
        for where, part in self.points.parts(self.points.sparing(progress)):
            result.add(where, part)
        result.end(progress)
        return result

    def written(self, target: Path, progress: Progress) -> TileResult:
        """Write the points with what the steps found; return that."""
        result = self.found(progress.part(0.0, 0.2))
        result.write(self.outputs.file(target), progress.part(0.2, 1.0))
        return result


@contextlib.contextmanager
def _worked(
    las: LasFile, target: Path, steps: Sequence[Step], resources: Resources, progress: Progress
) -> Iterator[_FileRun]:
    """Yield a run whose steps have worked on a file; its outputs get their names at the end."""
    for_points = [step for step in steps if isinstance(step, PointStep)]
    needs_records = bool(for_points) and not copies_all_else(las, target, for_points)
    reading, working = progress.shares(_READING, sum(step.weight for step in steps))
    with Outputs() as outputs:
        outputs.enter_context(may_use(resources.thread_count))
        points = FilePoints.opened(las, target, resources, needs_records, reading)
        run = _FileRun(outputs.enter_context(points), steps, progress, outputs)
        run.work(working)
        yield run


def classify_file(
    source: Path,
    target: Path,
    request: ClassifyRequest = ClassifyRequest(),
    progress: Progress = SILENT,
) -> Summary:
    """Classify the ground points of a LAS, LAZ or COPC file, and write it with the new classes, and
    nothing else changed but what the request asks for.
    """
    explain = [("raster", request.explain)] if request.explain else []
    check_outputs([("cloud", target), *request.rasters.outputs(), *explain], [source])
    las = open_las(source, request.stated)
    steps: list[Step] = list(request.steps)
    if request.rasters.wanted:
        # Before the heights, since what is known of their points stays in memory.
        before = len(steps) - request.output.height_above_ground
        steps.insert(before, _placed(request.raster_step, las, progress))
    import_early("scipy.ndimage", "scipy.spatial", "scipy.sparse.csgraph")
    with _worked(las, target, steps, request.resources.now(), progress.part(0.0, 0.92)) as run:
        result = run.written(target, progress.part(0.92, 1.0))
    return _summary(result, run.counts[0])


def _placed(step: Step, las: LasFile, progress: Progress) -> Any:
    """Return a step that knows where its cells lie, given the file of the points."""
    crs, box = read_crs(las), las.outer_box if las.states_extent else None
    require_measurable(las.path, crs, box)
    return step.placed(crs, box, progress)


def _summary(result: TileResult, counts: Any) -> Summary:
    """Return the summary of a result, given what was counted among the points before."""
    found, tile = result.results[0], result.summary("")
    return Summary(
        point_count=counts.points,
        area_count=counts.inside,
        selected_count=counts.wanted,
        ground_count=tile.ground_count,
        area_ground_count=found.area_ground_count,
        class_counts=tile.class_counts,
    )


def write_points(
    source: Path | LasFile, target: Path, request: PointRequest, progress: Progress = SILENT
) -> Any:
    """Write a file with the values that a step finds for its points; return the step's summary."""
    las, resources = open_las(source, request.stated), request.resources.now()
    check_outputs([("cloud", target)], [las.path])
    with _worked(las, target, [request.step], resources, progress.part(0.0, 0.9)) as run:
        result = run.written(target, progress.part(0.9, 1.0))
    return result.summary(target.name)


def rasters_of_file(
    source: Path | LasFile, request: TerrainRequest, progress: Progress = SILENT
) -> RasterSize:
    """Write rasters of a classified file with ground; all of them or none."""
    resources, las = request.resources.now(), open_las(source, request.stated)
    beside = next(iter(request.rasters.wanted.values()))
    step = _placed(request.raster_step, las, progress)
    with _worked(las, beside, [step], resources, progress) as run:
        (size,) = run.told
    return size
