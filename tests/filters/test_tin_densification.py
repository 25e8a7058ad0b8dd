"""TIN densification on scenes with known truth, and on the labelled samples where they are."""

import numpy as np
import pytest

from bare_earth import Progress
from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.filters.tin import METHOD, TinDensification
from bare_earth.algorithms.tin.triangulation import Tin
from benchmarks.scenes.simple import error, scatter, surveyed, village

classify = METHOD.classify


def test_a_plain_slope_is_all_ground():
    x, y = scatter()
    points = Points(x, y, surveyed(x, y, 0.7 * x))
    assert classify(points, TinDensification()).mean() > 0.995


def test_a_terrace_with_a_bank_too_steep_for_the_seeds_is_regained_by_densification():
    x, y = scatter(density=6.0)
    points = Points(x, y, surveyed(x, y, np.where(x > 40.0, 3.0, 0.0)))
    assert error(classify(points, TinDensification()), np.ones(points.count, dtype=bool)) < 2.0


@pytest.mark.rest
def test_a_bush_in_a_gap_below_trees_is_not_ground_and_a_mound_is():
    x, y = scatter()
    around = np.hypot(x - 40.0, y - 40.0) > 8.0
    x, y = x[around], y[around]
    bush = Points(*np.array([[37.5, 42.5, 40.5], [38.5, 37.5, 42.5], [0.8, 1.2, 0.9]]))
    mound = Points(*np.array([[39.5, 40.5, 40.5], [39.5, 39.5, 40.5], [1.05, 1.15, 1.1]]))
    for extra, expected in ((bush, False), (mound, True)):
        points = Points(*map(np.append, Points(x, y, surveyed(x, y, 0.0 * x)), extra))
        found = classify(points, TinDensification())
        assert found[:-3].all()
        assert (found[-3:] == expected).all()


@pytest.mark.rest
def test_a_building_wider_than_the_maximum_building_size_is_taken_for_a_hill():
    x, y = scatter(density=2.0)
    roof = (np.abs(x - 40.0) < 12.0) & (np.abs(y - 40.0) < 12.0)
    points = Points(x, y, surveyed(x, y, np.where(roof, 8.0, 0.0)))
    assert not classify(points, TinDensification(max_building_size=40.0))[roof].any()
    assert classify(points, TinDensification(max_building_size=10.0))[roof].mean() > 0.9


@pytest.mark.rest
def test_a_smaller_iteration_distance_never_adds_ground():
    points, _ = village(slope=0.4)
    near = classify(points, TinDensification(iteration_distance=0.2, iteration_angle=30.0))
    far = classify(points, TinDensification(iteration_distance=3.0, iteration_angle=30.0))
    assert near.sum() <= far.sum()


@pytest.mark.rest
def test_the_log_says_which_values_the_preset_chose_and_they_give_the_same_again():
    class Heard(Progress):
        def __init__(self):
            self.texts = []

        def info(self, text):
            self.texts.append(text)

    points, _ = village()
    heard, silent = Heard(), Heard()
    found = classify(points, TinDensification(), heard)
    assert "building size 150 m, iteration angle 15 deg" in heard.texts[0]
    resolved = TinDensification().resolve(points)
    assert np.array_equal(classify(points, resolved, silent), found)
    assert not silent.texts


def test_a_preset_gives_what_is_left_empty_and_nothing_else():
    points, _ = village()
    resolved = TinDensification(preset="lidar360", iteration_angle=9.0).resolve(points)
    chosen = resolved.max_building_size, resolved.iteration_angle, resolved.iteration_distance
    assert chosen == (20.0, 9.0, 1.4)


@pytest.mark.rest
def test_automatic_looks_for_halls_larger_than_usual():
    x, y = scatter(size=200.0, density=1.5)
    hall = (np.abs(x - 100.0) < 40.0) & (np.abs(y - 100.0) < 35.0)
    points = Points(x, y, surveyed(x, y, np.where(hall, 14.0, 0.0)))
    ground = classify(points, TinDensification())
    assert not ground[hall].any() and ground[~hall].mean() > 0.98
    assert classify(points, TinDensification(max_building_size=30.0))[hall].mean() > 0.9


@pytest.mark.rest
def test_known_ground_is_a_seed_where_the_grid_sees_an_object():
    x, y = scatter(density=6.0)
    mound = np.hypot(x - 40.0, y - 40.0) < 8.0
    points = Points(x, y, surveyed(x, y, np.where(mound, 5.0, 0.0)))
    assert not classify(points, TinDensification())[mound].any()
    known = mound & (np.random.default_rng(3).random(points.count) < 0.3)
    assert classify(points, TinDensification(), known_ground=known)[mound].mean() > 0.9


@pytest.mark.rest
def test_key_points_are_few_and_their_tin_is_within_the_tolerance():
    points, _ = village()
    ground = classify(points, TinDensification())
    key = classify(points, TinDensification(only_key_points=True))
    assert 0 < key.sum() < 0.3 * ground.sum()
    assert not (key & ~ground).any()
    surface = Tin(*points.take(key)).interpolate(points.x[ground], points.y[ground])
    off = np.abs(points.z[ground] - surface)
    assert np.nanmax(off) <= 0.15 + 1e-6
