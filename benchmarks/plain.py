"""Tries the filters on the matrix of plain things: `python -m benchmarks.plain`.

Each row is a scene with one thing (`benchmarks/scenes/plain.py`). A thing that must stay is held if
95 % of its points are ground, one that must go if at most 5 % of its points are (of roofs 2 %, of
single points none). Of the ground round it 95 % must be ground. Where the thing has points, the
terrain model may be off by some decimetres from that of the true ground: 0.15 m over plants and
low noise, 0.3 m over other objects, 0.15 m and a tenth of its height over earth; a tenth of the
points may be off farther.

Printed for each method: held or NOT, percent of the thing that is ground, metres by which the model
is off, and percent of the ground round it that is kept.

`--only 5x1.5` runs the rows whose name has this text. `--without low-groups` leaves out a rule, or
runs a group or values of `benchmarks/rules.py`, or gives a rule a value, as in
`--without "gentle-border.shares=(0.2, 0.2)"`. With `--changed` only rows are printed whose verdict
changes by that: NOT where the rule protects, held where it takes. `--set ground_tolerance=0.3`
gives a parameter. `--picture FOLDER` draws the rows that fail. `--peers` runs other
programs that are installed as well, with their defaults, and `--write` writes the shares of rows
that come out right into results/plain.md and docs/comparison.md.
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path
from typing import NamedTuple, Sequence

import numpy as np

from bare_earth.algorithms.core.errors import BareEarthError
from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.tin.triangulation import Tin

from . import peers, plain_page, tables, work
from .accuracy import method_name
from .measure import Filter, GroundFilter
from .rules import BASE, changed, pipeline_of, switched_off
from .scenes.classes import HIGH_NOISE
from .scenes.plain import KINDS, PLACES, Plain, Row, rows

# Least share in percent of the ground round a thing that is kept.
_ROUND = 95.0
# Half the width in metres of the strip of a profile.
_STRIP = 0.6


class Verdict(NamedTuple):
    """How a row comes out."""

    held: bool
    share: float  # percent of the thing that is ground
    metres: float  # by which the terrain model is off over it; positive if too high
    round: float  # percent of the ground round it


class Job(NamedTuple):
    """A row, and how the filters run."""

    name: str
    methods: tuple[str, ...]
    variant: str = BASE
    values: tuple[tuple[str, object], ...] = ()
    folder: Path | None = None


class Judge:
    """Compares what filters find with the truth of a row."""

    def __init__(self, row: Row) -> None:
        self.plain = plain = row.make()
        self._cloud = plain.scene.cloud()
        self._kind, self._sizes = row.kind, row.sizes
        self._truth, self._thing = plain.scene.ground, plain.thing
        self._points = plain.scene.points
        # About 10,000 vertices tell the terrain, whatever the size of the scene.
        self._cell = max(self._points.sides) / 100.0
        thing = np.flatnonzero(plain.thing)
        self._places = np.array(self._points[:2])[:, thing[:: len(thing) // 3000 + 1]]
        self._true_heights: np.ndarray | None = None
        self._true_heights = self._heights(self._truth)

    def ground(self, method: GroundFilter) -> np.ndarray:
        """Return the ground that a filter finds; none where it says that there is none."""
        try:
            return method.ground(self._cloud)
        except BareEarthError:
            return np.zeros(self._cloud.count, dtype=bool)

    def judged(self, ground: np.ndarray) -> Verdict:
        """Return the verdict on a ground mask."""
        kind, earth = self._kind, self._truth & ~self._thing
        share, around = (100.0 * float(np.mean(ground[some])) for some in (self._thing, earth))
        # Where the true ground says nothing, as below a ship, no error can be told.
        told = np.isfinite(self._true_heights)
        error = np.nan_to_num(self._heights(ground)[told] - self._true_heights[told], nan=-99.0)
        error = error[np.argsort(np.abs(error))]
        metres = float(error[int(0.9 * (len(error) - 1))]) if len(error) else 0.0
        limit = kind.off + (0.1 * self._sizes[1] if kind.stays else 0.0)
        wrong = 100.0 - share if kind.stays else share
        is_held = wrong <= kind.wrong and abs(metres) <= limit and around >= _ROUND
        return Verdict(is_held, share, metres, around)

    def _heights(self, ground: np.ndarray) -> np.ndarray:
        """Return the heights of a terrain model where the thing has points."""
        if np.array_equal(ground, self._truth) and self._true_heights is not None:
            return self._true_heights
        x, y, z = self._points.take(ground)
        if len(x) < 4:
            return np.full(self._places.shape[1], np.nan)
        cells = np.floor(x / self._cell) * 100_000 + np.floor(y / self._cell)
        _, some = np.unique(cells, return_index=True)
        return Tin(x[some], y[some], z[some]).interpolate(*self._places)


def contestant(name: str, values: dict[str, object]) -> GroundFilter:
    """Return a filter of ours or of somebody else by its name."""
    others: dict[str, GroundFilter] = {peer.name: peer for peer in peers.installed()}
    return others[name] if name in others else Filter(name, **values)


def run(job: Job) -> dict[str, Verdict]:
    """Return the verdict of each method on a row."""
    judge, found = Judge({row.name: row for row in rows()}[job.name]), {}
    with switched_off(job.variant):
        for method in job.methods:
            ground = judge.ground(contestant(method, dict(job.values)))
            found[method] = judge.judged(ground)
            if job.folder and not found[method].held:
                draw(judge.plain, ground, f"{job.name} {method}", job.folder)
    return found


def draw(plain: Plain, ground: np.ndarray, title: str, folder: Path) -> None:
    """Draw which points are wrong, and a profile through the middle of the scene."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    scene, (x, y, z) = plain.scene, plain.scene.points
    x, y = x - scene.corner[0], y - scene.corner[1]
    cos, sin = np.cos(plain.angle), np.sin(plain.angle)
    u, v = x * cos + y * sin, y * cos - x * sin
    figure = Figure(figsize=(12.0, 8.0), layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.subplot_mosaic("am;cm", width_ratios=(3, 2))
    low = scene.classes != HIGH_NOISE
    for some, colour in (
        (~scene.ground & ~ground, "#c0c0c0"), (scene.ground & ground, "#9c5a1a"),
        (scene.ground & ~ground, "#1565d8"), (~scene.ground & ground, "#e02020"),
    ):  # fmt: skip
        axes["m"].scatter(u[some], v[some], s=2, c=colour, linewidths=0)
        for name, along, across in (("a", u, v), ("c", v, u)):
            strip = some & low & (np.abs(across) < _STRIP)
            axes[name].scatter(along[strip], z[strip], s=7, c=colour, linewidths=0)
            axes[name].set_title("along" if name == "a" else "across", fontsize=9)
    axes["m"].set_aspect("equal")
    figure.suptitle(f"{title}: ground missed is blue, objects kept are red", fontsize=10)
    folder.mkdir(parents=True, exist_ok=True)
    figure.savefig(folder / f"{title.replace(' ', '-')}.png", dpi=80)


def sums(found: dict[str, dict[str, Verdict]], methods: Sequence[str]) -> list[str]:
    """Return how many rows of each kind are held, as a table."""
    table = []
    for kind in KINDS:
        own = [found[row.name] for row in rows() if row.kind is kind and row.name in found]
        if own:
            held = (str(sum(one[method].held for one in own)) for method in methods)
            table.append([kind.name, "stays" if kind.stays else "goes", str(len(own)), *held])
    total = (str(sum(one[method].held for one in found.values())) for method in methods)
    table.append(["all", "", str(len(found)), *total])
    return tables.table(("Kind", "must", "rows", *methods), table)


def _peers(are_asked: bool) -> list[str]:
    """Return the other programs that run with their defaults."""
    return [peer.name for peer in peers.installed() if are_asked and peer.is_for_tiles]


def is_whole(options: argparse.Namespace, chosen: Sequence[str]) -> bool:
    """Return whether all is measured that the page is about."""
    count = sum(row.place == PLACES[0] or not options.quick for row in rows())
    usual = options.without == BASE and not options.set and options.method == list(METHODS)
    return len(chosen) == count and usual


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the rows that the command line asks for."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.plain",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--method", nargs="+", type=method_name, default=list(METHODS))
    kinds = [kind.name for kind in KINDS]
    parser.add_argument("--kind", nargs="+", choices=kinds, default=kinds, metavar="KIND")
    parser.add_argument("--only", default="", metavar="TEXT", help="rows whose name has it")
    parser.add_argument("--without", default=BASE, metavar="RULE")
    parser.add_argument("--set", nargs="+", default=[], metavar="NAME=VALUE", help="parameters")
    parser.add_argument("--picture", type=Path, metavar="FOLDER", help="draw what fails")
    parser.add_argument("--peers", action="store_true", help="other programs as well")
    parser.add_argument("--quick", action="store_true", help="one place of the grid")
    parser.add_argument("--write", action="store_true", help="write results/plain.md")
    parser.add_argument("--failed", action="store_true", help="print only rows that fail")
    parser.add_argument(
        "--changed", action="store_true", help="print only rows whose verdict is another --without"
    )
    options = parser.parse_args(arguments)
    values = tuple((name, _value(text)) for name, text in (one.split("=") for one in options.set))
    chosen = [
        row.name
        for row in rows()
        if row.kind.name in options.kind
        and options.only in row.name
        and (row.place == PLACES[0] or not options.quick)
    ]
    asked = [*options.method, *_peers(options.peers)]
    if options.write and not is_whole(options, chosen):
        parser.error("The page is about all rows and methods, as they run by default.")
    jobs = [Job(name, tuple(asked), options.without, values, options.picture) for name in chosen]
    if options.without != BASE:
        usual = [pipeline_of(method) for method in options.method]
        if usual == [changed(pipeline, options.without) for pipeline in usual]:
            parser.error(f"--without {options.without} changes none of these methods")
    begun, found, usual = time.perf_counter(), {}, {}
    if options.changed:
        before = [job._replace(variant=BASE, folder=None) for job in jobs]
        usual = dict(zip(chosen, work.side_by_side(run, before)))
    for job, verdicts in zip(jobs, work.side_by_side(run, jobs)):
        found[job.name] = verdicts
        held = {method: one.held for method, one in verdicts.items()}
        before_held = {method: one.held for method, one in usual.get(job.name, {}).items()}
        if not ((options.failed and all(held.values())) or held == before_held):
            cells = (
                f"{'held' if one.held else 'NOT':4} {one.share:5.1f} % {one.metres:+6.2f} m"
                f" {one.round:5.1f} %"
                for one in verdicts.values()
            )
            print(f"{job.name:46}", *cells, sep=" | ", flush=True)
    print("", *sums(found, asked), sep="\n")
    if options.write:
        plain_page.write(
            {
                name: {who: one.held for who, one in verdicts.items()}
                for name, verdicts in found.items()
            }
        )
    print(f"{time.perf_counter() - begun:.0f} s", file=sys.stderr)


def _value(text: str) -> object:
    try:
        return float(text)
    except ValueError:
        return text


if __name__ == "__main__":
    main()
