"""The deliveries: which outputs a job needs, and with which settings they are made.

They follow the Lidar Base Specification of USGS (version 2.1 and later: hydro-flattening, cell
sizes), the PGF specification of LINZ (2020), LiDAR HD of IGN (https://geoservices.ign.fr/lidarhd)
and, for archaeology, Stular, Eichert and Lozic (2021), Remote Sensing 13(16), 3225.
"""

from __future__ import annotations

from types import MappingProxyType
from typing import Mapping, NamedTuple

from ..tools.quality.specifications import SPECIFICATIONS

# Name of the raster of the terrain with buildings, which is not among `RASTERS`.
WITH_BUILDINGS = "terrain_with_buildings"
# Least ground points in a square metre, and the side in metres of the cells that they allow: about
# one point in each cell. Cells of 1 m are usual also in woods, where a cell often has none.
_CELLS = ((100.0, 0.1), (16.0, 0.25), (4.0, 0.5), (0.25, 1.0), (0.0625, 2.0))
_LARGEST_CELL = 5.0
# The cell sizes that specifications state, and values of the parameters of tools. Beside a shore,
# the ground up to the nominal spacing of pulses is ignored; that of IGN has no class for it.
_CELL_SIZES = {"lbs-ql1": 0.5, "lbs-ql2": 1.0, "linz": 1.0, "ign": 0.5}
STATED: Mapping[str, Mapping[str, object]] = {
    "none": {},
    "lbs-ql1": {"shore_distance": SPECIFICATIONS["lbs-ql1"].spacing},
    "lbs-ql2": {"shore_distance": SPECIFICATIONS["lbs-ql2"].spacing},
    "linz": {},
    "ign": {"shore_distance": 0.0, "above_ground": "ign"},
}
# Noise and bridges get their classes in any case.
_ALWAYS: Mapping[str, object] = {
    "low_noise_class": True, "high_noise_class": True, "bridge_class": 17, "mark_as": "flag",
}  # fmt: skip
# Classes of what stands on the ground.
_ABOVE_GROUND = {3, 4, 5, 6}


class Delivery(NamedTuple):
    """The outputs of a job, and how they are made, where the user leaves the default."""

    label: str
    about: str  # a sentence
    rasters: tuple[str, ...]  # names as in `RASTERS`
    pictures: tuple[str, ...]  # the rasters that its page shows; the first is the largest
    finest: float  # metres: smallest cell that is chosen by the density of ground points
    # Values of the parameters of its tools, by their names
    values: Mapping[str, object] = MappingProxyType({})
    above_ground: bool = False  # whether the points above the ground get classes
    heights: bool = False  # whether each point gets its height above ground
    # Whether water is found, flattened and delivered, and ground in it gets classes
    water: bool = False
    with_buildings: bool = False  # whether there is a terrain model on which the buildings stand
    contours: bool = False
    contour_metres: float | None = None  # the height between them; None for about twenty lines
    quality: tuple[str, ...] = ()  # the rasters of quality that are delivered
    low_confidence: bool = False  # whether the low confidence areas are delivered
    specification: str = "none"  # with which the survey is compared
    cell_as_specified: bool = False  # whether a specification states the cell size

    def cell_size(self, density: float | None, specification: str) -> float:
        """Return the side of a cell of the terrain model in metres, by ground points in a square
        metre, if known, and the specification.
        """
        if self.cell_as_specified and specification in _CELL_SIZES:
            return _CELL_SIZES[specification]
        if density is None:
            return max(1.0, self.finest)
        by_density = (cell for least, cell in _CELLS if density >= least)
        return max(next(by_density, _LARGEST_CELL), self.finest)

    def values_with(self, specification: str) -> dict[str, object]:
        """Return the values of parameters that a user leaves at their defaults."""
        stated, asked = STATED[specification], SPECIFICATIONS[specification]
        classes = {*asked.needed, *(asked.classes or ())}
        scheme = stated.get("above_ground", "asprs")
        return {
            **_ALWAYS, **self.values, **stated, "specification": specification,
            "height_above_ground": self.heights,
            "above_ground": scheme if self.above_ground or _ABOVE_GROUND & classes else "none",
        }  # fmt: skip


DELIVERIES = {
    "survey": Delivery(
        "Survey",
        "What a survey hands over: points with classes for ground, water, noise and bridges, a"
        " terrain model with flat water and its breaklines, and the quality compared with a"
        " specification.",
        rasters=("dtm", "hillshade", "dsm", "expected_error", "error_cause"),
        pictures=("hillshade", "dtm"),
        finest=0.5,
        water=True,
        values={"raster_nodata": -999999.0},
        quality=(
            "pulse_density", "ground_density", "voids", "overlap", "strip_differences",
            "surface_height",
        ),
        low_confidence=True,
        specification="lbs-ql2",
        cell_as_specified=True,
    ),
    "archaeology": Delivery(
        "Archaeology",
        "Small features of the terrain: low walls and banks stay in a fine terrain model, and many"
        " pictures show its relief.",
        rasters=(
            "dtm", "hillshade", "vat", "sky_view", "openness", "negative_openness",
            "local_dominance", "relief", "red_relief", "expected_error",
        ),
        pictures=("vat", "hillshade", WITH_BUILDINGS),
        finest=0.25,
        values={"ground_tolerance": 0.8},
        above_ground=True,
        with_buildings=True,
        quality=("low_vegetation",),
    ),
    "forestry": Delivery(
        "Forestry",
        "Vegetation: its classes by height, the height above ground of every point, a canopy model"
        " without pits, and the density of the undergrowth.",
        rasters=("dtm", "hillshade", "dsm", "chm"),
        pictures=("chm", "hillshade"),
        finest=0.5,
        above_ground=True,
        heights=True,
        values={"pit_free": True},
        quality=("low_vegetation",),
    ),
    "flood": Delivery(
        "Flood model",
        "The terrain as water meets it: decks of bridges are left out, water that is found goes on"
        " below them, lakes and rivers are flat and come as polygons and breaklines, and buildings"
        " have a class.",
        rasters=("dtm", "hillshade", "dsm", "expected_error", "error_cause"),
        pictures=("hillshade", "dtm"),
        finest=0.5,
        above_ground=True,
        # Canals and ponds too: on three real tiles this finds five of them, the usual limits none.
        values={"min_area": 1000.0, "min_width": 5.0},
        water=True,
        low_confidence=True,
        contours=True,
    ),
    "drone-site": Delivery(
        "Drone site",
        "A site from a drone: stockpiles and slopes are terrain, machines are not, in small cells,"
        " with contour lines and a measure of accuracy.",
        rasters=("dtm", "hillshade", "dsm", "expected_error", "error_cause"),
        pictures=("hillshade", "dsm"),
        finest=0.1,
        values={"preset": "site"},
        contours=True,
        contour_metres=0.5,
        quality=("ground_density",),
    ),
}  # fmt: skip
DEFAULT_DELIVERY = "survey"


def names_of_values() -> frozenset[str]:
    """Return the names of all parameters that deliveries set where a user gives no value."""
    values = (
        delivery.values_with(specification)
        for delivery in DELIVERIES.values()
        for specification in STATED
    )
    return frozenset({"contour_interval"}.union(*values)) - {"specification"}
