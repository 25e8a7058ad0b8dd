"""Low outliers that are scattered all over a dense cloud: most cells of a metre have one."""

from __future__ import annotations

import numpy as np

from ...core.points import Points
from ...grids.cells import Cells, spacing
from .ground_limits import DENSE_SPACING
from .outliers import depth_of_pits, supported

# Side of the cells in usual distances between points: so few points lie in one that hardly any has
# an outlier, and so many that hardly any is empty.
_SPACINGS = 3.0
# A smaller distance in metres is as good as this one.
_DENSEST = 0.02
# Metres that an outlier lies below the cells round it.
_DEPTH = 1.0
# Of several in one cell the lowest is found first.
_PASSES = 3


def scattered_lows(points: Points) -> np.ndarray:
    """Return which points of a dense cloud lie far below all others round them.

    The filters look at the lowest point of each cell of half a metre or a metre, and can tell some
    low outliers from ground, but not if most cells have one. Here cells are so narrow that few do.

    Parameters
    ----------
    points : Points
        All points.

    Returns
    -------
    numpy.ndarray of bool, shape (n,)
        None where points are farther apart than 0.17 m.
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
        # Nearer to the pit than to what closes it.
        limit = np.where(pits, grid + 0.5 * depth, -np.inf).ravel()
        lows |= points.z < limit.take(cells.index)
    return lows
