"""The page that compares settings on a window."""

from __future__ import annotations

import math
from typing import NamedTuple, Sequence

import numpy as np

from ...core.points import box_in_words
from ...relief.hillshade import hillshade
from ...report.page import (
    Html,
    element,
    key,
    lines,
    listed,
    map_of,
    maps,
    page,
    paragraph,
    section,
    table,
)
from ...report.pictures import Picture, Relief
from ...report.units import percent
from .window import Outcome, Window

# These colours differ for colour-blind people and in print.
_LOST = "#d1157f"
_GAINED = "#1b62c4"
_NO_TERRAIN = (236, 236, 236)
_LONGEST_SIDE = 400

_STYLE = """
body { max-width: 1320px; }
.maps { display: flex; flex-wrap: wrap; gap: 1em; align-items: flex-end; }
.maps figure { flex: 1 1 280px; max-width: 500px; }
td { white-space: nowrap; }
figcaption { font-weight: 600; }
pre { background: #f4f4f4; border: 1px solid #ddd; padding: .5em .8em; margin: .4em 0;
      white-space: pre-wrap; overflow-wrap: anywhere; max-width: 960px; box-sizing: border-box; }
h3 { margin: 1.6em 0 .3em; font-size: 1.05em; }
"""


class SettingFigures(NamedTuple):
    """Figures of a setting in the window, and commands that run it on all points."""

    name: str
    label: str
    point_count: int
    ground_count: int
    ground_share: float  # percent
    expected_rmse: float | None  # of the terrain, in metres; None without terrain
    gained: int  # points that are ground, but not with the first setting
    lost: int  # points that are ground only with the first setting
    # mean absolute, in metres, from the first setting; None without terrain
    terrain_difference: float | None
    shell: str  # the command line
    qgis: str  # the call in the Python console of QGIS; or empty


def figures_of(
    window: Window, outcome: Outcome, first: Outcome, commands: tuple[str, str]
) -> SettingFigures:
    """Return the figures of a setting, compared with the first setting."""
    ground, before = outcome.ground[window.inside], first.ground[window.inside]
    apart = np.abs(outcome.terrain - first.terrain)
    apart = apart[np.isfinite(apart)]
    ground_count = int(np.count_nonzero(ground))
    return SettingFigures(
        outcome.setting.name,
        outcome.setting.label,
        len(ground),
        ground_count,
        100.0 * ground_count / len(ground),
        round(outcome.expected_rmse, 4) if math.isfinite(outcome.expected_rmse) else None,
        int(np.count_nonzero(ground & ~before)),
        int(np.count_nonzero(before & ~ground)),
        float(apart.mean()) if apart.size else None,
        *commands,
    )


def comparison(
    sources: Sequence[object],
    notes: Sequence[str],  # on the pictures
    window: Window,
    outcomes: Sequence[Outcome],
    figures: Sequence[SettingFigures],
) -> str:
    """Return the page."""
    label, cell = outcomes[0].setting.label, window.units.length(window.cell_size)
    where = f"Window: {box_in_words(window.box)} ({_size(window)})"
    parts = [
        lines(*sources, where, kind="files"),
        listed(notes),
        *_table(window, figures),
        section(
            "Terrain",
            maps(_terrain(window, outcome) for outcome in outcomes),
            paragraph(
                "Hillshade of the terrain, lit from north-west; north is up, a pixel is"
                f" {cell} wide. Light grey: no terrain."
            ),
        ),
        section(
            f"Differences from {label}",
            maps(_differences(window, outcomes)),
            paragraph(
                key(_GAINED, "ground here, but not with the first setting"),
                key(_LOST, "ground with the first setting, but not here"),
            ),
            paragraph(
                "Grey is the relief of the highest points, including everything that stands on"
                " the ground. A pixel takes the colour of its more frequent difference, the"
                " stronger the more of its points differ."
            ),
        ),
        section(
            "How to run each setting on all points",
            *(_commands(setting) for setting in figures),
        ),
    ]
    return page("Settings compared on a window", parts, _STYLE)


def _size(window: Window) -> str:
    """Return the size of the window in the unit of the survey, and in metres."""
    (width, height), unit = window.sides, window.units.horizontal
    metric = f"{width:.0f} x {height:.0f} m"
    if unit == 1.0:
        return metric
    return f"{width / unit:.0f} x {height / unit:.0f} {window.units.across}, {metric}"


def _table(window: Window, figures: Sequence[SettingFigures]) -> tuple[Html, Html]:
    rows = []
    for number, setting in enumerate(figures):
        differences = ["first"] * 3
        if number:
            differences = [
                f"{count:,} ({percent(100.0 * count / setting.point_count)})"
                for count in (setting.gained, setting.lost)
            ]
            apart = setting.terrain_difference
            differences.append("none" if apart is None else window.units.height(apart))
        rmse = setting.expected_rmse
        in_words = "none" if rmse is None else window.units.height(rmse)
        rows.append((setting.label, percent(setting.ground_share), in_words, *differences))
    head = (
        "Setting", "Ground", "Expected RMSE", "More ground", "Less ground", "Terrain differs by",
    )  # fmt: skip
    return table(rows, head, "lrrrrr", is_named=True), paragraph(
        f"Of the {figures[0].point_count:,} points in the window. Ground: their share that"
        " is ground. Expected RMSE: of the terrain, as each setting's own points tell it;"
        " nothing was measured. More, less ground: points that are ground here but not"
        " with the first setting, and the reverse. Terrain differs by: the mean of the absolute"
        " differences in height."
    )


def _terrain(window: Window, outcome: Outcome) -> Html:
    lit = np.maximum(hillshade(outcome.terrain, window.cell_size), 1)
    pixels = np.repeat(lit[..., None], 3, axis=2)
    pixels[np.isnan(outcome.terrain)] = _NO_TERRAIN
    picture = Picture(pixels, window.cell_size)
    return map_of(picture, outcome.setting.label, units=window.units)


def _differences(window: Window, outcomes: Sequence[Outcome]) -> list[Html]:
    relief = Relief.of(window.points.take(window.inside), _LONGEST_SIDE)
    pictures, before = [], outcomes[0].ground[window.inside]
    for number, outcome in enumerate(outcomes):
        ground = outcome.ground[window.inside]
        picture = relief.marked(ground & ~before, before & ~ground, (_GAINED, _LOST))
        label = outcome.setting.label if number else "The highest points"
        pictures.append(map_of(picture, label, units=window.units))
    return pictures


def _commands(figures: SettingFigures) -> Html:
    parts = [
        element("h3", figures.label),
        element("pre", figures.shell),
        element("pre", figures.qgis) if figures.qgis else "",
    ]
    return Html("\n".join(parts))
