"""How well a classification agrees with a reference: type I, type II and total error, kappa."""

from __future__ import annotations

import contextlib
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ..core.errors import BareEarthError
from ..core.files import check_output, replacing
from ..core.parameters import ParameterSet, parameter
from ..core.points import Frame, Points
from ..core.progress import SILENT, Progress
from ..las.cloud import PointCloud
from ..las.reading import read_cloud
from ..rasters.geotiff import NODATA, RasterGrid, check_raster_output, write_geotiff

GROUND = 2


@dataclass(frozen=True)
class AssessmentOptions(ParameterSet):
    """Which classes count as ground, which do not count at all, and how errors are mapped."""

    ground_classes: tuple[int, ...] = parameter(
        (GROUND,),
        label="Ground classes of the reference",
        minimum=0,
        maximum=255,
        help="Classes of the reference that are ground; add 9 where water counts as ground.",
    )
    ignored_classes: tuple[int, ...] | None = parameter(
        None,
        kind="integers",
        label="Ignored classes of the reference",
        minimum=0,
        maximum=255,
        help="Points of these classes of the reference are left out, noise (7, 18) for example.",
    )
    map_cell_size: float = parameter(
        1.0,
        label="Cell size of the error map",
        unit="m",
        minimum=0.01,
        maximum=1000.0,
        advanced=True,
        help="Side of a cell of the raster that tells the share of wrong points. The map in the"
        " report chooses its own.",
    )


class Comparison(NamedTuple):
    """What became of each point.

    Attributes
    ----------
    counted : numpy.ndarray of bool, shape (n,)
        Points that are not left out.
    rejected, accepted : numpy.ndarray of bool, shape (n,)
        The wrong ones of these: ground taken for other (type I), other taken for ground (type II).
    """

    counted: np.ndarray
    rejected: np.ndarray
    accepted: np.ndarray

    @classmethod
    def of(
        cls, ground: np.ndarray, reference: np.ndarray, options: AssessmentOptions
    ) -> Comparison:
        """Compare a ground mask with reference classes of the same points; see `compare`."""
        counted = ~np.isin(reference, options.ignored_classes or ())
        truth = np.isin(reference, options.ground_classes)
        return cls(counted, counted & truth & ~ground, counted & ~truth & ground)


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
    counted, rejected, accepted = Comparison.of(ground, reference, options)
    truth = np.isin(reference, options.ground_classes)
    b, c = int(np.count_nonzero(rejected)), int(np.count_nonzero(accepted))
    a = int(np.count_nonzero(counted & truth)) - b
    d = int(np.count_nonzero(counted & ~truth)) - c
    ground, reference = ground[counted], reference[counted]
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
    report: Path | None = None,
    error_map: Path | None = None,
    progress: Progress = SILENT,
) -> Assessment:
    """Compare two files that hold the same points, in the same order or not.

    Parameters
    ----------
    classified, reference : Path
        The classified cloud, of which class 2 counts as ground, and the reference.
    options : AssessmentOptions
        Which reference classes are ground, and which are left out.
    report : Path, optional
        HTML file to write the figures and a map of the errors to.
    error_map : Path, optional
        GeoTIFF file to write the share of wrong points in each cell to, 0 to 1.
    progress : Progress
        Receives progress and messages.

    Raises
    ------
    BareEarthError
        If a file cannot be read or written, the two do not hold the same points, or a map is wanted
        and the CRS is geographic.
    Cancelled
        If the user asked to stop.
    """
    if report is not None:
        check_output(report, (classified, reference))
        if report.suffix.lower() not in (".html", ".htm"):
            raise BareEarthError(f"Cannot write {report}: the report is HTML, name it .html.")
    if error_map is not None:
        check_raster_output(error_map, (classified, reference))
    result = read_cloud(classified, progress.part(0.0, 0.35))
    truth = read_cloud(reference, progress.part(0.35, 0.7))
    order_result, order_truth = _matching_orders(result, truth)
    progress(0.75)
    ground = result.classification[order_result] == GROUND
    classes = truth.classification[order_truth]
    assessment = compare(ground, classes, options)
    if assessment.point_count == 0:
        raise BareEarthError("All points are of ignored classes: there is nothing to assess.")
    progress(0.8)
    if report is not None or error_map is not None:
        # It knows this module, too.
        from .report import write_report

        points, comparison = result.points(order_result), Comparison.of(ground, classes, options)
        with contextlib.ExitStack() as outputs:  # both or none
            report, error_map = (
                path and outputs.enter_context(replacing(path)) for path in (report, error_map)
            )
            if error_map is not None:
                _write_error_map(error_map, points, comparison, result.frame, options, progress)
            progress(0.9)
            if report is not None:
                files = (classified, reference)
                write_report(report, assessment, comparison, points, options, files)
            progress(1.0)
    return assessment


def _write_error_map(
    target: Path,
    points: Points,
    comparison: Comparison,
    frame: Frame,
    options: AssessmentOptions,
    progress: Progress,
) -> None:
    points, wrong = points.take(comparison.counted), comparison.rejected | comparison.accepted
    grid = RasterGrid.over(points, frame, options.map_cell_size)
    # From the centres of the first cells; a point on the last edge belongs to the last cell.
    column = np.rint((points.x - grid.x[0]) / grid.cell_metres).astype(np.int64)
    row = np.rint((grid.y[0] - points.y) / grid.cell_metres).astype(np.int64)
    place = np.clip(row, 0, grid.rows - 1) * grid.columns + np.clip(column, 0, grid.columns - 1)
    cells = grid.rows * grid.columns
    count = np.bincount(place, minlength=cells)
    errors = np.bincount(place[wrong[comparison.counted]], minlength=cells)
    share = np.where(count > 0, errors / np.maximum(count, 1), NODATA).astype(np.float32)
    write_geotiff(target, share.reshape(grid.rows, grid.columns), grid, NODATA, progress)


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
