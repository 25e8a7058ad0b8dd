"""The models of the plugin, in the toolbox."""

from __future__ import annotations

from pathlib import Path

from qgis.core import (
    QgsProcessing,
    QgsProcessingContext,
    QgsProcessingFeedback,
    QgsProcessingModelAlgorithm,
    QgsProcessingParameterEnum,
)

from ...algorithms.core.errors import BareEarthError
from ...algorithms.core.parameters import ParameterSet
from ...algorithms.survey.files import Inputs
from ...algorithms.tools.declaration import CANOPY, CLOUD, GROUND, TERRAIN
from ...algorithms.tools.ground.method import TileMethod
from .. import compat
from ..i18n import tr
from ..styles import layers
from ..styles.loaded import fresh_path
from ..styles.metadata import Origin, settings_of
from ..styles.stage import LayerStage
from .algorithm import ToolAlgorithm, errors_for_qgis, words_in
from .choices import ChoiceParameter, with_labels
from .feedback import tell_of_unknown
from .fields import help_of
from .inputs import name_of
from .outputs import check_outputs, do_not_load, is_blank, places_of
from .request import Request

_CHOICES = {declared.name.upper(): declared for declared in TileMethod.declarations()}
# Names of outputs in the models that make a classified cloud or contour lines.
_CLASSIFIED = "ground:OUTPUT"
_LINES = "contours:OUTPUT"
# For the search of the toolbox, by the second half of the id.
_WORDS = {
    "terraincontours": (CLOUD, GROUND, TERRAIN, "contours,workflow"),
    "cloudheights": (CLOUD, GROUND, CANOPY, "height,extra bytes"),
    "twomethods": (CLOUD, GROUND, "preview,try,test,preset,parameters,compare"),
}
_FOLDER = Path(__file__).parents[1] / "models"


class ShippedModel(QgsProcessingModelAlgorithm):
    """A model that was made in the model designer of QGIS; the name of its file without underscores
    is the second half of the id.
    """

    page = "command-line#models"
    # The same methods as in the other algorithms.
    helpUrl = ToolAlgorithm.helpUrl
    shortHelpString = ToolAlgorithm.shortHelpString

    def __init__(self, file: Path) -> None:
        super().__init__()
        self._file = file
        self.load()

    def load(self) -> None:
        """Read the file; steps and outputs are found only when their providers are loaded."""
        self.fromFile(str(self._file))
        self.about = self.helpContent().get("ALG_DESC", "")
        needed = set()
        # All parameters are added again, to keep their order. Choices show labels, as elsewhere.
        for field in [field.clone() for field in self.parameterDefinitions()]:
            name = field.name()
            self.removeParameter(name)
            # The help of the step, or else of the model.
            field.setHelp(field.help() or self.helpContent().get(name, ""))
            field.setDescription(tr(field.description()))
            if field.isDestination():
                if not field.flags() & compat.OPTIONAL:
                    needed.add(name)
                field.setFlags(field.flags() | compat.OPTIONAL)
                field.setCreateByDefault(True)
            self.addParameter(_choice(field) if name in _CHOICES else field)
        for output in self.outputDefinitions():
            output.setDescription(tr(output.description()))
        # Outputs that steps cannot do without, although nobody needs to keep them.
        self._needed = needed

    def name(self) -> str:
        """Return the second half of the id; QGIS would use the title."""
        return self._file.stem.replace("_", "")

    def displayName(self) -> str:
        return tr(super().displayName())

    def group(self) -> str:
        return tr(super().group())

    def shortDescription(self) -> str:
        return tr(super().shortDescription())

    def tags(self) -> list[str]:
        return words_in(_WORDS[self.name()])

    def parameter_sets(self) -> tuple[type[ParameterSet], ...]:
        """Return no declared parameters, since the fields are in the model."""
        return ()

    def checkParameterValues(
        self, parameters: dict[str, object], context: QgsProcessingContext
    ) -> tuple[bool, str]:
        """Check values as QGIS does, and outputs as the other algorithms do."""
        possible, text = super().checkParameterValues(parameters, context)
        if possible:
            try:
                source = Path(self.parameterAsFile(parameters, "INPUT", context))
                check_outputs(Request(self, parameters, context), Inputs(source))
            except BareEarthError as error:
                possible, text = False, str(error)
        return possible, text

    def prepareAlgorithm(
        self,
        parameters: dict[str, object],
        context: QgsProcessingContext,
        feedback: QgsProcessingFeedback,
    ) -> bool:
        """Name the layers and their group after the input."""
        self._subject = name_of(Path(self.parameterAsFile(parameters, "INPUT", context)))
        self._settings = settings_of(self, parameters, context)
        group, places = self.displayName(), places_of(Request(self, parameters, context))
        with errors_for_qgis():
            self._stage = LayerStage(context, f"{self._subject}: {group}", places, is_in_place=True)
        return super().prepareAlgorithm(parameters, context, feedback)

    def processAlgorithm(
        self,
        parameters: dict[str, object],
        context: QgsProcessingContext,
        feedback: QgsProcessingFeedback,
    ) -> dict[str, object]:
        """Run the model, with defaults for missing inputs, which QGIS would leave empty."""
        defaults = {field.name(): field.defaultValue() for field in self.parameterDefinitions()}
        for field in self.destinationParameterDefinitions():
            defaults[field.name()] = QgsProcessing.TEMPORARY_OUTPUT
        tell_of_unknown(self, parameters, feedback)
        given = {**defaults, **parameters}
        for field in self.destinationParameterDefinitions():
            name = field.name()
            if is_blank(Request(self, given, context), name):
                del given[name]  # steps make what is left empty
                given.update({name: defaults[name]} if name in self._needed else {})
        results: dict[str, object] = {}
        try:
            results = super().processAlgorithm(given, context, feedback)
        finally:
            self._arrange(results, context)
        return results

    def _arrange(self, results: dict[str, object], context: QgsProcessingContext) -> None:
        """Set names, styles and places of the layers; QGIS names them OUTPUT, DTM and so on."""
        # The paths by which QGIS loads them.
        paths = {
            name: fresh_path(value) for name, value in results.items() if isinstance(value, str)
        }
        looks = layers.looks_of(context)
        # Rasters of classes, for clouds that QGIS cannot show. Those of inner steps are not wanted.
        extra = [path for path, look in looks.items() if look.title == layers.CLASSES]
        if _CLASSIFIED not in paths:
            do_not_load(context, extra)
            looks = layers.looks_of(context)
        if context.willLoadLayerOnCompletion(paths.get(_LINES, "")):
            # They are made of a raster that may be temporary: what made them is the model.
            looks[paths[_LINES]] = looks[paths[_LINES]]._replace(origin=None)
            # The terrain must be visible below its contour lines.
            for path in {*extra, paths.get(_CLASSIFIED, "")} & set(looks):
                looks[path] = looks[path]._replace(hides=layers.BELOW_TERRAIN)
        labels = {path: context.layerToLoadOnCompletionDetails(path).name for path in looks}
        titles = [look.title for look in looks.values()]
        for name in filter(self.parameterDefinition, paths):
            path = paths[name]
            if path in looks and titles.count(looks[path].title) > 1:
                title = self.parameterDefinition(name).description()
                looks[path] = looks[path]._replace(title=title)
        origin = Origin.of(self.displayName(), self._settings)
        layers.arrange(context, looks, labels, self._subject, self._stage, origin)

    def createInstance(self) -> ShippedModel:
        return ShippedModel(self._file)


def _choice(drawn: QgsProcessingParameterEnum) -> ChoiceParameter:
    """Return a choice of a model as a choice with labels and help, as in other dialogs."""
    declared = _CHOICES[drawn.name()]
    values, default = drawn.options(), drawn.defaultValue()
    field = ChoiceParameter(drawn.name(), drawn.description(), values, False, default, False, True)
    field.setHelp(help_of(declared))
    return with_labels(field, [tr(declared.choices[value]) for value in values])


def shipped_models() -> list[ShippedModel]:
    """Return all models of the plugin."""
    return [ShippedModel(path) for path in sorted(_FOLDER.glob("*.model3"))]
