"""Land beyond gaps, ramps and banks stay; what looks like them goes."""

import numpy as np
import pytest
from matrices import covering

from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.core.progress import SILENT
from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.filters.stages.bunds import Bunds
from bare_earth.algorithms.grids.bridge_decks import bridge_decks
from benchmarks.measure import Filter
from benchmarks.plain import Judge
from benchmarks.scenes.plain import rows

ROWS = {row.name: row for row in rows()}
STAY = (
    "moat-50x6x2.5-slope0-2pm2-b", "channels-26x4x2.5-slope0-8pm2-b",
    "channels-40x6x3-slope0-2pm2-b", "approach-14x6-slope0-2pm2-a", "bund-0.6x1.5-slope0-8pm2-b",
    "butte-60x13-slope10-2pm2-b", "bend-9x4-slope0-8pm2-b", "crater-4x1-slope0-20pm2-a",
    "fissures-14x1.5x2-slope5-8pm2-a",
)  # fmt: skip
GO = (
    "blocks-25x15x5x3x3-slope0-8pm2-a", "grandstand-14x50x2.2-slope0-4pm2-a",
    "solar-park-40x3x0.5x0.36x3.5x6-slope5-8pm2-a", "stacks-10x8x1.2x4x2-slope0-8pm2-a",
    "low-hedges-40x2x1.5x15x2-slope0-8pm2-b", "layers-20x12x10-slope0-8pm2-a",
    "hemisphere-40-slope0-8pm2-a", "arch-80x40x16x0x1-slope2-4pm2-b",
    "cushions-4x1.8x8-slope0-20pm2-a", "cushions-3x1.2x10-slope5-12pm2-b",
)  # fmt: skip
# Others of their kind are tried daily.
REST = (
    "cushions-4x1.8x8-slope0-20pm2-a", "channels-40x6x3-slope0-2pm2-b",
    "stacks-10x8x1.2x4x2-slope0-8pm2-a",
)  # fmt: skip


@pytest.mark.parametrize("method, name", covering(tuple(METHODS), STAY + GO, rest=REST))
def test_land_stays_and_what_looks_like_it_goes(method, name):
    judge = Judge(ROWS[name])
    verdict = judge.judged(judge.ground(Filter(method)))
    assert verdict.held, verdict


def test_plates_between_fissures_are_ground_though_no_ground_is_beside_them():
    random = np.random.default_rng(7)
    x, y = random.uniform(0.0, 60.0, (2, 28_800))
    in_fissure = np.minimum(np.mod(x, 12.0), np.mod(y, 12.0)) < 1.0
    z = 100.0 - 3.0 * in_fissure + random.normal(0.0, 0.03, len(x))
    for method in METHODS.values():
        points = Points(x, y, z)
        ground = method.ground(points, method.parameters()).ground
        assert ground[~in_fissure].mean() > 0.85


def test_land_between_two_channels_is_no_bridge():
    scene = ROWS["channels-40x6x3-slope0-2pm2-b"].make().scene
    assert not bridge_decks(scene.points, scene.ground).any()


@pytest.mark.parametrize("height", [0.8, 1.5])
def test_a_bank_has_smooth_sides_and_a_hedge_has_not(height):
    random = np.random.default_rng(8)
    x, y = random.uniform(-4.0, 4.0, (2, 1000))
    rise = np.clip(height + 0.3 - np.abs(x), 0.0, height)
    leaves = np.where(rise > 0.0, height * random.uniform(0.0, 1.0, len(x)), 0.0)
    banks = [Bunds().on_bank(Points(x, y, heights), heights) for heights in (rise, leaves)]
    assert banks[0][rise > 0.0].mean() > 0.7 and not banks[1].any()


def test_a_bank_is_as_high_along_its_crest_and_bushes_in_a_row_are_not():
    random = np.random.default_rng(9)
    x, y = random.uniform((-3.0, -20.0), (3.0, 20.0), (4000, 2)).T
    bank = np.clip(1.8 - np.abs(x), 0.0, 1.5)
    bushes = 1.5 * np.sqrt(np.clip(1.0 - (np.hypot(x, np.mod(y, 5.0) - 2.5) / 2.5) ** 2, 0.0, None))
    found = [Bunds().on_bank(Points(x, y, heights), heights) for heights in (bank, bushes)]
    assert found[0][bank > 0.0].mean() > 0.7 and not found[1].any()


def test_points_at_the_edge_of_a_drop_join_the_ground_and_no_leaf_of_a_hedge_there_does():
    random = np.random.default_rng(9)
    x, y = random.uniform(0.0, 40.0, (2, 12_800))
    ditch, hedge = np.abs(x - 20.0) < 1.5, (np.abs(x - 22.5) < 0.6) & (y > 20.0)
    z = 100.0 - 1.5 * ditch + random.normal(0.0, 0.02, len(x))
    points = Points(x, y, np.where(hedge, z + random.uniform(0.1, 1.2, len(x)), z))
    edge = ~ditch & (np.abs(x - 20.0) < 2.5) & (y < 19.0)
    for method in METHODS.values():
        pipeline = method.pipeline(points, method.parameters(), SILENT)
        ground, before = pipeline.run(points).ground, pipeline.without("edges").run(points).ground
        assert ground[edge].mean() > 0.99 and before[edge].mean() < 0.92
        assert np.array_equal(ground[hedge], before[hedge])
