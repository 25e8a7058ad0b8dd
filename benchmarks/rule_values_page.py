"""The table of each value of the rules in results/rules_comments.md."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any, Iterator, NamedTuple, Sequence

from . import marked
from .rule_numbers import RULE, Value

PAGE = Path(__file__).parent / "results" / "rules_comments.md"
NAME = "values"
_HEAD = ("Rule or file", "Value", "Protects", "Takes", "How it was found")
# Percentage points of the total error of a tile that count.
_LEAST = 0.05
_UNTRIED = "not measured"
# What the ablation measures.
ABLATION = PAGE.with_name("rules.md")
_ONE = re.compile(r"`([^`]+)` ([^;]*)")


class Row(NamedTuple):
    """Values of a rule or a file that one row is about."""

    owner: str
    values: tuple[tuple[str, str], ...]  # name, and what it is as text
    protects: str
    takes: str
    how: str

    def line(self) -> str:
        """Return the line of the table."""
        told = "; ".join(f"`{name}` {text}" for name, text in self.values)
        return f"| {self.owner} | {told} | {self.protects} | {self.takes} | {self.how} |"


def as_text(value: Any) -> str:
    """Return a number or several in few digits; off and on for what is either."""
    if isinstance(value, tuple):
        return "(" + ", ".join(map(as_text, value)) + ")"
    if isinstance(value, bool):
        return "on" if value else "off"
    return f"{value:.6g}"


def now(value: Value) -> str:
    """Return what a value of a rule is, with all that it is in different methods."""
    return " or ".join(map(as_text, value.now)) or "-"


def read(page: Path = PAGE) -> list[Row]:
    """Return the rows of the page."""
    found = []
    lines = [line for line in marked.held(page, NAME) if line.startswith("|")]
    for line in lines[2:]:
        owner, values, *texts = (cell.strip() for cell in line.strip().strip("|").split(" | "))
        named = tuple((name, text.strip()) for name, text in _ONE.findall(values))
        found.append(Row(owner, named, *(*texts, "", "", "")[:3]))
    return found


def problems(values: Sequence[Value], page: Path = PAGE) -> list[str]:
    """Return what the page does not tell of the values, or tells wrongly, or needs no more."""
    told = {(row.owner, name): (text, row) for row in read(page) for name, text in row.values}
    found = []
    for value in values:
        text, row = told.pop((value.owner, value.name), ("", None))
        if row is None:
            found.append(f"{value.title} has no row.")
        elif text != now(value):
            found.append(f"{value.title} is {now(value)}, not {text}: measure it again.")
        elif not (row.protects and row.takes and row.how):
            found.append(f"{value.title}: what it protects, what it takes, or how it was found?")
    return found + [f"{owner}.{name} is gone, but not its row." for owner, name in told]


def _rows(count: str) -> str:
    return "" if count == "0" else f"{count} row" + "s" * (count != "1")


def of_rules(page: Path = ABLATION) -> dict[str, tuple[str, str]]:
    """Return what each rule protects and takes by the page of the ablation, in the first of the
    methods that has it.
    """
    found: dict[str, tuple[str, str]] = {}
    for line in page.read_text("utf-8").splitlines():
        cells = [cell.strip().strip("*") for cell in line.strip().strip("|").split(" | ")]
        if len(cells) < 13 or cells[0] in found or not cells[-1].isdigit():
            continue
        name, _, _, isprs, worst, best, _, wrong, right, _, _, protects, takes = cells
        losses = [_rows(protects), f"ISPRS {isprs}" * isprs.startswith("+"), worst, f"{wrong} m"]
        gains = [_rows(takes), f"ISPRS {isprs}" * isprs.startswith("-"), best, f"{right} m"]
        told = ("; ".join(one for one in some if one.strip("- m")) for some in (losses, gains))
        protected, taken = (text or "nothing" for text in told)
        found[name] = protected, taken
    return found


def _kind(place: str) -> str:
    return re.split(r"-[\d.]", place, maxsplit=1)[0]


def measured(found: dict[tuple[str, float], dict[str, Any]]) -> tuple[str, str]:
    """Return what a value protects and takes, given the figures of all places by method and
    factor.
    """
    if not found:
        return _UNTRIED, _UNTRIED
    protects, takes, most = [], [], 0.0
    for factor in dict.fromkeys(factor for _, factor in found):
        losses, gains = [], []
        for (_, of_factor), places in found.items():
            for place, (share, totals, helds) in places.items() if of_factor == factor else ():
                most = max(most, share)
                if share < 0:
                    losses.append("does not run")
                elif helds and helds[0] != helds[1]:
                    (losses if helds[0] else gains).append(_kind(place))
                elif totals and None not in totals and abs(totals[1] - totals[0]) >= _LEAST:
                    change = totals[1] - totals[0]
                    (losses if change > 0 else gains).append(f"{place} {abs(change):.2f}")
        for texts, into in ((losses, protects), (gains, takes)):
            if texts:
                into.append(f"x{factor:g}: {', '.join(dict.fromkeys(texts))}")
    if not protects and not takes:
        nothing = "no label" if most == 0.0 else f"labels only, {max(most, 0.01):.2f} % at most"
        return nothing, "nothing"
    return "; ".join(protects) or "nothing", "; ".join(takes) or "nothing"


def rows(values: Sequence[Value], figures: dict[str, Any], known: Sequence[Row]) -> Iterator[Row]:
    """Yield the rows: those of one rule that say the same are one."""
    told = {(row.owner, name): (row, text) for row in known for name, text in row.values}
    whole = of_rules()
    merged: dict[tuple[str, ...], list[tuple[str, str]]] = {}
    for value in values:
        row, text = told.get((value.owner, value.name), (Row(value.owner, (), "", "", ""), ""))
        found = measured(figures.get(value.title, {}))
        if value.name == RULE and value.owner in whole:
            found = whole[value.owner]
        if found[0] == _UNTRIED and row.protects and text == now(value):
            found = row.protects, row.takes
        key = (value.owner, *found, row.how)
        merged.setdefault(key, []).append((value.name, now(value)))
    for (owner, protects, takes, how), some in merged.items():
        yield Row(owner, tuple(some), protects, takes, how)


def write(values: Sequence[Value], figures: dict[str, Any], page: Path = PAGE) -> None:
    """Write the table, whose last column stays as it is."""
    lines = [row.line() for row in rows(values, figures, read(page))]
    head = f"| {' | '.join(_HEAD)} |"
    places = {place for one in figures.values() for found in one.values() for place in found}
    told = f"Measured at {len(places)} places: {', '.join(sorted(places))}."
    before = [line for line in marked.held(page, NAME)[:1] if line[:1] != "|"]
    # Some values, measured elsewhere, do not tell where the others were.
    is_whole = 2 * len(figures) > len(values)
    first = [told] if is_whole else before
    marked.fill(page, NAME, [*first, *[""] * len(first), head, "|" + "---|" * len(_HEAD), *lines])
