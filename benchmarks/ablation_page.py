"""The tables of what each rule is worth, and docs/rules.md."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np

from bare_earth.algorithms.filters import METHODS

from . import tables
from .phases import Range
from .rules import BASE, GROUPS, VALUES, lines, variants
from .scenes import KINDS as KINDS_OF_SCENES

# Kinds of places where rules are measured.
KINDS = "isprs", "real", "scene"
PAGE = Path(__file__).parents[1] / "docs" / "rules.md"
COMMENTS = Path(__file__).parent / "rules_comments.md"
# Tiles on which the terrain below trees is looked at.
FORESTS = (
    "megaplot", "forest_topography", "mixed_conifer", "oregon_conifer", "conifer_1", "conifer_2",
    "mountain_forest", "rainforest_ridge", "hawaii_forest",
)  # fmt: skip
# A scene is worse if its type I or type II error is larger by more than so many points.
_WORSE = 1.0
_HEAD = (
    "Left out", "lines", "CPU, %", "ISPRS", "labels: worst", "best", "DTM: worst",
    "best", "forests: RMSE", "bias", "scenes worse", "better", "the worst",
)  # fmt: skip
_ABOUT = """# What each rule is worth

The filters are pipelines of rules. Here each rule is left out, alone and in groups, and everything
is measured again. A rule is worth its code if errors get worse without it, above all on real land.

- *lines*: lines of the class of the rule, and of those that are exceptions of it alone. Helpers that
  several rules may use do not count.
- *CPU*: share of the time of the whole filter on {timed} that is saved, in percent, good to about 5
  points.
- *ISPRS*: change of the mean total error of {samples} samples, in percentage points, over {phases}
  positions of the grid. Bold if it is larger than the range of the base over these positions.
- *labels*: the real tiles on which the total error changes most, in percentage points. Tiles:
  {labels}.
- *DTM*: the real tiles on which the RMSE of the terrain model changes most, in metres. Tiles:
  {models}.
- *forests*: mean change of RMSE and of bias (the mean signed difference from the reference) of
  terrain models below trees, in metres. Tiles: {forests}.
- *scenes*: generated scenes ({scenes}) whose type I or type II error gets worse, or better, by more
  than one point without the rule, and the worst of them. Nobody tuned with their seeds.

A positive change is a loss without the rule. 0 is less than can be printed. A rule may be worth
nothing alone and something in a group, where no other stands in for it. The command
`python -m benchmarks.ablation --write` makes this page; this one is {form}.
"""

# Figures of a variant at a place, by name.
Figures = dict[str, float]
# Title of the place, then name of the variant.
Places = dict[str, dict[str, Figures]]
# Name of the method, then as above.
Results = dict[str, Places]


class _Change(NamedTuple):
    """The change of a figure at a place."""

    place: str
    value: float


def _changes(results: Places, name: str, kind: str, figure: str) -> list[_Change]:
    """Return the changes of a figure wherever both the base and the variant are known."""
    found = []
    for title, by_variant in results.items():
        base, changed = by_variant.get(BASE), by_variant.get(name)
        if title.startswith(f"{kind} ") and base and changed and figure in base:
            found.append(_Change(title.split(" ", 1)[1], changed[figure] - base[figure]))
    return sorted(found, key=lambda each: each.value)


def _by_phase(results: Places, name: str) -> np.ndarray:
    """Return the mean total error over the samples in each phase."""
    totals: dict[str, list[float]] = {}
    for title, by_variant in results.items():
        if title.startswith("isprs ") and {name, BASE} <= by_variant.keys():
            phase = title.split(" ", 2)[2]
            totals.setdefault(phase, []).append(by_variant[name]["total"])
    return np.array([np.mean(each) for each in totals.values()])


def _mean(values: list[float], digits: int) -> str:
    return f"{np.mean(values):.{digits}f}" if values else tables.NONE


def _signed(value: float, digits: int) -> str:
    return f"{value:+.{digits}f}" if abs(value) >= 0.5 * 10**-digits else "0"


def _isprs(results: Places, name: str) -> str:
    base, changed = (_by_phase(results, variant) for variant in (BASE, name))
    if not len(changed) or len(base) != len(changed):
        return tables.NONE
    change = float(np.mean(changed - base))
    text = _signed(change, 2)
    return f"**{text}**" if abs(change) > np.ptp(base) else text


def _ends(changes: list[_Change], digits: int) -> list[str]:
    """Return the worst and the best change as text, each with its tile."""
    if not changes:
        return [tables.NONE] * 2
    texts = []
    for each, sign in ((changes[-1], 1.0), (changes[0], -1.0)):
        text = _signed(each.value, digits)
        is_none = text == "0" or sign * each.value < 0.0
        texts.append(tables.NONE if is_none else f"{each.place} {text}")
    return texts


def _of_forests(results: Places, name: str, figure: str) -> str:
    some = [each.value for each in _changes(results, name, "real", figure) if each.place in FORESTS]
    return _signed(float(np.mean(some)), 3) if some else tables.NONE


def _of_scenes(results: Places, name: str) -> list[str]:
    """Return how many scenes get worse and better, and the worst as text."""
    worse, better, worst = set(), set(), _Change("", _WORSE)
    for figure, short in (("type_1", "I"), ("type_2", "II")):
        for each in _changes(results, name, "scene", figure):
            if each.value > _WORSE:
                worse.add(each.place)
            elif each.value < -_WORSE:
                better.add(each.place)
            if each.value > worst.value:
                worst = _Change(f"{each.place.split()[0]} {short}", each.value)
    text = f"{worst.place} {worst.value:+.1f}" if worst.place else tables.NONE
    return [str(len(worse)), str(len(better)), text]


def _saved(results: Places, name: str) -> str:
    for by_variant in results.values():
        found = by_variant.get(name, {})
        if "cpu" in found:
            return f"{100.0 * (1.0 - found['cpu'] / found['cpu_base']):.0f}"
    return tables.NONE


def _row(results: Places, method: str, name: str) -> list[str]:
    return [
        name,
        str(lines(method, name) or tables.NONE),
        _saved(results, name),
        _isprs(results, name),
        *_ends(_changes(results, name, "real", "total"), 2),
        *_ends(_changes(results, name, "real", "rmse"), 3),
        _of_forests(results, name, "rmse"),
        _of_forests(results, name, "bias"),
        *_of_scenes(results, name),
    ]


def table(results: Places, method: str) -> list[str]:
    """Return what each change of a method does: of those that were measured somewhere."""
    known = {name for by_variant in results.values() for name in by_variant}
    names = [name for name in variants(method) if name in known and name != BASE]
    return tables.table(_HEAD, [_row(results, method, name) for name in names])


def _bases(results: Results) -> list[str]:
    """Return the figures of the filters with all rules."""
    rows = []
    for method, of_method in results.items():
        phases = _by_phase(of_method, BASE)
        real = {
            title.split(" ", 1)[1]: by_variant[BASE]
            for title, by_variant in of_method.items()
            if title.startswith("real ") and BASE in by_variant
        }
        forests = [real[each] for each in FORESTS if each in real]
        totals = [each["total"] for each in real.values() if "total" in each]
        rows.append(
            [
                METHODS[method].label,
                tables.ranged(Range.of(phases)) if len(phases) else tables.NONE,
                _mean(totals, 2),
                *(_mean([each[key] for each in forests], 3) for key in ("rmse", "bias")),
                *(str(len(_titles({method: of_method}, kind))) for kind in KINDS),
            ]
        )
    head = ["All rules", "ISPRS total error, %", "tiles with labels, %", "forests: RMSE, m", "bias"]
    head += ["samples and phases", "tiles", "scenes"]
    return tables.table(head, rows)


def _titles(results: Results, kind: str, figure: str = "") -> list[str]:
    """Return the places of a kind that were measured, and have a figure."""
    found = {}
    for title, by_variant in (each for places in results.values() for each in places.items()):
        base = by_variant.get(BASE)
        if title.startswith(f"{kind} ") and base and (not figure or figure in base):
            found[title.split(" ", 1)[1]] = None
    return list(found)


def write(results: Results, is_quick: bool, page: Path | None = None) -> None:
    """Write the page, with the comments as they stand in their file.

    Parameters
    ----------
    results : Results
        What was measured; a method of which nothing was measured is left out.
    is_quick : bool
        Whether it is the quick form.
    page : Path, optional
        Where to; docs/rules.md by default.
    """
    results = {method: places for method, places in results.items() if any(places.values())}
    samples = [each.split(" ", 1) for each in _titles(results, "isprs")]
    models = _titles(results, "real", "rmse")
    text = [
        _ABOUT.format(
            timed=", ".join(_titles(results, "real", "cpu")) or tables.NONE,
            samples=len({name for name, _ in samples}),
            phases=len({phase for _, phase in samples}),
            labels=", ".join(_titles(results, "real", "total")),
            models=", ".join(models),
            forests=", ".join(each for each in FORESTS if each in models),
            scenes=f"{len(_titles(results, 'scene'))} of {len(KINDS_OF_SCENES)} kinds",
            form="its quick form, `--quick`" if is_quick else "its full form",
        ),
        *_bases(results),
    ]
    for method, of_method in results.items():
        text += ["", f"## {METHODS[method].label}", "", *table(of_method, method)]
    text += ["", "## Groups and values", ""]
    text += [f"- *{name}*: {', '.join(GROUPS[name])}." for name in GROUPS]
    for name, (kind, values) in VALUES.items():
        given = ", ".join(f"`{field}` {value}" for field, value in values.items())
        text.append(f"- *{name}*: {kind.name} with {given}.")
    if COMMENTS.exists():
        text += ["", COMMENTS.read_text("utf-8").rstrip()]
    (page or PAGE).write_text("\n".join(text) + "\n", "utf-8")
