"""Base class of all Processing algorithms of the plugin."""

from __future__ import annotations

import contextlib
import time
from html import escape
from pathlib import Path
from typing import Collection, Iterable, Iterator, Mapping, Union

from qgis.core import (
    QgsProcessingAlgorithm,
    QgsProcessingContext,
    QgsProcessingException,
    QgsProcessingFeedback,
    QgsProcessingOutputDefinition,
    QgsProcessingParameterDefinition,
)
from qgis.PyQt.QtGui import QIcon

from ...algorithms.core.commands import shell_line
from ...algorithms.core.errors import BareEarthError, Cancelled
from ...algorithms.core.parameters import Declaration, ParameterSet, shown_value
from ...algorithms.core.words import in_words
from ...algorithms.las.backends import install_hint, missing_packages
from ...algorithms.remote.cache import addresses_named
from ...algorithms.survey.files import Inputs
from .. import compat
from ..help_pages import address_of
from ..i18n import mark, tr
from ..styles import layers
from ..styles.loaded import later
from ..styles.metadata import Origin, settings_of
from ..styles.stage import LayerStage
from .area import check_area_only
from .feedback import FeedbackProgress, Refusal, tell_error_once, tell_of_unknown
from .fields import field_of, parameters_of
from .inputs import CloudCrs, remember_origin
from .output_checks import check_outputs
from .outputs import NOTHING_STAYS, do_not_load, is_blank, places_of, with_outputs_of_step
from .presets import presets_of
from .runs import PastRun, is_remembered, plain_values, remember
from .stated_crs import crs_of_text, stated_crs_of

_ICONS = Path(__file__).parents[1] / "icons"
# Values of options of the command line, by their names without dashes; empty values are left out.
Options = Mapping[str, Union[str, tuple[str, ...], None]]


class BareEarthAlgorithm(QgsProcessingAlgorithm):
    """Base class of the algorithms, whose subclasses set texts, declare fields and compute."""

    # identifier: second half of the id, which never changes; title, section, line: name and
    # group in the toolbox, and the tooltip; about: first paragraphs of the help; page: in the
    # folder docs; run_name: name of the group of layers after that of the input, the title if
    # empty; subject: name of the input, set by `find_inputs`; class_counts: points of each class in
    # the output for the end of the log, set by `compute`.

    identifier = title = section = line = about = page = run_name = subject = ""
    words: tuple[str, ...] = ()  # for the search of the toolbox, separated by commas
    cancelled = NOTHING_STAYS  # message in the log after a cancel
    shown: tuple[str, ...] | None = None  # parameters that are not advanced; None: as declared
    stated: str | None = None  # the CRS that the user states; set before `prepare`
    layer_crs: str | None = None  # of a remote layer; set by `find_inputs`
    is_elsewhere = False  # whether the points are remote, and not here yet
    unused: tuple[str, ...] = ()  # parameters without a field, since no output depends on them
    inputs = Inputs(())  # files and folders; set by `find_inputs`
    _has_page = False

    def __init__(self) -> None:
        super().__init__()
        # Of the pages: in the list of results each has the name of the input before its label.
        self._page_labels: dict[str, str] = {}
        self.brought: dict[Path, str] = {}  # files of the cache, and their addresses

    def parameter_sets(self) -> tuple[type[ParameterSet], ...]:
        """Return the declared parameters, in the order of the dialog."""
        return ()

    def bring(
        self,
        parameters: dict[str, object],
        context: QgsProcessingContext,
        progress: FeedbackProgress,
    ) -> None:
        """Download remote inputs, and set `brought`; runs in any thread, before `compute`."""

    def compute(
        self,
        parameters: dict[str, object],
        context: QgsProcessingContext,
        progress: FeedbackProgress,
    ) -> dict[str, object]:
        """Do the work, in any thread, and return the outputs."""
        raise NotImplementedError

    def find_inputs(self, parameters: dict[str, object], context: QgsProcessingContext) -> None:
        """Find the input files, which must exist, and set `inputs` and `subject`."""

    def prepare(
        self,
        parameters: dict[str, object],
        context: QgsProcessingContext,
        progress: FeedbackProgress,
    ) -> None:
        """Read data from the project that `compute` needs; runs in the main thread."""
        self.find_inputs(parameters, context)

    def check(self, parameters: dict[str, object], context: QgsProcessingContext) -> None:
        """Check the values before a run; raise BareEarthError to refuse them."""
        check_area_only(parameters, self.chosen(parameters, context))
        stated_crs_of(self, parameters, context)
        self.find_inputs(parameters, context)
        check_outputs(self, parameters, context, self.inputs)
        self._has_page = self.makes_page(parameters, context)
        for output in self.outputDefinitions():
            if output.type() == "outputHtml" and self.subject:
                label = self._page_labels.setdefault(output.name(), output.description())
                output.setDescription(f"{self.subject}: {label}")

    def makes_page(self, parameters: dict[str, object], context: QgsProcessingContext) -> bool:
        """Return whether a run with these values makes a page."""
        pages = [
            output.name() for output in self.outputDefinitions() if output.type() == "outputHtml"
        ]
        return any(not compat.is_empty(parameters.get(name)) for name in pages)

    def chosen(
        self, parameters: dict[str, object], context: QgsProcessingContext
    ) -> list[ParameterSet]:
        """Return the declared parameters with the user's values."""
        return [
            parameters_of(self, declared, parameters, context) for declared in self.parameter_sets()
        ]

    def add_declared(self) -> None:
        """Add the fields of the declared parameters to the dialog."""
        for declared in self.parameter_sets():
            for parameter in declared.declarations():
                if parameter.name not in self.unused:
                    super().addParameter(self.declared_field(parameter))

    def declared_field(self, declaration: Declaration) -> QgsProcessingParameterDefinition:
        """Return the field of a declared parameter."""
        return field_of(declaration, self._is_shown(declaration))

    def addParameter(self, field: QgsProcessingParameterDefinition, help: str = "") -> bool:
        """Add a field to the dialog, with its label in the user's language."""
        field.setDescription(tr(field.description()))
        field.setHelp(in_words(help or field.help()))
        return super().addParameter(field)

    def addOutput(self, output: QgsProcessingOutputDefinition) -> bool:
        """Add an output, with its label in the user's language."""
        output.setDescription(tr(output.description()))
        return super().addOutput(output)

    def _is_shown(self, declaration: Declaration) -> bool:
        return not declaration.advanced if self.shown is None else declaration.name in self.shown

    def point_cloud_destination(
        self, parameters: dict[str, object], name: str, context: QgsProcessingContext
    ) -> str:
        """Return the path of an output point cloud; do not load it if QGIS cannot show it."""
        path = ""
        if not is_blank(parameters, name, context):
            path = compat.point_cloud_output_path(self, parameters, name, context)
        field = self.parameterDefinition(name)
        if not path and not field.flags() & compat.OPTIONAL:
            raise Refusal(mark("Choose a file: {}."), field.description())
        if not compat.can_load(path):
            do_not_load(context, [path])
        return path

    def crs_of(self, *sources: Path, recursive: bool = False) -> CloudCrs:
        """Return the CRS of point clouds, or the one that the user states instead."""
        stated = self.stated or self.layer_crs
        return CloudCrs(*sources, recursive=recursive, stated=stated)

    def show(self, path: str, look: layers.LayerLook) -> None:
        """Set the look of an output layer; rasters with a row do not need this."""
        self._looks[path] = look

    # QGIS calls the following methods.

    def hasHtmlOutputs(self) -> bool:
        """Return whether the run that was checked last makes a page."""
        # QGIS 3.22 asks after a run, and then tells the user to look at the pages that were made.
        return self._has_page

    def name(self) -> str:
        """Return the second half of the id."""
        return self.identifier

    def displayName(self) -> str:
        """Return the name in the toolbox."""
        return tr(self.title)

    def group(self) -> str:
        """Return the group in the toolbox."""
        return tr(self.section)

    def groupId(self) -> str:
        """Return the id of the group."""
        return self.section.lower().replace(" ", "")

    def shortDescription(self) -> str:
        """Return the tooltip."""
        return tr(self.line)

    def tags(self) -> list[str]:
        """Return the words for the search of the toolbox."""
        return words_in(self.words)

    def helpUrl(self) -> str:
        """Return the address of the page on the algorithm."""
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
            paragraphs.append(f"<b>{_plain(field.description())}</b>: {_plain(field.help())}")
            if field.name() == "PRESET":
                paragraphs.append(presets_of(self.parameter_sets()))
        return "\n".join(paragraphs)

    def createInstance(self) -> BareEarthAlgorithm:
        """Return another instance."""
        return type(self)()

    def icon(self) -> QIcon:
        """Return the icon in the toolbox."""
        return QIcon(self.svgIconPath())

    def svgIconPath(self) -> str:
        """Return the file of the icon."""
        return str(_ICONS / f"{self.identifier}.svg")

    def canExecute(self) -> tuple[bool, str]:
        """Return whether all needed packages are installed, and if not, how to install them."""
        if missing_packages(["scipy"]):
            return False, tr(
                "This QGIS has no scipy. On Windows, install python3-scipy with the OSGeo4W setup."
                " Elsewhere, install the scipy of the system, or a newer QGIS."
            )
        missing = missing_packages(["laspy"])
        # lazrs is needed only for .laz, and these give a message of their own.
        if missing:
            missing = missing_packages(["laspy", "lazrs"])
            # In English as the hint is: a message in two languages is hard to read.
            return False, f"{', '.join(missing)} must be installed first. {install_hint(missing)}"
        return True, ""

    def checkParameterValues(
        self, parameters: dict[str, object], context: QgsProcessingContext
    ) -> tuple[bool, str]:
        """Check values with the messages of the declarations first, then as QGIS does."""
        try:
            self.check(parameters, context)
        except Refusal as refusal:
            return False, refusal.translated
        except BareEarthError as error:
            return False, str(error)
        return super().checkParameterValues(parameters, context)

    def prepareAlgorithm(
        self,
        parameters: dict[str, object],
        context: QgsProcessingContext,
        feedback: QgsProcessingFeedback,
    ) -> bool:
        """Run `prepare`."""
        tell_error_once(False)
        tell_of_unknown(self, parameters, feedback)
        with errors_for_qgis():
            self.stated = stated_crs_of(self, parameters, context)
            self.prepare(parameters, context, FeedbackProgress(feedback))
        self._settings = settings_of(self, parameters, context)
        self._values = plain_values(self, parameters)
        self.class_counts: Mapping[int, int] = {}
        self._looks: dict[str, layers.LayerLook] = {}
        names = [self.subject, tr(self.run_name or self.title)]
        with errors_for_qgis():
            group, places = ": ".join(filter(None, names)), places_of(self, parameters, context)
            self._stage = LayerStage(context, group, places)
        return True

    def processAlgorithm(
        self,
        parameters: dict[str, object],
        context: QgsProcessingContext,
        feedback: QgsProcessingFeedback,
    ) -> dict[str, object]:
        """Run `compute`; if it is cancelled or fails, QGIS loads no output."""
        parameters = with_outputs_of_step(self, parameters, context, feedback)
        before, progress = set(context.layersToLoadOnCompletion()), FeedbackProgress(feedback)
        results: dict[str, object] = {}
        has_failed = True
        try:
            with errors_for_qgis(), addresses_named(self.brought):
                self.bring(parameters, context, progress)
                results = self.compute(parameters, context, progress)
            has_failed = False
        except Cancelled:
            has_failed = False
            feedback.pushInfo(self.cancelled)
        finally:
            loaded = set(context.layersToLoadOnCompletion()) - before
            # Of a file without points, no rasters are made.
            do_not_load(context, {path for path in loaded if not (results and _exists(path))})
            progress.end(self.class_counts if results else {}, has_failed)
            self._arrange(results, context, progress.commands)
        return results

    def _arrange(
        self, results: dict[str, object], context: QgsProcessingContext, commands: tuple[str, ...]
    ) -> None:
        """Set names, styles and places of the layers, and reload those of an earlier run."""
        looks: dict[str, layers.LayerLook] = {}
        labels, known = {}, layers.raster_looks()
        for name in filter(self.parameterDefinition, results):
            path = str(results[name])
            labels[path] = self.parameterDefinition(name).description()
            if name in known:
                looks[path] = known[name]
        looks.update(self._looks)
        if self.stated:
            crs = crs_of_text(self.stated)
            looks = {path: layers.in_crs(look, crs) for path, look in looks.items()}
        subject = self.subject or tr(self.title)
        for path in labels:
            remember_origin(path, subject)
        origin = Origin.of(self.displayName(), self._settings, commands)
        layers.arrange(context, looks, labels, subject, self._stage, origin)
        if results and is_remembered(self):
            project, run = context.project(), PastRun(self.id(), self._values, results, time.time())
            later(lambda: remember(project, run))


def words_in(groups: Iterable[str]) -> list[str]:
    """Return the words of groups, separated by commas, in English and the user's language."""
    words = (word for group in groups for text in (group, tr(group)) for word in text.split(","))
    return list(dict.fromkeys(words))


def _exists(source: str) -> bool:
    """Return whether the file of a layer exists; a GeoPackage can name a layer behind a bar."""
    # A file's own name may have the sign that separates it from a layer in it.
    return Path(source).exists() or Path(source.rpartition("|")[0] or source).exists()


def _plain(text: str) -> str:
    """Return a text, escaped for HTML; quotes stay, since `qgis_process help` shows the source."""
    return escape(text, quote=False)


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


def command_line(
    command: str,
    files: list[str],
    chosen: list[ParameterSet],
    options: Options,
    named: Collection[str] = (),
) -> str:
    """Return the command line, of a subcommand of `bare-earth` and its files, that does the same
    without QGIS; default values that are not `named` and empty options are left out.
    """
    words = ["bare-earth", command, *files]
    for option, value in options.items():
        if value:
            values = value if isinstance(value, tuple) else (value,)
            words += [f"--{option.lower().replace('_', '-')}", *values]
    for parameters in chosen:
        for declared in parameters.declarations():
            value = getattr(parameters, declared.name)
            if value != declared.default or declared.name in named:
                words += _option(declared.name.replace("_", "-"), value)
    return shell_line(words)


def _option(name: str, value: object) -> list[str]:
    if isinstance(value, bool):
        return [f"--{name}" if value else f"--no-{name}"]
    if isinstance(value, tuple):
        return [f"--{name}", *map(shown_value, value)]
    return [f"--{name}", "none" if value is None else str(value)]
