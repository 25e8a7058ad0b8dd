"""The report of an assessment: a single HTML page."""

from __future__ import annotations

from pathlib import Path

from ..core.files import replacing
from ..core.points import Points
from ..core.progress import SILENT, Progress
from ..las.class_names import CLASSES
from .comparison import Assessment, AssessmentOptions, Comparison
from .page import Units, key, map_figure, page_html, percent, text
from .pictures import LONGEST_SIDE, Picture, Relief

# These colours differ for colour-blind people and in print.
TYPE_1, TYPE_2 = "#d1157f", "#f07f09"

_STYLE = """
td.right { background: #e6f2e6; } td.wrong { background: #fbe6ee; }
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
    """Write the report of an assessment, of the classified file and the reference, as .html."""
    picture = draw_errors(points, comparison, progress.part(0.0, 0.7))
    text = report_html(assessment, picture, options, files, units)
    progress(0.95)
    with replacing(target) as temporary:
        temporary.write_text(text, encoding="utf-8")


def draw_errors(points: Points, comparison: Comparison, progress: Progress = SILENT) -> Picture:
    """Return a map of the errors on the relief of the highest points; see `write_report`."""
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
    """Return the page of the report; see `write_report`."""
    classified, reference = map(text, files)
    body = f"""<p class="files">Classified: {classified}<br>Reference: {reference}</p>
<dl>{_figures(assessment)}</dl>
<p>Type I error: the share of the reference's ground that was rejected. Type II error: the share of
all other points that was accepted as ground. Kappa: the agreement beyond what chance alone gives.
Ground of the reference: {_list(options.ground_classes)}.
Left out: {_list(options.ignored_classes or ())}.{_alone(assessment)}</p>
<h2>Where the errors are</h2>
{_map(picture, units)}
<h2>Confusion</h2>
{_confusion(assessment)}
<h2>Classes of the reference</h2>
{_classes(assessment, options)}"""
    return page_html(f"Assessment of {files[0].name}", body, _STYLE)


def _figures(assessment: Assessment) -> str:
    figures = {
        "Type I error": percent(assessment.type_1_error),
        "Type II error": percent(assessment.type_2_error),
        "Total error": percent(assessment.total_error),
        "Kappa": percent(assessment.kappa),
        "Points": f"{assessment.point_count:,}",
    }
    return "".join(f"<div><dt>{name}</dt><dd>{value}</dd></div>" for name, value in figures.items())


def _alone(assessment: Assessment) -> str:
    """Return a sentence on points that only one of the files has, if there are any."""
    classified, reference = assessment.classified_only, assessment.reference_only
    if not classified and not reference:
        return ""
    return (
        f" Only points that both files have are compared: {classified:,} points of the classified"
        f" file and {reference:,} of the reference have no partner."
    )


def _map(picture: Picture, units: Units) -> str:
    rows, columns, _ = picture.pixels.shape
    pixel = units.length(float(f"{picture.cell_size:.3g}"))
    return f"""<figure style="max-width: {LONGEST_SIDE * min(columns / rows, 1):.0f}px">
{map_figure(picture, "Map of the errors", units=units)}
</figure>
<p>{key(TYPE_1, "type I: ground that was rejected")}
{key(TYPE_2, "type II: other points that were accepted")}</p>
<p>North is up. Grey is the relief of the highest points. A pixel is {pixel} wide;
it takes the colour of its more frequent error, the stronger the more of its points are
wrong.</p>"""


def _confusion(a: Assessment) -> str:
    ground, other = a.ground_as_ground + a.ground_as_other, a.other_as_ground + a.other_as_other
    return f"""<table>
<tr><th></th><th>Classified as ground</th><th>Classified as other</th><th>All</th>
<th>Wrong</th></tr>
<tr><th class="text">Reference: ground</th><td class="right">{a.ground_as_ground:,}</td>
<td class="wrong">{a.ground_as_other:,}</td><td>{ground:,}</td>
<td>{percent(a.type_1_error)} (type I)</td></tr>
<tr><th class="text">Reference: other</th><td class="wrong">{a.other_as_ground:,}</td>
<td class="right">{a.other_as_other:,}</td><td>{other:,}</td>
<td>{percent(a.type_2_error)} (type II)</td></tr>
<tr><th class="text">All</th><td>{a.ground_as_ground + a.other_as_ground:,}</td>
<td>{a.ground_as_other + a.other_as_other:,}</td><td>{a.point_count:,}</td>
<td>{percent(a.total_error)} (total)</td></tr>
</table>"""


def _classes(assessment: Assessment, options: AssessmentOptions) -> str:
    rows = []
    for value, counts in assessment.classes.items():
        is_ground, points, ground = value in options.ground_classes, *counts.values()
        wrong = points - ground if is_ground else ground
        rows.append(
            f'<tr><td>{value}</td><td class="text">{CLASSES.get(value, "")}</td>'
            f'<td class="text">{"ground" if is_ground else "other"}</td><td>{points:,}</td>'
            f"<td>{ground:,}</td><td>{points - ground:,}</td>"
            f"<td>{percent(100 * wrong / points)}</td></tr>"
        )
    return f"""<table>
<tr><th>Class</th><th class="text">Name</th><th class="text">Counts as</th><th>Points</th>
<th>Classified as ground</th><th>Classified as other</th><th>Wrong</th></tr>
{chr(10).join(rows)}
</table>"""


def _list(classes: tuple[int, ...]) -> str:
    return "class " + ", ".join(str(each) for each in classes) if classes else "nothing"
