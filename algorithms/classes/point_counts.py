"""Counts of the points of a file, for messages; counted part by part."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ..core.points import Box, box_round
from ..core.threads import parts_of
from ..core.words import option
from ..las.cloud import PointCloud

_STEP = 1 << 20


@dataclass
class PointCounts:
    """Counts of the parts of a file so far."""

    points: int = 0  # all points
    withheld: int = 0
    unnumbered: int = 0  # points without return number
    overlap: int = 0
    from_zero: bool = False  # whether the return numbers begin at 0
    free: int = 0  # points in the area and its surroundings that are not withheld
    in_use: int = 0  # of these, the points that are not overlap which is left out
    eligible: int = 0  # points that may change their class
    of_returns: int = 0  # eligible points of the chosen returns
    known: int = 0  # points of known ground
    by_hand: int = 0  # points with a class set by hand
    selected: int = 0  # points that take part
    # int64 (256,), points of each class.
    classes: np.ndarray = field(default_factory=lambda: np.zeros(256, dtype=np.int64))
    # int64 (256,), points of each class that their point format reserves.
    reserved: np.ndarray = field(default_factory=lambda: np.zeros(256, dtype=np.int64))
    # int64 (256,), points of each class in the area and its surroundings.
    classes_within: np.ndarray = field(default_factory=lambda: np.zeros(256, dtype=np.int64))
    inside: int = 0  # points in the area itself
    wanted: int = 0  # points in the area that take part
    bounds: Box | None = None  # smallest x and y, largest x and y, in units of the CRS

    def add(self, part: PointCloud, within: np.ndarray | None, **masks: np.ndarray) -> None:
        """Count the points of a part, and those of masks, which have the names of attributes."""
        self.points += part.count
        self.from_zero |= part.from_zero
        classes, free = part.classification, ~part.withheld
        counts = count_classes(classes)
        self.classes += counts
        if within is not None:
            classes, free = classes[within], free & within
            counts = count_classes(classes)
        self.classes_within += counts
        self.add_counts(withheld=part.withheld, free=free, **masks)

    def see(self, part: PointCloud) -> None:
        """Extend the bounds by the points of a part."""
        boxes = [part.box] if self.bounds is None else [part.box, self.bounds]
        self.bounds = box_round(np.array(boxes))

    def add_counts(self, **masks: np.ndarray) -> None:
        """Count the points of masks, which have the names of attributes."""
        for name, mask in masks.items():
            setattr(self, name, getattr(self, name) + int(np.count_nonzero(mask)))

    @property
    def why_none(self) -> str:
        """A sentence that says why no point can be ground; empty if some can."""
        if self.of_returns:
            return ""
        if self.eligible:
            return "None is a last or single return."
        if not self.free:
            return "All are withheld."
        classes = np.flatnonzero(self.classes_within).tolist()
        words = "class" if len(classes) == 1 else "classes"
        return f"All are of {words} {', '.join(map(str, classes))}."

    def why_empty(self, place: str) -> str:
        """Return a sentence that says why no point takes part, and what to change."""
        if self.eligible:
            return f"No point of {place} is a last or single return. Choose all returns instead."
        if not self.free:
            return f"All points of {place} are withheld. Clear that flag first."
        if not self.in_use:
            return (
                f"All points of {place} are overlap of strips (by their flag or class 12), which is"
                f" left out. Give {option('overlap', 'use')} to use them."
            )
        present = np.flatnonzero(self.classes_within).tolist()
        classes = f"class{'es' if present[1:] else ''} {', '.join(map(str, present))}"
        return (
            f"No point of {place} can be classified: it has only the {classes}. Choose the classes"
            " to classify among them."
        )


def by_class(counts: np.ndarray) -> dict[int, int]:
    """Return the counts of the classes that occur, given an array of the counts of all classes."""
    return {value: int(counts[value]) for value in np.flatnonzero(counts).tolist()}


def count_classes(classes: np.ndarray) -> np.ndarray:
    """Return the number of points of each class, int64 (256,)."""
    # In steps, since bincount needs much memory.
    counts = np.zeros((256, 256), dtype=np.int64)
    even = len(classes) - len(classes) % 2
    # Two classes form one number, so that only half as many numbers are counted.
    pairs = np.ascontiguousarray(classes[:even]).view(np.uint16)
    for part in parts_of(len(pairs), _STEP):
        step = np.bincount(pairs[part], minlength=counts.size)
        counts += step.reshape(counts.shape)
    return counts.sum(axis=0) + counts.sum(axis=1) + np.bincount(classes[even:], minlength=256)
