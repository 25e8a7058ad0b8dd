"""How open the ground is: the share of points that lie near the lowest ones."""

from __future__ import annotations

import numpy as np

from ...core.points import Points
from ...core.progress import SILENT
from ...core.threads import over_parts
from ...grids.cells import Cells
from .woods import share_around

# Points up to so many metres above the lowest one of their cell count as near it, and on slopes
# what the ground rises within the cell.
_NEAR = 0.6
# Side in metres of the square in which they are counted.
_WIDTH = 5.0
_POINTS_A_PART = 1 << 16


def openness(points: Points, cells: Cells, lowest: np.ndarray, rise: np.ndarray) -> np.ndarray:
    """Return the share of points near the lowest one of their cell, in the surroundings of a cell.

    It is about 1 on open ground, on roofs and where points are sparse, and 0.2 to 0.6 under trees.

    Parameters
    ----------
    points : Points
        All points that take part, mostly last returns.
    cells : Cells
        Their cells.
    lowest : numpy.ndarray of intp
        The lowest point of each cell.
    rise : numpy.ndarray of float, shape (rows, columns)
        How much the ground rises from side to side of a cell, in metres.

    Returns
    -------
    numpy.ndarray of float32, shape (rows, columns)
        0 to 1; 1 where there are no points.
    """
    heights = np.zeros(rise.size)
    heights[cells.index[lowest]] = points.z[lowest]
    highest, near = heights + rise.ravel() + _NEAR, np.empty(points.count, dtype=bool)

    def compare(part: slice) -> None:
        np.less_equal(points.z[part], highest.take(cells.index[part]), out=near[part])

    over_parts(compare, points.count, _POINTS_A_PART, SILENT)
    return share_around(near, cells, _WIDTH, 1.0)
