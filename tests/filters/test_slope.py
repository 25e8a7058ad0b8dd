"""The slope filter: against brute force, on scenes with known truth, and on labelled samples."""

import dataclasses

import numpy as np
import pytest
from matrices import covering

from bare_earth import Progress
from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.core.threads import may_use
from bare_earth.algorithms.filters import whitebox
from bare_earth.algorithms.filters.slope import METHOD, SlopeFilter
from bare_earth.algorithms.filters.whitebox import Neighbours, stands_above
from benchmarks.scenes.simple import scatter, surveyed, village

classify = METHOD.classify

CLASSIC = SlopeFilter(preset="whitebox")


def by_brute_force(points, parameters):
    """Return the ground mask of the documented rule: every point against every other."""
    x, y, z = points
    distance = np.sqrt((x[:, None] - x) ** 2 + (y[:, None] - y) ** 2)
    radius = np.full(len(x), parameters.search_radius)
    fewest = min(parameters.min_neighbours, len(x) - 1)
    if fewest:
        radius = np.maximum(radius, np.sort(distance, axis=1)[:, fewest])
    neighbours = distance <= radius[:, None]
    heights = z
    if parameters.slope_norm:
        eroded = np.where(neighbours, z, np.inf).min(axis=1)
        opened = np.where(neighbours, eroded, -np.inf).max(axis=1)
        heights = z - np.minimum(opened, z)
    rise = heights[:, None] - heights
    slope = np.tan(np.radians(parameters.slope_threshold))
    above = neighbours & (rise >= parameters.height_threshold) & (rise > slope * distance)
    np.fill_diagonal(above, False)
    return ~above.any(axis=1)


def cloud(kind, random):
    """Return a cloud of up to 700 points whose neighbourhoods are awkward in some way."""
    count, size = int(random.integers(1, 700)), float(random.choice([3.0, 10.0, 40.0]))
    x, y = random.uniform(-size, size, (2, count))
    if kind == "grid":
        x, y = np.round(x), np.round(y)  # distances equal to the radius, places shared
    elif kind == "duplicates":
        x[: count // 2], y[: count // 2] = x[count - count // 2 :], y[count - count // 2 :]
    elif kind == "clumps":
        x, y = np.sign(x) * x**4 / size**3, np.sign(y) * y**4 / size**3
    slope = random.choice([0.0, 0.5, 1.5])
    z = np.round(random.normal(0.0, 1.0, count) + slope * x, int(random.integers(0, 3)))
    return Points(x, y, z)


@pytest.mark.rest(but="grid-False")
@pytest.mark.parametrize(
    ("kind", "slope_norm"), covering(["random", "grid", "duplicates", "clumps"], [True, False])
)
def test_brute_force_agrees_on_every_point(kind, slope_norm):
    random = np.random.default_rng(7)
    for _ in range(15):
        points = cloud(kind, random)
        parameters = SlopeFilter(
            preset="whitebox",
            search_radius=random.choice([0.5, 1.0, 2.0, 5.0, 12.0]),
            min_neighbours=random.choice([0, 0, 3, 10, 50]),
            slope_threshold=random.choice([0.0, 15.0, 45.0, 70.0]),
            height_threshold=random.choice([0.0, 0.5, 1.0, 2.0]),
            slope_norm=slope_norm,
        )
        assert np.array_equal(classify(points, parameters), by_brute_force(points, parameters))


@pytest.mark.rest
def test_brute_force_agrees_on_houses_trees_and_noise():
    points, _ = village(size=24.0)
    for radius in (2.0, 10.0):
        parameters = CLASSIC.resolve(points)
        parameters = dataclasses.replace(parameters, search_radius=radius)
        assert np.array_equal(classify(points, parameters), by_brute_force(points, parameters))


@pytest.mark.rest(but="1.0")
@pytest.mark.parametrize("radius", [0.5, 1.0])
def test_the_classic_filter_gives_the_same_in_blocks_and_in_threads(radius, monkeypatch):
    points, _ = village(size=60.0)
    points = points.take(np.random.default_rng(3).permutation(points.count))
    parameters = dataclasses.replace(CLASSIC.resolve(points), search_radius=radius)
    whole = classify(points, parameters)
    assert 0.5 < whole.mean() < 0.99
    built, strip = [], whitebox._Strip

    def counted(*arguments):
        built.append(arguments)
        return strip(*arguments)

    monkeypatch.setattr(whitebox, "_POINTS_A_STRIP", 500)
    monkeypatch.setattr(whitebox, "_Strip", counted)
    assert np.array_equal(classify(points, parameters), whole)
    assert len(built) >= 9
    with may_use(3):
        assert np.array_equal(classify(points, parameters), whole)


@pytest.mark.parametrize("depth", [3e2, 3e4])
def test_brute_force_agrees_where_an_outlier_makes_the_steps_of_height_coarse(depth):
    points, _ = village(size=20.0)
    points.z[7] -= depth
    parameters = CLASSIC.resolve(points)
    assert np.array_equal(classify(points, parameters), by_brute_force(points, parameters))


def test_brute_force_agrees_on_heights_that_differ_by_less_than_a_step():
    random = np.random.default_rng(5)
    x, y = np.round(random.uniform(0.0, 6.0, (2, 900)), 1)
    points = Points(x, y, random.choice([0.0, 0.004, 1.0 - 1e-12, 1.0, 1.0 + 1e-12, 1.004], 900))
    for top_hat in (True, False):
        parameters = dataclasses.replace(CLASSIC.resolve(points), slope_norm=top_hat)
        assert np.array_equal(classify(points, parameters), by_brute_force(points, parameters))


def test_the_height_and_the_slope_must_both_be_exceeded():
    """A point 1 m off: exactly the height threshold counts, exactly the slope does not."""
    points = Points(np.array([0.0, 1.0]), np.zeros(2), np.array([0.0, 1.0]))
    plain = {"preset": "whitebox", "slope_norm": False, "height_threshold": 1.0}
    assert classify(points, SlopeFilter(**plain, slope_threshold=44.0)).tolist() == [True, False]
    assert classify(points, SlopeFilter(**plain, slope_threshold=46.0)).all()
    plain["height_threshold"] = 1.01
    assert classify(points, SlopeFilter(**plain, slope_threshold=44.0)).all()


def test_the_higher_of_two_points_at_one_place_is_not_ground():
    points = Points(np.zeros(2), np.zeros(2), np.array([5.0, 2.0]))
    assert classify(points, dataclasses.replace(CLASSIC, slope_norm=False)).tolist() == [
        False,
        True,
    ]


def test_a_neighbourhood_with_too_few_points_grows_until_it_has_them():
    x = np.array([0.0, 5.0, 9.0, 30.0])
    points, rule = Points(x, 0.0 * x, x), Neighbours(2.0, 1.0, 0.0, False)
    assert not stands_above(points, rule).any()
    assert stands_above(points, rule, at_least=1).tolist() == [False, False, True, True]
    # The lowest of the two nearest is 0, 0, 0 and 5: the last rises by 25.
    rule = rule._replace(height=24.5)
    assert stands_above(points, rule, at_least=2).tolist() == [False, False, False, True]
    rule = rule._replace(height=25.5)
    assert not stands_above(points, rule, at_least=2).any()
    assert stands_above(points, rule, at_least=3).tolist() == [False, False, False, True]


def test_the_preset_whitebox_stands_for_the_values_of_the_tool():
    points = Points(*np.zeros((3, 1)))
    values = SlopeFilter(
        preset="whitebox", search_radius=2.0, slope_threshold=45.0, height_threshold=1.0
    )
    assert CLASSIC.resolve(points) == values
    assert values.min_neighbours == 0 and values.slope_norm


def test_what_is_chosen_from_the_data_is_said_and_gives_the_same_when_given_by_hand():
    class Heard(Progress):
        def __init__(self):
            self.texts = []

        def info(self, text):
            self.texts.append(text)

    points, _ = village(density=0.02)
    heard = Heard()
    found = classify(points, SlopeFilter(), heard)
    chosen = SlopeFilter().resolve(points)
    assert chosen.cell_size > 2.0 and chosen.search_radius > 25.0
    assert f"search radius {chosen.search_radius:g} m" in heard.texts[0]
    assert f"cell size {chosen.cell_size:g} m" in heard.texts[0]
    by_hand = SlopeFilter(
        search_radius=round(chosen.search_radius, 1),
        slope_threshold=15.0,
        height_threshold=0.5,
        cell_size=round(chosen.cell_size, 1),
        max_building_size=150.0,
    )
    assert by_hand == chosen == chosen.resolve(points)
    assert np.array_equal(classify(points, by_hand, heard), found)
    assert len(heard.texts) == 1


@pytest.mark.rest(but="0.3-0.0")
@pytest.mark.parametrize(("slope", "aspect"), covering([0.3, 0.7, 1.0, 1.5], [0.0, 0.8, 3.0]))
def test_a_plain_slope_is_all_ground_up_to_its_borders(slope, aspect):
    x, y = scatter()
    z = surveyed(x, y, slope * (x * np.cos(aspect) + y * np.sin(aspect)))
    assert classify(Points(x, y, z), SlopeFilter()).mean() > 0.995


def test_a_building_wider_than_twice_the_search_radius_is_taken_for_a_hill():
    x, y = scatter(density=2.0)
    roof = (np.abs(x - 40.0) < 12.0) & (np.abs(y - 40.0) < 12.0)
    points = Points(x, y, surveyed(x, y, np.where(roof, 8.0, 0.0)))
    assert not classify(points, SlopeFilter())[roof].any()
    assert classify(points, SlopeFilter(search_radius=5.0))[roof].mean() > 0.9


@pytest.mark.rest(but="0.0-1.0")
@pytest.mark.parametrize("width", [0.5, 1.0, 1.5])
@pytest.mark.parametrize("slope", [0.0, 0.4])
def test_low_outliers_alone_or_in_clusters_do_not_pull_the_ground_down(width, slope):
    x, y = scatter()
    low = (np.abs(x - 40.0) <= width / 2) & (np.abs(y - 40.0) <= width / 2)
    points = Points(x, y, surveyed(x, y, slope * x - np.where(low, 12.0, 0.0)))
    found = classify(points, SlopeFilter())
    assert not found[low].any()
    assert found[~low].mean() > 0.99


def test_the_slope_of_the_terrain_is_averaged_over_no_more_than_the_search_radius():
    row, column = np.indices((40, 40)) - 20.0
    cone = 8.0 * np.clip(1.0 - np.hypot(row, column) / 10.0, 0.0, 1.0)
    points = Points(2.0 * column.ravel() + 1.0, 2.0 * row.ravel() + 1.0, cone.ravel())
    found = classify(points, SlopeFilter(search_radius=4.0, cell_size=2.0, max_building_size=4.0))
    # Round the top the slopes of all sides cancel out; farther off there would be more of one.
    stands_out = np.hypot(row, column).ravel() <= 1.0
    assert np.array_equal(found, ~stands_out)


def test_one_stray_point_does_not_stop_the_classic_filter():
    points, _ = village(size=20.0)
    points = Points(*(np.append(point, value) for point, value in zip(points, (5e3, 5e3, 0.0))))
    parameters = CLASSIC.resolve(points)
    assert np.array_equal(classify(points, parameters), by_brute_force(points, parameters))


@pytest.mark.rest
def test_presets_by_terrain_give_what_is_left_empty_and_city_sees_a_large_hall():
    x, y = np.random.default_rng(0).uniform(0.0, 160.0, (2, 30_000))
    hall = (np.abs(x - 80.0) < 40.0) & (np.abs(y - 80.0) < 35.0)
    points = Points(x, y, np.where(hall, 12.0, 0.0))
    resolved = SlopeFilter(preset="city", height_threshold=0.3).resolve(points)
    chosen = resolved.search_radius, resolved.slope_threshold, resolved.height_threshold
    assert chosen == (50.0, 15.0, 0.3)
    assert not classify(points, resolved)[hall].any()
    assert classify(points, resolved)[~hall].all()
