"""Pulses on their way down: where two flight lines send them, and what solid they meet first."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from scipy.ndimage import maximum_filter, minimum_filter

from .classes import GROUND
from .landscape import Deck, Landscape

if TYPE_CHECKING:
    from .settings import Settings

# How far pulses slant at most, in metres per metre of fall; and from how far away, in metres,
# something may stand in their way.
_SLANT = 0.34
_FARTHEST = 12.0
# Metres between the places where the surface is looked at beforehand.
_COARSE = 1.0


class Pulses(NamedTuple):
    """Where pulses end, what they meet there, and how far they slant per metre of height."""

    x: np.ndarray
    y: np.ndarray
    z: np.ndarray
    slant_x: np.ndarray
    slant_y: np.ndarray
    classes: np.ndarray

    def places_at(self, height: np.ndarray | float) -> tuple[np.ndarray, np.ndarray]:
        """Return where the pulses are at an absolute height."""
        rise = height - self.z
        return self.x + self.slant_x * rise, self.y + self.slant_y * rise

    def take(self, which: np.ndarray) -> Pulses:
        """Return some of the pulses."""
        return Pulses(*(column[which] for column in self))


def fly(landscape: Landscape, settings: Settings, random: np.random.Generator) -> Pulses:
    """Return the pulses of two strips, with the first solid thing that they meet."""
    half = settings.size / 2
    tilt = 0.0 if settings.photogrammetric else 1.0
    coarse = _Coarse.of(landscape, half)
    # Evenly spread at a height in between; so far beyond the square that none is missed.
    reach = half + tilt * _SLANT * coarse.relief / 2 + 1.0
    columns = []
    turn = random.uniform(0, np.pi)
    for side in (-1.0, 1.0):
        # Lines of a scanner are not as far apart as its points within a line.
        ratio = random.uniform(0.7, 1.4)
        spacing = np.sqrt(2.0 / settings.density)
        axes = (
            np.arange(-1.45, 1.45, spacing * stretch / reach) * reach
            for stretch in (ratio, 1 / ratio)
        )
        u, v = (axis.ravel() for axis in np.meshgrid(*axes, indexing="ij"))
        u = u + random.normal(0, 0.15 * spacing, u.shape) + random.uniform(0, spacing)
        v = v + random.normal(0, 0.15 * spacing, v.shape) + random.uniform(0, spacing)
        skew = turn + side * random.uniform(0.02, 0.2)
        x, y = u * np.cos(skew) - v * np.sin(skew), u * np.sin(skew) + v * np.cos(skew)
        kept = (np.abs(x) < reach) & (np.abs(y) < reach)
        slant = tilt * np.clip(0.17 * (side + v[kept] / half), -_SLANT, _SLANT)
        columns.append((x[kept], y[kept], -slant * np.sin(skew), slant * np.cos(skew)))
    x, y, slant_x, slant_y = (np.concatenate(column) for column in zip(*columns))
    z = np.full(len(x), coarse.middle)
    pulses = Pulses(x, y, z, slant_x, slant_y, np.zeros(len(x), dtype=np.uint8))
    pulses = _fall(pulses, landscape, coarse)
    kept = (np.abs(pulses.x) < half) & (np.abs(pulses.y) < half)
    if landscape.missing is not None:
        kept &= ~landscape.missing(pulses.x, pulses.y)
    pulses = pulses.take(kept)
    return pulses._replace(classes=np.where(pulses.classes == 0, GROUND, pulses.classes))


class _Coarse(NamedTuple):
    """What is known of the surface, metre by metre: its height, and round about the range of it.

    `near` says where something steep is so near that a pulse may meet it.
    """

    half: float
    z: np.ndarray
    lowest: np.ndarray
    highest: np.ndarray
    near: np.ndarray

    @classmethod
    def of(cls, landscape: Landscape, half: float) -> _Coarse:
        side = np.arange(-half, half + _COARSE, _COARSE)
        x, y = (axis.ravel() for axis in np.meshgrid(side, side, indexing="ij"))
        z = landscape.surface(x, y)[0].reshape(len(side), -1)
        steep = maximum_filter(z, 3) - minimum_filter(z, 3) > 0.9 * _COARSE
        width = 2 * int(min(_SLANT * np.ptp(z), _FARTHEST) / _COARSE) + 7
        near = maximum_filter(steep.astype(np.uint8), width).astype(bool)
        return cls(half, z, minimum_filter(z, width), maximum_filter(z, width), near)

    @property
    def relief(self) -> float:
        return float(np.ptp(self.z))

    @property
    def middle(self) -> float:
        return float(self.z.min() + self.z.max()) / 2

    def cell(self, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, ...]:
        last = len(self.z) - 1
        places = (((axis + self.half) / _COARSE + 0.5).astype(int) for axis in (x, y))
        return tuple(np.clip(place, 0, last) for place in places)


def _fall(pulses: Pulses, landscape: Landscape, coarse: _Coarse) -> Pulses:
    """Follow pulses down to the first solid thing."""
    z = pulses.z
    for _ in range(5):
        z = coarse.z[coarse.cell(*pulses.places_at(z))]
    cell = coarse.cell(*pulses.places_at(z))
    is_near = coarse.near[cell] & (np.hypot(pulses.slant_x, pulses.slant_y) > 0)
    near, far = np.flatnonzero(is_near), np.flatnonzero(~is_near)
    codes = pulses.classes.copy()
    some = pulses.take(far)
    for _ in range(3 if len(near) < len(z) and some.slant_x.any() else 1):
        z[far], codes[far] = landscape.surface(*some.places_at(z[far]))
    low, high = (bound[cell][near] for bound in (coarse.lowest - 1.0, coarse.highest + 0.5))
    z[near], codes[near] = _march(pulses.take(near), landscape, low, high)
    x, y = pulses.places_at(z)
    return Pulses(x, y, z, pulses.slant_x, pulses.slant_y, codes)


def _march(
    pulses: Pulses, landscape: Landscape, low: np.ndarray, high: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return height and class of the first thing met between two heights, from above."""
    above, below = high.copy(), low.copy()
    falling = np.arange(len(low))
    for share in np.linspace(1.0, 0.0, 15)[1:-1]:
        z = (low + share * (high - low))[falling]
        top, _ = landscape.surface(*pulses.take(falling).places_at(z))
        met = top > z
        below[falling[met]] = z[met]
        falling = falling[~met]
        above[falling] = z[~met]
    for _ in range(8):
        middle = (above + below) / 2
        top, _ = landscape.surface(*pulses.places_at(middle))
        inside = top > middle
        below, above = np.where(inside, middle, below), np.where(inside, above, middle)
    # Just inside: so a wall is told from the ground in front of it.
    top, codes = landscape.surface(*pulses.places_at(below))
    return np.where(np.abs(top - below) < 0.2, top, below), codes


def cross_decks(pulses: Pulses, decks: tuple[Deck, ...]) -> Pulses:
    """Stop the pulses that cross a deck above their end."""
    for deck in decks:
        # Where a pulse meets the deck depends on the deck's height there: twice is enough.
        on, z = deck.covers(pulses.x, pulses.y)
        for _ in range(2):
            x, y = pulses.places_at(z)
            on, z = deck.covers(x, y)
        on &= z > pulses.z - 0.3
        pulses = pulses._replace(
            x=np.where(on, x, pulses.x),
            y=np.where(on, y, pulses.y),
            z=np.where(on, z, pulses.z),
            classes=np.where(on, deck.code, pulses.classes),
        )
    return pulses
