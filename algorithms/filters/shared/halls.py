"""Large halls that are low on one side: on a slope their roofs meet the ground uphill."""

from __future__ import annotations

import numpy as np

from ...grids.inpaint import First, inpaint
from .height_steps import HeightSteps

# Least heights in metres of the drops that bound a roof, one for each pass. Where a roof is only so
# high above the ground, higher ones would leave a gap in its rim.
_DROPS = (0.5, 0.2)
# A roof is cut off from the ground or from another roof where fewer cells than this join them.
_NECK = 3
# Least width (shorter side) of a roof in metres; the treads of terraces are narrower.
_LEAST_WIDTH = 25.0
# A group of halls with the first area, in square metres, stands at least the first height above the
# ground on average, in metres; with the second area or more, the second height; in between, a
# height in between. Smaller groups are no halls. Raised squares are lower, and few of them are as
# large.
_AREAS, _LEAST_HEIGHTS = (2000.0, 8000.0), (6.5, 3.5)
# Cells round a hall that are not taken for ground, because their lowest points may lie on its
# walls.
_WALLS = 2


def halls(
    steps: HeightSteps,
    heights: np.ndarray,
    raised: np.ndarray,
    max_size: float,
    size: float,
    first: First,
) -> np.ndarray:
    """Return the cells of halls, which are bounded by low drops and stand high above the ground.

    Where a roof is level with the ground, no drop bounds it. Such places are mostly short, so
    regions are cut at their necks.

    Parameters
    ----------
    steps : HeightSteps
        The steps of the heights without the known objects.
    heights : numpy.ndarray of float, shape (rows, columns)
        Lowest height of each cell in metres; NaN where there is none.
    raised : numpy.ndarray of bool, shape (rows, columns)
        Cells of known objects and plateaus.
    max_size : float
        Largest width (shorter side) of a hall in metres.
    size : float
        Side of a cell in metres.
    first : tuple of int
        Row and column of the first cell in the grid of the CRS.

    Returns
    -------
    numpy.ndarray of bool, shape (rows, columns)
        Objects and plateaus that touch halls are included.
    """
    from scipy import ndimage

    raised = raised.copy()
    for drop in _DROPS:
        raised |= steps.regions(drop, _NECK).plateaus(max_size, _LEAST_WIDTH)
    number, _ = ndimage.label(raised)
    area = np.bincount(number.ravel()) * size**2
    is_hall = area >= _AREAS[0]
    is_hall[0] = False
    if not is_hall.any():
        return np.zeros(raised.shape, dtype=bool)
    known = np.isfinite(heights)
    walls = ndimage.binary_dilation(raised, np.ones((3, 3)), _WALLS)
    ground = inpaint(np.where(known & ~walls, heights, np.nan), first=first)
    inside = known & raised
    above = np.bincount(number[inside], (heights - ground)[inside], len(area))
    count = np.bincount(number[inside], minlength=len(area))
    is_hall &= above >= np.interp(area, _AREAS, _LEAST_HEIGHTS) * count
    return is_hall[number]
