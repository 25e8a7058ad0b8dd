"""Joins the rasters of blocks, some rows at a time."""

from __future__ import annotations

import copy
from typing import Callable, Iterator, Sequence

import numpy as np

from ...core.points import Points
from ...core.progress import SILENT, Progress
from ...grids.cell_window import CellWindow
from ...grids.morphology import within_square
from ...grids.outline import Outline
from ...grids.surface import CellLattice, Surface
from ...survey.area import Area
from .block import HELD, TOP, BlockRasters
from .level_water import NO_WATER_CELLS, WaterCells

# Cells that are joined at a time.
_CELLS_A_STRIP = 4_000_000
# The rows of a strip are a multiple of this, as the file has blocks of so many rows.
_ROWS = 256


class Mosaic:
    """A layer of all blocks of a survey, without values outside of these and of the outline."""

    # Cells of `water` have its level: in the terrain all of them, in the surface those without a
    # point. The confidence has no value there.

    def __init__(
        self,
        made: Sequence[BlockRasters],
        layer: str,
        window: CellWindow,
        cell: float,
        outline: Outline | None = None,
        water: WaterCells = NO_WATER_CELLS,
    ) -> None:
        self._water = water
        self._made, self._layer, self.window, self._cell = made, layer, window, cell
        self._whole, self._outlines = window, [outline] if outline else []
        self._area: Area | None = None
        self._gaps: Surface | None = None

    def limited(self, outline: Outline | None = None, area: Area | None = None) -> Mosaic:
        """Return the layer with values only inside an outline, and an area in metres, too."""
        part = copy.copy(self)
        part._outlines, part._area = self._outlines + ([outline] if outline else []), area
        return part

    def columns(self, start: int, end: int) -> Mosaic:
        """Return some columns of the layer, from `start` on; those beyond it are NaN."""
        part, whole = copy.copy(self), self.window
        part.window = CellWindow(whole.row, whole.column + start, whole.rows, end - start)
        part._made = [each for each in self._made if _overlap(each.window, part.window)]
        return part

    def rows(self, start: int, end: int, kind: type = np.float32) -> np.ndarray:
        """Return rows from north to south, shape (end - start, columns); beyond it NaN, or 0."""
        whole = self.window
        strip = whole.strip(start, end)
        empty = np.nan if issubclass(kind, np.floating) else 0
        heights: np.ndarray = np.full(strip.shape, empty, dtype=kind)
        for each in self._made:
            target, source = _overlap(strip, each.window), _overlap(each.window, strip)
            if target is not None:
                heights[target] = each.layers[self._layer][source]
        if self._layer == "terrain":
            self._water.burn(heights, strip)
        elif self._layer == "surface":
            self._water.burn(heights, strip, self._has_top(strip))
        elif self._layer == "confidence":
            # It tells what the ground points are worth, and the terrain of these cells has none.
            heights[self._water.inside(strip)] = np.nan
        if self._outlines:
            outside = ~self._inside(start, end)[::-1]
            if self._gaps is not None:
                self._fill(heights, strip, self._gaps, outside)
            heights[outside] = np.nan
        if self._area is not None:
            x, y = np.meshgrid(*strip.centres(self._cell))
            heights[~self._area.contains(x.ravel(), y.ravel()).reshape(x.shape)] = np.nan
        return heights[::-1]

    def _has_top(self, strip: CellWindow) -> np.ndarray:
        """Return which cells of a strip hold a point of the surface, rows from the south."""
        found = np.zeros(strip.shape, dtype=bool)
        for each in self._made:
            target, source = _overlap(strip, each.window), _overlap(each.window, strip)
            if target is not None:
                found[target] = each.layers[HELD][source] >= TOP
        return found

    def _inside(self, start: int, end: int) -> np.ndarray:
        """Return which cells of some rows lie in all outlines."""
        first = self.window.column - self._whole.column
        columns = first, first + self.window.columns
        return np.logical_and.reduce([each.rows(start, end, *columns) for each in self._outlines])

    def fill_gaps(self, points: np.ndarray, progress: Progress = SILENT) -> None:
        """Fill cells without a height inside the outline, from a TIN over the gaps, of the cells
        along them and of more vertices, shape (n, 3).
        """
        vertices = [points]
        for start, end in _strips(self.window):
            first, last = max(start - 1, 0), min(end + 1, self.window.rows)
            heights, inside = self.rows(first, last), self._inside(first, last)
            vertices.append(self._along_gaps(heights, np.isnan(heights) & inside, first))
            progress(end / self.window.rows)
        self._gaps = Surface(Points(*np.concatenate(vertices).T))

    def _along_gaps(self, heights: np.ndarray, missing: np.ndarray, first: int) -> np.ndarray:
        """Return centres and heights of the cells with a height next to missing ones, (n, 3)."""
        near = within_square(np.maximum, missing, 1)
        row, column = np.nonzero(near & ~np.isnan(heights))
        x = (self.window.column + column + 0.5) * self._cell
        y = (self.window.row + self.window.rows - first - row - 0.5) * self._cell
        return np.column_stack((x, y, heights[row, column].astype(np.float64)))

    def _fill(
        self, heights: np.ndarray, strip: CellWindow, gaps: Surface, outside: np.ndarray
    ) -> None:
        row, column = np.nonzero(np.isnan(heights) & ~outside)
        if len(row):
            x, y = ((at + 0.5) * self._cell for at in (strip.column + column, strip.row + row))
            lattice = CellLattice((0.0, 0.0), self._cell)
            heights[row, column] = gaps.heights(x, y, cells=lattice)


def _overlap(one: CellWindow, other: CellWindow) -> tuple[slice, slice] | None:
    """Return the rows and columns of `one` that `other` has as well; None if there are none."""
    both = one.within(other)
    if both.rows <= 0 or both.columns <= 0:
        return None
    row, column = both.row - one.row, both.column - one.column
    return slice(row, row + both.rows), slice(column, column + both.columns)


def _strips(window: CellWindow) -> list[tuple[int, int]]:
    """Return the rows, from north, at which strips begin and end."""
    rows = max(_CELLS_A_STRIP // window.columns // _ROWS, 1) * _ROWS
    count = window.rows
    return [(start, min(start + rows, count)) for start in range(0, count, rows)]


def gathered_strips(
    mosaics: Sequence[Mosaic],
    window: CellWindow,
    make: Callable[..., np.ndarray],
    margin: int,
    progress: Progress,
) -> Iterator[np.ndarray]:
    """Yield a raster, strip by strip from north to south, that `make` makes of as many rows of each
    mosaic, all with the same cells; the first axis may be bands.
    """
    # `margin` is the number of rows and columns beyond a strip that affect it. Cells of the window
    # beyond the mosaics have no value.
    whole = mosaics[0].window
    north = whole.row + whole.rows - window.row - window.rows
    left = window.column - whole.column
    parts = [each.columns(left - margin, left + window.columns + margin) for each in mosaics]
    inside = slice(margin, margin + window.columns)
    for start, end in _strips(window):
        first, last = north + start - margin, north + end + margin
        made = make(*(each.rows(first, last) for each in parts))
        yield made[..., margin : margin + end - start, inside]
        progress(end / window.rows)
