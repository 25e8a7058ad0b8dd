"""Ground points of a classified cloud."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Sequence

import numpy as np

from ..core.errors import BareEarthError
from ..core.parameters import ParameterSet, parameter, parameter_of
from ..core.progress import Progress
from ..las.cloud import PointCloud
from .kept_classes import reserved, used
from .point_counts import count_classes
from .selection import Selection
from .without_ground import WithoutGround, refuse_groundless, report_groundless

# The flag of points of rails and roads, which count as ground if they lie on it.
ROADS_FLAG = "roads"


@dataclass
class GroundCounts:
    """Counts of the parts of a file so far."""

    ground: int = 0  # ground points
    # int64 (256,), points of each class.
    classes: np.ndarray = field(default_factory=lambda: np.zeros(256, dtype=np.int64))


@dataclass(frozen=True)
class GroundClasses(ParameterSet):
    """Which points of a classified cloud are ground."""

    ground_classes: tuple[int, ...] = parameter(
        (2,),
        label="Ground classes",
        minimum=0,
        maximum=255,
        help="Classes of the points that are ground. Add 8 if model key points have that class,"
        " 10 and 11 for rails and roads that lie on the ground, and 9 if water counts as ground."
        " Withheld points are not used.",
    )
    overlap: str = parameter_of(
        Selection,
        "overlap",
        help="Points in the overlap of flight strips, by their flag in LAS 1.4, or by class 12 in"
        " older files. If strips do not fit together, leave them out of ground and surface.",
        choices={"use": "Use as others", "leave-out": "Leave out"},
    )

    @classmethod
    def of_selection(cls, selection: Selection) -> GroundClasses:
        """Return which points are ground that were classified with a selection."""
        known = selection.seed_classes or ()
        return cls(tuple(dict.fromkeys((selection.to_class, *known))), selection.overlap)

    def of(self, part: PointCloud, counts: GroundCounts, also: tuple[int, ...] = ()) -> np.ndarray:
        """Return which points are ground, and count them."""
        part.require_projected()
        if not self.ground_classes:
            raise BareEarthError("Choose at least one ground class.")
        ground = self.points_of(part, (*self.ground_classes, *also))
        counts.ground += int(np.count_nonzero(ground))
        counts.classes += count_classes(part.classification)
        return ground

    def points_of(self, part: PointCloud, classes: Sequence[int]) -> np.ndarray:
        """Return which points of some classes are used; boolean, shape (n,)."""
        if not classes:
            return np.zeros(part.count, dtype=bool)
        return np.isin(part.classification, classes) & self.used(part)

    def roads_of(self, part: PointCloud, roads: Sequence[int]) -> np.ndarray:
        """Return which points are of roads and rails; none where the point format reserves these
        classes.
        """
        return self.points_of(part, roads) & ~reserved(part)

    def used(self, part: PointCloud) -> np.ndarray:
        """Return which points are used, of any class; boolean, shape (n,)."""
        return used(part, self.overlap)

    def check(self, counts: GroundCounts, path: Path | str, has: str = "has") -> None:
        """Refuse a file without ground, or files, which "have" none."""
        if counts.ground:
            return
        if counts.classes[list(self.ground_classes)].any():
            why = "withheld. Clear that flag first."
            if self.overlap == "leave-out":
                why = "withheld or points of overlap. Use points of overlap, too."
            raise BareEarthError(f"All ground points of {path} (class {self._wanted}) are {why}")
        classes = np.flatnonzero(counts.classes)
        present = ("classes " if classes[1:].size else "class ") + ", ".join(map(str, classes))
        raise BareEarthError(
            f"{path} {has} no ground points: none is of class {self._wanted}, all are of"
            f" {present}. Classify its ground first, or choose other ground classes."
        )

    def report_survey(self, files: Sequence[tuple[int, WithoutGround]], progress: Progress) -> None:
        """Warn of files without ground, given how many ground points each has; refuse them if no
        file has any.
        """
        without = [file for count, file in files if not count]
        ground = f"ground points of class {self._wanted}"
        if without and len(without) == len(files):
            advice = "Classify the ground first, or choose other ground classes."
            refuse_groundless([file.name for file in without], ground, advice)
        report_groundless(without, progress, ground)

    @property
    def _wanted(self) -> str:
        """The ground classes in words."""
        return " or ".join(map(str, self.ground_classes))
