"""A coordinate reference system: name, units and well-known text."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from ..core.progress import SILENT, Progress
from .wkt import VerticalDatum, WktFacts, is_wkt2, read_wkt

_SURVEY_FOOT = 1200 / 3937
_UNIT_NAMES = {1.0: "metre", 0.3048: "foot", _SURVEY_FOOT: "US survey foot"}
_SYMBOLS = {"metre": "m", "foot": "ft", "US survey foot": "US survey ft"}


@dataclass(frozen=True)
class Crs:
    """A coordinate reference system."""

    wkt: str | None = None
    name: str = ""  # empty if unknown
    horizontal_unit: float = 1.0  # metres
    vertical_unit: float = 1.0  # metres
    is_geographic: bool = False  # in degrees, or geocentric, so that nothing can be measured
    epsg: int | None = None  # of the horizontal CRS
    map_name: str = ""  # of the horizontal CRS, if `name` names a vertical one as well
    datum: VerticalDatum | None = None  # None if it is not stated


def same_unit(first: float | None, second: float | None) -> bool:
    """Return whether two units are equal; the two kinds of feet differ by two millionths."""
    return first is not None and second is not None and math.isclose(first, second, rel_tol=1e-8)


def unit_name(metres: float) -> str:
    """Return the name of a unit, such as "US survey foot", given its size in metres."""
    for known, name in _UNIT_NAMES.items():
        if same_unit(metres, known):
            return name
    return f"{metres:g} m"


def unit_symbol(metres: float) -> str:
    """Return the symbol of a unit, such as "m", given its size in metres."""
    name = unit_name(metres)
    return _SYMBOLS.get(name, f"units of {name}")


def unit_size(symbol: str) -> float:
    """Return the metres in a unit, given its `unit_symbol`, such as "ft" or "units of 0.5 m"."""
    for metres in _UNIT_NAMES:
        if unit_symbol(metres) == symbol:
            return metres
    return float(symbol.split()[-2])


def crs_of_wkt(text: str, progress: Progress = SILENT) -> Crs | None:
    """Return the CRS that WKT 1 or WKT 2 describes, None if it describes none; report units that
    are assumed.
    """
    facts = read_wkt(text)
    return None if facts is None else crs_of_facts(text, facts, progress)


def compound_wkt(crs: Crs) -> str | None:
    """Return the well-known text of a CRS with the unit of its heights, None if it has no text, or
    the text has another horizontal unit.
    """
    # Text that was made from GeoTIFF keys describes only the horizontal CRS, so a vertical CRS is
    # added for a different unit of heights.
    facts = read_wkt(crs.wkt) if crs.wkt else None
    if crs.wkt is None or facts is None or crs.is_geographic:
        return crs.wkt
    plain = crs_of_facts(crs.wkt, facts)
    if not math.isclose(plain.horizontal_unit, crs.horizontal_unit, rel_tol=1e-9):
        return None
    has_unit = math.isclose(plain.vertical_unit, crs.vertical_unit, rel_tol=1e-9)
    if has_unit and (facts.has_vertical or crs.datum is None):
        return crs.wkt
    # A vertical CRS cannot be added to a CRS that has one.
    return None if facts.has_vertical else _with_heights(crs, crs.wkt)


def _with_heights(crs: Crs, wkt: str) -> str:
    """Return the text of a horizontal CRS with a vertical CRS added, in the same version of WKT."""
    datum = crs.datum or VerticalDatum("heights", "unknown")
    title, place = f"{crs.map_name or crs.name} + {datum.crs}", datum.name or datum.crs
    unit = f'["{unit_name(crs.vertical_unit)}",{crs.vertical_unit!r}]'
    if is_wkt2(wkt):
        return (
            f'COMPOUNDCRS["{title}",{wkt},VERTCRS["{datum.crs}",VDATUM["{place}"],'
            f'CS[vertical,1],AXIS["height",up,LENGTHUNIT{unit}]{_id(datum.crs_epsg, "ID")}]]'
        )
    kind = 2002 if datum.is_ellipsoid else 2005
    return (
        f'COMPD_CS["{title}",{wkt},VERT_CS["{datum.crs}",'
        f'VERT_DATUM["{place}",{kind}{_id(datum.epsg, "AUTHORITY")}],UNIT{unit},AXIS["Up",UP]]]'
    )


def _id(code: int | None, keyword: str) -> str:
    if code is None:
        return ""
    return f',{keyword}["EPSG",{code}]' if keyword == "ID" else f',{keyword}["EPSG","{code}"]'


def crs_of_facts(text: str | None, facts: WktFacts, progress: Progress = SILENT) -> Crs:
    """Return the CRS with the properties of a well-known text; report units that are assumed."""
    crs = Crs(
        text, facts.name, 1.0, 1.0, facts.is_geographic, facts.epsg, facts.map_name, facts.datum
    )
    if crs.is_geographic:
        return replace(crs, vertical_unit=facts.vertical_unit or 1.0)
    horizontal, vertical = facts.horizontal_unit, facts.vertical_unit
    if horizontal is None:
        progress.warning(
            f"The unit of the CRS {facts.name or 'of the file'} is not known: its coordinates are"
            " taken as metres."
        )
        horizontal = 1.0
    if vertical is None:
        vertical = horizontal
        if facts.has_vertical:
            progress.warning(
                "The unit of the heights is not known: that of x and y is used,"
                f" {unit_name(horizontal)}."
            )
        elif not math.isclose(horizontal, 1.0):
            progress.info(
                "The unit of the heights is not stated: that of x and y is used,"
                f" {unit_name(horizontal)}."
            )
    return replace(crs, horizontal_unit=horizontal, vertical_unit=vertical)
