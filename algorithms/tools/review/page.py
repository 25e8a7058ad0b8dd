"""The page with the places of a terrain model that a person should look at first."""

from __future__ import annotations

from typing import Sequence

import numpy as np

from ...relief.hillshade import hillshade
from ...report.page import (
    Html,
    element,
    key,
    line_chart,
    map_of,
    page,
    paragraph,
    section,
    table,
)
from ...report.pictures import Picture, rgb
from ...report.units import Units, percent
from .places import PlaceToReview, Rasters

_SHOWN = 10  # places with pictures
_AROUND = 15.0  # metres round a place that these show
_STYLE = """
.place { max-width: 420px; }
td { overflow-wrap: normal; }
"""
# Colours.
_PLACE = "#d4523f"
_TERRAIN = "#6e4824"


def review_html(
    name: str,
    rasters: Rasters,
    places: Sequence[PlaceToReview],
    figures: Sequence[tuple[str, str]],
    units: Units,
) -> str:
    """Return the page about a terrain model, given all places and the figures of all cells."""
    rows = [
        (
            number,
            place.reason,
            units.height(place.error),
            f"{place.area:,.0f}",
            percent(100.0 * place.weight / sum(one.weight for one in places)),
        )
        for number, place in enumerate(places[:_SHOWN], start=1)
    ]
    head = "", "Reason", "Expected error, largest", "Area, m²", "Share of error times area"
    parts = [
        table(figures, is_named=True),
        paragraph(
            "The expected error follows from the classified points alone: nothing was measured. 95"
            " of 100 errors of the terrain model are expected to be smaller."
        ),
        section("The places to look at first", table(rows, head, "rlrrr")),
        *(
            section(f"{number}: {place.reason}", *_pictures(rasters, place, units))
            for number, place in enumerate(places[:_SHOWN], start=1)
        ),
    ]
    return page(f"Places to review of {name}", parts, _STYLE)


def _pictures(rasters: Rasters, place: PlaceToReview, units: Units) -> tuple[Html, ...]:
    """Return the map of a place, and the profile through its worst cell from west to east."""
    if rasters.terrain is None:
        return (element("p", "Without a terrain model there is no picture."),)
    margin = int(np.ceil(_AROUND / rasters.cell))
    rows, columns = (
        slice(max(part.start - margin, 0), part.stop + margin) for part in place.window
    )
    heights = rasters.terrain[rows, columns]
    shade = hillshade(heights, rasters.cell)
    pixels = np.repeat(np.where(shade > 0, shade, 255)[:, :, None], 3, axis=2).astype(np.float64)
    inside = np.zeros(heights.shape, dtype=bool)
    row, column = place.window[0].start - rows.start, place.window[1].start - columns.start
    inside[row : row + place.cells.shape[0], column : column + place.cells.shape[1]] = place.cells
    pixels[inside] = 0.6 * pixels[inside] + 0.4 * np.array(rgb(_PLACE))
    worst = place.worst[0]
    profile = rasters.terrain[worst, columns] / units.vertical
    error = rasters.error[worst, columns] / units.vertical
    along = np.arange(len(profile)) * rasters.cell / units.horizontal
    picture = Picture(np.rint(pixels).astype(np.uint8), rasters.cell)
    drawn = map_of(picture, "Terrain model, north is up", key(_PLACE, "the place"), units)
    chart = line_chart(
        "Profile through the worst cell, from west to east",
        along,
        profile,
        (profile - error, profile + error),
        (_TERRAIN, _PLACE),
        (units.across, units.up),
    )
    legend = paragraph(
        key(_TERRAIN, "terrain model"), key(_PLACE, "where it may be, by the expected error")
    )
    return Html(f'<div class="place">{drawn}</div>'), chart, legend
