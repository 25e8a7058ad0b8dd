"""What can be chosen of a scene."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Settings:
    """What can be chosen of a scene besides its kind; each kind has defaults of its own.

    Attributes
    ----------
    density : float
        Pulses per square metre. Where there are trees there are more points.
    size : float
        Side of the square in metres.
    slope : float
        Rise over run of the land at large.
    height : float
        Height in metres of what the kind is about: a building, a bank, a step, a tree.
    penetration : float
        Share of the pulses that get through the middle of a crown.
    noise : float
        Standard deviation of heights in metres; places are twice as noisy.
    low_outliers : float
        Share of the points that lie far too low, alone or in small groups.
    photogrammetric : bool
        Whether images made the points: one return, edges that are rounded, noise that neighbours
        share, outliers on both sides.
    blur : float
        Of points from images: distance in metres within which their heights are means. With 0, a
        height is that of one place near by.
    low_tail : float
        Of points from images: share of points that lie below the surface, mostly by decimetres.
    """

    density: float = 4.0
    size: float = 160.0
    slope: float = 0.0
    height: float = 5.0
    penetration: float = 0.3
    noise: float = 0.03
    low_outliers: float = 1e-4
    photogrammetric: bool = False
    blur: float = 0.0
    low_tail: float = 0.0
