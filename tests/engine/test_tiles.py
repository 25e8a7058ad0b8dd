import dataclasses
import json
import multiprocessing
import os
import re
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import laspy
import numpy as np
import pytest
from realdata import real
from runs import CancelAtFirstFile, Heard, classify_tiles, environment, temporary_in
from surveys import (
    CountingJob,
    DeadlyJob,
    HungryJob,
    OvertakenJob,
    bytes_of,
    cut,
    finished,
    instead_of,
    points_of,
    replacing_jobs,
    states_of,
    strip,
    write,
)

import bare_earth
from bare_earth import BareEarthError, Cancelled, Progress
from bare_earth.algorithms.cli import main
from bare_earth.algorithms.engine import workers as workers_module
from bare_earth.algorithms.engine.block_grid import BlockGrid, BlockIndex, grouped
from bare_earth.algorithms.engine.blocks import Blocks
from bare_earth.algorithms.engine.disk_store import DiskStore
from bare_earth.algorithms.engine.jobs import BlockJob
from bare_earth.algorithms.engine.memory import Resources
from bare_earth.algorithms.engine.options import TileOutput
from bare_earth.algorithms.engine.workers import Local, Processes, Threads
from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.filters.slope import SlopeFilter
from bare_earth.algorithms.las import copc as copc_module
from bare_earth.algorithms.las import copc_octree
from bare_earth.algorithms.las import reading as reading_module
from bare_earth.algorithms.las.cloud import survey_frame
from bare_earth.algorithms.survey.files import open_survey
from bare_earth.algorithms.survey.vpc import read_vpc, write_vpc
from bare_earth.algorithms.tools.ground import step as step_module
from bare_earth.algorithms.tools.ground.method import TileMethod
from bare_earth.algorithms.tools.ground.output import PointOutput
from bare_earth.algorithms.tools.ground.step import LabelGround

BLOCKS = Blocks(80.0, 30.0, most_points=2500)
FAST = SlopeFilter(preset="whitebox")


def classify(sources, target, blocks=None, method="slope", **options):
    """Classify with the fastest filter, or with another one, in blocks of its own or in others."""
    if method == "slope":
        options = {"preset": "whitebox", **options}
    with pytest.MonkeyPatch.context() as patch:
        if blocks:
            patch.setattr(step_module, "blocks_of", lambda parameters: blocks)
        return bare_earth.classify(sources, target, method=method, **options)


@pytest.fixture
def out(tmp_path):
    return tmp_path / "out"


@pytest.fixture
def six(tmp_path):
    return cut(tmp_path / "in", strip(4000, 150.0, 40.0))


@pytest.fixture(scope="module")
def many(tmp_path_factory):
    """Ten files in five columns, and the bytes that they become in one go."""
    folder = tmp_path_factory.mktemp("many")
    cut(folder / "in", strip(19_000, 375.0, 200.0), 10)
    classify(folder / "in", folder / "once")
    return folder / "in", bytes_of(folder / "once")


# The same labels as those of one file


@pytest.mark.rest(but="tin-densification")
@pytest.mark.parametrize("method", METHODS)
def test_tiles_get_the_labels_of_one_file_with_all_points(method, tmp_path, out):
    integers = strip(3500, 150.0, 75.0)
    run = {"method": method, "preset": None, "low_noise_class": True, "blocks": BLOCKS}
    whole = write(tmp_path / "whole.las", integers)
    classify(whole, tmp_path / "done.las", **run)
    expected = points_of([tmp_path / "done.las"])
    assert {1, 2, 7} == set(np.unique(expected[:, 3]))
    folder = cut(tmp_path / "in", integers, 6)
    for threads in (1, 3) if method == "slope" else (2,):
        summary = classify(folder, out, threads=threads, **run)
        assert not summary.failures and summary.done_count == summary.tile_count == 6
        assert np.array_equal(points_of(finished(out)), expected)
        assert summary.ground_count == np.count_nonzero(expected[:, 3] == 2)
        assert summary.point_count == len(integers)


@pytest.mark.rest
@pytest.mark.parametrize(
    "name", ["isprs/samp52.laz", pytest.param("real/ign_pf8.las", marks=pytest.mark.long)]
)
def test_real_tiles_get_the_labels_of_the_file_they_were_cut_from(name, tmp_path, out):
    las = laspy.read(real(name))
    x, y = np.asarray(las.x), np.asarray(las.y)
    near = (x < x.min() + 75) & (y < y.min() + 75)
    integers = np.column_stack([np.round(metres * 100) for metres in (x, y, np.asarray(las.z))])
    integers = (integers[near] - [25_000_000, 570_000_000, 0]).astype(np.int64)
    if len(integers) > 12_000:
        integers = integers[:: len(integers) // 12_000 + 1]
    whole = write(tmp_path / "whole.laz", integers)
    folder = cut(tmp_path / "in", integers, 8)
    # In small blocks, and in those of the method, as a user runs both.
    for blocks in (Blocks(70.0, 50.0), None):
        for source, target in ((whole, tmp_path / "done.laz"), (folder, out)):
            classify(source, target, blocks, method="tin-densification", preset="lidar360")
        found = points_of(finished(out))
        assert np.array_equal(found, points_of([tmp_path / "done.laz"]))
        assert 0.2 < np.mean(found[:, 3] == 2) < 0.98
        if "samp52" not in name:
            return


def test_a_tile_changes_in_nothing_but_its_classes(six, out):
    classify(six, out)
    for path in six.iterdir():
        before, after = laspy.read(path), laspy.read(out / path.name)
        assert np.array_equal(before.X, after.X) and np.array_equal(before.Z, after.Z)
        assert np.array_equal(before.header.offsets, after.header.offsets)
        assert set(np.unique(after.classification)) == {1, 2}


@pytest.mark.rest
def test_processes_give_the_same_bytes_as_threads(many, out):
    progress = Heard()
    workers = Processes(Resources(threads=2))
    summary = classify_tiles([many[0]], out, FAST, progress=progress, workers=workers)
    assert summary.done_count == 10 and progress.fractions == sorted(progress.fractions)
    assert bytes_of(out) == many[1]
    assert sum(": " in text and "points are ground" in text for text in progress.infos) == 10


def test_messages_that_differ_in_names_and_numbers_only_are_told_once(tmp_path, out):
    folder = cut(tmp_path / "in", strip(3000), 4)
    for path in folder.iterdir():
        cloud = laspy.read(path)
        cloud.return_number[: 3 + int(path.stem)] = 0
        cloud.write(str(path))
    progress = Heard()
    classify(folder, out, progress=progress, threads=1)
    (told,) = (text for text in progress.warnings if "return number" in text)
    assert told.startswith("0.laz: 3 points ") and told.endswith(": 1.laz, 2.laz, 3.laz.")


@pytest.mark.rest
def test_tiles_larger_than_memory_give_the_same_bytes(tmp_path, out, monkeypatch):
    cut(tmp_path / "in", strip(60_000, 400.0, 200.0), 6)
    classify(tmp_path / "in", tmp_path / "much")
    monkeypatch.setattr(reading_module, "_CHUNK", 2000)
    counts, append = [], DiskStore.append

    def noting(store, part, marks):
        counts.append(part.count)
        append(store, part, marks)

    monkeypatch.setattr(DiskStore, "append", noting)
    classify(tmp_path / "in", out, threads=2, memory=0.001)
    assert bytes_of(out) == bytes_of(tmp_path / "much")
    # No file need be in memory as a whole.
    assert counts and max(counts) <= 2000


@pytest.mark.rest
def test_copc_tiles_larger_than_their_share_of_memory_give_the_same_bytes(
    many, out, tmp_path, monkeypatch
):
    monkeypatch.setattr(copc_octree, "_LEAF_POINTS", 400)
    classify([many[0]], tmp_path / "much", format="copc.laz")
    waited, waiting_points = [], copc_module.WaitingPoints

    def noting(branch, parts, room):
        waited.append(room.most)
        return waiting_points(branch, parts, room)

    monkeypatch.setattr(copc_octree, "_BYTES_TO_SORT", 3000)
    monkeypatch.setattr(copc_module, "WaitingPoints", noting)
    classify(many[0], out, threads=2, memory=0.002, format="copc.laz")
    assert len(waited) == 10 and 400 <= min(waited) < max(waited) < 700
    assert bytes_of(out) == bytes_of(tmp_path / "much")


def test_blocks_are_read_in_groups_that_fit_into_memory(six):
    survey = open_survey([six])
    grid = BlockGrid(survey_frame(survey.crs), LabelGround(SlopeFilter(), cut=Blocks(20.0, 5.0)))
    places = [BlockIndex(column, row) for row in range(6) for column in range(15)]
    many = grouped(grid, survey, places, 1, 1 << 40)
    assert len(many) == 4 * 2  # squares of 4 x 4; with 8 x 8 there would be too few
    assert sorted(place for group in many for place in group) == sorted(places)
    assert len(grouped(grid, survey, places, 1, 0)) == 90
    assert len(grouped(grid, survey, places, 100, 1 << 40)) == 90


@pytest.mark.rest
def test_copc_files_of_which_only_parts_are_read_give_the_same(tmp_path, out):
    integers, blocks = strip(5000, 150.0, 75.0), Blocks(40.0, 8.0)
    folder = cut(tmp_path / "in", integers, 4)
    classify(folder, tmp_path / "copc", format="copc.laz")
    classify(tmp_path / "copc" / "classified.vpc", out, blocks=blocks)
    whole = write(tmp_path / "whole.las", integers)
    classify(whole, tmp_path / "done.las", blocks=blocks)
    assert np.array_equal(points_of(finished(out)), points_of([tmp_path / "done.las"]))


# What is written


@pytest.mark.rest
def test_the_results_are_listed_in_a_virtual_point_cloud(six, out, tmp_path):
    summary = classify(six, out)
    assert [path.name for path in read_vpc(out / "classified.vpc")] == sorted(
        path.name for path in six.iterdir()
    )
    assert summary.vpc == str(out / "classified.vpc")
    # It is a survey again.
    other = tmp_path / "again"
    classify(out / "classified.vpc", other, vpc=tmp_path / "b.vpc")
    assert bytes_of(other) == bytes_of(out)
    assert len(read_vpc(tmp_path / "b.vpc")) == 6


@pytest.mark.rest(but="las")
@pytest.mark.parametrize("format", ["las", "laz", "copc.laz"])
def test_the_format_can_be_chosen(format, six, out):
    classify(six, out, format=format)
    assert {path.name for path in out.glob("*.la[sz]")} == {f"{n}.{format}" for n in range(6)}
    assert {tile.is_copc for tile in open_survey([out]).tiles} == {format == "copc.laz"}


def test_outputs_that_would_do_harm_are_refused(six, out, tmp_path):
    with pytest.raises(BareEarthError, match="same folder"):
        classify(six, six)
    with pytest.raises(BareEarthError, match="searched for inputs"):
        classify(six, six / "out", recursive=True)
    with pytest.raises(BareEarthError, match=r"name it \.vpc"):
        classify(six, out, vpc=tmp_path / "a.json")
    with pytest.raises(BareEarthError, match="does not exist"):
        classify(six, tmp_path / "no" / "where")
    other = cut(tmp_path / "other", strip(500), 2)
    with pytest.raises(BareEarthError, match="would both become"):
        classify([six, other], out)
    assert not out.exists() and not (six / "out").exists()


# Tiles that are done


def changed_times(folder):
    return {path.name: path.stat().st_mtime_ns for path in finished(folder)}


def test_tiles_that_are_done_are_kept_when_a_run_goes_on(six, out):
    classify(six, out, blocks=BLOCKS)
    before = changed_times(out)
    (out / "3.laz").unlink()
    progress = Heard()
    summary = classify(six, out, resume=True, blocks=BLOCKS, progress=progress)
    after = changed_times(out)
    assert {name for name in after if after[name] != before[name]} == {"3.laz"}
    assert summary.kept_count == 5 and summary.done_count == 6
    assert "5 files are done already." in progress.infos
    assert summary.point_count == 4000
    # Without asking for it everything is done anew.
    assert classify(six, out, blocks=BLOCKS).kept_count == 0
    assert all(changed_times(out)[name] != after[name] for name in after)


@pytest.mark.rest
def test_other_parameters_or_inputs_make_tiles_anew_where_they_matter(six, out):
    classify(six, out, blocks=Blocks(40.0, 5.0))
    survey = dict(resume=True, blocks=Blocks(40.0, 5.0))
    other, progress = {"height_threshold": 0.4}, Heard()
    assert classify(six, out, **other, progress=progress, **survey).kept_count == 0
    assert any("6 finished files" in text for text in progress.infos)
    assert classify(six, out, **other, **survey).kept_count == 6
    other["others"] = "unclassified"
    assert classify(six, out, **other, **survey).kept_count == 0
    # One file at the end is written anew: those far from it stay.
    os.utime(six / "5.laz", ns=(1, 1))
    before = changed_times(out)
    summary = classify(six, out, **other, **survey)
    assert 1 <= summary.kept_count < 6
    after = changed_times(out)
    assert after["5.laz"] != before["5.laz"] and after["0.laz"] == before["0.laz"]


@pytest.mark.rest
@pytest.mark.parametrize(
    "added", [pytest.param(("0", "1"), marks=pytest.mark.long), ("9",)], ids=str
)
def test_of_a_survey_to_which_tiles_are_added_only_their_neighbours_are_done_anew(
    added, many, out, tmp_path
):
    every = sorted(many[0].iterdir())
    (tmp_path / "some").mkdir()
    for path in every:
        if path.stem not in added:
            shutil.copy2(path, tmp_path / "some")
    run = dict(blocks=Blocks(50.0, 8.0))
    classify(tmp_path / "some", out, **run)
    before = changed_times(out)
    for name in added:
        shutil.copy2(many[0] / f"{name}.laz", tmp_path / "some")
    summary = classify(tmp_path / "some", out, resume=True, **run)
    anew = {name for name, time in changed_times(out).items() if time != before.get(name)}
    extents = {path.name: laspy.read(path).header for path in every}
    for name in before:
        gap = min(
            np.max(np.maximum(mine.mins - extents[name].maxs, extents[name].mins - mine.maxs)[:2])
            for mine in (extents[f"{new}.laz"] for new in added)
        )
        assert gap > 0 or name in anew  # it touches one that was added
        assert gap < 50.0 + 8.0 or name not in anew
    assert summary.kept_count == 10 - len(anew) >= 4
    assert bytes_of(out) == many[1]  # with this filter the blocks do not matter


def test_the_blocks_of_a_method_do_not_move_with_the_survey(tmp_path, out):
    folder, integers = tmp_path / "in", strip(400, 60.0, 60.0)
    folder.mkdir()
    for east in (0, 2100, 4200):
        write(folder / f"{east}.laz", integers + np.array([100 * east, 0, 0]))
    classify(folder, out)
    before = changed_times(out)
    # In the west, near the first block, and lower and higher than all others.
    write(folder / "new.laz", strip(400, 60.0, 300.0, 4) - [6100, 12_000, 0])
    assert classify(folder, out, resume=True).kept_count == 2
    anew = {name for name, time in changed_times(out).items() if time != before.get(name)}
    assert anew == {"0.laz", "new.laz"}


@pytest.mark.rest
def test_runs_with_heights_go_on_and_repeat_only_what_changed(tmp_path, out):
    folder, integers = tmp_path / "in", strip(400, 60.0, 60.0)
    folder.mkdir()
    for east in (0, 2100, 4200):
        write(folder / f"{east}.laz", integers + np.array([100 * east, 0, 0]))
    made = dict(height_above_ground=True)
    classify(folder, out, **made)
    before, dtm = changed_times(out), tmp_path / "dtm.tif"
    summary = classify(folder, out, resume=True, dtm=dtm, **made)
    assert summary.kept_count == summary.done_count == 3 and changed_times(out) == before
    assert dtm.exists()
    # A file in the west, and one that is written anew without a change.
    write(folder / "new.laz", strip(400, 60.0, 300.0, 4) - [6100, 12_000, 0])
    os.utime(folder / "4200.laz", ns=(1, 1))
    summary = classify(folder, out, resume=True, **made)
    assert summary.kept_count == 1 and summary.done_count == 4
    anew = {name for name, time in changed_times(out).items() if time != before.get(name)}
    assert anew == {"0.laz", "4200.laz", "new.laz"}
    classify(folder, tmp_path / "once", **made)
    assert bytes_of(out) == bytes_of(tmp_path / "once")
    # Heights depend on the method that found the ground.
    other = {"height_threshold": 0.4}
    assert classify(folder, out, **other, resume=True, **made).kept_count == 0
    (folder / "new.laz").write_bytes(b"no cloud")
    summary = classify(folder, out, **other, resume=True, **made)
    assert summary.kept_count == 2 and summary.done_count == 3 and len(summary.failures) == 1
    # What is not classified is written as well.
    write(folder / "new.laz", strip(400, 60.0, 60.0) - [60_000_000, 0, 0], classes=7)
    summary = classify(folder, out, **other, resume=True, **made)
    assert summary.kept_count == 3 and summary.done_count == 4 and not summary.failures


# The command, which sends itself a signal when the first tile is done.
_KILLED = """
import os, sys
from bare_earth.algorithms import cli
from bare_earth.algorithms.cli.terminal import Terminal
def kill(terminal, text):
    if ".laz:" in text:
        Terminal.info = lambda *_: None
        os.kill(os.getpid(), {number:d})
Terminal.info = kill
sys.exit(cli.main(sys.argv[1:]))
"""


@pytest.mark.rest
@pytest.mark.skipif(os.name == "nt", reason="Windows has no such signals")
@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGKILL])
def test_a_killed_run_goes_on_and_gives_the_same_bytes(number, many, out):
    folder, expected = many
    words = ["classify", folder, out, "--threads", 2, "--resume"]
    words += ["--method", "slope", "--preset", "whitebox"]
    run = subprocess.run(
        [sys.executable, "-c", _KILLED.format(number=number), *map(str, words)],
        env=environment(), stderr=subprocess.PIPE, text=True, timeout=120,
    )  # fmt: skip
    # Its processes have ended, too: until then they keep the pipe open.
    said, done = run.stderr, changed_times(out)
    assert 1 <= len(done) < 10
    if number == signal.SIGTERM:
        assert run.returncode == 1 and "Continue with --resume" in said
        assert not temporary_in(out)
    for path in finished(out):
        laspy.read(path)
    summary = classify(folder, out, resume=True)
    assert summary.done_count == 10
    assert not temporary_in(out)
    kept = [name for name in done if changed_times(out)[name] == done[name]]
    # At most the last ones were there without their record.
    assert len(kept) == summary.kept_count >= len(done) - 2
    assert bytes_of(out) == expected


# What goes wrong


@pytest.mark.rest
def test_broken_tiles_are_told_at_the_end_and_the_others_done(six, out, capsys):
    data = (six / "1.laz").read_bytes()
    (six / "1.laz").write_bytes(data[:900] + bytes(300) + data[1200:])
    (six / "9.laz").write_bytes(b"no cloud")
    progress = Heard()
    summary = classify(six, out, blocks=BLOCKS, progress=progress)
    assert [Path(path).name for path in summary.failures] == ["1.laz", "9.laz"]
    assert summary.done_count == 5 and summary.tile_count == 7
    assert set(bytes_of(out)) == {"0.laz", "2.laz", "3.laz", "4.laz", "5.laz"}
    assert any("1.laz is left out: " in text for text in progress.warnings)
    assert len(read_vpc(out / "classified.vpc")) == 5
    assert main(["classify", str(six), str(out), "--method", "slope", "--json"]) == 1
    said = capsys.readouterr()
    assert json.loads(said.out)["done_count"] == 5
    assert f"{six / '9.laz'} is left out." in said.err
    # Once it is there again, it is done, and those beside it anew.
    (six / "1.laz").write_bytes(data)
    (six / "9.laz").unlink()
    summary = classify(six, out, resume=True, blocks=BLOCKS)
    assert summary.done_count == 6 and not summary.failures


def test_a_tile_without_points_that_can_be_ground_is_written_unchanged(six, out):
    high = np.array([[900_000 + 7 * n, 900_000 + 5 * n, 900] for n in range(30)])
    write(six / "water.laz", high, classes=9)
    progress = Heard()
    summary = classify(six, out, progress=progress)
    assert summary.done_count == 7 and not summary.failures
    assert (out / "water.laz").read_bytes() == (six / "water.laz").read_bytes()
    (told,) = [text for text in progress.warnings if "unchanged" in text]
    assert told.startswith("water.laz has no ground: ")
    assert re.search(r" 30 points .* class 9\.$", told)
    assert len(read_vpc(out / "classified.vpc")) == 7


def test_a_survey_of_which_nothing_can_be_classified_fails(tmp_path, out):
    (tmp_path / "in").mkdir()
    write(tmp_path / "in" / "a.laz", strip(500), classes=18)
    with pytest.raises(BareEarthError, match=r"^a\.laz has no ground.* class 18\b"):
        classify(tmp_path / "in", out)
    assert not (out / "classified.vpc").exists() and not (out / "a.laz").exists()


@pytest.mark.rest
def test_points_outside_of_the_extent_in_the_header_are_not_lost_silently(six, out):
    with open(six / "2.laz", "r+b") as file:
        file.seek(179)
        box = np.frombuffer(file.read(48), "<f8").copy()
        box[0] = box[1] + 1.0  # largest x, near the smallest
        file.seek(179)
        file.write(box.tobytes())
    summary = classify(six, out, blocks=Blocks(20.0, 5.0))
    assert [Path(path).name for path in summary.failures] == ["2.laz"]
    assert "smaller extent" in str(summary.failures)


def test_a_stray_point_far_away_does_not_stop_a_survey(tmp_path, out):
    integers = np.vstack((strip(4000), [[100_000_000, 100_000_000, 6000]]))
    folder = cut(tmp_path / "in", integers[:-1], 4)
    write(folder / "stray.laz", integers[-40:])
    summary = classify(folder, out, blocks=Blocks(100.0, 10.0))
    assert summary.done_count == 5 and not summary.failures


@pytest.mark.rest
@pytest.mark.skipif(os.name == "nt", reason="it kills by signals")
@pytest.mark.parametrize("threads", [1, 2])
def test_a_process_that_dies_loses_nothing(threads, many, out):
    # With one thread, the job is the only one that runs when its process dies.
    folder, expected = many
    killed = []

    class Killer(Progress):
        def info(self, text):
            if ".laz:" in text and not killed:
                victim = multiprocessing.active_children()[0]
                victim.kill()
                killed.append(victim)

    workers = Processes(Resources(threads=threads))
    summary = classify_tiles([folder], out, FAST, progress=Killer(), workers=workers)
    assert killed and not summary.failures and summary.done_count == 10
    assert bytes_of(out) == expected
    assert not temporary_in(out)


@pytest.mark.rest
@pytest.mark.skipif(os.name == "nt", reason="it kills by signals")
def test_a_tile_that_kills_its_process_fails_alone(six, out):
    workers = replacing_jobs(Processes, instead_of("3.laz", DeadlyJob))
    summary = classify_tiles([six], out, FAST, workers=workers)
    assert list(summary.failures) == [str(six / "3.laz")]
    assert "ended unexpectedly" in summary.failures[str(six / "3.laz")]
    assert summary.done_count == 5 and len(finished(out)) == 5


def test_a_job_that_fails_fails_its_tile_only(six, out):
    workers = replacing_jobs(Threads, instead_of("4.laz", HungryJob))
    summary = classify_tiles([six], out, FAST, workers=workers)
    assert summary.done_count == 5
    assert "not enough memory" in summary.failures[str(six / "4.laz")]


class FailingInTheEast(LabelGround):
    """Cannot label the blocks in the east."""

    def in_block(self, visit, progress):
        if visit.store.leaves.x.max() > 500_110.0:
            raise ValueError("no")
        return super().in_block(visit, progress)


@pytest.mark.rest
@pytest.mark.parametrize("heights", [False, True])
def test_labelling_that_fails_fails_the_tiles_of_that_block_only(six, out, tmp_path, heights):
    def failing(job):
        if isinstance(job, BlockJob) and isinstance(step := job.output.grid.step, LabelGround):
            own = {field.name: getattr(step, field.name) for field in dataclasses.fields(step)}
            grid = dataclasses.replace(job.output.grid, step=FailingInTheEast(**own))
            output = dataclasses.replace(job.output, grid=grid)
            return dataclasses.replace(job, output=output)

    blocks, workers = Blocks(20.0, 5.0), replacing_jobs(Threads, failing)
    points = PointOutput(height_above_ground=heights)
    summary = classify_tiles([six], out, FAST, blocks=blocks, workers=workers, points=points)
    assert 0 < len(summary.failures) < 6
    assert all("Unexpected ValueError: no" in reason for reason in summary.failures.values())
    assert summary.done_count == 6 - len(summary.failures)
    # Heights beside it lack its ground, so a later run makes them again.
    run = dict(blocks=blocks, points=points)
    summary = classify_tiles([six], out, FAST, output=TileOutput(resume=True), **run)
    assert summary.done_count == 6 and (summary.kept_count > 0) == (not heights)
    classify_tiles([six], tmp_path / "once", FAST, **run)
    assert bytes_of(out) == bytes_of(tmp_path / "once")


def test_one_block_is_worked_off_in_this_process(six, tmp_path, monkeypatch):
    def refuse(*_):
        raise OSError("no other process is allowed")

    monkeypatch.setattr(Processes, "start", refuse)
    monkeypatch.setattr(workers_module, "Processes", Processes)  # not threads, as elsewhere here
    local = Local(Resources(threads=2))
    blocks = Blocks(200.0, 5.0, start=-20.0)
    done = classify_tiles([six], tmp_path / "one", FAST, workers=local, blocks=blocks).done_count
    assert done == 6
    with pytest.raises(OSError, match="no other process"):
        classify_tiles([six], tmp_path / "many", FAST, workers=local, blocks=Blocks(20.0, 5.0))


@pytest.mark.rest
@pytest.mark.parametrize("kind", [Threads, Processes])
def test_a_cancel_is_heard_and_finished_tiles_stay(kind, many, out):
    folder, expected = many
    progress = CancelAtFirstFile()
    with pytest.raises(Cancelled):
        classify_tiles([folder], out, FAST, progress=progress, workers=kind(Resources(threads=2)))
    done = bytes_of(out)
    assert 1 <= len(done) < 10
    assert not temporary_in(out)
    summary = classify(folder, out, resume=True)
    assert summary.done_count == 10 and summary.kept_count >= 1
    assert bytes_of(out) == expected


@pytest.mark.rest
def test_blocks_labelled_before_a_cancel_are_not_labelled_again(many, out):
    labels, run = (
        out / ".bare-earth" / "work",
        dict(blocks=Blocks(50.0, 10.0), resume=True, threads=1),
    )

    class Watcher(Progress):
        def __init__(self):
            self.seen = {}

        def report(self, fraction):
            for name, when in states_of(labels).items():
                assert self.seen.setdefault(name, when) == when

    with pytest.raises(Cancelled):
        classify(many[0], out, progress=CancelAtFirstFile(), **run)
    watcher, waiting = Watcher(), states_of(labels)
    watcher.seen.update(waiting)
    classify(many[0], out, progress=watcher, **run)
    assert waiting and len(watcher.seen) > len(waiting)
    assert bytes_of(out) == many[1]  # with this filter the blocks do not matter
    assert not labels.exists()


def test_a_second_run_into_the_same_folder_is_refused_and_the_first_goes_on(six, tmp_path):
    refused = []

    class Second(Progress):
        def report(self, fraction):
            if fraction > 0.1 and not refused:
                with pytest.raises(BareEarthError, match="Another run") as error:
                    classify(six, tmp_path / "out")
                refused.append(error)

    first = classify(six, tmp_path / "out", progress=Second())
    assert refused and first.done_count == 6
    again = classify(six, tmp_path / "out", resume=True)
    assert again.kept_count == 6


@pytest.mark.rest
@pytest.mark.parametrize("kind", [Threads, Processes])
def test_a_job_may_use_the_threads_that_other_jobs_leave_free(kind, tmp_path):
    workers = kind(Resources(threads=2, memory=1.0))
    workers.start(tmp_path, 1, 2, 2)
    try:
        assert workers.at_once == 2 and workers.share.thread_count == 1
        one, other = tmp_path / "one", tmp_path / "other"
        jobs = CountingJob(one, other, False), CountingJob(other, one, True)
        first, last = [workers.submit(job).future for job in jobs]
        assert first.result().result == [1] and last.result().result == [1, 2]
    finally:
        workers.stop()


def test_a_tile_that_changed_since_its_points_were_labelled_is_not_written(six, out):
    workers = replacing_jobs(Threads, instead_of("2.laz", OvertakenJob))
    done = classify_tiles([six], out, FAST, workers=workers)
    assert [Path(path).name for path in done.failures] == ["2.laz"]
    assert "2.laz has changed" in next(iter(done.failures.values()))
    assert not (out / "2.laz").exists() and done.done_count == 5


def test_the_virtual_point_cloud_of_the_inputs_is_not_overwritten(six, tmp_path):
    listed = tmp_path / "in.vpc"
    write_vpc(listed, sorted(six.iterdir()))
    before = listed.read_bytes()
    with pytest.raises(BareEarthError, match=r"same file, .*in\.vpc"):
        classify(listed, tmp_path / "out", vpc=tmp_path / "." / "in.vpc")
    assert listed.read_bytes() == before and not (tmp_path / "out").exists()


@pytest.mark.skipif(sys.platform in ("win32", "darwin"), reason="names are Unicode there")
def test_a_name_that_is_not_utf_8_harms_nobody(six, tmp_path):
    files = sorted(six.iterdir())
    files[2].rename(six / "t\udcff\n.laz")
    done = classify(six, tmp_path / "out")
    assert done.done_count == 6 and not done.failures
    assert (tmp_path / "out" / "t\udcff\n.laz").exists()
    assert {path.name for path in read_vpc(Path(done.vpc))} == set(os.listdir(six))


def test_methods_in_short_have_the_presets_of_all():
    for name in METHODS:
        for preset in TileMethod.declarations()[1].choices:
            chosen = TileMethod(method=name, preset=preset)
            assert chosen.parameters == METHODS[name].parameters(preset=preset)
