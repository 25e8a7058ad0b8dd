"""Rings of polygons: which places lie inside, and rings that overlap themselves."""

from __future__ import annotations

from typing import Iterator, Sequence

import numpy as np

# Places that are looked at along each side of a ring.
_PLACES = 128
# Rings that are looked at, those with the most corners first, and corners of one that can overlap.
_MOST_RINGS = 500
_FEWEST_CORNERS = 5


def is_odd(x: np.ndarray, y: np.ndarray, polygon: Sequence[np.ndarray]) -> np.ndarray:
    """Return which places, sorted by y, have an odd number of edges of a polygon east of them."""
    odd = np.zeros(len(x), dtype=bool)
    for ring in polygon:
        for places, is_west, _ in _edges(x, y, ring):
            odd[places] ^= is_west
    return odd


def area_lost(polygons: Sequence[Sequence[np.ndarray]]) -> float:
    """Return about how large the parts are that rings cover twice, so that they count as outside;
    a bow-tie has none.
    """
    rings = [ring[:, :2] for polygon in polygons for ring in polygon]
    rings = [ring for ring in rings if len(ring) >= _FEWEST_CORNERS]
    rings.sort(key=len, reverse=True)
    return sum(map(_twice_covered, rings[:_MOST_RINGS]))


def _twice_covered(ring: np.ndarray) -> float:
    low, sides = ring.min(axis=0), np.ptp(ring, axis=0)
    steps = (np.arange(_PLACES) + 0.5) / _PLACES
    y, x = (axis.ravel() for axis in np.meshgrid(steps * sides[1], steps * sides[0], indexing="ij"))
    turns = np.zeros(len(x), dtype=np.int16)
    for places, is_west, direction in _edges(x, y, ring - low):
        turns[places] += direction * is_west
    lost = np.count_nonzero((turns != 0) & (turns % 2 == 0))
    return lost / len(x) * float(sides.prod())


def _edges(
    x: np.ndarray, y: np.ndarray, ring: np.ndarray
) -> Iterator[tuple[slice, np.ndarray, int]]:
    """Yield the places, sorted by y, beside each edge, which of them lie west of it, and 1 for an
    edge that goes up, -1 for one that goes down.
    """
    following = np.roll(ring, -1, axis=0)
    # From the lower to the upper end, so that a common edge of two polygons gives one result.
    upwards = (ring[:, 1] <= following[:, 1])[:, None]
    low, high = np.where(upwards, ring, following), np.where(upwards, following, ring)
    firsts, lasts = np.searchsorted(y, low[:, 1]), np.searchsorted(y, high[:, 1])
    for edge in np.flatnonzero(firsts < lasts):
        places = slice(firsts[edge], lasts[edge])
        (x_low, y_low), (x_high, y_high) = low[edge], high[edge]
        run, rise = x_high - x_low, y_high - y_low
        is_west = (x[places] - x_low) * rise < (y[places] - y_low) * run
        yield places, is_west, 1 if upwards[edge, 0] else -1
