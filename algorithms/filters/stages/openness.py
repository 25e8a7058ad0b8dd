"""How open the ground is: the share of points that lie near the lowest ones."""

from __future__ import annotations

import numpy as np

from ...core.points import Points
from ...grids.cells import Cells

# Points up to so many metres above the lowest one of their cell count as near it, and on slopes
# what the ground rises within the cell.
_NEAR = 0.6
# Side in metres of the square in which they are counted.
_WIDTH = 5.0


def openness(points: Points, cells: Cells, rise: np.ndarray) -> np.ndarray:
    """Return the share of points near the lowest one of their cell, in the surroundings of a cell.

    It is about 1 on open ground, on roofs and where points are sparse, and 0.2 to 0.6 under trees.

    Parameters
    ----------
    points : Points
        All points that take part, mostly last returns.
    cells : Cells
        Their cells.
    rise : numpy.ndarray of float, shape (rows, columns)
        How much the ground rises from side to side of a cell, in metres.

    Returns
    -------
    numpy.ndarray of float32, shape (rows, columns)
        0 to 1; 1 where there are no points.
    """
    from scipy import ndimage

    lowest = cells.minimum(points.z).ravel()
    near = points.z <= (lowest + rise.ravel() + _NEAR)[cells.index]
    counts = cells.counts().astype(np.float32)
    nearby = np.bincount(cells.index[near], minlength=counts.size).reshape(cells.shape)
    width = 2 * round(_WIDTH / cells.size / 2.0 - 0.5) + 1
    total, some = (
        ndimage.uniform_filter(grid.astype(np.float32), max(width, 1), mode="constant")
        for grid in (counts, nearby)
    )
    return np.where(total > 0.0, some / np.maximum(total, 1e-6), 1.0)
