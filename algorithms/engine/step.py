"""Steps: what a run can compute from the points of a survey.

A step chooses the points that it needs (`marks`) and the blocks in which it works (`blocks`), and
computes its result in each of them (`in_block`). It knows neither files nor threads. So it
runs on one file or many, in memory, from disk, and in the jobs of a survey. What it finds is a
value for each point (`PointStep`), or stays by block until outputs are made of it (`Sink`).
"""

from __future__ import annotations

import dataclasses
import hashlib
from collections import Counter
from functools import cached_property
from pathlib import Path
from typing import Any, BinaryIO, Callable, Iterable, Sequence

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
from .blocks import Block, Blocks
from .store import Marks, Store
from .visits import Visit

# Returns an array of one value for each point of a file, given the type of the values.
Allocate = Callable[[type], np.ndarray]
# Reads all points part by part, with what earlier steps found for them.
Look = Callable[[], Iterable[PointCloud]]


class Step:
    """Base of the steps, which are frozen dataclasses of parameters."""

    kind: type = np.uint8  # of the value that a store holds for each point
    counts: type  # of the counters that `marks` adds to
    imports: tuple[str, ...] = ()  # modules that it needs, which take time to load
    weight_of_outputs = 0.0  # in the progress, as a share of `weight`

    @property
    def weight(self) -> float:
        """Its share of the progress."""
        return 3.0

    @property
    def gives_classes(self) -> bool:
        """Whether it changes classes, so that later steps must see its result."""
        return False

    @property
    def writes_all(self) -> bool:
        """Whether it leaves no point out of the output."""
        return True

    @property
    def looks_first(self) -> bool:
        """Whether `seeing` reads the points."""
        return False

    @property
    def outputs(self) -> list[tuple[str, Path]]:
        """The kinds and paths of the files that it writes beside points."""
        return []

    @property
    def origin(self) -> tuple[float, float]:
        """The origin of the frame in which the step works, in units of the CRS."""
        return 0.0, 0.0

    @property
    def blocks(self) -> Blocks:
        """The blocks in which the step works."""
        raise NotImplementedError

    def placed(self, place: Place, progress: Progress = SILENT) -> Any:
        """Return the step for points at a place."""
        return self

    def check_survey(self, box: Box, steps: Sequence[Step]) -> None:
        """Refuse, before any work, a survey of many files with an unsuitable extent, in units of
        the CRS, or what such a run of these steps cannot make.
        """

    def seeing(self, look: Look, frame: Frame, progress: Progress = SILENT) -> Any:
        """Return the step after a look at all points, with what was found for them."""
        return self

    def marks(self, part: PointCloud, counts: Any) -> Marks:
        """Return the flags of points of a part of a file and count them, or refuse the file."""
        raise NotImplementedError

    def tell(self, counts: Any, path: Path, progress: Progress) -> None:
        """Report what was counted in a file, or refuse it if the step has nothing to do."""

    def in_block(self, visit: Visit, progress: Progress) -> Any:
        """Return what the step finds in a block."""
        raise NotImplementedError

    def keep(self, store: Store, result: Any) -> Any:
        """Store the result of a block; return what stays in memory until all blocks are done."""
        return result

    def end(self, store: Store, results: Sequence[tuple[Block, Any]], progress: Progress) -> Any:
        """Return the result, given what stayed of each block."""
        return results

    def finish(
        self,
        result: Any,
        frame: Frame,
        outputs: Outputs,
        progress: Progress,
        tiles: Sequence[LasFile] | None = None,
    ) -> Any:
        """Write what `outputs` named, given the result of `end` and the files of a survey; return
        what to tell of it.
        """

    @cached_property
    def settings(self) -> dict[str, Any]:
        """Return everything that the result depends on, as plain values."""
        return {"step": type(self).__name__, **_plain(self)}


def placed(steps: Sequence[Any], place: Place, progress: Progress = SILENT) -> list[Any]:
    """Return steps for points at a place, with all lines and polygons in its CRS, each transformed
    once; errors are those of `Geometry.located` and of the steps.
    """
    known: dict[int, Geometry] = {}
    found = []
    for step in steps:
        changed = {}
        for name in (field.name for field in dataclasses.fields(step)):
            value = getattr(step, name)
            if isinstance(value, Geometry):
                if id(value) not in known:
                    known[id(value)] = value.located(place, progress)
                changed[name] = known[id(value)]
        step = dataclasses.replace(step, **changed) if changed else step
        found.append(step.placed(place, progress))
    return found


class PointStep(Step):
    """Base of the steps that find a value for each point, and write it into the file."""

    summary_type: type  # a frozen dataclass with `name`, `point_count` and `text`

    @property
    def gives_classes(self) -> bool:
        """Whether it changes classes."""
        return True

    @property
    def only_classes(self) -> bool:
        """Whether it changes nothing but classes."""
        return self.gives_classes

    def keep(self, store: Store, result: Sequence[Any]) -> Any:
        """Store the values of a block, of which there are positions and values, and maybe more."""
        positions, values, *more = result
        store.put(positions, values)
        return more

    def applied(self, part: PointCloud, values: np.ndarray) -> PointCloud:
        """Return points with their values, as further steps and the output have them."""
        return part

    def check_tile(self, tile: LasFile) -> None:
        """Refuse, before any work, a file that cannot hold the result."""

    def skips(self, tile: LasFile) -> bool:
        """Return whether no point of a file is to be written, according to its header."""
        return False

    def tell_of_survey(self, done: Sequence[Any], progress: Progress) -> None:
        """Report on all files together, given their summaries."""

    def numbers(self, part: PointCloud, after: PointCloud, values: np.ndarray) -> dict[str, int]:
        """Return numbers of points of a part, before and after, that the summary has."""
        return {}

    def result(self, path: Path, allocate: Allocate) -> PointResult:
        """Return an object that collects the values of a file."""
        return PointResult(self)


class Sink(Step):
    """Base of the steps whose result is of blocks, and goes into files of its own."""

    title = "outputs"  # what it makes, for messages
    weight_of_outputs = 0.25

    def wanted(self, places: Sequence[BlockIndex], grid: BlockGrid) -> Sequence[BlockIndex]:
        """Return those of the blocks with points that matter, at least one."""
        return places

    def save(self, results: Sequence[Any], stream: BinaryIO) -> None:
        """Write the results of a block, or of its parts, for `load`."""
        raise NotImplementedError

    def load(self, file: Path) -> Iterable[Any]:
        """Return the results that `save` wrote."""
        raise NotImplementedError


class PointResult:
    """What a step found for the points of a file: here the `numbers` of its summary, as of a step
    that changes only classes.
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
        """Return the next points with their values, as the step does."""
        after: PointCloud = self._step.applied(part, values)
        return after

    def add(self, where: slice, before: PointCloud, after: PointCloud, values: np.ndarray) -> None:
        """Add the values, shape (k,), of the points at `where` in the file, given without them and
        as `applied` has just returned them.
        """
        self._numbers.update(point_count=before.count, **self._step.numbers(before, after, values))

    def check(self, progress: Progress, why: str = "") -> None:
        """Refuse one of many files, whose own points no step has told of, without a result; `why`
        is the reason, if it is known.
        """

    def tell(self, progress: Progress) -> None:
        """Report what was found in a file."""

    def edits(self, cloud: PointCloud, progress: Progress = SILENT) -> Edits:
        """Return the changes of the file beside the classes, or refuse a file that cannot hold
        them; `cloud` holds any of its points.
        """
        return Edits()

    def summary(self, name: str, class_counts: dict[int, int]) -> Any:
        """Return the summary of an output with points of each class, as `summary_type`."""
        return self._step.summary_type(name, **self._numbers, class_counts=class_counts)


def _plain(value: Any) -> Any:
    """Return a value as it would be read back from JSON."""
    if dataclasses.is_dataclass(value):
        names = [field.name for field in dataclasses.fields(value)]
        plain = {name: _plain(getattr(value, name)) for name in names}
        is_set = isinstance(value, ParameterSet)
        return {"set": type(value).__name__, **plain} if is_set else plain
    if isinstance(value, (tuple, list)):
        return [_plain(element) for element in value]
    if isinstance(value, np.ndarray):
        return hashlib.sha256(value.tobytes()).hexdigest()
    return str(value) if isinstance(value, Path) else value


def with_classes(part: PointCloud, classes: np.ndarray, begins: bool = False) -> PointCloud:
    """Return points with other classes, remembered if the file remembers classes or `begins` to."""
    remembered = None
    if begins or part.remembered is not None:
        remembered = to_remember(part, classes)
    return dataclasses.replace(part, classification=classes, remembered=remembered)
