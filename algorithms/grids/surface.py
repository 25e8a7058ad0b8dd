"""Heights on the TIN of so many points that one triangulation of them all would be too much."""

from __future__ import annotations

from functools import cached_property
from typing import Iterator

import numpy as np

from ..core.points import Points
from ..core.progress import SILENT, Progress
from .tin import Tin, is_one_line, lowest_of_duplicates

# The time of a triangulation grows faster than its vertices, and with these it is a second or two.
_VERTICES_A_BLOCK = 250_000
# Vertices round a block that are triangulated with it, as a share of its longer side, and by what
# that grows where they do not suffice.
_MARGIN, _GROWTH = 0.05, 3.0
# Metres from the hull within which a query may be outside by rounding.
_ON_HULL = 1e-6
# Share of its radius by which a vertex may lie inside a circle and count as on it: rounding.
_ON_CIRCLE = 1e-9


class Surface:
    """The TIN of points, of which only blocks are triangulated at a time.

    The heights are those of the one Delaunay triangulation of all points. A triangle of a block is
    used only if no point, of the block or not, lies inside its circumcircle, which makes it a
    triangle of that one (where four points lie on a circle either diagonal may be taken). Where
    it is not, around lakes for example, the triangulation is repeated with a wider margin.

    Parameters
    ----------
    points : Points
        Vertices. Of those with the same x and y the lowest is kept; their order does not matter.
    """

    def __init__(self, points: Points) -> None:
        # Sorted by x.
        self._vertices = points.take(lowest_of_duplicates(*points))

    def heights(
        self,
        x: np.ndarray,
        y: np.ndarray,
        max_edge: float | None = None,
        progress: Progress = SILENT,
    ) -> np.ndarray:
        """Return the height of the surface at each query.

        Parameters
        ----------
        x, y : numpy.ndarray of float, shape (q,)
            Queries in metres.
        max_edge : float, optional
            Triangles with a longer edge, in metres, count as a gap.
        progress : Progress
            Receives progress.

        Returns
        -------
        numpy.ndarray of float64, shape (q,)
            Heights in metres; NaN outside the convex hull and in gaps.
        """
        heights = np.full(len(x), np.nan)
        if is_one_line(np.column_stack(self._vertices[:2])):
            return heights
        done = 0
        for queries, size in self._blocks(x, y):
            if len(queries):
                heights[queries] = self._block_heights(x[queries], y[queries], size, max_edge)
                done += len(queries)
            progress(done / max(len(x), 1))
        return heights

    def nearest(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Return the height of the vertex nearest to each query."""
        return self._vertices.z[self._tree.query(np.column_stack((x, y)))[1]]

    @cached_property
    def _tree(self):
        # Not at the start of QGIS, which loads this module, and where scipy may be missing.
        from scipy.spatial import cKDTree

        return cKDTree(np.column_stack((self._vertices.x, self._vertices.y)))

    @cached_property
    def _hull(self) -> tuple[np.ndarray, np.ndarray]:
        """The lower and the upper border, each as x and y (2, k) from west to east."""
        from scipy.spatial import ConvexHull

        xy = np.column_stack((self._vertices.x, self._vertices.y))
        corners = xy[ConvexHull(xy).vertices]
        return _border(corners, 1.0), _border(corners, -1.0)

    def _blocks(self, x: np.ndarray, y: np.ndarray) -> Iterator[tuple[np.ndarray, float]]:
        """Yield the indices of the queries in each block, and the longer side of its vertices.

        Blocks are halved until they have few enough vertices, wherever these lie: a stray vertex
        far away makes no difference.
        """
        vertices = self._vertices
        waiting = [(np.arange(vertices.count), np.arange(len(x)))]
        while waiting:
            inside, queries = waiting.pop()
            if not len(queries):
                yield queries, 0.0
                continue
            sides = [np.ptp(each[inside]) if len(inside) else 0.0 for each in vertices[:2]]
            axis = int(sides[1] > sides[0])
            if len(inside) <= _VERTICES_A_BLOCK:
                yield queries, float(sides[axis])
                continue
            cut = np.median(vertices[axis][inside])
            for side in (np.greater_equal, np.less):
                at = (x, y)[axis][queries]
                waiting.append((inside[side(vertices[axis][inside], cut)], queries[side(at, cut)]))

    def _block_heights(
        self, x: np.ndarray, y: np.ndarray, size: float, max_edge: float | None
    ) -> np.ndarray:
        heights = np.full(len(x), np.nan)
        if self._vertices.count <= _VERTICES_A_BLOCK:
            tin = Tin(*self._vertices)
            triangle = tin.locate(x, y)
            return tin.interpolate(x, y, _without_long(tin, triangle, max_edge))
        depth = self._depth(x, y)
        pending = np.flatnonzero(depth > -_ON_HULL)
        margin = max(_MARGIN * size, _ON_HULL)
        while len(pending):
            window, is_all = self._window(x[pending], y[pending], margin)
            tin = Tin(*window)
            triangle = tin.locate(x[pending], y[pending])
            sure = (triangle < 0) & (depth[pending] < _ON_HULL)
            sure |= is_all
            inside = np.flatnonzero(~sure & (triangle >= 0))
            sure[inside] = self._are_delaunay(tin, triangle[inside])
            triangle = _without_long(tin, triangle, max_edge)[sure]
            known = pending[sure]
            heights[known] = tin.interpolate(x[known], y[known], triangle)
            pending = pending[~sure]
            margin *= _GROWTH
        return heights

    def _depth(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Return how far each query lies inside the hull, measured along y; negative outside."""
        lower, upper = self._hull
        depth = np.minimum(y - np.interp(x, *lower), np.interp(x, *upper) - y)
        return np.minimum(depth, np.minimum(x - lower[0, 0], lower[0, -1] - x))

    def _window(self, x: np.ndarray, y: np.ndarray, margin: float) -> tuple[Points, bool]:
        """Return the vertices round the queries, and whether these are all that there are."""
        vertices = self._vertices
        first, last = np.searchsorted(vertices.x, (x.min() - margin, x.max() + margin))
        strip = vertices.take(slice(first, last))
        window = strip.take((strip.y >= y.min() - margin) & (strip.y <= y.max() + margin))
        return window, window.count == vertices.count

    def _are_delaunay(self, tin: Tin, triangle: np.ndarray) -> np.ndarray:
        """Return whether triangles of a block (k,) are such of the triangulation of all points."""
        used, back = np.unique(triangle, return_inverse=True)
        x, y, radius = _circumcircles(tin, used)
        delaunay = np.ones(len(used), dtype=bool)
        # Three vertices on one line have no circle; they only occur along the hull.
        known = np.flatnonzero(np.isfinite(x) & np.isfinite(y) & np.isfinite(radius))
        nearest = self._tree.query(np.column_stack((x[known], y[known])))[0]
        delaunay[known] = nearest >= radius[known] * (1.0 - _ON_CIRCLE) - _ON_CIRCLE
        return delaunay[back]


def _border(corners: np.ndarray, sign: float) -> np.ndarray:
    """Return the lower (sign 1) or upper (-1) border of a convex polygon, from west to east."""
    x, y = corners[:, 0], sign * corners[:, 1]
    west, east = np.lexsort((y, x))[0], np.lexsort((y, -x))[0]
    across = (x[east] - x[west]) * (y - y[west]) - (y[east] - y[west]) * (x - x[west])
    chain = np.flatnonzero(across < 0.0)
    chain = np.concatenate(([west], chain[np.argsort(x[chain])], [east]))
    return np.stack((x[chain], sign * y[chain]))


def _circumcircles(tin: Tin, which: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return x, y and radius of the circles through the corners of triangles."""
    a, b, c = tin.triangles[which].T
    # Relative to a corner, so that no digit is lost to the size of the coordinates.
    bx, by = tin.x[b] - tin.x[a], tin.y[b] - tin.y[a]
    cx, cy = tin.x[c] - tin.x[a], tin.y[c] - tin.y[a]
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        double = 2.0 * (bx * cy - by * cx)
        b2, c2 = bx**2 + by**2, cx**2 + cy**2
        x, y = (cy * b2 - by * c2) / double, (bx * c2 - cx * b2) / double
    return tin.x[a] + x, tin.y[a] + y, np.hypot(x, y)


def _without_long(tin: Tin, triangle: np.ndarray, max_edge: float | None) -> np.ndarray:
    """Return the triangles of queries, -1 for those that have an edge longer than `max_edge`."""
    if max_edge is None or not len(tin.triangles):
        return triangle
    longest = np.zeros(len(tin.triangles))
    for one, other in ((0, 1), (1, 2), (2, 0)):
        a, b = tin.triangles[:, one], tin.triangles[:, other]
        np.maximum(longest, np.hypot(tin.x[a] - tin.x[b], tin.y[a] - tin.y[b]), out=longest)
    return np.where((triangle >= 0) & (longest[triangle] <= max_edge), triangle, -1)
