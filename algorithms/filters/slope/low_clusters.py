"""Small groups of points far below everything round them, wider than one cell."""

from __future__ import annotations

import numpy as np

from ...grids.inpaint import First, inpaint
from ...grids.morphology import opening
from ..shared.outliers import supported


def low_clusters(
    grid: np.ndarray,
    size: float,
    slope: float,
    widest: float,
    around: float,
    first: First = (0, 0),
) -> np.ndarray:
    """Return which cells of a minimum grid lie in a small pit below the terrain.

    The grid is closed by discs (the opening of -z). Where this raises cells by more than `slope`
    times the radius, there is a pit. A pit holds outliers if it is no longer than the disc's
    diameter in either direction, unlike ditches and streets between houses, and also so deep below
    its surroundings, unlike a courtyard.

    Parameters
    ----------
    grid, size, first
        As for `low_outliers`, and so is the result.
    slope : float
        Rise over run of the pit's sides, above that of terrain.
    widest : float
        Diameter of the widest pit in metres.
    around : float
        Radius of the surroundings in metres.
    """
    # Single precision halves the time that the discs take.
    filled = inpaint(grid, first=first).astype(np.float32)
    depth = np.zeros(grid.shape)
    for radius in range(1, max(round(widest / size / 2), 1) + 1):
        deep = slope * radius * size
        pits = _compact(-opening(-filled, radius) - filled > deep, 2 * radius + 1)
        depth[pits] = np.maximum(depth[pits], deep)
    depth[supported(grid, size, depth > 0.0, depth)] = 0.0
    if not depth.any():
        return depth > 0.0
    others = inpaint(np.where(depth > 0.0, np.nan, grid), first=first).astype(np.float32)
    below = filled < opening(others, round(around / size, 6)) - depth
    return (depth > 0.0) & below & np.isfinite(grid)


def _compact(mask: np.ndarray, longest: int) -> np.ndarray:
    """Return the connected parts of a mask that are at most so many cells long and wide."""

    from scipy import ndimage

    parts, count = ndimage.label(mask, np.ones((3, 3)))
    compact = np.zeros(count + 1, dtype=bool)
    for number, part in enumerate(ndimage.find_objects(parts), start=1):
        compact[number] = max(side.stop - side.start for side in part) <= longest
    return compact[parts]
