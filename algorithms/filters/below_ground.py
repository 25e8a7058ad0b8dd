"""Points far below the ground that a filter found."""

from __future__ import annotations

import numpy as np

from ..core.points import Points
from ..core.progress import SILENT, Progress
from ..core.threads import over_parts
from ..grids.cells import Cells
from ..grids.gradient import steepness
from ..grids.inpaint import inpaint

# Side of a cell in metres, and points that are compared at a time.
_CELL = 1.0
_CHUNK = 1 << 20


def below_ground(
    points: Points, ground: np.ndarray, depth: float, progress: Progress = SILENT
) -> np.ndarray:
    """Return which points (n,), never ground, lie so many metres, and the rise over a cell, below
    the lowest ground points of cells of 1 m; none where there is no ground.
    """
    below = np.zeros(points.count, dtype=bool)
    if not ground.any():
        return below
    cells = Cells.over(points, _CELL)
    surface = inpaint(cells.minimum(np.where(ground, points.z, np.inf)), first=cells.first)
    limit = surface - depth - _rise(surface)
    progress(0.5)

    def fill(part: slice) -> None:
        below[part] = points.z[part] < cells.at(limit, points.x[part], points.y[part])

    over_parts(fill, points.count, _CHUNK, progress.part(0.5, 1.0))
    return below & ~ground


def _rise(surface: np.ndarray) -> np.ndarray:
    """Return the largest rise of a surface over a cell, at each cell and those round it."""
    from scipy import ndimage

    return ndimage.maximum_filter(steepness(surface, 1.0), 3, mode="nearest")
