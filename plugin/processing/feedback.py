"""Passes progress, messages and cancels between the classifier and a Processing dialog.

The log of a run is in English, whatever the language of QGIS: the classifier writes most of its
lines, and lines in two languages would be hard to read, to search for and to report. Dialogs, and
what they refuse before a run, are in the user's language (`Refusal`).
"""

from __future__ import annotations

import difflib
import time
from typing import Iterable, Mapping

from qgis.core import QgsApplication, QgsProcessingAlgorithm, QgsProcessingFeedback

from ...algorithms.core.errors import BareEarthError, Cancelled
from ...algorithms.core.progress import Progress
from ...algorithms.core.words import counted
from ...algorithms.las.class_names import CLASSES
from ..i18n import tr

# The class that the log names first.
_GROUND = 2


class Refusal(BareEarthError):
    """An error that the plugin finds: English in a log, in the user's language in a dialog; its
    text is in `mark` and has fields as for `str.format`, whose labels are translated.
    """

    def __init__(self, text: str, *values: object, **named: object) -> None:
        super().__init__(text.format(*values, **named))
        shown = {name: tr(str(value)) for name, value in named.items()}
        self.translated = tr(text).format(*(tr(str(value)) for value in values), **shown)


class FeedbackProgress(Progress):
    """Shows progress and messages in the dialog, of a model or of qgis_process, and stops the
    computation after a cancel.
    """

    def __init__(self, feedback: QgsProcessingFeedback) -> None:
        self._feedback, self._begun = feedback, time.monotonic()
        self._done = 0.0  # before what is reported
        self._choices: list[str] = []
        self.commands: list[str] = []  # that do the same without QGIS, for the end of the log

    @property
    def is_of_dialog(self) -> bool:
        """Whether a dialog shows the run, and then its results in the map."""
        return self._feedback.metaObject().className() == "QgsProcessingAlgorithmDialogFeedback"

    def report(self, fraction: float) -> None:
        """Move the bar; raise `Cancelled` if the user pressed Cancel before the end."""
        # At the end all outputs are written, so the message on cancelled runs would be wrong.
        self._feedback.setProgress(100.0 * (self._done + (1.0 - self._done) * fraction))
        if fraction < 1.0 and self._feedback.isCanceled():
            raise Cancelled

    def before(self, share: float) -> Progress:
        """Return the progress of work before all other, which gets the rest of the bar."""
        self._done = share
        return FeedbackProgress(self._feedback).part(0.0, share)

    def beyond(self) -> Progress:
        """Return a progress for work after the outputs: it can be cancelled, the bar stays full."""
        return _Beyond(self._feedback)

    def info(self, text: str) -> None:
        """Write a line into the log."""
        self._feedback.pushInfo(text)

    def choice(self, text: str) -> None:
        """Store a line for the end of the log."""
        self._choices.append(text)

    def warning(self, text: str) -> None:
        """Write a highlighted line into the log."""
        self._feedback.pushWarning(text)

    def share(self, ground: int, count: int, in_area: bool = False) -> None:
        """Write the share of ground points into the log."""
        where = " in the area" if in_area else ""
        share = ground / max(count, 1)
        self.info(f"{ground:,} of {count:,} points{where} are ground ({share:.1%}).")

    def end(self, class_counts: Mapping[int, int], has_failed: bool) -> None:
        """End the log with points of each class, automatic choices, time, and the commands of a run
        that has not failed.
        """
        every = max(sum(class_counts.values()), 1)
        for value in sorted(class_counts, key=lambda value: (value != _GROUND, value)):
            count, name = class_counts[value], CLASSES.get(value, "")
            title = f"Class {value} ({name})" if name else f"Class {value}"
            self.info(f"{title}: {counted(count, 'point')} ({count / every:.1%})")
        for choice in self._choices:
            self.info(f"Chosen automatically: {choice}")
        self.info(f"Time: {time.monotonic() - self._begun:.1f} s")
        if has_failed or not self.commands:
            return
        self.info("The same without QGIS:")
        for command in self.commands:
            self._feedback.pushCommandInfo(command)


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
    known = [parameter.name() for parameter in algorithm.parameterDefinitions()]
    for name in sorted(set(given) - set(known)):
        text = f"There is no parameter {name}: it is ignored."
        near = difflib.get_close_matches(name.upper(), known, 1)
        feedback.pushWarning(f"{text} Did you mean {near[0]}?" if near else text)


def tell_error_once(is_failing: bool) -> None:
    """Let qgis_process print the error of a failing run once; before a run, let it print all."""
    # QGIS gives the error of a run to the feedback, which prints it, and twice to the message log,
    # which qgis_process prints, too. In a window, the message log is a panel of its own.
    if QgsApplication.platform() == "qgis_process":
        QgsApplication.messageLog().blockSignals(is_failing)
