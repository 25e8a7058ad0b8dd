"""Fields for the area to classify: an extent and a boundary."""

from __future__ import annotations

from typing import Any, Sequence

from qgis.core import (
    QgsProcessingAlgorithm,
    QgsProcessingContext,
    QgsProcessingParameterExtent,
    QgsProcessingParameterFeatureSource,
)

from ...algorithms.core.errors import BareEarthError
from ...algorithms.core.parameters import ParameterSet
from ...algorithms.core.progress import Progress
from ...algorithms.engine.output import Output
from ...algorithms.survey.area import Area, Polygon
from .. import compat
from ..i18n import tr
from .constraints import add_known, known_of
from .inputs import CloudCrs, features_of, is_empty, polygons_of

# Name, label and help of the fields of an area.
_AREA_FIELDS = {
    "EXTENT": (
        "Extent",
        "Only points in this rectangle are classified. Points outside keep their class, but those"
        " nearby help to judge. Empty: all points.",
    ),
    "BOUNDARY": (
        "Boundary",
        "Only points in these polygons are classified; with an extent, only points in both. Points"
        " outside keep their class, but those nearby help to judge. Empty: all points.",
    ),
}


def add_area(algorithm: QgsProcessingAlgorithm, advanced: Sequence[str] = ("BOUNDARY",)) -> None:
    """Add the fields of an area to a dialog; `advanced` names the advanced ones."""
    extent, boundary = (label for label, _ in _AREA_FIELDS.values())
    fields = (
        QgsProcessingParameterExtent("EXTENT", extent, None, True),
        QgsProcessingParameterFeatureSource("BOUNDARY", boundary, [compat.POLYGONS], None, True),
    )
    for field in fields:
        if field.name() in advanced:
            field.setFlags(field.flags() | compat.ADVANCED)
        algorithm.addParameter(field, _AREA_FIELDS[field.name()][1])


def area_of(
    algorithm: QgsProcessingAlgorithm,
    parameters: dict[str, Any],
    context: QgsProcessingContext,
    crs: CloudCrs,
) -> Area | None:
    """Return the area in the fields of `add_area`, in the CRS of the points; None if empty.

    Raises
    ------
    BareEarthError
        If the boundary has no polygon, or the cloud cannot be read.
    """
    given = [name for name in _AREA_FIELDS if not is_empty(parameters.get(name))]
    if not given:
        return None
    box = None
    polygons: tuple[Polygon, ...] = ()
    if "EXTENT" in given:
        extent = algorithm.parameterAsExtent(parameters, "EXTENT", context, crs.value)
        box = extent.xMinimum(), extent.yMinimum(), extent.xMaximum(), extent.yMaximum()
    if "BOUNDARY" in given:
        source = algorithm.parameterAsSource(parameters, "BOUNDARY", context)
        features = features_of(source, _AREA_FIELDS["BOUNDARY"][0], crs.value, context)
        polygons = tuple(each for one in features for each in polygons_of(one.geometry()))
        if not polygons:
            raise BareEarthError(tr("The boundary holds no polygon. Choose one that does."))
    return Area(box, polygons)


def check_area_only(parameters: dict[str, Any], chosen: Sequence[ParameterSet]) -> None:
    """Refuse to write only the points in the area if there is no area."""
    is_given = not all(is_empty(parameters.get(name)) for name in _AREA_FIELDS)
    for each in chosen:
        if isinstance(each, Output):
            each.check_area(is_given)


def area_options(area: Area | None, progress: Progress) -> list[str]:
    """Return the options of the command line for an area; tell the user how to add a boundary."""
    if area is None:
        return []
    if area.polygons:
        progress.info(
            tr(
                "In the command line the boundary is missing: save it in the CRS of the points"
                " as boundary.geojson, and add --boundary boundary.geojson."
            )
        )
    return ["--extent", *map(repr, area.box)] if area.box else []


def add_limits(algorithm: QgsProcessingAlgorithm, advanced: Sequence[str] = ("BOUNDARY",)) -> None:
    """Add the fields of `add_area` and `add_known` to a dialog."""
    add_area(algorithm, advanced)
    add_known(algorithm)


def limits_of(
    algorithm: QgsProcessingAlgorithm,
    parameters: dict[str, Any],
    context: QgsProcessingContext,
    crs: CloudCrs,
    progress: Progress,
) -> dict[str, Any]:
    """Return area, corrections and constraints, by their names in `ClassifyRequest`."""
    known = known_of(algorithm, parameters, context, crs, progress)
    return {"area": area_of(algorithm, parameters, context, crs), **known}
