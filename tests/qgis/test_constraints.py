"""Breaklines, water and places without ground, in the algorithms that classify."""

import laspy
import numpy as np
import pytest
from osgeo import gdal
from qgis.core import (
    QgsApplication,
    QgsCoordinateReferenceSystem,
    QgsCoordinateTransform,
    QgsCoordinateTransformContext,
    QgsGeometry,
    QgsProcessingContext,
    QgsProcessingException,
    QgsProject,
    QgsVectorFileWriter,
    QgsVectorLayer,
)
from support import Log, layer_of, write_scene

from bare_earth import BareEarthError
from bare_earth.algorithms.classes.corrections import read_corrections
from bare_earth.algorithms.crs.system import Crs
from bare_earth.algorithms.survey.shapes import Place
from bare_earth.algorithms.tools.input_groups import GROUPS
from bare_earth.plugin.processing.cloud_crs import CloudCrs
from bare_earth.plugin.processing.request import Request
from bare_earth.plugin.processing.shapes import layer_shapes

EAST, NORTH = 500_000.0, 5_700_000.0
CLASSIFIERS = ["tindensification", "gridminimum", "slopefilter", "classifytiles"]


@pytest.fixture
def line():
    """A line 5 to 9 m above the slope."""
    start, end = f"{EAST + 5} {NORTH + 60.5} 110", f"{EAST + 70} {NORTH + 60.5} 110"
    return layer_of("LineStringZ", f"LINESTRINGZ({start}, {end})")


def run(name, scene, tmp_path, **given):
    """Classify the scene; return the classes, and what was said."""
    import processing

    log = Log()
    is_many = name == "classifytiles"
    output = tmp_path / "out" if is_many else tmp_path / "out.laz"
    parameters = {
        "INPUT": [str(scene.path)] if is_many else str(scene.path),
        "OUTPUT_FOLDER" if is_many else "OUTPUT": str(output),
        **given,
    }
    processing.run(f"bareearth:{name}", parameters, feedback=log)
    file = output / scene.path.name if is_many else output
    return np.asarray(laspy.read(file).classification), log.text


@pytest.mark.parametrize("name", CLASSIFIERS)
def test_the_terrain_model_respects_them_and_the_classes_stay(name, scene, tmp_path, line):
    path = str(tmp_path / "dtm.tif")
    plain, _ = run(name, scene, tmp_path, DTM=path)
    assert np.nanmax(heights(path)) < 106.0
    classes, said = run(name, scene, tmp_path, DTM=path, BREAKLINES=line)
    assert np.nanmax(heights(path)) > 109.0
    assert np.array_equal(classes, plain)
    assert "--breaklines breaklines.geojson" in said


def moved(wkt, crs):
    """Return a geometry of the scene in another CRS."""
    shape = QgsGeometry.fromWkt(wkt)
    systems = (QgsCoordinateReferenceSystem(value) for value in ("EPSG:25832", crs))
    shape.transform(QgsCoordinateTransform(*systems, QgsCoordinateTransformContext()))
    return shape.asWkt(12)


@pytest.mark.parametrize("crs", ["EPSG:25832", "EPSG:25833", "EPSG:4326"])
def test_layers_of_any_crs_have_their_effect_and_keep_their_heights(scene, tmp_path, crs):
    path = str(tmp_path / "dtm.tif")
    start, end = f"{EAST + 5} {NORTH + 60.5} 110", f"{EAST + 70} {NORTH + 60.5} 110"
    line = layer_of("LineStringZ", moved(f"LINESTRINGZ({start}, {end})", crs), crs)
    run("slopefilter", scene, tmp_path, DTM=path, BREAKLINES=line)
    assert 109.0 < np.nanmax(heights(path)) < 110.1


@pytest.mark.parametrize("crs", ["EPSG:25832", "EPSG:4326"])
@pytest.mark.parametrize("name", ["NO_GROUND", "WATER", "RIVERS", "BREAKLINES", "CORRECTIONS"])
def test_layers_outside_of_the_points_are_the_same_error(scene, tmp_path, name, crs):
    kind = "LineString" if name in ("RIVERS", "BREAKLINES") else "Polygon"
    x, y = EAST + 5000, NORTH
    corners = f"{x} {y}, {x + 9} {y}, {x + 9} {y + 9}, {x} {y}"
    text = f"LINESTRING({corners})" if kind == "LineString" else f"POLYGON(({corners}))"
    field = "&field=class:integer" if name == "CORRECTIONS" else ""
    layer = layer_of(kind, moved(text, crs), crs + field)
    if field:
        layer.dataProvider().changeAttributeValues({1: {0: 2}})
    with pytest.raises(QgsProcessingException, match=r"points lie in x 500000"):
        run("slopefilter", scene, tmp_path, DTM=str(tmp_path / "dtm.tif"), **{name: layer})
    assert not (tmp_path / "dtm.tif").exists()


@pytest.mark.parametrize(
    ("name", "kind", "label"),
    [
        ("NO_GROUND", "polygon", "No ground here"), ("WATER", "polygon", "Water"),
        ("CORRECTIONS", "polygon", "Corrections"), ("BOUNDARY", "polygon", "Boundary"),
        ("RIVERS", "line", "Rivers"), ("BREAKLINES", "line", "Breaklines"),
    ],
)  # fmt: skip
def test_a_layer_of_another_kind_is_a_sentence(
    registry, scene, tmp_path, context, log, name, kind, label
):
    corners = f"{EAST} {NORTH}, {EAST + 9} {NORTH}, {EAST + 9} {NORTH + 9}, {EAST} {NORTH}"
    text = f"LINESTRING({corners})" if kind == "polygon" else f"POLYGON(({corners}))"
    layer = layer_of(text.partition("(")[0].title(), text, "EPSG:25832&field=class:integer")
    layer.dataProvider().changeAttributeValues({1: {0: 2}})
    values = {"INPUT": str(scene.path), "OUTPUT": str(tmp_path / "out.laz"), name: layer}
    algorithm = registry.createAlgorithmById("bareearth:slopefilter")
    assert not algorithm.run({**values, "DTM": str(tmp_path / "dtm.tif")}, context, log)[1]
    assert f'layer "{label}" holds no {kind}' in log.text
    assert "Traceback" not in log.text
    assert not (tmp_path / "out.laz").exists()


def test_curves_holes_and_collections_are_used_and_an_empty_layer_changes_nothing(tmp_path, scene):
    arc = "CURVEPOLYGON(CIRCULARSTRING(0 0, 2 2, 4 0, 2 -2, 0 0), (1 0, 2 0, 2 1, 1 0))"
    mixed = layer_of("GeometryCollection", f"GEOMETRYCOLLECTION({arc}, POINT(1 1))")
    empty = QgsVectorLayer("Polygon?crs=EPSG:25832", "empty", "memory")
    algorithm = QgsApplication.processingRegistry().createAlgorithmById("bareearth:slopefilter")
    context = QgsProcessingContext()
    context.setProject(QgsProject.instance())
    field = GROUPS["constraints"][-1], CloudCrs(scene.path)
    ((rings, _),) = layer_shapes(Request(algorithm, {"NO_GROUND": mixed}, context), *field)
    assert len(rings) == 2 and len(rings[0]) > 50 and rings[1].shape == (4, 2)
    assert layer_shapes(Request(algorithm, {"NO_GROUND": empty}, context), *field) == ()


def test_without_a_raster_they_have_no_use(scene, tmp_path, line):
    with pytest.raises(QgsProcessingException, match="terrain model"):
        run("slopefilter", scene, tmp_path, BREAKLINES=line, DTM="", HILLSHADE="")
    assert not (tmp_path / "out.laz").exists()


def test_the_crs_is_that_of_the_files_that_the_run_reads(tmp_path):
    (tmp_path / "a").mkdir()
    write_scene(tmp_path / "a" / "elsewhere.laz", epsg=25833)
    write_scene(tmp_path / "b.laz")
    assert CloudCrs(tmp_path).value.authid() == "EPSG:25832"
    assert CloudCrs(tmp_path, recursive=True).value.authid() == "EPSG:25833"


def test_the_crs_is_that_of_the_first_file_that_states_one(tmp_path):
    (tmp_path / "a.laz").write_bytes(b"nothing")
    with pytest.raises(BareEarthError, match=r"a\.laz"):
        assert CloudCrs(tmp_path).value
    write_scene(tmp_path / "b.laz", epsg=None)
    assert not CloudCrs(tmp_path).value.isValid()
    write_scene(tmp_path / "c.laz")
    assert CloudCrs(tmp_path).value.authid() == "EPSG:25832"


def test_the_crs_is_read_once_and_only_if_it_is_needed(tmp_path):
    path = tmp_path / "scene.laz"
    crs = CloudCrs(path)
    write_scene(path)
    assert crs.value.isValid()
    path.unlink()
    assert crs.value.authid() == "EPSG:25832"


def heights(path):
    """Return the heights of a raster."""
    raster = gdal.Open(path)
    values = raster.ReadAsArray()
    return np.where(values == raster.GetRasterBand(1).GetNoDataValue(), np.nan, values)


@pytest.mark.parametrize("name", ["a.gpkg", "a.shp"])
def test_the_library_reads_files_by_gdal_and_transforms_them(tmp_path, name):
    square = (
        f"POLYGON(({EAST} {NORTH}, {EAST + 9} {NORTH}, {EAST + 9} {NORTH + 9}, {EAST} {NORTH}))"
    )
    layer = layer_of("Polygon", moved(square, "EPSG:25833"), "EPSG:25833&field=class:integer")
    layer.dataProvider().changeAttributeValues({1: {0: 6}})
    options = QgsVectorFileWriter.SaveVectorOptions()
    options.driverName = "GPKG" if name.endswith("gpkg") else "ESRI Shapefile"
    path = str(tmp_path / name)
    QgsVectorFileWriter.writeAsVectorFormatV3(layer, path, layer.transformContext(), options)
    found = read_corrections(path)
    place = Place("the points", Crs(epsg=25832), (EAST, NORTH, EAST + 80, NORTH + 80))
    ((ring,),) = found.located(place).polygons
    assert found.classes == (6,) and found.polygons.crs
    assert np.allclose(np.ptp(ring, axis=0), 9.0, atol=1e-3)
    assert np.allclose(ring.min(axis=0), (EAST, NORTH), atol=1e-3)
