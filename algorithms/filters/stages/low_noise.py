"""Low noise: groups of points far below the ground round them, and points below water."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, Iterator, NamedTuple

import numpy as np

from ...core.points import Points
from ...grids.cells import Cells, cells_at, first_of_each, spacing
from ...grids.morphology import within_square
from ..lowest_planes import LowestNeighbours, LowestOfCells
from ..pipeline import PointRule, Stage
from ..state import State

# Least side of a cell in metres. Where points are farther apart, it is their spacing, so that few
# cells are empty.
_CELL = 1.0
# Multiples of the width of a group. Points below the plane belong to the group up to the first
# distance from its lowest point. Other points that are as low count beyond the second: they show
# that it is no noise.
_OF_GROUP = 1.5
_BESIDE_GROUP = 1.25
# Least number of heights that show the level of a water surface.
_LEAST_HEIGHTS = 6
# The standard deviation of a normal distribution, in median absolute deviations.
_DEVIATION = 1.48


@dataclass(frozen=True)
class LowGroups(PointRule):
    """A small group of points far below the plane of the ground that surrounds it is low noise."""

    # Real pits of this width are hardly ever so deep. Near the few that are (gaps in a canopy,
    # wells, ends of ditches), other lowest points are as low, or the lowest points round them
    # are uneven.

    stage: ClassVar = Stage.LOW_NOISE
    writes: ClassVar = ("points", "grids", "low_noise")

    width: float = 2.0  # largest width of a group in metres
    depth: float = 0.4  # least depth in metres below the plane of the surroundings
    # Least depth in standard deviations of the surroundings from their plane.
    deviations: float = 4.0
    ring: float = 6.0  # radius of the surroundings in metres
    ring_cells: int = 4  # least radius of the surroundings in cells, for sparse points
    level: float = 0.25  # largest distance in metres of a height that lies on the plane
    sides: int = 5  # least number, of eight, on which half of the heights lie on the plane
    # Largest number of heights beyond the group that are as low, as a share of those on the plane.
    most_beside: float = 0.0
    # There is ground above a group if the median distance of its points from the nearest ground
    # point is at most this multiple of the median distance between ground points. Up to the second
    # multiple it is doubtful, because a group may have only a dozen points. A doubtful group, and
    # one whose points lie within `spread` of these distances, is noise if a gap in height of at
    # least `gap` times its depth parts it from the ground.
    nearest: float = 1.3
    doubtful: float = 1.65
    spread: float = 2.0
    gap: float = 0.6

    def apply(self, state: State) -> None:
        """Add the groups to the low noise."""
        grid = state.grids[0]
        size = max(_CELL, state.spacing)
        known = (grid.cells, grid.lowest) if grid.cells.size == size else None
        state.add_low_noise(self.find(state.points, known))

    def find(self, points: Points, known: tuple[Cells, np.ndarray] | None = None) -> np.ndarray:
        """Return which points (n,) belong to a low group; `known` are cells of at least 1 m and the
        lowest point of each.
        """
        if known is None:
            cells = Cells.over(points, max(_CELL, spacing(points)))
            known = cells, cells.lowest_points(points)
        cells, lowest = known
        size = cells.size
        margin = math.ceil(max(self.ring / size, self.ring_cells))
        grids = LowestOfCells.of(points, cells, margin, lowest)
        places = grids.pits(cells, 0.5 * self.depth, math.ceil(self.width / size))
        groups = [
            group for around in grids.around(places, self.width) for group in self._groups(around)
        ]
        return self._members(points, cells, groups)

    def _groups(self, around: LowestNeighbours) -> Iterator[Group]:
        """Yield the groups at the places whose surroundings show that they are low."""
        plane, misfit = around.plane()
        depth = plane[:, 2]
        on_plane = around.known & (np.abs(misfit) <= self.level)
        deviation = _DEVIATION * around.median(np.abs(misfit), on_plane)
        as_low = around.known & (misfit < -0.5 * depth[:, None])
        as_low &= around.distance > _BESIDE_GROUP * self.width
        deep = depth > np.maximum(self.depth, self.deviations * deviation)
        low_count, level_count = (np.count_nonzero(which, axis=1) for which in (as_low, on_plane))
        is_alone = low_count <= self.most_beside * level_count
        is_enclosed = around.sides_with(on_plane) >= self.sides
        for number in np.flatnonzero(deep & is_alone & is_enclosed):
            east, north, height = plane[number].tolist()
            x, y, z = (float(column[number]) for column in around.centre)
            margin = max(self.level, 3.0 * float(deviation[number]))
            yield Group(x, y, z + height - margin, east, north, margin)

    def _members(self, points: Points, cells: Cells, groups: list[Group]) -> np.ndarray:
        """Return which points lie below the limit of a group and within its width."""
        members = np.zeros(points.count, dtype=bool)
        if not groups:
            return members
        reach = math.ceil(_OF_GROUP * self.width / cells.size)
        x, y = np.array([(group.x, group.y) for group in groups]).T
        rows, columns = cells_at(x, y, cells.size)
        rows, columns = rows - cells.first_row, columns - cells.first_column
        near = np.zeros(cells.shape, dtype=bool)
        near[rows, columns] = True
        which = cells.points_in(within_square(np.maximum, near, reach))
        which = which[np.isfinite(points.z[which])]
        order = np.argsort(cells.index[which], kind="stable")
        which, index = which[order], cells.index[which[order]]
        for group, row, column in zip(groups, rows.tolist(), columns.tolist()):
            first = max(column - reach, 0)
            last = min(column + reach, cells.columns - 1)
            lines = np.arange(max(row - reach, 0), min(row + reach, cells.rows - 1) + 1)
            ends = lines[:, None] * cells.columns + (first, last + 1)
            near_it = np.concatenate(
                [which[start:end] for start, end in np.searchsorted(index, ends)]
            )
            beside = points.take(near_it)
            inside = group.holds(beside, self.width)
            if self.is_detached(group, beside, inside):
                members[near_it[inside]] = True
        return members

    def is_detached(self, group: Group, points: Points, members: np.ndarray) -> bool:
        """Return whether ground points lie above a group, or a gap in height parts them; `points`
        are those near the group, `members` those of the group.
        """
        places = np.column_stack(points[:2])
        low, ground = places[members], places[group.is_on_ground(points)]
        if len(ground) > 1:
            nearest, apart = nearest_and_apart(low, ground)
            spread = np.median(np.hypot(*(low - np.median(low, axis=0)).T))
            is_doubtful = self.nearest * apart < nearest <= self.doubtful * apart
            if spread >= self.spread * apart and not is_doubtful:
                return nearest <= self.nearest * apart
        below = np.sort(np.append(group.above(points)[members], 0.0))
        return bool(np.diff(below).max() >= self.gap * -below[0])


def nearest_and_apart(low: np.ndarray, ground: np.ndarray) -> tuple[float, float]:
    """Return the median distances of low places (n, 2) from the nearest of the ground, at least
    two, and of these from each other.
    """
    from scipy.spatial import cKDTree

    tree = cKDTree(ground)
    apart = float(np.median(tree.query(ground, 2)[0][:, 1]))
    return float(np.median(tree.query(low)[0])), apart


class Group(NamedTuple):
    """A low group: the place of its lowest point, and the plane below which its points lie."""

    x: float  # of the lowest point
    y: float
    limit: float  # height in metres of the plane at this place
    # Rise over run of the plane towards east and north.
    east: float
    north: float
    margin: float  # metres by which the plane of the ground is higher

    def above(self, points: Points) -> np.ndarray:
        """Return how many metres above the plane points lie."""
        x, y = points.x - self.x, points.y - self.y
        return points.z - (self.limit + self.east * x + self.north * y)

    def is_on_ground(self, points: Points) -> np.ndarray:
        """Return which points lie on the plane of the ground."""
        above = self.above(points)
        return (above >= 0.0) & (above <= 2.0 * self.margin)

    def holds(self, points: Points, width: float) -> np.ndarray:
        """Return which points belong to the group."""
        distance = np.hypot(points.x - self.x, points.y - self.y)
        return (self.above(points) < 0.0) & (distance <= _OF_GROUP * width)


@dataclass(frozen=True)
class BelowWater(PointRule):
    """Points scattered below a level water surface are low noise."""

    # Water returns few pulses. Where points are sparse and many of them lie at one level, and the
    # land round them is as high or higher, no point below this level is terrain. Lower terrain,
    # such as that behind a dam, has as many points as other land.

    stage: ClassVar = Stage.LOW_NOISE
    writes: ClassVar = ("points", "grids", "low_noise")

    # Sides of the cells, one pass each, in spacings of the points of at least 1 m. Wide cells are
    # for water with very few returns.
    sizes: tuple[float, ...] = (4.0, 8.0)
    reach: int = 4  # radius of the surroundings in cells
    sparse: float = 0.5  # largest density of water, as a share of the usual density of points
    # A water surface is a band of heights of this width in metres with at least this share of the
    # heights in the surroundings.
    band: float = 0.1
    least_share: float = 0.4
    shore: float = 0.25  # metres by which the land round it may be lower than the water
    sides: int = 6  # least number, of eight, on which half of the heights are not below the water
    depth: float = 0.4  # least depth in metres of noise below the water
    most: float = 0.1  # largest density of noise, as a share of the usual density of points

    def apply(self, state: State) -> None:
        """Add the points below water to the low noise."""
        for size in self.sizes:
            grid = state.grids[0]
            width = size * max(_CELL, state.spacing)
            cells = grid.cells.wider(state.points, width)
            found = self.find(state.points, grid.lowest, state.spacing, cells)
            state.add_low_noise(found)

    def find(self, points: Points, lowest: np.ndarray, spacing: float, cells: Cells) -> np.ndarray:
        """Return which points (n,) lie below water, given the `lowest` points of narrow cells, and
        wide cells to search in; points that are infinitely high are ignored.
        """
        # Of the lowest points of narrow cells, the highest in each wide cell lies on the surface.
        # Most of these points are at the level of the water.
        from scipy import ndimage

        def density(counts: np.ndarray) -> np.ndarray:
            """Return the share of the usual number of points in each cell and those round it."""
            share = counts * (spacing / cells.size) ** 2
            return ndimage.uniform_filter(share, 3, mode="nearest")

        is_finite = np.isfinite(points.z)
        counts = cells.counts if is_finite.all() else cells.counts_of(is_finite)
        searched = density(counts) < self.sparse
        searched &= self._deep(points, cells, lowest)
        # The border of the survey cuts the outermost cells, so that they have fewer points.
        searched[[0, -1]] = searched[:, [0, -1]] = False
        if not searched.any():
            return np.zeros(points.count, dtype=bool)
        z, x, y = (-points.z[lowest], points.x[lowest], points.y[lowest])
        upper = lowest[first_of_each(cells.index[lowest], searched.size, z, x, y)]
        grids = LowestOfCells.of(points, cells, self.reach, upper)
        limit = np.full(cells.shape, -np.inf)
        limit[searched] = np.concatenate(
            [self._limits(around) for around in grids.around(grids.places(searched), 0.0)]
        )
        # Cells along the shore have too few points of the water to show its level.
        near_limit, far_limit = (
            np.where(np.isfinite(limit), limit, within_square(np.maximum, limit, cells_away))
            for cells_away in (1, 2)
        )
        which = cells.points_in(np.isfinite(far_limit))
        z, index = points.z[which], cells.index[which]
        below, counted = (z < grid.ravel().take(index) for grid in (near_limit, far_limit))
        counts = np.bincount(index[counted], minlength=limit.size).reshape(limit.shape)
        found = np.zeros(points.count, dtype=bool)
        found[which] = below & (density(counts) < self.most).ravel().take(index)
        return found

    def _deep(self, points: Points, cells: Cells, lowest: np.ndarray) -> np.ndarray:
        """Return which cells have a lowest point far below the highest one beside."""
        z, index = points.z[lowest], cells.index[lowest]
        deepest, highest = (np.full(cells.rows * cells.columns, sign * np.inf) for sign in (1, -1))
        np.minimum.at(deepest, index, z)
        np.maximum.at(highest, index, z)
        beside = within_square(np.maximum, highest.reshape(cells.shape), 1)
        return deepest.reshape(cells.shape) < beside - self.depth

    def _limits(self, around: LowestNeighbours) -> np.ndarray:
        """Return the height below which points are noise at each place; -inf without water."""
        z = np.sort(np.where(around.known, around.z, np.inf), axis=1)
        known = np.count_nonzero(around.known, axis=1)
        needed = np.maximum(np.ceil(self.least_share * known).astype(np.intp), _LEAST_HEIGHTS)
        last = np.arange(z.shape[1]) + needed[:, None] - 1
        top = np.take_along_axis(z, np.minimum(last, z.shape[1] - 1), axis=1)
        with np.errstate(invalid="ignore"):
            width = np.where(last < known[:, None], top - z, np.inf)
        first = width.argmin(axis=1)[:, None]
        narrowest = np.take_along_axis(width, first, axis=1)
        is_level = narrowest[:, 0] <= self.band
        level = np.where(is_level[:, None], np.take_along_axis(z, first, axis=1) + narrowest / 2, 0)
        fits = around.known & (around.z >= level - self.shore)
        is_water = is_level & (around.sides_with(fits) >= self.sides)
        return np.where(is_water, around.centre[2] + level[:, 0] - self.depth, -np.inf)
