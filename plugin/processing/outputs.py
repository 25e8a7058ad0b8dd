"""Output fields, and the files and layers of outputs."""

from __future__ import annotations

from pathlib import Path
from typing import Iterable, Mapping

from qgis.core import (
    QgsProcessing,
    QgsProcessingAlgorithm,
    QgsProcessingContext,
    QgsProcessingFeedback,
    QgsProcessingOutputLayerDefinition,
    QgsProperty,
)

from ...algorithms.core.files import split_name
from ...algorithms.las.backends import WRITING_COPC, missing_packages
from ...algorithms.rasters.virtual import virtual_of
from ...algorithms.survey.files import Inputs
from ...algorithms.tools.rasters.parameters import RasterOutput
from .. import compat

_OF_MODELS = "QgsProcessingMultiStepFeedback"
NOTHING_STAYS = "Cancelled; nothing was written."
TILES_STAY = "Cancelled. The finished tiles stay, and a later run can continue with them."


def after_cancel(inputs: Inputs) -> str:
    """Return the message in the log after a cancel, for one file or for many."""
    return TILES_STAY if inputs.is_survey else NOTHING_STAYS


def given_path(value: object, context: QgsProcessingContext) -> Path | None:
    """Return the path that the user gave for an output; None if QGIS makes one up, or for none."""
    value = _given(value, context)
    if compat.is_empty(value) or value == QgsProcessing.TEMPORARY_OUTPUT:
        return None
    return Path(value) if isinstance(value, (str, Path)) else None


def is_blank(parameters: Mapping[str, object], name: str, context: QgsProcessingContext) -> bool:
    """Return whether the user left an output empty, as tables of batch runs do with text."""
    return name in parameters and bool(compat.is_empty(_given(parameters[name], context)))


def with_outputs_of_step(
    algorithm: QgsProcessingAlgorithm,
    parameters: dict[str, object],
    context: QgsProcessingContext,
    feedback: QgsProcessingFeedback,
) -> dict[str, object]:
    """Return the parameters of a step of a model with temporary files for outputs that the user
    left empty; those of other runs as they are.
    """
    # A model has an output in the parameters of a step if a later step may read it. QGIS makes a
    # temporary file of it only if it is no output of the model.
    if not feedback.inherits(_OF_MODELS):
        return parameters
    made = {
        output.name(): output.generateTemporaryDestination()
        for output in algorithm.destinationParameterDefinitions()
        if is_blank(parameters, output.name(), context)
    }
    return {**parameters, **made}


def _given(value: object, context: QgsProcessingContext) -> object:
    """Return the text in the value of an output."""
    if isinstance(value, QgsProcessingOutputLayerDefinition):
        value = value.sink
    if isinstance(value, QgsProperty):
        value, _ = value.valueAsString(context.expressionContext(), "")
    return value


def places_of(
    algorithm: QgsProcessingAlgorithm,
    parameters: dict[str, object],
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


def point_cloud_formats() -> list[str]:
    """Return the extensions of point clouds that can be written, first one that this QGIS can load,
    or else that of the smallest files.
    """
    if missing_packages(WRITING_COPC):
        return ["las"]
    if compat.can_load("x.copc.laz") and not compat.can_load("x.laz"):
        return ["copc.laz", "laz", "las"]
    return ["laz", "las", "copc.laz"]


def cannot_show(path: str, when: str = "is") -> str:
    """Return a line of the log on a point cloud that QGIS cannot show, with what it can."""
    hint = ""
    if compat.can_load("x.copc.laz") and not path.lower().endswith((".copc.laz", ".vpc")):
        hint = " QGIS shows files whose names end with .copc.laz."
    return f"This QGIS cannot show such a file as a layer. It {when} at {path}.{hint}"


def do_not_load(context: QgsProcessingContext, paths: Iterable[str]) -> None:
    """Remove outputs from the list of layers to load."""
    layers = context.layersToLoadOnCompletion()
    for path in paths:
        layers.pop(path, None)
    context.setLayersToLoadOnCompletion(layers)
