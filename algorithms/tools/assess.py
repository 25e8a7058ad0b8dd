"""Compares a classified file with a reference: figures, a report and a map of the errors."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from ..core.errors import BareEarthError
from ..core.files import Outputs
from ..core.points import Frame, Points
from ..core.progress import SILENT, Progress
from ..rasters.geotiff import NODATA, RasterGrid
from ..rasters.writing import check_raster_output, write_geotiff
from ..report.page import check_page
from ..report.units import Units
from ..survey.common_points import match_files
from .comparison import GROUND, Assessment, AssessmentOptions, Comparison, compare
from .report import write_report


def assess_files(
    classified: Path,
    reference: Path,
    options: AssessmentOptions = AssessmentOptions(),
    report: Path | None = None,
    error_map: Path | None = None,
    progress: Progress = SILENT,
    crs: str | None = None,
) -> Assessment:
    """Compare the points that two files have in common, in any order.

    One file can be a part of the other. Points without a partner are counted, but not compared.

    Parameters
    ----------
    classified, reference : Path
        The classified cloud, with ground in class 2, and the reference.
    options : AssessmentOptions
        Which reference classes are ground, and which are left out.
    report : Path, optional
        HTML file to make, with the figures and a map of the errors.
    error_map : Path, optional
        GeoTIFF file to make, with the share of wrong points in each cell, 0 to 1.
    progress : Progress
        Receives progress and messages.
    crs : str, optional
        The CRS of the points in place of the one that files state: an EPSG code, such as
        "EPSG:25832", or "EPSG:2230+6360" with that of the heights, or well-known text.

    Raises
    ------
    BareEarthError
        If a file cannot be read or written, the files have no points in common, or a map is
        wanted and the CRS is geographic.
    Cancelled
        If the user asked to stop.
    """
    if report is not None:
        check_page(report, (classified, reference))
    if error_map is not None:
        check_raster_output(error_map, (classified, reference))
    matched = match_files(classified, reference, progress.part(0.0, 0.64), crs)
    (result, truth), (order, order_truth) = matched.clouds, matched.orders
    ground = result.classification[order] == GROUND
    classes = truth.classification[order_truth]
    assessment = replace(
        compare(ground, classes, options),
        classified_only=matched.alone[0],
        reference_only=matched.alone[1],
    )
    if assessment.point_count == 0:
        raise BareEarthError("All points are of ignored classes: there is nothing to assess.")
    progress(0.67)
    if report is not None or error_map is not None:
        points = result.points(order)
        progress(0.71)
        comparison = Comparison.of(ground, classes, options)
        progress(0.75)
        with Outputs() as outputs:
            report, error_map = (path and outputs.file(path) for path in (report, error_map))
            if error_map is not None:
                part = progress.part(0.75, 0.85)
                _write_error_map(error_map, points, comparison, result.frame, options, part)
            progress(0.85)
            if report is not None:
                files = (classified, reference)
                part = progress.part(0.85, 1.0)
                units = Units(result.crs.horizontal_unit, result.crs.vertical_unit)
                write_report(report, assessment, comparison, points, options, files, part, units)
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
    counted, wrong = comparison.counted, comparison.rejected | comparison.accepted
    points = points if counted.all() else points.take(counted)
    progress(0.2)
    grid = RasterGrid.over(points, frame, options.map_cell_size)
    progress(0.3)
    # Counted from the centre of the first cell. Points on the last edge go into the last cell.
    column = np.rint((points.x - grid.x[0]) / grid.cell_metres).astype(np.int64)
    progress(0.4)
    row = np.rint((grid.y[0] - points.y) / grid.cell_metres).astype(np.int64)
    place = np.clip(row, 0, grid.rows - 1) * grid.columns + np.clip(column, 0, grid.columns - 1)
    cells = grid.rows * grid.columns
    progress(0.6)
    count = np.bincount(place, minlength=cells)
    progress(0.8)
    errors = np.bincount(place[wrong[counted]], minlength=cells)
    share = np.where(count > 0, errors / np.maximum(count, 1), NODATA).astype(np.float32)
    shares = share.reshape(grid.rows, grid.columns)
    write_geotiff(target, shares, grid, NODATA, progress, "Share of wrong points, 0 to 1")
