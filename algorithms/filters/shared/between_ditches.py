"""Land between narrow ditches, which has drops on all sides as an object has."""

from __future__ import annotations

import numpy as np

from ...grids.morphology import within_square

# The largest width and depth of a ditch in metres, and the least area (m2) and width (m) of the
# land between ditches.
_DITCH_WIDTH, _DITCH_DEPTH = 6.0, 2.2
_LEAST_AREA, _LEAST_WIDTH = 100.0, 2.5
# Least share of the land's border that drops into a ditch. The land beyond the ditch may be lower
# by this share of the drop.
_DITCH_SHARE, _BEYOND = 0.5, 0.35
# Least share of its cells that are even; plants are not even.
_EVEN_SHARE = 0.6
# A cell is even within so many metres of the mean of two opposite neighbours.
_BEND = 0.15


def between_ditches(
    filled: np.ndarray, raised: np.ndarray, surface: np.ndarray, size: float
) -> np.ndarray:
    """Return the raised cells of even land that has ditches beside it and land as high beyond them.

    Parameters
    ----------
    filled : numpy.ndarray of float32, shape (rows, columns)
        Heights in metres without NaN.
    raised : numpy.ndarray of bool, shape (rows, columns)
        Cells that stand out.
    surface : numpy.ndarray of float, shape (rows, columns)
        Height of the ground in metres, through the cells that are not raised.
    size : float
        Side of a cell in metres.

    Returns
    -------
    numpy.ndarray of bool, shape (rows, columns)
    """
    from scipy import ndimage

    number, count = ndimage.label(raised & (filled <= surface + _DITCH_DEPTH))
    cells_of = np.bincount(number.ravel(), minlength=count + 1)
    fits = cells_of * size**2 >= _LEAST_AREA
    fits[0] = False
    if not fits.any():
        return np.zeros(raised.shape, dtype=bool)
    reach = max(round(_DITCH_WIDTH / size / 2.0), 1)
    closed = within_square(np.minimum, within_square(np.maximum, filled, reach), reach)
    into_ditch, border = np.zeros((2, count + 1))
    for ahead, behind in ((np.s_[1:], np.s_[:-1]), (np.s_[:, 1:], np.s_[:, :-1])):
        for here, there in ((ahead, behind), (behind, ahead)):
            beside = fits[number[here]] & (number[here] != number[there])
            of, drop = number[here][beside], (filled[here] - filled[there])[beside]
            is_ditch = ~raised[there][beside] & (drop > 0.0)
            is_ditch &= closed[there][beside] >= filled[here][beside] - _BEYOND * drop
            border += np.bincount(of, minlength=count + 1)
            into_ditch += np.bincount(of, is_ditch, count + 1)
    fits &= (into_ditch >= _DITCH_SHARE * border) & (2.0 * cells_of * size >= _LEAST_WIDTH * border)
    even = np.bincount(number[_is_even(filled)], minlength=count + 1)
    fits &= even >= _EVEN_SHARE * cells_of
    return fits[number]


def _is_even(filled: np.ndarray) -> np.ndarray:
    """Return which cells are about as high as the mean of two opposite neighbours."""
    even = np.zeros(filled.shape, dtype=bool)
    for to, z in ((even, filled), (even.T, filled.T)):
        to[1:-1] |= np.abs(z[2:] + z[:-2] - 2.0 * z[1:-1]) <= 2.0 * _BEND
    return even
