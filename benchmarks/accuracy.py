"""Measures how right the filters are: `python -m benchmarks.accuracy`.

Every class is set to 0 first and noise is left in; every filter runs with its defaults. On the
labelled samples each point counts. On tiles whose reference ground is thinned the terrain models
are compared: both TINs on the same 1 m grid, inside the convex hull of the reference.

Figures of ours on the samples are means over the phases of the grid (`benchmarks/phases.py`), with
their range. Generated scenes (`benchmarks/scenes`) are made from seeds of which one half is for
tuning: `--scenes --method tin --seeds tuning --no-dtm`.

Without the name of a part everything is measured and printed. With `--write`, samples and tiles are
written to results/accuracy.md, scenes and sensitivity to results/scenes.md. Answers of peers are
remembered in ~/.cache/bare-earth/benchmarks (or $BARE_EARTH_CACHE); the data are sought in
$BARE_EARTH_DATA.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import Sequence

from bare_earth.algorithms.filters import METHODS

from . import data, peers, report, tables
from .generated import score_scenes
from .measure import Filter, GroundFilter, Scores, score, score_tile
from .phases import PHASES
from .scenes import KINDS, REPORTING_SEEDS, TUNING_SEEDS
from .sensitivity import SOME, Moved, Place, sensitivity

# The dense tile that sensitivity is measured on besides the samples.
DENSE_TILE = "ahn3_urban"
SEEDS = {"tuning": TUNING_SEEDS, "reporting": REPORTING_SEEDS}
# What is measured, and what each page needs.
PARTS = "isprs", "real", "scenes", "sensitivity"
PAGES = PARTS[:2], PARTS[2:]


def tell(text: str) -> None:
    """Say how far it is, beside what is printed."""
    print(text, file=sys.stderr, flush=True)


def show(*blocks: Sequence[str]) -> None:
    """Print tables, each after an empty line."""
    for lines in blocks:
        print("", *lines, sep="\n", flush=True)


def measure_isprs(
    filters: Sequence[GroundFilter],
    samples: Sequence[Path],
    phases: Sequence[tuple[float, float]] = PHASES,
) -> Scores:
    """Measure the filters on the samples in some phases and print the figures."""
    results = score(filters, samples, phases)
    show(*(tables.isprs(results, title) for title in tables.FIGURES), tables.quoted())
    return results


def measure_real(filters: Sequence[GroundFilter]) -> tables.TileScores:
    """Measure the filters on the real tiles that are here and print the figures."""
    results: tables.TileScores = {}
    filters = [method for method in filters if getattr(method, "is_for_tiles", True)]
    for tile in data.REAL:
        path = data.real(tile.name)
        if path.exists():
            tell(f"{tile.name} ...")
            results[tile.title] = score_tile(filters, tile, *data.load(path))
            for name, one in results[tile.title].items():
                tell(f"  {name}: {one.seconds:.1f} s {one.problem or one.dtm}")
    if results:
        show(tables.labels(results), tables.doubtful(results))
        show(*(tables.dtm(results, *figure) for figure in tables.DTM_FIGURES))
        show(tables.spikes(results))
        show(tables.seconds(results), tables.problems(results))
    return results


def measure_scenes(
    methods: Sequence[str], seeds: str, kinds: Sequence[str], with_dtm: bool = True
) -> tables.SceneScores:
    """Measure filters of ours on generated scenes and print the figures, the worst kinds last."""
    tell(f"Scenes, {seeds} seeds ...")
    filters = [Filter(method) for method in methods]
    results = score_scenes(filters, SEEDS[seeds], kinds, with_dtm)
    for name, lines in tables.scenes(results).items():
        show([f"{METHODS[name].label}, {seeds} seeds"], lines)
    show(tables.scene_totals(results))
    return results


def measure_sensitivity(methods: Sequence[str], samples: Sequence[Path]) -> Moved:
    """Halve and double each default, on the samples and on a dense tile; print the figures."""
    places = {"ISPRS samples": Place(tuple(samples), PHASES[SOME])}
    for tile in data.REAL:
        if tile.title == DENSE_TILE and data.real(tile.name).exists():
            places[DENSE_TILE] = Place((data.real(tile.name),), left_out=tile.left_out)
    tell("Defaults, halved and doubled ...")
    results = sensitivity(methods, places)
    for method, moved in results.items():
        for where, rows in moved.items():
            show([f"{method}, {where}"], tables.sensitivity(rows))
    return results


def method_name(text: str) -> str:
    """Return the method whose name begins as told."""
    found = [name for name in METHODS if name.startswith(text)]
    if len(found) != 1:
        raise argparse.ArgumentTypeError(f"'{text}' is not one of {', '.join(METHODS)}")
    return found[0]


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the benchmark that the command line asks for."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.accuracy",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "--method", nargs="+", type=method_name, default=list(METHODS), help="some of ours"
    )
    parser.add_argument("--isprs", action="store_true", help="the ISPRS samples")
    parser.add_argument(
        "--phases",
        type=int,
        nargs="?",
        const=len(PHASES),
        default=len(PHASES),
        metavar="N",
        help="only the first N of the phases of the grid",
    )
    parser.add_argument("--scenes", action="store_true", help="the generated scenes")
    parser.add_argument("--seeds", choices=list(SEEDS), default="reporting", help="of the scenes")
    parser.add_argument(
        "--kinds",
        nargs="+",
        choices=list(KINDS),
        default=list(KINDS),
        metavar="KIND",
        help="some kinds of scenes",
    )
    parser.add_argument("--no-dtm", action="store_true", help="no terrain models of scenes: faster")
    parser.add_argument("--real", action="store_true", help="the real tiles")
    parser.add_argument("--sensitivity", action="store_true", help="halve and double each default")
    parser.add_argument("--peers", action="store_true", help="the peers as well")
    parser.add_argument(
        "--write",
        action="store_true",
        help="write accuracy.md (--isprs --real), scenes.md (--scenes --sensitivity)",
    )
    options = parser.parse_args(arguments)
    parts = {name for name in PARTS if getattr(options, name)} or set(PARTS)
    samples = data.isprs()
    if not samples and parts != {"scenes"}:
        parser.exit(1, f"There is no labelled data in {data.FOLDER.resolve()}.\n")
    if options.write and (options.method != list(METHODS) or not any(map(parts.issuperset, PAGES))):
        parser.error(f"A page is about all methods and needs {' or '.join(map(_named, PAGES))}.")
    filters: list[GroundFilter] = [Filter(name) for name in options.method]
    if options.peers:
        filters += peers.installed()
        for package in peers.missing():
            print(f"Not installed: pip install {package}")
    phases = PHASES[: max(options.phases, 1)]
    isprs = measure_isprs(filters, samples, phases) if "isprs" in parts else {}
    real = measure_real(filters) if "real" in parts else {}
    scenes = {}
    if "scenes" in parts:
        for seeds in SEEDS if options.write else (options.seeds,):
            scenes[seeds] = measure_scenes(options.method, seeds, options.kinds, not options.no_dtm)
    moved = measure_sensitivity(options.method, samples) if "sensitivity" in parts else {}
    if options.write and isprs and real:
        report.write(isprs, real)
    if options.write and scenes and moved:
        report.write_scenes(scenes, SEEDS["reporting"], moved)


def _named(parts: Sequence[str]) -> str:
    return " ".join(f"--{part}" for part in parts)


if __name__ == "__main__":
    main()
