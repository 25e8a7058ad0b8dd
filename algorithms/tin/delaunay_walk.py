"""The Delaunay triangle that holds a query, found among the few vertices near it.

There is no triangulation. A triangle that holds the query is changed, vertex by vertex, into the
one whose circumcircle holds no vertex. In the terms of the lifting to a paraboloid (Edelsbrunner &
Seidel 1986), this is the dual simplex method: it searches the plane below all lifted vertices that
is highest at the query.
"""

from __future__ import annotations

import numpy as np

from ..grids.cells import numbered
from .triangulation import opposite_areas

NOWHERE = 1e6  # x and y of a missing vertex
# Most exchanges of a vertex. Few triangles need more than ten, but with many vertices on one
# circle, rounding could make the search endless.
_MOST_STEPS = 60
# A vertex inside the circle by less than this share of the squared distances counts as on it.
_ON_CIRCLE = 1e-9
_NO_WEIGHT = 1e-12
# Added to the squared distance of a vertex in another quarter, so that it is never the nearest.
_FAR = 1e13


def enclosing_triangles(
    x: np.ndarray,  # (k, q), vertices near each query, relative to it; `NOWHERE` if missing
    y: np.ndarray,  # (k, q)
    window: np.ndarray,  # (4,) or (4, q), distances to its west, south, east, north border
    quarters: list[np.ndarray] | None = None,  # of the vertices SW, SE, NE and NW of it
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the corners of the Delaunay triangle that holds each query, intp (3, q), whether there
    is one, and whether it is certain, both bool (q,).
    """
    # All vertices in the window must be given. A triangle is certain if its circumcircle lies in
    # the window, because vertices beyond do not matter then.
    count = x.shape[1]
    corners, found = np.zeros((3, count), dtype=np.intp), np.zeros(count, dtype=bool)
    sure, window = found.copy(), np.broadcast_to(np.reshape(window, (4, -1)), (4, count))
    distance = x * x + y * y
    nearest, are_there = _nearest_of_quarters(x, y, distance, quarters)
    active = np.flatnonzero(are_there)
    if len(active) < count:
        x, y, distance, nearest = (
            values.take(active, axis=1) for values in (x, y, distance, nearest)
        )
    triangle = _first_triangle(x, y, nearest)
    for _ in range(_MOST_STEPS):
        a, b = picked(x, triangle), picked(y, triangle)
        slope_x, slope_y, level = _plane(a, b, picked(distance, triangle))
        above = distance - slope_x * x
        above -= slope_y * y
        lowest, worst = _lowest(above)
        goes_on = lowest - level < -_ON_CIRCLE * np.maximum(np.abs(level), 1.0)
        ended, left = np.flatnonzero(~goes_on), np.flatnonzero(goes_on)
        done = active[ended]
        corners[:, done], found[done] = triangle[:, ended], True
        sure[done] = _lies_within(
            slope_x[ended] / 2.0, slope_y[ended] / 2.0, level[ended], window[:, done]
        )
        if not len(left):
            break
        if len(ended):
            active, worst = active[left], worst[left]
            x, y, distance, triangle, a, b = (
                values.take(left, axis=1) for values in (x, y, distance, triangle, a, b)
            )
        leaving = leaving_corner(a, b, picked(x, worst), picked(y, worst))
        triangle[leaving, np.arange(len(left))] = worst
    return corners, found, sure


def listed(first: np.ndarray, count: np.ndarray) -> np.ndarray:
    """Return the numbers of runs, given by first and count (rows, q), in one column for each query,
    filled up with -1.
    """
    total = count.sum(axis=0)
    first, count = first.T.ravel(), count.T.ravel()
    listed = np.full((max(total.max(), 1), len(total)), -1)
    column = np.repeat(np.arange(len(total)), total)
    listed[numbered(total), column] = np.repeat(first, count) + numbered(count)
    return listed


def picked(values: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """Return the values in `rows`, shape (q,) or (n, q), of each column of values (k, q)."""
    return values.ravel().take(rows * values.shape[1] + np.arange(values.shape[1]))


def heights_of_four(
    x: np.ndarray, y: np.ndarray, z: np.ndarray, max_edge: float = np.inf
) -> tuple[np.ndarray, np.ndarray]:
    """Return heights (q,) on the triangulation of the four vertices round each query (southwest,
    southeast, northeast, northwest), NaN outside and in gaps, and which were found, bool (q,).
    """
    # In dense land, 99 of 100 heights are those of the triangulation of all vertices, and others
    # differ by some millimetres. x and y (4, q) are relative to the query. A height is found if all
    # four vertices are there and one of their triangles holds the query.
    # The edges from each vertex to the next one and to the one before:
    ahead_x, ahead_y = (np.roll(axis, -1, axis=0) - axis for axis in (x, y))
    behind_x, behind_y = -np.roll(ahead_x, 1, axis=0), -np.roll(ahead_y, 1, axis=0)
    dot = ahead_x * behind_x + ahead_y * behind_y
    cross = ahead_x * behind_y - ahead_y * behind_x
    # The diagonal from southwest to northeast is used if the angles at the other two vertices add
    # up to at most 180 degrees.
    is_first = cross[1] * dot[3] + dot[1] * cross[3] >= 0.0
    start = np.where(is_first, 0, 1)
    opposite, start_x, start_y = start + 2, picked(x, start), picked(y, start)
    along_x, along_y = picked(x, opposite) - start_x, picked(y, opposite) - start_y
    is_left = along_y * start_x - along_x * start_y > 0.0
    third = np.where(is_left, start + 3, start + 1) % 4
    corners = np.stack(
        (start, np.where(is_left, opposite, third), np.where(is_left, third, opposite))
    )
    a, b = picked(x, corners), picked(y, corners)
    weights = _opposite_areas(a, b)
    total = weights.sum(axis=0)
    found = (weights >= 0.0).all(axis=0) & (total > 0.0) & (np.abs(x).max(axis=0) < NOWHERE / 2.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        heights = (weights * picked(z, corners)).sum(axis=0) / total
    heights[~found | (longest_edge(a, b) > max_edge)] = np.nan
    return heights, found


def _nearest_of_quarters(
    x: np.ndarray, y: np.ndarray, distance: np.ndarray, quarters: list[np.ndarray] | None
) -> tuple[np.ndarray, np.ndarray]:
    """Return the nearest vertex of each quarter (4, q), and whether all quarters have one (q,)."""
    corners, are_there = np.empty((4, x.shape[1]), dtype=np.intp), np.ones(x.shape[1], dtype=bool)
    if quarters is None:
        # To add a large distance is ten times as fast as to select the vertices of a quarter.
        west, south = (np.multiply(axis >= 0.0, _FAR) for axis in (x, y))
        east, north = _FAR - west, _FAR - south
        beyond = ((west, south), (east, south), (east, north), (west, north))
    for number in range(4):
        if quarters is not None:
            quarter = quarters[number]
            nearest, row = _lowest(distance[quarter])
            corners[number] = quarter[row]
        else:
            nearest, corners[number] = _lowest(distance + beyond[number][0] + beyond[number][1])
        are_there &= nearest < NOWHERE
    return corners, are_there


def _lowest(values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the lowest value of each column (k, q), and its row; changes `values`."""
    # The last bits of the values hold the number of the row, because an argmin along columns takes
    # ten times as long as a minimum.
    mask = (1 << int(len(values) - 1).bit_length()) - 1
    bits = values.view(np.int64)
    bits &= ~mask
    bits |= np.arange(len(values))[:, None]
    lowest = values.min(axis=0)
    return lowest, lowest.view(np.int64) & mask


def _first_triangle(x: np.ndarray, y: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Return three of the four corners (one in each quarter) whose triangle holds the query."""
    west_x, west_y = picked(x, corners[0]), picked(y, corners[0])
    east_x, east_y = picked(x, corners[2]), picked(y, corners[2])
    is_left = (east_y - west_y) * west_x - (east_x - west_x) * west_y > 0.0
    return np.where(is_left, corners[[0, 2, 3]], corners[[0, 1, 2]])


def _plane(a: np.ndarray, b: np.ndarray, lifted: np.ndarray) -> tuple[np.ndarray, ...]:
    """Return the slopes of the plane through lifted corners (3, q), and its level at the query."""
    ux, uy, uw = a[1] - a[0], b[1] - b[0], lifted[1] - lifted[0]
    vx, vy, vw = a[2] - a[0], b[2] - b[0], lifted[2] - lifted[0]
    double_area = ux * vy - uy * vx
    with np.errstate(divide="ignore", invalid="ignore"):
        slope_x = (uw * vy - uy * vw) / double_area
        slope_y = (ux * vw - uw * vx) / double_area
    return slope_x, slope_y, lifted[0] - slope_x * a[0] - slope_y * b[0]


def circumcircles(a: np.ndarray, b: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return x, y and radius of the circles through corners at x `a` and y `b`, shape (3, q)."""
    bx, by, cx, cy = a[1] - a[0], b[1] - b[0], a[2] - a[0], b[2] - b[0]
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        double = 2.0 * (bx * cy - by * cx)
        b2, c2 = bx**2 + by**2, cx**2 + cy**2
        x, y = (cy * b2 - by * c2) / double, (bx * c2 - cx * b2) / double
        return a[0] + x, b[0] + y, np.hypot(x, y)


def interpolated(a: np.ndarray, b: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Return heights at queries in triangles with corners at `a`, `b` and `z` (3, q), relative to
    the query; NaN where the corners lie on one line.
    """
    weights = np.maximum(_opposite_areas(a, b), 0.0)
    with np.errstate(invalid="ignore"):
        return (weights * z).sum(axis=0) / weights.sum(axis=0)


def leaving_corner(a: np.ndarray, b: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return the corner that a new vertex (q,) replaces so that the triangle still holds the query,
    given the corners at `a` and `b` (3, q), relative to the query.
    """
    shares, weights = _opposite_areas(a - x, b - y), _opposite_areas(a, b)
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.where(shares > _NO_WEIGHT, np.maximum(weights, 0.0) / shares, np.inf)
    return ratio.argmin(axis=0)


def longest_edge(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Return the length of the longest edge of triangles with corners (3, q)."""
    next_a, next_b = np.roll(a, 1, axis=0), np.roll(b, 1, axis=0)
    return np.sqrt(((next_a - a) ** 2 + (next_b - b) ** 2).max(axis=0))


def _opposite_areas(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Return `opposite_areas` as an array, shape (3, q)."""
    return np.stack(opposite_areas(a, b))


def _lies_within(
    centre_x: np.ndarray, centre_y: np.ndarray, level: np.ndarray, window: np.ndarray
) -> np.ndarray:
    """Return whether circles, given by their centres and planes, lie in their windows."""
    radius = np.sqrt(np.maximum(level + centre_x**2 + centre_y**2, 0.0))
    inside = (radius - centre_x <= window[0]) & (radius - centre_y <= window[1])
    return inside & (radius + centre_x <= window[2]) & (radius + centre_y <= window[3])
