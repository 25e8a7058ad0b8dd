"""Raised regions that are terrain by their shape, whatever their border: rocks."""

from __future__ import annotations

import numpy as np

# Standard deviation in metres of the heights of a rock. A roof is lower, or level: a band of so
# many metres holds more than a share of it.
_ROCK_DEVIATION, _BAND, _BAND_SHARE = 5.0, 3.0, 1.0 / 3.0


def rocks(
    region: np.ndarray,
    heights: np.ndarray,
    above: np.ndarray,
    area: np.ndarray,
    least_area: float,
) -> np.ndarray:
    """Return which regions rise by themselves as no roof, bridge or wood does.

    A roof or a bridge is level; a wood on a slope is as high above the ground all over.

    Parameters
    ----------
    region : numpy.ndarray of int64, shape (n,)
        Region of each raised cell.
    heights, above : numpy.ndarray of float, shape (n,)
        Height of each, and its height above the ground, in metres.
    area : numpy.ndarray of float, shape (regions,)
        Square metres.
    least_area : float
        Square metres of the smallest rock.

    Returns
    -------
    numpy.ndarray of bool, shape (regions,)
    """
    is_rock = area >= least_area
    for values in (heights, above):
        number = np.bincount(region, minlength=len(area))
        apart = values - (np.bincount(region, values, len(area)) / number)[region]
        is_rock &= np.bincount(region, apart**2, len(area)) >= _ROCK_DEVIATION**2 * number
    for each in np.flatnonzero(is_rock):
        z = np.sort(heights[region == each])
        in_band = np.searchsorted(z, z + _BAND) - np.arange(len(z))
        is_rock[each] = in_band.max() <= _BAND_SHARE * len(z)
    return is_rock
