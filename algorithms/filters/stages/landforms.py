"""Raised regions that are terrain by what lies beyond them, or by how they rise."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Iterator, NamedTuple

import numpy as np

from ...grids.cells import are_inside
from ..pipeline import Rule
from ..state import GridState
from .raised_regions import RaisedRegions

_AROUND = tuple((up, right) for up in (-1, 0, 1) for right in (-1, 0, 1) if up or right)
# What lies beyond a gap, if it is no region.
_GROUND, _NOTHING = -1, -2


@dataclass(frozen=True)
class LevelAcross(Rule):
    """A region is terrain if land beyond the gap round it is as high: islands, plates of rock."""

    # A roof has no land at its height beyond a street. Lines in eight directions cross the gap.

    area: float = 30.0  # least area in square metres
    reach: float = 9.0  # largest width of a gap in metres
    depth: float = 0.5  # least depth of a gap in metres
    # Land is as high up to `level` metres of difference, and `slope` for each metre between.
    level: float = 0.3
    slope: float = 0.08
    # Metres over which it must be, with at most this rise over run: rows of panels are tilted more.
    land: float = 2.5
    tilt: float = 0.25
    # On a slope, land uphill is as high as any object. But from a gap there is a step up to it: of
    # this share of the depth of the gap, or this rise over run, within two cells.
    upright: float = 0.6
    share: float = 0.5  # least share of the border of a region beyond which there is such land
    # Plates between fissures have no ground beside them. Beyond gaps of at most `narrow` metres and
    # along at least this share of their border lie others that do so too, as do these in turn.
    narrow: float = 2.0
    plates: float = 0.55
    rounds: int = 3
    roundish: float = 40.0  # largest square of their border as a multiple of their area: no rows
    wide: float = 5.0  # least mean width in metres of other regions that count as land

    def look(self, regions: RaisedRegions, grid: GridState) -> Across:
        """Return what lies beyond the gaps round large regions."""
        number = np.full(regions.shape, _GROUND, dtype=np.int32)
        number.ravel()[regions.cells] = regions.number
        large = np.append(regions.area >= self.area, False)
        # The mean width is two areas by the border.
        may_be_plate = 4.0 * regions.area <= self.roundish * regions.mean_width**2
        is_land = large & np.append(may_be_plate | (regions.mean_width >= self.wide), False)
        border = self._border(regions, number, grid.surveyed, large)
        own = number.ravel()[border]
        beyond = np.full((len(_AROUND), len(border)), _NOTHING, dtype=np.int32)
        is_near = np.zeros(beyond.shape, dtype=bool)
        known = grid.heights.known.ravel()
        for found, near, (up, right) in zip(beyond, is_near, _AROUND):
            for line, there, gap in self._crossed(regions, number, known, border, up, right):
                # Small regions are cells of the edge beyond.
                better = is_land[there] & (found[line] == _NOTHING) | (there == _GROUND)
                found[line[better]] = there[better]
                near[line[better & (gap <= self.narrow + 1.5 * regions.size)]] = True
        total = np.bincount(own, minlength=len(regions.area))
        return Across(own, beyond, is_near, total, may_be_plate, self)

    def _border(
        self, regions: RaisedRegions, number: np.ndarray, surveyed: np.ndarray, large: np.ndarray
    ) -> np.ndarray:
        """Return the cells of large regions that have a lower cell beside them."""
        filled, flat = regions.filled.ravel(), number.ravel()
        inside = regions.cells[large[regions.number]]
        row, column = np.divmod(inside, regions.shape[1])
        is_border = np.zeros(len(inside), dtype=bool)
        for up, right in _AROUND:
            there = are_inside(row + up, column + right, regions.shape)
            cell = np.where(there, inside + up * regions.shape[1] + right, inside)
            drops = filled[inside] - filled[cell] > self.depth
            is_border |= drops & (flat[cell] != flat[inside]) & surveyed.ravel()[cell]
        return inside[is_border]

    def _crossed(
        self,
        regions: RaisedRegions,
        number: np.ndarray,
        known: np.ndarray,
        border: np.ndarray,
        up: int,
        right: int,
    ) -> Iterator[tuple[np.ndarray, np.ndarray, np.ndarray]]:
        """Yield, step by step, which lines from the border have come to land as high beyond a gap,
        the region there, and the width of the gap in metres.
        """
        filled, flat, (rows, columns) = regions.filled.ravel(), number.ravel(), regions.shape
        step, row, column = math.hypot(up, right) * regions.size, *np.divmod(border, columns)
        left, crossed = np.arange(len(border)), np.zeros(len(border), dtype=bool)
        deepest, last, before, land = np.zeros((4, len(border)), dtype=np.float32)
        for k in range(1, int((self.reach + self.land) / step) + 3):
            left = left[are_inside(row[left] + k * up, column[left] + k * right, (rows, columns))]
            cell = border[left] + k * (up * columns + right)
            rise, there, is_known = filled[cell] - filled[border[left]], flat[cell], known[cell]
            again = rise - deepest[left]
            is_level = is_known & (np.abs(rise) <= self.level + self.slope * k * step)
            is_level &= (deepest[left] < -self.depth) & (there != flat[border[left]])
            is_level &= (again > self.depth) & (again > -0.5 * deepest[left])
            climb = rise - np.minimum(last[left], before[left])
            crossed[left] |= is_level & (climb >= self.upright * np.minimum(again, 2.0 * step))
            is_level &= crossed[left]
            is_even = (land[left] == 0.0) | (np.abs(rise - last[left]) <= self.tilt * step)
            land[left] += np.where(is_level & is_even, np.float32(step), -land[left])
            found = is_level & (land[left] >= self.land)
            yield left[found], there[found], k * step - land[left[found]]
            before[left], last[left] = last[left], np.where(is_known, rise, last[left])
            deepest[left] = np.minimum(deepest[left], last[left])
            goes_on = ((rise < -self.depth) & (there == _GROUND)) | ~is_known | is_level
            left = left[goes_on & (there != flat[border[left]])]


class Across(NamedTuple):
    """What lies beyond the gaps round regions."""

    own: np.ndarray  # int32 (n,): The region of each cell along the border of regions
    beyond: np.ndarray  # int32 (8, n): The region beyond the gap, _GROUND or _NOTHING
    is_near: np.ndarray  # bool (8, n): Whether the gap is narrow
    total: np.ndarray  # int (regions,): Number of cells along the border of each region
    may_be_plate: np.ndarray  # bool (regions,): Whether it is no long row
    rule: LevelAcross

    def fits(self, ground: np.ndarray) -> np.ndarray:
        """Return which regions have land beyond the gap, given which are ground (see
        `RaisedRegions.widths`).
        """
        fits = self._plates()
        while True:
            new = self._having(self._which(ground[:-1] | fits), self.rule.share) & ~fits
            if not new.any():
                return fits
            fits |= new

    def _plates(self) -> np.ndarray:
        """Return which regions are plates among plates."""
        plates = self.may_be_plate
        for _ in range(self.rule.rounds):
            beside = self.is_near & self._which(plates)
            plates = self.may_be_plate & self._having(beside, self.rule.plates)
        return plates

    def _which(self, regions: np.ndarray) -> np.ndarray:
        """Return where some regions or the ground lie beyond the gap; boolean, shape (8, n)."""
        return np.append(regions, (False, True))[self.beyond]

    def _having(self, beyond: np.ndarray, share: float) -> np.ndarray:
        """Return which regions have something beyond the gap, on a share of their border."""
        count = np.bincount(self.own, beyond.any(axis=0), len(self.total))
        return (self.total > 0) & (count >= share * self.total)


@dataclass(frozen=True)
class Ramps(Rule):
    """A long region is a ramp if it rises evenly from where it joins the ground, as to a bridge."""

    # A level roof whose uphill side joins a slope does not rise itself.

    areas: tuple[float, float] = (100.0, 6000.0)  # least and largest area in square metres
    width: float = 4.0  # least length in metres of the border that joins the ground in one place
    longish: float = 2.5  # least ratio of the length, from there, to the mean width
    # What joins the ground lies up to this share of the length, and `beyond` metres, from its
    # middle: at least the share `at_foot` of it.
    foot: float = 0.15
    beyond: float = 2.0
    at_foot: float = 0.7
    rises: tuple[float, float] = (0.02, 0.2)  # least and largest rise over run
    fit: float = 0.95  # least share of the variance of its heights that the distance explains
    above: float = 0.5  # least share of its rise by which it rises above the ground round it

    def fits(self, regions: RaisedRegions, ground: np.ndarray) -> np.ndarray:
        """Return which regions are ramps, given which are ground (see `RaisedRegions.widths`)."""
        least, largest = self.areas
        maybe = ~ground[:-1] & (regions.area >= least) & (regions.area <= largest)
        if not maybe.any():
            return maybe
        maybe &= regions.widths(ground) >= self.width
        joins = [
            (pairs[0][ground[pairs[1]]], cells[ground[pairs[1]]])
            for (pairs, *_), cells in zip(regions.borders, regions.level_cells)
        ]
        region, cells = (np.concatenate(parts) for parts in zip(*joins))
        for number in np.flatnonzero(maybe):
            maybe[number] = self._is_ramp(
                regions, regions.number == number, cells[region == number]
            )
        return maybe

    def _is_ramp(self, regions: RaisedRegions, own: np.ndarray, joins: np.ndarray) -> bool:
        """Return whether the cells of a region rise evenly from the cells that join the ground."""
        places, feet = (
            np.array(np.divmod(cells, regions.shape[1])) for cells in (regions.cells[own], joins)
        )
        middle = np.median(feet, axis=1)[:, None]
        away, of_feet = (np.hypot(*(axes - middle)) * regions.size for axes in (places, feet))
        length = float(away.max())
        if length**2 < self.longish * len(away) * regions.size**2:
            return False
        if np.mean(of_feet <= self.foot * length + self.beyond) < self.at_foot:
            return False
        (spread, rise, above), (_, variance, _), _ = np.cov(
            (away, regions.heights[own], regions.heights_above[own])
        )
        least, most = self.rises
        is_even = rise**2 >= self.fit * spread * variance
        return bool(least * spread <= rise <= most * spread and is_even) and bool(
            above >= self.above * rise
        )
