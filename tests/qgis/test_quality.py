import laspy
import numpy as np
import pytest
from osgeo import gdal
from qgis.core import (
    QgsLayerTreeModel,
    QgsProcessingException,
    QgsProject,
    QgsRasterLayer,
    QgsVectorLayer,
)
from qgis.PyQt.QtGui import QColor
from support import Log, title_of, write_scene

from bare_earth.plugin.styles import layers

ALGORITHM = "bareearth:quality"


@pytest.fixture
def cloud(scene, tmp_path):
    """The scene with its true classes."""
    return scene.with_classes(tmp_path / "ground.laz", other=1)


def test_run_with_page_and_rasters(registry, cloud, tmp_path, context, log):
    algorithm = registry.createAlgorithmById(ALGORITHM)
    page, folder, areas = tmp_path / "page.html", tmp_path / "rasters", tmp_path / "areas.gpkg"
    parameters = {
        "INPUT": str(cloud), "SPECIFICATION": 2, "PAGE": str(page), "FOLDER": str(folder),
        "LOW_CONFIDENCE": str(areas),
    }  # fmt: skip
    results, ok = algorithm.run(parameters, context, log)
    assert ok, log.text
    assert results["PULSE_DENSITY"] > results["GROUND_DENSITY"] > 0
    assert "Lidar Base Specification, QL2" in page.read_text(encoding="utf-8")
    assert len(list(folder.glob("*.tif"))) == 7
    assert "--specification lbs-ql2" in log.text and "--low-confidence" in log.text
    # An empty layer is one that Check can take: the scene has no such area.
    assert results["LOW_CONFIDENCE_SHARE"] == 0.0
    layer = QgsVectorLayer(str(areas))
    assert layer.isValid() and layer.featureCount() == 0
    check = registry.createAlgorithmById("bareearth:check")
    given = {"INPUT": str(cloud), "HOLD_OUT": 0.1, "LOW_CONFIDENCE": str(areas)}
    _, ok = check.run(given, context, log)
    assert ok, log.text
    assert " pass; not: " in results["VERDICT"] and results.get("MEETS_SPECIFICATION") != 1
    results, ok = algorithm.create().run({"INPUT": str(cloud)}, context, log)
    assert ok and "VERDICT" not in results and "MEETS_SPECIFICATION" not in results


def test_a_page_that_is_no_page_is_refused(registry, cloud, tmp_path, context):
    algorithm, log = registry.createAlgorithmById(ALGORITHM), Log()
    parameters = {"INPUT": str(cloud), "PAGE": str(tmp_path / "page.pdf")}
    try:
        _, ok = algorithm.run(parameters, context, log)
    except QgsProcessingException:
        ok = False
    assert not ok and not (tmp_path / "page.pdf").exists()


@pytest.fixture
def strips(tmp_path):
    """Two strips that overlap by half, the second 0.1 m higher."""
    ground = write_scene(tmp_path / "in.laz")
    las = laspy.read(tmp_path / "in.laz")
    x = np.asarray(las.x) - 500_000.0
    las.classification[:] = np.where(ground, 2, 1)
    second = laspy.ScaleAwarePointRecord(
        las.points.array[x > 40.0].copy(), las.header.point_format, las.header.scales,
        las.header.offsets,
    )  # fmt: skip
    second["point_source_id"] = np.full(len(second), 2)
    second.z = np.asarray(second.z) + 0.1
    las.point_source_id[:] = 1
    las.points = laspy.ScaleAwarePointRecord(
        np.concatenate((las.points.array, second.array)), las.header.point_format,
        las.header.scales, las.header.offsets,
    )  # fmt: skip
    las.write(str(tmp_path / "in.laz"))
    return tmp_path / "in.laz"


def legend_of(layer):
    nodes = QgsLayerTreeModel(QgsProject.instance().layerTreeRoot()).layerLegendNodes
    return [node.data(0) for node in nodes(QgsProject.instance().layerTreeRoot().findLayer(layer))]


def colour_at(layer, x, y):
    """Return the colour of the renderer at a place in metres from the corner of the scene."""
    extent = layer.extent()
    column = int((500_000.0 + x - extent.xMinimum()) / layer.rasterUnitsPerPixelX())
    row = int((extent.yMaximum() - 5_700_000.0 - y) / layer.rasterUnitsPerPixelY())
    layer.setOpacity(1.0)
    block = layer.renderer().block(1, extent, layer.width(), layer.height())
    return QColor.fromRgba(block.color(row, column))


def test_its_rasters_are_layers_of_one_group_with_colours_and_legends(strips, tmp_path):
    import processing

    words = {"INPUT": str(strips), "PAGE": str(tmp_path / "page.html"), "VOID_DISTANCE": 2.0}
    processing.runAndLoadResults(ALGORITHM, {**words, "FOLDER": str(tmp_path / "rasters")})
    (group,) = QgsProject.instance().layerTreeRoot().children()
    assert group.name() == "in: quality"
    visible = {title_of(child): child.itemVisibilityChecked() for child in group.children()}
    assert list(visible) == [
        "Voids of the ground", "Differences between strips", "Overlap of strips",
        "Density of first returns", "Density of ground points", "Density of low vegetation",
        "Maximum surface height",
    ]  # fmt: skip
    assert [name for name, is_shown in visible.items() if is_shown] == [
        "Voids of the ground", "Differences between strips", "Density of first returns",
    ]  # fmt: skip
    named = {title_of(child): child.layer() for child in group.children()}
    differences = named["Differences between strips"]
    assert colour_at(differences, 60, 60).name() == "#f0c93a"  # 0.1 m
    limits = ["\u2264 0.08", "0.08 \u2013 0.16", "> 0.16"]
    assert legend_of(differences) == ["Difference between strips, m", *limits]
    voids = named["Voids of the ground"]
    assert colour_at(voids, 39, 33).name() == "#c0262d" and colour_at(voids, 60, 60).alpha() == 0
    overlap = named["Overlap of strips"]
    assert colour_at(overlap, 20, 60).name() == "#c6dbef"
    assert colour_at(overlap, 60, 60).name() == "#6baed6"
    assert legend_of(overlap)[0] == "Number of strips"
    density = named["Density of first returns"].renderer()
    assert density.classificationMin() == 0.0 and density.classificationMax() == 8.0
    QgsProject.instance().clear()


def test_limits_of_strips_are_in_the_unit_of_the_heights(tmp_path):
    path = str(tmp_path / "strip_differences.tif")
    raster = gdal.GetDriverByName("GTiff").Create(path, 2, 1, 1, gdal.GDT_Float32)
    raster.SetGeoTransform((0, 1, 0, 1, 0, -1))
    raster.GetRasterBand(1).SetDescription("Difference between strips, ft")
    raster.GetRasterBand(1).WriteArray(np.array([[0.3, 0.6]], np.float32))
    del raster
    layer = QgsRasterLayer(path)
    layers.look_of("strip_differences").dress(layer)
    block = layer.renderer().block(1, layer.extent(), 2, 1)
    assert [QColor.fromRgba(block.color(0, number)).name() for number in (0, 1)] == [
        "#f0c93a",
        "#c0262d",
    ]


@pytest.mark.parametrize("percent", [10, 60, 85, 95])
def test_a_cancel_leaves_nothing(registry, cloud, tmp_path, context, percent):
    algorithm, log = registry.createAlgorithmById(ALGORITHM), Log(cancel_at=percent)
    page, folder = tmp_path / "page.html", tmp_path / "rasters"
    values = {"INPUT": str(cloud), "PAGE": str(page), "FOLDER": str(folder)}
    assert algorithm.run(values, context, log)[0] == {} and "nothing was written" in log.text
    assert not page.exists() and not folder.exists()
    assert not context.layersToLoadOnCompletion()
