"""Canopy heights, and their pits."""

from __future__ import annotations

import numpy as np

from .morphology import median_of_nine, sum_of_nine

_PIT = 2.0  # least depth of a pit in metres below the mean of its eight neighbours
PIT_PASSES = 3  # passes in which pits are filled: those of several cells from their borders


def canopy_height(surface: np.ndarray, terrain: np.ndarray) -> np.ndarray:
    """Return the height of the surface above the terrain, 0 below it, NaN where one has none."""
    return np.maximum(surface - terrain, 0.0)


def without_pits(canopy: np.ndarray) -> np.ndarray:
    """Return canopy heights with pits filled and no cell lower; as a neighbour, NaN counts as 0."""
    # As Ben-Arie et al. (2009), "Development of a pit filling algorithm for LiDAR canopy height
    # models", Computers & Geosciences 35(9), the Laplacian of the heights finds the pits, and the
    # median of the neighbours fills them. The median keeps the borders of crowns and buildings. The
    # result depends on `PIT_PASSES` cells round each cell.
    filled = np.nan_to_num(canopy, nan=0.0)
    for _ in range(PIT_PASSES):
        of_eight = sum_of_nine(np.pad(filled, 1, mode="edge")) - filled
        is_pit = of_eight / 8.0 - filled > _PIT
        filled = np.where(is_pit, np.maximum(median_of_nine(filled), filled), filled)
    return np.where(np.isnan(canopy), canopy, filled)
