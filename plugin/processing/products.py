"""Base class of the Processing algorithms for classified point clouds."""

from __future__ import annotations

from typing import Any

from qgis.core import QgsProcessingContext

from .base import BareEarthAlgorithm
from .feedback import FeedbackProgress
from .inputs import ANY_CLOUD_HELP, SurveyInput, ignored_filter, name_of, source_path
from .stated_crs import add_crs


class ProductAlgorithm(BareEarthAlgorithm):
    """Base class of the algorithms for classified point clouds."""

    section = "Products"
    # name, in lower case an attribute of the summary, and label
    numbers: tuple[tuple[str, str], ...] = ()

    def add_outputs(self) -> None:
        """Add the output fields."""

    def initAlgorithm(self, configuration: dict[str, Any] | None = None) -> None:
        """Declare the fields of the dialog and the results."""
        self.addParameter(SurveyInput("INPUT", "Classified point cloud"), ANY_CLOUD_HELP)
        add_crs(self)
        self.add_declared()
        self.add_outputs()
        self.add_numbers(dict(self.numbers))

    def find_inputs(self, parameters: dict[str, Any], context: QgsProcessingContext) -> None:
        """Find the input file."""
        self.source = source_path(self, parameters, "INPUT", context)
        self.inputs, self.subject = [self.source], name_of(self.source)

    def prepare(
        self,
        parameters: dict[str, Any],
        context: QgsProcessingContext,
        progress: FeedbackProgress,
    ) -> None:
        """Find the input, and warn of a filter that is ignored."""
        super().prepare(parameters, context, progress)
        if ignored_filter(self, parameters, "INPUT", context):
            progress.warning("The layer's filter is not applied: all points are read.")

    def numbers_of(self, summary: Any) -> dict[str, Any]:
        """Return the outputs that are numbers."""
        return {name: getattr(summary, name.lower()) for name, _ in self.numbers}
