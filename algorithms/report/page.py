"""The parts of an HTML page: headings, paragraphs, tables, maps and bars, which escape text."""

from __future__ import annotations

import base64
from html import escape
from typing import Iterable, NamedTuple, Sequence

import numpy as np

from ..core.errors import printable
from ..core.version import __version__
from .pictures import Picture, png
from .units import Units, round_length

_STYLE = """
body { font: 15px/1.5 system-ui, sans-serif; color: #222; background: #fff; max-width: 920px;
       margin: 2em auto; padding: 0 1em; }
h1 { font-size: 1.6em; } h2 { font-size: 1.2em; margin-top: 2em; }
table { border-collapse: collapse; } caption { text-align: left; color: #555; }
th, td { border: 1px solid #bbb; padding: .25em .7em; text-align: right; }
th { background: #f2f2f2; font-weight: 600; } td.text, th.text { text-align: left; }
figure { margin: 0; }
img { width: 100%; image-rendering: pixelated; border: 1px solid #bbb; box-sizing: border-box; }
.maps { display: grid; grid-template-columns: repeat(auto-fill, minmax(260px, 1fr)); gap: 1.2em; }
.bar { border: 2px solid #222; border-top: 0; height: 6px; }
.key { display: inline-block; width: 1em; height: 1em; vertical-align: -.15em; margin: 0 .3em 0 1em;
       border: 1px solid #555; }
.files { word-break: break-all; }
"""
# Of pages with drawings.
DRAWN = "svg { width: 100%; max-width: 860px; height: auto; }\n"
# Of pages that say what may be wrong before all else.
DOUBT = ".doubt { padding: .4em 1em; border-left: 4px solid #b2182b; background: #fdecea; }\n"
# Sizes of drawings in pixels.
_WIDTH = 800
_HEIGHT = 180
_BELOW = 40
_LEFT = 46
_TALLEST = 900
_RADIUS = 7


class Html(str):
    """Markup, which is not escaped again."""


def page(title: str, parts: Iterable[str], style: str = "") -> str:
    """Return a page of parts below a headline, with further CSS."""
    title, body = text(title), "\n".join(part for part in parts if part)
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>{title}</title>
<style>{_STYLE}{style}</style>
</head>
<body>
<h1>{title}</h1>
{body}
<p>Made by Bare Earth {escape(__version__)}.</p>
</body>
</html>
"""


def text(value: object) -> Html:
    """Return a value as escaped text; markup stays as it is."""
    return value if isinstance(value, Html) else Html(escape(printable(str(value))))


def element(name: str, content: object, kind: str = "") -> Html:
    """Return an HTML element of a CSS class."""
    start = f'{name} class="{kind}"' if kind else name
    return Html(f"<{start}>{text(content)}</{name}>")


def section(title: str, *parts: str) -> Html:
    """Return parts below a heading; nothing if all of them are empty."""
    found = [part for part in parts if part]
    return Html("\n".join([element("h2", title), *found]) if found else "")


def paragraph(*sentences: object, kind: str = "") -> Html:
    """Return a paragraph, or nothing where nothing is said."""
    said = [text(sentence) for sentence in sentences if sentence]
    return element("p", Html(" ".join(said)), kind) if said else Html("")


def lines(*said: object, kind: str = "") -> Html:
    """Return a paragraph of several lines."""
    return element("p", Html("<br>".join(map(text, said))), kind)


def listed(items: Sequence[object]) -> Html:
    """Return a list with a bullet for each item, or nothing for none."""
    bullets = "".join(element("li", item) for item in items)
    return element("ul", Html(bullets)) if items else Html("")


def link(target: str, words: object) -> Html:
    """Return a link."""
    return Html(f'<a href="{text(target)}">{text(words)}</a>')


def table(
    rows: Iterable[Sequence[object]],
    head: Sequence[object] = (),
    align: str = "",
    is_named: bool = False,
    kind: str = "",
) -> Html:
    """Return a table, or nothing without rows; where they are named, first cells are headings."""
    # `align` has an l or an r for each column, for text and numbers; without it all are text.
    rows = list(rows)
    if not rows:
        return Html("")
    kinds = ["text" if side == "l" else "" for side in align or "l" * len(rows[0])]
    names = ["th" if is_named else "td", *["td"] * (len(kinds) - 1)]
    cells = [map(element, names, row, kinds) for row in rows]
    if head:
        cells.insert(0, map(element, ["th"] * len(kinds), head, kinds))
    content = "\n".join(element("tr", Html("".join(row))) for row in cells)
    return element("table", Html(content), kind)


def data_uri(pixels: np.ndarray) -> str:
    """Return a data URI of a picture of uint8, shape (rows, columns, 3)."""
    return "data:image/png;base64," + base64.b64encode(png(pixels)).decode("ascii")


def map_of(
    picture: Picture, name: str, legend: str = "", units: Units = Units(), is_captioned: bool = True
) -> Html:
    """Return a map with its name above, and a scale bar and a legend below."""
    width = picture.pixels.shape[1] * picture.cell_size / units.horizontal
    length = round_length(width / 4)
    above = element("figcaption", name) if is_captioned else ""
    below = f"<br>{legend}" if legend else ""
    share = 100 * length / width
    return Html(
        f'<figure>{above}<img src="{data_uri(picture.pixels)}" alt="{text(name)}">\n'
        f'<div class="bar" style="width: {share:.2f}%"></div>{length:g} {units.across}{below}'
        "</figure>"
    )


def maps(figures: Iterable[str]) -> Html:
    """Return maps side by side."""
    return Html(f'<div class="maps">{"".join(figures)}</div>')


def key(colour: str, meaning: str) -> Html:
    """Return the entry of a legend for a colour."""
    return Html(f'<span class="key" style="background: {colour}"></span>{text(meaning)}')


def keys(colours: Iterable[str], meanings: Iterable[str]) -> Html:
    """Return a legend."""
    return Html("".join(map(key, colours, meanings)))


def bars(name: str, counts: Sequence[int], colours: Sequence[str], ticks: Sequence[str]) -> Html:
    """Return a bar chart of counts, with evenly spread ticks below the bars."""
    wide, highest = _WIDTH / len(counts), max(*counts, 1)
    drawn, labels = [], []
    for number, (count, colour) in enumerate(zip(counts, colours)):
        tall = count / highest * _HEIGHT
        drawn.append(
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
        f'<path d="M0 {_HEIGHT}H{_WIDTH}" stroke="#555"/>{"".join(drawn)}'
        f'<g font-size="12" fill="#333" text-anchor="middle">{"".join(labels)}</g>',
    )


class Mark(NamedTuple):
    """A place on a map, in its coordinates, with a title that is shown under the mouse."""

    x: float
    y: float
    colour: str
    title: str


def map_of_places(name: str, boxes: np.ndarray, marks: Sequence[Mark], unit: str) -> Html:
    """Return a map of marks on rectangles: west, south, east and north, shape (n, 4)."""
    places = np.vstack((boxes[:, :2], boxes[:, 2:], [(mark.x, mark.y) for mark in marks]))
    (west, south), (east, north) = places.min(axis=0).tolist(), places.max(axis=0).tolist()
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
