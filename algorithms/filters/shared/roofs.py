"""Flat roofs that are level with the ground uphill, so that an opening cuts off only a part."""

from __future__ import annotations

import numpy as np

from ...grids.morphology import within_square
from ...grids.plane import plane_through

# Largest difference in metres between 3 x 3 cells of a flat surface, and its least area in square
# metres.
_FLAT, _LEAST_AREA = 0.4, 400.0
# Within the first number of metres of a plane lies at least this share of a roof's raised part. The
# rest of the roof is searched within the last number of metres.
_ON_PLANE, _MOSTLY, _NEAR_PLANE = 0.15, 0.9, 0.2
# Cells round a roof that are tested. At most the first share of them is ground more than so many
# metres above the roof, or at the border of the survey. At most the second share is so high if
# raised cells count as well. The tread of a terrace lies below the next one.
_ROUND, _RISE, _RISING, _ALL_RISING = 2, 0.3, 0.1, 0.4
# The part that was not cut off is at most so many times as large as the part that was, because
# fields between ditches are level as well.
_LARGEST_REST = 1.0


def flat_roofs(
    filled: np.ndarray, raised: np.ndarray, surveyed: np.ndarray, size: float
) -> np.ndarray:
    """Return the cells of flat roofs that are partly raised.

    A large plane surface that is raised is followed to where it ends. On a slope the upper end of a
    roof may be so low that no opening cuts it off. Then the rest of the roof seems to continue
    gently into the ground there.

    Parameters
    ----------
    filled : numpy.ndarray of float32, shape (rows, columns)
        Heights in metres without NaN.
    raised : numpy.ndarray of bool, shape (rows, columns)
        Cells that stand out.
    surveyed : numpy.ndarray of bool, shape (rows, columns)
        Cells with a point, and small gaps between them.
    size : float
        Side of a cell in metres.

    Returns
    -------
    numpy.ndarray of bool, shape (rows, columns)
    """
    from scipy import ndimage

    lowest, highest = (within_square(each, filled, 1) for each in (np.minimum, np.maximum))
    number, count = ndimage.label(raised & (highest - lowest <= _FLAT))
    large = np.bincount(number.ravel(), minlength=count + 1) * size**2 >= _LEAST_AREA
    large[0] = False
    roofs = np.zeros(raised.shape, dtype=bool)
    if not large.any():
        return roofs
    boxes = ndimage.find_objects(number)
    inner = ndimage.binary_erosion(surveyed, np.ones((3, 3)))
    for each in np.flatnonzero(large):
        box = tuple(
            slice(max(2 * side.start - side.stop, 0), 2 * side.stop - side.start)
            for side in boxes[each - 1]
        )
        grids = (filled, raised, surveyed, inner)
        roofs[box] |= _roof(number[box] == each, *(grid[box] for grid in grids))
    return roofs


def _roof(
    part: np.ndarray,
    filled: np.ndarray,
    raised: np.ndarray,
    surveyed: np.ndarray,
    inner: np.ndarray,
) -> np.ndarray:
    """Return the cells of the roof that a part belongs to; none if it is not part of a roof."""
    from scipy import ndimage

    above = filled - plane_through(filled, part)
    none = np.zeros(part.shape, dtype=bool)
    if np.mean(np.abs(above[part]) <= _ON_PLANE) < _MOSTLY:
        return none
    number, _ = ndimage.label(part | (surveyed & (np.abs(above) <= _NEAR_PLANE)))
    whole = number == number[part][0]
    around = within_square(np.maximum, whole, _ROUND) & ~whole
    rising = around & (above > _RISE)
    unlike = np.count_nonzero(rising & ~raised) + np.count_nonzero(whole & ~inner)
    usual = np.count_nonzero(around)
    if unlike > _RISING * usual or np.count_nonzero(rising) > _ALL_RISING * usual:
        return none
    is_small = np.count_nonzero(whole & ~raised) <= _LARGEST_REST * np.count_nonzero(part)
    return whole if is_small else none
