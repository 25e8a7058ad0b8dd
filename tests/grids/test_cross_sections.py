"""Cross-sections that are raised at both ends, on profiles whose heights are written down."""

import numpy as np
import pytest

from bare_earth.algorithms.grids.bridge_relief import BridgeRelief
from bare_earth.algorithms.grids.bridge_sections import SectionRule, Sections, raised_sections

RULE = SectionRule(1.25, 1.0, True)
LENGTH, BORDER = 40, 12


def widest(profile, is_ground=None, rule=RULE):
    """Return how many metres the widest cross-section from west to east is wide; 0 for none.

    Points lie a metre apart, as cells do, and the profile is the same in each row.
    """
    profile = np.asarray(profile, dtype=np.float32)
    is_ground = np.isfinite(profile) if is_ground is None else is_ground
    heights, is_ground = (np.tile(value, (LENGTH, 1)) for value in (profile, is_ground))
    heights = np.pad(heights, BORDER, constant_values=np.nan)
    relief = BridgeRelief(1.0, 1.0, BORDER, 0, 0.0, heights, np.pad(is_ground, BORDER))
    sections = raised_sections(relief, lambda relief: np.isfinite(relief.heights), rule)
    return int((sections.steps[sections.direction == 0] + 1).max(initial=0))


def profile_of(*parts):
    """Return heights: each part is a height and over how many metres it goes on."""
    return np.concatenate([np.full(metres, height) for height, metres in parts])


GROUND = (0.0, 14)


@pytest.mark.parametrize("trees, width", [(6, 8), (7, 0)])
def test_the_ground_begins_at_most_six_metres_and_a_spacing_beyond_an_edge(trees, width):
    profile = profile_of(GROUND, (6.0, trees), (16.0, 8), (6.0, trees), GROUND)
    assert widest(profile, profile != 6.0) == width


@pytest.mark.parametrize("rise, width", [(1.13, 8), (1.15, 7)])
def test_the_ends_may_differ_by_half_a_metre_and_a_share_of_the_width(rise, width):
    deck = 12.0 + np.linspace(0.0, rise, 8)
    assert widest(np.concatenate((profile_of(GROUND), deck, profile_of(GROUND)))) == width


@pytest.mark.parametrize("step, width", [(0.39, 12), (0.41, 6)])
def test_a_surface_ends_at_a_step_far_from_its_edge_too(step, width):
    assert widest(profile_of(GROUND, (12.0, 6), (12.0 + step, 6), GROUND)) == width


@pytest.mark.parametrize("gap, width", [(2, 14), (3, 0)])
def test_a_surface_goes_on_across_a_gap_of_less_than_three_metres(gap, width):
    assert widest(profile_of(GROUND, (12.0, 6), (np.nan, gap), (12.0, 6), GROUND)) == width


@pytest.mark.parametrize("pit, width", [(4, 0), (5, 8)])
def test_beyond_its_foot_the_ground_stays_low_for_four_metres(pit, width):
    bank, pit = (12.0, 10), (0.0, pit)
    assert widest(profile_of(bank, pit, (12.0, 8), (0.0, 12), bank)) == width


@pytest.mark.parametrize("pit, width", [(8, 0), (11, 8)])
def test_land_between_two_ditches_is_no_surface_of_a_bridge(pit, width):
    bank, pit = (12.0, 20), (0.0, pit)
    assert widest(profile_of(bank, pit, (12.0, 8), pit, bank)) == width


@pytest.mark.parametrize("height, width", [(11.0, 8), (8.0, 0), (4.0, 0), (1.0, 8)])
def test_no_ground_lies_on_the_middle_half_of_a_face(height, width):
    face = (height, 2)
    profile = profile_of(GROUND, face, (12.0, 8), face, GROUND)
    # The rule takes only what lies at the foot for lower.
    assert widest(profile, rule=SectionRule(9.0, 1.0, True)) == width


@pytest.mark.parametrize(
    "height, is_ground, width", [(6.5, True, 8), (7.5, True, 0), (6.5, False, 0)]
)
def test_beyond_a_void_the_ground_is_lower_by_more_the_wider_it_is(height, is_ground, width):
    beyond, void = (height, 10), (np.nan, 20)
    profile = profile_of(beyond, void, (10.0, 8), void, beyond)
    known = np.isfinite(profile)
    assert widest(profile, known & (is_ground | (profile == 10.0))) == width


def test_directions_turn_from_east_to_north():
    direction = np.array([0, 12, 24])  # of 96 in a whole turn
    angles = Sections(np.zeros(3, int), direction, np.zeros(3, int)).angles
    assert np.allclose(np.degrees(angles), [0.0, 45.0, 90.0])
