"""Metadata of layers: what they are, and the runs that made them."""

from __future__ import annotations

import datetime
from typing import Mapping, NamedTuple

from qgis.core import (
    QgsMapLayer,
    QgsProcessingAlgorithm,
    QgsProcessingContext,
    QgsProcessingUtils,
)

from ... import __version__
from ...algorithms.remote.addresses import shown
from .. import compat
from ..i18n import tr

# Older runs of a layer are forgotten.
_MOST_ENTRIES = 20


class Origin(NamedTuple):
    """The run that made a layer."""

    entry: str  # time, algorithm and version, for the history of the layer
    settings: tuple[str, ...]  # the parameters with their values
    commands: tuple[str, ...] = ()  # that do the same without QGIS

    @classmethod
    def of(cls, title: str, settings: tuple[str, ...], commands: tuple[str, ...] = ()) -> Origin:
        """Return the origin of layers of a run that ends now."""
        now = datetime.datetime.now().astimezone().isoformat(" ", "seconds")
        return cls(f"{now}: {title}, Bare Earth {__version__}", settings, commands)


def settings_of(
    algorithm: QgsProcessingAlgorithm,
    parameters: Mapping[str, object],
    context: QgsProcessingContext,
) -> tuple[str, ...]:
    """Return the inputs and parameters of a run in words, without empty ones."""
    found = []
    for field in algorithm.parameterDefinitions():
        value = parameters.get(field.name(), field.defaultValue())
        if not field.isDestination() and not compat.is_null(value) and value not in ("", []):
            found.append(f"{field.description()}: {_text(value, context)}")
    return tuple(found)


def _text(value: object, context: QgsProcessingContext) -> str:
    if isinstance(value, (list, tuple)):
        return ", ".join(_text(part, context) for part in value)
    layer = value
    if isinstance(value, str):
        layer = QgsProcessingUtils.mapLayerFromString(value, context, False)
    if isinstance(layer, QgsMapLayer):
        return f"{layer.name()} ({shown(layer.publicSource())})"
    return shown(str(value))  # of an address, without its signature


def describe(layer: QgsMapLayer, title: str, origin: Origin) -> None:
    """Set title, settings and history of a layer, where the history of earlier runs stays."""
    metadata = layer.metadata()
    metadata.setTitle(title)
    metadata.setType("dataset")
    metadata.setCrs(layer.crs())
    lines = [tr("Made by Bare Earth with these settings:"), *origin.settings]
    if origin.commands:
        lines += ["", tr("The same without QGIS:"), *origin.commands]
    metadata.setAbstract("\n".join(lines))
    metadata.setHistory([*metadata.history(), origin.entry][-_MOST_ENTRIES:])
    layer.setMetadata(metadata)
