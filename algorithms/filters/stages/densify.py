"""Progressive densification of a TIN by points that lie close to its facets.

References
----------
Axelsson, P. (2000): DEM generation from laser scanner data using adaptive TIN models.
International Archives of Photogrammetry and Remote Sensing 33 (B4), section 3.
"""

from __future__ import annotations

import dataclasses
import itertools
import math
from dataclasses import dataclass
from typing import ClassVar, Iterator, NamedTuple

import numpy as np

from ...core.points import Points
from ...core.progress import Progress
from ...grids.cells import Cells
from ...grids.inpaint import inpaint
from ...grids.morphology import sum_of_nine, within_square
from ...tin.triangulation import Tin, lost_triangles
from ..pipeline import PointRule, Stage
from ..state import State
from ..triangles_round import WIDEST, CellVertices

_RING_SPACING = 5.0  # metres between the virtual points round the survey
# Largest distance of a candidate from a smooth surface through the seeds, in iteration distances.
# No facet comes close to points farther away.
_REACHABLE = 3.0
# Largest number of vertices in the 3 x 3 cells round a candidate. With more, its triangle is too
# small to take a point.
_MOST_VERTICES_ROUND = 4
# Most rounds. Candidates whose triangle did not change are not tested again, so that rounds in one
# place do not depend on how many there are in another.
_MOST_ROUNDS = 8


@dataclass(frozen=True)
class Densification(PointRule):
    """A candidate whose distance and angle to its facet of the TIN are small is ground."""

    # Axelsson (2000), section 3. In each round, every facet takes the nearest of these points as a
    # vertex. Distances are in metres, angles in degrees.

    stage: ClassVar = Stage.SURFACE
    writes: ClassVar = ("seeds", "candidates")

    # Largest angle between the facet and the line from one of its corners to the point.
    iteration_angle: float = 15.0
    iteration_distance: float = 1.4  # largest distance from the facet
    # Largest slope of a facet. On steeper ones, the mirror image of the point beyond the nearest
    # corner is tested in its place.
    max_terrain_angle: float = 88.0
    # Length of the longest edge below which the iteration angle is reduced in proportion; None for
    # no reduction.
    reduce_angle_edge: float | None = 5.0
    # Least length of the longest edge of a triangle that takes a point; None for no limit.
    stop_edge: float | None = 2.0
    noise_distance: float = 0.3  # distance from the facet up to which any angle is allowed
    # Largest distance from the facet in clouds from images, whose walls are slopes that the TIN
    # would climb; None for the same as in other clouds.
    in_images: float | None = 0.5
    # Largest difference in height from one of the eight cells round a candidate, beyond the rise of
    # the surface: ground continues, but bushes below trees have points at any height. None for any.
    level: float | None = 0.3
    # Whether points under trees are candidates as well: the TIN climbs plants, one after the other.
    in_woods: bool = False

    def apply(self, state: State) -> None:
        """Let candidates join the seeds."""
        if self.in_images is not None and state.from_images:
            nearest = min(self.in_images, self.iteration_distance)
            dataclasses.replace(self, iteration_distance=nearest, in_images=None).apply(state)
            return
        points, cells, candidates = state.points, state.grids[0].cells, state.candidates
        if not self.in_woods:
            candidates = candidates[~state.grids[0].woods.ravel()[cells.index[candidates]]]
        heights = cells.minimum(points.z, state.seeds)
        surface, holding = inpaint(heights, first=cells.first), np.isfinite(heights)
        vertices_round = sum_of_nine(np.pad(holding.astype(np.int8), 1))
        may_join = vertices_round <= _MOST_VERTICES_ROUND
        if self.level is not None:
            above = with_lower(heights, cells, points, candidates) - surface
            may_join &= _has_level_neighbour(above, self.level) | (
                np.abs(above) <= self.noise_distance
            )
        candidates = candidates[may_join.ravel()[cells.index[candidates]]]
        tested = points.take(candidates)
        distance = np.abs(tested.z - cells.interpolated(surface, tested.x, tested.y))
        slope = _steepness_at(cells, surface, tested)
        reachable = distance <= _REACHABLE * self.iteration_distance * np.hypot(1.0, slope)
        state.progress(0.1)
        reach = math.ceil(max(max(state.spacing, 1.0) / cells.size, 1.0))
        mesh = _Mesh(points, cells, _ring(cells, surface), reach)
        part = state.progress.part(0.1, 1.0)
        joined = _joined(mesh, state.seeds, candidates[reachable], self, part)
        state.seeds, state.candidates = np.append(state.seeds, joined), candidates[:0]


def with_lower(heights: np.ndarray, cells: Cells, points: Points, added: np.ndarray) -> np.ndarray:
    """Return a grid of lowest heights (NaN for none), lowered by further points."""
    lowest = heights.ravel().copy()
    np.fmin.at(lowest, cells.index[added], points.z[added])
    return lowest.reshape(heights.shape)


def _steepness_at(cells: Cells, surface: np.ndarray, points: Points) -> np.ndarray:
    """Return the steepness of a surface over cells at some points, rise over run."""
    step, (x, y, _) = cells.size, points
    north = cells.interpolated(surface, x, y + step) - cells.interpolated(surface, x, y - step)
    east = cells.interpolated(surface, x + step, y) - cells.interpolated(surface, x - step, y)
    return np.hypot(north, east) / (2.0 * step)


class _Mesh(NamedTuple):
    """What the TIN of each round is made of."""

    points: Points
    cells: Cells
    ring: Points  # virtual vertices round all cells
    reach: int  # largest distance in cells of neighbouring vertices outside of gaps

    def triangles(self, vertices: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Return the corners of the triangles that hold places, intp (q, 3), ascending: indices of
        points, and after the last one those of the ring; -1 outside of the TIN.
        """
        row, column = (
            np.clip(np.floor(places / self.cells.size).astype(np.intp) - first, 0, count - 1)
            for places, first, count in zip((y, x), self.cells.first, self.cells.shape)
        )
        asked = np.zeros(self.cells.shape, dtype=bool)
        asked[row, column] = True
        near = within_square(np.maximum, asked, WIDEST).ravel()
        near = vertices[near[self.cells.index[vertices]]]
        corners = CellVertices(self.points, near, self.cells).triangles(x, y)
        left = np.flatnonzero(corners[:, 0] < 0)
        if len(left):
            asked[:] = False
            asked[row[left], column[left]] = True
            needed = _bounding(self.cells.holding(vertices), asked, self.reach).ravel()
            bounding = vertices[needed[self.cells.index[vertices]]]
            tin = Tin(*self.points.take(bounding).and_also(self.ring))
            names = np.append(bounding, self.points.count + np.arange(self.ring.count))
            triangle = tin.locate(x[left], y[left])
            left, triangle = left[triangle >= 0], triangle[triangle >= 0]
            corners[left] = np.sort(names[tin.source[tin.triangles[triangle]]], axis=1)
        return corners

    def places(self, corners: np.ndarray) -> Iterator[np.ndarray]:
        """Yield x, y and z of corners."""
        of_ring = corners >= self.points.count
        for values, ring in zip(self.points, self.ring):
            places = values.take(np.where(of_ring, 0, corners))
            places[of_ring] = ring[corners[of_ring] - self.points.count]
            yield places


def _has_level_neighbour(above: np.ndarray, level: float) -> np.ndarray:
    """Return which cells have one of their eight neighbours within `level` metres in height."""
    rows, columns = above.shape
    padded = np.pad(above, 1, constant_values=np.nan)
    found = np.zeros(above.shape, dtype=bool)
    for row, column in itertools.product(range(3), repeat=2):
        if (row, column) != (1, 1):
            near = padded[row : row + rows, column : column + columns]
            found |= np.abs(near - above) <= level
    return found


def _ring(cells: Cells, surface: np.ndarray) -> Points:
    """Return virtual points round all cells, at multiples of their spacing."""
    # Ground outside the hull of the seeds has a triangle only with these points.
    (south, north), (west, east) = (
        (first * cells.size, (first + count) * cells.size)
        for first, count in zip(cells.first, cells.shape)
    )
    x, y = _multiples(west, east), _multiples(south, north)
    ring_x = np.concatenate((x, x, np.full(len(y), west), np.full(len(y), east)))
    ring_y = np.concatenate((np.full(len(x), south), np.full(len(x), north), y, y))
    return Points(ring_x, ring_y, cells.interpolated(surface, ring_x, ring_y))


def _multiples(start: float, end: float) -> np.ndarray:
    """Return both ends of a line and the multiples of the ring's spacing between them."""
    first, last = math.ceil(start / _RING_SPACING), math.floor(end / _RING_SPACING)
    return np.unique(np.r_[start, np.arange(first, last + 1) * _RING_SPACING, end])


def _joined(
    mesh: _Mesh,
    first: np.ndarray,
    candidates: np.ndarray,
    rules: Densification,
    progress: Progress,
) -> np.ndarray:
    """Return the indices of the candidates that join the first vertices, round by round."""
    vertices = first
    for round_ in range(_MOST_ROUNDS):
        tested = mesh.points.take(candidates)
        corners = mesh.triangles(vertices, tested.x, tested.y)
        progress(1.0 - 0.5 ** (round_ + 0.5))  # each round has less to do than the one before
        inside = corners[:, 0] >= 0
        candidates, corners, tested = candidates[inside], corners[inside], tested.take(inside)
        new, mirrored = _round(mesh, vertices, corners, tested, rules)
        if not len(new):
            break
        vertices = np.concatenate((vertices, candidates[new]))
        # All other points lie in the same triangle as before, which did not take them.
        x, y, _ = mesh.places(corners)
        changed = mirrored | lost_triangles(x, y, tested.x[new], tested.y[new])
        changed[new] = False
        candidates = candidates[changed]
        progress(1.0 - 0.5 ** (round_ + 1.0))
    return vertices[len(first) :]


def _bounding(vertices: np.ndarray, candidates: np.ndarray, reach: int) -> np.ndarray:
    """Return the cells whose vertices may bound a triangle in which a candidate lies."""
    # A triangulation of these vertices has the same triangles near candidates as that of all. They
    # are the vertices near candidates, and those round the gaps in which candidates lie: areas of
    # cells farther than `reach` cells from all vertices.
    from scipy import ndimage

    gaps, count = ndimage.label(~within_square(np.maximum, vertices, reach), np.ones((3, 3)))
    near = within_square(np.maximum, candidates, reach + 1)
    wanted = np.zeros(count + 1, dtype=bool)
    wanted[gaps[near]] = True
    wanted[0] = False
    round_gaps = within_square(np.maximum, wanted[gaps], 3 * reach)
    return vertices & (within_square(np.maximum, candidates, 2 * reach) | round_gaps)


def _round(
    mesh: _Mesh,
    vertices: np.ndarray,
    corners: np.ndarray,
    points: Points,
    rules: Densification,
) -> tuple[np.ndarray, np.ndarray]:
    """Return which candidates become vertices, at most one in each triangle, and which of all were
    tested by their mirror image, since their triangle is too steep.
    """
    distance, angle, longest, mirrored = _distance_and_angle(mesh, vertices, corners, points, rules)
    allowed = np.full(len(corners), math.radians(rules.iteration_angle))
    if rules.reduce_angle_edge:
        allowed *= np.minimum(longest / rules.reduce_angle_edge, 1.0)
    fits = (distance <= rules.noise_distance) | (
        (distance <= rules.iteration_distance) & (angle <= allowed)
    )
    if rules.stop_edge:
        fits &= longest >= rules.stop_edge
    fitting = np.flatnonzero(fits)
    order = np.lexsort(
        (points.y[fitting], points.x[fitting], distance[fitting], *corners[fitting].T)
    )
    fitting = fitting[order]
    first = np.ones(len(fitting), dtype=bool)
    first[1:] = (np.diff(corners[fitting], axis=0) != 0).any(axis=1)
    return fitting[first], mirrored


def _distance_and_angle(
    mesh: _Mesh,
    vertices: np.ndarray,
    corners: np.ndarray,
    points: Points,
    rules: Densification,
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Return for each candidate the distance from its facet, the largest angle at the corners in
    radians, the longest edge, and whether its mirror image was tested.
    """
    x, y, z = mesh.places(corners)
    normal, longest = _facets(x, y, z)
    steep = np.arctan(np.hypot(normal[0], normal[1])) > math.radians(rules.max_terrain_angle)
    px, py, pz = points.x.copy(), points.y.copy(), points.z
    if steep.any():
        nearest = np.argmin((x - px[:, None]) ** 2 + (y - py[:, None]) ** 2, axis=1)
        mirrored = np.flatnonzero(steep)
        px[mirrored] = 2 * x[mirrored, nearest[mirrored]] - px[mirrored]
        py[mirrored] = 2 * y[mirrored, nearest[mirrored]] - py[mirrored]
        beyond = mesh.triangles(vertices, px[mirrored], py[mirrored])
        inside = beyond[:, 0] >= 0
        corners = corners.copy()
        corners[mirrored[inside]] = beyond[inside]
        x, y, z = mesh.places(corners)
        normal, _ = _facets(x, y, z)
    height = pz - (z[:, 0] + normal[0] * (px - x[:, 0]) + normal[1] * (py - y[:, 0]))
    distance = np.abs(height) / np.sqrt(1.0 + normal[0] ** 2 + normal[1] ** 2)
    reach = np.sqrt((x - px[:, None]) ** 2 + (y - py[:, None]) ** 2 + (z - pz[:, None]) ** 2).min(
        axis=1
    )
    angle = np.arcsin(np.clip(distance / np.maximum(reach, 1e-9), 0.0, 1.0))
    return distance, angle, longest, steep


def _facets(
    x: np.ndarray, y: np.ndarray, z: np.ndarray
) -> tuple[tuple[np.ndarray, np.ndarray], np.ndarray]:
    """Return the gradient of each facet, in x and y, and its longest edge in the plane."""
    ux, uy, uz = x[:, 1] - x[:, 0], y[:, 1] - y[:, 0], z[:, 1] - z[:, 0]
    vx, vy, vz = x[:, 2] - x[:, 0], y[:, 2] - y[:, 0], z[:, 2] - z[:, 0]
    area = ux * vy - uy * vx
    area = np.copysign(np.maximum(np.abs(area), 1e-12), area)
    gradient = (uz * vy - uy * vz) / area, (ux * vz - uz * vx) / area
    edges = ux**2 + uy**2, vx**2 + vy**2, (vx - ux) ** 2 + (vy - uy) ** 2
    return gradient, np.sqrt(np.maximum.reduce(edges))
