"""Visits to blocks: what several steps need is made once for each."""

import numpy as np
import pytest
from runs import said
from surveys import bytes_of, strip, write

from bare_earth.algorithms.engine.memory import Resources
from bare_earth.algorithms.engine.run import Run
from bare_earth.algorithms.survey.files import Inputs
from bare_earth.algorithms.tin.lattice_sample import LatticeSample
from bare_earth.algorithms.tools.heights import MeasureHeights
from bare_earth.algorithms.tools.rasters.rows import RasterFiles
from bare_earth.algorithms.tools.rasters.step import MakeRasters

# Metres from a corner of blocks to the points, and the number of blocks in which they lie then.
PLACES = {"one block": (0, 1), "two blocks": (1850, 2)}


@pytest.fixture
def samples(monkeypatch):
    """The numbers of points that are thinned meanwhile."""
    counts, begin = [], LatticeSample.__init__

    def counted(self, points, *more):
        begin(self, points, *more)
        counts.append(points.count)

    monkeypatch.setattr(LatticeSample, "__init__", counted)
    return counts


def source(folder, start):
    """Write a strip that begins so many metres east of a corner of blocks."""
    integers, step = strip(), np.array([start * 100, 0, 0])
    write(folder / "in.laz", integers + step, classes=1 + (integers[:, 2] < 7000))
    return folder / "in.laz"


@pytest.mark.rest
@pytest.mark.parametrize(("start", "count"), PLACES.values(), ids=PLACES)
def test_a_run_thins_the_ground_once_a_block(tmp_path, samples, start, count):
    maps = "--dtm", tmp_path / "dtm.tif", "--hillshade", tmp_path / "shade.tif"
    words = "classify", source(tmp_path, start), tmp_path / "out.laz", *maps
    code, _, errors = said(*words, "--height-above-ground", "--method", "grid-minimum")
    assert code == 0, errors
    assert len(samples) == count


@pytest.mark.rest
def test_steps_find_the_same_without_memory_for_one_visit(tmp_path, samples):
    path, found = source(tmp_path, 1850), []
    for number, memory in enumerate((4.0, 0.01)):
        folder = tmp_path / str(number)
        folder.mkdir()
        maps = RasterFiles(dtm=folder / "dtm.tif", dsm=folder / "dsm.tif")
        run = Run((MeasureHeights(), MakeRasters(maps)), resources=Resources(2, memory))
        run.work(Inputs(path), folder / "out.laz")
        found.append((len(samples), bytes_of(folder)))
        samples.clear()
    # One of the ground and one of the surface in each block, or two of the ground.
    assert [count for count, _ in found] == [4, 6]
    assert found[0][1] == found[1][1]
