"""The fields for the grid and the extent of rasters."""

from __future__ import annotations

from typing import Any

from qgis.core import (
    QgsProcessingAlgorithm,
    QgsProcessingContext,
    QgsProcessingParameterExtent,
    QgsProcessingParameterRasterLayer,
)

from ...algorithms.rasters.cell_grid import RasterTarget
from .. import compat
from ..i18n import mark
from .inputs import CloudCrs, box_of, raster_of

_LIKE, _EXTENT = "LIKE", "RASTER_EXTENT"
_LIKE_HELP = (
    "All rasters get the grid of this raster: CRS, cell size, position of the cells, and extent. It"
    " must be in the CRS of the points, with square cells and north up. It replaces the cell size."
)
_EXTENT_HELP = (
    "The rasters cover this rectangle, widened to whole cells, which stay where they are. All"
    " points are used. Empty: where the points are."
)


def add_raster_target(algorithm: QgsProcessingAlgorithm) -> None:
    """Add the fields to a dialog, as advanced parameters."""
    like = QgsProcessingParameterRasterLayer(_LIKE, "Raster with the grid to use", None, True)
    extent = QgsProcessingParameterExtent(_EXTENT, "Extent of the rasters", None, True)
    for field, text in ((like, _LIKE_HELP), (extent, _EXTENT_HELP)):
        field.setFlags(field.flags() | compat.ADVANCED)
        algorithm.addParameter(field, text)


def raster_target_of(
    algorithm: QgsProcessingAlgorithm,
    parameters: dict[str, Any],
    context: QgsProcessingContext,
    crs: CloudCrs,
) -> RasterTarget:
    """Return what is in the fields, in the CRS of the points; the raster must be a file."""
    like = extent = None
    if not compat.is_empty(parameters.get(_LIKE)):
        text = mark("The raster with the grid to use is not a file. Export it as GeoTIFF first.")
        like = raster_of(algorithm, parameters, _LIKE, context, text).source()
    if not compat.is_empty(parameters.get(_EXTENT)):
        extent = box_of(algorithm, parameters, _EXTENT, context, crs)
    return RasterTarget(like, extent)
