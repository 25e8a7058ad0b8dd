"""The tools in the toolbox, from their declarations."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from qgis.core import (
    QgsProcessingContext,
    QgsProcessingOutputHtml,
    QgsProcessingOutputNumber,
    QgsProcessingOutputRasterLayer,
    QgsProcessingOutputString,
    QgsProcessingParameterDefinition,
    QgsProcessingParameterFileDestination,
    QgsProcessingParameterFolderDestination,
    QgsProcessingParameterRasterDestination,
    QgsProcessingParameterVectorDestination,
)

from ...algorithms.classes.ground_classes import GroundClasses
from ...algorithms.classes.kept_classes import GROUND
from ...algorithms.core.files import split_name
from ...algorithms.core.parameters import ParameterSet
from ...algorithms.engine.memory import Resources
from ...algorithms.engine.summary import RunSummary, SurveySummary, TileSummary
from ...algorithms.survey.files import Inputs
from ...algorithms.tools import file_tool, point_tool
from ...algorithms.tools.declaration import FileTool, Output, PointTool, Tool, with_note
from ...algorithms.tools.heights import HEIGHT_DIMENSION
from ...algorithms.tools.listing import FILE_TOOLS, POINT_TOOLS
from .. import compat
from ..i18n import mark, tr
from ..styles import layers
from ..styles.loaded import in_main_thread
from .area import has_area
from .base import BareEarthAlgorithm, Options, command_line
from .classified import show_class_raster
from .feedback import FeedbackProgress, Refusal
from .inputs import ignored_filter
from .one_run import refuse_two_runs
from .outputs import after_cancel, cannot_show, do_not_load, is_blank, point_cloud_formats
from .remote import LIMIT, add_remote
from .tool_inputs import GivenInput, Request, add_input, given, part_of

# Inputs of these kinds, which name the run, are read first; `_LATE` ones when the work begins.
_CLOUDS = ("cloud", "clouds", "files", "survey")
_FILES = (*_CLOUDS, "raster", "terrain", "address")
_LATE = ("checkpoints", "polygons")
# Inputs of these kinds say which part of remote points is needed.
_PARTS = ("area", "extent")
# Outputs of these kinds are files of points.
_POINTS = ("cloud", "points")
# Advice in the error for a download over the limit.
_ADVICE = "Choose a smaller extent"
_MANY = mark(
    "{} lists {} point clouds that have points there, and this algorithm reads one. Choose 'Point"
    " cloud to terrain', or download them first."
)
# Titles of the layers of classes, by what a tool for points shows.
_TITLES = {"classes": layers.CLASSES, "key points": mark("key points")}
# Functions that combine the numbers of many files; all others are added up.
_TOGETHER = {"MINIMUM": min, "MAXIMUM": max}


class ToolAlgorithm(BareEarthAlgorithm):
    """Base of the algorithms that are made from the declarations of tools."""

    def __init__(self, tool: Tool) -> None:
        super().__init__()
        self._tool = tool
        self.identifier, self.page, self.section = tool.identifier, tool.page, tool.section
        self.title, self.line, self.about = tool.title, tool.line, tool.help
        self.run_name, self.shown, self.words = tool.run_name, tool.shown, tool.words
        self._inputs = [declared for declared in tool.all_inputs if declared.label]
        self._outputs = [output for output in tool.all_outputs if output.label]
        self._given: dict[str, GivenInput] = {}

    @property
    def command(self) -> str:
        """The name of its command."""
        return self._tool.command

    def createInstance(self) -> ToolAlgorithm:
        """Return another instance."""
        return type(self)(self._tool)

    def parameter_sets(self) -> tuple[type[ParameterSet], ...]:
        """Return the sets of the tool."""
        return self._tool.sets_of_dialog

    def work(
        self,
        inputs: dict[str, object],
        outputs: dict[str, str],
        chosen: list[ParameterSet],
        context: QgsProcessingContext,
        progress: FeedbackProgress,
    ) -> dict[str, object]:
        """Run the tool, show its outputs, and return the results."""
        raise NotImplementedError

    def initAlgorithm(self, configuration: dict[str, object] | None = None) -> None:
        """Declare the fields of the dialog and the results."""
        for declared in self._inputs:
            if not declared.is_last:
                add_input(self, declared)
        self.add_declared()
        for declared in self._inputs:
            if declared.is_last:
                add_input(self, declared)
        kinds = {
            declared.kind
            for declared in self._inputs
            if not (declared.optional and declared.kind == "cloud")
        }
        if kinds.intersection(_CLOUDS):
            add_remote(self, has_area=not kinds.isdisjoint(_PARTS))
        for output in self._outputs:
            field = _field_of(output)
            if output.advanced:  # QGIS shows it below the other outputs: it folds only inputs away
                field.setFlags(field.flags() | compat.ADVANCED)
            note = "The Results Viewer opens it." if output.kind == "page" else ""
            self.addParameter(field, with_note(output.help, note))
            for name, label in output.layers.items():
                self.addOutput(QgsProcessingOutputRasterLayer(name.upper(), label))
            if output.page:
                self.addOutput(QgsProcessingOutputHtml("PAGE", output.page))
        for name, label in self._tool.numbers:
            self.addOutput(QgsProcessingOutputNumber(name, label))
        for name, label in self._tool.texts:
            self.addOutput(QgsProcessingOutputString(name, label))

    def find_inputs(self, parameters: dict[str, object], context: QgsProcessingContext) -> None:
        """Find the input files."""
        request = Request(self, parameters, context)
        self._given = {
            declared.name: given(request, declared)
            for declared in self._inputs
            if declared.kind in _FILES
        }
        remotes = [remote for found in self._given.values() for remote in found.remotes]
        kind = next(declared.kind for declared in self._inputs if declared.kind in _FILES)
        self.is_elsewhere = kind == "address" or bool(remotes)
        self.layer_crs = next((remote.crs for remote in remotes if remote.crs), None)
        if remotes and kind != "address" and not has_area(parameters):
            raise Refusal(
                mark("{} is not on this computer: give the extent to download."), remotes[0].name
            )
        made = [str(self._given[one.name].value or "") for one in self._inputs if one.made_as]
        if made and context.project() is not None and in_main_thread():
            refuse_two_runs(made, context.project())
        self.set_inputs()
        self.subject = next(found.name for found in self._given.values() if found.name)

    def set_inputs(self, is_list: bool = False) -> None:
        """Set the input files that are on this computer; a list of files is a survey."""
        paths = [path for found in self._given.values() for path in found.paths]
        kind = next(declared.kind for declared in self._inputs if declared.kind in _FILES)
        is_survey = {"cloud": False, "address": False, "files": True}.get(kind, is_list or None)
        self.inputs = Inputs(paths, is_survey)

    def prepare(
        self,
        parameters: dict[str, object],
        context: QgsProcessingContext,
        progress: FeedbackProgress,
    ) -> None:
        """Find the inputs, and warn of a filter that is ignored."""
        super().prepare(parameters, context, progress)
        for declared in self._inputs:
            is_read = declared.kind in ("cloud", "clouds") and not declared.optional
            if is_read and ignored_filter(self, parameters, declared.field_name, context):
                progress.warning("The layer's filter is not applied: all points are read.")
        # The CRS of remote points is not known before the download.
        if not any(map(self._is_far, self._given)):
            self._find_rest(Request(self, parameters, context, progress))

    def _is_far(self, name: str) -> bool:
        """Return whether the points of an input have to be downloaded first."""
        kind = next(declared.kind for declared in self._inputs if declared.name == name)
        return kind != "address" and bool(self._given[name].remotes)

    def _find_rest(self, request: Request) -> None:
        """Read the inputs that are not files."""
        for declared in self._inputs:
            if declared.kind not in (*_FILES, *_LATE):
                self._given[declared.name] = given(request, declared)

    def bring(
        self,
        parameters: dict[str, object],
        context: QgsProcessingContext,
        progress: FeedbackProgress,
    ) -> None:
        """Download the needed part of remote points, and read the inputs that are not files."""
        self.brought.clear()
        far = {name: found for name, found in self._given.items() if self._is_far(name)}
        request = Request(self, parameters, context, progress)
        area = part_of(request)[0] if far else None
        if area is None:
            return
        # Imported here, so that QGIS starts faster.
        from ...algorithms.library.remote_points import SHARE, margin_of, stated_crs
        from ...algorithms.remote.cache import AreaAround, cache_of, download_all
        from ...algorithms.remote.fetching import Wanted

        # Without a field for an area, the downloaded part is all that is used.
        is_of_area, margin = any(declared.kind in _PARTS for declared in self._inputs), 0.0
        if is_of_area:
            rasters = (output.field_name for output in self._outputs if output.kind == "raster")
            is_alone = getattr(self._tool, "classifies", False) and all(
                compat.is_empty(parameters.get(name)) for name in rasters
            )
            if self._tool.looks_around:
                margin = margin_of(self.chosen(parameters, context), is_alone)
        crs, limit = stated_crs(self.stated), self.parameterAsDouble(parameters, LIMIT, context)
        part = AreaAround(area.box, area.polygons, margin, crs)
        is_measured = self._tool.looks_around
        wanted = Wanted(part, most=limit * 1e9, crs=crs, is_measured=is_measured)
        sources: dict[str, list[str | Path]] = {
            name: [*(remote.address for remote in found.remotes), *found.paths]
            for name, found in far.items()
        }
        place = cache_of(None), _ADVICE, progress.before(SHARE)
        here, found_at = download_all(sources, wanted, *place)
        self.brought.update(found_at)
        for name, paths in here.items():
            is_one = next(one.kind == "cloud" for one in self._inputs if one.name == name)
            if is_one and len(paths) > 1:
                raise Refusal(_MANY, far[name].name, len(paths))
            value = paths[0] if is_one else paths
            self._given[name] = far[name]._replace(value=value, paths=tuple(paths))
        self.is_elsewhere = False
        self.set_inputs(any(paths.is_survey for paths in here.values()))
        self._find_rest(request)

    def compute(
        self,
        parameters: dict[str, object],
        context: QgsProcessingContext,
        progress: FeedbackProgress,
    ) -> dict[str, object]:
        """Read the other inputs, write the command into the log, and run the tool."""
        request = Request(self, parameters, context, progress)
        self._find_late(request)
        inputs = {name: found.value for name, found in self._given.items()}
        outputs = {output.name: self._path(request, output) for output in self._outputs}
        chosen = self.chosen(parameters, context)
        progress.command(self._command(outputs, chosen))
        return self.work(inputs, outputs, chosen, context, progress)

    def _find_late(self, request: Request) -> None:
        """Read the inputs that can take long."""
        for declared in self._inputs:
            if declared.kind in _LATE:
                self._given[declared.name] = given(request, declared)

    def _path(self, request: Request, output: Output) -> str:
        """Return the path of an output; empty if the user leaves it out."""
        name, context = output.field_name, request.context
        if output.kind in _POINTS:
            return self._cloud(request, name)
        # QGIS would make a layer of an empty path, and say after the run that it is not there.
        if is_blank(request.parameters, name, context):
            return ""
        is_layer = output.kind in ("raster", "features")
        path_of = self.parameterAsOutputLayer if is_layer else self.parameterAsFileOutput
        path: str = path_of(request.parameters, name, context)
        if output.needs and self._given[output.needs].value is None:
            do_not_load(context, [path])
            return ""
        return path

    def _cloud(self, request: Request, name: str) -> str:
        """Return the path of a point cloud, for many files a folder of this name without its
        ending; tell the user if QGIS cannot show it.
        """
        _, parameters, context, progress = request
        path = self.point_cloud_destination(parameters, name, context)
        if self.inputs.is_survey:
            do_not_load(context, [path])
            return str(Path(path).with_name(split_name(Path(path))[0]))
        if not compat.can_load(path):
            progress.info(cannot_show(path, "will be"))
        return path

    def _command(self, paths: dict[str, str], chosen: list[ParameterSet]) -> str:
        """Return the command line that does the same without QGIS."""
        # The command can have other defaults.
        sets = [
            of_command(**vars(values))
            for of_command in self._tool.sets
            for values in chosen
            if isinstance(values, of_command)
        ]
        return command_line(self._tool.command, self._words(paths), sets, self._options(paths))

    def _words(self, paths: dict[str, str]) -> list[str]:
        """Return the arguments of the command without a flag."""
        return self.source_words() + [
            paths[output.name] for output in self._outputs if output.is_main
        ]

    def source_words(self) -> list[str]:
        """Return the arguments of the command for files."""
        return [word for found in self._given.values() for word in found.arguments]

    def _options(self, paths: dict[str, str]) -> Options:
        """Return the options of the command for inputs and outputs."""
        own = {output.option: paths[output.name] for output in self._outputs if not output.is_main}
        return {**self._options_of_inputs(), **own}

    def _options_of_inputs(self) -> Options:
        """Return the options of the command for inputs."""
        options: dict[str, str | tuple[str, ...] | None] = {}
        for declared in self._inputs:
            # Several inputs have an option for the CRS, which one of them gives.
            found = self._given[declared.name].options if declared.name in self._given else {}
            options.update((option, value) for option, value in found.items() if value)
        return options


class FileToolAlgorithm(ToolAlgorithm):
    """A tool that reads files and writes others."""

    _tool: FileTool

    def work(
        self,
        inputs: dict[str, object],
        outputs: dict[str, str],
        chosen: list[ParameterSet],
        context: QgsProcessingContext,
        progress: FeedbackProgress,
    ) -> dict[str, object]:
        """Run the tool, show its outputs, and return the results."""
        # Imported here, so that QGIS starts faster.
        from ...algorithms.tools.running import run

        found = run(self._tool, inputs, outputs, chosen, progress)
        if self._tool.json is not None:
            lines = found.lines() if hasattr(found, "lines") else [found.text]
            progress.info("\n".join(lines))
        results: dict[str, object] = {}
        for output in self._outputs:
            if path := outputs[output.name]:
                results[output.field_name] = path
                results.update(self._shown(output, Path(path), chosen, found, context))
        told = (*self._tool.numbers, *self._tool.texts)
        results.update((name, getattr(found, name.lower())) for name, _ in told)
        # Figures that could not be measured are None, or NaN, which differs from itself, and a
        # verdict that is not given is empty.
        return {
            name: int(value) if isinstance(value, bool) else value
            for name, value in results.items()
            if value is not None and value == value and value != ""
        }

    def _shown(
        self,
        output: Output,
        path: Path,
        chosen: list[ParameterSet],
        found: Any,
        context: QgsProcessingContext,
    ) -> dict[str, str]:
        """Give looks to the files of an output; return the ones that are outputs of models."""
        if output.look:
            self.show(str(path), layers.look_of(output.look, found))
        if output.files is None:
            return {}
        files = {name: str(file) for name, file in output.files(path, chosen).items()}
        for name, file in files.items():
            compat.load_raster(file, context)
            self.show(file, layers.look_of(name))
        return {name.upper(): file for name, file in files.items() if name in output.layers}


class PointToolAlgorithm(ToolAlgorithm):
    """A tool that writes classified files anew."""

    _tool: PointTool

    def parameter_sets(self) -> tuple[type[ParameterSet], ...]:
        """Return the sets of the tool, and resources."""
        return (*self._tool.sets_of_dialog, Resources)

    def set_inputs(self, is_list: bool = False) -> None:
        """Set the input files, and what stays of their outputs after a cancel."""
        super().set_inputs(is_list)
        self.cancelled = after_cancel(self.inputs)

    def work(
        self,
        inputs: dict[str, object],
        outputs: dict[str, str],
        chosen: list[ParameterSet],
        context: QgsProcessingContext,
        progress: FeedbackProgress,
    ) -> dict[str, object]:
        """Find the values of the points, write them, and show the points."""
        from ...algorithms.tools.running import run

        output, ground = outputs["output"], GroundClasses.among(chosen)
        given = {**inputs, "input": self.inputs, "crs": self.stated}
        for declared in self._tool.inputs:
            if declared.kind == "raster" and inputs.get(declared.name) is not None:
                given[declared.name] = declared.of(inputs[declared.name], progress.part(0.0, 0.0))
        found = run(self._tool, given, {"output": output}, chosen, progress)
        progress.info(found.text)
        if found.vpc:
            output = found.vpc
            if compat.can_load(output):
                compat.load_point_cloud(output, context)
            else:
                progress.info(cannot_show(output))
        numbers = _numbers_of(found, [name for name, _ in self._tool.numbers])
        self.class_counts = found.class_counts
        self.show(output, self._look(chosen, found, numbers))
        if not compat.can_load(output):
            first = (*ground.ground_classes, GROUND)[0]
            show_class_raster(self, output, self.class_counts, first, context, progress)
        return {"OUTPUT": output, **numbers}

    def _look(
        self,
        chosen: list[ParameterSet],
        found: TileSummary | SurveySummary,
        numbers: dict[str, float],
    ) -> layers.LayerLook:
        """Return the look of the written points."""
        if self._tool.shows != "heights":
            return layers.classes(found.class_counts, _TITLES[self._tool.shows])
        is_z = any(getattr(values, "output_as", "") == "z" for values in chosen)
        unit = found.tiles[0].unit_size
        return layers.heights("Z" if is_z else HEIGHT_DIMENSION, numbers["MAXIMUM"], unit)


def _numbers_of(found: RunSummary, names: list[str]) -> dict[str, float]:
    """Return the outputs that are numbers, from a summary of one file or of many."""
    return {
        name: _TOGETHER.get(name, sum)(getattr(file, name.lower()) for file in found.tiles)
        for name in names
    }


def tool_algorithms() -> list[ToolAlgorithm]:
    """Return the tools that have a dialog."""
    points = [PointToolAlgorithm(point_tool(command)) for command in POINT_TOOLS]
    files = [FileToolAlgorithm(file_tool(command)) for command in FILE_TOOLS]
    return [algorithm for algorithm in (*points, *files) if algorithm.identifier]


def _field_of(output: Output) -> QgsProcessingParameterDefinition:
    """Return the field of an output."""
    name, label = output.field_name, output.label
    optional, by_default = output.optional and not output.is_main, output.by_default
    if output.kind in _POINTS:
        field = compat.point_cloud_output(name, label, point_cloud_formats())
        field.setFlags(field.flags() | compat.OPTIONAL if optional else field.flags())
        return field
    if output.kind == "raster":
        return QgsProcessingParameterRasterDestination(name, label, None, optional, by_default)
    if output.kind == "folder":
        return QgsProcessingParameterFolderDestination(name, label, None, optional, by_default)
    if output.kind == "features":
        return QgsProcessingParameterVectorDestination(
            name, label, optional=optional, createByDefault=by_default
        )
    filters = tr("HTML files (*.html)")
    if output.kind == "list":
        filters = tr("{} files (*.{})").format("VPC", "vpc")
    return QgsProcessingParameterFileDestination(name, label, filters, None, optional, by_default)
