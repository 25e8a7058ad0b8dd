"""The plane through some cells of a height grid."""

from __future__ import annotations

import numpy as np

# About so many cells are enough for the fit.
_CELLS = 100_000


def plane_through(heights: np.ndarray, which: np.ndarray) -> np.ndarray:
    """Return the heights of the plane that fits best to some cells (least squares).

    Parameters
    ----------
    heights : numpy.ndarray of float, shape (rows, columns)
        In any unit.
    which : numpy.ndarray of bool, shape (rows, columns)
        Cells to fit it to, at least one.

    Returns
    -------
    numpy.ndarray of float64, shape (rows, columns)
    """
    rows, columns = np.nonzero(which)
    step = len(rows) // _CELLS + 1
    rows, columns = rows[::step], columns[::step]
    places = np.column_stack([rows, columns, np.ones(len(rows))]).astype(float)
    (down, right, level), *_ = np.linalg.lstsq(places, heights[rows, columns], rcond=None)
    row, column = np.ogrid[: heights.shape[0], : heights.shape[1]]
    return level + down * row + right * column
