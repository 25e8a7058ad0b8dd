"""Tells where the time of a filter goes, by py-spy: it samples a process from outside."""

from __future__ import annotations

import re
import shutil
import sys
import tempfile
from collections import Counter
from pathlib import Path
from typing import Iterable, Sequence

from .process import measure
from .results import Profile
from .tiles import Tile

HEAVIEST = 5
# A profile of a larger tile says nothing new.
MOST_POINTS = 10_000_000
_RATE = 50
# The outermost of these files on the stack tells which part of the work it is.
_PARTS = {
    "algorithms/las/reading.py": "reading",
    "algorithms/las/writing.py": "writing",
    # Where the main thread waits for the threads of the blocks.
    "algorithms/engine/": "filtering",
    "algorithms/tools/ground/": "filtering",
    "algorithms/filters/": "filtering",
    "algorithms/grids/": "filtering",
}
_STARTING, _REST = "starting Python", "the rest"
SHARES = ("reading", "filtering", "writing", _STARTING, _REST)
_NUMBER = re.compile(r"thread \((\d+)\)")
# A thread in one of these waits for others.
_WAITING = re.compile(r"\((threading|queue|selectors)\.py|concurrent/futures/")


def program() -> str | None:
    """Return the path of py-spy, or None."""
    beside = Path(sys.executable).with_name("py-spy")
    return str(beside) if beside.exists() else shutil.which("py-spy")


def profile(command: Sequence[str], tile: Tile) -> Profile:
    """Run a command under py-spy.

    Raises
    ------
    RuntimeError
        If it fails.
    """
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder) / "stacks.txt"
        spy = [program() or "py-spy", "record", "--format", "raw", "--output", str(target)]
        spy += ["--rate", str(_RATE), "--function", "--idle", "--threads", "--"]
        cost = measure([*spy, *command])
        if cost.problem or not target.exists():
            raise RuntimeError(f"py-spy: {cost.problem or 'no stacks'}")
        return summed(target.read_text(encoding="utf-8").splitlines(), tile.name)


def summed(stacks: Iterable[str], tile: str) -> Profile:
    """Sum up folded stacks: `thread; outermost; ...; innermost count` on each line.

    The parts are shares of the main thread's time. The functions are the innermost ones of our
    package and its libraries, of all threads that do not wait.
    """
    parts: Counter[str] = Counter()
    functions: Counter[str] = Counter()
    stacks = list(stacks)
    main = _main_thread(stacks)
    for line in stacks:
        stack, _, count = line.rpartition(" ")
        thread, *frames = stack.split(";")
        if not frames:
            continue
        if _number(thread) == main:
            parts[_part(frames)] += int(count)
        if not _WAITING.search(frames[-1]) and "importlib" not in frames[-1]:
            functions[_name(frames[-1])] += int(count)
    whole, work = max(sum(parts.values()), 1), max(sum(functions.values()), 1)
    return Profile(
        tile,
        whole / _RATE,
        {part: 100.0 * parts[part] / whole for part in SHARES},
        [(name, 100.0 * count / work) for name, count in functions.most_common(HEAVIEST)],
    )


def _main_thread(stacks: Sequence[str]) -> str:
    """Return the number of the main thread: py-spy does not always read its name."""
    threads = [stack.split(";")[0] for stack in stacks]
    named = [_number(thread) for thread in threads if thread.endswith("MainThread")]
    return named[0] if named else min(map(_number, threads), key=int, default="")


def _number(thread: str) -> str:
    """Return the number in `thread (8): name`."""
    return _NUMBER.search(thread)[1]


def _part(frames: Sequence[str]) -> str:
    if any("importlib" in frame for frame in frames):
        return _STARTING
    for frame in frames:
        for file, part in _PARTS.items():
            if file in frame:
                return part
    return _REST


def _name(frame: str) -> str:
    """Return `function (file)` without the line and without folders that say nothing."""
    return re.sub(r"\((?:bare_earth/)?(.*?)(?::\d+)?\)$", r"(\1)", frame)
