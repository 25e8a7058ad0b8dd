"""The field for a given terrain model."""

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


def add_terrain(algorithm: QgsProcessingAlgorithm, name: str, label: str, text: str) -> None:
    """Add a field for the raster to a dialog; `text` is its help."""
    algorithm.addParameter(QgsProcessingParameterRasterLayer(name, label, None, True), text)


def terrain_of(
    algorithm: QgsProcessingAlgorithm,
    parameters: dict[str, Any],
    context: QgsProcessingContext,
    name: str = DTM,
) -> str:
    """Return the file of the raster, empty if there is none; refuse a layer that is no file."""
    if compat.is_empty(parameters.get(name)):
        return ""
    text = mark("The terrain model is not a file. Export it as GeoTIFF first.")
    return raster_of(algorithm, parameters, name, context, text).source()
