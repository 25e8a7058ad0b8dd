"""Joins the layers of blocks, some rows at a time."""

from __future__ import annotations

import copy
from typing import Callable, Iterator, Sequence

import numpy as np

from ...core.points import Points
from ...core.progress import SILENT, Progress
from ...grids.cell_window import CellWindow
from ...grids.morphology import within_square
from ...grids.outline import Outline, strips
from ...survey.area import Area
from ...tin.surface import CellLattice, Surface
from .block import CONTENTS, TOP, BlockRasters
from .level_water import NO_WATER_CELLS, WaterCells


def joined(
    blocks: Sequence[BlockRasters], layer: str, strip: CellWindow, empty: np.generic
) -> np.ndarray:
    """Return the cells of a layer in a strip, rows from the south; `empty` where there is none."""
    cells = np.full(strip.shape, empty)
    for block in blocks:
        shared = strip.within(block.window)
        if not shared.is_empty:
            cells[strip.slices(shared)] = block.layers[layer][block.window.slices(shared)]
    return cells


class Mosaic:
    """A layer of all blocks of a survey, without values outside of these and of the outline."""

    # Cells of `water` have its level: in the terrain all of them, in the surface those without a
    # point. The expected error has no value there.

    def __init__(
        self,
        blocks: Sequence[BlockRasters],
        layer: str,
        window: CellWindow,
        cell: float,
        outline: Outline | None = None,
        water: WaterCells = NO_WATER_CELLS,
    ) -> None:
        self._blocks, self._layer, self.window, self._cell = blocks, layer, window, cell
        self._whole, self._outlines, self._water = window, [outline] if outline else [], water
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
        part.window = whole._replace(column=whole.column + start, columns=end - start)
        part._blocks = [
            block for block in self._blocks if not part.window.within(block.window).is_empty
        ]
        return part

    def rows(self, start: int, end: int) -> np.ndarray:
        """Return rows from north to south, shape (end - start, columns); beyond it NaN."""
        strip = self.window.strip(start, end)
        heights = joined(self._blocks, self._layer, strip, np.float32(np.nan))
        if self._layer == "terrain":
            self._water.burn(heights, strip)
        elif self._layer in ("surface", "canopy"):
            has_top = joined(self._blocks, CONTENTS, strip, np.uint8(0)) >= TOP
            self._water.burn(heights, strip, has_top)
        elif self._layer in ("expected_error", "error_cause"):
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

    def _inside(self, start: int, end: int) -> np.ndarray:
        """Return which cells of some rows lie in all outlines."""
        first = self.window.column - self._whole.column
        columns = first, first + self.window.columns
        rows = [outline.rows(start, end, *columns) for outline in self._outlines]
        return np.logical_and.reduce(rows)

    def fill_gaps(self, points: np.ndarray, progress: Progress = SILENT) -> None:
        """Fill cells without a height inside the outline, from a TIN over the gaps, of the cells
        along them and of more vertices, shape (n, 3).
        """
        vertices = [points]
        for start, end in strips(self.window.shape):
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
            x = (strip.column + column + 0.5) * self._cell
            y = (strip.row + row + 0.5) * self._cell
            lattice = CellLattice((0.0, 0.0), self._cell)
            heights[row, column] = gaps.heights(x, y, cells=lattice)


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
    parts = [mosaic.columns(left - margin, left + window.columns + margin) for mosaic in mosaics]
    inside = slice(margin, margin + window.columns)
    for start, end in strips(window.shape):
        first, last = north + start - margin, north + end + margin
        rows = make(*(part.rows(first, last) for part in parts))
        yield rows[..., margin : margin + end - start, inside]
        progress(end / window.rows)
