"""Small groups of points far below the ground round them: multipath, sensor faults, reflections."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, Iterator, NamedTuple

import numpy as np

from ...core.points import Points
from ...grids.cells import Cells, spacing
from ...grids.morphology import within_square
from ..pipeline import PointRule, Stage
from ..state import State
from .surroundings import SIDES, LowestOfCells, Surroundings

# Least side of a cell in metres; wider where points are farther apart, so that few cells are empty.
_CELL = 1.0
# Distances from the lowest point of a group, as multiples of its width: up to the first, points
# below the plane are of the group; beyond the second, others as low show that it is none.
_OF_GROUP, _BESIDE_GROUP = 1.5, 1.25
# The deviation of a normal distribution as a multiple of the median of its absolute values.
_DEVIATION = 1.48


@dataclass(frozen=True)
class LowGroups(PointRule):
    """A small group of points in a pit below ground that surrounds it is low noise.

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
    level : float
        A height belongs to the plane up to so many metres from it.
    sides : int
        On so many of eight sides, half of the heights must belong to the plane.
    """

    stage: ClassVar = Stage.LOW_NOISE
    reads: ClassVar = ("points", "grids", "known_ground")
    writes: ClassVar = ("points", "grids", "low_noise")

    width: float = 2.0
    depth: float = 0.4
    deviations: float = 4.0
    ring: float = 6.0
    ring_cells: int = 4
    level: float = 0.25
    sides: int = 5

    def apply(self, state: State) -> None:
        """Add the groups to the low noise."""
        grid = state.grids[0]
        size = max(_CELL, state.spacing)
        known = (grid.cells, grid.lowest) if grid.cells.size == size else None
        state.add_low_noise(self.find(state.points, known))

    def find(self, points: Points, known: tuple[Cells, np.ndarray] | None = None) -> np.ndarray:
        """Return which points belong to a low group.

        The lowest point of each cell is compared with the plane through the lowest points round it.
        The plane follows the lower ones where buildings or crowns stand among them. On most sides
        the surroundings must lie on the plane, and nothing beyond the group may be as low.

        Parameters
        ----------
        points : Points
            At least one point.
        known : tuple of Cells and numpy.ndarray of intp, optional
            Cells of at least 1 m, and the lowest point of each, if they are known.

        Returns
        -------
        numpy.ndarray of bool, shape (n,)
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
            found for around in grids.around(places, self.width) for found in self._groups(around)
        ]
        return self._members(points, cells, groups)

    def _groups(self, around: Surroundings) -> Iterator[_Group]:
        """Yield the places that are groups, with the planes above them."""
        plane, misfit = around.plane()
        depth = plane[:, 2]
        on_plane = around.known & (np.abs(misfit) <= self.level)
        deviation = _DEVIATION * around.median(np.abs(misfit), on_plane)
        as_low = around.known & (misfit < -0.5 * depth[:, None])
        as_low &= around.distance > _BESIDE_GROUP * self.width
        deep = depth > np.maximum(self.depth, self.deviations * deviation)
        alone = ~as_low.any(axis=1)
        for number in np.flatnonzero(deep & alone & self._enclosed(around, on_plane)):
            east, north, height = plane[number].tolist()
            x, y, z = (float(column[number]) for column in around.centre)
            margin = max(self.level, 3.0 * float(deviation[number]))
            yield _Group(x, y, z + height - margin, east, north)

    def _enclosed(self, around: Surroundings, on_plane: np.ndarray) -> np.ndarray:
        """Return round which places the surroundings lie on the plane on most sides."""
        sides = np.zeros(len(on_plane), dtype=np.int8)
        for side in range(SIDES):
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
        which = cells.points_in(near)
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
