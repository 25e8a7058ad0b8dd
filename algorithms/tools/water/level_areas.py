"""Dead-level low areas full of returns: water that reflects the laser, or whose bottom it sees.

They are as even as the ranging of the laser, at one level throughout, and lower than the land all
round. A flat field drains, so that it slopes or has furrows, and ditches beside it are lower.
"""

from __future__ import annotations

from typing import Iterator

import numpy as np

from ...grids.morphology import closing, dilation
from .grid import WaterGrid, Window, regions_of
from .levels import MARGIN, spread_of, surface_of

_SQUARE = 5  # side of the square in which the lowest returns are compared, cells
_EVEN = 0.045  # their largest standard deviation there, m
_FULL = 0.6  # least share of its cells that have returns
# Share of class 9 in an area that the file calls water.
_CLASSIFIED = 0.5
# Rows that are looked at together.
_ROWS = 1024
# An even area has at least this share of the smallest area, because its edges are left out.
_LEAST_PART = 0.2
_NEAR = 0.06  # largest distance of returns of one level from it, m
_STEP = 0.02  # steps in which the level is found, m
# Radius in cells of the disc that closes gaps between cells at the level.
_CLOSE = 1.0
# Most spread in metres of parts of the surface.
_MOST_SPREAD = 0.02
_SHORE = 6.0  # width of the shore of an area, cells
_LEAST_KNOWN = 0.4  # least share of these cells with ground
_HIGHER = 0.8  # least share of the shore with ground that is higher than the surface
_LOWER = 0.025  # largest share that is lower
_NEARLY = 0.05  # height that counts as higher or lower, m
_RISE = 0.15  # least height of half of the shore, m


def level_areas(grid: WaterGrid, outside: np.ndarray, least: float) -> np.ndarray:
    """Return which cells belong to dead-level areas of at least `least` cells that are lower than
    the land round them and not outside the survey.
    """
    low = np.zeros(grid.shape, dtype=bool)
    for window, even in regions_of(_even(grid), _LEAST_PART * least, MARGIN + _SQUARE):
        for area in _areas(even, grid.lowest[window], least):
            # Points of class 9 are better evidence.
            is_class = grid.class_in(window)[area].mean() >= _CLASSIFIED
            if not is_class and _is_low(area, grid, window, outside[window]):
                low[window] |= area
    return low


def _even(grid: WaterGrid) -> np.ndarray:
    """Return the cells round which the lowest returns are even."""
    from scipy.ndimage import uniform_filter

    even, reach = np.zeros(grid.shape, dtype=bool), _SQUARE // 2
    for start in range(0, grid.shape[0], _ROWS):
        first = max(start - reach, 0)
        heights = grid.lowest[first : start + _ROWS + reach].astype(np.float64)
        known = np.isfinite(heights)
        if not known.any():
            continue
        heights = np.where(known, heights - np.median(heights[known]), 0.0)
        share, mean, squared = (
            uniform_filter(values, _SQUARE, mode="constant")
            for values in (known.astype(np.float64), heights, heights**2)
        )
        full = np.maximum(share, 1e-9)
        is_even = (squared / full - (mean / full) ** 2 <= _EVEN**2) & (full >= _FULL)
        even[start : start + _ROWS] = is_even[start - first :][:_ROWS]
    return even


def _areas(even: np.ndarray, lowest: np.ndarray, least: float) -> Iterator[np.ndarray]:
    """Yield the connected cells at the level that most cells of an even area have."""
    heights = lowest[even & np.isfinite(lowest)].astype(np.float64)
    steps = np.floor((heights - heights.min()) / _STEP).astype(np.int64)
    counts = np.convolve(np.bincount(steps), np.ones(5), mode="same")
    level = heights.min() + (int(counts.argmax()) + 0.5) * _STEP
    near = dilation(even, 2.0) & (np.abs(lowest - level) <= _NEAR)
    return (area for _, area in regions_of(closing(near, _CLOSE), least))


def _is_low(area: np.ndarray, grid: WaterGrid, window: Window, outside: np.ndarray) -> bool:
    """Return whether an area has one level, and the land round it is higher."""
    surface = surface_of(area, grid.lowest[window], grid.cell).lowest
    if spread_of(surface) > _MOST_SPREAD:
        return False
    shore = dilation(area, _SHORE) & ~dilation(area, 1.0) & ~outside
    land = grid.ground[window][shore]
    known = land[np.isfinite(land)] - np.median(surface)
    if len(known) < max(_LEAST_KNOWN * len(land), 1):
        return False
    higher, lower = (known > _NEARLY).mean(), (known < -_NEARLY).mean()
    return bool(higher >= _HIGHER and lower <= _LOWER and np.median(known) >= _RISE)
