"""The page of the plain things, results/plain.md, and its table in the manual."""

from __future__ import annotations

from pathlib import Path
from typing import Sequence

from bare_earth.algorithms.filters import METHODS

from . import marked, peers, tables
from .scenes.plain import KINDS, Kind, rows

PAGE = Path(__file__).parent / "results" / "plain.md"
MANUAL = Path(__file__).parents[1] / "docs" / "comparison.md"
# What the manual tells together, by how the things are made.
_GROUPS = {
    "earth: hollows, ditches, rocks, dykes, banks, mounds": ("earth",),
    "earth under trees": ("wooded",),
    "earth beside a house": ("by_house",),
    "roofs": ("solid",),
    "tunnels, panels, barges, vehicles, walls": ("loose",),
    "hedges, bushes": ("leafy",),
    "grass, crops and what grows below trees": ("plants", "understory", "numbered"),
    "points far below or above the land": ("outliers",),
}
_ABOUT = """# Plain things

`python -m benchmarks.plain --peers --write` makes this page, and the table in the
[manual](../../docs/comparison.md#how-right).

Each row of the matrix is a generated scene with one thing (`benchmarks/scenes/plain.py`): a pit, a
dyke, a hall, a hedge. What must stay is right if 95 % of its points are ground; what must go if at
most 5 % of its points are (of roofs 2 %, of single points none). 95 % of the ground round it must
be ground, and the terrain model may be off by some decimetres (`benchmarks/plain.py`). Every
program runs with one set of defaults and gets every point, noise among them. Our filters were
developed with these rows, the others were not.

{peers}

Rows that come out right, of {count}{form}:

"""

# By name of the row: by name of the filter, whether it is held.
Held = dict[str, dict[str, bool]]


def _names(held: Held) -> list[str]:
    return list(next(iter(held.values())))


def _titles(names: Sequence[str]) -> list[str]:
    """Return the heads of the columns: ours are bold."""
    return [f"**{METHODS[name].label}**" if name in METHODS else name for name in names]


def _counts(held: Held, kinds: Sequence[Kind]) -> list[int]:
    """Return how many rows of some kinds there are, and how many each filter holds."""
    own = [held[row.name] for row in rows() if row.kind in kinds and row.name in held]
    return [len(own), *(sum(one[name] for one in own) for name in _names(held))]


def by_kind(held: Held) -> list[str]:
    """Return how many rows of each kind are held."""
    lines = [
        [kind.name, "stays" if kind.stays else "goes", *map(str, _counts(held, [kind]))]
        for kind in KINDS
    ]
    lines.append(["all", "", *map(str, _counts(held, KINDS))])
    return tables.table(("Kind", "must", "rows", *_titles(_names(held))), lines)


def by_group(held: Held) -> list[str]:
    """Return the share in percent of the rows of each group that are held."""
    groups = {
        title: [kind for kind in KINDS if kind.make.__name__ in makers]
        for title, makers in _GROUPS.items()
    }
    lines = []
    for title, kinds in (*groups.items(), ("all", KINDS)):
        count, *found = _counts(held, kinds)
        lines.append([title, str(count), *(f"{100 * one / count:.0f}" for one in found)])
    return tables.table(("Right, % of the rows", "rows", *_titles(_names(held))), lines)


def write(held: Held) -> None:
    """Write the page, and the table of the manual."""
    told = {peer.name: peer for peer in peers.PEERS}
    notes = [
        f"- {name} ({told[name].package.split('==')[0]} {told[name].version}): {told[name].note}."
        for name in _names(held)
        if name in told
    ]
    form = "" if len(held) == len(rows()) else ", at one of two places of the grid (`--quick`)"
    about = _ABOUT.format(
        peers="\n".join(notes) or "No other program was here.", count=len(held), form=form
    )
    PAGE.write_text(about + "\n".join(by_kind(held)) + "\n", "utf-8")
    marked.fill(MANUAL, "plain", by_group(held))
