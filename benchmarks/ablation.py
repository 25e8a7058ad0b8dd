"""Measures what each rule of the filters is worth: `python -m benchmarks.ablation`.

Each rule is left out of its pipeline, alone and in groups (`benchmarks/rules.py`), on the ISPRS
samples in some phases of the grid, on the real tiles, and on generated scenes of seeds that nobody
tuned with. On real tiles whose labels are trusted the labels count, on others the terrain model.

What has been measured is kept in ~/.cache/bare-earth/benchmarks (or $BARE_EARTH_CACHE) until a
filter, a grid or the data change, so that a run that was stopped goes on where it stopped.
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
from typing import NamedTuple, Sequence

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
from .rules import BASE, GROUPS, VALUES, switched_off, variants
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
    which : tuple of float
        The phase of a sample; seed and share of the density of a scene.
    """

    kind: str
    name: str
    which: tuple[float, ...] = ()

    @property
    def title(self) -> str:
        """All of it as text."""
        return " ".join([self.kind, self.name, *(f"{value:g}" for value in self.which)])

    def path(self) -> Path:
        """Return the file of a sample or a tile."""
        if self.kind == "isprs":
            return data.FOLDER / "isprs" / f"{self.name}.laz"
        return data.real(self.tile().name)

    def tile(self) -> data.RealTile:
        """Return what is known of a real tile."""
        return next(tile for tile in data.REAL if tile.title == self.name)

    def scene(self) -> Scene:
        """Return a generated scene."""
        seed, share = self.which
        return make(self.name, int(seed), density=share * KINDS[self.name].defaults.density)


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
        found += [Place("scene", kind, which) for which in both[: 1 if is_quick else 2]]
    return found


class Job(NamedTuple):
    """What one process does at a time: all variants of a method at one place."""

    method: str
    place: Place
    variants: tuple[str, ...]
    only_kept: bool = False

    @property
    def is_timed(self) -> bool:
        """Whether time is measured here."""
        return self.place.name == _TIMED


def run(job: Job) -> dict[str, page.Figures]:
    """Return the figures of the variants, and keep each as soon as it is known."""
    path = cache.FOLDER / "ablation" / f"{_digest(job)}.json"
    kept = json.loads(path.read_text("utf-8")) if path.exists() else {}
    keys = {name: repr(GROUPS.get(name) or VALUES.get(name) or name) for name in job.variants}
    todo = [name for name, key in keys.items() if key not in kept]
    if todo and not job.only_kept:
        scorer = _Scorer(job)
        for name in todo:
            kept[keys[name]] = scorer.figures(name)
            path.parent.mkdir(parents=True, exist_ok=True)
            part = path.with_suffix(f".{os.getpid()}")
            part.write_text(json.dumps(kept), "utf-8")
            part.replace(path)
    return {name: kept[key] for name, key in keys.items() if key in kept}


class _Scorer:
    """Measures variants at one place."""

    def __init__(self, job: Job) -> None:
        self._filter, self._place, self._is_timed = Filter(job.method), job.place, job.is_timed
        self._scene, self._model = None, None
        if job.place.kind == "scene":
            self._scene = job.place.scene()
            self._cloud = self._scene.cloud()
        else:
            cloud, self._reference = data.load(job.place.path())
            self._cloud = shifted(cloud, *job.place.which) if job.place.which else cloud
            if job.place.kind == "real" and not job.place.tile().is_trusted:
                self._model = ReferenceModel(self._cloud, self._reference)
        self._ground = self._found(BASE)
        self._base = self._measured(self._ground)

    def figures(self, variant: str) -> page.Figures:
        """Return the figures of a variant; those of the base if it finds the same ground."""
        ground = self._found(variant)
        is_same = np.array_equal(ground, self._ground)
        found = self._base if is_same else self._measured(ground)
        if not self._is_timed:
            return found
        # One after the other, since a machine is not equally fast all the time.
        pairs = [[self._seconds(name) for name in (variant, BASE)] for _ in range(_TIMES)]
        cpu, cpu_base = map(min, zip(*pairs))
        return {**found, "cpu": cpu, "cpu_base": cpu_base}

    def _found(self, variant: str) -> np.ndarray:
        with switched_off(variant):
            try:
                return self._filter.ground(self._cloud)
            except BareEarthError:  # without any ground all of it is missed
                return np.zeros(self._cloud.count, dtype=bool)

    def _seconds(self, variant: str) -> float:
        start = time.process_time()
        self._found(variant)
        return time.process_time() - start

    def _measured(self, ground: np.ndarray) -> page.Figures:
        if self._scene is not None:
            score = score_scene(self._scene, ground, with_dtm=False)
            return {"type_1": score.type_1, "type_2": score.type_2}
        if self._model is not None:
            difference = self._model.of(ground) - self._model.heights
            known = difference[np.isfinite(difference)]
            return {"rmse": float(np.sqrt(np.mean(known**2))), "bias": float(np.mean(known))}
        left_out = self._place.tile().left_out if self._place.kind == "real" else ()
        found = compare(ground, self._reference, AssessmentOptions(ignored_classes=left_out))
        return {"total": found.total_error}


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


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the ablation that the command line asks for."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.ablation",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--method", nargs="+", type=method_name, default=list(METHODS))
    parser.add_argument("--quick", action="store_true", help="fewer phases, tiles and scenes")
    parser.add_argument("--rules", nargs="+", default=[], metavar="NAME", help="only these")
    parser.add_argument(
        "--on", nargs="+", choices=page.KINDS, default=page.KINDS, help="some kinds of places"
    )
    parser.add_argument("--kept", action="store_true", help="measure nothing, show what is kept")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write all figures")
    parser.add_argument("--write", action="store_true", help="write docs/rules.md")
    options = parser.parse_args(arguments)
    everywhere = [place for place in places(options.quick) if place.kind in options.on]
    results: page.Results = {}
    for method in options.method:
        chosen = tuple(
            name for name in variants(method) if name in (BASE, *(options.rules or [name]))
        )
        jobs = [Job(method, place, chosen, options.kept) for place in everywhere]
        results[method] = {}
        for job, found in zip(jobs, work.side_by_side(run, jobs)):
            results[method][job.place.title] = found
            if not options.kept:
                tell(f"{len(results[method])} of {len(jobs)}: {method}, {job.place.title}")
        print("", METHODS[method].label, *page.table(results[method], method), sep="\n")
    if options.json:
        options.json.write_text(json.dumps(results, indent=1), "utf-8")
    if options.write:
        page.write(results, options.quick)
        print(f"\nWritten: {page.PAGE}", file=sys.stderr)


if __name__ == "__main__":
    main()
