"""The page of a comparison with checkpoints: a single HTML file."""

from __future__ import annotations

import numpy as np

from ..survey.files import Survey
from .accuracy import Figures
from .checkpoint_results import COLOURS, COUNTED, NOT_COUNTED, REASONS, Check, Residuals, limits_of
from .page import key, page_html, round_length, text

_BARS = 15
# Sizes of the drawings in pixels.
_WIDTH, _HEIGHT, _BELOW, _LEFT = 800, 180, 40, 46
_TALLEST = 900
_MOST_ROWS = 1000
_STYLE = """
svg { width: 100%; max-width: 860px; height: auto; }
blockquote { margin: 1em 0; padding: .4em 1em; border-left: 4px solid #888; background: #f6f6f6; }
.doubt { padding: .4em 1em; border-left: 4px solid #b2182b; background: #fdecea; }
"""


def checkpoint_html(check: Check, found: Residuals | None, survey: Survey) -> str:
    """Return the page of a comparison of files with checkpoints and their errors, if any."""
    files = [each.path for each in survey.tiles]
    more = f" and {len(files) - 1:,} more" if files[1:] else ""
    parts = [f'<p class="files">Points: {text(files[0].name)}{more}</p>']
    if found is not None:
        parts += [_summary(check), _histogram(check, found), _map(check, found, survey)]
        parts += [_others(check), _largest(check), _table(found, survey)]
    if check.hold_out is not None:
        parts.append(_held_out(check))
    return page_html("Check against checkpoints", "\n".join(parts), _STYLE)


def _summary(check: Check) -> str:
    rows = {
        "Ground points, without vegetation (NVA)": check.nva,
        "Ground points, with vegetation (VVA)": check.vva,
        "Terrain model, without vegetation (NVA)": check.dtm_nva,
        "Terrain model, with vegetation (VVA)": check.dtm_vva,
    }
    count = 0 if check.nva is None else check.nva.count
    words = [
        f"{check.counted:,} of {check.checkpoint_count:,} checkpoints are counted, {count:,} of"
        f" them on land without vegetation. The standard asks for at least {check.needed} of these."
    ]
    if check.verdict and not check.doubt:
        words.append(check.verdict)
    if check.shift is not None:
        words.append(
            f"The mean difference would be removed by a shift of {-check.shift:+.3f} m. Nothing was"
            " shifted."
        )
    doubt = f'<p class="doubt">{text(check.doubt)}</p>' if check.doubt else ""
    quotes = {"": check.statement, "Terrain model: ": check.dtm_statement}
    said = "".join(
        f"<blockquote>{whose}{text(each)}</blockquote>" for whose, each in quotes.items() if each
    )
    return f"""{doubt}<p>{text(" ".join(words))}</p>
{said}
<h2>Figures</h2>
{_figures(rows)}
<p>Height of the data minus height of the checkpoint, in metres. RMSE is that of the differences;
the total adds the error of the survey of the checkpoints.</p>"""


def _figures(rows: dict[str, Figures | None]) -> str:
    cells = []
    for name, each in rows.items():
        if each is None:
            continue
        values = (
            f"{each.rmse:.3f}", f"{each.total_rmse:.3f}", f"{each.mean:+.3f}",
            f"{each.median:+.3f}", f"{each.standard_deviation:.3f}", f"{each.minimum:+.3f}",
            f"{each.maximum:+.3f}", f"{each.percentile_95:.3f}",
        )  # fmt: skip
        row = "".join(f"<td>{value}</td>" for value in (f"{each.count:,}", *values))
        cells.append(f'<tr><th class="text">{name}</th>{row}</tr>')
    return f"""<table>
<tr><th></th><th>Count</th><th>RMSE</th><th>Total</th><th>Mean</th><th>Median</th>
<th>Standard deviation</th><th>Lowest</th><th>Highest</th><th>95 % within</th></tr>
{chr(10).join(cells)}
</table>"""


def _colour(error: float, scale: float) -> str:
    return COLOURS[int(np.searchsorted(limits_of(scale), error))]


def _histogram(check: Check, found: Residuals) -> str:
    errors, limit = found.errors[found.counted], check.scale
    edges = np.linspace(-limit, limit, _BARS + 1)
    counts, _ = np.histogram(np.clip(errors, -limit, limit), edges)
    wide, highest = _WIDTH / _BARS, max(int(counts.max()), 1)
    bars, labels = [], []
    for number, count in enumerate(counts.tolist()):
        tall = count / highest * _HEIGHT
        colour = _colour(float(edges[number] + edges[number + 1]) / 2.0, limit)
        bars.append(
            f'<rect x="{number * wide:.1f}" y="{_HEIGHT - tall:.1f}" width="{wide - 2:.1f}"'
            f' height="{tall:.1f}" fill="{colour}" stroke="#555"/>'
        )
        if count:
            labels.append(
                f'<text x="{(number + 0.5) * wide:.1f}" y="{_HEIGHT - tall - 4:.1f}">{count}</text>'
            )
    for share in (-1.0, -0.5, 0.0, 0.5, 1.0):
        labels.append(
            f'<text x="{(share + 1.0) / 2.0 * _WIDTH:.1f}" y="{_HEIGHT + 18}">'
            f"{share * limit:+g} m</text>"
        )
    return f"""<h2>How the differences are distributed</h2>
<svg viewBox="{-_LEFT} -20 {_WIDTH + 2 * _LEFT} {_HEIGHT + _BELOW + 20}" role="img"
 aria-label="Histogram of the differences"><path d="M0 {_HEIGHT}H{_WIDTH}" stroke="#555"/>
{"".join(bars)}<g font-size="12" fill="#333" text-anchor="middle">{"".join(labels)}</g></svg>
<p>Ground points minus checkpoints. The outermost bars hold what lies beyond them.</p>"""


def _map(check: Check, found: Residuals, survey: Survey) -> str:
    x, y, _ = found.checkpoints.xyz.T
    boxes = np.array([each.outer_box for each in survey.tiles])
    west, south = np.minimum(boxes[:, :2].min(axis=0), (x.min(), y.min())).tolist()
    east, north = np.maximum(boxes[:, 2:].max(axis=0), (x.max(), y.max())).tolist()
    scale = min(_WIDTH / max(east - west, 1e-6), _TALLEST / max(north - south, 1e-6))
    high, limit = (north - south) * scale, check.scale
    drawn = [
        f'<rect x="{(a - west) * scale:.1f}" y="{(north - d) * scale:.1f}"'
        f' width="{(c - a) * scale:.1f}" height="{(d - b) * scale:.1f}"/>'
        for a, b, c, d in boxes.tolist()
    ]
    marks = []
    for place in range(len(x)):
        is_counted = found.states[place] == COUNTED
        error = float(found.errors[place])
        colour = _colour(error, limit) if is_counted else NOT_COUNTED
        what = f"{error:+.3f} m" if is_counted else REASONS[found.states[place]]
        marks.append(
            f'<circle cx="{(x[place] - west) * scale:.1f}" cy="{(north - y[place]) * scale:.1f}"'
            f' r="7" fill="{colour}"><title>{text(found.checkpoints.names[place])}: {what}</title>'
            "</circle>"
        )
    legend = "".join(key(colour, words) for colour, words in zip(COLOURS, _ranges(limit))) + key(
        NOT_COUNTED, "not counted"
    )
    unit = survey.crs.horizontal_unit
    length = round_length((east - west) / 4 or 1.0)
    bar = f'<path d="M0 {high + 16:.0f}h{length * scale:.1f}" stroke="#222" stroke-width="3"/>'
    name = f"{length:g} {'m' if unit == 1.0 else 'units of the CRS'}"
    return f"""<h2>Where the differences are</h2>
<svg viewBox="-10 -10 {_WIDTH + 20} {high + 50:.0f}" role="img" aria-label="Map of the differences">
<g fill="#f2efe9" stroke="#bbb">{"".join(drawn)}</g>
<g stroke="#333">{"".join(marks)}</g>{bar}
<text x="0" y="{high + 34:.0f}" font-size="12" fill="#333">{name}</text></svg>
<p>{legend}</p>
<p>North is up. The rectangles are the files.</p>"""


def _ranges(limit: float) -> list[str]:
    """Return what the colours mean."""
    first, second, third, fourth = (f"{each:+.3g}" for each in limits_of(limit))
    return [
        f"below {first} m", f"{first} to {second} m", f"{second} to {third} m",
        f"{third} to {fourth} m", f"above {fourth} m",
    ]  # fmt: skip


def _others(check: Check) -> str:
    return _unknown(check) + _not_counted(check)


def _unknown(check: Check) -> str:
    if not check.unknown_covers:
        return ""
    rows = "".join(
        f'<tr><td class="text">{text(name)}</td><td>{count:,}</td></tr>'
        for name, count in check.unknown_covers.items()
    )
    return f"""<h2>Land covers that are not known</h2>
<p>They count as land without vegetation (NVA).</p>
<table><tr><th class="text">Land cover</th><th>Checkpoints</th></tr>
{rows}</table>
"""


def _not_counted(check: Check) -> str:
    if not check.not_counted:
        return ""
    rows = "".join(
        f'<tr><td class="text">{REASONS[reason]}</td><td>{len(names):,}</td>'
        f'<td class="text">{text(", ".join(names[:_MOST_ROWS]))}</td></tr>'
        for reason, names in check.not_counted.items()
    )
    return f"""<h2>Not counted</h2>
<table><tr><th class="text">Why</th><th>Count</th><th class="text">Checkpoints</th></tr>
{rows}</table>"""


def _largest(check: Check) -> str:
    worst = ", ".join(
        f"{text(each['name'])} ({each['error']:+.3f} m)" for each in check.largest or ()
    )
    return f"<h2>Largest differences</h2>\n<p>{worst}</p>"


def _table(found: Residuals, survey: Survey) -> str:
    points, rows = found.checkpoints, []
    has_dtm = bool(np.isfinite(found.dtm).any())
    for place, (x, y, z) in enumerate(points.xyz[:_MOST_ROWS].tolist()):
        is_counted = found.states[place] == COUNTED
        values = [f"{x:.2f}", f"{y:.2f}", f"{z:.3f}", *map(_number, (
            found.ground[place], found.errors[place]))]  # fmt: skip
        if has_dtm:
            values += map(_number, (found.dtm[place], found.dtm_errors[place]))
        words = (found.written[place], found.kinds[place])
        state = "" if is_counted else REASONS[found.states[place]]
        cells = [f'<td class="text">{text(each)}</td>' for each in (points.names[place], *words)]
        cells += [f"<td>{each}</td>" for each in values] + [f'<td class="text">{state}</td>']
        rows.append(f"<tr>{''.join(cells)}</tr>")
    more = len(points.names) - len(rows)
    left = f"<p>{more:,} more are in the table that can be written.</p>" if more else ""
    dtm = "<th>Terrain model</th><th>Difference, m</th>" if has_dtm else ""
    return f"""<h2>Checkpoints</h2>
<table><tr><th class="text">Name</th><th class="text">Land cover</th><th class="text">Kind</th>
<th>x</th><th>y</th><th>z</th><th>Ground</th><th>Difference, m</th>{dtm}
<th class="text">Not counted</th></tr>
{chr(10).join(rows)}</table>
<p>x, y and heights are in the units of the CRS: {text(survey.crs.name or "not stated")}.</p>
{left}"""


def _number(value: float) -> str:
    return "" if np.isnan(value) else f"{value:.3f}"


def _held_out(check: Check) -> str:
    left = check.hold_out
    if left is None:
        return ""
    rows = {
        "All": left.all, "Open land": left.open, "Under trees": left.under_trees,
        "Steeper than 20 degrees": left.steep,
    }  # fmt: skip
    return f"""<h2>Ground points that were held out</h2>
<p>{left.left_out:,} ground points ({100 * left.share:g} %) were left out of the TIN;
{left.no_height:,} of those that were looked at lie in voids of the others.</p>
{_figures(rows)}
<p>TIN of the other ground points minus the point, in metres. {text(left.limits())} If all points
lie 10 cm too high, it does not show either.</p>"""
