"""Finds the CRS and the units of a file, given all of its records."""

from __future__ import annotations

import math
from typing import NamedTuple, Sequence

from ..core.progress import Progress
from .geokeys import GeoKeys
from .matching import is_other_datum, named_with_heights
from .provider import wkt_of_epsg
from .stated import how_to_state
from .system import Crs, crs_of_facts, same_unit, unit_name
from .wkt import VerticalDatum, WktFacts, read_wkt

_KEYS = "GeoTIFF keys"
_TEXT = "well-known text"


class _Statement(NamedTuple):
    """The CRS that one record states, as well-known text and as facts, and the kind of record."""

    kind: str
    wkt: str | None
    facts: WktFacts


def crs_of_records(
    texts: Sequence[str], keys: GeoKeys | None, prefers_text: bool, progress: Progress
) -> Crs | None:
    """Return the CRS of a file, given all of its records, None if they state none; warn of unknown
    units and of contradictions, which well-known text decides if it is preferred.
    """
    # Facts that the preferred record does not state, such as the unit of heights, come from the
    # other records.
    statements = [_Statement(_TEXT, text, facts) for text in texts if (facts := read_wkt(text))]
    statements[1:] = [statement._replace(kind=f"other {_TEXT}") for statement in statements[1:]]
    if keys is not None:
        stated = _statement_of(keys, progress)
        statements = [*statements, stated] if prefers_text else [stated, *statements]
    if not statements:
        return None
    whole = statements[0]
    for further in statements[1:]:
        whole = _joined(whole, further, progress)
    return crs_of_facts(whole.wkt, whole.facts, progress)


def _joined(used: _Statement, further: _Statement, progress: Progress) -> _Statement:
    """Return a statement with its missing facts filled from another one; warn of differences."""
    contradicts_map = _contradicts_map(used.facts, further.facts)
    if contradicts_map or _contradicts_heights(used.facts, further.facts):
        progress.warning(
            f"The records of the file contradict each other: its CRS is {_shown(used)} by the"
            f" {used.kind}, which is used, and {_shown(further)} by the {further.kind}. If the"
            f" first is wrong, give the CRS: {how_to_state()}."
        )
    has_text = used.wkt is not None or contradicts_map or further.wkt is None
    first, second = (used, further) if has_text else (further, used)
    facts, more = first.facts, second.facts
    if not contradicts_map:
        facts = facts._replace(
            horizontal_unit=used.facts.horizontal_unit or further.facts.horizontal_unit,
            epsg=facts.epsg or more.epsg,
        )
    unit = used.facts.vertical_unit or further.facts.vertical_unit
    if used.facts.vertical_unit is None and unit and not same_unit(unit, facts.horizontal_unit):
        progress.info(f"The unit of the heights, {unit_name(unit)}, is that of the {further.kind}.")
    facts = facts._replace(
        vertical_unit=unit,
        has_vertical=facts.has_vertical or more.has_vertical,
        datum=used.facts.datum or further.facts.datum,
    )
    return _Statement(used.kind, first.wkt, facts)


def _contradicts_map(first: WktFacts, second: WktFacts) -> bool:
    """Return whether two statements differ in x and y, as far as both state them."""
    if not (_states_map(first) and _states_map(second)):
        return False
    if first.is_geographic != second.is_geographic:
        return True
    units = first.horizontal_unit, second.horizontal_unit
    if not first.is_geographic and all(units) and not same_unit(*units):
        return True
    return bool(first.epsg and second.epsg and first.epsg != second.epsg)


def _states_map(facts: WktFacts) -> bool:
    return bool(facts.is_geographic or facts.epsg or facts.horizontal_unit)


def _contradicts_heights(first: WktFacts, second: WktFacts) -> bool:
    """Return whether two statements differ in heights, as far as both state them."""
    units = first.vertical_unit, second.vertical_unit
    return (all(units) and not same_unit(*units)) or bool(is_other_datum(first.datum, second.datum))


def _shown(statement: _Statement) -> str:
    """Return the stated name and units of a statement in words."""
    facts = statement.facts
    words = [named_with_heights(facts.name, facts.datum) or "without a name"]
    if facts.is_geographic:
        words.append("in degrees")
    elif facts.horizontal_unit:
        words.append(f"in {unit_name(facts.horizontal_unit)}")
    height = f", height {unit_name(facts.vertical_unit)}" if facts.vertical_unit else ""
    return " ".join(words) + height


def _statement_of(keys: GeoKeys, progress: Progress) -> _Statement:
    """Return the statement of GeoTIFF keys, with name and well-known text of their EPSG code."""
    text = wkt_of_epsg(keys.epsg) if keys.epsg else None
    facts = read_wkt(text) if text else None
    if facts is None:
        name = keys.name or (f"EPSG:{keys.epsg}" if keys.epsg else "")
        facts = WktFacts(name, None, None, False, keys.is_geographic, keys.epsg, name)
        text = None
    for code in keys.unknown_units:
        progress.warning(f"The unit of the CRS, EPSG code {code}, is not known.")
    unit, datum = _vertical_of(keys)
    facts = facts._replace(
        # A code can be that of a compound CRS.
        epsg=facts.epsg or keys.epsg,
        horizontal_unit=_horizontal_unit(keys, facts, progress),
        vertical_unit=unit or facts.vertical_unit,
        has_vertical=bool(unit or datum) or facts.has_vertical,
        datum=datum or facts.datum,
    )
    return _Statement(_KEYS, text, facts)


def _horizontal_unit(keys: GeoKeys, facts: WktFacts, progress: Progress) -> float | None:
    """Return the horizontal unit of the keys, or that of the EPSG code if they have none."""
    stated, known = keys.horizontal_unit, facts.horizontal_unit
    if stated and known and not facts.is_geographic and not math.isclose(stated, known):
        progress.warning(
            f"The CRS {facts.name} has the unit {unit_name(known)}, but the file states"
            f" {unit_name(stated)}, which is used."
        )
    return stated or known


def _vertical_of(keys: GeoKeys) -> tuple[float | None, VerticalDatum | None]:
    code, unit, datum = keys.vertical_epsg, keys.vertical_unit, None
    text = wkt_of_epsg(code) if code else None
    # `read_wkt` needs a horizontal CRS as well.
    facts = read_wkt(f'LOCAL_CS["",UNIT["metre",1]],{text}') if text else None
    if facts is not None and facts.has_vertical:
        unit, datum = unit or facts.vertical_unit, facts.datum
    elif code:
        datum = VerticalDatum(keys.vertical_name or f"EPSG:{code}", crs_epsg=code)
    elif keys.datum_epsg:
        name = keys.vertical_name or f"datum EPSG:{keys.datum_epsg}"
        datum = VerticalDatum(name, epsg=keys.datum_epsg)
    elif keys.is_above_ellipsoid:
        datum = VerticalDatum("ellipsoidal height", is_ellipsoid=True)
    return unit, datum
