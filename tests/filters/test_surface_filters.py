"""What the slope filter and the grid filter have in common, on scenes with known truth."""

import numpy as np
import pytest
from matrices import quick

from bare_earth import Progress
from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.filters import METHODS
from benchmarks.scenes.simple import (
    dense_canopy,
    large_hall,
    scatter,
    surveyed,
    terraces,
    village,
)

pytestmark = pytest.mark.parametrize("name", ["slope", "grid-minimum"])


def classify(name, points, **values):
    method = METHODS[name]
    return method.classify(points, method.parameters(**values), Progress())


@pytest.mark.rest(but="0.1-slope")
@pytest.mark.parametrize("slope", quick([0.0, 0.05, 0.1], 0.1))
def test_a_hall_of_120_by_80_m_goes_on_level_ground_and_on_a_slope(name, slope):
    points, ground = large_hall(slope)
    found = classify(name, points)
    assert not found[~ground].any()
    assert found[ground].mean() > 0.99


def test_terraces_between_walls_stay(name):
    assert classify(name, terraces()).mean() > 0.95


@pytest.mark.rest(but="slope")
def test_the_few_points_that_see_the_ground_under_a_canopy_are_ground(name):
    points, ground = dense_canopy()
    found = classify(name, points)
    assert found[ground].mean() > 0.9
    assert not found[~ground].any()


def test_an_even_slope_is_ground_from_top_to_bottom_of_each_cell(name):
    x, y = scatter(density=1.0)
    points = Points(x, y, surveyed(x, y, 0.8 * x))
    assert classify(name, points).mean() > 0.99


@pytest.mark.rest(but="slope")
def test_a_larger_tolerance_never_takes_ground_away(name):
    points, _ = village(slope=0.2)
    narrow = classify(name, points, ground_tolerance=0.1, slope_tolerance=0.7)
    wide = classify(name, points, ground_tolerance=0.4, slope_tolerance=1.4)
    assert np.all(wide[narrow]) and wide.sum() > narrow.sum()
