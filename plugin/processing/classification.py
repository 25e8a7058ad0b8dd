"""Ground classification of one file by any method, in the toolbox."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from qgis.core import QgsProcessingContext, QgsProcessingOutputNumber

from ...algorithms.core.parameters import ParameterSet
from ...algorithms.engine.memory import Resources
from ...algorithms.filters import METHODS
from ...algorithms.survey.selection import Selection
from ...algorithms.tools.above_ground.classes import ThenAboveGround
from ...algorithms.tools.ground.output import Output
from ...algorithms.tools.rasters.parameters import Gaps, TerrainModel
from .area import add_area, add_limits, area_options, given_options, limits_of
from .base import BareEarthAlgorithm, command_line
from .classified import show_classified
from .feedback import FeedbackProgress
from .inputs import (
    CLOUD_HELP,
    PointCloudInput,
    ignored_filter,
    name_of,
    source_path,
)
from .outputs import (
    add_cloud,
    add_explanation,
    add_rasters,
    raster_files,
    raster_paths,
)
from .stated_crs import add_crs


class ClassificationAlgorithm(BareEarthAlgorithm):
    """Base class of the ground classifications; subclasses set the method."""

    method = ""  # name in the command line
    section = "Ground classification"
    unused = ("relief_radius",)

    @property
    def shown(self) -> tuple[str, ...]:
        """Return the main parameters: preset, size of the largest object, cell size."""
        return "preset", METHODS[self.method].size_parameter, "dtm_cell_size"

    @property
    def run_name(self) -> str:
        """Return the name of the group of layers."""
        return METHODS[self.method].label

    def parameter_sets(self) -> tuple[type[ParameterSet], ...]:
        """Return the parameters of the method, then those of all methods."""
        sets = METHODS[self.method].parameters, Selection, TerrainModel, Gaps, Output
        return *sets, ThenAboveGround, Resources

    def initAlgorithm(self, configuration: dict[str, Any] | None = None) -> None:
        """Declare the fields of the dialog and the results."""
        self.addParameter(PointCloudInput("INPUT", "Point cloud"), CLOUD_HELP)
        add_crs(self)
        add_area(self)
        self.add_declared()
        add_limits(self)
        add_cloud(self)
        add_rasters(self, ("dtm", "hillshade"))
        add_explanation(self)
        self.addOutput(QgsProcessingOutputNumber("POINT_COUNT", "Points"))
        self.addOutput(QgsProcessingOutputNumber("AREA_COUNT", "Points in the area"))
        self.addOutput(QgsProcessingOutputNumber("SELECTED_COUNT", "Points that took part"))
        self.addOutput(QgsProcessingOutputNumber("GROUND_COUNT", "Ground points"))

    def find_inputs(self, parameters: dict[str, Any], context: QgsProcessingContext) -> None:
        """Find the input file."""
        self._source = source_path(self, parameters, "INPUT", context)
        self.inputs, self.subject = [self._source], name_of(self._source)

    def prepare(
        self,
        parameters: dict[str, Any],
        context: QgsProcessingContext,
        progress: FeedbackProgress,
    ) -> None:
        """Find the input, and read area, corrections and constraints."""
        super().prepare(parameters, context, progress)
        if ignored_filter(self, parameters, "INPUT", context):
            progress.warning("The layer's filter is not applied: all points are read.")
        crs = self.crs_of(self._source)
        self._limits = limits_of(self, parameters, context, crs, progress)

    def compute(
        self,
        parameters: dict[str, Any],
        context: QgsProcessingContext,
        progress: FeedbackProgress,
    ) -> dict[str, Any]:
        """Classify the file."""
        # Imported here, so that QGIS starts faster.
        from ...algorithms.runs.entry import classify
        from ...algorithms.runs.requests import ClassifyRequest

        chosen = self.chosen(parameters, context)
        output = self.point_cloud_destination(parameters, "OUTPUT", context)
        paths = raster_paths(self, parameters, context)
        explanation = self.parameterAsOutputLayer(parameters, "EXPLANATION", context)
        options = {"method": self.method, **given_options(**self._limits), **paths}
        options["explain"] = explanation
        command = command_line("classify", [str(self._source), output], chosen, options)
        progress.command(" ".join([command, *area_options(self._limits["area"], progress)]))
        request = ClassifyRequest.of(
            chosen,
            rasters=raster_files(paths),
            explain=Path(explanation) if explanation else None,
            **self._limits,
        )
        if explanation:
            paths["EXPLANATION"] = explanation
        summary = classify(self._source, output, request, progress, as_survey=False)
        counts = summary.area_ground_count, summary.area_count
        progress.share(*counts, in_area=bool(self._limits["area"]))
        show_classified(self, output, summary.class_counts, request, context, progress)
        self.class_counts = summary.class_counts
        return {
            "OUTPUT": output,
            **paths,
            "POINT_COUNT": summary.point_count,
            "AREA_COUNT": summary.area_count,
            "SELECTED_COUNT": summary.selected_count,
            "GROUND_COUNT": summary.ground_count,
        }
