"""The gradient of a height grid."""

from __future__ import annotations

import numpy as np


def gradient(surface: np.ndarray, size: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the slope of a surface in metres without NaN, rows from south, towards north and east,
    rise over run, with cells of `size` metres.
    """
    # Central differences, one-sided at the border; 0 along an axis of one cell.
    north, east = (
        np.gradient(surface, size, axis=axis) if surface.shape[axis] > 1 else np.zeros_like(surface)
        for axis in (0, 1)
    )
    return north, east


def steepness(surface: np.ndarray, size: float) -> np.ndarray:
    """Return the length of the `gradient` of a surface at each cell, rise over run."""
    return length(*gradient(surface, size))


def length(north: np.ndarray, east: np.ndarray) -> np.ndarray:
    """Return the length of vectors, faster than `numpy.hypot`, which guards against overflow."""
    return np.sqrt(north * north + east * east)
