"""Measures what each number of a rule is worth: `python -m benchmarks.rule_values`.

Each value of a rule, and each constant of the files of the filters, is multiplied by 0.7 and by 1.4
(numbers of things change by one at least; what is on is off), on the tiles of real land that are in
the repository and on one plain thing of each kind, with the first method that has it. `--full`
takes all rows, all tiles and samples that are here, and all methods. `--values low-groups` measures
those whose name begins so.

With `--write` the table in results/rules_comments.md gets what was found, in its columns *protects*
and *takes*; the last column, how a value was found, is written by hand and stays. A value is
without evidence if it has no row there, or another value than the code: a test fails. What was
measured is kept in the cache until the code of the filters changes, place by place.
"""

from __future__ import annotations

import argparse
import json
import sys
from typing import Any, NamedTuple, Sequence

import numpy as np

from bare_earth.algorithms.core.errors import BareEarthError
from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.tools.assess import AssessmentOptions, compare

from . import cache, data, evidence, judge, plain, work
from . import rule_values_page as page
from .accuracy import tell
from .measure import Filter
from .replay import Kept
from .rule_numbers import Change, Value, changed, is_movable, methods_of, values
from .scenes.plain import rows

FACTORS = (0.7, 1.4)
# Plain things of the quick form: what lies low, stands up, slopes, is built or grows.
_ROWS = (
    "crater-", "cellar-", "trench-", "crag-", "dyke-", "bank-3", "plateau-", "benches-", "butte-",
    "hollow-way-under", "court-by-house", "hall-", "a-frame", "polytunnels", "cars-", "bushes-",
    "grass-", "understory-", "low-clumps", "low-points",
)  # fmt: skip


class Job(NamedTuple):
    """What one process does at a time: all changes of a method at one place."""

    place: judge.Place
    method: str
    values: tuple[Value, ...]
    only_kept: bool = False


# By change as text: share of the labels that differ, total error, whether it is held.
Figures = dict[str, tuple[float, Any, Any]]


def run(job: Job) -> Figures:
    """Return the figures of all changes at a place, and keep them."""
    name = f"{job.place.kind}-{job.place.name}-{job.method}.json"
    path = cache.FOLDER / "values" / evidence.digest(("filters", "grids", "tin")) / name
    known: Figures = json.loads(path.read_text("utf-8")) if path.exists() else {}
    changes = {
        f"{value.title} {factor:g}": Change(value.owner, value.name, factor)
        for value in job.values
        for factor in FACTORS
    }
    todo = {key: change for key, change in changes.items() if key not in known}
    if todo and not job.only_kept:
        place = _Place(job)
        known.update({key: place.figures(change) for key, change in todo.items()})
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(json.dumps(known), "utf-8")
    return {key: known[key] for key in changes if key in known}


class _Place:
    """Measures changes at one place."""

    def __init__(self, job: Job) -> None:
        self._filter, self._kept, self._judge = Filter(job.method), Kept(), None
        if job.place.kind == "plain":
            self._judge = plain.Judge({row.name: row for row in rows()}[job.place.name])
        else:
            tiles = {tile.title: tile for tile in data.REAL}
            tile = tiles.get(job.place.name)
            path = data.real(tile.name) if tile else data.find(f"isprs/{job.place.name}.laz")
            self._cloud, self._reference = data.load(path)
            self._counts = tile is None or tile.is_trusted
            self._options = AssessmentOptions(ignored_classes=tile.left_out if tile else ())
        self._ground = self._found(None)
        self._usual = self._judged(self._ground)

    def figures(self, change: Change) -> tuple[float, Any, Any]:
        """Return how much a change matters, beside what is usual."""
        try:
            ground = self._found(change)
        except (ArithmeticError, IndexError, ValueError, TypeError):
            return -1.0, None, None  # no value that works
        if np.array_equal(ground, self._ground):
            return 0.0, None, None
        share = 100.0 * float(np.mean(ground != self._ground))
        before, after = self._usual, self._judged(ground)
        return (
            (share, (before, after), None)
            if self._judge is None
            else (share, None, (before, after))
        )

    def _found(self, change: Change | None) -> np.ndarray:
        with changed(change, self._kept):
            if self._judge is not None:
                return self._judge.ground(self._filter)
            try:
                return self._filter.ground(self._cloud)
            except BareEarthError:
                return np.zeros(self._cloud.count, dtype=bool)

    def _judged(self, ground: np.ndarray) -> Any:
        if self._judge is not None:
            return bool(self._judge.judged(ground).held)
        return (
            float(compare(ground, self._reference, self._options).total_error)
            if self._counts
            else None
        )


def _is_quick(place: judge.Place) -> bool:
    return place.kind == "tile" or place.name.startswith(_ROWS)


def jobs(is_full: bool, beginning: str) -> list[Job]:
    """Return what is measured where."""
    chosen = [one for one in values() if one.title.startswith(beginning) and is_movable(one)]
    by_method: dict[str, list[Value]] = {method: [] for method in METHODS}
    for value in chosen:
        for method in methods_of(value)[: None if is_full else 1]:
            by_method[method].append(value)
    places = [
        place
        for place in judge.places(is_full)
        if place.kind != "scene" and (is_full or _is_quick(place))
    ]
    return [
        Job(place, method, tuple(some))
        for place in places
        for method, some in by_method.items()
        if some
    ]


def main(arguments: Sequence[str] | None = None) -> None:
    """Measure what the command line asks for."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.rule_values",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--full", action="store_true", help="all rows, tiles and methods")
    parser.add_argument("--values", default="", metavar="NAME", help="only those that begin so")
    parser.add_argument("--kept", action="store_true", help="measure nothing, take what is kept")
    parser.add_argument("--write", action="store_true", help="write the table")
    options = parser.parse_args(arguments)
    results: dict[tuple[str, str], Figures] = {}
    todo = [job._replace(only_kept=options.kept) for job in jobs(options.full, options.values)]
    for job, found in zip(todo, work.side_by_side(run, todo)):
        results[job.place.name, job.method] = found
        if not options.kept:
            tell(f"{job.method}, {job.place.kind} {job.place.name}")
    figures = by_value(results)
    for title, found in figures.items():
        print(title, *page.measured(found), sep=" | ")
    places = {place for (place, _), found in results.items() if found}
    print(f"\n{len(figures)} values at {len(places)} places", file=sys.stderr)
    if options.write:
        page.write(values(), figures)


def by_value(results: dict[tuple[str, str], Figures]) -> dict[str, dict[tuple[str, float], Any]]:
    """Return the figures of each value: by method and factor, then by place."""
    found: dict[str, dict[tuple[str, float], Any]] = {}
    for (place, method), figures in results.items():
        for key, one in figures.items():
            title, factor = key.rsplit(" ", 1)
            by_factor = found.setdefault(title, {})
            by_factor.setdefault((method, float(factor)), {})[place] = one
    return found


if __name__ == "__main__":
    main()
