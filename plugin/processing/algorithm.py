"""The algorithms of the toolbox, from the declarations of tools."""

from __future__ import annotations

import contextlib
import time
from html import escape
from pathlib import Path
from typing import Iterable, Iterator

from qgis.core import (
    QgsCoordinateReferenceSystem,
    QgsProcessingAlgorithm,
    QgsProcessingContext,
    QgsProcessingException,
    QgsProcessingFeedback,
    QgsProcessingOutputDefinition,
    QgsProcessingOutputHtml,
    QgsProcessingOutputNumber,
    QgsProcessingOutputRasterLayer,
    QgsProcessingOutputString,
    QgsProcessingParameterDefinition,
)
from qgis.PyQt.QtGui import QIcon

from ...algorithms.core.errors import BareEarthError, Cancelled
from ...algorithms.core.parameters import Declaration, ParameterSet
from ...algorithms.core.words import in_words
from ...algorithms.las.backends import install_hint, missing_packages
from ...algorithms.remote.cache import addresses_named
from ...algorithms.tools import file_tool, map_tool, point_tool
from ...algorithms.tools.declaration import Composition, MapTool, Tool, with_note
from ...algorithms.tools.ground.dialogs import METHOD_TOOLS
from ...algorithms.tools.ground.output import PointOutput
from ...algorithms.tools.listing import FILE_TOOLS, POINT_TOOLS
from .. import compat
from ..help_pages import address_of
from ..i18n import tr
from ..styles import layers
from ..styles.loaded import later
from ..styles.metadata import Origin, settings_of
from ..styles.stage import LayerStage
from .feedback import FeedbackProgress, Refusal, tell_error_once, tell_of_unknown
from .fields import field_of, parameters_of
from .inputs import remember_origin
from .outputs import check_outputs, do_not_load, field_of_output, places_of, with_outputs_of_step
from .presets import presets_of
from .remote import add_remote
from .request import Request, Resolved
from .resolving import PARTS, download, resolve, resolve_files, resolve_rest
from .runs import PastRun, is_remembered, plain_values, remember
from .shapes import has_area
from .showing import Results, ToolRun
from .tool_inputs import KINDS

_ICONS = Path(__file__).parents[1] / "icons"
# Inputs of these kinds can be remote.
_CLOUDS = ("cloud", "clouds", "files", "survey")


class ToolAlgorithm(QgsProcessingAlgorithm):
    """The algorithm of a tool."""

    def __init__(self, tool: Tool) -> None:
        super().__init__()
        self.tool, self.about, self.page = tool, tool.help, tool.page
        self.inputs, self.outputs = list(tool.all_inputs), list(tool.all_outputs)
        if isinstance(tool, (MapTool, Composition)):
            self.outputs = list(tool.dialog_outputs())
        else:
            self.inputs = [one for one in self.inputs if one.label]
            self.outputs = [one for one in self.outputs if one.label]
        self._has_page = False
        # Of the pages: in the list of results each has the name of the input before its label.
        self._page_labels: dict[str, str] = {}

    @property
    def command(self) -> str:
        """The name of its command."""
        return self.tool.command

    def parameter_sets(self) -> tuple[type[ParameterSet], ...]:
        """Return the declared parameters, in the order of the dialog."""
        return self.tool.sets_of_dialog

    def sets_of(self, request: Request) -> list[ParameterSet]:
        """Return the declared parameters with the user's values."""
        return [parameters_of(request, declared) for declared in self.parameter_sets()]

    def run_name(self, resolved: Resolved) -> str:
        """Return the name of the group of layers, after that of the input."""
        return self.tool.run_name or self.tool.title

    def check(self, request: Request) -> Resolved:
        """Check the values before a run; raise BareEarthError to refuse them."""
        sets = self.sets_of(request)
        PointOutput.among(sets).check_area(has_area(request))
        found = resolve_files(request, self.inputs, sets)
        check_outputs(request, found.points)
        return found

    def makes_page(self, request: Request, resolved: Resolved) -> bool:
        """Return whether a run with these values makes a page."""
        return not all(map(request.is_empty, self._page_names()))

    def _page_names(self) -> list[str]:
        return [one.name() for one in self.outputDefinitions() if one.type() == "outputHtml"]

    def work(self, run: ToolRun) -> Results:
        """Do the work, in any thread, and return the outputs."""
        return run.work()

    def no_choice(self, declaration: Declaration) -> str:
        """Return the label of no value, of a parameter that is empty at first."""
        return ""

    def addParameter(self, field: QgsProcessingParameterDefinition, help: str = "") -> bool:
        """Add a field to the dialog, with its label in the user's language."""
        field.setDescription(tr(field.description()))
        field.setHelp(in_words(help or field.help()))
        return super().addParameter(field)

    def addOutput(self, output: QgsProcessingOutputDefinition) -> bool:
        output.setDescription(tr(output.description()))
        return super().addOutput(output)

    def initAlgorithm(self, configuration: dict[str, object] | None = None) -> None:
        self._add_inputs(is_last=False)
        unused = ("relief_radius",) if isinstance(self.tool, MapTool) else ()
        for one in (one for declared in self.parameter_sets() for one in declared.declarations()):
            shown = not one.advanced if self.tool.shown is None else one.name in self.tool.shown
            if one.name not in unused:
                super().addParameter(field_of(one, shown, self.no_choice(one)))  # it is translated
        self._add_inputs(is_last=True)
        kinds = {one.kind for one in self.inputs if not (one.optional and one.kind == "cloud")}
        if kinds.intersection(_CLOUDS):
            add_remote(self, has_area=not kinds.isdisjoint(PARTS))
        for output in self.outputs:
            note = "The Results Viewer opens it." if output.kind == "page" else ""
            self.addParameter(field_of_output(output), with_note(output.help, note))
            for name, label in output.layers.items():
                self.addOutput(QgsProcessingOutputRasterLayer(name.upper(), label))
            if output.page:
                self.addOutput(QgsProcessingOutputHtml("PAGE", output.page))
        for name, label in self.tool.numbers:
            self.addOutput(QgsProcessingOutputNumber(name, label))
        for name, label in self.tool.texts:
            self.addOutput(QgsProcessingOutputString(name, label))

    def _add_inputs(self, is_last: bool) -> None:
        for declared in self.inputs:
            if declared.is_last == is_last:
                for field, help in KINDS[declared.kind].fields(declared):
                    self.addParameter(field, help)

    # QGIS calls the following methods.

    def createInstance(self) -> ToolAlgorithm:
        return type(self)(self.tool)

    def name(self) -> str:
        """Return the second half of the id, which never changes."""
        return self.tool.identifier

    def displayName(self) -> str:
        return tr(self.tool.title)

    def group(self) -> str:
        return tr(self.tool.section)

    def groupId(self) -> str:
        return self.tool.section.lower().replace(" ", "")

    def shortDescription(self) -> str:
        return tr(self.tool.line)

    def tags(self) -> list[str]:
        return words_in(self.tool.words)

    def helpUrl(self) -> str:
        return address_of(self.page)

    def shortHelpString(self) -> str:
        """Return the help: what the algorithm does, and a paragraph for each parameter."""
        # In the order of the dialog: advanced parameters after the others, and outputs last.
        ordered = sorted(
            self.parameterDefinitions(),
            key=lambda field: (field.isDestination(), bool(field.flags() & compat.ADVANCED)),
        )
        paragraphs = [in_words(self.about)]
        for field in ordered:
            # Quotes stay, since `qgis_process help` shows the source.
            label, help = (
                escape(text, quote=False) for text in (field.description(), field.help())
            )
            paragraphs.append(f"<b>{label}</b>: {help}")
            if field.name() == "PRESET":
                paragraphs.append(presets_of(self.parameter_sets()))
        return "\n".join(paragraphs)

    def icon(self) -> QIcon:
        return QIcon(self.svgIconPath())

    def svgIconPath(self) -> str:
        return str(_ICONS / f"{self.name()}.svg")

    def hasHtmlOutputs(self) -> bool:
        """Return whether the run that was checked last makes a page."""
        # QGIS 3.22 asks after a run, and then tells the user to look at the pages that were made.
        return self._has_page

    def canExecute(self) -> tuple[bool, str]:
        """Return whether all needed packages are installed, and if not, how to install them."""
        if missing_packages(["scipy"]):
            return False, tr(
                "This QGIS has no scipy. On Windows, install python3-scipy with the OSGeo4W setup."
                " Elsewhere, install the scipy of the system, or a newer QGIS."
            )
        # lazrs is needed only for .laz, and these give a message of their own.
        if missing_packages(["laspy"]):
            missing = missing_packages(["laspy", "lazrs"])
            # In English as the hint is: a message in two languages is hard to read.
            return False, f"{', '.join(missing)} must be installed first. {install_hint(missing)}"
        return True, ""

    def checkParameterValues(
        self, parameters: dict[str, object], context: QgsProcessingContext
    ) -> tuple[bool, str]:
        """Check values with the messages of the declarations first, then as QGIS does."""
        request = Request(self, parameters, context)
        try:
            found = self.check(request)
        except Refusal as refusal:
            return False, refusal.translated
        except BareEarthError as error:
            return False, str(error)
        self._has_page = self.makes_page(request, found)
        for name in self._page_names() if found.subject else ():
            output = self.outputDefinition(name)
            label = self._page_labels.setdefault(name, output.description())
            output.setDescription(f"{found.subject}: {label}")
        return super().checkParameterValues(parameters, context)

    def prepareAlgorithm(
        self,
        parameters: dict[str, object],
        context: QgsProcessingContext,
        feedback: QgsProcessingFeedback,
    ) -> bool:
        """Resolve what is given, in the main thread, and find the place of the layers."""
        tell_error_once(False)
        tell_of_unknown(self, parameters, feedback)
        request = Request(self, parameters, context, FeedbackProgress(feedback))
        with errors_for_qgis():
            self._resolved = found = resolve(request, self.inputs, self.sets_of(request))
            group = ": ".join(filter(None, (found.subject, tr(self.run_name(found)))))
            self._stage = LayerStage(context, group, places_of(request))
        self._settings = settings_of(self, parameters, context)
        self._values = plain_values(self, parameters)
        return True

    def processAlgorithm(
        self,
        parameters: dict[str, object],
        context: QgsProcessingContext,
        feedback: QgsProcessingFeedback,
    ) -> dict[str, object]:
        """Download and run; if it is cancelled or fails, QGIS loads no output."""
        progress = FeedbackProgress(feedback)
        request = with_outputs_of_step(Request(self, parameters, context, progress), feedback)
        run = ToolRun(self.tool, self.outputs, request, self._resolved)
        before = set(context.layersToLoadOnCompletion())
        results: Results = {}
        has_failed = True
        try:
            with errors_for_qgis():
                run.resolved = download(request, run.resolved, self.tool)
                with addresses_named(run.resolved.brought):
                    run.resolved = resolve_rest(request, run.resolved)
                    results = self.work(run)
            has_failed = False
        except Cancelled:
            has_failed = False
            feedback.pushInfo(
                "Cancelled. The finished tiles stay, and a later run can continue with them."
                if run.stays
                else "Cancelled; nothing was written."
            )
        finally:
            loaded = set(context.layersToLoadOnCompletion()) - before
            # Of a file without points, no rasters are made.
            do_not_load(context, {path for path in loaded if not (results and _exists(path))})
            progress.end(run.class_counts if results else {}, has_failed)
            self._arrange(run, results)
        return results

    def _arrange(self, run: ToolRun, results: Results) -> None:
        """Set names, styles and places of the layers, and reload those of an earlier run."""
        looks: dict[str, layers.LayerLook] = {}
        labels, known = {}, layers.raster_looks()
        for name in filter(self.parameterDefinition, results):
            path = str(results[name])
            labels[path] = self.parameterDefinition(name).description()
            if name in known:
                looks[path] = known[name]
        looks.update(run.looks)
        if run.resolved.stated:
            crs = QgsCoordinateReferenceSystem(run.resolved.stated)
            looks = {path: layers.in_crs(look, crs) for path, look in looks.items()}
        subject = run.resolved.subject or tr(self.tool.title)
        for path in labels:
            remember_origin(path, subject)
        origin = Origin.of(self.displayName(), self._settings, tuple(run.progress.commands))
        layers.arrange(run.context, looks, labels, subject, self._stage, origin)
        if results and is_remembered(self):
            project = run.context.project()
            past = PastRun(self.id(), self._values, results, time.time())
            later(lambda: remember(project, past))


def words_in(groups: Iterable[str]) -> list[str]:
    """Return the words of groups, separated by commas, in English and the user's language."""
    words = (word for group in groups for text in (group, tr(group)) for word in text.split(","))
    return list(dict.fromkeys(words))


def _exists(source: str) -> bool:
    """Return whether the file of a layer exists; a GeoPackage can name a layer behind a bar."""
    # A file's own name may have the sign that separates it from a layer in it.
    return Path(source).exists() or Path(source.rpartition("|")[0] or source).exists()


@contextlib.contextmanager
def errors_for_qgis() -> Iterator[None]:
    """Turn errors into exceptions that QGIS shows without a traceback, and only once."""
    try:
        yield
    except (BareEarthError, MemoryError) as error:
        text = "There is not enough memory for this file."
        tell_error_once(True)
        raise QgsProcessingException(
            text if isinstance(error, MemoryError) else str(error)
        ) from error


def tool_algorithms() -> list[ToolAlgorithm]:
    """Return the algorithms of all tools with a dialog, except compositions."""
    tools: list[Tool] = [*METHOD_TOOLS, map_tool("classify-tiles"), map_tool("terrain")]
    tools += [*map(point_tool, POINT_TOOLS), *map(file_tool, FILE_TOOLS)]
    return [ToolAlgorithm(tool) for tool in tools if tool.identifier]
