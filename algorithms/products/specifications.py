"""What specifications ask of a survey, with the place where they say it.

References
----------
U.S. Geological Survey: Lidar Base Specification, version 2.1 and later,
https://www.usgs.gov/ngp-standards-and-specifications/lidar-base-specification-online.
Toitu Te Whenua Land Information New Zealand (2020): PGF version, New Zealand National Aerial LiDAR
Base Specification.
IGN: LiDAR HD, nuages de points classes, https://geoservices.ign.fr/lidarhd.
"""

from __future__ import annotations

from types import MappingProxyType
from typing import Mapping, NamedTuple


class Specification(NamedTuple):
    """What a specification asks for; None for what it does not state, or is not known to state.

    Attributes
    ----------
    label : str
        Its name.
    source : str
        Where it is written.
    pulses, points : float or None
        Least mean density of first returns, and of all returns, in 1/m2.
    spacing : float or None
        Aggregate nominal pulse spacing (ANPS) in metres.
    filled : float or None
        Least share of cells of twice the spacing that hold a first return.
    strips : float or None
        Largest root mean square difference of heights between strips, in metres.
    classes : tuple of int or None
        Classes that may be used.
    needed : tuple of int
        Classes that must be used.
    refused : tuple of int
        Classes in which no point may be left.
    is_modern : bool
        Whether files must be LAS 1.4 with point format 6 or higher, and state the CRS as WKT.
    places : mapping of str to str
        Section of the source, by the name of a check.
    """

    label: str
    source: str
    pulses: float | None = None
    points: float | None = None
    spacing: float | None = None
    filled: float | None = None
    strips: float | None = None
    classes: tuple[int, ...] | None = None
    needed: tuple[int, ...] = ()
    refused: tuple[int, ...] = ()
    is_modern: bool = False
    places: Mapping[str, str] = MappingProxyType({})


_LBS = "USGS Lidar Base Specification 2.1 and later"
_LBS_PLACES = {
    "classes": "Point Classification, table 5",
    "format": "American Society for Photogrammetry and Remote Sensing LAS File Format",
    "crs": "Coordinate Reference System: Well-Known Text",
    "pulses": "Nominal Pulse Spacing, table 1",
    "filled": "Spatial Distribution and Regularity",
    "voids": "Data Voids",
    "strips": "Interswath (Overlap) Consistency, table 2",
}


def _lbs(level: str, pulses: float, spacing: float) -> Specification:
    """Return the base specification of the USGS for a quality level."""
    return Specification(
        f"USGS Lidar Base Specification, {level}", _LBS, pulses=pulses, spacing=spacing,
        filled=0.9, strips=0.08, refused=(0,), needed=(1, 2), is_modern=True, places=_LBS_PLACES,
    )  # fmt: skip


SPECIFICATIONS = {
    "none": Specification("No specification", ""),
    "lbs-ql1": _lbs("QL1", 8.0, 0.35),
    "lbs-ql2": _lbs("QL2", 2.0, 0.71),
    "linz": Specification(
        "LINZ, New Zealand National Aerial LiDAR Base Specification (PGF version)",
        "LINZ (2020), PGF version of the New Zealand National Aerial LiDAR Base Specification",
        pulses=2.0, needed=(2, 3, 4, 5, 6), refused=(0,),
        places={"pulses": "Accuracy and pulse density", "classes": "vegetation and buildings"},
    ),
    "ign": Specification(
        "IGN LiDAR HD",
        "IGN, LiDAR HD: nuages de points classés", points=10.0,
        classes=(1, 2, 3, 4, 5, 6, 9, 17, 64, 65, 66, 67), needed=(2,), refused=(0,),
        places={"points": "10 points per m2", "classes": "table of classes"},
    ),
}  # fmt: skip
