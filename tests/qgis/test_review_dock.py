"""The dock for places to review: sessions, profiles, changes, and ten places in a real window."""

import os
import re
from pathlib import Path
from types import SimpleNamespace

import laspy
import numpy as np
import pytest
from osgeo import gdal
from qgis.core import (
    QgsFeature,
    QgsGeometry,
    QgsProject,
    QgsRasterLayer,
    QgsRectangle,
    QgsVectorLayer,
)
from qgis.gui import QgsMapCanvas
from qgis.PyQt.QtCore import Qt
from qgis.PyQt.QtWidgets import QMainWindow
from support import ALGORITHM, remove
from windows import Qgis

from bare_earth.algorithms.core.errors import BareEarthError
from bare_earth.algorithms.core.points import Frame
from bare_earth.algorithms.rasters.geotiff import HeightBand
from bare_earth.plugin.processing.runs import Sources, sources_of
from bare_earth.plugin.review.again import text_of
from bare_earth.plugin.review.dock import ReviewDock
from bare_earth.plugin.review.session import GROUND, NOT_GROUND, RIGHT, SKIP, Session
from bare_earth.plugin.styles import layers

WEST, SOUTH = 500_000.0, 5_700_000.0
NUMBERS = ("ERROR", "AREA", "SHARE", "LOW", "HIGH", "X1", "Y1", "X2", "Y2")
FIELDS = ("RANK:integer", "REASON:string", "answer:string", *(f"{name}:double" for name in NUMBERS))


def square(x, y, side=4.0):
    return QgsRectangle(WEST + x, SOUTH + y, WEST + x + side, SOUTH + y + side)


@pytest.fixture
def places():
    """Three places in memory, the last rank first."""
    fields = "&".join(f"field={field}" for field in FIELDS)
    layer = QgsVectorLayer(f"Polygon?crs=EPSG:25832&{fields}", "places", "memory")
    for rank in (3, 2, 1):
        feature = QgsFeature(layer.fields())
        box = square(10 * rank, 10)
        feature.setGeometry(QgsGeometry.fromRect(box))
        feature["RANK"], feature["REASON"], feature["ERROR"] = rank, f"reason {rank}", 1.5
        for name, value in zip(("X1", "Y1", "X2", "Y2"), box.toRectF().getCoords()):
            feature[name] = value
        assert layer.dataProvider().addFeatures([feature])[0]
    own = QgsFeature(layer.fields())  # a correction that was carried over
    own.setGeometry(QgsGeometry.fromRect(square(50, 10)))
    own["RANK"] = 4
    assert layer.dataProvider().addFeatures([own])[0]
    return layer


def answers_in(layer):
    """Return the answers that another layer of the same data has, by rank."""
    places = (feature for feature in layer.getFeatures() if feature["REASON"])
    found = {feature["RANK"]: feature["answer"] for feature in places}
    return {rank: answer or "" for rank, answer in found.items()}


def test_answers_are_saved_at_once_and_lead_to_the_next_place(places):
    session = Session(places)
    assert [place.rank for place in session.places] == [1, 2, 3]  # not the user's own polygon
    session.give(RIGHT)
    session.give(NOT_GROUND)
    assert not places.isEditable() and answers_in(places) == {1: RIGHT, 2: NOT_GROUND, 3: ""}
    assert session.place.rank == 3 and session.answered == 2
    # Another session begins where this one ended, and an answer can be changed.
    session = Session(places)
    assert session.place.rank == 3
    session.step(-1)
    session.give(GROUND)
    assert answers_in(places)[2] == GROUND and session.place.rank == 3


def test_skipped_places_are_not_answered_and_the_last_answer_can_be_undone(places):
    session = Session(places)
    session.give(SKIP)
    assert session.answered == 0 and session.place.rank == 2
    session.give(GROUND)
    assert session.corrections == 1
    session.undo()
    assert session.place.rank == 2 and session.corrections == 0
    session.undo()
    assert answers_in(places) == {1: "", 2: "", 3: ""} and not session.can_undo


def test_a_layer_that_is_edited_or_read_only_says_so(places, monkeypatch):
    session = Session(places)
    places.startEditing()
    with pytest.raises(BareEarthError, match="being edited"):
        session.give(RIGHT)
    places.rollBack()
    provider = type(places.dataProvider())
    monkeypatch.setattr(provider, "changeAttributeValues", lambda *_: False, raising=False)
    with pytest.raises(BareEarthError, match="GeoPackage"):
        session.give(RIGHT)
    assert session.place.answer == "" and not session.can_undo


def terrain(heights):
    frame, place = Frame((0.0, 0.0), 1.0, 1.0), (WEST, 1.0, 0.0, SOUTH + 40.0, 0.0, -1.0)
    return HeightBand(heights.astype(np.float32), place, frame, whole=heights.shape)


def test_what_changed_is_told_by_place(places):
    session = Session(places)
    for answer in (NOT_GROUND, RIGHT, GROUND):
        session.give(answer)
    before = np.full((40, 40), 100.0)
    after = before.copy()
    after[26:30, 10:14] -= 2.0  # the first place
    text = text_of(terrain(before), terrain(after), session.places)
    assert re.search("16 m², by -2.00 m .*<a href=", text)
    assert "Place 1</a>: 16 m² by -2.00 m" in text
    assert "Place 3</a>: no change" in text and "Place 2" not in text
    after[0, 0] += 3.0  # elsewhere
    text = text_of(terrain(before), terrain(after), session.places)
    assert text.startswith("The terrain changed on 17 m², by -1.71 m on average and <a href=")
    x1, y1, x2, y2 = map(float, text.split('"')[1].split())
    assert ((x1 + x2) / 2, (y1 + y2) / 2) == (WEST + 0.5, SOUTH + 39.5)
    assert "not changed" in text_of(terrain(before), terrain(before), session.places)
    assert "other cells" in text_of(terrain(before[1:]), terrain(after), session.places)


@pytest.fixture
def reviewed(tmp_path, scene, registry, context, log):
    """A project with the layers of two runs: classified points, and ten places to review."""
    las = laspy.read(scene.path)  # with a mound at the second place
    las.z = las.z + np.exp(-((las.x - WEST - 8.0) ** 2 + (las.y - SOUTH - 29.0) ** 2) / 8.0)
    las.write(scene.path)
    parameters = {"INPUT": str(scene.path), "OUTPUT": str(tmp_path / "points.laz")}
    rasters = {name: str(tmp_path / f"{name}.tif") for name in ("DTM", "EXPECTED_ERROR")}
    _, done = registry.createAlgorithmById(ALGORITHM).run({**parameters, **rasters}, context, log)
    assert done, log.text
    # Ten places instead of those of the scene: in both rows, the second one is on the roof.
    raster = gdal.GetDriverByName("MEM").CreateCopy("", gdal.Open(rasters["EXPECTED_ERROR"]))
    values = np.full((80, 80), 0.1)
    for place in range(10):
        row, column = (5, 48)[place % 2], 5 + 15 * (place // 2)
        values[row : row + 6, column : column + 6] = 3.0 - 0.2 * place
    raster.GetRasterBand(1).WriteArray(values)
    gdal.GetDriverByName("GTiff").CreateCopy(rasters["EXPECTED_ERROR"], raster)
    parameters = {"INPUT": rasters["EXPECTED_ERROR"], "DTM": rasters["DTM"]}
    places = str(tmp_path / "places.gpkg")
    parameters |= {"OUTPUT": places, "LEAST_ERROR": 0.5}
    found, done = registry.createAlgorithmById("bareearth:review").run(parameters, context, log)
    assert done and found["PLACE_COUNT"] == 10, log.text
    project = QgsProject.instance()
    terrain = project.addMapLayer(QgsRasterLayer(rasters["DTM"], "Terrain"))
    layer = project.addMapLayer(QgsVectorLayer(places, "Places"))
    layers.look_of("places").dress(layer)
    project.setCrs(terrain.crs())
    assert project.write(str(tmp_path / "review.qgz"))
    return tmp_path / "review.qgz"


def window_of(folder):
    """Return a QGIS with a window, where the plugin of this repository is enabled."""
    qgis = Qgis(folder)
    (qgis.profile / "QGIS").mkdir(parents=True)
    settings = "[PythonPlugins]\nbare_earth=true\nprocessing=true\n"
    (qgis.profile / "QGIS" / "QGIS3.ini").write_text(settings, encoding="utf-8")
    return qgis


STEPS = """
from pathlib import Path
from qgis.core import QgsProject, QgsRectangle
from qgis.PyQt.QtCore import Qt
from qgis.PyQt.QtTest import QTest
from qgis.PyQt.QtWidgets import QDockWidget
from qgis.utils import unloadPlugin
window, canvas, project = iface.mainWindow(), iface.mapCanvas(), QgsProject.instance()
window.resize(1280, 800)
project.read(given["project"])
wait(lambda: False, 1)
entries = {action.text(): action for action in iface.pluginMenu().actions()}
{action.text(): action for action in entries["Bare Earth"].menu().actions()}["Review"].trigger()
dock = plugins["bare_earth"]._dock
wait(lambda: dock.session is not None and dock.view.points, 60)
errors = answer["errors"] = []
sys.excepthook = lambda *error: errors.append("".join(traceback.format_exception(*error)))
answer["order"], answer["reason"] = [], dock.panel.reason.text()

def settle():
    wait(lambda: False, 0.3)
    wait(lambda: not canvas.isDrawing(), 20)

def picture(name):
    settle()
    window.grab().save(str(Path(given["project"]).with_name(f"{name}.png")))

def press(*keys):
    for key in keys:
        answer["order"].append(dock.session.place.rank)
        QTest.keyClick(window.windowHandle(), key)
        settle()
"""


@pytest.mark.rest
def test_ten_places_are_answered_with_ten_keys(reviewed, tmp_path):
    answer = window_of(tmp_path).window(
        STEPS
        + """
picture("open")
answer["points"] = len(dock.view.points.along)
answer["extent"] = canvas.extent().toRectF().getCoords()
press(Qt.Key_R, Qt.Key_N, Qt.Key_S)
canvas.setFocus()  # as after a click on the map
press(Qt.Key_R, Qt.Key_R, Qt.Key_R, Qt.Key_N, Qt.Key_R, Qt.Key_R)
picture("nine")
press(Qt.Key_R)
picture("ten")
answer["message"] = dock.panel.message.text()
answer["answers"] = sorted(
    [feature["RANK"], feature["answer"]] for feature in dock.session.layer.getFeatures()
)
answer["editable"] = dock.session.layer.isEditable()
dock.panel.again.click()
wait(lambda: "changed" in dock.panel.message.text(), 100)
wait(lambda: dock.view.points, 30)
picture("again")
answer["changed"] = dock.panel.message.text()
answer["places"] = [(place.rank, place.answer) for place in dock.session.places]
unloadPlugin("bare_earth")
settle()
docks = [one for one in window.findChildren(QDockWidget) if one.isVisible()]
answer["docks"] = [one.objectName() for one in docks]
QTest.keyClick(window.windowHandle(), Qt.Key_R)
settle()
""",
        {name: os.environ[name] for name in ("PYTHONPATH", "QGIS_PLUGINPATH")},
        project=reviewed,
    )
    assert not answer["errors"] and "BareEarthReview" not in answer["docks"]
    # Ten keys, in the order of the ranks, and each answer is in the file.
    assert answer["order"] == list(range(1, 11)) and not answer["editable"]
    given = {2: NOT_GROUND, 3: SKIP, 7: NOT_GROUND}
    expected = [[rank, given.get(rank, RIGHT)] for rank in range(1, 11)]
    assert answer["answers"] == expected
    assert answer["points"] > 50 and "relief" in answer["reason"]
    assert answer["message"] == "All places are answered or skipped."
    # The mound is no ground any more, and the answers are in the layer of the next round.
    assert "Place 2</a>: " in answer["changed"] and "Place 7</a>: no change" in answer["changed"]
    kept = sorted(one for _, one in answer["places"] if one)
    assert kept == sorted(one for _, one in expected if one != SKIP)


@pytest.mark.rest
def test_the_project_remembers_where_places_come_from(reviewed, tmp_path):
    found = sources_of(str(tmp_path / "places.gpkg"), QgsProject.instance())
    names = [Path(path).name for path in (found.cloud, found.dtm, found.error)]
    assert names == ["points.laz", "DTM.tif", "EXPECTED_ERROR.tif"]
    assert [run.algorithm for run in found.runs] == [ALGORITHM, "bareearth:review"]
    # Outputs that were left out stay so when the runs are repeated.
    assert found.runs[0].parameters["HILLSHADE"] is None
    # Of a file that no run has made, nothing is known.
    assert sources_of(str(tmp_path / "scene.laz"), QgsProject.instance()) == Sources()


def test_the_dock_fits_a_small_screen():
    window, canvas = QMainWindow(), QgsMapCanvas()
    dock = ReviewDock(SimpleNamespace(mainWindow=lambda: window, mapCanvas=lambda: canvas))
    window.addDockWidget(Qt.DockWidgetArea.BottomDockWidgetArea, dock)
    least = dock.minimumSizeHint()
    assert least.width() <= 688 and least.height() <= 240
    dock.stop()
    remove(window)
    remove(canvas)
