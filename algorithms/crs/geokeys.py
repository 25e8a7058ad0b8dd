"""Units and codes of a CRS given as GeoTIFF keys.

References
----------
OGC GeoTIFF Standard 1.1 (OGC 19-008r4), and the LAS 1.2 specification on the records 34735 to 34737
of ``LASF_Projection``.
"""

from __future__ import annotations

import struct
from typing import Any, NamedTuple

from .wkt import is_unit

# Numbers of keys.
_MODEL = 1024
_CITATION = 1026
_GEOGRAPHIC_CODE = 2048
_GEOGRAPHIC_CITATION = 2049
_PROJECTED_CODE = 3072
_PROJECTED_CITATION = 3073
_LINEAR_UNIT = 3076
_LINEAR_UNIT_SIZE = 3077
_VERTICAL_CODE = 4096
_VERTICAL_CITATION = 4097
_VERTICAL_DATUM = 4098
_VERTICAL_UNIT = 4099
# The record that has the value of a key, if the key itself does not: of doubles, or of texts.
_DOUBLES = 34736
_TEXTS = 34737
# Values of the key of the model.
_PROJECTED = 1
_GEOGRAPHIC = 2
_GEOCENTRIC = 3
_USER_DEFINED = 32767
# In GeoTIFF 1.0, vertical CRS had the codes of datums, and heights above ellipsoids these codes.
_OLD_DATUMS = range(5101, 5107)
_OLD_ELLIPSOIDS = range(5001, 5034)

# Metres in one unit, by EPSG code; a fraction if the unit is defined as one.
_UNITS = {
    9001: 1.0,
    9002: 0.3048,
    9003: 1200 / 3937,
    9005: 0.3047972654,
    9014: 1.8288,
    9030: 1852.0,
    9031: 1.0000135965,
    9036: 1000.0,
    9037: 0.9143917962,
    9040: 0.9143984146160287,
    9041: 0.3047994715386762,
    9042: 20.116765121552632,
    9080: 0.3047995102481469,
    9093: 1609.344,
    9094: 0.304799710181509,
    9095: 0.3048007491,
    9096: 0.9144,
    9098: 0.201168,
}


class GeoKeys(NamedTuple):
    """A CRS as GeoTIFF keys describe it; None for values that they do not state."""

    name: str  # as in the file
    is_geographic: bool  # in degrees, or geocentric
    epsg: int | None  # of the horizontal CRS
    vertical_epsg: int | None  # of the vertical CRS
    vertical_name: str  # of the vertical CRS
    datum_epsg: int | None  # of the vertical datum
    is_above_ellipsoid: bool  # the heights
    horizontal_unit: float | None  # metres
    vertical_unit: float | None  # metres
    unknown_units: tuple[int, ...]  # codes in the keys that are not known here


def read_geokeys(directory: bytes, doubles: bytes = b"", texts: bytes = b"") -> GeoKeys | None:
    """Return the CRS that the contents of the records 34735, 34736 and 34737 describe, or None if
    they do not define one.
    """
    keys = _read_keys(directory, doubles, texts)
    projected, geographic = _code(keys, _PROJECTED_CODE), _code(keys, _GEOGRAPHIC_CODE)
    model = keys.get(_MODEL)
    if model not in (_PROJECTED, _GEOGRAPHIC, _GEOCENTRIC):
        stated = (_PROJECTED_CODE, _LINEAR_UNIT, _VERTICAL_CODE, _VERTICAL_UNIT)
        if geographic is None and not any(key in keys for key in stated):
            return None
        model = _GEOGRAPHIC if geographic and _PROJECTED_CODE not in keys else _PROJECTED
    is_geographic = model != _PROJECTED
    citations = (_PROJECTED_CITATION, _CITATION, _GEOGRAPHIC_CITATION)
    codes: list[Any] = [keys.get(key) for key in (_LINEAR_UNIT, _VERTICAL_UNIT)]
    vertical, datum = _code(keys, _VERTICAL_CODE), _code(keys, _VERTICAL_DATUM)
    is_above_ellipsoid = vertical in _OLD_ELLIPSOIDS
    if vertical in _OLD_DATUMS:
        datum = vertical
    if vertical in _OLD_DATUMS or is_above_ellipsoid:
        vertical = None
    return GeoKeys(
        name=next((str(keys[key]) for key in citations if keys.get(key)), ""),
        is_geographic=is_geographic,
        epsg=geographic if is_geographic else projected,
        vertical_epsg=vertical,
        vertical_name=str(keys.get(_VERTICAL_CITATION, "")),
        datum_epsg=datum,
        is_above_ellipsoid=is_above_ellipsoid,
        horizontal_unit=_UNITS.get(codes[0]) or _size(keys.get(_LINEAR_UNIT_SIZE)),
        vertical_unit=_UNITS.get(codes[1]),
        unknown_units=tuple(
            code for code in codes if code not in (None, 0, _USER_DEFINED) and code not in _UNITS
        ),
    )


def _read_keys(directory: bytes, doubles: bytes, texts: bytes) -> dict[int, int | float | str]:
    """Return the values of keys; entries that point outside their record are left out."""
    shorts = struct.unpack(f"<{len(directory) // 2}H", directory[: len(directory) // 2 * 2])
    numbers = struct.unpack(f"<{len(doubles) // 8}d", doubles[: len(doubles) // 8 * 8])
    keys: dict[int, int | float | str] = {}
    for start in range(4, len(shorts) - 3, 4):
        key, place, count, value = shorts[start : start + 4]
        if place == 0:
            keys[key] = value
        elif place == _DOUBLES and value < len(numbers):
            keys[key] = numbers[value]
        elif place == _TEXTS:
            text = texts[value : value + count].decode("latin-1")
            keys[key] = text.replace("\0", "").rstrip("|").strip()
    return keys


def _code(keys: dict[int, int | float | str], key: int) -> int | None:
    value = keys.get(key)
    return value if isinstance(value, int) and 1024 <= value < _USER_DEFINED else None


def _size(value: object) -> float | None:
    return value if isinstance(value, float) and is_unit(value) else None
