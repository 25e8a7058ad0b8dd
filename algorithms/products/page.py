"""Parts of HTML pages that need no other file."""

from __future__ import annotations

import base64
import math
from html import escape
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ..core.errors import BareEarthError, printable
from ..core.files import check_output
from .pictures import Picture, png

_STYLE = """
body { font: 15px/1.5 system-ui, sans-serif; color: #222; background: #fff; max-width: 920px;
       margin: 2em auto; padding: 0 1em; }
h1 { font-size: 1.6em; } h2 { font-size: 1.2em; margin-top: 2em; }
table { border-collapse: collapse; } caption { text-align: left; color: #555; }
th, td { border: 1px solid #bbb; padding: .25em .7em; text-align: right; }
th { background: #f2f2f2; font-weight: 600; } td.text, th.text { text-align: left; }
figure { margin: 0; }
img { width: 100%; image-rendering: pixelated; border: 1px solid #bbb; box-sizing: border-box; }
.bar { border: 2px solid #222; border-top: 0; height: 6px; }
.key { display: inline-block; width: 1em; height: 1em; vertical-align: -.15em; margin: 0 .3em 0 1em;
       border: 1px solid #555; }
.files { word-break: break-all; }
"""


class Units(NamedTuple):
    """Metres in the units of a survey, for pages; lengths and heights are computed in metres."""

    horizontal: float = 1.0
    vertical: float = 1.0

    @property
    def across(self) -> str:
        """Symbol of the horizontal unit."""
        return _symbol(self.horizontal)

    @property
    def up(self) -> str:
        """Symbol of the vertical unit."""
        return _symbol(self.vertical)

    def length(self, metres: float, digits: int = 3) -> str:
        """Return a length in the unit of the survey, and in metres, such as 164 ft (50 m)."""
        if self.horizontal == 1.0:
            return f"{metres:g} m"
        return f"{metres / self.horizontal:.{digits}g} {self.across} ({metres:g} m)"

    def height(self, metres: float) -> str:
        """Return a height difference in the unit of the survey, such as 1.64 ft."""
        return f"{metres / self.vertical:.2f} {self.up}"


def _symbol(metres: float) -> str:
    """Return the symbol of a unit; on a page, both kinds of feet are the same."""
    if metres == 1.0:
        return "m"
    return "ft" if math.isclose(metres, 0.3048, rel_tol=1e-5) else f"units of {metres:g} m"


def check_page(target: Path, sources: tuple[Path, ...] = ()) -> None:
    """Refuse, before any work is done, a page not named .html or not to be written at the end."""
    check_output(target, sources)
    if target.suffix.lower() not in (".html", ".htm"):
        raise BareEarthError(f"Cannot write {target}: the page is HTML, name it .html.")


def page_html(title: str, body: str, style: str = "") -> str:
    """Return a page with a title and headline in plain text, and the HTML of its body."""
    from ..core.version import __version__

    title = text(title)
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


def text(value: object) -> str:
    """Return a value as text, escaped for HTML."""
    return escape(printable(str(value)))


def data_uri(pixels: np.ndarray) -> str:
    """Return a data URI of a picture, given its pixels, shape (rows, columns, 3)."""
    return "data:image/png;base64," + base64.b64encode(png(pixels)).decode("ascii")


def map_figure(picture: Picture, name: str, caption: str = "", units: Units = Units()) -> str:
    """Return a map with a scale bar; name (alternative text) and caption are plain text."""
    width = picture.pixels.shape[1] * picture.cell_size / units.horizontal
    length = round_length(width / 4)
    above = f"<figcaption>{text(caption)}</figcaption>" if caption else ""
    return f"""{above}<img src="{data_uri(picture.pixels)}" alt="{text(name)}">
<div class="bar" style="width: {100 * length / width:.2f}%"></div>{length:g} {units.across}"""


def key(colour: str, meaning: str) -> str:
    """Return the entry of a legend for a colour."""
    return f'<span class="key" style="background: {colour}"></span>{text(meaning)}'


def round_length(most: float) -> float:
    """Return the largest number of the form 1, 2, 5, 10, 20 ... up to `most`."""
    power = 10.0 ** np.floor(np.log10(most))
    return float(next(each * power for each in (5, 2, 1) if each * power <= most * (1 + 1e-9)))


def percent(value: float) -> str:
    """Return a percentage as text; "none" for NaN."""
    return "none" if np.isnan(value) else f"{value:.2f} %"
