"""Small groups of points far below the ground round them: multipath, sensor faults, reflections."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Iterator, NamedTuple

import numpy as np

from ...core.points import Points
from ...core.threads import parts_of
from ...grids.cells import Cells, spacing
from ...grids.gradient import gradient
from ...grids.inpaint import inpaint
from ...grids.morphology import median_of_nine, within_square

# Least side of a cell in metres; wider where points are farther apart, so that few cells are empty.
_CELL = 1.0
# Distances from the lowest point of a group, as multiples of its width: up to the first, points
# below the plane are of the group; beyond the second, others as low show that it is none.
_OF_GROUP, _BESIDE_GROUP = 1.5, 1.25
# Directions in which the surroundings are looked at, and places that are judged at a time.
_SIDES, _PLACES_A_PART = 8, 2048
# Rounds in which the plane is fitted; in the first ones, heights far from it still count.
_ROUNDS, _WIDE_ROUNDS, _WIDE, _NARROW = 6, 2, 3.0, 2.0
# Least distance in metres from the plane at which a height counts less.
_EXACT = 0.1
# Side in cells of the squares over which the slope of the terrain is averaged.
_SLOPE_CELLS = 5
# Share of the known heights below which the fit of the plane starts: under roofs and crowns.
_START = 0.3
# The deviation of a normal distribution as a multiple of the median of its absolute values.
_DEVIATION = 1.48


@dataclass(frozen=True)
class LowGroups:
    """The rule for groups of points that lie in a pit below ground that surrounds them.

    Real pits of this size are hardly ever as deep, and of those that are (gaps in a canopy, wells,
    ends of ditches) others near them are as low, or the lowest points round them are uneven.

    Attributes
    ----------
    width : float
        Largest width of a group in metres. Its corners may be farther from its lowest point.
    depth : float
        Least depth in metres below the plane of the surroundings.
    deviations : float
        Least depth as a multiple of the deviation of the surroundings from their plane.
    ring : float
        Radius of the surroundings in metres.
    ring_cells : int
        Least radius of the surroundings in cells, for sparse points.
    level, level_share, level_most : float
        A height belongs to the plane up to this share of the depth of the group, but at least
        `level` and at most `level_most` metres from it.
    sides : int
        On so many of eight sides, half of the heights must belong to the plane.
    heights : int
        Least number of heights in the surroundings.
    """

    width: float = 2.0
    depth: float = 0.4
    deviations: float = 4.0
    ring: float = 6.0
    ring_cells: int = 4
    level: float = 0.25
    level_share: float = 0.25
    level_most: float = 0.75
    sides: int = 5
    heights: int = 8

    def find(self, points: Points) -> np.ndarray:
        """Return which points belong to a low group.

        The lowest point of each cell is compared with the plane through the lowest points round it.
        The plane follows the lower ones where buildings or crowns stand among them. On most sides
        the surroundings must lie on the plane, and nothing beyond the group may be as low.

        Parameters
        ----------
        points : Points
            At least one point.

        Returns
        -------
        numpy.ndarray of bool, shape (n,)
        """
        size = max(_CELL, spacing(points))
        cells = Cells.over(points, size)
        grids = _Lowest.of(points, cells, math.ceil(max(self.ring / size, self.ring_cells)))
        places = grids.pits(cells, 0.5 * self.depth, math.ceil(self.width / size))
        groups = [
            found
            for part in parts_of(len(places), _PLACES_A_PART)
            for found in self._groups(grids.round(places[part], self.width))
        ]
        return self._members(points, cells, groups)

    def _groups(self, around: _Surroundings) -> Iterator[_Group]:
        """Yield the places that are groups, with the planes above them."""
        plane, misfit, deviation = around.plane(self)
        depth = plane[:, 2]
        on_plane = around.known & (np.abs(misfit) <= self._level(depth)[:, None])
        as_low = around.known & (misfit < -0.5 * depth[:, None])
        as_low &= around.distance > _BESIDE_GROUP * self.width
        deep = depth > np.maximum(self.depth, self.deviations * deviation)
        seen = np.count_nonzero(around.known, axis=1) >= self.heights
        alone = ~as_low.any(axis=1)
        for number in np.flatnonzero(deep & seen & alone & self._enclosed(around, on_plane)):
            east, north, height = plane[number].tolist()
            x, y, z = (float(column[number]) for column in around.centre)
            margin = max(self.level, 3.0 * float(deviation[number]))
            yield _Group(x, y, z + height - margin, east, north)

    def _level(self, depth: np.ndarray) -> np.ndarray:
        """Return how far a height may be from the plane above groups of some depths."""
        return np.clip(self.level_share * depth, self.level, self.level_most)

    def _enclosed(self, around: _Surroundings, on_plane: np.ndarray) -> np.ndarray:
        """Return round which places the surroundings lie on the plane on most sides."""
        sides = np.zeros(len(on_plane), dtype=np.int8)
        for side in range(_SIDES):
            here = around.known & (around.side == side)
            known = np.count_nonzero(here, axis=1)
            sides += (2 * np.count_nonzero(here & on_plane, axis=1) >= known) & (known > 0)
        return sides >= self.sides

    def _members(self, points: Points, cells: Cells, groups: list[_Group]) -> np.ndarray:
        """Return which points lie below the limit of a group and within its width."""
        members = np.zeros(points.count, dtype=bool)
        if not groups:
            return members
        reach = math.ceil(_OF_GROUP * self.width / cells.size)
        near = np.zeros(cells.shape, dtype=bool)
        places = [
            (math.floor(group.y / cells.size), math.floor(group.x / cells.size)) for group in groups
        ]
        rows, columns = (np.array(places) - cells.first).T
        near[rows, columns] = True
        near = within_square(np.maximum, near.view(np.uint8), reach).astype(bool)
        which = np.flatnonzero(near.ravel()[cells.index])
        order = np.argsort(cells.index[which], kind="stable")
        which, index = which[order], cells.index[which[order]]
        for group, row, column in zip(groups, rows.tolist(), columns.tolist()):
            first = max(column - reach, 0)
            last = min(column + reach, cells.columns - 1)
            for line in range(max(row - reach, 0), min(row + reach, cells.rows - 1) + 1):
                start, end = np.searchsorted(
                    index, (line * cells.columns + first, line * cells.columns + last + 1)
                )
                some = which[start:end]
                members[some[group.holds(points.take(some), self.width)]] = True
        return members


class _Group(NamedTuple):
    """A low group: its lowest point, and the plane below which its points lie."""

    x: float
    y: float
    limit: float
    east: float
    north: float

    def holds(self, points: Points, width: float) -> np.ndarray:
        """Return which points belong to the group."""
        x, y = points.x - self.x, points.y - self.y
        low = points.z < self.limit + self.east * x + self.north * y
        return low & (np.hypot(x, y) <= _OF_GROUP * width)


class _Surroundings(NamedTuple):
    """The lowest points round some places; arrays of shape (places, neighbours).

    Attributes
    ----------
    centre : tuple of numpy.ndarray
        x, y and z of the places.
    x, y, z : numpy.ndarray of float32
        Relative to the place; 0 where nothing is known.
    distance : numpy.ndarray of float32
        Horizontal distance from the place.
    side : numpy.ndarray of int8
        Direction from the place, 0 to 7.
    known : numpy.ndarray of bool
        Where there is a point that cannot belong to the group itself.
    """

    centre: tuple[np.ndarray, np.ndarray, np.ndarray]
    x: np.ndarray
    y: np.ndarray
    z: np.ndarray
    distance: np.ndarray
    side: np.ndarray
    known: np.ndarray

    def plane(self, rule: LowGroups) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return the planes, the heights above them, and the deviation of those on them.

        Least squares with weights by Geman and McClure, from a level plane under most heights.
        """
        count = len(self.z)
        plane = np.zeros((count, 3), dtype=np.float32)
        plane[:, 2] = np.nan_to_num(self._quantile(self.z, _START), posinf=0.0)
        for number in range(_ROUNDS):
            misfit = self._above(plane)
            scale = self._quantile(np.abs(misfit), 0.5)
            scale *= _WIDE if number < _WIDE_ROUNDS else _NARROW
            weights = 1.0 + (misfit / np.maximum(scale, _EXACT)[:, None]) ** 2
            plane = self._fitted(np.where(self.known, weights**-2.0, 0.0))
        misfit = self._above(plane)
        off = np.abs(misfit)
        off[off > rule._level(plane[:, 2])[:, None]] = np.inf
        deviation = self._quantile(off, 0.5, self.known & np.isfinite(off))
        return plane, misfit, _DEVIATION * deviation

    def _above(self, plane: np.ndarray) -> np.ndarray:
        east, north, height = plane.T[:, :, None]
        return self.z - (self.x * east + self.y * north + height)

    def _quantile(
        self, values: np.ndarray, share: float, which: np.ndarray | None = None
    ) -> np.ndarray:
        """Return a quantile of some values of each place; infinite where there are none."""
        which = self.known if which is None else which
        ordered = np.sort(np.where(which, values, np.inf), axis=1)
        last = np.maximum(np.count_nonzero(which, axis=1) - 1, 0)
        return ordered[np.arange(len(ordered)), np.floor(share * last).astype(np.intp)]

    def _fitted(self, weights: np.ndarray) -> np.ndarray:
        """Return the planes of weighted least squares."""
        columns = self.x, self.y, np.ones_like(self.x)
        normal, right = np.zeros((len(weights), 3, 3)), np.zeros((len(weights), 3, 1))
        for i, one in enumerate(columns):
            weighted = weights * one
            right[:, i, 0] = np.einsum("pn,pn->p", weighted, self.z)
            for k in range(i, 3):
                normal[:, i, k] = normal[:, k, i] = np.einsum("pn,pn->p", weighted, columns[k])
        # So that a place with hardly any neighbours has a plane as well.
        normal += 1e-6 * np.eye(3)
        return np.linalg.solve(normal, right)[:, :, 0].astype(np.float32)


class _Lowest(NamedTuple):
    """Where the lowest point of each cell lies, on grids with a margin of unknown cells.

    Attributes
    ----------
    x, y, z : numpy.ndarray of float64, shape (rows, columns)
        NaN where there is none.
    margin : int
        Cells of margin, the radius of the surroundings.
    """

    x: np.ndarray
    y: np.ndarray
    z: np.ndarray
    margin: int

    @classmethod
    def of(cls, points: Points, cells: Cells, margin: int) -> _Lowest:
        """Return the lowest points of cells."""
        lowest = cells.lowest_points(points)
        row, column = np.divmod(cells.index[lowest], cells.columns)
        shape = cells.rows + 2 * margin, cells.columns + 2 * margin
        x, y, z = grids = np.full((3, *shape), np.nan)
        grids[:, row + margin, column + margin] = points.take(lowest)
        return cls(x, y, z, margin)

    def pits(self, cells: Cells, depth: float, reach: int) -> np.ndarray:
        """Return the cells that a closing raises, the deepest or lowest within reach only."""
        inner = (slice(self.margin, -self.margin),) * 2
        known = np.isfinite(self.z[inner])
        filled = inpaint(self.z[inner], first=cells.first)
        filled -= self._beside_centre(cells, filled)
        closed = within_square(np.minimum, within_square(np.maximum, filled, reach), reach)
        raised = np.where(known, closed - filled, 0.0)
        pits = raised >= within_square(np.maximum, raised, reach)
        pits |= filled <= within_square(np.minimum, filled, reach)
        row, column = np.nonzero(pits & (raised > depth))
        return (row + self.margin) * self.z.shape[1] + column + self.margin

    def _beside_centre(self, cells: Cells, filled: np.ndarray) -> np.ndarray:
        """Return how much lower or higher than the centre of its cell the lowest point lies.

        The lowest point of a cell on a slope is one at its lower side, by chance nearer or farther.
        """
        from scipy import ndimage

        inner = (slice(self.margin, -self.margin),) * 2
        smooth = ndimage.uniform_filter(median_of_nine(filled.astype(np.float32)), _SLOPE_CELLS)
        north, east = gradient(smooth, cells.size)
        y, x = (
            axis[inner] - (first + np.arange(count) + 0.5).reshape(shape) * cells.size
            for axis, first, count, shape in zip(
                (self.y, self.x), cells.first, cells.shape, ((-1, 1), (1, -1))
            )
        )
        return np.nan_to_num(east * x + north * y)

    def round(self, places: np.ndarray, width: float) -> _Surroundings:
        """Return the lowest points round some cells."""
        steps = np.arange(-self.margin, self.margin + 1)
        row, column = (axis.ravel() for axis in np.meshgrid(steps, steps, indexing="ij"))
        disc = (row**2 + column**2 <= self.margin**2) & ((row != 0) | (column != 0))
        there = places[:, None] + (row * self.z.shape[1] + column)[disc]
        centre = tuple(grid.ravel()[places] for grid in (self.x, self.y, self.z))
        x, y, z = (
            (grid.ravel()[there] - at[:, None]).astype(np.float32)
            for grid, at in zip((self.x, self.y, self.z), centre)
        )
        distance = np.hypot(x, y)
        known = distance > width  # False for NaN
        x, y, z, distance = (np.where(known, axis, np.float32(0.0)) for axis in (x, y, z, distance))
        side = np.floor((np.arctan2(y, x) / np.pi + 1.0) * (0.5 * _SIDES)).astype(np.int8) % _SIDES
        return _Surroundings(centre, x, y, z, distance, side, known)
