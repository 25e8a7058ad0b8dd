"""The octree of COPC: which node each point belongs to.

References
----------
COPC specification 1.0, https://copc.io
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core.progress import SILENT, Progress
from .records import column

# A node takes one point for each cell of a grid of so many cells along each side, ...
_GRID_BITS = 7
# ... or all of its points, where they are no more than these.
_LEAF_POINTS = 100_000
# So few points are not worth a node: they stay with the node above.
_SMALL_NODE = 500
# Cells along a side of the whole cube, the finest that are told apart; three times so many bits
# have to fit into 64.
_CUBE_BITS = 21
_DEEPEST = _CUBE_BITS - _GRID_BITS


@dataclass(frozen=True)
class Octree:
    """A cube around the points, and the node of each.

    Attributes
    ----------
    corner : numpy.ndarray of float64, shape (3,)
        The smallest x, y and z of the cube.
    side : float
        Its edge.
    keys : numpy.ndarray of int32, shape (nodes, 4)
        Depth, x, y and z of each node; a node never comes before the one above it.
    node : numpy.ndarray of unsigned integers, shape (points,)
        Row of `keys` to which each point belongs.
    """

    corner: np.ndarray
    side: float
    keys: np.ndarray
    node: np.ndarray

    @property
    def spacing(self) -> float:
        """Distance between the points of the topmost node."""
        return self.side / (1 << _GRID_BITS)


def build_octree(
    records: np.ndarray,
    scale: tuple[float, float, float],
    offset: tuple[float, float, float],
    progress: Progress = SILENT,
) -> Octree:
    """Sort points into the nodes of an octree.

    Each node takes, of the points that the nodes above it left, the first in file order of each
    cell of its grid, and leaves the rest to its eight children.

    Parameters
    ----------
    records : numpy.ndarray of uint8, shape (n, record length)
        The points.
    scale, offset : tuple of float
        What makes coordinates of their integers.
    progress : Progress
        Receives progress.
    """
    coordinates = [integers(records, axis) for axis in range(3)]
    minimum, maximum = extent(coordinates, scale, offset)
    side = max(float((maximum - minimum).max()), *scale)
    # Some readers take the smallest coordinates in the header for the corner of the cube, whatever
    # the info record says: here they are.
    corner = minimum
    codes = np.zeros(len(records), dtype=np.uint64)
    for axis, values in enumerate(coordinates):
        cells = values * scale[axis]
        cells += offset[axis] - corner[axis]
        cells *= (1 << _CUBE_BITS) / side
        np.clip(cells, 0, (1 << _CUBE_BITS) - 1, out=cells)
        codes |= _spread(cells.astype(np.uint64)) << np.uint64(axis)
        progress(0.1 * (axis + 1))
    # Sorted by these codes, the points of any cell of any depth lie side by side.
    order = np.argsort(codes, kind="stable")
    keys, node = _sort_into_nodes(codes[order], order, progress.part(0.6, 1.0))
    return Octree(corner, side, keys, node)


def _sort_into_nodes(
    codes: np.ndarray, order: np.ndarray, progress: Progress
) -> tuple[np.ndarray, np.ndarray]:
    """Return the keys of the nodes, and the node of each point in file order.

    Parameters
    ----------
    codes : numpy.ndarray of uint64
        Codes of the points, ascending.
    order : numpy.ndarray of intp
        Place in the file of each of them.
    progress : Progress
        Receives progress.
    """
    node = np.zeros(len(codes), dtype=np.int64)
    keys: list[np.ndarray] = []
    count = 0
    for depth in range(_DEEPEST + 1):
        inside = codes >> np.uint64(3 * (_CUBE_BITS - depth))
        starts = starts_of(inside)
        sizes = np.diff(starts, append=len(codes))
        number = np.repeat(np.arange(len(starts)), sizes)
        stays = np.repeat(sizes <= _LEAF_POINTS, sizes)
        if depth == _DEEPEST:
            stays[:] = True
        if not stays.all():
            # The first of each cell, in the order of the file.
            cells = starts_of(codes >> np.uint64(3 * (_DEEPEST - depth)))
            first = np.minimum.reduceat(order, cells)
            stays |= order == np.repeat(first, np.diff(cells, append=len(codes)))
            stays[~stays] = _is_small_child(codes[~stays], depth)
        node[order[stays]] = count + number[stays]
        keys.append(_keys(depth, inside[starts]))
        count += len(starts)
        codes, order = codes[~stays], order[~stays]
        progress(1 - len(codes) / len(node))
        if len(codes) == 0:
            break
    return np.concatenate(keys), node.astype(np.min_scalar_type(count))


def _is_small_child(codes: np.ndarray, depth: int) -> np.ndarray:
    """Return which of the points that are left would make but a small node one deeper."""
    starts = starts_of(codes >> np.uint64(3 * (_CUBE_BITS - depth - 1)))
    sizes = np.diff(starts, append=len(codes))
    return np.repeat(sizes < _SMALL_NODE, sizes)


def starts_of(ascending: np.ndarray) -> np.ndarray:
    """Return where each run of equal values begins."""
    return np.flatnonzero(np.concatenate(([True], ascending[1:] != ascending[:-1])))


def _keys(depth: int, codes: np.ndarray) -> np.ndarray:
    axes = [_gather(codes >> np.uint64(axis)) for axis in range(3)]
    return np.column_stack([np.full(len(codes), depth), *axes]).astype(np.int32)


# The steps that put two zero bits between the 21 bits of a number; known as Morton or z-order.
_SPREAD = (
    (32, 0x001F00000000FFFF),
    (16, 0x001F0000FF0000FF),
    (8, 0x100F00F00F00F00F),
    (4, 0x10C30C30C30C30C3),
    (2, 0x1249249249249249),
)


def _spread(numbers: np.ndarray) -> np.ndarray:
    for shift, mask in _SPREAD:
        numbers = (numbers | (numbers << np.uint64(shift))) & np.uint64(mask)
    return numbers


def _gather(numbers: np.ndarray) -> np.ndarray:
    """Undo `_spread`."""
    numbers = numbers & np.uint64(_SPREAD[-1][1])
    masks = [mask for _, mask in _SPREAD[-2::-1]] + [(1 << _CUBE_BITS) - 1]
    for (shift, _), mask in zip(_SPREAD[::-1], masks):
        numbers = (numbers | (numbers >> np.uint64(shift))) & np.uint64(mask)
    return numbers


def integers(records: np.ndarray, axis: int) -> np.ndarray:
    """Return the x, y or z of records."""
    return column(records, 4 * axis, "<i4")


def extent(
    coordinates: list[np.ndarray],
    scale: tuple[float, float, float],
    offset: tuple[float, float, float],
) -> tuple[np.ndarray, np.ndarray]:
    """Return the smallest and the largest coordinates from their integers."""
    factors, shifts = np.array(scale), np.array(offset)
    return tuple(
        np.array([pick(each) for each in coordinates]) * factors + shifts
        for pick in (np.min, np.max)
    )
