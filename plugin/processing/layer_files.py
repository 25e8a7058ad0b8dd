"""The files of layers of lines and polygons, for the command line in the log."""

from __future__ import annotations

from qgis.core import (
    QgsProcessingAlgorithm,
    QgsProcessingContext,
    QgsProcessingFeatureSourceDefinition,
    QgsVectorLayer,
)

from ..styles.loaded import file_of, filter_of, has_edits

_DRIVER = "ogr"


def file_for_command(
    algorithm: QgsProcessingAlgorithm,
    parameters: dict[str, object],
    name: str,
    context: QgsProcessingContext,
) -> str:
    """Return the file that holds what the layer in a field holds; empty if no file does, such as
    for a layer with a filter, a selection, edits or another CRS than its file.
    """
    value = parameters.get(name)
    if isinstance(value, QgsProcessingFeatureSourceDefinition):
        is_whole = not value.selectedFeaturesOnly and value.featureLimit < 0
        if not is_whole or getattr(value, "filterExpression", False):  # 3.32
            return ""
    layer = algorithm.parameterAsVectorLayer(parameters, name, context)
    if not isinstance(layer, QgsVectorLayer) or layer.providerType() != _DRIVER:
        return ""
    path, provider = file_of(layer), layer.dataProvider()
    if path is None or not path.is_file() or filter_of(layer) or has_edits(layer):
        return ""
    is_same = layer.crs() == provider.crs() and len(provider.subLayers()) <= 1
    return str(path) if is_same else ""
