"""The page of a delivery: a note for those who receive it, as a single HTML file."""

from __future__ import annotations

import os
from datetime import date
from pathlib import Path
from typing import Collection, Iterator, Sequence
from urllib.parse import quote

from ..classes.selection import Selection
from ..core.parameters import ParameterSet, shown_value
from ..core.words import counted
from ..filters import method_of
from ..las.class_names import named_class
from ..report.page import (
    DOUBT,
    Html,
    element,
    link,
    listed,
    map_of,
    maps,
    page,
    paragraph,
    section,
    table,
)
from ..report.units import Units
from ..tools.above_ground.classes import ThenAboveGround
from ..tools.contours import Contours
from ..tools.quality import QualityOptions
from ..tools.quality.figures import FAILED
from ..tools.quality.rasters import QUALITY_RASTERS
from ..tools.rasters.parameters import MapTerrain, SurfaceModel
from ..tools.rasters.rows import RASTERS
from ..tools.water.finding import Water
from ..tools.water_classes import WaterClasses
from .deliveries import WITH_BUILDINGS, Delivery
from .folder import POINTS, QUALITY
from .job import DeliveryJob
from .pictures import picture_of
from .summary import DeliverySummary

_MOST_ROWS = 200
_STYLE = f"""
.maps {{ grid-template-columns: repeat(auto-fill, minmax(380px, 1fr)); }}
.maps figure:first-child {{ grid-column: 1 / -1; }}
{DOUBT}"""
_ABOUT = {
    WITH_BUILDINGS: "The terrain with the buildings on it: the highest point of ground or buildings"
    " in each cell.",
    "contours": "Contour lines; the field ELEV has the height, INDEX is 1 for every fifth line,"
    " DEPRESSION for closed lines round lower land.",
    "water": "Lakes and rivers as polygons, with their level, the spread of their shore and a grade"
    " of certainty. They are flat in the terrain model.",
    "breaklines": "Shores, islands and the middles of rivers, and breaklines that were given; with"
    " heights.",
    "checkpoints": "The checkpoints, with the errors of the ground points and the terrain model.",
    "low_confidence": "Areas in which so few points reach the ground that the terrain model may not"
    " be as accurate as elsewhere.",
    "places": "Places of the terrain model to look at first, those with the largest product of"
    " expected error and area first, with the reason.",
    "review.html": "The expected error of the terrain model, and the ten places to look at first,"
    " with pictures.",
    "quality.html": "Densities, voids, strips and classes of the survey, and the comparison with"
    " the specification.",
    "accuracy.html": "The errors at checkpoints and at ground points that were held out.",
    "checkpoints.csv": "The checkpoints and their errors as a table.",
}


def delivery_html(job: DeliveryJob, root: Path) -> str:
    """Return the page of a delivery; `root` has its files, all but the points of many files."""
    summary, survey, content = job.summary, job.survey, job.content
    units = Units(survey.crs.horizontal_unit, survey.crs.vertical_unit)
    void_distance = job.set_of(QualityOptions).void_distance
    crs = survey.crs.name or "not stated"
    figures = [("CRS", crs), *_figures(summary), *_accuracy(summary, void_distance)]
    parts = [
        # Whoever reads that decks are left out must know by then what that leaves.
        paragraph(summary.water.doubt if summary.water else "", kind="doubt"),
        paragraph(content.about),
        section("In figures", table(figures, is_named=True)),
        *_comparison(summary),
        section("Look at this", listed(_warnings(summary))),
        section("Maps", maps(_pictures(content, summary, units))),
        _files(root, job.files),
        _settings(job),
    ]
    name, others = survey.tiles[0].path.name, len(survey.tiles) - 1
    more = f" and {counted(others, 'more file', 'more files')}" if others else ""
    return page(f"{content.label}: {name}{more}", parts, _STYLE)


def _figures(summary: DeliverySummary) -> Iterator[tuple[str, str]]:
    yield "Points", f"{summary.point_count:,}"
    share = 100.0 * summary.ground_count / max(summary.point_count, 1)
    yield "Ground points", f"{summary.ground_count:,} ({share:.1f} %)"
    for value, count in summary.class_counts.items():
        yield named_class(value).capitalize(), f"{count:,}"
    quality = summary.quality
    if quality is not None:
        yield "Area, without a border of 10 to 20 m", f"{quality.area / 10_000:,.2f} ha"
        densities = {
            "First returns": quality.pulse_density,
            "Ground points": quality.ground_density,
        }
        for name, density in densities.items():
            yield f"{name} in a square metre", "none" if density is None else f"{density:.2f}"
        if summary.layers.get("low_confidence"):
            yield "Low confidence areas", quality.low_confidence_areas or "not measured"
    yield "Cell size of the terrain model", summary.cell_text
    if summary.review is not None:
        yield "Expected error of the terrain, not measured", summary.review.text
    if summary.interval is not None:
        yield "Contour interval", summary.interval.in_words()
    if summary.water is not None:
        yield "Water", summary.water.text


def _accuracy(summary: DeliverySummary, void_distance: float) -> Iterator[tuple[str, str]]:
    check = summary.check
    if check is None or not (check.nva or check.vva):
        yield "Accuracy of the terrain", "Not measured: no checkpoints are given."
    if check is None:
        return
    yield from ((fact.title, fact.text) for fact in check.facts)
    voids = None if summary.quality is None else summary.quality.ground_void_share
    if check.hold_out is not None and voids:
        yield (
            "Interpolated, not measured",
            f"{100.0 * voids:.1f} % of the area is farther than {void_distance:g} m from a ground"
            " point.",
        )


def _comparison(summary: DeliverySummary) -> list[Html]:
    quality = summary.quality
    if quality is None or not quality.comparison:
        return []
    passed = len(quality.comparison) - len(quality.left)
    words = {
        True: "No comparison fails.",
        None: "No comparison fails, but not all could be decided.",
        False: "The survey does not meet it.",
    }[quality.passes]
    count = f"{words} {passed} of {len(quality.comparison)} comparisons pass; "
    rows = [
        (line.name, line.found, line.asked, "fail" if line.state == FAILED else "look at it")
        for line in quality.left
    ]
    said = element("p", Html(count + link("quality.html", "all of them") + "."))
    head = ("What", "Found", "Asked for", "Result")
    return [section("Specification", said, table(rows, head, is_named=True))]


def _warnings(summary: DeliverySummary) -> list[str]:
    left = (f"{Path(path).name} is left out. {why}" for path, why in summary.failures.items())
    return list(dict.fromkeys((*left, *summary.warnings)))[:_MOST_ROWS]


def _pictures(content: Delivery, summary: DeliverySummary, units: Units) -> Iterator[Html]:
    for name in content.pictures:
        picture, legend = picture_of(Path(summary.layers[name]), name, units)
        label = "Terrain with buildings" if name == WITH_BUILDINGS else RASTERS[name].label
        yield map_of(picture, label, legend, units)


def _about(path: Path) -> str:
    """Return what a file holds."""
    if path.stem in RASTERS:
        return RASTERS[path.stem].help
    if path.parent.name == QUALITY and path.stem in QUALITY_RASTERS:
        raster = QUALITY_RASTERS[path.stem]
        return f"{raster.label or raster.title}."
    return _ABOUT.get(path.name, _ABOUT.get(path.stem, ""))


def _files(root: Path, files: Sequence[Path]) -> Html:
    points = sorted(file.name for file in files if file.suffix.lower() in (".las", ".laz"))
    rows = [(f"{POINTS}/{name}", "Classified points.") for name in points[:_MOST_ROWS]]
    names = sorted(file.relative_to(root).as_posix() for file in root.rglob("*") if file.is_file())
    rows += [(name, _about(root / name)) for name in names if not name.startswith(f"{POINTS}/")]
    left = len(points) - _MOST_ROWS
    return section(
        "Files",
        table([(_broken(link(quote(os.fsencode(name)), name)), about) for name, about in rows]),
        paragraph(f"{left:,} more files of points are not listed." if left > 0 else ""),
    )


def _broken(name: str) -> Html:
    """Return the name of a file, which may break anywhere."""
    return element("span", name, "files")


def _settings(job: DeliveryJob) -> Html:
    rows = [
        (title, ", ".join(f"{name} {value}" for name, value in values.items()) or "defaults")
        for title, values in settings_of(job).items()
    ]
    tiles = job.survey.tiles[:_MOST_ROWS]
    rows.append(("Made on", date.today().isoformat()))
    files = [(_broken(tile.path.name), f"{tile.count:,}") for tile in tiles]
    return section(
        "How it was made", table(rows, is_named=True), table(files, ("Input", "Points"), "lr")
    )


def settings_of(job: DeliveryJob) -> dict[str, dict[str, str]]:
    """Return what was asked for or differs from the defaults, by tool and parameter."""
    method, scheme = job.set_of(type(job.method)), job.set_of(ThenAboveGround)
    sets: dict[str, ParameterSet] = {
        method_of(method).label: method,
        "Classes": job.set_of(Selection),
        "Terrain model": job.set_of(MapTerrain),
        "Surface model": job.set_of(SurfaceModel),
    }
    if scheme.wanted:
        sets["Above the ground"] = scheme
    if job.known["find water"]:
        sets["Water"] = job.set_of(Water)
    if job.content.water:
        sets["Classes of water"] = job.set_of(WaterClasses)
    if job.content.contours:
        sets["Contour lines"] = Contours.among(job.sets)
    asked = job.asked()
    return {name: _changed(values, asked) for name, values in sets.items()}


def _changed(given: ParameterSet, asked: Collection[str]) -> dict[str, str]:
    values = {}
    for declared in given.declarations():
        value = getattr(given, declared.name)
        if value != declared.default or declared.name in asked:
            values[declared.name] = setting_in_words(value)
    return values


def setting_in_words(value: object) -> str:
    """Return the value of a parameter as a person reads it."""
    return " ".join(map(_shown, value if isinstance(value, tuple) else (value,)))


def _shown(value: str | float | None) -> str:
    words = {None: "none", True: "on", False: "off"}
    return words[value] if value is None or isinstance(value, bool) else shown_value(value)
