"""From a point cloud to all maps of its terrain in one step: a delivery, or single outputs."""

from __future__ import annotations

from pathlib import Path
from typing import Iterator, Sequence

from qgis.core import QgsProcessingContext, QgsProcessingParameterDefinition

from ...algorithms.classes.kept_classes import GROUND
from ...algorithms.classes.selection import Selection
from ...algorithms.core.files import split_name
from ...algorithms.core.parameters import Declaration, ParameterSet
from ...algorithms.delivery.deliveries import DELIVERIES, names_of_values
from ...algorithms.delivery.folder import DeliveryFolder
from ...algorithms.delivery.parameters import NO_DELIVERY, DeliveryChoice, DeliveryTerrain
from ...algorithms.delivery.summary import DeliverySummary
from ...algorithms.delivery.tool import OF_DELIVERIES, TOOL
from ...algorithms.engine.memory import Resources
from ...algorithms.engine.options import TileOutput
from ...algorithms.tools import map_tool
from ...algorithms.tools.contours import Contours
from ...algorithms.tools.declaration import Composition
from ...algorithms.tools.ground.method import TileMethod
from ...algorithms.tools.ground.output import PointOutput as Written
from ...algorithms.tools.rasters.parameters import MapTerrain, SurfaceModel, TerrainModel
from .. import compat
from ..i18n import mark
from ..styles import layers
from .base import command_line
from .classified import show_classified
from .feedback import FeedbackProgress, Refusal
from .fields import field_of
from .outputs import after_cancel, do_not_load, given_path, point_cloud_formats
from .tool_inputs import Request
from .tools import ToolAlgorithm

DELIVERY = TOOL.chosen.upper()
FOLDER = "DELIVERY_FOLDER"
# Cell size of rasters that are not a delivery, in metres.
_USUAL_CELL = 1.0


def _written(cloud: str, is_survey: bool) -> tuple[str, TileOutput]:
    """Return the path of the points, for many files a folder of this name without its ending, and
    the options for writing them.
    """
    if not cloud or not is_survey:
        return cloud, TileOutput()
    name, ending = split_name(Path(cloud))
    tiles = TileOutput(ending[1:].lower() or "same")
    return str(Path(cloud).with_name(name)), tiles


class CompositionAlgorithm(ToolAlgorithm):
    """Tools that work one after another."""

    _tool: Composition

    def __init__(self, tool: Composition = TOOL) -> None:
        super().__init__(tool)
        self._inputs, self._outputs = list(tool.all_inputs), list(tool.dialog_outputs())

    def declared_field(self, declaration: Declaration) -> QgsProcessingParameterDefinition:
        """Return the field of a declared parameter, empty at first if deliveries set its value."""
        is_open = declaration.name in names_of_values() and declaration.default is not None
        is_open &= declaration.kind in ("boolean", "choice")
        no_choice = mark("From the delivery") if is_open else ""
        return field_of(declaration, self._is_shown(declaration), no_choice)

    def find_inputs(self, parameters: dict[str, object], context: QgsProcessingContext) -> None:
        """Find the input files."""
        super().find_inputs(parameters, context)
        name = self._delivery(parameters, context)
        self.run_name = DELIVERIES[name].label if name else mark("terrain")

    def set_inputs(self, is_list: bool = False) -> None:
        """Set the input files, and what stays of their outputs after a cancel."""
        super().set_inputs(is_list)
        self.cancelled = after_cancel(self.inputs)

    def _delivery(self, parameters: dict[str, object], context: QgsProcessingContext) -> str:
        """Return the name of the delivery; empty for the user's own choice of outputs."""
        name = DeliveryChoice.among(self.chosen(parameters, context)).delivery
        return "" if name in (None, NO_DELIVERY) else name

    def check(self, parameters: dict[str, object], context: QgsProcessingContext) -> None:
        """Check the values, and refuse a delivery without a folder, or into an unsuitable one."""
        super().check(parameters, context)
        if self._delivery(parameters, context):
            if compat.is_empty(parameters.get(FOLDER)):
                raise Refusal(mark("Choose a folder for the delivery."))
            path = given_path(parameters.get(FOLDER), context)
            if path is not None:
                DeliveryFolder(path).check(self.inputs)

    def makes_page(self, parameters: dict[str, object], context: QgsProcessingContext) -> bool:
        """Return whether a delivery is chosen, which has a page."""
        return bool(self._delivery(parameters, context))

    def compute(
        self,
        parameters: dict[str, object],
        context: QgsProcessingContext,
        progress: FeedbackProgress,
    ) -> dict[str, object]:
        """Make a delivery, or the wanted outputs."""
        request = Request(self, parameters, context, progress)
        self._tell_of_ignored(request)
        if name := self._delivery(parameters, context):
            return self._deliver(name, request, progress)
        return self._make_own(request, progress)

    def _tell_of_ignored(self, request: Request) -> None:
        """Warn of values that this run does not use, with or without a delivery."""
        _, parameters, context, progress = request
        if self._delivery(parameters, context):
            outputs = (field.name() for field in self.destinationParameterDefinitions())
            names = [
                name
                for name in outputs
                if name != FOLDER and given_path(parameters.get(name), context) is not None
            ]
            why = "a delivery names its outputs itself, in its folder"
        else:
            names = [
                declared.name.upper()
                for values in self.chosen(parameters, context)
                if isinstance(values, OF_DELIVERIES)
                for declared in values.declarations()
                if getattr(values, declared.name) != declared.default
            ]
            fields = "CHECKPOINTS", FOLDER
            names += [name for name in fields if not compat.is_empty(parameters.get(name))]
            why = "only deliveries use them, and none is chosen"
        if names:
            progress.warning(f"Not used: {', '.join(names)}; {why}.")

    def _deliver(
        self, name: str, request: Request, progress: FeedbackProgress
    ) -> dict[str, object]:
        """Make a delivery, and let QGIS load its layers."""
        _, parameters, context, _ = request
        chosen = self.chosen(parameters, context)
        sets = [values for values in chosen if not isinstance(values, DeliveryChoice)]
        sets.append(TileOutput(format=point_cloud_formats()[0]))
        folder = self.parameterAsString(parameters, FOLDER, context)
        self._find_late(request)
        words = [name, *self.source_words(), folder]
        named = {
            one for one in names_of_values() if not compat.is_empty(parameters.get(one.upper()))
        }
        options = self._options_of_inputs()
        progress.command(command_line("deliver", words, sets, options, named))
        inputs = {name: found.value for name, found in self._given.items()}
        done = self._tool.work(self.inputs, folder, name, sets, inputs, progress, None, named)
        progress.share(done.ground_count, done.point_count, bool(inputs["area"]))
        progress.info("\n".join(f"{title}: {value}" for title, value in done.accuracy()))
        self._show_layers(done, DELIVERIES[name].pictures[0], context)
        if not done.cloud.endswith(".vpc") and compat.can_load(done.cloud):
            compat.load_point_cloud(done.cloud, context)
        shown = done.cloud, done.class_counts, chosen, done.cell_size
        self._show_cloud(*shown, context, progress)
        # The files have the names of the outputs that are chosen without a delivery.
        made = {"OUTPUT": done.cloud, **{name.upper(): file for name, file in done.layers.items()}}
        fields = {output.field_name for output in self._outputs}
        results = {name: file for name, file in made.items() if name in fields}
        results.update({"VERDICT": done.verdict} if done.verdict else {})
        return {
            **results, FOLDER: folder, "PAGE": done.page,
            "POINT_COUNT": done.point_count, "GROUND_COUNT": done.ground_count,
        }  # fmt: skip

    def _show_cloud(
        self,
        cloud: str,
        counts: dict[int, int],
        chosen: Sequence[ParameterSet],
        cell_size: float,
        context: QgsProcessingContext,
        progress: FeedbackProgress,
    ) -> None:
        """Show the classes of the points, below which the terrain must be visible."""
        self.class_counts, ground = counts, Selection.among(chosen).to_class
        cells = cell_size, MapTerrain.among(chosen).dtm_cell_unit == "crs"
        below = layers.BELOW_TERRAIN
        show_classified(self, cloud, counts, ground, cells, context, progress, below)

    def _show_layers(
        self, done: DeliverySummary, first: str, context: QgsProcessingContext
    ) -> None:
        """Let QGIS load rasters, lines and polygons; only `first` is visible."""
        looks = {
            "water": layers.WATER, "breaklines": layers.BREAKLINES, "places": layers.PLACES,
            "low_confidence": layers.LOW_CONFIDENCE,
        }  # fmt: skip
        if done.interval is not None:
            looks["contours"] = layers.contours(done.interval)
        if done.check is not None:
            looks["checkpoints"] = layers.residuals(done.check.scale)
        for name, path in done.layers.items():
            if name in looks:
                compat.load_vector(path, context)
            else:
                compat.load_raster(path, context)
            look = looks.get(name) or layers.raster_looks()[name.upper()]
            self.show(path, layers.first(look) if name == first else look)

    def _make_own(self, request: Request, progress: FeedbackProgress) -> dict[str, object]:
        """Make the outputs that the user chose, and set the looks of their layers."""
        # Imported here, so that QGIS starts faster.
        from ...algorithms.tools.running import run

        _, parameters, context, _ = request
        given = {name: found.value for name, found in self._given.items()}
        chosen = [
            values.with_cells(_USUAL_CELL) if isinstance(values, DeliveryTerrain) else values
            for values in self.chosen(parameters, context)
            if not isinstance(values, (DeliveryChoice, *OF_DELIVERIES))
        ]
        cloud = self.point_cloud_destination(parameters, "OUTPUT", context)
        target, tiles = _written(cloud, self.inputs.is_survey)
        chosen += Written(area_only=given["area"] is not None), tiles
        paths = {
            output.name: self._path(request, output)
            for output in self._outputs
            if output.kind in ("raster", "features")
        }
        drawn = {name.upper(): path for name, path in paths.items() if path}
        given["input"] = self.inputs
        done = run(map_tool("classify"), given, {**paths, "output": target}, chosen, progress)
        written = cloud and str(done.vpc or cloud)
        for line in self._commands(written, drawn, chosen):
            progress.command(line)
        point_count = sum(done.class_counts.values())
        progress.share(done.ground_count, point_count, bool(given["area"]))
        if interval := done.drawn.get("contours"):
            self.show(paths["contours"], layers.contours(interval))
        if paths.get("places"):
            self.show(paths["places"], layers.PLACES)
        results: dict[str, object] = {**drawn}
        if cloud:
            results["OUTPUT"] = written
            do_not_load(context, {cloud} - {written})
            size = MapTerrain.among(chosen).dtm_cell_size
            self._show_cloud(written, done.class_counts, chosen, size, context, progress)
        return {**results, "POINT_COUNT": point_count, "GROUND_COUNT": done.ground_count}

    def _commands(
        self, cloud: str, layers: dict[str, str], chosen: Sequence[ParameterSet]
    ) -> Iterator[str]:
        """Yield the commands for a classified cloud, empty if none is kept, and for its rasters and
        contour lines, by the names of their fields.
        """
        of_type = {type(values): values for values in chosen}
        cloud = cloud or "classified.laz"
        # For many files, the folder of their virtual point cloud.
        target = str(Path(cloud).parent) if cloud.endswith(".vpc") else cloud
        options = dict(self._options_of_inputs())
        finding = [of_type[kind] for kind in (TileMethod, Selection, Resources)]
        words = [*self.source_words(), target, *["--area-only"] * bool(self._given["area"].value)]
        of_points = {name: options.get(name) for name in ("crs", "extent", "boundary")}
        corrections = {"corrections": options.pop("corrections", None)}
        yield command_line("classify", words, finding, {**of_points, **corrections})
        if layers:
            ground = Selection.among(chosen).to_class
            classes = {"ground-classes": "" if ground == GROUND else str(ground)}
            # The command has other defaults.
            model = TerrainModel(**vars(of_type[MapTerrain]))
            drawing = [model, *(of_type[kind] for kind in (SurfaceModel, Contours, Resources))]
            yield command_line("terrain", [cloud], drawing, {**classes, **options, **layers})
