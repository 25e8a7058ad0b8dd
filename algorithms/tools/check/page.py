"""The page of a comparison with checkpoints: a single HTML file."""

from __future__ import annotations

from typing import Sequence

import numpy as np

from ...report.page import (
    DOUBT,
    DRAWN,
    Html,
    Mark,
    bars,
    keys,
    map_of_places,
    page,
    paragraph,
    section,
    table,
)
from ...survey.files import Survey
from .residuals import Residuals
from .results import COLOURS, COUNTED, NOT_COUNTED, REASONS, Check, Fact, limits_of

_BARS = 15
_MOST_ROWS = 1000
_STYLE = f"{DRAWN}{DOUBT}"


def checkpoint_html(check: Check, found: Residuals | None, survey: Survey) -> str:
    """Return the page of a comparison; `found` are the errors at checkpoints, if there are any."""
    files = [tile.path for tile in survey.tiles]
    more = f" and {len(files) - 1:,} more" if files[1:] else ""
    facts = [fact for fact in check.facts if fact.errors is None and fact.text != check.doubt]
    parts = [
        paragraph(f"Points: {files[0].name}{more}", kind="files"),
        paragraph(check.doubt, kind="doubt"),
        table([(fact.title, fact.text) for fact in facts], is_named=True),
        _figures(check.facts),
    ]
    if found is not None:
        parts += [_histogram(check, found), _map(check, found, survey), _unknown(check)]
        parts.append(_table(found, survey))
    return page("Check against checkpoints", parts, _STYLE)


def _figures(facts: Sequence[Fact]) -> Html:
    head = (
        "", "Count", "RMSE", "Total", "Mean", "Median", "Standard deviation", "Lowest", "Highest",
        "95 % within",
    )  # fmt: skip
    values = (
        (
            fact.title, f"{one.count:,}", f"{one.rmse:.3f}", f"{one.total_rmse:.3f}",
            f"{one.mean:+.3f}", f"{one.median:+.3f}", f"{one.standard_deviation:.3f}",
            f"{one.minimum:+.3f}", f"{one.maximum:+.3f}", f"{one.percentile_95:.3f}",
        )
        for fact in facts
        if (one := fact.errors) is not None
    )  # fmt: skip
    return section(
        "Figures",
        table(values, head, "lrrrrrrrrr", is_named=True),
        paragraph(
            "Height of the data minus height of the point, in metres. RMSE is that of the"
            " differences; the total adds the error of the survey of the checkpoints. Ground points"
            " that were held out are compared with the TIN of the others; steep is more than 20"
            " degrees."
        ),
    )


def _colour(error: float, scale: float) -> str:
    return COLOURS[int(np.searchsorted(limits_of(scale), error))]


def _histogram(check: Check, found: Residuals) -> Html:
    errors, limit = found.errors[found.counted], check.scale
    edges = np.linspace(-limit, limit, _BARS + 1)
    counts, _ = np.histogram(np.clip(errors, -limit, limit), edges)
    middles = (edges[:-1] + edges[1:]) / 2.0
    colours = [_colour(middle, limit) for middle in middles.tolist()]
    ticks = [f"{share * limit:+g} m" for share in (-1.0, -0.5, 0.0, 0.5, 1.0)]
    return section(
        "How the differences are distributed",
        bars("Histogram of the differences", counts.tolist(), colours, ticks),
        paragraph(
            "Ground points minus checkpoints. The outermost bars hold what lies beyond them."
        ),
    )


def _map(check: Check, found: Residuals, survey: Survey) -> Html:
    marks = []
    values = zip(found.xyz.tolist(), found.names, found.states, found.errors.tolist())
    # Checkpoints that count are drawn on top of others at the same place.
    for (x, y, _), name, state, error in sorted(values, key=lambda value: value[2] == COUNTED):
        is_counted = state == COUNTED
        colour = _colour(error, check.scale) if is_counted else NOT_COUNTED
        result = f"{error:+.3f} m" if is_counted else REASONS[state]
        marks.append(Mark(x, y, colour, f"{name}: {result}"))
    boxes = np.array([tile.outer_box for tile in survey.tiles])
    unit = "m" if survey.crs.horizontal_unit == 1.0 else "units of the CRS"
    ends = [f"{value:+.3g}" for value in limits_of(check.scale)]
    ranges = [f"{low} to {high} m" for low, high in zip(ends, ends[1:])]
    meanings = (f"below {ends[0]} m", *ranges, f"above {ends[-1]} m", "not counted")
    return section(
        "Where the differences are",
        map_of_places("Map of the differences", boxes, marks, unit),
        paragraph(keys((*COLOURS, NOT_COUNTED), meanings)),
        paragraph("North is up. The rectangles are the files."),
    )


def _unknown(check: Check) -> Html:
    rows = [(name, f"{count:,}") for name, count in (check.unknown_covers or {}).items()]
    told = paragraph("They count as land without vegetation (NVA)." if rows else "")
    columns = table(rows, ("Land cover", "Checkpoints"), "lr")
    return section("Land covers that are not known", told, columns)


def _table(found: Residuals, survey: Survey) -> Html:
    has_dtm = bool(np.isfinite(found.dtm).any())
    columns = [found.ground, found.errors, found.dtm, found.dtm_errors][: 4 if has_dtm else 2]
    heights = zip(*(values.tolist() for values in columns))
    rows = [
        (
            name, cover, kind, f"{x:.2f}", f"{y:.2f}",
            *("" if np.isnan(value) else f"{value:.3f}" for value in (z, *values)),
            "" if state == COUNTED else REASONS[state],
        )
        for name, cover, kind, (x, y, z), values, state in zip(
            found.names[:_MOST_ROWS], found.covers, found.kinds, found.xyz.tolist(), heights,
            found.states,
        )
    ]  # fmt: skip
    more = len(found.names) - len(rows)
    dtm = ["Terrain model", "Difference, m"] if has_dtm else []
    head = ["Name", "Land cover", "Kind", "x", "y", "z", "Ground", "Difference, m"]
    return section(
        "Checkpoints",
        table(rows, [*head, *dtm, "Not counted"], "lll" + "r" * (3 + len(columns)) + "l"),
        paragraph(
            f"x, y and heights are in the units of the CRS: {survey.crs.name or 'not stated'}."
        ),
        paragraph(f"{more:,} more are in the table that can be written." if more else ""),
    )
