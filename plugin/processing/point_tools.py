"""The tools that write classified files anew, in the toolbox, from their declarations."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from qgis.core import QgsProcessingContext, QgsProcessingParameterFeatureSource

from ...algorithms.core.parameters import ParameterSet
from ...algorithms.core.progress import Progress
from ...algorithms.engine.memory import Resources
from ...algorithms.las.writing import check_cloud
from ...algorithms.survey.files import is_one_file
from ...algorithms.survey.ground_classes import GroundClasses
from ...algorithms.tools import point_tool
from ...algorithms.tools.declaration import Input
from ...algorithms.tools.heights import HEIGHT_DIMENSION
from .. import compat
from ..i18n import mark
from ..styles import layers
from .base import command_line
from .feedback import FeedbackProgress
from .given_terrain import add_terrain, terrain_of
from .inputs import layer_polygons
from .products import ProductAlgorithm
from .search_words import words_in

# Titles of the layers of classes, by what a tool shows.
_TITLES = {"classes": layers.CLASSES, "key points": mark("key points")}
# Share of the progress bar until what the user did not give is found.
_FINDING = 0.4


class PointToolAlgorithm(ProductAlgorithm):
    """A tool that writes classified files anew, given its command."""

    def __init__(self, command: str) -> None:
        super().__init__()
        self._tool = tool = point_tool(command)
        self.identifier, self.page = tool.identifier, tool.page
        self.title, self.summary, self.about = tool.title, tool.summary, tool.about
        self.cloud_label, self.cloud_help = tool.output_label, tool.output_help
        self.numbers = tool.numbers
        self._inputs = [each for each in tool.inputs if each.label]
        self._rasters: dict[str, str] = {}  # files of the inputs that are rasters

    def createInstance(self) -> PointToolAlgorithm:
        """Return another instance."""
        return type(self)(self._tool.command)

    def tags(self) -> list[str]:
        """Return the words for the search of the toolbox."""
        return words_in(self._tool.words)

    def parameter_sets(self) -> tuple[type[ParameterSet], ...]:
        """Return the sets of the tool, and resources."""
        return (*(self._tool.dialog_sets or self._tool.sets), Resources)

    def add_inputs(self) -> None:
        """Add the fields of the points, and of further inputs."""
        super().add_inputs()
        self._add_further(False)

    def initAlgorithm(self, configuration: dict[str, Any] | None = None) -> None:
        """Declare the fields of the dialog and the results."""
        super().initAlgorithm(configuration)
        self._add_further(True)

    def _add_further(self, is_last: bool) -> None:
        for each in self._inputs:
            if each.is_last == is_last:
                add = {"polygons": _add_polygons, "raster": add_terrain}[each.kind]
                add(self, each.name.upper(), each.label, each.field_help)

    def prepare(
        self,
        parameters: dict[str, Any],
        context: QgsProcessingContext,
        progress: FeedbackProgress,
    ) -> None:
        """Find the inputs."""
        super().prepare(parameters, context, progress)
        for each in self._inputs:
            if each.kind == "raster":
                name = each.name.upper()
                self._rasters[each.name] = terrain_of(self, parameters, context, name)

    def compute(
        self,
        parameters: dict[str, Any],
        context: QgsProcessingContext,
        progress: FeedbackProgress,
    ) -> dict[str, Any]:
        """Find the values of the points and write them."""
        from ...algorithms.runs.entry import write
        from ...algorithms.runs.requests import PointRequest

        chosen = self.chosen(parameters, context)
        output = self.cloud_output(parameters, context, progress)
        options = {**self._options(parameters), "crs": self.stated}
        files = [str(self.source), output]
        progress.command(command_line(self._tool.command, files, chosen, options))
        if is_one_file(self.inputs):
            check_cloud(self.source, Path(output))  # to find polygons can take minutes
        start = _FINDING if any(each.found for each in self._inputs) else 0.0
        ground, finding = GroundClasses.among(chosen), progress.part(0.0, start)
        inputs = {
            each.name: self._given(each, parameters, context, ground, finding)
            for each in self._inputs
        }
        request = PointRequest.of(self._tool, chosen, inputs, self.stated)
        summary = write(self.source, Path(output), request, progress.part(start, 1.0))
        return self.done(output, summary, self._look(chosen, summary), context, progress)

    def _options(self, parameters: dict[str, Any]) -> dict[str, str]:
        """Return the options of the command line for further inputs."""
        files = {each.name: f"{each.name}.geojson" for each in self._inputs} | self._rasters
        for each in self._inputs:
            if each.found and compat.is_empty(parameters.get(each.name.upper())):
                files[each.name] = "automatic"
        return files

    def _given(
        self,
        declared: Input,
        parameters: dict[str, Any],
        context: QgsProcessingContext,
        ground: GroundClasses,
        progress: Progress,
    ) -> Any:
        """Return a further input as the step has it."""
        if declared.kind == "raster":
            path = self._rasters[declared.name]
            return declared.of(path, progress) if path else None
        name = declared.name.upper()
        if declared.found and compat.is_empty(parameters.get(name)):
            return declared.found([self.source], ground, self.stated, progress)
        progress.info(
            f"In the command line the {declared.name} is missing: save it in the CRS of the points"
            f" as {declared.name}.geojson."
        )
        crs = self.crs_of(self.source)
        return declared.of(layer_polygons(self, parameters, name, declared.label, context, crs))

    def _look(self, chosen: list[ParameterSet], summary: Any) -> layers.Look:
        """Return the look of the written points."""
        if self._tool.shows != "heights":
            return layers.classes(summary.class_counts, _TITLES[self._tool.shows])
        is_z = any(getattr(each, "output_as", "") == "z" for each in chosen)
        unit = getattr(summary, "tiles", (summary,))[0].unit_size
        attribute = "Z" if is_z else HEIGHT_DIMENSION
        return layers.heights(attribute, self.numbers_of(summary)["MAXIMUM"], unit)


def _add_polygons(algorithm: ProductAlgorithm, name: str, label: str, text: str) -> None:
    """Add a field for a layer of polygons, which may stay empty."""
    field = QgsProcessingParameterFeatureSource(name, label, [compat.POLYGONS], None, True)
    algorithm.addParameter(field, text)
