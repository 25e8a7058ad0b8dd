"""Compares coordinate reference systems."""

from __future__ import annotations

from typing import Sequence

from .provider import are_same
from .system import Crs, same_unit, unit_name
from .wkt import VerticalDatum


def is_same_crs(first: Crs, second: Crs) -> bool:
    """Return whether two CRS have the same horizontal CRS, units and vertical datum."""
    # Programs write the same CRS differently, so codes and names are compared, not texts. A missing
    # CRS differs from all others; a missing vertical datum does not differ from any other.
    if first == second:
        return True
    if Crs() in (first, second) or not has_same_units(first, second):
        return False
    if is_other_datum(first.datum, second.datum):
        return False
    if first.epsg and second.epsg:
        return first.epsg == second.epsg
    return _map_name(first) == _map_name(second)


def is_other_datum(first: VerticalDatum | None, second: VerticalDatum | None) -> bool | None:
    """Return whether two vertical datums differ, None if that is not certain."""
    # It is not certain if a datum is missing, or if programs use different names.
    if first is None or second is None:
        return None
    names = {_bare(datum.name) for datum in (first, second)}
    for codes in ((first.epsg, second.epsg), (first.crs_epsg, second.crs_epsg)):
        if all(codes) and codes[0] == codes[1]:
            return False
    if ("" not in names and len(names) == 1) or (first.is_ellipsoid and second.is_ellipsoid):
        return False
    if first.is_ellipsoid != second.is_ellipsoid or (first.epsg and second.epsg):
        return True
    # Two vertical CRS can have one datum and different units, so their codes alone say nothing.
    has_codes = all(datum.epsg or datum.crs_epsg for datum in (first, second))
    return True if has_codes and "" not in names else None


def other_datums(names: Sequence[object], first: Crs, second: Crs) -> str:
    """Return a sentence if the heights of two things are not above the same datum, else nothing."""
    if not is_other_datum(first.datum, second.datum):
        return ""
    return (
        f"The heights of {names[0]} and {names[1]} are not above the same datum:"
        f" {described(first)} and {described(second)}."
    )


def is_same_map(first: Crs, second: Crs) -> bool:
    """Return whether x and y of two stated CRS are the same, whatever their heights."""
    if first.is_geographic != second.is_geographic or not same_unit(
        first.horizontal_unit, second.horizontal_unit
    ):
        return False
    if first.epsg and second.epsg:
        return first.epsg == second.epsg
    if _map_name(first) == _map_name(second):
        return True
    return bool(first.wkt and second.wkt and are_same(first.wkt, second.wkt))


def has_same_units(first: Crs, second: Crs) -> bool:
    """Return whether two CRS have the same units of x and y, and of heights."""
    return (
        first.is_geographic == second.is_geographic
        and same_unit(first.horizontal_unit, second.horizontal_unit)
        and same_unit(first.vertical_unit, second.vertical_unit)
    )


def described(crs: Crs) -> str:
    """Return name and units of a CRS, for messages."""
    if crs == Crs():
        return "none stated"
    name = named_with_heights(crs.name, crs.datum)
    if crs.is_geographic:
        return f"{name} in degrees"
    return f"{name} in {unit_name(crs.horizontal_unit)}, height {unit_name(crs.vertical_unit)}"


def named_with_heights(crs: str, datum: VerticalDatum | None) -> str:
    """Return the name of a CRS, followed by that of its vertical CRS if it is not part of it."""
    if datum is None or _bare(datum.crs) in _bare(crs):
        return crs
    return f"{crs} + {datum.crs}" if crs else datum.crs


def _map_name(crs: Crs) -> str:
    return _bare(crs.map_name or crs.name)


def _bare(name: str) -> str:
    """Return only the letters and digits of a name, since programs write other characters
    differently.
    """
    return "".join(filter(str.isalnum, name)).lower()
