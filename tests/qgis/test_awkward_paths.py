"""Files and folders with awkward names: in the dialog, as layers, and in the log."""

import shlex
import shutil

import laspy
import numpy as np
import pytest
from qgis.core import QgsApplication, QgsProject
from qgis.PyQt.QtWidgets import QLineEdit
from support import ALGORITHM, Log, remove

NAMES = [
    "with two  spaces", "it's \"quoted\"", "Grünfläche 地面 😀", "-o leading dash",
    "<b>bold<br> & &amp; {0} %1", "a'); drop|c;d", "$HOME `id` #1", "[EPSG:4326]", "memory:tile",
]  # fmt: skip


@pytest.mark.parametrize("name", NAMES, ids=range(len(NAMES)))
def test_a_dialog_takes_them(name, scene, tmp_path, context):
    import processing
    from processing.gui.AlgorithmDialog import AlgorithmDialog

    from bare_earth.algorithms.cli import main

    folder = tmp_path / name
    folder.mkdir()
    cloud = shutil.copy(scene.path, folder / f"{folder.name}.laz")
    files = {"INPUT": str(cloud), "OUTPUT": str(folder / f"out {folder.name}.laz")}
    files["DTM"] = str(folder / f"dtm {folder.name}.tif")
    algorithm = QgsApplication.processingRegistry().createAlgorithmById(ALGORITHM)
    dialog = AlgorithmDialog(algorithm.create())
    try:
        dialog.setParameters(files)
        shown = {widget.text() for widget in dialog.findChildren(QLineEdit)}
        assert {files["OUTPUT"], files["DTM"]} <= shown
        values = dialog.createProcessingParameters()
        assert values["INPUT"] == files["INPUT"]
    finally:
        remove(dialog)
    log = Log()
    possible, text = algorithm.checkParameterValues(values, context)
    assert possible, text
    results = processing.runAndLoadResults(ALGORITHM, values, feedback=log, context=context)
    assert {key: results[key] for key in ("OUTPUT", "DTM")} == {
        key: files[key] for key in ("OUTPUT", "DTM")
    }
    classes = laspy.read(files["OUTPUT"]).classification
    assert np.array_equal(classes == 2, scene.ground)
    (terrain,) = (
        layer
        for layer in QgsProject.instance().mapLayers().values()
        # In a group with the raster of classes, where this QGIS shows no points.
        if layer.name() in ("Terrain model", f"{folder.name}: Terrain model")
    )
    assert terrain.isValid()
    (command,) = (shlex.split(words) for words in log.said if words.startswith("bare-earth "))
    assert main(command[1:]) == 0
    assert np.array_equal(laspy.read(files["OUTPUT"]).classification, classes)
