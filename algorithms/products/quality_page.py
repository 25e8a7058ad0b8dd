"""The page about the quality of a survey: a single HTML file."""

from __future__ import annotations

import math

import numpy as np

from ..survey.files import Survey
from .page import Units, key, map_figure, page_html, text
from .pictures import HEIGHTS, NOWHERE, Picture, ramped, reduced, rgb
from .quality_cells import QualityCells
from .quality_figures import FAIL, LIMITS, LOOK, PASS, Extent, Quality
from .quality_rasters import QUALITY_RASTERS, rows_of
from .specifications import Specification

# Longest side of a map in pixels, and most rows of the table of files.
_LONGEST, _MOST_ROWS = 600, 1000
_COLOURS = {PASS: "#1a7f37", FAIL: "#c0262d", LOOK: "#9a6700"}
_WORDS = {PASS: "pass", FAIL: "fail", LOOK: "look at it"}
_STYLE = """
.maps { display: grid; grid-template-columns: repeat(auto-fill, minmax(260px, 1fr)); gap: 1.2em; }
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
    """Return the page about the quality of a survey; ground is missing from `void` metres on."""
    parts = [_comparison(found, asked), _figures(found), _maps(cells, extent, void, survey)]
    return page_html("Quality of the survey", "\n".join([*parts, _files(found, survey)]), _STYLE)


def _comparison(found: Quality, asked: Specification) -> str:
    if not found.lines:
        return "<p>The survey is not compared with a specification.</p>"
    rows = "".join(
        f'<tr><th class="text">{text(each.name)}</th><td class="text">{text(each.found)}</td>'
        f'<td class="text">{text(each.asked)}</td><td class="text"><span class="state"'
        f' style="background: {_COLOURS[each.state]}">{_WORDS[each.state]}</span></td>'
        f'<td class="text">{text(each.source)}</td></tr>'
        for each in found.lines
    )
    return f"""<h2>{text(asked.label)}</h2>
<table><tr><th class="text">What</th><th class="text">Found</th><th class="text">Asked for</th>
<th class="text">Result</th><th class="text">Source</th></tr>
{rows}</table>
<p>This compares what can be counted. It does not replace the reading of the specification, which
asks for more.</p>"""


def _figures(found: Quality) -> str:
    rows = "".join(
        f'<tr><th class="text">{text(_TITLES[title])}</th><td class="text">{text(value)}</td></tr>'
        for title, value in found.rows()
    )
    return f"""<h2>Figures</h2>
<table>{rows}</table>
<p>Withheld points are left out. Densities leave out noise (classes 7 and 18), points that were not
measured (synthetic), points with the flag of overlap, and points that repeat others of their file
or of another one. Densities and shares are those of the area of the survey without a border of 10
to 20 m, which points fill in part only, and without squares of 10 m in which all first returns have
the flag of overlap.</p>"""


def _maps(cells: QualityCells, extent: Extent, void: float, survey: Survey) -> str:
    units, figures = Units(survey.crs.horizontal_unit, survey.crs.vertical_unit), []
    for name, raster in QUALITY_RASTERS.items():
        values, size = _small(name, cells, extent, void)
        known = values[~np.isnan(values)]
        if not len(known):
            continue
        pixels, legend = _coloured(name, values, units)
        figure = map_figure(Picture(pixels, size), raster.label, raster.label, units)
        figures.append(f"<figure>{figure}<br>{legend}</figure>")
    return f"""<h2>Maps</h2>
<div class="maps">{"".join(figures)}</div>"""


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


def _coloured(name: str, values: np.ndarray, units: Units) -> tuple[np.ndarray, str]:
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
    low, high = (float(np.percentile(known, each)) for each in (2.0, 98.0))
    low = low if is_height else 0.0
    high = max(high, low + 1e-6)
    pixels = ramped(values, colours, low, high)
    per_area = [f"{each:.3g} per m²" for each in (low, high)]
    ends = [units.height(low), units.height(high)] if is_height else per_area
    return pixels, key(colours[0], ends[0]) + key(colours[-1], ends[1])


def _by_kind(
    values: np.ndarray, kinds: np.ndarray, colours: tuple[str, ...], words: list[str]
) -> tuple[np.ndarray, str]:
    """Return pixels with a colour for each kind, and the legend."""
    table = np.array([rgb(each) for each in colours], dtype=np.uint8)
    pixels = table[np.clip(kinds.astype(np.int64), 0, len(colours) - 1)]
    pixels[np.isnan(values)] = rgb(NOWHERE)
    return pixels, "".join(key(colour, word) for colour, word in zip(colours, words))


def _files(found: Quality, survey: Survey) -> str:
    rows = "".join(
        f'<tr><td class="text files">{text(each["name"])}</td><td>{each["points"]:,}</td>'
        f"<td>{each['version']}</td><td>{each['format']}</td>"
        f'<td class="text">{"WKT" if each["wkt"] else "no WKT"}</td>'
        + "".join(f"<td>{value:.2f}</td>" for value in each["extent"])
        + "</tr>"
        for each in found.files[:_MOST_ROWS]
    )
    more = len(found.files) - _MOST_ROWS
    left = f"<p>{more:,} more files are not listed.</p>" if more > 0 else ""
    return f"""<h2>Files</h2>
<p>CRS: {text(survey.crs.name or "not stated")}.</p>
<table><tr><th class="text">File</th><th>Points</th><th>LAS</th><th>Point format</th>
<th class="text">CRS</th><th>Least x</th><th>Least y</th><th>Greatest x</th><th>Greatest y</th></tr>
{rows}</table>
{left}"""
