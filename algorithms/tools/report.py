"""The report of an assessment: a single HTML page."""

from __future__ import annotations

from pathlib import Path

from ..core.files import replacing
from ..core.points import Points
from ..core.progress import SILENT, Progress
from ..las.class_names import CLASSES
from ..report.page import Html, element, keys, lines, map_of, page, paragraph, section, table
from ..report.pictures import LONGEST_SIDE, Picture, Relief
from ..report.units import Units, percent
from .comparison import Assessment, AssessmentOptions, Comparison

# These colours differ for colour-blind people and in print.
TYPE_1, TYPE_2 = "#d1157f", "#f07f09"

# In the confusion table, the counts on the diagonal are right.
_STYLE = """
.confusion tr:nth-child(2) td:nth-child(2), .confusion tr:nth-child(3) td:nth-child(3) {
  background: #e6f2e6; }
.confusion tr:nth-child(2) td:nth-child(3), .confusion tr:nth-child(3) td:nth-child(2) {
  background: #fbe6ee; }
dl { display: flex; flex-wrap: wrap; gap: 1em; padding: 0; }
dl div { border: 1px solid #bbb; border-radius: 6px; padding: .4em 1em; }
dt { color: #555; } dd { margin: 0; font-size: 1.5em; }
"""


def write_report(
    target: Path,
    assessment: Assessment,
    comparison: Comparison,
    points: Points,
    options: AssessmentOptions,
    files: tuple[Path, Path],
    progress: Progress = SILENT,
    units: Units = Units(),
) -> None:
    """Write the report of an assessment of a classified file and its reference, as .html."""
    picture = draw_errors(points, comparison, progress.part(0.0, 0.7))
    html = report_html(assessment, picture, options, files, units)
    progress(0.95)
    with replacing(target) as temporary:
        temporary.write_text(html, encoding="utf-8")


def draw_errors(points: Points, comparison: Comparison, progress: Progress = SILENT) -> Picture:
    """Return a map of the errors on the relief of the highest points."""
    relief = Relief.of(points)
    progress(0.7)
    marks = comparison.rejected, comparison.accepted
    picture = relief.marked(*marks, (TYPE_1, TYPE_2), comparison.counted)
    progress(1.0)
    return picture


def report_html(
    assessment: Assessment,
    picture: Picture,
    options: AssessmentOptions,
    files: tuple[Path, Path],
    units: Units = Units(),
) -> str:
    """Return the page of the report."""
    classified, reference = files
    parts = [
        lines(f"Classified: {classified}", f"Reference: {reference}", kind="files"),
        _figures(assessment),
        paragraph(
            "Type I error: the share of the reference's ground that was rejected.",
            "Type II error: the share of all other points that was accepted as ground.",
            "Kappa: the agreement beyond what chance alone gives.",
            f"Ground of the reference: {_list(options.ground_classes)}.",
            f"Left out: {_list(options.ignored_classes or ())}.",
            _alone(assessment),
        ),
        section("Where the errors are", *_map(picture, units)),
        section("Confusion", _confusion(assessment)),
        section("Classes of the reference", _classes(assessment, options)),
    ]
    return page(f"Assessment of {classified.name}", parts, _STYLE)


def _figures(assessment: Assessment) -> Html:
    figures = {
        "Type I error": percent(assessment.type_1_error),
        "Type II error": percent(assessment.type_2_error),
        "Total error": percent(assessment.total_error),
        "Kappa": percent(assessment.kappa),
        "Points": f"{assessment.point_count:,}",
    }
    cards = (element("dt", name) + element("dd", value) for name, value in figures.items())
    return element("dl", Html("".join(f"<div>{card}</div>" for card in cards)))


def _alone(assessment: Assessment) -> str:
    """Return a sentence on points that only one of the files has, if there are any."""
    classified, reference = assessment.classified_only, assessment.reference_only
    if not classified and not reference:
        return ""
    return (
        f"Only points that both files have are compared: {classified:,} points of the classified"
        f" file and {reference:,} of the reference have no partner."
    )


def _map(picture: Picture, units: Units) -> tuple[Html, Html, Html]:
    rows, columns, _ = picture.pixels.shape
    pixel = units.length(float(f"{picture.cell_size:.3g}"))
    drawn = map_of(picture, "Map of the errors", units=units, is_captioned=False)
    width = LONGEST_SIDE * min(columns / rows, 1)
    return (
        Html(f'<div style="max-width: {width:.0f}px">{drawn}</div>'),
        paragraph(
            keys(
                (TYPE_1, TYPE_2),
                ("type I: ground that was rejected", "type II: other points that were accepted"),
            )
        ),
        paragraph(
            "North is up. Grey is the relief of the highest points. A pixel is"
            f" {pixel} wide; it takes the colour of its more frequent error, the stronger the more"
            " of its points are wrong."
        ),
    )


def _confusion(a: Assessment) -> Html:
    columns = {
        "Reference: ground": (a.ground_as_ground, a.ground_as_other, a.type_1_error, "type I"),
        "Reference: other": (a.other_as_ground, a.other_as_other, a.type_2_error, "type II"),
        "All": (
            a.ground_as_ground + a.other_as_ground,
            a.ground_as_other + a.other_as_other,
            a.total_error,
            "total",
        ),
    }
    rows = [
        (name, f"{ground:,}", f"{other:,}", f"{ground + other:,}", f"{percent(wrong)} ({kind})")
        for name, (ground, other, wrong, kind) in columns.items()
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


def _list(classes: tuple[int, ...]) -> str:
    return "class " + ", ".join(map(str, classes)) if classes else "nothing"
