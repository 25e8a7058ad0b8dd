"""What a review draws on the map: the outline of the place, and the line of its profile."""

from __future__ import annotations

from qgis.core import (
    QgsCoordinateTransform,
    QgsGeometry,
    QgsPointXY,
    QgsProject,
    QgsRectangle,
    QgsVectorLayer,
)
from qgis.gui import QgsMapCanvas, QgsMapCanvasItem, QgsRubberBand
from qgis.PyQt.QtCore import QPointF, QRectF, Qt
from qgis.PyQt.QtGui import QColor, QPainter

from .session import ReviewPlace

_LINE, _CASING = QColor("#1d1d1d"), QColor(255, 255, 255, 230)
_OUTLINE = QColor("#ffd23f")
_RADIUS = 8.0  # pixels, of the discs with the letters of the ends
# Around a place, as a share of its extent, and the least width of the map in units of the CRS.
_AROUND, _LEAST = 1.5, 30.0


class PlaceMarks:
    """Shows the current place on the map."""

    def __init__(self, canvas: QgsMapCanvas) -> None:
        self._canvas = canvas
        self._outline, self._line = QgsRubberBand(canvas), QgsRubberBand(canvas)
        for band, colour, width in ((self._outline, _OUTLINE, 3), (self._line, _LINE, 2)):
            band.setBrushStyle(Qt.BrushStyle.NoBrush)
            band.setStrokeColor(colour)
            band.setWidth(width)
        self._line.setSecondaryStrokeColor(_CASING)
        self._discs = [_Disc(canvas, text) for text in ("A", "B", "")]
        self._ends: tuple[QgsPointXY, QgsPointXY] | None = None

    def show(self, place: ReviewPlace | None, layer: QgsVectorLayer | None) -> None:
        """Show a place of a layer, or none."""
        for disc in self._discs:
            disc.hide()
        self._outline.reset()
        self._line.reset()
        self._ends = None
        if place is None or layer is None:
            return
        x1, y1, x2, y2 = place.line
        ends = QgsPointXY(x1, y1), QgsPointXY(x2, y2)
        self._outline.setToGeometry(place.outline, layer)
        self._line.setToGeometry(QgsGeometry.fromPolylineXY(list(ends)), layer)
        change = self._to_map(layer)
        self._ends = change.transform(ends[0]), change.transform(ends[1])
        for disc, end in zip(self._discs, self._ends):
            disc.move(end)

    def point_to(self, share: float) -> None:
        """Show the place at a share of the line; none if it is negative."""
        if share < 0.0 or self._ends is None:
            self._discs[2].hide()
            return
        (a, b), rest = self._ends, 1.0 - share
        self._discs[2].move(QgsPointXY(rest * a.x() + share * b.x(), rest * a.y() + share * b.y()))

    def zoom_to(self, extent: QgsRectangle, layer: QgsVectorLayer) -> None:
        """Let the map show an extent in the CRS of a layer, and what is round it."""
        box = QgsRectangle(extent)
        box.grow(max((_LEAST - max(box.width(), box.height())) / 2.0, 0.0))
        box.scale(_AROUND)
        self._canvas.setExtent(self._to_map(layer).transformBoundingBox(box))
        self._canvas.refresh()

    def remove(self) -> None:
        """Remove all from the map."""
        for item in (self._outline, self._line, *self._discs):
            self._canvas.scene().removeItem(item)

    def _to_map(self, layer: QgsVectorLayer) -> QgsCoordinateTransform:
        target = self._canvas.mapSettings().destinationCrs()
        return QgsCoordinateTransform(layer.crs(), target, QgsProject.instance())


class _Disc(QgsMapCanvasItem):
    """A disc with a letter, or an empty one, at a place of the map."""

    def __init__(self, canvas: QgsMapCanvas, letter: str) -> None:
        super().__init__(canvas)
        self._letter, self._place = letter, QgsPointXY()
        self.setZValue(20)
        self.hide()

    def move(self, place: QgsPointXY) -> None:
        """Show it at a place in the CRS of the map."""
        self._place = place
        self.updatePosition()
        self.show()

    def updatePosition(self) -> None:
        """Stay at the place when the map moves."""
        self.setPos(self.toCanvasCoordinates(self._place))

    def boundingRect(self) -> QRectF:
        """Return the rectangle round the disc."""
        side = _RADIUS + 2.0
        return QRectF(-side, -side, 2.0 * side, 2.0 * side)

    def paint(self, painter: QPainter, *_: object) -> None:
        """Draw it."""
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(_CASING)
        painter.setBrush(_LINE if self._letter else _OUTLINE)
        radius = _RADIUS if self._letter else _RADIUS / 2.0
        painter.drawEllipse(QPointF(0.0, 0.0), radius, radius)
        font = painter.font()
        font.setPixelSize(11)
        font.setBold(True)
        painter.setFont(font)
        painter.drawText(self.boundingRect(), Qt.AlignmentFlag.AlignCenter, self._letter)
