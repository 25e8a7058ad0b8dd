"""The page about the change between two surveys."""

from __future__ import annotations

import math
from typing import Iterator, Sequence

import numpy as np

from ...rasters.looks import CHANGES
from ...relief.hillshade import hillshade
from ...report.page import (
    DRAWN,
    Html,
    bars,
    keys,
    lines,
    map_of,
    page,
    paragraph,
    section,
    table,
)
from ...report.pictures import Picture, ramped, reduced, rgb
from ...report.profile_chart import ChartLine, Dots, profile_chart
from ...report.units import Units
from ...survey.files import Inputs
from ..contours import corners_of
from ..review.profile import ProfilePoints, points_along
from .places import ChangePlace, limits_of
from .summary import TerrainChange

_SHOWN = 10  # places in the table, of which the first have profiles
_PROFILES = 5
_LONGEST = 900  # cells of the map
_BEYOND = 15.0  # metres of a profile beyond its place
_BARS = 21
# Colours: what sank and what rose, as the layers in QGIS, and what is not told.
_LEVEL = "#f5f3ee"
_RAMP = (CHANGES[0][1], CHANGES[1][1], _LEVEL, CHANGES[3][1], CHANGES[4][1])
_OLD, _NEW, _BAND = "#8c6d46", "#1a4fd6", "#c9b79a"
_POINTS = "#b9a58a", "#8fb3ef"


def change_html(
    names: Sequence[str],
    found: TerrainChange,
    facts: Sequence[tuple[str, str]],
    clouds: Sequence[Inputs | None],
) -> str:
    """Return the page, given the names and the point clouds of both dates, and the figures."""
    units = found.pair.units
    parts = [
        lines(f"Old: {names[0]}", f"New: {names[1]}", kind="files"),
        table(facts, is_named=True),
        section("Where the ground changed", *_map(found, units)),
        section("Places of change", _table(found, units)),
        section("Profiles", *_profiles(found, clouds, units)),
        section("Stable land", *_stable(found, units)),
    ]
    return page("Change between two surveys", parts, DRAWN)


def _map(found: TerrainChange, units: Units) -> Iterator[Html]:
    """Yield the map of the change over the relief, with the places outlined."""
    from scipy import ndimage

    pair = found.pair
    step = max(math.ceil(max(pair.grid.whole) / _LONGEST), 1)
    scale = _scale(found)
    rows = []
    for start in range(0, pair.grid.whole[0], 64 * step):
        window = slice(start, start + 64 * step), slice(0, pair.grid.whole[1])
        strip = pair.strip(window)
        change = found.alignment.of_strip(pair, strip)
        rows.append([reduced(values.astype(np.float64), step) for values in (strip.new, change)])
    new, change = (np.vstack(some) for some in zip(*rows))
    shade = hillshade(new, pair.cell * step).astype(np.float64)[..., None]
    colour = ramped(change, _RAMP, -scale, scale).astype(np.float64)
    pixels = np.where(shade > 0, colour * (0.35 + 0.65 * shade / 255.0), 255.0)
    for place in found.places:
        mask = place.mask
        edge = mask & ~ndimage.binary_erosion(mask)
        row, column = np.nonzero(edge)
        at = (row + place.window[0].start) // step, (column + place.window[1].start) // step
        pixels[at] = rgb("#222222")
    picture = Picture(np.rint(pixels).astype(np.uint8), pair.cell * step)
    ends = f"{units.height(-scale)} or less", "unchanged", f"{units.height(scale)} or more"
    yield map_of(
        picture, "New minus old, north is up", keys((_RAMP[0], _LEVEL, _RAMP[-1]), ends), units
    )
    yield paragraph("Places of significant change have a dark outline. White: no value in a date.")


def _scale(found: TerrainChange) -> float:
    """Return the change in metres from which colours are full."""
    means = [abs(place.mean) for place in found.places]
    return max(float(np.median(means)) * 1.5 if means else 0.0, 4.0 * found.scatter.nmad, 0.1)


def _table(found: TerrainChange, units: Units) -> Html:
    """Return the table of the first places."""
    rows = []
    for rank, place in enumerate(found.places[:_SHOWN], start=1):
        area, volume, error, mean, largest, limit = place.in_units(units)
        change = f"{mean:+.2f}", f"{largest:+.2f}", f"{limit:.2f}"
        rows.append((rank, place.kind, f"{area:,.0f}", f"{volume:+,.1f} ± {error:,.1f}", *change))
    high = units.up
    head = (
        "", "What it probably is", f"Area, {units.across}²", f"Volume (95 %), {units.cubic}",
        f"Mean, {high}", f"Largest, {high}", f"Limit of a cell, {high}",
    )  # fmt: skip
    left = len(found.places) - len(rows)
    more = paragraph(f"{left:,} smaller places are only in the layer.") if left else ""
    return Html(table(rows, head, "rlrrrrr") + more)


def _profiles(
    found: TerrainChange, clouds: Sequence[Inputs | None], units: Units
) -> Iterator[Html]:
    """Yield profiles through the first places, with the points of both dates."""
    shown = found.places[:_PROFILES]
    cuts = [_line_of(place) for place in shown]
    ends = np.array([corners_of(line, found.pair.grid).ravel() for line in cuts]).reshape(-1, 4)
    points = [
        [None] * len(shown) if cloud is None else points_along(cloud, ends) for cloud in clouds
    ]
    for number, (line, *of_dates) in enumerate(zip(cuts, *points), start=1):
        yield _profile(number, found, line, of_dates, units)
    if shown:
        names = "old terrain", "detection limit", "new terrain", "old points", "new points"
        colours = (_OLD, _BAND, _NEW, *_POINTS)
        count = 5 if any(cloud is not None for cloud in clouds) else 3
        yield paragraph(keys(colours[:count], names[:count]))


def _line_of(place: ChangePlace) -> np.ndarray:
    """Return the ends of the profile of a place, row and column, from west to east through its
    largest change, along its shorter side.
    """
    row, column = (int(of[np.argmax(np.abs(place.change))]) for of in (place.rows, place.columns))
    high, wide = (part.stop - part.start for part in place.window)
    more = _BEYOND / place.cell
    if high < wide:
        first, last = place.window[0].start - more, place.window[0].stop + more
        return np.array([(first, column), (last, column)], dtype=np.float64)
    first, last = place.window[1].start - more, place.window[1].stop + more
    return np.array([(row, first), (row, last)], dtype=np.float64)


def _profile(
    number: int,
    found: TerrainChange,
    line: np.ndarray,
    points: Sequence[ProfilePoints | None],
    units: Units,
) -> Html:
    """Return the profile of both terrains along a row or a column."""
    pair, whole = found.pair, found.pair.grid.whole
    low, high = (np.clip(end, 0, np.array(whole) - 1).astype(int) for end in line)
    window = slice(low[0], high[0] + 1), slice(low[1], high[1] + 1)
    strip = pair.strip(window)
    old, new, spread = (values.ravel() for values in (strip.old, strip.new, strip.spread))
    aligned = old + found.alignment.of_strip(pair, strip).ravel()
    slope = np.abs(np.gradient(old, pair.cell)) if len(old) > 1 else np.zeros(len(old))
    limit = limits_of(found.scatter, found.alignment, spread, slope)
    start = low - line[0]
    along = (np.hypot(*start) + np.arange(len(old))) * pair.cell / units.horizontal
    up = units.vertical
    dots = []
    for some, colour, off in zip(points, _POINTS, (0.0, float(np.nanmean(new - aligned)))):
        if some is not None:
            near = some.heights < np.nanmax(np.fmax(old, new)) / up + 5.0 / up
            dots.append(Dots(some.along[near], some.heights[near] - off / up, colour))
    fine = np.linspace(along[0], along[-1], 4 * len(along))
    heights = np.interp(fine, along, aligned / up)
    known = np.isfinite(heights)
    dots.append(Dots(fine[known], heights[known], _NEW))
    first = ChartLine(along, old / up, (old - limit) / up, (old + limit) / up, (_OLD, _BAND))
    names = ("west", "east") if line[0][0] == line[1][0] else ("north", "south")
    chart = profile_chart(
        f"Profile of place {number}, from {names[0]} to {names[1]}", first, dots,
        (units.across, units.up), {"left": f"{number}: {names[0]}", "right": names[1]},
    )  # fmt: skip
    return Html(chart)


def _stable(found: TerrainChange, units: Units) -> Iterator[Html]:
    """Yield the histogram of the differences of cells that did not change, and what it means."""
    sample, scatter = found.sample, found.scatter
    change = sample.change - found.alignment.at(sample.east, sample.north)
    most = max(4.0 * scatter.nmad, 0.05)
    limits = scatter.limit(sample.spread, sample.slope)
    counts, _ = np.histogram(change[np.abs(change) <= limits], _BARS, (-most, most))
    ticks = [units.height(value) for value in np.linspace(-most, most, 5)]
    yield bars("Differences of stable cells", counts.tolist(), [_LEVEL] * _BARS, ticks)
    how = (
        "The limits follow from the expected errors of both terrain models, and from how much"
        " stable land differs for each size of them."
        if scatter.by_error
        else "There are no expected errors: the limits follow from how much stable land differs at"
        " each slope, and say nothing about gaps and plants."
    )
    yield paragraph(
        "Cells that differ by less than their limit, after the alignment.",
        f"{found.alignment.stable:.0%} of the cells are stable.", how,
        f"Errors are correlated up to about {units.length(round(scatter.reach, 1))}.",
        found.alignment.moved,
    )  # fmt: skip
