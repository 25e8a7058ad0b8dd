import os
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path

import pytest
from runs import classify_tiles
from surveys import bytes_of, cut, strip

from bare_earth.algorithms.cli import main
from bare_earth.algorithms.core import version
from bare_earth.algorithms.core.errors import BareEarthError, Cancelled
from bare_earth.algorithms.core.progress import Progress
from bare_earth.algorithms.engine import cluster as cluster_module
from bare_earth.algorithms.engine import many_files as many_files_module
from bare_earth.algorithms.engine.cluster import Cluster
from bare_earth.algorithms.engine.options import TileOutput
from bare_earth.algorithms.filters.slope.filter import SlopeFilter

pytest.importorskip("distributed")
FAST = SlopeFilter(preset="whitebox")


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


@pytest.fixture(scope="module")
def dask(tmp_path_factory):
    """A scheduler and two workers, each a process: the address, the workers, the scheduler."""
    folder = tmp_path_factory.mktemp("dask")
    parent = str(Path(many_files_module.__file__).parents[2])
    path = os.pathsep.join([parent, os.environ.get("PYTHONPATH", "")])
    address = f"tcp://127.0.0.1:{free_port()}"
    started = []

    def start(*words):
        with open(folder / f"{len(started)}.log", "wb") as log:
            process = subprocess.Popen(
                [sys.executable, "-m", *words],
                env={**os.environ, "PYTHONPATH": path},
                cwd=folder,
                stdout=log,
                stderr=log,
            )
        started.append(process)
        return process

    where = ["--host", "127.0.0.1", "--port", address.rpartition(":")[2]]
    start("distributed.cli.dask_scheduler", *where, "--no-dashboard")
    own = ["--no-dashboard", "--no-nanny", "--nthreads", "1", "--host", "127.0.0.1"]
    workers = [start("distributed.cli.dask_worker", address, *own) for _ in range(2)]
    try:
        wait_for_workers(address, 2)
        yield address, workers, started[0]
    finally:
        for process in started:
            process.kill()
        for process in started:
            process.wait()


def wait_for_workers(address, count):
    from distributed import Client

    end = time.monotonic() + 30
    while True:
        try:
            with Client(address, timeout="2s", set_as_default=False) as client:
                client.wait_for_workers(count, timeout=20)
            return
        except OSError:
            if time.monotonic() > end:
                raise


@pytest.fixture(scope="module")
def survey(tmp_path_factory):
    """Files, and the bytes that they become in threads of this process."""
    folder = tmp_path_factory.mktemp("survey")
    cut(folder / "in", strip(40_000, 900.0, 300.0), 16)
    classify_tiles([folder / "in"], folder / "threads", FAST)
    return folder / "in", bytes_of(folder / "threads")


def test_a_cluster_gives_the_same_bytes(dask, survey, tmp_path):
    folder, expected = survey
    words = ["classify-tiles", folder, tmp_path / "out", "--scheduler", dask[0]]
    assert main([*map(str, words), "--method", "slope", "--preset", "whitebox"]) == 0
    assert bytes_of(tmp_path / "out") == expected


def test_a_scheduler_that_is_not_there_is_told(survey, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(cluster_module, "_CONNECTING", "1s")
    words = ["classify-tiles", survey[0], tmp_path / "out"]
    address = f"tcp://127.0.0.1:{free_port()}"
    assert main([*map(str, words), "--scheduler", address]) == 1
    assert f"There is no Dask scheduler at {address}" in capsys.readouterr().err


def test_workers_of_another_version_are_refused(dask, survey, tmp_path, monkeypatch):
    monkeypatch.setattr(version, "__version__", "99.9")
    with pytest.raises(BareEarthError, match=r"has version .* and this computer 99\.9"):
        classify_tiles([survey[0]], tmp_path / "out", FAST, workers=Cluster(dask[0]))


def test_a_cancel_leaves_the_finished_tiles(dask, survey, tmp_path):
    class Impatient(Progress):
        asked = None

        def info(self, text):
            if ".laz:" in text:
                self.asked = time.monotonic()

        def report(self, fraction):
            if self.asked is not None:
                raise Cancelled

    folder, expected = survey
    progress, out = Impatient(), tmp_path / "out"
    with pytest.raises(Cancelled):
        classify_tiles([folder], out, FAST, progress=progress, workers=Cluster(dask[0]))
    assert time.monotonic() - progress.asked < 2.0
    time.sleep(0.5)  # jobs that have begun run to their end
    assert 1 <= len(bytes_of(out)) < 16
    resume = TileOutput(resume=True)
    summary = classify_tiles([folder], out, FAST, output=resume, workers=Cluster(dask[0]))
    assert summary.kept_count >= 1 and bytes_of(out) == expected


@pytest.mark.skipif(os.name == "nt", reason="it kills by signals")
def test_a_worker_that_is_killed_loses_nothing(dask, survey, tmp_path):
    # From here on the cluster has one worker.
    address, workers, _ = dask
    folder, expected = survey

    class Killer(Progress):
        done = None

        def info(self, text):
            if ".laz:" in text and self.done is None:
                workers[0].send_signal(signal.SIGKILL)
                self.done = 0
            elif self.done is not None:
                self.done += 1

    killer = Killer()
    out = tmp_path / "out"
    summary = classify_tiles([folder], out, FAST, progress=killer, workers=Cluster(address))
    assert workers[0].wait() == -signal.SIGKILL and killer.done >= 14
    assert not summary.failures and summary.done_count == 16
    assert bytes_of(out) == expected
    assert not [path for path in out.rglob("*") if ".part" in path.name]


def test_a_scheduler_that_ends_is_told_and_the_run_goes_on_without_it(dask, survey, tmp_path):
    # The last test: it leaves no cluster.
    address, _, scheduler = dask
    folder, expected = survey

    class Killer(Progress):
        def info(self, text):
            scheduler.kill()

    out = tmp_path / "out"
    with pytest.raises(BareEarthError, match="The scheduler is gone"):
        classify_tiles([folder], out, FAST, progress=Killer(), workers=Cluster(address))
    summary = classify_tiles([folder], out, FAST, output=TileOutput(resume=True))
    assert summary.done_count == 16 and bytes_of(out) == expected
