"""The plugin as QGIS sees it."""

from __future__ import annotations

from qgis.core import QgsApplication

from .provider import BareEarthProvider


class BareEarthPlugin:
    """Adds the Processing provider, and takes it away."""

    def __init__(self, iface: object) -> None:
        # qgis_process has no iface, and nothing here needs it.
        self._provider: BareEarthProvider | None = None

    def initProcessing(self) -> None:
        """Register the algorithms; the only method that qgis_process calls."""
        self._provider = BareEarthProvider()
        QgsApplication.processingRegistry().addProvider(self._provider)

    def initGui(self) -> None:
        """Start within the QGIS window."""
        self.initProcessing()

    def unload(self) -> None:
        """Take the algorithms away again."""
        if self._provider is not None:
            QgsApplication.processingRegistry().removeProvider(self._provider)
            self._provider = None
