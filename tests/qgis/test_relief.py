import shlex

import numpy as np
import pytest
from osgeo import gdal
from qgis.core import QgsProject, QgsRasterLayer
from support import Log, title_of, write_raster

from bare_earth.algorithms.tools.relief import KINDS
from bare_earth.plugin.styles import layers

gdal.UseExceptions()
ALGORITHM = "bareearth:relief"


@pytest.fixture
def terrain(tmp_path):
    """Write a slope with a bank, and a corner without heights."""
    row, column = np.mgrid[:80, :90]
    heights = 300.0 + 0.1 * column + 0.8 * (np.abs(row - column) < 3)
    heights[:5, -5:] = np.nan
    return write_raster(tmp_path / "dtm.tif", heights)


def outputs_of(kinds):
    return [
        "RELIEF" if kind == "local-relief" else kind.replace("-", "_").upper() for kind in kinds
    ]


def test_each_kind_is_made_and_the_log_has_a_command_that_does_the_same(
    registry, terrain, tmp_path, context, log
):
    from bare_earth.algorithms.cli import main

    folder = tmp_path / "relief"
    parameters = {
        "INPUT": terrain, "KINDS": list(KINDS), "RELIEF_RADIUS": 5, "OUTPUT_FOLDER": str(folder),
    }  # fmt: skip
    results, done = registry.createAlgorithmById(ALGORITHM).run(parameters, context, log)
    assert done, log.text
    assert {path.stem for path in folder.iterdir()} == set(KINDS)
    (command,) = [line for line in log.said if line.startswith("bare-earth relief")]
    words, again = shlex.split(command)[1:], tmp_path / "again"
    words[2] = str(again)
    assert main(words) == 0
    for name, kind in zip(outputs_of(KINDS), KINDS):
        made = gdal.Open(results[name])
        cells = made.ReadAsArray()
        assert np.array_equal(gdal.Open(str(again / f"{kind}.tif")).ReadAsArray(), cells), kind
        nodata = made.GetRasterBand(1).GetNoDataValue()
        assert np.all(cells[..., :5, -5:] == nodata) and np.all(cells[..., 5:, :] != nodata)
        assert made.GetGeoTransform() == gdal.Open(terrain).GetGeoTransform()


def test_the_layers_have_their_styles_and_names(terrain, tmp_path):
    import processing

    kinds = list(KINDS)
    parameters = {"INPUT": terrain, "KINDS": kinds, "OUTPUT_FOLDER": str(tmp_path / "relief")}
    processing.runAndLoadResults(ALGORITHM, parameters)
    layers = {title_of(layer): layer for layer in QgsProject.instance().mapLayers().values()}
    assert len(layers) == len(kinds)
    assert layers["Red relief image map"].renderer().type() == "multibandcolor"
    assert layers["Archaeological topography (VAT)"].renderer().type() == "singlebandgray"
    assert layers["Sky-view factor"].renderer().type() == "singlebandpseudocolor"
    tree = QgsProject.instance().layerTreeRoot()
    shown = {
        name for name, value in layers.items() if tree.findLayer(value.id()).itemVisibilityChecked()
    }
    assert shown == {"Archaeological topography (VAT)", "Hillshade"}
    QgsProject.instance().clear()


def test_level_land_is_white_sky_and_not_speckle(tmp_path):
    layer = QgsRasterLayer(write_raster(tmp_path / "sky.tif", np.full((9, 9), 0.999)))
    layers.raster_looks()["SKY_VIEW"].dress(layer)
    shader = layer.renderer()
    assert shader.classificationMin() == pytest.approx(0.9) and shader.classificationMax() == 1.0


@pytest.mark.parametrize("percent", [5, 40, 80])
def test_a_cancel_leaves_old_files_and_nothing_else(registry, terrain, tmp_path, context, percent):
    folder = tmp_path / "relief"
    kinds = ["vat", "slope", "red-relief"]
    values = {"INPUT": terrain, "KINDS": kinds, "OUTPUT_FOLDER": str(folder)}
    algorithm = registry.createAlgorithmById(ALGORITHM)
    log = Log(cancel_at=percent)
    assert algorithm.run(values, context, log)[0] == {} and "nothing was written" in log.text
    assert not folder.exists() and not context.layersToLoadOnCompletion()
    folder.mkdir()
    (folder / "vat.tif").write_bytes(b"old")
    algorithm.run(values, context, Log(cancel_at=percent))
    assert [path.name for path in folder.iterdir()] == ["vat.tif"]
    assert (folder / "vat.tif").read_bytes() == b"old"


def test_no_kind_is_refused(registry, terrain, tmp_path, context):
    algorithm = registry.createAlgorithmById(ALGORITHM)
    values = {"INPUT": terrain, "KINDS": [], "OUTPUT_FOLDER": str(tmp_path / "relief")}
    possible, text = algorithm.checkParameterValues(values, context)
    assert not possible and "choose at least one" in text


@pytest.mark.parametrize("name", ["relief", "removeoffterrainobjects"])
def test_a_point_cloud_is_no_raster(registry, scene, tmp_path, context, name):
    algorithm = registry.createAlgorithmById(f"bareearth:{name}")
    for path, words in ((scene.path, "not a raster"), (tmp_path / "none.tif", "does not exist")):
        fits, text = algorithm.checkParameterValues({"INPUT": str(path)}, context)
        assert not fits and text.startswith(f"{path} ") and words in text
