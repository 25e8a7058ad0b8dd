"""The meanings of classes, and which of them a classification keeps by default."""

from __future__ import annotations

from typing import Collection, Sequence

import numpy as np

from ..core.progress import Progress
from ..core.words import counted, option
from ..las.class_names import named_class
from ..las.cloud import PointCloud
from .point_counts import PointCounts

NEVER_CLASSIFIED = 0
UNCLASSIFIED = 1
GROUND = 2
LOW_NOISE = 7
HIGH_NOISE = 18
NOISE = (LOW_NOISE, HIGH_NOISE)
# Classes that a classification decides again by default. All other classes say more about a point
# than whether it is ground: water, wires, bridge decks, the sea floor, or classes of a producer.
DECIDED = (0, 1, 2, 3, 4, 5, 6, 8, 12)
# Rails and roads keep their class, but they mostly lie on the ground, and often no other points of
# the ground exist there. So they take part in the filter.
ROADS = (10, 11)
# In point formats 0 to 5 overlap is a class; the others have a flag for it.
OVERLAP = 12
# Ground next to a shore or breakline, which terrain models do not use.
IGNORED_GROUND = 20
# Of topo-bathymetric lidar.
BOTTOM = 40  # of a water
WATER_SURFACES = (41, 42)
SUBMERGED = (43, 44, 45)  # between the bottom and the surface
ALL_CLASSES = "all"


def tell_of_kept(counts: PointCounts, others: Collection[int], progress: Progress) -> None:
    """Report the classes that stay by default, and how to classify them as well; `others` are
    classes that do not stay.
    """
    present = set(np.flatnonzero(counts.classes).tolist())
    kept = present - {*DECIDED, *NOISE, *others}
    roads, not_used = sorted(kept & set(ROADS)), sorted(kept - set(ROADS))
    if roads:
        progress.info(
            f"{_counted(counts, roads)} keep their class. Where they lie on the ground, they"
            " support it."
        )
    if not_used:
        progress.info(
            f"{_counted(counts, not_used)} keep their class and do not take part. To classify them"
            f" too, give {option('from_classes', ALL_CLASSES)}."
        )


def _counted(counts: PointCounts, classes: Sequence[int]) -> str:
    """Return the numbers of points of some classes in words."""
    first, *others = classes
    words = [f"{counted(int(counts.classes[first]), 'point')} of {named_class(first)}"]
    words += [f"{int(counts.classes[code]):,} of {named_class(code)}" for code in others]
    return ", ".join(words)


def overlapping(cloud: PointCloud) -> np.ndarray:
    """Return which points are overlap of strips, by their flag or by class 12, bool (n,)."""
    of_class = cloud.classification == OVERLAP
    return of_class if cloud.overlap is None else of_class | cloud.overlap


def used(cloud: PointCloud, overlap: str) -> np.ndarray:
    """Return which points are used, bool (n,): those that are not withheld, and not in the overlap
    of strips if `overlap` is "leave-out".
    """
    if overlap == "leave-out":
        return ~(cloud.withheld | overlapping(cloud))
    return ~cloud.withheld


def is_one_of(classification: np.ndarray, classes: Sequence[int]) -> np.ndarray:
    """Return which points have one of a few classes."""
    result = np.zeros(len(classification), dtype=bool)
    for value in classes:
        result |= classification == value
    return result
