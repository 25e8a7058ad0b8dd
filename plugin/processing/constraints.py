"""Layers that a terrain model must respect: breaklines, water, rivers, places without ground."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Callable, Iterator

import numpy as np
from qgis.core import (
    QgsGeometry,
    QgsProcessingAlgorithm,
    QgsProcessingContext,
    QgsProcessingParameterFeatureSource,
)

from ...algorithms.survey.collection import find_files
from .. import compat
from .inputs import crs_of, features_of, is_empty, polygons_of

# Name, label, kind of the layer and help of each field.
_FIELDS = {
    "BREAKLINES": (
        "Breaklines",
        compat.LINES,
        "Lines that no triangle of the terrain crosses: edges of walls, dykes and terraces. A line"
        " with z has that height; without z, each side of it has the height of the nearest ground"
        " point there.",
    ),
    "WATER": (
        "Water",
        compat.POLYGONS,
        "Polygons of water: flattened to one level, that of the ground along their border.",
    ),
    "RIVERS": (
        "Rivers",
        compat.LINES,
        "Lines along which the water in such polygons falls, drawn in either direction.",
    ),
    "NO_GROUND": (
        "No ground here",
        compat.POLYGONS,
        "Polygons in which no point is ground, such as bridges and roofs.",
    ),
}


def add_constraints(algorithm: QgsProcessingAlgorithm) -> None:
    """Add the fields of the layers to a dialog, folded away."""
    for name, (label, kind, text) in _FIELDS.items():
        field = QgsProcessingParameterFeatureSource(name, label, [kind], None, True)
        field.setHelp(text)
        field.setFlags(field.flags() | compat.ADVANCED)
        algorithm.addParameter(field)


def constraints_of(
    algorithm: QgsProcessingAlgorithm,
    parameters: dict[str, Any],
    context: QgsProcessingContext,
    cloud: Path,
) -> dict[str, tuple[Any, ...]]:
    """Return what the layers hold, in the CRS of a cloud, by the names of `Constraints`.

    Raises
    ------
    BareEarthError
        If a layer cannot be read.
    """
    given = [name for name in _FIELDS if not is_empty(parameters.get(name))]
    if not given:
        return {}
    crs, found = crs_of(find_files([cloud])[0]), {}
    for name in given:
        label, kind, _ = _FIELDS[name]
        source = algorithm.parameterAsSource(parameters, name, context)
        shapes: Callable[[QgsGeometry], Iterator[Any]] = (
            polygons_of if kind == compat.POLYGONS else _lines_of
        )
        features = features_of(source, label, crs, context)
        found[name.lower()] = tuple(each for one in features for each in shapes(one.geometry()))
    return found


def _lines_of(geometry: QgsGeometry) -> Iterator[np.ndarray]:
    """Yield x, y and z of the corners of each line; NaN for z where there is none."""
    for part in geometry.constParts():
        line = part.segmentize()
        rows = [(each.x(), each.y(), each.z()) for each in line.vertices()]
        yield np.array(rows, dtype=float).reshape(-1, 3)
