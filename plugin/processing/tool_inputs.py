"""The fields for the inputs of tools that work on files, by the kinds of the inputs."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from types import MappingProxyType
from typing import Any, Callable, NamedTuple, Sequence

from qgis.core import (
    QgsProcessingContext,
    QgsProcessingParameterCrs,
    QgsProcessingParameterDefinition,
    QgsProcessingParameterExtent,
    QgsProcessingParameterFeatureSource,
    QgsProcessingParameterField,
    QgsProcessingParameterRasterLayer,
    QgsProcessingParameterString,
)

from ...algorithms.classes.corrections import NO_CORRECTIONS, Corrections, plain_values
from ...algorithms.core.progress import SILENT, Progress
from ...algorithms.rasters.cell_grid import RasterTarget
from ...algorithms.survey.area import Area
from ...algorithms.survey.vector_files import ANSWER_FIELD, CLASS_FIELD, name_among, value_of
from ...algorithms.tools.declaration import Automatic, Input, with_note
from ...algorithms.tools.input_groups import GROUPS
from ...algorithms.tools.rasters.constraints import Constraints
from .. import compat
from ..i18n import mark
from .area import add_area, area_in_own_crs, area_of, area_options
from .base import BareEarthAlgorithm, Options
from .checkpoints import CheckpointInput, checkpoints_of
from .feedback import Refusal
from .inputs import (
    ANY_CLOUD_HELP,
    CLOUD_HELP,
    CloudCrs,
    PointCloudInput,
    SurveyInput,
    TerrainInput,
    add_clouds,
    add_survey,
    box_of,
    clouds_of,
    layer_shapes,
    names_of,
    raster_of,
    source_of,
    survey_of,
    terrain_of,
    words_of,
)
from .layer_files import file_for_command
from .remote import LAYER_HELP, Remote
from .runs import MADE_AS
from .stated_crs import text_of

# As names, so that widgets are imported only in dialogs, not in qgis_process.
_ATTRIBUTE_WIDGET = f"{__package__}.attribute_widget.AttributeWidget"
_RASTER_WIDGET = f"{__package__}.layer_widgets.RasterWidget"
# Errors for rasters that are not files, by the names of their inputs.
_NO_FILES = {
    "source": mark("The elevation raster is not a file. Export it as GeoTIFF first."),
    "dtm": mark("The terrain model is not a file. Export it as GeoTIFF first."),
    "expected_error": mark("The expected error is not a file. Export it as GeoTIFF first."),
}
_NO_FILE = mark("{} is not a file. Export it as GeoTIFF first.")
_LAYERS = {"lines": compat.LINES, "polygons": compat.POLYGONS}
# Default and layer of the fields for attributes.
_ATTRIBUTES = {
    "CORRECTIONS_FIELD": (CLASS_FIELD, "CORRECTIONS"), "Z_FIELD": (None, "CHECKPOINTS"),
    "COVER_FIELD": (None, "CHECKPOINTS"), "NAME_FIELD": (None, "CHECKPOINTS"),
}  # fmt: skip


class GivenInput(NamedTuple):
    """The value of an input in a dialog."""

    value: object  # as the tool gets it; None for an empty field
    options: Options = MappingProxyType({})  # of the command line
    # Of an input that the command needs: its words, files and name.
    arguments: tuple[str, ...] = ()
    paths: tuple[Path, ...] = ()
    name: str = ""
    remotes: tuple[Remote, ...] = ()  # point clouds that are not on this computer


class Request(NamedTuple):
    """A dialog with the values of its fields."""

    algorithm: BareEarthAlgorithm
    parameters: dict[str, object]
    context: QgsProcessingContext
    progress: Progress = SILENT

    def is_empty(self, declared: Input) -> bool:
        """Return whether the field of an input is empty."""
        return bool(compat.is_empty(self.parameters.get(declared.field_name)))

    def file_in(self, name: str) -> str:
        """Return the file of the layer in a field, for the command line; see `file_for_command`."""
        return file_for_command(self.algorithm, self.parameters, name, self.context)


def add_input(algorithm: BareEarthAlgorithm, declared: Input) -> None:
    """Add the field, or the fields, of an input to a dialog."""
    name, label = declared.field_name, declared.label
    if declared.kind in _GROUPS:
        _GROUPS[declared.kind](algorithm)
        return
    if declared.kind == "area":
        add_area(algorithm, declared)
        return
    if declared.kind in GROUPS:
        for part in GROUPS[declared.kind]:
            if part.label:
                add_input(algorithm, replace(part, advanced=part.advanced or declared.advanced))
        return
    makers: dict[str, Callable[[], QgsProcessingParameterDefinition]] = {
        "cloud": lambda: (
            SurveyInput(name, label, None, True)
            if declared.optional
            else PointCloudInput(name, label)
        ),
        "clouds": lambda: SurveyInput(name, label),
        "address": lambda: PointCloudInput(name, label),
        "raster": lambda: QgsProcessingParameterRasterLayer(name, label, None, declared.optional),
        "terrain": lambda: TerrainInput(name, label),
        "crs": lambda: QgsProcessingParameterCrs(name, label, None, True),
        "extent": lambda: QgsProcessingParameterExtent(name, label, None, True),
        "words": lambda: QgsProcessingParameterString(name, label, None, False, True),
        "attribute": lambda: QgsProcessingParameterField(
            name, label, *_ATTRIBUTES[name], optional=True
        ),
    }
    helps = {
        "cloud": CLOUD_HELP, "clouds": ANY_CLOUD_HELP, "address": LAYER_HELP,
        "points": "They are of any CRS, or a table (.csv, .txt, .xyz) in the CRS of the points.",
        "words": "Words are separated by commas.",
    }  # fmt: skip
    if declared.kind == "points":
        field = CheckpointInput(name, label, [compat.TABLES], None, True)
    elif declared.kind in _LAYERS:
        kinds = [_LAYERS[declared.kind]]
        field = QgsProcessingParameterFeatureSource(name, label, kinds, None, True)
    else:
        field = makers[declared.kind]()
    if declared.advanced:
        field.setFlags(field.flags() | compat.ADVANCED)
    metadata = field.metadata()
    if declared.made_as:
        widget = {"widget_wrapper": {"class": _RASTER_WIDGET}} if declared.kind == "raster" else {}
        metadata = {**metadata, **widget, MADE_AS: declared.made_as}
    elif declared.kind == "attribute":
        metadata = {**metadata, "widget_wrapper": {"class": _ATTRIBUTE_WIDGET}}
    field.setMetadata(metadata)
    algorithm.addParameter(field, with_note(declared.help, helps.get(declared.kind, "")))


def given(request: Request, declared: Input) -> GivenInput:
    """Return the value of an input in a dialog; refuse unsuitable values."""
    return _READERS[declared.kind](request, declared)


def _cloud(request: Request, declared: Input) -> GivenInput:
    algorithm, parameters, context, _ = request
    if declared.optional:
        return _optional_cloud(request, declared)
    source = source_of(algorithm, parameters, declared.field_name, context)
    return _of_sources([source], is_one=declared.kind == "cloud")


def _optional_cloud(request: Request, declared: Input) -> GivenInput:
    """Return the value for points that are an option of the command, and are never downloaded."""
    if request.is_empty(declared):
        return GivenInput(None)
    algorithm, parameters, context, _ = request
    source = source_of(algorithm, parameters, declared.field_name, context)
    if isinstance(source, Remote):
        raise Refusal(mark("{} is not on this computer. Choose a file."), names_of([source]))
    return GivenInput(source, {declared.name: str(source)})


def _address(request: Request, declared: Input) -> GivenInput:
    found = _cloud(request, declared)
    return found._replace(value=found.remotes[0].address if found.remotes else str(found.paths[0]))


def _files(request: Request, declared: Input) -> GivenInput:
    return _of_sources(clouds_of(request.algorithm, request.parameters, request.context))


def _survey(request: Request, declared: Input) -> GivenInput:
    return _of_sources(survey_of(request.algorithm, request.parameters, request.context))


def _of_sources(sources: Sequence[Path | Remote], is_one: bool = False) -> GivenInput:
    """Return the value for point clouds, without remote ones, which are downloaded later."""
    remotes = tuple(source for source in sources if isinstance(source, Remote))
    paths = tuple(source for source in sources if isinstance(source, Path))
    value = next(iter(paths), None) if is_one else list(paths)
    return GivenInput(value, {}, tuple(map(words_of, sources)), paths, names_of(sources), remotes)


def _area(request: Request, declared: Input) -> GivenInput:
    area, is_known = part_of(request)
    if not is_known:
        request.progress.info(
            "In the command line the area is missing: save it as boundary.geojson, and add"
            " --boundary boundary.geojson."
        )
        return GivenInput(area)
    return GivenInput(area, area_options(area, request.file_in("BOUNDARY"), request.progress))


def part_of(request: Request) -> tuple[Area | None, bool]:
    """Return the area, and whether it is in the CRS of the points; it is in its own CRS as long as
    that of remote points is not known.
    """
    algorithm, parameters, context, _ = request
    if algorithm.is_elsewhere and not (algorithm.stated or algorithm.layer_crs):
        area = area_in_own_crs(algorithm, parameters, context)
        return area, area is None or not area.polygons
    return area_of(algorithm, parameters, context, _crs_of(request)), True


def _target(request: Request, declared: Input) -> GivenInput:
    algorithm, parameters, context, _ = request
    like = extent = None
    if not compat.is_empty(parameters.get("LIKE")):
        text = mark("The raster with the grid to use is not a file. Export it as GeoTIFF first.")
        like = raster_of(algorithm, parameters, "LIKE", context, text).source()
    if not compat.is_empty(parameters.get("RASTER_EXTENT")):
        extent = box_of(algorithm, parameters, "RASTER_EXTENT", context, _crs_of(request))
    options = {"like": like, "raster-extent": extent and tuple(map(repr, extent))}
    return GivenInput(RasterTarget(like, extent), options)


def _corrections(request: Request, declared: Input) -> GivenInput:
    algorithm, parameters, context, progress = request
    if request.is_empty(declared):
        return GivenInput(NO_CORRECTIONS)
    layer = declared.field_name
    asked = algorithm.parameterAsString(parameters, "CORRECTIONS_FIELD", context) or CLASS_FIELD
    source = algorithm.parameterAsSource(parameters, layer, context)
    fields = [] if source is None else source.fields().names()
    name, answer = (name_among(fields, wanted) or "" for wanted in (asked, ANSWER_FIELD))
    if source is not None and not (name or answer):
        text = mark("The corrections have no attribute {}. Choose the one to use.")
        raise Refusal(text, asked)
    file = request.file_in(layer) if asked.lower() == CLASS_FIELD else ""
    if not file:
        progress.info(
            "In the command line the corrections are missing: save them in the CRS of the points"
            f' as corrections.geojson, their class as the attribute "{CLASS_FIELD}", and add'
            " --corrections corrections.geojson."
        )
    field = algorithm, parameters, layer, "Corrections", context, _crs_of(request)
    shapes = layer_shapes(*field, attributes=fields)
    polygons, rows = zip(*shapes) if shapes else ((), ())
    classes, answers = (tuple(value_of(row, one) for row in rows) for one in (name, answer))
    found = Corrections(polygons, classes, answers, tuple(map(plain_values, rows)))
    return GivenInput(found, {declared.name: file})


def _constraints(request: Request, declared: Input) -> GivenInput:
    algorithm, parameters, context, progress = request
    shapes: dict[str, Any] = {}  # of lines or of polygons
    for part in GROUPS[declared.kind]:
        if not request.is_empty(part):
            field = algorithm, parameters, part.field_name, part.label, context, _crs_of(request)
            found = layer_shapes(*field, _LAYERS[part.kind])
            shapes[part.name] = tuple(corners for corners, _ in found)
    files = {name: request.file_in(name.upper()) for name in shapes}
    names = [name.replace("_", "-") for name, file in files.items() if not file]
    if names:
        progress.info(
            "In the command line some layers are missing: save each in the CRS of the points as"
            f" GeoJSON, and add {' '.join(f'--{name} {name}.geojson' for name in names)}."
        )
    return GivenInput(Constraints(**shapes), files)


def _crs_of(request: Request) -> CloudCrs:
    """Return the CRS of the raster or of the points, also in subfolders if the user asks for
    these.
    """
    algorithm, parameters, context, _ = request
    if isinstance(algorithm.parameterDefinition("INPUT"), QgsProcessingParameterRasterLayer):
        layer = algorithm.parameterAsRasterLayer(parameters, "INPUT", context)
        # Without a CRS nothing is transformed.
        return CloudCrs(stated=text_of(layer.crs()) or "WKT:")
    is_deep = algorithm.parameterDefinition("RECURSIVE") is not None
    recursive = is_deep and algorithm.parameterAsBool(parameters, "RECURSIVE", context)
    return algorithm.crs_of(*algorithm.inputs, recursive=recursive)


def _raster(request: Request, declared: Input) -> GivenInput:
    if declared.optional and request.is_empty(declared):
        return GivenInput(None)
    algorithm, parameters, context, _ = request
    refusal = _NO_FILES.get(declared.name, _NO_FILE)
    layer = raster_of(algorithm, parameters, declared.field_name, context, refusal)
    source = layer.source()
    if declared.optional:
        return GivenInput(source, {declared.name: source})
    return GivenInput(source, {}, (source,), (Path(source),), layer.name())


def _terrain(request: Request, declared: Input) -> GivenInput:
    algorithm, parameters, context, _ = request
    source, name = terrain_of(algorithm, parameters, declared.field_name, context)
    return GivenInput(source, {}, (source,), (Path(source),), name)


def _crs(request: Request, declared: Input) -> GivenInput:
    return GivenInput(request.algorithm.stated, {"crs": request.algorithm.stated})


def _extent(request: Request, declared: Input) -> GivenInput:
    if request.is_empty(declared):
        return GivenInput(None)
    algorithm, parameters, context, _ = request
    crs = algorithm.crs_of(*algorithm.inputs)
    box = box_of(algorithm, parameters, declared.field_name, context, crs)
    return GivenInput(box, {declared.name: tuple(map(repr, box))})


def _words(request: Request, declared: Input) -> GivenInput:
    algorithm, parameters, context, _ = request
    text = algorithm.parameterAsString(parameters, declared.field_name, context)
    words = tuple(word for part in text.split(",") if (word := part.strip()))
    return GivenInput(words, {declared.name: words})


def _checkpoints(request: Request, declared: Input) -> GivenInput:
    algorithm, parameters, context, progress = request
    crs = algorithm.crs_of(*algorithm.inputs)
    return GivenInput(*checkpoints_of(algorithm, parameters, context, crs, progress))


def _polygons(request: Request, declared: Input) -> GivenInput:
    if declared.optional and request.is_empty(declared):
        return GivenInput(declared.of(()))
    if declared.found and request.is_empty(declared):
        return GivenInput(Automatic(), {declared.name: "automatic"})
    algorithm, parameters, context, progress = request
    file = request.file_in(declared.field_name)
    if not file:
        file = f"{declared.name}.geojson"
        progress.info(
            f"In the command line the {declared.name} is missing: save it in the CRS of the points"
            f" as {file}."
        )
    crs = algorithm.crs_of(*algorithm.inputs)
    field = declared.field_name, declared.label
    shapes = layer_shapes(
        algorithm, parameters, *field, context, crs, may_be_empty=declared.may_be_empty
    )
    polygons = tuple(rings for rings, _ in shapes)
    return GivenInput(declared.of(polygons), {declared.name: file})


_READERS: dict[str, Callable[[Request, Input], GivenInput]] = {
    "cloud": _cloud, "clouds": _cloud, "address": _address, "raster": _raster, "crs": _crs,
    "terrain": _terrain,
    "extent": _extent, "words": _words, "checkpoints": _checkpoints, "polygons": _polygons,
    "files": _files, "survey": _survey, "area": _area, "target": _target,
    "corrections": _corrections, "constraints": _constraints,
}  # fmt: skip
# Inputs with fields of their own.
_GROUPS: dict[str, Callable[[BareEarthAlgorithm], None]] = {
    "files": add_clouds, "survey": add_survey,
}  # fmt: skip
