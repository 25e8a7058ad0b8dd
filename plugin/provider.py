"""The Processing provider: the group "Bare Earth" of the toolbox."""

from __future__ import annotations

from pathlib import Path
from typing import Iterable

from qgis.core import QgsProcessingProvider
from qgis.PyQt.QtGui import QIcon

from .. import __version__
from ..algorithms.core.words import Keywords, use_names
from ..algorithms.survey.feature_files import FORMATS
from ..algorithms.tools import composition
from .i18n import tr
from .processing.algorithm import ToolAlgorithm, tool_algorithms
from .processing.compositions import CompositionAlgorithm
from .processing.models import shipped_models
from .processing.outputs import point_cloud_formats

ICON = Path(__file__).parent / "icons" / "bare_earth.svg"


class Fields(Keywords):
    """Names options and tools in messages by labels and titles, in the language of the user."""

    reproject = "with 'Reproject' of the group Point cloud data management"

    def __init__(self, algorithms: Iterable[ToolAlgorithm]) -> None:
        # By the command and the option; without a command, the first tool that has the option.
        self._labels: dict[tuple[str, str], str] = {}
        self._titles = {"clear-cache": tr("Remove downloaded point clouds")}  # in the menu
        for algorithm in algorithms:
            self._titles.setdefault(algorithm.command, algorithm.displayName())

    def add_labels(self, algorithms: Iterable[ToolAlgorithm]) -> None:
        """Add the labels of algorithms, which have fields only when they are registered."""
        for algorithm in algorithms:
            for field in algorithm.parameterDefinitions():
                for command in (algorithm.command, ""):
                    key = command, field.name().lower()
                    self._labels.setdefault(key, field.description())

    def tool(self, command: str) -> str:
        """Return the title of a tool."""
        return f"'{self._titles.get(command, command)}'"

    def option(self, name: str, value: object, command: str) -> str:
        """Return the label of a field, with its value unless it is a box to tick."""
        text = f"'{self._labels.get((command, name), name)}'"
        text += f" ({value})" if value not in (None, True) else ""
        return f"{text} of {self.tool(command)}" if command else text


class BareEarthProvider(QgsProcessingProvider):
    """Registers all algorithms, also if a Python package that they need is missing."""

    def __init__(self) -> None:
        super().__init__()
        self.algorithmsLoaded.connect(self.load_models)

    def id(self) -> str:
        """Return the first half of the ids of the algorithms; it never changes."""
        return "bareearth"

    def name(self) -> str:
        """Return the name in the toolbox."""
        return "Bare Earth"

    def longName(self) -> str:
        """Return the name in the settings and in the list of qgis_process."""
        return f"Bare Earth {__version__}"

    def versionInfo(self) -> str:
        """Return the version of the plugin."""
        return __version__

    def icon(self) -> QIcon:
        """Return the icon in the toolbox."""
        return QIcon(str(ICON))

    def svgIconPath(self) -> str:
        """Return the file of the icon."""
        return str(ICON)

    def loadAlgorithms(self) -> None:
        """Add an instance of each algorithm, and the models of the plugin."""
        self._models = shipped_models()
        own = [CompositionAlgorithm(composition("deliver")), *tool_algorithms()]
        names = Fields(own)
        use_names(names)  # the helps name other tools
        for algorithm in [*own, *self._models]:
            self.addAlgorithm(algorithm)
        names.add_labels(own)

    def load_models(self, _: str = "") -> None:
        """Read the models again, whose outputs are known only when their steps are registered."""
        for model in self._models:
            model.load()

    def supportsNonFileBasedOutput(self) -> bool:
        """Return that outputs are always files."""
        return False

    def supportedOutputRasterLayerExtensions(self) -> list[str]:
        """Return the raster formats that the algorithms write."""
        return ["tif", "tiff"]

    def defaultRasterFileExtension(self) -> str:
        """Return the format of rasters without a name, whatever the user's settings are."""
        return "tif"

    def supportedOutputVectorLayerExtensions(self) -> list[str]:
        """Return the formats of lines that the algorithms write."""
        return [ending[1:] for ending in FORMATS]

    def defaultVectorFileExtension(self, hasGeometry: bool = True) -> str:
        """Return the format of lines without a name, whatever the user's settings are."""
        return self.supportedOutputVectorLayerExtensions()[0]

    def supportedOutputPointCloudLayerExtensions(self) -> list[str]:
        """Return the point cloud formats that can be written."""
        return point_cloud_formats()

    def defaultPointCloudFileExtension(self) -> str:
        """Return the format of point clouds without a name."""
        return point_cloud_formats()[0]
