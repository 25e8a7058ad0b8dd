"""Digital terrain models: heights interpolated on the TIN of the ground points."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core.parameters import ParameterSet, parameter, parameter_of
from ..core.points import Points
from ..core.progress import SILENT, Progress
from ..grids.dense_surface import VERTICES_A_SIDE, DenseSurface
from ..grids.tin import hull_corners
from ..rasters.geotiff import RasterGrid


@dataclass(frozen=True)
class TerrainModel(ParameterSet):
    """How to make the rasters of the terrain."""

    dtm_cell_size: float = parameter(
        1.0,
        label="Cell size of the terrain model",
        unit="m",
        minimum=0.01,
        maximum=1000.0,
        help="Side of a cell of the terrain model and of its hillshade. About the distance between "
        "ground points is sensible; smaller cells only make the file larger.",
    )
    hillshade_light: str = parameter(
        "one",
        label="Light of the hillshade",
        choices={
            "one": "One light",
            "multidirectional": "Four lights, from southwest to north",
        },
        advanced=True,
        help="One light shows best what lies across it, and leaves slopes that turn away in the"
        " dark. Four lights show landforms of any direction.",
    )
    hillshade_azimuth: float = parameter(
        315.0,
        label="Hillshade azimuth",
        unit="deg",
        minimum=0.0,
        maximum=360.0,
        advanced=True,
        help="Where one light comes from, clockwise from north; four have their own directions.",
    )
    hillshade_altitude: float = parameter(
        45.0,
        label="Hillshade altitude",
        unit="deg",
        minimum=0.0,
        maximum=90.0,
        advanced=True,
        help="How high the light stands above the horizon.",
    )


@dataclass(frozen=True)
class MapTerrain(TerrainModel):
    """The same for a map of any land, whose landforms run in any direction."""

    hillshade_light: str = parameter_of(TerrainModel, "hillshade_light", default="multidirectional")


def interpolate(
    points: Points,
    grid: RasterGrid,
    progress: Progress = SILENT,
    max_edge: float | None = None,
) -> np.ndarray:
    """Interpolate heights linearly on the TIN of `points`, at the centres of the grid's cells.

    Parameters
    ----------
    points : Points
        The ground points; of those that share a quarter of a cell, the one nearest to its centre
        is used, and the corners of the convex hull, so that no cell within it stays empty.
    grid : RasterGrid
        Where heights are wanted.
    progress : Progress
        Receives progress.
    max_edge : float, optional
        Triangles with a longer edge, in metres, have no data.

    Returns
    -------
    numpy.ndarray of float64, shape (rows, columns)
        Heights in metres; NaN outside the convex hull, and in gaps.
    """
    surface = DenseSurface(points, grid.cell_metres, grid.corner)
    return surface.raster((0, 0), (grid.rows, grid.columns), max_edge, progress)[::-1]


def vertices_of(points: Points, cell_size: float) -> np.ndarray:
    """Return the indices of the points that a terrain model is made of, in ascending order.

    What is left of points that were thinned part by part is the same as of all at once.

    Parameters
    ----------
    points : Points
        Ground points.
    cell_size : float
        Side of the cells of the model in metres.
    """
    vertices = _nearest_to_centre(points, cell_size / VERTICES_A_SIDE)
    if points.count:
        vertices = np.union1d(vertices, hull_corners(points.x, points.y))
    return vertices


def _nearest_to_centre(points: Points, cell: float) -> np.ndarray:
    """Return the index of the point nearest to the centre of each occupied cell."""
    column, row = np.floor(points.x / cell), np.floor(points.y / cell)
    distance = (points.x / cell - column - 0.5) ** 2 + (points.y / cell - row - 0.5) ** 2
    order = np.lexsort((points.z, distance, column, row))
    first = np.ones(len(order), dtype=bool)
    first[1:] = (np.diff(column[order]) != 0) | (np.diff(row[order]) != 0)
    return order[first]
