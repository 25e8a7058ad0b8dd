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
)

from ...algorithms.core.progress import Progress
from ...algorithms.tools.check.checkpoints import Checkpoints
from ...algorithms.tools.check.reading import Record, checkpoints_of_rows, read_checkpoints
from ...algorithms.tools.check.tables import SUFFIXES
from .. import compat
from ..i18n import mark
from .feedback import Refusal
from .inputs import CloudCrs, features_of

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


def _add(
    algorithm: QgsProcessingAlgorithm,
    field: QgsProcessingParameterDefinition,
    text: str,
    is_visible: bool = False,
) -> None:
    if not is_visible:
        field.setFlags(field.flags() | compat.ADVANCED)
    algorithm.addParameter(field, text)


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
