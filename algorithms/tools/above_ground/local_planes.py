"""The plane that most neighbours of a place lie on, also where two planes meet."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

import numpy as np

from ...core.progress import SILENT, Progress
from ...core.threads import over_parts

# Planes are tried through a point and two of so many nearest neighbours.
_TRIED = 8
# Two neighbours in almost one direction do not fix a plane: least sine of their angle.
_LEAST_SINE = 0.3
# Points whose planes are sought together, so that arrays stay in the processor's cache.
_POINTS_A_PART = 1 << 12


@dataclass(frozen=True)
class LocalPlanes:
    """A plane for each of some points, with heights relative to its point."""

    # float32 (n, 3): slope to the east, slope to the north, and height at the point in metres above
    # it; 0 without a plane.
    rise: np.ndarray
    on: np.ndarray  # bool (n, k), neighbours on the plane; all False without one

    @classmethod
    def through(
        cls,
        places: np.ndarray,  # (n, 3) in metres
        neighbours: np.ndarray,  # (n, k), the nearest in the plane; the first is the point itself
        near: np.ndarray,  # bool (n, k), neighbours that count
        wanted: np.ndarray,  # bool (n,), points that get a plane
        tolerance: float,  # metres above or below a plane
        steepest: float,  # degrees
        progress: Progress = SILENT,
    ) -> LocalPlanes:
        """Return the planes on which most neighbours lie."""
        # A plane through all neighbours would not find a roof whose ridge is among them. So planes
        # are tried through the point and each two of its nearest neighbours. The one that most
        # neighbours lie on is fitted to these.
        rise = np.zeros((len(places), 3), dtype=np.float32)
        on = np.zeros(neighbours.shape, dtype=bool)
        which, slope = np.flatnonzero(wanted), math.tan(math.radians(steepest))

        def fill(part: slice) -> None:
            some = which[part]
            steps = (places[neighbours[some]] - places[some][:, None]).astype(np.float32)
            rise[some], on[some] = _planes(steps, near[some], tolerance, slope)

        over_parts(fill, len(which), _POINTS_A_PART, progress)
        return cls(rise, on)


def _planes(
    steps: np.ndarray, near: np.ndarray, tolerance: float, slope: float
) -> tuple[np.ndarray, np.ndarray]:
    """Return planes and which neighbours lie on them, given the steps (m, k, 3) to these."""
    x, y, z = (np.ascontiguousarray(steps[:, :, axis].T) for axis in range(3))
    near, count = near.T, x.shape[1]
    best, east, north = np.zeros((3, count), dtype=np.float32)
    for one, two in itertools.combinations(range(1, min(_TRIED + 1, len(x))), 2):
        area = x[one] * y[two] - y[one] * x[two]
        lengths = np.hypot(x[one], y[one]) * np.hypot(x[two], y[two])
        wide = np.abs(area) > _LEAST_SINE * lengths
        area = np.where(wide, area, 1.0)
        to_east = (z[one] * y[two] - z[two] * y[one]) / area
        to_north = (x[one] * z[two] - x[two] * z[one]) / area
        off = np.abs(z - to_east * x - to_north * y)
        votes = np.count_nonzero((off <= tolerance) & near, axis=0).astype(np.float32)
        votes[~wide | ~near[one] | ~near[two] | (np.hypot(to_east, to_north) > slope)] = 0.0
        better = votes > best
        best[better] = votes[better]
        east[better], north[better] = to_east[better], to_north[better]
    on = (np.abs(z - east * x - north * y) <= tolerance) & near & (best > 0.0)
    east, north, level = _fitted(x, y, z, on, east, north)
    on &= np.abs(z - east * x - north * y - level) <= tolerance
    on &= on[0]  # a plane that misses its own point is none
    return np.column_stack([east, north, level]), on.T


def _fitted(
    x: np.ndarray, y: np.ndarray, z: np.ndarray, on: np.ndarray, east: np.ndarray, north: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return planes through points by least squares; the given slopes where these are in line."""
    weight, count = on.astype(np.float64), np.maximum(on.sum(axis=0), 1)
    mean_x, mean_y, mean_z = ((weight * each).sum(axis=0) / count for each in (x, y, z))
    dx, dy, dz = x - mean_x, y - mean_y, z - mean_z
    xx, xy, yy = ((weight * one * two).sum(axis=0) for one, two in ((dx, dx), (dx, dy), (dy, dy)))
    xz, yz = ((weight * one * dz).sum(axis=0) for one in (dx, dy))
    area = xx * yy - xy * xy
    solid = area > 1e-6 * (xx + yy) ** 2 + 1e-12
    area = np.where(solid, area, 1.0)
    east = np.where(solid, (xz * yy - yz * xy) / area, east)
    north = np.where(solid, (yz * xx - xz * xy) / area, north)
    return east, north, mean_z - east * mean_x - north * mean_y
