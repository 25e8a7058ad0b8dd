"""Points that continue the ground into a place where a person saw ground."""

from __future__ import annotations

import numpy as np

from ..core.points import Points
from .cells import Cells, lower_at, spacing

# Metres: least side of a cell, and how far the ground is continued, which is how far points matter.
_CELL = 1.0
CONTINUED = 50.0
# Steepest rise or fall from cell to cell (35 degrees). On a hillside and in a town, 1 climbs hedges
# and low roofs, 2 also eaves, and 0.5 leaves banks out.
_STEEPEST = 0.7
_LAYER = 0.15  # metres above the lowest point of a cell in which points are ground
_ROUND = [(row, column) for row in (-1, 0, 1) for column in (-1, 0, 1) if row or column]


def continued_ground(points: Points, ground: np.ndarray, inside: np.ndarray) -> np.ndarray:
    """Return which points inside of a place continue the ground, bool (n,): the lowest ones of
    cells that are reached from the ground without a step, so neither crowns nor roofs.
    """
    found = np.zeros(points.count, dtype=bool)
    used = np.flatnonzero(inside | ground)
    if not inside.any() or not ground.any():
        return found
    some, size = points.take(used), spacing(points, _CELL)
    cells = Cells.over(some, size)
    columns = cells.columns + 2  # a border, so that every cell has neighbours
    index = cells.index // cells.columns + 1
    index = index.astype(np.int64) * columns + cells.index % cells.columns + 1
    lowest = np.full((cells.rows + 2) * columns, np.inf)
    lower_at(lowest, index, some.z)
    level = np.full(len(lowest), np.nan)  # of the cells that were reached
    on_ground = index[ground[used]]
    level[on_ground] = lowest[on_ground]
    todo = np.unique(index[inside[used]])
    todo = todo[np.isnan(level[todo])]
    for _ in range(int(CONTINUED / size)):
        new = _is_reached(level, lowest, todo, columns, size)
        if not new.any():
            break
        level[todo[new]] = lowest[todo[new]]
        todo = todo[~new]
    found[used] = inside[used] & (some.z <= level[index] + _LAYER)
    return found


def _is_reached(
    level: np.ndarray, lowest: np.ndarray, todo: np.ndarray, columns: int, size: float
) -> np.ndarray:
    """Return which cells are reached from a neighbour without a step."""
    reached = np.zeros(len(todo), dtype=bool)
    for row, column in _ROUND:
        rise = np.abs(lowest[todo] - level[todo + row * columns + column])
        reached |= rise <= _STEEPEST * size * np.hypot(row, column)  # not of NaN
    return reached
