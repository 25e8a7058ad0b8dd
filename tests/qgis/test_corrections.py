"""Corrections by hand as a layer of polygons, in every algorithm that finds the ground."""

import laspy
import numpy as np
import pytest
from qgis.core import QgsFeature, QgsGeometry, QgsProcessingException, QgsVectorLayer
from support import ALGORITHM, Log, remove

# Of each, the field of its output, and its name there.
ALGORITHMS = {
    "tindensification": ("OUTPUT", "out.laz"),
    "gridminimum": ("OUTPUT", "out.laz"),
    "slopefilter": ("OUTPUT", "out.laz"),
    "pointcloudtoterrain": ("OUTPUT", "out.laz"),
    "classifytiles": ("OUTPUT_FOLDER", "out"),
}


def polygons(scene, field="class", values=(2, 9), crs="EPSG:25832"):
    """Return the roof as the first class, and a strip of the land round it as the second."""
    las = laspy.read(scene.path)
    x, y = np.asarray(las.x), np.asarray(las.y)
    high = [axis[~scene.ground] for axis in (x, y)]
    roof = *(height.min() for height in high), *(height.max() for height in high)
    strip = x.min(), y.min(), x.max(), y.min() + 10.0
    layer = QgsVectorLayer(f"Polygon?crs={crs}&field={field}:integer", "known", "memory")
    for (west, south, east, north), value in zip((roof, strip), values):
        west, south, east, north = west - 0.1, south - 0.1, east + 0.1, north + 0.1
        corners = [(west, south), (east, south), (east, north), (west, north), (west, south)]
        feature = QgsFeature(layer.fields())
        ring = ", ".join(f"{a} {b}" for a, b in corners)
        feature.setGeometry(QgsGeometry.fromWkt(f"POLYGON(({ring}))"))
        feature[field] = value
        assert layer.dataProvider().addFeatures([feature])[0]
    in_strip = y <= y.min() + 10.1
    return layer, in_strip


@pytest.mark.parametrize("name", ALGORITHMS)
def test_the_classes_of_polygons_hold(name, scene, tmp_path):
    import processing

    output, file = ALGORITHMS[name]
    layer, in_strip = polygons(scene)
    parameters = {
        "INPUT": [str(scene.path)] if name == "classifytiles" else str(scene.path),
        output: str(tmp_path / file),
        "CORRECTIONS": layer,
    }
    log = Log()
    processing.run(f"bareearth:{name}", parameters, feedback=log)
    found = tmp_path / file
    found = found / scene.path.name if found.is_dir() else found
    classes = np.asarray(laspy.read(found).classification)
    assert set(classes[~scene.ground]) == {2}
    assert set(classes[in_strip]) == {9}
    assert set(classes[scene.ground & ~in_strip]) == {2}
    assert "add --corrections" in log.text


def test_the_attribute_is_chosen_and_one_without_a_class_is_told(scene, tmp_path):
    import processing

    def run(layer, **others):
        log, out = Log(), str(tmp_path / "out.laz")
        parameters = {"INPUT": str(scene.path), "OUTPUT": out, "CORRECTIONS": layer, **others}
        try:
            processing.run("bareearth:slopefilter", parameters, feedback=log)
        except QgsProcessingException:
            return log.text
        return np.asarray(laspy.read(out).classification)

    layer, in_strip = polygons(scene, "kind")
    assert "no attribute class" in run(layer)
    assert set(run(layer, CORRECTIONS_FIELD="kind")[in_strip]) == {9}
    layer, _ = polygons(scene, values=(None, None))
    assert "a class or an answer" in run(layer)
    layer, in_strip = polygons(scene, values=(2, None))
    assert not (run(layer)[in_strip] == 9).any()


def test_polygons_lie_in_any_crs(scene, tmp_path):
    import processing

    layer, in_strip = polygons(scene)
    degrees = processing.run(
        "native:reprojectlayer",
        {"INPUT": layer, "TARGET_CRS": "EPSG:4326", "OUTPUT": "memory:"},
    )["OUTPUT"]
    out = str(tmp_path / "out.laz")
    processing.run(
        "bareearth:slopefilter", {"INPUT": str(scene.path), "OUTPUT": out, "CORRECTIONS": degrees}
    )
    classes = np.asarray(laspy.read(out).classification)
    assert np.mean(classes[in_strip] == 9) > 0.99
    assert np.mean(classes[~scene.ground] == 2) > 0.99


def test_a_blank_attribute_is_a_value_that_a_batch_can_save(registry, context):
    import json

    from processing.gui.BatchAlgorithmDialog import BatchAlgorithmDialog

    dialog = BatchAlgorithmDialog(registry.createAlgorithmById(ALGORITHM))
    panel = dialog.mainWidget()
    wrapper = panel.wrappers[0][panel.parameter_to_column["CORRECTIONS_FIELD"]]
    assert json.dumps(wrapper.parameterValue()) == '"class"'
    wrapper.setParameterValue(None, context)
    assert json.dumps(wrapper.parameterValue()) == "null"
    remove(dialog)
