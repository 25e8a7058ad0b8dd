"""A block takes no more memory than the engine reckons with, and what is freed goes back."""

import sys
import tracemalloc
from pathlib import Path

import numpy as np
import pytest
from matrices import quick
from runs import memory_store
from surveys import cloud_of, cut, strip

import bare_earth
from bare_earth import Progress
from bare_earth.algorithms.core.memory import give_back
from bare_earth.algorithms.engine.memory import Resources
from bare_earth.algorithms.engine.visits import Work, visited
from bare_earth.algorithms.las.cloud import survey_frame
from bare_earth.algorithms.tools.heights import MeasureHeights
from bare_earth.algorithms.tools.rasters.parameters import TerrainModel
from bare_earth.algorithms.tools.rasters.rows import RasterFiles
from bare_earth.algorithms.tools.rasters.step import MakeRasters

pytestmark = pytest.mark.processes

# So many points that the arrays of a single tile of `DenseSurface` hardly count.
COUNT, SIDE = 250_000, 311.0
MAPS = {name: Path(f"{name}.tif") for name in ("dtm", "dsm")}
# What SciPy takes in a process that has not used it yet.
LIBRARIES = 100_000_000
STEPS = {
    "heights": MeasureHeights(),
    "terrain": MakeRasters(RasterFiles(dtm=MAPS["dtm"]), TerrainModel(1.0)),
    "surface": MakeRasters(RasterFiles(**MAPS), TerrainModel(1.0)),
}


@pytest.mark.rest
@pytest.mark.parametrize("name", quick(STEPS, "surface"))
def test_a_block_takes_about_as_much_as_is_reckoned(name):
    random, step = np.random.default_rng(1), STEPS[name]
    x, y = random.uniform(0.0, SIDE, (2, COUNT))
    z = 100.0 + 8.0 * np.sin(x / 60.0) + random.uniform(0.0, 0.1, COUNT)
    cloud = cloud_of(*(np.rint(axis * 100) for axis in (x, y, z)))
    ground, every = random.random(COUNT) < 0.9, np.ones(COUNT, dtype=bool)
    store = memory_store([(cloud, every, ground, every)], survey_frame(cloud.crs), step.blocks)
    reckoned = step.blocks.memory(COUNT, (SIDE + 2.0 * step.blocks.buffer) ** 2)
    tracemalloc.start()
    try:
        visited([Work(step, store)], Resources(threads=1), Progress())
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert 0.3 * reckoned < peak < reckoned


@pytest.mark.rest
@pytest.mark.skipif(sys.platform != "linux", reason="Only Linux tells the peak of a process")
def test_jobs_in_processes_take_no_more_memory_than_was_planned(tmp_path):
    folder = cut(tmp_path / "in", strip(500_000, 450.0, 320.0), 4)
    run = {"method": "grid-minimum", "scheduler": "processes", "threads": 2, "memory": 2.0}
    done = bare_earth.classify(folder, tmp_path / "out", **run)
    assert {job.job for job in done.jobs} == {"blocks", *(path.name for path in folder.iterdir())}
    for job in done.jobs:
        assert job.seconds > 0 and job.memory is not None
        assert job.memory < job.planned + LIBRARIES
    assert max(job.memory for job in done.jobs) > 50_000_000


def _resident():
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4096


@pytest.mark.skipif(sys.platform != "linux", reason="glibc alone keeps what is freed")
def test_what_is_freed_goes_back():
    # Too small to be mapped one by one; the last one keeps the heap from shrinking by itself.
    arrays = [np.ones(8_000) for _ in range(600)]
    arrays = arrays[-1:]
    before = _resident()
    give_back()
    assert before - _resident() > 20_000_000
    assert len(arrays) == 1
