"""Widgets of fields, by the dialog that they are for; the one file that needs those of QGIS.

QGIS imports a class by the name that a parameter's metadata holds, calls it with the parameter and
the dialog, and takes what comes: for the designer of models another kind of thing than for others.
"""

from __future__ import annotations

from typing import Any

from qgis.core import (
    QgsProcessingContext,
    QgsProcessingParameterDefinition,
    QgsProcessingParameterFile,
)
from qgis.gui import (
    QgsAbstractProcessingParameterWidgetWrapper,
    QgsCheckableComboBox,
    QgsGui,
    QgsProcessingGui,
    QgsProcessingModelerParameterWidget,
)
from qgis.PyQt.QtCore import Qt
from qgis.PyQt.QtWidgets import QComboBox, QWidget

from .. import compat
from .choices import LABELS, ChoiceParameter, value_of, values_of

_STATE = Qt.ItemDataRole.CheckStateRole
# Qt.CheckState as items keep it: PyQt 5 and 6 do not make the same of its names there.
_UNCHECKED, _CHECKED = 0, 2


class ChoiceWidget:
    """That of a choice: with labels, but with values in the designer of models."""

    def __new__(cls, parameter: ChoiceParameter, dialog: QWidget, *_: Any) -> Any:
        """Return it, and nothing of this class."""
        if _is_designer(dialog):
            return _designer_widget(parameter, dialog)
        box = _ChoicesBox if parameter.allowMultiple() else _ChoiceBox
        return box(parameter, _kind(dialog), dialog)


class PointCloudWidget:
    """That of QGIS for a point cloud; in the designer of models, files can be chosen for it, too.

    QGIS itself offers there the inputs that are layers, which can be no .las and .laz files where
    it has no `pdal` provider.
    """

    def __new__(cls, parameter: QgsProcessingParameterDefinition, dialog: QWidget, *_: Any) -> Any:
        """Return it, and nothing of this class."""
        if not _is_designer(dialog):
            widget = QgsGui.processingGuiRegistry().createParameterWidgetWrapper(
                parameter, _kind(dialog)
            )
            widget.setDialog(dialog)
            return widget
        widget = _designer_widget(parameter, dialog)
        # More inputs; outputs that are files are there already.
        widget.populateSources([QgsProcessingParameterFile.typeName()], [], [])
        return widget


def _is_designer(dialog: QWidget) -> bool:
    return type(dialog).__name__ == "ModelerParametersDialog"


def _kind(dialog: QWidget) -> Any:
    is_batch = type(dialog).__name__.startswith("Batch")
    return QgsProcessingGui.WidgetType.Batch if is_batch else QgsProcessingGui.WidgetType.Standard


def _designer_widget(
    parameter: QgsProcessingParameterDefinition, dialog: QWidget
) -> QgsProcessingModelerParameterWidget:
    """Return what QGIS itself shows in the designer: a value, an input, or an output."""
    widget = QgsGui.processingGuiRegistry().createModelerParameterWidget(
        dialog.model, dialog.childId, parameter, dialog.context
    )
    widget.setDialog(dialog)
    return widget


class _ChoiceBox(QgsAbstractProcessingParameterWidgetWrapper):
    """A box with the labels that the parameter's metadata holds."""

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


class _ChoicesBox(QgsAbstractProcessingParameterWidgetWrapper):
    """A box with the labels that the parameter's metadata holds, of which several are chosen."""

    def createWidget(self) -> QWidget:
        """Return the box, with the defaults chosen."""
        parameter = self.parameterDefinition()
        box = QgsCheckableComboBox()
        # Labels have commas.
        box.setSeparator("; ")
        for label, value in zip(parameter.metadata()[LABELS], parameter.options()):
            box.addItemWithCheckState(label, Qt.CheckState.Unchecked, value)
        _check(box, parameter.defaultValue())
        box.checkedItemsChanged.connect(lambda _: self.widgetValueHasChanged.emit(self))
        return box

    def setWidgetValue(self, value: Any, context: QgsProcessingContext) -> None:
        """Choose values; called with those of a run before, too."""
        box = self.wrappedWidget()
        if box is not None and not compat.is_null(value):
            _check(box, values_of(value, self.parameterDefinition().options()))

    def widgetValue(self) -> Any:
        """Return the values that are chosen, in the order of the list."""
        box = self.wrappedWidget()
        states = [Qt.CheckState(box.itemData(place, _STATE)) for place in range(box.count())]
        chosen = [place for place, state in enumerate(states) if state == Qt.CheckState.Checked]
        return [box.itemData(place) for place in chosen]


def _check(box: QComboBox, values: list[str]) -> None:
    """Choose the items of these values, and no others."""
    # What QGIS gives back of the box is known as a QComboBox only, which has no word for it.
    for place in range(box.count()):
        is_chosen = box.itemData(place) in values
        box.setItemData(place, _CHECKED if is_chosen else _UNCHECKED, _STATE)
