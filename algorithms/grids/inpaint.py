"""Fill the empty cells of a grid with a smooth surface through the known ones."""

from __future__ import annotations

import numpy as np

RELAXATIONS = 12
_MANY = 0.15  # share of unknown cells above which it is faster to relax all cells
_SAMPLES = 1000  # number of cells from which the usual height is found
_STRIP = 64  # rows that are relaxed together, so that they stay in the processor's cache
_MANY_CELLS = 1 << 16  # number of cells from which on a grid is relaxed in strips
_FAR = 128  # in cells: farther from all known ones, cells are not relaxed
_LEVEL = 128.0  # step in metres to which the usual height is rounded, so that it hardly changes
_QUARTER = np.float32(0.25)
_THREE_QUARTERS = np.float32(0.75)


# Row and column of the first cell of a grid, counted in the grid of the CRS.
First = tuple[int, int]


def inpaint(grid: np.ndarray, relaxations: int = RELAXATIONS, first: First = (0, 0)) -> np.ndarray:
    """Return `grid` with its NaN cells filled by an approximate membrane; 0 if all are NaN."""
    # The known cells are averaged to coarser and coarser grids. These are interpolated back into
    # the gaps ("push-pull"; Gortler et al. 1996), and on each level relaxed towards the mean of the
    # four neighbours (Laplace's equation). So the time depends on the number of cells only, and
    # gaps of any width are filled. Coarser cells begin at even rows and columns of the grid of the
    # CRS, in which `first` is row and column of the first cell.
    known = np.isfinite(grid)
    if known.all():
        return np.array(grid, dtype=np.float64)
    if not known.any():
        return np.zeros(grid.shape)
    # Heights relative to the usual one have an error below 0.1 mm in single precision.
    level = _usual(grid, known)
    beside = np.empty(grid.shape, dtype=np.float32)
    np.subtract(grid, level, out=beside, casting="same_kind")
    filled = np.add(_filled(beside, known, relaxations, first), level, dtype=np.float64)
    np.copyto(filled, grid, where=known)
    return filled


def _usual(grid: np.ndarray, known: np.ndarray) -> float:
    """Return the approximate median, rounded so that a few cells hardly ever change it."""
    places = np.flatnonzero(known)
    places = places[:: max(len(places) // _SAMPLES, 1)]
    usual = float(np.median(grid.ravel().take(places)))
    return _LEVEL * round(usual / _LEVEL)


def _filled(grid: np.ndarray, known: np.ndarray, relaxations: int, first: First) -> np.ndarray:
    """Return a grid (float32) with its unknown cells filled."""
    if known.all():
        return grid
    if max(grid.shape) <= 2:  # two cells can become two coarser ones, without an end
        return np.where(known, grid, grid[known].mean())
    odd = first[0] % 2, first[1] % 2
    half = first[0] // 2, first[1] // 2
    coarse = _filled(*_coarser(grid, known, odd), relaxations, half)
    unknown = ~known
    if np.count_nonzero(unknown) > _MANY * known.size:
        padded = _padded(np.where(known, grid, _finer(coarse, grid.shape, odd)))
        return _relaxed(padded, unknown, relaxations)
    else:
        row, column = np.nonzero(unknown)
        padded = _padded(grid)
        padded[row + 1, column + 1] = _finer_at(coarse, row + odd[0], column + odd[1])
        _pad_again(padded)
        _relax_some(padded, row, column, relaxations)
    return padded[1:-1, 1:-1]


def _relaxed(padded: np.ndarray, unknown: np.ndarray, relaxations: int) -> np.ndarray:
    """Return a grid after its unknown cells were set to the mean of their four neighbours, some
    times; those far from all known cells stay as they are.
    """
    if unknown.size < _MANY_CELLS:
        _relax_all(padded, unknown, relaxations)
        return padded[1:-1, 1:-1]
    relaxed, (rows, columns) = padded[1:-1, 1:-1].copy(), unknown.shape
    known = np.logical_or.reduceat(~unknown, np.arange(0, rows, _STRIP), axis=0)
    strips = _FAR // _STRIP
    for strip in range(len(known)):
        near = np.flatnonzero(known[max(strip - strips, 0) : strip + strips + 1].any(axis=0))
        if not len(near):
            continue
        core = (
            slice(strip * _STRIP, min((strip + 1) * _STRIP, rows)),
            slice(max(near[0] - _FAR, 0), min(near[-1] + _FAR + 1, columns)),
        )
        # Cells beyond the part have an effect one cell farther with each relaxation.
        first = [max(cells.start - relaxations, 0) for cells in core]
        last = [min(cells.stop + relaxations, end) for cells, end in zip(core, unknown.shape)]
        part = padded[first[0] : last[0] + 2, first[1] : last[1] + 2].copy()
        _relax_all(part, unknown[first[0] : last[0], first[1] : last[1]], relaxations)
        inner = (slice(a.start - start + 1, a.stop - start + 1) for a, start in zip(core, first))
        relaxed[core] = part[tuple(inner)]
    return relaxed


def _relax_all(padded: np.ndarray, unknown: np.ndarray, relaxations: int) -> None:
    """Set the unknown cells to the mean of their four neighbours, some times."""
    inner, mean = padded[1:-1, 1:-1], np.empty(unknown.shape, dtype=padded.dtype)
    # A sum of products takes a third of the time of copying the unknown cells.
    kept, share = np.where(unknown, np.float32(0.0), inner), _QUARTER * unknown
    for _ in range(relaxations):
        np.add(padded[1:-1, :-2], padded[1:-1, 2:], out=mean)
        mean += padded[:-2, 1:-1]
        mean += padded[2:, 1:-1]
        mean *= share
        np.add(mean, kept, out=inner)
        _pad_again(padded)


def _relax_some(padded: np.ndarray, row: np.ndarray, column: np.ndarray, relaxations: int) -> None:
    """Relax few unknown cells, given by row and column, as `_relax_all` does."""
    width = padded.shape[1]
    place = (row + 1) * width + column + 1
    flat = padded.ravel()
    for _ in range(relaxations):
        mean = flat.take(place - 1)
        for offset in (1, -width, width):
            mean += flat.take(place + offset)
        flat[place] = _QUARTER * mean
        _pad_again(padded)


def _padded(grid: np.ndarray) -> np.ndarray:
    """Return a grid with a frame of its border cells; `numpy.pad` is slow for small grids."""
    padded = np.empty((grid.shape[0] + 2, grid.shape[1] + 2), dtype=grid.dtype)
    padded[1:-1, 1:-1] = grid
    _pad_again(padded)
    return padded


def _pad_again(padded: np.ndarray) -> None:
    padded[0], padded[-1] = padded[1], padded[-2]
    padded[:, 0], padded[:, -1] = padded[:, 1], padded[:, -2]


def _coarser(grid: np.ndarray, known: np.ndarray, odd: First) -> tuple[np.ndarray, np.ndarray]:
    """Return the mean of the known cells in each 2 x 2 cells, and where there is one; a first row
    or column with an odd number is averaged alone.
    """
    total, count = np.where(known, grid, np.float32(0.0)), known.astype(np.uint8)
    for axis in (0, 1):
        total, count = (_pairs(values, axis, odd[axis]) for values in (total, count))
    return total / np.maximum(count, 1), count > 0


def _pairs(grid: np.ndarray, axis: int, odd: int) -> np.ndarray:
    """Return the sums of pairs of rows or columns; one without a partner at an end stays alone."""
    shape = list(grid.shape)
    shape[axis] = (shape[axis] + odd + 1) // 2
    pairs = np.zeros(shape, dtype=grid.dtype)
    along, lines = (values if axis == 0 else values.T for values in (pairs, grid))
    first, second = lines[odd::2], lines[1 - odd :: 2]
    along[odd : odd + len(first)] = first
    along[: len(second)] += second
    return pairs


def _finer(coarse: np.ndarray, shape: tuple[int, int], odd: First) -> np.ndarray:
    """Interpolate bilinearly to cells of half the size."""
    padded = _padded(coarse)
    rows = np.empty((2 * coarse.shape[0], padded.shape[1]), dtype=coarse.dtype)
    fine = np.empty((rows.shape[0], 2 * coarse.shape[1]), dtype=coarse.dtype)
    near, far = _THREE_QUARTERS * padded[1:-1], _QUARTER * padded
    np.add(near, far[:-2], out=rows[0::2])
    np.add(near, far[2:], out=rows[1::2])
    near, far = _THREE_QUARTERS * rows[:, 1:-1], _QUARTER * rows
    np.add(near, far[:, :-2], out=fine[:, 0::2])
    np.add(near, far[:, 2:], out=fine[:, 1::2])
    return fine[odd[0] : odd[0] + shape[0], odd[1] : odd[1] + shape[1]]


def _finer_at(coarse: np.ndarray, row: np.ndarray, column: np.ndarray) -> np.ndarray:
    """Refine single cells as `_finer` does, in the same order, so that rounding is equal."""
    width = coarse.shape[1]
    # The coarse cell that holds the fine one, and its neighbour on the side of the fine one.
    own_row, own_column = row >> 1, column >> 1
    next_row = np.clip(own_row + 2 * (row & 1) - 1, 0, coarse.shape[0] - 1)
    next_column = np.clip(own_column + 2 * (column & 1) - 1, 0, width - 1)

    def between(of_column: np.ndarray) -> np.ndarray:
        return _THREE_QUARTERS * coarse.take(own_row * width + of_column) + _QUARTER * coarse.take(
            next_row * width + of_column
        )

    return _THREE_QUARTERS * between(own_column) + _QUARTER * between(next_column)
