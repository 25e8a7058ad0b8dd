"""Buildings among the points above the ground: roofs, and what belongs to them.

A roof consists of planes of some size, and a laser pulse has a single return from it. Leaves and
branches lie on no plane, and a pulse has several returns from them. Both are tested for the
neighbours of each point, and then for each face as a whole: a few points of a crown lie on a plane
by chance, and many sensors record several returns of few pulses, but the mean of a face is sure.

The parts of the method are known from others: planes and single returns (LAStools lasclassify,
TerraScan, LiDAR360), a least area (all of them), growing from certain roofs (GRASS
v.lidar.growing).
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

import numpy as np

from ...core.points import Points
from ...core.progress import SILENT, Progress
from ...core.threads import over_parts
from ...grids.cells import Cells, spacing
from ...grids.morphology import closing, dilation, erosion, opening
from ...grids.planes import plane_slopes

# The highest point of each square of this side, in metres, stands for the roof there. More points
# would show the noise of the sensor rather than the roof.
_NODE = 0.5
_NEIGHBOURS = 12  # nearest nodes that are the surroundings of a node
_REACH = 2.5  # their largest distance, m
_REACH_SPACINGS = 3.5  # or in spacings of the points, if that is more
# Least number of nodes on a plane, and of nodes of a face: three lie on a plane by chance.
_LEAST_NODES = 5
# A node is no roof if more of its surroundings than this share have several returns.
_MOST_SEVERAL = 0.5
# The share of the surroundings on the plane of a node exceeds that with several returns by this.
_LEAD = 0.1
_SHARE_WITHOUT_RETURNS = 0.6  # the least share on the plane where there are no return numbers
# A face is roof if the mean share of its surroundings on its planes exceeds two shares together by
# this: that of points under it, and `_RETURNS` times that with several returns, as a part of the
# same share of leaves.
_LEAST_EVIDENCE = 0.1
_RETURNS = 0.6
_LEAVES = 0.6  # nodes with a smaller share of their surroundings on a plane are leaves
_LEAST_TOLD = 0.05  # least share of leaves with several returns for these to be evidence
_DEPTH = 1.5  # depth under all nodes of the cell from which a point was seen through leaves, m
_BEND = 15.0  # largest angle between planes of nodes of a face, degrees: a crown curves more
_JOIN = 5.0  # distance from a face up to which smaller planes are roof as well, m
_JOIN_SPACINGS = 2.5  # or in spacings of the points, if that is more
_VOTES = 2  # planes of others through a node that make it roof: edges, ridges
_ON = 0.3  # largest distance of points of a roof from its plane, m
_BESIDE = 1.0  # largest distance of eaves, walls and gutters from a roof, m
_ABOVE = 2.5  # largest height of chimneys, dormers and plants on a roof, m
_LEAST_WALL = 0.5  # least height of a wall, m: what is lower lies in front of it
# Gaps of a roof of up to about three cells are closed.
_CLOSING = 1.5
# Side of the cells in which the width of roofs is measured, in spacings of the points.
_CELL_SPACINGS = 1.2
# Planes to which a point is compared.
_COMPARED = 4
# Nearest neighbours: two of them make a plane with a point that is tried.
_TRIED = 8
# Least sine of the angle between two neighbours: in almost one direction they define no plane.
_LEAST_SINE = 0.3
# Points whose planes are sought together, so that arrays stay in the processor's cache.
_POINTS_A_PART = 1 << 12


@dataclass(frozen=True)
class Buildings:
    """The rule for points of buildings."""

    height: float = 2.0  # metres: least height of a roof above the ground
    area: float = 10.0  # m2: least area of one of its faces; crowns have smaller planes
    width: float = 2.0  # metres: least width of a roof; walls and hedges are narrower
    tolerance: float = 0.15  # metres from nodes to their plane: noise of heights, misfit of strips
    steepest: float = 65.0  # degrees: largest slope of a roof

    def find(
        self,
        points: Points,
        heights: np.ndarray,
        possible: np.ndarray,
        several: np.ndarray,
        progress: Progress = SILENT,
    ) -> np.ndarray:
        """Return which points are on roofs, on what stands on them, and on walls below their edges,
        by heights above the ground in metres and by planes.
        """
        # `possible` are the points that can belong to a building, not the ground, and `several`
        # those of pulses with several returns; without any, the planes alone decide.
        found = np.zeros(points.count, dtype=bool)
        high = np.flatnonzero(possible & (heights > self.height))
        if len(high) < _LEAST_NODES:
            return found
        apart = max(spacing(points, _NODE / 2.0), _NODE / 2.0)
        side = _NODE * max(1, math.ceil(_CELL_SPACINGS * apart / _NODE))
        cells = Cells.over(points, side)
        part = progress.part(0.0, 0.8)
        places, rise, covered = self._roofs(points, high, several, cells, apart, part)
        if not len(places):
            return found
        nearby = dilation(covered, max(_CLOSING, _BESIDE / side)).ravel()
        low = np.flatnonzero(possible & (heights > _LEAST_WALL))
        low = low[nearby[cells.index[low]]]
        inside = covered.ravel()[cells.index[low]]
        found[low] = _belong(points.take(low), places, rise, inside, several[low])
        progress(1.0)
        return found

    def _roofs(
        self,
        points: Points,
        high: np.ndarray,
        several: np.ndarray,
        cells: Cells,
        apart: float,
        progress: Progress,
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return the nodes of roofs among high points, given as indices: their places and planes
        (n, 3), and the cells that they cover (rows, columns).
        """
        upright = points.take(high)
        upside_down = Points(upright.x, upright.y, -upright.z)
        high = high[Cells.over(upright, _NODE).lowest_points(upside_down)]
        places, cell = np.column_stack(points.take(high)), cells.index[high]
        through = _seen_through(points.z, high, cells)[cell]
        rise, plane, roof = self._faces(places, several[high], through, apart, progress)
        # Without gaps, and without what is narrower than a roof.
        covered = closing(_holding(cells, cell[roof]), _CLOSING)
        radius = self.width / 2 / cells.size
        if radius >= 1.0:
            covered = opening(covered.view(np.uint8), radius).view(bool)
        roof &= dilation(covered, _CLOSING).ravel()[cell]
        covered |= closing(_holding(cells, cell[roof]), _CLOSING)
        own = roof & plane
        return places[own], rise[own], covered

    def _faces(
        self,
        places: np.ndarray,
        several: np.ndarray,
        through: np.ndarray,
        apart: float,
        progress: Progress,
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return the planes (n, 3) of nodes, which of them are roof by their own plane (n,), and
        which are roof (n,).
        """
        from scipy.spatial import cKDTree

        tree = cKDTree(places[:, :2])
        distance, neighbours = tree.query(places[:, :2], k=min(_NEIGHBOURS + 1, len(places)))
        near = distance <= max(_REACH, _REACH_SPACINGS * apart)
        count = np.count_nonzero(near, axis=1)
        share = np.count_nonzero(several[neighbours] & near, axis=1) / count
        open_sky = (share <= _MOST_SEVERAL) & (count > _LEAST_NODES)
        progress(0.2)
        limits, part = (self.tolerance, self.steepest), progress.part(0.2, 0.9)
        rise, on = planes_through(places, neighbours, near, open_sky, *limits, part)
        least = _LEAD + share if several.any() else _SHARE_WITHOUT_RETURNS
        votes = np.count_nonzero(on, axis=1)
        plane = open_sky & (votes >= np.maximum(least * count, _LEAST_NODES))
        leaves = several[votes < _LEAVES * count]
        told = leaves.mean() if len(leaves) else 0.0
        evidence = votes / count - (_RETURNS * share / told if told > _LEAST_TOLD else 0.0)
        face = _face_of(neighbours, rise, on & plane[:, None])
        plane &= _means(evidence, face, plane) - _means(through, face, plane) >= _LEAST_EVIDENCE
        size = np.bincount(face[plane], minlength=len(places))[face]
        face = plane & (size >= max(_LEAST_NODES, self.area / max(_NODE, apart) ** 2))
        if face.any():
            far = max(_JOIN, _JOIN_SPACINGS * apart)
            grown, _ = cKDTree(places[face, :2]).query(places[:, :2], distance_upper_bound=far)
            face |= plane & np.isfinite(grown)
        votes = np.bincount(neighbours[on & face[:, None]], minlength=len(places))
        return rise, face, face | (votes >= _VOTES)


def _face_of(neighbours: np.ndarray, rise: np.ndarray, on: np.ndarray) -> np.ndarray:
    """Return the number of the face of each node: neighbours on planes of nearly one slope."""
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    normal = np.column_stack([-rise[:, :2], np.ones(len(rise), dtype=np.float32)])
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    has_plane = np.count_nonzero(on, axis=1) > 0
    node, place = np.nonzero(on & has_plane[neighbours])
    neighbour = neighbours[node, place]
    even = (normal[node] * normal[neighbour]).sum(axis=1) >= math.cos(math.radians(_BEND))
    node, neighbour = node[even], neighbour[even]
    links = coo_matrix((np.ones(len(node), dtype=bool), (node, neighbour)), shape=(len(rise),) * 2)
    return connected_components(links, directed=False)[1]


def _means(values: np.ndarray, face: np.ndarray, where: np.ndarray) -> np.ndarray:
    """Return for each node the mean of its face over some nodes, without NaN; 0 of none."""
    where = where & np.isfinite(values)
    total = np.bincount(face[where], weights=values[where], minlength=len(face))
    return (total / np.maximum(np.bincount(face[where], minlength=len(face)), 1))[face]


def _seen_through(z: np.ndarray, high: np.ndarray, cells: Cells) -> np.ndarray:
    """Return the share of points under the nodes of each cell; NaN at edges, where walls are."""
    cell = cells.index[high]
    holding = _holding(cells, cell)
    lowest = np.full(holding.size, np.inf)
    np.minimum.at(lowest, cell, z[high])
    under = z < np.where(holding.ravel(), lowest - _DEPTH, -np.inf)[cells.index]
    found, count = (
        np.bincount(cells.index[selected], minlength=holding.size)
        for selected in (under, slice(None))
    )
    inner = erosion(closing(holding, _CLOSING).view(np.uint8), 1.0).view(bool).ravel()
    return np.where(inner, found / np.maximum(count, 1), np.nan)


def _holding(cells: Cells, index: np.ndarray) -> np.ndarray:
    """Return which cells are among those of an index; boolean, shape (rows, columns)."""
    holding = np.zeros(cells.shape, dtype=bool)
    holding.ravel()[index] = True
    return holding


def _belong(
    points: Points, nodes: np.ndarray, rise: np.ndarray, inside: np.ndarray, several: np.ndarray
) -> np.ndarray:
    """Return which points near roofs belong to them, given the nodes (n, 3) and their planes."""
    # Points belong to a roof if they lie on the plane of a near node, below it beside the roof, or
    # above it and of pulses with a single return, as on chimneys and not on branches.
    from scipy.spatial import cKDTree

    places = np.column_stack([points.x, points.y])
    compared = np.arange(1, min(_COMPARED, len(nodes)) + 1)
    distance, nearest = cKDTree(nodes[:, :2]).query(places, k=compared)
    steps, rise = places[:, None] - nodes[nearest][:, :, :2], rise[nearest]
    plane = nodes[nearest][:, :, 2] + rise[:, :, 2] + (steps * rise[:, :, :2]).sum(axis=2)
    off = points.z[:, None] - plane
    beside = distance[:, 0] <= _BESIDE
    on = (np.abs(off).min(axis=1) <= _ON) & (beside | inside)
    below = beside & (off.min(axis=1) < 0.0)
    above = inside & ~several & (off[:, 0] > 0.0) & (off[:, 0] <= _ABOVE)
    return on | below | above


def planes_through(
    places: np.ndarray,  # (n, 3) in metres
    neighbours: np.ndarray,  # (n, k), the nearest in the plane; the first is the point itself
    near: np.ndarray,  # bool (n, k), neighbours that count
    wanted: np.ndarray,  # bool (n,), points that get a plane
    tolerance: float,  # metres above or below a plane
    steepest: float,  # degrees
    progress: Progress = SILENT,
) -> tuple[np.ndarray, np.ndarray]:
    """Return the plane on which most neighbours of each point lie, slopes to east and north and
    height above the point, float32 (n, 3), and the neighbours on it, bool (n, k); without one, 0.
    """
    # A plane through all neighbours would not find a roof whose ridge is among them. So planes are
    # tried through the point and each two of its nearest neighbours. The one that most neighbours
    # lie on is fitted to these.
    rise = np.zeros((len(places), 3), dtype=np.float32)
    on = np.zeros(neighbours.shape, dtype=bool)
    asked, slope = np.flatnonzero(wanted), math.tan(math.radians(steepest))

    def fill(part: slice) -> None:
        indices = asked[part]
        steps = (places[neighbours[indices]] - places[indices][:, None]).astype(np.float32)
        rise[indices], on[indices] = _planes(steps, near[indices], tolerance, slope)

    over_parts(fill, len(asked), _POINTS_A_PART, progress)
    return rise, on


def _planes(
    steps: np.ndarray, near: np.ndarray, tolerance: float, slope: float
) -> tuple[np.ndarray, np.ndarray]:
    """Return planes and which neighbours lie on them, given the steps (m, k, 3) to these."""
    x, y, z = (np.ascontiguousarray(steps[:, :, axis].T) for axis in range(3))
    near, count = near.T, x.shape[1]
    best, east, north = np.zeros((3, count), dtype=np.float32)
    for first, second in itertools.combinations(range(1, min(_TRIED + 1, len(x))), 2):
        area = x[first] * y[second] - y[first] * x[second]
        lengths = np.hypot(x[first], y[first]) * np.hypot(x[second], y[second])
        wide = np.abs(area) > _LEAST_SINE * lengths
        area = np.where(wide, area, 1.0)
        to_east = (z[first] * y[second] - z[second] * y[first]) / area
        to_north = (x[first] * z[second] - x[second] * z[first]) / area
        off = np.abs(z - to_east * x - to_north * y)
        votes = np.count_nonzero((off <= tolerance) & near, axis=0).astype(np.float32)
        votes[~wide | ~near[first] | ~near[second] | (np.hypot(to_east, to_north) > slope)] = 0.0
        better = votes > best
        best[better] = votes[better]
        east[better], north[better] = to_east[better], to_north[better]
    on = (np.abs(z - east * x - north * y) <= tolerance) & near & (best > 0.0)
    east, north, level = _fitted(x, y, z, on, east, north)
    on &= np.abs(z - east * x - north * y - level) <= tolerance
    on &= on[0]  # a plane must hold its own point
    return np.column_stack([east, north, level]), on.T


def _fitted(
    x: np.ndarray, y: np.ndarray, z: np.ndarray, on: np.ndarray, east: np.ndarray, north: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return planes of least squares through points; with the slopes given if these are in line."""
    weight, count = on.astype(np.float64), np.maximum(on.sum(axis=0), 1)
    mean_x, mean_y, mean_z = ((weight * axis).sum(axis=0) / count for axis in (x, y, z))
    dx, dy, dz = x - mean_x, y - mean_y, z - mean_z
    xx, xy, yy = (
        (weight * first * second).sum(axis=0) for first, second in ((dx, dx), (dx, dy), (dy, dy))
    )
    xz, yz = ((weight * first * dz).sum(axis=0) for first in (dx, dy))
    solid = xx * yy - xy * xy > 1e-6 * (xx + yy) ** 2 + 1e-12
    slopes = plane_slopes(xx, xy, yy, xz, yz)
    east, north = (np.where(solid, *choices) for choices in zip(slopes, (east, north)))
    return east, north, mean_z - east * mean_x - north * mean_y
