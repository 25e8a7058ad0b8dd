"""Where rasters end: the outlines of the survey, of the terrain and of the canopy.

The survey is the closing of the cells with points by a disc, with all gaps inside. The terrain is
the same of the cells with ground points. Water with a level counts as points and as ground. A place
is in a closing if no disc round it is free of points. So the triangles there have circumcircles
smaller than the disc, and no slivers along the hull take part.
"""

from __future__ import annotations

import math
from typing import Sequence

import numpy as np

from ...core.progress import SILENT, Progress
from ...grids.cell_window import CellWindow
from ...grids.cells import are_inside, usual_count
from ...grids.morphology import closing, within_square
from ...grids.outline import MOST_CELLS, Discs, Outline, strips, with_gaps_inside
from .block import ANY, CONTENTS, QUARTERS, BlockRasters, RasterStep
from .level_water import NO_WATER_CELLS, WaterCells
from .mosaic import Mosaic, joined

# Radius of the discs in usual distances between points. These are not less than a cell.
_SPACINGS = 4.0
# Least radius in metres for ground, but not in more cells than this: ground points are farther
# apart under trees than elsewhere.
_LEAST_OF_GROUND = 10.0
# Cells: side of the squares in which cells with points are counted.
_SQUARE = 16
# Most squares of a raster; those of a larger one are wider.
_MOST_SQUARES = 4_000_000
# Fewest cells with points of a usual square for a sound distance; else squares are joined.
_FEWEST = 16
# Columns that are refined at a time.
_COLUMNS = 512


class CellContents:
    """What the cells of a survey contain, from the layer `CONTENTS` of all blocks; cells of water
    count as cells with points and ground.
    """

    def __init__(
        self, blocks: Sequence[BlockRasters], window: CellWindow, water: WaterCells = NO_WATER_CELLS
    ) -> None:
        self._blocks, self.window, self.water = blocks, window, water

    def points(self, start: int, end: int) -> np.ndarray:
        """Return which cells contain any point or water, as `ReadRows`."""
        return self.of_water(start, end) | (self._rows(start, end) >= ANY)

    def ground(self, start: int, end: int) -> np.ndarray:
        """Return which cells contain ground points or water, as `ReadRows`."""
        return self.of_water(start, end) | (self._rows(start, end) % ANY > 0)

    def of_water(self, start: int, end: int) -> np.ndarray:
        """Return which cells lie in water with a level, as `ReadRows`."""
        return self.water.inside(self.window.strip(start, end))[::-1]

    def _rows(self, start: int, end: int) -> np.ndarray:
        return joined(self._blocks, CONTENTS, self.window.strip(start, end), np.uint8(0))[::-1]

    def quarters(self, start: int, end: int, columns: slice) -> np.ndarray:
        """Return which quarters of cells contain ground points; bool, twice as many each way."""
        strip = self.window.strip(start, end)._replace(
            column=self.window.column + columns.start, columns=columns.stop - columns.start
        )
        contents = joined(self._blocks, CONTENTS, strip, np.uint8(0))[::-1]
        # Beyond the columns of the survey nothing counts.
        contents[:, : max(-columns.start, 0)] = 0
        contents[:, self.window.columns - columns.start :] = 0
        quarters = np.zeros((2 * contents.shape[0], 2 * contents.shape[1]), dtype=bool)
        for number in range(QUARTERS):
            # Rows go from north to south, so the northern quarters come first.
            quarters[1 - number // 2 :: 2, number % 2 :: 2] = contents & (1 << number)
        return quarters | self.water.inside(strip)[::-1].repeat(2, axis=0).repeat(2, axis=1)

    def spacings(self) -> tuple[float, float]:
        """Return the usual distances, in cells, between cells with points and with ground."""
        window, side = self.window, _SQUARE
        while (window.rows // side + 2) * (window.columns // side + 2) > _MOST_SQUARES:
            side *= 2
        first = window.row // side, window.column // side
        last = (window.row + window.rows) // side, (window.column + window.columns) // side
        counts = np.zeros((2, *(b - a + 1 for a, b in zip(first, last))), dtype=np.int64)
        for block in self._blocks:
            shared = block.window.within(window)
            if shared.is_empty:
                continue
            contents = block.layers[CONTENTS][block.window.slices(shared)]
            (rows, at_rows), (columns, at_columns) = (
                np.unique((start + np.arange(count)) // side, return_index=True)
                for start, count in zip(shared[:2], shared.shape)
            )
            squares = np.ix_(rows - first[0], columns - first[1])
            for number, holding in zip(counts, (contents >= ANY, contents % ANY > 0)):
                along = np.add.reduceat(holding, at_rows, axis=0, dtype=np.int64)
                number[squares] += np.add.reduceat(along, at_columns, axis=1)
        area = window.rows * window.columns
        return _apart(counts[0], side, area), _apart(counts[1], side, area)


def _apart(counts: np.ndarray, side: int, area: int) -> float:
    """Return the usual distance of cells, given their number in each square of `side` cells."""
    # It is never more than if they were spread evenly over the `area`, in cells, of the raster: a
    # small raster is only a part of a square.
    if not counts.any():
        return 1.0
    widest = math.sqrt(area / int(counts.sum()))
    while usual_count(counts) < _FEWEST and max(counts.shape) > 1:
        counts = np.pad(counts, [(0, count % 2) for count in counts.shape])
        counts = counts[::2] + counts[1::2]
        counts = counts[:, ::2] + counts[:, 1::2]
        side *= 2
    return max(min(side / math.sqrt(usual_count(counts)), widest), 1.0)


def _radius(cells: float) -> float:
    """Return the radius of a disc whose border has no single cells, about as large."""
    return math.floor(cells) + 0.5


class Outlines:
    """The outlines of the rasters of a survey, made when they are needed."""

    def __init__(self, contents: CellContents, step: RasterStep) -> None:
        window, cell = contents.window, step.cell
        self._contents, self._shape = contents, window.shape
        self._longest, self.water = step.longest_edge / cell, contents.water
        self._corner = window.row + window.rows, window.column
        of_all, of_ground = contents.spacings()
        self._near = _radius(_SPACINGS * of_all)
        least = min(_LEAST_OF_GROUND / cell, MOST_CELLS - 1)
        self._near_ground = _radius(max(_SPACINGS * of_ground, least))

    def survey(self, progress: Progress = SILENT) -> Outline:
        """Return the outline of all points."""
        return with_gaps_inside(self._closed, self._shape, progress)

    def terrain(self, survey: Outline, progress: Progress = SILENT) -> Outline:
        """Return where the terrain is known; `survey` is the outline of all points."""
        ground = Discs(self._contents.ground, self._corner, self._near_ground, self._near_ground)
        wide = with_gaps_inside(ground.rows, self._shape, progress.part(0.0, 0.8))
        inside = Outline(self._shape)
        for start, end in strips(self._shape):
            cells = wide.rows(start - 1, end + 1)
            if ground.group == 1:
                self._refine(cells, start - 1)
            inside.set(
                start, (cells[1:-1] & survey.rows(start, end)) | self._contents.of_water(start, end)
            )
            progress(0.8 + 0.2 * end / self._shape[0])
        return inside

    def canopy(self, progress: Progress = SILENT) -> Outline:
        """Return where the surface was measured, and the terrain nearby."""
        measured = Outline(self._shape)
        ground = Discs(self._contents.ground, self._corner, self._longest, 0.0)
        for start, end in strips(self._shape):
            measured.set(start, self._closed(start, end) & ground.rows(start, end))
            progress(end / self._shape[0])
        return measured

    def _closed(self, start: int, end: int) -> np.ndarray:
        points = self._contents.points
        closed = Discs(points, self._corner, self._near, self._near).rows(start, end)
        return closed | points(start, end)

    def _refine(self, cells: np.ndarray, start: int) -> None:
        """Take away cells along the border whose centre lies beyond the ground points, in place."""
        # A cell along the border may hold points on one side only. Its centre is inside if all of
        # its quarters are in the closing of the quarters.
        outside = np.pad(~cells, 1, constant_values=True)
        border = cells & within_square(np.maximum, outside, 1)[1:-1, 1:-1]
        radius = _radius(2.0 * self._near_ground)
        margin = math.ceil(self._near_ground) + 1
        for first in range(0, cells.shape[1], _COLUMNS):
            last = min(first + _COLUMNS, cells.shape[1])
            rows = np.flatnonzero(border[:, first:last].any(axis=1))
            if not len(rows):
                continue
            low, high = start + int(rows[0]), start + int(rows[-1]) + 1
            columns = slice(first - margin, last + margin)
            quarters = self._contents.quarters(low - margin, high + margin, columns)
            closed = closing(quarters, radius)[2 * margin : -2 * margin, 2 * margin : -2 * margin]
            all_four = closed[::2, ::2] & closed[1::2, ::2] & closed[::2, 1::2] & closed[1::2, 1::2]
            part = slice(low - start, high - start), slice(first, last)
            cells[part] &= all_four | ~border[part]


def mosaics_of(
    blocks: Sequence[BlockRasters],
    window: CellWindow,
    step: RasterStep,
    outlines: Outlines,
    progress: Progress = SILENT,
) -> dict[str, Mosaic]:
    """Return the layers of all blocks inside their outlines, with the gaps there filled."""
    parts = iter(progress.shares(*[1.0] * (2 * len(step.layers) + 1)))
    survey, mosaics = outlines.survey(next(parts)), {}
    for name in step.layers:
        outline = outlines.terrain(survey, next(parts)) if name == "terrain" else survey
        mosaics[name] = Mosaic(blocks, name, window, step.cell, outline, outlines.water)
        loose = [block.loose[name] for block in blocks if name in block.loose]
        if loose and step.max_edge is None:
            vertices = np.concatenate(loose)
            row, column = window.places(vertices[:, 0], vertices[:, 1], (0.0, 0.0), step.cell)
            vertices = vertices[are_inside(row, column, window.shape)]
            mosaics[name].fill_gaps(vertices, next(parts))
    return mosaics
