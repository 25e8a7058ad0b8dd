"""Patches of a height grid that are enclosed by raised cells."""

from __future__ import annotations

import numpy as np

from .allowance import Allowance

# Least share of an island's border at which the raised cells beside it are level with it.
_ISLAND_SHARE = 0.5
# Most cells of a pit.
_PIT_CELLS = 10
# Cells to each side of a pit that are tested; metres from the mean of two opposite neighbours
# within which a cell is even; and the least share of even cells among the raised ones if the pit is
# in a roof. In crowns hardly any cell is even.
_AROUND, _BEND, _EVEN_SHARE = 3, 0.15, 0.4

# A courtyard has at least so many square metres, lies at most so many metres above the ground round
# the building, and has walls of at least so many metres on this share of its border.
_COURTYARD_AREA, _COURTYARD_HEIGHT, _WALL_HEIGHT, _WALL_SHARE = 100.0, 1.5, 2.0, 0.6


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
    number, cells_of, small = _patches(raised, surveyed)
    small &= cells_of * size**2 <= allowance.island_area
    flat, up, heights = number.ravel(), raised.ravel(), filled.ravel()
    cells = np.flatnonzero(small[flat])
    level, pairs = np.zeros((2, len(small)))
    for offset in (1, -1, raised.shape[1], -raised.shape[1]):
        beside = cells[up[cells + offset]]
        is_level = np.abs(heights[beside + offset] - heights[beside]) <= allowance.gentle_step
        pairs += np.bincount(flat[beside], minlength=len(small))
        level += np.bincount(flat[beside], is_level, len(small))
    small &= level >= _ISLAND_SHARE * pairs
    return small[number]


def pits_in_roofs(filled: np.ndarray, raised: np.ndarray, surveyed: np.ndarray) -> np.ndarray:
    """Return the small patches that are enclosed by even raised cells.

    Points there lie on walls between roofs, or on the ground below a hole.

    Parameters
    ----------
    filled, raised, surveyed
        As for `islands`.

    Returns
    -------
    numpy.ndarray of bool, shape (rows, columns)
    """
    number, cells_of, small = _patches(raised, surveyed)
    pits = (small & (cells_of <= _PIT_CELLS))[number]
    even = is_even(filled)
    width = 2 * _AROUND + 1

    def around_pits(cells: np.ndarray) -> np.ndarray:
        windows = np.lib.stride_tricks.sliding_window_view(np.pad(cells, _AROUND), (width, width))
        return np.count_nonzero(windows[pits], axis=(1, 2))

    pits[pits] = around_pits(even & raised) >= _EVEN_SHARE * around_pits(raised)
    return pits


def is_even(filled: np.ndarray) -> np.ndarray:
    """Return which cells are about as high as the mean of two opposite neighbours."""
    even = np.zeros(filled.shape, dtype=bool)
    for to, z in ((even, filled), (even.T, filled.T)):
        to[1:-1] |= np.abs(z[2:] + z[:-2] - 2.0 * z[1:-1]) <= 2.0 * _BEND
    return even


def courtyards(
    filled: np.ndarray, raised: np.ndarray, surface: np.ndarray, size: float
) -> np.ndarray:
    """Return the wide patches of raised cells that are level with the ground and within walls.

    Parameters
    ----------
    filled, raised, size
        As for `islands`.
    surface : numpy.ndarray of float, shape (rows, columns)
        Height of the ground in metres, through the cells that are not raised.

    Returns
    -------
    numpy.ndarray of bool, shape (rows, columns)
    """
    from scipy import ndimage

    number, count = ndimage.label(raised & (filled <= surface + _COURTYARD_HEIGHT))
    wide = np.bincount(number.ravel(), minlength=count + 1) * size**2 >= _COURTYARD_AREA
    wide[0] = False
    walls, pairs = np.zeros((2, count + 1))
    for ahead, behind in ((np.s_[1:], np.s_[:-1]), (np.s_[:, 1:], np.s_[:, :-1])):
        for here, there in ((ahead, behind), (behind, ahead)):
            border = wide[number[here]] & (number[here] != number[there])
            of = number[here][border]
            wall = (filled[there] - filled[here] >= _WALL_HEIGHT)[border] & raised[there][border]
            pairs += np.bincount(of, minlength=count + 1)
            walls += np.bincount(of, wall, count + 1)
    wide &= walls >= _WALL_SHARE * pairs
    return wide[number]


def _patches(raised: np.ndarray, surveyed: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return each cell's patch number, the cells of each patch, and which patches are enclosed.

    Raised cells have number 0.
    """
    from scipy import ndimage

    number, count = ndimage.label(~raised)
    cells_of = np.bincount(number.ravel(), minlength=count + 1)
    enclosed = np.ones(count + 1, dtype=bool)
    # Patches at the border of the survey are not enclosed.
    for each in (number[~surveyed], number[[0, -1]], number[:, [0, -1]], 0):
        enclosed[each] = False
    return number, cells_of, enclosed
