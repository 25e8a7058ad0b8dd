"""The minimum-Z grid filter on scenes with known truth, and on the labelled samples."""

import numpy as np
import pytest
from runs import Heard

from bare_earth import BareEarthError
from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.filters.grid_minimum import METHOD, PRESETS, GridMinimum
from benchmarks.scenes.simple import error, scatter, surveyed, village

classify = METHOD.classify


def flat(density: float = 8.0, size: float = 80.0) -> Points:
    x, y = scatter(size, density)
    return Points(x, y, surveyed(x, y, np.full(len(x), 20.0)))


@pytest.mark.rest(but="12.0")
@pytest.mark.parametrize("width", [4.0, 12.0, 30.0])
def test_a_roof_goes_with_the_rim_that_bounds_it(width):
    points = flat()
    roof = (np.abs(points.x - 40.0) < width / 2) & (np.abs(points.y - 40.0) < width / 2)
    points.z[roof] += 7.0
    found = classify(points, GridMinimum())
    assert not found[roof].any()
    assert found[~roof].mean() > 0.99


def test_hills_and_plain_slopes_are_all_ground():
    x, y = scatter(density=8.0)
    hill = 12.0 * np.exp(-((x - 40.0) ** 2 + (y - 40.0) ** 2) / 300.0)
    assert classify(Points(x, y, surveyed(x, y, hill)), GridMinimum()).mean() > 0.99
    assert classify(Points(x, y, surveyed(x, y, 0.7 * x)), GridMinimum()).mean() > 0.99


def test_a_terrace_above_a_wall_is_ground():
    x, y = scatter(density=8.0)
    points = Points(x, y, surveyed(x, y, np.where(x > 40.0, 3.0, 0.0)))
    assert classify(points, GridMinimum()).mean() > 0.97


def test_bushes_above_the_final_height_are_removed():
    points = flat()
    bushes = np.zeros(points.count, dtype=bool)
    for east, north in ((20.0, 20.0), (50.0, 30.0), (30.0, 60.0)):
        bushes |= np.hypot(points.x - east, points.y - north) < 2.0
    points.z[bushes] += 0.9
    assert not classify(points, GridMinimum())[bushes].any()
    kept = classify(points, GridMinimum(final_height=2.0, ground_tolerance=1.0))
    assert kept[bushes].mean() > 0.9


def test_a_smaller_final_height_never_adds_ground():
    points, _ = village(slope=0.2)
    least = classify(points, GridMinimum(final_height=0.2))
    most = classify(points, GridMinimum(final_height=1.0))
    assert least.sum() <= most.sum()


@pytest.mark.parametrize("radius", [0.6, 1.0])
def test_a_cluster_of_low_noise_does_not_pull_the_ground_down(radius):
    points = flat()
    near = np.hypot(points.x - 40.0, points.y - 40.0) < radius
    low = near & (np.random.default_rng(6).random(points.count) < 0.5)
    points.z[low] -= np.random.default_rng(7).uniform(5.0, 20.0, int(low.sum()))
    found = classify(points, GridMinimum())
    assert not found[low].any()
    assert found[~low].mean() > 0.99


def test_gaps_in_the_canopy_are_ground_and_not_noise():
    points = flat(density=12.0)
    random = np.random.default_rng(8)
    crown = random.random(points.count) < 0.85
    points.z[crown] += random.uniform(3.0, 20.0, int(crown.sum()))
    found = classify(points, GridMinimum())
    assert not found[crown].any()
    assert found[~crown].mean() > 0.97


@pytest.mark.parametrize("density, cell", [(0.2, "2.5 m"), (1.0, "1 m")])
def test_cells_grow_with_the_distance_of_the_points_and_the_log_tells(density, cell):
    size = 80.0 if density == 1.0 else 250.0
    points = flat(density, size)
    roof = (np.abs(points.x - 40.0) < 15.0) & (np.abs(points.y - 40.0) < 15.0)
    points.z[roof] += 7.0
    log = Heard()
    found = classify(points, GridMinimum(), log)
    assert len(log.infos) == 1 and not log.warnings
    assert "preset automatic" in log.infos[0] and f"cell size {cell}, " in log.infos[0]
    assert error(found, ~roof) < 1.0


def test_cells_stay_as_wanted_where_points_are_dense_enough_even_in_part_of_the_rectangle():
    points = flat(7.0)
    log = Heard()
    classify(points.take(np.abs(points.x - points.y) < 15.0), GridMinimum(), log)
    assert f"cell size {PRESETS['automatic'].cell_size:g} m" in log.infos[0]


@pytest.mark.parametrize("parameters", [GridMinimum(cell_size=0.5), GridMinimum(preset="paper")])
def test_cells_given_by_hand_or_by_the_paper_stay_and_a_warning_tells_of_gaps(parameters):
    log, points = Heard(), flat(1.0)
    assert parameters.resolve(points).cell_size == 0.5
    classify(points, parameters, log)
    assert len(log.warnings) == 1 and "cells of 0.5 m" in log.warnings[0]
    assert "cell size of 1 m" in log.warnings[0]


def test_the_log_says_which_values_the_preset_chose_and_they_give_the_same_again():
    points, _ = village(0.2, density=1.0)
    told, silent = Heard(), Heard()
    found = classify(points, GridMinimum(preset="hilly"), told)
    chosen = GridMinimum(preset="hilly").resolve(points)
    heights = ", ".join(f"{height:g}" for height in chosen.height_thresholds)
    (info,) = told.infos
    for value in (
        "preset hilly",
        f"cell size {chosen.cell_size:g} m",
        f"height thresholds {heights} m",
        f"final height {chosen.final_height:g} m",
        f"maximum object size {chosen.max_object_size:g} m",
    ):
        assert value in info
    by_hand = GridMinimum(
        "hilly",
        chosen.cell_size,
        chosen.height_thresholds,
        chosen.final_height,
        chosen.max_object_size,
        chosen.ground_tolerance,
        chosen.slope_tolerance,
    )
    assert by_hand == chosen == chosen.resolve(points)
    assert np.array_equal(classify(points, by_hand, silent), found)
    assert not silent.infos and not silent.warnings


def test_a_preset_gives_what_is_left_empty_and_nothing_else():
    resolved = GridMinimum(preset="city", final_height=0.7, height_thresholds=[3.0]).resolve(flat())
    assert resolved.final_height == 0.7 and resolved.height_thresholds == (3.0,)
    assert resolved.max_object_size == PRESETS["city"].max_object_size
    paper = GridMinimum(preset="paper").resolve(flat(0.5))
    assert (paper.cell_size, paper.height_thresholds, paper.final_height) == (
        0.5, (5.0, 4.5, 2.0), 0.3,
    )  # fmt: skip


@pytest.mark.rest
def test_the_preset_says_how_large_a_hall_may_be():
    x, y = scatter(size=120.0, density=4.0)
    hall = (np.abs(x - 60.0) < 30.0) & (np.abs(y - 60.0) < 30.0)
    points = Points(x, y, surveyed(x, y, np.where(hall, 14.0, 0.0)))
    assert classify(points, GridMinimum(preset="steep"))[hall].mean() > 0.9
    for preset in ("automatic", "town", "city"):
        found = classify(points, GridMinimum(preset=preset))
        assert not found[hall].any() and found[~hall].mean() > 0.97


@pytest.mark.parametrize("heights", [(), (2.0, 5.0), (5.0, -1.0), ("five",), 5.0])
def test_height_thresholds_must_be_a_descending_list_of_heights(heights):
    with pytest.raises(BareEarthError, match="Height thresholds"):
        GridMinimum(height_thresholds=heights)


def test_one_height_threshold_is_a_list_too():
    points, truth = village()
    assert GridMinimum(height_thresholds=[3]).height_thresholds == (3.0,)
    assert error(classify(points, GridMinimum(height_thresholds=[3])), truth) < 4.0
