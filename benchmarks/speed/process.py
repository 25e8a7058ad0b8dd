"""Runs a command as a process of its own and tells what it cost."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path
from typing import NamedTuple, Sequence

# The repository: a command finds `benchmarks` there.
ROOT = Path(__file__).parents[2]
# Peak memory is told in kilobytes, but on macOS in bytes.
_UNIT = 1 if sys.platform == "darwin" else 1024

# Of what a process says, only the end is looked at: this one must stay small.
_MOST_SAID = 10_000
# How a problem begins that is only a lack of time.
STOPPED = "stopped after"


class Cost(NamedTuple):
    """What one run cost.

    Attributes
    ----------
    wall : float
        Seconds from start to end.
    cpu : float
        Seconds of all its threads, and of the processes that it started and waited for.
    memory : int
        Peak resident memory in bytes: of the largest single process among it and those.
    problem : str
        Why the figures are not those of a whole run.
    """

    wall: float
    cpu: float
    memory: int
    problem: str = ""


def environment() -> dict[str, str]:
    """Return the environment of a process: Python may keep compiled modules, as it does by default.

    Otherwise each process would compile SciPy again, which takes half a second.
    """
    variables = dict(os.environ)
    if variables.pop("PYTHONDONTWRITEBYTECODE", None):
        variables.setdefault("PYTHONPYCACHEPREFIX", str(ROOT / "build" / "bytecode"))
    return variables


def measure(command: Sequence[str], timeout: float | None = None) -> Cost:
    """Run a command and return its cost.

    A process starts as a copy of the one that starts it, and its peak memory is never told lower
    than what that one had: the benchmark itself must stay small while it measures.

    Parameters
    ----------
    command : sequence of str
        The program and its arguments.
    timeout : float, optional
        Seconds after which it is stopped, with all that it started.
    """
    with tempfile.TemporaryFile() as said:
        start = time.perf_counter()
        process = subprocess.Popen(
            command, stdout=said, stderr=said, stdin=subprocess.DEVNULL, cwd=ROOT,
            start_new_session=True, env=environment(),
        )  # fmt: skip
        is_late = threading.Event()
        # Only `wait4` tells the usage of this one child; it has no time limit of its own.
        watch = threading.Timer(timeout or 0.0, _stop, (process.pid, is_late))
        if timeout:
            watch.start()
        try:
            _, status, usage = os.wait4(process.pid, 0)
        except BaseException:
            _stop(process.pid, is_late)
            process.wait()
            raise
        finally:
            watch.cancel()
        wall = time.perf_counter() - start
        process.returncode = os.waitstatus_to_exitcode(status)
        said.seek(max(said.seek(0, os.SEEK_END) - _MOST_SAID, 0))
        text = said.read().decode(errors="replace")
    problem = ""
    if is_late.is_set():
        problem = f"{STOPPED} {timeout:g} s"
    elif process.returncode:
        lines = text.strip().splitlines() or [f"ended with {process.returncode}"]
        problem = lines[-1]
    return Cost(wall, usage.ru_utime + usage.ru_stime, usage.ru_maxrss * _UNIT, problem)


def _stop(leader: int, is_late: threading.Event) -> None:
    """End a process and all that it started, which are a group of their own."""
    is_late.set()
    try:
        os.killpg(leader, signal.SIGKILL)
    except ProcessLookupError:
        is_late.clear()  # it ended at this very moment
