"""Heights on the TIN of so many points that one triangulation of them all would be too much."""

from __future__ import annotations

import threading
from typing import Iterator, NamedTuple

import numpy as np

from ..core.points import Points
from ..core.progress import SILENT, Progress
from ..core.threads import over_parts
from .tin import Tin, is_one_line, lowest_of_duplicates
from .tin_cells import triangles_of_cells

# Few enough that all threads have work, and a cancel need not wait.
_VERTICES_A_BLOCK = 40_000
# Vertices round a block that are triangulated with it, as a share of its longer side, and by what
# that grows where they do not suffice.
_MARGIN, _GROWTH = 0.1, 4.0
# Share of the vertices in a window from which on all of them are triangulated, once.
_NEARLY_ALL = 0.4
# Metres from the hull within which a query may be outside by rounding.
_ON_HULL = 1e-6
# Share of its radius by which a vertex may lie inside a circle and count as on it: rounding.
_ON_CIRCLE = 1e-9
# Cells over which the queries of a block may spread, as a multiple of these, so that going through
# all of the cells is faster than looking for each query.
_MOST_CELLS = 30.0


class CellLattice(NamedTuple):
    """Cells at whose centres queries lie.

    Attributes
    ----------
    anchor : tuple of float
        x and y of a corner of cells in metres.
    size : float
        Side of a cell in metres.
    """

    anchor: tuple[float, float]
    size: float


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
        self._lock = threading.Lock()
        self._tree_of_all = self._border_of_all = self._tin_of_all = None

    def heights(
        self,
        x: np.ndarray,
        y: np.ndarray,
        max_edge: float | None = None,
        progress: Progress = SILENT,
        cells: CellLattice | None = None,
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
        cells : CellLattice, optional
            The cells at whose centres the queries lie, if they do: they are found faster then.

        Returns
        -------
        numpy.ndarray of float64, shape (q,)
            Heights in metres; NaN outside the convex hull and in gaps.
        """
        heights = np.full(len(x), np.nan)
        if is_one_line(np.column_stack(self._vertices[:2])):
            return heights
        blocks = list(self._blocks(x, y))

        def fill(number: slice) -> None:
            queries, size = blocks[number.start]
            heights[queries] = self._block_heights(x[queries], y[queries], size, max_edge, cells)

        over_parts(fill, len(blocks), 1, progress)
        return heights

    def nearest(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Return the height of the vertex nearest to each query."""
        return self._vertices.z[self._tree.query(np.column_stack((x, y)))[1]]

    @property
    def _tree(self):
        # Not at the start of QGIS, which loads this module, and where scipy may be missing.
        from scipy.spatial import cKDTree

        with self._lock:
            if self._tree_of_all is None:
                # Not balanced: that takes longer than it saves.
                places = np.column_stack((self._vertices.x, self._vertices.y))
                self._tree_of_all = cKDTree(places, balanced_tree=False, compact_nodes=False)
            return self._tree_of_all

    @property
    def _hull(self) -> tuple[np.ndarray, np.ndarray]:
        """The lower and the upper border, each as x and y (2, k) from west to east."""
        from scipy.spatial import ConvexHull

        with self._lock:
            if self._border_of_all is None:
                xy = np.column_stack((self._vertices.x, self._vertices.y))
                corners = xy[ConvexHull(xy).vertices]
                self._border_of_all = _border(corners, 1.0), _border(corners, -1.0)
            return self._border_of_all

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
        self,
        x: np.ndarray,
        y: np.ndarray,
        size: float,
        max_edge: float | None,
        cells: CellLattice | None,
    ) -> np.ndarray:
        heights = np.full(len(x), np.nan)
        if self._vertices.count <= _VERTICES_A_BLOCK:
            tin = Tin(*self._vertices)
            triangle = _located(tin, x, y, cells)
            return tin.interpolate(x, y, _without_long(tin, triangle, max_edge))
        depth = self._depth(x, y)
        pending = np.flatnonzero(depth > -_ON_HULL)
        margin = max(_MARGIN * size, _ON_HULL)
        while len(pending):
            tin, is_all = self._window(x[pending], y[pending], margin)
            triangle = _located(tin, x[pending], y[pending], cells)
            sure = (triangle < 0) & (depth[pending] < _ON_HULL)
            sure |= is_all
            inside = np.flatnonzero(~sure & (triangle >= 0))
            borders = _borders(x[pending], y[pending], margin)
            sure[inside] = self._are_delaunay(tin, triangle[inside], borders)
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

    def _window(self, x: np.ndarray, y: np.ndarray, margin: float) -> tuple[Tin, bool]:
        """Return the TIN of the vertices round the queries, and whether these are all."""
        vertices = self._vertices
        west, south, east, north = _borders(x, y, margin)
        first, last = np.searchsorted(vertices.x, (west, east))
        strip = vertices.take(slice(first, last))
        window = strip.take((strip.y >= south) & (strip.y <= north))
        if window.count < _NEARLY_ALL * vertices.count:
            return Tin(*window), False
        with self._lock:  # the others wait for it
            if self._tin_of_all is None:
                self._tin_of_all = Tin(*vertices)
            return self._tin_of_all, True

    def _are_delaunay(
        self, tin: Tin, triangle: np.ndarray, window: tuple[float, ...]
    ) -> np.ndarray:
        """Return whether triangles of a block (k,) are such of the triangulation of all points."""
        used, back = np.unique(triangle, return_inverse=True)
        x, y, radius = _circumcircles(tin, used)
        west, south, east, north = window
        # All points of the window are vertices: in the circles there is none.
        delaunay = (x - radius > west) & (x + radius < east)
        delaunay &= (y - radius > south) & (y + radius < north)
        # Three vertices on one line have no circle; they only occur along the hull.
        is_circle = np.isfinite(x) & np.isfinite(y) & np.isfinite(radius)
        open_ = np.flatnonzero(is_circle & ~delaunay)
        delaunay |= ~is_circle
        if len(open_):
            nearest = self._tree.query(np.column_stack((x[open_], y[open_])))[0]
            delaunay[open_] = nearest >= radius[open_] * (1.0 - _ON_CIRCLE) - _ON_CIRCLE
        return delaunay[back]


def _borders(x: np.ndarray, y: np.ndarray, margin: float) -> tuple[float, float, float, float]:
    """Return the box round queries, and a margin."""
    return x.min() - margin, y.min() - margin, x.max() + margin, y.max() + margin


def _located(tin: Tin, x: np.ndarray, y: np.ndarray, cells: CellLattice | None) -> np.ndarray:
    """Return the triangle of each query, -1 for none."""
    if cells is None or not len(x) or not len(tin.triangles):
        return tin.locate(x, y)
    column, row = (
        np.floor((each - at) / cells.size).astype(np.int64)
        for each, at in zip((x, y), cells.anchor)
    )
    first_row, first_column = int(row.min()), int(column.min())
    shape = int(row.max()) - first_row + 1, int(column.max()) - first_column + 1
    if shape[0] * shape[1] > _MOST_CELLS * len(x):
        return tin.locate(x, y)
    corner = tuple(
        at + first * cells.size for at, first in zip(cells.anchor, (first_column, first_row))
    )
    return triangles_of_cells(tin, corner, cells.size, shape)[
        row - first_row, column - first_column
    ]


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
