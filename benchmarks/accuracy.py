"""Measures how right the filters are: `python -m benchmarks.accuracy`.

Every class is set to 0 first and noise is left in; every filter runs with its defaults. On the
labelled samples each point counts. On tiles whose reference ground is thinned the terrain models
are compared: both TINs on the same 1 m grid, inside the convex hull of the reference.
"""

from __future__ import annotations

import argparse
import time

import numpy as np

from bare_earth.algorithms.assessment import Assessment, AssessmentOptions, compare
from bare_earth.algorithms.classification import classify
from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.parameters import ParameterSet
from bare_earth.algorithms.pointcloud.cloud import PointCloud
from bare_earth.algorithms.terrain.model import interpolate
from bare_earth.algorithms.terrain.raster import RasterGrid

from . import data


class Filter:
    """A filter of ours as the benchmark runs it; peers look the same from outside."""

    def __init__(self, method: str, **values: object) -> None:
        self.name = method
        self.parameters: ParameterSet = METHODS[method].parameters(**values)

    def ground(self, cloud: PointCloud) -> np.ndarray:
        """Return the ground mask of a cloud."""
        return classify(cloud, self.parameters)[0] == 2


def score(filters: list, samples: list) -> dict[str, dict[str, Assessment]]:
    """Return the assessment of every filter on every ISPRS sample."""
    results: dict[str, dict[str, Assessment]] = {each.name: {} for each in filters}
    for path in samples:
        cloud, reference = data.load(path)
        for each in filters:
            results[each.name][path.stem] = compare(each.ground(cloud), reference)
    return results


def mean(assessments: dict[str, Assessment], figure: str) -> float:
    """Return the mean of one figure over the samples."""
    return float(np.mean([getattr(each, figure) for each in assessments.values()]))


def dtm_difference(cloud: PointCloud, ground: np.ndarray, reference: np.ndarray) -> np.ndarray:
    """Return the differences of the two terrain models on a 1 m grid, where both have a height."""
    grid = RasterGrid.over(cloud.points(reference), cloud.frame, 1.0)
    difference = interpolate(cloud.points(ground), grid) - interpolate(
        cloud.points(reference), grid
    )
    return difference[np.isfinite(difference)]


def print_isprs(results: dict[str, dict[str, Assessment]]) -> None:
    """Print total error and kappa, and type I and II errors, per sample and mean."""
    for name, assessments in results.items():
        print(f"\n{name}\n{'sample':10}{'type I':>8}{'type II':>9}{'total':>8}{'kappa':>8}")
        for sample, one in assessments.items():
            print(
                f"{sample:10}{one.type_1_error:8.2f}{one.type_2_error:9.2f}"
                f"{one.total_error:8.2f}{one.kappa:8.2f}"
            )
        figures = ("type_1_error", "type_2_error", "total_error", "kappa")
        values = [mean(assessments, figure) for figure in figures]
        print(f"{'mean':10}{values[0]:8.2f}{values[1]:9.2f}{values[2]:8.2f}{values[3]:8.2f}")


def print_real(filters: list) -> None:
    """Print the total error where labels are trusted, and the terrain model's error everywhere."""
    print(f"\n{'tile':22}{'filter':20}{'total %':>8}{'RMSE m':>8}{'median':>8}{'95 %':>8}{'s':>7}")
    for tile in data.REAL:
        path = data.real(tile.name)
        if not path.exists():
            continue
        cloud, reference = data.load(path)
        for each in filters:
            start = time.perf_counter()
            ground = each.ground(cloud)
            seconds = time.perf_counter() - start
            total = float("nan")
            if tile.ground:
                options = AssessmentOptions(ground_classes=tile.ground)
                total = compare(ground, reference, options).total_error
            difference = np.abs(dtm_difference(cloud, ground, reference == 2))
            rmse = float(np.sqrt(np.mean(difference**2)))
            middle, most = np.percentile(difference, (50, 95))
            print(
                f"{tile.name:22}{each.name:20}{total:8.2f}{rmse:8.3f}{middle:8.3f}{most:8.3f}"
                f"{seconds:7.1f}",
                flush=True,
            )


def sensitivity(method: str, samples: list) -> None:
    """Print how the mean total error moves when each default is halved and doubled."""
    declared = METHODS[method].parameters
    print(f"\n{method}: mean total error when a default is halved and doubled")
    for each in declared.declarations():
        if each.kind not in ("number", "integer") or not each.default:
            continue
        row = f"{each.name:28}{each.default:>8g}"
        for factor in (0.5, 2.0):
            value = min(max(each.default * factor, each.minimum), each.maximum)
            value = int(value) if each.kind == "integer" else value
            results = score([Filter(method, **{each.name: value})], samples)
            row += f"{mean(results[method], 'total_error'):8.2f}"
        print(row, flush=True)


def main() -> None:
    """Run the benchmark that the command line asks for."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.accuracy", description=__doc__)
    parser.add_argument("--method", nargs="*", choices=list(METHODS), default=list(METHODS))
    parser.add_argument("--isprs", action="store_true", help="the ISPRS samples only")
    parser.add_argument("--real", action="store_true", help="the real tiles only")
    parser.add_argument("--sensitivity", action="store_true", help="halve and double each default")
    options = parser.parse_args()
    samples = data.isprs()
    if not samples:
        parser.exit(1, f"There is no labelled data in {data.FOLDER.resolve()}.\n")
    filters = [Filter(name) for name in options.method]
    everything = not (options.isprs or options.real or options.sensitivity)
    if options.isprs or everything:
        print_isprs(score(filters, samples))
    if options.real or everything:
        print_real(filters)
    if options.sensitivity:
        for name in options.method:
            sensitivity(name, samples)


if __name__ == "__main__":
    main()
