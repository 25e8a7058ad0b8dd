"""Files that several jobs need are decompressed once, where memory allows."""

import os
import threading
import time

import numpy as np
import pytest
from runs import classify_tiles
from surveys import bytes_of, cut, strip, write

from bare_earth.algorithms.core.progress import SILENT
from bare_earth.algorithms.engine import cloud_cache as cloud_cache_module
from bare_earth.algorithms.engine import file_points as file_points_module
from bare_earth.algorithms.engine.cloud_cache import CloudCache
from bare_earth.algorithms.engine.memory import Resources
from bare_earth.algorithms.engine.workers import Threads
from bare_earth.algorithms.filters.slope import SlopeFilter
from bare_earth.algorithms.las import records as records_module
from bare_earth.algorithms.las.opening import open_las
from bare_earth.algorithms.survey.window import read_window

COLUMNS = ("x", "y", "z", "classification", "return_number", "number_of_returns", "withheld")
# The points of `las.make` lie from 399,990 on, one metre apart.
BOX = (399_993.0, 5_000_002.0, 399_999.0, 5_000_011.0)
COUNT = 400


@pytest.fixture
def read(monkeypatch):
    """The names of the files that are read into memory, in turn."""
    names, read_cloud = [], cloud_cache_module.read_cloud

    def noted(las, *values, **more):
        names.append(las.path.name)
        return read_cloud(las, *values, **more)

    monkeypatch.setattr(cloud_cache_module, "read_cloud", noted)
    monkeypatch.setattr(file_points_module, "read_cloud", noted)
    return names


@pytest.fixture
def source(las):
    return las.make("in.laz", version=4, point_format=6, count=COUNT, extra=3)


def assert_same(window, wanted):
    assert window.count == wanted.count > 0
    for name in COLUMNS:
        got, there = getattr(window, name), getattr(wanted, name)
        assert got.dtype == there.dtype
        np.testing.assert_array_equal(got, there)


def test_windows_of_one_file_are_taken_from_one_reading(source, read):
    cache = CloudCache(10**9)
    wide = (BOX[0] - 2.0, *BOX[1:])
    for box in (BOX, wide, BOX):
        assert_same(cache.window(source, box, SILENT), read_window(source, box))
    assert cache.whole(open_las(source), SILENT).count == COUNT
    assert read == ["in.laz"]


def test_a_file_that_the_box_does_not_touch_is_not_read(tmp_path, read):
    source = write(tmp_path / "in.laz", strip(COUNT))
    assert CloudCache(10**9).window(source, (0.0, 0.0, 1.0, 1.0), SILENT).count == 0
    assert not read


def test_a_file_that_is_too_large_is_read_as_without_a_cache(source, read):
    cache = CloudCache(19 * COUNT - 1)
    assert cache.whole(open_las(source), SILENT) is None
    assert_same(cache.window(source, BOX, SILENT), read_window(source, BOX))
    assert not read


def test_the_file_that_was_used_longest_ago_makes_room(las, read):
    one, two, three = (las.make(f"{n}.laz", count=COUNT) for n in (1, 2, 3))
    cache = CloudCache(2 * 19 * COUNT)
    for each in (one, two, one, three, one, two):
        cache.window(each, BOX, SILENT)
    assert read == ["1.laz", "2.laz", "3.laz", "2.laz"]


def test_a_file_that_has_changed_is_read_again(las, source, read):
    cache = CloudCache(10**9)
    assert cache.whole(open_las(source), SILENT).count == COUNT
    other = las.make("other.laz", version=4, point_format=6, count=COUNT // 2)
    os.replace(other, source)
    assert cache.whole(open_las(source), SILENT).count == COUNT // 2
    assert read == ["in.laz"] * 2


def test_threads_that_need_a_file_at_the_same_time_read_it_once(source, monkeypatch):
    cache, read_cloud, begun = CloudCache(10**9), cloud_cache_module.read_cloud, []

    def slow(*values):
        begun.append(1)
        time.sleep(0.2)
        return read_cloud(*values)

    monkeypatch.setattr(cloud_cache_module, "read_cloud", slow)
    found = []
    threads = [
        threading.Thread(target=lambda: found.append(cache.window(source, BOX, SILENT)))
        for _ in range(3)
    ]
    for each in threads:
        each.start()
    for each in threads:
        each.join()
    assert len(begun) == 1 and len(found) == 3
    assert_same(found[0], found[2])


def test_a_survey_is_decompressed_once(tmp_path, monkeypatch):
    six, started = cut(tmp_path / "in", strip(4000, 150.0, 40.0)), []
    read_records = records_module.read_records

    def noted(las, *values, **more):
        started.append(las.path.name)
        return read_records(las, *values, **more)

    for module in ("reading", "records", "writing", "class_layers"):
        name = f"bare_earth.algorithms.las.{module}.read_records"
        monkeypatch.setattr(name, noted, raising=False)
    parameters = SlopeFilter(preset="whitebox")
    workers = Threads(Resources(threads=2, memory=1.0))
    classify_tiles([six], tmp_path / "once", parameters, workers=workers)
    assert sorted(started) == sorted(path.name for path in six.iterdir())
    # Without memory for it the files are read more often, and the results are the same.
    workers = Threads(Resources(threads=2, memory=0.001))
    classify_tiles([six], tmp_path / "often", parameters, workers=workers)
    assert len(started) > 2 * 6
    assert bytes_of(tmp_path / "once") == bytes_of(tmp_path / "often")
