import shlex

import numpy as np
import pytest
from osgeo import gdal
from qgis.core import QgsProcessingException, QgsProject, QgsRasterLayer
from support import write_raster

gdal.UseExceptions()
ALGORITHM = "bareearth:removeoffterrainobjects"


@pytest.fixture
def truth():
    row, column = np.mgrid[:90, :100]
    return 300.0 + 0.1 * column + 0.05 * row


@pytest.fixture
def surface(truth):
    heights = truth.copy()
    heights[20:45, 30:50] = 320.0
    heights[70:74, 60:64] += 6.0
    heights[:4, :4] = np.nan
    return heights


def test_run(registry, truth, surface, tmp_path, context, log):
    from bare_earth.algorithms.cli import main

    parameters = {
        "INPUT": write_raster(tmp_path / "dsm.tif", surface), "OUTPUT": str(tmp_path / "dtm.tif"),
        "MAX_OBJECT_SIZE": 30,
    }  # fmt: skip
    algorithm = registry.createAlgorithmById(ALGORITHM)
    results, done = algorithm.run(parameters, context, log)
    assert done, log.text
    assert results["CELL_COUNT"] == 9000 - 16
    assert results["REMOVED_COUNT"] == 25 * 20 + 4 * 4
    raster = gdal.Open(results["OUTPUT"])
    before = gdal.Open(parameters["INPUT"])
    assert raster.GetGeoTransform() == before.GetGeoTransform()
    assert raster.GetProjection() == before.GetProjection()
    heights = raster.ReadAsArray()
    missing = heights == raster.GetRasterBand(1).GetNoDataValue()
    assert np.array_equal(missing, np.isnan(surface))
    assert np.abs(heights - truth)[~missing].max() < 0.1
    assert log.progress() == 100 and "cells were objects" in log.text
    before = (tmp_path / "dtm.tif").read_bytes()
    command = next(shlex.split(line) for line in log.said if line.startswith("bare-earth "))
    assert main(command[1:]) == 0
    assert (tmp_path / "dtm.tif").read_bytes() == before


def test_a_layer_of_the_project_and_a_temporary_output(surface, tmp_path, context):
    import processing

    layer = QgsRasterLayer(write_raster(tmp_path / "dsm.tif", surface), "surface")
    QgsProject.instance().addMapLayer(layer)
    for value in (layer, layer.id(), "surface"):
        results = processing.run(
            ALGORITHM, {"INPUT": value, "OUTPUT": "TEMPORARY_OUTPUT"}, context=context
        )
        assert results["REMOVED_COUNT"] == 516 and results["OUTPUT"].endswith(".tif")


@pytest.mark.parametrize(("epsg", "words"), [(4326, "projected CRS"), (25832, "same file")])
def test_errors_are_one_line(epsg, words, surface, tmp_path, log):
    import processing

    path = write_raster(tmp_path / "dsm.tif", surface, epsg)
    output = path if words == "same file" else str(tmp_path / "dtm.tif")
    with pytest.raises(QgsProcessingException, match=words) as error:
        processing.run(ALGORITHM, {"INPUT": path, "OUTPUT": output}, feedback=log)
    # QGIS puts a line before what is refused before a run.
    told = str(error.value).replace("Unable to execute algorithm\n", "")
    assert "\n" not in told and "Traceback" not in log.text
    assert [file.name for file in tmp_path.iterdir()] == ["dsm.tif"]


def test_a_layer_that_is_no_file_is_refused(registry, context, log):
    # A raster of a provider other than GDAL's, that needs no network.
    layer = QgsRasterLayer("type=xyz&url=http://localhost/{z}/{x}/{y}.png", "tiles", "wms")
    parameters = {"INPUT": layer, "OUTPUT": "TEMPORARY_OUTPUT"}
    QgsProject.instance().addMapLayer(layer)
    with pytest.raises(QgsProcessingException, match="not a file"):
        registry.createAlgorithmById(ALGORITHM).create().prepareAlgorithm(parameters, context, log)


def test_cancel_leaves_nothing(registry, surface, tmp_path, context):
    from support import Log

    path = write_raster(tmp_path / "dsm.tif", surface)
    for percent in (5, 60, 85):
        log = Log(cancel_at=percent)
        algorithm = registry.createAlgorithmById(ALGORITHM)
        parameters = {"INPUT": path, "OUTPUT": str(tmp_path / "dtm.tif")}
        assert algorithm.run(parameters, context, log)[0] == {}
        assert [file.name for file in tmp_path.iterdir()] == ["dsm.tif"]
