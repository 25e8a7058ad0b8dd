"""Classes above the ground: vegetation by height, buildings, bridges; one file and many."""

import json
import re

import laspy
import numpy as np
import pytest
from runs import Heard, said
from surveys import ORIGIN, classes_of, points_of, write_points

from bare_earth import BareEarthError, above_ground, classify
from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.core.threads import may_use
from bare_earth.algorithms.engine.blocks import Blocks
from bare_earth.algorithms.tools.above_ground import ClassifyAboveGround
from bare_earth.algorithms.tools.above_ground.buildings import Buildings, planes_through
from bare_earth.algorithms.tools.above_ground.classes import AboveGround, classes_above_ground
from benchmarks import scenes
from benchmarks.scenes.simple import scatter


@pytest.fixture(scope="module")
def village():
    return scenes.make("village", 0, size=80.0)


# Classes above the ground by the limits of IGN, and in the run that finds the ground.
IGN = {"above_ground": "ign"}
RUN = {**IGN, "method": "slope"}


def _iou(found, true):
    return np.count_nonzero(found & true) / np.count_nonzero(found | true)


def _write(path, scene, classes, which=slice(None)):
    points = scene.points
    return write_points(
        path, points.x[which], points.y[which], points.z[which], classes[which],
        return_number=scene.return_number[which],
        number_of_returns=scene.number_of_returns[which],
    )  # fmt: skip


def _only_ground(scene):
    """Return classes of which only the ground is known."""
    return np.where(scene.classes == 2, 2, 1).astype(np.uint8)


@pytest.fixture(scope="module")
def file(village, tmp_path_factory):
    path = tmp_path_factory.mktemp("village") / "village.laz"
    return _write(path, village, _only_ground(village))


@pytest.fixture(scope="module")
def finished(file):
    """Return the file with its classes above the known ground."""
    above_ground(file, path := file.with_name("finished.laz"))
    return path


@pytest.fixture(scope="module")
def classified(file):
    """Return the file after the run that finds the ground and what is above, and its summary."""
    path = file.with_name("classified.laz")
    return path, classify(file, path, **RUN)


# Roofs


def _town(*parts, size=60.0, density=8.0, seed=1):
    """Return points on flat ground and on roofs, given as functions: heights, NaN beside them."""
    x, y = scatter(size, density, seed=seed)
    random = np.random.default_rng(seed)
    high = np.zeros(len(x))
    for part in parts:
        found = part(x, y)
        high = np.where(np.isnan(found), high, found)
    points = Points(x, y, 50.0 + high + random.normal(0.0, 0.02, len(x)))
    return points, high


def _roof(west, south, width, depth, height, pitch=0.0):
    def heights(x, y):
        inside = (x >= west) & (x < west + width) & (y >= south) & (y < south + depth)
        across = np.abs(y - south - depth / 2.0)
        return np.where(inside, height + pitch * (depth / 2.0 - across), np.nan)

    return heights


def _found(points, high, rule=Buildings(), several=None):
    several = np.zeros(points.count, dtype=bool) if several is None else several
    return rule.find(points, high, high > 0.0, several)


@pytest.mark.parametrize("pitch", [0.0, 0.3, 1.0])
@pytest.mark.parametrize("has_returns", [True, False])
def test_flat_and_gable_roofs_are_buildings(pitch, has_returns):
    points, high = _town(_roof(10, 10, 12, 8, 4.0, pitch), _roof(35, 30, 9, 15, 6.0, pitch))
    several = has_returns & (high == 0.0) & (points.x < 3.0)
    found = _found(points, high, several=several)
    assert _iou(found, high > 0.0) > 0.99


def test_what_is_low_small_or_narrow_is_no_building():
    shed, cars, wall = (
        _roof(10, 10, 2.5, 2.5, 2.5), _roof(20, 20, 12, 12, 1.6), _roof(5, 40, 40, 1.0, 3.0),
    )  # fmt: skip
    points, high = _town(shed, cars, wall, density=16.0)
    assert not _found(points, high).any()
    # With other limits the first two are.
    loose = _found(points, high, Buildings(height=1.5, area=4.0))
    assert np.array_equal(np.unique(high[loose]), [1.6, 2.5])


def test_leaves_are_no_building_though_some_lie_on_a_plane():
    points, high = _town(density=12.0)
    random = np.random.default_rng(3)
    crown = points.x > 20.0
    high[crown] = 12.0 + random.uniform(-3.0, 0.0, crown.sum())
    points = Points(points.x, points.y, 50.0 + high)
    several = crown & (random.random(points.count) < 0.6)
    assert not _found(points, high, several=several).any()


def test_chimneys_and_walls_belong_to_their_roof():
    house = _roof(10, 10, 12, 8, 5.0)
    points, high = _town(house, _roof(15, 13, 1.0, 1.0, 6.5), density=12.0)
    x = np.linspace(10.2, 21.8, 60)
    wall = Points(x, np.full(60, 9.9), np.linspace(51.0, 54.5, 60))
    both = points.and_also(wall)
    high = np.concatenate((high, wall.z - 50.0))
    found = _found(both, high)
    assert found[high > 0.5].mean() > 0.99


def test_each_plane_of_a_ridge_is_found():
    x, y = scatter(20.0, 6.0)
    places = np.column_stack([x, y, 0.5 * np.abs(x - 10.0)])
    from scipy.spatial import cKDTree

    _, neighbours = cKDTree(places[:, :2]).query(places[:, :2], k=13)
    near = np.ones(neighbours.shape, dtype=bool)
    wanted = (np.abs(x - 10.0) > 0.4) & (np.abs(x - 10.0) < 1.0)
    rise, on = planes_through(places, neighbours, near, wanted, 0.02, 65.0)
    slopes = np.abs(rise[wanted, 0])
    assert np.mean(np.abs(slopes - 0.5) < 0.05) > 0.95
    assert not on[~wanted].any()


def test_scattered_points_and_steep_planes_have_none():
    x, y = scatter(20.0, 4.0)
    places = np.column_stack([x, y, 4.0 * x])
    from scipy.spatial import cKDTree

    _, neighbours = cKDTree(places[:, :2]).query(places[:, :2], k=13)
    near = np.ones(neighbours.shape, dtype=bool)
    _, on = planes_through(places, neighbours, near, near[:, 0], 0.1, 65.0)
    assert not on.any()


# Scenes


@pytest.mark.rest
@pytest.mark.parametrize(
    ("kind", "size", "least"),
    [
        pytest.param("village", 120.0, 0.94, marks=pytest.mark.long),
        ("hillside_village", 90.0, 0.93),
        pytest.param("city_blocks", 90.0, 0.97, marks=pytest.mark.long),
        ("car_park", 90.0, 0.98),
    ],
)
def test_buildings_of_scenes_are_found(kind, size, least):
    scene = scenes.make(kind, 0, size=size)
    several = scene.number_of_returns > 1
    classes = classes_above_ground(scene.points, scene.ground, several)
    assert _iou(classes == 6, scene.classes == 6) >= least
    assert np.array_equal(classes == 2, scene.ground)


@pytest.mark.rest
def test_a_forest_has_no_buildings():
    scene = scenes.make("steep_forest", 0, size=60.0)
    for several in (scene.number_of_returns > 1, np.zeros(scene.points.count, dtype=bool)):
        classes = classes_above_ground(scene.points, scene.ground, several)
        assert np.count_nonzero(classes == 6) < 1e-3 * np.count_nonzero(classes == 5)


@pytest.mark.rest
def test_bridges_and_birds_have_classes_of_their_own():
    scene = scenes.make("bridge_over_road", 0, size=110.0)
    several = scene.number_of_returns > 1
    classes = classes_above_ground(scene.points, scene.ground, several)
    assert _iou(classes == 17, scene.classes == 17) > 0.75
    birds = scenes.make("birds", 0, size=90.0)
    several = birds.number_of_returns > 1
    classes = classes_above_ground(birds.points, birds.ground, several)
    assert np.mean(classes[birds.classes == 18] == 18) > 0.9
    without = AboveGround(mark_high_noise=False, mark_bridges=False, buildings=False)
    plain = classes_above_ground(birds.points, birds.ground, several, without)
    assert set(np.unique(plain)) <= {1, 2, 3, 4, 5}


# Heights


@pytest.mark.parametrize(
    "parameters, limits",
    [
        (AboveGround(), (0.0, 0.5, 2.0)),
        (AboveGround("ign"), (0.0, 0.5, 1.5)),
        (AboveGround("own", 1.0, 5.0, 0.2), (0.2, 1.0, 5.0)),
    ],
)
def test_vegetation_is_divided_by_height(parameters, limits):
    x, y = scatter(40.0, 4.0)
    high = np.random.default_rng(4).uniform(0.0, 8.0, len(x))
    high[::2] = 0.0
    high[1::20], high[3::20], high[5::20] = limits
    ground = np.arange(len(x)) % 2 == 0
    points = Points(x, y, 20.0 + 0.1 * x + high)
    found = classes_above_ground(points, ground, ~ground, parameters)
    expected = np.searchsorted(limits, high, side="right")
    expected = np.array([1, 3, 4, 5])[expected]
    expected[ground] = 2
    sure = np.abs(high[:, None] - np.array(limits)).min(axis=1) > 0.05
    inner = (x > 2) & (x < 38) & (y > 2) & (y < 38)
    assert np.array_equal(found[sure & inner], expected[sure & inner])
    exact = ~sure & inner & np.isin(high, limits) & ~ground
    assert np.mean(found[exact] == expected[exact]) > 0.4


def test_limits_must_not_decrease():
    with pytest.raises(BareEarthError, match="do not decrease"):
        AboveGround("own", 3.0, 2.0)
    with pytest.raises(BareEarthError, match="do not decrease"):
        AboveGround(low_height=1.0)


# Files


@pytest.mark.rest
def test_the_order_of_the_points_and_threads_do_not_matter(village):
    points, ground = village.points, village.ground
    several = village.number_of_returns > 1
    found = classes_above_ground(points, ground, several)
    mixed = np.random.default_rng(2).permutation(points.count)
    again = classes_above_ground(points.take(mixed), ground[mixed], several[mixed])
    assert np.array_equal(again, found[mixed])
    with may_use(3):
        assert np.array_equal(classes_above_ground(points, ground, several), found)


@pytest.mark.rest
def test_one_file(file, village, tmp_path):
    out = tmp_path / "out.laz"
    summary = above_ground(file, out)
    classes = classes_of(out)
    assert _iou(classes == 6, village.classes == 6) > 0.94
    assert summary.point_count == len(classes) and summary.ground_count == village.ground.sum()
    assert summary.class_counts == dict(zip(*np.unique(classes, return_counts=True)))
    assert re.search(f"{summary.class_counts[6]:,} .*buildings", summary.text)
    # Nothing else changes.
    before, after = laspy.read(file), laspy.read(out)
    for name in before.point_format.dimension_names:
        if name != "classification":
            assert np.array_equal(before[name], after[name])
    # All that can get a class has one now, so that a second run changes nothing.
    again = above_ground(out, tmp_path / "again.laz")
    changed = np.flatnonzero(classes_of(tmp_path / "again.laz") != classes)
    assert again.changed_count == len(changed) and len(changed) < 1e-3 * len(classes)


@pytest.mark.rest
def test_the_files_of_a_survey_do_not_matter(finished, village, tmp_path):
    points, folder = village.points, tmp_path / "in"
    folder.mkdir()
    random = np.random.default_rng(5)
    west = np.median(points.x) + 3.0 * np.sin(points.y / 7.0) < points.x
    number = 2 * west + (points.y > np.quantile(points.y, 0.37))
    for file in range(4):
        which = random.permutation(np.flatnonzero(number == file))
        _write(folder / f"{file}.laz", village, _only_ground(village), which)
    summary = above_ground([folder], tmp_path / "out")
    assert summary.done_count == 4 and summary.class_counts[6] > 1000
    made = sorted((tmp_path / "out").glob("*.laz"))
    assert np.array_equal(points_of(made), points_of([finished]))
    # Finished files are kept.
    assert above_ground([folder], tmp_path / "out", resume=True).kept_count == 4
    assert above_ground([folder], tmp_path / "out", resume=True, **IGN).kept_count == 0


@pytest.mark.rest
def test_there_are_no_seams_between_blocks(file, finished, tmp_path, monkeypatch):
    monkeypatch.setattr(ClassifyAboveGround, "blocks", Blocks(45.0, 60.0, start=-0.00005))
    above_ground(file, tmp_path / "blocks.laz")
    one, blocks = classes_of(finished), classes_of(tmp_path / "blocks.laz")
    assert np.mean(one != blocks) < 1e-4


def test_points_on_disk_get_the_same_classes(file, finished, tmp_path):
    progress = Heard()
    above_ground(file, tmp_path / "disk.laz", threads=1, memory=0.001, progress=progress)
    assert any("wait in a temporary file" in text for text in progress.infos)
    assert np.array_equal(classes_of(finished), classes_of(tmp_path / "disk.laz"))


@pytest.mark.rest
def test_classes_with_a_meaning_stay(village, tmp_path):
    classes = village.classes.copy()
    classes[village.classes == 6] = 1
    water = np.flatnonzero(classes == 1)[::7]
    classes[water] = 9
    source = _write(tmp_path / "in.laz", village, classes)
    above_ground(source, tmp_path / "kept.laz")
    found = classes_of(tmp_path / "kept.laz")
    assert np.array_equal(found[classes > 1], classes[classes > 1])
    above_ground(source, tmp_path / "anew.laz", reclassify=True)
    anew = classes_of(tmp_path / "anew.laz")
    fixed = np.isin(classes, (2, 7, 9))
    assert np.array_equal(anew[fixed], classes[fixed])
    assert np.any(anew[~fixed] != classes[~fixed])


def test_only_points_of_the_area_change(file, finished, village, tmp_path):
    x, y = village.points.x + ORIGIN[0], village.points.y + ORIGIN[1]
    west, south, east, north = (*map(np.median, (x, y)), x.max(), y.max())
    above_ground(file, tmp_path / "out.laz", extent=(west, south, east, north))
    before, after, whole = map(classes_of, (file, tmp_path / "out.laz", finished))
    inside = (x >= west) & (y >= south)
    assert np.array_equal(after[inside], whole[inside])
    assert np.array_equal(after[~inside], before[~inside])


@pytest.mark.rest
def test_a_class_that_was_set_by_hand_stays(file, tmp_path):
    marked = tmp_path / "marked.laz"
    classify(file, marked, remember_classes=True)
    las = laspy.read(marked)
    mine = np.flatnonzero(np.asarray(las.classification) == 2)[::50]
    las.classification[mine] = 1
    las.write(str(marked))
    above_ground(marked, tmp_path / "out.laz")
    found = classes_of(tmp_path / "out.laz")
    assert set(found[mine]) == {1} and set(np.unique(found)) > {2, 5, 6}


def test_a_file_without_ground_is_refused(village, tmp_path):
    source = _write(tmp_path / "in.laz", village, np.ones(village.points.count, np.uint8))
    with pytest.raises(BareEarthError, match="no ground points"):
        above_ground(source, tmp_path / "out.laz")
    assert not (tmp_path / "out.laz").exists()


def test_a_file_with_nothing_to_change_is_told(village, tmp_path):
    classes = np.where(village.ground, 2, 6).astype(np.uint8)
    source, progress = _write(tmp_path / "in.laz", village, classes), Heard()
    assert above_ground(source, tmp_path / "out.laz", progress=progress).changed_count == 0
    assert any("decided anew" in text for text in progress.warnings)


def test_the_command(file, tmp_path):
    out = tmp_path / "out.laz"
    code, text, errors = said("above-ground", file, out, "--above-ground", "ign", "--verbose")
    assert code == 0, errors
    assert "are buildings and" in text
    above_ground(file, tmp_path / "same.laz", **IGN)
    assert np.array_equal(classes_of(out), classes_of(tmp_path / "same.laz"))
    code, _, errors = said(
        "above-ground", file, out, "--above-ground", "own", "--medium-height", 3, "--high-height", 1
    )
    assert code == 2 and "do not decrease" in errors


# In the run that finds the ground


def test_one_run_finds_the_ground_and_what_is_above(file, classified, village, tmp_path):
    (one, summary), ground, two = classified, tmp_path / "ground.laz", tmp_path / "two.laz"
    classify(file, ground, method="slope")
    above_ground(ground, two, **IGN)
    assert np.array_equal(classes_of(one), classes_of(two))
    assert summary.class_counts == dict(zip(*np.unique(classes_of(one), return_counts=True)))
    assert _iou(classes_of(one) == 6, village.classes == 6) > 0.93


@pytest.mark.rest
def test_one_run_on_many_files_also_makes_heights_and_goes_on(file, village, tmp_path):
    how = {**RUN, "height_above_ground": True}
    classify(file, tmp_path / "one.laz", **how)
    x, folder, out = village.points.x, tmp_path / "in", tmp_path / "out"
    folder.mkdir()
    # So far apart that the first file does not affect the last one.
    cuts = np.quantile(x, (0.2, 0.8))
    for number in range(3):
        which = np.flatnonzero(np.searchsorted(cuts, x) == number)
        _write(folder / f"{number}.laz", village, _only_ground(village), which)
    summary = classify([folder], out, **how)
    made = sorted(out.glob("*.laz"))
    assert summary.done_count == 3 and len(made) == 3 and not list(tmp_path.glob("out/.*/waiting*"))

    def all_of(paths):
        clouds = [laspy.read(path) for path in paths]
        names = "X", "Y", "Z", "classification", "HeightAboveGround"
        columns = [np.concatenate([np.asarray(las[name]) for las in clouds]) for name in names]
        return np.column_stack(columns)[np.lexsort(columns)]

    np.testing.assert_array_equal(all_of(made), all_of([tmp_path / "one.laz"]))
    assert classify([folder], out, resume=True, **how).kept_count == 3
    before = [path.read_bytes() for path in made]
    made[0].unlink()
    assert classify([folder], out, resume=True, **how).kept_count == 2
    assert [path.read_bytes() for path in made] == before


@pytest.mark.rest
def test_one_run_also_makes_heights_and_rasters(file, classified, tmp_path):
    dtm, out = tmp_path / "dtm.tif", tmp_path / "all.laz"
    classify(file, out, height_above_ground=True, dtm=dtm, **RUN)
    assert np.array_equal(classes_of(tmp_path / "all.laz"), classes_of(classified[0]))
    las = laspy.read(tmp_path / "all.laz")
    high = np.asarray(las["HeightAboveGround"])
    for value, low, most in ((3, 0.0, 0.5), (4, 0.5, 1.5), (5, 1.5, np.inf)):
        of_class = high[np.asarray(las.classification) == value]
        assert of_class.min() >= low - 1e-4 and of_class.max() <= most + 1e-4
    assert (tmp_path / "dtm.tif").exists()


@pytest.mark.rest
def test_polygons_of_corrections_hold_above_the_ground(file, village, tmp_path):
    x, y = village.points.x + ORIGIN[0], village.points.y + ORIGIN[1]
    west, south = np.median(x), np.median(y)
    east, north = west + 40, south + 40
    ring = [(west, south), (east, south), (east, north), (west, north), (west, south)]
    polygon = {"type": "Polygon", "coordinates": [ring]}
    known, out = tmp_path / "known.geojson", tmp_path / "out.laz"
    for value in (1, 9):
        feature = {"type": "Feature", "properties": {"class": value}, "geometry": polygon}
        known.write_text(json.dumps(feature))
        classify(file, out, corrections=known, **RUN)
        inside = (x > west) & (x < east) & (y > south) & (y < north)
        found = classes_of(out)
        assert set(found[inside & (village.classes != 7)]) == {value}
        assert {3, 4, 5, 6} <= set(found[~inside])


@pytest.mark.rest
def test_remembered_classes_are_those_of_the_whole_run(file, tmp_path):
    out, again = tmp_path / "out.laz", tmp_path / "again.laz"
    classify(file, out, remember_classes=True, **RUN)
    las = laspy.read(out)
    assert np.array_equal(las["BareEarthClass"], las.classification)
    roofs = np.flatnonzero(np.asarray(las.classification) == 6)[::9]
    las.classification[roofs] = 1
    las.write(str(out))
    classify(out, again, remember_classes=True, **RUN)
    assert set(classes_of(again)[roofs]) == {1}


def test_the_ground_alone_cannot_have_classes_above_it(file, tmp_path):
    with pytest.raises(BareEarthError, match="need all points"):
        classify(file, tmp_path / "out.laz", ground_only=True, **RUN)
