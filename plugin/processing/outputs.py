"""What QGIS does with output files: their default format, and how they look as layers."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Iterable, Sequence

from qgis.core import (
    QgsProcessingAlgorithm,
    QgsProcessingContext,
    QgsProcessingParameterDefinition,
    QgsProcessingParameterFileDestination,
    QgsProcessingParameterFolderDestination,
    QgsProcessingParameterRasterDestination,
    QgsProcessingParameterVectorDestination,
)

from ...algorithms.engine.options import RasterOutput
from ...algorithms.engine.raster_files import RASTERS as MODELS
from ...algorithms.engine.raster_files import RasterFiles, virtual_of
from ...algorithms.las.backends import WRITING_COPC, missing_packages
from ...algorithms.survey.files import is_one_file
from .. import compat
from ..i18n import mark, tr

NOTHING_STAYS = mark("Cancelled; nothing was written.")
TILES_STAY = mark("Cancelled. The finished tiles stay, and a later run can continue with them.")
_MODELS = {name.upper(): each for name, each in MODELS.items()}
# Label and help of each raster that can be made, by the name of its field.
RASTERS = {
    **{name: (each.label, each.help) for name, each in _MODELS.items()},
    "RELIEF": (
        "Local relief",
        "The terrain model minus a smoothed one. Mounds, ditches and old paths stand out.",
    ),
}


def after_cancel(sources: Sequence[Path]) -> str:
    """Return what the log says after a cancel, of one file or of many."""
    return NOTHING_STAYS if is_one_file(sources) else TILES_STAY


def add_rasters(
    algorithm: QgsProcessingAlgorithm,
    names: Iterable[str] = _MODELS,
    default: Iterable[str] = ("DTM", "HILLSHADE"),
) -> None:
    """Add fields for rasters, of which none has to be made; some are made by default."""
    for name in names:
        label, text = RASTERS[name]
        algorithm.addParameter(
            QgsProcessingParameterRasterDestination(name, label, None, True, name in default), text
        )


def add_cloud(
    algorithm: QgsProcessingAlgorithm,
    label: str = "Classified point cloud",
    text: str = "The same points with their new classes.",
    optional: bool = False,
) -> None:
    """Add the field of a point cloud to be made, with its help."""
    field = compat.point_cloud_output("OUTPUT", label, point_cloud_formats())
    if optional:
        field.setFlags(field.flags() | QgsProcessingParameterDefinition.Flag.FlagOptional)
    algorithm.addParameter(field, text)


def add_tiles(algorithm: QgsProcessingAlgorithm) -> None:
    """Add the fields of many point clouds to be made."""
    folder, vpc = "Folder of the classified point clouds", "Virtual point cloud"
    filters = tr("{} files (*.{})").format("VPC", "vpc")
    algorithm.addParameter(
        QgsProcessingParameterFolderDestination("OUTPUT_FOLDER", folder),
        "The folder for the classified files. Each keeps its name.",
    )
    algorithm.addParameter(
        QgsProcessingParameterFileDestination("OUTPUT_VPC", vpc, filters, None, True, False),
        "A list of the classified files, which QGIS 3.32 and newer shows as one layer. Without a"
        " name it is classified.vpc in their folder.",
    )


def add_contours(algorithm: QgsProcessingAlgorithm) -> None:
    """Add the field of contour lines to be made."""
    field = QgsProcessingParameterVectorDestination(
        "CONTOURS", "Contour lines", optional=True, createByDefault=False
    )
    algorithm.addParameter(
        field, "Lines of equal height of the terrain model, with the field ELEV."
    )


def raster_paths(
    algorithm: QgsProcessingAlgorithm,
    parameters: dict[str, Any],
    context: QgsProcessingContext,
) -> dict[str, str]:
    """Return the paths of rasters and contour lines that are wanted, by their fields' names."""
    paths = {}
    for name in (*RASTERS, "CONTOURS"):
        if algorithm.parameterDefinition(name) is not None:
            path = algorithm.parameterAsOutputLayer(parameters, name, context)
            if path:
                paths[name] = path
    return paths


def shown_rasters(
    paths: dict[str, str], output: RasterOutput, context: QgsProcessingContext
) -> dict[str, str]:
    """Return what QGIS is to load of the rasters of many files: the virtual ones, if there are."""
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
    """Return those of the same that the classifier makes."""
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
