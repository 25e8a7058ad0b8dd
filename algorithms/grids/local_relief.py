"""Local relief: the height of the terrain above its surroundings, which shows small features.

Burial mounds, old paths, ditches and field banks of some decimetres cannot be seen in a terrain
model with a range of some hundred metres. They stand out when the trend of the land is removed: the
first step of Hesse (2010), LiDAR-derived Local Relief Models, Archaeological Prospection 17, 67-72.
"""

from __future__ import annotations

import numpy as np

from .local_trend import local_trend, reach_of

# The scales of the multi-scale relief, in radii.
_SCALES = (0.5, 1.0, 2.0, 4.0)


def local_relief(
    heights: np.ndarray, cell_metres: tuple[float, float], radius: float
) -> np.ndarray:
    """Return the height of a surface, in its unit as float32, above the mean of its surroundings of
    a radius in metres; NaN where the surface is.
    """
    # The mean is weighted by a normal distribution whose standard deviation is half the radius. A
    # cell depends on others up to `relief_reach`.
    sigma = radius / 2 / cell_metres[1], radius / 2 / cell_metres[0]
    # At an edge the trend is that of a plane, because otherwise a slope would be visible there.
    return (heights - local_trend(heights, sigma)).astype(np.float32)


def relief_reach(cell_metres: tuple[float, float], radius: float) -> int:
    """Return how many cells away a cell still matters to the local relief."""
    return reach_of(radius / 2 / min(cell_metres))


def multi_scale_relief(
    heights: np.ndarray, cell_metres: tuple[float, float], radius: float
) -> np.ndarray:
    """Return the mean of local reliefs with half of a radius, the radius, twice and four times it,
    so that what is narrow and what is wide are visible in one picture.
    """
    # A cell depends on others up to `multi_scale_reach`. The idea is that of Orengo and Petrie
    # (2018), Multi-scale relief model, Earth Surface Processes and Landforms 43, 1361-1369. There,
    # the differences between successive means are summed, which is the difference between the first
    # and the last.
    reliefs = [local_relief(heights, cell_metres, scale * radius) for scale in _SCALES]
    return sum(reliefs[1:], reliefs[0]) / np.float32(len(_SCALES))


def multi_scale_reach(cell_metres: tuple[float, float], radius: float) -> int:
    """Return how many cells away a cell still matters to the multi-scale relief."""
    return relief_reach(cell_metres, max(_SCALES) * radius)
