"""A layer of polygons in which the class of the points is known."""

from __future__ import annotations

from typing import Any

from qgis.core import QgsProcessingAlgorithm, QgsProcessingContext

from ...algorithms.core.progress import SILENT, Progress
from ...algorithms.survey.corrections import CLASS_FIELD, NO_CORRECTIONS, Corrections
from .. import compat
from ..i18n import mark
from .feedback import Refusal
from .inputs import CloudCrs, layer_shapes

_LAYER, _FIELD = "CORRECTIONS", "CORRECTIONS_FIELD"


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
    field = algorithm, parameters, _LAYER, "Corrections", context, crs
    found = layer_shapes(*field, attribute=name)
    return Corrections(*zip(*found))
