"""Low banks stay: a hedge, a wall and a row of plants of the same size go."""

import numpy as np
import pytest
from matrices import covering

from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.filters import METHODS
from benchmarks.scenes.simple import scatter, surveyed


def _field(density, height, width, upright=False, bend=0.0):
    """Return places, heights, and how high above a slope points lie on ridges 30 m apart."""
    x, y = scatter(100.0, density)
    along, across = 0.96 * x + 0.28 * y, 0.96 * y - 0.28 * x
    off = np.abs((across + bend * np.sin(along / 9.0)) % 30.0 - 15.0) / (0.5 * width)
    shape = off < 1.0 if upright else 0.5 * (1.0 + np.cos(np.pi * np.minimum(off, 1.0)))
    raised = height * shape
    return x, y, 50.0 + 0.03 * x, raised


def _kept(method, x, y, z, which):
    parameters = METHODS[method].parameters()
    return METHODS[method].classify(Points(x, y, z), parameters)[which].mean()


@pytest.mark.rest(but="tin-densification")
@pytest.mark.parametrize(
    ("bank", "method"),
    covering(
        [(4.0, 0.5, 4.0, 0.0), (4.0, 1.2, 5.0, 0.5), (12.0, 0.8, 5.0, 1.0), (2.0, 0.6, 4.0, 0.0)],
        list(METHODS),
    ),
)
def test_banks_stay(method, bank):
    density, height, width, bend = bank
    x, y, land, raised = _field(density, height, width, bend=bend)
    z = surveyed(x, y, land + raised)
    assert _kept(method, x, y, z, raised > 0.5 * height) > 0.75
    assert _kept(method, x, y, z, raised < 0.01) > 0.99


@pytest.mark.rest(but="tin-densification")
@pytest.mark.parametrize(("method", "bank"), covering(list(METHODS), [(0.8, 4.0), (1.2, 5.0)]))
def test_banks_under_trees_stay(method, bank):
    height, width = bank
    # Two of seven points are below the crowns, a tenth of them on bushes.
    x, y, land, raised = _field(14.0, height, width, bend=0.5)
    random = np.random.default_rng(2)
    below = random.random(len(x)) < 2.0 / 7.0
    on_bush = below & (random.random(len(x)) < 0.1)
    z = surveyed(x, y, land + raised)
    z = np.where(below, z, z + random.uniform(6.0, 15.0, len(x)))
    z = np.where(on_bush, z + random.uniform(0.0, 1.5, len(x)), z)
    assert _kept(method, x, y, z, (raised > 0.5 * height) & below & ~on_bush) > 0.5


@pytest.mark.rest(but="tin-densification")
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize(("height", "width"), [(0.6, 1.5), (1.2, 3.0)])
def test_rows_of_plants_as_high_and_wide_as_a_bank_go(method, height, width):
    x, y, land, raised = _field(4.0, height, width)
    # Pulses end anywhere between the leaves and the ground.
    z = surveyed(x, y, land + raised * np.random.default_rng(3).uniform(0.0, 1.0, len(x)))
    assert _kept(method, x, y, z, z - land > 0.35) < 0.08


@pytest.mark.rest(but="tin-densification")
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("width", [1.0, 2.0])
def test_walls_go(method, width):
    x, y, land, raised = _field(4.0, 1.4, width, upright=True)
    z = surveyed(x, y, land + raised)
    assert _kept(method, x, y, z, raised > 0.0) < 0.05


@pytest.mark.rest(but="slope")
@pytest.mark.parametrize("method", METHODS)
def test_strips_of_long_grass_go(method):
    # As below a fence: half a metre wide.
    x, y, land, raised = _field(4.0, 0.4, 0.5, upright=True)
    z = surveyed(x, y, land + raised)
    assert _kept(method, x, y, z, raised > 0.0) < 0.1


@pytest.mark.rest(but="tin-densification")
@pytest.mark.parametrize("method", METHODS)
def test_cars_in_a_row_go(method):
    x, y, land, raised = _field(8.0, 1.4, 1.8)
    raised = np.where((0.96 * x + 0.28 * y) % 5.5 < 4.4, raised, 0.0)
    z = surveyed(x, y, land + raised)
    assert _kept(method, x, y, z, raised > 0.7) < 0.05


@pytest.mark.rest(but="tin-densification")
@pytest.mark.parametrize("method", METHODS)
def test_a_bank_is_the_same_in_any_order_of_the_points(method):
    x, y, land, raised = _field(4.0, 0.8, 3.0)
    z = surveyed(x, y, land + raised)
    order = np.random.default_rng(5).permutation(len(x))
    parameters = METHODS[method].parameters()
    found = METHODS[method].classify(Points(x, y, z), parameters)
    shuffled = METHODS[method].classify(Points(x[order], y[order], z[order]), parameters)
    assert np.array_equal(shuffled, found[order])
