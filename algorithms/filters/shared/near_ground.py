"""Find all ground points from lowest points that are ground: the last steps of a filter."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...core.points import Points
from ...core.progress import SILENT, Progress
from ...grids.cells import Cells, spacing
from .banks import banks
from .breaks import checked_seeds
from .ground_limits import DENSE_SPACING, Tolerance, ground_limits
from .near_surface import near_surface

# Least spacing of points in metres; a smaller one counts as this.
_CLOSEST = 0.01


class Candidates(NamedTuple):
    """Lowest points of cells that may be ground.

    Attributes
    ----------
    lowest : numpy.ndarray of intp, shape (n,)
        Indices of the points.
    ground : numpy.ndarray of bool, shape (n,)
        Which of them a filter takes for ground.
    free : numpy.ndarray of bool, shape (n,)
        Which of them may be ground even if the filter says otherwise: no outliers, no parts of a
        large object.
    """

    lowest: np.ndarray
    ground: np.ndarray
    free: np.ndarray

    @classmethod
    def of_cells(
        cls, lowest: np.ndarray, cell: np.ndarray, ground: np.ndarray, free: np.ndarray
    ) -> Candidates:
        """Return candidates from grids (rows, columns) and the cell of each lowest point."""
        return cls(lowest, ground.ravel()[cell], free.ravel()[cell])


def near_ground(
    points: Points,
    cells: Cells,
    candidates: Candidates,
    tolerance: Tolerance,
    progress: Progress = SILENT,
) -> np.ndarray:
    """Return which points lie close to the surface through the ground.

    Where points are sparse, the candidates are first compared with the ground on each side.
    Candidates above the ground on every side are removed. Candidates level with the ground on one
    side, at a break, come back.

    Parameters
    ----------
    points : Points
        All points that take part.
    cells : Cells
        Cells of the surface.
    candidates : Candidates
        Lowest points of cells.
    tolerance : Tolerance
        How far from the surface ground may lie.
    progress : Progress
        Receives progress.

    Returns
    -------
    numpy.ndarray of bool, shape (n,)
        True for ground.
    """
    apart = spacing(points, _CLOSEST)
    seeds = candidates.lowest[candidates.ground]
    if apart > DENSE_SPACING:
        waiting = candidates.lowest[candidates.free & ~candidates.ground]
        seeds, _ = checked_seeds(points, seeds, waiting, cells, max(apart, cells.size))
    progress(0.5)
    return with_banks(points, seeds, cells, apart, tolerance, progress.part(0.5, 1.0))


def with_banks(
    points: Points,
    vertices: np.ndarray,
    cells: Cells,
    spacing: float,
    tolerance: Tolerance,
    progress: Progress = SILENT,
) -> np.ndarray:
    """Return which points lie close to the surface through the ground, or on low banks beside it.

    Parameters, returns
        As for `ground_limits` and `near_ground`.
    """
    limits = ground_limits(points, vertices, cells, spacing, tolerance)
    progress(0.2)
    ground = near_surface(points, cells, limits, progress.part(0.2, 0.8))
    ground |= banks(points, ground, cells, limits)
    progress(1.0)
    return ground
