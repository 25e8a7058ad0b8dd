"""Steps: what a run can compute from the points of a survey.

A step selects the points that it needs (`marks`) and the blocks in which it works (`blocks`), and
computes a result for each block (`in_block`). It does not deal with files or threads, so it runs on
one file or many, in memory, from disk, and in the jobs of a survey. The result is a value for each
point (`PointStep`), or results of blocks from which outputs are made at the end (`Sink`).
"""

from __future__ import annotations

import dataclasses
import hashlib
from collections import Counter
from functools import cached_property
from pathlib import Path
from typing import Any, BinaryIO, Callable, ClassVar, Iterable, Sequence, TypeVar

import numpy as np

from ..classes.corrections import to_remember
from ..core.files import Outputs
from ..core.parameters import ParameterSet
from ..core.points import Box, Frame
from ..core.progress import SILENT, Progress
from ..las.cloud import PointCloud
from ..las.edits import Edits
from ..las.lasfile import LasFile
from ..survey.shapes import Geometry, Place
from .block_grid import BlockGrid, BlockIndex
from .blocks import Blocks, PlaneBlock, Visit
from .store import Marks, Store
from .summary import TileSummary

# The calls in their order; * marks those of a survey of many files, + those of `PointStep`, and #
# those of `Sink`. The properties `blocks`, `origin`, `outputs`, `weight`, `gives_classes`,
# `only_classes` and `writes_all` are read before.
#
# call                 by               with, and what it gives
# check_survey *       survey_run       the extent and all steps: refuses what cannot be done
# skips, is_far *+     plan             the header of a file: whether it is left out
# check_tile *+        plan             the header of a file: refuses it
# placed               file_run, rows   CRS and extent: the step in that CRS
# marks                visits.Work      each part of the points, as earlier steps left it: `Marks`
# tell                 file_run         the counts of `marks`: reports, or refuses the file
# with_all_points      file_run, sinks  a function that reads all points: the step with what follows
# wanted *#            sinks            the blocks with points: those that are worked on
# in_block             visits           a `Visit` of a block: its result
# keep                 visits           the result of a block: what is not in the store
# end                  visits           what `keep` gave for all blocks: the result of the step
# save, load *#        jobs, sinks      the results of a block to a file, and from it
# finish               file_run, sinks  the result: writes `outputs`, gives a summary
# result +             file_points      a file: its `PointResult`
#   applied, add       file_points      each part again, with its values: classes and counts
#   check *, tell      file_points      report on the file
#   kept, edits        file_points      which points are written, and what changes but classes
#   summary            file_points      the numbers of points by class: the summary of the file
# tell_of_survey *+    survey_run       the summaries of all files: reports on them

_Step = TypeVar("_Step", bound="Step")

# Returns an array of one value for each point of a file, given the type of the values.
Allocate = Callable[[type], np.ndarray]
# Reads all points part by part, with the results of earlier steps.
ReadPoints = Callable[[], Iterable[PointCloud]]


@dataclasses.dataclass(frozen=True, eq=False)
class Step:
    """Base of the steps, which are frozen dataclasses of parameters."""

    kind: ClassVar[type] = np.uint8  # of the value that a store holds for each point
    counts: ClassVar[type]  # of the counters that `marks` adds to
    imports: ClassVar[tuple[str, ...]] = ()  # modules that the step needs and that load slowly
    weight_of_outputs = 0.0  # in the progress, as a share of `weight`

    @property
    def weight(self) -> float:
        """The share of the step in the progress."""
        return 3.0

    @property
    def gives_classes(self) -> bool:
        """Whether the step changes classes, so that later steps must see its result."""
        return False

    @property
    def writes_all(self) -> bool:
        """Whether the output has all points."""
        return True

    @property
    def reads_all_first(self) -> bool:
        """Whether `with_all_points` reads them."""
        return False

    @property
    def outputs(self) -> list[tuple[str, Path]]:
        """The kinds and paths of the files that the step writes, apart from points."""
        return []

    @property
    def origin(self) -> tuple[float, float]:
        """The origin of the frame in which the step works, in units of the CRS."""
        return 0.0, 0.0

    @property
    def blocks(self) -> Blocks:
        """The blocks in which the step works."""
        raise NotImplementedError

    def placed(self: _Step, place: Place, progress: Progress = SILENT) -> _Step:
        """Return the step for points at a place."""
        return self

    def check_survey(self, box: Box, steps: Sequence[Step]) -> None:
        """Refuse, before any work, a survey of many files whose extent (in units of the CRS) is
        unsuitable, or an output that these steps cannot make of many files.
        """

    def with_all_points(
        self: _Step, read: ReadPoints, frame: Frame, progress: Progress = SILENT
    ) -> _Step:
        """Return the step with parameters that depend on all points, which `read` reads."""
        return self

    def marks(self, part: PointCloud, counts: Any) -> Marks:
        """Return the flags of the points of a part and count them; refuse an unsuitable file."""
        raise NotImplementedError

    def tell(self, counts: Any, path: Path, progress: Progress) -> None:
        """Report the counts of a file, or refuse a file without points for the step."""

    def in_block(self, visit: Visit, progress: Progress) -> object:
        """Compute the result of a block."""
        raise NotImplementedError

    def keep(self, store: Store, result: Any) -> object:
        """Put the large part of the result of a block into the store, and return the rest."""
        return result

    def end(
        self, store: Store, results: Sequence[tuple[PlaneBlock, Any]], progress: Progress
    ) -> Any:
        """Return the result of all blocks, given what `keep` returned for each."""
        return results

    def finish(
        self,
        result: Any,
        frame: Frame,
        outputs: Outputs,
        progress: Progress,
        tiles: Sequence[LasFile] | None = None,
    ) -> Any:
        """Write the files of the property `outputs`, given the result of `end`, and the files of a
        survey; return a summary.
        """

    @cached_property
    def settings(self) -> dict[str, object]:
        """Everything that the result depends on, as plain values."""
        return {"step": type(self).__name__, **_plain_fields(self)}


def placed(steps: Sequence[_Step], place: Place, progress: Progress = SILENT) -> list[_Step]:
    """Return steps for points at a place, with all lines and polygons in its CRS, each transformed
    once; errors are those of `Geometry.located` and of the steps.
    """
    transformed: dict[int, Geometry] = {}
    placed_steps = []
    for step in steps:
        changed: dict[str, Any] = {}
        for name in (field.name for field in dataclasses.fields(step)):
            value = getattr(step, name)
            if isinstance(value, Geometry):
                if id(value) not in transformed:
                    transformed[id(value)] = value.located(place, progress)
                changed[name] = transformed[id(value)]
        step = dataclasses.replace(step, **changed) if changed else step
        placed_steps.append(step.placed(place, progress))
    return placed_steps


class PointStep(Step):
    """Base of the steps that compute a value for each point, which is written into the file."""

    summary_type: type  # a frozen dataclass with `name`, `point_count` and `text`

    @property
    def gives_classes(self) -> bool:
        """Whether the step changes classes."""
        return True

    @property
    def only_classes(self) -> bool:
        """Whether the step changes only classes."""
        return self.gives_classes

    def keep(self, store: Store, result: Sequence[Any]) -> object:
        """Store positions and values, the first two parts of the result of a block."""
        positions, values, *more = result
        store.put(positions, values)
        return more

    def applied(self, part: PointCloud, values: np.ndarray) -> PointCloud:
        """Return points with their values, as later steps see them and as they are written."""
        return part

    def check_tile(self, tile: LasFile) -> None:
        """Refuse, before any work, a file that cannot hold the result."""

    def skips(self, tile: LasFile) -> bool:
        """Return whether the header of a file shows that none of its points is to be written."""
        return False

    @property
    def shows_more(self) -> bool:
        """Whether later steps see results that are not written."""
        return False

    def is_far(self, tile: LasFile) -> bool:
        """Return whether the header of a file shows that none of its points gets a value."""
        return self.skips(tile)

    def tell_of_survey(
        self, done: Sequence[Any], empty: Sequence[LasFile], progress: Progress
    ) -> None:
        """Report on all files together, given the summaries of those that were written, and those
        without a point to write; or refuse all of them.
        """
        if empty:
            progress.info(
                f"{len(empty):,} files are not written: they have no points to write in the area."
            )

    def numbers(self, part: PointCloud, after: PointCloud, values: np.ndarray) -> dict[str, int]:
        """Count points of a part, before and after, for fields of the summary."""
        return {}

    def result(self, path: Path, allocate: Allocate) -> PointResult:
        """Return an object that collects the values of a file."""
        return PointResult(self)


class Sink(Step):
    """Base of the steps whose results of blocks go into files of their own, such as rasters."""

    title = "outputs"  # what the step makes, for messages
    weight_of_outputs = 0.25

    def wanted(self, places: Sequence[BlockIndex], grid: BlockGrid) -> Sequence[BlockIndex]:
        """Return the blocks that the outputs need, at least one."""
        return places

    def save(self, results: Sequence[Any], stream: BinaryIO) -> None:
        """Write the results of a block, or of its parts, for `load`."""
        raise NotImplementedError

    def load(self, file: Path) -> Iterable[Any]:
        """Return the results that `save` wrote."""
        raise NotImplementedError


class PointResult:
    """What a step found for the points of a file; this class has the `numbers` of the summary,
    which is enough for a step that changes only classes.
    """

    kept: np.ndarray | None = None  # bool, (n,): which points are written; None for all

    def __init__(self, step: PointStep) -> None:
        self._step: Any = step
        self._numbers = Counter[str]()

    @property
    def is_empty(self) -> bool:
        """Whether no point is to be written."""
        return False

    def applied(self, part: PointCloud, values: np.ndarray) -> PointCloud:
        """Return the next points with their values, as `PointStep.applied` does."""
        after: PointCloud = self._step.applied(part, values)
        return after

    def add(self, where: slice, before: PointCloud, after: PointCloud, values: np.ndarray) -> None:
        """Add the values, shape (k,), of the points at `where` in the file, given as they were
        before, and after `applied`.
        """
        self._numbers.update(point_count=before.count, **self._step.numbers(before, after, values))

    def check(self, progress: Progress, why: str = "") -> None:
        """Report on one of many files; `why` is the reason if parts of it have no ground."""

    def tell(self, progress: Progress) -> None:
        """Report what was found in a file."""

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
    """Return points with other classes; these are remembered in the file if it has remembered
    classes already, or if `begins`.
    """
    remembered = None
    if begins or part.remembered is not None:
        remembered = to_remember(part, classes)
    return dataclasses.replace(part, classification=classes, remembered=remembered)
