"""Greyscale morphology on height grids."""

from __future__ import annotations

import numpy as np

from ..core.threads import in_threads

# Step in metres to which heights are rounded. It is doubled until the range has at most this number
# of steps, which fits into 16 bits.
_STEP = 0.01
_MOST_STEPS = 65_000
# Steps start from a multiple of this number of steps, so that the rounding of a height does not
# depend on other heights.
_LEVEL_STEPS = 12_800
# Heights are clipped this many metres above and below all but this share of the cells: such cells
# stand out anyway.
_BEYOND = 200.0
_NEARLY_ALL = 0.001
# Cells of a strip with its margin, so few that they stay in the processor's cache.
_CELLS_A_STRIP = 1 << 17


def in_steps(grid: np.ndarray) -> tuple[np.ndarray, float]:
    """Return heights in metres without NaN as whole numbers (int16) of steps of 0.01 m, or more if
    they span more than 500 m, and the step.
    """
    # Morphology on whole numbers is three times as fast. The few heights that lie hundreds of
    # metres above or below all others are clipped, so that the steps stay small.
    low, high = float(grid.min()), float(grid.max())
    if high - low > _BEYOND:
        few = int(_NEARLY_ALL * grid.size)
        ends = (few, grid.size - 1 - few)
        nearly_lowest, nearly_highest = np.partition(grid.ravel(), ends)[list(ends)].tolist()
        low, high = max(nearly_lowest - _BEYOND, low), min(nearly_highest + _BEYOND, high)
    step = _STEP
    while high - low > (_MOST_STEPS - _LEVEL_STEPS) * step:
        step *= 2.0
    level = round((low + high) / 2.0 / (_LEVEL_STEPS * step)) * _LEVEL_STEPS
    steps = np.multiply(grid, 1.0 / step, dtype=np.float64)
    np.rint(steps, out=steps)
    steps -= level
    np.clip(steps, -(_MOST_STEPS // 2), _MOST_STEPS // 2, out=steps)
    return steps.astype(np.int16), step


def opening(grid: np.ndarray, radius: float) -> np.ndarray:
    """Return the opening of a grid without NaN by a disc with a radius in cells, which lowers what
    is narrower than the disc.
    """
    # A cell belongs to a disc if its centre does. The grid is continued with its border cells, far
    # enough for discs outside of it, so that the upper border of a plain slope is not lowered.
    padded = np.pad(grid, 2 * _reach(radius), mode="edge")
    return _extreme(np.maximum, _extreme(np.minimum, padded, radius), radius)


def erosion(grid: np.ndarray, radius: float) -> np.ndarray:
    """Return the minimum of the grid within a disc round each cell."""
    return _extreme(np.minimum, np.pad(grid, _reach(radius), mode="edge"), radius)


def dilation(cells: np.ndarray, radius: float) -> np.ndarray:
    """Return which cells have a marked one within a disc; bool, shape (rows, columns)."""
    padded = np.pad(cells, _reach(radius)).view(np.uint8)
    return _extreme(np.maximum, padded, radius).view(bool)


def closing(cells: np.ndarray, radius: float, shrink: float | None = None) -> np.ndarray:
    """Return the closing of marked cells by a disc, with another radius in cells for the erosion if
    `shrink` is given.
    """
    # Cells beyond the grid are not marked.
    shrink = radius if shrink is None else shrink
    reach = _reach(shrink)
    grown = dilation(np.pad(cells, reach), radius)
    return _extreme(np.minimum, grown.view(np.uint8), shrink).view(bool)


def within_square(pick: np.ufunc, grid: np.ndarray, reach: int) -> np.ndarray:
    """Return the extreme (`numpy.minimum` or `numpy.maximum`) of a grid within `reach` rows
    and columns of each cell; cells beyond the grid are ignored.
    """
    rows = len(grid)
    result = np.empty_like(grid)
    strip = max(_CELLS_A_STRIP // grid.shape[1], 2 * reach)

    def fill(first: int) -> None:
        last, before = min(first + strip, rows), min(first, reach)
        part = _spread(pick, grid[first - before : last + reach], reach)
        result[first:last] = _spread(pick, part[before:][: last - first].T, reach).T

    in_threads(fill, range(0, rows, strip))
    return result


def closing_by_square(grid: np.ndarray, reach: int) -> np.ndarray:
    """Return the closing of a grid by a square, which raises pits that are at most `2 * reach`
    cells wide.
    """
    return within_square(np.minimum, within_square(np.maximum, grid, reach), reach)


def sum_of_nine(padded: np.ndarray) -> np.ndarray:
    """Return the sum of the 3 x 3 cells round each cell but those at the border."""
    columns = padded[:, :-2] + padded[:, 1:-1] + padded[:, 2:]
    return columns[:-2] + columns[1:-1] + columns[2:]


def median_of_nine(grid: np.ndarray) -> np.ndarray:
    """Return the median of the 3 x 3 cells round each cell of a grid without NaN, continued with
    its border cells, as `scipy.ndimage.median_filter`.
    """
    # This is ten times as fast, because it does not sort nine cells for each cell.
    padded, median = np.pad(grid, 1, mode="edge"), np.empty_like(grid)
    strip = max(_CELLS_A_STRIP // padded.shape[1], 1)

    def fill(first: int) -> None:
        median[first : first + strip] = _median_of_nine(padded[first : first + strip + 2])

    in_threads(fill, range(0, len(grid), strip))
    return median


def _median_of_nine(padded: np.ndarray) -> np.ndarray:
    """Return the median of the 3 x 3 cells round each, without those at the border."""
    # The cells of each three rows are ranked first, then the ranks of each three columns combined.
    lowest, middle, highest = _ranked(padded[:-2], padded[1:-1], padded[2:])
    left, centre, right = (slice(k, k + padded.shape[1] - 2) for k in range(3))
    return _ranked(
        np.maximum(np.maximum(lowest[:, left], lowest[:, centre]), lowest[:, right]),
        _ranked(middle[:, left], middle[:, centre], middle[:, right])[1],
        np.minimum(np.minimum(highest[:, left], highest[:, centre]), highest[:, right]),
    )[1]


def _ranked(a: np.ndarray, b: np.ndarray, c: np.ndarray) -> tuple[np.ndarray, ...]:
    """Return the lowest, the middle and the highest of three."""
    low, high = np.minimum(a, b), np.maximum(a, b)
    middle = np.minimum(high, c)
    return np.minimum(low, middle), np.maximum(low, middle), np.maximum(high, c)


def _spread(pick: np.ufunc, grid: np.ndarray, reach: int) -> np.ndarray:
    """Return the extreme of `reach` rows before and after each row, in steps that double."""
    done = 0
    while done < reach:
        step = min(done + 1, reach - done)  # a longer step would skip some cells at the border
        spread = grid.copy(order="K")
        pick(spread[step:], grid[:-step], out=spread[step:])
        pick(spread[:-step], grid[step:], out=spread[:-step])
        grid, done = spread, done + step
    return grid


def _reach(radius: float) -> int:
    return int(round(radius, 6))  # without rounding, 2.9999999 would be 2


def _extreme(pick: np.ufunc, padded: np.ndarray, radius: float) -> np.ndarray:
    """Return the minimum or the maximum within a disc round each cell whose disc is in the grid."""
    reach = _reach(radius)
    rows, columns = (side - 2 * reach for side in padded.shape)
    result = np.empty((rows, columns), dtype=padded.dtype)
    strip = max(_CELLS_A_STRIP // padded.shape[1] - 2 * reach, reach, 1)
    disc = _rows_of_disc(radius)

    def fill(first: int) -> None:
        last = min(first + strip, rows)
        _in_strip(pick, padded[first : last + 2 * reach], disc, result[first:last])

    in_threads(fill, range(0, rows, strip))
    return result


def _rows_of_disc(radius: float) -> list[tuple[int, list[int]]]:
    """Return the half-lengths of a disc's rows, ascending, with the rows of each half-length."""
    reach = _reach(radius)
    squares = round(radius, 6) ** 2 - np.arange(-reach, reach + 1) ** 2
    halves = np.floor(np.sqrt(squares) + 1e-9).astype(int)
    return [(half, np.flatnonzero(halves == half).tolist()) for half in np.unique(halves).tolist()]


def _in_strip(
    pick: np.ufunc, padded: np.ndarray, disc: list[tuple[int, list[int]]], result: np.ndarray
) -> None:
    """Fill `result` with the extreme within a disc round each cell of a strip."""
    # A disc is a stack of rows. The extreme along rows of each length is found once, by doubling
    # the length, so that the cost grows with the radius and not with its square. This works on the
    # flattened strip, several times as fast as row by row. Runs that continue from the end of a row
    # into the next one end up outside the columns of the result.
    rows, columns = result.shape
    width = padded.shape[1]
    reach = (width - columns) // 2
    run, length = padded.ravel(), 1  # run[i] is the extreme of `length` cells from i on
    spare, swap, line = (np.empty_like(run) for _ in range(3))
    count = (rows - 1) * width + columns
    ends = np.empty(rows * width, dtype=run.dtype)
    extreme = ends[:count]
    extreme[:] = run[reach * (width + 1) :][:count]
    for half, rows_of_disc in disc:
        wanted = 2 * half + 1
        while 2 * length <= wanted:
            run = pick(run[:-length], run[length:], out=spare[: run.size - length])
            spare, swap = swap, spare
            length *= 2
        shift = wanted - length  # two runs that overlap make a longer one
        full = pick(run[:-shift], run[shift:], out=line[: run.size - shift]) if shift else run
        for row in rows_of_disc:
            first = row * width + reach - half
            pick(extreme, full[first : first + count], out=extreme)
    result[:] = ends.reshape(rows, width)[:, :columns]
