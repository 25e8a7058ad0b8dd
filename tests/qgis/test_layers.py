"""Outputs as layers of the project."""

import json
import time
from pathlib import Path

import laspy
import numpy as np
import pytest
from qgis.core import (
    Qgis,
    QgsApplication,
    QgsPointCloudClassifiedRenderer,
    QgsPointCloudLayer,
    QgsPointXY,
    QgsProcessingAlgRunnerTask,
    QgsProcessingContext,
    QgsProcessingOutputLayerDefinition,
    QgsProject,
    QgsProviderRegistry,
)
from support import ALGORITHM, title_of, write_scene

COPC = "copc" in QgsProviderRegistry.instance().providerList()
needs_copc = pytest.mark.skipif(
    not COPC, reason=f"QGIS {Qgis.QGIS_VERSION} of this build loads no point clouds"
)


@pytest.fixture
def parameters(scene, tmp_path):
    return {
        "INPUT": str(scene.path),
        "OUTPUT": str(tmp_path / "ground.laz"),
        "DTM": str(tmp_path / "dtm.tif"),
    }


@pytest.fixture
def load(context):
    """Run the algorithm as the toolbox does, and return its layers by their kind."""
    import processing

    def load(parameters):
        project = QgsProject.instance()
        project.clear()
        parameters = dict(parameters)
        for name in {"OUTPUT", "DTM"} & set(parameters):
            parameters[name] = QgsProcessingOutputLayerDefinition(parameters[name], project)
        results = processing.runAndLoadResults(ALGORITHM, parameters)
        layers = QgsProject.instance().mapLayers().values()
        return results, {type(layer).__name__: layer for layer in layers}

    return load


def wait_for(condition, seconds=20):
    end = time.monotonic() + seconds
    while not condition() and time.monotonic() < end:
        QgsApplication.processEvents()
        time.sleep(0.01)
    return condition()


def test_the_terrain_model_is_marked_as_elevation(load, parameters):
    for _ in range(3):  # again, as what styles the layers must outlive the first time
        load(parameters)
        (layer,) = QgsProject.instance().mapLayersByName("scene: Terrain model")
        assert layer.crs().authid() == "EPSG:25832"
        properties = layer.elevationProperties()
        if Qgis.QGIS_VERSION_INT < 32600:
            assert properties is None
            continue
        assert properties.isEnabled()
        # Not a random colour.
        assert properties.profileLineSymbol().color().name() == "#6e4824"
        if hasattr(Qgis, "RasterElevationMode"):
            assert properties.mode() == Qgis.RasterElevationMode.RepresentsElevationSurface


def test_what_cannot_load_is_written_all_the_same(load, parameters):
    if "pdal" in QgsProviderRegistry.instance().providerList():
        pytest.skip("this QGIS loads every .laz")
    results, layers = load(parameters)
    assert set(layers) == {"QgsRasterLayer"}
    assert results["OUTPUT"] == parameters["OUTPUT"]


def test_the_default_is_what_can_load_here(registry):
    provider = registry.providerById("bareearth")
    pdal = "pdal" in QgsProviderRegistry.instance().providerList()
    expected = "copc.laz" if COPC and not pdal else "laz"
    assert provider.defaultPointCloudFileExtension() == expected
    assert set(provider.supportedOutputPointCloudLayerExtensions()) == {"las", "laz", "copc.laz"}


@needs_copc
def test_a_cloud_is_coloured_by_class_and_counted_right(load, parameters, scene):
    parameters["OUTPUT"] = parameters["OUTPUT"].replace(".laz", ".copc.laz")
    for _ in range(3):
        _, layers = load(parameters)
        cloud = layers["QgsPointCloudLayer"]
        assert isinstance(cloud.renderer(), QgsPointCloudClassifiedRenderer)
        assert cloud.renderer().attribute() == "Classification"
        categories = {
            category.value(): category.label() for category in cloud.renderer().categories()
        }
        assert categories == {1: "Unclassified", 2: "Ground"}
        assert cloud.pointCount() == scene.count
        assert cloud.crs().authid() == "EPSG:25832"
    counted = QgsPointCloudLayer.PointCloudStatisticsCalculationState.Calculated
    assert wait_for(lambda: cloud.statisticsCalculationState() == counted)
    counts = json.loads(bytes(cloud.statistics().toStatisticsJson()))
    counts = counts["stats"]["Classification"]["class-count"]
    assert counts == {"1": scene.count - scene.ground_count, "2": scene.ground_count}


@needs_copc
@pytest.mark.parametrize("how", ["layer", "id", "name"])
def test_a_layer_of_the_project_is_an_input(load, parameters, scene, tmp_path, how):
    parameters["OUTPUT"] = parameters["OUTPUT"].replace(".laz", ".copc.laz")
    _, layers = load(parameters)
    layer = layers["QgsPointCloudLayer"]
    import processing

    values = {"layer": layer, "id": layer.id(), "name": layer.name()}
    again = {"INPUT": values[how], "OUTPUT": str(tmp_path / "again.laz")}
    assert processing.run(ALGORITHM, again)["GROUND_COUNT"] == scene.ground_count


@needs_copc
def test_the_filter_of_a_layer_is_told_to_be_ignored(load, parameters, algorithm, context, log):
    parameters["OUTPUT"] = parameters["OUTPUT"].replace(".laz", ".copc.laz")
    _, layers = load(parameters)
    layer = layers["QgsPointCloudLayer"]
    assert layer.setSubsetString("Classification = 2")
    values = {"INPUT": layer, "OUTPUT": parameters["INPUT"].replace("scene", "again")}
    _, done = algorithm.run(values, context, log)
    assert done and "filter is not applied" in log.text


def test_in_a_thread_of_its_own(algorithm, parameters, scene, log):
    # As from the dialog: layers are announced by the thread, and loaded by the window's.
    context = QgsProcessingContext()
    context.setProject(QgsProject.instance())
    parameters["DTM"] = QgsProcessingOutputLayerDefinition(parameters["DTM"], QgsProject.instance())
    done = []
    task = QgsProcessingAlgRunnerTask(algorithm, parameters, context, log)
    task.executed.connect(lambda *result: done.append(result))
    QgsApplication.taskManager().addTask(task)
    assert wait_for(lambda: done)
    successful, results = done[0]
    assert successful and results["GROUND_COUNT"] == scene.ground_count
    details = context.layersToLoadOnCompletion()
    # Where it shows no .laz, a raster of the classes comes along.
    others = {path for path in details if path != results["DTM"]}
    assert all(path.endswith((".laz", "_classes.tif")) for path in others) and len(others) <= 1
    assert details[results["DTM"]].postProcessor() is not None


@pytest.mark.skipif(COPC, reason="this QGIS shows the points themselves")
@pytest.mark.parametrize("why", ["cancel", "error"])
def test_what_ends_after_the_outputs_does_not_say_that_there_are_none(
    why, parameters, algorithm, context, log, monkeypatch
):
    from bare_earth import BareEarthError
    from bare_earth.algorithms.tools.rasters import class_raster

    parts = class_raster.read_parts

    def ending(*arguments):
        if why == "error":
            raise BareEarthError("The disk is gone.")
        log.cancel()
        return parts(*arguments)

    monkeypatch.setattr(class_raster, "read_parts", ending)
    project = QgsProject.instance()
    parameters["DTM"] = QgsProcessingOutputLayerDefinition(parameters["DTM"], project)
    results, done = algorithm.run(parameters, context, log)
    assert done and results["GROUND_COUNT"] > 0
    assert log.isCanceled() == (why == "cancel")
    assert ("The disk is gone." in log.text) == (why == "error")
    assert "Cancelled" not in log.text
    (path,) = context.layersToLoadOnCompletion()
    assert path == results["DTM"]


@pytest.mark.skipif(
    "vpc" in QgsProviderRegistry.instance().providerList(), reason="this QGIS shows the points"
)
@pytest.mark.parametrize(
    ("name", "output"),
    [("classifytiles", {"OUTPUT_FOLDER": "out"}), ("pointcloudtoterrain", {"OUTPUT": "out.laz"})],
)
def test_the_classes_of_many_files_are_shown_as_one_raster(name, output, tmp_path, context):
    import processing

    (tmp_path / "tiles").mkdir()
    for place in range(2):
        origin = 500_000.0 + 100 * place, 5_700_000.0
        write_scene(tmp_path / "tiles" / f"{place}.laz", origin=origin)
    project = QgsProject.instance()
    outputs = {key: str(tmp_path / value) for key, value in output.items()}
    for key in ("DTM", "OUTPUT"):
        path = outputs.get(key, str(tmp_path / "dtm.tif"))
        outputs[key] = QgsProcessingOutputLayerDefinition(path, project)
    if name == "classifytiles":
        del outputs["OUTPUT"]
    values = {"INPUT_FOLDER": str(tmp_path / "tiles"), **outputs}
    processing.runAndLoadResults(f"bareearth:{name}", values)
    layers = {title_of(layer): layer for layer in project.mapLayers().values()}
    assert set(layers) == {"Classes", "Terrain model"}
    classes = layers["Classes"]
    assert [code.label for code in classes.renderer().classes()] == ["Ground", "Unclassified"]
    # Ground in both files, a roof in each, and nothing between them.
    west, south = 500_000.0, 5_700_000.0
    band = classes.dataProvider()
    found = {
        x: band.sample(QgsPointXY(west + x, south + 30.5), 1)
        for x in (10.5, 40.5, 90.5, 110.5, 140.5)
    }
    assert [found[x][0] for x in (10.5, 110.5)] == [2, 2]
    assert [found[x][0] for x in (40.5, 140.5)] == [1, 1]
    assert not found[90.5][1]


@needs_copc
@pytest.mark.parametrize("output_as", ["dimension", "z"])
def test_birds_do_not_make_the_colours_of_heights_pale(output_as, scene, context, tmp_path):
    import processing

    las = laspy.read(scene.path)
    las.classification[:] = np.where(scene.ground, 2, 1)
    bird = np.flatnonzero(~scene.ground)[::200]
    las.z[bird] = np.asarray(las.z)[bird] + 25.0
    las.write(str(scene.path))
    path = str(tmp_path / "heights.copc.laz")
    wanted = QgsProcessingOutputLayerDefinition(path, QgsProject.instance())
    parameters = {"INPUT": str(scene.path), "OUTPUT": wanted, "OUTPUT_AS": output_as}
    highest = processing.runAndLoadResults("bareearth:heightaboveground", parameters)["MAXIMUM"]
    renderer = next(iter(QgsProject.instance().mapLayers().values())).renderer()
    # The flat roof is 7.5 to 11 m above the tilted ground.
    assert highest > 30.0 and 7.5 < renderer.maximum() <= 11.5


def test_layers_of_a_temporary_cloud_are_named_after_its_input(scene, tmp_path):
    import processing

    project, context = QgsProject.instance(), QgsProcessingContext()
    context.setProject(project)
    temporary = {"OUTPUT": "TEMPORARY_OUTPUT"}
    values = {"INPUT": str(scene.path), **temporary}
    cloud = processing.run(ALGORITHM, values, context=context)["OUTPUT"]
    assert Path(cloud).name.startswith("OUTPUT.")
    values = {"INPUT": cloud, "DTM": "TEMPORARY_OUTPUT"}
    processing.runAndLoadResults("bareearth:terrainmodel", values, context=context)
    assert [layer.name() for layer in project.mapLayers().values()] == ["scene: Terrain model"]
    project.clear()
