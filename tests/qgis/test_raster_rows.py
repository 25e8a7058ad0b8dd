"""A row of the table of rasters is in the dialog, and its layer looks as it says."""

import pytest
from qgis.core import QgsProcessingOutputLayerDefinition, QgsProject
from toy_raster import NAME, add_toy

ID = "bareearth:terrainmodel"


@pytest.fixture
def toy(registry, monkeypatch):
    provider, row = registry.providerById("bareearth"), add_toy(monkeypatch)
    provider.refreshAlgorithms()
    yield row
    monkeypatch.undo()
    provider.refreshAlgorithms()


def test_the_dialog_has_its_field_and_its_help(registry, toy):
    algorithm = registry.createAlgorithmById(ID)
    field = algorithm.parameterDefinition(NAME.upper())
    assert (field.description(), field.help()) == (toy.title, toy.help)
    assert f"<b>{toy.title}</b>: {toy.help}" in algorithm.shortHelpString()


def test_its_layer_has_its_title_its_legend_and_its_colours(toy, scene, tmp_path):
    import processing

    scene.with_classes(scene.path)
    path = str(tmp_path / "toy.tif")
    output = QgsProcessingOutputLayerDefinition(path, QgsProject.instance())
    processing.runAndLoadResults(ID, {"INPUT": str(scene.path), NAME.upper(): output})
    (layer,) = QgsProject.instance().mapLayers().values()
    assert layer.name().endswith(f": {toy.title}") and layer.source() == path
    renderer = layer.renderer()
    assert renderer.type() == "singlebandpseudocolor" and renderer.classificationMin() == 0.0
    root = QgsProject.instance().layerTreeRoot()
    legend = root.findLayer(layer.id()).customProperty("legend/label-0")
    assert legend == "Roughness, m"
    QgsProject.instance().clear()
