"""Digital surface models: the top of all that stands on the terrain, and how high it stands."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core.parameters import ParameterSet, parameter
from ..core.points import Points
from ..core.progress import SILENT, Progress
from ..grids.surface import CellLattice, Surface
from ..rasters.geotiff import RasterGrid


@dataclass(frozen=True)
class SurfaceModel(ParameterSet):
    """Which points make the surface, and which gaps are left open."""

    surface_returns: str = parameter(
        "first",
        label="Returns of the surface model",
        choices={"first": "First and single returns", "all": "All returns"},
        help="The laser meets the top first. Take all returns where the return numbers of the file"
        " are wrong.",
    )
    max_edge: float | None = parameter(
        None,
        kind="number",
        label="Maximum edge",
        unit="m",
        minimum=0.1,
        maximum=100_000.0,
        help="Gaps between points are interpolated by triangles; those with a longer edge have no"
        " data instead, as water should. Empty: all gaps are interpolated, as far as the convex"
        " hull of the points.",
    )


def surface_heights(
    points: Points,
    grid: RasterGrid,
    progress: Progress = SILENT,
    max_edge: float | None = None,
) -> np.ndarray:
    """Return the highest point of each cell, and between them heights on their TIN.

    Parameters
    ----------
    points : Points
        All points of the surface.
    grid : RasterGrid
        Cells that cover them.
    progress : Progress
        Receives progress.
    max_edge : float, optional
        Triangles with a longer edge, in metres, have no data.

    Returns
    -------
    numpy.ndarray of float64, shape (rows, columns)
        Heights in metres; NaN outside the convex hull, and in gaps.
    """
    cell = _cells(points, grid)
    top = _highest(points, cell)
    heights = np.full(grid.rows * grid.columns, np.nan)
    heights[cell[top]] = points.z[top]
    progress(0.2)
    empty = np.flatnonzero(np.isnan(heights))
    if len(empty):
        row, column = np.divmod(empty, grid.columns)
        surface, cells = Surface(points.take(top)), CellLattice(grid.corner, grid.cell_metres)
        heights[empty] = surface.heights(
            grid.x[column], grid.y[row], max_edge, progress.part(0.2, 1.0), cells
        )
    progress(1.0)
    return heights.reshape(grid.rows, grid.columns)


def canopy_height(surface: np.ndarray, terrain: np.ndarray) -> np.ndarray:
    """Return how high the surface stands above the terrain, 0 where it lies below.

    Parameters
    ----------
    surface, terrain : numpy.ndarray of float, shape (rows, columns)
        Heights on the same grid; NaN where there is none.
    """
    return np.maximum(surface - terrain, 0.0)


def _cells(points: Points, grid: RasterGrid) -> np.ndarray:
    """Return the cell of each point, in the flattened grid."""
    unit, origin = grid.frame.horizontal_unit, grid.frame.origin
    column = np.floor((points.x / unit + (origin[0] - grid.west)) / grid.cell_size)
    row = np.floor(((grid.north - origin[1]) - points.y / unit) / grid.cell_size)
    # Points on the outer border of the last cells belong to them.
    column = np.clip(column, 0, grid.columns - 1).astype(np.intp)
    return np.clip(row, 0, grid.rows - 1).astype(np.intp) * grid.columns + column


def _highest(points: Points, cell: np.ndarray) -> np.ndarray:
    """Return the index of the highest point of each occupied cell; of equals, by x and y."""
    order = np.argsort(-points.z, kind="stable")
    order = order[np.argsort(cell[order], kind="stable")]
    inside = cell[order]
    first = np.ones(len(order), dtype=bool)
    first[1:] = np.diff(inside) != 0
    # Few points are as high as the highest of their cell: only those need be told apart.
    start = np.flatnonzero(first)
    number = np.repeat(np.arange(len(start)), np.diff(start, append=len(order)))
    equal = order[points.z[order] == points.z[order[start]][number]]
    order = np.lexsort((points.y[equal], points.x[equal], cell[equal]))
    first = np.ones(len(order), dtype=bool)
    first[1:] = np.diff(cell[equal[order]]) != 0
    return equal[order[first]]
