"""Classes set by hand: polygons with a class, and classes that were changed after a run."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from ..core.errors import BareEarthError
from ..core.progress import SILENT, Progress
from ..core.words import counted
from ..las.cloud import PointCloud
from ..survey.area import Area, Polygon
from ..survey.shapes import Geometry, Place, Shapes, located
from ..survey.vector_files import read_polygons_with_classes

# A later run classifies points again whose class was set to this one by hand.
_NEVER_CLASSIFIED = 0
_LARGEST_CLASS = 255


@dataclass(frozen=True, eq=False)
class Corrections(Geometry):
    """Polygons with classes, in coordinates of the CRS."""

    polygons: tuple[Polygon, ...] = ()  # as in `Area`. Where polygons overlap, the last one counts.
    # The class of the points in each polygon. With the class of the ground, they are ground.
    classes: tuple[int, ...] = ()
    # The number of polygons without a class, which are not used: places still to be looked at.
    unanswered: int = field(default=0, init=False)

    def __post_init__(self) -> None:
        if len(self.polygons) != len(self.classes):
            raise BareEarthError("Each polygon of the corrections must have a class.")
        answered = [number for number, value in enumerate(self.classes) if not _is_none(value)]
        if not answered:  # the missing class of the first polygon is refused below
            answered = list(range(len(self.classes)))
        if len(answered) < len(self.classes):
            object.__setattr__(self, "unanswered", len(self.classes) - len(answered))
            polygons = tuple(self.polygons[number] for number in answered)
            if isinstance(self.polygons, Shapes):
                polygons = Shapes(polygons, self.polygons.crs, self.polygons.source)
            object.__setattr__(self, "polygons", polygons)
        values = tuple(_class(self.classes[number]) for number in answered)
        object.__setattr__(self, "classes", values)
        if self.polygons:
            # This refuses corners that are not finite.
            Area(None, self.polygons)

    def located(self, place: Place, progress: Progress = SILENT) -> Corrections:
        """Return the corrections in the CRS of the points."""
        if self.unanswered:
            words = "polygon of the corrections has", "polygons of the corrections have"
            progress.info(f"{counted(self.unanswered, *words)} no class, and no effect.")
        polygons = located(self.polygons, "the polygons of the corrections", place, progress)
        return Corrections(polygons, self.classes)

    def classes_of(self, part: PointCloud) -> np.ndarray:
        """Return the class of each point by the polygons; int16, shape (n,), -1 for none."""
        if not self.polygons:
            return np.full(part.count, -1, dtype=np.int16)
        numbers = Area(None, self.polygons).polygon_of(part)
        return np.array([-1, *self.classes], dtype=np.int16)[numbers]


def read_corrections(source: object) -> Corrections:
    """Read the polygons of a source with their classes, and no other geometries."""
    return Corrections(*read_polygons_with_classes(source))


def _is_none(value: object) -> bool:
    """Return whether an attribute has no value."""
    return value is None or value == "" or value != value


def _class(value: Any) -> int:
    try:
        number = float(value)
    except (TypeError, ValueError):
        number = -1.0
    if not number.is_integer() or not 0 <= number <= _LARGEST_CLASS:
        raise BareEarthError(
            "The class of each polygon of the corrections must be a whole number from 0 to 255,"
            f" not {value}."
        )
    return int(number)


NO_CORRECTIONS = Corrections()


class ByHand(NamedTuple):
    """Classes of points that were set by hand."""

    known: np.ndarray  # bool (n,), points with a class set by hand
    classes: np.ndarray  # uint8 (n,); for other points, their present class


def changed_since(part: PointCloud) -> np.ndarray:
    """Return which points have another class than the one remembered by an earlier run, bool (n,);
    points set to 0 (never classified) are not among them, since they are classified again.
    """
    if part.remembered is None:
        return np.zeros(part.count, dtype=bool)
    classes = part.classification
    return (part.remembered != classes) & (classes != _NEVER_CLASSIFIED)


def to_remember(part: PointCloud, classes: np.ndarray) -> np.ndarray:
    """Return the values to remember for the new classes of points, uint8 (n,): the class, or a
    different value for points that keep a class set by hand, so that the next run finds these.
    """
    stays = changed_since(part) & (classes == part.classification)
    return np.where(stays, _LARGEST_CLASS - classes, classes)
