"""Widgets of fields for point clouds and rasters, which can begin with what the last run made, and
for attributes of layers and columns of text tables.
"""

from __future__ import annotations

from pathlib import Path

from qgis.core import (
    QgsPointCloudLayer,
    QgsProcessingContext,
    QgsProcessingParameterFile,
    QgsProcessingParameterString,
    QgsProject,
)
from qgis.gui import (
    QgsAbstractProcessingParameterWidgetWrapper,
    QgsMapLayerComboBox,
    QgsProcessingMapLayerComboBox,
    QgsProcessingParameterWidgetContext,
)
from qgis.PyQt import sip
from qgis.PyQt.QtWidgets import QComboBox, QWidget

from ...algorithms.remote.addresses import is_address
from .. import compat
from ..i18n import tr
from ..styles.loaded import file_of, sources_of
from .checkpoints import names_in
from .remote import ADDRESS, PART, REMOTE, extent_of_map
from .runs import MADE_AS, made_last
from .widgets import keep, widget_class


class _LayerBox(QgsAbstractProcessingParameterWidgetWrapper):
    """The box of QGIS for a layer or file, which first of all shows what is suggested."""

    def createWidget(self) -> QWidget:
        box = keep(QgsProcessingMapLayerComboBox(self.parameterDefinition(), self.type()))
        box.setWidgetContext(self.widgetContext())
        self._suggested: str | None = None
        box.valueChanged.connect(lambda: self.widgetValueHasChanged.emit(self))
        return box

    @property
    def _box(self) -> QgsProcessingMapLayerComboBox:
        # Fetched each time: QGIS owns it, and returns it as a QWidget, which has no value.
        return sip.cast(self.wrappedWidget(), QgsProcessingMapLayerComboBox)

    def setWidgetContext(self, context: QgsProcessingParameterWidgetContext) -> None:
        super().setWidgetContext(context)
        if self.wrappedWidget() is not None:
            self._box.setWidgetContext(context)

    def setWidgetValue(self, value: object, context: QgsProcessingContext) -> None:
        """Choose a value; in place of the first one, if it is empty, what is suggested."""
        if self.wrappedWidget() is None:
            return
        is_first, is_null = self._suggested is None, compat.is_null(value)
        if is_first and is_null:
            value = self._suggested = self._suggestion()
        self._suggested = self._suggested or ""
        if is_null and not is_first and self.parameterDefinition().flags() & compat.OPTIONAL:
            _names_in(self._box).setCurrentIndex(0)  # `setValue` would leave a file
        else:
            self._box.setValue(value or None, context)

    def widgetValue(self) -> object:
        return self._box.value()

    def _suggestion(self) -> str:
        """Return the layer or file that the last run made for the field, or an empty text."""
        project = self.widgetContext().project() or QgsProject.instance()
        path = made_last(self.parameterDefinition().metadata()[MADE_AS], project)
        layers = sources_of(project, [Path(path)] if path else [])
        return layers[0].layer if layers else path


class _CloudBox(_LayerBox):
    """The box of QGIS for a layer or file, in which an address can be typed; first of all it shows
    a point cloud of the project.
    """

    # For a remote one, the extent of the map is shown in the field for the extent.

    def createWidget(self) -> QWidget:
        box = super().createWidget()
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
        names.editTextChanged.connect(lambda _: self.widgetValueHasChanged.emit(self))
        return box

    def setWidgetValue(self, value: object, context: QgsProcessingContext) -> None:
        """Choose a value, and show a layer without its CRS."""
        super().setWidgetValue(value, context)
        if self.wrappedWidget() is not None:
            _show_choice(_names_in(self._box))

    def widgetValue(self) -> object:
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

    def _suggestion(self) -> str:
        """Return the id of a layer or a file, or an empty text."""
        parameter = self.parameterDefinition()
        if MADE_AS in parameter.metadata():
            return super()._suggestion()
        layers = _clouds(self.widgetContext().project())
        if parameter.name() == ADDRESS:  # of what is to be downloaded
            layers = [layer for layer in layers if file_of(layer) is None]
        is_beside_files = parameter.name() == REMOTE
        return layers[0].id() if layers and not is_beside_files else ""

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


class _AttributeBox(QgsAbstractProcessingParameterWidgetWrapper):
    """A box with names to choose from, in which another one, or a number, can be typed."""

    def createWidget(self) -> QWidget:
        box = keep(QComboBox())
        box.setEditable(True)
        box.setInsertPolicy(QComboBox.InsertPolicy.NoInsert)
        box.editTextChanged.connect(lambda _: self.widgetValueHasChanged.emit(self))
        return box

    def setWidgetValue(self, value: object, context: QgsProcessingContext) -> None:
        self.wrappedWidget().setEditText("" if compat.is_null(value) else str(value))

    def widgetValue(self) -> str | None:
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


def _names_in(box: QgsProcessingMapLayerComboBox) -> QComboBox:
    """Return the list of layers and files in a box of QGIS."""
    return box.findChildren(QComboBox)[0]  # of this class, since PyQt does not know its own


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


# In the model designer, QGIS itself only offers inputs that are layers. Without its `pdal`
# provider, these cannot be .las and .laz files; texts are addresses. Outputs that are files are
# already in the list.
_OTHERS = QgsProcessingParameterFile, QgsProcessingParameterString
PointCloudWidget = widget_class(_CloudBox, sources=_OTHERS)
RasterWidget = widget_class(_LayerBox)
# That of QGIS takes a text table for a layer, and tells that it could not be loaded. Where it is
# blank, QGIS 3.40 cannot save a batch.
AttributeWidget = widget_class(_AttributeBox, is_for_batch=True)
