"""The generated scenes: the same for the same seed, true, and as wide a choice as they say."""

import numpy as np
import pytest

from benchmarks.scenes import KINDS, REPORTING_SEEDS, TUNING_SEEDS, make

# Smaller than they are by default, for time's sake.
SHARE = {"drone_images": 0.25, "drone_noisy": 0.3, "drone_2000": 0.2, "water_gaps": 0.45}


# Every eighth, and all with `make test-long`.
@pytest.mark.rest(but="birds")
@pytest.mark.parametrize(
    "kind",
    [
        pytest.param(kind, marks=pytest.mark.long if number % 8 else ())
        for number, kind in enumerate(KINDS)
    ],
)
def test_the_truth_of_every_kind_is_true(kind):
    scene = make(kind, seed=4, size=SHARE.get(kind, 0.35) * KINDS[kind].defaults.size)
    x, y, z = scene.points
    above = z - scene.terrain(x, y)
    ground = scene.ground
    noise = scene.settings.noise
    assert 0.01 < ground.mean() < 1.0
    # Where it is steep, noise in place is noise in height: most points, not all of them.
    assert np.percentile(np.abs(above[ground]), 80) < 0.12 + 3.0 * noise
    assert abs(np.median(above[ground])) < 0.05
    for plants in (scene.classes == 5, scene.classes == 6, scene.classes == 17):
        assert plants.sum() < 20 or np.median(above[plants]) > 0.5
    low = scene.classes == 7
    assert low.sum() == 0 or np.median(above[low]) < -0.8


@pytest.mark.rest(but="photogrammetry")
@pytest.mark.parametrize("kind", ["village", "quarry", "open_forest", "photogrammetry"])
def test_a_seed_decides_all_and_moves_more_than_the_noise(kind):
    size = 0.3 * KINDS[kind].defaults.size
    one, again, another = (make(kind, seed, size=size) for seed in (1, 1, 2))
    for mine, same in zip(one.points, again.points):
        np.testing.assert_array_equal(mine, same)
    np.testing.assert_array_equal(one.classes, again.classes)
    x, y = np.meshgrid(*2 * [np.linspace(-0.4, 0.4, 30) * size])
    mine, others = (
        scene.terrain(x.ravel() + scene.corner[0], y.ravel() + scene.corner[1])
        for scene in (one, another)
    )
    assert np.std(mine - others) > 0.1


@pytest.mark.rest
def test_changes_are_heard():
    few, many = (make("hills", 0, density=density, size=80.0) for density in (0.1, 10.0))
    assert 20 * few.points.count < many.points.count
    assert _corner_of_a_ridge(0.3) > 850.0
    tall, low = (make("hall_flat", 0, height=height, density=0.5) for height in (12.0, 3.0))
    assert np.ptp(tall.points.z[tall.classes == 6]) > 5 + np.ptp(low.points.z[low.classes == 6])
    dense, thin = (make("open_forest", 0, penetration=share, size=80.0) for share in (0.05, 0.6))
    assert dense.ground.mean() < 0.6 * thin.ground.mean()
    quiet, loud = (make("hills", 0, noise=noise, size=80.0) for noise in (0.01, 0.2))
    for scene, noise in ((quiet, 0.01), (loud, 0.2)):
        ground = scene.points.take(scene.ground)
        above = ground.z - scene.terrain(ground.x, ground.y)
        assert noise * 0.9 < np.std(above) < noise * 1.5 + 0.08
    assert (make("hills", 0, low_outliers=0.01, size=80.0).classes == 7).mean() > 0.005


def _corner_of_a_ridge(slope):
    """Return the height of the land there."""
    scene = make("sharp_ridge", 0, slope=slope, size=80.0)
    return scene.terrain(*scene.corner)


@pytest.mark.rest
def test_faces_carry_points():
    scene = make("hall_flat", seed=3)
    roof = scene.classes == 6
    above = (scene.points.z - scene.terrain(scene.points.x, scene.points.y))[roof]
    height = scene.settings.height
    assert 0.005 < np.mean((above > 0.15 * height) & (above < 0.75 * height)) < 0.2


def test_light_comes_in_below_a_deck():
    scene = make("viaduct", seed=1, density=1.0)
    deck = scene.points.take(scene.classes == 17)
    assert len(deck.x) > 1000
    assert np.min(deck.z) > scene.points.z[scene.ground].max() - 8.0


def test_returns_are_numbered_from_the_top():
    scene = make("open_forest", seed=0, size=80.0)
    number, count = scene.return_number, scene.number_of_returns
    assert (number >= 1).all() and (number <= count).all() and 2 < count.max() <= 15
    follows = np.flatnonzero(np.diff(number.astype(int)) == 1)
    assert np.mean(np.diff(scene.points.z)[follows] < 0.1) > 0.99
    last = number == count
    assert np.mean(last[scene.ground]) > 0.99


def test_the_cloud_has_the_same_points_and_no_classes():
    scene = make("hills", seed=0, size=60.0)
    cloud = scene.cloud()
    assert cloud.count == scene.points.count and not cloud.classification.any()
    back = cloud.points(slice(None))
    for mine, its in zip(scene.points, back):
        np.testing.assert_allclose(np.diff(mine), np.diff(its), atol=1e-6)


def test_seeds_are_of_two_halves():
    assert all(seed % 2 == 0 for seed in TUNING_SEEDS)
    assert all(seed % 2 == 1 for seed in REPORTING_SEEDS)
    assert len(KINDS) >= 40
