"""The kinds of inputs: their fields in a dialog, and how and when the fields are read."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any, Callable, Iterator, NamedTuple, Sequence

from qgis.core import (
    QgsProcessingParameterCrs,
    QgsProcessingParameterExtent,
    QgsProcessingParameterFeatureSource,
    QgsProcessingParameterField,
    QgsProcessingParameterFile,
    QgsProcessingParameterMultipleLayers,
    QgsProcessingParameterRasterLayer,
    QgsProcessingParameterString,
)
from qgis.core import (
    QgsProcessingParameterDefinition as Field,
)

from ...algorithms.classes.corrections import NO_CORRECTIONS, Corrections, plain_values
from ...algorithms.rasters.cell_grid import RasterTarget
from ...algorithms.remote.addresses import shown
from ...algorithms.survey.vector_files import ANSWER_FIELD, CLASS_FIELD, name_among, value_of
from ...algorithms.tools.declaration import Automatic, Input, help_of_area, with_note
from ...algorithms.tools.input_groups import GROUPS
from ...algorithms.tools.rasters.constraints import Constraints
from .. import compat
from ..i18n import mark
from .checkpoints import CheckpointInput, checkpoints_of
from .feedback import Refusal
from .inputs import (
    PointCloudInput,
    SurveyInput,
    TerrainInput,
    clouds_of,
    local,
    names_of,
    raster_of,
    source_of,
    survey_of,
    terrain_of,
)
from .remote import ADDRESS_HELP, ALSO_REMOTE, LAYER_HELP, REMOTE, Remote
from .request import GivenInput, Request, Resolved
from .runs import MADE_AS
from .shapes import BOUNDARY, area_of, box_of, file_for_command, layer_shapes

# As names, so that widgets are imported only in dialogs, not in qgis_process.
_ATTRIBUTE_WIDGET = f"{__package__}.layer_widgets.AttributeWidget"
_RASTER_WIDGET = f"{__package__}.layer_widgets.RasterWidget"
# Default and layer of the fields for attributes.
_ATTRIBUTES = {
    "CORRECTIONS_FIELD": (CLASS_FIELD, "CORRECTIONS"), "Z_FIELD": (None, "CHECKPOINTS"),
    "COVER_FIELD": (None, "CHECKPOINTS"), "NAME_FIELD": (None, "CHECKPOINTS"),
}  # fmt: skip
# Errors for rasters that are not files, by the names of their inputs.
_NO_FILES = {
    "source": mark("The elevation raster is not a file. Export it as GeoTIFF first."),
    "dtm": mark("The terrain model is not a file. Export it as GeoTIFF first."),
    "expected_error": mark("The expected error is not a file. Export it as GeoTIFF first."),
    "like": mark("The raster with the grid to use is not a file. Export it as GeoTIFF first."),
}
_NO_FILE = mark("{} is not a file. Export it as GeoTIFF first.")
_FILES_HELP = (
    ".las, .laz and .copc.laz files, virtual point clouds (.vpc), or text files (.txt) with one"
    " path in each line. May stay empty if a folder is given."
)
_FOLDER_HELP = (
    "All .las, .laz and .copc.laz files in this folder are used, too. All files together are one"
    " survey, without seams."
)
_SURVEY_HELP = (
    "A point cloud layer, a .las, .laz or .copc.laz file, a virtual point cloud (.vpc), or a text"
    " file (.txt) with one path in each line. May stay empty if a folder is given."
    f"{ALSO_REMOTE}"
)
_CLOUD_HELP = f"A point cloud layer, or a .las, .laz or .copc.laz file.{ALSO_REMOTE}"
_POINTS_HELP = "They are of any CRS, or a table (.csv, .txt, .xyz) in the CRS of the points."
_ANY_CLOUD_HELP = (
    "A point cloud layer, or a .las, .laz or .copc.laz file; also a virtual point cloud (.vpc) or a"
    f" folder.{ALSO_REMOTE}"
)

Fields = Iterator[tuple[Field, str]]  # each with its help


# The fields.


def _advanced(field: Field) -> Field:
    field.setFlags(field.flags() | compat.ADVANCED)
    return field


def _one(make: Callable[..., Field], note: str = "") -> Callable[[Input], Fields]:
    """Return what yields the field of an input, given its class or a function of name, label,
    default, and whether it may be empty.
    """

    def fields(declared: Input) -> Fields:
        optional = declared.optional or KINDS[declared.kind].when != FILES
        field = make(declared.field_name, declared.label, None, optional)
        metadata = field.metadata()
        if declared.made_as:
            is_raster = declared.kind == "raster"
            widget = {"widget_wrapper": {"class": _RASTER_WIDGET}} if is_raster else {}
            metadata = {**metadata, **widget, MADE_AS: declared.made_as}
        elif declared.kind == "attribute":
            metadata = {**metadata, "widget_wrapper": {"class": _ATTRIBUTE_WIDGET}}
        field.setMetadata(metadata)
        help = with_note(declared.help, note)
        yield (_advanced(field) if declared.advanced else field), help

    return fields


def _layer(kind: object, field: Any = QgsProcessingParameterFeatureSource) -> Callable[..., Field]:
    """Return what makes the field of a layer of a kind."""
    return lambda name, label, *given: field(name, label, [kind], *given)


def _area_fields(declared: Input) -> Fields:
    extent = QgsProcessingParameterExtent("EXTENT", "Extent", None, True)
    helps = help_of_area(declared.help)
    yield (_advanced(extent) if declared.advanced else extent), helps[0]
    yield from KINDS[BOUNDARY.kind].fields(replace(BOUNDARY, help=helps[1]))


def _survey_fields(declared: Input) -> Fields:
    yield SurveyInput("INPUT", "Point cloud", None, True), _SURVEY_HELP
    yield _folder_field(), _FOLDER_HELP


def _folder_field() -> Field:
    label = "Folder of point clouds"
    return QgsProcessingParameterFile("INPUT_FOLDER", label, compat.FOLDER, "", None, True)


def _files_fields(declared: Input) -> Fields:
    files = QgsProcessingParameterMultipleLayers("INPUT", "Point clouds", compat.FILES, None, True)
    yield files, _FILES_HELP
    yield _folder_field(), _FOLDER_HELP
    # The list of files of QGIS offers no layers, and nothing can be typed into it.
    yield _advanced(PointCloudInput(REMOTE, "Remote point cloud", None, True)), ADDRESS_HELP


def _parts(declared: Input) -> Fields:
    """Yield the fields of an input that consists of others."""
    for part in GROUPS[declared.kind]:
        if part.label:
            part = replace(part, advanced=part.advanced or declared.advanced)
            yield from KINDS[part.kind].fields(part)


# The values.


def _cloud(request: Request, declared: Input, resolved: Resolved) -> GivenInput:
    if declared.optional and request.is_empty(declared.field_name):
        return GivenInput(None)
    source = source_of(request, declared.field_name)
    if declared.optional:  # an option of the command, which is never downloaded
        return GivenInput(local(source), {declared.name: str(source)})
    return _of_sources([source], is_one=declared.kind == "cloud")


def _address(request: Request, declared: Input, resolved: Resolved) -> GivenInput:
    found = _of_sources([source_of(request, declared.field_name)])
    return found._replace(value=found.remotes[0].address if found.remotes else str(found.paths[0]))


def _of_sources(sources: Sequence[Path | Remote], is_one: bool = False) -> GivenInput:
    """Return the value for point clouds, without remote ones, which are downloaded later."""
    remotes = tuple(source for source in sources if isinstance(source, Remote))
    paths = tuple(source for source in sources if isinstance(source, Path))
    value = next(iter(paths), None) if is_one else list(paths)
    # Without secrets.
    words = (shown(one.address) if isinstance(one, Remote) else str(one) for one in sources)
    return GivenInput(value, {}, tuple(words), paths, names_of(sources), remotes)


def _raster(request: Request, declared: Input, resolved: Resolved) -> GivenInput:
    if declared.optional and request.is_empty(declared.field_name):
        return GivenInput(None)
    layer = raster_of(request, declared.field_name, _NO_FILES.get(declared.name, _NO_FILE))
    source = layer.source()
    if declared.optional:
        return GivenInput(source, {declared.name: source})
    return GivenInput(source, {}, (source,), (Path(source),), layer.name())


def _terrain(request: Request, declared: Input, resolved: Resolved) -> GivenInput:
    source, name = terrain_of(request, declared.field_name)
    return GivenInput(source, {}, (source,), (Path(source),), name)


def _crs(request: Request, declared: Input, resolved: Resolved) -> GivenInput:
    return GivenInput(resolved.stated, {"crs": resolved.stated})


def _words(request: Request, declared: Input, resolved: Resolved) -> GivenInput:
    text = request.read("String", declared.field_name)
    words = tuple(word for part in text.split(",") if (word := part.strip()))
    return GivenInput(words, {declared.name: words})


def _extent(request: Request, declared: Input, resolved: Resolved) -> GivenInput:
    if request.is_empty(declared.field_name):
        return GivenInput(None)
    box = box_of(request, declared.field_name, resolved.crs)
    return GivenInput(box, {declared.name.replace("_", "-"): tuple(map(repr, box))})


def _target(request: Request, declared: Input, resolved: Resolved) -> GivenInput:
    like, extent = (
        KINDS[part.kind].read(request, part, resolved) for part in GROUPS[declared.kind]
    )
    return GivenInput(RasterTarget(like.value, extent.value), {**like.options, **extent.options})


def _area(request: Request, declared: Input, resolved: Resolved) -> GivenInput:
    area = area_of(request, resolved.crs)
    if area is None:
        return GivenInput(None)
    box = tuple(map(repr, area.box)) if area.box else ()
    boundary = [BOUNDARY] if area.polygons else []
    files = _files(request, boundary, are_usable=resolved.crs.is_known)
    return GivenInput(area, {"extent": box, **files})


def _files(
    request: Request, layers: Sequence[Input], note: str = "", are_usable: bool = True
) -> dict[str, str]:
    """Return the files that hold what layers hold, as options of the command; the log says which
    ones it lacks.
    """
    files = {
        one.name: file_for_command(request, one.field_name) if are_usable else "" for one in layers
    }
    if missing := [name.replace("_", "-") for name, file in files.items() if not file]:
        options = " ".join(f"--{name} {name}.geojson" for name in missing)
        request.progress.info(
            f"The command line lacks what is in layers: save {' and '.join(missing)} in the CRS of"
            f" the points as GeoJSON{note}, and add {options}."
        )
    return files


def _corrections(request: Request, declared: Input, resolved: Resolved) -> GivenInput:
    name = declared.field_name
    if request.is_empty(name):
        return GivenInput(NO_CORRECTIONS)
    asked = request.read("String", "CORRECTIONS_FIELD") or CLASS_FIELD
    source = request.read("Source", name)
    fields = [] if source is None else source.fields().names()
    of_class, answer = (name_among(fields, wanted) or "" for wanted in (asked, ANSWER_FIELD))
    if source is not None and not (of_class or answer):
        text = mark("The corrections have no attribute {}. Choose the one to use.")
        raise Refusal(text, asked)
    layer, note = GROUPS[declared.kind][0], f', with the attribute "{CLASS_FIELD}"'
    files = _files(request, [layer], note, asked.lower() == CLASS_FIELD)
    shapes = layer_shapes(request, layer, resolved.crs, fields)
    polygons, rows = zip(*shapes) if shapes else ((), ())
    classes, answers = (tuple(value_of(row, one) for row in rows) for one in (of_class, answer))
    found = Corrections(polygons, classes, answers, tuple(map(plain_values, rows)))
    return GivenInput(found, files)


def _constraints(request: Request, declared: Input, resolved: Resolved) -> GivenInput:
    given = [part for part in GROUPS[declared.kind] if not request.is_empty(part.field_name)]
    shapes: dict[str, Any] = {}  # of lines or of polygons
    for part in given:
        found = layer_shapes(request, part, resolved.crs)
        shapes[part.name] = tuple(corners for corners, _ in found)
    return GivenInput(Constraints(**shapes), _files(request, given))


def _polygons(request: Request, declared: Input, resolved: Resolved) -> GivenInput:
    name = declared.field_name
    if declared.optional and request.is_empty(name):
        return GivenInput(declared.of(()))
    if declared.found and request.is_empty(name):
        return GivenInput(Automatic(), {declared.name: "automatic"})
    files = _files(request, [declared])
    shapes = layer_shapes(request, declared, resolved.crs, may_be_empty=declared.may_be_empty)
    return GivenInput(declared.of(tuple(rings for rings, _ in shapes)), files)


# When inputs are read: the files, which name the run and are checked before it; before the work,
# in the main thread; when the work begins, in its thread, since it can take long.
FILES, BEFORE, LATE = range(3)


class InputKind(NamedTuple):
    """A kind of input: its fields, how they are read, and when."""

    fields: Callable[[Input], Fields]
    # From the fields and, except for files, from what is resolved by then.
    read: Callable[[Request, Input, Resolved], GivenInput] = lambda *_: GivenInput(None)
    when: int = BEFORE


KINDS = {
    "cloud": InputKind(
        _one(lambda *given: (SurveyInput if given[-1] else PointCloudInput)(*given), _CLOUD_HELP),
        _cloud,
        FILES,
    ),
    "clouds": InputKind(_one(SurveyInput, _ANY_CLOUD_HELP), _cloud, FILES),
    "files": InputKind(_files_fields, lambda request, *_: _of_sources(clouds_of(request)), FILES),
    "survey": InputKind(_survey_fields, lambda request, *_: _of_sources(survey_of(request)), FILES),
    "address": InputKind(_one(PointCloudInput, LAYER_HELP), _address, FILES),
    "raster": InputKind(_one(QgsProcessingParameterRasterLayer), _raster, FILES),
    "terrain": InputKind(_one(TerrainInput), _terrain, FILES),
    "crs": InputKind(_one(QgsProcessingParameterCrs), _crs),
    "extent": InputKind(_one(QgsProcessingParameterExtent), _extent),
    "words": InputKind(
        _one(
            lambda name, label, *_: QgsProcessingParameterString(name, label, None, False, True),
            "Words are separated by commas.",
        ),
        _words,
    ),
    "area": InputKind(_area_fields, _area),
    "target": InputKind(_parts, _target),
    "corrections": InputKind(_parts, _corrections),
    "constraints": InputKind(_parts, _constraints),
    "checkpoints": InputKind(_parts, checkpoints_of, LATE),
    "polygons": InputKind(_one(_layer(compat.POLYGONS)), _polygons, LATE),
    # Parts of the groups above.
    "lines": InputKind(_one(_layer(compat.LINES))),
    "points": InputKind(_one(_layer(compat.TABLES, CheckpointInput), _POINTS_HELP)),
    "attribute": InputKind(
        _one(
            lambda name, label, *_: QgsProcessingParameterField(
                name, label, *_ATTRIBUTES[name], optional=True
            )
        )
    ),
}
