"""Steps: what a run can compute from the points of a survey.

A step chooses the points that it needs (`marks`) and the blocks in which it works (`blocks`), and
computes its result from the points in a store (`work`). It knows neither files nor threads. So it
runs on one file or many, in memory, from disk, and in the jobs of a survey.
"""

from __future__ import annotations

import dataclasses
import hashlib
from functools import cached_property
from pathlib import Path
from typing import Any, Callable, Sequence

import numpy as np

from ..core.parameters import ParameterSet
from ..core.points import Box
from ..core.progress import SILENT, Progress
from ..las.cloud import PointCloud
from ..las.edits import Edits
from ..las.extrabytes import REMEMBERED, ExtraDimension
from ..las.lasfile import LasFile
from ..survey.corrections import to_remember
from ..survey.shapes import Geometry, Place
from .blocks import Blocks
from .memory import Resources
from .store import Marks, Store

# Returns an array of one value for each point of a file, given the type of the values.
Allocate = Callable[[type], np.ndarray]


class Step:
    """Base of the steps, which are frozen dataclasses of parameters.

    Attributes
    ----------
    kind : type
        Type of the value that a store holds for each point.
    counts : type
        Type of the counters that `marks` adds to.
    """

    kind: type = np.uint8
    counts: type

    @property
    def origin(self) -> tuple[float, float]:
        """The origin of the frame in which the step works, in units of the CRS."""
        return 0.0, 0.0

    @property
    def blocks(self) -> Blocks:
        """The blocks in which the step works."""
        raise NotImplementedError

    def marks(self, part: PointCloud, counts: Any) -> Marks:
        """Return the flags of the points of a part of a file, and count them.

        Raises
        ------
        BareEarthError
            If the file is unsuitable.
        """
        raise NotImplementedError

    def tell(self, counts: Any, path: Path, progress: Progress) -> None:
        """Report what was counted in a file.

        Raises
        ------
        BareEarthError
            If the step has nothing to do.
        """

    def work(self, store: Store, resources: Resources, progress: Progress) -> Any:
        """Compute the result from the points of a store."""
        raise NotImplementedError

    @cached_property
    def settings(self) -> dict[str, Any]:
        """Return everything that the result depends on, as plain values."""
        return {"step": type(self).__name__, **_plain(self)}


def located(steps: Sequence[Any], place: Place, progress: Progress = SILENT) -> list[Any]:
    """Return steps whose lines and polygons are in the CRS of the points.

    Parameters
    ----------
    steps : sequence of Step
        Steps that may share an area or other geometry, which is transformed once.
    place : Place
        Where the points lie.
    progress : Progress
        Receives messages.

    Raises
    ------
    BareEarthError
        As for `Geometry.located`.
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
        found.append(dataclasses.replace(step, **changed) if changed else step)
    return found


class PointStep(Step):
    """Base of the steps that find a value for each point, and write it into the file.

    Attributes
    ----------
    summary_type : type
        Type of its summaries: a frozen dataclass with `name`, `point_count` and `text`.
    vpc_name : str
        Name of the virtual point cloud of the results.
    """

    summary_type: type
    vpc_name: str

    def check_tile(self, tile: LasFile) -> None:
        """Refuse, before any work, a file that cannot hold the result."""

    def check_survey(self, box: Box) -> None:
        """Refuse, before any work, a survey with an unsuitable extent, in units of the CRS."""

    def skips(self, tile: LasFile) -> bool:
        """Return whether no point of a file is to be written, according to its header."""
        return False

    def count(self, part: PointCloud, counts: Any) -> None:
        """Count points of one of many files for `tell_of_tile`."""

    def tell_of_tile(self, counts: Any, path: Path, progress: Progress) -> None:
        """Report what was counted in one of many files, or refuse the file."""

    def tell_of_survey(self, done: Sequence[Any], progress: Progress) -> None:
        """Report on all files together, given their summaries."""

    def result(self, path: Path, allocate: Allocate) -> PointResult:
        """Return an object that collects the values of a file."""
        raise NotImplementedError


class CountedClasses:
    """Base of summaries, which are frozen dataclasses, with the number of points of each class."""

    class_counts: dict[int, int]

    def __post_init__(self) -> None:
        # The keys of the JSON record are strings.
        counts = {int(value): count for value, count in self.class_counts.items()}
        object.__setattr__(self, "class_counts", counts)


class PointResult:
    """The values of the points of a file."""

    @property
    def is_empty(self) -> bool:
        """Whether no point is to be written."""
        return False

    def add(self, where: slice, part: PointCloud, values: np.ndarray) -> None:
        """Add the values of some points.

        Parameters
        ----------
        where : slice
            Their indices in the file.
        part : PointCloud
            The points.
        values : numpy.ndarray, shape (k,)
            Their values.
        """
        raise NotImplementedError

    def part(self, where: slice, part: PointCloud) -> PointCloud:
        """Return points as the output will have them."""
        return part

    def check(self, why: str = "") -> None:
        """Refuse to write a file without a result; `why` is the reason, if it is known."""

    def edits(self, cloud: PointCloud, progress: Progress = SILENT) -> Edits:
        """Return the changes of the file; `cloud` holds any of its points."""
        raise NotImplementedError

    def summary(self, name: str) -> Any:
        """Return the summary of the output `name`, as the step's `summary_type`."""
        raise NotImplementedError


def _plain(value: Any) -> Any:
    """Return a value as it would be read back from JSON."""
    if dataclasses.is_dataclass(value):
        names = [field.name for field in dataclasses.fields(value)]
        plain = {name: _plain(getattr(value, name)) for name in names}
        is_set = isinstance(value, ParameterSet)
        return {"set": type(value).__name__, **plain} if is_set else plain
    if isinstance(value, (tuple, list)):
        return [_plain(each) for each in value]
    if isinstance(value, np.ndarray):
        return hashlib.sha256(value.tobytes()).hexdigest()
    return str(value) if isinstance(value, Path) else value


class RememberedClasses:
    """The classes of a file that are to be remembered.

    Parameters
    ----------
    allocate : callable
        Returns an array of one value for each point.
    begins : bool
        Whether classes are remembered even if the file has none remembered yet.
    """

    def __init__(self, allocate: Allocate, begins: bool = False) -> None:
        self._allocate, self._begins = allocate, begins
        self._values: np.ndarray | None = None

    def add(self, where: slice, part: PointCloud, classes: np.ndarray) -> None:
        """Add the new classes of some points."""
        if self._begins or part.remembered is not None:
            if self._values is None:
                self._values = self._allocate(np.uint8)
            self._values[where] = to_remember(part, classes)

    def part(self, where: slice, part: PointCloud) -> PointCloud:
        """Return points as they will be read back."""
        if self._values is None:
            return part
        return dataclasses.replace(part, remembered=self._values[where])

    def added_to(self, edits: Edits) -> Edits:
        """Return edits with the remembered classes."""
        if self._values is None:
            return edits
        dimension = ExtraDimension(REMEMBERED, "Before changes by hand", self._values)
        return dataclasses.replace(edits, remembered=dimension)
