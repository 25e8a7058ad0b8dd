"""The page that compares settings on a window."""

from __future__ import annotations

from typing import NamedTuple, Sequence

import numpy as np

from ..grids.hillshade import hillshade
from ..products.page import key, map_figure, page_html, percent, text
from ..products.pictures import Picture, Relief, rgb
from .profile import Profile
from .window import Figures, Outcome, Window

# These colours differ for colour-blind people and in print.
_LOST, _GAINED = "#d1157f", "#1b62c4"
_PROFILE = "#e06c00"
_NO_TERRAIN = (236, 236, 236)
_LONGEST_SIDE = 400

_STYLE = """
body { max-width: 1320px; }
.maps { display: flex; flex-wrap: wrap; gap: 1em; align-items: flex-end; }
.maps figure { flex: 1 1 280px; max-width: 500px; }
td { white-space: nowrap; }
figcaption { font-weight: 600; }
svg { width: 100%; max-width: 976px; display: block; font-family: inherit; }
svg image { image-rendering: pixelated; }
pre { background: #f4f4f4; border: 1px solid #ddd; padding: .5em .8em; margin: .4em 0;
      white-space: pre-wrap; overflow-wrap: anywhere; max-width: 960px; box-sizing: border-box; }
h3 { margin: 1.6em 0 .3em; font-size: 1.05em; }
"""


class Commands(NamedTuple):
    """Commands that run a setting on all points."""

    shell: str  # the command line
    qgis: str  # the call in the Python console of QGIS; empty if there is none


class TrialPage(NamedTuple):
    """The contents of the page, with result, figures and commands of each setting."""

    sources: Sequence[object]
    where: str  # the window in words
    notes: Sequence[str]  # that help to judge the pictures
    window: Window
    outcomes: Sequence[Outcome]
    figures: Sequence[Figures]
    commands: Sequence[Commands]
    profile: Profile

    def html(self) -> str:
        """Return the page."""
        first = self.outcomes[0]
        notes = "".join(f"<li>{text(note)}</li>" for note in self.notes)
        profiles = "".join(map(self._profile, self.outcomes, self.commands))
        cell = self.window.units.length(self.window.cell_size)
        body = f"""<p class="files">{"<br>".join(map(text, self.sources))}<br>{text(self.where)}</p>
<ul>{notes}</ul>
{self._table()}
<h2>Terrain</h2>
<div class="maps">{"".join(map(self._terrain, self.outcomes))}</div>
<p>Hillshade of the terrain, lit from north-west; north is up, a pixel is {cell} wide. Light
grey: no terrain. {key(_PROFILE, "where the profile lies")}</p>
<h2>Differences from {text(first.label)}</h2>
<div class="maps">{self._differences()}</div>
<p>{key(_GAINED, "ground here, but not with the first setting")}
{key(_LOST, "ground with the first setting, but not here")}</p>
<p>Grey is the relief of the highest points, all that stands on the ground included. A pixel takes
the colour of its more frequent difference, the stronger the more of its points differ.</p>
<h2>Profiles, and how to run each setting on all points</h2>
<p>{text(self._about_profile())}</p>
{profiles}"""
        return page_html("Settings compared on a window", body, _STYLE)

    def _table(self) -> str:
        rows = []
        for number, each in enumerate(self.figures):
            apart = each.terrain_difference
            others = ["first"] * 3
            if number:
                others = [
                    f"{count:,} ({percent(100.0 * count / each.point_count)})"
                    for count in (each.gained, each.lost)
                ]
                others.append("none" if apart is None else self.window.units.height(apart))
            cells = [percent(each.ground_share), f"{each.confidence:.0f} %", *others]
            row = "".join(f"<td>{cell}</td>" for cell in cells)
            rows.append(f'<tr><th class="text">{text(each.label)}</th>{row}</tr>')
        return f"""<table>
<tr><th class="text">Setting</th><th>Ground</th><th>Confidence</th><th>More ground</th>
<th>Less ground</th><th>Terrain differs by</th></tr>
{chr(10).join(rows)}
</table>
<p>Of the {self.figures[0].point_count:,} points in the window. Ground: their share that is ground.
Confidence: the mean probability that the terrain is right, as each setting's own points tell it.
More, less ground: points that are ground here but not with the first setting, and the reverse.
Terrain differs by: the mean of the absolute differences in height.</p>"""

    def _terrain(self, outcome: Outcome) -> str:
        lit = np.maximum(hillshade(outcome.terrain, self.window.cell_size), 1)
        pixels = np.repeat(lit[..., None], 3, axis=2)
        pixels[np.isnan(outcome.terrain)] = _NO_TERRAIN
        _, row, column = self.profile.line.cells(self.window)
        pixels[row, column] = rgb(_PROFILE)
        return self._figure(Picture(pixels, self.window.cell_size), outcome.label)

    def _differences(self) -> str:
        inside, first = self.window.inside, self.outcomes[0]
        relief = Relief.of(self.window.points.take(inside), _LONGEST_SIDE)
        maps, before = [], first.ground[inside]
        for outcome in self.outcomes:
            ground = outcome.ground[inside]
            picture = relief.marked(ground & ~before, before & ~ground, (_GAINED, _LOST))
            label = "The highest points" if outcome is first else outcome.label
            maps.append(self._figure(picture, label))
        return "".join(maps)

    def _profile(self, outcome: Outcome, commands: Commands) -> str:
        first = self.outcomes[0]
        qgis = f"<pre>{text(commands.qgis)}</pre>" if commands.qgis else ""
        return f"""<h3>{text(outcome.label)}</h3>
{self.profile.svg(self.window, outcome, first)}
<p>{self.profile.key(outcome, outcome is first)}</p>
<pre>{text(commands.shell)}</pre>{qgis}
"""

    def _about_profile(self) -> str:
        units, more = self.window.units, self.profile.exaggeration
        strip = units.length(float(f"{2.0 * self.window.strip:.2g}"), 2)
        ends = self.profile.line.start, self.profile.line.end
        (x0, y0), (x1, y1) = ((x / units.horizontal, y / units.horizontal) for x, y in ends)
        unit = units.across
        return (
            f"The profile runs from {x0:.0f} {unit} east and {y0:.0f} {unit} north of the lower"
            f" left corner of the window to {x1:.0f} {unit} east and {y1:.0f} {unit} north of it,"
            f" and shows the points of a strip {strip} wide by class, but for noise. Heights are"
            f" drawn {more:.2g} times as large as lengths."
        )

    def _figure(self, picture: Picture, label: str) -> str:
        return f"<figure>{map_figure(picture, label, label, self.window.units)}</figure>"
