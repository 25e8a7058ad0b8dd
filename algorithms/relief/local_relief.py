"""The trend of a terrain, and its local relief: the heights above the trend.

Burial mounds, old paths, ditches and field banks of some decimetres are invisible in a terrain
model with a range of some hundred metres, but not in its local relief. This is the first step of
Hesse (2010), LiDAR-derived Local Relief Models, Archaeological Prospection 17, 67-72.
"""

from __future__ import annotations

from typing import Callable

import numpy as np

from ..grids.planes import means_and_moments, plane_slopes

TRUNCATE = 3.0  # distance in standard deviations beyond which cells have no weight
_PIECE = 256  # side in cells of the pieces in which planes are fitted
_COMPLETE = 1e-6  # largest share of the weight that may be missing in complete surroundings
_SCALES = (0.5, 1.0, 2.0, 4.0)  # scales of the multi-scale relief in radii

# Standard deviations in cells, along a column and along a row.
Sigma = tuple[float, float]


def reach_of(sigma: float) -> int:
    """Return the distance in cells up to which cells have weight, given the standard deviation."""
    return int(TRUNCATE * sigma + 0.5)


def local_trend(heights: np.ndarray, sigma: Sigma) -> np.ndarray:
    """Return at each cell the height of the plane that fits its surroundings best, float64; NaN
    without a height.
    """
    # The weights of the surroundings are a normal distribution. If the surroundings are complete,
    # the height of the plane is their weighted mean. A value depends only on cells up to
    # `reach_of(sigma)`.
    known = np.isfinite(heights)
    if not known.any():
        return np.full(heights.shape, np.nan)
    filled = np.where(known, heights, 0.0).astype(np.float64)
    smooth, weights = _weighted(sigma), known.astype(np.float64)
    if known.all():  # faster: the product of the weights along rows and along columns
        weight = np.multiply(*(_edge_weights(*line) for line in zip(known.shape, sigma, (1, 0))))
    else:
        weight = smooth(weights, 0, 0)
    lacks = known & (weight < 1.0 - _COMPLETE)
    # In all other cells the sum is the mean.
    trend = smooth(filled, 0, 0)
    trend[~known] = np.nan
    reach = [reach_of(deviation) for deviation in sigma]
    for row in range(0, heights.shape[0], _PIECE):
        for column in range(0, heights.shape[1], _PIECE):
            piece = np.s_[row : row + _PIECE, column : column + _PIECE]
            if lacks[piece].any():
                first = [max(start - by, 0) for start, by in zip((row, column), reach)]
                wide = np.s_[
                    first[0] : row + _PIECE + reach[0], first[1] : column + _PIECE + reach[1]
                ]
                fitted, _, _ = _fitted(filled[wide], weights[wide], smooth)
                fitted = fitted[row - first[0] :, column - first[1] :][:_PIECE, :_PIECE]
                trend[piece] = np.where(lacks[piece], fitted, trend[piece])
    return trend


def trend_slopes(heights: np.ndarray, sigma: Sigma) -> tuple[np.ndarray, np.ndarray]:
    """Return the rise of the plane of `local_trend` from a cell to the next, along a column and
    along a row, also for cells without a height; some cell must have one.
    """
    known = np.isfinite(heights)
    # The mean is subtracted to keep the error of rounding small.
    filled = np.where(known, heights - np.mean(heights[known]), 0.0).astype(np.float64)
    _, along_column, along_row = _fitted(filled, known.astype(np.float64), _weighted(sigma))
    return along_column, along_row


def _kernel(sigma: float, power: int = 0) -> np.ndarray:
    """Return the weights of the cells along an axis, times a power of their distance."""
    steps = np.arange(-reach_of(sigma), reach_of(sigma) + 1.0)
    weights = np.exp(-0.5 * (steps / max(sigma, 1e-9)) ** 2)
    return weights / weights.sum() * steps**power


def _edge_weights(count: int, sigma: float, axis: int) -> np.ndarray:
    """Return the sum of the weights at each of a line of cells, as a row or a column."""
    from scipy.ndimage import correlate1d

    weights = correlate1d(np.ones(count), _kernel(sigma), mode="constant")
    return np.expand_dims(weights, axis)


def _weighted(sigma: Sigma) -> Callable[[np.ndarray, int, int], np.ndarray]:
    """Return a function that sums cells with weights times powers of their row and column."""
    from scipy.ndimage import correlate1d

    def summed(values: np.ndarray, row_power: int, column_power: int) -> np.ndarray:
        for axis, power in enumerate((row_power, column_power)):
            values = correlate1d(values, _kernel(sigma[axis], power), axis, mode="constant")
        return values

    return summed


def _fitted(
    filled: np.ndarray, weights: np.ndarray, summed: Callable[[np.ndarray, int, int], np.ndarray]
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return heights and slopes of the planes, by the normal equations of least squares."""
    total, *sums = (summed(weights, *powers) for powers in ((0, 0), (1, 0), (0, 1)))
    heights, *along = (summed(filled, *powers) for powers in ((0, 0), (1, 0), (0, 1)))
    squares = [summed(weights, *powers) for powers in ((2, 0), (1, 1), (0, 2))]
    total = np.where(total > 0, total, 1.0)
    r, c, z, rr, rc, cc, rz, cz = means_and_moments(total, *sums, heights, *squares, *along)
    # A little is added to the variances, because a line of cells has no slope across it.
    least = 1e-9 * (squares[0] + squares[2]) / total + 1e-9
    slope_r, slope_c = plane_slopes(rr + least, rc, cc + least, rz, cz)
    return z - slope_r * r - slope_c * c, slope_r, slope_c


def local_relief(
    heights: np.ndarray, cell_metres: tuple[float, float], radius: float
) -> np.ndarray:
    """Return the height of a surface above the trend of its surroundings, in its unit as float32,
    given a radius in metres; NaN without a height.
    """
    # The standard deviation of the weights is half the radius. A cell depends on others up to
    # `relief_reach`.
    sigma = radius / 2 / cell_metres[1], radius / 2 / cell_metres[0]
    return (heights - local_trend(heights, sigma)).astype(np.float32)


def relief_reach(cell_metres: tuple[float, float], radius: float) -> int:
    """Return the distance in cells up to which cells affect the local relief."""
    return reach_of(radius / 2 / min(cell_metres))


def multi_scale_relief(
    heights: np.ndarray, cell_metres: tuple[float, float], radius: float
) -> np.ndarray:
    """Return the mean of local reliefs with a half, one, two and four times a radius in metres,
    which shows narrow and wide features in one picture.
    """
    # A cell depends on others up to `multi_scale_reach`. The idea is that of Orengo and Petrie
    # (2018), Multi-scale relief model, Earth Surface Processes and Landforms 43, 1361-1369. They
    # sum up the differences between successive means, which is the difference between the first and
    # the last one.
    reliefs = [local_relief(heights, cell_metres, scale * radius) for scale in _SCALES]
    return sum(reliefs[1:], reliefs[0]) / np.float32(len(_SCALES))


def multi_scale_reach(cell_metres: tuple[float, float], radius: float) -> int:
    """Return the distance in cells up to which cells affect the multi-scale relief."""
    return relief_reach(cell_metres, max(_SCALES) * radius)
