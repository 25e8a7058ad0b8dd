"""The overview of a virtual point cloud, which is what the map shows at small scales."""

import pytest
from qgis.core import (
    QgsApplication,
    QgsMapRendererParallelJob,
    QgsMapSettings,
    QgsPointCloudLayer,
    QgsProcessingOutputLayerDefinition,
    QgsProject,
    QgsProviderRegistry,
)
from qgis.PyQt.QtCore import QSize
from support import write_scene

from bare_earth.plugin import compat
from bare_earth.plugin.styles.clouds import categories_of

pytestmark = pytest.mark.skipif(
    "vpc" not in QgsProviderRegistry.instance().providerList(), reason="shows no point clouds"
)


def colours_of(layers):
    """Count the colours of a small map of all files."""
    settings = QgsMapSettings()
    settings.setLayers(layers)
    settings.setDestinationCrs(layers[0].crs())
    settings.setOutputSize(QSize(120, 60))
    settings.setExtent(layers[0].extent().buffered(20))
    job = QgsMapRendererParallelJob(settings)
    job.start()
    job.waitForFinished()
    image, counts = job.renderedImage(), {}
    for x in range(120):
        for y in range(60):
            name = image.pixelColor(x, y).name()
            counts[name] = counts.get(name, 0) + 1
    return counts


def test_points_are_seen_at_once_at_a_small_scale(tmp_path, context):
    import processing

    (tmp_path / "in").mkdir()
    for number in range(6):
        origin = 500_000.0 + 80 * (number % 3), 5_700_000.0 + 80 * (number // 3)
        write_scene(tmp_path / "in" / f"{number}.laz", origin=origin)
    project = QgsProject.instance()
    dtm = QgsProcessingOutputLayerDefinition(str(tmp_path / "dtm.tif"), project)
    given = {"INPUT_FOLDER": str(tmp_path / "in"), "OUTPUT_FOLDER": str(tmp_path / "out")}
    given |= {"FORMAT": "copc.laz", "DTM": dtm}
    processing.runAndLoadResults("bareearth:classifytiles", given)
    root = project.layerTreeRoot()
    clouds = [layer for layer in root.layerOrder() if isinstance(layer, QgsPointCloudLayer)]
    names = [cloud.name() for cloud in clouds]
    assert names == (
        ["in: Classes"]
        if compat.SHOWS_OVERVIEWS
        else ["in: Classes", "in: Overview of the classes"]
    )
    assert all(root.findLayer(cloud).isVisible() for cloud in clouds)
    # Only the classes that are there.
    assert {category.value() for category in clouds[0].renderer().categories()} == {1, 2}
    for cloud in clouds:
        cloud.setOpacity(1.0)
    for _ in range(20):
        QgsApplication.processEvents()
    colours = colours_of(clouds)
    for _, (_, colour) in categories_of([1, 2]).items():
        assert colours.get(colour.name(), 0) > 50
