"""Passes progress, messages and cancels between the classifier and a Processing dialog."""

from __future__ import annotations

import difflib
import time
from typing import Iterable, Mapping

from qgis.core import QgsProcessingAlgorithm, QgsProcessingFeedback

from ...algorithms.core.errors import Cancelled
from ...algorithms.core.progress import Progress
from ..i18n import tr
from ..styles.clouds import categories_of


class FeedbackProgress(Progress):
    """Shows progress and messages in the dialog, and stops the computation after a cancel.

    Parameters
    ----------
    feedback : QgsProcessingFeedback
        The feedback of the dialog, of a model or of qgis_process.
    """

    def __init__(self, feedback: QgsProcessingFeedback) -> None:
        self._feedback, self._begun = feedback, time.monotonic()
        self._choices: list[str] = []
        self._commands: list[str] = []

    def report(self, fraction: float) -> None:
        """Move the bar; raise `Cancelled` if the user pressed Cancel before the end.

        At the end all outputs are written, so the message on cancelled runs would be wrong.
        """
        self._feedback.setProgress(100.0 * fraction)
        if fraction < 1.0 and self._feedback.isCanceled():
            raise Cancelled

    def beyond(self) -> Progress:
        """Return a progress for work after the outputs: it can be cancelled, the bar stays full."""
        return _Beyond(self._feedback)

    def info(self, text: str) -> None:
        """Write a line into the log."""
        self._feedback.pushInfo(text)

    def choice(self, text: str) -> None:
        """Write a line into the log, and again at its end."""
        self._choices.append(text)
        self.info(text)

    def warning(self, text: str) -> None:
        """Write a highlighted line into the log."""
        self._feedback.pushWarning(text)

    def share(self, ground: int, count: int, in_area: bool = False) -> None:
        """Write the share of ground points into the log."""
        text = tr("{ground:,} of {count:,} points are ground ({share:.1%}).")
        if in_area:
            text = tr("{ground:,} of {count:,} points in the area are ground ({share:.1%}).")
        self.info(text.format(ground=ground, count=count, share=ground / max(count, 1)))

    def command(self, text: str) -> None:
        """Store a command that does the same without QGIS, for the end of the log."""
        self._commands.append(text)

    @property
    def commands(self) -> tuple[str, ...]:
        """The commands that do the same without QGIS."""
        return tuple(self._commands)

    def end(self, class_counts: Mapping[int, int]) -> None:
        """Write the end of the log: classes, automatic choices, time and commands.

        Parameters
        ----------
        class_counts : mapping of int to int
            Points of each class in the output; empty if no point cloud was made.
        """
        every = max(sum(class_counts.values()), 1)
        for value, (name, _) in categories_of(class_counts).items():
            text = tr("Class {number} ({name}): {count:,} points ({share:.1%})")
            count = class_counts[value]
            self.info(text.format(number=value, name=name, count=count, share=count / every))
        for each in self._choices:
            self.info(tr("Chosen automatically: {text}").format(text=each))
        self.info(tr("Time: {seconds:.1f} s").format(seconds=time.monotonic() - self._begun))
        if self._commands:
            self.info(tr("The same without QGIS:"))
        for each in self._commands:
            self._feedback.pushCommandInfo(each)


class _Beyond(Progress):
    def __init__(self, feedback: QgsProcessingFeedback) -> None:
        self._feedback = feedback

    def report(self, fraction: float) -> None:
        if self._feedback.isCanceled():
            raise Cancelled


def tell_of_unknown(
    algorithm: QgsProcessingAlgorithm, given: Iterable[str], feedback: QgsProcessingFeedback
) -> None:
    """Warn of parameters that an algorithm does not have; QGIS ignores them silently."""
    known = [each.name() for each in algorithm.parameterDefinitions()]
    for name in sorted(set(given) - set(known)):
        text = tr("There is no parameter {name}: it is ignored.").format(name=name)
        near = difflib.get_close_matches(name.upper(), known, 1)
        if near:
            text += " " + tr("Did you mean {name}?").format(name=near[0])
        feedback.pushWarning(text)
