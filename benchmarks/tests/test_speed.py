"""The benchmark of speed on tiles small enough for every run, and with contestants made up here."""

import json
import shutil
import subprocess
import sys

import numpy as np
import pytest

from benchmarks import cache, report
from benchmarks.speed import __main__ as speed
from benchmarks.speed import contestants, goals, profiling, results, tiles
from benchmarks.speed.contestants import Contestant
from benchmarks.speed.process import ROOT, Cost, measure
from benchmarks.speed.results import Results, Run

pytest.importorskip("resource")
COUNT = 20_000


@pytest.fixture(scope="module")
def survey(tmp_path_factory):
    path = tmp_path_factory.mktemp("survey") / "survey.laz"
    tiles.write(COUNT, path)
    return path


def python(code):
    return [sys.executable, "-c", code]


def taker(name, code):
    """Return a contestant that runs some code with `source` and `target`."""
    start = "import sys, shutil, time; source, target = sys.argv[1:]; "
    return Contestant(
        name, name, lambda source, target: [*python(start + code), str(source), str(target)]
    )


def measured(*commands):
    """Return what commands cost, measured from a small process: pytest itself may be large."""
    code = (
        "import json, sys; from benchmarks.speed.process import measure;"
        " print(json.dumps([measure(each) for each in json.loads(sys.argv[1])]))"
    )
    done = subprocess.run(
        [*python(code), json.dumps(commands)], cwd=ROOT, stdout=subprocess.PIPE, check=True
    )
    return [Cost(*fields) for fields in json.loads(done.stdout)]


@pytest.mark.long
def test_cost_is_that_of_the_process():
    busy = "import time\nwhile time.process_time() < 0.25: pass"
    parent = (
        "import multiprocessing as m, time\ndef f():\n while time.process_time() < 0.25: pass\n"
        "p = m.get_context('fork').Process(target=f)\np.start(); p.join()"
    )
    large, busy, parent = measured(
        python("import time; b = bytearray(300_000_000); time.sleep(0.3)"),
        python(busy),
        python(parent),
    )
    assert not large.problem
    assert 300e6 < large.memory < 400e6
    assert large.wall > 0.3
    assert 0.25 <= busy.cpu < 5.0
    assert busy.memory < 100e6
    assert parent.cpu >= 0.25


def test_process_that_fails_or_takes_too_long_is_told():
    assert measure(python("raise ValueError('no licence')")).problem == "ValueError: no licence"
    wordy = measure(python("print('word ' * 100_000); raise ValueError('no licence')"))
    assert wordy.problem == "ValueError: no licence"
    assert measure(python("import sys; sys.exit(3)")).problem == "ended with 3"
    late = measure(python("import time; time.sleep(60)"), timeout=0.5)
    assert late.problem == "stopped after 0.5 s"
    assert 0.5 <= late.wall < 30.0


@pytest.mark.rest
def test_survey_is_one(survey, tmp_path):
    import laspy

    las = laspy.read(survey)
    assert len(las) == COUNT
    assert las.header.point_format.id == 6
    assert tiles.tile(survey).density == pytest.approx(tiles.DENSITY, rel=0.1)
    assert (np.diff(las.gps_time) >= 0).all()
    number, total = np.array(las.return_number), np.array(las.number_of_returns)
    # Pulses are whole, but for one that the end may cut.
    starts = np.flatnonzero(number == 1)
    np.testing.assert_array_equal(np.diff(starts), total[starts][:-1])
    assert set(total) == {1, 2, 3, 4}
    _, pulses = np.unique(las.gps_time, return_counts=True)
    np.testing.assert_array_equal(pulses[:-1], total[starts][:-1])
    again = tmp_path / "again.laz"
    tiles.write(COUNT, again)
    assert again.read_bytes() == survey.read_bytes()


def test_survey_has_ground_houses_and_trees(survey):
    from bare_earth.algorithms.filters import METHODS
    from bare_earth.algorithms.las.reading import read_cloud
    from benchmarks.clouds import classify_cloud

    cloud = read_cloud(survey)
    landscape = tiles.Landscape(np.random.default_rng(tiles.SEED))
    x, y = np.random.default_rng(1).uniform(0.0, 3000.0, (2, 50_000))
    solid = landscape.solid(x, y) - landscape.terrain(x, y)
    assert 0.005 < np.mean(solid > 2.5) < 0.2
    top, bottom = landscape.crown(x, y, solid)
    assert 0.05 < np.mean(top - bottom > 1.0) < 0.6
    ground = classify_cloud(cloud, METHODS["slope"].parameters())[0] == 2
    assert 0.4 < ground.mean() < 0.95


@pytest.mark.rest
def test_pieces_of_a_large_survey_are_small_and_cover_a_square(tmp_path, monkeypatch):
    import laspy

    monkeypatch.setattr(tiles, "_PIECE", 5_000)
    monkeypatch.setattr(tiles, "_LINE_WIDTH", 40.0)
    for _, piece in zip(range(30), tiles.survey(100_000)):
        assert 2_500 < len(piece["x"]) < 15_000
    tiles.write(100_000, tmp_path / "survey.laz")
    las = laspy.read(tmp_path / "survey.laz")
    width, depth = (las.header.maxs - las.header.mins)[:2]
    assert width == pytest.approx(depth, rel=0.08)
    assert set(las.point_source_id) == {1, 2, 3}
    assert (np.diff(las.gps_time) >= 0).all()


@pytest.mark.long
def test_all_take_turns_and_who_is_stopped_is_left_out(survey, tmp_path):
    small = tmp_path / "small.laz"
    tiles.write(1000, small)
    chosen = [tiles.tile(survey, "large"), tiles.tile(small, "small")]
    takers = [
        taker("floor", "shutil.copy(source, target)"),
        taker("slow", "time.sleep(60)"),
        taker("thief", f"shutil.copy({str(small)!r}, target)"),
        taker("mute", "pass"),
    ]
    kept = []
    found = speed.measure_all(
        chosen, takers, 2, 1, 2.0, lambda found: kept.append([tile.name for tile in found.tiles])
    )
    assert kept == [["small"], ["small", "large"]]
    assert [tile.name for tile in found.tiles] == ["small", "large"]
    order = [(run.tile, run.round, run.contestant) for run in found.runs]
    assert order == [
        *(("small", 0, name) for name in ("floor", "slow", "thief", "mute")),
        *(("small", 1, name) for name in ("floor", "thief")),
        *(("large", 0, name) for name in ("floor", "thief", "mute")),
        ("large", 1, "floor"),
    ]
    assert found.problem("small", "slow") == "stopped after 2 s"
    assert found.problem("large", "thief") == "wrote 1,000 of 20,000 points"
    assert found.problem("small", "mute") == "wrote 0 of 1,000 points"
    assert not found.costs("large", "thief")
    assert found.problem("large", "slow") == ""


def made_up(times, memory=100, rounds=2):
    """Return results of generated tiles: times of contestants by millions of points."""
    found = Results({"Date": "today"})
    for millions, of_contestants in times.items():
        count = int(millions * 1e6)
        name = tiles.title(count)
        found.tiles.append(tiles.Tile(name, f"/none/{name}.laz", count, count / 8.0, True))
        for number in range(rounds):
            for contestant, seconds in of_contestants.items():
                cost = Cost(seconds * (number + 1), seconds, memory * count)
                found.runs.append(Run(name, contestant, number, cost))
    return found


def test_written_files_are_of_the_kind_of_the_tile(survey, tmp_path):
    import laspy

    laspy.read(survey).write(str(tmp_path / "survey.las"))
    code = "assert target.endswith('.las'); shutil.copy(source, target)"
    runs = speed.compete(tiles.tile(tmp_path / "survey.las"), [taker("floor", code)], 1, 1, 60.0)
    assert [run.cost.problem for run in runs] == [""]


@pytest.mark.rest
def test_programs_take_part_where_they_are_installed(tmp_path, monkeypatch):
    program = tmp_path / "pdal"
    program.write_text("#!/bin/sh\n")
    program.chmod(0o755)
    for path, is_missing in ((str(tmp_path), False), ("", True)):
        monkeypatch.setenv("PATH", path)
        known = {one.name: one for one in contestants.contestants()}
        assert bool(known["pdal"].missing) == is_missing and known["lasr"].missing
    words = known["pdal"].command("a.las", "b.las")
    assert words[:5] == ["pdal", "translate", "a.las", "b.las", "smrf"]


def test_ratios_are_to_the_floor_of_the_same_round():
    found = made_up({1: {"floor": 2.0, "slope": 3.0}})
    assert found.ratio("1 million", "slope") == (1.5, 1.5, 1.5)
    assert found.spread("1 million", "slope", "wall") == (4.5, 3.0, 6.0)
    lost = Run("1 million", "floor", 2, Cost(1.0, 1.0, 1, "lost"))
    found.runs += [lost, Run("1 million", "slope", 2, Cost(900.0, 1.0, 1))]
    assert found.ratio("1 million", "slope") == (1.5, 1.5, 1.5)


def test_exponent_is_that_of_the_generated_tiles():
    times = {size: {"slope": 3.0 * size**1.25} for size in (1, 10, 50)}
    found = made_up(times)
    assert found.exponent("slope") == pytest.approx(1.25)
    assert goal(found, "Slope filter: exponent").verdict == "no"
    near = made_up({size: {"slope": size} for size in (0.2, 1, 5)})
    assert goal(near, "Slope filter: exponent").verdict == "not measured"
    wide = made_up({size: {"slope": max(size, 0.5)} for size in (0.2, 1, 10)})
    assert goal(wide, "Slope filter: exponent")[2:4] == (
        pytest.approx(1.0),
        "1 million to 10 million",
    )
    real = tiles.Tile("real", "/none", 100, 1.0)
    found.tiles.append(real)
    found.runs.append(Run("real", "slope", 0, Cost(1e6, 1.0, 1)))
    assert found.exponent("slope") == pytest.approx(1.25)
    assert made_up({1: {"slope": 1.0}}).exponent("slope") is None


def goal(found, start):
    return next(reached for reached in goals.goals(found) if reached.title.startswith(start))


def test_goals_are_met_missed_or_not_measured():
    fast = {"floor": 10.0, "slope": 19.0, "grid-minimum": 14.5, "cloth": 90.0}
    found = made_up({1: dict(fast, slope=90.0), 4: fast})
    assert goal(found, "Slope filter: time").reached == pytest.approx(1.9)  # 1 million do not count
    assert goal(found, "Slope filter: time").is_met
    assert not goal(found, "Grid minimum: time").is_met
    assert np.isnan(goal(found, "TIN densification: time").reached)
    assert goal(found, "CSF").reached == pytest.approx(90 / 19)
    assert goal(found, "CSF").verdict == "no"
    assert goal(found, "pysmrf").verdict == "not measured"
    assert goal(found, "Slope filter: peak").reached == 100.0
    assert goal(found, "Slope filter: peak").is_met
    assert not goal(made_up({4: fast}, memory=121), "Slope filter: peak").is_met


def test_peer_that_never_ends_took_at_least_its_time():
    found = made_up({1: {"floor": 1.0, "slope": 2.0}})
    cost = Cost(60.0, 60.0, 1, "stopped after 60 s")
    found.runs.append(Run("1 million", "whitebox-wide", 0, cost))
    reached = goal(found, "Whitebox, 18 m")
    assert (reached.reached, reached.where) == (30.0, "1 million, at least")
    assert reached.verdict == "yes"
    found.runs[-1] = found.runs[-1]._replace(cost=cost._replace(wall=4.0))
    assert goal(found, "Whitebox, 18 m").verdict == "open"
    failed = found.runs.pop()._replace(cost=cost._replace(problem="no licence"))
    found.runs.append(failed)
    assert np.isnan(goal(found, "Whitebox, 18 m").reached)


def test_profile_tells_parts_and_functions():
    main = "thread (7): MainThread;main (bare_earth/algorithms/cli/__init__.py:23)"
    stacks = [
        f"{main};read (bare_earth/algorithms/las/reading.py:25);fill (laspy/a.py:3) 30",
        f"{main};write (bare_earth/algorithms/las/writing.py:53);"
        "chunks (bare_earth/algorithms/las/reading.py:9) 20",
        f"{main};slope (bare_earth/algorithms/filters/slope.py:1);wait (threading.py:3) 40",
        f"{main};_find_and_load (<frozen importlib._bootstrap>:1);<module> (numpy/a.py:1) 10",
        "thread (8): Worker;run (x.py:1);erosion (bare_earth/algorithms/grids/m.py:8) 70",
    ]
    found = profiling.summed(stacks, "a tile")
    assert found.shares == {
        "reading": 30.0, "writing": 20.0, "filtering": 40.0, "starting Python": 10.0,
        "the rest": 0.0,
    }  # fmt: skip
    assert found.heaviest[0] == ("erosion (algorithms/grids/m.py)", pytest.approx(7000 / 130))
    assert "wait" not in str(found.heaviest)
    assert found.seconds == 2.0


@pytest.mark.parametrize("name", ["", ": MainThread"])
def test_main_thread_counts_while_it_has_no_name(name):
    stacks = [
        "thread (7);_find_and_load (<frozen importlib._bootstrap>:1) 5",
        f"thread (7){name};read_cloud (bare_earth/algorithms/las/reading.py:1) 15",
        "thread (10): Worker;run (x.py:1) 70",
    ]
    shares = profiling.summed(stacks, "a tile").shares
    assert (shares["starting Python"], shares["reading"]) == (25.0, 75.0)


@pytest.mark.long
def test_page_is_written_of_a_run_and_again_of_its_figures(tmp_path, monkeypatch, capsys):
    pytest.importorskip("matplotlib")
    monkeypatch.setattr(cache, "FOLDER", tmp_path / "cache")
    monkeypatch.setattr(report, "IMAGES", tmp_path / "images")
    monkeypatch.setattr(speed, "PAGE", tmp_path / "performance.md")
    figures = tmp_path / "figures.json"
    given = ["--sizes", "0.02", "--tile", "--rounds", "1", "--only", "slope"]
    speed.main([*given, "--write", "--json", str(figures)])
    printed = capsys.readouterr().out
    page = (tmp_path / "performance.md").read_text(encoding="utf-8")
    assert "| **Slope filter** " in page
    assert "| **Slope filter** " in printed
    assert "Grid minimum** " not in page
    assert "$" not in page
    assert "failed" not in page
    assert (tmp_path / "images" / "speed.png").stat().st_size > 1000
    (tmp_path / "performance.md").unlink()
    speed.main(["--from", str(figures), "--write"])
    assert (tmp_path / "performance.md").read_text(encoding="utf-8") == page


def test_figures_come_back_from_json(tmp_path):
    found = made_up({1: {"floor": 2.0, "slope": 3.0}})
    found.profiles["slope"] = profiling.summed(["thread (7): MainThread;a (b.py:1) 4"], "1 million")
    results.save(found, tmp_path / "a.json")
    again = results.load(tmp_path / "a.json")
    assert again.runs == found.runs
    assert again.facts == found.facts
    assert [str(tile.path) for tile in again.tiles] == [tile.path for tile in found.tiles]
    assert again.profiles["slope"].shares == found.profiles["slope"].shares
    assert list(map(tuple, again.profiles["slope"].heaviest)) == found.profiles["slope"].heaviest


@pytest.mark.long
def test_peers_that_are_there_write_every_point(survey, tmp_path):
    peers = [peer for peer in contestants.contestants() if peer.is_peer and not peer.missing]
    if not peers:
        pytest.skip("No peer is installed.")
    runs = speed.compete(tiles.tile(survey), peers, 1, 1, 60.0)
    assert [run.cost.problem for run in runs] == [""] * len(peers)


@pytest.mark.rest
def test_missing_peers_say_what_installs_them():
    peers = [peer for peer in contestants.contestants() if peer.is_peer]
    programs = {"pdal", "lasr"}
    packages = {peer.name: peer.missing for peer in peers if peer.name not in programs}
    assert len(peers) == len(packages) + len(programs) == 8
    assert all(not missing or missing.startswith("pip install ") for missing in packages.values())


def test_profile_of_a_run(survey):
    if not (profiling.program() or shutil.which("py-spy")):
        pytest.skip("py-spy is not installed")
    slope = next(taker for taker in contestants.contestants() if taker.name == "slope")
    found = profiling.profile(slope.command(survey, survey.with_name("p.laz")), tiles.tile(survey))
    assert sum(found.shares.values()) == pytest.approx(100.0)
    assert found.heaviest
