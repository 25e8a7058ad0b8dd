"""Heights above a given raster: of one file and many, in every unit, and where it has no value."""

import dataclasses
import json
import re

import laspy
import numpy as np
import pyproj
import pytest
import rasterio
from realdata import real
from runs import Heard, said
from surveys import ORIGIN, write_points

from bare_earth import BareEarthError, Progress, heights
from bare_earth.algorithms.core.points import Frame
from bare_earth.algorithms.crs.provider import wkt_of_epsg, wkt_of_text
from bare_earth.algorithms.crs.system import crs_of_wkt
from bare_earth.algorithms.crs.unit_names import unit_in
from bare_earth.algorithms.crs.wkt import read_wkt
from bare_earth.algorithms.rasters import sampling
from bare_earth.algorithms.rasters.geotiff import NODATA, RasterGrid, read_raster
from bare_earth.algorithms.rasters.sampling import HeightRaster, HeightSampler
from bare_earth.algorithms.rasters.writing import write_geotiff

EAST, NORTH, SIDE = *ORIGIN[:2], 60
SURVEY, UTM = 1200 / 3937, wkt_of_epsg(25832)


def terrain(x, y):
    return 80.0 + 0.1 * (x - EAST) - 0.05 * (y - NORTH)


def dtm(path, cell=1.0, side=SIDE, epsg=25832, hole=False, unit=1.0):
    """Write a plane, whose heights between the centres of cells bilinear interpolation knows."""
    wkt = wkt_of_epsg(epsg) if epsg else None
    count = round(side / cell)
    grid = RasterGrid(EAST, NORTH + side, cell, count, count, Frame((0.0, 0.0), 1.0, unit, wkt))
    values = terrain(grid.x[None, :], grid.y[:, None]).astype(np.float32)
    if hole:
        values[-10:, :10] = NODATA
    write_geotiff(path, values, grid, NODATA, Progress(), "heights")
    return path


def points(path, count=4000, west=0.0, east=SIDE, epsg=25832, seed=1):
    """Write points of class 0 up to 30 m above the plane."""
    random = np.random.default_rng(seed)
    # Not in the outermost half cell, where the plane ends.
    x = random.uniform(max(west, 2.0), min(east, SIDE - 2.0), count)
    y = random.uniform(2.0, SIDE - 2.0, count)
    z = terrain(x + EAST, y + NORTH) + random.uniform(0.0, 30.0, count)
    return write_points(path, x, y, z, 0, crs=f"EPSG:{epsg}")


def found(path):
    return np.asarray(laspy.read(path)["HeightAboveGround"])


def true_heights(path):
    las = laspy.read(path)
    return np.asarray(las.z) - terrain(np.asarray(las.x), np.asarray(las.y))


@pytest.mark.parametrize("cell", [0.5, 1.0, 4.0])
def test_heights_above_a_raster_need_no_classes(tmp_path, cell):
    source, target = points(tmp_path / "in.las"), tmp_path / "out.laz"
    summary = heights(source, target, dtm=dtm(tmp_path / "dtm.tif", cell))
    expected = true_heights(source)
    np.testing.assert_allclose(found(target), expected, atol=0.001)
    assert summary.maximum == pytest.approx(expected.max(), abs=0.001)
    assert summary.ground_count == 0


def test_heights_above_a_raster_as_z(tmp_path):
    source, target = points(tmp_path / "in.las"), tmp_path / "out.las"
    heights(source, target, output_as="z", dtm=dtm(tmp_path / "dtm.tif"))
    np.testing.assert_allclose(np.asarray(laspy.read(target).z), true_heights(source), atol=0.0015)


@pytest.mark.rest
def test_memory_and_squares_change_nothing(tmp_path, monkeypatch):
    source = points(tmp_path / "in.las", count=9000)
    raster, progress = dtm(tmp_path / "dtm.tif", hole=True), Heard()
    heights(source, tmp_path / "one.las", dtm=raster)
    monkeypatch.setattr(sampling, "_SIDE", 7)
    monkeypatch.setattr(sampling, "_MOST_KEPT", 2)
    heights(source, tmp_path / "squares.las", dtm=raster)
    heights(source, tmp_path / "disk.las", dtm=raster, memory=0.001, progress=progress)
    assert any("wait in a temporary file" in text for text in progress.infos)
    for name in ("squares", "disk"):
        assert (tmp_path / f"{name}.las").read_bytes() == (tmp_path / "one.las").read_bytes()


def test_many_files_give_the_heights_of_one_and_go_on(tmp_path):
    (tmp_path / "in").mkdir()
    raster = dtm(tmp_path / "dtm.tif")
    for name, west, seed in (("a", 0.0, 1), ("b", 30.0, 2)):
        points(tmp_path / "in" / f"{name}.las", 1000, west, west + 30.0, seed=seed)
    words = "height", tmp_path / "in", tmp_path / "out", "--dtm", raster
    code, _, told = said(*words)
    assert code == 0, told
    for name in ("a", "b"):
        source = tmp_path / "in" / f"{name}.las"
        np.testing.assert_allclose(
            found(tmp_path / "out" / f"{name}.las"), true_heights(source), atol=0.001
        )
    again = json.loads(said(*words, "--resume", "--json")[1])
    assert again["kept_count"] == again["done_count"] == 2
    # Another raster in the same file.
    raster.unlink()
    dtm(raster, cell=2.0)
    assert json.loads(said(*words, "--resume", "--json")[1])["kept_count"] == 0


def test_places_without_a_value_have_no_height_and_it_is_told(tmp_path):
    source, target = points(tmp_path / "in.las"), tmp_path / "out.las"
    raster, progress = dtm(tmp_path / "dtm.tif", hole=True), Heard()
    heights(source, target, dtm=raster, progress=progress)
    las = laspy.read(source)
    empty = (np.asarray(las.x) < EAST + 10) & (np.asarray(las.y) < NORTH + 10)
    values = found(target)
    assert empty.any() and np.array_equal(np.isnan(values), empty)
    # Beside the hole, the other neighbours count: half a cell of the slope at most.
    np.testing.assert_allclose(values[~empty], true_heights(source)[~empty], atol=0.08)
    text = f"{np.count_nonzero(empty):,} of 4,000 points"
    assert any(text in told for told in progress.infos + progress.warnings)
    with pytest.raises(BareEarthError, match="as an extra dimension"):
        heights(source, tmp_path / "z.las", output_as="z", dtm=raster)
    with pytest.raises(BareEarthError, match=r"no value .*in\.las"):
        heights(source, tmp_path / "none.las", dtm=dtm(tmp_path / "small.tif", side=1))
    assert not (tmp_path / "z.las").exists() and not (tmp_path / "none.las").exists()


@pytest.mark.parametrize("many", [False, True])
def test_a_raster_in_another_crs_is_refused(tmp_path, many):
    (tmp_path / "in").mkdir()
    source = points(tmp_path / "in" / "a.las")
    raster = dtm(tmp_path / "dtm.tif", epsg=25833)
    target = tmp_path / ("out" if many else "out.las")
    code, _, told = said("height", source.parent if many else source, target, "--dtm", raster)
    assert code and "33N) than " in told and "Reproject the raster" in told
    assert not list(tmp_path.glob("out*/*.las")) and not (tmp_path / "out.las").exists()


def test_a_raster_without_crs_is_taken_as_that_of_the_points(tmp_path):
    source, raster = points(tmp_path / "in.las"), dtm(tmp_path / "dtm.tif", epsg=None)
    heights(source, tmp_path / "out.las", dtm=raster)
    np.testing.assert_allclose(found(tmp_path / "out.las"), true_heights(source), atol=0.001)


def test_heights_of_a_raster_in_its_stated_unit(tmp_path):
    source, metres = points(tmp_path / "in.las"), dtm(tmp_path / "metres.tif")
    raster, feet = read_raster(metres), tmp_path / "feet.tif"
    grid = raster._replace(unit="ft", states_unit=True)
    cells = raster.heights / np.float32(0.3048)
    write_geotiff(feet, cells, grid, NODATA, Progress(), "Height, {unit}")
    heights(source, tmp_path / "out.las", dtm=feet)
    np.testing.assert_allclose(found(tmp_path / "out.las"), true_heights(source), atol=0.001)


@pytest.mark.parametrize(
    ("shows", "unit", "expected", "warnings"),
    [
        ("heights", 1.0, 1.0, ["does not state the unit"]),
        ("heights", SURVEY, 1.0, ["does not state the unit", "m below"]),
        ("Height, {unit}", 1.0, 1.0, []),
        ("Height, {unit}", SURVEY, SURVEY, []),
        ("Elevation (ft)", 0.3048, 0.3048, []),
    ],
)
def test_a_raster_beside_points_whose_heights_are_feet(tmp_path, shows, unit, expected, warnings):
    source, target = points(tmp_path / "in.las", epsg=25832), tmp_path / "out.las"
    las = laspy.read(source)
    las.header.add_crs(pyproj.CRS("EPSG:25832+8228"))
    heights_in_feet, foot = np.asarray(las.z) / 0.3048, 0.3048
    las.z = heights_in_feet
    las.write(str(source))
    grid = RasterGrid(EAST, NORTH + SIDE, 1.0, SIDE, SIDE, Frame((0, 0), 1.0, unit, UTM))
    values = (terrain(grid.x[None, :], grid.y[:, None]) / unit).astype(np.float32)
    write_geotiff(tmp_path / "dtm.tif", values, grid, NODATA, Progress(), shows)
    progress = Heard()
    heights(source, target, dtm=tmp_path / "dtm.tif", progress=progress)
    assert len(progress.warnings) == len(warnings)
    for told, words in zip(progress.warnings, warnings):
        assert words in told and "gdal_edit.py -units" in told
    if unit == expected:
        truth = heights_in_feet - terrain(np.asarray(las.x), np.asarray(las.y)) / foot
        np.testing.assert_allclose(found(target), truth, atol=0.01)


def test_points_far_above_a_raster_or_above_another_datum_are_told(tmp_path):
    source, progress = points(tmp_path / "in.las"), Heard()
    far = dtm(tmp_path / "far.tif")
    with rasterio.open(far, "r+", IGNORE_COG_LAYOUT_BREAK="YES") as raster:
        raster.write(raster.read() - 47.0)
    heights(source, tmp_path / "out.las", dtm=far, progress=progress)
    (warning,) = progress.warnings
    assert "at least 48." in warning and "vertical datums" in warning
    here, there = (crs_of_wkt(wkt_of_text(f"EPSG:25832+{code}")) for code in (7837, 5621))
    raster = dataclasses.replace(HeightRaster.of(far), crs=there)
    raster.report(here, progress)
    feet = crs_of_wkt(wkt_of_text("EPSG:25832+8228"))
    dataclasses.replace(raster, crs=feet, states_unit=True).report(feet, progress)
    assert re.search("metre by its band, .* foot by its CRS", progress.warnings[2])
    assert "EVRF2007 height" in progress.warnings[1] and "DHHN2016 height" in progress.warnings[1]


def test_a_terrain_model_in_metres_is_checked_beside_points_in_feet(tmp_path):
    source, raster = real("field2/points-ftus.laz"), real("field2/dem-metres-no-unit.tif")
    las = laspy.read(source)
    ground = np.column_stack((las.x, las.y, las.z))[np.asarray(las.classification) == 2][::900]
    rows = [",".join(map(str, ["point", *row])) for row in ground.tolist()]
    (tmp_path / "points.csv").write_text("\n".join(["name,x,y,z", *rows]))
    words = "check", source, "--checkpoints", tmp_path / "points.csv", "--dtm", raster, "--json"
    code, result, told = said(*words)
    assert code == 0 and json.loads(result)["dtm_nva"]["rmse"] < 0.01
    assert told.count("does not state the unit of its heights: metre is used") == 1
    assert "Nearly all points" not in told


def test_points_in_feet_above_a_raster_in_feet(tmp_path):
    # EPSG:2260 is in US survey feet; neither states the unit of heights.
    source, target = points(tmp_path / "in.las", epsg=2260), tmp_path / "out.las"
    summary = heights(source, target, dtm=dtm(tmp_path / "dtm.tif", epsg=2260))
    np.testing.assert_allclose(found(target), true_heights(source), atol=0.001)
    assert summary.unit == "US survey foot"


def test_a_missing_raster_is_told(tmp_path):
    source = points(tmp_path / "in.las", 10)
    code, _, told = said("height", source, tmp_path / "out.las", "--dtm", tmp_path / "no.tif")
    assert code and "no.tif: it does not exist" in told


def test_values_at_the_border_and_outside(tmp_path):
    sampler = HeightSampler(HeightRaster.of(dtm(tmp_path / "dtm.tif")))
    x = EAST + np.array([-0.01, 0.0, 0.5, 30.25, SIDE, SIDE + 0.01])
    values = sampler.heights(x, np.full(6, NORTH + 30.0))
    first, last = (terrain(EAST + x, NORTH + 30.0) for x in (0.5, SIDE - 0.5))
    assert np.isnan(values[[0, 5]]).all()
    expected = [first, first, terrain(EAST + 30.25, NORTH + 30.0), last]
    np.testing.assert_allclose(values[1:5], expected, atol=1e-4)
    assert not len(sampler.heights(np.zeros(0), np.zeros(0)))


@pytest.mark.rest
@pytest.mark.parametrize("kind", ["WKT1_GDAL", "WKT1_ESRI", "WKT2_2019"])
@pytest.mark.parametrize("code", ["EPSG:2264+6360", "EPSG:25832+8228", "EPSG:25832"])
def test_written_heights_keep_their_unit(tmp_path, code, kind):
    # GDAL reads a vertical CRS without codes, such as ESRI's, from a GeoTIFF as metres.
    wkt = pyproj.CRS(code).to_wkt(kind)
    unit = crs_of_wkt(wkt).vertical_unit if "+" in code else 0.3048
    frame = Frame((0.0, 0.0), crs_of_wkt(wkt).horizontal_unit, unit, wkt)
    grid, cells = RasterGrid(EAST, NORTH, 1.0, 4, 4, frame), np.zeros((4, 4), np.float32)
    write_geotiff(tmp_path / "dtm.tif", cells, grid, NODATA, Progress(), "Height, {unit}")
    with rasterio.open(tmp_path / "dtm.tif") as raster:
        assert unit_in(raster.units[0]) == pytest.approx(unit, rel=1e-8)
        stated = read_wkt(raster.crs.to_wkt()).vertical_unit
        assert stated == (pytest.approx(unit, rel=1e-8) if "+" in code else None)


@pytest.mark.parametrize(
    ("text", "unit"),
    [
        ("Height, m", 1.0), ("Height, US survey ft", SURVEY), ("Height, units of 0.25 m", 0.25),
        ("elevation (ft)", 0.3048), ("Elevation_ft", 0.3048), ("Foot_US", SURVEY),
        ("Höhe [m ü. NHN]", 1.0), ("Height in feet", 0.3048), ("us-ft", SURVEY), ("metre", 1.0),
        ("U.S. survey feet", SURVEY), ("z in cm", 0.01), ("DTM of 1 m", None), ("dtm_1m", None),
        ("Slope, degrees", None), ("Density, points/m2", None), ("heights", None), ("", None),
        ("m 2020", None), ("Points in the cell", None),
    ],
)  # fmt: skip
def test_units_in_descriptions(text, unit):
    assert unit_in(text) == (unit and pytest.approx(unit, rel=1e-12))
