"""The field for a given terrain model, above which heights are measured."""

from __future__ import annotations

from typing import Any

from qgis.core import (
    QgsProcessingAlgorithm,
    QgsProcessingContext,
    QgsProcessingParameterRasterLayer,
)

from .. import compat
from ..i18n import mark
from .inputs import raster_of

DTM = "DTM"


def add_terrain(algorithm: QgsProcessingAlgorithm, text: str = "") -> None:
    """Add the field to a dialog; `text` is its help, if heights are not measured above it."""
    algorithm.addParameter(
        QgsProcessingParameterRasterLayer(DTM, "Terrain model", None, True),
        text
        or "Heights are measured above this raster, and not above the ground points. It must have"
        " the CRS of the points. Empty: above the ground points.",
    )


def terrain_of(
    algorithm: QgsProcessingAlgorithm, parameters: dict[str, Any], context: QgsProcessingContext
) -> str:
    """Return the file of the raster, empty if there is none; refuse a layer that is no file."""
    if compat.is_empty(parameters.get(DTM)):
        return ""
    text = mark("The terrain model is not a file. Export it as GeoTIFF first.")
    return raster_of(algorithm, parameters, DTM, context, text).source()
