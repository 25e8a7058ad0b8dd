"""Judges a change of the filters: `python -m benchmarks.judge`.

The working tree is compared with the last commit, or with another one (`--against main`): on the
tiles of real land that are in the repository, on a few generated scenes, and on the matrix of plain
things, one row of each kind. `--full` takes all rows, and all tiles and samples that are here
(`python -m benchmarks.data fetch`). It prints a table that a pull request can quote. Both are
measured by the benchmarks of the working tree, in one phase of the grid; what was measured is kept
in the cache until the code of the filters, the scenes or the data change.

It returns 1 if the change takes a plain thing that the filters of the commit held.
"""

from __future__ import annotations

import argparse
import hashlib
import io
import json
import os
import subprocess
import sys
import tarfile
import tempfile
import time
from pathlib import Path
from typing import NamedTuple, Sequence

import numpy as np

from bare_earth.algorithms.filters import METHODS

from . import cache, data, generated, plain, scenes, tables, work
from .accuracy import tell
from .measure import Filter, assess_phases, score_tile
from .measure import SampleJob as Sample
from .scenes.plain import rows

_ROOT = Path(__file__).parents[1]
# The code that decides what is ground, and all that is needed to import it.
_DECIDES = tuple(f"algorithms/{room}" for room in ("filters", "grids", "tin", "core"))
_PACKAGE = ("algorithms", "__init__.py", "arrays.py", "metadata.txt")
_SCENES = ("village", "terraces")
_COMMITTED = ("rock_mountain", "campus_terraces", "city_court")
_SEED = 1


class Place(NamedTuple):
    """What is measured at a time, in all methods."""

    kind: str  # tile, sample, scene or plain
    name: str


class Figures(NamedTuple):
    """What a method makes of a place; None for what is not known there."""

    total: float | None = None  # percent
    rmse: float | None = None  # metres, of the terrain model
    off: int | None = None  # spikes and pits of over 1 m
    held: bool | None = None  # of a plain thing
    seconds: float = 0.0  # of processor time


def places(is_full: bool) -> list[Place]:
    """Return where a change is judged."""
    tiles = [tile.title for tile in data.REAL if data.real(tile.name).exists()]
    samples = [path.stem for path in data.isprs()]
    found = [Place("tile", name) for name in tiles if is_full or name in _COMMITTED]
    found += [Place("sample", name) for name in samples if is_full]
    found += [Place("scene", name) for name in _SCENES]
    chosen = {row.kind.name: row.name for row in reversed(rows())}.values()
    return found + [Place("plain", row.name) for row in rows() if is_full or row.name in chosen]


def measured(place: Place) -> dict[str, Figures]:
    """Return what each method makes of a place."""
    found = {}
    for method in METHODS:
        begun = time.process_time()
        figures = _AT[place.kind](place.name, Filter(method))
        found[method] = figures._replace(seconds=time.process_time() - begun)
    return found


def _of_tile(name: str, method: Filter) -> Figures:
    tile = next(tile for tile in data.REAL if tile.title == name)
    score = score_tile([method], tile, *data.load(data.real(tile.name)))[method.name]
    if score.dtm is None:
        raise RuntimeError(f"{name}, {method.name}: {score.problem}")
    total = score.assessment.total_error if score.assessment else None
    return Figures(total, score.dtm.rmse, score.dtm.spikes.count + score.dtm.pits.count)


def _of_sample(name: str, method: Filter) -> Figures:
    path = data.find(f"isprs/{name}.laz")
    return Figures(assess_phases(Sample(method, path, ((0.0, 0.0),))).total_error)


def _of_scene(name: str, method: Filter) -> Figures:
    scene, model = generated.remembered_scene(name, _SEED)
    score = generated.score_scene(scene, method.ground(scene.cloud()), model)
    share = float(np.mean(scene.ground))
    return Figures(share * score.type_1 + (1 - share) * score.type_2, score.dtm_rmse)


def _of_plain(name: str, method: Filter) -> Figures:
    judge = plain.Judge({row.name: row for row in rows()}[name])
    return Figures(held=judge.judged(judge.ground(method)).held)


_AT = {"tile": _of_tile, "sample": _of_sample, "scene": _of_scene, "plain": _of_plain}
# By the title of a place, then by method.
Results = dict[str, dict[str, Figures]]


def results(folder: Path, is_full: bool) -> Results:
    """Return the figures of the package in a folder, from the cache where they are known."""
    wanted = places(is_full)
    path = cache.FOLDER / "judge" / f"{_digest(folder)}.json"
    known = json.loads(path.read_text("utf-8")) if path.exists() else {}
    todo = [place for place in wanted if " ".join(place) not in known]
    if todo:
        path.parent.mkdir(parents=True, exist_ok=True)
        known.update(_in_process(todo, folder))
        path.write_text(json.dumps(known), "utf-8")
    return {
        " ".join(place): {
            method: Figures(*values) for method, values in known[" ".join(place)].items()
        }
        for place in wanted
    }


def _in_process(todo: list[Place], folder: Path) -> Results:
    """Measure in a process that imports the package from a folder."""
    environment = dict(os.environ)
    if folder != _ROOT:
        environment["PYTHONPATH"] = str(folder.parent)
    command = [sys.executable, "-m", "benchmarks.judge", "--measure"]
    with tempfile.TemporaryDirectory(prefix="judge-") as temporary:
        answer = Path(temporary) / "answer.json"
        subprocess.run(
            [*command, str(answer)], input=json.dumps(todo), text=True, check=True, cwd=_ROOT,
            env=environment,
        )  # fmt: skip
        return json.loads(answer.read_text("utf-8"))


def _measure(target: Path) -> None:
    """Measure the places on standard input, and write what came out."""
    todo = [Place(*one) for one in json.load(sys.stdin)]
    found = {}
    for place, figures in zip(todo, work.side_by_side(measured, todo)):
        found[" ".join(place)] = figures
        tell(" ".join(place))
    target.write_text(json.dumps(found), "utf-8")


def _digest(folder: Path) -> str:
    """Return what tells apart the figures of a package: its code, the scenes and this file."""
    digest = hashlib.sha256(Path(__file__).read_bytes())
    own = [folder / name for name in _DECIDES] + [Path(scenes.__file__).parent]
    for path in sorted(path for one in own for path in one.rglob("*.py")):
        digest.update(path.read_bytes())
    return digest.hexdigest()[:24]


def committed(revision: str, folder: Path) -> Path:
    """Write the package of a commit into a folder, and return the folder."""
    try:
        packed = subprocess.run(
            ["git", "-C", str(_ROOT), "archive", revision, *_PACKAGE],
            capture_output=True,
            check=True,
        ).stdout
    except subprocess.CalledProcessError as error:
        raise SystemExit(error.stderr.decode().strip()) from error
    with tarfile.open(fileobj=io.BytesIO(packed)) as archive:
        archive.extractall(folder)
    return folder


def table(before: Results, after: Results) -> list[str]:
    """Return the verdict as a table: each method has a column."""
    titles = (
        ("Plain things held, of {count}", "held", "plain"),
        ("Total error, %, mean of {count} tiles", "total", "tile"),
        ("Total error, %, mean of {count} ISPRS samples", "total", "sample"),
        ("Total error, %, mean of {count} scenes", "total", "scene"),
        ("DTM RMSE, m, mean of {count} tiles", "rmse", "tile"),
        ("DTM RMSE, m, mean of {count} scenes", "rmse", "scene"),
        ("Spikes and pits, {count} tiles", "off", "tile"),
        ("Processor time, s, of {count} places", "seconds", ""),
    )
    lines = []
    for title, figure, kind in titles:
        names = [name for name in after if name.startswith(kind)]
        cells, count = [], 0
        for method in METHODS:
            pair = [
                [getattr(found[name][method], figure) for name in names]
                for found in (before, after)
            ]
            pair = [[value for value in values if value is not None] for values in pair]
            count, digits = len(pair[0]), {"total": 2, "rmse": 3}.get(figure, 0)
            whole = np.mean if digits else np.sum
            cells.append(" -> ".join(f"{whole(values):.{digits}f}" for values in pair if values))
        if count:
            lines.append([title.format(count=count), *cells])
    labels = [METHODS[method].label for method in METHODS]
    return tables.table(("", *labels), lines)


def changes(before: Results, after: Results) -> tuple[list[str], list[str]]:
    """Return the plain things that a change protects, and those that it takes."""
    gained, lost = [], []
    for name, by_method in after.items():
        for method, figures in by_method.items():
            was = before[name][method].held
            if figures.held != was:
                (gained if figures.held else lost).append(f"{name[6:]} ({method})")
    return gained, lost


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the verdict; return 1 if a plain thing is lost."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.judge",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--against", default="HEAD", metavar="COMMIT")
    parser.add_argument("--full", action="store_true", help="all rows, and all data that are here")
    parser.add_argument("--measure", type=Path, help=argparse.SUPPRESS)
    options = parser.parse_args(arguments)
    if options.measure:
        _measure(options.measure)
        return 0
    begun = time.perf_counter()
    with tempfile.TemporaryDirectory(prefix="judge-") as temporary:
        base = committed(options.against, Path(temporary) / "bare_earth")
        if _digest(base) == _digest(_ROOT):
            print(f"The filters are those of {options.against}: there is nothing to judge.")
            return 0
        before, after = results(base, options.full), results(_ROOT, options.full)
    gained, lost = changes(before, after)
    print("", *table(before, after), sep="\n")
    for title, names in (("Protects", gained), ("Takes", lost)):
        print(f"\n{title} {len(names)} plain things" + ":" * bool(names), *names, sep="\n- ")
    print(f"\n{time.perf_counter() - begun:.0f} s", file=sys.stderr)
    return 1 if lost else 0


if __name__ == "__main__":
    raise SystemExit(main())
