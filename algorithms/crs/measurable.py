"""Refuses a CRS in which lengths cannot be measured, and says what to do."""

from __future__ import annotations

import functools
import math
import re
from typing import Sequence

from ..core.errors import BareEarthError
from ..core.points import Box
from ..core.words import names_in_use
from .stated import how_to_state
from .system import Crs

# Largest longitude and latitude in degrees; some longitudes are counted from 0 to 360.
_FARTHEST_EAST = 360.0
_FARTHEST_NORTH = 90.0
# Degrees: the largest step of coordinates, about 10 m, and the largest side of a file.
_DEGREE_STEP = 1e-4
_MOST_DEGREES = 2.0
_MERCATOR = re.compile(r"(?:PROJECTION|METHOD)\s*[\[(]\s*\"([^\"]*mercator[^\"]*)\"", re.IGNORECASE)
_TRUE_ELSEWHERE = ("transverse", "oblique", "hotine", "space")
# Codes of Web Mercator, for GeoTIFF keys without well-known text.
_WEB_MERCATOR = {3785, 3857, 41001, 54004, 102100, 102113, 900913}
_PARAMETER = re.compile(r"PARAMETER\s*[\[(]\s*\"([^\"]+)\"\s*,\s*([-+.0-9eE]+)", re.IGNORECASE)
# Metres: the radius of the earth. Its flattening changes lengths here by less than 0.4 %.
_RADIUS = 6378137.0
# The share by which lengths may be wrong. In national CRS they are far better.
_MOST_WRONG = 0.05


def wrong_lengths(scale: float) -> str:
    """Return words that say how wrong lengths are, given the `length_scale`; empty if they are good
    enough.
    """
    if abs(scale - 1.0) <= _MOST_WRONG:
        return ""
    wrong = f"{scale:.2f} times too long" if scale > 1.0 else f"too short ({scale:.2f} times)"
    return f"lengths are {wrong} at this latitude"


def require_measurable(subject: object, crs: Crs, box: Box | None = None) -> None:
    """Refuse coordinates in which distances cannot be measured, as in degrees or Web Mercator; the
    error names the subject, a file or "The survey".
    """
    # The box is from a header, which may be wrong.
    if crs.is_geographic:
        raise _not_projected(subject, crs, box)
    wrong = wrong_lengths(length_scale(crs, box))
    if wrong:
        raise BareEarthError(
            f"{subject} is in a Mercator projection ({crs.name}), in which {wrong}, so that nothing"
            f" can be measured in it. {how_to_reproject()} If this is the wrong CRS, give the right"
            f" one: {how_to_state()}."
        )


def refuse_degrees(
    subject: object, lowest: Sequence[float], highest: Sequence[float], step: float
) -> None:
    """Refuse points without a CRS whose smallest and largest x, y and z look like degrees beside
    heights, given the step of x and y.
    """
    # Local coordinates of a scan have steps of a millimetre or so, begin near 0, and are not higher
    # than wide if they are as small as this.
    west, south, low, east, north, high = (*lowest, *highest)
    box = west, south, east, north
    side = max(east - west, north - south)
    if not _can_be_degrees(box) or step > _DEGREE_STEP or side > _MOST_DEGREES:
        return
    if high - low > side and max(map(abs, box)) > _MOST_DEGREES:
        raise BareEarthError(
            f"{subject} does not say its CRS, and its coordinates look like degrees (x {west:.7g}"
            f" to {east:.7g}, y {south:.7g} to {north:.7g}), in which nothing can be measured."
            f" {how_to_reproject()} If they are metres, give the CRS: {how_to_state()}."
        )


def length_scale(crs: Crs, box: Box | None) -> float:
    """Return the length of a true metre in metres of a CRS, in the middle of a box."""
    # It is 1 except for Mercator projections, where it grows with the latitude. Other projections
    # of the world are rare for point clouds.
    true_scale = _mercator(crs.wkt or "", crs.epsg)
    if true_scale is None or box is None or not all(map(math.isfinite, box)):
        return 1.0
    at_standard, north = true_scale
    y = ((box[1] + box[3]) / 2.0 - north) * crs.horizontal_unit
    return at_standard * math.cosh(min(max(y / (_RADIUS * at_standard), -20.0), 20.0))


@functools.lru_cache(maxsize=16)
def _mercator(wkt: str, epsg: int | None) -> tuple[float, float] | None:
    """Return the scale at the equator and the false northing of a Mercator projection."""
    method = _MERCATOR.search(wkt)
    if method is None:
        return (1.0, 0.0) if epsg in _WEB_MERCATOR else None
    if any(word in method[1].lower() for word in _TRUE_ELSEWHERE):
        return None
    scale, north = 1.0, 0.0
    for name, value in _PARAMETER.findall(wkt):
        words = name.lower().replace("_", " ")
        if words.startswith("scale factor"):
            scale *= float(value)
        elif "standard parallel" in words:
            scale *= math.cos(math.radians(float(value)))
        elif words == "false northing":
            north = float(value)
    return scale, north


def _not_projected(subject: object, crs: Crs, box: Box | None) -> BareEarthError:
    """Return the error for degrees, or for coordinates that are wrongly stated to be degrees."""
    if box is not None and not _is_geocentric(crs) and not _can_be_degrees(box):
        return BareEarthError(
            f"{subject} is not in a projected CRS as far as its records or you say ({crs.name}),"
            f" but its coordinates cannot be degrees (x from {box[0]:.10g}, y from {box[1]:.10g})."
            f" Give the right CRS: {how_to_state()}."
        )
    return BareEarthError(
        f"{subject} is not in a projected CRS ({crs.name}), so that nothing can be measured in it."
        f" {how_to_reproject()} If this is the wrong CRS, give the right one: {how_to_state()}."
    )


def _can_be_degrees(box: Box) -> bool:
    west, south, east, north = box
    return (
        max(abs(west), abs(east)) <= _FARTHEST_EAST
        and max(abs(south), abs(north)) <= _FARTHEST_NORTH
    )


def _is_geocentric(crs: Crs) -> bool:
    text = (crs.wkt or "").upper()
    return text.startswith("GEOCCS") or "CS[CARTESIAN,3]" in text.replace(" ", "")


def how_to_reproject() -> str:
    """Return what to do with points in which nothing can be measured."""
    return f"Reproject it first, {names_in_use().reproject}."
