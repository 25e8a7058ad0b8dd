"""Names and colours of the rules that decide cells: brown and green where a cell is ground."""

from __future__ import annotations

from typing import Iterable, Mapping, NamedTuple

from qgis.PyQt.QtGui import QColor

from ...algorithms.filters.method import NOT_GROUND
from ..i18n import mark, tr


class Verdict(NamedTuple):
    """The decision of a rule on a cell, in words that fit the panel of layers, and its colour."""

    text: str
    colour: str


GROUND = {
    "lowest-points": Verdict(mark("lowest points, undisputed"), "#e6d6b0"),
    "gentle-regions": Verdict(mark("gentle regions"), "#8a9a2f"),
    "seeds": Verdict(mark("seeds"), "#c08a45"),
    "fine-seeds": Verdict(mark("seeds of finer cells"), "#a3672f"),
    "level-seeds": Verdict(mark("level with seeds beside"), "#6fae5f"),
    "bunds": Verdict(mark("smooth sides of a bank"), "#4f8f3f"),
    "known-ground": Verdict(mark("known ground"), "#3f2a14"),
    "densification": Verdict(mark("densification"), "#8a5a2b"),
    "near-surface": Verdict(mark("points near the surface"), "#b5cf8a"),
}
# No grey, which a hillshade below would show as well.
OBJECTS = {
    "raised-objects": Verdict(mark("raised objects"), "#c8322f"),
    "tall-objects": Verdict(mark("tall objects"), "#c8322f"),
    "progressive-opening": Verdict(mark("cut off by openings"), "#f08c3a"),
    "steep-rises": Verdict(mark("steep rises"), "#f6cf3f"),
    "rims": Verdict(mark("rims of low objects"), "#8a4fb0"),
    "plants": Verdict(mark("plants or outliers"), "#e07ac0"),
    "shrubs": Verdict(mark("shrubs"), "#a8457f"),
    "seeds": Verdict(mark("on one grid only"), "#7a6a9e"),
    "fine-seeds": Verdict(mark("finer cells off surface"), "#b9a6e0"),
    "near-surface": Verdict(mark("none near surface"), "#464a6e"),
    "only-key-points": Verdict(mark("no key point"), "#9db2e6"),
    "narrow-pits": Verdict(mark("narrow pits"), "#2f6fc0"),
    "block-pits": Verdict(mark("pits in blocks"), "#1b3f8a"),
    "isolated-low-points": Verdict(mark("single low points"), "#49c0d6"),
    "low-groups": Verdict(mark("groups of low points"), "#1a2455"),
    "below-land": Verdict(mark("below land"), "#5b5fd6"),
    "below-water": Verdict(mark("below water"), "#0fa3b1"),
    "dense-outliers": Verdict(mark("low outliers"), "#127a86"),
}
# For rules that rarely decide in this way.
_RARE_GROUND = "#5f5236"
_RARE_OTHER = "#ffa6b8"


def categories_of(codes: Iterable[int], rules: Mapping[int, str]) -> dict[int, tuple[str, QColor]]:
    """Return the name and colour of each code of an explanation that occurs, as in `Decisions`,
    ground first, by the numbers of the rules.
    """
    found = {}
    for code in sorted(set(codes) - {0, NOT_GROUND}):
        is_ground, name = code < NOT_GROUND, rules.get(code % NOT_GROUND, f"{code % NOT_GROUND}")
        usual, others = (GROUND, OBJECTS) if is_ground else (OBJECTS, GROUND)
        rare = Verdict(name.replace("-", " "), _RARE_GROUND if is_ground else _RARE_OTHER)
        rare = rare._replace(text=others.get(name, rare).text)
        text, colour = usual.get(name, rare)
        label = tr("Ground: {}") if is_ground else tr("Not ground: {}")
        found[code] = label.format(tr(text)), QColor(colour)
    return found
