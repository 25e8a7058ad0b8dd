"""Checkpoints: a layer of points, or a table."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
from qgis.core import (
    QgsFeature,
    QgsMultiPoint,
    QgsPoint,
    QgsProcessingContext,
    QgsProcessingFeatureSourceDefinition,
    QgsProcessingParameterFeatureSource,
    QgsProcessingUtils,
    QgsProviderRegistry,
    QgsVectorLayer,
)

from ...algorithms.core.errors import BareEarthError
from ...algorithms.tools.check.reading import CheckpointRow, checkpoints_of_rows, read_checkpoints
from ...algorithms.tools.check.tables import SUFFIXES, read_table
from ...algorithms.tools.declaration import Input
from .. import compat
from ..i18n import mark, tr
from ..styles.loaded import filter_of, has_edits
from .feedback import Refusal
from .request import GivenInput, Request, Resolved
from .shapes import features_of

_LAYER = "CHECKPOINTS"
# The roles of attributes, by their fields.
_ROLES = {"Z_FIELD": "z", "COVER_FIELD": "cover", "NAME_FIELD": "name"}


class CheckpointInput(QgsProcessingParameterFeatureSource):
    """A layer of points, a table, or a text file of points, which QGIS itself can't load."""

    def clone(self) -> CheckpointInput:
        return CheckpointInput(self)

    def checkValueIsAcceptable(
        self, value: object, context: QgsProcessingContext | None = None
    ) -> bool:
        """Return whether `value` is the path of a table, or QGIS accepts it."""
        return _file_of(value) is not None or super().checkValueIsAcceptable(value, context)

    def createFileFilter(self) -> str:
        endings = " ".join(f"*{suffix}" for suffix in SUFFIXES)
        return f"{tr('Tables')} ({endings});;{super().createFileFilter()}"


def checkpoints_of(request: Request, declared: Input, resolved: Resolved) -> GivenInput:
    """Return the checkpoints in the CRS of the points, and the options for the command line; a
    message says how to give a layer there.
    """
    if request.is_empty(_LAYER):
        return GivenInput(None)
    named = ((role, request.read("String", field)) for field, role in _ROLES.items())
    chosen = {role: name for role, name in named if name}
    columns = ",".join(f"{role}={name}" for role, name in chosen.items())
    path = _table_of(request.parameters[_LAYER], request.context)
    if path is not None:
        options = {"checkpoints": str(path), "columns": columns}
        return GivenInput(read_checkpoints(path, columns), options)
    request.progress.info(
        "In the command line the checkpoints are missing: save them as checkpoints.gpkg, and add"
        " --checkpoints checkpoints.gpkg."
    )
    source = request.read("Source", _LAYER)
    names = source.fields().names() if source is not None else []
    features = features_of(source, "Checkpoints", resolved.crs.value, request, names)
    is_table = source is not None and source.wkbType() == compat.NO_GEOMETRY
    records = [
        _record(number, feature, names, is_table)
        for number, feature in enumerate(features, start=1)
        if is_table or feature.hasGeometry()
    ]
    if not records:
        raise Refusal(mark('The layer "{}" holds no point. Choose one that does.'), "Checkpoints")
    return GivenInput(checkpoints_of_rows(names, records, chosen, source.sourceName()))


def names_in(value: Any, context: QgsProcessingContext) -> list[str]:
    """Return the names of the columns or attributes of a value of the field; none if it cannot be
    read.
    """
    if isinstance(value, QgsProcessingFeatureSourceDefinition):
        value = value.source.staticValue()
    path, layer = _table_of(value, context), value
    if path is not None:
        with suppress(BareEarthError):  # the run tells it
            return read_table(path).columns
        return []
    if isinstance(value, str) and value:
        layer = QgsProcessingUtils.mapLayerFromString(value, context)
    return layer.fields().names() if isinstance(layer, QgsVectorLayer) else []


def _file_of(value: object) -> Path | None:
    """Return the file if the value of the field is the path of a table."""
    path = Path(value) if isinstance(value, (str, Path)) else None
    return path if path and path.suffix.lower() in SUFFIXES and path.is_file() else None


def _table_of(value: object, context: QgsProcessingContext) -> Path | None:
    """Return the file of a table, also of one that a layer without geometry shows as it is."""
    layer = value
    if isinstance(value, str) and _file_of(value) is None:
        layer = QgsProcessingUtils.mapLayerFromString(value, context, False)
    if not isinstance(layer, QgsVectorLayer):
        return _file_of(value)
    if layer.isSpatial() or filter_of(layer) or has_edits(layer):
        return None
    parts = QgsProviderRegistry.instance().decodeUri(layer.providerType(), layer.source())
    return _file_of(parts.get("path"))


def _record(number: int, feature: QgsFeature, names: list[str], is_row: bool) -> CheckpointRow:
    """Return the attributes of a feature, and its place unless it is the row of a table."""
    cells = [None if compat.is_null(feature[name]) else feature[name] for name in names]
    if is_row:
        return CheckpointRow(f"Row {number}", cells)
    point = feature.geometry().constGet()
    if isinstance(point, QgsMultiPoint):  # of several points, the first
        point = point.geometryN(0)
    if not isinstance(point, QgsPoint):
        raise Refusal(mark('The layer "{}" holds no point. Choose one that does.'), "Checkpoints")
    place = np.array([point.x(), point.y(), point.z() if point.is3D() else np.nan])
    return CheckpointRow(f"Point {number}", cells, place)
