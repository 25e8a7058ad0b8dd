"""Makes the pictures of docs/images: the dialogs, and maps of what the algorithms make.

    tools/environment qgis /usr/bin/python3 docs/figures/screenshots.py TILE [FOLDER [PICTURE ...]]

It needs the widgets of QGIS but no screen. The names of the pictures hold the version of QGIS.
Without PICTUREs all are made: dialog, map, map-one-step, ... Those from map-terrain on are of the
cloud that `map` makes, so name it, too.
"""

from __future__ import annotations

import os
import sys
import tempfile
import time
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from qgis.core import (
    Qgis,
    QgsApplication,
    QgsFeature,
    QgsFillSymbol,
    QgsGeometry,
    QgsLayerTreeModel,
    QgsPointCloudLayer,
    QgsProcessingOutputLayerDefinition,
    QgsProject,
    QgsRectangle,
    QgsVectorLayer,
)
from qgis.gui import QgsLayerTreeView, QgsMapCanvas
from qgis.PyQt.QtCore import QSize, Qt
from qgis.PyQt.QtWidgets import QSplitter, QWidget

ALGORITHM = "bareearth:tindensification"
ONE_STEP = "bareearth:pointcloudtoterrain"
# Few pictures are kept in docs/images.
WANTED = sys.argv[3:]
IMAGES = Path(sys.argv[2]) if len(sys.argv) > 2 else Path(__file__).parents[1] / "images"
# What is no ground in the tile of `make demo`: the large building, with what stands round it.
BUILDING = QgsRectangle(568_136.0, 5_931_179.0, 568_208.0, 5_931_233.0)
VERSION = ".".join(Qgis.QGIS_VERSION.split(".")[:2])


def save(widget: QWidget, name: str, size: QSize) -> None:
    """Show a widget, wait until it is drawn, and save it."""
    # More than a resize: without a screen, windows are not made larger than 800 x 800.
    widget.setMinimumSize(size)
    widget.show()
    wait(1.0)
    widget.grab().save(str(IMAGES / f"{name}-{VERSION}.png"))


def is_wanted(picture: str) -> bool:
    """Return whether a picture is to be made."""
    return not WANTED or picture in WANTED


def wait(seconds: float) -> None:
    """Let Qt work."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        QgsApplication.processEvents()
        time.sleep(0.02)


def show_dialog(tile: Path, name: str, picture: str) -> None:
    """Picture a dialog with the rare parameters folded away."""
    if not is_wanted(picture):
        return
    from processing.gui.AlgorithmDialog import AlgorithmDialog

    algorithm = QgsApplication.processingRegistry().createAlgorithmById(name)
    dialog = AlgorithmDialog(algorithm)
    dialog.setParameters({"INPUT": tile.name})
    save(dialog, picture, QSize(1000, 900))
    dialog.close()


def show_map(
    algorithm: str,
    parameters: dict[str, Any],
    outputs: dict[str, str],
    name: str,
    over: QgsVectorLayer | None = None,
    extent: QgsRectangle | None = None,
) -> None:
    """Run an algorithm as the toolbox does, and picture its layers.

    Parameters
    ----------
    algorithm : str
        Its id.
    parameters : dict
        Its inputs.
    outputs : dict of str to str
        The files to make, by the names of the fields; all are loaded.
    name : str
        Of the picture.
    over : QgsVectorLayer, optional
        A layer to show on top; the map shows what lies round it.
    extent : QgsRectangle, optional
        What the map shows.
    """
    if not is_wanted(name.replace("map-remote", "remote")):
        return
    import processing

    project = QgsProject.instance()
    if over is not None:
        project.addMapLayer(over)
    loaded = {
        field: QgsProcessingOutputLayerDefinition(path, project) for field, path in outputs.items()
    }
    processing.runAndLoadResults(algorithm, {**parameters, **loaded})
    model = QgsLayerTreeModel(project.layerTreeRoot())
    tree = QgsLayerTreeView()
    tree.setModel(model)
    canvas = QgsMapCanvas()
    canvas.setCanvasColor(Qt.GlobalColor.white)
    root = project.layerTreeRoot()
    canvas.setLayers([layer for layer in root.layerOrder() if root.findLayer(layer).isVisible()])
    canvas.setExtent(extent or next(iter(project.mapLayers().values())).extent())
    if over is not None:
        canvas.setLayers([over, *(layer for layer in canvas.layers() if layer is not over)])
        canvas.setExtent(over.extent().buffered(30.0))
    window = QSplitter()
    window.addWidget(tree)
    window.addWidget(canvas)
    window.setSizes([260, 540])
    window.resize(800, 560)
    window.show()
    wait(1.0)
    canvas.refresh()
    wait(1.0)
    while canvas.isDrawing():
        wait(0.5)
    wait(3.0)  # the last layers are put together
    save(window, name, QSize(800, 560))
    project.clear()


def show_corrections(tile: Path, folder: Path) -> None:
    """Picture the map of the filter alone, and the one that follows a polygon of corrections."""
    provider = QgsApplication.processingRegistry().providerById("bareearth")
    outputs = {"OUTPUT": str(folder / f"known.{provider.defaultPointCloudFileExtension()}")}
    outputs |= {field: str(folder / f"known-{field}.tif") for field in ("DTM", "HILLSHADE")}
    for name in ("map-by-hand-before", "map-by-hand"):
        layer = QgsVectorLayer(
            "Polygon?crs=EPSG:25832&field=class:integer", "corrections: class 6", "memory"
        )
        feature = QgsFeature(layer.fields())
        feature.setGeometry(QgsGeometry.fromRect(BUILDING))
        feature["class"] = 6
        layer.dataProvider().addFeatures([feature])
        outline = {"style": "no", "outline_color": "215,38,61", "outline_width": "0.8"}
        layer.renderer().setSymbol(QgsFillSymbol.createSimple(outline))
        known = {} if name.endswith("before") else {"CORRECTIONS": layer}
        show_map(ONE_STEP, {"INPUT": str(tile), **known}, outputs, name, layer)


def show_maps(tile: Path, folder: Path) -> None:
    """Picture what each algorithm makes of the tile."""
    provider = QgsApplication.processingRegistry().providerById("bareearth")
    suffix = "." + provider.defaultPointCloudFileExtension()
    cloud = str(folder / f"ground{suffix}")
    rasters = {
        field: str(folder / f"{field}.tif")
        for field in ("DTM", "HILLSHADE", "DSM", "CHM", "EXPECTED_ERROR")
    }
    two = {field: rasters[field] for field in ("DTM", "HILLSHADE")}
    show_map(ALGORITHM, {"INPUT": str(tile)}, {"OUTPUT": cloud, **two}, "map")
    lines = {"CONTOURS": str(folder / "contours.gpkg"), "RELIEF": str(folder / "relief.tif")}
    whole = {"OUTPUT": str(folder / f"cloud{suffix}"), **rasters, **lines}
    show_map(ONE_STEP, {"INPUT": str(tile)}, whole, "map-one-step")
    show_map("bareearth:terrainmodel", {"INPUT": cloud}, rasters, "map-terrain")
    for field in ("CHM", "DSM", "EXPECTED_ERROR"):
        few = {"HILLSHADE": rasters["HILLSHADE"], field: rasters[field]}
        show_map("bareearth:terrainmodel", {"INPUT": cloud}, few, f"map-{field.lower()}")
    if suffix == ".copc.laz":  # else no cloud can be seen
        heights = {"OUTPUT": str(folder / f"heights{suffix}")}
        show_map("bareearth:heightaboveground", {"INPUT": cloud}, heights, "map-heights")
    errors = {"ERROR_MAP": str(folder / "errors.tif")}
    files = {"CLASSIFIED": cloud, "REFERENCE": str(tile)}
    show_map("bareearth:assess", files, errors, "map-errors")


def show_remote(tile: Path, folder: Path) -> None:
    """Picture a remote layer on a map, the dialog for it, and the terrain of the map."""
    if not is_wanted("remote"):
        return
    import processing
    from processing.gui.AlgorithmDialog import AlgorithmDialog
    from qgis import utils

    sys.path.append(str(Path(__file__).parents[2] / "tests" / "helpers"))
    from remote_server import serving

    processing.run(ALGORITHM, {"INPUT": str(tile), "OUTPUT": str(folder / "tile.copc.laz")})
    project, canvas = QgsProject.instance(), QgsMapCanvas()
    before, utils.iface = utils.iface, SimpleNamespace(mapCanvas=lambda: canvas)
    with serving() as server:
        address = server.add("tile.copc.laz", (folder / "tile.copc.laz").read_bytes())
        layer = QgsPointCloudLayer(address, "lidar of the state", "copc")
        project.addMapLayer(layer)
        utils.iface.activeLayer, utils.iface.mainWindow = (lambda: layer), (lambda: None)
        canvas.setDestinationCrs(layer.crs())
        canvas.setLayers([layer])
        canvas.resize(540, 560)
        canvas.setExtent(layer.extent().buffered(-60.0))
        dialog = AlgorithmDialog(QgsApplication.processingRegistry().createAlgorithmById(ONE_STEP))
        save(dialog, "dialog-remote", QSize(1000, 900))
        values = dialog.createProcessingParameters()
        rasters = {name: str(folder / f"{name}.tif") for name in ("DTM", "HILLSHADE")}
        given = {name: values[name] for name in ("INPUT", "EXTENT")}
        dialog.close()
        os.environ["BARE_EARTH_CACHE"] = str(folder / "cache")
        show_map(ONE_STEP, given, rasters, "map-remote", extent=canvas.extent())
    utils.iface = before


def main() -> None:
    """Make the pictures."""
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
    show_dialog(tile, ALGORITHM, "dialog")
    show_dialog(tile, ONE_STEP, "dialog-one-step")
    with tempfile.TemporaryDirectory() as folder:
        show_remote(tile, Path(folder))
        show_corrections(tile, Path(folder))
        show_maps(tile, Path(folder))


if __name__ == "__main__":
    main()
