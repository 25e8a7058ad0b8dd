"""Digital surface models (the top of trees, buildings and terrain) and canopy height."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core.parameters import ParameterSet, parameter, parameter_of
from ...grids.morphology import median_of_nine

# Pits lie deeper than this below the mean of their eight neighbours, in metres. They are filled in
# so many passes, since those of several cells are filled from their borders.
_PIT, PIT_PASSES = 2.0, 3


@dataclass(frozen=True)
class Gaps(ParameterSet):
    """Which gaps of rasters stay open."""

    max_edge: float | None = parameter(
        None,
        kind="number",
        label="Maximum edge",
        unit="m",
        minimum=0.1,
        maximum=100_000.0,
        advanced=True,
        help="Gaps inside the survey are filled by triangles. A triangle with a longer edge than"
        " this has no data, for example over water. Empty: all gaps inside are filled. Beyond the"
        " outline of the points no raster has data in any case.",
    )


@dataclass(frozen=True)
class SurfaceModel(ParameterSet):
    """Which points form the surface, which gaps stay open, and whether pits are filled."""

    surface_returns: str = parameter(
        "first",
        label="Returns of the surface model",
        choices={"first": "First and single returns", "all": "All returns"},
        help="First returns hit the tops of trees and buildings. Take all returns if the return"
        " numbers of the file are wrong.",
    )
    surface_classes: tuple[int, ...] | None = parameter(
        None,
        kind="integers",
        label="Classes of the surface model",
        minimum=0,
        maximum=255,
        advanced=True,
        empty="all but noise",
        help="Only points of these classes make the surface, such as 41 for a water surface, or 2"
        " and 6 for terrain with buildings. Empty: all classes but low and high noise (7 and 18)"
        " and what lies in water (43 to 45); if the bottom of waters (40) is ground, their surfaces"
        " (41 and 42) are left out, too.",
    )
    max_edge: float | None = parameter_of(Gaps, "max_edge", advanced=False)
    pit_free: bool = parameter(
        False,
        label="Fill pits of the canopy",
        advanced=True,
        help="Where a pulse passed between the branches, the canopy height has pits. This raises"
        " cells that lie over 2 m below the mean of their neighbours to the median of them, as"
        " crowns and trees are easier to find without pits. The surface model keeps them.",
    )


def canopy_height(surface: np.ndarray, terrain: np.ndarray) -> np.ndarray:
    """Return the height of the surface above the terrain, 0 below it, NaN where one has none."""
    return np.maximum(surface - terrain, 0.0)


def without_pits(canopy: np.ndarray) -> np.ndarray:
    """Return canopy heights with pits filled, nowhere lower; NaN counts as 0 for neighbours."""
    # As Ben-Arie et al. (2009), "Development of a pit filling algorithm for LiDAR canopy height
    # models", Computers & Geosciences 35(9), the Laplacian of the heights finds the pits, and the
    # median of the neighbours fills them. The median keeps the borders of crowns and buildings. The
    # result depends on `PIT_PASSES` cells round each cell.
    filled = np.nan_to_num(canopy, nan=0.0)
    for _ in range(PIT_PASSES):
        padded = np.pad(filled, 1, mode="edge")
        across = padded[:, :-2] + padded[:, 1:-1] + padded[:, 2:]
        of_nine = across[:-2] + across[1:-1] + across[2:]
        is_pit = (of_nine - filled) / 8.0 - filled > _PIT
        filled = np.where(is_pit, np.maximum(median_of_nine(filled), filled), filled)
    return np.where(np.isnan(canopy), canopy, filled)
