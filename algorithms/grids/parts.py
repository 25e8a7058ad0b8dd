"""The parts of a grid that hold wanted cells, so that work follows these and not the whole box."""

from __future__ import annotations

from typing import Iterator, NamedTuple

import numpy as np

# Side in cells of the squares of which parts are made.
_SQUARE = 16
# Cells that cost as much as a part does beside its own cells.
_COST_OF_A_PART = 4096
# A part is divided where that saves at least this share of what it costs.
_LEAST_SAVED = 0.1
# Share of its squares that are wanted from which on a part is not divided.
_SOLID = 0.9

_Slices = tuple[slice, slice]


class Part(NamedTuple):
    """A rectangle of a grid: slices of rows and columns."""

    core: _Slices  # the cells of the part
    around: _Slices  # the same with a margin, cut at the border of the grid
    inner: _Slices  # the cells of the part within those with the margin


def parts_with(wanted: np.ndarray, margin: int) -> Iterator[Part]:
    """Yield rectangles that together hold all wanted cells (rows, columns), none of them twice,
    each with `margin` cells round it.
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
        yield Part(*zip(*sides))


def _side(first: int, last: int, count: int, margin: int) -> tuple[slice, slice, slice]:
    """Return the rows or columns of a part, with a margin, and the part within these."""
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
