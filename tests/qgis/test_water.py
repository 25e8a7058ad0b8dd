import laspy
import numpy as np
import pytest
from qgis.core import (
    QgsCoordinateReferenceSystem,
    QgsCoordinateTransform,
    QgsCoordinateTransformContext,
    QgsLayerTreeModel,
    QgsProcessingException,
    QgsProject,
)
from support import Log, layer_of, title_of, write_scene

ALGORITHM, CLASSES = "bareearth:water", "bareearth:waterclasses"


@pytest.fixture
def cloud(tmp_path):
    """A basin with a lake of 0.9 ha at 50 m, without any point on it."""
    write_scene(tmp_path / "scene.las")  # for its CRS
    header = laspy.read(tmp_path / "scene.las").header
    las = laspy.LasData(header)
    random = np.random.default_rng(1)
    x, y = random.uniform(0, 200, (2, 160_000))
    far = np.hypot(x - 100, y - 100)
    x, y, far = (axis[far > 54] for axis in (x, y, far))
    las.points = laspy.ScaleAwarePointRecord.zeros(len(x), header=header)
    las.x, las.y = x + 500_000, y + 5_700_000
    las.z = 50 + 0.2 * (far - 54) + random.normal(0, 0.02, len(x))
    las.classification[:] = 2
    las.return_number[:] = las.number_of_returns[:] = 1
    las.write(str(tmp_path / "in.las"))
    return tmp_path / "in.las"


def test_a_lake_is_found_and_drawn_in_blue(registry, cloud, tmp_path):
    import processing

    outputs = {name: str(tmp_path / f"{name}.gpkg") for name in ("OUTPUT", "BREAKLINES")}
    results = processing.runAndLoadResults(ALGORITHM, {"INPUT": str(cloud), **outputs})
    assert results["LAKES"] == 1 and results["RIVERS"] == 0
    assert results["AREA"] == pytest.approx(np.pi * 54**2, rel=0.03)
    layers = {title_of(layer): layer for layer in QgsProject.instance().mapLayers().values()}
    (water,) = layers["Water"].getFeatures()
    assert water["LEVEL"] == pytest.approx(50.1, abs=0.15) and water["GRADE"] == "certain"
    assert water.geometry().area() == pytest.approx(results["AREA"], rel=0.02)
    rules = layers["Water"].renderer().rootRule().children()
    assert [rule.label() for rule in rules] == ["Given", "Certain", "Likely", "Doubtful"]
    # The legend keeps its picture unless the renderer is a new one.
    assert layers["Breaklines"].renderer().symbol().color().name() == "#1450aa"
    model = QgsLayerTreeModel(QgsProject.instance().layerTreeRoot())
    node = QgsProject.instance().layerTreeRoot().findLayer(layers["Breaklines"].id())
    assert model.layerLegendNodes(node)[0].symbol().color().name() == "#1450aa"
    (line,) = layers["Breaklines"].getFeatures()
    assert line.geometry().constGet().is3D() and line["KIND"] == "shore"
    assert line.geometry().constGet().pointN(0).z() == pytest.approx(water["LEVEL"], abs=0.002)
    QgsProject.instance().clear()


def test_a_name_that_cannot_be_written_is_told_in_words_of_any_layer(
    registry, cloud, tmp_path, context
):
    values = {"INPUT": str(cloud), "OUTPUT": str(tmp_path / "water.txt")}
    fits, text = registry.createAlgorithmById(ALGORITHM).checkParameterValues(values, context)
    assert not fits and ".gpkg" in text and "checkpoints" not in text


def square(crs="EPSG:25832", transform=None):
    """Return a layer with a square of 40 m on the bank of the lake."""
    west, south, side = 500_160.0, 5_700_100.0, 40.0
    corners = [(west, south), (west + side, south), (west + side, south + side),
               (west, south + side), (west, south)]  # fmt: skip
    if transform is not None:
        corners = [transform(*corner) for corner in corners]
    return layer_of("Polygon", f"Polygon(({', '.join(f'{x!r} {y!r}' for x, y in corners)}))", crs)


def to_degrees(x, y):
    crs = [QgsCoordinateReferenceSystem.fromEpsgId(number) for number in (25832, 4326)]
    moved = QgsCoordinateTransform(*crs, QgsCoordinateTransformContext()).transform(x, y)
    return moved.x(), moved.y()


@pytest.mark.parametrize("is_in_degrees", [False, True])
def test_ground_in_a_layer_of_water_becomes_class_9(registry, cloud, tmp_path, is_in_degrees):
    import processing

    layer = square("EPSG:4326", to_degrees) if is_in_degrees else square()
    log, output = Log(), str(tmp_path / "out.las")
    given = {"INPUT": str(cloud), "WATER": layer, "OUTPUT": output}
    results = processing.run(CLASSES, given, feedback=log)
    las = laspy.read(output)
    x, y = np.asarray(las.x) - 500_160, np.asarray(las.y) - 5_700_100
    away = np.maximum(np.maximum(-x, x - 40), np.maximum(-y, y - 40))
    classes = np.asarray(las.classification)
    sure = np.abs(away) > 0.002
    assert (classes == 9).sum() == results["WATER_COUNT"] > 4000
    assert np.array_equal((classes == 9)[sure], (away < 0)[sure])
    beside = np.hypot(
        np.clip(np.maximum(-x, x - 40), 0, None), np.clip(np.maximum(-y, y - 40), 0, None)
    )
    beside = (away > 0) & (beside <= 0.7)
    assert (classes == 20).sum() == results["IGNORED_COUNT"] > 100
    assert abs((classes == 20).sum() - beside.sum()) < 5
    assert "water-classes" in log.text and "--water water.geojson" in log.text


def test_without_a_layer_the_water_is_found(registry, cloud, tmp_path):
    import processing

    las, log = laspy.read(cloud), Log()
    lake = laspy.ScaleAwarePointRecord.zeros(40, header=las.header)
    lake.x, lake.y = 500_100 + np.linspace(-40, 40, 40), np.full(40, 5_700_100.0)
    lake.z, lake.classification = np.full(40, 50.0), np.full(40, 2)
    lake.return_number[:] = lake.number_of_returns[:] = 1
    array = np.concatenate((las.points.array, lake.array))
    las.points = laspy.ScaleAwarePointRecord(
        array, las.header.point_format, las.header.scales, las.header.offsets
    )
    las.write(str(cloud))
    output = str(tmp_path / "out.las")
    results = processing.run(CLASSES, {"INPUT": str(cloud), "OUTPUT": output}, feedback=log)
    classes = np.asarray(laspy.read(output).classification)
    assert (classes[-40:] == 9).all() and results["WATER_COUNT"] == (classes == 9).sum()
    assert "--water automatic" in log.text and "Water: 1 lake" in log.text


def test_a_layer_without_polygons_is_refused(registry, cloud, tmp_path):
    import processing

    layer = square()
    layer.dataProvider().truncate()
    given = {"INPUT": str(cloud), "WATER": layer, "OUTPUT": str(tmp_path / "out.las")}
    with pytest.raises(QgsProcessingException, match="holds no polygon"):
        processing.run(CLASSES, given)
    assert not (tmp_path / "out.las").exists()
