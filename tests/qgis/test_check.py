import csv
import json
import re

import laspy
import numpy as np
import pytest
from qgis.core import (
    QgsFeature,
    QgsGeometry,
    QgsProcessingContext,
    QgsProcessingException,
    QgsProcessingOutputLayerDefinition,
    QgsProject,
    QgsVectorLayer,
)
from support import Log, remove

ALGORITHM = "bareearth:check"


@pytest.fixture
def cloud(scene, tmp_path):
    """The scene with its true classes."""
    return scene.with_classes(tmp_path / "ground.laz")


@pytest.fixture
def rows(cloud):
    """Ground points of the cloud, 5 cm lower, as checkpoints; and one that is far away."""
    las = laspy.read(cloud)
    x, y, z = (np.asarray(axis) for axis in (las.x, las.y, las.z))
    inner = (x > x.min() + 5) & (x < x.max() - 5) & (y > y.min() + 5) & (y < y.max() - 5)
    which = np.flatnonzero((np.asarray(las.classification) == 2) & inner)[::150][:40]
    found = [
        (f"P{value}", x[value], y[value], z[value] - 0.05, "forest" if k % 4 == 0 else "sand")
        for k, value in enumerate(which)
    ]
    return [*found, ("far", x.max() + 500, y.max(), 1.0, "sand")]


@pytest.fixture
def table(rows, tmp_path):
    with open(tmp_path / "points.csv", "w", encoding="utf-8", newline="") as file:
        csv.writer(file).writerows([("id", "E", "N", "H", "class"), *rows])
    return str(tmp_path / "points.csv")


def layer_of(rows, tmp_path, z=True):
    features = [
        {
            "type": "Feature",
            "properties": {"label": name, "up": float(up), "land": cover},
            "geometry": {"type": "Point", "coordinates": [float(x), float(y), *[float(up)] * z]},
        }
        for name, x, y, up, cover in rows
    ]
    crs = {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::25832"}}
    path = tmp_path / "points.geojson"
    path.write_text(json.dumps({"type": "FeatureCollection", "crs": crs, "features": features}))
    return str(path)


def test_run_with_a_table(registry, cloud, table, rows, tmp_path, context, log):
    from bare_earth.algorithms.cli import main

    parameters = {
        "INPUT": str(cloud), "CHECKPOINTS": table, "ACCURACY_CLASS": 0.1,
        "OUTPUT": str(tmp_path / "errors.gpkg"), "REPORT": str(tmp_path / "report.html"),
    }  # fmt: skip
    algorithm = registry.createAlgorithmById(ALGORITHM)
    results, done = algorithm.run(parameters, context, log)
    assert done, log.text
    assert results["CHECKPOINT_COUNT"] == len(rows) and results["COUNTED"] == len(rows) - 1
    assert results["NVA_RMSE"] == pytest.approx(0.05, abs=0.01)
    assert results["VVA_RMSE"] == pytest.approx(0.05, abs=0.01)
    assert results["MEETS_CLASS"] == 1 and "meet the class of 0.1 m" in results["VERDICT"]
    assert results["SHIFT"] == pytest.approx(-0.05, abs=0.01) and "HOLD_OUT_RMSE" not in results
    layer = QgsVectorLayer(results["OUTPUT"], "errors")
    assert layer.isValid() and layer.featureCount() == len(rows)
    assert layer.crs().authid() == "EPSG:25832"
    states = [feature["STATE"] for feature in layer.getFeatures()]
    assert states.count("outside") == 1
    page = (tmp_path / "report.html").read_bytes()
    assert b"produced to meet" in page or b"tested to meet" in page
    import shlex

    command = next(shlex.split(line) for line in log.said if line.startswith("bare-earth "))
    (tmp_path / "report.html").unlink()
    assert main(command[1:]) == 0
    assert (tmp_path / "report.html").read_bytes() == page


@pytest.mark.parametrize("has_z", [True, False])
def test_a_layer_in_another_crs_and_its_style(cloud, rows, tmp_path, has_z):
    import processing

    points = QgsVectorLayer(layer_of(rows, tmp_path, has_z), "points")
    wgs = processing.run(
        "native:reprojectlayer",
        {"INPUT": points, "TARGET_CRS": "EPSG:4326", "OUTPUT": "TEMPORARY_OUTPUT"},
    )["OUTPUT"]
    parameters = {
        "INPUT": str(cloud), "CHECKPOINTS": wgs, "COVER_FIELD": "land", "NAME_FIELD": "label",
        "OUTPUT": str(tmp_path / "errors.gpkg"),
    }  # fmt: skip
    if not has_z:
        with pytest.raises(QgsProcessingException, match="have no heights"):
            processing.run(ALGORITHM, parameters)
        parameters["Z_FIELD"] = "up"
    QgsProject.instance().clear()
    results = processing.runAndLoadResults(ALGORITHM, parameters)
    assert results["COUNTED"] == len(rows) - 1
    assert results["NVA_RMSE"] == pytest.approx(0.05, abs=0.01) and results["VVA_RMSE"] > 0
    (layer,) = QgsProject.instance().mapLayers().values()
    rules = layer.renderer().rootRule().children()
    assert len(rules) == 6 and rules[-1].label() == "Not counted"
    assert rules[0].symbol().color().name() == "#2166ac"
    names = {feature["NAME"] for feature in layer.getFeatures()}
    assert {"far", rows[0][0]} <= names
    QgsProject.instance().clear()


def test_a_layer_with_repeated_points_missing_heights_and_control_points(
    registry, cloud, rows, tmp_path, context, log
):
    names = [f"{'GCP' if number == 3 else 'CHK'}{number}" for number in range(len(rows))]
    given = [(name, *row[1:]) for name, row in zip(names, rows)]
    given[1] = (*given[1][:3], 0.0, given[1][4])
    points = QgsVectorLayer(layer_of([*given, given[0]], tmp_path), "points")
    parameters = {
        "INPUT": str(cloud), "CHECKPOINTS": points, "COVER_FIELD": "land", "NAME_FIELD": "label",
        "OUTPUT": str(tmp_path / "errors.gpkg"),
    }  # fmt: skip
    results, done = registry.createAlgorithmById(ALGORITHM).run(parameters, context, log)
    assert done and results["COUNTED"] == len(rows) - 3, log.text
    states = {f["NAME"]: f["STATE"] for f in QgsVectorLayer(results["OUTPUT"]).getFeatures()}
    assert (states["CHK1"], states["GCP3"]) == ("no height", "control")
    assert re.search("1 listed again.* CHK0", log.text)


def test_polygons_as_checkpoints_are_refused(cloud):
    import processing

    areas = QgsVectorLayer("Polygon?crs=EPSG:25832", "areas", "memory")
    feature = QgsFeature()
    feature.setGeometry(QgsGeometry.fromWkt("POLYGON((0 0, 1 0, 1 1, 0 0))"))
    areas.dataProvider().addFeatures([feature])
    with pytest.raises(QgsProcessingException, match="holds no point"):
        processing.run(ALGORITHM, {"INPUT": str(cloud), "CHECKPOINTS": areas})


@pytest.mark.rest
def test_held_out_points_need_no_checkpoints(cloud, tmp_path):
    import processing

    results = processing.run(ALGORITHM, {"INPUT": str(cloud), "HOLD_OUT": 0.05})
    assert results["HOLD_OUT_RMSE"] > 0 and "OUTPUT" not in results
    with pytest.raises(QgsProcessingException, match=r"'Checkpoints'.* 'Share of "):
        processing.run(ALGORITHM, {"INPUT": str(cloud)})


def test_cancel_leaves_nothing(registry, cloud, table, tmp_path, context):
    (tmp_path / "out").mkdir()
    parameters = {
        "INPUT": str(cloud), "CHECKPOINTS": table, "HOLD_OUT": 0.05,
        "OUTPUT": str(tmp_path / "out" / "e.gpkg"), "REPORT": str(tmp_path / "out" / "r.html"),
    }  # fmt: skip
    for percent in (1, 40, 70):
        algorithm = registry.createAlgorithmById(ALGORITHM)
        assert algorithm.run(parameters, context, Log(cancel_at=percent))[0] == {}
        assert list((tmp_path / "out").iterdir()) == []


def write_text(path, rows, sign=" "):
    lines = [("id", "E", "N", "H", "class"), *rows]
    path.write_text("\n".join(sign.join(map(str, line)) for line in lines), encoding="utf-8")
    return str(path)


@pytest.mark.parametrize("name", ["points.txt", "points.xyz", "points.tsv"])
def test_text_files_are_checkpoints(registry, cloud, rows, tmp_path, context, name):
    from processing.gui.AlgorithmDialog import AlgorithmDialog

    path = write_text(tmp_path / name, rows, "\t" if name.endswith("tsv") else " ")
    dialog = AlgorithmDialog(registry.createAlgorithmById(ALGORITHM))
    wrapper = dialog.mainWidget().wrappers["CHECKPOINTS"]
    wrapper.setWidgetValue(path, context)
    parameters = {"INPUT": str(cloud), "CHECKPOINTS": wrapper.parameterValue()}
    assert parameters["CHECKPOINTS"] == path
    algorithm, log = registry.createAlgorithmById(ALGORITHM), Log()
    assert algorithm.checkParameterValues(parameters, context)[0]
    results, done = algorithm.run(parameters, context, log)
    assert done and results["COUNTED"] == len(rows) - 1, log.text
    assert "*.xyz" in algorithm.parameterDefinition("CHECKPOINTS").createFileFilter()
    remove(dialog)


@pytest.mark.parametrize("tool", [ALGORITHM, "bareearth:pointcloudtoterrain"])
def test_the_columns_of_a_text_file_can_be_chosen_and_nothing_is_said_of_it(
    dialog_of, rows, tmp_path, context, tool
):
    dialog = dialog_of(tool)
    fields = dialog.mainWidget().wrappers
    box = fields["Z_FIELD"].wrappedWidget()

    def choices():
        return [box.itemText(place) for place in range(box.count())]

    path = write_text(tmp_path / "points.txt", rows)
    fields["CHECKPOINTS"].setParameterValue(path, context)
    assert [item.text() for item in dialog.messageBar().items()] == []
    assert choices() == ["", "id", "E", "N", "H", "class"]
    assert fields["Z_FIELD"].parameterValue() is None
    box.setCurrentIndex(4)
    assert fields["Z_FIELD"].parameterValue() == "H"
    without = tmp_path / "numbers.xyz"
    without.write_text("1 2 3\n4 5 6\n", encoding="utf-8")
    fields["CHECKPOINTS"].setParameterValue(str(without), context)
    assert choices() == ["", "1", "2", "3"] and fields["Z_FIELD"].parameterValue() == "H"
    fields["CHECKPOINTS"].setParameterValue(layer_of(rows, tmp_path), context)
    assert choices() == ["", "label", "up", "land"]


@pytest.mark.parametrize("is_filtered", [False, True])
def test_a_table_without_geometry_is_checkpoints(registry, cloud, rows, tmp_path, is_filtered):
    table = write_text(tmp_path / "points.csv", rows, ",")
    layer = QgsVectorLayer(table, "points", "ogr")
    assert layer.isValid() and not layer.isSpatial()
    if is_filtered:
        assert layer.setSubsetString(f"id <> '{rows[0][0]}'")
    QgsProject.instance().addMapLayer(layer)
    parameters = {"INPUT": str(cloud), "CHECKPOINTS": layer.id()}
    algorithm, log, context = registry.createAlgorithmById(ALGORITHM), Log(), QgsProcessingContext()
    context.setProject(QgsProject.instance())
    assert algorithm.checkParameterValues(parameters, context)[0]
    results, done = algorithm.run(parameters, context, log)
    assert done and results["COUNTED"] == len(rows) - 1 - is_filtered, log.text
    QgsProject.instance().clear()


def test_blank_optional_outputs_are_no_layers(registry, cloud, table, context):
    # As a row of a batch run has them.
    blank = QgsProcessingOutputLayerDefinition("", QgsProject.instance())
    parameters = {"INPUT": str(cloud), "CHECKPOINTS": table, "OUTPUT": blank, "REPORT": ""}
    algorithm, log = registry.createAlgorithmById(ALGORITHM), Log()
    context.setProject(QgsProject.instance())
    results, done = algorithm.run(parameters, context, log)
    assert done and results["COUNTED"] and "OUTPUT" not in results
    assert list(context.layersToLoadOnCompletion()) == []
