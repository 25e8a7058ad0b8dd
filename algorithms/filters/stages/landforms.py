"""Landforms with drops on most sides: rocks, ramps and low banks."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ..pipeline import Rule, Stage
from .raised_regions import RaisedRegions, RegionCells


@dataclass(frozen=True)
class Rocks(Rule):
    """A region that rises more unevenly than roofs, bridges and woods is a rock.

    A roof or a bridge is level; a wood on a slope is equally high above the ground everywhere.

    Attributes
    ----------
    area : float
        Least area in square metres.
    deviation : float
        Least standard deviation in metres of its heights, and of its heights above the ground.
    band, band_share : float
        A roof is lower, or level: then a band of so many metres holds more than this share of its
        cells.
    """

    stage: ClassVar = Stage.TERRAIN

    area: float = 200.0
    deviation: float = 5.0
    band: float = 3.0
    band_share: float = 1.0 / 3.0

    def fits(self, regions: RaisedRegions) -> np.ndarray:
        """Return which regions are rocks; boolean, shape (regions,)."""
        large = _Large(regions, self.area)
        is_rock = np.ones(len(large.which), dtype=bool)
        for values in (large.cells.heights, large.cells.above):
            is_rock &= large.mean(large.centred(values) * values) >= self.deviation**2
        for number in np.flatnonzero(is_rock):
            z = np.sort(large.cells.heights[large.cells.region == number])
            in_band = np.searchsorted(z, z + self.band) - np.arange(len(z))
            is_rock[number] = in_band.max() <= self.band_share * len(z)
        return large.spread(is_rock)


@dataclass(frozen=True)
class Ramps(Rule):
    """A straight strip that rises evenly from the ground is a ramp.

    An example is a road on a dam with walls that climbs to a bridge: all of its border except one
    end drops. The height of a bridge or a roof does not grow from one end to the other.

    Attributes
    ----------
    area : float
        Least area in square metres.
    length : float
        Least length over width.
    rise : float
        Least rise in metres.
    share : float
        The place along it explains at least this share of the variance of its height above the
        ground.
    start : float
        It begins at the height of the ground, within this share of its rise.
    foot : float
        It is level with the ground along at least this share of its width.
    """

    stage: ClassVar = Stage.TERRAIN

    area: float = 100.0
    length: float = 4.0
    rise: float = 2.0
    share: float = 0.9
    start: float = 0.25
    foot: float = 0.5

    def fits(self, regions: RaisedRegions) -> np.ndarray:
        """Return which regions are ramps; boolean, shape (regions,)."""
        large = _Large(regions, self.area)
        if not len(large.which):
            return large.spread(np.zeros(0, dtype=bool))
        above = large.cells.above
        y, x = (large.centred(axis) for axis in (large.cells.north, large.cells.east))
        yy, xy, xx = (large.mean(product) for product in (y * y, x * y, x * x))
        # Variances along the longer and the shorter axis, and the direction of the longer one.
        apart = np.hypot((xx - yy) / 2.0, xy)
        along, across = ((xx + yy) / 2.0 + sign * apart for sign in (1.0, -1.0))
        angle = np.arctan2(2.0 * xy, xx - yy) / 2.0
        length, width = (np.sqrt(12.0 * np.maximum(side, 0.0)) for side in (along, across))
        common = np.abs(
            np.cos(angle) * large.mean(x * above) + np.sin(angle) * large.mean(y * above)
        )
        rise = length * common / np.maximum(along, 1e-9)
        start = large.mean(above) - rise / 2.0
        is_ramp = (length >= self.length * width) & (rise >= self.rise)
        is_ramp &= common**2 >= self.share * along * large.mean(large.centred(above) * above)
        foot = np.bincount(large.feet.region, minlength=len(rise)) * regions.size
        is_ramp &= (np.abs(start) <= self.start * rise) & (foot >= self.foot * width)
        return large.spread(is_ramp)


@dataclass(frozen=True)
class LowBanks(Rule):
    """A low, narrow and even strip is a bank of a field, a dyke or the rim of a ditch.

    Of a hedge or a wall, cells have points on the ground beside it; of a row of cars, they are not
    even.

    Attributes
    ----------
    area : float
        Least area in square metres.
    height : float
        Largest mean height above the ground in metres.
    width : float
        Largest mean width in metres.
    even_share : float
        Least share of the cells that are even.
    """

    stage: ClassVar = Stage.TERRAIN

    area: float = 20.0
    height: float = 1.2
    width: float = 6.0
    even_share: float = 0.7

    def fits(self, regions: RaisedRegions) -> np.ndarray:
        """Return which regions are banks; boolean, shape (regions,)."""
        count = len(regions.area)
        sides = np.zeros(count)
        for kinds in regions.borders:
            for first, _ in kinds:
                sides += np.bincount(first, minlength=count)
        width = 2.0 * regions.area / np.maximum(sides * regions.size, regions.size)
        region = regions.cells.region
        share = np.bincount(region, regions.even, count) / np.bincount(region, minlength=count)
        is_bank = (regions.area >= self.area) & (width <= self.width)
        return is_bank & (regions.above <= self.height) & (share >= self.even_share)


class _Large:
    """The regions of at least some square metres, numbered from 0."""

    def __init__(self, regions: RaisedRegions, area: float) -> None:
        self._all = len(regions.area)
        self.which = np.flatnonzero(regions.area >= area)
        number = np.full(self._all, -1)
        number[self.which] = np.arange(len(self.which))
        self.cells, self.feet = (
            self._numbered(cells, number) for cells in (regions.cells, regions.feet)
        )
        self._count = np.bincount(self.cells.region, minlength=len(self.which))

    def _numbered(self, cells: RegionCells, number: np.ndarray) -> RegionCells:
        cells = cells._replace(region=number[cells.region])
        return cells.take(np.flatnonzero(cells.region >= 0))

    def mean(self, values: np.ndarray) -> np.ndarray:
        """Return the mean of a value of each cell over the cells of each region."""
        return np.bincount(self.cells.region, values, len(self.which)) / self._count

    def centred(self, values: np.ndarray) -> np.ndarray:
        """Return how far the value of each cell is from the mean of its region."""
        return values - self.mean(values)[self.cells.region]

    def spread(self, found: np.ndarray) -> np.ndarray:
        """Return a mask over all regions from one over the large ones."""
        mask = np.zeros(self._all, dtype=bool)
        mask[self.which] = found
        return mask
