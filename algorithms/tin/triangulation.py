"""Triangulated irregular network (TIN): the surface through points, as triangles."""

from __future__ import annotations

from typing import Iterable

import numpy as np

from ..core.threads import parts_of
from ..grids.cells import numbered

# Queries of one walk, so few that the arrays of a step stay in the processor's cache.
_QUERIES_A_STEP = 200_000
# Rounding: a query outside an edge still counts as on it if twice the area between them is below
# this, in m2.
_ON_EDGE = 1e-11
# Rounding: the centre of a cell outside an edge by less than this share of a cell counts as inside.
_ON_ROW = 1e-9
# Pairs of a triangle and a row of cells that are computed at a time.
_PAIRS = 1 << 18


class Tin:
    """A Delaunay triangulation of points in metres in any order, the lowest of those with the same
    x and y, with heights.
    """

    # `Delaunay.find_simplex` is not used: the transform it builds and its search from an arbitrary
    # triangle cost more than the triangulation. A walk over the neighbours from a vertex close to
    # the query is exact, because in a Delaunay triangulation a walk towards the query never returns
    # to a triangle (Devillers, Pion & Teillaud 2002, section 3).

    def __init__(self, x: np.ndarray, y: np.ndarray, z: np.ndarray) -> None:
        x, y, z = (np.asarray(values, dtype=np.float64) for values in (x, y, z))
        kept = lowest_of_duplicates(x, y, z)
        strip, self._strip_edges = _strips(x[kept])
        order = np.lexsort((x[kept], y[kept], strip))
        self.source = kept[order]  # intp (v,), index of each vertex in the input
        self.x, self.y, self.z = x[self.source], y[self.source], z[self.source]
        # Relative to the median, because Qhull and the walk lose digits in large coordinates.
        self._origin = (np.median(self.x), np.median(self.y)) if len(kept) else (0.0, 0.0)
        self._x, self._y = self.x - self._origin[0], self.y - self._origin[1]
        # int32 (t, 3): the vertices of each triangle, none if all are on one line, and the triangle
        # opposite to each vertex, -1 beyond the convex hull.
        self.triangles, self.neighbours = _triangulate(np.column_stack((self._x, self._y)))
        if len(self.triangles):
            self._y_range = float(self.y.min()), float(np.ptp(self.y))
            self._vertex_keys = self._keys(strip[order], self.y)
            self._triangle_of_vertex = _triangle_of_vertex(self.triangles, len(self.x))

    def locate(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Return the triangle in which each query (q,) in metres lies, int32 (q,), rows of
        `triangles`; -1 outside the convex hull.
        """
        x, y = np.asarray(x, dtype=np.float64), np.asarray(y, dtype=np.float64)
        found = np.full(len(x), -1, dtype=np.int32)
        if not len(self.triangles):
            return found
        for part in parts_of(len(x), _QUERIES_A_STEP):
            triangle = self._triangle_of_vertex[self._near(x[part], y[part])]
            found[part] = self._walk(x[part] - self._origin[0], y[part] - self._origin[1], triangle)
        return found

    def interpolate(
        self, x: np.ndarray, y: np.ndarray, triangle: np.ndarray | None = None
    ) -> np.ndarray:
        """Return the height of the surface at each query (q,), linear in each triangle, which
        `locate` may have found; NaN outside the convex hull.
        """
        x, y = np.asarray(x, dtype=np.float64), np.asarray(y, dtype=np.float64)
        if triangle is None:
            triangle = self.locate(x, y)
        height = np.full(len(x), np.nan)
        inside = np.flatnonzero(triangle >= 0)
        for part in parts_of(len(inside), _QUERIES_A_STEP):
            queries = inside[part]
            areas = self._opposite_areas(
                x[queries] - self._origin[0], y[queries] - self._origin[1], triangle[queries]
            )
            # A query on the hull may lie outside by rounding: it must not be extrapolated.
            weights = [np.maximum(area, 0.0) for area in areas]
            corners = self.z[self.triangles[triangle[queries]]]
            weighted = sum(weight * corners[:, k] for k, weight in enumerate(weights))
            total = weights[0] + weights[1] + weights[2]
            # A triangle without area (three vertices on one line) has no weights: take its mean.
            with np.errstate(invalid="ignore", divide="ignore"):
                height[queries] = np.where(total > 0.0, weighted / total, corners.mean(axis=1))
        return height

    def _near(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Return a vertex near each query: in the same strip of x, next in y."""
        strip = np.searchsorted(self._strip_edges, x, side="right")
        vertex = np.searchsorted(self._vertex_keys, self._keys(strip, y))
        return np.minimum(vertex, len(self.x) - 1)

    def _keys(self, strip: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Return numbers that sort first by strip and then by y."""
        lowest, extent = self._y_range
        return strip + np.clip((y - lowest) / max(extent, 1e-9), 0.0, 1.0) * 0.999999

    def _walk(self, x: np.ndarray, y: np.ndarray, triangle: np.ndarray) -> np.ndarray:
        """Walk from `triangle` (q,) towards queries (q,); return where it ends, -1 outside."""
        found = triangle.copy()
        moving = np.arange(len(x))
        # A walk visits no triangle twice, so it ends; the limit is for rounding at a vertex.
        for _ in range(len(self.triangles) + 1):
            areas = self._opposite_areas(x, y, triangle)
            worst = (areas[1] < areas[0]).astype(np.intp)
            lowest = np.minimum(areas[0], areas[1])
            worst[areas[2] < lowest] = 2
            go = np.flatnonzero(np.minimum(lowest, areas[2]) < -_ON_EDGE)
            triangle = self.neighbours[triangle[go], worst[go]]
            moving = moving[go]
            found[moving] = triangle
            go = go[triangle >= 0]
            moving, triangle = moving[triangle >= 0], triangle[triangle >= 0]
            x, y = x[go], y[go]
            if not len(moving):
                break
        return found

    def _opposite_areas(
        self, x: np.ndarray, y: np.ndarray, triangle: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return the `opposite_areas` of queries in triangles."""
        corners = self.triangles[triangle].T
        return opposite_areas([self._x[k] - x for k in corners], [self._y[k] - y for k in corners])


def opposite_areas(
    x: Iterable[np.ndarray], y: Iterable[np.ndarray]
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return twice the signed area between queries and the edge opposite to each of three corners
    (q,), relative to the queries.
    """
    # All three are >= 0 inside a triangle; over their sum they are the barycentric weights.
    (ax, bx, cx), (ay, by, cy) = x, y
    return bx * cy - by * cx, cx * ay - cy * ax, ax * by - ay * bx


def lost_triangles(
    x: np.ndarray, y: np.ndarray, new_x: np.ndarray, new_y: np.ndarray
) -> np.ndarray:
    """Return which Delaunay triangles, with corners (q, 3), disappear when vertices (n,), at least
    one, are added: one lies in their circumcircle or on it, bool (q,).
    """
    from scipy.spatial import cKDTree

    ux, uy, vx, vy = (axis[:, k] - axis[:, 0] for k in (1, 2) for axis in (x, y))
    u, v = ux**2 + uy**2, vx**2 + vy**2
    area = ux * vy - uy * vx
    area = np.copysign(np.maximum(np.abs(area), 1e-12), area)
    to_centre = np.column_stack((vy * u - uy * v, ux * v - vx * u)) / (2.0 * area[:, None])
    centre = np.column_stack((x[:, 0], y[:, 0])) + to_centre
    new = cKDTree(np.column_stack((new_x, new_y)))
    return new.query(centre)[0] <= np.hypot(*to_centre.T) * (1.0 + 1e-9) + 1e-6


def without_flat(tin: Tin, tolerance: float) -> tuple[np.ndarray, np.ndarray]:
    """Return triangles and neighbours of a TIN without triangles on the hull whose area, twice, is
    at most the squared longest edge times a tolerance.
    """
    x, y = tin.x[tin.triangles], tin.y[tin.triangles]
    ux, uy, vx, vy = (axis[:, k] - axis[:, 0] for k in (1, 2) for axis in (x, y))
    longest = np.maximum(np.maximum(ux**2 + uy**2, vx**2 + vy**2), (ux - vx) ** 2 + (uy - vy) ** 2)
    flat = ux * vy - uy * vx <= tolerance * longest
    kept, neighbours = np.ones(len(flat), dtype=bool), tin.neighbours.copy()
    while True:
        peeled = kept & flat & (neighbours < 0).any(axis=1)
        if not peeled.any():
            break
        kept &= ~peeled
        neighbours[(neighbours >= 0) & peeled[neighbours]] = -1
    number = np.where(kept, np.cumsum(kept) - 1, -1)
    neighbours = np.where(neighbours < 0, -1, number[neighbours])
    return tin.triangles[kept], neighbours[kept]


def lowest_of_duplicates(x: np.ndarray, y: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Return the indices (v,) of the lowest point at each place."""
    order = np.lexsort((z, y, x))
    first = np.ones(len(order), dtype=bool)
    first[1:] = (np.diff(x[order]) != 0) | (np.diff(y[order]) != 0)
    return order[first]


def _strips(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Divide vertices along x into strips of equal counts; return their strips and the borders."""
    # Quantiles, not equal widths: one stray point far away must not put all others into one strip.
    count = max(int(np.sqrt(len(x) / 2)), 1)
    edges = (
        np.sort(x)[(np.arange(1, count, dtype=np.int64) * len(x)) // count]
        if count > 1
        else np.empty(0)
    )
    return np.searchsorted(edges, x, side="right"), edges


def _triangulate(xy: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return triangles (t, 3), counterclockwise, and their neighbours (t, 3) of vertices (v, 2)."""
    from scipy.spatial import Delaunay

    nothing = np.empty((0, 3), dtype=np.int32), np.empty((0, 3), dtype=np.int32)
    if is_one_line(xy):
        return nothing
    mesh = Delaunay(xy)
    triangles = mesh.simplices.astype(np.int32)
    neighbours = mesh.neighbors.astype(np.int32)
    corners = xy[triangles]
    clockwise = _twice_area(corners[:, 0], corners[:, 1], corners[:, 2]) < 0.0
    for table in (triangles, neighbours):
        table[clockwise] = table[clockwise][:, [0, 2, 1]]
    return triangles, neighbours


def is_one_line(xy: np.ndarray) -> bool:
    """Return whether points (n, 2) span no triangle, so that Qhull would raise."""
    if len(xy) < 3:
        return True
    spread = np.linalg.eigvalsh(np.cov(xy.T))
    return bool(spread[0] <= 1e-12 * max(spread[1], 1e-12))


def hull_corners(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return the indices of the corners of the convex hull, or of the two ends of a line."""
    from scipy.spatial import ConvexHull

    xy = np.column_stack((x, y))
    if is_one_line(xy):
        return np.lexsort((y, x))[[0, -1]]
    return ConvexHull(xy).vertices


def _triangle_of_vertex(triangles: np.ndarray, count: int) -> np.ndarray:
    """Return a triangle at each vertex; a vertex that Qhull left out has that of the one before."""
    triangle = np.full(count, -1, dtype=np.int32)
    triangle[triangles.ravel()] = np.repeat(np.arange(len(triangles), dtype=np.int32), 3)
    known = np.flatnonzero(triangle >= 0)
    last_known = np.searchsorted(known, np.arange(count), side="right") - 1
    return triangle[known[np.maximum(last_known, 0)]]


def _twice_area(a: np.ndarray, b: np.ndarray, c: np.ndarray) -> np.ndarray:
    """Return twice the signed areas of triangles with corners (n, 2), counterclockwise positive."""
    return (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])


def triangles_of_cells(
    tin: Tin, corner: tuple[float, float], cell: float, shape: tuple[int, int]
) -> np.ndarray:
    """Return the triangle that holds the centre of each cell, int32 (rows, columns) from south,
    rows of `tin.triangles`; -1 for none, on an edge one of the two.
    """
    # The southwestern corner and the side of the cells are in metres.
    found = np.full(shape, -1, dtype=np.int32)
    # In cells, from the centre of the first cell.
    x, y = ((axis - start) / cell - 0.5 for axis, start in zip((tin.x, tin.y), corner))
    corners_y = y[tin.triangles]
    first = np.maximum(np.ceil(corners_y.min(axis=1) - _ON_ROW), 0).astype(np.int64)
    last = np.minimum(np.floor(corners_y.max(axis=1) + _ON_ROW), shape[0] - 1).astype(np.int64)
    crossing = np.flatnonzero(first <= last)
    counts = last[crossing] - first[crossing] + 1
    for part in _parts(counts):
        triangle = np.repeat(crossing[part], counts[part])
        row = first[triangle] + numbered(counts[part])
        west, east = _crossed(x, y, tin.triangles[triangle], row)
        left = np.maximum(np.ceil(west - _ON_ROW), 0).astype(np.int64)
        right = np.minimum(np.floor(east + _ON_ROW), shape[1] - 1).astype(np.int64)
        across = np.maximum(right - left + 1, 0)
        place = np.repeat(row * shape[1] + left, across) + numbered(across)
        found.ravel()[place] = np.repeat(triangle, across)
    return found


def _crossed(
    x: np.ndarray, y: np.ndarray, corners: np.ndarray, row: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return the smallest and the largest x of triangles (k, 3) on rows (k,)."""
    west, east = np.full(len(row), np.inf), np.full(len(row), -np.inf)
    for first, second in ((0, 1), (1, 2), (2, 0)):
        start_x, start_y = x[corners[:, first]], y[corners[:, first]]
        end_x, end_y = x[corners[:, second]], y[corners[:, second]]
        with np.errstate(divide="ignore", invalid="ignore"):
            share = np.where(end_y == start_y, 0.0, (row - start_y) / (end_y - start_y))
        meets = (share >= -_ON_ROW) & (share <= 1.0 + _ON_ROW)
        # An edge parallel to the row counts if it lies on the row.
        meets &= (end_y != start_y) | (np.abs(row - start_y) <= _ON_ROW)
        meeting = start_x + np.clip(share, 0.0, 1.0) * (end_x - start_x)
        np.minimum(west, meeting, out=west, where=meets)
        np.maximum(east, meeting, out=east, where=meets)
    # If no edge meets the row because of rounding, no cell is inside.
    none = west > east
    west[none], east[none] = 0.0, -1.0
    return west, east


def _parts(counts: np.ndarray) -> list[slice]:
    """Divide triangles into parts with about equally many pairs of triangle and row."""
    if not len(counts):
        return []
    part = np.cumsum(counts) // _PAIRS
    starts = np.flatnonzero(np.diff(part, prepend=-1))
    return [slice(a, b) for a, b in zip(starts, [*starts[1:], len(counts)])]
