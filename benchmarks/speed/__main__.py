"""Measures what the filters cost, beside reading and writing, and other programs.

Every contestant is a whole process, from file to file. On each tile all take their turn within a
round, and several rounds follow; what counts is the ratio to reading and writing in the same round,
since a machine is rarely quiet. What is not installed is left out and named. Generated tiles are
kept in ~/.cache/bare-earth/benchmarks (or $BARE_EARTH_CACHE); real ones are sought in
$BARE_EARTH_DATA.
"""

from __future__ import annotations

import argparse
import datetime
import importlib.metadata
import os
import platform
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Callable, Sequence

from bare_earth.algorithms.core.threads import available_cpus

from .. import data
from . import profiling, results, tiles
from .contestants import FLOOR, OURS, Contestant, contestants
from .process import ROOT, STOPPED, Cost, measure
from .report import PAGE, Report
from .results import Results, Run
from .tiles import Tile

SIZES = (1.0, 10.0, 50.0)
REAL = ("nrw_rural.laz", "hawaii_forest.laz")
# The tile and the rounds of --quick.
_QUICK = 0.1
_EXAMPLES = """examples:
  python -m benchmarks.speed --quick                does all that is installed run here?
  python -m benchmarks.speed --sizes --tile A.laz   on your own files, LAS to LAS or LAZ to LAZ
  python -m benchmarks.speed --sizes 0.001 --tile   how long the start takes
  python -m benchmarks.speed --only tin-densification pdal lasr
"""
_PACKAGES = ("numpy", "scipy", "laspy", "lazrs")


def tell(text: str) -> None:
    """Say how far it is, beside what is printed."""
    print(text, file=sys.stderr, flush=True)


def compete(
    tile: Tile, takers: Sequence[Contestant], rounds: int, peer_rounds: int, timeout: float
) -> list[Run]:
    """Measure all on one tile, in turn within each round.

    Who fails or is stopped in one round does not take part in the next.
    """
    runs: list[Run] = []
    out: set[str] = set()
    with tempfile.TemporaryDirectory(prefix="bare-earth-speed-") as folder:
        target = Path(folder) / "out" / f"written{tile.path.suffix}"
        target.parent.mkdir()
        classified = _classified(tile, takers, Path(folder))
        for number in range(rounds):
            for taker in takers:
                if taker.name in out or (taker.is_peer and number >= peer_rounds):
                    continue
                source = classified if taker.needs_classes else tile.path
                cost = measure(taker.command(source, target), timeout)
                if taker.writes_points:
                    cost = _checked(cost, tile, target)
                runs.append(Run(tile.name, taker.name, number, cost))
                if cost.problem:
                    out.add(taker.name)
                tell(
                    f"{tile.name}, round {number + 1}, {taker.label}: {cost.wall:.2f} s,"
                    f" {cost.cpu:.2f} s CPU, {cost.memory / 1e6:.0f} MB {cost.problem}"
                )
                for file in target.parent.iterdir():
                    file.unlink()
    return runs


def _classified(tile: Tile, takers: Sequence[Contestant], folder: Path) -> Path:
    """Return the tile with classes, for those who need them."""
    target = folder / f"classified{tile.path.suffix}"
    if any(taker.needs_classes for taker in takers):
        first = next(contestant for contestant in contestants() if contestant.name == OURS[0])
        measure(first.command(tile.path, target), None)
    return target


def _checked(cost: Cost, tile: Tile, target: Path) -> Cost:
    """Return the cost, with a problem if not every point was written."""
    if cost.problem:
        return cost
    written = tiles.tile(target).count if target.exists() else 0
    if written == tile.count:
        return cost
    return cost._replace(problem=f"wrote {written:,} of {tile.count:,} points")


def measure_all(
    chosen: Sequence[Tile],
    takers: Sequence[Contestant],
    rounds: int,
    peer_rounds: int,
    timeout: float,
    keep: Callable[[Results], None] = lambda found: None,
) -> Results:
    """Measure on all tiles, the smallest first; who is stopped on one is left out of the rest.

    What is there after each tile is given to `keep`.
    """
    found = Results(facts())
    takers = list(takers)
    for tile in sorted(chosen, key=lambda tile: tile.count):
        found.tiles.append(tile)
        # Once without counting: the file is then in the memory of the system for all.
        with open(tile.path, "rb") as file:
            while file.read(1 << 20):
                pass
        found.runs += compete(tile, takers, rounds, peer_rounds, timeout)
        takers = [
            taker
            for taker in takers
            if not found.problem(tile.name, taker.name).startswith(STOPPED)
        ]
        found.facts["Load average at the end"] = _load()
        keep(found)
    return found


def facts() -> dict[str, str]:
    """Return what the figures depend on beside the program."""
    versions = (f"{name} {importlib.metadata.version(name)}" for name in _PACKAGES)
    commit = ["git", "-C", str(ROOT), "describe", "--always", "--dirty"]
    try:
        done = subprocess.run(commit, check=True, capture_output=True, text=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        done = "unknown"
    return {
        "Date": datetime.date.today().isoformat(),
        "Commit": done,
        "Processor": f"{_processor()}, {available_cpus()} cores",
        "Python": ", ".join([platform.python_version(), *versions]),
        "Load average at the start": _load() + _busy(),
    }


def _load() -> str:
    return f"{os.getloadavg()[0]:.1f}"


def _busy() -> str:
    return ", so that the machine was busy with other work" if os.getloadavg()[0] > 0.5 else ""


def _processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    models = (line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    return next(models, platform.processor() or platform.machine())


def generated(sizes: Sequence[float]) -> list[Tile]:
    """Return tiles of so many million points, made by a process of their own if missing."""
    found = []
    for size in sizes:
        count = round(size * 1e6)
        path = tiles.path_of(count)
        if not path.exists():
            tell(f"Making {path} ...")
            cost = measure([sys.executable, "-m", "benchmarks.speed.tiles", str(count), str(path)])
            if cost.problem:
                raise SystemExit(f"The tile of {count:,} points was not made: {cost.problem}")
        found.append(tiles.tile(path, tiles.title(count)))
    return found


def _parser(known: Sequence[Contestant]) -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.speed",
        description=__doc__,
        epilog=_EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "--sizes", nargs="*", type=float, default=list(SIZES), metavar="MILLION",
        help="generated tiles of so many million points (default: 1 10 50)",
    )  # fmt: skip
    parser.add_argument(
        "--tile", nargs="*", type=Path, metavar="FILE",
        help=f"real tiles (default: {' '.join(REAL)})",
    )  # fmt: skip
    parser.add_argument(
        "--quick", action="store_true",
        help=f"one round on a generated tile of {_QUICK * 1e6:,.0f} points alone",
    )  # fmt: skip
    parser.add_argument("--rounds", type=int, default=5, help="how often (default: 5)")
    parser.add_argument(
        "--peer-rounds", type=int, default=2, help="in how many of these peers run (default: 2)"
    )
    parser.add_argument(
        "--timeout", type=float, default=1800.0, metavar="SECONDS",
        help="stop a run after so long, and leave larger tiles out (default: 1800)",
    )  # fmt: skip
    parser.add_argument(
        "--only", nargs="+", metavar="NAME", choices=[taker.name for taker in known],
        help=f"beside the floor: {' '.join(taker.name for taker in known if taker.name != FLOOR)}",
    )  # fmt: skip
    parser.add_argument(
        "--profile", action="store_true", help="tell where the time goes (pip install py-spy)"
    )
    parser.add_argument(
        "--qgis", default="", metavar="COMMAND", help="what runs others beside QGIS"
    )
    parser.add_argument("--json", type=Path, metavar="FILE", help="write all figures")
    parser.add_argument(
        "--from", type=Path, dest="source", metavar="FILE",
        help="measure nothing: take what --json wrote",
    )  # fmt: skip
    parser.add_argument("--write", action="store_true", help="write results/performance.md")
    return parser


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the benchmark that the command line asks for."""
    options = _parser(contestants()).parse_args(arguments)
    known = contestants(options.qgis)
    if options.quick:
        options.sizes, options.tile, options.rounds = [_QUICK], [], 1
    found = results.load(options.source) if options.source else _measured(options, known)
    if options.json:
        results.save(found, options.json)
    report = Report(found, known)
    for lines in report.blocks().values():
        if lines:
            print("", *lines, sep="\n", flush=True)
    if options.write:
        report.write(PAGE)
        print(f"\nWritten: {PAGE}")


def _measured(options: argparse.Namespace, known: Sequence[Contestant]) -> Results:
    takers = [
        contestant
        for contestant in known
        if not contestant.missing
        and (contestant.name in (FLOOR, *(options.only or ())) or not options.only)
    ]
    files = options.tile
    if files is None:
        files = [path for path in map(data.real, REAL) if path.exists()]
    # Paths from the root: the commands run in the repository.
    chosen = [tiles.tile(path.resolve()) for path in files] + generated(options.sizes)
    if not chosen:
        raise SystemExit("There is no tile to measure on: give --sizes or --tile.")

    def keep(found: Results) -> None:
        if options.json:
            results.save(found, options.json)

    found = measure_all(chosen, takers, options.rounds, options.peer_rounds, options.timeout, keep)
    if options.profile:
        found.profiles = _profiles(found.tiles, takers)
    return found


def _profiles(chosen: Sequence[Tile], takers: Sequence[Contestant]) -> dict:
    """Return the profile of each filter of ours on the largest tile that is not huge."""
    if not profiling.program():
        tell("Not installed: pip install py-spy")
        return {}
    fitting = [tile for tile in chosen if tile.count <= profiling.MOST_POINTS] or chosen[:1]
    profiles = {}
    with tempfile.TemporaryDirectory(prefix="bare-earth-speed-") as folder:
        for taker in takers:
            if taker.name in OURS:
                tell(f"{taker.label} on {fitting[-1].name}, under py-spy ...")
                command = taker.command(fitting[-1].path, Path(folder) / "classified.laz")
                profiles[taker.name] = profiling.profile(command, fitting[-1])
    return profiles


if __name__ == "__main__":
    main()
