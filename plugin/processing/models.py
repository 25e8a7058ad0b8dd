"""The models that come with the plugin, in the toolbox."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from qgis.core import QgsProcessingContext, QgsProcessingFeedback, QgsProcessingModelAlgorithm

from .base import BareEarthAlgorithm

_FOLDER = Path(__file__).parents[1] / "models"


class ShippedModel(QgsProcessingModelAlgorithm):
    """A model that was drawn in the designer of QGIS, as an algorithm of ours.

    Parameters
    ----------
    file : Path
        The model; its name without underscores is the second half of the id.
    """

    page = "models"
    # As that of all others: the address of the page.
    helpUrl = BareEarthAlgorithm.helpUrl

    def __init__(self, file: Path) -> None:
        super().__init__()
        self._file = file
        # What it is made of is found once all providers are there: QGIS makes a new one to run.
        self.fromFile(str(file))

    def name(self) -> str:
        """Return the second half of the id; that of QGIS would be the title."""
        return self._file.stem.replace("_", "")

    def tags(self) -> list[str]:
        """Return what the search of the toolbox finds."""
        return ["lidar", "las", "laz", "ground", "dtm", "dem", "bare earth", "model", "workflow"]

    def processAlgorithm(
        self,
        parameters: dict[str, Any],
        context: QgsProcessingContext,
        feedback: QgsProcessingFeedback,
    ) -> dict[str, Any]:
        """Run it; for an input that is not given QGIS would hand on nothing, not its default."""
        defaults = {each.name(): each.defaultValue() for each in self.parameterDefinitions()}
        given = {**defaults, **parameters}
        return super().processAlgorithm(given, context, feedback)

    def createInstance(self) -> ShippedModel:
        """Return another instance."""
        return ShippedModel(self._file)


def shipped_models() -> list[ShippedModel]:
    """Return all of them."""
    return [ShippedModel(each) for each in sorted(_FOLDER.glob("*.model3"))]
