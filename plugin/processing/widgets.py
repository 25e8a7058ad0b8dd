"""Widgets of fields. Only this file and those called after a widget import qgis.gui.

QGIS imports the class named in the metadata of a parameter, calls it with parameter and dialog, and
uses the result. The model designer needs another type of widget than other dialogs.
"""

from __future__ import annotations

from typing import Any, Callable, Iterable, Sequence, TypeVar

from qgis.core import (
    QgsProcessingContext,
    QgsProcessingParameterDefinition,
    QgsProcessingParameters,
)
from qgis.gui import (
    QgsAbstractProcessingParameterWidgetWrapper,
    QgsCheckableComboBox,
    QgsGui,
    QgsProcessingGui,
)
from qgis.PyQt.QtCore import Qt
from qgis.PyQt.QtWidgets import QCheckBox, QComboBox, QLabel, QLineEdit, QWidget

from ...algorithms.delivery.parameters import NO_DELIVERY
from .. import compat
from ..i18n import tr
from .choices import LABELS, NO_CHOICE, ChoiceParameter, value_of, values_of
from .compositions import DELIVERY, FOLDER

_STATE = Qt.ItemDataRole.CheckStateRole
# Letters: least width of a box with choices.
_LEAST_LETTERS = 16
# Values of Qt.CheckState in items. The names do not work in the same way in PyQt 5 and 6.
_UNCHECKED = 0
_CHECKED = 2

Widget = TypeVar("Widget", bound=QWidget)


def widget_class(
    box: Callable[..., Any], is_for_batch: bool = False, sources: Sequence[Any] = ()
) -> type:
    """Return a class whose call makes a box of ours in a dialog for one run, or also in batch mode,
    and in others the widget of QGIS, which offers inputs of more kinds in the model designer.
    """

    def make(
        _: type, parameter: QgsProcessingParameterDefinition, dialog: QWidget, *place: object
    ) -> Any:
        registry, name = QgsGui.processingGuiRegistry(), type(dialog).__name__
        if name == "ModelerParametersDialog":
            step = dialog.model, dialog.childId, parameter, dialog.context
            widget = registry.createModelerParameterWidget(*step)
            widget.setDialog(dialog)
            if sources:
                widget.populateSources([source.typeName() for source in sources], [], [])
            return widget
        is_batch, kinds = name.startswith("Batch"), QgsProcessingGui.WidgetType
        if is_batch and not is_for_batch:
            widget = registry.createParameterWidgetWrapper(parameter, kinds.Batch)
            widget.setDialog(dialog)
            return widget
        return box(parameter, kinds.Batch if is_batch else kinds.Standard, dialog)

    return type("WidgetMaker", (), {"__new__": make})


def keep(widget: Widget) -> Widget:
    """Keep the Python half of a new widget for as long as Qt has the widget."""
    # QGIS gives the widget that `createWidget` returned a second Python half, and Python frees the
    # first one. Qt still points to it: to delete the widget would write into freed memory.
    widget.destroyed.connect(lambda _, widget=widget: None)
    return widget


class _CheckBox(QgsAbstractProcessingParameterWidgetWrapper):
    """A box to check, with the label of the parameter."""

    def createLabel(self) -> QLabel | None:
        """Return no label: the box shows it."""
        return None

    def createWidget(self) -> QWidget:
        parameter = self.parameterDefinition()
        box = keep(QCheckBox(parameter.description()))
        box.setToolTip(parameter.toolTip())
        box.setChecked(bool(parameter.defaultValue()))
        box.toggled.connect(lambda _: self.widgetValueHasChanged.emit(self))
        return box

    def setWidgetValue(self, value: object, context: QgsProcessingContext) -> None:
        """Check the box or not, also as in an earlier run."""
        box, parameter = self.wrappedWidget(), self.parameterDefinition()
        if box is not None and not compat.is_null(value):
            box.setChecked(QgsProcessingParameters.parameterAsBool(parameter, value, context))

    def widgetValue(self) -> bool:
        return self.wrappedWidget().isChecked()


class _LabelledBox(QgsAbstractProcessingParameterWidgetWrapper):
    """A box with choices, and its label; the dialog keeps it, and what is in the same row."""

    def createLabel(self) -> QLabel:
        """Return a label without "[optional]", since a box with choices has always a value."""
        label = keep(QLabel(self.parameterDefinition().description()))
        label.setToolTip(self.parameterDefinition().toolTip())
        return label

    def postInitialize(self, wrappers: list[QgsAbstractProcessingParameterWidgetWrapper]) -> None:
        """Let the dialog keep all wrappers of a row as long as it is open."""
        # A table of batch mode that loads a file drops the wrappers of its first row, whose widgets
        # are deleted later. PyQt then takes new wrappers, which are where the old ones were, for
        # deleted: "wrapped C/C++ object has been deleted".
        super().postInitialize(wrappers)
        if self.parent() is not None:
            vars(self.parent()).setdefault("bare_earth_rows", []).append(wrappers)


class _ChoiceBox(_LabelledBox):
    """A box with the labels in the metadata of the parameter."""

    def createWidget(self) -> QWidget:
        parameter = self.parameterDefinition()
        box = _narrow(keep(QComboBox()))
        if label := parameter.metadata().get(NO_CHOICE):
            box.addItem(label, None)
        for label, value in zip(parameter.metadata()[LABELS], parameter.options()):
            box.addItem(label, value)
        box.setCurrentIndex(max(box.findData(parameter.defaultValue()), 0))
        box.currentIndexChanged.connect(lambda _: self.widgetValueHasChanged.emit(self))
        return box

    def setWidgetValue(self, value: object, context: QgsProcessingContext) -> None:
        """Choose a value, also one of an earlier run."""
        # Fetched each time: QGIS owns the box, so a stored reference would become invalid.
        box = self.wrappedWidget()
        if box is not None and not compat.is_null(value):
            value = value_of(value, self.parameterDefinition().options())
            box.setCurrentIndex(box.findData(value))

    def widgetValue(self) -> str:
        return self.wrappedWidget().currentData()


class _DeliveryBox(_ChoiceBox):
    """The box for a delivery, with which the dialog shows its folder, and no single outputs."""

    # QGIS puts the folder among the outputs, which are at the end of a long dialog.

    def postInitialize(self, wrappers: list[QgsAbstractProcessingParameterWidgetWrapper]) -> None:
        """Move the folder below the box."""
        super().postInitialize(wrappers)
        outputs = {
            wrapper.parameterDefinition().name(): wrapper
            for wrapper in wrappers
            if wrapper.parameterDefinition().isDestination()
        }
        self._folder, self._outputs = outputs.pop(FOLDER), outputs
        label, widget = self._folder.wrappedLabel(), self._folder.wrappedWidget()
        label.setText(self._folder.parameterDefinition().description())  # not "[optional]"
        layout = self.wrappedWidget().parentWidget().layout()
        for part in (widget, label):
            layout.insertWidget(layout.indexOf(self.wrappedWidget()) + 1, part)
        self.widgetValueHasChanged.connect(self._show_fields)
        self._show_fields()

    def _show_fields(self, *_: object) -> None:
        is_delivery = self.widgetValue() != NO_DELIVERY
        shown = {
            self._folder: is_delivery,
            **dict.fromkeys(self._outputs.values(), not is_delivery),
        }
        for wrapper, is_shown in shown.items():
            wrapper.wrappedLabel().setVisible(is_shown)
            wrapper.wrappedWidget().setVisible(is_shown)
        for line in self._folder.wrappedWidget().findChildren(QLineEdit):
            line.setPlaceholderText(tr("Choose a folder"))  # not "[Skip output]"


class _ChoicesBox(_LabelledBox):
    """A box with the labels in the metadata of the parameter, for several choices."""

    def createWidget(self) -> QWidget:
        parameter = self.parameterDefinition()
        box = _narrow(keep(QgsCheckableComboBox()))
        # Not a comma, which labels contain.
        box.setSeparator("; ")
        for label, value in zip(parameter.metadata()[LABELS], parameter.options()):
            box.addItemWithCheckState(label, Qt.CheckState.Unchecked, value)
        _check(box, parameter.defaultValue())
        box.checkedItemsChanged.connect(lambda _: self.widgetValueHasChanged.emit(self))
        return box

    def setWidgetValue(self, value: str | Iterable[object], context: QgsProcessingContext) -> None:
        """Choose values, also those of an earlier run."""
        box = self.wrappedWidget()
        if box is not None and not compat.is_null(value):
            _check(box, values_of(value, self.parameterDefinition().options()))

    def widgetValue(self) -> list[str]:
        """Return the chosen values, in the order of the list."""
        box = self.wrappedWidget()
        states = [Qt.CheckState(box.itemData(place, _STATE)) for place in range(box.count())]
        chosen = [place for place, state in enumerate(states) if state == Qt.CheckState.Checked]
        return [box.itemData(place) for place in chosen]


def _narrow(box: QComboBox) -> QComboBox:
    """Let a box be narrower than its longest label, so that no button beside it leaves a dialog."""
    box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
    box.setMinimumContentsLength(_LEAST_LETTERS)
    return box


def _check(box: QComboBox, values: Iterable[object]) -> None:
    """Choose only the items with these values."""
    # QGIS returns the box as a QComboBox, which has no method for this.
    for place in range(box.count()):
        is_chosen = box.itemData(place) in values
        box.setItemData(place, _CHECKED if is_chosen else _UNCHECKED, _STATE)


def _choice_box(
    parameter: ChoiceParameter, kind: QgsProcessingGui.WidgetType, dialog: QWidget
) -> QgsAbstractProcessingParameterWidgetWrapper:
    box = _ChoicesBox if parameter.allowMultiple() else _ChoiceBox
    if parameter.name() == DELIVERY and kind == QgsProcessingGui.WidgetType.Standard:
        box = _DeliveryBox
    return box(parameter, kind, dialog)


# A choice shows labels, but values in the model designer.
ChoiceWidget = widget_class(_choice_box, is_for_batch=True)
# A boolean has always a value, so it is not "[optional]".
CheckWidget = widget_class(_CheckBox)
