"""Checks of the seeds by planes through the ground on each side of them.

The lowest point of a cell may be a plant, or an outlier below the ground. At a break (the edge of a
terrace, a ridge, the top of a wall), morphology cuts off ground, because a surface through the
ground on all sides of a point is wrong there. The plane of one side is right: it continues the
ground on this side to the point. So a point above the planes of all sides is not ground, and one on
the plane of a side may be ground.
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

# The distance within which seeds are neighbours, in spacings of the seeds, and its least value in
# metres.
_SPACINGS = 5.0
_LEAST_REACH = 6.0
_LEAST_EDGE_REACH = 1.5  # the same for ground beside an edge
# Half the side of the windows of a mean surface, in spacings of the seeds.
_MEAN_SPACINGS = 1.5


def _reach(spacing: float, least: float = _LEAST_REACH) -> float:
    return max(least, _SPACINGS * spacing)


@dataclass(frozen=True)
class Plants(PointRule):
    """A seed above the planes of all sides is a plant, and one far below all is an outlier."""

    stage: ClassVar = Stage.SEEDS
    writes: ClassVar = ("seeds", "candidates", "rise")

    height: float = 0.1  # least height of a plant above the planes in metres
    # Least depth of an outlier below the planes in metres, beyond their misfit: planes through
    # plants have a large one.
    depth: float = 0.7
    where_dense: bool = True  # whether seeds of dense clouds are checked as well

    def apply(self, state: State) -> None:
        """Demote the wrong seeds to candidates."""
        if state.spacing <= DENSE_SPACING and not self.where_dense:
            return
        cells, spacing = state.grids[0].cells, state.seed_spacing
        mean = mean_surface(state.points, state.seeds, cells, spacing)
        state.rise = steepness(mean, cells.size) * cells.size
        wrong = self._wrong(state.points, state.seeds, cells, mean, state.rise, _reach(spacing))
        state.candidates = np.append(state.candidates, state.seeds[wrong])
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
        """Return which seeds are plants or outliers, among those whose distance from the mean
        surface exceeds the rise that is allowed in each cell.
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
    """A candidate on open land is ground if it lies on the plane of the seeds on one side."""

    # This finds ground at breaks, in grids whose seeds have gaps there.

    stage: ClassVar = Stage.SEEDS
    writes: ClassVar = ("seeds", "candidates")

    level: float = 0.25  # largest distance in metres from the plane
    misfit: float = 0.3  # largest misfit of the plane in metres
    passes: int = 2  # points that join the seeds in one pass count in the next
    step: float = 1.5  # largest distance from the nearest seed, in spacings of the seeds
    steepest: float = 1.5  # largest slope from the seeds within this distance, rise over run
    # Least openness, because under trees plants are on the plane of other plants.
    openness: float = 0.8

    def apply(self, state: State) -> None:
        """Let level points join the seeds."""
        if state.spacing <= DENSE_SPACING:
            return
        points, cells, spacing = state.points, state.grids[0].cells, state.seed_spacing
        is_open = (openness_of(state) >= self.openness).ravel()[cells.index[state.candidates]]
        state.candidates, never = state.candidates[is_open], state.candidates[~is_open]
        for _ in range(self.passes):
            joins = self._level(points, state.seeds, state.candidates, cells, spacing)
            state.seeds = np.append(state.seeds, state.candidates[joins])
            state.candidates = state.candidates[~joins]
        state.candidates = np.append(state.candidates, never)

    def _level(
        self,
        points: Points,
        seeds: np.ndarray,
        candidates: np.ndarray,
        cells: Cells,
        spacing: float,
    ) -> np.ndarray:
        """Return which candidates lie on the plane of the seeds on one side."""
        step = int(np.ceil(self.step * spacing / cells.size))
        margin = self.level + self.steepest * step * cells.size
        cell, z = cells.index[candidates], points.z[candidates]

        def extreme(sign: float) -> np.ndarray:
            return sign * _around(cells, points, seeds, step, sign).ravel()[cell]

        low, high = in_threads(extreme, (1.0, -1.0))
        tested = np.flatnonzero((z >= low - margin) & (z <= high + margin))
        near = _near(cells, seeds, candidates[tested], _reach(spacing))

        def fit(_: slice, rise: np.ndarray, *plane: np.ndarray) -> np.ndarray:
            return (plane[-1] <= self.misfit) & (np.abs(rise) <= self.level)

        planes = Sides(points.take(seeds[near]), _reach(spacing)).planes(
            points.take(candidates[tested]), enough=fit
        )
        joins = np.zeros(len(candidates), dtype=bool)
        joins[tested] = fit(slice(None), *planes).any(axis=1)
        return joins


@dataclass(frozen=True)
class Edges(PointRule):
    """A point beside a drop is ground if it lies on the plane of the ground on one side."""

    # At the edges of ditches, ramps and craters, cells hold points of the drop as well, so that the
    # surface through their lowest points leaves out those of the edge.

    stage: ClassVar = Stage.ACCEPTED
    writes: ClassVar = ("ground",)

    drop: float = 0.6  # least depth in metres of ground beside the edge, below the plane
    beside: float = 2.0  # metres from the edge, in cells, within which ground is so deep
    level: float = 0.08  # largest distance in metres from the plane
    misfit: float = 0.06  # largest misfit of the plane in metres
    # Nothing stands higher above the point within a cell, in metres: plants and walls are level
    # with the ground above them.
    open_above: float = 1.0

    def apply(self, state: State) -> None:
        """Let points at edges join the ground."""
        if state.spacing <= DENSE_SPACING or state.from_images:
            return
        points, cells = state.points, state.grids[0].cells
        reach = _reach(state.spacing, _LEAST_EDGE_REACH)
        beside = int(np.ceil(self.beside / cells.size))
        all_points = slice(None) if state.low_noise is None else ~state.low_noise
        lowest = _around(cells, points, state.ground, beside)
        top = -_around(cells, points, all_points, 1, -1.0)
        highest = -_around(cells, points, state.ground, 1, -1.0)
        drops = highest - lowest > self.drop
        doubtful = cells.points_in(drops)
        doubtful = doubtful[~state.ground[doubtful]]
        z, cell = points.z[doubtful], cells.index[doubtful]
        depth = z - lowest.ravel()[cell]
        # Crowns are far above the ground beside them, and low noise is infinitely high.
        judged = (depth > self.drop) & (z - highest.ravel()[cell] < self.drop)
        judged &= top.ravel()[cell] - z < self.open_above
        doubtful, depth = doubtful[judged], depth[judged]
        state.ground[doubtful[self._joins(state, doubtful, depth, reach)]] = True

    def _joins(
        self,
        state: State,
        doubtful: np.ndarray,
        depth: np.ndarray,
        reach: float,
    ) -> np.ndarray:
        """Return which points lie on the plane of one side, given how high they lie above the
        lowest ground beside them.
        """
        cells = state.grids[0].cells
        ground = np.flatnonzero(state.ground)
        ground = ground[_near(cells, ground, doubtful, reach)]
        across = self.beside + 0.5 * cells.size

        def fit(part: slice, rise: np.ndarray, *plane: np.ndarray) -> np.ndarray:
            east, north, misfit = plane
            below = depth[part].reshape(-1, *[1] * (rise.ndim - 1))
            sinks = below - np.hypot(east, north) * across > self.drop
            return sinks & (misfit <= self.misfit) & (np.abs(rise) <= self.level)

        of_ground, judged = (state.points.take(some) for some in (ground, doubtful))
        planes = Sides(of_ground, reach).planes(judged, enough=fit)
        joins: np.ndarray = np.any(fit(slice(None), *planes), axis=1)
        return joins


def _around(
    cells: Cells, points: Points, selected: np.ndarray | slice, steps: int, sign: float = 1.0
) -> np.ndarray:
    """Return the `_extreme` within some cells of each cell."""
    return within_square(np.minimum, _extreme(cells, points, selected, sign), steps)


def openness_of(state: State) -> np.ndarray:
    """Return the openness of each cell, and keep the rise of the seeds over a cell in the state."""
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


def _extreme(
    cells: Cells, points: Points, selected: np.ndarray | slice, sign: float = 1.0
) -> np.ndarray:
    """Return the lowest height of selected points in each cell, or minus the highest with a sign of
    -1; infinite where there are none.
    """
    lowest = np.full(cells.rows * cells.columns, np.inf, dtype=np.float32)
    lower_at(lowest, cells.index[selected], (sign * points.z[selected]).astype(np.float32))
    return lowest.reshape(cells.shape)


def _near(cells: Cells, seeds: np.ndarray, judged: np.ndarray, reach: float) -> np.ndarray:
    """Return which seeds may be neighbours of the judged points, within a reach in metres."""
    steps = int(np.ceil(reach / cells.size)) + 1
    around = within_square(np.maximum, cells.holding(judged), steps)
    return around.ravel()[cells.index[seeds]]
