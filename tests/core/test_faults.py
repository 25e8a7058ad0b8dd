"""Full disks and killed runs, over all commands that write: nothing lost, nothing half written.

`BARE_EARTH_KILLS=200 make test-long` kills that many runs of each command.
"""

import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import laspy
import numpy as np
import pytest
from surveys import cut, strip, write

import bare_earth.algorithms as package

pytestmark = [
    pytest.mark.long,
    pytest.mark.skipif(sys.platform != "linux", reason="it needs namespaces, and kills by signals"),
]
KILLS = int(os.environ.get("BARE_EARTH_KILLS", "10"))

# What each command is asked for; OUT is a folder with the file of a run before.
COMMANDS = {
    "classify": "classify {one} OUT/out.laz --method slope --dtm OUT/dtm.tif --hillshade OUT/h.tif",
    "on-disk": "classify {one} OUT/out.laz --method slope --dtm OUT/dtm.tif"
    " --height-above-ground --memory 0.005",
    "copc": "classify {one} OUT/out.copc.laz --method slope",
    "survey": "classify {many} OUT/out --method slope --dtm OUT/dtm.tif --height-above-ground"
    " --threads 2 --resume",
    "height": "height {classified} OUT/out.laz",
    "key-points": "key-points {classified} OUT/out.laz --memory 0.005",
    "terrain": "terrain {classified} --dtm OUT/dtm.tif --dsm OUT/dsm.tif --chm OUT/chm.tif",
}


@pytest.fixture(scope="module")
def inputs(tmp_path_factory):
    """Return one file, many, and a classified one."""
    folder = tmp_path_factory.mktemp("faults")
    points = strip(60_000, 400.0, 200.0)
    one = write(folder / "one.laz", points)
    cut(folder / "many", points, 6)
    classified = folder / "classified.laz"
    assert _run("classify", one, classified, "--method", "slope").returncode == 0
    return {"one": one, "many": folder / "many", "classified": classified}


def _environment():
    return {**os.environ, "PYTHONPATH": str(Path(package.__file__).parents[2])}


def _command(*words):
    return [sys.executable, "-m", "bare_earth.algorithms", *map(str, words)]


def _run(*words, **more):
    return subprocess.run(
        _command(*words), env=_environment(), capture_output=True, text=True, timeout=300, **more
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
    return [path for path in out.rglob("*") if ".part." in path.name or path.name.endswith(".tmp")]


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() != 0, reason="it mounts: as root")
@pytest.mark.parametrize("name", COMMANDS)
@pytest.mark.parametrize("share", [0.0, 0.3, 0.6, 0.9, 0.99])
def test_a_full_disk_changes_nothing_and_is_told_in_a_sentence(name, share, inputs, tmp_path):
    full, out = tmp_path / "full", tmp_path / "enough"
    _old_outputs(name, inputs, out)
    done = _run(*_words(name, inputs, out))
    assert done.returncode == 0, done.stderr
    needed = sum(path.stat().st_size for path in out.rglob("*") if path.is_file())
    full.mkdir()
    kilobytes = int(share * needed / 1024) + 20
    # The mount is gone with the process that made it, and is seen by nobody else.
    script = f"""
import subprocess, sys
from pathlib import Path
sys.path[:0] = {sys.path!r}
import os
out = Path({str(full)!r})
assert not subprocess.call(["mount", "-t", "tmpfs", "-o", "size={kilobytes}k", "none", str(out)])
import test_faults
old = test_faults._old_outputs({name!r}, {inputs!r}, out)
done = test_faults._run(*test_faults._words({name!r}, {inputs!r}, out))
now = {{name: Path(name).read_bytes() for name in old}}
print(done.returncode, now == old, test_faults._hidden(out), done.stderr.strip().splitlines()[-1:])
"""
    script = script.replace("PosixPath", "Path")
    found = subprocess.run(
        ["unshare", "--mount", sys.executable, "-c", script],
        capture_output=True, text=True, timeout=300, env=_environment(),
    )  # fmt: skip
    if found.returncode and "unshare" in found.stderr:
        pytest.skip("this machine permits no mounts")
    assert found.returncode == 0, found.stderr
    code, same, hidden, said = found.stdout.strip().split(" ", 3)
    assert hidden == "[]" and "Traceback" not in said
    if code == "1":
        assert same == "True" or name == "survey"
        assert "disk is full" in said or "could be done" in said or "left out" in said
    else:  # as in the last of a few kilobytes
        assert code == "0" and share >= 0.9


@pytest.mark.parametrize("name", COMMANDS)
def test_killed_runs_leave_old_files_or_whole_new_ones(name, inputs, tmp_path):
    out, random = tmp_path / "out", np.random.default_rng(len(name))
    old = _old_outputs(name, inputs, out)
    begun = time.monotonic()
    assert _run(*_words(name, inputs, out)).returncode == 0
    duration = time.monotonic() - begun
    expected = {path: Path(path).read_bytes() for path in old}
    killed = 0
    for number in range(KILLS):
        if number % 4 == 0:
            shutil.rmtree(out)
            old = _old_outputs(name, inputs, out)
        process = subprocess.Popen(
            _command(*_words(name, inputs, out)), env=_environment(),
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        )  # fmt: skip
        time.sleep(random.uniform(0.2, 1.0) * duration)
        process.send_signal(signal.SIGKILL)
        killed += process.wait() != 0
        for path in old:
            assert Path(path).read_bytes() in (b"old", expected[path])
        for path in out.rglob("*.la[sz]"):
            if path.parent == out and not path.name.startswith("."):
                whole = path.read_bytes()
                assert whole == b"old" or len(laspy.read(path)) > 0
    time.sleep(1.0)
    assert killed
    assert _run(*_words(name, inputs, out)).returncode == 0
    assert {path: Path(path).read_bytes() for path in old} == expected
    assert not _hidden(out)
