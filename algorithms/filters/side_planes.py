"""Planes through the points on each side of a place."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Callable, NamedTuple

import numpy as np

from ..core.points import Points
from ..core.progress import SILENT
from ..core.threads import over_parts
from ..grids.cells import Cells, cells_at
from ..grids.planes import means_and_moments, plane_slopes

if TYPE_CHECKING:
    from scipy.spatial import cKDTree

_NEIGHBOURS = 16  # number of nearest neighbours that are used
LEAST = 4  # least number of neighbours on a side for a plane
_SIDES = 8  # number of sides, in evenly spread directions
# The terms of a plane are 1, x, y, z and the products of these pairs of them.
_PRODUCTS = ((1, 1), (1, 2), (2, 2), (1, 3), (2, 3), (3, 3))
# Points that are judged at a time, so few that their neighbours stay in the processor's cache.
_AT_ONCE = 1 << 11
_LEAF = 32  # points of a leaf of the tree: many, because there are few queries
# Square metres that are added to the variances of x and y of neighbours, so that these always have
# a plane.
_STIFFNESS = 0.1
_STENCIL = 3  # neighbours are first searched in the cells up to this many rows and columns away
# Most cells for each ground point. With more, neighbours are found only by the tree.
_MOST_VOID = 8
_LAST_BITS = 63  # bits that hold the number of one of 49 cells
_ANGLES = 2.0 * np.pi * np.arange(_SIDES) / _SIDES

# Takes a part of the points and the plane of one side of each: rise, slopes to the east and to the
# north, and misfit, each (n,). Returns which points need no other side, bool (n,). For half to most
# of the seeds that rules doubt, the first side is enough.
Enough = Callable[[slice, np.ndarray, np.ndarray, np.ndarray, np.ndarray], np.ndarray]


class Sides:
    """The planes through the ground round points, one for each side."""

    def __init__(
        self,
        ground: Points,
        reach: float,  # metres from which on ground points are no neighbours
        apart: float = 0.0,  # metres up to which they are none: they may be on the same plant
        cells: Cells | None = None,  # cells whose lowest points the ground is, in their order
    ) -> None:
        self._ground, self._reach, self._apart = ground, reach, apart
        self._of_cells = None
        if cells and cells.rows * cells.columns < _MOST_VOID * ground.count:
            self._of_cells = _OfCells.over(cells, ground)

    @cached_property
    def _tree(self) -> cKDTree:
        """A tree of the ground points, for neighbours that are not found by cell."""
        from scipy.spatial import cKDTree

        places = np.column_stack((self._ground.x, self._ground.y))
        return cKDTree(places, _LEAF, compact_nodes=False, balanced_tree=False)

    def rises(
        self, points: Points, own: bool, enough: Enough | None = None
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return how many metres points lie above the plane of each side, NaN with too few
        neighbours, and its misfit, both (n, 8); `own` points are ground, but not neighbours of
        themselves.
        """
        rise, _, _, misfit = self.planes(points, own, enough)
        return rise, misfit

    def planes(
        self, points: Points, own: bool = False, enough: Enough | None = None
    ) -> tuple[np.ndarray, ...]:
        """Return for each side how many metres points lie above its plane, the slopes of this to
        the east and to the north (rise over run), and its misfit, all (n, 8); NaN on further sides
        of points for which the first is `enough`.
        """
        found = np.full((4, points.count, _SIDES), np.nan)
        if self._ground.count and points.count:

            def judge(part: slice) -> None:
                terms, there = self._neighbours(points.take(part), own)
                rest = np.arange(there.shape[1])
                if enough:
                    beside = _beside(terms, there, np.zeros(1))[0].astype(float)
                    first = _planes(np.einsum("tkn,kn->tn", terms, beside))
                    found[:, part, 0] = first
                    rest = np.flatnonzero(~enough(part, *first))
                    terms, there = terms.take(rest, axis=2), there.take(rest, axis=1)
                beside = _beside(terms, there, _ANGLES).transpose(2, 0, 1)
                sums = beside.astype(float) @ terms.transpose(2, 1, 0)
                found[:, part.start + rest] = _planes(np.moveaxis(sums, -1, 0))

            over_parts(judge, points.count, _AT_ONCE, SILENT)
        return tuple(found)

    def _nearest(self, points: Points, own: bool) -> tuple[np.ndarray, np.ndarray]:
        """Return the distances and the indices of the 17 nearest ground points of points, (17, n),
        in ascending order.
        """
        places, count = np.column_stack((points.x, points.y)), _NEIGHBOURS + 1 + own
        if self._of_cells is None or own:
            found = self._tree.query(places, count, distance_upper_bound=self._reach)
        else:
            found = distance, numbers = self._of_cells.nearest(points, count)
            far = np.flatnonzero(distance[:, -1] > min(self._of_cells.certain, self._reach))
            if len(far):
                distance[far], numbers[far] = self._tree.query(
                    places[far], count, distance_upper_bound=self._reach
                )
        distance, numbers = (np.ascontiguousarray(values.T[int(own) :]) for values in found)
        return distance, numbers

    def _neighbours(self, points: Points, own: bool) -> tuple[np.ndarray, np.ndarray]:
        """Return the terms of planes for the neighbours of points, (10, 16, n), and which of these
        neighbours count, (16, n).
        """
        distance, numbers = self._nearest(points, own)
        # Of several points that are as far away as the last one, the tree returns any, so that none
        # of them counts.
        there = (distance[:-1] < distance[-1]) & (distance[:-1] >= self._apart)
        numbers = np.where(there, numbers[:-1], 0)
        terms = np.empty((10, *numbers.shape))
        terms[0] = 1.0
        for term, of, place in zip(terms[1:4], self._ground, points):
            np.subtract(of.take(numbers), place, out=term)
        terms[1:4] *= there
        for product, (first, second) in zip(terms[4:], _PRODUCTS):
            np.multiply(terms[first], terms[second], out=product)
        return terms, there


class _OfCells(NamedTuple):
    """Points, at most one a cell: found by cell, four times as fast as by a tree."""

    # Grids with a margin of empty cells: indices of points, and x and y, infinite in empty cells.
    number: np.ndarray
    x: np.ndarray
    y: np.ndarray
    cells: Cells

    @classmethod
    def over(cls, cells: Cells, ground: Points) -> _OfCells:
        """Return the points by cell."""
        shape = cells.rows + 2 * _STENCIL, cells.columns + 2 * _STENCIL
        number, (x, y) = np.zeros(shape, dtype=np.int64), np.full((2, *shape), np.inf)
        row, column = cells_at(ground.x, ground.y, cells.size)
        place = row + _STENCIL - cells.first_row, column + _STENCIL - cells.first_column
        number[place], x[place], y[place] = np.arange(ground.count), ground.x, ground.y
        return cls(number, x, y, cells)

    @property
    def certain(self) -> float:
        """The distance in metres within which `nearest` misses no point."""
        return _STENCIL * self.cells.size

    def nearest(self, places: Points, count: int) -> tuple[np.ndarray, np.ndarray]:
        """Return the distances and the indices of the `count` nearest points of places among those
        in the cells round each, (n, count), in ascending order.
        """
        width = self.x.shape[1]
        steps = np.arange(2 * _STENCIL + 1)
        row, column = cells_at(places.x, places.y, self.cells.size)
        corner = (row - self.cells.first_row) * width + column - self.cells.first_column
        there = corner[:, None] + (steps[:, None] * width + steps).ravel()
        squared, north = self.x.take(there), self.y.take(there)
        for beside, place in ((squared, places.x), (north, places.y)):
            beside -= place[:, None]
            beside *= beside
        squared += north
        # The bits of squares, read as whole numbers, have the same order. The last bits hold the
        # number of the cell, because a sort takes a third of the time of an argsort.
        keys = squared.view(np.int64) & ~_LAST_BITS
        keys |= np.arange(len(steps) ** 2)
        keys.sort(axis=1)
        first = keys[:, :count] & _LAST_BITS
        first += np.arange(len(keys))[:, None] * len(steps) ** 2
        return np.sqrt(squared.take(first)), self.number.take(there.take(first))


def _beside(terms: np.ndarray, there: np.ndarray, angles: np.ndarray) -> np.ndarray:
    """Return which neighbours lie on the sides in some directions, shape (sides, 16, n)."""
    ahead = terms[1] * np.cos(angles)[:, None, None]
    ahead += terms[2] * np.sin(angles)[:, None, None]
    return (ahead >= -1e-6) & there


def _planes(sums: np.ndarray) -> tuple[np.ndarray, ...]:
    """Return how far (0, 0, 0) lies above planes, their two slopes and their misfits, from the sums
    of the terms of neighbours.
    """
    count, *rest, zz = sums
    total = np.maximum(count, 1.0)
    x, y, z, xx, xy, yy, xz, yz = means_and_moments(total, *rest)
    zz = zz / total - z * z
    # A small term is added, because neighbours on one line have no slope across this line.
    east, north = plane_slopes(xx + _STIFFNESS, xy, yy + _STIFFNESS, xz, yz)
    rise = east * x + north * y - z
    square = zz - 2.0 * (east * xz + north * yz)
    square += east * east * xx + 2.0 * east * north * xy + north * north * yy
    rise[count < LEAST] = square[count < LEAST] = np.nan
    return rise, east, north, np.sqrt(np.maximum(square, 0.0))
