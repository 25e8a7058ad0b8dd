"""Assess a ground classification: compares a classified file with a reference.

Sithole and Vosselman (2004), ISPRS Journal 59, section 3.2: type I error is the share of reference
ground that was rejected, type II error the share of reference non-ground that was accepted, and
total error the share of all points that are wrong. Kappa is that of Cohen (1960).
"""

from __future__ import annotations

from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import Sequence

import numpy as np

from ..classes.point_counts import by_class, count_classes
from ..core.errors import BareEarthError
from ..core.parameters import ParameterSet, parameter
from ..core.points import Frame, Points
from ..core.progress import SILENT, Progress
from ..las.class_names import CLASSES
from ..rasters.geotiff import NODATA, RasterGrid
from ..rasters.scattered import ScatteredCells, write_scattered
from ..report.page import Html, element, keys, lines, map_of, page, paragraph, section, table
from ..report.pictures import LONGEST_SIDE, Picture, Relief
from ..report.units import Units, percent
from ..survey.common_points import match_files
from .declaration import CLOUD, CRS, FileTool, Input, Output

GROUND = 2
# Colours of both errors, which differ for colour-blind people and in print.
TYPE_1 = "#d1157f"
TYPE_2 = "#f07f09"
# In the table of the confusion, the counts on the diagonal are right.
_STYLE = """
.confusion tr:nth-child(2) td:nth-child(2), .confusion tr:nth-child(3) td:nth-child(3) {
  background: #e6f2e6; }
.confusion tr:nth-child(2) td:nth-child(3), .confusion tr:nth-child(3) td:nth-child(2) {
  background: #fbe6ee; }
dl { display: flex; flex-wrap: wrap; gap: 1em; padding: 0; }
dl div { border: 1px solid #bbb; border-radius: 6px; padding: .4em 1em; }
dt { color: #555; } dd { margin: 0; font-size: 1.5em; }
"""


@dataclass(frozen=True)
class AssessmentOptions(ParameterSet):
    """Which classes count as ground, which are ignored, and the cells of the error map."""

    ground_classes: tuple[int, ...] = parameter(
        (GROUND,),
        label="Ground classes of the reference",
        minimum=0,
        maximum=255,
        help="Classes of the reference that are ground. Add 9 if water counts as ground.",
    )
    ignored_classes: tuple[int, ...] | None = parameter(
        None,
        kind="integers",
        label="Ignored classes of the reference",
        minimum=0,
        maximum=255,
        help="Points of these classes of the reference are not counted, for example noise (7, 18)."
        " Empty: all points are counted.",
    )
    map_cell_size: float = parameter(
        1.0,
        label="Cell size of the error map",
        unit="m",
        minimum=0.01,
        maximum=1000.0,
        advanced=True,
        help="Side of a cell of the error map. The map in the report has its own cell size.",
    )


@dataclass(frozen=True)
class Assessment:
    """Agreement of a classification with a reference, in percent; NaN without points to count."""

    point_count: int
    ground_as_ground: int
    ground_as_other: int
    other_as_ground: int
    other_as_other: int
    type_1_error: float
    type_2_error: float
    total_error: float
    kappa: float
    # of each class of the reference, how many points there are, and how many became ground
    classes: dict[int, dict[str, int]] = field(default_factory=dict)
    classified_only: int = 0  # points that only this file has, which are not counted
    reference_only: int = 0  # as classified_only

    def as_dict(self) -> dict[str, object]:
        """Return all figures for JSON; NaN, the only value that differs from itself, is None."""
        return {name: None if value != value else value for name, value in asdict(self).items()}

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
        if self.classified_only or self.reference_only:
            rows.append(
                f"not compared      {self.classified_only:>12,}     points of the classified file"
                f" only, and {self.reference_only:,} of the reference only"
            )
        for value, counts in self.classes.items():
            rows.append(
                f"reference class {value:>3} {counts['points']:>10,}     "
                f"classified as ground {counts['ground']:,}"
            )
        return rows


def compare(
    ground: np.ndarray, reference: np.ndarray, options: AssessmentOptions = AssessmentOptions()
) -> Assessment:
    """Compare a ground mask, bool (n,), with the reference classes of the same points."""
    counted = ~np.isin(reference, options.ignored_classes or ())
    classes = reference.astype(np.uint8, copy=False)
    as_ground, as_other = (count_classes(classes[counted & mask]) for mask in (ground, ~ground))
    truth = np.isin(np.arange(256), options.ground_classes)
    a, b, c, d = (
        int(counts[mask].sum()) for mask in (truth, ~truth) for counts in (as_ground, as_other)
    )
    n = a + b + c + d
    chance = ((a + b) * (a + c) + (c + d) * (b + d)) / n**2 if n else float("nan")
    kappa = (_percent(a + d, n) / 100 - chance) / (1 - chance) if chance != 1 else float("nan")
    return Assessment(
        n, a, b, c, d, _percent(b, a + b), _percent(c, c + d), _percent(b + c, n), 100 * kappa,
        {
            value: {"points": count, "ground": int(as_ground[value])}
            for value, count in by_class(as_ground + as_other).items()
        },
    )  # fmt: skip


def _percent(part: int, whole: int) -> float:
    return 100.0 * part / whole if whole else float("nan")


def assess_files(
    classified: Path,
    reference: Path,
    report: Path | None = None,
    error_map: Path | None = None,
    crs: str | None = None,
    options: AssessmentOptions = AssessmentOptions(),
    progress: Progress = SILENT,
) -> Assessment:
    """Compare the points that two files have in common, in any order; write a page (.html), and a
    GeoTIFF with the share of wrong points in each cell.
    """
    # One file can be a part of the other. Points without a partner are counted, but not compared.
    matched = match_files(classified, reference, progress.part(0.0, 0.64), crs)
    (result, truth), (order, order_truth) = matched.clouds, matched.orders
    ground = result.classification[order] == GROUND
    classes = truth.classification[order_truth]
    only, reference_only = matched.alone
    assessment = compare(ground, classes, options)
    assessment = replace(assessment, classified_only=only, reference_only=reference_only)
    if assessment.point_count == 0:
        raise BareEarthError("All points are of ignored classes: there is nothing to assess.")
    progress(0.67)
    if report is None and error_map is None:
        return assessment
    points, is_ground = result.points(order), np.isin(classes, options.ground_classes)
    progress(0.71)
    counted = ~np.isin(classes, options.ignored_classes or ())
    rejected, accepted = counted & is_ground & ~ground, counted & ~is_ground & ground
    progress(0.75)
    if error_map is not None:
        wrong, compared = (rejected | accepted)[counted], points.take(counted)
        part, size = progress.part(0.75, 0.85), options.map_cell_size
        _write_error_map(error_map, compared, wrong, result.frame, size, part)
    if report is not None:
        relief = Relief.of(points)
        progress(0.92)
        picture = relief.marked(rejected, accepted, (TYPE_1, TYPE_2), counted)
        units = Units(result.crs.horizontal_unit, result.crs.vertical_unit)
        html = _report(assessment, picture, options, (classified, reference), units)
        report.write_text(html, encoding="utf-8")
    return assessment


def _write_error_map(
    target: Path, points: Points, wrong: np.ndarray, frame: Frame, size: float, progress: Progress
) -> None:
    """Write the share of wrong points in cells of a size in metres."""
    grid = RasterGrid.over(points, frame, size)
    progress(0.3)
    # Counted from the centre of the first cell. Points on the last edge go into the last cell.
    column = np.rint((points.x - grid.x[0]) / grid.cell_metres).astype(np.int64)
    row = np.rint((grid.y[0] - points.y) / grid.cell_metres).astype(np.int64)
    place = np.clip(row, 0, grid.rows - 1) * grid.columns + np.clip(column, 0, grid.columns - 1)
    progress(0.6)
    place, number = np.unique(place, return_inverse=True)
    count, errors = (np.bincount(own, minlength=len(place)) for own in (number, number[wrong]))
    cells = ScatteredCells(*np.divmod(place, grid.columns), (errors / count).astype(np.float32))
    write_scattered(target, cells, grid, NODATA, progress, "Share of wrong points, 0 to 1")


def _report(
    assessment: Assessment,
    picture: Picture,
    options: AssessmentOptions,
    files: tuple[Path, Path],
    units: Units,
) -> str:
    """Return the page."""
    found, (classified, reference) = assessment, files
    figures = {
        "Type I error": percent(found.type_1_error), "Type II error": percent(found.type_2_error),
        "Total error": percent(found.total_error), "Kappa": percent(found.kappa),
        "Points": f"{found.point_count:,}",
    }  # fmt: skip
    cards = (
        f"<div>{element('dt', name)}{element('dd', value)}</div>" for name, value in figures.items()
    )
    alone = (
        f"Only points that both files have are compared: {found.classified_only:,} points of the"
        f" classified file and {found.reference_only:,} of the reference have no partner."
    )
    parts = [
        lines(f"Classified: {classified}", f"Reference: {reference}", kind="files"),
        element("dl", Html("".join(cards))),
        paragraph(
            "Type I error: the share of the reference's ground that was rejected.",
            "Type II error: the share of all other points that was accepted as ground.",
            "Kappa: the agreement beyond what chance alone gives.",
            f"Ground of the reference: {_listed(options.ground_classes)}.",
            f"Left out: {_listed(options.ignored_classes or ())}.",
            alone if found.classified_only or found.reference_only else "",
        ),
        section("Where the errors are", *_map(picture, units)),
        section("Confusion", _confusion(found)),
        section("Classes of the reference", _classes(found, options)),
    ]
    return page(f"Assessment of {classified.name}", parts, _STYLE)


def _listed(classes: Sequence[int]) -> str:
    return "class " + ", ".join(map(str, classes)) if classes else "nothing"


def _map(picture: Picture, units: Units) -> tuple[Html, Html, Html]:
    rows, columns, _ = picture.pixels.shape
    width = LONGEST_SIDE * min(columns / rows, 1)
    drawn = map_of(picture, "Map of the errors", units=units, is_captioned=False)
    words = "type I: ground that was rejected", "type II: other points that were accepted"
    return (
        Html(f'<div style="max-width: {width:.0f}px">{drawn}</div>'),
        paragraph(keys((TYPE_1, TYPE_2), words)),
        paragraph(
            "North is up. Grey is the relief of the highest points. A pixel is"
            f" {units.length(float(f'{picture.cell_size:.3g}'))} wide; it takes the colour of its"
            " more frequent error, the stronger the more of its points are wrong."
        ),
    )


def _confusion(a: Assessment) -> Html:
    ground = a.ground_as_ground, a.ground_as_other
    rest = a.other_as_ground, a.other_as_other
    rows = [
        (name, f"{first:,}", f"{second:,}", f"{first + second:,}", f"{percent(wrong)} ({kind})")
        for name, (first, second), wrong, kind in (
            ("Reference: ground", ground, a.type_1_error, "type I"),
            ("Reference: other", rest, a.type_2_error, "type II"),
            ("All", map(sum, zip(ground, rest)), a.total_error, "total"),
        )
    ]
    head = ("", "Classified as ground", "Classified as other", "All", "Wrong")
    return table(rows, head, "lrrrr", is_named=True, kind="confusion")


def _classes(assessment: Assessment, options: AssessmentOptions) -> Html:
    rows = []
    for value, counts in assessment.classes.items():
        is_ground, points, ground = value in options.ground_classes, *counts.values()
        wrong = points - ground if is_ground else ground
        rows.append(
            (
                value, CLASSES.get(value, ""), "ground" if is_ground else "other",
                *(f"{count:,}" for count in (points, ground, points - ground)),
                percent(100 * wrong / points),
            )
        )  # fmt: skip
    head = (
        "Class", "Name", "Counts as", "Points", "Classified as ground", "Classified as other",
        "Wrong",
    )  # fmt: skip
    return table(rows, head, "rllrrrr")


TOOL = FileTool(
    work=assess_files,
    sets=(AssessmentOptions,),
    inputs=(
        Input(
            "classified",
            "cloud",
            help="The point cloud to check. Its class 2 counts as ground, all other classes do"
            " not.",
            label="Classified point cloud",
        ),
        Input(
            "reference",
            "cloud",
            help="The same points with their true classes. One file can hold a part of the points"
            " of the other.",
            label="Reference",
        ),
        CRS,
    ),
    outputs=(
        Output(
            "report",
            "page",
            help="A web page with the figures, and a map of where the errors are.",
            label="Report",
        ),
        Output(
            "error_map",
            "raster",
            help="The share of wrong points in each cell of a raster, 0 to 1.",
            label="Error map",
            by_default=False,
        ),
    ),
    json="",
    command="assess",
    identifier="assess",
    title="Assess a ground classification",
    section="Quality",
    about="Class 2 is ground, and the reference holds the same points, or a part of them. Type I"
    " error: the share of the reference's ground that was rejected. Type II error: the share of all"
    " other points that was accepted as ground. All figures are in percent.",
    page="assess",
    words=(CLOUD, "ground,accuracy,quality,error,validation,kappa,confusion matrix,reference"),
    numbers=(
        ("POINT_COUNT", "Points"),
        ("TYPE_1_ERROR", "Type I error [%]"),
        ("KAPPA", "Kappa [%]"),
        ("TYPE_2_ERROR", "Type II error [%]"),
        ("TOTAL_ERROR", "Total error [%]"),
        ("CLASSIFIED_ONLY", "Classified points only"),
        ("REFERENCE_ONLY", "Reference points only"),
    ),
)
