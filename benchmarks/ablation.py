"""Measures what each rule of the filters is worth: `python -m benchmarks.ablation`.

Each rule is left out of its pipeline, alone and in groups (`benchmarks/rules.py`), on the ISPRS
samples in some phases of the grid and on the real tiles. On all tiles the terrain model counts,
with its spikes and pits, and on those whose labels are trusted the labels as well. What a rule
protects and what it takes of plain things (`benchmarks/plain.py`) is counted as well: rows that are
held only with it, and only without it. `--on plain --quick --rules low-groups` does only that. A
rule with another value can be measured as well: `--rules "shrubs.most_open=0.9"`.

What has been measured is kept in ~/.cache/bare-earth/benchmarks (or $BARE_EARTH_CACHE) until a
filter, a grid or the data change, so that a run that was stopped goes on where it stopped.
"""

from __future__ import annotations

import argparse
import functools
import hashlib
import json
import sys
import time
from pathlib import Path
from typing import NamedTuple, Sequence

import numpy as np

from bare_earth.algorithms.core.errors import BareEarthError
from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.tools.assess import AssessmentOptions, compare

from . import ablation_page as page
from . import cache, data, plain, scenes, work
from .accuracy import method_name, tell
from .measure import Filter, ReferenceModel
from .phases import PHASES, shifted
from .replay import Kept
from .rules import BASE, GROUPS, VALUES, switched_off, variants
from .scenes.plain import KINDS, PLACES, rows

# Tiles that the quick form leaves out, and the tile on which time is measured.
_LONG, _TIMED = ("hawaii_forest", "nrw_rural", "wires_single_return"), "ahn3_urban"
# Code that decides what is found.
_ALGORITHMS = Path(__file__).parents[1] / "algorithms"
_FILTERS = tuple(_ALGORITHMS / name for name in ("filters", "grids", "tin"))


class Place(NamedTuple):
    """What the ground of is known: a sample in a phase, a real tile, or plain things of a kind."""

    kind: str  # one of `ablation_page.KINDS`
    name: str  # of plain things with their place of the grid
    phase: tuple[float, ...] = ()

    @property
    def title(self) -> str:
        """Name and numbers as text."""
        return " ".join([self.name, *(f"{value:g}" for value in self.phase)])

    @property
    def tile(self) -> data.RealTile | None:
        """What is known of a real tile."""
        tiles = {tile.title: tile for tile in data.REAL}
        return tiles[self.name] if self.kind == "real" else None

    def path(self) -> Path:
        """Return the file of a sample or a tile, or what makes plain things."""
        if self.kind == "plain":
            return Path(scenes.__file__).parent
        if self.tile:
            return data.real(self.tile.name)
        return data.find(f"isprs/{self.name}.laz")


def places(is_quick: bool) -> list[Place]:
    """Return where rules are measured; the quick form has fewer phases and tiles."""
    phases = PHASES[: 2 if is_quick else 6]
    found = [Place("isprs", path.stem, phase) for path in data.isprs() for phase in phases]
    left_out = _LONG if is_quick else ()
    for tile in data.REAL:
        if data.real(tile.name).exists() and tile.title not in left_out:
            found.append(Place("real", tile.title))
    of_grid = PLACES[:1] if is_quick else PLACES
    return found + [Place("plain", f"{kind.name} {one}") for kind in KINDS for one in of_grid]


class Job(NamedTuple):
    """What one process does at a time: all variants of a method at one place."""

    method: str
    place: Place
    variants: tuple[str, ...]
    only_kept: bool = False


def run(job: Job) -> dict[str, page.Figures]:
    """Return the figures of the variants, and keep them."""
    path = cache.FOLDER / "ablation" / f"{_digest(job)}.json"
    kept = json.loads(path.read_text("utf-8")) if path.exists() else {}
    keys = {name: repr(GROUPS.get(name) or VALUES.get(name) or name) for name in job.variants}
    todo = [name for name, key in keys.items() if key not in kept]
    if todo and not job.only_kept:
        figures = (_PlainScorer if job.place.kind == "plain" else _Scorer)(job).figures
        kept.update({keys[name]: figures(name) for name in todo})
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(json.dumps(kept), "utf-8")
    return {name: kept[key] for name, key in keys.items() if key in kept}


class _Scorer:
    """Measures variants at one place."""

    def __init__(self, job: Job) -> None:
        self._filter, self._place = Filter(job.method), job.place
        # Where time is measured, all rules run.
        self._kept = None if job.place.name == _TIMED else Kept()
        cloud, self._reference = data.load(job.place.path())
        self._cloud = shifted(cloud, *job.place.phase) if job.place.phase else cloud
        self._model = ReferenceModel(cloud, self._reference) if job.place.tile else None
        self._ground, _ = self._found(BASE)
        self._base = self._measured(self._ground)

    def figures(self, variant: str) -> page.Figures:
        """Return the figures of a variant; those of the base if it finds the same ground."""
        ground, seconds = self._found(variant)
        is_same = np.array_equal(ground, self._ground)
        found = self._base if is_same else self._measured(ground)
        if self._place.name != _TIMED:
            return found
        # One after the other, since a machine is not equally fast all the time.
        _, of_base = self._found(BASE)
        again, base_again = (self._found(name)[1] for name in (variant, BASE))
        return {**found, "cpu": min(seconds, again), "cpu_base": min(of_base, base_again)}

    def _found(self, variant: str) -> tuple[np.ndarray, float]:
        """Return the ground and the CPU time in seconds."""
        begun = time.process_time()
        with switched_off(variant, self._kept):
            try:
                ground = self._filter.ground(self._cloud)
            except BareEarthError:  # without any ground all of it is missed
                ground = np.zeros(self._cloud.count, dtype=bool)
        return ground, time.process_time() - begun

    def _measured(self, ground: np.ndarray) -> page.Figures:
        tile, found = self._place.tile, {}
        if tile is None or tile.is_trusted:
            options = AssessmentOptions(ignored_classes=tile.left_out if tile else ())
            found["total"] = compare(ground, self._reference, options).total_error
        if self._model is not None:
            error = self._model.error(ground)
            found["rmse"], found["bias"] = error.rmse, error.bias
            found["spikes"], found["pits"] = map(float, (error.spikes.count, error.pits.count))
        return found


class _PlainScorer:
    """Counts plain things of a kind that are held with all rules, and without some."""

    def __init__(self, job: Job) -> None:
        self._filter = Filter(job.method)
        kind, of_grid = job.place.name.split(" ")
        self._judges = [
            plain.Judge(row) for row in rows() if (row.kind.name, row.place) == (kind, of_grid)
        ]
        self._kept = [Kept() for _ in self._judges]
        self._grounds = self._found(BASE)
        judged = zip(self._judges, self._grounds)
        self._base = np.array([judge.judged(ground).held for judge, ground in judged])

    def figures(self, variant: str) -> page.Figures:
        """Return how many are held, only held with what the variant leaves out, only without."""
        held = self._base.copy()
        for number, ground in enumerate(self._found(variant) if variant != BASE else ()):
            if not np.array_equal(ground, self._grounds[number]):
                held[number] = self._judges[number].judged(ground).held
        counts = {"held": held, "protects": self._base & ~held, "takes": held & ~self._base}
        figures = {name: float(some.sum()) for name, some in counts.items()}
        return {"rows": float(len(held)), **figures}

    def _found(self, variant: str) -> list[np.ndarray]:
        found = []
        for judge, kept in zip(self._judges, self._kept):
            with switched_off(variant, kept):
                found.append(judge.ground(self._filter))
        return found


def _digest(job: Job) -> str:
    """Return what tells apart what is kept: the code, the method, the data and the measuring."""
    place, own = job.place, hashlib.sha256(_code(_FILTERS))
    own.update(repr((job.method, place)).encode())
    path = place.path()
    own.update(_code((path,)) if path.is_dir() else path.read_bytes())
    return f"{place.kind}-{place.name}-{own.hexdigest()[:24]}"


@functools.lru_cache(maxsize=2)
def _code(folders: tuple[Path, ...]) -> bytes:
    """Return a digest of all the code in some folders."""
    digest = hashlib.sha256()
    for path in sorted(path for folder in folders for path in folder.rglob("*.py")):
        digest.update(path.read_bytes())
    return digest.digest()


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the ablation that the command line asks for."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.ablation",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--method", nargs="+", type=method_name, default=list(METHODS))
    parser.add_argument("--quick", action="store_true", help="fewer phases and tiles")
    parser.add_argument("--rules", nargs="+", default=[], metavar="NAME", help="only these")
    parser.add_argument(
        "--on", nargs="+", choices=page.KINDS, default=page.KINDS, help="some kinds of places"
    )
    parser.add_argument("--kept", action="store_true", help="measure nothing, show what is kept")
    parser.add_argument("--write", action="store_true", help="write results/rules.md")
    options = parser.parse_args(arguments)
    everywhere = [place for place in places(options.quick) if place.kind in options.on]
    results: page.Results = {}
    for method in options.method:
        chosen = tuple(
            name for name in variants(method) if name in (BASE, *(options.rules or [name]))
        ) + tuple(name for name in options.rules if "=" in name)
        jobs = [Job(method, place, chosen, options.kept) for place in everywhere]
        results[method] = {}
        for job, found in zip(jobs, work.side_by_side(run, jobs)):
            if found:
                results[method][job.place.kind, job.place.title] = found
            if not options.kept:
                tell(f"{method}, {job.place.kind} {job.place.title}")
        print("", METHODS[method].label, *page.table(results[method], method), sep="\n")
    if options.write:
        page.write(results, options.quick)
        print(f"\nWritten: {page.PAGE}", file=sys.stderr)


if __name__ == "__main__":
    main()
