"""The dialog *Plugins > Bare Earth > LAZ support*, and its task."""

from __future__ import annotations

from pathlib import Path
from typing import Callable, Mapping, Sequence

from qgis.core import QgsApplication, QgsNetworkAccessManager, QgsTask
from qgis.PyQt.QtCore import QProcess, QProcessEnvironment, Qt, QUrl, pyqtSignal
from qgis.PyQt.QtNetwork import QNetworkProxy
from qgis.PyQt.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QFileDialog,
    QHBoxLayout,
    QLabel,
    QProgressBar,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from ..algorithms.core.errors import BareEarthError
from .i18n import tr
from .libraries.build import Build
from .libraries.laz_support import LazSupport
from .libraries.pip import Finished, Run

_SCHEMES = {
    QNetworkProxy.ProxyType.HttpProxy: "http",
    QNetworkProxy.ProxyType.HttpCachingProxy: "http",
    QNetworkProxy.ProxyType.Socks5Proxy: "socks5h",
}


class LazDialog(QDialog):
    """Shows whether .laz files can be read, and installs or removes lazrs."""

    # The work continues if the dialog is closed. When it is opened again, it shows the result.

    # Emitted when lazrs was installed.
    installed = pyqtSignal()

    def __init__(self, support: LazSupport, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._support = support
        self._task: _Task | None = None
        self.setWindowTitle(tr("LAZ support"))
        about = QLabel(
            tr(
                "Compressed point clouds (.laz, .copc.laz) need the Python package lazrs, which"
                " few builds of QGIS have. Here you can get it from the Python Package Index (0.6"
                " MB) or, without internet, from a wheel file of lazrs for {}. It is stored in"
                " your profile; QGIS itself does not change."
            ).format(Build.here().wheels)
        )
        self.state, self.result = QLabel(), QLabel()
        for label in (about, self.state, self.result):
            label.setWordWrap(True)
            label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.busy = QProgressBar()
        self.busy.setRange(0, 0)
        self.get = QPushButton(tr("Get lazrs"))
        self.choose = QPushButton(tr("From a wheel file…"))
        self.remove = QPushButton(tr("Remove"))
        self.get.clicked.connect(self._get)
        self.choose.clicked.connect(self._choose)
        self.remove.clicked.connect(self._remove)
        buttons = QHBoxLayout()
        for button in (self.get, self.choose, self.remove):
            buttons.addWidget(button)
        close = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
        close.rejected.connect(self.reject)
        layout = QVBoxLayout(self)
        for part in (about, self.state, buttons, self.busy, self.result, close):
            layout.addLayout(part) if part is buttons else layout.addWidget(part)
        self.setMinimumWidth(480)
        self._show_state()

    def showEvent(self, event: object) -> None:
        """Update the state each time the dialog opens."""
        self._show_state()
        super().showEvent(event)

    def stop(self) -> None:
        """Stop the work, because the plugin is unloaded."""
        if self._task is not None:
            self._task.cancel()

    def get_from_wheel(self, path: str) -> None:
        """Start to install lazrs from a wheel file."""
        self._start(lambda _: self._support.get_from_wheel(Path(path)))

    def _get(self) -> None:
        proxy = proxy_address()
        self._start(lambda run: self._support.get_by_pip(run, proxy))

    def _choose(self) -> None:
        path, _ = QFileDialog.getOpenFileName(
            self, tr("Wheel file of lazrs"), "", tr("Wheel files (*.whl)")
        )
        if path:
            self.get_from_wheel(path)

    def _remove(self) -> None:
        self.result.setText(self._support.remove())
        self._show_state()

    def _start(self, work: Callable[[Run], None]) -> None:
        self.result.setText("")
        self._task = _Task(work)
        self._task.taskCompleted.connect(self._ended)
        self._task.taskTerminated.connect(self._ended)
        self._show_state()
        QgsApplication.taskManager().addTask(self._task)

    def _ended(self) -> None:
        if self._task is not None:
            self.result.setText(self._task.error or tr("Done; no restart is needed."))
        self._task = None
        self._show_state()
        if self._support.is_there:
            self.installed.emit()

    def _show_state(self) -> None:
        working = self._task is not None
        self.state.setText(tr("Working…") if working else self._support.state)
        self.busy.setVisible(working)
        self.get.setEnabled(not working and not self._support.is_there)
        self.choose.setEnabled(not working and not self._support.is_there)
        self.remove.setEnabled(not working and self._support.is_ours)
        # The number of lines may have changed.
        self.adjustSize()


class _Task(QgsTask):
    """Works in another thread, so that the window of QGIS does not freeze."""

    def __init__(self, work: Callable[[Run], None]) -> None:
        super().__init__(tr("Bare Earth: LAZ support"), QgsTask.Flag.CanCancel)
        self._work = work
        self.error = ""

    def run(self) -> bool:
        """Do the work; QGIS calls this in the other thread."""
        try:
            self._work(self._run_process)
        except BareEarthError as error:
            self.error = tr("Cancelled.") if self.isCanceled() else str(error)
        except Exception as error:  # nobody would see an exception in this thread
            self.error = f"{type(error).__name__}: {error}"
        return not self.error

    def _run_process(self, command: Sequence[str], settings: Mapping[str, str]) -> Finished:
        environment = QProcessEnvironment.systemEnvironment()
        for name, value in settings.items():
            environment.insert(name, value)
        process = QProcess()
        process.setProcessEnvironment(environment)
        process.setProcessChannelMode(QProcess.ProcessChannelMode.MergedChannels)
        process.start(command[0], list(command[1:]))
        if not process.waitForStarted():
            return Finished(-1, process.errorString())
        while not process.waitForFinished(200):
            if process.state() == QProcess.ProcessState.NotRunning:
                break
            if self.isCanceled():
                process.kill()
        output = bytes(process.readAll()).decode(errors="replace")
        crashed = process.exitStatus() == QProcess.ExitStatus.CrashExit
        return Finished(-1 if crashed else process.exitCode(), output)


def proxy_address() -> str:
    """Return the address of the proxy in the settings of QGIS, or ""; only in the main thread."""
    proxy = QgsNetworkAccessManager.instance().fallbackProxy()
    scheme = _SCHEMES.get(proxy.type())
    if scheme is None or not proxy.hostName():
        return ""
    address = QUrl()
    address.setScheme(scheme)
    address.setHost(proxy.hostName())
    if proxy.port():
        address.setPort(proxy.port())
    address.setUserName(proxy.user())
    address.setPassword(proxy.password())
    return bytes(address.toEncoded()).decode()
