"""Fields for the area to classify: an extent and a boundary."""

from __future__ import annotations

from typing import Any, Mapping, Sequence

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
from ...algorithms.tools.ground.output import Output
from .. import compat
from ..i18n import mark
from .feedback import Refusal
from .inputs import CloudCrs, box_of, layer_polygons, rings_of
from .stated_crs import text_of

# Name, label and help of the fields of an area.
_AREA_FIELDS = {
    "EXTENT": (
        "Extent",
        "Only points in this rectangle are classified, and rasters end at it. Points outside keep"
        " their class, but those nearby help to judge. Empty: all points.",
    ),
    "BOUNDARY": (
        "Boundary",
        "Only points in these polygons are classified, and rasters end at them; with an extent,"
        " only what lies in both. Points outside keep their class, but those nearby help to judge."
        " Empty: all points.",
    ),
}
# Their help in other algorithms, by the beginning of that of their options.
HELPS = {
    "deliver only": {
        "EXTENT": "Only points in this rectangle are mapped and written. Points nearby help to"
        " judge. Empty: all points.",
        "BOUNDARY": "Only points in these polygons are mapped and written; with an extent, only"
        " points in both. Points nearby help to judge. Empty: all points.",
    },
    "make the rasters only in": {
        "EXTENT": "The rasters end at this rectangle. Points outside still help along its border."
        " Empty: the rasters cover all points.",
        "BOUNDARY": "The rasters have data only in these polygons; with an extent, only in both."
        " Points outside still help along the border. Empty: the rasters cover all points.",
    },
    "download only points in": {
        "EXTENT": "Only points in this rectangle are downloaded. Empty: all points.",
        "BOUNDARY": "Only points in these polygons are downloaded; with an extent, only points in"
        " both. Empty: all points.",
    },
}


def add_area(
    algorithm: QgsProcessingAlgorithm,
    advanced: Sequence[str] = ("BOUNDARY",),
    helps: Mapping[str, str] = {},
) -> None:
    """Add the fields of an area to a dialog, some, by name, advanced or with other helps."""
    extent, boundary = (label for label, _ in _AREA_FIELDS.values())
    fields = (
        QgsProcessingParameterExtent("EXTENT", extent, None, True),
        QgsProcessingParameterFeatureSource("BOUNDARY", boundary, [compat.POLYGONS], None, True),
    )
    for field in fields:
        if field.name() in advanced:
            field.setFlags(field.flags() | compat.ADVANCED)
        text = helps.get(field.name(), _AREA_FIELDS[field.name()][1])
        algorithm.addParameter(field, text)


def area_of(
    algorithm: QgsProcessingAlgorithm,
    parameters: dict[str, Any],
    context: QgsProcessingContext,
    crs: CloudCrs,
) -> Area | None:
    """Return the area in the fields of `add_area`, in the CRS of the points; None if empty, and an
    error for a boundary without polygons.
    """
    given = [name for name in _AREA_FIELDS if not compat.is_empty(parameters.get(name))]
    if not given:
        return None
    box = None
    polygons: tuple[Polygon, ...] = ()
    if "EXTENT" in given:
        box = box_of(algorithm, parameters, "EXTENT", context, crs)
    if "BOUNDARY" in given:
        label = _AREA_FIELDS["BOUNDARY"][0]
        polygons = layer_polygons(algorithm, parameters, "BOUNDARY", label, context, crs)
    return Area(box, polygons)


def has_area(parameters: Mapping[str, Any]) -> bool:
    """Return whether a field of `add_area` is filled."""
    return not all(compat.is_empty(parameters.get(name)) for name in _AREA_FIELDS)


def area_in_own_crs(
    algorithm: QgsProcessingAlgorithm, parameters: dict[str, Any], context: QgsProcessingContext
) -> Area | None:
    """Return the area in the fields of `add_area` with its own CRS, for points of unknown CRS."""
    given = [name for name in _AREA_FIELDS if not compat.is_empty(parameters.get(name))]
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
        label = _AREA_FIELDS["BOUNDARY"][0]
        polygons = layer_polygons(algorithm, parameters, "BOUNDARY", label, context, crs)
        crs = crs.value
    return Area(None, Shapes(polygons, text_of(crs), "The area"))


def check_area_only(parameters: dict[str, Any], chosen: Sequence[ParameterSet]) -> None:
    """Refuse to write only the points in the area if there is no area."""
    for values in chosen:
        if isinstance(values, Output):
            values.check_area(has_area(parameters))


def area_options(area: Area | None, progress: Progress) -> dict[str, Any]:
    """Return the options of the command line for an area; tell the user how to add a boundary."""
    if area is not None and area.polygons:
        progress.info(
            "In the command line the boundary is missing: save it in the CRS of the points"
            " as boundary.geojson, and add --boundary boundary.geojson."
        )
    return {"extent": tuple(map(repr, area.box)) if area is not None and area.box else ()}
