"""The field for the CRS of the points, for files that state none or a wrong one."""

from __future__ import annotations

from typing import Any

from qgis.core import (
    QgsCoordinateReferenceSystem,
    QgsProcessingAlgorithm,
    QgsProcessingContext,
    QgsProcessingParameterCrs,
)

from .. import compat
from ..i18n import mark
from .feedback import Refusal

_NAME = "CRS"
_HELP = (
    "The CRS of the points, for files that state none or a wrong one. It replaces what files state:"
    " it decides the units of lengths and heights, and rasters and layers get it. Written point"
    " clouds keep the records that the files have. Empty: what the files state."
)


def add_crs(algorithm: QgsProcessingAlgorithm) -> None:
    """Add the field to a dialog, as an advanced parameter."""
    field = QgsProcessingParameterCrs(_NAME, "CRS of the points", None, True)
    field.setFlags(field.flags() | compat.ADVANCED)
    algorithm.addParameter(field, _HELP)


def stated_crs_of(
    algorithm: QgsProcessingAlgorithm, parameters: dict[str, Any], context: QgsProcessingContext
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
