"""Many files, few points far apart, many runs: what they take grows no more than it must."""

import gc
import os
import sys
import threading
import time

import numpy as np
import pytest
import surveys
from runs import FAST

from bare_earth import BareEarthError, classify, heights
from bare_earth.algorithms.filters import METHODS


def scattered(path, count=3000, side=100_000.0):
    """Write points so far apart that hardly any has a neighbour."""
    random = np.random.default_rng(1)
    xyz = random.uniform(0, 1, (count, 3)) * (side, side, 300.0)
    return surveys.write(path, np.round(xyz * 100).astype(np.int64))


@pytest.mark.long
@pytest.mark.parametrize("name", METHODS)
def test_what_points_far_apart_take_grows_with_the_blocks_that_hold_any(
    tmp_path, name, record_property
):
    source, out = scattered(tmp_path / "in.laz"), tmp_path / "out.laz"
    begun = time.process_time()
    classify(source, out, method=name)
    seconds = time.process_time() - begun
    record_property("seconds of work", round(seconds, 1))
    print(f"{name}: {seconds:.1f} s of work for 3,000 points over 100 km")
    assert seconds < 40
    assert out.is_file()


def test_a_raster_of_points_scattered_over_100_km_is_refused(tmp_path):
    source, out = scattered(tmp_path / "in.laz", 30), tmp_path / "out.laz"
    begun = time.process_time()
    with pytest.raises(BareEarthError, match=r"[\d,]+ cells of 1 m"):
        classify(source, out, dtm=tmp_path / "dtm.tif", **FAST)
    assert time.process_time() - begun < 60
    assert list(tmp_path.iterdir()) == [source]


def grid_of_tiles(folder, side, points=40, metres=20.0):
    """Write side x side small tiles, which touch each other."""
    folder.mkdir()
    random = np.random.default_rng(side)
    for number in range(side * side):
        east, north = number % side * metres, number // side * metres
        xyz = np.empty((points, 3))
        xyz[:, :2] = random.uniform(0, metres, (points, 2)) + np.array((east, north))
        xyz[:, 2] = 100 + 0.05 * xyz[:, 0] + random.normal(0, 0.02, points)
        surveys.write(folder / f"{number:04d}.laz", np.round(xyz * 100).astype(np.int64))
    return folder


def seconds_of(folder, out):
    begun = time.process_time()
    done = classify([folder], out, **FAST)
    assert not done.failures
    return done.done_count, time.process_time() - begun


@pytest.mark.long
def test_a_thousand_tiles_take_no_more_for_a_tile_than_a_hundred(tmp_path, record_property):
    few, seconds = seconds_of(grid_of_tiles(tmp_path / "few", 10), tmp_path / "few-out")
    many, more = seconds_of(grid_of_tiles(tmp_path / "many", 32), tmp_path / "many-out")
    assert (few, many) == (100, 1024)
    for name, value in (("100", seconds / few), ("1024", more / many)):
        record_property(f"milliseconds a tile of {name}", round(1000 * value, 1))
    print(
        f"milliseconds a tile: {1000 * seconds / few:.1f} of 100, {1000 * more / many:.1f} of 1024"
    )
    assert more / many < 1.5 * seconds / few + 0.01


def open_now():
    """Return the open files, threads and bytes of memory of this process."""
    gc.collect()
    with open("/proc/self/statm", encoding="ascii") as file:
        pages = int(file.read().split()[1])
    return len(os.listdir("/proc/self/fd")), threading.active_count(), pages * 4096


@pytest.mark.long
@pytest.mark.skipif(sys.platform != "linux", reason="it counts what Linux tells")
@pytest.mark.parametrize("suffix", [".las", ".laz", ".copc.laz"])
def test_many_runs_in_one_process_leave_nothing_behind(tmp_path, suffix, record_property):
    points = surveys.strip(3000, 60.0, 60.0)
    source, out = surveys.write(tmp_path / "in.laz", points), tmp_path / f"out{suffix}"

    def run():
        classify(source, out, dtm=tmp_path / "dtm.tif", **FAST)
        heights(out, tmp_path / f"height{suffix}")
        with pytest.raises(BareEarthError):
            classify(tmp_path / "none.las", out, **FAST)

    for _ in range(30):
        run()
    before = open_now()
    for _ in range(170):
        run()
    after = open_now()
    record_property("bytes more after 170 runs", after[2] - before[2])
    print(f"{suffix}: {before} before, {after} after 170 runs")
    assert after[:2] == before[:2]
    assert after[2] - before[2] < 30_000_000
