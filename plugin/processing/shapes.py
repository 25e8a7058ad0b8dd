"""Lines, polygons and rectangles of dialogs, in the CRS of the points."""

from __future__ import annotations

from typing import Any, Iterator, Sequence

import numpy as np
from qgis.core import (
    QgsCoordinateReferenceSystem,
    QgsCurve,
    QgsCurvePolygon,
    QgsFeature,
    QgsFeatureRequest,
    QgsPolygon,
    QgsProcessingFeatureSource,
    QgsProcessingFeatureSourceDefinition,
    QgsVectorLayer,
)

from ...algorithms.core.points import Box
from ...algorithms.survey.area import Area, Polygon
from ...algorithms.survey.shapes import Shapes
from ...algorithms.tools.declaration import Input
from .. import compat
from ..i18n import mark
from ..styles.loaded import file_of, filter_of, has_edits
from .cloud_crs import CloudCrs, text_of
from .feedback import Refusal
from .request import Request

AREA = "EXTENT", "BOUNDARY"  # the fields
BOUNDARY = Input("boundary", "polygons", label="Boundary", advanced=True)


def features_of(
    source: QgsProcessingFeatureSource | None,
    label: str,
    crs: QgsCoordinateReferenceSystem,
    request: Request,
    attributes: Sequence[str] = (),
) -> Iterator[QgsFeature]:
    """Yield features of a layer, transformed to a CRS, with some attributes; errors name it."""
    if source is None:
        raise Refusal(mark('The layer "{}" cannot be read.'), label)
    wanted = QgsFeatureRequest().setSubsetOfAttributes(list(attributes), source.fields())
    wanted.setDestinationCrs(crs, request.context.transformContext())
    yield from source.getFeatures(wanted)


def box_of(request: Request, name: str, crs: CloudCrs) -> Box:
    """Return the rectangle in a field, in the CRS of the points."""
    box = request.read("Extent", name, crs.value)
    return box.xMinimum(), box.yMinimum(), box.xMaximum(), box.yMaximum()


def layer_shapes(
    request: Request,
    declared: Input,
    crs: CloudCrs,
    attributes: Sequence[str] = (),
    may_be_empty: bool = True,
) -> tuple[tuple[Any, Any], ...]:
    """Return the polygons (rings, float64 (n, 2)) or lines (x, y, and z or NaN, (n, 3)) of a layer,
    in the CRS of the points, and attributes of each, by name.
    """
    # Geometries of other kinds are not used; a layer with only these is refused, and an empty one
    # unless it may be empty.
    source = request.read("Source", declared.field_name)
    shape, corners_of, refusal = _KINDS[declared.kind]
    found, others = [], 0
    for feature in features_of(source, declared.label, crs.value, request, attributes):
        values = {name: feature[name] for name in attributes}
        values = {name: None if compat.is_null(one) else one for name, one in values.items()}
        for part in feature.geometry().constParts():
            if isinstance(part, shape):
                found.append((corners_of(part.segmentize()), values))
            else:
                others += 1
    if not found and (others or not may_be_empty):
        raise Refusal(refusal, declared.label)
    return tuple(found)


def _rings_of(polygon: QgsPolygon) -> Polygon:
    """Return the rings of a polygon, float64 (n, 2) each."""
    rings = [polygon.exteriorRing(), *map(polygon.interiorRing, range(polygon.numInteriorRings()))]
    return tuple(_line_of(ring)[:, :2] for ring in rings if ring is not None)


def _line_of(line: QgsCurve) -> np.ndarray:
    rows = [(corner.x(), corner.y(), corner.z()) for corner in line.vertices()]
    return np.array(rows, dtype=float).reshape(-1, 3)


# The class of a geometry of a kind, what returns its corners, and the message if it has none.
_KINDS = {
    "polygons": (
        QgsCurvePolygon, _rings_of,
        mark('The layer "{}" holds no polygon. Choose one that does.'),
    ),
    "lines": (
        QgsCurve, _line_of, mark('The layer "{}" holds no line. Choose one that does.')
    ),
}  # fmt: skip


def has_area(request: Request) -> bool:
    """Return whether an extent or a boundary is given."""
    return not all(map(request.is_empty, AREA))


def area_of(request: Request, crs: CloudCrs) -> Area | None:
    """Return the area of an extent and a boundary; None if both fields are empty."""
    if not has_area(request):
        return None
    if not crs.is_known:
        return _area_in_own_crs(request)
    box = None if request.is_empty("EXTENT") else box_of(request, "EXTENT", crs)
    return Area(box, () if request.is_empty("BOUNDARY") else _boundary_of(request, crs))


def _boundary_of(request: Request, crs: CloudCrs) -> tuple[Polygon, ...]:
    shapes = layer_shapes(request, BOUNDARY, crs, may_be_empty=False)
    return tuple(rings for rings, _ in shapes)


def _area_in_own_crs(request: Request) -> Area:
    """Return the area with its own CRS, for points whose CRS is not known yet."""
    if not any(map(request.is_empty, AREA)):
        raise Refusal(mark("Give an extent or a boundary, not both, for an address."))
    if request.is_empty("EXTENT"):
        source = request.read("Source", "BOUNDARY")
        stated = CloudCrs(stated=source.sourceCrs().toWkt() if source is not None else None)
        polygons: Sequence[Polygon] = _boundary_of(request, stated)
        crs = stated.value
    else:
        crs = request.read("ExtentCrs", "EXTENT")
        if not crs.isValid():
            return Area(box_of(request, "EXTENT", CloudCrs(stated="WKT:")))
        shape = request.read("ExtentGeometry", "EXTENT", crs)  # which owns what it gives out
        polygons = [_rings_of(shape.constGet())]
    return Area(None, Shapes(polygons, text_of(crs), "The area"))


def file_for_command(request: Request, name: str) -> str:
    """Return the file that holds what the layer in a field holds; empty if no file does, such as
    for a layer with a filter, a selection, edits or another CRS than its file.
    """
    value = request.parameters.get(name)
    if isinstance(value, QgsProcessingFeatureSourceDefinition):
        is_whole = not value.selectedFeaturesOnly and value.featureLimit < 0
        if not is_whole or getattr(value, "filterExpression", False):  # 3.32
            return ""
    layer = request.read("VectorLayer", name)
    if not isinstance(layer, QgsVectorLayer) or layer.providerType() != "ogr":
        return ""
    path, provider = file_of(layer), layer.dataProvider()
    if path is None or not path.is_file() or filter_of(layer) or has_edits(layer):
        return ""
    is_same = layer.crs() == provider.crs() and len(provider.subLayers()) <= 1
    return str(path) if is_same else ""
