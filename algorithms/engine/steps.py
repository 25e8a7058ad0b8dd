"""What a run can make of the points of a survey.

A step says which points it needs (`marks`), how far they matter (`blocks`), and what it makes of
those that wait in a store (`work`). It knows neither files nor threads: it runs on one file or on
many, in memory, from disk, and in the jobs of a survey.
"""

from __future__ import annotations

import dataclasses
import hashlib
from pathlib import Path
from typing import Any, Callable, NamedTuple, Sequence

import numpy as np

from ..core.parameters import ParameterSet
from ..core.points import Box
from ..core.progress import SILENT, Progress
from ..las.cloud import PointCloud
from ..las.edits import Edits
from ..las.lasfile import LasFile
from .blocks import Blocks, Store
from .memory import Resources

# Makes room for one value of each point of a file, given its type.
Room = Callable[[type], np.ndarray]


class Marks(NamedTuple):
    """What a step wants to know of points, boolean arrays of shape (n,).

    Attributes
    ----------
    selected : numpy.ndarray
        Which take part.
    known : numpy.ndarray
        Which of them are surely ground.
    wanted : numpy.ndarray
        For which of them something is wanted; the others are context.
    """

    selected: np.ndarray
    known: np.ndarray
    wanted: np.ndarray


class Step:
    """Base of the steps, which are frozen dataclasses of what the user chose.

    Attributes
    ----------
    kind : type
        Of the value that a store keeps of each point.
    tally : type
        Of what `marks` counts in.
    """

    kind: type = np.uint8
    tally: type

    @property
    def blocks(self) -> Blocks:
        """The blocks in which it works."""
        raise NotImplementedError

    def marks(self, part: PointCloud, tally: Any) -> Marks:
        """Return which points of a part of a file are needed, and count them.

        Raises
        ------
        BareEarthError
            If the file does not do.
        """
        raise NotImplementedError

    def tell(self, tally: Any, path: Path, progress: Progress) -> None:
        """Tell what was counted in a file.

        Raises
        ------
        BareEarthError
            If there is nothing to do.
        """

    def work(self, store: Store, resources: Resources, progress: Progress) -> Any:
        """Make something of the points of a store."""
        raise NotImplementedError

    def settings(self) -> dict[str, Any]:
        """Return all that the result depends on, as plain values."""
        return {"step": type(self).__name__, **_plain(self)}


class PointStep(Step):
    """Base of the steps that find a value of each point, and write it into its file.

    Attributes
    ----------
    summary_type : type
        Of the summaries of its results: a frozen dataclass with `name`, `point_count` and `text`.
    vpc_name : str
        Name of the virtual point cloud of the results.
    """

    summary_type: type
    vpc_name: str

    def check_tile(self, tile: LasFile) -> None:
        """Refuse, before any work, a file that cannot hold what is found."""

    def check_survey(self, box: Box) -> None:
        """Refuse, before any work, files whose points have these bounds in units of the CRS."""

    def skips(self, tile: LasFile) -> bool:
        """Return whether nothing of a file is to be written, as its header says."""
        return False

    def count(self, part: PointCloud, tally: Any) -> None:
        """Count what `tell_of_tile` tells of the points of one of many files."""

    def tell_of_tile(self, tally: Any, path: Path, progress: Progress) -> None:
        """Tell what was counted in one of many files, or refuse it."""

    def tell_of_survey(self, done: Sequence[Any], progress: Progress) -> None:
        """Tell what is to be said of all files together, given their summaries."""

    def result(self, path: Path, room: Room) -> PointResult:
        """Return what takes in the values of a file."""
        raise NotImplementedError


class PointResult:
    """What was found of the points of a file."""

    @property
    def is_empty(self) -> bool:
        """Whether nothing of them is to be written."""
        return False

    def add(self, where: slice, part: PointCloud, values: np.ndarray) -> None:
        """Take in the values of some points.

        Parameters
        ----------
        where : slice
            Where they stand in the file.
        part : PointCloud
            The points.
        values : numpy.ndarray, shape (k,)
            What the step found of each.
        """
        raise NotImplementedError

    def part(self, where: slice, part: PointCloud) -> PointCloud:
        """Return some points as they are now."""
        return part

    def check(self, why: str = "") -> None:
        """Refuse to write a file of which nothing was found; `why` says why, if that is known."""

    def edits(self, cloud: PointCloud, progress: Progress = SILENT) -> Edits:
        """Return what becomes other in the file, given any of its points."""
        raise NotImplementedError

    def summary(self, name: str) -> Any:
        """Return what became of the file of this name, as the step's `summary_type`."""
        raise NotImplementedError


def _plain(value: Any) -> Any:
    """Return a value as JSON would give it back."""
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
