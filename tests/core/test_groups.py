"""Groups of points far below the ground, and far above everything."""

import laspy
import numpy as np
import pytest
from realdata import real

from bare_earth.algorithms import ClassifyRequest, TerrainRequest, classify, terrain
from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.filters.stages.low_groups import LowGroups
from bare_earth.algorithms.las.reading import read_cloud
from bare_earth.algorithms.products.high_groups import HighGroups
from bare_earth.algorithms.products.raster_files import RasterFiles
from bare_earth.algorithms.rasters.geotiff import read_raster
from bare_earth.algorithms.runs.one_file import classify_cloud
from bare_earth.algorithms.survey.selection import Selection
from benchmarks.peers import write_las
from benchmarks.scenes import make

LOW_KINDS = ("low_groups_meadow", "low_groups_slope", "low_groups_town", "low_groups_road")


def even(side=40.0, density=4.0, slope=0.0, seed=0):
    """Return an even meadow, with a noise of 3 cm."""
    random = np.random.default_rng(seed)
    count = int(density * side**2)
    x, y = random.uniform(0.0, side, (2, count))
    return Points(x, y, 50.0 + slope * x + random.normal(0.0, 0.03, count))


def joined(points, *groups):
    columns = np.concatenate([np.column_stack(points), *(np.array(group) for group in groups)])
    return Points(*columns.T.copy())


def square(x, y, z, side=1.5, count=9):
    """Return a group of points in a square, all of one height."""
    steps = np.linspace(0.0, side, round(count**0.5))
    return [(x + east, y + north, z) for east in steps for north in steps]


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("kind", LOW_KINDS)
def test_no_low_group_is_ground_and_all_are_low_noise(kind, method):
    scene = make(kind, seed=8, size=70.0)
    low = scene.classes == 7
    assert low.sum() > 20
    found, _ = classify_cloud(
        scene.cloud(), METHODS[method].parameters(), Selection(low_noise_class=True)
    )
    assert not (found[low] == 2).any()
    assert (found[low] == 7).all()
    assert (found[scene.ground] == 2).mean() > 0.99


@pytest.mark.parametrize("density", [1.0, 50.0])
def test_low_groups_are_found_at_any_density(density):
    scene = make("low_groups_meadow", seed=9, density=density, size=60.0)
    found = LowGroups().find(scene.points)
    assert np.array_equal(found, scene.classes == 7)


def test_groups_of_a_meadow_that_someone_reported_go_with_all_methods():
    cloud = read_cloud(real("field/low-groups-meadow.laz"))
    for method in METHODS.values():
        found, _ = classify_cloud(cloud, method.parameters(), Selection(low_noise_class=True))
        assert (found == 7).sum() == 250 and (found == 2).sum() >= cloud.count - 252


def test_a_ditch_a_bank_and_a_step_are_no_groups():
    x, y, z = even()
    ditch = np.where(np.abs(x - 20.0) < 1.0, z - 1.5, z)
    step = np.where(x < 20.0, z - 2.0, z)
    # A ditch of which hardly any point at the bottom is seen.
    bottom = (np.abs(x - 20.0) < 1.0) & (np.random.default_rng(1).random(len(x)) < 0.9)
    seldom = Points(x[~bottom], y[~bottom], ditch[~bottom])
    for points in (Points(x, y, ditch), Points(x, y, step), seldom):
        assert not LowGroups().find(points).any()


def test_ground_seen_through_gaps_of_a_rough_canopy_is_no_group():
    random = np.random.default_rng(2)
    x, y, z = even()
    seen = random.random(len(x)) < 0.02
    canopy = z + random.uniform(4.0, 18.0, len(x))
    assert not LowGroups().find(Points(x, y, np.where(seen, z, canopy))).any()


def test_a_group_goes_as_a_whole_and_the_ground_round_it_stays():
    land = even(slope=0.3)
    points = joined(land, square(20.0, 20.0, 55.0 - 3.0), square(8.0, 30.0, 52.0 - 0.8))
    found = LowGroups().find(points)
    assert np.array_equal(np.flatnonzero(found), np.arange(land.count, points.count))


def test_low_groups_do_not_depend_on_the_order_of_points_or_on_the_place():
    scene = make("low_groups_town", seed=10, size=70.0)
    found = LowGroups().find(scene.points)
    order = np.random.default_rng(0).permutation(scene.points.count)
    assert np.array_equal(LowGroups().find(scene.points.take(order)), found[order])
    x, y, z = scene.points
    assert np.array_equal(LowGroups().find(Points(x + 32.0, y + 96.0, z)), found)


def test_known_ground_is_never_left_out():
    points = joined(even(), square(20.0, 20.0, 47.0))
    known = np.zeros(points.count, dtype=bool)
    known[-9:] = True
    for method in METHODS.values():
        found = method.ground(points, method.parameters(), known=known)
        assert found.low is None or not found.low[known].any()


def test_classic_presets_leave_nothing_out():
    points = joined(even(), square(20.0, 20.0, 47.0))
    for method in METHODS.values():
        assert method.ground(points, method.parameters(preset=method.classic)).low is None


@pytest.mark.parametrize("density", [1.0, 12.0])
def test_birds_are_high_groups(density):
    scene = make("birds", seed=11, density=density)
    assert np.array_equal(HighGroups().find(scene.points), scene.classes == 18)


@pytest.mark.parametrize("kind", ["power_lines", "open_forest", "sea_cliff", "city_blocks"])
def test_wires_trees_cliffs_and_roofs_are_no_high_groups(kind):
    scene = make(kind, seed=12, size=120.0)
    assert not HighGroups().find(scene.points).any()


def test_a_mast_is_no_high_group_and_two_birds_in_one_place_are_two():
    land = even()
    mast = [(20.0, 20.0, 50.0 + height) for height in range(2, 32, 6)]
    birds = [(10.0, 10.0, 90.0), (10.3, 10.2, 130.0)]
    points = joined(land, mast, birds)
    found = HighGroups().find(points)
    assert np.flatnonzero(found).tolist() == [points.count - 2, points.count - 1]


def test_sparse_points_of_a_wire_are_one_row():
    wire = [(x, 20.0, 75.0 + 0.05 * x) for x in np.arange(1.0, 40.0, 9.0)]
    assert not HighGroups().find(joined(even(), wire)).any()
    assert HighGroups().find(joined(even(), wire[:3])).sum() == 3


def test_a_point_far_from_all_others_is_not_judged():
    points = joined(even(), [(400.0, 400.0, 900.0)])
    assert not HighGroups().find(points).any()


def test_high_groups_become_class_18_where_wanted_and_are_never_ground():
    scene = make("birds", seed=13, size=80.0)
    high = scene.classes == 18
    for method in METHODS.values():
        plain, _ = classify_cloud(scene.cloud(), method.parameters())
        assert (plain[high] == 1).all()
    found, _ = classify_cloud(scene.cloud(), method.parameters(), Selection(high_noise_class=True))
    assert np.array_equal(found == 18, high)
    assert np.array_equal(found == 2, plain == 2)
    higher, _ = classify_cloud(
        scene.cloud(), method.parameters(), Selection(high_noise_class=True, high_noise_height=300)
    )
    assert not (higher == 18).any()


def test_surfaces_leave_out_what_is_high_noise_by_default():
    assert Selection().high_noise_height == HighGroups().height


def test_birds_that_someone_reported_are_not_in_the_surface(tmp_path):
    cloud = real("field/birds.laz")
    request = ClassifyRequest(
        selection=Selection(high_noise_class=True),
        rasters=RasterFiles(dsm=tmp_path / "dsm.tif", chm=tmp_path / "chm.tif"),
    )
    classify(cloud, tmp_path / "out.laz", request)
    assert np.count_nonzero(read_cloud(tmp_path / "out.laz").classification == 18) == 12
    assert np.nanmax(read_raster(tmp_path / "chm.tif").heights) < 25.0


@pytest.mark.parametrize("classify_first", [True, False])
def test_no_bird_is_in_a_surface_or_canopy_model(tmp_path, classify_first):
    scene, path = make("birds", seed=14, size=100.0), tmp_path / "birds.las"
    write_las(scene.cloud(), path)
    rasters = RasterFiles(dsm=tmp_path / "dsm.tif", chm=tmp_path / "chm.tif")
    if classify_first:
        classify(path, tmp_path / "out.las", ClassifyRequest(rasters=rasters))
    else:
        with laspy.open(path) as reader:
            content = reader.read()
        content.classification = np.where(scene.classes == 18, 1, scene.classes)
        content.write(path)
        terrain(path, TerrainRequest(rasters=rasters))
    chm = read_raster(tmp_path / "chm.tif").heights
    assert np.nanmax(chm) < 24.0
