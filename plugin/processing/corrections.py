"""Fields for a layer of polygons in which the class of the points is known."""

from __future__ import annotations

from typing import Any

from qgis.core import (
    QgsProcessingAlgorithm,
    QgsProcessingContext,
    QgsProcessingParameterFeatureSource,
    QgsProcessingParameterField,
)

from ...algorithms.core.progress import SILENT, Progress
from ...algorithms.survey.corrections import CLASS_FIELD, NO_CORRECTIONS, Corrections
from .. import compat
from ..i18n import mark
from .feedback import Refusal
from .inputs import CloudCrs, layer_shapes

_LAYER, _FIELD = "CORRECTIONS", "CORRECTIONS_FIELD"
# Label and help of each field.
_TEXTS = {
    _LAYER: (
        "Corrections",
        "Polygons in which you know the class. It replaces the result of the filter. If it is the"
        " class of the ground, points of the chosen returns are ground. Any other class is given"
        " to all points, and the filter does not use them. Where polygons overlap, the last one"
        " counts.",
    ),
    _FIELD: (
        "Class of the corrections",
        "The attribute of these polygons that holds their class: 2 for ground, 1 for unclassified.",
    ),
}


def add_corrections(algorithm: QgsProcessingAlgorithm) -> None:
    """Add the fields of the layer to a dialog, as advanced parameters."""
    labels = {name: label for name, (label, _) in _TEXTS.items()}
    fields = (
        QgsProcessingParameterFeatureSource(_LAYER, labels[_LAYER], [compat.POLYGONS], None, True),
        QgsProcessingParameterField(_FIELD, labels[_FIELD], CLASS_FIELD, _LAYER),
    )
    for field in fields:
        field.setFlags(field.flags() | compat.ADVANCED | compat.OPTIONAL)
        algorithm.addParameter(field, _TEXTS[field.name()][1])


def corrections_of(
    algorithm: QgsProcessingAlgorithm,
    parameters: dict[str, Any],
    context: QgsProcessingContext,
    crs: CloudCrs,
    progress: Progress = SILENT,
) -> Corrections:
    """Return the corrections in the CRS of the points, and tell how commands take them."""
    if compat.is_empty(parameters.get(_LAYER)):
        return NO_CORRECTIONS
    name = algorithm.parameterAsString(parameters, _FIELD, context) or CLASS_FIELD
    source = algorithm.parameterAsSource(parameters, _LAYER, context)
    if source is not None and source.fields().lookupField(name) < 0:
        text = mark("The corrections have no attribute {}. Choose the one to use.")
        raise Refusal(text, name)
    progress.info(
        "In the command line the corrections are missing: save them in the CRS of the points as"
        f' corrections.geojson, their class as the attribute "{CLASS_FIELD}", and add --corrections'
        " corrections.geojson."
    )
    field = algorithm, parameters, _LAYER, _TEXTS[_LAYER][0], context, crs
    found = layer_shapes(*field, attribute=name)
    return Corrections(*zip(*found))
