"""A coordinate reference system: name, units and well-known text."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from ..core.progress import SILENT, Progress
from .geokeys import GeoKeys
from .provider import wkt_of_epsg
from .wkt import WktFacts, read_wkt

_SURVEY_FOOT = 1200 / 3937
_UNIT_NAMES = {1.0: "metre", 0.3048: "foot", _SURVEY_FOOT: "US survey foot"}
_SYMBOLS = {"metre": "m", "foot": "ft", "US survey foot": "US survey ft"}


@dataclass(frozen=True)
class Crs:
    """A coordinate reference system.

    Attributes
    ----------
    wkt : str or None
        The CRS as well-known text.
    name : str
        Its name; empty if there is none.
    horizontal_unit, vertical_unit : float
        Metres in one unit.
    is_geographic : bool
        Whether the coordinates are degrees, or geocentric, so that nothing can be measured.
    epsg : int or None
        EPSG code of the horizontal CRS.
    """

    wkt: str | None = None
    name: str = ""
    horizontal_unit: float = 1.0
    vertical_unit: float = 1.0
    is_geographic: bool = False
    epsg: int | None = None


def unit_name(metres: float) -> str:
    """Return the name of a unit, given its size in metres.

    Examples
    --------
    >>> unit_name(0.3048006096)
    'US survey foot'
    """
    for known, name in _UNIT_NAMES.items():
        if math.isclose(metres, known, rel_tol=1e-8):
            return name
    return f"{metres:g} m"


def unit_symbol(metres: float) -> str:
    """Return the symbol of a unit, given its size in metres.

    Examples
    --------
    >>> unit_symbol(1.0)
    'm'
    """
    name = unit_name(metres)
    return _SYMBOLS.get(name, f"units of {name}")


def unit_size(symbol: str) -> float:
    """Return the metres in a unit, given what `unit_symbol` returned.

    Examples
    --------
    >>> unit_size("ft"), unit_size("units of 0.5 m")
    (0.3048, 0.5)
    """
    for metres in _UNIT_NAMES:
        if unit_symbol(metres) == symbol:
            return metres
    return float(symbol.split()[-2])


def crs_of_wkt(text: str, progress: Progress = SILENT) -> Crs | None:
    """Return the CRS that well-known text describes; None if it describes none.

    Parameters
    ----------
    text : str
        WKT 1 or WKT 2.
    progress : Progress
        Receives messages on units that are not stated, but assumed.
    """
    facts = read_wkt(text)
    return None if facts is None else _crs_of(text, facts, progress)


def crs_of_geokeys(keys: GeoKeys, progress: Progress = SILENT) -> Crs:
    """Return the CRS that GeoTIFF keys describe.

    Parameters
    ----------
    keys : GeoKeys
        The keys; their EPSG code gives the name and the well-known text.
    progress : Progress
        Receives messages on units that are assumed or not known.
    """
    text = wkt_of_epsg(keys.epsg) if keys.epsg else None
    facts = read_wkt(text) if text else None
    if facts is None:
        name = keys.name or (f"EPSG:{keys.epsg}" if keys.epsg else "")
        facts = WktFacts(name, None, None, False, keys.is_geographic, keys.epsg)
        text = None
    for code in keys.unknown_units:
        progress.warning(f"The unit of the CRS, EPSG code {code}, is not known.")
    facts = facts._replace(
        epsg=keys.epsg,
        horizontal_unit=_stated_unit(keys, facts, progress),
        **_vertical_of(keys),
    )
    return _crs_of(text, facts, progress)


def compound_wkt(crs: Crs) -> str | None:
    """Return the well-known text of a CRS, including the unit of its heights.

    Text made from GeoTIFF keys describes only the horizontal CRS; a different unit of heights is
    added to it. None if the CRS has no text, or the text has another horizontal unit.

    Examples
    --------
    >>> compound_wkt(Crs('LOCAL_CS["site",UNIT["metre",1]]', "site", vertical_unit=0.3048))[:14]
    'COMPD_CS["site'
    """
    facts = read_wkt(crs.wkt) if crs.wkt else None
    if facts is None or crs.is_geographic:
        return crs.wkt
    plain = _crs_of(crs.wkt, facts, SILENT)
    if not math.isclose(plain.horizontal_unit, crs.horizontal_unit, rel_tol=1e-9):
        return None
    if math.isclose(plain.vertical_unit, crs.vertical_unit, rel_tol=1e-9):
        return crs.wkt
    return (
        f'COMPD_CS["{facts.name} + heights",{crs.wkt},VERT_CS["heights",'
        f'VERT_DATUM["unknown",2005],UNIT["{unit_name(crs.vertical_unit)}",'
        f'{crs.vertical_unit!r}],AXIS["Up",UP]]]'
    )


def _stated_unit(keys: GeoKeys, facts: WktFacts, progress: Progress) -> float | None:
    """Return the horizontal unit of the keys, or else of the EPSG code."""
    stated, known = keys.horizontal_unit, facts.horizontal_unit
    if stated and known and not facts.is_geographic and not math.isclose(stated, known):
        progress.warning(
            f"The CRS {facts.name} has the unit {unit_name(known)}, but the file states"
            f" {unit_name(stated)}, which is used."
        )
    return stated or known


def _vertical_of(keys: GeoKeys) -> dict[str, float | bool | None]:
    """Return the fields of `WktFacts` for the heights."""
    unit = keys.vertical_unit
    text = wkt_of_epsg(keys.vertical_epsg) if unit is None and keys.vertical_epsg else None
    if text:
        # `read_wkt` needs a horizontal CRS as well.
        facts = read_wkt(f'LOCAL_CS["",UNIT["metre",1]],{text}')
        unit = facts.vertical_unit if facts else None
    return {"vertical_unit": unit, "has_vertical": unit is not None}


def _crs_of(text: str | None, facts: WktFacts, progress: Progress) -> Crs:
    """Return the CRS, with assumed units if none are stated, and tell the user."""
    crs = Crs(text, facts.name, 1.0, 1.0, facts.is_geographic, facts.epsg)
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
