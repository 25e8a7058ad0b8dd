"""The output of one file: its points with all that the steps of a run found."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Any, Sequence

import numpy as np

from ..core.progress import SILENT, Progress
from ..las.cloud import PointCloud
from ..las.edits import Edits
from ..las.extrabytes import REMEMBERED, ExtraDimension, remembers
from ..las.lasfile import LasFile
from ..las.writing import layers_kept, write_changed
from ..survey.point_counts import by_class, count_classes
from .file_points import FilePoints
from .step import PointStep
from .values import PointValues


def copies_all_else(las: LasFile, target: Path, steps: Sequence[PointStep]) -> bool:
    """Return whether only the layers of classes are written anew, and all other bytes copied."""
    if remembers(las) or not all(step.only_classes for step in steps):
        return False
    return layers_kept(las, target) is not None


class TileResult:
    """What the steps of a run found for the points of a file, in the order of the steps."""

    def __init__(self, points: FilePoints, values: Sequence[PointValues]) -> None:
        self._points, self._values = points, values
        steps = [found.step for found in values]
        # what each step found beside the classes
        self.results = [step.result(points.path, points.allocate) for step in steps]
        self.classification: np.ndarray | None = None
        if any(step.gives_classes for step in steps):
            self.classification = points.allocate(np.uint8)
        self._remembered: np.ndarray | None = None
        # int64, (256,): points of each class in the output
        self.class_counts = np.zeros(256, dtype=np.int64)

    def add(self, where: slice, part: PointCloud) -> None:
        """Add the next points of the file."""
        for result, found in zip(self.results, self._values):
            part = result.add(where, part, found.of(where, part))
        if self.classification is not None:
            self.classification[where] = part.classification
            if part.remembered is not None:
                if self._remembered is None:
                    self._remembered = self._points.allocate(np.uint8)
                self._remembered[where] = part.remembered
        classes, kept = part.classification, self.results[0].kept
        self.class_counts += count_classes(classes if kept is None else classes[kept[where]])

    def check(self) -> None:
        """Refuse a file without a result, with the reason."""
        for result, found in zip(self.results, self._values):
            result.check(found.failure)

    @property
    def is_empty(self) -> bool:
        """Whether no point is to be written."""
        return self.results[0].is_empty

    def edits(self, progress: Progress = SILENT) -> Edits:
        """Return all changes of the file, or refuse a file that cannot hold them."""
        edits = Edits(classification=self.classification)
        if self._remembered is not None:
            dimension = ExtraDimension(REMEMBERED, "Before changes by hand", self._remembered)
            edits = dataclasses.replace(edits, remembered=dimension)
        for result in self.results:
            found = vars(result.edits(self._points.cloud, progress))
            given = {name: value for name, value in found.items() if value is not None}
            edits = dataclasses.replace(edits, **given)
        return edits

    def write(self, target: Path, progress: Progress) -> None:
        """Write the output."""
        points, edits = self._points, self.edits(progress)
        progress = points.sparing(progress)
        write_changed(points.file, target, edits, progress, points.cloud, points.memory_left)

    def summary(self, name: str) -> Any:
        """Return the summary of the output `name`, that of the first step."""
        return self.results[0].summary(name, by_class(self.class_counts))
