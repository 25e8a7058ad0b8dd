"""What QGIS does with output files: their default format, and how they look as layers."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Iterable

from qgis.core import (
    QgsProcessingAlgorithm,
    QgsProcessingContext,
    QgsProcessingParameterDefinition,
    QgsProcessingParameterRasterDestination,
)

from ...algorithms.engine.rasters import RasterFiles
from ...algorithms.las.backends import WRITING_COPC, missing_packages
from .. import compat

# Name and label of each raster that can be made.
RASTERS = {
    "DTM": "Terrain model (DTM)",
    "DSM": "Surface model (DSM)",
    "CHM": "Canopy height (CHM)",
    "HILLSHADE": "Hillshade",
    "CONFIDENCE": "Confidence of the terrain model",
    "RELIEF": "Local relief",
}
_MODELS = ("DTM", "DSM", "CHM", "HILLSHADE", "CONFIDENCE")


def add_rasters(
    algorithm: QgsProcessingAlgorithm,
    names: Iterable[str] = _MODELS,
    default: Iterable[str] = ("DTM", "HILLSHADE"),
) -> None:
    """Add fields for rasters, of which none has to be made; some are made by default."""
    for name in names:
        algorithm.addParameter(
            QgsProcessingParameterRasterDestination(
                name, RASTERS[name], None, True, name in default
            )
        )


def add_cloud(algorithm: QgsProcessingAlgorithm, label: str, optional: bool = False) -> None:
    """Add the field of a point cloud to be made."""
    field = compat.point_cloud_output("OUTPUT", label, point_cloud_formats())
    if optional:
        field.setFlags(field.flags() | QgsProcessingParameterDefinition.Flag.FlagOptional)
    algorithm.addParameter(field)


def raster_paths(
    algorithm: QgsProcessingAlgorithm,
    parameters: dict[str, Any],
    context: QgsProcessingContext,
) -> dict[str, str]:
    """Return the paths of the rasters that are wanted, by the names of their fields."""
    paths = {}
    for name in RASTERS:
        if algorithm.parameterDefinition(name) is not None:
            path = algorithm.parameterAsOutputLayer(parameters, name, context)
            if path:
                paths[name] = path
    return paths


def raster_files(paths: dict[str, str]) -> RasterFiles:
    """Return the same for the classifier."""
    given = {name.lower(): Path(path) for name, path in paths.items() if name in _MODELS}
    return RasterFiles(**given)


def point_cloud_formats() -> list[str]:
    """Return the extensions of point clouds that can be written; the default comes first.

    The default is what this QGIS can load, if any, or else the smallest that can be written.
    """
    if missing_packages(WRITING_COPC):
        return ["las"]
    if compat.can_load("x.copc.laz") and not compat.can_load("x.laz"):
        return ["copc.laz", "laz", "las"]
    return ["laz", "las", "copc.laz"]


def do_not_load(context: QgsProcessingContext, paths: Iterable[str]) -> None:
    """Take outputs off the list of layers to load."""
    layers = context.layersToLoadOnCompletion()
    for path in paths:
        layers.pop(path, None)
    context.setLayersToLoadOnCompletion(layers)
