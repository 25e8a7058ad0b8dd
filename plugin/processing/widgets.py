"""Widgets of fields. Only this file imports qgis.gui for algorithms.

QGIS imports the class named in the metadata of a parameter, calls it with parameter and dialog, and
uses the result. The model designer needs another type of widget than other dialogs.
"""

from __future__ import annotations

from typing import Any, Iterable

from qgis.core import (
    QgsPointCloudLayer,
    QgsProcessingContext,
    QgsProcessingParameterDefinition,
    QgsProcessingParameterFile,
    QgsProcessingParameters,
    QgsProcessingParameterString,
    QgsProject,
)
from qgis.gui import (
    QgsAbstractProcessingParameterWidgetWrapper,
    QgsCheckableComboBox,
    QgsGui,
    QgsMapLayerComboBox,
    QgsProcessingGui,
    QgsProcessingMapLayerComboBox,
    QgsProcessingModelerParameterWidget,
    QgsProcessingParameterWidgetContext,
)
from qgis.PyQt import sip
from qgis.PyQt.QtCore import Qt
from qgis.PyQt.QtWidgets import QCheckBox, QComboBox, QLabel, QLineEdit, QWidget

from ...algorithms.delivery.parameters import NO_DELIVERY
from ...algorithms.remote.addresses import is_address
from .. import compat
from ..i18n import tr
from ..styles.loaded import file_of
from .choices import LABELS, NO_CHOICE, ChoiceParameter, value_of, values_of
from .compositions import DELIVERY, FOLDER
from .remote import ADDRESS, PART, REMOTE, extent_of_map

_STATE = Qt.ItemDataRole.CheckStateRole
# Letters: least width of a box with choices.
_LEAST_LETTERS = 16
# Values of Qt.CheckState in items. The names do not work in the same way in PyQt 5 and 6.
_UNCHECKED = 0
_CHECKED = 2


class ChoiceWidget:
    """Makes the widget of a choice: with labels, but with values in the model designer."""

    def __new__(cls, parameter: ChoiceParameter, dialog: QWidget, *_: object) -> Any:
        """Return a widget, not an instance of this class."""
        if _is_designer(dialog):
            return _designer_widget(parameter, dialog)
        box = _ChoicesBox if parameter.allowMultiple() else _ChoiceBox
        if parameter.name() == DELIVERY and _kind(dialog) == QgsProcessingGui.WidgetType.Standard:
            box = _DeliveryBox
        return box(parameter, _kind(dialog), dialog)


class CheckWidget:
    """Makes the widget of a boolean: a box that has always a value, so it is not "[optional]"."""

    def __new__(
        cls, parameter: QgsProcessingParameterDefinition, dialog: QWidget, *_: object
    ) -> Any:
        """Return a widget, not an instance of this class."""
        if _is_designer(dialog):
            return _designer_widget(parameter, dialog)
        if _kind(dialog) == QgsProcessingGui.WidgetType.Standard:
            return _CheckBox(parameter, _kind(dialog), dialog)
        return _usual_widget(parameter, dialog)


class PointCloudWidget:
    """Makes the widget of a point cloud, which accepts files and texts in the model designer."""

    # QGIS itself only offers inputs that are layers there. Without its `pdal` provider, these
    # cannot be .las and .laz files; texts are addresses. In a dialog for one run, a cloud of the
    # project is chosen at first.

    def __new__(
        cls, parameter: QgsProcessingParameterDefinition, dialog: QWidget, *_: object
    ) -> Any:
        """Return a widget, not an instance of this class."""
        if _kind(dialog) == QgsProcessingGui.WidgetType.Standard and not _is_designer(dialog):
            return _CloudBox(parameter, _kind(dialog), dialog)
        if not _is_designer(dialog):
            return _usual_widget(parameter, dialog)
        widget = _designer_widget(parameter, dialog)
        # Adds inputs that are files or texts; outputs that are files are already in the list.
        kinds = QgsProcessingParameterFile, QgsProcessingParameterString
        widget.populateSources([kind.typeName() for kind in kinds], [], [])
        return widget


def _is_designer(dialog: QWidget) -> bool:
    return type(dialog).__name__ == "ModelerParametersDialog"


def _kind(dialog: QWidget) -> QgsProcessingGui.WidgetType:
    is_batch = type(dialog).__name__.startswith("Batch")
    return QgsProcessingGui.WidgetType.Batch if is_batch else QgsProcessingGui.WidgetType.Standard


def _usual_widget(
    parameter: QgsProcessingParameterDefinition, dialog: QWidget
) -> QgsAbstractProcessingParameterWidgetWrapper:
    """Return the widget of QGIS in a dialog or in batch mode."""
    registry = QgsGui.processingGuiRegistry()
    widget = registry.createParameterWidgetWrapper(parameter, _kind(dialog))
    widget.setDialog(dialog)
    return widget


def _label_of(parameter: QgsProcessingParameterDefinition) -> QLabel:
    """Return a label without "[optional]", since a box with choices has always a value."""
    label = QLabel(parameter.description())
    label.setToolTip(parameter.toolTip())
    return label


def _designer_widget(
    parameter: QgsProcessingParameterDefinition, dialog: QWidget
) -> QgsProcessingModelerParameterWidget:
    """Return the widget of QGIS in the designer, for a value, an input or an output."""
    widget = QgsGui.processingGuiRegistry().createModelerParameterWidget(
        dialog.model, dialog.childId, parameter, dialog.context
    )
    widget.setDialog(dialog)
    return widget


class _CheckBox(QgsAbstractProcessingParameterWidgetWrapper):
    """A box to check, with the label of the parameter."""

    def createLabel(self) -> QLabel | None:
        """Return no label: the box shows it."""
        return None

    def createWidget(self) -> QWidget:
        """Return the box, checked if the default is true."""
        parameter = self.parameterDefinition()
        box = QCheckBox(parameter.description())
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
        """Return whether the box is checked."""
        return self.wrappedWidget().isChecked()


class _LabelledBox(QgsAbstractProcessingParameterWidgetWrapper):
    """A box with choices, and its label; the dialog keeps it, and what is in the same row."""

    def createLabel(self) -> QLabel:
        """Return the label."""
        return _label_of(self.parameterDefinition())

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
        """Return the box, with the default chosen."""
        parameter = self.parameterDefinition()
        box = _narrow(QComboBox())
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
        """Return the chosen value."""
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
        """Return the box, with the defaults chosen."""
        parameter = self.parameterDefinition()
        box = _narrow(QgsCheckableComboBox())
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


class _CloudBox(QgsAbstractProcessingParameterWidgetWrapper):
    """The box of QGIS for a layer or file, in which an address can be typed; first of all it shows
    a point cloud of the project.
    """

    # For a remote one, the extent of the map is shown in the field for the extent.

    def createWidget(self) -> QWidget:
        """Return the box, which offers point clouds only."""
        box = QgsProcessingMapLayerComboBox(self.parameterDefinition(), self.type())
        box.setWidgetContext(self.widgetContext())
        self._suggested: str | None = None
        self._extent: QgsAbstractProcessingParameterWidgetWrapper | None = None
        self._shown: object = None  # the suggested extent
        names = _names_in(box)
        # In QGIS 3.22 it would offer all layers, and choose one of them.
        sip.cast(names, QgsMapLayerComboBox).setFilters(compat.POINT_CLOUDS)
        names.setEditable(True)
        _show_choice(names)
        names.setInsertPolicy(QComboBox.InsertPolicy.NoInsert)
        names.setCompleter(None)
        names.lineEdit().setPlaceholderText(tr("A layer, a file, or an address (https://…)"))
        box.valueChanged.connect(lambda: self.widgetValueHasChanged.emit(self))
        names.editTextChanged.connect(lambda _: self.widgetValueHasChanged.emit(self))
        return box

    @property
    def _box(self) -> QgsProcessingMapLayerComboBox:
        # Fetched each time, as in `_ChoiceBox`; QGIS returns it as a QWidget, which has no value.
        return sip.cast(self.wrappedWidget(), QgsProcessingMapLayerComboBox)

    def setWidgetContext(self, context: QgsProcessingParameterWidgetContext) -> None:
        """Store project and window."""
        super().setWidgetContext(context)
        if self.wrappedWidget() is not None:
            self._box.setWidgetContext(context)

    def setWidgetValue(self, value: object, context: QgsProcessingContext) -> None:
        """Choose a value, but for the first one, the default of the dialog, which is empty."""
        if self.wrappedWidget() is None:
            return
        if self._suggested is None and compat.is_null(value):
            project = self.widgetContext().project()
            value = self._suggested = _suggestion(self.parameterDefinition().name(), project)
        self._suggested = self._suggested or ""
        self._box.setValue(value or None, context)
        _show_choice(_names_in(self._box))

    def widgetValue(self) -> object:
        """Return the layer or file, or what is typed."""
        value = self._box.value()
        return value.strip() if isinstance(value, str) else value

    def postInitialize(self, wrappers: list[QgsAbstractProcessingParameterWidgetWrapper]) -> None:
        """Take the suggestion back if the user chooses a folder, which would be used beside it, and
        let the extent follow the point cloud.
        """
        super().postInitialize(wrappers)
        for wrapper in wrappers:
            if wrapper.parameterDefinition().name() == "INPUT_FOLDER":
                wrapper.widgetValueHasChanged.connect(self._take_back)
            if wrapper.parameterDefinition().name() == PART:
                self._extent = wrapper
        self.widgetValueHasChanged.connect(self._suggest_extent)
        self._suggest_extent()

    def _suggest_extent(self, *_: object) -> None:
        """Show the extent of the map for remote points, unless the user gave one."""
        if self._extent is None:
            return
        shown, context = self._extent.parameterValue(), QgsProcessingContext()
        if not self._is_remote():
            if shown and shown == self._shown:
                self._extent.setParameterValue(None, context)
        elif not shown and (extent := extent_of_map()):
            self._extent.setParameterValue(extent, context)
            self._shown = self._extent.parameterValue()

    def _is_remote(self) -> bool:
        value = self.widgetValue()
        if isinstance(value, str) and is_address(value):
            return True
        project = self.widgetContext().project() or QgsProject.instance()
        layer = project.mapLayer(str(value or ""))
        return isinstance(layer, QgsPointCloudLayer) and file_of(layer) is None

    def _take_back(self, folder: QgsAbstractProcessingParameterWidgetWrapper) -> None:
        is_suggestion = bool(self._suggested) and self._box.value() == self._suggested
        if is_suggestion and folder.parameterValue():
            self._box.setLayer(None)


def _names_in(box: QgsProcessingMapLayerComboBox) -> QComboBox:
    """Return the list of layers and files in a box of QGIS."""
    return box.findChildren(QComboBox)[0]  # of this class, since PyQt does not know its own


def _suggestion(name: str, project: QgsProject | None) -> str:
    """Return the id of the layer that a new dialog shows in a field, given its name; or empty."""
    layers = _clouds(project)
    if name == ADDRESS:  # of what is to be downloaded
        layers = [layer for layer in layers if file_of(layer) is None]
    is_beside_files = name == REMOTE
    return layers[0].id() if layers and not is_beside_files else ""


def _clouds(project: QgsProject | None) -> list[QgsPointCloudLayer]:
    """Return the point clouds of the project, the active layer first, and then from the top."""
    from qgis.utils import iface

    project = project or QgsProject.instance()
    active = [iface.activeLayer()] if iface is not None else []
    layers = dict.fromkeys([*active, *project.layerTreeRoot().layerOrder()])
    return [layer for layer in layers if isinstance(layer, QgsPointCloudLayer)]


def _show_choice(names: QComboBox) -> None:
    """Show a chosen layer without its CRS, as QGIS wants it in a box in which one can type."""
    names.setEditText(names.itemText(names.currentIndex()))


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
