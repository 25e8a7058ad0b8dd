"""Choices: dialogs show labels; models, scripts and the history store values."""

from __future__ import annotations

from typing import Iterable

from qgis.core import QgsProcessingContext, QgsProcessingParameterEnum

LABELS = "labels"
# The label of no choice, where a value need not be chosen.
NO_CHOICE = "no choice"
# The values of a boolean that need not be chosen; models and scripts give true and false for them.
OFF, ON = "off", "on"
_SWITCH = {"false": OFF, "true": ON}
# As a name, so that the widget is imported only in dialogs, not in qgis_process.
_WIDGET = f"{__package__}.widgets.ChoiceWidget"


class ChoiceParameter(QgsProcessingParameterEnum):
    """A choice among values; the numbers in the list of qgis_process are accepted, too."""

    def clone(self) -> ChoiceParameter:
        return ChoiceParameter(self)

    def checkValueIsAcceptable(
        self, value: object, context: QgsProcessingContext | None = None
    ) -> bool:
        """Return whether `value` is a number of the list, or QGIS accepts it."""
        value = value_of(value, self.options())
        return super().checkValueIsAcceptable(value, context)


def value_of(given: object, values: list[str]) -> object:
    """Return the value for a number of the list; anything else unchanged."""
    text = str(given)
    if values == [OFF, ON]:
        text = _SWITCH.get(text.lower(), text)
        given = text if isinstance(given, (bool, str)) else given
    if isinstance(given, bool) or text in values or not text.isdecimal():
        return given
    return values[int(text)] if int(text) < len(values) else given


def values_of(given: str | Iterable[object], values: list[str]) -> list[object]:
    """Return the values of a multiple choice, given as a list or as text with commas."""
    several = given.split(",") if isinstance(given, str) else given
    return [value_of(name, values) for name in several]


def with_labels(field: ChoiceParameter, labels: list[str], no_choice: str = "") -> ChoiceParameter:
    """Let dialogs show labels instead of values; the model designer shows values."""
    shown = {LABELS: labels, NO_CHOICE: no_choice}
    field.setMetadata({"widget_wrapper": {"class": _WIDGET}, **shown})
    return field
