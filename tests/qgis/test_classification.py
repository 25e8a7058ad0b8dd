import importlib.util
import json
import os
import re
import shlex
import shutil

import laspy
import numpy as np
import pytest
from osgeo import gdal
from qgis.core import QgsProcessingException, QgsProject, QgsRasterLayer
from support import ALGORITHM, Log, write_scene

gdal.UseExceptions()


def everything(scene, folder, suffix=".laz"):
    return {
        "INPUT": str(scene.path),
        "OUTPUT": str(folder / f"ground{suffix}"),
        "DTM": str(folder / "dtm.tif"),
        "HILLSHADE": str(folder / "hillshade.tif"),
    }


@pytest.fixture
def out(tmp_path):
    (tmp_path / "out").mkdir()
    return tmp_path / "out"


def check(scene, results):
    assert results["POINT_COUNT"] == results["SELECTED_COUNT"] == scene.count
    assert results["GROUND_COUNT"] == scene.ground_count
    cloud = laspy.read(results["OUTPUT"])
    assert np.array_equal(np.asarray(cloud.classification) == 2, scene.ground)
    dtm = gdal.Open(results["DTM"])
    west, width, _, north, _, height = dtm.GetGeoTransform()
    heights = dtm.ReadAsArray()
    rows, columns = np.nonzero(heights != dtm.GetRasterBand(1).GetNoDataValue())
    x, y = (columns + 0.5) * width + west - 500_000, (rows + 0.5) * height + north - 5_700_000
    # Under the building, too, the terrain is the plane.
    assert np.allclose(heights[rows, columns], 100 + 0.05 * x + 0.02 * y, atol=0.01)
    assert len(rows) > 6000
    assert "25832" in dtm.GetProjection()


def test_run(algorithm, any_scene, out, context, log):
    parameters = everything(any_scene, out, any_scene.path.suffix)
    results, done = algorithm.run(parameters, context, log)
    assert done
    check(any_scene, results)
    assert gdal.Open(results["HILLSHADE"]).ReadAsArray().max() > 0
    assert log.progress() == 100
    assert "points are ground" in log.text


@pytest.mark.parametrize("name", ["gridminimum", "slopefilter"])
def test_run_of_the_other_methods(name, registry, scene, out, context, log):
    from bare_earth.algorithms.cli import main

    algorithm = registry.createAlgorithmById(f"bareearth:{name}")
    results, done = algorithm.run(everything(scene, out), context, log)
    assert done, log.text
    # Of the points at the foot of the walls some may be missed.
    assert abs(results["GROUND_COUNT"] - scene.ground_count) < 0.01 * scene.count
    cloud = laspy.read(results["OUTPUT"])
    assert np.mean((np.asarray(cloud.classification) == 2) != scene.ground) < 0.01
    assert os.path.getsize(results["DTM"]) and os.path.getsize(results["HILLSHADE"])
    with open(results["OUTPUT"], "rb") as file:
        before = file.read()
    command = next(shlex.split(line) for line in log.said if line.startswith("bare-earth "))
    assert main(command[1:]) == 0
    with open(results["OUTPUT"], "rb") as file:
        assert file.read() == before


@pytest.mark.parametrize("name", ["gridminimum", "slopefilter"])
def test_lists_and_empty_fields_of_the_other_methods(name, registry, scene, out, context, log):
    algorithm = registry.createAlgorithmById(f"bareearth:{name}")
    parameters = {**everything(scene, out), "HEIGHT_THRESHOLDS": "6, 2", "SEARCH_RADIUS": None}
    results, done = algorithm.run(parameters, context, log)
    assert done and results["GROUND_COUNT"] > 0
    told = "--height-thresholds 6 2" in log.text
    assert told == (name == "gridminimum")
    parameters["HEIGHT_THRESHOLDS"], parameters["SEARCH_RADIUS"] = "2, 6", -1
    possible, text = algorithm.checkParameterValues(parameters, context)
    assert not possible and ("largest" in text or "at least" in text)


@pytest.mark.parametrize("name", ["tindensification", "gridminimum", "slopefilter"])
def test_ground_only_with_heights(name, registry, scene, out, context, log):
    from bare_earth.algorithms.cli import main

    algorithm = registry.createAlgorithmById(f"bareearth:{name}")
    wanted = {"GROUND_ONLY": True, "HEIGHT_ABOVE_GROUND": True}
    results, done = algorithm.run({**everything(scene, out), **wanted}, context, log)
    assert done, log.text
    cloud = laspy.read(results["OUTPUT"])
    assert len(cloud.points) == results["GROUND_COUNT"] < results["POINT_COUNT"] == scene.count
    assert set(np.unique(cloud.classification)) == {2}
    assert np.allclose(cloud["HeightAboveGround"], 0.0, atol=1e-3)
    assert "points that are not ground" in log.text
    with open(results["OUTPUT"], "rb") as file:
        before = file.read()
    command = next(shlex.split(line) for line in log.said if line.startswith("bare-earth "))
    assert main(command[1:]) == 0
    with open(results["OUTPUT"], "rb") as file:
        assert file.read() == before


def test_processing_run(scene, out):
    import processing

    results = processing.run(ALGORITHM, everything(scene, out))
    check(scene, results)


def test_what_is_not_asked_for_is_not_made(scene, out):
    import processing

    parameters = {"INPUT": str(scene.path), "OUTPUT": str(out / "ground.las")}
    results = processing.run(ALGORITHM, parameters)
    assert "DTM" not in results and "HILLSHADE" not in results
    assert os.listdir(out) == ["ground.las"]


def test_temporary_outputs(scene):
    import processing

    parameters = {"INPUT": str(scene.path), "OUTPUT": "TEMPORARY_OUTPUT", "DTM": "TEMPORARY_OUTPUT"}
    results = processing.run(ALGORITHM, parameters)
    assert results["GROUND_COUNT"] == scene.ground_count
    assert os.path.getsize(results["OUTPUT"]) and results["DTM"].endswith(".tif")


def test_qgis_process(scene, out, tmp_path, qgis_process):
    parameters = [f"{name}={value}" for name, value in everything(scene, out).items()]
    done = qgis_process("--json", "run", ALGORITHM, "--", *parameters, "STOP_EDGE=")
    assert done.returncode == 0, done.stderr
    check(scene, json.loads(done.stdout[done.stdout.index("{") :])["results"])
    parameters[0] = f"INPUT={tmp_path / 'missing.laz'}"
    done = qgis_process("run", ALGORITHM, "--", *parameters)
    assert done.returncode != 0
    assert "does not exist" in done.stdout + done.stderr
    assert "Traceback" not in done.stdout + done.stderr


def test_the_log_tells_the_same_command_line(algorithm, scene, out, context, log):
    from bare_earth.algorithms.cli import main

    parameters = {
        **everything(scene, out), "MAX_BUILDING_SIZE": 30, "STOP_EDGE": None,
        "FROM_CLASSES": "1, 2", "TO_CLASS": 8, "OTHERS": "unclassified",
    }  # fmt: skip
    results, done = algorithm.run(parameters, context, log)
    assert done
    with open(results["OUTPUT"], "rb") as file:
        before = file.read()
    command = next(shlex.split(line) for line in log.said if line.startswith("bare-earth "))
    assert main(command[1:]) == 0
    with open(results["OUTPUT"], "rb") as file:
        assert file.read() == before


@pytest.mark.parametrize("chosen", [None, "", "all", "1, 9"])
def test_classes_with_a_meaning_stay_unless_they_are_given(
    registry, scene, out, context, log, chosen
):
    algorithm = registry.createAlgorithmById(ALGORITHM)
    las = laspy.read(scene.path)
    water = np.asarray(las.x) > np.median(las.x)
    las.classification[:] = np.where(water, 9, 1)
    las.write(str(scene.path))
    results, done = algorithm.run({**everything(scene, out), "FROM_CLASSES": chosen}, context, log)
    assert done
    stays = (np.asarray(laspy.read(results["OUTPUT"]).classification)[water] == 9).all()
    assert stays == (not chosen)
    assert ("of class 9 (water) keep" in log.text) == (not chosen)


def test_parameters_reach_the_classifier(algorithm, scene, out, context, log):
    parameters = {**everything(scene, out), "MAX_BUILDING_SIZE": 2, "TO_CLASS": 9}
    results, done = algorithm.run(parameters, context, log)
    # A building much wider than the largest one stays.
    assert done and results["GROUND_COUNT"] > scene.ground_count
    assert set(np.unique(laspy.read(results["OUTPUT"]).classification)) <= {1, 9}


def test_cancel_leaves_nothing(registry, scene, out, context):
    def run(log):
        algorithm = registry.createAlgorithmById(ALGORITHM)
        return algorithm.run(everything(scene, out), context, log)[0]

    whole = Log()
    run(whole)
    for name in os.listdir(out):
        os.remove(out / name)
    moments = sorted({moment for moment in whole.moments if moment < 100})
    assert len(moments) > 6
    # The first, the last, and some between.
    for percent in {*moments[:: len(moments) // 6], moments[-1]}:
        log = Log(cancel_at=percent)
        assert run(log) == {}, percent
        assert os.listdir(out) == []
        assert not context.layersToLoadOnCompletion()
        assert "Cancelled" in log.text


BAD_INPUTS = {
    "missing": (lambda path: None, "does not exist"),
    "empty": (lambda path: path.write_bytes(b""), ""),
    "text": (lambda path: path.write_text("not a point cloud"), ""),
    "folder": (lambda path: path.mkdir(), "folder"),
    "cut off": (lambda path: cut_off(path), "damaged"),
    "geographic": (lambda path: write_scene(path, 4326, (9.0, 50.0)), "not in a projected CRS"),
}


def cut_off(path):
    write_scene(path)
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])


@pytest.mark.parametrize("kind", BAD_INPUTS)
def test_a_bad_input_gives_one_line_and_leaves_nothing(kind, algorithm, tmp_path, out, scene):
    import processing

    make, word = BAD_INPUTS[kind]
    path = tmp_path / "bad.laz"
    make(path)
    log = Log()
    with pytest.raises(QgsProcessingException) as error:
        processing.run(ALGORITHM, {**everything(scene, out), "INPUT": str(path)}, feedback=log)
    text = str(error.value)
    assert "bad.laz" in text and word in text
    assert "Traceback" not in text + log.text and "The same without QGIS" not in log.text
    # QGIS itself puts a line before what fails the check of the values.
    assert "\n" not in text.replace("Unable to execute algorithm\n", "")
    assert os.listdir(out) == []


def test_a_missing_decompressor_is_told(algorithm, scene, out, context, log, monkeypatch):
    find = importlib.util.find_spec
    monkeypatch.setattr(
        importlib.util, "find_spec", lambda name, *_: None if name == "lazrs" else find(name)
    )
    assert algorithm.provider().supportedOutputPointCloudLayerExtensions() == ["las"]
    _, done = algorithm.run(everything(scene, out, ".las"), context, log)
    assert not done
    assert "needs lazrs" in log.text and "LAZ support" in log.text
    assert os.listdir(out) == []


def test_the_input_is_not_overwritten(scene, out):
    import processing

    before = scene.path.read_bytes()
    with pytest.raises(QgsProcessingException, match="same file"):
        processing.run(ALGORITHM, {**everything(scene, out), "OUTPUT": str(scene.path)})
    assert scene.path.read_bytes() == before


def test_other_layers_are_refused(algorithm, scene, out, context, log):
    import processing

    dtm = processing.run(ALGORITHM, everything(scene, out))["DTM"]
    layer = QgsRasterLayer(dtm, "terrain")
    QgsProject.instance().addMapLayer(layer)
    for value in (layer, layer.id(), "terrain"):
        parameters = {**everything(scene, out), "INPUT": value}
        possible, text = algorithm.checkParameterValues(parameters, context)
        assert not possible and "not a point cloud" in text


def test_values_out_of_range_are_refused(algorithm, scene, out, context):
    parameters = {**everything(scene, out), "MAX_BUILDING_SIZE": -1}
    possible, text = algorithm.checkParameterValues(parameters, context)
    assert not possible and text == "Maximum building size must be at least 1 m, not -1.0."


def test_real_surveys(algorithm, data, out, context):
    if data is None:
        pytest.skip("the labelled point clouds are not there (BARE_EARTH_DATA)")
    path = data / "isprs" / "samp11.laz"
    truth = np.asarray(laspy.read(path).classification) == 2
    parameters = {"INPUT": str(path), "OUTPUT": str(out / "o.laz"), "DTM": str(out / "dtm.tif")}
    results, done = algorithm.run(parameters, context, Log())
    assert done and results["POINT_COUNT"] == len(truth)
    found = np.asarray(laspy.read(results["OUTPUT"]).classification) == 2
    assert np.mean(found != truth) < 0.25
    assert os.path.getsize(results["DTM"])


def test_the_log_ends_with_what_was_done(algorithm, scene, out, context, log):
    from bare_earth.algorithms.cli import main

    results, done = algorithm.run(everything(scene, out), context, log)
    assert done
    end = log.text[log.text.index("Class 2") :].splitlines()
    share = scene.ground_count / scene.count
    assert end[0] == f"Class 2 (ground): {scene.ground_count:,} points ({share:.1%})"
    assert end[1].startswith("Class 1 (") and end[1].endswith(f" points ({1 - share:.1%})")
    assert re.match("Chosen automatically: .*maximum building size [0-9.]+ m", end[2])
    assert re.fullmatch(r"Time: [0-9]+\.[0-9] s", end[3])
    assert end[4] == "The same without QGIS:" and len(end) == 6
    with open(results["OUTPUT"], "rb") as file:
        before = file.read()
    assert main(shlex.split(end[5])[1:]) == 0
    with open(results["OUTPUT"], "rb") as file:
        assert file.read() == before


def test_a_run_that_is_cancelled_says_how_to_do_it_elsewhere(algorithm, scene, out, context):
    log = Log(cancel_at=50)
    algorithm.run(everything(scene, out), context, log)
    assert log.said[-1].startswith("bare-earth classify ")
    assert "Class 2" not in log.text


@pytest.mark.parametrize("how", ["file", "folder"])
def test_points_above_the_ground_get_classes_in_the_same_run(scene, tmp_path, how):
    import processing

    tiles, written = tmp_path / "tiles", tmp_path / "out" / "scene.laz"
    tiles.mkdir()
    written.parent.mkdir()
    shutil.copy(scene.path, tiles / "scene.laz")
    if how == "file":
        given = {"INPUT": str(scene.path), "OUTPUT": str(written)}
        processing.run(ALGORITHM, {**given, "ABOVE_GROUND": "asprs"})
    else:
        given = {"INPUT_FOLDER": str(tiles), "OUTPUT_FOLDER": str(written.parent)}
        processing.run("bareearth:classifytiles", {**given, "ABOVE_GROUND": "asprs"})
    found = np.asarray(laspy.read(str(written)).classification)
    assert np.array_equal(found == 2, scene.ground) and np.mean(found[~scene.ground] == 6) > 0.95
