"""Output fields, and the files and layers of outputs."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Iterable

from qgis.core import (
    QgsProcessing,
    QgsProcessingAlgorithm,
    QgsProcessingContext,
    QgsProcessingOutputLayerDefinition,
    QgsProcessingParameterRasterDestination,
    QgsProcessingParameterVectorDestination,
    QgsProperty,
)

from ...algorithms.core.files import split_name
from ...algorithms.las.backends import WRITING_COPC, missing_packages
from ...algorithms.rasters.virtual import virtual_of
from ...algorithms.survey.files import Inputs
from ...algorithms.tools.rasters.parameters import RasterOutput
from ...algorithms.tools.rasters.rows import RASTERS, RasterFiles
from .. import compat

NOTHING_STAYS = "Cancelled; nothing was written."
TILES_STAY = "Cancelled. The finished tiles stay, and a later run can continue with them."


def after_cancel(inputs: Inputs) -> str:
    """Return the message in the log after a cancel, for one file or for many."""
    return TILES_STAY if inputs.is_survey else NOTHING_STAYS


def add_rasters(
    algorithm: QgsProcessingAlgorithm,
    names: Iterable[str],
    default: Iterable[str] = ("dtm", "hillshade"),
) -> None:
    """Add optional fields for rasters; `default` names those that are made by default."""
    for name in names:
        row, is_default = RASTERS[name], name in default
        field = QgsProcessingParameterRasterDestination(
            name.upper(), row.label, None, True, is_default
        )
        algorithm.addParameter(field, row.help)


def usual_rasters(*reliefs: str) -> list[str]:
    """Return the names of all rasters, but only of some that *Relief of a terrain model* makes."""
    return [name for name, row in RASTERS.items() if not row.is_relief or name in reliefs]


def add_cloud(algorithm: QgsProcessingAlgorithm) -> None:
    """Add the optional field of an output point cloud."""
    field = compat.point_cloud_output("OUTPUT", "Classified point cloud", point_cloud_formats())
    field.setFlags(field.flags() | compat.OPTIONAL)
    algorithm.addParameter(field, "The same points with their new classes.")


def add_contours(algorithm: QgsProcessingAlgorithm) -> None:
    """Add the field of contour lines."""
    field = QgsProcessingParameterVectorDestination(
        "CONTOURS", "Contour lines", optional=True, createByDefault=False
    )
    algorithm.addParameter(
        field,
        "Lines of equal height of the terrain model, with the field ELEV. They are smoothed, so"
        " that they do not show noise. Every fifth line has its height as a label.",
    )


def raster_paths(
    algorithm: QgsProcessingAlgorithm,
    parameters: dict[str, Any],
    context: QgsProcessingContext,
) -> dict[str, str]:
    """Return the paths of the wanted rasters and contour lines, by the names of their fields."""
    paths = {}
    for name in (*map(str.upper, RASTERS), "CONTOURS"):
        if algorithm.parameterDefinition(name) is not None:
            path = algorithm.parameterAsOutputLayer(parameters, name, context)
            if path:
                paths[name] = path
    return paths


def given_path(value: Any, context: QgsProcessingContext) -> Path | None:
    """Return the path that the user gave for an output; None if QGIS makes one up, or for none."""
    if isinstance(value, QgsProcessingOutputLayerDefinition):
        value = value.sink
    if isinstance(value, QgsProperty):
        value, _ = value.valueAsString(context.expressionContext(), "")
    if compat.is_empty(value) or value == QgsProcessing.TEMPORARY_OUTPUT:
        return None
    return Path(value) if isinstance(value, (str, Path)) else None


def places_of(
    algorithm: QgsProcessingAlgorithm,
    parameters: dict[str, Any],
    context: QgsProcessingContext,
) -> list[Path]:
    """Return the files and folders that the user chose for outputs, and what is made of them."""
    places = []
    for output in algorithm.destinationParameterDefinitions():
        path = given_path(parameters.get(output.name()), context)
        if path is not None:
            # Many files become a folder, and a virtual raster.
            places += [path, virtual_of(path), path.with_name(split_name(path)[0])]
            places.append(class_raster_of(path))
    return places


def class_raster_of(cloud: Path) -> Path:
    """Return the raster that shows the classes of a cloud that QGIS cannot show."""
    return cloud.with_name(f"{split_name(cloud)[0]}_classes.tif")


def shown_rasters(
    paths: dict[str, str], output: RasterOutput, context: QgsProcessingContext
) -> dict[str, str]:
    """Return the rasters of many files that QGIS will load: the virtual rasters, if they exist."""
    if not output.raster_per_file:
        return paths
    layers = context.layersToLoadOnCompletion()
    found = {name: str(virtual_of(Path(path))) for name, path in paths.items()}
    for name, path in paths.items():
        if path in layers:
            layers[found[name]] = layers.pop(path)
    context.setLayersToLoadOnCompletion(layers)
    return found


def raster_files(paths: dict[str, str]) -> RasterFiles:
    """Return the rasters of `raster_paths` that the classifier makes."""
    return RasterFiles(**{name: paths.get(name.upper()) for name in RASTERS})


def point_cloud_formats() -> list[str]:
    """Return the extensions of point clouds that can be written, first one that this QGIS can load,
    or else that of the smallest files.
    """
    if missing_packages(WRITING_COPC):
        return ["las"]
    if compat.can_load("x.copc.laz") and not compat.can_load("x.laz"):
        return ["copc.laz", "laz", "las"]
    return ["laz", "las", "copc.laz"]


def do_not_load(context: QgsProcessingContext, paths: Iterable[str]) -> None:
    """Remove outputs from the list of layers to load."""
    layers = context.layersToLoadOnCompletion()
    for path in paths:
        layers.pop(path, None)
    context.setLayersToLoadOnCompletion(layers)
