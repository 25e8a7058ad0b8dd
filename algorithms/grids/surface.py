"""Heights on the TIN of many points, which is triangulated block by block."""

from __future__ import annotations

import threading
from typing import Iterator, NamedTuple

import numpy as np

from ..core.points import Points
from ..core.progress import SILENT, Progress
from ..core.threads import in_threads
from .cells import cells_at
from .delaunay_walk import circumcircles, interpolated, leaving_corner, longest_edge
from .tin import Tin, hull_corners, is_one_line, lowest_of_duplicates, triangles_of_cells

# Most vertices of a block: so few that all threads have work, and that progress and cancel do not
# have to wait.
_VERTICES_A_BLOCK = 6_000
# Width of the margin that is triangulated with a block, as a share of the block's longer side.
_MARGIN = 0.03
# Most exchanges of a corner for the queries that blocks leave. Few need more than thirty; rounding
# could make the search endless.
_MOST_STEPS = 1000
# Rounding error in metres of a query on the hull.
_ON_HULL = 1e-6
# Rounding: a vertex inside a circle by less than this share of the radius counts as on it.
_ON_CIRCLE = 1e-9
# Most cells for each query in the rectangle of a block's queries. With more, it is faster to locate
# each query than to go through all cells.
_MOST_CELLS = 500.0


class CellLattice(NamedTuple):
    """Cells at whose centres queries lie."""

    anchor: tuple[float, float]  # a corner of cells in metres
    size: float  # side of a cell in metres


class Surface:
    """The TIN of points in any order, the lowest of those with the same x and y, which is
    triangulated block by block.
    """

    # The heights are those of the Delaunay triangulation of all points. A triangle of a block is
    # used only if its circumcircle holds no point inside, of the block or not: then it is a
    # triangle of that triangulation (if four points lie on a circle, either diagonal may be used).
    # Queries in other triangles, for example in a lake that a block cuts, are left until all blocks
    # are done. Then corners of these triangles are exchanged for vertices in their circles, until
    # there are none.
    # If `meshed` is given, only these points are triangulated, which include the corners of the
    # convex hull, and the triangles are checked against all points.

    def __init__(self, points: Points, meshed: np.ndarray | None = None) -> None:
        # Sorted by x.
        kept = lowest_of_duplicates(*points)
        self._vertices, self._meshed = points.take(kept), np.arange(len(kept))
        if meshed is not None:
            self._meshed = np.flatnonzero(meshed[kept])
        self._lock = threading.Lock()
        self._tree_of_all = self._border_of_all = None

    def heights(
        self,
        x: np.ndarray,
        y: np.ndarray,
        max_edge: float | None = None,
        progress: Progress = SILENT,
        cells: CellLattice | None = None,  # queries at their centres are faster
    ) -> np.ndarray:
        """Return the height of the surface at queries (q,), float64 (q,), all in metres; NaN
        outside the convex hull and in triangles with an edge longer than `max_edge`.
        """
        heights = np.full(len(x), np.nan)
        if not len(x) or is_one_line(np.column_stack(self._vertices[:2])):
            return heights
        blocks = list(self._blocks(x, y))
        # A single block reports its own progress. Of several blocks, each is one step.
        within = progress if len(blocks) == 1 else SILENT

        def fill(block: tuple[np.ndarray, float]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
            queries, size = block
            some = x[queries], y[queries]
            heights[queries], left, *triangles = self._block_heights(
                *some, size, max_edge, cells, within
            )
            return (queries[left], *triangles)

        found = in_threads(fill, blocks, progress)
        left, number, triangles = zip(*found)
        if sum(map(len, left)):
            before = np.cumsum([0, *map(len, triangles)])
            number = np.concatenate([some + start for some, start in zip(number, before)])
            left, triangles = np.concatenate(left), np.concatenate(triangles)
            heights[left] = self._walked(x[left], y[left], triangles, number, max_edge)
        return heights

    def nearest(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Return the height of the vertex nearest to each query."""
        return self._vertices.z[self._tree.query(np.column_stack((x, y)))[1]]

    @property
    def _tree(self):
        from scipy.spatial import cKDTree

        with self._lock:
            if self._tree_of_all is None:
                # A balanced tree takes longer to build than it saves.
                places = np.column_stack((self._vertices.x, self._vertices.y))
                self._tree_of_all = cKDTree(places, balanced_tree=False, compact_nodes=False)
            return self._tree_of_all

    @property
    def _hull(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """The lower and the upper border of the hull, x and y (2, k) from west to east, and the
        indices of its corners, counterclockwise.
        """
        with self._lock:
            if self._border_of_all is None:
                x, y, _ = self._vertices
                which = hull_corners(x, y)
                borders = (_border(x[which], y[which], sign) for sign in (1.0, -1.0))
                self._border_of_all = (*borders, which)
            return self._border_of_all

    def _blocks(self, x: np.ndarray, y: np.ndarray) -> Iterator[tuple[np.ndarray, float]]:
        """Yield the indices of the queries in each block, and the longer side of its vertices."""
        # Blocks are halved by the number of their vertices until these are few enough, so that a
        # stray vertex far away makes no difference.
        vertices = self._vertices
        waiting = [(self._meshed, np.arange(len(x)))]
        while waiting:
            inside, queries = waiting.pop()
            if not len(queries):
                continue
            sides = [
                np.ptp(axis_places[inside]) if len(inside) else 0.0 for axis_places in vertices[:2]
            ]
            axis = int(sides[1] > sides[0])
            if len(inside) <= _VERTICES_A_BLOCK:
                yield queries, float(sides[axis])
                continue
            cut = np.median(vertices[axis][inside])
            for side in (np.greater_equal, np.less):
                places = (x, y)[axis][queries]
                waiting.append(
                    (inside[side(vertices[axis][inside], cut)], queries[side(places, cut)])
                )

    def _block_heights(
        self,
        x: np.ndarray,
        y: np.ndarray,
        size: float,
        max_edge: float | None,
        cells: CellLattice | None,
        progress: Progress,
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Return the heights of the queries of a block, on a TIN of the vertices round it, which
        queries are left (k,), and the number (k,) of their triangles (t, 3), -1 for none.
        """
        # A query is left if a vertex lies in the circle of its triangle, or it has none.
        vertices, margin = self._vertices, max(_MARGIN * size, _ON_HULL)
        are_all = len(self._meshed) == vertices.count
        borders = x.min() - margin, y.min() - margin, x.max() + margin, y.max() + margin
        is_one_block = len(self._meshed) <= _VERTICES_A_BLOCK
        which = self._meshed if is_one_block else self._within(borders)
        tin = Tin(*vertices.take(which))
        progress(0.4)
        triangle = _located(tin, x, y, cells)
        progress(0.6)
        is_left = np.zeros(len(x), dtype=bool)
        if not is_one_block:
            depth = self._depth(x, y)
            is_left = (triangle < 0) & (depth >= _ON_HULL)
            triangle[depth <= -_ON_HULL] = -1
        if not (is_one_block and are_all):
            inside = np.flatnonzero(triangle >= 0)
            used, number = np.unique(triangle[inside], return_inverse=True)
            triangles = which[tin.source[tin.triangles[used]]]
            in_circle = self._in_circles(triangles, borders if are_all else None)
            is_left[inside] = in_circle[number] >= 0
        progress(0.8)
        heights = tin.interpolate(x, y, _without_long(tin, triangle, max_edge))
        left = np.flatnonzero(is_left)
        used, number = np.unique(triangle[left], return_inverse=True)
        triangles = np.full((len(used), 3), -1)
        triangles[used >= 0] = which[tin.source[tin.triangles[used[used >= 0]]]]
        return heights, left, number, triangles

    def _walked(
        self,
        x: np.ndarray,
        y: np.ndarray,
        triangles: np.ndarray,
        number: np.ndarray,
        max_edge: float | None,
    ) -> np.ndarray:
        """Return heights at queries, from triangles (t, 3) that hold them, of which each has a
        number, after the corners were exchanged for vertices in their circles.
        """
        # All queries in a triangle meet the same vertex: a lake has many more cells than vertices
        # on its shore.
        vertices, hull = self._vertices, self._hull[2]
        nowhere = np.flatnonzero(triangles[number, 0] < 0)
        if len(nowhere):
            tin = Tin(*vertices.take(hull))
            triangle = tin.locate(x[nowhere], y[nowhere])
            number[nowhere[triangle >= 0]] = len(triangles) + triangle[triangle >= 0]
            triangles = np.concatenate((triangles, hull[tin.source[tin.triangles]]))
        heights, active = np.full(len(x), np.nan), np.flatnonzero(triangles[number, 0] >= 0)
        number = number[active]
        for step in range(_MOST_STEPS):
            used, number = np.unique(number, return_inverse=True)
            triangles = triangles[used]
            found = self._in_circles(triangles)
            # Rounding may put a corner into the circle.
            found[(found[:, None] == triangles).any(axis=1)] = -1
            new = found[number] if step + 1 < _MOST_STEPS else np.full(len(number), -1)
            places = [axis[active] for axis in (x, y)]
            a, b = (axis[triangles[number].T] - place for axis, place in zip(vertices[:2], places))
            ended, left = np.flatnonzero(new < 0), np.flatnonzero(new >= 0)
            z = vertices.z[triangles[number[ended]].T]
            heights[active[ended]] = interpolated(a[:, ended], b[:, ended], z)
            if max_edge is not None:
                long = longest_edge(a[:, ended], b[:, ended]) > max_edge
                heights[active[ended[long]]] = np.nan
            if not len(left):
                break
            beside = (axis[new[left]] - place[left] for axis, place in zip(vertices[:2], places))
            leaving = leaving_corner(a[:, left], b[:, left], *beside)
            active, number = active[left], 3 * number[left] + leaving
            # With the first, the second and the third corner exchanged.
            triangles = np.where(np.eye(3) > 0, found[:, None, None], triangles[:, None])
            triangles = triangles.reshape(-1, 3)
        return heights

    def _depth(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Return how far each query lies inside the hull, measured along y; negative outside."""
        lower, upper, _ = self._hull
        depth = np.minimum(y - np.interp(x, *lower), np.interp(x, *upper) - y)
        return np.minimum(depth, np.minimum(x - lower[0, 0], lower[0, -1] - x))

    def _within(self, box: tuple[float, float, float, float]) -> np.ndarray:
        """Return which of the vertices that are triangulated lie in a box."""
        west, south, east, north = box
        borders = np.searchsorted(self._vertices.x, (west, east))
        which = self._meshed[slice(*np.searchsorted(self._meshed, borders))]
        y = self._vertices.y[which]
        return which[(y >= south) & (y <= north)]

    def _in_circles(
        self, triangles: np.ndarray, window: tuple[float, ...] | None = None
    ) -> np.ndarray:
        """Return the vertex in the circle of each triangle (t, 3) that is nearest to its centre, -1
        where there is none; with a window, the triangles are those of all vertices in it.
        """
        # A triangle without one belongs to the triangulation of all points.
        corners, places = triangles.T, self._vertices[:2]
        # Relative to a corner, because large coordinates lose digits.
        x, y, radius = circumcircles(*(axis[corners] - axis[corners[0]] for axis in places))
        x, y = (centre + axis[corners[0]] for centre, axis in zip((x, y), places))
        # Three vertices on one line have no circle; they only occur along the hull.
        is_open = np.isfinite(x) & np.isfinite(y) & np.isfinite(radius)
        if window is not None:
            west, south, east, north = window
            # Circles within the window hold no point.
            is_inside = (x - radius > west) & (x + radius < east)
            is_open &= ~(is_inside & (y - radius > south) & (y + radius < north))
        found, open_ = np.full(len(triangles), -1), np.flatnonzero(is_open)
        if len(open_):
            nearest, vertex = self._tree.query(np.column_stack((x[open_], y[open_])))
            is_in = nearest < radius[open_] * (1.0 - _ON_CIRCLE) - _ON_CIRCLE
            found[open_[is_in]] = vertex[is_in]
        return found


def _located(tin: Tin, x: np.ndarray, y: np.ndarray, cells: CellLattice | None) -> np.ndarray:
    """Return the triangle of each query, -1 for none."""
    if cells is None or not len(x) or not len(tin.triangles):
        return tin.locate(x, y)
    row, column = cells_at(x, y, cells.size, cells.anchor)
    first_row, first_column = int(row.min()), int(column.min())
    shape = int(row.max()) - first_row + 1, int(column.max()) - first_column + 1
    if shape[0] * shape[1] > _MOST_CELLS * len(x):
        return tin.locate(x, y)
    corner = tuple(
        start + first * cells.size for start, first in zip(cells.anchor, (first_column, first_row))
    )
    return triangles_of_cells(tin, corner, cells.size, shape)[
        row - first_row, column - first_column
    ]


def _border(x: np.ndarray, y: np.ndarray, sign: float) -> np.ndarray:
    """Return the lower (sign 1) or upper (-1) border of a convex polygon, from west to east."""
    y = sign * y
    west, east = np.lexsort((y, x))[0], np.lexsort((y, -x))[0]
    across = (x[east] - x[west]) * (y - y[west]) - (y[east] - y[west]) * (x - x[west])
    chain = np.flatnonzero(across < 0.0)
    chain = np.concatenate(([west], chain[np.argsort(x[chain])], [east]))
    return np.stack((x[chain], sign * y[chain]))


def _without_long(tin: Tin, triangle: np.ndarray, max_edge: float | None) -> np.ndarray:
    """Return the triangles of queries, -1 for triangles with an edge longer than `max_edge`."""
    if max_edge is None or not len(tin.triangles):
        return triangle
    longest = np.zeros(len(tin.triangles))
    for one, two in ((0, 1), (1, 2), (2, 0)):
        a, b = tin.triangles[:, one], tin.triangles[:, two]
        np.maximum(longest, np.hypot(tin.x[a] - tin.x[b], tin.y[a] - tin.y[b]), out=longest)
    return np.where((triangle >= 0) & (longest[triangle] <= max_edge), triangle, -1)
