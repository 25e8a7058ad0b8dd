"""The part of the dock with the reason of a place, the answers and what they did."""

from __future__ import annotations

import math

from qgis.PyQt.QtCore import Qt, pyqtSignal
from qgis.PyQt.QtGui import QColor, QIcon, QPixmap
from qgis.PyQt.QtWidgets import (
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QProgressBar,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from ..i18n import mark, tr
from ..styles.reasons import in_own_language
from ..styles.vectors import ANSWERS
from .session import GROUND, NOT_GROUND, RIGHT, SKIP, ReviewPlace, Session

# Texts of the buttons with their keys, and what the answers do.
_TEXTS = {
    RIGHT: (mark("Right as it is (R)"), mark("Changes nothing, and is left out next time.")),
    NOT_GROUND: (mark("Not ground (N)"), mark("In the next run, no point here is ground.")),
    GROUND: (
        mark("Ground (G)"),
        mark("In the next run, the ground around is continued through the place."),
    ),
    SKIP: (mark("Skip (S)"), mark("The place stays for another time.")),
}


class Panel(QWidget):
    """Shows a place, and asks for its answer."""

    answered = pyqtSignal(str)
    stepped = pyqtSignal(int)
    undone = pyqtSignal()
    run_again = pyqtSignal()
    followed = pyqtSignal(str)  # the address of a link in the message

    def __init__(self) -> None:
        super().__init__()
        self._title, self.reason, self._figures = _label(), _label(), _label()
        for label, size in ((self._title, 1.0), (self.reason, 1.15)):
            font = label.font()
            font.setPointSizeF(font.pointSizeF() * size)
            font.setBold(label is self.reason)
            label.setFont(font)
        self._bar = QProgressBar()
        self._bar.setMaximumHeight(self.fontMetrics().height() + 2)
        self.message = _label()
        self.message.setTextInteractionFlags(
            Qt.TextInteractionFlag.TextSelectableByMouse
            | Qt.TextInteractionFlag.LinksAccessibleByMouse
        )
        self.message.linkActivated.connect(self.followed)
        self.buttons = {answer: self._answer(answer) for answer in _TEXTS}
        self.again = QPushButton(tr("Correct and run again"))
        self.again.clicked.connect(self.run_again)
        self.undo = QPushButton(tr("Undo"))
        self.undo.clicked.connect(self.undone)
        steps = [QPushButton(tr("Previous")), QPushButton(tr("Next"))]
        for button, by in zip(steps, (-1, 1)):
            button.clicked.connect(lambda _, by=by: self.stepped.emit(by))
        for button in (*self.buttons.values(), *steps, self.undo, self.again):
            button.setFocusPolicy(Qt.FocusPolicy.TabFocus)  # the keys stay with the profile
        self._arrange(steps)

    def _answer(self, answer: str) -> QPushButton:
        """Return the button of an answer, in the colour that the place gets on the map."""
        square, (text, help) = QPixmap(12, 12), _TEXTS[answer]
        square.fill(QColor(ANSWERS[answer][1]))
        button = QPushButton(QIcon(square), tr(text))
        button.setToolTip(tr(help))
        button.setCheckable(True)
        button.clicked.connect(lambda: self.answered.emit(answer))
        return button

    def _arrange(self, steps: list[QPushButton]) -> None:
        layout, head, below = QVBoxLayout(self), QHBoxLayout(), QHBoxLayout()
        answers = QGridLayout()
        head.addWidget(self._title)
        head.addWidget(self._bar, 1)
        for number, button in enumerate(self.buttons.values()):
            answers.addWidget(button, number // 2, number % 2)
        for button in (*steps, self.undo):
            below.addWidget(button)
        layout.addLayout(head)
        layout.addWidget(self.reason)
        layout.addWidget(self._figures)
        layout.addLayout(answers)
        layout.addLayout(below)
        layout.addWidget(self.message)
        layout.addStretch(1)
        layout.addWidget(self.again)
        layout.setContentsMargins(6, 4, 6, 4)
        layout.setSpacing(5)

    def show_session(self, session: Session) -> None:
        """Show the current place of a session, or that no place is left."""
        place, count = session.place, len(session.places)
        for answer, button in self.buttons.items():
            button.setEnabled(place is not None)
            button.setChecked(place is not None and place.answer == answer)
        self.undo.setEnabled(session.can_undo)
        self.again.setEnabled(session.corrections > 0)
        self._bar.setVisible(count > 0)
        self._bar.setRange(0, max(count, 1))
        self._bar.setValue(session.answered)
        self._bar.setFormat(tr("{} of {} answered").format(session.answered, count))
        if place is None:
            self._title.setText("")
            self.reason.setText(tr("No places to review"))
            self._figures.setText(
                tr(
                    "Run a tool with the expected error of the terrain, then Places to review; or"
                    " choose a layer of places."
                )
            )
            return
        self._title.setText(tr("Place {} of {}").format(session.number + 1, count))
        reason = in_own_language(place.reason)
        self.reason.setText(f"{reason[:1].upper()}{reason[1:]}")
        self._figures.setText(_figures_of(place))


def _figures_of(place: ReviewPlace) -> str:
    """Return the figures of a place in a line."""
    text = tr("Expected error up to {} m on {} m²").format(
        f"{place.error:.2f}", f"{place.area:,.0f}"
    )
    if math.isfinite(place.low + place.high):
        heights = f"{place.low:.2f}", f"{place.high:.2f}"
        text += "; " + tr("terrain from {} to {}").format(*heights)
    return text


def _label() -> QLabel:
    label = QLabel()
    label.setWordWrap(True)
    return label
