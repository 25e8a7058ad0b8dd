"""The lowest points of cells: the grids that most rules work on."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ...core.threads import in_threads
from ..pipeline import PointRule, Stage
from ..state import GridState, State

# Largest spacing in metres at which narrow cells hold enough points, and show breaks by themselves.
DENSE_SPACING = 0.17


@dataclass(frozen=True)
class LowestPoints(PointRule):
    """The lowest point of each cell may be ground.

    It is chance where cells begin, so there can be a second grid, half a cell apart. It hardly
    matters where points are dense.

    Attributes
    ----------
    size : float or None
        Side of the cells in metres; None for that of `least_size`, or the spacing if that is more.
    least_size : float
        Least side of the cells in metres where `size` is None.
    dense_size : float or None
        Side in metres where points are so dense that their noise is measured; None for no such
        rule.
    grids : int
        1 or 2.
    """

    stage: ClassVar = Stage.LOWEST
    reads: ClassVar = ("points", "spacing")
    writes: ClassVar = ("grids",)

    size: float | None = None
    least_size: float = 1.0
    dense_size: float | None = None
    grids: int = 1

    def apply(self, state: State) -> None:
        """Make the grids."""
        size = self._size(state.spacing)
        is_dense = self.dense_size is not None and state.spacing <= DENSE_SPACING
        shifts = (0.0, 0.5 * size) if self.grids > 1 and not is_dense else (0.0,)
        state.grids = in_threads(
            lambda shift: GridState.of(state.points, state.spacing, size, shift), shifts
        )

    def _size(self, spacing: float) -> float:
        if self.size is not None:
            return self.size
        if self.dense_size is not None and spacing <= DENSE_SPACING:
            return self.dense_size
        return max(self.least_size, spacing)
