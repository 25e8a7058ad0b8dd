from pathlib import Path

import laspy
import numpy as np
import pytest
from matrices import covering, quick
from runs import Heard
from surveys import write_points

from bare_earth import BareEarthError, classify
from bare_earth.algorithms.classes.selection import Selection
from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.crs.system import Crs
from bare_earth.algorithms.engine import file_points, memory_store
from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.filters.pipeline import Pipeline, PointRule, Stage
from bare_earth.algorithms.filters.stages.outliers import below_ground
from bare_earth.algorithms.las import cloud as cloud_module
from bare_earth.algorithms.las.cloud import PointCloud
from bare_earth.algorithms.survey.area import Area
from bare_earth.algorithms.tools.ground import labelling, step
from benchmarks.clouds import classify_cloud
from benchmarks.scenes.simple import village

EAST, NORTH = 500_000.0, 5_700_000.0
FOOT = 0.3048
PARAMETERS = [method.parameters() for method in METHODS.values()]
TIN, _, SLOPE = PARAMETERS


def cloud_of(points, classes=1, crs=None, unit=1.0):
    """Return a cloud of points that are given in metres, in a CRS of some unit."""
    x, y, z = (np.round(values / unit * 1000).astype(np.int32) for values in points)
    ones = np.ones(points.count, np.uint8)
    return PointCloud(
        Path("in.las"), x, y, z, (0.001,) * 3, (EAST, NORTH, 0.0), classes * ones, ones, ones,
        np.zeros(points.count, bool), 6, crs or Crs(horizontal_unit=unit, vertical_unit=unit),
    )  # fmt: skip


def box(west, south, east, north, unit=1.0):
    return Area(tuple(np.array([west, south, east, north]) / unit + [EAST, NORTH, EAST, NORTH]))


@pytest.fixture(scope="module")
def scene():
    return village()


@pytest.fixture(scope="module")
def long_scene():
    """Return a strip of 480 x 40 m with houses: most of it is no context of its middle."""
    random = np.random.default_rng(8)
    x, y = random.uniform(0, 480, 40_000), random.uniform(0, 40, 40_000)
    z = 50 + 0.05 * x + 2 * np.sin(x / 20) + random.normal(0, 0.03, len(x))
    roof = (x % 40 < 14) & (np.abs(y - 20) < 6)
    return Points(x, y, np.where(roof, z + 6, z))


@pytest.mark.rest(but="tin-densification")
@pytest.mark.parametrize("parameters", PARAMETERS, ids=METHODS)
def test_in_an_area_the_result_is_that_of_the_whole_survey(parameters, long_scene):
    cloud = cloud_of(long_scene, classes=6)
    whole, _ = classify_cloud(cloud, parameters)
    area = box(220, 5, 260, 35)
    found, selected = classify_cloud(cloud, parameters, area=area)
    inside = area.of(cloud)
    assert 1000 < inside.sum() < 5000 and 0.2 < (whole[inside] == 2).mean() < 0.95
    assert np.array_equal(found[inside], whole[inside])
    assert (found[~inside] == 6).all() and np.array_equal(selected, inside)


@pytest.mark.rest
def test_however_many_points_are_looked_at_together_the_result_is_the_same(monkeypatch, long_scene):
    random = np.random.default_rng(9)
    classes = random.choice([1, 2, 5, 7, 9], long_scene.count)
    cloud = cloud_of(long_scene, classes=classes.astype(np.uint8))
    cloud.withheld[random.random(cloud.count) < 0.02] = True
    cloud.z[::5000] -= 15_000
    selection = Selection(seed_classes=(9,), low_noise_class=True)
    results = []
    for most in (1 << 19, 700):
        monkeypatch.setattr(cloud_module, "_PART", most)
        monkeypatch.setattr(memory_store, "_CHOSEN", most)
        progress = Heard()
        found = classify_cloud(cloud, TIN, selection, progress, box(20, 5, 400, 35))
        assert progress.fractions == sorted(progress.fractions)
        results.append((*found, progress.infos, progress.warnings))
        steps = len(progress.fractions)
    assert all(np.array_equal(*pair) for pair in zip(*results))
    assert steps > 3 * cloud.count / 700
    assert len(np.unique(results[0][0])) == 5


def watched(monkeypatch, result=None, takes_known_ground=False):
    """Replace a method; return what it is given."""
    given = {}

    class Watch(PointRule):
        stage = Stage.ACCEPTED

        def apply(self, state):
            given.update(points=state.points, known_ground=state.known_ground)
            none = np.zeros(state.points.count, bool)
            state.ground = none if result is None else result(state.points)

    method = METHODS["slope"]._replace(
        pipeline=lambda *_: Pipeline((Watch(),)), takes_known_ground=takes_known_ground
    )
    for module in (step, labelling):
        monkeypatch.setattr(module, "method_of", lambda parameters: method)
    return given


@pytest.mark.parametrize("unit", [1.0, FOOT])
def test_the_method_sees_what_lies_near_the_area_and_no_more(unit, long_scene, monkeypatch):
    given, cloud = watched(monkeypatch), cloud_of(long_scene, unit=unit)
    classify_cloud(
        cloud, METHODS["slope"].parameters(max_building_size=40.0), area=box(220, 5, 260, 35, unit)
    )
    assert np.ptp(given["points"].x) == pytest.approx(240, abs=0.5)
    # Metres from the corner of the block.
    assert given["points"].x.min() == pytest.approx(EAST * unit % 2000 + 120, abs=0.5)
    # More where a parameter is larger.
    classify_cloud(
        cloud, METHODS["slope"].parameters(max_building_size=100.0), area=box(220, 5, 260, 35, unit)
    )
    assert np.ptp(given["points"].x) == pytest.approx(440, abs=0.5)


@pytest.mark.rest
def test_outside_an_area_even_old_ground_and_class_0_stay(scene):
    points, _ = scene
    classes = np.arange(points.count, dtype=np.uint8) % 3
    cloud, area = cloud_of(points, classes), box(20, 20, 50, 60)
    for others in ("keep", "unclassified"):
        found, _ = classify_cloud(cloud, SLOPE, Selection(others=others), area=area)
        inside = area.of(cloud)
        assert np.array_equal(found[~inside], classes[~inside])
        assert set(np.unique(found[inside])) == {1, 2}


def test_a_polygon_limits_too(scene):
    points, _ = scene
    cloud = cloud_of(points, 5)
    corners = np.array([(EAST, NORTH), (EAST + 60, NORTH), (EAST, NORTH + 60)])
    found, _ = classify_cloud(cloud, SLOPE, area=Area(polygons=((corners,),)))
    changed = found != 5
    assert changed.any() and (points.x + points.y)[changed].max() <= 60.01


def test_an_area_without_points_is_told_with_both_extents(scene):
    with pytest.raises(BareEarthError) as caught:
        classify_cloud(cloud_of(scene[0]), SLOPE, area=Area((9.0, 50.0, 9.1, 50.1)))
    text = str(caught.value)
    assert "\n" not in text and "in.las" in text and "(x 9 to 9.1, y 50 to 50.1)" in text
    assert "points lie in x 500000" in text and "CRS of the points" in text


def test_an_area_where_nothing_takes_part_is_told(scene):
    points, _ = scene
    classes = np.where(points.x < 40, 9, 1).astype(np.uint8)
    with pytest.raises(BareEarthError, match=r"None of the [\d,]+ points in the area"):
        classify_cloud(
            cloud_of(points, classes), SLOPE, Selection(from_classes=(1,)),
            area=box(0, 0, 30, 80),
        )  # fmt: skip


def test_geographic_coordinates_are_told_before_an_area_without_points(scene):
    cloud = cloud_of(scene[0], crs=Crs(is_geographic=True))
    with pytest.raises(BareEarthError, match="projected CRS"):
        classify_cloud(cloud, SLOPE, area=Area((0, 0, 1, 1)))


# Known ground


def test_known_ground_stays_ground_whatever_the_method_finds(scene, monkeypatch):
    watched(monkeypatch)
    progress, classes = Heard(), np.ones(scene[0].count, np.uint8)
    classes[::7], classes[::9] = 8, 5
    cloud, selection = cloud_of(scene[0], classes), Selection(seed_classes=(8,))
    found, _ = classify_cloud(cloud, SLOPE, selection, progress)
    assert np.array_equal(found == 2, classes == 8)
    assert (found[classes == 5] == 5).all()
    count = np.count_nonzero(classes == 8)
    assert any(f"{count:,} points of class 8" in text for text in progress.infos)
    assert any("does not start from known" in text for text in progress.infos)


def test_a_method_that_takes_known_ground_gets_it(scene, monkeypatch):
    given, progress = watched(monkeypatch, takes_known_ground=True), Heard()
    points = scene[0].take(~is_low(scene[0]))
    classes = np.ones(points.count, np.uint8)
    classes[::7], classes[::9] = 2, 9
    cloud = cloud_of(points, classes)
    # Of class 9, which takes no part, nothing is given.
    found, selected = classify_cloud(
        cloud, SLOPE, Selection(from_classes=(1,), seed_classes=(2,)), progress
    )
    assert np.array_equal(given["known_ground"], classes[selected] == 2)
    assert given["points"].count == np.count_nonzero(selected) == np.count_nonzero(classes < 9)
    assert np.array_equal(found, np.where(classes == 1, 1, classes))
    assert not any("does not start" in text for text in progress.infos)
    classify_cloud(cloud, SLOPE, Selection(from_classes=(1,)))
    assert given["points"].count == np.count_nonzero(classes == 1)


def test_known_ground_is_context_outside_the_area_and_counts_there_only(scene, monkeypatch):
    given = watched(monkeypatch, takes_known_ground=True)
    classes = np.where(scene[0].x < 40, 2, 1).astype(np.uint8)
    cloud = cloud_of(scene[0], classes)
    found, _ = classify_cloud(cloud, SLOPE, Selection(seed_classes=(2,)), area=box(50, 0, 80, 80))
    assert np.count_nonzero(given["known_ground"]) == np.count_nonzero(classes == 2)
    assert np.array_equal(found, classes)


def test_without_known_ground_there_is_a_warning(scene):
    progress = Heard()
    classify_cloud(cloud_of(scene[0]), SLOPE, Selection(seed_classes=(2, 8)), progress)
    (warning,) = progress.warnings
    assert "known ground (class 2, 8)" in warning


@pytest.mark.rest(but="tin-densification")
@pytest.mark.parametrize("parameters", PARAMETERS, ids=METHODS)
def test_every_method_keeps_known_ground(parameters, scene):
    points, truth = scene
    # Of the roofs, too, though no method would take them.
    classes = np.where(np.random.default_rng(1).random(points.count) < 0.02, 2, 1).astype(np.uint8)
    assert (~truth)[classes == 2].sum() > 20
    found, _ = classify_cloud(cloud_of(points, classes), parameters, Selection(seed_classes=(2,)))
    assert (found[classes == 2] == 2).all()


# Low outliers


def is_low(points):
    return points.z < 100 + 0.1 * points.x + 0.8 * np.sin(points.y / 15) - 4


@pytest.mark.rest
@pytest.mark.parametrize("method", quick(METHODS, "grid-minimum"))
def test_low_outliers_go_to_class_7_where_wanted(method, scene):
    (points, truth), parameters = scene, METHODS[method].parameters()
    low = is_low(points)
    assert low.sum() == 6 and not truth[low].any()
    cloud, progress = cloud_of(points), Heard()
    plain, _ = classify_cloud(cloud, parameters)
    assert (plain[low] == 1).all()
    found, _ = classify_cloud(cloud, parameters, Selection(low_noise_class=True), progress)
    assert (found[low] == 7).all() and (found == 7).sum() <= 8
    assert np.array_equal(found == 2, plain == 2)
    assert any("more than 1 m below" in text for text in progress.infos)
    # What lies below ground all round it is low noise, however deep.
    deep, _ = classify_cloud(
        cloud, parameters, Selection(low_noise_class=True, low_noise_depth=100)
    )
    assert (deep[low] == 7).all() and (deep == 7).sum() <= (found == 7).sum()


def test_low_outliers_outside_the_area_or_of_other_classes_stay(scene):
    points, _ = scene
    low = is_low(points)
    classes = np.ones(points.count, np.uint8)
    classes[np.flatnonzero(low)[:2]] = 9
    selection = Selection(low_noise_class=True, from_classes=(1,))
    cloud, area = cloud_of(points, classes), box(0, 0, 80, 45)
    found, _ = classify_cloud(cloud, SLOPE, selection, area=area)
    expected = low & (classes == 1) & area.of(cloud)
    assert np.array_equal(found == 7, expected) and 0 < expected.sum() < 4


def test_points_below_the_ground_on_a_slope_and_beside_a_cliff():
    random = np.random.default_rng(4)
    x, y = random.uniform(0, 60, (2, 15_000))
    z = np.where(x < 30, x, x + 15.0)
    ground = random.random(len(x)) < 0.5
    assert not below_ground(Points(x, y, z), ground, 0.5).any()
    deep = random.random(len(x)) < 0.01
    ground &= ~deep
    steps = np.abs(x - 30) < 2
    found = below_ground(Points(x, y, np.where(deep, z - 3, z)), ground, 0.5)
    assert np.array_equal(found[~steps], deep[~steps])
    assert not found[ground].any()


def test_below_no_ground_lies_nothing_and_few_points_suffice():
    one = Points(np.zeros(2), np.zeros(2), np.array([5.0, 1.0]))
    assert not below_ground(one, np.zeros(2, bool), 1.0).any()
    assert below_ground(one, np.array([True, False]), 1.0).tolist() == [False, True]


# Files


@pytest.fixture
def file(scene, tmp_path):
    points, _ = scene
    classes = np.where(points.x < 40, 2, 1)
    return write_points(tmp_path / "in.las", points.x, points.y, points.z, classes)


def test_the_counts_are_those_of_the_file_and_of_the_area(file, scene):
    target = file.with_name("out.las")
    area = box(30, 0, 80, 80)
    summary = classify(file, target, method="slope", extent=area.box)
    found = np.asarray(laspy.read(target).classification)
    before = laspy.read(file)
    inside = area.contains(np.asarray(before.x), np.asarray(before.y))
    assert np.array_equal(found[~inside], np.asarray(before.classification)[~inside])
    wanted = {
        "point_count": scene[0].count,
        "area_count": inside.sum(),
        "selected_count": inside.sum(),
        "ground_count": (found == 2).sum(),
        "area_ground_count": (found[inside] == 2).sum(),
        "class_counts": {1: (found == 1).sum(), 2: (found == 2).sum()},
    }
    assert wanted == {name: getattr(summary, name) for name in wanted}


def test_without_an_area_it_is_all(file, scene):
    summary = classify(file, file.with_name("out.las"), method="slope")
    assert summary.area_count == summary.selected_count == summary.point_count == scene[0].count
    assert summary.area_ground_count == summary.ground_count


@pytest.mark.rest(but="7-out.laz")
@pytest.mark.parametrize(
    ("point_format", "target"), covering([1, 7], ["out.las", "out.laz", "out.copc.laz"])
)
def test_the_file_is_the_same_whether_its_records_are_kept_or_read_again(
    las, tmp_path, monkeypatch, point_format, target
):
    source = las.make("in.laz", version=4, point_format=point_format, extra=2)
    how = {"method": "slope", "returns": "all", "from_classes": range(32)}
    written = []
    for longest in (0, 48):
        monkeypatch.setattr(file_points, "_LONGEST_KEPT", longest)
        classify(source, tmp_path / target, **how)
        written.append((tmp_path / target).read_bytes())
    assert written[0] == written[1]
