"""Raised regions: groups of raised cells without steps between them, such as rocks and banks."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ...grids.cells import are_inside
from ...grids.morphology import closing_by_square
from ..pipeline import Rule
from ..state import GridState
from .regions import bends

# Largest distance in metres of an even cell from the mean of two opposite neighbours.
_BEND = 0.15
# A region is a vault if this share of its cells lie above the mean of the four cells some metres
# north, south, east and west of them. Those of smaller areas, in square metres, may be rocks.
_CONVEX = 0.85
_ROUND = 3.0
_VAULT = 400.0
# Regions of the first and of the second cell of pairs of cells; -1 for cells that are not raised.
_Pairs = tuple[np.ndarray, np.ndarray]
# Pairs of cells (indices into the flattened grid), and the sign of the step between them.
Steps = tuple[np.ndarray, np.ndarray, np.ndarray]


class RaisedRegions(NamedTuple):
    """The raised regions of a grid, with what rules ask about them."""

    size: float  # side of a cell in metres
    shape: tuple[int, int]  # rows and columns of the grid
    cells: np.ndarray  # intp (n,): The raised cells, in the flattened grid
    number: np.ndarray  # int64 (n,): The region of each of these cells
    # float (n,): Height of each of these cells, and its height above the ground, in metres.
    heights: np.ndarray
    heights_above: np.ndarray
    area: np.ndarray  # float64 (regions,): Square metres
    above: np.ndarray  # float64 (regions,): Mean height above the ground in metres
    filled: np.ndarray  # float32 (rows, columns): Heights of all cells in metres, without NaN
    # The borders of regions, once from each side: the pairs of regions (first and second) without a
    # step between their cells, with a drop and with a rise from the first to the second; and the
    # cells of the first region where there is no step.
    borders: list[list[_Pairs]]
    level_cells: list[np.ndarray]
    cut: np.ndarray  # float64 (regions,): Number of sides of cells along the border of the survey

    @property
    def even(self) -> np.ndarray:
        """Which raised cells are even (`even_cells`); boolean, shape (n,)."""
        return even_cells(self.filled).ravel()[self.cells]

    @property
    def mean_width(self) -> np.ndarray:
        """Mean width of each region in metres: that of a long strip with its area and border."""
        sides = np.zeros(len(self.area))
        for kinds in self.borders:
            for first, _ in kinds:
                sides += np.bincount(first, minlength=len(sides))
        return 2.0 * self.area / np.maximum(sides * self.size, self.size)

    @property
    def vaults(self) -> np.ndarray:
        """Which regions are domes or vaults, by their curve; boolean, shape (regions,)."""
        # Sides of hills end in hollows, and their tops are rough.
        k = max(round(_ROUND / self.size), 1)
        z = np.pad(self.filled, k, mode="edge")
        round_it = z[2 * k :, k:-k] + z[: -2 * k, k:-k] + z[k:-k, 2 * k :] + z[k:-k, : -2 * k]
        above = (4.0 * self.filled > round_it).ravel()[self.cells]
        cells, convex = (np.bincount(self.number, some, len(self.area)) for some in (None, above))
        return (self.area >= _VAULT) & (convex >= _CONVEX * cells)

    def widths(self, ground: np.ndarray) -> np.ndarray:
        """Return the length in metres of the longest level piece of the border of each region with
        the ground: regions of a mask (regions + 1,), whose last element is for cells not raised.
        """
        from scipy import ndimage

        level, pieces = np.zeros(self.shape, dtype=bool), []
        for (pairs, *_), cells in zip(self.borders, self.level_cells):
            is_ground = ground[pairs[1]]
            level.ravel()[cells[is_ground]] = True
            pieces.append((pairs[0][is_ground], cells[is_ground]))
        place, _ = ndimage.label(level, np.ones((3, 3)))
        length = np.bincount(place.ravel()) * self.size
        widths = np.zeros(len(self.area))
        for region, cells in pieces:
            np.maximum.at(widths, region, length[place.ravel()[cells]])
        return widths

    def spread(self, regions: np.ndarray) -> np.ndarray:
        """Return the cells of some regions (boolean, one each) as a mask (rows, columns)."""
        mask = np.zeros(self.shape, dtype=bool)
        mask.ravel()[self.cells] = regions[self.number]
        return mask


def raised_regions(
    grid: GridState, raised: np.ndarray, steps: Steps, judges_gaps: bool
) -> RaisedRegions:
    """Return the regions of raised cells without steps between them, given the steps between all
    neighbours with at least one raised cell.
    """
    # If gaps are judged, a border at a cell without a point is not known to be gentle.
    cell, neighbour, sign = steps
    seen = grid.heights.known.ravel() if judges_gaps else np.ones(raised.size, dtype=bool)
    up = raised.ravel()
    inside = (sign == 0) & up[cell] & up[neighbour]
    region, count = _numbered(raised, cell[inside], neighbour[inside])
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
        *_borders(region, up, steps, seen),
        np.bincount(number, _sides_outside(grid.surveyed).ravel()[cells], count),
    )


def _sides_outside(surveyed: np.ndarray) -> np.ndarray:
    """Return how many of the four neighbours of each cell were not surveyed."""
    outside = np.pad(~surveyed, 1, constant_values=True).astype(np.int8)
    return outside[2:, 1:-1] + outside[:-2, 1:-1] + outside[1:-1, 2:] + outside[1:-1, :-2]


def even_cells(filled: np.ndarray) -> np.ndarray:
    """Return which cells (rows, columns) are as high as the mean of two opposite neighbours."""
    return np.logical_or(*(bends(filled) <= _BEND))


def _numbered(up: np.ndarray, cell: np.ndarray, neighbour: np.ndarray) -> tuple[np.ndarray, int]:
    """Return the region of each cell (-1 if it is not raised) and the number of regions, given the
    raised cells (rows, columns) and the pairs of neighbours that are in one region.
    """
    from scipy import ndimage

    # The labelled grid has an element for each cell, and between these one for each link. A graph
    # of scipy.sparse would be as fast, but its import takes longer than to filter a small file.
    (rows, columns), width = up.shape, 2 * up.shape[1] - 1
    linked = np.zeros((2 * rows - 1, width), dtype=bool)
    linked[::2, ::2] = up
    link = 2 * cell + cell // columns * (2 * width - 2 * columns)
    link += np.where(neighbour == cell + 1, 1, width)
    linked.ravel()[link] = True
    label, count = ndimage.label(linked)
    return label[::2, ::2].astype(np.int64).ravel() - 1, count


def _borders(
    region: np.ndarray, up: np.ndarray, steps: Steps, seen: np.ndarray
) -> tuple[list[list[_Pairs]], list[np.ndarray]]:
    """Return `RaisedRegions.borders` and `RaisedRegions.level_cells`."""
    cell, neighbour, sign = steps
    borders, level_cells = [], []
    for from_, to, drop in ((cell, neighbour, -1), (neighbour, cell, 1)):
        differ = up[from_] & (region[from_] != region[to])
        kinds = (sign == 0) & seen[from_], sign == drop, sign == -drop
        kinds = tuple(differ & kind for kind in kinds)
        borders.append([(region[from_[which]], region[to[which]]) for which in kinds])
        level_cells.append(from_[kinds[0]])
    return borders, level_cells


@dataclass(frozen=True)
class Rocks(Rule):
    """A region is a rock if its heights, and its heights above the ground, vary much."""

    # The heights of a roof or a bridge vary little, and so do the heights above the ground of a
    # wood, also on a slope.

    area: float = 200.0  # least area in square metres
    deviation: float = 5.0  # least standard deviation in metres, of both
    # Largest share of the cells within a band of heights of this width in metres: that of a roof is
    # larger, unless the roof is very steep.
    band: float = 3.0
    band_share: float = 1.0 / 3.0

    def fits(self, regions: RaisedRegions) -> np.ndarray:
        """Return which regions are rocks; boolean, shape (regions,)."""
        number, count = regions.number, np.bincount(regions.number)
        is_rock = regions.area >= self.area
        for values in (regions.heights, regions.heights_above):
            mean = np.bincount(number, values) / count
            square = (values - mean[number]) * values
            is_rock &= np.bincount(number, square) >= self.deviation**2 * count
        if is_rock.any():
            is_rock &= ~regions.vaults
        for rock in np.flatnonzero(is_rock):
            z = np.sort(regions.heights[number == rock])
            in_band = np.searchsorted(z, z + self.band) - np.arange(len(z))
            is_rock[rock] = in_band.max() <= self.band_share * len(z)
        return is_rock


@dataclass(frozen=True)
class LowBanks(Rule):
    """A region is a bank (of a field, a dyke or a ditch) if it is low, narrow and even."""

    # Where points are dense, `Bunds` looks at the sides of banks in place of this rule.
    # Cells of a hedge or a wall also have points on the ground beside it, and those of a row of
    # cars are not even. Platforms of ISPRS sample 42 need this rule.

    sparse: float = 0.5  # least spacing of the points in metres
    area: float = 20.0  # least area in square metres
    height: float = 1.2  # largest mean height above the ground in metres
    width: float = 6.0  # largest mean width in metres
    even_share: float = 0.7  # least share of the cells that are even
    # Largest share of the border beyond which another region as high follows. Regions with more are
    # one of a row, such as panels or planters. 1 for no limit.
    most_in_row: float = 0.8
    # The other region may be lower by this share of the drop into the gap between them.
    beyond: float = 0.35

    def fits(self, regions: RaisedRegions) -> np.ndarray:
        """Return which regions are banks; boolean, shape (regions,)."""
        count = len(regions.area)
        region = regions.number
        share = np.bincount(region, regions.even, count) / np.bincount(region, minlength=count)
        is_bank = (regions.area >= self.area) & (regions.mean_width <= self.width)
        if self.most_in_row < 1.0:
            is_bank &= ~self._in_rows(regions)
        return is_bank & (regions.above <= self.height) & (share >= self.even_share)

    def _in_rows(self, regions: RaisedRegions) -> np.ndarray:
        """Return which regions have another one as high beside them on most of their border."""
        number = np.zeros(regions.shape, dtype=np.int32)
        number.ravel()[regions.cells] = regions.number + 1
        filled, reach = regions.filled, max(round(self.width / regions.size / 2.0), 1)
        closed = closing_by_square(filled, reach)
        of_gaps, of_border = np.zeros((2, len(regions.area)))  # sides of cells
        row, column = np.divmod(regions.cells, regions.shape[1])
        for up, right in ((1, 0), (-1, 0), (0, 1), (0, -1)):
            inside = are_inside(row + up, column + right, regions.shape)
            here, region = regions.cells[inside], regions.number[inside]
            there = here + up * regions.shape[1] + right
            beside = number.take(there) != region + 1
            here, there, region = here[beside], there[beside], region[beside]
            drop = filled.take(here) - filled.take(there)
            # The closing fills a gap up to the lower one of the two regions.
            is_gap = (number.take(there) == 0) & (drop > 0.0)
            is_gap &= closed.take(there) >= filled.take(here) - self.beyond * drop
            of_border += np.bincount(region, minlength=len(of_border))
            of_gaps += np.bincount(region, is_gap, len(of_border))
        return of_gaps > self.most_in_row * of_border
