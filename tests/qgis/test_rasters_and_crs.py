"""Fields for the CRS of the points, and for the grid and the extent of rasters."""

import os
from pathlib import Path

import numpy as np
import pytest
from qgis.core import (
    QgsCoordinateReferenceSystem,
    QgsCoordinateTransform,
    QgsProcessingException,
    QgsProcessingOutputLayerDefinition,
    QgsProject,
    QgsRasterLayer,
    QgsRectangle,
)
from support import ALGORITHM, write_scene

from bare_earth import Cancelled, Progress
from bare_earth.algorithms.cli import main
from bare_earth.algorithms.core.points import Frame
from bare_earth.algorithms.rasters import writing
from bare_earth.algorithms.rasters.geotiff import RasterGrid
from bare_earth.algorithms.rasters.sparse import RasterPart
from bare_earth.algorithms.rasters.writing import RasterCells

UTM = QgsCoordinateReferenceSystem("EPSG:25832")
FEET = "EPSG:2230"
BOX = QgsRectangle(500_010.5, 5_700_020.0, 500_050.0, 5_700_060.0)


@pytest.fixture
def run(registry, context, log):
    """What runs an algorithm as the dialog does, and raises its errors."""

    def run(name, **parameters):
        algorithm = registry.createAlgorithmById(name)
        possible, text = algorithm.checkParameterValues(parameters, context)
        if not possible:
            raise QgsProcessingException(text)
        results, done = algorithm.run(parameters, context, log, {}, False)
        if not done:
            raise QgsProcessingException(log.text)
        return results

    return run


@pytest.fixture
def feet(tmp_path):
    """Return a file that states no CRS; its 80 feet are few metres."""
    write_scene(tmp_path / "feet.las", None, (6_653_000.0, 1_923_000.0))
    return tmp_path / "feet.las"


def test_without_a_crs_a_project_in_degrees_counts_in_metres(context, tmp_path):
    import processing

    project = QgsProject.instance()
    write_scene(tmp_path / "bare.las", None, (0.0, 0.0))
    write_scene(tmp_path / "utm.las")
    for before, file, after in (
        ("EPSG:4326", "bare.las", "Local coordinates in metres"),
        ("EPSG:25832", "bare.las", UTM.description()),
        ("EPSG:4326", "utm.las", QgsCoordinateReferenceSystem("EPSG:4326").description()),
    ):
        project.setCrs(QgsCoordinateReferenceSystem(before))
        given = {"INPUT": str(tmp_path / file), "DTM": str(tmp_path / f"{file}.tif")}
        processing.runAndLoadResults("bareearth:terrainmodel", {**given, "GROUND_CLASSES": "1"})
        assert project.crs().description() == after
        # QGIS shows an error for each CRS that it cannot transform to longitude and latitude.
        degrees = QgsCoordinateReferenceSystem("EPSG:4326")
        way = QgsCoordinateTransform(project.crs(), degrees, project)
        assert way.isValid() and way.transform(500_000.0, 5_700_000.0) is not None
        # Of degrees QGIS would make scales of 1:500,000,000.
        assert project.crs().isGeographic() == (file == "utm.las")
        project.clear()


def raster(path):
    layer = QgsRasterLayer(str(path))
    assert layer.isValid()
    return layer


def grid_of(layer):
    extent = layer.extent()
    return layer.width(), layer.height(), extent.xMinimum(), extent.yMaximum(), layer.crs().authid()


def test_rasters_get_the_crs_that_is_chosen(run, feet, tmp_path, log):
    made = run(
        "bareearth:terrainmodel", INPUT=str(feet), CRS=QgsCoordinateReferenceSystem(FEET),
        DSM=str(tmp_path / "dsm.tif"), DTM_CELL_SIZE=3.0, DTM_CELL_UNIT="crs", GROUND_CLASSES="1",
    )  # fmt: skip
    layer = raster(made["DSM"])
    assert layer.crs().authid() == FEET
    assert layer.rasterUnitsPerPixelX() == 3.0
    assert layer.extent().xMinimum() % 3.0 == 0.0
    assert "--crs EPSG:2230" in log.text and "--dtm-cell-unit crs" in log.text
    assert "taken as metres" not in log.text


@pytest.mark.parametrize(
    ("given", "is_code"),
    [(FEET, True), (QgsCoordinateReferenceSystem(FEET).toWkt(), True),
     ("PROJ:+proj=utm +zone=11 +ellps=GRS80 +units=us-ft", False)],
)  # fmt: skip
def test_any_form_of_a_crs_is_taken(run, feet, tmp_path, log, given, is_code):
    files = {
        "INPUT": str(feet),
        "OUTPUT": str(tmp_path / "out.las"),
        "DTM": str(tmp_path / "d.tif"),
    }
    made = run(ALGORITHM, **files, CRS=given)
    assert (raster(made["DTM"]).crs().authid() == FEET) == is_code
    # Cells of a metre are 3.28 feet.
    assert raster(made["DTM"]).rasterUnitsPerPixelX() == pytest.approx(3937 / 1200)


def test_what_is_no_crs_is_refused(run, feet, tmp_path):
    with pytest.raises(QgsProcessingException, match="CRS"):
        run(ALGORITHM, INPUT=str(feet), OUTPUT=str(tmp_path / "out.las"), CRS="EPSG:999999")


@pytest.mark.parametrize(
    ("name", "outputs"),
    [
        ("heightaboveground", {"OUTPUT": "h.las", "GROUND_CLASSES": "1"}),
        ("classifyaboveground", {"OUTPUT": "a.las", "GROUND_CLASSES": "1"}),
        ("waterclasses", {"OUTPUT": "w.las", "GROUND_CLASSES": "1"}),
        ("modelkeypoints", {"OUTPUT": "k.las", "GROUND_CLASSES": "1"}),
        ("pointcloudtoterrain", {"DTM": "t.tif"}),
        ("comparesettings", {"OUTPUT": "c.html", "SETTINGS": ["slope:automatic"],
                             "EXTENT": "6653005,6653070,1923005,1923070"}),
    ],
)  # fmt: skip
def test_each_algorithm_takes_a_crs(run, feet, tmp_path, log, name, outputs):
    paths = {
        key: str(tmp_path / value) if "." in str(value) and key in ("OUTPUT", "DTM") else value
        for key, value in outputs.items()
    }
    run(f"bareearth:{name}", INPUT=str(feet), CRS=FEET, **paths)
    assert "--crs EPSG:2230" in log.text
    assert "taken as metres" not in log.text


def test_rasters_get_the_grid_of_a_layer(run, scene, tmp_path, log):
    first = run(
        "bareearth:terrainmodel", INPUT=str(scene.path), GROUND_CLASSES="1", DTM_CELL_SIZE=2.5,
        DSM=str(tmp_path / "first.tif"), RASTER_EXTENT=BOX,
    )["DSM"]  # fmt: skip
    assert grid_of(raster(first))[:4] == (16, 16, 500_010.0, 5_700_060.0)
    layer = raster(first)
    QgsProject.instance().addMapLayer(layer)
    made = run(
        ALGORITHM, INPUT=str(scene.path), OUTPUT=str(tmp_path / "out.las"),
        DTM=str(tmp_path / "dtm.tif"), LIKE=layer,
    )  # fmt: skip
    assert grid_of(raster(made["DTM"])) == grid_of(layer)
    assert f"--like {first}" in log.text
    QgsProject.instance().removeMapLayer(layer)


def test_an_extent_in_another_crs_is_transformed(run, scene, tmp_path, log):
    degrees = QgsCoordinateReferenceSystem("EPSG:4326")
    box = QgsCoordinateTransform(UTM, degrees, QgsProject.instance()).transformBoundingBox(BOX)
    corners = box.xMinimum(), box.xMaximum(), box.yMinimum(), box.yMaximum()
    made = run(
        "bareearth:pointcloudtoterrain", INPUT=str(scene.path), DTM=str(tmp_path / "dtm.tif"),
        RELIEF=str(tmp_path / "relief.tif"), RASTER_NODATA=-32768,
        RASTER_EXTENT=",".join(map(repr, corners)) + " [EPSG:4326]",
    )  # fmt: skip
    layer = raster(made["DTM"])
    assert layer.extent().contains(BOX)
    assert layer.extent().width() < 50.0
    assert grid_of(raster(made["RELIEF"])) == grid_of(layer)
    for name in ("DTM", "RELIEF"):
        assert raster(made[name]).dataProvider().sourceNoDataValue(1) == -32768.0


def test_the_command_of_the_log_makes_the_same_raster(run, scene, tmp_path, log):
    made = run(
        "bareearth:terrainmodel", INPUT=str(scene.path), GROUND_CLASSES="1", CRS="EPSG:25832",
        DSM=str(tmp_path / "dsm.tif"), RASTER_EXTENT=BOX, RASTER_NODATA=None,
    )["DSM"]  # fmt: skip
    (command,) = [text for text in log.said if "bare-earth terrain" in text]
    words = command[command.index("bare-earth terrain") :].split()[1:]
    again = str(tmp_path / "again.tif")
    assert main([again if word == made else word for word in words]) == 0
    assert grid_of(raster(again)) == grid_of(raster(made))


def test_a_raster_in_another_crs_is_refused(run, scene, feet, tmp_path):
    like = run(
        "bareearth:terrainmodel", INPUT=str(feet), GROUND_CLASSES="1", CRS=FEET,
        DSM=str(tmp_path / "feet.tif"),
    )["DSM"]  # fmt: skip
    with pytest.raises(QgsProcessingException, match="in another CRS"):
        run(
            ALGORITHM, INPUT=str(scene.path), OUTPUT=str(tmp_path / "out.las"),
            DTM=str(tmp_path / "dtm.tif"), LIKE=like,
        )  # fmt: skip
    assert not (tmp_path / "out.las").exists()


def test_layers_get_the_crs_that_is_chosen(feet, tmp_path, context):
    import processing

    project = QgsProject.instance()
    # QGIS 3.22 may load no point cloud; then it shows a raster of the classes.
    files = {"OUTPUT": tmp_path / "out.copc.laz", "DTM": tmp_path / "dtm.tif"}
    outputs = {
        name: QgsProcessingOutputLayerDefinition(str(path), project) for name, path in files.items()
    }
    processing.runAndLoadResults(ALGORITHM, {"INPUT": str(feet), "CRS": FEET, **outputs})
    layers = list(project.mapLayers().values())
    assert len(layers) == 2
    assert {layer.crs().authid() for layer in layers} == {FEET}


def test_a_cancel_closes_the_cells_that_wait_on_disk_before_it_removes_them(tmp_path, monkeypatch):
    remove, removed = os.unlink, []

    def unlink(path, **named):
        # Windows removes no file that is open.
        assert str(path) not in [os.path.realpath(file) for file in Path("/proc/self/fd").iterdir()]
        removed.append(Path(path).name)
        remove(path, **named)

    def parts():
        yield RasterPart(0, 0, np.zeros((4, 9), np.uint8))
        raise Cancelled

    monkeypatch.setattr(writing, "_MOST_IN_MEMORY", 10)
    monkeypatch.setattr(os, "unlink", unlink)
    grid, rows = RasterGrid(0.0, 9.0, 1.0, 9, 9, Frame()), RasterCells((9, 9), "uint8", parts())
    with pytest.raises(Cancelled):
        writing.write_geotiff(tmp_path / "a.tif", rows, grid, 255, Progress(), "classes")
    assert [file for file in removed if file.endswith(".cells.tif")] and not os.listdir(tmp_path)
