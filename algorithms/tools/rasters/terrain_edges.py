"""Heights of the terrain beside lines that no triangle may cross."""

from __future__ import annotations

import math

import numpy as np

from ...core.points import Points
from ...grids.cell_window import CellWindow
from ...grids.cells import are_inside, spacing
from ...grids.lines import NearPlaces
from ...grids.morphology import within_square
from ...tin.triangulation import Tin

# Cells from a line, or distances between ground points, up to which the terrain is the TIN of all
# points. They are not thinned, so that two lines close together stay separate.
_CELLS = 3.0
_SPACINGS = 3.0


class TerrainAtEdges:
    """The TIN of all ground points near lines, which are the `edges` among these points."""

    def __init__(self, points: Points, edges: np.ndarray, cell: float) -> None:
        self.reach = max(_CELLS * cell, _SPACINGS * spacing(points.take(~edges)))
        self.lines = points.take(edges)
        near = NearPlaces(self.lines.x, self.lines.y, 2.0 * self.reach)
        self._tin = Tin(*points.take(edges | near.of(points.x, points.y)))

    def follow(self, heights: np.ndarray, x: np.ndarray, y: np.ndarray) -> None:
        """Replace the heights at places near the lines, in place."""
        near = np.flatnonzero(NearPlaces(self.lines.x, self.lines.y, self.reach).of(x, y))
        found = self._tin.interpolate(x[near], y[near])
        known = ~np.isnan(found)
        heights[near[known]] = found[known]

    def follow_in_cells(
        self, heights: np.ndarray, window: CellWindow, cell: float, corner: tuple[float, float]
    ) -> None:
        """Replace the heights of cells near the lines, in place; all is in metres, and the points
        are relative to `corner` in the frame of the survey.
        """
        wide = math.ceil(self.reach / cell)
        row, column = window.wider(wide).places(self.lines.x, self.lines.y, corner, cell)
        touched = np.zeros((window.rows + 2 * wide, window.columns + 2 * wide), dtype=bool)
        inside = are_inside(row, column, touched.shape)
        touched[row[inside], column[inside]] = True
        near = within_square(np.maximum, touched, wide)[wide:-wide, wide:-wide]
        row, column = np.nonzero(near)
        if not len(row):
            return
        x = (window.column + column + 0.5) * cell - corner[0]
        y = (window.row + row + 0.5) * cell - corner[1]
        found = self._tin.interpolate(x, y)
        known = ~np.isnan(found)
        heights[row[known], column[known]] = found[known]
