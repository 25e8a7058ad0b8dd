"""Clouds from images: their edges are rounded, so that walls are slopes with a foot."""

import numpy as np
import pytest

from bare_earth import Progress
from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.filters.stages.densify import Densification
from bare_earth.algorithms.filters.tin import METHOD, TinDensification

WALL, REACH, HEIGHT = 6.0, 0.5, 4.0


@pytest.fixture(scope="module")
def block():
    """Points 0.15 m apart round a block whose foot begins half a metre before its wall."""
    x, y = (axis.ravel() for axis in np.meshgrid(*[np.arange(0.07, 30.0, 0.15)] * 2))
    before = np.maximum(np.abs(x - 15.0), np.abs(y - 15.0)) - WALL
    foot = 0.4 * np.clip(1.0 - before / REACH, 0.0, 1.0)
    noise = np.random.default_rng(1).normal(0.0, 0.02, x.size)
    return Points(x, y, np.where(before < 0.0, HEIGHT, foot) + noise), before


@pytest.mark.rest(but="tin-densification")
@pytest.mark.parametrize("method", METHODS.values(), ids=METHODS)
def test_the_foot_of_a_wall_is_ground_in_images_only(block, method):
    points, before = block
    one_return = np.zeros(points.count, dtype=bool)
    parameters = method.parameters()
    of_images = method.ground(points, parameters, multi_return=one_return).ground
    of_laser = method.ground(points, parameters).ground
    foot = (before > 0.1) & (before < 0.25)
    assert of_images[foot].mean() > 0.8 > 0.6 > of_laser[foot].mean()
    assert of_images[before > 1.0].all()
    assert not of_images[before < 0.0].any()


def test_the_distance_for_images_is_not_for_a_distance_that_was_given(block):
    points, _ = block

    def in_images(**values):
        rules = METHOD.pipeline(points, TinDensification(**values), Progress()).rules
        (rule,) = (part for part in rules if isinstance(part, Densification))
        return rule.in_images

    assert in_images() == Densification().in_images == 0.5
    assert in_images(iteration_distance=1.4) is None
    assert in_images(preset="site") is None
    assert in_images(preset="lidar360") is None
