"""Lines and polygons in any CRS and format, for every option that takes them."""

import json
import struct

import laspy
import numpy as np
import pytest
from realdata import real
from runs import FAST, Heard
from surveys import write_points

import bare_earth
from bare_earth import BareEarthError
from bare_earth.algorithms.cli import main
from bare_earth.algorithms.crs import provider

pyproj = pytest.importorskip("pyproj")
rasterio = pytest.importorskip("rasterio")
UTM = "EPSG:25832"
# West, south, east and north of the hut in the middle of the points.
HUT = (500_040.0, 5_600_040.0, 500_080.0, 5_600_080.0)
CORNERS = np.array([(HUT[0], HUT[1]), (HUT[2], HUT[1]), (HUT[2], HUT[3]), (HUT[0], HUT[3])])


def write(path, east=0.0, count=12_000, size=120.0):
    """Write level ground at 50 m, with a hut of 5 m that counts as ground."""
    random = np.random.default_rng(1)
    x, y = random.uniform(0, size, (2, count)) + np.reshape((east, 0.0), (2, 1))
    is_hut = (x > 41.0) & (x < 79.0) & (y > 41.0) & (y < 79.0)
    offset = (500_000.0, 5_600_000.0, 0.0)
    return write_points(path, x, y, np.where(is_hut, 55.0, 50.0), 2, offset=offset, crs=UTM)


@pytest.fixture
def cloud(tmp_path):
    return write(tmp_path / "in.laz")


def moved(corners, crs):
    """Return corners in another CRS, longitude first."""
    to = pyproj.Transformer.from_crs(UTM, crs, always_xy=True)
    return np.column_stack((*to.transform(*corners.T[:2]), corners[:, 2:]))


def geojson(path, corners, crs=None, kind="Polygon", **attributes):
    ring = corners.tolist()
    shape = {"type": kind, "coordinates": [[*ring, ring[0]]] if kind == "Polygon" else ring}
    feature = {"type": "Feature", "geometry": shape, "properties": attributes}
    content = {"type": "FeatureCollection", "features": [feature]}
    if crs is not None:
        content["crs"] = {"type": "name", "properties": {"name": crs}}
    path.write_text(json.dumps(content), encoding="utf-8")
    return path


def by_library(path, corners, crs, kind="Polygon", layer=None, append=False, **attributes):
    """Write a file with pyogrio, from WKB that is made here."""
    pyogrio = pytest.importorskip("pyogrio")
    ring = np.concatenate((corners, corners[:1])) if kind == "Polygon" else corners
    has_z = 1000 * (ring.shape[1] > 2)
    start = struct.pack("<BI", 1, (3 if kind == "Polygon" else 2) + has_z)
    start += struct.pack("<I", 1) if kind == "Polygon" else b""
    data = start + struct.pack("<I", len(ring)) + np.ascontiguousarray(ring, "<f8").tobytes()
    pyogrio.raw.write(
        str(path), np.array([data], object), [np.array([value]) for value in attributes.values()],
        list(attributes), geometry_type=f"{kind} Z" if has_z else kind, crs=crs, layer=layer,
        append=append,
    )  # fmt: skip
    return path


def highest(source, target, **options):
    """Return the highest cell of a terrain model."""
    bare_earth.terrain(source, dtm=target, **options)
    with rasterio.open(target) as raster:
        return float(raster.read(1, masked=True).max())


@pytest.mark.rest(but="a.geojson-EPSG:4326-None")
@pytest.mark.parametrize(
    ("name", "crs", "stated"),
    [
        ("a.geojson", "EPSG:4326", None),
        *(
            pytest.param("a.geojson", *crs, marks=pytest.mark.long)
            for crs in (
                ("EPSG:4326", "urn:ogc:def:crs:OGC:1.3:CRS84"),
                ("EPSG:25833", "urn:ogc:def:crs:EPSG::25833"),
                ("EPSG:3857", "EPSG:3857"),
                (UTM, None),
            )
        ),
        ("a.geojson", "EPSG:4326", "urn:ogc:def:crs:EPSG::4326"),
        ("a.geojson", UTM, "http://www.opengis.net/def/crs/EPSG/0/25832"),
        ("a.gpkg", "EPSG:25833", None),
        ("a.gpkg", "EPSG:4326", None),
        ("a.shp", "EPSG:25833", None),
        ("a.fgb", UTM, None),
    ],
)
def test_polygons_of_any_crs_and_format_have_their_effect(cloud, tmp_path, name, crs, stated):
    corners = moved(CORNERS, crs)
    if name.endswith(".geojson"):
        path = geojson(tmp_path / name, corners, stated)
    else:
        path = by_library(tmp_path / name, corners, crs)
    assert highest(cloud, tmp_path / "dtm.tif") > 54.9
    assert highest(cloud, tmp_path / "dtm.tif", no_ground=path) < 50.1


@pytest.mark.parametrize("is_near", [True, False])
def test_points_that_wait_on_disk_are_no_exception(cloud, tmp_path, is_near):
    progress = Heard()
    path = geojson(tmp_path / "a.geojson", moved(CORNERS if is_near else FAR, "EPSG:4326"))
    options = {"no_ground": path, "memory": 0.001, "progress": progress}
    if is_near:
        assert highest(cloud, tmp_path / "a.tif", **options) < 50.1
    else:
        with pytest.raises(BareEarthError, match="polygons without ground"):
            highest(cloud, tmp_path / "a.tif", **options)
    assert any("wait in a temporary file" in text for text in progress.infos)


def test_the_same_points_are_classified_in_a_boundary_of_any_crs(cloud, tmp_path):
    path = geojson(tmp_path / "a.geojson", moved(CORNERS, "EPSG:4326"))
    las = laspy.read(cloud)
    inside = (las.x > HUT[0]) & (las.x < HUT[2]) & (las.y > HUT[1]) & (las.y < HUT[3])
    summary = bare_earth.classify(cloud, tmp_path / "o.laz", boundary=path, **FAST)
    assert summary.area_count == np.count_nonzero(inside) > 1000


def test_corrections_of_another_crs_give_their_class(cloud, tmp_path):
    for path in (
        geojson(tmp_path / "a.geojson", moved(CORNERS, "EPSG:4326"), **{"class": 6}),
        by_library(tmp_path / "a.gpkg", moved(CORNERS, "EPSG:25833"), "EPSG:25833", **{"class": 6}),
    ):
        summary = bare_earth.classify(cloud, tmp_path / "o.laz", corrections=path, **FAST)
        assert summary.class_counts[6] > 1000


@pytest.mark.rest(but="a.gpkg")
@pytest.mark.parametrize("name", ["a.geojson", "a.gpkg", "a.shp"])
def test_breaklines_keep_their_heights(cloud, tmp_path, name):
    line = np.column_stack((CORNERS[:2] - (0.0, 20.5), [58.0, 58.0]))
    if name == "a.geojson":
        path = geojson(tmp_path / name, moved(line, "EPSG:4326"), kind="LineString")
    else:
        path = by_library(tmp_path / name, moved(line, "EPSG:25833"), "EPSG:25833", "LineString")
    assert highest(cloud, tmp_path / "a.tif", breaklines=path) == pytest.approx(58, abs=0.5)


FAR = np.add(CORNERS, (5000.0, 0.0))


@pytest.mark.rest
@pytest.mark.parametrize("option", ["boundary", "corrections", "no-ground", "water"])
@pytest.mark.parametrize("crs", ["EPSG:4326", UTM])
def test_polygons_outside_of_the_points_are_the_same_error(cloud, tmp_path, capsys, option, crs):
    path = geojson(tmp_path / "a.geojson", moved(FAR, crs), **{"class": 2})
    target = str(tmp_path / "o.laz")
    command = ["classify", str(cloud), target, "--dtm", str(tmp_path / "o.tif")]
    assert main([*command, f"--{option}", str(path)]) == 1
    text = capsys.readouterr().err
    assert "in.laz lies in the " in text and "points lie in x 500000" in text
    assert "x 505040 to 505080" in text and "in the CRS of the points" in text
    assert not list(tmp_path.glob("o.*"))


@pytest.mark.parametrize("option", ["breaklines", "rivers"])
def test_lines_outside_of_the_points_are_the_same_error(cloud, tmp_path, capsys, option):
    path = geojson(tmp_path / "a.geojson", moved(FAR, "EPSG:4326"), kind="LineString")
    assert main(["terrain", str(cloud), "--dtm", str(tmp_path / "o.tif"), f"--{option}", str(path)])
    text = capsys.readouterr().err
    assert f"within 10 m of the {option}" in text and "points lie in x 500000" in text
    assert not list(tmp_path.glob("o.*"))


@pytest.mark.rest
def test_geometry_may_lie_in_one_of_many_files(tmp_path, capsys):
    for number in range(2):
        write(tmp_path / f"{number}.laz", 500.0 * number)
    near, far = (
        geojson(tmp_path / f"{name}.geojson", moved(corners, "EPSG:4326"))
        for name, corners in (("near", CORNERS), ("far", FAR))
    )
    sources = [str(tmp_path / f"{number}.laz") for number in range(2)]
    command = ["terrain", *sources, "--dtm", str(tmp_path / "o.tif"), "--no-ground"]
    assert main([*command, str(near)]) == 0
    with rasterio.open(tmp_path / "o.tif") as raster:
        assert raster.read(1, masked=True).max() < 50.1
    assert main([*command, str(far)]) == 1
    assert "polygons without ground" in capsys.readouterr().err


@pytest.mark.rest
def test_a_river_that_meets_no_water_is_told(cloud, tmp_path):
    water = geojson(tmp_path / "water.geojson", moved(CORNERS, "EPSG:4326"))
    through, beside = (
        geojson(
            tmp_path / f"{north:g}.geojson", moved(np.add(CORNERS[:2], (0.0, north)), "EPSG:4326"),
            kind="LineString",
        )
        for north in (20.0, -20.0)
    )  # fmt: skip
    for rivers, polygons, is_told in (
        (through, water, False), (beside, water, True), (through, None, True),
    ):  # fmt: skip
        progress = Heard()
        highest(cloud, tmp_path / "a.tif", progress=progress, rivers=rivers, water=polygons)
        told = any("Rivers" in text and "water" in text for text in progress.warnings)
        assert told is is_told


def test_without_a_library_one_sentence_tells_what_to_install(cloud, tmp_path, monkeypatch):
    path = geojson(tmp_path / "a.geojson", moved(CORNERS, "EPSG:4326"))
    monkeypatch.setattr("bare_earth.algorithms.survey.shapes.library", lambda: None)
    with pytest.raises(BareEarthError, match="pip install pyproj"):
        highest(cloud, tmp_path / "a.tif", no_ground=path)
    same = geojson(tmp_path / "b.geojson", CORNERS, "EPSG:25832")
    assert highest(cloud, tmp_path / "a.tif", no_ground=same) < 50.1
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    (tmp_path / "a.gpkg").write_bytes(b"")
    with pytest.raises(BareEarthError, match="pip install pyogrio"):
        highest(cloud, tmp_path / "a.tif", no_ground=tmp_path / "a.gpkg")


def test_a_crs_that_is_not_known_is_one_sentence(cloud, tmp_path):
    path = geojson(tmp_path / "a.geojson", CORNERS, "EPSG:999999")
    with pytest.raises(BareEarthError, match=r"a\.geojson .* not known"):
        highest(cloud, tmp_path / "a.tif", no_ground=path)


@pytest.mark.rest
def test_a_layer_of_several_must_be_named(cloud, tmp_path):
    path = by_library(tmp_path / "a.gpkg", CORNERS, UTM, layer="huts")
    by_library(path, FAR, UTM, layer="ponds", append=True)
    by_library(path, CORNERS[:2], UTM, "LineString", layer="lines", append=True)
    target = tmp_path / "a.tif"
    highest(cloud, target, breaklines=path)  # of lines there is one layer
    with pytest.raises(BareEarthError, match=r"huts, ponds.*\|layername=huts"):
        highest(cloud, target, no_ground=path)
    assert highest(cloud, target, no_ground=f"{path}|layername=huts") < 50.1
    with pytest.raises(BareEarthError, match="has no layer roads"):
        highest(cloud, target, no_ground=f"{path}|layername=roads")


def test_longitude_and_latitude_come_in_this_order():
    found = provider.transformed("EPSG:4326", UTM, np.array([[9.0, 50.0]]))
    assert found[0] == pytest.approx((500_000, 5_538_630.7), abs=0.1)
    assert provider.transformed(UTM, "EPSG:4326", found)[0] == pytest.approx((9.0, 50.0))
    compound = pyproj.CRS("EPSG:25832+7837").to_wkt()
    assert provider.transformed("EPSG:4326", compound, np.array([[9.0, 50.0]])) == pytest.approx(
        found
    )


@pytest.mark.rest(but="square-lonlat.geojson")
@pytest.mark.parametrize("name", ["square-lonlat.geojson", "square-25833.geojson"])
def test_squares_from_the_field(tmp_path, name):
    source, dtm = real("field/ground-25832.laz"), tmp_path / "o.tif"
    all_of_them = bare_earth.terrain(source, dtm=dtm).ground_count
    without = bare_earth.terrain(source, dtm=dtm, no_ground=real(f"field/{name}")).ground_count
    assert without < all_of_them - 1000


def test_the_area_of_classes_above_the_ground_is_transformed_for_one_file(cloud, tmp_path):
    las = laspy.read(cloud)
    x, is_high = np.asarray(las.x), np.asarray(las.z) > 52.0
    las.classification[is_high] = 1
    las.write(str(cloud))
    west = np.minimum(CORNERS, (500_060.0, np.inf))
    area = geojson(tmp_path / "area.geojson", moved(west, "EPSG:4326"))
    bare_earth.above_ground(cloud, tmp_path / "out.laz", boundary=area)
    changed = np.asarray(laspy.read(tmp_path / "out.laz").classification) == 6
    assert changed[is_high & (x < 500_058.0)].mean() > 0.9
    assert not changed[x > 500_060.1].any()
    with pytest.raises(BareEarthError, match="lies in the area"):
        bare_earth.above_ground(cloud, tmp_path / "far.laz", boundary=[CORNERS + 50_000.0])
    assert not (tmp_path / "far.laz").exists()
