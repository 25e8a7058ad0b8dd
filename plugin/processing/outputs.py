"""Output fields, and the files and layers of outputs."""

from __future__ import annotations

from pathlib import Path
from typing import Iterable

from qgis.core import (
    QgsProcessing,
    QgsProcessingContext,
    QgsProcessingFeedback,
    QgsProcessingOutputLayerDefinition,
    QgsProcessingParameterDefinition,
    QgsProcessingParameterFileDestination,
    QgsProcessingParameterFolderDestination,
    QgsProcessingParameterRasterDestination,
    QgsProcessingParameterVectorDestination,
    QgsProperty,
)

from ...algorithms.core.errors import OutputInUse
from ...algorithms.core.files import split_name
from ...algorithms.las.backends import WRITING_COPC, missing_packages
from ...algorithms.rasters.virtual import virtual_of
from ...algorithms.survey.feature_files import FORMATS
from ...algorithms.survey.files import Inputs
from ...algorithms.survey.outputs import check_kind
from ...algorithms.survey.vpc import SUFFIX
from ...algorithms.tools.declaration import Output
from .. import compat
from ..i18n import mark, tr
from ..styles import loaded
from .feedback import Refusal
from .request import Request

CLOUDS = ("cloud", "points")  # kinds of outputs that are files of points
# What reads the path of an output of a kind: parameterAsOutputLayer, and so on.
_READ = {
    **dict.fromkeys(CLOUDS, compat.POINT_CLOUD_OUTPUT),
    **dict.fromkeys(("raster", "features"), "OutputLayer"),
}
_OF_MODELS = "QgsProcessingMultiStepFeedback"


def field_of_output(output: Output) -> QgsProcessingParameterDefinition:
    """Return the field of an output."""
    name, label = output.field_name, output.label
    optional, by_default = output.optional and not output.is_main, output.by_default
    if output.kind in CLOUDS:
        field = compat.point_cloud_output(name, label, point_cloud_formats())
        field.setFlags(field.flags() | compat.OPTIONAL if optional else field.flags())
    elif output.kind == "raster":
        field = QgsProcessingParameterRasterDestination(name, label, None, optional, by_default)
    elif output.kind == "folder":
        field = QgsProcessingParameterFolderDestination(name, label, None, optional, by_default)
    elif output.kind == "features":
        field = QgsProcessingParameterVectorDestination(
            name, label, optional=optional, createByDefault=by_default
        )
    else:
        is_list = output.kind == "list"
        filters = (
            tr("{} files (*.{})").format("VPC", "vpc") if is_list else tr("HTML files (*.html)")
        )
        file = name, label, filters, None, optional, by_default
        field = QgsProcessingParameterFileDestination(*file)
    if output.advanced:  # QGIS shows it below the other outputs: it folds only inputs away
        field.setFlags(field.flags() | compat.ADVANCED)
    return field


def given_path(request: Request, name: str) -> Path | None:
    """Return the path that the user gave for an output; None if QGIS makes one up, or for none."""
    value = _given(request, name)
    if compat.is_empty(value) or value == QgsProcessing.TEMPORARY_OUTPUT:
        return None
    return Path(value) if isinstance(value, (str, Path)) else None


def is_blank(request: Request, name: str) -> bool:
    """Return whether the user left an output empty, as tables of batch runs do with text."""
    return name in request.parameters and bool(compat.is_empty(_given(request, name)))


def _given(request: Request, name: str) -> object:
    """Return the text in the value of an output."""
    value = request.parameters.get(name)
    if isinstance(value, QgsProcessingOutputLayerDefinition):
        value = value.sink
    if isinstance(value, QgsProperty):
        value, _ = value.valueAsString(request.context.expressionContext(), "")
    return value


def with_outputs_of_step(request: Request, feedback: QgsProcessingFeedback) -> Request:
    """Return the request of a step of a model with temporary files for outputs that the user left
    empty; those of other runs as they are.
    """
    # A model has an output in the parameters of a step if a later step may read it. QGIS makes a
    # temporary file of it only if it is no output of the model.
    if not feedback.inherits(_OF_MODELS):
        return request
    made = {
        output.name(): output.generateTemporaryDestination()
        for output in request.algorithm.destinationParameterDefinitions()
        if is_blank(request, output.name())
    }
    return request._replace(parameters={**request.parameters, **made})


def check_outputs(request: Request, sources: Inputs) -> None:
    """Refuse, as the run would, files in missing folders or with unsuitable names or endings."""
    for output in request.algorithm.destinationParameterDefinitions():
        path = given_path(request, output.name())
        if path is None:
            continue
        try:
            check_kind(_kind_of(output, sources), path, sources)
        except OutputInUse:
            # Layers let go of their files before the run, which asks again.
            is_main = loaded.in_main_thread()
            if not is_main or not loaded.sources_of(request.context.project(), [path]):
                raise


def _kind_of(output: QgsProcessingParameterDefinition, sources: Inputs) -> str:
    """Return the kind of an output."""
    if isinstance(output, QgsProcessingParameterFolderDestination):
        return "folder"
    ending = f".{output.defaultFileExtension()}"
    kinds = {".html": "page", ".tif": "raster", SUFFIX: "list"}
    return "features" if ending in FORMATS else kinds.get(ending, sources.output_kind)


def places_of(request: Request) -> list[Path]:
    """Return the files and folders that the user chose for outputs, and what is made of them."""
    places = []
    for output in request.algorithm.destinationParameterDefinitions():
        path = given_path(request, output.name())
        if path is not None:
            # Many files become a folder, and a virtual raster.
            places += [path, virtual_of(path), path.with_name(split_name(path)[0])]
            places.append(class_raster_of(path))
    return places


def path_of(request: Request, output: Output) -> str:
    """Return the path of an output, empty if the user leaves it out; QGIS will not load a point
    cloud that it cannot show.
    """
    name, is_cloud = output.field_name, output.kind in CLOUDS
    # QGIS would make a layer of an empty path, and say after the run that it is not there.
    read = _READ.get(output.kind, "FileOutput")
    path = "" if is_blank(request, name) else str(request.read(read, name))
    field = request.algorithm.parameterDefinition(name)
    if is_cloud and not path and not field.flags() & compat.OPTIONAL:
        raise Refusal(mark("Choose a file: {}."), field.description())
    if is_cloud and not compat.can_load(path):
        do_not_load(request.context, [path])
    return path


def class_raster_of(cloud: Path) -> Path:
    """Return the raster that shows the classes of a cloud that QGIS cannot show."""
    return cloud.with_name(f"{split_name(cloud)[0]}_classes.tif")


def point_cloud_formats() -> list[str]:
    """Return the extensions of point clouds that can be written, first one that this QGIS can load,
    or else that of the smallest files.
    """
    if missing_packages(WRITING_COPC):
        return ["las"]
    if compat.can_load("x.copc.laz") and not compat.can_load("x.laz"):
        return ["copc.laz", "laz", "las"]
    return ["laz", "las", "copc.laz"]


def cannot_show(path: str) -> str:
    """Return a line of the log on a point cloud that QGIS cannot show, with what it can."""
    hint = ""
    if compat.can_load("x.copc.laz") and not path.lower().endswith((".copc.laz", ".vpc")):
        hint = " QGIS shows files whose names end with .copc.laz."
    return f"This QGIS cannot show such a file as a layer. It is at {path}.{hint}"


def do_not_load(context: QgsProcessingContext, paths: Iterable[str]) -> None:
    """Remove outputs from the list of layers to load."""
    layers = context.layersToLoadOnCompletion()
    for path in paths:
        layers.pop(path, None)
    context.setLayersToLoadOnCompletion(layers)
