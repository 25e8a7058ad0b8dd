"""The widget of the fields for attributes of layers, and for columns of a text table."""

from __future__ import annotations

from typing import Any

from qgis.core import QgsProcessingContext, QgsProcessingParameterDefinition
from qgis.gui import QgsAbstractProcessingParameterWidgetWrapper
from qgis.PyQt.QtWidgets import QComboBox, QWidget

from .. import compat
from .checkpoints import names_in
from .widgets import designer_widget, is_designer, keep, kind


class AttributeWidget:
    """Makes the widget of an attribute, with the names that are in the table or layer."""

    # That of QGIS takes a text table for a layer, and tells that it could not be loaded. Where it
    # is blank, QGIS 3.40 cannot save a batch.

    def __new__(
        cls, parameter: QgsProcessingParameterDefinition, dialog: QWidget, *_: object
    ) -> Any:
        """Return a widget, not an instance of this class."""
        if is_designer(dialog):
            return designer_widget(parameter, dialog)
        return _AttributeBox(parameter, kind(dialog), dialog)


class _AttributeBox(QgsAbstractProcessingParameterWidgetWrapper):
    """A box with names to choose from, in which another one, or a number, can be typed."""

    def createWidget(self) -> QWidget:
        """Return the box, which is empty."""
        box = keep(QComboBox())
        box.setEditable(True)
        box.setInsertPolicy(QComboBox.InsertPolicy.NoInsert)
        box.editTextChanged.connect(lambda _: self.widgetValueHasChanged.emit(self))
        return box

    def setWidgetValue(self, value: object, context: QgsProcessingContext) -> None:
        """Show a name."""
        self.wrappedWidget().setEditText("" if compat.is_null(value) else str(value))

    def widgetValue(self) -> str | None:
        """Return the name; None for none."""
        return self.wrappedWidget().currentText().strip() or None

    def postInitialize(self, wrappers: list[QgsAbstractProcessingParameterWidgetWrapper]) -> None:
        """Show the names of what is chosen in the field of the layer."""
        super().postInitialize(wrappers)
        parent = self.parameterDefinition().parentLayerParameterName()
        for wrapper in wrappers:
            if wrapper.parameterDefinition().name() == parent:
                wrapper.widgetValueHasChanged.connect(self._fill)
                self._fill(wrapper)

    def _fill(self, parent: QgsAbstractProcessingParameterWidgetWrapper) -> None:
        box = self.wrappedWidget()
        text = box.currentText()
        box.clear()
        box.addItems(["", *names_in(parent.parameterValue(), QgsProcessingContext())])
        box.setEditText(text)
