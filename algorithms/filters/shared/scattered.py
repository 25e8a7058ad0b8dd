"""Low outliers that are scattered all over a dense cloud: most cells of a metre have one."""

from __future__ import annotations

import numpy as np

from ...core.points import Points
from ...grids.cells import Cells, spacing
from .ground_limits import DENSE_SPACING
from .outliers import depth_of_pits, supported

# Side of the cells as a multiple of the usual distance between points. With so few points hardly
# any cell has an outlier, and hardly any is empty.
_SPACINGS = 3.0
# Least distance between points in metres; a smaller one counts as this.
_DENSEST = 0.02
# Least depth in metres of an outlier below the cells round it.
_DEPTH = 1.0
# Number of passes: of several outliers in one cell, each pass finds the lowest.
_PASSES = 3


def scattered_lows(points: Points) -> np.ndarray:
    """Return which points of a dense cloud lie far below all others round them.

    The filters use the lowest point of each cell of half a metre or a metre. They can tell some low
    outliers from ground, but not if most cells have one. Here cells are so narrow that few have
    one.

    Parameters
    ----------
    points : Points
        All points.

    Returns
    -------
    numpy.ndarray of bool, shape (n,)
        All False if points are farther apart than 0.17 m.
    """
    lows = np.zeros(points.count, dtype=bool)
    apart = spacing(points, _DENSEST)
    if apart > DENSE_SPACING:
        return lows
    cells = Cells.over(points, _SPACINGS * apart)
    for number in range(_PASSES):
        grid = cells.minimum(points.z, ~lows if number else slice(None))
        depth = depth_of_pits(grid, cells.first)
        pits = depth > _DEPTH
        pits &= ~supported(grid, cells.size, pits, depth, cells.first)
        if not pits.any():
            break
        # The lower half of the pit.
        limit = np.where(pits, grid + 0.5 * depth, -np.inf).ravel()
        lows |= points.z < limit.take(cells.index)
    return lows
