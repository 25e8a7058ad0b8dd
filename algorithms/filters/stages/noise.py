"""The noise of ground points: their standard deviation about the surface of the ground."""

from __future__ import annotations

import threading

import numpy as np

from ...core.points import Points
from ...core.threads import in_threads, parts_of
from ...grids.cells import Cells
from ..cell_blocks import CellBlocks

_NOISE_WINDOW = 0.6  # metres from the surface within which points count for the noise
_NOISE_POINTS = 8  # least number of such points in a cell
# The noise of a cloud is this percentile of that of its cells, because most cells have plants.
_NOISE_PERCENTILE = 25
_FARTHEST = 2.4  # metres from the surface beyond which no point is noise of the ground
_STEPS_A_METRE = 1 << 14  # to which rises are rounded
# Where cells hold few points: side in cells of the squares in which noise is measured, and its
# percentile, which is lower since more squares than cells have plants.
_SQUARE = 3
_SQUARE_PERCENTILE = 10
# The middle of the noise in a cell is the mean of the points within this multiple of the noise. It
# is computed twice, since these points change, and from at least this number of points.
_NOISE_FACTOR = 2.5
_MEANS = 2
_MEAN_POINTS = 4
# The lowest of n points lies below the middle by the noise times this, times sqrt(2 ln n).
_LOWEST_FACTOR = 0.8
_POINTS_A_PART = 1 << 15
_POINTS_A_SUM = 1 << 19
# The name in `Points.found` of the box; outside, the cloud was thinned to the lowest points,
# which are less noisy than all.
UNTHINNED = "unthinned"


def middle_of_noise(
    points: Points, cells: Cells, surface: np.ndarray, slopes: tuple[np.ndarray, np.ndarray]
) -> tuple[np.ndarray, float]:
    """Return how many metres the middle of the ground points of each cell (cells,) lies above a
    surface of given slopes, and their noise in metres, 0 if no cell has enough points.
    """
    # The first guess lies above the lowest point by a multiple of the noise that follows from the
    # number of points. Then the points near the guess are averaged.
    rises = _rises(points, cells, surface, slopes)
    sums = _sums(rises, np.zeros(surface.size, np.float32), _NOISE_WINDOW)
    noise = _noise(sums[:, _unthinned(points, cells)], _NOISE_PERCENTILE)
    level = below_middle(np.maximum(sums[0], 1)) * noise
    for _ in range(_MEANS if noise else 0):
        count, total = _sums(rises, level, _NOISE_FACTOR * noise, powers=1)
        level = np.where(count >= _MEAN_POINTS, total / np.maximum(count, 1), level)
    return level, noise


def noise_of_squares(
    points: Points, cells: Cells, surface: np.ndarray, slopes: tuple[np.ndarray, np.ndarray]
) -> float:
    """Return the noise in metres of a cloud with few points in a cell, from squares of 3 x 3 cells;
    0 if no square has enough points.
    """
    # It is a little too large, because it includes the errors of the surface. It is rounded to
    # centimetres, so that the border of a survey hardly changes it.
    rises = _rises(points, cells, surface, slopes)
    sums = _sums(rises, np.zeros(surface.size, np.float32), _NOISE_WINDOW)
    sums *= _unthinned(points, cells)
    squares = CellBlocks.over(cells, _SQUARE * cells.size)
    sums = np.array([squares.total(values.reshape(cells.shape)).ravel() for values in sums])
    return round(_noise(sums, _SQUARE_PERCENTILE), 2)


def _unthinned(points: Points, cells: Cells) -> np.ndarray:
    """Return the cells (cells,) whose middles lie where the cloud was not thinned."""
    west, south, east, north = points.found.get(UNTHINNED, (-np.inf, -np.inf, np.inf, np.inf))
    y, x = (
        (first + np.arange(count) + 0.5) * cells.size
        for first, count in zip(cells.first, cells.shape)
    )
    return np.logical_and.outer((y >= south) & (y < north), (x >= west) & (x < east)).ravel()


def below_middle(number: np.ndarray) -> np.ndarray:
    """Return how far the lowest of `number` points lies below their middle, in standard
    deviations.
    """
    return _LOWEST_FACTOR * np.sqrt(2.0 * np.log(number))


def _noise(sums: np.ndarray, percentile: float) -> float:
    """Return a percentile of the noise, from counts, sums and sums of squares of the rises."""
    count, total, square = sums[:, sums[0] >= _NOISE_POINTS]
    if not len(count):
        return 0.0
    spread = np.sqrt(np.maximum(square / count - (total / count) ** 2, 0.0))
    return float(np.percentile(spread, percentile))


def from_middle(points: Points, cells: Cells, cell: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the distances of points north and east of the middle of their cell, in metres."""
    row = cell // cells.columns  # much faster than `numpy.divmod`
    column = cell - row * cells.columns
    north = points.y - (row + (cells.first_row + 0.5)) * cells.size
    east = points.x - (column + (cells.first_column + 0.5)) * cells.size
    return north, east


def _rises(
    points: Points, cells: Cells, surface: np.ndarray, slopes: tuple[np.ndarray, np.ndarray]
) -> list[tuple[np.ndarray, np.ndarray]]:
    """Return the cells (int32) of the points near the surface, and their heights above it in metres
    (float32), part by part.
    """
    # Rises are multiples of a power of two, so that their sums are exact in any order.
    height, to_north, to_east = (values.ravel() for values in (surface, *slopes))

    def near(part: slice) -> tuple[np.ndarray, np.ndarray]:
        cell = cells.index[part]
        north, east = from_middle(points.take(part), cells, cell)
        rise = points.z[part] - height.take(cell)
        rise -= to_north.take(cell) * north
        rise -= to_east.take(cell) * east
        close = np.flatnonzero(np.abs(rise) <= _FARTHEST)
        rise = np.rint(rise[close] * _STEPS_A_METRE) / _STEPS_A_METRE
        return cell[close], rise.astype(np.float32)

    def joined(part: slice) -> tuple[np.ndarray, np.ndarray]:
        pieces = [
            near(slice(start, min(start + _POINTS_A_PART, part.stop)))
            for start in range(part.start, part.stop, _POINTS_A_PART)
        ]
        cell, rise = (np.concatenate(values) for values in zip(*pieces))
        return cell, rise

    return in_threads(joined, parts_of(points.count, _POINTS_A_SUM))


def _sums(
    rises: list[tuple[np.ndarray, np.ndarray]], level: np.ndarray, most: float, powers: int = 2
) -> np.ndarray:
    """Return the count, the sum and (with 2 powers) the sum of squares of the rises within some
    metres of the level of each cell, (powers + 1, cells).
    """
    sums, lock = np.zeros((powers + 1, level.size)), threading.Lock()

    def add(part: tuple[np.ndarray, np.ndarray]) -> None:
        cell, value = part
        near = np.flatnonzero(np.abs(value - level.take(cell)) <= most)
        if not len(near):
            return
        cell, value = cell.take(near), value.take(near).astype(np.float64)
        first = int(cell.min())
        cell = (cell - first).astype(np.intp)
        found = [np.bincount(cell), np.bincount(cell, value)]
        if powers > 1:
            found.append(np.bincount(cell, value * value))
        with lock:
            sums[:, first : first + len(found[0])] += found

    in_threads(add, rises)
    return sums
