"""The page about the quality of a survey: a single HTML file."""

from __future__ import annotations

import math
from typing import Iterator, Sequence

import numpy as np

from ...report.page import Html, element, keys, map_of, maps, page, paragraph, section, table
from ...report.pictures import NOWHERE, Picture, ramped, reduced, rgb
from ...report.units import Units
from ...survey.files import Survey
from .cells import QualityCells
from .figures import FAILED, FIGURES, LOOK, PASSED, Quality
from .low_confidence import LowConfidence
from .rasters import QUALITY_RASTERS, QualityRaster
from .specifications import SPECIFICATIONS

_LONGEST = 600  # pixels: longest side of a map
_MOST_ROWS = 1000  # of the table of files
_LOW = "#e4ecdf", "#c0262d"  # colours of the map of low confidence areas
_STATES = {
    PASSED: ("#1a7f37", "pass"),
    FAILED: ("#c0262d", "fail"),
    LOOK: ("#9a6700", "look at it"),
}
_STYLE = """
.state { color: #fff; padding: 0 .5em; border-radius: 3px; font-weight: 600; white-space: nowrap; }
"""


def quality_html(
    found: Quality, cells: QualityCells, survey: Survey, low: LowConfidence | None
) -> str:
    """Return the page about a survey."""
    parts = [
        *_comparison(found),
        section(
            "Figures",
            table([(figure.title, figure.text(found)) for figure in FIGURES], is_named=True),
            paragraph(
                "Withheld points are left out. Densities leave out noise (classes 7 and 18), points"
                " that were not measured (synthetic, infilled or virtual), points with the flag of"
                " overlap, and points that repeat others of their file or of another one. Points"
                " that were not measured are no strips and tell nothing of water. Densities and"
                " shares are those of the area of the survey without a border of up to 10 m, which"
                " points may fill in part only, and without squares of 10 m in which all first"
                " returns have the flag of overlap."
            ),
        ),
        section("Maps", maps(_maps(cells, survey, low)), _of_pieces(cells)),
        _files(found, survey),
    ]
    return page("Quality of the survey", parts, _STYLE)


def _comparison(found: Quality) -> list[Html]:
    if not found.comparison:
        return [paragraph("The survey is not compared with a specification.")]
    rows = [
        (line.name, line.found, line.asked, _state(line.state), line.source)
        for line in found.comparison
    ]
    said = paragraph(
        "This compares what can be counted. It does not replace the reading of the specification,"
        " which asks for more."
    )
    head = ("What", "Found", "Asked for", "Result", "Source")
    label = SPECIFICATIONS[found.specification].label
    return [section(label, table(rows, head, is_named=True), said)]


def _state(state: str) -> Html:
    colour, words = _STATES[state]
    return Html(f'<span class="state" style="background: {colour}">{words}</span>')


def _maps(cells: QualityCells, survey: Survey, low: LowConfidence | None) -> Iterator[Html]:
    units = Units(survey.crs.horizontal_unit, survey.crs.vertical_unit)
    for raster in QUALITY_RASTERS.values():
        grid = raster.grid(cells)
        step = math.ceil(max(grid.window.shape) / _LONGEST)
        values = cells.reduced(raster.make, step, raster.is_coarse, raster.shows_greatest)
        if not np.isnan(values).all():
            pixels, legend = _coloured(raster, values[::-1], units)
            picture = Picture(pixels, grid.size * step)
            yield map_of(picture, raster.label or raster.title, legend, units)
    if low is not None:
        step = math.ceil(max(low.low.shape) / _LONGEST)
        shown = np.where(reduced(low.low[::-1].astype(float), step, True) > 0, 1, 0)
        picture = Picture(_painted(shown, _LOW), low.cell * step)
        yield map_of(picture, "Low confidence areas", keys(_LOW, ("none", "low confidence")), units)


def _of_pieces(cells: QualityCells) -> Html:
    """Return a note on the maps of a survey in pieces."""
    count = len(cells.grids.coarse.pieces)
    words = f"The survey lies in {count} pieces far apart. The maps show them above each other."
    return paragraph(words if count > 1 else "")


def _painted(classes: np.ndarray, colours: Sequence[str]) -> np.ndarray:
    """Return the pixels of classes, which are numbers of colours."""
    return np.array([rgb(colour) for colour in colours], dtype=np.uint8)[classes]


def _coloured(raster: QualityRaster, values: np.ndarray, units: Units) -> tuple[np.ndarray, Html]:
    """Return the pixels of a map, and its legend."""
    colours = raster.colours
    if raster.class_of:
        classes = np.nan_to_num(raster.class_of(values)).astype(np.int64)
        pixels = _painted(np.clip(classes, 0, len(colours) - 1), colours)
        pixels[np.isnan(values)] = rgb(NOWHERE)
        return pixels, keys(colours, raster.words)
    low, high = np.nanpercentile(values, (2.0, 98.0)).tolist()
    low = low if raster.is_height else 0.0
    high = max(high, low + 1e-6)
    ends = [
        units.height(value) if raster.is_height else f"{value:.3g} per m²" for value in (low, high)
    ]
    return ramped(values, colours, low, high), keys((colours[0], colours[-1]), ends)


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
