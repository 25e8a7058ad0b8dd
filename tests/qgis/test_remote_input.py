"""Remote point clouds as inputs: an address, or a layer of QGIS that shows one."""

import laspy
import numpy as np
import pytest
from qgis.core import (
    QgsCoordinateReferenceSystem,
    QgsCoordinateTransform,
    QgsPointCloudLayer,
    QgsProject,
    QgsProviderRegistry,
    QgsRectangle,
)
from remote_server import serving
from support import ALGORITHM, remove

FETCH = "bareearth:fetch"
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
    assert "Downloads " in log.text and " requests" in log.text
    assert "bare-earth fetch http://127.0.0.1" in log.text and "SECRET" not in log.text


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
        assert wrapper.wrappedWidget().currentText() == "far away"
    finally:
        remove(dialog)
    QgsProject.instance().clear()


def test_a_refusal_of_the_server_is_one_sentence(server, address, tmp_path, log):
    import processing
    from qgis.core import QgsProcessingException

    server.fault = lambda number, path: "403"
    with pytest.raises(QgsProcessingException, match=r"has expired\. Get a new address"):
        processing.run(
            FETCH, {"ADDRESS": address, "OUTPUT": str(tmp_path / "part.laz")}, feedback=log
        )
    assert not list(tmp_path.glob("part*"))


def test_a_new_dialog_shows_the_extent_of_the_map(registry, monkeypatch):
    from processing.gui.AlgorithmDialog import AlgorithmDialog
    from qgis import utils
    from qgis.gui import QgsMapCanvas

    canvas = QgsMapCanvas()
    canvas.setDestinationCrs(QgsCoordinateReferenceSystem("EPSG:25832"))
    canvas.resize(300, 200)
    canvas.setExtent(QgsRectangle(500_000.0, 5_700_000.0, 500_300.0, 5_700_200.0))

    class Window:
        def mapCanvas(self):
            return canvas

        def mainWindow(self):
            return None

        def activeLayer(self):
            return None

    monkeypatch.setattr(utils, "iface", Window())
    algorithm = registry.createAlgorithmById(FETCH)
    field = algorithm.parameterDefinition("EXTENT")
    assert field.defaultValue() is None  # of models and scripts
    assert field.guiDefaultValueOverride().endswith("[EPSG:25832]")
    monkeypatch.undo()
    dialog = AlgorithmDialog(algorithm)
    try:
        wrappers = dialog.mainWidget().wrappers
        assert str(wrappers["EXTENT"].parameterValue()).startswith("500")
        # No layer is remote, so that an address is typed.
        box = wrappers["ADDRESS"].wrappedWidget()
        assert box.isEditable() and not box.currentText()
        box.setEditText(" https://example.org/a.copc.laz ")
        assert wrappers["ADDRESS"].parameterValue() == "https://example.org/a.copc.laz"
    finally:
        remove(dialog)
        remove(canvas)
