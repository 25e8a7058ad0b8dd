"""Where trees stand: their leaves and branches split pulses."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...core.threads import in_threads
from ...grids.cells import Cells
from ..pipeline import PointRule, Stage
from ..state import GridState, State


@dataclass(frozen=True)
class Woods(PointRule):
    """Cells are under trees where many points are of pulses with several returns.

    On roofs, rocks and fields their share is below a tenth, in woods a quarter to all. Where the
    file has no returns, no cell is known to be under trees.

    Attributes
    ----------
    share : float
        Least share of such points in the surroundings.
    width : float
        Side in metres of the square in which they are counted.
    """

    stage: ClassVar = Stage.LOWEST
    reads: ClassVar = ("multi_return", "grids")
    writes: ClassVar = ("grids",)

    share: float = 0.2
    width: float = 5.0

    def apply(self, state: State) -> None:
        """Find the cells under trees."""
        several = state.multi_return
        if several is None or not several.any():
            return

        def find(grid: GridState) -> None:
            grid.woods = share_around(several, grid.cells, self.width, 0.0) >= self.share

        in_threads(find, state.grids)


def share_around(which: np.ndarray, cells: Cells, width: float, default: float) -> np.ndarray:
    """Return the share of some points in the surroundings of each cell.

    Parameters
    ----------
    which : numpy.ndarray of bool, shape (n,)
        The points that are counted.
    cells : Cells
        Cells of all points.
    width : float
        Side in metres of the square in which they are counted.
    default : float
        The share where there are no points.

    Returns
    -------
    numpy.ndarray of float32, shape (rows, columns)
    """
    from scipy import ndimage

    side = max(2 * round(width / cells.size / 2.0 - 0.5) + 1, 1)
    total, some = (
        ndimage.uniform_filter(grid.astype(np.float32), side, mode="constant")
        for grid in (cells.counts, cells.counts_of(which))
    )
    return np.where(total > 0.0, some / np.maximum(total, 1e-6), default)
