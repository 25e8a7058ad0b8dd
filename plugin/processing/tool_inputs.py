"""The fields for the inputs of tools that work on files, by the kinds of the inputs."""

from __future__ import annotations

from pathlib import Path
from types import MappingProxyType
from typing import Any, Callable, Mapping, NamedTuple

from qgis.core import (
    QgsProcessingContext,
    QgsProcessingParameterDefinition,
    QgsProcessingParameterExtent,
    QgsProcessingParameterFeatureSource,
    QgsProcessingParameterRasterLayer,
    QgsProcessingParameterString,
)

from ...algorithms.core.progress import SILENT, Progress
from ...algorithms.tools.declaration import Input
from .. import compat
from ..i18n import mark
from .base import BareEarthAlgorithm
from .checkpoints import add_checkpoints, checkpoints_of
from .inputs import (
    ANY_CLOUD_HELP,
    CLOUD_HELP,
    PointCloudInput,
    SurveyInput,
    box_of,
    layer_polygons,
    name_of,
    raster_of,
    source_path,
)
from .stated_crs import add_crs

# What is said of rasters that are no files, by the names of their inputs.
_NO_FILES = {
    "source": mark("The elevation raster is not a file. Export it as GeoTIFF first."),
    "dtm": mark("The terrain model is not a file. Export it as GeoTIFF first."),
    "confidence": mark("The confidence is not a file. Export it as GeoTIFF first."),
}
_NO_FILE = mark("{} is not a file. Export it as GeoTIFF first.")


class Given(NamedTuple):
    """What a user gives for an input."""

    value: Any  # as the tool gets it; None for nothing
    options: Mapping[str, Any] = MappingProxyType({})  # of the command line
    # Of an input that the command needs: its word, file and name.
    argument: str = ""
    path: Path | None = None
    name: str = ""


class Request(NamedTuple):
    """A dialog with the values that a user gives."""

    algorithm: BareEarthAlgorithm
    parameters: dict[str, Any]
    context: QgsProcessingContext
    progress: Progress = SILENT

    def is_empty(self, declared: Input) -> bool:
        """Return whether the field of an input is empty."""
        return bool(compat.is_empty(self.parameters.get(declared.field_name)))


def add_input(algorithm: BareEarthAlgorithm, declared: Input) -> None:
    """Add the field, or the fields, of an input to a dialog."""
    name, label = declared.field_name, declared.label
    if declared.kind == "crs":
        add_crs(algorithm)
        return
    if declared.kind == "checkpoints":
        add_checkpoints(algorithm)
        return
    makers: dict[str, Callable[[], QgsProcessingParameterDefinition]] = {
        "cloud": lambda: PointCloudInput(name, label),
        "clouds": lambda: SurveyInput(name, label),
        "raster": lambda: QgsProcessingParameterRasterLayer(name, label, None, declared.optional),
        "extent": lambda: QgsProcessingParameterExtent(name, label, None, True),
        "words": lambda: QgsProcessingParameterString(name, label, None, False, True),
        "polygons": lambda: QgsProcessingParameterFeatureSource(
            name, label, [compat.POLYGONS], None, True
        ),
    }
    helps = {"cloud": CLOUD_HELP, "clouds": ANY_CLOUD_HELP}
    field = makers[declared.kind]()
    if declared.advanced:
        field.setFlags(field.flags() | compat.ADVANCED)
    algorithm.addParameter(field, declared.field_help or helps.get(declared.kind, ""))


def given(request: Request, declared: Input) -> Given:
    """Return what the user gives for an input; refuse what is not suitable."""
    return _READERS[declared.kind](request, declared)


def _cloud(request: Request, declared: Input) -> Given:
    algorithm, parameters, context, _ = request
    path = source_path(algorithm, parameters, declared.field_name, context)
    value = [path] if declared.kind == "clouds" else path
    return Given(value, {}, str(path), path, name_of(path))


def _raster(request: Request, declared: Input) -> Given:
    if declared.optional and request.is_empty(declared):
        return Given(None)
    algorithm, parameters, context, _ = request
    refusal = _NO_FILES.get(declared.name, _NO_FILE)
    layer = raster_of(algorithm, parameters, declared.field_name, context, refusal)
    source = layer.source()
    if declared.optional:
        return Given(source, {declared.name: source})
    return Given(source, {}, source, Path(source), layer.name())


def _crs(request: Request, declared: Input) -> Given:
    return Given(request.algorithm.stated, {"crs": request.algorithm.stated})


def _extent(request: Request, declared: Input) -> Given:
    if request.is_empty(declared):
        return Given(None)
    algorithm, parameters, context, _ = request
    crs = algorithm.crs_of(*algorithm.inputs)
    box = box_of(algorithm, parameters, declared.field_name, context, crs)
    return Given(box, {declared.name: tuple(map(repr, box))})


def _words(request: Request, declared: Input) -> Given:
    algorithm, parameters, context, _ = request
    text = algorithm.parameterAsString(parameters, declared.field_name, context)
    words = tuple(word for part in text.split(",") if (word := part.strip()))
    return Given(words, {declared.name: words})


def _checkpoints(request: Request, declared: Input) -> Given:
    algorithm, parameters, context, progress = request
    crs = algorithm.crs_of(*algorithm.inputs)
    return Given(*checkpoints_of(algorithm, parameters, context, crs, progress))


def _polygons(request: Request, declared: Input) -> Given:
    if declared.found and request.is_empty(declared):
        return Given(None, {declared.name: "automatic"})
    algorithm, parameters, context, progress = request
    file = f"{declared.name}.geojson"
    progress.info(
        f"In the command line the {declared.name} is missing: save it in the CRS of the points as"
        f" {file}."
    )
    crs = algorithm.crs_of(*algorithm.inputs)
    field = declared.field_name, declared.label
    polygons = layer_polygons(algorithm, parameters, *field, context, crs)
    return Given(declared.of(polygons), {declared.name: file})


_READERS: dict[str, Callable[[Request, Input], Given]] = {
    "cloud": _cloud, "clouds": _cloud, "raster": _raster, "crs": _crs, "extent": _extent,
    "words": _words, "checkpoints": _checkpoints, "polygons": _polygons,
}  # fmt: skip
