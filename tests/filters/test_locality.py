"""The labels of a place depend on what is near it, not on how far the survey reaches."""

import dataclasses

import numpy as np
import pytest
from matrices import quick
from realdata import real
from runs import memory_store
from surveys import cut, finished, points_of, strip, write

from bare_earth import Progress, classify
from bare_earth.algorithms.engine.memory import Resources
from bare_earth.algorithms.engine.visits import Work, visited
from bare_earth.algorithms.filters import METHODS, method_of
from bare_earth.algorithms.las.cloud import survey_frame
from bare_earth.algorithms.las.reading import read_cloud
from bare_earth.algorithms.tools.ground.labelling import blocks_of
from bare_earth.algorithms.tools.ground.step import LabelGround
from benchmarks.clouds import classify_cloud

PARAMETERS = [method.parameters() for method in METHODS.values()]
LONG = pytest.mark.long
COLUMNS = ("x", "y", "z", "classification", "return_number", "number_of_returns", "withheld")


def some(cloud, which):
    """Return some points of a cloud."""
    columns = {name: getattr(cloud, name)[which] for name in COLUMNS}
    return dataclasses.replace(cloud, **columns, scanner_channel=None, overlap=None, records=None)


def with_stray(cloud, east, north, up):
    """Return a cloud with one more point, so many metres from the smallest x and y."""
    more = some(cloud, np.r_[np.arange(cloud.count), 0])
    unit = cloud.crs.horizontal_unit
    more.x[-1] = cloud.x.min() + east / unit / cloud.scale[0]
    more.y[-1] = cloud.y.min() + north / unit / cloud.scale[1]
    more.z[-1] = np.median(cloud.z) + up / cloud.scale[2]
    more.withheld[-1] = False
    return more


@pytest.fixture(scope="module")
def wide(tmp_path_factory):
    """Return a generated survey that is far wider than what a filter looks at."""
    integers = strip(15_000, 700.0, 50.0)
    return read_cloud(write(tmp_path_factory.mktemp("wide") / "in.las", integers))


def crops(cloud):
    """Yield which points of a cloud are left, and how many metres each is from the cut."""
    x, y = (
        (values - values.min()) * scale * cloud.crs.horizontal_unit
        for values, scale in zip((cloud.x, cloud.y), cloud.scale)
    )
    west, east, south = 0.37 * x.max(), 0.6 * x.max(), 0.4 * y.max()
    for left, far in ((x >= west, x - west), (x <= east, east - x), (y >= south, y - south)):
        yield np.flatnonzero(left), far[left]


@pytest.mark.rest
@pytest.mark.parametrize("parameters", PARAMETERS, ids=METHODS)
def test_what_is_cut_off_changes_nothing_farther_away_than_the_filter_looks(parameters, wide):
    whole, _ = classify_cloud(wide, parameters)
    assert 0.3 < np.mean(whole == 2) < 0.98
    reach = method_of(parameters).reach(parameters)
    for left, distance in crops(wide):
        found, _ = classify_cloud(some(wide, left), parameters)
        far = distance > reach
        assert np.array_equal(found[far], whole[left][far])
        assert np.mean(found != whole[left]) < 0.01


@pytest.mark.long  # the test above has all methods
@pytest.mark.parametrize("name", ["isprs/samp31.laz", "real/ahn3_urban.laz"])
@pytest.mark.parametrize("parameters", PARAMETERS, ids=METHODS)
def test_crops_and_stray_points_of_real_surveys_change_nothing_far_away(name, parameters):
    cloud = read_cloud(real(name))
    if cloud.count > 500_000:  # half of them are quicker
        cloud = some(cloud, slice(None, None, 2))
    whole, _ = classify_cloud(cloud, parameters)
    reach = method_of(parameters).reach(parameters)
    for left, distance in crops(cloud):
        found, _ = classify_cloud(some(cloud, left), parameters)
        far = distance > reach
        assert np.array_equal(found[far], whole[left][far])
    for stray in ((-400.0, 50.0, 0.0), (700.0, 600.0, 40.0), (-5000.0, 0.0, -30.0)):
        found, _ = classify_cloud(with_stray(cloud, *stray), parameters)
        assert np.array_equal(found[:-1], whole)


@pytest.mark.parametrize("method", quick(METHODS, "slope"))
def test_files_in_the_west_change_nothing_far_away(method, wide, tmp_path):
    integers = np.column_stack((wide.x, wide.y, wide.z)).astype(np.int64)
    # With larger buildings too few points are left beyond the reach.
    size = {METHODS[method].size_parameter: 100.0}
    reach = METHODS[method].reach(METHODS[method].parameters(**size))
    east = integers[integers[:, 0] > 30_000]
    cut(tmp_path / "some", east, 4)
    cut(tmp_path / "all", integers, 4)
    for name in ("some", "all"):
        classify([tmp_path / name], tmp_path / f"{name} done", method=method, **size)
    found, whole = (points_of(finished(tmp_path / f"{name} done")) for name in ("some", "all"))
    found, whole = (rows[rows[:, 0] > 30_000 + 100 * reach] for rows in (found, whole))
    assert len(found) > 3_000 and np.array_equal(found, whole)


@pytest.mark.rest
@pytest.mark.parametrize("method", quick(METHODS, "slope"))
def test_quartering_crowded_blocks_changes_no_label_of_a_real_survey(method):
    parameters = METHODS[method].parameters()
    cloud, labels = read_cloud(real("isprs/samp11.laz")), []
    cloud = some(cloud, np.flatnonzero(cloud.x < np.quantile(cloud.x, 0.25)))
    for most in (10_000_000, 4000):
        blocks = dataclasses.replace(blocks_of(parameters), most_points=most)
        every = (cloud, np.ones(cloud.count, dtype=bool))
        store = memory_store([every], survey_frame(cloud.crs), blocks)
        assert (len(list(blocks.over(store))) > 1) == (most == 4000)
        work = Work(LabelGround(parameters, cut=blocks), store)
        visited([work], Resources(), Progress())
        labels.append(store.values(0))
    assert np.array_equal(*labels)
