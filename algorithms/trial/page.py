"""The page that compares settings on a window."""

from __future__ import annotations

from typing import NamedTuple, Sequence

import numpy as np

from ..grids.hillshade import hillshade
from ..report.page import Html, element, key, lines, listed, map_of, maps, page, paragraph, section
from ..report.page import table as table_of
from ..report.pictures import Picture, Relief, rgb
from ..report.units import percent
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
        first, cell = self.outcomes[0], self.window.units.length(self.window.cell_size)
        parts = [
            lines(*self.sources, self.where, kind="files"),
            listed(self.notes),
            *self._table(),
            section(
                "Terrain",
                maps(map(self._terrain, self.outcomes)),
                paragraph(
                    "Hillshade of the terrain, lit from north-west; north is up, a pixel is"
                    f" {cell} wide. Light grey: no terrain.",
                    key(_PROFILE, "where the profile lies"),
                ),
            ),
            section(
                f"Differences from {first.label}",
                maps(self._differences()),
                paragraph(
                    key(_GAINED, "ground here, but not with the first setting"),
                    key(_LOST, "ground with the first setting, but not here"),
                ),
                paragraph(
                    "Grey is the relief of the highest points, all that stands on the ground"
                    " included. A pixel takes the colour of its more frequent difference, the"
                    " stronger the more of its points differ."
                ),
            ),
            section(
                "Profiles, and how to run each setting on all points",
                paragraph(self._about_profile()),
                *map(self._profile, self.outcomes, self.commands),
            ),
        ]
        return page("Settings compared on a window", parts, _STYLE)

    def _table(self) -> tuple[Html, Html]:
        rows = []
        for number, one in enumerate(self.figures):
            apart = one.terrain_difference
            others = ["first"] * 3
            if number:
                others = [
                    f"{count:,} ({percent(100.0 * count / one.point_count)})"
                    for count in (one.gained, one.lost)
                ]
                others.append("none" if apart is None else self.window.units.height(apart))
            rows.append((one.label, percent(one.ground_share), f"{one.confidence:.0f} %", *others))
        head = (
            "Setting", "Ground", "Confidence", "More ground", "Less ground", "Terrain differs by",
        )  # fmt: skip
        return table_of(rows, head, "lrrrrr", is_named=True), paragraph(
            f"Of the {self.figures[0].point_count:,} points in the window. Ground: their share that"
            " is ground. Confidence: the mean probability that the terrain is right, as each"
            " setting's own points tell it. More, less ground: points that are ground here but not"
            " with the first setting, and the reverse. Terrain differs by: the mean of the absolute"
            " differences in height."
        )

    def _terrain(self, outcome: Outcome) -> Html:
        lit = np.maximum(hillshade(outcome.terrain, self.window.cell_size), 1)
        pixels = np.repeat(lit[..., None], 3, axis=2)
        pixels[np.isnan(outcome.terrain)] = _NO_TERRAIN
        _, row, column = self.profile.line.cells(self.window)
        pixels[row, column] = rgb(_PROFILE)
        picture = Picture(pixels, self.window.cell_size)
        return map_of(picture, outcome.label, units=self.window.units)

    def _differences(self) -> list[Html]:
        inside, first = self.window.inside, self.outcomes[0]
        relief = Relief.of(self.window.points.take(inside), _LONGEST_SIDE)
        pictures, before = [], first.ground[inside]
        for outcome in self.outcomes:
            ground = outcome.ground[inside]
            picture = relief.marked(ground & ~before, before & ~ground, (_GAINED, _LOST))
            label = "The highest points" if outcome is first else outcome.label
            pictures.append(map_of(picture, label, units=self.window.units))
        return pictures

    def _profile(self, outcome: Outcome, commands: Commands) -> Html:
        first = self.outcomes[0]
        parts = [
            element("h3", outcome.label),
            self.profile.svg(self.window, outcome, first),
            paragraph(self.profile.key(outcome, outcome is first)),
            element("pre", commands.shell),
            element("pre", commands.qgis) if commands.qgis else "",
        ]
        return Html("\n".join(parts))

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
