"""Filling the empty cells of a grid with a smooth surface through the others."""

from __future__ import annotations

import numpy as np

_RELAXATIONS = 12
# Share of unknown cells above which computing all is faster than picking them out.
_MANY = 0.15


def inpaint(grid: np.ndarray, relaxations: int = _RELAXATIONS) -> np.ndarray:
    """Return `grid` with its NaN cells filled by an approximate membrane.

    Coarser and coarser means of the known cells are interpolated back into the gaps ("push-pull";
    Gortler et al. 1996), and relaxed towards the mean of the four neighbours (Laplace's equation)
    on each level. Cost and reach follow the number of cells and the width of the gaps.

    Parameters
    ----------
    grid : numpy.ndarray of float, shape (rows, columns)
        Heights; NaN where there is none.
    relaxations : int
        Sweeps on each level.

    Returns
    -------
    numpy.ndarray of float64, shape (rows, columns)
        Known cells as they were; all zero if no cell is known.
    """
    known = np.isfinite(grid)
    if known.all():
        return np.array(grid, dtype=np.float64)
    if not known.any():
        return np.zeros(grid.shape)
    if min(grid.shape) <= 1 and max(grid.shape) <= 2:
        return np.where(known, grid, grid[known].mean())
    filled = np.where(known, grid, _finer(inpaint(_coarser(grid, known), relaxations), grid.shape))
    padded = np.pad(filled, 1, mode="edge")
    relax = _relax_all if np.count_nonzero(~known) > _MANY * known.size else _relax_some
    relax(padded, ~known, relaxations)
    return padded[1:-1, 1:-1].copy()


def _relax_all(padded: np.ndarray, unknown: np.ndarray, relaxations: int) -> None:
    """Set the unknown cells to the mean of their neighbours, again and again."""
    inner, mean = padded[1:-1, 1:-1], np.empty(unknown.shape)
    for _ in range(relaxations):
        np.add(padded[1:-1, :-2], padded[1:-1, 2:], out=mean)
        mean += padded[:-2, 1:-1]
        mean += padded[2:, 1:-1]
        mean *= 0.25
        np.copyto(inner, mean, where=unknown)
        _pad_again(padded)


def _relax_some(padded: np.ndarray, unknown: np.ndarray, relaxations: int) -> None:
    """Do as `_relax_all` where the unknown cells are few."""
    row, column = np.nonzero(unknown)
    width = padded.shape[1]
    place = (row + 1) * width + column + 1
    flat = padded.ravel()
    for _ in range(relaxations):
        mean = flat[place - 1] + flat[place + 1] + flat[place - width] + flat[place + width]
        flat[place] = 0.25 * mean
        _pad_again(padded)


def _pad_again(padded: np.ndarray) -> None:
    padded[0], padded[-1] = padded[1], padded[-2]
    padded[:, 0], padded[:, -1] = padded[:, 1], padded[:, -2]


def _coarser(grid: np.ndarray, known: np.ndarray) -> np.ndarray:
    """Return the mean of the known ones of each 2 x 2 cells; NaN where none is."""
    rows, columns = (-(-side // 2) for side in grid.shape)
    values, counts = np.zeros((2 * rows, 2 * columns)), np.zeros((2 * rows, 2 * columns))
    values[: grid.shape[0], : grid.shape[1]] = np.where(known, grid, 0.0)
    counts[: grid.shape[0], : grid.shape[1]] = known
    total, count = (
        each[0::2, 0::2] + each[0::2, 1::2] + each[1::2, 0::2] + each[1::2, 1::2]
        for each in (values, counts)
    )
    with np.errstate(invalid="ignore"):
        return np.where(count > 0, total / np.maximum(count, 1.0), np.nan)


def _finer(coarse: np.ndarray, shape: tuple[int, int]) -> np.ndarray:
    """Interpolate bilinearly to cells of half the size."""
    padded = np.pad(coarse, 1, mode="edge")
    rows = np.empty((2 * coarse.shape[0], padded.shape[1]))
    rows[0::2] = 0.75 * padded[1:-1] + 0.25 * padded[:-2]
    rows[1::2] = 0.75 * padded[1:-1] + 0.25 * padded[2:]
    fine = np.empty((rows.shape[0], 2 * coarse.shape[1]))
    fine[:, 0::2] = 0.75 * rows[:, 1:-1] + 0.25 * rows[:, :-2]
    fine[:, 1::2] = 0.75 * rows[:, 1:-1] + 0.25 * rows[:, 2:]
    return fine[: shape[0], : shape[1]]
