"""Fits and measures the confidence: how often the terrain is right where so much is stated.

The weights are fitted on the tuning seeds of the scenes and on half of the ISPRS samples, with the
masks of all three filters; what is quoted is measured on the reporting seeds and on the other half.
Scenes have their true terrain, samples the TIN of their reference ground.
"""

from __future__ import annotations

import argparse
import zlib
from pathlib import Path
from typing import Callable, Iterable, NamedTuple, Sequence

import numpy as np

from bare_earth.algorithms.core.errors import BareEarthError
from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.grids.cells import Cells
from bare_earth.algorithms.grids.confidence import (
    CELL,
    RISE_SHARE,
    TOLERANCE,
    Weights,
    evidence,
    probability,
)
from bare_earth.algorithms.grids.dense_surface import DenseSurface
from bare_earth.algorithms.grids.gradient import steepness
from bare_earth.algorithms.grids.surface import Surface
from bare_earth.algorithms.las.cloud import PointCloud
from bare_earth.algorithms.survey.point_counts import PointCounts
from bare_earth.algorithms.survey.selection import Selection

from . import data
from .generated import remembered_scene
from .measure import GROUND, Filter
from .scenes import KINDS, REPORTING_SEEDS, TUNING_SEEDS
from .work import side_by_side

# Cells that are drawn of each scene or sample.
_CELLS = 3000
# What the samples weigh in the fit, and how often it is bettered.
_SAMPLES_SHARE, _ROUNDS = 0.25, 12
# What keeps a weight small that nothing speaks for.
_RIDGE = 1e-4
BINS = (0.0, 0.3, 0.5, 0.7, 0.8, 0.85, 0.9, 0.95, 0.98, 1.0)

Terrain = Callable[[np.ndarray, np.ndarray], np.ndarray]


class Place(NamedTuple):
    """A scene, by kind and seed, or a sample, by its path."""

    kind: str = ""
    seed: int = 0
    path: Path | None = None


class Seen(NamedTuple):
    """What one filter made of a scene or a sample, at cells drawn of it.

    Attributes
    ----------
    method : str
        The filter.
    is_sample : bool
        Whether it is a sample.
    evidence : numpy.ndarray of float, shape (n, 5)
        In the order of `Evidence`.
    right : numpy.ndarray of bool, shape (n,)
        Whether the terrain is.
    """

    method: str
    is_sample: bool
    evidence: np.ndarray
    right: np.ndarray


def places(
    seeds: Sequence[int], samples: Iterable[Path], kinds: Iterable[str] = KINDS
) -> list[Place]:
    """Return the scenes of some kinds and seeds, and samples."""
    scenes = [Place(kind, seed) for kind in kinds for seed in seeds]
    return scenes + [Place(path=path) for path in samples]


def look(place: Place) -> list[Seen]:
    """Run each filter on a scene or a sample, and compare its terrain with the true one."""
    cloud, points, terrain = _load(place)
    seed = zlib.crc32(repr(place[:2]).encode())
    results = []
    for method in METHODS:
        try:
            ground = Filter(method).ground(cloud)
        except BareEarthError:  # no ground, no terrain
            continue
        takes_part = Selection().choose(cloud, PointCounts())
        seen = compared(points.take(takes_part), ground[takes_part], terrain, seed)
        results.append(seen._replace(method=method, is_sample=place.path is not None))
    return results


def compared(points: Points, ground: np.ndarray, terrain: Terrain, seed: int = 0) -> Seen:
    """Compare the terrain of a ground mask with the true one, at cells drawn by a seed.

    Parameters
    ----------
    points : Points
        All that took part.
    ground : numpy.ndarray of bool, shape (n,)
        Which of them are taken for ground.
    terrain : callable
        Returns the true heights at some x and y; NaN where they are not known.
    seed : int
        Draws the cells.
    """
    cells = Cells.over(points, CELL)
    y, x = (
        (first + np.arange(count) + 0.5) * cells.size
        for first, count in zip(cells.first, cells.shape)
    )
    centres = [axis.ravel() for axis in np.meshgrid(x, y)]
    truth = terrain(*centres).reshape(cells.shape)
    allowed = TOLERANCE + RISE_SHARE * CELL * steepness(truth, CELL)
    heights = _tin(points.take(ground))(*centres).reshape(cells.shape)
    known = np.flatnonzero(np.isfinite(heights) & np.isfinite(allowed))
    random = np.random.default_rng(seed)
    drawn = random.choice(known, min(_CELLS, len(known)), replace=False)
    right = (np.abs(heights - truth) <= allowed).ravel()[drawn]
    places = map(np.arange, cells.shape)
    pieces = [piece.ravel()[drawn] for piece in evidence(cells, points.z, ground, *places)]
    return Seen("", False, np.column_stack(pieces), right)


def _load(place: Place) -> tuple[PointCloud, Points, Terrain]:
    if place.path is None:
        scene, _ = remembered_scene(place.kind, place.seed)
        return scene.cloud(), scene.points, scene.terrain
    cloud, reference = data.load(place.path)
    points = cloud.points(np.ones(cloud.count, dtype=bool))
    return cloud, points, _tin(points.take(reference == GROUND))


def _tin(ground: Points) -> Terrain:
    return Surface(ground.take(DenseSurface(ground, CELL).vertices)).heights


def fitted(seen: Sequence[Seen]) -> Weights:
    """Return the weights that make what was seen most likely, in two digits.

    Every scene counts alike, and every sample. Logistic regression by Newton's method.
    """
    samples = sum(sample.is_sample for sample in seen)
    shares = (1.0 - _SAMPLES_SHARE) / max(len(seen) - samples, 1), _SAMPLES_SHARE / max(samples, 1)
    weight = np.concatenate(
        [
            np.full(len(sample.right), shares[sample.is_sample] / len(sample.right))
            for sample in seen
        ]
    )
    pieces = np.concatenate([sample.evidence for sample in seen]).astype(np.float64)
    right = np.concatenate([sample.right for sample in seen])
    spread = pieces.std(axis=0)
    design = np.column_stack([np.ones(len(pieces)), pieces / spread])
    best = np.zeros(design.shape[1])
    for _ in range(_ROUNDS):
        stated = 1.0 / (1.0 + np.exp(-design @ best))
        slope = design.T @ (weight * (right - stated)) - _RIDGE * best
        curve = (design * (weight * stated * (1.0 - stated))[:, None]).T @ design
        best += np.linalg.solve(curve + _RIDGE * np.eye(len(best)), slope)
    best[1:] /= spread
    return Weights(*(float(f"{weight:.2g}") for weight in best))


class Bin(NamedTuple):
    """What came of the cells for which about so much confidence is stated.

    Attributes
    ----------
    share : float
        Share of all cells.
    stated, right : float
        Mean confidence, and share of the cells that are right; NaN without cells.
    """

    share: float
    stated: float
    right: float


def reliability(seen: Sequence[Seen], weights: Weights = Weights()) -> list[Bin]:
    """Return what came of the cells in each of the `BINS`; every scene or sample counts alike."""
    stated = np.concatenate([probability(sample.evidence.T, weights) for sample in seen])
    right = np.concatenate([sample.right for sample in seen])
    weight = np.concatenate(
        [np.full(len(sample.right), 1.0 / len(sample.right)) for sample in seen]
    )
    place = np.clip(np.digitize(stated, BINS) - 1, 0, len(BINS) - 2)
    total, sure, true = (
        np.bincount(place, weights=values, minlength=len(BINS) - 1)
        for values in (weight, weight * stated, weight * right)
    )
    some = np.where(total > 0, total, np.nan)
    return [Bin(*row) for row in zip(total / total.sum(), sure / some, true / some)]


def table(seen: Sequence[Seen], weights: Weights = Weights()) -> str:
    """Return the reliability in Markdown, for each filter on scenes and on samples."""
    groups = [
        (f"{METHODS[method].label}, {name}", [s for s in seen if (s.method, s.is_sample) == key])
        for is_sample, name in ((False, "scenes"), (True, "samples"))
        for method in METHODS
        for key in [(method, is_sample)]
    ]
    groups = [("all", seen), *((name, some) for name, some in groups if some)]
    columns = [reliability(some, weights) for _, some in groups]
    lines = [
        "| Confidence stated | " + " | ".join(name for name, _ in groups) + " |",
        "|---" * (len(groups) + 1) + "|",
    ]
    for low, high, row in zip(BINS, BINS[1:], zip(*columns)):
        cells = [f"{100 * cell.right:.0f} ({100 * cell.share:.1f})" for cell in row]
        lines.append(f"| {100 * low:.0f} to {100 * high:.0f} % | " + " | ".join(cells) + " |")
    return "\n".join(lines).replace("nan (0.0)", "")


def main() -> None:
    """Print the table; with ``--fit`` for weights that are fitted anew, which are printed too."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--fit", action="store_true", help="fit the weights on the tuning half")
    parser.add_argument("--kinds", nargs="+", default=list(KINDS), help="only these scenes")
    parser.add_argument("--seeds", type=int, default=2, help="scenes of each kind, on either side")
    chosen = parser.parse_args()
    samples, weights = data.isprs(), Weights()
    if chosen.fit:
        weights = fitted(_looked(places(TUNING_SEEDS[: chosen.seeds], samples[::2], chosen.kinds)))
        print(weights, flush=True)
    reporting = places(REPORTING_SEEDS[: chosen.seeds], samples[1::2], chosen.kinds)
    print(table(_looked(reporting), weights))


def _looked(where: list[Place]) -> list[Seen]:
    return [sample for some in side_by_side(look, where) for sample in some]


if __name__ == "__main__":
    main()
