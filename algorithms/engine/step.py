"""Steps: what a run can compute from the points of a survey.

A step selects the points that it needs (`marks`) and the blocks in which it works (`blocks`), and
computes a result for each block (`in_block`). It does not deal with files or threads, so it runs on
one file or many, in memory, from disk, and in the jobs of a survey. The result is a value for each
point (`PointStep`), or arrays of blocks from which outputs are made at the end (`Sink`).
"""

from __future__ import annotations

import dataclasses
import hashlib
from collections import Counter
from functools import cached_property
from pathlib import Path
from typing import Any, Callable, ClassVar, Iterable, Mapping, Sequence, TypeVar

import numpy as np

from ..classes.corrections import to_remember
from ..core.files import Outputs
from ..core.parameters import ParameterSet
from ..core.points import Frame
from ..core.progress import SILENT, Progress
from ..las.cloud import PointCloud
from ..las.edits import Edits
from ..las.lasfile import LasFile
from ..survey.area import Area
from ..survey.shapes import Geometry, Place
from .blocks import Blocks, Visit
from .store import Marks
from .summary import TileSummary

# What a step can declare or override, 25 things. First data, which the engine reads at any time:
#
# Step       kind, counts, imports  types of values and counters; modules that load slowly
#            weight                 share of the progress
#            blocks                 how the plane is cut, how far points matter, and the memory
#            area                   where points get values, or rasters have data
# PointStep  changes                what differs in the output
#            summary_type           what a run returns for a file
# Sink       outputs                kinds and paths of the files that it writes
#
# Then the calls in their order, with who calls, with what, and what each gives. Those with * are
# made for each of many files, or once for all of them.
#
# Step.in_crs              file_run, survey_run  where the points lie: the step in their CRS
# PointStep.check_file *   plan             the header of a file: refuses it
# Sink.with_all_points     file_run, sinks  reads all points: the step with what it needs of them
# Step.marks               visits.Work      each part of the points, as earlier steps left it
# Step.report_counts       file_run         what `marks` counted: reports, or refuses the file
# Step.in_block            visits           a `Visit` of a block: values, or arrays
# PointStep.report_blocks  visits           the notes of all blocks: reports, or refuses the points
# Sink.finish              file_run, sinks  the arrays of all blocks: writes `outputs`
# PointStep.result         file_points      a file: its `PointResult`
#   PointResult.add        file_points      each part again, with its values: as it is written
#   PointStep.applied      add, values      a part with its values, as later steps see it
#   PointStep.numbers      add              a part before and after: counts for the summary
#   PointResult.report     file_points      reports on the file, or refuses it
#   PointResult.edits      file_points      what changes in the file apart from classes
#   PointResult.summary    file_points      the numbers of points by class: the summary
# PointStep.report_survey * survey_run      the summaries of all files: reports, or refuses all

_Step = TypeVar("_Step", bound="Step")

# Returns an array of one value for each point of a file, given the type of the values.
Allocate = Callable[[type], np.ndarray]
# Reads all points part by part, with the results of earlier steps.
ReadPoints = Callable[[], Iterable[PointCloud]]
# Metres from the area of a sink up to which blocks are made as well, because the surroundings
# decide which gaps lie inside the survey.
AROUND_AREA = 1000.0

# What can differ in an output from the input: the classes, anything else, and whether there are
# points outside of the area.
CLASSES, MORE, OUTSIDE = "classes", "more", "outside"


@dataclasses.dataclass(frozen=True, eq=False)
class Step:
    """Base of the steps, which are frozen dataclasses of parameters."""

    kind: ClassVar[type] = np.uint8  # of the value that a store holds for each point
    counts: ClassVar[type]  # of the counters that `marks` adds to
    imports: ClassVar[tuple[str, ...]] = ()  # modules that the step needs and that load slowly

    @property
    def weight(self) -> float:
        """The share of the step in the progress."""
        return 3.0

    @property
    def changes(self) -> frozenset[str]:
        """What differs in the output, of `CLASSES`, `MORE` and `OUTSIDE`."""
        return frozenset()

    @property
    def area(self) -> Area | None:
        """Where points get values, or rasters have data; None for everywhere."""
        return None

    @property
    def outputs(self) -> list[tuple[str, Path]]:
        """The kinds and paths of the files that the step writes, apart from points."""
        return []

    @property
    def blocks(self) -> Blocks:
        """The blocks in which the step works."""
        raise NotImplementedError

    @property
    def gives_classes(self) -> bool:
        """Whether the step changes classes, so that later steps must see its result."""
        return CLASSES in self.changes

    def in_crs(self: _Step, place: Place, progress: Progress = SILENT) -> _Step:
        """Return the step for points at a place, or refuse the points."""
        return self

    def marks(self, part: PointCloud, counts: Any) -> Marks:
        """Return the flags of the points of a part and count them; refuse an unsuitable file."""
        raise NotImplementedError

    def report_counts(self, counts: Any, path: Path, progress: Progress) -> None:
        """Report the counts of a file, or refuse a file without points for the step."""

    def in_block(self, visit: Visit, progress: Progress) -> Any:
        """Compute the result of a block."""
        raise NotImplementedError

    @cached_property
    def settings(self) -> dict[str, object]:
        """Everything that the result depends on, as plain values."""
        return {"step": type(self).__name__, **_plain_fields(self)}


def steps_in_crs(steps: Sequence[_Step], place: Place, progress: Progress = SILENT) -> list[_Step]:
    """Return steps for points at a place, with all lines and polygons in its CRS, each transformed
    once; errors are those of `Geometry.located` and of the steps.
    """
    transformed: dict[int, Geometry] = {}
    changed_steps = []
    for step in steps:
        changed: dict[str, Any] = {}
        for name in (field.name for field in dataclasses.fields(step)):
            value = getattr(step, name)
            if isinstance(value, Geometry):
                if id(value) not in transformed:
                    transformed[id(value)] = value.located(place, progress)
                changed[name] = transformed[id(value)]
        step = dataclasses.replace(step, **changed) if changed else step
        changed_steps.append(step.in_crs(place, progress))
    return changed_steps


class PointStep(Step):
    """Base of the steps whose `in_block` returns positions in the store and a value for each, which
    is written into the file, and perhaps a note for `report_blocks`.
    """

    summary_type: type  # a frozen dataclass with `name`, `point_count` and `text`

    @property
    def changes(self) -> frozenset[str]:
        return frozenset({CLASSES})

    def check_file(self, file: LasFile) -> None:
        """Refuse, before any work, a file that cannot hold the result."""

    def report_blocks(self, notes: Sequence[Any], has_known: bool, progress: Progress) -> None:
        """Report the notes of all blocks, given whether any point is known ground, or refuse the
        points.
        """

    def applied(self, part: PointCloud, values: np.ndarray) -> PointCloud:
        """Return points with their values, as later steps see them and as they are written."""
        return part

    def numbers(self, part: PointCloud, after: PointCloud, values: np.ndarray) -> dict[str, int]:
        """Count points of a part, before and after, for fields of the summary."""
        return {}

    def result(self, path: Path, allocate: Allocate) -> PointResult:
        """Return an object that collects the values of a file."""
        return PointResult(self)

    def report_survey(
        self, done: Sequence[Any], empty: Sequence[LasFile], progress: Progress
    ) -> None:
        """Report on all files together, given the summaries of the written files, and the files
        without a point to write; or refuse all.
        """
        if empty:
            progress.info(
                f"{len(empty):,} files are not written: they have no points to write in the area."
            )


class Sink(Step):
    """Base of the steps whose `in_block` returns arrays by name, from which files such as rasters
    are made at the end; arrays of two dimensions wait where the points do.
    """

    def with_all_points(
        self: _Step, read: ReadPoints, frame: Frame, progress: Progress = SILENT
    ) -> _Step:
        """Return the step with parameters that depend on all points, which `read` reads."""
        return self

    def finish(
        self,
        results: Sequence[Mapping[str, Any]],
        frame: Frame,
        outputs: Outputs,
        progress: Progress,
        tiles: Sequence[LasFile] | None = None,
    ) -> Any:
        """Write the files of the property `outputs`, given the arrays of all blocks, and the files
        of a survey; return a summary.
        """
        raise NotImplementedError


class PointResult:
    """What a step found for the points of a file; this class has the `numbers` of the summary,
    which is enough for a step that changes only classes.
    """

    def __init__(self, step: PointStep) -> None:
        self._step: Any = step
        self._numbers = Counter[str]()

    def add(
        self, where: slice, before: PointCloud, values: np.ndarray
    ) -> tuple[PointCloud, np.ndarray | None]:
        """Add the points at `where` in the file and their values, shape (k,); return the points as
        `PointStep.applied` does, and which of them are written, None for all.
        """
        after: PointCloud = self._step.applied(before, values)
        self._numbers.update(point_count=before.count, **self._step.numbers(before, after, values))
        return after, None

    def report(self, progress: Progress, failure: str | None = None) -> None:
        """Report on the only file of a run, or refuse it; or on one of many files, given why parts
        of it have no ground.
        """

    def edits(self, cloud: PointCloud, progress: Progress = SILENT) -> Edits:
        """Return the changes of the file other than classes, or refuse a file that cannot hold
        them; `cloud` has some of its points.
        """
        return Edits()

    def summary(self, name: str, class_counts: dict[int, int]) -> TileSummary:
        """Return the summary of an output, given its name and its number of points by class."""
        return self._step.summary_type(name, **self._numbers, class_counts=class_counts)


def _plain_fields(value: Any) -> dict[str, object]:
    """Return the fields of a dataclass as plain values."""
    names = (field.name for field in dataclasses.fields(value))
    return {name: _plain(getattr(value, name)) for name in names}


def _plain(value: object) -> object:
    """Return a value as it would be read back from JSON."""
    if dataclasses.is_dataclass(value):
        is_set = isinstance(value, ParameterSet)
        name = {"set": type(value).__name__} if is_set else {}
        return {**name, **_plain_fields(value)}
    if isinstance(value, (tuple, list)):
        return [_plain(element) for element in value]
    if isinstance(value, np.ndarray):
        return hashlib.sha256(value.tobytes()).hexdigest()
    return str(value) if isinstance(value, Path) else value


def with_classes(part: PointCloud, classes: np.ndarray, begins: bool = False) -> PointCloud:
    """Return points with other classes, which the file remembers if it has remembered classes
    already, or if `begins`.
    """
    remembered = None
    if begins or part.remembered is not None:
        remembered = to_remember(part, classes)
    return dataclasses.replace(part, classification=classes, remembered=remembered)
