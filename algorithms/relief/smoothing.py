"""Removes noise from heights for pictures of the relief, but keeps banks, ditches and walls.

Under trees, ground points lie some decimetres too high on low plants, and are far apart, so that a
hillshade of them is speckled. The difference of the heights from a smooth trend is noise if it
varies in all directions, and a landform if it varies only across a line: the structure tensor
states how much it varies in the direction in which it varies least. So the heights are smoothed
only as much as they vary in all directions, which is little on open ground.

References
----------
Foerstner, W. and Guelch, E. (1987): A fast operator for detection and precise location of distinct
points, corners and centres of circular features. ISPRS Intercommission Workshop, Interlaken. The
structure tensor and its smaller eigenvalue.
Tukey, J. W. (1977): Exploratory Data Analysis. "Twicing": the residuals of a smoothed surface are
smoothed and added again, so that rounded hills and hollows keep their height.
"""

from __future__ import annotations

import numpy as np

from ..core.threads import in_threads
from .local_relief import TRUNCATE, local_trend, reach_of

# Standard deviation of the weights of the trend in metres, its largest value in cells, and the
# value in cells below which nothing is smoothed.
_METRES = 2.0
_MOST_CELLS = 4.0
_LEAST_CELLS = 0.5
_WIDER = 1.5  # ratio of the standard deviation for the structure tensor to that for the trend
_VISIBLE = 0.02  # slope of noise that is smoothed by half


def smoothing_reach(cell_size: float) -> int:
    """Return the distance in cells up to which cells affect `without_noise`."""
    sigma = _sigma(cell_size)
    return 2 * reach_of(sigma) + 1 + reach_of(_WIDER * sigma) if sigma else 0


def without_noise(heights: np.ndarray, cell_size: float) -> np.ndarray:
    """Return heights in metres, NaN for none, with less noise; unchanged for cells from 4 m on."""
    sigma = _sigma(cell_size)
    heights = heights.astype(np.float64)
    if not sigma or not np.isfinite(heights).any():
        return heights
    rough = heights - local_trend(heights, (sigma, sigma))
    rough -= local_trend(rough, (sigma, sigma))
    largest, smallest = _structure(rough / cell_size, _WIDER * sigma)
    # The share of the difference that varies in all directions, and how visible it is.
    share = smallest / np.maximum(largest, np.finfo(float).tiny)
    return heights - rough * share * smallest / (smallest + _VISIBLE**2)


def _sigma(cell_size: float) -> float:
    sigma = min(_METRES / cell_size, _MOST_CELLS)
    return sigma if sigma > _LEAST_CELLS else 0.0


def _structure(rough: np.ndarray, sigma: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the eigenvalues of the structure tensor: mean squared slopes, the largest first."""
    from scipy.ndimage import correlate1d, gaussian_filter

    def mean(values: np.ndarray) -> np.ndarray:
        return gaussian_filter(values, sigma, mode="constant", truncate=TRUNCATE)

    # Beside cells without a height, the slope is 0, since it would be that of the border.
    down, right = (
        np.nan_to_num(correlate1d(rough, (-0.5, 0.0, 0.5), axis, mode="constant", cval=np.nan))
        for axis in (0, 1)
    )
    rr, rc, cc = in_threads(mean, [down * down, down * right, right * right])
    half, apart = (rr + cc) / 2, np.hypot((rr - cc) / 2, rc)
    return half + apart, np.maximum(half - apart, 0.0)
