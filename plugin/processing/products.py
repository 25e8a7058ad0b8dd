"""Base class of the Processing algorithms for classified point clouds."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from qgis.core import QgsProcessingContext, QgsProcessingOutputNumber

from ...algorithms.core.files import split_name
from ...algorithms.survey.files import is_one_file
from ...algorithms.survey.ground_classes import GroundClasses
from ...algorithms.survey.kept_classes import GROUND
from .. import compat
from ..styles import layers
from .base import BareEarthAlgorithm
from .classified import show_class_raster
from .feedback import FeedbackProgress
from .inputs import ANY_CLOUD_HELP, SurveyInput, ignored_filter, name_of, source_path
from .outputs import add_cloud, after_cancel, do_not_load
from .stated_crs import add_crs

# Of the numbers of many files; all others are added up.
_TOGETHER = {"MINIMUM": min, "MAXIMUM": max}


class ProductAlgorithm(BareEarthAlgorithm):
    """Base class of the algorithms for classified point clouds."""

    section = "Products"
    cloud_label = cloud_help = ""  # of the output point cloud; empty if there is none
    # name, in lower case an attribute of the summary, and label
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
        if self.cloud_label:
            self.cancelled = after_cancel(self.inputs)

    def prepare(
        self,
        parameters: dict[str, Any],
        context: QgsProcessingContext,
        progress: FeedbackProgress,
    ) -> None:
        """Find the input, and warn of a filter that is ignored."""
        super().prepare(parameters, context, progress)
        ground = GroundClasses.among(self.chosen(parameters, context)).ground_classes
        self._ground = (*ground, GROUND)[0]
        if ignored_filter(self, parameters, "INPUT", context):
            progress.warning("The layer's filter is not applied: all points are read.")

    def cloud_output(
        self,
        parameters: dict[str, Any],
        context: QgsProcessingContext,
        progress: FeedbackProgress,
    ) -> str:
        """Return the path of the output point cloud, for many files a folder of this name without
        its ending; tell the user if QGIS cannot show it.
        """
        output = self.point_cloud_destination(parameters, "OUTPUT", context)
        if not is_one_file(self.inputs):
            do_not_load(context, [output])
            return str(Path(output).with_name(split_name(Path(output))[0]))
        if not compat.can_load(output):
            progress.info(f"This QGIS cannot show such a file as a layer. It will be at {output}.")
        return output

    def done(
        self,
        output: str,
        summary: Any,
        look: layers.Look,
        context: QgsProcessingContext,
        progress: FeedbackProgress,
    ) -> dict[str, Any]:
        """Show the point cloud of `cloud_output`; return the outputs of the algorithm."""
        progress.info(summary.text)
        if not is_one_file(self.inputs):
            output = summary.vpc
            if compat.can_load(output):
                compat.load_point_cloud(output, context)
            else:
                progress.info(f"This QGIS cannot show such a file as a layer. It is at {output}.")
        self.class_counts = getattr(summary, "class_counts", {})
        self.show(output, look)
        if not compat.can_load(output):
            show_class_raster(self, output, self.class_counts, self._ground, context, progress)
        return {"OUTPUT": output, **self.numbers_of(summary)}

    def numbers_of(self, summary: Any) -> dict[str, Any]:
        """Return the outputs that are numbers, from a summary of one file or of many."""
        names = [name for name, _ in self.numbers]
        files = getattr(summary, "tiles", None)
        if files is None:
            return {name: getattr(summary, name.lower()) for name in names}
        return {
            name: _TOGETHER.get(name, sum)(getattr(each, name.lower()) for each in files)
            for name in names
        }
