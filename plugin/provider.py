"""The Processing provider: the group "Bare Earth" of the toolbox."""

from __future__ import annotations

from pathlib import Path

from qgis.core import QgsProcessingProvider
from qgis.PyQt.QtGui import QIcon

from .. import __version__
from .processing import ALGORITHMS
from .processing.models import shipped_models
from .processing.outputs import point_cloud_formats

ICON = Path(__file__).parent / "icons" / "bare_earth.svg"


class BareEarthProvider(QgsProcessingProvider):
    """Registers every algorithm, also where a Python package they need is missing."""

    def id(self) -> str:
        """Return the first half of every algorithm's id; it never changes."""
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
        """Return the picture in the toolbox."""
        return QIcon(str(ICON))

    def svgIconPath(self) -> str:
        """Return the file of that picture."""
        return str(ICON)

    def loadAlgorithms(self) -> None:
        """Add an instance of each algorithm, and the models that come along."""
        for algorithm in [*(each() for each in ALGORITHMS), *shipped_models()]:
            self.addAlgorithm(algorithm)

    def supportsNonFileBasedOutput(self) -> bool:
        """Say that outputs are files."""
        return False

    def supportedOutputRasterLayerExtensions(self) -> list[str]:
        """Return the raster formats that the algorithms write."""
        return ["tif", "tiff"]

    def defaultRasterFileExtension(self) -> str:
        """Return the format of rasters that get no name, whatever the user's usual one is."""
        return "tif"

    def supportedOutputPointCloudLayerExtensions(self) -> list[str]:
        """Return the point cloud formats that can be written here."""
        return point_cloud_formats()

    def defaultPointCloudFileExtension(self) -> str:
        """Return the format of point clouds that get no name."""
        return point_cloud_formats()[0]
