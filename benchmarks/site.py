"""Measures presets on sites where earth is moved: `python -m benchmarks.site`.

For each scene, it prints the type I, type II and total error in percent, and the shares of the
points of stockpiles, berms and faces that are lost, and of machines, containers and plants that
are kept. All are means over the seeds.
"""

from __future__ import annotations

import argparse
from typing import NamedTuple, Sequence

import numpy as np

from bare_earth.algorithms.filters import METHODS

from .generated import remembered_scene
from .measure import Filter
from .scenes import KINDS, REPORTING_SEEDS, TUNING_SEEDS
from .scenes.classes import BUILDING, LOW_NOISE, OTHER
from .scenes.earthworks import LANDFORMS
from .work import side_by_side

SCENES = ("earthworks", "earthworks_images")
SEEDS = {"tuning": TUNING_SEEDS, "reporting": REPORTING_SEEDS}
_KEPT = {OTHER: "machines", BUILDING: "containers", 3: "low plants", LOW_NOISE: "low noise"}
_COLUMNS = (
    "type I", "type II", "total", *(f"{name} lost" for name in LANDFORMS.values()),
    *(f"{name} kept" for name in _KEPT.values()),
)  # fmt: skip


class Job(NamedTuple):
    """One filter on one scene."""

    kind: str
    seed: int
    method: str
    values: tuple[tuple[str, object], ...]


def figures(job: Job) -> np.ndarray:
    """Return the figures of the columns in percent; NaN for what a scene has not."""
    scene, _ = remembered_scene(job.kind, job.seed)
    found = Filter(job.method, **dict(job.values)).ground(scene.cloud())
    land = KINDS[job.kind].landscape(job.seed, scene.settings)[0]
    x, y, _ = scene.points
    form = land.landform(x - scene.corner[0], y - scene.corner[1])
    truth = scene.ground
    wanted = [~found[truth], found[~truth], found != truth]
    wanted += [~found[truth & (form == number)] for number in LANDFORMS]
    wanted += [found[scene.classes == code] for code in _KEPT]
    return np.array([100.0 * wrong.mean() if len(wrong) else np.nan for wrong in wanted])


def table(kind: str, seeds: Sequence[int], method: str, settings: Sequence[dict]) -> list[str]:
    """Return a line for each setting of a method: the means over the seeds."""
    jobs = [Job(kind, seed, method, tuple(some.items())) for some in settings for seed in seeds]
    found = np.array(list(side_by_side(figures, jobs))).reshape(len(settings), len(seeds), -1)
    lines = []
    for some, values in zip(settings, found):
        name = ", ".join(str(value) for value in some.values())
        means = " | ".join(f"{value:.2f}" for value in values.mean(axis=0))
        lines.append(f"| {name} | {means} |")
    return lines


def main(arguments: Sequence[str] | None = None) -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.site", description=__doc__)
    parser.add_argument("--method", nargs="+", choices=list(METHODS), default=list(METHODS))
    parser.add_argument("--seeds", choices=list(SEEDS), default="tuning")
    parser.add_argument("--scenes", nargs="+", choices=SCENES, default=list(SCENES))
    parser.add_argument("--presets", nargs="+", help="by default, all")
    options = parser.parse_args(arguments)
    for kind in options.scenes:
        for method in options.method:
            declared = METHODS[method].parameters.declarations()
            offered = next(field.choices for field in declared if field.name == "preset")
            settings = [{"preset": preset} for preset in options.presets or offered]
            print(f"\n{kind}, {method}, {options.seeds} seeds\n")
            print("| Preset | " + " | ".join(_COLUMNS) + " |")
            print("|---" * (len(_COLUMNS) + 1) + "|")
            print("\n".join(table(kind, SEEDS[options.seeds], method, settings)), flush=True)


if __name__ == "__main__":
    main()
