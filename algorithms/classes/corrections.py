"""Classes set by hand: polygons with a class, and classes that were changed after a run."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, Mapping, NamedTuple, cast

import numpy as np

from ..core.errors import BareEarthError
from ..core.progress import SILENT, Progress
from ..core.words import counted
from ..las.cloud import PointCloud
from ..survey.area import Area, Polygon
from ..survey.shapes import Geometry, Place, Shapes, located
from ..survey.vector_files import (
    ANSWER_FIELD,
    CLASS_FIELD,
    name_among,
    read_polygons_with_attributes,
    value_of,
)

# A later run classifies points again whose class was set to this one by hand.
_NEVER_CLASSIFIED = 0
_LARGEST_CLASS = 255


# What a person can answer about a place: "right" and "skip" change nothing.
RIGHT = "right"
SKIP = "skip"
ANSWERS = (RIGHT, "not ground", "ground", SKIP)
# What `Corrections.classes_of` returns besides classes.
NOTHING = -1
CONTINUED = -2  # points that continue the ground are ground
DEMOTED = -3  # points that a classification decides are not ground, all others keep their class
_OF_ANSWERS = {RIGHT: NOTHING, "not ground": DEMOTED, "ground": CONTINUED, SKIP: NOTHING}


@dataclass(frozen=True, eq=False)
class Corrections(Geometry):
    """Polygons with classes or answers, in coordinates of the CRS."""

    polygons: tuple[Polygon, ...] = ()  # as in `Area`. Where polygons overlap, the last one counts.
    # The class of the points in each polygon, None for none. With that of the ground, all are
    # ground.
    classes: tuple[int | None, ...] = ()
    answers: tuple[str | None, ...] = ()  # one of `ANSWERS` each, before the class; () for none
    # The other attributes of each polygon, as `read_corrections` finds them; () for none.
    values: tuple[Mapping[str, Any], ...] = ()
    # The number of polygons without class and answer, which are left out.
    unanswered: int = field(default=0, init=False)

    def __post_init__(self) -> None:
        count = len(self.polygons)
        if len(self.classes) != count:
            raise BareEarthError("Each polygon of the corrections must have a class.")
        classes = [None if _is_none(value) else _class(value) for value in self.classes]
        answers = [None if _is_none(value) else _answer(value) for value in self.answers]
        answers += [None] * (count - len(answers))
        known = [n for n in range(count) if (classes[n], answers[n]) != (None, None)]
        if count and not known:
            raise BareEarthError(
                f"{counted(count, 'polygon')} of the corrections, and none has a class or an"
                f" answer. Fill in the attribute '{CLASS_FIELD}' (2 is ground, 1 is not) or"
                f" '{ANSWER_FIELD}' ({', '.join(ANSWERS)})."
            )
        polygons = tuple(self.polygons[number] for number in known)
        if isinstance(self.polygons, Shapes):
            polygons = Shapes(polygons, self.polygons.crs, self.polygons.source)
        values = [*self.values, *[{}] * (count - len(self.values))]
        for name, value in (
            ("polygons", polygons), ("unanswered", count - len(known)),
            ("classes", tuple(classes[number] for number in known)),
            ("answers", tuple(answers[number] for number in known)),
            ("values", tuple(values[number] for number in known)),
        ):  # fmt: skip
            object.__setattr__(self, name, value)
        if polygons:
            # This refuses corners that are not finite.
            Area(None, polygons)

    def located(self, place: Place, progress: Progress = SILENT) -> Corrections:
        """Return the corrections in the CRS of the points."""
        if self.unanswered:
            words = "polygon of the corrections has", "polygons of the corrections have"
            progress.info(
                f"{counted(self.unanswered, *words)} no class and no answer, and no effect."
            )
        polygons = located(self.polygons, "the polygons of the corrections", place, progress)
        return replace(self, polygons=polygons)

    @cached_property
    def effects(self) -> tuple[tuple[Polygon, ...], tuple[int, ...], tuple[int, ...]]:
        """The polygons that change classes, by what: a class, `CONTINUED` or `DEMOTED`; and which
        of all polygons they are.
        """
        codes = [
            cast(int, value) if answer is None else _OF_ANSWERS[answer]
            for value, answer in zip(self.classes, self.answers)
        ]
        numbers = tuple(number for number, code in enumerate(codes) if code != NOTHING)
        polygons = tuple(self.polygons[number] for number in numbers)
        return polygons, tuple(codes[number] for number in numbers), numbers

    @property
    def exact(self) -> tuple[int, ...]:
        """The classes that polygons give to all of their points."""
        return tuple(code for code in self.effects[1] if code >= 0)

    @property
    def continues(self) -> bool:
        """Whether the ground is continued in any polygon."""
        return CONTINUED in self.effects[1]

    def classes_of(self, part: PointCloud) -> np.ndarray:
        """Return the class of each point by the polygons, or `CONTINUED`, `DEMOTED` or `NOTHING`;
        int16, shape (n,).
        """
        polygons, codes, _ = self.effects
        if not polygons:
            return np.full(part.count, NOTHING, dtype=np.int16)
        numbers = Area(None, polygons).polygon_of(part)
        return np.array([NOTHING, *codes], dtype=np.int16)[numbers]


def read_corrections(source: object) -> Corrections:
    """Read the polygons of a source with their classes, and no other geometries."""
    polygons, attributes = read_polygons_with_attributes(source)
    names = list(dict.fromkeys(name for row in attributes for name in row))
    if not (name_among(names, CLASS_FIELD) or name_among(names, ANSWER_FIELD)):
        there = ", ".join(names) or "none"
        raise BareEarthError(
            f"No attribute of {polygons.source} is called '{CLASS_FIELD}' or '{ANSWER_FIELD}';"
            f" there are: {there}. Name the one with the classes '{CLASS_FIELD}'."
        )
    classes, answers = (
        tuple(value_of(row, name) for row in attributes) for name in (CLASS_FIELD, ANSWER_FIELD)
    )
    return Corrections(polygons, classes, answers, tuple(map(plain_values, attributes)))


def plain_values(attributes: Mapping[str, Any]) -> dict[str, Any]:
    """Return the attributes that are numbers or texts, but not class and answer, in upper case."""
    return {
        name.upper(): value
        for name, value in attributes.items()
        if isinstance(value, (int, float, str)) and not _is_none(value)
        if name.lower() not in (CLASS_FIELD, ANSWER_FIELD)
    }


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


def _answer(value: Any) -> str:
    answer = " ".join(str(value).lower().split())
    if answer not in ANSWERS:
        raise BareEarthError(
            f"The answer of each place must be one of {', '.join(ANSWERS)}, not {value}."
        )
    return answer


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
