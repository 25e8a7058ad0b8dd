"""How far from the surface through the seeds points are ground."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...core.points import Points
from ...grids.cells import Cells, lower_at
from ...grids.gradient import gradient, length, steepness
from ...grids.inpaint import inpaint
from ...grids.morphology import within_square
from ..pipeline import PointRule, Rule, Stage
from ..state import State
from .noise import below_middle, from_middle, middle_of_noise, noise_of_squares
from .seeds import DENSE_SPACING

# Metres over which the surface is smoothed to move vertices along its slope.
_SLOPE_SMOOTHING = 1.5
_MOVES = 2  # how often they are moved
_STEEPEST = 1.5  # steepest slope for this, rise over run
# Metres over which the surface is smoothed for the slope that is added to the tolerances.
_FACET_SMOOTHING = 0.7
# The tolerance on slopes is proportional to the spacing of the points, between these two spacings
# in metres.
_SPARSE = 1.0
_DENSE = 0.25
# Largest spacing in metres at which the noise is measured in each cell, because the lowest of many
# points in a cell lies below the ground.
_NOISE_SPACING = 0.36


@dataclass(frozen=True)
class PlainSurface(PointRule):
    """The surface goes through the lowest vertex of each cell."""

    stage: ClassVar = Stage.ACCEPTED
    writes: ClassVar = ("limits",)

    # Tolerances in metres in level terrain.
    above: float
    on_slopes: float  # metres that a slope of 45 degrees adds to both
    below: float = 0.6

    def apply(self, state: State) -> None:
        """Set the limits of the heights of ground points."""
        cells = state.grids[0].cells
        surface = inpaint(cells.minimum(state.points.z, state.seeds), first=cells.first)
        rise = self.on_slopes * _smooth_steepness(surface, cells)
        lowest, highest = surface - self.below - rise, surface + self.above + rise
        state.limits = np.stack((lowest, highest), axis=-1)


@dataclass(frozen=True)
class MeasuredNoise(Rule):
    """The tolerance above grows with the measured noise."""

    # Where many points lie in a cell, the lowest lies far below the ground, so the surface goes
    # through the middle of their noise.

    # Tolerance in metres above a surface through the middle of the noise, and the multiple of the
    # noise that is added to it.
    least: float = 0.05
    factor: float = 3.0
    # The same multiple where few points lie in a cell, and metres that are subtracted: plants lower
    # than the noise cannot be recognised.
    sparse_factor: float = 2.5
    usual: float = 0.07
    # Lasers and images scatter less than this, in metres: more is the height of plants. Where few
    # points lie in a cell, the errors of the surface come on top.
    most: float = 0.08
    most_sparse: float = 0.12

    def applied(
        self,
        state: State,
        surface: np.ndarray,
        slopes: tuple[np.ndarray, np.ndarray],
        above: float,
    ) -> tuple[np.ndarray, float]:
        """Return the rise of the surface to the middle of the noise, and the usual tolerance above
        it, given that without noise.
        """
        level = np.zeros(surface.shape)
        points, cells, spacing = state.points, state.grids[0].cells, state.spacing
        # Lasers scatter little, and the roughness of crops and plants is no noise.
        if spacing <= (DENSE_SPACING if state.has_multi_returns else _NOISE_SPACING):
            middle, noise = middle_of_noise(points, cells, surface, slopes)
            if noise > self.most:
                return level, above
            level = middle.reshape(surface.shape)
            of_noise = self.least + self.factor * noise
            above = of_noise if spacing <= DENSE_SPACING else max(above, of_noise)
        elif _NOISE_SPACING < spacing <= _SPARSE:
            noise = noise_of_squares(points, cells, surface, slopes)
            # The surface goes through the lowest of the points of a cell: this many, about.
            number = np.asarray(max(cells.size / spacing, 1.0) ** 2)
            least = (self.sparse_factor + float(below_middle(number))) * noise - self.usual
            above = max(above, least) if noise <= self.most_sparse else above
        return level, above


@dataclass(frozen=True)
class WallFoot(Rule):
    """In clouds from images, the ground rises at the foot of walls and trees: edges are rounded."""

    more: float = 0.3  # metres that this adds to the tolerance above
    # A cell is tall if more than this share of its points are more than `tall` metres above the
    # ground. Its foot are the cells within one cell of it, but for those with ground in all cells
    # round them.
    tall: float = 2.0
    share: float = 0.05

    def where(self, state: State, highest: np.ndarray) -> np.ndarray:
        """Return the cells that are a foot; `highest` are the heights up to which points count."""
        points, cells = state.points, state.grids[0].cells
        is_tall = points.z > highest.ravel().take(cells.index) + self.tall
        tall = cells.counts_of(is_tall) > self.share * cells.counts
        all_ground = within_square(np.minimum, cells.holding(state.seeds), 1)
        return within_square(np.maximum, tall.reshape(cells.shape), 1) & ~all_ground


@dataclass(frozen=True)
class ToleranceSurface(PointRule):
    """Points close to the surface through the seeds are ground."""

    # Each vertex is moved to the middle of its cell along the slope, because the lowest point of a
    # cell lies on its lower side. Where points are dense, the surface between them is known better,
    # so the tolerance on slopes is smaller in proportion.

    stage: ClassVar = Stage.ACCEPTED
    writes: ClassVar = ("limits",)

    above: float | None  # metres in level terrain; None for what follows from the points
    # Metres that a slope of 45 degrees adds, where points are a metre apart or more.
    on_slopes: float
    # Metres in level terrain; more than above, because the surface is smoother than the ground.
    below: float = 0.6
    # Usual metres above, and what is added to them where points are farther apart than the first of
    # two distances in metres, in full from the second one on: the surface is known less well.
    usual: float = 0.18
    where_sparse: float = 0.12
    sparse: tuple[float, float] = (0.5, 1.0)
    measured_noise: MeasuredNoise | None = MeasuredNoise()
    # At breaks the surface is too smooth: metres of curvature over a cell above which there is one,
    # and what each metre above adds to the tolerances.
    curvature: float = 0.25
    at_breaks: float = 1.5
    # Under trees low plants stand among the points of the ground: there the surface goes through
    # the lowest vertices, and above it is no noise and this share of the tolerance on slopes.
    under_trees: float = 0.3
    wall_foot: WallFoot | None = WallFoot()

    def apply(self, state: State) -> None:
        """Set the limits of the heights of ground points."""
        points, grid, spacing = state.points, state.grids[0], state.spacing
        cells, woods = grid.cells, grid.woods
        surface, slopes = _centred(points, state.seeds, cells, woods)
        above = self.usual + self.where_sparse * float(np.interp(spacing, self.sparse, (0.0, 1.0)))
        if self.measured_noise:
            level, above = self.measured_noise.applied(state, surface, slopes, above)
            surface = surface + np.where(woods, 0.0, level)
        in_woods = self.usual
        if self.above is not None:
            above = in_woods = self.above
        slope, curvature = _smooth_steepness(surface, cells), _curvature(surface)
        rise = self.on_slopes * min(max(spacing, _DENSE), _SPARSE) / _SPARSE * slope
        rise_above = np.where(woods, self.under_trees, 1.0) * rise
        if spacing < _SPARSE:
            at_break = self.at_breaks * np.maximum(curvature - self.curvature, 0.0)
            rise, rise_above = rise + at_break, rise_above + at_break
        highest = surface + np.where(woods, in_woods, above) + rise_above
        if self.wall_foot and state.from_images:
            highest += np.where(self.wall_foot.where(state, highest), self.wall_foot.more, 0.0)
        state.limits = np.stack((surface - self.below - rise, highest), axis=-1)


def _smooth(surface: np.ndarray, metres: float, cells: Cells) -> np.ndarray:
    from scipy import ndimage

    return ndimage.gaussian_filter(surface, metres / cells.size, mode="nearest")


def _smooth_steepness(surface: np.ndarray, cells: Cells) -> np.ndarray:
    """Return the slope of the smoothed surface; between single points the slope is too uneven."""
    return steepness(_smooth(surface, _FACET_SMOOTHING, cells), cells.size)


def _curvature(surface: np.ndarray) -> np.ndarray:
    """Return how many metres each cell lies off the lines between opposite neighbours."""
    around = np.pad(surface, 1, mode="edge")
    north = around[2:, 1:-1] + around[:-2, 1:-1]
    east = around[1:-1, 2:] + around[1:-1, :-2]
    return np.maximum(np.abs(0.5 * north - surface), np.abs(0.5 * east - surface))


def _centred(
    points: Points, vertices: np.ndarray, cells: Cells, woods: np.ndarray
) -> tuple[np.ndarray, tuple[np.ndarray, np.ndarray]]:
    """Return the mean of the vertices of each cell, or the lowest under trees, at its middle, and
    the slopes of that surface.
    """
    cell, z = cells.index[vertices], points.z[vertices]
    north, east = from_middle(points.take(vertices), cells, cell)
    count = np.bincount(cell, minlength=cells.rows * cells.columns)
    moved, low = z, np.flatnonzero(woods.ravel()[cell])
    for _ in range(_MOVES + 1):
        total = np.bincount(cell, moved, minlength=count.size)
        heights = np.where(count > 0, total / np.maximum(count, 1), np.nan)
        lower_at(heights, cell[low], moved[low])
        surface = inpaint(heights.reshape(cells.shape), first=cells.first)
        slopes = _slopes(surface, cells)
        moved = z - slopes[0].ravel()[cell] * north - slopes[1].ravel()[cell] * east
    return surface, slopes


def _slopes(surface: np.ndarray, cells: Cells) -> tuple[np.ndarray, np.ndarray]:
    """Return the slope towards north and east, nowhere steeper than is usual for terrain."""
    north, east = gradient(_smooth(surface, _SLOPE_SMOOTHING, cells), cells.size)
    share = _STEEPEST / np.maximum(length(north, east), _STEEPEST)
    return north * share, east * share
