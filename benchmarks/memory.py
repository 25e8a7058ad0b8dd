"""Measures whether runs keep to the memory that they were given: `python -m benchmarks.memory`.

A survey of generated tiles is classified as many files and as one file, with and without products,
with all the memory and with --memory; then a large file, if wanted. What counts is the sum over all
processes of a run of their proportional set sizes (`/proc/*/smaps_rollup`, Linux): memory that
processes share counts once.

Tiles are kept in ~/.cache/bare-earth/benchmarks (or $BARE_EARTH_CACHE). For 200 million points,
this needs about 1.5 GB there, and 12 GB for the files of a run.
"""

from __future__ import annotations

import argparse
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

PAGE = ROOT / "benchmarks" / "results" / "memory.md"
# Seconds between two looks at the processes.
_LOOKING = 0.1
_GIGABYTE = 1e9
_COMMAND = (sys.executable, "-m", "bare_earth.algorithms")
# What the libraries of a process take, in GB; this is not part of --memory.
LIBRARIES = 0.25
RASTERS = "dtm", "dsm", "chm", "hillshade"


class Use(NamedTuple):
    """What a run used; processor time, memory and disk are those of all its processes together."""

    wall: float  # seconds
    cpu: float  # seconds
    memory: float  # largest sum of the proportional set sizes, in GB
    largest: float  # the same of a single process, in GB
    disk: float  # most that its files took at a time, outputs included, in GB
    processes: int  # most at a time
    problem: str = ""  # the end of what a run said that failed


class Scenario(NamedTuple):
    """A run that is measured; without arguments, reading and writing."""

    title: str
    arguments: tuple[str, ...]
    points: float  # in millions
    most: float | None = None  # GB of memory that it may use; None for what there is


def measure(command: Sequence[str], folder: Path) -> Use:
    """Run a command that writes to a folder as a process group, and return what it used."""
    with tempfile.TemporaryFile() as said:
        begun = time.perf_counter()
        process = subprocess.Popen(
            command, stdout=said, stderr=said, cwd=ROOT, env=environment(), start_new_session=True
        )
        looking = _Looking(process.pid, folder)
        _, status, usage = os.wait4(process.pid, 0)
        wall = time.perf_counter() - begun
        looking.end()
        process.returncode = os.waitstatus_to_exitcode(status)
        said.seek(max(said.seek(0, os.SEEK_END) - 500, 0))
        text = said.read().decode(errors="replace").strip()
    return Use(
        wall,
        usage.ru_utime + usage.ru_stime,
        looking.memory / _GIGABYTE,
        looking.largest / _GIGABYTE,
        looking.disk / _GIGABYTE,
        looking.processes,
        text.splitlines()[-1] if process.returncode else "",
    )


class _Looking:
    """Looks at the memory and the files of a process group until it ends."""

    def __init__(self, group: int, folder: Path) -> None:
        self._group, self._folder = group, folder
        self.memory = self.largest = self.disk = self.processes = 0  # at most, in bytes
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._look, daemon=True)
        self._thread.start()

    def end(self) -> None:
        """End looking."""
        self._stop.set()
        self._thread.join()

    def _look(self) -> None:
        for number in itertools.count():
            if self._stop.wait(_LOOKING):
                return
            members = list(_members(self._group))
            sizes = [size for size in map(_shared_size, members) if size]
            self.memory = max(self.memory, sum(sizes))
            self.largest = max(self.largest, *sizes, 0)
            self.processes = max(self.processes, len(sizes))
            if number % 10 == 0:
                self.disk = max(self.disk, _on_disk(members, self._folder))


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


def _on_disk(processes: Sequence[int], folder: Path) -> int:
    """Return the bytes of the files in a folder, and of open ones without a name."""
    paths = [*folder.rglob("*")]
    paths += [path for number in processes for path in Path(f"/proc/{number}/fd").glob("*")]
    sizes = {}
    for path in paths:
        try:
            status = path.stat()
            if path.parent.name != "fd" or not status.st_nlink:
                sizes[status.st_dev, status.st_ino] = 512 * status.st_blocks
        except OSError:  # it is gone
            continue
    return sum(sizes.values())


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


def scenarios(
    many: Sequence[Path], one: Path, large: Path | None, points: Sequence[float], memory: float
) -> list[Scenario]:
    """Return the runs on many files, on one and on a large one, with their million points; outputs
    are relative to the folder of the run.
    """
    everything = [text for name in RASTERS for text in (f"--{name}", f"{{}}/{name}.tif")]
    everything.append("--height-above-ground")
    given, limit = ("--memory", f"{memory:g}"), f", {memory:g} GB"
    found = [Scenario("reading and writing", (), points[0])]
    for title, inputs, output, count in (
        (f"{len(many)} files", many, "{}/out", points[0]),
        ("one file", [one], "{}/one.laz", points[0]),
        (f"{points[1]:g} million points", [large], "{}/large.laz", points[1]),
    ):
        if inputs == [None]:
            continue
        classify = ("classify", *map(str, inputs), output)
        if inputs != [large]:
            found += [
                Scenario(f"{title}: classes", classify, count),
                Scenario(f"{title}: all products", (*classify, *everything), count),
            ]
        found += [
            Scenario(f"{title}: classes{limit}", (*classify, *given), count, memory),
            Scenario(
                f"{title}: all products{limit}", (*classify, *everything, *given), count, memory
            ),
        ]
    return found


def _command(scenario: Scenario, paths: Sequence[Path], folder: Path) -> list[str]:
    if scenario.arguments:
        return [*_COMMAND, *(text.replace("{}", str(folder)) for text in scenario.arguments)]
    copies = (
        "import sys, laspy\n"
        "for number, path in enumerate(sys.argv[2:]):\n"
        "    laspy.read(path).write(f'{sys.argv[1]}/copy-{number}.laz')\n"
    )
    return [sys.executable, "-c", copies, str(folder), *map(str, paths)]


def rows(found: Sequence[tuple[Scenario, Use]]) -> list[list[str]]:
    """Return the lines of the table; the first is reading and writing."""
    first, floor = found[0]
    lines = []
    for scenario, use in found:
        allowed = "-"
        if scenario.most is not None:
            allowed = f"{scenario.most + LIBRARIES * use.processes:.2f}"
        size = scenario.points / first.points
        times = [f"{use.wall / floor.wall / size:.2f}", f"{use.cpu / floor.cpu / size:.2f}"]
        memory = [f"{use.memory:.2f}", allowed, f"{use.largest:.2f}"]
        figures = [*times, *memory, f"{use.disk:.1f}", str(use.processes)]
        lines.append([scenario.title, *(figures if not use.problem else [use.problem] * 7)])
    return lines


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure, print the table, and write the page if it is wanted."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.memory", description=__doc__)
    parser.add_argument("--tiles", type=int, default=25, help="number of tiles (default: 25)")
    parser.add_argument(
        "--points", type=float, default=2.0, help="million points of a tile (default: 2)"
    )
    parser.add_argument(
        "--large", type=int, default=0,
        help="also one file of so many times the points of all tiles: 4 gives 200 million",
    )  # fmt: skip
    parser.add_argument("--memory", type=float, default=1.0, help="GB that runs get (default: 1)")
    parser.add_argument("--only", help="only runs whose name contains this, and the floor")
    parser.add_argument("--write", action="store_true", help="write results/memory.md")
    options = parser.parse_args(arguments)
    paths = survey(options.tiles, int(options.points * 1e6))
    count = options.tiles * options.points
    one, large = joined(paths, 1), joined(paths, options.large) if options.large else None
    every = scenarios(paths, one, large, (count, count * options.large), options.memory)
    load, found = os.getloadavg()[0], []
    for scenario in every:
        if scenario.arguments and (options.only or "") not in scenario.title:
            continue
        with tempfile.TemporaryDirectory(prefix="memory-", dir=cache.FOLDER) as folder:
            command = _command(scenario, paths, Path(folder))
            found.append((scenario, measure(command, Path(folder))))
        print(" | ".join(rows([found[0], found[-1]])[-1]), flush=True)
    head = ["", "wall clock", "processor time", "memory, GB", "allowed, GB"]
    lines = tables.table([*head, "largest process, GB", "disk, GB", "processes"], rows(found))
    print("\n".join(lines))
    if options.write:
        commit = subprocess.run(
            ["git", "rev-parse", "--short", "HEAD"], cwd=ROOT, capture_output=True, text=True
        )
        words = {
            "libraries": LIBRARIES, "commit": commit.stdout.strip(),
            "processors": os.cpu_count(), "load": f"{load:.1f}", "count": options.tiles,
            "points": f"{options.points:g}", "table": "\n".join(lines),
        }  # fmt: skip
        template = Template(Path(__file__).with_suffix(".md").read_text(encoding="utf-8"))
        PAGE.write_text(template.substitute(words), encoding="utf-8")
    return 0


def joined(paths: Sequence[Path], times: int) -> Path:
    """Return one file of the points of several, so many times side by side, made if missing."""
    import laspy

    target = paths[0].parent / f"joined-{times}.laz"
    if target.exists():
        return target
    unfinished = target.with_name(f"unfinished-{target.name}")
    with laspy.open(paths[0]) as first, laspy.open(paths[-1]) as last:
        header, width = first.header, np.ceil(last.header.maxs[0] - first.header.mins[0])
    backend = laspy.LazBackend.LazrsParallel
    with laspy.open(unfinished, "w", header=header, laz_backend=backend) as file:
        for copy, path in itertools.product(range(times), paths):
            with laspy.open(path) as source:
                for points in source.chunk_iterator(1_000_000):
                    points["X"] += int(copy * width / header.scales[0])
                    file.write_points(points)
    unfinished.replace(target)
    return target


if __name__ == "__main__":
    sys.exit(main())
