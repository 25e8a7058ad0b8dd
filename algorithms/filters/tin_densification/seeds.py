"""The first points of the ground, found on grids of lowest points."""

from __future__ import annotations

import threading
from typing import Sequence

import numpy as np

from ...core.progress import SILENT, Progress
from ...core.threads import in_threads
from ..shared.allowance import CLASSIC, Allowance
from ..shared.ground_cells import ground_cells
from ..shared.lowest_points import LowestPoints

# States of a point on a grid: not the lowest of its cell; on an object or a low outlier; perhaps
# ground; ground.
_HIDDEN, _OBJECT, _OPEN, _GROUND = range(4)


def seeds_of_one_grid(
    survey: LowestPoints,
    max_size: float,
    progress: Progress,
    allowance: Allowance = Allowance(),
) -> tuple[np.ndarray, np.ndarray]:
    """Return the points that are ground on one grid.

    Parameters
    ----------
    survey : LowestPoints
        The grid.
    max_size : float
        Shorter side of the largest object in metres.
    progress : Progress
        Receives progress.
    allowance : Allowance
        What may stand out and still be ground. With the classic one, objects may be ground, too.

    Returns
    -------
    ground, waiting : numpy.ndarray of intp
        Indices of the points that are taken for ground, and of other lowest points that may be
        ground.
    """
    ground, is_open, _ = _judged(survey, max_size, allowance, progress)
    if allowance is CLASSIC:
        is_open = np.isfinite(survey.heights).ravel()[survey.cell]
    return survey.lowest[ground], survey.lowest[~ground & is_open]


def seeds_of_two_grids(
    count: int, grids: Sequence[LowestPoints], max_size: float, progress: Progress
) -> tuple[np.ndarray, np.ndarray]:
    """Return the points that are ground on two grids, half a cell apart.

    It is chance where cells begin. A point that is the lowest of its cell on both grids must be
    ground on both. A point that is the lowest on only one grid must be ground on that one.

    Parameters
    ----------
    count : int
        Number of points.
    grids : sequence of LowestPoints
        The two grids.
    max_size, progress
        As for `seeds_of_one_grid`, and so is the result.
    """
    kinds = np.zeros((2, count), dtype=np.int8)
    caller = threading.get_ident()

    def judge(number: int) -> np.ndarray:
        grid = grids[number]
        part = progress.part(0.5 * number, 0.5 + 0.5 * number)
        # Progress is for the calling thread only.
        part = part if threading.get_ident() == caller else SILENT
        ground, is_open, halls = _judged(grid, max_size, Allowance(), part)
        kinds[number, grid.lowest] = np.where(ground, _GROUND, np.where(is_open, _OPEN, _OBJECT))
        return halls

    halls = in_threads(judge, range(len(kinds)))
    either = np.flatnonzero(kinds[0] | kinds[1])
    # A hall that one grid finds is one on both.
    for grid, cells in zip(grids, halls):
        either = either[~cells.ravel()[grid.cells.index[either]]]
    one, other = kinds[:, either]
    ground = (one == _GROUND) & ((other == _GROUND) | (other == _HIDDEN))
    ground |= (other == _GROUND) & (one == _HIDDEN)
    is_open = ~ground & ((one >= _OPEN) | (other >= _OPEN))
    return either[ground], either[is_open]


def _judged(
    survey: LowestPoints, max_size: float, allowance: Allowance, progress: Progress
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return which lowest points are ground, which may be ground, and the cells of halls."""
    cells, heights = survey.cells, survey.heights
    objects = survey.objects(max_size, progress.part(0.0, 0.4))
    part = progress.part(0.4, 1.0)
    ground = ground_cells(
        heights, cells.size, objects, max_size / 2.0, allowance, part, cells.first
    )
    is_open = np.isfinite(heights) & ~objects.raised
    return ground.ravel()[survey.cell], is_open.ravel()[survey.cell], objects.halls
