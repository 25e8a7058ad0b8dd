"""Landforms with drops on most sides: rocks and low banks."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ..pipeline import Rule, Stage
from .raised_regions import RaisedRegions


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
        number, count = regions.number, np.bincount(regions.number)
        is_rock = regions.area >= self.area
        for values in (regions.heights, regions.heights_above):
            mean = np.bincount(number, values) / count
            square = (values - mean[number]) * values
            is_rock &= np.bincount(number, square) >= self.deviation**2 * count
        for rock in np.flatnonzero(is_rock):
            z = np.sort(regions.heights[number == rock])
            in_band = np.searchsorted(z, z + self.band) - np.arange(len(z))
            is_rock[rock] = in_band.max() <= self.band_share * len(z)
        return is_rock


@dataclass(frozen=True)
class LowBanks(Rule):
    """A low, narrow and even strip is a bank of a field, a dyke or the rim of a ditch.

    Of a hedge or a wall, cells have points on the ground beside it; of a row of cars, they are not
    even. No real tile needs it so far; without it generated banks of 1.2 x 5 m are lost.

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
        region = regions.number
        share = np.bincount(region, regions.even, count) / np.bincount(region, minlength=count)
        is_bank = (regions.area >= self.area) & (width <= self.width)
        return is_bank & (regions.above <= self.height) & (share >= self.even_share)
