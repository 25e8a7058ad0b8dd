"""Joins the layers of blocks, span by span, without land that has none."""

from __future__ import annotations

import copy
import math
from typing import Callable, Iterator, Sequence

import numpy as np

from ...core.points import Points
from ...core.progress import SILENT, Progress
from ...grids.cell_window import CellWindow
from ...grids.morphology import within_square
from ...grids.outline import Outline, Span, spans
from ...rasters.sparse import RasterPart
from ...survey.area import Area
from ...tin.surface import CellLattice, Surface
from .block import CONTENTS, OF_EVIDENCE, TOP, BlockRasters
from .level_water import NO_WATER_CELLS, WaterCells


def joined(
    blocks: Sequence[BlockRasters], layer: str, window: CellWindow, empty: np.generic
) -> np.ndarray:
    """Return the cells of a layer in a window, rows from the south; `empty` in voids."""
    cells = np.full(window.shape, empty)
    for block in blocks:
        shared = window.within(block.window)
        if not shared.is_empty:
            cells[window.slices(shared)] = block.layers[layer][block.window.slices(shared)]
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
        self._outlines, self._water = [outline] if outline else [], water
        self._area: Area | None = None
        self._gaps: Surface | None = None

    def limited(self, outline: Outline | None = None, area: Area | None = None) -> Mosaic:
        """Return the layer with values only inside an outline, and an area in metres, too."""
        part = copy.copy(self)
        part._outlines, part._area = self._outlines + ([outline] if outline else []), area
        return part

    def meets(self, span: Span) -> bool:
        """Return whether the layer can have values in a span."""
        return all(outline.meets(span) for outline in self._outlines)

    def cells(self, span: Span) -> np.ndarray:
        """Return the cells of a span, rows from north to south; NaN for no value."""
        window = self.window.part(*span)
        heights = joined(self._blocks, self._layer, window, np.float32(np.nan))
        if self._layer == "terrain":
            self._water.burn(heights, window)
        elif self._layer in ("surface", "canopy"):
            has_top = joined(self._blocks, CONTENTS, window, np.uint8(0)) >= TOP
            self._water.burn(heights, window, has_top)
        elif self._layer in OF_EVIDENCE:
            # It tells what the ground points are worth, and the terrain of these cells has none.
            heights[self._water.inside(window)] = np.nan
        if self._outlines:
            outside = ~self._inside(span)[::-1]
            if self._gaps is not None:
                self._fill(heights, window, self._gaps, outside)
            heights[outside] = np.nan
        if self._area is not None:
            x, y = np.meshgrid(*window.centres(self._cell))
            heights[~self._area.contains(x.ravel(), y.ravel()).reshape(x.shape)] = np.nan
        return heights[::-1]

    def _inside(self, span: Span) -> np.ndarray:
        """Return which cells of a span lie in all outlines."""
        return np.logical_and.reduce([outline.cells(span) for outline in self._outlines])

    def fill_gaps(self, points: np.ndarray, progress: Progress = SILENT) -> None:
        """Fill cells without a height inside the outline, from a TIN over the gaps, of the cells
        along them and of more vertices, shape (n, 3).
        """
        vertices = [points]
        for span in spans(self.window.shape):
            wide = span.wider(1).within(self.window.shape)
            if self.meets(wide):
                heights = self.cells(wide)
                missing = np.isnan(heights) & self._inside(wide)
                vertices.append(self._along_gaps(heights, missing, wide))
            progress(span.end / self.window.rows)
        self._gaps = Surface(Points(*np.concatenate(vertices).T))

    def _along_gaps(self, heights: np.ndarray, missing: np.ndarray, span: Span) -> np.ndarray:
        """Return centres and heights of the cells with a height next to missing ones, (n, 3)."""
        near = within_square(np.maximum, missing, 1)
        row, column = np.nonzero(near & ~np.isnan(heights))
        x = (self.window.column + span.first + column + 0.5) * self._cell
        y = (self.window.row + self.window.rows - span.start - row - 0.5) * self._cell
        return np.column_stack((x, y, heights[row, column].astype(np.float64)))

    def _fill(
        self, heights: np.ndarray, window: CellWindow, gaps: Surface, outside: np.ndarray
    ) -> None:
        row, column = np.nonzero(np.isnan(heights) & ~outside)
        if len(row):
            x = (window.column + column + 0.5) * self._cell
            y = (window.row + row + 0.5) * self._cell
            lattice = CellLattice((0.0, 0.0), self._cell)
            heights[row, column] = gaps.heights(x, y, cells=lattice)


def made_parts(
    mosaics: Sequence[Mosaic],
    window: CellWindow,
    make: Callable[..., np.ndarray],
    margin: int,
    progress: Progress,
) -> tuple[Iterator[RasterPart], int]:
    """Return the parts of a raster, from north to south, that `make` makes of the same span of each
    mosaic, all with the same cells, and how many cells these are; the first axis may be bands.
    """
    # `margin` is the number of cells beyond a span that affect it. Cells of the window beyond the
    # mosaics have no value, and spans without any are no parts.
    whole = mosaics[0].window
    north = whole.row + whole.rows - window.row - window.rows
    west = window.column - whole.column
    wanted = []
    for span in spans(window.shape):
        start, end, first, last = span
        wide = Span(start + north, end + north, first + west, last + west).wider(margin)
        if any(mosaic.meets(wide) for mosaic in mosaics):
            wanted.append((span, wide))

    def parts() -> Iterator[RasterPart]:
        for number, (span, wide) in enumerate(wanted, start=1):
            rows, columns = (slice(margin, margin + side) for side in span.shape)
            made = make(*(mosaic.cells(wide) for mosaic in mosaics))
            yield RasterPart(span.start, span.first, made[..., rows, columns])
            progress(number / len(wanted))

    return parts(), sum(math.prod(span.shape) for span, _ in wanted)
