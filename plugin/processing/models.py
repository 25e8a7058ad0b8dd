"""The models that come with the plugin, in the toolbox."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from qgis.core import (
    QgsProcessingContext,
    QgsProcessingFeedback,
    QgsProcessingModelAlgorithm,
    QgsProcessingParameterEnum,
)

from ...algorithms.core.parameters import ParameterSet
from ...algorithms.engine.options import TileMethod
from ..i18n import tr
from .base import BareEarthAlgorithm
from .choices import ChoiceParameter, with_labels
from .feedback import tell_of_unknown
from .fields import help_of
from .search_words import words_of

_CHOICES = {each.name.upper(): each for each in TileMethod.declarations()}
_FOLDER = Path(__file__).parents[1] / "models"


class ShippedModel(QgsProcessingModelAlgorithm):
    """A model that was drawn in the designer of QGIS, as an algorithm of ours.

    Parameters
    ----------
    file : Path
        The model; its name without underscores is the second half of the id.
    """

    page = "models"
    # As those of all others: the address of the page, and the help.
    helpUrl = BareEarthAlgorithm.helpUrl
    shortHelpString = BareEarthAlgorithm.shortHelpString

    def __init__(self, file: Path) -> None:
        super().__init__()
        self._file = file
        # What it is made of is found once all providers are there: QGIS makes a new one to run.
        self.fromFile(str(file))
        self.about = self.helpContent().get("ALG_DESC", "")
        # Again all of them, for the order: choices show labels, as in other dialogs.
        for each in [each.clone() for each in self.parameterDefinitions()]:
            self.removeParameter(each.name())
            # What a step says nothing of, the model does.
            each.setHelp(tr(each.help() or self.helpContent().get(each.name(), "")))
            each.setDescription(tr(each.description()))
            self.addParameter(_choice(each) if each.name() in _CHOICES else each)
        for each in self.outputDefinitions():
            each.setDescription(tr(each.description()))

    def name(self) -> str:
        """Return the second half of the id; that of QGIS would be the title."""
        return self._file.stem.replace("_", "")

    def displayName(self) -> str:
        """Return the name in the toolbox."""
        return tr(super().displayName())

    def group(self) -> str:
        """Return the group in the toolbox."""
        return tr(super().group())

    def shortDescription(self) -> str:
        """Return the tooltip."""
        return tr(super().shortDescription())

    def tags(self) -> list[str]:
        """Return what the search of the toolbox finds."""
        return words_of(self.name())

    def parameter_sets(self) -> tuple[type[ParameterSet], ...]:
        """Return no declared parameters: the fields are those that were drawn."""
        return ()

    def processAlgorithm(
        self,
        parameters: dict[str, Any],
        context: QgsProcessingContext,
        feedback: QgsProcessingFeedback,
    ) -> dict[str, Any]:
        """Run it; for an input that is not given QGIS would hand on nothing, not its default."""
        defaults = {each.name(): each.defaultValue() for each in self.parameterDefinitions()}
        tell_of_unknown(self, parameters, feedback)
        given = {**defaults, **parameters}
        return super().processAlgorithm(given, context, feedback)

    def createInstance(self) -> ShippedModel:
        """Return another instance."""
        return ShippedModel(self._file)


def _choice(drawn: QgsProcessingParameterEnum) -> ChoiceParameter:
    """Return a field that was drawn as those of the other dialogs are."""
    declared = _CHOICES[drawn.name()]
    values, default = drawn.options(), drawn.defaultValue()
    field = ChoiceParameter(drawn.name(), drawn.description(), values, False, default, False, True)
    field.setHelp(help_of(declared))
    return with_labels(field, [tr(declared.choices[each]) for each in values])


def shipped_models() -> list[ShippedModel]:
    """Return all of them."""
    return [ShippedModel(each) for each in sorted(_FOLDER.glob("*.model3"))]
