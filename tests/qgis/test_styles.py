"""How the layers of a run look, what they are called, and where they are in the tree."""

import laspy
import numpy as np
import pytest
from osgeo import gdal
from qgis.core import (
    Qgis,
    QgsCoordinateReferenceSystem,
    QgsExpression,
    QgsExpressionContext,
    QgsLayerTreeModel,
    QgsPointCloudLayer,
    QgsProcessingOutputLayerDefinition,
    QgsProject,
    QgsRasterLayer,
    QgsUnitTypes,
)
from qgis.PyQt.QtCore import Qt
from qgis.PyQt.QtGui import QPainter
from support import ALGORITHM, colour_at, groups, title_of, write_scene

from bare_earth.plugin.styles import clouds, layers, rasters

MULTIPLY = QPainter.CompositionMode.CompositionMode_Multiply


@pytest.fixture
def run(context):
    """Run an algorithm as the toolbox does, all outputs loaded."""
    import processing

    def run(algorithm, parameters, outputs, name=""):
        project = QgsProject.instance()
        loaded = {}
        for key, path in outputs.items():
            loaded[key] = QgsProcessingOutputLayerDefinition(str(path), project)
            loaded[key].destinationName = name
        return processing.runAndLoadResults(algorithm, {**parameters, **loaded})

    yield run
    QgsProject.instance().clear()


def tree():
    """Return the groups and layers of the project, from above."""
    return {
        name: [(title_of(child), child.itemVisibilityChecked()) for child in children]
        for name, children in groups().items()
    }


def raster(path, values):
    values = np.asarray(values, dtype=np.float32)
    made = gdal.GetDriverByName("GTiff").Create(str(path), *values.shape[::-1], 1, gdal.GDT_Float32)
    made.SetGeoTransform((500_000, 1, 0, 5_700_000, 0, -1))
    made.GetRasterBand(1).WriteArray(values)
    made = None
    return QgsRasterLayer(str(path))


def draw(name, layer):
    layers.raster_looks()[name.upper()].dress(layer)


def limits(layer):
    renderer = layer.renderer()
    return renderer.classificationMin(), renderer.classificationMax()


def test_classes_without_a_usual_colour_are_shown_too():
    layer = QgsPointCloudLayer()
    clouds.by_class([26, 2, 200])(layer)
    categories = layer.renderer().categories()
    assert [(category.value(), category.label()) for category in categories] == [
        (2, "Ground"), (26, "26"), (200, "200"),
    ]  # fmt: skip
    assert len({category.color().name() for category in categories}) == 3


def test_what_is_not_classified_is_faint_but_opaque():
    layer = QgsPointCloudLayer()
    clouds.by_class([1, 2])(layer)
    renderer = layer.renderer()
    colours = {category.value(): category.color() for category in renderer.categories()}
    assert colours[1].alpha() == colours[2].alpha() == 255
    assert colours[1].lightness() > colours[2].lightness() + 20
    assert colours[1].hslSaturation() < colours[2].hslSaturation() / 2
    assert renderer.pointSizeMapUnitScale().minSizeMMEnabled


def test_every_class_that_we_write_has_a_name_and_a_colour_and_only_water_is_blue():
    found = clouds.categories_of([*range(1, 10), 17, 18, 20, 40, 41, 45])
    assert not [label for label, _ in found.values() if label.isdigit() or "Reserved" in label]
    assert len({colour.name() for _, colour in found.values()}) == len(found)
    # Greys have no hue, or hardly one.
    blue = {value for value, (_, colour) in found.items()
            if 170 <= colour.hsvHue() <= 250 and colour.hsvSaturation() > 30}  # fmt: skip
    assert blue == {9, 41, 45}
    assert found[20][0] == "Ignored ground" and found[8][0] == "Model key point"


@pytest.mark.skipif(Qgis.QGIS_VERSION_INT < 32600, reason="shows no point clouds")
def test_trees_are_seen_above_the_ground(tmp_path):
    """As a forester sees them: the returns below a crown do not hide it."""
    path = str(tmp_path / "trees.copc.laz")
    side = np.arange(0.25, 40.0, 0.5)
    x, y = (axis.ravel() for axis in np.meshgrid(side, side))
    crown = np.hypot(x - 20, y - 20) < 8
    header = laspy.LasHeader(point_format=6, version="1.4")
    header.scales, header.offsets = (0.001, 0.001, 0.001), (500_000.0, 5_700_000.0, 0.0)
    las = laspy.LasData(header)
    las.x = np.concatenate([x, x[crown]]) + 500_000
    las.y = np.concatenate([y, y[crown]]) + 5_700_000
    las.z = np.concatenate([0 * x + 100, 0 * x[crown] + 115])
    las.classification[:] = np.repeat([2, 5], [len(x), crown.sum()])
    las.return_number[:] = las.number_of_returns[:] = 1
    las.write(str(tmp_path / "trees.las"))
    heights = {"INPUT": str(tmp_path / "trees.las"), "OUTPUT": path}
    import processing

    processing.run("bareearth:heightaboveground", heights)
    layer = QgsPointCloudLayer(path, "trees", "copc")
    clouds.by_class([2, 5])(layer)
    for value, x, y in ((5, 20, 20), (2, 5, 5)):
        expected = clouds.categories_of([value])[value][1]
        seen = colour_at([layer], 500_000 + x, 5_700_000 + y)
        channels = zip(seen.getRgb()[:3], expected.getRgb()[:3])
        assert max(abs(one - other) for one, other in channels) < 60, (value, seen.name())


def test_heights_of_a_cloud_have_colours_from_the_ground_up():
    layer = QgsPointCloudLayer()
    clouds.by_height("HeightAboveGround", 25.0)(layer)
    renderer = layer.renderer()
    assert renderer.attribute() == "HeightAboveGround"
    assert (renderer.minimum(), renderer.maximum()) == (0.0, 25.0)
    assert renderer.colorRampShader().colorRampItemList()
    clouds.by_height("Z", 900.0)(layer)  # a bird
    assert layer.renderer().maximum() == 40.0
    clouds.by_height("Z", 900.0, 0.3048)(layer)
    assert layer.renderer().maximum() == 131.5


def test_the_colours_of_terrain_fit_its_range_without_the_extremes(tmp_path):
    heights = np.linspace(100.0, 200.0, 10_000).reshape(100, 100)
    heights[0, 0], heights[-1, -1] = -500.0, 4000.0
    layer = raster(tmp_path / "dtm.tif", heights)
    draw("dtm", layer)
    low, high = limits(layer)
    assert low == pytest.approx(102.0, abs=0.1) and high == pytest.approx(198.0, abs=0.1)
    assert layer.blendMode() == MULTIPLY


def test_a_file_that_takes_the_place_of_another_gets_its_own_colours(tmp_path):
    for base in (0.0, 1000.0):
        layer = raster(tmp_path / "dtm.tif", base + np.linspace(0, 100, 10_000).reshape(100, 100))
        draw("dtm", layer)
        # What QGIS does when the user asks for the histogram.
        layer.dataProvider().cumulativeCut(1, 0.02, 0.98)
        assert limits(layer)[0] == pytest.approx(base + 2, abs=0.1)


def test_a_raster_without_heights_is_coloured_too(tmp_path):
    layer = raster(tmp_path / "dtm.tif", np.full((10, 10), np.nan))
    draw("dtm", layer)
    assert limits(layer) == (0.0, 0.5)


def test_level_land_is_not_coloured_by_its_noise(tmp_path):
    noise = np.random.default_rng(1).normal(0.0, 0.005, (50, 50))
    layer = raster(tmp_path / "dtm.tif", 10.0 + noise)
    draw("dtm", layer)
    low, high = limits(layer)
    assert high - low >= 0.5


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("expected_error", (0.0, None)),
        ("error_map", (0.0, 1.0)),
        ("chm", (0.0, None)),
    ],
)
def test_ranges_that_mean_something_are_kept(tmp_path, name, expected):
    layer = raster(tmp_path / "r.tif", np.linspace(0.4, 0.6, 100).reshape(10, 10))
    draw(name, layer)
    assert limits(layer)[0] == expected[0]
    if expected[1] is not None:
        assert limits(layer)[1] == expected[1]


def test_relief_has_its_middle_at_zero(tmp_path):
    layer = raster(tmp_path / "r.tif", np.linspace(-1.0, 3.0, 10_000).reshape(100, 100))
    draw("relief", layer)
    low, high = limits(layer)
    assert low == -high < 0


def test_a_run_is_a_group_in_a_sensible_order_and_shows_one_theme(run, scene, tmp_path):
    outputs = {"OUTPUT": tmp_path / "z.copc.laz", "DTM": tmp_path / "b.tif"}
    outputs["HILLSHADE"] = tmp_path / "a.tif"
    run(ALGORITHM, {"INPUT": str(scene.path)}, outputs)
    # Where clouds cannot be seen, a raster of their classes can.
    expected = [
        ("Classes", True), ("Terrain model", False), ("Hillshade", True),
    ]  # fmt: skip
    assert tree() == {"scene: TIN densification": expected}
    assert {title_of(layer) for layer in QgsProject.instance().mapLayers().values()} == {
        name for name, _ in expected
    }


def test_two_runs_are_two_groups(run, scene, tmp_path):
    for folder in ("one", "two"):
        (tmp_path / folder).mkdir()
        outputs = {name: tmp_path / folder / f"{name}.tif" for name in ("DTM", "HILLSHADE")}
        values = {"INPUT": str(scene.path), "OUTPUT": str(tmp_path / folder / "o.las")}
        run("bareearth:slopefilter", values, outputs)
    assert set(tree()) == {"scene: Slope filter", "scene: Slope filter (2)"}


def test_no_raster_is_bare_and_grey(run, scene, tmp_path):
    import processing

    ground = str(tmp_path / "ground.laz")
    processing.run(ALGORITHM, {"INPUT": str(scene.path), "OUTPUT": ground})
    names = ("DTM", "DSM", "CHM", "HILLSHADE", "EXPECTED_ERROR")
    outputs = {key: tmp_path / f"{key}.tif" for key in names}
    run("bareearth:terrainmodel", {"INPUT": ground}, outputs)
    layers = {title_of(layer): layer for layer in QgsProject.instance().mapLayers().values()}
    kinds = {name: shown.renderer().type() for name, shown in layers.items()}
    assert kinds.pop("Hillshade") == "singlebandgray"
    assert len(kinds) == 4 and set(kinds.values()) == {"singlebandpseudocolor"}
    (group,) = tree().values()
    assert [name for name, visible in group if visible] == ["Terrain model", "Hillshade"]


def test_a_layer_that_a_model_has_named_keeps_its_name_and_place(run, scene, tmp_path):
    import processing

    ground = str(tmp_path / "ground.laz")
    processing.run(ALGORITHM, {"INPUT": str(scene.path), "OUTPUT": ground})
    outputs = {name: tmp_path / f"{name}.tif" for name in ("DTM", "HILLSHADE")}
    run("bareearth:terrainmodel", {"INPUT": ground}, outputs, "Mine")
    assert not tree()
    layers = QgsProject.instance().mapLayers().values()
    assert {layer.name() for layer in layers} == {"Mine"}
    assert {layer.renderer().type() for layer in layers} == {
        "singlebandgray", "singlebandpseudocolor",
    }  # fmt: skip


def test_legends_say_what_is_shown_and_its_unit(run, scene, tmp_path, monkeypatch):
    import processing

    ground = str(tmp_path / "ground.laz")
    processing.run(ALGORITHM, {"INPUT": str(scene.path), "OUTPUT": ground})
    # As in a window: the tree is there before the layers are.
    project = QgsProject.instance()
    model = QgsLayerTreeModel(project.layerTreeRoot())
    names = ("DTM", "DSM", "CHM", "HILLSHADE", "EXPECTED_ERROR", "RELIEF")
    outputs = {key: tmp_path / f"{key}.tif" for key in names}
    outputs["OUTPUT"] = tmp_path / "out.las"
    run("bareearth:pointcloudtoterrain", {"INPUT": str(scene.path)}, outputs)
    told = {}
    for layer in project.mapLayers().values():
        node = project.layerTreeRoot().findLayer(layer.id())
        texts = [entry.data(Qt.ItemDataRole.DisplayRole) for entry in model.layerLegendNodes(node)]
        told[title_of(layer)] = texts
    assert "Ground" in told.pop("Classes")
    # Grey values of a hillshade mean nothing.
    assert told.pop("Hillshade") == []
    assert {name: texts[0] for name, texts in told.items()} == {
        "Terrain model": "Height, m", "Surface model": "Height, m",
        "Canopy height": "Height above ground, m", "Expected error": "Expected error (95 %), m",
        "Local relief": "Local relief, m",
    }  # fmt: skip
    monkeypatch.setattr(rasters, "tr", {"Height": "Höhe"}.get)
    layer = QgsRasterLayer(str(outputs["DTM"]))
    assert rasters.shown_by(layer) == "Höhe, m"


def legend_of(name):
    """Return the texts of a layer's legend, as a window has them."""
    project = QgsProject.instance()
    model = QgsLayerTreeModel(project.layerTreeRoot())
    (layer,) = (layer for layer in project.mapLayers().values() if layer.name().endswith(name))
    nodes = model.layerLegendNodes(project.layerTreeRoot().findLayer(layer.id()))
    return [node.data(Qt.ItemDataRole.DisplayRole) for node in nodes]


def test_the_legend_of_contour_lines_says_the_unit(run, tmp_path):
    write_scene(tmp_path / "feet.las", epsg=2264)
    outputs = {key: tmp_path / key for key in ("CONTOURS.gpkg", "DTM.tif")}
    outputs = {name.partition(".")[0]: path for name, path in outputs.items()}
    values = {"INPUT": str(tmp_path / "feet.las"), "CONTOUR_INTERVAL": 2.5}
    run("bareearth:pointcloudtoterrain", values, outputs)
    every = ["Every 12.5 US survey ft", "Every 2.5 US survey ft"]
    assert legend_of("Contour lines") == [*every, "Depression"]


def test_every_fifth_contour_line_has_its_height_as_a_label(run, tmp_path):
    write_scene(tmp_path / "scene.las")
    outputs = {"CONTOURS": tmp_path / "lines.gpkg", "DTM": tmp_path / "dtm.tif"}
    values = {"INPUT": str(tmp_path / "scene.las"), "CONTOUR_INTERVAL": 0.2}
    run("bareearth:pointcloudtoterrain", values, outputs)
    layers = QgsProject.instance().mapLayers().values()
    (layer,) = (shown for shown in layers if title_of(shown) == "Contour lines")
    assert layer.labelsEnabled()
    (rule,) = layer.labeling().rootRule().children()
    context = QgsExpressionContext()
    labelled = set()
    for feature in layer.getFeatures():
        context.setFeature(feature)
        expression = QgsExpression(rule.filterExpression())
        context.setFields(layer.fields())
        if expression.evaluate(context):
            labelled.add(feature["ELEV"])
        assert bool(expression.evaluate(context)) == (feature["INDEX"] == 1)
    assert labelled == {101.0, 102.0, 103.0, 104.0, 105.0}
    assert rule.settings().fieldName == "ELEV" and rule.settings().format().buffer().enabled()


@pytest.mark.skipif(Qgis.QGIS_VERSION_INT < 32600, reason="shows no point clouds")
@pytest.mark.parametrize(("epsg", "unit"), [(25832, "m"), (2264, "US survey ft")])
def test_the_legend_of_heights_says_the_unit(run, tmp_path, epsg, unit):
    import processing

    write_scene(tmp_path / "scene.las", epsg=epsg)
    ground = str(tmp_path / "ground.las")
    processing.run(ALGORITHM, {"INPUT": str(tmp_path / "scene.las"), "OUTPUT": ground})
    outputs = {"OUTPUT": tmp_path / "heights.copc.laz"}
    run("bareearth:heightaboveground", {"INPUT": ground}, outputs)
    assert legend_of("Height above ground")[0] == f"Height above ground, {unit}"


def test_the_map_has_the_colours_of_the_legend(run, tmp_path):
    """Also with the terrain and its hillshade switched on below the classes."""
    write_scene(tmp_path / "scene.las")
    outputs = {name: tmp_path / f"{name}.tif" for name in ("DTM", "HILLSHADE")}
    outputs["OUTPUT"] = tmp_path / "o.copc.laz"
    run(ALGORITHM, {"INPUT": str(tmp_path / "scene.las")}, outputs)
    root = QgsProject.instance().layerTreeRoot()
    for node in root.findLayers():
        node.setItemVisibilityChecked(True)
    wanted = clouds.categories_of([1, 2])
    places = {2: (10.25, 60.25), 1: (39.25, 33.25)}
    for value, (x, y) in places.items():
        seen, colour = colour_at(root.layerOrder(), 500_000 + x, 5_700_000 + y), wanted[value][1]
        channels = zip(seen.getRgb()[:3], colour.getRgb()[:3])
        assert max(abs(one - other) for one, other in channels) < 20, (value, seen.name())


@pytest.mark.parametrize("crs", ["", "EPSG:25832"])
def test_points_without_crs_are_sized_in_units_of_the_map(crs):
    # In a map in degrees, the size of a metre is found for each point, with the ellipsoid.
    layer = QgsPointCloudLayer("", "cloud", "copc")
    layer.setCrs(QgsCoordinateReferenceSystem(crs))
    clouds.by_class([1, 2])(layer)
    unit = layer.renderer().pointSizeUnit()
    metres = QgsUnitTypes.encodeUnit(unit) == "RenderMetersInMapUnits"
    assert metres == bool(crs) and layer.renderer().pointSizeMapUnitScale().maxSizeMMEnabled
