"""The dock *Bare Earth > Review*."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Callable

import numpy as np
from qgis.core import (
    QgsApplication,
    QgsPointCloudLayer,
    QgsProject,
    QgsRectangle,
    QgsUnitTypes,
    QgsVectorLayer,
)
from qgis.gui import QgisInterface, QgsDockWidget
from qgis.PyQt.QtCore import Qt, QTimer
from qgis.PyQt.QtGui import QCloseEvent, QShowEvent
from qgis.PyQt.QtWidgets import (
    QBoxLayout,
    QComboBox,
    QFileDialog,
    QHBoxLayout,
    QLabel,
    QScrollArea,
    QSizePolicy,
    QVBoxLayout,
    QWidget,
)

from ...algorithms.core.errors import BareEarthError
from ...algorithms.crs.system import unit_symbol
from ...algorithms.tools.review.profile import ProfilePoints
from .. import compat
from ..i18n import tr
from ..processing.inputs import name_of
from ..processing.runs import Sources, runs_of, sources_of
from ..styles.loaded import file_of
from .again import Again
from .keys import ReviewKeys
from .marks import PlaceMarks
from .panel import Panel
from .profile import Profile, ProfileView, is_dark
from .reading import SAMPLES, PointsTask, sampler_of, values_along
from .session import GROUND, ReviewPlace, Session, has_places

_PANEL = 290  # pixels, least width of the panel beside the profile


class ReviewDock(QgsDockWidget):
    """Steps through the places to review, shows their profiles, and saves the answers."""

    def __init__(self, iface: QgisInterface) -> None:
        super().__init__(tr("Bare Earth: Review"), iface.mainWindow())
        self.setObjectName("BareEarthReview")
        self._canvas, self._project = iface.mapCanvas(), QgsProject.instance()
        self.session = Session()
        self._name: str | None = None  # the id of the layer of places
        self._sources = Sources()
        self._terrain = self._error = sampler_of("")
        self._task: PointsTask | None = None
        self._again: Again | None = None
        self._points: dict[int, ProfilePoints] = {}
        self._lifts: dict[int, float] = {}
        self._no_points = ""  # why there are none
        self._followed: set[str] = set()  # layers whose changes are noticed
        self._sure: int | None = None  # the place that Ground was asked twice for
        self.panel, self.view = Panel(), ProfileView()
        self.places, self.clouds = _box(), _box()
        self.legend = QLabel()
        self.legend.setWordWrap(True)
        self._marks = PlaceMarks(self._canvas)
        self._keys = ReviewKeys(
            self, self._canvas, lambda: self.isVisible() and self.session.place is not None,
            self.answer, self.step, self.undo,
        )  # fmt: skip
        self._arrange()
        self.panel.answered.connect(self.answer)
        self.panel.stepped.connect(self.step)
        self.panel.undone.connect(self.undo)
        self.panel.run_again.connect(self.run_again)
        self.panel.followed.connect(self._follow)
        self.view.pointed.connect(self._marks.point_to)
        self.places.activated.connect(lambda _: self.choose(self.places.currentData()))
        self.clouds.activated.connect(lambda _: self._choose_cloud())
        self.dockLocationChanged.connect(self._turn)
        self._project.layersAdded.connect(self._layers_added)
        self._project.layersRemoved.connect(self._layers_removed)
        self._canvas.destinationCrsChanged.connect(self._show)

    def _arrange(self) -> None:
        inner, sources, right = QWidget(), QHBoxLayout(), QVBoxLayout()
        for text, box in ((tr("Places"), self.places), (tr("Points"), self.clouds)):
            label = QLabel(text)
            label.setBuddy(box)
            sources.addWidget(label)
            sources.addWidget(box, 1)
        right.addLayout(sources)
        right.addWidget(self.view, 1)
        right.addWidget(self.legend)
        area = self._above = QScrollArea()
        area.setWidget(self.panel)
        area.setWidgetResizable(True)
        area.setFrameShape(QScrollArea.Shape.NoFrame)
        area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        area.setSizeAdjustPolicy(QScrollArea.SizeAdjustPolicy.AdjustToContents)
        area.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Preferred)
        area.setMinimumWidth(_PANEL)
        self._layout = QBoxLayout(QBoxLayout.Direction.LeftToRight, inner)
        self._layout.addWidget(area)
        self._layout.addLayout(right, 1)
        self._layout.setContentsMargins(4, 2, 4, 4)
        self.setWidget(inner)

    def _turn(self, area: Qt.DockWidgetArea) -> None:
        """Put the panel above the profile where the dock is beside the map."""
        areas, ways = Qt.DockWidgetArea, QBoxLayout.Direction
        is_beside = area in (areas.LeftDockWidgetArea, areas.RightDockWidgetArea)
        self._layout.setDirection(ways.TopToBottom if is_beside else ways.LeftToRight)
        self._above.setMinimumHeight(self.panel.sizeHint().height() if is_beside else 0)

    def showEvent(self, event: QShowEvent) -> None:
        """Take the places of the last run when the dock opens."""
        super().showEvent(event)
        if self.session.layer is None:
            layers = [layer for layer in self._project.mapLayers().values() if has_places(layer)]
            # Later, when the map has its new size.
            QTimer.singleShot(0, lambda: self.choose(_newest(layers, self._project)))
        self._show()

    def closeEvent(self, event: QCloseEvent) -> None:
        """Remove what is drawn on the map."""
        super().closeEvent(event)
        self._marks.show(None, None)

    def stop(self) -> None:
        """End all work and leave no trace, because the plugin is unloaded."""
        self._cancel()
        self._keys.stop()
        self._marks.remove()
        self._project.layersAdded.disconnect(self._layers_added)
        self._project.layersRemoved.disconnect(self._layers_removed)
        self._canvas.destinationCrsChanged.disconnect(self._show)

    # The layer of places, and the points.

    def choose(self, name: str | None) -> None:
        """Review the layer with this id."""
        layer = self._project.mapLayer(name or "")
        self.session = Session(layer if has_places(layer) else None)
        path = file_of(layer) if self.session.layer else None
        self._sources = sources_of(str(path), self._project) if path else Sources()
        self._terrain, self._error = sampler_of(self._sources.dtm), sampler_of(self._sources.error)
        self._name = name
        if self.session.layer is not None and layer.id() not in self._followed:
            self._followed.add(layer.id())
            layer.afterCommitChanges.connect(self._layer_changed)
            # A run may write the places of the next round into the same file.
            layer.dataSourceChanged.connect(self._choose_again)
        self._fill()
        self._read_points()
        if self.session.layer is not None:
            self._bring_up(layer)
        self._go()

    def _bring_up(self, layer: QgsVectorLayer) -> None:
        """Let the map show the places above all else, and no other places."""
        root = self._project.layerTreeRoot()
        for number in range(self.places.count()):
            node = root.findLayer(self.places.itemData(number))
            if node is not None:
                node.setItemVisibilityChecked(node.layerId() == layer.id())
        node, order = root.findLayer(layer.id()), root.layerOrder()
        if node is not None and order[0] != layer:
            root.insertChildNode(0, node.clone())
            node.parent().removeChildNode(node)

    def _fill(self) -> None:
        """List the layers of places and the point clouds of the project."""
        self.places.clear()
        for layer in self._project.mapLayers().values():
            if has_places(layer):
                self.places.addItem(layer.name(), layer.id())
        current = self.session.layer.id() if self.session.layer else None
        self.places.setCurrentIndex(self.places.findData(current))
        files = [file_of(layer) for layer in self._project.mapLayers().values()
                 if isinstance(layer, QgsPointCloudLayer)]  # fmt: skip
        clouds = [run.cloud for run in reversed(runs_of(self._project))]
        paths = dict.fromkeys([self._sources.cloud, *clouds, *map(str, filter(None, files))])
        self.clouds.clear()
        for path in filter(None, paths):
            origin, file = name_of(Path(path)), Path(path).name
            is_own = file.startswith(origin)  # else a temporary output, called OUTPUT.laz
            self.clouds.addItem(file if is_own else f"{origin}: {file}", path)
            self.clouds.setItemData(self.clouds.count() - 1, path, Qt.ItemDataRole.ToolTipRole)
        self.clouds.addItem(tr("Another file…"), "")
        self.clouds.setCurrentIndex(self.clouds.findData(self._sources.cloud or None))

    def _choose_cloud(self) -> None:
        path = self.clouds.currentData()
        if not path:
            kinds = tr("Point clouds (*.las *.laz *.vpc)")
            path, _ = QFileDialog.getOpenFileName(self, tr("Classified points"), "", kinds)
        if path:
            self._sources = self._sources._replace(cloud=path)
            self._read_points()
        self._fill()
        self._show()
        self.view.setFocus()

    def _read_points(self) -> None:
        """Read the points of all places in another thread."""
        self._cancel()
        self._points, self._lifts = {}, {}
        self._no_points = tr("Choose the classified points above to see them here.")
        if not self._sources.cloud or not self.session.places:
            return
        self._no_points = tr("Reading the points…")
        self._task = task = PointsTask(self._sources, self.session.places)
        for event in (task.along, task.taskCompleted, task.taskTerminated):
            event.connect(lambda: self._take(task))
        QgsApplication.taskManager().addTask(task)

    def _take(self, task: PointsTask) -> None:
        """Show what a task has read."""
        if task is self._task:
            self._points, self._lifts, self._no_points = task.points, task.lifts, task.error
            self._task = task if task.isActive() else None
            self._show()

    def _cancel(self) -> None:
        task, self._task = self._task, None
        if task is not None:
            task.cancel()

    def _layers_added(self, layers: list[object]) -> None:
        """Go on with new places once the run that made them has ended."""
        new = [layer for layer in layers if has_places(layer)]
        if new and self.isVisible():
            QTimer.singleShot(0, lambda: self.choose(_newest(new, self._project)))
        elif self.isVisible():
            QTimer.singleShot(0, self._fill)

    def _layers_removed(self, names: list[str]) -> None:
        if self.places.currentData() in names:
            self.choose(None)
        elif self.isVisible():
            self._fill()

    def _choose_again(self) -> None:
        QTimer.singleShot(0, lambda: self.choose(self._name))

    def _layer_changed(self) -> None:
        self.session.read()
        self._show()

    # Answers.

    def answer(self, answer: str) -> None:
        """Save the answer for the current place, and go to the next one."""
        place = self.session.place
        if place is None:
            return
        question = self._question(place) if answer == GROUND else ""
        if question and self._sure != place.feature:
            self._sure = place.feature
            self.panel.message.setText(question)
            self._show()
            return
        self._try(lambda: self.session.give(answer))
        if self.session.is_done and not self.panel.message.text():
            self.panel.message.setText(tr("All places are answered or skipped."))

    def _question(self, place: ReviewPlace) -> str:
        """Return what to ask before a place becomes ground; empty if there is nothing to ask."""
        if self._task is not None:
            return tr(
                "Points are being read: it is not known yet how far this place would rise as"
                " ground. Press G again to answer without that."
            )
        lift = self._lifts.get(place.feature, math.nan)
        text = tr(
            "As ground, this place would rise by up to {} m; its expected error is {} m. Press G"
            " again if that is right."
        )
        figures = f"{lift:.1f}", f"{place.error:.2f}"
        return text.format(*figures) if lift > place.error else ""

    def step(self, by: int) -> None:
        """Go to another place."""
        self._try(lambda: self.session.step(by))

    def undo(self) -> None:
        """Take the last answer back."""
        self._try(lambda: self.session.undo())

    def _try(self, work: Callable[[], None]) -> None:
        self._sure = None
        try:
            work()
            self.panel.message.setText("")
        except BareEarthError as error:
            self.panel.message.setText(str(error))
        self._go()

    def run_again(self) -> None:
        """Classify the points again with the answers as corrections."""
        self._again = Again(self.session, self._sources, self.panel.message.setText)
        self._again.start()

    def _follow(self, address: str) -> None:
        """Show the place of a change on the map."""
        if self.session.layer is not None:
            box = QgsRectangle(*map(float, address.split()))
            self._marks.zoom_to(box, self.session.layer)

    # What is shown.

    def _go(self) -> None:
        """Show the current place, also on the map."""
        self._show()
        if self.session.place is not None:
            self._marks.zoom_to(self.session.place.extent, self.session.layer)
        self.view.setFocus()

    def _show(self) -> None:
        self.panel.show_session(self.session)
        place, layer = self.session.place, self.session.layer
        self._marks.show(place if self.isVisible() else None, layer)
        profile = self._profile(place, layer) if place else None
        self.view.show_profile(profile)
        self.legend.setText(profile.legend(is_dark(self.view)) if profile else "")

    def _profile(self, place: ReviewPlace, layer: QgsVectorLayer) -> Profile:
        x1, y1, x2, y2 = place.line
        length, points = math.hypot(x2 - x1, y2 - y1), self._points.get(place.feature)
        unit = QgsUnitTypes.toAbbreviatedString(layer.crs().mapUnits())
        # Without a CRS, which QGIS takes for degrees, runs take the coordinates as metres.
        unit = "m" if layer.crs().mapUnits() in compat.NO_LENGTHS else unit
        up = unit_symbol(self._terrain.unit) if self._terrain and self._terrain.unit else unit
        terrain, error = (values_along(one, place.line) for one in (self._terrain, self._error))
        message = "" if points is not None else self._no_points
        along = np.linspace(0.0, length, SAMPLES)
        return Profile(length, (unit, up), points, along, terrain, error, place.inside, message)


def _box() -> QComboBox:
    box = QComboBox()
    box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
    box.setMinimumContentsLength(6)
    return box


def _newest(layers: list[QgsVectorLayer], project: QgsProject) -> str | None:
    """Return the id of the layer that the last run made; else of the last one."""
    for run in reversed(runs_of(project)):
        for layer in layers:
            path = file_of(layer)
            if path is not None and run.made(str(path)):
                return layer.id()
    return layers[-1].id() if layers else None
