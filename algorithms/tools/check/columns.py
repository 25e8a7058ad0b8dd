"""The roles of columns of a table of points, by their names in several languages."""

from __future__ import annotations

import configparser
import re
import unicodedata
from pathlib import Path
from typing import Mapping, NamedTuple, Sequence

from ...core.errors import BareEarthError
from ...crs.unit_names import FOOT, UNITS, US_FOOT
from ...survey.vector_files import name_among

# Lists of words that surveyors write, in two sections.
VOCABULARY = configparser.ConfigParser(interpolation=None)
VOCABULARY.read_string(Path(__file__).with_name("words.ini").read_text(encoding="utf-8"))
_LISTS = {name: words.split() for name, words in VOCABULARY["columns"].items()}
# Names of columns by role; earlier names are preferred to later ones.
NAMES = {role: _LISTS[role] for role in ("x", "y", "z", "cover", "type", "name")}
_LETTERS = str.maketrans("øØłŁæÆđĐ\u0131", "oOlLaAdDi") | {ord("ß"): "ss"}
_PARTS = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+|\d+")


def without_accents(text: str) -> str:
    """Return a text without accents, such as "Hohe, Strasse" for "Höhe, Straße"."""
    text = unicodedata.normalize("NFKD", text.translate(_LETTERS))
    return "".join(letter for letter in text if not unicodedata.combining(letter))


def parts_of(text: str) -> list[str]:
    """Return the words and numbers in a text, which capitals may separate: Tall, Grass and 2 in
    "TallGrass_2".
    """
    return _PARTS.findall(without_accents(text))


_PREFIX = re.compile(
    r"(orth[a-z]*?|ortom?[a-z]*?|normal|ellip[a-z]*?|elip[a-z]*?|ell)"
    r"(?:elevation|elev|heights?|hgt|hts?|altitude|alt|hohen?|hoehen?|z|h)?"
)
_OF_FEET = {"us", "survey", "usa", "intl", "international", "int", "s"}
_ANGLES = {"deg", "degree", "degrees", "dd", "decimal", "grad"}
_PAIR = re.compile(r"\s*(\w+)\s*=\s*(.+?)\s*$")


class ColumnName(NamedTuple):
    """The words and the unit in the name of a column."""

    words: tuple[str, ...]  # without accents, units and numbers, with their capitals
    unit: float | None  # metres

    @classmethod
    def of(cls, name: str) -> ColumnName:
        """Return the words and the unit of a name: Elevation, NAVD and 0.3048 of "Elevation_NAVD88
        (ft)".
        """
        words: list[str] = []
        for part in re.findall(r"[A-Za-z0-9]+", without_accents(str(name).replace("U.S.", "US"))):
            words += [part] if part.lower() in UNITS else _PARTS.findall(part)
        units = [word for word in words if word.lower() in UNITS]
        unit = UNITS[units[0].lower()] if units and len(words) > 1 else None
        if unit is not None:
            feet = {word.lower() for word in words} & _OF_FEET if unit == FOOT else set()
            unit = US_FOOT if feet & {"us", "survey", "usa", "s"} else unit
            words = [word for word in words if word not in units and word.lower() not in feet]
        kept = [word for word in words if not word.isdigit() and word.lower() not in _ANGLES]
        return cls(tuple(kept or words), unit)

    @property
    def _lower(self) -> list[str]:
        return [word.lower() for word in self.words]

    @property
    def height_kind(self) -> int:
        """0 for a height above the geoid, 2 for one above the ellipsoid, 1 if it is not known."""
        words = set(self._lower)
        prefixes = [match[1] for word in words if (match := _PREFIX.fullmatch(word))]
        starts = (*(prefix[:2] for prefix in prefixes), *(word[:5] for word in words))
        if "el" in starts or "ellip" in starts:
            return 2
        if prefixes or not words.isdisjoint(_LISTS["orthometric"]) or words >= {"sea", "level"}:
            return 0
        return 1 if words.isdisjoint(_LISTS["ellipsoidal"]) else 2

    def rank(self, role: str) -> tuple[int, int] | None:
        """Return how well the name fits a role, the smaller the better; None if it does not fit."""
        known = NAMES[role]
        words = [word for word in self._lower if word not in _LISTS["fillers"]] or self._lower
        if role == "z":
            return self._rank_of_height(known, words)
        joined = ["".join(words), "".join(self._lower)]
        places = [known.index(word) for word in joined if word in known]
        # "X_est" of Agisoft is estimated, not east in French.
        if not places and "est" not in words and all(word in known for word in words):
            places = [known.index(word) for word in words]
        return (0, min(places)) if places else None

    def _rank_of_height(self, known: list[str], words: list[str]) -> tuple[int, int] | None:
        if "".join(words) in known:
            words = ["".join(words)]
        places = []
        for word in words:
            if word in known:
                # Surveyors write H above the geoid, and h above the ellipsoid.
                places.append(0 if self.words == ("H",) else known.index(word))
            elif _PREFIX.fullmatch(word) or word in _LISTS["ellipsoidal"]:
                places.append(len(known))
            elif word not in (*_LISTS["orthometric"], *_LISTS["above"]):
                return None
        if places:
            return self.height_kind, min(places)
        is_datum = len(words) == 1 and words[0] in _LISTS["orthometric"]  # NHN alone
        return (0, 0) if is_datum else None


def answer_in(text: str, column: str) -> str:
    """Return a land cover for yes or no in a column of plants, and any other text unchanged."""
    words = {word.lower() for word in ColumnName.of(column).words}
    if words.isdisjoint(_LISTS["plants"]):
        return text
    word = text.lower()
    is_no = "not vegetated" if word in _LISTS["no"] else text
    return "vegetated" if word in _LISTS["yes"] else is_no


def columns_in(text: str | None) -> dict[str, str]:
    """Return the columns in a text such as ``x=E,y=N,z=H,cover=Class,type=Use,name=ID``; refuse
    other texts.
    """
    chosen = {}
    for part in filter(str.strip, (text or "").split(",")):
        pair = _PAIR.match(part)
        if pair is None or pair[1].lower() not in NAMES:
            raise BareEarthError(
                "The columns must be written like x=E,y=N,z=H,cover=Class,type=Use,name=ID, not"
                f" {part!r}."
            )
        chosen[pair[1].lower()] = pair[2]
    return chosen


def columns_of(
    names: Sequence[str], chosen: Mapping[str, str], path: Path | str
) -> dict[str, list[int]]:
    """Return the columns for each role, the best first; some roles have a chosen column, a name or
    a number from 1 on, which must exist.
    """
    found = {role: [_place_of(column, names, path)] for role, column in chosen.items()}
    used = {places[0] for places in found.values()}
    parsed = [ColumnName.of(name) for name in names]
    for role in NAMES:
        ranks = {
            place: rank
            for place, name in enumerate(parsed)
            if place not in used and (rank := name.rank(role)) is not None
        }
        found.setdefault(role, sorted(ranks, key=ranks.__getitem__))
    return found


def _place_of(wanted: str, names: Sequence[str], path: Path | str) -> int:
    """Return the place of a column that the user gave by its name or number."""
    name = name_among(names, wanted.strip())
    if name is not None:
        return names.index(name)
    if wanted.isdigit() and 1 <= int(wanted) <= len(names):
        return int(wanted) - 1
    raise BareEarthError(f"{path} has no column {wanted}. It has {', '.join(map(str, names))}.")
