"""The lowest points of a survey, on cells for vertices of a TIN and on cells for objects."""

from __future__ import annotations

import numpy as np

from ...core.points import Points
from ...core.progress import Progress
from ...grids.cell_blocks import CellBlocks
from ...grids.cells import Cells, spacing
from .objects import PLATEAU_HEIGHT, Objects, raised_objects
from .outliers import lone_points, low_outliers, under_canopy

# A pit with steeper sides (rise over run) is a low outlier: no terrain is so steep.
_OUTLIER_SLOPE = 5.0
# Where points are closer than the second number of metres, objects are searched on cells of the
# first: in narrower ones gaps in crowns and roofs break the rims, in wider ones plazas and terraces
# become plateaus. Where points are farther apart, cells as wide as their spacing do.
_WIDE, _DENSE, _LEAST_SPACING = 2.0, 0.8, 0.01
# Heights in metres of the drops that bound an object, the tall ones first.
_OBJECT_HEIGHTS = (5.0, 4.5, 2.0)


class LowestPoints:
    """The lowest points of a survey.

    Parameters
    ----------
    points : Points
        All points.
    size : float
        Side of the cells in metres.
    classic : bool
        True for the rules of other programs' presets: every pit is a low outlier, and less of the
        border of an object must be a drop.
    shift : float
        Metres by which the cells begin farther west and south.

    Attributes
    ----------
    spacing : float
        Usual distance between points in metres.
    cells : Cells
        The cells.
    lowest : numpy.ndarray of intp
        The lowest point of each occupied cell.
    cell : numpy.ndarray of int32
        The cell of each, in the flattened grid.
    heights : numpy.ndarray of float64, shape (rows, columns)
        Their heights, without low outliers; NaN where there is none.
    """

    def __init__(
        self, points: Points, size: float, classic: bool = False, shift: float = 0.0
    ) -> None:
        self._points, self._classic, self._shift = points, classic, shift
        self.spacing = spacing(points)
        self.cells = Cells.over(points, size, shift)
        self.lowest = self.cells.lowest_points(points)
        self.cell = self.cells.index[self.lowest]
        heights = np.full(self.cells.rows * self.cells.columns, np.nan)
        heights[self.cell] = points.z[self.lowest]
        self.heights = self._without_outliers(heights.reshape(self.cells.shape), self.cells)

    def _without_outliers(self, heights: np.ndarray, cells: Cells) -> np.ndarray:
        spares = not self._classic
        pits = low_outliers(heights, cells.size, _OUTLIER_SLOPE, cells.first, spares)
        if spares:
            known = self.lowest if cells is self.cells else None
            pits &= ~under_canopy(pits, self._points, cells, known)
        heights[pits] = np.nan
        if spares:
            heights[lone_points(heights, cells, self._points.z)] = np.nan
        return heights

    def _wide(self) -> tuple[Cells, np.ndarray]:
        """Cells wide enough to be without gaps, which would break the rims of objects."""
        if self.spacing <= self.cells.size:
            return self.cells, self.heights
        cells = Cells.over(self._points, self.spacing, self._shift)
        return cells, self._without_outliers(cells.minimum(self._points.z), cells)

    def objects(self, max_size: float, progress: Progress) -> Objects:
        """Return which of `cells` belong to objects or plateaus, with drops all round.

        The presets of other programs use `cells` themselves, and no rule for plateaus.
        """
        cells, heights = self._wide()
        if self._classic:
            found = raised_objects(
                heights, cells.size, _OBJECT_HEIGHTS, max_size, progress, cells.first, True
            )
        else:
            is_dense = spacing(self._points, _LEAST_SPACING) < _DENSE
            blocks = CellBlocks.over(cells, _WIDE if is_dense else cells.size, 1)
            on_blocks = raised_objects(
                blocks.lowest(heights),
                blocks.size,
                _OBJECT_HEIGHTS,
                max_size,
                progress,
                blocks.first_block,
                plateau_height=PLATEAU_HEIGHT,
            )
            found = Objects(*(blocks.repeated(each, heights.shape) for each in on_blocks))
        return Objects(*(cells.resampled(each, self.cells) for each in found))
