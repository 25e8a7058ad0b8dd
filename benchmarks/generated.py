"""Measures how right a filter is on generated scenes, against their truth."""

from __future__ import annotations

import functools
import hashlib
import time
from pathlib import Path
from typing import NamedTuple, Sequence

import numpy as np

from bare_earth.algorithms.core.errors import BareEarthError
from bare_earth.algorithms.core.points import Frame, Points
from bare_earth.algorithms.rasters.geotiff import RasterGrid
from bare_earth.algorithms.tin.dense_surface import DenseSurface

from . import cache, scenes
from .measure import Filter, interpolated
from .scenes import KINDS, Scene, make
from .scenes.classes import LOW_VEGETATION, WATER
from .scenes.scene import SCALE
from .work import side_by_side

# Cells where even the true ground does not tell the terrain, by this many metres, do not count.
_KNOWN = 0.5
_WRONG = 1.0


class SceneScore(NamedTuple):
    """One filter on one scene.

    Attributes
    ----------
    type_1, type_2 : float
        Share in percent of the ground that was missed, and of the rest that was kept.
    type_2_high : float
        The same without plants up to half a metre (class 3).
    dtm_rmse : float
        Of the terrain model against the true terrain, in metres.
    share_wrong_1m : float
        Share in percent of the cells that are wrong by more than 1 m, or without a height.
    kept : dict of int to float
        Share in percent of each class other than ground that was kept.
    seconds : float
        What the filter took.
    """

    type_1: float
    type_2: float
    type_2_high: float
    dtm_rmse: float
    share_wrong_1m: float
    kept: dict[int, float]
    seconds: float = 0.0


class TrueModel(NamedTuple):
    """The true terrain of a scene on a 1 m grid.

    Attributes
    ----------
    heights : numpy.ndarray of float, shape (rows, columns)
        The terrain at the centres of the cells.
    counts : numpy.ndarray of bool, shape (rows, columns)
        Cells in the hull of the ground where its TIN is right within half a metre.
    """

    heights: np.ndarray
    counts: np.ndarray

    @classmethod
    def of(cls, scene: Scene) -> TrueModel:
        grid = _grid(scene)
        x, y = np.meshgrid(grid.x, grid.y)
        heights = scene.terrain(x.ravel(), y.ravel()).reshape(x.shape)
        # Outside the hull of the ground it is NaN, which no comparison holds for.
        told = _interpolated(scene.points.take(scene.ground), grid)
        return cls(heights, np.abs(told - heights) < _KNOWN)

    def error(self, scene: Scene, ground: np.ndarray) -> np.ndarray:
        """Return the model of a ground mask minus the truth; NaN where it has no height."""
        kept = scene.points.take(ground)
        if kept.count < 3:
            return np.full(self.heights.shape, np.nan)
        return _interpolated(kept, _grid(scene)) - self.heights


def _grid(scene: Scene) -> RasterGrid:
    return RasterGrid.over(scene.points.take(scene.ground), Frame(), 1.0)


def _interpolated(ground: Points, grid: RasterGrid) -> np.ndarray:
    """Return the heights of a TIN of about one point in each cell: four take four times as long."""
    vertices = DenseSurface(ground, 2 * grid.cell_metres).vertices
    return interpolated(ground.take(vertices), grid)


def score_scene(
    scene: Scene, ground: np.ndarray, model: TrueModel | None = None, with_dtm: bool = True
) -> SceneScore:
    """Return how right a ground mask is.

    Decks, wires and noise count as other; points on water do not count at all. The terrain model
    is the TIN of the mask on a grid of 1 m; cells count where the TIN of the true ground is right
    within half a metre, so that what no filter can know is not held against one.

    Parameters
    ----------
    scene : Scene
        The points and their truth.
    ground : numpy.ndarray of bool, shape (n,)
        What a filter took for ground.
    model : TrueModel, optional
        That of the scene, if it is known.
    with_dtm : bool
        Without, the figures of the terrain model are NaN and nothing is interpolated.
    """
    counted = scene.classes != WATER
    truth, found = scene.ground[counted], ground[counted]
    rmse = wrong = float("nan")
    if with_dtm:
        model = model or TrueModel.of(scene)
        error = model.error(scene, ground)[model.counts]
        known = error[np.isfinite(error)]
        far = np.count_nonzero(np.abs(known) > _WRONG) + len(error) - len(known)
        wrong = 100.0 * far / max(len(error), 1)
        rmse = float(np.sqrt(np.mean(known**2))) if len(known) else rmse
    others = [int(value) for value in np.unique(scene.classes[~scene.ground])]
    kept = {value: 100.0 * float(np.mean(ground[scene.classes == value])) for value in others}
    high = found[~truth & (scene.classes[counted] != LOW_VEGETATION)]
    shares = (100.0 * float(np.mean(cells)) for cells in (~found[truth], found[~truth], high))
    return SceneScore(*shares, rmse, wrong, kept)


def remembered_scene(kind: str, seed: int) -> tuple[Scene, TrueModel]:
    """Return a scene with its defaults and its true model, from the cache if it was made before."""
    path = cache.FOLDER / "scenes" / f"{kind}-{seed}-{_digest()}.npz"
    if path.exists():
        with np.load(path) as file:
            terrain = KINDS[kind].landscape(seed, KINDS[kind].defaults)[0].terrain
            scene = Scene(
                Points(*(file["xyz"] * SCALE)), file["classes"], file["number"], file["count"],
                kind, seed, KINDS[kind].defaults, tuple(file["corner"].tolist()), terrain,
            )  # fmt: skip
            return scene, TrueModel(file["heights"], file["counts"])
    scene = make(kind, seed)
    model = TrueModel.of(scene)
    path.parent.mkdir(parents=True, exist_ok=True)
    xyz = np.rint(np.array(scene.points) / SCALE).astype(np.int32)
    np.savez(
        path, xyz=xyz, classes=scene.classes, number=scene.return_number,
        count=scene.number_of_returns, corner=scene.corner, **model._asdict(),
    )  # fmt: skip
    return scene, model


@functools.lru_cache(maxsize=1)
def _digest() -> str:
    """Return what changes when the code that makes scenes changes."""
    digest = hashlib.sha256()
    for path in sorted(Path(scenes.__file__).parent.glob("*.py")):
        digest.update(path.read_bytes())
    return digest.hexdigest()[:12]


class SceneJob(NamedTuple):
    """What one process does at a time: some filters on one scene."""

    kind: str
    seed: int
    filters: tuple[Filter, ...]
    with_dtm: bool = True


# Name of the filter, then kind, then one score for each seed.
SceneScores = dict[str, dict[str, list[SceneScore]]]


def score_scenes(
    filters: Sequence[Filter],
    seeds: Sequence[int],
    kinds: Sequence[str] = tuple(KINDS),
    with_dtm: bool = True,
) -> SceneScores:
    """Return the scores of filters of ours on the scenes of some kinds and seeds."""
    jobs = [SceneJob(kind, seed, tuple(filters), with_dtm) for kind in kinds for seed in seeds]
    results: SceneScores = {method.name: {kind: [] for kind in kinds} for method in filters}
    for job, scores in zip(jobs, side_by_side(run, jobs)):
        for name, score in scores.items():
            results[name][job.kind].append(score)
    return results


def run(job: SceneJob) -> dict[str, SceneScore]:
    """Make a scene and return the score of each filter."""
    scene, model = remembered_scene(job.kind, job.seed)
    cloud = scene.cloud()
    scores = {}
    for method in job.filters:
        start = time.perf_counter()
        try:
            ground = method.ground(cloud)
        except BareEarthError:  # without any ground all of it is missed
            ground = np.zeros(cloud.count, dtype=bool)
        seconds = time.perf_counter() - start
        scores[method.name] = score_scene(scene, ground, model, job.with_dtm)
        scores[method.name] = scores[method.name]._replace(seconds=seconds)
    return scores


def worst_kinds(scores: dict[str, list[SceneScore]]) -> list[str]:
    """Return the kinds from the best to the worst, by type I and type II error together."""
    return sorted(
        scores, key=lambda kind: mean(scores[kind], "type_1") + mean(scores[kind], "type_2")
    )


def mean(scores: Sequence[SceneScore], figure: str) -> float:
    """Return the mean of one figure over the seeds; scenes without that figure do not count."""
    values = np.array([getattr(score, figure) for score in scores])
    return (
        float(np.mean(values[np.isfinite(values)])) if np.isfinite(values).any() else float("nan")
    )
