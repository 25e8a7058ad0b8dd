"""Regions of cells between rims, and their borders."""

from __future__ import annotations

from functools import cached_property
from typing import NamedTuple

import numpy as np

from ...grids.morphology import within_square

# Least share of the border of a pit that rises.
_PIT_SHARE = 0.9
# Most rounds in which regions are searched, each without the ones found before.
_ROUNDS = 3
# Wider regions, in metres, may be table mountains.
_WIDE = 10.0
# A side of a region is a wall if nearly all of its drop within `_OF_SIDE` metres is a drop within
# `_OF_WALL` metres: the side of the blocks in which objects are searched.
_OF_WALL = 2.0
_OF_SIDE = 4.0
# A region is rough if the median distance of its cells from the mean of two opposite neighbours is
# at least this, in metres. On roofs without installations it is 0.01 to 0.05 m.
_ROUGH = 0.08


class Border(NamedTuple):
    """The pairs of neighbouring cells that lie in different regions."""

    regions: int  # one more than the largest number of a region
    # int32 (pairs,): Region of the first and of the second cell; 0 where nothing is known.
    first: np.ndarray
    second: np.ndarray
    # int8 (pairs,): 1 where the second is higher by more than is allowed, -1 where it is lower,
    # else 0.
    sign: np.ndarray
    # float32 (pairs,): Height of the second above the first in metres, beyond the trend; 0 where
    # `sign` is 0.
    rise: np.ndarray
    cell: np.ndarray  # int32 (pairs, 2): Both cells, in the flattened grid with its frame

    def length(self) -> np.ndarray:
        """Return the length of each region's border in cells, if neighbours are one apart."""
        pairs = np.ones(len(self.sign), dtype=bool)
        # Each cell of a straight border has three neighbours beyond it.
        return self._total(pairs, pairs) / 3.0

    def drops(
        self, removed: np.ndarray, sign: int
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Return, for the border of each region with regions that are not removed, the number of
        drops (`sign` 1) or rises (-1), of known and of all pairs, and the mean drop in metres.
        """
        pairs = ~(removed[self.first] | removed[self.second])
        known = pairs & (self.first > 0) & (self.second > 0)
        stepped = np.flatnonzero(known & (self.sign != 0))
        of_steps = Border(self.regions, *(values[stepped] for values in self[1:]))
        down, up = of_steps.sign == -sign, of_steps.sign == sign
        drops = of_steps._total(down, up)
        height = of_steps._total(down, up, np.abs(of_steps.rise)) / np.maximum(drops, 1)
        return drops, self._total(known, known), self._total(pairs, pairs), height

    def _total(
        self, first: np.ndarray, second: np.ndarray, weights: np.ndarray | None = None
    ) -> np.ndarray:
        """Return the number of pairs, or the sum of their weights, by the region of each cell."""
        total = np.zeros(self.regions)
        for region, own in ((self.first, first), (self.second, second)):
            counted = weights if weights is None else weights[own]
            total += np.bincount(region[own], counted, self.regions)
        return total


class Regions:
    """The regions between rims."""

    # `number`: int32 (rows, columns): The region of each cell; 0 where nothing is known.
    # `width`: float (count,): Width (shorter side) of each region in metres.

    def __init__(
        self, number: np.ndarray, border: Border, size: float, step: int, heights: np.ndarray
    ) -> None:
        self.number, self._heights = number, heights
        self._border, self._size, self._frame = border, size, step
        area = np.bincount(number.ravel(), minlength=border.regions)
        self.width = _shorter_side(area, border.length() / step) * size

    def bounded(
        self,
        max_size: float,
        share: float,
        whole_share: float,
        steepness: float = 0.0,
        height: float = 0.0,
        wall: float = 0.0,
        sign: int = 1,
    ) -> np.ndarray:
        """Return the cells of regions of at most a width (shorter side) in metres whose border
        drops (`sign` 1) or rises (-1).
        """
        # More than `whole_share` of the whole border, and at least `share` of that to known cells,
        # must drop, on average by at least `height` metres and `steepness` times the width. Of the
        # sides of wide regions at least the share `wall` must be walls.
        fits = self.width <= max_size
        fits[0] = False
        found = np.zeros(len(fits), dtype=bool)
        # Cells of regions that were found count as unknown in the next round. So it finds regions
        # whose border they were part of, such as a roof below a tower.
        for _ in range(_ROUNDS):
            drops, known, pairs, mean_height = self._border.drops(found, sign)
            new = fits & ~found & (drops > 0)
            new &= mean_height >= np.maximum(steepness * self.width, height)
            new &= (drops >= share * known) & (drops > whole_share * pairs)
            if wall > 0.0 and (self.width[new] > _WIDE).any():
                new &= ~(self._walls < wall)
            if not new.any():
                break
            found |= new
        return found[self.number]

    def without_ramps(self, found: np.ndarray, width: float) -> np.ndarray:
        """Return the found cells without those of regions to which a ramp leads: whose border is
        level over `width` metres in one place.
        """
        from scipy import ndimage

        closed = np.zeros(len(self.width), dtype=bool)
        closed[self.number[found]] = True
        border = self._border
        is_level = (border.sign == 0) & (border.first > 0) & (border.second > 0)
        sides = []
        for regions, cells in zip((border.first, border.second), border.cell.T):
            own = is_level & closed[regions]
            sides.append((regions[own], cells[own]))
        level = np.zeros([side + 2 * self._frame for side in self.number.shape], dtype=bool)
        for _, cells in sides:
            level.ravel()[cells] = True
        place, _ = ndimage.label(level, np.ones((3, 3)))
        longest = [max(s.stop - s.start for s in box) for box in ndimage.find_objects(place)]
        is_ramp = np.array([0, *longest]) * self._size >= width
        for regions, cells in sides:
            closed[regions[is_ramp[place.ravel()[cells]]]] = False
        return closed[self.number]

    def sunken(self, max_size: float) -> np.ndarray:
        """Return the cells of pits: regions whose border is a rise nearly all round."""
        return self.bounded(max_size, _PIT_SHARE, _PIT_SHARE, sign=-1)

    @cached_property
    def _walls(self) -> np.ndarray:
        """The median share of the drop at the sides of each region that is a drop at a wall; 1 for
        regions that are narrow or smooth, which are no table mountains.
        """
        from scipy import ndimage

        number, heights, walls = self.number, self._heights, np.ones(len(self.width))
        bend = np.fmax(*bends(heights))
        bent, known = (
            np.bincount(number[cells], minlength=len(walls))
            for cells in (bend >= _ROUGH, np.isfinite(bend))
        )
        is_rough = (self.width > _WIDE) & (bent > 0) & (2 * bent >= known)
        if not is_rough.any():
            return walls
        low = np.nan_to_num(heights, nan=np.inf)
        at_wall, at_side = (
            heights - within_square(np.minimum, low, max(round(reach / self._size), 1))
            for reach in (_OF_WALL, _OF_SIDE)
        )
        rim = within_square(np.minimum, number, 1) != within_square(np.maximum, number, 1)
        rim &= is_rough[number] & (at_side > 0.0)
        share, number = at_wall[rim] / at_side[rim], number[rim]
        rough = np.unique(number)
        walls[rough] = ndimage.median(share, number, rough)
        return walls


def bends(heights: np.ndarray) -> np.ndarray:
    """Return how many metres each cell lies from the mean of two opposite neighbours, north and
    south, east and west, shape (2, rows, columns); NaN where one of them has no height.
    """
    found = np.full((2, *heights.shape), np.nan, dtype=heights.dtype)
    for of_axis, z in ((found[0], heights), (found[1].T, heights.T)):
        of_axis[1:-1] = np.abs(z[2:] + z[:-2] - 2.0 * z[1:-1]) / 2.0
    return found


def _shorter_side(area: np.ndarray, perimeter: np.ndarray) -> np.ndarray:
    """Return the shorter side of rectangles; for rounder shapes, the side of a square."""
    quarter = perimeter / 4.0
    rest = quarter**2 - area
    return np.where(rest < 0, np.sqrt(area), quarter - np.sqrt(np.maximum(rest, 0.0)))
