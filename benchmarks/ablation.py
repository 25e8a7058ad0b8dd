"""Measures what each rule of the filters is worth: `python -m benchmarks.ablation`.

Each rule is switched off, alone and in groups (`benchmarks/rules.py`), on the ISPRS samples in some
phases of the grid, on the real tiles, and on generated scenes of seeds that nobody tuned with. On
real tiles whose labels are trusted the labels count, on others the terrain model.

What has been measured is kept in ~/.cache/bare-earth/benchmarks (or $BARE_EARTH_CACHE) until a
filter, a grid or the data change, so that a run that was stopped goes on where it stopped. If a row
of `benchmarks/rules.py` changes, delete the folder `ablation` there.
"""

from __future__ import annotations

import argparse
import functools
import hashlib
import json
import os
import sys
import time
from pathlib import Path
from typing import Iterable, Iterator, NamedTuple, Sequence

import numpy as np

from bare_earth.algorithms.core.errors import BareEarthError
from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.products.comparison import AssessmentOptions, compare

from . import ablation_page as page
from . import cache, data, scenes, work
from .accuracy import method_name, tell
from .generated import score_scene
from .measure import Filter, ReferenceModel
from .phases import PHASES, shifted
from .rules import GROUPS, RULES, acting, switched_off
from .scenes import KINDS, Scene, make

# Seeds of scenes that nobody tuned with, and shares of the density of a kind.
SEEDS, DENSITIES = (101, 103), (1.0, 0.25)
# Tiles that the quick form leaves out, the tile on which time is measured, and how often: the least
# counts.
_LONG = ("hawaii_forest", "nrw_rural", "wires_single_return")
_TIMED, _TIMES = "ahn3_urban", 2
_ALGORITHMS = Path(__file__).parents[1] / "algorithms"


class Place(NamedTuple):
    """A cloud whose ground is known.

    Attributes
    ----------
    kind : str
        One of `ablation_page.KINDS`.
    name : str
        Of the sample, the tile or the kind of scene.
    at : tuple of float
        The phase of a sample; seed and share of the density of a scene.
    """

    kind: str
    name: str
    at: tuple[float, ...] = ()

    @property
    def title(self) -> str:
        """All of it as text."""
        return " ".join([self.kind, self.name, *(f"{each:g}" for each in self.at)])

    def path(self) -> Path:
        """Return the file of a sample or a tile."""
        if self.kind == "isprs":
            return data.FOLDER / "isprs" / f"{self.name}.laz"
        return data.real(self.tile().name)

    def tile(self) -> data.RealTile:
        """Return what is known of a real tile."""
        return next(each for each in data.REAL if each.title == self.name)


def places(is_quick: bool) -> list[Place]:
    """Return where rules are measured; the quick form has one scene of each kind."""
    phases = PHASES[: 2 if is_quick else 6]
    found = [Place("isprs", path.stem, phase) for path in data.isprs() for phase in phases]
    left_out = _LONG if is_quick else ()
    for tile in data.REAL:
        if data.real(tile.name).exists() and tile.title not in left_out:
            found.append(Place("real", tile.title))
    for number, kind in enumerate(KINDS):
        both = list(zip(SEEDS, DENSITIES if number % 2 else DENSITIES[::-1]))
        found += [Place("scene", kind, each) for each in (both[:1] if is_quick else both)]
    return found


def variants(names: Iterable[str] = ()) -> dict[str, tuple[str, ...]]:
    """Return the rules that each variant switches off, by its name; first the base with none."""
    chosen = set(names) or {*RULES, *GROUPS}
    rules = {name: (name,) for name in RULES if name in chosen}
    return {page.BASE: (), **rules, **{name: GROUPS[name] for name in GROUPS if name in chosen}}


class Job(NamedTuple):
    """What one process does at a time: all variants of a method at one place."""

    method: str
    place: Place
    variants: dict[str, tuple[str, ...]]
    is_timed: bool
    only_kept: bool = False


def run(job: Job) -> dict[str, page.Figures]:
    """Return the figures of the variants, and keep each as soon as it is known."""
    path = cache.FOLDER / "ablation" / f"{_digest(job)}.json"
    kept = json.loads(path.read_text("utf-8")) if path.exists() else {}
    todo = {name: off for name, off in job.variants.items() if name not in kept}
    if todo and not job.only_kept:
        scorer = _Scorer(job)
        for name, off in {page.BASE: (), **todo}.items():
            kept[name] = scorer.figures(off)
            path.parent.mkdir(parents=True, exist_ok=True)
            part = path.with_suffix(f".{os.getpid()}")
            part.write_text(json.dumps(kept), "utf-8")
            part.replace(path)
    return {name: kept[name] for name in job.variants if name in kept}


class _Scorer:
    """Measures variants at one place."""

    def __init__(self, job: Job) -> None:
        self._filter, self._place, self._is_timed = Filter(job.method), job.place, job.is_timed
        self._method = job.method
        self._scene, self._model = None, None
        if job.place.kind == "scene":
            self._scene = _scene(job.place)
            self._cloud = self._scene.cloud()
            return
        cloud, self._reference = data.load(job.place.path())
        self._cloud = shifted(cloud, *job.place.at) if job.place.at else cloud
        if job.place.kind == "real" and not job.place.tile().is_trusted:
            self._model = ReferenceModel(self._cloud, self._reference)

    @functools.cached_property
    def _base(self) -> page.Figures:
        with acting() as self._acting:
            return self._measured(())

    def figures(self, off: tuple[str, ...]) -> page.Figures:
        """Return the figures without some rules; those of the base where none of them acts."""
        found = self._base
        serving = tuple(name for name in off if RULES[name].serves(self._method))
        if self._acting.intersection(serving):
            found = self._measured(serving)
        if not self._is_timed:
            return found
        # One after the other, since a machine is not equally fast all the time.
        pairs = [[self._seconds(each) for each in (serving, ())] for _ in range(_TIMES)]
        cpu, cpu_base = map(min, zip(*pairs))
        return {**found, "cpu": cpu, "cpu_base": cpu_base}

    def _ground(self, off: tuple[str, ...]) -> np.ndarray:
        with switched_off(off):
            try:
                return self._filter.ground(self._cloud)
            except BareEarthError:  # without any ground all of it is missed
                return np.zeros(self._cloud.count, dtype=bool)

    def _seconds(self, off: tuple[str, ...]) -> float:
        start = time.process_time()
        self._ground(off)
        return time.process_time() - start

    def _measured(self, off: tuple[str, ...]) -> page.Figures:
        ground = self._ground(off)
        if self._scene is not None:
            score = score_scene(self._scene, ground, with_dtm=False)
            return {"type_1": score.type_1, "type_2": score.type_2}
        if self._model is not None:
            difference = self._model.of(ground) - self._model.heights
            known = difference[np.isfinite(difference)]
            return {"rmse": float(np.sqrt(np.mean(known**2))), "bias": float(np.mean(known))}
        left_out = self._place.tile().left_out if self._place.kind == "real" else ()
        found = compare(ground, self._reference, AssessmentOptions(ignored_classes=left_out))
        figures = "total_error", "type_1_error", "type_2_error"
        return dict(zip(("total", "type_1", "type_2"), (getattr(found, each) for each in figures)))


def _scene(place: Place) -> Scene:
    seed, share = place.at
    return make(place.name, int(seed), density=share * KINDS[place.name].defaults.density)


def _digest(job: Job) -> str:
    """Return what tells apart what is kept: the code, the method, the data and the measuring."""
    place, own = job.place, hashlib.sha256(_code().encode())
    told = job.method, place, job.is_timed and _TIMES
    own.update(repr(told).encode())
    own.update(_sources(Path(scenes.__file__).parent) if place.kind == "scene" else b"")
    own.update(place.path().read_bytes() if place.kind != "scene" else b"")
    return f"{place.kind}-{place.name}-{own.hexdigest()[:24]}"


@functools.lru_cache(maxsize=1)
def _code() -> str:
    return (_sources(_ALGORITHMS / "filters") + _sources(_ALGORITHMS / "grids")).hex()


@functools.lru_cache(maxsize=4)
def _sources(folder: Path) -> bytes:
    """Return a digest of all the code in a folder."""
    digest = hashlib.sha256()
    for path in sorted(folder.rglob("*.py")):
        digest.update(path.read_bytes())
    return digest.digest()


def measure(jobs: Sequence[Job]) -> Iterator[tuple[Job, dict[str, page.Figures]]]:
    """Yield the figures of each job."""
    for done, (job, found) in enumerate(zip(jobs, work.side_by_side(run, jobs)), start=1):
        if not job.only_kept:
            tell(f"{done} of {len(jobs)}: {job.method}, {job.place.title}")
        yield job, found


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the ablation that the command line asks for."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.ablation",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    names = [*RULES, *GROUPS]
    parser.add_argument("--method", nargs="+", type=method_name, default=list(METHODS))
    parser.add_argument("--quick", action="store_true", help="fewer phases, tiles and scenes")
    parser.add_argument("--rules", nargs="+", choices=names, default=[], metavar="NAME")
    parser.add_argument(
        "--on", nargs="+", choices=page.KINDS, default=page.KINDS, help="some kinds of places"
    )
    parser.add_argument("--kept", action="store_true", help="measure nothing, show what is kept")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write all figures")
    parser.add_argument("--write", action="store_true", help="write docs/rules.md")
    options = parser.parse_args(arguments)
    chosen = variants(options.rules)
    everywhere = [each for each in places(options.quick) if each.kind in options.on]
    results: page.Results = {}
    for method in options.method:
        of_method = {
            name: off
            for name, off in chosen.items()
            if not off or any(RULES[each].serves(method) for each in off)
        }
        jobs = [
            Job(method, each, of_method, each.name == _TIMED, options.kept) for each in everywhere
        ]
        results[method] = {job.place.title: found for job, found in measure(jobs)}
        print("", *page.table(results[method], method), sep="\n", flush=True)
    if options.json:
        options.json.write_text(json.dumps(results, indent=1), "utf-8")
    if options.write:
        page.write(results, options.quick)
        print(f"\nWritten: {page.PAGE}", file=sys.stderr)


if __name__ == "__main__":
    main()
