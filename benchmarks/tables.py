"""The figures as Markdown tables, for the terminal and for the pages alike."""

from __future__ import annotations

import math
from typing import Any, Sequence

from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.tools.assess import Assessment

from . import data
from .generated import SceneScores, worst_kinds
from .generated import mean as scene_mean
from .measure import Scores, TileScore
from .peers import QUOTED, QUOTED_RMSE
from .phases import Range, over_samples
from .sensitivity import Change, Sensitivity

# What stands where there is no figure.
NONE, FAILED = "-", "failed"
FIGURES = {
    "Total error, %": "total_error",
    "Kappa, %": "kappa",
    "Type I error, %": "type_1_error",
    "Type II error, %": "type_2_error",
}
# Title of a table on terrain models, its figure and digits.
DTM_FIGURES = (
    ("RMSE, m", "rmse", 3),
    ("Bias, m", "bias", 3),
    ("95th percentile, m", "percentile_95", 3),
    ("Cells without height, %", "bare", 2),
)
# Title, figure and digits of what is told of scenes.
SCENE_FIGURES = {
    "type I": ("type_1", 2),
    "type II": ("type_2", 2),
    "type II without low plants": ("type_2_high", 2),
    "DTM RMSE": ("dtm_rmse", 3),
    "wrong by 1 m": ("share_wrong_1m", 2),
}
_TOTALS = "mean", "worst"
# Classes of which the share that is kept tells something.
_TELLING = {1: "cars", 3: "low plants", 4: "shrubs", 5: "trees", 6: "buildings", 17: "decks"}
# Name of the tile, then of the filter.
TileScores = dict[str, dict[str, TileScore]]


def table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> list[str]:
    """Return the lines of a table; the first column is text, the others are figures."""
    widths = [max(len(line[column]) for line in (head, *rows)) for column in range(len(head))]

    def line(cells: Sequence[str]) -> str:
        first = cells[0].ljust(widths[0])
        return " | ".join(["| " + first, *map(str.rjust, cells[1:], widths[1:])]) + " |"

    rule = ["-" * widths[0], *("-" * (width - 1) + ":" for width in widths[1:])]
    return [line(head), line(rule), *map(line, rows)]


def label(name: str) -> str:
    """Return how a filter is called in the tables; ours are bold."""
    return f"**{METHODS[name].label}**" if name in METHODS else name


def number(value: float, digits: int) -> str:
    """Return a figure as text; a dash where there is none."""
    return f"{value:.{digits}f}" if math.isfinite(value) else NONE


def ranged(figure: Range) -> str:
    """Return a mean as text, with its range where there is one."""
    if figure.least == figure.most:
        return number(figure.mean, 2)
    return f"{figure.mean:.2f} ({figure.least:.1f} to {figure.most:.1f})"


def isprs(results: Scores, title: str) -> list[str]:
    """Return one figure of every filter on every sample, and the mean: over the phases, (range)."""
    figure = FIGURES[title]
    samples = list(next(iter(results.values())))
    rows = [
        [
            label(name),
            *(ranged(assessments[sample].range(figure)) for sample in samples),
            ranged(over_samples(assessments, figure)),
        ]
        for name, assessments in results.items()
    ]
    return table([title, *(sample.replace("samp", "") for sample in samples), "mean"], rows)


def quoted() -> list[str]:
    """Return the mean figures of the filters that are not measured here."""
    rows = [[f"{name} (quoted)", total, kappa] for name, (total, kappa, _) in QUOTED.items()]
    return table(["Not measured here", "total error, %", "kappa, %"], rows)


def labels(results: TileScores) -> list[str]:
    """Return the total error on the tiles whose labels are trusted, with type I and II errors."""
    rows = []
    for title in (tile.title for tile in data.REAL if tile.is_trusted and tile.title in results):
        found = (results[title][name].assessment for name in _filters(results))
        quoted = (totals.get(title, NONE) for _, _, totals in QUOTED.values())
        rows.append([title, *map(_errors, found), *quoted])
    return table(["Total (I / II), %", *_heads(results), *_quoted(QUOTED)], rows)


def doubtful(results: TileScores) -> list[str]:
    """Return which share of classes that are left out or watched is taken for ground."""
    rows = []
    for tile in data.REAL:
        for value in tile.told if tile.title in results else ():
            shares = (results[tile.title][name].shares for name in _filters(results))
            cells = (number(found.get(value, math.nan), 1) for found in shares)
            rows.append([f"{tile.title}, class {value}", *cells])
    return table(["Taken for ground, %", *_heads(results)], rows)


def dtm(results: TileScores, title: str, figure: str, digits: int) -> list[str]:
    """Return one figure of the terrain models of every filter on every tile."""
    quoted = QUOTED_RMSE if figure == "rmse" else {}
    rows = []
    for tile, scores in results.items():
        models = (scores[name].dtm for name in _filters(results))
        cells = (number(getattr(model, figure), digits) if model else FAILED for model in models)
        rows.append([tile, *cells, *(values.get(tile, NONE) for values in quoted.values())])
    return table([title, *_heads(results), *_quoted(quoted)], rows)


def spikes(results: TileScores) -> list[str]:
    """Return how many spikes and pits the terrain models have, and the sums over all tiles."""
    rows = []
    for tile, scores in results.items():
        models = (scores[name].dtm for name in _filters(results))
        rows.append([tile, *(model.seen if model else FAILED for model in models)])
    sums, per_area = ["all tiles"], ["in 1 km²"]
    for name in _filters(results):
        known = [model for scores in results.values() if (model := scores[name].dtm)]
        area = sum(model.area for model in known) or math.nan
        counts = [sum(getattr(model, kind).count for model in known) for kind in ("spikes", "pits")]
        sums.append(" / ".join(map(str, counts)))
        per_area.append(" / ".join(number(count / area, 0) for count in counts))
    return table(["Spikes / pits (largest)", *_heads(results)], [*rows, sums, per_area])


def _errors(found: Assessment | None) -> str:
    """Return total, type I and type II error as text."""
    if found is None:
        return FAILED
    figures = found.total_error, found.type_1_error, found.type_2_error
    return "{} ({} / {})".format(*(number(figure, 2) for figure in figures))


def _heads(results: TileScores) -> list[str]:
    return list(map(label, _filters(results)))


def _quoted(figures: dict[str, Any]) -> list[str]:
    return [f"{name} (quoted)" for name in figures]


def seconds(results: TileScores) -> list[str]:
    """Return how long the filters took; remembered answers of peers take next to nothing."""
    rows = [
        [label(name), *(number(results[tile][name].seconds, 1) for tile in results)]
        for name in _filters(results)
    ]
    return table(["Seconds, from memory for peers asked before", *results], rows)


def problems(results: TileScores) -> list[str]:
    """Return which filter failed on which tile, and why."""
    return [
        f"{name} on {tile}: {one.problem}"
        for tile, scores in results.items()
        for name, one in scores.items()
        if one.problem
    ]


def sensitivity(rows: Sequence[Sensitivity]) -> list[str]:
    """Return what halving and doubling each default of one filter does."""
    cells = []
    for row in rows:
        unit = f" {row.declaration.unit}" if row.declaration.unit else ""
        default = " to ".join(_ends(row.defaults)) + unit
        line = [row.declaration.label, default + (", chosen" if _is_chosen(row) else "")]
        for change in row.changes:
            line += [_value(change), number(change.total_error, 2), number(change.kappa, 1)]
        cells.append(line)
    head = ["Parameter", "default", "halved", "total", "kappa", "doubled", "total", "kappa"]
    return table(head, cells)


def _filters(results: TileScores) -> list[str]:
    return list(next(iter(results.values())))


def _is_chosen(row: Sensitivity) -> bool:
    return row.declaration.default is None


def _ends(texts: Sequence[str]) -> Sequence[str]:
    """Return the least and the greatest of values as text, or the only one."""
    ordered = sorted(texts, key=lambda text: float(text.split(",")[0]))
    return ordered if len(ordered) == 1 else (ordered[0], ordered[-1])


def _value(change: Change) -> str:
    text = " to ".join(_ends(change.values)) + (" (limit)" if change.is_limited else "")
    return f"{text}, refused" if change.problem else text


def scenes(results: SceneScores, tuning: SceneScores | None = None) -> dict[str, list[str]]:
    """Return the figures of every filter of ours on every kind of scene, the worst kinds last.

    Parameters
    ----------
    results : SceneScores
        What is told in full.
    tuning : SceneScores, optional
        Scores on other seeds, of which only type I and type II errors are told.
    """
    head = ["Kind", "type I, %", "II, %", "II without low plants, %", "DTM RMSE, m"]
    head += ["wrong by 1 m, %", "most kept, %"]
    head += ["tuning: I", "II"] if tuning else []
    return {
        name: table(head, [_scene_row(kind, name, results, tuning) for kind in worst_kinds(kinds)])
        for name, kinds in results.items()
    }


def scene_totals(results: SceneScores) -> list[str]:
    """Return mean and worst of each figure over the kinds."""
    head = ["Over the kinds", *(f"{title}: {what}" for title in SCENE_FIGURES for what in _TOTALS)]
    rows = []
    for name, kinds in results.items():
        cells = [label(name)]
        for figure, digits in SCENE_FIGURES.values():
            values = [scene_mean(scores, figure) for scores in kinds.values()]
            values = [value for value in values if math.isfinite(value)] or [math.nan]
            cells += [number(sum(values) / len(values), digits), number(max(values), digits)]
        rows.append(cells)
    return table(head, rows)


def _scene_row(kind: str, name: str, results: SceneScores, tuning: SceneScores | None) -> list[str]:
    scores = results[name][kind]
    row = [kind]
    for figure, digits in SCENE_FIGURES.values():
        row.append(number(scene_mean(scores, figure), digits))
    kept: dict[int, list[float]] = {}
    for value, share in (pair for score in scores for pair in score.kept.items()):
        if value in _TELLING:
            kept.setdefault(value, []).append(share)
    means = {value: sum(shares) / len(shares) for value, shares in kept.items()}
    worst = max(means, key=means.get, default=None)
    row.append(NONE if worst is None else f"{_TELLING[worst]} {means[worst]:.0f}")
    if tuning:
        row += [
            number(scene_mean(tuning[name][kind], figure), 2) for figure in ("type_1", "type_2")
        ]
    return row
