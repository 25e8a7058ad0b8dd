"""The points as every ground filter sees them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np


@dataclass(frozen=True)
class Frame:
    """Where local metres lie in the coordinate reference system of the survey.

    Attributes
    ----------
    origin : tuple of float
        x and y, in units of the CRS, of the local origin.
    horizontal_unit, vertical_unit : float
        Metres in one unit of the CRS.
    wkt : str or None
        The CRS as well-known text, if the survey has one.
    """

    origin: tuple[float, float] = (0.0, 0.0)
    horizontal_unit: float = 1.0
    vertical_unit: float = 1.0
    wkt: str | None = None


class Points(NamedTuple):
    """Coordinates in metres, relative to a local origin.

    The origin is one for the whole survey, not for the block at hand: grids are anchored at its
    (0, 0), so that a point falls into the same cell however the survey is cut.

    Attributes
    ----------
    x, y, z : numpy.ndarray of float64, shape (n,)
        Easting, northing and height in metres.
    """

    x: np.ndarray
    y: np.ndarray
    z: np.ndarray

    @property
    def count(self) -> int:
        """Number of points (`len` of a named tuple counts its fields)."""
        return len(self.x)

    def take(self, which: np.ndarray) -> Points:
        """Return the points that a boolean mask or an index array names."""
        return Points(self.x[which], self.y[which], self.z[which])

    def and_also(self, others: Points) -> Points:
        """Return these points and others after them."""
        return Points(*(np.concatenate(pair) for pair in zip(self, others)))
