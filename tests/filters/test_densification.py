"""When a point joins the TIN: the limits of Axelsson (2000), computed here corner by corner."""

import dataclasses
import math

import numpy as np
import pytest

from bare_earth import Progress
from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.filters.stages.densify import Densification
from bare_earth.algorithms.filters.state import GridState, State

# Every second row is moved by half a spacing: no four vertices lie on one circle.
SEEDS = np.array([(10.0 * i + 5.0 * (k % 2), 10.0 * k) for k in range(7) for i in range(7)])
CORNERS = np.array([(30.0, 20.0), (40.0, 20.0), (35.0, 30.0)])
INSIDE = np.array([(36.0, 23.5)])
LONGEST = math.hypot(5.0, 10.0)
RULES = Densification(
    iteration_angle=90.0, iteration_distance=50.0, max_terrain_angle=89.0,
    reduce_angle_edge=None, stop_edge=None, noise_distance=0.0, level=None,
)  # fmt: skip


def plane(xy):
    return 0.5 * xy[:, 0] - 0.3 * xy[:, 1]


def joining(candidates, heights, surface=plane, **rules):
    """Return which candidates join vertices on a surface."""
    xy, z = np.vstack((SEEDS, candidates)), np.append(surface(SEEDS), heights)
    points, first = Points(*xy.T.copy(), z), np.arange(len(SEEDS))
    candidates = np.arange(len(SEEDS), len(xy))
    state = State(points, Progress(), seeds=first, candidates=candidates)
    state.spacing, state.grids = 10.0, [GridState.of(points, 10.0, 2.0)]
    dataclasses.replace(RULES, **rules).apply(state)
    return np.isin(candidates, state.seeds)


def joins(height, **rules):
    """Return whether a point so high above the plane joins."""
    return bool(joining(INSIDE, plane(INSIDE) + height, **rules)[0])


def distance(height):
    return height / math.sqrt(1.0 + 0.5**2 + 0.3**2)


def angle(height):
    """Return the largest angle at a corner between the facet and the line to the point, deg."""
    corners = np.column_stack((CORNERS, plane(CORNERS)))
    nearest = np.linalg.norm(corners - [*INSIDE[0], plane(INSIDE)[0] + height], axis=1).min()
    return math.degrees(math.asin(distance(height) / nearest))


@pytest.mark.parametrize("height", [0.2, 1.0, 3.0])
def test_the_distance_is_that_to_the_facet(height):
    assert joins(height, iteration_distance=1.001 * distance(height))
    assert not joins(height, iteration_distance=0.999 * distance(height))


@pytest.mark.parametrize("height", [0.2, 1.0, 3.0])
def test_the_angle_is_the_largest_at_a_corner(height):
    assert joins(height, iteration_angle=1.001 * angle(height))
    assert not joins(height, iteration_angle=0.999 * angle(height))


@pytest.mark.parametrize("share", [0.5, 0.9, 1.0, 2.0])
def test_in_triangles_with_shorter_edges_the_angle_is_less_in_proportion(share):
    rules = {"reduce_angle_edge": LONGEST / share}
    allowed = angle(1.0) / min(share, 1.0)
    assert joins(1.0, iteration_angle=1.001 * allowed, **rules)
    assert not joins(1.0, iteration_angle=0.999 * allowed, **rules)


def test_triangles_with_short_edges_take_nothing():
    assert joins(0.5, stop_edge=0.999 * LONGEST)
    assert not joins(0.5, stop_edge=1.001 * LONGEST)


def test_what_is_as_close_as_noise_joins_at_any_angle():
    assert joins(0.5, iteration_angle=0.01, noise_distance=1.001 * distance(0.5))
    assert not joins(0.5, iteration_angle=0.01, noise_distance=0.999 * distance(0.5))


def test_the_lowest_distance_joins_first_and_bears_the_others():
    # The second lies too far off the first facet, but not off those that the first one makes.
    two, heights = np.array([(36.0, 24.0), (35.0, 23.0)]), np.array([2.0, 2.6])
    flat = {"surface": lambda xy: 0.0 * xy[:, 0], "iteration_distance": 2.1}
    assert joining(two, heights, **flat).tolist() == [True, True]
    assert joining(two[1:], heights[1:], **flat).tolist() == [False]


def step(xy):
    """Return a wall between x = 30 and x = 40, below land that rises to the north."""
    return np.where(xy[:, 0] > 32.0, 8.0 + 0.2 * xy[:, 1], 0.0)


def test_beyond_a_facet_that_is_too_steep_the_mirror_image_is_judged():
    # The nearest vertex of the first two is (40, 20), and their images lie on the upper land.
    at = np.array([(38.5, 20.5), (38.5, 20.5), (31.0, 20.3)])
    image = 2.0 * np.array([(40.0, 20.0), (40.0, 20.0), (30.0, 20.0)]) - at
    heights = step(image) + np.array([0.0, 0.1, 0.0])
    rules = {"surface": step, "noise_distance": 0.01, "iteration_angle": 0.1}
    for value, expected in ((0, True), (1, False), (2, True)):
        one = at[value : value + 1], heights[value : value + 1]
        assert joining(*one, max_terrain_angle=30.0, **rules).tolist() == [expected]
        assert not joining(*one, max_terrain_angle=80.0, **rules).any()


def test_far_from_the_surface_a_point_needs_a_neighbour_at_its_level():
    two = np.array([(33.0, 23.0), (35.0, 23.0)])  # in cells side by side
    rules = {"level": 0.3, "noise_distance": 0.2}
    alone = plane(two[:1]) + 1.0
    assert joining(two[:1], alone).all()
    assert not joining(two[:1], alone, **rules).any()
    assert joining(two[:1], alone - 0.81, **rules).all()
    assert joining(two, plane(two) + np.array([1.0, 1.2]), **rules).any()
    assert not joining(two, plane(two) + np.array([1.0, 1.7]), **rules).any()
