"""The box of a choice in a dialog; the one file that needs the widgets of QGIS."""

from __future__ import annotations

from typing import Any

from qgis.core import QgsProcessingContext
from qgis.gui import QgsAbstractProcessingParameterWidgetWrapper, QgsProcessingGui
from qgis.PyQt.QtWidgets import QComboBox, QWidget

from .. import compat
from .choices import LABELS, ChoiceParameter, value_of


class ChoiceWidget(QgsAbstractProcessingParameterWidgetWrapper):
    """The box of a choice.

    Parameters
    ----------
    parameter : ChoiceParameter
        Its values; its metadata holds their labels.
    dialog : QWidget
        That of an algorithm, or of its batch mode.
    """

    def __init__(self, parameter: ChoiceParameter, dialog: QWidget, *_: Any) -> None:
        is_batch = type(dialog).__name__.startswith("Batch")
        kinds = QgsProcessingGui.WidgetType
        super().__init__(parameter, kinds.Batch if is_batch else kinds.Standard, dialog)

    def createWidget(self) -> QWidget:
        """Return the box, with the default chosen."""
        parameter = self.parameterDefinition()
        box = QComboBox()
        for label, value in zip(parameter.metadata()[LABELS], parameter.options()):
            box.addItem(label, value)
        box.setCurrentIndex(box.findData(parameter.defaultValue()))
        box.currentIndexChanged.connect(lambda _: self.widgetValueHasChanged.emit(self))
        return box

    def setWidgetValue(self, value: Any, context: QgsProcessingContext) -> None:
        """Choose a value; called with those of a run before, too."""
        # Asked for each time: QGIS owns it now, and a reference from before is of no use.
        box = self.wrappedWidget()
        if box is not None and not compat.is_null(value):
            value = value_of(value, self.parameterDefinition().options())
            box.setCurrentIndex(box.findData(value))

    def widgetValue(self) -> Any:
        """Return the value that is chosen."""
        return self.wrappedWidget().currentData()
