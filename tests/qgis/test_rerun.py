"""A run that writes the files of an earlier one: their layers in the project are reloaded."""

import os
import threading
import time

import laspy
import numpy as np
import pytest
from qgis.core import (
    QgsApplication,
    QgsField,
    QgsPointCloudLayer,
    QgsPointXY,
    QgsProcessingAlgRunnerTask,
    QgsProcessingContext,
    QgsProcessingException,
    QgsProcessingOutputLayerDefinition,
    QgsProject,
    QgsProviderRegistry,
    QgsRectangle,
    QgsVectorLayer,
)
from qgis.PyQt.QtCore import QVariant
from support import ALGORITHM, Log, colour_at, groups, layer_of, title_of, write_scene

from bare_earth.plugin.styles import loaded
from bare_earth.plugin.styles.stage import LayerStage

COPC = "copc" in QgsProviderRegistry.instance().providerList()
needs_copc = pytest.mark.skipif(not COPC, reason="this QGIS shows no point clouds")
ONE_STEP = "bareearth:pointcloudtoterrain"
# In the scene, here the ground is 100.5 m high.
WEST, SOUTH = 500_000.0, 5_700_000.0
PLACE = QgsPointXY(WEST + 10.5, SOUTH + 10.5)


@pytest.fixture
def run(context):
    """Run an algorithm as the toolbox does, and return the layers of the project by name."""
    import processing

    def run(algorithm, parameters, outputs):
        project = QgsProject.instance()
        loading = {
            name: QgsProcessingOutputLayerDefinition(str(path), project)
            for name, path in outputs.items()
        }
        processing.runAndLoadResults(algorithm, {**parameters, **loading})
        return by_name()

    yield run
    QgsProject.instance().clear()


def by_name():
    layers = QgsProject.instance().mapLayers().values()
    assert len({layer.name() for layer in layers}) == len(layers)
    return {title_of(layer): layer for layer in layers}


def names_in_groups():
    return {name: [title_of(child) for child in children] for name, children in groups().items()}


def lift(path, metres):
    las = laspy.read(path)
    las.z = np.asarray(las.z) + metres
    las.write(path)


def value_of(layer):
    return layer.dataProvider().sample(PLACE, 1)[0]


def colour_of(layer):
    """Return the colour of the map at `PLACE`, with this layer alone."""
    return colour_at([layer], PLACE.x(), PLACE.y()).name()


def test_the_map_shows_the_new_terrain_in_the_old_group(run, scene, tmp_path):
    names = ("DTM", "HILLSHADE", "RELIEF")
    outputs = {key: tmp_path / f"{key}.tif" for key in names}
    outputs["CONTOURS"] = tmp_path / "lines.gpkg"
    values = {"INPUT": str(scene.path), "CONTOUR_INTERVAL": 0.5}
    before = run(ONE_STEP, values, outputs)
    tree, ids = names_in_groups(), {name: data.id() for name, data in before.items()}
    terrain = before["Terrain model"]
    assert value_of(terrain) == pytest.approx(100.7, abs=0.1)
    assert {feature["ELEV"] for feature in before["Contour lines"].getFeatures()} == set(
        np.arange(100.5, 106, 0.5)
    )
    # What the user has changed in the tree stays.
    root = QgsProject.instance().layerTreeRoot()
    root.findLayer(terrain.id()).setItemVisibilityChecked(False)
    terrain.setName("My terrain")
    lift(scene.path, 50.0)
    after = run(ONE_STEP, values, outputs)
    assert {name: value.id() for name, value in after.items()} == {
        "My terrain" if name == "Terrain model" else name: value for name, value in ids.items()
    }
    ((name, layers),) = names_in_groups().items()
    assert {
        name: [layer.replace("My t", "T") + " model" * (layer == "My terrain") for layer in layers]
    } == tree
    terrain = after["My terrain"]
    assert value_of(terrain) == pytest.approx(150.7, abs=0.1)
    assert not root.findLayer(terrain.id()).itemVisibilityChecked()
    renderer = terrain.renderer()
    assert 149 < renderer.classificationMin() < renderer.classificationMax() < 157
    lines = after["Contour lines"]
    assert {feature["ELEV"] for feature in lines.getFeatures()} == set(np.arange(150.5, 156, 0.5))


def test_the_extent_of_a_layer_follows_its_file(run, scene, tmp_path):
    outputs = {"DTM": tmp_path / "dtm.tif"}
    (before,) = run(ONE_STEP, {"INPUT": str(scene.path)}, outputs).values()
    assert before.width() == before.height() == 80
    write_scene(scene.path, origin=(WEST + 500, SOUTH))
    (after,) = run(ONE_STEP, {"INPUT": str(scene.path), "DTM_CELL_SIZE": 2}, outputs).values()
    assert after.width() == after.height() == 40
    assert after.extent().xMinimum() == WEST + 500


def test_layers_are_reloaded_that_the_run_does_not_load(run, scene, tmp_path):
    import processing

    outputs = {"DTM": tmp_path / "dtm.tif"}
    (layer,) = run(ONE_STEP, {"INPUT": str(scene.path)}, outputs).values()
    lift(scene.path, 50.0)
    processing.run(ONE_STEP, {"INPUT": str(scene.path), "DTM": str(outputs["DTM"])})
    assert value_of(layer) == pytest.approx(150.7, abs=0.1)
    assert layer.renderer().classificationMin() > 149


def test_a_new_output_joins_the_old_group_in_its_order(run, scene, tmp_path):
    outputs = {name: tmp_path / f"{name}.tif" for name in ("DTM", "HILLSHADE")}
    run(ONE_STEP, {"INPUT": str(scene.path)}, outputs)
    (group,) = QgsProject.instance().layerTreeRoot().children()
    group.setName("My group")
    outputs["RELIEF"] = tmp_path / "relief.tif"
    outputs["DSM"] = tmp_path / "dsm.tif"
    run(ONE_STEP, {"INPUT": str(scene.path)}, outputs)
    order = ["Local relief", "Surface model", "Terrain model", "Hillshade"]
    assert names_in_groups() == {"My group": order}


def test_in_a_thread_of_its_own(run, scene, tmp_path, registry):
    outputs = {"DTM": tmp_path / "dtm.tif"}
    (layer,) = run(ONE_STEP, {"INPUT": str(scene.path)}, outputs).values()
    lift(scene.path, 50.0)
    context, log, done = QgsProcessingContext(), Log(), []
    context.setProject(QgsProject.instance())
    task = QgsProcessingAlgRunnerTask(
        registry.createAlgorithmById(ONE_STEP),
        {"INPUT": str(scene.path), "DTM": str(outputs["DTM"])}, context, log,
    )  # fmt: skip
    task.executed.connect(lambda *result: done.append(result))
    QgsApplication.taskManager().addTask(task)
    wait_for(lambda: done and value_of(layer) > 150)
    assert done[0][0] and value_of(layer) == pytest.approx(150.7, abs=0.1)


def wait_for(condition, seconds=20):
    end = time.monotonic() + seconds
    while not condition() and time.monotonic() < end:
        QgsApplication.processEvents()
        time.sleep(0.01)


@pytest.mark.parametrize("name", ["classifytiles", "terrainmodel"])
def test_virtual_rasters_are_reloaded(name, run, tmp_path):
    (tmp_path / "in").mkdir()
    for number in range(2):
        origin = WEST + 80 * number, SOUTH
        write_scene(tmp_path / "in" / f"{number}.laz", origin=origin)
        lift(tmp_path / "in" / f"{number}.laz", 0.0)
    if name == "terrainmodel":
        for path in sorted((tmp_path / "in").iterdir()):
            las = laspy.read(path)
            las.classification[:] = np.where(np.asarray(las.z) < 110, 2, 1)
            las.write(path)
    values = {"RASTER_PER_FILE": True}
    if name == "terrainmodel":
        values["INPUT"] = str(tmp_path / "in")
    else:
        values |= {"INPUT_FOLDER": str(tmp_path / "in"), "OUTPUT_FOLDER": str(tmp_path / "out")}
    outputs = {"DTM": tmp_path / "dtm.tif"}
    before = run(f"bareearth:{name}", values, outputs)
    (terrain,) = (layer for layer in before.values() if layer.source().endswith("dtm.vrt"))
    assert value_of(terrain) == pytest.approx(100.7, abs=0.1)
    for path in sorted((tmp_path / "in").iterdir()):
        lift(path, 5.0)
    run(f"bareearth:{name}", values, outputs)
    assert value_of(terrain) == pytest.approx(105.7, abs=0.1)
    assert len(names_in_groups()) <= 1


@needs_copc
@pytest.mark.parametrize("times", [1, 3])
def test_points_and_their_classes_are_the_new_ones(times, run, scene, tmp_path):
    outputs = {"OUTPUT": tmp_path / "o.copc.laz", "DTM": tmp_path / "dtm.tif"}
    before = run(ALGORITHM, {"INPUT": str(scene.path), "TO_CLASS": 2}, outputs)["Classes"]
    colours = {colour_of(before)}
    for number in range(times):
        values = {"INPUT": str(scene.path), "TO_CLASS": 9 + number}
        after = run(ALGORITHM, values, outputs)["Classes"]
        assert after.id() == before.id()
        assert 9 + number in {category.value() for category in after.renderer().categories()}
        colours.add(colour_of(after))
    assert len(colours) == 1 + times and "#ffffff" not in colours
    assert os.path.samefile(after.source(), outputs["OUTPUT"])
    assert len(names_in_groups()) == 1


@needs_copc
def test_a_layer_that_was_removed_comes_back_with_the_new_points(run, scene, tmp_path):
    outputs, colours = {"OUTPUT": tmp_path / "o.copc.laz"}, set()
    for value in (2, 9, 6):
        (layer,) = run(ALGORITHM, {"INPUT": str(scene.path), "TO_CLASS": value}, outputs).values()
        colours.add(colour_of(layer))
        QgsProject.instance().clear()
    assert len(colours) == 3


@needs_copc
def test_the_points_of_many_files_are_the_new_ones(run, tmp_path):
    (tmp_path / "in").mkdir()
    for number in range(2):
        origin = WEST + 80 * number, SOUTH
        write_scene(tmp_path / "in" / f"{number}.laz", origin=origin)
    values = {"INPUT_FOLDER": str(tmp_path / "in"), "OUTPUT_FOLDER": str(tmp_path / "out")}
    colours, ids = set(), set()
    for value in (2, 9, 6):
        given = {**values, "TO_CLASS": value, "FORMAT": "copc.laz"}
        layer = run("bareearth:classifytiles", given, {"DTM": tmp_path / "dtm.tif"})["Classes"]
        ids.add(layer.id())
        assert {category.value() for category in layer.renderer().categories()} == {1, value}
        colours.add(colour_of(layer))
    assert len(colours) == 3 and len(ids) == 1 and "#ffffff" not in colours


def test_a_layer_with_edits_that_are_not_saved_is_not_overwritten(run, scene, tmp_path, registry):
    outputs = {"CONTOURS": tmp_path / "lines.gpkg"}
    values = {"INPUT": str(scene.path), "CONTOUR_INTERVAL": 0.5}
    (lines,) = run(ONE_STEP, values, outputs).values()
    lift(scene.path, 50.0)
    assert lines.startEditing()
    assert lines.deleteFeature(next(lines.getFeatures()).id())
    context, log = QgsProcessingContext(), Log()
    context.setProject(QgsProject.instance())
    algorithm = registry.createAlgorithmById(ONE_STEP)
    given = {**values, "CONTOURS": str(outputs["CONTOURS"])}
    _, done = algorithm.run(given, context, log)
    assert not done and "is being edited" in log.text
    written = QgsVectorLayer(str(outputs["CONTOURS"]))
    assert lines.isModified() and max(feature["ELEV"] for feature in written.getFeatures()) < 110
    lines.rollBack()


@pytest.mark.parametrize("ends", ["well", "cancelled", "failed"])
def test_files_are_released_where_open_files_cannot_be_replaced(
    ends, run, scene, tmp_path, registry, monkeypatch
):
    """As on Windows: no layer holds its file open during the run, and all are back afterwards."""
    outputs = {"DTM": tmp_path / "dtm.tif", "CONTOURS": tmp_path / "lines.gpkg"}
    values = {"INPUT": str(scene.path), "CONTOUR_INTERVAL": 0.5}
    layers = run(ONE_STEP, values, outputs)
    assert open_files(outputs.values())
    colours = layers["Terrain model"].renderer().classificationMax()
    monkeypatch.setattr(loaded, "MUST_RELEASE", True)
    lift(scene.path, 50.0)
    if ends == "failed":
        scene.path.write_bytes(scene.path.read_bytes()[:3000])
    held = []

    class Watching(Log):
        def setProgress(self, progress):
            held.extend(open_files(outputs.values()))
            super().setProgress(progress)

    log, context = Watching(50 if ends == "cancelled" else None), QgsProcessingContext()
    context.setProject(QgsProject.instance())
    given = {**values, **{name: str(path) for name, path in outputs.items()}}
    registry.createAlgorithmById(ONE_STEP).run(given, context, log)
    assert not held
    assert by_name() == layers and all(layer.isValid() for layer in layers.values())
    raised = 50.0 if ends == "well" else 0.0
    terrain = layers["Terrain model"]
    assert value_of(terrain) == pytest.approx(100.7 + raised, abs=0.1)
    assert terrain.renderer().classificationMax() == pytest.approx(colours + raised, abs=0.5)
    lines = {feature["ELEV"] for feature in layers["Contour lines"].getFeatures()}
    assert lines == set(np.arange(100.5 + raised, 106 + raised, 0.5))
    assert layers["Contour lines"].renderer().type() == "RuleRenderer"


@pytest.mark.parametrize("is_busy", [False, True])
def test_a_step_of_a_model_in_another_thread_releases_layers_too(
    run, scene, tmp_path, monkeypatch, is_busy
):
    """Unless the window is busy: it may wait for the model itself."""
    (layer,) = run(ONE_STEP, {"INPUT": str(scene.path)}, {"DTM": tmp_path / "dtm.tif"}).values()
    monkeypatch.setattr(loaded, "MUST_RELEASE", True)
    monkeypatch.setattr(loaded, "_PATIENCE", 0.2 if is_busy else 60.0)
    context, stages = QgsProcessingContext(), []
    context.setProject(QgsProject.instance())
    step = threading.Thread(
        target=lambda: stages.append(LayerStage(context, "model", [tmp_path / "dtm.tif"]))
    )
    step.start()
    while not is_busy and step.is_alive():
        QgsApplication.processEvents()
    step.join()
    QgsApplication.processEvents()
    assert bool(open_files([tmp_path / "dtm.tif"])) == is_busy
    stages[0].reload({})
    assert layer.isValid() and layer.source() == str(tmp_path / "dtm.tif")


def open_files(paths):
    names = {str(path) for path in paths}
    found = []
    for name in os.listdir("/proc/self/fd"):
        try:
            found.append(os.readlink(f"/proc/self/fd/{name}"))
        except OSError:
            continue
    return names & set(found)


def test_the_loop_of_corrections_by_polygons(run, scene, tmp_path):
    outputs = {name: tmp_path / f"{name}.tif" for name in ("DTM", "HILLSHADE")}
    values = {"INPUT": str(scene.path), "OUTPUT": str(tmp_path / "o.las")}
    layers = run(ALGORITHM, values, outputs)
    terrain, ids = layers["Terrain model"], {layer.id() for layer in layers.values()}
    on_roof = QgsPointXY(WEST + 39.5, SOUTH + 33.5)
    below = terrain.dataProvider().sample(on_roof, 1)[0]
    assert below < 104
    # The roof is a rock: its points are ground.
    rock = layer_of(
        "Polygon", QgsRectangle(WEST + 31, SOUTH + 21, WEST + 47, SOUTH + 45).asWktPolygon()
    )
    field = QgsField("class", QVariant.Int)
    rock.dataProvider().addAttributes([field])
    rock.updateFields()
    rock.dataProvider().changeAttributeValues({next(rock.getFeatures()).id(): {0: 2}})
    layers = run(ALGORITHM, {**values, "CORRECTIONS": rock}, outputs)
    assert {layer.id() for layer in layers.values()} == ids
    assert terrain.dataProvider().sample(on_roof, 1)[0] == pytest.approx(112.0, abs=0.01)
    assert terrain.renderer().classificationMax() > 110
    assert len(names_in_groups()) == 1


@needs_copc
def test_a_cloud_with_edits_that_are_not_saved_is_not_read(run, scene, tmp_path, monkeypatch):
    """Its edits would be missing without a word. Scripts cannot edit points, so this acts it."""
    (layer,) = run(
        ALGORITHM, {"INPUT": str(scene.path)}, {"OUTPUT": tmp_path / "o.copc.laz"}
    ).values()
    monkeypatch.setattr(QgsPointCloudLayer, "isEditable", lambda _: True)
    monkeypatch.setattr(QgsPointCloudLayer, "isModified", lambda _: True, raising=False)
    algorithm = QgsApplication.processingRegistry().createAlgorithmById(ALGORITHM)
    context = QgsProcessingContext()
    context.setProject(QgsProject.instance())
    for value in (layer, layer.id()):
        values = {"INPUT": value, "OUTPUT": str(tmp_path / "again.laz")}
        possible, text = algorithm.checkParameterValues(values, context)
        assert not possible and "is being edited" in text


@needs_copc
def test_the_filter_of_the_user_stays_beside_ours(tmp_path, run):
    (tmp_path / "in").mkdir()
    write_scene(tmp_path / "in" / "a.laz")
    values = {"INPUT_FOLDER": str(tmp_path / "in"), "OUTPUT_FOLDER": str(tmp_path / "out")}
    values["FORMAT"] = "copc.laz"
    outputs = {"DTM": tmp_path / "dtm.tif"}
    layer = run("bareearth:classifytiles", values, outputs)["Classes"]
    for own in ("", "(Z > 100) AND (Z < 105)"):
        assert layer.setSubsetString(own)
        for _ in range(2):
            run("bareearth:classifytiles", values, outputs)
            assert layer.subsetString() != own and loaded.filter_of(layer) == own


def test_a_shipped_model_reloads_its_layers(run, scene, tmp_path):
    outputs = {
        "ground:DTM": tmp_path / "dtm.tif",
        "ground:HILLSHADE": tmp_path / "hillshade.tif",
        "contours:OUTPUT": tmp_path / "lines.gpkg",
    }
    values = {"INPUT": str(scene.path), "INTERVAL": 0.5, "ground:OUTPUT": str(tmp_path / "o.las")}
    before = run("bareearth:terraincontours", values, outputs)
    ids, tree = {layer.id() for layer in before.values()}, names_in_groups()
    assert tree == {
        "scene: Terrain, hillshade and contours": [
            "Contour lines",
            "Classes",
            "Terrain model",
            "Hillshade",
        ]
    }
    lift(scene.path, 50.0)
    after = run("bareearth:terraincontours", values, outputs)
    assert {layer.id() for layer in after.values()} == ids and names_in_groups() == tree
    assert value_of(after["Terrain model"]) == pytest.approx(150.7, abs=0.1)
    assert after["Terrain model"].renderer().classificationMin() > 149
    assert {feature["ELEV"] for feature in after["Contour lines"].getFeatures()} >= {151.0, 155.5}
    assert after["Contour lines"].renderer().type() == "RuleRenderer"
    # With another interval, the legend is another one.
    again = run("bareearth:terraincontours", {**values, "INTERVAL": 1.0}, outputs)
    rules = again["Contour lines"].renderer().rootRule().children()
    assert [rule.label() for rule in rules] == ["Every 5 m", "Every 1 m", "Depression"]
    # A run that fails leaves all layers as they were.
    scene.path.write_bytes(scene.path.read_bytes()[:3000])
    with pytest.raises(QgsProcessingException):
        run("bareearth:terraincontours", values, outputs)
    assert all(layer.isValid() for layer in again.values()) and names_in_groups() == tree
    assert value_of(again["Terrain model"]) == pytest.approx(150.7, abs=0.1)
