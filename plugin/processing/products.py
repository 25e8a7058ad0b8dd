"""Base class of the Processing algorithms for classified point clouds."""

from __future__ import annotations

from typing import Any

from qgis.core import QgsProcessingContext, QgsProcessingOutputNumber

from .. import compat
from .base import BareEarthAlgorithm
from .feedback import FeedbackProgress
from .inputs import ANY_CLOUD_HELP, SurveyInput, ignored_filter, name_of, source_path
from .outputs import add_cloud
from .stated_crs import add_crs


class ProductAlgorithm(BareEarthAlgorithm):
    """Base class of the algorithms for classified point clouds.

    Attributes
    ----------
    cloud_label, cloud_help : str
        Label and help of the output point cloud; empty if there is none.
    numbers : tuple of (str, str)
        Name and label of each output that is a number. In lower case, the name is an attribute of
        the summary.
    """

    section = "Products"
    cloud_label = cloud_help = ""
    numbers: tuple[tuple[str, str], ...] = ()

    def add_outputs(self) -> None:
        """Add the output fields."""
        add_cloud(self, self.cloud_label, self.cloud_help)

    def add_inputs(self) -> None:
        """Add the input fields."""
        self.addParameter(SurveyInput("INPUT", "Classified point cloud"), ANY_CLOUD_HELP)

    def initAlgorithm(self, configuration: dict[str, Any] | None = None) -> None:
        """Declare the fields of the dialog and the results."""
        self.add_inputs()
        add_crs(self)
        self.add_declared()
        self.add_outputs()
        for name, label in self.numbers:
            self.addOutput(QgsProcessingOutputNumber(name, label))

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

    def cloud_output(
        self,
        parameters: dict[str, Any],
        context: QgsProcessingContext,
        progress: FeedbackProgress,
    ) -> str:
        """Return the path of the output point cloud; tell the user if QGIS cannot show it."""
        output = self.point_cloud_destination(parameters, "OUTPUT", context)
        if not compat.can_load(output):
            progress.info(f"This QGIS cannot show such a file as a layer. It will be at {output}.")
        return output

    def numbers_of(self, summary: Any) -> dict[str, Any]:
        """Return the outputs that are numbers, from a summary."""
        return {name: getattr(summary, name.lower()) for name, _ in self.numbers}
