"""Small patches that are not raised, but enclosed by raised cells of a height grid."""

from __future__ import annotations

import numpy as np

from .allowance import Allowance

# Share of the border of an island at which what is raised beside it is as high.
_ISLAND_SHARE = 0.5


def islands(
    filled: np.ndarray, raised: np.ndarray, surveyed: np.ndarray, size: float, allowance: Allowance
) -> np.ndarray:
    """Return the small patches within raised cells that are level with them.

    Parameters
    ----------
    filled : numpy.ndarray of float32, shape (rows, columns)
        Heights in metres without NaN.
    raised : numpy.ndarray of bool, shape (rows, columns)
        Cells that stand out.
    surveyed : numpy.ndarray of bool, shape (rows, columns)
        Cells with a point, and small gaps between them.
    size : float
        Side of a cell in metres.
    allowance : Allowance
        What is level, and how large an island may be.

    Returns
    -------
    numpy.ndarray of bool, shape (rows, columns)
    """
    from scipy import ndimage

    number, count = ndimage.label(~raised)
    flat = number.ravel()
    small = np.bincount(flat, minlength=count + 1) * size**2 <= allowance.island_area
    # Nothing is known of what lies beyond the survey.
    small[number[~surveyed]] = False
    for border in (number[[0, -1]], number[:, [0, -1]]):
        small[border] = False
    small[0] = False
    up, heights = raised.ravel(), filled.ravel()
    cells = np.flatnonzero(small[flat])
    level, pairs = np.zeros((2, count + 1))
    for offset in (1, -1, raised.shape[1], -raised.shape[1]):
        beside = cells[up[cells + offset]]
        is_level = np.abs(heights[beside + offset] - heights[beside]) <= allowance.gentle_step
        pairs += np.bincount(flat[beside], minlength=count + 1)
        level += np.bincount(flat[beside], is_level, count + 1)
    small &= level >= _ISLAND_SHARE * pairs
    return small[number]
