"""The page of a delivery: a note for those who receive it, as a single HTML file."""

from __future__ import annotations

from datetime import date
from pathlib import Path
from typing import Iterator
from urllib.parse import quote

from ..core.parameters import ParameterSet, shown_value
from ..filters import method_of
from ..las.class_names import named_class
from ..report.page import (
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
from ..survey.files import Survey
from ..tools.check.accuracy import Figures
from ..tools.quality.figures import FAIL
from ..tools.quality.rasters import QUALITY_RASTERS
from ..tools.rasters.rows import RASTERS
from .deliveries import WITH_BUILDINGS
from .pictures import picture_of
from .request import DeliveryRequest
from .steps import Made

_MOST_ROWS = 200
_NOT_MEASURED = "Not measured: no checkpoints are given."
_STYLE = """
.maps { grid-template-columns: repeat(auto-fill, minmax(380px, 1fr)); }
.maps figure:first-child { grid-column: 1 / -1; }
"""
_ABOUT = {
    WITH_BUILDINGS: "The terrain with the buildings on it: the highest point of ground or buildings"
    " in each cell.",
    "contours": "Contour lines; the field ELEV has the height, INDEX is 1 for every fifth line.",
    "water": "Lakes and rivers as polygons, with their level, the spread of their shore and a grade"
    " of certainty. They are flat in the terrain model.",
    "breaklines": "Shores, islands and the middles of rivers, and breaklines that were given; with"
    " heights.",
    "checkpoints": "The checkpoints, with the errors of the ground points and the terrain model.",
    "quality.html": "Densities, voids, strips and classes of the survey, and the comparison with"
    " the specification.",
    "accuracy.html": "The errors at checkpoints and at ground points that were held out.",
    "checkpoints.csv": "The checkpoints and their errors as a table.",
}


def delivery_html(request: DeliveryRequest, made: Made, survey: Survey, root: Path) -> str:
    """Return the page of a delivery; `root` has its files, all but the points of many files."""
    units = Units(survey.crs.horizontal_unit, survey.crs.vertical_unit)
    content = request.content
    parts = [
        paragraph(content.about),
        section("In figures", table(_figures(request, made, survey, units), is_named=True)),
        *_comparison(made),
        section("Look at this", listed(_warnings(made))),
        section("Maps", maps(_pictures(request, made, units))),
        _files(made, root),
        _settings(request, made, survey),
    ]
    name = survey.tiles[0].path.name
    others = len(survey.tiles) - 1
    more = f" and {others:,} more {'file' if others == 1 else 'files'}" if others else ""
    return page(f"{content.label}: {name}{more}", parts, _STYLE)


def _figures(
    request: DeliveryRequest, made: Made, survey: Survey, units: Units
) -> list[tuple[str, str]]:
    found, rows = made.quality, [("CRS", survey.crs.name or "not stated")]
    rows.append(("Points", f"{made.point_count:,}"))
    share = 100.0 * made.ground_count / max(made.point_count, 1)
    rows.append(("Ground points", f"{made.ground_count:,} ({share:.1f} %)"))
    for value, count in made.class_counts.items():
        rows.append((named_class(value).capitalize(), f"{count:,}"))
    if found is not None:
        rows.append(("Area, without a border of 10 to 20 m", f"{found.area / 10_000:,.2f} ha"))
        densities = (found.pulse_density, found.ground_density)
        for name, density in zip(("First returns", "Ground points"), densities):
            shown = "none" if density is None else f"{density:.2f}"
            rows.append((f"{name} in a square metre", shown))
    rows.append(("Cell size of the terrain model", cell_text(request, made, units)))
    if made.interval is not None:
        rows.append(("Contour interval", made.interval.in_words()))
    if made.water is not None:
        rows.append(("Water", made.water.text))
    return rows + _accuracy(request, made)


def cell_text(request: DeliveryRequest, made: Made, units: Units) -> str:
    """Return the cell size of the terrain model in words."""
    size = request.terrain_with(made.cell_size).cells(units.horizontal).metres
    return units.length(size)


def _accuracy(request: DeliveryRequest, made: Made) -> list[tuple[str, str]]:
    check = made.check
    if check is None:
        return [("Accuracy of the terrain", _NOT_MEASURED)]
    rows: dict[str, Figures | None] = {
        "Checkpoints, without vegetation (NVA)": check.nva,
        "Checkpoints, with vegetation (VVA)": check.vva,
        "Checkpoints, terrain model (NVA)": check.dtm_nva,
    }
    told = [(name, each.text) for name, each in rows.items() if each is not None]
    if not told:
        told.append(("Accuracy of the terrain", _NOT_MEASURED))
    stated = {"Verdict": check.verdict, "Statement": "" if check.doubt else check.statement}
    told += [(name, words) for name, words in stated.items() if words]
    left = check.hold_out
    if left is None:
        return told
    rows = {
        "Ground points held out": left.all, "Held out, open land": left.open,
        "Held out, under trees": left.under_trees, "Held out, steep": left.steep,
    }  # fmt: skip
    told += [(name, each.text) for name, each in rows.items() if each is not None]
    share = None if made.quality is None else made.quality.ground_void_share
    limits = left.limits(share, request.quality.void_distance)
    return [*told, ("What held-out points tell", limits)]


def _comparison(made: Made) -> list[Html]:
    if made.quality is None or not made.quality.lines:
        return []
    lines, failed = made.quality.lines, made.quality.left
    words = {
        True: "No comparison fails.",
        None: "No comparison fails, but not all could be decided.",
        False: "The survey does not meet it.",
    }[made.quality.passes]
    count = f"{words} {len(lines) - len(failed)} of {len(lines)} comparisons pass; "
    rows = [
        (line.name, line.found, line.asked, "fail" if line.state == FAIL else "look at it")
        for line in failed
    ]
    said = element("p", Html(count + link("quality.html", "all of them") + "."))
    head = ("What", "Found", "Asked for", "Result")
    return [section("Specification", said, table(rows, head, is_named=True))]


def _warnings(made: Made) -> list[str]:
    said = [f"{Path(path).name} is left out. {why}" for path, why in made.failures.items()]
    said += [warning for warning in made.warnings if warning not in said]
    return said[:_MOST_ROWS]


def _pictures(request: DeliveryRequest, made: Made, units: Units) -> Iterator[Html]:
    for name in request.content.pictures:
        picture, legend = picture_of(made.layers[name], name, units)
        yield map_of(picture, label_of(name), legend, units)


def label_of(name: str) -> str:
    """Return the label of a layer."""
    labels = {WITH_BUILDINGS: "Terrain with buildings", "contours": "Contour lines"}
    return RASTERS[name].label if name in RASTERS else labels.get(name, name.capitalize())


def _about(path: Path) -> str:
    """Return what a file holds."""
    if path.stem in RASTERS:
        return RASTERS[path.stem].help
    if path.parent.name == "quality" and path.stem in QUALITY_RASTERS:
        raster = QUALITY_RASTERS[path.stem]
        return f"{raster.label or raster.title}."
    return _ABOUT.get(path.name, _ABOUT.get(path.stem, ""))


def _files(made: Made, root: Path) -> Html:
    names = sorted(file.relative_to(root).as_posix() for file in root.rglob("*") if file.is_file())
    rows = [
        (name, _about(root / name))
        for name in names
        if not name.startswith("points/") and name != "index.html"
    ]
    points = sorted(file.name for file in made.files if file.suffix.lower() in (".las", ".laz"))
    rows[:0] = [(f"points/{name}", "Classified points.") for name in points[:_MOST_ROWS]]
    left = len(points) - _MOST_ROWS
    return section(
        "Files",
        table([(_broken(link(quote(name), name)), what) for name, what in rows]),
        paragraph(f"{left:,} more files of points are not listed." if left > 0 else ""),
    )


def _broken(name: str) -> Html:
    """Return the name of a file, which may break anywhere."""
    return element("span", name, "files")


def _settings(request: DeliveryRequest, made: Made, survey: Survey) -> Html:
    rows = [
        (title, ", ".join(f"{name} {value}" for name, value in values.items()) or "defaults")
        for title, values in settings_of(request, made.cell_size).items()
    ]
    rows.append(("Made on", date.today().isoformat()))
    files = [(_broken(tile.path.name), f"{tile.count:,}") for tile in survey.tiles[:_MOST_ROWS]]
    return section(
        "How it was made",
        table(rows, is_named=True),
        table(files, ("Input", "Points"), "lr"),
    )


def settings_of(request: DeliveryRequest, cell_size: float) -> dict[str, dict[str, str]]:
    """Return what differs from the defaults, by the name of the step and of the parameter."""
    how = request.classify
    method = method_of(how.parameters).label
    sets: dict[str, ParameterSet] = {
        method: how.parameters,
        "Classes": how.selection,
        "Terrain model": request.terrain_with(cell_size),
        "Surface model": request.surface_model,
    }
    if how.above_ground.wanted:
        sets["Above the ground"] = how.above_ground
    if request.water_wanted is not None:
        sets["Water"] = request.water_wanted
    if request.water_classes is not None:
        sets["Classes of water"] = request.water_classes
    if request.content.contours:
        sets["Contour lines"] = request.contours
    return {name: _changed(each) for name, each in sets.items()}


def _changed(given: ParameterSet) -> dict[str, str]:
    values = {}
    for each in given.declarations():
        value = getattr(given, each.name)
        if value != each.default:
            many = value if isinstance(value, tuple) else (value,)
            values[each.name] = " ".join(map(_shown, many))
    return values


def _shown(value: object) -> str:
    if value is None or isinstance(value, (bool, str)):
        return {None: "none", True: "on", False: "off"}.get(value, str(value))  # type: ignore
    return shown_value(value)  # type: ignore[arg-type]
