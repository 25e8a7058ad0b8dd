"""Whether two coordinate reference systems are the same."""

from __future__ import annotations

from .provider import are_same
from .system import Crs, same_unit, unit_name
from .wkt import VerticalDatum


def is_same_crs(one: Crs, other: Crs) -> bool:
    """Return whether two CRS, their units and what heights are measured from are the same."""
    # Programs write the same CRS differently, so codes and names are compared, not texts. A CRS
    # that is not stated differs from all others; a vertical datum that is not stated differs from
    # none.
    if one == other:
        return True
    if Crs() in (one, other) or not has_same_units(one, other):
        return False
    if is_other_datum(one.datum, other.datum):
        return False
    if one.epsg and other.epsg:
        return one.epsg == other.epsg
    return _map_name(one) == _map_name(other)


def is_other_datum(one: VerticalDatum | None, other: VerticalDatum | None) -> bool | None:
    """Return whether two vertical datums differ, None if that is not certain."""
    # Programs also use names of their own, or one is not stated.
    if one is None or other is None:
        return None
    names = {_bare(datum.name) for datum in (one, other)}
    for codes in ((one.epsg, other.epsg), (one.crs_epsg, other.crs_epsg)):
        if all(codes) and codes[0] == codes[1]:
            return False
    if ("" not in names and len(names) == 1) or (one.is_ellipsoid and other.is_ellipsoid):
        return False
    if one.is_ellipsoid != other.is_ellipsoid or (one.epsg and other.epsg):
        return True
    # Two vertical CRS can have one datum and different units, so their codes alone say nothing.
    has_codes = all(datum.epsg or datum.crs_epsg for datum in (one, other))
    return True if has_codes and "" not in names else None


def is_same_map(one: Crs, other: Crs) -> bool:
    """Return whether x and y of two stated CRS are the same, whatever their heights."""
    if one.is_geographic != other.is_geographic or not same_unit(
        one.horizontal_unit, other.horizontal_unit
    ):
        return False
    if one.epsg and other.epsg:
        return one.epsg == other.epsg
    if _map_name(one) == _map_name(other):
        return True
    return bool(one.wkt and other.wkt and are_same(one.wkt, other.wkt))


def has_same_units(one: Crs, other: Crs) -> bool:
    """Return whether two CRS have the same units of x and y, and of heights."""
    return (
        one.is_geographic == other.is_geographic
        and same_unit(one.horizontal_unit, other.horizontal_unit)
        and same_unit(one.vertical_unit, other.vertical_unit)
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
    """Return the name of a CRS with that of its heights, if it lacks this."""
    if datum is None or _bare(datum.crs) in _bare(crs):
        return crs
    return f"{crs} + {datum.crs}" if crs else datum.crs


def _map_name(crs: Crs) -> str:
    return _bare(crs.map_name or crs.name)


def _bare(name: str) -> str:
    """Return only the letters and digits of a name, since programs write the rest differently."""
    return "".join(filter(str.isalnum, name)).lower()
