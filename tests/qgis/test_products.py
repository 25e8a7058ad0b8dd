"""Heights above ground, key points and terrain models in the toolbox."""

import os
import shlex

import laspy
import numpy as np
import pytest
from osgeo import gdal
from qgis.core import (
    Qgis,
    QgsApplication,
    QgsPointCloudAttribute,
    QgsPointCloudLayer,
    QgsProcessingException,
    QgsProcessingParameterDefinition,
    QgsProject,
    QgsProviderRegistry,
)
from qgis.PyQt.QtWidgets import QTextEdit
from support import Log, layer_of, remove, write_scene

gdal.UseExceptions()

HEIGHT = "bareearth:heightaboveground"
ABOVE = "bareearth:classifyaboveground"
KEY_POINTS = "bareearth:modelkeypoints"
TERRAIN = "bareearth:terrainmodel"
WATER = "bareearth:waterclasses"
LAKE = "POLYGON((500002 5700060, 500012 5700060, 500012 5700070, 500002 5700070, 500002 5700060))"


@pytest.fixture
def out(tmp_path):
    (tmp_path / "out").mkdir()
    return tmp_path / "out"


@pytest.fixture
def labelled(scene):
    """The scene with its truth: ground 2, the building 6."""
    scene.with_classes(scene.path)
    return scene


def parameters_for(name, scene, out):
    files = ("dtm", "dsm", "chm", "hillshade") if name == TERRAIN else ()
    parameters = {"INPUT": str(scene.path), **{f.upper(): str(out / f"{f}.tif") for f in files}}
    return parameters if files else {**parameters, "OUTPUT": str(out / "out.laz")}


def plane(x, y):
    return 100 + 0.05 * (x - 500_000) + 0.02 * (y - 5_700_000)


@pytest.mark.parametrize("output_as", ["dimension", "z"])
def test_heights(labelled, out, output_as):
    import processing

    parameters = {**parameters_for(HEIGHT, labelled, out), "OUTPUT_AS": output_as}
    results = processing.run(HEIGHT, parameters)
    before, after = laspy.read(labelled.path), laspy.read(results["OUTPUT"])
    heights = after["HeightAboveGround"] if output_as == "dimension" else after.z
    expected = np.asarray(before.z) - plane(np.asarray(before.x), np.asarray(before.y))
    assert np.allclose(heights, expected, atol=0.002)
    assert results["POINT_COUNT"] == labelled.count
    assert results["GROUND_COUNT"] == labelled.ground_count
    assert results["MINIMUM"] == pytest.approx(expected.min(), abs=0.002)
    assert results["MAXIMUM"] == pytest.approx(expected.max(), abs=0.002)


def test_heights_above_a_raster_need_no_classes(labelled, out):
    import processing

    dtm = str(out / "dtm.tif")
    processing.run(TERRAIN, {"INPUT": str(labelled.path), "DTM": dtm})
    las = laspy.read(labelled.path)
    las.classification[:] = 0
    las.write(str(labelled.path))
    log = Log()
    parameters = {**parameters_for(HEIGHT, labelled, out), "DTM": dtm}
    results = processing.run(HEIGHT, parameters, feedback=log)
    expected = np.asarray(las.z) - plane(np.asarray(las.x), np.asarray(las.y))
    found = np.asarray(laspy.read(results["OUTPUT"])["HeightAboveGround"])
    # The raster is rounded and ends at the outermost cells.
    assert np.nanmax(np.abs(found - expected)) < 0.1 and np.isnan(found).mean() < 0.01
    assert results["GROUND_COUNT"] == 0
    assert f"--dtm {dtm}" in log.text
    with pytest.raises(QgsProcessingException):
        processing.run(HEIGHT, parameters_for(HEIGHT, labelled, out))


@pytest.mark.skipif(
    "pdal" in QgsProviderRegistry.instance().providerList(), reason="shows the points themselves"
)
@pytest.mark.parametrize("name", [HEIGHT, ABOVE, KEY_POINTS, WATER])
def test_a_dialog_shows_classes_where_it_cannot_show_points(labelled, out, name):
    import processing
    from processing.gui.AlgorithmDialog import AlgorithmDialog

    project = QgsProject.instance()
    dialog = AlgorithmDialog(QgsApplication.processingRegistry().createAlgorithmById(name))
    given = {"WATER": layer_of("Polygon", LAKE)} if name == WATER else {}
    project.addMapLayers(list(given.values()))
    values = {"INPUT": str(labelled.path), "OUTPUT": str(out / "out.las"), **given}
    dialog.setParameters(values)
    ended = []
    dialog.algorithmFinished.connect(lambda *done: ended.append(done))
    dialog.runButton().click()
    while not ended:
        QgsApplication.processEvents()
    # Without a dialog nobody would see the raster.
    processing.run(name, {**values, "OUTPUT": str(out / "script.las")})
    assert {path.name for path in out.glob("*.tif")} == {"out_classes.tif"}
    said = [widget.toPlainText() for widget in dialog.findChildren(QTextEdit)]
    assert ended[0][0] and "results dialog" not in "".join(said)
    (layer,) = project.mapLayersByName("scene: Classes")
    labels = [value.label for value in layer.renderer().classes()]
    assert labels[0] == "Ground" and len(labels) > 1
    remove(dialog)
    project.clear()


@pytest.mark.parametrize("mark", ["class", "flag"])
def test_key_points(labelled, out, mark):
    import processing

    parameters = {**parameters_for(KEY_POINTS, labelled, out), "MARK_AS": mark}
    results = processing.run(KEY_POINTS, parameters)
    after = laspy.read(results["OUTPUT"])
    keys = np.asarray(after.classification) == 8 if mark == "class" else after.key_point == 1
    assert np.count_nonzero(keys) == results["KEY_POINT_COUNT"] < 60
    assert results["GROUND_COUNT"] == labelled.ground_count
    assert not keys[~labelled.ground].any()


def test_rasters(labelled, out):
    import processing

    results = processing.run(TERRAIN, parameters_for(TERRAIN, labelled, out))
    rasters = {name: gdal.Open(results[name]) for name in ("DTM", "DSM", "CHM", "HILLSHADE")}
    dtm, dsm, chm, shade = (value.ReadAsArray() for value in rasters.values())
    rows, columns = np.mgrid[: dtm.shape[0], : dtm.shape[1]]
    west, _, _, north, _, _ = rasters["DTM"].GetGeoTransform()
    terrain = plane(west + columns + 0.5, north - rows - 0.5)
    inside = np.s_[2:-2, 2:-2]
    assert np.allclose(dtm[inside], terrain[inside], atol=0.01)
    assert dsm.max() == 112.0 and shade.max() > 0
    # The surface is the highest point of a cell of 1 m, on a slope of 5 % and a level roof.
    assert np.allclose(chm[inside], np.maximum(dsm - dtm, 0)[inside], atol=0.06)
    assert "25832" in rasters["CHM"].GetProjection()
    assert results["SURFACE_COUNT"] == labelled.count


def test_four_lights_are_those_of_gdal(labelled, out):
    import processing

    las = laspy.read(labelled.path)
    las.z = 100 + 6 * np.sin(np.asarray(las.x) / 5) + 4 * np.cos(np.asarray(las.y) / 7)
    las.classification[:] = 2
    las.write(str(labelled.path))
    paths = parameters_for(TERRAIN, labelled, out)
    lit = []
    for light in ("multidirectional", "one"):
        processing.run(TERRAIN, {**paths, "HILLSHADE_LIGHT": light})
        lit.append(gdal.Open(paths["HILLSHADE"]).ReadAsArray().astype(int)[2:-2, 2:-2])
    expected = str(out / "expected.tif")
    gdal.DEMProcessing(expected, paths["DTM"], "hillshade", multiDirectional=True)
    expected = gdal.Open(expected).ReadAsArray().astype(int)[2:-2, 2:-2]
    assert np.ptp(expected) > 150
    assert np.abs(lit[0] - expected).max() <= 1
    assert np.abs(lit[1] - expected).max() > 50


def test_classes_above_the_ground(scene, out):
    import processing

    scene.with_classes(scene.path, other=1)
    path = str(out / "classes.laz")
    result = processing.run(ABOVE, {"INPUT": str(scene.path), "OUTPUT": path})
    classes = np.asarray(laspy.read(path).classification)
    assert np.array_equal(classes == 2, scene.ground)
    assert np.mean(classes[~scene.ground] == 6) > 0.9  # the building
    assert result["CHANGED_COUNT"] == np.count_nonzero(~scene.ground)
    assert result["POINT_COUNT"] == len(classes)


@pytest.mark.parametrize("name", [HEIGHT, KEY_POINTS, ABOVE, TERRAIN])
def test_the_log_tells_the_same_command_line(registry, labelled, out, context, log, name):
    from bare_earth.algorithms.cli import main

    parameters = {**parameters_for(name, labelled, out), "GROUND_CLASSES": "2, 9"}
    results, done = registry.createAlgorithmById(name).run(parameters, context, log)
    assert done, log.text
    before = {path: (out / path).read_bytes() for path in os.listdir(out)}
    command = next(shlex.split(line) for line in log.said if line.startswith("bare-earth "))
    assert "--ground-classes" in command
    assert main(command[1:]) == 0
    same = {path: (out / path).read_bytes() for path in os.listdir(out)}
    if name == TERRAIN:  # with another library the bytes of a GeoTIFF may differ
        same, before = set(same), set(before)
    assert same == before and results


@pytest.mark.parametrize("name", [HEIGHT, KEY_POINTS, ABOVE, TERRAIN])
def test_cancel_leaves_nothing(registry, labelled, out, context, name):
    for percent in (0, 20, 70):
        log = Log(cancel_at=percent)
        parameters = parameters_for(name, labelled, out)
        results, _ = registry.createAlgorithmById(name).run(parameters, context, log)
        assert results == {} and os.listdir(out) == []
        assert not context.layersToLoadOnCompletion()


@pytest.mark.parametrize("name", [HEIGHT, KEY_POINTS, ABOVE, TERRAIN])
def test_no_ground_is_told(scene, out, name):
    import processing

    with pytest.raises(QgsProcessingException, match=r"Classify .*ground first"):
        processing.run(name, parameters_for(name, scene, out))
    assert os.listdir(out) == []


def test_a_raster_must_be_made(registry, labelled, context, log):
    algorithm = registry.createAlgorithmById(TERRAIN)
    _, done = algorithm.run({"INPUT": str(labelled.path)}, context, log)
    assert not done and "at least one raster" in log.text
    optional = QgsProcessingParameterDefinition.Flag.FlagOptional
    for name in ("DTM", "DSM", "CHM", "HILLSHADE"):
        assert algorithm.parameterDefinition(name).flags() & optional


def test_a_wrong_value_is_refused_before_anything_runs(registry, labelled, out, context):
    algorithm = registry.createAlgorithmById(KEY_POINTS)
    parameters = {**parameters_for(KEY_POINTS, labelled, out), "TOLERANCE_ABOVE": -1}
    possible, text = algorithm.checkParameterValues(parameters, context)
    assert not possible and "Tolerance above" in text and "0 m" in text


@pytest.mark.skipif(
    "copc" not in QgsProviderRegistry.instance().providerList(),
    reason=f"QGIS {Qgis.QGIS_VERSION} of this build loads no point clouds",
)
def test_qgis_knows_the_heights(labelled, out):
    import processing

    path = str(out / "heights.copc.laz")
    processing.run(HEIGHT, {"INPUT": str(labelled.path), "OUTPUT": path})
    layer = QgsPointCloudLayer(path, "heights", "copc")
    assert layer.isValid()
    heights = layer.attributes().find("HeightAboveGround")[0]
    assert heights.type() == QgsPointCloudAttribute.DataType.Float


def test_a_terrain_model_respects_lines_and_polygons(labelled, out):
    import processing

    las = laspy.read(labelled.path)
    las.classification[:] = 2  # the building, too
    las.write(str(labelled.path))
    x, y = np.asarray(las.x)[~labelled.ground], np.asarray(las.y)[~labelled.ground]
    west, south, east, north = x.min() - 1, y.min() - 1, x.max() + 1, y.max() + 1
    ring = f"{west} {south}, {east} {south}, {east} {north}, {west} {north}, {west} {south}"
    house = layer_of("Polygon", f"POLYGON(({ring}))")
    line = layer_of("LineStringZ", f"LINESTRINGZ({west} {south - 9} 110, {east} {south - 9} 110)")

    def heights(**layers):
        parameters = {"INPUT": str(labelled.path), "DTM": str(out / "dtm.tif"), **layers}
        processing.run(TERRAIN, parameters)
        raster = gdal.Open(str(out / "dtm.tif"))
        left, size, _, top, _, _ = raster.GetGeoTransform()
        values = raster.ReadAsArray()
        truth = plane(
            left + (np.arange(values.shape[1]) + 0.5) * size,
            (top - (np.arange(values.shape[0]) + 0.5) * size)[:, None],
        )
        return np.where(values == raster.GetRasterBand(1).GetNoDataValue(), np.nan, values) - truth

    assert np.nanmax(heights()) > 2.0
    assert np.nanmax(np.abs(heights(NO_GROUND=house))) < 0.3
    assert np.nanmax(heights(NO_GROUND=house, BREAKLINES=line)) > 3.0


@pytest.mark.parametrize("name", ["tindensification", "heightaboveground", "modelkeypoints"])
def test_without_an_output_it_says_what_to_choose(name, scene, registry, context, log):
    """As a step of a model whose output was not given."""
    algorithm = registry.createAlgorithmById(f"bareearth:{name}")
    _, done = algorithm.run({"INPUT": str(scene.path)}, context, log)
    label = algorithm.parameterDefinition("OUTPUT").description()
    assert not done and f"file: {label}." in log.text


@pytest.mark.parametrize("name", [HEIGHT, KEY_POINTS, ABOVE, WATER])
def test_a_folder_is_one_survey_and_becomes_a_folder(registry, tmp_path, out, name):
    import processing

    (tmp_path / "in").mkdir()
    for number in range(2):
        path = tmp_path / "in" / f"{number}.laz"
        ground = write_scene(path, origin=(500_000.0 + 80 * number, 5_700_000.0))
        las = laspy.read(path)
        las.classification[:] = np.where(ground, 2, 1)
        las.write(str(path))
    log, ring = Log(), "500070 5700010, 500090 5700010, 500090 5700020, 500070 5700010"
    given = {"WATER": layer_of("Polygon", f"Polygon(({ring}))")} if name == WATER else {}
    words = {"INPUT": str(tmp_path / "in"), "OUTPUT": str(out / "many.laz"), **given}
    results = processing.run(name, words, feedback=log)
    made = sorted((out / "many").glob("*.laz"))
    assert [file.name for file in made] == [
        "0.laz",
        "1.laz",
    ] and "2 of 2 files are done" in log.text
    assert results["OUTPUT"].endswith(".vpc") and os.path.exists(results["OUTPUT"])
    assert results["POINT_COUNT"] == 51_200 and not (out / "many.laz").exists()
    if name == HEIGHT:
        assert -0.01 < results["MINIMUM"] < 0.01 < 8.0 < results["MAXIMUM"]
    if name == WATER:
        classes = [np.asarray(laspy.read(file).classification) for file in made]
        counts = [np.count_nonzero(value == 9) for value in classes]
        assert min(counts) > 50 and sum(counts) == results["WATER_COUNT"]
