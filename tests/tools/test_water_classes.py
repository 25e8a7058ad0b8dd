"""Classes of ground points in water and beside its shore, of one file and of many."""

import json

import laspy
import numpy as np
import pytest
from realdata import real
from runs import CancelAt, Heard, said
from scipy.spatial import cKDTree
from surveys import classes_of, write_points
from water_scenes import lake, lake_scene

import bare_earth
from bare_earth import BareEarthError, Cancelled
from bare_earth.algorithms.grids.lines import along, near_rings

pyproj = pytest.importorskip("pyproj")
EAST, NORTH, SIDE, DISTANCE = 500_000.0, 5_700_000.0, 80.0, 0.7
UTM, FEET, US_FOOT = 25832, 2230, 1200 / 3937
# Half the sides in metres of a lake that is turned by 30 degrees, and of the island in it.
LAKE, ISLAND, TURNED = (25.0, 15.0), (6.0, 4.0), np.radians(30.0)


def in_lake_frame(x, y):
    """Return the distance of places from both axes of the lake, in metres."""
    east, north = x - SIDE / 2, y - SIDE / 2
    along = east * np.cos(TURNED) + north * np.sin(TURNED)
    return np.abs(along), np.abs(north * np.cos(TURNED) - east * np.sin(TURNED))


def ring(half):
    """Return the corners of a rectangle in metres."""
    u, v = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]).T * np.reshape(half, (2, 1))
    x = u * np.cos(TURNED) - v * np.sin(TURNED)
    return np.column_stack((x, u * np.sin(TURNED) + v * np.cos(TURNED))) + SIDE / 2


def truth(x, y, distance=DISTANCE):
    """Return which places in metres are water, and which are land within a distance of it."""
    u, v = in_lake_frame(x, y)
    beyond = np.hypot(np.maximum(u - LAKE[0], 0), np.maximum(v - LAKE[1], 0))
    depth = np.minimum(ISLAND[0] - u, ISLAND[1] - v)  # on the island: metres from its shore
    water = (beyond == 0) & (depth < 0)
    return water, ~water & np.where(depth >= 0, depth <= distance, beyond <= distance)


def polygons(unit=1.0, origin=(EAST, NORTH)):
    return ((ring(LAKE) / unit + origin, ring(ISLAND) / unit + origin),)


def write(path, count=12_000, epsg=UTM, unit=1.0, west=0.0, east=SIDE, seed=1, classes=None):
    """Write points on land that slopes by 10 %: mostly ground, and some of every other class."""
    random = np.random.default_rng(seed)
    x, y = random.uniform(west, east, count), random.uniform(0, SIDE, count)
    if classes is None:
        classes = np.where(random.random(count) < 0.7, 2, random.choice(256, count))
    return write_points(
        path, x / unit, y / unit, (100.0 + 0.1 * x) / unit, classes,
        offset=(EAST, NORTH, 0.0), crs=epsg, withheld=random.random(count) < 0.05,
    )  # fmt: skip


def metres(las, unit=1.0):
    return (np.asarray(las.x) - EAST) * unit, (np.asarray(las.y) - NORTH) * unit


def geojson(path, crs=UTM):
    """Write the lake as a file, which states no CRS."""
    to = pyproj.Transformer.from_crs(UTM, crs, always_xy=True)
    rings = [np.column_stack(to.transform(*corners[[*range(4), 0]].T)) for corners in polygons()[0]]
    shape = {"type": "Polygon", "coordinates": [corners.tolist() for corners in rings]}
    path.write_text(json.dumps(shape), encoding="utf-8")
    return path


def classify(source, target, water=None, **options):
    water = polygons() if water is None else water
    return bare_earth.water_classes(source, target, water=water, **options)


@pytest.mark.rest
@pytest.mark.parametrize(("epsg", "unit"), [(UTM, 1.0), (FEET, US_FOOT)])
@pytest.mark.parametrize("distance", [DISTANCE, 3.0, 0.0])
def test_each_ground_point_gets_the_class_of_its_place(tmp_path, epsg, unit, distance):
    source = write(tmp_path / "in.laz", epsg=epsg, unit=unit)
    summary = classify(source, tmp_path / "out.laz", polygons(unit), shore_distance=distance)
    before, after = laspy.read(source), laspy.read(tmp_path / "out.laz")
    old, new = np.asarray(before.classification), np.asarray(after.classification)
    water, beside = truth(*metres(before, unit), distance)
    ground = (old == 2) & ~np.asarray(before.withheld, dtype=bool)
    beside &= distance > 0
    assert water[ground].sum() > 1000 and (beside[ground].sum() > 100) == (distance > 0)
    expected = np.where(ground & water, 9, np.where(ground & beside, 20, old))
    assert np.array_equal(new, expected)
    assert summary.water_count == (ground & water).sum()
    assert summary.ignored_count == (ground & beside).sum()
    assert summary.class_counts == dict(zip(*np.unique(new, return_counts=True)))
    after.classification = before.classification
    assert np.array_equal(after.points.array, before.points.array)


def test_other_classes_are_given_if_the_user_asks(tmp_path):
    source, target = write(tmp_path / "in.las"), tmp_path / "out.las"
    classify(
        source, target, shore_distance=2.0, water_class=41, ignored_class=45, ground_classes=(2, 20)
    )
    before = laspy.read(source)
    is_water, is_beside = truth(*metres(before), 2.0)
    old = np.asarray(before.classification)
    was = np.isin(old, (2, 20)) & ~np.asarray(before.withheld, dtype=bool)
    assert (was & (old == 20) & is_water).any()
    expected = np.where(was & is_water, 41, np.where(was & is_beside, 45, old))
    assert np.array_equal(classes_of(target), expected)


def test_a_second_run_changes_nothing(tmp_path):
    source = write(tmp_path / "in.las")
    classify(source, tmp_path / "once.las")
    again = classify(tmp_path / "once.las", tmp_path / "twice.las")
    assert (tmp_path / "twice.las").read_bytes() == (tmp_path / "once.las").read_bytes()
    assert again.water_count == again.ignored_count == 0


def test_points_on_disk_get_the_same_classes(tmp_path):
    source, progress = write(tmp_path / "in.laz", 30_000), Heard()
    classify(source, tmp_path / "memory.laz")
    classify(source, tmp_path / "disk.laz", memory=0.001, progress=progress)
    assert any("wait in a temporary file" in text for text in progress.infos)
    assert (tmp_path / "disk.laz").read_bytes() == (tmp_path / "memory.laz").read_bytes()


@pytest.mark.rest
def test_many_files_have_no_seams_and_go_on(tmp_path):
    (tmp_path / "in").mkdir()
    names = "a", "b", "c"
    for number, name in enumerate(names):
        west = SIDE / 3 * number
        write(tmp_path / "in" / f"{name}.laz", 4000, west=west, east=west + SIDE / 3, seed=number)
    water = geojson(tmp_path / "water.geojson")
    words = "water-classes", tmp_path / "in", tmp_path / "out", "--water", water
    done = json.loads(said(*words, "--json")[1])
    assert done["done_count"] == 3 and done["kept_count"] == 0
    for name in names:
        source, alone = tmp_path / "in" / f"{name}.laz", tmp_path / f"{name}.laz"
        classify(source, alone)
        assert (tmp_path / "out" / f"{name}.laz").read_bytes() == alone.read_bytes()
        assert (classes_of(alone) == 9).sum() > 300
    assert json.loads(said(*words, "--json", "--resume")[1])["kept_count"] == 3
    told = json.loads(said(*words, "--json", "--resume", "--shore-distance", "2")[1])
    assert told["kept_count"] == 0


@pytest.mark.rest
def test_the_water_can_be_found_first(tmp_path):
    scene = lake_scene("sparse")
    scene.classes[scene.classes == 1] = 2  # a filter took the stray returns for ground
    place = 0.0, 0.0, 0.0
    write_points(tmp_path / "in.las", scene.x, scene.y, scene.z, scene.classes, offset=place)
    words = tmp_path / "in.las", tmp_path / "out.las", "--water", "automatic"
    code, told, _ = said("water-classes", *words, "--crs", "EPSG:25832", "--json")
    assert code == 0 and json.loads(told)["water_count"] > 0
    is_water, away = classes_of(tmp_path / "out.las") == 9, lake(scene.x, scene.y)
    assert is_water[away < -3.0].mean() > 0.99 and not is_water[away > 3.0].any()
    assert (classes_of(tmp_path / "out.las") == 20).any()


def test_polygons_can_be_in_another_crs(tmp_path):
    source = write(tmp_path / "in.las")
    classify(source, tmp_path / "moved.las", geojson(tmp_path / "lake.geojson", 4326))
    classify(source, tmp_path / "out.las")
    assert np.array_equal(classes_of(tmp_path / "moved.las"), classes_of(tmp_path / "out.las"))


def test_remembered_classes_follow(tmp_path):
    source, ground, target = (tmp_path / f"{name}.las" for name in ("in", "ground", "out"))
    write(source, classes=1)
    bare_earth.classify(source, ground, remember_classes=True)
    classify(ground, target)
    las = laspy.read(target)
    assert (np.asarray(las.classification) == 9).sum() > 1000
    # So that the next run does not take them for changes by hand.
    assert np.array_equal(las["BareEarthClass"], las.classification)


def test_without_polygons_nothing_changes_and_the_user_is_told(tmp_path):
    source, progress = write(tmp_path / "in.las"), Heard()
    classify(source, tmp_path / "out.las", (), progress=progress)
    assert (tmp_path / "out.las").read_bytes() == source.read_bytes()
    (warning,) = progress.warnings
    assert "no polygon of water" in warning


def test_what_cannot_be_done_is_a_sentence(tmp_path):
    source, target = write(tmp_path / "in.las"), tmp_path / "out.las"
    with pytest.raises(BareEarthError, match=r"polygons of water .*CRS"):
        classify(source, target, polygons(origin=(0.0, 0.0)))
    with pytest.raises(BareEarthError, match=r"no ground .*class 90\b"):
        classify(write(tmp_path / "no.las", classes=1), target, ground_classes=(90,))
    with pytest.raises(BareEarthError, match="not a finite number"):
        classify(source, target, ((np.full((4, 2), np.nan),),))
    old = laspy.LasData(laspy.LasHeader(point_format=1, version="1.2"))
    old.x, old.y, old.z, old.classification = [EAST], [NORTH], [0.0], [2]
    old.write(str(tmp_path / "old.las"))
    with pytest.raises(BareEarthError, match=r"31, not 45.* ignored ground"):
        classify(tmp_path / "old.las", target, (), ignored_class=45)
    with pytest.raises(Cancelled):
        classify(source, target, progress=CancelAt(0.5))
    (tmp_path / "empty.geojson").write_text('{"type": "FeatureCollection", "features": []}')
    code, _, told = said("water-classes", source, target, "--water", tmp_path / "empty.geojson")
    assert code == 1 and "no polygon" in told
    assert said("water-classes", source, target)[0] == 2
    nowhere = tmp_path / "no" / "out.las"
    code, _, told = said("water-classes", source, nowhere, "--water", "automatic")
    assert code == 1 and "no does not exist" in told and "Water:" not in told
    assert not target.exists()


@pytest.mark.parametrize(
    ("name", "least"),
    [
        ("corse_cliff", 0.85),
        pytest.param("wires_single_return", 0.85, marks=pytest.mark.long),
    ],
)
def test_water_of_real_tiles_gets_its_class_back(tmp_path, name, least):
    source, ground, target = real(f"real/{name}.laz"), tmp_path / "ground.laz", tmp_path / "out.laz"
    bare_earth.water(source, tmp_path / "water.geojson", min_area=500.0)
    las = laspy.read(source)
    water = np.asarray(las.classification) == 9
    las.classification[water] = 2
    las.write(str(ground))
    classify(ground, target, tmp_path / "water.geojson")
    assert (classes_of(target)[water] == 9).mean() > least


def test_distances_from_any_ring_are_those_of_a_dense_ring():
    random = np.random.default_rng(4)
    corners = random.uniform(0, 50, (40, 2))
    corners[7] = corners[6]  # an edge without length
    x, y = random.uniform(-5, 55, (2, 3000))
    dense = along(np.column_stack((corners, np.zeros(40))), 0.002, is_closed=True)[:, :2]
    far = cKDTree(dense).query(np.column_stack((x, y)))[0]
    near = near_rings(x, y, [corners[:0], corners], 0.7)
    sure = np.abs(far - 0.7) > 1e-5
    assert sure.sum() > 2900 and 500 < near.sum() < 2500
    assert np.array_equal(near[sure], far[sure] <= 0.7)
    assert near_rings(x[:0], y[:0], [corners], 0.7).size == 0
    # Places in an order of their own, and only some of them, get the same.
    some = random.permutation(3000)[:100]
    assert np.array_equal(near_rings(x[some], y[some], [corners], 0.7), near[some])
