"""Heights on the TIN of many points, which is triangulated block by block."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING, Iterator, NamedTuple

import numpy as np

from ..core.points import Points
from ..core.progress import SILENT, Progress
from ..core.threads import in_threads
from ..grids.cells import cells_at
from .delaunay_walk import circumcircles
from .triangulation import Tin, hull_corners, is_one_line, lowest_of_duplicates, triangles_of_cells

if TYPE_CHECKING:
    from scipy.spatial import cKDTree

# Most vertices of a block: so few that all threads have work, and that progress and cancel do not
# have to wait.
_VERTICES_A_BLOCK = 6_000
# Width of the margin that is triangulated with a block, as a share of the block's longer side.
_MARGIN = 0.03
# Most triangulations of the vertices round the queries that blocks leave. A few are enough, unless
# rounding makes the search endless.
_MOST_STEPS = 1000
_FIRST_STEPS = 10  # in these, vertices that were added for others go again
# Rounding error in metres of a query on the hull.
_ON_HULL = 1e-6
# Rounding: a vertex counts as on a circle if its power, squared metres, is less than this share of
# the radius times its distance from a corner. By its distance from the centre, nothing would be
# inside the wide circles of slivers along the hull.
_ON_CIRCLE = 1e-9
# Most cells for each query in the rectangle of a block's queries. With more, it is faster to locate
# each query than to go through all cells.
_MOST_CELLS = 500.0


class CellLattice(NamedTuple):
    """Cells at whose centres queries lie."""

    anchor: tuple[float, float]  # a corner of cells in metres
    size: float  # side of a cell in metres


class Surface:
    """The TIN of points, the lowest of those with the same x and y, triangulated block by block."""

    # The heights are those of the Delaunay triangulation of all points. A triangle of a block is
    # used only if its circumcircle holds no point of any block, because then it is a triangle of
    # that triangulation (if four points lie on a circle, either diagonal may be used). Queries in
    # other triangles, for example in a lake that a block cuts, are computed after all blocks: the
    # corners of these triangles are triangulated, and vertices in circles are added until there
    # are none.
    # If `meshed` is given, only these points, which include the corners of the convex hull, are
    # triangulated, and the triangles are checked against all points.

    def __init__(self, points: Points, meshed: np.ndarray | None = None) -> None:
        # Sorted by x.
        kept = lowest_of_duplicates(*points)
        self._vertices, self._meshed = points.take(kept), np.arange(len(kept))
        if meshed is not None:
            self._meshed = np.flatnonzero(meshed[kept])
        self._lock = threading.Lock()
        self._tree_of_all: cKDTree | None = None
        self._border_of_all: tuple[np.ndarray, np.ndarray, np.ndarray] | None = None

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
        # Queries outside are left out, because their walks would go along the whole hull.
        inside = np.flatnonzero(self._depth(x, y) > -_ON_HULL)
        if len(inside):
            heights[inside] = self._inside(x[inside], y[inside], max_edge, progress, cells)
        return heights

    def _inside(
        self,
        x: np.ndarray,
        y: np.ndarray,
        max_edge: float | None,
        progress: Progress,
        cells: CellLattice | None,
    ) -> np.ndarray:
        """Return the heights at queries inside the hull."""
        heights = np.full(len(x), np.nan)
        blocks = list(self._blocks(x, y))
        # A single block reports its own progress. Of several blocks, each is one step.
        within = progress if len(blocks) == 1 else SILENT

        def fill(block: tuple[np.ndarray, float]) -> tuple[np.ndarray, np.ndarray]:
            queries, size = block
            places = x[queries], y[queries]
            heights[queries], left, corners = self._block_heights(
                *places, size, max_edge, cells, within
            )
            return queries[left], corners

        found = in_threads(fill, blocks, progress)
        left, corners = (np.concatenate(parts) for parts in zip(*found))
        if len(left):
            heights[left] = self._refined(x[left], y[left], corners, max_edge, cells)
        return heights

    def nearest(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Return the height of the vertex nearest to each query."""
        return self._vertices.z[self._tree.query(np.column_stack((x, y)))[1]]

    @property
    def _tree(self) -> cKDTree:
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
                corners = hull_corners(x, y)
                lower, upper = (_border(x[corners], y[corners], sign) for sign in (1.0, -1.0))
                self._border_of_all = lower, upper, corners
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
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return the heights of the queries of a block on a TIN of the vertices in and round it,
        the queries without a certain height (k,), and the vertices (n,) of their triangles.
        """
        # A height is not certain if a vertex lies in the circle of its triangle, or there is none.
        vertices, margin = self._vertices, max(_MARGIN * size, _ON_HULL)
        are_all = len(self._meshed) == vertices.count
        borders = x.min() - margin, y.min() - margin, x.max() + margin, y.max() + margin
        is_one_block = len(self._meshed) <= _VERTICES_A_BLOCK
        meshed = self._meshed if is_one_block else self._within(borders)
        tin = Tin(*vertices.take(meshed))
        progress(0.4)
        triangle = _located(tin, x, y, cells)
        progress(0.6)
        is_left = (triangle < 0) & (not is_one_block)
        if not (is_one_block and are_all):
            inside = np.flatnonzero(triangle >= 0)
            in_circle = self._in_circles(tin, triangle[inside], borders if are_all else None)
            is_left[inside] = in_circle >= 0
        progress(0.8)
        heights = tin.interpolate(x, y, _without_long(tin, triangle, max_edge))
        left = np.flatnonzero(is_left)
        used = np.unique(triangle[left])
        corners = np.unique(tin.triangles[used[used >= 0]])
        return heights, left, meshed[tin.source[corners]]

    def _refined(
        self,
        x: np.ndarray,
        y: np.ndarray,
        vertices: np.ndarray,
        max_edge: float | None,
        cells: CellLattice | None,
    ) -> np.ndarray:
        """Return heights at queries, on a TIN of `vertices` to which others are added as needed."""
        # The time depends on the number of triangles that hold queries, not on that of the queries.
        # A lake has many more cells than vertices on its shore.
        heights, active = np.full(len(x), np.nan), np.arange(len(x))
        used, hull = np.union1d(vertices, self._hull[2]), self._hull[2]
        for step in range(_MOST_STEPS):
            tin, places = Tin(*self._vertices.take(used)), (x[active], y[active])
            triangle = _located(tin, *places, cells)
            heights[active] = tin.interpolate(*places, _without_long(tin, triangle, max_edge))
            active, triangle = active[triangle >= 0], triangle[triangle >= 0]
            in_circle = self._in_circles(tin, triangle)
            # Rounding may put a vertex that the TIN has into one of its circles.
            is_new = (in_circle >= 0) & ~np.isin(in_circle, used)
            active = active[is_new]
            if not len(active):
                break
            corners = used[tin.source[np.unique(tin.triangles[triangle[is_new]])]]
            # Each new vertex lowers the paraboloid over its queries, so that the search ends even
            # if vertices that were added for other queries are removed. But a query on an edge can
            # alternate between the triangles beside it, so later they stay.
            stay = corners if step < _FIRST_STEPS else used
            used = np.unique(np.concatenate((stay, hull, in_circle[is_new])))
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
        inside = self._meshed[slice(*np.searchsorted(self._meshed, borders))]
        y = self._vertices.y[inside]
        return inside[(y >= south) & (y <= north)]

    def _in_circles(
        self, tin: Tin, triangle: np.ndarray, window: tuple[float, ...] | None = None
    ) -> np.ndarray:
        """Return the vertex in the circle of each triangle (k,) that is nearest to the centre, -1
        for none; if a window is given, `tin` must have all points in it.
        """
        # A triangle with an empty circle belongs to the triangulation of all points.
        used, back = np.unique(triangle, return_inverse=True)
        corners = tin.triangles[used].T
        # Relative to a corner, because large coordinates lose digits.
        corner = tin.x[corners[0]], tin.y[corners[0]]
        to_x, to_y, radius = circumcircles(tin.x[corners] - corner[0], tin.y[corners] - corner[1])
        x, y = corner[0] + to_x, corner[1] + to_y
        # Three vertices on one line have no circle; they only occur along the hull.
        is_open = np.isfinite(x) & np.isfinite(y) & np.isfinite(radius)
        if window is not None:
            west, south, east, north = window
            # Circles within the window hold no point.
            is_inside = (x - radius > west) & (x + radius < east)
            is_open &= ~(is_inside & (y - radius > south) & (y + radius < north))
        found, open_ = np.full(len(used), -1), np.flatnonzero(is_open)
        if len(open_):
            vertex = self._tree.query(np.column_stack((x[open_], y[open_])))[1]
            along, up = (
                axis.take(vertex) - start[open_] for axis, start in zip(self._vertices, corner)
            )
            power = along * (along - 2.0 * to_x[open_]) + up * (up - 2.0 * to_y[open_])
            is_in = power < -_ON_CIRCLE * radius[open_] * np.hypot(along, up)
            found[open_[is_in]] = vertex[is_in]
        return found[back]


def _located(tin: Tin, x: np.ndarray, y: np.ndarray, cells: CellLattice | None) -> np.ndarray:
    """Return the triangle of each query, -1 for none."""
    if cells is None or not len(x) or not len(tin.triangles):
        return tin.locate(x, y)
    row, column = cells_at(x, y, cells.size, cells.anchor)
    first_row, first_column = int(row.min()), int(column.min())
    shape = int(row.max()) - first_row + 1, int(column.max()) - first_column + 1
    if shape[0] * shape[1] > _MOST_CELLS * len(x):
        return tin.locate(x, y)
    west, south = (
        start + first * cells.size for start, first in zip(cells.anchor, (first_column, first_row))
    )
    triangles = triangles_of_cells(tin, (west, south), cells.size, shape)
    return triangles[row - first_row, column - first_column]


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
    for first, second in ((0, 1), (1, 2), (2, 0)):
        a, b = tin.triangles[:, first], tin.triangles[:, second]
        np.maximum(longest, np.hypot(tin.x[a] - tin.x[b], tin.y[a] - tin.y[b]), out=longest)
    return np.where((triangle >= 0) & (longest[triangle] <= max_edge), triangle, -1)
