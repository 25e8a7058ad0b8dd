"""Where rasters end: the outlines of the survey, of the terrain and of the canopy.

The survey is the closing of the cells with points by a disc, with all gaps inside. The terrain is
the same of the cells with ground points. Water with a level counts as points and as ground. A place
is in a closing if no disc round it is free of points. So the triangles there have circumcircles
smaller than the disc, and no slivers along the hull take part.
"""

from __future__ import annotations

import math
from typing import Callable, NamedTuple, Sequence

import numpy as np

from ...core.errors import BareEarthError
from ...core.progress import SILENT, Progress
from ...core.words import option
from ...grids.cell_window import CellWindow
from ...grids.cells import are_inside
from ...grids.morphology import closing, within_square
from ...grids.outline import MOST_CELLS, Discs, Outline, Span, spans, with_gaps_inside
from .block import ANY, CONTENTS, QUARTERS, BlockRasters, LayerMaker
from .level_water import NO_WATER_CELLS, WaterCells
from .mosaic import Mosaic, joined

# Radius of the discs in usual distances between points. These are not less than a cell.
_SPACINGS = 4.0
# Least radius in metres for ground, but not in more cells than this: ground points are farther
# apart under trees than elsewhere.
_LEAST_OF_GROUND = 10.0
# Cells: side of the squares in which cells with points are counted.
_SQUARE = 16
# Fewest cells with points of a usual square for a sound distance; else squares are joined.
_FEWEST = 16
# Cells that may be read at a time to close the gaps between points.
_MOST_AT_ONCE = 1_000_000_000
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
        self._windows = np.array([block.window for block in blocks], dtype=np.int64).reshape(-1, 4)

    def meets(self, span: Span) -> bool:
        """Return whether a block or water can have cells in a span."""
        window = self.window.part(*span)
        row, column, rows, columns = self._windows.T
        apart = (row >= window.row + window.rows) | (row + rows <= window.row)
        apart |= (column >= window.column + window.columns) | (column + columns <= window.column)
        return self.water.meets(window) or not apart.all()

    def points(self, span: Span) -> np.ndarray:
        """Return which cells contain any point or water, as `Read`."""
        return self.of_water(span) | (self._of(span) >= ANY)

    def ground(self, span: Span) -> np.ndarray:
        """Return which cells contain ground points or water, as `Read`."""
        return self.of_water(span) | (self._of(span) % ANY > 0)

    def of_water(self, span: Span) -> np.ndarray:
        """Return which cells lie in water with a level, as `Read`."""
        return self.water.inside(self.window.part(*span))[::-1]

    def _of(self, span: Span) -> np.ndarray:
        contents = joined(self._blocks, CONTENTS, self.window.part(*span), np.uint8(0))[::-1]
        # Beyond the columns of the survey nothing counts.
        contents[:, : max(-span.first, 0)] = 0
        contents[:, max(self.window.columns - span.first, 0) :] = 0
        return contents

    def quarters(self, span: Span) -> np.ndarray:
        """Return which quarters of cells contain ground points; bool, twice as many each way."""
        contents = self._of(span)
        quarters = np.zeros((2 * contents.shape[0], 2 * contents.shape[1]), dtype=bool)
        for number in range(QUARTERS):
            # Rows go from north to south, so the northern quarters come first.
            quarters[1 - number // 2 :: 2, number % 2 :: 2] = contents & (1 << number)
        return quarters | self.of_water(span).repeat(2, axis=0).repeat(2, axis=1)

    def spacings(self) -> tuple[float, float]:
        """Return the usual distances, in cells, between cells with points and with ground."""
        window, found = self.window, [_NO_SQUARES]
        first = window.row // _SQUARE, window.column // _SQUARE
        for block in self._blocks:
            shared = block.window.within(window)
            if shared.is_empty:
                continue
            contents = block.layers[CONTENTS][block.window.slices(shared)]
            (rows, at_rows), (columns, at_columns) = (
                np.unique((start + np.arange(count)) // _SQUARE, return_index=True)
                for start, count in zip(shared[:2], shared.shape)
            )
            of_block = []
            for holding in (contents >= ANY, contents % ANY > 0):
                along = np.add.reduceat(holding, at_rows, axis=0, dtype=np.int64)
                of_block.append(np.add.reduceat(along, at_columns, axis=1).ravel())
            row, column = np.meshgrid(rows - first[0], columns - first[1], indexing="ij")
            found.append(np.array([row.ravel(), column.ravel(), *of_block]))
        row, column, *counts = np.concatenate(found, axis=1)
        across = max(
            (start + side) // _SQUARE - start // _SQUARE + 1
            for start, side in zip(window[:2], window.shape)
        )
        of_all, of_ground = (
            _apart(Squares.of(row, column, count), across, math.prod(window.shape))
            for count in counts
        )
        return of_all, of_ground


class Squares(NamedTuple):
    """Numbers of cells in the squares that have any; int64 (n,), by row and column from 0."""

    row: np.ndarray
    column: np.ndarray
    cells: np.ndarray

    @classmethod
    def of(cls, row: np.ndarray, column: np.ndarray, cells: np.ndarray) -> Squares:
        """Return the squares, some of them several times."""
        has = cells > 0
        width = int(column.max(initial=0)) + 1
        places, back = np.unique(row[has] * width + column[has], return_inverse=True)
        total = np.zeros(len(places), dtype=np.int64)
        np.add.at(total, back.ravel(), cells[has])
        return cls(places // width, places % width, total)

    @property
    def usual(self) -> float:
        """The median number of cells, of squares all of whose neighbours have any, if there are."""
        width = int(self.column.max()) + 3
        places = self.row * width + self.column
        within = np.ones(len(places), dtype=bool)
        for beside in (-width - 1, -width, -width + 1, -1, 1, width - 1, width, width + 1):
            within &= np.isin(places + beside, places)
        return float(np.median(self.cells[within] if within.any() else self.cells))

    def joined(self) -> Squares:
        """Return squares of twice the side."""
        return Squares.of(self.row // 2, self.column // 2, self.cells)


_NO_SQUARES = np.zeros((4, 0), dtype=np.int64)


def _apart(squares: Squares, across: int, area: int) -> float:
    """Return the usual distance of the cells that are counted in squares of `_SQUARE` cells, in a
    raster of `area` cells that is up to `across` squares wide and high.
    """
    # It is never more than if they were spread evenly over the raster: a small one is only a part
    # of a square.
    if not len(squares.cells):
        return 1.0
    side, widest = _SQUARE, math.sqrt(area / int(squares.cells.sum()))
    while squares.usual < _FEWEST and across > 1:
        squares, side, across = squares.joined(), 2 * side, -(-across // 2)
    return max(min(side / math.sqrt(squares.usual), widest), 1.0)


def _radius(cells: float) -> float:
    """Return the radius of a disc whose border has no single cells, about as large."""
    return math.floor(cells) + 0.5


class Outlines:
    """The outlines of the rasters of a survey, made when they are needed."""

    def __init__(self, contents: CellContents, step: LayerMaker) -> None:
        window, cell = contents.window, step.cell
        self._contents, self._shape = contents, window.shape
        self._longest, self.water = step.longest_edge / cell, contents.water
        self._corner = window.row + window.rows, window.column
        of_all, of_ground = contents.spacings()
        near = _radius(_SPACINGS * of_all)
        self._of_points = Discs(contents.points, self._corner, near, near)
        least = min(_LEAST_OF_GROUND / cell, MOST_CELLS - 1)
        self._near_ground = _radius(max(_SPACINGS * of_ground, least))
        if self._of_points.most_at_once > _MOST_AT_ONCE < math.prod(self._shape):
            rows, columns = self._shape
            raise BareEarthError(
                f"The rasters would have {columns:,} x {rows:,} cells of {cell:g} m for points that"
                f" lie some {of_all * cell:,.0f} m apart. Choose a larger cell size, or give the"
                f" extent of the rasters ({option('raster_extent')})."
            )

    def survey(self, progress: Progress = SILENT) -> Outline:
        """Return the outline of all points."""
        return with_gaps_inside(self._closed, self._shape, progress, self._near_by(self._of_points))

    def _closed(self, span: Span) -> np.ndarray:
        return self._of_points.cells(span) | self._contents.points(span)

    def _near_by(self, discs: Discs) -> Callable[[Span], bool]:
        """Return a function that tells which spans discs can reach."""
        return lambda span: self._contents.meets(span.wider(discs.margin))

    def terrain(self, survey: Outline, progress: Progress = SILENT) -> Outline:
        """Return where the terrain is known; `survey` is the outline of all points."""
        ground = Discs(self._contents.ground, self._corner, self._near_ground, self._near_ground)
        part, near = progress.part(0.0, 0.8), self._near_by(ground)
        wide = with_gaps_inside(ground.cells, self._shape, part, near)
        inside = Outline(self._shape)
        for span in spans(self._shape):
            around = span.wider(1)
            if wide.meets(around) or self._contents.water.meets(self._contents.window.part(*span)):
                cells = wide.cells(around)
                if ground.group == 1:
                    self._refine(cells, around)
                cells = cells[1:-1, 1:-1] & survey.cells(span)
                inside.set(span, cells | self._contents.of_water(span))
            progress(0.8 + 0.2 * span.end / self._shape[0])
        return inside

    def canopy(self, progress: Progress = SILENT) -> Outline:
        """Return where the surface was measured, and the terrain nearby."""
        measured = Outline(self._shape)
        ground = Discs(self._contents.ground, self._corner, self._longest, 0.0)
        for span in filter(self._near_by(self._of_points), spans(self._shape)):
            measured.set(span, self._closed(span) & ground.cells(span))
            progress(span.end / self._shape[0])
        return measured

    def _refine(self, cells: np.ndarray, span: Span) -> None:
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
            part = slice(int(rows[0]), int(rows[-1]) + 1), slice(first, last)
            sides = zip((span.start, span.first), part)
            ends = (start + end for start, side in sides for end in (side.start, side.stop))
            quarters = self._contents.quarters(Span(*ends).wider(margin))
            closed = closing(quarters, radius)[2 * margin : -2 * margin, 2 * margin : -2 * margin]
            all_four = closed[::2, ::2] & closed[1::2, ::2] & closed[::2, 1::2] & closed[1::2, 1::2]
            cells[part] &= all_four | ~border[part]


def mosaics_of(
    blocks: Sequence[BlockRasters],
    window: CellWindow,
    step: LayerMaker,
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
