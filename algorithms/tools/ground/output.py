"""Options for the contents of a classified file."""

from __future__ import annotations

from dataclasses import dataclass

from ...core.errors import BareEarthError
from ...core.parameters import ParameterSet, parameter
from ..heights import HEIGHT_DIMENSION


@dataclass(frozen=True)
class PointOutput(ParameterSet):
    """What is written to a classified file."""

    ground_only: bool = parameter(
        False,
        label="Write ground points only",
        help="Writes only the points that have the class of the ground. The log says how many"
        " points are left out.",
    )
    area_only: bool = parameter(
        False,
        label="Write points of the area only",
        advanced=True,
        help="Writes only the points inside the extent and the boundary. Files without such points"
        " are not written. If this is off, all files are written with all their points, and points"
        " outside keep their class. In QGIS, it is on for remote points.",
    )
    height_above_ground: bool = parameter(
        False,
        label="Add the height above ground",
        help=f"Adds the extra dimension {HEIGHT_DIMENSION}, the height of each point above the"
        " ground, in the vertical unit of the CRS.",
    )

    @property
    def changes_points(self) -> bool:
        """Whether more than the classes changes."""
        return self.ground_only or self.height_above_ground or self.area_only

    def check_area(self, is_given: bool) -> None:
        """Refuse to write only the area if there is no area."""
        if self.area_only and not is_given:
            raise BareEarthError(
                "Give an extent or a boundary to write the points of the area only, or write all."
            )
