"""Raised regions that are terrain because of their shape, with any border: rocks and ramps."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .allowance import Allowance

# Least standard deviation in metres of the heights of a rock. A roof is lower, or level: then a
# band of so many metres holds more than this share of its cells.
_ROCK_DEVIATION, _BAND, _BAND_SHARE = 5.0, 3.0, 1.0 / 3.0
# A ramp is at least so many times as long as wide, and rises by at least so many metres. The place
# along it explains at least this share of the variance of its height above the ground.
_RAMP_LENGTH, _RAMP_RISE, _RAMP_SHARE = 4.0, 2.0, 0.9
# It begins at the height of the ground, within this share of its rise, and is level with the ground
# along at least this share of its width.
_RAMP_START, _RAMP_FOOT = 0.25, 0.5


class RaisedCells(NamedTuple):
    """The cells of raised regions.

    Attributes
    ----------
    region : numpy.ndarray of int64, shape (n,)
        Region of each cell.
    north, east : numpy.ndarray of float, shape (n,)
        Coordinates of each cell in metres.
    heights, above : numpy.ndarray of float, shape (n,)
        Height of each, and its height above the ground, in metres.
    """

    region: np.ndarray
    north: np.ndarray
    east: np.ndarray
    heights: np.ndarray
    above: np.ndarray


def landforms(
    cells: RaisedCells, feet: np.ndarray, size: float, allowance: Allowance
) -> np.ndarray:
    """Return which raised regions are rocks or ramps.

    Parameters
    ----------
    cells : RaisedCells
        All cells of the regions.
    feet : numpy.ndarray of intp, shape (sides,)
        Indices of the cells that are level with the ground beside them, once for each such side.
    size : float
        Side of a cell in metres.
    allowance : Allowance
        Least areas of rocks and ramps.

    Returns
    -------
    numpy.ndarray of bool, shape (regions,)
    """
    area = np.bincount(cells.region) * size**2
    result = np.zeros(len(area), dtype=bool)
    least = allowance.rock_area, allowance.ramp_area
    large = np.flatnonzero(area >= min(least))
    if not len(large):
        return result
    number = np.full(len(area), -1)
    number[large] = np.arange(len(large))
    cells = cells._replace(region=number[cells.region])
    here = np.flatnonzero(cells.region >= 0)
    feet = feet[cells.region[feet] >= 0]
    inside, level = (RaisedCells(*(each[which] for each in cells)) for which in (here, feet))
    regions = _Regions(inside, level, area[large], size)
    found = (regions.rocks, regions.ramps)
    result[large] = np.any([find(smallest) for find, smallest in zip(found, least)], axis=0)
    return result


class _Regions:
    """Large raised regions, each with at least one cell.

    Parameters
    ----------
    cells, feet : RaisedCells
        All cells of the regions, and those that are level with the ground, once for each side.
    area : numpy.ndarray of float, shape (regions,)
        Square metres.
    size : float
        Side of a cell in metres.
    """

    def __init__(
        self, cells: RaisedCells, feet: RaisedCells, area: np.ndarray, size: float
    ) -> None:
        self._cells, self._feet, self._area, self._size = cells, feet, area, size
        self._count = np.bincount(cells.region, minlength=len(area))

    def _mean(self, values: np.ndarray) -> np.ndarray:
        return np.bincount(self._cells.region, values, len(self._area)) / self._count

    def _centred(self, values: np.ndarray) -> np.ndarray:
        return values - self._mean(values)[self._cells.region]

    def rocks(self, least_area: float) -> np.ndarray:
        """Return which regions rise more unevenly than roofs, bridges and woods.

        A roof or a bridge is level; a wood on a slope is equally high above the ground everywhere.
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

        An example is a road on a dam with walls that climbs to a bridge: all of its border except
        one end drops. The height of a bridge or a roof does not grow from one end to the other.
        """
        above = self._cells.above
        y, x = (self._centred(each) for each in (self._cells.north, self._cells.east))
        yy, xy, xx = (self._mean(one * other) for one, other in ((y, y), (y, x), (x, x)))
        # Variances along the longer and the shorter axis, and the direction of the longer one.
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
        foot = np.bincount(self._feet.region, minlength=len(self._area)) * self._size
        return is_ramp & (np.abs(start) <= _RAMP_START * rise) & (foot >= _RAMP_FOOT * width)
