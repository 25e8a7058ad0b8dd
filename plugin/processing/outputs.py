"""What QGIS does with output files: their default format, and how they look as layers."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Iterable, Sequence

from qgis.core import (
    QgsMapLayer,
    QgsPointCloudCategory,
    QgsPointCloudClassifiedRenderer,
    QgsPointCloudLayer,
    QgsProcessingAlgorithm,
    QgsProcessingContext,
    QgsProcessingFeedback,
    QgsProcessingLayerPostProcessorInterface,
    QgsProcessingParameterRasterDestination,
    QgsRasterLayer,
)
from qgis.PyQt.QtGui import QColor

from ...algorithms.engine.rasters import RasterFiles
from ...algorithms.las.backends import WRITING_COPC, missing_packages
from .. import compat

# QGIS calls them after the algorithm is gone, and owns the C++ half of each: one for each layer,
# and a reference here that keeps the Python half.
_KEPT: list[QgsProcessingLayerPostProcessorInterface] = []


# Name and label of each raster that can be made.
_RASTERS = {
    "DTM": "Terrain model (DTM)",
    "DSM": "Surface model (DSM)",
    "CHM": "Canopy height (CHM)",
    "HILLSHADE": "Hillshade",
    "CONFIDENCE": "Confidence of the terrain model",
}


def add_rasters(
    algorithm: QgsProcessingAlgorithm, names: Sequence[str] = tuple(_RASTERS), default: str = "DTM"
) -> None:
    """Add fields for rasters, of which none has to be made; one of them is made by default."""
    for name in names:
        algorithm.addParameter(
            QgsProcessingParameterRasterDestination(
                name, _RASTERS[name], None, True, name == default
            )
        )


def raster_paths(
    algorithm: QgsProcessingAlgorithm,
    parameters: dict[str, Any],
    context: QgsProcessingContext,
) -> dict[str, str]:
    """Return the paths of the rasters that are wanted, by the names of their fields.

    Heights get the property of elevation.
    """
    paths = {}
    for name in _RASTERS:
        if algorithm.parameterDefinition(name) is not None:
            path = algorithm.parameterAsOutputLayer(parameters, name, context)
            if path:
                paths[name] = path
    for name in {"DTM", "DSM"} & set(paths):
        style(context, paths[name], ElevationStyle())
    return paths


def raster_files(paths: dict[str, str]) -> RasterFiles:
    """Return the same for the classifier."""
    return RasterFiles(**{name.lower(): Path(path) for name, path in paths.items()})


def point_cloud_formats() -> list[str]:
    """Return the extensions of point clouds that can be written; the default comes first.

    The default is what this QGIS can load, if any, or else the smallest that can be written.
    """
    if missing_packages(WRITING_COPC):
        return ["las"]
    if compat.can_load("x.copc.laz") and not compat.can_load("x.laz"):
        return ["copc.laz", "laz", "las"]
    return ["laz", "las", "copc.laz"]


class ClassStyle(QgsProcessingLayerPostProcessorInterface):
    """Colours a point cloud by class.

    Parameters
    ----------
    classes : iterable of int
        The classes to show: QGIS would list all that there could be, and hide those above 18.
    """

    def __init__(self, classes: Iterable[int]) -> None:
        super().__init__()
        self._classes = sorted(classes)

    def postProcessLayer(
        self, layer: QgsMapLayer, context: QgsProcessingContext, feedback: QgsProcessingFeedback
    ) -> None:
        """Set the renderer; QGIS calls it once the layer is loaded."""
        if isinstance(layer, QgsPointCloudLayer):
            known = {
                each.value(): each for each in QgsPointCloudClassifiedRenderer.defaultCategories()
            }
            categories = [known.get(each) or _category(each) for each in self._classes]
            renderer = QgsPointCloudClassifiedRenderer()
            renderer.setAttribute("Classification")
            renderer.setCategories(categories)
            layer.setRenderer(renderer)
            layer.triggerRepaint()


def _category(value: int) -> QgsPointCloudCategory:
    """Return how to show a class that has no usual colour: one that differs with its number."""
    return QgsPointCloudCategory(value, QColor.fromHsv(47 * value % 360, 140, 200), f"{value}")


class ElevationStyle(QgsProcessingLayerPostProcessorInterface):
    """Marks a raster as elevation, for 3D views and profiles."""

    def postProcessLayer(
        self, layer: QgsMapLayer, context: QgsProcessingContext, feedback: QgsProcessingFeedback
    ) -> None:
        """Set the property; QGIS calls it once the layer is loaded."""
        if isinstance(layer, QgsRasterLayer):
            compat.mark_as_elevation(layer)


def style(
    context: QgsProcessingContext,
    path: str,
    processor: QgsProcessingLayerPostProcessorInterface,
) -> None:
    """Let `processor` work on the layer of an output, if QGIS is going to load it."""
    if path and context.willLoadLayerOnCompletion(path):
        _KEPT.append(processor)
        context.layerToLoadOnCompletionDetails(path).setPostProcessor(processor)


def do_not_load(context: QgsProcessingContext, paths: Iterable[str]) -> None:
    """Take outputs off the list of layers to load."""
    layers = context.layersToLoadOnCompletion()
    for path in paths:
        layers.pop(path, None)
    context.setLayersToLoadOnCompletion(layers)
