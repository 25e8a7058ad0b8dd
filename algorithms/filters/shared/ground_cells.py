"""Which cells of a grid of lowest points are ground: the seeds of a terrain surface.

Three rules are combined. A progressive opening cuts off cells that are narrower than a window and
higher than an allowance, which grows with the window and with the slope of the terrain. Regions
with drops all round are objects of any size. Cells that the opening cut off are ground after all if
they continue gently into the ground round them: a dike, a terrace.

References
----------
Zhang, K. et al. (2003): A progressive morphological filter for removing nonground measurements
from airborne LIDAR data. IEEE Transactions on Geoscience and Remote Sensing 41, section II.
Pingel, T., Clarke, K., McBride, W. (2013): An improved simple morphological filter for the terrain
classification of airborne LIDAR data. ISPRS Journal 77, section 2.
"""

from __future__ import annotations

import numpy as np

from ...core.progress import SILENT, Progress
from ...grids.inpaint import First, inpaint
from ...grids.morphology import in_steps, opening, within_square
from .allowance import Allowance
from .between_ditches import between_ditches
from .gentle_regions import gentle_regions, slope_at, smoothed
from .objects import Objects, covered

# A first, strict opening (rise over run) gives the surface from which the terrain's slope is taken.
_FIRST_SLOPE = 0.12
# For large windows cells are taken together in squares, because the objects are large: cells along
# the side of the largest squares, and for each size the first and the last radius in cells.
_TOGETHER = 4
_RADII = ((1, 1, 24), (2, 26, 48), (4, 52, 10_000))
# Metres over which the surface is smoothed for this slope, and the largest slope that counts.
_SLOPE_SMOOTHING, _LARGEST_SLOPE = 5.0, 0.6
# All of a plateau is cut off if openings cut off at least this share: its uphill side is low.
_CUT_SHARE = 0.3


def ground_cells(
    heights: np.ndarray,
    size: float,
    objects: Objects,
    largest_window: float,
    allowance: Allowance = Allowance(),
    progress: Progress = SILENT,
    first: First = (0, 0),
    suspects: np.ndarray | None = None,
) -> np.ndarray:
    """Return which cells of a minimum grid are ground.

    Parameters
    ----------
    heights : numpy.ndarray of float, shape (rows, columns)
        Lowest height of each cell in metres, without low outliers; NaN where there is none.
    size : float
        Side of a cell in metres.
    objects : Objects
        Objects with drops all round. A plateau is an object if openings cut off part of it.
    largest_window : float
        Radius in metres of the largest window.
    allowance : Allowance
        What may stand out and still be terrain.
    progress : Progress
        Receives progress.
    first : tuple of int
        Row and column of the first cell in the grid of the CRS.
    suspects : numpy.ndarray of bool, shape (rows, columns), optional
        Cells that stand out by another rule. Like cells that an opening cut off, they are ground
        after all if they continue gently into the ground.

    Returns
    -------
    numpy.ndarray of bool, shape (rows, columns)
        False in cells without a height, too.
    """
    from scipy import ndimage

    known = np.isfinite(heights)
    surveyed = covered(known)
    filled = _filled(heights, surveyed, allowance, first)
    # Squares of cells begin at multiples of their side, wherever the grid starts.
    south, west = (each % _TOGETHER for each in first)
    padded = np.pad(filled, ((south, 0), (west, 0)), mode="edge")
    part = progress.part(0.0, 0.5)
    found = _standing_out(padded, size, largest_window, allowance, part)
    strict, limit = (each[south:, west:].copy() for each in found)
    which, raised = np.flatnonzero(limit > 0.0), strict | objects.raised
    numbers = ndimage.label(objects.plateaus)[0]
    surface = inpaint(np.where(known & ~raised, heights, np.nan), first=first)
    smooth = smoothed(surface, size, _SLOPE_SMOOTHING)
    slope = np.hypot(*(slope_at(smooth, axis, which, size) for axis in (0, 1)))
    raised = objects.raised.copy()
    raised.ravel()[which] |= np.minimum(slope, _LARGEST_SLOPE) < limit.ravel()[which]
    if suspects is not None:
        raised |= suspects & known
    raised |= _of_cut_plateaus(numbers, raised)
    progress(0.8)
    surface = inpaint(np.where(known & ~raised, heights, np.nan), first=first)
    progress(0.85)
    gentle, landforms = gentle_regions(
        filled, known, surveyed, raised, surface, size, allowance, first
    )
    raised &= ~landforms & (objects.raised | ~gentle)
    if allowance.knows_ditches:
        raised &= ~between_ditches(filled, raised, surface, size)
    progress(1.0)
    return known & ~raised


def _filled(
    heights: np.ndarray, surveyed: np.ndarray, allowance: Allowance, first: First
) -> np.ndarray:
    """Return the heights as float32, with gaps filled from the cells round them."""
    from scipy import ndimage

    filled = inpaint(heights, first=first).astype(np.float32)
    if not allowance.judges_gaps or surveyed.all():
        return filled
    # The filling must not make a roof at the border of the survey wider than it is.
    nearest = ndimage.distance_transform_edt(~surveyed, return_distances=False, return_indices=True)
    return filled[tuple(nearest)]


def _of_cut_plateaus(numbers: np.ndarray, raised: np.ndarray) -> np.ndarray:
    """Return the cells of the plateaus (numbered from 1) of which a large share is raised."""
    total = np.bincount(numbers.ravel())
    is_cut = np.bincount(numbers[raised], minlength=len(total)) >= _CUT_SHARE * total
    is_cut[0] = False
    return is_cut[numbers]


def _standing_out(
    filled: np.ndarray, size: float, largest_window: float, allowance: Allowance, progress: Progress
) -> tuple[np.ndarray, np.ndarray]:
    """Open the grid with growing windows.

    Returns
    -------
    first : numpy.ndarray of bool, shape (rows, columns)
        Cells that stand out by the strict slope of the first opening.
    limit : numpy.ndarray of float32, shape (rows, columns)
        The terrain's slope (rise over run) below which a cell stands out by the allowance.
    """
    first = np.zeros(filled.shape, dtype=bool)
    limit = np.full(filled.shape, -np.inf, dtype=np.float32)
    steps, step = in_steps(filled)
    radii = _radii(largest_window / size)
    last, zoom = steps.copy(), 1
    for done, (radius, coarse) in enumerate(radii, start=1):
        if coarse != zoom:
            last, zoom = _lowest_of_blocks(last, coarse // zoom), coarse
        opened = opening(last, radius / zoom)
        last -= opened
        # As unsigned numbers, differences do not overflow.
        cut, last = last.view(np.uint16), opened
        metres = radius * size
        level = allowance.base + allowance.per_radius * metres
        if zoom > 1:
            # A block counts for its neighbours as well, because their lowest cell may lie beside
            # the object.
            most = _finer(within_square(np.maximum, cut, 1), zoom, filled.shape)
            own = steps.astype(np.int32) - _finer(opened, zoom, filled.shape)
            cut = np.clip(own, 0, most)
        cut = cut.ravel()
        # Most cells lose too little to stand out on any slope.
        which = np.flatnonzero(cut > int(min(_FIRST_SLOPE * metres, level) / step))
        lost = cut[which] * np.float32(step)
        first.ravel()[which[lost > _FIRST_SLOPE * metres]] = True
        slope = (lost - np.float32(level)) / np.float32(max(allowance.per_slope * metres, 1e-6))
        if metres <= allowance.usual_window:
            slope[lost > allowance.largest] = np.inf
        else:
            slope = lost - np.float32(allowance.hall_height)
            slope /= np.float32(max(allowance.hall_per_slope * metres, 1e-6))
            slope[slope <= 0.0] = -np.inf
        limit.ravel()[which] = np.maximum(limit.ravel()[which], slope)
        progress(done / len(radii))
    return first, limit


def _radii(largest: float) -> list[tuple[int, int]]:
    """Return the radii of windows in cells, and how many cells are taken together for each."""
    largest = max(round(largest), 1)
    return [
        (radius, together)
        for together, first, last in _RADII
        for radius in range(first, min(last, largest) + 1, together)
    ]


def _lowest_of_blocks(grid: np.ndarray, width: int) -> np.ndarray:
    """Return the lowest value of each square of `width` x `width` cells."""
    rows, columns = grid.shape
    padded = np.pad(grid, ((0, -rows % width), (0, -columns % width)), mode="edge")
    rows = np.minimum.reduce([padded[k::width] for k in range(width)])
    return np.minimum.reduce([rows[:, k::width] for k in range(width)])


def _finer(grid: np.ndarray, zoom: int, shape: tuple[int, int]) -> np.ndarray:
    """Return a grid of the given shape in which each cell has the value of its square."""
    fine = np.repeat(np.repeat(grid, zoom, axis=0), zoom, axis=1)
    return fine[: shape[0], : shape[1]].astype(np.int32)
