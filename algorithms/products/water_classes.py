"""Classes of ground points in water, and of those beside its shore."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core.parameters import ParameterSet, parameter
from ..core.progress import SILENT, Progress
from ..grids.lines import near_rings
from ..survey.area import Area, Polygon
from ..survey.kept_classes import IGNORED_GROUND
from ..survey.shapes import Geometry, Place, located


@dataclass(frozen=True)
class WaterClasses(ParameterSet):
    """Which classes ground points in water and beside its shore get."""

    shore_distance: float = parameter(
        0.7,
        label="Ignored ground beside the shore",
        unit="m",
        minimum=0.0,
        maximum=1000.0,
        help="Ground points outside of the water, up to this far from its shore, become ignored"
        " ground: there the breakline alone decides the terrain. The Lidar Base Specification asks"
        " for one nominal point spacing: 0.7 m for QL2, 0.35 m for QL1. 0: none.",
    )
    water_class: int = parameter(
        9,
        label="Class of water",
        minimum=0,
        maximum=255,
        advanced=True,
        help="The class that ground points in the water get. Point formats 0 to 5 hold classes up"
        " to 31.",
    )
    ignored_class: int = parameter(
        IGNORED_GROUND,
        label="Class of ignored ground",
        minimum=0,
        maximum=255,
        advanced=True,
        help="The class that ground points beside the shore get. Points that have it already keep"
        " it, also in the water, unless it is one of the ground classes.",
    )


@dataclass(frozen=True, eq=False)
class WaterPolygons(Geometry):
    """Polygons of water, in coordinates of the CRS.

    Attributes
    ----------
    polygons : tuple of polygon
        As in `Area`: shores, and islands as holes. Those of a file can be in another CRS until the
        points are known.

    Raises
    ------
    BareEarthError
        If a corner is not finite.
    """

    polygons: tuple[Polygon, ...] = ()

    def __post_init__(self) -> None:
        if self.polygons:
            # This refuses corners that are not finite.
            Area(None, self.polygons)

    def located(self, place: Place, progress: Progress = SILENT) -> WaterPolygons:
        """Return the polygons in the CRS of the points.

        Polygons of a file are transformed from the CRS that it states. Messages tell so, and
        if there is no polygon.

        Raises
        ------
        BareEarthError
            If that is not possible, or all of them lie outside of the points.
        """
        if not self.polygons:
            progress.warning("There is no polygon of water, so that no class changes.")
        return WaterPolygons(located(self.polygons, "the polygons of water", place, progress))


NO_WATER = WaterPolygons()


def classes_at_water(
    x: np.ndarray,
    y: np.ndarray,
    classes: np.ndarray,
    ground: np.ndarray,
    polygons: tuple[Polygon, ...],
    how: WaterClasses,
    unit: float = 1.0,
) -> np.ndarray:
    """Return the classes of points, uint8 (n,), with those of water and of ignored ground beside
    its shore; points that are not ground keep their class.
    """
    # Places and polygons are in the CRS, of which a unit is so many metres. The classes 9 and 20
    # are those of the Lidar Base Specification 2.1 of the U.S. Geological Survey.
    found, which = classes.copy(), np.flatnonzero(ground)
    if not polygons or not len(which):
        return found
    inside = Area(None, polygons).contains(x[which], y[which])
    found[which[inside]] = how.water_class
    if how.shore_distance > 0.0:
        land = which[~inside]
        rings = [ring for polygon in polygons for ring in polygon]
        beside = near_rings(x[land], y[land], rings, how.shore_distance / unit)
        found[land[beside]] = how.ignored_class
    return found
