"""The tools that read files and write others, in the toolbox, from their declarations."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from qgis.core import (
    QgsProcessingContext,
    QgsProcessingOutputRasterLayer,
    QgsProcessingParameterDefinition,
    QgsProcessingParameterFileDestination,
    QgsProcessingParameterFolderDestination,
    QgsProcessingParameterRasterDestination,
    QgsProcessingParameterVectorDestination,
)

from ...algorithms.core.parameters import ParameterSet
from ...algorithms.tools import file_tool
from ...algorithms.tools.declaration import Output
from .. import compat
from ..i18n import tr
from ..styles import layers
from .base import BareEarthAlgorithm, command_line
from .feedback import FeedbackProgress
from .inputs import ignored_filter
from .outputs import do_not_load
from .search_words import words_in
from .tool_inputs import Given, Request, add_input, given

# Inputs of these kinds, which name the run, are found first; these are read when the work begins.
_FILES, _LATE = ("cloud", "clouds", "raster"), ("checkpoints",)


class FileToolAlgorithm(BareEarthAlgorithm):
    """A tool that reads files and writes others, given its command."""

    def __init__(self, command: str) -> None:
        super().__init__()
        self._tool = tool = file_tool(command)
        self.identifier, self.page, self.section = tool.identifier, tool.page, tool.section
        self.title, self.summary, self.about = tool.title, tool.summary, tool.about
        self.run_name, self.shown = tool.run_name, tool.shown
        self._inputs = [declared for declared in tool.inputs if declared.label]
        self._outputs = [output for output in tool.outputs if output.label]
        self._given: dict[str, Given] = {}

    def createInstance(self) -> FileToolAlgorithm:
        """Return another instance."""
        return type(self)(self._tool.command)

    def tags(self) -> list[str]:
        """Return the words for the search of the toolbox."""
        return words_in(self._tool.words)

    def parameter_sets(self) -> tuple[type[ParameterSet], ...]:
        """Return the sets of the tool."""
        return self._tool.sets_of_dialog

    def initAlgorithm(self, configuration: dict[str, Any] | None = None) -> None:
        """Declare the fields of the dialog and the results."""
        for declared in self._inputs:
            if not declared.is_last:
                add_input(self, declared)
        self.add_declared()
        for declared in self._inputs:
            if declared.is_last:
                add_input(self, declared)
        for output in self._outputs:
            self.addParameter(_field_of(output), output.field_help)
            for name, label in output.layers.items():
                self.addOutput(QgsProcessingOutputRasterLayer(name.upper(), label))
        self.add_numbers(dict(self._tool.numbers))

    def find_inputs(self, parameters: dict[str, Any], context: QgsProcessingContext) -> None:
        """Find the input files."""
        request = Request(self, parameters, context)
        self._given = {
            declared.name: given(request, declared)
            for declared in self._inputs
            if declared.kind in _FILES
        }
        self.inputs = [found.path for found in self._given.values() if found.path]
        self.subject = next(found.name for found in self._given.values() if found.name)

    def prepare(
        self,
        parameters: dict[str, Any],
        context: QgsProcessingContext,
        progress: FeedbackProgress,
    ) -> None:
        """Find the inputs, and warn of a filter that is ignored."""
        super().prepare(parameters, context, progress)
        request = Request(self, parameters, context, progress)
        for declared in self._inputs:
            if declared.kind not in (*_FILES, *_LATE):
                self._given[declared.name] = given(request, declared)
            if declared.kind in ("cloud", "clouds") and ignored_filter(
                self, parameters, declared.field_name, context
            ):
                progress.warning("The layer's filter is not applied: all points are read.")

    def compute(
        self,
        parameters: dict[str, Any],
        context: QgsProcessingContext,
        progress: FeedbackProgress,
    ) -> dict[str, Any]:
        """Let the tool work, and show what it has written."""
        # Imported here, so that QGIS starts faster.
        from ...algorithms.tools.running import run

        request = Request(self, parameters, context, progress)
        for declared in self._inputs:
            if declared.kind in _LATE:
                self._given[declared.name] = given(request, declared)
        inputs = {name: found.value for name, found in self._given.items()}
        outputs = self._paths(parameters, context, inputs)
        chosen = self.chosen(parameters, context)
        progress.command(self._command(outputs, chosen))
        found = run(self._tool, inputs, outputs, chosen, progress)
        if self._tool.json:
            lines = found.lines() if hasattr(found, "lines") else [found.text]
            progress.info("\n".join(lines))
        results: dict[str, Any] = {}
        for output in self._outputs:
            if outputs[output.name]:
                results[output.field_name] = outputs[output.name]
                results.update(
                    self._shown(output, Path(outputs[output.name]), chosen, found, context)
                )
        results.update((name, getattr(found, name.lower())) for name, _ in self._tool.numbers)
        return {name: value for name, value in results.items() if value is not None}

    def _paths(
        self, parameters: dict[str, Any], context: QgsProcessingContext, inputs: dict[str, Any]
    ) -> dict[str, str]:
        """Return the paths of the outputs, by their names; empty for those that are not wanted."""
        paths = {}
        for output in self._outputs:
            is_layer = output.kind in ("raster", "features")
            path_of = self.parameterAsOutputLayer if is_layer else self.parameterAsFileOutput
            paths[output.name] = path_of(parameters, output.field_name, context)
            if output.needs and inputs[output.needs] is None:
                do_not_load(context, [paths[output.name]])
                paths[output.name] = ""
        return paths

    def _command(self, paths: dict[str, str], chosen: list[ParameterSet]) -> str:
        """Return the command line that does the same without QGIS."""
        words = [found.argument for found in self._given.values() if found.argument]
        words += [paths[output.name] for output in self._outputs if output.is_main]
        options: dict[str, Any] = {}
        for declared in self._inputs:
            options.update(self._given[declared.name].options)
        options.update(
            (output.option, paths[output.name]) for output in self._outputs if not output.is_main
        )
        # The command can have other defaults.
        sets = [
            of_command(**vars(values))
            for of_command in self._tool.sets
            for values in chosen
            if isinstance(values, of_command)
        ]
        return command_line(self._tool.command, words, sets, options)

    def _shown(
        self,
        output: Output,
        path: Path,
        chosen: list[ParameterSet],
        found: Any,
        context: QgsProcessingContext,
    ) -> dict[str, str]:
        """Give looks to the files of an output; return those that are outputs of models."""
        if output.look:
            self.show(str(path), layers.look_of(output.look, found))
        if output.files is None:
            return {}
        files = {name: str(file) for name, file in output.files(path, chosen).items()}
        for name, file in files.items():
            compat.load_raster(file, context)
            self.show(file, layers.look_of(name))
        return {name.upper(): file for name, file in files.items() if name in output.layers}


def _field_of(output: Output) -> QgsProcessingParameterDefinition:
    """Return the field of an output."""
    name, label = output.field_name, output.label
    optional, by_default = output.optional and not output.is_main, output.by_default
    if output.kind == "raster":
        return QgsProcessingParameterRasterDestination(name, label, None, optional, by_default)
    if output.kind == "folder":
        return QgsProcessingParameterFolderDestination(name, label, None, optional, by_default)
    if output.kind == "features":
        return QgsProcessingParameterVectorDestination(
            name, label, optional=optional, createByDefault=by_default
        )
    filters = tr("HTML files (*.html)")
    return QgsProcessingParameterFileDestination(name, label, filters, None, optional, by_default)
