"""Warnings about results of which a ground filter is not sure, in the same words for all filters.

The texts have no figures that differ from block to block, so that equal texts are shown once.
"""

from __future__ import annotations

import numpy as np

from ..core.points import Points
from ..core.progress import Progress
from ..grids.cells import Cells

# Side in metres of the cells in which ground is counted.
_CELL = 1.0
# Least usual share of the cells with points that have ground.
_LEAST_GROUND = 0.02
# If more than this share of the points is ground, cells need not be counted: enough have ground.
_SURELY_ENOUGH = 0.1
# Largest usual share of low outliers among the lowest points, and the least number of cells for
# which a share means something.
_MOST_OUTLIERS, _LEAST_CELLS = 0.02, 500


def warn_of_extent(points: Points, largest: float, name: str, progress: Progress) -> None:
    """Warn if the survey is no wider than the largest expected object, in metres: it has no ground
    on two sides of that; `name` is that of its parameter.
    """
    if min(points.sides) < largest:
        progress.warning(
            f"In one direction the points reach less than {largest:g} m, the expected width of the"
            " largest object. An object at their border, or one that covers all of them, may be"
            " taken for ground. Add the points around them, or give the width of the largest"
            f" object ({name})."
        )


def warn_of_little_ground(points: Points, ground: np.ndarray, progress: Progress) -> None:
    """Warn if hardly any of the cells with points have ground."""
    if np.count_nonzero(ground) >= _SURELY_ENOUGH * points.count:
        return
    cells = Cells.over(points, _CELL)
    if np.count_nonzero(cells.holding(ground)) < _LEAST_GROUND * np.count_nonzero(cells.occupied):
        progress.warning(
            f"Hardly any ground was found: fewer than {100 * _LEAST_GROUND:g} % of the square"
            " metres with points have ground points. The terrain between them is a guess. Check"
            " the selection of points (returns, classes) and the result. In steep land, try the"
            " preset for it."
        )


def warn_of_outliers(count: int, left: np.ndarray, progress: Progress) -> None:
    """Warn if many of the lowest points, so many in all, are taken for low outliers, which are NaN
    in `left`.
    """
    taken = count - np.count_nonzero(np.isfinite(left))
    if count >= _LEAST_CELLS and taken > _MOST_OUTLIERS * count:
        progress.warning(
            f"More than {100 * _MOST_OUTLIERS:g} % of the lowest points are taken for low outliers."
            " If they are noise, put them into class 7 to be sure that they take no part. If they"
            " are the ground below trees or in pits, compare the result with the points there."
        )
