"""Regions of cells between steps: those between rims, and those of raised cells."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..state import GridState

# Least share of a pit's border that must be a rise.
_PIT_SHARE = 0.9
# Rounds in which regions that others hid are tested again.
_ROUNDS = 3
# A cell is even within so many metres of the mean of two opposite neighbours.
_BEND = 0.15
# Regions of the first and of the second cell of pairs of cells; -1 for cells that are not raised.
_Pairs = tuple[np.ndarray, np.ndarray]
# Pairs of cells (indices into the flattened grid), and the sign of the step between them.
Steps = tuple[np.ndarray, np.ndarray, np.ndarray]


class Border(NamedTuple):
    """The pairs of neighbouring cells that lie in different regions."""

    regions: int  # one more than the largest number of a region
    # int32 (pairs,): Region of the first and of the second cell; 0 where nothing is known.
    first: np.ndarray
    second: np.ndarray
    # int8 (pairs,): 1 where the second is higher by more than is allowed, -1 where it is lower,
    # else 0.
    sign: np.ndarray
    # float32 (pairs,): Height of the second above the first in metres, beyond the trend; 0 where
    # `sign` is 0.
    rise: np.ndarray

    def length(self) -> np.ndarray:
        """Return the length of each region's border in cells, if neighbours are one apart."""
        all_ = np.ones(len(self.sign), dtype=bool)
        # Each cell of a straight border has three neighbours beyond it.
        return self._total(all_, all_) / 3.0

    def drops(
        self, removed: np.ndarray, sign: int
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Count, for each region, pairs of cells with a drop (sign 1) or rise (-1), with a known
        neighbour, and all pairs, to regions that are not removed; and return the mean height of the
        drops in metres.
        """
        pairs = ~(removed[self.first] | removed[self.second])
        known = pairs & (self.first > 0) & (self.second > 0)
        stepped = np.flatnonzero(known & (self.sign != 0))
        of_steps = Border(self.regions, *(each[stepped] for each in self[1:]))
        down, up = of_steps.sign == -sign, of_steps.sign == sign
        drops = of_steps._total(down, up)
        height = of_steps._total(down, up, np.abs(of_steps.rise)) / np.maximum(drops, 1)
        return drops, self._total(known, known), self._total(pairs, pairs), height

    def _total(
        self, first: np.ndarray, second: np.ndarray, weights: np.ndarray | None = None
    ) -> np.ndarray:
        """Count pairs, or add up their weights, for the region of each of their cells."""
        total = np.zeros(self.regions)
        for region, which in ((self.first, first), (self.second, second)):
            counted = weights if weights is None else weights[which]
            total += np.bincount(region[which], counted, self.regions)
        return total


class Regions:
    """The regions between rims."""

    # `number`: int32 (rows, columns): The region of each cell; 0 where nothing is known.
    # `width`: float (count,): Width (shorter side) of each region in metres.

    def __init__(self, number: np.ndarray, border: Border, size: float, step: int) -> None:
        self.number = number
        self._border = border
        area = np.bincount(number.ravel(), minlength=border.regions)
        self.width = _shorter_side(area, border.length() / step) * size

    def bounded(
        self,
        max_size: float,
        share: float,
        whole_share: float,
        steepness: float = 0.0,
    ) -> np.ndarray:
        """Return the cells of regions of at most some width (the shorter side) in metres, of whose
        known and whole border such shares drop, by a mean of `steepness` times the width.
        """
        return self._bounded(max_size, 1, share, whole_share, steepness)

    def sunken(self, max_size: float) -> np.ndarray:
        """Return the cells of pits: regions whose border is a rise nearly all round."""
        return self._bounded(max_size, -1, _PIT_SHARE, _PIT_SHARE, 0.0)

    def _bounded(
        self,
        max_size: float,
        sign: int,
        share: float,
        least_share: float,
        least_steepness: float,
    ) -> np.ndarray:
        """Return the cells of regions bounded by drops (1) or rises (-1)."""
        # What one round finds is unknown in the next, which finds what it hid: a roof below a
        # tower.
        fits = self.width <= max_size
        fits[0] = False
        found = np.zeros(len(fits), dtype=bool)
        for _ in range(_ROUNDS):
            drops, known, pairs, height = self._border.drops(found, sign)
            new = fits & ~found & (drops > 0) & (height >= least_steepness * self.width)
            new &= (drops >= share * known) & (drops > least_share * pairs)
            if not new.any():
                break
            found |= new
        return found[self.number]


def _shorter_side(area: np.ndarray, perimeter: np.ndarray) -> np.ndarray:
    """Return the shorter side of rectangles; for rounder shapes, the side of a square."""
    quarter = perimeter / 4.0
    rest = quarter**2 - area
    return np.where(rest < 0, np.sqrt(area), quarter - np.sqrt(np.maximum(rest, 0.0)))


class RaisedRegions(NamedTuple):
    """The raised regions of a grid, with what rules ask about them."""

    size: float  # side of a cell in metres
    shape: tuple[int, int]  # rows and columns of the grid
    cells: np.ndarray  # intp (n,): The raised cells, in the flattened grid
    number: np.ndarray  # int64 (n,): Region of each of these cells
    # float (n,): Height of each of these cells, and its height above the ground, in metres.
    heights: np.ndarray
    heights_above: np.ndarray
    # float64 (regions,): Square metres; mean height above the ground in metres.
    area: np.ndarray
    above: np.ndarray
    filled: np.ndarray  # float32 (rows, columns): Heights of all cells in metres, without NaN
    # Pairs of regions between which there are level steps, drops and rises, for two directions.
    borders: list[list[_Pairs]]
    cut: np.ndarray  # float64 (regions,): Sides of cells along the border of the survey

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
    """Return the regions of the raised cells that no step parts, given pairs of neighbours of which
    at least one is raised.
    """
    # If gaps are judged, a cell without a point is no evidence of a gentle border.
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
        np.bincount(number, _sides_outside(grid.surveyed).ravel()[cells], count),
    )


def _sides_outside(surveyed: np.ndarray) -> np.ndarray:
    """Return how many of the four neighbours of each cell were not surveyed."""
    outside = np.pad(~surveyed, 1, constant_values=True).astype(np.int8)
    return outside[2:, 1:-1] + outside[:-2, 1:-1] + outside[1:-1, 2:] + outside[1:-1, :-2]


def even_cells(filled: np.ndarray) -> np.ndarray:
    """Return which cells (rows, columns) are about as high as the mean of opposite neighbours."""
    even = np.zeros(filled.shape, dtype=bool)
    for to, z in ((even, filled), (even.T, filled.T)):
        to[1:-1] |= np.abs(z[2:] + z[:-2] - 2.0 * z[1:-1]) <= 2.0 * _BEND
    return even


def _numbered(up: np.ndarray, one: np.ndarray, other: np.ndarray) -> tuple[np.ndarray, int]:
    """Return the region of each cell, -1 where none is raised, and their number, from pairs of
    raised cells without a step.
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
    """Return, for each of two directions, the pairs of regions with level steps, drops and rises
    between them.
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
