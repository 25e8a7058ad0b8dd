"""The CRS that a user states for files that state none, or a wrong one."""

import json
import struct

import laspy
import numpy as np
import pytest
from matrices import quick
from realdata import real
from runs import FAST_WORDS, Heard, said
from surveys import cut, strip, write

import bare_earth
from bare_earth import BareEarthError
from bare_earth.algorithms.crs import stated as stated_module
from bare_earth.algorithms.crs.measurable import length_scale, require_measurable
from bare_earth.algorithms.crs.stated import stated_wkt
from bare_earth.algorithms.crs.system import Crs, crs_of_wkt

pyproj = pytest.importorskip("pyproj")
rasterio = pytest.importorskip("rasterio")

SURVEY = 1200 / 3937
DEGREES = struct.pack("<12H", 1, 1, 0, 2, 1024, 0, 1, 2, 2048, 0, 1, 4269)


def crs_of(text):
    return crs_of_wkt(stated_wkt(text))


@pytest.mark.parametrize("text", ["EPSG:2230", "2230", " epsg:2230 ", "EPSG::2230"])
def test_codes_are_understood(text):
    crs = crs_of(text)
    assert crs.epsg == 2230
    assert crs.horizontal_unit == crs.vertical_unit == pytest.approx(SURVEY)


def test_heights_can_have_their_own_crs():
    crs = crs_of("EPSG:2230+5703")
    assert crs.epsg == 2230
    assert (crs.horizontal_unit, crs.vertical_unit) == (pytest.approx(SURVEY), 1.0)


@pytest.mark.parametrize("kind", ["WKT1_GDAL", "WKT2_2019", "PROJ"])
def test_texts_are_understood(kind):
    reference = pyproj.CRS.from_epsg(2230)
    crs = crs_of(reference.to_proj4() if kind == "PROJ" else reference.to_wkt(kind))
    assert crs.horizontal_unit == pytest.approx(SURVEY)


def test_text_needs_no_library(monkeypatch):
    monkeypatch.setattr(stated_module, "library", lambda: None)
    assert crs_of('LOCAL_CS["site",UNIT["foot",0.3048]]').horizontal_unit == 0.3048
    monkeypatch.setattr(stated_module, "wkt_of_epsg", lambda code: None)
    with pytest.raises(BareEarthError, match="pip install pyproj"):
        stated_wkt("EPSG:2230")


@pytest.mark.rest
@pytest.mark.parametrize(
    "text", ["EPSG:99999", "Rome", "EPSG:5703", "https://epsg.io/2230.wkt", "/vsicurl/x", "x" * 999]
)
def test_what_is_no_crs_is_refused_in_one_sentence(text):
    with pytest.raises(BareEarthError, match="no known CRS") as caught:
        stated_wkt(text)
    assert len(str(caught.value)) < 300


def test_nothing_stated_is_nothing():
    assert stated_wkt(None) is stated_wkt("") is None


def test_a_stated_crs_is_told_if_the_file_states_another(las):
    feet = las.vlr(b"LASF_Projection", 2112, stated_wkt("EPSG:2230").encode())
    source = las.make(vlrs=[feet], encoding=0x10)
    for text, is_told in (("EPSG:32632", True), ("EPSG:2230", False)):
        progress = Heard()
        assert bare_earth.info(source, crs=text, progress=progress).epsg == int(text[5:])
        told = [words for words in progress.warnings if "not the one that the file" in words]
        assert len(told) == is_told
    assert bare_earth.info(source).epsg == 2230


@pytest.fixture(scope="module")
def feet():
    return real("field/feet-no-crs.laz")


def test_every_command_that_reads_points_takes_a_crs(feet, tmp_path):
    given = "--crs", "EPSG:2230"
    for words in (
        ("info", feet),
        ("classify", feet, tmp_path / "classes.laz", "--dtm", tmp_path / "a.tif", *FAST_WORDS),
        ("terrain", feet, "--dtm", tmp_path / "b.tif"),
        ("height", feet, tmp_path / "heights.laz"),
        ("key-points", feet, tmp_path / "keys.laz"),
        ("assess", feet, feet, "--error-map", tmp_path / "errors.tif"),
        ("compare-settings", feet, tmp_path / "page.html", "--settings", "slope:whitebox",
         "grid-minimum:paper", "--extent", 6653100, 1923100, 6653300, 1923300),
    ):  # fmt: skip
        code, _, errors = said(*words, *given)
        assert code == 0 and "taken as metres" not in errors, (words, errors)
        code, _, errors = said(*words, "--crs", "EPSG:99999")
        assert code == 1 and "no known CRS" in errors
    for name in ("a", "b", "errors"):
        with rasterio.open(tmp_path / f"{name}.tif") as raster:
            assert raster.crs.to_epsg() == 2230
    with rasterio.open(tmp_path / "b.tif") as raster:
        # Cells of a metre, and heights that stay in feet.
        assert raster.res[0] == pytest.approx(1.0 / SURVEY)
        assert "US survey ft" in raster.descriptions[0]
        assert raster.read(1, masked=True).max() > 90.0
    heights = laspy.read(tmp_path / "heights.laz")
    assert "EPSG:2230" in (tmp_path / "page.html").read_text()
    # Points on the ground lie at 0, whatever the unit; trees are some feet high.
    above = np.asarray(heights["HeightAboveGround"])
    assert 10.0 < above.max() < 100.0


@pytest.mark.rest
def test_a_missing_crs_is_told_once(feet, tmp_path):
    las = laspy.read(feet)
    las.points = las.points[np.arange(0, len(las), 8)]
    box = [*las.header.mins[:2], *(las.header.mins[:2] + 200.0)]
    for name, shift in (("a", 0.0), ("b", 1000.0)):
        las.x = las.x + shift
        las.write(str(tmp_path / f"{name}.laz"))
    one, both = (tmp_path / "a.laz",), (tmp_path / "a.laz", tmp_path / "b.laz")
    page, settings = tmp_path / "page.html", ("--settings", "slope:whitebox", "grid-minimum:paper")
    for words in (
        ("quality", *one),
        ("quality", *both),
        ("check", *one, "--hold-out", 0.02),
        ("compare-settings", *one, page, *settings, "--extent", *box),
        ("compare-settings", *both, page, *settings, "--extent", *box),
        ("deliver", "survey", *one, tmp_path / "out", *FAST_WORDS),
    ):
        code, _, errors = said(*words)
        assert code == 0, errors
        assert errors.count("say its CRS") + errors.count("say their CRS") == 1, (words, errors)


def test_written_clouds_keep_their_records(feet, tmp_path):
    assert said("classify", feet, tmp_path / "out.laz", "--crs", "EPSG:2230", *FAST_WORDS)[0] == 0
    assert laspy.read(tmp_path / "out.laz").header.parse_crs() is None
    las = laspy.read(feet)
    las.header.add_crs(pyproj.CRS.from_epsg(2231))
    las.write(tmp_path / "wrong.laz")
    for name in ("wrong-out.laz", "wrong-out.copc.laz"):
        words = tmp_path / "wrong.laz", tmp_path / name, "--crs", "EPSG:2230", *FAST_WORDS
        assert said("classify", *words)[0] == 0
        assert bare_earth.info(tmp_path / name).epsg == 2231


@pytest.mark.rest
def test_copc_of_a_file_without_a_crs_states_the_given_one(feet, tmp_path):
    for given, epsg in (("EPSG:2230", 2230), (None, None)):
        words = (
            "classify",
            feet,
            tmp_path / f"{epsg}.copc.laz",
            *(("--crs", given) if given else ()),
        )
        assert said(*words)[0] == 0
        made = bare_earth.info(tmp_path / f"{epsg}.copc.laz")
        assert made.epsg == epsg
        assert made.horizontal_unit == pytest.approx(SURVEY if given else 1.0)


def test_a_crs_that_is_given_is_as_one_that_the_file_states(feet, tmp_path):
    las = laspy.read(feet)
    las.header.add_crs(pyproj.CRS.from_epsg(2230))
    las.write(tmp_path / "stated.laz")
    classes = []
    for source, more in ((tmp_path / "stated.laz", ()), (feet, ("--crs", "EPSG:2230")), (feet, ())):
        assert said("classify", source, tmp_path / "out.las", *more, *FAST_WORDS)[0] == 0
        classes.append(np.asarray(laspy.read(tmp_path / "out.las").classification))
    assert np.array_equal(classes[0], classes[1])
    assert not np.array_equal(classes[0], classes[2])


@pytest.mark.rest
@pytest.mark.parametrize(
    "options", quick([(), ("--height-above-ground",)], ("--height-above-ground",))
)
def test_many_files_are_as_one(tmp_path, options):
    integers = strip(6000, 150.0, 130.0)
    one, many = write(tmp_path / "in.las", integers), cut(tmp_path / "tiles", integers)
    given = "--crs", "EPSG:2230+5703", *options, "--method", "slope"
    rasters = [("--dtm", tmp_path / f"{name}.tif") for name in ("one", "many")]
    for source, target, dtm in (
        (one, tmp_path / "out.las", rasters[0]),
        (many, tmp_path / "out", rasters[1]),
    ):
        code, _, errors = said("classify", source, target, *given, *dtm, *FAST_WORDS)
        assert code == 0, errors
    with rasterio.open(rasters[0][1]) as first, rasterio.open(rasters[1][1]) as second:
        assert first.profile == second.profile
        assert first.crs.linear_units_factor[1] == pytest.approx(SURVEY)
        assert np.array_equal(first.read(1), second.read(1))
    ground = np.count_nonzero(laspy.read(tmp_path / "out.las").classification == 2)
    parts = [laspy.read(path).classification == 2 for path in (tmp_path / "out").glob("*.laz")]
    assert sum(map(np.count_nonzero, parts)) == ground
    listed = json.loads((tmp_path / "out" / "classified.vpc").read_text())["features"]
    assert all("California zone 6" in item["properties"]["proj:wkt2"] for item in listed)


@pytest.fixture
def degrees(tmp_path):
    """Return a classified file in metres whose keys say degrees."""
    path = write(tmp_path / "in.las", strip(4_000), classes=2)
    las = laspy.read(path)
    las.header.global_encoding.wkt = False
    las.header.vlrs.append(laspy.VLR("LASF_Projection", 34735, "", DEGREES))
    las.write(path)
    return path


@pytest.mark.rest
def test_coordinates_that_cannot_be_degrees_are_told_and_can_be_given_a_crs(degrees, tmp_path):
    dtm = "--dtm", tmp_path / "dtm.tif"
    for words in (
        ("terrain", degrees, *dtm),
        ("classify", degrees, tmp_path / "out.las"),
        ("classify", degrees, tmp_path / "out"),
    ):
        code, _, errors = said(*words)
        assert code == 1
        assert "degrees (x from 500000" in errors
        assert "--crs" in errors and "Reproject" not in errors
        assert said(*words, "--crs", "EPSG:26918")[0] == 0


def test_degrees_are_still_degrees():
    crs = crs_of("EPSG:4269")
    with pytest.raises(BareEarthError, match="Reproject it first") as caught:
        require_measurable("in.las", crs, (-75.1, 40.0, -75.0, 40.1))
    assert "cannot be degrees" not in str(caught.value)
    with pytest.raises(BareEarthError, match="Reproject it first"):
        require_measurable("in.las", crs_of("EPSG:4978"), (3e6, 1e6, 4e6, 2e6))


@pytest.mark.parametrize(
    ("code", "longitude", "latitude"),
    [(3857, 27, 60), (3857, 0, 1), (3395, 10, 45), (3994, 175, -41), (3832, 150, 30),
     (25832, 9, 60), (2056, 7.5, 47), (3388, 51, 42)],
)  # fmt: skip
def test_the_scale_of_lengths_is_that_of_proj(code, longitude, latitude):
    crs = crs_of(f"EPSG:{code}")
    projection = pyproj.Proj(f"EPSG:{code}")
    x, y = projection(longitude, latitude)
    expected = projection.get_factors(longitude, latitude).parallel_scale
    found = length_scale(crs, (x - 50, y - 50, x + 50, y + 50))
    assert found == pytest.approx(expected, rel=0.008)


def test_web_mercator_is_refused_where_its_lengths_are_wrong(tmp_path):
    source = real("field/mercator-60N.laz")
    for words in (
        ("classify", source, tmp_path / "out.laz"),
        ("classify", source, tmp_path / "out"),
        ("terrain", source, "--dtm", tmp_path / "dtm.tif"),
        ("height", source, tmp_path / "out.laz"),
        ("compare-settings", source, tmp_path / "page.html",
         "--extent", 3e6, 8399000, 3000100, 8399100),
    ):  # fmt: skip
        code, _, errors = said(*words)
        assert code == 1
        assert "2.00 times too long" in errors and "Reproject" in errors
        assert errors.count("\n") == 1
    assert not list(tmp_path.iterdir())
    description = json.loads(said("info", source, "--json")[1])
    assert description["density"] == pytest.approx(0.97, abs=0.01)
    assert "2.00 times too long" in said("info", source)[1]


def test_mercator_near_the_equator_is_measured():
    require_measurable("in.las", crs_of("EPSG:3857"), (11_550_000, 140_000, 11_551_000, 141_000))
    require_measurable("in.las", Crs(epsg=3857), (0, 0, 1, 1))
    with pytest.raises(BareEarthError, match=r"2\.00 times too long"):
        require_measurable("in.las", Crs(epsg=3857), (3e6, 8399000, 3e6, 8399000))
