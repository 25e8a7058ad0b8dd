"""A TIN to which many vertices are added at a time, without a new triangulation."""

from __future__ import annotations

from typing import Iterable

import numpy as np

from ..core.points import Points
from ..core.progress import SILENT
from ..core.threads import in_threads, over_parts, parts_of
from .triangulation import Tin, opposite_areas, without_flat

# Rounding error of a determinant, as a share of the sum of its terms.
_ROUNDING = 1e-12
# A point lies on an edge if twice the area of their triangle is at most this share of the squared
# length of the edge.
_ON_EDGE = 1e-10
# Rounding error: a query beyond an edge still counts as on it if twice the area of their triangle,
# in square metres, is less than this.
_OUTSIDE = 1e-11
# Most triangles that a query crosses in one call. A call for the unfinished ones is faster.
_STEPS = 6
# Edges whose arrays stay in the processor's cache.
_EDGES_A_PART = 1 << 15
# Most rounds of flips. Far fewer are enough, unless rounding makes the flips endless.
_MOST_STEPS = 1000
# Steps in a metre to which coordinates are rounded to compare four vertices on one circle.
_STEPS_A_METRE = 1e5


class GrowingTin:
    """A Delaunay triangulation to which vertices within its convex hull are added."""

    # A new vertex splits the triangle that holds it into three. Then edges are flipped until no
    # vertex lies in the circumcircle of a triangle (Lawson 1977). All splits, and all flips without
    # a common triangle, are done at once. If four vertices lie on one circle, the diagonal from the
    # westernmost is used, so that the triangles depend only on the vertices.
    # Half-edge `3 * t + k` is the side of triangle `t` opposite to its corner `k`.
    # The first vertices, in metres near the origin, must be at different places, not all on one
    # line, and include the corners of the convex hull of all points that are added later.

    def __init__(self, vertices: Points) -> None:
        tin = Tin(*vertices)
        self.vertices = vertices  # all so far, in the order in which they were added
        triangles, neighbours = without_flat(tin, _ON_EDGE)
        # int32 (3 * t,): the vertex opposite to each half-edge; those of a triangle run
        # counterclockwise.
        self.corners = tin.source[triangles].astype(np.int32).ravel()
        # int32 (3 * t,): the half-edge of the neighbouring triangle on the same edge; -1 on the
        # hull.
        self.twins = _twins(neighbours)
        self._moved = np.arange(len(self.corners), dtype=np.int32)
        self._flip(np.arange(len(self.corners)), np.zeros(self.count, dtype=bool))

    @property
    def count(self) -> int:
        """Number of triangles."""
        return len(self.corners) // 3

    def triangles_of_vertices(self) -> np.ndarray:
        """Return a triangle at each vertex, shape (v,)."""
        triangle = np.zeros(self.vertices.count, dtype=np.int32)
        triangle[self.corners] = np.arange(len(self.corners), dtype=np.int32) // 3
        return triangle

    def add(
        self, points: Points, triangle: np.ndarray, rank: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """Add vertices (n,), no two in one triangle; return which were added, bool (n,), and which
        triangles have changed, bool (t,).
        """
        # If one of two vertices in neighbouring triangles lies on the common edge, only the one
        # with the greater rank is added.
        edge, is_on_edge = self._nearest_edge(points, triangle)
        added = self._apart(triangle, edge, is_on_edge, rank)
        triangle, edge, is_on_edge = triangle[added], edge[added], is_on_edge[added]
        first = self.vertices.count
        self.vertices = self.vertices.and_also(points.take(added))
        on_hull = is_on_edge & (self.twins[edge] < 0)
        edges = self._split(triangle, edge, on_hull, np.arange(first, self.vertices.count))
        changed = np.zeros(self.count, dtype=bool)
        changed[edges // 3] = True
        self._flip(edges, changed)
        return added, changed

    def heights(self, x: np.ndarray, y: np.ndarray, triangle: np.ndarray) -> np.ndarray:
        """Return the heights at queries (q,) within the hull, NaN where to call again; `triangle`
        (q,), one near each query, is changed to the one that holds it, or to a nearer one.
        """
        heights = np.full(len(x), np.nan)
        moving, here = np.arange(len(x)), triangle
        for _ in range(_STEPS):
            corners = [self.corners.take(3 * here + k) for k in range(3)]
            areas = self._opposite_areas(x, y, corners)
            lowest = np.minimum(np.minimum(areas[0], areas[1]), areas[2])
            is_outside = lowest < -_OUTSIDE
            go = np.flatnonzero(is_outside)
            into = self._next_triangle(here[go], [values[go] for values in areas])
            is_outside[go[into < 0]] = False
            stay = np.flatnonzero(~is_outside)
            found = self._interpolated([e[stay] for e in corners], [e[stay] for e in areas])
            heights[moving[stay]], triangle[moving[stay]] = found, here[stay]
            go, here = go[into >= 0], into[into >= 0]
            if not len(go):
                return heights
            moving, x, y = moving[go], x[go], y[go]
        triangle[moving] = here
        return heights

    def ambiguous_edges(self) -> np.ndarray:
        """Return which half-edges (3 * t,) could as well be flipped, as their four vertices lie on
        one circle.
        """
        ambiguous = np.zeros(len(self.twins), dtype=bool)

        def look(part: slice) -> None:
            # Each edge is tested once, by one of its half-edges.
            edges = np.arange(part.start, part.stop)
            edges = edges[self.twins[part] > edges]
            _, equal, is_convex = self._circles(self._quadrangles(edges))
            edges = edges[equal[is_convex[equal]]]
            ambiguous[edges] = ambiguous[self.twins[edges]] = True

        over_parts(look, len(ambiguous), _EDGES_A_PART, SILENT)
        return ambiguous

    def flipped_heights(self, x: np.ndarray, y: np.ndarray, edges: np.ndarray) -> np.ndarray:
        """Return the heights (q,) that queries beside half-edges have if these are flipped."""
        p, b, c, q = self._quadrangles(edges)
        vertices = self.vertices
        to_x, to_y = vertices.x[q] - vertices.x[p], vertices.y[q] - vertices.y[p]
        is_left = to_x * (y - vertices.y[p]) - to_y * (x - vertices.x[p]) > 0.0
        corners = [p, np.where(is_left, q, b), np.where(is_left, c, q)]
        return self._interpolated(corners, self._opposite_areas(x, y, corners))

    def _opposite_areas(
        self, x: np.ndarray, y: np.ndarray, corners: list[np.ndarray]
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return the `opposite_areas` of places in triangles with some corners."""
        to_x, to_y = (
            [of.take(k) - place for k in corners] for of, place in zip(self.vertices, (x, y))
        )
        return opposite_areas(to_x, to_y)

    def _interpolated(self, corners: list[np.ndarray], areas: Iterable[np.ndarray]) -> np.ndarray:
        # By rounding, places may lie outside of their triangle, but heights are not extrapolated.
        weights = [np.maximum(area, 0.0) for area in areas]
        height = sum(
            weight * self.vertices.z.take(corner) for weight, corner in zip(weights, corners)
        )
        with np.errstate(divide="ignore", invalid="ignore"):
            return height / (weights[0] + weights[1] + weights[2])

    def _next_triangle(self, triangle: np.ndarray, areas: list[np.ndarray]) -> np.ndarray:
        """Return the neighbour of each triangle towards a place outside of it; -1 for none."""
        lowest = np.minimum(areas[0], areas[1])
        worst = np.where(areas[2] < lowest, 2, areas[1] < areas[0])
        twin = self.twins.take(3 * triangle + worst)
        into = twin // 3
        # At an edge on the hull, the place lies outside by rounding, or is beyond another edge as
        # well.
        hull = np.flatnonzero(twin < 0)
        for k in range(3):
            twin = self.twins[3 * triangle[hull] + k]
            inner = (twin >= 0) & (areas[k][hull] < -_OUTSIDE)
            into[hull[inner]] = twin[inner] // 3
        return into

    def _nearest_edge(self, points: Points, triangle: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the nearest half-edge of the triangle of each point, and if the point is on it."""
        corners = [self.corners[3 * triangle + k] for k in range(3)]
        areas = np.stack(self._opposite_areas(points.x, points.y, corners))
        x, y = (np.stack([values[corner] for corner in corners]) for values in self.vertices[:2])
        squared = (x - np.roll(x, -1, axis=0)) ** 2 + (y - np.roll(y, -1, axis=0)) ** 2
        # Row k is for the edge from corner k + 1 to k + 2, which is opposite to corner k.
        share = areas / np.roll(squared, -1, axis=0)
        nearest = share.argmin(axis=0)
        return 3 * triangle + nearest, share.min(axis=0) <= _ON_EDGE

    def _apart(
        self, triangle: np.ndarray, edge: np.ndarray, is_on_edge: np.ndarray, rank: np.ndarray
    ) -> np.ndarray:
        """Return which new vertices can be added at once; boolean, shape (n,)."""
        apart = np.ones(len(triangle), dtype=bool)
        number = np.full(self.count, -1, dtype=np.int64)
        number[triangle] = np.arange(len(triangle))
        on_edge = np.flatnonzero(is_on_edge & (self.twins[edge] >= 0))
        others = number[self.twins[edge[on_edge]] // 3]
        on_edge, others = on_edge[others >= 0], others[others >= 0]
        first = rank[on_edge] > rank[others]
        equal = rank[on_edge] == rank[others]
        first |= equal & (triangle[on_edge] < triangle[others])
        apart[np.where(first, others, on_edge)] = False
        return apart

    def _split(
        self, triangle: np.ndarray, edge: np.ndarray, on_hull: np.ndarray, vertex: np.ndarray
    ) -> np.ndarray:
        """Split triangles at vertices within them or on the hull; return the edges round them."""
        inner = np.flatnonzero(~on_hull)
        second = self.count + np.arange(len(triangle), dtype=np.int32)
        parts = np.stack((triangle, second, triangle))
        parts[2, inner] = second[-1] + 1 + np.arange(len(inner))
        # A triangle on the hull is split in two. Turn it so that its hull edge is opposite to
        # corner 0.
        turn = np.where(on_hull, edge % 3, 0)
        outer = np.stack([3 * triangle + (turn + k) % 3 for k in range(3)])
        old = self.corners[outer]
        added = 3 * (len(triangle) + len(inner))
        self.corners = np.append(self.corners, np.zeros(added, dtype=np.int32))
        self.twins = np.append(self.twins, np.full(added, -1, dtype=np.int32))
        self._moved = np.arange(len(self.corners), dtype=np.int32)
        for part in parts:
            for k in range(3):
                self.corners[3 * part + k] = old[k]
        self.corners[3 * parts[0, inner]] = vertex[inner]
        self.corners[3 * parts[1:] + [[1], [2]]] = vertex
        edges = 3 * parts + [[0], [1], [2]]
        self._move(outer.ravel(), edges.ravel())
        self._join(3 * parts[0, inner] + 1, 3 * parts[1, inner])
        self._join(3 * parts[0, inner] + 2, 3 * parts[2, inner])
        self._join(3 * parts[1] + 2, 3 * parts[2] + 1)
        return edges.ravel()

    def _move(self, before: np.ndarray, after: np.ndarray) -> None:
        """Renumber half-edges, also in their twins."""
        self._moved[before] = after
        twins = self.twins[before]
        twins = np.where(twins < 0, -1, self._moved[twins])
        self._moved[before] = before
        self.twins[after] = twins
        self.twins[twins[twins >= 0]] = after[twins >= 0]

    def _join(self, edges: np.ndarray, twins: np.ndarray) -> None:
        """Make half-edges twins."""
        self.twins[edges], self.twins[twins] = twins, edges

    def _flip(self, edges: np.ndarray, changed: np.ndarray) -> None:
        """Flip half-edges, and those round them, until no circumcircle holds a vertex; set
        triangles with a flipped edge in `changed` (t,).
        """
        owner = np.zeros(self.count, dtype=np.int64)
        for _ in range(_MOST_STEPS):
            parts = [edges[part] for part in parts_of(len(edges), _EDGES_A_PART)]
            wrong = in_threads(self._are_wrong, parts)
            edges = np.concatenate([part[mask] for part, mask in zip(parts, wrong)] or [edges])
            if not len(edges):
                return
            # A triangle takes part in one flip at a time: the last one that is stored for it.
            pair = np.column_stack((edges, self.twins[edges])) // 3
            numbers = np.arange(len(edges))
            owner[pair.ravel()] = np.repeat(numbers, 2)
            now = (owner[pair] == numbers[:, None]).all(axis=1)
            edges = self._flipped(edges[now], edges[~now])
            changed[pair[now].ravel()] = True

    def _flipped(self, edges: np.ndarray, later: np.ndarray) -> np.ndarray:
        """Flip half-edges, no two in the same triangle, and return the edges to check next, with
        those of `later` by their new numbers.
        """
        t, k = np.divmod(edges, 3)
        u, j = np.divmod(self.twins[edges], 3)
        p, q = self.corners[edges], self.corners[3 * u + j]
        sides = [3 * t + (k + 1) % 3, 3 * t + (k + 2) % 3, 3 * u + (j + 1) % 3, 3 * u + (j + 2) % 3]
        b, c = self.corners[sides[0]], self.corners[sides[1]]
        before = np.concatenate(sides)
        after = np.concatenate((3 * u, 3 * t + 2, 3 * t, 3 * u + 2))
        self._moved[before] = after
        later = self._moved[later]
        self._move(before, after)
        for side, (corner, opposite) in enumerate(((p, q), (b, c), (q, p))):
            self.corners[3 * t + side], self.corners[3 * u + side] = corner, opposite
        self._join(3 * t + 1, 3 * u + 1)
        return np.concatenate((after, later))

    def _are_wrong(self, edges: np.ndarray) -> np.ndarray:
        """Return which half-edges (n,) are to be flipped."""
        wrong = self.twins[edges] >= 0
        corners = self._quadrangles(edges[wrong])
        inside, equal, is_convex = self._circles(corners)
        x, y = (np.rint(axis[corners[:, equal]] * _STEPS_A_METRE) for axis in self.vertices[:2])
        westernmost = np.lexsort((y, x), axis=0)[0]
        inside[equal] = (westernmost == 0) | (westernmost == 3)
        wrong[wrong] = inside & is_convex
        return wrong

    def _circles(self, corners: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return whether the fourth corner (4, n) lies in the circle of the others, whether all
        four lie on one circle, and whether the other diagonal lies inside.
        """
        x, y = (values.take(corners) for values in self.vertices[:2])
        bx, by, cx, cy, qx, qy = (axis[k] - axis[0] for k in (1, 2, 3) for axis in (x, y))
        p_b_q, p_q_c = bx * qy - by * qx, qx * cy - qy * cx
        of_q = (qx * qx + qy * qy) * (bx * cy - by * cx)
        of_c, of_b = (cx * cx + cy * cy) * -p_b_q, (bx * bx + by * by) * -p_q_c
        total = of_q + of_c + of_b
        rounding = _ROUNDING * (np.abs(of_q) + np.abs(of_c) + np.abs(of_b))
        equal = np.flatnonzero(np.abs(total) <= rounding)
        return total < -rounding, equal, (p_b_q > 0.0) & (p_q_c > 0.0)

    def _quadrangles(self, edges: np.ndarray) -> np.ndarray:
        """Return the corners (4, n) of the two triangles at inner half-edges, which run from the
        second to the third; the first lies to their left, the fourth to their right.
        """
        t, k = np.divmod(edges, 3)
        sides = np.stack((edges, 3 * t + (k + 1) % 3, 3 * t + (k + 2) % 3, self.twins[edges]))
        return self.corners.take(sides)


def _twins(neighbours: np.ndarray) -> np.ndarray:
    """Return the twin of each half-edge from the neighbours (t, 3) of triangles."""
    number = np.arange(len(neighbours), dtype=np.int32)[:, None]
    twins = np.full(neighbours.shape, -1, dtype=np.int32)
    for k in range(3):
        back = neighbours[neighbours[:, k]] == number
        twins[:, k] = 3 * neighbours[:, k] + back.argmax(axis=1)
    twins[neighbours < 0] = -1
    return twins.ravel()
