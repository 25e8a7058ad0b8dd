"""Makes the pictures of docs/images: the dialog, and a map of what the algorithm makes.

    tools/environment qgis /usr/bin/python3 docs/screenshots.py TILE.laz

It needs the widgets of QGIS but no screen. The names of the pictures hold the version of QGIS.
"""

from __future__ import annotations

import sys
import tempfile
import time
from pathlib import Path

from qgis.core import (
    Qgis,
    QgsApplication,
    QgsLayerTreeModel,
    QgsProcessingOutputLayerDefinition,
    QgsProject,
)
from qgis.gui import QgsLayerTreeView, QgsMapCanvas
from qgis.PyQt.QtCore import QSize, Qt
from qgis.PyQt.QtWidgets import QSplitter, QWidget

ALGORITHM = "bareearth:tindensification"
IMAGES = Path(__file__).parent / "images"
VERSION = ".".join(Qgis.QGIS_VERSION.split(".")[:2])


def save(widget: QWidget, name: str, size: QSize) -> None:
    """Show a widget, wait until it is drawn, and save it."""
    # More than a resize: without a screen, windows are not made larger than 800 x 800.
    widget.setMinimumSize(size)
    widget.show()
    wait(1.0)
    widget.grab().save(str(IMAGES / f"{name}-{VERSION}.png"))


def wait(seconds: float) -> None:
    """Let Qt work."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        QgsApplication.processEvents()
        time.sleep(0.02)


def show_dialog(tile: Path) -> None:
    """Picture the dialog with the rare parameters folded away."""
    from processing.gui.AlgorithmDialog import AlgorithmDialog

    algorithm = QgsApplication.processingRegistry().createAlgorithmById(ALGORITHM)
    dialog = AlgorithmDialog(algorithm)
    dialog.setParameters({"INPUT": tile.name})
    save(dialog, "dialog", QSize(1000, 900))
    dialog.close()


def show_map(tile: Path, folder: Path) -> None:
    """Classify the tile as the toolbox does, and picture the layers."""
    import processing

    project = QgsProject.instance()
    provider = QgsApplication.processingRegistry().providerById("bareearth")
    suffixes = {
        "HILLSHADE": ".tif",
        "DTM": ".tif",
        "OUTPUT": "." + provider.defaultPointCloudFileExtension(),
    }
    parameters = {
        name: QgsProcessingOutputLayerDefinition(str(folder / f"{name.lower()}{suffix}"), project)
        for name, suffix in suffixes.items()
    }
    processing.runAndLoadResults(ALGORITHM, {"INPUT": str(tile), **parameters})
    model = QgsLayerTreeModel(project.layerTreeRoot())
    tree = QgsLayerTreeView()
    tree.setModel(model)
    canvas = QgsMapCanvas()
    canvas.setCanvasColor(Qt.GlobalColor.white)
    canvas.setLayers(project.layerTreeRoot().layerOrder())
    canvas.setExtent(next(iter(project.mapLayers().values())).extent())
    window = QSplitter()
    window.addWidget(tree)
    window.addWidget(canvas)
    window.setSizes([300, 700])
    window.resize(1000, 720)
    window.show()
    wait(1.0)
    canvas.refresh()
    wait(10.0)
    save(window, "map", QSize(1000, 720))


def main() -> None:
    """Make both pictures."""
    app = QgsApplication([], True)
    app.initQgis()
    font = app.font()
    font.setPointSize(8)
    app.setFont(font)
    sys.path.append(str(Path(app.pkgDataPath()) / "python" / "plugins"))
    from processing.core.Processing import Processing

    from bare_earth import classFactory

    Processing.initialize()
    plugin = classFactory(None)
    plugin.initProcessing()
    tile = Path(sys.argv[1])
    IMAGES.mkdir(exist_ok=True)
    show_dialog(tile)
    with tempfile.TemporaryDirectory() as folder:
        show_map(tile, Path(folder))
        QgsProject.instance().clear()


if __name__ == "__main__":
    main()
