"""Measures how right a filter is, against labels and against the terrain model made from them.

Every class is set to 0 first, noise is left in, and every filter runs with its defaults.
"""

from __future__ import annotations

import time
from pathlib import Path
from typing import NamedTuple, Protocol, Sequence

import numpy as np

from bare_earth.algorithms.core.parameters import ParameterSet
from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.las.cloud import PointCloud
from bare_earth.algorithms.rasters.geotiff import RasterGrid
from bare_earth.algorithms.tin.dense_surface import DenseSurface
from bare_earth.algorithms.tools.assess import Assessment, AssessmentOptions, compare
from benchmarks.clouds import classify_cloud

from . import data
from .phases import PHASES, Phased, shifted
from .places import Places, counted, places_off
from .work import side_by_side

GROUND = 2


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
        return classify_cloud(cloud, self.parameters)[0] == GROUND


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

    Ours are measured in each phase, peers once, as the points came: most begin their grids at the
    points, so that moving these changes nothing, and they are slow.
    """
    results: Scores = {method.name: {} for method in filters}
    ours = [method for method in filters if isinstance(method, Filter)]
    jobs = [SampleJob(method, path, tuple(phases)) for path in samples for method in ours]
    for job, phased in zip(jobs, side_by_side(assess_phases, jobs)):
        results[job.filter.name][job.path.stem] = phased
    for path in samples:
        for method in filters:
            if method not in ours:
                job = SampleJob(method, path, tuple(phases[:1]))
                results[method.name][path.stem] = assess_phases(job)
    return results


def assess_phases(job: SampleJob) -> Phased:
    """Return the assessment in each phase of a job."""
    cloud, reference = data.load(job.path)
    clouds = (shifted(cloud, *phase) if any(phase) else cloud for phase in job.phases)
    return Phased(tuple(compare(job.filter.ground(moved), reference) for moved in clouds))


def mean(assessments: dict[str, Assessment | Phased], figure: str) -> float:
    """Return the mean of one figure over the samples."""
    return float(np.mean([getattr(assessment, figure) for assessment in assessments.values()]))


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
    bias : float
        Mean difference in metres; positive where the model is too high.
    spikes, pits : Places
        Connected places of 3 cells of 1 m and more where the model is over 1 m off.
    area : float
        Area of the reference in km2.
    """

    rmse: float
    median: float
    percentile_95: float
    bare: float
    bias: float
    spikes: Places
    pits: Places
    area: float

    @property
    def seen(self) -> str:
        """The spikes and pits in words: their numbers, and how far the largest are off."""
        return " / ".join(
            f"{found.count} ({found.largest:.1f} m)" if found.count else "0"
            for found in (self.spikes, self.pits)
        )


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


def interpolated(ground: Points, grid: RasterGrid) -> np.ndarray:
    """Return the heights of ground points at the centres of cells, from north to south."""
    surface = DenseSurface(ground, grid.cell_metres, grid.corner)
    return surface.raster((grid.rows, grid.columns))[::-1]


class ReferenceModel:
    """The terrain model of the reference ground, on a 1 m grid inside its convex hull."""

    def __init__(self, cloud: PointCloud, reference: np.ndarray) -> None:
        ground = cloud.points(reference == GROUND)
        self._cloud = cloud
        self._grid = RasterGrid.over(ground, cloud.frame, 1.0)
        self.heights = interpolated(ground, self._grid)

    @property
    def cell_size(self) -> float:
        """Side of a cell in metres."""
        return self._grid.cell_metres

    def of(self, ground: np.ndarray) -> np.ndarray:
        """Return the terrain model of a ground mask on the same grid."""
        return interpolated(self._cloud.points(ground), self._grid)

    def error(self, ground: np.ndarray) -> DtmError:
        """Return how far the terrain model of a ground mask lies from this one."""
        difference = self.of(ground) - self.heights
        spikes, pits = counted(places_off(difference))
        difference = difference[np.isfinite(self.heights)]
        area = len(difference) * self.cell_size**2 / 1e6
        known = difference[np.isfinite(difference)]
        if not len(known):
            return DtmError(*[float("nan")] * 3, 100.0, float("nan"), spikes, pits, area)
        middle, most = np.percentile(np.abs(known), (50, 95))
        bare = 100.0 * (1.0 - len(known) / len(difference))
        rmse, bias = float(np.sqrt(np.mean(known**2))), float(np.mean(known))
        return DtmError(rmse, float(middle), float(most), bare, bias, spikes, pits, area)

    def centre(self, row: int, column: int) -> tuple[float, float]:
        """Return x and y in metres of the centre of a cell."""
        x, y = self._grid.corner
        south = y + (self._grid.rows - row - 0.5) * self.cell_size
        return x + (column + 0.5) * self.cell_size, south


def score_tile(
    filters: Sequence[GroundFilter], tile: data.RealTile, cloud: PointCloud, reference: np.ndarray
) -> dict[str, TileScore]:
    """Return the score of every filter on a real tile."""
    model = ReferenceModel(cloud, reference)
    options = AssessmentOptions(ignored_classes=tile.left_out)
    results = {}
    for method in filters:
        start = time.perf_counter()
        try:
            ground = method.ground(cloud)
            seconds = time.perf_counter() - start
            assessment = compare(ground, reference, options) if tile.is_trusted else None
            shares = {
                value: 100.0 * float(np.mean(ground[reference == value])) for value in tile.told
            }
            results[method.name] = TileScore(assessment, model.error(ground), shares, seconds)
        except Exception as error:
            # One filter that gives up on a tile must not end the benchmark: it is told.
            problem = f"{type(error).__name__}: {error}".splitlines()[0]
            results[method.name] = TileScore(None, None, {}, time.perf_counter() - start, problem)
    return results
