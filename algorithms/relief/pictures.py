"""Pictures of the relief that combine several measures.

References
----------
Kokalj, Z. and Somrak, M. (2019): Why Not a Single Image? Combining Visualizations to Facilitate
Fieldwork and On-Screen Mapping. Remote Sensing 11(7), 747. The visualization for archaeological
topography (VAT).
Chiba, T., Kaneta, S., Suzuki, Y. (2008): Red Relief Image Map: New Visualization Method for Three
Dimensional Data. The International Archives of the Photogrammetry, Remote Sensing and Spatial
Information Sciences 37(B2), 1071-1076.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .hillshade import as_bytes, brightness, slope
from .horizons import Cells, openness, sky_view_and_openness


class _Land(NamedTuple):
    """The values that are black and white in VAT, for a kind of land."""

    sky: tuple[float, float]  # sky-view factors
    open: tuple[float, float]  # openness in degrees
    steep: tuple[float, float]  # slopes in degrees
    altitude: float  # angle of the light above the horizon in degrees
    radii: tuple[float, float]  # distances between which terrain can hide the sky, in radii


# The values of Kokalj and Somrak, as in their Relief Visualization Toolbox.
_HILLY = _Land((0.7, 1.0), (68.0, 93.0), (50.0, 0.0), 35.0, (0.0, 1.0))
_LEVEL = _Land((0.9, 1.0), (85.0, 93.0), (15.0, 0.0), 15.0, (0.8, 2.0))
_AZIMUTH = 315.0
VAT_RADII = _LEVEL.radii[1]  # distance in radii up to which cells affect VAT
_REDDEST = 45.0  # slope in degrees from which on red is full
# Differences of openness in degrees that are black and white: level land is rather bright.
_DARKEST = -10.0
_BRIGHTEST = 4.0


def archaeological_topography(heights: np.ndarray, cells: Cells, radius: float) -> np.ndarray:
    """Return the visualization for archaeological topography (VAT), for hilly and level land,
    uint8, 1 (black) to 255 (white), 0 where there is no height.
    """
    # A hillshade is blended with slope, openness and sky-view factor, so that features of any
    # direction are visible. The result is the mean of two such pictures: one for hilly land, where
    # terrain up to `radius` metres away can hide the sky, and one for low features of level land,
    # with twice the radius.
    heights = heights.astype(np.float32)
    steep = slope(heights, cells)
    blended = [_blended(heights, steep, cells, radius, land) for land in (_HILLY, _LEVEL)]
    return as_bytes(heights, (blended[0] + blended[1]) / 2)


def _blended(
    heights: np.ndarray, steep: np.ndarray, cells: Cells, radius: float, land: _Land
) -> np.ndarray:
    """Return VAT for a kind of land, 0 to 1."""
    near, far = (share * radius for share in land.radii)
    sky, zenith = sky_view_and_openness(heights, cells, (near, far))
    shade = brightness(heights, cells, _AZIMUTH, land.altitude)
    # Layers from the bottom to the top. Slope: "brightness", by half.
    picture = (shade + _stretched(steep, land.steep)) / 2
    # Openness: "overlay", by half.
    zenith = _stretched(zenith, land.open)
    dark, bright = 2 * picture * zenith, 1 - 2 * (1 - picture) * (1 - zenith)
    picture = (picture + np.where(picture > 0.5, bright, dark)) / 2
    # Sky-view factor: "multiply", by a quarter.
    return picture * (0.75 + 0.25 * _stretched(sky, land.sky))


def red_relief(heights: np.ndarray, cells: Cells, radius: float) -> np.ndarray:
    """Return a red relief image map, in which slopes are red, ridges bright and valleys dark, uint8
    (3, rows, columns), 1 to 255, 0 where there is no height.
    """
    # Without a light, all directions look the same, and rises never look like hollows.
    heights = heights.astype(np.float32)
    # Half of the difference is large on ridges and low in valleys on any slope.
    ridge = (openness(heights, cells, radius) - openness(-heights, cells, radius)) / 2
    value = _stretched(ridge, (_DARKEST, _BRIGHTEST))
    pale = value * (1 - _stretched(slope(heights, cells), (0.0, _REDDEST)))
    return np.stack([as_bytes(heights, band) for band in (value, pale, pale)])


def _stretched(values: np.ndarray, ends: tuple[float, float]) -> np.ndarray:
    """Return values from 0 at the first end to 1 at the second."""
    return np.clip((values - ends[0]) / (ends[1] - ends[0]), 0.0, 1.0)
