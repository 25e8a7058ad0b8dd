import contextlib
import os
import random
import shutil
import signal
import socket
import subprocess
import sys
import threading
import time
from functools import partial
from pathlib import Path

import pytest
from runs import FAST, CancelAtFirstFile, temporary_in
from surveys import bytes_of, cut, finished, strip

import bare_earth
from bare_earth import BareEarthError, Cancelled, Progress, classify
from bare_earth.algorithms.cli import main
from bare_earth.algorithms.core import version
from bare_earth.algorithms.engine import cluster as cluster_module

pytestmark = pytest.mark.processes

KILLS = int(os.environ.get("BARE_EARTH_KILLS", "10"))


@pytest.fixture(scope="module", autouse=True)
def _dask():
    """Import Dask before any test: not with all files, as it takes a second.

    Where it is imported while its configuration is another, its own is gone afterwards.
    """
    pytest.importorskip("distributed")


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


@contextlib.contextmanager
def running_cluster(folder, secret=None, count=2):
    """Start a scheduler and workers, each a process: the address, the workers, the scheduler."""
    parent = str(Path(bare_earth.__file__).parents[1])
    path = os.pathsep.join([parent, os.environ.get("PYTHONPATH", "")])
    address = f"{'tls' if secret else 'tcp'}://127.0.0.1:{free_port()}"
    # As Dask reads its configuration from the environment.
    variables = {
        "DASK_" + name.upper().replace(".", "__").replace("-", "_"): value
        for name, value in (secret or {}).items()
    }
    started = []

    def start(*words):
        with open(folder / f"{len(started)}.log", "wb") as log:
            process = subprocess.Popen(
                [sys.executable, "-m", *words],
                env={**os.environ, "PYTHONPATH": path, **variables},
                cwd=folder,
                stdout=log,
                stderr=log,
            )
        started.append(process)
        return process

    start("distributed.cli.dask_scheduler", "--host", address, "--no-dashboard")
    own = ["--no-dashboard", "--no-nanny", "--nthreads", "1", "--host", "127.0.0.1"]
    workers = [start("distributed.cli.dask_worker", address, *own) for _ in range(count)]
    try:
        yield address, workers, started[0]
    finally:
        for process in started:
            process.kill()
        for process in started:
            process.wait()


@pytest.fixture(scope="module")
def clusters(tmp_path_factory):
    """Return a function that gives the running cluster, or a new one where it was harmed."""
    with contextlib.ExitStack() as stack:
        running = []

        def running_one(least=2):
            """Return one of which so many workers are left."""
            left = [process.poll() is None for process in running[0][1:]] if running else [False]
            if not left[-1] or sum(left[:-1]) < least:
                stack.close()
                folder = tmp_path_factory.mktemp("dask")
                address, workers, scheduler = stack.enter_context(running_cluster(folder))
                wait_for_workers(address, 2)
                running[:] = [(address, *workers, scheduler)]
            return running[0]

        yield running_one


@pytest.fixture
def dask(clusters):
    """Yield the address of a cluster, two workers, and the scheduler."""
    return clusters()


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
    classify([folder / "in"], folder / "threads", **FAST)
    return folder / "in", bytes_of(folder / "threads")


@pytest.mark.rest
def test_a_cluster_gives_the_same_bytes(dask, survey, tmp_path):
    folder, expected = survey
    words = ["classify", folder, tmp_path / "out", "--scheduler", dask[0]]
    assert main([*map(str, words), "--method", "slope", "--preset", "whitebox"]) == 0
    assert bytes_of(tmp_path / "out") == expected


@pytest.mark.rest
def test_a_scheduler_that_is_not_there_is_told(survey, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(cluster_module, "_CONNECTING", "1s")
    words = ["classify", survey[0], tmp_path / "out"]
    address = f"tcp://127.0.0.1:{free_port()}"
    assert main([*map(str, words), "--scheduler", address]) == 1
    assert f"scheduler answers at {address}" in capsys.readouterr().err


KEYS = ("tls.ca-file", "tls.client.cert", "tls.client.key")


@pytest.mark.rest
@pytest.mark.parametrize(
    ("scheme", "settings", "told"),
    [
        ("tls", {}, "TLS needs a certificate"),
        ("tcp", {"require-encryption": True}, "encryption is required"),
        ("tls", dict.fromkeys(KEYS, "none"), "or the key cannot be used"),
    ],
)
def test_an_address_that_the_keys_do_not_fit_is_refused(scheme, settings, told, survey, tmp_path):
    from dask import config

    address = f"{scheme}://127.0.0.1:{free_port()}"
    settings = {f"distributed.comm.{name}": value for name, value in settings.items()}
    with config.set(settings), pytest.raises(BareEarthError, match=told):
        classify([survey[0]], tmp_path / "out", scheduler=address, **FAST)


@pytest.mark.rest
def test_workers_of_another_version_are_refused(dask, survey, tmp_path, monkeypatch):
    monkeypatch.setattr(version, "__version__", "99.9")
    with pytest.raises(BareEarthError, match=r"version .* this computer 99\.9"):
        classify([survey[0]], tmp_path / "out", scheduler=dask[0], **FAST)


@pytest.mark.rest
def test_a_cancel_leaves_the_finished_tiles(dask, survey, tmp_path):
    folder, expected = survey
    progress, out = CancelAtFirstFile(), tmp_path / "out"
    with pytest.raises(Cancelled):
        classify([folder], out, progress=progress, scheduler=dask[0], **FAST)
    assert 1 <= len(bytes_of(out)) < 16
    summary = classify([folder], out, resume=True, scheduler=dask[0], **FAST)
    assert summary.kept_count >= 1 and bytes_of(out) == expected


@pytest.mark.rest
@pytest.mark.skipif(os.name == "nt", reason="it kills by signals")
def test_a_worker_that_is_killed_loses_nothing(dask, survey, tmp_path):
    address, worker, *_ = dask
    folder, expected = survey

    class Killer(Progress):
        done = None

        def info(self, text):
            if ".laz:" in text and self.done is None:
                worker.send_signal(signal.SIGKILL)
                self.done = 0
            elif self.done is not None:
                self.done += 1

    killer = Killer()
    out = tmp_path / "out"
    summary = classify([folder], out, progress=killer, scheduler=address, **FAST)
    assert worker.wait() == -signal.SIGKILL and killer.done >= 14
    assert not summary.failures and summary.done_count == 16
    assert bytes_of(out) == expected
    assert not temporary_in(out)


@pytest.mark.rest
def test_a_scheduler_that_ends_is_told_and_the_run_goes_on_without_it(clusters, survey, tmp_path):
    address, *_, scheduler = clusters(1)
    folder, expected = survey

    class Killer(Progress):
        def info(self, text):
            scheduler.kill()

    out = tmp_path / "out"
    with pytest.raises(BareEarthError, match="scheduler is gone"):
        classify([folder], out, progress=Killer(), scheduler=address, **FAST)
    summary = classify([folder], out, resume=True, **FAST)
    assert summary.done_count == 16 and bytes_of(out) == expected


@pytest.mark.long
def test_jobs_of_a_run_that_was_cancelled_write_nothing_more(tmp_path):
    # Else they would write over what the next run makes, with other parameters maybe.
    cut(tmp_path / "in", strip(800_000, 400.0, 200.0), 2)
    labels = tmp_path / "out" / ".bare-earth" / "work"

    class Impatient(Progress):
        def report(self, fraction):
            # Both workers are at a block then, or at the next one.
            if any(labels.glob("*.npz")):
                raise Cancelled

    with running_cluster(tmp_path) as (address, _, _):
        wait_for_workers(address, 2)
        out = tmp_path / "out"
        with pytest.raises(Cancelled):
            classify([tmp_path / "in"], out, progress=Impatient(), scheduler=address)
        written = set(labels.iterdir())
        time.sleep(10.0)
        assert set(labels.iterdir()) == written and not finished(tmp_path / "out")


@pytest.mark.long
@pytest.mark.skipif(os.name == "nt", reason="it kills by signals")
def test_a_cluster_whose_workers_are_all_gone_is_told(survey, tmp_path, monkeypatch):
    folder, expected = survey
    monkeypatch.setattr(cluster_module, "Cluster", partial(cluster_module.Cluster, patience=3.0))
    with running_cluster(tmp_path) as (address, workers, _):
        wait_for_workers(address, 2)

        class Killer(Progress):
            def info(self, text):
                for worker in workers:
                    worker.kill()

        out = tmp_path / "out"
        begun = time.monotonic()
        with pytest.raises(BareEarthError, match=r"workers of .* gone"):
            classify([folder], out, progress=Killer(), scheduler=address, **FAST)
        assert time.monotonic() - begun < 30.0
    summary = classify([folder], out, resume=True, **FAST)
    assert not summary.failures, "\n".join(summary.failures.values())
    assert summary.done_count == 16 and bytes_of(out) == expected
    assert not temporary_in(out)


@pytest.fixture(scope="module")
def secret(tmp_path_factory):
    """Return what makes Dask use TLS, with a certificate of our own, as its variables."""
    program = shutil.which("openssl")
    if program is None:
        pytest.skip("there is no openssl to make a certificate with")
    folder = tmp_path_factory.mktemp("tls")
    words = "req -x509 -newkey rsa:2048 -nodes -keyout key.pem -out cert.pem -days 2 -subj /CN=test"
    subprocess.run([program, *words.split()], cwd=folder, check=True, capture_output=True)
    cert, key = str(folder / "cert.pem"), str(folder / "key.pem")
    files = {"comm.tls.ca-file": cert, "comm.require-encryption": "True"}
    for who in ("scheduler", "worker", "client"):
        files |= {f"comm.tls.{who}.cert": cert, f"comm.tls.{who}.key": key}
    return {f"distributed.{name}": value for name, value in files.items()}


@pytest.mark.long
def test_over_tls_the_bytes_are_the_same_and_without_keys_nobody_gets_in(
    survey, secret, tmp_path, capsys
):
    from dask import config

    def run(settings, address, out):
        words = ["classify", survey[0], out, "--scheduler", address, "--method", "slope"]
        with config.set(settings):
            code = main([*map(str, words), "--preset", "whitebox"])
        return code, capsys.readouterr().err

    with running_cluster(tmp_path, secret) as (address, _, _):
        with config.set(secret):
            wait_for_workers(address, 2)
        code, said = run(secret, address, tmp_path / "out")
        assert code == 0, said
        assert bytes_of(tmp_path / "out") == survey[1]
        plain, key = address.replace("tls", "tcp"), "distributed.comm.tls.client.key"
        for settings, at, told in (
            ({}, address, "TLS needs a certificate"),
            (secret, plain, "encryption is required"),
            (
                {**secret, key: str(tmp_path / "none")},
                address,
                "or the key cannot be used",
            ),
            ({**secret, key: None}, address, "or the key cannot be used"),
        ):
            code, said = run(settings, at, tmp_path / "none")
            assert code == 1 and said.count("bare-earth: ") == 1 and told in said
        assert not finished(tmp_path / "none")


@pytest.mark.long
@pytest.mark.skipif(os.name == "nt", reason="it kills by signals")
@pytest.mark.parametrize("victim", ["worker", "scheduler", "frozen scheduler"])
def test_kills_at_moments_by_chance_lose_nothing(victim, survey, tmp_path, monkeypatch):
    folder, expected = survey
    monkeypatch.setattr(cluster_module, "Cluster", partial(cluster_module.Cluster, patience=5.0))
    ends, chance = [], random.Random(victim)
    for number in range(max(KILLS // 3, 1)):
        place = tmp_path / str(number)
        place.mkdir()
        with running_cluster(place, count=3) as (address, workers, scheduler):
            wait_for_workers(address, 3)
            who = workers[0] if victim == "worker" else scheduler
            how = signal.SIGSTOP if victim.startswith("frozen") else signal.SIGKILL
            killer = threading.Timer(chance.uniform(0.0, 2.5), who.send_signal, [how])
            killer.start()
            out = place / "out"
            begun = time.monotonic()
            try:
                summary = classify([folder], out, scheduler=address, **FAST)
                assert summary.done_count == 16
                ends.append("done")
            except BareEarthError as error:
                ends.append(str(error).replace(address, "ADDRESS"))
                words = "does not answer" if victim == "worker" else "The scheduler is gone"
                assert words in str(error)
            assert time.monotonic() - begun < 90.0
            killer.join()
        names = bytes_of(out)
        assert all(expected[name] == content for name, content in names.items())
        summary = classify([folder], out, resume=True, **FAST)
        assert summary.done_count == 16 and bytes_of(out) == expected
        assert not temporary_in(out)
    print(victim, {end: ends.count(end) for end in ends})
