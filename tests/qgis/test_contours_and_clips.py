"""Contour lines, canopy heights and clips, as the toolbox makes and shows them."""

import shlex

import laspy
import numpy as np
import pytest
from osgeo import gdal
from qgis.core import QgsProject, QgsVectorLayer
from support import Log, title_of, write_raster

gdal.UseExceptions()


def pits():
    """Return a slope with a pit and a knoll of 1.5 m."""
    row, column = np.mgrid[:80.0, :90.0]
    heights = 300.2 + 0.01 * column
    for east, height in ((25, -1.5), (65, 1.5)):
        heights += height * np.exp(-((row - 40) ** 2 + (column - east) ** 2) / 2 / 3**2)
    return heights


def ran(registry, name, values, context):
    """Return the results of a run, and what its command line does as well."""
    from bare_earth.algorithms.cli import main

    log = Log()
    results, done = registry.createAlgorithmById(name).run(values, context, log)
    assert done, log.text
    (command,) = [line for line in log.said if line.startswith("bare-earth ")]
    assert main(shlex.split(command)[1:]) == 0
    return results


@pytest.mark.parametrize("ending", ["gpkg", "dxf"])
def test_contour_lines_mark_depressions(registry, tmp_path, context, ending):
    values = {
        "INPUT": write_raster(tmp_path / "dtm.tif", pits()), "CONTOUR_INTERVAL": 0.5,
        "OUTPUT": str(tmp_path / f"lines.{ending}"),
    }  # fmt: skip
    results = ran(registry, "bareearth:contours", values, context)
    layer = QgsVectorLayer(results["OUTPUT"], "lines")
    assert results["LINE_COUNT"] == layer.featureCount() > 5 and results["HEIGHT"] == 0.5
    for feature in layer.getFeatures():
        corners = [(at.x(), at.y()) for at in feature.geometry().vertices()]
        east = np.mean(corners, axis=0)[0] - 500_000
        is_pit = corners[0] == corners[-1] and east < 45
        if ending == "dxf":
            assert feature["Layer"].startswith("DEPRESSION") == is_pit
        else:
            assert bool(feature["DEPRESSION"]) == is_pit


@pytest.mark.parametrize("ending", ["gpkg", "dxf"])
def test_contour_lines_load_with_index_lines_and_ticks(tmp_path, ending):
    import processing

    values = {
        "INPUT": write_raster(tmp_path / "dtm.tif", pits()), "CONTOUR_INTERVAL": 0.5,
        "OUTPUT": str(tmp_path / f"lines.{ending}"),
    }  # fmt: skip
    processing.runAndLoadResults("bareearth:contours", values)
    loaded = QgsProject.instance().mapLayers().values()
    (layer,) = (layer for layer in loaded if str(tmp_path) in layer.source())
    assert title_of(layer) == "Contour lines"
    rules = layer.renderer().rootRule().children()
    assert [rule.label() for rule in rules] == ["Every 2.5 m", "Every 0.5 m", "Depression"]
    assert rules[2].symbol().symbolLayer(0).layerType() == "HashLine"
    assert layer.labelsEnabled() == (ending == "gpkg")


def test_a_canopy_of_two_rasters(registry, tmp_path, context):
    land = pits()
    values = {
        "SURFACE": write_raster(tmp_path / "dsm.tif", land + 4.0 * (land > 300.8)),
        "TERRAIN": write_raster(tmp_path / "dtm.tif", land),
        "OUTPUT": str(tmp_path / "chm.tif"),
    }
    results = ran(registry, "bareearth:canopyheight", values, context)
    assert results["MAXIMUM"] == pytest.approx(4.0, abs=1e-4) and results["CELL_COUNT"] == land.size
    assert np.allclose(gdal.Open(results["OUTPUT"]).ReadAsArray(), 4.0 * (land > 300.8), atol=1e-3)


def test_a_clip_holds_the_points_of_an_extent_in_another_crs(registry, scene, tmp_path, context):
    # The middle of the scene, in longitude and latitude.
    extent = "9.0003,9.0007,51.45145,51.45165 [EPSG:4326]"
    values = {"INPUT": str(scene.path), "EXTENT": extent, "OUTPUT": str(tmp_path / "part.las")}
    results = ran(registry, "bareearth:clip", values, context)
    part, whole = laspy.read(results["OUTPUT"]), laspy.read(scene.path)
    assert 0 < results["POINT_COUNT"] == part.header.point_count < whole.header.point_count
    records = {row.tobytes() for row in whole.points.array}
    assert all(row.tobytes() in records for row in part.points.array)


def test_a_clip_without_an_area_is_refused(registry, scene, tmp_path, context):
    log, values = Log(), {"INPUT": str(scene.path), "OUTPUT": str(tmp_path / "part.las")}
    with pytest.raises(Exception, match="extent or a boundary"):
        registry.createAlgorithmById("bareearth:clip").run(values, context, log, {}, False)
    assert not (tmp_path / "part.las").exists()
