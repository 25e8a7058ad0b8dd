"""Remote point clouds as inputs: an address, or a layer of QGIS that shows one."""

import laspy
import numpy as np
import pytest
from qgis.core import (
    QgsCoordinateReferenceSystem,
    QgsCoordinateTransform,
    QgsPointCloudLayer,
    QgsProcessingContext,
    QgsProcessingOutputLayerDefinition,
    QgsProject,
    QgsProviderRegistry,
    QgsRectangle,
)
from qgis.gui import QgsMapCanvas
from qgis.PyQt.QtWidgets import QComboBox
from remote_server import serving
from support import ALGORITHM, remove

FETCH, ONE_STEP = "bareearth:fetch", "bareearth:pointcloudtoterrain"
needs_copc = pytest.mark.skipif(
    "copc" not in QgsProviderRegistry.instance().providerList(), reason="shows no point clouds"
)


@pytest.fixture
def cloud(scene, tmp_path_factory):
    import processing

    path = tmp_path_factory.mktemp("remote") / "c.copc.laz"
    processing.run(ALGORITHM, {"INPUT": str(scene.path), "OUTPUT": str(path)})
    return path


@pytest.fixture
def server():
    with serving() as running:
        yield running


@pytest.fixture
def address(server, cloud):
    return f"{server.add('c.copc.laz', cloud.read_bytes())}?sig=SECRET"


@pytest.fixture
def corner(cloud):
    """Return a box round a quarter of the points, and how many lie in it."""
    with laspy.open(cloud) as file:
        points = file.read()
    middle_x, middle_y = np.median(points.x), np.median(points.y)
    box = points.x.min(), middle_x, points.y.min(), middle_y
    return box, int(((points.x <= middle_x) & (points.y <= middle_y)).sum())


def count_of(path):
    with laspy.open(path) as file:
        return file.header.point_count


def extent(box, crs=""):
    return ",".join(map(repr, map(float, box))) + (f" [{crs}]" if crs else "")


def code_of(path):
    with laspy.open(path) as file:
        return file.header.parse_crs().to_epsg()


def test_part_of_an_address_is_downloaded(address, corner, tmp_path, log):
    import processing

    box, count = corner
    target = str(tmp_path / "part.laz")
    values = {"ADDRESS": address, "EXTENT": extent(box), "OUTPUT": target}
    results = processing.run(FETCH, values, feedback=log)
    assert results["POINT_COUNT"] == count == count_of(target)
    assert "Downloads " in log.text and " request" in log.text
    assert "bare-earth fetch http://127.0.0.1" in log.text and "SECRET" not in log.text


@needs_copc
def test_the_layer_of_a_download_has_the_name_of_its_source(address, corner):
    import processing

    project, context, (box, _) = QgsProject.instance(), QgsProcessingContext(), corner
    context.setProject(project)
    target = QgsProcessingOutputLayerDefinition("TEMPORARY_OUTPUT", project)
    values = {"ADDRESS": address, "EXTENT": extent(box), "OUTPUT": target}
    processing.run(FETCH, values, context=context)
    names = [details.name for details in context.layersToLoadOnCompletion().values()]
    assert names == ["c: Downloaded point cloud"]


def test_an_extent_in_another_crs_is_transformed(address, cloud, corner, tmp_path, log):
    import processing

    box, count = corner
    west, east, south, north = box
    points = QgsCoordinateReferenceSystem.fromEpsgId(25832)
    mercator = QgsCoordinateReferenceSystem("EPSG:3857")
    move = QgsCoordinateTransform(points, mercator, QgsProject.instance())
    moved = move.transformBoundingBox(QgsRectangle(west, south, east, north))
    edges = moved.xMinimum(), moved.xMaximum(), moved.yMinimum(), moved.yMaximum()
    target = str(tmp_path / "part.laz")
    values = {"ADDRESS": address, "EXTENT": extent(edges, "EPSG:3857"), "OUTPUT": target}
    results = processing.run(FETCH, values, feedback=log)
    # The rectangle round the turned one is somewhat larger.
    assert count <= results["POINT_COUNT"] <= 1.2 * count
    assert "--boundary boundary.geojson" in log.text


@needs_copc
def test_part_of_a_layer_is_downloaded(registry, address, corner, tmp_path, log):
    import processing
    from processing.gui.AlgorithmDialog import AlgorithmDialog

    layer = QgsPointCloudLayer(address, "far away", "copc")
    assert layer.isValid()
    QgsProject.instance().addMapLayer(layer)
    box, count = corner
    target = str(tmp_path / "part.copc.laz")
    values = {"ADDRESS": layer.id(), "EXTENT": extent(box), "OUTPUT": target}
    results = processing.run(FETCH, values, feedback=log)
    assert results["POINT_COUNT"] == count == count_of(target)
    assert "--extent" in log.text and "SECRET" not in log.text
    dialog = AlgorithmDialog(registry.createAlgorithmById(FETCH))
    try:
        wrapper = dialog.mainWidget().wrappers["ADDRESS"]
        assert wrapper.parameterValue() == layer.id()
        assert names_in(dialog, "ADDRESS").currentText().startswith("far away")
    finally:
        remove(dialog)
    QgsProject.instance().clear()


def test_a_refusal_of_the_server_is_one_sentence(server, address, tmp_path, log):
    import processing
    from qgis.core import QgsProcessingException

    server.fault = lambda number, path: "403"
    with pytest.raises(QgsProcessingException, match=r"expired.* address"):
        processing.run(
            FETCH, {"ADDRESS": address, "OUTPUT": str(tmp_path / "part.laz")}, feedback=log
        )
    assert not list(tmp_path.glob("part*"))


@pytest.fixture
def canvas(monkeypatch):
    """The map of a window, which shows the west of the scene."""
    from qgis import utils

    canvas = QgsMapCanvas()
    canvas.setDestinationCrs(QgsCoordinateReferenceSystem("EPSG:25832"))
    canvas.resize(300, 600)
    canvas.setExtent(QgsRectangle(500_000.0, 5_700_000.0, 500_040.0, 5_700_080.0))

    class Window:
        active = None

        def mapCanvas(self):
            return canvas

        def mainWindow(self):
            return None

        def activeLayer(self):
            return self.active

    monkeypatch.setattr(utils, "iface", Window())
    yield canvas
    monkeypatch.undo()
    remove(canvas)


def field_of(dialog, name):
    return dialog.mainWidget().wrappers[name]


def names_in(dialog, name="INPUT"):
    return field_of(dialog, name).wrappedWidget().findChildren(QComboBox)[0]


@pytest.mark.parametrize("name, field", [(FETCH, "ADDRESS"), (ONE_STEP, "INPUT")])
def test_an_address_is_typed_and_the_extent_is_that_of_the_map(canvas, dialog_of, name, field):
    dialog = dialog_of(name)
    extent = field_of(dialog, "EXTENT")
    assert not extent.parameterValue()
    names_in(dialog, field).setEditText(" https://example.org/a.copc.laz ")
    values = dialog.createProcessingParameters()
    assert values[field] == "https://example.org/a.copc.laz"
    west, _, _, north = map(float, values["EXTENT"].partition(" ")[0].split(","))
    assert west <= 500_000.0 and north >= 5_700_080.0 and values["EXTENT"].endswith("[EPSG:25832]")
    # Of a file on this computer all points are used.
    names_in(dialog, field).setEditText("/tmp/a.laz")
    assert not extent.parameterValue()


def test_an_extent_of_the_user_stays(canvas, dialog_of):
    dialog = dialog_of(ONE_STEP)
    own = "500010,500020,5700010,5700020 [EPSG:25832]"
    field_of(dialog, "EXTENT").setParameterValue(own, QgsProcessingContext())
    for text in ("https://example.org/a.copc.laz", "/tmp/a.laz"):
        names_in(dialog).setEditText(text)
        assert field_of(dialog, "EXTENT").parameterValue().startswith("500010")
