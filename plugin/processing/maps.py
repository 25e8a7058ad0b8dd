"""The tools that make rasters of points in the toolbox: ground filters and terrain models."""

from __future__ import annotations

from dataclasses import replace

from qgis.core import QgsProcessingContext

from ...algorithms.classes.selection import Selection
from ...algorithms.core.parameters import ParameterSet
from ...algorithms.tools import map_tool
from ...algorithms.tools.declaration import MapTool
from ...algorithms.tools.ground.dialogs import METHOD_TOOLS
from ...algorithms.tools.ground.output import PointOutput
from ...algorithms.tools.rasters.parameters import RasterOutput, TerrainModel
from ..i18n import mark
from .base import command_line
from .classified import show_classified
from .feedback import FeedbackProgress, Refusal
from .outputs import TILES_STAY, shown_rasters
from .tool_inputs import Request
from .tools import ToolAlgorithm


class MapAlgorithm(ToolAlgorithm):
    """A tool that makes rasters of points."""

    _tool: MapTool
    unused = ("relief_radius",)

    def __init__(self, tool: MapTool) -> None:
        super().__init__(tool)
        self._inputs = list(tool.all_inputs)
        self._outputs = list(tool.dialog_outputs())
        if tool.points.kind == "files":
            self.cancelled = TILES_STAY

    def chosen(
        self, parameters: dict[str, object], context: QgsProcessingContext
    ) -> list[ParameterSet]:
        """Return the declared parameters; of remote points only those in the area are written."""
        # Those around it are downloaded to judge these, and nobody asked for them.
        is_remote = any(found.remotes for found in self._given.values())
        return [
            replace(values, area_only=True)
            if is_remote and isinstance(values, PointOutput)
            else values
            for values in super().chosen(parameters, context)
        ]

    def work(
        self,
        inputs: dict[str, object],
        outputs: dict[str, str],
        chosen: list[ParameterSet],
        context: QgsProcessingContext,
        progress: FeedbackProgress,
    ) -> dict[str, object]:
        """Run the tool, show what was written, and return the results."""
        # Imported here, so that QGIS starts faster.
        from ...algorithms.tools.running import run

        tool, given = self._tool, {**inputs, "input": self.inputs, "crs": self.stated}
        done = run(tool, given, outputs, chosen, progress)
        if tool.points.kind == "files":
            progress.info(f"{done.text}.")
            outputs["vpc"] = done.vpc
        elif tool.classifies:
            counts = done.area_ground_count, done.area_count
            progress.share(*counts, in_area=bool(inputs["area"]))
        else:
            progress.info(f"The rasters have {done.columns:,} x {done.rows:,} cells.")
        fields = {output.name: output.field_name for output in self._outputs}
        results = {fields[name]: path for name, path in outputs.items() if path}
        if self.inputs.is_survey:
            rasters = {output.field_name for output in self._outputs if output.kind == "raster"}
            drawn = {name: path for name, path in results.items() if name in rasters}
            results.update(shown_rasters(drawn, RasterOutput.among(chosen), context))
        if tool.classifies:
            self.class_counts, model = done.class_counts, TerrainModel.among(chosen)
            cells = model.dtm_cell_size, model.dtm_cell_unit == "crs"
            shown = done.class_counts, Selection.among(chosen).to_class, cells
            show_classified(self, done.vpc or outputs["output"], *shown, context, progress)
        return {**results, **{name: getattr(done, name.lower()) for name, _ in tool.numbers}}

    def _cloud(self, request: Request, name: str) -> str:
        return self.point_cloud_destination(request.parameters, name, request.context)

    def _command(self, paths: dict[str, str], chosen: list[ParameterSet]) -> str:
        """Return the command line that does the same without QGIS."""
        if not any(paths.values()):
            raise Refusal(mark("Choose at least one raster to make."))
        options = {"method": self._tool.method, **self._options(paths)}
        extent = options.pop("extent", None)
        line = command_line(self._tool.command, self._words(paths), chosen, options)
        return " ".join([line, "--extent", *extent] if extent else [line])


def map_algorithms() -> list[MapAlgorithm]:
    """Return the tools that make rasters of points."""
    tools = *METHOD_TOOLS, map_tool("classify-tiles"), map_tool("terrain")
    return [MapAlgorithm(tool) for tool in tools]
