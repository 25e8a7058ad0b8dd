"""Checkpoints: a layer of points, or a table."""

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
)

from ...algorithms.core.progress import Progress
from ...algorithms.tools.check.checkpoints import Checkpoints
from ...algorithms.tools.check.reading import Record, checkpoints_of_rows, read_checkpoints
from ...algorithms.tools.check.tables import SUFFIXES
from .. import compat
from ..i18n import mark
from .feedback import Refusal
from .inputs import CloudCrs, features_of

_LAYER = "CHECKPOINTS"
# The roles of attributes, by their fields.
_ROLES = {"Z_FIELD": "z", "COVER_FIELD": "cover", "NAME_FIELD": "name"}


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
        for field, role in _ROLES.items()
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
