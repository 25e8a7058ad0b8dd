"""The lowest points of cells: the grids that most rules work on."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ...core.threads import in_threads
from ..pipeline import PointRule, Stage
from ..state import GridState, State

# Largest spacing in metres at which cells hold many points, and show breaks by themselves.
DENSE_SPACING = 0.17


@dataclass(frozen=True)
class LowestPoints(PointRule):
    """The lowest point of each cell may be ground.

    It is chance where cells begin, so there can be a second grid, half a cell apart.

    Attributes
    ----------
    size : float
        Side of the cells in metres.
    grids : int
        1 or 2.
    """

    stage: ClassVar = Stage.LOWEST
    reads: ClassVar = ("points", "spacing")
    writes: ClassVar = ("grids",)

    size: float
    grids: int = 1

    def apply(self, state: State) -> None:
        """Make the grids."""
        shifts = (0.0, 0.5 * self.size)[: self.grids]
        state.grids = in_threads(
            lambda shift: GridState.of(state.points, state.spacing, self.size, shift), shifts
        )
