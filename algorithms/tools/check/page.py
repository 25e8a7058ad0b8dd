"""The page of a comparison with checkpoints: a single HTML file."""

from __future__ import annotations

import numpy as np

from ...report.page import (
    DOUBT,
    DRAWN,
    Html,
    Mark,
    bars,
    element,
    keys,
    map_of_places,
    page,
    paragraph,
    section,
    table,
)
from ...survey.files import Survey
from .accuracy import Figures
from .hold_out import HoldOut
from .residuals import Residuals
from .results import COLOURS, COUNTED, NOT_COUNTED, REASONS, Check, limits_of

_BARS = 15
_MOST_ROWS = 1000
_STYLE = f"""
{DRAWN}blockquote {{ margin: 1em 0; padding: .4em 1em; border-left: 4px solid #888;
  background: #f6f6f6; }}
{DOUBT}"""


def checkpoint_html(check: Check, found: Residuals | None, survey: Survey) -> str:
    """Return the page of a comparison; `found` are the errors at checkpoints, if there are any."""
    files = [tile.path for tile in survey.tiles]
    more = f" and {len(files) - 1:,} more" if files[1:] else ""
    parts = [paragraph(f"Points: {files[0].name}{more}", kind="files")]
    if found is not None:
        parts += [*_summary(check), _histogram(check, found), _map(check, found, survey)]
        parts += [_unknown(check), _not_counted(check), _largest(check), _table(found, survey)]
    if check.hold_out is not None:
        parts.append(_held_out(check.hold_out))
    return page("Check against checkpoints", parts, _STYLE)


def _summary(check: Check) -> list[Html]:
    rows = {
        "Ground points, without vegetation (NVA)": check.nva,
        "Ground points, with vegetation (VVA)": check.vva,
        "Terrain model, without vegetation (NVA)": check.dtm_nva,
        "Terrain model, with vegetation (VVA)": check.dtm_vva,
        "Ground points, in low confidence areas": check.low_confidence,
        "Terrain model, in low confidence areas": check.dtm_low_confidence,
    }
    count = 0 if check.nva is None else check.nva.count
    shift = "" if check.shift is None else f"{check.shift:+.3f} m"
    return [
        paragraph(check.doubt, kind="doubt"),
        paragraph(
            f"{check.counted:,} of {check.checkpoint_count:,} checkpoints are counted, {count:,} of"
            " them on land without vegetation.",
            f"The standard asks for at least {check.needed} of these.",
            "" if check.doubt else check.verdict,
            shift
            and f"The mean difference would be removed by a shift of {shift}. Nothing was shifted.",
            "" if check.expected is None else check.expected.text,
        ),
        *(element("blockquote", words) for words in check.statements),
        section(
            "Figures",
            _figures(rows),
            paragraph(
                "Height of the data minus height of the checkpoint, in metres. RMSE is that of the"
                " differences; the total adds the error of the survey of the checkpoints."
            ),
        ),
    ]


def _figures(rows: dict[str, Figures | None]) -> Html:
    head = (
        "", "Count", "RMSE", "Total", "Mean", "Median", "Standard deviation", "Lowest", "Highest",
        "95 % within",
    )  # fmt: skip
    values = (
        (
            name, f"{one.count:,}", f"{one.rmse:.3f}", f"{one.total_rmse:.3f}", f"{one.mean:+.3f}",
            f"{one.median:+.3f}", f"{one.standard_deviation:.3f}", f"{one.minimum:+.3f}",
            f"{one.maximum:+.3f}", f"{one.percentile_95:.3f}",
        )
        for name, one in rows.items()
        if one is not None
    )  # fmt: skip
    return table(values, head, "lrrrrrrrrr", is_named=True)


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
    # Those that count lie on top of the same points.
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


def _not_counted(check: Check) -> Html:
    rows = [
        (REASONS[reason], f"{len(names):,}", ", ".join(names[:_MOST_ROWS]))
        for reason, names in (check.not_counted or {}).items()
    ]
    return section("Not counted", table(rows, ("Why", "Count", "Checkpoints"), "lrl"))


def _largest(check: Check) -> Html:
    worst = [f"{one['name']} ({one['error']:+.3f} m)" for one in check.largest or ()]
    return section("Largest differences", element("p", ", ".join(worst)))


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


def _held_out(left: HoldOut) -> Html:
    rows = {
        "All": left.all, "Open land": left.open, "Under trees": left.under_trees,
        "Steeper than 20 degrees": left.steep,
    }  # fmt: skip
    return section(
        "Ground points that were held out",
        paragraph(
            f"{left.left_out:,} ground points ({100 * left.share:g} %) were left out of the TIN;"
            f" {left.no_height:,} of those that were looked at lie in voids of the others."
        ),
        _figures(rows),
        paragraph(
            "TIN of the other ground points minus the point, in metres.",
            left.limits(),
            "If all points lie 10 cm too high, it does not show either.",
        ),
    )
