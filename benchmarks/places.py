"""Places where a terrain model is far off: spikes and pits."""

from __future__ import annotations

from typing import NamedTuple, Sequence

import numpy as np

# Least difference from the reference in metres, and least number of cells of 1 m.
FROM, LEAST_CELLS = 1.0, 3


class Place(NamedTuple):
    """A connected place where a terrain model is far off.

    Attributes
    ----------
    row, column : int
        The cell that is farthest off.
    height : float
        How far, in metres; negative for a pit.
    cells : int
        Number of cells.
    """

    row: int
    column: int
    height: float
    cells: int


class Places(NamedTuple):
    """Number of spikes or of pits, and how far the largest is off, in metres."""

    count: int = 0
    largest: float = 0.0


def places_off(difference: np.ndarray) -> list[Place]:
    """Return the spikes and pits in the differences of two models with cells of 1 m, largest first.

    Cells that touch at a corner belong to one place.
    """
    from scipy import ndimage

    found = []
    for sign in (1.0, -1.0):
        off = np.nan_to_num(sign * difference)
        labels, count = ndimage.label(off > FROM, np.ones((3, 3)))
        numbers = np.arange(1, count + 1)
        sizes = np.bincount(labels.ravel(), minlength=count + 1)[1:]
        tops = ndimage.maximum_position(off, labels, numbers) if count else []
        found += [
            Place(*map(int, top), float(difference[top]), int(size))
            for top, size in zip(tops, sizes)
            if size >= LEAST_CELLS
        ]
    return sorted(found, key=lambda place: -abs(place.height))


def counted(places: Sequence[Place]) -> tuple[Places, Places]:
    """Return the spikes and the pits among some places."""
    both = []
    for sign in (1.0, -1.0):
        heights = [sign * place.height for place in places if sign * place.height > 0.0]
        both.append(Places(len(heights), max(heights, default=0.0)))
    return both[0], both[1]
