"""Local dominance: how much a place looks down on its surroundings.

References
----------
Hesse, R. (2016): Visualisierung hochaufloesender Digitaler Gelaendemodelle mit LiVT. In:
Lieberwirth, U. and Herzog, I. (eds.): 3D-Anwendungen in der Archaeologie. Edition Topoi, Berlin,
109-128.
"""

from __future__ import annotations

import math
from typing import Iterator

import numpy as np

from .horizons import Cells, Neighbour, Piece, Surroundings

# Height of the eyes above the terrain in metres, and directions in which they look.
_EYES, _DIRECTIONS = 1.7, 24
# An observer looks at so many distances between the two radii, or at fewer if these lie less than
# one cell apart.
_DISTANCES, _ROUNDING = 10, 1e-6


def dominance_reach(radius: float, cells: Cells) -> tuple[int, int]:
    """Return up to how many rows and columns away cells matter to the local dominance."""
    farthest = 2.0 * max(radius, max(cells))
    return math.ceil(farthest / cells[1]), math.ceil(farthest / cells[0])


def local_dominance(heights: np.ndarray, cells: Cells, radius: float) -> np.ndarray:
    """Return how steeply an observer looks down on the land around, in relation to level land,
    float32, 1 there, more on rises, less in hollows; NaN where there is no height.
    """
    # The observer looks at what lies from `radius` metres, at least one cell, up to twice as far.
    # Beyond the border of the data the land goes on as a plane. A cell depends on others up to
    # `dominance_reach`.
    around = Surroundings(heights, dominance_reach(radius, cells))
    seen = list(_seen(radius, cells))
    level = np.float32(sum(weight * _EYES for _, weight in seen))
    dominance = np.full(heights.shape, np.nan, dtype=np.float32)

    def work(piece: Piece) -> None:
        eyes = piece.own + np.float32(_EYES)
        total, down = np.zeros_like(eyes), np.empty_like(eyes)
        for neighbour, weight in seen:
            np.subtract(eyes, piece.heights_of(neighbour), out=down)
            np.maximum(down, np.float32(0.0), out=down)
            down *= np.float32(weight)
            total += down
        np.divide(total, level, out=dominance[piece.place], where=piece.known)

    around.over_pieces(work)
    return dominance


def _seen(radius: float, cells: Cells) -> Iterator[tuple[Neighbour, float]]:
    """Yield places that the observer sees, and weights: the angle of a metre times the area."""
    least = min(cells)
    radius = max(radius, max(cells))
    step = max(radius / _DISTANCES, least)
    for number in range(_DIRECTIONS):
        angle = math.radians(number * 360.0 / _DIRECTIONS)
        for distance in np.arange(radius, 2.0 * radius + step * _ROUNDING, step).tolist():
            row = round(math.sin(angle) * distance / cells[1])
            column = round(math.cos(angle) * distance / cells[0])
            weight = (2.0 * distance + step) / distance
            yield Neighbour(-row, -column, distance), weight
