"""Raised regions that are terrain by their shape, whatever their border: rocks and ramps."""

from __future__ import annotations

from typing import NamedTuple

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


class RaisedCells(NamedTuple):
    """The cells of raised regions.

    Attributes
    ----------
    region : numpy.ndarray of int64, shape (n,)
        Region of each cell.
    north, east : numpy.ndarray of float, shape (n,)
        Place of each in metres.
    heights, above : numpy.ndarray of float, shape (n,)
        Height of each, and its height above the ground, in metres.
    """

    region: np.ndarray
    north: np.ndarray
    east: np.ndarray
    heights: np.ndarray
    above: np.ndarray


def landforms(
    cells: RaisedCells, area: np.ndarray, foot: np.ndarray, rock_area: float, ramp_area: float
) -> np.ndarray:
    """Return which raised regions are rocks or ramps.

    Parameters
    ----------
    cells : RaisedCells
        All cells of the regions.
    area, foot : numpy.ndarray of float, shape (regions,)
        Square metres, and metres of the border that are level with the ground.
    rock_area, ramp_area : float
        Square metres of the smallest rock, and of the smallest ramp.

    Returns
    -------
    numpy.ndarray of bool, shape (regions,)
    """
    result = np.zeros(len(area), dtype=bool)
    large = np.flatnonzero(area >= min(rock_area, ramp_area))
    if not len(large):
        return result
    number = np.full(len(area), -1)
    number[large] = np.arange(len(large))
    here = np.flatnonzero(number[cells.region] >= 0)
    cells = RaisedCells(*(each[here] for each in cells))
    regions = _Regions(cells._replace(region=number[cells.region]), area[large], foot[large])
    result[large] = regions.rocks(rock_area) | regions.ramps(ramp_area)
    return result


class _Regions:
    """Raised regions that are large, each of which has a cell.

    Parameters
    ----------
    cells, area, foot
        As for `landforms`.
    """

    def __init__(self, cells: RaisedCells, area: np.ndarray, foot: np.ndarray) -> None:
        self._cells, self._area, self._foot = cells, area, foot
        self._count = np.bincount(cells.region, minlength=len(area))

    def _mean(self, values: np.ndarray) -> np.ndarray:
        return np.bincount(self._cells.region, values, len(self._area)) / self._count

    def _centred(self, values: np.ndarray) -> np.ndarray:
        return values - self._mean(values)[self._cells.region]

    def rocks(self, least_area: float) -> np.ndarray:
        """Return which regions rise by themselves as no roof, bridge or wood does.

        A roof or a bridge is level; a wood on a slope is as high above the ground all over.
        """
        region, heights = self._cells.region, self._cells.heights
        is_rock = self._area >= least_area
        for values in (heights, self._cells.above):
            is_rock &= self._mean(self._centred(values) * values) >= _ROCK_DEVIATION**2
        for each in np.flatnonzero(is_rock):
            z = np.sort(heights[region == each])
            in_band = np.searchsorted(z, z + _BAND) - np.arange(len(z))
            is_rock[each] = in_band.max() <= _BAND_SHARE * len(z)
        return is_rock

    def ramps(self, least_area: float) -> np.ndarray:
        """Return which regions are straight strips that rise evenly from the ground.

        Such is a road on a dam with walls that climbs to a bridge: all of its border but one end
        drops. The height of a bridge or of a roof does not grow from one end to the other.
        """
        above = self._cells.above
        y, x = (self._centred(each) for each in (self._cells.north, self._cells.east))
        yy, xy, xx = (self._mean(one * other) for one, other in ((y, y), (y, x), (x, x)))
        # Variances along the longer and the shorter axis, and where the longer points.
        apart = np.hypot((xx - yy) / 2.0, xy)
        along, across = ((xx + yy) / 2.0 + sign * apart for sign in (1.0, -1.0))
        angle = np.arctan2(2.0 * xy, xx - yy) / 2.0
        length, width = (np.sqrt(12.0 * np.maximum(each, 0.0)) for each in (along, across))
        common = np.abs(
            np.cos(angle) * self._mean(x * above) + np.sin(angle) * self._mean(y * above)
        )
        rise = length * common / np.maximum(along, 1e-9)
        start = self._mean(above) - rise / 2.0
        is_ramp = self._area >= least_area
        is_ramp &= (length >= _RAMP_LENGTH * width) & (rise >= _RAMP_RISE)
        is_ramp &= common**2 >= _RAMP_SHARE * along * self._mean(self._centred(above) * above)
        return is_ramp & (np.abs(start) <= _RAMP_START * rise) & (self._foot >= _RAMP_FOOT * width)
