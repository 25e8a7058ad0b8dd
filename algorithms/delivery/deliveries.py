"""The deliveries: which outputs a job needs, and with which settings they are made.

References
----------
U.S. Geological Survey: Lidar Base Specification, version 2.1 and later, Digital Elevation Model
Hydro-Flattening, and table of cell sizes.
Toitu Te Whenua Land Information New Zealand (2020): PGF version, New Zealand National Aerial LiDAR
Base Specification.
IGN: LiDAR HD, modeles numeriques, https://geoservices.ign.fr/lidarhd.
Stular, B., Eichert, S., Lozic, E. (2021): Airborne LiDAR Point Cloud Processing for Archaeology.
Pipeline and QGIS Toolbox. Remote Sensing 13(16), 3225.
"""

from __future__ import annotations

from types import MappingProxyType
from typing import Any, Mapping, NamedTuple

from ..products.specifications import SPECIFICATIONS

# Name of the raster of the terrain with buildings, which is not among `RASTERS`.
WITH_BUILDINGS = "terrain_with_buildings"
# Least ground points in a square metre for cells of so many metres: about one in each cell. Cells
# of 1 m are usual also in woods, where a cell often has none.
_CELLS = ((100.0, 0.1), (16.0, 0.25), (4.0, 0.5), (0.25, 1.0), (0.0625, 2.0))
_LARGEST_CELL = 5.0
# Cell sizes that specifications state, in metres.
_STATED_CELLS = {"lbs-ql1": 0.5, "lbs-ql2": 1.0, "linz": 1.0, "ign": 0.5}
# Classes of what stands on the ground.
_ABOVE_GROUND = {3, 4, 5, 6}


class Delivery(NamedTuple):
    """The outputs of a job, and how they are made.

    Attributes
    ----------
    label, about : str
        Its name, and a sentence about it.
    rasters : tuple of str
        Names of rasters, as in `RASTERS` of `products/raster_files.py`.
    pictures : tuple of str
        The rasters that its page shows; the first is the largest.
    finest : float
        The smallest cell that is chosen by the density of the ground points, in metres.
    preset : str
        The preset of the method, unless the user chooses one.
    values : mapping of str to object
        Values of the method, unless the user gives them.
    above_ground : bool
        Whether the points above the ground get classes.
    heights : bool
        Whether each point gets its height above ground.
    water : mapping of str to float, or None
        Which water is found, flattened and delivered, where the user leaves the default; None for
        no water.
    water_classes : bool
        Whether ground in the water and beside its shore gets the classes 9 and 20.
    terrain : mapping of str to object
        Values of the terrain model, where the user leaves the default.
    surface : mapping of str to object
        Values of the surface and canopy models, where the user leaves the default.
    with_buildings : bool
        Whether there is a terrain model on which the buildings stand.
    contours : bool
        Whether there are contour lines.
    contour_metres : float or None
        The height between them in metres; None for about twenty lines.
    quality : tuple of str
        The rasters of quality that are delivered.
    specification : str
        The specification with which the survey is compared, unless the user chooses one.
    cell_as_specified : bool
        Whether a specification states the cell size.
    """

    label: str
    about: str
    rasters: tuple[str, ...]
    pictures: tuple[str, ...]
    finest: float
    preset: str = "automatic"
    values: Mapping[str, Any] = MappingProxyType({})
    above_ground: bool = False
    heights: bool = False
    water: Mapping[str, float] | None = None
    water_classes: bool = False
    terrain: Mapping[str, Any] = MappingProxyType({})
    surface: Mapping[str, Any] = MappingProxyType({})
    with_buildings: bool = False
    contours: bool = False
    contour_metres: float | None = None
    quality: tuple[str, ...] = ()
    specification: str = "none"
    cell_as_specified: bool = False

    def cell_size(self, density: float | None, specification: str) -> float:
        """Return the side of a cell of the terrain model in metres.

        Parameters
        ----------
        density : float or None
            Ground points in a square metre; None if it is not known.
        specification : str
            Name of the specification.

        Examples
        --------
        >>> DELIVERIES["archaeology"].cell_size(6.0, "none")
        0.5
        >>> DELIVERIES["survey"].cell_size(6.0, "lbs-ql2")
        1.0
        """
        if self.cell_as_specified and specification in _STATED_CELLS:
            return _STATED_CELLS[specification]
        if density is None:
            return max(1.0, self.finest)
        by_density = (cell for least, cell in _CELLS if density >= least)
        return max(next(by_density, _LARGEST_CELL), self.finest)

    def needs_classes(self, specification: str) -> bool:
        """Return whether the points above the ground get classes, also as a specification asks."""
        asked = SPECIFICATIONS[specification]
        return self.above_ground or bool(_ABOVE_GROUND & {*asked.needed, *(asked.classes or ())})


DELIVERIES = {
    "survey": Delivery(
        "Survey",
        "What a survey hands over: points with classes for ground, water, noise and bridges, a"
        " terrain model with flat water and its breaklines, and the quality compared with a"
        " specification.",
        rasters=("dtm", "hillshade", "dsm"),
        pictures=("hillshade", "dtm"),
        finest=0.5,
        water={},
        water_classes=True,
        terrain={"raster_nodata": -999999.0},
        quality=(
            "pulse_density", "ground_density", "voids", "overlap", "strip_differences",
            "surface_height",
        ),
        specification="lbs-ql2",
        cell_as_specified=True,
    ),
    "archaeology": Delivery(
        "Archaeology",
        "Small features of the terrain: low walls and banks stay in a fine terrain model, and many"
        " pictures show its relief.",
        rasters=(
            "dtm", "hillshade", "vat", "sky_view", "openness", "negative_openness",
            "local_dominance", "relief", "red_relief", "confidence",
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
        surface={"pit_free": True},
        quality=("low_vegetation",),
    ),
    "flood": Delivery(
        "Flood model",
        "The terrain as water meets it: bridges are removed, lakes and rivers are flat and come as"
        " polygons and breaklines, and buildings have a class.",
        rasters=("dtm", "hillshade", "dsm", "confidence"),
        pictures=("hillshade", "dtm"),
        finest=0.5,
        above_ground=True,
        # Canals and ponds too: on three real tiles this finds five of them, the usual limits none.
        water={"min_area": 1000.0, "min_width": 5.0},
        water_classes=True,
        contours=True,
    ),
    "drone-site": Delivery(
        "Drone site",
        "A site from a drone: stockpiles and slopes are terrain, machines are not, in small cells,"
        " with contour lines and a measure of accuracy.",
        rasters=("dtm", "hillshade", "dsm"),
        pictures=("hillshade", "dsm"),
        finest=0.1,
        preset="site",
        contours=True,
        contour_metres=0.5,
        quality=("ground_density",),
    ),
}  # fmt: skip
DEFAULT_DELIVERY = "survey"
