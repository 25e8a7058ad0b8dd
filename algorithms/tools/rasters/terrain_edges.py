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


def follow_edges(
    heights: np.ndarray,
    window: CellWindow,
    cell: float,
    points: Points,
    edges: np.ndarray,
    corner: tuple[float, float],
) -> None:
    """Replace the heights of cells near lines, in place, by heights of the TIN of all points, which
    are ground and, as `edges` says, vertices along the lines.
    """
    # All is in metres; the points are relative to `corner` in the frame of the survey.
    reach = max(_CELLS * cell, _SPACINGS * spacing(points.take(~edges)))
    lines = points.take(edges)
    wide = math.ceil(reach / cell)
    row, column = window.wider(wide).places(lines.x, lines.y, corner, cell)
    touched = np.zeros((window.rows + 2 * wide, window.columns + 2 * wide), dtype=bool)
    inside = are_inside(row, column, touched.shape)
    touched[row[inside], column[inside]] = True
    near = within_square(np.maximum, touched, wide)[wide:-wide, wide:-wide]
    row, column = np.nonzero(near)
    if not len(row):
        return
    nearby = points.take(edges | NearPlaces(lines.x, lines.y, 2.0 * reach).of(points.x, points.y))
    x = (window.column + column + 0.5) * cell - corner[0]
    y = (window.row + row + 0.5) * cell - corner[1]
    found = Tin(*nearby).interpolate(x, y)
    known = ~np.isnan(found)
    heights[row[known], column[known]] = found[known]
