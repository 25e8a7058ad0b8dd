"""What is known of the classes of points by hand: polygons, and classes changed since a run."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from ..core.errors import BareEarthError
from ..las.cloud import PointCloud
from .area import Area, Polygon

# Never classified: a point that gets this class by hand is judged anew.
_NEVER_CLASSIFIED = 0
_LARGEST_CLASS = 255
# The attribute of a polygon that says its class.
CLASS_FIELD = "class"


@dataclass(frozen=True, eq=False)
class Corrections:
    """Polygons with classes, in coordinates of the CRS.

    Attributes
    ----------
    polygons : tuple of polygon
        As in `Area`. Where several lie, the last of them counts.
    classes : tuple of int
        The class of the points in each; that of the ground says that they are ground.

    Raises
    ------
    BareEarthError
        If a class is none, a polygon has no class, or a corner is not finite.
    """

    polygons: tuple[Polygon, ...] = ()
    classes: tuple[int, ...] = ()

    def __post_init__(self) -> None:
        if len(self.polygons) != len(self.classes):
            raise BareEarthError("Each polygon of the corrections must have a class.")
        object.__setattr__(self, "classes", tuple(map(_class, self.classes)))
        if self.polygons:
            # Refuses corners that are not finite.
            Area(None, self.polygons)

    def classes_of(self, part: PointCloud) -> np.ndarray:
        """Return the class that the polygons give each point; int16, shape (n,), -1 for none."""
        if not self.polygons:
            return np.full(part.count, -1, dtype=np.int16)
        numbers = Area(None, self.polygons).polygon_of(part)
        return np.array([-1, *self.classes], dtype=np.int16)[numbers]


def _class(value: Any) -> int:
    """Return the class that a value of an attribute says."""
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
    """What is known of points by hand.

    Attributes
    ----------
    known : numpy.ndarray of bool, shape (n,)
        Of which points the class is certain.
    classes : numpy.ndarray of uint8, shape (n,)
        Their classes; of the others, those that they have.
    """

    known: np.ndarray
    classes: np.ndarray


def changed_since(part: PointCloud) -> np.ndarray:
    """Return which points have another class than the run that remembered it gave them.

    Returns
    -------
    numpy.ndarray of bool, shape (n,)
        False for those that were set to 0, never classified: they are to be judged anew.
    """
    if part.remembered is None:
        return np.zeros(part.count, dtype=bool)
    classes = part.classification
    return (part.remembered != classes) & (classes != _NEVER_CLASSIFIED)


def to_remember(part: PointCloud, classes: np.ndarray) -> np.ndarray:
    """Return what is remembered of the classes that points get.

    Returns
    -------
    numpy.ndarray of uint8, shape (n,)
        The class; of points that were changed by hand and keep theirs another one, so that the
        next run knows them as well.
    """
    stays = changed_since(part) & (classes == part.classification)
    return np.where(stays, _LARGEST_CLASS - classes, classes)
