"""Raised regions that are terrain by their shape, whatever their border: rocks and ramps."""

from __future__ import annotations

import numpy as np

# Standard deviation in metres of the heights of a rock. A roof is lower, or level: a band of so
# many metres holds more than a share of it.
_ROCK_DEVIATION, _BAND, _BAND_SHARE = 5.0, 3.0, 1.0 / 3.0
# A ramp is so many times as long as wide, and rises by so many metres at least. Its height above
# the ground follows from the place along it: this share of the variance.
_RAMP_LENGTH, _RAMP_RISE, _RAMP_SHARE = 4.0, 2.0, 0.9
# It begins on the ground, but for this share of its rise, and is level with it there along so much
# of its width.
_RAMP_START, _RAMP_FOOT = 0.25, 0.5


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
        is_rock &= _covariance(region, len(area), values, values) >= _ROCK_DEVIATION**2
    for each in np.flatnonzero(is_rock):
        z = np.sort(heights[region == each])
        in_band = np.searchsorted(z, z + _BAND) - np.arange(len(z))
        is_rock[each] = in_band.max() <= _BAND_SHARE * len(z)
    return is_rock


def ramps(
    region: np.ndarray,
    places: tuple[np.ndarray, np.ndarray],
    above: np.ndarray,
    area: np.ndarray,
    foot: np.ndarray,
    least_area: float,
) -> np.ndarray:
    """Return which regions are straight strips that rise evenly from the ground.

    Such is a road on a dam with walls that climbs to a bridge: all of its border but one end drops.
    The height of a bridge or of a roof does not grow from one end to the other.

    Parameters
    ----------
    region : numpy.ndarray of int64, shape (n,)
        Region of each raised cell.
    places : tuple of numpy.ndarray of float, shape (n,)
        Northing and easting of each in metres.
    above : numpy.ndarray of float, shape (n,)
        Height of each above the ground in metres.
    area, foot : numpy.ndarray of float, shape (regions,)
        Square metres, and metres of the border that are level with the ground.
    least_area : float
        Square metres of the smallest ramp.

    Returns
    -------
    numpy.ndarray of bool, shape (regions,)
    """
    count = len(area)
    yy, xy, xx = (
        _covariance(region, count, places[i], places[j]) for i, j in ((0, 0), (0, 1), (1, 1))
    )
    # Variances along the longer and the shorter axis of each region, and where the longer points.
    apart = np.hypot((xx - yy) / 2.0, xy)
    along, across = ((xx + yy) / 2.0 + sign * apart for sign in (1.0, -1.0))
    angle = np.arctan2(2.0 * xy, xx - yy) / 2.0
    length, width = (np.sqrt(12.0 * np.maximum(each, 0.0)) for each in (along, across))
    ya, xa = (_covariance(region, count, each, above) for each in places)
    common = np.abs(np.cos(angle) * xa + np.sin(angle) * ya)
    rise = length * common / np.maximum(along, 1e-9)
    start = np.bincount(region, above, count) / np.bincount(region, minlength=count) - rise / 2.0
    is_ramp = (area >= least_area) & (length >= _RAMP_LENGTH * width) & (rise >= _RAMP_RISE)
    is_ramp &= common**2 >= _RAMP_SHARE * along * _covariance(region, count, above, above)
    return is_ramp & (np.abs(start) <= _RAMP_START * rise) & (foot >= _RAMP_FOOT * width)


def _covariance(region: np.ndarray, count: int, one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Return the covariance of two values in each region, shape (count,)."""
    number = np.bincount(region, minlength=count)
    mean = np.bincount(region, one, count) / number
    return np.bincount(region, (one - mean[region]) * other, count) / number
