"""Points thinned to one in each cell of a lattice, tile by tile."""

from __future__ import annotations

import itertools
from collections import defaultdict
from functools import cached_property
from typing import NamedTuple

import numpy as np

from ..core.points import Points
from ..core.progress import SILENT, Progress
from ..core.threads import in_threads, parts_of
from ..grids.cells import are_inside, first_of_each
from .triangulation import hull_corners

# Cells along the side of a tile. Smaller tiles make arrays so short that threads spend much time
# waiting for the interpreter's lock.
TILE = 512
_POINTS_A_PART = 1 << 17
# Rounding error of a coordinate on the border of a cell, as a share of the cell.
_ROUNDING = 1e-6
# Parts of a squared cell to which squared distances to the centre of a cell are rounded.
# Smaller differences depend on the origin of the coordinates.
_DISTANCES = 1e6
# Row and column of a tile.
TilePlace = tuple[int, int]


class Tile(NamedTuple):
    """The points of a tile."""

    slots: np.ndarray  # int32 (n,), the cell of each point in the flattened lattice; ascending
    x: np.ndarray  # float64 (n,), in cells, from the corner of the tile
    y: np.ndarray  # float64 (n,)
    source: np.ndarray  # intp (n,), indices in the points before thinning
    outer: np.ndarray  # intp (m,), indices of points that may be corners of the convex hull


class LatticeSample:
    """The point nearest to the centre of each occupied cell, of a side in metres from an anchor in
    metres; of equally near points, the lowest.
    """

    def __init__(
        self,
        points: Points,
        side: float,
        anchor: tuple[float, float],
        progress: Progress = SILENT,
    ) -> None:
        self.points, self.side, self.anchor = points, side, anchor
        groups = self.by_tile(points.x, points.y, progress.part(0.0, 0.5))
        thinned = in_threads(lambda group: self._tile(*group), groups, progress.part(0.5, 1.0))
        self.tiles = dict(zip((place for place, _ in groups), thinned))  # by row and column

    def by_tile(
        self, x: np.ndarray, y: np.ndarray, progress: Progress = SILENT
    ) -> list[tuple[TilePlace, np.ndarray]]:
        """Return row and column of each tile that holds places, with the indices of its places."""

        def sorted_part(part: slice) -> list[tuple[TilePlace, np.ndarray]]:
            row, column = (
                np.floor(self.cells(places[part], axis) / TILE).astype(np.int32)
                for axis, places in ((1, y), (0, x))
            )
            (south, north), (west, east) = ((int(k.min()), int(k.max())) for k in (row, column))
            width = east - west + 1
            # NumPy sorts integers of two bytes fastest.
            codes = (row - south).astype(np.min_scalar_type((north - south + 1) * width))
            codes *= width
            codes += (column - west).astype(codes.dtype)
            order = np.argsort(codes, kind="stable")
            codes = codes[order]
            runs = np.split(order, np.flatnonzero(codes[1:] != codes[:-1]) + 1)
            return [((int(row[k[0]]), int(column[k[0]])), k + part.start) for k in runs]

        found: dict[TilePlace, list[np.ndarray]] = defaultdict(list)
        for runs in in_threads(sorted_part, parts_of(len(x), _POINTS_A_PART), progress):
            for place, indices in runs:
                found[place].append(indices)
        return [(place, np.concatenate(found[place])) for place in sorted(found)]

    def cells(self, values: np.ndarray, axis: int) -> np.ndarray:
        """Convert x (`axis` 0) or y (1) from metres to cells from the anchor."""
        return (values - self.anchor[axis]) / self.side + _ROUNDING

    def _tile(self, place: TilePlace, indices: np.ndarray) -> Tile:
        x = self.cells(self.points.x[indices], 0) - place[1] * TILE
        y = self.cells(self.points.y[indices], 1) - place[0] * TILE
        column, row = x.astype(np.int32), y.astype(np.int32)
        distance = np.rint(((x - column - 0.5) ** 2 + (y - row - 0.5) ** 2) * _DISTANCES)
        slots = row * TILE + column
        first = first_of_each(slots, TILE * TILE, distance, self.points.z[indices], x, y)
        outer = indices[_are_outer(slots[first])[slots]]
        return Tile(slots[first], x[first] - _ROUNDING, y[first] - _ROUNDING, indices[first], outer)

    @property
    def count(self) -> int:
        """Number of points after thinning."""
        return sum(len(tile.source) for tile in self.tiles.values())

    @cached_property
    def hull(self) -> np.ndarray:
        """Return the indices of the corners of the convex hull of all points."""
        outer = np.concatenate([tile.outer for tile in self.tiles.values()])
        return outer[hull_corners(self.points.x[outer], self.points.y[outer])]

    def window(self, place: TilePlace, margin: int) -> LatticeWindow:
        """Return the lattice of a tile (row and column) with the points of a margin round it, in
        cells, at most as wide as a tile.
        """
        width = TILE + 2 * margin
        lattice = np.full((width, width), -1, dtype=np.int32)
        x, y, source, count = [np.zeros(0)], [np.zeros(0)], [np.zeros(0, dtype=np.intp)], 0
        for row, column in itertools.product((-1, 0, 1), (-1, 0, 1)):
            tile = self.tiles.get((place[0] + row, place[1] + column))
            if tile is None:
                continue
            at_row, at_column = np.divmod(tile.slots, TILE)
            at_row += row * TILE + margin
            at_column += column * TILE + margin
            inside = np.flatnonzero(are_inside(at_row, at_column, lattice.shape))
            lattice[at_row[inside], at_column[inside]] = np.arange(count, count + len(inside))
            x.append(tile.x[inside] + column * TILE)
            y.append(tile.y[inside] + row * TILE)
            source.append(tile.source[inside])
            count += len(inside)
        return LatticeWindow(lattice, np.concatenate(x), np.concatenate(y), np.concatenate(source))


class LatticeWindow(NamedTuple):
    """The lattice of a tile and of a margin round it."""

    lattice: np.ndarray  # int32 (rows, columns), the number of the point in each cell; -1 for none
    x: np.ndarray  # float64 (n,), in cells, from the corner of the tile
    y: np.ndarray  # float64 (n,)
    source: np.ndarray  # intp (n,), indices in the points before thinning


def _are_outer(slots: np.ndarray) -> np.ndarray:
    """Return which cells of a tile have no points in some of the four quarters of the plane round
    them, bool (TILE * TILE,), given the cells with points.
    """
    # Only points of such cells can be corners of the convex hull.
    occupied = np.zeros((TILE, TILE), dtype=bool)
    occupied.ravel()[slots] = True
    has_any, columns = occupied.max(axis=1), np.arange(TILE)
    outer = np.zeros((TILE, TILE), dtype=bool)
    for rows in (slice(None), slice(None, None, -1)):
        turned = occupied[rows]
        # First and last columns of points in the rows before each one.
        first = np.where(has_any[rows], turned.argmax(axis=1), TILE)[:-1]
        last = np.where(has_any[rows], TILE - 1 - turned[:, ::-1].argmax(axis=1), -1)[:-1]
        first = np.append(TILE, np.minimum.accumulate(first))[:, None]
        last = np.append(-1, np.maximum.accumulate(last))[:, None]
        outer[rows] |= (columns <= first) | (columns >= last)
    return outer.ravel()
