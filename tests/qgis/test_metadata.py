"""What layers say about the run that made them."""

import re

import pytest
from osgeo import gdal
from qgis.core import QgsProcessingOutputLayerDefinition, QgsProject
from support import ALGORITHM, title_of

from bare_earth import __version__

OUTPUTS = {
    "bareearth:pointcloudtoterrain": {"DTM": "dtm.tif", "CONTOURS": "lines.gpkg"},
    "bareearth:terraincontours": {"ground:DTM": "dtm.tif", "contours:OUTPUT": "lines.gpkg"},
}


def run(name, values, outputs, folder):
    import processing

    project = QgsProject.instance()
    loaded = {
        key: QgsProcessingOutputLayerDefinition(str(folder / file), project)
        for key, file in outputs.items()
    }
    processing.runAndLoadResults(name, {**values, **loaded})
    return {title_of(layer): layer for layer in project.mapLayers().values()}


@pytest.mark.rest
@pytest.mark.parametrize("name", OUTPUTS)
def test_a_layer_says_what_made_it_when_and_how(name, scene, tmp_path, context, registry):
    given = {"INPUT": str(scene.path), "DTM_CELL_SIZE": 2.0}
    layers = run(name, given, OUTPUTS[name], tmp_path)
    for title in ("Terrain model", "Contour lines"):
        about = layers[title].metadata()
        assert about.title() == f"scene: {title}"
        (entry,) = about.history()
        assert re.match(r"\d{4}-\d\d-\d\d \d\d:\d\d:\d\d[+-]\d\d:\d\d: ", entry)
        assert entry.endswith(f", Bare Earth {__version__}")
        assert str(scene.path) in about.abstract()
        assert re.search(r"Cell size.*: 2\.0", about.abstract())
    algorithm = registry.createAlgorithmById(name)
    assert algorithm.displayName() in layers["Contour lines"].metadata().history()[0]
    if name == "bareearth:pointcloudtoterrain":
        assert "bare-earth classify " in layers["Terrain model"].metadata().abstract()
    run(name, {**given, "DTM_CELL_SIZE": 4.0}, OUTPUTS[name], tmp_path)
    about = layers["Terrain model"].metadata()
    assert len(about.history()) == 2
    assert re.search(r"Cell size.*: 4\.0", about.abstract())


def test_a_raster_says_what_made_it(scene, tmp_path, context):
    run(ALGORITHM, {"INPUT": str(scene.path), "OUTPUT": str(tmp_path / "o.las")},
        {"DTM": "dtm.tif"}, tmp_path)  # fmt: skip
    said = gdal.Open(str(tmp_path / "dtm.tif")).GetMetadata()
    assert said["TIFFTAG_SOFTWARE"] == f"Bare Earth {__version__}"
    assert said["TIFFTAG_IMAGEDESCRIPTION"] == "Height, m"
