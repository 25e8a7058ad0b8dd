"""The meanings of classes: which are decided anew by default, and which stay."""

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
# Classes that a classification decides anew by default. All others say more of a point than whether
# it is ground: water, wires, bridge decks, the sea floor, or what a producer defined.
DECIDED = (0, 1, 2, 3, 4, 5, 6, 8, 12)
# Of the classes that stay, rails and roads mostly lie on the ground, and often are all there is of
# it. So the filter sees them.
ROADS = (10, 11)
# In point formats 0 to 5 overlap is a class; the others have a flag for it.
OVERLAP = 12
# Ground beside a shore or breakline, which terrain models leave out there.
IGNORED_GROUND = 20
# Of topo-bathymetric lidar.
BOTTOM = 40  # of a water
WATER_SURFACES = (41, 42)
SUBMERGED = (43, 44, 45)  # what lies or ends between the two
ALL_CLASSES = "all"


def tell_of_kept(counts: PointCounts, others: Collection[int], progress: Progress) -> None:
    """Name the classes that stay by default, and how to classify them too, but not `others`, which
    are decided anew, or are known ground.
    """
    present = set(np.flatnonzero(counts.classes).tolist())
    kept = present - {*DECIDED, *NOISE, *others}
    roads, left = sorted(kept & set(ROADS)), sorted(kept - set(ROADS))
    if roads:
        progress.info(
            f"{_counted(counts, roads)} keep their class. Where they lie on the ground, they"
            " support it."
        )
    if left:
        progress.info(
            f"{_counted(counts, left)} keep their class and do not take part. To classify them"
            f" too, give {option('from_classes', ALL_CLASSES)}."
        )


def _counted(counts: PointCounts, classes: Sequence[int]) -> str:
    """Return the numbers of points of some classes in words."""
    first, *others = classes
    found = [f"{counted(int(counts.classes[first]), 'point')} of {named_class(first)}"]
    found += [f"{int(counts.classes[code]):,} of {named_class(code)}" for code in others]
    return ", ".join(found)


def overlapping(cloud: PointCloud) -> np.ndarray:
    """Return which points are of the overlap of strips, by their flag, or by class 12,
    bool (n,).
    """
    found = cloud.classification == OVERLAP
    return found if cloud.overlap is None else found | cloud.overlap


def used(cloud: PointCloud, overlap: str) -> np.ndarray:
    """Return which points of any class are not withheld, nor overlap if that is "leave-out", not
    "use", bool (n,).
    """
    if overlap == "leave-out":
        return ~(cloud.withheld | overlapping(cloud))
    return ~cloud.withheld


def is_one_of(classification: np.ndarray, classes: Sequence[int]) -> np.ndarray:
    """Return which points have one of a few classes."""
    found = np.zeros(len(classification), dtype=bool)
    for value in classes:
        found |= classification == value
    return found
