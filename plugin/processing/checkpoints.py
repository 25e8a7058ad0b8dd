"""Fields for checkpoints: a layer of points, or a table."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from qgis.core import (
    QgsFeature,
    QgsProcessingAlgorithm,
    QgsProcessingContext,
    QgsProcessingParameterDefinition,
    QgsProcessingParameterFeatureSource,
    QgsProcessingParameterField,
    QgsProcessingParameterFileDestination,
    QgsProcessingParameterRasterLayer,
    QgsProcessingParameterString,
    QgsProcessingParameterVectorDestination,
)

from ...algorithms.products.accuracy import VEGETATED
from ...algorithms.survey.checkpoint_files import Checkpoints, read_checkpoints
from ...algorithms.survey.point_tables import SUFFIXES, number_of, recognised
from .. import compat
from ..i18n import mark, tr
from .feedback import FeedbackProgress, Refusal
from .inputs import CloudCrs, features_of, raster_of
from .outputs import do_not_load

_LAYER, _CONFIDENCE, _VEGETATED = "CHECKPOINTS", "CONFIDENCE", "VEGETATED"
# The role of the attribute in each field, and the label and the help of the field.
_FIELDS = {
    "Z_FIELD": (
        "z",
        "Height of the checkpoints",
        "The attribute with the heights, in the unit of the heights of the points. Empty: z of the"
        " points, or an attribute with a usual name, such as H or elevation.",
    ),
    "COVER_FIELD": (
        "cover",
        "Land cover of the checkpoints",
        "The attribute with the land cover, such as forest or NVA. Points on vegetated land are"
        " reported apart. Empty: an attribute with a usual name, such as class.",
    ),
    "NAME_FIELD": (
        "name",
        "Name of the checkpoints",
        "The attribute with the names. Empty: an attribute with a usual name, such as id, or else"
        " numbers from 1 on.",
    ),
}
_VISIBLE = ("Z_FIELD", "COVER_FIELD")


def add_checkpoints(algorithm: QgsProcessingAlgorithm, advanced: bool = False) -> None:
    """Add the fields of the layer to a dialog, all of them as advanced ones if wanted."""
    layer = QgsProcessingParameterFeatureSource(_LAYER, "Checkpoints", [compat.POINTS], None, True)
    text = (
        "Points that were surveyed on the ground, of any CRS, or a table (.csv) in the CRS of the"
        " point cloud. May stay empty if points are held out."
    )
    _add(algorithm, layer, text, not advanced)
    for name, (_, label, text) in _FIELDS.items():
        field = QgsProcessingParameterField(name, label, None, _LAYER, optional=True)
        _add(algorithm, field, text, name in _VISIBLE and not advanced)


def add_judgement(algorithm: QgsProcessingAlgorithm) -> None:
    """Add advanced fields that decide which checkpoints count, and as what."""
    words = QgsProcessingParameterString(
        _VEGETATED, "Vegetated land covers", ", ".join(VEGETATED), False, True
    )
    text = "A land cover is vegetated if a word of its name begins or ends with one of these."
    _add(algorithm, words, text)
    sure = QgsProcessingParameterRasterLayer(_CONFIDENCE, "Confidence", None, True)
    text = "Confidence of the terrain model, 0 to 1. Checkpoints where it is low are not counted."
    _add(algorithm, sure, text)


def _add(
    algorithm: QgsProcessingAlgorithm,
    field: QgsProcessingParameterDefinition,
    text: str,
    is_visible: bool = False,
) -> None:
    if not is_visible:
        field.setFlags(field.flags() | compat.ADVANCED)
    algorithm.addParameter(field, text)


def add_residuals(algorithm: QgsProcessingAlgorithm) -> None:
    """Add the fields of the outputs."""
    algorithm.addParameter(
        QgsProcessingParameterVectorDestination("OUTPUT", "Errors at checkpoints", optional=True),
        "The checkpoints with their errors (ERROR, in metres): ground minus checkpoint.",
    )
    filters = tr("HTML files (*.html)")
    algorithm.addParameter(
        QgsProcessingParameterFileDestination("REPORT", "Report", filters, None, True, True),
        "A web page with the figures, the statement, and a map of the errors.",
    )


def residuals_path(
    algorithm: QgsProcessingAlgorithm,
    parameters: dict[str, Any],
    context: QgsProcessingContext,
    checkpoints: Checkpoints | None,
) -> str:
    """Return the path of the layer of errors; empty if it is not wanted, or has no checkpoints."""
    path = algorithm.parameterAsOutputLayer(parameters, "OUTPUT", context)
    if path and checkpoints is None:
        do_not_load(context, [path])
        return ""
    return path


def judgement_of(
    algorithm: QgsProcessingAlgorithm, parameters: dict[str, Any], context: QgsProcessingContext
) -> dict[str, Any]:
    """Return the values of `add_judgement`, as `CheckRequest` takes them.

    Raises
    ------
    BareEarthError
        If the raster is not a file.
    """
    text, sure = algorithm.parameterAsString(parameters, _VEGETATED, context), None
    if not compat.is_empty(parameters.get(_CONFIDENCE)):
        refusal = mark("The confidence is not a file. Export it as GeoTIFF first.")
        sure = raster_of(algorithm, parameters, _CONFIDENCE, context, refusal).source()
    words = tuple(word for each in text.split(",") if (word := each.strip()))
    found = {"confidence": sure} if sure else {}
    return found if words in ((), VEGETATED) else {**found, "vegetated": words}


def checkpoints_of(
    algorithm: QgsProcessingAlgorithm,
    parameters: dict[str, Any],
    context: QgsProcessingContext,
    crs: CloudCrs,
    progress: FeedbackProgress,
) -> tuple[Checkpoints | None, dict[str, Any]]:
    """Return the checkpoints in the CRS of the points, and the options for the command line.

    Progress receives a message on how to give a layer in the command line.

    Raises
    ------
    BareEarthError
        If they cannot be read.
    """
    if compat.is_empty(parameters.get(_LAYER)):
        return None, {}
    chosen = {
        role: name
        for field, (role, _, _) in _FIELDS.items()
        if (name := algorithm.parameterAsString(parameters, field, context))
    }
    columns = ",".join(f"{role}={name}" for role, name in chosen.items())
    path = _table_of(parameters[_LAYER])
    if path is not None:
        return read_checkpoints(path, columns), {"checkpoints": str(path), "columns": columns}
    progress.info(
        "In the command line the checkpoints are missing: save them as checkpoints.gpkg, and add"
        " --checkpoints checkpoints.gpkg."
    )
    source = algorithm.parameterAsSource(parameters, _LAYER, context)
    names = source.fields().names() if source is not None else []
    fields = {role: names[each] for role, each in recognised(names, chosen, _LAYER).items()}
    wanted = [each for role, each in fields.items() if role not in "xy"]
    rows = [
        _row(each, fields, chosen)
        for each in features_of(source, "Checkpoints", crs.value, context, wanted)
        if each.hasGeometry()
    ]
    if not rows:
        raise Refusal(mark("The layer of the checkpoints has no points."))
    places, names, covers = zip(*rows)
    numbered = [name or str(number) for number, name in enumerate(names, start=1)]
    return Checkpoints.of(places, numbered, covers), {}


def _table_of(value: Any) -> Path | None:
    """Return the file if the value of the field is the path of a table."""
    path = Path(value) if isinstance(value, (str, Path)) else None
    return path if path and path.suffix.lower() in SUFFIXES and path.is_file() else None


def _row(
    feature: QgsFeature, fields: dict[str, str], chosen: dict[str, str]
) -> tuple[tuple[float, float, float], str, str]:
    """Return place, name and cover of a feature."""
    point = feature.geometry().constGet()
    point = point if hasattr(point, "x") else point.geometryN(0)  # of several points, the first
    height = point.z() if point.is3D() and "z" not in chosen else None
    if height is None:
        given = feature[fields["z"]] if "z" in fields else None
        height = None if compat.is_null(given) else number_of(given)
    if height is None:
        text = mark("A checkpoint has no height. Choose the attribute with the heights.")
        raise Refusal(text)
    name, cover = (_word(feature, fields.get(role)) for role in ("name", "cover"))
    return (point.x(), point.y(), height), name, cover


def _word(feature: QgsFeature, field: str | None) -> str:
    """Return an attribute as text; empty if there is none."""
    value = feature[field] if field else None
    return "" if compat.is_null(value) else str(value).strip()
