"""The CRS of the points that a user states in a dialog."""

from __future__ import annotations

from qgis.core import (
    QgsCoordinateReferenceSystem,
    QgsProcessingAlgorithm,
    QgsProcessingContext,
)

from .. import compat
from ..i18n import mark
from .feedback import Refusal

_NAME = "CRS"


def stated_crs_of(
    algorithm: QgsProcessingAlgorithm, parameters: dict[str, object], context: QgsProcessingContext
) -> str | None:
    """Return the known CRS in the field, as the requests take it; None if it is empty."""
    if algorithm.parameterDefinition(_NAME) is None or compat.is_empty(parameters.get(_NAME)):
        return None
    crs = algorithm.parameterAsCrs(parameters, _NAME, context)
    if not crs.isValid():
        raise Refusal(mark("{} is no known CRS. Choose one from the list."), parameters[_NAME])
    return text_of(crs)


def text_of(crs: QgsCoordinateReferenceSystem) -> str:
    """Return a known CRS as code, or else as well-known text."""
    return crs.authid() if crs.authid().startswith("EPSG:") else crs.toWkt(compat.WKT)


def crs_of_text(text: str) -> QgsCoordinateReferenceSystem:
    """Return the CRS that `stated_crs_of` returned."""
    return QgsCoordinateReferenceSystem(text)
