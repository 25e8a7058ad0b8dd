"""Change between two surveys in QGIS: layers of rasters, files of points, and how results look."""

import numpy as np
from osgeo import gdal, osr
from qgis.core import QgsProject, QgsRasterLayer, QgsVectorLayer

from bare_earth.plugin.styles import layers

ALGORITHM = "bareearth:change"


def terrain(path, heap=0.0, side=80):
    x, y = np.meshgrid(np.arange(side), np.arange(side))
    near = np.minimum(np.hypot(x - 40, y - 40) / 12.0, 1.0)
    noise = np.random.default_rng(int(heap) + 1).normal(0.0, 0.01, x.shape)
    heights = 50.0 + 0.02 * x + heap / 2.0 * (1.0 + np.cos(np.pi * near)) + noise
    raster = gdal.GetDriverByName("GTiff").Create(str(path), side, side, 1, gdal.GDT_Float32)
    raster.SetGeoTransform((570_000.0, 1.0, 0.0, 5_932_500.0, 0.0, -1.0))
    crs = osr.SpatialReference()
    crs.ImportFromEPSG(25832)
    raster.SetProjection(crs.ExportToWkt())
    raster.GetRasterBand(1).WriteArray(heights.astype(np.float32))
    raster = None
    return str(path)


def test_two_rasters_one_of_them_a_layer(registry, tmp_path, context, log):
    old = QgsRasterLayer(terrain(tmp_path / "old.tif"), "old")
    new = terrain(tmp_path / "new.tif", 2.0)
    QgsProject.instance().addMapLayer(old)
    out = {name: str(tmp_path / f"{name}.tif") for name in ("OUTPUT", "LIMIT")}
    out.update(PLACES=str(tmp_path / "p.gpkg"), REPORT=str(tmp_path / "page.html"))
    algorithm = registry.createAlgorithmById(ALGORITHM)
    results, ok = algorithm.run({"OLD": old.id(), "NEW": new, **out}, context, log)
    assert ok, log.text
    assert results["PLACE_COUNT"] == 1 and abs(results["VOLUME_UP"] - 269.0) < 10.0
    assert f"bare-earth change {tmp_path / 'old.tif'} {new}" in log.text
    places = QgsVectorLayer(out["PLACES"])
    layers.look_of("places of change").dress(places)
    assert places.featureCount() == 1
    labels = [rule.label() for rule in places.renderer().rootRule().children()]
    assert labels == ["Risen", "Sunk", "Probably no earth"]
    shown = QgsRasterLayer(out["OUTPUT"])
    layers.look_of("change").dress(shown)
    ramp = shown.renderer().shader().rasterShaderFunction()
    assert ramp.minimumValue() == -ramp.maximumValue() < 0.0


def test_canopy_of_two_rasters(registry, tmp_path, context, log):
    heights = {"OLD": terrain(tmp_path / "old.tif"), "NEW": terrain(tmp_path / "new.tif", 2.0)}
    out = {"OUTPUT": str(tmp_path / "out.tif"), "PLACES": str(tmp_path / "p.gpkg")}
    algorithm = registry.createAlgorithmById("bareearth:canopychange")
    results, ok = algorithm.run({**heights, **out, "LEAST_HEIGHT": 51.6}, context, log)
    assert ok, log.text
    assert (
        results["PLACE_COUNT"] == 1
        and results["GAINED_AREA"] > 100.0 == 100.0 + results["LOST_AREA"]
    )
    places = QgsVectorLayer(out["PLACES"])
    layers.look_of("places of change").dress(places)
    rule = places.renderer().rootRule().children()[0]
    (place,) = places.getFeatures(rule.filterExpression())
    assert place["KIND"] == "canopy gained"


def test_points_are_files_that_qgis_need_not_load(registry, scene, tmp_path, context, log):
    cloud = scene.with_classes(tmp_path / "ground.laz", other=1)
    algorithm = registry.createAlgorithmById(ALGORITHM)
    given = {"OLD": str(cloud), "NEW": str(cloud), "FIND_GROUND": False}
    results, ok = algorithm.run({**given, "OUTPUT": str(tmp_path / "d.tif")}, context, log)
    assert ok, log.text
    assert results["PLACE_COUNT"] == 0 and results["SHIFT"] == 0.0
