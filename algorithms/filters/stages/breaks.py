"""Check the seeds of the ground against the planes through the ground on each side of them.

The lowest point of a cell may be a plant, or lie below the ground. And at a break (the edge of a
terrace, a ridge, the top of a wall) morphology cuts off ground, because the surface through the
ground all round a point is wrong there. But the plane of one side is right: it continues this
ground to the point. A point above the planes of all sides is not ground; a point on the plane of
one side may be ground.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...core.points import Points
from ...core.threads import in_threads
from ...grids.cells import Cells, lower_at
from ...grids.gradient import steepness
from ...grids.inpaint import inpaint
from ...grids.morphology import within_square
from ..pipeline import PointRule, Stage
from ..side_planes import Sides
from ..state import State
from .seeds import DENSE_SPACING, openness

# Seeds are neighbours within this multiple of their spacing, and in any case within these metres.
_SPACINGS = 5.0
_LEAST_REACH = 6.0
# Half the width, in spacings, of the windows of a mean surface.
_MEAN_SPACINGS = 1.5


def _reach(spacing: float) -> float:
    return max(_LEAST_REACH, _SPACINGS * spacing)


@dataclass(frozen=True)
class Plants(PointRule):
    """A seed above the planes of all sides is a plant; one far below all of them an outlier."""

    stage: ClassVar = Stage.SEEDS
    writes: ClassVar = ("seeds", "waiting", "rise")

    # Metres above and below. For outliers the misfit of the plane is added; among plants it is
    # large.
    height: float = 0.1
    depth: float = 0.7
    where_dense: bool = True  # whether seeds are checked where points are closer than 0.17 m

    def apply(self, state: State) -> None:
        """Let the wrong seeds wait."""
        if state.spacing <= DENSE_SPACING and not self.where_dense:
            return
        cells, spacing = state.grids[0].cells, state.seed_spacing
        mean = mean_surface(state.points, state.seeds, cells, spacing)
        state.rise = steepness(mean, cells.size) * cells.size
        wrong = self._wrong(state.points, state.seeds, cells, mean, state.rise, _reach(spacing))
        state.waiting = np.append(state.waiting, state.seeds[wrong])
        state.seeds = state.seeds[~wrong]

    def _wrong(
        self,
        points: Points,
        seeds: np.ndarray,
        cells: Cells,
        mean: np.ndarray,
        allowed: np.ndarray,
        reach: float,
    ) -> np.ndarray:
        """Return which seeds lie above the planes of all sides, or below all, beyond what their
        place in the cell allows on a slope.
        """
        cell, z = cells.index[seeds], points.z[seeds]
        above, allowed = z - mean.ravel()[cell], allowed.ravel()[cell]
        doubtful = np.flatnonzero((above - allowed > self.height) | (above + allowed < -self.depth))
        near = _near(cells, seeds, seeds[doubtful], reach)

        def are_right(_: slice, rise: np.ndarray, *plane: np.ndarray) -> np.ndarray:
            return (rise <= self.height) & (rise + plane[-1] >= -self.depth)

        rise, misfit = Sides(points.take(seeds[near]), reach).rises(
            points.take(seeds[doubtful]), own=True, enough=are_right
        )
        # Seeds without neighbours on any side have no rise, and stay.
        plant = np.fmin.reduce(rise, axis=1) > self.height
        fault = np.fmax.reduce(rise + misfit, axis=1) < -self.depth
        wrong = np.zeros(len(seeds), dtype=bool)
        wrong[doubtful] = plant | fault
        return wrong


@dataclass(frozen=True)
class LevelSeeds(PointRule):
    """A waiting point on the plane of the seeds on one side is ground: a break."""

    # It is for grids with gaps between the seeds, in which breaks may be lost.

    stage: ClassVar = Stage.SEEDS
    writes: ClassVar = ("seeds", "waiting")

    # Metres from the plane within which a point joins, and the largest misfit of that plane.
    level: float = 0.25
    misfit: float = 0.3
    passes: int = 2  # how often points join the ground
    step: float = 1.5  # spacings of the ground within which they join each time
    steepest: float = 1.5  # largest rise over run from the seeds within that distance
    # They join only where it is open, as under trees plants are level with something, too: least
    # share of the points round about that lie near the lowest points of their cells.
    openness: float = 0.8

    def apply(self, state: State) -> None:
        """Let level points join the seeds."""
        if state.spacing <= DENSE_SPACING:
            return
        points, cells, spacing = state.points, state.grids[0].cells, state.seed_spacing
        is_open = (openness_of(state) >= self.openness).ravel()[cells.index[state.waiting]]
        state.waiting, never = state.waiting[is_open], state.waiting[~is_open]
        for _ in range(self.passes):
            joins = self._level(points, state.seeds, state.waiting, cells, spacing)
            state.seeds = np.append(state.seeds, state.waiting[joins])
            state.waiting = state.waiting[~joins]
        state.waiting = np.append(state.waiting, never)

    def _level(
        self,
        points: Points,
        seeds: np.ndarray,
        waiting: np.ndarray,
        cells: Cells,
        spacing: float,
    ) -> np.ndarray:
        """Return which waiting points lie on the plane of the seeds on one side."""
        step = int(np.ceil(self.step * spacing / cells.size))
        margin = self.level + self.steepest * step * cells.size
        cell, z = cells.index[waiting], points.z[waiting]

        def extreme(sign: float) -> np.ndarray:
            nearest = within_square(np.minimum, _extreme(cells, points, seeds, sign), step)
            return sign * nearest.ravel()[cell]

        low, high = in_threads(extreme, (1.0, -1.0))
        candidates = np.flatnonzero((z >= low - margin) & (z <= high + margin))
        near = _near(cells, seeds, waiting[candidates], _reach(spacing))

        def fit(_: slice, rise: np.ndarray, *plane: np.ndarray) -> np.ndarray:
            return (plane[-1] <= self.misfit) & (np.abs(rise) <= self.level)

        planes = Sides(points.take(seeds[near]), _reach(spacing)).planes(
            points.take(waiting[candidates]), enough=fit
        )
        joins = np.zeros(len(waiting), dtype=bool)
        joins[candidates] = fit(slice(None), *planes).any(axis=1)
        return joins


def openness_of(state: State) -> np.ndarray:
    """Return the openness of each cell, and note how much the seeds rise over a cell."""
    grid = state.grids[0]
    if state.rise is None:
        mean = mean_surface(state.points, state.seeds, grid.cells, state.seed_spacing)
        state.rise = steepness(mean, grid.cells.size) * grid.cells.size
    return openness(state.points, grid.cells, grid.lowest, state.rise)


def mean_surface(points: Points, seeds: np.ndarray, cells: Cells, spacing: float) -> np.ndarray:
    """Return a smooth surface through the lowest seeds."""
    from scipy import ndimage

    lowest = _extreme(cells, points, seeds)
    surface = inpaint(np.where(np.isfinite(lowest), lowest, np.nan), 2, cells.first)
    width = 2 * int(np.ceil(_MEAN_SPACINGS * spacing / cells.size)) + 1
    return ndimage.uniform_filter(surface, width, mode="nearest")


def _extreme(cells: Cells, points: Points, selected: np.ndarray, sign: float = 1.0) -> np.ndarray:
    """Return the lowest of some points in each cell, or with a sign of -1 the negative of the
    highest; infinite where there is none.
    """
    lowest = np.full(cells.rows * cells.columns, np.inf, dtype=np.float32)
    lower_at(lowest, cells.index[selected], (sign * points.z[selected]).astype(np.float32))
    return lowest.reshape(cells.shape)


def _near(cells: Cells, seeds: np.ndarray, judged: np.ndarray, reach: float) -> np.ndarray:
    """Return which seeds may be neighbours of the judged points; most are not."""
    steps = int(np.ceil(reach / cells.size)) + 1
    around = within_square(np.maximum, cells.holding(judged), steps)
    return around.ravel()[cells.index[seeds]]
