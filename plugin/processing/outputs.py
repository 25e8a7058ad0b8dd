"""What QGIS does with output files: their default format, and how they look as layers."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Iterable, Sequence

from qgis.core import (
    QgsProcessingAlgorithm,
    QgsProcessingContext,
    QgsProcessingParameterRasterDestination,
    QgsProcessingUtils,
)

from ...algorithms.engine.rasters import RasterFiles
from ...algorithms.las.backends import WRITING_COPC, missing_packages
from .. import compat
from .feedback import FeedbackProgress

# Name and label of each raster that can be made.
_RASTERS = {
    "DTM": "Terrain model (DTM)",
    "DSM": "Surface model (DSM)",
    "CHM": "Canopy height (CHM)",
    "HILLSHADE": "Hillshade",
    "CONFIDENCE": "Confidence of the terrain model",
}


def add_rasters(
    algorithm: QgsProcessingAlgorithm,
    names: Sequence[str] = tuple(_RASTERS),
    default: Sequence[str] = ("DTM", "HILLSHADE"),
) -> None:
    """Add fields for rasters, of which none has to be made; some are made by default."""
    for name in names:
        algorithm.addParameter(
            QgsProcessingParameterRasterDestination(
                name, _RASTERS[name], None, True, name in default
            )
        )


def raster_paths(
    algorithm: QgsProcessingAlgorithm,
    parameters: dict[str, Any],
    context: QgsProcessingContext,
) -> dict[str, str]:
    """Return the paths of the rasters that are wanted, by the names of their fields."""
    paths = {}
    for name in _RASTERS:
        if algorithm.parameterDefinition(name) is not None:
            path = algorithm.parameterAsOutputLayer(parameters, name, context)
            if path:
                paths[name] = path
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


def load_class_raster(
    source: str,
    ground_class: int,
    cell_size: float,
    context: QgsProcessingContext,
    progress: FeedbackProgress,
) -> str:
    """Make a raster of the classes of a file that this QGIS cannot show, and have it loaded.

    Returns
    -------
    str
        Its temporary file.
    """
    # Reads files, which takes packages that QGIS may lack.
    from ...algorithms.products.class_raster import write_class_raster

    path = QgsProcessingUtils.generateTempFilename("classes.tif")
    write_class_raster(Path(source), Path(path), cell_size, ground_class, progress)
    hint = QgsProcessingUtils.LayerHint.Raster
    details = QgsProcessingContext.LayerDetails("classes", context.project(), "classes", hint)
    context.addLayerToLoadOnCompletion(path, details)
    return path


def do_not_load(context: QgsProcessingContext, paths: Iterable[str]) -> None:
    """Take outputs off the list of layers to load."""
    layers = context.layersToLoadOnCompletion()
    for path in paths:
        layers.pop(path, None)
    context.setLayersToLoadOnCompletion(layers)
