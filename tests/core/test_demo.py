"""The scene of `make demo`: the same every time, true, and as hard as it says."""

import importlib
import sys
from pathlib import Path

import laspy
import numpy as np
import pytest

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def demo():
    """Return a function that imports a module of the demo, which is in no installed package."""
    sys.path.insert(0, str(ROOT))
    yield lambda name: importlib.import_module(f"demo.{name}")
    sys.path.remove(str(ROOT))


@pytest.fixture(scope="module")
def scene(demo):
    return demo("scene")


@pytest.fixture(scope="module")
def survey(scene):
    return scene.survey(density=2.0)


def test_the_scene_is_the_same_every_time(scene):
    one, again = (scene.survey(density=0.2) for _ in range(2))
    other = scene.survey(density=0.2, seed=1)
    assert all(np.array_equal(one[name], again[name]) for name in one)
    assert len(other["z"]) != len(one["z"]) or not np.array_equal(other["z"], one["z"])


def test_every_kind_of_thing_is_there(survey):
    kinds, counts = np.unique(survey["kind"], return_counts=True)
    count = dict(zip(kinds.tolist(), counts.tolist()))
    # other (cars), ground, low and high vegetation, buildings, low noise, water, bridge, high noise
    assert set(count) == {1, 2, 3, 5, 6, 7, 9, 17, 18}
    assert min(count.values()) >= 10
    assert 0.4 < (count[2] + count[9]) / sum(count.values()) < 0.75


def test_the_truth_is_true(demo, survey):
    terrain = importlib.import_module("benchmarks.scenes.mixed").terrain(survey["x"], survey["y"])
    above = survey["z"] - terrain
    kind = survey["kind"]
    # Slanting pulses and noise of position: on the bank some centimetres become decimetres.
    assert np.percentile(np.abs(above[kind == 2]), 99) < 0.25
    assert (above[kind == 7] < -1.0).mean() > 0.9
    assert (above[kind == 18] > 20.0).all()
    assert np.median(above[kind == 17]) > 1.5
    assert np.median(above[kind == 6]) > 3.0
    assert (above[kind == 5] > 0.5).all()


def test_the_terrain_is_rolling_and_has_a_steep_bank(demo):
    landscape = importlib.import_module("benchmarks.scenes.mixed")
    x, y = np.meshgrid(np.arange(0.5, 300.0), np.arange(0.5, 300.0))
    z = landscape.terrain(x, y)
    slope = np.degrees(np.arctan(np.hypot(*np.gradient(z))))
    assert 10.0 < np.ptp(z) < 60.0
    assert slope.max() > 40.0 and np.median(slope) < 15.0


def test_the_large_building_is_wider_than_a_house(demo):
    random = np.random.default_rng(0)
    flat = [
        each
        for each in importlib.import_module("benchmarks.scenes.mixed").make_solids(random)
        if each.kind == "flat"
    ]
    assert len(flat) == 1 and min(flat[0].length, flat[0].width) >= 40.0


def test_returns_of_a_pulse_are_complete_and_fall(survey):
    pulse, number, count = (survey[k] for k in ("pulse", "return_number", "number_of_returns"))
    assert (number >= 1).all() and (number <= count).all() and count.max() <= 15
    same = np.diff(pulse) == 0
    assert (np.diff(number)[same] == 1).all()
    assert (number[:-1][~same] == count[:-1][~same]).all()
    assert count.max() > 2


def test_the_files_hold_the_same_points_and_only_the_truth_its_classes(scene, tmp_path):
    count = scene.write_scene(tmp_path / "a.laz", tmp_path / "truth.las", density=1.0)
    cloud, truth = laspy.read(tmp_path / "a.laz"), laspy.read(tmp_path / "truth.las")
    assert len(cloud.points) == len(truth.points) == count
    for name in ("X", "Y", "Z", "return_number", "gps_time"):
        assert np.array_equal(cloud[name], truth[name])
    assert not np.asarray(cloud.classification).any()
    assert len(np.unique(truth.classification)) == 9
    assert "25832" in cloud.header.vlrs.get("WktCoordinateSystemVlr")[0].string


def test_the_picture_is_drawn_with_and_without_truth(demo, scene, tmp_path):
    rasterio = pytest.importorskip("rasterio")
    pytest.importorskip("matplotlib")
    cloud, truth = tmp_path / "a.las", tmp_path / "truth.las"
    scene.write_scene(cloud, truth, density=0.5)
    profile = {"driver": "GTiff", "width": 60, "height": 60, "count": 1, "crs": None}
    profile["transform"] = rasterio.transform.from_origin(568_000.0, 5_931_300.0, 5.0, 5.0)
    for name, kind, value in (("dtm.tif", "float32", 120.0), ("shade.tif", "uint8", 180)):
        with rasterio.open(tmp_path / name, "w", dtype=kind, **profile) as raster:
            raster.write(np.full((1, 60, 60), value, dtype=kind))
    for number, known in enumerate((None, truth)):
        target = tmp_path / f"{number}.png"
        demo("picture").draw(truth, tmp_path / "dtm.tif", tmp_path / "shade.tif", target, known)
        assert target.read_bytes().startswith(b"\x89PNG") and target.stat().st_size > 20_000
