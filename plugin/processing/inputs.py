"""Point clouds as input: a layer of the project, or a file that QGIS need not be able to load."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from qgis.core import (
    QgsMapLayer,
    QgsPointCloudLayer,
    QgsProcessingAlgorithm,
    QgsProcessingContext,
    QgsProcessingParameterPointCloudLayer,
    QgsProcessingUtils,
    QgsProviderRegistry,
)
from qgis.PyQt.QtCore import QUrl

from ...algorithms.errors import BareEarthError


class PointCloudInput(QgsProcessingParameterPointCloudLayer):
    """A point cloud layer, or any existing file.

    QGIS takes only what it can load, which without its `pdal` provider excludes .las and .laz, and
    with it would index the whole file first.
    """

    def clone(self) -> PointCloudInput:
        """Return a copy; dialogs and models work with copies, which must take files too."""
        return PointCloudInput(self)

    def checkValueIsAcceptable(
        self, value: Any, context: QgsProcessingContext | None = None
    ) -> bool:
        """Return whether `value` is a file or what QGIS itself accepts."""
        if isinstance(value, (str, Path)) and _file(str(value)) is not None:
            return True
        return super().checkValueIsAcceptable(value, context)

    def createFileFilter(self) -> str:
        """Return the file types for the dialog's "..."; those of QGIS depend on the build."""
        return "Point clouds (*.las *.laz *.LAS *.LAZ);;All files (*.*)"


def source_path(
    algorithm: QgsProcessingAlgorithm,
    parameters: dict[str, Any],
    name: str,
    context: QgsProcessingContext,
) -> Path:
    """Return the file of a `PointCloudInput`, without loading it as a layer.

    Raises
    ------
    BareEarthError
        If there is none.
    """
    value = parameters.get(name)
    layer = value if isinstance(value, QgsMapLayer) else None
    if layer is None:
        text = str(value) if isinstance(value, Path) else ""
        text = text or algorithm.parameterAsString(parameters, name, context)
        path = _file(text)
        if path is not None:
            return path
        layer = QgsProcessingUtils.mapLayerFromString(text, context, False)
        if layer is None:
            raise BareEarthError(
                f"{text} does not exist. Check the path." if text else "Choose a point cloud."
            )
    return _path_of(layer)


def ignored_filter(
    algorithm: QgsProcessingAlgorithm,
    parameters: dict[str, Any],
    name: str,
    context: QgsProcessingContext,
) -> str:
    """Return the filter of the input layer, which does not reach its file; empty if none."""
    layer = parameters.get(name)
    if not isinstance(layer, QgsMapLayer):
        text = algorithm.parameterAsString(parameters, name, context)
        layer = QgsProcessingUtils.mapLayerFromString(text, context, False)
    # Point cloud layers have filters from 3.26 on.
    return layer.subsetString() if hasattr(layer, "subsetString") else ""


def _path_of(layer: QgsMapLayer) -> Path:
    if not isinstance(layer, QgsPointCloudLayer):
        raise BareEarthError(
            f"{layer.name()} is not a point cloud. Choose a point cloud layer, or a .las or .laz"
            " file."
        )
    provider = layer.dataProvider().name() if layer.dataProvider() else ""
    parts = QgsProviderRegistry.instance().decodeUri(provider, layer.source())
    path = parts.get("path") or layer.source()
    if "://" in path:
        raise BareEarthError(
            f"{layer.name()} is not a file of this computer. Download it as .las or .laz first."
        )
    return Path(path)


def _file(text: str) -> Path | None:
    """Return the file or folder that `text` names, if there is one."""
    path = QUrl(text).toLocalFile() if text.startswith("file:") else text
    return Path(path) if path and Path(path).exists() else None
