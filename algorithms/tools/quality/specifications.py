"""What specifications ask of a survey, with the place where they say it.

They are the Lidar Base Specification of USGS, version 2.1 and later,
https://www.usgs.gov/ngp-standards-and-specifications/lidar-base-specification-online, the PGF
version (2020) of the New Zealand National Aerial LiDAR Base Specification of LINZ, and LiDAR HD,
nuages de points classes, of IGN, https://geoservices.ign.fr/lidarhd.
"""

from __future__ import annotations

from types import MappingProxyType
from typing import Mapping, NamedTuple


class Specification(NamedTuple):
    """What a specification asks for; None for what it does not state, or is not known to state."""

    label: str
    source: str  # where it is written
    pulses: float | None = None  # least mean density of first returns in 1/m2
    points: float | None = None  # the same of all returns
    spacing: float | None = None  # aggregate nominal pulse spacing (ANPS) in metres
    filled: float | None = None  # least share of cells of twice the spacing with a first return
    strips: float | None = None  # largest RMS difference of heights between strips in metres
    classes: tuple[int, ...] | None = None  # that may be used
    needed: tuple[int, ...] = ()  # classes that must be used
    refused: tuple[int, ...] = ()  # classes in which no point may be left
    is_modern: bool = False  # LAS 1.4, point format 6 or higher, CRS as WKT
    places: Mapping[str, str] = MappingProxyType({})  # sections by the name of a check


_QL2 = Specification(
    "USGS Lidar Base Specification, QL2",
    "USGS Lidar Base Specification 2.1 and later", pulses=2.0, spacing=0.71,
    filled=0.9, strips=0.08, refused=(0,), needed=(1, 2), is_modern=True,
    places={
        "classes": "Point Classification, table 5",
        "format": "American Society for Photogrammetry and Remote Sensing LAS File Format",
        "crs": "Coordinate Reference System: Well-Known Text",
        "pulses": "Nominal Pulse Spacing, table 1",
        "filled": "Spatial Distribution and Regularity",
        "voids": "Data Voids",
        "strips": "Interswath (Overlap) Consistency, table 2",
    },
)  # fmt: skip
SPECIFICATIONS = {
    "none": Specification("No specification", ""),
    "lbs-ql1": _QL2._replace(
        label="USGS Lidar Base Specification, QL1", pulses=8.0, spacing=0.35
    ),
    "lbs-ql2": _QL2,
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
