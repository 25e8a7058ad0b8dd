"""The keys of a review, in the dock and on the map."""

from __future__ import annotations

from typing import Callable

from qgis.gui import QgsMapCanvas, QgsMapTool
from qgis.PyQt.QtCore import QEvent, QObject, Qt
from qgis.PyQt.QtWidgets import QWidget

from .session import GROUND, NOT_GROUND, RIGHT, SKIP

_ANSWERS = {
    Qt.Key.Key_R: RIGHT, Qt.Key.Key_N: NOT_GROUND, Qt.Key.Key_G: GROUND, Qt.Key.Key_S: SKIP,
}  # fmt: skip
_STEPS = {Qt.Key.Key_PageUp: -1, Qt.Key.Key_PageDown: 1, Qt.Key.Key_Left: -1, Qt.Key.Key_Right: 1}
_UNDO = (Qt.Key.Key_U, Qt.Key.Key_Backspace)


class ReviewKeys(QObject):
    """Takes keys while a review is shown, before QGIS takes them as its shortcuts."""

    def __init__(
        self,
        dock: QWidget,
        canvas: QgsMapCanvas,
        is_active: Callable[[], bool],
        answer: Callable[[str], None],
        step: Callable[[int], None],
        undo: Callable[[], None],
    ) -> None:
        super().__init__(dock)
        self._dock, self._canvas = dock, canvas
        self._is_active = is_active
        self._answer, self._step, self._undo = answer, step, undo
        for widget in (dock, canvas):
            widget.installEventFilter(self)

    def stop(self) -> None:
        """Leave all keys to QGIS."""
        for widget in (self._dock, self._canvas):
            widget.removeEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Take a key of the review, unless the map is being edited."""
        kind = event.type()
        if kind not in (QEvent.Type.ShortcutOverride, QEvent.Type.KeyPress):
            return False
        plain = Qt.KeyboardModifier.NoModifier, Qt.KeyboardModifier.KeypadModifier
        work = self._work(event.key()) if event.modifiers() in plain else None
        if work is None or not self._is_active() or self._is_edited(watched):
            return False
        event.accept()
        if kind == QEvent.Type.KeyPress and not event.isAutoRepeat():
            work()
        return True

    def _work(self, key: int) -> Callable[[], None] | None:
        if key in _ANSWERS:
            return lambda: self._answer(_ANSWERS[key])
        if key in _STEPS:
            return lambda: self._step(_STEPS[key])
        return self._undo if key in _UNDO else None

    def _is_edited(self, watched: QObject) -> bool:
        tool = self._canvas.mapTool() if watched is self._canvas else None
        return tool is not None and bool(tool.flags() & QgsMapTool.Flag.EditTool)
