"""The drawing of a profile: points in the colours of their classes, terrain, axes."""

from __future__ import annotations

import math
from html import escape
from typing import Iterator, NamedTuple

import numpy as np
from qgis.PyQt.QtCore import QPointF, QRectF, QSize, Qt, pyqtSignal
from qgis.PyQt.QtGui import (
    QColor,
    QMouseEvent,
    QPainter,
    QPainterPath,
    QPen,
    QPixmap,
    QPolygonF,
    QTextOption,
)
from qgis.PyQt.QtWidgets import QSizePolicy, QWidget

from ...algorithms.tools.review.profile import ProfilePoints
from ..i18n import tr
from ..styles.clouds import categories_of

# Points that lie further above or below the terrain than this, in units of the CRS, are not drawn:
# the ground would be flat beside them.
_MOST_ABOVE, _MOST_BELOW = 15.0, 5.0
_LEAST_HEIGHT = 2.0  # from the lowest to the highest value that is shown
GROUND = 2
_TERRAIN, _PLACE = QColor("#6e4824"), QColor(194, 59, 63, 34)
_BAND = QColor(110, 72, 36, 46)
_POINT = 3.0  # pixels
_TICKS_APART = 70, 34  # pixels between ticks, across and up
_GAP = 5  # pixels between a drawing and its text


class Profile(NamedTuple):
    """What a profile shows; all lengths and heights in units of the CRS."""

    length: float
    units: tuple[str, str]  # along the line, and up
    points: ProfilePoints | None
    # The terrain along the line, and its expected error; NaN in voids.
    along: np.ndarray
    heights: np.ndarray
    error: np.ndarray
    inside: tuple[tuple[float, float], ...]  # where the line begins and ends to be in the place
    message: str = ""

    def classes(self, is_dark: bool = False) -> dict[int, tuple[str, QColor]]:
        """Return names and colours of the classes of the points."""
        classes = [] if self.points is None else np.unique(self.points.classes).tolist()
        # The colours of maps are too pale on white.
        return {
            value: (name, colour if is_dark else colour.darker(125))
            for value, (name, colour) in categories_of(classes).items()
        }

    def legend(self, is_dark: bool) -> str:
        """Return what the colours mean, and how many points are not drawn, as HTML."""
        entries = {tr("terrain"): _TERRAIN} if np.isfinite(self.heights).any() else {}
        if np.isfinite(self.error).any():
            entries[tr("where it may be")] = _BAND
        entries |= {tr("place"): _PLACE, **dict(self.classes(is_dark).values())}
        words = [
            f'<span style="color: {_opaque(colour)}">■</span>&nbsp;{escape(text)}'
            for text, colour in entries.items()
        ]
        limits = self.limits()
        if self.points is not None and limits is not None:
            heights = self.points.heights
            beyond = int(np.count_nonzero((heights < limits[0]) | (heights > limits[1])))
            if beyond:
                words.append(escape(tr("{} points higher or lower").format(f"{beyond:,}")))
        return " &nbsp; ".join(words)

    def limits(self) -> tuple[float, float] | None:
        """Return the lowest and the highest value to show; None if nothing is known."""
        error = np.nan_to_num(self.error)
        known = [self.heights - error, self.heights + error]
        if self.points is not None:
            is_ground = self.points.classes == GROUND
            if not is_ground.any() and not np.isfinite(self.heights).any():
                is_ground = ~is_ground
            known.append(self.points.heights[is_ground])
        values = np.concatenate(known)
        values = values[np.isfinite(values)]
        if not len(values):
            return None
        low, high = float(values.min()), float(values.max())
        if self.points is not None and len(self.points.heights):
            low = min(low, max(float(self.points.heights.min()), low - _MOST_BELOW))
            high = max(high, min(float(self.points.heights.max()), high + _MOST_ABOVE))
        more = max(0.04 * (high - low), (_LEAST_HEIGHT - (high - low)) / 2.0)
        return low - more, high + more


class ProfileView(QWidget):
    """Draws a profile, and says which place of it is below the mouse."""

    # The share of the length of the line; negative where the mouse is elsewhere.
    pointed = pyqtSignal(float)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._profile: Profile | None = None
        self._picture: QPixmap | None = None
        self._share = -1.0
        self.setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setMinimumSize(200, 110)

    def sizeHint(self) -> QSize:
        """Return a size at which slopes are seen well."""
        return QSize(640, 230)

    @property
    def points(self) -> ProfilePoints | None:
        """The points that are shown."""
        return self._profile.points if self._profile else None

    def show_profile(self, profile: Profile | None) -> None:
        """Show another profile, or none."""
        self._profile, self._picture = profile, None
        self.update()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Say which place of the profile is below the mouse."""
        plot = self._plot()
        share = (event.pos().x() - plot.left()) / max(plot.width(), 1.0)
        self._point_to(share if 0.0 <= share <= 1.0 else -1.0)

    def leaveEvent(self, event: object) -> None:
        """Say that the mouse is elsewhere."""
        self._point_to(-1.0)

    def _point_to(self, share: float) -> None:
        self._share = share
        self.pointed.emit(share)
        self.update()

    def _plot(self) -> QRectF:
        """Return the part of the widget inside the axes."""
        text = self.fontMetrics()
        left, line = text.horizontalAdvance("0000.0 m") + 2 * _GAP, text.height() + _GAP
        return QRectF(self.rect()).adjusted(left, line, -3 * _GAP, -line)

    def resizeEvent(self, event: object) -> None:
        """Draw the profile anew."""
        self._picture = None

    def paintEvent(self, event: object) -> None:
        """Show the profile, whose many points are drawn only once, and the cursor."""
        profile = self._profile
        limits = profile.limits() if profile and profile.length > 0 else None
        if self._picture is None:
            self._picture = QPixmap(self.size() * self.devicePixelRatioF())
            self._picture.setDevicePixelRatio(self.devicePixelRatioF())
            self._picture.fill(self.palette().base().color())
            painter = QPainter(self._picture)
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            if profile is not None and limits is not None:
                _Drawing(painter, self, profile, self._plot(), limits).draw()
            if profile is not None and profile.message:
                painter.setPen(self.palette().text().color())
                middle = QTextOption(Qt.AlignmentFlag.AlignCenter)
                painter.drawText(QRectF(self.rect()), profile.message, middle)
            painter.end()
        painter = QPainter(self)
        painter.drawPixmap(0, 0, self._picture)
        if profile is not None and limits is not None and self._share >= 0.0:
            _Drawing(painter, self, profile, self._plot(), limits).cursor(self._share)


class _Drawing:
    """Draws a profile into a rectangle."""

    def __init__(
        self,
        painter: QPainter,
        widget: QWidget,
        profile: Profile,
        plot: QRectF,
        limits: tuple[float, float],
    ) -> None:
        self._painter, self._profile, self._plot = painter, profile, plot
        self._low, self._high = limits
        self._across = plot.width() / profile.length  # pixels of a unit
        self._up = plot.height() / (self._high - self._low)
        self._ink = widget.palette().text().color()
        self._is_dark = is_dark(widget)
        self._text = widget.fontMetrics()

    def draw(self) -> None:
        """Draw all parts, from the back to the front."""
        for start, end in self._profile.inside:
            left, right = self._x(start), self._x(end)
            place = QRectF(left, self._plot.top(), right - left, self._plot.height())
            self._painter.fillRect(place, _PLACE)
        self._axes()
        self._painter.save()
        self._painter.setClipRect(self._plot)
        self._band()
        self._points()
        self._terrain()
        self._painter.restore()

    def _x(self, along: float) -> float:
        return float(self._plot.left() + along * self._across)

    def _y(self, height: float) -> float:
        return float(self._plot.bottom() - (height - self._low) * self._up)

    def _axes(self) -> None:
        faint, plot = QColor(self._ink), self._plot
        faint.setAlpha(38)
        line = self._text.height()
        for value, text in _ticks(0.0, self._profile.length, self._across, _TICKS_APART[0]):
            x = self._x(value)
            self._line(faint, x, plot.top(), x, plot.bottom())
            self._write(x - 40, plot.bottom() + 2, 80, text, Qt.AlignmentFlag.AlignHCenter)
        for value, text in _ticks(self._low, self._high, self._up, _TICKS_APART[1]):
            y = self._y(value)
            self._line(faint, plot.left(), y, plot.right(), y)
            words = f"{text} {self._profile.units[1]}"
            self._write(0, y - line / 2, plot.left() - _GAP, words, Qt.AlignmentFlag.AlignRight)
        self._line(self._ink, plot.left(), plot.bottom(), plot.right(), plot.bottom())
        self._line(self._ink, plot.left(), plot.top(), plot.left(), plot.bottom())
        for x, end in ((plot.left(), "A"), (plot.right(), "B")):
            self._write(x - 20, 1, 40, end, Qt.AlignmentFlag.AlignHCenter)
        times = tr("heights times {}").format(f"{self._up / self._across:.1f}")
        self._write(plot.left() + 20, 1, plot.width() - 40, times, Qt.AlignmentFlag.AlignRight)

    def _line(self, colour: QColor, *ends: float) -> None:
        self._painter.setPen(QPen(colour, 1.0))
        self._painter.drawLine(QPointF(*ends[:2]), QPointF(*ends[2:]))

    def _write(self, x: float, y: float, width: float, text: str, flag: Qt.AlignmentFlag) -> None:
        option = QTextOption(flag)
        option.setWrapMode(QTextOption.WrapMode.NoWrap)
        self._painter.setPen(self._ink)
        self._painter.drawText(QRectF(x, y, width, self._text.height()), text, option)

    def _band(self) -> None:
        """Draw where the terrain may be, by the expected error."""
        profile = self._profile
        for part in _runs(np.isfinite(profile.heights) & np.isfinite(profile.error)):
            along, heights = profile.along[part], profile.heights[part]
            edge = self._curve(along, heights + profile.error[part])
            back = self._curve(along[::-1], (heights - profile.error[part])[::-1])
            path = QPainterPath()
            path.addPolygon(QPolygonF([*edge, *back]))
            self._painter.fillPath(path, _BAND)

    def _terrain(self) -> None:
        colour = _TERRAIN.lighter(180) if self._is_dark else _TERRAIN
        self._painter.setPen(QPen(colour, 1.6))
        for part in _runs(np.isfinite(self._profile.heights)):
            curve = self._curve(self._profile.along[part], self._profile.heights[part])
            self._painter.drawPolyline(QPolygonF(curve))

    def _curve(self, along: np.ndarray, heights: np.ndarray) -> list[QPointF]:
        return [QPointF(self._x(x), self._y(y)) for x, y in zip(along.tolist(), heights.tolist())]

    def _points(self) -> None:
        """Draw the points, the ground on top."""
        points = self._profile.points
        if points is None:
            return
        for value, (_, colour) in reversed(self._profile.classes(self._is_dark).items()):
            pen = QPen(colour, _POINT)
            pen.setCapStyle(Qt.PenCapStyle.RoundCap)
            self._painter.setPen(pen)
            chosen = points.classes == value
            places = self._curve(points.along[chosen], points.heights[chosen])
            self._painter.drawPoints(QPolygonF(places))

    def cursor(self, share: float) -> None:
        """Draw a line at the mouse, with the distance and the height of the terrain."""
        profile, along = self._profile, share * self._profile.length
        x = self._x(along)
        self._line(self._ink, x, self._plot.top(), x, self._plot.bottom())
        text = f"{along:.1f} {profile.units[0]}"
        if len(profile.along):
            height = profile.heights[np.abs(profile.along - along).argmin()]
            text += f"; {height:.2f} {profile.units[1]}" if math.isfinite(height) else ""
        self._write(self._plot.left() + 20, 1, 300, text, Qt.AlignmentFlag.AlignLeft)


def _ticks(low: float, high: float, pixels: float, apart: float) -> Iterator[tuple[float, str]]:
    """Yield round values with their texts, at least `apart` pixels from each other."""
    least = apart / pixels
    power = 10.0 ** math.floor(math.log10(least))
    step = next(one * power for one in (1, 2, 5, 10) if one * power >= least)
    digits = max(0, -math.floor(math.log10(step) + 1e-9))
    for number in range(math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) + 1):
        yield number * step, f"{number * step:.{digits}f}"


def _runs(known: np.ndarray) -> list[slice]:
    """Return the parts of an array that are true, at least two values long."""
    edges = np.flatnonzero(np.diff(np.concatenate(([False], known, [False])).astype(np.int8)))
    return [slice(a, b) for a, b in edges.reshape(-1, 2).tolist() if b - a > 1]


def is_dark(widget: QWidget) -> bool:
    """Return whether the background of a widget is dark."""
    return widget.palette().base().color().lightness() < 128


def _opaque(colour: QColor) -> str:
    """Return the name of a colour as it looks on white."""
    share = colour.alphaF()
    parts = (255 - share * (255 - part) for part in colour.getRgb()[:3])
    return QColor(*map(round, parts)).name()
