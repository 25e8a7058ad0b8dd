"""Surveys of many files, cut from one cloud whose classes are known."""

from __future__ import annotations

import contextlib
import os
import signal
import time
from pathlib import Path
from typing import NamedTuple

import laspy
import numpy as np
import pytest

from bare_earth import Progress
from bare_earth.algorithms.core.threads import workers
from bare_earth.algorithms.crs.system import Crs
from bare_earth.algorithms.engine.jobs import TileJob
from bare_earth.algorithms.engine.memory import Resources
from bare_earth.algorithms.las.cloud import PointCloud
from bare_earth.algorithms.las.edits import Edits
from bare_earth.algorithms.las.writing import write_changed

SCALE = (0.01, 0.01, 0.01)
ORIGIN = (500_000.0, 5_700_000.0, 0.0)


def strip(count=12_000, width=300.0, depth=130.0, seed=3):
    """Return integers of a strip with houses and trees, over several blocks of 80 m."""
    random = np.random.default_rng(seed)
    x, y = random.uniform(0, width, count), random.uniform(0, depth, count)
    z = 60 + 0.06 * x + 2 * np.sin(y / 25) + random.normal(0, 0.03, count)
    z[(x % 45 < 12) & (y % 35 < 10)] += 6.0
    trees = random.random(count) < 0.1
    z[trees] += random.uniform(1, 9, trees.sum())
    z[random.choice(count, 8, replace=False)] -= 15.0
    return np.round(np.column_stack((x, y, z)) * 100).astype(np.int64)


def cloud_of(x, y, z, offset=(0.0, 0.0, 0.0), scale=0.01, classes=1, point_format=6):
    """Return a cloud of integers, each the only return of its pulse."""
    integers = [np.asarray(values).astype(np.int32) for values in (x, y, z)]
    ones = np.ones(len(integers[0]), np.uint8)
    return PointCloud(
        Path("in.las"), *integers, (scale,) * 3, offset, classes * ones, ones, ones,
        np.zeros(len(ones), bool), point_format, Crs(),
    )  # fmt: skip


def write(path, integers, shift=(0, 0, 0), classes=1):
    """Write points; `shift` moves the offset of the file by so many steps, not its points."""
    header = laspy.LasHeader(point_format=6, version="1.4")
    header.scales = SCALE
    header.offsets = tuple(o - s * by for o, s, by in zip(ORIGIN, SCALE, shift))
    las = laspy.LasData(header)
    las.X, las.Y, las.Z = (integers + np.array(shift)).T
    las.classification[:] = classes
    las.return_number[:] = las.number_of_returns[:] = 1
    las.write(str(path))
    return path


def write_classified(source, target, classes, progress=Progress()):
    """Write a file with other classes, and nothing else changed."""
    write_changed(source, target, Edits(classification=classes), progress)


def write_points(
    path, x, y, z, classes=1, *, offset=ORIGIN, scale=0.001, point_format=6, version="1.4",
    crs=None, wkt=None, **columns,
):  # fmt: skip
    """Write points, in metres from the offset; each is the only return of its pulse."""
    header = laspy.LasHeader(point_format=point_format, version=version)
    header.scales, header.offsets = (scale,) * 3, offset
    if crs:
        header.add_crs(pytest.importorskip("pyproj").CRS(crs))
    if wkt:
        header.vlrs.append(laspy.vlrs.known.WktCoordinateSystemVlr(wkt))
        header.global_encoding.wkt = True
    las = laspy.LasData(header)
    las.x, las.y, las.z = (values + start for values, start in zip((x, y, z), offset))
    las.classification[:] = classes
    las.return_number[:] = las.number_of_returns[:] = 1
    for name, values in columns.items():
        las[name][:] = values
    las.write(str(path))
    return path


def classes_of(path):
    """Return the classes of the points of a file."""
    return np.asarray(laspy.read(path).classification)


def heights_of(path):
    """Return the values of a raster, NaN where it has none."""
    with pytest.importorskip("rasterio").open(path) as raster:
        return raster.read(1, masked=True, out_dtype="float32").filled(np.nan)


def cut(folder, integers, files=6, seed=5, suffix=".laz"):
    """Write points into files of irregular extents, in any order and with any offsets."""
    folder.mkdir(exist_ok=True)
    random = np.random.default_rng(seed)
    columns, (x, y) = files // 2, integers.T[:2]
    shares = np.arange(1, columns) + random.uniform(-0.3, 0.3, columns - 1)
    column = np.digitize(x, np.quantile(x, shares / columns))
    number = 2 * column + (y > np.quantile(y, random.uniform(0.3, 0.7, columns))[column])
    for file in range(files):
        part = random.permutation(integers[number == file])
        write(folder / f"{file}{suffix}", part, random.integers(-9000, 9000, 3))
    return folder


def points_of(paths):
    """Return integers and class of all points of some files, sorted, whatever their offsets."""
    rows = []
    for path in paths:
        las = laspy.read(path)
        shift = np.round((np.array(las.header.offsets) - ORIGIN) / las.header.scales)
        integers = np.column_stack((las.X, las.Y, las.Z)).astype(np.int64) + shift.astype(np.int64)
        rows.append(np.column_stack((integers, np.asarray(las.classification))))
    rows = np.concatenate(rows)
    return rows[np.lexsort(rows.T[::-1])]


def finished(folder):
    """Return the files of a folder, without those that are being written."""
    return sorted(path for path in folder.glob("*.la[sz]") if path.name[0] != ".")


def states_of(folder):
    """Return what tells that files were written anew, of a folder that a run works in meanwhile."""
    found = {}
    names = os.listdir(folder) if folder.exists() else ()
    for name in (name for name in names if name[0] != "."):  # those are being written
        with contextlib.suppress(FileNotFoundError):  # removed or renamed since
            state = os.stat(folder / name)
            found[name] = state.st_ino, state.st_mtime_ns
    return found


def bytes_of(folder):
    """Return what the classified files of a folder hold."""
    return {path.name: path.read_bytes() for path in finished(folder)}


def replacing_jobs(kind, replace, **resources):
    """Return workers of a kind that do the jobs that `replace` returns in place of others."""

    class Replacing(kind):
        def submit(self, job):
            return super().submit(replace(job) or job)

    return Replacing(Resources(**{"threads": 2, **resources}))


class DeadlyJob(TileJob):
    """Kills the process that works on it."""

    def run(self, share, progress):
        os.kill(os.getpid(), signal.SIGKILL)


class HungryJob(TileJob):
    """Finds too little memory."""

    def run(self, share, progress):
        raise MemoryError


class OvertakenJob(TileJob):
    """Finds another file with as many points in the place of that whose points were labelled."""

    def run(self, share, progress):
        las, other = laspy.read(self.tile.path), self.tile.path.with_name("other.laz")
        las.points = las.points[::-1].copy()
        las.write(other)
        other.replace(self.tile.path)
        return super().run(share, progress)


def instead_of(name, kind):
    """Return what replaces the job that writes a file of this name, for `replacing_jobs`."""
    return lambda job: (
        kind(**vars(job)) if isinstance(job, TileJob) and job.tile.path.name == name else None
    )


class CountingJob(NamedTuple):
    """Counts the threads that it may use: while another job runs, and after that one has ended."""

    mine: Path
    other: Path
    is_last: bool
    title = "blocks"

    def planned(self, resources):
        return 0

    def run(self, share, progress):
        self.mine.touch()
        _wait(self.other.exists)
        counts = [workers()]
        self.mine.with_suffix(".counted").touch()
        _wait(self.other.with_suffix(".counted").exists)
        if self.is_last:
            _wait(lambda: workers() > 1)
            counts.append(workers())
        return counts


def _wait(happened):
    end = time.monotonic() + 20.0
    while not happened() and time.monotonic() < end:
        time.sleep(0.01)
