"""Greyscale morphology on height grids."""

from __future__ import annotations

import numpy as np


def opening(grid: np.ndarray, radius: float) -> np.ndarray:
    """Return the opening of a grid by a disc: what is narrower than the disc is cut off.

    Parameters
    ----------
    grid : numpy.ndarray of float, shape (rows, columns)
        Heights without NaN.
    radius : float
        Radius of the disc in cells; a cell belongs to it if its centre does.

    Returns
    -------
    numpy.ndarray of float, shape (rows, columns)
        Nowhere higher than `grid`, which is continued by its border cells: far enough for a disc
        to stand outside, or the upper border of a plain slope would be cut off.
    """
    reach = int(round(radius, 6))
    padded = np.pad(grid, reach, mode="edge")
    opened = -erosion(-erosion(padded, radius), radius)
    return opened[reach : reach + grid.shape[0], reach : reach + grid.shape[1]]


def erosion(grid: np.ndarray, radius: float) -> np.ndarray:
    """Return the minimum of the grid within a disc round each cell.

    A disc is a stack of rows: the minimum along rows of each needed length is found once by
    doubling, so that the cost grows with the radius and not with its square.
    """
    radius = round(radius, 6)  # one that is whole but for rounding is whole
    reach = int(radius)
    rows, columns = grid.shape
    padded = np.pad(grid, reach, mode="edge")
    # Half the length of the disc's row at each distance from its middle row.
    halves = np.floor(np.sqrt(radius**2 - np.arange(reach + 1) ** 2) + 1e-9).astype(int)
    result = np.full(grid.shape, np.inf, dtype=grid.dtype)
    run, length = padded, 1  # run[:, i] is the minimum of `length` cells from i on
    for half in sorted(set(halves.tolist())):
        wanted = 2 * half + 1
        while 2 * length <= wanted:
            run = np.minimum(run[:, :-length], run[:, length:])
            length *= 2
        line = run if length == wanted else _overlapped(run, wanted - length)
        line = line[:, reach - half : reach - half + columns]
        for distance in np.flatnonzero(halves == half):
            for row in {reach - distance, reach + distance}:
                np.minimum(result, line[row : row + rows], out=result)
    return result


def _overlapped(run: np.ndarray, shift: int) -> np.ndarray:
    """Return the minima of runs that are longer by `shift` (at most doubled)."""
    return np.minimum(run[:, :-shift], run[:, shift:])
