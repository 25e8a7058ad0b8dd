"""The meanings of classes, and which of them a classification keeps by default."""

from __future__ import annotations

from typing import Collection, Sequence

import numpy as np

from ..core.progress import Progress
from ..core.words import counted, option
from ..las.class_names import named_class
from ..las.cloud import PointCloud
from ..las.lasfile import FIRST_EXTENDED_FORMAT
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
# Classes without a meaning in point formats 0 to 5, to which producers have given many: 11 was
# withheld in old data of the USA, 18 overlap.
RESERVED = (10, 11, *range(13, 32))
# In point formats 0 to 5 overlap is a class; the others have a flag for it.
OVERLAP = 12
# Ground next to a shore or breakline, which terrain models do not use.
IGNORED_GROUND = 20
# Of topo-bathymetric lidar.
BOTTOM = 40  # of a water
WATER_SURFACES = (41, 42)
SUBMERGED = (43, 44, 45)  # between the bottom and the surface
ALL_CLASSES = "all"


def report_kept(counts: PointCounts, others: Collection[int], progress: Progress) -> None:
    """Report the classes that stay by default, and how to classify them as well; `others` are
    classes that do not stay.
    """
    unknown = np.where(np.isin(np.arange(256), [*others]), 0, counts.reserved)
    numbers = counts.classes - unknown
    kept = set(np.flatnonzero(numbers).tolist()) - {*DECIDED, *NOISE, *others}
    roads, not_used = sorted(kept & set(ROADS)), sorted(kept - set(ROADS))
    all_too = f"To classify them too, give {option('from_classes', ALL_CLASSES)}."
    if roads:
        progress.info(
            f"{_counted(numbers, roads)} keep their class. Where they lie on the ground, they"
            " support it."
        )
    if not_used:
        progress.info(
            f"{_counted(numbers, not_used)} keep their class and do not take part. {all_too}"
        )
    if unknown.any():
        there = np.flatnonzero(unknown).tolist()
        progress.warning(
            f"{_counted(unknown, there, named=False)} keep their class and do not take part: point"
            f" formats 0 to 5 reserve these classes, so what they mean is not known. {all_too}"
        )


def _counted(numbers: np.ndarray, classes: Sequence[int], named: bool = True) -> str:
    """Return the numbers of points of some classes in words."""
    names = [named_class(code) if named else f"class {code}" for code in classes]
    words = [f"{int(numbers[code]):,} of {name}" for code, name in zip(classes, names)]
    words[0] = f"{counted(int(numbers[classes[0]]), 'point')} of {names[0]}"
    return ", ".join(words)


def reserved(cloud: PointCloud) -> np.ndarray:
    """Return which points have a class that their point format reserves, bool (n,)."""
    if cloud.point_format >= FIRST_EXTENDED_FORMAT:
        return np.zeros(cloud.count, dtype=bool)
    return is_one_of(cloud.classification, RESERVED)


def overlapping(cloud: PointCloud) -> np.ndarray:
    """Return which points are overlap of strips, by their flag or by class 12, bool (n,)."""
    of_class = cloud.classification == OVERLAP
    return of_class if cloud.overlap is None else of_class | cloud.overlap


def used(cloud: PointCloud, overlap: str) -> np.ndarray:
    """Return which points are used, bool (n,): not withheld, and not in the overlap
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
