"""Water that was found, and its outline."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...grids.isolines import Isolines
from ...grids.lines import along

# Least certainty of each grade.
GRADES = ((0.75, "certain"), (0.5, "likely"), (0.0, "doubtful"))


class WaterBody(NamedTuple):
    """A lake, or a part of a river, in metres."""

    kind: str  # "lake" or "river"
    rings: tuple[np.ndarray, ...]  # float64, (n, 3): shore and islands, closed, with their level
    # float64, (m, 3): middle of each branch of a river, downstream, with its level
    lines: tuple[np.ndarray, ...]
    level: float  # of a river, at its upper end
    lowest: float  # of a river, the level at its lower end
    spread: float  # robust standard deviation of the shore from the level
    certainty: float  # 0 to 1
    area: float  # square metres
    width: float  # mean
    class_share: float  # of cells with mostly points of class 9
    filled: float  # number of last returns relative to land

    @property
    def grade(self) -> str:
        """The grade of certainty: certain, likely or doubtful."""
        return next(name for least, name in GRADES if self.certainty >= least)


def divided(ring: np.ndarray, step: float) -> np.ndarray:
    """Return a ring, shape (n, 2), with places that are at most a step apart."""
    return along(np.column_stack((ring, np.zeros(len(ring)))), step)[:, :2]


def rings_of(cells: np.ndarray) -> list[np.ndarray]:
    """Return the outline of a connected region, and then those of its holes, as closed rings of row
    and column, float64 (n, 2), whose corners are cut.
    """
    # Whole numbers are centres of cells.
    heights = np.pad(cells, 1) + 0.5
    lines = [each.places - 1.0 for each in Isolines(1.0, heights.shape[1]).add(heights, 0, True)]
    return [_without_straight(each) for each in sorted(lines, key=lambda each: -abs(_area(each)))]


def _area(ring: np.ndarray) -> float:
    row, column = ring.T
    return float((row[:-1] * column[1:] - row[1:] * column[:-1]).sum() / 2.0)


def _without_straight(ring: np.ndarray) -> np.ndarray:
    """Return a closed ring without the corners that lie on straight lines."""
    corners = ring[:-1]
    back, on = corners - np.roll(corners, 1, axis=0), np.roll(corners, -1, axis=0) - corners
    kept = corners[back[:, 0] * on[:, 1] != back[:, 1] * on[:, 0]]
    return np.concatenate((kept, kept[:1]))
