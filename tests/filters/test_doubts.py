"""What a filter is not sure of is told, once and in words."""

import numpy as np
import pytest
from matrices import quick
from runs import Heard, memory_store
from surveys import cloud_of

from bare_earth.algorithms.engine.blocks import Blocks
from bare_earth.algorithms.engine.memory import Resources
from bare_earth.algorithms.engine.visits import Work, visited
from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.las.cloud import survey_frame
from bare_earth.algorithms.tools.ground.step import LabelGround
from benchmarks.clouds import classify_cloud

EXTENT, LITTLE, OUTLIERS = "the points reach less than", "Hardly any ground", "low outliers"


def land(width, depth, outliers=0.0, density=2.0, seed=4):
    """Return a cloud of level land, some of whose points lie 20 m too low."""
    random = np.random.default_rng(seed)
    count = round(width * depth * density)
    x, y = random.uniform(0, width, count), random.uniform(0, depth, count)
    z = random.normal(0, 0.03, count)
    z[random.random(count) < outliers] -= random.uniform(15, 60)
    return cloud_of(*(np.round(values * 100) for values in (x, y, z)))


def warnings_of(cloud, parameters):
    progress = Heard()
    classify_cloud(cloud, parameters, progress=progress)
    return progress.warnings


@pytest.mark.rest(but="tin-densification")
@pytest.mark.parametrize("method", METHODS.values(), ids=METHODS)
def test_a_wide_and_clean_survey_is_not_doubted(method):
    assert warnings_of(land(150, 150, outliers=0.001), method.parameters()) == []


@pytest.mark.parametrize("name", quick(METHODS, "slope"))
def test_an_extent_smaller_than_the_largest_object_is_told(name):
    method = METHODS[name]
    (warning,) = warnings_of(land(150, 30), method.parameters())
    assert EXTENT in warning
    labels = {declared.name: declared.label for declared in method.parameters.declarations()}
    assert labels[method.size_parameter] in warning


@pytest.mark.rest(but="tin-densification")
@pytest.mark.parametrize(
    ("name", "values", "width"),
    [
        ("tin-densification", {"max_building_size": 20.0}, 20),
        ("grid-minimum", {"preset": "city"}, 120),
        ("slope", {"search_radius": 10.0}, 20),
        ("slope", {"max_building_size": 25.0}, 25),
        ("slope", {"preset": "whitebox"}, 4),
    ],
)
def test_the_size_is_what_was_given(name, values, width):
    parameters = METHODS[name].parameters(**values)
    assert METHODS[name].largest_object(parameters) == width
    told = [EXTENT in "".join(warnings_of(land(140, side), parameters)) for side in (3, 135)]
    assert told == [True, False]


@pytest.mark.rest
def test_the_same_warning_of_several_blocks_is_told_once():
    cloud, progress = land(400, 30), Heard()
    blocks = Blocks(100.0, 50.0)
    part = (cloud, np.ones(cloud.count, bool))
    store = memory_store([part], survey_frame(cloud.crs), blocks)
    step = LabelGround(METHODS["grid-minimum"].parameters(), cut=blocks)
    visited([Work(step, store)], Resources(), progress)
    (warning,) = progress.warnings
    assert EXTENT in warning and "blocks" not in warning


def test_hardly_any_ground_is_told():
    # Crowns all over: of the points of a wide disc only the lowest stands above no other.
    crowns = land(100, 100)
    crowns.z[:] = np.random.default_rng(1).uniform(0, 2000, crowns.count)
    values = {"search_radius": 8.0, "slope_threshold": 0.0, "height_threshold": 0.01}
    strict = METHODS["slope"].parameters(preset="whitebox", slope_norm=False, **values)
    (warning,) = warnings_of(crowns, strict)
    assert LITTLE in warning and "2 %" in warning


@pytest.mark.rest
@pytest.mark.parametrize("name", quick(METHODS, "grid-minimum"))
def test_many_low_outliers_are_told(name):
    parameters = METHODS[name].parameters()
    (warning,) = warnings_of(land(150, 150, outliers=0.04), parameters)
    assert OUTLIERS in warning and "class 7" in warning
