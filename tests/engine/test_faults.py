"""Full disks, killed runs and failing renames, over all commands that write.

Nothing is lost, nothing half written. `BARE_EARTH_KILLS=200 make test-long` kills that many runs of
each command. All of it can be run by the Python of QGIS, too, so that GDAL writes the rasters.
"""

import errno
import json
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from runs import command, environment, temporary_in
from surveys import cut, strip, write

from bare_earth.algorithms.cli import main
from bare_earth.algorithms.engine import workers
from bare_earth.algorithms.rasters.geotiff import read_raster

pytestmark = [
    pytest.mark.processes,
    pytest.mark.skipif(sys.platform != "linux", reason="it needs namespaces, and kills by signals"),
]
KILLS = int(os.environ.get("BARE_EARTH_KILLS", "10"))

# What each command is asked for; OUT is a folder with the files of a run before.
COMMANDS = {
    "classify": "classify {one} OUT/out.laz --method slope --dtm OUT/dtm.tif --hillshade OUT/h.tif",
    "on-disk": "classify {one} OUT/out.laz --method slope --dtm OUT/dtm.tif"
    " --height-above-ground --memory 0.005",
    "copc": "classify {one} OUT/out.copc.laz --method slope",
    "copc-on-disk": "classify {larger} OUT/out.copc.laz --method slope --memory 0.005",
    "survey": "classify {many} OUT/out --method slope --dtm OUT/dtm.tif --height-above-ground"
    " --threads 2 --resume --vpc OUT/all.vpc",
    "height": "height {classified} OUT/out.laz",
    "heights": "height {survey} OUT/out --threads 2",
    "key-points": "key-points {classified} OUT/out.laz --memory 0.005",
    "terrain": "terrain {classified} --dtm OUT/dtm.tif --dsm OUT/dsm.tif --chm OUT/chm.tif",
    "terrains": "terrain {survey} --dtm OUT/dtm.tif --dsm OUT/dsm.tif --threads 2",
    "assess": "assess {classified} {classified} --report OUT/page.html --error-map OUT/map.tif",
    "compare": "compare-settings {one} OUT/page.html --settings slope:town slope:automatic"
    " --extent 500000 5700000 500100 5700100",
    "canopy": "canopy {dsm} {dsm} OUT/chm.tif",
    "canopy-change": "canopy-change {dsm} {dsm} OUT/chm.tif --places OUT/places.geojson",
    "objects": "remove-off-terrain-objects {dsm} OUT/dtm.tif",
}
# Those that write many files, of which each is told on its own.
SURVEYS = ("survey", "heights")


def _made_inputs(folder, count, width, run):
    """Make one file, many, the same classified, and a raster, by what runs commands."""
    points = strip(count, width, width / 2)
    names = ("one.laz", "larger.laz", "many", "classified.laz", "survey")
    paths = {name: folder / name for name in names}
    write(paths["one.laz"], points)
    # More than a node of COPC may have.
    write(paths["larger.laz"], strip(2 * count, width, width / 2))
    cut(paths["many"], points, 6)
    slope = ("--method", "slope")
    assert run("classify", paths["one.laz"], paths["classified.laz"], *slope) == 0
    assert run("classify", paths["many"], paths["survey"], *slope) == 0
    assert run("terrain", paths["classified.laz"], "--dsm", folder / "dsm.tif") == 0
    names = {name.partition(".")[0]: str(path) for name, path in paths.items()}
    return {**names, "dsm": str(folder / "dsm.tif")}


@pytest.fixture(scope="module")
def inputs(tmp_path_factory):
    folder = tmp_path_factory.mktemp("faults")
    return _made_inputs(folder, 60_000, 400.0, lambda *words: _run(*words).returncode)


def _run(*words, **more):
    return subprocess.run(
        command(*words), env=environment(), capture_output=True, text=True, timeout=300, **more
    )


def _words(name, inputs, out):
    return COMMANDS[name].format(**inputs).replace("OUT", str(out)).split()


def _old_outputs(name, inputs, out):
    """Write what a run before may have left; return it."""
    out.mkdir(exist_ok=True)
    old = {}
    for word in _words(name, inputs, out)[2:]:
        if word.startswith(str(out)) and Path(word).suffix:
            Path(word).write_bytes(b"old")
            old[word] = b"old"
    return old


def _hidden(out):
    """Return what runs must not leave; the record of a survey is one of its outputs."""
    return [*temporary_in(out), *out.rglob("*.tmp")]


def _shown(out):
    """Return all files that are not hidden, with what they hold."""
    files = [path for path in out.rglob("*") if path.is_file()]
    here = len(out.parts)
    return {
        str(path): path.read_bytes()
        for path in files
        if not any(part.startswith(".") for part in path.parts[here:])
    }


def _on_full_disks(name, inputs, enough, out, small, sizes):
    """Run a command with a small disk at some folder, of some sizes; then of the largest too small.

    Each end is looked at: done, or told with nothing changed. To be run where mounts harm nobody.
    Return a list of sizes in KB with the exit code of each.
    """
    ends, sizes = {}, sorted(sizes, reverse=True)
    while sizes:
        size = sizes.pop()
        shutil.rmtree(out, ignore_errors=True)
        out.mkdir()
        small.mkdir(parents=True, exist_ok=True)
        mount = ["mount", "-t", "tmpfs", "-o", f"size={size}k", "none", str(small)]
        subprocess.run(mount, check=True)
        try:
            old = _old_outputs(name, inputs, out)
            done = _run(*_words(name, inputs, out))
            ends[size] = done.returncode
            sizes = sizes if done.returncode else []  # more than enough was seen often enough
            _look_at(name, done, out, old, enough)
        finally:
            subprocess.run(["umount", str(small)], check=True)
        failed = max((size for size, code in ends.items() if code), default=0)
        larger = min((size for size, code in ends.items() if not code and size > failed), default=0)
        if not sizes and larger - failed > 4:  # a page of memory, the least that a disk grows
            sizes.append((failed + larger) // 8 * 4)
    return ends


def _look_at(name, done, out, old, enough):
    """Check what a run left; `enough` holds what it writes where there is room."""
    what = f"{name}: {done.returncode} {done.stderr}"
    lines = done.stderr.strip().splitlines()
    assert not _hidden(out), what
    if done.returncode == 0:
        assert all(Path(path).read_bytes() != b"old" for path in old), what
        return
    assert done.returncode == 1 and "Unexpected" not in done.stderr, what
    assert len([line for line in lines if line.startswith("bare-earth: ")]) <= 1, what
    assert "disk is full" in done.stderr or "No space left" in done.stderr, what
    if name not in SURVEYS:
        assert {path: Path(path).read_bytes() for path in old} == old, what
        assert sorted(map(str, out.iterdir())) == sorted(old), what
    tiles = list(out.glob("out/*.laz"))
    for path in tiles:
        assert path.read_bytes() == (enough / "out" / path.name).read_bytes(), what
    # Of a survey rasters and list are made of the files that could be done; the others are told.
    for path in map(Path, old) if name in SURVEYS else ():
        if path.read_bytes() != b"old":
            if path.suffix == ".tif":
                assert np.isfinite(read_raster(path).heights).any(), what
            else:
                # A tile of which no record could be written is there, but not counted as done.
                assert 0 < len(json.loads(path.read_text())["features"]) <= len(tiles), what


# The folder on the small disk: that of all outputs; of a survey also that of what it keeps of its
# blocks, that of its labels alone, and that of its files, without the rasters and the list.
DISKS = [(name, ".") for name in COMMANDS]
DISKS += [("survey", "out"), ("survey", "out/.bare-earth"), ("survey", "out/.bare-earth/work")]


@pytest.mark.long
@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() != 0, reason="it mounts: as root")
@pytest.mark.parametrize(("name", "place"), DISKS)
def test_a_full_disk_changes_nothing_and_is_told_in_a_sentence(name, place, inputs, tmp_path):
    out, enough = tmp_path / "full", tmp_path / "enough"
    old = _old_outputs(name, inputs, enough)
    done = _run(*_words(name, inputs, enough))
    assert done.returncode == 0, done.stderr
    needed = sum(path.stat().st_size for path in enough.rglob("*") if path.is_file()) // 1024
    sizes = [
        int(share * needed) + 4 * len(old) + 4
        for share in (0.0, 0.3, 0.6, 0.9, 1.2, 2.0, 4.0, 20.0)
    ]
    # The mount is gone with the process that made it, and is seen by nobody else.
    script = f"""
import sys
from pathlib import Path
sys.path[:0] = {[str(Path(__file__).parent), *sys.path]!r}
import test_faults
paths = map(Path, {[str(enough), str(out), str(out / place)]!r})
ends = test_faults._on_full_disks({name!r}, {inputs!r}, *paths, {sizes!r})
test_faults.json.dump(ends, sys.stdout)
"""
    found = subprocess.run(
        ["unshare", "--mount", sys.executable, "-c", script],
        capture_output=True, text=True, timeout=600, env=environment(),
    )  # fmt: skip
    if found.returncode and "unshare" in found.stderr:
        pytest.skip("this machine permits no mounts")
    assert found.returncode == 0, found.stderr
    ends = json.loads(found.stdout)
    print(f"{name} in {place}: {sum(ends.values())} of {len(ends)} disks were too small: {ends}")
    assert set(ends.values()) == {0, 1}


@pytest.mark.long
@pytest.mark.skipif("BARE_EARTH_NFS" not in os.environ, reason="`.ci/on-nfs` gives a network disk")
@pytest.mark.parametrize("name", COMMANDS)
def test_a_full_network_disk_changes_nothing_and_is_told_in_a_sentence(name, inputs, tmp_path):
    """A small disk, which a file fills but for what a run is to have."""
    disk, enough = Path(os.environ["BARE_EARTH_NFS"]), tmp_path / "enough"
    out, filling = disk / "out", disk / "filling"
    _old_outputs(name, inputs, enough)
    done = _run(*_words(name, inputs, enough))
    assert done.returncode == 0, done.stderr
    needed = sum(path.stat().st_size for path in enough.rglob("*") if path.is_file())
    ends = {}
    for share in (0.0, 0.3, 0.6, 0.9, 1.0, 1.1, 1.5, 3.0, 10.0, 20.0):
        filling.unlink(missing_ok=True)
        _without(out)
        old, room = _old_outputs(name, inputs, out), int(share * needed) + 8192
        # Nothing else is there; what is free, the client remembers for a while.
        taken = room + 4096 * (len(old) + 2)
        filling.write_bytes(bytes(shutil.disk_usage(disk).total - taken))
        done = _run(*_words(name, inputs, out))
        ends[room // 1024] = done.returncode
        end = time.monotonic() + 10  # the client removes soon what a process had open
        while list(out.rglob(".nfs*")) and time.monotonic() < end:
            time.sleep(0.1)
        _look_at(name, done, out, old, enough)
        if not done.returncode:
            break
    filling.unlink(missing_ok=True)
    _without(out)
    print(f"{name}: {sum(ends.values())} of {len(ends)} disks were too small: {ends}")
    assert set(ends.values()) == {0, 1}


def _without(folder):
    """Remove a folder of a network disk, which takes a moment for what was open just now."""
    end = time.monotonic() + 10
    while folder.exists() and time.monotonic() < end:
        shutil.rmtree(folder, ignore_errors=True)


# Cells of one byte that hardly shrink, and so many that they wait on disk.
LARGE_RASTER = """
import subprocess, sys
from pathlib import Path
import numpy as np
from bare_earth import BareEarthError, Progress
from bare_earth.algorithms.core.points import Frame
from bare_earth.algorithms.rasters.geotiff import RasterGrid
from bare_earth.algorithms.rasters.writing import Rows, write_geotiff

side, target = 8192, Path(sys.argv[1], "out.tif")
part = np.random.default_rng(1).integers(1, 200, (256, side), dtype=np.uint8)
grid = RasterGrid(0.0, float(side), 1.0, side, side, Frame())
for megabytes in (1, 40, 64, 66, 70, 120, 220):
    subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={megabytes}m", "none", sys.argv[1]])
    target.write_bytes(b"old")
    try:
        rows = Rows((side, side), "uint8", (part for _ in range(side // 256)))
        write_geotiff(target, rows, grid, 255, Progress(), "classes")
        print("done", end=" ")
    except BareEarthError as error:
        print(error, end=" ")
    print(target.read_bytes() == b"old", [path.name for path in target.parent.iterdir()])
    subprocess.run(["umount", sys.argv[1]], check=True)
"""


@pytest.mark.long
@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() != 0, reason="it mounts: as root")
def test_a_large_raster_on_a_full_disk_is_told(tmp_path):
    found = subprocess.run(
        ["unshare", "--mount", sys.executable, "-c", LARGE_RASTER, str(tmp_path)],
        capture_output=True, text=True, timeout=600, env=environment(),
    )  # fmt: skip
    if found.returncode and "unshare" in found.stderr:
        pytest.skip("this machine permits no mounts")
    assert (found.returncode, found.stderr) == (0, "")
    *told, last = found.stdout.splitlines()
    assert last == "done False ['out.tif']" and len(told) == 6
    for line in told:
        assert line.startswith(f"Cannot write {tmp_path}/out.tif: ") and line.endswith(
            "True ['out.tif']"
        )
        assert "the disk is full" in line or "No space left" in line


@pytest.mark.long
@pytest.mark.parametrize("name", COMMANDS)
def test_killed_runs_leave_old_files_or_whole_new_ones(name, inputs, tmp_path):
    out, random = tmp_path / "out", np.random.default_rng(len(name))
    old = _old_outputs(name, inputs, out)
    begun = time.monotonic()
    assert _run(*_words(name, inputs, out)).returncode == 0
    duration = time.monotonic() - begun
    expected = _shown(out)
    killed = changed = 0
    for number in range(KILLS):
        if number % 4 == 0:
            shutil.rmtree(out)
            old = _old_outputs(name, inputs, out)
        process = subprocess.Popen(
            command(*_words(name, inputs, out)), env=environment(),
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        )  # fmt: skip
        # One that goes on from where the last was killed takes less time.
        time.sleep(random.uniform(0.1, 0.6 if number % 4 else 1.0) * duration)
        process.send_signal(signal.SIGKILL)
        killed += process.wait() != 0
        found = _shown(out)
        assert set(old) <= set(found) <= set(expected)
        assert all(content in (b"old", expected[path]) for path, content in found.items())
        changed += any(content != b"old" for content in found.values())
    print(
        f"{name}: {killed} of {KILLS} runs were killed; {changed} times outputs were there by then"
    )
    time.sleep(1.0)
    assert killed
    assert _run(*_words(name, inputs, out)).returncode == 0
    assert _shown(out) == expected
    assert not _hidden(out)


@pytest.mark.long
def test_runs_that_write_into_one_folder_leave_each_other_alone(inputs, tmp_path):
    survey = "classify", inputs["many"], "--method", "slope", "--threads", "1"
    single = "classify", inputs["one"], "--method", "slope", "--memory", "0.005"
    alone, out = tmp_path / "alone", tmp_path / "out"
    for folder in (alone, out):
        folder.mkdir()
    assert _run(*survey[:2], alone, *survey[2:]).returncode == 0
    assert _run(*single[:2], alone / "one-0.laz", *single[2:]).returncode == 0
    begun = subprocess.Popen(command(*survey[:2], out, *survey[2:]), env=environment())
    while not (out / ".bare-earth" / "lock").exists():
        time.sleep(0.01)
    others = [
        subprocess.Popen(
            command(*single[:2], out / f"one-{number}.laz", *single[2:]), env=environment()
        )
        for number in range(3)
    ]
    second = _run(*survey[:2], out, *survey[2:])
    assert begun.poll() is None and second.returncode == 1
    assert "Another run writes into" in second.stderr
    assert [value.wait() for value in (begun, *others)] == [0] * 4
    expected = {path.name: path.read_bytes() for path in alone.glob("*.laz")}
    for number in range(1, 3):
        expected[f"one-{number}.laz"] = expected["one-0.laz"]
    assert {path.name: path.read_bytes() for path in out.glob("*.laz")} == expected
    assert not _hidden(out)


@pytest.fixture(scope="module")
def small_inputs(tmp_path_factory):
    def run(*words):
        return main([*map(str, words)])

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(workers, "Processes", workers.Threads)
        return _made_inputs(tmp_path_factory.mktemp("small"), 2_000, 70.0, run)


@pytest.mark.rest
@pytest.mark.parametrize("name", COMMANDS)
def test_a_rename_that_fails_is_told_and_one_that_was_done_counts(
    name, small_inputs, tmp_path, monkeypatch, capsys, threads_for_processes
):
    out, rename = tmp_path / "out", os.replace

    def run(number, is_done):
        """Let each rename report an error, as a network disk may; return the old outputs."""

        def report_an_error(source, target):
            if is_done:
                rename(source, target)
            raise OSError(number, os.strerror(number), str(source), None, str(target))

        shutil.rmtree(out, ignore_errors=True)
        old = _old_outputs(name, small_inputs, out)
        with monkeypatch.context() as patch:
            patch.setattr(os, "replace", report_an_error)
            code = main(_words(name, small_inputs, out))
        assert not _hidden(out)
        return code, old

    code, old = run(errno.ESTALE, False)
    said = capsys.readouterr().err
    assert code == 1 and "network disk" in said
    assert len([line for line in said.splitlines() if line.startswith("bare-earth: ")]) == 1
    assert {path: Path(path).read_bytes() for path in old} == old
    assert not list(out.rglob("*.laz")) or name not in SURVEYS
    code, old = run(errno.ENOENT, True)
    assert code == 0, capsys.readouterr().err
    assert all(Path(path).read_bytes() != b"old" for path in old)
