"""The point cloud that a dialog suggests as input."""

import numpy as np
import pytest
from osgeo import gdal
from qgis.core import QgsPointCloudLayer, QgsProject, QgsProviderRegistry, QgsRasterLayer
from support import ALGORITHM

ONE_STEP = "bareearth:pointcloudtoterrain"
needs_copc = pytest.mark.skipif(
    "copc" not in QgsProviderRegistry.instance().providerList(), reason="shows no point clouds"
)


@pytest.fixture
def raster(tmp_path, context):
    """A raster layer of the project."""
    path = str(tmp_path / "r.tif")
    made = gdal.GetDriverByName("GTiff").Create(path, 4, 4)
    made.GetRasterBand(1).WriteArray(np.ones((4, 4)))
    made = None
    return QgsProject.instance().addMapLayer(QgsRasterLayer(path, "raster"))


@pytest.fixture
def cloud(scene, raster, tmp_path):
    """A point cloud layer of the project, below a raster."""
    import processing

    path = str(tmp_path / "c.copc.laz")
    processing.run(ALGORITHM, {"INPUT": str(scene.path), "OUTPUT": path})
    layer = QgsPointCloudLayer(path, "cloud", "copc")
    QgsProject.instance().addMapLayer(layer, False)
    QgsProject.instance().layerTreeRoot().addLayer(layer)
    return layer


def input_of(dialog):
    return dialog.mainWidget().wrappers["INPUT"].parameterValue()


@pytest.mark.parametrize("name", [ALGORITHM, ONE_STEP, "bareearth:terrainmodel"])
def test_a_raster_is_no_point_cloud(name, dialog_of, raster):
    assert input_of(dialog_of(name)) in (None, "")


@needs_copc
@pytest.mark.parametrize("name", [ALGORITHM, ONE_STEP, "bareearth:terrainmodel"])
def test_the_point_cloud_of_the_project_is_chosen(name, dialog_of, cloud):
    dialog = dialog_of(name)
    assert input_of(dialog) == cloud.id()
    assert dialog.createProcessingParameters()["INPUT"] == cloud.id()


@needs_copc
def test_the_active_layer_comes_first(dialog_of, cloud, monkeypatch):
    import qgis.utils

    second = QgsPointCloudLayer(cloud.source(), "second", "copc")
    QgsProject.instance().addMapLayer(second)

    class Window:
        active = cloud

        def activeLayer(self):
            return self.active

        def __getattr__(self, name):
            return lambda *_: None

    assert input_of(dialog_of(ALGORITHM)) == second.id()
    monkeypatch.setattr(qgis.utils, "iface", Window())
    assert input_of(dialog_of(ALGORITHM)) == cloud.id()


@needs_copc
@pytest.mark.parametrize("name", [ALGORITHM, ONE_STEP])
def test_what_is_given_counts_more(name, dialog_of, cloud, scene):
    dialog = dialog_of(name)
    dialog.setParameters({"INPUT": str(scene.path)})
    assert input_of(dialog) == str(scene.path)


@needs_copc
def test_a_folder_takes_its_place(dialog_of, cloud, scene, tmp_path):
    dialog = dialog_of(ONE_STEP)
    dialog.setParameters({"INPUT_FOLDER": str(tmp_path)})
    assert input_of(dialog) in (None, "")
    # What the user has chosen stays.
    dialog = dialog_of(ONE_STEP)
    dialog.setParameters({"INPUT": str(scene.path)})
    dialog.setParameters({"INPUT_FOLDER": str(tmp_path)})
    assert input_of(dialog) == str(scene.path)


@needs_copc
def test_a_run_of_the_history_with_a_folder_has_no_other_input(dialog_of, cloud, tmp_path):
    dialog = dialog_of(ONE_STEP)
    dialog.setParameters({"INPUT": None, "INPUT_FOLDER": str(tmp_path)})
    values = dialog.createProcessingParameters()
    assert not values.get("INPUT") and values["INPUT_FOLDER"] == str(tmp_path)
