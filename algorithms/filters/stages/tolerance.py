"""How far above and below the surface through the seeds points are ground."""

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

# Vertices are moved to the middle of their cell along the slope of a surface that is smoothed by
# this standard deviation in metres, and is nowhere steeper than this rise over run. This is done
# some times, since the surface changes.
_SLOPE_SMOOTHING = 1.5
_STEEPEST = 1.5
_MOVES = 2
# Standard deviation in metres by which the surface is smoothed for the slope in the tolerances.
_FACET_SMOOTHING = 0.7
# Spacings of the points in metres between which the tolerance on slopes is proportional to them.
_SPARSE = 1.0
_DENSE = 0.25
# The paper's surface: largest slope that counts, rise over run, and relaxations across gaps.
_PAPER_STEEPEST = 5.0
_PAPER_RELAXATIONS = 2
# Largest spacing in metres at which cells hold enough points to measure the noise in each of them.
_NOISE_SPACING = 0.36


@dataclass(frozen=True)
class PlainSurface(PointRule):
    """Ground lies within a tolerance of the surface through the lowest vertex of each cell."""

    stage: ClassVar = Stage.ACCEPTED
    writes: ClassVar = ("limits",)

    above: float  # tolerance in metres in level terrain
    on_slopes: float  # metres that a slope of 45 degrees adds to both tolerances
    below: float = 0.6  # tolerance in metres in level terrain

    def apply(self, state: State) -> None:
        """Set the limits of the heights of ground points."""
        cells = state.grids[0].cells
        surface = inpaint(cells.minimum(state.points.z, state.seeds), first=cells.first)
        rise = self.on_slopes * _smooth_steepness(surface, cells)
        lowest, highest = surface - self.below - rise, surface + self.above + rise
        state.limits = np.stack((lowest, highest), axis=-1)


@dataclass(frozen=True)
class PaperSurface(PointRule):
    """Ground lies within a tolerance of the surface through the lowest points of ground cells."""

    stage: ClassVar = Stage.ACCEPTED
    writes: ClassVar = ("limits",)

    tolerance: float  # metres in level terrain
    slope_tolerance: float  # share of the rise of the surface over one cell that is added

    def apply(self, state: State) -> None:
        """Set the limits of the heights of ground points."""
        grid = state.grids[0]
        heights = grid.heights.where(~grid.raised)
        surface = inpaint(heights.values, _PAPER_RELAXATIONS, heights.origin)
        tolerance = np.minimum(steepness(surface, heights.size), _PAPER_STEEPEST)
        tolerance *= self.slope_tolerance * heights.size
        tolerance += self.tolerance
        state.limits = np.stack((surface - tolerance, surface + tolerance), axis=-1)


@dataclass(frozen=True)
class MeasuredNoise(Rule):
    """The tolerance above the surface grows with the noise of the ground points."""

    # Where cells hold many points, the lowest of them lies far below the ground. There the surface
    # goes through the middle of the noise.

    # Tolerance in metres above the middle of the noise, and multiple of the noise (a standard
    # deviation) that is added to it.
    least: float = 0.05
    factor: float = 3.0
    # Where cells hold few points: the multiple, and metres that are subtracted, since plants lower
    # than the noise cannot be told from ground.
    sparse_factor: float = 2.5
    usual: float = 0.07
    # Largest noise in metres: lasers and images scatter less, and more is the height of plants.
    # Where cells hold few points, it includes errors of the surface.
    most: float = 0.08
    most_sparse: float = 0.12

    def applied(
        self,
        state: State,
        surface: np.ndarray,
        slopes: tuple[np.ndarray, np.ndarray],
        above: float,
    ) -> tuple[np.ndarray, float]:
        """Return how many metres the surface is to be raised in each cell, and the tolerance above
        it, given that without noise.
        """
        level = np.zeros(surface.shape)
        points, cells, spacing = state.points, state.grids[0].cells, state.spacing
        # Lasers scatter little: in less dense clouds, what looks like noise is crops and plants.
        if spacing <= (DENSE_SPACING if state.has_multi_returns else _NOISE_SPACING):
            middle, noise = middle_of_noise(points, cells, surface, slopes)
            if noise > self.most:
                return level, above
            level = middle.reshape(surface.shape)
            of_noise = self.least + self.factor * noise
            above = of_noise if spacing <= DENSE_SPACING else max(above, of_noise)
        elif _NOISE_SPACING < spacing <= _SPARSE:
            noise = noise_of_squares(points, cells, surface, slopes)
            # The surface goes through the lowest point of each cell, which holds about this number.
            count = np.asarray(max(cells.size / spacing, 1.0) ** 2)
            least = (self.sparse_factor + float(below_middle(count))) * noise - self.usual
            above = max(above, least) if noise <= self.most_sparse else above
        return level, above


@dataclass(frozen=True)
class WallFoot(Rule):
    """In clouds from images, the tolerance is larger at the foot of walls and trees."""

    # Images round off edges, so that the ground seems to rise there.

    more: float = 0.3  # metres that are added to the tolerance above the surface
    # A cell is tall if more than this share of its points lie more than `tall` metres above the
    # highest ground. The foot are the cells beside tall ones, except cells that are surrounded by
    # cells with seeds.
    tall: float = 2.0
    share: float = 0.05

    def where(self, state: State, highest: np.ndarray) -> np.ndarray:
        """Return the cells that are a foot, given the highest height of ground in each cell."""
        points, cells = state.points, state.grids[0].cells
        is_tall = points.z > highest.ravel().take(cells.index) + self.tall
        tall = cells.counts_of(is_tall) > self.share * cells.counts
        all_ground = within_square(np.minimum, cells.holding(state.seeds), 1)
        return within_square(np.maximum, tall.reshape(cells.shape), 1) & ~all_ground


@dataclass(frozen=True)
class ToleranceSurface(PointRule):
    """Ground lies within a tolerance of the surface through the seeds, moved to the middle of
    their cells.
    """

    # The lowest point of a cell lies on its lower side, so it is moved along the slope. Where
    # points are dense, the surface between them is known better, so that the tolerance on slopes is
    # smaller in proportion.

    stage: ClassVar = Stage.ACCEPTED
    writes: ClassVar = ("limits",)

    above: float | None  # tolerance in metres in level terrain; None: it follows from the points
    # Metres that a slope of 45 degrees adds to both tolerances if points are a metre apart.
    on_slopes: float
    # Tolerance in metres in level terrain; it is large because the surface is smoother than the
    # ground.
    below: float = 0.6
    # The tolerance above, in metres, if it follows from the points. Where their spacing exceeds the
    # first of two values in metres, the surface is known less well: up to `where_sparse` metres are
    # added, all of them from the second value on.
    usual: float = 0.18
    where_sparse: float = 0.12
    sparse: tuple[float, float] = (0.5, 1.0)
    measured_noise: MeasuredNoise | None = MeasuredNoise()
    # At breaks, where the curvature over a cell exceeds this, in metres, the surface is too smooth:
    # each metre of curvature beyond adds this many metres to both tolerances.
    curvature: float = 0.25
    at_breaks: float = 1.5
    # Under trees low plants stand among the ground points. There the surface goes through the
    # lowest vertices, is not raised by noise, and has this share of the tolerance on slopes above.
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
    """Return the slope of the surface, smoothed since it is too uneven between single points."""
    return steepness(_smooth(surface, _FACET_SMOOTHING, cells), cells.size)


def _curvature(surface: np.ndarray) -> np.ndarray:
    """Return how many metres each cell lies from the lines between opposite neighbours."""
    around = np.pad(surface, 1, mode="edge")
    north = around[2:, 1:-1] + around[:-2, 1:-1]
    east = around[1:-1, 2:] + around[1:-1, :-2]
    return np.maximum(np.abs(0.5 * north - surface), np.abs(0.5 * east - surface))


def _centred(
    points: Points, vertices: np.ndarray, cells: Cells, woods: np.ndarray
) -> tuple[np.ndarray, tuple[np.ndarray, np.ndarray]]:
    """Return the mean height of the vertices of each cell, or the lowest under trees, moved to the
    middle of the cell, and the slopes of this surface.
    """
    cell, z = cells.index[vertices], points.z[vertices]
    north, east = from_middle(points.take(vertices), cells, cell)
    count = np.bincount(cell, minlength=cells.rows * cells.columns)
    moved, under_trees = z, np.flatnonzero(woods.ravel()[cell])
    for _ in range(_MOVES + 1):
        total = np.bincount(cell, moved, minlength=count.size)
        heights = np.where(count > 0, total / np.maximum(count, 1), np.nan)
        lower_at(heights, cell[under_trees], moved[under_trees])
        surface = inpaint(heights.reshape(cells.shape), first=cells.first)
        slopes = _slopes(surface, cells)
        moved = z - slopes[0].ravel()[cell] * north - slopes[1].ravel()[cell] * east
    return surface, slopes


def _slopes(surface: np.ndarray, cells: Cells) -> tuple[np.ndarray, np.ndarray]:
    """Return the slopes towards north and east, cut to the steepest that is used."""
    north, east = gradient(_smooth(surface, _SLOPE_SMOOTHING, cells), cells.size)
    share = _STEEPEST / np.maximum(length(north, east), _STEEPEST)
    return north * share, east * share
