"""Rasters on the grid of a given one, in units of the CRS, and of a given extent."""

import laspy
import numpy as np
import pytest
from realdata import real
from runs import said
from surveys import cut, strip, write

import bare_earth
from bare_earth import BareEarthError
from bare_earth.algorithms.engine import blocks as blocks_module

rasterio = pytest.importorskip("rasterio")
pytest.importorskip("pyproj")

NAMES = ("dtm", "dsm", "chm", "hillshade", "expected_error")
CRS = "EPSG:25832"


@pytest.fixture(scope="module")
def integers():
    return strip(6_600, 165.0, 130.0)


@pytest.fixture(scope="module")
def source(integers, tmp_path_factory):
    return write(tmp_path_factory.mktemp("one") / "in.las", integers, classes=2)


@pytest.fixture(scope="module")
def files(integers, tmp_path_factory):
    """Return the same points in files of irregular extents."""
    folder = cut(tmp_path_factory.mktemp("many") / "tiles", integers)
    for path in folder.glob("*.laz"):
        las = laspy.read(path)
        las.classification[:] = 2
        las.write(path)
    return folder


def given(path, west=500_010.37, north=5_700_100.71, size=1.3, shape=(60, 90), crs=CRS, **more):
    """Write a raster of nothing; `more` replaces parts of its transform, by their letters."""
    transform = rasterio.Affine(size, 0.0, west, 0.0, -size, north)
    transform = rasterio.Affine(
        *(more.get(letter, getattr(transform, letter)) for letter in "abcdef")
    )
    with rasterio.open(
        path, "w", driver="GTiff", height=shape[0], width=shape[1], count=1, dtype="float32",
        crs=crs, transform=transform,
    ) as raster:  # fmt: skip
        raster.write(np.zeros(shape, np.float32), 1)
    return path


def made(folder, source, *options, names=NAMES, fails=False):
    """Make rasters with the command; return the open rasters, or what it says."""
    folder.mkdir(exist_ok=True)
    paths = {name: folder / f"{name}.tif" for name in names}
    rasters = [
        word for name, path in paths.items() for word in (f"--{name.replace('_', '-')}", path)
    ]
    code, _, errors = said("terrain", source, *rasters, *options)
    if fails:
        assert code and not list(folder.iterdir())
        return errors
    assert code == 0, errors
    return {name: rasterio.open(path) for name, path in paths.items()}


def values(raster):
    return raster.read(1, masked=True)


def test_all_rasters_get_the_grid_of_a_given_one(source, tmp_path):
    like = given(tmp_path / "like.tif")
    rasters = made(tmp_path / "out", source, "--crs", CRS, "--like", like)
    with rasterio.open(like) as grid:
        for raster in rasters.values():
            assert raster.transform == grid.transform
            assert raster.shape == grid.shape
            assert raster.crs == grid.crs
    # It is the terrain, at the places of these cells: a slope of 6 % to the east.
    found = values(rasters["dtm"])
    x, y = rasters["dtm"].xy(*np.mgrid[:60, :90].reshape(2, -1))
    plane = 60 + 0.06 * (np.array(x) - 500_000) + 2 * np.sin((np.array(y) - 5_700_000) / 25)
    assert abs(np.ma.median(found - plane.reshape(60, 90))) < 0.05


@pytest.fixture(scope="module")
def usual(source, tmp_path_factory):
    """Return the rasters on the grid that they have if no other is given."""
    return made(tmp_path_factory.mktemp("usual"), source, "--crs", CRS)


@pytest.mark.rest
def test_the_grid_of_the_usual_rasters_gives_the_usual_rasters(source, usual, tmp_path):
    again = made(tmp_path / "again", source, "--crs", CRS, "--like", usual["dtm"].name)
    for name in NAMES:
        assert usual[name].profile == again[name].profile
        assert np.array_equal(usual[name].read(1), again[name].read(1))


@pytest.mark.rest
def test_a_shifted_grid_is_the_same_in_one_file_and_in_many(source, files, tmp_path, monkeypatch):
    like = given(tmp_path / "like.tif", 499_950.37, 5_700_180.71, shape=(200, 300))
    monkeypatch.setattr(blocks_module, "_SIDE", 100.0)
    monkeypatch.setattr(blocks_module, "_REACHES", 0.5)
    one = made(tmp_path / "one", source, "--crs", CRS, "--like", like)
    many = made(tmp_path / "many", files, "--crs", CRS, "--like", like)
    for name in NAMES:
        found = values(one[name])
        assert np.array_equal(found.filled(7), values(many[name]).filled(7))
        assert found.count() > 10_000
        # Cells outside of the survey have no value.
        assert found.mask[0].all() and found.mask[:, 0].all()


@pytest.mark.long
def test_the_same_grid_from_disk(source, tmp_path):
    like = given(tmp_path / "like.tif")
    much = made(tmp_path / "much", source, "--crs", CRS, "--like", like)
    little = made(tmp_path / "little", source, "--crs", CRS, "--like", like, "--memory", "0.001")
    for name in NAMES:
        assert np.array_equal(much[name].read(1), little[name].read(1))


@pytest.mark.rest
def test_constraints_lie_where_they_are_on_any_grid(source, tmp_path):
    west, south, width = 500_040.0, 5_700_040.0, 49.0
    east, north = west + width, south + width
    ring = [[west, south], [east, south], [east, north], [west, north], [west, south]]
    water = tmp_path / "water.geojson"
    water.write_text(f'{{"type": "Polygon", "coordinates": [{ring}]}}')
    # Cells so large that the water would lie elsewhere if it did not follow their origin.
    like = given(tmp_path / "like.tif", 500_013.0, 5_700_117.0, 7.0, (14, 24))
    options = "--crs", CRS, "--like", like, "--water", water
    dtm = made(tmp_path / "out", source, *options, names=["dtm"])["dtm"]
    found = values(dtm)
    x, y = (
        np.array(places).reshape(found.shape)
        for places in dtm.xy(*np.mgrid[:14, :24].reshape(2, -1))
    )
    depth = np.minimum(np.minimum(x - west, east - x), np.minimum(y - south, north - y))
    is_flat = np.abs(found - np.ma.median(found[depth > 10.0])) < 1e-3
    assert (depth > 1.0).sum() >= 36
    assert is_flat[depth > 1.0].all()
    assert is_flat[depth < -1.0].mean() < 0.05


@pytest.mark.parametrize(
    ("how", "words"),
    [
        (dict(b=0.4, d=0.4), "are rotated"),
        (dict(e=-2.6), "not square"),
        (dict(e=1.3), "south up"),
        (dict(crs="EPSG:25833"), "in another CRS .*'crs'"),
        (dict(crs="EPSG:4326"), "in another CRS"),
        (dict(west=600_000.0), "No point .*'like'"),
    ],
)
def test_unsuitable_rasters_are_refused_in_one_sentence(source, tmp_path, how, words):
    like = given(tmp_path / "like.tif", **how)
    with pytest.raises(BareEarthError, match=words) as caught:
        bare_earth.terrain(source, dtm=tmp_path / "out.tif", like=like, crs=CRS)
    assert "\n" not in str(caught.value)
    assert not (tmp_path / "out.tif").exists()


def test_a_raster_that_the_points_do_not_meet_is_refused_before_many_files_are_classified(
    files, tmp_path
):
    like = given(tmp_path / "like.tif", west=600_000.0)
    code, _, errors = said(
        "classify", files, tmp_path / "out", "--dtm", tmp_path / "dtm.tif", "--like", like
    )
    assert code == 1
    assert "No point" in errors and "--like" in errors
    assert not (tmp_path / "out").exists()


def test_points_without_crs_are_taken_to_be_in_that_of_the_raster(source, tmp_path):
    like = given(tmp_path / "like.tif")
    raster = made(tmp_path / "out", source, "--like", like, names=["dtm"])["dtm"]
    assert raster.crs == rasterio.CRS.from_string(CRS)
    feet = given(tmp_path / "feet.tif", crs="EPSG:2230")
    words = made(tmp_path / "feet", source, "--like", feet, names=["dtm"], fails=True)
    assert "do not say their CRS" in words and "with --crs" in words


@pytest.mark.rest
def test_an_extent_cuts_the_usual_cells(source, usual, tmp_path):
    box = 500_020.5, 5_699_990.2, 500_080.0, 5_700_050.7
    cut_out = made(tmp_path / "cut", source, "--crs", CRS, "--raster-extent", *box)
    for name in NAMES:
        raster = cut_out[name]
        # Widened to whole cells, which stay where they are.
        assert raster.bounds == (500_020.0, 5_699_990.0, 500_080.0, 5_700_051.0)
        window = rasterio.windows.from_bounds(*raster.bounds, usual[name].transform)
        expected = usual[name].read(1, window=window, boundless=True, masked=True)
        found = values(raster)
        assert np.array_equal(found.filled(7), expected.filled(7))
        assert found[-9:].mask.all()


def test_an_extent_on_the_grid_of_a_raster_cuts_its_cells(source, tmp_path):
    like = given(tmp_path / "like.tif")
    box = 500_015.0, 5_700_050.0, 500_060.0, 5_700_100.0
    raster = made(
        tmp_path / "out", source, "--crs", CRS, "--like", like, "--raster-extent", *box,
        names=["dtm"],
    )["dtm"]  # fmt: skip
    shift = (raster.bounds.left - 500_010.37) / 1.3, (raster.bounds.top - 5_700_100.71) / 1.3
    assert np.allclose(shift, np.rint(shift), atol=1e-6)
    assert raster.bounds.left <= box[0] < raster.bounds.left + 1.3


@pytest.mark.parametrize("box", [(5, 0, 1, 9), (0, 0, 0, 9), (0, 0, "nan", 9)])
def test_what_is_no_extent_is_refused(source, tmp_path, box):
    code, _, errors = said(
        "terrain", source, "--dtm", tmp_path / "out.tif", "--raster-extent", *box
    )
    assert code == 2
    assert "smallest x and y" in errors


@pytest.mark.rest
def test_each_file_gets_its_part_of_the_grid(source, files, tmp_path):
    like = given(tmp_path / "like.tif", shape=(70, 100))
    out = tmp_path / "dtm.tif"
    code, _, errors = said(
        "terrain", files, "--dtm", out, "--crs", CRS, "--like", like, "--raster-per-file"
    )
    assert code == 0, errors
    with rasterio.open(tmp_path / "dtm.vrt") as joined, rasterio.open(like) as grid:
        assert joined.transform == grid.transform
        assert joined.shape == grid.shape
        whole = values(joined)
    alone = made(tmp_path / "alone", source, "--crs", CRS, "--like", like, names=["dtm"])["dtm"]
    inside = ~whole.mask
    assert inside.mean() > 0.9
    assert np.array_equal(whole[inside], values(alone)[inside])


@pytest.mark.rest
def test_three_feet_are_three_feet(tmp_path):
    source = real("field/feet-2260.laz")
    raster = made(
        tmp_path / "out", source, "--dtm-cell-size", "3", "--dtm-cell-unit", "crs", names=["dtm"]
    )["dtm"]
    assert raster.res == (3.0, 3.0)
    assert raster.bounds.left % 3.0 == raster.bounds.top % 3.0 == 0.0
    metres = made(
        tmp_path / "metres", source, "--dtm-cell-size", f"{3 * 1200 / 3937}", names=["dtm"]
    )["dtm"]
    assert np.array_equal(raster.read(1), metres.read(1))


@pytest.mark.rest
@pytest.mark.parametrize(
    ("option", "nodata"),
    [("-32768", -32768.0), pytest.param("none", np.nan, marks=pytest.mark.long)],
)
def test_cells_without_data_have_the_value_that_is_asked_for(source, tmp_path, option, nodata):
    box = 499_990, 5_700_000, 500_050, 5_700_050
    usual = made(tmp_path / "usual", source, "--raster-extent", *box)
    rasters = made(tmp_path / "out", source, "--raster-extent", *box, "--raster-nodata", option)
    for name, raster in rasters.items():
        expected = 0.0 if name == "hillshade" else nodata
        assert np.array_equal(raster.nodata, expected, equal_nan=True)
        assert np.array_equal(raster.read(1)[0, 0], expected, equal_nan=True)
        assert values(raster).mask.any()
        assert np.array_equal(values(raster).filled(7), values(usual[name]).filled(7))


def test_a_value_that_32_bits_cannot_hold_is_refused(source, tmp_path):
    code, _, errors = said(
        "terrain", source, "--dtm", tmp_path / "out.tif", "--raster-nodata=-1e300"
    )
    assert code == 2
    assert "No-data value" in errors
