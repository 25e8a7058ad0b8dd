"""The plugin class that QGIS loads."""

from __future__ import annotations

import functools
from pathlib import Path
from typing import TYPE_CHECKING

from qgis.core import Qgis, QgsApplication, QgsMessageLog, QgsSettings
from qgis.PyQt.QtCore import QCoreApplication, Qt, QTimer, QUrl
from qgis.PyQt.QtGui import QDesktopServices
from qgis.PyQt.QtWidgets import QPushButton

from ..algorithms.core.errors import BareEarthError
from ..algorithms.core.words import Keywords, use_names
from ..algorithms.las.backends import install_hint, missing_packages
from .compat import QAction
from .help_pages import address_of
from .i18n import install, tr
from .libraries.folders import BUNDLED, add_to_path, remove_if_uninstalled
from .libraries.laz_support import LazSupport

if TYPE_CHECKING:
    from qgis.gui import QgisInterface, QgsMessageBarItem

    from .laz_dialog import LazDialog
    from .provider import BareEarthProvider
    from .review.dock import ReviewDock

_MENU = "Bare Earth"
_FIRST = "bareearth:pointcloudtoterrain"
# The setting that stores whether the message on LAZ support was shown.
_TOLD = "bare_earth/laz_support_told"
# Milliseconds after which an uninstalled plugin is gone.
_SOON = 3000


class BareEarthPlugin:
    """Adds and removes the Processing provider and the menu."""

    def __init__(self, iface: QgisInterface) -> None:
        # None in qgis_process, which only registers the algorithms.
        self._iface = iface
        self._provider: BareEarthProvider | None = None
        self._actions: list[QAction] = []
        self._message: QgsMessageBarItem | None = None
        self._dialog: LazDialog | None = None
        self._dock: ReviewDock | None = None
        # First, because the algorithms are listed in the user's language.
        self._translator = install()
        self._support = LazSupport(Path(QgsApplication.qgisSettingsDirPath()))

    def initProcessing(self) -> None:
        """Register the algorithms; qgis_process calls only this method."""
        add_to_path(BUNDLED)
        self._support.use()
        if missing_packages(["numpy"]):  # the algorithms cannot even be listed
            message = _missing_science()
            QgsMessageLog.logMessage(message, _MENU, Qgis.MessageLevel.Warning)
            return
        from .provider import BareEarthProvider

        self._provider = BareEarthProvider()
        registry = QgsApplication.processingRegistry()
        # Models also have steps of other providers, which may come later.
        registry.providerAdded.connect(self._provider.load_models)
        registry.addProvider(self._provider)

    def initGui(self) -> None:
        """Add provider and menu to the QGIS window."""
        self.initProcessing()
        entries = {
            tr("Point cloud to terrain…"): self.show_terrain,
            tr("Review"): self.show_review,
            tr("LAZ support…"): self.show_laz_support,
            tr("Remove downloaded point clouds"): self.clear_cache,
            tr("Documentation"): self.show_help,
        }
        for text, show in entries.items():
            action = QAction(text, self._iface.mainWindow())
            action.triggered.connect(show)
            self._iface.addPluginToMenu(_MENU, action)
            self._actions.append(action)
        if _missing_science():
            self._iface.messageBar().pushMessage(
                _MENU, _missing_science(), Qgis.MessageLevel.Warning, 0
            )
        elif not self._support.is_there and not QgsSettings().value(_TOLD, False, type=bool):
            self._tell_of_laz_support()

    def show_terrain(self) -> None:
        """Open the dialog of *Point cloud to terrain*, with which most users begin."""
        from qgis import processing

        dialog = processing.createAlgorithmDialog(_FIRST)
        if dialog is not None:
            dialog.show()

    def show_laz_support(self) -> None:
        """Open the dialog for LAZ support."""
        from .laz_dialog import LazDialog

        if self._dialog is None:
            self._dialog = LazDialog(self._support, self._iface.mainWindow())
            self._dialog.installed.connect(self._remove_message)
        self._dialog.show()
        self._dialog.raise_()

    def show_review(self) -> None:
        """Open the dock for places to review, with those of the last run."""
        missing = missing_packages(["numpy", "scipy", "laspy"])
        if missing:
            text = f"{', '.join(missing)} must be installed first. {install_hint(missing)}"
            self._iface.messageBar().pushMessage(_MENU, text, Qgis.MessageLevel.Warning)
            return
        # Imported here, so that QGIS starts faster, and since it needs these packages.
        from .review.dock import ReviewDock

        if self._dock is None:
            self._dock = ReviewDock(self._iface)
            self._iface.addDockWidget(Qt.DockWidgetArea.BottomDockWidgetArea, self._dock)
        self._dock.setUserVisible(True)

    def clear_cache(self) -> None:
        """Remove what is kept of remote point clouds, and tell how much that was."""
        from ..algorithms.remote.cache import cache_of, clear
        from ..algorithms.remote.fetching import in_words

        try:
            text, level = tr("{} were removed from {}."), Qgis.MessageLevel.Info
            text = text.format(in_words(clear(cache_of(None))), cache_of(None))
        except BareEarthError as error:
            text, level = str(error), Qgis.MessageLevel.Warning
        self._iface.messageBar().pushMessage(_MENU, text, level)

    def show_help(self) -> None:
        """Open the documentation that comes with the plugin."""
        QDesktopServices.openUrl(QUrl(address_of("index")))

    def unload(self) -> None:
        """Remove provider, menu, message, dialog and dock."""
        if self._provider is not None:
            registry = QgsApplication.processingRegistry()
            registry.providerAdded.disconnect(self._provider.load_models)
            registry.removeProvider(self._provider)
            self._provider = None
            use_names(Keywords())
        for action in self._actions:
            self._iface.removePluginMenu(_MENU, action)
        self._actions = []
        self._remove_message()
        if self._dialog is not None:
            self._dialog.stop()
            self._dialog.close()
            self._dialog.deleteLater()
            self._dialog = None
        if self._dock is not None:
            self._dock.stop()
            self._iface.removeDockWidget(self._dock)
            self._dock.deleteLater()
            self._dock = None
        if self._translator is not None:
            QCoreApplication.removeTranslator(self._translator)
        # Updates put the folder of the plugin back before this.
        folders = Path(__file__).parents[1], Path(QgsApplication.qgisSettingsDirPath())
        QTimer.singleShot(_SOON, functools.partial(remove_if_uninstalled, *folders))

    def _tell_of_laz_support(self) -> None:
        """Tell the user once that .laz files need a package, with a button to install it."""
        bar = self._iface.messageBar()
        message = bar.createMessage(
            _MENU,
            tr("Ready. Point clouds in .laz need one more package."),
        )
        buttons = {
            tr("LAZ support…"): self.show_laz_support,
            tr("Point cloud to terrain…"): self.show_terrain,
        }
        for text, show in buttons.items():
            button = QPushButton(text)
            button.clicked.connect(show)
            message.layout().addWidget(button)
        self._message = bar.pushWidget(message, Qgis.MessageLevel.Info, 0)
        QgsSettings().setValue(_TOLD, True)

    def _remove_message(self) -> None:
        """Remove the message on .laz files, unless the user did."""
        if self._message is not None and self._message in self._iface.messageBar().items():
            self._iface.messageBar().popWidget(self._message)
        self._message = None


def _missing_science() -> str:
    """Return what to do if numpy or scipy is missing, although QGIS normally has them; or ""."""
    missing = missing_packages(["numpy", "scipy"])
    if not missing:
        return ""
    # In English as the hint is: a message in two languages is hard to read.
    return f"This QGIS has no {', '.join(missing)}. {install_hint(missing)}"
