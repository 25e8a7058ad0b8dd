"""A real QGIS without a window, with the plugin's provider, and a scene whose truth is known."""

import gc
import os
import shutil
import subprocess
import sys
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

import pytest
import qm
import translations
from qgis.core import QgsApplication, QgsMapLayer, QgsProcessingContext, QgsProject, QgsSettings
from qgis.PyQt import sip
from qgis.PyQt.QtCore import QCoreApplication

# For support.py, which the tests import too, and for test_remote.py, whose tests run here again.
sys.path += [str(Path(__file__).parent), str(Path(__file__).parents[1] / "remote")]

from support import ALGORITHM, ROOT, Log, Scene, remove

# The files that run every day, in a minute, and a run of each kind. All else is `rest`.
DAILY = {
    "assess", "check", "choices", "contours_and_clips", "enumerations", "fields", "file_tools",
    "metadata", "models", "off_terrain", "outputs", "provider", "raster_rows", "review",
    "review_dock", "small_screens", "suggested_input", "tools", "translations", "water",
    "test_run", "test_a_broken_file_is_told_and_the_others_are_done",
    "test_a_new_delivery_is_one_row",
}  # fmt: skip


def pytest_itemcollected(item):
    """Leave out of the daily tests what is not among these."""
    if not {item.path.stem.replace("test_", ""), item.originalname} & DAILY:
        item.add_marker("rest")


@pytest.fixture(scope="session", autouse=True)
def qgis_app(tmp_path_factory):
    # With widgets, for the dialogs; the profile is not the user's.
    app = QgsApplication([], True, str(tmp_path_factory.mktemp("profile")))
    app.initQgis()
    # Processing is a plugin, too.
    sys.path.append(str(Path(app.pkgDataPath()) / "python" / "plugins"))
    yield app
    QgsProject.instance().clear()
    for widget in app.topLevelWidgets():
        widget.deleteLater()
    # Layers close their files by GDAL, which ends below; a context, which the last test may still
    # hold, has layers.
    gc.collect()
    gc.unfreeze()
    for found in gc.get_objects():
        has_layers = issubclass(type(found), (QgsMapLayer, QgsProcessingContext))
        if has_layers and not sip.isdeleted(found) and sip.ispyowned(found):
            sip.delete(found)
    # As QGIS itself ends: it waits for threads of its pool, and ends those of its passwords. What
    # runs on while Python ends can crash the process.
    app.exitQgis()


@pytest.fixture(scope="session", autouse=True)
def plugin(qgis_app):
    from processing.core.Processing import Processing

    from bare_earth import classFactory

    Processing.initialize()
    plugin = classFactory(None)
    plugin.initProcessing()
    yield plugin
    plugin.unload()


@pytest.fixture(scope="session")
def registry(plugin):
    return QgsApplication.processingRegistry()


@pytest.fixture
def algorithm(registry):
    return registry.createAlgorithmById(ALGORITHM)


@pytest.fixture
def dialog_of(registry):
    """What opens the dialog of an algorithm."""
    from processing.gui.AlgorithmDialog import AlgorithmDialog

    opened = []

    def dialog_of(name):
        opened.append(AlgorithmDialog(registry.createAlgorithmById(name)))
        return opened[-1]

    yield dialog_of
    for dialog in opened:
        remove(dialog)


@pytest.fixture
def context():
    context = QgsProcessingContext()
    context.setProject(QgsProject.instance())
    yield context
    QgsProject.instance().clear()


@pytest.fixture
def log():
    return Log()


@pytest.fixture(scope="session")
def qgis_process(tmp_path_factory):
    """What runs qgis_process with some words, in a profile where the plugin is enabled."""
    # Debian 12 starts it by a script that adds an option which its QGIS does not know.
    program = shutil.which("qgis_process.bin") or shutil.which("qgis_process")
    home = str(tmp_path_factory.mktemp("qgis_process"))
    environment = {**os.environ, "HOME": home, "QGIS_CUSTOM_CONFIG_PATH": home}

    def run(*words):
        return subprocess.run([program, *words], capture_output=True, text=True, env=environment)

    done = run("plugins", "enable", "bare_earth")
    assert done.returncode == 0, done.stderr
    return run


@pytest.fixture(params=[".las", ".laz"])
def any_scene(request, tmp_path):
    return Scene(tmp_path, request.param)


@pytest.fixture
def scene(tmp_path):
    return Scene(tmp_path, ".laz")


@pytest.fixture(scope="session")
def data():
    """The folder of labelled point clouds, where there is one."""
    folders = [
        os.environ.get("BARE_EARTH_DATA"), ROOT.parent / "shared" / "data", "/shared/data"
    ]  # fmt: skip
    for folder in filter(None, folders):
        if Path(folder).is_dir():
            return Path(folder)
    return None


@pytest.fixture
def speak(tmp_path):
    """Return what makes QGIS speak a language, with what `make package` makes."""
    installed = []

    from bare_earth.plugin import i18n

    def set_language(locale):
        settings = QgsSettings()
        settings.setValue("locale/overrideFlag", True)
        settings.setValue("locale/userLocale", locale)
        for path in translations.FILES:
            messages = qm.read_ts(path.read_bytes())
            (tmp_path / path.name).with_suffix(".qm").write_bytes(qm.compiled(messages))
        installed.append(i18n.install(tmp_path))
        return installed[-1]

    yield set_language
    for file in filter(None, installed):
        QCoreApplication.removeTranslator(file)
    QgsSettings().remove("locale/overrideFlag")
    QgsSettings().remove("locale/userLocale")
