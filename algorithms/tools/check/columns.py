"""What the columns of a table of points hold, by their names in several languages."""

from __future__ import annotations

import re
import unicodedata
from pathlib import Path
from typing import Mapping, NamedTuple, Sequence

from ...core.errors import BareEarthError
from ...crs.unit_names import FOOT, UNITS, US_FOOT

_LETTERS = str.maketrans({"ø": "o", "Ø": "O", "ł": "l", "Ł": "L", "ß": "ss", "æ": "a"})
_PARTS = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+|\d+")


def words_of(text: str) -> frozenset[str]:
    """Return the words of a list."""
    return frozenset(text.split())


def without_accents(text: str) -> str:
    """Return a text without accents, such as "Hohe, Strasse" for "Höhe, Straße"."""
    text = unicodedata.normalize("NFKD", text.translate(_LETTERS))
    return "".join(letter for letter in text if not unicodedata.combining(letter))


def parts_of(text: str) -> list[str]:
    """Return the words and numbers in a text, also those that only capitals part: Tall, Grass and 2
    in "TallGrass_2".
    """
    return _PARTS.findall(without_accents(text))


# Names of columns without accents and signs; a name of several words is also recognised if all of
# its words are in the row. Earlier names count before later ones.
NAMES = {
    "x": "x e east easting eastings ost ostwert rechtswert rechts est este leste oost oosting"
    " xcoord coordx pointx xutm abscisse lon long lng longitude longitud longitudine lange laenge"
    " geolange geolaenge",
    "y": "y n north northing northings nord nordwert hochwert hoch norte noord noording ycoord"
    " coordy pointy yutm ordonnee lat latitude latitud latitudine breite geobreite",
    "z": "z elevation elev elv ele cota elevacion quota kote rl rzedna zcoord coordz pointz"
    " altitude alt altura altezza height hgt ht hohe hoehe geohohe geohoehe hauteur hoogte hojde"
    " hoyde hojd korkeus wysokosc vyska h",
    "cover": "cover landcover landcoverclass landcovertype covertype groundcover vegetation"
    " landuse lulc vegetated vegetacion vegetatie bewuchs bodenbedeckung bedeckung landbedeckung"
    " nutzung landnutzung oberflache untergrund occupation occupationsol couverture typesol sol"
    " cobertura coberturasuelo usosuelo tiposuelo copertura bodembedekking bodemgebruik"
    " landgebruik grondgebruik begroeiing surface surfacetype terraintype class klasse classe"
    " clase category kategorie categorie categoria description desc featurecode codedescription"
    " code",
    "type": "pointtype pttype ptype type gcptype checkpointtype pointclass pointusage usage"
    " purpose role nvavva typ punktart art typepoint naturepoint tipo tipopunto punttype soort",
    "name": "name id pointid pointname ptid uniqueidentifier uniqueide uniqueid point pt pnt nr no"
    " num number nummer punkt punktnr punktnummer pkt station label nom nombre nome numero naam"
    " navn namn p marker gcp gcpname checkpoint checkpointid gcpid",
}
# Words that say nothing about what a column holds.
_FILLERS = words_of(
    "source grid coord coords coordinate coordinates koordinate utm map projected surveyed"
    " measured known reference field gps gnss survey check checkpoint control the of de du des del"
    " della di la le les el der die das von van het in"
)
# Words by which a height is above the geoid, those that may go with them, and words by which it is
# above the ellipsoid.
_ORTHOMETRIC = words_of(
    "nhn nn navd ngvd msl amsl asl nap ngf ign evrf odn aod ahd nzvd cgvd dhhn lhn ln taw egm"
)
_ABOVE = words_of("sea level normal mean uber ueber u above over sur sobre boven")
_ELLIPSOIDAL = words_of("hae wgs etrs grs nad hell helli")
_PREFIX = re.compile(
    r"(orth[a-z]*?|ortom?[a-z]*?|normal|ellip[a-z]*?|elip[a-z]*?|ell)"
    r"(?:elevation|elev|heights?|hgt|hts?|altitude|alt|hohen?|hoehen?|z|h)?"
)
_OF_FEET = {"us", "survey", "usa", "intl", "international", "int", "s"}
_ANGLES = {"deg", "degree", "degrees", "dd", "decimal", "grad"}
_PAIR = re.compile(r"\s*(\w+)\s*=\s*(.+?)\s*$")


class ColumnName(NamedTuple):
    """What the name of a column says."""

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
        if prefixes or not words.isdisjoint(_ORTHOMETRIC) or words >= {"sea", "level"}:
            return 0
        return 1 if words.isdisjoint(_ELLIPSOIDAL) else 2

    def rank(self, role: str) -> tuple[int, int] | None:
        """Return how well it names a role, the smaller the better; None if it does not."""
        known = NAMES[role].split()
        words = [word for word in self._lower if word not in _FILLERS] or self._lower
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
            elif _PREFIX.fullmatch(word) or word in _ELLIPSOIDAL:
                places.append(len(known))
            elif word not in _ORTHOMETRIC | _ABOVE:
                return None
        if places:
            return self.height_kind, min(places)
        is_datum = len(words) == 1 and words[0] in _ORTHOMETRIC  # NHN alone
        return (0, 0) if is_datum else None


def columns_in(text: str | None) -> dict[str, str]:
    """Return the columns that a user chooses, such as ``x=E,y=N,z=H,cover=Class,type=Use,name=ID``;
    refuse what is written in another way.
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
    """Return the columns that can hold each role, the best first, given for some roles the only
    ones, as names or numbers from 1 on; refuse one that is not there.
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
    exact = [name.strip() for name in names]
    for known, name in (
        (exact, wanted.strip()), ([name.lower() for name in exact], wanted.strip().lower())
    ):  # fmt: skip
        if name in known:
            return known.index(name)
    if wanted.isdigit() and 1 <= int(wanted) <= len(names):
        return int(wanted) - 1
    raise BareEarthError(f"{path} has no column {wanted}. It has {', '.join(map(str, names))}.")
