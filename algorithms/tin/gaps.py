"""Gaps between the vertices of thinned points, to find all vertices that heights in them need."""

from __future__ import annotations

from typing import Dict

import numpy as np

from ..grids.morphology import within_square
from .lattice_sample import TILE, LatticeSample, TilePlace

# Which cells of some tiles are meant, bool (TILE, TILE), by row and column of the tile.
CellsOfTiles = Dict[TilePlace, np.ndarray]
# Lattice cells along the side of a square. A gap is made of squares without a vertex in or beside
# them. A circle that holds no vertex and has a radius of more than three squares holds such a
# square, and no place in it is farther from one than `_BESIDE_A_GAP` squares. A smaller circle
# reaches no farther from a query in it than `_ROUND_A_QUERY` squares.
_SQUARE = 2
_BESIDE_A_GAP = 4
_ROUND_A_QUERY = 8
_SIDE = TILE // _SQUARE  # squares along the side of a tile
_MARGIN = 2 * _BESIDE_A_GAP  # squares beyond all tiles
# Most squares for each vertex in the rectangle of all tiles in which gaps are looked for.
_MOST_SQUARES = 16


class Gaps:
    """The gaps between vertices, which no circle without a vertex reaches beyond."""

    def __init__(self, thinned: LatticeSample) -> None:
        from scipy import ndimage

        # With a margin, since what lies beyond all vertices is a gap as well.
        rows, columns = (range(min(numbers), max(numbers) + 1) for numbers in zip(*thinned.tiles))
        self._thinned, self._first = thinned, (rows[0], columns[0])
        shape = [len(numbers) * _SIDE + 2 * _MARGIN for numbers in (rows, columns)]
        held = np.zeros(shape, dtype=bool)
        for place, tile in thinned.tiles.items():
            held[self._of(place)][_squares(tile.slots)] = True
        self._numbers, self._count = ndimage.label(~within_square(np.maximum, held, 1))

    @classmethod
    def can_be_found(cls, thinned: LatticeSample) -> bool:
        """Return whether the rectangle of the vertices is not far larger than their land."""
        rows, columns = (np.ptp(numbers) + 1 for numbers in zip(*thinned.tiles))
        return bool(rows * columns * _SIDE**2 < _MOST_SQUARES * thinned.count)

    def are_round(self, near: CellsOfTiles) -> np.ndarray:
        """Return a mask (n,) of the vertices round some cells and round the gaps beside them."""
        asked = np.zeros(self._numbers.shape, dtype=bool)
        for place, cells in near.items():
            if place in self._thinned.tiles:
                sides = _SIDE, _SQUARE, _SIDE, _SQUARE
                asked[self._of(place)] = cells.reshape(sides).any(axis=(1, 3))
        beside = within_square(np.maximum, asked, _BESIDE_A_GAP)
        touched = np.zeros(self._count + 1, dtype=bool)
        touched[self._numbers[beside]] = True
        touched[0] = False
        wanted = within_square(np.maximum, touched[self._numbers], _BESIDE_A_GAP)
        wanted |= within_square(np.maximum, asked, _ROUND_A_QUERY)
        is_vertex = np.zeros(self._thinned.points.count, dtype=bool)
        is_vertex[self._thinned.hull] = True
        for place, tile in self._thinned.tiles.items():
            inside = wanted[self._of(place)]
            if inside.any():
                is_vertex[tile.source[inside[_squares(tile.slots)]]] = True
        return is_vertex

    def _of(self, place: TilePlace) -> tuple[slice, slice]:
        """Return the squares of a tile."""
        row, column = (
            (number - first) * _SIDE + _MARGIN for number, first in zip(place, self._first)
        )
        return slice(row, row + _SIDE), slice(column, column + _SIDE)


def _squares(slots: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return row and column of the squares of cells of a tile."""
    row, column = np.divmod(slots, TILE)
    return row // _SQUARE, column // _SQUARE
