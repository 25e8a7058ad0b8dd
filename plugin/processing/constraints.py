"""Fields for layers that change the terrain: breaklines, water, rivers, places without ground."""

from __future__ import annotations

from typing import Any

from qgis.core import (
    QgsProcessingAlgorithm,
    QgsProcessingContext,
    QgsProcessingParameterFeatureSource,
)

from ...algorithms.core.progress import Progress
from ...algorithms.tools.rasters.constraints import INPUTS, Constraints
from .. import compat
from .inputs import CloudCrs, layer_shapes

_KINDS = {"lines": compat.LINES, "polygons": compat.POLYGONS}


def add_constraints(algorithm: QgsProcessingAlgorithm) -> None:
    """Add the fields of the layers to a dialog, as advanced parameters."""
    for given in INPUTS:
        field = QgsProcessingParameterFeatureSource(
            given.field_name, given.label, [_KINDS[given.kind]], None, True
        )
        field.setFlags(field.flags() | compat.ADVANCED)
        algorithm.addParameter(field, given.field_help)


def constraints_of(
    algorithm: QgsProcessingAlgorithm,
    parameters: dict[str, Any],
    context: QgsProcessingContext,
    crs: CloudCrs,
    progress: Progress,
) -> Constraints:
    """Return the contents of the layers, in the CRS of the points; a message says how to give these
    layers in the command line.
    """
    shapes: dict[str, Any] = {}
    for given in INPUTS:
        name, kind = given.field_name, _KINDS[given.kind]
        if not compat.is_empty(parameters.get(name)):
            found = layer_shapes(algorithm, parameters, name, given.label, context, crs, kind)
            shapes[given.name] = tuple(corners for corners, _ in found)
    if shapes:
        names = [name.replace("_", "-") for name in shapes]
        progress.info(
            "In the command line some layers are missing: save each in the CRS of the points as"
            f" GeoJSON, and add {' '.join(f'--{name} {name}.geojson' for name in names)}."
        )
    return Constraints(**shapes)
