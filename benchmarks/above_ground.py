"""Measures the classes above the ground: buildings of real tiles and scenes, and each constant.

    python -m benchmarks.above_ground            # print the tables
    python -m benchmarks.above_ground --write    # and put them into results/above_ground.md

The constants were chosen with four real tiles, forests and the tuning seeds. What is quoted of the
scenes is measured on the reporting seeds.
"""

from __future__ import annotations

import argparse
import contextlib
from dataclasses import replace
from pathlib import Path
from typing import Any, Iterator, NamedTuple

import numpy as np

from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.filters import DEFAULT_METHOD, METHODS
from bare_earth.algorithms.las.cloud import PointCloud, survey_frame
from bare_earth.algorithms.tin.height_above_ground import height_above_ground
from bare_earth.algorithms.tools.above_ground import buildings
from bare_earth.algorithms.tools.above_ground.classes import AboveGround, classes_above_ground
from benchmarks.clouds import classify_cloud

from . import marked
from .data import read_cloud, real
from .scenes import REPORTING_SEEDS, TUNING_SEEDS, make

PAGE = Path(__file__).parent / "results" / "above_ground.md"
TILES = (
    "ahn3_urban.laz",
    "house_slope.laz",
    "ign_pf8.las",
    "ign_bridge.laz",
    "ign_sparse_urban.laz",
)
FORESTS = ("conifer_1.laz", "conifer_2.laz", "megaplot.laz", "mixed_conifer.laz")
KINDS = ("village", "hillside_village", "city_blocks", "stepped_city", "car_park", "greenhouses")
# Classes that stand neither on the ground nor for it.
_LEFT_OUT = (7, 9, 17, 18, 26, 65, 66, 67)
_NAMES = {3: "low", 4: "medium", 5: "high vegetation", 6: "building"}
# The constants of the search for buildings, and other values of them.
_CONSTANTS: dict[str, tuple[Any, ...]] = {
    "height": (1.5, 2.5), "area": (5.0, 20.0), "width": (1.0, 3.0), "tolerance": (0.1, 0.2),
    "steepest": (45.0, 75.0), "_NODE": (0.35, 0.7), "_NEIGHBOURS": (9, 16), "_REACH": (1.75, 3.5),
    "_LEAST_NODES": (4, 7), "_MOST_SEVERAL": (0.3, 0.7), "_LEAD": (0.0, 0.2),
    "_LEAST_EVIDENCE": (0.0, 0.2), "_RETURNS": (0.4, 1.0), "_LEAVES": (0.5, 0.7),
    "_DEPTH": (1.0, 2.0), "_BEND": (10.0, 20.0), "_JOIN": (2.5, 10.0), "_VOTES": (1, 4),
    "_ON": (0.2, 0.5), "_BESIDE": (0.5, 1.5), "_ABOVE": (1.5, 4.0), "_LEAST_WALL": (0.2, 1.0),
    "_CLOSING": (1.0, 2.0),
}  # fmt: skip


class Sample(NamedTuple):
    """Points, which of them are of pulses with several returns, and their true classes."""

    points: Points
    several: np.ndarray
    classes: np.ndarray

    @classmethod
    def of_file(cls, name: str) -> tuple[Sample, PointCloud]:
        """Return a real tile, in metres from its corner, and its cloud."""
        cloud = read_cloud(real(name))
        frame = survey_frame(cloud.crs)
        units = frame.horizontal_unit, frame.horizontal_unit, frame.vertical_unit
        columns = [
            (np.asarray(column, dtype=float) * scale + offset) * unit
            for column, scale, offset, unit in zip(
                (cloud.x, cloud.y, cloud.z), cloud.scale, cloud.offset, units
            )
        ]
        x, y = (column - np.floor(column.min() / 1000.0) * 1000.0 for column in columns[:2])
        several = cloud.number_of_returns > 1
        return cls(Points(x, y, columns[2]), several, np.asarray(cloud.classification)), cloud

    @classmethod
    def of_scene(cls, kind: str, seed: int) -> Sample:
        """Return a scene."""
        scene = make(kind, seed)
        return cls(scene.points, scene.number_of_returns > 1, scene.classes)

    def thinned(self, share: float) -> Sample:
        """Return a share of the points."""
        which = np.random.default_rng(1).random(self.points.count) < share
        return Sample(self.points.take(which), self.several[which], self.classes[which])

    def with_fewer_told(self, share: float) -> Sample:
        """Return the points of a sensor that tells a share of the pulses with several returns."""
        told = np.random.default_rng(1).random(self.points.count) < share
        return self._replace(several=self.several & told)

    def found(self, ground: np.ndarray | None = None) -> np.ndarray:
        """Return the classes that we find, with the true ground or another; 0 where left out."""
        here = np.flatnonzero(~np.isin(self.classes, _LEFT_OUT))
        ground = self.classes == 2 if ground is None else ground
        classes = np.zeros(self.points.count, dtype=np.uint8)
        some = self.points.take(here), ground[here], self.several[here]
        classes[here] = classes_above_ground(*some, AboveGround("ign"))
        return classes


def intersection(found: np.ndarray, true: np.ndarray) -> float:
    """Return the intersection over union of two masks; NaN if both are empty."""
    union = np.count_nonzero(found | true)
    return np.count_nonzero(found & true) / union if union else np.nan


def of_tiles() -> list[str]:
    """Return a table of each class of the real tiles, with their ground and with ours."""
    rows = ["| Tile | Points a m2 | Ground | " + " | ".join(_NAMES.values()) + " | right | found |"]
    rows.append("|---" * (5 + len(_NAMES)) + "|")
    for name in TILES:
        sample, cloud = Sample.of_file(name)
        blank = replace(cloud, classification=np.ones(cloud.count, dtype=np.uint8))
        ours = classify_cloud(blank, METHODS[DEFAULT_METHOD].parameters())[0] == 2
        for title, ground in (("of the file", sample.classes == 2), ("ours", ours)):
            rows.append(_row(name, title, sample, sample.found(ground)))
    sample, _ = Sample.of_file(TILES[0])
    for share in (0.25, 0.05):
        some = sample.thinned(share)
        rows.append(_row(f"{TILES[0]}, thinned", "of the file", some, some.found()))
    for name in TILES[:2]:
        sample, _ = Sample.of_file(name)
        for title, told in (("a quarter of returns told", 0.25), ("without returns", 0.0)):
            some = sample.with_fewer_told(told)
            rows.append(_row(f"{name}, {title}", "of the file", some, some.found()))
    return rows


def _row(name: str, ground: str, sample: Sample, found: np.ndarray) -> str:
    scores = [intersection(found == value, sample.classes == value) for value in _NAMES]
    scores = [
        score if (sample.classes == value).any() else np.nan for score, value in zip(scores, _NAMES)
    ]
    both = np.count_nonzero((found == 6) & (sample.classes == 6))
    right = both / np.count_nonzero(found == 6), both / np.count_nonzero(sample.classes == 6)
    cells = np.unique(np.floor(np.array(sample.points[:2]) / 10.0), axis=1).shape[1]
    density = sample.points.count / (100.0 * cells)
    shown = ["-" if np.isnan(score) else f"{score:.3f}" for score in (*scores, *right)]
    return f"| {name} | {density:.2g} | {ground} | " + " | ".join(shown) + " |"


def of_forests() -> list[str]:
    """Return a table of points of forests that become buildings."""
    rows = [
        "| Forest | Points above 2 m | of them buildings | without return numbers |",
        "|---|---|---|---|",
    ]
    for name in FORESTS:
        sample, _ = Sample.of_file(name)
        high = height_above_ground(sample.points, sample.classes == 2) > 2.0
        blind = sample.with_fewer_told(0.0)
        shares = [np.mean(variant.found()[high] == 6) for variant in (sample, blind)]
        rows.append(f"| {name} | {high.sum():,} | {shares[0]:.2%} | {shares[1]:.2%} |")
    return rows


def of_scenes() -> list[str]:
    """Return a table of the buildings of scenes."""
    rows = ["| Scene | IoU of buildings |", "|---|---|"]
    for kind in KINDS:
        scores = []
        for seed in REPORTING_SEEDS:
            sample = Sample.of_scene(kind, seed)
            scores.append(intersection(sample.found() == 6, sample.classes == 6))
        rows.append(f"| {kind} | {np.mean(scores):.3f} |")
    return rows


class _Case(NamedTuple):
    """What the search for buildings takes, and which points are buildings."""

    arguments: tuple[Any, ...]
    true: np.ndarray
    high: np.ndarray

    @classmethod
    def of(cls, sample: Sample) -> _Case:
        """Return the case of a sample, with its own ground."""
        ground = sample.classes == 2
        heights = height_above_ground(sample.points, ground)
        possible = ~ground & ~np.isin(sample.classes, _LEFT_OUT)
        arguments = sample.points, heights, possible, sample.several
        return cls(arguments, sample.classes == 6, possible & (heights > 2.0))


def of_constants() -> list[str]:
    """Return a table of what other values of the constants change."""
    named = {name: [_Case.of(Sample.of_file(name)[0])] for name in TILES if name != "ign_pf8.las"}
    named["scenes"] = [_Case.of(Sample.of_scene(k, s)) for k in KINDS for s in TUNING_SEEDS]
    forests = [_Case.of(Sample.of_file(name)[0]) for name in FORESTS]
    titles = " | ".join(name.split(".")[0] for name in named)
    rows = [f"| Constant | Value | {titles} | forests |", "|---" * (3 + len(named)) + "|"]

    def scores(rule: buildings.Buildings) -> str:
        shown = []
        for cases in named.values():
            found = [intersection(rule.find(*case.arguments), case.true) for case in cases]
            shown.append(f"{np.mean(found):.3f}")
        false = [np.mean(rule.find(*case.arguments)[case.high]) for case in forests]
        return " | ".join([*shown, f"{max(false):.2%}"])

    rows.append(f"| all as they are | | {scores(buildings.Buildings())} |")
    for name, values in _CONSTANTS.items():
        for value in values:
            with _changed(name, value) as (rule, usual):
                title = f"`{name}` | {value:g} for {usual:g}"
                rows.append(f"| {title} | {scores(rule)} |")
                print(rows[-1], flush=True)
    return rows


@contextlib.contextmanager
def _changed(name: str, value: Any) -> Iterator[tuple[buildings.Buildings, Any]]:
    """Yield a rule with another value of a field or of a constant, and the usual value."""
    if not name.startswith("_"):
        rule = buildings.Buildings()
        yield replace(rule, **{name: value}), getattr(rule, name)
        return
    usual = getattr(buildings, name)
    setattr(buildings, name, value)
    try:
        yield buildings.Buildings(), usual
    finally:
        setattr(buildings, name, usual)


def main() -> None:
    """Print the tables, and write them into the page if that is asked."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    tables = {
        "tiles": of_tiles(), "forests": of_forests(), "scenes": of_scenes(),
        "constants": of_constants(),
    }  # fmt: skip
    for name, rows in tables.items():
        print(*rows, sep="\n", end="\n\n")
        if options.write:
            marked.fill(PAGE, name, rows)


if __name__ == "__main__":
    main()
