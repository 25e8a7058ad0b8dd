"""Fields for layers that change the terrain: breaklines, water, rivers, places without ground."""

from __future__ import annotations

from typing import Any

from qgis.core import (
    QgsProcessingAlgorithm,
    QgsProcessingContext,
    QgsProcessingParameterFeatureSource,
)

from ...algorithms.core.progress import Progress
from ...algorithms.tools.rasters.constraints import Constraints
from .. import compat
from .inputs import CloudCrs, layer_shapes

# Name, label, kind of the layer and help of each field.
_FIELDS = {
    "BREAKLINES": (
        "Breaklines",
        compat.LINES,
        "Lines that no triangle of the terrain crosses: edges of walls, dykes and terraces. A line"
        " with z has this height. Without z, each side of the line has the height of the nearest"
        " ground point on that side.",
    ),
    "WATER": (
        "Water",
        compat.POLYGONS,
        "Polygons of water. Each is flattened to one level, that of the ground along its border.",
    ),
    "RIVERS": (
        "Rivers",
        compat.LINES,
        "Lines along which the level of the water polygons falls. They may be drawn in either"
        " direction.",
    ),
    "NO_GROUND": (
        "No ground here",
        compat.POLYGONS,
        "Polygons in which the terrain uses no ground points, such as bridges and roofs. The"
        " classes of the points do not change.",
    ),
}


def add_constraints(algorithm: QgsProcessingAlgorithm) -> None:
    """Add the fields of the layers to a dialog, as advanced parameters."""
    for name, (label, kind, text) in _FIELDS.items():
        field = QgsProcessingParameterFeatureSource(name, label, [kind], None, True)
        field.setHelp(text)
        field.setFlags(field.flags() | compat.ADVANCED)
        algorithm.addParameter(field)


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
    for name, (label, kind, _) in _FIELDS.items():
        if not compat.is_empty(parameters.get(name)):
            found = layer_shapes(algorithm, parameters, name, label, context, crs, kind)
            shapes[name.lower()] = tuple(corners for corners, _ in found)
    if shapes:
        names = [name.replace("_", "-") for name in shapes]
        progress.info(
            "In the command line some layers are missing: save each in the CRS of the points as"
            f" GeoJSON, and add {' '.join(f'--{name} {name}.geojson' for name in names)}."
        )
    return Constraints(**shapes)
