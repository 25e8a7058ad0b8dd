"""Objects that stand on the ground, found in a grid of lowest points by the rims round them.

A roof, a tree or a car ends in a drop on all sides; a hill, a terrace or a bank does not. The drop
is at a *rim*: the higher of two neighbouring cells that differ by more than a threshold. Rims cut
the grid into *regions*, and a region whose border is mostly a drop is a raised object.
"""

from __future__ import annotations

from typing import NamedTuple, Sequence

import numpy as np

from ...core.progress import SILENT, Progress
from ...grids.inpaint import First
from .halls import halls
from .height_steps import HeightSteps

# Least height in metres of the drops round a plateau: a hall may be so low above the ground uphill.
# The cells must be so wide that most points on its walls share a cell with the ground.
PLATEAU_HEIGHT = 1.2
# Gaps up to twice this width, in cells, count as surveyed.
_GAP = 4


class Objects(NamedTuple):
    """Cells that stand out on all sides; grids of shape (rows, columns).

    Attributes
    ----------
    raised : numpy.ndarray of bool
        Cells of objects.
    plateaus : numpy.ndarray of bool
        Cells of regions that are too low for their width to be objects for certain: a roof, or a
        mound.
    halls : numpy.ndarray of bool
        Cells of objects that are large halls.
    """

    raised: np.ndarray
    plateaus: np.ndarray
    halls: np.ndarray


def raised_objects(
    heights: np.ndarray,
    size: float,
    thresholds: Sequence[float],
    max_size: float,
    progress: Progress = SILENT,
    first: First = (0, 0),
    classic: bool = False,
    plateau_height: float | None = None,
) -> Objects:
    """Find the cells of a minimum grid that stand out on all sides.

    Parameters
    ----------
    heights : numpy.ndarray of float, shape (rows, columns)
        Lowest height of each cell in metres; NaN where there is none.
    size : float
        Side of a cell in metres.
    thresholds : sequence of float
        Least heights in metres of the drops that bound an object, one for each pass, the largest
        first. Objects that one pass finds are removed before the next.
    max_size : float
        Largest width (shorter side) of an object in metres.
    progress : Progress
        Receives progress.
    first : tuple of int
        Row and column of the first cell in the grid of the CRS.
    classic : bool
        See `Regions.raised`. If True, plateaus are not searched.
    plateau_height : float, optional
        Least height in metres of a drop that bounds a plateau, for a last pass. Then halls are
        searched as well.

    Returns
    -------
    Objects
    """
    inside = covered(np.isfinite(heights))
    rest = heights.copy()
    objects, plateaus, found = np.zeros((3, *heights.shape), dtype=bool)
    for done, threshold in enumerate(thresholds):
        regions = HeightSteps(rest, size, inside, first).regions(threshold)
        found = regions.raised(max_size, classic)
        if not classic:
            plateaus |= regions.plateaus(max_size)
        rest[found] = np.nan
        objects |= found
        progress((done + 1) / len(thresholds))
    if plateau_height is not None and not classic:
        steps = HeightSteps(rest, size, inside, first)
        plateaus |= steps.regions(plateau_height).plateaus(max_size)
        found = halls(steps, heights, objects | plateaus, max_size, size, first)
        objects |= found
    return Objects(objects, plateaus & ~objects, found)


def covered(known: np.ndarray) -> np.ndarray:
    """Return which cells were surveyed: cells with a height (rows, columns), and small gaps."""
    from scipy import ndimage

    closed = np.pad(known, _GAP).astype(np.uint8)
    for extreme in (ndimage.maximum_filter1d, ndimage.minimum_filter1d):
        for axis in (0, 1):
            closed = extreme(closed, 2 * _GAP + 1, axis=axis, mode="nearest")
    return closed[_GAP:-_GAP, _GAP:-_GAP].astype(bool)
