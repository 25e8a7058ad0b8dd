"""Groups of points far below the ground, and far above everything."""

import laspy
import numpy as np
import pytest
from matrices import covering
from realdata import real
from surveys import classes_of, heights_of

from bare_earth import classify, terrain
from bare_earth.algorithms.classes.selection import Selection
from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.filters.stages.below_land import BelowLand
from bare_earth.algorithms.filters.stages.low_noise import BelowWater, LowGroups
from bare_earth.algorithms.grids.cells import Cells
from bare_earth.algorithms.grids.high_groups import HighGroups
from bare_earth.algorithms.las.reading import read_cloud
from benchmarks.clouds import classify_cloud
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


@pytest.mark.rest
@pytest.mark.parametrize(("kind", "method"), covering(LOW_KINDS, list(METHODS)))
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


@pytest.mark.rest(but="1.0")
@pytest.mark.parametrize("density", [1.0, 50.0])
def test_low_groups_are_found_at_any_density(density):
    scene = make("low_groups_meadow", seed=9, density=density, size=60.0)
    found = LowGroups().find(scene.points)
    assert np.array_equal(found, scene.classes == 7)


@pytest.mark.rest
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


def lake(returns, noise, behind_dam=False, seed=0):
    """Return land of 1 point/m2 with a lake, and which points are noise 1 to 5 m below it.

    Behind a dam east of the lake, the land is 3 m lower than the water.
    """
    random = np.random.default_rng(seed)
    x, y = random.uniform(0.0, 120.0, (2, 14_400))
    out = np.hypot(x - 60.0, y - 60.0) - 35.0
    z = 50.0 + np.clip(out, 0.0, 4.0) + random.normal(0.0, 0.02, len(x))
    if behind_dam:
        z = np.where(x > 100.0, 47.0 + random.normal(0.0, 0.02, len(x)), z)
        z = np.where((x > 92.0) & (x <= 100.0) & (out > 0.0), 51.0 - (x - 92.0) / 2.0, z)
    kept = (out > 0.0) | (random.random(len(x)) < returns)
    below_x, below_y = random.uniform(0.0, 120.0, (2, round(14_400 * noise)))
    wet = np.hypot(below_x - 60.0, below_y - 60.0) < 33.0
    below = below_x[wet], below_y[wet], random.uniform(45.0, 49.0, np.count_nonzero(wet))
    points = joined(Points(x[kept], y[kept], z[kept]), np.transpose(below))
    return points, np.arange(points.count) >= np.count_nonzero(kept)


@pytest.mark.rest(but="tin-densification")
@pytest.mark.parametrize(
    ("method", "share_and_noise"), covering(list(METHODS), [(0.1, 0.03), (0.05, 0.05), (0.3, 0.02)])
)
def test_returns_below_a_lake_are_low_noise(method, share_and_noise):
    points, below = lake(*share_and_noise)
    found = METHODS[method].ground(points, METHODS[method].parameters())
    # One of a hundred, close to the shore, may stay.
    assert found.low[below].mean() > 0.97 and found.ground[below].mean() < 0.01
    assert not found.low[~below].any() and found.ground[~below].mean() > 0.999


@pytest.mark.rest(but="tin-densification")
@pytest.mark.parametrize("method", METHODS)
def test_returns_below_a_lake_that_someone_reported_are_low_noise(method):
    path = real("field2/water-noise-below.laz")
    below = np.asarray(laspy.read(path).user_data) == 1
    parameters = METHODS[method].parameters()
    found, _ = classify_cloud(read_cloud(path), parameters, Selection(low_noise_class=True))
    assert (found[below] == 7).all()
    assert (found[~below] == 2).mean() > 0.999


def test_land_behind_a_dam_is_not_below_water():
    points, _ = lake(0.1, 0.0, behind_dam=True)
    lowest = Cells.over(points, 1.0).lowest_points(points)
    for size in BelowWater().sizes:
        assert not BelowWater().find(points, lowest, 1.0, Cells.over(points, size)).any()


@pytest.mark.rest(but="grid-minimum")
@pytest.mark.parametrize("method", METHODS)
def test_wide_groups_below_streets_are_low_noise(method):
    land, random = even(side=90.0), np.random.default_rng(4)
    middles = [(east, north) for east in (15.0, 45.0, 75.0) for north in (15.0, 45.0, 75.0)]
    groups = [
        np.column_stack((random.uniform(-2.5, 2.5, (40, 2)) + middle, random.normal(42.0, 0.2, 40)))
        for middle in middles
    ]
    points = joined(land, *groups)
    found = METHODS[method].ground(points, METHODS[method].parameters())
    low = np.arange(points.count) >= land.count
    assert found.low[low].all() and not found.low[~low].any()
    assert found.ground[~low].mean() > 0.999


def test_a_shaft_and_a_pond_are_not_below_land():
    x, y, z = even()
    for width, depth in ((5.0, 6.0), (3.0, 4.0)):
        inside = np.maximum(np.abs(x - 20.0), np.abs(y - 20.0)) < width / 2.0
        points = Points(x, y, np.where(inside, z - depth, z))
        assert not BelowLand().find(points, Cells.over(points, 3.0)).any()


def layer(side: float, below: float, share: float) -> tuple[Points, np.ndarray]:
    """Return sloping land of 90 m with a layer below it, and which points are the layer's."""
    land, random = even(side=90.0, slope=0.05), np.random.default_rng(5)
    x, y = random.uniform(45.0 - side / 2, 45.0 + side / 2, (2, int(4.0 * share * side**2)))
    points = joined(land, np.column_stack((x, y, 50.0 + 0.05 * x - below)))
    return points, np.arange(points.count) >= land.count


@pytest.mark.parametrize(
    "size", [(20.0, 12.0, 0.1), (40.0, 12.0, 0.1), (12.0, 5.0, 0.6), (6.0, 6.0, 1.0)]
)
def test_a_layer_below_land_that_goes_on_above_is_low_noise(size):
    points, low = layer(*size)
    found = BelowLand().find(points, Cells.over(points, 2.0))
    assert np.array_equal(found, low)


def test_the_floor_of_a_quarry_below_leaves_is_not_below_land():
    points, low = layer(40.0, 10.0, 1.0)
    x, y, z = points
    inside = np.maximum(np.abs(x - 45.0), np.abs(y - 45.0)) <= 20.0
    # In place of the land above there are leaves, at all heights.
    leaves = np.where(inside & ~low, z + np.random.default_rng(6).uniform(-6.0, 6.0, len(z)), z)
    points = Points(x, y, leaves)
    assert not BelowLand().find(points, Cells.over(points, 2.0)).any()


@pytest.mark.rest
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


@pytest.mark.rest
@pytest.mark.parametrize("density", [1.0, 6.0])
def test_birds_are_high_groups(density):
    scene = make("birds", seed=11, density=density)
    assert np.array_equal(HighGroups().find(scene.points), scene.classes == 18)


@pytest.mark.rest(but="open_forest")
@pytest.mark.parametrize("kind", ["power_lines", "open_forest", "sea_cliff", "city_blocks"])
def test_wires_trees_cliffs_and_roofs_are_no_high_groups(kind):
    scene = make(kind, seed=12, size=90.0)
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


@pytest.mark.rest
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


@pytest.mark.rest
def test_birds_that_someone_reported_are_not_in_the_surface(tmp_path):
    out, chm = tmp_path / "out.laz", tmp_path / "chm.tif"
    classify(real("field/birds.laz"), out, chm=chm, high_noise_class=True)
    assert np.count_nonzero(classes_of(out) == 18) == 12
    assert np.nanmax(heights_of(chm)) < 25.0


@pytest.mark.rest
@pytest.mark.parametrize("classify_first", [True, False])
def test_no_bird_is_in_a_surface_or_canopy_model(tmp_path, classify_first):
    scene, path = make("birds", seed=14, size=100.0), tmp_path / "birds.las"
    write_las(scene.cloud(), path)
    chm = tmp_path / "chm.tif"
    if classify_first:
        classify(path, tmp_path / "out.las", chm=chm)
    else:
        content = laspy.read(path)
        content.classification = np.where(scene.classes == 18, 1, scene.classes)
        content.write(path)
        terrain(path, chm=chm)
    assert np.nanmax(heights_of(chm)) < 24.0
