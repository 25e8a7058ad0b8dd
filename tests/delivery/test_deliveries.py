"""Deliveries of a small scene whose ground, water, house and trees are known."""

import json
import os
import re
import shutil
from pathlib import Path

import laspy
import numpy as np
import pytest
import toy_delivery
from independent_water import compare, corners_in_flat_water
from matrices import quick
from runs import FAST, FAST_WORDS, CancelAt, Heard
from scipy.spatial import cKDTree
from surveys import classes_of, finished, heights_of, write_points

import bare_earth
from bare_earth import BareEarthError, Cancelled, Progress, classify, deliver, terrain
from bare_earth.algorithms.cli import main
from bare_earth.algorithms.core.errors import FinishedFilesStay, OutputInUse
from bare_earth.algorithms.delivery.deliveries import DELIVERIES, STATED
from bare_earth.algorithms.delivery.job import Settings
from bare_earth.algorithms.delivery.parameters import DeliveryWater
from bare_earth.algorithms.grids.lines import along
from bare_earth.algorithms.survey.area import Area
from bare_earth.algorithms.survey.vector_files import read_boundary, read_lines
from bare_earth.algorithms.tools.quality.specifications import SPECIFICATIONS
from bare_earth.algorithms.tools.water.finding import Water
from bare_earth.algorithms.tools.water_classes import WaterClasses

pytest.importorskip("pyproj")
EAST, NORTH, WIDTH, DEPTH = 500_000.0, 5_600_000.0, 150.0, 90.0
LAKE = (115.0, 45.0, 22.0)  # x, y and radius
# What takes the least time: nothing held out, the fastest method, large cells; and such a delivery.
QUICK = {"hold_out_share": None, **FAST, "dtm_cell_size": 2.0}
SMALL = {"delivery": "drone-site", **QUICK}
ALWAYS = {"index.html", "delivery.json", "accuracy.html", "quality.html", "dtm.tif",
          "hillshade.tif"}  # fmt: skip
REVIEWED = {"expected_error.tif", "error_cause.tif", "places.gpkg", "review.html"}
FILES = {
    "survey": {
        *REVIEWED, "dsm.tif", "quality/pulse_density.tif", "quality/ground_density.tif",
        "quality/voids.tif", "quality/overlap.tif", "quality/strip_differences.tif",
        "quality/surface_height.tif", "low_confidence.gpkg",
    },
    "archaeology": {
        "vat.tif", "sky_view.tif", "openness.tif", "negative_openness.tif", "local_dominance.tif",
        "relief.tif", "red_relief.tif", "expected_error.tif", "terrain_with_buildings.tif",
        "quality/low_vegetation.tif",
    },
    "forestry": {"dsm.tif", "chm.tif", "quality/low_vegetation.tif"},
    "flood": {
        *REVIEWED, "dsm.tif", "contours.gpkg", "water.gpkg", "breaklines.gpkg",
        "low_confidence.gpkg",
    },
    "drone-site": {*REVIEWED, "dsm.tif", "contours.gpkg", "quality/ground_density.tif"},
}  # fmt: skip


def ground_at(x, y):
    """Return the height of the ground: level land, with a basin round the lake."""
    away = np.hypot(x - LAKE[0], y - LAKE[1]) - LAKE[2]
    return 100.0 + np.clip(0.25 * away, 0.0, 4.0)


def points():
    """Return x, y, z, return numbers, numbers of returns, and the truth: 2, 5 or 6."""
    random = np.random.default_rng(11)
    count = 18_000
    x, y = random.uniform(0, WIDTH, count), random.uniform(0, DEPTH, count)
    dry = np.hypot(x - LAKE[0], y - LAKE[1]) > LAKE[2]
    x, y = x[dry], y[dry]
    z = ground_at(x, y) + random.normal(0, 0.02, len(x))
    truth, number, several = (np.full(len(x), value) for value in (2, 1, 1))
    house = (x > 20) & (x < 34) & (y > 60) & (y < 80)
    z[house], truth[house] = 108.0 + random.normal(0, 0.02, house.sum()), 6
    # Each pulse into the wood has a return of a crown, and one of the ground.
    wood = (x > 15) & (x < 55) & (y > 8) & (y < 40)
    several[wood], number[wood] = 2, 2
    crowns = z[wood] + random.uniform(3.0, 12.0, wood.sum())
    columns = [
        np.concatenate((column, more))
        for column, more in zip(
            (x, y, z, number, several, truth),
            (x[wood], y[wood], crowns, *(np.full(wood.sum(), value) for value in (1, 2, 5))),
        )
    ]
    return np.column_stack(columns)


def write(path, rows):
    returns, several = rows[:, 3:5].T.astype(int)
    return write_points(
        path, *rows.T[:3], offset=(EAST, NORTH, 0.0), crs="EPSG:25832",
        return_number=returns, number_of_returns=several,
    )  # fmt: skip


@pytest.fixture(scope="module")
def scene(tmp_path_factory):
    """Return the points, a file of them, and a folder in which they are two files."""
    folder, rows = tmp_path_factory.mktemp("scene"), points()
    tiles = folder / "tiles"
    tiles.mkdir()
    west = rows[:, 0] < 70.0
    write(tiles / "west.laz", rows[west])
    write(tiles / "east.laz", rows[~west])
    return rows, write(folder / "whole.laz", rows), tiles


@pytest.fixture(scope="module")
def made(scene, tmp_path_factory):
    """Return what makes a delivery of one file or of two, each only once."""
    known, folder = {}, tmp_path_factory.mktemp("made")

    def make(name, is_one=True):
        if (name, is_one) not in known:
            target = folder / f"{name}-{is_one}"
            source = scene[1 if is_one else 2]
            known[name, is_one] = deliver(source, target, delivery=name), target
        return known[name, is_one]

    return make


@pytest.fixture(scope="module")
def watered(scene, tmp_path_factory):
    """Return what makes a delivery of two files with water of the user, each only once."""
    known, folder = {}, tmp_path_factory.mktemp("watered")

    def make(how):
        name = f"key points {how['key_points']}"
        if name not in known:
            known[name] = deliver(scene[2], folder / name, **how), folder / name
        return known[name]

    return make


def with_water(has_key_points=False):
    """Return a delivery with water that a user draws, of which nothing is held out."""
    water, _ = given_water(0.71)
    return {**QUICK, "key_points": has_key_points, "water": water}


def files_of(folder):
    found = (path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file())
    return {name for name in found if not name.startswith(("points/", ".bare-earth/"))}


def test_the_tables_are_complete():
    assert FILES.keys() == DELIVERIES.keys() and STATED.keys() == SPECIFICATIONS.keys()


@pytest.mark.rest(but="drone-site")
@pytest.mark.parametrize("name", list(FILES))
def test_a_delivery_of_one_file_has_all_its_files(made, scene, name):
    summary, folder = made(name)
    assert files_of(folder) == ALWAYS | FILES[name]
    assert [path.name for path in (folder / "points").iterdir()] == ["whole.laz"]
    record = json.loads((folder / "delivery.json").read_text())
    assert record["is_finished"] and set(record["files"]) | {"delivery.json"} == {
        *files_of(folder), "points/whole.laz"
    }  # fmt: skip
    page = (folder / "index.html").read_text(encoding="utf-8")
    for file in files_of(folder) - {"index.html", "delivery.json"}:
        assert f'href="{file}"' in page
    assert f"{summary.ground_count:,}" in page and summary.point_count == len(scene[0])
    # Nothing is left of the folder in which it was made, and no page names it.
    assert not [name for name in os.listdir(folder.parent) if name.startswith(".")]
    pages = [path.read_text(encoding="utf-8") for path in folder.glob("*.html")]
    assert not any(".~" in text or str(folder.parent) in text for text in pages)


@pytest.mark.rest
@pytest.mark.parametrize("name", quick(FILES, "forestry", "flood"))
def test_two_files_get_the_same_as_one(made, scene, name):
    (one, folder), (many, other) = made(name), made(name, is_one=False)
    assert files_of(folder) == files_of(other)
    assert one.class_counts == many.class_counts and one.cell_size == many.cell_size
    for key in ("dtm.tif", "dsm.tif", "terrain_with_buildings.tif"):
        if (folder / key).exists():
            assert np.array_equal(heights_of(folder / key), heights_of(other / key), equal_nan=True)
    written = {path.name for path in (other / "points").glob("*.laz")}
    assert written == {"east.laz", "west.laz"} and os.path.exists(many.cloud)


@pytest.mark.rest
def test_classes_are_those_of_the_command(made, scene, tmp_path):
    summary, folder = made("survey")
    how = {"low_noise_class": True, "high_noise_class": True, "bridge_class": 17}
    classify(scene[1], tmp_path / "own.laz", **how)
    own = classes_of(tmp_path / "own.laz")
    assert np.array_equal(classes_of(folder / "points" / "whole.laz"), own)
    truth = scene[0][:, 5]
    assert np.mean((own == 2) == (truth == 2)) > 0.99 and summary.ground_count == (own == 2).sum()


@pytest.mark.rest
def test_water_is_flat_in_the_terrain_model_and_it_is_that_of_the_commands(made, tmp_path):
    summary, folder = made("flood")
    assert summary.water.lakes == 1 and summary.water.area == pytest.approx(1520.0, rel=0.15)
    cloud = folder / "points" / "whole.laz"
    # The breakline of the shore is the polygon with its level.
    (shore,) = read_lines(folder / "breaklines.gpkg")
    own = tmp_path / "own.tif"
    terrain(cloud, dtm=own, dtm_cell_size=summary.cell_size, water=((shore,),))
    dtm = heights_of(folder / "dtm.tif")
    assert np.array_equal(heights_of(own), dtm, equal_nan=True)
    # The lake reaches from x = 93 to 137 m, its middle is 45 m north of the lower edge.
    cell = summary.cell_size
    lake = dtm[
        int((DEPTH - 53) / cell) : int((DEPTH - 37) / cell), int(105 / cell) : int(125 / cell)
    ]
    assert np.ptp(lake) == 0.0 and lake.mean() == pytest.approx(100.0, abs=0.2)
    polygons = folder / "water.gpkg"
    files = (folder / name for name in ("breaklines.gpkg", "dtm.tif", "dsm.tif"))
    (found,) = compare(polygons, *files).values()
    assert found.missing == 0 and max(found.level, found.lines) < 0.002
    assert corners_in_flat_water(polygons, folder / "contours.gpkg", folder / "dtm.tif") == 0


def given_water(distance):
    """Return water that a user draws over both tiles and the lake, and the class of each point.

    Classes are those of ground points: 9 in the water, 20 up to a distance in metres from it, 2.
    """
    west, south, east, north = 62.0, 15.0, 125.0, 75.0
    corners = np.array([(west, south), (east, south), (east, north), (west, north)])
    area = (np.add(corners, (EAST, NORTH)),)

    def truth(x, y):
        away = np.column_stack((x - east, west - x, y - north, south - y))
        beyond = np.hypot(np.maximum(away[:, :2], 0).max(1), np.maximum(away[:, 2:], 0).max(1))
        return np.where(away.max(1) < 0, 9, np.where(beyond <= distance, 20, 2))

    return (area,), truth


def rows_of_classes(page):
    """Return the numbers of points of each class that a page tells."""
    found = re.findall(r">Class (\d+)[^<]*</th><td[^>]*>([\d,]+)<", page.read_text("utf-8"))
    return {int(value): int(count.replace(",", "")) for value, count in found}


@pytest.mark.rest
@pytest.mark.parametrize(
    ("specification", "distance", "is_one"),
    [
        ("lbs-ql1", 0.35, True),
        ("lbs-ql2", 0.71, False),
        pytest.param("lbs-ql1", 0.35, False, marks=pytest.mark.long),
        pytest.param("lbs-ql2", 0.71, True, marks=pytest.mark.long),
    ],
)
def test_ground_in_the_water_of_a_survey_has_the_classes_of_the_specification(
    scene, tmp_path, specification, distance, is_one
):
    water, truth = given_water(distance)
    how = {**QUICK, "specification": specification, "water": water}
    summary = deliver(scene[1 if is_one else 2], tmp_path / "out", **how)
    clouds = [laspy.read(path) for path in (tmp_path / "out" / "points").glob("*st.laz")]
    clouds = [laspy.read(summary.cloud)] if is_one else clouds
    assert len(clouds) == 2 - is_one
    x, y = (np.concatenate([np.asarray(las[name]) for las in clouds]) for name in "xy")
    classes = np.concatenate([np.asarray(las.classification) for las in clouds])
    ground = np.isin(classes, (2, 9, 20))
    expected = truth(x[ground] - EAST, y[ground] - NORTH)
    assert np.array_equal(classes[ground], expected) and ground.sum() > 10_000
    counts = dict(zip(*(code.tolist() for code in np.unique(classes, return_counts=True))))
    assert min(counts[9], counts[20]) > 50 and counts[2] == summary.ground_count
    page = rows_of_classes(tmp_path / "out" / "index.html")
    assert page == summary.class_counts == summary.quality.classes == counts
    record = json.loads((tmp_path / "out" / "delivery.json").read_text())
    assert record["classes"] == {str(value): count for value, count in counts.items()}
    assert {f"points/{Path(summary.cloud).name}"} <= set(record["files"])


@pytest.mark.rest
@pytest.mark.parametrize("is_one", quick([True, False], False))
def test_key_points_are_among_the_ground_that_water_leaves(scene, watered, tmp_path, is_one):
    how, folder = with_water(has_key_points=True), tmp_path / "out"
    summary, folder = (deliver(scene[1], folder, **how), folder) if is_one else watered(how)
    clouds = [laspy.read(path) for path in (folder / "points").glob("*.laz")]
    marked = [np.asarray(las.classification)[np.asarray(las.key_point) == 1] for las in clouds]
    assert set(np.concatenate(marked)) == {2} and all(map(len, marked))
    assert {9, 20} <= summary.class_counts.keys() and not list(folder.glob(".w*"))
    names = {"classified.vpc", "east.laz", "west.laz"}
    written = {path.name for path in (folder / "points").iterdir()}
    assert written == ({"whole.laz"} if is_one else names)


@pytest.mark.rest
def test_the_lists_of_files_with_classes_of_water_are_those_of_their_places(scene, tmp_path):
    water, _ = given_water(0.71)
    how = {**QUICK, "format": "copc.laz"}
    summary = deliver(scene[2], tmp_path / "out", water=water, **how)
    points = tmp_path / "out" / "points"
    tiles = {"east.copc.laz", "west.copc.laz"}
    assert {path.name for path in points.iterdir()} == {*tiles, "classified.vpc"}
    listed = json.loads(Path(summary.cloud).read_text())["features"]
    assert {Path(tile["assets"]["data"]["href"]).name for tile in listed} == tiles
    files = json.loads((tmp_path / "out" / "delivery.json").read_text())["files"]
    assert {file for file in files if not (tmp_path / "out" / file).is_file()} == set()
    assert {name for name in os.listdir(tmp_path / "out") if name[0] == "."} == {".bare-earth"}


@pytest.mark.rest
def test_water_that_was_found_gives_classes_in_one_file_and_in_two(made):
    (one, folder), (many, _) = made("flood"), made("flood", is_one=False)
    (water,) = read_boundary(folder / "water.gpkg")
    las = laspy.read(one.cloud)
    x, y, classes = (np.asarray(las[name]) for name in ("x", "y", "classification"))
    inside = Area(None, (water,)).contains(x, y)
    shore = np.concatenate([along(ring, 0.01, is_closed=True)[:, :2] for ring in water])
    beside = cKDTree(shore).query(np.column_stack((x, y)))[0]
    assert (classes[inside] == 9).all() and (classes[~inside] != 9).all()
    ground = np.isin(classes, (2, 20)) & (np.abs(beside - 0.7) > 0.01)
    assert np.array_equal(classes[ground] == 20, beside[ground] < 0.7)
    assert one.class_counts == many.class_counts and one.class_counts[20] > 20
    assert one.ground_count == many.ground_count == one.class_counts[2]
    assert one.quality.classes == one.class_counts


def set_of(kind, delivery, specification, *sets):
    """Return the parameters of a tool in a delivery, given what the user gave."""
    values = DELIVERIES[delivery].values_with(specification)
    return Settings(sets, values).set_of(kind)


def test_classes_of_water_are_those_that_the_specification_knows():
    distances = {"none": 0.7, "linz": 0.7, "lbs-ql1": 0.35, "lbs-ql2": 0.71, "ign": 0.0}
    for name, distance in distances.items():
        assert set_of(WaterClasses, "flood", name) == WaterClasses(shore_distance=distance)
    assert {name for name, content in DELIVERIES.items() if content.water} == {"survey", "flood"}


def test_a_survey_is_as_the_base_specification_asks(made):
    summary, folder = made("survey")
    import rasterio

    with rasterio.open(folder / "dtm.tif") as dtm:
        assert dtm.nodata == -999999.0 and dtm.res == (1.0, 1.0)
    assert summary.quality.specification == "lbs-ql2" and summary.quality.comparison
    assert summary.check.hold_out.all.rmse < 0.06


@pytest.mark.rest
def test_a_specification_brings_the_classes_that_it_asks_for(scene, tmp_path):
    how = {"specification": "ign", "hold_out_share": None, "method": "slope"}
    summary = deliver(scene[1], tmp_path / "out", **how)
    truth, classes = scene[0][:, 5], classes_of(summary.cloud)
    assert np.mean(classes[truth == 6] == 6) > 0.9 and np.mean(classes[truth == 5] == 5) > 0.9
    assert summary.cell_size == 0.5


@pytest.mark.rest
def test_forestry_has_heights_and_classes_of_vegetation(made, scene):
    _, folder = made("forestry")
    las = laspy.read(folder / "points" / "whole.laz")
    crowns = scene[0][:, 5] == 5
    true = scene[0][:, 2] - ground_at(*scene[0].T[:2])
    found = np.asarray(las.HeightAboveGround)[crowns]
    assert np.median(np.abs(found - true[crowns])) < 0.05
    assert np.mean(np.asarray(las.classification)[crowns] == 5) > 0.95


@pytest.mark.rest
def test_archaeology_has_a_terrain_with_the_house_on_it(made):
    summary, folder = made("archaeology")
    dtm, with_house = (
        heights_of(folder / f"{name}.tif") for name in ("dtm", "terrain_with_buildings")
    )
    cell = summary.cell_size
    house = np.s_[
        int((DEPTH - 76) / cell) : int((DEPTH - 64) / cell), int(24 / cell) : int(30 / cell)
    ]
    wood = np.s_[
        int((DEPTH - 35) / cell) : int((DEPTH - 12) / cell), int(20 / cell) : int(50 / cell)
    ]
    assert np.median((with_house - dtm)[house]) > 2.5
    assert np.percentile((with_house - dtm)[wood], 95) < 0.3


@pytest.mark.rest
def test_options_of_the_user_replace_those_of_the_delivery(scene, tmp_path):
    summary = deliver(
        scene[1], tmp_path / "out", delivery="archaeology", preset="flat", ground_tolerance=0.3,
        dtm_cell_size=2.0, key_points=True, hold_out_share=None,
    )  # fmt: skip
    assert summary.cell_size == 2.0 and summary.check is None
    settings = json.loads((tmp_path / "out" / "delivery.json").read_text())["settings"]
    assert settings["TIN densification"] == {"preset": "flat", "ground_tolerance": "0.3"}
    marked = np.asarray(laspy.read(summary.cloud).key_point)
    assert 0 < marked.sum() < summary.ground_count / 4


@pytest.mark.rest
def test_checkpoints_are_compared_with_points_and_terrain_model(scene, tmp_path):
    x, y = np.meshgrid([60.0, 66.0, 72.0], [10.0, 45.0, 80.0])
    places = np.column_stack((x.ravel(), y.ravel(), ground_at(x, y).ravel() - 0.1))
    known = places + np.array((EAST, NORTH, 0.0))
    known = np.vstack((known, known[:1], known[1:2] - [0.0, 0.0, known[1, 2]]))
    summary = deliver(scene[1], tmp_path / "out", delivery="drone-site", checkpoints=known, **FAST)
    left = ["1 listed again (each point counts once): 10",
            "1 without a height (missing, or a nodata value such as 0 or -9999): 11"]  # fmt: skip
    assert [text for title, text in summary.rows() if title == "not counted"] == left
    page = (tmp_path / "out" / "index.html").read_text(encoding="utf-8")
    assert all(text in page for text in left)
    assert summary.check.counted == 9 and summary.check.shift == pytest.approx(-0.1, abs=0.03)
    assert {"checkpoints.csv", "checkpoints.gpkg"} <= files_of(tmp_path / "out")
    with pytest.raises(BareEarthError, match="checkpoints"):
        deliver(scene[1], tmp_path / "far", checkpoints=places)
    assert not (tmp_path / "far").exists()


@pytest.mark.rest(but="0.0")
@pytest.mark.parametrize("share", [0.0, 0.3, 1.0])
def test_a_cancel_leaves_nothing_of_one_file(scene, tmp_path, share):
    with pytest.raises(Cancelled):
        deliver(scene[1], tmp_path / "out", progress=CancelAt(share), **SMALL)
    assert os.listdir(tmp_path) == []


@pytest.mark.rest
def test_many_files_can_be_continued_after_a_cancel(scene, tmp_path):
    target = tmp_path / "out"
    with pytest.raises(FinishedFilesStay):
        deliver(scene[2], target, progress=CancelAt(0.95), **SMALL)
    assert files_of(target) == {"delivery.json"}
    assert not json.loads((target / "delivery.json").read_text())["is_finished"]
    before = {path: path.stat().st_mtime_ns for path in (target / "points").glob("*.laz")}
    assert len(before) == 2
    deliver(scene[2], target, resume=True, **SMALL)
    assert {file: file.stat().st_mtime_ns for file in before} == before
    assert files_of(target) == (ALWAYS | FILES["drone-site"]) - {"accuracy.html"}


class StopsAfter(Progress):
    """Cancels when there are so many classified files with classes of water."""

    def __init__(self, folder, count):
        self._folder, self._count = folder, count

    def report(self, fraction):
        if len(finished(self._folder / ".waiting" / "water-classes")) >= self._count:
            raise Cancelled


def classes_by_file(folder):
    return {path.name: classes_of(path) for path in (folder / "points").glob("*.laz")}


@pytest.mark.rest
@pytest.mark.parametrize(
    ("count", "has_key_points"),
    [
        (1, False),
        *(pytest.param(*row, marks=pytest.mark.long) for row in ((1, True), (2, False), (2, True))),
    ],
)
def test_files_with_classes_of_water_can_be_continued_after_a_cancel(
    scene, watered, tmp_path, count, has_key_points
):
    target, how = tmp_path / "out", with_water(has_key_points)
    with pytest.raises(FinishedFilesStay):
        deliver(scene[2], target, progress=StopsAfter(target, count), **how)
    ready = {name for name in files_of(target) if not name.startswith(".waiting/")}
    assert ready == {"delivery.json"}
    # The classified files stay as they were, until all is done.
    before = {path: path.stat().st_mtime_ns for path in (target / "points").glob("*.laz")}
    assert len(before) == 2 and not any(
        (value == 9).any() for value in classes_by_file(target).values()
    )
    progress = Heard()
    summary = deliver(scene[2], target, resume=True, progress=progress, **how)
    assert "2 files are done already." in progress.infos and not (target / ".waiting").exists()
    found = classes_by_file(target)
    whole, folder = watered(how)
    expected = classes_by_file(folder)
    assert all(np.array_equal(found[key], expected[key]) for key in expected)
    assert summary.class_counts == whole.class_counts and (found["west.laz"] == 9).any()
    assert files_of(target) == files_of(folder)


@pytest.mark.rest
@pytest.mark.parametrize("resume", quick([True, False], True))
def test_a_second_run_classifies_files_with_classes_of_water_again(
    scene, watered, tmp_path, resume
):
    target, how, progress = tmp_path / "out", with_water(), Heard()
    first, folder = watered(how)
    shutil.copytree(folder, target)
    before = classes_by_file(target)
    second = deliver(scene[2], target, resume=resume, progress=progress, **how)
    assert second.class_counts == first.class_counts
    assert all(
        np.array_equal(before[name], classes) for name, classes in classes_by_file(target).items()
    )
    assert any("2 finished files" in text for text in progress.infos) == resume
    if not resume:
        return
    # Without water, nothing is left of the classes of water.
    third = deliver(scene[2], target, resume=True, **QUICK)
    assert not {9, 20} & third.class_counts.keys()
    assert not any((value == 9).any() for value in classes_by_file(target).values())


@pytest.mark.rest
def test_an_error_while_files_move_to_their_places_leaves_no_false_record(
    scene, watered, tmp_path, monkeypatch
):
    target, how = tmp_path / "out", with_water()
    move = os.replace

    def refuse(source, place):
        is_last = Path(source).parent == target / ".waiting" / "water-classes"
        if is_last and Path(place) == target / "points" / "west.laz":
            raise OSError(28, "No space left on device")
        move(source, place)

    with monkeypatch.context() as patched:
        patched.setattr("bare_earth.algorithms.delivery.folder.os.replace", refuse)
        with pytest.raises(BareEarthError, match="the disk is full"):
            deliver(scene[2], target, **how)
    assert not json.loads((target / "delivery.json").read_text())["is_finished"]
    deliver(scene[2], target, resume=True, **how)
    expected = classes_by_file(watered(how)[1])
    assert all(
        np.array_equal(classes, expected[name]) for name, classes in classes_by_file(target).items()
    )


@pytest.mark.rest
@pytest.mark.parametrize("is_one", quick([True, False], False))
def test_a_delivery_is_kept_beside_an_old_one_that_a_program_has_open(
    scene, tmp_path, windows, is_one
):
    target, source = tmp_path / "out", scene[1] if is_one else scene[2]

    class Opens(Progress):
        def report(self, fraction):
            if fraction > 0.9 and not windows.in_use:
                windows.hold(target / "dtm.tif", 5)

    def content():
        return {name: (target / name).read_bytes() for name in files_of(target)}

    deliver(source, target, **SMALL)
    before = content()
    windows.hold(target / "dtm.tif")
    with pytest.raises(OutputInUse, match=r"dtm\.tif: another program"):
        deliver(source, target, **SMALL)  # before any work
    assert content() == before and os.listdir(tmp_path) == ["out"]
    windows.in_use.clear()
    with pytest.raises(OutputInUse, match=r"dtm\.tif: another.*out-new\b"):
        deliver(source, target, progress=Opens(), **SMALL)
    # Nothing is half new. Of many files, the points are there, so the page is not.
    said = {"delivery.json", "index.html"}
    assert {key: data for key, data in content().items() if key not in said or is_one} == {
        key: data for key, data in before.items() if key not in said or is_one
    }
    kept = tmp_path / "out-new"
    assert files_of(kept) == before.keys() and (kept / "points").exists() == is_one
    assert json.loads((kept / "delivery.json").read_text())["is_finished"]
    windows.in_use.clear()
    deliver(source, target, resume=True, **SMALL)
    assert content().keys() == before.keys() and sorted(os.listdir(tmp_path)) == ["out", "out-new"]


def test_a_cancel_before_any_file_is_done_leaves_nothing_of_many(scene, tmp_path):
    with pytest.raises(Cancelled) as stopped:
        deliver(scene[2], tmp_path / "out", progress=CancelAt(0.02))
    assert not isinstance(stopped.value, FinishedFilesStay) and os.listdir(tmp_path) == []


@pytest.mark.rest
def test_a_file_that_cannot_be_read_is_named_on_the_page(scene, tmp_path):
    tiles = tmp_path / "tiles"
    shutil.copytree(scene[2], tiles)
    (tiles / "broken.laz").write_bytes(b"LASF")
    summary = deliver(tiles, tmp_path / "out", **SMALL)
    assert [os.path.basename(path) for path in summary.failures] == ["broken.laz"]
    assert "<li>broken.laz is left" in (tmp_path / "out" / "index.html").read_text("utf-8")


def test_an_error_names_the_folder_of_the_user(scene, tmp_path):
    # All points keep a class that is not decided anew, so that there is no ground.
    las = laspy.read(scene[1])
    las.classification[:] = 9
    las.write(str(tmp_path / "water.laz"))
    with pytest.raises(BareEarthError) as error:
        deliver(tmp_path / "water.laz", tmp_path / "out")
    assert ".~" not in str(error.value) and os.listdir(tmp_path) == ["water.laz"]


@pytest.mark.rest
def test_a_delivery_replaces_an_earlier_one_and_nothing_else(scene, tmp_path):
    target = tmp_path / "out"
    deliver(scene[1], target, **{**SMALL, "delivery": "flood"})
    (target / "notes.txt").write_text("mine")
    deliver(scene[1], target, **SMALL)
    expected = ALWAYS | FILES["drone-site"] | {"notes.txt"}
    assert files_of(target) == expected - {"accuracy.html"}


def test_what_cannot_be_delivered_is_said_before_any_work(scene, tmp_path):
    source = scene[1]
    with pytest.raises(BareEarthError, match=r"'x'.* survey, archaeology"):
        deliver(source, tmp_path / "out", delivery="x")
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "dtm.tif").write_text("mine")
    with pytest.raises(BareEarthError, match=r"other files, .*dtm\.tif"):
        deliver(source, tmp_path / "mine")
    with pytest.raises(BareEarthError, match="in the folder of the delivery"):
        deliver(source, source.parent)
    with pytest.raises(BareEarthError, match="is a file"):
        deliver(source, source)
    with pytest.raises(BareEarthError, match="no does not exist"):
        deliver(source, tmp_path / "no" / "where")
    assert (tmp_path / "mine" / "dtm.tif").read_text() == "mine"


def test_cells_follow_the_density_of_the_ground():
    sizes = [
        DELIVERIES["archaeology"].cell_size(number, "none") for number in (40, 5, 1, 0.1, 0.01)
    ]
    assert sizes == [0.25, 0.5, 1.0, 2.0, 5.0]
    assert DELIVERIES["drone-site"].cell_size(150.0, "none") == 0.1
    assert DELIVERIES["survey"].cell_size(0.1, "lbs-ql1") == 0.5
    assert DELIVERIES["forestry"].cell_size(None, "none") == 1.0


def test_the_command_delivers_and_prints_the_figures(scene, tmp_path, capsys):
    words = ["deliver", "drone-site", str(scene[1]), str(tmp_path / "out"), "--json"]
    assert main([*words, "--dtm-cell-size", "2", "--hold-out-share", "none", *FAST_WORDS]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["cell_size"] == 2.0 and told["check"] is None and told["quality"]["points"]
    reviewed = {"expected_error", "error_cause", "places"}
    assert set(told["layers"]) == {"dtm", "dsm", "hillshade", "contours", *reviewed}
    assert all(os.path.exists(path) for path in told["layers"].values())


@pytest.fixture
def toy(monkeypatch):
    yield toy_delivery.add_toy(monkeypatch)
    toy_delivery.forget()


def test_a_new_delivery_is_one_row(toy, scene, tmp_path, capsys):
    # It is in the command and its help, and in the function and its documentation.
    words = [toy_delivery.NAME, str(scene[1]), str(tmp_path / "out"), "--hold-out-share", "none"]
    assert main(["deliver", *words, *FAST_WORDS]) == 0
    expected = {"index.html", "delivery.json", "quality.html", "dtm.tif", "contours.gpkg"}
    assert files_of(tmp_path / "out") == expected
    assert 31 in classes_of(tmp_path / "out" / "points" / "whole.laz")
    assert f"<title>{toy.label}: whole.laz" in (tmp_path / "out" / "index.html").read_text("utf-8")
    capsys.readouterr()
    assert main(["deliver", "--help"]) == 0
    assert f"{toy_delivery.NAME}: {toy.about}" in " ".join(capsys.readouterr().out.split())
    assert f'"{toy_delivery.NAME}"' in bare_earth.deliver.__doc__
    summary = bare_earth.deliver(
        scene[1], tmp_path / "again", delivery=toy_delivery.NAME, hold_out_share=None, **FAST
    )
    assert summary.cell_size == 2.0 and set(summary.layers) == {"dtm", "contours"}


@pytest.mark.rest
def test_the_command_prints_what_matters(made, scene, tmp_path, capsys):
    summary, _ = made("survey")
    target = tmp_path / "out"
    assert main(["deliver", "survey", str(scene[1]), str(target)]) == 0
    first, *rows = capsys.readouterr().out.splitlines()
    assert first.startswith(f"{target}: {summary.ground_count:,} of {summary.point_count:,} points")
    told = {row[:15].rstrip(): row[16:] for row in rows}
    titles = [
        "classes", "water", "accuracy", "held out, all", "what it shows", "comparisons",
        "expected", "cell size", "page",
    ]  # fmt: skip
    assert re.search(r"expected RMSE of the terrain model is \d+\.\d\d m", told["expected"])
    assert list(told) == titles and told["accuracy"].startswith("not measured")
    counts = (f"{value}: {count:,}" for value, count in summary.class_counts.items())
    assert told["classes"] == ", ".join(counts) and told["cell size"] == "1 m"
    assert told["held out, all"] == summary.check.hold_out.all.text and told["water"]
    assert told["what it shows"] == summary.check.hold_out.limits()
    page = (target / "index.html").read_text(encoding="utf-8")
    assert "Accuracy of the terrain" in page and "What held-out points show" in page
    share = summary.quality.ground_void_share
    assert (f"{100 * share:.1f} % of the area is farther than 3 m" in page) == (share > 0)
    # The scene is sparse, and the specification asks for 2 points in a square metre.
    assert told["page"] == str(target / "index.html") and Path(told["page"]).exists()
    states = {item.name: item.state for item in summary.quality.comparison}
    passed = list(states.values()).count("pass")
    share, _, names = told["comparisons"].partition("; not: ")
    assert share == f"{passed} of {len(states)} pass" and states["Density"] == "fail"
    assert names == ", ".join(
        f"{name} ({state})" for name, state in states.items() if state != "pass"
    )


@pytest.mark.rest
def test_checkpoints_are_among_what_the_command_prints(scene, tmp_path, capsys):
    x, y = np.array([5.0, 60.0, 70.0]), np.array([5.0, 50.0, 85.0])
    rows = zip(x + EAST, y + NORTH, ground_at(x, y))
    table = "\n".join(["x,y,z", *(",".join(map(str, row)) for row in rows)])
    (tmp_path / "points.csv").write_text(table)
    words = ["--checkpoints", str(tmp_path / "points.csv"), "--hold-out-share", "none"]
    words += ["--accuracy-class", "0.1", *FAST_WORDS]
    assert main(["deliver", "drone-site", str(scene[1]), str(tmp_path / "out"), *words]) == 0
    rows = capsys.readouterr().out.splitlines()[1:]
    titles = [row[:11].rstrip() for row in rows]
    assert titles == [
        "classes", "checkpoints", "points NVA", "verdict", "expected", "cell size", "page"
    ]  # fmt: skip
    assert re.search(r"^checkpoints +3 of 3 are counted.* 30$", rows[1])
    assert re.search(r"RMSE 0\.\d{3} m, mean [+-]0\.\d{3} m, of 3 ", rows[2])
    assert "class of 0.1 m, by 3 of the 30" in rows[3]


@pytest.mark.rest
def test_many_files_with_heights_are_done_already_after_a_finished_delivery(made, scene, tmp_path):
    target, progress = tmp_path / "out", Heard()
    first, folder = made("forestry", is_one=False)
    shutil.copytree(folder, target)
    before = {path: path.stat().st_mtime_ns for path in (target / "points").glob("*.laz")}
    assert len(before) == 2
    for file in before:
        assert "HeightAboveGround" in laspy.read(file).point_format.dimension_names
    second = deliver(scene[2], target, delivery="forestry", resume=True, progress=progress)
    assert "2 files are done already." in progress.infos
    assert {file: file.stat().st_mtime_ns for file in before} == before
    assert second.class_counts == first.class_counts and {3, 5, 6} & first.class_counts.keys()
    assert second.ground_count == first.ground_count == first.class_counts[2]


@pytest.mark.rest
def test_records_of_many_files_are_not_among_the_points(scene, tmp_path):
    target, progress = tmp_path / "out", Heard()
    deliver(scene[2], target, **SMALL)
    handed = {"classified.vpc", "east.laz", "west.laz"}
    assert set(os.listdir(target / "points")) == handed
    assert set(os.listdir(target / ".bare-earth")) == {"east.laz.json", "west.laz.json"}
    files = json.loads((target / "delivery.json").read_text())["files"]
    assert {name for name in files if name.startswith("points/")} == {
        f"points/{key}" for key in handed
    }
    # A run that goes on finds them, also after one that was stopped; one file has none.
    with pytest.raises(FinishedFilesStay):
        deliver(scene[2], target, resume=True, progress=CancelAt(0.5), **SMALL)
    deliver(scene[2], target, resume=True, progress=progress, **SMALL)
    assert "2 files are done already." in progress.infos
    assert set(os.listdir(target / "points")) == handed and (target / ".bare-earth").is_dir()
    deliver(scene[1], target, **SMALL)
    assert os.listdir(target / "points") == ["whole.laz"]
    assert not (target / ".bare-earth").exists()


def square(west, south, east, north):
    corners = np.array([(west, south), (east, south), (east, north), (west, north)])
    return (np.add(corners, (EAST, NORTH)),)


def features(path):
    """Return the values of the fields, and the coordinates of each feature."""
    known, _, _, columns = pytest.importorskip("pyogrio").raw.read(path)
    rows = [dict(zip(known["fields"].tolist(), row)) for row in zip(*columns)]
    assert known["crs"] == "EPSG:25832"
    is_water = Path(path).stem == "water"
    shapes = [polygon[0] for polygon in read_boundary(path)] if is_water else read_lines(path)
    assert len(rows) == len(shapes)
    return list(zip(rows, shapes))


def line(*corners):
    return np.add(corners, (EAST, NORTH, 0.0))


@pytest.mark.rest
@pytest.mark.parametrize("is_one", quick([True, False], False))
def test_water_and_lines_of_the_user_are_delivered_with_their_heights(scene, tmp_path, is_one):
    # A lake, a river across both files, water without ground near it; a dyke, and an edge.
    lake, river = square(96.0, 25.0, 136.0, 65.0), square(60.0, 3.0, 90.0, 9.0)
    along_river = line((91.0, 6.0, np.nan), (58.0, 6.0, np.nan))
    dyke = line((5.0, 45.0, 107.0), (12.0, 45.0, 107.5))
    edge = line((55.0, 50.0, np.nan), (75.0, 50.0, np.nan))
    water = lake, river, square(400.0, 0.0, 410.0, 10.0)
    how = {**QUICK, "delivery": "flood", "dtm_cell_size": 1.0}
    summary = deliver(
        scene[1 if is_one else 2], tmp_path / "out", water=water, rivers=(along_river,),
        breaklines=(dyke, edge), **how,
    )  # fmt: skip
    assert {"water", "breaklines"} <= summary.layers.keys()
    polygons = features(summary.layers["water"])
    assert [row["KIND"] for row, _ in polygons] == ["lake", "river", "lake"]
    assert {row["GRADE"] for row, _ in polygons} == {"given"}
    assert [row["AREA"] for row, _ in polygons] == [1600.0, 180.0, 100.0]
    assert np.isnan([polygons[2][0]["LEVEL"], polygons[0][0]["SPREAD"]]).all()
    for (_, ring), given in zip(polygons, water):
        assert np.allclose(ring[:4], given[0])
    lines = features(summary.layers["breaklines"])
    names = [(row["ID"], row["KIND"]) for row, _ in lines]
    assert names == [
        (1, "shore"), (2, "shore"), (2, "river"),
        (1, "breakline"), (2, "breakline"), (2, "breakline"),
    ]  # fmt: skip
    # Their heights are those of the terrain model; the level of a lake is one.
    level = polygons[0][0]["LEVEL"]
    dtm = heights_of(tmp_path / "out" / "dtm.tif")
    rows, columns = np.floor((DEPTH - 45.0, 116.0)).astype(int)
    assert dtm[rows, columns] == pytest.approx(level, abs=0.002)
    assert np.allclose(lines[0][1][:, 2], level, atol=0.001)
    x, y, z = (lines[2][1] - (EAST, NORTH, 0.0)).T
    assert (np.diff(z) <= 0).all() and polygons[1][0]["LEVEL"] >= polygons[1][0]["LEVEL_LOW"]
    inside = (x > 62.0) & (x < 88.0)
    rows, columns = (DEPTH - y[inside]).astype(int), x[inside].astype(int)
    assert np.allclose(dtm[rows, columns], z[inside], atol=0.02) and inside.sum() >= 4
    assert np.allclose(lines[3][1], dyke)
    for _, places in lines[4:]:
        assert len(places) == 5 and np.allclose(places[:, 2], 104.0, atol=0.15)
    files = files_of(tmp_path / "out")
    assert {"water.gpkg", "breaklines.gpkg"} <= files
    page = (tmp_path / "out" / "index.html").read_text("utf-8")
    assert 'href="water.gpkg"' in page and 'href="breaklines.gpkg"' in page
    if not is_one:
        return
    known = tmp_path / "out"
    found = compare(
        *(known / f"{name}.gpkg" for name in ("water", "breaklines")), known / "dtm.tif"
    )
    for number in (1, 2):
        assert found[number].missing == 0
        assert max(found[number].level, found[number].lines) < 0.01
    # The polygons can be used again.
    again = read_boundary(summary.layers["water"])[:2]
    second = deliver(scene[1], tmp_path / "again", water=again, **how)
    (row, _), *_ = features(second.layers["water"])
    assert row["LEVEL"] == pytest.approx(level, abs=0.02)


@pytest.mark.rest
def test_breaklines_of_the_user_are_delivered_beside_water_that_was_found(scene, tmp_path):
    dyke = line((5.0, 45.0, 107.0), (12.0, 45.0, 107.5))
    how = {"hold_out_share": None, "method": "slope", "breaklines": (dyke,)}
    summary = deliver(scene[1], tmp_path / "out", delivery="flood", **how)
    (row, _), *others = features(summary.layers["water"])
    assert row["GRADE"] != "given" and not others
    kinds = [row["KIND"] for row, _ in features(summary.layers["breaklines"])]
    assert kinds == ["shore", "breakline"]
    # Where no water is wanted, the lines are delivered all the same.
    summary = deliver(scene[1], tmp_path / "site", delivery="drone-site", **how)
    assert "water" not in summary.layers and len(features(summary.layers["breaklines"])) == 1


def test_sizes_of_water_that_are_given_count_and_others_are_those_of_the_delivery():
    def wanted(name, **values):
        return set_of(Water, name, "none", DeliveryWater(**values))

    assert wanted("survey") == Water(min_area=8000.0, min_width=30.0)
    assert wanted("flood") == Water(min_area=1000.0, min_width=5.0)
    # Also a size that is usual elsewhere.
    given = {"min_area": 8000.0, "water_cell": 2.0}
    assert wanted("flood", **given) == Water(min_width=5.0, **given)
