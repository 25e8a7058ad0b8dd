"""Classes above the ground: vegetation by height, buildings, bridges; one file and many."""

import laspy
import numpy as np
import pytest
from conftest import Heard
from runs import said

import bare_earth
from bare_earth import BareEarthError
from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.core.threads import may_use
from bare_earth.algorithms.engine.blocks import Blocks
from bare_earth.algorithms.engine.memory import Resources
from bare_earth.algorithms.runs.entry import classify
from bare_earth.algorithms.runs.entry import write as write_with
from bare_earth.algorithms.runs.options import TileOutput
from bare_earth.algorithms.runs.requests import ClassifyRequest, PointRequest
from bare_earth.algorithms.survey.area import Area
from bare_earth.algorithms.survey.corrections import Corrections
from bare_earth.algorithms.survey.selection import Selection
from bare_earth.algorithms.tools.above_ground import ClassifyAboveGround
from bare_earth.algorithms.tools.above_ground.buildings import Buildings, planes_through
from bare_earth.algorithms.tools.above_ground.classes import (
    AboveGround,
    ThenAboveGround,
    classes_above_ground,
)
from bare_earth.algorithms.tools.ground.output import Output
from bare_earth.algorithms.tools.rasters.rows import RasterFiles
from benchmarks import scenes
from benchmarks.scenes.simple import scatter

ORIGIN = (500_000.0, 5_700_000.0, 0.0)


@pytest.fixture(scope="module")
def village():
    return scenes.make("village", 0, size=110.0)


def _iou(found, true):
    return np.count_nonzero(found & true) / np.count_nonzero(found | true)


def _write(path, points, classes, returns=None, which=slice(None)):
    header = laspy.LasHeader(point_format=6, version="1.4")
    header.scales, header.offsets = (0.001,) * 3, ORIGIN
    las = laspy.LasData(header)
    las.x, las.y = points.x[which] + ORIGIN[0], points.y[which] + ORIGIN[1]
    las.z = points.z[which]
    las.classification[:] = classes[which]
    one = np.ones(points.count, dtype=np.uint8)
    number, count = returns or (one, one)
    las.return_number[:], las.number_of_returns[:] = number[which], count[which]
    las.write(str(path))
    return path


def _only_ground(scene):
    """Return classes of which only the ground is known."""
    return np.where(scene.classes == 2, 2, 1).astype(np.uint8)


@pytest.fixture(scope="module")
def file(village, tmp_path_factory):
    path = tmp_path_factory.mktemp("village") / "village.laz"
    returns = village.return_number, village.number_of_returns
    return _write(path, village.points, _only_ground(village), returns)


@pytest.fixture(scope="module")
def finished(file):
    """Return the file with its classes above the known ground."""
    bare_earth.above_ground(file, path := file.with_name("finished.laz"))
    return path


@pytest.fixture(scope="module")
def classified(file):
    """Return the file after the run that finds the ground and what is above, and its summary."""
    path = file.with_name("classified.laz")
    return path, classify(file, path, _run())


def _classes(path):
    return np.asarray(laspy.read(path).classification)


def _rows(paths):
    """Return the points of some files with their classes, sorted."""
    files = [laspy.read(each) for each in paths]
    rows = np.concatenate(
        [np.column_stack([las.X, las.Y, las.Z, las.classification]) for las in files]
    )
    return rows[np.lexsort(rows.T[::-1])]


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


@pytest.mark.parametrize(
    "kind, least",
    [("village", 0.94), ("hillside_village", 0.93), ("city_blocks", 0.97), ("car_park", 0.98)],
)
def test_buildings_of_scenes_are_found(kind, least):
    scene = scenes.make(kind, 0, size=120.0)
    several = scene.number_of_returns > 1
    classes = classes_above_ground(scene.points, scene.ground, several)
    assert _iou(classes == 6, scene.classes == 6) >= least
    assert np.array_equal(classes == 2, scene.ground)


def test_a_forest_has_no_buildings():
    scene = scenes.make("steep_forest", 0, size=100.0)
    for several in (scene.number_of_returns > 1, np.zeros(scene.points.count, dtype=bool)):
        classes = classes_above_ground(scene.points, scene.ground, several)
        assert np.count_nonzero(classes == 6) < 1e-3 * np.count_nonzero(classes == 5)


def test_bridges_and_birds_have_classes_of_their_own():
    scene = scenes.make("bridge_over_road", 0)
    several = scene.number_of_returns > 1
    classes = classes_above_ground(scene.points, scene.ground, several)
    assert _iou(classes == 17, scene.classes == 17) > 0.75
    birds = scenes.make("birds", 0)
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


def test_the_order_of_the_points_and_threads_do_not_matter(village):
    points, ground = village.points, village.ground
    several = village.number_of_returns > 1
    found = classes_above_ground(points, ground, several)
    mixed = np.random.default_rng(2).permutation(points.count)
    again = classes_above_ground(points.take(mixed), ground[mixed], several[mixed])
    assert np.array_equal(again, found[mixed])
    with may_use(3):
        assert np.array_equal(classes_above_ground(points, ground, several), found)


def test_one_file(file, village, tmp_path):
    out = tmp_path / "out.laz"
    summary = bare_earth.above_ground(file, out)
    classes = _classes(out)
    assert _iou(classes == 6, village.classes == 6) > 0.94
    assert summary.point_count == len(classes) and summary.ground_count == village.ground.sum()
    assert summary.class_counts == dict(zip(*np.unique(classes, return_counts=True)))
    assert f"{summary.class_counts[6]:,} are buildings" in summary.text
    # Nothing else changes.
    before, after = laspy.read(file), laspy.read(out)
    for name in before.point_format.dimension_names:
        if name != "classification":
            assert np.array_equal(before[name], after[name])
    # All that can get a class has one now, so that a second run changes nothing.
    again = bare_earth.above_ground(out, tmp_path / "again.laz")
    changed = np.flatnonzero(_classes(tmp_path / "again.laz") != classes)
    assert again.changed_count == len(changed) and len(changed) < 1e-3 * len(classes)


def test_the_files_of_a_survey_do_not_matter(finished, village, tmp_path):
    points, classes, folder = village.points, _only_ground(village), tmp_path / "in"
    folder.mkdir()
    returns = village.return_number, village.number_of_returns
    random = np.random.default_rng(5)
    west = np.median(points.x) + 3.0 * np.sin(points.y / 7.0) < points.x
    number = 2 * west + (points.y > np.quantile(points.y, 0.37))
    for each in range(4):
        which = random.permutation(np.flatnonzero(number == each))
        _write(folder / f"{each}.laz", points, classes, returns, which)
    summary = bare_earth.above_ground([folder], tmp_path / "out")
    assert summary.done_count == 4 and summary.class_counts[6] > 2000
    made = sorted((tmp_path / "out").glob("*.laz"))
    assert np.array_equal(_rows(made), _rows([finished]))
    # Finished files are kept.
    resumed = PointRequest(ClassifyAboveGround(), tiles=TileOutput(resume=True))
    assert write_with([folder], tmp_path / "out", resumed).kept_count == 4
    anew = PointRequest(ClassifyAboveGround(AboveGround("ign")), tiles=resumed.tiles)
    assert write_with([folder], tmp_path / "out", anew).kept_count == 0


def test_there_are_no_seams_between_blocks(file, finished, tmp_path, monkeypatch):
    monkeypatch.setattr(ClassifyAboveGround, "blocks", Blocks(70.0, 60.0, start=-0.00005))
    bare_earth.above_ground(file, tmp_path / "blocks.laz")
    one, blocks = _classes(finished), _classes(tmp_path / "blocks.laz")
    assert np.mean(one != blocks) < 1e-4


def test_points_on_disk_get_the_same_classes(file, finished, tmp_path):
    few, heard = PointRequest(ClassifyAboveGround(), resources=Resources(1, 0.001)), Heard()
    write_with(file, tmp_path / "disk.laz", few, heard)
    assert any("wait in a temporary file" in text for text in heard.infos)
    assert np.array_equal(_classes(finished), _classes(tmp_path / "disk.laz"))


def test_classes_with_a_meaning_stay(village, tmp_path):
    classes = village.classes.copy()
    classes[village.classes == 6] = 1
    water = np.flatnonzero(classes == 1)[::7]
    classes[water] = 9
    source = _write(
        tmp_path / "in.laz", village.points, classes,
        (village.return_number, village.number_of_returns),
    )  # fmt: skip
    bare_earth.above_ground(source, tmp_path / "kept.laz")
    found = _classes(tmp_path / "kept.laz")
    assert np.array_equal(found[classes > 1], classes[classes > 1])
    request = PointRequest(ClassifyAboveGround(AboveGround(reclassify=True)))
    write_with(source, tmp_path / "anew.laz", request)
    anew = _classes(tmp_path / "anew.laz")
    fixed = np.isin(classes, (2, 7, 9))
    assert np.array_equal(anew[fixed], classes[fixed])
    assert np.any(anew[~fixed] != classes[~fixed])


def test_only_points_of_the_area_change(file, finished, village, tmp_path):
    x, y = village.points.x + ORIGIN[0], village.points.y + ORIGIN[1]
    west, south, east, north = (*map(np.median, (x, y)), x.max(), y.max())
    area = Area(box=(west, south, east, north))
    write_with(file, tmp_path / "out.laz", PointRequest(ClassifyAboveGround(area=area)))
    before, after, whole = map(_classes, (file, tmp_path / "out.laz", finished))
    inside = (x >= west) & (y >= south)
    assert np.array_equal(after[inside], whole[inside])
    assert np.array_equal(after[~inside], before[~inside])


def test_a_class_that_was_set_by_hand_stays(file, tmp_path):
    marked = tmp_path / "marked.laz"
    classify(file, marked, ClassifyRequest(selection=Selection(remember_classes=True)))
    las = laspy.read(marked)
    mine = np.flatnonzero(np.asarray(las.classification) == 2)[::50]
    las.classification[mine] = 1
    las.write(str(marked))
    bare_earth.above_ground(marked, tmp_path / "out.laz")
    found = _classes(tmp_path / "out.laz")
    assert set(found[mine]) == {1} and set(np.unique(found)) > {2, 5, 6}


def test_a_file_without_ground_is_refused(village, tmp_path):
    source = _write(tmp_path / "in.laz", village.points, np.ones(village.points.count, np.uint8))
    with pytest.raises(BareEarthError, match="no ground points"):
        bare_earth.above_ground(source, tmp_path / "out.laz")
    assert not (tmp_path / "out.laz").exists()


def test_a_file_with_nothing_to_change_is_told(village, tmp_path, las):
    classes = np.where(village.ground, 2, 6).astype(np.uint8)
    source = _write(tmp_path / "in.laz", village.points, classes)
    heard = las.Heard()
    assert bare_earth.above_ground(source, tmp_path / "out.laz", progress=heard).changed_count == 0
    assert any("decided anew" in each for each in heard.warnings)


def test_the_command(file, tmp_path):
    out = tmp_path / "out.laz"
    code, text, errors = said("above-ground", file, out, "--above-ground", "ign", "--verbose")
    assert code == 0, errors
    assert "are buildings and" in text
    write_with(file, tmp_path / "same.laz", PointRequest(ClassifyAboveGround(AboveGround("ign"))))
    assert np.array_equal(_classes(out), _classes(tmp_path / "same.laz"))
    code, _, errors = said(
        "above-ground", file, out, "--above-ground", "own", "--medium-height", 3, "--high-height", 1
    )
    assert code == 2 and "do not decrease" in errors


# In the run that finds the ground


def _run(**options):
    return ClassifyRequest(above_ground=ThenAboveGround("ign"), **options)


def test_one_run_finds_the_ground_and_what_is_above(file, classified, village, tmp_path):
    (one, summary), ground, two = classified, tmp_path / "ground.laz", tmp_path / "two.laz"
    classify(file, ground)
    write_with(ground, two, PointRequest(ClassifyAboveGround(AboveGround("ign"))))
    assert np.array_equal(_classes(one), _classes(two))
    assert summary.class_counts == dict(zip(*np.unique(_classes(one), return_counts=True)))
    assert _iou(_classes(one) == 6, village.classes == 6) > 0.93


def test_one_run_on_many_files_does_the_same(classified, village, tmp_path):
    points, folder = village.points, tmp_path / "in"
    folder.mkdir()
    returns = village.return_number, village.number_of_returns
    for number in range(2):
        which = np.flatnonzero((points.x > np.median(points.x)) == number)
        _write(folder / f"{number}.laz", points, _only_ground(village), returns, which)
    summary = classify([folder], tmp_path / "out", _run())
    assert summary.class_counts[6] > 2000
    made = sorted((tmp_path / "out").glob("*.laz"))
    assert np.array_equal(_rows(made), _rows([classified[0]]))
    again = _run(tiles=TileOutput(resume=True))
    assert classify([folder], tmp_path / "out", again).kept_count == 2


def test_one_run_on_many_files_also_makes_heights_and_goes_on(file, village, tmp_path):
    heights = Output(height_above_ground=True)
    classify(file, tmp_path / "one.laz", _run(output=heights))
    points, folder, out = village.points, tmp_path / "in", tmp_path / "out"
    folder.mkdir()
    returns = village.return_number, village.number_of_returns
    # So far apart that the first file does not affect the last one.
    cuts = np.quantile(points.x, (0.2, 0.8))
    for number in range(3):
        which = np.flatnonzero(np.searchsorted(cuts, points.x) == number)
        _write(folder / f"{number}.laz", points, _only_ground(village), returns, which)
    summary = classify([folder], out, _run(output=heights))
    made = sorted(out.glob("*.laz"))
    assert summary.done_count == 3 and len(made) == 3 and not list(tmp_path.glob("out/.*/waiting*"))

    def all_of(paths):
        clouds = [laspy.read(path) for path in paths]
        names = "X", "Y", "Z", "classification", "HeightAboveGround"
        columns = [np.concatenate([np.asarray(each[name]) for each in clouds]) for name in names]
        return np.column_stack(columns)[np.lexsort(columns)]

    np.testing.assert_array_equal(all_of(made), all_of([tmp_path / "one.laz"]))
    again = _run(output=heights, tiles=TileOutput(resume=True))
    assert classify([folder], out, again).kept_count == 3
    before = [path.read_bytes() for path in made]
    made[0].unlink()
    assert classify([folder], out, again).kept_count == 2
    assert [path.read_bytes() for path in made] == before


def test_one_run_also_makes_heights_and_rasters(file, classified, tmp_path):
    rasters = RasterFiles(dtm=tmp_path / "dtm.tif")
    classify(
        file, tmp_path / "all.laz", _run(output=Output(height_above_ground=True), rasters=rasters)
    )
    assert np.array_equal(_classes(tmp_path / "all.laz"), _classes(classified[0]))
    las = laspy.read(tmp_path / "all.laz")
    high = np.asarray(las["HeightAboveGround"])
    for value, low, most in ((3, 0.0, 0.5), (4, 0.5, 1.5), (5, 1.5, np.inf)):
        of_class = high[np.asarray(las.classification) == value]
        assert of_class.min() >= low - 1e-4 and of_class.max() <= most + 1e-4
    assert (tmp_path / "dtm.tif").exists()


def test_polygons_of_corrections_hold_above_the_ground(file, village, tmp_path):
    x, y = village.points.x + ORIGIN[0], village.points.y + ORIGIN[1]
    west, south = np.median(x), np.median(y)
    ring = np.array(
        [(west, south), (west + 40, south), (west + 40, south + 40), (west, south + 40)]
    )
    for name, value in (("other", 1), ("water", 9)):
        known = Corrections(polygons=((ring,),), classes=(value,))
        out = tmp_path / f"{name}.laz"
        classify(file, out, _run(corrections=known))
        inside = (x > west) & (x < west + 40) & (y > south) & (y < south + 40)
        found = _classes(out)
        assert set(found[inside & (village.classes != 7)]) == {value}
        assert {3, 4, 5, 6} <= set(found[~inside])


def test_remembered_classes_are_those_of_the_whole_run(file, tmp_path):
    out, again = tmp_path / "out.laz", tmp_path / "again.laz"
    selection = Selection(remember_classes=True)
    classify(file, out, _run(selection=selection))
    las = laspy.read(out)
    assert np.array_equal(las["BareEarthClass"], las.classification)
    roofs = np.flatnonzero(np.asarray(las.classification) == 6)[::9]
    las.classification[roofs] = 1
    las.write(str(out))
    classify(out, again, _run(selection=selection))
    assert set(_classes(again)[roofs]) == {1}


def test_the_ground_alone_cannot_have_classes_above_it():
    with pytest.raises(BareEarthError, match="need all points"):
        _run(output=Output(ground_only=True))
