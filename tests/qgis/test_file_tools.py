"""A tool for files that is declared is in the toolbox, and runs."""

import numpy as np
import pytest
from osgeo import gdal, osr
from qgis.core import QgsProject
from toy_file_tool import TOOL, add_toy

ID = f"bareearth:{TOOL.identifier}"


@pytest.fixture
def provider(registry, monkeypatch):
    provider = registry.providerById("bareearth")
    add_toy(monkeypatch)
    provider.refreshAlgorithms()
    yield provider
    monkeypatch.undo()
    provider.refreshAlgorithms()


@pytest.fixture
def land(tmp_path):
    path = str(tmp_path / "land.tif")
    raster = gdal.GetDriverByName("GTiff").Create(path, 4, 3, 1, gdal.GDT_Float32)
    raster.SetGeoTransform((500_000.0, 1.0, 0.0, 5_700_000.0, 0.0, -1.0))
    reference = osr.SpatialReference()
    reference.ImportFromEPSG(25832)
    raster.SetProjection(reference.ExportToWkt())
    raster.GetRasterBand(1).Fill(100.0)
    return path


def test_a_new_tool_is_in_the_toolbox_with_its_help(registry, provider):
    algorithm = registry.createAlgorithmById(ID)
    assert (algorithm.displayName(), algorithm.group()) == (TOOL.title, "Products")
    assert algorithm.shortDescription() == TOOL.line and "toy" in algorithm.tags()
    names = [field.name() for field in algorithm.parameterDefinitions()]
    assert names == ["INPUT", "LIFT", "OUTPUT"]
    assert [made.name() for made in algorithm.outputDefinitions()] == ["OUTPUT", "CELL_COUNT"]
    text = algorithm.shortHelpString()
    assert text.startswith(TOOL.help) and "How much higher all land gets." in text


def test_a_new_tool_runs_and_its_layer_has_a_style(provider, land, tmp_path, log):
    import processing

    target = str(tmp_path / "high.tif")
    values = {"INPUT": land, "LIFT": 5, "OUTPUT": target}
    results = processing.runAndLoadResults(ID, values, feedback=log)
    assert results == {"OUTPUT": target, "CELL_COUNT": 12}
    assert np.all(gdal.Open(target).ReadAsArray() == 105.0)
    assert f"bare-earth lift {land} {target} --lift 5.0" in log.text
    (layer,) = QgsProject.instance().mapLayers().values()
    assert layer.name() == "land: Terrain model"
    assert layer.renderer().type() == "singlebandpseudocolor"
    QgsProject.instance().clear()
