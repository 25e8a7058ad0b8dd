"""The page with the places of a terrain model that a person should look at first."""

from __future__ import annotations

from typing import Optional, Sequence, Tuple

import numpy as np

from ...las.class_names import CLASSES, named_class
from ...rasters.windows import Windows
from ...relief.hillshade import hillshade
from ...report.page import Html, element, key, map_of, page, paragraph, section, table
from ...report.pictures import Picture, rgb
from ...report.profile_chart import ChartLine, Dots, profile_chart
from ...report.units import Units, percent
from .answered import Change
from .places import PlaceToReview, Rasters
from .profile import ProfilePoints, line_of

SHOWN = 10  # places with pictures
_AROUND = 15.0  # metres round a place and its line that these show
_STYLE = """
.place { max-width: 420px; }
td { overflow-wrap: normal; }
svg { width: 100%; max-width: 860px; height: auto; }
"""
# Colours.
_PLACE = "#d4523f"
_TERRAIN = "#6e4824"
_LINE = "#1a4fd6"
_OTHER = "#8a949e"  # of classes without one
_CLASSES = {2: "#d08a2e", 3: "#b5c95a", 4: "#74b84a", 5: "#23803c", 6: "#c2479a", 9: "#5fb4e5"}
_WINDS = ("east", "north-east", "north", "north-west", "west", "south-west", "south", "south-east")

# Places, and the points along the lines of the first ones; None where none were read.
Places = Tuple[Sequence[PlaceToReview], Sequence[Optional[ProfilePoints]]]
# The figures of all cells, and what answers changed.
Figures = Tuple[Sequence[Tuple[str, str]], Sequence[Change]]


def review_html(name: str, rasters: Rasters, places: Places, figures: Figures, units: Units) -> str:
    """Return the page about a terrain model."""
    (every, profiles), (titled, changes) = places, figures
    shown = every[:SHOWN]
    rows = [
        (
            number,
            place.reason,
            units.height(place.error),
            f"{place.area:,.0f}",
            percent(100.0 * place.weight / sum(one.weight for one in every)),
        )
        for number, place in enumerate(shown, start=1)
    ]
    head = "", "Reason", "Expected error, largest", "Area, m²", "Share of error times area"
    parts = [
        table(titled, is_named=True),
        paragraph(
            "The expected error follows from the classified points alone: nothing was measured. 95"
            " of 100 errors of the terrain model are expected to be smaller."
        ),
        section("What your answers changed", _changes(changes, units)),
        section("The places to look at first", table(rows, head, "rlrrr")),
        *(
            section(f"{number}: {place.reason}", *_pictures(rasters, place, points, units))
            for number, (place, points) in enumerate(zip(shown, profiles), start=1)
        ),
    ]
    return page(f"Places to review of {name}", parts, _STYLE)


def _changes(changes: Sequence[Change], units: Units) -> Html:
    """Return the table of what changed in the terrain model."""
    rows = [
        (
            one.name, one.answer, f"{one.cells:,}", f"{one.area:,.0f}",
            _signed(one.mean, units), _signed(one.largest, units),
        )
        for one in changes
    ]  # fmt: skip
    head = "", "Answer", "Cells that changed", "Area, m²", "Mean change", "Largest change"
    return table(rows, head, "llrrrr")


def _signed(metres: float, units: Units) -> str:
    return f"{'+' if metres > 0 else ''}{units.height(metres)}"


def _pictures(
    rasters: Rasters, place: PlaceToReview, points: ProfilePoints | None, units: Units
) -> tuple[Html, ...]:
    """Return the map of a place with its line, and the profile along the line."""
    if rasters.terrain is None:
        return (element("p", "Without a terrain model there is no picture."),)
    line = line_of(rasters, place)
    legend = key(_PLACE, "the place") + key(_LINE, "the line of the profile")
    drawn = map_of(
        _map(rasters, rasters.terrain, place, line), "Terrain model, north is up", legend, units
    )
    below = [
        key(_TERRAIN, "terrain model"), key(_PLACE, "where it may be, by the expected error"),
    ]  # fmt: skip
    dots = []
    if points is not None:
        for value in np.unique(points.classes).tolist():
            some, colour = points.classes == value, _CLASSES.get(value, _OTHER)
            dots.append(Dots(points.along[some], points.heights[some], colour))
            below.append(key(colour, CLASSES.get(value, named_class(value))))
    chart = _profile(rasters, rasters.terrain, line, dots, units)
    return Html(f'<div class="place">{drawn}</div>'), chart, paragraph(*below)


def _map(rasters: Rasters, terrain: Windows, place: PlaceToReview, line: np.ndarray) -> Picture:
    """Return the relief round a place, in which the place and its line have colours."""
    margin, shape = _AROUND / rasters.cell, rasters.error.shape
    rows, columns = (
        slice(
            max(int(min(part.start, line[:, axis].min()) - margin), 0),
            min(int(max(part.stop, line[:, axis].max()) + margin) + 1, shape[axis]),
        )
        for axis, part in enumerate(place.window)
    )
    heights = terrain[rows, columns]
    shade = hillshade(heights, rasters.cell)
    pixels = np.repeat(np.where(shade > 0, shade, 255)[:, :, None], 3, axis=2).astype(np.float64)
    inside = np.zeros(heights.shape, dtype=bool)
    row, column = place.window[0].start - rows.start, place.window[1].start - columns.start
    inside[row : row + place.cells.shape[0], column : column + place.cells.shape[1]] = place.cells
    pixels[inside] = 0.6 * pixels[inside] + 0.4 * np.array(rgb(_PLACE))
    steps = np.linspace(0.0, 1.0, 2 * int(np.abs(line[1] - line[0]).max()) + 2)[:, None]
    cells = np.rint(line[0] + steps * (line[1] - line[0]) - (rows.start, columns.start))
    there = ((cells >= 0) & (cells < heights.shape)).all(axis=1)
    pixels[tuple(cells[there].astype(np.intp).T)] = rgb(_LINE)
    return Picture(np.rint(pixels).astype(np.uint8), rasters.cell)


def _profile(
    rasters: Rasters, surface: Windows, line: np.ndarray, dots: Sequence[Dots], units: Units
) -> Html:
    """Return the profile of terrain model and expected error along a line."""
    from scipy import ndimage

    way = line[1] - line[0]
    count = int(np.ceil(np.hypot(*way))) + 1
    shares = np.linspace(0.0, 1.0, count)
    places = (line[0] + shares[:, None] * way).T
    # The cells round the line, since those of large rasters are not all in memory.
    first = [max(int(np.floor(along.min())) - 1, 0) for along in places]
    window = tuple(
        slice(start, int(np.ceil(along.max())) + 2) for start, along in zip(first, places)
    )
    terrain, error = (
        ndimage.map_coordinates(
            values[window], places - np.reshape(first, (2, 1)), order=1, cval=np.nan
        )
        / units.vertical
        for values in (surface, rasters.error)
    )
    along = shares * float(np.hypot(*way)) * rasters.cell / units.horizontal
    towards = int(np.rint(np.arctan2(-way[0], way[1]) / (np.pi / 4.0))) % len(_WINDS)
    start, end = _WINDS[(towards + 4) % len(_WINDS)], _WINDS[towards]
    return profile_chart(
        f"Profile through the worst cell, from {start} to {end}",
        ChartLine(along, terrain, terrain - error, terrain + error, (_TERRAIN, _PLACE)),
        dots,
        (units.across, units.up),
        {"left": start, "right": end},
    )
