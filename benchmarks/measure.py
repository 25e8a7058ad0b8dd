"""Measures how right a filter is, against labels and against the terrain model made from them.

Every class is set to 0 first, noise is left in, and every filter runs with its defaults.
"""

from __future__ import annotations

import time
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple, Protocol, Sequence

import numpy as np

from bare_earth.algorithms.assessment import Assessment, AssessmentOptions, compare
from bare_earth.algorithms.classification import classify
from bare_earth.algorithms.errors import BareEarthError
from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.parameters import Declaration, ParameterSet
from bare_earth.algorithms.pointcloud.cloud import PointCloud
from bare_earth.algorithms.pointcloud.selection import Selection
from bare_earth.algorithms.progress import SILENT
from bare_earth.algorithms.terrain.model import interpolate
from bare_earth.algorithms.terrain.raster import RasterGrid

from . import data
from .phases import PHASES, Phased, shifted
from .work import side_by_side

GROUND = 2
FACTORS = (0.5, 2.0)


class GroundFilter(Protocol):
    """What is measured: a filter of ours or a peer."""

    name: str

    def ground(self, cloud: PointCloud) -> np.ndarray:
        """Return the ground mask of a cloud."""


class Filter:
    """A filter of ours as the benchmark runs it; peers look the same from outside."""

    def __init__(self, method: str, **values: object) -> None:
        self.name = method
        self.parameters: ParameterSet = METHODS[method].parameters(**values)

    def ground(self, cloud: PointCloud) -> np.ndarray:
        """Return the ground mask of a cloud."""
        return classify(cloud, self.parameters)[0] == GROUND


# Name of the filter, name of the sample.
Scores = dict[str, dict[str, Phased]]


class SampleJob(NamedTuple):
    """What one process does at a time: one filter on one sample, in all phases."""

    filter: GroundFilter
    path: Path
    phases: tuple[tuple[float, float], ...]


def score(
    filters: Sequence[GroundFilter],
    samples: Sequence[Path],
    phases: Sequence[tuple[float, float]] = PHASES,
) -> Scores:
    """Return the assessments of every filter on every labelled sample.

    Ours are measured in each phase. Peers begin their grids at the points, so that moving these
    changes nothing: they are measured once.
    """
    results: Scores = {each.name: {} for each in filters}
    ours = [each for each in filters if isinstance(each, Filter)]
    jobs = [SampleJob(each, path, tuple(phases)) for path in samples for each in ours]
    for job, phased in zip(jobs, side_by_side(assess_phases, jobs)):
        results[job.filter.name][job.path.stem] = phased
    for path in samples:
        for each in filters:
            if each not in ours:
                job = SampleJob(each, path, tuple(phases[:1]))
                results[each.name][path.stem] = assess_phases(job)
    return results


def assess_phases(job: SampleJob) -> Phased:
    """Return the assessment in each phase of a job."""
    cloud, reference = data.load(job.path)
    clouds = (shifted(cloud, *phase) if any(phase) else cloud for phase in job.phases)
    return Phased(tuple(compare(job.filter.ground(each), reference) for each in clouds))


def mean(assessments: dict[str, Assessment | Phased], figure: str) -> float:
    """Return the mean of one figure over the samples."""
    return float(np.mean([getattr(each, figure) for each in assessments.values()]))


def best(results: Scores) -> str:
    """Return the name of the filter with the least mean total error."""
    return min(results, key=lambda name: mean(results[name], "total_error"))


class DtmError(NamedTuple):
    """How far a terrain model lies from that of the reference ground.

    Attributes
    ----------
    rmse, median, percentile_95 : float
        Of the absolute difference in metres, where both have a height.
    bare : float
        Share in percent of the reference's cells where the model has no height.
    """

    rmse: float
    median: float
    percentile_95: float
    bare: float


class TileScore(NamedTuple):
    """One filter on one real tile.

    Attributes
    ----------
    assessment : Assessment or None
        Against the labels, where they are trusted.
    dtm : DtmError or None
        Of the terrain model.
    shares : dict of int to float
        Share in percent of each class that the tile tells of that is taken for ground.
    seconds : float
        What the filter took; next to nothing if its answer was remembered.
    problem : str
        Why there are no figures.
    """

    assessment: Assessment | None
    dtm: DtmError | None
    shares: dict[int, float]
    seconds: float
    problem: str = ""


class ReferenceModel:
    """The terrain model of the reference ground, on a 1 m grid inside its convex hull."""

    def __init__(self, cloud: PointCloud, reference: np.ndarray) -> None:
        ground = cloud.points(reference == GROUND)
        self._cloud = cloud
        self._grid = RasterGrid.over(ground, cloud.frame, 1.0)
        self.heights = interpolate(ground, self._grid)

    @property
    def cell_size(self) -> float:
        """Side of a cell in metres."""
        return self._grid.cell_metres

    def of(self, ground: np.ndarray) -> np.ndarray:
        """Return the terrain model of a ground mask on the same grid."""
        return interpolate(self._cloud.points(ground), self._grid)

    def error(self, ground: np.ndarray) -> DtmError:
        """Return how far the terrain model of a ground mask lies from this one."""
        difference = np.abs(self.of(ground) - self.heights)[np.isfinite(self.heights)]
        known = difference[np.isfinite(difference)]
        if not len(known):
            return DtmError(*[float("nan")] * 3, 100.0)
        middle, most = np.percentile(known, (50, 95))
        bare = 100.0 * (1.0 - len(known) / len(difference))
        return DtmError(float(np.sqrt(np.mean(known**2))), float(middle), float(most), bare)


def score_tile(
    filters: Sequence[GroundFilter], tile: data.RealTile, cloud: PointCloud, reference: np.ndarray
) -> dict[str, TileScore]:
    """Return the score of every filter on a real tile."""
    model = ReferenceModel(cloud, reference)
    options = AssessmentOptions(ignored_classes=tile.left_out)
    results = {}
    for each in filters:
        start = time.perf_counter()
        try:
            ground = each.ground(cloud)
            seconds = time.perf_counter() - start
            assessment = compare(ground, reference, options) if tile.is_trusted else None
            shares = {
                value: 100.0 * float(np.mean(ground[reference == value])) for value in tile.told
            }
            results[each.name] = TileScore(assessment, model.error(ground), shares, seconds)
        except Exception as error:
            # One filter that gives up on a tile must not end the benchmark: it is told.
            problem = f"{type(error).__name__}: {error}".splitlines()[0]
            results[each.name] = TileScore(None, None, {}, time.perf_counter() - start, problem)
    return results


@dataclass(frozen=True)
class Change:
    """What becomes of the mean errors when one default is multiplied.

    Attributes
    ----------
    values : tuple of str
        The value on each sample, as text; one if it is the same on all.
    is_limited : bool
        Whether the value stopped at the parameter's limit.
    total_error, kappa : float
        Means over the samples; NaN if the filter refuses.
    problem : str
        Why it refuses.
    """

    values: tuple[str, ...]
    is_limited: bool
    total_error: float
    kappa: float
    problem: str = ""


class Sensitivity(NamedTuple):
    """How one parameter matters: its default, then each change."""

    declaration: Declaration
    defaults: tuple[str, ...]
    changes: tuple[Change, ...]


Labelled = Sequence[tuple[PointCloud, np.ndarray, AssessmentOptions]]


def sensitivity(method: str, clouds: Labelled) -> list[Sensitivity]:
    """Return what halving and doubling does, for each parameter that is a number above 0."""
    results = []
    for declaration in METHODS[method].parameters.declarations():
        values = [_default(method, declaration, cloud) for cloud, _, _ in clouds]
        if all(_is_movable(value) for value in values):
            changes = tuple(
                _change(method, declaration, values, factor, clouds) for factor in FACTORS
            )
            defaults = tuple(dict.fromkeys(as_text(value) for value in values))
            results.append(Sensitivity(declaration, defaults, changes))
    return results


def as_text(value: object) -> str:
    """Return a number or a list of numbers in few digits."""
    if isinstance(value, tuple):
        return ", ".join(as_text(each) for each in value)
    return f"{value:g}"


def scaled(declaration: Declaration, value: object, factor: float) -> tuple[object, bool]:
    """Return a number, or a list as a whole, times a factor, and whether a limit cut it."""
    if isinstance(value, tuple):
        parts = [scaled(declaration, each, factor) for each in value]
        return tuple(part[0] for part in parts), any(part[1] for part in parts)
    wanted = value * factor
    least = -np.inf if declaration.minimum is None else declaration.minimum
    most = np.inf if declaration.maximum is None else declaration.maximum
    result = float(np.clip(wanted, least, most))
    is_limited = result != wanted
    if declaration.kind in ("integer", "integers"):
        return round(result), is_limited
    return result, is_limited


def _default(method: str, declaration: Declaration, cloud: PointCloud) -> object:
    """Return the default; where it is chosen from the points, what is chosen for these."""
    parameters = METHODS[method].parameters()
    if getattr(parameters, declaration.name) is None and hasattr(parameters, "resolve"):
        parameters = parameters.resolve(cloud.points(Selection().select(cloud, SILENT)))
    return getattr(parameters, declaration.name)


def _is_movable(value: object) -> bool:
    if isinstance(value, tuple):
        return bool(value) and all(map(_is_movable, value))
    return isinstance(value, (int, float)) and not isinstance(value, bool) and value > 0


def _change(
    method: str, declaration: Declaration, values: Sequence, factor: float, clouds: Labelled
) -> Change:
    moved = [scaled(declaration, value, factor) for value in values]
    texts = tuple(dict.fromkeys(as_text(value) for value, _ in moved))
    is_limited = any(limited for _, limited in moved)
    try:
        assessments = {
            str(number): compare(
                Filter(method, **{declaration.name: value}).ground(cloud), reference, options
            )
            for number, ((value, _), (cloud, reference, options)) in enumerate(zip(moved, clouds))
        }
    except BareEarthError as error:
        return Change(texts, is_limited, float("nan"), float("nan"), str(error))
    figures = (mean(assessments, figure) for figure in ("total_error", "kappa"))
    return Change(texts, is_limited, *figures)
