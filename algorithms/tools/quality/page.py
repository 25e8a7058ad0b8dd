"""The page about the quality of a survey: a single HTML file."""

from __future__ import annotations

import math
from typing import Iterator

import numpy as np

from ...report.page import Html, element, keys, map_of, maps, page, paragraph, section, table
from ...report.pictures import HEIGHTS, NOWHERE, Picture, ramped, reduced, rgb
from ...report.units import Units
from ...survey.files import Survey
from .cells import QualityCells
from .figures import FAIL, LOOK, PASS, Extent, Quality
from .rasters import LIMITS, QUALITY_RASTERS, rows_of
from .specifications import Specification

# Longest side of a map in pixels, and most rows of the table of files.
_LONGEST, _MOST_ROWS = 600, 1000
_COLOURS = {PASS: "#1a7f37", FAIL: "#c0262d", LOOK: "#9a6700"}
_WORDS = {PASS: "pass", FAIL: "fail", LOOK: "look at it"}
_STYLE = """
.state { color: #fff; padding: 0 .5em; border-radius: 3px; font-weight: 600; white-space: nowrap; }
"""
# From the least to the greatest value.
_RAMP = ("#f7fbff", "#c6dbef", "#6baed6", "#2171b5", "#08306b")
_STRIPS = ("#3a9d5d", "#f0c93a", "#c0262d")
_OVERLAP = ("#ffffff", "#c6dbef", "#6baed6", "#2171b5", "#08306b")
_VOIDS = ("#e4ecdf", "#c0262d")
_TITLES = {
    "points": "Points", "withheld": "Withheld points",
    "no pulses": "Points that do not count as pulses", "classes": "Classes", "returns": "Returns",
    "strips": "Flight strips (point source ids)", "area": "Area of the figures below",
    "pulses": "Density of first returns", "density": "Density of all returns",
    "ground": "Density of ground points",
    "dense cells": "Cells that reach the demanded density",
    "filled cells": "Cells of twice the pulse spacing that hold a first return",
    "void squares": "Squares of four times the pulse spacing without a first return, outside water",
    "ground voids": "Cells that are far from a ground point, outside water",
    "overlap": "Cells with several strips",
    "compared": "Cells on even, open land whose strips are compared, of those with several strips",
    "strips RMSDz": "Differences between strips, RMSDz on even, open land",
    "largest": "Largest difference there",
    "below 8 cm": "Cells of all land whose strips differ by less than 8 cm",
    "8 to 16 cm": "By 8 to 16 cm", "over 16 cm": "By more than 16 cm",
}  # fmt: skip


def quality_html(
    found: Quality,
    cells: QualityCells,
    extent: Extent,
    asked: Specification,
    void: float,
    survey: Survey,
) -> str:
    """Return the page about a survey; from `void` metres on ground is missing."""
    parts = [
        *_comparison(found, asked),
        _figures(found),
        section("Maps", maps(_maps(cells, extent, void, survey))),
        _files(found, survey),
    ]
    return page("Quality of the survey", parts, _STYLE)


def _comparison(found: Quality, asked: Specification) -> list[Html]:
    if not found.lines:
        return [paragraph("The survey is not compared with a specification.")]
    rows = [
        (line.name, line.found, line.asked, _state(line.state), line.source) for line in found.lines
    ]
    said = paragraph(
        "This compares what can be counted. It does not replace the reading of the specification,"
        " which asks for more."
    )
    head = ("What", "Found", "Asked for", "Result", "Source")
    return [section(asked.label, table(rows, head, is_named=True), said)]


def _state(state: str) -> Html:
    style = f'class="state" style="background: {_COLOURS[state]}"'
    return Html(f"<span {style}>{_WORDS[state]}</span>")


def _figures(found: Quality) -> Html:
    return section(
        "Figures",
        table([(_TITLES[title], value) for title, value in found.rows()], is_named=True),
        paragraph(
            "Withheld points are left out. Densities leave out noise (classes 7 and 18), points"
            " that were not measured (synthetic), points with the flag of overlap, and points that"
            " repeat others of their file or of another one. Densities and shares are those of the"
            " area of the survey without a border of 10 to 20 m, which points fill in part only,"
            " and without squares of 10 m in which all first returns have the flag of overlap."
        ),
    )


def _maps(cells: QualityCells, extent: Extent, void: float, survey: Survey) -> Iterator[Html]:
    units = Units(survey.crs.horizontal_unit, survey.crs.vertical_unit)
    for name, raster in QUALITY_RASTERS.items():
        values, size = _small(name, cells, extent, void)
        if not np.isnan(values).all():
            pixels, legend = _coloured(name, values, units)
            yield map_of(Picture(pixels, size), raster.label or raster.title, legend, units)


def _small(name: str, cells: QualityCells, extent: Extent, void: float) -> tuple[np.ndarray, float]:
    """Return the values of a small map from north to south, and the side of its pixels."""
    raster = QUALITY_RASTERS[name]
    window = cells.sizes.coarse if raster.is_coarse else cells.sizes.fine
    size = cells.sizes.cell * (2 if raster.is_coarse else 1)
    step = math.ceil(max(window.shape) / _LONGEST)
    is_worst = name in ("voids", "strip_differences", "surface_height")
    small = np.zeros((0, -(-window.columns // step)))
    waiting = np.zeros((0, window.columns))
    for rows in rows_of(window):
        waiting = np.vstack((waiting, raster.make(cells, rows, extent.inside, void)))
        full = len(waiting) // step * step if rows.stop < window.rows else len(waiting)
        small = np.vstack((small, reduced(waiting[:full], step, is_worst)))
        waiting = waiting[full:]
    return small[::-1], size * step


def _coloured(name: str, values: np.ndarray, units: Units) -> tuple[np.ndarray, Html]:
    """Return the pixels of a map, and its legend."""
    known = values[~np.isnan(values)]
    if name == "strip_differences":
        words = [f"below {100 * LIMITS[0]:g} cm", f"to {100 * LIMITS[1]:g} cm", "above"]
        return _by_kind(values, np.searchsorted(LIMITS, values, side="right"), _STRIPS, words)
    if name == "voids":
        return _by_kind(values, values > 0, _VOIDS, ["ground", "void"])
    if name == "overlap":
        words = ["no strip", "1 strip", "2 strips", "3 strips", "4 strips or more"]
        number = np.clip(np.nan_to_num(np.rint(values)), 0, 4).astype(np.int64)
        return _by_kind(values, number, _OVERLAP, words)
    is_height = name == "surface_height"
    colours = HEIGHTS if is_height else _RAMP
    low, high = (float(np.percentile(known, share)) for share in (2.0, 98.0))
    low = low if is_height else 0.0
    high = max(high, low + 1e-6)
    pixels = ramped(values, colours, low, high)
    per_area = [f"{value:.3g} per m²" for value in (low, high)]
    ends = [units.height(low), units.height(high)] if is_height else per_area
    return pixels, keys((colours[0], colours[-1]), ends)


def _by_kind(
    values: np.ndarray, kinds: np.ndarray, colours: tuple[str, ...], words: list[str]
) -> tuple[np.ndarray, Html]:
    """Return pixels with a colour for each kind, and the legend."""
    table = np.array([rgb(colour) for colour in colours], dtype=np.uint8)
    pixels = table[np.clip(kinds.astype(np.int64), 0, len(colours) - 1)]
    pixels[np.isnan(values)] = rgb(NOWHERE)
    return pixels, keys(colours, words)


def _files(found: Quality, survey: Survey) -> Html:
    rows = [
        (
            element("span", file["name"], "files"), f"{file['points']:,}", file["version"],
            file["format"], "WKT" if file["wkt"] else "no WKT",
            *(f"{value:.2f}" for value in file["extent"]),
        )
        for file in found.files[:_MOST_ROWS]
    ]  # fmt: skip
    head = (
        "File", "Points", "LAS", "Point format", "CRS", "Least x", "Least y", "Greatest x",
        "Greatest y",
    )  # fmt: skip
    more = len(found.files) - _MOST_ROWS
    return section(
        "Files",
        paragraph(f"CRS: {survey.crs.name or 'not stated'}."),
        table(rows, head, "lrrrlrrrr"),
        paragraph(f"{more:,} more files are not listed." if more > 0 else ""),
    )
