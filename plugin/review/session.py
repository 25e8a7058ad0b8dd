"""A review of a layer of places: which place is looked at, and what is answered."""

from __future__ import annotations

import math
from typing import Any, NamedTuple, Tuple

import numpy as np
from qgis.core import QgsFeature, QgsGeometry, QgsPointXY, QgsRectangle, QgsVectorLayer

from ...algorithms.classes.corrections import ANSWERS
from ...algorithms.core.errors import BareEarthError
from ...algorithms.survey.area import Polygon
from ...algorithms.survey.vector_files import ANSWER_FIELD
from .. import compat
from ..i18n import tr

RIGHT, NOT_GROUND, GROUND, SKIP = ANSWERS
# Fields of the layers of places that *Places to review* and deliveries write.
_NUMBERS = ("ERROR", "AREA", "LOW", "HIGH")
_ENDS = ("X1", "Y1", "X2", "Y2")
_FIELDS = ("RANK", "REASON", *_NUMBERS, *_ENDS, ANSWER_FIELD)

Line = Tuple[float, float, float, float]


class ReviewPlace(NamedTuple):
    """A place to review; lengths and heights as in the fields of the layer."""

    feature: int  # its id in the layer
    rank: int
    reason: str
    error: float  # metres
    area: float  # square metres
    low: float
    high: float
    line: Line  # x and y of both ends of the profile
    answer: str  # empty if not answered
    outline: QgsGeometry

    @property
    def inside(self) -> tuple[tuple[float, float], ...]:
        """Where the line begins and ends to be in the place, as distances from its first end."""
        x1, y1, x2, y2 = self.line
        line = QgsGeometry.fromPolylineXY([QgsPointXY(x1, y1), QgsPointXY(x2, y2)])
        parts = line.intersection(self.outline).asGeometryCollection()
        ends = (
            [math.hypot(corner.x() - x1, corner.y() - y1) for corner in part.vertices()]
            for part in parts
        )
        return tuple((min(some), max(some)) for some in ends)

    @property
    def polygons(self) -> list[Polygon]:
        """The rings of each polygon."""
        parts = self.outline.asGeometryCollection()
        return [
            tuple(np.array([(corner.x(), corner.y()) for corner in ring]) for ring in rings)
            for rings in (part.asPolygon() for part in parts)
        ]

    @property
    def extent(self) -> QgsRectangle:
        """The rectangle round the place and its profile."""
        x1, y1, x2, y2 = self.line
        box = QgsRectangle(x1, y1, x2, y2)
        box.combineExtentWith(self.outline.boundingBox())
        return box


def has_places(layer: object) -> bool:
    """Return whether a layer holds places to review."""
    return isinstance(layer, QgsVectorLayer) and all(
        layer.fields().lookupField(name) >= 0 for name in _FIELDS
    )


class Session:
    """The places of a layer in the order of their rank, one of them current."""

    def __init__(self, layer: QgsVectorLayer | None = None) -> None:
        self.layer: Any = layer  # None if it is gone: then there is no place
        self.places: list[ReviewPlace] = []
        self.number = 0  # of the current place, from 0
        self._given: list[tuple[int, str]] = []  # numbers of places, and their answers before
        self.read()
        self.number = self._open_after(-1) or 0

    def read(self) -> None:
        """Read the places again, because the layer has changed."""
        found = map(_place_of, self.layer.getFeatures() if self.layer else ())
        # The user's own corrections, which are carried over too, have no profile.
        known = (place for place in found if math.isfinite(sum(place.line)))
        self.places = sorted(known, key=lambda place: (place.rank, place.feature))
        self.number = min(self.number, max(len(self.places) - 1, 0))

    @property
    def place(self) -> ReviewPlace | None:
        """The current place."""
        return self.places[self.number] if self.places else None

    @property
    def answered(self) -> int:
        """The number of places with an answer; those to be looked at later have none."""
        return sum(place.answer not in ("", SKIP) for place in self.places)

    @property
    def is_done(self) -> bool:
        """Whether all places are answered or skipped."""
        return all(place.answer for place in self.places)

    @property
    def corrections(self) -> int:
        """The number of places whose answer changes the terrain."""
        return sum(place.answer in (GROUND, NOT_GROUND) for place in self.places)

    def step(self, by: int) -> None:
        """Go to another place; after the last one comes the first."""
        if self.places:
            self.number = (self.number + by) % len(self.places)

    def give(self, answer: str) -> None:
        """Save the answer for the current place, and go to the next one without an answer."""
        if self.place is None:
            return
        before = self.place.answer
        self._save(self.number, answer)
        self._given.append((self.number, before))
        following = self._open_after(self.number)
        self.number = self.number if following is None else following

    def undo(self) -> None:
        """Take the last answer back, and go to its place."""
        if self._given:
            number, before = self._given[-1]
            self._save(number, before)
            self._given.pop()
            self.number = number

    @property
    def can_undo(self) -> bool:
        """Whether an answer was given that can be taken back."""
        return bool(self._given)

    def _open_after(self, number: int) -> int | None:
        """Return the number of the next place without an answer, also from the start."""
        count = len(self.places)
        following = ((number + step) % count for step in range(1, count + 1))
        return next((one for one in following if not self.places[one].answer), None)

    def _save(self, number: int, answer: str) -> None:
        """Write an answer into the layer at once, without an edit session."""
        if self.layer.isEditable():
            text = tr('The layer "{}" is being edited. Save or discard the edits first.')
            raise BareEarthError(text.format(self.layer.name()))
        place, provider = self.places[number], self.layer.dataProvider()
        field = self.layer.fields().lookupField(ANSWER_FIELD)
        provider.enterUpdateMode()
        is_saved = provider.changeAttributeValues({place.feature: {field: answer or None}})
        provider.leaveUpdateMode()
        if not is_saved:
            text = tr('"{}" can\'t be written: the answer is not saved. Export it as GeoPackage.')
            raise BareEarthError(text.format(self.layer.name()))
        self.places[number] = place._replace(answer=answer)
        self.layer.triggerRepaint()


def _place_of(feature: QgsFeature) -> ReviewPlace:
    fields = feature.fields()
    texts = {name: feature[fields.lookupField(name)] for name in _FIELDS}
    known = {name: value for name, value in texts.items() if not compat.is_null(value)}
    error, area, low, high, x1, y1, x2, y2 = (
        float(known.get(name, math.nan)) for name in (*_NUMBERS, *_ENDS)
    )
    rank, reason = int(known.get("RANK", 0)), str(known.get("REASON", ""))
    answer, outline = str(known.get(ANSWER_FIELD, "")), QgsGeometry(feature.geometry())
    line = x1, y1, x2, y2
    return ReviewPlace(feature.id(), rank, reason, error, area, low, high, line, answer, outline)
