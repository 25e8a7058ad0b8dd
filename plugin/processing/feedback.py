"""Progress, messages and cancelling between the classifier and a Processing dialog."""

from __future__ import annotations

from qgis.core import QgsProcessingFeedback

from ...algorithms.core.errors import Cancelled
from ...algorithms.core.progress import Progress


class FeedbackProgress(Progress):
    """Shows a computation in the dialog, and stops it when the user wants.

    Parameters
    ----------
    feedback : QgsProcessingFeedback
        The dialog's, or that of a model or of qgis_process.
    """

    def __init__(self, feedback: QgsProcessingFeedback) -> None:
        self._feedback = feedback

    def report(self, fraction: float) -> None:
        """Move the bar; raise `Cancelled` if the user pressed Cancel."""
        if self._feedback.isCanceled():
            raise Cancelled
        self._feedback.setProgress(100.0 * fraction)

    def info(self, text: str) -> None:
        """Write a line into the log."""
        self._feedback.pushInfo(text)

    def warning(self, text: str) -> None:
        """Write a line that stands out into the log."""
        self._feedback.pushWarning(text)

    def command(self, text: str) -> None:
        """Write a command into the log."""
        self._feedback.pushCommandInfo(text)
