"""The grid and the extent of rasters."""

from __future__ import annotations

from typing import Any

from qgis.core import QgsProcessingAlgorithm, QgsProcessingContext

from ...algorithms.rasters.cell_grid import RasterTarget
from .. import compat
from ..i18n import mark
from .inputs import CloudCrs, box_of, raster_of

_LIKE, _EXTENT = "LIKE", "RASTER_EXTENT"


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
