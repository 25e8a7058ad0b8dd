import json
import shlex

import laspy
import numpy as np
import pytest
from qgis.core import (
    QgsPointCloudLayer,
    QgsPointXY,
    QgsProcessingException,
    QgsProcessingOutputLayerDefinition,
    QgsProject,
    QgsProviderRegistry,
    QgsRasterLayer,
)
from support import Log, title_of, write_scene

NAME = "bareearth:classifytiles"


@pytest.fixture
def tiles(registry):
    return registry.createAlgorithmById(NAME)


@pytest.fixture
def folder(tmp_path):
    """Four tiles in a row, each with a building, and their true ground."""
    folder = tmp_path / "in"
    folder.mkdir()
    for number in range(4):
        path = folder / f"{number}.laz"
        write_scene(path, origin=(500_000.0 + 80.0 * number, 5_700_000.0))
        cloud = laspy.read(path)
        cloud.z = cloud.z + 0.05 * 80.0 * number  # one slope over all of them
        cloud.write(str(path))
    return folder


def truth(folder):
    return write_scene(folder.parent / "scene.las")


def check(results, folder):
    for number in range(4):
        cloud = laspy.read(f"{results['OUTPUT_FOLDER']}/{number}.laz")
        wrong = (np.asarray(cloud.classification) == 2) != truth(folder)
        assert np.mean(wrong) < 0.02
    assert results["TILE_COUNT"] == results["DONE_COUNT"] == 4
    assert results["POINT_COUNT"] == 4 * len(truth(folder))


def test_a_folder_is_classified_and_the_log_says_how_to_repeat_it(tiles, folder, context, log):
    from bare_earth.algorithms.cli import main

    out = folder.parent / "out"
    parameters = {"INPUT_FOLDER": str(folder), "OUTPUT_FOLDER": str(out)}
    results, done = tiles.run(parameters, context, log)
    assert done, log.text
    check(results, folder)
    listed = json.loads((out / "classified.vpc").read_text())
    assert results["OUTPUT_VPC"] == str(out / "classified.vpc")
    assert [value["assets"]["data"]["href"] for value in listed["features"]] == [
        f"./{number}.laz" for number in range(4)
    ]
    assert "0.laz: 23,728 of 25,600 points" in log.text and "4 of 4 files are done" in log.text
    loaded = str(out / "classified.vpc") in context.layersToLoadOnCompletion()
    assert loaded == ("vpc" in QgsProviderRegistry.instance().providerList())
    told = f"This QGIS cannot show such a file as a layer. It is at {out / 'classified.vpc'}."
    assert (told in log.text) == (not loaded)
    if loaded:
        layer = QgsPointCloudLayer(results["OUTPUT_VPC"], "Classified", "vpc")
        assert layer.isValid() and layer.crs().authid() == "EPSG:25832"
    before = {path.name: path.read_bytes() for path in out.glob("*.laz")}
    command = next(shlex.split(line) for line in log.said if line.startswith("bare-earth "))
    assert main(command[1:]) == 0
    assert {path.name: path.read_bytes() for path in out.glob("*.laz")} == before


def test_files_methods_and_going_on(tiles, folder, context, log):
    out = folder.parent / "out"
    parameters = {
        "INPUT": [str(folder / f"{number}.laz") for number in range(4)],
        "METHOD": "slope",
        "PRESET": "town",
        "OUTPUT_FOLDER": str(out),
        "OUTPUT_VPC": str(folder.parent / "all.vpc"),
    }
    results, done = tiles.run(parameters, context, log)
    assert done, log.text
    check(results, folder)
    assert results["KEPT_COUNT"] == 0 and (folder.parent / "all.vpc").is_file()
    assert "--method slope --preset town" in log.text
    results, done = tiles.run({**parameters, "RESUME": True, "THREADS": 1}, context, log)
    assert done and results["KEPT_COUNT"] == 4
    # A virtual point cloud is an input, too.
    again = {"INPUT": [str(folder.parent / "all.vpc")], "OUTPUT_FOLDER": str(out) + "2"}
    results, done = tiles.run(again, context, log)
    assert done
    check(results, folder)


def test_a_broken_file_is_told_and_the_others_are_done(tiles, folder, context, log):
    (folder / "broken.laz").write_bytes(b"nothing")
    parameters = {"INPUT_FOLDER": str(folder), "OUTPUT_FOLDER": str(folder.parent / "out")}
    results, done = tiles.run(parameters, context, log)
    assert done and results["DONE_COUNT"] == 4 and results["TILE_COUNT"] == 5
    assert f"{folder / 'broken.laz'} is left out" in log.text


@pytest.mark.parametrize("given", [{}, {"INPUT": ["/no/such.laz"]}, {"INPUT_FOLDER": "/no"}])
def test_what_is_not_there_is_refused_before_anything_runs(given, tiles, tmp_path, context):
    allowed, text = tiles.checkParameterValues({**given, "OUTPUT_FOLDER": str(tmp_path)}, context)
    assert not allowed and ("does not exist" in text or "Choose point clouds" in text)


def test_where_nothing_can_be_classified_it_fails(tiles, tmp_path, context, log):
    (tmp_path / "in").mkdir()
    write_scene(tmp_path / "in" / "a.las", epsg=4326)
    parameters = {"INPUT_FOLDER": str(tmp_path / "in"), "OUTPUT_FOLDER": str(tmp_path / "out")}
    with pytest.raises(QgsProcessingException, match="projected CRS"):
        tiles.run(parameters, context, log, {}, False)


def test_a_cancel_keeps_what_is_finished(tiles, folder, context):
    out = folder.parent / "out"

    class Impatient(Log):
        def pushInfo(self, text):
            super().pushInfo(text)
            if ".laz:" in text:
                self.cancel()

    log = Impatient()
    parameters = {"INPUT_FOLDER": str(folder), "OUTPUT_FOLDER": str(out), "THREADS": 1}
    results, _ = tiles.run(parameters, context, log)
    assert not results and "The finished tiles stay" in log.text
    names = [path.name for path in out.iterdir() if path.suffix == ".laz"]
    assert 1 <= len(names) < 4 and not (out / "classified.vpc").exists()
    assert not [name for name in names if ".~" in name]
    results, done = tiles.run({**parameters, "RESUME": True}, context, Log())
    assert done and results["KEPT_COUNT"] >= 1
    check(results, folder)


@pytest.mark.parametrize("algorithm", [NAME, "bareearth:terrainmodel"])
def test_each_file_gets_its_own_rasters_and_one_layer_shows_them(
    algorithm, folder, tmp_path, context
):
    import processing

    parameters = {"INPUT_FOLDER": str(folder), "OUTPUT_FOLDER": str(tmp_path / "out")}
    if algorithm != NAME:
        processing.run(NAME, parameters)
        parameters = {"INPUT": str(tmp_path / "out")}
    project = QgsProject.instance()
    project.clear()
    dtm = tmp_path / "heights.tif"
    parameters["DTM"] = QgsProcessingOutputLayerDefinition(str(dtm), project)
    results = processing.runAndLoadResults(algorithm, {**parameters, "RASTER_PER_FILE": True})
    assert results["DTM"] == str(tmp_path / "heights.vrt") and not dtm.exists()
    parts = sorted((tmp_path / "heights").iterdir())
    assert [part.name for part in parts] == [f"{number}.tif" for number in range(4)]
    rasters = (layer for layer in project.mapLayers().values() if isinstance(layer, QgsRasterLayer))
    # Beside the classes, where this QGIS shows no points.
    (layer,) = (raster for raster in rasters if title_of(raster) != "Classes")
    assert layer.isValid() and layer.name().endswith("Terrain model")
    height, found = layer.dataProvider().sample(QgsPointXY(500_200.5, 5_700_040.5), 1)
    assert found and height == pytest.approx(100 + 0.05 * 200.5 + 0.02 * 40.5, abs=0.02)
