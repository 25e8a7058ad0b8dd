"""How a run moves its bar: always forwards, often, and never long at one figure."""

import time

import numpy as np
import pytest
import surveys
from matrices import quick

from bare_earth import Progress
from bare_earth.algorithms.engine.memory import Resources
from benchmarks.progress import Recorder, pace_of, runs

# A fifth is what is promised; of so short a run, what takes as long for any file is a part.
_LONGEST_STAY = 0.25
_NAMES = ("Slope filter", "Point cloud to terrain")
# Of which the last of these is made, or nearly, and a second filter of cells.
_PARTS = (
    "Grid minimum",
    "TIN densification",
    "TIN, DTM, hillshade, heights",
    "All rasters",
    "Height above ground",
)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder with a cloud. What is imported once has been: a few points went through all runs."""
    folder = tmp_path_factory.mktemp("progress")
    surveys.write(folder / "cloud.las", surveys.strip(2000, 40.0, 30.0))
    for run in runs_in(folder, 4.0).values():
        run(Progress())
    surveys.write(folder / "cloud.las", surveys.strip(350_000, 500.0, 350.0))
    return folder


@pytest.fixture(scope="module")
def classified(folder):
    """The same, with the classified cloud that some runs read."""
    next(iter(runs_in(folder, 4.0).values()))(Progress())
    return folder


def runs_in(folder, memory):
    return runs(folder / "cloud.las", folder, Resources(threads=2, memory=memory))


def moves_evenly(name, folder, memory):
    # Seconds of the processor: whatever else the machine does is not measured.
    recorder = Recorder(time.process_time)
    runs_in(folder, memory)[name](recorder)
    assert recorder.moments[-1][1] == pytest.approx(1.0)
    pace = recorder.pace()
    assert pace.falls == 0
    assert pace.stay <= _LONGEST_STAY and pace.rest <= 2.0, pace


@pytest.mark.rest
@pytest.mark.parametrize("name", quick(_NAMES, "Point cloud to terrain"))
def test_a_bar_never_stands_still(name, folder):
    moves_evenly(name, folder, 4.0)


@pytest.mark.long
@pytest.mark.parametrize("name", _PARTS)
def test_nor_do_others(name, classified):
    moves_evenly(name, classified, 4.0)


@pytest.mark.long
@pytest.mark.parametrize("name", _NAMES + _PARTS)
def test_nor_where_points_wait_on_disk(name, classified):
    moves_evenly(name, classified, 0.02)


def test_the_pace_tells_what_stands_still():
    moments = [(0.0, 0.0), (1.0, 0.2), (2.0, 0.2), (3.0, 0.2), (7.0, 0.5), (8.0, 0.4), (9.0, 1.0)]
    pace = pace_of(moments, 10.0)
    assert (pace.silence, pace.rest, pace.figure, pace.falls) == (4.0, 6.0, 20, 1)
    assert pace.stay == pytest.approx(0.6)


def test_shares_follow_each_other():
    recorder = Recorder()
    for part in recorder.shares(1.0, 0.0, 3.0):
        part(0.0)
        part(1.0)
    figures = [figure for _, figure in recorder.moments]
    assert np.allclose(figures, [0.0, 0.25, 0.25, 0.25, 0.25, 1.0])
