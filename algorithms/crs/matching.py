"""Whether two coordinate reference systems are the same."""

from __future__ import annotations

import math

from .provider import are_same
from .system import Crs, unit_name


def is_same_crs(one: Crs, other: Crs) -> bool:
    """Return whether two CRS and their units, also those of heights, are the same.

    Programs write the same CRS differently, so codes and names are compared, not texts. A CRS that
    is not stated differs from all others.
    """
    if one == other:
        return True
    if Crs() in (one, other) or not has_same_units(one, other):
        return False
    if one.epsg and other.epsg:
        return one.epsg == other.epsg
    return _bare(one.name) == _bare(other.name)


def is_same_map(one: Crs, other: Crs) -> bool:
    """Return whether x and y of two stated CRS are the same, whatever their heights."""
    if one.is_geographic != other.is_geographic or not _are_close(
        one.horizontal_unit, other.horizontal_unit
    ):
        return False
    if one.epsg and other.epsg:
        return one.epsg == other.epsg
    if _bare(one.name) == _bare(other.name):
        return True
    return bool(one.wkt and other.wkt and are_same(one.wkt, other.wkt))


def has_same_units(one: Crs, other: Crs) -> bool:
    """Return whether two CRS have the same units of x and y, and of heights."""
    return (
        one.is_geographic == other.is_geographic
        and _are_close(one.horizontal_unit, other.horizontal_unit)
        and _are_close(one.vertical_unit, other.vertical_unit)
    )


def described(crs: Crs) -> str:
    """Return name and units of a CRS, for messages."""
    if crs == Crs():
        return "none stated"
    if crs.is_geographic:
        return f"{crs.name} in degrees"
    return f"{crs.name} in {unit_name(crs.horizontal_unit)}, height {unit_name(crs.vertical_unit)}"


def _are_close(one: float, other: float) -> bool:
    # The two kinds of feet differ by two millionths.
    return math.isclose(one, other, rel_tol=1e-8)


def _bare(name: str) -> str:
    """Return only the letters and digits of a name, since programs write the rest differently."""
    return "".join(filter(str.isalnum, name)).lower()
