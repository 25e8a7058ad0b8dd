"""Writes docs/parameters.md, the table of all parameters, from what tools and filters declare.

tools/environment python tools/parameter_page.py   writes it anew; a test tells when that is to be done
"""  # noqa: E501

from __future__ import annotations

from pathlib import Path
from typing import Iterator, NamedTuple

from bare_earth.algorithms import tools
from bare_earth.algorithms.core.parameters import Declaration, ParameterSet
from bare_earth.algorithms.engine.memory import Resources
from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.tools.listing import COMPOSITIONS, FILE_TOOLS, MAP_TOOLS, POINT_TOOLS

PAGE = Path(__file__).parents[1] / "docs" / "parameters.md"
_UNITS = {"m": " m", "deg": "°", "GB": " GB"}
# The sections of the page, each with the sets that it shows.
_SECTIONS = {
    "TIN densification": ("TinDensification",),
    "Slope filter": ("SlopeFilter",),
    "Grid minimum": ("GridMinimum",),
    "Which points, which classes": ("Selection", "GroundClasses"),
    "Written point clouds": ("PointOutput", "HeightOutput"),
    "Many files": ("TileMethod", "TileInput", "TileOutput"),
    "Above the ground": ("AboveGround", "ThenAboveGround"),
    "Rasters": (
        "TerrainModel", "DeliveryTerrain", "RasterOutput", "SurfaceModel", "CanopyModel", "Gaps",
    ),
    "Contour lines": ("Contours",),
    "Relief": ("FolderKinds", "ReliefPictures"),
    "Water": ("Water", "WaterClasses"),
    "Model key points": ("ModelKeyPoints", "KeyPointMark"),
    "Deliveries": ("DeliveryChoice", "DeliveryOptions", "DeliveryWater"),
    "Remote point clouds": ("Download",),
    "Checkpoints": ("Accuracy", "CheckOptions"),
    "Places to review": ("Review",),
    "Change": ("Comparison", "Places"),
    "Canopy change": ("CanopyChanges",),
    "Quality": ("QualityOptions",),
    "Comparison with a reference": ("AssessmentOptions",),
    "Compare settings": ("TrialOptions",),
    "Remove off-terrain objects": ("OffTerrain",),
    "Threads and memory": ("Resources",),
}  # fmt: skip
_HEAD = """\
# Parameters

All parameters, as dialogs, commands and functions have them. QGIS models and `qgis_process` use the names in capitals. The command line
has them in small letters with hyphens: `MAX_EDGE` is `--max-edge`. Python has them in small letters: `max_edge`. Lengths are metres
and angles degrees, [whatever the unit of the CRS](crs-and-grids.md). Dialogs fold away advanced parameters (*Adv.*).

Inputs and outputs that several tools share:

| | In QGIS | Command |
|---|---|---|
| Points: a layer of the project (its filter is not applied: all points are read), a .las, .laz or .copc.laz file, also where QGIS cannot load it, a [survey](many-files.md#input-and-output) of many files, or a [remote point cloud](fetch.md) | `INPUT`, `INPUT_FOLDER` | first words |
| Points that are written, .las, .laz or .copc.laz; a folder for many files | `OUTPUT` | last word |
| Area: a rectangle, or [polygons](command-line.md#lines-and-polygons); with both, what lies in both | `EXTENT`, `BOUNDARY` | `--extent`, `--boundary` |
| CRS of the points, if files state [none or a wrong one](crs-and-grids.md) | `CRS` | `--crs` |
| [What the terrain must respect](terrain-model.md#what-the-terrain-must-respect) | `BREAKLINES`, `WATER`, `RIVERS`, `NO_GROUND` | `--breaklines`, `--water`, `--rivers`, `--no-ground` |
| [Corrections by hand](classes.md#correct-by-hand), and their attribute with the class | `CORRECTIONS`, `CORRECTIONS_FIELD` | `--corrections` |
| A raster [whose grid is used](crs-and-grids.md#the-grid-of-a-given-raster), and the [extent of rasters](crs-and-grids.md#the-extent-of-rasters) | `LIKE`, `RASTER_EXTENT` | `--like`, `--raster-extent` |
"""  # noqa: E501


class Row(NamedTuple):
    """A parameter as the page shows it; two that are `of` the same label and help are one."""

    name: str
    label: str
    default: str
    help: str
    of: tuple[str, str]


def text() -> str:
    """Return the page."""
    sets = _sets()
    missing = {*sets} - {name for names in _SECTIONS.values() for name in names}
    if missing:
        raise ValueError(f"Name these sets in a section of tools/parameter_page.py: {missing}")
    lines, told = [_HEAD], {}
    for title, names in _SECTIONS.items():
        rows = list(_rows([sets[name] for name in names]))
        new = [row for row in rows if row.of not in told]
        as_before = [row for row in rows if row.of in told]
        lines += [f"## {title}", "", "| Parameter | Default | |", "|---|---|---|"]
        lines += [f"| **{row.label}** `{row.name}` | {row.default} | {row.help} |" for row in new]
        lines += ["", *_told_before(as_before, told)]
        told.update((row.of, title) for row in new)
    return "\n".join(lines).rstrip() + "\n"


def _told_before(rows: list[Row], told: dict[tuple[str, str], str]) -> Iterator[str]:
    """Yield a line that names the parameters which an earlier section has, by this section."""
    for section in dict.fromkeys(told[row.of] for row in rows):
        names = [f"`{row.name}` ({row.default})" for row in rows if told[row.of] == section]
        anchor = section.lower().replace(",", "").replace(" ", "-")
        yield f"And, as under [{section}](#{anchor}): {', '.join(names)}."
        yield ""


def _sets() -> dict[str, type[ParameterSet]]:
    """Return the sets of all tools and filters, by the names of their classes."""
    commands = POINT_TOOLS, MAP_TOOLS, FILE_TOOLS, COMPOSITIONS
    found = {method.parameters for method in METHODS.values()} | {Resources}
    for command in (command for listed in commands for command in listed):
        tool = tools.any_tool(command)
        found.update(tool.sets_of_dialog if tool.identifier else tool.sets)
    return {kind.__name__: kind for kind in found}


def _rows(sets: list[type[ParameterSet]]) -> Iterator[Row]:
    """Yield a row for each parameter; if sets have other defaults of one, it has these too."""
    declared: dict[tuple[str, str], list[Declaration]] = {}
    for one in (one for kind in sets for one in kind.declarations()):
        declared.setdefault((one.name, one.label), []).append(one)
    for (name, label), all_of_it in declared.items():
        first = all_of_it[0]
        defaults = " or ".join(dict.fromkeys(map(default, all_of_it)))
        choices = f" One of {', '.join(f'`{c}`' for c in first.choices)}." if first.choices else ""
        advanced = " *Adv.*" if first.advanced else ""
        told = f"{first.help}{choices}{advanced}".replace("|", "\\|")
        yield Row(name.upper(), label, defaults, told, (label, first.help))


def default(declared: Declaration) -> str:
    """Return the default of a parameter as the page has it."""
    value, unit = declared.default, _UNITS.get(declared.unit, "")
    if value is None:
        return declared.empty
    if isinstance(value, bool):
        return "on" if value else "off"
    if isinstance(value, tuple):
        return ", ".join(map(str, value)) + unit
    return f"{value:g}{unit}" if isinstance(value, (int, float)) else str(value)


if __name__ == "__main__":
    PAGE.write_text(text(), encoding="utf-8")
