"""Choices: dialogs show labels, while models, scripts and the history hold the values."""

from __future__ import annotations

from typing import Any

from qgis.core import QgsProcessingContext, QgsProcessingParameterEnum

LABELS = "labels"
# By its name: QGIS makes one for a dialog, and qgis_process imports no widgets.
_WIDGET = f"{__package__}.widgets.ChoiceWidget"


class ChoiceParameter(QgsProcessingParameterEnum):
    """A choice among values; also by its number in the list of qgis_process."""

    def clone(self) -> ChoiceParameter:
        """Return a copy; dialogs and models work with copies."""
        return ChoiceParameter(self)

    def checkValueIsAcceptable(
        self, value: Any, context: QgsProcessingContext | None = None
    ) -> bool:
        """Return whether `value` is a number of the list, or what QGIS itself accepts."""
        value = value_of(value, self.options())
        return super().checkValueIsAcceptable(value, context)


def value_of(given: Any, values: list[str]) -> Any:
    """Return the value that a number of the list stands for, and all else as it is."""
    text = str(given)
    if isinstance(given, bool) or text in values or not text.isdecimal():
        return given
    return values[int(text)] if int(text) < len(values) else given


def values_of(given: Any, values: list[str]) -> list[Any]:
    """Return the values of a choice of several: a list, or a text with commas, of them."""
    several = given.split(",") if isinstance(given, str) else given
    return [value_of(each, values) for each in several]


def with_labels(field: ChoiceParameter, labels: list[str]) -> ChoiceParameter:
    """Let dialogs show labels in place of the values; the modeler's goes on showing values."""
    field.setMetadata({"widget_wrapper": {"class": _WIDGET}, LABELS: labels})
    return field
