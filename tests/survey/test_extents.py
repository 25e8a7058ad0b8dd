"""Extents in the order of QGIS and PDAL, both of x before both of y."""

import laspy
import numpy as np
import pytest
from runs import FAST, Heard, said
from surveys import heights_of, write_points

import bare_earth
from bare_earth import BareEarthError
from bare_earth.algorithms.core.box_order import in_order
from bare_earth.algorithms.core.progress import SILENT

EAST, NORTH = 500_000.0, 5_500_000.0
PLACE = (EAST, NORTH, EAST + 80, NORTH + 80)


@pytest.fixture(scope="module")
def scene(tmp_path_factory):
    random = np.random.default_rng(1)
    x, y = random.uniform(0, 80, (2, 6_000))
    path = tmp_path_factory.mktemp("scene") / "in.laz"
    return write_points(path, x, y, 100 + 0.05 * x, 1, offset=(EAST, NORTH, 0.0))


def ground_of(path):
    las = laspy.read(path)
    return np.asarray(las.classification) == 2, np.asarray(las.x) - EAST, np.asarray(las.y) - NORTH


@pytest.mark.rest(but="500010 5500020 500030 5500050")
@pytest.mark.parametrize(
    "words", ["500010 500030 5500020 5500050", "500010 5500020 500030 5500050"]
)
def test_both_orders_of_an_extent_are_the_same_area(scene, tmp_path, words):
    code, _, told = said("classify", scene, tmp_path / "o.laz", "--extent", *words.split())
    ground, x, y = ground_of(tmp_path / "o.laz")
    assert code == 0 and ground.sum() > 300
    assert (x[ground].min(), x[ground].max()) == pytest.approx((10, 30), abs=1)
    assert (y[ground].min(), y[ground].max()) == pytest.approx((20, 50), abs=1)
    assert ("as XMIN XMAX YMIN YMAX" in told) == (words.split()[1] == "500030")


def test_where_x_is_larger_than_y_only_one_order_is_valid(tmp_path):
    x, y = np.random.default_rng(1).uniform(0, 80, (2, 6_000))
    offset = 530_000.0, 180_000.0, 0.0
    source = write_points(tmp_path / "in.laz", x, y, 100 + 0.05 * x, 1, offset=offset)
    progress = Heard()
    extent = (530_010, 530_030, 180_020, 180_050)
    bare_earth.classify(source, tmp_path / "o.laz", extent=extent, progress=progress, **FAST)
    las = laspy.read(tmp_path / "o.laz")
    ground = np.asarray(las.classification) == 2
    assert np.asarray(las.y)[ground].max() == pytest.approx(180_050, abs=1)
    assert any("as XMIN XMAX YMIN YMAX" in text for text in progress.warnings)


@pytest.mark.parametrize(
    "words", ["500010 500030 5500020 5500050", "500010 5500020 500030 5500050"]
)
def test_an_extent_of_rasters(scene, tmp_path, words):
    given = [
        "--ground-classes",
        "1",
        "--dtm",
        tmp_path / "o.tif",
        "--raster-extent",
        *words.split(),
    ]
    code, _, told = said("terrain", scene, *given)
    assert code == 0 and heights_of(tmp_path / "o.tif").shape == (30, 20)
    assert ("as XMIN XMAX YMIN YMAX" in told) == (words.split()[1] == "500030")


def test_a_reversed_extent_is_not_read_in_an_order_that_does_not_fit(scene, tmp_path):
    words = ["--extent", "500030", "5500010", "500010", "5500030"]
    code, _, told = said("classify", scene, tmp_path / "o.laz", *words)
    assert code == 1 and "500030 5500010 500010 5500030" in told


def test_a_window_to_compare_settings_in_the_order_of_qgis(scene, tmp_path):
    words = ["--extent", "500010", "500030", "5500020", "5500050"]
    words += ["--settings", "slope:whitebox", "grid-minimum:paper"]
    code, _, told = said("compare-settings", scene, tmp_path / "o.html", *words)
    assert code == 0 and "as XMIN XMAX YMIN YMAX" in told


def test_an_extent_that_fits_in_no_order_is_refused(scene, tmp_path):
    with pytest.raises(BareEarthError, match=r"beyond the points.* XMIN"):
        extent = (400_010, 400_030, 5_600_000, 5_600_050)
        bare_earth.classify(scene, tmp_path / "o.laz", extent=extent)
    with pytest.raises(BareEarthError, match="XMIN YMIN XMAX YMAX"):
        bare_earth.classify(scene, tmp_path / "o.laz", extent=(3, 2, 1, 0))


@pytest.mark.parametrize(
    "box",
    [(0.0, 0.0, 1e7, 1e7), (-1e9, -1e9, 1e9, 1e9), (4e5, 5.4e6, 6e5, 5.6e6),
     (495_000.0, 5_495_000.0, 505_000.0, 5_505_000.0), (500_010.0, 5_500_020.0, 500_020.0, 5.6e6),
     (EAST + 10, NORTH + 10, EAST + 20, NORTH + 20)],
)  # fmt: skip
def test_generous_extents_stay_as_they_are(box):
    assert in_order(box, PLACE, True, SILENT) == box


def degrees(path, scale=(1e-7, 1e-7, 0.001), shift=(9.0, 50.5), size=0.002, high=20.0, crs=None):
    random = np.random.default_rng(1)
    las = laspy.LasData(laspy.LasHeader(point_format=6, version="1.4"))
    las.header.scales, las.header.offsets = scale, (*shift, 0.0)
    x, y = random.uniform(0, size, (2, 3_000))
    las.x, las.y, las.z = x + shift[0], y + shift[1], 100 + random.uniform(0, high, 3_000)
    las.return_number[:] = las.number_of_returns[:] = 1
    if crs:
        from pyproj import CRS

        las.header.add_crs(CRS(crs))
    las.write(path)
    return path


@pytest.mark.parametrize("command", ["classify", "terrain"])
def test_degrees_without_a_crs_are_refused(tmp_path, command):
    source = degrees(tmp_path / "in.laz")
    words = ["--dtm", tmp_path / "o.tif"]
    words = [tmp_path / "o.laz", *words] if command == "classify" else words
    code, _, told = said(command, source, *words)
    assert code == 1 and "look like degrees (x 9" in told and "Reproject it first" in told


@pytest.mark.rest(but="how1")
@pytest.mark.parametrize(
    "how",
    [{"crs": "EPSG:25832"}, {"scale": (0.001,) * 3}, {"shift": (0.0, 0.0)}, {"size": 30.0}],
)  # fmt: skip
def test_local_coordinates_and_stated_ones_are_no_degrees(tmp_path, how):
    source = degrees(tmp_path / "in.laz", **how)
    _, _, told = said("classify", source, tmp_path / "o.laz")
    assert "look like degrees" not in told
