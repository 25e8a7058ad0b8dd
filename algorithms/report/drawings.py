"""Drawings as SVG: a histogram, and a map of places."""

from __future__ import annotations

from typing import NamedTuple, Sequence

import numpy as np

from .page import Html, text
from .units import round_length

# Sizes in pixels.
_WIDTH, _HEIGHT, _BELOW, _LEFT = 800, 180, 40, 46
_TALLEST, _RADIUS = 900, 7
STYLE = "svg { width: 100%; max-width: 860px; height: auto; }\n"


def histogram(
    name: str, counts: Sequence[int], colours: Sequence[str], ticks: Sequence[str]
) -> Html:
    """Return a histogram whose bars have these counts; the ticks below it are evenly spread."""
    wide, highest = _WIDTH / len(counts), max(*counts, 1)
    bars, labels = [], []
    for number, (count, colour) in enumerate(zip(counts, colours)):
        tall = count / highest * _HEIGHT
        bars.append(
            f'<rect x="{number * wide:.1f}" y="{_HEIGHT - tall:.1f}" width="{wide - 2:.1f}"'
            f' height="{tall:.1f}" fill="{colour}" stroke="#555"/>'
        )
        if count:
            labels.append(_label((number + 0.5) * wide, _HEIGHT - tall - 4, count))
    for number, tick in enumerate(ticks):
        labels.append(_label(number / (len(ticks) - 1) * _WIDTH, _HEIGHT + 18, tick))
    return _svg(
        name,
        (-_LEFT, -20, _WIDTH + 2 * _LEFT, _HEIGHT + _BELOW + 20),
        f'<path d="M0 {_HEIGHT}H{_WIDTH}" stroke="#555"/>{"".join(bars)}'
        f'<g font-size="12" fill="#333" text-anchor="middle">{"".join(labels)}</g>',
    )


class Mark(NamedTuple):
    """A place on a map, in the coordinates of the map, with what is shown under the mouse."""

    x: float
    y: float
    colour: str
    title: str


def map_of_places(name: str, boxes: np.ndarray, marks: Sequence[Mark], unit: str) -> Html:
    """Return a map of marks on rectangles: west, south, east and north, shape (n, 4)."""
    x, y = [mark.x for mark in marks], [mark.y for mark in marks]
    west, south = (min(low, *at) for low, at in zip(boxes[:, :2].min(axis=0).tolist(), (x, y)))
    east, north = (max(high, *at) for high, at in zip(boxes[:, 2:].max(axis=0).tolist(), (x, y)))
    scale = min(_WIDTH / max(east - west, 1e-6), _TALLEST / max(north - south, 1e-6))
    high = (north - south) * scale
    drawn = "".join(
        f'<rect x="{(a - west) * scale:.1f}" y="{(north - d) * scale:.1f}"'
        f' width="{(c - a) * scale:.1f}" height="{(d - b) * scale:.1f}"/>'
        for a, b, c, d in boxes.tolist()
    )
    circles = "".join(
        f'<circle cx="{(mark.x - west) * scale:.1f}" cy="{(north - mark.y) * scale:.1f}"'
        f' r="{_RADIUS}" fill="{mark.colour}"><title>{text(mark.title)}</title></circle>'
        for mark in marks
    )
    length = round_length((east - west) / 4 or 1.0)
    return _svg(
        name,
        (-10, -10, _WIDTH + 20, round(high + 50)),
        f'\n<g fill="#f2efe9" stroke="#bbb">{drawn}</g>\n<g stroke="#333">{circles}</g>'
        f'<path d="M0 {high + 16:.0f}h{length * scale:.1f}" stroke="#222" stroke-width="3"/>'
        f'<text x="0" y="{high + 34:.0f}" font-size="12" fill="#333">{length:g} {unit}</text>',
    )


def _label(x: float, y: float, words: object) -> str:
    return f'<text x="{x:.1f}" y="{y:.1f}">{words}</text>'


def _svg(name: str, box: tuple[int, int, int, int], content: str) -> Html:
    shown = " ".join(map(str, box))
    return Html(f'<svg viewBox="{shown}" role="img"\n aria-label="{name}">{content}</svg>')
