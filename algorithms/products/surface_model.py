"""Digital surface models (the top of trees, buildings and terrain) and canopy height."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core.parameters import ParameterSet, parameter


@dataclass(frozen=True)
class SurfaceModel(ParameterSet):
    """Which points form the surface, and which gaps stay open."""

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
        " and 6 for terrain with buildings. Empty: all classes but low and high noise (7 and 18).",
    )
    max_edge: float | None = parameter(
        None,
        kind="number",
        label="Maximum edge",
        unit="m",
        minimum=0.1,
        maximum=100_000.0,
        help="Gaps between points are filled by triangles. A triangle with a longer edge than this"
        " has no data, for example over water. Empty: all gaps are filled, out to the convex hull"
        " of the points.",
    )


def canopy_height(surface: np.ndarray, terrain: np.ndarray) -> np.ndarray:
    """Return the height of the surface above the terrain, 0 where it lies below.

    Parameters
    ----------
    surface, terrain : numpy.ndarray of float, shape (rows, columns)
        Heights on the same grid; NaN where there is none.
    """
    return np.maximum(surface - terrain, 0.0)
