"""The preset for sites keeps heaps and banks of earth, and removes machines and containers."""

import functools

import pytest

from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.runs.one_file import classify_cloud
from benchmarks.scenes import KINDS, make
from benchmarks.scenes.earthworks import BERM, ROAD, STOCKPILE


@functools.lru_cache(maxsize=2)
def site(kind):
    """Return a scene, and the landform of each of its points."""
    scene = make(kind, seed=8, density=10.0)
    land = KINDS[kind].landscape(scene.seed, scene.settings)[0]
    x, y, _ = scene.points
    return scene, land.landform(x - scene.corner[0], y - scene.corner[1])


def kept(kind, method, preset):
    """Return the shares of heaps, berms, roads, machines and containers that become ground."""
    scene, form = site(kind)
    labels, _ = classify_cloud(scene.cloud(), METHODS[method].parameters(preset=preset))
    ground = labels == 2
    of_earth = [
        ground[scene.ground & (form == number)].mean() for number in (STOCKPILE, BERM, ROAD)
    ]
    return [*of_earth, *(ground[scene.classes == code].mean() for code in (1, 6))]


@pytest.mark.parametrize("method", METHODS)
def test_earth_stays_and_machines_go(method):
    heaps, berms, roads, machines, containers = kept("earthworks", method, "site")
    assert min(heaps, berms, roads) > 0.99
    assert machines < 0.03 and containers < 0.02
    # In cells of 1 m, berms of 0.6 to 1.8 m are narrow.
    assert kept("earthworks", method, "automatic")[1] < 0.75


@pytest.mark.parametrize("method", METHODS)
def test_earth_stays_and_machines_go_in_points_from_images(method):
    heaps, berms, roads, machines, containers = kept("earthworks_images", method, "site")
    assert heaps > 0.92 and berms > 0.77 and roads > 0.99
    assert machines < 0.03 and containers < 0.02
    assert kept("earthworks_images", method, "automatic")[1] < 0.6
