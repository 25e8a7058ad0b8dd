"""The table of raised regions: groups of raised cells without steps between them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..state import GridState

# A cell is even within so many metres of the mean of two opposite neighbours.
_BEND = 0.15
# Regions of the first and of the second cell of pairs of cells; -1 for cells that are not raised.
_Pairs = tuple[np.ndarray, np.ndarray]
# Pairs of cells (indices into the flattened grid), and the sign of the step between them.
Steps = tuple[np.ndarray, np.ndarray, np.ndarray]


class RaisedRegions(NamedTuple):
    """The raised regions of a grid, with what rules ask about them.

    Attributes
    ----------
    size : float
        Side of a cell in metres.
    shape : tuple of int
        Rows and columns of the grid.
    cells : numpy.ndarray of intp, shape (n,)
        The raised cells, in the flattened grid.
    number : numpy.ndarray of int64, shape (n,)
        Region of each of these cells.
    heights, heights_above : numpy.ndarray of float, shape (n,)
        Height of each of these cells, and its height above the ground, in metres.
    area, above : numpy.ndarray of float64, shape (regions,)
        Square metres; mean height above the ground in metres.
    filled : numpy.ndarray of float32, shape (rows, columns)
        Heights of all cells in metres, without NaN.
    borders : list
        Pairs of regions between which there are level steps, drops and rises, for two directions.
    """

    size: float
    shape: tuple[int, int]
    cells: np.ndarray
    number: np.ndarray
    heights: np.ndarray
    heights_above: np.ndarray
    area: np.ndarray
    above: np.ndarray
    filled: np.ndarray
    borders: list[list[_Pairs]]

    @property
    def even(self) -> np.ndarray:
        """Which raised cells are even (`even_cells`); boolean, shape (n,)."""
        return even_cells(self.filled).ravel()[self.cells]

    def spread(self, regions: np.ndarray) -> np.ndarray:
        """Return the cells of some regions (boolean, one each) as a mask (rows, columns)."""
        mask = np.zeros(self.shape, dtype=bool)
        mask.ravel()[self.cells] = regions[self.number]
        return mask


def raised_regions(
    grid: GridState, raised: np.ndarray, steps: Steps, judges_gaps: bool
) -> RaisedRegions:
    """Return the regions of the raised cells between which no step leads up or down.

    Parameters
    ----------
    grid : GridState
        Heights, and the surface of the ground.
    raised : numpy.ndarray of bool, shape (rows, columns)
        Cells that are judged.
    steps : tuple
        Pairs of neighbouring cells of which at least one is raised, and 1 where the second is
        higher by a step, -1 where it is lower, else 0.
    judges_gaps : bool
        Whether a cell without a point is no evidence of a gentle border.
    """
    one, other, sign = steps
    seen = grid.heights.known.ravel() if judges_gaps else np.ones(raised.size, dtype=bool)
    up = raised.ravel()
    inside = (sign == 0) & up[one] & up[other]
    region, count = _numbered(up, one[inside], other[inside])
    cells = np.flatnonzero(up)
    number, size = region[cells], grid.cells.size
    area = np.bincount(number, minlength=count) * size**2
    heights = grid.filled.ravel()[cells]
    above = heights - grid.surface.ravel()[cells]
    return RaisedRegions(
        size,
        raised.shape,
        cells,
        number,
        heights,
        above,
        area,
        np.bincount(number, above, count) * size**2 / area,
        grid.filled,
        _borders(region, up, steps, seen),
    )


def even_cells(filled: np.ndarray) -> np.ndarray:
    """Return which cells (rows, columns) are about as high as the mean of opposite neighbours."""
    even = np.zeros(filled.shape, dtype=bool)
    for to, z in ((even, filled), (even.T, filled.T)):
        to[1:-1] |= np.abs(z[2:] + z[:-2] - 2.0 * z[1:-1]) <= 2.0 * _BEND
    return even


def _numbered(up: np.ndarray, one: np.ndarray, other: np.ndarray) -> tuple[np.ndarray, int]:
    """Return the region of each cell, -1 where none is raised, and how many there are.

    `one` and `other` are pairs of raised cells without a step between them.
    """
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    cells = np.flatnonzero(up)
    region = np.full(up.size, -1, dtype=np.int64)
    region[cells] = np.arange(len(cells))
    pairs = region[one], region[other]
    graph = coo_matrix((np.ones(len(one), dtype=bool), pairs), shape=(len(cells),) * 2)
    count, region[cells] = connected_components(graph, directed=False)
    return region, count


def _borders(
    region: np.ndarray, up: np.ndarray, steps: Steps, seen: np.ndarray
) -> list[list[_Pairs]]:
    """Return the pairs of regions between which there are level steps, drops and rises.

    The two directions are separate.
    """
    one, other, sign = steps
    borders = []
    for from_, to, drop in ((one, other, -1), (other, one, 1)):
        differ = up[from_] & (region[from_] != region[to])
        kinds = (sign == 0) & seen[from_], sign == drop, sign == -drop
        pairs = []
        for kind in kinds:
            which = differ & kind
            pairs.append((region[from_[which]], region[to[which]]))
        borders.append(pairs)
    return borders
