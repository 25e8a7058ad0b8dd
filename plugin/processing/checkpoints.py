"""Fields for checkpoints: a layer of points, or a table."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from qgis.core import (
    QgsFeature,
    QgsMultiPoint,
    QgsPoint,
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

from ...algorithms.core.progress import Progress
from ...algorithms.tools.check.checkpoints import Checkpoints
from ...algorithms.tools.check.reading import Record, checkpoints_of_rows, read_checkpoints
from ...algorithms.tools.check.tables import SUFFIXES
from .. import compat
from ..i18n import mark, tr
from .feedback import Refusal
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
        " reported apart, and those of type Control are left out. Empty: an attribute with a usual"
        " name, such as class.",
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
    words = QgsProcessingParameterString(_VEGETATED, "Vegetated land covers", None, False, True)
    text = (
        "Words separated by commas: a land cover with one of them is vegetated, and no other."
        " Empty: words such as forest, crops and brush in several languages."
    )
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
    """Return the values of `add_judgement` for `CheckRequest`; the raster must be a file."""
    text, sure = algorithm.parameterAsString(parameters, _VEGETATED, context), None
    if not compat.is_empty(parameters.get(_CONFIDENCE)):
        refusal = mark("The confidence is not a file. Export it as GeoTIFF first.")
        sure = raster_of(algorithm, parameters, _CONFIDENCE, context, refusal).source()
    words = tuple(word for each in text.split(",") if (word := each.strip()))
    found = {"confidence": sure} if sure else {}
    return {**found, "vegetated": words} if words else found


def checkpoints_of(
    algorithm: QgsProcessingAlgorithm,
    parameters: dict[str, Any],
    context: QgsProcessingContext,
    crs: CloudCrs,
    progress: Progress,
) -> tuple[Checkpoints | None, dict[str, Any]]:
    """Return the checkpoints in the CRS of the points, and the options for the command line; a
    message says how to give a layer there.
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
    features = features_of(source, "Checkpoints", crs.value, context, names)
    records = [
        _record(number, feature, names)
        for number, feature in enumerate(features, start=1)
        if feature.hasGeometry()
    ]
    if not records:
        raise Refusal(mark('The layer "{}" holds no point. Choose one that does.'), "Checkpoints")
    return checkpoints_of_rows(names, records, chosen, source.sourceName()), {}


def _table_of(value: Any) -> Path | None:
    """Return the file if the value of the field is the path of a table."""
    path = Path(value) if isinstance(value, (str, Path)) else None
    return path if path and path.suffix.lower() in SUFFIXES and path.is_file() else None


def _record(number: int, feature: QgsFeature, names: list[str]) -> Record:
    """Return the place and the attributes of a feature."""
    point = feature.geometry().constGet()
    if isinstance(point, QgsMultiPoint):  # of several points, the first
        point = point.geometryN(0)
    if not isinstance(point, QgsPoint):
        raise Refusal(mark('The layer "{}" holds no point. Choose one that does.'), "Checkpoints")
    place = np.array([point.x(), point.y(), point.z() if point.is3D() else np.nan])
    cells = [None if compat.is_null(feature[name]) else feature[name] for name in names]
    return Record(f"Point {number}", cells, place)
