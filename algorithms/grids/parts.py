"""The parts of a grid that hold wanted cells, and groups of points that are far apart."""

from __future__ import annotations

from typing import Iterator, NamedTuple

import numpy as np

from ..core.points import Points
from .cells import Cells

_SQUARE = 16  # side in cells of the squares that parts are made of
_COST_OF_A_PART = 4096  # what a part costs beside its cells, in cells
_LEAST_SAVED = 0.1  # least share of the cost of a part that is saved if it is divided
_SOLID = 0.9  # share of wanted squares from which on a part is not divided
# Groups of points: cells along the reach (even, because points are dilated by half of them), and
# the least side of such a cell in metres.
_CELLS_A_REACH = 10
_LEAST_GAP = 5.0

_Slices = tuple[slice, slice]


class PointPart(NamedTuple):
    """A rectangle of a grid: slices of rows and columns."""

    core: _Slices  # the cells of the part
    around: _Slices  # the cells of the part and of its margin, within the grid
    inner: _Slices  # the cells of the part, counted from the first one of the margin


def parts_with(wanted: np.ndarray, margin: int) -> Iterator[PointPart]:
    """Yield rectangles that together hold all wanted cells (rows, columns) once, with a margin of
    cells, so that the work depends on the wanted cells and not on their bounding box.
    """
    shape = wanted.shape
    starts = [np.arange(0, max(count, 1), _SQUARE) for count in shape]
    squares = wanted
    for axis in (0, 1):
        squares = np.logical_or.reduceat(squares, starts[axis], axis=axis)
    for box in _divided(squares, (0, 0, *squares.shape), margin)[1]:
        sides = [
            _side(_SQUARE * first, min(_SQUARE * last, count), count, margin)
            for first, last, count in zip(box[:2], box[2:], shape)
        ]
        yield PointPart(*zip(*sides))


def _side(first: int, last: int, count: int, margin: int) -> tuple[slice, slice, slice]:
    """Return the rows or columns of a part, those with its margin, and where it lies there."""
    start = max(first - margin, 0)
    around = slice(start, min(last + margin, count))
    return slice(first, last), around, slice(first - start, last - start)


def _divided(
    squares: np.ndarray, box: tuple[int, int, int, int], margin: int
) -> tuple[int, list[tuple[int, int, int, int]]]:
    """Return what a box of squares costs, and the boxes into which it is divided."""
    part = squares[box[0] : box[2], box[1] : box[3]]
    rows, columns = (np.flatnonzero(part.any(axis=axis)) for axis in (1, 0))
    if not len(rows):
        return 0, []
    south, west = box[0] + int(rows[0]), box[1] + int(columns[0])
    north, east = box[0] + int(rows[-1]) + 1, box[1] + int(columns[-1]) + 1
    height, width = north - south, east - west
    sides = (_SQUARE * side + 2 * margin for side in (height, width))
    cost = _COST_OF_A_PART + next(sides) * next(sides)
    whole = cost, [(south, west, north, east)]
    if np.count_nonzero(part) >= _SOLID * height * width:
        return whole
    if height >= width:
        middle = (south + north) // 2
        halves = (south, west, middle, east), (middle, west, north, east)
    else:
        middle = (west + east) // 2
        halves = (south, west, north, middle), (south, middle, north, east)
    costs, parts = zip(*(_divided(squares, half, margin) for half in halves))
    if sum(costs) > (1.0 - _LEAST_SAVED) * cost:
        return whole
    return sum(costs), parts[0] + parts[1]


def apart(points: Points, reach: float) -> tuple[np.ndarray, int]:
    """Return the group of each point, int32 (n,), empty if there is only one group, and the number
    of groups, which are farther apart than `reach` metres.
    """
    # A gap always separates groups if it is a quarter wider than the reach, and at least 65 m wide.
    from scipy import ndimage

    cells = Cells.over(points, max(reach / _CELLS_A_REACH, _LEAST_GAP))
    square = np.ones((3, 3), dtype=bool)
    around = np.pad(cells.occupied, _CELLS_A_REACH)
    groups, count = ndimage.label(
        ndimage.binary_dilation(around, square, iterations=_CELLS_A_REACH // 2)
    )
    if count == 1:
        return np.zeros(0, dtype=np.int32), 1
    inner = groups[_CELLS_A_REACH:-_CELLS_A_REACH, _CELLS_A_REACH:-_CELLS_A_REACH]
    return inner.ravel()[cells.index] - np.int32(1), count
