"""The Processing provider: the group "Bare Earth" of the toolbox."""

from __future__ import annotations

from pathlib import Path

from qgis.core import QgsProcessingProvider
from qgis.PyQt.QtGui import QIcon

from .. import __version__
from ..algorithms.core.words import use_names
from ..algorithms.survey.feature_files import FORMATS
from .processing.compositions import CompositionAlgorithm
from .processing.field_names import Fields
from .processing.maps import map_algorithms
from .processing.models import shipped_models
from .processing.outputs import point_cloud_formats
from .processing.tools import tool_algorithms

ICON = Path(__file__).parent / "icons" / "bare_earth.svg"


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
        own = [CompositionAlgorithm(), *map_algorithms(), *tool_algorithms()]
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
