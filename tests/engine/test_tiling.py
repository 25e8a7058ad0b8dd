import dataclasses
import itertools
import re
import threading
import time

import numpy as np
import pytest
import surveys
from matrices import quick
from realdata import real
from runs import Heard, memory_store

import bare_earth
from bare_earth import BareEarthError, Cancelled, Progress
from bare_earth.algorithms.classes.selection import Selection
from bare_earth.algorithms.core.memory import free_memory
from bare_earth.algorithms.core.threads import workers
from bare_earth.algorithms.engine.blocks import Blocks, Visit
from bare_earth.algorithms.engine.blockwise import run_jobs
from bare_earth.algorithms.engine.disk_store import DiskStore
from bare_earth.algorithms.engine.memory import Cost, Resources
from bare_earth.algorithms.engine.store import Marks
from bare_earth.algorithms.engine.visits import Work, visited
from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.filters.grid_minimum import GridMinimum
from bare_earth.algorithms.filters.pipeline import Pipeline, PointRule, Stage
from bare_earth.algorithms.filters.slope import SlopeFilter
from bare_earth.algorithms.filters.tin import TinDensification
from bare_earth.algorithms.las.cloud import survey_frame
from bare_earth.algorithms.las.reading import read_cloud
from bare_earth.algorithms.tools.ground import labelling as ground_module
from bare_earth.algorithms.tools.ground.labelling import blocks_of
from bare_earth.algorithms.tools.ground.step import LabelGround
from benchmarks.rules import switched_off

PARAMETERS = (TinDensification(), GridMinimum(), SlopeFilter())
ORIGIN = (500_000.0, 5_700_000.0, 50.0)


def cloud_of(x, y, z, offset=ORIGIN, scale=0.01):
    """Return a cloud of integers; x, y and z are those of the survey, whatever the offset."""
    shift = [round((start - own) / scale) for start, own in zip(ORIGIN, offset)]
    return surveys.cloud_of(*(value + by for value, by in zip((x, y, z), shift)), offset, scale)


def part_of(cloud, cut):
    """Return some points of a cloud as a file of their own."""
    names = ("x", "y", "z", "classification", "return_number", "number_of_returns", "withheld")
    return dataclasses.replace(cloud, **{name: getattr(cloud, name)[cut] for name in names})


def survey(count=30_000, width=300.0, depth=130.0):
    """Return x, y and z of a strip with houses and trees, from 0 m on."""
    return tuple((surveys.strip(count, width, depth) - (0, 0, 6000)).T)


def labels_of(parts, parameters, blocks, threads=1, depth=1.0, known=None, progress=Progress()):
    frame = survey_frame(parts[0].crs)
    store = memory_store([(part, np.ones(part.count, bool)) for part in parts], frame, blocks)
    selection = Selection(low_noise_class=depth is not None, low_noise_depth=depth or 1.0)
    step = LabelGround(parameters, selection, cut=blocks)
    visited([Work(step, store)], Resources(threads=threads), progress)
    return [store.values(number) for number in range(len(parts))]


# Blocks


def test_blocks_are_two_kilometres_or_four_times_the_reach():
    assert Blocks.of(180.0) == blocks_of(TinDensification())
    assert (Blocks.of(100.0).side, Blocks.of(100.0).buffer) == (2000.0, 100.0)
    assert (Blocks.of(501.0).side, Blocks.of(501.0).buffer) == (2100.0, 501.0)
    assert blocks_of(TinDensification(max_building_size=300)).buffer == 360
    assert blocks_of(TinDensification(preset="city")).buffer == 144
    assert blocks_of(GridMinimum(max_object_size=400)).side == 3200
    assert blocks_of(SlopeFilter(preset="whitebox")).buffer == pytest.approx(6.02)
    assert blocks_of(SlopeFilter(preset="whitebox", min_neighbours=5)).buffer == 100
    assert blocks_of(SlopeFilter(preset="city")).buffer == 300


@pytest.mark.parametrize("begin", [500_000.0, 501_000.0, -2000.0, -1000.0, 0.0, 1000.0])
def test_a_tile_of_a_kilometre_lies_in_one_block(begin):
    x = np.array([0.0, 999.99]) + begin - ORIGIN[0]
    cloud = cloud_of(*(np.round(value * 100) for value in (x, x - x, x - x)))
    blocks = Blocks.of(100.0)
    store = memory_store([(cloud, np.ones(2, bool))], survey_frame(cloud.crs), blocks)
    assert [(block.column, block.row) for block in blocks.over(store)] == [(begin // 2000, 2850)]


def test_every_point_lies_in_one_block_and_crowded_blocks_are_quartered():
    x, y, z = survey()
    crowd = np.random.default_rng(4).uniform(10_000, 12_000, (2, 5000)).astype(int)
    cloud = cloud_of(np.r_[x, crowd[0]], np.r_[y, crowd[1]], np.r_[z, z[:5000]])
    blocks = Blocks(80.0, 8.0, most_points=1500)
    store = memory_store([(cloud, np.ones(cloud.count, bool))], cloud.frame, blocks)
    points, times = cloud.points(slice(None)), np.zeros(cloud.count, int)
    sides = set()
    for block in blocks.over(store):
        inside = block.holds(points)
        times += inside
        sides.add(block.side)
        assert np.count_nonzero(inside) <= 1500 or block.side == 10
        contents = Visit(block, blocks, store, False, {}).contents()
        west, south, east, north = blocks.window(block)
        seen = (points.x >= west) & (points.x < east) & (points.y >= south) & (points.y < north)
        assert np.array_equal(np.sort(contents.positions), np.flatnonzero(seen))
        assert np.array_equal(contents.points.z, points.z[contents.positions])
    assert (times == 1).all() and sides == {40.0, 20.0, 10.0}


@pytest.mark.rest(but="False-on disk")
@pytest.mark.parametrize("waiting", ["in memory", "on disk"])
@pytest.mark.parametrize("ordered", [True, False])
def test_a_block_gets_the_points_of_its_window_that_take_part(tmp_path, request, waiting, ordered):
    x, y, z = survey(200_000)
    order = np.argsort(y // 1000, kind="stable") if ordered else slice(None)
    cloud = cloud_of(x[order], y[order], z[order])
    selected, known, wanted = np.random.default_rng(8).random((3, cloud.count)) < 0.7
    known &= selected
    blocks = Blocks(80.0, 8.0)
    cuts = (slice(0, 70_000), slice(70_000, 70_001), slice(70_001, None))
    if waiting == "in memory":
        parts = [(part_of(cloud, cut), selected[cut], known[cut], wanted[cut]) for cut in cuts]
        store = memory_store(parts, survey_frame(cloud.crs), blocks)
    else:
        store = DiskStore(tmp_path / "out.laz", survey_frame(cloud.crs), blocks)
        for cut in cuts:
            store.append(part_of(cloud, cut), Marks(selected[cut], known[cut], wanted[cut]))
        request.addfinalizer(store.__exit__)
        store.finish()
    assert store.leaves.counts.sum() == selected.sum()
    frame, seen = survey_frame(cloud.crs), 0
    points = cloud.points(slice(None), frame)
    for block in blocks.over(store):
        visit = Visit(block, blocks, store, False, {})
        contents = visit.contents()
        west, south, east, north = blocks.window(block)
        expected = selected & (points.x >= west) & (points.x < east)
        expected = np.flatnonzero(expected & (points.y >= south) & (points.y < north))
        local = cloud.points(expected, frame.moved(visit.corner))
        rows = [
            np.column_stack([*value, *flags])
            for value, *flags in (
                (contents.points, contents.known, contents.wanted),
                (local, known[expected], wanted[expected]),
            )
        ]
        assert np.array_equal(*(row[np.lexsort(row.T)] for row in rows))
        if waiting == "in memory":
            assert np.array_equal(np.sort(contents.positions), expected)
        assert len(np.unique(contents.positions)) == len(expected)
        seen += len(expected)
    assert seen > selected.sum()


# Small blocks


@pytest.mark.long
@pytest.mark.parametrize("parameters", PARAMETERS, ids=METHODS)
def test_small_blocks_change_hardly_any_label_of_real_points(parameters):
    cloud = read_cloud(real("real/oregon_conifer.laz"))
    last = np.flatnonzero(cloud.return_number == cloud.number_of_returns)
    cloud = cloud_of(
        *(axis[last].astype(np.int64) for axis in (cloud.x, cloud.y, cloud.z)), cloud.offset,
        cloud.scale[0],
    )  # fmt: skip
    reach = blocks_of(parameters).buffer
    # Blocks choose what is left empty for themselves: here only the cut is to matter.
    parameters = parameters.resolve(cloud.points(slice(None)))
    # Blocks are 2000 m wide in truth, and so is the land of which the noise is a mean. Cells of all
    # sizes fit into these blocks, too.
    with switched_off("measured-noise"):
        whole, cut = (
            labels_of([cloud], parameters, Blocks(side, reach)) for side in (1000.0, 100.0)
        )
    assert 100.0 * np.mean((whole[0] == 1) != (cut[0] == 1)) < 0.01


def test_files_of_one_scale_give_equal_numbers_for_equal_places():
    x, y, z = survey(2000)
    here, there = cloud_of(x, y, z), cloud_of(x, y, z, (499_877.13, 5_600_000.01, -20.5))
    for mine, other in zip(here.points(slice(None)), there.points(slice(None), here.frame)):
        assert np.array_equal(mine, other)
    # Where the offsets differ by half a step of the scale the places do, too.
    half = cloud_of(x, y, z)
    half.offset = (500_000.005, *ORIGIN[1:])
    shifted = half.points(slice(None), here.frame)
    assert np.allclose(shifted.x - here.points(slice(None)).x, 0.005, atol=1e-9)


@pytest.mark.rest
def test_points_that_are_only_context_get_no_label_and_their_blocks_no_filter():
    x, y, z = survey(12_000, 220.0, 80.0)
    cloud, blocks = cloud_of(x, y, z), Blocks(80.0, 40.0)
    every, wanted = np.ones(cloud.count, bool), x < 7000
    whole, some = (
        memory_store([(cloud, every, None, value)], cloud.frame, blocks) for value in (None, wanted)
    )
    for store in (whole, some):
        work = Work(LabelGround(GridMinimum(), cut=blocks), store)
        visited([work], Resources(), Progress())
    assert np.array_equal(some.values(0), np.where(wanted, whole.values(0), 0))


# Stray points and messages


@pytest.mark.rest
@pytest.mark.parametrize("method", quick(METHODS, "tin-densification"))
def test_a_stray_point_far_away_changes_nothing_else(tmp_path, method):
    integers = surveys.strip(5000, 100.0, 75.0)

    def classes(integers):
        source, target = surveys.write(tmp_path / "in.las", integers), tmp_path / "out.las"
        bare_earth.classify(source, target, method=method)
        return surveys.classes_of(target)

    alone = classes(integers)
    assert 0.4 < (alone == 2).mean() < 0.95
    # A house stands at the border of the survey: in the gap it must not go on as a plateau.
    for east in (-1e6, -300.0, 300.0, 320.0, 1e6):
        found = classes(np.vstack((integers, [int(east * 100), 4000, 7000])))
        assert np.array_equal(found[:-1], alone)


def watched(monkeypatch, function, reach=20.0):
    class Watched(PointRule):
        stage = Stage.ACCEPTED

        def apply(self, state):
            state.ground = function(state.points, state.progress)

    method = METHODS["slope"]._replace(
        pipeline=lambda *_: Pipeline((Watched(),)),
        reach=lambda parameters: reach,
    )
    monkeypatch.setattr(ground_module, "method_of", lambda parameters: method)


def test_blocks_without_ground_are_told_and_messages_told_once(monkeypatch):
    def function(points, progress):
        progress.info("All the same.")
        if points.x.max() < 110:  # the easternmost blocks have nothing beyond
            raise BareEarthError("Nothing here.")
        if points.y.min() >= 0:
            progress.warning("A southern block.")
        return np.ones(points.count, bool)

    watched(monkeypatch, function)
    told, blocks = Heard(), Blocks(100.0, 20.0)
    # Windows of these blocks are narrower than the usual building.
    small = SlopeFilter(preset="whitebox", search_radius=5.0)
    (labels,) = labels_of([cloud_of(*survey())], small, blocks, 3, None, progress=told)
    assert told.infos == ["All the same."]
    southern, without = told.warnings
    assert southern == "A southern block (in 2 of 6 blocks)."
    count = np.count_nonzero(labels == 0)
    assert re.search(f"2 of 6 blocks: .*{count:,} points", without)
    assert without.endswith(" Nothing here.")
    assert count > 5000 and told.fractions == sorted(told.fractions)


def test_where_no_block_has_ground_the_error_is_that_of_the_first(monkeypatch):
    def function(points, progress):
        raise BareEarthError(f"Nothing east of {points.x.min():.0f}.")

    watched(monkeypatch, function)
    with pytest.raises(BareEarthError, match=r"^Nothing east of 0\.$"):
        labels_of([cloud_of(*survey())], SlopeFilter(), Blocks(100.0, 20.0), 3)


# Threads


def test_the_last_jobs_get_the_threads_of_those_that_ended():
    def last(progress):
        end = time.monotonic() + 10.0
        while workers() < 2 and time.monotonic() < end:
            time.sleep(0.01)
        return workers()

    begun = threading.Barrier(4)

    def first(progress):
        begun.wait(10.0)
        count = workers()
        begun.wait(10.0)
        return count

    jobs = [first] * 4 + [last] * 2
    found = dict(run_jobs(jobs, [1.0] * 6, at_once=4, threads=4, progress=Progress()))
    assert [found[number] for number in range(4)] == [1] * 4
    assert found[4] >= 2 and found[5] >= 2


@pytest.mark.rest
def test_blocks_that_are_alone_may_use_all_threads(monkeypatch):
    seen = []

    def function(points, progress):
        seen.append((workers(), threading.get_ident()))
        return np.ones(points.count, bool)

    watched(monkeypatch, function)
    labels_of([cloud_of(*survey())], SlopeFilter(), Blocks(1000.0, 20.0), 4)
    assert [count for count, _ in seen] == [4] and seen[0][1] != threading.get_ident()
    # With memory for one block only there is one at a time, and it may use all threads.
    seen.clear()
    large = Blocks(100.0, 20.0, cost=Cost(a_point=1e18))
    labels_of([cloud_of(*survey())], SlopeFilter(), large, 4)
    assert [count for count, _ in seen] == [4] * 6 and len({ident for _, ident in seen}) == 1


@pytest.mark.rest
def test_as_many_blocks_as_threads_use_one_each(monkeypatch):
    numbers, seen, together = itertools.count(), [], threading.Barrier(4)

    def function(points, progress):
        if next(numbers) < together.parties:
            together.wait(10.0)
            seen.append(workers())
            together.wait(10.0)
        return np.ones(points.count, bool)

    watched(monkeypatch, function)
    labels_of([cloud_of(*survey())], SlopeFilter(), Blocks(100.0, 20.0), 4)
    assert seen == [1] * 4


class Impatient(Progress):
    """Cancels when the first job has begun."""

    def __init__(self, begun):
        self.begun = begun

    def report(self, fraction):
        if self.begun.wait(20.0):
            raise Cancelled


@pytest.mark.parametrize("side", [1000.0, 100.0])
def test_a_cancel_is_heard_while_a_block_computes(monkeypatch, side):
    begun, stopped, go_on = threading.Event(), threading.Event(), threading.Event()

    def function(points, progress):
        begun.set()
        go_on.wait(20.0)  # as a long call of a library, which asks nobody
        try:
            progress(0.5)
        except Cancelled:
            stopped.set()
            raise
        return np.ones(points.count, bool)

    watched(monkeypatch, function)
    progress = Impatient(begun)
    with pytest.raises(Cancelled):
        labels_of([cloud_of(*survey())], SlopeFilter(), Blocks(side, 20.0), 2, progress=progress)
    assert not stopped.is_set()  # it computes still
    go_on.set()
    assert stopped.wait(20.0)


def test_jobs_give_their_results_and_the_first_error_ends_them():
    jobs = [lambda progress, n=number: n * n for number in range(7)]
    assert sorted(run_jobs(jobs, [1] * 7, 3, 1, Progress())) == [(n, n * n) for n in range(7)]
    assert list(run_jobs([], [], 3, 1, Progress())) == []

    def fail(progress):
        raise ValueError("no")

    with pytest.raises(ValueError, match="no"):
        list(run_jobs([fail, *jobs], [1] * 8, 2, 1, Progress()))


def test_free_memory_and_threads_are_found():
    assert 1 << 26 < free_memory() < 1 << 50
    assert Resources(memory=1.5).bytes == 1.5 * (1 << 30)
    assert Resources().bytes == pytest.approx(free_memory() / 2, rel=0.2)
    assert Resources(threads=3).thread_count == 3 and Resources().thread_count >= 1
    with pytest.raises(BareEarthError, match=r"Threads .* at least 1"):
        Resources(threads=0)
