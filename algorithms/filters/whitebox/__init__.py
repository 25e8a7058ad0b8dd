"""The exact copy of WhiteboxTools' ground filter, for the preset of this name.

References
----------
Lindsay, J. (2025): WhiteboxTools, LidarGroundPointFilter. https://www.whiteboxgeo.com/manual/
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from ..pipeline import PointRule, Stage
from ..state import State
from .cell_bounds import Rule
from .standing_above import stands_above


@dataclass(frozen=True)
class StandsAbove(PointRule):
    """A point is ground unless it stands far above a neighbour, on one scale.

    Attributes
    ----------
    radius : float
        Search radius in metres.
    slope : float
        Slope threshold in degrees.
    height : float
        Height threshold in metres.
    top_hat : bool
        Whether heights above a surface that follows the terrain are compared (white top-hat).
    min_neighbours : int
        The radius of a point with fewer neighbours grows until it has so many.
    """

    stage: ClassVar = Stage.ACCEPTED
    reads: ClassVar = ("points",)
    writes: ClassVar = ("ground",)

    radius: float
    slope: float
    height: float
    top_hat: bool = True
    min_neighbours: int = 0

    def apply(self, state: State) -> None:
        """Accept the points that do not stand above a neighbour."""
        slope = math.tan(math.radians(self.slope))
        rule = Rule(self.radius, self.height, slope, self.top_hat)
        above = stands_above(state.points, rule, self.min_neighbours, state.progress)
        state.ground = ~above
