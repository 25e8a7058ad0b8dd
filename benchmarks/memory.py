"""Measures whether runs keep to the memory that they were given: `python -m benchmarks.memory`.

A survey of generated tiles is classified as many files and as one file, with and without products,
with all the memory and with --memory. What counts is the sum over all processes of a run of their
proportional set sizes (`/proc/*/smaps_rollup`, Linux): memory that processes share counts once.

Tiles are kept in ~/.cache/bare-earth/benchmarks (or $BARE_EARTH_CACHE).
"""

from __future__ import annotations

import argparse
import datetime
import itertools
import os
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path
from string import Template
from typing import Iterator, NamedTuple, Sequence

import numpy as np

from . import cache, tables
from .speed import tiles
from .speed.process import ROOT, environment

PAGE = ROOT / "docs" / "memory.md"
# Seconds between two looks at the processes.
_LOOKING = 0.1
_GIGABYTE = 1e9
_COMMAND = (sys.executable, "-m", "bare_earth.algorithms")
# What the libraries of a process take, in GB; this is not part of --memory.
LIBRARIES = 0.25


class Use(NamedTuple):
    """What a run used.

    Attributes
    ----------
    wall, cpu : float
        Seconds; the processor time includes all processes.
    memory : float
        Largest sum of the proportional set sizes, in GB.
    processes : int
        Largest number of processes at a time.
    problem : str
        The end of what a run said that failed.
    """

    wall: float
    cpu: float
    memory: float
    processes: int
    problem: str = ""


class Scenario(NamedTuple):
    """A run that is measured.

    Attributes
    ----------
    title : str
        Its name in the table.
    arguments : tuple of str
        Those of the command.
    most : float or None
        Memory that it may use, in GB; None if it may use what there is.
    """

    title: str
    arguments: tuple[str, ...]
    most: float | None = None


def measure(command: Sequence[str]) -> Use:
    """Run a command as a process group, and return what it used."""
    with tempfile.TemporaryFile() as said:
        begun, before = time.perf_counter(), os.times()
        process = subprocess.Popen(
            command, stdout=said, stderr=said, cwd=ROOT, env=environment(), start_new_session=True
        )
        looking = _Looking(process.pid)
        code = process.wait()
        wall, after = time.perf_counter() - begun, os.times()
        most, count = looking.end()
        cpu = after.children_user + after.children_system
        cpu -= before.children_user + before.children_system
        said.seek(max(said.seek(0, os.SEEK_END) - 500, 0))
        text = said.read().decode(errors="replace").strip()
    return Use(wall, cpu, most / _GIGABYTE, count, text.splitlines()[-1] if code else "")


class _Looking:
    """Looks at the memory of a process group until it ends."""

    def __init__(self, group: int) -> None:
        self._group, self._most, self._count = group, 0, 0
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._look, daemon=True)
        self._thread.start()

    def end(self) -> tuple[int, int]:
        """Return the largest sum in bytes, and the largest number of processes."""
        self._stop.set()
        self._thread.join()
        return self._most, self._count

    def _look(self) -> None:
        while not self._stop.wait(_LOOKING):
            sizes = [size for size in map(_shared_size, _members(self._group)) if size]
            self._most = max(self._most, sum(sizes))
            self._count = max(self._count, len(sizes))


def _members(group: int) -> Iterator[int]:
    """Yield the processes of a group."""
    for path in Path("/proc").glob("[0-9]*"):
        try:
            if os.getpgid(int(path.name)) == group:
                yield int(path.name)
        except ProcessLookupError:
            continue


def _shared_size(process: int) -> int:
    """Return the proportional set size of a process in bytes; 0 if it has ended."""
    try:
        lines = Path(f"/proc/{process}/smaps_rollup").read_text().splitlines()
    except OSError:
        return 0
    return 1024 * sum(int(line.split()[1]) for line in lines if line.startswith("Pss:"))


def survey(count: int, points: int) -> list[Path]:
    """Return the generated tiles of a survey, which are made if they are missing."""
    folder = cache.FOLDER / f"survey-{count}-{points}-{tiles.SEED}"
    side = np.sqrt(points / tiles.DENSITY)
    width = int(np.ceil(np.sqrt(count)))
    paths = []
    for row, column in itertools.islice(itertools.product(range(width), repeat=2), count):
        paths.append(folder / f"tile_{column}_{row}.laz")
        if not paths[-1].exists():
            tiles.write(points, paths[-1], (column * side, row * side))
    return paths


def scenarios(paths: Sequence[Path], one: Path, folder: Path, memory: float) -> list[Scenario]:
    """Return the runs on many files and on one file."""
    many, given = tuple(map(str, paths)), ("--memory", f"{memory:g}")
    products = "--dtm", str(folder / "dtm.tif"), "--hillshade", str(folder / "hillshade.tif")
    everything = *products, "--height-above-ground"
    found = [Scenario("reading and writing", ())]
    for title, inputs, output in (
        (f"{len(paths)} files", many, str(folder / "out")),
        ("one file", (str(one),), str(folder / "one.laz")),
    ):
        classify = ("classify", *inputs, output)
        found += [
            Scenario(f"{title}: classes", classify),
            Scenario(f"{title}: and DTM, hillshade", (*classify, *products)),
            Scenario(f"{title}: classes, {memory:g} GB", (*classify, *given), memory),
            Scenario(
                f"{title}: and DTM, hillshade, heights, {memory:g} GB",
                (*classify, *everything, *given),
                memory,
            ),
        ]
    return found


def _command(scenario: Scenario, paths: Sequence[Path], folder: Path) -> list[str]:
    if scenario.arguments:
        return [*_COMMAND, *scenario.arguments]
    copies = (
        "import sys, laspy\n"
        "for number, path in enumerate(sys.argv[2:]):\n"
        "    laspy.read(path).write(f'{sys.argv[1]}/copy-{number}.laz')\n"
    )
    return [sys.executable, "-c", copies, str(folder), *map(str, paths)]


def rows(
    found: Sequence[tuple[Scenario, Use]],
) -> list[list[str]]:
    """Return the lines of the table."""
    floor = found[0][1]
    lines = []
    for scenario, use in found:
        allowed = "-"
        if scenario.most is not None:
            allowed = f"{scenario.most + LIBRARIES * use.processes:.2f}"
        times = [f"{use.wall / floor.wall:.2f}", f"{use.cpu / floor.cpu:.2f}"]
        figures = [*times, f"{use.memory:.2f}", allowed, str(use.processes)]
        lines.append([scenario.title, *(figures if not use.problem else [use.problem] * 5)])
    return lines


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure, print the table, and write the page if it is wanted."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.memory", description=__doc__)
    parser.add_argument("--tiles", type=int, default=25, help="number of tiles (default: 25)")
    parser.add_argument(
        "--points", type=float, default=2.0, help="million points of a tile (default: 2)"
    )
    parser.add_argument("--memory", type=float, default=1.0, help="GB that runs get (default: 1)")
    parser.add_argument("--only", help="only runs whose name contains this, and the floor")
    parser.add_argument("--write", action="store_true", help="write docs/memory.md")
    options = parser.parse_args(arguments)
    paths = survey(options.tiles, int(options.points * 1e6))
    one = cache.FOLDER / f"one-{options.tiles}-{options.points:g}.laz"
    if not one.exists():
        joined(paths, one)
    load, found = os.getloadavg()[0], []
    with tempfile.TemporaryDirectory(prefix="bare-earth-memory-", dir=cache.FOLDER) as place:
        every = scenarios(paths, one, Path(place), options.memory)
        chosen = [
            scenario
            for scenario in every
            if not scenario.arguments or (options.only or "") in scenario.title
        ]
        for number, scenario in enumerate(chosen):
            folder = Path(place) / str(number)
            folder.mkdir()
            named = [text.replace(place, str(folder)) for text in scenario.arguments]
            command = _command(scenario._replace(arguments=tuple(named)), paths, folder)
            found.append((scenario, measure(command)))
            print(" | ".join(rows([found[0], found[-1]])[-1]), flush=True)
            subprocess.run(["rm", "-r", str(folder)], check=True)
    head = ["", "wall clock", "processor time", "memory, GB", "allowed, GB", "processes"]
    lines = tables.table(head, rows(found))
    print("\n".join(lines))
    if options.write:
        commit = subprocess.run(
            ["git", "rev-parse", "--short", "HEAD"], cwd=ROOT, capture_output=True, text=True
        )
        words = {
            "libraries": LIBRARIES, "date": datetime.date.today(), "commit": commit.stdout.strip(),
            "processors": os.cpu_count(), "load": f"{load:.1f}", "count": options.tiles,
            "points": f"{options.points:g}", "table": "\n".join(lines),
        }  # fmt: skip
        template = Template(Path(__file__).with_suffix(".md").read_text(encoding="utf-8"))
        PAGE.write_text(template.substitute(words), encoding="utf-8")
    return 0


def joined(paths: Sequence[Path], target: Path) -> None:
    """Write one file of the points of several, part by part."""
    import laspy

    unfinished = target.with_name(f"unfinished-{target.name}")
    with laspy.open(paths[0]) as first:
        header = first.header
    backend = laspy.LazBackend.LazrsParallel
    with laspy.open(unfinished, "w", header=header, laz_backend=backend) as file:
        for path in paths:
            with laspy.open(path) as source:
                for points in source.chunk_iterator(1_000_000):
                    file.write_points(points)
    unfinished.replace(target)


if __name__ == "__main__":
    sys.exit(main())
