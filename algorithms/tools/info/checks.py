"""Checks of a file as lidR's `las_check` has them: what cannot be right, with counts.

References
----------
ASPRS (2019): LAS specification 1.4, R15. Roussel et al. (2020): lidR, an R package for analysis of
airborne laser scanning data, Remote Sensing of Environment 251.
"""

from __future__ import annotations

import math

import numpy as np

from ...crs.system import Crs
from ...las import header as fields
from ...las.crs_records import GEOKEY_RECORDS, WKT_RECORD
from ...las.lasfile import FIRST_EXTENDED_FORMAT, LasFile
from ...las.return_numbers import begin_at_zero
from .tally import Tally

# What is counted by each check; 0 is right.
CHECKS = {
    "duplicate_points": "points at x, y and z of an earlier point",
    "ground_at_one_place": "ground points at x and y of another ground point, with another z",
    "return_number_0": "points with return number 0",
    "return_number_too_large": "points whose return number is larger than their number of returns",
    "repeated_returns": "points with GPS time, strip and return number of an earlier point",
    "gps_time_0": "points with GPS time 0, while others have one",
    "gps_time_impossible": "points whose GPS time is not of the type that the header states",
    "gps_time_gaps": "gaps of more than a second in the GPS times of a strip",
    "scan_angle_impossible": "points whose scan angle is impossible",
    "colours_of_8_bits": "points whose colours use 8 of their 16 bits",
    "reserved_classes": "points of classes that the LAS specification reserves",
    "coordinate_limits": "points with a coordinate at the limit of 32 bits, probably cut off",
    "outside_box": "points outside of the box in the header",
    "box_too_large": "sides of the box in the header at which no point lies",
    "header_counts": "numbers of points in the header that are wrong, in total or by return",
    "unusual_scale": "scale factors that are not 1, 2, 2.5 or 5 times a power of ten",
    "no_crs": "files without a CRS",
    "crs_record_unlike_header": "CRS records of another kind than the header announces",
}  # fmt: skip
_WEEK_BIT = 0x01  # of the global encoding: 0 if GPS times are seconds of a week
_WKT_BIT = 0x10
_USUAL = (1.0, 2.0, 2.5, 5.0, 10.0)
_STEPS_OFF = 1.0  # by which a header may differ, since headers are rounded
# Reserved by the tables of the specification for point formats 0 to 5, and 6 to 10, apart from the
# classes of its profile for bathymetry.
_RESERVED = (10, 11, *range(13, 32))
_RESERVED_EXTENDED = (*range(23, 40), *range(46, 64))


def counts_of(layout: LasFile, crs: Crs, tally: Tally) -> dict[str, int | None]:
    """Return what each check counts in a file; None if it cannot be checked."""
    return {
        **dict.fromkeys(CHECKS),
        **_of_points(layout, tally),
        **_of_returns(layout, tally),
        **_of_times(layout, tally),
        **_of_header(layout, tally),
        "no_crs": int(crs == Crs()),
        "crs_record_unlike_header": int(_is_other_record(layout)),
    }


def _of_points(layout: LasFile, tally: Tally) -> dict[str, int | None]:
    is_extended = layout.point_format >= FIRST_EXTENDED_FORMAT
    reserved = list(_RESERVED_EXTENDED if is_extended else _RESERVED)
    in_8_bits = layout.count if 0 < tally.brightest < 256 else 0
    return {
        "duplicate_points": tally.places.repeated(),
        "ground_at_one_place": tally.ground_places.repeated() - tally.ground.repeated(),
        "scan_angle_impossible": tally.steep,
        "colours_of_8_bits": in_8_bits if tally.has_colours else None,
        "reserved_classes": int(tally.classes[reserved].sum()),
        "coordinate_limits": tally.at_limit,
        "outside_box": tally.outside,
    }


def _of_returns(layout: LasFile, tally: Tally) -> dict[str, int | None]:
    number, total = np.indices(tally.pulses.shape)
    numbers, totals = begin_at_zero(tally.pulses)
    is_too_large = number + numbers > total + totals
    counts_returns = layout.has_gps_times and "return_number" not in tally.zero
    return {
        "return_number_0": int(tally.pulses[0].sum()),
        "return_number_too_large": int(tally.pulses[is_too_large].sum()),
        "repeated_returns": tally.returns.repeated() if counts_returns else None,
    }


def _of_times(layout: LasFile, tally: Tally) -> dict[str, int | None]:
    if not layout.has_gps_times:
        return {}
    times = tally.times
    # LAS 1.0 and 1.1 do not state the type.
    is_week = layout.minor_version >= 2 and not layout.global_encoding & _WEEK_BIT
    return {
        "gps_time_0": times.zero if times.found() else 0,
        "gps_time_impossible": times.damaged + (times.beyond_week if is_week else 0),
        "gps_time_gaps": times.gaps_in_strips(),
    }


def _of_header(layout: LasFile, tally: Tally) -> dict[str, int | None]:
    sides = 0
    corners = (layout.minimum, tally.lowest, 1.0), (layout.maximum, tally.highest, -1.0)
    for stated, found, inwards in corners if layout.count else ():
        for side, whole, scale, offset in zip(stated, found, layout.scale, layout.offset):
            sides += not inwards * (whole - (side - offset) / scale) <= _STEPS_OFF
    is_new = layout.minor_version >= 4
    legacy = fields.LEGACY_COUNT.get(layout.header)
    returns = (fields.RETURNS if is_new else fields.LEGACY_RETURNS).get(layout.header)
    found = tally.pulses.sum(axis=1)[1 : 1 + len(returns)]
    wrong = sum(int(count) != stated for count, stated in zip(found, returns))
    return {
        "box_too_large": sides,
        "header_counts": wrong + (legacy not in (0, layout.count)),
        "unusual_scale": sum(not _is_usual(scale) for scale in layout.scale),
    }


def _is_usual(scale: float) -> bool:
    mantissa = scale / 10.0 ** math.floor(math.log10(scale))
    return any(math.isclose(mantissa, usual, rel_tol=1e-6) for usual in _USUAL)


def _is_other_record(layout: LasFile) -> bool:
    """Return whether the records of the CRS are not of the kind that the header states."""
    has_text, has_keys = (layout.vlr(key) is not None for key in (WKT_RECORD, GEOKEY_RECORDS[0]))
    if not (has_text or has_keys):
        return False
    wants_text = layout.global_encoding & _WKT_BIT or layout.point_format >= FIRST_EXTENDED_FORMAT
    return not (has_text if wants_text else has_keys)
