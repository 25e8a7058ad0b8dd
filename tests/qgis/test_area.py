"""Extent and boundary of the classifications: which points change, in whatever CRS they are."""

import json
import shlex

import laspy
import numpy as np
import pytest
from qgis.core import (
    QgsCoordinateReferenceSystem,
    QgsCoordinateTransform,
    QgsFeature,
    QgsGeometry,
    QgsProcessingException,
    QgsProcessingFeatureSourceDefinition,
    QgsProject,
    QgsReferencedRectangle,
    QgsVectorLayer,
)
from support import write_scene

EAST, NORTH = 500_000.0, 5_700_000.0
SLOPE = "bareearth:slopefilter"
# A triangle with a hole.
TRIANGLE = (
    "Polygon ((500010 5700010, 500070 5700010, 500010 5700070, 500010 5700010),"
    " (500020 5700020, 500030 5700020, 500030 5700030, 500020 5700030, 500020 5700020))"
)


@pytest.fixture
def local(registry):
    return registry.createAlgorithmById(SLOPE)


@pytest.fixture
def parameters(scene, tmp_path):
    # No ground that was there before: all that changes gets class 9 or 1.
    las = laspy.read(scene.path)
    las.classification[:] = 5
    las.write(str(scene.path))
    return {
        "INPUT": str(scene.path), "OUTPUT": str(tmp_path / "out.laz"), "TO_CLASS": 9,
        "OTHERS": "unclassified",
    }  # fmt: skip


def changed(results):
    las = laspy.read(results["OUTPUT"])
    x, y = np.asarray(las.x) - EAST, np.asarray(las.y) - NORTH
    return x, y, np.asarray(las.classification) != 5


def layer_of(wkts, epsg=25832, kind="Polygon"):
    layer = QgsVectorLayer(f"{kind}?crs=EPSG:{epsg or 25832}", "areas", "memory")
    if epsg is None:
        layer.setCrs(QgsCoordinateReferenceSystem())
    features = []
    for wkt in wkts:
        geometry = QgsGeometry.fromWkt(wkt)
        if epsg not in (25832, None):
            geometry = geometry.densifyByDistance(1.0)
            geometry.transform(to(epsg))
        if kind == "PolygonZ":
            geometry.get().addZValue(7.0)
        feature = QgsFeature()
        feature.setGeometry(geometry)
        features.append(feature)
    layer.dataProvider().addFeatures(features)
    QgsProject.instance().addMapLayer(layer)
    return layer


def to(epsg):
    crs = (QgsCoordinateReferenceSystem.fromEpsgId(value) for value in (25832, epsg))
    return QgsCoordinateTransform(*crs, QgsProject.instance())


def in_triangle(x, y):
    hole = (x > 20) & (x < 30) & (y > 20) & (y < 30)
    return (x > 10) & (y > 10) & (x + y < 80) & ~hole


def test_an_extent_limits_what_changes(local, parameters, context, log):
    extent = f"{EAST + 10},{EAST + 30.1},{NORTH + 20},{NORTH + 60.1} [EPSG:25832]"
    results, done = local.run({**parameters, "EXTENT": extent}, context, log)
    assert done, log.text
    x, y, found = changed(results)
    assert np.array_equal(found, (x >= 10) & (x <= 30.1) & (y >= 20) & (y <= 60.1))
    assert results["AREA_COUNT"] == results["SELECTED_COUNT"] == found.sum()
    assert results["POINT_COUNT"] == len(found)
    assert f"of {found.sum():,} points in the area" in log.text


def test_an_extent_in_another_crs_is_transformed(local, parameters, context, log):
    box = QgsGeometry.fromWkt(
        f"Polygon (({EAST + 10} {NORTH + 10}, {EAST + 40} {NORTH + 10}, {EAST + 40} {NORTH + 40},"
        f" {EAST + 10} {NORTH + 40}, {EAST + 10} {NORTH + 10}))"
    )
    box.transform(to(4326))
    crs = QgsCoordinateReferenceSystem.fromEpsgId(4326)
    extent = QgsReferencedRectangle(box.boundingBox(), crs)
    results, done = local.run({**parameters, "EXTENT": extent}, context, log)
    assert done, log.text
    x, y, found = changed(results)
    # The bounding box of a turned rectangle is a bit larger.
    assert found[(x > 10) & (x < 40) & (y > 10) & (y < 40)].all()
    assert not found[(x < 9) | (x > 41) | (y < 9) | (y > 41)].any()


@pytest.mark.parametrize("epsg", [25832, 4326, None])
def test_a_boundary_limits_what_changes(epsg, local, parameters, context, log):
    parameters["BOUNDARY"] = layer_of([TRIANGLE], epsg)
    results, done = local.run(parameters, context, log)
    assert done, log.text
    x, y, found = changed(results)
    near = np.abs(x + y - 80) < 0.1 if epsg == 4326 else np.zeros(len(x), bool)
    assert np.array_equal(found[~near], in_triangle(x, y)[~near])
    assert results["AREA_COUNT"] == found.sum()


def test_selected_features_only(local, parameters, context, log):
    box = "Polygon ((500050 5700050, 500070 5700050, 500070 5700070, 500050 5700050))"
    layer = layer_of([TRIANGLE, box])
    layer.selectByIds([2])
    parameters["BOUNDARY"] = QgsProcessingFeatureSourceDefinition(layer.id(), True)
    results, done = local.run(parameters, context, log)
    assert done, log.text
    x, y, found = changed(results)
    assert found.any() and (x[found] >= 50).all() and (y[found] >= 50).all()
    both, done = local.create().run({**parameters, "BOUNDARY": layer.id()}, context, log)
    assert done and both["AREA_COUNT"] > results["AREA_COUNT"] + 1000


@pytest.mark.parametrize(
    ("kind", "wkt"),
    [
        ("MultiPolygon", f"MultiPolygon ({TRIANGLE.partition(' ')[2]})"),
        ("PolygonZ", TRIANGLE),
        ("CurvePolygon", f"CurvePolygon {TRIANGLE.partition(' ')[2]}"),
    ],
)
def test_other_kinds_of_polygons(kind, wkt, local, parameters, context, log):
    parameters["BOUNDARY"] = layer_of([wkt], kind=kind)
    results, done = local.run(parameters, context, log)
    assert done, log.text
    x, y, found = changed(results)
    assert np.array_equal(found, in_triangle(x, y))


def test_a_circle_of_arcs(local, parameters, context, log):
    circle = "CurvePolygon (CircularString (500020 5700040, 500060 5700040, 500020 5700040))"
    parameters["BOUNDARY"] = layer_of([circle], kind="CurvePolygon")
    results, done = local.run(parameters, context, log)
    assert done, log.text
    x, y, found = changed(results)
    distance = np.hypot(x - 40, y - 40)
    assert found[distance < 19.9].all() and not found[distance > 20.1].any()


def test_features_without_geometry_count_for_nothing(local, parameters, context, log):
    layer = layer_of([TRIANGLE])
    layer.dataProvider().addFeatures([QgsFeature()])
    results, done = local.run({**parameters, "BOUNDARY": layer}, context, log)
    assert done and results["AREA_COUNT"] == changed(results)[2].sum()


def test_extent_and_boundary_together_and_the_command_line(local, parameters, context, log):
    from bare_earth.algorithms.cli import main

    parameters["EXTENT"] = f"{EAST},{EAST + 40.1},{NORTH},{NORTH + 40.1} [EPSG:25832]"
    parameters["BOUNDARY"] = layer_of([TRIANGLE])
    results, done = local.run(parameters, context, log)
    assert done, log.text
    x, y, found = changed(results)
    assert np.array_equal(found, in_triangle(x, y) & (x <= 40.1) & (y <= 40.1))
    assert "--boundary boundary.geojson" in log.text
    with open(results["OUTPUT"], "rb") as file:
        before = file.read()
    boundary = f"{results['OUTPUT']}.geojson"
    with open(boundary, "w") as file:
        json.dump(json.loads(QgsGeometry.fromWkt(TRIANGLE).asJson()), file)
    command = next(shlex.split(line) for line in log.said if line.startswith("bare-earth "))
    assert main([*command[1:], "--boundary", boundary]) == 0
    with open(results["OUTPUT"], "rb") as file:
        assert file.read() == before


def test_emptied_fields_are_no_area(local, parameters, context, log):
    results, done = local.run({**parameters, "EXTENT": "", "BOUNDARY": None}, context, log)
    assert done and results["AREA_COUNT"] == results["POINT_COUNT"]
    assert "in the area" not in log.text


def test_a_cloud_without_crs_takes_the_area_as_it_is(local, tmp_path, context, log):
    write_scene(tmp_path / "no-crs.las", None)
    parameters = {
        "INPUT": str(tmp_path / "no-crs.las"), "OUTPUT": str(tmp_path / "out.las"),
        "BOUNDARY": layer_of([TRIANGLE]),
    }  # fmt: skip
    results, done = local.run(parameters, context, log)
    assert done and 4000 < results["AREA_COUNT"] < 8000


@pytest.mark.parametrize(
    ("values", "word"),
    [
        ({"EXTENT": "0,1,0,1 [EPSG:25832]"}, "lies in the area"),
        ({"EXTENT": "9,1,0,1,3"}, ""),
        ({"EXTENT": f"{EAST},{EAST},{NORTH},{NORTH} [EPSG:25832]"}, ""),
        ({"BOUNDARY": "missing.gpkg"}, ""),
        ({"BOUNDARY": []}, "holds no polygon"),
    ],
)
def test_what_is_no_area_is_told_in_one_line(values, word, parameters, log):
    import processing

    if values.get("BOUNDARY") == []:
        values = {"BOUNDARY": layer_of([])}
    with pytest.raises(QgsProcessingException) as caught:
        processing.run(SLOPE, {**parameters, **values}, feedback=log)
    text = str(caught.value).replace("Unable to execute algorithm\n", "")
    assert text and "\n" not in text and "Traceback" not in text + log.text
    # What fails in the main thread QGIS tells in the log only.
    assert word in text + log.text


def test_known_ground_and_low_outliers(local, scene, tmp_path, context, log):
    las = laspy.read(scene.path)
    roof = np.flatnonzero(~scene.ground)
    las.classification[roof[::10]] = 2
    z = np.array(las.z)
    z[np.flatnonzero(scene.ground)[5000]] -= 8.0
    las.z = z
    las.write(str(scene.path))
    parameters = {
        "INPUT": str(scene.path), "OUTPUT": str(tmp_path / "out.laz"), "SEED_CLASSES": "2, 8",
        "LOW_NOISE_CLASS": True, "LOW_NOISE_DEPTH": 2.5,
    }  # fmt: skip
    results, done = local.run(parameters, context, log)
    assert done, log.text
    found = np.asarray(laspy.read(results["OUTPUT"]).classification)
    assert (found[roof[::10]] == 2).all() and (found[roof[5::10]] == 1).all()
    assert np.flatnonzero(found == 7).tolist() == [np.flatnonzero(scene.ground)[5000]]
    assert "--seed-classes 2 8 --low-noise-class --low-noise-depth 2.5" in log.text


@pytest.mark.parametrize("suffix", [".laz", ".copc.laz"])
def test_the_points_of_the_area_alone_are_written(local, parameters, context, log, suffix):
    parameters |= {"BOUNDARY": layer_of([TRIANGLE]), "AREA_ONLY": True}
    parameters["OUTPUT"] = parameters["OUTPUT"].replace(".laz", suffix)
    before = laspy.read(parameters["INPUT"])
    count = in_triangle(np.asarray(before.x) - EAST, np.asarray(before.y) - NORTH).sum()
    results, done = local.run(parameters, context, log)
    assert done, log.text
    x, y, _ = changed(results)
    assert len(x) == count == results["AREA_COUNT"] and in_triangle(x, y).all()
    assert results["POINT_COUNT"] == len(before.points)
    assert f"{len(before.points) - count:,} points outside of the area" in log.text
    command = next(shlex.split(line) for line in log.said if line.startswith("bare-earth "))
    assert "--area-only" in command


@pytest.mark.parametrize("name", [SLOPE, "bareearth:classifytiles"])
def test_the_area_alone_needs_an_area(registry, parameters, context, tmp_path, name):
    algorithm = registry.createAlgorithmById(name)
    given = {**parameters, "AREA_ONLY": True, "OUTPUT_FOLDER": str(tmp_path / "out")}
    possible, text = algorithm.checkParameterValues(given, context)
    assert not possible and "extent or a boundary" in text


def test_an_area_of_many_files(registry, scene, context, log, tmp_path):
    from bare_earth.algorithms.cli import main

    tiles, out = tmp_path / "tiles", tmp_path / "out"
    tiles.mkdir()
    for number in range(3):
        write_scene(tiles / f"{number}.laz", origin=(EAST + 80.0 * number, NORTH))
    given = {
        "INPUT_FOLDER": str(tiles), "METHOD": "slope", "OUTPUT_FOLDER": str(out),
        "EXTENT": f"{EAST + 50},{EAST + 120},{NORTH + 20},{NORTH + 60} [EPSG:25832]",
        "AREA_ONLY": True,
    }  # fmt: skip
    algorithm = registry.createAlgorithmById("bareearth:classifytiles")
    results, done = algorithm.run(given, context, log)
    assert done, log.text
    clouds = [laspy.read(path) for path in sorted(out.glob("*.laz"))]
    x = np.concatenate([cloud.x for cloud in clouds]) - EAST
    assert len(clouds) == results["DONE_COUNT"] == results["TILE_COUNT"] == 2
    assert x.min() >= 50 and x.max() <= 120 and len(x) == results["POINT_COUNT"] == 140 * 80
    before = [(cloud.X, cloud.classification) for cloud in clouds]
    command = next(shlex.split(line) for line in log.said if line.startswith("bare-earth "))
    for file in out.glob("*.laz"):
        file.unlink()
    assert main([*command[1:], "--threads", "1"]) == 0
    for file, (positions, classes) in zip(sorted(out.glob("*.laz")), before):
        again = laspy.read(file)
        assert np.array_equal(again.X, positions) and np.array_equal(again.classification, classes)


def test_an_area_of_many_files_whose_first_is_broken(registry, scene, context, log, tmp_path):
    tiles, out = tmp_path / "tiles", tmp_path / "out"
    tiles.mkdir()
    (tiles / "a.laz").write_bytes(b"nothing")
    write_scene(tiles / "b.laz", epsg=None)  # that of the others is its own
    write_scene(tiles / "c.laz", origin=(EAST + 80.0, NORTH))
    given = {
        "INPUT_FOLDER": str(tiles), "METHOD": "slope", "OUTPUT_FOLDER": str(out),
        "BOUNDARY": layer_of([TRIANGLE], 4326), "AREA_ONLY": True,
    }  # fmt: skip
    results, done = registry.createAlgorithmById("bareearth:classifytiles").run(given, context, log)
    assert done, log.text
    assert results["TILE_COUNT"] == 2 and f"{tiles / 'a.laz'} is left out" in log.text
    las = laspy.read(out / "b.laz")
    x, y = np.asarray(las.x) - EAST, np.asarray(las.y) - NORTH
    assert len(x) > 1000 and np.mean(in_triangle(x, y)) > 0.99
