"""How well a classification agrees with a reference: type I, type II and total error, kappa."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from .errors import BareEarthError
from .parameters import ParameterSet, parameter
from .pointcloud.cloud import PointCloud
from .pointcloud.reading import read_cloud
from .progress import SILENT, Progress

GROUND = 2


@dataclass(frozen=True)
class AssessmentOptions(ParameterSet):
    """Which classes count as ground, and which do not count at all."""

    ground_classes: tuple[int, ...] = parameter(
        (GROUND,),
        label="Ground classes of the reference",
        minimum=0,
        maximum=255,
        help="Classes of the reference that are ground; add 9 where water counts as ground.",
    )
    ignored_classes: tuple[int, ...] = parameter(
        (),
        kind="integers",
        label="Ignored classes of the reference",
        minimum=0,
        maximum=255,
        help="Points of these classes of the reference are left out, noise (7, 18) for example.",
    )


@dataclass(frozen=True)
class Assessment:
    """Agreement of a classification with a reference.

    Type I error is the share of reference ground that was rejected, type II error the share of
    reference non-ground that was accepted, total error the share of all points that is wrong; all
    three in percent. Kappa is Cohen's, in percent. A figure is NaN where it has no points.

    References
    ----------
    Sithole, G., Vosselman, G. (2004): Experimental comparison of filter algorithms for bare-Earth
    extraction from airborne laser scanning point clouds. ISPRS Journal 59, section 3.2.
    Cohen, J. (1960): A coefficient of agreement for nominal scales.
    """

    point_count: int
    ground_as_ground: int
    ground_as_other: int
    other_as_ground: int
    other_as_other: int
    type_1_error: float
    type_2_error: float
    total_error: float
    kappa: float
    classes: dict[int, dict[str, int]] = field(default_factory=dict)

    def as_dict(self) -> dict[str, Any]:
        """Return all figures as plain values; NaN becomes None, as JSON has no NaN."""
        figures = asdict(self)
        return {
            name: None if isinstance(value, float) and np.isnan(value) else value
            for name, value in figures.items()
        }

    def lines(self) -> list[str]:
        """Return the figures as lines of text for a terminal or a log."""
        rows = [
            f"points            {self.point_count:>12,}",
            f"type I error      {self.type_1_error:>12.2f} %   ground taken for other "
            f"({self.ground_as_other:,} of {self.ground_as_ground + self.ground_as_other:,})",
            f"type II error     {self.type_2_error:>12.2f} %   other taken for ground "
            f"({self.other_as_ground:,} of {self.other_as_ground + self.other_as_other:,})",
            f"total error       {self.total_error:>12.2f} %",
            f"kappa             {self.kappa:>12.2f} %",
        ]
        for value, counts in self.classes.items():
            rows.append(
                f"reference class {value:>3} {counts['points']:>10,}     "
                f"classified as ground {counts['ground']:,}"
            )
        return rows


def compare(
    ground: np.ndarray, reference: np.ndarray, options: AssessmentOptions = AssessmentOptions()
) -> Assessment:
    """Compare a ground mask with reference classes of the same points.

    Parameters
    ----------
    ground : numpy.ndarray of bool, shape (n,)
        Which points were classified as ground.
    reference : numpy.ndarray of int, shape (n,)
        Reference class of each point.
    options : AssessmentOptions
        Which reference classes are ground, and which are left out.

    Returns
    -------
    Assessment

    Examples
    --------
    >>> compare(np.array([True, False]), np.array([2, 1])).total_error
    0.0
    """
    counted = ~np.isin(reference, options.ignored_classes)
    ground, reference = ground[counted], reference[counted]
    truth = np.isin(reference, options.ground_classes)
    a = int(np.count_nonzero(truth & ground))
    b = int(np.count_nonzero(truth & ~ground))
    c = int(np.count_nonzero(~truth & ground))
    d = int(np.count_nonzero(~truth & ~ground))
    classes = {
        int(value): {
            "points": int(np.count_nonzero(reference == value)),
            "ground": int(np.count_nonzero(ground[reference == value])),
        }
        for value in np.unique(reference)
    }
    n = a + b + c + d
    chance = ((a + b) * (a + c) + (c + d) * (b + d)) / n**2 if n else float("nan")
    agreement = _percent(a + d, n) / 100
    kappa = (agreement - chance) / (1 - chance) * 100 if chance != 1 else float("nan")
    return Assessment(
        point_count=n,
        ground_as_ground=a,
        ground_as_other=b,
        other_as_ground=c,
        other_as_other=d,
        type_1_error=_percent(b, a + b),
        type_2_error=_percent(c, c + d),
        total_error=_percent(b + c, n),
        kappa=kappa,
        classes=classes,
    )


def assess_files(
    classified: Path,
    reference: Path,
    options: AssessmentOptions = AssessmentOptions(),
    progress: Progress = SILENT,
) -> Assessment:
    """Compare two files that hold the same points, in the same order or not.

    Parameters
    ----------
    classified, reference : Path
        The classified cloud, of which class 2 counts as ground, and the reference.
    options : AssessmentOptions
        Which reference classes are ground, and which are left out.

    Raises
    ------
    BareEarthError
        If a file cannot be read, or the two do not hold the same points.
    """
    result = read_cloud(classified, progress.part(0.0, 0.45))
    truth = read_cloud(reference, progress.part(0.45, 0.9))
    order_result, order_truth = _matching_orders(result, truth)
    return compare(
        result.classification[order_result] == GROUND, truth.classification[order_truth], options
    )


def _matching_orders(one: PointCloud, other: PointCloud) -> tuple[np.ndarray | slice, ...]:
    """Return what puts the points of both clouds into the same order.

    Only a .copc.laz output changes the order; there sorting by the integer coordinates (and return
    number, which tells apart most points at one place) finds the partner of each point.
    """
    same = one.count == other.count
    same = same and np.allclose(one.scale, other.scale) and np.allclose(one.offset, other.offset)
    if same and all(np.array_equal(a, b) for a, b in zip(_columns(one), _columns(other))):
        return slice(None), slice(None)
    if same:
        orders = np.lexsort(_columns(one)[::-1]), np.lexsort(_columns(other)[::-1])
        pairs = zip(_columns(one), _columns(other))
        if all(np.array_equal(a[orders[0]], b[orders[1]]) for a, b in pairs):
            return orders
    raise BareEarthError(
        f"{one.path} and {other.path} do not hold the same points "
        f"({one.count:,} and {other.count:,}). Compare a classified file with its own reference."
    )


def _columns(cloud: PointCloud) -> list[np.ndarray]:
    return [cloud.x, cloud.y, cloud.z, cloud.return_number]


def _percent(part: int, whole: int) -> float:
    return 100.0 * part / whole if whole else float("nan")
