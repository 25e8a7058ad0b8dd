"""Planes through the points on each side of a place."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..core.points import Points
from ..core.progress import SILENT
from ..core.threads import over_parts
from .planes import means_and_moments, plane_slopes

# Nearest neighbours that are used, and how many of them a side needs for a plane.
_NEIGHBOURS, _LEAST = 16, 4
# Number of sides, in evenly spread directions.
_SIDES = 8
# The columns of x, y and z among the sums, of which the products are summed up as well.
_PRODUCTS = ((1, 1), (1, 2), (2, 2), (1, 3), (2, 3), (3, 3))
# Points that are judged at a time, so few that their neighbours stay in the processor's cache.
_AT_ONCE = 1 << 11
# Points of a leaf of the tree: more than usual, because there are few queries.
_LEAF = 32
# Square metres that are added to the variances of the neighbours' places, so that there is always a
# plane.
_STIFFNESS = 0.1


class Sides:
    """The ground round points, separately for each side."""

    # `ground`: Points of the ground.
    # `reach`: Metres within which ground points are neighbours.
    # `apart`: Metres within which they are none, as they may belong to the same plant.

    def __init__(self, ground: Points, reach: float, apart: float = 0.0) -> None:
        from scipy.spatial import cKDTree

        self._ground, self._reach, self._apart = ground, reach, apart
        self._tree = None
        if ground.count:
            places = np.column_stack((ground.x, ground.y))
            self._tree = cKDTree(places, _LEAF, compact_nodes=False, balanced_tree=False)

    def rises(self, points: Points, own: bool) -> tuple[np.ndarray, np.ndarray]:
        """Return how many metres points lie above the plane of each side, NaN with too few
        neighbours, and its misfit, both (n, 8); `own` points are ground, and not their own
        neighbours.
        """
        rise, _, _, misfit = self.planes(points, own)
        return rise, misfit

    def planes(self, points: Points, own: bool = False) -> tuple[np.ndarray, ...]:
        """Return the planes on all sides of points: how many metres these lie above them, their
        slopes to the east and to the north, rise over run, and their misfits, all (n, 8).
        """
        found = np.full((4, points.count, _SIDES), np.nan)
        tree = self._tree
        if tree is not None:

            def judge(part: slice) -> None:
                found[:, part] = _planes(self._sums(tree, points.take(part), own))

            over_parts(judge, points.count, _AT_ONCE, SILENT)
        return tuple(found)

    def _sums(self, tree: Any, points: Points, own: bool) -> np.ndarray:
        """Return the sums over the neighbours on each side of points, shape (n, 8, 10)."""
        places = np.column_stack((points.x, points.y))
        distance, which = tree.query(
            places, _NEIGHBOURS + 1 + own, distance_upper_bound=self._reach
        )
        if own:
            distance, which = distance[:, 1:], which[:, 1:]
        # If several are equally far away, the tree may return any of them. Then none of them
        # counts.
        there = (distance[:, :-1] < distance[:, -1:]) & (distance[:, :-1] >= self._apart)
        which = np.where(there, which[:, :-1], 0)
        terms = np.empty((10, *which.shape))
        terms[0] = 1.0
        for term, of, place in zip(terms[1:4], self._ground, points):
            np.subtract(of.take(which), place[:, None], out=term)
        terms[1:4] *= there
        for product, (one, two) in zip(terms[4:], _PRODUCTS):
            np.multiply(terms[one], terms[two], out=product)
        angles = 2.0 * np.pi * np.arange(_SIDES)[:, None] / _SIDES
        ahead = terms[1][:, None] * np.cos(angles)
        ahead += terms[2][:, None] * np.sin(angles)
        beside = (ahead >= -1e-6) & there[:, None]
        return beside.astype(float) @ terms.transpose(1, 2, 0)


def _planes(sums: np.ndarray) -> tuple[np.ndarray, ...]:
    """Return how far (0, 0, 0) lies above planes, their slopes and misfits, from sums over
    neighbours.
    """
    count, *rest, zz = np.moveaxis(sums, -1, 0)
    total = np.maximum(count, 1.0)
    x, y, z, xx, xy, yy, xz, yz = means_and_moments(total, *rest)
    zz = zz / total - z * z
    # A small term on the diagonal, because neighbours on one line have no slope across it.
    east, north = plane_slopes(xx + _STIFFNESS, xy, yy + _STIFFNESS, xz, yz)
    rise = east * x + north * y - z
    square = zz - 2.0 * (east * xz + north * yz)
    square += east * east * xx + 2.0 * east * north * xy + north * north * yy
    rise[count < _LEAST] = square[count < _LEAST] = np.nan
    return rise, east, north, np.sqrt(np.maximum(square, 0.0))
