"""The levels of water that branches, goes round islands, or flows into a lake, on known land."""

import numpy as np
import pytest
from realdata import real
from water_scenes import Scene, written_water

from bare_earth.algorithms.tools.water.descent import Network, descent
from bare_earth.algorithms.tools.water.reaches import reaches_of

CELL = 2.5


def segment(x, y, start, end):
    """Return the distances of places from a straight line, and how far along it they are."""
    (west, south), (run, rise) = start, np.subtract(end, start)
    share = np.clip(((x - west) * run + (y - south) * rise) / (run**2 + rise**2), 0.0, 1.0)
    return np.hypot(x - west - share * run, y - south - share * rise), share


class Channels:
    """Water of several channels, lakes and islands.

    A channel is its corners (x, y, level) and half its width, a lake the middle, radius and level,
    an island the middle and radius.
    """

    def __init__(self, channels=(), lakes=(), islands=()):
        self.channels, self.lakes, self.islands = channels, lakes, islands

    def at(self, x, y):
        """Return how far places are from the water, negative inside, and its level there."""
        away, level = np.full(np.shape(x), np.inf), np.zeros(np.shape(x))
        for corners, half in self.channels:
            for start, end in zip(corners[:-1], corners[1:]):
                far, share = segment(x, y, start[:2], end[:2])
                nearer = far - half < away
                away = np.where(nearer, far - half, away)
                level = np.where(nearer, start[2] + share * (end[2] - start[2]), level)
        for east, north, radius, height in self.lakes:
            far = np.hypot(x - east, y - north) - radius
            away, level = np.minimum(away, far), np.where(far < away, height, level)
        for east, north, radius in self.islands:
            away = np.maximum(away, radius - np.hypot(x - east, y - north))
        return away, level

    def scene(self, size, left=0.0, seed=1):
        """Return land round the water, with a share of the returns of its surface left."""
        scene = Scene(*size, density=1.0, slope=0.0, rolling=0.3, seed=seed)
        away, level = self.at(scene.x, scene.y)
        land = np.maximum(scene.z, level.max() + 3.0)
        bank = level + 0.4 * np.maximum(away, 0.0) + scene.random.normal(0, 0.03, len(away))
        scene.z = np.where(away < 20.0, np.minimum(land, bank), land)
        wet = away < 0
        scene.classes[wet] = 1
        scene.keep(~wet | (scene.random.random(len(wet)) < left))
        return scene

    def water(self, size, **how):
        return self.scene(size, **how).water(CELL)

    def off(self, body):
        """Return how far the level at the shore of a body is from the truth."""
        ring = np.concatenate(body.rings)
        return np.abs(ring[:, 2] - self.at(*ring[:, :2].T)[1])


MAIN = [(10, 150, 100.4), (590, 150, 100.0)]
ROUND = [(180, 120, 100.6), (300, 190, 100.3), (420, 120, 100.0)]
SCENES = {
    "tributary": (
        Channels([(MAIN, 20), ([(300, 340, 101.25), (300, 150, 100.2)], 16)]),
        (600, 350),
        3,
    ),
    "three branches": (
        Channels(
            [
                ([(20, 330, 101.5), (300, 180, 100.0), (580, 180, 99.8)], 18),
                ([(20, 30, 100.8), (300, 180, 100.0)], 16),
            ]
        ),
        (600, 360),
        3,
    ),
    "delta": (
        Channels(
            [
                ([(20, 180, 100.6), (300, 180, 100.3), (580, 330, 99.5)], 18),
                ([(300, 180, 100.3), (580, 30, 98.6)], 16),
            ]
        ),
        (600, 360),
        3,
    ),
    "island": (
        Channels(
            [
                ([(10, 120, 101.0), *ROUND, (590, 120, 99.6)], 20),
                ([(x, 240 - y, level) for x, y, level in ROUND], 16),
            ]
        ),
        (600, 240),
        4,
    ),
    "two rivers that meet at the border": (
        Channels([([(10, 150, 101.2), (300, 30, 100.0), (590, 150, 101.0)], 20)]),
        (600, 180),
        2,
    ),
    "a lake with its river": (
        Channels([([(560, 330, 101.6), (300, 200, 100.0)], 18)], [(170, 180, 120, 100.0)]),
        (600, 360),
        1,
    ),
}


@pytest.mark.rest(but="two rivers that meet at the border")
@pytest.mark.parametrize("name", SCENES)
def test_each_branch_of_a_river_has_its_own_level(name):
    channels, size, branches = SCENES[name]
    (body,) = channels.water(size)
    assert body.kind == "river" and body.grade == "certain"
    assert len(body.lines) == branches
    # The lines meet with one level, and none rises.
    ends = [end for line in body.lines for end in (line[0], line[-1])]
    for end in ends:
        there = [other for other in ends if np.array_equal(end[:2], other[:2])]
        assert np.ptp([other[2] for other in there]) == 0
    assert all((np.diff(line[:, 2]) <= 0).all() for line in body.lines)
    assert np.percentile(channels.off(body), 95) < 0.2 and channels.off(body).max() < 0.3


@pytest.mark.rest(but="45")
@pytest.mark.parametrize("angle", [45, 90])
def test_two_arms_that_join_have_their_own_levels(angle):
    """One falls three times as far as the other, and their banks meet in the last reaches."""
    across = 280 * np.sin(np.radians(angle / 2))
    west = 300 - 280 * np.cos(np.radians(angle / 2))
    join = (300, 250, 100.0)
    arms = (
        [(west, 250 + across, 101.2), join, (590, 250, 99.8)],
        [(west, 250 - across, 102.0), join],
    )
    channels = Channels([(arms[0], 20), (arms[1], 18)])
    (body,) = channels.water((600, 500), left=0.02)
    assert body.grade == "certain" and len(body.lines) == 3
    assert np.percentile(channels.off(body), 95) < 0.05 and channels.off(body).max() < 0.2


def test_a_narrow_tributary_does_not_make_a_river_too_narrow():
    brook = [(300, 380, 101.5), (300, 150, 100.2)], 6
    (body,) = Channels([(MAIN, 17), brook]).water((600, 400), left=0.01)
    assert body.kind == "river" and len(body.lines) == 3 and body.width > 30


def test_returns_from_the_surface_decide_the_level():
    channels, size, _ = SCENES["tributary"]
    (body,) = channels.water(size, left=0.02)
    assert np.percentile(channels.off(body), 95) < 0.1
    lake = Channels((), [(150, 150, 80, 100.0)])
    (body,) = lake.water((300, 300), left=0.02)
    assert body.kind == "lake" and abs(body.level - 100.0) < 0.02


def canal(fall=0.0):
    """Return a canal that falls evenly."""
    return Channels([([(10, 60, 100.0 + fall), (590, 60, 100.0)], 9)])


def with_class_9(channels, where, banks=0.0, left=0.03):
    """Return the scene of a canal 600 m long, whose returns from the water have class 9 in a part
    of it; elsewhere there are none. Its banks rise from east to west.
    """
    scene = channels.scene((600, 120), left=left)
    wet = channels.at(scene.x, scene.y)[0] < 0
    scene.classes[wet] = 9
    scene.z[~wet] += banks * (1.0 - scene.x[~wet] / 600)
    scene.keep(~wet | ((scene.x > where[0]) & (scene.x < where[1])))
    return scene


HOW = {"min_width": 5.0, "min_area": 5000.0}


def test_water_that_class_9_shows_to_be_level_is_level():
    """The banks fall by 0.8 m, the water does not."""
    (river,) = with_class_9(canal(), (300, 300), banks=0.8).water(CELL, **HOW)
    assert river.kind == "river" and river.level - river.lowest > 0.5
    (found,) = with_class_9(canal(), (100, 500), banks=0.8).water(CELL, **HOW)
    assert found.kind == "lake" and found.level == pytest.approx(100.0, abs=0.03)
    assert found.class_share < 0.5


def test_class_9_decides_the_level_of_a_river_that_falls():
    """Its banks are a quay of 0.4 m, and the water beyond the points of class 9 falls as well."""
    channels = canal(fall=2.0)
    for where in ((100, 500), (250, 300)):
        scene = with_class_9(channels, where)
        scene.z[channels.at(scene.x, scene.y)[0] >= 0] += 0.4
        (found,) = scene.water(CELL, **HOW)
        assert found.kind == "river" and found.level == pytest.approx(102.0, abs=0.1)
        assert found.lowest == pytest.approx(100.0, abs=0.1)
        assert np.percentile(channels.off(found), 95) < 0.1


def test_a_weir_beyond_level_points_of_class_9_still_parts_the_water():
    channels = Channels(STEPS["a weir"])
    scene = with_class_9(channels, (260, 590), left=0.05)
    upper, lower = sorted(scene.water(CELL, **HOW), key=lambda body: -body.level)
    assert upper.level == pytest.approx(100.25, abs=0.1)
    assert lower.level == pytest.approx(99.15, abs=0.1)


def test_water_of_class_9_that_the_border_of_the_survey_cuts_is_not_too_small():
    """A tenth of the smallest area is enough; where nothing cuts it, or it is too narrow, not."""
    cut, whole = Channels([([(-9, 60, 100), (90, 60, 100)], 9)]), Channels((), [(75, 60, 25, 100)])
    for channels, count, width in ((cut, 1, 5.0), (cut, 0, 60.0), (whole, 0, 5.0)):
        scene = with_class_9(channels, (0, 600))
        assert len(scene.water(CELL, min_width=width, min_area=5000.0)) == count


def test_a_lake_with_long_arms_has_one_level():
    arms = [([(280, 260, 100.0), corner, far], 13) for corner, far in ARMS]
    channels = Channels(arms, [(280, 260, 60, 100.0)], [(280, 260, 25)])
    (body,) = channels.water((600, 520))
    assert body.kind == "lake" and body.grade == "certain"
    assert channels.off(body).max() < 0.2


ARMS = (((120, 200, 100.0), (30, 30, 100.0)), ((460, 260, 100.0), (560, 490, 100.0)))


def test_water_that_one_level_does_not_explain_is_not_certain():
    """A creek that is too short for a river falls into a lake."""
    channels = Channels([([(330, 150, 101.5), (230, 150, 100.0)], 12)], [(150, 150, 90, 100.0)])
    for body in channels.water((360, 300)):
        assert body.grade != "certain" or channels.off(body).max() < 0.3


def test_a_shore_that_its_level_does_not_explain_is_not_certain():
    """A third of the shore is 0.7 m above the rest."""
    lake = Channels((), [(150, 150, 80, 100.0)])
    scene = lake.scene((300, 300))
    (body,) = scene.water(CELL)
    assert body.grade == "certain"
    scene.z[np.abs(np.arctan2(scene.y - 150, scene.x - 150)) < 1.0] += 0.7
    (body,) = scene.water(CELL)
    assert body.grade == "likely" and abs(body.level - 100.0) < 0.2


def test_levels_on_a_fork_are_those_of_each_branch():
    edges = [(i, i + 1) for i in range(59)] + [(30, 60)] + [(i, i + 1) for i in range(60, 89)]
    truth = np.concatenate((101.0 - 0.01 * np.arange(60), 100.7 + 0.02 * np.arange(1, 31)))
    station = np.repeat(np.arange(90), 2)
    heights = truth[station] + np.random.default_rng(3).normal(0, 0.05, 180)
    heights[::9] += 2.0  # walls
    found = descent(Network(90, np.array(edges)), station, heights)
    assert np.abs(found.levels - truth).max() < 0.15
    assert sorted((chain[0], chain[-1]) for chain in found.chains) == [(0, 30), (30, 59), (89, 30)]
    assert all((np.diff(found.levels[chain]) <= 0).all() for chain in found.chains)


def test_levels_step_where_banks_do():
    truth = np.where(np.arange(60) < 23, 100.0, 95.0)
    station = np.repeat(np.arange(60), 4)
    heights = truth[station] + np.random.default_rng(3).exponential(0.3, 240)
    line = Network(60, np.column_stack((np.arange(59), np.arange(1, 60))))
    assert np.abs(descent(line, station, heights, 10.0).levels - truth).max() < 0.3


@pytest.mark.rest
def test_a_region_is_cut_into_reaches_in_time_that_follows_its_cells():
    """A round lake of 3 million cells is one chain."""
    row, column = np.ogrid[-1000:1001, -1000:1001]
    reaches = reaches_of(row**2 + column**2 < 990**2, 20.0)
    assert len(reaches.network.chains()) == 1
    assert reaches.length == pytest.approx(1980, rel=0.1)


STEPS = {
    "a weir": [([(10, 60, 100.3), (250, 60, 100.2), (250.01, 60, 99.2), (590, 60, 99.0)], 20)],
    "a lock": [
        ([(10, 60, 100.0), (240, 60, 100.0)], 18),
        ([(220, 60, 100.0), (250, 60, 100.0), (250.01, 60, 97.0), (280, 60, 97.0)], 6),
        ([(260, 60, 97.0), (590, 60, 97.0)], 18),
    ],
}


@pytest.mark.parametrize("name", STEPS)
def test_a_step_parts_the_water(name):
    channels = Channels(STEPS[name])
    upper, lower = sorted(channels.water((600, 120)), key=lambda body: -body.level)
    assert upper.rings[0][:, 0].max() == pytest.approx(250, abs=3 * CELL)
    assert lower.rings[0][:, 0].min() == pytest.approx(250, abs=3 * CELL)
    assert upper.rings[0][:, 0].max() < lower.rings[0][:, 0].min()
    for body in (upper, lower):
        # A corner of the outline lies between two cells, perhaps on the step itself.
        off = channels.off(body)[np.abs(np.concatenate(body.rings)[:, 0] - 250) > CELL]
        assert body.grade == "certain" and np.percentile(off, 90) < 0.15


def test_water_that_goes_round_a_weir_is_not_certain():
    """No cut parts it, so that near the weir the level is that of neither side."""
    past = [(180, 120, 100.95), (300, 200, 100.3), (420, 120, 99.65)]
    weir = [(10, 120, 101.0), (300, 120, 100.9), (300.01, 120, 99.7), (590, 120, 99.5)]
    channels = Channels([(weir, 20), (past, 14)])
    (body,) = channels.water((600, 240))
    assert body.grade == "likely" and channels.off(body).max() > 0.3


def test_rapids_and_steep_creeks_are_no_steps():
    for levels in ((102.3, 102.2, 100.2, 100.1), (104.0, 103.1, 102.8, 101.5)):
        corners = zip((10, 250, 330, 590), (60,) * 4, levels)
        (body,) = Channels([(list(corners), 18)]).water((600, 120))
        assert body.kind == "river" and body.level - body.lowest > 2.0


def test_a_reservoir_and_the_river_below_its_dam_are_two(tmp_path):
    """The dam of field2: the lake up to x = 240 is at 100.0, the river begins at 95.0."""
    lake, river = written_water(real("field2/water-dam.laz"), tmp_path)
    x = [body.rings[0][:, 0] - 500_000 for body in (lake, river)]
    assert x[0].max() == pytest.approx(240, abs=5) and x[1].min() == pytest.approx(240, abs=9)
    assert lake.kind == "lake" and lake.level == pytest.approx(100.0, abs=0.03)
    assert river.kind == "river" and (river.level, river.level_low) == pytest.approx(
        (95.0, 94.5), abs=0.1
    )


def test_the_head_of_a_tributary_is_not_at_the_level_of_the_river(tmp_path):
    source = real("field2/water-tributary.laz")
    (body,) = written_water(source, tmp_path)
    ring = body.rings[0] - (500_000, 5_500_000, 0)
    for place, level in (((300, 322), 101.15), ((60, 150), 100.38)):
        near = np.hypot(*(ring[:, :2] - place).T) < 30
        assert np.median(ring[near, 2]) == pytest.approx(level, abs=0.12)
