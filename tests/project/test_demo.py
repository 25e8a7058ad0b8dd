"""The scene of `make demo`: the same every time, true, and as hard as it says."""

import importlib
import sys
from pathlib import Path

import laspy
import numpy as np
import pytest

from benchmarks.scenes import make

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
    return make(scene.KIND, scene.SEED, density=1.5)


@pytest.mark.rest
def test_every_kind_of_thing_is_there(survey):
    kinds, counts = np.unique(survey.classes, return_counts=True)
    count = dict(zip(kinds.tolist(), counts.tolist()))
    # other (cars), ground, vegetation, buildings, low noise, water, bridge, high noise
    assert set(count) == {1, 2, 3, 4, 5, 6, 7, 9, 17, 18}
    assert min(count.values()) >= 10
    assert 0.4 < (count[2] + count[9]) / sum(count.values()) < 0.85


@pytest.mark.rest
def test_the_truth_is_true(survey):
    x, y, z = survey.points
    above, kind = z - survey.terrain(x, y), survey.classes
    # Noise of position: on the bank some centimetres become decimetres.
    assert np.percentile(np.abs(above[kind == 2]), 99) < 0.25
    assert np.abs(above[kind == 2]).max() < 2.0
    assert (above[kind == 7] < -0.9).all()
    assert (above[kind == 18] > 20.0).all()
    assert np.median(above[kind == 17]) > 1.5
    assert np.median(above[kind == 6]) > 3.0
    assert (above[kind == 5] > 0.5).all()


def test_the_terrain_is_rolling_and_has_a_steep_bank(survey):
    side = np.arange(0.5, 300.0) - 150.0
    x, y = np.meshgrid(side + survey.corner[0], side + survey.corner[1])
    z = survey.terrain(x, y)
    slope = np.degrees(np.arctan(np.hypot(*np.gradient(z))))
    assert 10.0 < np.ptp(z) < 60.0
    assert slope.max() > 37.0 and np.median(slope) < 15.0


def test_the_large_building_is_wider_than_a_house(survey):
    points = survey.points.take(survey.classes == 6)
    cells = np.zeros((32, 32), dtype=bool)
    west, south = (middle - 160.0 for middle in survey.corner)
    cells[((points.x - west) / 10).astype(int), ((points.y - south) / 10).astype(int)] = True
    # A square of 30 m that is roof throughout.
    squares = np.lib.stride_tricks.sliding_window_view(cells, (3, 3))
    assert squares.all(axis=(2, 3)).any()


def test_returns_of_a_pulse_are_complete(survey):
    number, count = survey.return_number.astype(int), survey.number_of_returns
    start = np.flatnonzero(number == 1)
    lengths = np.diff(np.append(start, len(number)))
    assert np.array_equal(number, np.arange(len(number)) - np.repeat(start, lengths) + 1)
    assert np.array_equal(count, np.repeat(lengths, lengths))
    assert 2 < count.max() <= 15


def test_the_files_hold_the_same_points_and_only_the_truth_its_classes(scene, tmp_path):
    count = scene.write_scene(tmp_path / "a.laz", tmp_path / "truth.las", density=0.5)
    cloud, truth = laspy.read(tmp_path / "a.laz"), laspy.read(tmp_path / "truth.las")
    assert len(cloud.points) == len(truth.points) == count
    for name in ("X", "Y", "Z", "return_number", "gps_time"):
        assert np.array_equal(cloud[name], truth[name])
    assert not np.asarray(cloud.classification).any()
    assert len(np.unique(truth.classification)) == 10
    assert "25832" in cloud.header.vlrs.get("WktCoordinateSystemVlr")[0].string


@pytest.mark.rest
def test_the_picture_is_drawn_with_and_without_truth(demo, scene, tmp_path, monkeypatch):
    rasterio = pytest.importorskip("rasterio")
    from PIL import Image

    cloud, truth = tmp_path / "a.las", tmp_path / "truth.las"
    scene.write_scene(cloud, truth, density=0.5)
    profile = {"driver": "GTiff", "width": 60, "height": 60, "count": 1, "crs": None}
    profile["transform"] = rasterio.transform.from_origin(568_000.0, 5_931_300.0, 5.0, 5.0)
    for name, kind, value in (("dtm.tif", "float32", 120.0), ("shade.tif", "uint8", 180)):
        with rasterio.open(tmp_path / name, "w", dtype=kind, **profile) as raster:
            raster.write(np.full((1, 60, 60), value, dtype=kind))
    colours, sizes = [], []
    for number, known in enumerate((None, demo("picture").Truth(truth))):
        target = tmp_path / f"{number}.png"
        demo("picture").draw(truth, tmp_path / "dtm.tif", tmp_path / "shade.tif", target, known)
        with Image.open(target) as picture:
            sizes.append(picture.size)
            pixels = np.unique(np.asarray(picture).reshape(-1, 3), axis=0)
        colours.append({f"#{bytes(pixel).hex()}" for pixel in pixels.tolist()})
    ground, other, missed, taken = "#c9a368", "#1f6f78", "#d1157f", "#f07f09"
    assert {ground, other} <= colours[0] and not {missed, taken} & colours[0]
    assert {ground, other, missed, taken} <= colours[1]
    # Errors have a map of their own.
    assert sizes[1][0] > 1.4 * sizes[0][0] and sizes[1][1] == sizes[0][1]


def test_the_profile_keeps_away_from_the_border(demo):
    picture = demo("picture")
    y = np.concatenate([np.full(900, 1.0), np.linspace(0, 100, 400), np.full(90, 60.0)])
    flat, image = np.zeros(len(y)), np.zeros((2, 2))
    view = picture.View(
        flat,
        y,
        flat,
        np.full(len(y), 2, np.uint8),
        image,
        image,
        None,
        (0, 100, 0, 100),
        ("m", "m"),
    )
    assert abs(picture.busiest_northing(view) - 60.0) < 2.0


@pytest.mark.rest
def test_real_land_is_classified_and_compared_with_its_labels(demo, tmp_path, monkeypatch, capfd):
    pytest.importorskip("rasterio")
    monkeypatch.chdir(tmp_path)
    assert demo("__main__").main(["--land", "court"]) == 0
    # Points without a label do not count.
    assert "points                   2,447" in capfd.readouterr().out
    assert (tmp_path / "demo-output" / "picture.png").stat().st_size > 20_000
    assert not np.asarray(laspy.read(tmp_path / "demo-output/court.laz").classification).any()
