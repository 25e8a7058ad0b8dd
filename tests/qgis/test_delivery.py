"""Deliveries: all outputs of a job, in the dialog of the step from a point cloud to maps."""

import json
import os
import shlex
import shutil
from pathlib import Path

import laspy
import numpy as np
import pytest
import toy_delivery
from osgeo import gdal
from qgis.core import (
    QgsProcessingException,
    QgsProcessingOutputLayerDefinition,
    QgsProject,
    QgsRasterLayer,
    QgsVectorLayer,
)
from qgis.PyQt.QtWidgets import QLineEdit
from support import Log, remove, title_of

from bare_earth.algorithms.delivery.deliveries import DELIVERIES

ALL_IN_ONE = "bareearth:pointcloudtoterrain"


@pytest.fixture
def deliver(scene, tmp_path, context):
    """Run the algorithm as the toolbox does; return the results, the layers and the log."""
    import processing

    def run(name, **others):
        project, log = QgsProject.instance(), Log()
        project.clear()
        given = {"INPUT": str(scene.path), "DELIVERY": name, **others}
        given.setdefault("DELIVERY_FOLDER", str(tmp_path / "delivery"))
        results = processing.runAndLoadResults(ALL_IN_ONE, given, feedback=log)
        return results, project.layerTreeRoot(), log

    return run


def shown(root):
    """Return the layers of the project from the top, and whether they are visible."""
    return {title_of(node): node.itemVisibilityChecked() for node in root.findLayers()}


def test_the_dialog_offers_all_deliveries(registry):
    algorithm = registry.createAlgorithmById(ALL_IN_ONE)
    field = algorithm.parameterDefinition("DELIVERY")
    assert field.options() == ["own", *DELIVERIES] and field.defaultValue() == "own"


def test_a_new_delivery_is_one_row(monkeypatch, registry, deliver):
    toy = toy_delivery.add_toy(monkeypatch)
    algorithm = registry.createAlgorithmById(ALL_IN_ONE)
    assert toy_delivery.NAME in algorithm.parameterDefinition("DELIVERY").options()
    assert f"{toy_delivery.NAME}" in algorithm.shortHelpString()
    _, root, _ = deliver(toy_delivery.NAME, HOLD_OUT_SHARE=None)
    (group,) = root.findGroups()
    assert group.name() == f"scene: {toy.label}"
    assert {"Terrain model", "Contour lines"} <= set(shown(root))
    toy_delivery.forget()


def test_the_folder_of_a_delivery_is_below_it_and_single_outputs_are_hidden(registry):
    from processing.gui.AlgorithmDialog import AlgorithmDialog

    dialog = AlgorithmDialog(registry.createAlgorithmById(ALL_IN_ONE))
    dialog.show()
    fields = dialog.mainWidget().wrappers
    box, folder = (fields[name].wrappedWidget() for name in ("DELIVERY", "DELIVERY_FOLDER"))
    for name in ("own", "flood", "own"):
        box.setCurrentIndex(box.findData(name))
        assert folder.isVisible() == (name != "own")
        assert fields["DTM"].wrappedWidget().isVisible() == (name == "own")
        assert fields["CONTOURS"].wrappedLabel().isVisible() == (name == "own")
    layout = box.parentWidget().layout()
    assert layout.indexOf(folder) == layout.indexOf(box) + 2  # with its label between
    assert fields["DELIVERY_FOLDER"].wrappedLabel().text() == "Folder of the delivery"
    assert folder.findChild(QLineEdit).placeholderText() == "Choose a folder"
    remove(dialog)


def test_what_a_delivery_ignores_is_told(deliver, scene, tmp_path, registry, context):
    given = {"DTM": str(tmp_path / "my.tif"), "CONTOURS": str(tmp_path / "my.gpkg")}
    _, _, log = deliver("survey", DTM_CELL_SIZE=1, HILLSHADE="TEMPORARY_OUTPUT", **given)
    text = "Not used: DTM, CONTOURS; a delivery names its outputs itself, in its folder."
    assert text in log.said and not (tmp_path / "my.tif").exists()
    values = {"INPUT": str(scene.path), "DELIVERY_FOLDER": str(tmp_path / "f"), "KEY_POINTS": True}
    log = Log()
    assert registry.createAlgorithmById(ALL_IN_ONE).run({**values, **given}, context, log)[1]
    assert "KEY_POINTS, DELIVERY_FOLDER; only deliveries" in log.text
    assert (tmp_path / "my.tif").exists()


def test_only_a_delivery_has_a_page_named_after_the_input(registry, scene, tmp_path, context):
    algorithm = registry.createAlgorithmById(ALL_IN_ONE)
    values = {"INPUT": str(scene.path), "DELIVERY_FOLDER": str(tmp_path / "delivery")}
    for name, has_page in (("own", False), ("survey", True), ("flood", True)):
        assert algorithm.checkParameterValues({**values, "DELIVERY": name}, context)[0]
        # What QGIS 3.22 tells of at the end.
        assert algorithm.hasHtmlOutputs() == has_page
    assert algorithm.outputDefinition("PAGE").description() == "scene: Page of the delivery"


def test_a_delivery_loads_as_a_group_in_order(deliver, scene, tmp_path):
    results, root, log = deliver("flood", DTM_CELL_SIZE=1)
    folder = tmp_path / "delivery"
    assert results["DELIVERY_FOLDER"] == str(folder) and results["PAGE"] == str(
        folder / "index.html"
    )
    assert results["POINT_COUNT"] == scene.count
    # What a model can give to its next step.
    assert Path(results["DTM"]).parent == Path(results["CONTOURS"]).parent
    for name in ("OUTPUT", "DTM", "DSM", "HILLSHADE", "EXPECTED_ERROR", "CONTOURS"):
        assert folder in Path(results[name]).parents and Path(results[name]).is_file(), name
    (group,) = root.findGroups()
    assert group.name() == "scene: Flood model"
    names = [title_of(node) for node in group.findLayers()]
    expected = [
        "Places to review",
        "Contour lines",
        "Low confidence areas",
        "Classes",
        "Expected error",
        "Cause of the expected error",
        "Surface model",
        "Terrain model",
        "Hillshade",
    ]
    assert names == [name for name in expected if name in names] and len(names) >= 5
    assert shown(root)["Terrain model"] and not shown(root)["Surface model"]
    layers = QgsProject.instance().mapLayers().values()
    assert {type(layer) for layer in layers} >= {QgsRasterLayer, QgsVectorLayer}
    assert f"{scene.ground_count:,} of {scene.count:,} points" in log.text
    assert "accuracy: not measured" in log.text and "held out, all: RMSE" in log.text


def test_the_command_in_the_log_does_the_same(deliver, tmp_path):
    from bare_earth.algorithms.cli import main

    _, _, log = deliver("drone-site", PRESET="town", CONTOUR_INTERVAL=1)
    folder = tmp_path / "delivery"
    before = gdal.Open(str(folder / "dtm.tif")).ReadAsArray()
    files = sorted(os.listdir(folder))
    (command,) = [shlex.split(text) for text in log.said if text.startswith("bare-earth ")]
    shutil.rmtree(folder)
    QgsProject.instance().clear()
    assert main(command[1:]) == 0
    assert np.array_equal(gdal.Open(str(folder / "dtm.tif")).ReadAsArray(), before)
    assert sorted(os.listdir(folder)) == files
    settings = json.loads((folder / "delivery.json").read_text())["settings"]
    assert settings["TIN densification"] == {"preset": "town"}


@pytest.mark.parametrize(
    ("given", "preset", "low_noise"),
    [
        ({}, "site", "on"),
        ({"PRESET": None, "LOW_NOISE_CLASS": None}, "site", "on"),
        ({"PRESET": "automatic", "LOW_NOISE_CLASS": False}, "automatic", "off"),
        ({"PRESET": "0", "LOW_NOISE_CLASS": "false"}, "automatic", "off"),
        ({"LOW_NOISE_CLASS": True}, "site", "on"),
    ],
)
def test_a_value_that_was_given_is_not_that_of_the_delivery(
    deliver, tmp_path, given, preset, low_noise
):
    _, _, log = deliver("drone-site", DTM_CELL_SIZE=2, **given)
    record = json.loads((tmp_path / "delivery" / "delivery.json").read_text(encoding="utf-8"))
    assert record["settings"]["TIN densification"]["preset"] == preset
    assert record["settings"]["Classes"]["low_noise_class"] == low_noise
    names = {name.lower() for name, value in given.items() if value is not None}
    assert {*record["asked"]} == {"dtm_cell_size", *names}
    (command,) = [shlex.split(text) for text in log.said if text.startswith("bare-earth ")]
    assert ("--preset" in command) == ("preset" in names)
    assert ("--no-low-noise-class" in command) == (low_noise == "off")
    assert ("preset site" in log.text) == (preset == "site")


def test_what_deliveries_set_is_empty_in_the_dialog_at_first(scene, dialog_of):
    dialog = dialog_of(ALL_IN_ONE)
    dialog.setParameters({"INPUT": str(scene.path)})
    given = dialog.createProcessingParameters()
    for name in ("PRESET", "LOW_NOISE_CLASS", "HIGH_NOISE_CLASS", "PIT_FREE"):
        assert given.get(name) is None
    dialog.setParameters({**given, "PRESET": "automatic", "LOW_NOISE_CLASS": False})
    given = dialog.createProcessingParameters()
    assert (given["PRESET"], given["LOW_NOISE_CLASS"]) == ("automatic", "off")
    dialog.setParameters({**given, "LOW_NOISE_CLASS": True})
    assert dialog.createProcessingParameters()["LOW_NOISE_CLASS"] == "on"


def test_the_picture_that_matters_is_on_top(deliver):
    _, root, _ = deliver("archaeology", DTM_CELL_SIZE=1)
    visible = shown(root)
    assert visible["Archaeological topography (VAT)"] and not visible["Terrain model"]
    assert "Terrain with buildings" in visible


def test_a_folder_of_files_is_delivered_as_one_survey(deliver, scene, tmp_path):
    tiles = tmp_path / "tiles"
    tiles.mkdir()
    shutil.copy(scene.path, tiles)
    results, _, _ = deliver("forestry", INPUT=None, INPUT_FOLDER=str(tiles))
    # COPC where QGIS shows it.
    (cloud,) = (tmp_path / "delivery" / "points").glob(f"{Path(scene.path).stem}.*la[sz]")
    assert "HeightAboveGround" in list(laspy.read(str(cloud)).point_format.dimension_names)
    assert results["GROUND_COUNT"] == scene.ground_count


def test_what_cannot_be_delivered_is_refused(deliver, tmp_path):
    with pytest.raises(QgsProcessingException, match="folder for the delivery"):
        deliver("survey", DELIVERY_FOLDER=None)
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "notes.txt").write_text("mine")
    with pytest.raises(QgsProcessingException, match=r"other files, .*notes\.txt"):
        deliver("survey", DELIVERY_FOLDER=str(tmp_path / "mine"))


def test_outputs_of_ones_own_are_not_made_beside_a_delivery(deliver, tmp_path):
    own = QgsProcessingOutputLayerDefinition(str(tmp_path / "own.tif"), QgsProject.instance())
    results, _, _ = deliver("drone-site", DTM=own)
    assert results["DTM"].endswith("dtm.tif") and not (tmp_path / "own.tif").exists()


def test_a_cancel_leaves_nothing(scene, tmp_path):
    import processing

    log = Log(cancel_at=60)
    given = {"INPUT": str(scene.path), "DELIVERY": "drone-site"}
    processing.run(
        ALL_IN_ONE, {**given, "DELIVERY_FOLDER": str(tmp_path / "delivery")}, feedback=log
    )
    assert os.listdir(tmp_path) == ["scene.laz"]


def test_a_second_run_reloads_the_layers(deliver):
    deliver("drone-site", DTM_CELL_SIZE=1)
    project = QgsProject.instance()
    import processing

    count = len(project.mapLayers())
    folder = os.path.dirname(next(iter(project.mapLayersByName("scene: Terrain model"))).source())
    given = {"DELIVERY": "drone-site", "DELIVERY_FOLDER": folder, "DTM_CELL_SIZE": 2}
    source = os.path.join(os.path.dirname(folder), "scene.laz")
    processing.runAndLoadResults(ALL_IN_ONE, {"INPUT": source, **given}, feedback=Log())
    assert len(project.mapLayers()) == count
    (dtm,) = project.mapLayersByName("scene: Terrain model")
    assert dtm.rasterUnitsPerPixelX() == 2.0


def test_specification_hold_out_water_and_checkpoints_are_fields(deliver, scene, tmp_path):
    from bare_earth.algorithms.cli import main

    places = laspy.read(str(scene.path)).xyz
    away = np.hypot(*(places[:, :2] - places[:, :2].mean(axis=0)).T)
    rows = [f"{x},{y},{z},road" for x, y, z in places[np.argsort(away)[:400:100]]]
    table = tmp_path / "points.csv"
    table.write_text("\n".join(["east,north,elevation,kind", *rows]))
    given = dict(SPECIFICATION="linz", HOLD_OUT_SHARE=None, MIN_AREA=900, ACCURACY_CLASS=0.5)
    given.update(CHECKPOINTS=str(table), COVER_FIELD="kind", SURVEY_ERROR=0.02)
    _, root, log = deliver("survey", **given)
    folder = tmp_path / "delivery"
    assert (folder / "checkpoints.csv").exists() and "Errors at checkpoints" in shown(root)
    page = (folder / "index.html").read_text(encoding="utf-8")
    assert "LINZ" in (folder / "quality.html").read_text(encoding="utf-8")
    assert "Ground points held out" not in page and ", of 4 (median" in page
    settings = json.loads((folder / "delivery.json").read_text())["settings"]
    assert settings["Water"] == {"min_area": "900"}
    # The command in the log does the same.
    (command,) = [shlex.split(text) for text in log.said if text.startswith("bare-earth ")]
    files = sorted(os.listdir(folder))
    shutil.rmtree(folder)
    QgsProject.instance().clear()
    assert main(command[1:]) == 0 and sorted(os.listdir(folder)) == files
    again = json.loads((folder / "delivery.json").read_text())["settings"]
    assert again == settings


def test_fields_of_a_delivery_have_no_effect_on_own_outputs(deliver, tmp_path):
    own = str(tmp_path / "own.tif")
    results, _, _ = deliver(
        "own", DELIVERY_FOLDER=None, DTM=own, SPECIFICATION="linz", MIN_AREA=900, KEY_POINTS=True
    )
    assert results["DTM"] == own and os.path.exists(own) and "PAGE" not in results
