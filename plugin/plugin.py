"""The plugin as QGIS sees it."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from qgis.core import Qgis, QgsApplication, QgsMessageLog, QgsSettings
from qgis.PyQt.QtCore import QCoreApplication
from qgis.PyQt.QtWidgets import QPushButton

from ..algorithms.las.backends import install_hint, missing_packages
from .compat import QAction
from .i18n import install, tr
from .libraries.folders import BUNDLED, add_to_path
from .libraries.laz_support import LazSupport

if TYPE_CHECKING:
    from .laz_dialog import LazDialog
    from .provider import BareEarthProvider

_MENU = "Bare Earth"
# Whether the user has been told of the LAZ support.
_TOLD = "bare_earth/laz_support_told"


class BareEarthPlugin:
    """Adds the Processing provider and the menu, and takes them away."""

    def __init__(self, iface: Any) -> None:
        # qgis_process has no iface, and needs none.
        self._iface = iface
        self._provider: BareEarthProvider | None = None
        self._action: QAction | None = None
        self._dialog: LazDialog | None = None
        # Before all else, as the algorithms are listed in the user's language.
        self._translator = install()
        self._support = LazSupport(Path(QgsApplication.qgisSettingsDirPath()))

    def initProcessing(self) -> None:
        """Register the algorithms; the only method that qgis_process calls."""
        add_to_path(BUNDLED)
        self._support.use()
        if missing_packages(["numpy"]):  # the algorithms cannot even be listed
            message = _missing_science()
            QgsMessageLog.logMessage(message, _MENU, Qgis.MessageLevel.Warning)
            return
        from .provider import BareEarthProvider

        self._provider = BareEarthProvider()
        QgsApplication.processingRegistry().addProvider(self._provider)

    def initGui(self) -> None:
        """Start within the QGIS window."""
        self.initProcessing()
        self._action = QAction(tr("LAZ support…"), self._iface.mainWindow())
        self._action.triggered.connect(self.show_laz_support)
        self._iface.addPluginToMenu(_MENU, self._action)
        if _missing_science():
            self._iface.messageBar().pushMessage(
                _MENU, _missing_science(), Qgis.MessageLevel.Warning, 0
            )
        elif not self._support.is_there and not QgsSettings().value(_TOLD, False, type=bool):
            self._tell_of_laz_support()

    def show_laz_support(self) -> None:
        """Open the dialog that gets what .laz files need."""
        from .laz_dialog import LazDialog

        if self._dialog is None:
            self._dialog = LazDialog(self._support, self._iface.mainWindow())
        self._dialog.show()
        self._dialog.raise_()

    def unload(self) -> None:
        """Take it all away again."""
        if self._provider is not None:
            QgsApplication.processingRegistry().removeProvider(self._provider)
            self._provider = None
        if self._action is not None:
            self._iface.removePluginMenu(_MENU, self._action)
            self._action = None
        if self._dialog is not None:
            self._dialog.stop()
            self._dialog.close()
            self._dialog.deleteLater()
            self._dialog = None

        if self._translator is not None:
            QCoreApplication.removeTranslator(self._translator)

    def _tell_of_laz_support(self) -> None:
        """Say once that .laz files need a package, with the way to it."""
        bar = self._iface.messageBar()
        message = bar.createMessage(
            _MENU,
            tr(
                "Ready. Compressed point clouds (.laz) need one more package, which is"
                " installed only once."
            ),
        )
        button = QPushButton(tr("LAZ support…"))
        button.clicked.connect(self.show_laz_support)
        message.layout().addWidget(button)
        bar.pushWidget(message, Qgis.MessageLevel.Info, 0)
        QgsSettings().setValue(_TOLD, True)


def _missing_science() -> str:
    """Return what to do where numpy or scipy is missing, which come with QGIS; else nothing."""
    missing = missing_packages(["numpy", "scipy"])
    if not missing:
        return ""
    text = tr("This QGIS has no {}.").format(", ".join(missing))
    return f"{text} {install_hint(missing)}"
