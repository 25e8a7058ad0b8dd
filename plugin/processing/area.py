"""Fields for the area to classify: an extent and a boundary."""

from __future__ import annotations

from typing import Mapping, Sequence

from qgis.core import (
    QgsProcessingAlgorithm,
    QgsProcessingContext,
    QgsProcessingParameterExtent,
    QgsProcessingParameterFeatureSource,
)

from ...algorithms.core.parameters import ParameterSet
from ...algorithms.core.progress import Progress
from ...algorithms.survey.area import Area, Polygon
from ...algorithms.survey.shapes import Shapes
from ...algorithms.tools.declaration import Input, help_of_area
from ...algorithms.tools.ground.output import PointOutput
from .. import compat
from ..i18n import mark
from .feedback import Refusal
from .inputs import CloudCrs, box_of, layer_shapes, rings_of
from .stated_crs import text_of

_FIELDS = "EXTENT", "BOUNDARY"
_BOUNDARY = "BOUNDARY", "Boundary"  # field and label


def add_area(algorithm: QgsProcessingAlgorithm, declared: Input) -> None:
    """Add the fields of an area to a dialog."""
    extent = QgsProcessingParameterExtent("EXTENT", "Extent", None, True)
    kinds = [compat.POLYGONS]
    boundary = QgsProcessingParameterFeatureSource(*_BOUNDARY, kinds, None, True)
    for field, text in zip((extent, boundary), help_of_area(declared.help)):
        if declared.advanced or field is boundary:
            field.setFlags(field.flags() | compat.ADVANCED)
        algorithm.addParameter(field, text)


def area_of(
    algorithm: QgsProcessingAlgorithm,
    parameters: dict[str, object],
    context: QgsProcessingContext,
    crs: CloudCrs,
) -> Area | None:
    """Return the area in the fields of `add_area`, in the CRS of the points; None if empty, and an
    error for a boundary without polygons.
    """
    given = [name for name in _FIELDS if not compat.is_empty(parameters.get(name))]
    if not given:
        return None
    box = None
    polygons: tuple[Polygon, ...] = ()
    if "EXTENT" in given:
        box = box_of(algorithm, parameters, "EXTENT", context, crs)
    if "BOUNDARY" in given:
        polygons = _polygons_of(algorithm, parameters, context, crs)
    return Area(box, polygons)


def _polygons_of(
    algorithm: QgsProcessingAlgorithm,
    parameters: dict[str, object],
    context: QgsProcessingContext,
    crs: CloudCrs,
) -> tuple[Polygon, ...]:
    """Return the polygons of the boundary; refuse a layer without any."""
    found = layer_shapes(algorithm, parameters, *_BOUNDARY, context, crs, may_be_empty=False)
    return tuple(rings for rings, _ in found)


def has_area(parameters: Mapping[str, object]) -> bool:
    """Return whether a field of `add_area` is filled."""
    return not all(compat.is_empty(parameters.get(name)) for name in _FIELDS)


def area_in_own_crs(
    algorithm: QgsProcessingAlgorithm, parameters: dict[str, object], context: QgsProcessingContext
) -> Area | None:
    """Return the area in the fields of `add_area` with its own CRS, for points of unknown CRS."""
    given = [name for name in _FIELDS if not compat.is_empty(parameters.get(name))]
    if not given:
        return None
    if len(given) > 1:
        raise Refusal(mark("Give an extent or a boundary, not both, for an address."))
    if "EXTENT" in given:
        crs = algorithm.parameterAsExtentCrs(parameters, "EXTENT", context)
        if not crs.isValid():
            box = algorithm.parameterAsExtent(parameters, "EXTENT", context)
            return Area((box.xMinimum(), box.yMinimum(), box.xMaximum(), box.yMaximum()))
        shape = algorithm.parameterAsExtentGeometry(parameters, "EXTENT", context, crs)
        polygons: Sequence[Polygon] = [rings_of(shape.constGet())]
    else:
        source = algorithm.parameterAsSource(parameters, "BOUNDARY", context)
        crs = CloudCrs(stated=source.sourceCrs().toWkt() if source is not None else None)
        polygons = _polygons_of(algorithm, parameters, context, crs)
        crs = crs.value
    return Area(None, Shapes(polygons, text_of(crs), "The area"))


def check_area_only(parameters: dict[str, object], chosen: Sequence[ParameterSet]) -> None:
    """Refuse to write only the points in the area if there is no area."""
    for values in chosen:
        if isinstance(values, PointOutput):
            values.check_area(has_area(parameters))


def area_options(area: Area | None, file: str, progress: Progress) -> dict[str, tuple[str, ...]]:
    """Return the options of the command line for an area, given the file of its boundary; without
    one, tell the user how to add it.
    """
    if area is None:
        return {}
    if area.polygons and not file:
        progress.info(
            "In the command line the boundary is missing: save it in the CRS of the points"
            " as boundary.geojson, and add --boundary boundary.geojson."
        )
    box = tuple(map(repr, area.box)) if area.box else ()
    return {"extent": box, "boundary": (file,) if file else ()}
