"""What a terrain model must respect: breaklines, water, and areas without ground."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ...core.progress import SILENT, Progress
from ...grids.lines import along
from ...las.cloud import PointCloud
from ...survey.area import Area, Polygon
from ...survey.shapes import Geometry, Place, located

# Metres from a line or border up to which ground points give its height.
NEAR = 10.0
# Metres between vertices along a river.
STATION = 5.0
# What the user gives, for messages, and how far it has an effect in metres; None: only inside.
_GIVEN = {
    "breaklines": ("the breaklines", NEAR),
    "water": ("the polygons of water", None),
    "rivers": ("the rivers", NEAR),
    "no_ground": ("the polygons without ground", None),
}


@dataclass(frozen=True, eq=False)
class Constraints(Geometry):
    """What the user knows of the terrain, in coordinates of the CRS."""

    # float64 (n, 3): Lines that no triangle crosses: edges of walls, dykes, terraces. Where z is
    # NaN, the terrain on each side of a line has the height of the nearest ground point on that
    # side.
    breaklines: tuple[np.ndarray, ...] = ()
    # Water, as in `Area`: flattened to one level, which follows from the ground along it. If the
    # corners have z, shape (n, 3), this is the level in the vertical unit of the CRS.
    water: tuple[Polygon, ...] = ()
    # float64 (n, 3): Lines along which the level of water falls, in either direction. z is used
    # only in water whose corners have z.
    rivers: tuple[np.ndarray, ...] = ()
    # Areas in which no point is ground, such as bridges and roofs
    no_ground: tuple[Polygon, ...] = ()

    def located(self, place: Place, progress: Progress = SILENT) -> Constraints:
        """Return the constraints in the CRS of the points."""
        found = Constraints(
            **{
                name: located(getattr(self, name), words, place, progress, near)
                for name, (words, near) in _GIVEN.items()
            }
        )
        dry = found._dry_rivers(STATION / place.crs.horizontal_unit)
        if dry:
            progress.warning(
                f"Rivers that meet no polygon of water, and so have no effect: {dry:,}. Give the"
                " water as polygons; a river is the line along which their level falls."
            )
        return found

    def _dry_rivers(self, step: float) -> int:
        """Return how many rivers have no place in any water; `step` is in units of the CRS."""
        if not self.water:
            return len(self.rivers)
        water = Area(None, self.water_outlines)
        flat = (np.nan_to_num(river) * (1.0, 1.0, 0.0) for river in self.rivers)
        return sum(not water.contains(*along(river, step)[:, :2].T).any() for river in flat)

    def with_water(self, found: Constraints, progress: Progress = SILENT) -> Constraints:
        """Return these with water that was found, whose level is known along its own rivers."""
        if self.rivers:
            progress.warning(
                "The rivers have no effect on water that is found. Give the water as polygons, too."
            )
        return replace(self, water=found.water, rivers=found.rivers)

    @property
    def water_outlines(self) -> tuple[Polygon, ...]:
        """The polygons of water without their levels."""
        return tuple(tuple(ring[:, :2] for ring in polygon) for polygon in self.water)

    @property
    def any(self) -> bool:
        """Whether any are given."""
        return bool(self.breaklines or self.water or self.no_ground)

    def is_ground(self, part: PointCloud, ground: np.ndarray) -> np.ndarray:
        """Return which ground points of a part remain; boolean, shape (n,)."""
        if self._excluded is None or not ground.any():
            return ground
        return ground & ~self._excluded.of(part)

    @cached_property
    def _excluded(self) -> Area | None:
        """The area in which points are not ground."""
        excluded = (*self.no_ground, *self.water_outlines)
        return Area(None, excluded) if excluded else None


NO_CONSTRAINTS = Constraints()
