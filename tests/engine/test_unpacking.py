"""Compressed files that several jobs need are decompressed once, if the disk has room."""

import os
import shutil
import threading
import time
from pathlib import Path
from types import SimpleNamespace

import laspy
import lazrs
import numpy as np
import pytest
from runs import FAST, Heard
from surveys import bytes_of, cut, strip, write

import bare_earth
from bare_earth import BareEarthError, Progress
from bare_earth.algorithms.engine import unpacking as unpacking_module
from bare_earth.algorithms.engine.unpacking import Unpacking
from bare_earth.algorithms.las.opening import open_las
from bare_earth.algorithms.las.reading import read_cloud
from bare_earth.algorithms.las.records import needed, read_records
from bare_earth.algorithms.survey.window import read_window

pytestmark = pytest.mark.processes

COUNT = 400
# The points of `las.make` lie from 399,990 on, one metre apart.
BOX = (399_993.0, 5_000_002.0, 399_999.0, 5_000_011.0)


@pytest.fixture
def source(las):
    return las.make("in.laz", version=4, point_format=6, count=COUNT, extra=3)


@pytest.fixture
def decompressed(monkeypatch):
    """The names of the files that are decompressed, in turn."""
    names, decompressor = [], lazrs.ParLasZipDecompressor

    def noted(file, *rest):
        names.append(Path(file.name).name)
        return decompressor(file, *rest)

    monkeypatch.setattr(lazrs, "ParLasZipDecompressor", noted)
    return names


def _records(las):
    return np.concatenate([records.copy() for records in read_records(las)])


@pytest.mark.parametrize("is_whole", [True, False])
def test_an_unpacked_file_is_read_as_it_is(source, tmp_path, decompressed, is_whole):
    las = open_las(source)
    unpacked = Unpacking(tmp_path, is_whole).of(las, Progress())
    assert unpacked == las and unpacked.unpacked is not None
    assert decompressed == ["in.laz"]
    for read in (read_cloud, lambda file: read_window(file, BOX)):
        found, expected = read(unpacked), read(las)
        assert found.count == expected.count > 0
        for name, column in expected.columns.items():
            assert np.array_equal(found.columns[name], column)
    count = len(decompressed)
    assert np.array_equal(_records(unpacked), _records(las))
    # Layers that were not unpacked are taken from the file itself.
    assert len(decompressed) == count + (1 if is_whole else 2)
    assert unpacked.unpacked.has(needed(las)) and unpacked.unpacked.has(None) == is_whole


def test_a_file_that_has_changed_is_unpacked_again(las, source, tmp_path, decompressed):
    unpacking = Unpacking(tmp_path, True)
    for _ in range(2):
        assert unpacking.of(open_las(source), Progress()).count == COUNT
    os.replace(las.make("other.laz", version=4, point_format=6, count=COUNT // 2), source)
    assert read_cloud(unpacking.of(open_las(source), Progress())).count == COUNT // 2
    assert decompressed == ["in.laz"] * 2


def test_without_room_or_of_a_damaged_file_nothing_is_unpacked(source, tmp_path, monkeypatch):
    las = open_las(source)

    def full(*_):
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr(unpacking_module, "unpack", full)
        assert Unpacking(tmp_path, True).of(las, Progress()) is las
    data, start = source.read_bytes(), las.points_start + 8
    source.write_bytes(data[:start] + b"\xff" * 200 + data[start + 200 :])
    assert Unpacking(tmp_path, True).of(las, Progress()) is las
    with pytest.raises(BareEarthError, match="damaged"):
        read_cloud(las)
    assert not list(tmp_path.glob("*.records"))


def test_jobs_that_need_a_file_at_the_same_time_unpack_it_once(source, tmp_path, monkeypatch):
    unpack, begun, found = unpacking_module.unpack, [], []

    def slow(*values):
        begun.append(1)
        time.sleep(0.2)
        return unpack(*values)

    monkeypatch.setattr(unpacking_module, "unpack", slow)
    unpacking = Unpacking(tmp_path, True)
    threads = [
        threading.Thread(target=lambda: found.append(unpacking.of(open_las(source), Progress())))
        for _ in range(3)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(begun) == 1 and [read_cloud(las).count for las in found] == [COUNT] * 3


@pytest.mark.rest
@pytest.mark.parametrize("heights", [False, True])
def test_a_survey_is_decompressed_once(tmp_path, monkeypatch, decompressed, heights):
    six = cut(tmp_path / "in", strip(4000, 150.0, 40.0))
    names = sorted(path.name for path in six.iterdir())
    run = {"height_above_ground": heights, "threads": 2, "memory": 1.0, **FAST}
    bare_earth.classify(six, tmp_path / "once", **run)
    assert sorted(decompressed) == names
    # Without room for it the files are read more often, and the results are the same.
    monkeypatch.setattr(shutil, "disk_usage", lambda _: SimpleNamespace(free=0))
    bare_earth.classify(six, tmp_path / "often", **run)
    assert len(decompressed) >= 3 * 6
    assert bytes_of(tmp_path / "once") == bytes_of(tmp_path / "often")


@pytest.mark.rest
def test_one_file_that_does_not_fit_is_decompressed_once(tmp_path, decompressed):
    source = write(tmp_path / "one.laz", strip(60_000, 400.0, 200.0))
    much, little, progress = tmp_path / "much.laz", tmp_path / "little.laz", Heard()
    run = {"height_above_ground": True, **FAST}
    bare_earth.classify(source, much, **run)
    decompressed.clear()
    bare_earth.classify(source, little, threads=2, memory=0.002, progress=progress, **run)
    assert any("fit into the memory" in text for text in progress.infos)
    assert decompressed == ["one.laz"]
    assert much.read_bytes() == little.read_bytes()


@pytest.mark.rest
@pytest.mark.parametrize("is_shared", [False, True])
def test_rasters_unpack_only_files_that_several_jobs_read(
    tmp_path, decompressed, monkeypatch, is_shared
):
    # In the middle of a block, or where four of them meet.
    shift = 0 if is_shared else 50_000
    six = cut(tmp_path / "in", strip(4000, 150.0, 40.0) + np.array([shift, shift, 0]))
    bare_earth.classify(six, tmp_path / "out", **FAST)
    unpacked, unpack = [], unpacking_module.unpack
    monkeypatch.setattr(unpacking_module, "unpack", lambda *v: unpacked.append(1) or unpack(*v))
    decompressed.clear()
    bare_earth.terrain(tmp_path / "out", dtm=tmp_path / "dtm.tif")
    assert sorted(decompressed) == sorted(path.name for path in six.iterdir())
    assert bool(unpacked) == is_shared


@pytest.mark.rest
def test_processes_find_what_another_one_unpacked(tmp_path):
    six = cut(tmp_path / "in", strip(4000, 150.0, 40.0))
    run = {"height_above_ground": True, **FAST}
    bare_earth.classify(six, tmp_path / "a", **run)
    bare_earth.classify(six, tmp_path / "b", scheduler="processes", threads=2, **run)
    assert bytes_of(tmp_path / "a") == bytes_of(tmp_path / "b")
    assert "HeightAboveGround" in laspy.read(tmp_path / "b" / "0.laz").point_format.dimension_names
