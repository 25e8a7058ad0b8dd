"""Where trees stand, and how open the ground is: shares of points in the surroundings of cells."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...core.points import Points
from ...core.progress import SILENT
from ...core.threads import in_threads, over_parts
from ...grids.cells import Cells
from ..pipeline import PointRule, Stage
from ..state import GridState, State

# Points up to so many metres above the lowest one of their cell count as near it, and on slopes
# what the ground rises within the cell.
_NEAR = 0.6
# Side in metres of the square in which they are counted.
_WIDTH = 5.0
_POINTS_A_PART = 1 << 16


@dataclass(frozen=True)
class Woods(PointRule):
    """Cells are under trees where many points are of pulses with several returns."""

    # On roofs, rocks and fields their share is below a tenth, in woods a quarter to all. Where the
    # file has no returns, no cell is known to be under trees.

    stage: ClassVar = Stage.LOWEST
    reads: ClassVar = ("multi_return", "grids")
    writes: ClassVar = ("grids",)

    share: float = 0.2  # least share of such points in the surroundings
    width: float = 5.0  # side in metres of the square in which they are counted

    def apply(self, state: State) -> None:
        """Find the cells under trees."""
        several = state.multi_return
        if several is None or not several.any():
            return

        def find(grid: GridState) -> None:
            grid.woods = share_around(several, grid.cells, self.width, 0.0) >= self.share

        in_threads(find, state.grids)


def share_around(which: np.ndarray, cells: Cells, width: float, default: float) -> np.ndarray:
    """Return the share of some points in the square of so many metres round each cell (rows,
    columns), or a default where there are none.
    """
    from scipy import ndimage

    side = max(2 * round(width / cells.size / 2.0 - 0.5) + 1, 1)
    total, some = (
        ndimage.uniform_filter(grid.astype(np.float32), side, mode="constant")
        for grid in (cells.counts, cells.counts_of(which))
    )
    return np.where(total > 0.0, some / np.maximum(total, 1e-6), default)


def openness(points: Points, cells: Cells, lowest: np.ndarray, rise: np.ndarray) -> np.ndarray:
    """Return the share of points near the lowest of their cell, in the surroundings of each cell
    (rows, columns): about 1 on open ground, on roofs and where points are sparse, 0.2 to 0.6 under
    trees.
    """
    heights = np.zeros(rise.size)
    heights[cells.index[lowest]] = points.z[lowest]
    highest, near = heights + rise.ravel() + _NEAR, np.empty(points.count, dtype=bool)

    def compare(part: slice) -> None:
        np.less_equal(points.z[part], highest.take(cells.index[part]), out=near[part])

    over_parts(compare, points.count, _POINTS_A_PART, SILENT)
    return share_around(near, cells, _WIDTH, 1.0)
