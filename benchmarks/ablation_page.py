"""The tables of what each rule is worth, and results/rules.md."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from bare_earth.algorithms.filters import METHODS

from . import tables
from .phases import Range
from .rules import BASE, GROUPS, VALUES, lines, variants

# Kinds of places where rules are measured.
KINDS = "isprs", "real", "plain"
PAGE = Path(__file__).parent / "results" / "rules.md"
_HEAD = (
    "Left out", "lines", "CPU, %", "ISPRS", "labels: worst", "best", "RMSE, %", "DTM: worst",
    "best", "spikes", "pits", "protects", "takes",
)  # fmt: skip
_BASE_HEAD = (
    "All rules", "ISPRS total error, %", "tiles with labels, %", "DTM: RMSE, m", "spikes", "pits",
    "samples and phases", "tiles", "plain things", "of them held",
)  # fmt: skip
_ABOUT = """# What each rule is worth

The filters are pipelines of rules. Here each rule is left out, alone and in groups, and everything
is measured again. A rule is worth its code if errors get worse without it, above all on real land.

- *lines*: of the class of the rule, and of the rules that are its fields; helpers do not count.
- *CPU*: share of the time of the filter on {timed} that is saved, in percent. On a machine
  with other work up to 15 points are chance.
- *ISPRS*: change of the mean total error of {samples} samples, in percentage points, over {phases}
  positions of the grid. Bold if it is larger than the range of the base over these positions.
- *labels*: the real tiles on which the total error changes most, in percentage points, of {labels}.
- *RMSE*: change of the RMSE of the terrain models in percent, the geometric mean over all tiles.
- *DTM*: the real tiles on which the RMSE of the terrain model changes most, in metres, of {models}.
- *spikes*, *pits*: change of their number on all tiles: connected places of 3 m² and more where the
  terrain model is over 1 m above, or below, that of the reference.

- *protects*, *takes*: plain things (`python -m benchmarks.plain`, {plain} rows) that come out right
  only with the rule, and only without it.

A positive change is a loss without the rule. 0 is less than can be printed. A rule may be worth
nothing alone and something in a group, where no other stands in for it. The command
`python -m benchmarks.ablation --write` makes this page; this one is {form}.
[Comments](rules_comments.md) tell what each rule was made for, and what was tried in vain.
"""

# Figures of a variant at a place, by name.
Figures = dict[str, float]
# Kind and name of the place, then name of the variant.
Places = dict[tuple[str, str], dict[str, Figures]]
# Name of the method, then as above.
Results = dict[str, Places]


def _of(places: Places, name: str, kind: str, figure: str) -> dict[str, float]:
    """Return a figure of a variant at the places of a kind that have it."""
    return {
        place: found[name][figure]
        for (of_kind, place), found in places.items()
        if of_kind == kind and figure in found.get(name, ())
    }


def _changes(places: Places, name: str, kind: str, figure: str) -> dict[str, float]:
    """Return by how much a figure changes, the best first."""
    base, found = (_of(places, variant, kind, figure) for variant in (BASE, name))
    changes = {place: value - base[place] for place, value in found.items()}
    return dict(sorted(changes.items(), key=lambda change: change[1]))


def _signed(value: float, digits: int) -> str:
    return f"{value:+.{digits}f}" if abs(value) >= 0.5 * 10**-digits else "0"


def _of_samples(places: Places, name: str) -> str:
    """Return the mean change on the samples, bold if larger than the range of the phases."""
    changes = list(_changes(places, name, "isprs", "total").values())
    if not changes:
        return tables.NONE
    change, range_ = float(np.mean(changes)), _phases(places)
    text = _signed(change, 2)
    return f"**{text}**" if abs(change) > range_.most - range_.least else text


def _phases(places: Places) -> Range:
    """Return the mean total error of all rules over the samples, with its range over the phases."""
    totals: dict[str, list[float]] = {}
    for place, value in _of(places, BASE, "isprs", "total").items():
        totals.setdefault(place.split(" ", 1)[1], []).append(value)
    return Range.of(np.array([sum(some) / len(some) for some in totals.values()] or [np.nan]))


def _ends(changes: dict[str, float], digits: int) -> list[str]:
    """Return the worst change, if it is a loss, and the best, if it is a gain, as text."""
    signed = [(place, _signed(value, digits)) for place, value in changes.items()]
    worst, best = signed[-1:], signed[:1]
    return [
        " ".join(*found) if found and found[0][1][0] == sign else tables.NONE
        for found, sign in ((worst, "+"), (best, "-"))
    ]


def _of_models(places: Places, name: str) -> str:
    """Return the change of the geometric mean of the RMSE of all terrain models, in percent."""
    base, found = (_of(places, variant, "real", "rmse") for variant in (BASE, name))
    if not found:
        return tables.NONE
    ratios = [np.log(max(value, 1e-6) / max(base[place], 1e-6)) for place, value in found.items()]
    return _signed(100.0 * (np.exp(np.mean(ratios)) - 1.0), 1)


def _summed(places: Places, name: str, figure: str) -> str:
    """Return by how many the spikes or pits of all tiles change."""
    changes = _changes(places, name, "real", figure)
    return _signed(sum(changes.values()), 0) if changes else tables.NONE


def _counted(places: Places, name: str, figure: str) -> str:
    """Return a sum over all plain things."""
    found = _of(places, name, "plain", figure)
    return f"{sum(found.values()):.0f}" if found else tables.NONE


def _saved(places: Places, name: str) -> str:
    for place, seconds in _of(places, name, "real", "cpu").items():
        return f"{100.0 * (1.0 - seconds / _of(places, name, 'real', 'cpu_base')[place]):.0f}"
    return tables.NONE


def table(places: Places, method: str) -> list[str]:
    """Return what each change of a method does: of those that were measured somewhere."""
    known = {name for found in places.values() for name in found}
    rows = [
        [
            name,
            str(lines(method, name) or tables.NONE),
            _saved(places, name),
            _of_samples(places, name),
            *_ends(_changes(places, name, "real", "total"), 2),
            _of_models(places, name),
            *_ends(_changes(places, name, "real", "rmse"), 3),
            *(_summed(places, name, figure) for figure in ("spikes", "pits")),
            *(_counted(places, name, figure) for figure in ("protects", "takes")),
        ]
        for name in (*variants(method), *sorted(name for name in known if "=" in name))
        if name in known and name != BASE
    ]
    return tables.table(_HEAD, rows)


def _base(method: str, places: Places) -> list[str]:
    """Return the figures of a method with all rules."""
    real = (list(_of(places, BASE, "real", figure).values()) for figure in ("total", "rmse"))
    return [
        METHODS[method].label,
        tables.ranged(_phases(places)),
        *(f"{np.mean(found):.3f}" if found else tables.NONE for found in real),
        *(
            f"{sum(_of(places, BASE, 'real', figure).values()):.0f}"
            for figure in ("spikes", "pits")
        ),
        *(str(sum(kind == of_kind for of_kind, _ in places)) for kind in KINDS[:2]),
        *(_counted(places, BASE, figure) for figure in ("rows", "held")),
    ]


def write(results: Results, is_quick: bool) -> None:
    """Write the page."""
    everywhere = {place: found for places in results.values() for place, found in places.items()}
    samples = [place.split(" ", 1) for kind, place in everywhere if kind == "isprs"]
    text = [
        _ABOUT.format(
            timed=", ".join(_of(everywhere, BASE, "real", "cpu")) or tables.NONE,
            samples=len({name for name, _ in samples}),
            phases=len({phase for _, phase in samples}),
            labels=", ".join(_of(everywhere, BASE, "real", "total")),
            plain=max((_counted(places, BASE, "rows") for places in results.values()), key=len),
            models=", ".join(_of(everywhere, BASE, "real", "rmse")),
            form="its quick form, `--quick`" if is_quick else "its full form",
        ),
        *tables.table(_BASE_HEAD, [_base(method, places) for method, places in results.items()]),
    ]
    for method, places in results.items():
        text += ["", f"## {METHODS[method].label}", "", *table(places, method)]
    text += ["", "Groups and values:", ""]
    text += [f"- *{name}*: {', '.join(GROUPS[name])}." for name in GROUPS]
    for name, (kind, values) in VALUES.items():
        given = ", ".join(f"`{field}` {value}" for field, value in values.items())
        text.append(f"- *{name}*: {kind.name} with {given}.")
    PAGE.write_text("\n".join(text) + "\n", "utf-8")
